//! Mobility by SUMO, run as a separate process: the grid by `netgenerate`, traffic by `sumo`.
//!
//! SUMO comes from `PyPI`: `python3 -m venv v && v/bin/pip install eclipse-sumo`; its programs are then
//! in `v/bin`. Routes are ours, and follow from the seed alone: every vehicle turns at random at each
//! intersection, and every person walks by the shortest way to one random street after the other, as
//! long as the run takes. Vehicles and people are there from the beginning to the end.

use std::fmt::Write as _;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::fcd;
use super::grid::Grid;
use super::trace::Run;
use super::xml::SumoFileError;

/// Traffic and length of a run.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Plan {
    /// How many vehicles.
    pub vehicles: usize,
    /// How many people on foot.
    pub pedestrians: usize,
    /// How long the run is, in seconds.
    pub duration_s: u32,
    /// How long traffic moves before the run begins, in seconds.
    pub warm_up_s: u32,
    /// Time between two samples, in ms.
    pub sample_ms: u64,
}

impl Default for Plan {
    fn default() -> Self {
        Self {
            vehicles: 20,
            pedestrians: 100,
            duration_s: 200,
            warm_up_s: 30,
            sample_ms: 500,
        }
    }
}

/// SUMO's programs.
#[derive(Clone, Debug)]
pub struct Sumo {
    folder: PathBuf,
}

/// Why SUMO did not move anybody.
#[derive(Debug, thiserror::Error)]
pub enum SumoError {
    /// A program cannot be started.
    #[error(
        "cannot run {program}: {error}; install SUMO with `python3 -m venv v && v/bin/pip install \
         eclipse-sumo`, and give the folder v/bin"
    )]
    NotThere {
        /// Which.
        program: String,
        /// Why.
        error: std::io::Error,
    },
    /// A program reports an error.
    #[error("{program} failed: {message}")]
    Failed {
        /// Which.
        program: &'static str,
        /// Its message.
        message: String,
    },
    /// A file of its input or output cannot be written or read.
    #[error(transparent)]
    File(#[from] std::io::Error),
    /// Its output cannot be used.
    #[error("SUMO's output {0}")]
    Output(#[from] SumoFileError),
    /// Not everybody was there all the time.
    #[error(
        "SUMO moved {} people and {} vehicles for {} ms of a run of {pedestrians} and {vehicles} for {duration_s} s: \
         fewer fit on these streets",
        .run.pedestrians.len(), .run.vehicles.len(), .run.duration_ms(), pedestrians = .plan.pedestrians,
        vehicles = .plan.vehicles, duration_s = .plan.duration_s
    )]
    NotAll {
        /// The run that SUMO made.
        run: Box<Run>,
        /// The run that was wanted.
        plan: Plan,
    },
}

impl Sumo {
    /// SUMO's programs in this folder.
    #[must_use]
    pub fn in_folder(folder: &Path) -> Self {
        Self {
            folder: folder.to_owned(),
        }
    }

    /// Its version, as it says.
    ///
    /// # Errors
    /// When it is not there.
    pub fn version(&self) -> Result<String, SumoError> {
        let text = self.call("sumo", &["--version".to_owned()])?;
        Ok(text.lines().next().unwrap_or_default().trim().to_owned())
    }

