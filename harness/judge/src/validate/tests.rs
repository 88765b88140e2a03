//! Logs of simulated robots are valid; with one record altered they are not.

use crossguard_codec::{Heard, Identifiers, Position, encode, rmcm_from_commands};
use crossguard_endpoint::cause::Cause;
use crossguard_endpoint::counters::Counts;
use crossguard_protocol::{Rmcm, TaskType};
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

/// A command to this robot in a record, and its octets with another speed or as they are.
fn commanded(record: &Record, station: StationId, other_speed: bool) -> Option<Vec<u8>> {
    let (ids, nowhere) = (Identifiers::default(), Position::default());
    let Entry::Heard { octets, .. } = &record.entry else {
        return None;
    };
    let heard = Heard::of(&ids, station, &nowhere, octets).ok()?;
    let command = heard.inputs.iter().find_map(|input| match input {
        Input::Rmcm(Rmcm::Command(command)) if command.to == station => Some(*command),
        _ => None,
    })?;
    let mut parameters = heard.parameters?;
    if command.task == TaskType::BLOCK && other_speed {
        parameters.maximum_speed = Some(0.3);
    }
    let rmcm = rmcm_from_commands(&ids, &nowhere, &[(command, parameters)], 0);
    Some(encode(&ids, &rmcm.unwrap()).unwrap())
}

/// Hazard: somebody says another command under a requestID that a guard has accepted. The guard refuses it, and its log counts as made
/// up.
#[test]
fn a_command_that_was_refused_because_of_its_request_id_is_taken_in_by_no_step() {
    let mut judged = 0;
    for seed in 1..=12 {
        let records = records(seed);
        let names: BTreeSet<_> = records.iter().map(|record| &record.robot).collect();
        for name in names {
            let of_robot = records.iter().filter(|record| &record.robot == name);
            let log: Vec<_> = of_robot.cloned().collect();
            for (other_speed, is_valid) in [(true, true), (false, false)] {
                let Some(log) = with_a_command_more(&log, other_speed) else {
                    continue;
                };
                let found = validated(&log);
                assert_eq!(found.is_ok(), is_valid, "seed {seed}, {name}: {found:?}");
                judged += 1;
            }
        }
    }
    assert!(judged > 1, "{judged}");
}

/// A log of one robot that hears a command to block again, with another speed or as it was, and drops it.
fn with_a_command_more(log: &[Record], other_speed: bool) -> Option<Vec<Record>> {
    let Entry::Started { station, .. } = log[0].entry else {
        panic!("{:?}", log[0]);
    };
    let starts = |record: &Record| {
        let Entry::Step { outputs, .. } = &record.entry else {
            return false;
        };
        outputs.iter().any(|it| {
            let is_block = |it: &crossguard_protocol::Maneuver| it.task == TaskType::BLOCK;
            matches!(it, crossguard_protocol::Output::StartManeuver(it) if is_block(it))
        })
    };
    let started = log.iter().position(starts)?;
    let octets = commanded(&log[started - 1], station, other_speed)?;
    let is_heard = |record: &Record| matches!(record.entry, Entry::Heard { .. });
    let next = started + log[started..].iter().position(is_heard)?;
    let Entry::Heard {
        message,
        from,
        reception,
        ..
    } = &log[started - 1].entry
    else {
        return None;
    };
    let Entry::Heard { reception: now, .. } = &log[next].entry else {
        return None;
    };
    let mut log = log.to_vec();
    let refused = Cause::Contradictory("another command under its requestID");
    let heard = Entry::Heard {
        message: *message,
        from: *from,
        reception: now.or(*reception),
        octets: octets.clone(),
    };
    let dropped = Entry::Dropped {
        cause: refused.into(),
        detail: String::new(),
        octets,
    };
    for entry in [dropped, heard] {
        let record = Record {
            entry,
            ..log[next].clone()
        };
        log.insert(next, record);
    }
    // It is counted, too.
    for record in &mut log[next..] {
        if let Entry::Stopped { counters } = &mut record.entry {
            counters.add(&refused.into(), 1);
            break;
        }
    }
    Some(log)
}
