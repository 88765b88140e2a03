//! The timed model: what it proves of the shipped scenarios, that its figures follow the timers, and
//! that it notices when a timer is not what it should be.
//!
//! `cargo run --release -- check timed-pair timed-trio` is the same check with its report.

use crossguard_model_check::check::Options;
use crossguard_model_check::node::Rules;
use crossguard_model_check::report::{CutOff, ScenarioReport, Verdict};
use crossguard_model_check::scenario::Scenario;
use crossguard_model_check::sequence::{ChartStep, Place};
use crossguard_model_check::timed::{Model, TimedProperty, check};
use crossguard_protocol::*;

const PAIR: &str = include_str!("../scenarios/timed-pair.toml");

/// The pair with some lines replaced, and without the size that it is to have.
fn pair(changes: &[(&str, &str)]) -> Scenario {
    let mut text = PAIR.split("[expected]").next().unwrap().to_owned();
    for (from, to) in changes {
        assert!(text.contains(from), "no line '{from}'");
        text = text.replacen(from, to, 1);
    }
    Scenario::parse("timed-pair", &text).unwrap()
}

/// Followers do not fail: that is most of the states.
const NO_FOLLOWER_FAILS: (&str, &str) = ("disturbances = 1\n", "");
/// Nobody crashes.
const NOBODY_CRASHES: (&str, &str) = ("crashes = 1\n", "");

fn run(model: Option<Model>) -> ScenarioReport {
    let report = check(&model.unwrap(), &Options::default(), &mut |_| ());
    assert!(report.exhaustive, "{:?}", report.cut_off);
    report
}

fn run_shipped(name: &str) -> ScenarioReport {
    let report = run(Model::new(Scenario::load(name).unwrap()));
    for property in &report.properties {
        let fine = matches!(property.verdict, Verdict::Holds | Verdict::Reachable);
        assert!(fine, "{name}: {property:#?}");
    }
    let found = (report.unique_states, report.depth);
    let as_expected = report.size_as_expected;
    assert_eq!(as_expected, Some(true), "{name}: found {found:?}");
    report
}

/// The longest times found, in ms, with their bounds.
fn figures(report: &ScenarioReport) -> Vec<(Option<u32>, u32)> {
    report.figures.iter().map(|f| (f.ms, f.bound_ms)).collect()
}

// In the order of the figures: roles or given up, follower stopped, follower idle, corridor closed.

#[test]
fn a_pair_with_drifting_clocks_and_delayed_messages_keeps_every_property_and_bound() {
    let report = run_shipped("timed-pair");
    let checked: Vec<_> = report
        .properties
        .iter()
        .filter(|p| p.kind != "premise")
        .map(|p| p.id.as_str())
        .collect();
    assert_eq!(checked, TimedProperty::ALL.map(TimedProperty::name));
    assert_eq!(
        figures(&report),
        [
            (Some(220), 242),
            (Some(275), 308),
            (Some(440), 484),
            (Some(110), 154),
        ]
    );
}

#[test]
fn a_leader_with_two_followers_keeps_every_property_and_bound() {
    let report = run_shipped("timed-trio");
    assert_eq!(
        figures(&report),
        [
            (Some(165), 220),
            (Some(220), 275),
            (Some(275), 385),
            (Some(110), 165),
        ]
    );
}

#[test]
#[ignore = "takes half a minute: cargo test --release -p crossguard-model-check --test timed -- --ignored"]
fn a_pair_with_the_timers_in_use_keeps_every_property_and_bound() {
    let report = run_shipped("timed-in-use");
    assert_eq!(
        figures(&report),
        [
            (Some(3_000), 3_100),
            (Some(2_000), 2_100),
            (Some(7_000), 7_200),
            (Some(1_800), 1_900),
        ]
    );
}

