//! The parameters of a simulation: what a file says, then `--set`, then the flags.

use std::fs::File;
use std::io::Write;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use crossguard_evaluation::behaviour::Behaviour;
use crossguard_evaluation::fcd;
use crossguard_evaluation::grid::{Grid, Preset, Site};
use crossguard_evaluation::matrix::Axes;
use crossguard_evaluation::messages::DATA_RATES_MBPS;
use crossguard_evaluation::net::{Net, Streets};
use crossguard_evaluation::paper::PAPER;
use crossguard_evaluation::schedule::Schedule;
use crossguard_evaluation::shipped;
use crossguard_evaluation::simulation::CHECK_MS;
use crossguard_evaluation::stationing::Stationing;
use crossguard_evaluation::sumo::{Plan, Sumo};
use crossguard_evaluation::trace::{TraceError, Traces};
use crossguard_evaluation::vru::VamRule;
use crossguard_robot::files;
use serde::Deserialize;
use toml::{Table, Value};

use super::{Failure, progress};

/// Every parameter, by its name in a file.
#[derive(Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Parameters {
    preset: Option<Preset>,
    sumo: Option<PathBuf>,
    traces: Vec<PathBuf>,
    net: Option<PathBuf>,
    fcd: Vec<PathBuf>,
    robots_at: Option<PathBuf>,
    robots: Option<Vec<usize>>,
    pedestrians: Option<Vec<usize>>,
    radii_m: Option<Vec<f64>>,
    seeds: Option<usize>,
    first_seed: Option<u64>,
    threads: Option<NonZeroUsize>,
    robot_site: Option<Site>,
    robots_per_intersection: Option<usize>,
    patrol_mps: Option<f64>,
    dispatch_interval_s: Option<u64>,
    vehicles: Option<usize>,
    duration_s: Option<u32>,
    grid: GridTable,
    pub(super) behaviour: Behaviour,
}

#[derive(Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct GridTable {
    nodes_per_side: Option<u32>,
    segment_m: Option<f64>,
    lanes: Option<u32>,
    sidewalk_m: Option<f64>,
}

/// Names of which the first wants the second.
const NEEDS: [(&str, &str); 7] = [
    ("dispatch_interval_s", "patrol_mps"),
    ("net", "fcd"),
    ("fcd", "net"),
    ("vehicles", "sumo"),
    ("duration_s", "sumo"),
    ("first_seed", "sumo"),
    ("grid", "sumo"),
];

/// Names of which the first has none of the others beside it. Dispatched robots walk anywhere.
const ALONE: [(&str, &[&str]); 3] = [
    (
        "net",
        &[
            "preset",
            "sumo",
            "traces",
            "pedestrians",
            "robot_site",
            "robots_per_intersection",
            "patrol_mps",
        ],
    ),
    ("traces", &["sumo", "pedestrians"]),
    (
        "robots_at",
        &["robot_site", "robots_per_intersection", "patrol_mps"],
    ),
];

