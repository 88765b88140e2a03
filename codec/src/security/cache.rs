//! The tickets of other stations, and what was heard under each: bounded, and safe against replays
//! also where something had to be forgotten.

use std::collections::{HashMap, VecDeque};

use super::certificate::Certificate;
use super::crypto::Digest;
use super::hashed_id::HashedId8;
use super::rejected::Rejected;
use super::time::Time64;

/// How many tickets are remembered.
pub const TICKETS_MAX: usize = 256;
/// How many messages are remembered of each; a robot sends fewer in the 2 s that a message is fresh.
pub const MESSAGES_MAX: usize = 128;

/// The tickets of other stations, by id.
#[derive(Clone, Debug, Default)]
pub(super) struct Cache {
    tickets: HashMap<HashedId8, Known>,
    /// Under tickets that were forgotten, messages up to this time may have been heard.
    forgotten: Time64,
    /// Counts up with every message.
    clock: u64,
}

/// A ticket whose chain has been checked, and what was heard under it.
#[derive(Clone, Debug)]
struct Known {
    ticket: Certificate,
    heard: VecDeque<(Time64, [u8; 8])>,
    /// Messages up to this time that are not among `heard` may have been heard.
    forgotten: Time64,
    used: u64,
}

/// The first octets of a digest. A station that could find two messages with the same could only
/// have its own second one ignored.
fn short(digest: &Digest) -> [u8; 8] {
    let mut octets = [0; 8];
    octets.copy_from_slice(&digest[..8]);
    octets
}

impl Cache {
    pub(super) fn ticket(&self, id: HashedId8) -> Option<&Certificate> {
        self.tickets.get(&id).map(|known| &known.ticket)
    }

    pub(super) fn len(&self) -> usize {
        self.tickets.len()
    }

    /// Whether a message may have been heard already.
    pub(super) fn check(
        &self,
        id: HashedId8,
        generated: Time64,
        digest: &Digest,
    ) -> Result<(), Rejected> {
        let (forgotten, is_known) = match self.tickets.get(&id) {
            Some(known) => {
                let message = (generated, short(digest));
                (known.forgotten, known.heard.contains(&message))
            }
            None => (self.forgotten, false),
        };
        if is_known || generated <= forgotten {
            return Err(Rejected::Replayed);
        }
        Ok(())
    }

    /// Remembers a message that was verified. What was generated before `fresh` need not be
    /// remembered, because it will be rejected as too old.
    pub(super) fn remember(
        &mut self,
        ticket: &Certificate,
        generated: Time64,
        digest: &Digest,
        fresh: Time64,
    ) {
        let id = ticket.id();
        if !self.tickets.contains_key(&id) && self.tickets.len() == TICKETS_MAX {
            self.forget_oldest();
        }
        self.clock += 1;
        let known = self.tickets.entry(id).or_insert_with(|| Known {
            ticket: ticket.clone(),
            heard: VecDeque::new(),
            forgotten: self.forgotten,
            used: 0,
        });
        known.used = self.clock;
        known.heard.retain(|(generated, _)| *generated >= fresh);
        if known.heard.len() == MESSAGES_MAX
            && let Some((dropped, _)) = known.heard.pop_front()
        {
            known.forgotten = known.forgotten.max(dropped);
        }
        known.heard.push_back((generated, short(digest)));
    }

    fn forget_oldest(&mut self) {
        let oldest = self.tickets.iter().min_by_key(|(_, known)| known.used);
        let Some(id) = oldest.map(|(id, _)| *id) else {
            return;
        };
        if let Some(known) = self.tickets.remove(&id) {
            let newest = known.heard.iter().map(|(generated, _)| *generated).max();
            let newest = newest.unwrap_or_default().max(known.forgotten);
            self.forgotten = self.forgotten.max(newest);
        }
    }
}
