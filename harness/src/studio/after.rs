//! A run after it happened: what its logs say, with what validation says of them.

use crossguard_judge::playback::{Overview, Playback, SavedRun, Stretch};
use crossguard_judge::validate::{Invalid, Validated};
use crossguard_judge::verdict::{self, PropertyVerdict};
use serde::Serialize;

use super::shell::{self, Page, Refusal, Skip, View, value};

static PAGE: Page = Page {
    name: "after",
    title: "After",
    about: "A run after it happened: robots, people and messages in time, what validation says, and times beside the paper's.",
    skip: Skip {
        to: "messages-title",
        words: "Skip to the messages",
    },
    content: include_str!("after/content.html"),
    shared_style: Some("run.css"),
    files: &[
        ("after.css", include_str!("after/after.css")),
        ("after.js", include_str!("after/after.js")),
        ("player.js", include_str!("after/player.js")),
        ("source.js", include_str!("after/source.js")),
        ("timeline.js", include_str!("after/timeline.js")),
    ],
};

/// A run, and what is said of it.
pub struct Studied {
    /// The run.
    pub playback: Playback,
    /// The names of its logs.
    pub logs: Vec<String>,
    /// What validation says of them.
    pub validated: Result<Validated, Invalid>,
    /// When the first record that does not fit was written, in µs since 1970, where one does not.
    pub invalid_us: Option<u64>,
    /// What was found to be wrong while it ran.
    pub findings: Vec<String>,
}

/// What the page gets first.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Opening {
    version: &'static str,
    logs: Vec<String>,
    verdict: Verdict,
    overview: Overview,
}

/// What validation says.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Verdict {
    kind: &'static str,
    sentences: Vec<String>,
    /// Where it belongs, in µs since the first record.
    at: Option<u64>,
    robot: Option<String>,
    properties: Vec<PropertyVerdict>,
}

impl Studied {
    fn verdict(&self, overview: &Overview) -> Verdict {
        let validated = self.validated.as_ref();
        let began_us = overview.began_ms.saturating_mul(1_000);
        let (kind, sentences) = match validated {
            Ok(valid) if valid.missing > 0 => ("incomplete", verdict::sentences(valid)),
            Ok(valid) => ("valid", verdict::sentences(valid)),
            Err(invalid) => ("invalid", vec![format!("{invalid}.")]),
        };
        let is_right = self.findings.is_empty();
        let at = self.invalid_us.map(|at_us| at_us.saturating_sub(began_us));
        Verdict {
            kind: if is_right { kind } else { "invalid" },
            sentences: self.findings.iter().cloned().chain(sentences).collect(),
            at: at.map(|at| at.min(overview.lasted)),
            robot: validated.err().and_then(|invalid| invalid.robot.clone()),
            properties: verdict::properties(validated),
        }
    }

    fn opening(&self) -> Opening {
        let overview = self.playback.overview(&self.logs);
        Opening {
            version: env!("CARGO_PKG_VERSION"),
            logs: self.logs.clone(),
            verdict: self.verdict(&overview),
            overview,
        }
    }
}

/// What a saved page has in it.
#[derive(Serialize)]
struct SavedPage {
    opening: Opening,
    run: SavedRun,
}

/// The page of a run as one file: it needs no server and no network.
#[must_use]
pub fn saved(studied: &Studied) -> String {
    let (mut opening, run) = (studied.opening(), studied.playback.saved());
    if run.rows_left_out > 0 {
        let trouble = format!("{} messages and notes are left out", run.rows_left_out);
        opening.overview.troubles.push(trouble);
    }
    let page = serde_json::to_string(&SavedPage { opening, run });
    shell::saved(&After(None), &page.unwrap_or_default())
}

/// The view of a run, if there is one.
pub(super) struct After(Option<(Studied, String)>);

impl After {
    pub(super) fn new(run: Option<Studied>) -> Self {
        Self(run.map(|run| {
            let opening = serde_json::to_string(&run.opening()).unwrap_or_default();
            (run, opening)
        }))
    }
}

impl View for After {
    fn page(&self) -> &'static Page {
        &PAGE
    }

    fn wants(&self) -> Option<&'static str> {
        let wants = "crossguard studio LOG...";
        self.0.is_none().then_some(wants)
    }

    fn ask(&self, what: &str, query: &str, _body: &str) -> Result<String, Refusal> {
        let Some((run, opening)) = &self.0 else {
            let cause = "this studio was given no log: crossguard studio LOG...";
            return Err(Refusal::Wrong(cause.to_owned()));
        };
        match what {
            "opening" => Ok(opening.clone()),
            "moment" => moment(query, &run.playback).ok_or_else(|| {
                let wanted = "at=MICROSECONDS is wanted, and from=, to= and repeats=1 are possible";
                Refusal::Wrong(wanted.to_owned())
            }),
            _ => Err(Refusal::Unknown),
        }
    }
}

fn moment(query: &str, playback: &Playback) -> Option<String> {
    let number = |name: &str| value(query, name).map(str::parse::<u64>).transpose().ok();
    let (from, to) = (number("from")?, number("to")?);
    let span = from.zip(to).map(|(from, to)| Stretch { from, to });
    let repeats = value(query, "repeats") == Some("1");
    let moment = playback.moment(number("at")??, span, repeats);
    serde_json::to_string(&moment).ok()
}
