//! Robots while they run, by the logs that they write.

mod operator;
mod state;
mod tail;

use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use crossguard_robot::port::PortAddress;
use crossguard_robot::site_file::SiteFile;

use super::shell::{Page, Refusal, Skip, View, json};
use operator::Operators;
use state::State;
use tail::Tail;

/// How often it is looked whether logs have grown.
const LOOK: Duration = Duration::from_millis(100);

static PAGE: Page = Page {
    name: "live",
    title: "Live",
    about: "Robots while they run: the street, states and timers, messages as they are sent, and who has fallen silent.",
    skip: Skip {
        to: "messages-title",
        words: "Skip to the messages",
    },
    content: include_str!("live/content.html"),
    shared_style: Some("run.css"),
    files: &[
        ("live.css", include_str!("live/live.css")),
        ("live.js", include_str!("live/live.js")),
        ("operator.js", include_str!("live/operator.js")),
    ],
};

/// Logs of robots that run.
#[derive(Debug)]
pub struct Followed {
    /// The logs; they need not be there yet.
    pub logs: Vec<PathBuf>,
    /// The street that the map shows.
    pub street: Option<SiteFile>,
    /// The operator ports by which the page commands robots.
    pub operators: Vec<PortAddress>,
}

/// The view of robots that run.
pub(super) struct Live(Option<(Arc<Mutex<State>>, Operators)>);

impl Live {
    pub(super) fn new(followed: Option<Followed>) -> Self {
        Self(followed.map(|followed| {
            let Followed {
                logs,
                street,
                operators,
            } = followed;
            let state = Arc::new(Mutex::new(State::new(&logs, street)));
            let shared = Arc::clone(&state);
            // It ends with the process. A log is read by one thread: what it has read of a line stays there.
            std::thread::spawn(move || follow(logs, &shared));
            (state, Operators::new(operators))
        }))
    }
}

fn follow(logs: Vec<PathBuf>, shared: &Mutex<State>) {
    let tails = logs.into_iter().enumerate();
    let mut tails: Vec<_> = tails.map(|(place, path)| Tail::new(path, place)).collect();
    loop {
        let mut has_more = false;
        for (place, tail) in tails.iter_mut().enumerate() {
            let taken = tail.take();
            has_more |= taken.has_more;
            let mut state = shared.lock().unwrap_or_else(PoisonError::into_inner);
            state.take(place, tail, taken);
        }
        if !has_more {
            std::thread::sleep(LOOK);
        }
    }
}

impl View for Live {
    fn page(&self) -> &'static Page {
        &PAGE
    }

    fn wants(&self) -> Option<&'static str> {
        let wants = "crossguard studio --follow LOG...";
        self.0.is_none().then_some(wants)
    }

    fn commands(&self) -> Option<&'static str> {
        Some("operator")
    }

    fn ask(&self, what: &str, _query: &str, body: &[u8]) -> Result<String, Refusal> {
        let Some((state, operators)) = &self.0 else {
            let cause = "this studio follows no log: crossguard studio --follow LOG...";
            return Err(Refusal::Wrong(cause.to_owned()));
        };
        match what {
            "now" => {
                let mut state = state.lock().unwrap_or_else(PoisonError::into_inner);
                json(&state.now())
            }
            "operators" => json(&operators.offered()),
            "operator" => operators.ask(body).map_err(Refusal::Wrong),
            _ => Err(Refusal::Unknown),
        }
    }
}
