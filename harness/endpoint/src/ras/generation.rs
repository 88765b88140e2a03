//! When a RAM is sent: the generation rules of CAM, applied to robots, and a robot's own events.
//!
//! The rule of CAM is EN 302 637-2 clause 6.1.3: a message is due when the station has moved, turned
//! or changed its speed enough since the last one, at the latest after the interval at which it
//! happened last, which falls back to a second after three messages without a change. Congestion
//! control (DCC) sets the shortest interval. [`Cadence`] is that rule, for CAM as well.
//!
//! A robot has its own reasons besides: its role, its help status, its task or its availability has
//! changed. In a session the protocol says when (its RAM timer and its `SendRam` outputs), and
//! [`Generation::event`] tells what of these it was. Events of a session are not held back by
//! congestion control; a session's heartbeat is what its leases count on.

use crossguard_codec::{RobotState, TaskProgression};
use crossguard_protocol::{Availability, Coordination, Ram};
use serde::{Deserialize, Serialize};

use super::motion::Change;

/// Shortest interval between two messages, in ms (`T_GenCamMin`).
pub const INTERVAL_MIN_MS: u64 = 100;
/// Longest interval between two messages, in ms (`T_GenCamMax`).
pub const INTERVAL_MAX_MS: u64 = 1_000;
/// Shortest interval between two low-frequency containers, in ms.
pub const LOW_FREQUENCY_INTERVAL_MS: u64 = 500;
/// How many messages without a change keep the interval of the last one with a change (`N_GenCam`).
const REPETITIONS_MAX: u8 = 3;
/// Distance from the last message's position that triggers the next, in metres.
pub const POSITION_TRIGGER_M: f64 = 4.0;
/// Change of heading that triggers the next message, in degrees.
pub const HEADING_TRIGGER_DEG: f64 = 4.0;
/// Change of speed that triggers the next message, in m/s.
pub const SPEED_TRIGGER_MPS: f64 = 0.5;

/// Why a message went out.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Trigger {
    /// The protocol said so: an RMCM.
    Protocol,
    /// The robot's first RAM.
    First,
    /// The robot took, changed or gave up its role in a session.
    Role,
    /// The robot asks for help, offers it, or no longer does.
    HelpStatus,
    /// The robot's task has come further.
    Task,
    /// The robot became available or unavailable.
    Availability,
    /// The period of RAM in a session is over: a heartbeat or its echo.
    Heartbeat,
    /// The longest interval is over.
    Interval,
    /// The robot has moved.
    Position,
    /// The robot has turned.
    Heading,
    /// The robot has changed its speed.
    Speed,
}

impl Trigger {
    /// Which change of motion is large enough to be told, if one is.
    #[must_use]
    pub fn of_motion(change: &Change) -> Option<Self> {
        let exceeds = |quantity: Option<f64>, limit| quantity.is_some_and(|it| it > limit);
        if exceeds(change.distance_m, POSITION_TRIGGER_M) {
            Some(Self::Position)
        } else if exceeds(change.turn_deg, HEADING_TRIGGER_DEG) {
            Some(Self::Heading)
        } else if exceeds(change.speed_mps, SPEED_TRIGGER_MPS) {
            Some(Self::Speed)
        } else {
            None
        }
    }

    const fn is_motion(self) -> bool {
        matches!(self, Self::Position | Self::Heading | Self::Speed)
    }
}

/// Within what the interval between two messages stays.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Limits {
    /// The shortest interval that congestion control allows, in ms (`T_GenCam_DCC`). A value outside
    /// of 100..1000 counts as the nearer end.
    pub congestion_ms: u64,
    /// The longest interval, in ms; at most 1000.
    pub max_ms: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            congestion_ms: INTERVAL_MIN_MS,
            max_ms: INTERVAL_MAX_MS,
        }
    }
}

/// When messages went out, and at which interval the next is due without a change: the rule of CAM.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Cadence {
    last_ms: Option<u64>,
    /// `T_GenCam`.
    interval_ms: u64,
    repetitions: u8,
}

impl Default for Cadence {
    fn default() -> Self {
        Self {
            last_ms: None,
            interval_ms: INTERVAL_MAX_MS,
            repetitions: 0,
        }
    }
}

