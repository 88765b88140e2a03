//! The channels and hanging robots: what arrives when, what a monotone channel finds, and that its
//! counterexamples are runs.

use crossguard_model_check::check::{Options, check};
use crossguard_model_check::model::{Action, Delivery, Model, ModelState};
use crossguard_model_check::node::Rules;
use crossguard_model_check::properties::PropertyId::{self, *};
use crossguard_model_check::replay::Replay;
use crossguard_model_check::scenario::Scenario;
use crossguard_protocol::{Event, Phase, Robot};
use crossguard_testkit::rules::*;

/// The ids of what breaks in a scenario when `rules` takes the place of the protocol, as far as that is to
/// be found out. Each counterexample is followed again.
fn violated(
    scenario: Scenario,
    rules: impl Rules + 'static,
    until_broken: &[PropertyId],
) -> Vec<String> {
    let model = Model::with_rules(scenario, rules);
    let options = Options {
        until_broken: until_broken.to_vec(),
        second_opinion: true,
        ..Options::default()
    };
    let report = check(&model, &options, &mut |_| ());
    for property in &report.properties {
        if let Some(replay) = Replay::of(&report, property) {
            assert!(replay.is_broken_in(&model), "{replay:#?}");
        }
    }
    report.violated().map(str::to_owned).collect()
}

fn without_size(text: &str) -> Scenario {
    let (text, _) = text.split_once("[expected]").unwrap_or((text, ""));
    Scenario::parse("any.toml", text).unwrap()
}

/// Two sessions of a pair that crashes and boots again, with one delayed message or on a monotone channel.
fn reboot(monotone: bool) -> Scenario {
    let mut scenario = without_size(include_str!("../scenarios/pair-reboot.toml"));
    if monotone {
        scenario.channel.delayed = 0;
        scenario.channel.monotone = true;
        scenario.bounds.heartbeats = Some(1);
        scenario.bounds.offers = Some(2);
    }
    scenario
}

/// One session of a pair, with one delayed message or on a monotone channel.
fn pair(monotone: bool) -> Scenario {
    let mut scenario = reboot(monotone);
    scenario.bounds.crashes = 0;
    scenario.bounds.restarts = 0;
    scenario.bounds.detections = 1;
    scenario.bounds.commands = 2;
    scenario.corridor = false;
    scenario.channel.loss = true;
    scenario.bounds.losses = (!monotone).then_some(1);
    scenario.properties = vec![I1, I2, I3, I4, I5, I6, I7, I8, I9, I13, I14, L7];
    scenario
}

/// A weakening that breaks something in one session of a pair with one delayed message breaks as much of it on a monotone
/// channel.
macro_rules! finds_as_much {
    ($($name:ident($rules:expr);)*) => {$(
        #[test]
        fn $name() {
            let with_delay = violated(pair(false), $rules, &[]);
            assert!(!with_delay.is_empty());
            // A liveness property needs the whole graph.
            let is_liveness = with_delay.iter().any(|id| id.starts_with('L'));
            let ids = PropertyId::ALL.into_iter();
            let broken = ids.filter(|id| with_delay.contains(&id.to_string()));
            let until_found: Vec<_> = broken.filter(|_| !is_liveness).collect();
            let monotone = violated(pair(true), $rules, &until_found);
            assert!(with_delay.iter().all(|id| monotone.contains(id)), "{monotone:?} of {with_delay:?}");
        }
    )*};
}

finds_as_much! {
    a_monotone_channel_finds_a_robot_that_needs_no_confirmation(NeedsNoConfirmation);
    a_monotone_channel_finds_repeated_commands_that_are_started(StartsRepeatedCommands);
    a_monotone_channel_finds_older_commands_that_are_started(StartsOlderCommands);
    a_monotone_channel_finds_acknowledgements_of_other_commands(TakesAnyAcknowledgement);
    a_monotone_channel_finds_progress_of_other_commands(TakesAnyProgress);
    a_monotone_channel_finds_followers_that_wait_for_ever(FollowersWaitForEver);
}

#[test]
fn a_monotone_channel_finds_commands_of_another_session() {
    let found = violated(reboot(true), ObeysCommandsOfAnySession, &[I3]);
    assert!(found.contains(&"I3".to_owned()), "{found:?}");
}

#[test]
fn a_monotone_channel_finds_a_rebooted_follower_that_is_drawn_back() {
    let found = violated(reboot(true), ConfirmsByStationAlone, &[I2, I15]);
    for id in ["I2", "I15"] {
        assert!(found.contains(&id.to_owned()), "{found:?}");
    }
}

/// A run that a test makes up step by step.
struct Run {
    model: Model,
    state: ModelState,
}

