//! The monotone channel: every message that was ever sent may arrive at any later time, any number of
//! times, in any order.
//!
//! The channel is the *set* of all messages ever sent, one per receiver. To send is to add to the set; to
//! deliver takes nothing away. So nothing is decided when a message is sent: to be heard at once, late,
//! again, or never are all deliveries of the set, or the lack of them. For any `k`, this channel allows
//! everything that `delayed = k` allows, as far as the bounds below go.
//!
//! # Why it is finite
//!
//! * The set holds each message once, so to repeat what was said before adds nothing. Names are ranked as
//!   everywhere; as the set keeps all of them, ranks close no gaps here.
//! * What a run adds without end must be bounded: heartbeats, which a leader counts once a period, and
//!   offers, which a helper numbers anew whenever an old request reaches it once more. A scenario says how
//!   often a RAM timer may change its robot ([`heartbeats`](crate::scenario::Bounds::heartbeats)) and how often a message may make a
//!   robot offer ([`offers`](crate::scenario::Bounds::offers)). Beyond that the timer does not expire, and the message is not
//!   heard. The first is a bound of the exploration, like that on commands; the second is something the
//!   channel may do anyway.
//! * Messages to a robot that is down for good are dropped: no robot will hear them, so that is exact.
//!   Nothing else is dropped, and nothing is merged.
//!
//! # What is claimed of runs
//!
//! Nothing is assumed about arrival: a message of the set may never arrive. So progress is by timers and
//! applications alone: I12 asks for a timer that changes the state, L7 for a way to idle without any
//! message, and L1, L2, L4 and L5 rely on timers, which are weakly fair as ever. L3 assumes that messages arrive, and
//! `cooperative` with it. L6 does not hold of such a channel: two old requests that arrive in turn make two
//! robots offer in turn, for ever, and only the bound on offers would hide it. Both are refused.

use std::sync::Arc;

use crate::canonical::Renamings;
use crate::intern::Interner;
use crate::memo::Memo;
use crate::robots::Robots;
use crate::transmission::{PackedTransmission, Transmission};

/// A set of messages, each with its way, in order.
type Set = Box<[PackedTransmission]>;

/// All sets of messages that have occurred.
pub(crate) struct Sets {
    known: Interner<Set>,
    /// Numbers of sets with one more message.
    with: Memo<(u32, PackedTransmission), u32>,
}

impl Sets {
    pub(crate) const EMPTY: u32 = 0;

    pub(crate) fn new(renamings: &Arc<Renamings>) -> Self {
        let sets = Interner::new(renamings);
        let empty = sets.number_nameless(Set::default());
        debug_assert_eq!(empty, Self::EMPTY);
        Self {
            known: sets,
            with: Memo::default(),
        }
    }

    pub(crate) fn transmissions(&self, set: u32) -> impl Iterator<Item = Transmission> {
        let slots = self.known.value(set).iter();
        slots.filter_map(|slot| slot.transmission())
    }

    pub(crate) fn names(&self, set: u32) -> u32 {
        self.known.names(set)
    }

    pub(crate) fn with(&self, set: u32, message: Transmission, robots: &Robots) -> u32 {
        let message = PackedTransmission::of(message);
        let slots = self.known.value(set);
        let Err(at) = slots.binary_search(&message) else {
            return set;
        };
        let with = self.with.get_or_compute((set, message), |_| {
            let mut slots = slots.to_vec();
            slots.insert(at, message);
            self.number(slots.into(), robots)
        });
        *with
    }

    pub(crate) fn without(&self, set: u32, receiver: usize, robots: &Robots) -> u32 {
        let stays = |sent: &Transmission| usize::from(sent.to) != receiver;
        let left = self.transmissions(set).filter(stays);
        self.number(left.map(PackedTransmission::of).collect(), robots)
    }

    /// A set after the renaming of this number, which `message` carries out on one message.
    pub(crate) fn renamed(
        &self,
        set: u32,
        renaming: u32,
        message: impl Fn(u16) -> u16,
        robots: &Robots,
    ) -> u32 {
        self.known.renamed_by(set, renaming, || {
            self.map(set, robots, |sent| Transmission {
                message: message(sent.message),
                ..sent
            })
        })
    }

    pub(crate) fn map(
        &self,
        set: u32,
        robots: &Robots,
        replace: impl Fn(Transmission) -> Transmission,
    ) -> u32 {
        let mut slots: Vec<PackedTransmission> = self
            .transmissions(set)
            .map(|sent| PackedTransmission::of(replace(sent)))
            .collect();
        slots.sort_unstable();
        slots.dedup();
        self.number(slots.into(), robots)
    }

    fn number(&self, set: Set, robots: &Robots) -> u32 {
        self.known.number_with(set, |set| {
            let messages = set.iter().filter_map(|slot| slot.transmission());
            robots
                .renamings
                .union(messages.map(|sent| robots.message_names(sent.message)))
        })
    }
}
