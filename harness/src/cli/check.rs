//! `crossguard check`.

use std::num::NonZeroUsize;
use std::time::Duration;

use comfy_table::Table;
use comfy_table::presets::NOTHING;
use crossguard_model_check::check::{Options, Progress, check};
use crossguard_model_check::model::Model;
use crossguard_model_check::report::{PropertyReport, ScenarioReport, Verdict};
use crossguard_model_check::scenario::Scenario;
use crossguard_model_check::timed::{self, Figure};
use indicatif::{HumanCount, ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde::Serialize;

use super::{Failure, print, print_json, shows_progress};

#[derive(clap::Args)]
pub(super) struct Arguments {
    /// Shipped scenarios by name, or files; all shipped ones if none is named.
    #[arg(value_name = "SCENARIO|FILE")]
    scenarios: Vec<String>,
    /// List the shipped scenarios and check nothing.
    #[arg(long)]
    list: bool,
    /// Threads to explore with; as many as there are processors by default.
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,
    /// Give up a scenario after this many states; its verdict is then 'incomplete'.
    #[arg(long, value_name = "N")]
    max_states: Option<NonZeroUsize>,
    /// Give up a scenario after this many seconds; its verdict is then 'incomplete'.
    #[arg(long, value_name = "SECONDS")]
    timeout: Option<u32>,
    /// Print the results as JSON, and nothing else.
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Report {
    scenarios: Vec<ScenarioReport>,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    if arguments.list {
        return list();
    }
    let names: Vec<&str> = if arguments.scenarios.is_empty() {
        Scenario::shipped().collect()
    } else {
        arguments.scenarios.iter().map(String::as_str).collect()
    };
    // All are read before any is checked: a mistake in the last one should not cost the time of the
    // others.
    let scenarios = names
        .into_iter()
        .map(Scenario::load)
        .collect::<Result<Vec<_>, _>>();
    let mut report = Report {
        scenarios: Vec::new(),
    };
    for scenario in scenarios.map_err(Failure::input)? {
        let checked = check_one(arguments, scenario);
        if !arguments.json {
            print_report(&checked)?;
        }
        report.scenarios.push(checked);
    }
    if arguments.json {
        print_json(&report)?;
    } else {
        summarize(&report)?;
    }
    if report.scenarios.iter().any(ScenarioReport::failed) {
        Err(Failure::Wrong)
    } else if report.scenarios.iter().any(|scenario| !scenario.exhaustive) {
        Err(Failure::Incomplete)
    } else {
        Ok(())
    }
}

fn list() -> Result<(), Failure> {
    for name in Scenario::shipped() {
        let scenario = Scenario::load(name).map_err(Failure::input)?;
        print(format_args!("{name:<14} {}", scenario.summary))?;
    }
    Ok(())
}

fn check_one(arguments: &Arguments, scenario: Scenario) -> ScenarioReport {
    let defaults = Options::default();
    let options = Options {
        threads: arguments.threads.unwrap_or(defaults.threads),
        states_max: arguments.max_states.map(NonZeroUsize::get),
        time_max: arguments
            .timeout
            .map(|seconds| Duration::from_secs(seconds.into())),
        ..defaults
    };
    let bar = progress_bar(arguments.json, &scenario);
    let mut watch = |progress| show(&bar, progress);
    let report = match timed::Model::new(scenario.clone()) {
        Some(model) => timed::check(&model, &options, &mut watch),
        None => check(&Model::new(scenario), &options, &mut watch),
    };
    bar.finish_and_clear();
    report
}

fn progress_bar(is_json: bool, scenario: &Scenario) -> ProgressBar {
    let bar = ProgressBar::no_length().with_message(scenario.name.clone());
    if !shows_progress(is_json) {
        bar.set_draw_target(ProgressDrawTarget::hidden());
    }
    let template = if scenario.expected.is_some() {
        "{msg} {elapsed} [{bar:30}] {human_pos} of {human_len} states, {per_sec}, {prefix}"
    } else {
        "{msg} {elapsed} {spinner} {human_pos} states, {per_sec}, {prefix}"
    };
    let style = ProgressStyle::with_template(template).expect("the template is well-formed");
    bar.with_style(style)
}

fn show(bar: &ProgressBar, progress: Progress) {
    if let Some(expected) = progress.expected {
        bar.set_length(expected as u64);
    }
    // The slower of the two explorations says how far the check is.
    bar.set_position(progress.checked.min(progress.explored) as u64);
    bar.set_prefix(format!("depth {}", progress.depth));
}

fn print_report(report: &ScenarioReport) -> Result<(), Failure> {
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
            Some(Verdict::Unreachable) => "premise never met!",
            Some(Verdict::Incomplete) => "premise not met yet",
            _ => "",
        };
        table.add_row([
            &property.id,
            verdict(property.verdict),
            &property.statement,
            premise,
        ]);
    }
    for line in table.lines() {
        print(format_args!("  {}", line.trim_end()))?;
    }
    print_figures(&report.figures)?;
    for property in &report.properties {
        print_counterexample(property)?;
    }
    print("  assuming:")?;
    for assumption in &report.assumptions {
        print(format_args!("  - {assumption}"))?;
    }
    print("")
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
            "  {:<54} {found:>7}, by calculation at most {} ms",
            figure.name, figure.bound_ms
        ))?;
    }
    Ok(())
}

const fn verdict(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Holds => "holds",
        Verdict::Reachable => "reachable",
        Verdict::Violated => "VIOLATED",
        Verdict::Unreachable => "unreachable",
        Verdict::Incomplete => "incomplete",
    }
}

fn print_counterexample(property: &PropertyReport) -> Result<(), Failure> {
    if property.counterexample.is_empty() {
        return Ok(());
    }
    print(format_args!("  {} is broken by:", property.id))?;
    for (i, step) in property.counterexample.iter().enumerate() {
        print(format_args!("  {:>4}. {}", i + 1, step.action))?;
        for output in &step.outputs {
            print(format_args!("          {output}"))?;
        }
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

fn summarize(report: &Report) -> Result<(), Failure> {
    let scenarios = report.scenarios.len();
    let verified = report
        .scenarios
        .iter()
        .filter(|r| r.exhaustive && !r.failed())
        .count();
    let states: usize = report.scenarios.iter().map(|r| r.unique_states).sum();
    print(format_args!(
        "{verified} of {scenarios} scenarios verified exhaustively, {} states in all.",
        HumanCount(states as u64)
    ))
}
