//! What `crossguard simulate` can be told.

use std::fs::File;
use std::io::Write;
use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::builder::TypedValueParser;
use crossguard_evaluation::behaviour::Behaviour;
use crossguard_evaluation::fcd;
use crossguard_evaluation::grid::{Grid, Preset, Site};
use crossguard_evaluation::matrix::Axes;
use crossguard_evaluation::net::{Net, Streets};
use crossguard_evaluation::paper::PAPER;
use crossguard_evaluation::schedule::Schedule;
use crossguard_evaluation::shipped;
use crossguard_evaluation::simulation::CHECK_MS;
use crossguard_evaluation::statements::Setting;
use crossguard_evaluation::stationing::Stationing;
use crossguard_evaluation::sumo::{Plan, Sumo};
use crossguard_evaluation::trace::{Run, Traces};
use crossguard_evaluation::vru::{Suppression, Understands, VamRule};
use serde::{Serialize, Serializer};

use super::Failure;
use crate::cli::choices::one_of;
use crate::cli::destinations;
use crate::cli::ranges::{any, number, threads, whole};

/// The streets, and who moves on them.
#[derive(clap::Args)]
pub(super) struct Mobility {
    /// Assumptions on the geometry, which the paper does not state.
    #[arg(long, value_parser = preset(), default_value = "kerb")]
    pub(super) preset: Preset,
    /// Make fresh mobility with SUMO, whose programs are in this folder.
    #[arg(long, value_name = "FOLDER")]
    pub(super) sumo: Option<PathBuf>,
    /// Intersections along a side of the grid, for --sumo.
    #[arg(long, value_name = "N", requires = "sumo", value_parser = whole::<u32>(2..=26))]
    grid_size: Option<u32>,
    /// Vehicles, for --sumo.
    #[arg(long, value_name = "N", default_value_t = 20, requires = "sumo", value_parser = whole::<usize>(0..=10_000))]
    vehicles: usize,
    /// Length of a run in seconds, for --sumo.
    #[arg(long, value_name = "SECONDS", default_value_t = 200, requires = "sumo", value_parser = whole::<u32>(10..=3_600))]
    duration: u32,
}

impl Output {
    /// Whether what is wanted can be written.
    pub(super) fn check(&self) -> Result<(), Failure> {
        destinations::files([&self.csv])
    }
}

impl Mobility {
    pub(super) const fn preset_name(&self) -> &'static str {
        self.preset.name()
    }

    pub(super) fn grid(&self) -> Grid {
        let grid = self.preset.grid();
        Grid {
            nodes_per_side: self.grid_size.unwrap_or(grid.nodes_per_side),
            ..grid
        }
    }

    pub(super) fn plan(&self, pedestrians: usize) -> Plan {
        Plan {
            vehicles: self.vehicles,
            pedestrians,
            duration_s: self.duration,
            ..Plan::default()
        }
    }
}

/// The cells of the evaluation.
#[derive(clap::Args)]
pub(super) struct Matrix {
    #[command(flatten)]
    mobility: Mobility,
    /// Use these trace files instead of the shipped ones.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["sumo", "pedestrians"], num_args = 1..)]
    traces: Vec<PathBuf>,
    /// Streets of your own: a net of SUMO (NET.xml, plain or .gz). Robots stand at its intersections.
    #[arg(long, value_name = "NET", requires = "fcd", conflicts_with_all = ["preset", "sumo", "traces", "pedestrians", "site", "per_intersection", "patrol"])]
    net: Option<PathBuf>,
    /// What moves on them: floating car data of SUMO (--fcd-output, plain or .gz), a run for each file.
    #[arg(long, value_name = "FCD", requires = "net", num_args = 1..)]
    fcd: Vec<PathBuf>,
    /// Where robots are and when, as lines of robot,time_s,x_m,y_m; one with several lines moves.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["site", "per_intersection", "patrol"])]
    robots_at: Option<PathBuf>,
    /// Numbers of robots: the first one at the middle intersection, the others around it. 0,1,9 by default, or
    /// none and all of --robots-at.
    #[arg(long, value_delimiter = ',', value_name = "N,…", value_parser = whole::<usize>(0..=10_000))]
    robots: Option<Vec<usize>>,
    /// Numbers of people on foot.
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "20,50,100",
        value_name = "N,…",
        value_parser = whole::<usize>(1..=100_000)
    )]
    pedestrians: Vec<usize>,
    /// Perception radii of robots, in metres.
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "10,15",
        value_name = "M,…",
        value_parser = number(0.0..=100.0)
    )]
    pub(super) radius: Vec<f64>,
    /// Where at an intersection robots stand; the preset says it otherwise.
    #[arg(long, value_parser = site())]
    site: Option<Site>,
    /// Robots at an intersection before the next one gets any, each at another corner; their zones may
    /// overlap.
    #[arg(long, default_value_t = 1, value_name = "1..4", value_parser = whole::<usize>(1..=4))]
    per_intersection: usize,
    /// Robots walk around their intersection, over its corners, so fast; they stand by default.
    #[arg(long, value_name = "M/S", value_parser = number(0.1..=5.0))]
    patrol: Option<f64>,
    /// Seeds to take the mean over, at most; with --sumo, this many fresh runs.
    #[arg(long, default_value_t = 10, value_name = "N", value_parser = whole::<usize>(1..=100_000))]
    pub(super) seeds: usize,
    /// The first seed of fresh runs, for --sumo.
    #[arg(long, default_value_t = 1_001, value_name = "SEED", requires = "sumo", value_parser = any)]
    first_seed: u64,
    /// Threads; as many as there are processors by default.
    #[arg(long, value_name = "N", value_parser = threads)]
    threads: Option<NonZeroUsize>,
}

