//! Packets that are to be taken, and packets that are to be refused, each with the cause under which.
//!
//! They are in `codec/tests/golden/security.json` for other implementations, with the certificates that the receiver
//! trusts. `cargo xtask bless security.json` writes the file. Nothing of the kit encodes or signs what is in it.

use std::path::Path;
use std::sync::Once;
use std::{env, fs};

use crossguard_codec::geonet::{Demand, EgoPosition, Envelope as Around, Secured, Stack};
use crossguard_codec::security::{Certificate, Station, Ticket, Time64, Tolerances, TrustStore};
use crossguard_codec::{Identifiers, RobotState, Service, encode, ram_from};
use crossguard_protocol::{Availability, Robot, StationId};
use serde_json::{Value, json};

use crate::forge::{Envelope, Terms, issue_permissions, location, opaque, permissions};
use crate::pki::{NOW, NOW_S, after_ms};

/// ITS-AIDs.
const CAM: u32 = 36;
const DENM: u32 = 37;
const VAM: u32 = 638;
const RAM: u32 = 16_480;
const RMCM: u32 = 16_481;
const ALL: [u32; 5] = [CAM, DENM, VAM, RAM, RMCM];
/// Where receiver and senders are, in 10^-7 degree, and a place on its other side.
const HERE: (i32, i32) = (487_654_321, 91_234_567);
const ANTIPODE: (i32, i32) = (-487_654_321, -1_708_765_433);
/// Numbers of the keys.
const ROOT: u8 = 1;
const AUTHORITY: u8 = 2;
const SENDER: u8 = 10;
const RECEIVER: u8 = 11;
const STRANGER: u8 = 12;

/// One packet after the other, for a receiver that has heard nothing before.
struct Vector {
    name: &'static str,
    /// The clause that speaks of it.
    clause: &'static str,
    heard: Vec<Heard>,
}

struct Heard {
    packet: Vec<u8>,
    at: Time64,
    /// The cause under which it is refused; none, if it is taken.
    refused: Option<&'static str>,
}

/// The certificates of the scene.
struct Pki {
    root: Vec<u8>,
    authority: Vec<u8>,
    ticket: Vec<u8>,
}

fn terms(key: u8) -> Terms {
    Terms {
        name: None,
        start: NOW_S - 60,
        hours: 24,
        region: Vec::new(),
        permissions: permissions(&ALL),
        issue: Vec::new(),
        additions: Vec::new(),
        key,
    }
}

fn root() -> Vec<u8> {
    let terms = Terms {
        name: Some("root"),
        start: NOW_S - 3_600,
        hours: 1_000,
        permissions: Vec::new(),
        issue: issue_permissions(0x80, &ALL, &[1, 2]),
        ..terms(ROOT)
    };
    terms.signed(None, ROOT)
}

fn authority_terms() -> Terms {
    Terms {
        name: Some("authority"),
        start: NOW_S - 1_800,
        hours: 500,
        permissions: Vec::new(),
        issue: issue_permissions(0, &ALL, &[]),
        ..terms(AUTHORITY)
    }
}

impl Pki {
    fn new() -> Self {
        let root = root();
        let authority = authority_terms().signed(Some(&root), ROOT);
        let ticket = terms(SENDER).signed(Some(&authority), AUTHORITY);
        Self {
            root,
            authority,
            ticket,
        }
    }

    /// A ticket on other terms.
    fn other(&self, change: impl FnOnce(&mut Terms)) -> Vec<u8> {
        let mut terms = terms(SENDER);
        change(&mut terms);
        terms.signed(Some(&self.authority), AUTHORITY)
    }
}

fn identifiers() -> Identifiers {
    Identifiers::default()
}

fn ego(at: Time64, (latitude, longitude): (i32, i32)) -> EgoPosition {
    EgoPosition {
        timestamp_its: at.0 / 1_000,
        coordinates: Some((latitude, longitude)),
        is_accurate: true,
        ..EgoPosition::default()
    }
}

