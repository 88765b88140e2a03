//! The dataflow: a loop in which each round is one level of the exploration, and rounds of messages from all to all.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;
use std::sync::Arc;

use timely::ExchangeData;
use timely::dataflow::channels::pact::Exchange as ExchangePact;
use timely::dataflow::operators::{
    Capability, ConnectLoop, Exchange, Feedback, Inspect, Operator, Probe, ToStream,
};
use timely::worker::Worker;

use crate::explorer::{Common, Explorer, Found, Told};
use crate::table::{Fingerprint, Hint, Table};

/// The states that may lie on a run, by level; the last one is the state that the run leads to.
pub(crate) type Candidates = Vec<BTreeSet<Fingerprint>>;

/// Findings of all workers, and candidates for the run into each judged property that is broken.
pub(crate) struct Outcome {
    pub(crate) told: Vec<Told>,
    pub(crate) ways: Vec<Option<Candidates>>,
}

/// Work of one worker from its start to its end. All workers come to the same outcome.
pub(crate) fn work(worker: &mut Worker, common: &Arc<Common>) -> Outcome {
    let explorer = Explorer::new(common, worker.index(), worker.peers());
    let explorer = Rc::new(RefCell::new(explorer));
    explorer.borrow_mut().begin();
    explore(worker, &explorer);
    let explorer = explorer.borrow();
    let told = gather(worker, explorer.told());
    let ways = (0..common.judged.len()).map(|property| {
        let first = told.iter().filter_map(|told| told.broken[property]).min()?;
        Some(way(worker, &explorer.table, first))
    });
    let ways = ways.collect();
    Outcome { told, ways }
}

/// Explores level by level. A worker expands the states of a level once no more of that level can
/// arrive.
fn explore(worker: &mut Worker, explorer: &Rc<RefCell<Explorer>>) {
    let explorer = Rc::clone(explorer);
    let probe = worker.dataflow::<u32, _, _>(|scope| {
        let (handle, found) = scope.feedback::<Vec<Found>>(1);
        let by_owner = ExchangePact::new(|found: &Found| found.share());
        let next = found.unary_frontier(by_owner, "explore", move |begin, info| {
            let activator = scope.activator_for(info.address);
            activator.activate();
            let mut open: BTreeMap<u32, Capability<u32>> = BTreeMap::from([(0, begin)]);
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

/// Gathers the data of all workers at each worker, in no order.
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

/// Candidates for the run into a state: backwards from it, the states at the level before that one of the hints
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
