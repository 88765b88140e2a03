//! The workers, a thread each. A level of the exploration is over at a worker once all workers have said that they have expanded
//! their states of it: the states that they found come before that.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::Duration;

use crossguard_model_check::parallel::in_parallel;

use crate::WorkersError;
use crate::explorer::{Common, Explorer, Found, Told};
use crate::report::Progress;
use crate::table::{Fingerprint, Hint, Table};

/// How often the progress is told.
const INTERVAL: Duration = Duration::from_millis(500);

/// The states that may lie on a run, by level; the last one is the state that the run leads to.
pub(crate) type Candidates = Vec<BTreeSet<Fingerprint>>;

/// Findings of all workers, and candidates for the run into each judged property that is broken.
pub(crate) struct Outcome {
    pub(crate) told: Vec<Told>,
    pub(crate) ways: Vec<Option<Candidates>>,
}

/// Message from one worker to another.
enum Word {
    /// States that were found for this level.
    Found(u32, Vec<Found>),
    /// The sender has expanded its states of this level, and whether there were any.
    Expanded(u32, bool),
    /// The sender has ended early.
    Lost,
}

/// Says that a worker has ended early, so that the others do not wait for it.
struct Farewell<'a>(&'a [Sender<Word>]);

impl Drop for Farewell<'_> {
    fn drop(&mut self) {
        if thread::panicking() {
            say_to_all(self.0, || Word::Lost);
        }
    }
}

/// Runs the workers to their end. `watch` receives the progress every half second.
pub(crate) fn run(
    common: &Common,
    watch: &mut dyn FnMut(Progress),
) -> Result<Outcome, WorkersError> {
    let (to_all, heard): (Vec<_>, Vec<_>) = (0..common.workers).map(|_| channel()).unzip();
    let (working, ended) = channel::<()>();
    let explored = thread::scope(|scope| {
        let threads = heard.into_iter().enumerate().map(|(index, heard)| {
            let (to_all, working) = (to_all.clone(), working.clone());
            scope.spawn(move || {
                // The end of the thread is noticed when this is dropped, also by a panic.
                let _working = working;
                explore(Explorer::new(common, index), &to_all, &heard)
            })
        });
        let threads: Vec<_> = threads.collect();
        drop(working);
        while ended.recv_timeout(INTERVAL) == Err(RecvTimeoutError::Timeout) {
            watch(Progress::of(common));
        }
        // All are joined, also after one that has ended early.
        let joined = threads.into_iter().map(thread::ScopedJoinHandle::join);
        joined.collect::<Vec<_>>()
    });
    let explored = explored.into_iter();
    let explored = explored.map(|it| it.unwrap_or(Err(WorkersError::Lost)));
    let explored = explored.collect::<Result<Vec<_>, _>>()?;
    let (told, tables): (Vec<Told>, Vec<Table>) = explored.into_iter().unzip();
    let ways = (0..common.judged.len()).map(|property| {
        let first = told.iter().filter_map(|told| told.broken[property]).min()?;
        Some(way(&tables, first))
    });
    let ways = ways.collect();
    Ok(Outcome { told, ways })
}

/// Work of one worker from its start to its end: level by level, up to one at which no worker has a state.
fn explore(
    explorer: Explorer<'_>,
    to_all: &[Sender<Word>],
    heard: &Receiver<Word>,
) -> Result<(Told, Table), WorkersError> {
    let _farewell = Farewell(to_all);
    let mut worker = Worker {
        explorer,
        ends: BTreeMap::new(),
    };
    worker.explorer.begin();
    for level in 0.. {
        let mut had_any = false;
        while worker.explorer.waits_at(level) {
            had_any = true;
            for (found, to) in worker.explorer.expand(level).into_iter().zip(to_all) {
                if !found.is_empty() {
                    say(to, Word::Found(level + 1, found));
                }
            }
            for word in heard.try_iter() {
                worker.hear(word)?;
            }
        }
        say_to_all(to_all, || Word::Expanded(level, had_any));
        while worker.expanded(level) < to_all.len() {
            worker.hear(heard.recv().map_err(|_| WorkersError::Lost)?)?;
        }
        if worker.ends.remove(&level).is_none_or(|end| !end.had_any) {
            break;
        }
    }
    Ok(worker.explorer.ended())
}

struct Worker<'a> {
    explorer: Explorer<'a>,
    /// The levels that are not over here. Others may be a level ahead.
    ends: BTreeMap<u32, LevelEnd>,
}

#[derive(Default)]
struct LevelEnd {
    /// How many workers have expanded their states.
    workers: usize,
    /// Whether any had a state.
    had_any: bool,
}

impl Worker<'_> {
    fn hear(&mut self, word: Word) -> Result<(), WorkersError> {
        match word {
            Word::Found(level, found) => self.explorer.receive(found, level),
            Word::Expanded(level, had_any) => {
                let end = self.ends.entry(level).or_default();
                end.workers += 1;
                end.had_any |= had_any;
            }
            Word::Lost => return Err(WorkersError::Lost),
        }
        Ok(())
    }

    fn expanded(&self, level: u32) -> usize {
        self.ends.get(&level).map_or(0, |end| end.workers)
    }
}

fn say(to: &Sender<Word>, word: Word) {
    // A worker that has ended early says so itself.
    let _ = to.send(word);
}

fn say_to_all(to_all: &[Sender<Word>], word: impl Fn() -> Word) {
    for to in to_all {
        say(to, word());
    }
}

/// Candidates for the run into a state: backwards from it, the states at the level before that one of the hints
/// may mean. The run is among them, and little else is.
fn way(tables: &[Table], (level, last): (u32, Fingerprint)) -> Candidates {
    let mut own = meant(tables, level, &BTreeSet::from([last.hint()]));
    own.retain(|(found, _)| *found == last);
    let mut hints = own.into_iter().map(|(_, from)| from).collect();
    let mut way = vec![BTreeSet::from([last])];
    for level in (0..level).rev() {
        let meant = meant(tables, level, &hints);
        way.push(meant.iter().map(|(found, _)| *found).collect());
        hints = meant.into_iter().map(|(_, from)| from).collect();
    }
    way.reverse();
    way
}

/// The states of all tables that one of these hints may mean.
fn meant(tables: &[Table], level: u32, hints: &BTreeSet<Hint>) -> Vec<(Fingerprint, Hint)> {
    let mut all = Vec::new();
    let of = |number: usize| tables[number].meant(level, hints);
    in_parallel(tables.len(), tables.len(), of, |_, meant| {
        all.extend(meant);
        true
    });
    all
}
