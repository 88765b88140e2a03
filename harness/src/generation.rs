//! When a robot without a session sends its RAM: the generation rules of CAM, applied to robots.
//!
//! In a session the protocol says when (its RAM timer and its `SendRam` outputs); outside of one, a
//! RAM goes out when the robot has moved, turned or changed speed enough since the last one, and at
//! the latest after a second (EN 302 637-2 clause 6.1.3). The low-frequency container goes along when
//! it has not for half a second.

use crossguard_codec::RobotState;
use serde::{Deserialize, Serialize};

/// Shortest interval between two RAM, in ms (`T_GenCamMin`).
pub const INTERVAL_MIN_MS: u64 = 100;
/// Longest interval between two RAM, in ms (`T_GenCamMax`).
pub const INTERVAL_MAX_MS: u64 = 1_000;
/// Shortest interval between two low-frequency containers, in ms.
pub const LOW_FREQUENCY_INTERVAL_MS: u64 = 500;
/// Distance from the last RAM's position that triggers the next, in metres.
const POSITION_TRIGGER_M: f64 = 4.0;
/// Change of heading that triggers the next RAM, in degrees.
const HEADING_TRIGGER_DEG: f64 = 4.0;
/// Change of speed that triggers the next RAM, in m/s.
const SPEED_TRIGGER_MPS: f64 = 0.5;

/// Why a message went out.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Trigger {
    /// The protocol said so: a state has changed, or a period is over.
    Protocol,
    /// The robot's first RAM.
    First,
    /// The longest interval is over.
    Interval,
    /// The robot has moved.
    Position,
    /// The robot has turned.
    Heading,
    /// The robot has changed its speed.
    Speed,
}

/// What the last RAM said, and when.
#[derive(Clone, Debug, Default)]
pub struct Generation {
    last: Option<(u64, RobotState)>,
    last_low_frequency_ms: Option<u64>,
}

impl Generation {
    /// Why a RAM is due now, if one is.
    #[must_use]
    pub fn trigger(&self, now_ms: u64, state: &RobotState) -> Option<Trigger> {
        let Some((sent_ms, sent)) = &self.last else {
            return Some(Trigger::First);
        };
        let elapsed = now_ms.saturating_sub(*sent_ms);
        if elapsed < INTERVAL_MIN_MS {
            return None;
        }
        let both = |a: Option<f64>, b: Option<f64>| Some((a?, b?));
        let value = |m: Option<crossguard_codec::Measurement>| m.map(|m| m.value);
        // 0.1 m is the resolution of the distance, fine enough for a trigger of 4 m.
        let moved = crossguard_codec::distance(&sent.position, &state.position);
        if moved != crossguard_protocol::Decimetres::UNKNOWN
            && f64::from(moved.0) / 10.0 > POSITION_TRIGGER_M
        {
            return Some(Trigger::Position);
        }
        if let Some((a, b)) = both(value(sent.heading), value(state.heading)) {
            let turned = (a - b).rem_euclid(360.0);
            if turned.min(360.0 - turned) > HEADING_TRIGGER_DEG {
                return Some(Trigger::Heading);
            }
        }
        if let Some((a, b)) = both(value(sent.speed), value(state.speed))
            && (a - b).abs() > SPEED_TRIGGER_MPS
        {
            return Some(Trigger::Speed);
        }
        (elapsed >= INTERVAL_MAX_MS).then_some(Trigger::Interval)
    }

    /// Whether the next RAM has the low-frequency container.
    #[must_use]
    pub fn low_frequency_due(&self, now_ms: u64) -> bool {
        self.last_low_frequency_ms
            .is_none_or(|last| now_ms.saturating_sub(last) >= LOW_FREQUENCY_INTERVAL_MS)
    }

    /// Notes that a RAM went out.
    pub fn sent(&mut self, now_ms: u64, state: &RobotState, with_low_frequency: bool) {
        self.last = Some((now_ms, state.clone()));
        if with_low_frequency {
            self.last_low_frequency_ms = Some(now_ms);
        }
    }
}

#[cfg(test)]
mod tests {
    use crossguard_codec::Position;

    use super::*;

    fn at(latitude: f64, heading: f64, speed: f64) -> RobotState {
        RobotState {
            position: Position::at(latitude, 8.4),
            heading: Some(heading.into()),
            speed: Some(speed.into()),
            ..RobotState::default()
        }
    }

    fn after_one(state: &RobotState) -> Generation {
        let mut generation = Generation::default();
        assert_eq!(generation.trigger(0, state), Some(Trigger::First));
        generation.sent(0, state, true);
        generation
    }

    #[test]
    fn a_robot_that_stands_still_sends_once_a_second() {
        let state = at(49.0, 0.0, 0.0);
        let generation = after_one(&state);
        assert_eq!(generation.trigger(999, &state), None);
        assert_eq!(generation.trigger(1_000, &state), Some(Trigger::Interval));
    }

    #[test]
    fn motion_triggers_but_not_before_the_shortest_interval() {
        let generation = after_one(&at(49.0, 359.0, 1.0));
        let moved = at(49.000_04, 359.0, 1.0);
        let turned = at(49.0, 3.5, 1.0);
        let faster = at(49.0, 359.0, 1.6);
        for (state, trigger) in [
            (moved, Trigger::Position),
            (turned, Trigger::Heading),
            (faster, Trigger::Speed),
        ] {
            assert_eq!(generation.trigger(99, &state), None);
            assert_eq!(generation.trigger(100, &state), Some(trigger));
        }
        assert_eq!(generation.trigger(100, &at(49.000_03, 2.5, 1.4)), None);
    }

    #[test]
    fn the_low_frequency_container_goes_along_every_half_second() {
        let generation = after_one(&at(49.0, 0.0, 0.0));
        assert!(!generation.low_frequency_due(499));
        assert!(generation.low_frequency_due(500));
    }
}
