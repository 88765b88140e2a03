//! The state that stands for all states that differ in names, or in which of the symmetric robots is
//! which.

use rustc_hash::FxHashSet;
use smallvec::SmallVec;

use super::{Action, Draft, Model, ModelState};
use crate::canonical::Renamable;
use crate::network::{Network, Transmission};
use crate::scenario::MAX_ROBOTS;
use crate::symmetry::{Exchange, Images, Symmetry};

impl Model {
    /// The state that stands for all states that differ from the draft in names alone.
    pub(super) fn ranked(&self, draft: Draft) -> Draft {
        let Draft {
            mut state,
            mut network,
        } = draft;
        let robots = self.0.scenario.robots.len();
        let nodes = &state.nodes[..robots];
        let mut sets = self.robots().name_sets(nodes, network.messages());
        sets.add(self.0.sets.names(network.sent));
        sets.add(self.0.histories.names(state.history));
        if let Some(renaming) = self.robots().renamings.of(sets) {
            self.rename(&mut state, &mut network, renaming);
        }
        if !self.0.symmetry.is_trivial() {
            network.sort_broadcasts();
        }
        Draft { state, network }
    }

    fn rename(&self, state: &mut ModelState, network: &mut Network, renaming: u32) {
        let robots = self.robots();
        let nodes = &mut state.nodes[..self.0.scenario.robots.len()];
        robots.rename_nodes(nodes, renaming);
        let renamed = |message| robots.message_renamed(message, renaming);
        *network = network.map(|sent| Transmission {
            message: renamed(sent.message),
            ..sent
        });
        let sets = &self.0.sets;
        network.sent = sets.renamed(network.sent, renaming, renamed, robots);
        state.history = self.0.histories.renamed(state.history, renaming);
    }

    pub(super) fn interned(&self, Draft { mut state, network }: Draft) -> ModelState {
        state.network = self.number_of(&network);
        state
    }

    /// The state that stands for `state` and all states that differ from it in which of the symmetric
    /// robots is which.
    #[must_use]
    pub fn representative(&self, state: &ModelState) -> ModelState {
        let network = self.network(state);
        let state = state.clone();
        self.interned(self.representative_of(Draft { state, network }))
    }

    pub(super) fn representative_of(&self, draft: Draft) -> Draft {
        let symmetry = &self.0.symmetry;
        if symmetry.is_trivial() {
            return draft;
        }
        let images = self.node_images(&draft.state);
        let exchanges = symmetry.exchanges.iter().enumerate();
        let nodes: SmallVec<[[u32; MAX_ROBOTS]; 6]> = exchanges
            .map(|(i, exchange)| exchanged(&draft.state.nodes, &images, i, exchange))
            .collect();
        let smallest = nodes.iter().min();
        let candidates = (0..nodes.len()).filter(|i| smallest == Some(&nodes[*i]));
        let candidates: SmallVec<[usize; 6]> = candidates.collect();
        if candidates[..] == [Symmetry::IDENTITY] {
            return draft;
        }
        // Robots in equal states leave it to the rest to tell which is which.
        let images = candidates.iter().map(|&i| self.image(&draft, nodes[i], i));
        let chosen = images.min_by(|a, b| a.rest().cmp(&b.rest()));
        chosen.unwrap_or(draft)
    }

    /// How many states differ from a state only in which of the symmetric robots is which, itself among them.
    #[must_use]
    pub fn class_size(&self, state: &ModelState) -> usize {
        if self.0.symmetry.is_trivial() {
            return 1;
        }
        let images = self.node_images(state);
        let draft = Draft {
            state: state.clone(),
            network: self.network(state),
        };
        let exchanges = self.0.symmetry.exchanges.iter().enumerate();
        let class = exchanges.map(|(i, exchange)| {
            let nodes = exchanged(&draft.state.nodes, &images, i, exchange);
            let Draft { state, network } = self.image(&draft, nodes, i);
            (state, network)
        });
        class.collect::<FxHashSet<_>>().len()
    }