impl std::ops::Deref for Matrix {
    type Target = Mobility;

    fn deref(&self) -> &Mobility {
        &self.mobility
    }
}

impl Matrix {
    pub(super) fn site(&self) -> Site {
        self.site.unwrap_or_else(|| self.preset.site())
    }

    /// The preset by which the streets are made, if they are.
    pub(super) fn preset_of(&self, traces: &[Traces]) -> Option<&'static str> {
        let is_grid = traces.iter().all(|it| it.streets.grid().is_some());
        is_grid.then(|| self.preset_name())
    }

    fn stationing(&self) -> Result<Stationing, Failure> {
        let robots_at = self.robots_at.as_ref().map(|path| {
            let robots = File::open(path).map_err(Failure::at(path))?;
            Schedule::read(robots).map_err(Failure::at(path))
        });
        Ok(Stationing {
            robots_per_intersection: self.per_intersection,
            patrol_mps: self.patrol,
            robots_at: robots_at.transpose()?,
            ..Stationing::at(self.site())
        })
    }

    pub(super) fn axes(&self) -> Result<Axes, Failure> {
        let processors = || std::thread::available_parallelism().ok();
        let stationing = self.stationing()?;
        let all = stationing.robots_at.as_ref().map(|it| vec![0, it.len()]);
        let robots = self.robots.clone().or(all);
        Ok(Axes {
            robots: robots.unwrap_or_else(|| PAPER.robots.to_vec()),
            radii_m: self.radius.clone(),
            stationing,
            seeds: self.seeds,
            threads: self
                .threads
                .or_else(processors)
                .map_or(1, NonZeroUsize::get),
        })
    }

    /// The traces: files, fresh ones, or the shipped ones.
    pub(super) fn traces(&self, axes: &Axes, is_json: bool) -> Result<Vec<Traces>, Failure> {
        let people = self.pedestrians.iter();
        let traces: Result<Vec<_>, Failure> = if let Some(net) = &self.net {
            Ok(vec![recorded(net, &self.fcd)?])
        } else if !self.traces.is_empty() {
            self.traces.iter().map(read).collect()
        } else if let Some(folder) = &self.sumo {
            let sumo = Sumo::in_folder(folder);
            let seeds: Vec<u64> = (self.first_seed..).take(self.seeds).collect();
            let fresh = |&it| self.record(&sumo, &self.plan(it), &seeds, is_json);
            people.map(fresh).collect()
        } else {
            let shipped = |&pedestrians: &usize| match shipped::traces(self.preset, pedestrians) {
                Some(traces) => traces.map_err(Failure::input),
                None => Err(Failure::Input(format!(
                    "traces come along for {:?} pedestrians, not for {pedestrians}: make some with --sumo",
                    shipped::PEDESTRIANS
                ))),
            };
            people.map(shipped).collect()
        };
        let traces = traces?;
        let most = axes.robots.iter().max().copied().unwrap_or(0);
        for traces in &traces {
            let checked = axes.stationing.check(&traces.streets, most);
            checked.map_err(Failure::input)?;
        }
        Ok(traces)
    }

    /// Whether a run with these parameters is the one that the evaluation page documents.
    pub(super) fn is_documented(&self, axes: &Axes, parameters: &Parameters) -> bool {
        let is_default = |behaviour: &Behaviour| *behaviour == Behaviour::default();
        self.traces.is_empty()
            && self.net.is_none()
            && self.sumo.is_none()
            && self.preset == Preset::Kerb
            && axes.stationing == Stationing::at(Preset::Kerb.site())
            && axes.robots == PAPER.robots
            && self.pedestrians == PAPER.pedestrians
            && self.radius == PAPER.radii_m
            && parameters.seeds == 10
            && parameters.behaviour.as_ref().is_none_or(is_default)
    }

    /// What the results depend on.
    pub(super) fn parameters(
        &self,
        axes: &Axes,
        traces: &[Traces],
        behaviour: Option<Behaviour>,
    ) -> Parameters {
        let first = traces.first();
        let streets = first.map_or_else(
            || Streets::Grid(self.grid()),
            |traces| traces.streets.clone(),
        );
        let corner_m = streets.grid().map(Grid::corner_m);
        let runs = || traces.iter().flat_map(|it| it.runs.iter().take(self.seeds));
        let runs_of = |of: fn(&Run) -> usize| {
            let mut numbers: Vec<usize> = runs().map(of).collect();
            numbers.sort_unstable();
            numbers.dedup();
            numbers
        };
        Parameters {
            stationing: axes.stationing.clone(),
            robot_offset_m: corner_m
                .filter(|_| axes.stationing.robots_at.is_none())
                .map(|corner_m| match self.site() {
                    Site::Center => 0.0,
                    _ => corner_m,
                }),
            streets,
            is_proven: traces.iter().all(|it| it.is_proven),
            vehicles: runs_of(|it| it.vehicles.len()),
            seeds: traces
                .iter()
                .map(|it| it.runs.len().min(self.seeds))
                .min()
                .unwrap_or(0),
            duration_s: runs_of(|it| usize::try_from(it.duration_ms() / 1_000).unwrap_or(0)),
            sample_ms: first.map_or(0, |traces| traces.sample_ms),
            true_rates: behaviour.as_ref().map(Rates::of),
            behaviour,
        }
    }
}

