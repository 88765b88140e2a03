//! Starts the workers of this process, and notices when one of them or another process is lost.

use std::any::Any;
use std::net::{Shutdown, TcpStream};
use std::panic;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, Once, PoisonError};
use std::time::{Duration, Instant};

use crossguard_model_check::model::portable::hashed;
use timely::WorkerConfig;
use timely::communication::allocator::zero_copy::initialize::initialize_networking_from_sockets;
use timely::communication::allocator::{AllocatorBuilder, ProcessBuilder};
use timely::communication::{Config, Hooks};
use timely::execute::execute_from;

use crate::connect::connect;
use crate::dataflow::{Outcome, work};
use crate::explorer::Common;
use crate::hosts::Cluster;
use crate::report::Progress;
use crate::{Options, WorkersError};

/// How long the others may take to say what they have found, once the time is over or somebody asked to stop. One that
/// is held up keeps its connections.
const GRACE: Duration = Duration::from_secs(20);

/// Beginning of the names of threads that timely ends early where a peer is gone.
const OF_TIMELY: &str = "timely:";

/// Message of the last thread of timely that ended early.
static LAST_WORDS: Mutex<Option<String>> = Mutex::new(None);

/// Runs the workers to their end. `watch` receives the progress every half second.
pub(crate) fn run(
    common: &Arc<Common>,
    options: &Options,
    watch: &mut dyn FnMut(Progress),
) -> Result<Outcome, WorkersError> {
    keep_last_words();
    let (builders, others, streams) = set_up(common, options)?;
    let ended = Arc::new(AtomicUsize::new(0));
    let (tell, told) = channel();
    let (working, ends) = (Arc::clone(common), Arc::clone(&ended));
    let guards = execute_from(builders, others, WorkerConfig::default(), move |worker| {
        let outcome = work(worker, &working);
        ends.fetch_add(1, Ordering::SeqCst);
        outcome
    });
    let guards = guards.map_err(WorkersError::Start)?;
    // Joins in a thread of its own: what is lost may keep others waiting for ever.
    let threads = options.workers.get();
    let (lost, watched) = (tell.clone(), Arc::clone(&ended));
    let join = move || {
        while guards.guards().iter().any(|guard| !guard.is_finished()) {
            let finished = guards.guards().iter().filter(|guard| guard.is_finished());
            if finished.count() > watched.load(Ordering::SeqCst) {
                let _ = lost.send(None);
            }
            std::thread::sleep(Duration::from_millis(20));
        }
        let outcomes = guards.join();
        let outcome = outcomes.into_iter().next().and_then(Result::ok);
        let is_whole = watched.load(Ordering::SeqCst) == threads;
        let _ = lost.send(outcome.filter(|_| is_whole));
    };
    // timely ends this one early too where a peer is gone.
    let joining = std::thread::Builder::new().name(format!("{OF_TIMELY}join"));
    let cannot = |cause: std::io::Error| WorkersError::Start(cause.to_string());
    joining.spawn(join).map_err(cannot)?;
    drop(tell);
    let mut given_up = None;
    let lost = loop {
        match told.recv_timeout(Duration::from_millis(500)) {
            Ok(Some(outcome)) => return Ok(outcome),
            Ok(None) | Err(RecvTimeoutError::Disconnected) => break lost_because(),
            Err(RecvTimeoutError::Timeout) => watch(Progress::of(common)),
        }
        let is_alone = streams.is_empty();
        if !is_alone && common.limits.time_reached().is_some() {
            let since: &mut Instant = given_up.get_or_insert_with(Instant::now);
            if since.elapsed() > GRACE {
                break WorkersError::Lost("another process says nothing any more".to_owned());
            }
        }
    };
    // The others notice at once, also where this process lives on.
    for stream in &streams {
        let _ = stream.shutdown(Shutdown::Both);
    }
    Err(lost)
}

fn lost_because() -> WorkersError {
    let words = LAST_WORDS.lock().unwrap_or_else(PoisonError::into_inner);
    let words = words.clone();
    WorkersError::Lost(words.unwrap_or_else(|| "a worker ended early".to_owned()))
}

/// How the workers speak with each other, what else lives as long as they do, and the streams to other processes.
type Setup = (Vec<AllocatorBuilder>, Box<dyn Any + Send>, Vec<TcpStream>);

fn set_up(common: &Common, options: &Options) -> Result<Setup, WorkersError> {
    let threads = options.workers.get();
    let Some(cluster) = &options.cluster else {
        let config = match threads {
            1 => Config::Thread,
            _ => Config::Process(threads),
        };
        let (builders, others) = config.try_build().map_err(WorkersError::Start)?;
        return Ok((builders, others, Vec::new()));
    };
    let cannot = |cause: std::io::Error| WorkersError::Start(cause.to_string());
    let sockets = connect(cluster, digest(common, options), options.patience)?;
    let streams = sockets.iter().flatten().map(TcpStream::try_clone);
    let streams = streams.collect::<Result<_, _>>().map_err(cannot)?;
    let hooks = Hooks::default();
    let of_threads = ProcessBuilder::new_typed_vector(threads, hooks.refill.clone(), None);
    let (builders, guard) =
        initialize_networking_from_sockets(of_threads, sockets, cluster.process, threads, hooks)
            .map_err(cannot)?;
    let builders = builders.into_iter().map(AllocatorBuilder::Tcp).collect();
    Ok((builders, Box::new(guard), streams))
}

/// Digest of the data that must be the same in all processes: scenario, program, numbers of workers, and limits.
fn digest(common: &Common, options: &Options) -> u128 {
    let processes = options.cluster.as_ref().map_or(1, Cluster::processes);
    let shares = (processes, options.workers.get());
    let limits = (options.states_max, options.time_max);
    let scenario = format!("{:?}", common.model.scenario());
    hashed(&(scenario, build(), shares, limits))
}

/// The digest of this program: parts of states are hashed as they lie in memory. 0 where it cannot be read any more; then
/// the version has to be enough.
fn build() -> (u128, &'static str) {
    let program = std::env::current_exe().and_then(std::fs::read);
    let digest = program.map_or(0, |program| hashed(&program));
    (digest, env!("CARGO_PKG_VERSION"))
}

/// Threads of timely end early where a peer is gone: that is told in the report, and not by each of them.
fn keep_last_words() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let before = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            let thread = std::thread::current();
            if !thread
                .name()
                .is_some_and(|name| name.starts_with(OF_TIMELY))
            {
                return before(info);
            }
            let words = info.payload_as_str().unwrap_or_default().to_owned();
            let mut last = LAST_WORDS.lock().unwrap_or_else(PoisonError::into_inner);
            // The first one knows why; others follow from it.
            last.get_or_insert(words);
        }));
    });
}
