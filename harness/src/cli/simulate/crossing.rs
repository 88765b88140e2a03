//! `crossguard simulate crossing`: how people and vehicles fare where robots guard a crossing, or nobody does.

use std::fs::File;
use std::path::PathBuf;
use std::sync::atomic::Ordering;

use crossguard_endpoint::ras::motion::distance_m;
use crossguard_evaluation::fcd::{self, Recording};
use crossguard_evaluation::messages::DATA_RATE_MBPS;
use crossguard_evaluation::messages::{
    Signed, Sizes, air_time_us, frame_octets, packet_air_time_us,
};
use crossguard_evaluation::shipped;
use crossguard_evaluation::statistics::Estimate;
use crossguard_evaluation::trace::Track;
use crossguard_judge::sim::{Arrival, Demand, Habits, Measured, Swarm};
use crossguard_model_check::parallel::in_parallel;
use serde::Serialize;
use toml::Table;

use super::output::{self, Row};
use super::{Failure, Output, RUNS, csv, interrupts, print, print_json, progress, whole_matrix};
use crate::cli::ranges::whole;

/// Most robots: a leader and its followers.
const ROBOTS_MAX: i128 = 1 + crossguard_protocol::MAX_FOLLOWERS as i128;

/// The crossing of the school street that comes along, in metres of its net.
const SCHOOL_M: [f64; 2] = [241.5, 20.0];

/// Distance from the crossing within which people cross there, to the east or west and to the north or south, in m.
const NEAR_M: [f64; 2] = [10.0, 30.0];
/// From where to where vehicles come to the street, in metres from the crossing.
const STREET_M: std::ops::RangeInclusive<f64> = 30.0..=1_000.0;

#[derive(clap::Args)]
pub(super) struct Crossing {
    /// Numbers of robots: none, one that finds no help, or a team
    #[arg(long, value_delimiter = ',', value_name = "N,…", default_value = "0,1,2,4", value_parser = whole::<usize>(0..=ROBOTS_MAX))]
    robots: Vec<usize>,
    /// How many runs of each [default: all that there are]
    #[arg(long, value_name = "N", value_parser = whole::<usize>(1..=i128::from(u16::MAX)))]
    seeds: Option<usize>,
    /// Who comes, SUMO's --fcd-output (plain or .gz), a run for each file [default: the school street]
    #[arg(long, value_name = "FCD", num_args = 1.., requires = "at")]
    fcd: Vec<PathBuf>,
    /// Where the crossing is in these files, in metres; its street runs from west to east
    #[arg(
        long,
        value_name = "X,Y",
        value_delimiter = ',',
        num_args = 1,
        requires = "fcd",
        allow_negative_numbers = true
    )]
    at: Vec<f64>,
    /// How people, drivers and leaders behave, like loss=0.1; may be repeated
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
    #[command(flatten)]
    output: Output,
}

/// People and vehicles that come in a run.
struct Comers {
    seed: u64,
    people: Vec<Arrival>,
    vehicles: Vec<Arrival>,
    elsewhere: usize,
}

/// Results for a number of robots.
#[derive(Serialize)]
struct Cell {
    robots: usize,
    seeds: Vec<u64>,
    /// Time at the kerb, in seconds.
    wait_s: Estimate,
    wait_95_s: Estimate,
    /// Delay of vehicles, in seconds.
    delay_s: Estimate,
    delay_95_s: Estimate,
    /// Shares of the people, in percent.
    at_sign_percent: Estimate,
    gave_up_percent: Estimate,
    /// Conflicts and people hit per 100 people who crossed.
    ttc_per_100: Estimate,
    pet_per_100: Estimate,
    hit_per_100: Estimate,
    /// The same in all runs.
    hit: usize,
    hit_at_sign: usize,
    left_alone: usize,
    robots_hit_per_hour: Estimate,
    cbr_percent: Estimate,
    silent_vams_percent: Estimate,
    /// Properties that robots broke.
    findings: Vec<String>,
}

impl Row for Cell {
    fn columns(&self) -> Vec<(&'static str, String)> {
        let of = |it: &Estimate, digits: usize| {
            let [least, most] = it.ci95;
            format!(
                "{:.digits$} ({:.digits$}–{most:.digits$})",
                it.mean,
                least.max(0.0)
            )
        };
        vec![
            ("robots", self.robots.to_string()),
            ("wait, s", of(&self.wait_s, 1)),
            ("95 %", of(&self.wait_95_s, 1)),
            ("gave up, %", of(&self.gave_up_percent, 1)),
            ("at go, %", of(&self.at_sign_percent, 1)),
            ("delay, s", of(&self.delay_s, 1)),
            ("TTC", of(&self.ttc_per_100, 2)),
            ("PET", of(&self.pet_per_100, 2)),
            ("hit", format!("{} ({})", self.hit, self.hit_at_sign)),
            ("alone", self.left_alone.to_string()),
            ("robots struck/h", of(&self.robots_hit_per_hour, 1)),
            ("CBR, %", of(&self.cbr_percent, 2)),
            ("findings", self.findings.len().to_string()),
        ]
    }
}

