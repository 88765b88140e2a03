//! A crossing zone as a robot file says it: where people wait to cross, and the road there; and how the crossing
//! machine has it.

use crossguard_crossing::{
    Coverage, Ground, Point, PositionRules, RoadUser, Sensors, Setup, Shape, Sighting,
    TrafficRules, WaitingRules, Way,
};
use crossguard_endpoint::ras::area::Area;
use crossguard_endpoint::ras::clustering::{PerceivedVru, VruClass};

pub use crossguard_crossing::tracks::Conduct;

mod parts;
mod polygon;

use self::parts::Parts;
pub use self::polygon::NoPolygon;
pub(crate) use self::polygon::polygon;
use crate::sight::corners;
use crate::site::Place;

/// A crossing zone.
#[derive(Clone, PartialEq, Debug)]
pub struct Zone {
    /// Where people wait to cross; without it nobody is detected.
    pub waiting: Option<Area>,
    /// The carriageway; without it the road is never known to be clear.
    pub road: Option<Area>,
    /// The part of it on which people cross, if it is not the whole.
    pub crossing: Option<Area>,
    /// When somebody waits.
    pub rules: WaitingRules,
    /// Assumptions about the sensors.
    pub sensors: Sensors,
    /// When a robot is in position there.
    pub position: PositionRules,
    /// When it is safe to cross in front of vehicles.
    pub traffic: TrafficRules,
}

impl Zone {
    /// A zone with this road, in which nobody is detected.
    #[must_use]
    pub fn of_road(road: Area) -> Self {
        Self {
            waiting: None,
            road: Some(road),
            crossing: None,
            rules: WaitingRules::default(),
            sensors: Sensors::default(),
            position: PositionRules::default(),
            traffic: TrafficRules::default(),
        }
    }

    /// The crossing machine's ground.
    #[must_use]
    pub fn ground(&self) -> Ground {
        Ground {
            road: self.road.as_ref().and_then(shape),
            crossing: self.crossing.as_ref().and_then(shape),
            waiting: self.waiting.as_ref().and_then(shape),
            parts: self.parts().all(),
        }
    }

    /// The setup of a robot that watches this zone.
    #[must_use]
    pub fn watched(&self, setup: Setup) -> Setup {
        Setup {
            watches: true,
            calls: true,
            sensors: self.sensors,
            waiting: self.rules,
            position: self.position,
            traffic: self.traffic,
            ground: self.ground(),
            ..setup
        }
    }

    /// How long a slow walker is on its road, in seconds, if it has one. A road is longer than it is wide.
    #[must_use]
    pub fn walk_s(&self) -> Option<f64> {
        let slow_walk = self.watched(Setup::default()).slow_walk();
        self.road.as_ref().map(|_| f64::from(slow_walk.0) / 1e3)
    }

    fn parts(&self) -> Parts {
        Parts::of(&self.road.as_ref().map_or_else(Vec::new, corners))
    }

    /// The parts of the carriageway that are in an area as a whole, to 1 cm; all, if none is said.
    ///
    /// It has 32: eight columns along its longest side, and four rows from edge to edge, without a gap. So the area covers
    /// the carriageway only if no place of it is left out.
    #[must_use]
    pub fn covered(&self, by: Option<&Area>) -> Coverage {
        let parts = self.parts();
        by.map_or_else(|| parts.all(), |area| parts.covered(&corners(area)))
    }
}

fn shape(area: &Area) -> Option<Shape> {
    let corners: Vec<_> = corners(area)
        .iter()
        .map(|[east, north]| point(Place::new(*east, *north)))
        .collect();
    Shape::new(&corners)
}

/// A place for the crossing machine, to the centimetre.
#[must_use]
pub fn point(place: Place) -> Point {
    Point::new(centi(place.east), centi(place.north))
}

/// A place of the crossing machine.
#[must_use]
pub fn place(point: Point) -> Place {
    Place::new(
        f64::from(point.east_cm()) / 100.0,
        f64::from(point.north_cm()) / 100.0,
    )
}

/// Hundredths, saturating; nothing for what is no number.
#[expect(clippy::cast_possible_truncation, reason = "casts of numbers saturate")]
fn centi(value: f64) -> i32 {
    (value * 100.0).round() as i32
}

/// A velocity in m/s for the crossing machine.
#[must_use]
pub fn velocity([east, north]: [f64; 2]) -> Way {
    Way {
        east_cm: centi(east),
        north_cm: centi(north),
    }
}

/// A velocity of the crossing machine in m/s, to the east and to the north.
#[must_use]
pub fn metres_per_second(way: Way) -> [f64; 2] {
    [way.east_cm, way.north_cm].map(|it| f64::from(it) / 100.0)
}

/// A road user on the site, as the crossing machine takes it in.
#[must_use]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "casts of numbers saturate"
)]
pub fn sighting(vru: &PerceivedVru, error_m: f64) -> Sighting {
    Sighting {
        id: Some(vru.id),
        at: point(Place::new(vru.position_m[0], vru.position_m[1])),
        error_cm: (error_m * 100.0).ceil() as u16,
        velocity: Some(velocity(vru.velocity_mps)),
        what: road_user(vru.class),
        confidence: (vru.confidence * 100.0).round() as u8,
    }
}

const fn road_user(class: VruClass) -> RoadUser {
    match class {
        VruClass::Pedestrian => RoadUser::Pedestrian,
        VruClass::Bicyclist => RoadUser::Bicyclist,
        VruClass::Motorcyclist => RoadUser::Motorcyclist,
        VruClass::Animal => RoadUser::Animal,
        VruClass::WheelchairUser => RoadUser::WheelchairUser,
        VruClass::Vehicle => RoadUser::Vehicle,
    }
}
