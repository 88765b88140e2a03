//! The transition function of the crossing: [`Crossing::step`] takes one input and says what is to be done.

use crossguard_protocol::{
    Availability, Corridor, Duty, Event, FallbackPolicy, HelpRequest, Maneuver, ManeuverId, Millis,
    Notice, Phase, Progress, Robot, StationId,
};

use crate::ground::Point;
use crate::input::{
    BodyReport, Frame, FrameDrop, Hindrance, Input, Output, Outputs, Pose, RoadUser, Sighting,
};
use crate::lead::{Lead, View};
use crate::occupancy::Occupancy;
use crate::position::Presence;
use crate::setup::Setup;
use crate::tracks::{Origin, Track, Tracks};
use crate::traffic::{self, Traffic};

/// How long a robot waits after a call before it calls again.
const CALL_PERIOD: Millis = Millis(2_000);

/// For how long a person's word that the road is clear counts: it is about the road that they saw.
const SAID: Millis = Millis(10_000);

/// Time for which a report keeps a person on the road, for a robot without sensors: until the next report, which may come so much
/// later (`T_GenVamMax`, TS 103 300-3).
const REPORTED: Millis = Millis(5_500);

/// [`Crossing::stood`] of a robot that has looked at the carriageway on which it found itself, or was beside it.
const LOOKED: Millis = Millis(u32::MAX);

/// How far from the carriageway a body stops that waits for vehicles to pass, in centimetres, at most.
const KERB_CM: u32 = 200;

/// Where outputs go.
pub(crate) trait Sink {
    /// Puts one out. One that does not fit is put out again in a later step: what is said follows from the state.
    fn put(&mut self, output: Output);

    /// Tells the protocol an event.
    fn tell(&mut self, event: Event) {
        self.put(Output::Tell(event));
    }
}

impl Sink for Outputs {
    fn put(&mut self, output: Output) {
        if !self.iter().any(|known| *known == output) {
            let _ = self.push(output);
        }
    }
}

/// The robot's part, as far as calls for help depend on it.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
enum Standing {
    /// It may call.
    #[default]
    Free,
    /// It asks for help.
    Requesting,
    /// It leads.
    Leading,
    /// It follows in another robot's session.
    Following,
    /// It may not call, and has no part: a body that can still be commanded leaves the road.
    Resting,
    /// It has another part in another robot's session, a duty, or is unavailable with a body that is not its own to command.
    Bound,
}

/// A duty or a session that waits for a clear road.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
struct Obligation {
    about: About,
    /// Until then a sign that counts on this robot may still show go.
    wait: Millis,
    /// For how long yet a person's word counts that the road is clear.
    said_clear: Millis,
}

impl Obligation {
    /// Whether the sign of another robot may still show go. That of a leader whose own session ended does not.
    fn is_beside_a_sign(&self) -> bool {
        self.wait > Millis::ZERO && matches!(self.about, About::Duty(Duty::FallingBack(_)))
    }
}

#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
enum About {
    /// The duty of a session or maneuver that ended early.
    Duty(Duty),
    /// The corridor that was closed, in a session that goes on.
    Clearing,
}

/// The maneuver that the protocol has the robot's body do.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "each is a belief of its own")]
struct Task {
    maneuver: Maneuver,
    /// Where it leads.
    place: Option<Point>,
    presence: Presence,
    /// Whether the body has said that it is in position.
    has_arrived: bool,
    /// Whether the protocol knows that it is.
    is_reported: bool,
    /// Whether the body has finished.
    is_completed: bool,
    /// Whether somebody was on the road since it began: who waits at the kerb then is not waited for any more.
    had_people: bool,
}

/// The beliefs of a robot about its crossing, and its next acts.
#[derive(Clone, PartialEq, Eq, Hash, Debug, Default)]
#[expect(clippy::struct_excessive_bools, reason = "each is a belief of its own")]
pub struct Crossing<const N: usize = 64> {
    tracks: Tracks<N>,
    occupancy: Occupancy,
    traffic: Traffic,
    standing: Standing,
    corridor: Corridor,
    /// Whether the session is one that it called for.
    is_called: bool,
    /// Whether somebody was let across in the session.
    has_opened: bool,
    /// Whether somebody was on the road since.
    has_crossed: bool,
    /// Until then it does not call again.
    call_pause: Millis,
    /// Time until the zone counts as deserted.
    wanted: Millis,
    /// For how long yet its sign shows go.
    sign: Millis,
    /// Time since no sign that counts on this robot has shown go any more, saturating.
    quiet: Millis,
    obligation: Option<Obligation>,
    /// For how long yet a report by others keeps the road from being clear.
    reported: Millis,
    /// Whether the body moves because of a fallback.
    is_falling_back: bool,
    /// Whether the protocol knows that the robot itself sees somebody on the road.
    is_person_told: bool,
    /// Whether a person has said that somebody is on the road, and not yet that it is clear.
    is_person_said: bool,
    /// Whether a person has closed the corridor, and not opened it again.
    is_kept_closed: bool,
    task: Option<Task>,
    /// Whether the body's fallback takes it to the kerb, beside a person.
    is_kerbward: bool,
    /// Where the body goes without a maneuver: to the place of its plan, or home.
    walk: Option<Point>,
    /// Whether the body was told to wait on its way.
    waits: bool,
    /// Whether it was to wait for vehicles at the kerb, and they have not passed.
    is_held_at_kerb: bool,
    /// Whether its newest maneuver failed.
    has_failed: bool,
    /// For how long it has stood on the carriageway since its start, or since it lost its part there by a failure, until it has [`LOOKED`].
    stood: Millis,
    /// Where its own body is, and how long ago that was measured.
    pose: Option<(Pose, Millis)>,
    /// Whether its body is at the place of its plan.
    own: Presence,
    lead: Option<Lead>,
    /// Whether its plan goes the other way round.
    turned: bool,
}

