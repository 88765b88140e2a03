//! The timed model: its verdicts on the shipped scenarios, and figures that follow the timers. Timers that
//! are not as they should be are in `timed_weakenings.rs`.
//!
//! `cargo run --release -- check timed-pair timed-trio` is the same check with its report.

use crate::scenario_files::assert_refused;
use crate::scenarios::assert_judged_well;
use crate::timing::*;
use crossguard_model_check::check::Options;
use crossguard_model_check::report::{CheckVerdict, CutOff, ScenarioReport};
use crossguard_model_check::scenario::Scenario;
use crossguard_model_check::timed::{TimedModel, check};

const TRIO_DRIFT: &str = include_str!("../scenarios/timed-trio-drift.toml");

/// The pair with some lines replaced, whose endpoints look when they like.
fn free_pair(changes: &[(&str, &str)]) -> Scenario {
    let text = changed(PAIR, &[&[NO_DELAY], changes].concat());
    Scenario::parse("timed-pair", &text).unwrap()
}

fn run_shipped(name: &str) -> ScenarioReport {
    let scenario = Scenario::load(name).unwrap();
    let report = run(TimedModel::new(scenario));
    assert_judged_well(name, &report);
    for figure in &report.figures {
        let ms = figure.ms;
        assert!(ms.is_some_and(|ms| ms <= figure.bound_ms), "{figure:?}");
    }
    report
}

/// The properties with the longest times found, in ms, and their bounds.
fn figures(report: &ScenarioReport) -> Vec<(&str, u32, u32)> {
    let figures = report.figures.iter();
    figures
        .map(|figure| (figure.id.as_str(), figure.ms.unwrap(), figure.bound_ms))
        .collect()
}

#[test]
fn a_hang_of_either_robot_ends_the_sign_within_the_lease() {
    let report = run_shipped("timed-hang");
    let expected = [
        ("L1", 275, 303),
        ("W5", 110, 160),
        ("W5, W1", 110, 160),
        ("W1", 0, 0),
        ("W6", 110, 160),
    ];
    assert_eq!(figures(&report), expected);
}

#[test]
fn a_pedestrian_sees_go_or_the_application_is_told_why_not_within_the_bound() {
    let report = run_shipped("timed-wait");
    let expected = [("L1", 275, 303), ("W1", 0, 0), ("W8", 1_100, 1_592)];
    assert_eq!(figures(&report), expected);
}

#[test]
fn two_teams_that_meet_show_go_together_for_two_periods_at_most() {
    let report = run_shipped("timed-rivals");
    assert_eq!(figures(&report), [("W3", 275, 303)]);
}

/// `timed-trio-drift` has clocks that keep their rates and endpoints that are late; here are clocks that
/// change their rates at every tick, and endpoints that are not.
#[test]
#[ignore = "takes half a minute: cargo test --release -p crossguard-model-check --test it -- --ignored timed::"]
fn clocks_of_three_robots_may_change_their_rates() {
    let changes = [("rates = \"constant\"\n", ""), ("free = true\n", "")];
    let text = changed(TRIO_DRIFT, &changes);
    let report = run(TimedModel::new(
        Scenario::parse("timed-trio-drift", &text).unwrap(),
    ));
    assert!(!report.failed(), "{:#?}", report.properties);
    assert_eq!((report.unique_states, report.depth), (1_654_212, 36));
}

/// The endpoints look up to 110 ms late, where the settings say 55 ms.
const LATE: (&str, &str) = ("free = true", "free = true\nlate_ms = 110");
/// Messages arrive in the tick in which they are sent, as in [`pair`].
const NO_DELAY: (&str, &str) = ("delay_ms = 55", "delay_ms = 0");

#[test]
fn endpoints_that_are_later_than_their_settings_say_are_found_by_the_free_view_alone() {
    let changes = [NO_FOLLOWER_FAILS, NOBODY_CRASHES];
    let violated = |scenario: Scenario| {
        let report = run(TimedModel::new(scenario));
        report.violated().map(str::to_owned).collect::<Vec<_>>()
    };
    let late = free_pair(&[&[LATE], changes.as_slice()].concat());
    // The sign ends by itself, so nobody sees go after a fallback.
    assert_eq!(violated(late), ["I10", "L1", "W6"]);
    assert!(violated(pair(&changes)).is_empty());
}

#[test]
fn settings_that_say_how_late_endpoints_are_keep_every_property() {
    let changes = [
        ("delay_max = 55", "delay_max = 110"),
        ("t_safety = 180", "t_safety = 250"),
        NO_FOLLOWER_FAILS,
        NOBODY_CRASHES,
    ];
    let report = run(TimedModel::new(free_pair(&changes)));
    assert_eq!(report.violated().next(), None);
    assert_eq!(figure(&report, "L1"), Some((330, 364)));
}