#[test]
fn each_figure_follows_its_timer() {
    // Roles or given up, follower stopped, follower idle; as shipped: 220, 275, 440 ms.
    let cases = [
        ("t_help = 170", "t_help = 220", [275, 275, 440]),
        ("t_safety = 180", "t_safety = 230", [220, 330, 495]),
        ("t_leave = 110", "t_leave = 50", [220, 275, 330]),
        // Messages arrive in the tick in which they are sent.
        ("delay_ms = 55", "delay_ms = 0", [220, 220, 385]),
    ];
    for (from, to, expected) in cases {
        let report = run(Model::new(pair(&[(from, to), NO_FOLLOWER_FAILS])));
        let found: Vec<_> = figures(&report).into_iter().map(|(ms, _)| ms).collect();
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
    let mut changes = longer.to_vec();
    changes.push(("delay_ms = 55", "delay_ms = 0"));
    let report = run(Model::new(pair(&changes)));
    assert_eq!(figures(&report)[3], (Some(165), 220));
    assert_eq!(report.verdict("I11"), Some(Verdict::Holds));
}

#[test]
fn on_a_channel_without_loss_no_follower_falls_back() {
    let report = run(Model::new(pair(&[
        ("loss = true", "loss = false"),
        NO_FOLLOWER_FAILS,
        NOBODY_CRASHES,
    ])));
    assert_eq!(report.verdict("I10"), Some(Verdict::Holds));
    assert_eq!(report.verdict("I10-premise"), Some(Verdict::Unreachable));
    assert!(report.failed(), "a property that was put to no test");
}

#[test]
fn an_exploration_that_was_cut_off_proves_nothing() {
    let options = Options {
        states_max: Some(1_000),
        ..Options::default()
    };
    let model = Model::new(pair(&[])).unwrap();
    let report = check(&model, &options, &mut |_| ());
    assert_eq!(report.cut_off, Some(CutOff::StateLimit));
    assert_eq!(
        report.unique_states, 1_000,
        "the limit is kept to the state"
    );
    assert!(!report.exhaustive);
    assert!(
        !report
            .properties
            .iter()
            .any(|p| p.verdict == Verdict::Holds)
    );
}

/// One robot that was configured with other timers than the team: `Config` refuses timers that
/// contradict each other in one robot, and cannot see those of another.
struct Misconfigured {
    station: u32,
    config: Config,
}

impl Misconfigured {
    fn new(station: u32, change: impl FnOnce(&mut Settings)) -> Self {
        let mut settings = pair(&[]).config.settings().clone();
        change(&mut settings);
        let config = Config::new(settings).unwrap();
        Self { station, config }
    }
}

impl Rules for Misconfigured {
    fn step(&self, robot: &mut Robot, config: &Config, input: Input) -> Outputs {
        let own = robot.station() == StationId(self.station);
        robot.step(if own { &self.config } else { config }, input)
    }
}

fn violated(
    changes: &[(&str, &str)],
    rules: impl Rules + 'static,
) -> (Vec<String>, ScenarioReport) {
    let report = run(Model::with_rules(pair(changes), rules));
    let violated = report.violated().map(str::to_owned).collect();
    (violated, report)
}

#[test]
fn a_lease_that_is_longer_than_the_safety_timer_allows_is_refused() {
    let too_long = PAIR.replacen("t_lease = 90", "t_lease = 110", 1);
    let error = Scenario::parse("my.toml", &too_long)
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("the settings break 'lease-within-safety'"),
        "{error}"
    );
}

#[test]
fn a_lease_that_is_longer_than_the_followers_safety_timer_allows_breaks_the_theorem() {
    let leader = Misconfigured::new(1, |settings| {
        settings.t_lease = Millis(160);
        settings.t_safety = Millis(270);
    });
    let changes = [NO_FOLLOWER_FAILS, NOBODY_CRASHES];
    let (violated, report) = violated(&changes, leader);
    // The lease is also longer than the scenario's settings have it.
    assert_eq!(violated, ["I10", "I16"]);
    let lease_theorem = report.properties.iter().find(|p| p.id == "I10").unwrap();
    let chart = &lease_theorem.counterexample;
    let puts_out = |robot: usize, text: &str| {
        let of_robot = |step: &&ChartStep| match step.place {
            Place::At(at) | Place::Between { to: at, .. } => at == robot,
        };
        let mut outputs = chart.iter().filter(of_robot).flat_map(|step| &step.outputs);
        outputs.any(|output| output.contains(text))
    };
    assert!(puts_out(0, "lease on 2 granted"), "{chart:#?}");
    assert!(puts_out(1, "contact lost"), "{chart:#?}");
    assert!(!puts_out(0, "lease on 2 expired"), "{chart:#?}");
}