impl<const N: usize> Crossing<N> {
    /// Takes `input` in and returns what is to be done, in order. It is total: every input in every state has a
    /// defined outcome.
    pub fn step(&mut self, setup: &Setup, input: Input<'_>) -> Outputs {
        let mut out = Outputs::EMPTY;
        match input {
            Input::Elapsed(time) => self.elapse(setup, time, &mut out),
            Input::Frame(frame) => {
                self.frame(setup, &frame, &mut out);
                self.watch_people(setup, &mut out);
            }
            Input::BadFrame => {
                self.occupancy.start_anew();
                out.put(Output::Dropped(FrameDrop::Malformed));
            }
            Input::Heard(station, sighting, age) => self.heard(setup, station, sighting, age),
            Input::Object(at) => self.suspect(setup, at, &mut out),
            Input::Vehicle(vehicle, age) => {
                self.traffic.hear(setup, vehicle, age);
                self.guard_corridor(setup, &mut out);
            }
            Input::Missed(time) => {
                self.traffic.miss(time);
                self.guard_corridor(setup, &mut out);
            }
            Input::Answered(station, promises) => self.traffic.answer(setup, station, promises),
            Input::Pose(pose, age) => self.is_at(setup, pose, age),
            Input::FollowerAt(station, pose, age) => {
                if let (Some(plan), Some(lead)) = (&setup.plan, &mut self.lead) {
                    lead.follower_is_at(setup, plan, station, pose, age);
                }
                self.guard_corridor(setup, &mut out);
            }
            Input::Body(report) => self.body_reports(report),
            Input::BodyIsFree(is_free) => self.is_falling_back = !is_free,
            Input::Started(maneuver, place) => {
                self.start(setup, maneuver, place);
                self.set_out(setup, place, &mut out);
                self.watch_way(setup, &mut out);
            }
            Input::Stopped => self.begin(None, false),
            Input::FellBack(_, policy) => {
                self.begin(None, policy == FallbackPolicy::EscortToKerb);
            }
            Input::Notice(notice) => self.notice(setup, notice, &mut out),
            Input::CorridorOpen(left) => self.show_go(setup, left, &mut out),
            Input::CorridorClosed => self.show_stop(&mut out),
            // In a session of its own somebody else called a second time.
            Input::CallIgnored if !self.is_own() => self.end_call(),
            Input::CallIgnored => {}
            Input::Said(event) => self.said(event),
            Input::SaidClear => {
                self.is_person_said = false;
                self.tracks.resolve(true);
                match &mut self.obligation {
                    // People may step on the road yet, and the word is about the road as it was.
                    Some(it) if it.is_beside_a_sign() => out.put(Output::SaidTooEarly),
                    Some(it) => it.said_clear = SAID,
                    None => {}
                }
            }
        }
        out
    }

    /// Takes in what the protocol knows after a step.
    pub fn learn(&mut self, setup: &Setup, robot: &Robot) -> Outputs {
        let mut out = Outputs::EMPTY;
        let was_own = self.is_own();
        self.standing = match robot.phase() {
            Phase::Idle if robot.duty().is_none() => match robot.availability() {
                Availability::Available => Standing::Free,
                Availability::Unavailable(why) if why.can_fall_back() => Standing::Resting,
                Availability::Unavailable(_) => Standing::Bound,
            },
            Phase::Requesting(_) => Standing::Requesting,
            Phase::Leading(_) => Standing::Leading,
            Phase::Following(_) => Standing::Following,
            Phase::Idle | Phase::Offering(_) => Standing::Bound,
        };
        // A robot that loses its part by a failure looks as one that has just started, before it leaves the road.
        if self.has_failed && self.standing != Standing::Following {
            self.stood = Millis::ZERO;
        }
        self.has_failed = matches!(robot.phase(), Phase::Following(following)
            if following.job.is_some_and(|job| matches!(job.progress, Progress::Failed(_))));
        if was_own && !self.is_own() {
            self.end_call();
            self.lead = None;
        }
        self.corridor = match robot.phase() {
            Phase::Leading(leading) => leading.corridor,
            _ => Corridor::Clear,
        };
        let is_told = matches!(robot.phase(), Phase::Following(following) if following.sees_people);
        self.is_person_told = is_told;
        self.is_kerbward &= robot.duty().is_some();
        // The end of a maneuver is told once.
        let runs = executing(robot);
        self.task = self.task.filter(|task| runs == Some(task.maneuver));
        if let Some(task) = &mut self.task {
            task.is_reported = match robot.phase() {
                Phase::Following(following) => following.job.is_some_and(|job| {
                    let is_own = job.request == task.maneuver.id.request;
                    is_own && job.progress == Progress::InPosition
                }),
                _ => false,
            };
        }
        self.learn_obligation(setup, robot, &mut out);
        self.is_person_said &= !self.has_no_part();
        out
    }

