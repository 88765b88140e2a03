//! Judgement of time by `validate`: lateness is counted, I10 is judged among robots that share a clock.

use std::io::Cursor;

use crossguard_judge::sim::{Deed, Happening, Swarm, run_recorded};
use crossguard_judge::validate::{Log, Validated, all};
use crossguard_robot::trace::{Entry, Record, write};
use crossguard_robot::transport::Outage;

const SECOND_US: u64 = 1_000_000;

/// A quiet pair; from the third second on they do not hear each other.
fn parted_pair() -> Swarm {
    let mut swarm = Swarm::quiet(2);
    for way in &mut swarm.ways {
        way.outages.push(Outage {
            from_ms: 3_000,
            until_ms: 15_000,
        });
    }
    swarm
}

fn records(swarm: &Swarm) -> Vec<Record> {
    run_recorded(swarm).1
}

fn validated(logs: &[&[Record]]) -> Result<Validated, String> {
    let log = |(i, records): (usize, &&[Record])| {
        let mut text = Vec::new();
        for record in *records {
            write(&mut text, record).unwrap();
        }
        Log::new(format!("log {i}"), Cursor::new(text))
    };
    all(logs.iter().enumerate().map(log).collect()).map_err(|invalid| invalid.to_string())
}

fn of(records: &[Record], name: &str) -> Vec<Record> {
    let own = records.iter().filter(|record| record.robot == name);
    own.cloned().collect()
}

fn has_i10(validated: &Validated) -> bool {
    validated.properties.iter().any(|id| id == "I10")
}

#[test]
fn a_timer_that_is_told_late_is_counted_with_the_longest_and_not_refused() {
    let on_time = validated(&[&records(&Swarm::quiet(2))]).unwrap();
    assert_eq!((on_time.late.steps, on_time.late.longest_ms), (0, 0));
    let mut swarm = Swarm::quiet(2);
    swarm.script.push(Happening {
        at_us: 3 * SECOND_US,
        place: 1,
        deed: Deed::Hang(700),
    });
    let late = validated(&[&records(&swarm)]).unwrap();
    assert!(late.late.steps > 0);
    assert!(
        (500..=750).contains(&late.late.longest_ms),
        "{}",
        late.late.longest_ms
    );
}

#[test]
fn a_log_that_does_not_say_when_messages_arrived_says_of_how_many() {
    let mut records = records(&Swarm::quiet(2));
    let mut receptions = 0;
    for record in &mut records {
        if let Entry::Heard { reception, .. } = &mut record.entry {
            *reception = None;
            receptions += 1;
        }
    }
    let validated = validated(&[&records]).unwrap();
    assert!(receptions > 0);
    assert_eq!(validated.of_unknown_age, receptions);
}

#[test]
fn i10_is_judged_among_robots_that_share_a_log_and_not_among_logs() {
    let records = records(&parted_pair());
    let together = validated(&[&records]).unwrap();
    assert!(has_i10(&together), "{:?}", together.not_judged);
    let (first, second) = (of(&records, "R1"), of(&records, "R2"));
    let apart = validated(&[&first, &second]).unwrap();
    assert!(!has_i10(&apart));
    assert!(
        apart.not_judged[0].starts_with("I10: no two robots share a clock"),
        "{:?}",
        apart.not_judged
    );
}

/// As if the leader's clock were two seconds ahead of what the log says of it.
#[test]
fn a_lease_that_outlasts_a_safety_timer_on_one_clock_is_refused() {
    let mut records = records(&parted_pair());
    for record in records.iter_mut().filter(|record| record.robot == "R1") {
        record.at_us += 2 * SECOND_US;
        match &mut record.entry {
            Entry::Started { unix_ms, .. } => *unix_ms += 2_000,
            Entry::Heard {
                reception: Some(reception),
                ..
            } => {
                reception.arrived_us += 2 * SECOND_US;
                reception.told_us += 2 * SECOND_US;
            }
            _ => {}
        }
    }
    let refusal = validated(&[&records]).unwrap_err();
    assert!(refusal.contains("broke I10: "), "{refusal}");
    assert!(refusal.contains(", line "), "{refusal}");
    // In logs of their own, nobody can tell.
    let (first, second) = (of(&records, "R1"), of(&records, "R2"));
    assert!(!has_i10(&validated(&[&first, &second]).unwrap()));
}

#[test]
fn a_lease_of_a_leader_that_hung_is_not_held_against_the_protocol() {
    let mut swarm = parted_pair();
    swarm.script.push(Happening {
        at_us: 3 * SECOND_US,
        place: 0,
        deed: Deed::Hang(5_000),
    });
    let mut records = records(&swarm);
    // The simulator ends where I10 is broken.
    let last = records.last().unwrap().at_us;
    records.retain(|record| record.at_us < last || record.robot == "R2");
    let validated = validated(&[&records]).unwrap();
    assert!(!has_i10(&validated));
    let why = &validated.not_judged[0];
    assert!(
        why.starts_with("I10: R1 was not told of time when a timer was due"),
        "{why}"
    );
}