impl Parameters {
    /// Parameters of a file, then of these lines, then of the flags: a later one wins.
    pub(super) fn of(file: Option<&Path>, lines: &[String], flags: Table) -> Result<Self, Failure> {
        let mut all = Table::new();
        if let Some(path) = file {
            let text = files::text(path, files::TEXT_MAX).map_err(Failure::at(path))?;
            merge(&mut all, parse(&text).map_err(Failure::at(path))?);
        }
        for line in lines {
            // A name needs no quotes.
            let quoted = line
                .split_once('=')
                .map(|(key, value)| format!("{key}={value:?}"));
            let table =
                parse(line).or_else(|cause| quoted.and_then(|it| parse(&it).ok()).ok_or(cause));
            let wrong = |cause| Failure::Input(format!("--set {line}: {cause}"));
            merge(&mut all, table.map_err(wrong)?);
        }
        merge(&mut all, flags);
        for (name, other) in NEEDS {
            if all.contains_key(name) && !all.contains_key(other) {
                return Err(Failure::Input(format!("{name} needs {other} as well")));
            }
        }
        let is_dispatched = all.contains_key("dispatch_interval_s");
        for (name, others) in ALONE {
            let fits = |it: &str| is_dispatched && it == "patrol_mps";
            let is_other = |it: &&&str| all.contains_key(**it) && !fits(it);
            let other = others.iter().find(is_other);
            if let Some(other) = other.filter(|_| all.contains_key(name)) {
                let why = format!("{name} and {other} exclude each other: leave one out");
                return Err(Failure::Input(why));
            }
        }
        let mut parameters: Self = all.clone().try_into().map_err(Failure::input)?;
        check_ranges(&all)?;
        let behaviour = &mut parameters.behaviour;
        // 0 is by the rules.
        for interval_ms in [
            &mut behaviour.ram_interval_ms,
            &mut behaviour.cam_interval_ms,
        ] {
            *interval_ms = interval_ms.filter(|it| *it > 0);
        }
        let suppression = behaviour.suppression;
        *behaviour = behaviour.clone().with_suppression(suppression);
        parameters.check()?;
        Ok(parameters)
    }

    fn check(&self) -> Result<(), Failure> {
        let (behaviour, radio) = (&self.behaviour, &self.behaviour.radio);
        let vam_ms = match behaviour.vam {
            VamRule::Etsi => None,
            VamRule::Periodic(interval_ms) => Some(interval_ms),
        };
        for (name, interval_ms, most_ms) in [
            ("vam.periodic", vam_ms, 5_000),
            ("ram_interval_ms", behaviour.ram_interval_ms, 1_000),
            ("cam_interval_ms", behaviour.cam_interval_ms, 1_000),
            (
                "cluster_vam_interval_ms",
                Some(behaviour.cluster_vam_interval_ms),
                10_000,
            ),
        ] {
            let Some(interval_ms) = interval_ms else {
                continue;
            };
            let is = format!("behaviour.{name} is {interval_ms}");
            if !(100..=most_ms).contains(&interval_ms) {
                let why = format!("{is}: 100 to {most_ms} is wanted");
                return Err(Failure::Input(why));
            }
            if interval_ms % CHECK_MS != 0 {
                let why = format!("{is}: stations check every {CHECK_MS} ms, a multiple is wanted");
                return Err(Failure::Input(why));
            }
        }
        if !DATA_RATES_MBPS.contains(&radio.data_rate_mbps) {
            return Err(Failure::Input(format!(
                "behaviour.radio.data_rate_mbps is {}: one of {DATA_RATES_MBPS:?} is wanted",
                radio.data_rate_mbps
            )));
        }
        let clustering = behaviour.clustering.check();
        clustering.map_err(|why| Failure::Input(format!("behaviour.clustering: {why}")))
    }

    fn preset(&self) -> Preset {
        self.preset.unwrap_or(Preset::Kerb)
    }

