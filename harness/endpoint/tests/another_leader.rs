//! A leader that goes behind at the same place and does not yield may not hear this robot: that is told, once for its session.

use crossguard_codec::geonet::{EgoPosition, Stack};
use crossguard_codec::{Identifiers, RobotState, Service, encode, ram_from};
use crossguard_endpoint::cause::Cause;
use crossguard_endpoint::{Effect, Endpoint, Moment, Stimulus};
use crossguard_protocol::{
    Availability, Config, Confirmation, Coordination, Event, Heartbeat, HelpRequest, Millis,
    OfferNumber, Place, Ram, Robot, Role, SessionNumber, StationId, TaskSet, TaskType,
    UniqueNumber, Urgency,
};

const NUMBER: UniqueNumber = UniqueNumber { boot: 1, count: 0 };
const PLACE: Place = Place(7);
const TASKS: TaskSet = TaskSet::of(&[TaskType::BLOCK]);

/// The leader of this test, and its clock.
struct Street {
    leader: Endpoint,
    now_ms: u64,
}

impl Street {
    fn idle() -> Self {
        let robot = Robot::new(StationId(1), 1);
        Self {
            leader: Endpoint::new(robot, Config::default(), Identifiers::default(), 0),
            now_ms: 100,
        }
    }

    fn detect(&mut self) {
        let request = HelpRequest {
            urgency: Urgency::Medium,
            followers: 1,
            tasks: TASKS,
            place: PLACE,
        };
        self.handle(Stimulus::Event(Event::PedestrianDetected(request)));
    }

    /// An offer of help to it.
    fn offer(&self) -> Coordination {
        Coordination::OfferHelp {
            session: self.leader.robot().session().unwrap(),
            offer: OfferNumber(NUMBER),
            capabilities: TASKS,
            echo: Heartbeat(0),
            t_safety: Millis(2_000),
        }
    }

    fn handle(&mut self, stimulus: Stimulus<'_>) -> Vec<Effect> {
        let moment = Moment::after(694_694_401_000, self.now_ms);
        self.leader.handle(moment, &RobotState::default(), stimulus)
    }

    /// 100 ms later a station says that. What is dropped of it.
    fn hear(&mut self, from: &mut (StationId, Stack), coordination: Coordination) -> Vec<String> {
        self.now_ms += 100;
        self.handle(Stimulus::Time);
        let (station, stack) = from;
        let ram = Ram {
            station: *station,
            coordination,
            farewell: None,
            on_duty: false,
        };
        let (ids, state) = (Identifiers::default(), RobotState::default());
        let ram = ram_from(&ids, &state, &ram, Availability::Available, 0, false).unwrap();
        let message = encode(&ids, &ram).unwrap();
        let packet = stack
            .packet(&EgoPosition::default(), Service::Ram, &message)
            .unwrap();
        let effects = self.handle(Stimulus::Datagram {
            packet: &packet,
            arrived_ms: self.now_ms,
        });
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
                // What others say in between does not matter.
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
        assert_eq!(street.leader.all_have_answered(), place != PLACE);
        for beat in 1..3 {
            street.hear(&mut other, leads(0, beat, place, false));
        }
        // It withdraws before that time is over.
        let role = street.leader.robot().role();
        assert_eq!(role == Role::None, place == PLACE);
    }
}
