//! The whole matrix: robots, people, radii and seeds, over all cores.

use crossguard_model_check::parallel::in_parallel;
use serde::Serialize;

use super::behaviour::Behaviour;
use super::coverage::{Places, coverage, places};
use super::messages::Sizes;
use super::robot::RobotError;
use super::simulation::{Measured, Silence, simulate};
use super::stationing::Stationing;
use super::statistics::Estimate;
use super::trace::Traces;

/// Parameters that vary.
#[derive(Clone, PartialEq, Debug)]
pub struct Axes {
    /// Numbers of robots.
    pub robots: Vec<usize>,
    /// Perception radii, in metres.
    pub radii_m: Vec<f64>,
    /// Where robots are.
    pub stationing: Stationing,
    /// Seeds at most.
    pub seeds: usize,
    /// Threads at most.
    pub threads: usize,
}

/// Coverage in a cell of the matrix.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
pub struct ObsCell {
    /// Robots.
    pub robots: usize,
    /// People on foot.
    pub pedestrians: usize,
    /// Perception radius in metres.
    pub radius_m: f64,
    /// The seeds of its runs.
    pub seeds: Vec<u64>,
    /// Observation coverage ratio, in percent.
    pub obs_percent: Estimate,
    /// Share of the covered time in which people are at an intersection, in percent.
    pub covered_at_intersections_percent: Estimate,
    /// Share of all their time in which they are there, in percent.
    pub at_intersections_percent: Estimate,
    /// Share of it in which they are on the road away from the crossings, in percent.
    pub on_road_between_percent: Estimate,
    /// How long all people are on their way together, in seconds.
    pub travel_s: Estimate,
}

/// Channel load in a cell of the matrix.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
pub struct CbrCell {
    /// Robots.
    pub robots: usize,
    /// People on foot.
    pub pedestrians: usize,
    /// Perception radius in metres.
    pub radius_m: f64,
    /// The seeds of its runs.
    pub seeds: Vec<u64>,
    /// Mean channel busy ratio, 0..1.
    pub mcbr: Estimate,
    /// How much less it is than without robots, in percent of that.
    pub reduction_percent: Estimate,
    /// Prediction by the law: coverage times the share of VAM less that of RAM, in percent.
    pub predicted_percent: Estimate,
    /// Share of devices' time without VAM of their own, in percent.
    pub passive_percent: Estimate,
    /// Share of devices' time without VAM of their own though no robot perceives them, in percent.
    pub wrongly_silent_percent: Estimate,
    /// Share of VAM in the air time without robots, in percent.
    pub vam_share_percent: Estimate,
    /// VAM, CAM and RAM per second.
    pub messages_per_s: [Estimate; 3],
    /// Share of frames that overlapped with another anywhere on the grid, also out of its range, in
    /// percent.
    pub overlapped_percent: Estimate,
}

/// Coverage in every cell, as long as `goes_on` says so; cells that were not reached are left out.
#[must_use]
pub fn obs(
    traces: &[Traces],
    axes: &Axes,
    behaviour: &Behaviour,
    goes_on: impl Fn() -> bool,
) -> Vec<ObsCell> {
    let mut cells = Vec::new();
    for traces in traces {
        for &robots in &axes.robots {
            for &radius_m in &axes.radii_m {
                if !goes_on() {
                    return cells;
                }
                let (streets, sample_ms) = (&traces.streets, traces.sample_ms);
                let runs = traces.runs.iter().take(axes.seeds).map(|run| {
                    let ways = axes
                        .stationing
                        .robots(traces, run, robots, radius_m, behaviour);
                    let found = places(run, streets, &ways, radius_m, sample_ms);
                    (100.0 * coverage(run, &ways, radius_m), found)
                });
                let (percent, found): (Vec<f64>, Vec<Places>) = runs.unzip();
                let share =
                    |of: fn(&Places) -> f64| Estimate::of(found.iter().map(|it| 100.0 * of(it)));
                cells.push(ObsCell {
                    robots,
                    pedestrians: traces.pedestrians(),
                    radius_m,
                    seeds: seeds(traces, axes),
                    obs_percent: Estimate::of(percent),
                    covered_at_intersections_percent: share(|it| it.covered_at_intersections),
                    at_intersections_percent: share(|it| it.at_intersections),
                    on_road_between_percent: share(|it| it.on_road_between),
                    travel_s: Estimate::of(found.iter().map(|it| it.travel_s)),
                });
            }
        }
    }
    cells
}

