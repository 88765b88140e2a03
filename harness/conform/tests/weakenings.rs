//! Verdicts on weakened robots: a robot without a rule fails that rule, or the table says why nobody can see it.

use std::collections::BTreeSet;

use crossguard_conform::campaign::{Campaign, Verdict};
use crossguard_conform::rules::{RULES, Rule};
use crossguard_conform::subject::Subject as _;
use crossguard_judge::sim::Ruled;
use crossguard_model_check::node::{Protocol, Rules};
use crossguard_protocol::*;
use crossguard_testkit::rules::*;
use crossguard_testkit::weakenings;

mod in_process;
use in_process::{InProcess, table};

/// The rules that a robot under `rules` breaks, with all cases or those about one rule.
fn broken(rules: &'static dyn Rules, about: &[&'static str]) -> Vec<&'static str> {
    let asked: Vec<&'static Rule> = if about.is_empty() {
        RULES.iter().collect()
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
    let mut table = table(robot);
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

#[test]
fn the_kits_own_robot_keeps_every_rule_that_can_be_judged() {
    assert_eq!(broken(&Protocol, &[]), Vec::<&str>::new());
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

weakenings! {
    /// A follower waits for a quarter of the `t_safety` that it told.
    WaitsAQuarter(robot, config, input) {
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

    /// A follower that fell back reports that it executes when its command is repeated.
    RunsAgainAfterItsFallback(robot, config, input) {
        let outputs = robot.step(config, input);
        if let (Phase::Following(following), Input::Rmcm(Rmcm::Command(command))) =
            (robot.phase(), input)
            && let Some(job) = following.job
            && (job.request, job.progress) == (command.request, Progress::SafeIdle)
        {
            let progress = serde_json::to_value(Progress::Executing).unwrap();
            with_state(robot, |state| {
                state["phase"]["following"]["job"]["progress"] = progress;
            });
        }
        outputs
    }

    /// A leader commands its guards although people may be on the road.
    CommandsItsGuardsAway(robot, config, input) {
        let corridor = |robot: &mut Robot, it: Corridor| {
            with_state(robot, |state| {
                state["phase"]["leading"]["corridor"] = serde_json::to_value(it).unwrap();
            });
        };
        let before = match (robot.phase(), input) {
            (Phase::Leading(leading), Input::Local(Event::CommandManeuver { .. })) => {
                leading.corridor
            }
            _ => return robot.step(config, input),
        };
        corridor(robot, Corridor::Clear);
        let outputs = robot.step(config, input);
        corridor(robot, before);
        outputs
    }

    /// A leader that loses one follower lists none any more.
    LosesAllForOne(robot, config, input) {
        let outputs = robot.step(config, input);
        let mut notices = outputs.notices();
        let one_is_gone = notices.any(|notice| matches!(notice, Notice::FollowerGone(..)));
        if one_is_gone && matches!(robot.phase(), Phase::Leading(_)) {
            with_state(robot, |state| {
                state["phase"]["leading"]["members"] = serde_json::json!([]);
            });
        }
        outputs
    }
}

/// The robot has forgotten a part of its state after every step.
struct Forgets(&'static str);

impl Rules for Forgets {
    fn step(&self, robot: &mut Robot, config: &Config, input: Input) -> Outputs {
        let outputs = robot.step(config, input);
        with_state(robot, |state| state[self.0] = serde_json::Value::Null);
        outputs
    }
}

/// The robot does not hear of some of what happens at it.
struct IsNotTold(fn(&Event) -> bool);

impl Rules for IsNotTold {
    fn step(&self, robot: &mut Robot, config: &Config, input: Input) -> Outputs {
        match input {
            Input::Local(event) if (self.0)(&event) => {
                only(Output::Ignored(Ignored::LowerPrecedence))
            }
            input => robot.step(config, input),
        }
    }
}

/// A leader with other settings, as soon as it leads.
struct WhileItLeads(fn(&mut Settings));

impl Rules for WhileItLeads {
    fn step(&self, robot: &mut Robot, config: &Config, input: Input) -> Outputs {
        if !matches!(robot.phase(), Phase::Leading(_)) {
            return robot.step(config, input);
        }
        With(self.0).step(robot, config, input)
    }
}

/// A leader overlooks some of what stands in the way of an open corridor, and shows go for long enough to be seen.
struct Opens(fn(CorridorClosure) -> bool);

impl Rules for Opens {
    fn step(&self, robot: &mut Robot, config: &Config, input: Input) -> Outputs {
        let outputs = Overlooks(self.0).step(robot, config, input);
        let seen = |output: &Output| match *output {
            Output::CorridorOpened(_) => Output::CorridorOpened(Millis(1_000)),
            output => output,
        };
        outputs.iter().map(seen).collect()
    }
}

/// Acknowledgements and rejections are not sent.
const ANSWERS_NOTHING: Drops = Drops(|output| matches!(output, Output::SendRmcm(Rmcm::Answer(_))));

/// A rule, a weakening of it, and the words for that.
type Weakening = (&'static str, &'static dyn Rules, &'static str);

/// A table of weakenings, each with the rule whose verdict names it.
macro_rules! named {
    ($($rule:literal: $rules:expr;)*) => {
        vec![$(($rule, &$rules, stringify!($rules))),*]
    };
}

/// Weakenings that the verdict on the rule names.
fn named() -> Vec<Weakening> {
    named! {
        "R1": ObeysCommandsOfAnySession;
        "R2": ConfirmsByStationAlone;
        "R2": NeedsNoConfirmation;
        "R3": With(|it| it.t_offer = it.t_help);
        "R4": AsksForFewer;
        "R4": AdmitsWhoSaysThatItFollows;
        "R5": With(|it| it.t_help = Millis(60_000));
        "R6": HearsNoLeader;
        "R6": InsistsOnItsRequest;
        "R7": ANSWERS_NOTHING;
        "R8": StartsRepeatedCommands;
        "R8": StartsOlderCommands;
        "R9": TakesAnyAcknowledgement;
        "R10": RepeatsOnceTooOften;
        "R10": With(|it| it.t_ack = Millis(60_000));
        "R11": ReadsNoProgress;
        "R11": TakesAnyProgress;
        "R12": FollowersWaitForEver;
        "R12": WaitsAQuarter;
        "R13": With(|it| it.t_leave = Millis(60_000));
        "R14": FollowersWaitForEver;
        "R14": With(|it| it.t_leave = Millis(60_000));
        "R15": RunsAgainAfterItsFallback;
        "R16": Opens(|_| true);
        "R16": NEVER_CLOSES_THE_CORRIDOR;
        "R17": WhileItLeads(|it| (it.t_safety, it.t_lease) = (Millis(60_000), Millis(50_000)));
        "R18": CommandsItsGuardsAway;
        "R19": NEVER_STOPS;
        "R19": IsNotTold(|it| matches!(it, Event::TaskCompleted));
        "R20": ForgetsItsDuty;
        "R21": Forgets("farewell");
        "R21": With(|it| it.t_farewell = Millis(300));
        "R22": LosesAllForOne;
        "R24": IsNotTold(|it| matches!(it, Event::AvailabilityChanged(_)));
        "R26": AnswersEveryRam;
    }
}

#[test]
fn a_robot_without_a_rule_fails_its_verdict() {
    let missed: Vec<_> = named()
        .into_iter()
        .filter(|(rule, rules, _)| broken(*rules, &[rule]) != [*rule])
        .map(|(rule, _, what)| format!("{rule}: {what}"))
        .collect();
    assert_eq!(missed, Vec::<String>::new());
}

/// Each check that stands before an open corridor, left out alone.
#[test]
fn each_check_of_an_open_corridor_is_missed() {
    for (i, check) in CHECKS_OF_AN_OPEN_CORRIDOR.into_iter().enumerate() {
        let rules = Box::leak(Box::new(Opens(check)));
        assert_eq!(broken(rules, &["R16"]), ["R16"], "check {i}");
    }
}

#[test]
fn every_verdict_has_been_tried_on_a_robot_that_breaks_its_rule() {
    let tried: BTreeSet<_> = named().into_iter().map(|(rule, ..)| rule).collect();
    for rule in RULES {
        assert_ne!(rule.is_beyond(), tried.contains(rule.id), "{}", rule.id);
    }
}

#[test]
fn what_the_air_does_not_tell_is_seen_by_nobody() {
    let order = "acknowledgement and report leave in one order, whenever the body starts";
    let policy = "a robot's policy is its own setting; the air tells that it falls back, not how";
    let lease = "the next echo renews the lease that was lost";
    let identity = "nothing that is sent or told makes a robot change its pseudonym";
    let unseen: [(&'static dyn Rules, &str); 5] = [
        (&StartsBeforeItAcknowledges, order),
        (&StopsInPlace, policy),
        (&LosesTwoForOne, lease),
        (&NEVER_LOCKS_ITS_IDENTITY, identity),
        (&TakesItsLeadersPseudonym, identity),
    ];
    for (rules, why) in unseen {
        assert_eq!(broken(rules, &[]), Vec::<&str>::new(), "it was: {why}");
    }
}
