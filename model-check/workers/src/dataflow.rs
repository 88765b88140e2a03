//! The dataflow: a loop in which each round is one level of the exploration, and rounds of messages from all to all.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::rc::Rc;
use std::sync::Arc;
use std::time::{Duration, Instant};

use timely::ExchangeData;
use timely::dataflow::channels::pact::Exchange as ExchangePact;
use timely::dataflow::operators::{
    Capability, ConnectLoop, Exchange, Feedback, Inspect, Operator, Probe, ToStream,
};
use timely::worker::Worker;

use crate::checkpoint::{Keeping, Store};
use crate::explorer::{Common, Explorer, Found, Told};
use crate::table::{Fingerprint, Hint, Table};

/// Explores level by level, and keeps what was found now and then.
struct Keeper<'a> {
    common: &'a Common,
    store: &'a Store,
    every: Duration,
}

impl<'a> Keeper<'a> {
    fn of(common: &'a Common, keeping: &'a Keeping, worker: usize) -> Self {
        Self {
            common,
            store: &keeping.stores[worker % common.workers],
            every: keeping.every,
        }
    }

    fn explore(&self, worker: &mut Worker, explorer: &Rc<RefCell<Explorer>>) {
        let mut level = self.resume(worker, explorer);
        let mut last = Instant::now();
        let is_whole = loop {
            explore(worker, explorer, level..level + 1);
            level += 1;
            let own = explorer.borrow();
            let (waits, is_cut_off) = (own.waits_at(level), own.is_cut_off());
            drop(own);
            let said = gather(worker, (waits, is_cut_off, last.elapsed() >= self.every));
            if said.iter().any(|(_, is_cut_off, _)| *is_cut_off) {
                // What was not expanded is lost, so there is nothing to keep. The others may still end.
                explore(worker, explorer, level..u32::MAX);
                break false;
            }
            if !said.iter().any(|(waits, ..)| *waits) {
                break true;
            }
            if said.iter().any(|(.., is_due)| *is_due) {
                self.keep(worker, explorer, level);
                last = Instant::now();
            }
        };
        if is_whole {
            self.store.remove_all_but(None);
        }
    }

    /// Begins where all workers have a file, or anew. Returns the level.
    fn resume(&self, worker: &mut Worker, explorer: &Rc<RefCell<Explorer>>) -> u32 {
        let own = self.store.levels().unwrap_or_default();
        let common = gather(worker, own).into_iter().reduce(|a, b| &a & &b);
        let Some(level) = common.and_then(|levels| levels.last().copied()) else {
            explorer.borrow_mut().begin();
            return 0;
        };
        let mut explorer = explorer.borrow_mut();
        let read = self.store.read(level, |file| explorer.restore(level, file));
        read.unwrap_or_else(|cause| panic!("a checkpoint cannot be read: {cause}"));
        // All have read theirs, so that the sum is told at once.
        gather(worker, ());
        let mut kept = self.common.counters.kept();
        let (_, states) = kept.resumed.unwrap_or_default();
        kept.resumed = Some((level, states + explorer.told().states));
        level
    }

    /// Keeps what was found before a level, if all workers can.
    fn keep(&self, worker: &mut Worker, explorer: &Rc<RefCell<Explorer>>, level: u32) {
        let save = |file: &mut _| explorer.borrow_mut().save(level, file);
        let written = self.store.write(level, save);
        let all_have = gather(worker, written.is_ok()).into_iter().all(|it| it);
        let finished = if all_have {
            self.store.finish(level)
        } else {
            self.store.give_up(level);
            written
        };
        // The ones before are needed until all have this one.
        let is_finished = gather(worker, finished.is_ok() && all_have);
        if is_finished.into_iter().all(|it| it) {
            self.store.remove_all_but(Some(level));
        }
        let mut kept = self.common.counters.kept();
        match finished {
            Ok(()) if all_have => (kept.level, kept.error) = (Some(level), None),
            Ok(()) => {}
            Err(cause) => kept.error = Some(cause.to_string()),
        }
    }
}

/// The states that may lie on a run, by level; the last one is the state that the run leads to.
pub(crate) type Candidates = Vec<BTreeSet<Fingerprint>>;

/// What all workers have found, and of each judged property that is broken what may lie on the run into it.
pub(crate) struct Outcome {
    pub(crate) told: Vec<Told>,
    pub(crate) ways: Vec<Option<Candidates>>,
}