/// A packet without an envelope.
fn plain(service: Service, at: Time64, place: (i32, i32)) -> Vec<u8> {
    let robot = Robot::new(StationId(7), 1);
    let (ids, state) = (identifiers(), RobotState::default());
    let ram = ram_from(&ids, &state, &robot.ram(), Availability::Available, 0, true).unwrap();
    let message = encode(&ids, &ram).unwrap();
    let mut stack = Stack::of_robot(ids, StationId(7));
    stack.packet(&ego(at, place), service, &message).unwrap()
}

/// A packet around an envelope.
fn secured(envelope: &[u8]) -> Vec<u8> {
    let plain = plain(Service::Ram, NOW, HERE);
    let basic = [plain[0] & 0xf0 | 2, plain[1], plain[2], plain[3]];
    [&basic, envelope].concat()
}

/// An envelope around a message of this service, with the whole certificate.
fn envelope(pki: &Pki, service: Service, at: Time64) -> Envelope {
    Envelope {
        payload: plain(service, at, HERE)[4..].to_vec(),
        preamble: 0,
        its_aid: service.its_aid(&identifiers()),
        generated_us: at.0,
        fields: Vec::new(),
        additions: Vec::new(),
        certificate: pki.ticket.clone(),
        in_full: true,
        key: SENDER,
    }
}

/// Preamble bits of `HeaderInfo`.
const EXPIRY: u8 = 0x20;
const LOCATION: u8 = 0x10;

fn three_d(place: (i32, i32)) -> Vec<u8> {
    [location(place), vec![0x10, 0]].concat()
}

fn circle(centre: (i32, i32), metres: u16) -> Vec<u8> {
    let [high, low] = metres.to_be_bytes();
    [vec![0x80], location(centre), vec![high, low]].concat()
}

struct Vectors {
    pki: Pki,
    all: Vec<Vector>,
}

impl Vectors {
    fn add(&mut self, name: &'static str, clause: &'static str, heard: Vec<Heard>) {
        self.all.push(Vector {
            name,
            clause,
            heard,
        });
    }

    /// A message that is taken.
    fn takes(
        &mut self,
        (name, clause): (&'static str, &'static str),
        service: Service,
        change: impl FnOnce(&mut Envelope, &Pki),
    ) {
        self.one(name, clause, service, None, change);
    }

    /// A message that is refused.
    fn refuses(
        &mut self,
        (name, clause): (&'static str, &'static str),
        cause: &'static str,
        service: Service,
        change: impl FnOnce(&mut Envelope, &Pki),
    ) {
        self.one(name, clause, service, Some(cause), change);
    }

    fn one(
        &mut self,
        name: &'static str,
        clause: &'static str,
        service: Service,
        refused: Option<&'static str>,
        change: impl FnOnce(&mut Envelope, &Pki),
    ) {
        let mut envelope = envelope(&self.pki, service, NOW);
        change(&mut envelope, &self.pki);
        let packet = secured(&envelope.octets());
        self.add(name, clause, vec![heard(packet, NOW, refused)]);
    }

    /// A RAM whose octets are changed after it was signed.
    fn garbled(
        &mut self,
        (name, clause): (&'static str, &'static str),
        cause: &'static str,
        change: impl FnOnce(&mut Vec<u8>),
    ) {
        let mut octets = envelope(&self.pki, Service::Ram, NOW).octets();
        change(&mut octets);
        self.add(
            name,
            clause,
            vec![heard(secured(&octets), NOW, Some(cause))],
        );
    }
}

fn heard(packet: Vec<u8>, at: Time64, refused: Option<&'static str>) -> Heard {
    Heard {
        packet,
        at,
        refused,
    }
}

