//! The state machine of one robot.

use crossguard_protocol::{Config, Input, Robot as Machine};
use pyo3::prelude::*;

use crate::json::{from_json, to_json};
use crate::settings::config;

/// The state machine of one robot, with its configuration.
#[pyclass(module = "crossguard._crossguard")]
pub(crate) struct Robot {
    machine: Machine,
    config: Config,
}

impl Robot {
    /// A copy of a state machine.
    pub(crate) fn of(machine: &Machine, config: &Config) -> Self {
        Self {
            machine: machine.clone(),
            config: config.clone(),
        }
    }
}

#[pymethods]
impl Robot {
    #[new]
    fn new(station: u32, boot: u16, settings: &str) -> PyResult<Self> {
        Ok(Self {
            machine: Machine::new(crossguard_protocol::StationId(station), boot),
            config: config(settings)?,
        })
    }

    fn step(&mut self, input: &str) -> PyResult<String> {
        let input: Input = from_json("input", input)?;
        to_json(&self.machine.step(&self.config, input))
    }

    fn ram(&self) -> PyResult<String> {
        to_json(&self.machine.ram())
    }

    fn state(&self) -> PyResult<String> {
        to_json(&self.machine.state())
    }

    fn role(&self) -> PyResult<String> {
        to_json(&self.machine.role())
    }

    fn session(&self) -> PyResult<String> {
        to_json(&self.machine.session())
    }

    fn phase(&self) -> PyResult<String> {
        to_json(self.machine.phase())
    }

    fn availability(&self) -> PyResult<String> {
        to_json(&self.machine.availability())
    }

    fn identity(&self) -> PyResult<String> {
        to_json(&self.machine.identity())
    }

    fn duty(&self) -> PyResult<String> {
        to_json(&self.machine.duty())
    }

    fn farewell(&self) -> PyResult<String> {
        to_json(&self.machine.farewell())
    }

    fn describe(&self) -> String {
        self.machine.to_string()
    }

    fn copy(&self) -> Self {
        Self::of(&self.machine, &self.config)
    }

    fn equals(&self, other: &Self) -> bool {
        self.machine == other.machine
    }

    #[getter]
    fn station(&self) -> u32 {
        self.machine.station().0
    }

    #[getter]
    fn boot(&self) -> u16 {
        self.machine.boot()
    }

    #[getter]
    fn next_due_ms(&self) -> Option<u32> {
        self.machine.next_due().map(|due| due.0)
    }

    #[getter]
    fn next_ram_ms(&self) -> Option<u32> {
        self.machine.next_ram().map(|due| due.0)
    }

    #[getter]
    fn is_valid(&self) -> bool {
        self.machine.is_valid(&self.config)
    }
}
