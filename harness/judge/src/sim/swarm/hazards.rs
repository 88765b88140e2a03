//! What was drawn for a run, by name: so that totals say how often each was tried.

use std::fmt;

use crossguard_protocol::{Config, Settings};
use crossguard_robot::transport::Faults;
use serde::Serialize;

use super::{RobotDraw, Swarm};
use crate::sim::script::Deed;

/// Something that makes a run hard.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Hazard {
    /// Messages are lost.
    Loss,
    /// Messages arrive twice.
    Duplication,
    /// Messages overtake each other.
    Reordering,
    /// Messages take longer than some lease.
    LongDelay,
    /// Some robots do not hear some others for a while.
    Partition,
    /// Two teams come about that do not hear each other.
    TwoTeams,
    /// People cross at two places.
    TwoPlaces,
    /// Some robot does not know the reference of its crossing.
    UnknownPlace,
    /// A robot loses power.
    Crash,
    /// A process hangs.
    Hang,
    /// A body fails, or a robot becomes unavailable.
    OwnFailure,
    /// A pseudonym changes.
    Pseudonym,
    /// Endpoints are later than `delay_max`.
    LateEndpoints,
    /// Robots have timers of their own.
    UnequalTimers,
    /// Some robot's lease does not fit the `t_safety` of another.
    TimersThatDoNotFit,
    /// Old packets are sent once more.
    Replay,
    /// Packets are signed, and nothing else is taken in.
    Security,
    /// Something happens to a team that lets people cross.
    Strike,
    /// Somebody takes more than half of `t_cross`.
    SlowPeople,
    /// A station with a certificate says anything in its own name.
    Insider,
}

impl Hazard {
    /// All of them.
    pub const ALL: [Self; 20] = [
        Self::Loss,
        Self::Duplication,
        Self::Reordering,
        Self::LongDelay,
        Self::Partition,
        Self::TwoTeams,
        Self::TwoPlaces,
        Self::UnknownPlace,
        Self::Crash,
        Self::Hang,
        Self::OwnFailure,
        Self::Pseudonym,
        Self::LateEndpoints,
        Self::UnequalTimers,
        Self::TimersThatDoNotFit,
        Self::Replay,
        Self::Security,
        Self::Strike,
        Self::SlowPeople,
        Self::Insider,
    ];

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Loss => "loss",
            Self::Duplication => "duplication",
            Self::Reordering => "reordering",
            Self::LongDelay => "delays beyond a lease",
            Self::Partition => "partitions",
            Self::TwoTeams => "two teams apart",
            Self::TwoPlaces => "two places",
            Self::UnknownPlace => "unknown places",
            Self::Crash => "crashes",
            Self::Hang => "hangs",
            Self::OwnFailure => "own failures",
            Self::Pseudonym => "pseudonyms out of turn",
            Self::LateEndpoints => "endpoints later than delay_max",
            Self::UnequalTimers => "unequal timers",
            Self::TimersThatDoNotFit => "timers that do not fit",
            Self::Replay => "replays",
            Self::Security => "security enforced",
            Self::Strike => "failures while the sign shows go",
            Self::SlowPeople => "slow people",
            Self::Insider => "an insider that lies",
        }
    }

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
                Deed::Availability(it) => *it != crossguard_protocol::Availability::Available,
                _ => false,
            }),
            Self::Pseudonym => some_deed(|deed| *deed == Deed::ChangeIdentity),
            Self::LateEndpoints => !swarm.is_in_time(),
            Self::UnequalTimers => some_pair(|a, b| a.settings().t_safety != b.t_safety),
            Self::TimersThatDoNotFit => some_pair(|a, b| !a.lease_fits(b.t_safety)),
            Self::Replay => !swarm.replays.is_empty(),
            Self::Security => swarm.is_secured,
            Self::Strike => swarm.strikes > 0.0,
            Self::Insider => swarm.insider.is_some(),
            Self::SlowPeople => swarm.robots.iter().any(lets_slow_people_cross),
        }
    }
}

fn knows_no_place(robot: &RobotDraw) -> bool {
    robot.plan.site.crossing == crossguard_protocol::Place::UNKNOWN
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
    /// What makes this run hard.
    pub fn hazards(&self) -> impl Iterator<Item = Hazard> + '_ {
        let all = Hazard::ALL.into_iter();
        all.filter(|hazard| hazard.is_in(self))
    }
}
