//! Which packets have been received before.

use super::Address;

/// How many sequence numbers are remembered of each source (`itsGnDPLLength`).
pub const NUMBERS_MAX: usize = 8;
/// How many sources are remembered; with more, the one that was silent for the longest time is forgotten.
pub const SOURCES_MAX: usize = 64;
/// How long a source is remembered, in milliseconds (`itsGnLifetimeLocTE`).
const LIFETIME_MS: u64 = 20_000;

/// The newest sequence numbers of the newest sources.
#[derive(Clone, Debug)]
pub struct Duplicates {
    sources: [Option<SourceHistory>; SOURCES_MAX],
}

#[derive(Clone, Copy, Debug)]
struct SourceHistory {
    address: Address,
    /// When its newest packet came, as `TimestampIts`.
    heard_ms: u64,
    numbers: [Option<u16>; NUMBERS_MAX],
    /// Where the next number goes.
    next: usize,
}

impl Default for Duplicates {
    fn default() -> Self {
        Self {
            sources: [None; SOURCES_MAX],
        }
    }
}

impl Duplicates {
    /// Whether a packet of `address` with this number has been received before; it has been, from now on.
    pub fn check(&mut self, address: Address, number: u16, now_ms: u64) -> bool {
        let source = self.source(address, now_ms);
        source.heard_ms = now_ms;
        if source.numbers.contains(&Some(number)) {
            return true;
        }
        source.numbers[source.next] = Some(number);
        source.next = (source.next + 1) % NUMBERS_MAX;
        false
    }

    /// The record of a source, which may be new.
    fn source(&mut self, address: Address, now_ms: u64) -> &mut SourceHistory {
        let is_it = |source: &Option<SourceHistory>| {
            source.is_some_and(|source| {
                source.address == address && now_ms.saturating_sub(source.heard_ms) < LIFETIME_MS
            })
        };
        let index = self.sources.iter().position(is_it).unwrap_or_else(|| {
            // A place that is free, or was not used for the longest time. There always is one.
            let age = |index: &usize| self.sources[*index].map(|source| source.heard_ms);
            let index = (0..SOURCES_MAX).min_by_key(age).unwrap_or(0);
            self.sources[index] = None;
            index
        });
        self.sources[index].get_or_insert(SourceHistory {
            address,
            heard_ms: now_ms,
            numbers: [None; NUMBERS_MAX],
            next: 0,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn station(id: u32) -> Address {
        Address::of_station(id, 5)
    }

    #[test]
    fn a_number_counts_once_for_each_source() {
        let mut duplicates = Duplicates::default();
        assert!(!duplicates.check(station(1), 7, 0));
        assert!(duplicates.check(station(1), 7, 1));
        assert!(!duplicates.check(station(2), 7, 2));
        assert!(!duplicates.check(station(1), 8, 3));
    }

    #[test]
    fn the_oldest_of_eight_numbers_is_forgotten_and_the_source_after_twenty_seconds() {
        let mut duplicates = Duplicates::default();
        for number in 0..9 {
            assert!(!duplicates.check(station(1), number, 0));
        }
        assert!(duplicates.check(station(1), 8, 0));
        assert!(duplicates.check(station(1), 1, 0));
        assert!(!duplicates.check(station(1), 0, 0));
        assert!(!duplicates.check(station(1), 8, 20_000));
    }

    #[test]
    fn a_flood_of_sources_takes_no_more_room() {
        let mut duplicates = Duplicates::default();
        for id in 0..10_000 {
            assert!(!duplicates.check(station(id), 1, id.into()));
        }
        // The last ones are remembered.
        assert!(duplicates.check(station(9_999), 1, 10_000));
        assert!(duplicates.check(station(9_999 - 60), 1, 10_000));
        assert!(!duplicates.check(station(1), 1, 10_000));
    }
}
