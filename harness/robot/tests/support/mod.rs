//! Two robots of a test that hear each other at once, in virtual time.

use crossguard_codec::Identifiers;
use crossguard_endpoint::station::Security;
use crossguard_endpoint::{Effect, Endpoint, Moment, Stimulus};
use crossguard_protocol::{Config, Robot, StationId};
use crossguard_robot::application::Application;
use crossguard_robot::body::{Build, Simulated};
use crossguard_robot::machine::Machine;
use crossguard_robot::plan::Plan;
use crossguard_robot::site::{Place, Site};
use crossguard_robot::street::Road;

/// 2026-01-05, in milliseconds since 2004.
pub(crate) const BEGAN_ITS: u64 = 694_694_401_000;

pub(crate) const TICK_MS: u32 = 10;

/// A robot whose simulated body moves `speed` times as fast as real.
pub(crate) fn machine(
    station: u32,
    (build, place, speed): (Build, Place, f64),
    plan: Option<Plan>,
    road: Road,
    security: Security,
) -> Machine {
    let robot = Robot::new(StationId(station), 1);
    let endpoint =
        Endpoint::new(robot, Config::default(), Identifiers::default(), 0).with_security(security);
    let body = Simulated::new(build, Site::default(), place, speed, 1);
    Machine::new(endpoint, Application::new(Box::new(body), plan).on(road))
}

/// Effects of a robot that is told something at this time.
pub(crate) fn effects(machine: &mut Machine, now_ms: u32, stimulus: Stimulus<'_>) -> Vec<Effect> {
    let moment = Moment::after(BEGAN_ITS, now_ms.into());
    machine.handle(moment, f64::from(now_ms) / 1e3, stimulus)
}

/// Two robots, of which one may be gone, and what a test notes of them.
pub(crate) struct Street<Notes> {
    pub(crate) robots: Vec<Option<Machine>>,
    pub(crate) now_ms: u32,
    pub(crate) notes: Notes,
    /// Notes an effect of the robot with this number, if the test wants to know of it.
    note: fn(&mut Notes, usize, Effect),
}

impl<Notes: Default> Street<Notes> {
    pub(crate) fn new(robots: Vec<Option<Machine>>, note: fn(&mut Notes, usize, Effect)) -> Self {
        Self {
            robots,
            now_ms: 0,
            notes: Notes::default(),
            note,
        }
    }

    pub(crate) fn robot(&mut self, number: usize) -> &mut Machine {
        self.robots[number].as_mut().unwrap()
    }

    /// Tells a robot something, and both what comes of it.
    pub(crate) fn tell(&mut self, robot: usize, stimulus: Stimulus<'_>) {
        let Some(machine) = &mut self.robots[robot] else {
            return;
        };
        let arrived_ms = self.now_ms.into();
        for effect in effects(machine, self.now_ms, stimulus) {
            if let Effect::Transmit { packet, .. } = &effect {
                self.tell(1 - robot, Stimulus::Datagram { packet, arrived_ms });
            }
            (self.note)(&mut self.notes, robot, effect);
        }
    }

    pub(crate) fn pass(&mut self, ms: u32) {
        for _ in 0..ms / TICK_MS {
            self.now_ms += TICK_MS;
            for robot in 0..2 {
                self.tell(robot, Stimulus::Time);
            }
        }
    }
}
