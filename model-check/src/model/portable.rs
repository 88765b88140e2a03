//! States that leave their process, and fingerprints that are the same in every process.
//!
//! Inside a process a state is made of numbers of its parts, in the order of first use; another process has
//! other numbers for the same parts. So a state travels with the sender's numbers, and each part goes ahead of
//! it once ([`Packer`]); the receiver looks up its own numbers ([`Unpacker`]). A fingerprint is made of what the
//! parts hold and of nothing else ([`Fingerprints`]), and of all states that stand for one class of symmetric ones
//! it is the smallest.
//!
//! Both ends have to be the same build of the same version: the parts are hashed as they lie in memory.

use std::collections::{HashMap, HashSet};
use std::hash::Hash;

use rustc_hash::FxBuildHasher;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use siphasher::sip128::{Hasher128, SipHasher13};
use smallvec::SmallVec;

use super::{Action, Draft, Model, ModelState};
use crate::chart::chart;
use crate::network::{Network, Transmission};
use crate::scenario::MAX_ROBOTS;
use crate::sequence::ChartStep;
use crate::symmetry::Symmetry;

/// Kind of a part of a state.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize, Deserialize)]
pub enum PartKind {
    /// A robot with its body.
    Node,
    /// Past events.
    History,
    /// A message.
    Message,
    /// All messages ever sent on a monotone channel.
    Sent,
}

/// A part of states, under the sender's number.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct Part {
    /// Its kind.
    pub kind: PartKind,
    /// The sender's number of it.
    pub number: u32,
    /// Its content as JSON: each part travels once, and few do.
    pub text: String,
}

/// A state, made of the sender's numbers of its parts.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct PackedState {
    /// Without its network, which is what follows.
    state: ModelState,
    on_air: Vec<Transmission>,
    delayed: Vec<Transmission>,
    sent: u32,
}

/// A state came with a part that was not sent before it, or that is none.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("another process sent a state of which a part is missing or cannot be read: {0}")]
pub struct UnknownPart(String);

/// Packs states for one receiver.
#[derive(Default)]
pub struct Packer(HashSet<(PartKind, u32), FxBuildHasher>);

impl Packer {
    /// The state for the receiver. Parts that were not sent before are added to `news`.
    ///
    /// # Panics
    /// Where a part cannot be written as JSON, which all can.
    pub fn pack(&mut self, model: &Model, state: &ModelState, news: &mut Vec<Part>) -> PackedState {
        let (robots, network) = (model.0.scenario.robots.len(), model.network(state));
        for &node in &state.nodes[..robots] {
            self.tell(PartKind::Node, node, news, || {
                serde_json::to_string(model.node(node))
            });
        }
        self.tell(PartKind::History, state.history, news, || {
            serde_json::to_string(model.history(state))
        });
        for message in network.messages() {
            self.tell_message(model, message, news);
        }
        for sent in model.0.sets.transmissions(network.sent) {
            self.tell_message(model, sent.message, news);
        }
        self.tell(PartKind::Sent, network.sent, news, || {
            let sent: Vec<_> = model.0.sets.transmissions(network.sent).collect();
            serde_json::to_string(&sent)
        });
        PackedState {
            state: ModelState {
                network: 0,
                ..state.clone()
            },
            on_air: network.on_air().collect(),
            delayed: network.delayed().collect(),
            sent: network.sent,
        }
    }

    fn tell_message(&mut self, model: &Model, message: u16, news: &mut Vec<Part>) {
        self.tell(PartKind::Message, message.into(), news, || {
            serde_json::to_string(model.message(message))
        });
    }

    fn tell(
        &mut self,
        kind: PartKind,
        number: u32,
        news: &mut Vec<Part>,
        text: impl FnOnce() -> serde_json::Result<String>,
    ) {
        if self.0.insert((kind, number)) {
            let text = text().expect("parts have names as keys alone");
            news.push(Part { kind, number, text });
        }
    }
}

/// Unpacks the states of one sender.
#[derive(Default)]
pub struct Unpacker(HashMap<(PartKind, u32), u32, FxBuildHasher>);

