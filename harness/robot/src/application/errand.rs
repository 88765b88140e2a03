//! How a plan goes while its robot leads: who has which part, what is commanded, and when that is done.

use std::collections::{BTreeMap, BTreeSet};

use crossguard_codec::{PublicSignal, TaskParameters};
use crossguard_protocol::{Corridor, Event, Failure, Notice, Rejection, StationId};

use super::{Application, Stimulus};
use crate::plan::Leg;
use crate::street::Road;

/// How often a leg that failed is commanded again before the leader gives up.
const ATTEMPTS: u8 = 3;

/// How long a leader waits at least between a command and the same one again, in seconds.
const AGAIN_S: f64 = 0.5;

/// How long a leader waits before it asks again for an open corridor or an escort, in seconds.
const OPENING_PERIOD_S: f64 = 0.5;

/// How a plan goes.
#[derive(Debug, Default)]
pub(super) struct Errand {
    /// Whether all stages are done.
    is_done: bool,
    pub(super) stage: usize,
    /// How far each follower is with its part of the stage.
    followers: BTreeMap<StationId, Part>,
    /// Who said last that it is elsewhere than where it was sent.
    pub(super) elsewhere: BTreeSet<StationId>,
    /// Who has which seat of the plan: its roles, or else the followers in the order in which they joined.
    seats: Vec<Option<StationId>>,
    /// When each follower was commanded something last.
    commanded_s: BTreeMap<StationId, f64>,
    /// Who is to be commanded again, as soon as that is not too soon.
    again: BTreeSet<StationId>,
    /// When the corridor was to be opened last.
    tried_s: f64,
    since_s: f64,
}

#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum Part {
    /// Commanded so often; not begun, or under way.
    Commanded(u8),
    /// Goes on until it is ended.
    Holds,
    /// Done, or nothing to do.
    Done,
}

impl Application {
    /// Follows the plan when it leads.
    pub(super) fn notice(&mut self, notice: Notice) {
        if let (Notice::RolesEstablished(_), Some(plan)) = (notice, &self.plan) {
            if let Some(place) = plan.own_place {
                self.body.walk_to(place);
            }
            if let Some(signal) = plan.shows {
                self.shown.face_vehicles(signal);
            }
            if let Road::Own(street) = &self.road {
                street.arrive(plan.crossing_us(self.body.time_scale()));
            }
            self.errand = Some(Errand {
                since_s: self.at_s,
                ..Errand::default()
            });
        }
        if self.errand.is_none() {
            return;
        }
        match notice {
            Notice::FollowerJoined(follower) => self.seat(follower),
            Notice::ManeuverReported(..) => self.open_corridor(),
            Notice::ManeuverInPosition(follower, _) => self.is_in_position(follower),
            Notice::ManeuverCompleted(follower, _) => self.has_completed(follower),
            // It will not do it, however often it is told.
            Notice::ManeuverFailed(_, _, Failure::Unavailable(_))
            | Notice::CommandRejected(_, _, Rejection::Unavailable(_)) => self.give_up(),
            Notice::ManeuverFailed(follower, ..)
            | Notice::FollowerSafeIdle(follower, _)
            | Notice::CommandRejected(follower, ..) => self.command_again(follower),
            Notice::FollowerGone(follower, _) => self.miss(follower),
            // The session ends once the road is clear.
            Notice::Yielded(_) | Notice::SessionEnded(..) => {
                self.errand = None;
                if self.plan.as_ref().is_some_and(|plan| plan.shows.is_some()) {
                    self.shown.face_vehicles(PublicSignal::None);
                }
            }
            _ => {}
        }
        self.finish_stage();
    }

    /// The follower's leg of this stage.
    pub(super) fn leg(&self, follower: StationId) -> Option<Leg> {
        let (plan, errand) = (self.plan.as_ref()?, self.errand.as_ref()?);
        let mut seats = errand.seats.iter();
        plan.leg(
            errand.stage,
            seats.position(|seat| *seat == Some(follower))?,
        )
    }

    pub(super) fn set(&mut self, follower: StationId, part: Part) {
        if let Some(errand) = &mut self.errand {
            errand.followers.insert(follower, part);
        }
    }

    /// Gives a follower its seat in the plan: its role, the first one that is for any, or the next place in the row.
    fn seat(&mut self, follower: StationId) {
        let (Some(plan), Some(errand)) = (&self.plan, &mut self.errand) else {
            return;
        };
        if !errand.seats.contains(&Some(follower)) {
            let mut roles = plan.roles.iter();
            let own = roles.position(|role| *role == Some(follower));
            errand
                .seats
                .resize(errand.seats.len().max(plan.roles.len()), None);
            let is_free = |seat: usize| {
                let is_any = plan.roles.get(seat).is_none_or(Option::is_none);
                is_any && errand.seats[seat].is_none()
            };
            let free = (0..errand.seats.len()).find(|seat| is_free(*seat));
            match own.or(free) {
                Some(seat) => errand.seats[seat] = Some(follower),
                None if plan.roles.is_empty() => errand.seats.push(Some(follower)),
                None => tracing::warn!(%follower, "has no role in the plan"),
            }
        }
        self.begin_part(follower);
    }

    /// Commands the follower's leg again, at once or a while after it was commanded something last.
    fn command_again(&mut self, follower: StationId) {
        let now_s = self.at_s;
        let Some(errand) = &mut self.errand else {
            return;
        };
        let commanded_s = errand.commanded_s.get(&follower);
        if commanded_s.is_some_and(|commanded_s| now_s - commanded_s < AGAIN_S) {
            errand.again.insert(follower);
        } else {
            self.command(follower);
        }
    }

