//! Changing the pseudonym.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crossguard_codec::security::{
    Duration, KeyFailure, PublicKey, Signature, SignedMessage, SignerIdentifier, SigningKey,
    Station, Ticket, Tolerances, Unsigned, issue::Terms,
};
use p256::ecdsa::signature::hazmat::PrehashSigner as _;

use super::forge;
use super::pki::{NOW, NOW_S, PAYLOAD, Pki, RAM, after_ms, hear, ticket_terms, validity};

#[test]
fn messages_go_on_under_the_next_pseudonym_with_its_certificate() {
    let pki = Pki::new(1);
    let tickets = (10..13).map(|n| pki.ticket(n, &ticket_terms())).collect();
    let mut sender = Station::new(pki.trust(), tickets, Tolerances::default(), NOW).unwrap();
    let mut receiver = pki.station(20);
    let mut pseudonyms = Vec::new();
    for round in 0..4 {
        let now = after_ms(round * 10);
        let envelope = sender.seal(now, RAM, PAYLOAD).unwrap();
        let message = SignedMessage::decode(&envelope).unwrap();
        assert!(matches!(message.signer, SignerIdentifier::Certificate(_)) || round == 0);
        let verified = hear(&mut receiver, now, &envelope).unwrap();
        assert_eq!(verified.signer, sender.pseudonym());
        pseudonyms.push(verified.signer);
        sender.change_pseudonym(now, now).unwrap();
    }
    assert_eq!(
        pseudonyms[3], pseudonyms[0],
        "after all comes the first again"
    );
    pseudonyms.pop();
    pseudonyms.sort_unstable();
    pseudonyms.dedup();
    assert_eq!(pseudonyms.len(), 3);
}

#[test]
fn a_pseudonym_that_is_over_is_passed_over() {
    let pki = Pki::new(1);
    let terms = |start, hours| Terms {
        validity: validity(start, Duration::hours(hours)),
        ..ticket_terms()
    };
    let tickets = vec![
        pki.ticket(10, &terms(NOW_S - 60, 1)),
        pki.ticket(11, &terms(NOW_S - 60, 168)),
        pki.ticket(12, &terms(NOW_S + 60, 1)),
    ];
    let later = after_ms(2 * 3_600_000);
    let second = tickets[1].certificate().id();
    let mut station =
        Station::new(pki.trust(), tickets.clone(), Tolerances::default(), NOW).unwrap();
    assert!(!station.should_change(NOW, NOW));
    assert!(
        station.should_change(NOW, later),
        "it would be over by then"
    );
    assert_eq!(station.change_pseudonym(NOW, later), Ok(second));
    assert!(!station.should_change(NOW, later));
    let none = station.change_pseudonym(later, later);
    assert_eq!(none, Err(Unsigned::NoValidTicket));
    assert_eq!(station.pseudonym(), second);
    let only_later = vec![tickets[2].clone()];
    let none = Station::new(pki.trust(), only_later, Tolerances::default(), NOW);
    assert_eq!(none.unwrap_err(), Unsigned::NoValidTicket);
}

/// A key in a token that can be removed. The token tells points and signatures as octets.
#[derive(Debug)]
struct Removable(p256::ecdsa::SigningKey, Arc<AtomicBool>);

const REMOVED: KeyFailure = KeyFailure("the token was removed");

impl SigningKey for Removable {
    fn public_key(&self) -> PublicKey {
        let point = self.0.verifying_key().to_sec1_point(false);
        PublicKey::of_sec1(point.as_bytes()).unwrap()
    }

    fn sign(&self, digest: &[u8; 32]) -> Result<Signature, KeyFailure> {
        if !self.1.load(Ordering::Relaxed) {
            return Err(REMOVED);
        }
        let signature: p256::ecdsa::Signature = self.0.sign_prehash(digest).unwrap();
        Ok(Signature::of_octets(&signature.to_bytes().into()).unwrap())
    }
}

#[test]
fn a_key_that_lies_elsewhere_signs_while_it_is_there() {
    let (pki, is_there) = (Pki::new(1), Arc::new(AtomicBool::new(true)));
    let certificate = pki.ticket(10, &ticket_terms()).certificate().clone();
    let ticket = Ticket::new(
        certificate,
        Removable(forge::key(10), Arc::clone(&is_there)),
    );
    let tickets = vec![ticket.unwrap()];
    let mut sender = Station::new(pki.trust(), tickets, Tolerances::default(), NOW).unwrap();
    let envelope = sender.seal(NOW, RAM, PAYLOAD).unwrap();
    assert!(hear(&mut pki.station(20), NOW, &envelope).is_ok());
    is_there.store(false, Ordering::Relaxed);
    let sealed = sender.seal(after_ms(100), RAM, PAYLOAD);
    assert_eq!(sealed, Err(Unsigned::Key(REMOVED)));
}
