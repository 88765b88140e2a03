//! Timers, limits, capabilities and identifiers: their defaults, and whether they make sense.

use crossguard_codec::Identifiers;
use crossguard_protocol::{Config, Settings};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors::broken;
use crate::json::{from_json, to_json};

/// The configuration of these settings.
pub(crate) fn config(settings: &str) -> PyResult<Config> {
    let settings: Settings = from_json("settings", settings)?;
    Config::new(settings).map_err(broken)
}

/// The identifiers, if they can be told apart.
pub(crate) fn identifiers(identifiers: &str) -> PyResult<Identifiers> {
    let identifiers: Identifiers = from_json("identifiers", identifiers)?;
    match identifiers.check() {
        Ok(()) => Ok(identifiers),
        Err(clash) => Err(PyValueError::new_err(clash.to_string())),
    }
}

/// The settings that a robot has if nothing is said.
#[pyfunction]
pub(crate) fn default_settings() -> PyResult<String> {
    to_json(Config::default().settings())
}

/// Raises what is wrong with settings.
#[pyfunction]
pub(crate) fn check_settings(settings: &str) -> PyResult<()> {
    config(settings).map(|_| ())
}

/// The identifiers that a channel has if nothing is said.
#[pyfunction]
pub(crate) fn default_identifiers() -> PyResult<String> {
    to_json(&Identifiers::default())
}

/// Raises what is wrong with identifiers.
#[pyfunction]
pub(crate) fn check_identifiers(identifiers: &str) -> PyResult<()> {
    self::identifiers(identifiers).map(|_| ())
}
