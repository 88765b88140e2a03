//! `crossguard simulate`.

mod crossing;
mod options;
mod output;
mod parameters;

use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crossguard_evaluation::behaviour::Behaviour;
use crossguard_evaluation::coverage::greedy;
use crossguard_evaluation::matrix::{self, Axes};
use crossguard_evaluation::messages::Sizes;
use crossguard_evaluation::paper::{PAPER, PaperSimulation};
use crossguard_evaluation::statements::{self, Comparison, Setting};
use crossguard_evaluation::stationing::Stationing;
use crossguard_evaluation::trace::{Run, Traces};
use serde::Serialize;

use self::options::{Air, Assumptions, Matrix, Mobility, Output};
use self::parameters::Parameters;
use super::interrupts::interrupts;
use super::{Failure, csv, destinations, print, print_json, progress};

/// How far the runs are.
const RUNS: &str = "runs {bar:40} {pos}/{len} {eta}";

#[derive(clap::Args)]
#[command(args_conflicts_with_subcommands = true)]
pub(super) struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    rank: Rank,
}

#[derive(clap::Subcommand)]
enum Command {
    /// How many of the people on foot robots see: the observation coverage ratio.
    Obs(Obs),
    /// How busy the radio channel is, and how much less when robots stand in for people's devices.
    Cbr(Cbr),
    /// How people and vehicles fare at a crossing that robots guard, or nobody.
    Crossing(crossing::Crossing),
    /// Record mobility with SUMO, which runs as a process of its own.
    Record(Record),
}

#[derive(clap::Args)]
struct Obs {
    #[command(flatten)]
    matrix: Matrix,
    #[command(flatten)]
    output: Output,
}

#[derive(clap::Args)]
struct Cbr {
    #[command(flatten)]
    matrix: Matrix,
    #[command(flatten)]
    air: Air,
    #[command(flatten)]
    output: Output,
}

/// Without a subcommand: the intersections, each ranked by the coverage that a robot there adds to those ranked before.
#[derive(clap::Args)]
struct Rank {
    #[command(flatten)]
    matrix: Matrix,
    /// Print the ranking as JSON, and nothing else.
    #[arg(long)]
    json: bool,
}

#[derive(clap::Args)]
struct Record {
    #[command(flatten)]
    mobility: Mobility,
    /// The folder that the files are written to.
    #[arg(long, default_value = ".", value_name = "FOLDER")]
    output: PathBuf,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    match &arguments.command {
        Some(Command::Obs(arguments)) => obs(arguments),
        Some(Command::Cbr(arguments)) => cbr(arguments),
        Some(Command::Crossing(arguments)) => crossing::run(arguments),
        Some(Command::Record(arguments)) => record(arguments),
        None => place(&arguments.rank),
    }
}

/// Report of a matrix.
#[derive(Serialize)]
struct SimulateReport<'a, C> {
    preset: Option<&'a str>,
    /// Whether nothing was set otherwise than the evaluation page documents it.
    documented: bool,
    parameters: &'a Assumptions,
    cells: &'a [C],
    /// The paper's statements on its simulation.
    paper: &'a PaperSimulation,
    /// The paper's statements, beside the measurements.
    statements: &'a [Comparison],
}

fn obs(arguments: &Obs) -> Result<(), Failure> {
    let measured = Measured::from(&arguments.matrix, None, &arguments.output)?;
    let behaviour = &measured.chosen.behaviour;
    let go_on = || !measured.was_stopped();
    let cells = matrix::obs(&measured.traces, &measured.axes, behaviour, go_on);
    // Dispatched robots hear devices.
    let is_dispatched = measured.axes.stationing.dispatch_interval_s.is_some();
    let heard = is_dispatched.then_some(behaviour);
    measured.tell(heard, &cells, statements::of_coverage, Ok(()))
}

fn cbr(arguments: &Cbr) -> Result<(), Failure> {
    destinations::files([&arguments.air.silences])?;
    let measured = Measured::from(&arguments.matrix, Some(&arguments.air), &arguments.output)?;
    let behaviour = &measured.chosen.behaviour;
    let sizes = Sizes::measure(behaviour.cam_path_points).map_err(Failure::input)?;
    let bar = progress(arguments.output.json, RUNS);
    let done = |finished: usize, of: usize| {
        bar.set_length(of as u64);
        bar.set_position(finished as u64);
        !measured.was_stopped()
    };
    let cells = matrix::cbr(&measured.traces, &measured.axes, behaviour, &sizes, done);
    bar.finish_and_clear();
    let results = cells.map_err(Failure::input)?;
    let written = csv::write(arguments.air.silences.as_deref(), &results.silences);
    let (cells, statements) = (&results.cells, statements::of_load);
    measured.tell(Some(behaviour), cells, statements, written)
}

/// What a matrix is measured from, and where its results go.
struct Measured<'a> {
    output: &'a Output,
    chosen: Parameters,
    axes: Axes,
    traces: Vec<Traces>,
    interrupted: Arc<AtomicBool>,
}

impl<'a> Measured<'a> {
    fn from(matrix: &Matrix, air: Option<&Air>, output: &'a Output) -> Result<Self, Failure> {
        output.check()?;
        let interrupted = interrupts();
        let chosen = matrix.parameters(air)?;
        let axes = chosen.axes()?;
        Ok(Self {
            traces: chosen.traces(&axes, output.json)?,
            output,
            chosen,
            axes,
            interrupted,
        })
    }