    /// A person or another application tells the protocol something. Sensors of this robot do not take it back: they may miss what a
    /// person sees.
    fn said(&mut self, event: Event) {
        match event {
            Event::PersonOnRoad => {
                self.is_person_said = true;
                self.doubt_word();
            }
            Event::RoadClear => self.is_person_said = false,
            Event::CloseCorridor => self.is_kept_closed = self.is_own(),
            Event::OpenCorridor => self.is_kept_closed = false,
            _ => {}
        }
    }

    fn learn_obligation(&mut self, setup: &Setup, robot: &Robot, out: &mut Outputs) {
        let about = match robot.duty() {
            Some(duty) => Some(About::Duty(duty)),
            None => (self.corridor == Corridor::Clearing).then_some(About::Clearing),
        };
        if self.obligation.map(|it| it.about) == about {
            return;
        }
        // A duty that ends because its task goes on leaves the body where it is.
        if self.obligation.is_some() && about.is_none() && executing(robot).is_none() {
            out.put(Output::Release);
        }
        self.obligation = about.map(|about| Obligation {
            about,
            // No sign that counts on this robot shows go for longer than its own `t_safety`.
            wait: match about {
                About::Duty(_) => setup.t_safety,
                About::Clearing => Millis::ZERO,
            },
            said_clear: Millis::ZERO,
        });
        self.hold_count();
    }

    fn elapse(&mut self, setup: &Setup, time: Millis, out: &mut Outputs) {
        // Nothing tells a robot without sensors that somebody who was lost on the road has left it. Without a part it guards nobody,
        // and would stand on the lane for them for ever.
        if !self.occupancy.has_sources() && self.has_no_part() {
            self.tracks.resolve(true);
        }
        self.tracks.elapse(setup, time, self.sign > Millis::ZERO);
        self.occupancy.elapse(setup, time);
        self.reported = self.reported.saturating_sub(time);
        self.traffic.elapse(setup, time);
        self.call_pause = self.call_pause.saturating_sub(time);
        self.wanted = self.wanted.saturating_sub(time);
        // A wait that ended meanwhile ended within this step, and not before it.
        let waited = self.obligation.map_or(Millis::ZERO, |it| it.wait);
        let shown = self.sign.max(waited);
        self.sign = self.sign.saturating_sub(time);
        let newest = setup.sensors.age_max.saturating_add(setup.waiting.step_off);
        let newest = newest.saturating_add(Millis(1));
        let quiet = self.quiet.saturating_add(time.saturating_sub(shown));
        self.quiet = quiet.min(newest);
        self.own.elapse(setup.position, time);
        let known = self
            .pose
            .map(|(pose, age)| (pose, age.saturating_add(time)));
        self.pose = known.filter(|(_, age)| *age < setup.position.lease);
        if let Some(task) = &mut self.task {
            task.presence.elapse(setup.position, time);
        }
        if let Some(obligation) = &mut self.obligation {
            obligation.wait = obligation.wait.saturating_sub(time);
            obligation.said_clear = obligation.said_clear.saturating_sub(time);
        }
        if let Some(lead) = &mut self.lead {
            lead.elapse(setup, time);
        }
        self.hold_count();
        if self.is_wanted() {
            self.wanted = setup.waiting.clear;
        }
        self.has_crossed |= self.has_opened && self.occupancy.was_seen();
        self.guard_corridor(setup, out);
        self.watch_people(setup, out);
        self.watch_task(setup, out);
        self.look(setup, time);
        self.leave_road(setup, out);
        self.watch_way(setup, out);
        self.watch_road(setup, out);
        self.watch_zone(setup, out);
        self.lead_on(setup, out);
    }

    /// While a sign that counts on this robot may show go, no frame counts for a clear road; and none that is taken while people
    /// who saw it may still step off the kerb.
    fn hold_count(&mut self) {
        let leads_across = self.standing == Standing::Leading
            && (self.corridor == Corridor::Open || self.sign > Millis::ZERO);
        let waits = self.obligation.is_some_and(|it| it.wait > Millis::ZERO);
        if leads_across || waits {
            self.occupancy.start_anew();
            self.quiet = Millis::ZERO;
        }
    }

