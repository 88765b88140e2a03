//! The model checker.

use std::num::NonZeroUsize;
use std::path::Path;
use std::time::{Duration, Instant};

use crossguard_model_check::check::{CheckProgress, Options, Stop};
use crossguard_model_check::report::ScenarioReport;
use crossguard_model_check::subject::Subject;
use crossguard_robot::files;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors::ScenarioError;
use crate::json::to_json;

/// How often Python is asked whether to go on.
const PATIENCE: Duration = Duration::from_millis(50);

/// What came of checking one scenario.
#[pyclass(module = "crossguard._crossguard", frozen)]
pub(crate) struct Report(ScenarioReport);

#[pymethods]
impl Report {
    #[getter]
    fn has_failed(&self) -> bool {
        Subject::is_wrong(&self.0)
    }

    fn json(&self) -> PyResult<String> {
        to_json(&self.0)
    }

    fn chart(&self, id: &str, form: &str) -> PyResult<Option<String>> {
        let property = self.0.properties.iter().find(|property| property.id == id);
        let property = property
            .ok_or_else(|| PyValueError::new_err(format!("the scenario has no property '{id}'")))?;
        let Some(chart) = self.0.chart(property) else {
            return Ok(None);
        };
        Ok(Some(match form {
            "text" => chart.text(),
            "mermaid" => chart.mermaid(),
            other => {
                let error = format!("no form '{other}': text or mermaid");
                return Err(PyValueError::new_err(error));
            }
        }))
    }
}

/// The names of what can be checked.
#[pyfunction]
pub(crate) fn scenarios() -> Vec<&'static str> {
    Subject::shipped().collect()
}

/// Checks a scenario. `progress` is called now and then; what it raises ends the check.
#[pyfunction]
pub(crate) fn check(
    py: Python<'_>,
    name: &str,
    threads: Option<NonZeroUsize>,
    max_states: Option<NonZeroUsize>,
    timeout_s: Option<f64>,
    progress: &Bound<'_, PyAny>,
) -> PyResult<Report> {
    let read = |path: &Path| files::text(path, files::TEXT_MAX);
    let subject = Subject::load(name, read);
    let subject = subject.map_err(|error| ScenarioError::new_err(error.to_string()))?;
    let time_max = timeout_s.map(Duration::try_from_secs_f64).transpose();
    let defaults = Options::default();
    let options = Options {
        threads: threads.unwrap_or(defaults.threads),
        states_max: max_states.map(NonZeroUsize::get),
        time_max: time_max.map_err(|error| PyValueError::new_err(format!("timeout_s: {error}")))?,
        ..defaults
    };
    let mut asking = Asking {
        progress: progress.clone().unbind(),
        stop: options.stop.clone(),
        asked: Instant::now(),
        raised: None,
    };
    let (report, raised) = py.detach(move || {
        let report = subject.check(&options, &mut |progress| asking.go_on(progress));
        (report, asking.raised)
    });
    match raised {
        None => Ok(Report(report)),
        Some(error) => Err(error),
    }
}

/// Asks Python now and then whether to go on.
struct Asking {
    progress: Py<PyAny>,
    stop: Stop,
    asked: Instant,
    /// What Python raised.
    raised: Option<PyErr>,
}

impl Asking {
    fn go_on(&mut self, progress: CheckProgress) {
        if self.raised.is_some() || self.asked.elapsed() < PATIENCE {
            return;
        }
        self.asked = Instant::now();
        let told = Python::attach(|py| {
            py.check_signals()?;
            let of = (progress.checked, progress.explored, progress.expected);
            self.progress.call1(py, of).map(|_| ())
        });
        if let Err(error) = told {
            self.raised = Some(error);
            self.stop.request();
        }
    }
}
