//! Hazard: a robot's clock is put back, or it lost power, and what was said before is taken for new.

use std::collections::BTreeMap;

use crossguard_codec::security::Time64;
use crossguard_codec::{Identifiers, Position, RobotState};
use crossguard_endpoint::station::{Mode, Security};
use crossguard_endpoint::{Effect, Endpoint, Moment, Stimulus};
use crossguard_protocol::{Config, Robot, StationId};
use crossguard_robot::pki::Pki;

/// 2026-01-05, in milliseconds since 2004.
const EPOCH_ITS: u64 = 694_694_401_000;

/// A robot with a wall clock that can be put wrong.
struct Clocked {
    robot: Endpoint,
    /// Lead of its wall clock, in ms.
    ahead_ms: i64,
    heard: usize,
    dropped: BTreeMap<String, usize>,
}

impl Clocked {
    /// A robot that starts now, and knows a time from before.
    fn start(pki: &Pki, now_ms: u64, ahead_ms: i64, known: Option<Time64>) -> Self {
        let identifiers = Identifiers::default();
        let epoch = Time64::of_timestamp_its(EPOCH_ITS);
        let credentials = pki.credentials(&identifiers, (1, None), epoch).unwrap();
        let shown = (EPOCH_ITS + now_ms).strict_add_signed(ahead_ms);
        let now = Time64::of_timestamp_its(shown);
        let security = Security::new(Mode::Enforce, credentials, None, now).unwrap();
        let security = security.since(known.unwrap_or_default());
        let station = security.station_id(&identifiers, StationId(1));
        let robot = Robot::new(station, security.epoch(station, 1));
        Self {
            robot: Endpoint::new(robot, Config::default(), identifiers, now_ms)
                .with_security(security),
            ahead_ms,
            heard: 0,
            dropped: BTreeMap::new(),
        }
    }

    /// Packets that it sends.
    fn tell(&mut self, now_ms: u64, stimulus: Stimulus<'_>) -> Vec<Vec<u8>> {
        let moment = Moment {
            now_ms,
            timestamp_its: (EPOCH_ITS + now_ms).strict_add_signed(self.ahead_ms),
        };
        let state = RobotState {
            position: Position::at(48.765_432_1, 9.123_456_7),
            ..RobotState::default()
        };
        let mut packets = Vec::new();
        for effect in self.robot.handle(moment, &state, stimulus) {
            match effect {
                Effect::Transmit { packet, .. } => packets.push(packet),
                Effect::Heard { .. } => self.heard += 1,
                Effect::Dropped { cause, .. } => {
                    *self.dropped.entry(cause.reason().to_string()).or_default() += 1;
                }
                _ => {}
            }
        }
        packets
    }

    fn hear(&mut self, now_ms: u64, packet: &[u8]) {
        let arrived_ms = now_ms;
        self.tell(now_ms, Stimulus::Datagram { packet, arrived_ms });
    }

    fn mark(&self) -> Time64 {
        self.robot.trusted_time().unwrap().mark()
    }
}

fn pki() -> Pki {
    Pki::for_a_day(&Identifiers::default(), Time64::of_timestamp_its(EPOCH_ITS)).unwrap()
}

/// The RAM that a robot sends in this second.
fn ram(robot: &mut Clocked, now_ms: u64) -> Vec<u8> {
    let mut packets = robot.tell(now_ms, Stimulus::Time);
    packets.pop().expect("it is a second since the last")
}

#[test]
fn what_was_captured_before_a_restart_is_refused_after_it_whatever_the_clock_shows() {
    let pki = pki();
    // The sender's clock is as far ahead as it may be: by that of the receiver, the packet is of after the restart.
    let mut sender = Clocked::start(&pki, 0, 200, None);
    let mut receiver = Clocked::start(&pki, 0, 0, None);
    let captured = ram(&mut sender, 1_000);
    receiver.hear(1_000, &captured);
    assert_eq!(receiver.heard, 1);
    let known = receiver.mark();
    for (ahead_ms, cause, now_ms) in [
        (0, "before the start", 2_100),
        (-4_000, "time not trusted", 3_100),
    ] {
        let mut receiver = Clocked::start(&pki, 1_100, ahead_ms, Some(known));
        receiver.hear(1_100, &captured);
        assert_eq!(receiver.heard, 0);
        assert_eq!(receiver.dropped, BTreeMap::from([(cause.to_owned(), 1)]));
        // With the right time it goes on by itself.
        receiver.ahead_ms = 0;
        let newer = ram(&mut sender, now_ms);
        receiver.hear(now_ms, &newer);
        assert_eq!(receiver.heard, 1);
    }
}