impl Cadence {
    /// Why a message is due at `now_ms`, if one is; `change` is that since the last message.
    #[must_use]
    pub fn trigger(&self, now_ms: u64, limits: Limits, change: &Change) -> Option<Trigger> {
        let Some(last_ms) = self.last_ms else {
            return Some(Trigger::First);
        };
        let elapsed = now_ms.saturating_sub(last_ms);
        if elapsed < limits.congestion_ms.clamp(INTERVAL_MIN_MS, INTERVAL_MAX_MS) {
            return None;
        }
        let by_interval = elapsed >= self.interval_ms.min(limits.max_ms);
        Trigger::of_motion(change).or(by_interval.then_some(Trigger::Interval))
    }

    /// Notes that a message went out.
    pub fn sent(&mut self, now_ms: u64, trigger: Trigger) {
        if let Some(last_ms) = self.last_ms.replace(now_ms) {
            if trigger.is_motion() {
                let elapsed = now_ms.saturating_sub(last_ms);
                self.interval_ms = elapsed.clamp(INTERVAL_MIN_MS, INTERVAL_MAX_MS);
                self.repetitions = 0;
            } else if trigger == Trigger::Interval {
                self.repetitions = self.repetitions.saturating_add(1);
                if self.repetitions >= REPETITIONS_MAX {
                    self.interval_ms = INTERVAL_MAX_MS;
                }
            }
        }
    }

    /// When the last message went out, in ms.
    #[must_use]
    pub const fn last_ms(&self) -> Option<u64> {
        self.last_ms
    }
}

/// When the low-frequency container goes along: with the first message, and again after 500 ms.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct LowFrequency {
    last_ms: Option<u64>,
}

impl LowFrequency {
    /// Whether the next message has it.
    #[must_use]
    pub fn is_due(&self, now_ms: u64) -> bool {
        self.last_ms
            .is_none_or(|last| now_ms.saturating_sub(last) >= LOW_FREQUENCY_INTERVAL_MS)
    }

    /// Notes that it went along.
    pub const fn sent(&mut self, now_ms: u64) {
        self.last_ms = Some(now_ms);
    }
}

/// Fields of a RAM whose changes are events.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Status {
    /// Its part in a session.
    pub view: Ram,
    /// Whether the robot takes part in coordination.
    pub availability: Availability,
    /// How far it is with its task.
    pub progression: TaskProgression,
}

/// Content and time of the last RAM.
#[derive(Clone, Debug, Default)]
pub struct Generation {
    cadence: Cadence,
    said: Option<(RobotState, Status)>,
    low_frequency: LowFrequency,
}

impl Generation {
    /// Why a RAM is due now, if one is, to a robot without a session.
    #[must_use]
    pub fn trigger(
        &self,
        now_ms: u64,
        limits: Limits,
        state: &RobotState,
        status: &Status,
    ) -> Option<Trigger> {
        let Some((before, _)) = &self.said else {
            return Some(Trigger::First);
        };
        let since = |last_ms| now_ms.saturating_sub(last_ms);
        let is_early = self.cadence.last_ms().map(since) < Some(INTERVAL_MIN_MS);
        let event = self.event(status).filter(|_| !is_early);
        event.or_else(|| {
            let change = Change::of_robot(before, state);
            self.cadence.trigger(now_ms, limits, &change)
        })
    }

    /// Event of the robot since its last RAM, if there was one.
    #[must_use]
    pub fn event(&self, now: &Status) -> Option<Trigger> {
        let Some((_, before)) = &self.said else {
            return Some(Trigger::First);
        };
        let (then_in, now_in) = (&before.view.coordination, &now.view.coordination);
        if role(then_in) != role(now_in) || before.view.farewell != now.view.farewell {
            Some(Trigger::Role)
        } else if help(then_in) != help(now_in) {
            Some(Trigger::HelpStatus)
        } else if before.availability != now.availability {
            Some(Trigger::Availability)
        } else if report(then_in) != report(now_in)
            || before.view.on_duty != now.view.on_duty
            || before.progression != now.progression
        {
            Some(Trigger::Task)
        } else {
            None
        }
    }

    /// Whether the next RAM has the low-frequency container: each half second, and at once where the robot shows
    /// something else to people than its last RAM said.
    #[must_use]
    pub fn low_frequency_due(&self, now_ms: u64, state: &RobotState) -> bool {
        let signals = |state: &RobotState| state.slow.as_ref().and_then(|slow| slow.signals);
        let said = self.said.as_ref().map(|(said, _)| signals(said));
        self.low_frequency.is_due(now_ms) || said.is_some_and(|said| said != signals(state))
    }

