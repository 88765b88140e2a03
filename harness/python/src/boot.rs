//! The boot counter, the only thing that a robot persists.

use std::path::PathBuf;

use crossguard_robot::boot;
use pyo3::prelude::*;

use crate::errors::BootError;

/// A boot counter that is in use: the only thing that a robot persists. It is free again after `close`, at
/// the end of a `with` block, or with the process.
#[pyclass(module = "crossguard._crossguard")]
pub(crate) struct Boot {
    counter: u16,
    /// Holds the file; `None` once it is free again.
    taken: Option<boot::Boot>,
}

#[pymethods]
impl Boot {
    /// Takes the next boot counter from a file, which is on the disk when this returns. A file that does not
    /// exist begins at 1.
    ///
    /// Raises `BootError` where there is none to be had: the file cannot be written, holds something else,
    /// is used up, or is in use by another process.
    #[staticmethod]
    #[expect(
        clippy::needless_pass_by_value,
        reason = "PyO3 makes it of a str or path"
    )]
    fn take(path: PathBuf) -> PyResult<Self> {
        let taken = boot::take(&path).map_err(|error| BootError::new_err(error.to_string()))?;
        Ok(Self {
            counter: taken.counter,
            taken: Some(taken),
        })
    }

    /// Takes the next boot counter while the robot runs, as `outputs.RenewEpoch` asks; it is on the disk
    /// when this returns. Then tell `events.EpochRenewed`.
    ///
    /// Raises `BootError` where there is none to be had, and after `close`; the counter is as before then.
    fn renew(&mut self) -> PyResult<u16> {
        let Some(taken) = &mut self.taken else {
            return Err(BootError::new_err(
                "the boot counter is not in use any more",
            ));
        };
        let renewed = taken.renew();
        self.counter = renewed.map_err(|error| BootError::new_err(error.to_string()))?;
        Ok(self.counter)
    }

    /// The newest counter of this boot, 1..65535.
    #[getter]
    fn counter(&self) -> u16 {
        self.counter
    }

    /// Lets another process take the file.
    fn close(&mut self) {
        self.taken = None;
    }

    fn __enter__(slf: Py<Self>) -> Py<Self> {
        slf
    }

    fn __exit__(
        &mut self,
        _kind: &Bound<'_, PyAny>,
        _error: &Bound<'_, PyAny>,
        _traceback: &Bound<'_, PyAny>,
    ) {
        self.close();
    }

    fn __repr__(&self) -> String {
        format!("<Boot {}>", self.counter)
    }
}
