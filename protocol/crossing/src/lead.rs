//! How a plan goes while its robot leads: who has which part, what is commanded, and when that is done.

use crossguard_protocol::{
    Corridor, Event, Failure, List, MAX_FOLLOWERS, Millis, Notice, Rejection, StationId,
};

use crate::crossing::Sink;
use crate::ground::Point;
use crate::input::{Hindrance, Output, Outputs, Pose};
use crate::plan::{Leg, Plan};
use crate::position::Presence;
use crate::setup::Setup;

/// How often a leg that failed is commanded again before the leader gives up.
const ATTEMPTS: u8 = 3;

/// How long a leader waits at least between a command and the same one again.
const AGAIN: Millis = Millis(500);

/// How long a leader waits before it asks again for an open corridor or an escort.
const OPENING_PERIOD: Millis = Millis(500);

/// For how long after the first go of a session people step on the road. A person who comes later is called for anew: a stream of
/// people would keep the team, and vehicles, until its execution limit.
const STEP_ON: Millis = Millis(20_000);

/// The same beside an escort, which waits for each of them.
const STEP_ON_ESCORTED: Millis = Millis(10_000);

/// For how long an escort goes on to its kerb after everybody is across.
const ESCORT_ENDS: Millis = Millis(5_000);

/// How far a follower is with its part of the stage.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
enum Part {
    /// Commanded so often; not begun, or under way.
    Commanded(u8),
    /// Goes on until it is ended.
    Holds,
    /// Done, or nothing to do.
    Done,
}

/// A seat of the plan: a role, or the next place in the row.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
struct Seat {
    station: Option<StationId>,
    part: Part,
    /// Its leg is to be commanded again, as soon as that is not too soon.
    again: bool,
    /// It said that it has left its place.
    has_left: bool,
    /// Until then it is too soon.
    pause: Millis,
    presence: Presence,
}

impl Seat {
    const EMPTY: Self = Self {
        station: None,
        part: Part::Done,
        again: false,
        has_left: false,
        pause: Millis::ZERO,
        presence: Presence::NOWHERE,
    };

    /// Whether it has done its part, or holds it.
    const fn is_ready(&self) -> bool {
        !matches!(self.part, Part::Commanded(_))
    }
}

/// How a plan goes.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(crate) struct Lead {
    stage: u8,
    /// Whether the plan goes the other way round between its kerbs.
    turned: bool,
    seats: List<Seat, MAX_FOLLOWERS>,
    /// Until then it does not ask for an open corridor again.
    tried: Millis,
    /// After that time it gives up.
    patience: Millis,
    /// Until then people step on the road.
    opened: Millis,
    /// Until then it waits for its escort to come to the kerb, after everybody is across.
    ending: Millis,
}

/// The plan of a leader, and its other beliefs.
#[derive(Clone, Copy, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "each is a belief of its own")]
pub(crate) struct View<'a> {
    pub setup: &'a Setup,
    pub plan: &'a Plan,
    pub corridor: Corridor,
    /// Whether the robot's own body is where the plan wants it.
    pub own: Presence,
    /// Another cause that keeps people from crossing.
    pub hindrance: Option<Hindrance>,
    /// Where the vehicle is to stop that is a hindrance until it has said so.
    pub stop_line: Option<Point>,
    /// Whether somebody wants to cross, or is not known not to.
    pub is_wanted: bool,
    /// Whether somebody was let across in the session.
    pub has_opened: bool,
    /// Whether somebody was on the road since.
    pub has_crossed: bool,
    /// Whether everybody who wanted to cross is known to be across.
    pub everybody_is_across: bool,
    /// Whether the road is clear, and everybody who waited is still seen.
    pub nobody_is_lost: bool,
    /// Whether somebody was on the road a moment ago.
    pub was_seen: bool,
}

impl View<'_> {
    /// Whether a leg guards from a place.
    fn holds(&self, leg: Option<Leg>) -> bool {
        leg.is_some_and(|leg| self.setup.holding.contains(leg.task))
    }

    /// Whether a leg takes a person on the road.
    fn escorts(&self, leg: Option<Leg>) -> bool {
        leg.is_some_and(|leg| self.setup.escorts().contains(leg.task))
    }
}

