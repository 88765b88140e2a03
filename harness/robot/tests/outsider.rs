//! Protection that a moment, or one station, takes away from a person on the road.

mod support;
#[path = "support/zone.rs"]
mod zone;

use crossguard_codec::its::ItsMessage;
use crossguard_codec::{Identifiers, Kind};
use crossguard_endpoint::ras::area::Area;
use crossguard_endpoint::ras::clustering::PerceivedVru;
use crossguard_endpoint::station::Security;
use crossguard_endpoint::{Effect, Stimulus};
use crossguard_protocol::{Event, Input, Phase};
use crossguard_robot::body::Build;
use crossguard_robot::machine::Machine;
use crossguard_robot::perception::SensorFrame;
use crossguard_robot::plan::Plan;
use crossguard_robot::site::{Place, Site};
use crossguard_robot::street::Road;

use self::support::{Street, TICK_MS, effects};

fn machine(station: u32, plan: Option<Plan>, road: Road) -> Machine {
    let place = Place::new(-f64::from(station), -2.0);
    let body = (Build::Quadruped, place, 5.0);
    support::machine(station, body, plan, road, Security::default())
}

fn is_escorting(street: &mut Street<Done>) -> bool {
    match street.robot(1).endpoint.robot().phase() {
        Phase::Following(following) => following
            .executing()
            .is_some_and(|it| it.task == crossguard_protocol::TaskType::MOVE),
        _ => false,
    }
}

#[derive(Default)]
struct Done {
    /// Whether the follower has said that it sees nobody any more.
    sees_nobody: bool,
    /// How many RAM of the leader had people, and how many there were.
    announced: (u32, u32),
}

fn note(done: &mut Done, robot: usize, effect: Effect) {
    match effect {
        Effect::Stepped {
            input: Input::Local(Event::RoadClear),
            ..
        } if robot == 1 => done.sees_nobody = true,
        Effect::Transmit { octets, .. } if robot == 0 => {
            let message = ItsMessage::decode(&Identifiers::default(), &octets).unwrap();
            let users = message.message.road_users(support::BEGAN_ITS);
            if users.iter().any(|it| it.kind == Kind::Robot) {
                let has_people = users.iter().any(|it| it.kind == Kind::Vru);
                done.announced.0 += u32::from(has_people);
                done.announced.1 += 1;
            }
        }
        _ => {}
    }
}

/// A leader that knows nothing of the road, told by a person, and an escort whose sensors have the near half of it.
fn street() -> Street<Done> {
    let plan = Plan::crossing(Site::default());
    let request = plan.request();
    let leader = machine(2, Some(plan), Road::Unknown);
    let follower = machine(3, None, Road::Watched(zone::of_the_crossing()));
    let mut street = Street::new(vec![Some(leader), Some(follower)], note);
    street.pass(100);
    street.tell(0, Stimulus::Event(Event::PedestrianDetected(request)));
    while !is_escorting(&mut street) {
        assert!(street.now_ms < 30_000, "nobody escorts");
        street.pass(TICK_MS);
    }
    street
}

/// When the escort says that nobody is in its half any more, and whether it has a duty where its leader leaves at that time.
fn says_clear_at(leaves_ms: Option<u32>) -> (u32, bool) {
    let mut street = street();
    let near = [[-13.0, 0.0], [15.0, 0.0], [15.0, 3.5], [-13.0, 3.5]];
    let began_ms = street.now_ms;
    while leaves_ms.map_or(!street.notes.sees_nobody, |ms| street.now_ms < ms) {
        assert!(
            street.now_ms < began_ms + 10_000,
            "it sees somebody for ever"
        );
        if street.now_ms.is_multiple_of(100) {
            // A person walks on into the other half, where nobody looks.
            let is_near = street.now_ms < began_ms + 500;
            let person = [PerceivedVru::pedestrian(7, [1.0, 1.5])];
            let frame = SensorFrame {
                covers: Some(Area::Polygon(near.to_vec())),
                ..SensorFrame::of(&person[..usize::from(is_near)])
            };
            let (now_s, taken_ms) = (f64::from(street.now_ms) / 1e3, street.now_ms.into());
            let follower = &mut street.robot(1).application;
            follower.look_at(now_s, &frame, taken_ms);
        }
        street.now_ms += TICK_MS;
        if Some(street.now_ms) == leaves_ms {
            street.tell(0, Stimulus::Event(Event::LeaveRequested));
        }
        for robot in [1, 0] {
            street.tell(robot, Stimulus::Time);
        }
    }
    let at_ms = street.now_ms;
    let has_duty = |street: &mut Street<Done>| street.robot(1).endpoint.robot().duty().is_some();
    let at_once = has_duty(&mut street);
    street.pass(1_000);
    (at_ms, at_once && has_duty(&mut street))
}

/// Hazard: a guard says that it sees nobody in its half of the road in the moment in which its leader goes, and leaves its duty by
/// that word.
#[test]
fn a_word_of_before_a_duty_does_not_end_it() {
    let (at_ms, has_duty) = says_clear_at(None);
    assert!(!has_duty, "the session goes on");
    for leaves_ms in [at_ms - TICK_MS, at_ms, at_ms + TICK_MS] {
        let (_, has_duty) = says_clear_at(Some(leaves_ms));
        assert!(has_duty, "the leader leaves at {leaves_ms}, {at_ms}");
    }
}

/// Hazard: a robot outside of the session announces everybody around, so the leader does not, and its escort hears of nobody.
#[test]
fn a_leader_announces_people_to_its_team_whatever_others_announce() {
    let person = [PerceivedVru::pedestrian(7, [2.0, 3.0])];
    let announced = |street: &mut Street<Done>| {
        let mut other = machine(1, None, Road::Unknown);
        street.notes.announced = (0, 0);
        for _ in 0..300 {
            street.now_ms += TICK_MS;
            let (now_ms, arrived_ms) = (street.now_ms, street.now_ms.into());
            if now_ms.is_multiple_of(100) {
                street.tell(0, Stimulus::Perceived(&person));
                let people = [PerceivedVru::pedestrian(7, [1.0, 3.0])];
                for effect in effects(&mut other, now_ms, Stimulus::Perceived(&people)) {
                    if let Effect::Transmit { packet, .. } = &effect {
                        street.tell(0, Stimulus::Datagram { packet, arrived_ms });
                    }
                }
            }
            for robot in 0..2 {
                street.tell(robot, Stimulus::Time);
            }
        }
        street.notes.announced
    };
    let idle = vec![
        Some(machine(2, None, Road::Unknown)),
        Some(machine(3, None, Road::Unknown)),
    ];
    let (with, all) = announced(&mut Street::new(idle, note));
    assert!(with < all / 2, "idle: {with} of {all}, the other one does");
    let (with, all) = announced(&mut street());
    assert!(with > all / 2, "leading: {with} of {all}");
}
