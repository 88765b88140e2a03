//! Timers, limits and capabilities of a robot, and the inequalities that tie them together.

use core::fmt;

use crate::id::{Heartbeat, RequestId};
use crate::task::{FallbackPolicy, TaskSet, TaskType};
use crate::time::Millis;
use crate::words::words;

/// The values that a robot is configured with. [`Config::new`] checks them.
///
/// Times are from 1 ms to one day. [`Inequality`] has the conditions between them. Robots of a team may have
/// different settings: a helper tells its `t_safety` in its offer, and a requester takes no offer whose
/// `t_safety` its own lease does not fit. Drift and `delay_max` must be the same for all.
///
/// The paper gives no timers. It measures a command's way to the follower: 74 ms ± 15 ms, and 129 ms ± 102 ms, and its
/// maneuvers: 0.50 s for `initialPos`, and 21.60 s for `Move`. The defaults follow from these where they can:
///
/// | default | why |
/// |---|---|
/// | `t_ack` 0.6 s | An acknowledgement takes a second way. Two of the slower kind take 258 ms ± 144 ms if they are independent, which leaves 2.4 deviations. A later one costs a repetition, and harms nobody. |
/// | `t_select` 0.3 s | An offer whose way is two deviations longer than that of the first one (0.2 s) is still considered. |
/// | `t_safety` 2 s | A second in which nothing arrives, and then a heartbeat that takes 0.6 s, end no maneuver. |
/// | `t_lease` 1.9 s | The longest, to 50 ms, that `t_safety` allows ([`Inequality::LeaseWithinSafety`]). |
/// | `t_exec` 5 s, 60 s | Ten times the paper's `initialPos`, and nearly three times its `Move`. |
/// | `t_cross` 30 s | The paper's `Move`, and two fifths of it to spare. |
/// | `t_offer` 3 s, `t_help` 10 s, `t_leave` 5 s | What a helper, a person at the kerb and a follower put up with; the paper says nothing of it. |
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(rename_all = "camelCase", default, deny_unknown_fields)
)]
pub struct Settings {
    /// Interval of RAM in a session; a leader bumps its heartbeat at the same pace. 100 ms by default,
    /// the shortest interval of CAM (EN 302 637-2, clause 6.1.3).
    pub ram_period: Millis,
    /// How long a requester gathers offers, counted from the first, before it selects; 300 ms by default.
    /// It selects sooner when [`Event::AllAnswered`](crate::Event::AllAnswered) says that no other offer can come.
    pub t_select: Millis,
    /// How long a helper stays reserved after the newest heartbeat of its requester; 3 s by
    /// default.
    pub t_offer: Millis,
    /// How long a request for help stands; 10 s by default.
    pub t_help: Millis,
    /// How long a leader waits for an acknowledgement before it repeats the command; 600 ms by default.
    pub t_ack: Millis,
    /// How often a leader repeats a command, 1..=15; 3 by default.
    pub n_ack: u8,
    /// How long a follower goes on without a newer heartbeat or command; 2 s by default.
    pub t_safety: Millis,
    /// How long a leader's lease stands after it sent the newest echoed heartbeat; 1.9 s by default.
    pub t_lease: Millis,
    /// How long a follower stays in the session after `t_safety` ran out; 5 s by default.
    pub t_leave: Millis,
    /// How long a robot names a session as over; 1 s by default.
    pub t_farewell: Millis,
    /// How long the identity may stay locked, farewells included; 5 minutes by default.
    pub t_lock: Millis,
    /// How long a pedestrian needs to cross at most; 30 s by default. A corridor opens only where the
    /// identity lock and the execution limits leave so much time.
    pub t_cross: Millis,
    /// `T_exec` by task type: how long a maneuver may run; by default 5 s for `initialPos` and 60 s for
    /// the others.
    pub t_exec: [Millis; TaskType::COUNT],
    /// Largest error of a robot's clock rate, in parts per million, below 100,000; 1000 by default.
    pub drift_ppm: u32,
    /// Longest time by which the endpoint is late to tell the robot that time has passed, and by which a
    /// message is old when it is told, on the robot's own clock; 50 ms by default. The endpoint has no other
    /// clock to keep it by.
    pub delay_max: Millis,
    /// The maneuvers that this robot can do; the three with names by default.
    pub capabilities: TaskSet,
    /// The maneuvers under which a pedestrian may cross; the corridor opens only for these. `move` and
    /// `block` by default, and always among them.
    pub guarding: TaskSet,
    /// The maneuvers that guard from a place: the corridor opens only once the follower has reported
    /// that it is in position. `block` by default, and always among them.
    pub holding: TaskSet,
    /// Fallback policy by task type; by default escort to the nearer kerb from `move`, hold until clear for
    /// `block`, stop in place for the others.
    pub fallback: [FallbackPolicy; TaskType::COUNT],
    /// First `requestID` of every follower in a session; 0 by default.
    pub first_request: RequestId,
    /// First heartbeat of a session; 0 by default.
    pub first_heartbeat: Heartbeat,
}