/// Assumptions of the results.
#[derive(Serialize)]
struct Assumed {
    seeds: usize,
    people: usize,
    vehicles: usize,
    elsewhere: usize,
    #[serde(flatten)]
    habits: Habits,
}

#[derive(Serialize)]
struct CrossingReport<'a> {
    parameters: &'a Assumed,
    crossing: &'a [Cell],
}

pub(super) fn run(arguments: &Crossing) -> Result<(), Failure> {
    arguments.output.check()?;
    let habits = habits(&arguments.set)?;
    let mut comers = comers(arguments)?;
    let seeds = arguments.seeds.unwrap_or(comers.len());
    if seeds > comers.len() {
        let why = format!(
            "--seeds {seeds}: there are {} runs; give more by --fcd",
            comers.len()
        );
        return Err(Failure::Input(why));
    }
    comers.truncate(seeds);
    let sizes = Sizes::measure(5).map_err(Failure::input)?;
    let interrupted = interrupts();
    let jobs: Vec<_> = arguments
        .robots
        .iter()
        .flat_map(|it| comers.iter().map(move |of| (*it, of)))
        .collect();
    let bar = progress(arguments.output.json, RUNS);
    bar.set_length(jobs.len() as u64);
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let run = |number: usize| {
        let (robots, of) = jobs[number];
        let demand = Demand::draw(of.seed, &of.people, &of.vehicles, habits);
        Measured::of(&Swarm::at_place(of.seed, robots, demand))
    };
    let mut done = vec![None; jobs.len()];
    in_parallel(threads, jobs.len(), run, |number, measured| {
        done[number] = Some(measured);
        bar.inc(1);
        !interrupted.load(Ordering::Relaxed)
    });
    bar.finish_and_clear();
    let runs = done.chunks(seeds).zip(&arguments.robots);
    // A number of robots of which a run is missing is left out.
    let cells = runs.filter_map(|(runs, robots)| {
        let runs: Option<Vec<Measured>> = runs.iter().cloned().collect();
        Some(cell(*robots, &comers, &runs?, &sizes))
    });
    let cells: Vec<_> = cells.collect();
    let all = |of: fn(&Comers) -> usize| comers.iter().map(of).sum();
    let assumed = Assumed {
        seeds,
        people: all(|it| it.people.len()),
        vehicles: all(|it| it.vehicles.len()),
        elsewhere: all(|it| it.elsewhere),
        habits,
    };
    let written = csv::write(arguments.output.csv.as_deref(), &output::by_seed(&cells)?);
    if arguments.output.json {
        print_json(&CrossingReport {
            parameters: &assumed,
            crossing: &cells,
        })?;
    } else {
        output::print_parameters("Assumptions, and who came in all runs:", &assumed)?;
        print(output::table(&cells))?;
        print(NOTES)?;
        for finding in cells.iter().flat_map(|it| &it.findings) {
            print(finding)?;
        }
    }
    written?;
    if cells.iter().any(|it| !it.findings.is_empty()) {
        return Err(Failure::Wrong);
    }
    whole_matrix(interrupted.load(Ordering::Relaxed))
}

const NOTES: &str = "\
Means over seeds with 95 % intervals. TTC, PET: pairs of a person and a vehicle below 1.5 s, per 100 people who crossed. \
hit: people in all runs (of them at a sign that shows go). alone: people who set out at go and had no guard in place for more than \
half a second. robots struck: vehicles and robots at one place, per hour. findings: properties that robots broke.";

/// The defaults, with these lines over them.
fn habits(lines: &[String]) -> Result<Habits, Failure> {
    let mut all = Table::new();
    for line in lines {
        let wrong =
            |cause: toml::de::Error| Failure::Input(format!("--set {line}: {}", cause.message()));
        all.extend(line.parse::<Table>().map_err(wrong)?);
        let habits: Habits = all.clone().try_into().map_err(wrong)?;
        habits
            .check()
            .map_err(|why| Failure::Input(format!("--set {line}: {why}")))?;
    }
    all.try_into().map_err(Failure::input)
}

