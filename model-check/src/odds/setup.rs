//! Subject of an analysis: a team, its settings, and a channel.

use crossguard_protocol::{Config, Millis, TaskType};
use serde::Serialize;

/// The most followers that a team may have here: the number of states is about a power of theirs.
pub const FOLLOWERS_MAX: u8 = 3;

/// How far apart bounds may be by default, by the number of followers.
pub(super) const WIDTHS: [f64; FOLLOWERS_MAX as usize] = [1e-9, 1e-5, 1e-3];

/// The same where losses come in bursts: the links have states of their own.
const BURST_WIDTHS: [f64; FOLLOWERS_MAX as usize] = [1e-9, 1e-3, 1e-2];

/// A team and what surrounds it. The loss rate is no part of it: which states there are does not depend on it.
#[derive(Clone, Debug)]
pub struct OddsSetup {
    pub(super) config: Config,
    pub(super) followers: u8,
    grid: TimeGrid,
    /// The mean length of a burst of losses; `None` where losses are independent.
    pub(super) burst: Option<Millis>,
    hold: Millis,
    /// How far apart the bounds of a probability may be.
    pub(super) width: f64,
    coupling: Coupling,
}

/// How the links of several followers are taken together, once the team is gathered.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Coupling {
    /// All in one chain.
    Joint,
    /// One at a time, as if the others lost nothing; all links are independent, and what a leader keeps of one follower
    /// does not depend on another one (property I17). How old the news of one follower is when the team is full does
    /// depend on when the others joined; that is left out.
    LinkByLink,
}

/// The grid of time, and how long a message takes on it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct TimeGrid {
    /// The time between two points of the grid.
    pub tick: Millis,
    /// How long each message takes, a multiple of the tick.
    pub delay: Millis,
}

/// Why there can be no such model: what was asked for, and what is wanted instead.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("{0}")]
pub struct OddsImpossibility(String);

impl TimeGrid {
    /// The coarsest grid on which the RAM period and this delay are whole and endpoints are not late by more than
    /// `delay_max`.
    #[must_use]
    pub fn coarsest(config: &Config, delay: Millis) -> Self {
        let settings = config.settings();
        let common = common_divisor(settings.ram_period.0, delay.0).max(1);
        let fits = |tick: &u32| common.is_multiple_of(*tick) && *tick <= settings.delay_max.0;
        let tick = (1..=common).rev().find(fits).unwrap_or(1);
        Self {
            tick: Millis(tick),
            delay,
        }
    }

    /// This many points of the grid are at or after the end of a time.
    #[must_use]
    pub fn ticks(self, time: Millis) -> usize {
        time.0.div_ceil(self.tick.0) as usize
    }

    /// The time of this many ticks, in ms.
    #[must_use]
    pub fn millis(self, ticks: usize) -> u64 {
        ticks as u64 * u64::from(self.tick.0)
    }
}

const fn common_divisor(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { common_divisor(b, a % b) }
}

impl OddsSetup {
    /// A leader and `followers` followers with these settings. A message takes the delay of the grid; with `burst`,
    /// losses come in bursts of this mean length. The maneuver takes `hold`.
    ///
    /// # Errors
    /// A number is out of its range, or does not fit the grid.
    pub fn new(
        config: Config,
        followers: u8,
        grid: TimeGrid,
        burst: Option<Millis>,
        hold: Millis,
    ) -> Result<Self, OddsImpossibility> {
        let wrong = |why| Err(OddsImpossibility(why));
        if !(1..=FOLLOWERS_MAX).contains(&followers) {
            return wrong(format!(
                "{followers} followers: a number from 1 to {FOLLOWERS_MAX} is wanted"
            ));
        }
        let TimeGrid {
            tick: Millis(tick),
            delay: Millis(delay),
        } = grid;
        let (ram_period, delay_max) = (
            config.settings().ram_period.0,
            config.settings().delay_max.0,
        );
        // With a tick of a millisecond every timer ends on the grid, and nobody is late.
        let is_late = tick > 1 && tick > delay_max;
        if tick == 0 || is_late || !ram_period.is_multiple_of(tick) || !delay.is_multiple_of(tick) {
            return wrong(format!(
                "a grid of {tick} ms: it must divide ram_period ({ram_period} ms) and the delay ({delay} ms), and be no \
                 longer than delay_max ({delay_max} ms), by which an endpoint may look at its clock late"
            ));
        }
        if !(1..=200).contains(&(delay / tick)) {
            return wrong(format!(
                "a delay of {delay} ms: from 1 to 200 ticks of the grid, {tick} ms, are wanted"
            ));
        }
        if let Some(Millis(burst)) = burst
            && burst < tick
        {
            return wrong(format!(
                "bursts of {burst} ms on average: at least a tick of the grid, {tick} ms, is wanted"
            ));
        }
        let longest = config.t_exec(TaskType::MOVE).0;
        if !(tick..=longest).contains(&hold.0) {
            return wrong(format!(
                "a maneuver of {hold}: from a tick, {tick} ms, to its t_exec, {longest} ms, is wanted"
            ));
        }
        Ok(Self {
            config,
            followers,
            grid,
            burst,
            hold,
            width: if burst.is_none() {
                WIDTHS[usize::from(followers) - 1]
            } else {
                BURST_WIDTHS[usize::from(followers) - 1]
            },
            coupling: if followers == 1 {
                Coupling::Joint
            } else {
                Coupling::LinkByLink
            },
        })
    }

