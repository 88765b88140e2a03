//! Events of robots: they notice people, fail, hang, lose power and boot again.

use crossguard_codec::{Identifiers, SignalMeans, TaskParameters};
use crossguard_protocol::{Availability, Event, Robot, StationId};

use crossguard_endpoint::station::Security;
use crossguard_endpoint::{Endpoint, Stimulus};
use crossguard_robot::application::Application;
use crossguard_robot::body::Simulated;
use crossguard_robot::machine::Machine;
use crossguard_robot::perception::Newest;
use crossguard_robot::trace::Entry;
use rand::Rng;
use rand::seq::IndexedRandom;

use super::{EPOCH_UNIX_MS, Finding, Next, World};
use crate::sim::ruled::Ruled;
use crate::sim::security;
use crate::sim::swarm::{Deed, Happening, PSEUDONYM_STEP};

/// How long after a sign began to show *go* something happens to its team, at most.
const STRIKES_WITHIN_US: u64 = 1_500_000;

impl World<'_> {
    pub(super) fn happen(
        &mut self,
        Happening { place, deed, .. }: Happening,
    ) -> Result<(), Finding> {
        match deed {
            Deed::Crash => return self.crash(place),
            Deed::Boot => return self.boot(place),
            Deed::Hang(ms) => return self.hang(place, ms),
            Deed::Push(by) => {
                let seat = &mut self.seats[place];
                seat.observed.is_beside_road = false;
                if let Some(machine) = &mut seat.machine {
                    machine.application.push(by);
                }
                return Ok(());
            }
            _ => {}
        }
        let Some(event) = self.event(place, deed) else {
            return Ok(());
        };
        let is_own_failure = match event {
            Event::ManeuverFailed(_) => true,
            Event::AvailabilityChanged(availability) => availability != Availability::Available,
            _ => false,
        };
        if is_own_failure {
            let nodes = (0..self.seats.len()).map(|place| self.monitor.node(place));
            self.times.fail(self.now_us, place, nodes);
        }
        match event {
            Event::CommandManeuver { follower, task } => {
                let parameters = TaskParameters::default();
                let command = Stimulus::Command {
                    follower,
                    task,
                    parameters,
                };
                self.handle(place, command)
            }
            event => self.handle(place, Stimulus::Event(event)),
        }
    }

    /// Event for a robot that is up.
    fn event(&mut self, place: usize, deed: Deed) -> Option<Event> {
        let corner = self.seats[place].corner;
        let is_clear = self.corners[corner].street.is_clear()
            && self.nobody_walks_on_road()
            && !self.shows_go(place);
        if deed == Deed::Detect && self.swarm.sensing.is_some() {
            // The robots that see them call.
            self.walkers_come();
            return None;
        }
        if deed == Deed::Detect {
            let draw = self.seats[place].draw;
            let crossing_us = draw.plan.crossing_us(draw.time_scale);
            self.come_to_cross(draw.corner, crossing_us);
        }
        let seat = &mut self.seats[place];
        if seat.hangs_until_us.is_some() {
            return None;
        }
        let machine = seat.machine.as_mut()?;
        Some(match deed {
            Deed::Detect => Event::PedestrianDetected(seat.draw.plan.request()),
            Deed::Fail => machine.finish(false)?,
            // A robot that knows of people on the road does not say that.
            Deed::Event(Event::TaskCompleted) if !is_clear => return None,
            Deed::Event(event) => event,
            // An id follows from the ticket, which changes in its own time.
            Deed::ChangeIdentity if self.swarm.is_secured => return None,
            Deed::ChangeIdentity => {
                seat.changes += 1;
                let station = seat.draw.station.0 + seat.changes * PSEUDONYM_STEP;
                Event::IdentityChanged(StationId(station), None)
            }
            Deed::Crash | Deed::Boot | Deed::Hang(_) | Deed::Push(_) => return None,
        })
    }

    fn crash(&mut self, place: usize) -> Result<(), Finding> {
        let nodes = (0..self.seats.len()).map(|place| self.monitor.node(place));
        self.times.crash(self.now_us, place, nodes);
        self.monitor.crash(place);
        let seat = &mut self.seats[place];
        if let Some(machine) = seat.machine.take() {
            seat.lies_at = machine.application.body().place();
        }
        (seat.wakes_us, seat.hangs_until_us) = (None, None);
        seat.inbox.clear();
        self.see(place)
    }

    /// A robot that is up does nothing for a while.
    fn hang(&mut self, place: usize, ms: u32) -> Result<(), Finding> {
        let seat = &mut self.seats[place];
        if seat.machine.is_none() {
            return Ok(());
        }
        let until_us = self.now_us + u64::from(ms) * 1_000;
        let until_us = seat.hangs_until_us.map_or(until_us, |it| it.max(until_us));
        seat.hangs_until_us = Some(until_us);
        self.at(until_us, Next::GoesOn(place));
        self.times.hang(place);
        self.monitor.hang(place, true);
        self.see(place)
    }

    /// A robot that hung takes in what has been waiting for it.
    pub(super) fn go_on_after_hanging(&mut self, place: usize) -> Result<(), Finding> {
        let seat = &mut self.seats[place];
        seat.hangs_until_us = None;
        self.monitor.hang(place, false);
        self.times.go_on(place);
        for next in std::mem::take(&mut seat.inbox) {
            self.take(next)?;
        }
        self.handle(place, Stimulus::Time)
    }

    /// Boots a robot that is down, with the next boot counter.
    pub(super) fn boot(&mut self, place: usize) -> Result<(), Finding> {
        let seat = &mut self.seats[place];
        if seat.machine.is_some() {
            return Ok(());
        }
        let draw = seat.draw;
        seat.boot += 1;
        let identifiers = Identifiers::default();
        let security = if self.swarm.is_secured {
            security::of(place, draw.station, self.now_us / 1_000)
        } else {
            Security::default()
        };
        let station = security.station_id(&identifiers, draw.station);
        let epoch = security.epoch(station, seat.boot);
        let robot = Robot::new(station, epoch);
        self.monitor.boot(place, &robot, &draw.config);
        let now_ms = seat.clock.shows_us(self.now_us) / 1_000;
        let rules = self.rules;
        let protocol = Ruled { robot, rules };
        let endpoint = Endpoint::new(protocol, draw.config.clone(), identifiers, now_ms)
            .with_security(security);
        let gait = self.swarm.seed.wrapping_add(place as u64);
        let body = Simulated::new(
            draw.build,
            draw.plan.site,
            draw.place,
            draw.time_scale,
            gait,
        );
        let body = body
            .holding(draw.config.settings().holding)
            .at(seat.lies_at);
        let plan = Some(draw.plan.clone());
        let application = Application::new(Box::new(body), plan).with_home(draw.place);
        // Where roles are parted only the leader calls for people who wait.
        let calls = self.swarm.demand.is_none() || place == 0;
        let application = match &self.swarm.sensing {
            Some(sensing) => application.on(super::sensors::road(sensing, calls)),
            None => application,
        };
        let application = match &self.swarm.demand {
            Some(_) => application.showing_by(Some(SignalMeans::DISPLAY)),
            None => application,
        };
        seat.newest = Newest::default();
        seat.heard_us.clear();
        seat.sign = application.sign().clone();
        seat.machine = Some(Machine::new(endpoint, application));
        self.come_to(place, self.seats[place].corner);
        let entry = Entry::Started {
            station,
            boot: self.seats[place].boot,
            epoch: Some(epoch).filter(|_| self.swarm.is_secured),
            settings: Box::new(draw.config.settings().clone()),
            identifiers,
            unix_ms: u64::try_from(EPOCH_UNIX_MS).unwrap_or(0) + self.now_us / 1_000,
            speed: Some(draw.time_scale),
        };
        self.record(place, entry);
        self.handle(place, Stimulus::Time)
    }

    /// The sign of a leader begins to show *go*: perhaps something happens to it or to one of its guards soon.
    pub(super) fn plan_strike(&mut self, leader: usize) {
        let is_drawn = self.draws.random_bool(self.swarm.strikes);
        let after_us = self.draws.random_range(0..STRIKES_WITHIN_US);
        let mut team = self.road.guards_of(leader);
        team.push(leader);
        let victim = *team.choose(&mut self.draws).unwrap_or(&leader);
        if is_drawn && !self.is_healed && self.now_us + after_us < self.swarm.heals_us {
            self.at(self.now_us + after_us, Next::Strikes(victim));
        }
    }

    /// A robot loses power and boots again, hangs for a while, its body fails, or is pushed away.
    pub(super) fn strike(&mut self, place: usize) -> Result<(), Finding> {
        if self.swarm.sensing.is_some() && self.draws.random_bool(0.4) {
            let by = [0, 1].map(|_| self.draws.random_range(-6.0..6.0));
            let (at_us, deed) = (self.now_us, Deed::Push(by));
            return self.happen(Happening { at_us, place, deed });
        }
        let deed = match self.draws.random_range(0..4) {
            0 => Deed::Crash,
            1 => Deed::Fail,
            _ => {
                let left_ms = (self.swarm.heals_us - self.now_us) / 1_000;
                let ms = self.draws.random_range(100..6_000).min(left_ms);
                Deed::Hang(u32::try_from(ms).unwrap_or(u32::MAX))
            }
        };
        if deed == Deed::Crash {
            let up_us = self.now_us + self.draws.random_range(0..STRIKES_WITHIN_US * 5);
            self.at(up_us, Next::Boots(place));
        }
        let at_us = self.now_us;
        self.happen(Happening { at_us, place, deed })
    }
}
