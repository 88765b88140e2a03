//! Robots and what they guard, as things to be seen.
//!
//! The frame `street` is in metres to the east and to the north of where the first robot was first; each
//! robot has a frame of its own, which looks ahead along x (REP 103).

use crossguard_protocol::TaskType;
use crossguard_robot::sight::{Degrees, Outline, Seen, Sight};
use crossguard_robot::site::{Place, Site};
use crossguard_robot::zone::Conduct;

use super::schemas::{
    Color, CubePrimitive, CylinderPrimitive, FrameTransform, KeyValuePair, LinePrimitive,
    LocationFix, People, Person, Pose, Quaternion, SceneEntity, SceneEntityDeletion, SceneUpdate,
    TextPrimitive, Time, Vector3,
};
use crate::facts::{Area, ClusterView, Placed, View};

/// The frame of the street.
pub(super) const STREET: &str = "street";

/// How wide the way is along which a pedestrian is escorted, in metres.
const CORRIDOR_M: f64 = 1.5;

const NEVER: Time = Time { sec: 0, nsec: 0 };
const IDENTITY: Quaternion = Quaternion {
    x: 0.0,
    y: 0.0,
    z: 0.0,
    w: 1.0,
};

const fn color(r: f64, g: f64, b: f64, a: f64) -> Color {
    Color { r, g, b, a }
}

/// Those of Okabe and Ito, which people who do not see all colours can tell apart.
const COLORS: [Color; 6] = [
    color(0.0, 0.447, 0.698, 1.0),
    color(0.835, 0.369, 0.0, 1.0),
    color(0.0, 0.62, 0.451, 1.0),
    color(0.8, 0.475, 0.655, 1.0),
    color(0.902, 0.624, 0.0, 1.0),
    color(0.337, 0.706, 0.914, 1.0),
];
const OPEN: Color = color(0.0, 0.62, 0.451, 0.5);
const CLOSED: Color = color(0.5, 0.5, 0.5, 0.35);
const ZONE: Color = color(0.902, 0.624, 0.0, 0.8);
const ROAD: Color = color(0.5, 0.5, 0.5, 0.8);
const CLUSTER: Color = color(0.8, 0.475, 0.655, 1.0);
const TEXT: Color = color(1.0, 1.0, 1.0, 1.0);

/// A turn about the vertical axis by this many degrees clockwise from north, of something that looks to
/// the east.
fn turned(heading: f64) -> Quaternion {
    let half = (90.0 - heading).to_radians() / 2.0;
    Quaternion {
        z: half.sin(),
        w: half.cos(),
        ..IDENTITY
    }
}

/// What a position says of itself.
pub(super) fn location_fix(timestamp: Time, frame: &str, placed: &Placed) -> LocationFix {
    let covariance = placed.ellipse.map(|ellipse| {
        // Half axes of 95 % are 2.45 standard deviations of a normal distribution in the plane.
        let deviation = |axis: f64| axis / 2.447_75;
        let (major, minor) = (deviation(ellipse.semi_major), deviation(ellipse.semi_minor));
        let (sin, cos) = ellipse.orientation.to_radians().sin_cos();
        let east = (major * sin).powi(2) + (minor * cos).powi(2);
        let north = (major * cos).powi(2) + (minor * sin).powi(2);
        let both = (major.powi(2) - minor.powi(2)) * sin * cos;
        [east, both, 0.0, both, north, 0.0, 0.0, 0.0, 0.0]
    });
    let covariance = covariance.filter(|it| it.iter().all(|value| value.is_finite()));
    LocationFix {
        timestamp,
        frame_id: frame.to_owned(),
        latitude: placed.latitude,
        longitude: placed.longitude,
        altitude: placed.altitude.unwrap_or(0.0),
        position_covariance: covariance.unwrap_or_default(),
        position_covariance_type: u8::from(covariance.is_some()),
    }
}

