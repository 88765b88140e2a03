//! The scene of the vectors: certificates, senders, and packets part by part.

use crossguard_codec::geonet::{EgoPosition, Stack};
use crossguard_codec::security::Time64;
use crossguard_codec::{Identifiers, RobotState, Service, encode, ram_from};
use crossguard_protocol::{Availability, Robot, StationId};

use super::forge::{Envelope, Terms, issue_permissions, location, permissions};
use super::pki::{CAM, NOW, NOW_S, RAM, RMCM};

/// ITS-AIDs.
pub(crate) const DENM: u32 = 37;
pub(crate) const VAM: u32 = 638;
pub(crate) const ALL: [u32; 5] = [CAM, DENM, VAM, RAM, RMCM];
/// Where receiver and senders are, in 10^-7 degree, and a place on its other side.
pub(crate) const HERE: (i32, i32) = (487_654_321, 91_234_567);
pub(crate) const ANTIPODE: (i32, i32) = (-487_654_321, -1_708_765_433);
/// Numbers of the keys.
pub(crate) const ROOT: u8 = 1;
pub(crate) const AUTHORITY: u8 = 2;
pub(crate) const SENDER: u8 = 10;
pub(crate) const RECEIVER: u8 = 11;
pub(crate) const STRANGER: u8 = 12;

/// One packet after the other, for a receiver that has heard nothing before.
pub(crate) struct Vector {
    pub(crate) name: &'static str,
    /// The clause that speaks of it.
    pub(crate) clause: &'static str,
    pub(crate) heard: Vec<Heard>,
}

pub(crate) struct Heard {
    pub(crate) packet: Vec<u8>,
    pub(crate) at: Time64,
    /// The cause under which it is refused; none, if it is taken.
    pub(crate) refused: Option<&'static str>,
}

/// The certificates of the scene.
pub(crate) struct Pki {
    pub(crate) root: Vec<u8>,
    pub(crate) authority: Vec<u8>,
    pub(crate) ticket: Vec<u8>,
}

pub(crate) fn terms(key: u8) -> Terms {
    Terms {
        name: None,
        start: NOW_S - 60,
        hours: 24,
        unit: 4,
        region: Vec::new(),
        assurance: Vec::new(),
        permissions: permissions(&ALL),
        issue: Vec::new(),
        encryption: Vec::new(),
        additions: Vec::new(),
        key,
    }
}

pub(crate) fn root() -> Vec<u8> {
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

pub(crate) fn authority_terms() -> Terms {
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
    pub(crate) fn new() -> Self {
        let root = root();
        let authority = authority_terms().signed(Some(&root), ROOT);
        let ticket = terms(SENDER).signed(Some(&authority), AUTHORITY);
        Self {
            root,
            authority,
            ticket,
        }
    }
}

pub(crate) fn identifiers() -> Identifiers {
    Identifiers::default()
}

pub(crate) fn ego(at: Time64, (latitude, longitude): (i32, i32)) -> EgoPosition {
    EgoPosition {
        timestamp_its: at.0 / 1_000,
        coordinates: Some((latitude, longitude)),
        is_accurate: true,
        ..EgoPosition::default()
    }
}

/// A packet without an envelope.
pub(crate) fn plain(service: Service, at: Time64, place: (i32, i32)) -> Vec<u8> {
    let robot = Robot::new(StationId(7), 1);
    let (ids, state) = (identifiers(), RobotState::default());
    let ram = ram_from(&ids, &state, &robot.ram(), Availability::Available, 0, true).unwrap();
    let message = encode(&ids, &ram).unwrap();
    let mut stack = Stack::of_robot(ids, StationId(7));
    stack.packet(&ego(at, place), service, &message).unwrap()
}

/// A packet around an envelope.
pub(crate) fn secured(envelope: &[u8]) -> Vec<u8> {
    let plain = plain(Service::Ram, NOW, HERE);
    let basic = [plain[0] & 0xf0 | 2, plain[1], plain[2], plain[3]];
    [&basic, envelope].concat()
}

/// An envelope around a message of this service, with the whole certificate.
pub(crate) fn envelope(pki: &Pki, service: Service, at: Time64) -> Envelope {
    Envelope {
        payload: plain(service, at, HERE)[4..].to_vec(),
        preamble: 0,
        its_aid: service.its_aid(&identifiers()),
        generated_us: at.0,
        fields: Vec::new(),
        additions: Vec::new(),
        certificate: pki.ticket.clone(),
        sent: pki.ticket.clone(),
        r_form: 0x80,
        key: SENDER,
    }
}

impl Envelope {
    /// It has a `generationLocation`.
    pub(crate) fn is_located(&mut self, place: (i32, i32)) {
        self.preamble = 0x10;
        self.fields = [location(place), vec![0x10, 0]].concat();
    }

    /// It has an `expiryTime`.
    pub(crate) fn expires(&mut self, at_us: u64) {
        self.preamble = 0x20;
        self.fields = at_us.to_be_bytes().to_vec();
    }

    /// The position vector of its packet has this time and place.
    pub(crate) fn is_said(&mut self, service: Service, at: Time64, place: (i32, i32)) {
        self.payload = plain(service, at, place)[4..].to_vec();
    }
}

pub(crate) fn circle(centre: (i32, i32), metres: u16) -> Vec<u8> {
    let [high, low] = metres.to_be_bytes();
    [vec![0x80], location(centre), vec![high, low]].concat()
}

pub(crate) struct Vectors {
    pub(crate) pki: Pki,
    pub(crate) all: Vec<Vector>,
}
