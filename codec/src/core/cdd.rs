//! Crossguard-CDD: the types of the ETSI common data dictionary (TS 102 894-2 v2.4.1) that VAM,
//! RAM, RMCM, CAM and CPM share. Names, order, ranges and extension markers are those of the
//! dictionary, so the encodings are the same bit for bit, and the dictionary's own module can be
//! used instead. Comments give the unit of one step and the values with a meaning of their own.
//!
//! Generated from `asn1/Crossguard-CDD.asn` by `tests/generated`; do not edit.

use super::notation::prelude::*;

/// How many points the path history in the motion prediction of a RAM has at most.
pub const PATH_HISTORY_MAX: usize = 10;

/// How many points the path prediction of a RAM has at most.
pub const PATH_PREDICTION_MAX: usize = 10;

asn1! {
    /// The six octets that begin every facilities message. CDD `ItsPduHeader`.
    ItsPduHeader ::= SEQUENCE {
        protocol_version OrdinalNumber1B,
        message_id       MessageId,
        station_id       StationId
    }
}

asn1! {
    /// Kind of message. CDD `MessageId`; values without a name are not assigned.
    MessageId ::= INTEGER (0..255) is u8
}

asn1! {
    /// Identifier of an ITS station, its current pseudonym. CDD `StationId`.
    StationId ::= INTEGER (0..4_294_967_295) is u32
}

asn1! {
    /// Kind of road user. CDD `TrafficParticipantType`.
    TrafficParticipantType ::= INTEGER (0..255) is u8
}

asn1! {
    /// `TimestampIts` modulo 65536: 1 ms, the time to which the reference position belongs. CDD
    /// `GenerationDeltaTime`.
    GenerationDeltaTime ::= INTEGER (0..65_535) is u16
}

asn1! {
    /// 0.1 s. CDD `DeltaTimeTenthOfSecond`.
    DeltaTimeTenthOfSecond ::= INTEGER (0..127) as u8
}

asn1! {
    /// 1 s. CDD `DeltaTimeSecond`.
    DeltaTimeSecond ::= INTEGER (0..86_400) as u32
}

asn1! {
    /// 10 s. CDD `DeltaTimeTenSeconds`.
    DeltaTimeTenSeconds ::= INTEGER (0..127) as u8
}

asn1! {
    /// Ordinal number of one octet. CDD `OrdinalNumber1B`.
    OrdinalNumber1B ::= INTEGER (0..255) is u8
}

asn1! {
    /// Cardinal number of one octet. CDD `CardinalNumber1B`.
    CardinalNumber1B ::= INTEGER (0..255) is u8
}

asn1! {
    /// Identifier of one octet. CDD `Identifier1B`.
    Identifier1B ::= INTEGER (0..255) is u8
}

asn1! {
    /// Identifier of two octets. CDD `Identifier2B`.
    Identifier2B ::= INTEGER (0..65_535) is u16
}

asn1! {
    /// Length of nine bits: 0.1 m. CDD `StandardLength9b`.
    StandardLength9b ::= INTEGER (0..511) as u16
}

asn1! {
    /// Length of twelve bits: 0.1 m. CDD `StandardLength12b`.
    StandardLength12b ::= INTEGER (0..4095) as u16
}

asn1! {
    /// Sender of a message of a moving station. CDD `BasicContainer`.
    BasicContainer ::= SEQUENCE {
        station_type       TrafficParticipantType,
        reference_position ReferencePositionWithConfidence,
        ...
    }
}

asn1! {
    /// Position with its 95 % confidence ellipse. CDD `ReferencePositionWithConfidence`.
    ReferencePositionWithConfidence ::= SEQUENCE {
        latitude                    Latitude,
        longitude                   Longitude,
        position_confidence_ellipse PositionConfidenceEllipse,
        altitude                    Altitude
    }
}

asn1! {
    /// Position without confidence. CDD `GeoPosition`.
    GeoPosition ::= SEQUENCE {
        latitude  Latitude,
        longitude Longitude,
        altitude  AltitudeValue DEFAULT UNAVAILABLE
    }
}

asn1! {
    /// 10^-7 degree, north positive. CDD `Latitude`.
    Latitude ::= INTEGER (-900_000_000..900_000_001) as i32
}

