//! Certificates that are issued, and rasn's opinion of them and of messages.

use crossguard_codec::security::{
    Certificate, Place, Region, Ssp, SspRange, Subjects, Untrusted, issue, issue::IssueError,
    issue::Terms,
};
use rasn_its::ieee1609dot2 as dot2;

use super::pki::{
    NOW, PAYLOAD, Pki, RAM, after_ms, authority_terms, hear, issue_for, key, root_terms,
    ticket_terms,
};

#[test]
fn what_is_read_is_what_was_to_be_said() {
    let place = |latitude, longitude| Place {
        latitude,
        longitude,
    };
    let regions = [
        None,
        Some(Region::Circle {
            centre: place(-5, 1_800_000_000),
            radius: u16::MAX,
        }),
        Some(Region::Rectangles(vec![
            (place(900_000_000, -10), place(-900_000_000, 10)),
            (place(5, 5), place(4, 6)),
        ])),
    ];
    let ranges = [
        SspRange::All,
        SspRange::Opaque(vec![vec![1], vec![2, 3]]),
        SspRange::Bitmap {
            value: vec![1, 2],
            mask: vec![0xff, 3],
        },
    ];
    for (region, range) in regions.into_iter().zip(ranges) {
        let mut issue_permission = issue_for(&[], 2);
        issue_permission.chain_length_range = -1;
        issue_permission.subjects = Subjects::These(vec![(270_549_118, range)]);
        let mut all = issue_for(&[], 1);
        all.subjects = Subjects::All;
        let terms = Terms {
            region,
            issue_permissions: vec![issue_permission, all],
            ..root_terms()
        };
        let root = issue::root(&key(1), &terms).unwrap();
        let content = root.content();
        assert_eq!(content.name, terms.name);
        assert_eq!(content.validity, terms.validity);
        assert_eq!(content.region, terms.region);
        assert_eq!(content.permissions, terms.permissions);
        assert_eq!(content.issue_permissions, terms.issue_permissions);
        assert_eq!(content.key, key(1).public_key());
        assert_eq!(Certificate::decode(root.octets()), Ok(root.clone()));
        let theirs: dot2::Certificate = rasn::coer::decode(root.octets()).unwrap();
        assert_eq!(rasn::coer::encode(&theirs).unwrap(), root.octets());
    }
}

#[test]
fn permissions_are_said_in_all_forms() {
    let mut terms = ticket_terms();
    terms.permissions[0].ssp = Ssp::Default;
    terms.permissions[1].ssp = Ssp::Opaque(vec![0; 31]);
    let pki = Pki::new(1);
    let ticket = pki.ticket(10, &terms);
    assert_eq!(
        ticket.certificate().content().permissions,
        terms.permissions
    );
}

#[test]
fn what_nobody_would_take_is_not_issued() {
    let nothing = Terms {
        permissions: Vec::new(),
        ..ticket_terms()
    };
    let pki = Pki::new(1);
    let holder = key(10).public_key();
    let issued = |terms: &Terms| issue::ticket(&pki.authority, &pki.authority_key, holder, terms);
    assert!(matches!(issued(&nothing), Err(IssueError::Terms(_))));
    assert!(matches!(
        issued(&authority_terms()),
        Err(IssueError::Rejected(_))
    ));
    let by_another = issue::ticket(&pki.authority, &key(77), holder, &ticket_terms());
    assert!(matches!(by_another, Err(IssueError::Rejected(_))));
    let powerless = Terms {
        permissions: ticket_terms().permissions,
        issue_permissions: Vec::new(),
        ..root_terms()
    };
    assert!(matches!(
        issue::root(&key(1), &powerless),
        Err(IssueError::Untrusted(Untrusted::MayNotIssue(_)))
    ));
    let off_earth = Terms {
        region: Some(Region::Circle {
            centre: Place {
                latitude: 900_000_001,
                longitude: i32::MAX,
            },
            radius: 1,
        }),
        ..ticket_terms()
    };
    assert!(matches!(issued(&off_earth), Err(IssueError::Terms(_))));
}

#[test]
fn rasn_reads_the_messages_and_writes_the_same_octets() {
    let pki = Pki::new(1);
    let (mut sender, mut other) = (pki.station(10), pki.station(11));
    let mut said = Vec::new();
    other.seal(NOW, RAM, PAYLOAD).unwrap();
    let unknown = other.seal(after_ms(1), RAM, PAYLOAD).unwrap();
    said.push(sender.seal(NOW, RAM, PAYLOAD).unwrap());
    said.push(sender.seal(after_ms(1), RAM, PAYLOAD).unwrap());
    hear(&mut sender, after_ms(1), &unknown).unwrap_err();
    // With a request, and the whole certificate.
    said.push(sender.seal(after_ms(2), RAM, PAYLOAD).unwrap());
    said.push(sender.seal(after_ms(3), RAM, &[0x55; 1_000]).unwrap());
    let lengths: std::collections::BTreeSet<_> = said.iter().map(Vec::len).collect();
    assert_eq!(lengths.len(), 4, "each of another form");
    for octets in said {
        let theirs: dot2::Ieee1609Dot2Data = rasn::coer::decode(&octets).unwrap();
        assert_eq!(rasn::coer::encode(&theirs).unwrap(), octets);
    }
}