/// What one worker does from its start to its end. All workers come to the same outcome.
pub(crate) fn work(worker: &mut Worker, common: &Arc<Common>) -> Outcome {
    let explorer = Explorer::new(common, worker.index(), worker.peers());
    let explorer = Rc::new(RefCell::new(explorer));
    if let Some(keeping) = &common.keeping {
        Keeper::of(common, keeping, worker.index()).explore(worker, &explorer);
    } else {
        explorer.borrow_mut().begin();
        explore(worker, &explorer, 0..u32::MAX);
    }
    let explorer = explorer.borrow();
    let told = gather(worker, explorer.told());
    let ways = (0..common.judged.len()).map(|property| {
        let first = told.iter().filter_map(|told| told.broken[property]).min()?;
        Some(way(worker, &explorer.table, first))
    });
    let ways = ways.collect();
    Outcome { told, ways }
}

/// Explores these levels, one after the other. A worker expands the states of a level once no more of that level can
/// arrive.
fn explore(worker: &mut Worker, explorer: &Rc<RefCell<Explorer>>, levels: Range<u32>) {
    let explorer = Rc::clone(explorer);
    let probe = worker.dataflow::<u32, _, _>(|scope| {
        let (handle, found) = scope.feedback::<Vec<Found>>(1);
        let by_owner = ExchangePact::new(|found: &Found| found.share());
        let next = found.unary_frontier(by_owner, "explore", move |begin, info| {
            let activator = scope.activator_for(info.address);
            activator.activate();
            let begin = begin.delayed(&levels.start);
            let mut open: BTreeMap<u32, Capability<u32>> = BTreeMap::from([(levels.start, begin)]);
            move |(input, frontier), output| {
                let mut explorer = explorer.borrow_mut();
                input.for_each_stamp(|stamp, batches| {
                    let Some(capability) = stamp.retain_least(output.output_index()) else {
                        return;
                    };
                    let level = *capability.time();
                    for found in batches {
                        explorer.receive(found, level);
                    }
                    open.entry(level).or_insert(capability);
                });
                let Some(entry) = open.first_entry() else {
                    return;
                };
                let level = *entry.key();
                if frontier.frontier().less_equal(&level) {
                    return;
                }
                let capability = entry.remove();
                if level >= levels.end {
                    return;
                }
                let mut session = output.session(&capability);
                explorer.expand(level, &mut |found| session.give(found));
                drop(session);
                if explorer.waits_at(level + 1) {
                    let next = || capability.delayed(&(level + 1));
                    open.entry(level + 1).or_insert_with(next);
                }
                if explorer.waits_at(level) {
                    open.insert(level, capability);
                    activator.activate();
                }
            }
        });
        let (probe, next) = next.container::<Vec<Found>>().probe();
        next.connect_loop(handle);
        probe
    });
    while !probe.done() {
        worker.step_or_park(None);
    }
}

/// What each worker says, heard by each; in no order.
pub(crate) fn gather<D: ExchangeData + Clone>(worker: &mut Worker, said: D) -> Vec<D> {
    let peers = worker.peers() as u64;
    let heard = Rc::new(RefCell::new(Vec::new()));
    let writes = Rc::clone(&heard);
    let probe = worker.dataflow::<u32, _, _>(|scope| {
        let to_all = (0..peers).map(move |to| (to, said.clone()));
        let to_all = to_all.to_stream(scope).container::<Vec<(u64, D)>>();
        let (probe, _) = to_all
            .exchange(|(to, _)| *to)
            .inspect(move |(_, said): &(u64, D)| writes.borrow_mut().push(said.clone()))
            .probe();
        probe
    });
    while !probe.done() {
        worker.step_or_park(None);
    }
    heard.take()
}

/// What may lie on the run into a state: backwards from it, the states at the level before that one of the hints
/// may mean. The run is among them, and little else is.
fn way(worker: &mut Worker, table: &Table, (level, last): (u32, Fingerprint)) -> Candidates {
    let own = table.meant(level, &BTreeSet::from([last.hint()]));
    let own = own.into_iter().filter(|(found, _)| *found == last);
    let mut hints = all(gather(worker, own.map(|(_, from)| from).collect()));
    let mut way = vec![BTreeSet::from([last])];
    for level in (0..level).rev() {
        let meant: Vec<(Fingerprint, Hint)> = all(gather(worker, table.meant(level, &hints)))
            .into_iter()
            .collect();
        way.push(meant.iter().map(|(found, _)| *found).collect());
        hints = meant.into_iter().map(|(_, from)| from).collect();
    }
    way.reverse();
    way
}

fn all<T: Ord>(said: Vec<Vec<T>>) -> BTreeSet<T> {
    said.into_iter().flatten().collect()
}
