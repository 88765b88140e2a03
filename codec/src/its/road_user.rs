//! Road users that messages of other stations tell of, in SI units.

use super::{CPM, CpmContainer, ItsMessage};
use crate::asn1::cam::{
    BasicVehicleContainerHighFrequency, CAM, HighFrequencyContainer, VehicleLength,
    VehicleLengthConfidenceIndication,
};
use crate::asn1::cdd::{BasicContainer, DriveDirection, Shape, Speed, Wgs84AngleValue};
use crate::asn1::cdd211::ObjectClass211;
use crate::asn1::cpm::{
    CartesianPosition3dWithConfidence, ObjectClass, ObjectDimension, Velocity3dWithConfidence,
};
use crate::containers;
use crate::distance::moved;
use crate::road_user::{Identity, Kind, RoadUser, identity_of, middle_of};
use crate::si;
use crate::state::{ConfidenceEllipse, Position, UNKNOWN_ERROR_M};

/// The last station type of a vulnerable road user that walks or rides, and those further up.
const fn kind_of(station_type: u8) -> Kind {
    match station_type {
        1..=4 | 12 | 13 => Kind::Vru,
        5..=11 | 14 => Kind::Vehicle,
        15 => Kind::RoadSideUnit,
        _ => Kind::Object,
    }
}

fn position_of(container: &BasicContainer) -> Position {
    // The core's form of it has the rules of SI units. There is none of numbers that no message has.
    let container = crate::core::cdd::BasicContainer::try_from(container);
    container.map_or_else(|_| Position::default(), |it| containers::position_of(&it))
}

fn speed_of(speed: &Speed) -> Option<f64> {
    si::SPEED.decode(speed.speed_value.0)
}

fn heading_of(angle: &Wgs84AngleValue) -> Option<f64> {
    si::angle_degrees(angle.0)
}

/// The road user or the cluster of a VAM, in either version of the dictionary.
macro_rules! of_vam {
    ($vam:ident, $now:ident) => {{
        let parameters = &$vam.vam.vam_parameters;
        let cluster = parameters.vru_cluster_information_container.as_ref();
        let cluster = cluster.map(|cluster| &cluster.vru_cluster_information);
        // A cluster that its head breaks up has nobody any more.
        if cluster.is_some_and(|cluster| cluster.cluster_cardinality_size.0 == 0) {
            return Vec::new();
        }
        let motion = &parameters.vru_high_frequency_container;
        vec![RoadUser {
            cardinality: cluster.map_or(1, |cluster| cluster.cluster_cardinality_size.0),
            identity: identity_of(
                $vam.header.station_id.0,
                cluster.and_then(|cluster| Some(cluster.cluster_id.as_ref()?.0)),
            ),
            speed: speed_of(&motion.speed),
            heading: heading_of(&motion.heading.value),
            length: None,
            measured_its: si::rebuild_timestamp($now, $vam.vam.generation_delta_time.0),
            position: cluster_position(
                &parameters.basic_container,
                cluster.and_then(|cluster| cluster.cluster_bounding_box_shape.as_ref()),
            ),
            kind: Kind::Vru,
            station_type: Some(parameters.basic_container.station_type.0),
            signals: None,
        }]
    }};
}

impl ItsMessage {
    /// Road users that this message tells of, received at `now`, a `TimestampIts`: its sender, unless it is a
    /// CPM or an RMCM, the people that a RAM announces, and the objects that a CPM perceives. A VAM that breaks a
    /// cluster up tells of nobody.
    #[must_use]
    pub fn road_users(&self, now: u64) -> Vec<RoadUser> {
        match self {
            Self::Ram(ram) => {
                let parameters = &ram.ram.ram_parameters;
                let cluster = parameters.vru_cluster_information_container;
                let around = cluster.map(|container| container.vru_cluster_information);
                let measured = si::rebuild_timestamp(now, ram.ram.generation_delta_time.0);
                RoadUser::of_robot(
                    ram.header.station_id.0,
                    parameters.basic_container.station_type.0,
                    &crate::view::state_of(ram),
                    around.as_ref(),
                    measured,
                )
                .collect()
            }
            Self::Rmcm(_) => Vec::new(),
            Self::Cam(cam) => vec![of_cam(cam, now)],
            Self::Vam(vam) => of_vam!(vam, now),
            Self::Vam211(vam) => of_vam!(vam, now),
            Self::Cpm(cpm) => of_cpm(cpm),
        }
    }
}

