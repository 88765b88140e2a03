//! `crossguard check --workers`.

use std::io::{Write, stderr};
use std::num::NonZeroUsize;

use crossguard_model_check::model::Model;
use crossguard_model_check::scenario::Scenario;
use crossguard_model_check::subject::Subject;
use crossguard_workers::{Options, Progress, WorkersError, WorkersReport, check};
use indicatif::{HumanBytes, HumanCount, HumanFloatCount};

use super::super::interrupts::stop_when_told;
use super::super::{Failure, complain, destinations, print, print_json};
use super::{Arguments, CheckReport};

/// Checks each scenario with workers.
pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let names: Vec<&str> = if arguments.large {
        Scenario::large().collect()
    } else {
        arguments.scenarios.iter().map(String::as_str).collect()
    };
    if names.is_empty() {
        return Err(Failure::input("--workers wants a scenario"));
    }
    let scenarios = names.into_iter().map(scenario);
    let scenarios = scenarios.collect::<Result<Vec<_>, _>>()?;
    destinations::folders([&arguments.charts])?;
    let stop = stop_when_told();
    let limits = super::options(arguments, &stop);
    let by_default = if arguments.large {
        limits.threads
    } else {
        NonZeroUsize::MIN
    };
    let options = Options {
        workers: arguments.workers.unwrap_or(by_default),
        states_max: limits.states_max,
        time_max: limits.time_max,
        stop,
    };
    let mut told = CheckReport {
        scenarios: Vec::new(),
    };
    let mut written = Ok(());
    for scenario in scenarios {
        let name = scenario.name.clone();
        let model = Model::new(scenario);
        let report = check(&model, &options, &mut show_progress(&name)).map_err(refused)?;
        if let Some(folder) = &arguments.charts {
            written = written.and(super::write_charts(&report.scenario, folder));
        }
        if !arguments.json {
            print_report(&report, arguments.verbose)?;
        }
        told.scenarios.push(report);
    }
    if arguments.json {
        print_json(&told)?;
    }
    written?;
    super::outcome(told.scenarios.iter().map(|report| &report.scenario))
}

fn scenario(name: &str) -> Result<Scenario, Failure> {
    match super::subject(name)? {
        Subject::Scenario(scenario) => Ok(*scenario),
        Subject::PaperLiteral | Subject::Street(_) => Err(Failure::input(format!(
            "'{name}' is no scenario, and small: leave --workers out"
        ))),
    }
}

/// Failure for an error: lost work is told as such; the rest is bad input.
fn refused(error: WorkersError) -> Failure {
    match error {
        WorkersError::Lost => {
            complain(error);
            Failure::Incomplete
        }
        WorkersError::NotForWorkers(_) => Failure::input(error),
    }
}

/// Tells on standard error how far they are: each new level, and every ten seconds.
fn show_progress(name: &str) -> impl FnMut(Progress) {
    let (mut level, mut seconds) = (None, 0);
    move |progress: Progress| {
        let now = progress.elapsed.as_secs();
        if level == Some(progress.level) && now < seconds + 10 {
            return;
        }
        (level, seconds) = (Some(progress.level), now);
        #[expect(clippy::cast_precision_loss, reason = "a figure for people")]
        let rate = progress.states as f64 / progress.elapsed.as_secs_f64().max(0.001);
        // Standard error may be gone; the check goes on.
        let _ = writeln!(
            stderr(),
            "{name}: {now} s, level {}, {} states, {} per second, tables of {}",
            progress.level,
            HumanCount(progress.states),
            HumanFloatCount(rate.round()),
            HumanBytes(progress.table_bytes)
        );
    }
}

fn print_report(report: &WorkersReport, verbose: bool) -> Result<(), Failure> {
    super::print_report(&report.scenario, verbose)?;
    if !report.not_judged.is_empty() {
        print(format_args!(
            "  not judged with workers: {}; 'crossguard check {}' judges them",
            report.not_judged.join(", "),
            report.scenario.name
        ))?;
    }
    if report.states_of_classes != report.scenario.unique_states as u64 {
        print(format_args!(
            "  the states stand for {}, which differ from them in which of the symmetric robots is which",
            HumanCount(report.states_of_classes)
        ))?;
    }
    let how = if report.scenario.exhaustive {
        "exhaustive, up to a collision of fingerprints"
    } else {
        "NOT exhaustive, and collisions of fingerprints"
    };
    print(format_args!(
        "  {} workers, tables of {}: {how} with a probability of at most {:.0e}",
        report.workers,
        HumanBytes(report.table_bytes),
        report.omission_probability
    ))
}