/// The seeds that are taken of these traces.
fn seeds(traces: &Traces, axes: &Axes) -> Vec<u64> {
    let runs = traces.runs.iter().take(axes.seeds);
    runs.map(|run| run.seed).collect()
}

#[derive(Clone, Copy, PartialEq, Debug)]
struct Job {
    traces: usize,
    run: usize,
    robots: usize,
    radius_m: f64,
}

#[derive(Clone, Debug)]
struct Done {
    measured: Measured,
    silences: Vec<Silence>,
    coverage: f64,
}

/// Channel load in every cell, and when devices were silent.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct CbrResults {
    /// The cells.
    pub cells: Vec<CbrCell>,
    /// When devices were silent in the runs with robots.
    pub silences: Vec<SilenceInRun>,
}

/// A time in which a device was silent in a run of the matrix.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct SilenceInRun {
    /// Robots.
    pub robots: usize,
    /// People on foot.
    pub pedestrians: usize,
    /// Perception radius in metres.
    pub radius_m: f64,
    /// The run's seed.
    pub seed: u64,
    /// Who, and when.
    #[serde(flatten)]
    pub silence: Silence,
}

/// Channel load in every cell; `done` is told after every run how many of how many there are, and says whether
/// to go on. If not, cells of which a run is missing are left out.
///
/// # Errors
/// When a message cannot be encoded.
pub fn cbr(
    traces: &[Traces],
    axes: &Axes,
    behaviour: &Behaviour,
    sizes: &Sizes,
    done: impl Fn(usize, usize) -> bool + Sync,
) -> Result<CbrResults, RobotError> {
    let jobs = jobs(traces, axes);
    let mut results: Vec<_> = jobs.iter().map(|_| None).collect();
    let run = |number: usize| measure(traces, axes, behaviour, sizes, &jobs[number]);
    let mut count = 0;
    in_parallel(axes.threads, jobs.len(), run, |number, measured| {
        count += 1;
        let goes_on = measured.is_ok() && done(count, jobs.len());
        results[number] = Some(measured);
        goes_on
    });
    let results: Vec<Option<Done>> = results
        .into_iter()
        .map(Option::transpose)
        .collect::<Result<_, _>>()?;
    let find = |wanted: Job| {
        let index = jobs.iter().position(|job| *job == wanted)?;
        results[index].clone()
    };
    Ok(CbrResults {
        cells: cells(traces, axes, find),
        silences: silences(traces, &jobs, &results),
    })
}

fn silences(traces: &[Traces], jobs: &[Job], results: &[Option<Done>]) -> Vec<SilenceInRun> {
    let runs = jobs
        .iter()
        .zip(results)
        .filter_map(|(job, done)| Some((job, done.as_ref()?)));
    let of_run = |(job, done): (&Job, &Done)| {
        let file = &traces[job.traces];
        let of = SilenceInRun {
            robots: job.robots,
            pedestrians: file.pedestrians(),
            radius_m: job.radius_m,
            seed: file.runs[job.run].seed,
            silence: Silence::default(),
        };
        let silences = done.silences.iter();
        silences
            .map(|&silence| SilenceInRun { silence, ..of })
            .collect::<Vec<_>>()
    };
    runs.flat_map(of_run).collect()
}

/// Without robots there is one run whatever the radius; it is what the others are compared with.
fn jobs(traces: &[Traces], axes: &Axes) -> Vec<Job> {
    let mut jobs = Vec::new();
    for (index, file) in traces.iter().enumerate() {
        for run in 0..file.runs.len().min(axes.seeds) {
            jobs.push(baseline(index, run));
            for &robots in axes.robots.iter().filter(|robots| **robots > 0) {
                jobs.extend(axes.radii_m.iter().map(|&radius_m| Job {
                    robots,
                    radius_m,
                    ..baseline(index, run)
                }));
            }
        }
    }
    jobs
}

