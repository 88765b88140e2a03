//! The laws of response times: they hold along runs of the protocol, and each is broken by a protocol that lets somebody
//! wait for longer, although all its states are valid.

use std::panic::{AssertUnwindSafe, catch_unwind};

use super::runs::{Entry, Run};
use crossguard_model_check::node::{Protocol, Rules};
use crossguard_model_check::scenario::Scenario;
use crossguard_protocol::laws::taken::Taken;
use crossguard_protocol::laws::watch::Watch;
use crossguard_protocol::laws::{budgets, lease};
use crossguard_protocol::*;
use crossguard_testkit::rules::with_state;

type Law = fn(&Config, &Taken);

crossguard_testkit::weakenings! {
    /// A requester waits all of `T_help` from each offer on.
    BeginsItsRequestAnew(robot, config, input) {
        let offers = |robot: &Robot| match robot.phase() {
            Phase::Requesting(requesting) => requesting.offers.len(),
            _ => 0,
        };
        let before = offers(robot);
        let outputs = robot.step(config, input);
        if offers(robot) > before.max(1) {
            with_state(robot, |state| {
                state["phase"]["requesting"]["help"] = config.settings().t_help.0.into();
            });
        }
        outputs
    }

    /// A leader does not count how often it repeats a command.
    RepeatsForEver(robot, config, input) {
        let outputs = robot.step(config, input);
        if matches!(input, Input::Expired(_) | Input::Elapsed(_))
            && matches!(robot.phase(), Phase::Leading(_))
        {
            with_state(robot, |state| {
                let members = state["phase"]["leading"]["members"].as_array_mut();
                for member in members.unwrap() {
                    if !member["outstanding"].is_null() {
                        member["outstanding"]["repeats"] = 0.into();
                    }
                }
            });
        }
        outputs
    }

    /// A follower without contact stays for as long as it hears anything.
    StaysWhereItHears(robot, config, input) {
        let outputs = robot.step(config, input);
        if let (Input::Ram { .. }, Phase::Following(following)) = (input, robot.phase())
            && matches!(following.contact, Contact::Lost(_))
        {
            with_state(robot, |state| {
                state["phase"]["following"]["contact"]["lost"] = config.settings().t_leave.0.into();
            });
        }
        outputs
    }

    /// A leader waits anew for a follower without a lease with each RAM that it hears.
    WaitsForTheLost(robot, config, input) {
        let outputs = robot.step(config, input);
        if matches!(input, Input::Ram { .. }) && matches!(robot.phase(), Phase::Leading(_)) {
            with_state(robot, |state| {
                let members = state["phase"]["leading"]["members"].as_array_mut();
                for member in members.unwrap() {
                    if member["lease"]["expired"].is_number() {
                        member["lease"]["expired"] = config.t_lost().0.into();
                    }
                }
            });
        }
        outputs
    }

    /// A leader waits for a whole period from what it hears on, so that a heartbeat seems to be younger than it is.
    BeatsWhenItHears(robot, config, input) {
        let outputs = robot.step(config, input);
        if matches!(input, Input::Ram { .. }) && matches!(robot.phase(), Phase::Leading(_)) {
            with_state(robot, |state| {
                state["ram"] = config.settings().ram_period.0.into();
            });
        }
        outputs
    }
}

/// Judges runs of a scenario; how many steps there were.
fn hold(scenario: &str, rules: &dyn Rules, laws: &[Law], seeds: std::ops::Range<u8>) -> usize {
    let scenario = Scenario::load(scenario).unwrap();
    let mut steps = 0;
    for seed in seeds {
        for entry in Run::drawn(&scenario, rules, seed).entries {
            let Entry::Step {
                before,
                input,
                after,
                ..
            } = entry
            else {
                continue;
            };
            let said = Watch::new(&before, &input);
            let step = Taken {
                before,
                input,
                said,
                after,
            };
            for law in laws {
                law(&scenario.config, &step);
            }
            steps += 1;
        }
    }
    steps
}

#[rustfmt::skip]
const LAWS: [(&str, Law, &str, &dyn Rules); 5] = [
    ("L1", budgets::a_request_gets_no_more_time, "trio", &BeginsItsRequestAnew),
    ("L2", budgets::a_command_gets_no_more_time, "pair", &RepeatsForEver),
    ("L4, L5", budgets::a_lost_leader_gets_no_more_time, "pair", &StaysWhereItHears),
    ("L5", budgets::a_silent_follower_gets_no_more_time, "pair", &WaitsForTheLost),
    ("I10", |_, step| lease::heartbeats_count_time_alone(step), "pair", &BeatsWhenItHears),
];

#[test]
fn nobody_gets_more_time_in_runs_of_every_scenario() {
    let laws = LAWS.map(|(_, law, ..)| law);
    let mut steps = 0;
    for name in Scenario::quick() {
        if Scenario::load(name).unwrap().timed.is_none() {
            steps += hold(name, &Protocol, &laws, 0..40);
        }
    }
    println!("{steps} steps");
}

#[test]
fn each_law_is_broken_by_who_waits_for_longer() {
    for (property, law, scenario, rules) in LAWS {
        let breaks = (0..u8::MAX).any(|seed| {
            let run = || hold(scenario, rules, &[law], seed..seed + 1);
            catch_unwind(AssertUnwindSafe(run)).is_err()
        });
        assert!(breaks, "{property}, in {scenario}");
    }
}