    /// A run on `grid`.
    ///
    /// # Errors
    /// Why there is none.
    pub fn run(&self, grid: &Grid, plan: &Plan, seed: u64) -> Result<Run, SumoError> {
        let folder = tempfile::tempdir()?;
        let file = |name: &str| folder.path().join(name);
        self.call("netgenerate", &network_arguments(grid, &file("net.xml")))?;
        fs::write(file("routes.xml"), routes(grid, plan, seed))?;
        let seconds = |s: u32| format!("{s}");
        let arguments = [
            ("--net-file", text(&file("net.xml"))),
            ("--route-files", text(&file("routes.xml"))),
            ("--seed", (seed % (1 << 31)).to_string()),
            ("--step-length", "0.1".to_owned()),
            // The last sample is the last step.
            ("--end", format!("{}.1", plan.warm_up_s + plan.duration_s)),
            ("--fcd-output", text(&file("fcd.xml"))),
            ("--fcd-output.attributes", "x,y".to_owned()),
            ("--device.fcd.begin", seconds(plan.warm_up_s)),
            #[expect(clippy::cast_precision_loss, reason = "a second or so")]
            (
                "--device.fcd.period",
                format!("{}", plan.sample_ms as f64 / 1_000.0),
            ),
            ("--time-to-teleport", "-1".to_owned()),
            ("--no-step-log", "true".to_owned()),
            ("--no-warnings", "true".to_owned()),
        ];
        let arguments = arguments
            .into_iter()
            .flat_map(|(name, value)| [name.to_owned(), value]);
        self.call("sumo", &arguments.collect::<Vec<_>>())?;
        let run = fcd::read(File::open(file("fcd.xml"))?, seed)?.run;
        let duration_ms = u64::from(plan.duration_s) * 1_000;
        let is_whole = (run.vehicles.len(), run.pedestrians.len())
            == (plan.vehicles, plan.pedestrians)
            && run.is_whole(duration_ms);
        if is_whole {
            return Ok(run);
        }
        Err(SumoError::NotAll {
            run: Box::new(run),
            plan: *plan,
        })
    }

    fn call(&self, program: &'static str, arguments: &[String]) -> Result<String, SumoError> {
        let path = self.folder.join(program);
        let output = Command::new(&path).args(arguments).output();
        let output = output.map_err(|error| SumoError::NotThere {
            program: path.display().to_string(),
            error,
        })?;
        if output.status.success() {
            return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
        }
        let message = String::from_utf8_lossy(&output.stderr);
        let message = message
            .lines()
            .find(|line| line.starts_with("Error"))
            .unwrap_or(&message);
        Err(SumoError::Failed {
            program,
            message: message.trim().to_owned(),
        })
    }
}

fn text(path: &Path) -> String {
    path.display().to_string()
}

/// A grid without stub roads, with sidewalks and crossings everywhere.
fn network_arguments(grid: &Grid, file: &Path) -> Vec<String> {
    let options = [
        ("--grid.number", grid.nodes_per_side.to_string()),
        ("--grid.length", grid.segment_m.to_string()),
        ("--default.lanenumber", grid.lanes.to_string()),
        ("--default.sidewalk-width", grid.sidewalk_m.to_string()),
        ("--default.speed", "13.89".to_owned()),
        ("--sidewalks.guess.min-speed", "0".to_owned()),
        ("--sidewalks.guess.max-speed", "30".to_owned()),
        ("--crossings.guess.speed-threshold", "30".to_owned()),
        ("--seed", "1".to_owned()),
        ("--output-file", text(file)),
    ];
    let flags = [
        "--grid",
        "--sidewalks.guess",
        "--crossings.guess",
        "--walkingareas",
    ];
    let options = options
        .into_iter()
        .flat_map(|(name, value)| [name.to_owned(), value]);
    flags
        .into_iter()
        .map(str::to_owned)
        .chain(options)
        .collect()
}

/// An intersection by its column and row.
type Node = (u32, u32);

/// `netgenerate` names columns by letters and rows by numbers.
fn name((column, row): Node) -> String {
    let letter = char::from_digit(10 + column, 36)
        .unwrap_or('z')
        .to_ascii_uppercase();
    format!("{letter}{row}")
}

fn neighbours(grid: &Grid, (column, row): Node) -> Vec<Node> {
    let side = grid.nodes_per_side;
    let mut nodes = Vec::new();
    nodes.extend(column.checked_sub(1).map(|column| (column, row)));
    nodes.extend(row.checked_sub(1).map(|row| (column, row)));
    nodes.extend((column + 1 < side).then_some((column + 1, row)));
    nodes.extend((row + 1 < side).then_some((column, row + 1)));
    nodes
}