asn1! {
    /// 10^-7 degree, east positive. CDD `Longitude`.
    Longitude ::= INTEGER (-1_800_000_000..1_800_000_001) as i32
}

asn1! {
    /// Ellipse that holds the true position with a confidence of 95 %. CDD
    /// `PositionConfidenceEllipse`.
    PositionConfidenceEllipse ::= SEQUENCE {
        semi_major_axis_length      SemiAxisLength,
        semi_minor_axis_length      SemiAxisLength,
        semi_major_axis_orientation Wgs84AngleValue
    }
}

asn1! {
    /// The same ellipse under its older field names. CDD `PosConfidenceEllipse`.
    PosConfidenceEllipse ::= SEQUENCE {
        semi_major_confidence  SemiAxisLength,
        semi_minor_confidence  SemiAxisLength,
        semi_major_orientation HeadingValue
    }
}

asn1! {
    /// 0.01 m, rounded up; 4094 stands for more than 40.93 m. CDD `SemiAxisLength`.
    SemiAxisLength ::= INTEGER (0..4095) as u16
}

asn1! {
    /// Altitude with its confidence. CDD `Altitude`.
    Altitude ::= SEQUENCE {
        altitude_value      AltitudeValue,
        altitude_confidence AltitudeConfidence
    }
}

asn1! {
    /// 0.01 m above the WGS84 ellipsoid, rounded up. CDD `AltitudeValue`, with its spelling of one
    /// name.
    AltitudeValue ::= INTEGER { UNAVAILABLE(800_001) } (-100_000..800_001) as i32
}

asn1! {
    /// Largest error of the altitude at 95 %: `alt-000-05` is 0.05 m. CDD `AltitudeConfidence`.
    AltitudeConfidence ::= ENUMERATED {
        Alt000_01 "alt-000-01", Alt000_02 "alt-000-02", Alt000_05 "alt-000-05",
        Alt000_10 "alt-000-10", Alt000_20 "alt-000-20", Alt000_50 "alt-000-50",
        Alt001_00 "alt-001-00", Alt002_00 "alt-002-00", Alt005_00 "alt-005-00",
        Alt010_00 "alt-010-00", Alt020_00 "alt-020-00", Alt050_00 "alt-050-00",
        Alt100_00 "alt-100-00", Alt200_00 "alt-200-00", OutOfRange, Unavailable
    }
}

asn1! {
    /// Position relative to another one. CDD `DeltaReferencePosition`.
    DeltaReferencePosition ::= SEQUENCE {
        delta_latitude  DeltaLatitude,
        delta_longitude DeltaLongitude,
        delta_altitude  DeltaAltitude
    }
}

asn1! {
    /// 10^-7 degree, to the north positive. CDD `DeltaLatitude`.
    DeltaLatitude ::= INTEGER (-131_071..131_072) as i32
}

asn1! {
    /// 10^-7 degree, to the east positive. CDD `DeltaLongitude`.
    DeltaLongitude ::= INTEGER (-131_071..131_072) as i32
}

asn1! {
    /// 0.01 m, upwards positive. CDD `DeltaAltitude`.
    DeltaAltitude ::= INTEGER { UNAVAILABLE(12_800) } (-12_700..12_800) as i16
}

asn1! {
    /// Position in a local frame: x to the east, y to the north, z up. CDD `CartesianPosition3d`.
    CartesianPosition3d ::= SEQUENCE {
        x_coordinate CartesianCoordinate,
        y_coordinate CartesianCoordinate,
        z_coordinate CartesianCoordinate OPTIONAL
    }
}

asn1! {
    /// 0.01 m. CDD `CartesianCoordinate`.
    CartesianCoordinate ::= INTEGER (-32_768..32_767) is i16
}

asn1! {
    /// Angle clockwise from north. CDD `Wgs84Angle`.
    Wgs84Angle ::= SEQUENCE {
        value      Wgs84AngleValue,
        confidence Wgs84AngleConfidence
    }
}

asn1! {
    /// 0.1 degree clockwise from WGS84 north. CDD `Wgs84AngleValue`.
    Wgs84AngleValue ::= INTEGER (0..3601) as u16
}

