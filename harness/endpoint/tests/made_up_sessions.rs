//! Claims to a part in sessions that never were: they bring about no RAM each, and take no farewell's place.

use crossguard_codec::geonet::Stack;
use crossguard_codec::{Identifiers, Service};
use crossguard_endpoint::Stimulus;
use crossguard_endpoint::cause::Cause;
use crossguard_protocol::{
    Coordination, Ending, Event, Farewell, Heartbeat, Ignored, Place, SessionId, SessionNumber,
    StationId, TaskType, UniqueNumber,
};

use crate::support::{detected, endpoint, handle, hear, ram, sent};

const LEADER: StationId = StationId(1);
const LIAR: StationId = StationId(9);

/// A packet in which the liar follows a session of the leader that never was.
fn claim(stack: &mut Stack, count: u16) -> Vec<u8> {
    let number = UniqueNumber { boot: 0, count };
    let follower = Coordination::Follower {
        session: SessionId {
            leader: LEADER,
            number: SessionNumber(number),
        },
        echo: Heartbeat(0),
        last: None,
    };
    ram(stack, LIAR, follower)
}

#[test]
fn made_up_numbers_bring_about_no_ram_each() {
    let mut stack = Stack::of_robot(Identifiers::default(), LIAR);
    let mut leader = endpoint(LEADER);
    // Every two milliseconds for four seconds another number.
    let sent: usize = (0..2_000)
        .map(|count| {
            let now_ms = 1_000 + 2 * u64::from(count);
            let effects = hear(&mut leader, now_ms, &claim(&mut stack, count));
            sent(&effects, Some(Service::Ram)).len()
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
    let mut leader = endpoint(LEADER);
    let detected = detected(TaskType::MOVE, Place::UNKNOWN);
    handle(&mut leader, 100, Stimulus::Event(detected));
    let session = leader.robot().session().unwrap();
    handle(&mut leader, 200, Stimulus::Event(Event::TaskCompleted));
    let ended = Some(Farewell::Ended(session.number, Ending::Completed));
    assert_eq!(leader.robot().farewell(), ended);
    for count in 0..10 {
        let now_ms = 210 + u64::from(count);
        hear(&mut leader, now_ms, &claim(&mut stack, count));
        assert_eq!(leader.robot().farewell(), ended);
    }
    // Once that has been said, who asks is answered.
    hear(&mut leader, 1_300, &claim(&mut stack, 3));
    let number = SessionNumber(UniqueNumber { boot: 0, count: 3 });
    let answered = Some(Farewell::Ended(number, Ending::Aborted));
    assert_eq!(leader.robot().farewell(), answered);
}
