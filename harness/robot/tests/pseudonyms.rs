//! Pseudonyms change as a whole, and never while a session knows the robot by the old one
//! (property I18).

use std::collections::BTreeSet;

use crossguard_codec::geonet::{Address, BasicHeader, Headers};
use crossguard_codec::security::{Duration, PrivateKey, SignedMessage, Ticket, Time64, Unit};
use crossguard_codec::{Identifiers, Part, Position, RobotState, TaskParameters};

use crossguard_endpoint::ras::clustering::PerceivedVru;
use crossguard_endpoint::ras::surroundings::Awareness;
use crossguard_endpoint::station::listen::overhear;
use crossguard_endpoint::station::{Mode, Secret, Security};
use crossguard_endpoint::{Effect, Endpoint, Moment, Stimulus};
use crossguard_protocol::{
    Availability, Config, Event, Identity, Input, ManeuverId, Output, Phase, Robot, SessionId,
    StationId, TaskType, Unavailability,
};
use crossguard_robot::pki::{EARLY_S, Pki, Term, new_ticket, robot_permissions};
use crossguard_robot::plan::Plan;
use crossguard_robot::site::Site;

/// 2026-01-05, in milliseconds since 2004.
const EPOCH_ITS: u64 = 694_694_401_000;
const PERIOD_MS: u64 = 1_000;
const STEP_MS: u64 = 10;

/// Sender of a packet: signer, station id.
type Sender = ([u8; 8], StationId);

struct Street {
    now_ms: u64,
    robots: [Endpoint; 2],
    /// Under which pseudonyms each robot was heard, in order.
    heard_as: [Vec<Sender>; 2],
    started: Option<ManeuverId>,
    /// How often a robot said that its tickets end.
    ends: [usize; 2],
    /// When each robot sent something.
    sent_ms: [Vec<u64>; 2],
}

impl Street {
    fn new() -> Self {
        Self::with(&[None; 2], PERIOD_MS)
    }

    /// Each robot has many tickets for a day, or one for each of these times, from and until, in s after the start.
    fn with(tickets: &[Option<&[[u16; 2]]>; 2], period_ms: u64) -> Self {
        let identifiers = Identifiers::default();
        let now = Time64::of_timestamp_its(EPOCH_ITS);
        let pki = Pki::for_a_day(&identifiers, now).unwrap();
        let robots = [1_usize, 2].map(|id| {
            let mut credentials = pki.credentials(&identifiers, (40, None), now).unwrap();
            if let Some(times) = tickets[id - 1] {
                let ticket = |[from_s, until_s]: &[u16; 2]| {
                    let term = Term {
                        from: Time64(now.0 + (u64::from(*from_s) + EARLY_S) * 1_000_000),
                        duration: Duration {
                            number: until_s - from_s,
                            unit: Unit::Seconds,
                        },
                    };
                    let may = robot_permissions(&identifiers, &[Part::Lead, Part::Help], None);
                    let ticket =
                        new_ticket(PrivateKey::generate(), &pki.authority, term, may).unwrap();
                    Ticket::new(ticket.certificate, ticket.key).unwrap()
                };
                credentials.tickets = times.iter().map(ticket).collect();
            }
            let security = Security::new(Mode::Enforce, credentials, Some(period_ms), now);
            let number = u8::try_from(id).unwrap();
            let id = number.into();
            let security = security.unwrap().with_secret(Secret::new([number; 32]));
            let id = security.station_id(&identifiers, StationId(id));
            let robot = Robot::new(id, security.epoch(id, 1));
            Endpoint::new(robot, Config::default(), identifiers, 0).with_security(security)
        });
        Self {
            now_ms: 0,
            robots,
            heard_as: [Vec::new(), Vec::new()],
            started: None,
            ends: [0; 2],
            sent_ms: [Vec::new(), Vec::new()],
        }
    }

    fn tell(&mut self, robot: usize, stimulus: Stimulus<'_>) {
        let moment = Moment::after(EPOCH_ITS, self.now_ms);
        let state = RobotState {
            position: Position::at(48.765_432_1, 9.123_456_7),
            ..RobotState::default()
        };
        let mut identity = self.robots[robot].robot().identity();
        let effects = self.robots[robot].handle(moment, &state, stimulus);
        for effect in effects {
            match effect {
                Effect::Transmit { packet, octets, .. } => {
                    self.note(robot, &packet, &octets);
                    self.sent_ms[robot].push(self.now_ms);
                    let datagram = Stimulus::Datagram {
                        packet: &packet,
                        arrived_ms: self.now_ms,
                    };
                    self.tell(1 - robot, datagram);
                }
                Effect::Stepped { input, state, .. } => {
                    if let Input::Local(Event::IdentityChanged(..)) = input {
                        assert_eq!(identity, Identity::Unlocked);
                    }
                    identity = state.identity();
                }
                Effect::Act(Output::StartManeuver(maneuver), _) => self.started = Some(maneuver.id),
                Effect::Dropped { cause, .. } if cause.to_string() == "storage: tickets end" => {
                    self.ends[robot] += 1;
                }
                Effect::Dropped { cause, detail, .. } => panic!("{cause:?}: {detail}"),
                _ => {}
            }
        }
    }

