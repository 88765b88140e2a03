//! The parts of a scenario: its robots, its bounds, its channel.

use std::fmt;
use std::hash::{Hash, Hasher};

use crossguard_protocol::{Availability, Event, StationId, Urgency};
use serde::{Deserialize, Serialize};

use super::lies::LyingPart;

/// How many robots a scenario may have.
pub const MAX_ROBOTS: usize = 6;

/// By how much a robot's station id grows when it changes its pseudonym.
pub(crate) const PSEUDONYM_STEP: u32 = 100;

/// The size of a state space.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Size {
    /// Distinct states.
    pub unique_states: usize,
    /// Steps from the initial state to the farthest state.
    pub depth: usize,
}

/// One robot of a scenario.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RobotSetup {
    /// Its station id.
    pub station: StationId,
    /// Whether it may detect a pedestrian.
    #[serde(default)]
    pub detects: bool,
    /// How urgent its requests are, where that differs from the scenario's request.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub urgency: Option<Urgency>,
    /// As what it lies, if it is an insider: a station with a certificate that says anything of its part in its own name, at
    /// any moment and to each robot something else. It has no state; [`utterances`](crate::utterances) says what it says.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lies: Option<LyingPart>,
}

/// How often each kind of event may happen in one run, over all robots together; never where a file
/// says nothing.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Bounds {
    /// A pedestrian is detected.
    pub detections: u8,
    /// A leader's application gives a command.
    pub commands: u8,
    /// An application's disturbance: a maneuver fails, a robot leaves, becomes
    /// unavailable, or changes its pseudonym. To become available again costs nothing.
    pub disturbances: u8,
    /// A robot crashes.
    pub crashes: u8,
    /// A crashed robot boots again.
    pub restarts: u8,
    /// A message gets lost on its way to one receiver; any number of times where nothing is said.
    pub losses: Option<u8>,
    /// A robot hangs. To go on costs nothing.
    pub hangs: u8,
    /// A guard leaves the place that it holds. To get back there costs nothing.
    pub drifts: u8,
    /// A guard sees somebody on the road itself. The leader's application may take the crossing for completed then.
    pub sightings: u8,
    /// A RAM timer expires and changes its robot, as it does where a heartbeat is counted. For a monotone
    /// channel, which needs it.
    pub heartbeats: Option<u8>,
    /// A message makes a robot offer its help. For a monotone channel, which needs it.
    pub offers: Option<u8>,
}

impl Bounds {
    /// All of them with their names; 0 where nothing is said.
    fn each(&self) -> [(&'static str, u8); 11] {
        [
            ("detections", self.detections),
            ("commands", self.commands),
            ("disturbances", self.disturbances),
            ("crashes", self.crashes),
            ("restarts", self.restarts),
            ("losses", self.losses.unwrap_or_default()),
            ("hangs", self.hangs),
            ("drifts", self.drifts),
            ("sightings", self.sightings),
            ("heartbeats", self.heartbeats.unwrap_or_default()),
            ("offers", self.offers.unwrap_or_default()),
        ]
    }

    /// Takes an event off what may still happen. One without a bound may happen at any time: a bound that is forgotten
    /// makes the state space larger.
    pub(crate) fn spend(&mut self, event: Event) {
        let bound = match event {
            Event::PedestrianDetected(_) => &mut self.detections,
            Event::CommandManeuver { .. } => &mut self.commands,
            Event::ManeuverFailed(_)
            | Event::LeaveRequested
            | Event::AvailabilityChanged(Availability::Unavailable(_))
            | Event::IdentityChanged(..) => &mut self.disturbances,
            Event::OutOfPosition(_) => &mut self.drifts,
            Event::PersonOnRoad => &mut self.sightings,
            _ => return,
        };
        *bound -= 1;
    }
}

/// Behaviour of the radio channel.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ChannelSetup {
    /// How many messages may be delayed at a time; each may arrive late, in any order, more than
    /// once, or never. A timed scenario bounds for how long instead.
    #[serde(default)]
    pub delayed: u8,
    /// Whether every message that was ever sent may arrive at any later time, any number of times.
    #[serde(default)]
    pub monotone: bool,
    /// Whether a message may get lost on its way to one receiver and reach another.
    pub loss: bool,
}

impl Hash for Bounds {
    /// All bounds at once: states are hashed by the million. A bound of 0 and none at all share a hash, and no state has
    /// both.
    fn hash<H: Hasher>(&self, state: &mut H) {
        state.write(&self.each().map(|(_, bound)| bound));
    }
}

impl fmt::Display for Bounds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let bounds = self.each().into_iter().filter(|(_, bound)| *bound > 0);
        let allowed: Vec<_> = bounds
            .map(|(name, bound)| format!("{name} <= {bound}"))
            .collect();
        f.write_str(&allowed.join(", "))
    }
}
