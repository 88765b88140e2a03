//! `crossguard check`.

#[cfg(feature = "full")]
mod workers;

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::Duration;

use comfy_table::Table;
use comfy_table::presets::NOTHING;
use crossguard_model_check::check::{CheckProgress, Options, Stop};
use crossguard_model_check::crossing::SHIPPED;
use crossguard_model_check::paper;
use crossguard_model_check::replay::Replay;
use crossguard_model_check::report::{CheckVerdict, PropertyReport, ScenarioReport};
use crossguard_model_check::scenario::Scenario;
use crossguard_model_check::subject::Subject;
use crossguard_model_check::timed::Figure;
use crossguard_robot::files;
use indicatif::{HumanCount, ProgressBar};
use serde::Serialize;

use super::interrupts::stop_when_told;
use super::ranges::{at_least_one, threads, whole};
use super::{Failure, destinations, print, print_json, progress};

#[derive(clap::Args)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is a flag of the command"
)]
pub(super) struct Arguments {
    /// Shipped scenarios by name, or files; the quick ones of the shipped if none is named.
    /// 'paper-literal' is the paper's text as it stands, which must fail.
    #[arg(value_name = "SCENARIO|FILE")]
    scenarios: Vec<String>,
    /// Check all shipped scenarios, also the long ones, which take minutes.
    #[arg(long, conflicts_with = "scenarios")]
    all: bool,
    /// Check the large ones of the shipped scenarios instead, with as many workers as there are processors unless --workers
    /// says otherwise. Takes two hours on two cores and 15 GB. States and steps are judged, and no runs.
    #[arg(long, conflicts_with_all = ["scenarios", "all", "threads"])]
    large: bool,
    /// List the shipped scenarios and check nothing.
    #[arg(long)]
    list: bool,
    /// Threads to explore with; as many as there are processors by default.
    #[arg(long, value_name = "N", value_parser = threads)]
    threads: Option<NonZeroUsize>,
    /// Give up a scenario after this many states; its verdict is then 'incomplete'.
    #[arg(long, value_name = "N", value_parser = at_least_one(1 << 40))]
    max_states: Option<NonZeroUsize>,
    /// Give up a scenario after this many seconds; its verdict is then 'incomplete'.
    #[arg(long, value_name = "SECONDS", value_parser = whole::<u32>(0..=u32::MAX.into()))]
    timeout: Option<u32>,
    /// Let stateright explore each scenario too, as a second opinion: where it differs in states or verdicts,
    /// the verdict is 'incomplete'. Takes about twice the time. Timed scenarios have none.
    #[arg(long)]
    second_opinion: bool,
    /// Judge states and steps alone: a state takes a third of the memory, and nothing is said of runs (reset,
    /// what leads to what).
    #[arg(long)]
    safety: bool,
    /// Write each counterexample to this folder: as a chart in text and Mermaid, and as JSON for 'crossguard studio
    /// --replay'.
    #[arg(long, value_name = "FOLDER")]
    charts: Option<PathBuf>,
    /// Say what each verdict rests on: what is assumed of the robots, of the channel, and of each message's sender.
    #[arg(short, long)]
    verbose: bool,
    /// Explore with this number of workers, each with the states of its share of fingerprints: 15 bytes per state, and
    /// no graph of them. Properties that need the graph (L) are not judged, and named.
    #[arg(long, value_name = "N", value_parser = threads,
        conflicts_with_all = ["all", "threads"])]
    workers: Option<NonZeroUsize>,
    /// Print the results as JSON, and nothing else.
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct CheckReport<R> {
    scenarios: Vec<R>,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    if arguments.list {
        return list();
    }
    if arguments.large || arguments.workers.is_some() {
        #[cfg(feature = "full")]
        return workers::run(arguments);
        #[cfg(not(feature = "full"))]
        return Err(super::small::build_all());
    }
    let names: Vec<&str> = if !arguments.scenarios.is_empty() {
        arguments.scenarios.iter().map(String::as_str).collect()
    } else if arguments.all {
        Subject::shipped().collect()
    } else {
        Scenario::quick().collect()
    };
    // All are read before any is checked: a mistake in the last one should not cost the time of the
    // others.
    let scenarios = names.into_iter().map(subject);
    let scenarios = scenarios.collect::<Result<Vec<_>, _>>()?;
    destinations::folders([&arguments.charts])?;
    let stop = stop_when_told();
    let mut report = CheckReport {
        scenarios: Vec::new(),
    };
    let (wanted, mut written) = (scenarios.len(), Ok(()));
    for subject in scenarios {
        if stop.is_requested() {
            break;
        }
        let checked = check_one(arguments, &stop, subject);
        // Where charts cannot be written, the verdicts are told all the same.
        if let Some(folder) = &arguments.charts {
            written = written.and(write_charts(&checked, folder));
        }
        if !arguments.json {
            print_report(&checked, arguments.verbose)?;
        }
        report.scenarios.push(checked);
    }
    let is_all = report.scenarios.len() == wanted;
    if arguments.json {
        print_json(&report)?;
    } else {
        summarize(&report)?;
    }
    if !is_all && !arguments.json {
        let begun = report.scenarios.len();
        print(format_args!(
            "Stopped before it was done: {begun} of {wanted} scenarios were begun."
        ))?;
    }
    written?;
    outcome(report.scenarios.iter())?;
    if is_all {
        Ok(())
    } else {
        Err(Failure::Incomplete)
    }
}

