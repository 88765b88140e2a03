//! What a command and an answer say to the application, beyond what the protocol reads.

use crossguard_protocol::{Millis, StationId};
use serde::{Deserialize, Serialize};

use crate::asn1::cdd::{
    AltitudeValue, DeltaAltitude, DeltaLatitude, DeltaLongitude, DeltaReferencePosition,
    GeoPosition, Identifier2B, IntersectionReferenceId, LanePosition, Latitude, Longitude,
    MapReference, RoadSegmentReferenceId, SpeedValue, StandardLength9b, Wgs84AngleValue,
};
use crate::asn1::rmcm::{ManeuverCommand, ManeuverConstraints, ManeuverDuration, ManeuverTarget};
use crate::error::ViewError;
use crate::si;
use crate::state::TaskProgression;

/// Parameters of a command. What is `None` is left to the follower.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TaskParameters {
    /// Where the maneuver leads.
    pub target: Option<Target>,
    /// Which way to face at the target, in degrees clockwise from north; for a block, the direction
    /// of the traffic that is held back.
    pub heading: Option<f64>,
    /// Largest speed in m/s; one above 163.81 m/s limits nothing.
    pub maximum_speed: Option<f64>,
    /// Smallest distance to the pedestrian in metres, 51.1 at most.
    pub minimum_pedestrian_distance: Option<f64>,
    /// How long the command may be executed, from the generation of the message; at most one day.
    pub validity: Option<Millis>,
}

/// Where a maneuver leads.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Target {
    /// To a position.
    Position {
        /// In degrees, north positive.
        latitude: f64,
        /// In degrees, east positive.
        longitude: f64,
        /// In metres above the WGS84 ellipsoid.
        altitude: Option<f64>,
    },
    /// To a position relative to the leader's, at most 0.0131071 degrees away.
    Offset {
        /// In degrees, to the north positive.
        latitude: f64,
        /// In degrees, to the east positive.
        longitude: f64,
        /// In metres, upwards positive.
        altitude: Option<f64>,
    },
    /// To a lane: -1 off the road, 0 the inner hard shoulder, 1..13 the lanes from the inside of the
    /// road to its outside, 14 the outer hard shoulder.
    Lane(i8),
}

/// Where the maneuvers of a session take place, by reference to a map (MAPEM).
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum MapPlace {
    /// On a road segment.
    RoadSegment {
        /// The region in which its number is unique.
        region: Option<u16>,
        /// Its number.
        id: u16,
    },
    /// At an intersection.
    Intersection {
        /// The region in which its number is unique.
        region: Option<u16>,
        /// Its number.
        id: u16,
    },
}

/// How far a follower is with the command that it answers.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ExecutionStatus {
    /// How far it is.
    pub progression: TaskProgression,
    /// How long it will take yet; at most one day.
    pub time_to_completion: Option<Millis>,
}

/// At most one day.
pub(super) fn duration(duration: Millis) -> ManeuverDuration {
    ManeuverDuration(duration.0.min(Millis::MAX_TIMER.0))
}

impl Target {
    /// The target on the wire, `None` when it cannot be expressed: a target that is not a place must
    /// not become an unavailable one.
    fn to_wire(self) -> Option<ManeuverTarget> {
        match self {
            Self::Position {
                latitude,
                longitude,
                altitude,
            } => {
                let latitude = si::LATITUDE.encode(Some(latitude));
                let longitude = si::longitude(Some(longitude));
                let is_place =
                    latitude != si::LATITUDE.unavailable && longitude != si::longitude(None);
                let altitude = AltitudeValue(si::ALTITUDE.encode(altitude));
                is_place.then(|| {
                    let position =
                        GeoPosition::new(Latitude(latitude), Longitude(longitude), altitude);
                    ManeuverTarget::position(position)
                })
            }
            Self::Offset {
                latitude,
                longitude,
                altitude,
            } => {
                let north = si::DELTA_DEGREES.encode(Some(latitude));
                let east = si::DELTA_DEGREES.encode(Some(longitude));
                let unavailable = si::DELTA_DEGREES.unavailable;
                let altitude = DeltaAltitude(si::DELTA_ALTITUDE.encode(altitude));
                (north != unavailable && east != unavailable).then(|| {
                    ManeuverTarget::offset(DeltaReferencePosition::new(
                        DeltaLatitude(north),
                        DeltaLongitude(east),
                        altitude,
                    ))
                })
            }
            Self::Lane(lane) => (-1..=14)
                .contains(&lane)
                .then_some(ManeuverTarget::lanePosition(LanePosition(lane))),
        }
    }