fn taken(all: &mut Vectors) {
    let of_profile = "TS 103 097 7.1.1";
    all.takes(
        ("a RAM with its certificate", of_profile),
        Service::Ram,
        |_, _| {},
    );
    all.takes(("an RMCM", of_profile), Service::Rmcm, |_, _| {});
    all.takes(("a CAM", of_profile), Service::Cam, |_, _| {});
    all.takes(
        ("a DENM where it was generated", "TS 103 097 7.1.2"),
        Service::Denm,
        |it, _| {
            it.preamble = LOCATION;
            it.fields = three_d(HERE);
        },
    );
    all.takes(
        ("a VAM that expires", "TS 103 097 7.1.3"),
        Service::Vam,
        |it, _| {
            it.preamble = EXPIRY;
            it.fields = (NOW.0 + 500_000).to_be_bytes().to_vec();
        },
    );
    all.takes(
        (
            "a request for a certificate, as in 2016",
            "IEEE 1609.2 6.3 HeaderInfo",
        ),
        Service::Ram,
        |it, _| {
            it.additions = [&[2, 6, 0x80][..], &opaque(&[1, 1, 0xaa, 0xbb, 0xcc])].concat();
        },
    );
    all.takes(
        (
            "a ticket for its region",
            "IEEE 1609.2 6.4 GeographicRegion",
        ),
        Service::Ram,
        |it, pki| {
            it.certificate = pki.other(|it| it.region = circle(HERE, 500));
        },
    );
    let first = envelope(&all.pki, Service::Ram, NOW);
    let mut second = envelope(&all.pki, Service::Ram, after_ms(100));
    second.in_full = false;
    let both = vec![
        heard(secured(&first.octets()), NOW, None),
        heard(secured(&second.octets()), after_ms(100), None),
    ];
    all.add(
        "a RAM by the digest of a certificate that is known",
        of_profile,
        both,
    );
}

fn profiles(all: &mut Vectors) {
    let header = |name| (name, "TS 103 097 5.2");
    let profile = "against profile";
    let expiry = |us: u64| (NOW.0 + us).to_be_bytes().to_vec();
    all.refuses(
        header("pduFunctionalType of another protocol"),
        "functional type of another protocol",
        Service::Ram,
        |it, _| it.additions = vec![2, 4, 0x20, 1, 1],
    );
    let robots = |name| (name, "TS 103 097 7.1.1");
    let cause = "expiry not allowed";
    for service in [Service::Ram, Service::Rmcm] {
        all.refuses(
            robots("expiryTime in RAM or RMCM"),
            cause,
            service,
            |it, _| {
                it.preamble = EXPIRY;
                it.fields = expiry(500_000);
            },
        );
        let cause = "generation location not allowed";
        all.refuses(
            robots("generationLocation in RAM or RMCM"),
            cause,
            service,
            |it, _| {
                it.preamble = LOCATION;
                it.fields = three_d(HERE);
            },
        );
    }
    all.refuses(
        robots("generationLocation in CAM"),
        profile,
        Service::Cam,
        |it, _| {
            it.preamble = LOCATION;
            it.fields = three_d(HERE);
        },
    );
    let denm = |name| (name, "TS 103 097 7.1.2");
    all.refuses(
        denm("a DENM without generationLocation"),
        profile,
        Service::Denm,
        |_, _| {},
    );
    all.refuses(denm("a DENM by digest"), profile, Service::Denm, |it, _| {
        it.preamble = LOCATION;
        it.fields = three_d(HERE);
        it.in_full = false;
    });
    for (bit, name) in [
        (0x08, "p2pcdLearningRequest"),
        (0x04, "missingCrlIdentifier"),
        (0x02, "encryptionKey"),
    ] {
        all.refuses(header(name), profile, Service::Ram, |it, _| {
            it.preamble = bit
        });
    }
    let times = |name| (name, "IEEE 1609.2 6.3 HeaderInfo");
    let cause = "expiry before generation";
    all.refuses(
        times("expiryTime that is generationTime"),
        cause,
        Service::Vam,
        |it, _| {
            it.preamble = EXPIRY;
            it.fields = expiry(0);
        },
    );
    all.refuses(
        times("expiryTime that is over"),
        "message expired",
        Service::Vam,
        |it, _| {
            it.generated_us -= 1_000_000;
            it.payload = plain(Service::Vam, Time64(it.generated_us), HERE)[4..].to_vec();
            it.preamble = EXPIRY;
            it.fields = (NOW.0 - 1).to_be_bytes().to_vec();
        },
    );
    let cause = "malformed envelope";
    all.refuses(
        header("a bitmap of additions of which none is there"),
        cause,
        Service::Ram,
        |it, _| {
            it.additions = vec![2, 4, 0];
        },
    );
}

