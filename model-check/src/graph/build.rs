//! How a graph is built: what is noted of states and transitions while they are found.

use super::edges::{Edges, Full, Way};
use super::{Graph, Keep};
use crate::exploration::{CheckProgress, ExplorationLimits, Options};
use crate::explorer::{Space, explore};
use crate::fair::Classes;
use crate::fairness::Classifier;
use crate::model::{Action, Delivery, Model, ModelState};
use crate::properties::PropertyId;
use crate::report::CutOff;
use crate::store::States;

/// A graph that is being built.
struct Building<'a> {
    model: &'a Model,
    until_broken: &'a [PropertyId],
    /// Finds the classes of transitions, where those are kept.
    classifier: Option<Classifier<'a>>,
    graph: Graph,
    /// The transitions of the state that is being added.
    transitions: Vec<(u32, Way)>,
}

/// What a state is found to be.
struct Judged {
    /// One bit per property that it breaks.
    broken: u32,
    /// The classes that are enabled in it, where classes are kept.
    enabled: Classes,
}

impl Graph {
    /// Explores `model` from its initial state, breadth first, with the threads of `options`, and until
    /// what it says is found to be broken. `watch` receives the progress.
    pub(crate) fn build(
        model: &Model,
        keep: Keep,
        options: &Options,
        limits: &ExplorationLimits,
        watch: &mut dyn FnMut(CheckProgress),
    ) -> Self {
        let is_monotone = model.scenario().channel.monotone;
        let mut states = States::default();
        states.add(&model.initial());
        let has_classes = keep == Keep::Classes;
        let mut building = Building {
            model,
            until_broken: &options.until_broken,
            classifier: has_classes.then_some(Classifier(model)),
            graph: Self {
                states,
                edges: (keep != Keep::States).then(|| Edges::new(is_monotone, has_classes)),
                transitions: 0,
                levels: Vec::new(),
                resettable: Vec::new(),
                broken: [None; PropertyId::ALL.len()],
                cut_off: None,
            },
            transitions: Vec::new(),
        };
        let (levels, cut_off) = explore(&mut building, options.threads, limits, watch);
        let mut graph = building.graph;
        (graph.levels, graph.cut_off) = (levels, cut_off);
        graph.states.freeze();
        if let (None, Some(edges)) = (graph.cut_off, &mut graph.edges) {
            edges.shrink();
            graph.resettable = graph.can_be_reset(model);
        }
        graph
    }
}

impl Building<'_> {
    /// The classes that are enabled while the fate of messages on air is decided first.
    fn enabled_off_air(&self, state: &ModelState) -> Classes {
        let classifier = self.classifier.filter(|_| self.model.is_on_air(state));
        classifier.map_or(Classes::NONE, |it| it.enabled_off_air(state))
    }
}

impl Space for Building<'_> {
    type State = ModelState;
    type Seen = Judged;
    type Way = Way;
    type Work = Vec<Action>;

    fn states(&self) -> usize {
        self.graph.states()
    }

    fn find(&self, state: &ModelState) -> Option<u32> {
        self.graph.states.find(state)
    }

    fn add(&mut self, state: ModelState, _: u32, _: Way) -> u32 {
        self.graph.states.add(&state)
    }

    fn work(&self) -> Vec<Action> {
        Vec::new()
    }

    fn expand(
        &self,
        number: u32,
        actions: &mut Vec<Action>,
        mut lead_to: impl FnMut(ModelState, Way),
    ) -> Judged {
        let state = self.graph.state(number);
        let broken = self.model.broken_in(&state);
        let mut enabled = self.enabled_off_air(&state);
        actions.clear();
        self.model.actions_in(&state, actions);
        for &action in &*actions {
            let next = self.model.successor_up_to_symmetry(&state, action);
            let Some((next, step)) = next else {
                continue;
            };
            let classifier = self.classifier;
            let classes = classifier.map(|it| (it.enabled_by(action), it.taken(action, step)));
            let (enabled_by, taken) = classes.unwrap_or_default();
            enabled |= enabled_by;
            let by_chance = is_by_chance(action);
            lead_to(next, Way { by_chance, taken });
        }
        Judged { broken, enabled }
    }

    fn begin(&mut self, number: u32, judged: &Judged) {
        self.graph.note_broken(number, judged.broken);
        self.transitions.clear();
    }

    fn add_way(&mut self, _: u32, to: u32, way: Way) {
        let is_first = add_way(&mut self.transitions, to, way);
        self.graph.transitions += usize::from(is_first);
    }

    fn end(&mut self, judged: &Judged) -> Result<(), CutOff> {
        let Some(edges) = &mut self.graph.edges else {
            return Ok(());
        };
        let added = edges.add(&self.transitions, judged.enabled);
        added.map_err(|Full| CutOff::StateLimit)
    }

    fn is_enough(&self) -> bool {
        let wanted = self.until_broken;
        !wanted.is_empty() && wanted.iter().all(|&id| self.graph.broken(id).is_some())
    }
}

/// Adds a transition to those of one state, unless there is one like it. Returns whether it is the first to its target.
fn add_way(transitions: &mut Vec<(u32, Way)>, to: u32, way: Way) -> bool {
    let mut is_first = true;
    for (_, known) in transitions.iter_mut().filter(|(known, _)| *known == to) {
        is_first = false;
        if known.taken == way.taken {
            known.by_chance &= way.by_chance;
            return false;
        }
    }
    transitions.push((to, way));
    is_first
}

/// Whether an action is an arrival that may never happen.
const fn is_by_chance(action: Action) -> bool {
    matches!(
        action,
        Action::Deliver {
            how: Delivery::AnyTime,
            ..
        }
    )
}
