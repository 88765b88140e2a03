//! Certificates that are revoked, and authorities that are over.

use std::collections::BTreeSet;

use crossguard_codec::security::{
    AUTHORITIES_MAX, Certificate, Duration, HashedId8, Rejected, Station, Ticket, Time64,
    Tolerances, TrustStore, issue::Terms,
};

use super::forge::mirrored;
use super::pki::{
    NOW, NOW_S, PAYLOAD, Pki, RAM, after_ms, authority_terms, hear, key, root_terms, ticket_terms,
    validity,
};

fn revoked(ids: &[HashedId8]) -> BTreeSet<HashedId8> {
    ids.iter().copied().collect()
}

#[test]
fn what_is_revoked_is_rejected_from_then_on_and_all_that_is_below_it() {
    let pki = Pki::new(1);
    let (mut sender, mut other) = (pki.station(10), pki.station(12));
    let mut receiver = pki.station(11);
    let said = |station: &mut Station, ms| station.seal(after_ms(ms), RAM, PAYLOAD).unwrap();
    let (first, second) = (said(&mut sender, 0), said(&mut sender, 100));
    hear(&mut receiver, NOW, &first).unwrap();
    let stolen = sender.pseudonym();
    receiver.set_revoked(revoked(&[stolen]));
    // Known before, and on the way when the list came.
    let now = after_ms(110);
    assert_eq!(
        hear(&mut receiver, now, &second),
        Err(Rejected::Revoked(stolen))
    );
    let fine = said(&mut other, 100);
    assert!(hear(&mut receiver, now, &fine).is_ok(), "others go on");
    for above in [pki.authority.id(), pki.root.id()] {
        receiver.set_revoked(revoked(&[above]));
        let message = said(&mut other, 200);
        let rejected = hear(&mut receiver, after_ms(210), &message);
        assert_eq!(rejected, Err(Rejected::Revoked(above)));
        assert_eq!(rejected.unwrap_err().cause(), "revoked");
    }
    // A list without it is another list.
    receiver.set_revoked(BTreeSet::new());
    let message = said(&mut sender, 300);
    assert!(hear(&mut receiver, after_ms(310), &message).is_ok());
}

/// Hazard: who holds a revoked ticket gives it another digest, by the other signature that is right as well.
#[test]
fn a_revoked_ticket_stays_revoked_under_its_other_digest() {
    let pki = Pki::new(1);
    let certificate = pki.ticket(10, &ticket_terms()).certificate().clone();
    let mirror = Certificate::decode(&mirrored(certificate.octets().to_vec())).unwrap();
    assert_ne!(certificate.id(), mirror.id());
    // The lower s says under what both go: the last number in a certificate.
    let s_of = |it: &Certificate| it.octets()[it.octets().len() - 32..].to_vec();
    let lower = [&certificate, &mirror]
        .into_iter()
        .min_by_key(|it| s_of(it));
    let holder = lower.unwrap().id();
    assert_eq!(certificate.holder(), holder);
    assert_eq!(mirror.holder(), holder);
    let tickets = vec![Ticket::new(mirror.clone(), key(10)).unwrap()];
    let mut thief = Station::new(pki.trust(), tickets, Tolerances::default(), NOW).unwrap();
    let mut receiver = pki.station(11);
    let message = thief.seal(NOW, RAM, PAYLOAD).unwrap();
    let heard = hear(&mut receiver, NOW, &message).expect("it is as good as the other");
    assert_eq!(heard.signer, mirror.id());
    assert_eq!(heard.holder, holder);
    for listed in [certificate.id(), mirror.id()] {
        receiver.set_revoked(revoked(&[listed]));
        let message = thief.seal(after_ms(100), RAM, PAYLOAD).unwrap();
        let rejected = hear(&mut receiver, after_ms(100), &message);
        assert_eq!(rejected, Err(Rejected::Revoked(mirror.id())));
    }
    // Also with a receiver that hears of it for the first time.
    let mut newcomer = pki.station(12);
    newcomer.set_revoked(revoked(&[certificate.id()]));
    let message = thief.seal(after_ms(1_100), RAM, PAYLOAD).unwrap();
    let rejected = hear(&mut newcomer, after_ms(1_100), &message);
    assert_eq!(rejected, Err(Rejected::Revoked(mirror.id())));
}