fn places_and_times(all: &mut Vectors) {
    let nowhere = (2_000_000_000, HERE.1);
    let on_earth = |name| (name, "IEEE 1609.2 6.3 Latitude, Longitude");
    let cause = "place not on earth";
    all.refuses(
        on_earth("generationLocation at 200 degrees"),
        cause,
        Service::Vam,
        |it, _| {
            it.preamble = LOCATION;
            it.fields = three_d(nowhere);
        },
    );
    all.refuses(
        on_earth("source position at 200 degrees"),
        cause,
        Service::Ram,
        |it, _| {
            it.payload = plain(Service::Ram, NOW, nowhere)[4..].to_vec();
        },
    );
    all.refuses(
        on_earth("a region at 200 degrees"),
        cause,
        Service::Ram,
        |it, pki| {
            it.certificate = pki.other(|it| it.region = circle(nowhere, 500));
        },
    );
    let region = |name| (name, "IEEE 1609.2 5.2 consistency with the certificate");
    // 2.2 km to the north of the region.
    let outside = (HERE.0 + 200_000, HERE.1);
    let cause = "outside region";
    all.refuses(
        region("a sender outside of the region of its ticket"),
        cause,
        Service::Ram,
        |it, pki| {
            it.payload = plain(Service::Ram, NOW, outside)[4..].to_vec();
            it.certificate = pki.other(|it| it.region = circle(HERE, 500));
        },
    );
    all.refuses(
        region("generationLocation within the region, and the sender outside"),
        cause,
        Service::Denm,
        |it, pki| {
            it.payload = plain(Service::Denm, NOW, outside)[4..].to_vec();
            it.preamble = LOCATION;
            it.fields = three_d(HERE);
            it.certificate = pki.other(|it| it.region = circle(HERE, 500));
        },
    );
    let elsewhere = "generation location elsewhere";
    let there = (
        "generationLocation 22 km away from the sender",
        "TS 103 097 7.1.2",
    );
    all.refuses(there, elsewhere, Service::Denm, |it, _| {
        it.preamble = LOCATION;
        it.fields = three_d((HERE.0 + 2_000_000, HERE.1));
    });
    let plausible = |name| (name, "IEEE 1609.2 5.2 relevance");
    all.refuses(
        plausible("a sender on the other side of the earth"),
        "too far away",
        Service::Ram,
        |it, _| {
            it.payload = plain(Service::Ram, NOW, ANTIPODE)[4..].to_vec();
        },
    );
    let cause = "position vector of another time";
    for (name, at) in [
        ("a GeoNetworking time of an hour ago", NOW.0 - 3_600_000_000),
        (
            "a GeoNetworking time of half a second ahead",
            NOW.0 + 500_000,
        ),
    ] {
        all.refuses(plausible(name), cause, Service::Ram, |it, _| {
            it.payload = plain(Service::Ram, Time64(at), HERE)[4..].to_vec();
        });
    }
    for (name, cause, generated_us) in [
        ("generated 2.1 s ago", "too old", NOW.0 - 2_100_000),
        (
            "generated in the future",
            "from the future",
            NOW.0 + 230_000,
        ),
    ] {
        all.refuses(plausible(name), cause, Service::Ram, |it, _| {
            it.generated_us = generated_us;
            it.payload = plain(Service::Ram, Time64(generated_us), HERE)[4..].to_vec();
        });
    }
}

