//! One worker: it keeps the states that it owns, and expands them.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering};

use crossguard_model_check::check::ExplorationLimits;
use crossguard_model_check::model::{Action, Model, ModelState};
use crossguard_model_check::properties::PropertyId;
use crossguard_model_check::report::CutOff;

use crate::report::whole;
use crate::table::{Fingerprint, Hint, Table};
use crate::waiting::Queue;

/// A state that was found, with its fingerprint and a hint at the state that it was found from.
pub(crate) struct Found {
    state: ModelState,
    fingerprint: Fingerprint,
    from: Hint,
}

pub(crate) struct Common {
    pub(crate) model: Model,
    /// Properties that states and steps can be judged by.
    pub(crate) judged: Vec<PropertyId>,
    pub(crate) workers: usize,
    /// When the workers give up.
    pub(crate) limits: ExplorationLimits,
    pub(crate) counters: Counters,
}

#[derive(Default)]
pub(crate) struct Counters {
    pub(crate) states: AtomicU64,
    pub(crate) level: AtomicU32,
    pub(crate) table_bytes: AtomicU64,
}

#[derive(Debug, Default)]
pub(crate) struct Told {
    pub(crate) states: u64,
    /// The states that these stand for.
    pub(crate) of_classes: u64,
    pub(crate) transitions: u64,
    pub(crate) depth: u32,
    pub(crate) table_bytes: u64,
    /// Of the judged properties: the first state that breaks it.
    pub(crate) broken: Vec<Option<(u32, Fingerprint)>>,
    pub(crate) cut_off: Option<CutOff>,
}

/// How many fingerprints a worker remembers of the states that it has sent last.
const REMEMBERED: usize = 1 << 16;

/// How many steps of states a worker takes between two looks at what has arrived.
pub(crate) const BITE: usize = 2_000;

/// Of how many states the successors are looked up together.
const TOGETHER: usize = 20;

pub(crate) struct Explorer<'a> {
    common: &'a Common,
    index: usize,
    table: Table,
    /// States that wait to be expanded, by level.
    waiting: BTreeMap<u32, Queue>,
    sent_last: Vec<Option<Fingerprint>>,
    told: Told,
    /// How many of its states all threads know of.
    counted: u64,
    actions: Vec<Action>,
    /// States that come after others.
    successors: Vec<Found>,
}

impl<'a> Explorer<'a> {
    pub(crate) fn new(common: &'a Common, index: usize) -> Self {
        let told = Told {
            broken: vec![None; common.judged.len()],
            ..Told::default()
        };
        Self {
            common,
            index,
            table: Table::new(),
            waiting: BTreeMap::new(),
            sent_last: vec![None; REMEMBERED],
            told,
            counted: 0,
            actions: Vec::new(),
            successors: Vec::new(),
        }
    }

    /// Begins with the state in which every run begins, if it owns that one.
    pub(crate) fn begin(&mut self) {
        let state = self.common.model.initial();
        let fingerprint = Fingerprint::of(&state);
        let from = fingerprint.hint();
        if self.owner(fingerprint) == self.index {
            let first = Found {
                state,
                fingerprint,
                from,
            };
            self.add(first, 0);
        }
    }

    fn owner(&self, fingerprint: Fingerprint) -> usize {
        usize::try_from(fingerprint.share() % self.common.workers as u64)
            .expect("less than the workers")
    }

    /// Takes in states that were found for this level.
    pub(crate) fn receive(&mut self, found: Vec<Found>, level: u32) {
        self.table
            .fetch(found.iter().map(|found| found.fingerprint));
        for found in found {
            self.add(found, level);
        }
    }

    fn add(&mut self, found: Found, level: u32) {
        let Found {
            state,
            fingerprint,
            from,
        } = found;
        if self.told.cut_off.is_some() || !self.table.insert(fingerprint, level, from) {
            return;
        }
        let model = &self.common.model;
        self.told.states += 1;
        self.told.of_classes += model.class_size(&state) as u64;
        self.told.depth = self.told.depth.max(level);
        for broken in model.broken_by(&state) {
            let judged = self.common.judged.iter().zip(&mut self.told.broken);
            for (_, first) in judged.filter(|(id, _)| **id == broken) {
                let found = (level, fingerprint);
                *first = Some(first.map_or(found, |known| known.min(found)));
            }
        }
        let waiting = self.waiting.entry(level).or_default();
        waiting.push((state, fingerprint.hint()));
    }

