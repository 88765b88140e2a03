//! What is believed, and what is rejected under which cause.

use crossguard_codec::security::{
    Doubt, Duration, Issuer, Place, Region, Rejected, SignedMessage, SignerIdentifier, Station,
    TICKETS_MAX, Ticket, Tolerances, TrustStore, Unsigned, Untrusted, issue, issue::Terms,
};

use super::pki::{
    NOW, NOW_S, PAYLOAD, Pki, RAM, after_ms, authority_terms, hear, issue_for, key, permission,
    root_terms, ticket_terms, validity,
};

fn is_in_full(envelope: &[u8]) -> bool {
    let message = SignedMessage::decode(envelope).unwrap();
    matches!(message.signer, SignerIdentifier::Certificate(_))
}

#[test]
fn the_certificate_comes_once_per_second_and_digests_in_between() {
    let pki = Pki::new(1);
    let (mut sender, mut receiver) = (pki.station(10), pki.station(11));
    for step in 0..25 {
        let now = after_ms(step * 100);
        let envelope = sender.seal(now, RAM, PAYLOAD).unwrap();
        assert_eq!(is_in_full(&envelope), step % 10 == 0, "at {step}");
        let verified = hear(&mut receiver, now, &envelope).unwrap();
        assert_eq!(verified.signer, sender.pseudonym());
        assert_eq!(verified.is_new, step == 0);
    }
}

#[test]
fn an_unknown_certificate_is_asked_for_and_sent() {
    let pki = Pki::new(1);
    let (mut sender, mut receiver) = (pki.station(10), pki.station(11));
    sender.seal(NOW, RAM, PAYLOAD).unwrap();
    receiver.seal(NOW, RAM, PAYLOAD).unwrap();
    let envelope = sender.seal(after_ms(100), RAM, PAYLOAD).unwrap();
    let unknown = Err(Rejected::UnknownSigner(sender.pseudonym()));
    assert_eq!(hear(&mut receiver, after_ms(100), &envelope), unknown);

    let asking = receiver.seal(after_ms(110), RAM, PAYLOAD).unwrap();
    let requests: Vec<_> = SignedMessage::decode(&asking)
        .unwrap()
        .header
        .requests()
        .collect();
    assert_eq!(requests, [sender.pseudonym().short()]);
    assert!(is_in_full(&asking), "neither is the receiver known");
    hear(&mut sender, after_ms(110), &asking).unwrap();
    let envelope = sender.seal(after_ms(200), RAM, PAYLOAD).unwrap();
    assert!(is_in_full(&envelope), "it was asked for");
    hear(&mut receiver, after_ms(200), &envelope).unwrap();
    let envelope = receiver.seal(after_ms(300), RAM, PAYLOAD).unwrap();
    let message = SignedMessage::decode(&envelope).unwrap();
    assert_eq!(message.header.requests().count(), 0, "asked once");
}

#[test]
fn an_unknown_authority_is_asked_for_and_sent() {
    let pki = Pki::new(1);
    let mut sender = pki.station(10);
    let mut only_root = TrustStore::default();
    only_root.add_root(pki.root.clone()).unwrap();
    let ticket = pki.ticket(11, &ticket_terms());
    let mut receiver = Station::new(only_root, vec![ticket], Tolerances::default(), NOW).unwrap();

    let envelope = sender.seal(NOW, RAM, PAYLOAD).unwrap();
    let foreign = Err(Rejected::ForeignIssuer(pki.authority.id()));
    assert_eq!(hear(&mut receiver, NOW, &envelope), foreign);
    let asking = receiver.seal(after_ms(10), RAM, PAYLOAD).unwrap();
    hear(&mut sender, after_ms(10), &asking).unwrap();
    // The own certificate is due at once as well, and the authority's follows it.
    let first = sender.seal(after_ms(100), RAM, PAYLOAD).unwrap();
    assert!(is_in_full(&first));
    let second = sender.seal(after_ms(200), RAM, PAYLOAD).unwrap();
    assert!(second.len() > first.len());
    let unknown = Err(Rejected::UnknownSigner(sender.pseudonym()));
    assert_eq!(hear(&mut receiver, after_ms(200), &second), unknown);
    assert_eq!(receiver.verifier().trust().authorities().count(), 1);
    assert_eq!(
        hear(&mut receiver, after_ms(201), &first).unwrap().signer,
        sender.pseudonym()
    );
}

#[test]
fn the_same_message_is_believed_once() {
    let pki = Pki::new(1);
    let (mut sender, mut receiver) = (pki.station(10), pki.station(11));
    // Also when all of them are generated in the same millisecond.
    let envelopes: Vec<_> = (0..4)
        .map(|_| sender.seal(NOW, RAM, PAYLOAD).unwrap())
        .collect();
    for envelope in &envelopes {
        assert!(hear(&mut receiver, NOW, envelope).is_ok());
    }
    for envelope in &envelopes {
        assert_eq!(hear(&mut receiver, NOW, envelope), Err(Rejected::Replayed));
    }
}