    /// Everything in a packet that names its sender must name the same one.
    fn note(&mut self, robot: usize, packet: &[u8], message: &[u8]) {
        let (basic, rest) = BasicHeader::decode(packet).unwrap();
        let signed = SignedMessage::decode(rest).unwrap();
        let (headers, inner) = Headers::decode_behind(basic, signed.payload).unwrap();
        assert_eq!(inner, message);
        let identifiers = Identifiers::default();
        let from = overhear(&identifiers, message).unwrap().from;
        let address = Address::of_station(from.0, identifiers.robot_station_type);
        assert_eq!(headers.source.address, address);
        let sender = (signed.signer.id().0, from);
        if self.heard_as[robot].last() != Some(&sender) {
            self.heard_as[robot].push(sender);
        }
    }

    fn pass(&mut self, milliseconds: u64) {
        for _ in 0..milliseconds / STEP_MS {
            self.now_ms += STEP_MS;
            for robot in 0..2 {
                self.tell(robot, Stimulus::Time);
            }
        }
    }

    fn id(&self, robot: usize) -> StationId {
        self.robots[robot].robot().station()
    }

    /// A person waits, and the first robot asks for help.
    fn ask(&mut self) {
        let request = Plan::crossing(Site::default()).request();
        self.tell(0, Stimulus::Event(Event::PedestrianDetected(request)));
        self.pass(1_000);
    }

    /// The second robot guards from a place, and its leader leaves.
    fn guard(&mut self) {
        self.ask();
        let order = Stimulus::Command {
            follower: self.id(1),
            task: TaskType::BLOCK,
            parameters: TaskParameters::default(),
        };
        self.tell(0, order);
        self.pass(200);
        let maneuver = self.started.take().expect("a maneuver");
        self.tell(1, Stimulus::Event(Event::InPosition(maneuver)));
        self.tell(0, Stimulus::Event(Event::LeaveRequested));
    }

    /// One session, longer than pseudonyms last; its name.
    fn cross(&mut self) -> SessionId {
        self.ask();
        let (leader, follower) = (self.id(0), self.id(1));
        assert!(matches!(self.robots[0].robot().phase(), Phase::Leading(_)));
        let session = self.robots[0].robot().session().unwrap();
        let parameters = TaskParameters::default();
        let task = TaskType::INITIAL_POS;
        self.tell(
            0,
            Stimulus::Command {
                follower,
                task,
                parameters,
            },
        );
        self.pass(3 * PERIOD_MS);
        let maneuver = self.started.take().expect("a maneuver");
        self.tell(1, Stimulus::Event(Event::ManeuverCompleted(maneuver)));
        self.pass(200);
        assert_eq!((self.id(0), self.id(1)), (leader, follower));
        self.tell(0, Stimulus::Event(Event::TaskCompleted));
        session
    }
}

#[test]
fn a_pseudonym_changes_outside_of_sessions_only_and_as_a_whole() {
    let mut street = Street::new();
    street.pass(2_500);
    let mut sessions = Vec::new();
    for _ in 0..3 {
        sessions.push(street.cross());
        let during = [street.id(0), street.id(1)];
        street.pass(5_000);
        for (robot, during) in during.into_iter().enumerate() {
            let identity = street.robots[robot].robot().identity();
            assert_eq!(identity, Identity::Unlocked);
            assert_ne!(street.id(robot), during, "it changed after the session");
        }
    }
    // The names of sessions do not tell that they are one leader's: no boot counter, and no running count.
    let epochs: BTreeSet<_> = sessions.iter().map(|it| it.number.0.boot).collect();
    assert_eq!(epochs.len(), sessions.len(), "{sessions:?}");
    assert!(
        sessions.iter().all(|it| it.number.0.count == 0),
        "{sessions:?}"
    );
    for heard_as in &street.heard_as {
        let signers: BTreeSet<_> = heard_as.iter().map(|(signer, _)| signer).collect();
        let stations: BTreeSet<_> = heard_as.iter().map(|(_, id)| id).collect();
        assert!(heard_as.len() > 6, "{heard_as:?}");
        assert_eq!(signers.len(), heard_as.len(), "none twice");
        assert_eq!(stations.len(), heard_as.len(), "none twice");
    }
}

