//! A robot that leads by itself and watches a crossing zone: a person who waits is helped across without
//! anybody's word. The decisions of the crossing machine are tested in its own crate.

mod support;
#[path = "support/zone.rs"]
mod zone;

use crossguard_codec::{Identity, Kind, RoadUser};
use crossguard_endpoint::cause::Cause;
use crossguard_endpoint::ras::clustering::PerceivedVru;
use crossguard_endpoint::station::{LocalDynamicMap, Security};
use crossguard_endpoint::{Effect, Moment, Stimulus};
use crossguard_protocol::{EndReason, Event, Input, Millis, Notice, Output, Phase, Role, Urgency};
use crossguard_robot::body::Build;
use crossguard_robot::machine::{Machine, is_at_rest};
use crossguard_robot::perception::SensorFrame;
use crossguard_robot::plan::Plan;
use crossguard_robot::site::{Place, Site};
use crossguard_robot::street::Road;

use self::support::{BEGAN_ITS, Street, TICK_MS};

/// How many times as fast as real the bodies move.
const SPEED: f64 = 5.0;

fn machine(station: u32, build: Build, plan: Option<Plan>, road: Road) -> Machine {
    let place = Place::new(-f64::from(station), -2.0);
    support::machine(
        station,
        (build, place, SPEED),
        plan,
        road,
        Security::default(),
    )
}

/// Calls, ends and sign of a leader that watches a zone.
#[derive(Default)]
struct Done {
    calls: Vec<Urgency>,
    ends: Vec<EndReason>,
    /// Whether its sign shows go.
    go: bool,
}

impl Done {
    fn note(&mut self, _: usize, effect: Effect) {
        match effect {
            Effect::Stepped {
                input: Input::Local(Event::PedestrianDetected(request)),
                outputs,
                ..
            } if outputs.ignored().is_none() => self.calls.push(request.urgency),
            Effect::Act(Output::Notify(Notice::SessionEnded(_, why)), _) => self.ends.push(why),
            Effect::Act(Output::CorridorOpened(_), _) => self.go = true,
            Effect::Act(Output::CorridorClosed(_), _) => self.go = false,
            _ => {}
        }
    }
}

/// A leader that watches a zone, and a helper.
struct Crossing(Street<Done>);

impl std::ops::Deref for Crossing {
    type Target = Done;

    fn deref(&self) -> &Done {
        &self.0.notes
    }
}

impl Crossing {
    fn new() -> Self {
        let plan = Some(Plan::crossing(Site::default()));
        let leader = machine(
            1,
            Build::Humanoid,
            plan,
            Road::Watched(zone::of_the_crossing()),
        );
        let helper = machine(2, Build::Quadruped, None, Road::Unknown);
        Self(Street::new(vec![Some(leader), Some(helper)], Done::note))
    }

    /// Time passes, and the leader's sensors have this person, who goes on as they do.
    fn pass(&mut self, ms: u32, mut vru: Option<&mut PerceivedVru>) {
        for _ in 0..ms / TICK_MS {
            if (self.0.now_ms + TICK_MS).is_multiple_of(100)
                && let Some(vru) = &mut vru
            {
                let frame = SensorFrame::of(&[**vru]);
                let leader = self.0.robot(0);
                leader.application.look(&frame, Millis(0));
                let [vx, vy] = vru.velocity_mps;
                vru.position_m = [vru.position_m[0] + vx * 0.1, vru.position_m[1] + vy * 0.1];
            }
            self.0.pass(TICK_MS);
        }
    }

    /// The same until something is so, for half a minute at most.
    fn pass_until(&mut self, vru: &mut PerceivedVru, is: impl Fn(&Self) -> bool) {
        let until_ms = self.0.now_ms + 30_000;
        while !is(self) {
            assert!(self.0.now_ms < until_ms, "{:?} {:?}", self.calls, self.ends);
            self.pass(TICK_MS, Some(vru));
        }
    }

    fn all_rest(&self) -> bool {
        let mut robots = self.0.robots.iter().flatten();
        robots.all(|it| is_at_rest(it.endpoint.robot()))
    }
}

fn person(east: f64, north: f64) -> PerceivedVru {
    PerceivedVru {
        confidence: 0.9,
        ..PerceivedVru::pedestrian(7, [east, north])
    }
}

#[test]
fn a_person_who_waits_is_helped_across_from_either_side() {
    for (kerb, way_mps) in [(-0.8, 1.4), (7.8, -1.4)] {
        let mut crossing = Crossing::new();
        let mut waiting = person(1.0, kerb);
        crossing.pass_until(&mut waiting, |it| it.go);
        assert_eq!(crossing.calls, [Urgency::Medium]);
        // The helper has come to the side where the person waits.
        let helper = crossing.0.robot(1).application.body().place();
        assert!((helper.north - kerb).abs() < 2.0, "{helper:?} for {kerb}");
        waiting.velocity_mps = [0.0, way_mps];
        crossing.pass(6_500, Some(&mut waiting));
        assert!(!(0.0..=7.0).contains(&waiting.position_m[1]), "across");
        crossing.pass_until(&mut waiting, |it| !it.ends.is_empty() && it.all_rest());
        assert_eq!(crossing.ends, [EndReason::TaskCompleted]);
        waiting.velocity_mps = [0.0, 0.0];
        crossing.pass(5_000, Some(&mut waiting));
        assert_eq!(crossing.calls.len(), 1, "a person over there is no call");
    }
}

