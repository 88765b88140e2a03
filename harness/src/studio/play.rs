//! The protocol to play with: whatever may happen next is done by a click or a key.

use crossguard_model_check::walk;

use super::shell::{Page, Refusal, Skip, View};

static PAGE: Page = Page {
    name: "play",
    title: "Play",
    about: "The protocol at work: put robots on a street, lose, delay and repeat messages, crash and hang robots, and take it back.",
    skip: Skip {
        to: "air-title",
        words: "Skip to what may happen",
    },
    content: include_str!("play/content.html"),
    shared_style: Some("walk.css"),
    files: &[
        ("guide.js", include_str!("play/guide.js")),
        ("play.css", include_str!("play/play.css")),
        ("play.js", include_str!("play/play.js")),
        ("setup.js", include_str!("play/setup.js")),
    ],
};

/// The view of the protocol at work.
pub(super) struct Play;

impl View for Play {
    fn page(&self) -> &'static Page {
        &PAGE
    }

    fn fixed(&self) -> &'static [&'static str] {
        &["scenarios", "properties"]
    }

    fn ask(&self, what: &str, _query: &str, body: &[u8]) -> Result<String, Refusal> {
        walk::ask(what, &String::from_utf8_lossy(body))
    }
}