    /// The same with the links taken together in another way.
    #[must_use]
    pub const fn with_coupling(mut self, coupling: Coupling) -> Self {
        self.coupling = coupling;
        self
    }

    /// How the links of several followers are taken together.
    #[must_use]
    pub const fn coupling(&self) -> Coupling {
        self.coupling
    }

    /// The same with other bounds: so far apart at most, all stages together. Closer ones take more states.
    #[must_use]
    pub const fn with_width(mut self, width: f64) -> Self {
        self.width = width;
        self
    }

    /// Whether there is such a channel at this loss rate.
    ///
    /// # Errors
    /// Why there is none.
    pub fn check_loss(&self, loss: f64) -> Result<(), OddsImpossibility> {
        let wrong = |why| Err(OddsImpossibility(why));
        if !(0.0..1.0).contains(&loss) {
            return wrong(format!(
                "a loss rate of {loss}: a number from 0 to less than 1 is wanted"
            ));
        }
        let tick = self.grid.tick.0;
        match self.burst {
            Some(Millis(burst)) if f64::from(tick) * loss > f64::from(burst) * (1.0 - loss) => {
                wrong(format!(
                    "bursts of {burst} ms on average at a loss rate of {loss}: two of them would be less than a tick, \
                     {tick} ms, apart; longer bursts or a lower rate are possible"
                ))
            }
            _ => Ok(()),
        }
    }

    /// The settings of every robot.
    #[must_use]
    pub const fn config(&self) -> &Config {
        &self.config
    }

    /// The grid of time.
    #[must_use]
    pub const fn grid(&self) -> TimeGrid {
        self.grid
    }

    /// How long the maneuver takes.
    #[must_use]
    pub const fn hold(&self) -> Millis {
        self.hold
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn setup(
        grid: (u32, u32),
        burst: Option<u32>,
        hold: u32,
    ) -> Result<OddsSetup, OddsImpossibility> {
        let grid = TimeGrid {
            tick: Millis(grid.0),
            delay: Millis(grid.1),
        };
        OddsSetup::new(Config::default(), 1, grid, burst.map(Millis), Millis(hold))
    }

    #[test]
    fn the_coarsest_grid_divides_the_period_and_the_delay() {
        let tick = |delay| TimeGrid::coarsest(&Config::default(), Millis(delay)).tick.0;
        assert_eq!([50, 100, 75, 30, 7].map(tick), [50, 50, 25, 10, 1]);
    }

    #[test]
    fn what_does_not_fit_is_refused_by_its_cause() {
        assert!(setup((50, 50), None, 21_600).is_ok());
        let refused = [
            ((0, 50), None, 100, "a grid of 0 ms"),
            ((30, 60), None, 100, "a grid of 30 ms"),
            ((100, 100), None, 100, "a grid of 100 ms"),
            ((50, 0), None, 100, "a delay of 0 ms"),
            ((50, 50), Some(49), 100, "bursts of 49 ms"),
            ((50, 50), None, 49, "a maneuver of 49 ms"),
            ((50, 50), None, 60_001, "a maneuver of 60001 ms"),
        ];
        for (grid, burst, hold, cause) in refused {
            let refused = setup(grid, burst, hold).unwrap_err().to_string();
            assert!(refused.starts_with(cause), "{cause}: {refused}");
        }
    }

    #[test]
    fn bursts_cannot_be_closer_than_a_tick() {
        let setup = setup((50, 50), Some(100), 100).unwrap();
        // Two ticks in a burst and one outside of it is the most.
        assert_eq!(setup.check_loss(0.66), Ok(()));
        for (loss, cause) in [
            (0.67, "bursts of 100 ms on average"),
            (1.0, "a loss rate of 1:"),
            (f64::NAN, "a loss rate of NaN"),
        ] {
            let refused = setup.check_loss(loss).unwrap_err().to_string();
            assert!(refused.starts_with(cause), "{cause}: {refused}");
        }
    }
}
