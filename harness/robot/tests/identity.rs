//! Hazard: the holder of one valid ticket speaks as somebody else.
//!
//! A session must take facts of a member from the member alone. With the names of a robot open to anybody who says them
//! first, one ticket that may only help could push a follower's entry out of the table of names and speak for it: the
//! follower was dead, and the leader kept its corridor open.

use std::collections::BTreeMap;

use crossguard_codec::geonet::{Address, EgoPosition, Stack};
use crossguard_codec::security::{Certificate, Permission, PrivateKey, Ticket, Time64};
use crossguard_codec::{
    Identifiers, Kind, Part, Position, RobotState, Service, encode, golden, ram_from,
};
use crossguard_endpoint::station::{Credentials, Mode, NAMES_MAX, Security};
use crossguard_endpoint::{Effect, Endpoint, Moment, Stimulus};
use crossguard_protocol::{Availability, Config, Event, Lease, Phase, Robot, StationId};
use crossguard_robot::pki::{self, Holder, Pki, Term};
use crossguard_robot::plan::Plan;
use crossguard_robot::site::Site;

/// 2026-01-05, in milliseconds since 2004.
const EPOCH_ITS: u64 = 694_694_401_000;
const LEADER: StationId = StationId(1);
const FOLLOWER: StationId = StationId(2);
const LIAR: StationId = StationId(3);

const TAKEN: &str = "station id of another certificate";
const UNPINNED: &str = "another certificate than in the session";

fn identifiers() -> Identifiers {
    Identifiers::default()
}

fn epoch() -> Time64 {
    Time64::of_timestamp_its(EPOCH_ITS)
}

/// A ticket of the PKI, the key with it.
fn ticket(pki: &Pki, permissions: Vec<Permission>) -> Ticket {
    let term = Term::hours(epoch(), 1);
    let holder =
        pki::new_ticket(PrivateKey::generate(), &pki.authority, term, permissions).unwrap();
    Ticket::new(holder.certificate, holder.key).unwrap()
}

fn security(pki: &Pki, ticket: Ticket) -> Security {
    let credentials = Credentials {
        trust: pki.trust().unwrap(),
        tickets: vec![ticket],
    };
    Security::new(Mode::Enforce, credentials, None, epoch()).unwrap()
}

/// A station with one valid ticket that says what it likes, under any name and address.
struct Liar(Stack);

impl Liar {
    fn new(pki: &Pki, parts: &[Part], named: Option<StationId>) -> Self {
        let permissions = pki::robot_permissions(&identifiers(), parts, named);
        let mut stack = Stack::of_robot(identifiers(), LIAR);
        *stack.envelope_mut() = security(pki, ticket(pki, permissions)).envelope;
        Self(stack)
    }

    /// A packet with this message, from the address of a station.
    fn say(&mut self, now_ms: u64, service: Service, from: StationId, message: &[u8]) -> Vec<u8> {
        let address = Address::of_station(from.0, identifiers().robot_station_type);
        self.0.change_address(address);
        let ego = EgoPosition {
            timestamp_its: EPOCH_ITS + now_ms,
            ..EgoPosition::default()
        };
        self.0.packet(&ego, service, message).unwrap()
    }

    /// The RAM that `robot` would send.
    fn ram(&mut self, now_ms: u64, robot: &Robot) -> Vec<u8> {
        self.ram_from(now_ms, robot, robot.station())
    }

    /// The same from the address of another station.
    fn ram_from(&mut self, now_ms: u64, robot: &Robot, from: StationId) -> Vec<u8> {
        let (view, state) = (robot.ram(), RobotState::default());
        let generated = u16::try_from((EPOCH_ITS + now_ms) % 65_536).unwrap();
        let available = Availability::Available;
        let ram = ram_from(&identifiers(), &state, &view, available, generated, false).unwrap();
        let octets = encode(&identifiers(), &ram).unwrap();
        self.say(now_ms, Service::Ram, from, &octets)
    }

    /// The CAM of a vehicle with this station id.
    fn cam(&mut self, now_ms: u64, station: StationId) -> Vec<u8> {
        self.golden(now_ms, Service::Cam, (golden::ITS, "C2"), station)
    }

