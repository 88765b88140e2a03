//! Simulated robots: runs that repeat exactly, and times that stay within the times that the timed model
//! computes.

use crossguard_judge::sim::{
    Deed, Failure, Finding, Fuzz, Happening, Measure, Swarm, Worst, run, write_failure,
};
use crossguard_judge::validate;
use crossguard_model_check::scenario::Scenario;
use crossguard_model_check::timed::Limits;
use crossguard_protocol::Config;
use crossguard_robot::capture;
use crossguard_robot::plan::Plan;
use crossguard_robot::trace::{self, Record};
use crossguard_robot::transport::{Delay, Faults};
use crossguard_testkit::command::*;

/// The log of simulated robots, which are so many at most.
pub(crate) fn log_of(seed: u64, robots: usize) -> Vec<u8> {
    let mut log = Vec::new();
    let mut watch = |record: Record| trace::write(&mut log, &record).unwrap();
    let outcome = run(&Swarm::draw(seed, robots, None), Some(&mut watch));
    assert_eq!(outcome.finding, None);
    log
}

#[test]
fn a_seed_gives_the_same_run_to_the_last_byte_and_its_log_is_valid() {
    let log = log_of(3, 4);
    assert!(log == log_of(3, 4), "two runs of one seed differ");
    assert!(log != log_of(4, 4));
    let validated = validate::one(&*log).unwrap();
    assert!(validated.steps > 100, "{validated:?}");
}

/// Two robots with the timers of a timed scenario. One detects again and again, and either crashes
/// some time later; messages take no longer than in the scenario.
fn crashing_pair(scenario: &Scenario, seed: u64) -> Swarm {
    let timed = scenario.timed.as_ref().unwrap();
    let settings = scenario.config.settings();
    let faults = Faults {
        loss: 0.05,
        delay: Delay {
            max_ms: timed.delay.0,
            mean_ms: Some(4.0),
            ..Delay::default()
        },
        ..Faults::default()
    };
    let mut swarm = Swarm::draw(seed, 2, Some(&faults));
    (swarm.late_max_us, swarm.strikes) = (5_000, 0.0);
    (swarm.replays, swarm.is_secured, swarm.waits_at) = (Vec::new(), false, None);
    for robot in &mut swarm.robots {
        robot.config = Config::new(settings.clone()).unwrap();
        robot.drift_ppm *= i64::from(settings.drift_ppm / 1_000);
        robot.plan = Plan::crossing(robot.plan.site);
        robot.time_scale = 3.0;
        robot.corner = 0;
    }
    swarm
        .script
        .retain(|happening| happening.deed == Deed::Boot);
    for round in 1..=40 {
        let begin = round * 2_000_000;
        let crash_us = begin + 300_000 + (seed * 7_919 + round * 104_729) % 1_500_000;
        let crashes = usize::try_from(round % 2).unwrap();
        for (at_us, place, deed) in [
            (begin, 0, Deed::Detect),
            (crash_us, crashes, Deed::Crash),
            (begin + 1_900_000, crashes, Deed::Boot),
        ] {
            swarm.script.push(Happening { at_us, place, deed });
        }
    }
    swarm.heals_us = 90_000_000;
    for way in &mut swarm.ways {
        way.outages.clear();
    }
    swarm
}

fn worst_with_timers_of(scenario: &Scenario) -> Worst {
    let mut worst = Worst::default();
    for seed in 1..=20 {
        let outcome = run(&crashing_pair(scenario, seed), None);
        assert_eq!(outcome.finding, None, "seed {seed}");
        worst.add(outcome.worst);
    }
    worst
}

#[test]
fn the_longest_times_stay_within_those_that_the_timed_model_computes() {
    let scenario = Scenario::load("timed-pair").unwrap();
    let worst = worst_with_timers_of(&scenario);
    // The checker has figures of its own for these.
    let delay = scenario.timed.as_ref().unwrap().delay;
    let limits = Limits::new(&scenario.config, delay);
    let observed = [
        (limits.roles, Measure::Roles),
        (limits.stopped, Measure::Stopped),
        (limits.left, Measure::Left),
        (limits.corridor_closed, Measure::CorridorClosed),
    ];
    for (limit, measure) in observed {
        let observed = worst.of(measure).unwrap().ms;
        assert!(observed <= limit.0, "{measure:?}: {observed} ms, {limit:?}");
        // And it was a real try: at least a third of what is possible was seen.
        let is_real = observed * 3 > limit.0;
        assert!(is_real, "{measure:?}: {observed} ms, {limit:?}");
    }
}