    /// Commands again what was to wait for that.
    fn command_those_who_wait(&mut self) {
        let again = self.errand.as_ref().map(|errand| errand.again.clone());
        for follower in again.into_iter().flatten() {
            if let Some(errand) = &mut self.errand {
                errand.again.remove(&follower);
            }
            self.command_again(follower);
        }
    }

    /// Leaves the session, and commands nothing any more.
    fn give_up(&mut self) {
        self.errand = None;
        self.wish(Stimulus::Event(Event::LeaveRequested));
    }

    fn begin_part(&mut self, follower: StationId) {
        self.set(follower, Part::Commanded(0));
        self.command(follower);
    }

    /// Asks for the corridor to be opened in the last stage, where the leader's own body does its part in it.
    /// While it is open no guard is commanded anything, so an earlier stage would be the last one.
    pub(super) fn open_corridor(&mut self) {
        let (Some(plan), Some(errand)) = (&self.plan, &mut self.errand) else {
            return;
        };
        if errand.stage + 1 < plan.stages.len() || !errand.elsewhere.is_empty() {
            return;
        }
        errand.tried_s = self.at_s;
        let stands = |place| self.body.stands_at(place);
        let is_needed = self.road.needs_corridor(self.at_s);
        if self.corridor != Corridor::Open && is_needed && plan.own_place.is_none_or(stands) {
            self.wish(Stimulus::Event(Event::OpenCorridor));
        }
    }

    /// A follower is gone, and with it a part of the plan that nobody else does.
    fn miss(&mut self, follower: StationId) {
        if let Some(errand) = &mut self.errand {
            errand.followers.remove(&follower);
            errand.elsewhere.remove(&follower);
            errand.again.remove(&follower);
            for seat in &mut errand.seats {
                *seat = seat.filter(|seated| *seated != follower);
            }
            if !errand.followers.is_empty() {
                self.wish(Stimulus::Event(Event::LeaveRequested));
            }
        }
    }

    /// Commands the follower's leg, again if it failed; in the end the leader gives up.
    pub(super) fn command(&mut self, follower: StationId) {
        let Some(leg) = self.leg(follower) else {
            return self.set(follower, Part::Done);
        };
        let (Some(plan), Some(errand)) = (&self.plan, &mut self.errand) else {
            return;
        };
        let attempts = match errand.followers.get(&follower) {
            Some(Part::Commanded(attempts)) => *attempts,
            // A part that was begun well has all its attempts before it.
            Some(Part::Holds | Part::Done) => 0,
            None => return,
        };
        if attempts >= ATTEMPTS {
            return self.wish(Stimulus::Event(Event::LeaveRequested));
        }
        errand
            .followers
            .insert(follower, Part::Commanded(attempts + 1));
        errand.commanded_s.insert(follower, self.at_s);
        errand.again.remove(&follower);
        let parameters = TaskParameters {
            target: Some(plan.site.target(leg.to)),
            maximum_speed: Some(leg.speed_mps),
            heading: leg.heading_deg,
            map_place: plan.site.map_place,
            ..TaskParameters::default()
        };
        self.wish(Stimulus::Order {
            follower,
            task: leg.task,
            parameters,
        });
    }

    /// Goes on to the next stage when every follower has done its part or holds it.
    fn finish_stage(&mut self) {
        let (Some(plan), Some(errand)) = (&self.plan, &mut self.errand) else {
            return;
        };
        let is_ready = |part: &Part| !matches!(part, Part::Commanded(_));
        let seated = errand.seats.iter().flatten().count();
        let everybody = seated >= usize::from(plan.followers);
        errand.is_done = false;
        if !everybody || !errand.followers.values().all(is_ready) {
            return;
        }
        if errand.stage + 1 < plan.stages.len() {
            let next = errand.stage + 1;
            self.begin_stage(next);
        } else {
            errand.is_done = true;
        }
    }

    fn begin_stage(&mut self, stage: usize) {
        let Some(errand) = &mut self.errand else {
            return;
        };
        errand.stage = stage;
        errand.is_done = false;
        let followers: Vec<_> = errand.followers.keys().copied().collect();
        for follower in followers {
            // Who holds goes on holding unless the stage has something else for it.
            if self.leg(follower).is_some() {
                self.begin_part(follower);
            }
        }
    }

    /// What a leader does by the clock: it opens the corridor when it did not open before, ends the
    /// task when the pedestrian is across, and gives up in the end.
    pub(super) fn lead_on(&mut self) {
        self.command_those_who_wait();
        let (Some(plan), Some(errand)) = (&self.plan, &self.errand) else {
            return;
        };
        let is_clear = self.corridor == Corridor::Clear;
        let lets_cross = plan.lets_cross(self.rules.guarding);
        let is_across = self.road.everybody_is_across(self.at_s) || (!lets_cross && is_clear);
        // An escort that is there already is done as soon as it is commanded: it is not commanded without end.
        let may_try = self.at_s - errand.tried_s >= OPENING_PERIOD_S;
        if errand.is_done && is_across {
            self.wish(Stimulus::Event(Event::TaskCompleted));
        } else if self.at_s - errand.since_s > plan.patience_s && is_clear {
            self.errand = None;
            self.wish(Stimulus::Event(Event::LeaveRequested));
        } else if may_try && errand.is_done && is_clear && plan.is_escort(errand.stage) {
            // The escort is over there, and nobody came along.
            self.begin_stage(0);
        } else if may_try && self.corridor != Corridor::Open {
            self.open_corridor();
        }
    }
}
