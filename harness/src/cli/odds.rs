//! `crossguard odds`.

mod output;

use std::path::PathBuf;

use crossguard_model_check::check::Stop;
use crossguard_model_check::odds::{
    Coupling, FOLLOWERS_MAX, FlowCut, OddsError, OddsModel, OddsProgress, OddsSetup, TeamOdds,
    TimeGrid,
};
use crossguard_protocol::{Config, Millis};
use serde::Serialize;

use super::interrupts::stop_when_told;
use super::ranges::{number, whole};
use super::{Failure, print, print_json, progress};

#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub(super) struct Arguments {
    /// How many followers the leader asks for: 1 for a pair, 2 for a trio.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = whole::<u8>(1..=FOLLOWERS_MAX.into()))]
    followers: u8,
    /// The shares of messages that get lost, like 0,0.1,0.3.
    #[arg(long, value_name = "RATES", value_delimiter = ',', default_value = "0,0.1,0.2,0.3,0.4,0.5,0.6",
        value_parser = number(0.0..=0.999))]
    loss: Vec<f64>,
    /// Losses come in bursts of this mean length, in milliseconds, on the link of each follower; without it, each
    /// message is lost independently.
    #[arg(long, value_name = "MEAN_LENGTH", value_parser = whole::<u32>(1..=3_600_000))]
    burst: Option<u32>,
    /// The time that each message takes, in milliseconds.
    #[arg(long, value_name = "MS", default_value_t = 50, value_parser = whole::<u32>(1..=60_000))]
    delay: u32,
    /// The grid of time, in milliseconds; by default the coarsest on which the RAM period and the delay are whole.
    #[arg(long, value_name = "MS", value_parser = whole::<u32>(1..=60_000))]
    tick: Option<u32>,
    /// How long the maneuver takes while the corridor is open, in milliseconds; by default the paper's 'Move'.
    #[arg(long, value_name = "MS", default_value_t = 21_600, value_parser = whole::<u32>(1..=3_600_000))]
    hold: u32,
    /// A robot's configuration, as for 'crossguard run'; without it, the default settings.
    #[arg(long, value_name = "FILE")]
    config: Option<PathBuf>,
    /// How far apart the bounds of a probability may be; by default 1e-9 for a pair, 1e-5 for a trio, 1e-3 for a
    /// trio with bursts and for three followers, 1e-2 for these with bursts.
    #[arg(long, value_name = "W", value_parser = number(1e-14..=0.1))]
    width: Option<f64>,
    /// Take the links of several followers together, in one chain, also after the team is gathered. That has very many
    /// states at high loss rates.
    #[arg(long)]
    joint: bool,
    /// Print the results as JSON, and nothing else.
    #[arg(long)]
    json: bool,
}

const AFTER_HELP: &str = "\
Prints how likely a crossing goes well when messages get lost, and how long its parts take: the full team, the \
command at every follower, its acknowledgement, the open corridor; that the corridor closes or a follower falls back \
before the maneuver is over. Numbers are solved from the transition function that robots run, on a grid of time, not \
sampled. Nobody crashes in it, clocks do not drift, and every message takes the same time.";

/// What is worked out, the settings that it follows from, and what came of it.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct OddsReport {
    followers: u8,
    delay_ms: u32,
    burst_ms: Option<u32>,
    hold_ms: u32,
    coupling: Coupling,
    ram_period_ms: u32,
    t_ack_ms: u32,
    n_ack: u8,
    t_safety_ms: u32,
    t_lease_ms: u32,
    tick_ms: u32,
    #[serde(flatten)]
    team: TeamOdds,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let config = super::config_or_default(arguments.config.as_deref())?;
    let setup = arguments.setup(&config)?;
    let stop = stop_when_told();
    let team = match arguments.solve(setup.clone(), &stop) {
        Ok(team) => team,
        Err(OddsError::Cut(FlowCut::Stopped)) => return Err(Failure::Incomplete),
        Err(error) => return Err(Failure::input(error)),
    };
    let settings = config.settings();
    let report = OddsReport {
        followers: arguments.followers,
        delay_ms: arguments.delay,
        burst_ms: arguments.burst,
        hold_ms: arguments.hold,
        coupling: setup.coupling(),
        ram_period_ms: settings.ram_period.0,
        t_ack_ms: settings.t_ack.0,
        n_ack: settings.n_ack,
        t_safety_ms: settings.t_safety.0,
        t_lease_ms: settings.t_lease.0,
        tick_ms: setup.grid().tick.0,
        team,
    };
    if arguments.json {
        print_json(&report)
    } else {
        output::print_table(&report)
    }
}

impl Arguments {
    /// Setup of the calculation with these settings.
    fn setup(&self, config: &Config) -> Result<OddsSetup, Failure> {
        let mut grid = TimeGrid::coarsest(config, Millis(self.delay));
        if let Some(tick) = self.tick {
            grid.tick = Millis(tick);
        }
        let burst = self.burst.map(Millis);
        let setup = OddsSetup::new(
            config.clone(),
            self.followers,
            grid,
            burst,
            Millis(self.hold),
        );
        let mut setup = setup.map_err(Failure::input)?;
        for &loss in &self.loss {
            setup.check_loss(loss).map_err(Failure::input)?;
        }
        if let Some(width) = self.width {
            setup = setup.with_width(width);
        }
        if self.joint {
            setup = setup.with_coupling(Coupling::Joint);
        }
        Ok(setup)
    }

    fn solve(&self, setup: OddsSetup, stop: &Stop) -> Result<TeamOdds, OddsError> {
        let bar = progress(self.json, "{bar:30} {pos}/{len} {msg}, {elapsed}");
        let mut watch = |it: OddsProgress| {
            bar.set_length(it.of as u64);
            bar.set_position(it.done as u64);
            bar.set_message(format!("{} at a loss of {}", it.stage.name(), it.loss));
        };
        let solved = OddsModel::new(setup).odds(&self.loss, stop, &mut watch);
        bar.finish_and_clear();
        solved
    }
}
