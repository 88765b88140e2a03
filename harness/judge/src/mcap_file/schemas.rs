//! The messages of an MCAP file, as JSON, with their JSON Schemas.
//!
//! Those named `foxglove.…` have the fields of Foxglove's well-known schemas that are needed here
//! (<https://docs.foxglove.dev/docs/sdk/schemas>); Foxglove knows them by name and shows them in its map,
//! 3D and log panels. Nothing is optional, as in messages of ROS: what is not known is empty.

use crossguard_robot::around;
use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema};
use serde::Serialize;

/// A kind of message.
pub(super) trait Kind: Serialize + JsonSchema {
    /// The name of its schema.
    const NAME: &'static str;

    /// Its JSON Schema, with nothing but itself to refer to.
    fn schema() -> Schema {
        let settings = SchemaSettings::draft07().with(|settings| settings.inline_subschemas = true);
        let mut schema = settings.into_generator().into_root_schema_for::<Self>();
        schema.insert("title".to_owned(), Self::NAME.into());
        schema
    }
}

macro_rules! kinds {
    ($($kind:ident $name:literal),* $(,)?) => {$(
        impl Kind for $kind {
            const NAME: &'static str = $name;
        }
    )*};
}

kinds!(
    State "crossguard.State",
    Step "crossguard.Step",
    RobotMessage "crossguard.Message",
    Counters "crossguard.Counters",
    Corridor "crossguard.Corridor",
    People "crossguard.People",
    Around "crossguard.Around",
    Log "foxglove.Log",
    LocationFix "foxglove.LocationFix",
    FrameTransform "foxglove.FrameTransform",
    SceneUpdate "foxglove.SceneUpdate",
);

/// A moment since 1970, or a duration.
#[derive(Clone, Copy, Debug, Serialize, JsonSchema)]
pub(super) struct Time {
    /// Whole seconds.
    pub(super) sec: u32,
    /// Nanoseconds besides them, 0..999999999.
    pub(super) nsec: u32,
}

/// A robot's part in a session, when it has changed.
#[expect(
    clippy::struct_field_names,
    reason = "it is named after what matters in it"
)]
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct State {
    pub(super) timestamp: Time,
    /// The robot's name.
    pub(super) robot: String,
    /// Its station id.
    pub(super) station: u32,
    /// Its boot counter.
    pub(super) boot: u16,
    /// `Idle`, `HelpRequested`, `RoleEstablished` or `ManeuverExecuting`.
    pub(super) state: String,
    /// The same as a number to plot, 1..4: the paper's stage.
    pub(super) stage: u8,
    /// `none`, `requester`, `helper`, `leader` or `follower`.
    pub(super) role: String,
    /// The session, empty without one.
    pub(super) session: String,
    /// The maneuver that it executes, empty without one.
    pub(super) executes: String,
    /// The followers of a leader.
    pub(super) followers: Vec<Follower>,
    /// Whether the pedestrian may cross, as far as this robot says.
    pub(super) corridor_open: bool,
    /// The crossing that it asks help for, empty where it is not known.
    pub(super) place: String,
    /// What it still has to do on the road, empty where that is nothing.
    pub(super) duty: String,
    /// `available`, or why it is not.
    pub(super) availability: String,
}

/// What a leader knows of a follower.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct Follower {
    pub(super) station: u32,
    /// Its newest acknowledged maneuver, empty without one.
    pub(super) task: String,
    /// How far it is with it, empty before its first report.
    pub(super) progress: String,
    /// Whether the lease on it stands.
    pub(super) has_lease: bool,
}

/// A step of the transition function, other than one in which nothing but time has passed.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct Step {
    pub(super) timestamp: Time,
    pub(super) robot: String,
    pub(super) input: String,
    pub(super) outputs: Vec<String>,
}

