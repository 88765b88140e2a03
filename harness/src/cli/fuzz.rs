//! `crossguard fuzz`.

use std::collections::BTreeMap;
use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use crossguard_judge::sim::{Files, Fuzz, Longest, Measure, Planned, Totals, write_failure};
use crossguard_protocol::StationId;
use crossguard_robot::plan_file::PlanFile;
use crossguard_robot::transport::Faults;
use serde::Serialize;

use super::interrupts::interrupts;
use super::ranges::{any, number, whole};
use super::{Failure, destinations, open_logs, print, print_json, progress, report};

#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub(super) struct Arguments {
    /// How many seeds to run.
    #[arg(long, default_value_t = 1_000, value_parser = whole::<u64>(1..=u64::MAX.into()))]
    seeds: u64,
    /// How many robots there are at most.
    #[arg(long, default_value_t = 6, value_parser = whole::<u8>(2..=32))]
    robots: u8,
    /// The first seed.
    #[arg(long, default_value_t = 1, value_parser = any)]
    seed: u64,
    /// Faults of every way in place of those drawn, like burst=0.4x8,delay=0..50. Crashes, partitions
    /// and the rest are drawn all the same.
    #[arg(long, value_name = "LIST")]
    faults: Option<Faults>,
    /// What every leader does: a plan of your own, or one that comes with the kit, by name. Drawn by default.
    /// Any robot takes any role; a plan that takes more followers than there are robots crosses nobody.
    #[arg(long, value_name = "FILE")]
    plan: Option<PathBuf>,
    /// The site that the plan is on; by default the street of the demonstrations.
    #[arg(long, value_name = "FILE", requires = "plan")]
    site: Option<PathBuf>,
    /// In which share of the seeds robots see people by sensors that miss some, mix them up, fall silent and come late.
    /// In the others they know everybody on the road. 0.5 by default, and 0 with --site.
    #[arg(long, value_name = "SHARE", value_parser = number(0.0..=1.0))]
    sensors: Option<f64>,
    /// In which share of the seeds an insider lies: a station with a certificate that says anything in its own name.
    #[arg(long, value_name = "SHARE", default_value_t = 0.25, value_parser = number(0.0..=1.0))]
    liars: f64,
    /// How many threads work; by default one for each core.
    #[arg(long, value_parser = whole::<u8>(1..=255))]
    threads: Option<u8>,
    /// After how many failed seeds it is enough.
    #[arg(long, default_value_t = 10, value_parser = whole::<u16>(1..=65_535))]
    failures: u16,
    /// Write log, packets and report of failed seeds into this folder.
    #[arg(long, value_name = "DIR", default_value = "crossguard-fuzz")]
    out: PathBuf,
    /// Print the results as JSON, and nothing else.
    #[arg(long)]
    json: bool,
}

const AFTER_HELP: &str = "\
Whole endpoints with real packets run in virtual time. From each seed is drawn who there is, which \
faults the radio has, who detects, crashes, hangs and boots again, who crosses the road, and in half of the seeds what \
sensors make of these people. At first there \
are faults, then the network is healed: no property may break, where a team can exist a crossing must be \
completed, and all robots must come to rest. In a quarter of the seeds an insider lies until then: no property may \
break that assumes no truth of it. The same seed gives the same run.";

/// The results as JSON.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct FuzzReport<'a> {
    #[serde(flatten)]
    totals: &'a Totals,
    robots_max: u8,
    first_seed: u64,
    seconds: f64,
    /// For each failure, the command that runs it again.
    reproduce: Vec<String>,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    destinations::folder(&arguments.out)?;
    let sensors = sensors(arguments)?;
    let plan = planned(arguments)?;
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let fuzz = Fuzz {
        first: arguments.seed,
        seeds: arguments.seeds,
        robots: usize::from(arguments.robots),
        faults: arguments.faults.as_ref(),
        plan: plan.as_ref(),
        sensors,
        liars: arguments.liars,
        threads: arguments.threads.map_or(cores, usize::from),
        failures_max: usize::from(arguments.failures),
    };
    let began = Instant::now();
    let totals = watched(&fuzz, arguments.json);
    let seconds = began.elapsed();
    // Where files cannot be written, the results are told all the same.
    let mut kept = Ok(());
    for failure in &totals.failures {
        let files = write(&arguments.out, &fuzz, failure);
        if !arguments.json {
            tell_failure(&fuzz, failure, files.as_ref().ok())?;
        }
        kept = kept.and(files.map(|_| ()));
    }
    if arguments.json {
        let failures = totals.failures.iter();
        print_json(&FuzzReport {
            totals: &totals,
            robots_max: arguments.robots,
            first_seed: arguments.seed,
            seconds: seconds.as_secs_f64(),
            reproduce: failures.map(|f| fuzz.reproduce(f.seed)).collect(),
        })?;
    } else {
        tell(&totals, seconds)?;
    }
    kept?;
    match totals.violations {
        0 if totals.seeds < arguments.seeds => Err(Failure::Incomplete),
        0 => Ok(()),
        _ => Err(Failure::Wrong),
    }
}

