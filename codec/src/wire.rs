//! What the mappings share: enumerations and bit sets with a counterpart on the wire, sessions, task
//! sets, reasons.

use crossguard_protocol::{
    SessionId, SessionNumber, StationId, TaskSet, Unavailability, UniqueNumber,
};
use rasn::types::{Enumerated, FixedBitString};

use crate::asn1::{cdd, common};
use crate::si::Ladder;

/// Defines an enumeration and its conversion to and from an ENUMERATED of the modules.
macro_rules! wire_enum {
    (
        $(#[$attribute:meta])*
        $name:ident as $wire:path {
            $($(#[$variant_attribute:meta])* $variant:ident = $wire_variant:ident,)*
        }
    ) => {
        $(#[$attribute])*
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
        #[derive(serde::Serialize, serde::Deserialize)]
        #[serde(rename_all = "camelCase")]
        pub enum $name {
            $($(#[$variant_attribute])* $variant,)*
        }

        impl $name {
            pub(crate) const fn to_wire(self) -> $wire {
                use $wire as Wire;
                match self {
                    $(Self::$variant => Wire::$wire_variant,)*
                }
            }

            pub(crate) const fn from_wire(wire: $wire) -> Self {
                use $wire as Wire;
                match wire {
                    $(Wire::$wire_variant => Self::$variant,)*
                }
            }
        }
    };
}

/// Defines a set whose member *n* is bit *n* of a BIT STRING of eight bits.
macro_rules! bit_set {
    (
        $(#[$attribute:meta])*
        $name:ident { $($(#[$member_attribute:meta])* $member:ident = $bit:literal,)* }
    ) => {
        $(#[$attribute])*
        ///
        /// Member *n* is bit *n*, the lowest being bit 0.
        #[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
        #[derive(serde::Serialize, serde::Deserialize)]
        #[serde(transparent)]
        pub struct $name(pub u8);

        impl $name {
            $($(#[$member_attribute])* pub const $member: Self = Self(1 << $bit);)*

            /// Whether every member of `other` is in the set.
            #[must_use]
            pub const fn contains(self, other: Self) -> bool {
                self.0 & other.0 == other.0
            }

            /// The members of both sets.
            #[must_use]
            pub const fn union(self, other: Self) -> Self {
                Self(self.0 | other.0)
            }
        }
    };
}

pub(crate) use {bit_set, wire_enum};

/// Eight bits of a set as a BIT STRING.
pub(crate) fn bits8(set: u8) -> FixedBitString<8> {
    let mut bits = FixedBitString::ZERO;
    bits.data[0] = set.reverse_bits();
    bits
}

pub(crate) fn set8(bits: FixedBitString<8>) -> u8 {
    bits.data[0].reverse_bits()
}

/// Bit *n* stands for task type *n* on both sides.
pub(crate) fn task_set(tasks: TaskSet) -> common::TaskSet {
    let mut bits = FixedBitString::ZERO;
    [bits.data[0], bits.data[1]] = tasks.0.reverse_bits().to_be_bytes();
    common::TaskSet(bits)
}

pub(crate) fn tasks_of(common::TaskSet(bits): &common::TaskSet) -> TaskSet {
    TaskSet(u16::from_be_bytes([bits.data[0], bits.data[1]]).reverse_bits())
}

pub(crate) fn session(session: SessionId) -> common::CoordinationSession {
    common::CoordinationSession::new(
        cdd::StationId(session.leader.0),
        common::SessionNumber(session.number.0.to_u32()),
    )
}

pub(crate) fn session_of(session: &common::CoordinationSession) -> SessionId {
    SessionId {
        leader: StationId(session.leader_station_id.0),
        number: session_number_of(&session.session_number),
    }
}

pub(crate) fn session_number_of(number: &common::SessionNumber) -> SessionNumber {
    SessionNumber(UniqueNumber::from_u32(number.0))
}

pub(crate) fn reason(reason: Unavailability) -> common::UnavailabilityReason {
    use common::UnavailabilityReason as Wire;
    match reason {
        Unavailability::LowBattery => Wire::lowBattery,
        Unavailability::Teleoperated => Wire::teleoperated,
        Unavailability::EmergencyStop => Wire::emergencyStop,
        Unavailability::LocalFault => Wire::localFault,
        Unavailability::NotSafe => Wire::notSafe,
    }
}

pub(crate) fn reason_of(reason: common::UnavailabilityReason) -> Unavailability {
    use common::UnavailabilityReason as Wire;
    match reason {
        Wire::lowBattery => Unavailability::LowBattery,
        Wire::teleoperated => Unavailability::Teleoperated,
        Wire::emergencyStop => Unavailability::EmergencyStop,
        Wire::localFault => Unavailability::LocalFault,
        Wire::notSafe => Unavailability::NotSafe,
    }
}

/// The class of an ENUMERATED confidence. Its last value is *unavailable*.
pub(crate) fn class<E: Enumerated>(ladder: &Ladder, half_width: Option<f64>) -> E {
    let last = E::VARIANTS.len() - 1;
    E::VARIANTS[ladder.encode(half_width).min(last)]
}

pub(crate) fn half_width<E: Enumerated>(ladder: &Ladder, class: E) -> Option<f64> {
    ladder.decode(class.enumeration_index())
}
