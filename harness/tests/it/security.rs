//! Packets that must not be believed, among a crossing that must go on; the modes; the PKI.

use std::fs::Permissions;
use std::net::UdpSocket;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use std::time::Duration as StdDuration;

use crossguard_codec::geonet::{EgoPosition, Stack};
use crossguard_codec::security::{
    Duration, Permission, PrivateKey, Ssp, Ticket, Time64, Unit, Validity, issue,
};
use crossguard_codec::{Identifiers, Part, RobotState, Service, encode, ram_from};

use crossguard_endpoint::station::{Credentials, Mode, Security};
use crossguard_protocol::{Availability, Config, Event, Input, Robot, StationId};
use crossguard_robot::pki::{self, Holder, Pki, Term};
use crossguard_robot::plan::Plan;
use crossguard_robot::site::Site;
use crossguard_testkit::command::*;

const GUEST: StationId = StationId(77);

fn identifiers() -> Identifiers {
    Identifiers::default()
}

fn ego(time: Time64) -> EgoPosition {
    EgoPosition {
        timestamp_its: time.0 / 1_000,
        ..EgoPosition::default()
    }
}

/// A station with one ticket.
fn station(pki: &Pki, id: StationId, mode: Mode, ticket: Holder, now: Time64) -> Stack {
    let credentials = Credentials {
        trust: pki.trust().unwrap(),
        tickets: vec![Ticket::new(ticket.certificate, ticket.key).unwrap()],
    };
    let security = Security::new(mode, credentials, None, now).unwrap();
    let mut stack = Stack::of_robot(identifiers(), id);
    *stack.envelope_mut() = security.envelope;
    stack
}

fn ticket(pki: &Pki, permissions: Vec<Permission>) -> Holder {
    let term = Term::hours(pki::now(), 1);
    pki::new_ticket(PrivateKey::generate(), &pki.authority, term, permissions).unwrap()
}

fn both_parts() -> Vec<Permission> {
    both_parts_as(GUEST)
}

fn both_parts_as(station: StationId) -> Vec<Permission> {
    pki::robot_permissions(&identifiers(), &[Part::Lead, Part::Help], Some(station))
}

fn guest(pki: &Pki) -> Stack {
    let ticket = ticket(pki, both_parts());
    station(pki, GUEST, Mode::Enforce, ticket, pki::now())
}

/// A RAM of a robot with this id that has no part in anything, or that asks for help.
fn ram(id: StationId, asks: bool) -> Vec<u8> {
    let mut robot = Robot::new(id, 1);
    if asks {
        let detected = Event::PedestrianDetected(Plan::crossing(Site::default()).request());
        robot.step(&Config::default(), Input::Local(detected));
    }
    let (ids, state) = (Identifiers::default(), RobotState::default());
    let view = robot.ram();
    let ram = ram_from(&ids, &state, &view, Availability::Available, 0, false).unwrap();
    encode(&ids, &ram).unwrap()
}

fn say(station: &mut Stack, message: &[u8]) -> Vec<u8> {
    station
        .packet(&ego(pki::now()), Service::Ram, message)
        .unwrap()
}

/// A packet that was signed just before its ticket was over.
fn expired(pki: &Pki) -> Vec<u8> {
    let now = pki::now();
    let start = u32::try_from(now.0 / 1_000_000).unwrap() - 30;
    let age_ms = now.0 / 1_000 - u64::from(start) * 1_000;
    let duration = Duration {
        number: u16::try_from(age_ms).unwrap() - 20,
        unit: Unit::Milliseconds,
    };
    let terms = issue::Terms::of_ticket(Validity { start, duration }, both_parts());
    let key = PrivateKey::generate();
    let authority = &pki.authority;
    let holder = key.public_key();
    let certificate =
        issue::ticket(&authority.certificate, &authority.key, holder, &terms).unwrap();
    let before = Time64(now.0 - 40_000);
    let ticket = Holder { certificate, key };
    let mut station = station(pki, GUEST, Mode::Enforce, ticket, before);
    let message = ram(GUEST, false);
    station
        .packet(&ego(before), Service::Ram, &message)
        .unwrap()
}

/// The robots' PKI, in a folder as `--pki` wants it.
fn written(folder: &Path) -> Pki {
    let pki = Pki::for_a_day(&identifiers(), pki::now()).unwrap();
    for (robot, station) in [("ARI", 1), ("Go2", 2)] {
        let folder = pki::robot_folder(folder, robot);
        let permissions = both_parts_as(StationId(station));
        pki::write_ticket(&ticket(&pki, permissions), &folder).unwrap();
        pki::write_certificate(&pki.root.certificate, &folder, "root").unwrap();
        pki::write_certificate(&pki.authority.certificate, &folder, "authority").unwrap();
    }
    pki
}

