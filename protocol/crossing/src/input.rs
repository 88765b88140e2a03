//! Inputs and outputs of the crossing machine.

use core::fmt::{self, Display, Formatter};

use crossguard_protocol::{
    Event, FallbackPolicy, List, MAX_FOLLOWERS, Maneuver, ManeuverId, Millis, Notice, StationId,
};

use crate::ground::{Coverage, Point, Way};
use crate::plan::Leg;

/// Kinds of road users.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
pub enum RoadUser {
    /// A person on foot.
    Pedestrian,
    /// A person in a wheelchair.
    WheelchairUser,
    /// A person on a bicycle.
    Bicyclist,
    /// A person on a motorcycle.
    Motorcyclist,
    /// An animal.
    Animal,
    /// A vehicle.
    Vehicle,
}

/// A road user in a frame.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Sighting {
    /// The source's number for them: a hint.
    pub id: Option<u32>,
    /// Where they are.
    pub at: Point,
    /// Error of the place, in centimetres.
    pub error_cm: u16,
    /// Their velocity, in cm/s, where it is known. A vehicle without one [is taken](crate::traffic::velocity) to come at 50 km/h.
    pub velocity: Option<Way>,
    /// Their kind.
    pub what: RoadUser,
    /// How sure the source is, in percent.
    pub confidence: u8,
}

/// The observation of a source at one time.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Frame<'a> {
    /// The source, below [`SOURCES`](crate::occupancy::SOURCES).
    pub source: u8,
    /// How long ago it looked.
    pub age: Millis,
    /// Which parts of the carriageway it could see.
    pub covers: Coverage,
    /// Everybody it saw there.
    pub sightings: &'a [Sighting],
}

/// A vehicle that is heard or seen.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Vehicle {
    /// Its number: a hint. From bit 63 on it is of a sensor's frame.
    pub key: u64,
    /// The station that it is, if it tells itself where it is: it can be asked to stop.
    pub station: Option<StationId>,
    /// Where it is.
    pub at: Point,
    /// How far its front is before that place, in centimetres: sensors and CPM say where the middle is, CAM where the front is.
    pub front_cm: u16,
    /// How long it is, in centimetres, by [`traffic::length_cm`](crate::traffic::length_cm).
    pub length_cm: u16,
    /// Error of the place, in centimetres.
    pub error_cm: u16,
    /// Its velocity, in cm/s: where not all of it is known, by [`traffic::velocity`](crate::traffic::velocity).
    pub velocity: Way,
    /// True if its direction is not known: it may come to any place.
    pub goes_anywhere: bool,
}

/// Where a body is, as it says.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Pose {
    /// Where it is.
    pub at: Point,
    /// Error of the place, in centimetres.
    pub error_cm: u16,
}

/// Reports of a body about its maneuver.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum BodyReport {
    /// It is at the place from which it guards.
    InPosition(ManeuverId),
    /// It has finished the maneuver.
    Completed(ManeuverId),
    /// It is gone.
    Gone,
}

/// One input of the crossing machine.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Input<'a> {
    /// Time has passed. It comes before every other input.
    Elapsed(Millis),
    /// A source delivered a frame.
    Frame(Frame<'a>),
    /// A source delivered something that is no frame, which may have been of any source.
    BadFrame,
    /// A station reports somebody who is no vehicle, seen so long ago. It may add people, and takes none away but its own.
    Heard(StationId, Sighting, Millis),
    /// A station reports something there that has no class and is no faster than people walk: it may be a person.
    Object(Point),
    /// A vehicle was heard or seen, so long ago.
    Vehicle(Vehicle, Millis),
    /// Packets were dropped because there were too many: for so long a vehicle may be there that was not heard.
    Missed(Millis),
    /// A vehicle answers that it will stop before the crossing, as it was asked the last time; `false`: that it will not.
    Answered(StationId, bool),
    /// The position of the robot's own body, measured so long ago; `None` where it is not known.
    Pose(Option<Pose>, Millis),
    /// The position of a follower by its RAM, measured so long ago; `None` where it does not say.
    FollowerAt(StationId, Option<Pose>, Millis),
    /// The robot's body reports.
    Body(BodyReport),
    /// The robot's body has ended its fallback, or carries out none: `true`. It moves because of one: `false`.
    BodyIsFree(bool),
    /// The protocol starts a maneuver of the body, towards a place if it has one.
    Started(Maneuver, Option<Point>),
    /// The protocol ends the maneuver of the body.
    Stopped,
    /// The protocol has the body fall back.
    FellBack(Maneuver, FallbackPolicy),
    /// The protocol tells.
    Notice(Notice),
    /// The corridor is open for so long from now.
    CorridorOpen(Millis),
    /// The corridor is closed.
    CorridorClosed,
    /// A call for help had no effect.
    CallIgnored,
    /// The protocol is told this, and not by the crossing machine: a person says that somebody is on the road, or that the corridor
    /// is to be closed, or opened again.
    Said(Event),
    /// A person says that the road is clear.
    SaidClear,
}

