//! The types of the core, by module.
//!
//! Generated from `asn1/*.asn` by `tests/generated`; do not edit.

/// Calls a macro with the modules of the core and their types.
#[macro_export]
macro_rules! for_all_types {
    ($callback:ident) => {
        $callback! {
            cdd:
                ItsPduHeader MessageId StationId TrafficParticipantType GenerationDeltaTime
                DeltaTimeTenthOfSecond DeltaTimeSecond DeltaTimeTenSeconds OrdinalNumber1B
                CardinalNumber1B Identifier1B Identifier2B StandardLength9b StandardLength12b
                BasicContainer ReferencePositionWithConfidence GeoPosition Latitude Longitude
                PositionConfidenceEllipse PosConfidenceEllipse SemiAxisLength Altitude AltitudeValue
                AltitudeConfidence DeltaReferencePosition DeltaLatitude DeltaLongitude DeltaAltitude
                CartesianPosition3d CartesianCoordinate Wgs84Angle Wgs84AngleValue
                Wgs84AngleConfidence HeadingValue CartesianAngleValue Speed SpeedValue
                SpeedConfidence DriveDirection AccelerationComponent AccelerationValue
                AccelerationConfidence Curvature CurvatureValue CurvatureConfidence YawRate
                YawRateValue YawRateConfidence ObjectDimensionValue ExteriorLights LanePosition
                MapReference RoadSegmentReferenceId IntersectionReferenceId Shape RectangularShape
                CircularShape PolygonalShape VruClusterInformation VruClusterProfiles PathHistory
                PathPoint PathDeltaTime PathPredicted PathPointPredicted PathDeltaTimeChoice
                SequenceOfSafeDistanceIndication SafeDistanceIndication SafeDistanceIndicator
                SequenceOfTrajectoryInterceptionIndication TrajectoryInterceptionIndication
                TrajectoryInterceptionProbability TrajectoryInterceptionConfidence
                AccelerationChangeIndication AccelerationChange HeadingChangeIndication
                TurningDirection StabilityChangeIndication StabilityLossProbability;
            common:
                CoordinationSession SessionNumber OfferNumber RequestId TaskType TaskSet
                TaskProgression UnavailabilityReason;
            vam:
                VruClusterInformationContainer VruMotionPredictionContainer;
            ram:
                RAM RobotAwareness RamParameters RobotHighFrequencyContainer RobotDimensions
                RobotLowFrequencyContainer RobotCapabilities SignalsShown PublicSignal SignalMeans
                RobotStatusContainer RobotCategory OperationalJobRole BatteryStatus StateOfCharge
                ControlMode HelpStatus RobotLeaderFollowerOperationContainer SessionRole
                RequesterRole RequestUrgency CrossingReference HelperRole SafetyTimeout LeaderRole
                Heartbeat ConfirmedFollower FollowerRole CommandReport CommandProgress FailureReason
                SessionFarewell EndedSession SessionEnding LeftSession;
            rmcm:
                RMCM RobotManeuverCoordination RmcmParameters ManeuverContainer
                LeaderManeuverContainer ManeuverCommand ManeuverTarget ManeuverConstraints
                ManeuverDuration FollowerManeuverContainer ManeuverResponse RejectionReason;
        }
    };
}