/// Where a robot's frame is.
pub(super) fn transform(
    timestamp: Time,
    frame: &str,
    site: &Site,
    placed: &Placed,
) -> FrameTransform {
    FrameTransform {
        timestamp,
        parent_frame_id: STREET.to_owned(),
        child_frame_id: frame.to_owned(),
        translation: vector(site.place(placed.latitude, placed.longitude), 0.0),
        rotation: turned(placed.heading.unwrap_or(0.0)),
    }
}

const fn vector(place: Place, up: f64) -> Vector3 {
    Vector3 {
        x: place.east,
        y: place.north,
        z: up,
    }
}

fn entity(timestamp: Time, frame: &str, id: String) -> SceneEntity {
    SceneEntity {
        timestamp,
        frame_id: frame.to_owned(),
        id,
        lifetime: NEVER,
        frame_locked: true,
        metadata: Vec::new(),
        arrows: Vec::new(),
        cubes: Vec::new(),
        spheres: Vec::new(),
        cylinders: Vec::new(),
        lines: Vec::new(),
        triangles: Vec::new(),
        texts: Vec::new(),
        models: Vec::new(),
    }
}

fn text(up: f64, text: String) -> TextPrimitive {
    TextPrimitive {
        pose: Pose {
            position: vector(Place::default(), up),
            orientation: IDENTITY,
        },
        billboard: true,
        font_size: 14.0,
        scale_invariant: true,
        color: TEXT,
        text,
    }
}

/// A robot: a box in its own frame, with its name and state above it.
pub(super) fn robot(
    timestamp: Time,
    frame: &str,
    number: usize,
    name: &str,
    (view, placed): (&View, &Placed),
) -> SceneUpdate {
    let box_ = placed.dimensions;
    let size = Vector3 {
        x: box_.length.unwrap_or(0.6),
        y: box_.width.unwrap_or(0.6),
        z: box_.height.unwrap_or(1.0),
    };
    let cube = CubePrimitive {
        pose: Pose {
            position: vector(Place::default(), size.z / 2.0),
            orientation: IDENTITY,
        },
        size,
        color: COLORS[number % COLORS.len()],
    };
    let pair = |key: &str, value: String| KeyValuePair {
        key: key.to_owned(),
        value,
    };
    SceneUpdate {
        deletions: Vec::new(),
        entities: vec![SceneEntity {
            metadata: vec![
                pair("station", view.station.to_string()),
                pair("state", format!("{:?}", view.state)),
                pair("role", view.role.to_string()),
            ],
            texts: vec![text(
                size.z + 0.3,
                format!("{name}\n{:?} ({})", view.state, view.role),
            )],
            cubes: vec![cube],
            ..entity(timestamp, frame, name.to_owned())
        }],
    }
}

/// The areas of a leader: the way of an escort as a strip, other places as discs.
pub(super) fn areas(
    timestamp: Time,
    site: &Site,
    leader: &str,
    areas: &[Area],
    is_open: bool,
) -> SceneUpdate {
    let id = |area: &Area| format!("{leader}: place of station {}", area.follower);
    let deletions = if areas.is_empty() {
        // The session is over, and nothing is left of what the topic shows.
        vec![SceneEntityDeletion {
            timestamp,
            kind: 1,
            id: String::new(),
        }]
    } else {
        Vec::new()
    };
    let entities = areas.iter().map(|area| {
        let color = if is_open && area.guards { OPEN } else { CLOSED };
        let to = site.place(area.to.0, area.to.1);
        let from = area.from.map(|(lat, lon)| site.place(lat, lon));
        let mut entity = entity(timestamp, STREET, id(area));
        match from {
            Some(from) if area.task == TaskType::MOVE && from != to => {
                entity.cubes.push(strip(from, to, color));
            }
            _ => entity.cylinders.push(disc(to, color)),
        }
        entity
    });
    SceneUpdate {
        deletions,
        entities: entities.collect(),
    }
}

