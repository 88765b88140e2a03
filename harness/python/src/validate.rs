//! Whether logs tell what could have happened.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Cursor};

use crossguard_judge::validate::{self as harness, Fault, Invalid, Log, Validated};
use crossguard_robot::lines::LineError;
use crossguard_robot::trace::Unreadable;
use pyo3::prelude::*;
use serde::Serialize;

use crate::errors::UnreadableLog;
use crate::json::to_json;

/// `Validation` of the package.
#[derive(Serialize)]
struct Validation {
    validated: Option<Validated>,
    fault: Option<Misfit>,
}

/// `Fault` of the package.
#[derive(Serialize)]
struct Misfit {
    log: String,
    line: usize,
    robot: Option<String>,
    what: String,
}

/// Validates logs, each a name and its text, or the name of a file.
#[pyfunction]
pub(crate) fn validate(py: Python<'_>, logs: Vec<(String, Option<String>)>) -> PyResult<String> {
    let outcome = py.detach(|| {
        let logs: io::Result<Vec<_>> = logs.into_iter().map(open).collect();
        logs.map(harness::all)
    })?;
    to_json(&match outcome {
        Ok(validated) => Validation {
            validated: Some(validated),
            fault: None,
        },
        Err(invalid) => Validation {
            validated: None,
            fault: Some(misfit(invalid)?),
        },
    })
}

fn open((name, text): (String, Option<String>)) -> io::Result<Log<'static>> {
    let named = |cause: io::Error| io::Error::new(cause.kind(), format!("{name}: {cause}"));
    let lines: Box<dyn BufRead> = match text {
        Some(text) => Box::new(Cursor::new(text)),
        None => Box::new(BufReader::new(File::open(&name).map_err(named)?)),
    };
    Ok(Log { name, lines })
}

/// The misfit of a log. A log that cannot be read is an error, and not a robot that went wrong.
fn misfit(invalid: Invalid) -> PyResult<Misfit> {
    let text = invalid.to_string();
    match *invalid.fault {
        Fault::Unreadable(Unreadable::Line(LineError::Io(cause))) => {
            Err(io::Error::new(cause.kind(), text).into())
        }
        Fault::Unreadable(_) => Err(UnreadableLog::new_err(text)),
        fault => Ok(Misfit {
            log: invalid.log,
            line: invalid.line,
            robot: invalid.robot,
            what: fault.to_string(),
        }),
    }
}
