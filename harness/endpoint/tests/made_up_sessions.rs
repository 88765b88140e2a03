//! Claims to a part in sessions that never were: they bring about no RAM each, and take no farewell's place.

use crossguard_codec::geonet::{EgoPosition, Stack};
use crossguard_codec::{Identifiers, RobotState, Service, encode, ram_from};
use crossguard_endpoint::cause::Cause;
use crossguard_endpoint::{Effect, Endpoint, Moment, Stimulus};
use crossguard_protocol::{
    Availability, Config, Coordination, Ending, Event, Farewell, Heartbeat, HelpRequest, Ignored,
    Place, Ram, Robot, SessionId, SessionNumber, StationId, TaskSet, TaskType, UniqueNumber,
    Urgency,
};

const LEADER: StationId = StationId(1);
const LIAR: StationId = StationId(9);

fn moment(now_ms: u64) -> Moment {
    Moment::after(694_694_401_000, now_ms)
}

/// A packet in which the liar follows a session of the leader that never was.
fn claim(stack: &mut Stack, count: u16) -> Vec<u8> {
    let number = UniqueNumber { boot: 0, count };
    let ram = Ram {
        station: LIAR,
        coordination: Coordination::Follower {
            session: SessionId {
                leader: LEADER,
                number: SessionNumber(number),
            },
            echo: Heartbeat(0),
            last: None,
        },
        farewell: None,
        on_duty: false,
    };
    let (ids, state) = (Identifiers::default(), RobotState::default());
    let ram = ram_from(&ids, &state, &ram, Availability::Available, 0, false).unwrap();
    let message = encode(&ids, &ram).unwrap();
    let ego = EgoPosition::default();
    stack.packet(&ego, Service::Ram, &message).unwrap()
}

fn leader() -> Endpoint {
    let robot = Robot::new(LEADER, 1);
    Endpoint::new(robot, Config::default(), Identifiers::default(), 0)
}

/// How many RAM a leader sends when it hears a packet.
fn sent(leader: &mut Endpoint, now_ms: u64, stimulus: Stimulus<'_>) -> usize {
    let effects = leader.handle(moment(now_ms), &RobotState::default(), stimulus);
    let is_ram = |effect: &&Effect| {
        matches!(
            effect,
            Effect::Transmit {
                kind: Service::Ram,
                ..
            }
        )
    };
    effects.iter().filter(is_ram).count()
}

fn hear(leader: &mut Endpoint, now_ms: u64, packet: &[u8]) -> usize {
    let arrived_ms = now_ms;
    sent(leader, now_ms, Stimulus::Datagram { packet, arrived_ms })
}

#[test]
fn made_up_numbers_bring_about_no_ram_each() {
    let mut stack = Stack::of_robot(Identifiers::default(), LIAR);
    let mut leader = leader();
    // Every two milliseconds for four seconds another number.
    let sent: usize = (0..2_000)
        .map(|count| {
            hear(
                &mut leader,
                1_000 + 2 * u64::from(count),
                &claim(&mut stack, count),
            )
        })
        .sum();
    // One in a RAM period while it names a session as over, and one at once in each time of a farewell.
    assert!((4..=4 * 10 + 5).contains(&sent), "{sent} RAM");
    let turned_away = leader
        .counters()
        .of(Cause::Ignored(Ignored::AnsweringAnother));
    assert!(turned_away > 1_900, "{turned_away}");
}

#[test]
fn the_end_of_a_session_is_named_whatever_a_liar_claims() {
    let mut stack = Stack::of_robot(Identifiers::default(), LIAR);
    let mut leader = leader();
    let request = HelpRequest {
        urgency: Urgency::High,
        followers: 1,
        tasks: TaskSet::of(&[TaskType::MOVE]),
        place: Place::UNKNOWN,
    };
    let detected = Event::PedestrianDetected(request);
    sent(&mut leader, 100, Stimulus::Event(detected));
    let session = leader.robot().session().unwrap();
    sent(&mut leader, 200, Stimulus::Event(Event::TaskCompleted));
    let ended = Some(Farewell::Ended(session.number, Ending::Completed));
    assert_eq!(leader.robot().farewell(), ended);
    for count in 0..10 {
        hear(
            &mut leader,
            210 + u64::from(count),
            &claim(&mut stack, count),
        );
        assert_eq!(leader.robot().farewell(), ended);
    }
    // Once that has been said, who asks is answered.
    hear(&mut leader, 1_300, &claim(&mut stack, 3));
    let number = SessionNumber(UniqueNumber { boot: 0, count: 3 });
    let answered = Some(Farewell::Ended(number, Ending::Aborted));
    assert_eq!(leader.robot().farewell(), answered);
}
