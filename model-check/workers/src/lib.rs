//! Checks a scenario with several threads, processes or machines.
//!
//! ```text
//!   scenario ──► model ──► worker 0 ┐   each owns the states of its share of fingerprints:
//!                  ├─────► worker 1 ├── a table of 15 bytes per state, and states that wait.
//!                  └─────► …        ┘   A level is one round of a loop in a timely dataflow;
//!                             │         what a worker finds goes to its owner.
//!                             ▼
//!               counts, premises, the first states that break a property
//!                             │         hints in the tables lead back, level by level
//!                             ▼
//!               the shortest run into each ──► report
//! ```
//!
//! States and steps are judged: invariants, properties of steps, deadlocks, premises. Properties that need
//! the graph of all states (L1 to L7) are not, and the report says so by name.
//!
//! States are compared by 92 bits of a fingerprint, so a verdict holds up to a collision; the report has the
//! probability of one. A process that ends early ends the check of all others as incomplete.
//!
//! ```
//! use crossguard_model_check::model::Model;
//! use crossguard_model_check::scenario::Scenario;
//! use crossguard_workers::{Options, check};
//!
//! let model = Model::new(Scenario::load("stable").unwrap());
//! let report = check(&model, &Options::default(), &mut |_| ()).unwrap();
//! assert!(report.scenario.exhaustive && !report.scenario.failed());
//! ```
//!
//! There are no features.

mod connect;
mod dataflow;
mod explorer;
mod hosts;
mod path;
mod processes;
mod report;
mod table;
mod waiting;

use std::num::NonZeroUsize;
use std::sync::Arc;
use std::time::Duration;

use crossguard_model_check::check::{ExplorationLimits, Stop};
use crossguard_model_check::model::Model;
use crossguard_model_check::properties::PropertyId;
use crossguard_model_check::scenario::Scenario;

pub use connect::ConnectError;
use explorer::{Common, Counters};
pub use hosts::{Cluster, HostsError};
pub use report::{Progress, WorkersReport};
pub use table::FINGERPRINT_BITS;

/// How far and with what a check may go.
#[derive(Clone, Debug)]
pub struct Options {
    /// Workers of this process, one thread each; all processes have as many.
    pub workers: NonZeroUsize,
    /// This process among others, where there are others.
    pub cluster: Option<Cluster>,
    /// How long to wait for the other processes at the beginning.
    pub patience: Duration,
    /// Give up after about this many states, of all processes together.
    pub states_max: Option<usize>,
    /// Give up after this time.
    pub time_max: Option<Duration>,
    /// Give up when asked.
    pub stop: Stop,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            workers: NonZeroUsize::MIN,
            cluster: None,
            patience: Duration::from_mins(1),
            states_max: None,
            time_max: None,
            stop: Stop::default(),
        }
    }
}

/// Why there is no report.
#[derive(Debug, thiserror::Error)]
pub enum WorkersError {
    /// The scenario is a timed one, or asks for nothing that states and steps show.
    #[error("{0}: leave --workers and --hosts out")]
    NotForWorkers(String),
    /// The processes did not come together.
    #[error(transparent)]
    Connect(#[from] ConnectError),
    /// The threads or the sockets could not be set up.
    #[error("workers cannot be started: {0}")]
    Start(String),
    /// A process or a connection was lost, so nothing is known of its share of the states.
    #[error(
        "incomplete: a process or the connection to it was lost, and with it its share of the states ({0})"
    )]
    Lost(String),
}

impl WorkersError {
    /// Whether the check was begun as it should be and could not be brought to its end.
    #[must_use]
    pub const fn is_incomplete(&self) -> bool {
        matches!(
            self,
            Self::Lost(_) | Self::Connect(ConnectError::NotThere { .. })
        )
    }
}

/// Checks the model of a scenario. `watch` receives the progress of this process now and then.
///
/// # Errors
/// The scenario is not for workers, the processes do not come together, or one of them was lost. In the latter
/// case threads may be left behind that wait for it; the caller is expected to end.
pub fn check(
    model: &Model,
    options: &Options,
    watch: &mut dyn FnMut(Progress),
) -> Result<WorkersReport, WorkersError> {
    let judged = judged(model.scenario())?;
    let processes = options.cluster.as_ref().map_or(1, Cluster::processes);
    // Each process may own its share of the states.
    let states_max = options.states_max.map(|max| max.div_ceil(processes));
    let limits = ExplorationLimits::new(states_max, options.time_max, &options.stop);
    let common = Arc::new(Common {
        model: model.clone(),
        judged,
        workers: options.workers.get(),
        limits,
        counters: Counters::default(),
    });
    let outcome = processes::run(&common, options, watch)?;
    Ok(report::of(&common, &outcome, processes))
}

/// The properties of the scenario that states and steps show.
fn judged(scenario: &Scenario) -> Result<Vec<PropertyId>, WorkersError> {
    let name = &scenario.name;
    if scenario.timed.is_some() {
        return Err(WorkersError::NotForWorkers(format!(
            "'{name}' is a timed scenario, which workers cannot explore"
        )));
    }
    let properties = scenario.properties.iter().copied();
    let judged: Vec<_> = properties.filter(|id| id.is_of_states_or_steps()).collect();
    if judged.is_empty() {
        let properties: Vec<_> = scenario.properties.iter().map(|id| id.name()).collect();
        return Err(WorkersError::NotForWorkers(format!(
            "'{name}' asks for {} alone, which need the graph of all states and are not judged with workers",
            properties.join(", ")
        )));
    }
    Ok(judged)
}
