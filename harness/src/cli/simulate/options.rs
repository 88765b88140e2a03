//! Options of `crossguard simulate` on the command line, and assumptions of its results.

use std::ops::Not;
use std::path::PathBuf;

use crossguard_evaluation::behaviour::Behaviour;
use crossguard_evaluation::grid::{Grid, Preset, Site};
use crossguard_evaluation::matrix::Axes;
use crossguard_evaluation::net::Streets;
use crossguard_evaluation::simulation::CHECK_MS;
use crossguard_evaluation::statements::Setting;
use crossguard_evaluation::stationing::Stationing;
use crossguard_evaluation::trace::{Run, Traces};
use crossguard_evaluation::vru::VamRule;
use serde::{Serialize, Serializer};
use toml::{Table, Value};

use super::Failure;
use super::parameters::Parameters;
use crate::cli::destinations;
use crate::cli::ranges::number;

/// How people move, and the parameters that have no flag of their own.
#[derive(clap::Args, Serialize)]
pub(super) struct Mobility {
    /// Assumptions on the geometry, which the paper does not state [default: kerb]
    ///
    /// kerb has two lanes per direction, sidewalks of 3 m, and robots on the sidewalk at a corner; plain has one lane per
    /// direction, sidewalks of 2 m, and robots in the middle of the intersection.
    #[arg(long, value_parser = ["kerb", "plain"])]
    preset: Option<String>,
    /// Make fresh mobility with SUMO, whose programs are in this folder
    #[arg(long, value_name = "FOLDER")]
    sumo: Option<PathBuf>,
    /// Numbers of people on foot [default: 20,50,100]
    #[arg(long, value_delimiter = ',', value_name = "N,…")]
    pedestrians: Option<Vec<usize>>,
    /// Seeds to take the mean over, at most [default: all; fresh runs: 10]
    #[arg(long, value_name = "N")]
    seeds: Option<usize>,
    /// Take parameters from this TOML file; --set and flags win
    #[arg(long, value_name = "FILE")]
    #[serde(skip)]
    parameters: Option<PathBuf>,
    /// One parameter as in a file, like preset=plain; may be repeated
    #[arg(long, value_name = "KEY=VALUE")]
    #[serde(skip)]
    set: Vec<String>,
}

impl Mobility {
    pub(super) fn parameters(&self) -> Result<Parameters, Failure> {
        self.with(table(self)?)
    }

    fn with(&self, flags: Table) -> Result<Parameters, Failure> {
        Parameters::of(self.parameters.as_deref(), &self.set, flags)
    }
}

/// The flags that are given.
fn table(flags: &impl Serialize) -> Result<Table, Failure> {
    Table::try_from(flags).map_err(Failure::input)
}

/// The cells of the evaluation.
#[derive(clap::Args, Serialize)]
pub(super) struct Matrix {
    #[command(flatten)]
    #[serde(flatten)]
    mobility: Mobility,
    /// Use these trace files instead of the shipped ones
    #[arg(long, value_name = "FILE", num_args = 1..)]
    traces: Option<Vec<PathBuf>>,
    /// Streets of your own, a net of SUMO (plain or .gz)
    #[arg(long, value_name = "NET")]
    net: Option<PathBuf>,
    /// What moves on them, SUMO's --fcd-output (plain or .gz), a run for each file
    #[arg(long, value_name = "FCD", num_args = 1..)]
    fcd: Option<Vec<PathBuf>>,
    /// Where robots are and when, a table with a line for each place
    #[arg(long, value_name = "FILE")]
    robots_at: Option<PathBuf>,
    /// Numbers of robots, from the middle outwards [default: 0,1,9, or 0 and all of --robots-at]
    #[arg(long, value_delimiter = ',', value_name = "N,…")]
    robots: Option<Vec<usize>>,
    /// Perception radii of robots in metres [default: 10,15]
    #[arg(long, value_delimiter = ',', value_name = "M,…")]
    #[serde(rename = "radii_m")]
    radius: Option<Vec<f64>>,
    /// Where at an intersection robots stand [default: by the preset]
    ///
    /// In its middle, or on the sidewalk of this corner.
    #[arg(long, value_parser = ["center", "north-east", "north-west", "south-east", "south-west"])]
    #[serde(rename = "robot_site")]
    site: Option<String>,
}

impl Matrix {
    /// The parameters, with those of the air where there are any.
    pub(super) fn parameters(&self, air: Option<&Air>) -> Result<Parameters, Failure> {
        let mut flags = table(self)?;
        if let Some(air) = air {
            flags.insert("behaviour".to_owned(), Value::Table(table(air)?));
        }
        self.mobility.with(flags)
    }
}

impl Output {
    /// Whether what is wanted can be written.
    pub(super) fn check(&self) -> Result<(), Failure> {
        destinations::files([&self.csv])
    }
}

/// Assumptions of the results besides robots, people and radius.
#[derive(Serialize)]
pub(super) struct Assumptions {
    #[serde(flatten)]
    streets: Streets,
    #[serde(skip)]
    is_proven: bool,
    #[serde(flatten)]
    stationing: Stationing,
    #[serde(skip_serializing_if = "Option::is_none")]
    robot_offset_m: Option<f64>,
    #[serde(serialize_with = "one_or_all")]
    vehicles: Vec<usize>,
    seeds: usize,
    #[serde(serialize_with = "one_or_all")]
    duration_s: Vec<usize>,
    sample_ms: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    behaviour: Option<Behaviour>,
}