    /// A golden vector with this station id.
    fn golden(
        &mut self,
        now_ms: u64,
        service: Service,
        (file, name): (&'static str, &str),
        station: StationId,
    ) -> Vec<u8> {
        let mut message = hex::decode(golden::vector(file, name)).unwrap();
        message[2..6].copy_from_slice(&station.0.to_be_bytes());
        self.say(now_ms, service, station, &message)
    }
}

/// The order of NIST P-256.
const ORDER: [u8; 32] = [
    0xff, 0xff, 0xff, 0xff, 0, 0, 0, 0, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xbc, 0xe6,
    0xfa, 0xad, 0xa7, 0x17, 0x9e, 0x84, 0xf3, 0xb9, 0xca, 0xc2, 0xfc, 0x63, 0x25, 0x51,
];

/// The certificate with n - s in the place of s in its signature: it is signed as well, and has another digest.
fn mirrored(certificate: &Certificate) -> Certificate {
    let mut octets = certificate.octets().to_vec();
    let at = octets.len() - ORDER.len();
    let mut borrow = 0;
    for (digit, of_order) in octets[at..].iter_mut().zip(ORDER).rev() {
        let difference = i16::from(of_order) - i16::from(*digit) - borrow;
        borrow = i16::from(difference < 0);
        *digit = u8::try_from(difference.rem_euclid(256)).unwrap();
    }
    Certificate::decode(&octets).unwrap()
}

/// The certificate and its mirror. The one with the lower s, the last number in it, says under what both go.
fn lower_first(certificate: Certificate) -> [Certificate; 2] {
    let mirror = mirrored(&certificate);
    let s_of = |it: &Certificate| it.octets()[it.octets().len() - ORDER.len()..].to_vec();
    if s_of(&certificate) < s_of(&mirror) {
        [certificate, mirror]
    } else {
        [mirror, certificate]
    }
}

/// The first octets of a certificate's digest, as a station id.
fn first_four(certificate: &Certificate) -> StationId {
    let [a, b, c, d, ..] = certificate.id().0;
    StationId(u32::from_be_bytes([a, b, c, d]))
}

/// A leader and a follower within reach of each other; what each drops.
struct Street {
    pki: Pki,
    now_ms: u64,
    robots: Vec<Option<Endpoint>>,
    dropped: Vec<BTreeMap<String, usize>>,
    heard: Vec<BTreeMap<StationId, usize>>,
}

impl Street {
    /// Robots whose tickets name these ids.
    fn new(ids: &[StationId]) -> Self {
        let pki = Pki::for_a_day(&identifiers(), epoch()).unwrap();
        let mut street = Self {
            pki,
            now_ms: 0,
            robots: Vec::new(),
            dropped: vec![BTreeMap::new(); ids.len()],
            heard: vec![BTreeMap::new(); ids.len()],
        };
        for id in ids {
            let robot = street.boot(*id);
            street.robots.push(Some(robot));
        }
        street
    }

    fn boot(&self, id: StationId) -> Endpoint {
        let both = [Part::Lead, Part::Help];
        let permissions = pki::robot_permissions(&identifiers(), &both, Some(id));
        let security = security(&self.pki, ticket(&self.pki, permissions));
        let id = security.station_id(&identifiers(), StationId(9));
        let robot = Robot::new(id, 1);
        Endpoint::new(robot, Config::default(), identifiers(), self.now_ms).with_security(security)
    }

    fn tell(&mut self, place: usize, stimulus: Stimulus<'_>) {
        let moment = Moment::after(EPOCH_ITS, self.now_ms);
        let state = RobotState {
            position: Position::at(48.765_432_1, 9.123_456_7),
            ..RobotState::default()
        };
        let Some(robot) = &mut self.robots[place] else {
            return;
        };
        for effect in robot.handle(moment, &state, stimulus) {
            match effect {
                Effect::Transmit { packet, .. } => {
                    for other in (0..self.robots.len()).filter(|other| *other != place) {
                        self.hear(other, &packet);
                    }
                }
                Effect::Heard { from, .. } => *self.heard[place].entry(from).or_default() += 1,
                Effect::Dropped { cause, .. } => {
                    *self.dropped[place]
                        .entry(cause.reason().to_string())
                        .or_default() += 1;
                }
                _ => {}
            }
        }
    }

    fn hear(&mut self, place: usize, packet: &[u8]) {
        let arrived_ms = self.now_ms;
        self.tell(place, Stimulus::Datagram { packet, arrived_ms });
    }

