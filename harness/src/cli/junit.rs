//! Results as XML of `JUnit`, which CI systems show.

use std::path::{Path, PathBuf};
use std::time::Duration;

use crossguard_model_check::report::{CheckVerdict, PropertyReport, ScenarioReport};
use crossguard_model_check::{paper, subject::Subject};
use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};

use super::{Failure, destinations};

const HELP: &str = "Write the results to this file as JUnit's XML too, for CI systems";

/// Where results go.
#[derive(clap::Args)]
pub(super) struct JunitArguments {
    #[arg(long, value_name = "FILE", help = HELP)]
    junit: Option<PathBuf>,
}

impl JunitArguments {
    /// Whether the file can be written.
    pub(super) fn check(&self) -> Result<(), Failure> {
        destinations::files([&self.junit])
    }

    /// Writes these suites, if somebody wants them.
    pub(super) fn write(
        &self,
        command: &str,
        suites: impl IntoIterator<Item = TestSuite>,
    ) -> Result<(), Failure> {
        match &self.junit {
            Some(path) => write(path, command, suites),
            None => Ok(()),
        }
    }
}

fn write(
    path: &Path,
    command: &str,
    suites: impl IntoIterator<Item = TestSuite>,
) -> Result<(), Failure> {
    let mut report = Report::new(format!("crossguard {command}"));
    report.add_test_suites(suites);
    let text = report.to_string().map_err(Failure::input)?;
    std::fs::write(path, text)
        .map_err(|error| Failure::Input(format!("{}: {error}", path.display())))
}

/// How a case ended.
pub(super) enum Ending {
    /// Well.
    Well,
    /// Something was found to be wrong: what, and at length.
    Wrong(String, String),
    /// It was cut off before it could tell.
    Incomplete(String),
    /// It was not tried, and why.
    Skipped(String),
}

/// A case of a suite.
pub(super) fn case(suite: &mut TestSuite, name: &str, ending: Ending) {
    let status = match ending {
        Ending::Well => TestCaseStatus::success(),
        Ending::Wrong(what, at_length) => {
            let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
            status.set_message(what).set_description(at_length);
            status
        }
        Ending::Incomplete(what) => {
            let mut status = TestCaseStatus::non_success(NonSuccessKind::Error);
            status.set_message(what);
            status
        }
        Ending::Skipped(why) => {
            let mut status = TestCaseStatus::skipped();
            status.set_message(why);
            status
        }
    };
    let mut case = TestCase::new(name, status);
    case.set_classname(suite.name.as_str());
    suite.add_test_case(case);
}

/// A scenario that was checked: a case for each property.
pub(super) fn scenario(report: &ScenarioReport) -> TestSuite {
    let mut suite = TestSuite::new(report.name.as_str());
    suite.set_time(Duration::try_from_secs_f64(report.seconds).unwrap_or_default());
    if paper::made(report) {
        let ending = if Subject::is_wrong(report) {
            let what = "the paper's text does not fail as it must";
            Ending::Wrong(what.to_owned(), report.summary.clone())
        } else {
            Ending::Well
        };
        case(&mut suite, "fails as it must", ending);
        return suite;
    }
    for property in report.properties.iter().filter(|it| it.kind != "premise") {
        case(&mut suite, &property.id, ending(report, property));
    }
    if report.size_as_expected == Some(false) {
        let what = "the scenario's file expects a state space of another size";
        let states = format!("{} states, depth {}", report.unique_states, report.depth);
        let ending = Ending::Wrong(what.to_owned(), states);
        case(&mut suite, "size of the state space", ending);
    }
    suite
}

fn ending(report: &ScenarioReport, property: &PropertyReport) -> Ending {
    let premise = report.verdict(&format!("{}-premise", property.id));
    match property.verdict {
        CheckVerdict::Violated | CheckVerdict::Unreachable => {
            let chart = report.chart(property);
            let chart = chart.map_or_else(String::new, |chart| chart.text());
            Ending::Wrong(property.statement.clone(), chart)
        }
        CheckVerdict::Incomplete => {
            Ending::Incomplete("the check was cut off before the answer was known".to_owned())
        }
        _ if premise == Some(CheckVerdict::Unreachable) => {
            let what = "its premise is never met, so the scenario says nothing about it";
            Ending::Wrong(what.to_owned(), property.statement.clone())
        }
        _ => Ending::Well,
    }
}
