//! What strangers can make a station spend on their signatures.

use crossguard_codec::security::{Rejected, Station, Tolerances, Validity, issue::Terms};

use super::pki::{NOW, PAYLOAD, Pki, RAM, after_ms, hear, key, ticket_terms, validity};

/// A station whose ticket names the authority of `pki` and was signed by somebody else. Each number has another one.
fn forger(pki: &Pki, number: u32) -> Station {
    let Validity { start, duration } = ticket_terms().validity;
    let terms = Terms {
        validity: validity(start - number, duration),
        ..ticket_terms()
    };
    pki.forger(20, &terms, &pki.authority, &key(9))
}

#[test]
fn a_forged_certificate_is_verified_once() {
    let pki = Pki::new(1);
    let (mut forger, mut receiver) = (forger(&pki, 0), pki.station(11));
    for step in 0..50 {
        // A second apart, so that the certificate goes along.
        let now = after_ms(step * 1_000);
        let envelope = forger.seal(now, RAM, PAYLOAD).unwrap();
        let refused = hear(&mut receiver, now, &envelope).unwrap_err();
        let expected = if step == 0 {
            Rejected::CertificateSignature(forger.pseudonym())
        } else {
            Rejected::RefusedBefore
        };
        assert_eq!(refused, expected);
    }
    assert_eq!(receiver.verifier().signatures(), 1);
}

#[test]
fn a_forged_message_is_verified_once() {
    let pki = Pki::new(1);
    let (mut sender, mut receiver) = (pki.station(10), pki.station(11));
    let first = sender.seal(NOW, RAM, PAYLOAD).unwrap();
    hear(&mut receiver, NOW, &first).unwrap();
    let good = sender.seal(after_ms(1), RAM, PAYLOAD).unwrap();
    let mut forged = good.clone();
    forged[10] ^= 1;
    let before = receiver.verifier().signatures();
    for step in 1..50 {
        let refused = hear(&mut receiver, after_ms(step), &forged).unwrap_err();
        let is_first = step == 1;
        assert_eq!(refused == Rejected::Signature, is_first, "{refused}");
    }
    assert_eq!(receiver.verifier().signatures(), before + 1);
    // What was forged of a station stands in nobody's way.
    assert!(hear(&mut receiver, after_ms(50), &good).is_ok());
}

#[test]
fn strangers_take_a_limited_share_and_nothing_from_who_is_known() {
    let pki = Pki::new(1);
    let (mut sender, mut receiver) = (pki.station(10), pki.station(11));
    let first = sender.seal(NOW, RAM, PAYLOAD).unwrap();
    hear(&mut receiver, NOW, &first).unwrap();
    let limit = u64::from(Tolerances::default().new_per_s);
    let before = receiver.verifier().signatures();
    let (mut turned_away, mut known) = (0, 0);
    for number in 0..400 {
        let now = after_ms(u64::from(number) / 4 + 1);
        let envelope = forger(&pki, number).seal(now, RAM, PAYLOAD).unwrap();
        let refused = hear(&mut receiver, now, &envelope).unwrap_err();
        turned_away += u64::from(refused == Rejected::TooManyNew);
        if number % 4 == 0 {
            let envelope = sender.seal(now, RAM, PAYLOAD).unwrap();
            assert!(hear(&mut receiver, now, &envelope).is_ok());
            known += 1;
        }
    }
    let spent = receiver.verifier().signatures() - before - known;
    assert!(spent <= limit + limit / 10, "{spent} signatures");
    assert_eq!(spent + turned_away, 400);
    // A second later there is room for who is new.
    let now = after_ms(1_200);
    let envelope = pki.station(13).seal(now, RAM, PAYLOAD).unwrap();
    assert!(hear(&mut receiver, now, &envelope).unwrap().is_new);
}
