//! The protocol to play with: whatever may happen next is done by a click or a key.

use super::shell::{Asset, Refusal, View};
use super::walks;

const FILES: [Asset; 4] = [
    ("index.html", include_str!("play/index.html")),
    ("play.css", include_str!("play/play.css")),
    ("play.js", include_str!("play/play.js")),
    ("setup.js", include_str!("play/setup.js")),
];

/// The view of the protocol at work.
pub(super) struct Play;

impl View for Play {
    fn name(&self) -> &'static str {
        "play"
    }

    fn title(&self) -> &'static str {
        "Play"
    }

    fn about(&self) -> &'static str {
        "The protocol at work: put robots on a street, lose, delay and repeat messages, crash and hang robots, and take it back."
    }

    fn wants(&self) -> Option<&'static str> {
        None
    }

    fn files(&self) -> &'static [Asset] {
        &FILES
    }

    fn ask(&self, what: &str, _query: &str, body: &str) -> Result<String, Refusal> {
        walks::ask(what, body)
    }
}