/// [`Settings`] as configuration files spell them: in `snake_case`, where JSON is in `camelCase`.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(
    remote = "Settings",
    default = "Settings::default",
    deny_unknown_fields
)]
pub struct SettingsInFiles {
    ram_period: Millis,
    t_select: Millis,
    t_offer: Millis,
    t_help: Millis,
    t_ack: Millis,
    n_ack: u8,
    t_safety: Millis,
    t_lease: Millis,
    t_leave: Millis,
    t_farewell: Millis,
    t_lock: Millis,
    t_cross: Millis,
    t_exec: [Millis; TaskType::COUNT],
    drift_ppm: u32,
    delay_max: Millis,
    capabilities: TaskSet,
    guarding: TaskSet,
    holding: TaskSet,
    fallback: [FallbackPolicy; TaskType::COUNT],
    first_request: RequestId,
    first_heartbeat: Heartbeat,
}

impl Default for Settings {
    fn default() -> Self {
        let mut t_exec = [Millis(60_000); TaskType::COUNT];
        t_exec[TaskType::INITIAL_POS.value() as usize] = Millis(5_000);
        let mut fallback = [FallbackPolicy::StopInPlace; TaskType::COUNT];
        fallback[TaskType::MOVE.value() as usize] = FallbackPolicy::EscortToKerb;
        fallback[TaskType::BLOCK.value() as usize] = FallbackPolicy::HoldUntilClear;
        Self {
            ram_period: Millis(100),
            t_select: Millis(300),
            t_offer: Millis(3_000),
            t_help: Millis(10_000),
            t_ack: Millis(600),
            n_ack: 3,
            t_safety: Millis(2_000),
            t_lease: Millis(1_900),
            t_leave: Millis(5_000),
            t_farewell: Millis(1_000),
            t_lock: Millis(300_000),
            t_cross: Millis(30_000),
            t_exec,
            drift_ppm: 1_000,
            delay_max: Millis(50),
            capabilities: TaskSet::of(&[TaskType::INITIAL_POS, TaskType::MOVE, TaskType::BLOCK]),
            guarding: TaskSet::of(&[TaskType::MOVE, TaskType::BLOCK]),
            holding: TaskSet::of(&[TaskType::BLOCK]),
            fallback,
            first_request: RequestId(0),
            first_heartbeat: Heartbeat(0),
        }
    }
}

impl Settings {
    /// True if a timer of `own` here ends before a timer of `theirs` on another robot that was started no
    /// earlier, whatever the two clocks do and however late this robot learns of it.
    const fn ends_before(&self, own: Millis, theirs: Millis) -> bool {
        let drift = self.drift_ppm as u64;
        let own = own.0 as u64 + self.delay_max.0 as u64;
        own * (1_000_000 + drift) < theirs.0 as u64 * (1_000_000 - drift)
    }
}

/// Settings that satisfy every inequality; the default settings do.
#[derive(Clone, PartialEq, Eq, Hash, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Settings", into = "Settings"))]
pub struct Config(Settings);