asn1! {
    /// 0.1 degree, rounded up, at 95 %. CDD `Wgs84AngleConfidence`.
    Wgs84AngleConfidence ::= INTEGER (1..127) as u8
}

asn1! {
    /// 0.1 degree clockwise from WGS84 north. CDD `HeadingValue`.
    HeadingValue ::= INTEGER (0..3601) as u16
}

asn1! {
    /// 0.1 degree counter-clockwise from the x axis. CDD `CartesianAngleValue`.
    CartesianAngleValue ::= INTEGER (0..3601) as u16
}

asn1! {
    /// Speed over ground. CDD `Speed`.
    Speed ::= SEQUENCE {
        speed_value      SpeedValue,
        speed_confidence SpeedConfidence
    }
}

asn1! {
    /// 0.01 m/s, rounded up; 16382 stands for more than 163.81 m/s. CDD `SpeedValue`.
    SpeedValue ::= INTEGER (0..16_383) as u16
}

asn1! {
    /// 0.01 m/s, rounded up, at 95 %. CDD `SpeedConfidence`.
    SpeedConfidence ::= INTEGER (1..127) as u8
}

asn1! {
    /// Forward or backward. CDD `DriveDirection`.
    DriveDirection ::= ENUMERATED { Forward, Backward, Unavailable }
}

asn1! {
    /// Acceleration along one axis. CDD `AccelerationComponent`.
    AccelerationComponent ::= SEQUENCE {
        value      AccelerationValue,
        confidence AccelerationConfidence
    }
}

asn1! {
    /// 0.1 m/s^2, rounded up. CDD `AccelerationValue`.
    AccelerationValue ::= INTEGER (-160..161) as i16
}

asn1! {
    /// 0.1 m/s^2, rounded up, at 95 %; 0 is not used. CDD `AccelerationConfidence`.
    AccelerationConfidence ::= INTEGER (0..102) as u8
}

asn1! {
    /// Curvature of the path. CDD `Curvature`.
    Curvature ::= SEQUENCE {
        curvature_value      CurvatureValue,
        curvature_confidence CurvatureConfidence
    }
}

asn1! {
    /// 10^-4 1/m, rounded up, to the left positive. CDD `CurvatureValue`.
    CurvatureValue ::= INTEGER (-1023..1023) as i16
}

asn1! {
    /// Largest error of the curvature at 95 %, in 1/m. CDD `CurvatureConfidence`.
    CurvatureConfidence ::= ENUMERATED {
        OnePerMeter0_00002 "onePerMeter-0-00002", OnePerMeter0_0001 "onePerMeter-0-0001",
        OnePerMeter0_0005 "onePerMeter-0-0005", OnePerMeter0_002 "onePerMeter-0-002",
        OnePerMeter0_01 "onePerMeter-0-01", OnePerMeter0_1 "onePerMeter-0-1", OutOfRange,
        Unavailable
    }
}

asn1! {
    /// Yaw rate. CDD `YawRate`.
    YawRate ::= SEQUENCE {
        yaw_rate_value      YawRateValue,
        yaw_rate_confidence YawRateConfidence
    }
}

asn1! {
    /// 0.01 degree/s, rounded up, to the left positive. CDD `YawRateValue`.
    YawRateValue ::= INTEGER (-32_766..32_767) as i16
}

asn1! {
    /// Largest error of the yaw rate at 95 %: `degSec-000-05` is 0.05 degree/s. CDD
    /// `YawRateConfidence`.
    YawRateConfidence ::= ENUMERATED {
        DegSec000_01 "degSec-000-01", DegSec000_05 "degSec-000-05", DegSec000_10 "degSec-000-10",
        DegSec001_00 "degSec-001-00", DegSec005_00 "degSec-005-00", DegSec010_00 "degSec-010-00",
        DegSec100_00 "degSec-100-00", OutOfRange, Unavailable
    }
}

asn1! {
    /// 0.1 m, rounded up; 255 stands for more than 25.4 m. CDD `ObjectDimensionValue`.
    ObjectDimensionValue ::= INTEGER (1..256) as u16
}

