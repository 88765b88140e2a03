//! The `[timed]` section of a scenario.

use crossguard_protocol::{Millis, Settings};
use serde::Deserialize;

use super::clock::Clock;
use super::teams::Teams;
use crate::properties::PropertyId;
use crate::scenario::location::Wrong;
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

/// The part of a scenario that makes it a timed one.
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
    pub(crate) teams: Teams,
    pub(super) delay_ticks: u8,
}

impl Timed {
    /// Whether the scenario claims a property.
    #[must_use]
    pub fn claims(&self, property: PropertyId) -> bool {
        self.properties.contains(&property)
    }
}

pub(crate) fn no_place_for(key: &'static str) -> Wrong {
    let cause = format!(
        "'{key}' has no place in a timed scenario: 'delay_ms' bounds for how long messages are under way, messages get lost without number, a run begins with its one detection, and crashes are for good"
    );
    Wrong::key(key, cause)
}

impl Section {
    pub(crate) fn check(
        self,
        settings: &Settings,
        robots: &[RobotSetup],
        bounds: Bounds,
        channel: ChannelSetup,
    ) -> Result<Timed, Wrong> {
        let (tick, delay, drift_ppm) = (self.tick_ms, self.delay_ms, settings.drift_ppm);
        let delay_max = settings.delay_max.0;
        if !(1..=delay_max).contains(&tick) {
            let cause = format!(
                "a tick of {tick} ms: between 1 ms and 'delay_max' ({delay_max} ms) are possible, since robots take in the time once a tick"
            );
            return Err(Wrong::key("tick_ms", cause));
        }
        let delay_ticks = u8::try_from(delay / tick).unwrap_or(u8::MAX);
        if !delay.is_multiple_of(tick) || delay_ticks > 8 {
            let cause = format!(
                "messages under way for up to {delay} ms: between 0 and 8 ticks of {tick} ms are possible"
            );
            return Err(Wrong::key("delay_ms", cause));
        }
        let clock = Clock::new(Millis(tick), drift_ppm).ok_or_else(|| {
            let cause = format!(
                "a drift of {drift_ppm} ppm is less than 1 ms in a tick of {tick} ms: it would not show"
            );
            Wrong::key("drift_ppm", cause)
        })?;
        let looks = match (self.free, self.late_ms) {
            (true, late) => Looks::Within(late.map_or(settings.delay_max, Millis)),
            (false, None) => Looks::EachTick,
            (false, Some(_)) => {
                let cause = "'late_ms' is for endpoints that look when they like: 'free = true'";
                return Err(Wrong::key("late_ms", cause));
            }
        };
        let hang = self.hang_ms;
        if hang > 60_000 || (hang > 0) != (bounds.hangs > 0) {
            let key = if hang > 0 { "hang_ms" } else { "hangs" };
            let cause = format!(
                "hangs of up to {hang} ms: between 1 and 60000 ms are possible, with 'hangs' among the bounds"
            );
            return Err(Wrong::key(key, cause));
        }
        let teams = Teams::of(robots).ok_or_else(|| {
            let detectors = robots.iter().filter(|robot| robot.detects).count();
            let cause = format!(
                "{detectors} robots detect: in a timed scenario one does, or two that each begin a team, listed before its other robots"
            );
            Wrong::key("robots", cause)
        })?;
        let failures = [
            ("crashes", bounds.crashes),
            ("disturbances", bounds.disturbances),
            ("hangs", bounds.hangs),
        ];
        if teams.are_two()
            && let Some((key, _)) = failures.into_iter().find(|(_, bound)| *bound > 0)
        {
            let cause = format!(
                "'{key}' has no place in a timed scenario with two teams: no robot fails there"
            );
            return Err(Wrong::key(key, cause));
        }
        let without_meaning = [
            ("delayed", channel.delayed),
            ("detections", bounds.detections),
            ("restarts", bounds.restarts),
            ("drifts", bounds.drifts),
            ("sightings", bounds.sightings),
            ("losses", bounds.losses.map_or(0, |_| 1)),
            ("monotone", channel.monotone.into()),
        ];
        if let Some((key, _)) = without_meaning.into_iter().find(|(_, bound)| *bound > 0) {
            return Err(no_place_for(key));
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