words! {
    /// An inequality that settings must satisfy. Its text is the formula.
    pub enum Inequality in "kebab-case" {
        /// Every timer is at least 1 ms and at most one day.
        TimerInRange = 0, "1 ms <= every timer <= 86400000 ms";
        /// `1 <= n_ack <= 15`.
        RepeatsInRange = 1, "1 <= n_ack <= 15";
        /// `drift_ppm < 100000`.
        DriftInRange = 2, "drift_ppm < 100000";
        /// `(t_lease + delay_max) * (1 + drift) < t_safety * (1 - drift)`: the lease ends before the
        /// follower can have fallen back, whatever the two clocks do (property I10). Both times of the leader are
        /// on its own clock, which may be slow for both.
        LeaseWithinSafety = 3, "(t_lease + delay_max) * (1 + drift) < t_safety * (1 - drift)";
        /// `3 * ram_period <= t_lease`: a lease survives two lost heartbeats.
        HeartbeatsWithinLease = 4, "3 * ram_period <= t_lease";
        /// `t_select < t_offer`: an offer is still reserved when the requester selects.
        SelectionWithinOffer = 5, "t_select < t_offer";
        /// `(3 * ram_period + delay_max) * (1 + drift) < t_offer * (1 - drift)`: an offer survives two lost
        /// heartbeats, on both sides.
        HeartbeatsWithinOffer = 6, "(3 * ram_period + delay_max) * (1 + drift) < t_offer * (1 - drift)";
        /// `t_offer <= t_help`: no helper waits longer than the request stands.
        OfferWithinHelp = 7, "t_offer <= t_help";
        /// `3 * ram_period <= t_farewell`: a farewell survives two lost RAM.
        FarewellRepeated = 8, "3 * ram_period <= t_farewell";
        /// `t_help + t_farewell + t_exec < t_lock` for each task that the robot can do, and
        /// `t_help + t_farewell < t_lock` if it can do none: the lock outlasts the shortest useful
        /// session.
        LockOutlastsTask = 9, "t_help + t_farewell + t_exec < t_lock for every capability, t_exec 0 for none";
        /// `t_cross + t_farewell < t_lock`, and `t_cross <= t_exec` for each guarding task that the robot can
        /// do: a crossing that begins can end.
        CrossingWithinLimits = 10, "t_cross + t_farewell < t_lock, and t_cross <= t_exec for every guarding capability";
        /// `t_lock / ram_period < 32768`: two heartbeats of a session are less than half the number
        /// space apart.
        HeartbeatsInNumberSpace = 11, "t_lock / ram_period < 32768";
        /// `move` and `block` are in `guarding`: a robot that took them for anything else would leave people on the
        /// road.
        NamedTasksGuard = 12, "move and block are in guarding";
        /// `block` is in `holding`: the corridor would open while the guard is on its way.
        BlockHolds = 13, "block is in holding";
    }
}

impl Inequality {
    pub(crate) fn holds(self, s: &Settings) -> bool {
        let thrice_period = s.ram_period.0.saturating_mul(3);
        match self {
            Self::TimerInRange => {
                let named = [
                    s.ram_period,
                    s.t_select,
                    s.t_offer,
                    s.t_help,
                    s.t_ack,
                    s.t_safety,
                    s.t_lease,
                    s.t_leave,
                    s.t_farewell,
                    s.t_lock,
                    s.t_cross,
                ];
                let in_range = |t: &Millis| (Millis(1)..=Millis::MAX_TIMER).contains(t);
                named.iter().all(in_range)
                    && s.t_exec.iter().all(in_range)
                    && s.delay_max <= Millis::MAX_TIMER
            }
            Self::RepeatsInRange => (1..=15).contains(&s.n_ack),
            Self::DriftInRange => s.drift_ppm < 100_000,
            Self::LeaseWithinSafety => s.ends_before(s.t_lease, s.t_safety),
            Self::HeartbeatsWithinLease => thrice_period <= s.t_lease.0,
            Self::SelectionWithinOffer => s.t_select < s.t_offer,
            Self::HeartbeatsWithinOffer => s.ends_before(Millis(thrice_period), s.t_offer),
            Self::OfferWithinHelp => s.t_offer <= s.t_help,
            Self::FarewellRepeated => thrice_period <= s.t_farewell.0,
            Self::LockOutlastsTask => {
                let session = s.t_help.saturating_add(s.t_farewell);
                let outlasts = |task: TaskType| {
                    session.saturating_add(s.t_exec[task.value() as usize]) < s.t_lock
                };
                session < s.t_lock && s.capabilities.iter().all(outlasts)
            }
            Self::CrossingWithinLimits => {
                let mut guarding = s.capabilities.intersection(s.guarding).iter();
                s.t_cross.saturating_add(s.t_farewell) < s.t_lock
                    && guarding.all(|task| s.t_cross <= s.t_exec[task.value() as usize])
            }
            Self::HeartbeatsInNumberSpace => s.t_lock.0 / s.ram_period.0 < Heartbeat::HALF_SPACE,
            Self::NamedTasksGuard => {
                s.guarding.contains(TaskType::MOVE) && s.guarding.contains(TaskType::BLOCK)
            }
            Self::BlockHolds => s.holding.contains(TaskType::BLOCK),
        }
    }
}

