//! Pseudonyms change as a whole, and never while a session knows the robot by the old one
//! (property I18).

use std::collections::BTreeSet;

use crossguard_codec::geonet::{Address, BasicHeader, Headers};
use crossguard_codec::security::{SignedMessage, Time64};
use crossguard_codec::{Identifiers, Position, RobotState, TaskParameters};

use crossguard_endpoint::station::listen::overhear;
use crossguard_endpoint::station::{Mode, Security};
use crossguard_endpoint::{Act, Effect, Endpoint, Moment, Stimulus};
use crossguard_protocol::{
    Config, Event, Identity, Input, ManeuverId, Phase, Robot, StationId, TaskType,
};
use crossguard_robot::pki::Pki;
use crossguard_robot::plan::Plan;
use crossguard_robot::site::Site;

/// 2026-01-05, in milliseconds since 2004.
const EPOCH_ITS: u64 = 694_694_401_000;
const PERIOD_MS: u64 = 1_000;
const STEP_MS: u64 = 10;

/// Who sent a packet: signer, station id.
type Sender = ([u8; 8], StationId);

struct Street {
    now_ms: u64,
    robots: [Endpoint; 2],
    /// Under which pseudonyms each robot was heard, in order.
    heard_as: [Vec<Sender>; 2],
    started: Option<ManeuverId>,
}

impl Street {
    fn new() -> Self {
        let identifiers = Identifiers::default();
        let now = Time64::of_timestamp_its(EPOCH_ITS);
        let pki = Pki::for_a_day(&identifiers, now).unwrap();
        let robots = [1, 2].map(|id| {
            let credentials = pki.credentials(&identifiers, (40, None), now).unwrap();
            let security = Security::new(Mode::Enforce, credentials, Some(PERIOD_MS), now);
            let security = security.unwrap();
            let id = security.station_id(&identifiers, StationId(id));
            Endpoint::new(Robot::new(id, 1), Config::default(), identifiers, 0)
                .with_security(security)
        });
        Self {
            now_ms: 0,
            robots,
            heard_as: [Vec::new(), Vec::new()],
            started: None,
        }
    }

    fn tell(&mut self, robot: usize, stimulus: Stimulus<'_>) {
        let moment = Moment {
            now_ms: self.now_ms,
            timestamp_its: EPOCH_ITS + self.now_ms,
        };
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
                    let datagram = Stimulus::Datagram {
                        packet: &packet,
                        arrived_ms: self.now_ms,
                    };
                    self.tell(1 - robot, datagram);
                }
                Effect::Stepped { input, state, .. } => {
                    if let Input::Local(Event::IdentityChanged(_)) = input {
                        assert_eq!(identity, Identity::Unlocked);
                    }
                    identity = state.identity();
                }
                Effect::Act(Act::Start(maneuver, _)) => self.started = Some(maneuver.id),
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

    /// One session, longer than pseudonyms last.
    fn cross(&mut self) {
        let request = Plan::crossing(Site::default()).request();
        self.tell(0, Stimulus::Event(Event::PedestrianDetected(request)));
        self.pass(1_000);
        let (leader, follower) = (self.id(0), self.id(1));
        assert!(matches!(self.robots[0].robot().phase(), Phase::Leading(_)));
        let parameters = TaskParameters::default();
        let task = TaskType::INITIAL_POS;
        self.tell(
            0,
            Stimulus::Order {
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
    }
}

#[test]
fn a_pseudonym_changes_outside_of_sessions_only_and_as_a_whole() {
    let mut street = Street::new();
    street.pass(2_500);
    for _ in 0..2 {
        street.cross();
        let during = [street.id(0), street.id(1)];
        street.pass(5_000);
        for (robot, during) in during.into_iter().enumerate() {
            let identity = street.robots[robot].robot().identity();
            assert_eq!(identity, Identity::Unlocked);
            assert_ne!(street.id(robot), during, "it changed after the session");
        }
    }
    for heard_as in &street.heard_as {
        let signers: BTreeSet<_> = heard_as.iter().map(|(signer, _)| signer).collect();
        let stations: BTreeSet<_> = heard_as.iter().map(|(_, id)| id).collect();
        assert!(heard_as.len() > 6, "{heard_as:?}");
        assert_eq!(signers.len(), heard_as.len(), "none twice");
        assert_eq!(stations.len(), heard_as.len(), "none twice");
    }
}
