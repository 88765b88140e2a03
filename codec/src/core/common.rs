//! Crossguard-Common: what RAM and RMCM share: sessions, task types and the state of a task. No
//! standard defines these types; they are Crossguard's, after Arockiasamy and Vinel, "Multi-Robot
//! Coordination in V2X Environments" (ITSC 2026).
//!
//! Generated from `asn1/Crossguard-Common.asn` by `tests/generated`; do not edit.

use super::notation::prelude::*;

asn1! {
    /// A coordination session: the station that opened it and leads it, and its number for it.
    CoordinationSession ::= SEQUENCE {
        leader_station_id StationId,
        session_number    SessionNumber
    }
}

asn1! {
    /// Number that its leader never uses again: the boot counter in the upper 16 bits, a count
    /// since that boot in the lower ones.
    SessionNumber ::= INTEGER (0..4_294_967_295) is u32
}

asn1! {
    /// Number of an offer to help that the helper never uses again, built like a session number.
    OfferNumber ::= INTEGER (0..4_294_967_295) is u32
}

asn1! {
    /// Number of a command to one follower within a session: a serial number modulo 256.
    RequestId ::= INTEGER (0..255) is u8
}

asn1! {
    /// Kind of a maneuver: go to the place where it starts, escort a pedestrian, hold back one
    /// direction of traffic. The other values are for the robots' own use.
    TaskType ::= INTEGER (0..15) as u8
}

asn1! {
    /// Set of task types: bit n stands for task type n.
    TaskSet ::= BIT STRING (SIZE(16)) as u16
}

asn1! {
    /// How far a robot is with its task. executing: on the way; `inPosition`: it holds the place
    /// from which it guards; `safeIdle`: it stopped because it lost contact with its leader.
    TaskProgression ::= ENUMERATED { Idle, Executing, InPosition, Completed, Failed, SafeIdle, ... }
}

asn1! {
    /// Why a robot takes no part in coordination.
    UnavailabilityReason ::= ENUMERATED {
        LowBattery, Teleoperated, EmergencyStop, LocalFault, NotSafe, ...
    }
}
