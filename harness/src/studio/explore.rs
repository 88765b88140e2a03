//! Counterexamples and scenarios, step by step.

use std::sync::OnceLock;

use crossguard_model_check::paper;
use crossguard_model_check::replay::Replay;
use serde::Serialize;

use super::shell::{Asset, Refusal, Skip, View};
use super::walks::{self, json};

const FILES: [Asset; 2] = [
    ("explore.css", include_str!("explore/explore.css")),
    ("explore.js", include_str!("explore/explore.js")),
];

/// A run in a file.
#[derive(Clone, Debug, Serialize)]
pub struct GivenRun {
    /// The name of the file.
    pub file: String,
    /// The run, with the text of its scenario.
    pub run: Replay,
}

/// The view of runs through scenarios.
pub(super) struct Explore {
    given: Vec<GivenRun>,
    /// The runs of the paper's wording; found when they are first asked for.
    paper: OnceLock<String>,
}

impl Explore {
    pub(super) const fn new(given: Vec<GivenRun>) -> Self {
        Self {
            given,
            paper: OnceLock::new(),
        }
    }
}

impl View for Explore {
    fn name(&self) -> &'static str {
        "explore"
    }

    fn title(&self) -> &'static str {
        "Explore"
    }

    fn about(&self) -> &'static str {
        "Scenarios and counterexamples step by step: of the paper's wording, of the kit, and from files."
    }

    fn wants(&self) -> Option<&'static str> {
        None
    }

    fn skip(&self) -> Skip {
        Skip {
            to: "steps-title",
            words: "Skip to the steps",
        }
    }

    fn content(&self) -> &'static str {
        include_str!("explore/content.html")
    }

    fn shared_style(&self) -> Option<&'static str> {
        Some("walk.css")
    }

    fn files(&self) -> &'static [Asset] {
        &FILES
    }

    fn ask(&self, what: &str, _query: &str, body: &str) -> Result<String, Refusal> {
        match what {
            "given" => json(&self.given),
            "paper" => Ok(self
                .paper
                .get_or_init(|| serde_json::to_string(&paper::runs()).unwrap_or_default())
                .clone()),
            _ => walks::ask(what, body),
        }
    }
}
