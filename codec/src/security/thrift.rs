//! Limits to the cost of strangers' signatures: failures are remembered, and only so many certificates are new in a
//! second.

use std::collections::{HashSet, VecDeque};
use std::hash::Hash;

use super::time::Time64;

/// How many certificates and messages with a wrong signature are remembered.
pub const REFUSED_MAX: usize = 1_024;

/// The newest of the refused: certificates and messages whose signature is wrong, by their digest.
#[derive(Clone, Debug)]
pub(super) struct Refused<T> {
    known: HashSet<T>,
    /// The same in the order in which they came.
    order: VecDeque<T>,
}

impl<T> Default for Refused<T> {
    fn default() -> Self {
        Self {
            known: HashSet::new(),
            order: VecDeque::new(),
        }
    }
}

impl<T: Copy + Eq + Hash> Refused<T> {
    pub(super) fn contains(&self, it: &T) -> bool {
        self.known.contains(it)
    }

    pub(super) fn remember(&mut self, it: T) {
        if !self.known.insert(it) {
            return;
        }
        if self.order.len() == REFUSED_MAX
            && let Some(oldest) = self.order.pop_front()
        {
            self.known.remove(&oldest);
        }
        self.order.push_back(it);
    }
}

/// How much may yet be spent on strangers: as much as a second brings, at most.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Budget {
    /// Expense that is not made up for, in millionths of a certificate.
    spent: u64,
    /// When that was so.
    at: Time64,
}

impl Budget {
    const CERTIFICATE: u64 = 1_000_000;

    /// Spends one certificate of `per_second` at `now`, if there is one left.
    pub(super) fn spend(&mut self, now: Time64, per_second: u32) -> bool {
        // A clock that is put back makes up for nothing.
        let passed_us = now.0.saturating_sub(self.at.0);
        let made_up = passed_us.saturating_mul(u64::from(per_second));
        self.spent = self.spent.saturating_sub(made_up);
        self.at = now;
        let limit = u64::from(per_second) * Self::CERTIFICATE;
        let is_left = self.spent + Self::CERTIFICATE <= limit;
        if is_left {
            self.spent += Self::CERTIFICATE;
        }
        is_left
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_are_remembered_and_no_more() {
        let mut refused = Refused::default();
        for number in 0..=REFUSED_MAX {
            refused.remember(number);
            refused.remember(number);
        }
        assert_eq!(refused.order.len(), REFUSED_MAX);
        assert_eq!(refused.known.len(), REFUSED_MAX);
        assert!(!refused.contains(&0));
        assert!(refused.contains(&1) && refused.contains(&REFUSED_MAX));
    }

    #[test]
    fn a_second_brings_as_much_as_can_be_spent() {
        let mut budget = Budget::default();
        let mut spent = |at_us, times: u32| {
            let all = (0..times).filter(|_| budget.spend(Time64(at_us), 10));
            all.count()
        };
        assert_eq!(spent(5_000_000, 100), 10);
        assert_eq!(spent(5_099_999, 100), 0);
        assert_eq!(spent(5_200_000, 100), 2);
        // Saved up for a second at most.
        assert_eq!(spent(500_000_000, 100), 10);
        // The clock is put back: nothing is made up for until it goes on.
        assert_eq!(spent(1_000_000, 100), 0);
        assert_eq!(spent(1_100_000, 100), 1);
        assert_eq!(spent(u64::MAX, 100), 10);
    }
}