fn read(path: &PathBuf) -> Result<Traces, Failure> {
    let file = File::open(path).map_err(crossguard_evaluation::trace::TraceError::from);
    let traces = file.and_then(Traces::read);
    traces.map_err(Failure::at(path))
}

/// A net, and what moved on it: a run for each file. Says on standard error what is in them.
fn recorded(net: &PathBuf, fcd: &[PathBuf]) -> Result<Traces, Failure> {
    let open = |path: &PathBuf| File::open(path).map_err(Failure::at(path));
    let streets = Net::read(open(net)?).map_err(Failure::at(net))?;
    let (mut runs, mut sample_ms) = (Vec::new(), None);
    for (seed, path) in (1..).zip(fcd) {
        let recording = fcd::read(open(path)?, seed).map_err(Failure::at(path))?;
        streets.check(&recording.run).map_err(Failure::at(path))?;
        let first_ms = *sample_ms.get_or_insert(recording.sample_ms);
        if recording.sample_ms != first_ms {
            let step_ms = recording.sample_ms;
            let why = format!(
                "has steps of {step_ms} ms, and the first file of {first_ms} ms: record both alike"
            );
            return Err(Failure::at(path)(why));
        }
        // Standard error may be gone; the parameters have most of it as well.
        let _ = writeln!(
            std::io::stderr(),
            "crossguard: {}: {recording}, seed {seed}",
            path.display()
        );
        runs.push(recording.run);
    }
    Ok(Traces {
        streets: Streets::Net(streets),
        is_proven: false,
        sample_ms: sample_ms.unwrap_or(0),
        runs,
    })
}

/// What the results depend on besides robots, people and radius.
#[derive(Serialize)]
pub(super) struct Parameters {
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
    true_rates: Option<Rates>,
    #[serde(skip_serializing_if = "Option::is_none")]
    behaviour: Option<Behaviour>,
}

/// What a station really sends per second; `None` by rules.
#[expect(clippy::struct_field_names, reason = "units are last in names")]
#[derive(Serialize)]
struct Rates {
    vam_hz: Option<f64>,
    ram_hz: Option<f64>,
    cam_hz: Option<f64>,
}

