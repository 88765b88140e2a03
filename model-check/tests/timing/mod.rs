//! Fixtures for the tests of the timed model: small pairs, and runs of them.

use crossguard_model_check::check::Options;
use crossguard_model_check::report::ScenarioReport;
use crossguard_model_check::scenario::Scenario;
use crossguard_model_check::timed::{TimedModel, check};

pub(crate) const PAIR: &str = include_str!("../../scenarios/timed-pair.toml");

/// A scenario's text with some lines replaced, and without the size that it is to have.
pub(crate) fn changed(text: &str, changes: &[(&str, &str)]) -> String {
    let mut text = text.split("[expected]").next().unwrap().to_owned();
    for (from, to) in changes {
        assert!(text.contains(from), "no line '{from}'");
        text = text.replacen(from, to, 1);
    }
    text
}

/// The pair, with messages that arrive in the tick in which they are sent and endpoints that all look at
/// the same ticks, and with some lines replaced. It has a hundredth of the states.
pub(crate) fn pair(changes: &[(&str, &str)]) -> Scenario {
    let small = [("free = true\n", ""), ("delay_ms = 55", "delay_ms = 0")];
    let text = changed(PAIR, &[&small, changes].concat());
    Scenario::parse("timed-pair", &text).unwrap()
}

/// Followers do not fail: that is most of the states.
pub(crate) const NO_FOLLOWER_FAILS: (&str, &str) = ("disturbances = 1\n", "");
pub(crate) const NOBODY_CRASHES: (&str, &str) = ("crashes = 1\n", "");

pub(crate) fn run(model: Option<TimedModel>) -> ScenarioReport {
    let report = check(&model.unwrap(), &Options::default(), &mut |_| ());
    assert!(report.exhaustive, "{:?}", report.cut_off);
    report
}
