//! Parts of commands and answers for the application, which the protocol does not read.

use ::core::fmt;
use ::core::str::FromStr;

use crossguard_protocol::{Millis, StationId};
use serde::{Deserialize, Serialize};

use crate::core::cdd::{
    AltitudeValue, DeltaAltitude, DeltaLatitude, DeltaLongitude, DeltaReferencePosition,
    GeoPosition, Identifier2B, IntersectionReferenceId, LanePosition, Latitude, Longitude,
    MapReference, RoadSegmentReferenceId, SpeedValue, StandardLength9b, Wgs84AngleValue,
};
use crate::core::rmcm::{ManeuverCommand, ManeuverConstraints, ManeuverDuration, ManeuverTarget};
use crate::error::ViewError;
use crate::si;
use crate::state::TaskProgression;

/// Parameters of a command. What is `None` is left to the follower.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
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
    /// The road segment or intersection where the maneuver takes place; all commands of a message name the
    /// same. The protocol decides nothing by it.
    pub map_place: Option<MapPlace>,
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

/// Where maneuvers take place, or what a robot is there for, by reference to a map (MAPEM).
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

impl fmt::Display for MapPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (kind, region, id) = match *self {
            Self::RoadSegment { region, id } => ("segment", region, id),
            Self::Intersection { region, id } => ("intersection", region, id),
        };
        match region {
            Some(region) => write!(f, "{kind} {region}:{id}"),
            None => write!(f, "{kind} {id}"),
        }
    }
}

/// A text that names no place of a map.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[error(
    "no place of a map: a road segment or intersection is wanted, with its region if it has one and numbers \
     from 0 to 65535, like 'segment 276:12' or 'intersection 4711'"
)]
pub struct NoMapPlace;

impl FromStr for MapPlace {
    type Err = NoMapPlace;

    /// As it is displayed.
    fn from_str(text: &str) -> Result<Self, NoMapPlace> {
        let number = |text: &str| text.parse::<u16>().map_err(|_| NoMapPlace);
        let (kind, reference) = text.split_once(' ').ok_or(NoMapPlace)?;
        let (region, id) = match reference.split_once(':') {
            Some((region, id)) => (Some(number(region)?), number(id)?),
            None => (None, number(reference)?),
        };
        match kind {
            "segment" => Ok(Self::RoadSegment { region, id }),
            "intersection" => Ok(Self::Intersection { region, id }),
            _ => Err(NoMapPlace),
        }
    }
}

/// How far a follower is with the command that it answers.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct ExecutionStatus {
    /// How far it is.
    pub progression: TaskProgression,
    /// How long it will take yet; at most one day.
    pub time_to_completion: Option<Millis>,
}

const _: () = assert!(ManeuverDuration::MAX == Millis::MAX_TIMER.0);

/// At most one day.
pub(super) fn duration(duration: Millis) -> ManeuverDuration {
    ManeuverDuration::saturating(duration.0)
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
                is_place.then(|| {
                    ManeuverTarget::Position(GeoPosition {
                        latitude: Latitude::saturating(latitude),
                        longitude: Longitude::saturating(longitude),
                        altitude: AltitudeValue::saturating(si::ALTITUDE.encode(altitude)),
                    })
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
                let rise = si::DELTA_ALTITUDE.encode(altitude);
                (north != unavailable && east != unavailable).then(|| {
                    ManeuverTarget::Offset(DeltaReferencePosition {
                        delta_latitude: DeltaLatitude::saturating(north),
                        delta_longitude: DeltaLongitude::saturating(east),
                        delta_altitude: DeltaAltitude::saturating(rise),
                    })
                })
            }
            Self::Lane(lane) => LanePosition::new(lane).map(ManeuverTarget::LanePosition),
        }
    }

    /// `None` for a target whose latitude or longitude is unavailable.
    fn from_wire(target: ManeuverTarget) -> Option<Self> {
        Some(match target {
            ManeuverTarget::Position(position) => Self::Position {
                latitude: si::LATITUDE.decode(position.latitude.get())?,
                longitude: si::longitude_degrees(position.longitude.get())?,
                altitude: si::ALTITUDE.decode(position.altitude.get()),
            },
            ManeuverTarget::Offset(offset) => Self::Offset {
                latitude: si::DELTA_DEGREES.decode(offset.delta_latitude.get())?,
                longitude: si::DELTA_DEGREES.decode(offset.delta_longitude.get())?,
                altitude: si::DELTA_ALTITUDE.decode(offset.delta_altitude.get()),
            },
            ManeuverTarget::LanePosition(lane) => Self::Lane(lane.get()),
        })
    }
}

impl TaskParameters {
    /// The `command` for `follower` with these parameters.
    pub(super) fn write(
        &self,
        command: ManeuverCommand,
        follower: StationId,
    ) -> Result<ManeuverCommand, ViewError> {
        let target = self
            .target
            .map(|target| target.to_wire().ok_or(ViewError::Target(follower)));
        let heading = self.heading.map(|heading| si::angle(Some(heading)));
        let speed = self
            .maximum_speed
            .map(|speed| si::MAXIMUM_SPEED.encode(Some(speed)));
        let distance = self
            .minimum_pedestrian_distance
            .and_then(|distance| si::MINIMUM_DISTANCE.encode(distance));
        let is_constrained = speed.is_some() || distance.is_some();
        Ok(ManeuverCommand {
            target: target.transpose()?,
            target_heading: heading.map(Wgs84AngleValue::saturating),
            constraints: is_constrained.then(|| ManeuverConstraints {
                maximum_speed: speed.map(SpeedValue::saturating),
                minimum_pedestrian_distance: distance.map(StandardLength9b::saturating),
            }),
            validity_duration: self.validity.map(duration),
            ..command
        })
    }

    /// The parameters of a command in a message about this place.
    pub(super) fn read(command: &ManeuverCommand, map_place: Option<MapPlace>) -> Self {
        let constraints = command.constraints;
        let speed = constraints.and_then(|constraints| constraints.maximum_speed);
        let distance = constraints.and_then(|constraints| constraints.minimum_pedestrian_distance);
        let heading = command.target_heading;
        let validity = command.validity_duration;
        Self {
            target: command.target.and_then(Target::from_wire),
            heading: heading.and_then(|angle| si::angle_degrees(angle.get())),
            maximum_speed: speed.and_then(|speed| si::MAXIMUM_SPEED.decode(speed.get())),
            minimum_pedestrian_distance: distance
                .map(|metres| si::MINIMUM_DISTANCE.decode(metres.get())),
            validity: validity.map(|duration| Millis(duration.get())),
            map_place,
        }
    }
}

impl MapPlace {
    pub(crate) fn to_wire(self) -> MapReference {
        match self {
            Self::RoadSegment { region, id } => MapReference::Roadsegment(RoadSegmentReferenceId {
                region: region.map(Identifier2B),
                id: Identifier2B(id),
            }),
            Self::Intersection { region, id } => {
                MapReference::Intersection(IntersectionReferenceId {
                    region: region.map(Identifier2B),
                    id: Identifier2B(id),
                })
            }
        }
    }

    pub(crate) fn from_wire(reference: MapReference) -> Self {
        match reference {
            MapReference::Roadsegment(segment) => Self::RoadSegment {
                region: segment.region.map(|region| region.0),
                id: segment.id.0,
            },
            MapReference::Intersection(intersection) => Self::Intersection {
                region: intersection.region.map(|region| region.0),
                id: intersection.id.0,
            },
        }
    }
}
