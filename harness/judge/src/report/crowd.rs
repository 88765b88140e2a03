//! The people at a crossing: where a robot's sensors had them, when they waited, and the clusters in its RAM.

use std::collections::{BTreeMap, BTreeSet};

use crossguard_robot::sight::{Degrees, Outline, Sight};
use crossguard_robot::zone::Conduct;

use crate::facts::ClusterView;

/// How many places of people, times of waiting and clusters of a robot are kept.
const PLACES: usize = 2_000;
const SPANS: usize = 200;

/// A place of people is drawn once, to about this many degrees: 20 cm.
const GRAIN_DEG: f64 = 2e-6;

/// Something that lasts.
pub(super) struct Span<T> {
    pub(super) from_us: u64,
    /// While it lasts: the newest record, or nothing.
    pub(super) to_us: u64,
    pub(super) what: T,
}

/// What a robot had of the people at its crossing.
#[derive(Default)]
pub(super) struct PeopleRun {
    pub(super) zone: Outline,
    /// Where people were, and what they did there.
    pub(super) places: Vec<(Degrees, Conduct)>,
    drawn: BTreeSet<(i64, i64, Conduct)>,
    /// When people waited, and how many at most.
    pub(super) waiting: Vec<Span<usize>>,
    /// When clusters were announced, and of how many people at most.
    pub(super) announced: Vec<Span<u8>>,
    /// The clusters by id, as they were announced last while somebody waited, or last where nobody did.
    pub(super) clusters: BTreeMap<u8, ClusterView>,
    /// How many people it had at a time, at most.
    pub(super) most: usize,
}

impl PeopleRun {
    pub(super) fn see(&mut self, at_us: u64, sight: &Sight) {
        self.most = self.most.max(sight.people.len());
        lasts(&mut self.waiting, at_us, sight.waiting(), 0);
        for seen in &sight.people {
            let (latitude, longitude) = seen.place;
            #[expect(clippy::cast_possible_truncation, reason = "degrees are few")]
            let grain = |degrees: f64| (degrees / GRAIN_DEG).round() as i64;
            let drawn = (grain(latitude), grain(longitude), seen.conduct);
            if self.places.len() < PLACES && self.drawn.insert(drawn) {
                self.places.push((seen.place, seen.conduct));
            }
        }
    }

    pub(super) fn announce(&mut self, at_us: u64, cluster: Option<ClusterView>) {
        let count = cluster.as_ref().map_or(0, |cluster| cluster.cardinality);
        lasts(&mut self.announced, at_us, count, 0);
        let has_waited = !self.waiting.is_empty();
        let waits = self
            .waiting
            .last()
            .is_some_and(|span| span.to_us == u64::MAX);
        if let Some(cluster) = cluster
            && (waits || !has_waited || !self.clusters.contains_key(&cluster.id))
        {
            self.clusters.insert(cluster.id, cluster);
        }
    }

    /// Nothing more is known.
    pub(super) fn end(&mut self, at_us: u64) {
        lasts(&mut self.waiting, at_us, 0, 0);
        lasts(&mut self.announced, at_us, 0, 0);
    }

    /// All points that it has, to be seen on a map.
    pub(super) fn points(&self) -> impl Iterator<Item = &Degrees> {
        let corners = self.zone.waiting.iter().chain(&self.zone.road);
        let clusters = self.clusters.values().flat_map(|cluster| &cluster.corners);
        corners.chain(clusters)
    }

    /// Whether there is anything to be told.
    pub(super) fn is_empty(&self) -> bool {
        self.most == 0 && self.clusters.is_empty() && self.zone == Outline::default()
    }
}

/// Goes on with a span, whose end is open while it lasts, or begins or ends one.
fn lasts<T: Copy + Ord>(spans: &mut Vec<Span<T>>, at_us: u64, what: T, nothing: T) {
    let has_room = spans.len() < SPANS;
    match spans.last_mut().filter(|span| span.to_us == u64::MAX) {
        Some(open) if what == nothing => open.to_us = at_us,
        Some(open) => open.what = open.what.max(what),
        None if what > nothing && has_room => spans.push(Span {
            from_us: at_us,
            to_us: u64::MAX,
            what,
        }),
        None => {}
    }
}