    fn frame(&mut self, setup: &Setup, frame: &Frame<'_>, out: &mut Outputs) {
        self.see_vehicles(setup, frame);
        if let Err(why) = self.occupancy.admit(setup, frame) {
            let mut people = frame.sightings.iter();
            if people.any(|it| may_be_on_road(setup, it)) {
                self.occupy(setup.sensors.linger);
            }
            return out.put(Output::Dropped(why));
        }
        let mut is_occupied = false;
        self.tracks.observe(
            setup,
            Origin::Sensor(frame.source),
            frame.age,
            frame.sightings,
            |person| {
                is_occupied |= may_be_on_road(setup, person);
            },
        );
        if is_occupied {
            self.occupancy.owe(setup, frame);
            self.occupy(setup.sensors.linger);
        } else if frame.age.saturating_add(setup.waiting.step_off) < self.quiet {
            self.occupancy.count(setup, frame);
            // One source that is gone keeps the others from settling; the road may be known to be clear without it.
            if self.occupancy.settle(setup) || self.occupancy.is_clear(setup) {
                self.tracks.resolve(self.occupancy.is_covered(setup));
            }
        } else {
            self.occupancy.doubt(frame.source);
        }
    }

    /// Vehicles count also in a frame that comes too late for people: the road beside them is as it was, and they are nearer.
    fn see_vehicles(&mut self, setup: &Setup, frame: &Frame<'_>) {
        for (number, sighting) in (0..).zip(frame.sightings) {
            if traffic::rides(setup, sighting) {
                // A number that several have tells them apart no more than none.
                let mut others = frame.sightings.iter().filter(|it| it.id == sighting.id);
                let id = sighting.id.filter(|_| others.nth(1).is_none());
                // Apart from those of stations and of other sources, and those with a number from those without.
                let key = 1 << 63
                    | u64::from(frame.source) << 33
                    | id.map_or(1 << 32 | number, u64::from);
                let vehicle = traffic::seen(setup, key, sighting);
                self.traffic.hear(setup, vehicle, frame.age);
            }
        }
    }

    /// Another station reports somebody. It adds people, and takes none away. Where the robot has sensors of its own, somebody
    /// whom others report beside the road does not count as on it because their place is inexact: people who wait at the kerb
    /// would keep the road occupied for as long as they wait.
    fn heard(&mut self, setup: &Setup, station: StationId, sighting: Sighting, age: Millis) {
        if age > setup.sensors.age_max.max(crate::tracks::FRESH)
            || sighting.what == RoadUser::Vehicle
        {
            return;
        }
        let has_sources = self.occupancy.has_sources();
        let mut is_occupied = false;
        self.tracks.observe(
            setup,
            Origin::Station(station),
            age,
            &[sighting],
            |person| {
                is_occupied |= if has_sources {
                    setup.is_person_on_road(person.what, person.at, 0)
                } else {
                    may_be_on_road(setup, person)
                };
            },
        );
        if is_occupied {
            self.reported = setup.sensors.heard;
            let linger = setup.sensors.linger;
            self.occupy(if has_sources {
                linger
            } else {
                linger.max(REPORTED)
            });
        }
    }

    /// Something without a class may be a person, and the road is not clear. It is nobody to call for, to let across or to wait for:
    /// it may be a box, and an escort would stand on the road for it.
    fn suspect(&mut self, setup: &Setup, at: Point, out: &mut Outputs) {
        // On the road beside the crossing, such things are parked.
        if !setup.ground.is_road(at) || !setup.is_at_crossing(at, 0) {
            return;
        }
        self.reported = setup.sensors.heard;
        self.doubt_word();
        let keeps_guards = self.has_opened || self.obligation.is_some();
        if keeps_guards && self.sign == Millis::ZERO {
            out.put(Output::Hindered(Hindrance::Object));
        }
    }

    /// A person is on the road, and counts as there for so long. The word of another one that it is clear was said before this.
    fn occupy(&mut self, linger: Millis) {
        self.occupancy.occupy(linger);
        self.doubt_word();
    }

    fn doubt_word(&mut self) {
        if let Some(obligation) = &mut self.obligation {
            obligation.said_clear = Millis::ZERO;
        }
    }

    fn is_at(&mut self, setup: &Setup, pose: Option<Pose>, age: Millis) {
        let is_news = age < setup.position.lease && self.pose.is_none_or(|(_, known)| age <= known);
        if pose.is_none() || is_news {
            self.pose = pose.map(|pose| (pose, age));
        }
        let is_beside = |pose: Pose| !setup.ground.may_be_road(pose.at, pose.error_cm.into());
        if self.pose.is_some_and(|(pose, _)| is_beside(pose)) {
            self.stood = LOOKED;
        }
        if let Some(place) = setup.plan.as_ref().and_then(|plan| plan.own_place) {
            self.own.learn(setup.position, place, pose, age);
        }
        if let Some(task) = &mut self.task {
            task.place = task.place.or(self.pose.map(|(pose, _)| pose.at));
            if let Some(place) = task.place {
                task.presence.learn(setup.position, place, pose, age);
            }
        }
    }

    fn body_reports(&mut self, report: BodyReport) {
        let is_own = |id: ManeuverId, task: &Task| task.maneuver.id == id;
        match (report, &mut self.task) {
            (BodyReport::InPosition(id), Some(task)) if is_own(id, task) => task.has_arrived = true,
            (BodyReport::Completed(id), Some(task)) if is_own(id, task) => task.is_completed = true,
            (BodyReport::Gone, task) => {
                if let Some(task) = task {
                    (task.has_arrived, task.is_completed) = (false, false);
                    task.presence = Presence::NOWHERE;
                }
                // Another one has been told nothing.
                (self.walk, self.waits, self.is_held_at_kerb) = (None, false, false);
            }
            _ => {}
        }
    }

