//! Generated from `asn1/*.asn` by `tests/generated.rs`; do not edit.
#[allow(
    non_camel_case_types,
    non_snake_case,
    non_upper_case_globals,
    unused,
    clippy::too_many_arguments
)]
pub mod crossguard_cdd {
    extern crate alloc;
    use core::borrow::Borrow;
    use rasn::prelude::*;
    use serde::{Deserialize, Serialize};
    use std::sync::LazyLock;
    /// Speeding up or slowing down. CDD AccelerationChange.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    pub enum AccelerationChange {
        accelerate = 0,
        decelerate = 1,
    }
    /// Acceleration that is about to change. CDD AccelerationChangeIndication.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct AccelerationChangeIndication {
        #[rasn(identifier = "accelOrDecel")]
        #[serde(rename = "accelOrDecel")]
        pub accel_or_decel: AccelerationChange,
        #[rasn(identifier = "actionDeltaTime")]
        #[serde(rename = "actionDeltaTime")]
        pub action_delta_time: DeltaTimeTenthOfSecond,
    }
    impl AccelerationChangeIndication {
        pub fn new(
            accel_or_decel: AccelerationChange,
            action_delta_time: DeltaTimeTenthOfSecond,
        ) -> Self {
            Self {
                accel_or_decel,
                action_delta_time,
            }
        }
    }
    /// Acceleration along one axis. CDD AccelerationComponent.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct AccelerationComponent {
        pub value: AccelerationValue,
        pub confidence: AccelerationConfidence,
    }
    impl AccelerationComponent {
        pub fn new(value: AccelerationValue, confidence: AccelerationConfidence) -> Self {
            Self { value, confidence }
        }
    }
    /// 0.1 m/s^2, rounded up, at 95 %; 0 is not used. CDD AccelerationConfidence.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=102"))]
    pub struct AccelerationConfidence(pub u8);
    /// 0.1 m/s^2, rounded up. CDD AccelerationValue.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("-160..=161"))]
    pub struct AccelerationValue(pub i16);
    /// Altitude with its confidence. CDD Altitude.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct Altitude {
        #[rasn(identifier = "altitudeValue")]
        #[serde(rename = "altitudeValue")]
        pub altitude_value: AltitudeValue,
        #[rasn(identifier = "altitudeConfidence")]
        #[serde(rename = "altitudeConfidence")]
        pub altitude_confidence: AltitudeConfidence,
    }
    impl Altitude {
        pub fn new(altitude_value: AltitudeValue, altitude_confidence: AltitudeConfidence) -> Self {
            Self {
                altitude_value,
                altitude_confidence,
            }
        }
    }
    /// Largest error of the altitude at 95 %: alt-000-05 is 0.05 m. CDD AltitudeConfidence.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    pub enum AltitudeConfidence {
        #[rasn(identifier = "alt-000-01")]
        #[serde(rename = "alt-000-01")]
        alt_000_01 = 0,
        #[rasn(identifier = "alt-000-02")]
        #[serde(rename = "alt-000-02")]
        alt_000_02 = 1,
        #[rasn(identifier = "alt-000-05")]
        #[serde(rename = "alt-000-05")]
        alt_000_05 = 2,
        #[rasn(identifier = "alt-000-10")]
        #[serde(rename = "alt-000-10")]
        alt_000_10 = 3,
        #[rasn(identifier = "alt-000-20")]
        #[serde(rename = "alt-000-20")]
        alt_000_20 = 4,
        #[rasn(identifier = "alt-000-50")]
        #[serde(rename = "alt-000-50")]
        alt_000_50 = 5,
        #[rasn(identifier = "alt-001-00")]
        #[serde(rename = "alt-001-00")]
        alt_001_00 = 6,
        #[rasn(identifier = "alt-002-00")]
        #[serde(rename = "alt-002-00")]
        alt_002_00 = 7,
        #[rasn(identifier = "alt-005-00")]
        #[serde(rename = "alt-005-00")]
        alt_005_00 = 8,
        #[rasn(identifier = "alt-010-00")]
        #[serde(rename = "alt-010-00")]
        alt_010_00 = 9,
        #[rasn(identifier = "alt-020-00")]
        #[serde(rename = "alt-020-00")]
        alt_020_00 = 10,
        #[rasn(identifier = "alt-050-00")]
        #[serde(rename = "alt-050-00")]
        alt_050_00 = 11,
        #[rasn(identifier = "alt-100-00")]
        #[serde(rename = "alt-100-00")]
        alt_100_00 = 12,
        #[rasn(identifier = "alt-200-00")]
        #[serde(rename = "alt-200-00")]
        alt_200_00 = 13,
        outOfRange = 14,
        unavailable = 15,
    }
    /// 0.01 m above the WGS84 ellipsoid, rounded up. CDD AltitudeValue, with its spelling of one name.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("-100000..=800001"))]
    pub struct AltitudeValue(pub i32);
    /// 0.1 degree, rounded up, at 95 %. CDD AngleConfidence.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("1..=127"))]
    pub struct AngleConfidence(pub u8);
    /// What every message of a moving station says of its sender. CDD BasicContainer.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct BasicContainer {
        #[rasn(identifier = "stationType")]
        #[serde(rename = "stationType")]
        pub station_type: TrafficParticipantType,
        #[rasn(identifier = "referencePosition")]
        #[serde(rename = "referencePosition")]
        pub reference_position: ReferencePositionWithConfidence,
    }
    impl BasicContainer {
        pub fn new(
            station_type: TrafficParticipantType,
            reference_position: ReferencePositionWithConfidence,
        ) -> Self {
            Self {
                station_type,
                reference_position,
            }
        }
    }
    /// Cardinal number of one octet. CDD CardinalNumber1B.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=255"))]
    pub struct CardinalNumber1B(pub u8);
    /// Angle counter-clockwise from the x axis. CDD CartesianAngle.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct CartesianAngle {
        pub value: CartesianAngleValue,
        pub confidence: AngleConfidence,
    }
    impl CartesianAngle {
        pub fn new(value: CartesianAngleValue, confidence: AngleConfidence) -> Self {
            Self { value, confidence }
        }
    }
    /// 0.1 degree counter-clockwise from the x axis. CDD CartesianAngleValue.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=3601"))]
    pub struct CartesianAngleValue(pub u16);
    /// 0.01 m. CDD CartesianCoordinate.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("-32768..=32767"))]
    pub struct CartesianCoordinate(pub i16);
    /// 0.01 m. CDD CartesianCoordinateSmall.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("-3094..=1001"))]
    pub struct CartesianCoordinateSmall(pub i16);
    /// Position in a local frame: x to the east, y to the north, z up. CDD CartesianPosition3d.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct CartesianPosition3d {
        #[rasn(identifier = "xCoordinate")]
        #[serde(rename = "xCoordinate")]
        pub x_coordinate: CartesianCoordinate,
        #[rasn(identifier = "yCoordinate")]
        #[serde(rename = "yCoordinate")]
        pub y_coordinate: CartesianCoordinate,
        #[rasn(identifier = "zCoordinate")]
        #[serde(rename = "zCoordinate")]
        pub z_coordinate: Option<CartesianCoordinate>,
    }
    impl CartesianPosition3d {
        pub fn new(
            x_coordinate: CartesianCoordinate,
            y_coordinate: CartesianCoordinate,
            z_coordinate: Option<CartesianCoordinate>,
        ) -> Self {
            Self {
                x_coordinate,
                y_coordinate,
                z_coordinate,
            }
        }
    }
    /// Circle. CDD CircularShape.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct CircularShape {
        #[rasn(identifier = "shapeReferencePoint")]
        #[serde(rename = "shapeReferencePoint")]
        pub shape_reference_point: Option<CartesianPosition3d>,
        pub radius: StandardLength12b,
        pub height: Option<StandardLength12b>,
    }
    impl CircularShape {
        pub fn new(
            shape_reference_point: Option<CartesianPosition3d>,
            radius: StandardLength12b,
            height: Option<StandardLength12b>,
        ) -> Self {
            Self {
                shape_reference_point,
                radius,
                height,
            }
        }
    }
    /// Announces that the sender breaks its group up. CDD ClusterBreakupInfo.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct ClusterBreakupInfo {
        #[rasn(identifier = "clusterBreakupReason")]
        #[serde(rename = "clusterBreakupReason")]
        pub cluster_breakup_reason: ClusterBreakupReason,
        #[rasn(identifier = "breakupTime")]
        #[serde(rename = "breakupTime")]
        pub breakup_time: DeltaTimeQuarterSecond,
    }
    impl ClusterBreakupInfo {
        pub fn new(
            cluster_breakup_reason: ClusterBreakupReason,
            breakup_time: DeltaTimeQuarterSecond,
        ) -> Self {
            Self {
                cluster_breakup_reason,
                breakup_time,
            }
        }
    }
    /// Why it breaks up. CDD ClusterBreakupReason.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=15"))]
    pub struct ClusterBreakupReason(pub u8);
    /// Announces that the sender joins a group. CDD ClusterJoinInfo.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct ClusterJoinInfo {
        #[rasn(identifier = "clusterId")]
        #[serde(rename = "clusterId")]
        pub cluster_id: Identifier1B,
        #[rasn(identifier = "joinTime")]
        #[serde(rename = "joinTime")]
        pub join_time: DeltaTimeQuarterSecond,
    }
    impl ClusterJoinInfo {
        pub fn new(cluster_id: Identifier1B, join_time: DeltaTimeQuarterSecond) -> Self {
            Self {
                cluster_id,
                join_time,
            }
        }
    }
    /// Announces that the sender has left a group. CDD ClusterLeaveInfo.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct ClusterLeaveInfo {
        #[rasn(identifier = "clusterId")]
        #[serde(rename = "clusterId")]
        pub cluster_id: Identifier1B,
        #[rasn(identifier = "clusterLeaveReason")]
        #[serde(rename = "clusterLeaveReason")]
        pub cluster_leave_reason: ClusterLeaveReason,
    }
    impl ClusterLeaveInfo {
        pub fn new(cluster_id: Identifier1B, cluster_leave_reason: ClusterLeaveReason) -> Self {
            Self {
                cluster_id,
                cluster_leave_reason,
            }
        }
    }
    /// Why it left. CDD ClusterLeaveReason.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=15"))]
    pub struct ClusterLeaveReason(pub u8);
    /// 1 %. CDD ConfidenceLevel.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("1..=101"))]
    pub struct ConfidenceLevel(pub u8);
    /// Curvature of the path. CDD Curvature.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct Curvature {
        #[rasn(identifier = "curvatureValue")]
        #[serde(rename = "curvatureValue")]
        pub curvature_value: CurvatureValue,
        #[rasn(identifier = "curvatureConfidence")]
        #[serde(rename = "curvatureConfidence")]
        pub curvature_confidence: CurvatureConfidence,
    }
    impl Curvature {
        pub fn new(
            curvature_value: CurvatureValue,
            curvature_confidence: CurvatureConfidence,
        ) -> Self {
            Self {
                curvature_value,
                curvature_confidence,
            }
        }
    }
    /// Whether the yaw rate went into the curvature. CDD CurvatureCalculationMode.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    #[non_exhaustive]
    pub enum CurvatureCalculationMode {
        yawRateUsed = 0,
        yawRateNotUsed = 1,
        unavailable = 2,
    }
    /// Largest error of the curvature at 95 %, in 1/m. CDD CurvatureConfidence.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    pub enum CurvatureConfidence {
        #[rasn(identifier = "onePerMeter-0-00002")]
        #[serde(rename = "onePerMeter-0-00002")]
        onePerMeter_0_00002 = 0,
        #[rasn(identifier = "onePerMeter-0-0001")]
        #[serde(rename = "onePerMeter-0-0001")]
        onePerMeter_0_0001 = 1,
        #[rasn(identifier = "onePerMeter-0-0005")]
        #[serde(rename = "onePerMeter-0-0005")]
        onePerMeter_0_0005 = 2,
        #[rasn(identifier = "onePerMeter-0-002")]
        #[serde(rename = "onePerMeter-0-002")]
        onePerMeter_0_002 = 3,
        #[rasn(identifier = "onePerMeter-0-01")]
        #[serde(rename = "onePerMeter-0-01")]
        onePerMeter_0_01 = 4,
        #[rasn(identifier = "onePerMeter-0-1")]
        #[serde(rename = "onePerMeter-0-1")]
        onePerMeter_0_1 = 5,
        outOfRange = 6,
        unavailable = 7,
    }
    /// 10^-4 1/m, rounded up, to the left positive. CDD CurvatureValue.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("-1023..=1023"))]
    pub struct CurvatureValue(pub i16);
    /// 0.01 m, upwards positive. CDD DeltaAltitude.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("-12700..=12800"))]
    pub struct DeltaAltitude(pub i16);
    /// 10^-7 degree, to the north positive. CDD DeltaLatitude.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("-131071..=131072"))]
    pub struct DeltaLatitude(pub i32);
    /// 10^-7 degree, to the east positive. CDD DeltaLongitude.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("-131071..=131072"))]
    pub struct DeltaLongitude(pub i32);
    /// Position relative to another one. CDD DeltaReferencePosition.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct DeltaReferencePosition {
        #[rasn(identifier = "deltaLatitude")]
        #[serde(rename = "deltaLatitude")]
        pub delta_latitude: DeltaLatitude,
        #[rasn(identifier = "deltaLongitude")]
        #[serde(rename = "deltaLongitude")]
        pub delta_longitude: DeltaLongitude,
        #[rasn(identifier = "deltaAltitude")]
        #[serde(rename = "deltaAltitude")]
        pub delta_altitude: DeltaAltitude,
    }
    impl DeltaReferencePosition {
        pub fn new(
            delta_latitude: DeltaLatitude,
            delta_longitude: DeltaLongitude,
            delta_altitude: DeltaAltitude,
        ) -> Self {
            Self {
                delta_latitude,
                delta_longitude,
                delta_altitude,
            }
        }
    }
    /// A point in time as the upper octet of a GenerationDeltaTime: 256 ms. CDD DeltaTimeQuarterSecond.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("1..=255"))]
    pub struct DeltaTimeQuarterSecond(pub u8);
    /// 1 s. CDD DeltaTimeSecond.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=86400"))]
    pub struct DeltaTimeSecond(pub u32);
    /// 10 s. CDD DeltaTimeTenSeconds.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=127"))]
    pub struct DeltaTimeTenSeconds(pub u8);
    /// 0.1 s. CDD DeltaTimeTenthOfSecond.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=127"))]
    pub struct DeltaTimeTenthOfSecond(pub u8);
    /// Direction of a lane. CDD Direction.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=3"))]
    pub struct Direction(pub u8);
    /// Forward or backward. CDD DriveDirection.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    pub enum DriveDirection {
        forward = 0,
        backward = 1,
        unavailable = 2,
    }
    /// Ellipse by its half axes. CDD EllipticalShape.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct EllipticalShape {
        #[rasn(identifier = "shapeReferencePoint")]
        #[serde(rename = "shapeReferencePoint")]
        pub shape_reference_point: Option<CartesianPosition3d>,
        #[rasn(identifier = "semiMajorAxisLength")]
        #[serde(rename = "semiMajorAxisLength")]
        pub semi_major_axis_length: StandardLength12b,
        #[rasn(identifier = "semiMinorAxisLength")]
        #[serde(rename = "semiMinorAxisLength")]
        pub semi_minor_axis_length: StandardLength12b,
        pub orientation: Option<CartesianAngleValue>,
        pub height: Option<StandardLength12b>,
    }
    impl EllipticalShape {
        pub fn new(
            shape_reference_point: Option<CartesianPosition3d>,
            semi_major_axis_length: StandardLength12b,
            semi_minor_axis_length: StandardLength12b,
            orientation: Option<CartesianAngleValue>,
            height: Option<StandardLength12b>,
        ) -> Self {
            Self {
                shape_reference_point,
                semi_major_axis_length,
                semi_minor_axis_length,
                orientation,
                height,
            }
        }
    }
    /// Lights of a vehicle that are on. CDD ExteriorLights.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate)]
    pub struct ExteriorLights(#[serde(with = "crate::asn1::view::fixed_bits")] pub FixedBitString<8usize>);
    /// Place on the road, by lane and by map. CDD GeneralizedLanePosition.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct GeneralizedLanePosition {
        #[rasn(identifier = "lanePositionBased")]
        #[serde(rename = "lanePositionBased")]
        pub lane_position_based: LanePositionOptions,
        #[rasn(identifier = "mapBased")]
        #[serde(rename = "mapBased")]
        pub map_based: Option<MapPosition>,
        pub confidence: MetaInformation,
    }
    impl GeneralizedLanePosition {
        pub fn new(
            lane_position_based: LanePositionOptions,
            map_based: Option<MapPosition>,
            confidence: MetaInformation,
        ) -> Self {
            Self {
                lane_position_based,
                map_based,
                confidence,
            }
        }
    }
    /// TimestampIts modulo 65536: 1 ms, the time to which the reference position belongs. CDD
    /// GenerationDeltaTime.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=65535"))]
    pub struct GenerationDeltaTime(pub u16);
    /// Position without confidence. CDD GeoPosition.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct GeoPosition {
        pub latitude: Latitude,
        pub longitude: Longitude,
        #[rasn(default = "geo_position_altitude_default")]
        pub altitude: AltitudeValue,
    }
    impl GeoPosition {
        pub fn new(latitude: Latitude, longitude: Longitude, altitude: AltitudeValue) -> Self {
            Self {
                latitude,
                longitude,
                altitude,
            }
        }
    }
    fn geo_position_altitude_default() -> AltitudeValue {
        AltitudeValue(800001)
    }
    /// Heading that is about to change. CDD HeadingChangeIndication.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct HeadingChangeIndication {
        pub direction: TurningDirection,
        #[rasn(identifier = "actionDeltaTime")]
        #[serde(rename = "actionDeltaTime")]
        pub action_delta_time: DeltaTimeTenthOfSecond,
    }
    impl HeadingChangeIndication {
        pub fn new(direction: TurningDirection, action_delta_time: DeltaTimeTenthOfSecond) -> Self {
            Self {
                direction,
                action_delta_time,
            }
        }
    }
    /// 0.1 degree clockwise from WGS84 north. CDD HeadingValue.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=3601"))]
    pub struct HeadingValue(pub u16);
    /// Identifier of one octet. CDD Identifier1B.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=255"))]
    pub struct Identifier1B(pub u8);
    /// Identifier of two octets. CDD Identifier2B.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=65535"))]
    pub struct Identifier2B(pub u16);
    /// Intersection, unique within its region. CDD IntersectionReferenceId.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct IntersectionReferenceId {
        pub region: Option<Identifier2B>,
        pub id: Identifier2B,
    }
    impl IntersectionReferenceId {
        pub fn new(region: Option<Identifier2B>, id: Identifier2B) -> Self {
            Self { region, id }
        }
    }
    /// The six octets that begin every facilities message. CDD ItsPduHeader.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct ItsPduHeader {
        #[rasn(identifier = "protocolVersion")]
        #[serde(rename = "protocolVersion")]
        pub protocol_version: OrdinalNumber1B,
        #[rasn(identifier = "messageId")]
        #[serde(rename = "messageId")]
        pub message_id: MessageId,
        #[rasn(identifier = "stationId")]
        #[serde(rename = "stationId")]
        pub station_id: StationId,
    }
    impl ItsPduHeader {
        pub fn new(
            protocol_version: OrdinalNumber1B,
            message_id: MessageId,
            station_id: StationId,
        ) -> Self {
            Self {
                protocol_version,
                message_id,
                station_id,
            }
        }
    }
    /// Lane counted from the inside of the road to its outside. CDD LanePosition.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("-1..=14"))]
    pub struct LanePosition(pub i8);
    /// Lane with its use and direction. CDD LanePositionAndType.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct LanePositionAndType {
        #[rasn(identifier = "transversalPosition")]
        #[serde(rename = "transversalPosition")]
        pub transversal_position: LanePosition,
        #[rasn(
            default = "lane_position_and_type_lane_type_default",
            identifier = "laneType"
        )]
        #[serde(rename = "laneType")]
        pub lane_type: LaneType,
        #[rasn(default = "lane_position_and_type_direction_default")]
        pub direction: Direction,
    }
    impl LanePositionAndType {
        pub fn new(
            transversal_position: LanePosition,
            lane_type: LaneType,
            direction: Direction,
        ) -> Self {
            Self {
                transversal_position,
                lane_type,
                direction,
            }
        }
    }
    fn lane_position_and_type_lane_type_default() -> LaneType {
        LaneType(0)
    }
    fn lane_position_and_type_direction_default() -> Direction {
        Direction(0)
    }
    /// Place across the road, as exactly as it is known. CDD LanePositionOptions.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(choice, automatic_tags)]
    #[non_exhaustive]
    pub enum LanePositionOptions {
        simplelanePosition(LanePosition),
        simpleLaneType(LaneType),
        detailedlanePosition(LanePositionAndType),
        lanePositionWithLateralDetails(LanePositionWithLateralDetails),
        trafficIslandPosition(TrafficIslandPosition),
    }
    /// Lane with its use, direction and the distance to its borders. CDD LanePositionWithLateralDetails.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct LanePositionWithLateralDetails {
        #[rasn(identifier = "transversalPosition")]
        #[serde(rename = "transversalPosition")]
        pub transversal_position: LanePosition,
        #[rasn(
            default = "lane_position_with_lateral_details_lane_type_default",
            identifier = "laneType"
        )]
        #[serde(rename = "laneType")]
        pub lane_type: LaneType,
        #[rasn(default = "lane_position_with_lateral_details_direction_default")]
        pub direction: Direction,
        #[rasn(identifier = "distanceToLeftBorder")]
        #[serde(rename = "distanceToLeftBorder")]
        pub distance_to_left_border: StandardLength9b,
        #[rasn(identifier = "distanceToRightBorder")]
        #[serde(rename = "distanceToRightBorder")]
        pub distance_to_right_border: StandardLength9b,
    }
    impl LanePositionWithLateralDetails {
        pub fn new(
            transversal_position: LanePosition,
            lane_type: LaneType,
            direction: Direction,
            distance_to_left_border: StandardLength9b,
            distance_to_right_border: StandardLength9b,
        ) -> Self {
            Self {
                transversal_position,
                lane_type,
                direction,
                distance_to_left_border,
                distance_to_right_border,
            }
        }
    }
    fn lane_position_with_lateral_details_lane_type_default() -> LaneType {
        LaneType(0)
    }
    fn lane_position_with_lateral_details_direction_default() -> Direction {
        Direction(0)
    }
    /// Use of a lane. CDD LaneType.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=31"))]
    pub struct LaneType(pub u8);
    /// Lateral acceleration, to the left positive. CDD LateralAcceleration.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct LateralAcceleration {
        #[rasn(identifier = "lateralAccelerationValue")]
        #[serde(rename = "lateralAccelerationValue")]
        pub lateral_acceleration_value: LateralAccelerationValue,
        #[rasn(identifier = "lateralAccelerationConfidence")]
        #[serde(rename = "lateralAccelerationConfidence")]
        pub lateral_acceleration_confidence: AccelerationConfidence,
    }
    impl LateralAcceleration {
        pub fn new(
            lateral_acceleration_value: LateralAccelerationValue,
            lateral_acceleration_confidence: AccelerationConfidence,
        ) -> Self {
            Self {
                lateral_acceleration_value,
                lateral_acceleration_confidence,
            }
        }
    }
    /// 0.1 m/s^2, rounded up. CDD LateralAccelerationValue.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("-160..=161"))]
    pub struct LateralAccelerationValue(pub i16);
    /// 10^-7 degree, north positive. CDD Latitude.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("-900000000..=900000001"))]
    pub struct Latitude(pub i32);
    /// 10^-7 degree, east positive. CDD Longitude.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("-1800000000..=1800000001"))]
    pub struct Longitude(pub i32);
    /// Longitudinal acceleration, speeding up positive. CDD LongitudinalAcceleration.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct LongitudinalAcceleration {
        #[rasn(identifier = "longitudinalAccelerationValue")]
        #[serde(rename = "longitudinalAccelerationValue")]
        pub longitudinal_acceleration_value: LongitudinalAccelerationValue,
        #[rasn(identifier = "longitudinalAccelerationConfidence")]
        #[serde(rename = "longitudinalAccelerationConfidence")]
        pub longitudinal_acceleration_confidence: AccelerationConfidence,
    }
    impl LongitudinalAcceleration {
        pub fn new(
            longitudinal_acceleration_value: LongitudinalAccelerationValue,
            longitudinal_acceleration_confidence: AccelerationConfidence,
        ) -> Self {
            Self {
                longitudinal_acceleration_value,
                longitudinal_acceleration_confidence,
            }
        }
    }
    /// 0.1 m/s^2, rounded up. CDD LongitudinalAccelerationValue.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("-160..=161"))]
    pub struct LongitudinalAccelerationValue(pub i16);
    /// Distance along a lane. CDD LongitudinalLanePosition.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct LongitudinalLanePosition {
        #[rasn(identifier = "longitudinalLanePositionValue")]
        #[serde(rename = "longitudinalLanePositionValue")]
        pub longitudinal_lane_position_value: LongitudinalLanePositionValue,
        #[rasn(identifier = "longitudinalLanePositionConfidence")]
        #[serde(rename = "longitudinalLanePositionConfidence")]
        pub longitudinal_lane_position_confidence: LongitudinalLanePositionConfidence,
    }
    impl LongitudinalLanePosition {
        pub fn new(
            longitudinal_lane_position_value: LongitudinalLanePositionValue,
            longitudinal_lane_position_confidence: LongitudinalLanePositionConfidence,
        ) -> Self {
            Self {
                longitudinal_lane_position_value,
                longitudinal_lane_position_confidence,
            }
        }
    }
    /// 0.1 m, at 95 %. CDD LongitudinalLanePositionConfidence.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=1023"))]
    pub struct LongitudinalLanePositionConfidence(pub u16);
    /// 0.1 m. CDD LongitudinalLanePositionValue.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=32767"))]
    pub struct LongitudinalLanePositionValue(pub u16);
    /// Place by reference to a MAPEM. CDD MapPosition.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct MapPosition {
        #[rasn(identifier = "mapReference")]
        #[serde(rename = "mapReference")]
        pub map_reference: Option<MapReference>,
        #[rasn(identifier = "laneId")]
        #[serde(rename = "laneId")]
        pub lane_id: Option<Identifier1B>,
        #[rasn(identifier = "connectionId")]
        #[serde(rename = "connectionId")]
        pub connection_id: Option<Identifier1B>,
        #[rasn(identifier = "longitudinalLanePosition")]
        #[serde(rename = "longitudinalLanePosition")]
        pub longitudinal_lane_position: Option<LongitudinalLanePosition>,
    }
    impl MapPosition {
        pub fn new(
            map_reference: Option<MapReference>,
            lane_id: Option<Identifier1B>,
            connection_id: Option<Identifier1B>,
            longitudinal_lane_position: Option<LongitudinalLanePosition>,
        ) -> Self {
            Self {
                map_reference,
                lane_id,
                connection_id,
                longitudinal_lane_position,
            }
        }
    }
    /// Road segment or intersection of a MAPEM. CDD MapReference.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(choice, automatic_tags)]
    pub enum MapReference {
        roadsegment(RoadSegmentReferenceId),
        intersection(IntersectionReferenceId),
    }
    /// Kind of message. CDD MessageId; values without a name are not assigned.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=255"))]
    pub struct MessageId(pub u8);
    /// What an estimate rests on. CDD MetaInformation.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct MetaInformation {
        #[rasn(identifier = "usedDetectionInformation")]
        #[serde(rename = "usedDetectionInformation")]
        pub used_detection_information: SensorTypes,
        #[rasn(identifier = "usedStoredInformation")]
        #[serde(rename = "usedStoredInformation")]
        pub used_stored_information: StoredInformationType,
        #[rasn(identifier = "confidenceValue")]
        #[serde(rename = "confidenceValue")]
        pub confidence_value: Option<ConfidenceLevel>,
    }
    impl MetaInformation {
        pub fn new(
            used_detection_information: SensorTypes,
            used_stored_information: StoredInformationType,
            confidence_value: Option<ConfidenceLevel>,
        ) -> Self {
            Self {
                used_detection_information,
                used_stored_information,
                confidence_value,
            }
        }
    }
    /// 0.1 m, rounded up; 255 stands for more than 25.4 m. CDD ObjectDimensionValue.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("1..=256"))]
    pub struct ObjectDimensionValue(pub u16);
    /// Ordinal number of one octet. CDD OrdinalNumber1B.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=255"))]
    pub struct OrdinalNumber1B(pub u8);
    /// 10 ms. CDD PathDeltaTime.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("1..=65535", extensible))]
    pub struct PathDeltaTime(#[serde(with = "crate::asn1::view::integer")] pub Integer);
    /// Time until a predicted position is reached. CDD PathDeltaTimeChoice.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(choice, automatic_tags)]
    #[non_exhaustive]
    pub enum PathDeltaTimeChoice {
        deltaTimeHighPrecision(DeltaTimeTenthOfSecond),
        deltaTimeBigRange(DeltaTimeTenSeconds),
        #[rasn(extension_addition)]
        deltaTimeMidRange(DeltaTimeSecond),
    }
    /// Positions that the sender came from, newest first, each relative to the one before it. CDD
    /// PathHistory.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, size("0..=40"))]
    pub struct PathHistory(pub SequenceOf<PathPoint>);
    /// One position of a path, and the time from there to the one before it. CDD PathPoint.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct PathPoint {
        #[rasn(identifier = "pathPosition")]
        #[serde(rename = "pathPosition")]
        pub path_position: DeltaReferencePosition,
        #[rasn(identifier = "pathDeltaTime")]
        #[serde(rename = "pathDeltaTime")]
        pub path_delta_time: Option<PathDeltaTime>,
    }
    impl PathPoint {
        pub fn new(
            path_position: DeltaReferencePosition,
            path_delta_time: Option<PathDeltaTime>,
        ) -> Self {
            Self {
                path_position,
                path_delta_time,
            }
        }
    }
    /// One predicted position, relative to the reference position. CDD PathPointPredicted.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct PathPointPredicted {
        #[rasn(identifier = "deltaLatitude")]
        #[serde(rename = "deltaLatitude")]
        pub delta_latitude: DeltaLatitude,
        #[rasn(identifier = "deltaLongitude")]
        #[serde(rename = "deltaLongitude")]
        pub delta_longitude: DeltaLongitude,
        #[rasn(identifier = "horizontalPositionConfidence")]
        #[serde(rename = "horizontalPositionConfidence")]
        pub horizontal_position_confidence: Option<PosConfidenceEllipse>,
        #[rasn(
            default = "path_point_predicted_delta_altitude_default",
            identifier = "deltaAltitude"
        )]
        #[serde(rename = "deltaAltitude")]
        pub delta_altitude: DeltaAltitude,
        #[rasn(
            default = "path_point_predicted_altitude_confidence_default",
            identifier = "altitudeConfidence"
        )]
        #[serde(rename = "altitudeConfidence")]
        pub altitude_confidence: AltitudeConfidence,
        #[rasn(identifier = "pathDeltaTime")]
        #[serde(rename = "pathDeltaTime")]
        pub path_delta_time: Option<PathDeltaTimeChoice>,
        #[rasn(identifier = "symmetricAreaOffset")]
        #[serde(rename = "symmetricAreaOffset")]
        pub symmetric_area_offset: Option<StandardLength9b>,
        #[rasn(identifier = "asymmetricAreaOffset")]
        #[serde(rename = "asymmetricAreaOffset")]
        pub asymmetric_area_offset: Option<StandardLength9b>,
    }
    impl PathPointPredicted {
        pub fn new(
            delta_latitude: DeltaLatitude,
            delta_longitude: DeltaLongitude,
            horizontal_position_confidence: Option<PosConfidenceEllipse>,
            delta_altitude: DeltaAltitude,
            altitude_confidence: AltitudeConfidence,
            path_delta_time: Option<PathDeltaTimeChoice>,
            symmetric_area_offset: Option<StandardLength9b>,
            asymmetric_area_offset: Option<StandardLength9b>,
        ) -> Self {
            Self {
                delta_latitude,
                delta_longitude,
                horizontal_position_confidence,
                delta_altitude,
                altitude_confidence,
                path_delta_time,
                symmetric_area_offset,
                asymmetric_area_offset,
            }
        }
    }
    fn path_point_predicted_delta_altitude_default() -> DeltaAltitude {
        DeltaAltitude(12800)
    }
    fn path_point_predicted_altitude_confidence_default() -> AltitudeConfidence {
        AltitudeConfidence::unavailable
    }
    /// Positions that the sender expects to take, nearest first. CDD PathPredicted, which also names the
    /// sizes 17..40 behind the marker; that changes no bit, and asn1c 0.9.28 does not understand it.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, size("1..=16", extensible))]
    pub struct PathPredicted(pub SequenceOf<PathPointPredicted>);
    /// Polygon of three corners or more. CDD PolygonalShape.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct PolygonalShape {
        #[rasn(identifier = "shapeReferencePoint")]
        #[serde(rename = "shapeReferencePoint")]
        pub shape_reference_point: Option<CartesianPosition3d>,
        #[rasn(size("3..=16", extensible))]
        pub polygon: SequenceOf<CartesianPosition3d>,
        pub height: Option<StandardLength12b>,
    }
    impl PolygonalShape {
        pub fn new(
            shape_reference_point: Option<CartesianPosition3d>,
            polygon: SequenceOf<CartesianPosition3d>,
            height: Option<StandardLength12b>,
        ) -> Self {
            Self {
                shape_reference_point,
                polygon,
                height,
            }
        }
    }
    /// The same ellipse under its older field names. CDD PosConfidenceEllipse.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct PosConfidenceEllipse {
        #[rasn(identifier = "semiMajorConfidence")]
        #[serde(rename = "semiMajorConfidence")]
        pub semi_major_confidence: SemiAxisLength,
        #[rasn(identifier = "semiMinorConfidence")]
        #[serde(rename = "semiMinorConfidence")]
        pub semi_minor_confidence: SemiAxisLength,
        #[rasn(identifier = "semiMajorOrientation")]
        #[serde(rename = "semiMajorOrientation")]
        pub semi_major_orientation: HeadingValue,
    }
    impl PosConfidenceEllipse {
        pub fn new(
            semi_major_confidence: SemiAxisLength,
            semi_minor_confidence: SemiAxisLength,
            semi_major_orientation: HeadingValue,
        ) -> Self {
            Self {
                semi_major_confidence,
                semi_minor_confidence,
                semi_major_orientation,
            }
        }
    }
    /// Ellipse that holds the true position with a confidence of 95 %. CDD PositionConfidenceEllipse.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct PositionConfidenceEllipse {
        #[rasn(identifier = "semiMajorAxisLength")]
        #[serde(rename = "semiMajorAxisLength")]
        pub semi_major_axis_length: SemiAxisLength,
        #[rasn(identifier = "semiMinorAxisLength")]
        #[serde(rename = "semiMinorAxisLength")]
        pub semi_minor_axis_length: SemiAxisLength,
        #[rasn(identifier = "semiMajorAxisOrientation")]
        #[serde(rename = "semiMajorAxisOrientation")]
        pub semi_major_axis_orientation: Wgs84AngleValue,
    }
    impl PositionConfidenceEllipse {
        pub fn new(
            semi_major_axis_length: SemiAxisLength,
            semi_minor_axis_length: SemiAxisLength,
            semi_major_axis_orientation: Wgs84AngleValue,
        ) -> Self {
            Self {
                semi_major_axis_length,
                semi_minor_axis_length,
                semi_major_axis_orientation,
            }
        }
    }
    /// Sector of a circle. CDD RadialShape.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct RadialShape {
        #[rasn(identifier = "shapeReferencePoint")]
        #[serde(rename = "shapeReferencePoint")]
        pub shape_reference_point: Option<CartesianPosition3d>,
        pub range: StandardLength12b,
        #[rasn(identifier = "horizontalOpeningAngleStart")]
        #[serde(rename = "horizontalOpeningAngleStart")]
        pub horizontal_opening_angle_start: CartesianAngleValue,
        #[rasn(identifier = "horizontalOpeningAngleEnd")]
        #[serde(rename = "horizontalOpeningAngleEnd")]
        pub horizontal_opening_angle_end: CartesianAngleValue,
        #[rasn(identifier = "verticalOpeningAngleStart")]
        #[serde(rename = "verticalOpeningAngleStart")]
        pub vertical_opening_angle_start: Option<CartesianAngleValue>,
        #[rasn(identifier = "verticalOpeningAngleEnd")]
        #[serde(rename = "verticalOpeningAngleEnd")]
        pub vertical_opening_angle_end: Option<CartesianAngleValue>,
    }
    impl RadialShape {
        pub fn new(
            shape_reference_point: Option<CartesianPosition3d>,
            range: StandardLength12b,
            horizontal_opening_angle_start: CartesianAngleValue,
            horizontal_opening_angle_end: CartesianAngleValue,
            vertical_opening_angle_start: Option<CartesianAngleValue>,
            vertical_opening_angle_end: Option<CartesianAngleValue>,
        ) -> Self {
            Self {
                shape_reference_point,
                range,
                horizontal_opening_angle_start,
                horizontal_opening_angle_end,
                vertical_opening_angle_start,
                vertical_opening_angle_end,
            }
        }
    }
    /// One sector of several. CDD RadialShapeDetails.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct RadialShapeDetails {
        pub range: StandardLength12b,
        #[rasn(identifier = "horizontalOpeningAngleStart")]
        #[serde(rename = "horizontalOpeningAngleStart")]
        pub horizontal_opening_angle_start: CartesianAngleValue,
        #[rasn(identifier = "horizontalOpeningAngleEnd")]
        #[serde(rename = "horizontalOpeningAngleEnd")]
        pub horizontal_opening_angle_end: CartesianAngleValue,
        #[rasn(identifier = "verticalOpeningAngleStart")]
        #[serde(rename = "verticalOpeningAngleStart")]
        pub vertical_opening_angle_start: Option<CartesianAngleValue>,
        #[rasn(identifier = "verticalOpeningAngleEnd")]
        #[serde(rename = "verticalOpeningAngleEnd")]
        pub vertical_opening_angle_end: Option<CartesianAngleValue>,
    }
    impl RadialShapeDetails {
        pub fn new(
            range: StandardLength12b,
            horizontal_opening_angle_start: CartesianAngleValue,
            horizontal_opening_angle_end: CartesianAngleValue,
            vertical_opening_angle_start: Option<CartesianAngleValue>,
            vertical_opening_angle_end: Option<CartesianAngleValue>,
        ) -> Self {
            Self {
                range,
                horizontal_opening_angle_start,
                horizontal_opening_angle_end,
                vertical_opening_angle_start,
                vertical_opening_angle_end,
            }
        }
    }
    /// Several sectors around one point. CDD RadialShapes.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct RadialShapes {
        #[rasn(identifier = "refPointId")]
        #[serde(rename = "refPointId")]
        pub ref_point_id: Identifier1B,
        #[rasn(identifier = "xCoordinate")]
        #[serde(rename = "xCoordinate")]
        pub x_coordinate: CartesianCoordinateSmall,
        #[rasn(identifier = "yCoordinate")]
        #[serde(rename = "yCoordinate")]
        pub y_coordinate: CartesianCoordinateSmall,
        #[rasn(identifier = "zCoordinate")]
        #[serde(rename = "zCoordinate")]
        pub z_coordinate: Option<CartesianCoordinateSmall>,
        #[rasn(identifier = "radialShapesList")]
        #[serde(rename = "radialShapesList")]
        pub radial_shapes_list: RadialShapesList,
    }
    impl RadialShapes {
        pub fn new(
            ref_point_id: Identifier1B,
            x_coordinate: CartesianCoordinateSmall,
            y_coordinate: CartesianCoordinateSmall,
            z_coordinate: Option<CartesianCoordinateSmall>,
            radial_shapes_list: RadialShapesList,
        ) -> Self {
            Self {
                ref_point_id,
                x_coordinate,
                y_coordinate,
                z_coordinate,
                radial_shapes_list,
            }
        }
    }
    /// Sectors. CDD RadialShapesList.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, size("1..=16", extensible))]
    pub struct RadialShapesList(pub SequenceOf<RadialShapeDetails>);
    /// Rectangle by its half sides. CDD RectangularShape.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct RectangularShape {
        #[rasn(identifier = "shapeReferencePoint")]
        #[serde(rename = "shapeReferencePoint")]
        pub shape_reference_point: Option<CartesianPosition3d>,
        #[rasn(identifier = "semiLength")]
        #[serde(rename = "semiLength")]
        pub semi_length: StandardLength12b,
        #[rasn(identifier = "semiBreadth")]
        #[serde(rename = "semiBreadth")]
        pub semi_breadth: StandardLength12b,
        pub orientation: Option<CartesianAngleValue>,
        pub height: Option<StandardLength12b>,
    }
    impl RectangularShape {
        pub fn new(
            shape_reference_point: Option<CartesianPosition3d>,
            semi_length: StandardLength12b,
            semi_breadth: StandardLength12b,
            orientation: Option<CartesianAngleValue>,
            height: Option<StandardLength12b>,
        ) -> Self {
            Self {
                shape_reference_point,
                semi_length,
                semi_breadth,
                orientation,
                height,
            }
        }
    }
    /// Position with its 95 % confidence ellipse. CDD ReferencePositionWithConfidence.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct ReferencePositionWithConfidence {
        pub latitude: Latitude,
        pub longitude: Longitude,
        #[rasn(identifier = "positionConfidenceEllipse")]
        #[serde(rename = "positionConfidenceEllipse")]
        pub position_confidence_ellipse: PositionConfidenceEllipse,
        pub altitude: Altitude,
    }
    impl ReferencePositionWithConfidence {
        pub fn new(
            latitude: Latitude,
            longitude: Longitude,
            position_confidence_ellipse: PositionConfidenceEllipse,
            altitude: Altitude,
        ) -> Self {
            Self {
                latitude,
                longitude,
                position_confidence_ellipse,
                altitude,
            }
        }
    }
    /// Road segment, unique within its region. CDD RoadSegmentReferenceId.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct RoadSegmentReferenceId {
        pub region: Option<Identifier2B>,
        pub id: Identifier2B,
    }
    impl RoadSegmentReferenceId {
        pub fn new(region: Option<Identifier2B>, id: Identifier2B) -> Self {
            Self { region, id }
        }
    }
    /// Whether a safe distance to another station is kept. CDD SafeDistanceIndication.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct SafeDistanceIndication {
        #[rasn(identifier = "subjectStation")]
        #[serde(rename = "subjectStation")]
        pub subject_station: Option<StationId>,
        #[rasn(identifier = "safeDistanceIndicator")]
        #[serde(rename = "safeDistanceIndicator")]
        pub safe_distance_indicator: SafeDistanceIndicator,
        #[rasn(identifier = "timeToCollision")]
        #[serde(rename = "timeToCollision")]
        pub time_to_collision: Option<DeltaTimeTenthOfSecond>,
    }
    impl SafeDistanceIndication {
        pub fn new(
            subject_station: Option<StationId>,
            safe_distance_indicator: SafeDistanceIndicator,
            time_to_collision: Option<DeltaTimeTenthOfSecond>,
        ) -> Self {
            Self {
                subject_station,
                safe_distance_indicator,
                time_to_collision,
            }
        }
    }
    /// TRUE when the distance is safe. CDD SafeDistanceIndicator.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(delegate)]
    pub struct SafeDistanceIndicator(pub bool);
    /// 0.01 m, rounded up; 4094 stands for more than 40.93 m. CDD SemiAxisLength.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=4095"))]
    pub struct SemiAxisLength(pub u16);
    /// Sensors that took part. CDD SensorTypes.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, size("16", extensible))]
    pub struct SensorTypes(#[serde(with = "crate::asn1::view::bits")] pub BitString);
    /// Safe distances to several stations. CDD SequenceOfSafeDistanceIndication.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, size("1..=8", extensible))]
    pub struct SequenceOfSafeDistanceIndication(pub SequenceOf<SafeDistanceIndication>);
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, size("1..=8", extensible))]
    pub struct SequenceOfTrajectoryInterceptionIndication(
        pub SequenceOf<TrajectoryInterceptionIndication>,
    );
    /// Area or volume. CDD Shape.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(choice, automatic_tags)]
    #[non_exhaustive]
    pub enum Shape {
        rectangular(RectangularShape),
        circular(CircularShape),
        polygonal(PolygonalShape),
        elliptical(EllipticalShape),
        radial(RadialShape),
        radialShapes(RadialShapes),
    }
    /// Speed over ground. CDD Speed.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct Speed {
        #[rasn(identifier = "speedValue")]
        #[serde(rename = "speedValue")]
        pub speed_value: SpeedValue,
        #[rasn(identifier = "speedConfidence")]
        #[serde(rename = "speedConfidence")]
        pub speed_confidence: SpeedConfidence,
    }
    impl Speed {
        pub fn new(speed_value: SpeedValue, speed_confidence: SpeedConfidence) -> Self {
            Self {
                speed_value,
                speed_confidence,
            }
        }
    }
    /// 0.01 m/s, rounded up, at 95 %. CDD SpeedConfidence.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("1..=127"))]
    pub struct SpeedConfidence(pub u8);
    /// 0.01 m/s, rounded up; 16382 stands for more than 163.81 m/s. CDD SpeedValue.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=16383"))]
    pub struct SpeedValue(pub u16);
    /// Stability that is about to be lost. CDD StabilityChangeIndication.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct StabilityChangeIndication {
        #[rasn(identifier = "lossProbability")]
        #[serde(rename = "lossProbability")]
        pub loss_probability: StabilityLossProbability,
        #[rasn(identifier = "actionDeltaTime")]
        #[serde(rename = "actionDeltaTime")]
        pub action_delta_time: DeltaTimeTenthOfSecond,
    }
    impl StabilityChangeIndication {
        pub fn new(
            loss_probability: StabilityLossProbability,
            action_delta_time: DeltaTimeTenthOfSecond,
        ) -> Self {
            Self {
                loss_probability,
                action_delta_time,
            }
        }
    }
    /// 2 %. CDD StabilityLossProbability.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=63"))]
    pub struct StabilityLossProbability(pub u8);
    /// Length of twelve bits: 0.1 m. CDD StandardLength12b.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=4095"))]
    pub struct StandardLength12b(pub u16);
    /// Length of nine bits: 0.1 m. CDD StandardLength9b.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=511"))]
    pub struct StandardLength9b(pub u16);
    /// Identifier of an ITS station, its current pseudonym. CDD StationId.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=4294967295"))]
    pub struct StationId(pub u32);
    /// Stored information that took part. CDD StoredInformationType.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, size("8", extensible))]
    pub struct StoredInformationType(#[serde(with = "crate::asn1::view::bits")] pub BitString);
    /// Milliseconds since 2004-01-01T00:00:00 UTC, leap seconds counted. CDD TimestampIts.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=4398046511103"))]
    pub struct TimestampIts(pub u64);
    /// Place on an island between two lanes. CDD TrafficIslandPosition.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct TrafficIslandPosition {
        #[rasn(identifier = "oneSide")]
        #[serde(rename = "oneSide")]
        pub one_side: LanePositionAndType,
        #[rasn(identifier = "otherSide")]
        #[serde(rename = "otherSide")]
        pub other_side: LanePositionAndType,
    }
    impl TrafficIslandPosition {
        pub fn new(one_side: LanePositionAndType, other_side: LanePositionAndType) -> Self {
            Self {
                one_side,
                other_side,
            }
        }
    }
    /// Kind of road user. CDD TrafficParticipantType.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=255"))]
    pub struct TrafficParticipantType(pub u8);
    /// Confidence of that probability. CDD TrajectoryInterceptionConfidence.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=3"))]
    pub struct TrajectoryInterceptionConfidence(pub u8);
    /// How probable it is that the trajectories cross. CDD TrajectoryInterceptionIndication.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct TrajectoryInterceptionIndication {
        #[rasn(identifier = "subjectStation")]
        #[serde(rename = "subjectStation")]
        pub subject_station: Option<StationId>,
        #[rasn(identifier = "trajectoryInterceptionProbability")]
        #[serde(rename = "trajectoryInterceptionProbability")]
        pub trajectory_interception_probability: TrajectoryInterceptionProbability,
        #[rasn(identifier = "trajectoryInterceptionConfidence")]
        #[serde(rename = "trajectoryInterceptionConfidence")]
        pub trajectory_interception_confidence: Option<TrajectoryInterceptionConfidence>,
    }
    impl TrajectoryInterceptionIndication {
        pub fn new(
            subject_station: Option<StationId>,
            trajectory_interception_probability: TrajectoryInterceptionProbability,
            trajectory_interception_confidence: Option<TrajectoryInterceptionConfidence>,
        ) -> Self {
            Self {
                subject_station,
                trajectory_interception_probability,
                trajectory_interception_confidence,
            }
        }
    }
    /// 2 %. CDD TrajectoryInterceptionProbability.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=63"))]
    pub struct TrajectoryInterceptionProbability(pub u8);
    /// Left or right. CDD TurningDirection.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    pub enum TurningDirection {
        left = 0,
        right = 1,
    }
    /// Vertical acceleration, upwards positive. CDD VerticalAcceleration.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct VerticalAcceleration {
        #[rasn(identifier = "verticalAccelerationValue")]
        #[serde(rename = "verticalAccelerationValue")]
        pub vertical_acceleration_value: VerticalAccelerationValue,
        #[rasn(identifier = "verticalAccelerationConfidence")]
        #[serde(rename = "verticalAccelerationConfidence")]
        pub vertical_acceleration_confidence: AccelerationConfidence,
    }
    impl VerticalAcceleration {
        pub fn new(
            vertical_acceleration_value: VerticalAccelerationValue,
            vertical_acceleration_confidence: AccelerationConfidence,
        ) -> Self {
            Self {
                vertical_acceleration_value,
                vertical_acceleration_confidence,
            }
        }
    }
    /// 0.1 m/s^2, rounded up. CDD VerticalAccelerationValue.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("-160..=161"))]
    pub struct VerticalAccelerationValue(pub i16);
    /// Group of road users that move together. Only a rectangle, a circle or a polygon bounds it. CDD
    /// VruClusterInformation.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct VruClusterInformation {
        #[rasn(identifier = "clusterId")]
        #[serde(rename = "clusterId")]
        pub cluster_id: Option<Identifier1B>,
        #[rasn(identifier = "clusterBoundingBoxShape")]
        #[serde(rename = "clusterBoundingBoxShape")]
        pub cluster_bounding_box_shape: Option<Shape>,
        #[rasn(identifier = "clusterCardinalitySize")]
        #[serde(rename = "clusterCardinalitySize")]
        pub cluster_cardinality_size: CardinalNumber1B,
        #[rasn(identifier = "clusterProfiles")]
        #[serde(rename = "clusterProfiles")]
        pub cluster_profiles: Option<VruClusterProfiles>,
    }
    impl VruClusterInformation {
        pub fn new(
            cluster_id: Option<Identifier1B>,
            cluster_bounding_box_shape: Option<Shape>,
            cluster_cardinality_size: CardinalNumber1B,
            cluster_profiles: Option<VruClusterProfiles>,
        ) -> Self {
            Self {
                cluster_id,
                cluster_bounding_box_shape,
                cluster_cardinality_size,
                cluster_profiles,
            }
        }
    }
    /// Kinds of road users in a group. CDD VruClusterProfiles.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate)]
    pub struct VruClusterProfiles(#[serde(with = "crate::asn1::view::fixed_bits")] pub FixedBitString<4usize>);
    /// What a road user does with a device. CDD VruDeviceUsage.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=15"))]
    pub struct VruDeviceUsage(pub u8);
    /// Where a road user is. CDD VruEnvironment.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=15"))]
    pub struct VruEnvironment(pub u8);
    /// Lights of a road user. CDD VruExteriorLights.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct VruExteriorLights {
        pub vehicular: ExteriorLights,
        #[rasn(identifier = "vruSpecific")]
        #[serde(rename = "vruSpecific")]
        pub vru_specific: VruSpecificExteriorLights,
    }
    impl VruExteriorLights {
        pub fn new(vehicular: ExteriorLights, vru_specific: VruSpecificExteriorLights) -> Self {
            Self {
                vehicular,
                vru_specific,
            }
        }
    }
    /// How a road user controls the motion. CDD VruMovementControl.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=15"))]
    pub struct VruMovementControl(pub u8);
    /// Kind of road user, in detail. CDD VruProfileAndSubprofile.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(choice, automatic_tags)]
    #[non_exhaustive]
    pub enum VruProfileAndSubprofile {
        pedestrian(VruSubProfilePedestrian),
        bicyclistAndLightVruVehicle(VruSubProfileBicyclist),
        motorcyclist(VruSubProfileMotorcyclist),
        animal(VruSubProfileAnimal),
    }
    /// Size of a road user. CDD VruSizeClass.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=15"))]
    pub struct VruSizeClass(pub u8);
    /// Lights that only vulnerable road users have. CDD VruSpecificExteriorLights.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate)]
    pub struct VruSpecificExteriorLights(#[serde(with = "crate::asn1::view::fixed_bits")] pub FixedBitString<8usize>);
    /// Kind of animal. CDD VruSubProfileAnimal.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=15"))]
    pub struct VruSubProfileAnimal(pub u8);
    /// Kind of bicyclist or light vehicle. CDD VruSubProfileBicyclist.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=15"))]
    pub struct VruSubProfileBicyclist(pub u8);
    /// Kind of motorcyclist. CDD VruSubProfileMotorcyclist.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=15"))]
    pub struct VruSubProfileMotorcyclist(pub u8);
    /// Kind of pedestrian. CDD VruSubProfilePedestrian.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=15"))]
    pub struct VruSubProfilePedestrian(pub u8);
    /// Angle clockwise from north. CDD Wgs84Angle.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct Wgs84Angle {
        pub value: Wgs84AngleValue,
        pub confidence: Wgs84AngleConfidence,
    }
    impl Wgs84Angle {
        pub fn new(value: Wgs84AngleValue, confidence: Wgs84AngleConfidence) -> Self {
            Self { value, confidence }
        }
    }
    /// 0.1 degree, rounded up, at 95 %. CDD Wgs84AngleConfidence.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("1..=127"))]
    pub struct Wgs84AngleConfidence(pub u8);
    /// 0.1 degree clockwise from WGS84 north. CDD Wgs84AngleValue.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=3601"))]
    pub struct Wgs84AngleValue(pub u16);
    /// Yaw rate. CDD YawRate.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct YawRate {
        #[rasn(identifier = "yawRateValue")]
        #[serde(rename = "yawRateValue")]
        pub yaw_rate_value: YawRateValue,
        #[rasn(identifier = "yawRateConfidence")]
        #[serde(rename = "yawRateConfidence")]
        pub yaw_rate_confidence: YawRateConfidence,
    }
    impl YawRate {
        pub fn new(yaw_rate_value: YawRateValue, yaw_rate_confidence: YawRateConfidence) -> Self {
            Self {
                yaw_rate_value,
                yaw_rate_confidence,
            }
        }
    }
    /// Largest error of the yaw rate at 95 %: degSec-000-05 is 0.05 degree/s. CDD YawRateConfidence.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    pub enum YawRateConfidence {
        #[rasn(identifier = "degSec-000-01")]
        #[serde(rename = "degSec-000-01")]
        degSec_000_01 = 0,
        #[rasn(identifier = "degSec-000-05")]
        #[serde(rename = "degSec-000-05")]
        degSec_000_05 = 1,
        #[rasn(identifier = "degSec-000-10")]
        #[serde(rename = "degSec-000-10")]
        degSec_000_10 = 2,
        #[rasn(identifier = "degSec-001-00")]
        #[serde(rename = "degSec-001-00")]
        degSec_001_00 = 3,
        #[rasn(identifier = "degSec-005-00")]
        #[serde(rename = "degSec-005-00")]
        degSec_005_00 = 4,
        #[rasn(identifier = "degSec-010-00")]
        #[serde(rename = "degSec-010-00")]
        degSec_010_00 = 5,
        #[rasn(identifier = "degSec-100-00")]
        #[serde(rename = "degSec-100-00")]
        degSec_100_00 = 6,
        outOfRange = 7,
        unavailable = 8,
    }
    /// 0.01 degree/s, rounded up, to the left positive. CDD YawRateValue.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("-32766..=32767"))]
    pub struct YawRateValue(pub i16);
}
#[allow(
    non_camel_case_types,
    non_snake_case,
    non_upper_case_globals,
    unused,
    clippy::too_many_arguments
)]
pub mod crossguard_common {
    extern crate alloc;
    use super::crossguard_cdd::StationId;
    use core::borrow::Borrow;
    use rasn::prelude::*;
    use serde::{Deserialize, Serialize};
    use std::sync::LazyLock;
    /// A coordination session: the station that opened it and leads it, and its number for it.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct CoordinationSession {
        #[rasn(identifier = "leaderStationID")]
        #[serde(rename = "leaderStationID")]
        pub leader_station_id: StationId,
        #[rasn(identifier = "sessionNumber")]
        #[serde(rename = "sessionNumber")]
        pub session_number: SessionNumber,
    }
    impl CoordinationSession {
        pub fn new(leader_station_id: StationId, session_number: SessionNumber) -> Self {
            Self {
                leader_station_id,
                session_number,
            }
        }
    }
    /// Number of an offer to help that the helper never uses again, built like a session number.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=4294967295"))]
    pub struct OfferNumber(pub u32);
    /// Number of a command to one follower within a session: a serial number modulo 256.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=255"))]
    pub struct RequestId(pub u8);
    /// Number that its leader never uses again: the boot counter in the upper 16 bits, a count since
    /// that boot in the lower ones.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=4294967295"))]
    pub struct SessionNumber(pub u32);
    /// How far a robot is with its task; safeIdle: it stopped because it lost contact with its leader.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    #[non_exhaustive]
    pub enum TaskProgression {
        idle = 0,
        executing = 1,
        completed = 2,
        failed = 3,
        safeIdle = 4,
    }
    /// Set of task types: bit n stands for task type n.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate)]
    pub struct TaskSet(#[serde(with = "crate::asn1::view::fixed_bits")] pub FixedBitString<16usize>);
    /// Kind of a maneuver: go to the place where it starts, escort a pedestrian, hold back one direction
    /// of traffic. The other values are for the robots' own use.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=15"))]
    pub struct TaskType(pub u8);
    /// Why a robot takes no part in coordination.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    #[non_exhaustive]
    pub enum UnavailabilityReason {
        lowBattery = 0,
        teleoperated = 1,
        emergencyStop = 2,
        localFault = 3,
        notSafe = 4,
    }
}
#[allow(
    non_camel_case_types,
    non_snake_case,
    non_upper_case_globals,
    unused,
    clippy::too_many_arguments
)]
pub mod crossguard_ram {
    extern crate alloc;
    use super::crossguard_cdd::{
        AccelerationComponent, BasicContainer, Curvature, DriveDirection, ExteriorLights,
        GenerationDeltaTime, ItsPduHeader, ObjectDimensionValue, PathPoint, Speed, StationId,
        Wgs84Angle, YawRate,
    };
    use super::crossguard_common::{
        CoordinationSession, OfferNumber, RequestId, SessionNumber, TaskProgression, TaskSet,
        UnavailabilityReason,
    };
    use super::crossguard_vam::{VruClusterInformationContainer, VruMotionPredictionContainer};
    use core::borrow::Borrow;
    use rasn::prelude::*;
    use serde::{Deserialize, Serialize};
    use std::sync::LazyLock;
    /// Battery of the robot.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct BatteryStatus {
        #[rasn(identifier = "stateOfCharge")]
        #[serde(rename = "stateOfCharge")]
        pub state_of_charge: StateOfCharge,
        pub charging: bool,
    }
    impl BatteryStatus {
        pub fn new(state_of_charge: StateOfCharge, charging: bool) -> Self {
            Self {
                state_of_charge,
                charging,
            }
        }
    }
    /// Every progress but executing is final for its command.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(choice, automatic_tags)]
    #[non_exhaustive]
    pub enum CommandProgress {
        executing(()),
        completed(()),
        failed(FailureReason),
        safeIdle(()),
    }
    /// How far a follower is with a command. The status container's taskProgression says the same.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct CommandReport {
        #[rasn(identifier = "requestID")]
        #[serde(rename = "requestID")]
        pub request_id: RequestId,
        pub progress: CommandProgress,
    }
    impl CommandReport {
        pub fn new(request_id: RequestId, progress: CommandProgress) -> Self {
            Self {
                request_id,
                progress,
            }
        }
    }
    /// A follower, and its offer that the leader accepts.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct ConfirmedFollower {
        #[rasn(identifier = "stationID")]
        #[serde(rename = "stationID")]
        pub station_id: StationId,
        #[rasn(identifier = "offerNumber")]
        #[serde(rename = "offerNumber")]
        pub offer_number: OfferNumber,
    }
    impl ConfirmedFollower {
        pub fn new(station_id: StationId, offer_number: OfferNumber) -> Self {
            Self {
                station_id,
                offer_number,
            }
        }
    }
    /// Who or what steers the robot.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    #[non_exhaustive]
    pub enum ControlMode {
        autonomous = 0,
        teleoperated = 1,
        emergencyStop = 2,
        fault = 3,
        unavailable = 4,
    }
    /// Why a maneuver ended without success: it could not be done, or the robot became unavailable.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(choice, automatic_tags)]
    #[non_exhaustive]
    pub enum FailureReason {
        maneuver(()),
        unavailable(UnavailabilityReason),
    }
    /// Follows in a session: the newest heartbeat that it heard, the newest command that it accepted.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct FollowerRole {
        pub session: CoordinationSession,
        #[rasn(identifier = "heartbeatEcho")]
        #[serde(rename = "heartbeatEcho")]
        pub heartbeat_echo: Heartbeat,
        #[rasn(identifier = "lastCommand")]
        #[serde(rename = "lastCommand")]
        pub last_command: Option<CommandReport>,
    }
    impl FollowerRole {
        pub fn new(
            session: CoordinationSession,
            heartbeat_echo: Heartbeat,
            last_command: Option<CommandReport>,
        ) -> Self {
            Self {
                session,
                heartbeat_echo,
                last_command,
            }
        }
    }
    /// Number that grows by one for every RAM period of a session: a serial number modulo 65536.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=65535"))]
    pub struct Heartbeat(pub u16);
    /// Stage of help between robots.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    #[non_exhaustive]
    pub enum HelpStatus {
        none = 0,
        needHelp = 1,
        offerHelp = 2,
        roleConfirmed = 3,
    }
    /// Offers to join the session of a requester, with the tasks that it can do of those asked for.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct HelperRole {
        pub session: CoordinationSession,
        #[rasn(identifier = "offerNumber")]
        #[serde(rename = "offerNumber")]
        pub offer_number: OfferNumber,
        pub capabilities: TaskSet,
    }
    impl HelperRole {
        pub fn new(
            session: CoordinationSession,
            offer_number: OfferNumber,
            capabilities: TaskSet,
        ) -> Self {
            Self {
                session,
                offer_number,
                capabilities,
            }
        }
    }
    /// Leads a session. Whoever is not among the followers has no part in it.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct LeaderRole {
        pub session: CoordinationSession,
        pub heartbeat: Heartbeat,
        #[rasn(size("1..=4"))]
        pub followers: SequenceOf<ConfirmedFollower>,
    }
    impl LeaderRole {
        pub fn new(
            session: CoordinationSession,
            heartbeat: Heartbeat,
            followers: SequenceOf<ConfirmedFollower>,
        ) -> Self {
            Self {
                session,
                heartbeat,
                followers,
            }
        }
    }
    /// Job that the robot is there for.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    #[non_exhaustive]
    pub enum OperationalJobRole {
        none = 0,
        trafficGuard = 1,
        escort = 2,
        patrol = 3,
        delivery = 4,
        maintenance = 5,
        other = 6,
    }
    /// A signal that people understand.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    #[non_exhaustive]
    pub enum PublicSignal {
        none = 0,
        stop = 1,
        go = 2,
        caution = 3,
    }
    /// Robot awareness message.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct RAM {
        pub header: ItsPduHeader,
        pub ram: RobotAwareness,
    }
    impl RAM {
        pub fn new(header: ItsPduHeader, ram: RobotAwareness) -> Self {
            Self { header, ram }
        }
    }
    /// Containers of a RAM. Sizes and values behind an extension marker of the dictionary are not used,
    /// and in the motion prediction path history and path prediction have at most 10 points each. Both
    /// hold for senders and receivers and keep a RAM well below what one packet can carry.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct RamParameters {
        #[rasn(identifier = "basicContainer")]
        #[serde(rename = "basicContainer")]
        pub basic_container: BasicContainer,
        #[rasn(identifier = "robotHighFrequencyContainer")]
        #[serde(rename = "robotHighFrequencyContainer")]
        pub robot_high_frequency_container: RobotHighFrequencyContainer,
        #[rasn(identifier = "robotLowFrequencyContainer")]
        #[serde(rename = "robotLowFrequencyContainer")]
        pub robot_low_frequency_container: Option<RobotLowFrequencyContainer>,
        #[rasn(identifier = "robotStatusContainer")]
        #[serde(rename = "robotStatusContainer")]
        pub robot_status_container: RobotStatusContainer,
        #[rasn(identifier = "robotLeaderFollowerOperationContainer")]
        #[serde(rename = "robotLeaderFollowerOperationContainer")]
        pub robot_leader_follower_operation_container:
            Option<RobotLeaderFollowerOperationContainer>,
        #[rasn(identifier = "vruClusterInformationContainer")]
        #[serde(rename = "vruClusterInformationContainer")]
        pub vru_cluster_information_container: Option<VruClusterInformationContainer>,
        #[rasn(identifier = "vruMotionPredictionContainer")]
        #[serde(rename = "vruMotionPredictionContainer")]
        pub vru_motion_prediction_container: Option<VruMotionPredictionContainer>,
    }
    impl RamParameters {
        pub fn new(
            basic_container: BasicContainer,
            robot_high_frequency_container: RobotHighFrequencyContainer,
            robot_low_frequency_container: Option<RobotLowFrequencyContainer>,
            robot_status_container: RobotStatusContainer,
            robot_leader_follower_operation_container: Option<
                RobotLeaderFollowerOperationContainer,
            >,
            vru_cluster_information_container: Option<VruClusterInformationContainer>,
            vru_motion_prediction_container: Option<VruMotionPredictionContainer>,
        ) -> Self {
            Self {
                basic_container,
                robot_high_frequency_container,
                robot_low_frequency_container,
                robot_status_container,
                robot_leader_follower_operation_container,
                vru_cluster_information_container,
                vru_motion_prediction_container,
            }
        }
    }
    /// How urgent a request is: nobody waits yet, a pedestrian waits, a pedestrian who needs more help
    /// than others waits, a pedestrian is on the road.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    pub enum RequestUrgency {
        low = 0,
        medium = 1,
        high = 2,
        emergency = 3,
    }
    /// Has opened a session and asks for followers who can do these tasks.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct RequesterRole {
        pub session: CoordinationSession,
        pub urgency: RequestUrgency,
        #[rasn(value("1..=4"), identifier = "followerCount")]
        #[serde(rename = "followerCount")]
        pub follower_count: u8,
        #[rasn(identifier = "requestedTasks")]
        #[serde(rename = "requestedTasks")]
        pub requested_tasks: TaskSet,
    }
    impl RequesterRole {
        pub fn new(
            session: CoordinationSession,
            urgency: RequestUrgency,
            follower_count: u8,
            requested_tasks: TaskSet,
        ) -> Self {
            Self {
                session,
                urgency,
                follower_count,
                requested_tasks,
            }
        }
    }
    /// Payload of a RAM.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct RobotAwareness {
        #[rasn(identifier = "generationDeltaTime")]
        #[serde(rename = "generationDeltaTime")]
        pub generation_delta_time: GenerationDeltaTime,
        #[rasn(identifier = "ramParameters")]
        #[serde(rename = "ramParameters")]
        pub ram_parameters: RamParameters,
    }
    impl RobotAwareness {
        pub fn new(
            generation_delta_time: GenerationDeltaTime,
            ram_parameters: RamParameters,
        ) -> Self {
            Self {
                generation_delta_time,
                ram_parameters,
            }
        }
    }
    /// What the robot can do besides maneuvers. Bits without a name are zero and ignored.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate)]
    pub struct RobotCapabilities(#[serde(with = "crate::asn1::view::fixed_bits")] pub FixedBitString<8usize>);
    /// Build of the robot.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    #[non_exhaustive]
    pub enum RobotCategory {
        unknown = 0,
        humanoid = 1,
        quadruped = 2,
        wheeled = 3,
        tracked = 4,
        aerial = 5,
        other = 6,
    }
    /// Box around the robot and what it carries.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct RobotDimensions {
        pub length: ObjectDimensionValue,
        pub width: ObjectDimensionValue,
        pub height: ObjectDimensionValue,
    }
    impl RobotDimensions {
        pub fn new(
            length: ObjectDimensionValue,
            width: ObjectDimensionValue,
            height: ObjectDimensionValue,
        ) -> Self {
            Self {
                length,
                width,
                height,
            }
        }
    }
    /// What changes quickly: the motion, and the size, which changes with the posture. Heading is the
    /// direction of motion, orientation that of the body, where it differs.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct RobotHighFrequencyContainer {
        pub heading: Wgs84Angle,
        pub speed: Speed,
        #[rasn(identifier = "driveDirection")]
        #[serde(rename = "driveDirection")]
        pub drive_direction: DriveDirection,
        #[rasn(identifier = "longitudinalAcceleration")]
        #[serde(rename = "longitudinalAcceleration")]
        pub longitudinal_acceleration: AccelerationComponent,
        #[rasn(identifier = "robotDimensions")]
        #[serde(rename = "robotDimensions")]
        pub robot_dimensions: RobotDimensions,
        pub curvature: Option<Curvature>,
        #[rasn(identifier = "yawRate")]
        #[serde(rename = "yawRate")]
        pub yaw_rate: Option<YawRate>,
        #[rasn(identifier = "lateralAcceleration")]
        #[serde(rename = "lateralAcceleration")]
        pub lateral_acceleration: Option<AccelerationComponent>,
        #[rasn(identifier = "verticalAcceleration")]
        #[serde(rename = "verticalAcceleration")]
        pub vertical_acceleration: Option<AccelerationComponent>,
        pub orientation: Option<Wgs84Angle>,
    }
    impl RobotHighFrequencyContainer {
        pub fn new(
            heading: Wgs84Angle,
            speed: Speed,
            drive_direction: DriveDirection,
            longitudinal_acceleration: AccelerationComponent,
            robot_dimensions: RobotDimensions,
            curvature: Option<Curvature>,
            yaw_rate: Option<YawRate>,
            lateral_acceleration: Option<AccelerationComponent>,
            vertical_acceleration: Option<AccelerationComponent>,
            orientation: Option<Wgs84Angle>,
        ) -> Self {
            Self {
                heading,
                speed,
                drive_direction,
                longitudinal_acceleration,
                robot_dimensions,
                curvature,
                yaw_rate,
                lateral_acceleration,
                vertical_acceleration,
                orientation,
            }
        }
    }
    /// The sender's part in a session, and a session that it names as over.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct RobotLeaderFollowerOperationContainer {
        pub role: Option<SessionRole>,
        pub farewell: Option<SessionFarewell>,
    }
    impl RobotLeaderFollowerOperationContainer {
        pub fn new(role: Option<SessionRole>, farewell: Option<SessionFarewell>) -> Self {
            Self { role, farewell }
        }
    }
    /// What changes slowly.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct RobotLowFrequencyContainer {
        pub capabilities: RobotCapabilities,
        #[rasn(identifier = "supportedTasks")]
        #[serde(rename = "supportedTasks")]
        pub supported_tasks: TaskSet,
        #[rasn(size("0..=23"), identifier = "pathHistory")]
        #[serde(rename = "pathHistory")]
        pub path_history: SequenceOf<PathPoint>,
        #[rasn(identifier = "exteriorLights")]
        #[serde(rename = "exteriorLights")]
        pub exterior_lights: Option<ExteriorLights>,
        #[rasn(identifier = "signalsShown")]
        #[serde(rename = "signalsShown")]
        pub signals_shown: Option<SignalsShown>,
    }
    impl RobotLowFrequencyContainer {
        pub fn new(
            capabilities: RobotCapabilities,
            supported_tasks: TaskSet,
            path_history: SequenceOf<PathPoint>,
            exterior_lights: Option<ExteriorLights>,
            signals_shown: Option<SignalsShown>,
        ) -> Self {
            Self {
                capabilities,
                supported_tasks,
                path_history,
                exterior_lights,
                signals_shown,
            }
        }
    }
    /// What the robot is and how it is. unavailability is present while the robot takes no part in
    /// coordination. helpStatus goes with the operation container: needHelp with a requester, offerHelp
    /// with a helper, roleConfirmed with a leader or a follower, none with none of these.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct RobotStatusContainer {
        #[rasn(identifier = "robotCategory")]
        #[serde(rename = "robotCategory")]
        pub robot_category: RobotCategory,
        #[rasn(identifier = "operationalJobRole")]
        #[serde(rename = "operationalJobRole")]
        pub operational_job_role: OperationalJobRole,
        #[rasn(identifier = "taskProgression")]
        #[serde(rename = "taskProgression")]
        pub task_progression: TaskProgression,
        #[rasn(identifier = "batteryStatus")]
        #[serde(rename = "batteryStatus")]
        pub battery_status: BatteryStatus,
        #[rasn(identifier = "controlMode")]
        #[serde(rename = "controlMode")]
        pub control_mode: ControlMode,
        #[rasn(identifier = "helpStatus")]
        #[serde(rename = "helpStatus")]
        pub help_status: HelpStatus,
        pub unavailability: Option<UnavailabilityReason>,
    }
    impl RobotStatusContainer {
        pub fn new(
            robot_category: RobotCategory,
            operational_job_role: OperationalJobRole,
            task_progression: TaskProgression,
            battery_status: BatteryStatus,
            control_mode: ControlMode,
            help_status: HelpStatus,
            unavailability: Option<UnavailabilityReason>,
        ) -> Self {
            Self {
                robot_category,
                operational_job_role,
                task_progression,
                battery_status,
                control_mode,
                help_status,
                unavailability,
            }
        }
    }
    /// Names a session as over: the sender's own has ended, or it has left that of another station.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(choice, automatic_tags)]
    #[non_exhaustive]
    pub enum SessionFarewell {
        ended(SessionNumber),
        left(CoordinationSession),
    }
    /// Part in a session. The session of a requester and of a leader is the sender's own.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(choice, automatic_tags)]
    #[non_exhaustive]
    pub enum SessionRole {
        requester(RequesterRole),
        helper(HelperRole),
        leader(LeaderRole),
        follower(FollowerRole),
    }
    /// How a signal is shown. Bits without a name are zero and ignored.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate)]
    pub struct SignalMeans(#[serde(with = "crate::asn1::view::fixed_bits")] pub FixedBitString<8usize>);
    /// What the robot shows to the people around it, and by which means.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct SignalsShown {
        #[rasn(identifier = "toVehicles")]
        #[serde(rename = "toVehicles")]
        pub to_vehicles: PublicSignal,
        #[rasn(identifier = "toPedestrians")]
        #[serde(rename = "toPedestrians")]
        pub to_pedestrians: PublicSignal,
        pub means: SignalMeans,
    }
    impl SignalsShown {
        pub fn new(
            to_vehicles: PublicSignal,
            to_pedestrians: PublicSignal,
            means: SignalMeans,
        ) -> Self {
            Self {
                to_vehicles,
                to_pedestrians,
                means,
            }
        }
    }
    /// 1 % of the usable capacity.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=101"))]
    pub struct StateOfCharge(pub u8);
}
#[allow(
    non_camel_case_types,
    non_snake_case,
    non_upper_case_globals,
    unused,
    clippy::too_many_arguments
)]
pub mod crossguard_rmcm {
    extern crate alloc;
    use super::crossguard_cdd::{
        BasicContainer, DeltaReferencePosition, GenerationDeltaTime, GeoPosition, ItsPduHeader,
        LanePosition, MapReference, SpeedValue, StandardLength9b, StationId, Wgs84AngleValue,
    };
    use super::crossguard_common::{
        CoordinationSession, RequestId, TaskProgression, TaskType, UnavailabilityReason,
    };
    use core::borrow::Borrow;
    use rasn::prelude::*;
    use serde::{Deserialize, Serialize};
    use std::sync::LazyLock;
    /// A follower's answer to the command whose requestID equals jobAdviceID.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct FollowerManeuverContainer {
        pub session: CoordinationSession,
        #[rasn(identifier = "jobAdviceID")]
        #[serde(rename = "jobAdviceID")]
        pub job_advice_id: RequestId,
        pub response: ManeuverResponse,
        #[rasn(identifier = "executionStatus")]
        #[serde(rename = "executionStatus")]
        pub execution_status: TaskProgression,
        #[rasn(identifier = "estimatedTimeToCompletion")]
        #[serde(rename = "estimatedTimeToCompletion")]
        pub estimated_time_to_completion: Option<ManeuverDuration>,
    }
    impl FollowerManeuverContainer {
        pub fn new(
            session: CoordinationSession,
            job_advice_id: RequestId,
            response: ManeuverResponse,
            execution_status: TaskProgression,
            estimated_time_to_completion: Option<ManeuverDuration>,
        ) -> Self {
            Self {
                session,
                job_advice_id,
                response,
                execution_status,
                estimated_time_to_completion,
            }
        }
    }
    /// Commands of a leader, each to another follower. mapReference is the road segment or intersection
    /// at which the maneuvers take place. The session is the sender's own.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct LeaderManeuverContainer {
        pub session: CoordinationSession,
        #[rasn(identifier = "mapReference")]
        #[serde(rename = "mapReference")]
        pub map_reference: Option<MapReference>,
        #[rasn(size("1..=4"))]
        pub commands: SequenceOf<ManeuverCommand>,
    }
    impl LeaderManeuverContainer {
        pub fn new(
            session: CoordinationSession,
            map_reference: Option<MapReference>,
            commands: SequenceOf<ManeuverCommand>,
        ) -> Self {
            Self {
                session,
                map_reference,
                commands,
            }
        }
    }
    /// Command to one follower. validityDuration counts from the generation of the message.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct ManeuverCommand {
        #[rasn(identifier = "requestID")]
        #[serde(rename = "requestID")]
        pub request_id: RequestId,
        #[rasn(identifier = "targetFollowerStationID")]
        #[serde(rename = "targetFollowerStationID")]
        pub target_follower_station_id: StationId,
        #[rasn(identifier = "taskType")]
        #[serde(rename = "taskType")]
        pub task_type: TaskType,
        pub target: Option<ManeuverTarget>,
        #[rasn(identifier = "targetHeading")]
        #[serde(rename = "targetHeading")]
        pub target_heading: Option<Wgs84AngleValue>,
        pub constraints: Option<ManeuverConstraints>,
        #[rasn(identifier = "validityDuration")]
        #[serde(rename = "validityDuration")]
        pub validity_duration: Option<ManeuverDuration>,
    }
    impl ManeuverCommand {
        pub fn new(
            request_id: RequestId,
            target_follower_station_id: StationId,
            task_type: TaskType,
            target: Option<ManeuverTarget>,
            target_heading: Option<Wgs84AngleValue>,
            constraints: Option<ManeuverConstraints>,
            validity_duration: Option<ManeuverDuration>,
        ) -> Self {
            Self {
                request_id,
                target_follower_station_id,
                task_type,
                target,
                target_heading,
                constraints,
                validity_duration,
            }
        }
    }
    /// What the follower keeps to while it executes the maneuver.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct ManeuverConstraints {
        #[rasn(identifier = "maximumSpeed")]
        #[serde(rename = "maximumSpeed")]
        pub maximum_speed: Option<SpeedValue>,
        #[rasn(identifier = "minimumPedestrianDistance")]
        #[serde(rename = "minimumPedestrianDistance")]
        pub minimum_pedestrian_distance: Option<StandardLength9b>,
    }
    impl ManeuverConstraints {
        pub fn new(
            maximum_speed: Option<SpeedValue>,
            minimum_pedestrian_distance: Option<StandardLength9b>,
        ) -> Self {
            Self {
                maximum_speed,
                minimum_pedestrian_distance,
            }
        }
    }
    /// What the sender is in the session.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(choice, automatic_tags)]
    #[non_exhaustive]
    pub enum ManeuverContainer {
        leaderManeuverContainer(LeaderManeuverContainer),
        followerManeuverContainer(FollowerManeuverContainer),
    }
    /// 1 ms, up to one day.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=86400000"))]
    pub struct ManeuverDuration(pub u32);
    /// Acknowledgement or rejection of a command.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(choice, automatic_tags)]
    #[non_exhaustive]
    pub enum ManeuverResponse {
        accepted(()),
        rejected(RejectionReason),
    }
    /// Where the maneuver leads: a position, a position relative to the sender's reference position, or
    /// a lane.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(choice, automatic_tags)]
    #[non_exhaustive]
    pub enum ManeuverTarget {
        position(GeoPosition),
        offset(DeltaReferencePosition),
        lanePosition(LanePosition),
    }
    /// Robot maneuver coordination message.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct RMCM {
        pub header: ItsPduHeader,
        pub rmcm: RobotManeuverCoordination,
    }
    impl RMCM {
        pub fn new(header: ItsPduHeader, rmcm: RobotManeuverCoordination) -> Self {
            Self { header, rmcm }
        }
    }
    /// Why a command is rejected: the robot cannot do such a task, or it is unavailable.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(choice, automatic_tags)]
    #[non_exhaustive]
    pub enum RejectionReason {
        unsupportedTask(()),
        unavailable(UnavailabilityReason),
    }
    /// Containers of an RMCM.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct RmcmParameters {
        #[rasn(identifier = "basicContainer")]
        #[serde(rename = "basicContainer")]
        pub basic_container: BasicContainer,
        #[rasn(identifier = "maneuverContainer")]
        #[serde(rename = "maneuverContainer")]
        pub maneuver_container: ManeuverContainer,
    }
    impl RmcmParameters {
        pub fn new(basic_container: BasicContainer, maneuver_container: ManeuverContainer) -> Self {
            Self {
                basic_container,
                maneuver_container,
            }
        }
    }
    /// Payload of an RMCM.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct RobotManeuverCoordination {
        #[rasn(identifier = "generationDeltaTime")]
        #[serde(rename = "generationDeltaTime")]
        pub generation_delta_time: GenerationDeltaTime,
        #[rasn(identifier = "rmcmParameters")]
        #[serde(rename = "rmcmParameters")]
        pub rmcm_parameters: RmcmParameters,
    }
    impl RobotManeuverCoordination {
        pub fn new(
            generation_delta_time: GenerationDeltaTime,
            rmcm_parameters: RmcmParameters,
        ) -> Self {
            Self {
                generation_delta_time,
                rmcm_parameters,
            }
        }
    }
}
#[allow(
    non_camel_case_types,
    non_snake_case,
    non_upper_case_globals,
    unused,
    clippy::too_many_arguments
)]
pub mod crossguard_vam {
    extern crate alloc;
    use super::crossguard_cdd::{
        AccelerationChangeIndication, BasicContainer, CartesianAngle, ClusterBreakupInfo,
        ClusterJoinInfo, ClusterLeaveInfo, Curvature, CurvatureCalculationMode,
        DeltaTimeQuarterSecond, GeneralizedLanePosition, GenerationDeltaTime,
        HeadingChangeIndication, ItsPduHeader, LateralAcceleration, LongitudinalAcceleration,
        PathHistory, PathPredicted, SequenceOfSafeDistanceIndication,
        SequenceOfTrajectoryInterceptionIndication, Speed, StabilityChangeIndication,
        VerticalAcceleration, VruClusterInformation, VruDeviceUsage, VruEnvironment,
        VruExteriorLights, VruMovementControl, VruProfileAndSubprofile, VruSizeClass, Wgs84Angle,
        YawRate,
    };
    use core::borrow::Borrow;
    use rasn::prelude::*;
    use serde::{Deserialize, Serialize};
    use std::sync::LazyLock;
    /// VRU awareness message: header protocolVersion 3, messageId 16. TS 103 300-3 VAM.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct VAM {
        pub header: ItsPduHeader,
        pub vam: VruAwareness,
    }
    impl VAM {
        pub fn new(header: ItsPduHeader, vam: VruAwareness) -> Self {
            Self { header, vam }
        }
    }
    /// TS 103 300-3 VamParameters.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct VamParameters {
        #[rasn(identifier = "basicContainer")]
        #[serde(rename = "basicContainer")]
        pub basic_container: BasicContainer,
        #[rasn(identifier = "vruHighFrequencyContainer")]
        #[serde(rename = "vruHighFrequencyContainer")]
        pub vru_high_frequency_container: VruHighFrequencyContainer,
        #[rasn(identifier = "vruLowFrequencyContainer")]
        #[serde(rename = "vruLowFrequencyContainer")]
        pub vru_low_frequency_container: Option<VruLowFrequencyContainer>,
        #[rasn(identifier = "vruClusterInformationContainer")]
        #[serde(rename = "vruClusterInformationContainer")]
        pub vru_cluster_information_container: Option<VruClusterInformationContainer>,
        #[rasn(identifier = "vruClusterOperationContainer")]
        #[serde(rename = "vruClusterOperationContainer")]
        pub vru_cluster_operation_container: Option<VruClusterOperationContainer>,
        #[rasn(identifier = "vruMotionPredictionContainer")]
        #[serde(rename = "vruMotionPredictionContainer")]
        pub vru_motion_prediction_container: Option<VruMotionPredictionContainer>,
    }
    impl VamParameters {
        pub fn new(
            basic_container: BasicContainer,
            vru_high_frequency_container: VruHighFrequencyContainer,
            vru_low_frequency_container: Option<VruLowFrequencyContainer>,
            vru_cluster_information_container: Option<VruClusterInformationContainer>,
            vru_cluster_operation_container: Option<VruClusterOperationContainer>,
            vru_motion_prediction_container: Option<VruMotionPredictionContainer>,
        ) -> Self {
            Self {
                basic_container,
                vru_high_frequency_container,
                vru_low_frequency_container,
                vru_cluster_information_container,
                vru_cluster_operation_container,
                vru_motion_prediction_container,
            }
        }
    }
    /// TS 103 300-3 VruAwareness.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct VruAwareness {
        #[rasn(identifier = "generationDeltaTime")]
        #[serde(rename = "generationDeltaTime")]
        pub generation_delta_time: GenerationDeltaTime,
        #[rasn(identifier = "vamParameters")]
        #[serde(rename = "vamParameters")]
        pub vam_parameters: VamParameters,
    }
    impl VruAwareness {
        pub fn new(
            generation_delta_time: GenerationDeltaTime,
            vam_parameters: VamParameters,
        ) -> Self {
            Self {
                generation_delta_time,
                vam_parameters,
            }
        }
    }
    /// The group that the sender leads. TS 103 300-3 VruClusterInformationContainer.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct VruClusterInformationContainer {
        #[rasn(identifier = "vruClusterInformation")]
        #[serde(rename = "vruClusterInformation")]
        pub vru_cluster_information: VruClusterInformation,
    }
    impl VruClusterInformationContainer {
        pub fn new(vru_cluster_information: VruClusterInformation) -> Self {
            Self {
                vru_cluster_information,
            }
        }
    }
    /// Joining, leaving and breaking up a group. TS 103 300-3 VruClusterOperationContainer.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct VruClusterOperationContainer {
        #[rasn(identifier = "clusterJoinInfo")]
        #[serde(rename = "clusterJoinInfo")]
        pub cluster_join_info: Option<ClusterJoinInfo>,
        #[rasn(identifier = "clusterLeaveInfo")]
        #[serde(rename = "clusterLeaveInfo")]
        pub cluster_leave_info: Option<ClusterLeaveInfo>,
        #[rasn(identifier = "clusterBreakupInfo")]
        #[serde(rename = "clusterBreakupInfo")]
        pub cluster_breakup_info: Option<ClusterBreakupInfo>,
        #[rasn(identifier = "clusterIdChangeTimeInfo")]
        #[serde(rename = "clusterIdChangeTimeInfo")]
        pub cluster_id_change_time_info: Option<DeltaTimeQuarterSecond>,
    }
    impl VruClusterOperationContainer {
        pub fn new(
            cluster_join_info: Option<ClusterJoinInfo>,
            cluster_leave_info: Option<ClusterLeaveInfo>,
            cluster_breakup_info: Option<ClusterBreakupInfo>,
            cluster_id_change_time_info: Option<DeltaTimeQuarterSecond>,
        ) -> Self {
            Self {
                cluster_join_info,
                cluster_leave_info,
                cluster_breakup_info,
                cluster_id_change_time_info,
            }
        }
    }
    /// What changes quickly. TS 103 300-3 VruHighFrequencyContainer.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct VruHighFrequencyContainer {
        pub heading: Wgs84Angle,
        pub speed: Speed,
        #[rasn(identifier = "longitudinalAcceleration")]
        #[serde(rename = "longitudinalAcceleration")]
        pub longitudinal_acceleration: LongitudinalAcceleration,
        pub curvature: Option<Curvature>,
        #[rasn(identifier = "curvatureCalculationMode")]
        #[serde(rename = "curvatureCalculationMode")]
        pub curvature_calculation_mode: Option<CurvatureCalculationMode>,
        #[rasn(identifier = "yawRate")]
        #[serde(rename = "yawRate")]
        pub yaw_rate: Option<YawRate>,
        #[rasn(identifier = "lateralAcceleration")]
        #[serde(rename = "lateralAcceleration")]
        pub lateral_acceleration: Option<LateralAcceleration>,
        #[rasn(identifier = "verticalAcceleration")]
        #[serde(rename = "verticalAcceleration")]
        pub vertical_acceleration: Option<VerticalAcceleration>,
        #[rasn(identifier = "vruLanePosition")]
        #[serde(rename = "vruLanePosition")]
        pub vru_lane_position: Option<GeneralizedLanePosition>,
        pub environment: Option<VruEnvironment>,
        #[rasn(identifier = "movementControl")]
        #[serde(rename = "movementControl")]
        pub movement_control: Option<VruMovementControl>,
        pub orientation: Option<Wgs84Angle>,
        #[rasn(identifier = "rollAngle")]
        #[serde(rename = "rollAngle")]
        pub roll_angle: Option<CartesianAngle>,
        #[rasn(identifier = "deviceUsage")]
        #[serde(rename = "deviceUsage")]
        pub device_usage: Option<VruDeviceUsage>,
    }
    impl VruHighFrequencyContainer {
        pub fn new(
            heading: Wgs84Angle,
            speed: Speed,
            longitudinal_acceleration: LongitudinalAcceleration,
            curvature: Option<Curvature>,
            curvature_calculation_mode: Option<CurvatureCalculationMode>,
            yaw_rate: Option<YawRate>,
            lateral_acceleration: Option<LateralAcceleration>,
            vertical_acceleration: Option<VerticalAcceleration>,
            vru_lane_position: Option<GeneralizedLanePosition>,
            environment: Option<VruEnvironment>,
            movement_control: Option<VruMovementControl>,
            orientation: Option<Wgs84Angle>,
            roll_angle: Option<CartesianAngle>,
            device_usage: Option<VruDeviceUsage>,
        ) -> Self {
            Self {
                heading,
                speed,
                longitudinal_acceleration,
                curvature,
                curvature_calculation_mode,
                yaw_rate,
                lateral_acceleration,
                vertical_acceleration,
                vru_lane_position,
                environment,
                movement_control,
                orientation,
                roll_angle,
                device_usage,
            }
        }
    }
    /// What changes slowly. TS 103 300-3 VruLowFrequencyContainer.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct VruLowFrequencyContainer {
        #[rasn(identifier = "profileAndSubprofile")]
        #[serde(rename = "profileAndSubprofile")]
        pub profile_and_subprofile: VruProfileAndSubprofile,
        #[rasn(identifier = "sizeClass")]
        #[serde(rename = "sizeClass")]
        pub size_class: Option<VruSizeClass>,
        #[rasn(identifier = "exteriorLights")]
        #[serde(rename = "exteriorLights")]
        pub exterior_lights: Option<VruExteriorLights>,
    }
    impl VruLowFrequencyContainer {
        pub fn new(
            profile_and_subprofile: VruProfileAndSubprofile,
            size_class: Option<VruSizeClass>,
            exterior_lights: Option<VruExteriorLights>,
        ) -> Self {
            Self {
                profile_and_subprofile,
                size_class,
                exterior_lights,
            }
        }
    }
    /// Where the sender comes from and goes to. TS 103 300-3 VruMotionPredictionContainer.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct VruMotionPredictionContainer {
        #[rasn(identifier = "pathHistory")]
        #[serde(rename = "pathHistory")]
        pub path_history: Option<PathHistory>,
        #[rasn(identifier = "pathPrediction")]
        #[serde(rename = "pathPrediction")]
        pub path_prediction: Option<PathPredicted>,
        #[rasn(identifier = "safeDistance")]
        #[serde(rename = "safeDistance")]
        pub safe_distance: Option<SequenceOfSafeDistanceIndication>,
        #[rasn(identifier = "trajectoryInterceptionIndication")]
        #[serde(rename = "trajectoryInterceptionIndication")]
        pub trajectory_interception_indication: Option<SequenceOfTrajectoryInterceptionIndication>,
        #[rasn(identifier = "accelerationChangeIndication")]
        #[serde(rename = "accelerationChangeIndication")]
        pub acceleration_change_indication: Option<AccelerationChangeIndication>,
        #[rasn(identifier = "headingChangeIndication")]
        #[serde(rename = "headingChangeIndication")]
        pub heading_change_indication: Option<HeadingChangeIndication>,
        #[rasn(identifier = "stabilityChangeIndication")]
        #[serde(rename = "stabilityChangeIndication")]
        pub stability_change_indication: Option<StabilityChangeIndication>,
    }
    impl VruMotionPredictionContainer {
        pub fn new(
            path_history: Option<PathHistory>,
            path_prediction: Option<PathPredicted>,
            safe_distance: Option<SequenceOfSafeDistanceIndication>,
            trajectory_interception_indication: Option<SequenceOfTrajectoryInterceptionIndication>,
            acceleration_change_indication: Option<AccelerationChangeIndication>,
            heading_change_indication: Option<HeadingChangeIndication>,
            stability_change_indication: Option<StabilityChangeIndication>,
        ) -> Self {
            Self {
                path_history,
                path_prediction,
                safe_distance,
                trajectory_interception_indication,
                acceleration_change_indication,
                heading_change_indication,
                stability_change_indication,
            }
        }
    }
}
