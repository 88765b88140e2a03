//! A small PKI, and stations of it, with keys that are the same in every run.

use crossguard_codec::security::{
    Certificate, Duration, IssuePermission, Issuer, Permission, PrivateKey, Rejected,
    SignedMessage, Ssp, SspRange, Station, Subjects, Ticket, Time64, Tolerances, TrustStore,
    Validity, Verified, issue, issue::Terms,
};

/// ITS-AIDs of RAM and RMCM, and one that no ticket here is for.
pub(crate) const RAM: u32 = 16_480;
pub(crate) const RMCM: u32 = 16_481;
pub(crate) const CAM: u32 = 36;

/// When the tests take place, in seconds since 2004, and in microseconds.
pub(crate) const NOW_S: u32 = 694_694_401;
pub(crate) const NOW: Time64 = Time64(NOW_S as u64 * 1_000_000);

pub(crate) const PAYLOAD: &[u8] = b"common header, extended header, BTP and message";

pub(crate) fn after_ms(milliseconds: u64) -> Time64 {
    Time64(NOW.0 + milliseconds * 1_000)
}

/// Another key for every number.
pub(crate) fn key(number: u8) -> PrivateKey {
    PrivateKey::of_octets(&[number; 32]).unwrap()
}

pub(crate) fn validity(start: u32, duration: Duration) -> Validity {
    Validity { start, duration }
}

pub(crate) fn issue_for(its_aids: &[u32], min_chain_length: i8) -> IssuePermission {
    let these = its_aids.iter().map(|its_aid| (*its_aid, SspRange::All));
    IssuePermission {
        subjects: Subjects::These(these.collect()),
        min_chain_length,
        chain_length_range: 0,
        for_applications: true,
    }
}

pub(crate) fn permission(its_aid: u32) -> Permission {
    Permission {
        its_aid,
        ssp: Ssp::Bitmap(vec![1, 0xc0]),
    }
}

pub(crate) fn root_terms() -> Terms {
    Terms {
        name: Some("root".to_owned()),
        issue_permissions: vec![issue_for(&[CAM, RAM, RMCM], 2)],
        ..Terms::of_ticket(validity(NOW_S - 3_600, Duration::years(10)), Vec::new())
    }
}

pub(crate) fn authority_terms() -> Terms {
    Terms {
        name: Some("authority".to_owned()),
        validity: validity(NOW_S - 3_600, Duration::years(3)),
        issue_permissions: vec![issue_for(&[CAM, RAM, RMCM], 1)],
        ..root_terms()
    }
}

pub(crate) fn ticket_terms() -> Terms {
    let permissions = vec![permission(RAM), permission(RMCM)];
    Terms::of_ticket(validity(NOW_S - 60, Duration::hours(168)), permissions)
}

/// A root and an authority.
pub(crate) struct Pki {
    pub(crate) root: Certificate,
    pub(crate) authority: Certificate,
    pub(crate) authority_key: PrivateKey,
}

impl Pki {
    /// That of this number; others have other keys.
    pub(crate) fn new(number: u8) -> Self {
        Self::with(number, &root_terms(), &authority_terms())
    }

    pub(crate) fn with(number: u8, root_terms: &Terms, authority_terms: &Terms) -> Self {
        let (root_key, authority_key) = (key(number), key(number + 1));
        let root = issue::root(&root_key, root_terms).unwrap();
        let holder = authority_key.public_key();
        let authority = issue::authority(&root, &root_key, holder, authority_terms).unwrap();
        Self {
            root,
            authority,
            authority_key,
        }
    }

    pub(crate) fn trust(&self) -> TrustStore {
        let mut trust = TrustStore::default();
        trust.add_root(self.root.clone()).unwrap();
        trust.add_authority(self.authority.clone()).unwrap();
        trust
    }

    pub(crate) fn ticket(&self, number: u8, terms: &Terms) -> Ticket {
        let key = key(number);
        let holder = key.public_key();
        let certificate =
            issue::ticket(&self.authority, &self.authority_key, holder, terms).unwrap();
        Ticket::new(certificate, key).unwrap()
    }

    /// A station with one pseudonym on these terms.
    pub(crate) fn station_with(&self, number: u8, terms: &Terms, now: Time64) -> Station {
        let tickets = vec![self.ticket(number, terms)];
        Station::new(self.trust(), tickets, Tolerances::default(), now).unwrap()
    }

    /// A station whose ticket names this issuer, and is signed with this key, whether that is the issuer's or not.
    pub(crate) fn forger(
        &self,
        number: u8,
        terms: &Terms,
        issuer: &Certificate,
        signing: &PrivateKey,
    ) -> Station {
        let (key, issuer_id) = (key(number), Issuer::Certificate(issuer.id()));
        let holder = key.public_key();
        let forged = issue::certificate(issuer_id, issuer.octets(), signing, holder, terms);
        let tickets = vec![Ticket::new(forged.unwrap(), key).unwrap()];
        Station::new(self.trust(), tickets, Tolerances::default(), NOW).unwrap()
    }

    /// A station with one ordinary pseudonym.
    pub(crate) fn station(&self, number: u8) -> Station {
        self.station_with(number, &ticket_terms(), NOW)
    }
}

/// Hears an envelope.
pub(crate) fn hear(
    station: &mut Station,
    now: Time64,
    envelope: &[u8],
) -> Result<Verified, Rejected> {
    let message = SignedMessage::decode(envelope)?;
    station.verify(now, None, &message)
}
