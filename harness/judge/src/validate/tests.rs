//! Logs of simulated robots are valid; with one record altered they are not.

use crossguard_endpoint::counters::Counts;
use crossguard_robot::trace;

use super::*;
use crate::sim::{Swarm, run_recorded};

pub(super) fn records(seed: u64) -> Vec<Record> {
    run_recorded(&Swarm::draw(seed, 4, None)).1
}

pub(super) fn text<'a>(records: impl IntoIterator<Item = &'a Record>) -> Vec<u8> {
    let mut text = Vec::new();
    for record in records {
        trace::write(&mut text, record).unwrap();
    }
    text
}

fn validated(records: &[Record]) -> Result<Validated, String> {
    one(&*text(records)).map_err(|invalid| invalid.to_string())
}

/// The logs of each robot by itself.
fn apart(records: &[Record]) -> Vec<Vec<u8>> {
    let names: BTreeSet<_> = records.iter().map(|record| &record.robot).collect();
    let of = |name| records.iter().filter(move |record| &record.robot == name);
    names.into_iter().map(|name| text(of(name))).collect()
}

fn together(logs: &[Vec<u8>]) -> Result<Validated, String> {
    let log = |(i, lines): (usize, &'_ Vec<u8>)| {
        Log::new(format!("log {i}"), std::io::Cursor::new(lines.clone()))
    };
    all(logs.iter().enumerate().map(log).collect()).map_err(|invalid| invalid.to_string())
}

#[test]
fn what_simulated_robots_did_is_valid_in_one_log_and_in_one_for_each() {
    for seed in 1..=12 {
        let records = records(seed);
        let whole = validated(&records).unwrap_or_else(|error| panic!("seed {seed}: {error}"));
        let parts = together(&apart(&records)).unwrap_or_else(|e| panic!("seed {seed}: {e}"));
        assert_eq!(whole.heard, parts.heard, "seed {seed}");
        assert_eq!((whole.from_strangers, whole.beyond_logs), (0, 0));
        assert_eq!(whole.steps, parts.steps);
    }
}

#[test]
fn one_robots_log_is_valid_by_itself_and_says_how_much_came_from_strangers() {
    for log in apart(&records(2)) {
        let validated = one(&*log).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(validated.heard, 0);
        assert!(validated.from_strangers > 0);
    }
}

/// A robot without a log that never falls silent, beside others whose clocks are apart: each of them waits for a message that
/// no log has.
#[test]
fn logs_are_valid_without_that_of_a_robot_that_all_of_them_hear() {
    for seed in 1..=12 {
        let mut records = records(seed);
        for record in &mut records {
            let number = record.robot.trim_start_matches('R').parse::<u64>();
            if let Entry::Started { unix_ms, .. } = &mut record.entry {
                *unix_ms += 700 * (number.unwrap() % 2);
            }
        }
        let logs = apart(&records);
        for missing in 0..logs.len() {
            let mut logs = logs.clone();
            logs.remove(missing);
            if !logs.is_empty() {
                let judged = together(&logs);
                judged.unwrap_or_else(|why| panic!("seed {seed}, without {missing}: {why}"));
            }
        }
    }
}

#[test]
fn what_is_not_a_log_is_told_apart() {
    let unstarted = validated(&records(1)[1..]).unwrap_err();
    assert!(unstarted.contains("was never started"), "{unstarted}");
    let error = |text: &[u8]| one(text).unwrap_err().to_string();
    assert!(error(b"{}\n").starts_with("line 1: is not a record"));
    assert!(error(b"").contains("there is nothing in this log"));
}

#[test]
fn a_log_that_was_cut_off_in_the_middle_of_a_line_is_valid_up_to_there() {
    let mut logs = apart(&records(2));
    let whole = together(&logs).unwrap();
    let half = logs[0].len() / 2;
    logs[0].truncate(half);
    let cut = together(&logs).unwrap();
    assert!(cut.steps < whole.steps);
    assert!(cut.beyond_logs > 0);
    assert!(cut.cut_off.contains(&"R1".to_owned()));
}

/// The last lines of a log are lost with a process that is killed, although others heard what they tell of.
#[test]
fn what_a_killed_robot_sent_last_is_beyond_its_log_although_it_boots_again() {
    let records = records(2);
    let mut logs = apart(&records);
    let half = logs[0].len() / 2;
    logs[0].truncate(half);
    let is_start = |it: &&Record| it.robot == "R1" && matches!(it.entry, Entry::Started { .. });
    let mut again = records.iter().rfind(is_start).unwrap().clone();
    let Entry::Started {
        boot,
        epoch,
        unix_ms,
        ..
    } = &mut again.entry
    else {
        panic!("{again:?}");
    };
    *boot += 1;
    *unix_ms += 3_600_000;
    *epoch = epoch.map(|it| it + 1);
    let end = Record {
        entry: Entry::Stopped {
            counters: Counts::default(),
        },
        ..again.clone()
    };
    logs.push(text([&again, &end]));
    let cut = together(&logs).unwrap();
    assert!(cut.beyond_logs > 0);
    assert!(cut.cut_off.contains(&"R1".to_owned()));
}