impl Run {
    fn of(scenario: Scenario) -> Self {
        let model = Model::new(scenario);
        let state = model.initial();
        Self { model, state }
    }

    /// Takes the first possible action that is meant.
    fn take(&mut self, is_meant: impl Fn(&Action) -> bool) -> &mut Self {
        let taken = self.next(is_meant);
        self.state = taken.expect("it is possible");
        self
    }

    fn next(&self, is_meant: impl Fn(&Action) -> bool) -> Option<ModelState> {
        let mut actions = Vec::new();
        self.model.actions_in(&self.state, &mut actions);
        let meant = actions.into_iter().filter(is_meant);
        let mut possible = meant.filter_map(|action| self.model.successor(&self.state, action));
        possible.next().map(|(state, _)| state)
    }

    fn robot(&self, place: usize) -> &Robot {
        let node = self.model.nodes(&self.state).nth(place).unwrap();
        node.robot.as_ref().expect("it is up")
    }

    fn is_offering(&self) -> bool {
        matches!(self.robot(1).phase(), Phase::Offering(_))
    }
}

fn detect(action: &Action) -> bool {
    matches!(action, Action::Local(0, Event::PedestrianDetected(_)))
}

fn delay(action: &Action) -> bool {
    matches!(action, Action::Delay(_))
}

fn lose(action: &Action) -> bool {
    matches!(action, Action::Lose(_))
}

fn arrives(how: Delivery) -> impl Fn(&Action) -> bool {
    move |action| matches!(action, Action::Deliver { transmission, how: h } if transmission.to == 1 && *h == how)
}

#[test]
fn a_delayed_message_survives_the_reboot_of_its_receiver() {
    let mut run = Run::of(reboot(false));
    run.take(detect).take(delay);
    run.take(|action| *action == Action::Crash(1));
    assert_eq!(run.next(arrives(Delivery::Late)), None, "nobody is there");
    run.take(|action| *action == Action::Restart(1));
    run.take(arrives(Delivery::Late));
    assert!(run.is_offering());
}

#[test]
fn a_message_to_a_robot_that_is_down_arrives_after_its_reboot_or_never() {
    let mut run = Run::of(reboot(false));
    run.take(|action| *action == Action::Crash(1)).take(detect);
    assert_eq!(run.next(arrives(Delivery::AtOnce)), None);
    assert!(run.next(lose).is_some());
    run.take(delay).take(|action| *action == Action::Restart(1));
    run.take(arrives(Delivery::Late));
    assert!(run.is_offering());
}

#[test]
fn a_monotone_channel_delivers_after_a_reboot_and_again() {
    let mut run = Run::of(reboot(true));
    run.take(detect).take(arrives(Delivery::AnyTime));
    assert!(run.is_offering());
    run.take(|action| *action == Action::Crash(1));
    assert_eq!(run.next(arrives(Delivery::AnyTime)), None);
    run.take(|action| *action == Action::Restart(1));
    run.take(arrives(Delivery::AnyTime));
    assert!(run.is_offering());
}

#[test]
fn a_robot_that_hangs_does_and_hears_nothing_until_it_goes_on() {
    let mut scenario = without_size(include_str!("../scenarios/pair-hang.toml"));
    scenario.bounds.hangs = 2;
    let mut run = Run::of(scenario);
    let hang = |i| move |action: &Action| *action == Action::Hang(i);
    let resume = |i| move |action: &Action| *action == Action::Resume(i);
    run.take(hang(1)).take(detect);
    assert_eq!(run.next(arrives(Delivery::AtOnce)), None);
    run.take(delay);
    assert_eq!(run.next(arrives(Delivery::Late)), None);
    // It hangs once more, with a part in a session.
    run.take(resume(1)).take(arrives(Delivery::Late));
    run.take(lose);
    assert!(run.is_offering());
    run.take(hang(1));
    assert!(run.state.hangs(1) && run.is_offering(), "its state stays");
    let expire = |i| move |action: &Action| matches!(action, Action::Expire(it, _) if *it == i);
    assert_eq!(run.next(expire(1)), None);
    assert!(run.next(expire(0)).is_some());
    run.take(resume(1));
    assert!(run.next(expire(1)).is_some());
    assert_eq!(run.next(hang(1)), None, "the bound is used up");
}

#[test]
fn each_robot_asks_with_its_own_urgency() {
    use crossguard_protocol::Urgency::{High, Low, Medium};
    let scenario = Scenario::load("contention-urgency").unwrap();
    let urgency = [0, 1, 2].map(|place| scenario.request_of(place).urgency);
    assert_eq!(urgency, [Low, High, Medium]);
}
