//! One worker: it keeps the states that it owns, and expands them.

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering};

use crossguard_model_check::check::ExplorationLimits;
use crossguard_model_check::model::portable::{
    Class, Fingerprints, PackedState, Packer, Part, Unpacker,
};
use crossguard_model_check::model::{Action, Model, ModelState};
use crossguard_model_check::properties::PropertyId;
use crossguard_model_check::report::CutOff;
use serde::{Deserialize, Serialize};

use crate::report::whole;
use crate::table::{Fingerprint, Hint, Table};
use crate::waiting::Queue;

/// A state on its way to the worker that owns it.
#[derive(Clone, Serialize, Deserialize)]
pub(crate) struct Found {
    sighting: Sighting,
    sender: u32,
    cargo: Cargo,
}

#[derive(Clone, Copy, Serialize, Deserialize)]
struct Sighting {
    fingerprint: Fingerprint,
    from: Hint,
    /// How many states it stands for.
    class: u16,
}

impl Sighting {
    /// Of a class that was found from the state that this hint means.
    fn of(class: &Class, from: Hint) -> Self {
        Self {
            fingerprint: Fingerprint::of(class.fingerprint),
            from,
            class: class.size,
        }
    }
}

impl Found {
    /// The number that decides which worker it goes to.
    pub(crate) const fn share(&self) -> u64 {
        self.sighting.fingerprint.share()
    }
}

#[derive(Clone, Serialize, Deserialize)]
enum Cargo {
    /// To another process, with the parts that were not sent there before.
    Abroad(Box<(PackedState, Vec<Part>)>),
    /// Within the process, where all share the numbers of parts. The last one: serde numbers variants that it
    /// skips when it writes, and not when it reads.
    #[serde(skip)]
    Here(ModelState),
}

pub(crate) struct Common {
    pub(crate) model: Model,
    /// Properties that states and steps can be judged by.
    pub(crate) judged: Vec<PropertyId>,
    pub(crate) workers: usize,
    /// When the workers of this process give up.
    pub(crate) limits: ExplorationLimits,
    pub(crate) counters: Counters,
}

#[derive(Default)]
pub(crate) struct Counters {
    pub(crate) states: AtomicU64,
    pub(crate) level: AtomicU32,
    pub(crate) table_bytes: AtomicU64,
}

#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Told {
    pub(crate) states: u64,
    /// The states that these stand for.
    pub(crate) of_classes: u64,
    pub(crate) transitions: u64,
    pub(crate) depth: u32,
    pub(crate) table_bytes: u64,
    /// Of the judged properties: whether the premise was met in this process.
    pub(crate) premises: Vec<bool>,
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

pub(crate) struct Explorer {
    common: Arc<Common>,
    index: usize,
    peers: usize,
    fingerprints: Fingerprints,
    pub(crate) table: Table,
    /// States that wait to be expanded, by level.
    waiting: BTreeMap<u32, Queue>,
    packers: HashMap<usize, Packer>,
    unpackers: HashMap<u32, Unpacker>,
    sent_last: Vec<Option<Fingerprint>>,
    told: Told,
    /// How many of its states all threads know of.
    counted: u64,
    actions: Vec<Action>,
    /// States that come after others.
    successors: Vec<(ModelState, Sighting)>,
}

impl Explorer {
    pub(crate) fn new(common: &Arc<Common>, index: usize, peers: usize) -> Self {
        let told = Told {
            premises: vec![false; common.judged.len()],
            broken: vec![None; common.judged.len()],
            ..Told::default()
        };
        Self {
            common: Arc::clone(common),
            index,
            peers,
            fingerprints: Fingerprints::default(),
            table: Table::new(),
            waiting: BTreeMap::new(),
            packers: HashMap::new(),
            unpackers: HashMap::new(),
            sent_last: vec![None; REMEMBERED],
            told,
            counted: 0,
            actions: Vec::new(),
            successors: Vec::new(),
        }
    }

    /// Begins with the state in which every run begins, if it owns that one.
    pub(crate) fn begin(&mut self) {
        let model = &self.common.model;
        let class = self.fingerprints.class(model, model.initial());
        let from = Fingerprint::of(class.fingerprint).hint();
        let sighting = Sighting::of(&class, from);
        if self.owner(sighting) == self.index {
            self.add(class.state, sighting, 0);
        }
    }

    fn owner(&self, sighting: Sighting) -> usize {
        usize::try_from(sighting.fingerprint.share() % self.peers as u64)
            .expect("less than the peers")
    }