impl Rates {
    fn of(behaviour: &Behaviour) -> Self {
        let vam_ms = match behaviour.vam {
            VamRule::Etsi => None,
            VamRule::Periodic(interval_ms) => Some(interval_ms),
        };
        #[expect(clippy::cast_precision_loss, reason = "100..5000")]
        let hz = |interval_ms: Option<u64>| interval_ms.map(|it| 1_000.0 / it as f64);
        Self {
            vam_hz: hz(vam_ms),
            ram_hz: hz(behaviour.ram_interval_ms),
            cam_hz: hz(behaviour.cam_interval_ms),
        }
    }
}

/// One number where it is the same in all runs, else all that there are.
fn one_or_all<S: Serializer>(numbers: &[usize], to: S) -> Result<S::Ok, S::Error> {
    match numbers {
        [one] => one.serialize(to),
        all => all.serialize(to),
    }
}

impl Parameters {
    /// What statements of the paper are compared with.
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

/// How robots are placed.
#[derive(Clone, Copy, clap::ValueEnum)]
pub(super) enum Placement {
    /// The best intersection first, then the best one besides it, and so on.
    Greedy,
}

/// Where results go.
#[derive(clap::Args)]
pub(super) struct Output {
    /// Print the results as JSON, and nothing else.
    #[arg(long)]
    pub(super) json: bool,
    /// Write the results to this file as comma-separated values.
    #[arg(long, value_name = "FILE")]
    pub(super) csv: Option<PathBuf>,
}

/// Which announcements of a robot people's devices understand.
#[derive(Clone, Copy, clap::ValueEnum)]
enum Devices {
    /// RAM; they fall silent when one covers them.
    Ram,
    /// Cluster VAM, as every ETSI device; robots send them besides RAM.
    ClusterVam,
}

/// When a device that understands RAM falls silent.
#[derive(Clone, Copy, clap::ValueEnum)]
enum SilenceRule {
    /// Only if it was perceived itself: it is where a cluster is, and moves as that does.
    Strict,
    /// Wherever the bounding shape of a cluster covers it, perceived or not.
    Loose,
}

/// What goes over the air.
#[derive(clap::Args)]
pub(super) struct Air {
    /// When devices send VAM: 'etsi', or a number per second (0.2 to 10). Stations check every 100 ms, so
    /// the true rate is 10 by a whole number; it is printed.
    #[arg(
        long,
        default_value = "10",
        value_name = "etsi|HZ",
        help_heading = "Air"
    )]
    vam: String,
    /// When robots send RAM: 'rules', which is once a second for a robot that stands, or a number per
    /// second (1 to 10).
    #[arg(
        long,
        default_value = "rules",
        value_name = "rules|HZ",
        help_heading = "Air"
    )]
    ram: String,
    /// When vehicles send CAM: 'rules', or a number per second (1 to 10).
    #[arg(
        long,
        default_value = "rules",
        value_name = "rules|HZ",
        help_heading = "Air"
    )]
    cam: String,
    /// Points in the path history of CAM, which goes along every half second.
    #[arg(long, default_value_t = 5, value_name = "0..40", help_heading = "Air", value_parser = whole::<usize>(0..=40))]
    cam_path_points: usize,
    /// Which announcements devices understand.
    #[arg(long, value_enum, default_value = "ram", help_heading = "Air")]
    devices: Devices,
    /// When devices fall silent.
    #[arg(long, value_enum, default_value = "strict", help_heading = "Air")]
    suppression: SilenceRule,
    /// Share of people that no robot perceives, as if they were hidden all the time.
    #[arg(long, default_value_t = 0.0, value_name = "0..1", help_heading = "Air", value_parser = number(0.0..=1.0))]
    unseen: f64,
    /// Write to this file when each device was silent, as comma-separated values.
    #[arg(long, value_name = "FILE", help_heading = "Air")]
    pub(super) silences: Option<PathBuf>,
    /// Share of people with a device.
    #[arg(long, default_value_t = 1.0, value_name = "0..1", help_heading = "Air", value_parser = number(0.0..=1.0))]
    v2x_share: f64,
    /// Vehicles are gone after this many seconds, as when trips end; they stay by default.
    #[arg(long, value_name = "SECONDS", help_heading = "Air", value_parser = number(0.0..=1e6))]
    vehicles_leave: Option<f64>,
    /// No contention and no collisions.
    #[arg(long, help_heading = "Air")]
    ideal: bool,
    /// Path loss exponent.
    #[arg(long, default_value_t = 2.2, value_name = "N", help_heading = "Air", value_parser = number(1.0..=6.0))]
    path_loss_exponent: f64,
    /// Packets are signed.
    #[arg(long, help_heading = "Air")]
    signed: bool,
    /// Reactive congestion control (TS 102 687) holds stations back.
    #[arg(long, help_heading = "Air")]
    dcc: bool,
}