impl Unpacker {
    /// Takes in a part.
    ///
    /// # Errors
    /// It is not what it says that it is.
    pub fn learn(&mut self, model: &Model, part: &Part) -> Result<(), UnknownPart> {
        let robots = model.robots();
        let own = match part.kind {
            PartKind::Node => robots.nodes.number(read(&part.text)?),
            PartKind::History => model.0.histories.number(read(&part.text)?),
            PartKind::Message => robots.message_number(read(&part.text)?).into(),
            PartKind::Sent => {
                let sent = self.own(read(&part.text)?)?;
                model.0.sets.of(&sent, robots)
            }
        };
        self.0.insert((part.kind, part.number), own);
        Ok(())
    }

    /// The state, made of this process's numbers; where robots are symmetric, the one that stands for its class here.
    ///
    /// # Errors
    /// A part of it was not sent before.
    pub fn unpack(&self, model: &Model, packed: PackedState) -> Result<ModelState, UnknownPart> {
        let mut state = packed.state;
        for node in &mut state.nodes[..model.0.scenario.robots.len()] {
            *node = self.number(PartKind::Node, *node)?;
        }
        state.history = self.number(PartKind::History, state.history)?;
        let mut network = Network::EMPTY;
        for sent in self.own(packed.on_air)? {
            network.send(sent);
        }
        for delayed in self.own(packed.delayed)? {
            network.delay(delayed);
        }
        network.sent = self.number(PartKind::Sent, packed.sent)?;
        Ok(model.interned(model.representative_of(Draft { state, network })))
    }

    fn own(&self, mut sent: Vec<Transmission>) -> Result<Vec<Transmission>, UnknownPart> {
        for transmission in &mut sent {
            let own = self.number(PartKind::Message, transmission.message.into())?;
            transmission.message = u16::try_from(own).expect("numbers of messages are small");
        }
        Ok(sent)
    }

    fn number(&self, kind: PartKind, number: u32) -> Result<u32, UnknownPart> {
        let own = self.0.get(&(kind, number)).copied();
        own.ok_or_else(|| UnknownPart(format!("{kind:?} {number}")))
    }
}

fn read<T: DeserializeOwned>(text: &str) -> Result<T, UnknownPart> {
    serde_json::from_str(text).map_err(|cause| UnknownPart(cause.to_string()))
}

/// Hashes of 128 bits of a process's parts of one kind, by number.
#[derive(Default)]
struct KnownHashes(Vec<Option<u128>>);

impl KnownHashes {
    fn of(&mut self, number: u32, hash: impl FnOnce() -> u128) -> u128 {
        let at = number as usize;
        if at >= self.0.len() {
            self.0.resize(at + 1, None);
        }
        *self.0[at].get_or_insert_with(hash)
    }
}

/// All states that differ in which of the symmetric robots is which; one state, where none are.
pub struct Class {
    /// The one with the smallest hashes, which are the same in each process.
    pub state: ModelState,
    /// Fingerprint of the class, the same in each process.
    pub fingerprint: u128,
    /// How many states it has.
    pub size: u16,
}

/// Makes fingerprints of 128 bits; states of one class of symmetric ones have the same. For one thread.
#[derive(Default)]
pub struct Fingerprints {
    nodes: KnownHashes,
    histories: KnownHashes,
    messages: KnownHashes,
    sent: KnownHashes,
}

impl Fingerprints {
    /// The fingerprint of a state.
    pub fn of(&mut self, model: &Model, state: &ModelState) -> u128 {
        self.class(model, state.clone()).fingerprint
    }

    /// The class of a state.
    pub fn class(&mut self, model: &Model, state: ModelState) -> Class {
        let network = model.network(&state);
        self.class_of(model, Draft { state, network })
    }

    /// The class of the state after an action; `None` if the action changes nothing.
    pub fn successor(
        &mut self,
        model: &Model,
        state: &ModelState,
        action: Action,
    ) -> Option<Class> {
        let (next, _) = model.take(state, action)?;
        Some(self.class_of(model, next))
    }

