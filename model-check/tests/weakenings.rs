//! Each rule is needed: a transition function without it breaks the property that the rule is
//! there to keep.

use crossguard_model_check::check::{Options, Stop, check};
use crossguard_model_check::model::Model;
use crossguard_model_check::node::Rules;
use crossguard_model_check::properties::PropertyId::{self, *};
use crossguard_model_check::replay::Replay;
use crossguard_model_check::report::{CheckVerdict, CutOff};
use crossguard_model_check::scenario::Scenario;
use crossguard_protocol::*;
use crossguard_testkit::rules::*;

/// A scenario, which claims one property alone where that stands behind its name.
fn load(name: &str) -> Scenario {
    let Some((name, claimed)) = name.split_once(": ") else {
        return Scenario::load(name).unwrap();
    };
    let mut scenario = Scenario::load(name).unwrap();
    (scenario.properties, scenario.expected) = (vec![claimed.parse().unwrap()], None);
    scenario
}

/// Asserts that these properties break in a scenario when `rules` takes the place of the protocol.
fn assert_breaks(scenario: &str, rules: impl Rules + 'static, properties: &[PropertyId]) {
    let scenario = load(scenario);
    let model = Model::with_rules(scenario, rules);
    let options = Options {
        until_broken: properties.to_vec(),
        second_opinion: true,
        ..Options::default()
    };
    let report = check(&model, &options, &mut |_| ());
    for id in properties {
        let mut found = report.properties.iter();
        let property = found.find(|it| it.id == id.name()).unwrap();
        assert_eq!(property.verdict, CheckVerdict::Violated, "{property:#?}");
        let is_shown = !property.counterexample.is_empty();
        assert!(is_shown, "{id} without a counterexample");
    }
}

/// Asserts that these properties, and no others, break in a scenario without delayed messages when
/// `rules` takes the place of the protocol.
fn assert_breaks_alone(scenario: &str, rules: impl Rules + 'static, properties: &[PropertyId]) {
    assert_breaks_alone_in(Scenario::load(scenario).unwrap(), rules, properties);
}

fn assert_breaks_alone_in(
    mut scenario: Scenario,
    rules: impl Rules + 'static,
    properties: &[PropertyId],
) {
    scenario.channel.delayed = 0;
    scenario.expected = None;
    let model = Model::with_rules(scenario, rules);
    let report = check(&model, &Options::default(), &mut |_| ());
    let violated: Vec<_> = report.violated().collect();
    let expected: Vec<_> = properties.iter().map(ToString::to_string).collect();
    assert_eq!(violated, expected);
    for property in &report.properties {
        // The protocol does not have the run that breaks the property without the rule.
        if let Some(replay) = Replay::of(&report, property) {
            let protocol = Model::new(model.scenario().clone());
            assert!(replay.is_broken_in(&model), "{replay:#?}");
            assert!(!replay.is_broken_in(&protocol), "{replay:#?}");
        }
        let is_run_without_end = property.kind == "L" && property.id != "L7";
        if property.verdict == CheckVerdict::Violated && is_run_without_end {
            assert!(property.repeats_after.unwrap() <= property.counterexample.len());
        }
    }
}

