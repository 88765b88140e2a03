//! The radio channel.
//!
//! A broadcast is one message per receiver, so it can get lost on the way to one and reach another.
//! Each message either arrives at once, or gets lost, or is *delayed*: then it arrives at any later
//! moment, after any message that was sent later, as often as the channel likes, or never. A
//! scenario bounds how many messages are delayed at a time, not for how long.
//!
//! Messages that were just sent are *on air*. Their fates are decided one after the other
//! before anything else happens; that leaves out nothing, because whatever might happen in between
//! can as well happen before or after to a delayed message. Broadcasts go off air in the order in which
//! they were sent. The receivers of one hear it in the order in which the scenario lists them or, where
//! some robots of a scenario are symmetric, in any order.
//!
//! A robot that is down or hangs hears nothing. A message to it gets lost, or is delayed and arrives after
//! the robot has booted again or goes on, as do messages that were delayed before. Loss is not counted
//! there, and needs no channel that loses.
//!
//! A *monotone* channel has nothing on air and nothing delayed: it is the set of all messages ever sent,
//! of which any arrives at any time. It is finite by two bounds, on heartbeats and on offers;
//! [`monotone`](crate::monotone) says why, and what is refused there.

use crossguard_protocol::{
    Coordination, Decimetres, Farewell, Input, Output, Ram, Renaming, Rmcm, Robot, StationId,
};

use smallvec::SmallVec;

use crate::canonical::Renamable;
use crate::monotone::Sets;
use crate::transmission::PackedTransmission;
pub use crate::transmission::Transmission;

/// How many messages may be delayed at a time.
pub const MAX_DELAYED: usize = 4;

const MAX_ON_AIR: usize = 30;

/// A message.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[allow(
    clippy::large_enum_variant,
    reason = "each is interned once, and is copied as it is"
)]
pub enum Message {
    /// A RAM.
    Ram(Ram),
    /// An RMCM.
    Rmcm(Rmcm),
}

impl Message {
    /// The message that a robot in this state after a step sends for an output of the step, if any.
    pub(crate) fn sent(after: &Robot, output: &Output) -> Option<Self> {
        match *output {
            Output::SendRam => Some(Self::Ram(after.ram())),
            Output::SendRmcm(rmcm) => Some(Self::Rmcm(rmcm)),
            _ => None,
        }
    }

    /// Input of the receiver's transition function. All robots are equally far apart.
    #[must_use]
    pub fn input(&self) -> Input {
        match *self {
            Self::Ram(ram) => Input::Ram {
                ram,
                distance: Decimetres(0),
            },
            Self::Rmcm(rmcm) => Input::Rmcm(rmcm),
        }
    }
}

