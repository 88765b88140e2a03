//! The Rust side of the Python package `crossguard`.
//!
//! ```text
//!   crossguard (python/crossguard)      frozen dataclasses, documented and typed
//!        │ JSON, in the form of logs
//!   crossguard._crossguard (this crate)
//!        ├─► robot ──────► crossguard_protocol::Robot::step
//!        ├─► endpoint ───► crossguard_endpoint::endpoint, trace
//!        ├─► codec ──────► crossguard_judge::readable
//!        └─► validate ───► crossguard_judge::validate
//! ```
//!
//! It holds no rule of the protocol, and no type of Python's but handles: values cross as the JSON that
//! serde makes of them, and the classes of the package mirror the Rust types by name; `shapes` is what a
//! test holds them against. Long work releases the interpreter. A panic becomes Python's `PanicException`.

use pyo3::prelude::*;

mod boot;
mod codec;
mod endpoint;
mod errors;
mod json;
mod robot;
mod settings;
mod shapes;
mod validate;

/// The module that Python imports.
#[pymodule]
mod _crossguard {
    #[pymodule_export]
    use crate::boot::Boot;
    #[pymodule_export]
    use crate::codec::{decode, encode};
    #[pymodule_export]
    use crate::endpoint::Endpoint;
    #[pymodule_export]
    use crate::robot::Robot;
    #[pymodule_export]
    use crate::settings::{
        check_identifiers, check_settings, default_identifiers, default_settings,
    };
    #[pymodule_export]
    use crate::shapes::shapes;
    #[pymodule_export]
    use crate::validate::validate;

    #[pymodule_export]
    #[expect(non_upper_case_globals, reason = "Python's name for it")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
