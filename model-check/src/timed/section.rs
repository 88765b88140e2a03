//! The `[timed]` section of a scenario.

use crossguard_protocol::{Millis, Settings};
use serde::Deserialize;

use super::clock::Clock;
use super::rules::TimedProperty;
use crate::scenario::{Bounds, Channel, RobotSetup};

/// The file's form of the section.
#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Section {
    /// True time of a tick.
    tick_ms: u32,
    /// The longest that a message is under way.
    delay_ms: u32,
}

/// What makes a scenario a timed one.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Timed {
    /// Ticks and clocks.
    pub clock: Clock,
    /// The longest that a message is under way, a multiple of the tick.
    pub delay: Millis,
    /// The properties to check.
    pub properties: Vec<TimedProperty>,
    /// Place of the robot that detects.
    pub(super) leader: u8,
    /// The delay in ticks.
    pub(super) delay_ticks: u8,
}

/// What is wrong with a timed scenario.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum TimedImpossibility {
    /// The tick is too long or zero.
    #[error(
        "a tick of {tick} ms: between 1 ms and 'delay_max' ({delay_max} ms) are possible, for robots are told of time once a tick"
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
    /// Several robots detect.
    #[error("a timed scenario has one robot that detects, not {0}")]
    Detectors(usize),
    /// What the timed model has no use for.
    #[error(
        "'{0}' has no place in a timed scenario: 'delay_ms' bounds for how long messages are under way, messages get lost without number, a run begins with its one detection, and crashes are for good"
    )]
    Untimed(&'static str),
    /// An unknown property.
    #[error("no timed property '{0}': I10, I11, I12, I16, L1, L5")]
    Property(String),
}

impl Section {
    /// The section's meaning in a scenario, or the key that is wrong and why.
    pub(crate) fn check(
        self,
        settings: &Settings,
        robots: &[RobotSetup],
        bounds: Bounds,
        channel: Channel,
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
        let mut detectors = (0..).zip(robots).filter(|(_, robot)| robot.detects);
        let (Some((leader, _)), None) = (detectors.next(), detectors.next()) else {
            let detectors = robots.iter().filter(|robot| robot.detects).count();
            return Err(("robots", I::Detectors(detectors)));
        };
        let without_meaning = [
            ("delayed", channel.delayed),
            ("detections", bounds.detections),
            ("restarts", bounds.restarts),
            ("losses", bounds.losses.map_or(0, |_| 1)),
        ];
        if let Some((key, _)) = without_meaning.into_iter().find(|(_, bound)| *bound > 0) {
            return Err((key, I::Untimed(key)));
        }
        Ok(Timed {
            clock,
            delay: Millis(delay),
            properties: Vec::new(),
            leader,
            delay_ticks,
        })
    }
}
