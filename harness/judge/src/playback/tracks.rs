//! Facts of a robot over time.

use std::collections::BTreeMap;

use crossguard_endpoint::counters::CauseName;
use crossguard_protocol::{StationId, Timer};
use crossguard_robot::sight::{Outline, Sight};

use crate::facts::{Area, ClusterView, Fact, Placed, View};

/// How many causes of drops of a robot are kept.
const CAUSES_MAX: usize = 200;

/// Values of something, each with the time from which it holds.
pub(super) struct Series<T>(Vec<(u64, T)>);

impl<T> Default for Series<T> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<T> Series<T> {
    /// It is this from now on. Records of another clock may be late; they count from the newest on.
    pub(super) fn push(&mut self, at_us: u64, what: T) {
        let newest = self.0.last().map_or(0, |(newest, _)| *newest);
        self.0.push((at_us.max(newest), what));
    }

    /// Its value at a time, and since when.
    pub(super) fn at(&self, at_us: u64) -> Option<&(u64, T)> {
        let next = self.0.partition_point(|(since, _)| *since <= at_us);
        next.checked_sub(1).map(|place| &self.0[place])
    }

    /// Its new values in a stretch of time.
    pub(super) fn within(&self, from_us: u64, to_us: u64) -> &[(u64, T)] {
        let first = self.0.partition_point(|(since, _)| *since < from_us);
        let end = self.0.partition_point(|(since, _)| *since <= to_us);
        &self.0[first.min(end)..end]
    }

    pub(super) fn first(&self) -> Option<&T> {
        self.0.first().map(|(_, what)| what)
    }

    pub(super) fn last(&self) -> Option<&T> {
        self.0.last().map(|(_, what)| what)
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &(u64, T)> {
        self.0.iter()
    }
}

/// A time in which a corridor was open.
pub(super) struct Open {
    pub(super) from_us: u64,
    /// `None` while it lasts.
    pub(super) to_us: Option<u64>,
    pub(super) why: String,
}

/// Facts of a robot over time.
#[derive(Default)]
pub(super) struct Track {
    pub(super) name: String,
    pub(super) stations: Vec<StationId>,
    pub(super) boots: Vec<u16>,
    pub(super) views: Series<View>,
    /// The armed timers with the milliseconds that they had left.
    pub(super) timers: Series<Box<[(Timer, u32)]>>,
    pub(super) places: Series<Box<Placed>>,
    pub(super) sights: Series<Sight>,
    pub(super) clusters: Series<Option<ClusterView>>,
    pub(super) areas: Series<Vec<Area>>,
    pub(super) zone: Series<Outline>,
    /// For how many milliseconds the sign shows go.
    pub(super) sign: Series<Option<u32>>,
    pub(super) is_running: Series<bool>,
    pub(super) drops: BTreeMap<CauseName, Series<u64>>,
    pub(super) corridor: Vec<Open>,
    /// The counts of the boots before.
    before: BTreeMap<CauseName, u64>,
}

impl Track {
    pub(super) fn new(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            ..Self::default()
        }
    }

    pub(super) fn take(&mut self, at_us: u64, fact: Fact) {
        match fact {
            Fact::Started { station, boot } => {
                if self.boots.last() != Some(&boot) {
                    self.boots.push(boot);
                }
                self.is(station);
                self.is_running.push(at_us, true);
                self.timers.push(at_us, Box::default());
                let counts = self.drops.iter().map(|(cause, series)| {
                    let count = series.last().copied().unwrap_or(0);
                    (cause.clone(), count)
                });
                self.before = counts.collect();
            }
            Fact::State(view) => {
                self.is(view.station);
                self.views.push(at_us, view);
            }
            Fact::Place(placed) => self.places.push(at_us, placed),
            Fact::Areas(areas) => self.areas.push(at_us, areas),
            Fact::Zone(outline) => self.zone.push(at_us, outline),
            Fact::People(sight) => self.sights.push(at_us, sight),
            Fact::Cluster(cluster) => self.clusters.push(at_us, cluster),
            Fact::Counted { cause, count } => {
                let before = self.before.get(&cause).copied().unwrap_or(0);
                if self.drops.contains_key(&cause) || self.drops.len() < CAUSES_MAX {
                    let series = self.drops.entry(cause).or_default();
                    series.push(at_us, before.saturating_add(count));
                }
            }
            Fact::Stopped => {
                self.is_running.push(at_us, false);
                self.timers.push(at_us, Box::default());
            }
            Fact::Step { .. }
            | Fact::Around(_)
            | Fact::Message(_)
            | Fact::Note { .. }
            | Fact::Corridor { .. } => {}
        }
    }

    fn is(&mut self, station: StationId) {
        if !self.stations.contains(&station) {
            self.stations.push(station);
        }
    }

    /// The corridor is open from now on, or no longer.
    pub(super) fn corridor(&mut self, at_us: u64, is_open: bool, why: String) {
        if is_open {
            self.corridor.push(Open {
                from_us: at_us,
                to_us: None,
                why: String::new(),
            });
            return;
        }
        self.sign.push(at_us, None);
        if let Some(open) = self.corridor.last_mut() {
            open.to_us = Some(at_us);
            open.why = if why.is_empty() {
                "robot lost power".to_owned()
            } else {
                why
            };
        }
    }
}
