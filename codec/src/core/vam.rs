//! Crossguard-VAM: the vulnerable road user awareness message of ETSI TS 103 300-3 v2.3.1 on the
//! common data dictionary v2.4.1. RAM takes its cluster information and motion prediction from
//! here.
//!
//! Generated from `asn1/Crossguard-VAM.asn` by `tests/generated`; do not edit.

use super::notation::prelude::*;

asn1! {
    /// The group that the sender leads. TS 103 300-3 `VruClusterInformationContainer`.
    VruClusterInformationContainer ::= SEQUENCE {
        vru_cluster_information VruClusterInformation,
        ...
    }
}

asn1! {
    /// Where the sender comes from and goes to. TS 103 300-3 `VruMotionPredictionContainer`.
    VruMotionPredictionContainer ::= SEQUENCE {
        path_history                       PathHistory OPTIONAL,
        path_prediction                    PathPredicted OPTIONAL,
        safe_distance                      SequenceOfSafeDistanceIndication OPTIONAL,
        trajectory_interception_indication SequenceOfTrajectoryInterceptionIndication OPTIONAL,
        acceleration_change_indication     AccelerationChangeIndication OPTIONAL,
        heading_change_indication          HeadingChangeIndication OPTIONAL,
        stability_change_indication        StabilityChangeIndication OPTIONAL,
        ...
    }
}
