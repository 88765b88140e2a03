//! The application of a robot: its crossing machine, and what joins it to body, sign and endpoint.
//!
//! ```text
//!   frames, lines ──┐                     ┌──► wishes: events and commands for the endpoint
//!   body, poses ────┼──► crossing machine ┼──► sign
//!   RAM, CAM, VAM ──┘                     └──► body
//! ```
//!
//! `crossguard-crossing` decides about people, guards, vehicles and the plan.

mod bodily;
mod objects;
mod senses;
mod traits;

use std::collections::VecDeque;

use crossguard_codec::{PublicSignal, TaskParameters};
use crossguard_crossing::tracks::Conduct;
use crossguard_crossing::{
    Crossing, FrameDrop, Hindrance, Input, Leg, Output, Outputs, Sensors, Setup,
};
use crossguard_endpoint::cause::Cause;
use crossguard_endpoint::{Effect, Served, Stimulus};
use crossguard_protocol::{
    self as protocol, Availability, Config, Duty, Event, Millis, Notice, Phase, Robot, StationId,
    TaskSet, Unavailability,
};

use self::bodily::Bodily;
use self::senses::Said;
pub use self::traits::Traits;
use crate::body::{Body, BodyAct, Fallback};
use crate::plan::{Plan, millis};
use crate::sight::Outline;
use crate::sign::{Shown, Sign};
use crate::site::{Place, Site};
use crate::street::Road;
use crate::zone::{place, point};

/// How far from a crossing a robot is that asks for help there, in metres at most: its sensors have the people who wait.
const ASKS_WITHIN_M: f64 = 50.0;

/// The longest list of wishes; more are dropped and counted, unless nothing repeats them.
const WISHES: usize = 64;

/// The application of a robot: a body, a sign, and a crossing machine.
#[derive(Debug)]
pub struct Application {
    pub(crate) body: Box<dyn Body>,
    /// What people see while it leads.
    sign: Sign,
    /// Signals to people, as its robot's RAM report them.
    shown: Shown,
    /// Whether its robot asks for help or leads, so that people look at its sign.
    pub(crate) faces_people: bool,
    /// Whether it counts on the people of a simulation that it keeps: it leads, or its crossing is not over.
    counts: bool,
    /// Its knowledge of the people on the road.
    road: Road,
    site: Site,
    /// Its plan for leading; without one, somebody else tells it.
    plan: Option<Plan>,
    setup: Box<Setup>,
    crossing: Box<Crossing>,
    /// The reason that keeps people from crossing, as told last.
    hindrance: Option<Hindrance>,
    /// The same, until it is logged.
    untold_hindrance: Option<Hindrance>,
    said: Said,
    traits: Traits,
    availability: Availability,
    /// Whether its body is there, and what was wrong with it.
    bodily: Bodily,
    /// Whether it is unavailable because its battery was found to be low.
    was_low: bool,
    /// When its battery was heard of last, or when it was to be from then on, in seconds.
    battery_heard_s: Option<f64>,
    wishes: VecDeque<Stimulus<'static>>,
    at_s: f64,
    at_ms: u64,
}

impl Application {
    /// The application of a robot with this body, which knows nothing of the road.
    #[must_use]
    pub fn new(body: Box<dyn Body>, plan: Option<Plan>) -> Self {
        let application = Self {
            body,
            sign: Sign::default(),
            shown: Shown::default(),
            faces_people: false,
            counts: false,
            road: Road::default(),
            site: plan.as_ref().map_or_else(Site::default, |plan| plan.site),
            plan,
            setup: Box::default(),
            crossing: Box::default(),
            hindrance: None,
            untold_hindrance: None,
            said: Said::default(),
            traits: Traits::default(),
            availability: Availability::Available,
            bodily: Bodily::default(),
            was_low: false,
            battery_heard_s: None,
            wishes: VecDeque::new(),
            at_s: 0.0,
            at_ms: 0,
        };
        application.set_up()
    }

    /// The same, which knows this of the road.
    #[must_use]
    pub fn on(self, road: Road) -> Self {
        Self { road, ..self }.set_up()
    }

    /// The same, whose places are on this site.
    #[must_use]
    pub fn at(self, site: Site) -> Self {
        Self { site, ..self }.set_up()
    }