/// A message that a robot sent, heard, or should have heard.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct RobotMessage {
    pub(super) timestamp: Time,
    pub(super) robot: String,
    /// `sent`, `heard` or `lost`.
    pub(super) direction: String,
    /// `RAM`, `RMCM`, `CAM`, `VAM` or `CPM`.
    pub(super) kind: String,
    /// The station that sent it.
    pub(super) from: u32,
    /// What it says, in a few words.
    pub(super) text: String,
    /// Why it was sent, or how it was lost; empty where it was heard.
    pub(super) why: String,
    /// The message in UPER, as hexadecimal digits.
    pub(super) octets: String,
}

/// What was dropped or ignored so far.
#[expect(
    clippy::struct_field_names,
    reason = "it is named after what matters in it"
)]
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct Counters {
    pub(super) timestamp: Time,
    pub(super) robot: String,
    pub(super) counters: Vec<Counter>,
}

#[derive(Clone, Debug, Serialize, JsonSchema)]
pub(super) struct Counter {
    /// Where it was dropped or ignored.
    pub(super) layer: String,
    /// Why.
    pub(super) cause: String,
    pub(super) count: u64,
}

/// The corridor was opened or closed.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct Corridor {
    pub(super) timestamp: Time,
    /// The leader.
    pub(super) robot: String,
    pub(super) is_open: bool,
    /// Why it was closed; empty where it was opened.
    pub(super) why: String,
}

/// The people that a robot's sensors have.
#[expect(
    clippy::struct_field_names,
    reason = "it is named after what matters in it"
)]
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct People {
    pub(super) timestamp: Time,
    pub(super) robot: String,
    /// How many wait to cross.
    pub(super) waiting: u32,
    /// How many are on the road.
    pub(super) on_road: u32,
    pub(super) people: Vec<Person>,
}

/// A road user that the sensors have.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct Person {
    /// Degrees, north positive.
    pub(super) latitude: f64,
    /// Degrees, east positive.
    pub(super) longitude: f64,
    /// `pedestrian`, `bicyclist`, `motorcyclist`, `animal`, `wheelchairUser` or `vehicle`.
    pub(super) class: String,
    /// `elsewhere`, `passing`, `waiting`, `onRoad` or `across`.
    pub(super) conduct: String,
}

/// Who is on a robot's map.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct Around {
    pub(super) timestamp: Time,
    pub(super) robot: String,
    /// One for each kind of which somebody is there.
    pub(super) kinds: Vec<AroundOfKind>,
}

/// The road users of a kind on a robot's map.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct AroundOfKind {
    /// `robot`, `vehicle`, `vulnerable road user`, `road-side unit` or `object`.
    pub(super) kind: String,
    pub(super) count: u32,
    /// Who is nearest; empty where no distance is known.
    pub(super) nearest: String,
    /// Metres; 0 where it is not known.
    pub(super) nearest_distance: f64,
    /// For how long the one that was told of longest ago has not been told of again, in seconds.
    pub(super) oldest_age: f64,
}

/// The map of a robot, as numbers.
pub(super) fn around(timestamp: Time, robot: String, around: &around::Around) -> Around {
    let kinds = around.kinds.iter().map(|it| AroundOfKind {
        kind: it.kind.name().to_owned(),
        count: u32::try_from(it.count).unwrap_or(u32::MAX),
        nearest: it
            .nearest
            .map_or_else(String::new, |nearest| nearest.who.to_string()),
        nearest_distance: it.nearest.map_or(0.0, |nearest| nearest.distance_m),
        oldest_age: std::time::Duration::from_millis(it.oldest_ms).as_secs_f64(),
    });
    Around {
        timestamp,
        robot,
        kinds: kinds.collect(),
    }
}

#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct Log {
    pub(super) timestamp: Time,
    /// 2 information, 3 warning.
    pub(super) level: u8,
    pub(super) message: String,
    /// The robot.
    pub(super) name: String,
    pub(super) file: String,
    pub(super) line: u32,
}

