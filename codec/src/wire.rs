//! Parts that the mappings share: bit sets with a counterpart on the wire, sessions, task sets, reasons.

use crossguard_protocol::{
    Ending, SessionId, SessionNumber, StationId, TaskSet, TaskType, Unavailability, UniqueNumber,
    Urgency,
};

use crate::core::{cdd, common, ram};
use crate::si::Ladder;

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

            /// True if every member of `other` is in the set.
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

pub(crate) use bit_set;

/// Bit *n* stands for task type *n* on both sides.
pub(crate) fn task_set(tasks: TaskSet) -> common::TaskSet {
    common::TaskSet::new(tasks.0)
}

pub(crate) fn tasks_of(tasks: common::TaskSet) -> TaskSet {
    TaskSet(tasks.bits())
}

const _: () = assert!(common::TaskType::MAX as usize + 1 == TaskType::COUNT);

pub(crate) fn task_type(task: TaskType) -> common::TaskType {
    common::TaskType::saturating(task.value())
}

pub(crate) fn task_type_of(task: common::TaskType) -> TaskType {
    // Both have the same values, so the default is never taken.
    TaskType::new(task.get()).unwrap_or(TaskType::INITIAL_POS)
}

pub(crate) fn station(station: StationId) -> cdd::StationId {
    cdd::StationId(station.0)
}

pub(crate) fn station_of(station: cdd::StationId) -> StationId {
    StationId(station.0)
}

pub(crate) fn session(session: SessionId) -> common::CoordinationSession {
    common::CoordinationSession {
        leader_station_id: station(session.leader),
        session_number: session_number(session.number),
    }
}

pub(crate) fn session_of(session: common::CoordinationSession) -> SessionId {
    SessionId {
        leader: station_of(session.leader_station_id),
        number: session_number_of(session.session_number),
    }
}

pub(crate) fn session_number(number: SessionNumber) -> common::SessionNumber {
    common::SessionNumber(number.0.to_u32())
}

pub(crate) fn session_number_of(number: common::SessionNumber) -> SessionNumber {
    SessionNumber(UniqueNumber::from_u32(number.0))
}

/// Defines both conversions between an enumeration of the protocol and the ENUMERATED that has the same names.
macro_rules! mirrored {
    ($to_wire:ident, $of_wire:ident: $own:ty, $wire:ty { $($variant:ident),+ }) => {
        pub(crate) const fn $to_wire(own: $own) -> $wire {
            match own {
                $(<$own>::$variant => <$wire>::$variant,)+
            }
        }

        pub(crate) const fn $of_wire(wire: $wire) -> $own {
            match wire {
                $(<$wire>::$variant => <$own>::$variant,)+
            }
        }
    };
}

mirrored!(reason, reason_of: Unavailability, common::UnavailabilityReason {
    LowBattery, Teleoperated, EmergencyStop, LocalFault, NotSafe
});
mirrored!(urgency, urgency_of: Urgency, ram::RequestUrgency { Low, Medium, High, Emergency });
mirrored!(ending, ending_of: Ending, ram::SessionEnding { Completed, Aborted });

/// The class of a half width among all `classes` of an ENUMERATED confidence, the last of which is
/// *unavailable*.
pub(crate) fn class<E: Copy>(ladder: &Ladder, half_width: Option<f64>, classes: &[E]) -> E {
    classes[ladder.encode(half_width).min(classes.len() - 1)]
}
