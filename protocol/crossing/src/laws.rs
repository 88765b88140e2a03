//! The laws of one step, as functions that assert, and arbitrary values to call them with.
//!
//! Property P7, *less evidence, fewer permissions*, is true of beliefs and not of every act: a machine that learnt
//! less may act later, and then the other one has acted already. So the laws compare what is believed.
//!
//! | law | says |
//! |---|---|
//! | [`total`] | every input in every state has an outcome; go is put out only where nothing hinders |
//! | [`repeated`] | an observation that is repeated changes nothing |
//! | [`less_support`] | without an empty frame, the road is clear only where it is clear with it |
//! | [`late_support`] | nor is it because that frame came late |
//! | [`more_against`] | a person, a malformed or a stale frame make nothing safer |
//! | [`one_more_vehicle`] | nor does a vehicle that was not known before |
//! | [`starts_on_the_road`] | a robot on the carriageway goes home after its start only once it knows that nobody is there, or people had the time to get across |

#![expect(clippy::missing_panics_doc, reason = "laws assert")]

#[cfg(test)]
mod tests;

use crossguard_protocol::laws::Source;
use crossguard_protocol::laws::arbitrary::{self, Any};
use crossguard_protocol::{Config, FallbackPolicy, Maneuver, Millis, Notice, Role, StationId};

use crate::{
    BodyReport, Coverage, Crossing, Frame, FrameDrop, Ground, Input, Leg, Output, Outputs, Plan,
    Point, Pose, RoadUser, Setup, Shape, Sighting, Stage, Vehicle, Way,
};

/// How many tracks the machine of a law has room for.
const TRACKS: usize = 2;

/// How many inputs come before and after those that a law is about.
const STEPS: u32 = 12;

/// A machine of a law.
type Machine = Crossing<TRACKS>;

