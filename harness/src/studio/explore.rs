//! Counterexamples and scenarios, step by step.

use std::sync::OnceLock;

use crossguard_model_check::paper;
use crossguard_model_check::replay::Replay;
use crossguard_model_check::walk;
use serde::Serialize;

use super::shell::{Page, Refusal, Skip, View, json};

static PAGE: Page = Page {
    name: "explore",
    title: "Explore",
    about: "Scenarios and counterexamples step by step: of the paper's wording, of the kit, and from files.",
    skip: Skip {
        to: "steps-title",
        words: "Skip to the steps",
    },
    content: include_str!("explore/content.html"),
    shared_style: Some("walk.css"),
    files: &[
        ("explore.css", include_str!("explore/explore.css")),
        ("explore.js", include_str!("explore/explore.js")),
    ],
};

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
    fn page(&self) -> &'static Page {
        &PAGE
    }

    fn fixed(&self) -> &'static [&'static str] {
        &["given", "scenarios", "properties", "paper"]
    }

    fn ask(&self, what: &str, _query: &str, body: &[u8]) -> Result<String, Refusal> {
        match what {
            "given" => json(&self.given),
            "paper" => Ok(self
                .paper
                .get_or_init(|| serde_json::to_string(&paper::runs()).unwrap_or_default())
                .clone()),
            _ => walk::ask(what, &String::from_utf8_lossy(body)),
        }
    }
}