#[test]
fn a_safety_timer_that_is_shorter_than_the_leaders_lease_allows_breaks_the_theorem_alone() {
    let follower = Misconfigured::new(2, |settings| {
        settings.t_safety = Millis(120);
        settings.t_lease = Millis(40);
    });
    let (violated, _) = violated(&[NO_FOLLOWER_FAILS, NOBODY_CRASHES], follower);
    assert_eq!(violated, ["I10"]);
}

#[test]
fn a_safety_timer_that_is_too_long_stops_a_follower_too_late() {
    let follower = Misconfigured::new(2, |settings| settings.t_safety = Millis(300));
    let (violated, _) = violated(&[NO_FOLLOWER_FAILS], follower);
    assert_eq!(violated, ["I16", "L5"]);
}

#[test]
fn a_request_that_stands_too_long_is_noticed() {
    let leader = Misconfigured::new(1, |settings| settings.t_help = Millis(300));
    let (violated, _) = violated(&[NO_FOLLOWER_FAILS, NOBODY_CRASHES], leader);
    assert_eq!(violated, ["I16", "L1"]);
}

/// The pedestrian is not told that the corridor has closed.
struct NeverClosesTheCorridor;

impl Rules for NeverClosesTheCorridor {
    fn step(&self, robot: &mut Robot, config: &Config, input: Input) -> Outputs {
        let outputs = robot.step(config, input);
        let closes = |output: &Output| matches!(output, Output::CorridorClosed(_));
        outputs
            .iter()
            .copied()
            .filter(|output| !closes(output))
            .collect()
    }
}

#[test]
fn a_corridor_that_does_not_close_in_time_is_noticed() {
    let changes = [("delay_ms = 55", "delay_ms = 0")];
    let (violated, _) = violated(&changes, NeverClosesTheCorridor);
    assert_eq!(violated, ["I11"]);
}

/// Whoever hears a RAM sends one.
struct AnswersEveryRam;

impl Rules for AnswersEveryRam {
    fn step(&self, robot: &mut Robot, config: &Config, input: Input) -> Outputs {
        let outputs = robot.step(config, input);
        let is_led = matches!(robot.phase(), Phase::Leading(_) | Phase::Following(_));
        match input {
            Input::Ram { .. } if is_led => {
                let effects = outputs.iter().copied();
                let effects = effects.filter(|output| !matches!(output, Output::Ignored(_)));
                effects.chain([Output::SendRam]).collect()
            }
            _ => outputs,
        }
    }
}

#[test]
fn robots_that_answer_each_other_in_no_time_would_hold_time_up() {
    let changes = [
        NO_FOLLOWER_FAILS,
        NOBODY_CRASHES,
        ("delay_ms = 55", "delay_ms = 0"),
    ];
    let (violated, _) = violated(&changes, AnswersEveryRam);
    assert_eq!(violated, ["I12"]);
}

#[test]
fn what_has_no_meaning_in_a_timed_scenario_is_named_with_its_line() {
    let cases = [
        (
            "tick_ms = 55",
            "tick_ms = 56",
            "a tick of 56 ms: between 1 ms and 'delay_max' (55 ms)",
        ),
        (
            "delay_ms = 55",
            "delay_ms = 60",
            "messages under way for up to 60 ms",
        ),
        (
            "drift_ppm = 90910",
            "drift_ppm = 100",
            "a drift of 100 ppm is less than 1 ms",
        ),
        (
            "loss = true",
            "delayed = 1\nloss = true",
            "'delayed' has no place",
        ),
        ("crashes = 1", "restarts = 1", "'restarts' has no place"),
        ("\"I16\"", "\"I17\"", "no timed property 'I17': I10, I11"),
        ("tick_ms = 55", "tack_ms = 55", "unknown field `tack_ms`"),
    ];
    for (from, to, message) in cases {
        let line = PAIR.lines().position(|line| line.contains(from)).unwrap() + 1;
        let error = Scenario::parse("my.toml", &PAIR.replacen(from, to, 1))
            .unwrap_err()
            .to_string();
        assert!(error.contains(message), "{error}");
        let named =
            error.contains(&format!("my.toml:{line}: ")) || error.contains(&format!("line {line}"));
        assert!(named, "line {line}: {error}");
    }
}