fn certificates(all: &mut Vectors) {
    let of = |name| (name, "IEEE 1609.2 6.4");
    let mut bad = |name, clause, cause, change: fn(&mut Terms)| {
        all.refuses((name, clause), cause, Service::Ram, |it, pki| {
            it.certificate = pki.other(change);
        });
    };
    let (content, chain) = (
        "IEEE 1609.2 6.4 ToBeSignedCertificate",
        "IEEE 1609.2 5.1 chains",
    );
    bad(
        "a ticket with an extension",
        content,
        "certificate extension",
        |it| {
            it.additions = vec![2, 4, 0x80, 1, 0];
        },
    );
    bad(
        "a default that is spelled out",
        "IEEE 1609.2 6.4 PsidGroupPermissions, COER",
        "explicit default",
        |it| {
            it.issue = issue_permissions(0x20, &ALL, &[0x80]);
        },
    );
    bad(
        "a ticket with a name",
        "TS 103 097 7.2.1",
        "not a ticket",
        |it| it.name = Some("me"),
    );
    bad(
        "a ticket that is over",
        chain,
        "certificate expired",
        |it| {
            it.start = NOW_S - 1_800;
            it.hours = 0;
        },
    );
    bad(
        "a ticket that is not valid yet",
        chain,
        "certificate not yet valid",
        |it| {
            it.start = NOW_S + 60;
        },
    );
    bad(
        "a ticket that outlives its issuer",
        chain,
        "validity beyond issuer",
        |it| it.hours = 900,
    );
    bad(
        "a permission that its issuer may not give",
        chain,
        "issuer not permitted",
        |it| {
            it.permissions = permissions(&[RAM, 637]);
        },
    );
    bad(
        "a ticket for another service",
        "IEEE 1609.2 5.2 consistency with the certificate",
        "not permitted",
        |it| {
            it.permissions = permissions(&[CAM]);
        },
    );
    all.refuses(
        ("a ticket of another root", chain),
        "foreign root",
        Service::Ram,
        |it, _| {
            let other = authority_terms().signed(Some(&[1, 2, 3]), STRANGER);
            it.certificate = terms(SENDER).signed(Some(&other), AUTHORITY);
        },
    );
    all.refuses(
        of("a ticket that its authority has not signed"),
        "wrong certificate signature",
        Service::Ram,
        |it, pki| {
            it.certificate = terms(SENDER).signed(Some(&pki.authority), STRANGER);
        },
    );
    all.refuses(
        of("a certificate that is not known, by its digest"),
        "unknown certificate",
        Service::Ram,
        |it, _| {
            it.in_full = false;
        },
    );
    all.refuses(
        ("the permission of another service", "TS 103 097 7.1"),
        "wrong permission for port",
        Service::Ram,
        |it, _| {
            it.its_aid = RMCM;
        },
    );
}

fn signatures(all: &mut Vectors) {
    let structure = |name| (name, "IEEE 1609.2 6.3");
    let malformed = "malformed envelope";
    all.garbled(structure("protocolVersion 2"), malformed, |it| it[0] = 2);
    all.garbled(structure("unsecured data"), "not signed", |it| it[1] = 0x80);
    all.garbled(
        structure("a hash other than SHA-256"),
        "unsupported",
        |it| it[2] = 1,
    );
    all.garbled(
        structure("an octet behind the signature"),
        malformed,
        |it| it.push(0),
    );
    all.garbled(structure("the last octet missing"), malformed, |it| {
        it.truncate(it.len() - 1)
    });
    all.garbled(
        structure("a signature on another curve"),
        "unsupported",
        |it| {
            let at = it.len() - 66;
            it[at] = 0x81;
        },
    );
    all.garbled(structure("rSig as a whole point"), "unsupported", |it| {
        let at = it.len() - 65;
        it[at] = 0x82;
    });
    all.garbled(structure("a signature of zeros"), malformed, |it| {
        let at = it.len() - 64;
        it[at..].fill(0);
    });
    let (name, clause) = ("no generationTime", "TS 103 097 5.2");
    let signed = envelope(&all.pki, Service::Ram, NOW);
    let head = [0x40, 2, 0x40, 0x60];
    all.garbled((name, clause), "against profile", |it| {
        let at = it.windows(4).position(|octets| octets == head).unwrap();
        it[at] = 0;
    });
    all.refuses(
        structure("signed with another key"),
        "wrong signature",
        Service::Ram,
        |it, _| {
            it.key = STRANGER;
        },
    );
    let twice = || secured(&signed.octets());
    let again = vec![
        heard(twice(), NOW, None),
        heard(twice(), after_ms(10), Some("replayed")),
    ];
    all.add("the same packet again", "IEEE 1609.2 5.2 replay", again);
    let mut forged = signed.clone();
    forged.key = STRANGER;
    let packet = secured(&forged.octets());
    let twice = vec![
        heard(packet.clone(), NOW, Some("wrong signature")),
        heard(packet, after_ms(10), Some("refused before")),
    ];
    all.add("a forged packet twice", "IEEE 1609.2 5.3.1", twice);
    let unsecured = heard(plain(Service::Ram, NOW, HERE), NOW, Some("not secured"));
    all.add(
        "a packet without an envelope",
        "TS 103 097 7.1",
        vec![unsecured],
    );
}