asn1! {
    /// Lights of a vehicle that are on. CDD `ExteriorLights`.
    ExteriorLights ::= BIT STRING (SIZE(8)) as u8
}

asn1! {
    /// Lane counted from the inside of the road to its outside. CDD `LanePosition`.
    LanePosition ::= INTEGER (-1..14) as i8
}

asn1! {
    /// Road segment or intersection of a MAPEM. CDD `MapReference`.
    MapReference ::= CHOICE {
        Roadsegment  RoadSegmentReferenceId,
        Intersection IntersectionReferenceId
    }
}

asn1! {
    /// Road segment, unique within its region. CDD `RoadSegmentReferenceId`.
    RoadSegmentReferenceId ::= SEQUENCE {
        region Identifier2B OPTIONAL,
        id     Identifier2B
    }
}

asn1! {
    /// Intersection, unique within its region. CDD `IntersectionReferenceId`.
    IntersectionReferenceId ::= SEQUENCE {
        region Identifier2B OPTIONAL,
        id     Identifier2B
    }
}

asn1! {
    /// Area or volume. CDD `Shape`.
    Shape ::= CHOICE {
        Rectangular RectangularShape,
        Circular    CircularShape,
        Polygonal   PolygonalShape,
        3 ABSENT,
        ...
    }
}

asn1! {
    /// Rectangle by its half sides. CDD `RectangularShape`.
    RectangularShape ::= SEQUENCE {
        shape_reference_point CartesianPosition3d OPTIONAL,
        semi_length           StandardLength12b,
        semi_breadth          StandardLength12b,
        orientation           CartesianAngleValue OPTIONAL,
        height                StandardLength12b OPTIONAL
    }
}

asn1! {
    /// Circle. CDD `CircularShape`.
    CircularShape ::= SEQUENCE {
        shape_reference_point CartesianPosition3d OPTIONAL,
        radius                StandardLength12b,
        height                StandardLength12b OPTIONAL
    }
}

asn1! {
    /// Corners of a polygon.
    PolygonCorners ::= SEQUENCE (SIZE(3..16, ...)) OF CartesianPosition3d
}

asn1! {
    /// Polygon of three corners or more. CDD `PolygonalShape`.
    PolygonalShape ::= SEQUENCE {
        shape_reference_point CartesianPosition3d OPTIONAL,
        polygon               PolygonCorners,
        height                StandardLength12b OPTIONAL
    }
}

asn1! {
    /// Group of road users that move together. Only a rectangle, a circle or a polygon bounds it.
    /// CDD `VruClusterInformation`.
    VruClusterInformation ::= SEQUENCE {
        cluster_id                 Identifier1B OPTIONAL,
        cluster_bounding_box_shape Shape OPTIONAL,
        cluster_cardinality_size   CardinalNumber1B,
        cluster_profiles           VruClusterProfiles OPTIONAL,
        ...
    }
}

asn1! {
    /// Kinds of road users in a group. CDD `VruClusterProfiles`.
    VruClusterProfiles ::= BIT STRING (SIZE(4)) as u8
}

asn1! {
    /// Positions that the sender came from, newest first, each relative to the one before it. CDD
    /// `PathHistory`. In a RAM it has at most 10 items.
    PathHistory ::= SEQUENCE (SIZE(0..40)) OF PathPoint AT MOST PATH_HISTORY_MAX
}

asn1! {
    /// One position of a path, and the time from there to the one before it. CDD `PathPoint`.
    PathPoint ::= SEQUENCE {
        path_position   DeltaReferencePosition,
        path_delta_time PathDeltaTime OPTIONAL
    }
}

asn1! {
    /// 10 ms. CDD `PathDeltaTime`.
    PathDeltaTime ::= INTEGER (1..65_535, ...) as u16
}

asn1! {
    /// Positions that the sender expects to take, nearest first. CDD `PathPredicted`, which also
    /// names the sizes 17..40 behind the marker; that changes no bit, and asn1c 0.9.28 does not
    /// understand it. In a RAM it has at most 10 items.
    PathPredicted ::= SEQUENCE (SIZE(1..16, ...)) OF PathPointPredicted AT MOST PATH_PREDICTION_MAX
}