    /// The same, whose body waits there when it has no part in a session, and goes back there from the carriageway.
    #[must_use]
    pub fn with_home(mut self, home: Place) -> Self {
        self.setup.home = Some(point(home));
        self
    }

    /// Replaces its knowledge of the road, because the robot has come to another place.
    pub fn come_to(&mut self, road: Road) {
        self.road = road;
        *self.setup = self.crossing_setup();
        self.crossing.come_elsewhere();
    }

    fn set_up(mut self) -> Self {
        *self.setup = self.crossing_setup();
        self
    }

    fn crossing_setup(&self) -> Setup {
        let plan = self.plan.as_ref();
        let request = plan.map_or_else(|| Plan::crossing(self.site).request(), Plan::request);
        let mut setup = self.road.set_up(Setup {
            plan: plan.map(Plan::lead),
            request,
            ..(*self.setup).clone()
        });
        setup.traffic.asks = plan.map_or(Millis::ZERO, |plan| millis(plan.asks_vehicles_s));
        setup.sensors.speed_max_cmps =
            scaled(Sensors::default().speed_max_cmps, self.body.time_scale());
        setup
    }

    /// How many times as fast as real its body moves.
    pub(crate) fn time_scale(&self) -> f64 {
        self.body.time_scale()
    }

    /// The outline of its crossing zone, if it knows people in one.
    #[must_use]
    pub fn zone(&self) -> Option<Outline> {
        let zone = self.road.zone()?;
        Some(Outline::of(&zone, &self.site))
    }

    /// The crossing at which it helps, if it knows one: its beliefs of the road are about that one.
    pub(crate) fn served(&self) -> Option<Served> {
        let (Road::Watched(_) | Road::Heard(_)) = self.road else {
            return None;
        };
        let crossing = self.setup.ground.where_people_cross()?;
        Some(Served {
            place: self.site.crossing,
            middle: self.site.position(place(crossing.middle())),
            within_m: f64::from(crossing.reach_cm()) / 100.0 + ASKS_WITHIN_M,
        })
    }

    /// The tasks that every follower of its plan is to do.
    pub(crate) fn needs(&self) -> TaskSet {
        self.plan.as_ref().map_or(TaskSet::EMPTY, Plan::needs)
    }

    /// Its sign.
    #[must_use]
    pub const fn sign(&self) -> &Sign {
        &self.sign
    }

    /// Lets time pass until `now_s`, in seconds on any clock that never goes back.
    pub fn advance(&mut self, now_s: f64) {
        let reports = self.body.advance((now_s - self.at_s).max(0.0));
        self.at_s = now_s;
        for report in reports {
            self.learn_of_body(report);
        }
        self.watch_body();
        let passed = self.pass_time(now_s);
        self.step(Input::Elapsed(passed));
        self.feel_body();
        if passed > Millis::ZERO {
            self.look_at_street();
        }
        self.watch_battery();
    }

    /// The time since the last call, in whole milliseconds.
    fn pass_time(&mut self, now_s: f64) -> Millis {
        let before_ms = self.at_ms;
        self.at_ms = micros(now_s) / 1_000;
        let passed = self.at_ms.saturating_sub(before_ms);
        Millis(u32::try_from(passed).unwrap_or(u32::MAX))
    }

    /// Hands an input to the crossing machine, and does what it says.
    fn step(&mut self, input: Input<'_>) {
        let outputs = self.crossing.step(&self.setup, input);
        self.carry_out(&outputs);
    }

    fn carry_out(&mut self, outputs: &Outputs) {
        for output in outputs.iter() {
            match *output {
                Output::Tell(event) => self.wish(Stimulus::Event(event)),
                Output::Order(follower, leg) => self.order(follower, leg),
                Output::Ask(vehicle, line) => self.wish(Stimulus::Ask {
                    vehicle,
                    parameters: TaskParameters {
                        target: Some(self.site.target(place(line))),
                        map_place: self.site.map_place,
                        ..TaskParameters::default()
                    },
                }),
                Output::Go(time) => {
                    self.hindrance = None;
                    self.sign.go(micros(self.at_s), time);
                }
                Output::Stop => self.sign.stop(),
                Output::WalkTo(to) => {
                    let plan = self.plan.as_ref();
                    let is_own = |plan: &&Plan| plan.own_place.map(point) == Some(to);
                    let heading_deg = plan.filter(is_own).and_then(|plan| plan.own_heading_deg);
                    self.body.walk_to(place(to), heading_deg);
                }
                Output::Wait => self.act_by_body(BodyAct::Wait),
                Output::GoOn => self.act_by_body(BodyAct::GoOn),
                Output::Release => self.body.release(),
                // It was counted when it came, with what is wrong with it.
                Output::Dropped(FrameDrop::Malformed) => {}
                Output::Dropped(why) => self.trouble(Cause::FrameDropped(why.name()), "a frame", 1),
                Output::Hindered(why) => self.is_hindered(why),
                Output::SaidTooEarly => self.trouble(Cause::SaidTooEarly, "clear", 1),
            }
        }
    }