/// Settings break an inequality.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct BrokenInequality(pub Inequality);

impl fmt::Display for BrokenInequality {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(inequality) = self;
        write!(
            f,
            "the settings break '{}': {inequality}",
            inequality.name()
        )
    }
}

impl core::error::Error for BrokenInequality {}

impl Config {
    /// Checks `settings`.
    ///
    /// # Errors
    /// The first inequality that does not hold.
    pub fn new(settings: Settings) -> Result<Self, BrokenInequality> {
        match Inequality::ALL
            .into_iter()
            .find(|inequality| !inequality.holds(&settings))
        {
            Some(broken) => Err(BrokenInequality(broken)),
            None => Ok(Self(settings)),
        }
    }

    /// The configuration of `settings` that satisfy some of the inequalities.
    #[cfg(any(test, feature = "laws"))]
    pub(crate) const fn unchecked(settings: Settings) -> Self {
        Self(settings)
    }

    /// The settings that were checked.
    #[must_use]
    pub const fn settings(&self) -> &Settings {
        &self.0
    }

    /// `T_exec` of a task.
    #[must_use]
    pub const fn t_exec(&self, task: TaskType) -> Millis {
        self.0.t_exec[task.value() as usize]
    }

    /// Fallback policy of a task.
    #[must_use]
    pub const fn fallback(&self, task: TaskType) -> FallbackPolicy {
        self.0.fallback[task.value() as usize]
    }

    /// True if a lease of this robot ends before a follower with this `t_safety` can have fallen back.
    #[must_use]
    pub const fn lease_fits(&self, t_safety: Millis) -> bool {
        self.0.ends_before(self.0.t_lease, t_safety)
    }

    /// How long a requester counts on an offer after it sent the newest heartbeat that the offer echoes.
    /// It ends before the reservation of a helper with the same `t_offer` can have lapsed.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "it is not above `t_offer`")]
    pub const fn t_offer_lease(&self) -> Millis {
        let drift = self.0.drift_ppm as u64;
        let on_fast_clock = self.0.t_offer.0 as u64 * (1_000_000 - drift) / (1_000_000 + drift);
        Millis(on_fast_clock as u32)
            .saturating_sub(self.0.delay_max)
            .saturating_sub(Millis(1))
    }

    /// How long a leader keeps a follower whose lease has expired: by then a follower that is deaf
    /// has left of its own accord.
    #[must_use]
    pub const fn t_lost(&self) -> Millis {
        self.0.t_safety.saturating_add(self.0.t_leave)
    }

    /// How long the identity is locked before the session is ended in order, so that the farewell
    /// is over when [`Settings::t_lock`] is reached.
    #[must_use]
    pub const fn t_lock_session(&self) -> Millis {
        self.0.t_lock.saturating_sub(self.0.t_farewell)
    }
}

impl TryFrom<Settings> for Config {
    type Error = BrokenInequality;

    fn try_from(settings: Settings) -> Result<Self, BrokenInequality> {
        Self::new(settings)
    }
}

impl From<Config> for Settings {
    fn from(config: Config) -> Self {
        config.0
    }
}