    /// The images of the nodes of all robots.
    fn node_images(&self, state: &ModelState) -> NodeImages<'_> {
        let symmetry = &self.0.symmetry;
        let nodes = state.nodes[..self.0.scenario.robots.len()].iter();
        let images = nodes.map(|&node| {
            symmetry.images(&symmetry.nodes, node, |mut exchange| {
                let image = self.node(node).renamed(&mut exchange);
                self.robots().nodes.number(image)
            })
        });
        images.collect()
    }

    /// Image of a state under an exchange, after which its nodes are these.
    fn image(&self, draft: &Draft, nodes: [u32; MAX_ROBOTS], exchange: usize) -> Draft {
        let (robots, symmetry) = (self.robots(), &self.0.symmetry);
        let history = symmetry.images(&symmetry.histories, draft.state.history, |mut exchange| {
            let histories = &self.0.histories;
            histories.number(histories.value(draft.state.history).renamed(&mut exchange))
        });
        let message = |number: u16| {
            let images = symmetry.images(&symmetry.messages, number.into(), |mut exchange| {
                let message = self.message(number).renamed(&mut exchange);
                robots.message_number(message).into()
            });
            u16::try_from(images[exchange]).expect("numbers of messages are small")
        };
        let sent = symmetry.images(&symmetry.sets, draft.network.sent, |exchange| {
            let image = |number: u16| {
                let mut exchange = exchange;
                robots.message_number(self.message(number).renamed(&mut exchange))
            };
            let moved = |sent| exchange.transmission(sent, image);
            self.0.sets.map(draft.network.sent, robots, moved)
        });
        let exchanged = &symmetry.exchanges[exchange];
        let mut network = exchanged.network(&draft.network, message);
        network.sent = sent[exchange];
        Draft {
            state: ModelState {
                nodes,
                history: history[exchange],
                hung: exchanged.bits(draft.state.hung),
                ..draft.state.clone()
            },
            network,
        }
    }

    /// A run through the states that the states of `path` stand for. Its actions are those of the path
    /// where no robots are symmetric.
    pub(crate) fn real_run(
        &self,
        path: Vec<(ModelState, Option<Action>)>,
    ) -> Vec<(ModelState, Option<Action>)> {
        if self.0.symmetry.is_trivial() {
            return path;
        }
        let mut at = self.initial();
        let mut run = Vec::with_capacity(path.len());
        for (to, _) in path.into_iter().skip(1) {
            let mut actions = Vec::new();
            self.actions_in(&at, &mut actions);
            let taken = actions.into_iter().find_map(|action| {
                let (next, _) = self.successor(&at, action)?;
                (self.representative(&next) == to).then_some((action, next))
            });
            let (action, next) = taken.expect("symmetric states have symmetric successors");
            run.push((std::mem::replace(&mut at, next), Some(action)));
        }
        run.push((at, None));
        run
    }
}

impl Draft {
    /// The parts of a state besides its robots, by which states with the same robots differ.
    const fn rest(&self) -> (u32, u8, &Network) {
        (self.state.history, self.state.hung, &self.network)
    }
}

/// The images of a node, by robot.
type NodeImages<'a> = SmallVec<[&'a Images; MAX_ROBOTS]>;