/// Hazard: a guard stands on the lane after its leader has gone, and says nothing for up to 10 s, because its pseudonym changes.
#[test]
fn a_guard_with_a_duty_changes_its_pseudonym_for_the_end_of_a_ticket_alone_and_is_not_silent() {
    let ends_s = 20;
    let t_lock_s = u16::try_from(Config::default().settings().t_lock.0 / 1_000).unwrap();
    let until_s = t_lock_s + ends_s;
    for (tickets, period_ms, changes) in [
        (None, PERIOD_MS, false),
        (Some([[0, until_s], [0, 3_600]]), Alone::PERIOD_MS, true),
    ] {
        let tickets = tickets.as_ref().map(|it| &it[..]);
        let mut street = Street::with(&[None, tickets], period_ms);
        street.pass(100);
        street.guard();
        street.pass(5_000);
        assert_eq!(street.robots[1].robot().identity(), Identity::Unlocked);
        let (guard, began_ms) = (street.id(1), street.now_ms);
        assert!(began_ms < u64::from(ends_s) * 1_000, "{began_ms}");
        street.pass(30_000);
        assert!(street.robots[1].robot().duty().is_some());
        assert_eq!(street.id(1) != guard, changes, "{period_ms}");
        let sent = street.sent_ms[1].iter().filter(|ms| **ms >= began_ms);
        let sent: Vec<_> = sent.chain([&street.now_ms]).collect();
        let silences = sent.windows(2).map(|two| two[1] - two[0]);
        assert!(
            silences.clone().max() <= Some(1_000),
            "{:?}",
            silences.max()
        );
    }
}

/// Hazard: the last ticket of a leader ends in the middle of a crossing, and nobody who verifies hears it any more.
#[test]
fn a_robot_whose_tickets_end_within_a_session_begins_none() {
    let t_lock_s = u16::try_from(Config::default().settings().t_lock.0 / 1_000).unwrap();
    let [short, long] = [t_lock_s, t_lock_s + 2].map(|until_s| [[0, until_s]]);
    for (tickets, leads, ends) in [
        ([&long, &long], true, [0, 0]),
        ([&[[0, 2]], &long], false, [1, 0]),
        ([&short, &long], false, [1, 0]),
        ([&long, &short], false, [0, 1]),
    ] {
        let mut street = Street::with(&tickets.map(|it| Some(&it[..])), PERIOD_MS);
        street.pass(100);
        street.ask();
        assert_eq!(street.ends, ends);
        let phase = street.robots[0].robot().phase();
        assert_eq!(matches!(phase, Phase::Leading(_)), leads, "{phase:?}");
        if leads {
            // As long as a session may take, whatever it is that both say in it.
            street.pass(u64::from(t_lock_s) * 1_000);
            let identities = street.robots.each_ref().map(|it| it.robot().identity());
            assert_eq!(identities, [Identity::Unlocked; 2]);
        }
    }
}

#[test]
fn a_robot_takes_part_again_when_its_next_ticket_begins_unless_a_person_said_otherwise() {
    let begins_s = 10;
    let tickets = [[0, begins_s + 1], [begins_s, 3_600]];
    let not_safe = Availability::Unavailable(Unavailability::NotSafe);
    for (told, after) in [(None, Availability::Available), (Some(not_safe), not_safe)] {
        let mut street = Street::with(&[None, Some(&tickets)], PERIOD_MS);
        let told_of = |told| Stimulus::Event(Event::AvailabilityChanged(told));
        let is = |street: &Street| street.robots[1].robot().availability();
        street.pass(100);
        assert_eq!((is(&street), street.ends), (not_safe, [0, 1]));
        // The word of a person makes no ticket last longer.
        street.tell(1, told_of(Availability::Available));
        street.pass(100);
        assert_eq!((is(&street), street.ends), (not_safe, [0, 2]));
        if let Some(told) = told {
            street.tell(1, told_of(told));
        }
        street.pass(u64::from(begins_s) * 1_000);
        assert_eq!((is(&street), street.ends), (after, [0, 2]));
    }
}

/// One robot alone, with a pseudonym for five minutes; when it sends, in ms.
struct Alone {
    robot: Endpoint,
    now_ms: u64,
    sent_ms: Vec<u64>,
    station: StationId,
    changed_ms: Option<u64>,
}

impl Alone {
    const PERIOD_MS: u64 = 300_000;