/// The middle of a cluster's bounding shape; the reference position where it has none of its own.
fn cluster_position(container: &BasicContainer, shape: Option<&Shape>) -> Position {
    let position = position_of(container);
    // The core has the shapes that have a middle.
    let middle = shape.and_then(|shape| middle_of(shape.try_into().ok()?));
    middle.map_or(position, |[east, north]| moved(&position, east, north))
}

fn of_cam(cam: &CAM, now: u64) -> RoadUser {
    let parameters = &cam.cam.cam_parameters;
    let station_type = parameters.basic_container.station_type.0;
    let user = RoadUser {
        identity: Identity::Station(cam.header.station_id.0),
        kind: Kind::RoadSideUnit,
        station_type: Some(station_type),
        position: position_of(&parameters.basic_container),
        speed: None,
        heading: None,
        length: None,
        cardinality: 1,
        signals: None,
        measured_its: si::rebuild_timestamp(now, cam.cam.generation_delta_time.0),
    };
    match &parameters.high_frequency_container {
        HighFrequencyContainer::basicVehicleContainerHighFrequency(motion) => RoadUser {
            kind: match kind_of(station_type) {
                Kind::Vru => Kind::Vru,
                _ => Kind::Vehicle,
            },
            speed: speed_of(&motion.speed),
            heading: direction_of(motion),
            length: length_of(&motion.vehicle_length),
            ..user
        },
        HighFrequencyContainer::rsuContainerHighFrequency(_) => user,
    }
}

/// The direction in which a vehicle moves. Its heading is that of its movement (EN 302 637-2, annex B), but stations of which
/// the speed is negative while it backs say where its front points. So it is known only of one that says that it drives forward.
fn direction_of(motion: &BasicVehicleContainerHighFrequency) -> Option<f64> {
    match motion.drive_direction {
        DriveDirection::forward => si::angle_degrees(motion.heading.heading_value.0),
        DriveDirection::backward | DriveDirection::unavailable => None,
    }
}

/// How long a trailer is at most, in metres (Directive 96/53/EC).
const TRAILER_M: f64 = 12.0;

/// How long a vehicle is with the trailer that it has or may have.
fn length_of(length: &VehicleLength) -> Option<f64> {
    use VehicleLengthConfidenceIndication as Trailer;
    let trailer_m = match length.vehicle_length_confidence_indication {
        Trailer::noTrailerPresent | Trailer::trailerPresentWithKnownLength => 0.0,
        _ => TRAILER_M,
    };
    let value = length.vehicle_length_value.0;
    (value != 1_023).then(|| f64::from(value) / 10.0 + trailer_m)
}

/// The kind that an object most probably is.
macro_rules! most_probable {
    ($classes:expr, $class:ident) => {{
        // A confidence of 101 is not known.
        let known = $classes.iter().flat_map(|classes| classes.0.iter());
        known
            .max_by_key(|class| class.confidence.0 % 101)
            .map(|class| match &class.object_class {
                $class::vehicleSubClass(kind) => (Kind::Vehicle, Some(kind.0), 1),
                $class::vruSubClass(_) => (Kind::Vru, None, 1),
                $class::groupSubClass(group) => (Kind::Vru, None, group.cluster_cardinality_size.0),
                $class::otherSubClass(_) => (Kind::Object, None, 1),
            })
            .unwrap_or((Kind::Object, None, 1))
    }};
}

/// The objects in a container of a CPM.
macro_rules! objects {
    ($container:expr, $class:ident, $frame:expr) => {
        for object in &$container.perceived_objects.0 {
            let (kind, station_type, cardinality) = most_probable!(object.classification, $class);
            let (speed, heading) = velocity(object.velocity.as_ref());
            let measured = i64::from(object.measurement_delta_time.0);
            $frame.users.push(RoadUser {
                identity: $frame.identity(object.object_id.as_ref().map(|id| id.0)),
                kind,
                station_type,
                position: $frame.position(&object.position),
                speed,
                heading,
                length: longest([&object.object_dimension_x, &object.object_dimension_y]),
                cardinality,
                signals: None,
                measured_its: $frame.time.saturating_add_signed(measured),
            });
        }
    };
}