impl Lead {
    pub(crate) fn new(plan: &Plan, turned: bool) -> Self {
        let seats = plan.roles.iter().map(|_| Seat::EMPTY);
        Self {
            stage: 0,
            turned,
            seats: seats.collect(),
            tried: Millis::ZERO,
            patience: plan.patience,
            opened: STEP_ON,
            ending: ESCORT_ENDS,
        }
    }

    /// The stage that it is in.
    pub(crate) const fn stage(&self) -> u8 {
        self.stage
    }

    pub(crate) fn elapse(&mut self, setup: &Setup, time: Millis) {
        self.tried = self.tried.saturating_sub(time);
        self.patience = self.patience.saturating_sub(time);
        self.opened = self.opened.saturating_sub(time);
        self.ending = self.ending.saturating_sub(time);
        for seat in self.seats.iter_mut() {
            seat.pause = seat.pause.saturating_sub(time);
            seat.presence.elapse(setup.position, time);
        }
    }

    fn leg(&self, plan: &Plan, seat: usize) -> Option<Leg> {
        plan.leg(self.stage, seat, self.turned)
    }

    fn seat_of(&self, station: StationId) -> Option<usize> {
        let mut seats = self.seats.iter();
        seats.position(|seat| seat.station == Some(station))
    }

    fn at(&mut self, seat: usize) -> Option<&mut Seat> {
        self.seats.iter_mut().nth(seat)
    }

    /// Takes in where a follower says that it is.
    pub(crate) fn follower_is_at(
        &mut self,
        setup: &Setup,
        plan: &Plan,
        station: StationId,
        pose: Option<Pose>,
        age: Millis,
    ) {
        let Some(seat) = self.seat_of(station) else {
            return;
        };
        let Some(leg) = self.held_leg(plan, seat) else {
            return;
        };
        if let Some(seat) = self.at(seat) {
            seat.presence.learn(setup.position, leg.to, pose, age);
        }
    }

    /// The leg of this stage, or else the newest one before it: who has no part in a stage stays where its last one led.
    fn held_leg(&self, plan: &Plan, seat: usize) -> Option<Leg> {
        let mut stages = (0..=self.stage).rev();
        stages.find_map(|stage| plan.leg(stage, seat, self.turned))
    }

    /// The leg that a follower carries out: that of the stage, or else the place of an earlier one from which it guards.
    fn due_leg(&self, view: &View<'_>, seat: usize) -> Option<Leg> {
        let held = || self.held_leg(view.plan, seat);
        let leg = self.leg(view.plan, seat);
        leg.or_else(|| held().filter(|held| view.holds(Some(*held))))
    }

    /// Takes in what the protocol tells. `false` when the plan is over.
    pub(crate) fn notice(&mut self, view: &View<'_>, notice: Notice, out: &mut Outputs) -> bool {
        match notice {
            Notice::FollowerJoined(station) => self.seat(view, station, out),
            Notice::ManeuverReported(station, _) => {
                self.goes_on(station);
                self.open(view, out);
            }
            Notice::ManeuverInPosition(station, _) => {
                self.in_position(view, station, out);
            }
            Notice::ManeuverCompleted(station, _) => {
                self.completed(view, station, out);
            }
            // It will not do it, however often it is told.
            Notice::ManeuverFailed(_, _, Failure::Unavailable(_))
            | Notice::CommandRejected(
                _,
                _,
                Rejection::Unavailable(_) | Rejection::UnsupportedTask,
            ) => {
                out.tell(Event::LeaveRequested);
                return false;
            }
            // The protocol takes no guard off a road on which there may be people: it is commanded back when that is clear.
            Notice::ManeuverFailed(station, _, Failure::ExecutionLimit)
                if view.corridor != Corridor::Clear && self.holds(station) =>
            {
                self.goes_on(station);
            }
            Notice::ManeuverFailed(station, ..)
            | Notice::FollowerSafeIdle(station, _)
            | Notice::CommandRejected(station, ..) => {
                self.again(station);
                self.command_again(view, out);
            }
            Notice::FollowerGone(station, _) => self.miss(view.plan, station, out),
            // The session ends once the road is clear.
            Notice::Yielded(_) | Notice::SessionEnded(..) => return false,
            _ => {}
        }
        self.finish_stage(view, out);
        true
    }

