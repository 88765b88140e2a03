//! The stations, objects and clusters that a robot had on its map, in numbers.

use crossguard_codec::its::Kind;
use crossguard_robot::around::{Around, Nearest};

/// What a robot had of a kind.
#[derive(Clone, Copy)]
pub(super) struct KindRun {
    pub(super) kind: Kind,
    /// How many at a time, at most.
    pub(super) most: usize,
    /// Who came nearest, and when, in µs since 1970.
    pub(super) nearest: Option<(Nearest, u64)>,
    /// The longest time for which one was kept without being told of again.
    pub(super) oldest_ms: u64,
    /// The first and the last time that it had one, in µs since 1970.
    pub(super) from_us: u64,
    pub(super) to_us: u64,
}

/// What a robot had on its map.
#[derive(Default)]
pub(super) struct AroundRun(pub(super) Vec<KindRun>);

impl AroundRun {
    pub(super) fn see(&mut self, at_us: u64, around: &Around) {
        for now in &around.kinds {
            let place = self.0.iter().position(|it| it.kind == now.kind);
            let place = place.unwrap_or_else(|| {
                self.0.push(KindRun {
                    kind: now.kind,
                    most: 0,
                    nearest: None,
                    oldest_ms: 0,
                    from_us: at_us,
                    to_us: at_us,
                });
                self.0.len() - 1
            });
            let known = &mut self.0[place];
            known.most = known.most.max(now.count);
            known.oldest_ms = known.oldest_ms.max(now.oldest_ms);
            known.to_us = at_us;
            if let Some(nearest) = now.nearest
                && known
                    .nearest
                    .is_none_or(|(before, _)| nearest.distance_m < before.distance_m)
            {
                known.nearest = Some((nearest, at_us));
            }
        }
    }
}
