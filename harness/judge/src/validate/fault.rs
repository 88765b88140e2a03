//! Faults of a record.

use crossguard_endpoint::counters::CauseName;
use crossguard_model_check::properties::PropertyId;
use crossguard_protocol::{BrokenInequality, StationId};

use crossguard_codec::Unheard;
use crossguard_robot::trace::Unreadable;

use super::traffic::Coming;

/// Fault of a record. Each reads on after the robot's name.
#[derive(Debug, thiserror::Error)]
pub enum Fault {
    /// The log cannot be read on.
    #[error(transparent)]
    Unreadable(#[from] Unreadable),
    /// The robot runs with settings that break an inequality.
    #[error("was started although {0}")]
    Settings(BrokenInequality),
    /// The robot does something without having been started.
    #[error("does something and was never started")]
    NotStarted,
    /// The robot booted with a counter that it had before.
    #[error("booted with counter {0}, which is not larger than at its boot before")]
    BootReused(u16),
    /// The robot's clock went back.
    #[error("has a clock that went back from {before_us} µs to {at_us} µs")]
    ClockWentBack {
        /// Its time before, in µs.
        before_us: u64,
        /// Its time, in µs.
        at_us: u64,
    },
    /// The robot was told of more time than has passed.
    #[error("was told that {told_ms} ms passed since it was started, and it was {passed_ms} ms")]
    TimeFromNowhere {
        /// Time that it was told, in ms since its start.
        told_ms: u64,
        /// Time that has passed, in ms.
        passed_ms: u64,
    },
    /// The robot was told of less time than had passed when its record before was written.
    #[error(
        "was told that {told_ms} ms passed since it was started, and it had been {passed_ms} ms at its record before"
    )]
    TimeLost {
        /// Time that it was told, in ms since its start.
        told_ms: u64,
        /// Time that had passed, in ms.
        passed_ms: u64,
    },
    /// The robot took in a message without having been told of the time before it.
    #[error("took in a message at {taken_us} µs, and was told of the time until {told_us} µs")]
    NotToldFirst {
        /// When it took the message in.
        taken_us: u64,
        /// Until when it had been told of time.
        told_us: u64,
    },
    /// The times of a reception are not in their order.
    #[error(
        "heard a message that arrived at {arrived_us} µs, took it in at {told_us} µs and recorded it at {at_us} µs"
    )]
    ReceivedBefore {
        /// When it arrived.
        arrived_us: u64,
        /// When the robot was told of it.
        told_us: u64,
        /// When that was recorded.
        at_us: u64,
    },
    /// The robot took in a message that had waited for too long.
    #[error("took in a message that had waited for {waited_ms} ms; delay_max is {delay_max_ms} ms")]
    TooOld {
        /// For how long it waited.
        waited_ms: u64,
        /// For how long it may.
        delay_max_ms: u64,
    },
    /// A step puts out something else.
    #[error("on '{input}' put out [{found}]; the protocol puts out [{expected}]")]
    Outputs {
        /// Input of the step.
        input: String,
        /// Outputs in the log.
        found: String,
        /// Outputs of the transition function.
        expected: String,
    },
    /// A step leads into another state.
    #[error("on '{input}' went into a state that the protocol does not lead to")]
    State {
        /// Input of the step.
        input: String,
    },
    /// A message was put out and not sent.
    #[error("put out {0} and did not send it")]
    NotSent(String),
    /// A message was sent that the state does not say.
    #[error("sent {found}, where its state says {expected}")]
    SentOther {
        /// The message that was sent.
        found: String,
        /// The message that is to be sent.
        expected: String,
    },
    /// A message was heard and not taken in.
    #[error("heard '{0}' and did not take it in")]
    NotTakenIn(String),
    /// A message was taken in that was not heard.
    #[error("took in '{found}', which is not what it heard ({heard})")]
    NotHeard {
        /// The message that was taken in.
        found: String,
        /// The message that was heard.
        heard: String,
    },
    /// The octets of a message are not what the record says of them.
    #[error("recorded octets that are not the {0} it says")]
    OtherOctets(String),
    /// The octets of a message are none.
    #[error("recorded octets that are no message: {0}")]
    NoMessage(Unheard),
    /// A message was heard that its sender did not send.
    #[error("heard a message of station {0} that is not among those it had sent")]
    NoTransmission(StationId),
    /// Two followers were sent to one place.
    #[error(
        "sent {follower} to a place {metres} m from where it sent {other}, and both accepted; at least 1 m is wanted between bodies"
    )]
    SamePlace {
        /// The follower that accepted last.
        follower: StationId,
        /// The other one.
        other: StationId,
        /// How far apart the places are.
        metres: f64,
    },
    /// A counter differs from the log.
    #[error("counted '{cause}' {counted} times, and its log has it {logged} times")]
    Counter {
        /// The cause.
        cause: CauseName,
        /// How often it was counted.
        counted: u64,
        /// How often it is in the log.
        logged: u64,
    },
    /// A guard left by an application's word while somebody was on the carriageway.
    #[error(
        "broke P1: guard {robot} left because of '{word}', and {by} saw somebody on the carriageway, {east:.1} m east \
         and {north:.1} m north of the first place in the logs"
    )]
    GuardLeft {
        /// The guard.
        robot: String,
        /// The word of an application.
        word: String,
        /// The robot that saw the person.
        by: String,
        /// Where, in metres.
        east: f64,
        /// Likewise.
        north: f64,
    },
    /// Go was shown while a guard was away from its place.
    #[error(
        "broke P2: go is shown, and guard {robot} was at its place {away_ms} ms ago; at most {may_ms} ms are allowed"
    )]
    GuardAway {
        /// The guard.
        robot: String,
        /// For how long.
        away_ms: u64,
        /// How long it may be away.
        may_ms: u64,
    },
    /// An escort moved on without its person.
    #[error(
        "broke P4: escort {robot} moves {ahead_m:.1} m ahead of somebody whom it sees on the carriageway; at most {may_m:.1} m are allowed"
    )]
    EscortAhead {
        /// The escort.
        robot: String,
        /// How far it is ahead, in metres.
        ahead_m: f64,
        /// How far it may be.
        may_m: f64,
    },
    /// A sign begins to show go in front of a vehicle.
    #[error("broke P3: {0} begins to show go while {1}")]
    GoBeforeVehicle(String, Coming),
    /// A robot steps on an empty road before a vehicle that could no longer stop.
    #[error("broke P9: {0} steps on the road while {1}")]
    StepsBeforeVehicle(String, Coming),
    /// A property is broken.
    #[error("broke {}: {}", .0.name(), .0.statement())]
    Broken(PropertyId),
}