    /// Gives a follower its seat in the plan: its role, the first one that is for any, or the next place in the row.
    fn seat(&mut self, view: &View<'_>, station: StationId, out: &mut Outputs) {
        let roles = || view.plan.roles.iter();
        let is_free = |(seat, taken): (usize, &Seat)| {
            let role = roles().nth(seat);
            taken.station.is_none() && role.is_none_or(Option::is_none)
        };
        let seat = self.seat_of(station);
        let seat = seat.or_else(|| roles().position(|role| *role == Some(station)));
        let seat = seat.or_else(|| self.seats.iter().enumerate().position(is_free));
        let seat = match seat {
            Some(seat) => seat,
            None if self.seats.push(Seat::EMPTY).is_ok() => self.seats.len() - 1,
            None => return,
        };
        if let Some(it) = self.at(seat) {
            *it = Seat {
                station: Some(station),
                ..Seat::EMPTY
            };
        }
        self.begin_part(view, seat, out);
    }

    fn begin_part(&mut self, view: &View<'_>, seat: usize, out: &mut Outputs) {
        if let Some(it) = self.at(seat) {
            it.part = Part::Commanded(0);
            it.presence = Presence::NOWHERE;
        }
        self.command(view, seat, out);
    }

    /// Whether a follower guards from a place.
    fn holds(&self, station: StationId) -> bool {
        let seat = self.seat_of(station);
        seat.is_some_and(|seat| self.is(seat, |it| it.part == Part::Holds))
    }

    /// A guard has left its place again, or counts as one that has.
    fn goes_on(&mut self, station: StationId) {
        let seat = self.seat_of(station).and_then(|seat| self.at(seat));
        if let Some(seat) = seat
            && seat.part == Part::Holds
        {
            (seat.part, seat.has_left) = (Part::Commanded(1), true);
        }
    }

    /// A follower is in position, where it guards from a place.
    fn in_position(&mut self, view: &View<'_>, station: StationId, out: &mut Outputs) {
        let Some(seat) = self.seat_of(station) else {
            return;
        };
        if self.is_elsewhere(seat) {
            return self.command(view, seat, out);
        }
        let holds = view.holds(self.due_leg(view, seat));
        if let Some(it) = self.at(seat)
            && holds
        {
            (it.part, it.has_left) = (Part::Holds, false);
        }
        self.open(view, out);
    }

    /// A follower has completed its leg, if its RAM have it where that leads.
    fn completed(&mut self, view: &View<'_>, station: StationId, out: &mut Outputs) {
        let Some(seat) = self.seat_of(station) else {
            return;
        };
        if !self.is(seat, |it| it.presence.is_there()) {
            return self.command(view, seat, out);
        }
        if let Some(it) = self.at(seat) {
            it.part = Part::Done;
        }
    }

    fn is(&self, seat: usize, so: impl Fn(&Seat) -> bool) -> bool {
        self.seats.iter().nth(seat).is_some_and(so)
    }

    fn is_elsewhere(&self, seat: usize) -> bool {
        self.is(seat, |it| it.presence.is_elsewhere())
    }

    /// A follower is to be commanded its leg again.
    fn again(&mut self, station: StationId) {
        if let Some(seat) = self.seat_of(station).and_then(|seat| self.at(seat)) {
            seat.again = true;
        }
    }

    /// Commands again what was to wait for that.
    fn command_again(&mut self, view: &View<'_>, out: &mut Outputs) {
        for seat in 0..self.seats.len() {
            if self.is(seat, |it| it.again && it.pause == Millis::ZERO) {
                self.command(view, seat, out);
            }
        }
    }

    /// Commands the follower's leg, again if it failed; in the end the leader gives up. A leg that takes a person on the road
    /// waits for everybody who guards from a place.
    fn command(&mut self, view: &View<'_>, seat: usize, out: &mut Outputs) {
        let leg = self.due_leg(view, seat);
        let is_hindered = view.escorts(leg) && self.hindrance(view).is_some();
        let Some(it) = self.at(seat) else { return };
        let Some(leg) = leg else {
            it.part = Part::Done;
            return;
        };
        it.again = is_hindered;
        if is_hindered {
            it.pause = Millis(100);
            it.part = Part::Commanded(0);
            return;
        }
        let Some(station) = it.station else { return };
        let attempts = match it.part {
            Part::Commanded(attempts) => attempts,
            // A part that was begun well has all its attempts before it.
            Part::Holds | Part::Done => 0,
        };
        if attempts >= ATTEMPTS {
            return out.tell(Event::LeaveRequested);
        }
        (it.part, it.has_left) = (Part::Commanded(attempts + 1), false);
        it.pause = AGAIN;
        out.put(Output::Order(station, leg));
    }