/// One input that owns what it says, or what the protocol knows.
#[derive(Clone, Debug)]
#[allow(clippy::large_enum_variant, reason = "there is no heap")]
enum Told {
    Input(Input<'static>),
    Frame(Look, Option<Sighting>),
}

/// A frame without the people.
#[derive(Clone, Copy, Debug)]
struct Look {
    source: u8,
    age: Millis,
    covers: Coverage,
}

impl Told {
    fn to(&self, machine: &mut Machine, setup: &Setup) -> Outputs {
        match self {
            Self::Input(input) => machine.step(setup, *input),
            Self::Frame(look, person) => {
                let frame = Frame {
                    source: look.source,
                    age: look.age,
                    covers: look.covers,
                    sightings: person.as_slice(),
                };
                machine.step(setup, Input::Frame(frame))
            }
        }
    }
}

pub(crate) fn millis(source: &mut impl Source, hint: u32) -> Millis {
    Millis(source.number(u32::MAX, hint))
}

/// Whether something so old is newer than something so old; what never was is older than everything.
pub(crate) fn is_newer(age: Option<Millis>, than: Option<Millis>) -> bool {
    age.is_some_and(|age| than.is_none_or(|than| age < than))
}

fn centimetres(source: &mut impl Source, hint: i32) -> i32 {
    source.number(u32::MAX, hint.cast_unsigned()).cast_signed()
}

fn point(source: &mut impl Source) -> Point {
    let (east, north) = (source.number(8, 9), source.number(8, 9));
    let near = |number: u32| i32::try_from(number).unwrap_or_default() * 100 - 200;
    if source.likely(Some(true)) {
        Point::new(near(east), near(north))
    } else {
        Point::new(centimetres(source, 0), centimetres(source, 300))
    }
}

fn way(source: &mut impl Source) -> Way {
    Way {
        east_cm: centimetres(source, 1_000),
        north_cm: centimetres(source, 0),
    }
}

fn sighting(source: &mut impl Source) -> Sighting {
    let what = match source.number(4, 0) {
        0 => RoadUser::Pedestrian,
        1 => RoadUser::WheelchairUser,
        2 => RoadUser::Bicyclist,
        3 => RoadUser::Animal,
        _ => RoadUser::Vehicle,
    };
    Sighting {
        id: source.flag().then(|| source.number(u32::MAX, 1)),
        at: point(source),
        error_cm: source.u16(10),
        velocity: source.flag().then(|| way(source)),
        what,
        confidence: source.u8(90),
    }
}

fn vehicle(source: &mut impl Source, key: u32) -> Vehicle {
    Vehicle {
        key: key.into(),
        station: source.flag().then_some(StationId(key)),
        at: point(source),
        front_cm: source.u16(600),
        length_cm: source.u16(1_200),
        error_cm: source.u16(10),
        velocity: way(source),
        goes_anywhere: source.flag(),
    }
}

fn pose(source: &mut impl Source) -> Option<Pose> {
    source.likely(Some(true)).then(|| Pose {
        at: point(source),
        error_cm: source.u16(10),
    })
}

fn look(source: &mut impl Source) -> Look {
    Look {
        source: source.u8(0),
        age: millis(source, 0),
        covers: Coverage(source.number(u32::MAX, u32::MAX - 1) | u32::from(source.flag())),
    }
}

/// A street of 4 m by 4 m with any rules, with a plan that blocks or without.
fn setup(source: &mut impl Source) -> Setup {
    let rectangle = |south: i32, north: i32| {
        let corners = [(0, south), (400, south), (400, north), (0, north)];
        Shape::new(&corners.map(|(east, north)| Point::new(east, north)))
    };
    let mut setup = Setup {
        watches: source.flag(),
        ground: Ground {
            road: rectangle(0, 400),
            crossing: None,
            waiting: rectangle(-200, 600),
            parts: Coverage(1 + source.number(2, 0)),
        },
        ..Setup::default()
    };
    setup.sensors.miss_max = if source.likely(Some(true)) {
        1
    } else {
        source.u8(2)
    };
    setup.sensors.error_cm = source.u16(20);
    setup.sensors.age_max = millis(source, 500);
    setup.sensors.gap_max = millis(source, 500);
    setup.sensors.speed_max_cmps = source.u16(400);
    setup.waiting.dwell = millis(source, 200);
    setup.waiting.clear = millis(source, 3_000);
    setup.waiting.approach = millis(source, 3_000);
    setup.waiting.speed_max_cmps = source.u16(50);
    setup.traffic.reaction = millis(source, 2_000);
    setup.traffic.deceleration_cmps2 = source.u16(300);
    setup.traffic.keep = millis(source, 5_000);
    setup.traffic.asks = millis(source, 10_000);
    setup.position.lease = millis(source, 1_000);
    setup.position.ahead_cm = source.u16(200);
    setup.t_safety = millis(source, 300);
    setup.plan = source.flag().then(|| Plan {
        followers: 1,
        stages: core::iter::once(Stage::everybody(Leg {
            task: arbitrary::Any::any(source),
            to: point(source),
            speed_mmps: 1_000,
            heading_ddeg: None,
        }))
        .collect(),
        roles: crossguard_protocol::List::EMPTY,
        own_place: source.flag().then(|| point(source)),
        patience: millis(source, 60_000),
        kerbs: source.flag().then(|| [point(source), point(source)]),
    });
    setup
}

/// An observation: time, people, vehicles and positions.
fn observation(source: &mut impl Source) -> Told {
    Told::Input(match source.number(10, 0) {
        0..3 => Input::Elapsed(millis(source, 100)),
        3 | 4 => {
            let look = look(source);
            return Told::Frame(look, source.flag().then(|| sighting(source)));
        }
        5 => Input::BadFrame,
        6 => Input::Heard(
            StationId(source.number(1, 0)),
            sighting(source),
            millis(source, 100),
        ),
        7 => {
            let key = source.number(u32::MAX, 1);
            match source.number(4, 0) {
                0..3 => Input::Vehicle(vehicle(source, key), millis(source, 100)),
                3 => Input::Answered(StationId(key), source.flag()),
                _ => Input::Missed(millis(source, 5_000)),
            }
        }
        8 => Input::Object(point(source)),
        _ => {
            let station = StationId(source.number(u32::MAX, arbitrary::PEER));
            if source.flag() {
                Input::Pose(pose(source), millis(source, 100))
            } else {
                Input::FollowerAt(station, pose(source), millis(source, 100))
            }
        }
    })
}

/// An observation, most of the time of an empty road.
fn calm(source: &mut impl Source, step: u32) -> Told {
    if !source.likely(Some(true)) {
        return observation(source);
    }
    if step.is_multiple_of(2) {
        return Told::Input(Input::Elapsed(Millis(100)));
    }
    let look = Look {
        source: 0,
        age: Millis::ZERO,
        covers: Coverage::ALL,
    };
    Told::Frame(look, None)
}

/// Anything.
fn anything(source: &mut impl Source) -> Told {
    Told::Input(match source.number(10, 0) {
        0 => Input::Body(match source.number(2, 0) {
            0 => BodyReport::InPosition(Any::any(source)),
            1 => BodyReport::Completed(Any::any(source)),
            _ => BodyReport::Gone,
        }),
        1 => Input::BodyIsFree(source.flag()),
        2 => Input::Started(Any::any(source), source.flag().then(|| point(source))),
        3 => Input::Stopped,
        4 => Input::FellBack(Maneuver::any(source), FallbackPolicy::any(source)),
        5 => Input::Notice(Notice::any(source)),
        6 => Input::CorridorOpen(millis(source, 1_900)),
        7 => Input::CorridorClosed,
        8 => Input::CallIgnored,
        9 => Input::Said(Any::any(source)),
        _ => Input::SaidClear,
    })
}

/// The state of the protocol: any robot.
fn learn(machine: &mut Machine, setup: &Setup, source: &mut impl Source) -> Outputs {
    let role = match source.number(4, 3) {
        0 => Role::None,
        1 => Role::Requester,
        2 => Role::Helper,
        3 => Role::Leader,
        _ => Role::Follower,
    };
    let robot = arbitrary::robot(source, &Config::default(), role, (1, 2));
    machine.learn(setup, &robot)
}

/// A machine after some inputs.
fn machine(source: &mut impl Source, setup: &Setup) -> Machine {
    let mut machine = Machine::default();
    for _ in 0..source.number(STEPS, STEPS) {
        match source.number(3, 0) {
            0 => drop(learn(&mut machine, setup, source)),
            1 => drop(anything(source).to(&mut machine, setup)),
            _ => drop(observation(source).to(&mut machine, setup)),
        }
    }
    for step in 0..source.number(STEPS, STEPS) {
        calm(source, step).to(&mut machine, setup);
    }
    machine
}

/// Every input in every state has an outcome, and go is put out only where nothing hinders.
pub fn total(source: &mut impl Source) {
    let setup = setup(source);
    let mut machine = machine(source, &setup);
    for _ in 0..STEPS {
        let out = match source.number(2, 0) {
            0 => learn(&mut machine, &setup, source),
            1 => anything(source).to(&mut machine, &setup),
            _ => observation(source).to(&mut machine, &setup),
        };
        let goes = out.iter().any(|it| matches!(it, Output::Go(_)));
        if goes {
            assert!(machine.hindered(&setup).is_none());
            assert!(!out.iter().any(|it| *it == Output::Stop));
        }
        let opens = Output::Tell(crossguard_protocol::Event::OpenCorridor);
        if out.iter().any(|it| *it == opens) {
            assert!(machine.hindered(&setup).is_none());
        }
    }
}

/// An observation that is repeated changes nothing.
pub fn repeated(source: &mut impl Source) {
    let setup = setup(source);
    let mut once = machine(source, &setup);
    let told = observation(source);
    if matches!(told, Told::Input(Input::Elapsed(_))) {
        return;
    }
    told.to(&mut once, &setup);
    let mut twice = once.clone();
    told.to(&mut twice, &setup);
    assert_eq!(once, twice, "{told:?}");
}

fn is_clear(machine: &Machine, setup: &Setup) -> bool {
    machine.is_clear(setup)
}

/// By all later inputs, `less` has no clear road where `more` has none. An input that one of them would drop
/// because it comes out of order neither is told: it would take something from that one alone.
fn is_never_safer(
    source: &mut impl Source,
    setup: &Setup,
    (mut less, mut more): (Machine, Machine),
) {
    for step in 0..STEPS {
        assert!(!is_clear(&less, setup) || is_clear(&more, setup));
        let told = calm(source, step);
        let mut next = more.clone();
        let out = told.to(&mut next, setup);
        let is_late = |it: &Output| matches!(it, Output::Dropped(FrameDrop::OutOfOrder));
        if out.iter().any(is_late) {
            continue;
        }
        more = next;
        told.to(&mut less, setup);
    }
}

/// Without an empty frame that covers everything, the road is clear only where it is clear with it.
pub fn less_support(source: &mut impl Source) {
    let setup = setup(source);
    let less = machine(source, &setup);
    let mut more = less.clone();
    let covers = Coverage::ALL;
    let look = Look {
        covers,
        ..look(source)
    };
    if look.age > setup.sensors.age_max {
        return;
    }
    let out = Told::Frame(look, None).to(&mut more, &setup);
    if out.is_empty() {
        is_never_safer(source, &setup, (less, more));
    }
}

/// A road is clear because of a frame that came late only where it is clear when that frame comes at once.
pub fn late_support(source: &mut impl Source) {
    let setup = setup(source);
    let mut less = machine(source, &setup);
    let mut more = less.clone();
    let by = millis(source, 100);
    let covers = Coverage::ALL;
    let soon = Look {
        covers,
        ..look(source)
    };
    let late = Look {
        age: soon.age.saturating_add(by),
        ..soon
    };
    let out = Told::Frame(soon, None).to(&mut more, &setup);
    let passed = Told::Input(Input::Elapsed(by));
    passed.to(&mut more, &setup);
    passed.to(&mut less, &setup);
    Told::Frame(late, None).to(&mut less, &setup);
    if out.is_empty() {
        is_never_safer(source, &setup, (less, more));
    }
}

/// A person, something without a class, a malformed or a stale frame make nothing safer.
pub fn more_against(source: &mut impl Source) {
    let setup = setup(source);
    let without = machine(source, &setup);
    let mut with = without.clone();
    let on_road = Sighting {
        at: Point::new(200, 200),
        what: RoadUser::Pedestrian,
        ..sighting(source)
    };
    let against = match source.number(4, 0) {
        0 => Told::Frame(look(source), Some(on_road)),
        1 => Told::Input(Input::BadFrame),
        2 => Told::Input(Input::Heard(StationId(0), on_road, millis(source, 100))),
        3 => Told::Input(Input::Object(on_road.at)),
        _ => {
            let age = setup.sensors.age_max.saturating_add(Millis(1));
            if age == setup.sensors.age_max {
                return;
            }
            let stale = Look {
                age,
                ..look(source)
            };
            Told::Frame(stale, None)
        }
    };
    against.to(&mut with, &setup);
    is_never_safer(source, &setup, (with, without));
}

/// A vehicle that was not known before, one that may have been missed, and a refusal to stop, hinders or changes nothing.
pub fn one_more_vehicle(source: &mut impl Source) {
    let setup = setup(source);
    let without = machine(source, &setup);
    let mut with = without.clone();
    let key = 77_777_777;
    let told = match source.number(4, 0) {
        0..3 => Input::Vehicle(vehicle(source, key), millis(source, 100)),
        3 => Input::Answered(StationId(source.number(u32::MAX, 1)), false),
        _ => Input::Missed(millis(source, 5_000)),
    };
    with.step(&setup, told);
    assert!(with.hindered(&setup).is_some() || without.hindered(&setup).is_none());
}

/// A robot that finds itself on the carriageway when it starts goes home only once the road has been clear since signs that
/// counted on it have ended, or people who set out by them had the time to get across. Whether it goes because the road is clear.
pub fn starts_on_the_road(source: &mut impl Source) -> bool {
    let home = Point::new(-300, -300);
    let setup = Setup {
        home: Some(home),
        ..setup(source)
    };
    let set_out = setup.t_safety.saturating_add(setup.waiting.step_off);
    let across = set_out.saturating_add(setup.crossing_time());
    let pose = Pose {
        at: Point::new(200, 200),
        error_cm: 0,
    };
    let mut machine = Machine::default();
    let (mut since, mut was_clear) = (Millis::ZERO, false);
    for step in 0..8 * STEPS {
        machine.step(&setup, Input::Pose(Some(pose), Millis::ZERO));
        let told = calm(source, step);
        if matches!(told, Told::Input(Input::Pose(..))) {
            continue;
        }
        let out = told.to(&mut machine, &setup);
        if let Told::Input(Input::Elapsed(time)) = told {
            since = since.saturating_add(time);
        }
        was_clear |= since >= set_out && is_clear(&machine, &setup);
        if out.iter().any(|it| *it == Output::WalkTo(home)) {
            assert!(was_clear || since >= across, "{since:?} of {across:?}");
            return since < across;
        }
    }
    false
}
