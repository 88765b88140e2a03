//! Changing the pseudonym.

use crossguard_codec::security::{
    Duration, SignedMessage, SignerIdentifier, Station, Tolerances, Unsigned, issue::Terms,
};

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