    fn order(&mut self, follower: StationId, leg: Leg) {
        let site = &self.site;
        let parameters = TaskParameters {
            target: Some(site.target(place(leg.to))),
            maximum_speed: Some(f64::from(leg.speed_mmps) / 1e3),
            heading: leg.heading_ddeg.map(|tenths| f64::from(tenths) / 10.0),
            map_place: site.map_place,
            ..TaskParameters::default()
        };
        self.wish(Stimulus::Command {
            follower,
            task: leg.task,
            parameters,
        });
    }

    /// Tells a person once why nobody may cross any more, or why guards stay.
    fn is_hindered(&mut self, why: Hindrance) {
        if self.hindrance.replace(why) != Some(why) {
            self.untold_hindrance = Some(why);
        }
    }

    /// Why nobody may cross any more, to be logged.
    pub(crate) fn next_hindrance(&mut self) -> Option<String> {
        Some(self.untold_hindrance.take()?.to_string())
    }

    /// Takes in what the protocol knows after a step.
    pub fn learn(&mut self, robot: &Robot, config: &Config) {
        self.setup.learn(config);
        self.availability = robot.availability();
        let leads = matches!(robot.phase(), Phase::Leading(_));
        self.faces_people = leads || matches!(robot.phase(), Phase::Requesting(_));
        self.shown.holds_back = self.holds_back(robot);
        let counts = leads || matches!(robot.duty(), Some(Duty::Crossing(_)));
        if std::mem::replace(&mut self.counts, counts)
            && !counts
            && matches!(self.road, Road::Own(_))
        {
            self.crossing.come_elsewhere();
        }
        let waited = self.crossing.waits_for_clear();
        let outputs = self.crossing.learn(&self.setup, robot);
        self.carry_out(&outputs);
        if !waited && self.crossing.waits_for_clear() {
            // It was said of what the robot's own sensors see, and not of the duty that has begun since.
            let is_clear = |it: &Stimulus<'_>| matches!(it, Stimulus::Event(Event::RoadClear));
            self.wishes.retain(|it| !is_clear(it));
        }
    }

    /// Signal by which a robot holds vehicles back: that of its plan while it leads, and stop at its place as a guard.
    /// Neither ends before the road is clear.
    fn holds_back(&self, robot: &Robot) -> Option<PublicSignal> {
        let duty = robot.duty();
        let maneuver = match (robot.phase(), duty) {
            (Phase::Leading(_), _) | (_, Some(Duty::Crossing(_))) => {
                return self.plan.as_ref()?.shows;
            }
            (Phase::Following(following), _) if following.executing().is_some() => {
                following.executing()
            }
            (_, Some(Duty::FallingBack(maneuver))) => Some(maneuver),
            _ => None,
        };
        let holds = self.setup.holding.contains(maneuver?.task);
        holds.then_some(PublicSignal::Stop)
    }

    /// A person says that the road is clear. Whether there is something that waits for it.
    pub fn say_clear(&mut self) -> bool {
        let waits = self.crossing.waits_for_clear();
        self.step(Input::SaidClear);
        waits
    }

    /// Somebody else than the application tells the protocol this.
    pub(crate) fn say(&mut self, event: Event) {
        self.step(Input::Said(event));
    }

    /// A person says that everybody is across. Whether that counts: not while go is shown, nor while the robot's own sensors have
    /// somebody on the road.
    pub fn say_completed(&mut self) -> bool {
        let shows_go = self.sign.shows_go(micros(self.at_s));
        let counts = !shows_go && !self.crossing.occupancy().owes();
        if !counts {
            self.trouble(Cause::SaidTooEarly, "task-completed", 1);
        }
        counts
    }