fn streets(grid: &Grid) -> Vec<(Node, Node)> {
    let side = 0..grid.nodes_per_side;
    let nodes = side
        .clone()
        .flat_map(|column| side.clone().map(move |row| (column, row)));
    nodes
        .flat_map(|from| neighbours(grid, from).into_iter().map(move |to| (from, to)))
        .collect()
}

fn street((from, to): (Node, Node)) -> String {
    name(from) + &name(to)
}

/// SUMO's route file. The vehicles' part depends on the seed only, not on how many people there are.
fn routes(grid: &Grid, plan: &Plan, seed: u64) -> String {
    let streets = streets(grid);
    let total_s = plan.warm_up_s + plan.duration_s;
    let mut text = String::from(
        "<routes>\n<vType id=\"car\" vClass=\"passenger\"/>\n<vType id=\"walker\" vClass=\"pedestrian\"/>\n",
    );
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    for index in 0..plan.vehicles {
        let mut route = vec![streets[random.random_range(0..streets.len())]];
        // No vehicle passes more than one street in 5 s: 100 m are 7 s at 13.89 m/s.
        while route.len() < total_s as usize / 5 {
            let (from, at) = route[route.len() - 1];
            let mut onward = neighbours(grid, at);
            onward.retain(|next| *next != from);
            route.push((at, onward[random.random_range(0..onward.len())]));
        }
        let route: Vec<String> = route.into_iter().map(street).collect();
        let _ = writeln!(
            text,
            "<vehicle id=\"v{index}\" type=\"car\" depart=\"0\" departPos=\"random_free\">\
             <route edges=\"{}\"/></vehicle>",
            route.join(" ")
        );
    }
    let mut random = ChaCha8Rng::seed_from_u64(seed ^ 0x5eed << 32);
    for index in 0..plan.pedestrians {
        let mut at = streets[random.random_range(0..streets.len())];
        let begin_m = random.random_range(5.0..grid.segment_m - 20.0);
        let _ = write!(
            text,
            "<person id=\"p{index}\" type=\"walker\" depart=\"0\" departPos=\"{begin_m:.2}\">"
        );
        // Most ways take longer than 20 s, so nobody arrives at the last one.
        let mut from = format!(" from=\"{}\"", street(at));
        for _ in 0..2 + total_s / 20 {
            let others: Vec<_> = streets.iter().filter(|other| **other != at).collect();
            at = *others[random.random_range(0..others.len())];
            let _ = write!(text, "<walk{from} to=\"{}\"/>", street(at));
            from.clear();
        }
        text.push_str("</person>\n");
    }
    text + "</routes>\n"
}

#[cfg(test)]
mod tests {
    use super::super::grid::Preset;
    use super::*;

    #[test]
    fn streets_have_the_names_that_netgenerate_gives() {
        let streets = streets(&Preset::Plain.grid());
        assert_eq!(streets.len(), 24);
        assert_eq!(street(streets[0]), "A0B0");
        assert_eq!(name((2, 1)), "C1");
    }

    #[test]
    fn vehicles_drive_the_same_routes_among_any_number_of_people() {
        let vehicles = |pedestrians| {
            let plan = Plan {
                pedestrians,
                ..Plan::default()
            };
            let text = routes(&Preset::Kerb.grid(), &plan, 3);
            let lines = text.lines().filter(|line| line.starts_with("<vehicle"));
            lines.map(str::to_owned).collect::<Vec<_>>()
        };
        assert_eq!(vehicles(20), vehicles(100));
        assert_eq!(vehicles(20).len(), 20);
    }

    #[test]
    fn without_sumo_the_error_says_how_to_get_it() {
        let error = Sumo::in_folder(Path::new("nowhere")).version().unwrap_err();
        assert!(error.to_string().contains("pip install eclipse-sumo"));
    }
}