    fn new(secret: u8) -> Self {
        let identifiers = Identifiers::default();
        let now = Time64::of_timestamp_its(EPOCH_ITS);
        // The same pseudonyms in every run: how long the silence is follows from them and from the secret.
        let mut numbers = 1_u8..;
        let mut keys = || PrivateKey::of_octets(&[numbers.next().unwrap(); 32]).unwrap();
        let pki = Pki::with_keys(&identifiers, now, &mut keys).unwrap();
        let credentials = pki.credentials_with_keys(&identifiers, (3, None), now, &mut keys);
        let credentials = credentials.unwrap();
        let security = Security::new(Mode::Enforce, credentials, Some(Self::PERIOD_MS), now);
        let security = security.unwrap().with_secret(Secret::new([secret; 32]));
        let station = security.station_id(&identifiers, StationId(1));
        let awareness = Awareness {
            cam: true,
            cluster_vam_interval_ms: Some(1_000),
            ..Awareness::default()
        };
        let robot = Robot::new(station, security.epoch(station, 1));
        Self {
            robot: Endpoint::new(robot, Config::default(), identifiers, 0)
                .with_security(security)
                .with_awareness(awareness),
            now_ms: 0,
            sent_ms: Vec::new(),
            station,
            changed_ms: None,
        }
    }

    fn tell(&mut self, stimulus: Stimulus<'_>) {
        let moment = Moment::after(EPOCH_ITS, self.now_ms);
        let state = RobotState {
            position: Position::at(48.765_432_1, 9.123_456_7),
            ..RobotState::default()
        };
        for effect in self.robot.handle(moment, &state, stimulus) {
            if let Effect::Transmit { .. } = effect {
                self.sent_ms.push(self.now_ms);
            }
        }
        let station = self.robot.robot().station();
        if station != self.station {
            self.station = station;
            self.changed_ms = Some(self.now_ms);
        }
    }

    /// Lets time pass until it changes its pseudonym; when that was.
    fn change(&mut self) -> u64 {
        self.changed_ms = None;
        while self.changed_ms.is_none() {
            self.now_ms += STEP_MS;
            self.tell(Stimulus::Time);
        }
        self.changed_ms.unwrap()
    }

    fn pass(&mut self, milliseconds: u64) {
        for _ in 0..milliseconds / STEP_MS {
            self.now_ms += STEP_MS;
            self.tell(Stimulus::Time);
        }
    }

    /// Whether it has sent something since then.
    fn has_sent_since(&self, ms: u64) -> bool {
        self.sent_ms.last().is_some_and(|last_ms| *last_ms >= ms)
    }
}

#[test]
fn a_robot_is_silent_before_a_new_pseudonym_and_changes_when_all_do() {
    let mut silences = BTreeSet::new();
    for secret in 0..4 {
        let mut alone = Alone::new(secret);
        let changed_ms = alone.change();
        let into_period_ms = (EPOCH_ITS + changed_ms) % Alone::PERIOD_MS;
        assert!(into_period_ms < STEP_MS, "{into_period_ms}");
        assert!(!alone.has_sent_since(changed_ms));
        alone.pass(12_000);
        let next = alone.sent_ms.iter().find(|sent_ms| **sent_ms >= changed_ms);
        let silence_ms = next.unwrap() - changed_ms;
        assert!(silence_ms < 10_100, "{silence_ms}");
        silences.insert(silence_ms);
    }
    assert!(
        silences.len() == 4 && silences.last() > Some(&1_500),
        "{silences:?}"
    );
}

/// A secret with a silence that is long enough to be broken.
const SILENT: u8 = 1;

/// Hazard: somebody waits at the kerb while a robot hides.
#[test]
fn who_needs_the_robot_breaks_its_silence() {
    let request = Plan::crossing(Site::default()).request();
    let person = PerceivedVru::pedestrian(1, [3.0, 0.0]);
    for (need, within_ms) in [
        (Stimulus::Event(Event::PedestrianDetected(request)), 0),
        (Stimulus::Perceived(&[person]), 200),
    ] {
        let mut alone = Alone::new(SILENT);
        let changed_ms = alone.change();
        alone.pass(200);
        let is_silent = !alone.has_sent_since(changed_ms);
        assert!(is_silent, "this secret is silent for too short");
        alone.tell(need);
        alone.pass(within_ms);
        assert!(alone.has_sent_since(alone.now_ms - within_ms));
    }
}

/// A robot that starts again and again would be known by a first pseudonym that is always the same.
#[test]
fn the_first_pseudonym_after_a_start_is_any_of_them() {
    let now = Time64::of_timestamp_its(EPOCH_ITS);
    let pki = Pki::for_a_day(&Identifiers::default(), now).unwrap();
    let credentials = pki.credentials(&Identifiers::default(), (8, None), now);
    let credentials = credentials.unwrap();
    let starts = (0..40).map(|_| {
        let tickets = credentials.clone().shuffled().tickets;
        let ids: BTreeSet<_> = tickets.iter().map(|it| it.certificate().id().0).collect();
        assert_eq!(ids.len(), 8, "all of them are there");
        tickets[0].certificate().id().0
    });
    let firsts: BTreeSet<_> = starts.collect();
    // Five or fewer of eight come first in forty starts once in a million times.
    assert!(firsts.len() > 5, "{firsts:?}");
}
