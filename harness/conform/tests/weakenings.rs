//! What the verdicts are good for: a robot without a rule fails that rule, or the table says why nobody can see it.

use crossguard_codec::geonet::Envelope;
use crossguard_conform::Terms;
use crossguard_conform::campaign::{Campaign, Verdict};
use crossguard_conform::case::Table;
use crossguard_conform::in_process::InProcess;
use crossguard_conform::rules::Rule;
use crossguard_conform::subject::Subject as _;
use crossguard_model_check::node::{Protocol, Rules};
use crossguard_protocol::*;
use crossguard_testkit::rules::*;

/// A robot under rules.
#[derive(Debug)]
struct Ruled {
    robot: Robot,
    rules: &'static dyn Rules,
}

impl StateMachine for Ruled {
    fn robot(&self) -> &Robot {
        &self.robot
    }

    fn step(&mut self, config: &Config, input: Input) -> Outputs {
        self.rules.step(&mut self.robot, config, input)
    }
}

/// The rules that a robot under `rules` breaks, with all cases or those about one rule.
fn broken(rules: &'static dyn Rules, about: &[&'static str]) -> Vec<&'static str> {
    let asked: Vec<&'static Rule> = if about.is_empty() {
        Campaign::all_rules().collect()
    } else {
        about.iter().filter_map(|id| Rule::of_id(id)).collect()
    };
    let mut campaign = Campaign::new(&asked);
    let robot = StationId(1);
    let boots = move |station, boot| Ruled {
        robot: Robot::new(station, boot),
        rules,
    };
    let mut subject = InProcess::new(robot, Config::default(), boots);
    let mut table = Table {
        robot,
        terms: Terms {
            slack_ms: 100,
            ..Terms::default()
        },
        envelopes: [Envelope::Off, Envelope::Off],
        boot: 0,
    };
    for case in campaign.cases() {
        subject.restart().unwrap();
        campaign.play(&mut subject, &mut table, &case).unwrap();
    }
    let report = campaign.report(robot);
    for rule in &report.rules {
        for broken in &rule.broken {
            println!(
                "{} {} [{}]: {}",
                rule.rule, broken.statement, broken.situation, broken.how
            );
        }
    }
    let failed = report
        .rules
        .iter()
        .filter(|rule| rule.verdict == Verdict::Fail);
    failed.map(|rule| rule.rule).collect()
}

/// Asserts that the verdict on this rule is the one that names the weakening.
fn assert_named(rule: &'static str, rules: &'static dyn Rules) {
    assert_eq!(broken(rules, &[rule]), [rule]);
}

/// Asserts that no verdict tells a robot under these rules from one of the kit.
fn assert_unseen(rules: &'static dyn Rules, why: &str) {
    assert_eq!(broken(rules, &[]), Vec::<&str>::new(), "it was: {why}");
}

#[test]
fn the_kits_own_robot_keeps_every_rule_that_can_be_judged() {
    assert_eq!(broken(&Protocol, &[]), Vec::<&str>::new());
}

#[test]
fn a_confirmation_of_another_offer_that_counts_is_named() {
    assert_named("R2", &ConfirmsByStationAlone);
}

#[test]
fn a_role_without_confirmation_is_named() {
    assert_named("R2", &NeedsNoConfirmation);
}

#[test]
fn a_command_of_another_session_that_is_obeyed_is_named() {
    assert_named("R1", &ObeysCommandsOfAnySession);
}

#[test]
fn a_repeated_command_that_is_started_again_is_named() {
    assert_named("R8", &StartsRepeatedCommands);
}

#[test]
fn an_older_command_that_is_started_is_named() {
    assert_named("R8", &StartsOlderCommands);
}

#[test]
fn progress_that_is_not_read_is_named() {
    assert_named("R11", &ReadsNoProgress);
}

#[test]
fn a_released_robot_that_goes_on_is_named() {
    assert_named("R19", &NEVER_STOPS);
}

#[test]
fn followers_that_wait_for_ever_are_named() {
    assert_named("R12", &FollowersWaitForEver);
    assert_named("R14", &FollowersWaitForEver);
}