    fn start(&mut self, setup: &Setup, maneuver: Maneuver, place: Option<Point>) {
        // Without a place, the maneuver is done where the body stands.
        let place = place.or(self.pose.map(|(pose, _)| pose.at));
        let mut presence = Presence::NOWHERE;
        if let (Some(place), Some((pose, age))) = (place, self.pose) {
            presence.learn(setup.position, place, Some(pose), age);
        }
        let task = Task {
            maneuver,
            place,
            presence,
            has_arrived: false,
            is_reported: false,
            is_completed: false,
            had_people: false,
        };
        self.begin(Some(task), false);
    }

    /// The body begins a maneuver, a fallback, or to stand still: whatever it did before is over.
    fn begin(&mut self, task: Option<Task>, is_kerbward: bool) {
        (self.task, self.is_kerbward) = (task, is_kerbward);
        (self.walk, self.waits, self.is_held_at_kerb) = (None, false, false);
    }

    /// The body goes somewhere without a maneuver.
    fn walk_to(&mut self, setup: &Setup, to: Point, out: &mut Outputs) {
        (self.walk, self.is_held_at_kerb) = (Some(to), false);
        out.put(Output::WalkTo(to));
        self.set_out(setup, self.walk, out);
    }

    /// The body sets out. It waits until it is known where it is: it may be at the kerb, and a vehicle may come.
    fn set_out(&mut self, setup: &Setup, to: Option<Point>, out: &mut Outputs) {
        self.waits = to.and(setup.ground.road).is_some() && self.pose.is_none();
        if self.waits {
            out.put(Output::Wait);
        }
    }

    /// A robot without a part in a session goes home from the carriageway and from the place of its plan, unless it sees
    /// somebody on the road.
    fn leave_road(&mut self, setup: &Setup, out: &mut Outputs) {
        let (Some(home), Some((pose, _))) = (setup.home, self.pose) else {
            return;
        };
        if !self.has_no_part() || setup.ground.is_road(home) || self.is_looking() {
            return;
        }
        let is_out = setup.ground.is_road(pose.at) || self.walk.is_some();
        if is_out && self.walk != Some(home) && !self.may_be_people() {
            self.walk_to(setup, home, out);
        }
        if pose.at.distance_cm(home) <= u32::from(setup.position.tolerance_cm) {
            self.walk = None;
        }
    }

    /// It stays on the carriageway on which it found itself after its start: it may have lost power in the middle of a crossing,
    /// beside people who count on it. It stays until it knows that nobody is there, and where nothing tells it so, for as long as
    /// people need who set out by the last sign that counted on it. A robot that stands on a lane for ever helps nobody.
    fn look(&mut self, setup: &Setup, time: Millis) {
        if self.pose.is_none() || !self.is_looking() {
            return;
        }
        let mut is_over = false;
        if self.stood < setup.t_safety {
            self.occupancy.start_anew();
            self.quiet = Millis::ZERO;
        } else {
            is_over = self.is_clear(setup);
        }
        self.stood = self.stood.saturating_add(time);
        let set_out = setup.t_safety.saturating_add(setup.waiting.step_off);
        let across = set_out.saturating_add(setup.crossing_time());
        if is_over || self.stood >= across && !self.may_be_people() {
            self.stood = LOOKED;
        }
    }

    /// Whether somebody is on the road, or may be until others report again.
    fn may_be_people(&self) -> bool {
        self.tracks.is_on_road() || self.occupancy.was_seen()
    }

    /// Whether it has not looked yet at the carriageway on which it found itself.
    fn is_looking(&self) -> bool {
        self.stood < LOOKED
    }

    /// Whether its body stays where it found itself on the carriageway, and does not go to a place elsewhere yet.
    fn is_held_by_look(&self, setup: &Setup, to: Point) -> bool {
        let tolerance = u32::from(setup.position.tolerance_cm);
        let is_elsewhere = |(pose, _): (Pose, _)| pose.at.distance_cm(to) > tolerance;
        self.pose.is_some_and(is_elsewhere) && self.is_looking()
    }

    /// Has the body wait on its way, or go on. A body that waits and loses its pose waits on, unless it falls back to the kerb.
    fn watch_way(&mut self, setup: &Setup, out: &mut Outputs) {
        if self.waits && self.pose.is_none() && !self.is_kerbward {
            return;
        }
        let is_escort = |task: &Task| setup.escorts().contains(task.maneuver.task);
        let to = self.task.map_or(self.walk, |task| task.place);
        let to = to.filter(|_| !self.is_kerbward);
        let is_held = to.is_some_and(|to| self.is_held_by_vehicles(setup, to));
        let looks = to.is_some_and(|to| self.is_held_by_look(setup, to));
        let is_on_road = |pose: Pose| setup.ground.is_road(pose.at);
        let is_out = self.pose.is_some_and(|(pose, _)| is_on_road(pose));
        self.is_held_at_kerb = is_held && (self.is_held_at_kerb || !is_out);
        let waits = if self.is_kerbward {
            self.is_person_apart(setup)
        } else {
            is_held
                || looks
                || self.task.as_ref().is_some_and(is_escort) && self.is_person_behind(setup)
        };
        match (self.waits, waits) {
            (false, true) => out.put(Output::Wait),
            (true, false) => out.put(Output::GoOn),
            _ => {}
        }
        self.waits = waits;
    }

