//! Messages and packets as octets and as JSON.

use crossguard_codec::{Dictionary, Identifiers};
use crossguard_judge::readable::{self, Decoded};
use crossguard_judge::signature::Signatures;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::errors::{DecodeError, EncodeError};
use crate::json::to_json;

/// Decodes octets to JSON, by a version of the common data dictionary.
#[pyfunction]
pub(crate) fn decode(octets: &[u8], dictionary: &str) -> PyResult<String> {
    let dictionary = match dictionary {
        "2.1.1" => Dictionary::V2_1_1,
        "2.4.1" => Dictionary::V2_4_1,
        other => {
            let error = format!("no dictionary '{other}': 2.4.1 or 2.1.1");
            return Err(PyValueError::new_err(error));
        }
    };
    let identifiers = Identifiers {
        dictionary,
        ..Identifiers::default()
    };
    match Decoded::of(&identifiers, &mut Signatures::default(), octets) {
        Ok(decoded) => to_json(&decoded),
        Err(error) => Err(DecodeError::new_err((error.to_string(), error.cause()))),
    }
}

/// The octets of a message or packet in JSON.
#[pyfunction]
pub(crate) fn encode<'py>(py: Python<'py>, message: &str) -> PyResult<Bound<'py, PyBytes>> {
    match readable::encode(&Identifiers::default(), message.as_bytes()) {
        Ok(octets) => Ok(PyBytes::new(py, &octets)),
        Err(error) => Err(EncodeError::new_err(error.to_string())),
    }
}