/// Whether all of these hold, and were exhausted.
fn outcome<'a>(
    mut reports: impl Iterator<Item = &'a ScenarioReport> + Clone,
) -> Result<(), Failure> {
    if reports.clone().any(Subject::is_wrong) {
        Err(Failure::Wrong)
    } else if reports.any(|report| !report.exhaustive) {
        Err(Failure::Incomplete)
    } else {
        Ok(())
    }
}

/// The subject of this name, or the scenario in the file of this name.
fn subject(name: &str) -> Result<Subject, Failure> {
    let read = |path: &Path| files::text(path, files::TEXT_MAX);
    Subject::load(name, read).map_err(Failure::input)
}

fn list() -> Result<(), Failure> {
    let row = |name: &str, summary: &str| print(format_args!("{name:<19} {summary}"));
    let rows = |names: &mut dyn Iterator<Item = &'static str>| {
        for name in names {
            row(name, &Scenario::load(name).map_err(Failure::input)?.summary)?;
        }
        Ok(())
    };
    rows(&mut Scenario::shipped())?;
    for street in SHIPPED {
        row(street.name, street.summary)?;
    }
    row(paper::NAME, paper::SUMMARY)?;
    print("\nLarge ones, for --large or --workers:")?;
    rows(&mut Scenario::large())
}

fn options(arguments: &Arguments, stop: &Stop) -> Options {
    let defaults = Options::default();
    Options {
        threads: arguments.threads.unwrap_or(defaults.threads),
        states_max: arguments.max_states.map(NonZeroUsize::get),
        time_max: arguments
            .timeout
            .map(|seconds| Duration::from_secs(seconds.into())),
        stop: stop.clone(),
        second_opinion: arguments.second_opinion,
        safety_only: arguments.safety,
        ..defaults
    }
}

fn check_one(arguments: &Arguments, stop: &Stop, subject: Subject) -> ScenarioReport {
    let options = options(arguments, stop);
    let Subject::Scenario(scenario) = &subject else {
        return subject.check(&options, &mut |_| ());
    };
    let bar = progress_bar(arguments.json, scenario);
    let report = subject.check(&options, &mut |progress| show(&bar, progress));
    bar.finish_and_clear();
    report
}

fn write_charts(report: &ScenarioReport, folder: &Path) -> Result<(), Failure> {
    for property in &report.properties {
        let Some(chart) = report.chart(property) else {
            continue;
        };
        let name = format!("{}-{}", report.name, property.id);
        let mut forms = vec![("txt", chart.text()), ("mmd", chart.mermaid())];
        // A run that is none of the protocol cannot be followed.
        if !paper::made(report)
            && let Some(replay) = Replay::of(report, property)
        {
            let json = serde_json::to_string_pretty(&replay).map_err(Failure::input)?;
            forms.push(("json", json));
        }
        for (extension, text) in forms {
            let path = folder.join(format!("{name}.{extension}"));
            std::fs::create_dir_all(folder)
                .and_then(|()| std::fs::write(&path, text))
                .map_err(Failure::at(&path))?;
        }
    }
    Ok(())
}

fn progress_bar(is_json: bool, scenario: &Scenario) -> ProgressBar {
    let template = if scenario.expected.is_some() {
        "{msg} {elapsed} [{bar:30}] {human_pos} of {human_len} states, {per_sec}, {eta} to go, {prefix}"
    } else {
        "{msg} {elapsed} {spinner} {human_pos} states, {per_sec}, {prefix}"
    };
    progress(is_json, template).with_message(scenario.name.clone())
}

fn show(bar: &ProgressBar, progress: CheckProgress) {
    if let Some(expected) = progress.expected {
        bar.set_length(expected as u64);
    }
    // With a second opinion, each of the two explorations is half of the check.
    bar.set_position(progress.checked.midpoint(progress.explored) as u64);
    bar.set_prefix(format!(
        "frontier {}, depth {}",
        HumanCount(progress.frontier as u64),
        progress.depth
    ));
}

