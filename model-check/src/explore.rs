//! stateright's Explorer, with states that a person can read.

use std::fmt;
use std::hash::{Hash, Hasher};
use std::io;
use std::net::{SocketAddr, TcpListener};

use stateright::{Model as _, Path, Property};

use crate::check::{chart, checked_properties, holds, label, names};
use crate::model::{Action, Model, ModelState};
use crate::properties::{PropertyId, for_each_property};
use crate::scenario::Scenario;
use crate::sequence::Chart;

/// The Explorer of a scenario.
pub struct Explorer {
    model: Readable,
    address: SocketAddr,
}

impl Explorer {
    /// The Explorer of a scenario, to be served on `address`.
    ///
    /// # Errors
    /// The address cannot be listened on.
    pub fn new(scenario: Scenario, address: SocketAddr) -> io::Result<Self> {
        // stateright itself does not say why it cannot listen.
        drop(TcpListener::bind(address)?);
        let model = Readable(Model::new(scenario));
        Ok(Self { model, address })
    }

    /// Serves it until the process ends.
    pub fn serve(self) {
        self.model.checker().serve(self.address);
    }
}

/// A model whose states are shown in words. Symmetric robots keep their places in it: a person who follows a run
/// by hand wants to know which robot is which.
struct Readable(Model);

/// A state in words.
#[derive(Clone)]
struct Shown {
    state: ModelState,
    words: String,
}

impl PartialEq for Shown {
    fn eq(&self, other: &Self) -> bool {
        self.state == other.state
    }
}

impl Hash for Shown {
    fn hash<H: Hasher>(&self, hasher: &mut H) {
        self.state.hash(hasher);
    }
}

impl fmt::Debug for Shown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.words)
    }
}

fn shown<const N: usize>(model: &Readable, shown: &Shown) -> bool {
    holds::<N>(&model.0, &shown.state)
}

const SHOWN: [fn(&Readable, &Shown) -> bool; PropertyId::ALL.len()] = for_each_property!(shown);

impl Readable {
    fn show(&self, state: ModelState) -> Shown {
        let robots = self.0.nodes(&state).zip(names(self.0.scenario()));
        let lines = robots.enumerate().map(|(i, (node, name))| {
            let hangs = if state.hangs(i) { "; it hangs" } else { "" };
            format!("{name}: {node}{hangs}")
        });
        let words = lines.collect::<Vec<_>>().join("\n");
        Shown { state, words }
    }
}

impl stateright::Model for Readable {
    type State = Shown;
    type Action = Action;

    fn init_states(&self) -> Vec<Shown> {
        vec![self.show(self.0.initial())]
    }

    fn actions(&self, state: &Shown, actions: &mut Vec<Action>) {
        self.0.actions_in(&state.state, actions);
    }

    fn next_state(&self, state: &Shown, action: Action) -> Option<Shown> {
        let (next, _) = self.0.successor(&state.state, action)?;
        Some(self.show(next))
    }

    fn properties(&self) -> Vec<Property<Self>> {
        checked_properties(self.0.scenario(), &SHOWN)
    }

    fn format_action(&self, action: &Action) -> String {
        label(&self.0, *action)
    }

    fn as_svg(&self, path: Path<Shown, Action>) -> Option<String> {
        let robots = names(self.0.scenario());
        let run = path.into_vec().into_iter();
        let steps = chart(
            &self.0,
            run.map(|(shown, action)| (shown.state, action)).collect(),
        );
        let chart = Chart {
            title: &self.0.scenario().name,
            robots: &robots,
            steps: &steps,
            repeats_after: None,
        };
        Some(chart.svg())
    }
}