/// A receiver that knows only the root, and learns authorities from messages.
fn learner(pki: &Pki) -> Station {
    let mut only_root = TrustStore::default();
    only_root.add_root(pki.root.clone()).unwrap();
    let tickets = vec![pki.ticket(99, &ticket_terms())];
    Station::new(only_root, tickets, Tolerances::default(), NOW).unwrap()
}

/// A station of this PKI that knows the authority of the learner as well, and so hears what it asks for.
fn teacher(pki: &Pki, number: u8, hours: u16, now: Time64) -> Station {
    let mut trust = pki.trust();
    trust.add_authority(Pki::new(1).authority).unwrap();
    let tickets = vec![pki.ticket(number, &ticket_for(hours))];
    Station::new(trust, tickets, Tolerances::default(), now).unwrap()
}

/// Has the receiver ask for the authority of the sender, and get it, at a time.
fn teach(receiver: &mut Station, sender: &mut Station, from: Time64) {
    let at = |ms: u64| Time64(from.0 + ms * 1_000);
    let message = sender.seal(at(0), RAM, PAYLOAD).unwrap();
    assert!(hear(receiver, at(0), &message).is_err());
    let asking = receiver.seal(at(10), RAM, PAYLOAD).unwrap();
    let _ = hear(sender, at(10), &asking);
    for ms in [100, 200] {
        let message = sender.seal(at(ms), RAM, PAYLOAD).unwrap();
        let _ = hear(receiver, at(ms), &message);
    }
}

/// A PKI whose root is that of `Pki::new(1)`, and whose authority is valid for this many hours.
fn short(number: u8, hours: u16) -> Pki {
    let terms = Terms {
        validity: validity(NOW_S - 60, Duration::hours(hours)),
        name: Some(format!("authority {number}")),
        ..authority_terms()
    };
    Pki::with(1, &root_terms(), &terms)
}

fn ticket_for(hours: u16) -> Terms {
    Terms {
        validity: validity(NOW_S - 60, Duration::hours(hours)),
        ..ticket_terms()
    }
}

#[test]
fn a_learned_authority_goes_when_it_is_over_and_when_it_is_revoked() {
    let (one, other) = (short(1, 2), short(2, 4));
    let mut receiver = learner(&Pki::new(1));
    let mut first = teacher(&one, 10, 2, NOW);
    teach(&mut receiver, &mut first, NOW);
    let known = |station: &Station| {
        let authorities = station.verifier().trust().authorities();
        authorities
            .map(crossguard_codec::security::Certificate::id)
            .collect::<Vec<_>>()
    };
    assert_eq!(known(&receiver), [one.authority.id()]);
    let later = Time64(NOW.0 + 3 * 3_600_000_000);
    let mut receiver_later = receiver.clone();
    let mut second = teacher(&other, 11, 4, later);
    teach(&mut receiver_later, &mut second, later);
    assert_eq!(
        known(&receiver_later),
        [other.authority.id()],
        "the first one is over"
    );
    receiver.set_revoked(revoked(&[one.authority.id()]));
    assert_eq!(known(&receiver), []);
    teach(&mut receiver, &mut first, after_ms(2_000));
    assert_eq!(known(&receiver), [], "what is revoked is not learned again");
}

#[test]
fn authorities_that_are_over_make_room_for_others() {
    let mut receiver = learner(&Pki::new(1));
    let many = u8::try_from(AUTHORITIES_MAX).unwrap();
    for number in 0..many {
        let pki = short(number, 2);
        let mut sender = teacher(&pki, 10, 2, NOW);
        teach(
            &mut receiver,
            &mut sender,
            after_ms(u64::from(number) * 1_000),
        );
    }
    let count = |station: &Station| station.verifier().trust().authorities().count();
    assert_eq!(count(&receiver), AUTHORITIES_MAX);
    let one_more = short(many, 4);
    let mut sender = teacher(&one_more, 11, 4, NOW);
    teach(&mut receiver, &mut sender, after_ms(100_000));
    assert_eq!(
        count(&receiver),
        AUTHORITIES_MAX,
        "no room while they are valid"
    );
    let later = Time64(NOW.0 + 3 * 3_600_000_000);
    teach(&mut receiver, &mut sender, later);
    assert_eq!(count(&receiver), 1);
}
