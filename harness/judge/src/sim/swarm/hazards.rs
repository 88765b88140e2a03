//! Hazards that were drawn for a run, by name: so that totals say how often each was tried.

use std::fmt;

use crossguard_protocol::{Availability, Config, Event, Place, Settings};
use crossguard_robot::transport::Faults;
use serde::Serialize;

use super::{RobotDraw, SourceDraw, Swarm};
use crate::sim::swarm::Deed;

/// A table of hazards: their names, and what they are.
macro_rules! hazards {
    ($($hazard:ident $name:literal: $what:literal;)*) => {
        /// Something that makes a run hard.
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize)]
        #[serde(rename_all = "camelCase")]
        pub enum Hazard {
            $(#[doc = $what] $hazard,)*
        }

        impl Hazard {
            /// All of them.
            pub const ALL: [Self; [$($name),*].len()] = [$(Self::$hazard),*];

            /// Its name.
            #[must_use]
            pub const fn name(self) -> &'static str {
                [$($name),*][self as usize]
            }
        }
    };
}

hazards! {
    Loss "loss": "Messages are lost.";
    Duplication "duplication": "Messages arrive twice.";
    Reordering "reordering": "Messages overtake each other.";
    LongDelay "delays beyond a lease": "Messages take longer than some lease.";
    Partition "partitions": "Some robots do not hear some others for a while.";
    TwoTeams "two teams apart": "Two teams come about that do not hear each other.";
    TwoPlaces "two places": "People cross at two places.";
    UnknownPlace "unknown places": "Some robot does not know the reference of its crossing.";
    Crash "crashes": "A robot loses power.";
    Hang "hangs": "A process hangs.";
    OwnFailure "own failures": "A body fails, or a robot becomes unavailable.";
    Pseudonym "pseudonyms out of turn": "A pseudonym changes.";
    LateEndpoints "endpoints later than delay_max": "Endpoints are later than `delay_max`.";
    UnequalTimers "unequal timers": "Robots have timers of their own.";
    TimersThatDoNotFit "timers that do not fit": "Some robot's lease does not fit the `t_safety` of another.";
    Replay "replays": "Old packets are sent once more.";
    Security "security enforced": "Packets are signed, and nothing else is taken in.";
    Strike "failures while the sign shows go": "Something happens to a team that lets people cross.";
    SlowPeople "slow people": "Somebody takes more than half of `t_cross`.";
    Sensors "people seen by sensors": "Robots see people by sensors of their own, which miss some.";
    BadSensors "sensors that fail": "A sensor is silent, garbled, or late.";
    Push "bodies that are pushed": "A body is pushed off its place.";
    Cars "vehicles that do not stop": "Vehicles drive over the crossing.";
    Insider "an insider that lies": "A station with a certificate says anything in its own name.";
}

impl Hazard {
    /// Whether a run has it.
    fn is_in(self, swarm: &Swarm) -> bool {
        let some_way = |has: fn(&Faults) -> bool| swarm.ways.iter().any(has);
        let some_deed = |is: fn(&Deed) -> bool| swarm.script.iter().any(|h| is(&h.deed));
        let settings = swarm.robots.iter().map(|robot| robot.config.settings());
        let some_pair = |is: fn(&Config, &Settings) -> bool| {
            let pairs = swarm.robots.iter();
            pairs
                .flat_map(|a| swarm.robots.iter().map(move |b| (a, b)))
                .any(|(a, b)| is(&a.config, b.config.settings()))
        };
        match self {
            Self::Loss => some_way(|faults| faults.loss > 0.0 || faults.burst.is_some()),
            Self::Duplication => some_way(|faults| faults.duplication > 0.0),
            Self::Reordering => some_way(|faults| faults.reordering > 0.0),
            Self::LongDelay => {
                let delay = swarm.delay_max();
                settings.clone().any(|settings| settings.t_lease < delay)
            }
            Self::Partition => some_way(|faults| !faults.outages.is_empty()),
            Self::TwoTeams => some_way(|faults| faults.outages.iter().any(|o| o.from_ms == 0)),
            Self::TwoPlaces => swarm.robots.iter().any(|robot| robot.corner > 0),
            Self::UnknownPlace => swarm.robots.iter().any(knows_no_place),
            Self::Crash => some_deed(|deed| *deed == Deed::Crash),
            Self::Hang => some_deed(|deed| matches!(deed, Deed::Hang(_))),
            Self::OwnFailure => some_deed(|deed| match deed {
                Deed::Fail => true,
                Deed::Event(Event::AvailabilityChanged(it)) => *it != Availability::Available,
                _ => false,
            }),
            Self::Pseudonym => some_deed(|deed| *deed == Deed::ChangeIdentity),
            Self::LateEndpoints => !swarm.is_in_time(),
            Self::UnequalTimers => some_pair(|a, b| a.settings().t_safety != b.t_safety),
            Self::TimersThatDoNotFit => some_pair(|a, b| !a.lease_fits(b.t_safety)),
            Self::Replay => !swarm.replays.is_empty(),
            Self::Security => swarm.is_secured,
            Self::Strike => swarm.strikes > 0.0,
            Self::Sensors => swarm.sensing.is_some(),
            Self::BadSensors => {
                let sources = swarm
                    .sensing
                    .iter()
                    .flat_map(|it| it.sources.iter().flatten());
                let fails = |it: &SourceDraw| {
                    it.silent.is_some() || it.garbled > 0.0 || it.latency_ms > 100
                };
                { sources }.any(fails)
            }
            Self::Push => {
                let strikes = swarm.sensing.is_some() && swarm.strikes > 0.0;
                strikes || some_deed(|deed| matches!(deed, Deed::Push(_)))
            }
            Self::Cars => swarm.sensing.as_ref().is_some_and(|it| !it.cars.is_empty()),
            Self::Insider => swarm.insider.is_some(),
            Self::SlowPeople => swarm.robots.iter().any(lets_slow_people_cross),
        }
    }
}

fn knows_no_place(robot: &RobotDraw) -> bool {
    robot.plan.site.crossing == Place::UNKNOWN
}

fn lets_slow_people_cross(robot: &RobotDraw) -> bool {
    let t_cross_us = u64::from(robot.config.settings().t_cross.0) * 1_000;
    robot.plan.crossing_us(robot.time_scale) > t_cross_us / 2
}

impl fmt::Display for Hazard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl Swarm {
    /// Hazards of this run.
    pub fn hazards(&self) -> impl Iterator<Item = Hazard> + '_ {
        let all = Hazard::ALL.into_iter();
        all.filter(|hazard| hazard.is_in(self))
    }
}
