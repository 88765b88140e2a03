//! Others at a crossing, as a robot senses them, for its log: people and vehicles without track numbers, and the zone.
//!
//! Places are in degrees, as in RAM, so that a log needs no site.

pub use crossguard_crossing::RoadUser;
use crossguard_endpoint::ras::area::Area;
use serde::{Deserialize, Serialize};

use crate::site::{Place, Site};
use crate::zone::{Conduct, Zone};

/// Corners that a circle is drawn with.
const CIRCLE_CORNERS: u8 = 24;

/// Degrees of latitude and longitude.
pub type Degrees = (f64, f64);

/// The road users that a robot has at a time.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct Sight {
    /// The people that its sensors have.
    pub people: Vec<Seen>,
    /// The vehicles that its sensors have or that it hears, at most [`VEHICLES_MAX`].
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub vehicles: Vec<SeenVehicle>,
}

/// Most vehicles of a sight: as many as the crossing machine knows.
pub const VEHICLES_MAX: usize = 32;

/// A vehicle as it was seen or heard last.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct SeenVehicle {
    /// Latitude and longitude.
    pub place: Degrees,
    /// m/s to the east and to the north; unknown where its source does not say it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub velocity: Option<[f64; 2]>,
}

/// A road user that the sensors have.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct Seen {
    /// Latitude and longitude.
    pub place: Degrees,
    /// Its kind.
    pub class: RoadUser,
    /// Its conduct at the crossing.
    pub conduct: Conduct,
}

impl Sight {
    /// How many people wait to cross.
    #[must_use]
    pub fn waiting(&self) -> usize {
        self.count(Conduct::Waiting)
    }

    /// How many people are on the road.
    #[must_use]
    pub fn on_road(&self) -> usize {
        self.count(Conduct::OnRoad)
    }

    /// How many people do this.
    #[must_use]
    pub fn count(&self, conduct: Conduct) -> usize {
        self.people
            .iter()
            .filter(|seen| seen.conduct == conduct)
            .count()
    }
}

/// The outline of a zone, by its corners.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct Outline {
    /// Where people wait; none where nobody is detected.
    pub waiting: Vec<Degrees>,
    /// The carriageway; none where it is not known.
    pub road: Vec<Degrees>,
    /// The part of it on which people cross, if it is not the whole.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub crossing: Vec<Degrees>,
}

impl Outline {
    /// The outline of a zone on a site.
    #[must_use]
    pub fn of(zone: &Zone, site: &Site) -> Self {
        let outline = |area: &Option<Area>| {
            let corners = area.as_ref().map_or_else(Vec::new, corners);
            let degrees = |[east, north]: [f64; 2]| site.coordinates(Place::new(east, north));
            corners.into_iter().map(degrees).collect()
        };
        Self {
            waiting: outline(&zone.waiting),
            road: outline(&zone.road),
            crossing: outline(&zone.crossing),
        }
    }
}

/// The corners of an area; a circle gets some.
#[must_use]
pub fn corners(area: &Area) -> Vec<[f64; 2]> {
    match area {
        Area::Polygon(corners) => corners.clone(),
        Area::Circle { center, radius_m } => (0..CIRCLE_CORNERS)
            .map(|number| {
                let share = f64::from(number) / f64::from(CIRCLE_CORNERS);
                let (sine, cosine) = (share * std::f64::consts::TAU).sin_cos();
                [center[0] + radius_m * cosine, center[1] + radius_m * sine]
            })
            .collect(),
        Area::Rectangle {
            center,
            half_m,
            direction_rad,
        } => {
            let (sine, cosine) = direction_rad.sin_cos();
            [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]]
                .map(|[along, across]| {
                    let (x, y) = (along * half_m[0], across * half_m[1]);
                    [
                        center[0] + x * cosine - y * sine,
                        center[1] + x * sine + y * cosine,
                    ]
                })
                .to_vec()
        }
    }
}