    /// Whether its body moves by no fallback.
    fn is_body_free(&self) -> bool {
        match self.body.fallback() {
            None | Some(Fallback::Holding | Fallback::Finished) => true,
            Some(Fallback::UnderWay) => false,
        }
    }

    /// The body.
    #[must_use]
    pub fn body(&self) -> &dyn Body {
        &*self.body
    }

    /// The next thing that the application wants of its endpoint.
    pub fn next_wish(&mut self) -> Option<Stimulus<'static>> {
        self.next_availability().or_else(|| self.wishes.pop_front())
    }

    /// Wants this of its endpoint. A wish that repeats the last one takes no place: each of many vehicles may close the corridor. One
    /// that nothing repeats always finds a place.
    fn wish(&mut self, wish: Stimulus<'static>) {
        use Event::{LeaveRequested, ManeuverFailed, PedestrianDetected, TaskCompleted};
        let is_once = matches!(
            wish,
            Stimulus::Event(
                PedestrianDetected(_) | ManeuverFailed(_) | LeaveRequested | TaskCompleted
            )
        );
        if self.wishes.back() == Some(&wish) {
            return;
        }
        if is_once || self.wishes.len() < WISHES {
            self.wishes.push_back(wish);
        } else {
            self.trouble(Cause::WishesFull, "an event or a command", 1);
        }
    }

    /// Ends the motion of the body, whatever it is.
    pub fn stop(&mut self) {
        self.step(Input::Stopped);
        self.body.halt();
    }

    /// Something pushes the body off its place: see [`Body::push`].
    pub fn push(&mut self, by_m: [f64; 2]) {
        self.body.push(by_m);
    }

    /// Does what the endpoint says.
    pub fn act(&mut self, effect: &Effect) {
        let (output, parameters) = match effect {
            Effect::Act(output, parameters) => (*output, parameters),
            Effect::Ignored(Event::PedestrianDetected(_), _) => {
                return self.step(Input::CallIgnored);
            }
            Effect::VehicleAnswered(station, promises) => {
                return self.step(Input::Answered(*station, *promises));
            }
            Effect::Dropped { cause, .. } => return self.miss(*cause),
            _ => return,
        };
        match output {
            protocol::Output::StartManeuver(maneuver) => {
                let target = self.target(parameters);
                self.act_by_body(BodyAct::Start(maneuver, *parameters));
                self.step(Input::Started(maneuver, target));
            }
            protocol::Output::StopManeuver(maneuver, why) => {
                self.step(Input::Stopped);
                self.act_by_body(BodyAct::Stop(maneuver, why));
            }
            protocol::Output::FallBack(maneuver, policy) => {
                self.step(Input::FellBack(maneuver, policy));
                self.act_by_body(BodyAct::FallBack(maneuver, policy));
            }
            protocol::Output::Notify(notice) => self.notice(notice),
            protocol::Output::CorridorOpened(time) | protocol::Output::CorridorExtended(time) => {
                self.step(Input::CorridorOpen(time));
            }
            protocol::Output::CorridorClosed(_) => self.step(Input::CorridorClosed),
            _ => {}
        }
    }

    fn notice(&mut self, notice: Notice) {
        if let (Notice::RolesEstablished(_), Some(plan), Road::Own(street)) =
            (notice, &self.plan, &self.road)
        {
            street.arrive(plan.crossing_us(self.body.time_scale()), plan.sides());
        }
        self.step(Input::Notice(notice));
    }

    /// Hands an act to the body. One that is not taken is a fault of the robot, which says so before anything
    /// else: a body that was not stopped may still move.
    fn act_by_body(&mut self, act: BodyAct) {
        let Err(error) = self.body.act(act) else {
            return;
        };
        self.trouble(Cause::BodyFault, error.to_string(), 1);
        self.wish_available(Availability::Unavailable(Unavailability::LocalFault));
    }
}

/// A speed where time passes this many times as fast.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "casts of numbers saturate"
)]
fn scaled(speed: u16, time_scale: f64) -> u16 {
    (f64::from(speed) * time_scale) as u16
}

/// Microseconds on the same clock.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clocks show centuries at most, and nothing below 0"
)]
fn micros(seconds: f64) -> u64 {
    (seconds * 1e6) as u64
}

#[cfg(test)]
mod tests;