/// One number where it is the same in all runs, else all that there are.
fn one_or_all<S: Serializer>(numbers: &[usize], to: S) -> Result<S::Ok, S::Error> {
    match numbers {
        [one] => one.serialize(to),
        all => all.serialize(to),
    }
}

impl Assumptions {
    /// Assumptions of the results on these traces.
    pub(super) fn of(axes: &Axes, traces: &[Traces], behaviour: Option<Behaviour>) -> Self {
        let first = traces.first();
        let streets = first.map_or_else(
            || Streets::Grid(Preset::Kerb.grid()),
            |traces| traces.streets.clone(),
        );
        let corner_m = streets.grid().map(Grid::corner_m);
        let runs = || traces.iter().flat_map(|it| it.runs.iter().take(axes.seeds));
        let runs_of = |of: fn(&Run) -> usize| {
            let mut numbers: Vec<usize> = runs().map(of).collect();
            numbers.sort_unstable();
            numbers.dedup();
            numbers
        };
        let mut stationing = axes.stationing.clone();
        if streets.grid().is_none() {
            stationing.robot_site = Site::Center;
        }
        let by_grid = corner_m.filter(|_| stationing.robots_at.is_none());
        Self {
            robot_offset_m: by_grid.map(|corner_m| match stationing.robot_site {
                Site::Center => 0.0,
                _ => corner_m,
            }),
            stationing,
            streets,
            is_proven: traces.iter().all(|it| it.is_proven),
            vehicles: runs_of(|it| it.vehicles.len()),
            seeds: traces
                .iter()
                .map(|it| it.runs.len().min(axes.seeds))
                .min()
                .unwrap_or(0),
            duration_s: runs_of(|it| usize::try_from(it.duration_ms() / 1_000).unwrap_or(0)),
            sample_ms: first.map_or(0, |traces| traces.sample_ms),
            behaviour,
        }
    }

    /// How many runs each cell is of.
    pub(super) const fn seeds(&self) -> usize {
        self.seeds
    }

    /// Setting with which statements of the paper are compared.
    pub(super) fn setting<'a>(&'a self, axes: &'a Axes) -> Setting<'a> {
        Setting {
            streets: &self.streets,
            is_proven: self.is_proven,
            vehicles: &self.vehicles,
            axes,
            behaviour: self.behaviour.as_ref(),
        }
    }
}

/// Where results go.
#[derive(clap::Args)]
#[command(next_help_heading = "Results")]
pub(super) struct Output {
    /// Print the results as JSON, and nothing else.
    #[arg(long)]
    pub(super) json: bool,
    /// Write the results of each seed to this file as comma-separated values.
    #[arg(long, value_name = "FILE")]
    pub(super) csv: Option<PathBuf>,
}

/// Messages on the air.
#[derive(clap::Args, Serialize)]
#[command(next_help_heading = "Air")]
pub(super) struct Air {
    /// When devices send VAM: 'etsi', or 0.2 to 10 a second [default: 10]
    ///
    /// Stations check every 100 ms whether they send: 7 a second are one every 200 ms.
    #[arg(long, value_name = "etsi|HZ", value_parser = vam)]
    vam: Option<VamRule>,
    /// When robots send RAM: 'rules', or 1 to 10 a second [default: rules]
    #[arg(long, value_name = "rules|HZ", value_parser = ram)]
    #[serde(rename = "ram_interval_ms")]
    ram: Option<u64>,
    /// Which announcements devices understand [default: ram]
    ///
    /// RAM: they fall silent when one covers them. Cluster VAM, as every ETSI device: robots send them besides RAM.
    #[arg(long, value_parser = ["ram", "cluster-vam"])]
    #[serde(rename = "understands")]
    devices: Option<String>,
    /// When devices fall silent [default: strict]
    ///
    /// strict: only if it was perceived itself, so that it is where a cluster is and moves as that does. loose: wherever the
    /// bounding shape of a cluster covers it, perceived or not.
    #[arg(long, value_parser = ["strict", "loose"])]
    suppression: Option<String>,
    /// Packets are signed
    #[arg(long)]
    #[serde(skip_serializing_if = "Not::not")]
    signed: bool,
    /// Reactive congestion control (TS 102 687) holds stations back
    #[arg(long)]
    #[serde(skip_serializing_if = "Not::not")]
    dcc: bool,
    /// Write to this file when each device was silent (CSV)
    #[arg(long, value_name = "FILE")]
    #[serde(skip)]
    pub(super) silences: Option<PathBuf>,
}

fn vam(text: &str) -> Result<VamRule, String> {
    if text == "etsi" {
        return Ok(VamRule::Etsi);
    }
    interval_ms(text, 0.2).map(VamRule::Periodic)
}

/// 0 is by the rules.
fn ram(text: &str) -> Result<u64, String> {
    if text == "rules" {
        return Ok(0);
    }
    interval_ms(text, 1.0)
}

/// The true interval of a rate: a multiple of the time after which stations check whether they send.
fn interval_ms(text: &str, min_hz: f64) -> Result<u64, String> {
    let hz = number(min_hz..=10.0)(text)?;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "100..5000"
    )]
    let wanted_ms = (1_000.0 / hz).round() as u64;
    Ok(wanted_ms.div_ceil(CHECK_MS) * CHECK_MS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rate_is_the_one_at_which_stations_really_send() {
        let interval = |hz| interval_ms(hz, 0.2).unwrap();
        let intervals = ["10", "9.9", "7", "5", "4", "3", "2", "0.2"].map(interval);
        assert_eq!(intervals, [100, 200, 200, 200, 300, 400, 500, 5_000]);
        assert!(interval_ms("11", 0.2).is_err());
    }
}