    /// Whether the body is to let vehicles pass: at the kerb, on its way on or over the carriageway, and on the carriageway before
    /// another lane, while nobody is on the road or it has no maneuver. Where somebody is on the road, it lets those alone pass that
    /// could not stop by hard braking. A vehicle that may have been missed holds no body on a lane, nor one that somebody needs.
    fn is_held_by_vehicles(&self, setup: &Setup, to: Point) -> bool {
        let (Some(road), Some((pose, _))) = (setup.ground.road, self.pose) else {
            return false;
        };
        let is_urgent = self.tracks.is_on_road();
        let is_out = road.has(pose.at);
        // A body that is told to stand at the kerb may roll over it.
        let may_be_held = if is_out {
            // Nobody needs a guard at once before people are on the road.
            let is_under_way = pose.at.distance_cm(to) > setup.position.tolerance_cm.into();
            self.task.is_none() || self.is_held_at_kerb || !is_urgent && is_under_way
        } else {
            road.distance_cm(pose.at) <= KERB_CM.saturating_add(pose.error_cm.into())
                && road.is_between(pose.at, to)
        };
        let is_missed = self.traffic.is_missed() && !is_urgent && (self.is_held_at_kerb || !is_out);
        let way = [pose.at, to];
        may_be_held
            && (is_missed
                || self
                    .traffic
                    .comes_at(setup, way, is_urgent, self.is_held_at_kerb))
    }

    /// Tells the protocol whether a follower itself sees somebody on the road: at once, for its leader may end the session.
    fn watch_people(&self, setup: &Setup, out: &mut Outputs) {
        if self.standing == Standing::Following && self.occupancy.has_sources() {
            if self.occupancy.owes() && !self.is_person_told {
                out.tell(Event::PersonOnRoad);
            } else if self.is_person_told && !self.sees_somebody(setup) && self.obligation.is_none()
            {
                out.tell(Event::RoadClear);
            }
        }
    }

    /// Tells the protocol how the maneuver of the body goes.
    fn watch_task(&mut self, setup: &Setup, out: &mut Outputs) {
        let sees_somebody = self.sees_somebody(setup);
        let has_people = self.tracks.is_on_road();
        let Some(task) = &mut self.task else { return };
        task.had_people |= has_people;
        let id = task.maneuver.id;
        let is_guarding = setup.guarding.contains(task.maneuver.task);
        if setup.holding.contains(task.maneuver.task) && task.has_arrived {
            if task.presence.is_there() && !task.is_reported {
                out.tell(Event::InPosition(id));
            } else if !task.presence.is_there() && task.is_reported {
                out.tell(Event::OutOfPosition(id));
            }
        } else if task.has_arrived && !task.is_reported {
            out.tell(Event::InPosition(id));
        }
        // A guard is not done before the people that it knows of are off the road.
        if task.is_completed && !(is_guarding && sees_somebody) {
            out.tell(Event::ManeuverCompleted(id));
        }
    }

    /// Whether the robot itself has somebody on the road, a person says so, or it cannot tell any more. Without sensors: whether others say so,
    /// or said so of somebody and fell silent.
    fn sees_somebody(&self, setup: &Setup) -> bool {
        let knows_nothing = if self.occupancy.has_sources() {
            !self.occupancy.sees_nobody(setup)
        } else {
            self.tracks.is_on_road()
        };
        self.is_person_said || self.occupancy.was_seen() || knows_nothing
    }

    /// Whether the robot sees somebody on the road who is too far from the body for it to go on to the kerb. Whom it has lost, it
    /// does not wait for in the middle of the road.
    fn is_person_apart(&self, setup: &Setup) -> bool {
        let limit = u32::from(setup.position.ahead_cm);
        let is_far = |at: Point| {
            self.pose
                .is_none_or(|(pose, _)| at.distance_cm(pose.at) > limit)
        };
        let mut people = self.tracks.iter();
        people.any(|it| {
            // Others report seldom.
            let is_known = it.is_fresh() || it.is_hearsay() && self.occupancy.was_seen();
            is_known && it.is_on_road() && it.is_crossing(setup) && is_far(it.at())
        })
    }

