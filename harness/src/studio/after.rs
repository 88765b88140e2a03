//! A run after it happened: what its logs say, with what validation says of them.

use std::sync::{Arc, Mutex, PoisonError};

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
    /// The result of their validation.
    pub validated: Result<Validated, Invalid>,
    /// When the first record that does not fit was written, in µs since 1970, where one does not.
    pub invalid_us: Option<u64>,
    /// Faults that were found while it ran.
    pub findings: Vec<String>,
}

/// Reads and judges logs, each a name and its octets. The error says why they cannot be shown.
pub type Study = dyn Fn(&[(String, &[u8])]) -> Result<Studied, String> + Send + Sync;

/// How many logs a page may send.
const LOGS_MAX: usize = 64;

/// First data of the page.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Opening {
    /// Which of the runs that this server showed, counted from 0.
    run: u64,
    version: &'static str,
    logs: Vec<String>,
    verdict: Verdict,
    overview: Overview,
}

/// Verdict of validation.
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

    fn opening(&self, run: u64) -> Opening {
        let overview = self.playback.overview(&self.logs);
        Opening {
            run,
            version: env!("CARGO_PKG_VERSION"),
            logs: self.logs.clone(),
            verdict: self.verdict(&overview),
            overview,
        }
    }
}

/// Data in a saved page.
#[derive(Serialize)]
struct SavedPage {
    opening: Opening,
    run: SavedRun,
}

/// The page of a run as one file: it needs no server and no network.
#[must_use]
pub fn saved(studied: &Studied) -> String {
    let (mut opening, run) = (studied.opening(0), studied.playback.saved());
    if run.rows_left_out > 0 {
        let trouble = format!("{} messages and notes are left out", run.rows_left_out);
        opening.overview.troubles.push(trouble);
    }
    let page = serde_json::to_string(&SavedPage { opening, run });
    shell::saved(&After::new(None, None), &page.unwrap_or_default())
}

/// The view of a run, if there is one.
pub(super) struct After {
    shown: Mutex<Option<Arc<Shown>>>,
    study: Option<Box<Study>>,
}

/// The run that is shown.
struct Shown {
    number: u64,
    run: Studied,
    opening: String,
}

impl Shown {
    fn new(number: u64, run: Studied) -> Arc<Self> {
        let opening = serde_json::to_string(&run.opening(number)).unwrap_or_default();
        Arc::new(Self {
            number,
            run,
            opening,
        })
    }
}

impl After {
    pub(super) fn new(run: Option<Studied>, study: Option<Box<Study>>) -> Self {
        let shown = Mutex::new(run.map(|run| Shown::new(0, run)));
        Self { shown, study }
    }

    fn shown(&self) -> Option<Arc<Shown>> {
        let shown = self.shown.lock();
        shown.unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Shows the logs in `body` from now on. The answer is that to `opening`.
    fn open(&self, body: &[u8]) -> Result<String, Refusal> {
        let refused = |cause: &str| Refusal::Wrong(cause.to_owned());
        let study = self.study.as_ref().ok_or_else(|| {
            refused("a studio that other machines reach opens no logs: start crossguard studio without --address")
        })?;
        let logs = unpack(body).ok_or_else(|| {
            refused("wanted are 1 to 64 logs: [[NAME, OCTETS], ...] as JSON in a line, and then their contents")
        })?;
        let run = study(&logs).map_err(Refusal::Wrong)?;
        let mut shown = self.shown.lock().unwrap_or_else(PoisonError::into_inner);
        let number = shown.as_ref().map_or(0, |before| before.number + 1);
        let opened = shown.insert(Shown::new(number, run));
        Ok(opened.opening.clone())
    }
}

/// The logs in a body: names and lengths as JSON in its first line, and the contents one after the other. Logs of one name
/// are told apart by their places.
fn unpack(body: &[u8]) -> Option<Vec<(String, &[u8])>> {
    let end = body.iter().position(|octet| *octet == b'\n')?;
    let (heads, mut rest) = body.split_at(end + 1);
    let heads: Vec<(String, usize)> = serde_json::from_slice(heads).ok()?;
    if heads.is_empty() || heads.len() > LOGS_MAX {
        return None;
    }
    let mut logs: Vec<(String, &[u8])> = Vec::new();
    for (mut name, length) in heads {
        let (log, after) = rest.split_at_checked(length)?;
        rest = after;
        if logs.iter().any(|(other, _)| *other == name) {
            name = format!("{name} ({})", logs.len() + 1);
        }
        logs.push((name, log));
    }
    rest.is_empty().then_some(logs)
}

impl View for After {
    fn page(&self) -> &'static Page {
        &PAGE
    }

    fn wants(&self) -> Option<&'static str> {
        let wants = "crossguard studio LOG...";
        self.shown().is_none().then_some(wants)
    }

    fn ask(&self, what: &str, query: &str, body: &[u8]) -> Result<String, Refusal> {
        if what == "logs" {
            return self.open(body);
        }
        let Some(shown) = self.shown() else {
            let cause =
                "this studio was given no log: open logs here, or start crossguard studio LOG...";
            return Err(Refusal::Wrong(cause.to_owned()));
        };
        let number = shown.number.to_string();
        match what {
            "opening" => Ok(shown.opening.clone()),
            "moment" if value(query, "run").is_some_and(|run| run != number) => Err(
                Refusal::Wrong("other logs were opened since: load this page anew".to_owned()),
            ),
            "moment" => moment(query, &shown.run.playback).ok_or_else(|| {
                let wanted =
                    "at=MICROSECONDS is wanted, and from=, to=, repeats=1 and run= are possible";
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
