//! The protocol to play with: whatever may happen next is done by a click or a key.

use super::shell::{Asset, Refusal, Skip, View};
use super::walks;

const FILES: [Asset; 3] = [
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

    fn skip(&self) -> Skip {
        Skip {
            to: "air-title",
            words: "Skip to what may happen",
        }
    }

    fn content(&self) -> &'static str {
        include_str!("play/content.html")
    }

    fn shared_style(&self) -> Option<&'static str> {
        Some("walk.css")
    }

    fn files(&self) -> &'static [Asset] {
        &FILES
    }

    fn ask(&self, what: &str, _query: &str, body: &str) -> Result<String, Refusal> {
        walks::ask(what, body)
    }
}