fn vectors() -> Vectors {
    let mut all = Vectors {
        pki: Pki::new(),
        all: Vec::new(),
    };
    taken(&mut all);
    profiles(&mut all);
    places_and_times(&mut all);
    certificates(&mut all);
    signatures(&mut all);
    all
}

/// A receiver that trusts these certificates and has heard nothing.
fn receiver(root: &[u8], authority: &[u8]) -> Stack {
    let mut trust = TrustStore::default();
    trust.add_root(Certificate::decode(root).unwrap()).unwrap();
    trust
        .add_authority(Certificate::decode(authority).unwrap())
        .unwrap();
    let own = terms(RECEIVER).signed(Some(authority), AUTHORITY);
    let ticket = Ticket::new(
        Certificate::decode(&own).unwrap(),
        crate::pki::key(RECEIVER),
    );
    let station = Station::new(trust, vec![ticket.unwrap()], Tolerances::default(), NOW).unwrap();
    let mut stack = Stack::of_robot(identifiers(), StationId(8));
    let secured = Secured::new(station, Demand::Signature);
    *stack.envelope_mut() = Around::Secured(Box::new(secured));
    stack
}

/// How many signatures a receiver has checked.
fn signatures_of(receiver: &Stack) -> u64 {
    match receiver.envelope() {
        Around::Secured(secured) => secured.station().verifier().signatures(),
        _ => unreachable!("it is secured"),
    }
}

fn to_hex(octets: &[u8]) -> String {
    octets.iter().map(|octet| format!("{octet:02x}")).collect()
}

fn from_hex(text: &Value) -> Vec<u8> {
    let digits = text.as_str().unwrap().as_bytes().chunks(2);
    let octet = |two| u8::from_str_radix(std::str::from_utf8(two).unwrap(), 16).unwrap();
    digits.map(octet).collect()
}

fn path() -> impl AsRef<Path> {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/security.json")
}

fn as_json(vectors: &Vectors) -> Value {
    let packet = |it: &Heard| {
        json!({
            "octets": to_hex(&it.packet),
            "heardAtUs": it.at.0,
            "refused": it.refused,
        })
    };
    let vector = |it: &Vector| {
        json!({
            "name": it.name,
            "clause": it.clause,
            "packets": it.heard.iter().map(packet).collect::<Vec<_>>(),
        })
    };
    json!({
        "about": [
            "GeoNetworking packets behind the link layer, secured by TS 103 097 v2.1.1 on IEEE 1609.2.",
            "Each vector is for a receiver that has heard nothing before, demands a signature, trusts the root and the \
             authority, and is at the place given. It hears the packets in order, at heardAtUs (Time64).",
            "refused is null for a packet that is taken, or else the cause under which this kit counts it. What the \
             standards leave to the receiver is 2 s of age, 220 ms ahead, and 10 km of distance here.",
            "The messages in the packets are all the same RAM: only what is under a message is judged."
        ],
        "root": to_hex(&vectors.pki.root),
        "authority": to_hex(&vectors.pki.authority),
        "receiver": {"latitude": HERE.0, "longitude": HERE.1},
        "itsAid": {"cam": CAM, "denm": DENM, "vam": VAM, "ram": RAM, "rmcm": RMCM},
        "vectors": vectors.all.iter().map(vector).collect::<Vec<_>>(),
    })
}