    /// A follower is gone, and with it a part of the plan that nobody else does.
    fn miss(&mut self, plan: &Plan, station: StationId, out: &mut Outputs) {
        let Some(gone) = self.seat_of(station) else {
            return;
        };
        let had_part = plan.has_role(gone);
        if let Some(seat) = self.at(gone) {
            *seat = Seat::EMPTY;
        }
        if had_part && self.seats.iter().any(|seat| seat.station.is_some()) {
            out.tell(Event::LeaveRequested);
        }
    }

    /// Goes on to the next stage when every follower has done its part or holds it.
    fn finish_stage(&mut self, view: &View<'_>, out: &mut Outputs) {
        if self.is_ready(view) && !view.plan.is_last(self.stage) {
            self.begin_stage(view, self.stage + 1, out);
        }
    }

    /// Whether every follower has done its part or holds it.
    fn is_ready(&self, view: &View<'_>) -> bool {
        self.are_all(view, |_, it| it.is_ready())
    }

    /// Whether every follower has done its part, holds it, or is an escort at the end of its way. That one goes on
    /// as long as it only hears of its person: what it hears is less exact than what its leader sees.
    fn is_over_there(&self, view: &View<'_>) -> bool {
        self.are_all(view, |seat, it| {
            let is_escort = view.escorts(self.leg(view.plan, seat));
            let is_at_end = it.presence.is_there() && it.pause == Millis::ZERO && !it.again;
            it.is_ready() || is_escort && is_at_end
        })
    }

    /// Whether every role has its follower, and this holds for every seat.
    fn are_all(&self, view: &View<'_>, holds: impl Fn(usize, &Seat) -> bool) -> bool {
        let mut seats = self.seats.iter().enumerate();
        self.is_staffed(view.plan) && seats.all(|(seat, it)| holds(seat, it))
    }

    /// Whether the plan has its followers.
    fn is_staffed(&self, plan: &Plan) -> bool {
        let seats = self.seats.iter().enumerate();
        let seated = seats.filter(|(seat, it)| plan.has_role(*seat) && it.station.is_some());
        seated.count() >= usize::from(plan.followers)
    }

    /// Whether the newest position of every follower is fresh.
    fn are_heard(&self, view: &View<'_>) -> bool {
        let mut seated = self.seats.iter().filter(|it| it.station.is_some());
        self.is_staffed(view.plan) && seated.all(|it| it.presence.is_fresh(view.setup.position))
    }

    /// Whether nobody is let on the road any more in this session.
    const fn is_full(&self) -> bool {
        self.opened.0 == 0
    }

    fn begin_stage(&mut self, view: &View<'_>, stage: u8, out: &mut Outputs) {
        self.stage = stage;
        for seat in 0..self.seats.len() {
            // A follower that holds its place goes on unless the stage has something else for it.
            if self.is(seat, |it| it.station.is_some()) && self.leg(view.plan, seat).is_some() {
                self.begin_part(view, seat, out);
            }
        }
    }

    /// The cause that keeps people from crossing, besides that nobody wants to and that the plan is not so far.
    pub(crate) fn hindrance(&self, view: &View<'_>) -> Option<Hindrance> {
        if !self.is_staffed(view.plan) {
            return Some(Hindrance::GuardMissing);
        }
        for (seat, it) in self.seats.iter().enumerate() {
            let Some(station) = it.station else { continue };
            let holds = view.holds(self.held_leg(view.plan, seat));
            if holds && (it.part != Part::Holds || !it.presence.is_there()) {
                return Some(Hindrance::GuardElsewhere(station));
            }
        }
        if view.plan.own_place.is_some() && !view.own.is_there() {
            return Some(Hindrance::LeaderElsewhere);
        }
        view.hindrance
    }

    /// For how long yet everybody who guards from a place is there.
    pub(crate) fn presence_left(&self, view: &View<'_>) -> Millis {
        let mut left = Millis(u32::MAX);
        for (seat, it) in self.seats.iter().enumerate() {
            let holds = view.holds(self.held_leg(view.plan, seat));
            if it.station.is_some() && holds {
                left = left.min(it.presence.left());
            }
        }
        if view.plan.own_place.is_some() {
            left = left.min(view.own.left());
        }
        left
    }