/// The nodes after the exchange of this number.
fn exchanged(
    nodes: &[u32; MAX_ROBOTS],
    images: &NodeImages<'_>,
    number: usize,
    exchange: &Exchange,
) -> [u32; MAX_ROBOTS] {
    let mut exchanged = *nodes;
    for (place, images) in images.iter().enumerate() {
        exchanged[exchange.place(place)] = images[number];
    }
    exchanged
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;
    use crate::exploration::Options;
    use crate::explore::{Keep, explore};
    use crate::history::{CommandRecord, History};
    use crate::node::Node;
    use crate::scenario::Scenario;

    fn model(text: &str, symmetric: &str) -> Model {
        let (text, _) = text.split_once("[expected]").unwrap();
        let text = ["L1", "L2", "L4"].iter().fold(text.to_owned(), |text, id| {
            text.replace(&format!("\"{id}\","), "")
        });
        let text = text.replacen("properties", &format!("{symmetric}\nproperties"), 1);
        Model::new(Scenario::parse("symmetric.toml", &text).unwrap())
    }

    fn reachable(model: &Model) -> HashSet<ModelState> {
        model.reachable().collect()
    }

    fn reachable_up_to_symmetry(model: &Model) -> HashSet<ModelState> {
        let options = Options::default();
        let limits = options.limits();
        let (graph, ()) = explore(model, Keep::States, &options, &limits, &mut |_| ());
        (0..)
            .take(graph.states())
            .map(|it| graph.state(it))
            .collect()
    }

    /// All states that differ from `state` in which of the symmetric robots is which.
    fn class(model: &Model, state: &ModelState) -> HashSet<ModelState> {
        let draft = Draft {
            state: state.clone(),
            network: model.network(state),
        };
        let images = model.node_images(state);
        let exchanges = model.0.symmetry.exchanges.iter().enumerate();
        exchanges
            .map(|(i, exchange)| {
                let nodes = exchanged(&state.nodes, &images, i, exchange);
                model.interned(model.image(&draft, nodes, i))
            })
            .collect()
    }

    /// Asserts that all states are exactly those of the classes of the reduced ones; how many there are
    /// of either.
    fn assert_covered(model: &Model) -> (usize, usize) {
        let all = reachable(model);
        let reduced = reachable_up_to_symmetry(model);
        let mut covered = 0;
        for state in &reduced {
            let class = class(model, state);
            assert!(class.iter().all(|state| all.contains(state)));
            let stands_for = |other: &ModelState| model.representative(other) == *state;
            assert!(class.iter().all(stands_for));
            covered += class.len();
        }
        assert_eq!(covered, all.len());
        (all.len(), reduced.len())
    }

    /// A part of a scenario, and what takes its place.
    type Change = (&'static str, &'static str);

    /// Changes of the scenario `trio`, and how many states there are then, and how many of them up to symmetry.
    const TRIOS: [(&[Change], [usize; 2]); 7] = [
        (&[], [725_253, 362_699]),
        (&[NO_COMMANDS, DELAYED, NO_LOSS], [147_224, 73_660]),
        (
            &[
                ("commands = 1", "commands = 1\ncrashes = 1\nrestarts = 1"),
                NO_LOSS,
            ],
            [94_371, 47_255],
        ),
        // Guards that leave their places, and that see for themselves.
        (
            &[("commands = 1", "commands = 1\ndrifts = 2"), NO_LOSS],
            [46_443, 23_250],
        ),
        (
            &[
                ("\nproperties", "\ncorridor = true\nproperties"),
                ("\"block\"", "\"move\""),
                ("commands = 1", "commands = 2\nsightings = 1"),
                NO_LOSS,
            ],
            [224_141, 112_391],
        ),
        (
            &[
                ("commands = 1", "heartbeats = 0\noffers = 2"),
                ("delayed = 0", "monotone = true"),
            ],
            [4_494, 2_326],
        ),
        (
            &[("commands = 1", "hangs = 1"), DELAYED, NO_LOSS],
            [1_171_766, 586_026],
        ),
    ];
    const NO_COMMANDS: Change = ("commands = 1", "commands = 0");
    const DELAYED: Change = ("delayed = 0", "delayed = 1");
    const NO_LOSS: Change = ("loss = true", "loss = false");

    /// A scenario with these changes.
    fn changed(text: &str, changes: &[Change]) -> String {
        let change = |text: String, (from, to): &Change| {
            assert!(text.contains(from), "{from}");
            text.replace(from, to)
        };
        changes.iter().fold(text.to_owned(), change)
    }

    #[test]
    fn the_classes_of_the_reduced_states_are_all_states() {
        for (changes, states) in TRIOS {
            let trio = changed(include_str!("../../scenarios/trio.toml"), changes);
            let (all, reduced) = assert_covered(&model(&trio, "symmetric = [2, 3]"));
            assert_eq!([all, reduced], states, "{changes:?}");
        }
    }

    #[test]
    fn so_they_are_with_three_symmetric_robots_and_what_follows_is_the_same() {
        let team = include_str!("../../scenarios/team-of-four.toml")
            .replace("losses = 1", "losses = 0")
            .replace("commands = 1", "commands = 0");
        let model = model(&team, "symmetric = [2, 3, 4]");
        assert_eq!(assert_covered(&model), (45_138, 8_187));
        let successors = |state: &ModelState| -> HashSet<ModelState> {
            let mut actions = Vec::new();
            model.actions_in(state, &mut actions);
            actions
                .into_iter()
                .filter_map(|action| Some(model.successor_up_to_symmetry(state, action)?.0))
                .collect()
        };
        for state in reachable_up_to_symmetry(&model) {
            let expected = successors(&state);
            for other in class(&model, &state) {
                assert_eq!(successors(&other), expected);
            }
        }
    }

    const fn all_forgotten(record: &CommandRecord) -> CommandRecord {
        CommandRecord {
            started: true,
            accepted: false,
            finished: false,
            in_position: false,
            fell_back: true,
            told: true,
            out_of_position: false,
            ..*record
        }
    }

    /// The robots and histories of all states, under names that depend on nothing else. Facts that may be
    /// forgotten are left out: the more messages may arrive, the fewer are.
    fn parts(model: &Model) -> HashSet<(Vec<Node>, History)> {
        let parts = |mut state: ModelState| {
            let forgetting = model
                .history(&state)
                .forgetting(all_forgotten, |_, _| false);
            if let Some(history) = forgetting {
                state.history = model.0.histories.number(history);
            }
            let network = Network::EMPTY;
            let Draft { state, .. } = model.ranked(Draft { state, network });
            let nodes = model.nodes(&state).cloned().collect();
            (nodes, model.history(&state).clone())
        };
        let all = reachable(model);
        all.into_iter().map(parts).collect()
    }

    /// Asserts that whatever robots can come to with delayed messages they can come to on a monotone
    /// channel, within the same bounds.
    fn assert_contained(text: &str, delayed: u8) {
        let text = text.split("[expected]").next().unwrap_or_default();
        let mut scenario = Scenario::parse("any.toml", text).unwrap();
        scenario.bounds.heartbeats = Some(1);
        scenario.bounds.offers = Some(2);
        scenario.channel.delayed = delayed;
        let with_delay = parts(&Model::new(scenario.clone()));
        scenario.channel.delayed = 0;
        scenario.channel.monotone = true;
        let monotone = parts(&Model::new(scenario));
        assert!(with_delay.is_subset(&monotone));
        assert!(with_delay.len() > 500);
    }

    #[test]
    fn a_monotone_channel_contains_delayed_messages_also_after_a_reboot_and_a_hang() {
        let (pair, reboot, hang) = (
            include_str!("../../scenarios/pair.toml"),
            include_str!("../../scenarios/pair-reboot.toml"),
            include_str!("../../scenarios/pair-hang.toml"),
        );
        let closed = ("corridor = true", "");
        let calm = [
            closed,
            ("disturbances = 1", ""),
            ("commands = 2", "commands = 1"),
        ];
        assert_contained(&changed(pair, &calm), 2);
        let once = [closed, ("detections = 2", "detections = 1")];
        assert_contained(&changed(reboot, &once), 1);
        assert_contained(&changed(hang, &[closed]), 1);
    }
}