    fn class_of(&mut self, model: &Model, draft: Draft) -> Class {
        let symmetry = &model.0.symmetry;
        if symmetry.is_trivial() {
            let fingerprint = self.of_one(model, &draft);
            return Class {
                state: model.interned(draft),
                fingerprint,
                size: 1,
            };
        }
        let images = model.node_images(&draft.state);
        let exchanges = symmetry.exchanges.iter().enumerate();
        let nodes: SmallVec<[_; 6]> = exchanges
            .map(|(i, exchange)| {
                let nodes = super::canonical::exchanged(&draft.state.nodes, &images, i, exchange);
                (self.hashes_of_nodes(model, &nodes), nodes)
            })
            .collect();
        let smallest = nodes.iter().map(|(hashes, _)| *hashes).min();
        let mut chosen = None;
        // How many exchanges make the chosen one.
        let mut equal = 0;
        for (i, (hashes, nodes)) in nodes.iter().enumerate() {
            if Some(*hashes) != smallest {
                continue;
            }
            // Robots in equal states leave it to the rest to tell which is which.
            let image = (i != Symmetry::IDENTITY).then(|| model.image(&draft, *nodes, i));
            let fingerprint = self.of_one(model, image.as_ref().unwrap_or(&draft));
            let known = chosen.as_ref().map(|(_, known)| *known);
            if known.is_none_or(|known| fingerprint < known) {
                chosen = Some((image, fingerprint));
                equal = 1;
            } else if known == Some(fingerprint) {
                equal += 1;
            }
        }
        let (image, fingerprint) = chosen.expect("one of them is the smallest");
        let size = nodes.len() / equal;
        Class {
            state: model.interned(image.unwrap_or(draft)),
            fingerprint,
            size: u16::try_from(size).expect("at most as many as exchanges"),
        }
    }

    fn hashes_of_nodes(&mut self, model: &Model, nodes: &[u32; MAX_ROBOTS]) -> [u128; MAX_ROBOTS] {
        let mut hashes = [0; MAX_ROBOTS];
        let robots = model.0.scenario.robots.len();
        for (hash, &node) in hashes.iter_mut().zip(&nodes[..robots]) {
            *hash = self.nodes.of(node, || hashed(model.node(node)));
        }
        hashes
    }

    fn of_one(&mut self, model: &Model, Draft { state, network }: &Draft) -> u128 {
        let nodes = self.hashes_of_nodes(model, &state.nodes);
        let history = self.histories.of(state.history, || {
            hashed(model.0.histories.value(state.history))
        });
        let mut hasher = SipHasher13::new();
        (nodes, history, state.broken, state.left, state.hung).hash(&mut hasher);
        for sent in network.on_air() {
            self.of_transmission(model, sent).hash(&mut hasher);
        }
        // Sets, whose order is that of this process's numbers.
        let delayed = self.sum(model, network.delayed());
        let sent = network.sent;
        let known = self.sent.0.get(sent as usize).copied().flatten();
        let all_sent = known.unwrap_or_else(|| {
            let sum = self.sum(model, model.0.sets.transmissions(sent));
            self.sent.of(sent, || sum)
        });
        (delayed, all_sent).hash(&mut hasher);
        hasher.finish128().into()
    }

    fn sum(&mut self, model: &Model, sent: impl Iterator<Item = Transmission>) -> u128 {
        sent.fold(0, |sum: u128, one| {
            sum.wrapping_add(self.of_transmission(model, one))
        })
    }

    fn of_transmission(&mut self, model: &Model, sent: Transmission) -> u128 {
        let message = self
            .messages
            .of(sent.message.into(), || hashed(model.message(sent.message)));
        hashed(&(sent.from, sent.to, message))
    }
}

/// A hash of 128 bits that is the same in each process of a build.
pub fn hashed(value: &impl Hash) -> u128 {
    let mut hasher = SipHasher13::new();
    value.hash(&mut hasher);
    hasher.finish128().into()
}

/// A run through states that stand for their classes, as the steps of a chart of real robots.
#[must_use]
pub fn charted(model: &Model, path: Vec<(ModelState, Option<Action>)>) -> Vec<ChartStep> {
    chart(model, model.real_run(path))
}