#[test]
fn one_repetition_too_many_is_named() {
    assert_named("R10", &RepeatsOnceTooOften);
}

#[test]
fn a_request_for_too_few_is_named() {
    assert_named("R4", &AsksForFewer);
}

#[test]
fn a_leader_that_hears_no_other_is_named() {
    assert_named("R6", &HearsNoLeader);
}

/// Settings that take the place of the robot's own.
struct With(fn(&mut Settings));

impl Rules for With {
    fn step(&self, robot: &mut Robot, config: &Config, input: Input) -> Outputs {
        let mut settings = config.settings().clone();
        (self.0)(&mut settings);
        robot.step(&Config::new(settings).unwrap(), input)
    }
}

#[test]
fn a_request_that_stands_too_long_is_named() {
    assert_named("R5", &With(|settings| settings.t_help = Millis(60_000)));
}

#[test]
fn commands_that_are_not_repeated_are_named() {
    assert_named("R10", &With(|settings| settings.t_ack = Millis(60_000)));
}

/// A follower waits for a quarter of the `t_safety` that it told.
struct WaitsAQuarter;

impl Rules for WaitsAQuarter {
    fn step(&self, robot: &mut Robot, config: &Config, input: Input) -> Outputs {
        let hears = matches!(input, Input::Ram { .. } | Input::Rmcm(_));
        if !hears || !matches!(robot.phase(), Phase::Following(_)) {
            return robot.step(config, input);
        }
        let settings = Settings {
            t_safety: Millis(500),
            t_lease: Millis(400),
            ..config.settings().clone()
        };
        robot.step(&Config::new(settings).unwrap(), input)
    }
}

#[test]
fn a_follower_that_waits_less_than_it_promised_is_named() {
    assert_named("R12", &WaitsAQuarter);
}

/// A requester does not listen to other requesters.
struct InsistsOnItsRequest;

impl Rules for InsistsOnItsRequest {
    fn step(&self, robot: &mut Robot, config: &Config, input: Input) -> Outputs {
        if let (Phase::Requesting(_), Input::Ram { ram, .. }) = (robot.phase(), input)
            && matches!(ram.coordination, Coordination::NeedHelp { .. })
        {
            return [Output::Ignored(Ignored::LowerPrecedence)]
                .into_iter()
                .collect();
        }
        robot.step(config, input)
    }
}

#[test]
fn a_requester_that_does_not_give_way_is_named() {
    assert_named("R6", &InsistsOnItsRequest);
}

/// A robot in a session sends a RAM for each that it hears.
struct AnswersEveryRam;

impl Rules for AnswersEveryRam {
    fn step(&self, robot: &mut Robot, config: &Config, input: Input) -> Outputs {
        let outputs = robot.step(config, input);
        if !matches!(input, Input::Ram { .. }) || robot.session().is_none() {
            return outputs;
        }
        let effects = outputs.iter().copied();
        let effects =
            effects.filter(|output| !matches!(output, Output::Ignored(_) | Output::SendRam));
        effects.chain([Output::SendRam]).collect()
    }
}

#[test]
fn a_robot_that_answers_every_ram_is_named() {
    assert_named("R26", &AnswersEveryRam);
}

#[test]
fn what_the_air_does_not_tell_is_seen_by_nobody() {
    let unseen: [(&'static dyn Rules, &str); 5] = [
        (
            &StartsBeforeItAcknowledges,
            "acknowledgement and report leave in one order, whenever the body starts",
        ),
        (
            &StopsInPlace,
            "a robot's policy is its own setting; the air tells that it falls back, not how",
        ),
        (
            &LosesTwoForOne,
            "the next echo renews the lease that was lost",
        ),
        (
            &NEVER_LOCKS_ITS_IDENTITY,
            "nothing that is sent or told makes a robot change its pseudonym",
        ),
        (
            &TakesItsLeadersPseudonym,
            "nothing that is sent or told makes a robot change its pseudonym",
        ),
    ];
    for (rules, why) in unseen {
        assert_unseen(rules, why);
    }
}