#[test]
fn the_longest_times_of_drawn_streets_are_a_real_try() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("failures");
    let faults = "loss=0.1,burst=0.1x4,delay=1..50";
    let fuzz = format!("fuzz --seeds 300 --robots 4 --json --faults {faults} --out");
    let report = json(&run_well(&format!("{fuzz} {}", out.display())));
    assert_eq!(
        (&report["seeds"], &report["violations"]),
        (&300.into(), &0.into())
    );
    assert_eq!(report["failures"].as_array().unwrap().len(), 0);
    assert!(report["packets"].as_u64() > Some(1_000), "{report}");
    assert!(!out.exists(), "nothing is written of runs that went well");
    let worst = &report["worst"];
    // Where a guard is not heard at its place any more, the application closes the corridor before its lease runs out.
    for (measure, part) in [
        ("roles", 2),
        ("stopped", 2),
        ("left", 2),
        ("corridorClosed", 5),
        ("signAfterGuard", 2),
        ("signAfterLeader", 2),
        ("untold", 2),
    ] {
        let time = |name: &str| worst[measure][name].as_u64().unwrap();
        let (observed, held_against) = (time("ms"), time("boundMs"));
        assert!(observed <= held_against, "{measure}: {worst}");
        // At least this part of what is possible was seen.
        assert!(observed * part > held_against, "{measure}: {worst}");
    }
}

#[test]
fn a_plan_of_ones_own_is_what_all_leaders_do() {
    let folder = tempfile::tempdir().unwrap();
    let out = format!("--out={}", folder.path().join("out").display());
    let shares = |plan: &str| {
        let fuzz = "fuzz --seeds 12 --robots 4 --liars 0 --json";
        let report = json(&run_well(&format!("{fuzz} {plan} {out}")));
        assert!(report["premises"]["W7"].as_u64().unwrap() > 0, "{report}");
        report["packets"].as_u64().unwrap()
    };
    let (drawn, trio) = (shares(""), shares("--plan trio"));
    assert_ne!(drawn, trio, "the plan says what happens");
    assert_eq!(shares("--plan trio"), trio);
}

#[test]
fn of_a_failure_the_log_and_the_packets_are_written() {
    let fuzz = Fuzz {
        seeds: 10,
        robots: 4,
        ..Fuzz::default()
    };
    let failure = Failure {
        seed: 5,
        finding: Finding {
            property: "I4".to_owned(),
            statement: "a command is started at most once".to_owned(),
            at_ms: 1_234,
            robot: "R2".to_owned(),
        },
    };
    let folder = tempfile::tempdir().unwrap();
    let files = write_failure(folder.path(), &fuzz, &failure).unwrap();
    let log = std::fs::read(&files.log).unwrap();
    let validated = validate::one(&*log).unwrap();
    assert!(validated.steps > 100);
    let packets = capture::read(&files.pcap).unwrap();
    assert_eq!(packets.map(Result::unwrap).count(), validated.sent);
    let again = fuzz.reproduce(failure.seed);
    let expected = "crossguard fuzz --seeds 1 --robots 4 --seed 5 --sensors 0 --liars 0";
    assert_eq!(again, expected);
    run_well(again.trim_start_matches("crossguard "));
}

/// The line that runs a failed seed again says all of it.
#[test]
fn a_site_goes_with_sensors_that_see_nobody() {
    let site = concat!(env!("CARGO_MANIFEST_DIR"), "/robot/plans/street.toml");
    let fuzz = "fuzz --seeds 1 --robots 4 --plan trio --sensors 0 --site";
    run_well(&format!("{fuzz} {site}"));
}
