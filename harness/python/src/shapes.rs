//! The shapes of the types that cross, which a test holds the package's classes against.

use crossguard_codec as codec;
use crossguard_codec::Service;
use crossguard_endpoint::ras::generation::Trigger;
use crossguard_protocol as protocol;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use serde_reflection::{Registry, Samples, Tracer, TracerConfig};

use crate::json::to_json;

/// Every type that crosses, by name, with its fields or members, as serde has them.
#[pyfunction]
pub(crate) fn shapes() -> PyResult<String> {
    let registry = trace().map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
    to_json(&registry)
}

/// The types that cross, and every enumeration in them: an enumeration within another is complete only when it was
/// traced by itself.
fn trace() -> serde_reflection::Result<Registry> {
    let mut tracer = Tracer::new(TracerConfig::default());
    macro_rules! trace {
        ($($type:ty),* $(,)?) => {$(
            tracer.trace_simple_type::<$type>()?;
        )*};
    }
    trace!(
        protocol::Availability,
        protocol::Contact,
        protocol::Coordination,
        protocol::Corridor,
        protocol::CorridorClosure,
        protocol::Disengagement,
        protocol::Duty,
        protocol::Ending,
        protocol::EndReason,
        protocol::Event,
        protocol::Failure,
        protocol::FallbackPolicy,
        protocol::Farewell,
        protocol::GoneReason,
        protocol::Identity,
        protocol::Ignored,
        protocol::Input,
        protocol::Lease,
        protocol::Notice,
        protocol::Output,
        protocol::Phase,
        protocol::Progress,
        protocol::Ram,
        protocol::Rejection,
        protocol::ReleaseReason,
        protocol::Rmcm,
        protocol::Role,
        protocol::Settings,
        protocol::State,
        protocol::StopReason,
        protocol::Timer,
        protocol::Unavailability,
        protocol::Urgency,
        protocol::Verdict
    );
    trace!(
        codec::ControlMode,
        codec::Dictionary,
        codec::DriveDirection,
        codec::JobRole,
        codec::MapPlace,
        codec::PublicSignal,
        codec::RobotCategory,
        codec::RobotState,
        codec::Target,
        codec::TaskParameters,
        codec::TaskProgression,
    );
    trace!(Service, Trigger);
    // By a value: files spell its names in another way, too, which a tracer of types takes for fields of its own.
    tracer.trace_value(&mut Samples::new(), &codec::Identifiers::default())?;
    tracer.registry()
}