fn print_report(report: &ScenarioReport, verbose: bool) -> Result<(), Failure> {
    print(format_args!("{}: {}", report.name, report.summary))?;
    print(format_args!(
        "  {} states, {} transitions, depth {}, {:.1} s, {}",
        HumanCount(report.unique_states as u64),
        HumanCount(report.transitions as u64),
        report.depth,
        report.seconds,
        match report.cut_off {
            None => "exhaustive".to_owned(),
            Some(why) => format!("NOT exhaustive: {}", words(&format!("{why:?}"))),
        }
    ))?;
    print(format_args!("  judged by {}", report.engines.join(" and ")))?;
    if report.size_as_expected == Some(false) {
        print("  The scenario's file expects a state space of another size.")?;
    }
    let mut table = Table::new();
    table.load_style(NOTHING);
    let premise = |id: &str| report.verdict(&format!("{id}-premise"));
    for property in report
        .properties
        .iter()
        .filter(|property| property.kind != "premise")
    {
        let premise = match premise(&property.id) {
            Some(CheckVerdict::Unreachable) => "premise never met!",
            Some(CheckVerdict::Incomplete) => "premise not met yet",
            _ => "",
        };
        table.add_row([
            &property.id,
            verdict(report, property.verdict),
            &property.statement,
            premise,
        ]);
    }
    for line in table.lines() {
        print(format_args!("  {}", line.trim_end()))?;
    }
    print_figures(&report.figures)?;
    for property in &report.properties {
        print_counterexample(report, property)?;
    }
    if !verbose {
        let count = report.assumptions.len();
        return print(format_args!(
            "  under {count} assumptions, which -v lists\n"
        ));
    }
    print_authentication(report)?;
    print("  assuming:")?;
    for assumption in &report.assumptions {
        print(format_args!("  - {assumption}"))?;
    }
    print("")
}

/// Prints the properties' assumptions on senders: properties that assume the same in one line.
fn print_authentication(report: &ScenarioReport) -> Result<(), Failure> {
    let mut groups: Vec<(&str, Vec<&str>)> = Vec::new();
    for property in &report.properties {
        let Some(assumed) = &property.authentication else {
            continue;
        };
        match groups.iter_mut().find(|(known, _)| known == assumed) {
            Some((_, ids)) => ids.push(&property.id),
            None => groups.push((assumed, vec![&property.id])),
        }
    }
    if groups.is_empty() {
        return Ok(());
    }
    print("  authentication that is assumed:")?;
    for (assumed, ids) in groups {
        print(format_args!("  - {}: {assumed}", ids.join(", ")))?;
    }
    Ok(())
}

fn print_figures(figures: &[Figure]) -> Result<(), Failure> {
    if figures.is_empty() {
        return Ok(());
    }
    print("  longest times:")?;
    for figure in figures {
        let found = figure
            .ms
            .map_or_else(|| "none".to_owned(), |ms| format!("{ms} ms"));
        print(format_args!(
            "  {:<8} {:<54} {found:>7}, by calculation at most {} ms",
            figure.id, figure.name, figure.bound_ms
        ))?;
    }
    Ok(())
}

fn verdict(report: &ScenarioReport, verdict: CheckVerdict) -> &'static str {
    match verdict {
        CheckVerdict::Violated if paper::fails_as_it_must(report) => "violated, as it must be",
        CheckVerdict::Holds => "holds",
        CheckVerdict::Reachable => "reachable",
        CheckVerdict::Violated => "VIOLATED",
        CheckVerdict::Unreachable => "unreachable",
        CheckVerdict::Incomplete => "incomplete",
    }
}

fn print_counterexample(report: &ScenarioReport, property: &PropertyReport) -> Result<(), Failure> {
    let Some(chart) = report.chart(property) else {
        return Ok(());
    };
    print(format_args!("  {} is broken by:", property.id))?;
    for line in chart.text().lines() {
        print(format_args!("  {line}"))?;
    }
    Ok(())
}

/// `StateLimit` as `state limit`.
fn words(name: &str) -> String {
    let mut words = String::new();
    for c in name.chars() {
        if c.is_ascii_uppercase() && !words.is_empty() {
            words.push(' ');
        }
        words.push(c.to_ascii_lowercase());
    }
    words
}

fn summarize(report: &CheckReport<ScenarioReport>) -> Result<(), Failure> {
    let (literal, scenarios): (Vec<_>, Vec<_>) =
        report.scenarios.iter().partition(|r| paper::made(r));
    for literal in literal {
        let how = if Subject::is_wrong(literal) {
            "does not fail as it must"
        } else {
            "fails as it must"
        };
        print(format_args!("{} {how}.", literal.name))?;
    }
    if scenarios.is_empty() {
        return Ok(());
    }
    let verified = scenarios
        .iter()
        .filter(|r| r.exhaustive && !r.failed())
        .count();
    let states: usize = scenarios.iter().map(|r| r.unique_states).sum();
    print(format_args!(
        "{verified} of {} scenarios verified exhaustively, {} states in all.",
        scenarios.len(),
        HumanCount(states as u64)
    ))?;
    print(if scenarios.iter().any(|report| report.failed()) {
        "Next: --charts FOLDER keeps what breaks a property; `crossguard studio --replay FILE` walks along it."
    } else {
        "Next: `crossguard check paper-literal` shows where the paper's own wording fails; `crossguard studio`\n\
         plays a scenario step by step."
    })
}