/// Writes what a failed seed did, and the page of it.
fn write(
    folder: &Path,
    fuzz: &Fuzz,
    failure: &crossguard_judge::sim::Failure,
) -> Result<(PathBuf, Files), Failure> {
    let written = write_failure(folder, fuzz, failure);
    let files = written.map_err(Failure::at(folder))?;
    let logs = std::slice::from_ref(&files.log);
    let mut studied = report::study(|| open_logs(logs), report::names(logs), None)?;
    let again = format!("again: {}", fuzz.reproduce(failure.seed));
    studied.findings = vec![failure.finding.to_string(), again];
    let page = files.log.with_extension("html");
    report::write(&page, &studied)?;
    Ok((page, files))
}

/// In which share of the seeds sensors see people. These walk on the street of the demonstrations alone.
fn sensors(arguments: &Arguments) -> Result<f64, Failure> {
    match (&arguments.site, arguments.sensors) {
        (Some(_), Some(share)) if share > 0.0 => Err(Failure::Input(format!(
            "--sensors {share}: people in front of sensors walk on the street of the demonstrations: leave --site or --sensors out"
        ))),
        (Some(_), _) => Ok(0.0),
        (None, share) => Ok(share.unwrap_or(0.5)),
    }
}

/// The plan that is asked for, if one is.
fn planned(arguments: &Arguments) -> Result<Option<Planned>, Failure> {
    let Some(path) = &arguments.plan else {
        return Ok(None);
    };
    let plan = format!("--plan '{}'", path.display());
    let said = match &arguments.site {
        Some(path) => format!("{plan} --site '{}'", path.display()),
        None => plan,
    };
    let site = super::site::or_street(arguments.site.as_deref())?;
    let file = PlanFile::open(path, site).map_err(Failure::input)?;
    if file.followers >= arguments.robots {
        return Err(Failure::Input(format!(
            "--robots {}: plan {} takes a leader and {} followers",
            arguments.robots, file.name, file.followers
        )));
    }
    Ok(Some(Planned {
        plan: file.plan(StationId(0), file.followers),
        arguments: said,
    }))
}

/// Runs the seeds, with a progress bar for people. Ctrl-C ends it with what is known.
fn watched(fuzz: &Fuzz, is_json: bool) -> Totals {
    let interrupted = interrupts();
    let bar = progress(is_json, "{bar:30} {pos}/{len} seeds, {msg}, {eta} to go");
    bar.set_length(fuzz.seeds);
    let totals = fuzz.run(&|totals: &Totals| {
        bar.set_position(totals.seeds);
        bar.set_message(format!("{} violations", totals.violations));
        !interrupted.load(Ordering::Relaxed)
    });
    bar.finish_and_clear();
    totals
}

fn tell_failure(
    fuzz: &Fuzz,
    failure: &crossguard_judge::sim::Failure,
    files: Option<&(PathBuf, Files)>,
) -> Result<(), Failure> {
    print(format_args!("seed {}: {}", failure.seed, failure.finding))?;
    print(format_args!("  again: {}", fuzz.reproduce(failure.seed)))?;
    let Some((page, files)) = files else {
        return Ok(());
    };
    let files = [page, &files.log, &files.pcap];
    let files: Vec<_> = files.map(|file| file.display().to_string()).into();
    print(format_args!("  written: {}", files.join(", ")))
}

fn tell(totals: &Totals, seconds: Duration) -> Result<(), Failure> {
    print(format_args!(
        "{} seeds with {} robots in {:.1} s: {:.1} h of virtual time, {} steps, {} packets.",
        totals.seeds,
        totals.robots,
        seconds.as_secs_f64(),
        Duration::from_secs(totals.virtual_s).as_secs_f64() / 3_600.0,
        totals.steps,
        totals.packets
    ))?;
    print(format_args!(
        "Runs in which a property had something to say: {}.\nRuns with each hazard: {}.\n\
         Runs whose faults leave a property open: {}.",
        runs(&totals.premises),
        runs(&totals.hazards),
        runs(&totals.left_out)
    ))?;
    print("Longest times, and what the timers of that run allow:")?;
    for measure in Measure::ALL {
        let (id, name) = (measure.property(), measure.name());
        match totals.worst.of(measure) {
            None => print(format_args!("  {id:>3} {name}: never measured"))?,
            Some(Longest { ms, bound_ms }) => {
                print(format_args!(
                    "  {id:>3} {name}: {ms} ms (at most {bound_ms})"
                ))?;
            }
        }
    }
    for (when, people) in ["while there were faults", "after that"]
        .iter()
        .zip(&totals.people)
    {
        let seconds = |share| people.quantile_ms(share).map(|ms| f64::from(ms) / 1_000.0);
        if let (Some(median), Some(longest)) = (seconds(0.5), seconds(1.0)) {
            print(format_args!(
                "People seen by sensors who came {when}: {} crossed, after {median:.1} s at the kerb in the median and {longest:.1} s \
                 at most; {} did not.",
                people.waited_ms.len(),
                people.left
            ))?;
        }
    }
    print(format_args!("Violations: {}.", totals.violations))
}

fn runs<K: Display>(of: &BTreeMap<K, u64>) -> String {
    let of: Vec<_> = of.iter().map(|(it, runs)| format!("{it} {runs}")).collect();
    of.join(", ")
}
