//! Where the own station is.

#[cfg(not(feature = "std"))]
#[allow(unused_imports, reason = "another crate may link the standard library")]
use num_traits::Float as _;

use super::{Address, LongPositionVector};
use crate::si;
use crate::state::{DriveDirection, RobotState};

/// A position is accurate when its error is below half of `itsGnPaiInterval`, 80 m.
const ACCURATE_METRES: f64 = 40.0;

/// The ego position vector: where the own station is, how it moves, and what time it is there.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct EgoPosition {
    /// `TimestampIts`: milliseconds since 2004, leap seconds counted.
    pub timestamp_its: u64,
    /// Latitude and longitude in 10^-7 degree, if they are known.
    pub coordinates: Option<(i32, i32)>,
    /// True if the position is known to 40 m.
    pub is_accurate: bool,
    /// 0.01 m/s, -16384..16383; negative backwards.
    pub speed: i16,
    /// 0.1 degree, clockwise from north: 0..3599.
    pub heading: u16,
}

impl EgoPosition {
    /// The position vector of a robot in this state. A speed or heading that is not known is 0: the
    /// packet has no other number for it.
    #[must_use]
    pub fn of(state: &RobotState, timestamp_its: u64) -> Self {
        let position = &state.position;
        let latitude = si::LATITUDE.encode(position.latitude);
        let longitude = si::longitude(position.longitude);
        let is_known =
            si::LATITUDE.decode(latitude).is_some() && si::longitude_degrees(longitude).is_some();
        let heading = si::angle(state.heading.map(|heading| heading.value));
        let speed = state.speed.map_or(0.0, |speed| speed.value);
        Self {
            timestamp_its,
            coordinates: is_known.then_some((latitude, longitude)),
            is_accurate: position
                .ellipse
                .is_some_and(|ellipse| ellipse.semi_major <= ACCURATE_METRES),
            speed: signed_speed(speed, state.drive_direction),
            heading: if heading < 3_600 { heading } else { 0 },
        }
    }

    /// The vector in the packets of the station with this address. A position that is not known is 0,
    /// 0, and not accurate.
    #[must_use]
    pub fn vector(&self, address: Address) -> LongPositionVector {
        let (latitude, longitude) = self.coordinates.unwrap_or_default();
        #[expect(clippy::cast_possible_truncation, reason = "it is modulo 2^32")]
        let timestamp = self.timestamp_its as u32;
        LongPositionVector {
            address,
            timestamp,
            latitude,
            longitude,
            is_accurate: self.is_accurate && self.coordinates.is_some(),
            speed: self.speed,
            heading: self.heading,
        }
    }
}

/// m/s as 0.01 m/s in 15 bits.
fn signed_speed(speed: f64, direction: DriveDirection) -> i16 {
    let signed = match direction {
        DriveDirection::Backward => -speed,
        _ => speed,
    };
    #[expect(clippy::cast_possible_truncation, reason = "it is clamped; NaN is 0")]
    let steps = (signed * 100.0).round().clamp(-16_384.0, 16_383.0) as i16;
    steps
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::{ConfidenceEllipse, Position};

    #[test]
    fn a_robot_is_where_its_state_says() {
        let ellipse = ConfidenceEllipse {
            semi_major: 1.0,
            semi_minor: 0.5,
            orientation: 90.0,
        };
        let state = RobotState {
            position: Position {
                ellipse: Some(ellipse),
                ..Position::at(48.765_432_1, -9.123_456_7)
            },
            heading: Some(90.0.into()),
            speed: Some(1.39.into()),
            ..RobotState::default()
        };
        let expected = EgoPosition {
            timestamp_its: 694_694_401_000,
            coordinates: Some((487_654_321, -91_234_567)),
            is_accurate: true,
            speed: 139,
            heading: 900,
        };
        assert_eq!(EgoPosition::of(&state, 694_694_401_000), expected);
        let vector = expected.vector(Address::of_station(7, 12));
        assert_eq!(vector.timestamp, 0xBF03_53E8);
        let reversing = RobotState {
            drive_direction: DriveDirection::Backward,
            ..state
        };
        assert_eq!(EgoPosition::of(&reversing, 0).speed, -139);
    }

    #[test]
    fn what_is_not_known_is_not_claimed() {
        let vector = EgoPosition::of(&RobotState::default(), 1).vector(Address::of_station(7, 12));
        assert_eq!((vector.latitude, vector.longitude), (0, 0));
        assert_eq!((vector.speed, vector.heading), (0, 0));
        assert!(!vector.is_accurate);
    }
}