    pub(super) fn preset_name(&self) -> &'static str {
        self.preset().name()
    }

    /// The preset by which the streets are made, if they are.
    pub(super) fn preset_of(&self, traces: &[Traces]) -> Option<&'static str> {
        let is_grid = traces.iter().all(|it| it.streets.grid().is_some());
        is_grid.then(|| self.preset_name())
    }

    fn site(&self) -> Site {
        self.robot_site.unwrap_or_else(|| self.preset().site())
    }

    pub(super) fn pedestrians(&self) -> &[usize] {
        self.pedestrians.as_deref().unwrap_or(&PAPER.pedestrians)
    }

    pub(super) fn grid(&self) -> Grid {
        let (grid, own) = (self.preset().grid(), &self.grid);
        Grid {
            nodes_per_side: own.nodes_per_side.unwrap_or(grid.nodes_per_side),
            segment_m: own.segment_m.unwrap_or(grid.segment_m),
            lanes: own.lanes.unwrap_or(grid.lanes),
            sidewalk_m: own.sidewalk_m.unwrap_or(grid.sidewalk_m),
            ..grid
        }
    }

    pub(super) fn plan(&self, pedestrians: usize) -> Plan {
        let plan = Plan::default();
        Plan {
            vehicles: self.vehicles.unwrap_or(plan.vehicles),
            pedestrians,
            duration_s: self.duration_s.unwrap_or(plan.duration_s),
            ..plan
        }
    }

    /// How many fresh runs are made.
    pub(super) fn fresh(&self) -> usize {
        self.seeds.unwrap_or(10)
    }

    pub(super) fn sumo(&self) -> Result<Sumo, Failure> {
        self.sumo.as_deref().map(Sumo::in_folder).ok_or_else(|| {
            Failure::Input(
                "--sumo FOLDER is needed: where SUMO's programs are (python3 -m venv v && v/bin/pip \
                 install eclipse-sumo, then v/bin)"
                    .to_owned(),
            )
        })
    }

    pub(super) fn axes(&self) -> Result<Axes, Failure> {
        let robots_at = self.robots_at.as_ref().map(|path| {
            let robots = File::open(path).map_err(Failure::at(path))?;
            Schedule::read(robots).map_err(Failure::at(path))
        });
        let stationing = Stationing {
            robots_per_intersection: self.robots_per_intersection.unwrap_or(1),
            patrol_mps: self.patrol_mps,
            dispatch_interval_s: self.dispatch_interval_s,
            robots_at: robots_at.transpose()?,
            ..Stationing::at(self.site())
        };
        let all = stationing.robots_at.as_ref().map(|it| vec![0, it.len()]);
        let robots = self.robots.clone().or(all);
        let processors = || std::thread::available_parallelism().ok();
        Ok(Axes {
            robots: robots.unwrap_or_else(|| PAPER.robots.to_vec()),
            radii_m: self
                .radii_m
                .clone()
                .unwrap_or_else(|| PAPER.radii_m.to_vec()),
            stationing,
            seeds: self.seeds.unwrap_or(usize::MAX),
            threads: self
                .threads
                .or_else(processors)
                .map_or(1, NonZeroUsize::get),
        })
    }

    /// The traces: files, fresh ones, or the shipped ones.
    pub(super) fn traces(&self, axes: &Axes, is_json: bool) -> Result<Vec<Traces>, Failure> {
        let people = self.pedestrians().iter();
        let traces: Result<Vec<_>, Failure> = if let Some(net) = &self.net {
            Ok(vec![recorded(net, &self.fcd)?])
        } else if !self.traces.is_empty() {
            self.traces.iter().map(read).collect()
        } else if self.sumo.is_some() {
            let sumo = self.sumo()?;
            let first = self.first_seed.unwrap_or(1_001);
            let seeds: Vec<u64> = (first..).take(self.fresh()).collect();
            let fresh = |&it| self.record(&sumo, &self.plan(it), &seeds, is_json);
            people.map(fresh).collect()
        } else {
            let shipped = |&pedestrians: &usize| match shipped::traces(self.preset(), pedestrians) {
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

    /// Records runs on a grid of this shape.
    pub(super) fn record(
        &self,
        sumo: &Sumo,
        plan: &Plan,
        seeds: &[u64],
        is_json: bool,
    ) -> Result<Traces, Failure> {
        let mut grid = self.grid();
        grid.check().map_err(Failure::input)?;
        grid.mobility = sumo.version().map_err(Failure::input)?;
        let bar = progress(is_json, "SUMO {bar:40} {pos}/{len} {eta}");
        bar.set_length(seeds.len() as u64);
        let mut runs = Vec::new();
        for &seed in seeds {
            runs.push(sumo.run(&grid, plan, seed).map_err(Failure::input)?);
            bar.inc(1);
        }
        bar.finish_and_clear();
        Ok(Traces {
            streets: Streets::Grid(grid),
            is_proven: true,
            sample_ms: plan.sample_ms,
            runs,
        })
    }

    /// Whether a run with these parameters over so many seeds is the one that the evaluation page documents.
    pub(super) fn is_documented(&self, axes: &Axes, seeds: usize) -> bool {
        self.traces.is_empty()
            && self.net.is_none()
            && self.sumo.is_none()
            && self.preset() == Preset::Kerb
            && axes.stationing == Stationing::at(Preset::Kerb.site())
            && axes.robots == PAPER.robots
            && self.pedestrians() == PAPER.pedestrians
            && axes.radii_m == PAPER.radii_m
            && seeds == 10
            && self.behaviour == Behaviour::default()
    }
}

/// A text of parameters, each of which is known.
fn parse(text: &str) -> Result<Table, String> {
    let line = |cause: toml::de::Error| {
        let at = cause.span().map_or(0, |span| span.start);
        let line = text.get(..at).unwrap_or_default().matches('\n').count() + 1;
        format!("line {line}: {}", cause.message())
    };
    toml::from_str::<Parameters>(text).map_err(line)?;
    text.parse().map_err(line)
}

fn merge(all: &mut Table, more: Table) {
    for (name, value) in more {
        match (all.get_mut(&name), value) {
            (Some(Value::Table(all)), Value::Table(more)) => merge(all, more),
            (_, value) => drop(all.insert(name, value)),
        }
    }
}

/// The least and the most of each number, by its name in a file.
const RANGES: [(&str, f64, f64); 21] = [
    ("robots", 0.0, 10_000.0),
    ("pedestrians", 1.0, 100_000.0),
    ("radii_m", 0.0, 100.0),
    ("seeds", 1.0, 100_000.0),
    ("vehicles", 0.0, 10_000.0),
    ("duration_s", 10.0, 3_600.0),
    ("dispatch_interval_s", 1.0, 3_600.0),
    ("behaviour.v2x_share", 0.0, 1.0),
    ("behaviour.unseen_share", 0.0, 1.0),
    ("behaviour.cam_path_points", 0.0, 40.0),
    ("behaviour.vehicles_leave_s", 0.0, 1e6),
    ("behaviour.radio.power_dbm", -30.0, 50.0),
    ("behaviour.radio.loss_at_1_m_db", 0.0, 120.0),
    ("behaviour.radio.exponent", 1.0, 6.0),
    ("behaviour.radio.sense_dbm", -110.0, -40.0),
    ("behaviour.radio.noise_dbm", -120.0, -40.0),
    ("behaviour.radio.sinr_min_db", -10.0, 40.0),
    ("behaviour.radio.aifsn", 2.0, 15.0),
    ("behaviour.radio.contention_window", 1.0, 1_023.0),
    ("behaviour.sessions.hold_s", 1.0, 250.0),
    ("behaviour.sessions.pause_s", 1.0, 250.0),
];

/// Refuses the first number that is out of its range.
fn check_ranges(all: &Table) -> Result<(), Failure> {
    for (name, least, most) in RANGES {
        let mut parts = name.split('.');
        let first = parts.next().and_then(|part| all.get(part));
        let numbers = match parts.fold(first, |value, part| value?.get(part)) {
            Some(Value::Array(several)) => several,
            Some(one) => std::slice::from_ref(one),
            None => &[],
        };
        #[expect(clippy::cast_precision_loss, reason = "ranges are far less than 2^53")]
        let number = |value: &Value| match value {
            Value::Integer(number) => Some(*number as f64),
            value => value.as_float(),
        };
        let is_out = |number: &f64| !(least..=most).contains(number);
        if let Some(number) = numbers.iter().filter_map(number).find(is_out) {
            let why = format!("{name} is {number}: {least} to {most} is wanted");
            return Err(Failure::Input(why));
        }
    }
    Ok(())
}

fn read(path: &PathBuf) -> Result<Traces, Failure> {
    let file = File::open(path).map_err(TraceError::from);
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