/// A test for each row: a scenario, a weakening, and the properties that it breaks there, alone or among others.
macro_rules! weakenings {
    ($($(#[$attribute:meta])* fn $name:ident($scenario:literal, $rules:expr, [$($id:ident),*] $($alone:ident)?);)*) => {
        $($(#[$attribute])* fn $name() {
            weakenings!(@ $($alone)? ($scenario, $rules, &[$($id),*]));
        })*

        /// The weakenings, each with what it breaks.
        pub(crate) const BREAKS: &[(&str, &[PropertyId])] = &[$((stringify!($rules), &[$($id),*])),*];
    };
    (@ alone $row:tt) => { assert_breaks_alone $row };
    (@ $row:tt) => { assert_breaks $row };
}

weakenings! {
    #[test]
    fn without_offer_numbers_a_rebooted_follower_is_drawn_back("pair-reboot", ConfirmsByStationAlone, [I2, I15]);
    #[test]
    fn without_confirmation_a_robot_follows_a_leader_that_did_not_take_it("pair", NeedsNoConfirmation, [I2] alone);
    #[test]
    fn without_sessions_a_stale_command_is_executed("pair-reboot", ObeysCommandsOfAnySession, [I3]);
    #[test]
    fn without_memory_of_requests_a_command_is_executed_twice_and_after_fallback("pair", StartsRepeatedCommands, [I4, I9]);
    #[test]
    fn without_the_order_of_requests_an_older_command_is_executed("pair", StartsOlderCommands, [I5]);
    #[test]
    fn without_request_numbers_a_late_acknowledgement_counts_for_a_newer_command("pair", TakesAnyAcknowledgement, [I6, I7]);
    #[test]
    fn without_request_numbers_in_ram_a_stale_one_completes_a_newer_command("pair", TakesAnyProgress, [I8]);
    // A person who steps on the road then does so unguarded, or sees the guards leave.
    #[test]
    fn a_corridor_that_is_not_closed_stays_open_over_nobody("pair", NEVER_CLOSES_THE_CORRIDOR, [I11, W1, W2] alone);
    // A maneuver that runs then was accepted for another session, if at all.
    #[test]
    fn a_released_robot_that_is_not_stopped_goes_on("pair", NEVER_STOPS, [I6, I14] alone);
    #[test]
    fn an_identity_that_is_not_locked_may_change_in_a_session("offer-race", NEVER_LOCKS_ITS_IDENTITY, [I18] alone);
    #[test]
    fn a_pseudonym_that_is_in_use_makes_a_robot_follow_itself("pair", TakesItsLeadersPseudonym, [I1, I2, I6, I13] alone);
    #[test]
    fn a_follower_that_goes_must_not_touch_the_others("trio", LosesTwoForOne, [I17] alone);
    #[test]
    fn without_timers_a_follower_of_a_crashed_leader_is_stuck("leader-crash", FollowersWaitForEver, [I12, L4, L5, L7] alone);
    // Endless repetition is no progress.
    #[test]
    fn without_a_limit_a_request_that_nobody_hears_never_ends("pair", ASKS_FOR_EVER, [I12, L1] alone);
    #[test]
    fn without_repeats_a_lost_command_stays_outstanding("pair", NEVER_REPEATS, [L2] alone);
    #[test]
    fn two_requesters_that_do_not_yield_wait_for_ever("offer-race", InsistsOnItsRequest, [I12, L1, L6] alone);
    #[test]
    fn without_progress_in_ram_no_task_is_ever_completed("stable", ReadsNoProgress, [L3, L7] alone);
    #[test]
    fn one_repeat_too_many_is_noticed_and_is_no_valid_state("pair", RepeatsOnceTooOften, [I13, I16] alone);
    // To start it again is also not to start a newer one.
    #[test]
    fn a_command_that_is_started_again_while_it_runs_is_started_twice("blocker", StartsRepeatedWhileRunning, [I4, I5] alone);
    #[test]
    fn silence_that_is_taken_for_an_acknowledgement_is_none("pair", TakesSilenceForAnAnswer, [I6] alone);
    #[test]
    fn a_leader_without_timers_waits_for_its_application("offer-race", LeadsWithoutTimers, [I12, L6] alone);
    #[test]
    fn a_state_that_no_message_can_tell_is_no_valid_state("pair", ReportsTheLeadersLimit, [I13] alone);
    #[test]
    fn a_follower_that_starts_before_it_acknowledges_is_noticed("bilateral", StartsBeforeItAcknowledges, [I6] alone);
    // Its records are those of the followers that it asked for, and all of them are engaged.
    #[test]
    fn a_leader_that_asks_for_too_few_lets_people_cross_unguarded("trio-corridor", AsksForFewer, [W1] alone);
    #[test]
    fn a_guard_that_stops_where_it_is_leaves_people_on_the_road_alone("bilateral", StopsInPlace, [W2] alone);
    #[test]
    fn a_guard_that_trusts_its_leader_alone_leaves_a_person_that_it_sees("own-sight", TrustsItsLeaderAlone, [W2] alone);
    #[test]
    fn a_leader_that_reads_no_loss_lets_people_cross_where_no_guard_stands("drift", ReadsNoLoss, [W1] alone);
    #[test]
    fn a_leader_that_believes_late_ram_lets_people_cross_where_a_guard_stood("drift", BelievesOldPositions, [W1]);
    #[test]
    fn a_leader_that_hears_no_other_goes_on_showing_go("two-teams", HearsNoLeader, [W3] alone);
    #[test]
    fn a_robot_that_forgets_its_duty_begins_something_new("bilateral", ForgetsItsDuty, [W4] alone);
    // No robot is ever idle again, for one that cooperates waits for the crossing.
    #[test]
    fn without_positions_in_ram_nobody_ever_crosses("crossing", ReadsNoProgress, [L7, W7] alone);
    #[test]
    fn an_insider_moves_a_robot_that_obeys_commands_of_any_session("lying-bystander", ObeysCommandsOfAnySession, [C1]);
    // C3 is broken first, and nothing is explored beyond that.
    #[test]
    fn a_follower_that_lies_speaks_for_the_others_where_one_counts_for_all("lying-follower: C2", CountsOneForAll, [C2]);
    #[test]
    fn a_corridor_rests_on_a_stranger_where_who_says_so_follows("lying-bystander", AdmitsWhoSaysThatItFollows, [C3]);
}

/// stateright goes a run again in order to tell it, also where it was told to stop.
#[test]
fn a_second_opinion_that_is_stopped_tells_what_it_has_found() {
    let model = Model::with_rules(Scenario::load("pair").unwrap(), StartsRepeatedCommands);
    let stop = Stop::default();
    let options = Options {
        stop: stop.clone(),
        second_opinion: true,
        ..Options::default()
    };
    let report = check(&model, &options, &mut |reached| {
        if reached.checked > 200_000 {
            stop.request();
        }
    });
    assert_eq!(report.cut_off, Some(CutOff::Stopped));
    assert_eq!(report.verdict("I4"), Some(CheckVerdict::Violated));
}

/// With a corridor, who is commanded away leaves people on the road alone as well.
#[test]
fn a_follower_that_obeys_on_duty_begins_something_new() {
    let mut scenario = Scenario::load("blocker").unwrap();
    scenario.corridor = false;
    assert_breaks_alone_in(scenario, ObeysOnDuty, &[W4]);
}

/// Timers of these kinds never expire in robots of that kind.
struct WaitsForEver {
    who: fn(&Phase) -> bool,
    timer: fn(&Timer) -> bool,
}

impl Rules for WaitsForEver {
    fn step(&self, robot: &mut Robot, config: &Config, input: Input) -> Outputs {
        if let Input::Expired(timer) = input
            && (self.who)(robot.phase())
            && (self.timer)(&timer)
        {
            return only(Output::Ignored(Ignored::TimerNotArmed));
        }
        robot.step(config, input)
    }
}

/// A request has no limit.
const ASKS_FOR_EVER: WaitsForEver = WaitsForEver {
    who: |phase| matches!(phase, Phase::Requesting(_)),
    timer: |timer| matches!(timer, Timer::Help | Timer::IdentityLock),
};

/// A command is not repeated. The identity lock of either robot would end the session, and with it the command.
const NEVER_REPEATS: WaitsForEver = WaitsForEver {
    who: |phase| matches!(phase, Phase::Leading(_) | Phase::Following(_)),
    timer: |timer| matches!(timer, Timer::Acknowledgement(_) | Timer::IdentityLock),
};

crossguard_testkit::weakenings! {
    /// A command that is repeated while it is executed is started once more.
    StartsRepeatedWhileRunning(robot, config, input) {
        let running = match robot.phase() {
            Phase::Following(following) => following.executing(),
            _ => None,
        };
        let outputs = robot.step(config, input);
        match (input, running) {
            (Input::Rmcm(Rmcm::Command(command)), Some(running))
                if running.id.request == command.request
                    && running.id.session == command.session =>
            {
                let start = Output::StartManeuver(running);
                outputs.iter().copied().chain([start]).collect()
            }
            _ => outputs,
        }
    }

    /// After the last repetition, silence is taken for an acknowledgement.
    TakesSilenceForAnAnswer(robot, config, input) {
        if let (Phase::Leading(leading), Input::Expired(Timer::Acknowledgement(from))) =
            (robot.phase(), input)
            && let Some(outstanding) = leading.member(from).and_then(|m| m.outstanding)
            && outstanding.repeats == config.settings().n_ack
        {
            let answer = Answer {
                from,
                session: robot.session().unwrap(),
                request: outstanding.request,
                verdict: crossguard_protocol::Verdict::Accepted,
            };
            return robot.step(config, Input::Rmcm(Rmcm::Answer(answer)));
        }
        robot.step(config, input)
    }

    /// A leader with nothing outstanding has no timers.
    LeadsWithoutTimers(robot, config, input) {
        if let (Phase::Leading(leading), Input::Expired(_)) = (robot.phase(), input)
            && leading.members.iter().all(|m| m.outstanding.is_none())
        {
            return only(Output::Ignored(Ignored::TimerNotArmed));
        }
        robot.step(config, input)
    }

    /// A follower that fails reports what only its leader can know.
    ReportsTheLeadersLimit(robot, config, input) {
        let outputs = robot.step(config, input);
        let has_failed = match robot.phase() {
            Phase::Following(following) => following
                .job
                .is_some_and(|job| matches!(job.progress, Progress::Failed(_))),
            _ => false,
        };
        if has_failed && matches!(input, Input::Local(Event::ManeuverFailed(_))) {
            let failed = Progress::Failed(Failure::ExecutionLimit);
            with_state(robot, |state| {
                state["phase"]["following"]["job"]["progress"] = serde_json::to_value(failed).unwrap();
            });
        }
        outputs
    }
}

#[test]
fn each_check_of_an_open_corridor_is_missed() {
    for (i, check) in CHECKS_OF_AN_OPEN_CORRIDOR.into_iter().enumerate() {
        // With two tasks, one of which does not guard.
        let scenario = if i == 0 { "trio-corridor" } else { "blocker" };
        assert_breaks(scenario, Overlooks(check), &[I11]);
    }
}

/// Each guard counts, and not the first two alone.
#[test]
fn the_third_guard_is_missed() {
    let overlooks_third =
        Overlooks(|why| matches!(why, CorridorClosure::NotEngaged(StationId(4), _)));
    assert_breaks("corridor-of-four", overlooks_third, &[I11]);
}