fn strip(from: Place, to: Place, color: Color) -> CubePrimitive {
    let length = from.distance(to);
    CubePrimitive {
        pose: Pose {
            position: vector(from.towards(to, length / 2.0), 0.01),
            orientation: turned(from.bearing(to)),
        },
        size: Vector3 {
            x: length,
            y: CORRIDOR_M,
            z: 0.02,
        },
        color,
    }
}

fn disc(at: Place, color: Color) -> CylinderPrimitive {
    CylinderPrimitive {
        pose: Pose {
            position: vector(at, 0.01),
            orientation: IDENTITY,
        },
        size: Vector3 {
            x: CORRIDOR_M,
            y: CORRIDOR_M,
            z: 0.02,
        },
        bottom_scale: 1.0,
        top_scale: 1.0,
        color,
    }
}

/// The people that a robot's sensors have, as numbers.
pub(super) fn people(timestamp: Time, robot: String, sight: &Sight) -> People {
    let people = sight.people.iter().map(|seen| Person {
        latitude: seen.place.0,
        longitude: seen.place.1,
        class: name_of(&seen.class),
        conduct: name_of(&seen.conduct),
    });
    let count = |count: usize| u32::try_from(count).unwrap_or(u32::MAX);
    People {
        timestamp,
        robot,
        waiting: count(sight.waiting()),
        on_road: count(sight.on_road()),
        people: people.collect(),
    }
}

/// How logs name a value of an enumeration.
fn name_of(value: &impl serde::Serialize) -> String {
    let name = serde_json::to_value(value).ok();
    let name = name.as_ref().and_then(serde_json::Value::as_str);
    name.unwrap_or_default().to_owned()
}

/// What there is to be seen at a crossing: the zone, people, and the clusters that are announced of them.
pub(super) fn crossing<'a>(
    timestamp: Time,
    site: &Site,
    (zone, sight): (&Outline, &Sight),
    clusters: impl Iterator<Item = &'a ClusterView>,
) -> SceneUpdate {
    let mut outlines = entity(timestamp, STREET, "crossing zone".to_owned());
    for (corners, color) in [(&zone.waiting, ZONE), (&zone.road, ROAD)] {
        outlines.lines.extend(outline(site, corners, color));
    }
    let mut people = entity(timestamp, STREET, "people".to_owned());
    people.cylinders = sight.people.iter().map(|seen| person(site, seen)).collect();
    let mut announced = entity(timestamp, STREET, "clusters".to_owned());
    for cluster in clusters {
        announced
            .lines
            .extend(outline(site, &cluster.corners, CLUSTER));
    }
    SceneUpdate {
        deletions: Vec::new(),
        entities: vec![outlines, people, announced],
    }
}

fn outline(site: &Site, corners: &[Degrees], color: Color) -> Option<LinePrimitive> {
    let points = corners
        .iter()
        .map(|at| vector(site.place(at.0, at.1), 0.02));
    (!corners.is_empty()).then(|| LinePrimitive {
        kind: 1,
        pose: Pose {
            position: vector(Place::default(), 0.0),
            orientation: IDENTITY,
        },
        thickness: 0.08,
        scale_invariant: false,
        points: points.collect(),
        color,
        colors: Vec::new(),
        indices: Vec::new(),
    })
}

fn person(site: &Site, seen: &Seen) -> CylinderPrimitive {
    let height_m = 1.7;
    CylinderPrimitive {
        pose: Pose {
            position: vector(site.place(seen.place.0, seen.place.1), height_m / 2.0),
            orientation: IDENTITY,
        },
        size: Vector3 {
            x: 0.4,
            y: 0.4,
            z: height_m,
        },
        bottom_scale: 1.0,
        top_scale: 0.6,
        color: match seen.conduct {
            Conduct::Waiting => ZONE,
            Conduct::OnRoad => color(0.835, 0.369, 0.0, 1.0),
            Conduct::Across => color(0.0, 0.62, 0.451, 1.0),
            Conduct::Elsewhere | Conduct::Passing => ROAD,
        },
    }
}