    fn was_stopped(&self) -> bool {
        self.interrupted.load(Ordering::Relaxed)
    }

    /// Writes and prints the cells, and what the paper states of them if all are there. `written` is what became of other files:
    /// where one cannot be written, the figures are printed all the same.
    fn tell<C: Serialize + output::Row>(
        &self,
        behaviour: Option<&Behaviour>,
        cells: &[C],
        statements: impl Fn(Setting<'_>, &[C]) -> Vec<Comparison>,
        written: Result<(), Failure>,
    ) -> Result<(), Failure> {
        let was_stopped = self.was_stopped();
        let parameters = &Assumptions::of(&self.axes, &self.traces, behaviour.cloned());
        let path = self.output.csv.as_deref();
        let written = csv::write(path, &output::by_seed(cells)?).and(written);
        let statements = if was_stopped {
            Vec::new()
        } else {
            statements(parameters.setting(&self.axes), cells)
        };
        let documented = self.chosen.is_documented(&self.axes, parameters.seeds());
        if self.output.json {
            print_json(&SimulateReport {
                preset: self.chosen.preset_of(&self.traces),
                documented,
                parameters,
                cells,
                paper: &PAPER,
                statements: &statements,
            })?;
        } else {
            let title = "Assumptions, most of which the paper does not state:";
            output::print_parameters(title, parameters)?;
            print(output::table(cells))?;
            output::print_statements(documented, &statements)?;
        }
        written?;
        whole_matrix(was_stopped)
    }
}

/// Says when the matrix is not whole.
fn whole_matrix(was_stopped: bool) -> Result<(), Failure> {
    if !was_stopped {
        return Ok(());
    }
    // Standard error may be gone; the exit code says it as well.
    let _ = writeln!(
        std::io::stderr(),
        "crossguard: stopped before it was done; cells with fewer seeds than asked for are left out"
    );
    Err(Failure::Incomplete)
}

#[derive(Serialize)]
struct Ranked {
    rank: usize,
    node_m: [f64; 2],
    robot_m: [f64; 2],
    obs_percent: f64,
    gained_percent: f64,
}

fn place(arguments: &Rank) -> Result<(), Failure> {
    let chosen = arguments.matrix.parameters(None)?;
    let mut rankings = Vec::new();
    let axes = chosen.axes()?;
    for traces in chosen.traces(&axes, arguments.json)? {
        let nodes = traces.streets.nodes();
        let stationing = Stationing {
            robots_at: None,
            ..axes.stationing.clone()
        };
        let robots = stationing.schedules(&traces.streets, usize::MAX, 0);
        let places: Vec<_> = robots.iter().map(|it| it.place_at(0.0)).collect();
        for &radius_m in &axes.radii_m {
            let runs: Vec<Run> = traces.runs.iter().take(axes.seeds).cloned().collect();
            let mut before = 0.0;
            let order = greedy(&runs, &places, radius_m).into_iter().enumerate();
            let ranked = order.map(|(rank, (index, covered))| {
                let gained = 100.0 * (covered - before);
                before = covered;
                Ranked {
                    rank: rank + 1,
                    node_m: nodes[index / stationing.robots_per_intersection],
                    robot_m: places[index],
                    obs_percent: 100.0 * covered,
                    gained_percent: gained,
                }
            });
            rankings.push(Intersections {
                pedestrians: traces.pedestrians(),
                radius_m,
                ranking: ranked.collect(),
            });
        }
    }
    if arguments.json {
        return print_json(&rankings);
    }
    rankings.iter().try_for_each(print_ranking)
}

#[derive(Serialize)]
struct Intersections {
    pedestrians: usize,
    radius_m: f64,
    ranking: Vec<Ranked>,
}

fn print_ranking(ranking: &Intersections) -> Result<(), Failure> {
    print(format_args!(
        "{} pedestrians, {} m",
        ranking.pedestrians, ranking.radius_m
    ))?;
    for it in &ranking.ranking {
        let ([x, y], [east, north]) = (it.node_m, it.robot_m);
        print(format_args!(
            "{:>4}. intersection ({x:.0}, {y:.0}) m, robot at ({east:.1}, {north:.1}) m: +{:.2} %, {:.2} % together",
            it.rank, it.gained_percent, it.obs_percent
        ))?;
    }
    print("")
}

fn record(arguments: &Record) -> Result<(), Failure> {
    let chosen = arguments.mobility.parameters()?;
    let sumo = chosen.sumo()?;
    destinations::folder(&arguments.output)?;
    let interrupted = interrupts();
    std::fs::create_dir_all(&arguments.output).map_err(Failure::input)?;
    let seeds: Vec<u64> = (1..).take(chosen.fresh()).collect();
    for &pedestrians in chosen.pedestrians() {
        if interrupted.load(Ordering::Relaxed) {
            return Err(Failure::Incomplete);
        }
        let plan = chosen.plan(pedestrians);
        let traces = chosen.record(&sumo, &plan, &seeds, false)?;
        let name = format!("{}-{pedestrians}.json.gz", chosen.preset_name());
        let path = arguments.output.join(name);
        let file = std::fs::File::create(&path).and_then(|file| traces.write(file));
        file.map_err(Failure::at(&path))?;
        print(format_args!(
            "{}: {} runs of {} s",
            path.display(),
            seeds.len(),
            plan.duration_s
        ))?;
    }
    Ok(())
}