#[test]
fn the_session_waits_for_a_person_who_is_slow_on_the_road() {
    let mut crossing = Crossing::new();
    let mut slow = person(1.0, -0.3);
    crossing.pass_until(&mut slow, |it| it.go);
    slow.velocity_mps = [0.0, 0.55];
    crossing.pass(12_000, Some(&mut slow));
    assert!(slow.position_m[1] < 7.0, "still on the road");
    assert_eq!(
        crossing.ends,
        [],
        "the escort has arrived, the person has not"
    );
    crossing.pass_until(&mut slow, |it| !it.ends.is_empty() && it.all_rest());
    assert_eq!(crossing.ends, [EndReason::TaskCompleted]);
    assert!(slow.position_m[1] > 7.0);
}

/// Hazard: somebody floods the leader with packets, a car that comes meanwhile is not heard, and go begins in front of it. The team is
/// heard all the same: its robots have places of their own.
#[test]
fn nobody_is_let_across_while_packets_are_dropped() {
    let mut crossing = Crossing::new();
    let mut waiting = person(1.0, -0.8);
    let mut is_flooded = |crossing: &mut Crossing| {
        crossing.0.robot(0).miss(Cause::InboxFull);
        crossing.pass(100, Some(&mut waiting));
    };
    // Without a flood it takes less than 10 s.
    (0..300).for_each(|_| is_flooded(&mut crossing));
    assert_eq!((crossing.go, &crossing.ends[..]), (false, &[][..]));
    crossing.pass_until(&mut waiting, |it| it.go);
    let opened_ms = crossing.0.now_ms;
    assert!((34_000..36_000).contains(&opened_ms), "{opened_ms}");
    // People who are on the road keep their guards.
    waiting.velocity_mps = [0.0, 1.4];
    crossing.pass(2_000, Some(&mut waiting));
    crossing.0.robot(0).miss(Cause::InboxFull);
    crossing.pass(100, Some(&mut waiting));
    assert!(!crossing.go && (0.0..=7.0).contains(&waiting.position_m[1]));
    crossing.pass(1_000, Some(&mut waiting));
    let helper = crossing.0.robot(1).endpoint.robot();
    assert!(matches!(helper.phase(), Phase::Following(_)), "{helper:?}");
    crossing.pass_until(&mut waiting, |it| !it.ends.is_empty() && it.all_rest());
    assert_eq!(crossing.ends, [EndReason::TaskCompleted]);
}

#[test]
fn a_person_who_tells_of_themselves_by_vam_is_called_for() {
    let mut crossing = Crossing::new();
    while crossing.calls.is_empty() {
        let now_ms = crossing.0.now_ms;
        assert!(now_ms <= 3_000, "nobody is called");
        let user = RoadUser {
            identity: Identity::Station(200),
            kind: Kind::Vru,
            station_type: None,
            position: Site::default().position(Place::new(1.0, -0.8)),
            speed: Some(0.0),
            heading: None,
            length: None,
            cardinality: 1,
            signals: None,
            measured_its: BEGAN_ITS + u64::from(now_ms),
        };
        let mut map = LocalDynamicMap::default();
        map.observe(user, now_ms.into());
        let leader = crossing.0.robot(0);
        let robot = leader.endpoint.robot().clone();
        let application = &mut leader.application;
        application.listen(&map, &robot, Moment::after(BEGAN_ITS, now_ms.into()));
        crossing.pass(500, None);
    }
}

/// Hazard: a robot that watches one crossing is recruited at another one, 200 m away, and goes by the kerbs of its own.
#[test]
fn a_robot_that_watches_a_crossing_helps_nobody_at_another_one() {
    for (east, helps) in [(-20.0, true), (-200.0, false)] {
        let robot = |station, east, road| {
            let body = (Build::Quadruped, Place::new(east, -2.0), SPEED);
            support::machine(station, body, None, road, Security::default())
        };
        let leader = robot(1, east, Road::Unknown);
        let helper = robot(2, -2.0, Road::Watched(zone::of_the_crossing()));
        let mut street = Street::new(vec![Some(leader), Some(helper)], Done::note);
        let request = Plan::crossing(Site::default()).request();
        street.tell(0, Stimulus::Event(Event::PedestrianDetected(request)));
        street.pass(3_000);
        let helper = &street.robot(1).endpoint;
        assert_eq!(helper.robot().role() == Role::Follower, helps, "{east} m");
        let dropped = helper.counters().of(Cause::OtherCrossing);
        assert_eq!(dropped == 0, helps, "{east} m");
    }
}