#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct LocationFix {
    pub(super) timestamp: Time,
    pub(super) frame_id: String,
    /// Degrees, north positive.
    pub(super) latitude: f64,
    /// Degrees, east positive.
    pub(super) longitude: f64,
    /// Metres above the WGS84 ellipsoid; 0 where it is not known.
    pub(super) altitude: f64,
    /// In m², east, north and up, row by row.
    pub(super) position_covariance: [f64; 9],
    /// 0 unknown, 1 approximated.
    pub(super) position_covariance_type: u8,
}

#[derive(Clone, Copy, Debug, Default, Serialize, JsonSchema)]
pub(super) struct Vector3 {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) z: f64,
}

#[derive(Clone, Copy, Debug, Serialize, JsonSchema)]
pub(super) struct Quaternion {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) z: f64,
    pub(super) w: f64,
}

#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct FrameTransform {
    pub(super) timestamp: Time,
    pub(super) parent_frame_id: String,
    pub(super) child_frame_id: String,
    pub(super) translation: Vector3,
    pub(super) rotation: Quaternion,
}

#[derive(Clone, Copy, Debug, Serialize, JsonSchema)]
pub(super) struct Pose {
    pub(super) position: Vector3,
    pub(super) orientation: Quaternion,
}

/// From 0 to 1.
#[derive(Clone, Copy, Debug, Serialize, JsonSchema)]
pub(super) struct Color {
    pub(super) r: f64,
    pub(super) g: f64,
    pub(super) b: f64,
    pub(super) a: f64,
}

#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct SceneUpdate {
    pub(super) deletions: Vec<SceneEntityDeletion>,
    pub(super) entities: Vec<SceneEntity>,
}

#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct SceneEntityDeletion {
    pub(super) timestamp: Time,
    /// 0 those of this id, 1 all of the topic.
    #[serde(rename = "type")]
    pub(super) kind: u8,
    pub(super) id: String,
}

#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct SceneEntity {
    pub(super) timestamp: Time,
    pub(super) frame_id: String,
    pub(super) id: String,
    /// 0: until it is replaced or deleted.
    pub(super) lifetime: Time,
    pub(super) frame_locked: bool,
    pub(super) metadata: Vec<KeyValuePair>,
    pub(super) arrows: Vec<Nothing>,
    pub(super) cubes: Vec<CubePrimitive>,
    pub(super) spheres: Vec<Nothing>,
    pub(super) cylinders: Vec<CylinderPrimitive>,
    pub(super) lines: Vec<LinePrimitive>,
    pub(super) triangles: Vec<Nothing>,
    pub(super) texts: Vec<TextPrimitive>,
    pub(super) models: Vec<Nothing>,
}

/// A primitive that is not used here.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct Nothing {}

#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct KeyValuePair {
    pub(super) key: String,
    pub(super) value: String,
}

#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct CubePrimitive {
    pub(super) pose: Pose,
    /// Metres.
    pub(super) size: Vector3,
    pub(super) color: Color,
}

#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct LinePrimitive {
    /// 0 from point to point, 1 back to the first one.
    #[serde(rename = "type")]
    pub(super) kind: u8,
    pub(super) pose: Pose,
    /// Metres, or pixels where it does not scale.
    pub(super) thickness: f64,
    pub(super) scale_invariant: bool,
    pub(super) points: Vec<Vector3>,
    pub(super) color: Color,
    pub(super) colors: Vec<Color>,
    pub(super) indices: Vec<u32>,
}

#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct CylinderPrimitive {
    pub(super) pose: Pose,
    /// Metres.
    pub(super) size: Vector3,
    pub(super) bottom_scale: f64,
    pub(super) top_scale: f64,
    pub(super) color: Color,
}

#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct TextPrimitive {
    pub(super) pose: Pose,
    /// Whether it always faces the camera.
    pub(super) billboard: bool,
    /// Metres, or pixels where it does not scale.
    pub(super) font_size: f64,
    pub(super) scale_invariant: bool,
    pub(super) color: Color,
    pub(super) text: String,
}