/// The first figure of a property, where it was measured, and its bound.
fn figure(report: &ScenarioReport, id: &str) -> Option<(u32, u32)> {
    let figure = report.figures.iter().find(|figure| figure.id == id)?;
    Some((figure.ms?, figure.bound_ms))
}

#[test]
fn each_figure_follows_its_timer() {
    // Roles or given up, follower stopped, follower idle; as shipped, without delays: 275, 220, 385 ms.
    let cases = [
        ("t_help = 220", "t_help = 270", [330, 220, 385]),
        ("t_safety = 180", "t_safety = 230", [275, 275, 440]),
        ("t_leave = 110", "t_leave = 50", [275, 220, 275]),
        ("delay_ms = 0", "delay_ms = 55", [275, 275, 440]),
    ];
    for (from, to, expected) in cases {
        let report = run(TimedModel::new(pair(&[(from, to), NO_FOLLOWER_FAILS])));
        let found: Vec<_> = report.figures.iter().map(|figure| figure.ms).collect();
        assert_eq!(found[..3], expected.map(Some), "{to}");
        assert_eq!(report.violated().next(), None, "{to}");
    }
}

#[test]
fn the_corridor_closes_later_with_a_longer_lease() {
    let longer = [
        ("t_lease = 90", "t_lease = 150"),
        ("t_safety = 180", "t_safety = 250"),
    ];
    let report = run(TimedModel::new(pair(&longer)));
    assert_eq!(figure(&report, "I11, W1"), Some((165, 226)));
    assert_eq!(figure(&report, "W6"), Some((165, 226)));
    assert_eq!(report.verdict("I11"), Some(CheckVerdict::Holds));
}

#[test]
fn on_a_channel_without_loss_no_follower_falls_back() {
    let no_loss = ("loss = true", "loss = false");
    let scenario = pair(&[no_loss, NO_FOLLOWER_FAILS, NOBODY_CRASHES]);
    let report = run(TimedModel::new(scenario));
    assert_eq!(report.verdict("I10"), Some(CheckVerdict::Holds));
    let premise = report.verdict("I10-premise");
    assert_eq!(premise, Some(CheckVerdict::Unreachable));
    assert!(report.failed(), "a property that was put to no test");
}

#[test]
fn an_exploration_that_was_cut_off_proves_nothing() {
    let options = Options {
        states_max: Some(1_000),
        ..Options::default()
    };
    let model = TimedModel::new(pair(&[])).unwrap();
    let report = check(&model, &options, &mut |_| ());
    assert_eq!(report.cut_off, Some(CutOff::StateLimit));
    let size = report.unique_states;
    assert_eq!(size, 1_000, "the limit is kept to the state");
    assert!(!report.exhaustive);
    let mut properties = report.properties.iter();
    assert!(properties.all(|it| it.verdict != CheckVerdict::Holds));
}

#[test]
fn what_has_no_meaning_in_a_timed_scenario_is_named_with_its_line() {
    #[rustfmt::skip]
    let mistakes = [
        ("tick_ms = 55", "tick_ms = 56", "", "a tick of 56 ms: between 1 ms and 'delay_max' (55 ms)"),
        ("delay_ms = 55", "delay_ms = 60", "", "messages under way for up to 60 ms"),
        ("drift_ppm = 90910", "drift_ppm = 100", "", "a drift of 100 ppm is less than 1 ms"),
        ("loss = true", "delayed = 1\nloss = true", "", "'delayed' has no place"),
        ("crashes = 1", "restarts = 1", "", "'restarts' has no place"),
        ("\"I16\"", "\"I17\"", "", "no timed property 'I17': I10, I11"),
        ("free = true", "late_ms = 60", "", "'late_ms' is for endpoints that look when they like"),
        ("crashes = 1", "hangs = 1", "", "hangs of up to 0 ms"),
        ("tick_ms = 55", "hang_ms = 100\ntick_ms = 55", "", "hangs of up to 100 ms"),
        ("tick_ms = 55", "tack_ms = 55", "", "unknown field `tack_ms`"),
        ("t_lease = 90", "t_lease = 110", "", "the settings break 'lease-within-safety'"),
    ];
    assert_refused(PAIR, &mistakes);
    let rivals = include_str!("../scenarios/timed-rivals.toml");
    let why = "'crashes' has no place in a timed scenario with two teams";
    let (line, crashes) = ("commands = 2", "commands = 2\ncrashes = 1");
    assert_refused(rivals, &[(line, crashes, "crashes = 1", why)]);
}
