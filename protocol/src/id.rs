//! Identifiers and serial numbers.

use core::fmt;

/// Station identifier, `StationId` of ETSI TS 102 894-2 (0..4294967295).
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(transparent))]
pub struct StationId(pub u32);

/// A number that its station never gives out twice: boot counter and count since that boot.
///
/// The boot counter is the only thing a robot persists. It is written before the robot takes part
/// in anything, so a rebooted robot cannot repeat a number.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct UniqueNumber {
    /// Boot counter of the station that gave the number out.
    pub boot: u16,
    /// Count since that boot, from 0.
    pub count: u16,
}

impl UniqueNumber {
    /// The number as it stands on the wire: boot counter in the upper half.
    #[must_use]
    pub const fn to_u32(self) -> u32 {
        (self.boot as u32) << 16 | self.count as u32
    }

    /// The number from its form on the wire.
    #[must_use]
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the halves are taken on purpose"
    )]
    pub const fn from_u32(wire: u32) -> Self {
        Self {
            boot: (wire >> 16) as u16,
            count: wire as u16,
        }
    }
}

impl fmt::Display for UniqueNumber {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}", self.boot, self.count)
    }
}

/// Session number: unique for the leader that opened the session.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(transparent))]
pub struct SessionNumber(pub UniqueNumber);

/// Offer number: unique for the helper that made the offer.
///
/// A leader confirms a follower by its station id *and* offer number, so that a helper that
/// rebooted or left cannot be drawn back into a session by a late confirmation of an old offer.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(transparent))]
pub struct OfferNumber(pub UniqueNumber);

/// A coordination session: the leader that opened it and the number it gave it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SessionId {
    /// The station that opened the session and leads it.
    pub leader: StationId,
    /// Its number for the session.
    pub number: SessionNumber,
}

impl SessionId {
    /// The session to which this leader gave this number.
    #[must_use]
    pub const fn of(leader: StationId, number: SessionNumber) -> Self {
        Self { leader, number }
    }
}

impl fmt::Display for StationId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl fmt::Display for SessionId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}#{}", self.leader, self.number.0)
    }
}

/// The `requestID` of a command: a serial number of 8 bits, per follower and session.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(transparent))]
pub struct RequestId(pub u8);

impl RequestId {
    /// How many commands one follower may get in one session: less than half the number space, so
    /// that the order of any two numbers of a session is never in doubt.
    pub const MAX_PER_SESSION: u8 = 127;

    /// True if this number comes after `other` in serial number order (RFC 1982, 8 bits).
    #[must_use]
    pub const fn is_newer_than(self, other: Self) -> bool {
        let distance = self.distance_from(other);
        distance != 0 && distance < 1 << 7
    }

    /// The number that follows this one.
    #[must_use]
    pub const fn next(self) -> Self {
        Self(self.0.wrapping_add(1))
    }

    /// How many steps lead from `other` to this number, modulo 256.
    #[must_use]
    pub const fn distance_from(self, other: Self) -> u8 {
        self.0.wrapping_sub(other.0)
    }
}

impl fmt::Display for RequestId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// The heartbeat number of a leader: a serial number of 16 bits that counts RAM periods.
///
/// It is bumped once for every period that has passed, also for those in which the leader was too
/// late to send. So heartbeat *n* is never sent earlier than *n* periods after the first, and the
/// age of a heartbeat follows from its number alone.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(transparent))]
pub struct Heartbeat(pub u16);

impl Heartbeat {
    /// Half the number space: two heartbeats of one session are always closer than this.
    pub const HALF_SPACE: u32 = 1 << 15;

    /// True if this number comes after `other` in serial number order (RFC 1982, 16 bits).
    #[must_use]
    pub const fn is_newer_than(self, other: Self) -> bool {
        let distance = self.distance_from(other);
        distance != 0 && (distance as u32) < Self::HALF_SPACE
    }

    /// True if this number is `other` or less than half the number space newer: a robot whose newest
    /// heartbeat is this one can have sent `other`.
    #[must_use]
    pub(crate) const fn can_follow(self, other: Self) -> bool {
        (self.distance_from(other) as u32) < Self::HALF_SPACE
    }

    /// The number `periods` later.
    #[must_use]
    pub const fn after(self, periods: u16) -> Self {
        Self(self.0.wrapping_add(periods))
    }

    /// How many periods lead from `other` to this number, modulo 65536.
    #[must_use]
    pub const fn distance_from(self, other: Self) -> u16 {
        self.0.wrapping_sub(other.0)
    }
}

impl fmt::Display for Heartbeat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// One accepted command: the session, and its `requestID` in it.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ManeuverId {
    /// The session in which the command was given.
    pub session: SessionId,
    /// The command's number.
    pub request: RequestId,
}

impl ManeuverId {
    /// The command of this number in this session.
    #[must_use]
    pub const fn of(session: SessionId, request: RequestId) -> Self {
        Self { session, request }
    }
}

impl fmt::Display for ManeuverId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.session, self.request)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws::numbers as laws;

    #[test]
    fn serial_numbers_stand_in_the_order_in_which_they_were_given_out() {
        for number in 0..=u16::MAX {
            let [first, a] = number.to_be_bytes().map(RequestId);
            laws::requests_are_in_one_order(first, a);
            laws::requests_of_a_session_are_transitive(first, a, first, first);
            laws::the_next_request_is_newer(a);
            let (known, other) = (Heartbeat(65_530), Heartbeat(number));
            laws::heartbeats_are_in_one_order(known, other);
            laws::later_heartbeats_are_newer(known, number);
        }
    }

    #[test]
    fn unique_numbers_keep_their_value_on_the_wire() {
        let number = UniqueNumber {
            boot: 0x1234,
            count: 0x5678,
        };
        assert_eq!(number.to_u32(), 0x1234_5678);
        assert_eq!(UniqueNumber::from_u32(number.to_u32()), number);
    }
}
