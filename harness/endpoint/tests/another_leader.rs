//! A leader that goes behind at the same place and does not yield may not hear this robot: that is told, once for its session.

use crossguard_codec::Identifiers;
use crossguard_codec::geonet::Stack;
use crossguard_endpoint::cause::Cause;
use crossguard_endpoint::{Effect, Endpoint, Stimulus};
use crossguard_protocol::{
    Confirmation, Coordination, Heartbeat, Millis, OfferNumber, Place, Role, SessionNumber,
    StationId, TaskSet, TaskType, UniqueNumber, Urgency,
};

use crate::support::{detected, endpoint, handle, hear, ram};

const NUMBER: UniqueNumber = UniqueNumber { boot: 1, count: 0 };
const PLACE: Place = Place(7);
const TASK: TaskType = TaskType::BLOCK;

/// The leader of this test, and its clock.
struct Street {
    leader: Endpoint,
    now_ms: u64,
}

impl Street {
    fn idle() -> Self {
        Self {
            leader: endpoint(StationId(1)),
            now_ms: 100,
        }
    }

    fn detect(&mut self) {
        let detected = Stimulus::Event(detected(TASK, PLACE));
        handle(&mut self.leader, self.now_ms, detected);
    }

    /// An offer of help to it.
    fn offer(&self) -> Coordination {
        Coordination::OfferHelp {
            session: self.leader.robot().session().unwrap(),
            offer: OfferNumber(NUMBER),
            capabilities: TaskSet::of(&[TASK]),
            echo: Heartbeat(0),
            t_safety: Millis(2_000),
        }
    }

    /// 100 ms later the leader hears `coordination` of a station. Returns the causes of drops.
    fn hear(&mut self, from: &mut (StationId, Stack), coordination: Coordination) -> Vec<String> {
        self.now_ms += 100;
        handle(&mut self.leader, self.now_ms, Stimulus::Time);
        let (station, stack) = from;
        let packet = ram(stack, *station, coordination);
        let effects = hear(&mut self.leader, self.now_ms, &packet);
        let dropped = effects.into_iter().filter_map(|effect| match effect {
            Effect::Dropped { cause, detail, .. } => Some(format!("{cause}: {detail}")),
            _ => None,
        });
        dropped.collect()
    }
}

fn station(id: u32) -> (StationId, Stack) {
    let id = StationId(id);
    (id, Stack::of_robot(Identifiers::default(), id))
}

fn leads(count: u16, heartbeat: u16, place: Place, yields: bool) -> Coordination {
    let follower = Confirmation {
        station: StationId(9),
        offer: OfferNumber(NUMBER),
    };
    Coordination::Leader {
        number: SessionNumber(UniqueNumber { boot: 1, count }),
        heartbeat: Heartbeat(heartbeat),
        followers: std::iter::once(follower).collect(),
        urgency: Urgency::Medium,
        place,
        yields,
    }
}

#[test]
fn point_8_a_leader_that_does_not_yield_is_told_once_for_its_session() {
    let mut street = Street::idle();
    street.detect();
    let mut helper = station(2);
    let offer = street.offer();
    while street.leader.robot().role() != Role::Leader {
        street.hear(&mut helper, offer);
    }
    let (mut other, mut third) = (station(3), station(4));
    let told = "protocol: another leader does not yield: station 3 leads at the same place, and may not hear this robot";
    for session in 0..2 {
        let said: Vec<_> = (0..6)
            .map(|beat| {
                // Messages of others in between do not matter.
                assert!(
                    street
                        .hear(&mut third, leads(0, beat, Place(8), false))
                        .is_empty()
                );
                street.hear(&mut other, leads(session, beat, PLACE, false))
            })
            .collect();
        assert_eq!(said.concat(), [told]);
        assert_eq!(said[2], [told]);
    }
    // One that yields at the second RAM, or leads elsewhere, is none.
    for beat in 0..4 {
        let yields = beat > 1;
        assert!(
            street
                .hear(&mut third, leads(1, beat, PLACE, yields))
                .is_empty()
        );
    }
    assert_eq!(street.leader.counters().of(Cause::NotYielding), 2);
}

#[test]
fn a_requester_waits_for_t_select_where_somebody_leads_already() {
    for place in [PLACE, Place(8)] {
        let (mut street, mut helper, mut other) = (Street::idle(), station(2), station(3));
        street.hear(&mut other, leads(0, 0, place, false));
        street.detect();
        let offer = street.offer();
        street.hear(&mut helper, offer);
        let is_leader = street.leader.robot().role() == Role::Leader;
        assert_eq!(is_leader, place != PLACE);
        for beat in 1..3 {
            street.hear(&mut other, leads(0, beat, place, false));
        }
        // It withdraws before that time is over.
        let role = street.leader.robot().role();
        assert_eq!(role == Role::None, place == PLACE);
    }
}
