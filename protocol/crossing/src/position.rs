//! Whether a body is at its place: a lease that fresh positions renew, and that ends by itself.
//!
//! Errors of the position count against it. No position, an old one, or one that is not newer than the one before renews nothing.

#[cfg(any(test, feature = "laws"))]
pub mod laws;

use crossguard_protocol::Millis;

use crate::ground::Point;
use crate::input::Pose;
use crate::setup::PositionRules;

/// How far off its place a body is, in centimetres.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Off {
    cm: u32,
    error_cm: u16,
}

/// A lease on being at a place.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub struct Presence {
    /// For how long yet it counts as there.
    left: Millis,
    /// Time since the newest position was measured, saturating; `None` before the first.
    newest: Option<Millis>,
    /// Whether the newest position is elsewhere, its error counted in favour of the body.
    is_elsewhere: bool,
}

impl Presence {
    /// Nothing is known.
    pub(crate) const NOWHERE: Self = Self {
        left: Millis::ZERO,
        newest: None,
        is_elsewhere: false,
    };

    /// Lets time pass.
    pub(crate) fn elapse(&mut self, rules: PositionRules, time: Millis) {
        self.left = self.left.saturating_sub(time);
        let oldest = rules.lease.saturating_add(Millis(1));
        self.newest = self.newest.map(|age| age.saturating_add(time).min(oldest));
    }

    /// Takes in where the body is, as measured `age` ago.
    pub(crate) fn learn(
        &mut self,
        rules: PositionRules,
        place: Point,
        pose: Option<Pose>,
        age: Millis,
    ) {
        let off = pose.map(|pose| Off {
            cm: place.distance_cm(pose.at),
            error_cm: pose.error_cm,
        });
        self.take(rules, off, age);
    }

    fn take(&mut self, rules: PositionRules, off: Option<Off>, age: Millis) {
        let Some(off) = off else {
            self.left = Millis::ZERO;
            return;
        };
        if age >= rules.lease || self.newest.is_some_and(|newest| age > newest) {
            return;
        }
        self.newest = Some(age);
        let (error, tolerance) = (u32::from(off.error_cm), u32::from(rules.tolerance_cm));
        self.is_elsewhere = off.cm.saturating_sub(error) > tolerance;
        let is_there = off.cm.saturating_add(error) <= tolerance;
        self.left = if is_there {
            rules.lease.saturating_sub(age)
        } else {
            Millis::ZERO
        };
    }

    /// For how long yet it counts as there.
    #[must_use]
    pub const fn left(self) -> Millis {
        self.left
    }

    /// Whether it is there.
    #[must_use]
    pub const fn is_there(self) -> bool {
        self.left.0 > 0
    }

    /// Whether its newest position holds yet.
    #[must_use]
    pub fn is_fresh(self, rules: PositionRules) -> bool {
        self.newest.is_some_and(|age| age < rules.lease)
    }

    /// Whether its newest position is elsewhere. A body whose position is not known is not.
    #[must_use]
    pub const fn is_elsewhere(self) -> bool {
        self.is_elsewhere
    }
}
