//! Subjects that can be checked by name: scenarios, untimed and timed, streets, and the paper's text.

use std::path::Path;

use crate::check::check;
use crate::crossing::{SHIPPED, Shipped};
use crate::exploration::{CheckProgress, Options};
use crate::model::Model;
use crate::paper;
use crate::report::ScenarioReport;
use crate::scenario::{Scenario, ScenarioError};
use crate::timed;

/// Subject of a check.
#[derive(Clone, Debug)]
pub enum Subject {
    /// A scenario.
    Scenario(Box<Scenario>),
    /// The crossing machine on a street.
    Street(Shipped),
    /// The paper's text as it stands, which must fail.
    PaperLiteral,
}

impl Subject {
    /// The names of the shipped subjects; quick scenarios first.
    pub fn shipped() -> impl Iterator<Item = &'static str> {
        let streets = SHIPPED.iter().map(|street| street.name);
        Scenario::shipped().chain(streets).chain([paper::NAME])
    }

    /// The one of this name, or the scenario in the file of this name, which `read` reads.
    ///
    /// # Errors
    /// Every way in which there is no usable scenario of that name.
    pub fn load(
        name: &str,
        read: impl FnOnce(&Path) -> std::io::Result<String>,
    ) -> Result<Self, ScenarioError> {
        if name == paper::NAME {
            return Ok(Self::PaperLiteral);
        }
        if let Some(street) = Shipped::of(name) {
            return Ok(Self::Street(street));
        }
        let path = Path::new(name);
        let scenario = match Scenario::load(name) {
            Err(ScenarioError::Unknown { .. }) if path.exists() || path.extension().is_some() => {
                let text = read(path).map_err(|cause| ScenarioError::Unreadable {
                    path: path.to_owned(),
                    cause,
                })?;
                Scenario::parse(name, &text)?
            }
            loaded => loaded?,
        };
        Ok(Self::Scenario(Box::new(scenario)))
    }

    /// Checks it. `watch` receives the progress now and then; never of the paper's text, which is small.
    pub fn check(self, options: &Options, watch: &mut dyn FnMut(CheckProgress)) -> ScenarioReport {
        match self {
            Self::PaperLiteral => paper::check(),
            Self::Street(street) => street.check(options, watch),
            Self::Scenario(scenario) => match timed::TimedModel::new((*scenario).clone()) {
                Some(model) => timed::check(&model, options, watch),
                None => check(&Model::new(*scenario), options, watch),
            },
        }
    }

    /// Whether a report says that something was found that should not be; the paper's text must fail, and
    /// in full.
    #[must_use]
    pub fn is_wrong(report: &ScenarioReport) -> bool {
        if paper::made(report) {
            !paper::fails_as_it_must(report)
        } else {
            report.failed()
        }
    }
}
