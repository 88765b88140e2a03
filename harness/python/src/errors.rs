//! The exceptions of the package, which are classes of `crossguard.errors`.

use crossguard_protocol::BrokenInequality as Broken;
use pyo3::{PyErr, import_exception};

import_exception!(crossguard.errors, BootError);
import_exception!(crossguard.errors, BrokenInequality);
import_exception!(crossguard.errors, DecodeError);
import_exception!(crossguard.errors, EncodeError);
import_exception!(crossguard.errors, UnreadableLog);

/// Settings break an inequality.
pub(crate) fn broken(broken: Broken) -> PyErr {
    let Broken(inequality) = broken;
    BrokenInequality::new_err((
        broken.to_string(),
        inequality.name(),
        inequality.to_string(),
    ))
}