    /// Notes that a RAM went out.
    pub fn sent(
        &mut self,
        now_ms: u64,
        trigger: Trigger,
        state: &RobotState,
        status: Status,
        with_low_frequency: bool,
    ) {
        self.cadence.sent(now_ms, trigger);
        self.said = Some((state.clone(), status));
        if with_low_frequency {
            self.low_frequency.sent(now_ms);
        }
    }
}

/// The role in a session, without what changes at every heartbeat.
fn role(coordination: &Coordination) -> impl PartialEq + use<> {
    match *coordination {
        Coordination::Leader {
            number,
            followers,
            yields,
            ..
        } => Some((Some((number, followers, yields)), None)),
        Coordination::Follower { session, .. } => Some((None, Some(session))),
        _ => None,
    }
}

/// Request or offer, without the fields that change at every heartbeat.
fn help(coordination: &Coordination) -> impl PartialEq + use<> {
    match *coordination {
        Coordination::NeedHelp {
            number, request, ..
        } => Some((Some((number, request)), None)),
        Coordination::OfferHelp { session, offer, .. } => Some((None, Some((session, offer)))),
        _ => None,
    }
}

/// Report of a follower on its command.
fn report(coordination: &Coordination) -> impl PartialEq + use<> {
    match *coordination {
        Coordination::Follower { last, .. } => last,
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use crossguard_codec::{Position, PublicSignal, SignalMeans, SignalsShown, SlowState};
    use crossguard_protocol::{
        Farewell, Heartbeat, OfferNumber, SessionId, SessionNumber, StationId, UniqueNumber,
    };
    use proptest::prelude::*;

    use super::*;

    fn at(latitude: f64, heading: f64, speed: f64) -> RobotState {
        RobotState {
            position: Position::at(latitude, 8.4),
            heading: Some(heading.into()),
            speed: Some(speed.into()),
            ..RobotState::default()
        }
    }

    fn status(coordination: Coordination) -> Status {
        Status {
            view: Ram {
                station: StationId(7),
                coordination,
                farewell: None,
                on_duty: false,
            },
            availability: Availability::Available,
            progression: TaskProgression::Idle,
        }
    }

    fn after_one(state: &RobotState) -> Generation {
        let mut generation = Generation::default();
        let idle = status(Coordination::None);
        let first = generation.trigger(0, Limits::default(), state, &idle);
        assert_eq!(first, Some(Trigger::First));
        generation.sent(0, Trigger::First, state, idle, true);
        generation
    }

    fn idle_trigger(generation: &Generation, now_ms: u64, state: &RobotState) -> Option<Trigger> {
        let idle = status(Coordination::None);
        generation.trigger(now_ms, Limits::default(), state, &idle)
    }

    #[test]
    fn a_robot_that_stands_still_sends_once_a_second() {
        let state = at(49.0, 0.0, 0.0);
        let generation = after_one(&state);
        assert_eq!(idle_trigger(&generation, 999, &state), None);
        let due = idle_trigger(&generation, 1_000, &state);
        assert_eq!(due, Some(Trigger::Interval));
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
            assert_eq!(idle_trigger(&generation, 99, &state), None);
            assert_eq!(idle_trigger(&generation, 100, &state), Some(trigger));
        }
        let little = at(49.000_03, 2.5, 1.4);
        assert_eq!(idle_trigger(&generation, 100, &little), None);
    }

    #[test]
    fn the_interval_of_a_motion_is_kept_for_three_messages() {
        let mut cadence = Cadence::default();
        let (still, limits) = (Change::default(), Limits::default());
        cadence.sent(0, Trigger::First);
        cadence.sent(300, Trigger::Speed);
        let mut now_ms = 300;
        for expected in [300, 300, 300, 1_000, 1_000] {
            let early = cadence.trigger(now_ms + expected - 1, limits, &still);
            assert_eq!(early, None);
            now_ms += expected;
            let due = cadence.trigger(now_ms, limits, &still);
            assert_eq!(due, Some(Trigger::Interval));
            cadence.sent(now_ms, Trigger::Interval);
        }
    }

    #[test]
    fn congestion_control_holds_motion_back() {
        let mut cadence = Cadence::default();
        cadence.sent(0, Trigger::First);
        let turned = Change {
            turn_deg: Some(90.0),
            ..Change::default()
        };
        let limits = Limits {
            congestion_ms: 400,
            ..Limits::default()
        };
        assert_eq!(cadence.trigger(399, limits, &turned), None);
        let due = cadence.trigger(400, limits, &turned);
        assert_eq!(due, Some(Trigger::Heading));
    }

    #[test]
    fn the_low_frequency_container_goes_along_every_half_second() {
        let generation = after_one(&at(49.0, 0.0, 0.0));
        let state = RobotState::default();
        assert!(!generation.low_frequency_due(499, &state));
        assert!(generation.low_frequency_due(500, &state));
    }

    /// Hazard: people are told to wait, and for half a second nobody hears of it.
    #[test]
    fn the_low_frequency_container_goes_along_at_once_when_something_else_is_shown() {
        let showing = |to_pedestrians| {
            let signals = SignalsShown {
                to_vehicles: PublicSignal::None,
                to_pedestrians,
                means: SignalMeans::GESTURE,
            };
            let slow = Some(SlowState {
                signals: Some(signals),
                ..SlowState::default()
            });
            RobotState {
                slow,
                ..at(49.0, 0.0, 0.0)
            }
        };
        let generation = after_one(&showing(PublicSignal::None));
        assert!(!generation.low_frequency_due(1, &showing(PublicSignal::None)));
        assert!(generation.low_frequency_due(1, &showing(PublicSignal::Stop)));
    }

    #[test]
    fn every_event_has_its_name() {
        let state = at(49.0, 0.0, 0.0);
        let generation = after_one(&state);
        let number = UniqueNumber { boot: 1, count: 0 };
        let session = SessionId {
            leader: StationId(9),
            number: SessionNumber(number),
        };
        let follower = status(Coordination::Follower {
            session,
            echo: Heartbeat(1),
            last: None,
        });
        assert_eq!(generation.event(&follower), Some(Trigger::Role));
        let mut offer = status(Coordination::None);
        offer.view.farewell = Some(Farewell::Left(session, OfferNumber(number)));
        assert_eq!(generation.event(&offer), Some(Trigger::Role));
        let mut task = status(Coordination::None);
        task.progression = TaskProgression::Executing;
        assert_eq!(generation.event(&task), Some(Trigger::Task));
        let mut duty = status(Coordination::None);
        duty.view.on_duty = true;
        assert_eq!(generation.event(&duty), Some(Trigger::Task));
        assert_eq!(generation.event(&status(Coordination::None)), None);

        let mut following = generation;
        following.sent(0, Trigger::Role, &state, follower, false);
        let echo = status(Coordination::Follower {
            session,
            echo: Heartbeat(2),
            last: None,
        });
        assert_eq!(following.event(&echo), None);
    }

    proptest! {
        /// Whatever a station does and congestion control says: never two messages within 100 ms,
        /// never more than a second of silence, and a trigger that is what it says.
        #[test]
        fn the_interval_stays_within_its_limits(
            changes in proptest::collection::vec((0.0..8.0_f64, 0.0..8.0_f64, 0.0..1.0_f64, 0_u64..1_500), 1..60)
        ) {
            let mut cadence = Cadence::default();
            let (mut now_ms, mut last_ms) = (0, None);
            for (distance, turn, speed, congestion_ms) in changes {
                let change = Change {
                    distance_m: Some(distance),
                    turn_deg: Some(turn),
                    speed_mps: Some(speed),
                };
                let limits = Limits { congestion_ms, ..Limits::default() };
                for _ in 0..10 {
                    now_ms += 50;
                    let due = cadence.trigger(now_ms, limits, &change);
                    let elapsed = last_ms.map(|last: u64| now_ms - last);
                    match due {
                        None => prop_assert!(elapsed.is_some_and(|it| it < 1_000)),
                        Some(trigger) => {
                            prop_assert!(elapsed.is_none_or(|it| it >= 100));
                            prop_assert!(elapsed.is_none_or(|it| it >= congestion_ms.min(1_000)));
                            prop_assert_eq!(trigger == Trigger::Position, last_ms.is_some() && distance > 4.0);
                            cadence.sent(now_ms, trigger);
                            last_ms = Some(now_ms);
                        }
                    }
                }
            }
        }
    }
}
