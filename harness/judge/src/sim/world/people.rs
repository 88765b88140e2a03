//! People at the corners: they wait for a sign that shows *go*, step on the road, and are across some time
//! later. And what is demanded for one of them once the network is healed.

use crossguard_endpoint::Stimulus;
use crossguard_protocol::{EndReason, Event, Input, Notice, Output, Outputs, SessionId};
use crossguard_robot::street::{Road, Street};
use rand::Rng;
use rand::seq::IndexedRandom;

use super::{Finding, Next, World};
use crate::sim::road::Overdue;
use crate::sim::swarm::{SECOND_US, Swarm};
use crate::sim::times::Measure;

/// How long who waits looks elsewhere at most, in microseconds.
const LOOKS_EVERY_US: u64 = 400_000;

/// The same of who waits once the network is healed.
const LOOKS_EVERY_HEALED_US: u64 = 100_000;

/// A crossing.
#[derive(Debug, Default)]
pub(super) struct Corner {
    /// The street, as the robots there know it.
    pub(super) street: Street,
    /// How long the one who waits takes to cross, in microseconds.
    waiting_us: Option<u64>,
}

/// A person on the road.
#[derive(Clone, Copy, Debug)]
pub(super) struct OnRoad {
    /// At whose sign.
    pub(super) session: SessionId,
    pub(super) corner: usize,
    pub(super) across_us: u64,
    /// Whether the network was healed when he or she stepped on it.
    pub(super) is_after_healing: bool,
}

/// The crossing that is demanded (W7).
#[derive(Debug)]
pub(super) struct Progress {
    corner: usize,
    /// Robots that may notice that somebody waits.
    leaders: Vec<usize>,
    is_across: bool,
    pub(super) is_done: bool,
}

pub(super) fn corners(swarm: &Swarm) -> Vec<Corner> {
    let last = swarm.robots.iter().map(|robot| robot.corner).max();
    let corners = 0..=last.unwrap_or(0);
    corners.map(|_| Corner::default()).collect()
}