    /// Asks for the corridor to be opened in the last stage, where nothing hinders. While it is open no guard is
    /// commanded anything, so an earlier stage would be the last one.
    fn open(&mut self, view: &View<'_>, out: &mut Outputs) {
        if !view.plan.is_last(self.stage) {
            return;
        }
        self.tried = OPENING_PERIOD;
        if view.corridor == Corridor::Open || !view.is_wanted || self.is_full() {
            return;
        }
        match self.hindrance(view) {
            None => out.tell(Event::OpenCorridor),
            Some(why) if view.hindrance == Some(why) => {
                out.put(Output::Hindered(why));
                if let (Hindrance::NoPromise(station), Some(line)) = (why, view.stop_line) {
                    out.put(Output::Ask(station, line));
                }
            }
            // Guards on their way are nothing to tell of.
            Some(_) => {}
        }
    }

    /// The acts of a leader by the clock: it opens the corridor when it did not open before, closes it when nobody wants it any
    /// more, ends the task when everybody is across, and gives up in the end. `false` when the plan is over.
    pub(crate) fn lead_on(&mut self, view: &View<'_>, out: &mut Outputs) -> bool {
        self.command_again(view, out);
        self.return_guards(view, out);
        self.finish_stage(view, out);
        let plan = view.plan;
        let is_last = plan.is_last(self.stage);
        let is_done = is_last && self.is_ready(view);
        let is_over_there = is_last && self.is_over_there(view);
        let may_try = self.tried == Millis::ZERO;
        let goes_with_escort = plan.is_escort(self.stage, view.setup.escorts());
        // Nobody goes along with people who come now: they wait for its next way.
        let is_escort_gone = is_over_there && goes_with_escort;
        if !view.has_opened {
            self.opened = if goes_with_escort {
                STEP_ON_ESCORTED
            } else {
                STEP_ON
            };
        }
        if !view.everybody_is_across && !view.nobody_is_lost {
            self.ending = ESCORT_ENDS;
        }
        match view.corridor {
            Corridor::Open => {
                if self.is_full() || is_escort_gone || is_over_there && !view.is_wanted {
                    out.tell(Event::CloseCorridor);
                }
            }
            Corridor::Clearing => {}
            Corridor::Clear => {
                let lets_cross = plan.lets_cross(view.setup.guarding);
                // An escort that lost its person on the road waits there; its leader knows where they are. One that is
                // not heard any more may be lost itself.
                let is_escorted = is_last && goes_with_escort && self.are_heard(view);
                let is_ended = self.ending == Millis::ZERO;
                let may_end =
                    is_done || is_ended && (is_over_there || is_escorted && view.has_opened);
                // For people who wait by then it calls anew.
                let is_through =
                    (is_escorted && view.has_crossed || self.is_full()) && view.nobody_is_lost;
                let has_gone = is_through || is_escort_gone || is_escorted && view.was_seen;
                if is_done && !lets_cross || may_end && (view.everybody_is_across || is_through) {
                    out.tell(Event::TaskCompleted);
                } else if self.patience == Millis::ZERO {
                    // A session that is left has guards wait for somebody's word that the road is clear, also where its leader knows it.
                    out.tell(if view.nobody_is_lost {
                        Event::TaskCompleted
                    } else {
                        Event::LeaveRequested
                    });
                    return false;
                } else if may_try && is_done && goes_with_escort && !self.is_full() {
                    // The escort is over there, and nobody came along.
                    self.tried = OPENING_PERIOD;
                    self.begin_stage(view, 0, out);
                } else if may_try && !has_gone {
                    self.open(view, out);
                }
            }
        }
        true
    }

    /// Commands guards back that have left their place, while nobody may be on the road.
    fn return_guards(&mut self, view: &View<'_>, out: &mut Outputs) {
        if view.corridor != Corridor::Clear {
            return;
        }
        for seat in 0..self.seats.len() {
            let is_away = |it: &Seat| {
                let is_away = it.part == Part::Holds && it.presence.is_elsewhere() || it.has_left;
                is_away && it.pause == Millis::ZERO
            };
            let holds = view.holds(self.due_leg(view, seat));
            if holds && self.is(seat, is_away) {
                self.command(view, seat, out);
            }
        }
    }
}

#[cfg(test)]
mod tests;