/// Why a frame was dropped.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum FrameDrop {
    /// It is older than `age_max`.
    Stale,
    /// It is not newer than the one before.
    OutOfOrder,
    /// There is no such source.
    NoSuchSource,
    /// It is no frame.
    Malformed,
}

impl FrameDrop {
    /// Its name in counters.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Stale => "stale",
            Self::OutOfOrder => "out of order",
            Self::NoSuchSource => "no such source",
            Self::Malformed => "malformed",
        }
    }
}

/// Causes that keep people from crossing.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Hindrance {
    /// The plan has more guards than the session.
    GuardMissing,
    /// A guard is not at its place, or nobody knows where it is.
    GuardElsewhere(StationId),
    /// The leader itself is not at its place.
    LeaderElsewhere,
    /// The sensors do not cover the carriageway now.
    NoSight,
    /// A vehicle can no longer stop comfortably: its key.
    Vehicle(u64),
    /// Packets were dropped: a vehicle may be there that was not heard.
    Missed,
    /// A vehicle that is to be asked has not said that it will stop.
    NoPromise(StationId),
    /// A person has closed the corridor, and has not opened it again.
    KeptClosed,
    /// Something without a class is on the crossing, as another station reports. It keeps the road from being clear.
    Object,
}

impl Display for Hindrance {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::GuardMissing => f.write_str("a guard of the plan is missing"),
            Self::GuardElsewhere(station) => write!(f, "guard {station} is not at its place"),
            Self::LeaderElsewhere => f.write_str("the leader is not at its place"),
            Self::NoSight => f.write_str("sensors do not cover the carriageway"),
            Self::Vehicle(_) => f.write_str("a vehicle can no longer stop comfortably"),
            Self::Missed => {
                f.write_str("packets were dropped, and a vehicle may come that was not heard")
            }
            Self::NoPromise(station) => {
                write!(f, "vehicle {station} has not said that it will stop")
            }
            Self::KeptClosed => f.write_str("somebody has closed the corridor, until they open it"),
            Self::Object => {
                f.write_str("something without a class is on the crossing, and may be a person")
            }
        }
    }
}

/// Outputs of the crossing machine.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Output {
    /// To the protocol: an event.
    Tell(Event),
    /// To the protocol: a command to a follower.
    Order(StationId, Leg),
    /// To a vehicle: will it stop before the crossing, with its front there?
    Ask(StationId, Point),
    /// To the sign: show go for so long from now.
    Go(Millis),
    /// To the sign: show stop.
    Stop,
    /// To the body: go to the leader's place, or home from the carriageway.
    WalkTo(Point),
    /// To the body: stand until [`GoOn`](Self::GoOn); its person is behind, or vehicles have to pass before it steps on the road.
    Wait,
    /// To the body: go on.
    GoOn,
    /// To the body: it need not hold any more.
    Release,
    /// To the log: a frame was dropped.
    Dropped(FrameDrop),
    /// To the log: why an open corridor is closed, or what besides guards on their way keeps people who wait from crossing, or
    /// guards on the road.
    Hindered(Hindrance),
    /// To the log: a person said that the road is clear while another robot's sign may show go. It is to be said again.
    SaidTooEarly,
}

/// Capacity for outputs of one step.
pub const MAX_OUTPUTS: usize = 2 * MAX_FOLLOWERS + 16;

/// The outputs of one step, in order.
pub type Outputs = List<Output, MAX_OUTPUTS>;
