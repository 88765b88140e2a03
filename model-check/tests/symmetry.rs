//! Symmetric robots: the verdicts are those of the scenario without symmetry, the counterexamples are
//! real runs, and a claim of symmetry that is none is refused with its line.

use crate::scenario_files::assert_refused;
use crossguard_model_check::check::{Options, check};
use crossguard_model_check::model::Model;
use crossguard_model_check::node::{Protocol, Rules};
use crossguard_model_check::replay::Replay;
use crossguard_model_check::report::{CheckVerdict, ScenarioReport};
use crossguard_model_check::scenario::Scenario;
use crossguard_testkit::rules::{FollowersWaitForEver, LosesTwoForOne};

const TRIO: &str = include_str!("../scenarios/trio.toml");

/// The trio without the properties that fairness is needed for, and with no size expected.
fn without_liveness() -> String {
    let (trio, _) = TRIO.split_once("[expected]").unwrap();
    trio.replace(r#""L1", "L2", "L4", "#, "")
}

fn symmetric() -> String {
    without_liveness().replacen("properties", "symmetric = [2, 3]\nproperties", 1)
}

fn report(text: &str, rules: impl Rules + 'static) -> (Model, ScenarioReport) {
    let model = Model::with_rules(Scenario::parse("trio.toml", text).unwrap(), rules);
    let report = check(&model, &Options::default(), &mut |_| ());
    (model, report)
}

fn verdicts(report: &ScenarioReport) -> Vec<(&str, CheckVerdict)> {
    let properties = report.properties.iter();
    properties.map(|p| (p.id.as_str(), p.verdict)).collect()
}

/// Asserts that symmetry changes no verdict, and that what breaks with it breaks in a real run. Returns
/// the ids of what breaks.
fn assert_same_verdicts<R: Rules + 'static>(rules: fn() -> R) -> Vec<String> {
    let (_, plain) = report(&without_liveness(), rules());
    let (model, reduced) = report(&symmetric(), rules());
    assert_eq!(verdicts(&plain), verdicts(&reduced));
    for property in &reduced.properties {
        if let Some(replay) = Replay::of(&reduced, property) {
            assert!(replay.is_broken_in(&model), "{replay:#?}");
        }
    }
    reduced.violated().map(str::to_owned).collect()
}

#[test]
fn the_protocol_gets_the_same_verdicts() {
    assert!(assert_same_verdicts(|| Protocol).is_empty());
}

#[test]
fn a_follower_that_goes_and_takes_another_with_it_is_found() {
    assert_eq!(assert_same_verdicts(|| LosesTwoForOne), ["I17"]);
}

#[test]
fn followers_that_are_stuck_are_found() {
    assert_eq!(assert_same_verdicts(|| FollowersWaitForEver), ["I12", "L7"]);
}

#[test]
fn a_claim_of_symmetry_that_is_none_is_refused_with_its_line() {
    let claim = "symmetric = [2, 3]";
    #[rustfmt::skip]
    let mistakes = [
        (claim, "symmetric = [2, 7]", "symmetric", "no robot has station id 7"),
        (claim, "symmetric = [1, 2]", "symmetric", "robot 1 detects"),
        (claim, "symmetric = [3, 3]", "symmetric", "robot 3 is named twice"),
        (claim, "symmetric = [3]", "symmetric", "robot 3 is the only symmetric one"),
        ("followers = 2", "followers = 1", "", "symmetric robots need followers = 2"),
        ("commands = 1", "commands = 1\ndisturbances = 1", "disturbances", "need disturbances = 0"),
        ("\"I18\"", "\"I18\",\n\"L4\"", "\"L4\"", "L4 assumes fairness to each robot by itself"),
        ("[protocol]", "[timed]\ntick_ms = 50\ndelay_ms = 0\n[protocol]", "symmetric", "no place in a timed scenario"),
    ];
    assert_refused(&symmetric(), &mistakes);
}

#[test]
fn the_report_says_which_robots_count_as_one() {
    let (_, reduced) = report(
        &symmetric().replace("commands = 1", "commands = 0"),
        Protocol,
    );
    let says = |what: &str| reduced.assumptions.iter().any(|line| line.contains(what));
    assert!(says(
        "states that differ by exchanging robots 2, 3 count as one"
    ));
    assert!(says("any may hear it first"));
}