/// The origin of objects, and the objects so far.
struct Frame {
    by: u32,
    /// The place of the first object among those of a report that comes in several messages.
    first: u16,
    origin: Position,
    time: u64,
    users: Vec<RoadUser>,
}

/// How many objects each of the 1 to 8 messages of a report has place for: eight containers of 255 at least.
const PLACES: u16 = 1 << 13;

impl Frame {
    /// The identity of the next object. A number that the message has already stands for two objects, as no number does.
    fn identity(&self, number: Option<u16>) -> Identity {
        let by = self.by;
        let numbered = number.map(|number| Identity::Object { by, number });
        let is_new = |identity: &Identity| self.users.iter().all(|it| it.identity != *identity);
        numbered.filter(is_new).unwrap_or_else(|| {
            let place = u16::try_from(self.users.len()).unwrap_or(u16::MAX);
            let place = self.first + place.min(PLACES - 1);
            Identity::Unnumbered { by, place }
        })
    }

    /// The position of an object: the errors of the origin and of both coordinates add up, in every direction.
    fn position(&self, coordinates: &CartesianPosition3dWithConfidence) -> Position {
        let axes = [&coordinates.x_coordinate, &coordinates.y_coordinate];
        let [east, north] = axes.map(|axis| f64::from(axis.value.0) / 100.0);
        let [x, y] = axes.map(|axis| {
            let error = si::COORDINATE_CONFIDENCE.decode(axis.confidence.0);
            error.unwrap_or(UNKNOWN_ERROR_M)
        });
        let error_m = self.origin.error_m() + x.hypot(y);
        Position {
            ellipse: Some(ConfidenceEllipse {
                semi_major: error_m,
                semi_minor: error_m,
                orientation: 0.0,
            }),
            ..moved(&self.origin, east, north)
        }
    }
}

fn of_cpm(cpm: &CPM) -> Vec<RoadUser> {
    let management = &cpm.management_container;
    let position = &management.reference_position;
    let ellipse = &position.position_confidence_ellipse;
    let segment = management.segmentation_info.as_ref();
    let mut frame = Frame {
        by: cpm.header.station_id.0,
        first: segment.map_or(0, |it| u16::from(it.this_msg_no.0 % 8) * PLACES),
        origin: Position {
            latitude: si::LATITUDE.decode(position.latitude.0),
            longitude: si::longitude_degrees(position.longitude.0),
            ellipse: containers::ellipse_of(
                [
                    ellipse.semi_major_confidence.0,
                    ellipse.semi_minor_confidence.0,
                ],
                ellipse.semi_major_orientation.0,
            ),
            ..Position::default()
        },
        time: management.reference_time.0,
        users: Vec::new(),
    };
    for container in &cpm.cpm_containers {
        match container {
            CpmContainer::PerceivedObjectContainer(container) => {
                objects!(container, ObjectClass, frame);
            }
            CpmContainer::PerceivedObjectContainer211(container) => {
                objects!(container, ObjectClass211, frame);
            }
            _ => {}
        }
    }
    frame.users
}

/// How long an object is, whichever way it stands.
fn longest(dimensions: [&Option<ObjectDimension>; 2]) -> Option<f64> {
    let known = dimensions.into_iter().flatten();
    let known = known.map(|it| it.value.0).filter(|value| *value != 256);
    known.max().map(|value| f64::from(value) / 10.0)
}

/// Speed in m/s, and its direction clockwise from north.
fn velocity(velocity: Option<&Velocity3dWithConfidence>) -> (Option<f64>, Option<f64>) {
    match velocity {
        None => (None, None),
        Some(Velocity3dWithConfidence::polarVelocity(polar)) => {
            // Counter-clockwise from the east.
            let direction = si::angle_degrees(polar.velocity_direction.value.0);
            let heading = direction.map(|angle| (90.0 - angle).rem_euclid(360.0));
            (speed_of(&polar.velocity_magnitude), heading)
        }
        Some(Velocity3dWithConfidence::cartesianVelocity(cartesian)) => {
            let component = |value: i16| (value != 16_383).then(|| f64::from(value) / 100.0);
            let east = component(cartesian.x_velocity.value.0);
            let north = component(cartesian.y_velocity.value.0);
            match (east, north) {
                (Some(east), Some(north)) => {
                    let heading = east.atan2(north).to_degrees().rem_euclid(360.0);
                    (Some(east.hypot(north)), Some(heading))
                }
                _ => (None, None),
            }
        }
    }
}
