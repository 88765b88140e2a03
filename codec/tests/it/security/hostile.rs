//! Octets of strangers: changed, cut short, random.

use crossguard_codec::security::{Certificate, Rejected, SignedMessage};
use proptest::prelude::*;

use super::pki::{NOW, PAYLOAD, Pki, RAM, after_ms, hear};
use crate::support::flips;

/// A message with a certificate, one with a digest, and a receiver that knows the sender.
fn said() -> (Pki, [Vec<u8>; 2]) {
    let pki = Pki::new(1);
    let mut sender = pki.station(10);
    let said = [0, 1].map(|at| sender.seal(after_ms(at), RAM, PAYLOAD).unwrap());
    (pki, said)
}

#[test]
fn every_flipped_bit_is_noticed() {
    let (pki, said) = said();
    let mut knowing = pki.station(11);
    let before = pki.station(10).seal(NOW, RAM, b"before").unwrap();
    hear(&mut knowing, NOW, &before).unwrap();
    let mut causes = std::collections::BTreeMap::<_, u32>::new();
    let mut forms = 0;
    for envelope in &said {
        let message = format!("{:?}", SignedMessage::decode(envelope).unwrap());
        for changed in flips(envelope) {
            // `rSig` as a point in place of x alone.
            if SignedMessage::decode(&changed).is_ok_and(|it| format!("{it:?}") == message) {
                forms += 1;
                continue;
            }
            let rejected = hear(&mut knowing, after_ms(1), &changed);
            let rejected = rejected.expect_err("a flipped bit");
            *causes.entry(rejected.cause()).or_default() += 1;
        }
    }
    assert_eq!(forms, 3, "of two messages and a certificate");
    // A changed payload breaks the signature, and nothing else.
    assert!(causes["wrong signature"] > 700, "{causes:?}");
    assert!(causes.len() > 5, "{causes:?}");
    for envelope in &said {
        assert!(hear(&mut knowing, after_ms(1), envelope).is_ok());
    }
}

#[test]
fn every_truncation_and_every_trailing_octet_is_noticed() {
    let (_, said) = said();
    for envelope in &said {
        for length in 0..envelope.len() {
            let cut = SignedMessage::decode(&envelope[..length]).unwrap_err();
            assert!(matches!(cut, Rejected::Malformed(_)), "{length}: {cut}");
        }
        let longer = [envelope.as_slice(), &[0]].concat();
        assert!(matches!(
            SignedMessage::decode(&longer),
            Err(Rejected::Malformed(_))
        ));
    }
}

#[test]
fn a_message_in_a_message_in_a_message_does_not_recurse() {
    // Each level announces signed data in signed data.
    let nested: Vec<u8> = [3, 0x81, 0, 0x40].into_iter().cycle().take(1_400).collect();
    assert!(matches!(
        SignedMessage::decode(&nested),
        Err(Rejected::Unsupported(_))
    ));
}

#[test]
fn what_is_announced_is_not_believed() {
    // A SEQUENCE OF with 2^63 - 1 certificates, in nine octets. rasn 0.30 panics on this message: it
    // reserves the memory before it looks for the first one.
    let quantity = [8, 0x7f, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff];
    let (_, [in_full, _]) = said();
    let at = in_full.windows(3).position(|w| w == [0x81, 1, 1]).unwrap();
    let hostile = [&in_full[..=at], &quantity, &in_full[at + 3..]].concat();
    assert!(matches!(
        SignedMessage::decode(&hostile),
        Err(Rejected::Malformed(_))
    ));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2_000))]

    #[test]
    fn random_octets_are_nothing(octets in prop::collection::vec(any::<u8>(), 0..400)) {
        prop_assert!(SignedMessage::decode(&octets).is_err());
        prop_assert!(Certificate::decode(&octets).is_err());
    }

    /// What is changed in several places, shortened or lengthened is rejected, or unchanged.
    #[test]
    fn mutated_messages_are_nothing(
        which in 0..2_usize,
        edits in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
        insert in prop::option::of((any::<prop::sample::Index>(), any::<u8>())),
    ) {
        let (_, said) = said_once();
        let mut octets = said[which].clone();
        for (at, value) in edits {
            let at = at.index(octets.len());
            octets[at] = value;
        }
        if let Some((at, value)) = insert {
            octets.insert(at.index(octets.len()), value);
        }
        let changed = octets != said[which];
        let (pki, _) = said_once();
        let heard = hear(&mut pki.station(11), after_ms(1), &octets);
        prop_assert!(heard.is_err() || !changed);
    }
}

fn said_once() -> &'static (Pki, [Vec<u8>; 2]) {
    static SAID: std::sync::OnceLock<(Pki, [Vec<u8>; 2])> = std::sync::OnceLock::new();
    SAID.get_or_init(said)
}