const fn baseline(traces: usize, run: usize) -> Job {
    Job {
        traces,
        run,
        robots: 0,
        radius_m: 0.0,
    }
}

fn measure(
    traces: &[Traces],
    axes: &Axes,
    behaviour: &Behaviour,
    sizes: &Sizes,
    job: &Job,
) -> Result<Done, RobotError> {
    let file = &traces[job.traces];
    let run = &file.runs[job.run];
    let robots = axes
        .stationing
        .robots(file, run, job.robots, job.radius_m, behaviour);
    let mut behaviour = behaviour.clone();
    behaviour.clustering.radius_m = job.radius_m;
    let (measured, silences) = simulate(run, run.duration_ms(), &robots, &behaviour, sizes)?;
    Ok(Done {
        measured,
        silences,
        coverage: coverage(run, &robots, job.radius_m) * (1.0 - behaviour.unseen_share),
    })
}

fn cells(traces: &[Traces], axes: &Axes, find: impl Fn(Job) -> Option<Done>) -> Vec<CbrCell> {
    let mut cells = Vec::new();
    for (index, file) in traces.iter().enumerate() {
        let runs = file.runs.len().min(axes.seeds);
        let before: Vec<Done> = (0..runs)
            .filter_map(|run| find(baseline(index, run)))
            .collect();
        for &robots in &axes.robots {
            for &radius_m in &axes.radii_m {
                let job = |run| Job {
                    robots,
                    radius_m: if robots == 0 { 0.0 } else { radius_m },
                    ..baseline(index, run)
                };
                let after: Vec<Done> = (0..runs).filter_map(|run| find(job(run))).collect();
                if before.len() == runs && after.len() == runs {
                    cells.push(CbrCell {
                        robots,
                        pedestrians: file.pedestrians(),
                        radius_m,
                        seeds: seeds(file, axes),
                        ..cell(&before, &after)
                    });
                }
            }
        }
    }
    cells
}

fn cell(before: &[Done], after: &[Done]) -> CbrCell {
    let percent = |of: fn(&Done) -> f64| Estimate::of(after.iter().map(|it| 100.0 * of(it)));
    let rate = |of: fn(&Measured) -> f64| Estimate::of(after.iter().map(|it| of(&it.measured)));
    let pairs = || before.iter().zip(after);
    let reduction = pairs().map(|(before, after)| {
        100.0 * (1.0 - after.measured.mcbr / before.measured.mcbr.max(f64::MIN_POSITIVE))
    });
    let predicted = pairs().map(|(before, after)| {
        100.0 * predicted_reduction(&before.measured, &after.measured, after.coverage)
    });
    CbrCell {
        mcbr: Estimate::of(after.iter().map(|it| it.measured.mcbr)),
        reduction_percent: Estimate::of(reduction),
        predicted_percent: Estimate::of(predicted),
        passive_percent: percent(|it| it.measured.passive),
        wrongly_silent_percent: percent(|it| it.measured.wrongly_silent),
        vam_share_percent: Estimate::of(before.iter().map(|it| 100.0 * vam_share(&it.measured))),
        messages_per_s: [
            rate(|it| it.vam_rate),
            rate(|it| it.cam_rate),
            rate(|it| it.ram_rate),
        ],
        overlapped_percent: percent(|it| it.measured.overlapped),
        ..CbrCell::default()
    }
}

/// Share of VAM in the air time, 0..1.
#[must_use]
pub fn vam_share(measured: &Measured) -> f64 {
    measured.vam_load / (measured.vam_load + measured.cam_load).max(f64::MIN_POSITIVE)
}

/// The law of the channel load: devices that a robot stands in for take `quiet` of the VAM away, and its
/// RAM come on top. Both as shares of the air time without robots.
#[must_use]
pub fn predicted_reduction(before: &Measured, after: &Measured, quiet: f64) -> f64 {
    let load = (before.vam_load + before.cam_load).max(f64::MIN_POSITIVE);
    quiet * vam_share(before) - after.ram_load / load
}