impl World<'_> {
    /// A person comes to a corner, unless somebody waits there.
    pub(super) fn come_to_cross(&mut self, corner: usize, crossing_us: u64) {
        let Corner { street, waiting_us } = &mut self.corners[corner];
        if waiting_us.is_none() {
            *waiting_us = Some(crossing_us);
            street.arrive(crossing_us, 1);
            self.plan_look(corner);
        }
    }

    pub(super) fn plan_look(&mut self, corner: usize) {
        let most = if self.is_healed {
            LOOKS_EVERY_HEALED_US
        } else {
            LOOKS_EVERY_US
        };
        let at_us = self.now_us + self.draws.random_range(1..=most);
        self.at(at_us, Next::Looks(corner));
    }

    /// A person who waits at a corner steps on the road if a sign there shows go.
    pub(super) fn look(&mut self, corner: usize) -> Result<(), Finding> {
        let Some(crossing_us) = self.corners[corner].waiting_us else {
            return Ok(());
        };
        let signs = self.road.signs_at(corner);
        let Some(&leader) = signs.choose(&mut self.draws) else {
            self.plan_look(corner);
            return Ok(());
        };
        let Some(session) = self.step_on(leader)? else {
            return Ok(());
        };
        let it = &mut self.corners[corner];
        it.waiting_us = None;
        it.street.look(self.now_us, true);
        self.people.push(OnRoad {
            session,
            corner,
            across_us: self.now_us + crossing_us,
            is_after_healing: self.is_healed,
        });
        Ok(())
    }

    /// A person steps on the road at the sign of a leader. Returns the session, if the sign shows go.
    pub(super) fn step_on(&mut self, leader: usize) -> Result<Option<SessionId>, Finding> {
        let stepped = self
            .road
            .step_on_road(self.now_us, leader, self.liars_among(leader));
        let stepped = stepped.map_err(|late| self.too_late(late))?;
        let Some((session, required, gone)) = stepped else {
            return Ok(None);
        };
        let broken = self.monitor.step_on_road(session, required);
        // A guard that lost power and has a part in another session by now says nothing of this one.
        let has_left = |place: &usize| {
            let body = self.monitor.node(*place).actuation.body;
            body.maneuver().is_none_or(|id| id.session != session)
        };
        if let Some(broken) = broken.filter(|_| !gone.iter().any(has_left)) {
            return Err(self.finding(broken, leader));
        }
        Ok(Some(session))
    }

    /// People who have had the time are across.
    pub(super) fn get_across(&mut self) {
        let now_us = self.now_us;
        for corner in &self.corners {
            corner.street.look(now_us, false);
        }
        if self.people.iter().all(|it| it.across_us > now_us) {
            return;
        }
        let (monitor, progress) = (&mut self.monitor, &mut self.progress);
        self.people.retain(|it| {
            if it.across_us > now_us {
                return true;
            }
            monitor.is_across(it.session);
            if let Some(progress) = progress.as_mut() {
                progress.is_across |= it.is_after_healing && it.corner == progress.corner;
            }
            false
        });
    }

    /// By when a crossing is completed once the network is healed, in microseconds after that.
    pub(super) fn crossing_us(&self) -> u64 {
        u64::from(self.swarm.crossing_bound().0) * 1_000
    }

    /// The network is healed: where a team can exist, somebody waits from now on.
    pub(super) fn begin_progress(&mut self) {
        if let Some(corner) = self.swarm.waits_at {
            self.progress = Some(Progress {
                corner,
                leaders: self.swarm.who_can_lead(corner),
                is_across: false,
                is_done: false,
            });
            self.at(self.now_us, Next::Notices);
        }
    }

    /// Robots look, and notice who waits, until a crossing is completed.
    pub(super) fn notice_again(&mut self) -> Result<(), Finding> {
        let Some(progress) = self.progress.as_ref().filter(|it| !it.is_done) else {
            return Ok(());
        };
        let (corner, leaders) = (progress.corner, progress.leaders.clone());
        let draw = self.seats[leaders[0]].draw;
        let crossing_us = draw.plan.crossing_us(draw.time_scale);
        if self.swarm.sensing.is_some() {
            // Robots call by themselves when they see somebody wait.
            if !self.somebody_waits() {
                self.walkers_come();
            }
            let next_us = self.now_us + self.draws.random_range(SECOND_US..=5 * SECOND_US);
            self.at(next_us, Next::Notices);
            return Ok(());
        }
        if self.people.iter().all(|it| it.corner != corner) {
            self.come_to_cross(corner, crossing_us);
        }
        for place in leaders {
            if self.draws.random_bool(0.5) {
                let request = self.seats[place].draw.plan.request();
                self.handle(place, Stimulus::Event(Event::PedestrianDetected(request)))?;
            }
        }
        let next_us = self.now_us + self.draws.random_range(SECOND_US / 2..=2 * SECOND_US);
        self.at(next_us, Next::Notices);
        Ok(())
    }

    /// The leader at this place says that a crossing is completed.
    fn complete_progress(&mut self, place: usize) {
        let corner = self.seats[place].draw.corner;
        let Some(progress) = self.progress.as_mut() else {
            return;
        };
        if progress.is_across && progress.corner == corner && !progress.is_done {
            progress.is_done = true;
            let took_us = self.now_us - self.swarm.heals_us;
            let bound_ms = self.swarm.crossing_bound().0;
            self.road.complete(took_us, bound_ms);
        }
    }

    /// A crossing is completed in time (W7).
    pub(super) fn demand_progress(&self) -> Result<(), Finding> {
        let is_late = self.now_us > self.swarm.heals_us + self.crossing_us();
        match &self.progress {
            Some(progress) if !progress.is_done && is_late => {
                Err(self.too_late((Measure::Crossed, progress.leaders[0])))
            }
            _ => Ok(()),
        }
    }

    /// Tells the road of a step of a robot.
    pub(super) fn tell_road(
        &mut self,
        place: usize,
        input: Input,
        outputs: &Outputs,
    ) -> Result<(), Overdue> {
        let now_us = self.now_us;
        if let (Input::Local(Event::PedestrianDetected(_)), None) = (input, outputs.ignored()) {
            self.road.notice(now_us, place);
            self.come_to(place, self.seats[place].draw.corner);
        }
        let falls_back = |output: &Output| matches!(output, Output::FallBack(..));
        for notice in outputs.notices() {
            match notice {
                Notice::FollowerGone(guard, _)
                | Notice::LeaseExpired(guard)
                | Notice::ManeuverFailed(guard, ..)
                | Notice::ManeuverReported(guard, _)
                | Notice::ManeuverCompleted(guard, _)
                | Notice::FollowerSafeIdle(guard, _) => {
                    if self.is_insider(guard) {
                        // No body is gone with it.
                        continue;
                    }
                    let guard = self.names.get(&guard).copied();
                    self.road.tell_gone(now_us, place, guard)?;
                }
                Notice::SessionEnded(_, why) => {
                    self.road.tell_end(now_us, place)?;
                    if why == EndReason::TaskCompleted {
                        self.complete_progress(place);
                    }
                }
                Notice::Joined(session) => {
                    if let Some(&leader) = self.names.get(&session.leader) {
                        self.come_to(place, self.seats[leader].draw.corner);
                    }
                }
                Notice::ContactLost(session) if outputs.iter().any(falls_back) => {
                    self.road.lose_contact(now_us, session)?;
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// A robot is at this corner from now on, and knows of the people there.
    pub(super) fn come_to(&mut self, place: usize, corner: usize) {
        self.seats[place].corner = corner;
        if self.swarm.sensing.is_some() {
            return;
        }
        let street = self.corners[corner].street.clone();
        if let Some(machine) = &mut self.seats[place].machine {
            let road = Road::Known(street);
            machine.application.come_to(road);
        }
    }
}
