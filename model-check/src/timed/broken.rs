//! The set of properties that a step breaks.

use crate::properties::{PropertyId, TimedRule};

/// Properties, one bit each.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) struct BrokenSet(u32);

impl BrokenSet {
    pub(super) const NOTHING: Self = Self(0);

    pub(super) const fn add(&mut self, property: PropertyId) {
        self.0 |= property.timed_bit();
    }

    pub(super) const fn has(self, property: PropertyId) -> bool {
        self.0 & property.timed_bit() != 0
    }

    /// Whether a run ends here: what has not come in time might never come.
    pub(super) fn ends_run(self) -> bool {
        let ends = |rule: TimedRule| rule.ends_run;
        self != Self::NOTHING
            && PropertyId::all_timed()
                .filter(|id| self.has(*id))
                .any(|id| id.timed_rule().is_some_and(ends))
    }
}
