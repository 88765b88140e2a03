//! Generated from `asn1/*.asn` by `tests/generated`; do not edit.
#[allow(
    non_camel_case_types,
    non_snake_case,
    non_upper_case_globals,
    unused,
    clippy::too_many_arguments
)]
pub mod crossguard_cam {
    extern crate alloc;
    use super::crossguard_cdd::{
        AccelerationComponent, BasicContainer, Curvature, CurvatureCalculationMode, DriveDirection,
        ExteriorLights, GenerationDeltaTime, HeadingValue, ItsPduHeader, LanePosition, Latitude,
        Longitude, PathHistory, Speed, TimestampIts, VehicleWidth, YawRate,
    };
    use core::borrow::Borrow;
    use rasn::prelude::*;
    use serde::{Deserialize, Serialize};
    use std::sync::LazyLock;
    /// Controls of the longitudinal motion. CDD AccelerationControl.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate)]
    pub struct AccelerationControl(#[serde(with = "crate::asn1::view::fixed_bits")] pub FixedBitString<7usize>);
    /// TS 103 900 BasicVehicleContainerHighFrequency.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct BasicVehicleContainerHighFrequency {
        pub heading: Heading,
        pub speed: Speed,
        #[rasn(identifier = "driveDirection")]
        #[serde(rename = "driveDirection")]
        pub drive_direction: DriveDirection,
        #[rasn(identifier = "vehicleLength")]
        #[serde(rename = "vehicleLength")]
        pub vehicle_length: VehicleLength,
        #[rasn(identifier = "vehicleWidth")]
        #[serde(rename = "vehicleWidth")]
        pub vehicle_width: VehicleWidth,
        #[rasn(identifier = "longitudinalAcceleration")]
        #[serde(rename = "longitudinalAcceleration")]
        pub longitudinal_acceleration: AccelerationComponent,
        pub curvature: Curvature,
        #[rasn(identifier = "curvatureCalculationMode")]
        #[serde(rename = "curvatureCalculationMode")]
        pub curvature_calculation_mode: CurvatureCalculationMode,
        #[rasn(identifier = "yawRate")]
        #[serde(rename = "yawRate")]
        pub yaw_rate: YawRate,
        #[rasn(identifier = "accelerationControl")]
        #[serde(rename = "accelerationControl")]
        pub acceleration_control: Option<AccelerationControl>,
        #[rasn(identifier = "lanePosition")]
        #[serde(rename = "lanePosition")]
        pub lane_position: Option<LanePosition>,
        #[rasn(identifier = "steeringWheelAngle")]
        #[serde(rename = "steeringWheelAngle")]
        pub steering_wheel_angle: Option<SteeringWheelAngle>,
        #[rasn(identifier = "lateralAcceleration")]
        #[serde(rename = "lateralAcceleration")]
        pub lateral_acceleration: Option<AccelerationComponent>,
        #[rasn(identifier = "verticalAcceleration")]
        #[serde(rename = "verticalAcceleration")]
        pub vertical_acceleration: Option<AccelerationComponent>,
        #[rasn(identifier = "performanceClass")]
        #[serde(rename = "performanceClass")]
        pub performance_class: Option<PerformanceClass>,
        #[rasn(identifier = "cenDsrcTollingZone")]
        #[serde(rename = "cenDsrcTollingZone")]
        pub cen_dsrc_tolling_zone: Option<CenDsrcTollingZone>,
    }
    impl BasicVehicleContainerHighFrequency {
        pub fn new(
            heading: Heading,
            speed: Speed,
            drive_direction: DriveDirection,
            vehicle_length: VehicleLength,
            vehicle_width: VehicleWidth,
            longitudinal_acceleration: AccelerationComponent,
            curvature: Curvature,
            curvature_calculation_mode: CurvatureCalculationMode,
            yaw_rate: YawRate,
            acceleration_control: Option<AccelerationControl>,
            lane_position: Option<LanePosition>,
            steering_wheel_angle: Option<SteeringWheelAngle>,
            lateral_acceleration: Option<AccelerationComponent>,
            vertical_acceleration: Option<AccelerationComponent>,
            performance_class: Option<PerformanceClass>,
            cen_dsrc_tolling_zone: Option<CenDsrcTollingZone>,
        ) -> Self {
            Self {
                heading,
                speed,
                drive_direction,
                vehicle_length,
                vehicle_width,
                longitudinal_acceleration,
                curvature,
                curvature_calculation_mode,
                yaw_rate,
                acceleration_control,
                lane_position,
                steering_wheel_angle,
                lateral_acceleration,
                vertical_acceleration,
                performance_class,
                cen_dsrc_tolling_zone,
            }
        }
    }
    /// TS 103 900 BasicVehicleContainerLowFrequency; of the path 23 points are meant to be used.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct BasicVehicleContainerLowFrequency {
        #[rasn(identifier = "vehicleRole")]
        #[serde(rename = "vehicleRole")]
        pub vehicle_role: VehicleRole,
        #[rasn(identifier = "exteriorLights")]
        #[serde(rename = "exteriorLights")]
        pub exterior_lights: ExteriorLights,
        #[rasn(identifier = "pathHistory")]
        #[serde(rename = "pathHistory")]
        pub path_history: PathHistory,
    }
    impl BasicVehicleContainerLowFrequency {
        pub fn new(
            vehicle_role: VehicleRole,
            exterior_lights: ExteriorLights,
            path_history: PathHistory,
        ) -> Self {
            Self {
                vehicle_role,
                exterior_lights,
                path_history,
            }
        }
    }
    /// Cooperative awareness message: header protocolVersion 2, messageId 2. TS 103 900 CAM.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct CAM {
        pub header: ItsPduHeader,
        pub cam: CamPayload,
    }
    impl CAM {
        pub fn new(header: ItsPduHeader, cam: CamPayload) -> Self {
            Self { header, cam }
        }
    }
    /// The octets of a container's own encoding.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate)]
    pub struct CamContainerData(#[serde(with = "crate::asn1::view::octets")] pub OctetString);
    /// TS 103 900 CamParameters.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct CamParameters {
        #[rasn(identifier = "basicContainer")]
        #[serde(rename = "basicContainer")]
        pub basic_container: BasicContainer,
        #[rasn(identifier = "highFrequencyContainer")]
        #[serde(rename = "highFrequencyContainer")]
        pub high_frequency_container: HighFrequencyContainer,
        #[rasn(identifier = "lowFrequencyContainer")]
        #[serde(rename = "lowFrequencyContainer")]
        pub low_frequency_container: Option<LowFrequencyContainer>,
        #[rasn(identifier = "specialVehicleContainer")]
        #[serde(rename = "specialVehicleContainer")]
        pub special_vehicle_container: Option<SpecialVehicleContainer>,
        #[rasn(extension_addition, size("1..=8", extensible), identifier = "extensionContainers")]
        #[serde(rename = "extensionContainers")]
        pub extension_containers: Option<WrappedExtensionContainers>,
    }
    impl CamParameters {
        pub fn new(
            basic_container: BasicContainer,
            high_frequency_container: HighFrequencyContainer,
            low_frequency_container: Option<LowFrequencyContainer>,
            special_vehicle_container: Option<SpecialVehicleContainer>,
            extension_containers: Option<WrappedExtensionContainers>,
        ) -> Self {
            Self {
                basic_container,
                high_frequency_container,
                low_frequency_container,
                special_vehicle_container,
                extension_containers,
            }
        }
    }
    /// TS 103 900 CamPayload.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct CamPayload {
        #[rasn(identifier = "generationDeltaTime")]
        #[serde(rename = "generationDeltaTime")]
        pub generation_delta_time: GenerationDeltaTime,
        #[rasn(identifier = "camParameters")]
        #[serde(rename = "camParameters")]
        pub cam_parameters: CamParameters,
    }
    impl CamPayload {
        pub fn new(
            generation_delta_time: GenerationDeltaTime,
            cam_parameters: CamParameters,
        ) -> Self {
            Self {
                generation_delta_time,
                cam_parameters,
            }
        }
    }
    /// Event: cause and sub cause. CDD CauseCodeV2, which has the bits of release 1 but for the
    /// causes from 129 on: nothing has assigned them, and only release 1 can tell them. No header says of which
    /// release a message is, so they are read.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct CauseCodeV2 {
        #[rasn(value("0..=255"), identifier = "causeCode")]
        #[serde(rename = "causeCode")]
        pub cause_code: u8,
        #[rasn(value("0..=255"), identifier = "subCauseCode")]
        #[serde(rename = "subCauseCode")]
        pub sub_cause_code: u8,
    }
    impl CauseCodeV2 {
        pub fn new(cause_code: u8, sub_cause_code: u8) -> Self {
            Self {
                cause_code,
                sub_cause_code,
            }
        }
    }
    /// Where not to disturb a tolling station. CDD CenDsrcTollingZone.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct CenDsrcTollingZone {
        #[rasn(identifier = "protectedZoneLatitude")]
        #[serde(rename = "protectedZoneLatitude")]
        pub protected_zone_latitude: Latitude,
        #[rasn(identifier = "protectedZoneLongitude")]
        #[serde(rename = "protectedZoneLongitude")]
        pub protected_zone_longitude: Longitude,
        #[rasn(identifier = "cenDsrcTollingZoneId")]
        #[serde(rename = "cenDsrcTollingZoneId")]
        pub cen_dsrc_tolling_zone_id: Option<ProtectedZoneId>,
    }
    impl CenDsrcTollingZone {
        pub fn new(
            protected_zone_latitude: Latitude,
            protected_zone_longitude: Longitude,
            cen_dsrc_tolling_zone_id: Option<ProtectedZoneId>,
        ) -> Self {
            Self {
                protected_zone_latitude,
                protected_zone_longitude,
                cen_dsrc_tolling_zone_id,
            }
        }
    }
    /// Lanes that are closed. CDD ClosedLanes.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct ClosedLanes {
        #[rasn(identifier = "innerhardShoulderStatus")]
        #[serde(rename = "innerhardShoulderStatus")]
        pub innerhard_shoulder_status: Option<HardShoulderStatus>,
        #[rasn(identifier = "outerhardShoulderStatus")]
        #[serde(rename = "outerhardShoulderStatus")]
        pub outerhard_shoulder_status: Option<HardShoulderStatus>,
        #[rasn(identifier = "drivingLaneStatus")]
        #[serde(rename = "drivingLaneStatus")]
        pub driving_lane_status: Option<DrivingLaneStatus>,
    }
    impl ClosedLanes {
        pub fn new(
            innerhard_shoulder_status: Option<HardShoulderStatus>,
            outerhard_shoulder_status: Option<HardShoulderStatus>,
            driving_lane_status: Option<DrivingLaneStatus>,
        ) -> Self {
            Self {
                innerhard_shoulder_status,
                outerhard_shoulder_status,
                driving_lane_status,
            }
        }
    }
    /// CDD DangerousGoodsBasic.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    pub enum DangerousGoodsBasic {
        explosives1 = 0,
        explosives2 = 1,
        explosives3 = 2,
        explosives4 = 3,
        explosives5 = 4,
        explosives6 = 5,
        flammableGases = 6,
        nonFlammableGases = 7,
        toxicGases = 8,
        flammableLiquids = 9,
        flammableSolids = 10,
        substancesLiableToSpontaneousCombustion = 11,
        substancesEmittingFlammableGasesUponContactWithWater = 12,
        oxidizingSubstances = 13,
        organicPeroxides = 14,
        toxicSubstances = 15,
        infectiousSubstances = 16,
        radioactiveMaterial = 17,
        corrosiveSubstances = 18,
        miscellaneousDangerousSubstances = 19,
    }
    /// TS 103 900 DangerousGoodsContainer.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct DangerousGoodsContainer {
        #[rasn(identifier = "dangerousGoodsBasic")]
        #[serde(rename = "dangerousGoodsBasic")]
        pub dangerous_goods_basic: DangerousGoodsBasic,
    }
    impl DangerousGoodsContainer {
        pub fn new(dangerous_goods_basic: DangerousGoodsBasic) -> Self {
            Self {
                dangerous_goods_basic,
            }
        }
    }
    /// A bit for each lane, 1 when it is closed. CDD DrivingLaneStatus.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, size("1..=13"))]
    pub struct DrivingLaneStatus(#[serde(with = "crate::asn1::view::bits")] pub BitString);
    /// TRUE while passengers get in and out. CDD EmbarkationStatus.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(delegate)]
    pub struct EmbarkationStatus(pub bool);
    /// TS 103 900 EmergencyContainer.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct EmergencyContainer {
        #[rasn(identifier = "lightBarSirenInUse")]
        #[serde(rename = "lightBarSirenInUse")]
        pub light_bar_siren_in_use: LightBarSirenInUse,
        #[rasn(identifier = "incidentIndication")]
        #[serde(rename = "incidentIndication")]
        pub incident_indication: Option<CauseCodeV2>,
        #[rasn(identifier = "emergencyPriority")]
        #[serde(rename = "emergencyPriority")]
        pub emergency_priority: Option<EmergencyPriority>,
    }
    impl EmergencyContainer {
        pub fn new(
            light_bar_siren_in_use: LightBarSirenInUse,
            incident_indication: Option<CauseCodeV2>,
            emergency_priority: Option<EmergencyPriority>,
        ) -> Self {
            Self {
                light_bar_siren_in_use,
                incident_indication,
                emergency_priority,
            }
        }
    }
    /// CDD EmergencyPriority.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate)]
    pub struct EmergencyPriority(#[serde(with = "crate::asn1::view::fixed_bits")] pub FixedBitString<2usize>);
    /// 1 two-wheeler, 2 horizon, 3 very low frequency, 4 path prediction, 5 lane positions, 6 movement
    /// control. TS 103 900 ExtensionContainerId.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("1..=16", extensible))]
    pub struct ExtensionContainerId(#[serde(with = "crate::asn1::view::integer")] pub Integer);
    /// CDD HardShoulderStatus.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    pub enum HardShoulderStatus {
        availableForStopping = 0,
        closed = 1,
        availableForDriving = 2,
    }
    /// Heading with its confidence. CDD Heading.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct Heading {
        #[rasn(identifier = "headingValue")]
        #[serde(rename = "headingValue")]
        pub heading_value: HeadingValue,
        #[rasn(identifier = "headingConfidence")]
        #[serde(rename = "headingConfidence")]
        pub heading_confidence: HeadingConfidence,
    }
    impl Heading {
        pub fn new(heading_value: HeadingValue, heading_confidence: HeadingConfidence) -> Self {
            Self {
                heading_value,
                heading_confidence,
            }
        }
    }
    /// 0.1 degree, rounded up, at 95 %. CDD HeadingConfidence.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("1..=127"))]
    pub struct HeadingConfidence(pub u8);
    /// Quick part of the state of a vehicle or a road-side unit. TS 103 900 HighFrequencyContainer.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(choice, automatic_tags)]
    #[non_exhaustive]
    pub enum HighFrequencyContainer {
        basicVehicleContainerHighFrequency(BasicVehicleContainerHighFrequency),
        rsuContainerHighFrequency(RSUContainerHighFrequency),
    }
    /// CDD LightBarSirenInUse.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate)]
    pub struct LightBarSirenInUse(#[serde(with = "crate::asn1::view::fixed_bits")] pub FixedBitString<2usize>);
    /// Slow part of the state. TS 103 900 LowFrequencyContainer.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(choice, automatic_tags)]
    #[non_exhaustive]
    pub enum LowFrequencyContainer {
        basicVehicleContainerLowFrequency(BasicVehicleContainerLowFrequency),
    }
    /// How old the data of the vehicle may be. CDD PerformanceClass.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=7"))]
    pub struct PerformanceClass(pub u8);
    /// Where others are not to be disturbed. CDD ProtectedCommunicationZone.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct ProtectedCommunicationZone {
        #[rasn(identifier = "protectedZoneType")]
        #[serde(rename = "protectedZoneType")]
        pub protected_zone_type: ProtectedZoneType,
        #[rasn(identifier = "expiryTime")]
        #[serde(rename = "expiryTime")]
        pub expiry_time: Option<TimestampIts>,
        #[rasn(identifier = "protectedZoneLatitude")]
        #[serde(rename = "protectedZoneLatitude")]
        pub protected_zone_latitude: Latitude,
        #[rasn(identifier = "protectedZoneLongitude")]
        #[serde(rename = "protectedZoneLongitude")]
        pub protected_zone_longitude: Longitude,
        #[rasn(identifier = "protectedZoneRadius")]
        #[serde(rename = "protectedZoneRadius")]
        pub protected_zone_radius: Option<ProtectedZoneRadius>,
        #[rasn(identifier = "protectedZoneId")]
        #[serde(rename = "protectedZoneId")]
        pub protected_zone_id: Option<ProtectedZoneId>,
    }
    impl ProtectedCommunicationZone {
        pub fn new(
            protected_zone_type: ProtectedZoneType,
            expiry_time: Option<TimestampIts>,
            protected_zone_latitude: Latitude,
            protected_zone_longitude: Longitude,
            protected_zone_radius: Option<ProtectedZoneRadius>,
            protected_zone_id: Option<ProtectedZoneId>,
        ) -> Self {
            Self {
                protected_zone_type,
                expiry_time,
                protected_zone_latitude,
                protected_zone_longitude,
                protected_zone_radius,
                protected_zone_id,
            }
        }
    }
    /// CDD ProtectedCommunicationZonesRSU.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, size("1..=16"))]
    pub struct ProtectedCommunicationZonesRSU(pub SequenceOf<ProtectedCommunicationZone>);
    /// CDD ProtectedZoneId.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=134217727"))]
    pub struct ProtectedZoneId(pub u32);
    /// 1 m. CDD ProtectedZoneRadius.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("1..=255", extensible))]
    pub struct ProtectedZoneRadius(#[serde(with = "crate::asn1::view::integer")] pub Integer);
    /// CDD ProtectedZoneType.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    #[non_exhaustive]
    pub enum ProtectedZoneType {
        permanentCenDsrcTolling = 0,
        #[rasn(extension_addition)]
        temporaryCenDsrcTolling = 1,
    }
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct PtActivation {
        #[rasn(identifier = "ptActivationType")]
        #[serde(rename = "ptActivationType")]
        pub pt_activation_type: PtActivationType,
        #[rasn(identifier = "ptActivationData")]
        #[serde(rename = "ptActivationData")]
        pub pt_activation_data: PtActivationData,
    }
    impl PtActivation {
        pub fn new(
            pt_activation_type: PtActivationType,
            pt_activation_data: PtActivationData,
        ) -> Self {
            Self {
                pt_activation_type,
                pt_activation_data,
            }
        }
    }
    /// CDD PtActivationData.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, size("1..=20"))]
    pub struct PtActivationData(#[serde(with = "crate::asn1::view::octets")] pub OctetString);
    /// CDD PtActivationType.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=255"))]
    pub struct PtActivationType(pub u8);
    /// TS 103 900 PublicTransportContainer.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct PublicTransportContainer {
        #[rasn(identifier = "embarkationStatus")]
        #[serde(rename = "embarkationStatus")]
        pub embarkation_status: EmbarkationStatus,
        #[rasn(identifier = "ptActivation")]
        #[serde(rename = "ptActivation")]
        pub pt_activation: Option<PtActivation>,
    }
    impl PublicTransportContainer {
        pub fn new(
            embarkation_status: EmbarkationStatus,
            pt_activation: Option<PtActivation>,
        ) -> Self {
            Self {
                embarkation_status,
                pt_activation,
            }
        }
    }
    /// TS 103 900 RSUContainerHighFrequency.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct RSUContainerHighFrequency {
        #[rasn(identifier = "protectedCommunicationZonesRSU")]
        #[serde(rename = "protectedCommunicationZonesRSU")]
        pub protected_communication_zones_rsu: Option<ProtectedCommunicationZonesRSU>,
    }
    impl RSUContainerHighFrequency {
        pub fn new(
            protected_communication_zones_rsu: Option<ProtectedCommunicationZonesRSU>,
        ) -> Self {
            Self {
                protected_communication_zones_rsu,
            }
        }
    }
    /// TS 103 900 RescueContainer.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct RescueContainer {
        #[rasn(identifier = "lightBarSirenInUse")]
        #[serde(rename = "lightBarSirenInUse")]
        pub light_bar_siren_in_use: LightBarSirenInUse,
    }
    impl RescueContainer {
        pub fn new(light_bar_siren_in_use: LightBarSirenInUse) -> Self {
            Self {
                light_bar_siren_in_use,
            }
        }
    }
    /// TS 103 900 RoadWorksContainerBasic.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct RoadWorksContainerBasic {
        #[rasn(identifier = "roadworksSubCauseCode")]
        #[serde(rename = "roadworksSubCauseCode")]
        pub roadworks_sub_cause_code: Option<RoadworksSubCauseCode>,
        #[rasn(identifier = "lightBarSirenInUse")]
        #[serde(rename = "lightBarSirenInUse")]
        pub light_bar_siren_in_use: LightBarSirenInUse,
        #[rasn(identifier = "closedLanes")]
        #[serde(rename = "closedLanes")]
        pub closed_lanes: Option<ClosedLanes>,
    }
    impl RoadWorksContainerBasic {
        pub fn new(
            roadworks_sub_cause_code: Option<RoadworksSubCauseCode>,
            light_bar_siren_in_use: LightBarSirenInUse,
            closed_lanes: Option<ClosedLanes>,
        ) -> Self {
            Self {
                roadworks_sub_cause_code,
                light_bar_siren_in_use,
                closed_lanes,
            }
        }
    }
    /// CDD RoadworksSubCauseCode.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=255"))]
    pub struct RoadworksSubCauseCode(pub u8);
    /// TS 103 900 SafetyCarContainer.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct SafetyCarContainer {
        #[rasn(identifier = "lightBarSirenInUse")]
        #[serde(rename = "lightBarSirenInUse")]
        pub light_bar_siren_in_use: LightBarSirenInUse,
        #[rasn(identifier = "incidentIndication")]
        #[serde(rename = "incidentIndication")]
        pub incident_indication: Option<CauseCodeV2>,
        #[rasn(identifier = "trafficRule")]
        #[serde(rename = "trafficRule")]
        pub traffic_rule: Option<TrafficRule>,
        #[rasn(identifier = "speedLimit")]
        #[serde(rename = "speedLimit")]
        pub speed_limit: Option<SpeedLimit>,
    }
    impl SafetyCarContainer {
        pub fn new(
            light_bar_siren_in_use: LightBarSirenInUse,
            incident_indication: Option<CauseCodeV2>,
            traffic_rule: Option<TrafficRule>,
            speed_limit: Option<SpeedLimit>,
        ) -> Self {
            Self {
                light_bar_siren_in_use,
                incident_indication,
                traffic_rule,
                speed_limit,
            }
        }
    }
    /// TS 103 900 SpecialTransportContainer.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct SpecialTransportContainer {
        #[rasn(identifier = "specialTransportType")]
        #[serde(rename = "specialTransportType")]
        pub special_transport_type: SpecialTransportType,
        #[rasn(identifier = "lightBarSirenInUse")]
        #[serde(rename = "lightBarSirenInUse")]
        pub light_bar_siren_in_use: LightBarSirenInUse,
    }
    impl SpecialTransportContainer {
        pub fn new(
            special_transport_type: SpecialTransportType,
            light_bar_siren_in_use: LightBarSirenInUse,
        ) -> Self {
            Self {
                special_transport_type,
                light_bar_siren_in_use,
            }
        }
    }
    /// CDD SpecialTransportType.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate)]
    pub struct SpecialTransportType(#[serde(with = "crate::asn1::view::fixed_bits")] pub FixedBitString<4usize>);
    /// Content for a vehicle with a special role. TS 103 900 SpecialVehicleContainer.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(choice, automatic_tags)]
    #[non_exhaustive]
    pub enum SpecialVehicleContainer {
        publicTransportContainer(PublicTransportContainer),
        specialTransportContainer(SpecialTransportContainer),
        dangerousGoodsContainer(DangerousGoodsContainer),
        roadWorksContainerBasic(RoadWorksContainerBasic),
        rescueContainer(RescueContainer),
        emergencyContainer(EmergencyContainer),
        safetyCarContainer(SafetyCarContainer),
    }
    /// 1 km/h. CDD SpeedLimit.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("1..=255"))]
    pub struct SpeedLimit(pub u8);
    /// Angle of the steering wheel. CDD SteeringWheelAngle.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct SteeringWheelAngle {
        #[rasn(identifier = "steeringWheelAngleValue")]
        #[serde(rename = "steeringWheelAngleValue")]
        pub steering_wheel_angle_value: SteeringWheelAngleValue,
        #[rasn(identifier = "steeringWheelAngleConfidence")]
        #[serde(rename = "steeringWheelAngleConfidence")]
        pub steering_wheel_angle_confidence: SteeringWheelAngleConfidence,
    }
    impl SteeringWheelAngle {
        pub fn new(
            steering_wheel_angle_value: SteeringWheelAngleValue,
            steering_wheel_angle_confidence: SteeringWheelAngleConfidence,
        ) -> Self {
            Self {
                steering_wheel_angle_value,
                steering_wheel_angle_confidence,
            }
        }
    }
    /// 1.5 degrees, at 95 %. CDD SteeringWheelAngleConfidence.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("1..=127"))]
    pub struct SteeringWheelAngleConfidence(pub u8);
    /// 1.5 degrees, to the left positive. CDD SteeringWheelAngleValue.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("-511..=512"))]
    pub struct SteeringWheelAngleValue(pub i16);
    /// CDD TrafficRule.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    #[non_exhaustive]
    pub enum TrafficRule {
        noPassing = 0,
        noPassingForTrucks = 1,
        passToRight = 2,
        passToLeft = 3,
        #[rasn(extension_addition)]
        passToLeftOrRight = 4,
    }
    /// Length of a vehicle, and what the trailer makes of it. CDD VehicleLength.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct VehicleLength {
        #[rasn(identifier = "vehicleLengthValue")]
        #[serde(rename = "vehicleLengthValue")]
        pub vehicle_length_value: VehicleLengthValue,
        #[rasn(identifier = "vehicleLengthConfidenceIndication")]
        #[serde(rename = "vehicleLengthConfidenceIndication")]
        pub vehicle_length_confidence_indication: VehicleLengthConfidenceIndication,
    }
    impl VehicleLength {
        pub fn new(
            vehicle_length_value: VehicleLengthValue,
            vehicle_length_confidence_indication: VehicleLengthConfidenceIndication,
        ) -> Self {
            Self {
                vehicle_length_value,
                vehicle_length_confidence_indication,
            }
        }
    }
    /// Presence of a trailer. CDD VehicleLengthConfidenceIndication.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    pub enum VehicleLengthConfidenceIndication {
        noTrailerPresent = 0,
        trailerPresentWithKnownLength = 1,
        trailerPresentWithUnknownLength = 2,
        trailerPresenceIsUnknown = 3,
        unavailable = 4,
    }
    /// 0.1 m, rounded up; 1022 stands for more than 102.1 m. CDD VehicleLengthValue.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("1..=1023"))]
    pub struct VehicleLengthValue(pub u16);
    /// Role of a vehicle. CDD VehicleRole.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    pub enum VehicleRole {
        default = 0,
        publicTransport = 1,
        specialTransport = 2,
        dangerousGoods = 3,
        roadWork = 4,
        rescue = 5,
        emergency = 6,
        safetyCar = 7,
        agriculture = 8,
        commercial = 9,
        military = 10,
        roadOperator = 11,
        taxi = 12,
        uvar = 13,
        rfu1 = 14,
        rfu2 = 15,
    }
    /// One of them. TS 103 900 WrappedExtensionContainer.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct WrappedExtensionContainer {
        #[rasn(identifier = "containerId")]
        #[serde(rename = "containerId")]
        pub container_id: ExtensionContainerId,
        #[rasn(identifier = "containerData")]
        #[serde(rename = "containerData")]
        pub container_data: CamContainerData,
    }
    impl WrappedExtensionContainer {
        pub fn new(container_id: ExtensionContainerId, container_data: CamContainerData) -> Self {
            Self {
                container_id,
                container_data,
            }
        }
    }
    /// Containers of later versions, by number. TS 103 900 WrappedExtensionContainers.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, size("1..=8", extensible))]
    pub struct WrappedExtensionContainers(pub SequenceOf<WrappedExtensionContainer>);
}
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
    /// Sender of a message of a moving station. CDD BasicContainer.
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
    /// Use of the yaw rate for the curvature. CDD CurvatureCalculationMode.
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
        #[serde(default = "geo_position_altitude_default")]
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
        #[serde(default = "lane_position_and_type_lane_type_default")]
        pub lane_type: LaneType,
        #[rasn(default = "lane_position_and_type_direction_default")]
        #[serde(default = "lane_position_and_type_direction_default")]
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
        #[serde(default = "lane_position_with_lateral_details_lane_type_default")]
        pub lane_type: LaneType,
        #[rasn(default = "lane_position_with_lateral_details_direction_default")]
        #[serde(default = "lane_position_with_lateral_details_direction_default")]
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
    /// Basis of an estimate. CDD MetaInformation.
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
        #[serde(default = "path_point_predicted_delta_altitude_default")]
        pub delta_altitude: DeltaAltitude,
        #[rasn(
            default = "path_point_predicted_altitude_confidence_default",
            identifier = "altitudeConfidence"
        )]
        #[serde(rename = "altitudeConfidence")]
        #[serde(default = "path_point_predicted_altitude_confidence_default")]
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
    /// Indication that a safe distance to another station is kept, or not. CDD SafeDistanceIndication.
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
    /// 0.1 m, rounded up; 61 stands for more than 6.0 m. CDD VehicleWidth.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("1..=62"))]
    pub struct VehicleWidth(pub u8);
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
    /// Use of a device by a road user. CDD VruDeviceUsage.
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
pub mod crossguard_cdd211 {
    extern crate alloc;
    use super::crossguard_cdd::{
        AccelerationChangeIndication, AltitudeConfidence, BasicContainer, CardinalNumber1B,
        CartesianAngle, ClusterJoinInfo, ClusterLeaveInfo, ConfidenceLevel, Curvature,
        CurvatureCalculationMode, DeltaAltitude, DeltaLatitude, DeltaLongitude,
        DeltaTimeQuarterSecond, DeltaTimeTenthOfSecond, GenerationDeltaTime,
        HeadingChangeIndication, Identifier2B, ItsPduHeader, LanePosition, LaneType,
        LateralAcceleration, LongitudinalAcceleration, MapPosition, PathPoint,
        PosConfidenceEllipse, SequenceOfSafeDistanceIndication,
        SequenceOfTrajectoryInterceptionIndication, Speed, StabilityChangeIndication,
        TrafficParticipantType, VerticalAcceleration, VruClusterInformation, VruExteriorLights,
        Wgs84Angle, YawRate,
    };
    use super::crossguard_cpm::{
        Acceleration3dWithConfidence, CartesianAngularVelocityComponent,
        CartesianPosition3dWithConfidence, CorrelationColumn, DeltaTimeMilliSecondSigned,
        EulerAnglesWithConfidence, MatrixIncludedComponents, ObjectDimension,
        ObjectPerceptionQuality, OtherSubClass, SequenceOfIdentifier1B, Velocity3dWithConfidence,
    };
    use core::borrow::Borrow;
    use rasn::prelude::*;
    use serde::{Deserialize, Serialize};
    use std::sync::LazyLock;
    /// CDD v2.1.1 ClusterBreakupInfo.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct ClusterBreakupInfo211 {
        #[rasn(identifier = "clusterBreakupReason")]
        #[serde(rename = "clusterBreakupReason")]
        pub cluster_breakup_reason: ClusterBreakupReason211,
        #[rasn(identifier = "breakupTime")]
        #[serde(rename = "breakupTime")]
        pub breakup_time: DeltaTimeQuarterSecond,
    }
    impl ClusterBreakupInfo211 {
        pub fn new(
            cluster_breakup_reason: ClusterBreakupReason211,
            breakup_time: DeltaTimeQuarterSecond,
        ) -> Self {
            Self {
                cluster_breakup_reason,
                breakup_time,
            }
        }
    }
    /// CDD v2.1.1 ClusterBreakupReason.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    pub enum ClusterBreakupReason211 {
        notProvided = 0,
        clusteringPurposeCompleted = 1,
        leaderMovedOutOfClusterBoundingBox = 2,
        joiningAnotherCluster = 3,
        enteringLowRiskAreaBasedOnMaps = 4,
        receptionOfCpmContainingCluster = 5,
        max = 15,
    }
    /// Where across the road. CDD v2.1.1 GeneralizedLanePosition.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(choice, automatic_tags)]
    #[non_exhaustive]
    pub enum GeneralizedLanePosition211 {
        trafficLanePosition(LanePosition),
        nonTrafficLanePosition(LanePositionAndType211),
        trafficIslandPosition(TrafficIslandPosition211),
        mapPosition(MapPosition),
    }
    /// CDD v2.1.1 LanePositionAndType.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct LanePositionAndType211 {
        #[rasn(identifier = "transversalPosition")]
        #[serde(rename = "transversalPosition")]
        pub transversal_position: LanePosition,
        #[rasn(identifier = "laneType")]
        #[serde(rename = "laneType")]
        pub lane_type: LaneType,
    }
    impl LanePositionAndType211 {
        pub fn new(transversal_position: LanePosition, lane_type: LaneType) -> Self {
            Self {
                transversal_position,
                lane_type,
            }
        }
    }
    /// CDD v2.1.1 LowerTriangularPositiveSemidefiniteMatrices.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, size("1..=4"))]
    pub struct LowerTriangularPositiveSemidefiniteMatrices211(
        pub SequenceOf<LowerTriangularPositiveSemidefiniteMatrix211>,
    );
    /// CDD v2.1.1 LowerTriangularPositiveSemidefiniteMatrix.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct LowerTriangularPositiveSemidefiniteMatrix211 {
        #[rasn(identifier = "componentsIncludedIntheMatrix")]
        #[serde(rename = "componentsIncludedIntheMatrix")]
        pub components_included_inthe_matrix: MatrixIncludedComponents,
        pub matrix: LowerTriangularPositiveSemidefiniteMatrixColumns211,
    }
    impl LowerTriangularPositiveSemidefiniteMatrix211 {
        pub fn new(
            components_included_inthe_matrix: MatrixIncludedComponents,
            matrix: LowerTriangularPositiveSemidefiniteMatrixColumns211,
        ) -> Self {
            Self {
                components_included_inthe_matrix,
                matrix,
            }
        }
    }
    /// CDD v2.1.1 LowerTriangularPositiveSemidefiniteMatrixColumns.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, size("1..=13"))]
    pub struct LowerTriangularPositiveSemidefiniteMatrixColumns211(
        pub SequenceOf<CorrelationColumn>,
    );
    /// CDD v2.1.1 ObjectClass.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(choice, automatic_tags)]
    #[non_exhaustive]
    pub enum ObjectClass211 {
        #[rasn(value("0..=14"))]
        vehicleSubClass(TrafficParticipantType),
        vruSubClass(VruProfileAndSubprofile211),
        groupSubClass(VruClusterInformation),
        otherSubClass(OtherSubClass),
    }
    /// Possible classes of an object. CDD v2.1.1 ObjectClassDescription.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, size("1..=8"))]
    pub struct ObjectClassDescription211(pub SequenceOf<ObjectClassWithConfidence211>);
    /// CDD v2.1.1 ObjectClassWithConfidence.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct ObjectClassWithConfidence211 {
        #[rasn(identifier = "objectClass")]
        #[serde(rename = "objectClass")]
        pub object_class: ObjectClass211,
        pub confidence: ConfidenceLevel,
    }
    impl ObjectClassWithConfidence211 {
        pub fn new(object_class: ObjectClass211, confidence: ConfidenceLevel) -> Self {
            Self {
                object_class,
                confidence,
            }
        }
    }
    /// Always 40 points. CDD v2.1.1 PathHistory.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, size("40"))]
    pub struct PathHistory211(pub SequenceOf<PathPoint>);
    /// CDD v2.1.1 PathPointPredicted.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct PathPointPredicted211 {
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
            default = "path_point_predicted211_delta_altitude_default",
            identifier = "deltaAltitude"
        )]
        #[serde(rename = "deltaAltitude")]
        #[serde(default = "path_point_predicted211_delta_altitude_default")]
        pub delta_altitude: DeltaAltitude,
        #[rasn(
            default = "path_point_predicted211_altitude_confidence_default",
            identifier = "altitudeConfidence"
        )]
        #[serde(rename = "altitudeConfidence")]
        #[serde(default = "path_point_predicted211_altitude_confidence_default")]
        pub altitude_confidence: AltitudeConfidence,
        #[rasn(identifier = "pathDeltaTime")]
        #[serde(rename = "pathDeltaTime")]
        pub path_delta_time: DeltaTimeTenthOfSecond,
    }
    impl PathPointPredicted211 {
        pub fn new(
            delta_latitude: DeltaLatitude,
            delta_longitude: DeltaLongitude,
            horizontal_position_confidence: Option<PosConfidenceEllipse>,
            delta_altitude: DeltaAltitude,
            altitude_confidence: AltitudeConfidence,
            path_delta_time: DeltaTimeTenthOfSecond,
        ) -> Self {
            Self {
                delta_latitude,
                delta_longitude,
                horizontal_position_confidence,
                delta_altitude,
                altitude_confidence,
                path_delta_time,
            }
        }
    }
    fn path_point_predicted211_delta_altitude_default() -> DeltaAltitude {
        DeltaAltitude(12800)
    }
    fn path_point_predicted211_altitude_confidence_default() -> AltitudeConfidence {
        AltitudeConfidence::unavailable
    }
    /// CDD v2.1.1 PathPredicted.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, size("0..=15", extensible))]
    pub struct PathPredicted211(pub SequenceOf<PathPointPredicted211>);
    /// An object, relative to the reference position: x to the east, y to the north, z up. CDD
    /// PerceivedObject.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct PerceivedObject211 {
        #[rasn(identifier = "objectId")]
        #[serde(rename = "objectId")]
        pub object_id: Option<Identifier2B>,
        #[rasn(identifier = "measurementDeltaTime")]
        #[serde(rename = "measurementDeltaTime")]
        pub measurement_delta_time: DeltaTimeMilliSecondSigned,
        pub position: CartesianPosition3dWithConfidence,
        pub velocity: Option<Velocity3dWithConfidence>,
        pub acceleration: Option<Acceleration3dWithConfidence>,
        pub angles: Option<EulerAnglesWithConfidence>,
        #[rasn(identifier = "zAngularVelocity")]
        #[serde(rename = "zAngularVelocity")]
        pub z_angular_velocity: Option<CartesianAngularVelocityComponent>,
        #[rasn(identifier = "lowerTriangularCorrelationMatrices")]
        #[serde(rename = "lowerTriangularCorrelationMatrices")]
        pub lower_triangular_correlation_matrices:
            Option<LowerTriangularPositiveSemidefiniteMatrices211>,
        #[rasn(identifier = "objectDimensionZ")]
        #[serde(rename = "objectDimensionZ")]
        pub object_dimension_z: Option<ObjectDimension>,
        #[rasn(identifier = "objectDimensionY")]
        #[serde(rename = "objectDimensionY")]
        pub object_dimension_y: Option<ObjectDimension>,
        #[rasn(identifier = "objectDimensionX")]
        #[serde(rename = "objectDimensionX")]
        pub object_dimension_x: Option<ObjectDimension>,
        #[rasn(value("0..=2047"), identifier = "objectAge")]
        #[serde(rename = "objectAge")]
        pub object_age: Option<DeltaTimeMilliSecondSigned>,
        #[rasn(identifier = "objectPerceptionQuality")]
        #[serde(rename = "objectPerceptionQuality")]
        pub object_perception_quality: Option<ObjectPerceptionQuality>,
        #[rasn(identifier = "sensorIdList")]
        #[serde(rename = "sensorIdList")]
        pub sensor_id_list: Option<SequenceOfIdentifier1B>,
        pub classification: Option<ObjectClassDescription211>,
        #[rasn(identifier = "mapPosition")]
        #[serde(rename = "mapPosition")]
        pub map_position: Option<MapPosition>,
    }
    impl PerceivedObject211 {
        pub fn new(
            object_id: Option<Identifier2B>,
            measurement_delta_time: DeltaTimeMilliSecondSigned,
            position: CartesianPosition3dWithConfidence,
            velocity: Option<Velocity3dWithConfidence>,
            acceleration: Option<Acceleration3dWithConfidence>,
            angles: Option<EulerAnglesWithConfidence>,
            z_angular_velocity: Option<CartesianAngularVelocityComponent>,
            lower_triangular_correlation_matrices: Option<
                LowerTriangularPositiveSemidefiniteMatrices211,
            >,
            object_dimension_z: Option<ObjectDimension>,
            object_dimension_y: Option<ObjectDimension>,
            object_dimension_x: Option<ObjectDimension>,
            object_age: Option<DeltaTimeMilliSecondSigned>,
            object_perception_quality: Option<ObjectPerceptionQuality>,
            sensor_id_list: Option<SequenceOfIdentifier1B>,
            classification: Option<ObjectClassDescription211>,
            map_position: Option<MapPosition>,
        ) -> Self {
            Self {
                object_id,
                measurement_delta_time,
                position,
                velocity,
                acceleration,
                angles,
                z_angular_velocity,
                lower_triangular_correlation_matrices,
                object_dimension_z,
                object_dimension_y,
                object_dimension_x,
                object_age,
                object_perception_quality,
                sensor_id_list,
                classification,
                map_position,
            }
        }
    }
    /// TS 103 324 PerceivedObjectContainer.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct PerceivedObjectContainer211 {
        #[rasn(identifier = "numberOfPerceivedObjects")]
        #[serde(rename = "numberOfPerceivedObjects")]
        pub number_of_perceived_objects: CardinalNumber1B,
        #[rasn(identifier = "perceivedObjects")]
        #[serde(rename = "perceivedObjects")]
        pub perceived_objects: PerceivedObjects211,
    }
    impl PerceivedObjectContainer211 {
        pub fn new(
            number_of_perceived_objects: CardinalNumber1B,
            perceived_objects: PerceivedObjects211,
        ) -> Self {
            Self {
                number_of_perceived_objects,
                perceived_objects,
            }
        }
    }
    /// TS 103 324 PerceivedObjects.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, size("0..=255", extensible))]
    pub struct PerceivedObjects211(pub SequenceOf<PerceivedObject211>);
    /// CDD v2.1.1 TrafficIslandPosition.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct TrafficIslandPosition211 {
        #[rasn(identifier = "oneSide")]
        #[serde(rename = "oneSide")]
        pub one_side: LanePositionAndType211,
        #[rasn(identifier = "otherSide")]
        #[serde(rename = "otherSide")]
        pub other_side: LanePositionAndType211,
    }
    impl TrafficIslandPosition211 {
        pub fn new(one_side: LanePositionAndType211, other_side: LanePositionAndType211) -> Self {
            Self {
                one_side,
                other_side,
            }
        }
    }
    /// VRU awareness message: header protocolVersion 3, messageId 16. TS 103 300-3 VAM.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct VAM211 {
        pub header: ItsPduHeader,
        pub vam: VruAwareness211,
    }
    impl VAM211 {
        pub fn new(header: ItsPduHeader, vam: VruAwareness211) -> Self {
            Self { header, vam }
        }
    }
    /// TS 103 300-3 VamParameters.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct VamParameters211 {
        #[rasn(identifier = "basicContainer")]
        #[serde(rename = "basicContainer")]
        pub basic_container: BasicContainer,
        #[rasn(identifier = "vruHighFrequencyContainer")]
        #[serde(rename = "vruHighFrequencyContainer")]
        pub vru_high_frequency_container: VruHighFrequencyContainer211,
        #[rasn(identifier = "vruLowFrequencyContainer")]
        #[serde(rename = "vruLowFrequencyContainer")]
        pub vru_low_frequency_container: Option<VruLowFrequencyContainer211>,
        #[rasn(identifier = "vruClusterInformationContainer")]
        #[serde(rename = "vruClusterInformationContainer")]
        pub vru_cluster_information_container: Option<VruClusterInformationContainer211>,
        #[rasn(identifier = "vruClusterOperationContainer")]
        #[serde(rename = "vruClusterOperationContainer")]
        pub vru_cluster_operation_container: Option<VruClusterOperationContainer211>,
        #[rasn(identifier = "vruMotionPredictionContainer")]
        #[serde(rename = "vruMotionPredictionContainer")]
        pub vru_motion_prediction_container: Option<VruMotionPredictionContainer211>,
    }
    impl VamParameters211 {
        pub fn new(
            basic_container: BasicContainer,
            vru_high_frequency_container: VruHighFrequencyContainer211,
            vru_low_frequency_container: Option<VruLowFrequencyContainer211>,
            vru_cluster_information_container: Option<VruClusterInformationContainer211>,
            vru_cluster_operation_container: Option<VruClusterOperationContainer211>,
            vru_motion_prediction_container: Option<VruMotionPredictionContainer211>,
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
    pub struct VruAwareness211 {
        #[rasn(identifier = "generationDeltaTime")]
        #[serde(rename = "generationDeltaTime")]
        pub generation_delta_time: GenerationDeltaTime,
        #[rasn(identifier = "vamParameters")]
        #[serde(rename = "vamParameters")]
        pub vam_parameters: VamParameters211,
    }
    impl VruAwareness211 {
        pub fn new(
            generation_delta_time: GenerationDeltaTime,
            vam_parameters: VamParameters211,
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
    pub struct VruClusterInformationContainer211 {
        #[rasn(identifier = "vruClusterInformation")]
        #[serde(rename = "vruClusterInformation")]
        pub vru_cluster_information: VruClusterInformation,
    }
    impl VruClusterInformationContainer211 {
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
    pub struct VruClusterOperationContainer211 {
        #[rasn(identifier = "clusterJoinInfo")]
        #[serde(rename = "clusterJoinInfo")]
        pub cluster_join_info: Option<ClusterJoinInfo>,
        #[rasn(identifier = "clusterLeaveInfo")]
        #[serde(rename = "clusterLeaveInfo")]
        pub cluster_leave_info: Option<ClusterLeaveInfo>,
        #[rasn(identifier = "clusterBreakupInfo")]
        #[serde(rename = "clusterBreakupInfo")]
        pub cluster_breakup_info: Option<ClusterBreakupInfo211>,
        #[rasn(identifier = "clusterIdChangeTimeInfo")]
        #[serde(rename = "clusterIdChangeTimeInfo")]
        pub cluster_id_change_time_info: Option<DeltaTimeQuarterSecond>,
    }
    impl VruClusterOperationContainer211 {
        pub fn new(
            cluster_join_info: Option<ClusterJoinInfo>,
            cluster_leave_info: Option<ClusterLeaveInfo>,
            cluster_breakup_info: Option<ClusterBreakupInfo211>,
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
    /// CDD v2.1.1 VruDeviceUsage.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    pub enum VruDeviceUsage211 {
        unavailable = 0,
        other = 1,
        idle = 2,
        listeningToAudio = 3,
        typing = 4,
        calling = 5,
        playingGames = 6,
        reading = 7,
        viewing = 8,
        max = 255,
    }
    /// CDD v2.1.1 VruEnvironment.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    pub enum VruEnvironment211 {
        unavailable = 0,
        intersectionCrossing = 1,
        zebraCrossing = 2,
        sidewalk = 3,
        onVehicleRoad = 4,
        protectedGeographicArea = 5,
        max = 255,
    }
    /// Quick part of the state. TS 103 300-3 VruHighFrequencyContainer.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct VruHighFrequencyContainer211 {
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
        pub vru_lane_position: Option<GeneralizedLanePosition211>,
        pub environment: Option<VruEnvironment211>,
        #[rasn(identifier = "movementControl")]
        #[serde(rename = "movementControl")]
        pub movement_control: Option<VruMovementControl211>,
        pub orientation: Option<Wgs84Angle>,
        #[rasn(identifier = "rollAngle")]
        #[serde(rename = "rollAngle")]
        pub roll_angle: Option<CartesianAngle>,
        #[rasn(identifier = "deviceUsage")]
        #[serde(rename = "deviceUsage")]
        pub device_usage: Option<VruDeviceUsage211>,
    }
    impl VruHighFrequencyContainer211 {
        pub fn new(
            heading: Wgs84Angle,
            speed: Speed,
            longitudinal_acceleration: LongitudinalAcceleration,
            curvature: Option<Curvature>,
            curvature_calculation_mode: Option<CurvatureCalculationMode>,
            yaw_rate: Option<YawRate>,
            lateral_acceleration: Option<LateralAcceleration>,
            vertical_acceleration: Option<VerticalAcceleration>,
            vru_lane_position: Option<GeneralizedLanePosition211>,
            environment: Option<VruEnvironment211>,
            movement_control: Option<VruMovementControl211>,
            orientation: Option<Wgs84Angle>,
            roll_angle: Option<CartesianAngle>,
            device_usage: Option<VruDeviceUsage211>,
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
    /// Slow part of the state. TS 103 300-3 VruLowFrequencyContainer.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct VruLowFrequencyContainer211 {
        #[rasn(identifier = "profileAndSubprofile")]
        #[serde(rename = "profileAndSubprofile")]
        pub profile_and_subprofile: VruProfileAndSubprofile211,
        #[rasn(identifier = "sizeClass")]
        #[serde(rename = "sizeClass")]
        pub size_class: Option<VruSizeClass211>,
        #[rasn(identifier = "exteriorLights")]
        #[serde(rename = "exteriorLights")]
        pub exterior_lights: Option<VruExteriorLights>,
    }
    impl VruLowFrequencyContainer211 {
        pub fn new(
            profile_and_subprofile: VruProfileAndSubprofile211,
            size_class: Option<VruSizeClass211>,
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
    pub struct VruMotionPredictionContainer211 {
        #[rasn(identifier = "pathHistory")]
        #[serde(rename = "pathHistory")]
        pub path_history: Option<PathHistory211>,
        #[rasn(identifier = "pathPrediction")]
        #[serde(rename = "pathPrediction")]
        pub path_prediction: Option<PathPredicted211>,
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
    impl VruMotionPredictionContainer211 {
        pub fn new(
            path_history: Option<PathHistory211>,
            path_prediction: Option<PathPredicted211>,
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
    /// CDD v2.1.1 VruMovementControl.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    pub enum VruMovementControl211 {
        unavailable = 0,
        braking = 1,
        hardBraking = 2,
        stopPedaling = 3,
        brakingAndStopPedaling = 4,
        hardBrakingAndStopPedaling = 5,
        noReaction = 6,
        max = 255,
    }
    /// CDD v2.1.1 VruProfileAndSubprofile.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(choice, automatic_tags)]
    #[non_exhaustive]
    pub enum VruProfileAndSubprofile211 {
        pedestrian(VruSubProfilePedestrian211),
        bicyclistAndLightVruVehicle(VruSubProfileBicyclist211),
        motorcyclist(VruSubProfileMotorcyclist211),
        animal(VruSubProfileAnimal211),
    }
    /// CDD v2.1.1 VruSizeClass.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    pub enum VruSizeClass211 {
        unavailable = 0,
        low = 1,
        medium = 2,
        high = 3,
        max = 15,
    }
    /// CDD v2.1.1 VruSubProfileAnimal.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    pub enum VruSubProfileAnimal211 {
        unavailable = 0,
        #[rasn(identifier = "wild-animal")]
        #[serde(rename = "wild-animal")]
        wild_animal = 1,
        #[rasn(identifier = "farm-animal")]
        #[serde(rename = "farm-animal")]
        farm_animal = 2,
        #[rasn(identifier = "service-animal")]
        #[serde(rename = "service-animal")]
        service_animal = 3,
        max = 15,
    }
    /// CDD v2.1.1 VruSubProfileBicyclist.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    pub enum VruSubProfileBicyclist211 {
        unavailable = 0,
        bicyclist = 1,
        #[rasn(identifier = "wheelchair-user")]
        #[serde(rename = "wheelchair-user")]
        wheelchair_user = 2,
        #[rasn(identifier = "horse-and-rider")]
        #[serde(rename = "horse-and-rider")]
        horse_and_rider = 3,
        rollerskater = 4,
        #[rasn(identifier = "e-scooter")]
        #[serde(rename = "e-scooter")]
        e_scooter = 5,
        #[rasn(identifier = "personal-transporter")]
        #[serde(rename = "personal-transporter")]
        personal_transporter = 6,
        pedelec = 7,
        #[rasn(identifier = "speed-pedelec")]
        #[serde(rename = "speed-pedelec")]
        speed_pedelec = 8,
        max = 15,
    }
    /// CDD v2.1.1 VruSubProfileMotorcyclist.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    pub enum VruSubProfileMotorcyclist211 {
        unavailable = 0,
        moped = 1,
        motorcycle = 2,
        #[rasn(identifier = "motorcycle-and-sidecar-right")]
        #[serde(rename = "motorcycle-and-sidecar-right")]
        motorcycle_and_sidecar_right = 3,
        #[rasn(identifier = "motorcycle-and-sidecar-left")]
        #[serde(rename = "motorcycle-and-sidecar-left")]
        motorcycle_and_sidecar_left = 4,
        max = 15,
    }
    /// CDD v2.1.1 VruSubProfilePedestrian.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    pub enum VruSubProfilePedestrian211 {
        unavailable = 0,
        #[rasn(identifier = "ordinary-pedestrian")]
        #[serde(rename = "ordinary-pedestrian")]
        ordinary_pedestrian = 1,
        #[rasn(identifier = "road-worker")]
        #[serde(rename = "road-worker")]
        road_worker = 2,
        #[rasn(identifier = "first-responder")]
        #[serde(rename = "first-responder")]
        first_responder = 3,
        max = 15,
    }
}
#[allow(
    non_camel_case_types,
    non_snake_case,
    non_upper_case_globals,
    unused,
    clippy::too_many_arguments
)]
pub mod crossguard_cpm {
    extern crate alloc;
    use super::crossguard_cdd::{
        AccelerationComponent, AccelerationConfidence, Altitude, CardinalNumber1B, CartesianAngle,
        ConfidenceLevel, Identifier1B, Identifier2B, ItsPduHeader, Latitude, Longitude,
        MapPosition, MapReference, ObjectDimensionValue, PosConfidenceEllipse, Shape, Speed,
        SpeedConfidence, TimestampIts, TrafficParticipantType, VehicleWidth, VruClusterInformation,
        VruProfileAndSubprofile, Wgs84Angle,
    };
    use core::borrow::Borrow;
    use rasn::prelude::*;
    use serde::{Deserialize, Serialize};
    use std::sync::LazyLock;
    /// CDD Acceleration3dWithConfidence.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(choice, automatic_tags)]
    pub enum Acceleration3dWithConfidence {
        polarAcceleration(AccelerationPolarWithZ),
        cartesianAcceleration(AccelerationCartesian),
    }
    /// CDD AccelerationCartesian.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct AccelerationCartesian {
        #[rasn(identifier = "xAcceleration")]
        #[serde(rename = "xAcceleration")]
        pub x_acceleration: AccelerationComponent,
        #[rasn(identifier = "yAcceleration")]
        #[serde(rename = "yAcceleration")]
        pub y_acceleration: AccelerationComponent,
        #[rasn(identifier = "zAcceleration")]
        #[serde(rename = "zAcceleration")]
        pub z_acceleration: Option<AccelerationComponent>,
    }
    impl AccelerationCartesian {
        pub fn new(
            x_acceleration: AccelerationComponent,
            y_acceleration: AccelerationComponent,
            z_acceleration: Option<AccelerationComponent>,
        ) -> Self {
            Self {
                x_acceleration,
                y_acceleration,
                z_acceleration,
            }
        }
    }
    /// CDD AccelerationMagnitude.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct AccelerationMagnitude {
        #[rasn(identifier = "accelerationMagnitudeValue")]
        #[serde(rename = "accelerationMagnitudeValue")]
        pub acceleration_magnitude_value: AccelerationMagnitudeValue,
        #[rasn(identifier = "accelerationConfidence")]
        #[serde(rename = "accelerationConfidence")]
        pub acceleration_confidence: AccelerationConfidence,
    }
    impl AccelerationMagnitude {
        pub fn new(
            acceleration_magnitude_value: AccelerationMagnitudeValue,
            acceleration_confidence: AccelerationConfidence,
        ) -> Self {
            Self {
                acceleration_magnitude_value,
                acceleration_confidence,
            }
        }
    }
    /// 0.1 m/s^2. CDD AccelerationMagnitudeValue.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=161"))]
    pub struct AccelerationMagnitudeValue(pub u8);
    /// CDD AccelerationPolarWithZ.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct AccelerationPolarWithZ {
        #[rasn(identifier = "accelerationMagnitude")]
        #[serde(rename = "accelerationMagnitude")]
        pub acceleration_magnitude: AccelerationMagnitude,
        #[rasn(identifier = "accelerationDirection")]
        #[serde(rename = "accelerationDirection")]
        pub acceleration_direction: CartesianAngle,
        #[rasn(identifier = "zAcceleration")]
        #[serde(rename = "zAcceleration")]
        pub z_acceleration: Option<AccelerationComponent>,
    }
    impl AccelerationPolarWithZ {
        pub fn new(
            acceleration_magnitude: AccelerationMagnitude,
            acceleration_direction: CartesianAngle,
            z_acceleration: Option<AccelerationComponent>,
        ) -> Self {
            Self {
                acceleration_magnitude,
                acceleration_direction,
                z_acceleration,
            }
        }
    }
    /// CDD AngularSpeedConfidence.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    pub enum AngularSpeedConfidence {
        #[rasn(identifier = "degSec-01")]
        #[serde(rename = "degSec-01")]
        degSec_01 = 0,
        #[rasn(identifier = "degSec-02")]
        #[serde(rename = "degSec-02")]
        degSec_02 = 1,
        #[rasn(identifier = "degSec-05")]
        #[serde(rename = "degSec-05")]
        degSec_05 = 2,
        #[rasn(identifier = "degSec-10")]
        #[serde(rename = "degSec-10")]
        degSec_10 = 3,
        #[rasn(identifier = "degSec-20")]
        #[serde(rename = "degSec-20")]
        degSec_20 = 4,
        #[rasn(identifier = "degSec-50")]
        #[serde(rename = "degSec-50")]
        degSec_50 = 5,
        outOfRange = 6,
        unavailable = 7,
    }
    /// CDD CardinalNumber3b.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("1..=8"))]
    pub struct CardinalNumber3b(pub u8);
    /// CDD CartesianAngularVelocityComponent.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct CartesianAngularVelocityComponent {
        pub value: CartesianAngularVelocityComponentValue,
        pub confidence: AngularSpeedConfidence,
    }
    impl CartesianAngularVelocityComponent {
        pub fn new(
            value: CartesianAngularVelocityComponentValue,
            confidence: AngularSpeedConfidence,
        ) -> Self {
            Self { value, confidence }
        }
    }
    /// 1 degree/s. CDD CartesianAngularVelocityComponentValue, with its spelling of one name.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("-255..=256"))]
    pub struct CartesianAngularVelocityComponentValue(pub i16);
    /// 0.01 m. CDD CartesianCoordinateLarge.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("-131072..=131071"))]
    pub struct CartesianCoordinateLarge(pub i32);
    /// CDD CartesianCoordinateWithConfidence.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct CartesianCoordinateWithConfidence {
        pub value: CartesianCoordinateLarge,
        pub confidence: CoordinateConfidence,
    }
    impl CartesianCoordinateWithConfidence {
        pub fn new(value: CartesianCoordinateLarge, confidence: CoordinateConfidence) -> Self {
            Self { value, confidence }
        }
    }
    /// CDD CartesianPosition3dWithConfidence.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct CartesianPosition3dWithConfidence {
        #[rasn(identifier = "xCoordinate")]
        #[serde(rename = "xCoordinate")]
        pub x_coordinate: CartesianCoordinateWithConfidence,
        #[rasn(identifier = "yCoordinate")]
        #[serde(rename = "yCoordinate")]
        pub y_coordinate: CartesianCoordinateWithConfidence,
        #[rasn(identifier = "zCoordinate")]
        #[serde(rename = "zCoordinate")]
        pub z_coordinate: Option<CartesianCoordinateWithConfidence>,
    }
    impl CartesianPosition3dWithConfidence {
        pub fn new(
            x_coordinate: CartesianCoordinateWithConfidence,
            y_coordinate: CartesianCoordinateWithConfidence,
            z_coordinate: Option<CartesianCoordinateWithConfidence>,
        ) -> Self {
            Self {
                x_coordinate,
                y_coordinate,
                z_coordinate,
            }
        }
    }
    /// Collective perception message: header protocolVersion 2, messageId 14. TS 103 324
    /// CollectivePerceptionMessage.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct CollectivePerceptionMessage {
        pub header: ItsPduHeader,
        pub payload: CpmPayload,
    }
    impl CollectivePerceptionMessage {
        pub fn new(header: ItsPduHeader, payload: CpmPayload) -> Self {
            Self { header, payload }
        }
    }
    /// 0.01 m. CDD CoordinateConfidence.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("1..=4096"))]
    pub struct CoordinateConfidence(pub u16);
    /// 0.01. CDD CorrelationCellValue.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("-100..=101"))]
    pub struct CorrelationCellValue(pub i8);
    /// CDD CorrelationColumn.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, size("1..=13", extensible))]
    pub struct CorrelationColumn(pub SequenceOf<CorrelationCellValue>);
    /// The octets of a container's own encoding.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate)]
    pub struct CpmContainerData(#[serde(with = "crate::asn1::view::octets")] pub OctetString);
    /// Number of a container: OriginatingVehicleContainer, OriginatingRsuContainer,
    /// SensorInformationContainer, PerceptionRegionContainer, PerceivedObjectContainer. TS 103 324
    /// CpmContainerId.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("1..=16"))]
    pub struct CpmContainerId(pub u8);
    /// TS 103 324 CpmPayload.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct CpmPayload {
        #[rasn(identifier = "managementContainer")]
        #[serde(rename = "managementContainer")]
        pub management_container: ManagementContainer,
        #[rasn(identifier = "cpmContainers")]
        #[serde(rename = "cpmContainers")]
        pub cpm_containers: WrappedCpmContainers,
    }
    impl CpmPayload {
        pub fn new(
            management_container: ManagementContainer,
            cpm_containers: WrappedCpmContainers,
        ) -> Self {
            Self {
                management_container,
                cpm_containers,
            }
        }
    }
    /// 1 ms, negative before the reference time. CDD DeltaTimeMilliSecondSigned.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("-2048..=2047"))]
    pub struct DeltaTimeMilliSecondSigned(pub i16);
    /// CDD EulerAnglesWithConfidence.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct EulerAnglesWithConfidence {
        #[rasn(identifier = "zAngle")]
        #[serde(rename = "zAngle")]
        pub z_angle: CartesianAngle,
        #[rasn(identifier = "yAngle")]
        #[serde(rename = "yAngle")]
        pub y_angle: Option<CartesianAngle>,
        #[rasn(identifier = "xAngle")]
        #[serde(rename = "xAngle")]
        pub x_angle: Option<CartesianAngle>,
    }
    impl EulerAnglesWithConfidence {
        pub fn new(
            z_angle: CartesianAngle,
            y_angle: Option<CartesianAngle>,
            x_angle: Option<CartesianAngle>,
        ) -> Self {
            Self {
                z_angle,
                y_angle,
                x_angle,
            }
        }
    }
    /// CDD LowerTriangularPositiveSemidefiniteMatrices.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, size("1..=4"))]
    pub struct LowerTriangularPositiveSemidefiniteMatrices(
        pub SequenceOf<LowerTriangularPositiveSemidefiniteMatrix>,
    );
    /// CDD LowerTriangularPositiveSemidefiniteMatrix.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct LowerTriangularPositiveSemidefiniteMatrix {
        #[rasn(identifier = "componentsIncludedIntheMatrix")]
        #[serde(rename = "componentsIncludedIntheMatrix")]
        pub components_included_inthe_matrix: MatrixIncludedComponents,
        pub matrix: LowerTriangularPositiveSemidefiniteMatrixColumns,
    }
    impl LowerTriangularPositiveSemidefiniteMatrix {
        pub fn new(
            components_included_inthe_matrix: MatrixIncludedComponents,
            matrix: LowerTriangularPositiveSemidefiniteMatrixColumns,
        ) -> Self {
            Self {
                components_included_inthe_matrix,
                matrix,
            }
        }
    }
    /// CDD LowerTriangularPositiveSemidefiniteMatrixColumns.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, size("1..=13", extensible))]
    pub struct LowerTriangularPositiveSemidefiniteMatrixColumns(pub SequenceOf<CorrelationColumn>);
    /// Where and when the sender perceived. TS 103 324 ManagementContainer.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct ManagementContainer {
        #[rasn(identifier = "referenceTime")]
        #[serde(rename = "referenceTime")]
        pub reference_time: TimestampIts,
        #[rasn(identifier = "referencePosition")]
        #[serde(rename = "referencePosition")]
        pub reference_position: ReferencePosition,
        #[rasn(identifier = "segmentationInfo")]
        #[serde(rename = "segmentationInfo")]
        pub segmentation_info: Option<MessageSegmentationInfo>,
        #[rasn(identifier = "messageRateRange")]
        #[serde(rename = "messageRateRange")]
        pub message_rate_range: Option<MessageRateRange>,
    }
    impl ManagementContainer {
        pub fn new(
            reference_time: TimestampIts,
            reference_position: ReferencePosition,
            segmentation_info: Option<MessageSegmentationInfo>,
            message_rate_range: Option<MessageRateRange>,
        ) -> Self {
            Self {
                reference_time,
                reference_position,
                segmentation_info,
                message_rate_range,
            }
        }
    }
    /// CDD MatrixIncludedComponents.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, size("13", extensible))]
    pub struct MatrixIncludedComponents(#[serde(with = "crate::asn1::view::bits")] pub BitString);
    /// mantissa times 10 to the exponent, in Hz. CDD MessageRateHz.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct MessageRateHz {
        #[rasn(value("1..=100"))]
        pub mantissa: u8,
        #[rasn(value("-5..=2"))]
        pub exponent: i8,
    }
    impl MessageRateHz {
        pub fn new(mantissa: u8, exponent: i8) -> Self {
            Self { mantissa, exponent }
        }
    }
    /// TS 103 324 MessageRateRange.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct MessageRateRange {
        #[rasn(identifier = "messageRateMin")]
        #[serde(rename = "messageRateMin")]
        pub message_rate_min: MessageRateHz,
        #[rasn(identifier = "messageRateMax")]
        #[serde(rename = "messageRateMax")]
        pub message_rate_max: MessageRateHz,
    }
    impl MessageRateRange {
        pub fn new(message_rate_min: MessageRateHz, message_rate_max: MessageRateHz) -> Self {
            Self {
                message_rate_min,
                message_rate_max,
            }
        }
    }
    /// CDD MessageSegmentationInfo.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct MessageSegmentationInfo {
        #[rasn(identifier = "totalMsgNo")]
        #[serde(rename = "totalMsgNo")]
        pub total_msg_no: CardinalNumber3b,
        #[rasn(identifier = "thisMsgNo")]
        #[serde(rename = "thisMsgNo")]
        pub this_msg_no: OrdinalNumber3b,
    }
    impl MessageSegmentationInfo {
        pub fn new(total_msg_no: CardinalNumber3b, this_msg_no: OrdinalNumber3b) -> Self {
            Self {
                total_msg_no,
                this_msg_no,
            }
        }
    }
    /// CDD ObjectClass. Of the vehicles only unknown, passengerCar to tram, and agricultural are meant,
    /// which takes as many bits as 0..14.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(choice, automatic_tags)]
    #[non_exhaustive]
    pub enum ObjectClass {
        #[rasn(value("0..=14"))]
        vehicleSubClass(TrafficParticipantType),
        vruSubClass(VruProfileAndSubprofile),
        groupSubClass(VruClusterInformation),
        otherSubClass(OtherSubClass),
    }
    /// Possible classes of an object. CDD ObjectClassDescription.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, size("1..=8"))]
    pub struct ObjectClassDescription(pub SequenceOf<ObjectClassWithConfidence>);
    /// CDD ObjectClassWithConfidence.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct ObjectClassWithConfidence {
        #[rasn(identifier = "objectClass")]
        #[serde(rename = "objectClass")]
        pub object_class: ObjectClass,
        pub confidence: ConfidenceLevel,
    }
    impl ObjectClassWithConfidence {
        pub fn new(object_class: ObjectClass, confidence: ConfidenceLevel) -> Self {
            Self {
                object_class,
                confidence,
            }
        }
    }
    /// Extent of an object. CDD ObjectDimension.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct ObjectDimension {
        pub value: ObjectDimensionValue,
        pub confidence: ObjectDimensionConfidence,
    }
    impl ObjectDimension {
        pub fn new(value: ObjectDimensionValue, confidence: ObjectDimensionConfidence) -> Self {
            Self { value, confidence }
        }
    }
    /// 0.1 m. CDD ObjectDimensionConfidence.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("1..=32"))]
    pub struct ObjectDimensionConfidence(pub u8);
    /// CDD ObjectPerceptionQuality.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=15"))]
    pub struct ObjectPerceptionQuality(pub u8);
    /// CDD OrdinalNumber3b.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("1..=8"))]
    pub struct OrdinalNumber3b(pub u8);
    /// TS 103 324 OriginatingRsuContainer.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct OriginatingRsuContainer {
        #[rasn(identifier = "mapReference")]
        #[serde(rename = "mapReference")]
        pub map_reference: Option<MapReference>,
    }
    impl OriginatingRsuContainer {
        pub fn new(map_reference: Option<MapReference>) -> Self {
            Self { map_reference }
        }
    }
    /// TS 103 324 OriginatingVehicleContainer.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct OriginatingVehicleContainer {
        #[rasn(identifier = "orientationAngle")]
        #[serde(rename = "orientationAngle")]
        pub orientation_angle: Wgs84Angle,
        #[rasn(identifier = "pitchAngle")]
        #[serde(rename = "pitchAngle")]
        pub pitch_angle: Option<CartesianAngle>,
        #[rasn(identifier = "rollAngle")]
        #[serde(rename = "rollAngle")]
        pub roll_angle: Option<CartesianAngle>,
        #[rasn(identifier = "trailerDataSet")]
        #[serde(rename = "trailerDataSet")]
        pub trailer_data_set: Option<TrailerDataSet>,
    }
    impl OriginatingVehicleContainer {
        pub fn new(
            orientation_angle: Wgs84Angle,
            pitch_angle: Option<CartesianAngle>,
            roll_angle: Option<CartesianAngle>,
            trailer_data_set: Option<TrailerDataSet>,
        ) -> Self {
            Self {
                orientation_angle,
                pitch_angle,
                roll_angle,
                trailer_data_set,
            }
        }
    }
    /// CDD OtherSubClass.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=255"))]
    pub struct OtherSubClass(pub u8);
    /// An object, relative to the reference position: x to the east, y to the north, z up. CDD
    /// PerceivedObject.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct PerceivedObject {
        #[rasn(identifier = "objectId")]
        #[serde(rename = "objectId")]
        pub object_id: Option<Identifier2B>,
        #[rasn(identifier = "measurementDeltaTime")]
        #[serde(rename = "measurementDeltaTime")]
        pub measurement_delta_time: DeltaTimeMilliSecondSigned,
        pub position: CartesianPosition3dWithConfidence,
        pub velocity: Option<Velocity3dWithConfidence>,
        pub acceleration: Option<Acceleration3dWithConfidence>,
        pub angles: Option<EulerAnglesWithConfidence>,
        #[rasn(identifier = "zAngularVelocity")]
        #[serde(rename = "zAngularVelocity")]
        pub z_angular_velocity: Option<CartesianAngularVelocityComponent>,
        #[rasn(identifier = "lowerTriangularCorrelationMatrices")]
        #[serde(rename = "lowerTriangularCorrelationMatrices")]
        pub lower_triangular_correlation_matrices:
            Option<LowerTriangularPositiveSemidefiniteMatrices>,
        #[rasn(identifier = "objectDimensionZ")]
        #[serde(rename = "objectDimensionZ")]
        pub object_dimension_z: Option<ObjectDimension>,
        #[rasn(identifier = "objectDimensionY")]
        #[serde(rename = "objectDimensionY")]
        pub object_dimension_y: Option<ObjectDimension>,
        #[rasn(identifier = "objectDimensionX")]
        #[serde(rename = "objectDimensionX")]
        pub object_dimension_x: Option<ObjectDimension>,
        #[rasn(value("0..=2047"), identifier = "objectAge")]
        #[serde(rename = "objectAge")]
        pub object_age: Option<DeltaTimeMilliSecondSigned>,
        #[rasn(identifier = "objectPerceptionQuality")]
        #[serde(rename = "objectPerceptionQuality")]
        pub object_perception_quality: Option<ObjectPerceptionQuality>,
        #[rasn(identifier = "sensorIdList")]
        #[serde(rename = "sensorIdList")]
        pub sensor_id_list: Option<SequenceOfIdentifier1B>,
        pub classification: Option<ObjectClassDescription>,
        #[rasn(identifier = "mapPosition")]
        #[serde(rename = "mapPosition")]
        pub map_position: Option<MapPosition>,
    }
    impl PerceivedObject {
        pub fn new(
            object_id: Option<Identifier2B>,
            measurement_delta_time: DeltaTimeMilliSecondSigned,
            position: CartesianPosition3dWithConfidence,
            velocity: Option<Velocity3dWithConfidence>,
            acceleration: Option<Acceleration3dWithConfidence>,
            angles: Option<EulerAnglesWithConfidence>,
            z_angular_velocity: Option<CartesianAngularVelocityComponent>,
            lower_triangular_correlation_matrices: Option<
                LowerTriangularPositiveSemidefiniteMatrices,
            >,
            object_dimension_z: Option<ObjectDimension>,
            object_dimension_y: Option<ObjectDimension>,
            object_dimension_x: Option<ObjectDimension>,
            object_age: Option<DeltaTimeMilliSecondSigned>,
            object_perception_quality: Option<ObjectPerceptionQuality>,
            sensor_id_list: Option<SequenceOfIdentifier1B>,
            classification: Option<ObjectClassDescription>,
            map_position: Option<MapPosition>,
        ) -> Self {
            Self {
                object_id,
                measurement_delta_time,
                position,
                velocity,
                acceleration,
                angles,
                z_angular_velocity,
                lower_triangular_correlation_matrices,
                object_dimension_z,
                object_dimension_y,
                object_dimension_x,
                object_age,
                object_perception_quality,
                sensor_id_list,
                classification,
                map_position,
            }
        }
    }
    /// TS 103 324 PerceivedObjectContainer.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct PerceivedObjectContainer {
        #[rasn(identifier = "numberOfPerceivedObjects")]
        #[serde(rename = "numberOfPerceivedObjects")]
        pub number_of_perceived_objects: CardinalNumber1B,
        #[rasn(identifier = "perceivedObjects")]
        #[serde(rename = "perceivedObjects")]
        pub perceived_objects: PerceivedObjects,
    }
    impl PerceivedObjectContainer {
        pub fn new(
            number_of_perceived_objects: CardinalNumber1B,
            perceived_objects: PerceivedObjects,
        ) -> Self {
            Self {
                number_of_perceived_objects,
                perceived_objects,
            }
        }
    }
    /// TS 103 324 PerceivedObjectIds.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, size("0..=255", extensible))]
    pub struct PerceivedObjectIds(pub SequenceOf<Identifier2B>);
    /// TS 103 324 PerceivedObjects.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, size("0..=255", extensible))]
    pub struct PerceivedObjects(pub SequenceOf<PerceivedObject>);
    /// Where the sender sees how well. TS 103 324 PerceptionRegion.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct PerceptionRegion {
        #[rasn(identifier = "measurementDeltaTime")]
        #[serde(rename = "measurementDeltaTime")]
        pub measurement_delta_time: DeltaTimeMilliSecondSigned,
        #[rasn(identifier = "perceptionRegionConfidence")]
        #[serde(rename = "perceptionRegionConfidence")]
        pub perception_region_confidence: ConfidenceLevel,
        #[rasn(identifier = "perceptionRegionShape")]
        #[serde(rename = "perceptionRegionShape")]
        pub perception_region_shape: Shape,
        #[rasn(identifier = "shadowingApplies")]
        #[serde(rename = "shadowingApplies")]
        pub shadowing_applies: bool,
        #[rasn(identifier = "sensorIdList")]
        #[serde(rename = "sensorIdList")]
        pub sensor_id_list: Option<SequenceOfIdentifier1B>,
        #[rasn(identifier = "numberOfPerceivedObjects")]
        #[serde(rename = "numberOfPerceivedObjects")]
        pub number_of_perceived_objects: Option<CardinalNumber1B>,
        #[rasn(identifier = "perceivedObjectIds")]
        #[serde(rename = "perceivedObjectIds")]
        pub perceived_object_ids: Option<PerceivedObjectIds>,
    }
    impl PerceptionRegion {
        pub fn new(
            measurement_delta_time: DeltaTimeMilliSecondSigned,
            perception_region_confidence: ConfidenceLevel,
            perception_region_shape: Shape,
            shadowing_applies: bool,
            sensor_id_list: Option<SequenceOfIdentifier1B>,
            number_of_perceived_objects: Option<CardinalNumber1B>,
            perceived_object_ids: Option<PerceivedObjectIds>,
        ) -> Self {
            Self {
                measurement_delta_time,
                perception_region_confidence,
                perception_region_shape,
                shadowing_applies,
                sensor_id_list,
                number_of_perceived_objects,
                perceived_object_ids,
            }
        }
    }
    /// TS 103 324 PerceptionRegionContainer.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, size("1..=256", extensible))]
    pub struct PerceptionRegionContainer(pub SequenceOf<PerceptionRegion>);
    /// Position with confidence under its older field names. CDD ReferencePosition.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct ReferencePosition {
        pub latitude: Latitude,
        pub longitude: Longitude,
        #[rasn(identifier = "positionConfidenceEllipse")]
        #[serde(rename = "positionConfidenceEllipse")]
        pub position_confidence_ellipse: PosConfidenceEllipse,
        pub altitude: Altitude,
    }
    impl ReferencePosition {
        pub fn new(
            latitude: Latitude,
            longitude: Longitude,
            position_confidence_ellipse: PosConfidenceEllipse,
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
    /// A sensor of the sender. TS 103 324 SensorInformation.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct SensorInformation {
        #[rasn(identifier = "sensorId")]
        #[serde(rename = "sensorId")]
        pub sensor_id: Identifier1B,
        #[rasn(identifier = "sensorType")]
        #[serde(rename = "sensorType")]
        pub sensor_type: SensorType,
        #[rasn(identifier = "perceptionRegionShape")]
        #[serde(rename = "perceptionRegionShape")]
        pub perception_region_shape: Option<Shape>,
        #[rasn(identifier = "perceptionRegionConfidence")]
        #[serde(rename = "perceptionRegionConfidence")]
        pub perception_region_confidence: Option<ConfidenceLevel>,
        #[rasn(identifier = "shadowingApplies")]
        #[serde(rename = "shadowingApplies")]
        pub shadowing_applies: bool,
    }
    impl SensorInformation {
        pub fn new(
            sensor_id: Identifier1B,
            sensor_type: SensorType,
            perception_region_shape: Option<Shape>,
            perception_region_confidence: Option<ConfidenceLevel>,
            shadowing_applies: bool,
        ) -> Self {
            Self {
                sensor_id,
                sensor_type,
                perception_region_shape,
                perception_region_confidence,
                shadowing_applies,
            }
        }
    }
    /// TS 103 324 SensorInformationContainer.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, size("1..=128", extensible))]
    pub struct SensorInformationContainer(pub SequenceOf<SensorInformation>);
    /// CDD SensorType.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=31"))]
    pub struct SensorType(pub u8);
    /// CDD SequenceOfIdentifier1B.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, size("1..=128", extensible))]
    pub struct SequenceOfIdentifier1B(pub SequenceOf<Identifier1B>);
    /// 0.1 m. CDD StandardLength1B.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("0..=255"))]
    pub struct StandardLength1B(pub u8);
    /// A trailer of the sender. CDD TrailerData.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct TrailerData {
        #[rasn(identifier = "refPointId")]
        #[serde(rename = "refPointId")]
        pub ref_point_id: Identifier1B,
        #[rasn(identifier = "hitchPointOffset")]
        #[serde(rename = "hitchPointOffset")]
        pub hitch_point_offset: StandardLength1B,
        #[rasn(identifier = "frontOverhang")]
        #[serde(rename = "frontOverhang")]
        pub front_overhang: Option<StandardLength1B>,
        #[rasn(identifier = "rearOverhang")]
        #[serde(rename = "rearOverhang")]
        pub rear_overhang: Option<StandardLength1B>,
        #[rasn(identifier = "trailerWidth")]
        #[serde(rename = "trailerWidth")]
        pub trailer_width: Option<VehicleWidth>,
        #[rasn(identifier = "hitchAngle")]
        #[serde(rename = "hitchAngle")]
        pub hitch_angle: CartesianAngle,
    }
    impl TrailerData {
        pub fn new(
            ref_point_id: Identifier1B,
            hitch_point_offset: StandardLength1B,
            front_overhang: Option<StandardLength1B>,
            rear_overhang: Option<StandardLength1B>,
            trailer_width: Option<VehicleWidth>,
            hitch_angle: CartesianAngle,
        ) -> Self {
            Self {
                ref_point_id,
                hitch_point_offset,
                front_overhang,
                rear_overhang,
                trailer_width,
                hitch_angle,
            }
        }
    }
    /// TS 103 324 TrailerDataSet.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, size("1..=8", extensible))]
    pub struct TrailerDataSet(pub SequenceOf<TrailerData>);
    /// CDD Velocity3dWithConfidence.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(choice, automatic_tags)]
    pub enum Velocity3dWithConfidence {
        polarVelocity(VelocityPolarWithZ),
        cartesianVelocity(VelocityCartesian),
    }
    /// CDD VelocityCartesian.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct VelocityCartesian {
        #[rasn(identifier = "xVelocity")]
        #[serde(rename = "xVelocity")]
        pub x_velocity: VelocityComponent,
        #[rasn(identifier = "yVelocity")]
        #[serde(rename = "yVelocity")]
        pub y_velocity: VelocityComponent,
        #[rasn(identifier = "zVelocity")]
        #[serde(rename = "zVelocity")]
        pub z_velocity: Option<VelocityComponent>,
    }
    impl VelocityCartesian {
        pub fn new(
            x_velocity: VelocityComponent,
            y_velocity: VelocityComponent,
            z_velocity: Option<VelocityComponent>,
        ) -> Self {
            Self {
                x_velocity,
                y_velocity,
                z_velocity,
            }
        }
    }
    /// CDD VelocityComponent.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct VelocityComponent {
        pub value: VelocityComponentValue,
        pub confidence: SpeedConfidence,
    }
    impl VelocityComponent {
        pub fn new(value: VelocityComponentValue, confidence: SpeedConfidence) -> Self {
            Self { value, confidence }
        }
    }
    /// 0.01 m/s. CDD VelocityComponentValue.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("-16383..=16383"))]
    pub struct VelocityComponentValue(pub i16);
    /// CDD VelocityPolarWithZ.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct VelocityPolarWithZ {
        #[rasn(identifier = "velocityMagnitude")]
        #[serde(rename = "velocityMagnitude")]
        pub velocity_magnitude: Speed,
        #[rasn(identifier = "velocityDirection")]
        #[serde(rename = "velocityDirection")]
        pub velocity_direction: CartesianAngle,
        #[rasn(identifier = "zVelocity")]
        #[serde(rename = "zVelocity")]
        pub z_velocity: Option<VelocityComponent>,
    }
    impl VelocityPolarWithZ {
        pub fn new(
            velocity_magnitude: Speed,
            velocity_direction: CartesianAngle,
            z_velocity: Option<VelocityComponent>,
        ) -> Self {
            Self {
                velocity_magnitude,
                velocity_direction,
                z_velocity,
            }
        }
    }
    /// A container and its number. TS 103 324 WrappedCpmContainer.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct WrappedCpmContainer {
        #[rasn(identifier = "containerId")]
        #[serde(rename = "containerId")]
        pub container_id: CpmContainerId,
        #[rasn(identifier = "containerData")]
        #[serde(rename = "containerData")]
        pub container_data: CpmContainerData,
    }
    impl WrappedCpmContainer {
        pub fn new(container_id: CpmContainerId, container_data: CpmContainerData) -> Self {
            Self {
                container_id,
                container_data,
            }
        }
    }
    /// TS 103 324 WrappedCpmContainers.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, size("1..=8", extensible))]
    pub struct WrappedCpmContainers(pub SequenceOf<WrappedCpmContainer>);
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
    /// How far a robot is with its task. executing: on the way; inPosition: it holds the place from which
    /// it guards; safeIdle: it stopped because it lost contact with its leader.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    #[non_exhaustive]
    pub enum TaskProgression {
        idle = 0,
        executing = 1,
        inPosition = 2,
        completed = 3,
        failed = 4,
        safeIdle = 5,
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
        GenerationDeltaTime, ItsPduHeader, MapReference, ObjectDimensionValue, PathPoint, Speed,
        StationId, Wgs84Angle, YawRate,
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
    /// The maneuver runs while it is executing or inPosition: the robot is on the way, or it holds the
    /// place from which it guards. Every other progress is final for its command.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(choice, automatic_tags)]
    #[non_exhaustive]
    pub enum CommandProgress {
        executing(()),
        inPosition(()),
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
    /// Control over the robot.
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
    /// Crossing of a request and its session, named like an IntersectionReferenceID of ISO/TS 19091: the
    /// authority that numbers intersections, and the intersection. Where it is absent the crossing is not
    /// known and may be any. 0:0 is never present.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct CrossingReference {
        #[rasn(value("0..=65535"))]
        pub regulator: u16,
        #[rasn(value("0..=65535"))]
        pub intersection: u16,
    }
    impl CrossingReference {
        pub fn new(regulator: u16, intersection: u16) -> Self {
            Self {
                regulator,
                intersection,
            }
        }
    }
    /// The sender's own session of this number, and how it ended.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct EndedSession {
        #[rasn(identifier = "sessionNumber")]
        #[serde(rename = "sessionNumber")]
        pub session_number: SessionNumber,
        pub ending: SessionEnding,
    }
    impl EndedSession {
        pub fn new(session_number: SessionNumber, ending: SessionEnding) -> Self {
            Self {
                session_number,
                ending,
            }
        }
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
    /// Number that grows by one for every RAM period of a session, from its request on: a serial number
    /// modulo 65536.
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
    /// Offers to join the session of a requester, with the tasks that it can do of those asked for and the
    /// newest heartbeat of the request that it heard. safetyTimeout is the time without a heartbeat after
    /// which it falls back; a requester whose lease is too long for it does not take the offer.
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
        #[rasn(identifier = "heartbeatEcho")]
        #[serde(rename = "heartbeatEcho")]
        pub heartbeat_echo: Heartbeat,
        #[rasn(identifier = "safetyTimeout")]
        #[serde(rename = "safetyTimeout")]
        pub safety_timeout: SafetyTimeout,
    }
    impl HelperRole {
        pub fn new(
            session: CoordinationSession,
            offer_number: OfferNumber,
            capabilities: TaskSet,
            heartbeat_echo: Heartbeat,
            safety_timeout: SafetyTimeout,
        ) -> Self {
            Self {
                session,
                offer_number,
                capabilities,
                heartbeat_echo,
                safety_timeout,
            }
        }
    }
    /// Leads a session. A robot that is not among the followers has no part in it. urgency and crossing
    /// are those of the request; yields is TRUE once it has given the crossing up to another leader and
    /// lets nobody cross any more.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct LeaderRole {
        pub session: CoordinationSession,
        pub heartbeat: Heartbeat,
        pub urgency: RequestUrgency,
        pub crossing: Option<CrossingReference>,
        pub yields: bool,
        #[rasn(size("1..=16"))]
        pub followers: SequenceOf<ConfirmedFollower>,
    }
    impl LeaderRole {
        pub fn new(
            session: CoordinationSession,
            heartbeat: Heartbeat,
            urgency: RequestUrgency,
            crossing: Option<CrossingReference>,
            yields: bool,
            followers: SequenceOf<ConfirmedFollower>,
        ) -> Self {
            Self {
                session,
                heartbeat,
                urgency,
                crossing,
                yields,
                followers,
            }
        }
    }
    /// Another station's session, in which the sender has no part any more by this offer or an earlier
    /// one. A later offer stands.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    pub struct LeftSession {
        pub session: CoordinationSession,
        #[rasn(identifier = "offerNumber")]
        #[serde(rename = "offerNumber")]
        pub offer_number: OfferNumber,
    }
    impl LeftSession {
        pub fn new(session: CoordinationSession, offer_number: OfferNumber) -> Self {
            Self {
                session,
                offer_number,
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
    /// Has opened a session and asks for followers that can do these tasks. A request whose heartbeat
    /// does not grow does not stand any more.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(automatic_tags)]
    #[non_exhaustive]
    pub struct RequesterRole {
        pub session: CoordinationSession,
        pub heartbeat: Heartbeat,
        pub urgency: RequestUrgency,
        pub crossing: Option<CrossingReference>,
        #[rasn(value("1..=16"), identifier = "followerCount")]
        #[serde(rename = "followerCount")]
        pub follower_count: u8,
        #[rasn(identifier = "requestedTasks")]
        #[serde(rename = "requestedTasks")]
        pub requested_tasks: TaskSet,
    }
    impl RequesterRole {
        pub fn new(
            session: CoordinationSession,
            heartbeat: Heartbeat,
            urgency: RequestUrgency,
            crossing: Option<CrossingReference>,
            follower_count: u8,
            requested_tasks: TaskSet,
        ) -> Self {
            Self {
                session,
                heartbeat,
                urgency,
                crossing,
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
    /// Abilities of the robot besides maneuvers. Bits without a name are zero and ignored.
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
    /// Quick part of the state: the motion, and the size, which changes with the posture. Heading is the
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
    /// Slow part of the state. areaServed is the road segment or intersection that the robot serves.
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
        #[rasn(identifier = "areaServed")]
        #[serde(rename = "areaServed")]
        pub area_served: Option<MapReference>,
    }
    impl RobotLowFrequencyContainer {
        pub fn new(
            capabilities: RobotCapabilities,
            supported_tasks: TaskSet,
            path_history: SequenceOf<PathPoint>,
            exterior_lights: Option<ExteriorLights>,
            signals_shown: Option<SignalsShown>,
            area_served: Option<MapReference>,
        ) -> Self {
            Self {
                capabilities,
                supported_tasks,
                path_history,
                exterior_lights,
                signals_shown,
                area_served,
            }
        }
    }
    /// Kind and condition of the robot. unavailability is present while the robot takes no part in
    /// coordination. onDuty is TRUE while the robot still has a duty on the road from a maneuver or
    /// session that ended early: until the road is clear it offers no help and takes no command.
    /// helpStatus goes with the operation container: needHelp with a requester, offerHelp with a helper,
    /// roleConfirmed with a leader or a follower, none with none of these.
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
        #[rasn(identifier = "onDuty")]
        #[serde(rename = "onDuty")]
        pub on_duty: bool,
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
            on_duty: bool,
        ) -> Self {
            Self {
                robot_category,
                operational_job_role,
                task_progression,
                battery_status,
                control_mode,
                help_status,
                unavailability,
                on_duty,
            }
        }
    }
    /// 1 ms, up to one day.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(delegate, value("1..=86400000"))]
    pub struct SafetyTimeout(pub u32);
    /// completed: the crossing is completed and the road is clear, followers are free. aborted: any other
    /// end; people may be on the road, so followers fall back.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize, Copy,
    )]
    #[rasn(enumerated)]
    pub enum SessionEnding {
        completed = 0,
        aborted = 1,
    }
    /// Names a session as over: the sender's own has ended, or it has left that of another station.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(choice, automatic_tags)]
    #[non_exhaustive]
    pub enum SessionFarewell {
        ended(EndedSession),
        left(LeftSession),
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
    /// Signals of the robot to the people around it, and their means.
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
        #[rasn(size("1..=16"))]
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
    /// Limits for the follower while it executes the maneuver.
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
    /// Part of the sender in the session.
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
    /// Why a command is rejected: the robot cannot do such a task, it is unavailable, or it has a duty on
    /// the road from a maneuver or session that ended early.
    #[derive(
        AsnType, Clone, Debug, Decode, Encode, PartialEq, Eq, Hash, Serialize, Deserialize,
    )]
    #[rasn(choice, automatic_tags)]
    #[non_exhaustive]
    pub enum RejectionReason {
        unsupportedTask(()),
        unavailable(UnavailabilityReason),
        onDuty(()),
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
    /// Quick part of the state. TS 103 300-3 VruHighFrequencyContainer.
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
    /// Slow part of the state. TS 103 300-3 VruLowFrequencyContainer.
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