/// A station with another certificate for each number.
fn other(pki: &Pki, number: usize) -> Station {
    let earlier = u32::try_from(number).unwrap();
    let terms = Terms {
        validity: validity(NOW_S - 60 - earlier, Duration::hours(100)),
        ..ticket_terms()
    };
    pki.station_with(12, &terms, NOW)
}

#[test]
fn nobody_who_is_heard_is_forgotten_for_somebody_new() {
    let pki = Pki::new(1);
    let (mut receiver, mut sender) = (pki.station(11), pki.station(10));
    let envelope = sender.seal(NOW, RAM, PAYLOAD).unwrap();
    hear(&mut receiver, NOW, &envelope).unwrap();
    let say = |receiver: &mut Station, number: usize, ms: u64| {
        let envelope = other(&pki, number)
            .seal(after_ms(ms), RAM, PAYLOAD)
            .unwrap();
        hear(receiver, after_ms(ms), &envelope).map(|_| ())
    };
    // Not more of them in a second than are listened to.
    let at_ms = |number: usize| u64::try_from(number).unwrap() * 7;
    for number in 1..TICKETS_MAX {
        assert_eq!(say(&mut receiver, number, at_ms(number)), Ok(()));
    }
    for number in TICKETS_MAX..TICKETS_MAX + 10 {
        let one_more = say(&mut receiver, number, at_ms(number));
        assert_eq!(one_more, Err(Rejected::TooManyStations));
    }
    // The first one is known by its digest still, and so is what it said.
    for ms in [8_000, 9_500] {
        sender.seal(after_ms(ms - 100), RAM, PAYLOAD).unwrap();
        let newer = sender.seal(after_ms(ms), RAM, PAYLOAD).unwrap();
        assert!(hear(&mut receiver, after_ms(ms), &newer).is_ok());
        let again = hear(&mut receiver, after_ms(ms), &newer);
        assert_eq!(again, Err(Rejected::Replayed));
    }
    // The others have been silent for so long that there is a place.
    assert_eq!(say(&mut receiver, TICKETS_MAX, 10_008), Ok(()));
    let newer = sender.seal(after_ms(10_009), RAM, PAYLOAD).unwrap();
    assert!(hear(&mut receiver, after_ms(10_009), &newer).is_ok());
}

/// Hazard: the receiver's clock is put back, and a command from before is carried out again.
#[test]
fn a_clock_that_is_put_back_makes_nothing_fresh_again() {
    let pki = Pki::new(1);
    let (mut receiver, mut sender) = (pki.station(11), pki.station(10));
    let old = sender.seal(after_ms(1_000), RAM, PAYLOAD).unwrap();
    hear(&mut receiver, after_ms(1_000), &old).unwrap();
    let newer = sender.seal(after_ms(5_000), RAM, PAYLOAD).unwrap();
    hear(&mut receiver, after_ms(5_000), &newer).unwrap();
    let doubt = Doubt::Behind(4_000_000);
    let put_back = hear(&mut receiver, after_ms(1_000), &old);
    assert_eq!(put_back, Err(Rejected::TimeNotTrusted(doubt)));
    // Nor is a message believed that was never heard, until it is later than ever before.
    let unheard = sender.seal(after_ms(4_000), RAM, PAYLOAD).unwrap();
    let doubt = Doubt::Behind(1_000_000);
    let heard = hear(&mut receiver, after_ms(4_000), &unheard);
    assert_eq!(heard, Err(Rejected::TimeNotTrusted(doubt)));
    let newest = sender.seal(after_ms(5_100), RAM, PAYLOAD).unwrap();
    assert!(hear(&mut receiver, after_ms(5_100), &newest).is_ok());
}

/// Hazard: what was said just before a power failure is carried out again after it.
#[test]
fn what_was_heard_before_a_restart_is_not_heard_again() {
    let pki = Pki::new(1);
    let mut sender = pki.station(10);
    let ahead = sender.seal(after_ms(1_200), RAM, PAYLOAD).unwrap();
    hear(&mut pki.station(11), after_ms(1_000), &ahead).unwrap();
    // The robot stops at 1,000 ms, and is there again 100 ms later.
    let restarted = |now, known| {
        let tickets = vec![pki.ticket(11, &ticket_terms())];
        let mut station = Station::new(pki.trust(), tickets, Tolerances::default(), now).unwrap();
        station.remember_time(known);
        station
    };
    let mut receiver = restarted(after_ms(1_100), after_ms(1_000));
    let again = hear(&mut receiver, after_ms(1_100), &ahead);
    assert_eq!(again, Err(Rejected::BeforeStart));
    // A second later, the certificate comes along again.
    let newer = sender.seal(after_ms(2_300), RAM, PAYLOAD).unwrap();
    assert!(hear(&mut receiver, after_ms(2_300), &newer).is_ok());
    // With a clock that was put back meanwhile, it believes nobody.
    let mut receiver = restarted(NOW, after_ms(5_000));
    let heard = hear(&mut receiver, after_ms(1_000), &ahead);
    assert!(
        matches!(heard, Err(Rejected::TimeNotTrusted(_))),
        "{heard:?}"
    );
}

