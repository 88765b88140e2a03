//! Coverage, channel load and odds as plots.

mod figures;

pub use figures::{NoNumbers, Numbered};

use super::shell::{Asset, Refusal, Skip, View};
use super::walks::json;

const FILES: [Asset; 3] = [
    ("numbers.css", include_str!("numbers/numbers.css")),
    ("numbers.js", include_str!("numbers/numbers.js")),
    ("plot.js", include_str!("numbers/plot.js")),
];

/// The view of numbers from files.
pub(super) struct Numbers(Vec<Numbered>);

impl Numbers {
    pub(super) const fn new(files: Vec<Numbered>) -> Self {
        Self(files)
    }
}

impl View for Numbers {
    fn name(&self) -> &'static str {
        "numbers"
    }

    fn title(&self) -> &'static str {
        "Numbers"
    }

    fn about(&self) -> &'static str {
        "Coverage, channel load and odds under loss as plots, with what the paper says beside them."
    }

    fn wants(&self) -> Option<&'static str> {
        let wants = "crossguard odds --json > odds.json && crossguard studio --numbers odds.json";
        self.0.is_empty().then_some(wants)
    }

    fn skip(&self) -> Skip {
        Skip {
            to: "figures",
            words: "Skip to the figures",
        }
    }

    fn content(&self) -> &'static str {
        include_str!("numbers/content.html")
    }

    fn shared_style(&self) -> Option<&'static str> {
        None
    }

    fn files(&self) -> &'static [Asset] {
        &FILES
    }

    fn ask(&self, what: &str, _query: &str, _body: &str) -> Result<String, Refusal> {
        match what {
            "figures" => json(&self.0),
            _ => Err(Refusal::Unknown),
        }
    }
}
