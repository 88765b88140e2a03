//! Robots that take nothing unsigned, beside stations that another implementation encoded and signed, in the forms that
//! IEEE 1609.2 allows and this kit does not use: they are heard, they are on the map, and pedestrians wait for the car.
//! `codec/judges/beside.py` makes `beside.json`. Its car passes the crossing 9 s after its first message.

mod support;
#[path = "support/zone.rs"]
mod zone;

use std::collections::BTreeMap;

use crossguard_codec::security::{Certificate, PrivateKey, Time64};
use crossguard_codec::{Identifiers, Identity, Kind, Part};
use crossguard_endpoint::ras::clustering::PerceivedVru;
use crossguard_endpoint::station::{Mode, Security};
use crossguard_endpoint::{Effect, Stimulus};
use crossguard_protocol::{Millis, Output, StationId};
use crossguard_robot::body::Build;
use crossguard_robot::perception::SensorFrame;
use crossguard_robot::pki::{self, Pki, Term};
use crossguard_robot::plan::Plan;
use crossguard_robot::site::{Place, Site};
use crossguard_robot::street::Road;
use serde::Deserialize;

use self::support::{BEGAN_ITS, Street, TICK_MS};

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Others {
    /// When they began, in ms of `TimestampIts`.
    began_its: u64,
    #[serde(with = "hex")]
    root: Vec<u8>,
    #[serde(with = "hex")]
    authority: Vec<u8>,
    /// The station ids, by the message that they send.
    stations: BTreeMap<String, u32>,
    packets: Vec<Packet>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Packet {
    /// How long after they began it is sent.
    at_ms: u64,
    #[serde(with = "hex")]
    octets: Vec<u8>,
}

impl Others {
    fn read() -> Self {
        serde_json::from_str(include_str!("beside.json")).unwrap()
    }

    /// When something that they say is sent, on the clock of the street.
    fn sent_ms(&self, packet: &Packet) -> u32 {
        self.street_ms(packet.at_ms)
    }

    fn street_ms(&self, at_ms: u64) -> u32 {
        u32::try_from(self.began_its + at_ms - BEGAN_ITS).unwrap()
    }
}

/// The leader's sign, and its drops.
#[derive(Default)]
struct Done {
    shows_go: bool,
    dropped: BTreeMap<String, usize>,
}

impl Done {
    #[expect(clippy::needless_pass_by_value, reason = "a street gives effects away")]
    fn note(&mut self, robot: usize, effect: Effect) {
        match effect {
            _ if robot != LEADER => {}
            Effect::Act(Output::CorridorOpened(_), _) => self.shows_go = true,
            Effect::Act(Output::CorridorClosed(_), _) => self.shows_go = false,
            Effect::Dropped { cause, .. } => {
                *self.dropped.entry(cause.reason().to_string()).or_default() += 1;
            }
            _ => {}
        }
    }
}

const LEADER: usize = 0;

/// A leader that watches a crossing, and a helper. In the folder of each are the others' root and authority beside its own.
fn street(others: &Others) -> Street<Done> {
    let identifiers = Identifiers::default();
    let now = Time64::of_timestamp_its(BEGAN_ITS);
    let own = Pki::for_a_day(&identifiers, now).unwrap();
    let [root, authority] =
        [&others.root, &others.authority].map(|it| Certificate::decode(it).unwrap());
    let machine = |station, build, plan, road| {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        let parts = [Part::Lead, Part::Help];
        let permissions = pki::robot_permissions(&identifiers, &parts, Some(StationId(station)));
        let term = Term::hours(now, 1);
        let ticket =
            pki::new_ticket(PrivateKey::generate(), &own.authority, term, permissions).unwrap();
        pki::write_ticket(&ticket, folder).unwrap();
        for (certificate, name) in [
            (&own.root.certificate, "root"),
            (&own.authority.certificate, "authority"),
            (&root, "root-of-others"),
            (&authority, "authority-of-others"),
        ] {
            pki::write_certificate(certificate, folder, name).unwrap();
        }
        let credentials = pki::read_credentials(folder).unwrap();
        let security = Security::new(Mode::Enforce, credentials, None, now).unwrap();
        let body = (build, Place::new(-f64::from(station), -2.0), 5.0);
        support::machine(station, body, plan, road, security)
    };
    let plan = Some(Plan::crossing(Site::default()));
    let leader = machine(
        1,
        Build::Humanoid,
        plan,
        Road::Watched(zone::of_the_crossing()),
    );
    let helper = machine(2, Build::Quadruped, None, Road::Unknown);
    Street::new(vec![Some(leader), Some(helper)], Done::note)
}

/// When go is shown to a person who begins to wait at this time, and the street then.
fn crossing(others: &Others, waits_from_ms: u32) -> (u32, Street<Done>) {
    let mut street = street(others);
    let waiting = PerceivedVru {
        confidence: 0.9,
        ..PerceivedVru::pedestrian(7, [1.0, -0.8])
    };
    while !street.notes.shows_go {
        assert!(street.now_ms < waits_from_ms + 60_000, "never");
        let next_ms = street.now_ms + TICK_MS;
        if next_ms.is_multiple_of(100) && next_ms >= waits_from_ms {
            let frame = SensorFrame::of(&[waiting]);
            let leader = &mut street.robot(LEADER).application;
            leader.look(&frame, Millis(0));
        }
        let now_ms = street.now_ms;
        for packet in &others.packets {
            if others.sent_ms(packet) == now_ms {
                for robot in 0..2 {
                    let packet = &packet.octets;
                    let arrived_ms = now_ms.into();
                    street.tell(robot, Stimulus::Datagram { packet, arrived_ms });
                }
            }
        }
        street.pass(TICK_MS);
    }
    (street.now_ms, street)
}

#[test]
fn pedestrians_wait_for_a_car_that_another_implementation_signed() {
    let mut others = Others::read();
    let packets = std::mem::take(&mut others.packets);
    let (alone_ms, _) = crossing(&others, 1_000);
    // Go would be shown 2 s before the car is there, which takes 61 m to stop and is 28 m away.
    let waits_from_ms = others.street_ms(7_000) - (alone_ms - 1_000);
    others.packets = packets;
    let (go_ms, mut street) = crossing(&others, waits_from_ms);
    assert!(go_ms > others.street_ms(9_200), "{go_ms}: the car is on it");
    assert!(go_ms < others.street_ms(12_000), "{go_ms}: it is gone");
    assert_eq!(street.notes.dropped, BTreeMap::new());
    let map = street.robot(LEADER).endpoint.map();
    for (sent, kind) in [
        ("CAM", Kind::Vehicle),
        ("VAM", Kind::Vru),
        ("RAM", Kind::Robot),
    ] {
        let known = map.get(Identity::Station(others.stations[sent]));
        assert_eq!(known.map(|it| it.user.kind), Some(kind), "{sent}");
    }

    // With wrong signatures nobody is heard, and go is shown in front of the car.
    for packet in &mut others.packets {
        *packet.octets.last_mut().unwrap() ^= 1;
    }
    let (go_ms, mut street) = crossing(&others, waits_from_ms);
    assert!(go_ms < others.street_ms(8_000), "{go_ms}");
    let map = street.robot(LEADER).endpoint.map();
    let car = map.get(Identity::Station(others.stations["CAM"]));
    assert!(car.is_none(), "{car:?}");
    assert!(!street.notes.dropped.is_empty());
}