    /// Whether somebody who is escorted is too far behind the body: on the road, or at the kerb for as long as nobody
    /// was on the road. Go may be over by then, and an escort that waited for the next one would stand on the road.
    fn is_person_behind(&self, setup: &Setup) -> bool {
        let Some((task, target)) = self.task.as_ref().and_then(|it| Some((it, it.place?))) else {
            return false;
        };
        // A body that does not know where it is may be ahead of everybody.
        let is_behind = |at: Point| {
            self.pose.is_none_or(|(pose, _)| {
                let own = pose.at.distance_cm(target);
                at.distance_cm(target) > own.saturating_add(u32::from(setup.position.ahead_cm))
            })
        };
        // Sensors that cover the road have a person themselves whose own reports are lost.
        let is_covered = self.occupancy.is_covered(setup);
        let is_somebody = |it: &&Track| {
            let is_known = it.is_fresh() || !(is_covered && it.is_hearsay());
            it.is_on_road() && it.is_crossing(setup) && is_known
        };
        let mut on_road = self.tracks.iter().filter(is_somebody).peekable();
        if on_road.peek().is_some() {
            return on_road.any(|track| is_behind(track.at()));
        }
        let mut waiting = self.tracks.iter().filter(|track| track.waits());
        !task.had_people && waiting.any(|track| is_behind(track.at()))
    }

    fn notice(&mut self, setup: &Setup, notice: Notice, out: &mut Outputs) {
        let Some(plan) = &setup.plan else { return };
        if let Notice::RolesEstablished(_) = notice {
            self.own = Presence::NOWHERE;
            if let Some(place) = plan.own_place {
                self.walk_to(setup, place, out);
                if let Some((pose, age)) = self.pose {
                    self.own.learn(setup.position, place, Some(pose), age);
                }
            }
            self.lead = Some(Lead::new(plan, self.turned));
        }
        if let (Some(view), Some(lead)) = (self.view(setup), &mut self.lead)
            && !lead.notice(&view, notice, out)
        {
            self.lead = None;
        }
    }

    fn lead_on(&mut self, setup: &Setup, out: &mut Outputs) {
        if let (Some(view), Some(lead)) = (self.view(setup), &mut self.lead)
            && self.standing == Standing::Leading
            && !lead.lead_on(&view, out)
        {
            self.lead = None;
        }
    }