    /// Lets time pass; each 10 ms the liar has its turn.
    fn pass(&mut self, ms: u64, lie: &mut dyn FnMut(&mut Self)) {
        for _ in 0..ms / 10 {
            self.now_ms += 10;
            for place in 0..self.robots.len() {
                self.tell(place, Stimulus::Time);
            }
            lie(self);
        }
    }

    /// The first robot leads the second.
    fn team_up(&mut self) {
        let request = Plan::crossing(Site::default()).request();
        self.tell(0, Stimulus::Event(Event::PedestrianDetected(request)));
        self.pass(1_000, &mut |_| {});
        assert!(self.relies_on(FOLLOWER));
    }

    /// Whether the first robot may let people cross, as far as this follower goes.
    fn relies_on(&self, follower: StationId) -> bool {
        let Phase::Leading(leading) = self.robots[0].as_ref().unwrap().robot().phase() else {
            return false;
        };
        let member = leading.member(follower);
        member.is_some_and(|member| matches!(member.lease, Lease::Stands(_)))
    }

    fn dropped(&self, place: usize, cause: &str) -> usize {
        self.dropped[place].get(cause).copied().unwrap_or(0)
    }

    fn heard(&self, place: usize, from: StationId) -> usize {
        self.heard[place].get(&from).copied().unwrap_or(0)
    }
}

#[test]
fn a_helper_cannot_take_over_a_follower_and_the_leader_learns_that_it_is_dead() {
    let mut street = Street::new(&[LEADER, FOLLOWER]);
    let mut liar = Liar::new(&street.pki, &[Part::Help], None);
    street.team_up();
    // It speaks under more ids than any table of names holds, and then as the follower, which has lost its power.
    let follower = street.robots[1].take().unwrap().robot().clone();
    for id in 0..=u32::try_from(NAMES_MAX).unwrap() {
        let packet = liar.ram(street.now_ms, &Robot::new(StationId(1_000 + id), 1));
        street.hear(0, &packet);
    }
    let heard = street.heard(0, FOLLOWER);
    let t_safety_ms = u64::from(Config::default().settings().t_safety.0);
    street.pass(t_safety_ms + 1_000, &mut |street| {
        let mut spoken = follower.clone();
        // It repeats the heartbeat of the leader, as the follower would.
        let leader = street.robots[0].as_ref().unwrap().robot().ram();
        let input = crossguard_protocol::Input::Ram {
            ram: leader,
            distance: crossguard_protocol::Decimetres(20),
        };
        spoken.step(&Config::default(), input);
        let packet = liar.ram(street.now_ms, &spoken);
        street.hear(0, &packet);
    });
    assert_eq!(street.heard(0, FOLLOWER), heard, "the liar was believed");
    assert!(street.dropped(0, TAKEN) > NAMES_MAX);
    assert!(
        !street.relies_on(FOLLOWER),
        "the leader relies on a robot without power"
    );
}

/// Two tickets that name one id, as of an authority that has made a mistake.
#[test]
fn a_member_and_a_leader_keep_the_ticket_under_which_they_joined() {
    let mut street = Street::new(&[LEADER, FOLLOWER]);
    let mut second_follower = Liar::new(&street.pki, &[Part::Help], Some(FOLLOWER));
    let mut second_leader = Liar::new(&street.pki, &[Part::Lead], Some(LEADER));
    // Outside of a session, any holder of a ticket with this name goes by it.
    let packet = second_follower.ram(street.now_ms, &Robot::new(FOLLOWER, 1));
    street.hear(0, &packet);
    assert_eq!(street.heard(0, FOLLOWER), 2, "each of them once");
    street.pass(100, &mut |_| {});
    street.team_up();

    let robots = [0, 1].map(|place| street.robots[place].as_ref().unwrap().robot().clone());
    let heard = [street.heard(0, FOLLOWER), street.heard(1, LEADER)];
    let packet = second_follower.ram(street.now_ms, &robots[1]);
    street.hear(0, &packet);
    let packet = second_leader.ram(street.now_ms, &robots[0]);
    street.hear(1, &packet);
    for place in [0, 1] {
        assert_eq!(
            street.dropped(place, UNPINNED),
            1,
            "{:?}",
            street.dropped[place]
        );
    }
    assert_eq!([street.heard(0, FOLLOWER), street.heard(1, LEADER)], heard);
    street.pass(1_000, &mut |_| {});
    assert!(street.relies_on(FOLLOWER));
    // When the session is over and the robot is gone, its name is free again.
    street.tell(0, Stimulus::Event(Event::TaskCompleted));
    street.pass(3_000, &mut |_| {});
    let packet = second_follower.ram(street.now_ms, &Robot::new(FOLLOWER, 1));
    let heard = street.heard(0, FOLLOWER);
    street.hear(0, &packet);
    assert_eq!(street.heard(0, FOLLOWER), heard + 1);
}

#[test]
fn one_ticket_is_one_robot() {
    let mut street = Street::new(&[LEADER]);
    let mut liar = Liar::new(&street.pki, &[Part::Help], Some(LIAR));
    for id in [3, 4, 5, 3] {
        let packet = liar.ram(street.now_ms, &Robot::new(StationId(id), 1));
        street.hear(0, &packet);
        street.pass(10, &mut |_| {});
    }
    assert_eq!(street.heard(0, LIAR), 2);
    assert_eq!(street.dropped(0, TAKEN), 2);
}

/// Hazard: the holder of a ticket gives it another digest, and speaks as two robots.
#[test]
fn a_ticket_and_its_mirror_are_one_robot() {
    let mut street = Street::new(&[LEADER]);
    let permissions = pki::robot_permissions(&identifiers(), &[Part::Help], None);
    let term = Term::hours(epoch(), 1);
    let Holder { certificate, key } = pki::new_ticket(
        PrivateKey::generate(),
        &street.pki.authority,
        term,
        permissions,
    )
    .unwrap();
    let [certificate, mirror] = lower_first(certificate);
    let ids = [first_four(&certificate), first_four(&mirror)];
    let mut packets = |certificate, id| {
        let mut stack = Stack::of_robot(identifiers(), LIAR);
        let ticket = Ticket::new(certificate, key.clone()).unwrap();
        *stack.envelope_mut() = security(&street.pki, ticket).envelope;
        let packet = Liar(stack).ram(street.now_ms, &Robot::new(id, 1));
        street.hear(0, &packet);
        street.pass(10, &mut |_| {});
    };
    packets(certificate, ids[0]);
    packets(mirror.clone(), ids[1]);
    packets(mirror, ids[0]);
    assert_eq!(street.heard(0, ids[0]), 2);
    assert_eq!(street.heard(0, ids[1]), 0, "no second robot");
    assert_eq!(street.dropped(0, TAKEN), 1);
}

#[test]
fn who_squats_on_an_id_does_not_keep_its_robot_out() {
    let mut street = Street::new(&[LEADER]);
    let mut liar = Liar::new(&street.pki, &[Part::Help], None);
    street.pass(5_000, &mut |street| {
        let packet = liar.ram(street.now_ms, &Robot::new(FOLLOWER, 1));
        street.hear(0, &packet);
        let packet = liar.cam(street.now_ms, FOLLOWER);
        street.hear(0, &packet);
    });
    assert_eq!(
        street.heard[0].keys().collect::<Vec<_>>(),
        [&FOLLOWER],
        "as a vehicle only"
    );
    let before = street.heard(0, FOLLOWER);
    let follower = street.boot(FOLLOWER);
    street.robots.push(Some(follower));
    street.heard.push(BTreeMap::new());
    street.dropped.push(BTreeMap::new());
    street.team_up();
    // From then on the id is the robot's in all services.
    assert!(street.heard(0, FOLLOWER) > before);
    let packet = liar.cam(street.now_ms, FOLLOWER);
    let (heard, dropped) = (street.heard(0, FOLLOWER), street.dropped(0, TAKEN));
    street.hear(0, &packet);
    assert_eq!(street.heard(0, FOLLOWER), heard);
    assert_eq!(street.dropped(0, TAKEN), dropped + 1);
}

#[test]
fn the_link_address_is_that_of_the_station() {
    let mut street = Street::new(&[LEADER]);
    let mut liar = Liar::new(&street.pki, &[Part::Help], Some(LIAR));
    let packet = liar.ram_from(street.now_ms, &Robot::new(LIAR, 1), FOLLOWER);
    street.hear(0, &packet);
    assert_eq!(street.heard(0, LIAR), 0);
    assert_eq!(street.dropped(0, "address of another station"), 1);
}

#[test]
fn a_vehicle_has_one_name_and_keeps_it_while_it_is_heard() {
    let mut street = Street::new(&[LEADER]);
    let mut vehicle = Liar::new(&street.pki, &[], None);
    let mut liar = Liar::new(&street.pki, &[], None);
    let named = StationId(100);
    let packet = vehicle.cam(street.now_ms, named);
    street.hear(0, &packet);
    for id in 0..2 * u32::try_from(NAMES_MAX).unwrap() {
        let packet = liar.cam(street.now_ms, StationId(1_000 + id));
        street.hear(0, &packet);
    }
    street.pass(100, &mut |_| {});
    let packet = liar.cam(street.now_ms, named);
    street.hear(0, &packet);
    assert_eq!(street.dropped(0, TAKEN), 1);
    assert_eq!(
        street.dropped(0, "second station id of a certificate"),
        2 * NAMES_MAX - 1
    );
    let packet = vehicle.cam(street.now_ms, named);
    street.hear(0, &packet);
    assert_eq!(street.heard(0, named), 2);
}

/// Hazard: a ticket takes the ids of vehicles before they come within reach, and go is shown in front of them.
#[test]
fn a_vehicle_whose_id_another_ticket_has_is_on_the_road_all_the_same() {
    let mut street = Street::new(&[LEADER]);
    let mut liar = Liar::new(&street.pki, &[], None);
    let mut vehicle = Liar::new(&street.pki, &[], None);
    let named = StationId(100);
    let vehicles = |street: &mut Street, packet: &[u8]| {
        street.hear(0, packet);
        let robot = street.robots[0].as_ref().unwrap();
        robot.map().of_kind(Kind::Vehicle).count()
    };
    let packet = liar.cam(street.now_ms, named);
    assert_eq!(vehicles(&mut street, &packet), 1);
    let packet = vehicle.cam(street.now_ms, named);
    assert_eq!(vehicles(&mut street, &packet), 2);
    assert_eq!(street.dropped(0, TAKEN), 1);
    // A ticket is one more vehicle, whatever ids it goes by.
    for id in 0..10 {
        let packet = liar.cam(street.now_ms, StationId(1_000 + id));
        assert_eq!(vehicles(&mut street, &packet), 3);
    }
    let mut moved = Liar::new(&street.pki, &[], None);
    let packet = moved.cam(street.now_ms, StationId(200));
    assert_eq!(vehicles(&mut street, &packet), 4);
    let mut cam = hex::decode(golden::vector(golden::ITS, "C2")).unwrap();
    cam[2..6].copy_from_slice(&200_u32.to_be_bytes());
    let packet = moved.say(street.now_ms + 10, Service::Cam, StationId(201), &cam);
    assert_eq!(vehicles(&mut street, &packet), 5);
    assert_eq!(street.dropped(0, "address of another station"), 1);
}

/// Hazard: a phone that is one person says that it is many.
#[test]
fn who_tells_of_people_has_one_name_too() {
    let mut street = Street::new(&[LEADER]);
    let mut phone = Liar::new(&street.pki, &[], None);
    let vam = (golden::VAM, "V1");
    for (id, heard) in [(100, 1), (101, 0), (100, 2)] {
        let packet = phone.golden(street.now_ms, Service::Vam, vam, StationId(id));
        street.hear(0, &packet);
        assert_eq!(street.heard(0, StationId(id)), heard);
        street.pass(100, &mut |_| {});
    }
    assert_eq!(street.dropped(0, "second station id of a certificate"), 1);
}

#[test]
fn a_robot_goes_by_the_id_of_its_ticket_from_the_start() {
    let pki = Pki::for_a_day(&identifiers(), epoch()).unwrap();
    // Half of the tickets go by the digest of their mirror: among twenty there are both kinds.
    for _ in 0..20 {
        let permissions = pki::robot_permissions(&identifiers(), &[Part::Help], None);
        let ticket = ticket(&pki, permissions);
        let [lower, _] = lower_first(ticket.certificate().clone());
        let id = security(&pki, ticket).station_id(&identifiers(), StationId(7));
        assert_eq!(id, first_four(&lower));
    }
    let off = Security::default();
    assert_eq!(off.station_id(&identifiers(), StationId(7)), StationId(7));
}