impl Renamable for Message {
    fn renamed(&self, to: &mut impl Renaming) -> Self {
        match self {
            Self::Ram(ram) => Self::Ram(ram.renamed(to)),
            Self::Rmcm(rmcm) => Self::Rmcm(rmcm.renamed(to)),
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub(crate) struct Network {
    /// Just sent, in the order of sending, then empty.
    on_air: [PackedTransmission; MAX_ON_AIR],
    /// Delayed, as a sorted set.
    delayed: [PackedTransmission; MAX_DELAYED],
    /// Number of the set of all messages ever sent, where the channel is monotone.
    pub(crate) sent: u32,
}

/// A network as it is interned, without empty places: there are millions.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(crate) struct PackedNetwork {
    /// On air, then delayed.
    messages: SmallVec<[PackedTransmission; 4]>,
    on_air: u8,
    sent: u32,
}

impl PackedNetwork {
    pub(crate) fn of(network: &Network) -> Self {
        let on_air = network.on_air.iter().filter(|slot| !slot.is_empty());
        let count = u8::try_from(on_air.clone().count()).expect("at most MAX_ON_AIR");
        let delayed = network.delayed.iter().filter(|slot| !slot.is_empty());
        Self {
            messages: on_air.chain(delayed).copied().collect(),
            on_air: count,
            sent: network.sent,
        }
    }

    pub(crate) fn unpacked(&self) -> Network {
        let mut network = Network::EMPTY;
        let (on_air, delayed) = self.messages.split_at(self.on_air.into());
        network.on_air[..on_air.len()].copy_from_slice(on_air);
        // As a sorted set: the empty places come first.
        network.delayed[MAX_DELAYED - delayed.len()..].copy_from_slice(delayed);
        network.sent = self.sent;
        network
    }
}

impl Network {
    pub(crate) const EMPTY: Self = Self {
        on_air: [PackedTransmission::EMPTY; MAX_ON_AIR],
        delayed: [PackedTransmission::EMPTY; MAX_DELAYED],
        sent: Sets::EMPTY,
    };

    /// Puts a message on air. Panics when there are more than one step and what it sets off can send.
    pub(crate) fn send(&mut self, transmission: Transmission) {
        let free = self.on_air.iter_mut().find(|slot| slot.is_empty());
        *free.expect("room for what one step sends") = PackedTransmission::of(transmission);
    }

    /// The message whose fate is decided next, where receivers hear a broadcast in their order.
    pub(crate) const fn next_on_air(&self) -> Option<Transmission> {
        self.on_air[0].transmission()
    }

    /// The messages of the first broadcast on air, of which any may be the next where receivers hear a
    /// broadcast in any order. One message that a robot sends twice in a row counts as one broadcast.
    pub(crate) fn first_broadcast(&self) -> impl Iterator<Item = Transmission> {
        let first = self.on_air[0];
        let on_air = self.on_air.iter().enumerate();
        on_air
            .take_while(move |(_, slot)| !slot.is_empty() && slot.broadcast() == first.broadcast())
            .filter(|(i, slot)| *i == 0 || self.on_air[i - 1] != **slot)
            .filter_map(|(_, slot)| slot.transmission())
    }

    /// Puts the messages of each broadcast on air in the order of their receivers.
    pub(crate) fn sort_broadcasts(&mut self) {
        for broadcast in self
            .on_air
            .chunk_by_mut(|a, b| a.broadcast() == b.broadcast())
        {
            broadcast.sort_unstable();
        }
    }

    pub(crate) fn take_off_air(&mut self, transmission: Transmission) {
        let sent = PackedTransmission::of(transmission);
        if let Some(at) = self.on_air.iter().position(|slot| *slot == sent) {
            self.on_air[at] = PackedTransmission::EMPTY;
            self.on_air[at..].rotate_left(1);
        }
    }

    /// Whether one more message can be delayed, where at most `limit` may be.
    pub(crate) fn can_delay(&self, transmission: Transmission, limit: usize) -> bool {
        self.delayed().count() < limit
            && !self.delayed.contains(&PackedTransmission::of(transmission))
    }

    /// Delays a message, if there is room.
    pub(crate) fn delay(&mut self, transmission: Transmission) {
        if let Some(free) = self.delayed.iter_mut().find(|slot| slot.is_empty()) {
            *free = PackedTransmission::of(transmission);
        }
        self.sort();
    }

    /// Takes a delayed message out of the channel.
    pub(crate) fn forget(&mut self, transmission: Transmission) {
        for slot in &mut self.delayed {
            if *slot == PackedTransmission::of(transmission) {
                *slot = PackedTransmission::EMPTY;
            }
        }
        self.sort();
    }

    /// The messages on air, in the order of sending.
    pub(crate) fn on_air(&self) -> impl Iterator<Item = Transmission> {
        self.on_air.iter().map_while(|slot| slot.transmission())
    }

    pub(crate) fn delayed(&self) -> impl Iterator<Item = Transmission> {
        self.delayed.iter().filter_map(|slot| slot.transmission())
    }

    pub(crate) fn messages(&self) -> impl Iterator<Item = u16> {
        let all = self.on_air.iter().chain(&self.delayed);
        all.filter_map(|slot| slot.transmission())
            .map(|transmission| transmission.message)
    }

    pub(crate) fn map(&self, mut replace: impl FnMut(Transmission) -> Transmission) -> Self {
        let mut network = *self;
        for slot in network.on_air.iter_mut().chain(&mut network.delayed) {
            if let Some(transmission) = slot.transmission() {
                *slot = PackedTransmission::of(replace(transmission));
            }
        }
        network.sort();
        network
    }

    fn sort(&mut self) {
        self.delayed.sort_unstable();
    }
}

/// Whether a message can have any effect on the receiver, whatever its state. Every robot within
/// reach hears every message; messages that are ignored in every state are left out of the model.
/// [`universe`](crate::universe) checks that they are ignored.
#[must_use]
pub fn concerns(message: &Message, receiver: StationId) -> bool {
    match message {
        Message::Rmcm(Rmcm::Command(command)) => command.to == receiver,
        Message::Rmcm(Rmcm::Answer(answer)) => answer.session.leader == receiver,
        Message::Ram(Ram {
            coordination,
            farewell,
            ..
        }) => {
            let by_farewell = match farewell {
                None => false,
                Some(Farewell::Ended(..)) => true,
                Some(Farewell::Left(session, _)) => session.leader == receiver,
            };
            let by_coordination = match coordination {
                Coordination::None => false,
                Coordination::NeedHelp { .. } | Coordination::Leader { .. } => true,
                Coordination::OfferHelp { session, .. }
                | Coordination::Follower { session, .. } => session.leader == receiver,
            };
            by_farewell || by_coordination
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn transmission(message: u16) -> Transmission {
        Transmission {
            from: 0,
            to: 1,
            message,
        }
    }

    #[test]
    fn messages_go_off_air_in_the_order_of_sending() {
        let mut network = Network::EMPTY;
        for message in [5, 3, 4] {
            network.send(transmission(message));
        }
        for message in [5, 3, 4] {
            assert_eq!(network.next_on_air(), Some(transmission(message)));
            network.take_off_air(transmission(message));
        }
        assert_eq!(network, Network::EMPTY);
    }

    #[test]
    fn any_receiver_of_the_first_broadcast_may_be_the_next() {
        let to = |to, message| Transmission {
            from: 0,
            to,
            message,
        };
        let mut network = Network::EMPTY;
        // One message twice in a row, then another one.
        for sent in [to(1, 5), to(2, 5), to(1, 5), to(2, 5), to(1, 6)] {
            network.send(sent);
        }
        network.sort_broadcasts();
        assert!(network.first_broadcast().eq([to(1, 5), to(2, 5)]));
        network.take_off_air(to(2, 5));
        assert!(network.first_broadcast().eq([to(1, 5), to(2, 5)]));
        for taken in [to(2, 5), to(1, 5), to(1, 5)] {
            network.take_off_air(taken);
        }
        assert!(network.first_broadcast().eq([to(1, 6)]));
    }

    #[test]
    fn a_network_comes_back_as_it_was_packed() {
        let mut network = Network::EMPTY;
        for (i, message) in (0..).zip([5, 3, 4, 9, 8, 8]) {
            assert_eq!(PackedNetwork::of(&network).unpacked(), network);
            network.send(transmission(message));
            if i % 2 == 0 {
                network.delay(transmission(message));
            }
            network.sent = i;
        }
        assert_eq!(PackedNetwork::of(&network).unpacked(), network);
    }

    #[test]
    fn delayed_messages_are_a_set_with_a_limit() {
        let mut network = Network::EMPTY;
        network.delay(transmission(7));
        assert!(!network.can_delay(transmission(7), 2));
        assert!(network.can_delay(transmission(3), 2));
        let mut other_order = Network::EMPTY;
        other_order.delay(transmission(3));
        other_order.delay(transmission(7));
        network.delay(transmission(3));
        assert_eq!(network, other_order);
        assert!(!network.can_delay(transmission(9), 2));
        network.forget(transmission(3));
        assert!(network.delayed().eq([transmission(7)]));
    }
}
