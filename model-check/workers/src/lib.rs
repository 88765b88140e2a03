//! Checks a scenario with several threads.
//!
//! ```text
//!   scenario ──► model ──► worker 0 ┐   each owns the states of its share of fingerprints:
//!                  ├─────► worker 1 ├── a table of 15 bytes per state, and states that wait.
//!                  └─────► …        ┘   They go level by level; what a worker finds goes to
//!                             │         its owner.
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
//! probability of one.
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

mod explorer;
mod path;
mod report;
mod table;
mod threads;
mod waiting;

use std::num::NonZeroUsize;
use std::time::Duration;

use crossguard_model_check::check::{ExplorationLimits, Stop};
use crossguard_model_check::model::Model;
use crossguard_model_check::properties::PropertyId;
use crossguard_model_check::scenario::Scenario;

use explorer::{Common, Counters};
pub use report::{Progress, WorkersReport};
pub use table::FINGERPRINT_BITS;

/// How far and with what a check may go.
#[derive(Clone, Debug)]
pub struct Options {
    /// How many workers there are, one thread each.
    pub workers: NonZeroUsize,
    /// Give up after about this many states.
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
    #[error("{0}: leave --workers out")]
    NotForWorkers(String),
    /// A worker has ended early, so nothing is known of its share of the states.
    #[error("incomplete: a worker has ended early, and with it its share of the states is lost")]
    Lost,
}

/// Checks the model of a scenario. `watch` receives the progress now and then.
///
/// # Errors
/// The scenario is not for workers, or one of them has ended early.
pub fn check(
    model: &Model,
    options: &Options,
    watch: &mut dyn FnMut(Progress),
) -> Result<WorkersReport, WorkersError> {
    let judged = judged(model.scenario())?;
    let limits = ExplorationLimits::new(options.states_max, options.time_max, &options.stop);
    let common = Common {
        model: model.clone(),
        judged,
        workers: options.workers.get(),
        limits,
        counters: Counters::default(),
    };
    let outcome = threads::run(&common, watch)?;
    Ok(report::of(&common, &outcome))
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
