//! A run after it happened: what its logs say, with what validation says of them.

use crossguard_judge::playback::{Overview, Playback, Stretch};
use crossguard_judge::validate::{Invalid, Validated};
use crossguard_judge::verdict::{self, PropertyVerdict};
use serde::Serialize;

use super::shell::{Asset, Refusal, Skip, View, value};

const FILES: [Asset; 4] = [
    ("after.css", include_str!("after/after.css")),
    ("after.js", include_str!("after/after.js")),
    ("player.js", include_str!("after/player.js")),
    ("timeline.js", include_str!("after/timeline.js")),
];

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
        let at = self.invalid_us.map(|at_us| at_us.saturating_sub(began_us));
        Verdict {
            kind,
            sentences,
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
    fn name(&self) -> &'static str {
        "after"
    }

    fn title(&self) -> &'static str {
        "After"
    }

    fn about(&self) -> &'static str {
        "A run after it happened: robots, people and messages in time, what validation says, and times beside the paper's."
    }

    fn wants(&self) -> Option<&'static str> {
        let wants = "crossguard studio LOG...";
        self.0.is_none().then_some(wants)
    }

    fn skip(&self) -> Skip {
        Skip {
            to: "messages-title",
            words: "Skip to the messages",
        }
    }

    fn content(&self) -> &'static str {
        include_str!("after/content.html")
    }

    fn shared_style(&self) -> Option<&'static str> {
        Some("run.css")
    }

    fn files(&self) -> &'static [Asset] {
        &FILES
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