/// The people and vehicles of each run, from the files that are named or from the school street.
fn comers(arguments: &Crossing) -> Result<Vec<Comers>, Failure> {
    if arguments.fcd.is_empty() {
        let shipped = (1..).zip(shipped::SCHOOL_STREET);
        let read = shipped.map(|(seed, file)| fcd::read(*file, seed).map_err(Failure::input));
        return read.map(|it| Ok(Comers::of(&it?, SCHOOL_M))).collect();
    }
    let at: [f64; 2] = arguments.at[..].try_into().map_err(|_| {
        Failure::Input("--at: east and north of the crossing are wanted, like 241.5,20".to_owned())
    })?;
    let read = (1..).zip(&arguments.fcd).map(|(seed, path)| {
        let file = File::open(path).map_err(Failure::at(path))?;
        let recording = fcd::read(file, seed).map_err(Failure::at(path))?;
        let comers = Comers::of(&recording, at);
        if comers.people.is_empty() {
            let why = format!(
                "nobody comes within {NEAR_M:?} m of the crossing at {at:?}: say --at anew"
            );
            return Err(Failure::at(path)(why));
        }
        Ok(comers)
    });
    read.collect()
}

impl Comers {
    fn of(recording: &Recording, at: [f64; 2]) -> Self {
        let (run, sample_ms) = (&recording.run, recording.sample_ms);
        let people = run.pedestrians.iter();
        let people: Vec<_> = people.filter_map(|it| person(it, sample_ms, at)).collect();
        let vehicles: Vec<_> = run
            .vehicles
            .iter()
            .filter_map(|it| vehicle(it, at))
            .collect();
        Self {
            seed: run.seed,
            elsewhere: run.pedestrians.len() + run.vehicles.len() - people.len() - vehicles.len(),
            people,
            vehicles,
        }
    }
}

/// A person on foot, from when they are near the crossing on.
fn person(track: &Track, sample_ms: u64, at: [f64; 2]) -> Option<Arrival> {
    let is_near =
        |place: [f64; 2]| (0..2).all(|axis| (place[axis] - at[axis]).abs() <= NEAR_M[axis]);
    let first = track
        .samples()
        .iter()
        .position(|it| is_near(it.position_m))?;
    let first = track.first_sample() + first;
    let from = track.place_at(first);
    // The fastest of three successive steps: a person who waits stands.
    let steps = track.samples().windows(4);
    let steps_m = steps.map(|it| distance_m(it[0].position_m, it[3].position_m));
    let way_m = steps_m.fold(0.0, f64::max);
    #[expect(clippy::cast_precision_loss, reason = "some seconds")]
    let speed_mps = way_m / (3 * sample_ms) as f64 * 1e3;
    Some(Arrival {
        at_us: first as u64 * sample_ms * 1_000,
        away_m: (from[1] - at[1]).abs(),
        comes_back: from[1] > at[1],
        speed_mps: speed_mps.clamp(0.5, 2.5),
    })
}

/// A vehicle on the street, from its first sample on.
fn vehicle(track: &Track, at: [f64; 2]) -> Option<Arrival> {
    let [x, y] = track.samples().first()?.position_m;
    let away_m = (x - at[0]).abs();
    ((y - at[1]).abs() <= NEAR_M[0] && STREET_M.contains(&away_m)).then_some(Arrival {
        at_us: track.begin_ms() * 1_000,
        away_m,
        comes_back: x > at[0],
        speed_mps: 0.0,
    })
}