    /// Whether states of this level wait to be expanded.
    pub(crate) fn waits_at(&self, level: u32) -> bool {
        self.waiting.contains_key(&level)
    }

    /// Expands some of the states of a level. Their successors that others own, by owner.
    pub(crate) fn expand(&mut self, level: u32) -> Vec<Vec<Found>> {
        let mut to_all: Vec<_> = (0..self.common.workers).map(|_| Vec::new()).collect();
        self.count(level);
        self.give_up_where_asked();
        let Some(mut waiting) = self.waiting.remove(&level) else {
            return to_all;
        };
        for _ in 0..BITE / TOGETHER {
            for (state, from) in (0..TOGETHER).map_while(|_| waiting.pop()) {
                self.find_successors(&state, from);
            }
            self.pass_on_successors(level + 1, &mut to_all);
        }
        if !waiting.is_empty() {
            self.waiting.insert(level, waiting);
        }
        to_all
    }

    /// Counts what is new, for all threads to see. Not with each state: threads that count at the same place wait for
    /// each other.
    fn count(&mut self, level: u32) {
        let counters = &self.common.counters;
        counters.level.fetch_max(level, Ordering::Relaxed);
        let states = self.told.states;
        let new = states - std::mem::replace(&mut self.counted, states);
        counters.states.fetch_add(new, Ordering::Relaxed);
        let bytes = self.table.bytes() as u64;
        let grown = bytes - std::mem::replace(&mut self.told.table_bytes, bytes);
        counters.table_bytes.fetch_add(grown, Ordering::Relaxed);
    }

    fn find_successors(&mut self, state: &ModelState, from: Hint) {
        let model = &self.common.model;
        self.actions.clear();
        model.actions_in(state, &mut self.actions);
        let begin = self.successors.len();
        for &action in &self.actions {
            let Some((state, _)) = model.successor_up_to_symmetry(state, action) else {
                continue;
            };
            let fingerprint = Fingerprint::of(&state);
            let mut found = self.successors[begin..].iter();
            if found.all(|known| known.fingerprint != fingerprint) {
                self.successors.push(Found {
                    state,
                    fingerprint,
                    from,
                });
            }
        }
        self.told.transitions += (self.successors.len() - begin) as u64;
    }

    /// Adds the successors that were found, or puts them among those of their owners.
    fn pass_on_successors(&mut self, level: u32, to_all: &mut [Vec<Found>]) {
        let mut successors = std::mem::take(&mut self.successors);
        let found = successors.iter().map(|found| found.fingerprint);
        let own = found.filter(|fingerprint| self.owner(*fingerprint) == self.index);
        self.table.fetch(own);
        for found in successors.drain(..) {
            let owner = self.owner(found.fingerprint);
            if owner == self.index {
                self.add(found, level);
            } else if !self.was_just_sent(found.fingerprint) {
                to_all[owner].push(found);
            }
        }
        self.successors = successors;
    }

    /// Whether the state was sent not long ago; it counts as sent from now on. Its owner knows it then, at this
    /// level or one before.
    fn was_just_sent(&mut self, fingerprint: Fingerprint) -> bool {
        let at = usize::try_from(fingerprint.share() >> 20).unwrap_or_default() % REMEMBERED;
        self.sent_last[at].replace(fingerprint) == Some(fingerprint)
    }

    fn give_up_where_asked(&mut self) {
        let (limits, counters) = (&self.common.limits, &self.common.counters);
        let states = whole(counters.states.load(Ordering::Relaxed));
        let is_full = limits.states_reached(states);
        let cut_off = (limits.time_reached()).or(is_full.then_some(CutOff::StateLimit));
        if cut_off.is_some() {
            self.told.cut_off = self.told.cut_off.or(cut_off);
            self.waiting.clear();
        }
    }

    /// What there is to tell in the end, and the table.
    pub(crate) fn ended(self) -> (Told, Table) {
        let table_bytes = self.table.bytes() as u64;
        let told = Told {
            table_bytes,
            ..self.told
        };
        (told, self.table)
    }
}