/// Stations that send what must not be believed, and a packet to be sent again and again.
struct Attackers {
    pki: Pki,
    honest: Stack,
    foreign: Stack,
    /// May help, but asks others for help.
    helper: Stack,
    /// May not send RAM or RMCM at all.
    other_service: Stack,
    poses_as_ari: Stack,
    repeated: Option<(Time64, Vec<u8>)>,
    old: Vec<u8>,
}

impl Attackers {
    fn new(pki: Pki) -> Self {
        let now = pki::now();
        let foreign = Pki::for_a_day(&identifiers(), now).unwrap();
        let help = pki::robot_permissions(&identifiers(), &[Part::Help], Some(StationId(78)));
        let cam = vec![Permission {
            its_aid: 36,
            ssp: Ssp::Bitmap(vec![1, 0, 0]),
        }];
        let of = |ticket, id| station(&pki, id, Mode::Enforce, ticket, now);
        let before = Time64(now.0 - 3_000_000);
        let mut early = of(ticket(&pki, both_parts()), GUEST);
        Self {
            honest: guest(&pki),
            foreign: guest(&foreign),
            helper: of(ticket(&pki, help), StationId(78)),
            other_service: of(ticket(&pki, cam), GUEST),
            poses_as_ari: of(ticket(&pki, both_parts_as(StationId(79))), StationId(79)),
            repeated: None,
            old: early
                .packet(&ego(before), Service::Ram, &ram(GUEST, false))
                .unwrap(),
            pki,
        }
    }

    fn packets(&mut self) -> Vec<Vec<u8>> {
        let idle = ram(GUEST, false);
        let good = say(&mut self.honest, &idle);
        let mut tampered = good.clone();
        // In the message, which is signed.
        tampered[60] ^= 1;
        let mut unknown = say(&mut self.honest, &idle);
        let signer = unknown.len() - 66 - 8;
        unknown[signer] ^= 1;
        // Signed for CAM, and sent as RAM: the ITS-AID in the header is not one of the ticket.
        let now = ego(pki::now());
        let mut wrong_permission = self
            .other_service
            .packet(&now, Service::Cam, &idle)
            .unwrap();
        let header = [0x40, 1, 36];
        let at = wrong_permission
            .windows(3)
            .position(|w| w == header)
            .unwrap();
        wrong_permission.splice(at + 1..at + 3, [2, 0x40, 0x60]);
        // And to the port of RAM: at that of CAM it is refused for the port.
        let port = |port: u16| port.to_be_bytes();
        // Behind the time of the position vector.
        let at = wrong_permission[40..]
            .windows(2)
            .position(|octets| octets == port(2_001))
            .unwrap();
        let at = 40 + at;
        wrong_permission[at..at + 2].copy_from_slice(&port(identifiers().ram.btp_port));
        let (time, repeated) = self
            .repeated
            .get_or_insert_with(|| (pki::now(), good.clone()))
            .clone();
        // The first ones are from before the start of the robots, and refused for that.
        if pki::now().0 - time.0 > 400_000 {
            self.repeated = None;
        }
        vec![
            // Its ticket is in it once in a second.
            good,
            tampered,
            expired(&self.pki),
            say(&mut self.foreign, &idle),
            wrong_permission,
            repeated.clone(),
            repeated,
            Stack::of_robot(identifiers(), GUEST)
                .packet(&now, Service::Ram, &idle)
                .unwrap(),
            unknown,
            self.old.clone(),
            say(&mut self.helper, &ram(StationId(78), true)),
            say(&mut self.poses_as_ari, &ram(StationId(1), true)),
        ]
    }
}

#[test]
fn the_crossing_goes_on_and_each_false_packet_is_rejected_under_its_own_cause() {
    let folder = tempfile::tempdir().unwrap();
    let mut attackers = Attackers::new(written(folder.path()));
    let security = format!(
        "--speed 5 --security enforce --pki {}",
        folder.path().display()
    );
    let (result, ()) = demo_under_attack(&security, |port, stop| {
        let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
        while !stop.load(Ordering::Relaxed) {
            for packet in attackers.packets() {
                for to in [port, port + 1] {
                    let _ = socket.send_to(&packet, ("127.0.0.1", to));
                }
            }
            std::thread::sleep(StdDuration::from_millis(50));
        }
    });
    assert_eq!(result["traceValid"], true);
    assert_eq!(result["security"], "enforce");
    for robot in ["ARI", "Go2"] {
        let counters = &result["counters"][robot];
        for cause in [
            "wrong signature",
            "certificate expired",
            "foreign root",
            "not permitted",
            "replayed",
            "not secured",
            "unknown certificate",
            "too old",
            "beyond service permissions",
        ] {
            let count = counters["security"][cause].as_u64();
            assert!(count > Some(0), "{robot}, {cause}: {counters}");
        }
    }
    // Only Go2 hears ARI, whose name was taken in vain.
    let counters = &result["counters"]["Go2"];
    let namesakes = counters["security"]["station id of another certificate"].as_u64();
    assert!(namesakes.unwrap_or_default() > 0, "{counters}");
}