#[test]
fn tickets_expire() {
    let pki = Pki::new(1);
    let terms = Terms {
        validity: validity(NOW_S, Duration::hours(1)),
        ..ticket_terms()
    };
    let hour_ms = 3_600_000;
    let mut sender = pki.station_with(10, &terms, NOW);
    let envelope = sender.seal(after_ms(hour_ms - 1), RAM, PAYLOAD).unwrap();
    let mut receiver = pki.station(11);
    hear(&mut receiver, after_ms(hour_ms - 1), &envelope).unwrap();
    // A message from before that is heard after it; one after it cannot be signed.
    let late = hear(&mut pki.station(12), after_ms(hour_ms), &envelope);
    assert_eq!(late, Err(Rejected::CertificateExpired));
    let sealed = sender.seal(after_ms(hour_ms), RAM, PAYLOAD);
    assert_eq!(sealed, Err(Unsigned::NoValidTicket));
}

#[test]
fn a_root_issues_no_tickets() {
    let pki = Pki::new(1);
    let mut sender = pki.forger(10, &ticket_terms(), &pki.root, &pki.authority_key);
    let envelope = sender.seal(NOW, RAM, PAYLOAD).unwrap();
    let rejected = Err(Rejected::ForeignIssuer(pki.root.id()));
    assert_eq!(hear(&mut pki.station(11), NOW, &envelope), rejected);
}

#[test]
fn an_authority_gets_only_what_its_root_has() {
    let root_key = key(1);
    let root = issue::root(&root_key, &root_terms()).unwrap();
    let mut trust = TrustStore::default();
    trust.add_root(root.clone()).unwrap();
    let mut add = |terms: &Terms, signing| {
        let issuer = Issuer::Certificate(root.id());
        let holder = key(2).public_key();
        let authority = issue::certificate(issuer, root.octets(), signing, holder, terms);
        trust.add_authority(authority.unwrap()).unwrap_err()
    };
    let beyond = Terms {
        issue_permissions: vec![issue_for(&[637], 1)],
        ..authority_terms()
    };
    let longer = Terms {
        validity: validity(NOW_S, Duration::years(20)),
        ..authority_terms()
    };
    let none = Terms {
        permissions: vec![permission(RAM)],
        issue_permissions: Vec::new(),
        ..authority_terms()
    };
    assert_eq!(
        add(&beyond, &root_key),
        Rejected::IssuerNotPermitted(637).into()
    );
    assert_eq!(add(&longer, &root_key), Rejected::BeyondIssuer.into());
    assert!(matches!(add(&none, &root_key), Untrusted::MayNotIssue(_)));
    assert!(matches!(
        add(&authority_terms(), &key(9)),
        Untrusted::Rejected(Rejected::CertificateSignature(_))
    ));
}

#[test]
fn a_certificate_is_valid_in_its_region_and_that_of_its_issuers() {
    let here = Place {
        latitude: 487_654_321,
        longitude: 91_234_567,
    };
    let elsewhere = Place {
        latitude: 497_654_321,
        ..here
    };
    let around = Region::Circle {
        centre: here,
        radius: 1_000,
    };
    let regional = |on_ticket: bool| {
        let region = Some(around.clone());
        let (authority, ticket) = if on_ticket {
            (None, region)
        } else {
            (region, None)
        };
        let authority_terms = Terms {
            region: authority,
            ..authority_terms()
        };
        let pki = Pki::with(1, &root_terms(), &authority_terms);
        let terms = Terms {
            region: ticket,
            ..ticket_terms()
        };
        let mut sender = pki.station_with(10, &terms, NOW);
        (pki.station(11), sender.seal(NOW, RAM, PAYLOAD).unwrap())
    };
    for on_ticket in [true, false] {
        let (mut receiver, envelope) = regional(on_ticket);
        let message = SignedMessage::decode(&envelope).unwrap();
        for place in [Some(elsewhere), None] {
            let heard = receiver.verify(NOW, place, &message);
            assert_eq!(heard, Err(Rejected::OutsideRegion));
        }
        assert!(receiver.verify(NOW, Some(here), &message).is_ok());
    }
}

#[test]
fn authorities_sign_no_messages_and_nobody_poses_as_the_receiver() {
    let pki = Pki::new(1);
    let authority = Ticket::new(pki.authority.clone(), pki.authority_key.clone());
    assert_eq!(
        authority.unwrap_err(),
        Unsigned::NotATicket(pki.authority.id())
    );
    let other_key = Ticket::new(
        pki.ticket(10, &ticket_terms()).certificate().clone(),
        key(9),
    );
    assert!(matches!(other_key.unwrap_err(), Unsigned::OtherKey(_)));

    let mut receiver = pki.station(10);
    let envelope = pki.station(10).seal(NOW, RAM, PAYLOAD).unwrap();
    assert_eq!(
        hear(&mut receiver, NOW, &envelope),
        Err(Rejected::OwnTicket)
    );
}