    fn on_its_way(&mut self, state: ModelState, sighting: Sighting, owner: usize) -> Found {
        let is_here = owner / self.common.workers == self.index / self.common.workers;
        let cargo = if is_here {
            Cargo::Here(state)
        } else {
            let mut news = Vec::new();
            let packer = self.packers.entry(owner).or_default();
            let state = packer.pack(&self.common.model, &state, &mut news);
            Cargo::Abroad(Box::new((state, news)))
        };
        Found {
            sighting,
            sender: u32::try_from(self.index).expect("few workers"),
            cargo,
        }
    }

    /// Takes in states that were found at this level. Panics where one cannot be read, since another process sent
    /// nonsense: that ends the check as incomplete.
    pub(crate) fn receive(&mut self, found: &mut Vec<Found>, level: u32) {
        self.table
            .fetch(found.iter().map(|found| found.sighting.fingerprint));
        for found in found.drain(..) {
            self.receive_one(found, level);
        }
    }

    fn receive_one(&mut self, found: Found, level: u32) {
        let Found {
            sighting,
            sender,
            cargo,
        } = found;
        match cargo {
            Cargo::Here(state) => self.add(state, sighting, level),
            Cargo::Abroad(abroad) => {
                let (packed, news) = *abroad;
                let unpacker = self.unpackers.entry(sender).or_default();
                let model = &self.common.model;
                for part in &news {
                    let learned = unpacker.learn(model, part);
                    learned.unwrap_or_else(|cause| panic!("{cause}"));
                }
                let state = unpacker.unpack(model, packed);
                let state = state.unwrap_or_else(|cause| panic!("{cause}"));
                self.add(state, sighting, level);
            }
        }
    }

    fn add(&mut self, state: ModelState, sighting: Sighting, level: u32) {
        let Sighting {
            fingerprint,
            from,
            class,
        } = sighting;
        if self.told.cut_off.is_some() || !self.table.insert(fingerprint, level, from) {
            return;
        }
        self.told.states += 1;
        self.told.of_classes += u64::from(class);
        self.told.depth = self.told.depth.max(level);
        for broken in self.common.model.broken_by(&state) {
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

    /// Expands some of the states of a level. Their successors that others own are sent.
    pub(crate) fn expand(&mut self, level: u32, send: &mut dyn FnMut(Found)) {
        self.count(level);
        self.give_up_where_asked();
        let Some(mut waiting) = self.waiting.remove(&level) else {
            return;
        };
        let common = Arc::clone(&self.common);
        for _ in 0..BITE / TOGETHER {
            for (state, from) in (0..TOGETHER).map_while(|_| waiting.pop()) {
                self.find_successors(&common.model, &state, from);
            }
            self.pass_on_successors(level + 1, send);
        }
        if !waiting.is_empty() {
            self.waiting.insert(level, waiting);
        }
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

    fn find_successors(&mut self, model: &Model, state: &ModelState, from: Hint) {
        let mut actions = std::mem::take(&mut self.actions);
        actions.clear();
        model.actions_in(state, &mut actions);
        let begin = self.successors.len();
        for &action in &actions {
            if let Some(class) = self.fingerprints.successor(model, state, action) {
                let sighting = Sighting::of(&class, from);
                let mut found = self.successors[begin..].iter();
                if found.all(|(_, known)| known.fingerprint != sighting.fingerprint) {
                    self.successors.push((class.state, sighting));
                }
            }
        }
        self.told.transitions += (self.successors.len() - begin) as u64;
        self.actions = actions;
    }

    /// Adds the successors that were found, or sends them to their owners.
    fn pass_on_successors(&mut self, level: u32, send: &mut dyn FnMut(Found)) {
        let mut successors = std::mem::take(&mut self.successors);
        let sightings = successors.iter().map(|(_, sighting)| *sighting);
        let own = sightings.filter(|sighting| self.owner(*sighting) == self.index);
        self.table.fetch(own.map(|sighting| sighting.fingerprint));
        for (state, sighting) in successors.drain(..) {
            let owner = self.owner(sighting);
            if owner == self.index {
                self.add(state, sighting, level);
            } else if !self.was_just_sent(sighting.fingerprint) {
                send(self.on_its_way(state, sighting, owner));
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

    pub(crate) fn told(&self) -> Told {
        let judged = self.common.judged.iter();
        Told {
            premises: judged
                .map(|property| self.common.model.premise_met(*property))
                .zip(&self.told.premises)
                .map(|(now, before)| now || *before)
                .collect(),
            table_bytes: self.table.bytes() as u64,
            ..self.told.clone()
        }
    }
}
