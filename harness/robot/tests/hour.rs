//! An hour of ten robots that change their pseudonyms, as packets: for `harness/judges/linking`, which tries to tell
//! which pseudonyms are one robot.
//!
//! Time is virtual, and everything is drawn from one seed. Robots stand in pairs and now and then help somebody across
//! together. `hour.json` has the station ids of each robot, in order.

use std::collections::BTreeMap;
use std::error::Error;
use std::fs::File;
use std::path::PathBuf;
use std::time::Duration;

use crossguard_codec::security::{PrivateKey, Time64};
use crossguard_codec::si::timestamp_its;
use crossguard_codec::{Battery, Identifiers, Position, RobotState, SlowState};
use crossguard_endpoint::ras::surroundings::Awareness;
use crossguard_endpoint::station::{Mode, Secret, Security};
use crossguard_endpoint::{Effect, Endpoint, Moment, Stimulus};
use crossguard_protocol::{Config, Event, Identity, Phase, Robot, StationId};
use crossguard_robot::capture::Capture;
use crossguard_robot::pki::Pki;
use crossguard_robot::plan::Plan;
use crossguard_robot::site::Site;
use rand::{Rng, RngCore, SeedableRng};
use rand_chacha::ChaCha8Rng;

const ROBOTS: usize = 10;
const HOUR_MS: u64 = 3_600_000;
const STEP_MS: u64 = 20;
const PERIOD_MS: u64 = 60_000;
/// One more than there are changes in an hour.
const TICKETS: usize = 61;
/// 2026-01-05, in milliseconds since 1970.
const EPOCH_UNIX_MS: i64 = 1_767_571_201_000;
/// How long a session lasts, about.
const SESSION_MS: u64 = 5_000;

struct Seat {
    endpoint: Endpoint,
    state: RobotState,
    /// When it is next told that somebody wants to cross.
    detects_ms: u64,
    /// When the session that it leads ends.
    ends_ms: u64,
    stations: Vec<StationId>,
}

struct Hour {
    now_ms: u64,
    seats: Vec<Seat>,
    capture: Capture,
    draws: ChaCha8Rng,
}

fn its(ms: u64) -> u64 {
    timestamp_its(EPOCH_UNIX_MS + i64::try_from(ms).unwrap_or(i64::MAX))
}

impl Hour {
    fn new(capture: Capture) -> Result<Self, Box<dyn Error>> {
        let mut draws = ChaCha8Rng::seed_from_u64(18);
        let identifiers = Identifiers::default();
        let epoch = Time64::of_timestamp_its(its(0));
        let mut keys = ChaCha8Rng::seed_from_u64(81);
        let mut key = || {
            let mut octets = [0; 32];
            keys.fill_bytes(&mut octets);
            octets[0] &= 0x7f;
            PrivateKey::of_octets(&octets).expect("below the order of the curve")
        };
        let pki = Pki::with_keys(&identifiers, epoch, &mut key)?;
        let mut seats = Vec::new();
        for number in 0..ROBOTS {
            let tickets = (TICKETS, None);
            let credentials = pki.credentials_with_keys(&identifiers, tickets, epoch, &mut key)?;
            let mut octets = [0; 32];
            draws.fill_bytes(&mut octets);
            let security = Security::new(Mode::Enforce, credentials, Some(PERIOD_MS), epoch)?;
            let security = security.with_secret(Secret::new(octets));
            let station = security.station_id(&identifiers, StationId(0));
            let epoch = security.epoch(station, draws.random_range(1..200));
            let awareness = Awareness {
                cam: true,
                ..Awareness::default()
            };
            let robot = Robot::new(station, epoch);
            let endpoint = Endpoint::new(robot, Config::default(), identifiers, 0)
                .with_security(security)
                .with_awareness(awareness);
            // Each robot stands somewhere of its own, looks its own way, and has its own battery.
            let place = f64::from(u32::try_from(number)?);
            let state = RobotState {
                position: Position::at(48.7 + place * 1e-3, 9.1 + (place * 7.0) % 10.0 * 1e-3),
                heading: Some((place * 31.0 % 360.0).into()),
                battery: Battery {
                    state_of_charge: Some(40.0 + 5.0 * place),
                    ..Battery::default()
                },
                slow: Some(SlowState::default()),
                ..RobotState::default()
            };
            seats.push(Seat {
                endpoint,
                state,
                detects_ms: draws.random_range(10_000..400_000),
                ends_ms: u64::MAX,
                stations: vec![station],
            });
        }
        Ok(Self {
            now_ms: 0,
            seats,
            capture,
            draws,
        })
    }

    fn tell(&mut self, place: usize, stimulus: Stimulus<'_>) {
        let moment = Moment {
            now_ms: self.now_ms,
            timestamp_its: its(self.now_ms),
        };
        let seat = &mut self.seats[place];
        let effects = seat.endpoint.handle(moment, &seat.state.clone(), stimulus);
        let station = seat.endpoint.robot().station();
        if seat.stations.last() != Some(&station) {
            seat.stations.push(station);
        }
        for effect in effects {
            let Effect::Transmit { packet, .. } = effect else {
                continue;
            };
            let at_ms = u64::try_from(EPOCH_UNIX_MS).unwrap_or(0) + self.now_ms;
            self.capture
                .record_at(Duration::from_millis(at_ms), &packet);
            let partner = place ^ 1;
            // A packet that nobody needs to hear is not verified: that would take hours.
            let robots = [place, partner].map(|it| self.seats[it].endpoint.robot());
            if robots.iter().any(|it| it.identity() != Identity::Unlocked) {
                let arrived_ms = self.now_ms;
                let packet = &packet;
                self.tell(partner, Stimulus::Datagram { packet, arrived_ms });
            }
        }
    }

    fn step(&mut self) {
        self.now_ms += STEP_MS;
        for place in 0..ROBOTS {
            self.tell(place, Stimulus::Time);
            let seat = &mut self.seats[place];
            let leads = matches!(seat.endpoint.robot().phase(), Phase::Leading(_));
            if leads && self.now_ms >= seat.ends_ms {
                seat.ends_ms = u64::MAX;
                self.tell(place, Stimulus::Event(Event::TaskCompleted));
            } else if self.now_ms >= seat.detects_ms {
                seat.detects_ms = self.now_ms + self.draws.random_range(60_000..600_000);
                seat.ends_ms = self.now_ms + SESSION_MS;
                let request = Plan::crossing(Site::default()).request();
                self.tell(place, Stimulus::Event(Event::PedestrianDetected(request)));
            }
        }
    }
}

/// Writes the packets to `hour.pcap` and the truth to `hour.json`, in the folder that `CROSSGUARD_LINKING` names.
#[test]
#[ignore = "harness/judges/linking runs it"]
fn an_hour_of_ten_robots() -> Result<(), Box<dyn Error>> {
    let folder =
        std::env::var_os("CROSSGUARD_LINKING").ok_or("CROSSGUARD_LINKING names no folder")?;
    let folder = PathBuf::from(folder);
    let mut hour = Hour::new(Capture::create(&folder.join("hour.pcap"))?)?;
    while hour.now_ms < HOUR_MS {
        hour.step();
    }
    let stations = hour.seats.iter().map(|seat| &seat.stations);
    let robots: BTreeMap<_, _> = stations.enumerate().collect();
    serde_json::to_writer(File::create(folder.join("hour.json"))?, &robots)?;
    hour.capture.finish()?;
    Ok(())
}