    /// The beliefs that a leader goes by, if it has a plan.
    fn view<'a>(&self, setup: &'a Setup) -> Option<View<'a>> {
        let knows = self.occupancy.has_sources() && setup.ground.waiting.is_some();
        Some(View {
            setup,
            plan: setup.plan.as_ref()?,
            corridor: self.corridor,
            own: self.own,
            hindrance: self.hindrance(setup),
            stop_line: self.unpromised(setup).map(|(_, line)| line),
            is_wanted: !knows || self.is_wanted(),
            has_opened: self.has_opened,
            has_crossed: self.has_crossed,
            everybody_is_across: self.is_clear(setup) && !self.is_wanted(),
            nobody_is_lost: self.is_clear(setup)
                && !self.occupancy.was_seen()
                && !self.tracks.is_somebody_lost(),
            was_seen: self.occupancy.was_seen(),
        })
    }

    /// The cause that keeps people from crossing, besides the plan.
    fn hindrance(&self, setup: &Setup) -> Option<Hindrance> {
        if self.is_kept_closed {
            return Some(Hindrance::KeptClosed);
        }
        if setup.watches && !self.occupancy.is_watched(setup) {
            return Some(Hindrance::NoSight);
        }
        if let Some(vehicle) = self.traffic.hindrance(setup) {
            return Some(Hindrance::Vehicle(vehicle));
        }
        if self.traffic.is_missed() && setup.ground.where_people_cross().is_some() {
            return Some(Hindrance::Missed);
        }
        let unpromised = self.unpromised(setup);
        unpromised.map(|(station, _)| Hindrance::NoPromise(station))
    }

    /// The vehicle that is to say that it will stop, and where. Go that has begun stays for people who rely on it.
    fn unpromised(&self, setup: &Setup) -> Option<(StationId, Point)> {
        let begins = self.sign == Millis::ZERO;
        self.traffic.unpromised(setup).filter(|_| begins)
    }

    /// The cause that keeps people from crossing now, if there is one.
    #[must_use]
    pub fn hindered(&self, setup: &Setup) -> Option<Hindrance> {
        match (self.view(setup), &self.lead) {
            (Some(view), Some(lead)) => lead.hindrance(&view),
            _ => self.hindrance(setup),
        }
    }

    /// Closes an open corridor in the step in which something keeps people from crossing.
    fn guard_corridor(&mut self, setup: &Setup, out: &mut Outputs) {
        if self.corridor != Corridor::Open && self.sign == Millis::ZERO {
            return;
        }
        if let Some(why) = self.hindered(setup) {
            self.show_stop(out);
            out.put(Output::Hindered(why));
            out.tell(Event::CloseCorridor);
        }
    }

    fn show_go(&mut self, setup: &Setup, left: Millis, out: &mut Outputs) {
        self.has_opened = true;
        if let Some(why) = self.hindered(setup) {
            self.show_stop(out);
            out.put(Output::Hindered(why));
            return out.tell(Event::CloseCorridor);
        }
        let there = match (self.view(setup), &self.lead) {
            (Some(view), Some(lead)) => lead.presence_left(&view),
            _ => left,
        };
        self.sign = left.min(there);
        out.put(Output::Go(self.sign));
        self.hold_count();
    }

    fn show_stop(&mut self, out: &mut Outputs) {
        self.sign = Millis::ZERO;
        out.put(Output::Stop);
    }

    /// Says that the road is clear as soon as that is so: the body is free, and nobody is on the road as far as the
    /// robot's sensors or a person know.
    fn watch_road(&mut self, setup: &Setup, out: &mut Outputs) {
        let Some(obligation) = self.obligation else {
            return;
        };
        let lets_nobody_cross = match obligation.about {
            About::Duty(Duty::FallingBack(maneuver)) => !setup.guarding.contains(maneuver.task),
            About::Duty(Duty::Crossing(_)) | About::Clearing => false,
        };
        let is_clear = obligation.said_clear > Millis::ZERO
            || lets_nobody_cross
            || obligation.wait == Millis::ZERO && self.is_clear(setup);
        if is_clear && !self.is_falling_back {
            out.tell(Event::RoadClear);
        }
    }

    /// Whether it is in no session and has no duty, and its body is its own to command.
    const fn has_no_part(&self) -> bool {
        matches!(self.standing, Standing::Free | Standing::Resting)
    }

    /// Whether the session is one that it called for.
    const fn is_own(&self) -> bool {
        matches!(self.standing, Standing::Requesting | Standing::Leading)
    }

    /// Whether somebody wants to cross, or is on the road.
    fn is_wanted(&self) -> bool {
        self.occupancy.was_seen() || self.tracks.is_waiting()
    }

    /// Calls for help when somebody waits to cross, and ends the call when everybody has left before they were let
    /// across.
    fn watch_zone(&mut self, setup: &Setup, out: &mut Outputs) {
        if setup.calls
            && let Some(urgency) = self.tracks.urgency()
            && self.standing == Standing::Free
            && !self.is_called
            && self.call_pause == Millis::ZERO
        {
            (self.is_called, self.call_pause) = (true, CALL_PERIOD);
            self.turned = match (&setup.plan, self.tracks.middle()) {
                (Some(plan), Some(people)) => plan.begins_over_there(people),
                _ => false,
            };
            let request = HelpRequest {
                urgency,
                ..setup.request
            };
            return out.tell(Event::PedestrianDetected(request));
        }
        let may_end = match self.standing {
            Standing::Requesting => true,
            // Once guards are commanded the plan goes to its end, and they are free then: a session that is left
            // would have them wait for somebody's word that the road is clear. Without a plan, somebody else says
            // when the task is over.
            Standing::Leading => self.is_preparing(setup) && self.corridor == Corridor::Clear,
            Standing::Free | Standing::Resting | Standing::Following | Standing::Bound => false,
        };
        let is_wanted = self.wanted > Millis::ZERO || self.is_wanted();
        if self.is_called && may_end && !self.has_opened && !is_wanted {
            out.tell(Event::LeaveRequested);
        }
    }

    /// Whether its plan is in a stage before the last one, and nobody guards yet.
    fn is_preparing(&self, setup: &Setup) -> bool {
        match (&setup.plan, &self.lead) {
            (Some(plan), Some(lead)) => {
                let stage = lead.stage();
                !plan.is_last(stage) && !plan.guards_by(stage, setup.guarding)
            }
            _ => false,
        }
    }

    /// The call is over, or had no effect.
    fn end_call(&mut self) {
        (self.is_called, self.has_opened, self.has_crossed) = (false, false, false);
        (self.turned, self.is_kept_closed) = (false, false);
        self.call_pause = CALL_PERIOD;
    }

    /// It is somewhere else: what it knew of people and vehicles says nothing of this place.
    pub fn come_elsewhere(&mut self) {
        self.tracks = Tracks::default();
        self.occupancy = Occupancy::default();
        self.reported = Millis::ZERO;
        self.traffic = Traffic::default();
    }

    /// The people that it knows of.
    #[must_use]
    pub const fn tracks(&self) -> &Tracks<N> {
        &self.tracks
    }

    /// Its beliefs about the carriageway.
    #[must_use]
    pub const fn occupancy(&self) -> &Occupancy {
        &self.occupancy
    }

    /// Whether the road is known to be clear: by its sensors, and neither others nor a person report somebody there.
    #[must_use]
    pub fn is_clear(&self, setup: &Setup) -> bool {
        self.reported == Millis::ZERO && !self.is_person_said && self.occupancy.is_clear(setup)
    }

    /// For how long yet its sign shows go.
    #[must_use]
    pub const fn shows_go(&self) -> Millis {
        self.sign
    }

    /// Whether it waits for a clear road.
    #[must_use]
    pub const fn waits_for_clear(&self) -> bool {
        self.obligation.is_some()
    }
}

/// The maneuver of another robot's session that the robot executes.
fn executing(robot: &Robot) -> Option<Maneuver> {
    match robot.phase() {
        Phase::Following(following) => following.executing(),
        _ => None,
    }
}

/// Whether somebody may be a person on the carriageway.
fn may_be_on_road(setup: &Setup, sighting: &Sighting) -> bool {
    let error = sighting.error_cm.max(setup.sensors.error_cm);
    setup.is_person_on_road(sighting.what, sighting.at, u32::from(error))
}