/// What is in the file, which is written before if that is wanted.
fn file() -> Value {
    static BLESSED: Once = Once::new();
    BLESSED.call_once(|| {
        if env::var_os("CROSSGUARD_BLESS").is_some() {
            let text = serde_json::to_string_pretty(&as_json(&vectors())).unwrap();
            fs::write(path(), text + "\n").unwrap();
        }
    });
    serde_json::from_str(&fs::read_to_string(path()).unwrap()).unwrap()
}

#[test]
fn the_vectors_are_those_of_the_file() {
    let is_same = file() == as_json(&vectors());
    assert!(is_same, "cargo xtask bless security.json");
}

#[test]
fn every_packet_of_the_file_is_taken_or_refused_under_its_cause() {
    let file = file();
    let (root, authority) = (from_hex(&file["root"]), from_hex(&file["authority"]));
    let mut wrong = Vec::new();
    let mut causes = std::collections::BTreeSet::new();
    for vector in file["vectors"].as_array().unwrap() {
        let mut receiver = receiver(&root, &authority);
        for packet in vector["packets"].as_array().unwrap() {
            let now = Time64(packet["heardAtUs"].as_u64().unwrap());
            let octets = from_hex(&packet["octets"]);
            let before = signatures_of(&receiver);
            let heard = receiver.receive(&ego(now, HERE), &octets);
            let refused = heard.err().map(|discarded| discarded.cause());
            let expected = packet["refused"].as_str();
            causes.extend(expected.map(str::to_owned));
            if refused != expected {
                wrong.push(format!("{}: {refused:?}, not {expected:?}", vector["name"]));
            }
            // Nothing is spent on a packet that something else is wrong with.
            let spent = signatures_of(&receiver) - before;
            let is_dear = refused.is_none_or(|cause| cause.ends_with("signature"));
            if (spent > 0) != is_dear || spent > 2 {
                wrong.push(format!("{}: {spent} signatures", vector["name"]));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(causes.len() > 25, "{causes:?}");
}

#[test]
fn an_authority_is_taken_when_it_was_asked_for() {
    let pki = Pki::new();
    let authority = Terms {
        name: Some("late"),
        ..authority_terms()
    };
    let authority = authority.signed(Some(&pki.root), ROOT);
    let ticket = terms(SENDER).signed(Some(&authority), AUTHORITY);
    let say = |at, in_full, brings: Option<&[u8]>| {
        let mut it = envelope(&pki, Service::Ram, at);
        it.certificate = ticket.clone();
        it.in_full = in_full;
        it.additions = brings.map_or(Vec::new(), |certificate| {
            [&[2, 4, 0x40][..], &opaque(certificate)].concat()
        });
        secured(&it.octets())
    };
    let mut receiver = receiver(&pki.root, &pki.authority);
    let mut hear = |at, packet: &[u8]| {
        let heard = receiver.receive(&ego(at, HERE), packet);
        let cause = heard.err().map(|it| it.cause());
        (cause, signatures_of(&receiver))
    };
    // Nobody asked: it is not looked at, and the ticket is not known.
    let unasked = say(NOW, false, Some(&authority));
    assert_eq!(hear(NOW, &unasked), (Some("unknown certificate"), 0));
    assert_eq!(hear(NOW, &say(NOW, true, None)), (Some("foreign root"), 0));
    // One with another name is another authority.
    assert_eq!(hear(NOW, &say(NOW, false, Some(&pki.authority))).1, 0);
    // A forged one, which has the name that was asked for, cannot be made: that takes its digest.
    let at = after_ms(100);
    let asked = say(at, false, Some(&authority));
    assert_eq!(hear(at, &asked), (Some("unknown certificate"), 1));
    let at = after_ms(200);
    assert_eq!(hear(at, &say(at, true, None)), (None, 3));
}