impl Air {
    /// The behaviour of all stations.
    pub(super) fn behaviour(&self) -> Result<Behaviour, String> {
        let mut behaviour = Behaviour {
            vam: match interval_ms("--vam", &self.vam, "etsi", 0.2)? {
                None => VamRule::Etsi,
                Some(interval_ms) => VamRule::Periodic(interval_ms),
            },
            understands: match self.devices {
                Devices::Ram => Understands::Ram,
                Devices::ClusterVam => Understands::ClusterVam,
            },
            v2x_share: self.v2x_share,
            unseen_share: self.unseen,
            ram_interval_ms: interval_ms("--ram", &self.ram, "rules", 1.0)?,
            cam_interval_ms: interval_ms("--cam", &self.cam, "rules", 1.0)?,
            cam_path_points: self.cam_path_points,
            vehicles_leave_s: self.vehicles_leave,
            signed: self.signed,
            dcc: self.dcc,
            ..Behaviour::default()
        };
        behaviour.radio.exponent = self.path_loss_exponent;
        behaviour.radio.ideal = self.ideal;
        Ok(behaviour.with_suppression(match self.suppression {
            SilenceRule::Strict => Suppression::Strict,
            SilenceRule::Loose => Suppression::Loose,
        }))
    }
}

/// The true interval of a rate; `None` when it is by rules. Stations check every 100 ms whether they send, so it
/// is a multiple of that.
fn interval_ms(option: &str, text: &str, rules: &str, min_hz: f64) -> Result<Option<u64>, String> {
    if text == rules {
        return Ok(None);
    }
    match text.parse::<f64>() {
        Ok(hz) if (min_hz..=10.0).contains(&hz) => {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "100..5000"
            )]
            let wanted_ms = (1_000.0 / hz).round() as u64;
            let interval_ms = wanted_ms.div_ceil(CHECK_MS) * CHECK_MS;
            if interval_ms != wanted_ms {
                // Standard error may be gone; the parameters say it as well.
                let _ = writeln!(
                    std::io::stderr(),
                    "crossguard: {option} {text} is not possible: stations check every {CHECK_MS} ms whether \
                     they send. Taken is {}.",
                    per_second(interval_ms)
                );
            }
            Ok(Some(interval_ms))
        }
        _ => Err(format!(
            "{option} is '{rules}' or {min_hz} to 10 per second, not {text:?}"
        )),
    }
}

/// A rate as people write it.
#[expect(clippy::cast_precision_loss, reason = "100..5000")]
fn per_second(interval_ms: u64) -> String {
    let hz = 1_000.0 / interval_ms as f64;
    let text = format!("{hz:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    format!("{text} per second, one every {interval_ms} ms")
}

/// Assumptions on the geometry of the street grid.
fn preset() -> impl TypedValueParser<Value = Preset> {
    one_of(&[
        (
            "kerb",
            Preset::Kerb,
            "Two lanes per direction, sidewalks of 3 m, robots on the sidewalk at a corner",
        ),
        (
            "plain",
            Preset::Plain,
            "One lane per direction, sidewalks of 2 m, robots in the middle of the intersection",
        ),
    ])
}

/// Where at an intersection a robot stands.
fn site() -> impl TypedValueParser<Value = Site> {
    one_of(&[
        ("center", Site::Center, "In its middle"),
        (
            "north-east",
            Site::NorthEast,
            "On the sidewalk of its north-eastern corner",
        ),
        (
            "north-west",
            Site::NorthWest,
            "On the sidewalk of its north-western corner",
        ),
        (
            "south-east",
            Site::SouthEast,
            "On the sidewalk of its south-eastern corner",
        ),
        (
            "south-west",
            Site::SouthWest,
            "On the sidewalk of its south-western corner",
        ),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rate_is_the_one_at_which_stations_really_send() {
        let interval = |hz| interval_ms("--vam", hz, "etsi", 0.2).unwrap();
        let intervals = ["10", "9.9", "7", "5", "4", "3", "2", "0.2", "etsi"].map(interval);
        let expected = [100, 200, 200, 200, 300, 400, 500, 5_000].map(Some);
        assert_eq!(intervals[..8], expected);
        assert_eq!(intervals[8], None);
        assert!(interval_ms("--vam", "11", "etsi", 0.2).is_err());
    }
}