#[test]
fn each_mode_takes_what_it_says() {
    let pki = Pki::for_a_day(&identifiers(), pki::now()).unwrap();
    let message = ram(GUEST, false);
    let mut off = Stack::of_robot(identifiers(), StationId(5));
    let of = |mode| {
        let ticket = ticket(&pki, both_parts());
        station(&pki, StationId(5), mode, ticket, pki::now())
    };
    let (mut sign, mut enforce) = (of(Mode::Sign), of(Mode::Enforce));
    // Packets that were signed before they started would be refused for that.
    let plain = say(&mut Stack::of_robot(identifiers(), GUEST), &message);
    let signed = say(&mut guest(&pki), &message);
    let mut forged = signed.clone();
    forged[60] ^= 1;
    let now = ego(pki::now());
    let taken = |station: &mut Stack| {
        [&plain, &forged, &signed].map(|packet| match station.receive(&now, packet) {
            Ok(indication) => {
                assert_eq!(indication.message, &message[..]);
                "taken"
            }
            Err(discarded) => discarded.cause(),
        })
    };
    let off_cause = "secured, and security is off";
    assert_eq!(taken(&mut off), ["taken", off_cause, off_cause]);
    assert_eq!(taken(&mut sign), ["taken", "wrong signature", "taken"]);
    assert_eq!(
        taken(&mut enforce),
        ["not secured", "wrong signature", "taken"]
    );
}

#[test]
fn a_demonstration_needs_no_pki_and_changes_pseudonyms_between_crossings() {
    let folder = tempfile::tempdir().unwrap();
    let log = folder.path().join("log.jsonl");
    let port = two_free_ports();
    let demo = format!(
        "demo --speed 40 --trials 2 --json --port {port} --log {}",
        log.display()
    );
    let security = "--security enforce --pseudonym-period 1";
    let result = json(&run_well(&format!("{demo} {security}")));
    assert_eq!(result["crossings"], 2);
    assert_eq!(result["traceValid"], true);
    let log = std::fs::read_to_string(log).unwrap();
    assert!(log.contains("identityChanged"), "no change");
}

#[test]
fn a_pki_is_made_shown_and_used_with_private_keys() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("pki");
    let pki = path.to_str().unwrap();
    let issued = json(&run(&["pki", "init", pki, "--json", "--count", "2"]));
    let kinds = issued.as_array().unwrap().iter();
    let kinds: Vec<_> = kinds.map(|it| &it["kind"]).collect();
    let expected = ["root", "authority", "ticket", "ticket", "ticket", "ticket"];
    assert_eq!(kinds, expected);
    // Tickets are valid for a day, and begin at moments that do not tell which robot they are of.
    let begins = issued.as_array().unwrap()[2..].iter().map(|ticket| {
        let [from, until] = ["validFrom", "validUntil"].map(|key| ticket[key].as_str().unwrap());
        let (day, time) = from.split_once('T').unwrap();
        let (next_day, same_time) = until.split_once('T').unwrap();
        assert!(day != next_day && time == same_time, "{ticket}");
        from
    });
    let begins: std::collections::BTreeSet<_> = begins.collect();
    assert!(begins.len() > 2, "{begins:?}");
    let shown = run(&["pki", "show", pki]);
    stdout(&shown).must_have(&["permits RAM (16480) with bits 01c0"]);
    assert_refused(&run(&["pki", "init", pki]), "exists");
    let guest = format!("pki tickets {pki} --robot guest --count 1 --part help --json");
    let guest = json(&run_well(&guest));
    assert_eq!(guest[0]["permissions"][0], "RAM (16480) with bits 0140");
    assert_eq!(guest[0]["isValidNow"], true);

    let robot = robot_file(folder.path(), "stray", 3, 40_001, 40_002);
    let run_stray = format!("run --config {robot} --security enforce --pki {pki}");
    assert_refused(&run_line(&run_stray), "stray");
    let tickets = std::fs::read_dir(path.join("robots/ARI/tickets")).unwrap();
    let mut tickets = tickets.map(|it| it.unwrap().path());
    let is_key = |it: &PathBuf| it.extension().is_some_and(|it| it == "key");
    let key = tickets.find(is_key).unwrap();
    let mode = std::fs::metadata(&key).unwrap().permissions().mode();
    assert_eq!(mode & 0o777, 0o600);
    std::fs::set_permissions(&key, Permissions::from_mode(0o640)).unwrap();
    let demo = run(&["demo", "--security", "enforce", "--pki", pki]);
    assert_refused(&demo, "can be read by others");
}
