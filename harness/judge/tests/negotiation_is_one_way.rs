//! `T_neg` is the way of a command to its follower, and not the way of the acknowledgement back: it agrees with the delay
//! that the simulated network was given, also where the logs of leader and follower have clocks of their own.

use crossguard_judge::sim::{Swarm, run_recorded};
use crossguard_judge::timing::{NoOffset, Summary, Timing};
use crossguard_robot::trace::{Entry, Record};
use crossguard_robot::transport::{Delay, Faults};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

const LEADER: &str = "R1";

/// A leader and a follower; every datagram takes so many ms to the follower, and so many back.
fn pair(there_ms: u32, back_ms: u32) -> Swarm {
    let mut swarm = Swarm::quiet(2);
    let exactly = |ms| Faults {
        delay: Delay {
            min_ms: ms,
            max_ms: ms,
            mean_ms: None,
        },
        ..Faults::default()
    };
    swarm.ways[1] = exactly(there_ms);
    swarm.ways[2] = exactly(back_ms);
    swarm
}

fn records(swarm: &Swarm) -> Vec<Record> {
    let (outcome, records) = run_recorded(swarm);
    assert!(outcome.finding.is_none(), "{:?}", outcome.finding);
    records
}

/// The times in a log that both robots share.
fn on_one_clock(swarm: &Swarm) -> Vec<Summary> {
    let mut timing = Timing::default();
    for record in records(swarm) {
        timing.record(0, record.at_us, &record);
    }
    assert!(timing.offsets().is_empty());
    timing.summaries()
}

/// The times in two logs, the follower's with a clock that is ahead, from the second `from_us` on.
fn on_two_clocks(records: &[Record], ahead_us: i64, from_us: u64) -> Timing {
    let mut timing = Timing::default();
    for record in records {
        let is_leaders = record.robot == LEADER;
        let put = !is_leaders && record.at_us >= from_us;
        let ahead_us = if put { ahead_us } else { 0 };
        let at_us = (record.at_us + 60_000_000).saturating_add_signed(ahead_us);
        timing.record(usize::from(!is_leaders), at_us, record);
    }
    timing
}

fn assert_near(measured_s: f64, put_in_ms: u32, what: &str) {
    let off_ms = measured_s * 1e3 - f64::from(put_in_ms);
    assert!(off_ms.abs() < 1.0, "{what}: {measured_s} s, {put_in_ms} ms");
}

fn assert_times(summaries: &[Summary], there_ms: u32, back_ms: u32) {
    let tasks: Vec<_> = summaries.iter().map(|it| it.task.as_str()).collect();
    assert_eq!(tasks, ["initialPos", "move"]);
    for summary in summaries {
        assert_near(summary.t_neg_s.mean, there_ms, "T_neg");
        assert_near(
            summary.round_trip_s.mean,
            there_ms + back_ms,
            "the round trip",
        );
        let sum = summary.t_neg_s.mean + summary.t_exec_s.mean;
        assert!((summary.t_tmct_s.mean - sum).abs() < 1e-9);
    }
}

#[test]
fn the_way_back_is_in_the_round_trip_alone() {
    for (there_ms, back_ms) in [(74, 5), (5, 74), (30, 30)] {
        assert_times(&on_one_clock(&pair(there_ms, back_ms)), there_ms, back_ms);
    }
}

/// Delays as the paper measured them: 27 to 600 ms, 129 ms on average.
#[test]
fn it_agrees_with_a_delay_like_the_papers_to_a_millisecond() {
    let mut draws = ChaCha8Rng::seed_from_u64(16);
    for _ in 0..20 {
        let exponential = -102.0 * (1.0 - draws.random::<f64>()).ln();
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "it is positive, and less than 600"
        )]
        let there_ms = (27.0 + exponential).min(600.0) as u32;
        let summaries = on_one_clock(&pair(there_ms, 10));
        for summary in &summaries {
            assert_near(summary.t_neg_s.mean, there_ms, "T_neg");
        }
        assert_eq!(summaries.len(), 2, "{there_ms} ms");
    }
}

#[test]
fn of_two_logs_the_difference_of_the_clocks_is_taken_off_and_bounded() {
    let records = records(&pair(40, 40));
    for ahead_us in [-50_000_000, -700_000, 0, 3_000, 2_000_000] {
        let timing = on_two_clocks(&records, ahead_us, 0);
        let offset = timing.offsets()[&(0, 1)].unwrap();
        assert!(
            (offset.offset_us - ahead_us).abs() < 1_000,
            "{ahead_us}: {offset:?}"
        );
        assert_times(&timing.summaries(), 40, 40);
    }
}

/// No method can tell a slow way from a clock that is apart; the bound says by how much that matters.
#[test]
fn where_one_way_is_slower_the_error_is_within_the_bound() {
    let timing = on_two_clocks(&records(&pair(120, 20)), 1_000_000, 0);
    let offset = timing.offsets()[&(0, 1)].unwrap();
    let wrong_by_us = (offset.offset_us - 1_000_000).abs();
    assert!(wrong_by_us > 10_000, "{offset:?}");
    assert!(wrong_by_us <= offset.bound_us, "{offset:?}");
    let round_trip = timing.summaries()[0].round_trip_s.mean;
    assert_near(round_trip, 140, "the round trip needs no other clock");
}

#[test]
fn a_clock_that_was_put_in_mid_run_is_said_and_not_averaged() {
    let records = records(&pair(40, 40));
    let timing = on_two_clocks(&records, -5_000_000, 12_000_000);
    assert!(matches!(
        timing.offsets()[&(0, 1)],
        Err(NoOffset::Unsteady(_))
    ));
    assert!(timing.summaries().is_empty());
    let leaders = records.iter().filter(|record| record.robot == LEADER);
    let mut alone = Timing::default();
    for record in leaders {
        alone.record(0, record.at_us, record);
        assert!(!matches!(record.entry, Entry::Dropped { .. }));
    }
    assert!(
        alone.summaries().is_empty(),
        "the follower's log is missing"
    );
}