    /// `None` for a target whose latitude or longitude is unavailable.
    fn from_wire(target: &ManeuverTarget) -> Option<Self> {
        Some(match target {
            ManeuverTarget::position(position) => Self::Position {
                latitude: si::LATITUDE.decode(position.latitude.0)?,
                longitude: si::longitude_degrees(position.longitude.0)?,
                altitude: si::ALTITUDE.decode(position.altitude.0),
            },
            ManeuverTarget::offset(offset) => Self::Offset {
                latitude: si::DELTA_DEGREES.decode(offset.delta_latitude.0)?,
                longitude: si::DELTA_DEGREES.decode(offset.delta_longitude.0)?,
                altitude: si::DELTA_ALTITUDE.decode(offset.delta_altitude.0),
            },
            ManeuverTarget::lanePosition(lane) => Self::Lane(lane.0),
        })
    }
}

impl TaskParameters {
    /// Adds the parameters to the command for `follower`.
    pub(super) fn write(
        &self,
        command: &mut ManeuverCommand,
        follower: StationId,
    ) -> Result<(), ViewError> {
        let target = self
            .target
            .map(|target| target.to_wire().ok_or(ViewError::Target(follower)));
        command.target = target.transpose()?;
        command.target_heading = self
            .heading
            .map(|heading| Wgs84AngleValue(si::angle(Some(heading))));
        let speed = self
            .maximum_speed
            .map(|speed| SpeedValue(si::MAXIMUM_SPEED.encode(Some(speed))));
        let distance = self
            .minimum_pedestrian_distance
            .and_then(|distance| si::MINIMUM_DISTANCE.encode(distance).map(StandardLength9b));
        let is_constrained = speed.is_some() || distance.is_some();
        command.constraints = is_constrained.then(|| ManeuverConstraints::new(speed, distance));
        command.validity_duration = self.validity.map(duration);
        Ok(())
    }

    /// The parameters of a command.
    pub(super) fn read(command: &ManeuverCommand) -> Self {
        let constraints = command.constraints.as_ref();
        let speed = constraints.and_then(|constraints| constraints.maximum_speed.as_ref());
        let distance =
            constraints.and_then(|constraints| constraints.minimum_pedestrian_distance.as_ref());
        Self {
            target: command.target.as_ref().and_then(Target::from_wire),
            heading: command
                .target_heading
                .as_ref()
                .and_then(|angle| si::angle_degrees(angle.0)),
            maximum_speed: speed.and_then(|speed| si::MAXIMUM_SPEED.decode(speed.0)),
            minimum_pedestrian_distance: distance
                .map(|metres| si::MINIMUM_DISTANCE.decode(metres.0)),
            validity: command
                .validity_duration
                .as_ref()
                .map(|duration| Millis(duration.0)),
        }
    }
}

impl MapPlace {
    pub(super) fn to_wire(self) -> MapReference {
        match self {
            Self::RoadSegment { region, id } => MapReference::roadsegment(
                RoadSegmentReferenceId::new(region.map(Identifier2B), Identifier2B(id)),
            ),
            Self::Intersection { region, id } => MapReference::intersection(
                IntersectionReferenceId::new(region.map(Identifier2B), Identifier2B(id)),
            ),
        }
    }

    pub(super) fn from_wire(reference: &MapReference) -> Self {
        match reference {
            MapReference::roadsegment(segment) => Self::RoadSegment {
                region: segment.region.as_ref().map(|region| region.0),
                id: segment.id.0,
            },
            MapReference::intersection(intersection) => Self::Intersection {
                region: intersection.region.as_ref().map(|region| region.0),
                id: intersection.id.0,
            },
        }
    }
}
