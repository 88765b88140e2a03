//! What a RAM takes from the VAM of ETSI TS 103 300-3 v2.3.1. `asn1/Crossguard-VAM.asn`.

use super::cdd::{
    AccelerationChangeIndication, HeadingChangeIndication, PathHistory, PathPredicted,
    SequenceOfSafeDistanceIndication, SequenceOfTrajectoryInterceptionIndication,
    StabilityChangeIndication, VruClusterInformation,
};
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
