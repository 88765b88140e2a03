//! The `[timed]` section of a scenario.

use crossguard_protocol::{Millis, Settings};
use serde::Deserialize;

use super::clock::Clock;
use super::teams::Teams;
use crate::properties::{PropertyId, listed};
use crate::scenario::setup::{Bounds, ChannelSetup, RobotSetup};

/// The file's form of the section.
#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Section {
    /// True time of a tick.
    tick_ms: u32,
    /// The longest that a message is under way.
    delay_ms: u32,
    /// Whether each endpoint looks when it likes, not all of them at every tick.
    #[serde(default)]
    free: bool,
    /// How late free endpoints look; `delay_max` where nothing is said. Another value is an endpoint
    /// that does not do what its settings say.
    late_ms: Option<u32>,
    /// Whether clocks change their rates.
    #[serde(default)]
    rates: Rates,
    /// The longest that a robot hangs, on its own clock.
    #[serde(default)]
    hang_ms: u32,
}

/// When endpoints look at their clocks, and give the time to their robots.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Looks {
    /// All of them at every tick.
    EachTick,
    /// Each when it likes, at the latest so long after a timer became due.
    Within(Millis),
}

/// Whether clocks that drift change their rates.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Rates {
    /// Each clock is slow or fast at every tick anew.
    #[default]
    Changing,
    /// Each clock is slow in a whole run, or fast in a whole run.
    Constant,
}

/// What makes a scenario a timed one.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Timed {
    /// Ticks and clocks.
    pub clock: Clock,
    /// The longest that a message is under way, a multiple of the tick.
    pub delay: Millis,
    /// When endpoints look.
    pub looks: Looks,
    /// Whether clocks that drift change their rates.
    pub rates: Rates,
    /// The longest that a robot hangs, on its own clock.
    pub hang: Millis,
    /// The properties to check.
    pub properties: Vec<PropertyId>,
    /// The robots that detect, each with its helpers.
    pub(super) teams: Teams,
    /// The delay in ticks.
    pub(super) delay_ticks: u8,
}

impl Timed {
    /// Whether the scenario claims a property.
    #[must_use]
    pub fn claims(&self, property: PropertyId) -> bool {
        self.properties.contains(&property)
    }
}

/// What is wrong with a timed scenario.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum TimedImpossibility {
    /// The tick is too long or zero.
    #[error(
        "a tick of {tick} ms: between 1 ms and 'delay_max' ({delay_max} ms) are possible, since robots take in the time once a tick"
    )]
    Tick {
        /// Of the section.
        tick: u32,
        /// Of the settings.
        delay_max: u32,
    },
    /// The delay is no number of ticks, or too many.
    #[error(
        "messages under way for up to {delay} ms: between 0 and 8 ticks of {tick} ms are possible"
    )]
    Delay {
        /// Of the section.
        delay: u32,
        /// Of the section.
        tick: u32,
    },
    /// The drift does not show.
    #[error(
        "a drift of {drift_ppm} ppm is less than 1 ms in a tick of {tick} ms: it would not show"
    )]
    Drift {
        /// Of the settings.
        drift_ppm: u32,
        /// Of the section.
        tick: u32,
    },
    /// Endpoints that look each tick are never late.
    #[error("'late_ms' is for endpoints that look when they like: 'free = true'")]
    Late,
    /// Hangs without a length, a length without hangs, or one that is no time of a model.
    #[error(
        "hangs of up to {0} ms: between 1 and 60000 ms are possible, with 'hangs' among the bounds"
    )]
    Hang(u32),
    /// No robot detects, or too many do, or the robots of no team come first.
    #[error(
        "{0} robots detect: in a timed scenario one does, or two that each begin a team, listed before its other robots"
    )]
    Detectors(usize),
    /// A failure where two teams meet.
    #[error("'{0}' has no place in a timed scenario with two teams: no robot fails there")]
    TwoTeams(&'static str),
    /// What the timed model has no use for.
    #[error(
        "'{0}' has no place in a timed scenario: 'delay_ms' bounds for how long messages are under way, messages get lost without number, a run begins with its one detection, and crashes are for good"
    )]
    Untimed(&'static str),
    /// An unknown property.
    #[error("no timed property '{0}': {list}", list = listed(PropertyId::all_timed()))]
    Property(String),
}

impl Section {
    /// The section's meaning in a scenario, or the key that is wrong and why.
    pub(crate) fn check(
        self,
        settings: &Settings,
        robots: &[RobotSetup],
        bounds: Bounds,
        channel: ChannelSetup,
    ) -> Result<Timed, (&'static str, TimedImpossibility)> {
        use TimedImpossibility as I;
        let (tick, delay, drift_ppm) = (self.tick_ms, self.delay_ms, settings.drift_ppm);
        let delay_max = settings.delay_max.0;
        if !(1..=delay_max).contains(&tick) {
            return Err(("tick_ms", I::Tick { tick, delay_max }));
        }
        let delay_ticks = u8::try_from(delay / tick).unwrap_or(u8::MAX);
        if !delay.is_multiple_of(tick) || delay_ticks > 8 {
            return Err(("delay_ms", I::Delay { delay, tick }));
        }
        let clock = Clock::new(Millis(tick), drift_ppm)
            .ok_or(("drift_ppm", I::Drift { drift_ppm, tick }))?;
        let looks = match (self.free, self.late_ms) {
            (true, late) => Looks::Within(late.map_or(settings.delay_max, Millis)),
            (false, None) => Looks::EachTick,
            (false, Some(_)) => return Err(("late_ms", I::Late)),
        };
        let hang = self.hang_ms;
        if hang > 60_000 || (hang > 0) != (bounds.hangs > 0) {
            let key = if hang > 0 { "hang_ms" } else { "hangs" };
            return Err((key, I::Hang(hang)));
        }
        let teams = Teams::of(robots).ok_or_else(|| {
            let detectors = robots.iter().filter(|robot| robot.detects).count();
            ("robots", I::Detectors(detectors))
        })?;
        let failures = [
            ("crashes", bounds.crashes),
            ("disturbances", bounds.disturbances),
            ("hangs", bounds.hangs),
        ];
        if teams.are_two()
            && let Some((key, _)) = failures.into_iter().find(|(_, bound)| *bound > 0)
        {
            return Err((key, I::TwoTeams(key)));
        }
        let without_meaning = [
            ("delayed", channel.delayed),
            ("detections", bounds.detections),
            ("restarts", bounds.restarts),
            ("losses", bounds.losses.map_or(0, |_| 1)),
            ("monotone", channel.monotone.into()),
        ];
        if let Some((key, _)) = without_meaning.into_iter().find(|(_, bound)| *bound > 0) {
            return Err((key, I::Untimed(key)));
        }
        Ok(Timed {
            clock,
            delay: Millis(delay),
            looks,
            rates: self.rates,
            hang: Millis(hang),
            properties: Vec::new(),
            teams,
            delay_ticks,
        })
    }
}