#[expect(clippy::cast_precision_loss, reason = "counts and microseconds")]
fn cell(robots: usize, comers: &[Comers], runs: &[Measured], sizes: &Sizes) -> Cell {
    let each = |of: &dyn Fn(&Measured) -> f64| Estimate::of(runs.iter().map(of));
    let share = |part: usize, all: usize| 100.0 * part as f64 / all.max(1) as f64;
    let crossed = |it: &Measured| it.at_sign + it.by_gap;
    let ended = |it: &Measured| it.waited_s.len();
    let findings = runs.iter().zip(comers).filter_map(|(it, of)| {
        let finding = it.finding.as_ref()?;
        Some(format!("{robots} robots, seed {}: {finding}", of.seed))
    });
    Cell {
        robots,
        seeds: comers.iter().map(|it| it.seed).collect(),
        wait_s: each(&|it| quantile(&it.waited_s, None)),
        wait_95_s: each(&|it| quantile(&it.waited_s, Some(0.95))),
        delay_s: each(&|it| quantile(&it.delays_s, None)),
        delay_95_s: each(&|it| quantile(&it.delays_s, Some(0.95))),
        at_sign_percent: each(&|it| share(it.at_sign, ended(it))),
        gave_up_percent: each(&|it| share(it.gave_up, ended(it))),
        ttc_per_100: each(&|it| share(it.ttc, crossed(it))),
        pet_per_100: each(&|it| share(it.pet, crossed(it))),
        hit_per_100: each(&|it| share(it.hit, crossed(it))),
        hit: runs.iter().map(|it| it.hit).sum(),
        hit_at_sign: runs.iter().map(|it| it.hit_at_sign).sum(),
        left_alone: runs.iter().map(|it| it.left_alone).sum(),
        robots_hit_per_hour: each(&|it| it.robots_hit as f64 / it.seconds * 3_600.0),
        cbr_percent: each(&|it| busy_us(it, sizes) as f64 / it.seconds / 1e4),
        silent_vams_percent: each(&|it| {
            100.0 * it.silent_vams as f64 / (it.vams + it.silent_vams).max(1) as f64
        }),
        findings: findings.collect(),
    }
}

/// The mean of values, or the one below which this share of them is; 0 without values.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "some hundred values"
)]
fn quantile(values: &[f64], share: Option<f64>) -> f64 {
    let Some(share) = share else {
        return values.iter().sum::<f64>() / values.len().max(1) as f64;
    };
    let mut values = values.to_vec();
    values.sort_by(f64::total_cmp);
    let last = values.len().saturating_sub(1) as f64;
    values
        .get((last * share).round() as usize)
        .copied()
        .unwrap_or(0.0)
}

/// How long all messages are in the air, where nobody waits for anybody, in microseconds.
fn busy_us(run: &Measured, sizes: &Sizes) -> u64 {
    let of = |octets| air_time_us(frame_octets(octets, Signed::No), DATA_RATE_MBPS);
    let robots = run
        .packets
        .iter()
        .map(|(octets, count)| packet_air_time_us(*octets) * count);
    robots.sum::<u64>() + run.cams * of(sizes.cam(false)) + run.vams * of(sizes.plain_vam())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A person who waits at the kerb, one elsewhere, and vehicles from either side.
    #[test]
    fn people_and_vehicles_of_floating_car_data_come_when_they_are_first_there() {
        let ways = [82.0, 83.2, 84.4, 85.6, 85.6, 85.6];
        let step = |time: usize| {
            let here = (time >= 4).then(|| ways[(time - 4).min(5)]);
            let here = here.map(|y| format!(r#"<person id="a" x="101" y="{y}"/>"#));
            let cars = r#"<vehicle id="c" x="-120" y="98"/><vehicle id="d" x="310" y="102"/><vehicle id="e" x="100" y="300"/>"#;
            let cars = if time == 2 { cars } else { "" };
            let here = here.unwrap_or_default();
            format!(
                r#"<timestep time="{time}">{here}<person id="b" x="300" y="82"/>{cars}</timestep>"#
            )
        };
        let steps: String = (0..12).map(step).collect();
        let text = format!("<fcd-export>{steps}</fcd-export>");
        let recording = fcd::read(text.as_bytes(), 7).unwrap();
        let comers = Comers::of(&recording, [100.0, 100.0]);
        assert_eq!((comers.seed, comers.elsewhere), (7, 2));
        let [person] = comers.people[..] else {
            panic!("{:?}", comers.people);
        };
        assert_eq!((person.at_us, person.comes_back), (4_000_000, false));
        assert!((person.away_m - 18.0).abs() < 1e-9 && (person.speed_mps - 1.2).abs() < 1e-9);
        let vehicle = |it: &Arrival| format!("{} {:.0} {}", it.at_us, it.away_m, it.comes_back);
        let vehicles: Vec<_> = comers.vehicles.iter().map(vehicle).collect();
        assert_eq!(vehicles, ["2000000 220 false", "2000000 210 true"]);
    }

    #[test]
    fn habits_that_cannot_be_are_refused_with_what_is_wanted() {
        let of = |line: &str| habits(&[line.to_owned()]).map_err(|it| format!("{it:?}"));
        assert!((of("loss=0.5").unwrap().loss - 0.5).abs() < 1e-9);
        for (line, why) in [
            ("loss=2", "0 to 1 is wanted"),
            ("patience_s=[9,3]", "9 to 3600 is wanted"),
            ("speed=3", "unknown field"),
        ] {
            let refused = of(line).unwrap_err();
            assert!(refused.contains(why), "{refused}");
        }
    }
}
