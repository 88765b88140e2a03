//! The robots and messages of a model, each stored once, and the steps of single robots.

use std::sync::Arc;

use crossguard_protocol::{Config, Event, Input, Millis, Outputs};
use smallvec::SmallVec;

use crate::canonical::{NameSets, Renamings};
use crate::intern::Interner;
use crate::network::Message;
use crate::node::{Node, Rules};

/// Input of a robot in a model with time.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum TimedCause {
    /// The time that its clock has shown since it last took in the time.
    Elapsed(Millis),
    Message(u16),
    Event(Event),
}

/// All robots and messages that have occurred.
pub(crate) struct Robots {
    pub(crate) rules: Box<dyn Rules>,
    pub(crate) nodes: Interner<Node>,
    messages: Interner<Message>,
    pub(crate) renamings: Arc<Renamings>,
}

impl Robots {
    pub(crate) fn new(rules: Box<dyn Rules>, renamings: &Arc<Renamings>) -> Self {
        Self {
            rules,
            nodes: Interner::new(renamings),
            messages: Interner::new(renamings),
            renamings: Arc::clone(renamings),
        }
    }

    /// A robot's step; `None` when it is down.
    pub(crate) fn step(&self, config: &Config, node: u32, input: Input) -> Option<(Node, Outputs)> {
        self.nodes.value(node).step(&*self.rules, config, input)
    }

    pub(crate) fn input(&self, cause: TimedCause) -> Input {
        match cause {
            TimedCause::Elapsed(elapsed) => Input::Elapsed(elapsed),
            TimedCause::Message(number) => self.message(number).input(),
            TimedCause::Event(event) => Input::Local(event),
        }
    }

    pub(crate) fn message(&self, number: u16) -> &Message {
        self.messages.value(number.into())
    }

    pub(crate) fn message_names(&self, message: u16) -> u32 {
        self.messages.names(message.into())
    }

    /// The number of a message. Panics beyond 65,536 distinct messages.
    pub(crate) fn message_number(&self, message: Message) -> u16 {
        short(self.messages.number(message))
    }

    pub(crate) fn message_renamed(&self, message: u16, renaming: u32) -> u16 {
        short(self.messages.renamed(message.into(), renaming))
    }

    /// The messages that a robot sends in a step, after which it is `sender`.
    pub(crate) fn sends(&self, sender: &Node, outputs: &Outputs) -> SmallVec<[u16; 2]> {
        let Some(robot) = &sender.robot else {
            return SmallVec::new();
        };
        outputs
            .iter()
            .filter_map(|output| Message::sent(robot, output))
            .map(|message| self.message_number(message))
            .collect()
    }

    pub(crate) fn name_sets(&self, nodes: &[u32], messages: impl Iterator<Item = u16>) -> NameSets {
        let mut sets = NameSets::default();
        for &node in nodes {
            sets.add(self.nodes.names(node));
        }
        for message in messages {
            sets.add(self.message_names(message));
        }
        sets
    }

    pub(crate) fn rename_nodes(&self, nodes: &mut [u32], renaming: u32) {
        for node in nodes {
            *node = self.nodes.renamed(*node, renaming);
        }
    }
}

fn short(message: u32) -> u16 {
    u16::try_from(message).expect("fewer than 65,536 distinct messages")
}