asn1! {
    /// One predicted position, relative to the reference position. CDD `PathPointPredicted`.
    PathPointPredicted ::= SEQUENCE {
        delta_latitude                 DeltaLatitude,
        delta_longitude                DeltaLongitude,
        horizontal_position_confidence PosConfidenceEllipse OPTIONAL,
        delta_altitude                 DeltaAltitude DEFAULT UNAVAILABLE,
        altitude_confidence            AltitudeConfidence DEFAULT Unavailable,
        path_delta_time                PathDeltaTimeChoice OPTIONAL,
        symmetric_area_offset          StandardLength9b OPTIONAL,
        asymmetric_area_offset         StandardLength9b OPTIONAL,
        ...
    }
}

asn1! {
    /// Time until a predicted position is reached. CDD `PathDeltaTimeChoice`.
    PathDeltaTimeChoice ::= CHOICE {
        DeltaTimeHighPrecision DeltaTimeTenthOfSecond,
        DeltaTimeBigRange      DeltaTimeTenSeconds,
        ...,
        DeltaTimeMidRange      DeltaTimeSecond
    }
}

asn1! {
    /// Safe distances to several stations. CDD `SequenceOfSafeDistanceIndication`.
    SequenceOfSafeDistanceIndication ::= SEQUENCE (SIZE(1..8, ...)) OF SafeDistanceIndication
}

asn1! {
    /// Indication that a safe distance to another station is kept, or not. CDD
    /// `SafeDistanceIndication`.
    SafeDistanceIndication ::= SEQUENCE {
        subject_station         StationId OPTIONAL,
        safe_distance_indicator SafeDistanceIndicator,
        time_to_collision       DeltaTimeTenthOfSecond OPTIONAL,
        ...
    }
}

/// TRUE when the distance is safe. CDD `SafeDistanceIndicator`.
pub type SafeDistanceIndicator = bool;

asn1! {
    /// Crossing trajectories with several stations. CDD
    /// `SequenceOfTrajectoryInterceptionIndication`.
    SequenceOfTrajectoryInterceptionIndication ::= SEQUENCE (SIZE(1..8, ...)) OF TrajectoryInterceptionIndication
}

asn1! {
    /// How probable it is that the trajectories cross. CDD `TrajectoryInterceptionIndication`.
    TrajectoryInterceptionIndication ::= SEQUENCE {
        subject_station                     StationId OPTIONAL,
        trajectory_interception_probability TrajectoryInterceptionProbability,
        trajectory_interception_confidence  TrajectoryInterceptionConfidence OPTIONAL,
        ...
    }
}

asn1! {
    /// 2 %. CDD `TrajectoryInterceptionProbability`.
    TrajectoryInterceptionProbability ::= INTEGER (0..63) as u8
}

asn1! {
    /// Confidence of that probability. CDD `TrajectoryInterceptionConfidence`.
    TrajectoryInterceptionConfidence ::= INTEGER (0..3) as u8
}

asn1! {
    /// Acceleration that is about to change. CDD `AccelerationChangeIndication`.
    AccelerationChangeIndication ::= SEQUENCE {
        accel_or_decel    AccelerationChange,
        action_delta_time DeltaTimeTenthOfSecond,
        ...
    }
}

asn1! {
    /// Speeding up or slowing down. CDD `AccelerationChange`.
    AccelerationChange ::= ENUMERATED { Accelerate, Decelerate }
}

asn1! {
    /// Heading that is about to change. CDD `HeadingChangeIndication`.
    HeadingChangeIndication ::= SEQUENCE {
        direction         TurningDirection,
        action_delta_time DeltaTimeTenthOfSecond,
        ...
    }
}

asn1! {
    /// Left or right. CDD `TurningDirection`.
    TurningDirection ::= ENUMERATED { Left, Right }
}

asn1! {
    /// Stability that is about to be lost. CDD `StabilityChangeIndication`.
    StabilityChangeIndication ::= SEQUENCE {
        loss_probability  StabilityLossProbability,
        action_delta_time DeltaTimeTenthOfSecond,
        ...
    }
}

asn1! {
    /// 2 %. CDD `StabilityLossProbability`.
    StabilityLossProbability ::= INTEGER (0..63) as u8
}
