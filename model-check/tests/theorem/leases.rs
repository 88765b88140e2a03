//! Protocols whose leases do not rest on what their followers do, although each state is valid.

use crossguard_model_check::node::Rules;
use crossguard_protocol::*;
use crossguard_testkit::rules::with_state;

/// Changes the records of a leader that has heard a follower.
fn after_an_echo(
    robot: &mut Robot,
    config: &Config,
    input: Input,
    change: impl Fn(&mut serde_json::Value, &serde_json::Value),
) -> Outputs {
    let outputs = robot.step(config, input);
    let is_echo = matches!(input, Input::Ram { ram, .. }
        if matches!(ram.coordination, Coordination::Follower { .. }));
    if is_echo && matches!(robot.phase(), Phase::Leading(_)) {
        with_state(robot, |state| {
            let leading = &mut state["phase"]["leading"];
            let newest = leading["heartbeat"].clone();
            for member in leading["members"].as_array_mut().unwrap() {
                if !member["echoed"].is_null() {
                    change(member, &newest);
                }
            }
        });
    }
    outputs
}

crossguard_testkit::weakenings! {
    /// A leader takes each RAM of a follower for an echo of its newest heartbeat.
    pub(crate) CountsWhatWasNotEchoed(robot, config, input) {
        after_an_echo(robot, config, input, |member, newest| {
            member["echoed"] = newest.clone();
        })
    }

    /// A lease counts from the arrival of an echo.
    pub(crate) CountsFromTheArrival(robot, config, input) {
        after_an_echo(robot, config, input, |member, _| {
            if member["lease"]["stands"].is_number() {
                member["lease"]["stands"] = config.settings().t_lease.0.into();
            }
        })
    }

    /// A follower echoes the heartbeat after the one that it has heard.
    pub(crate) HearsWhatWasNotSent(robot, config, mut input) {
        if let Input::Ram { ram, .. } = &mut input
            && let Coordination::Leader { heartbeat, .. } = &mut ram.coordination
        {
            *heartbeat = heartbeat.after(1);
        }
        robot.step(config, input)
    }

    /// A follower has half of `T_safety` left once it hears something old.
    pub(crate) LosesContactEarly(robot, config, input) {
        let outputs = robot.step(config, input);
        let is_old = outputs
            .iter()
            .any(|output| matches!(output, Output::Ignored(Ignored::OldHeartbeat)));
        if is_old && matches!(robot.phase(), Phase::Following(_)) {
            with_state(robot, |state| {
                let contact = &mut state["phase"]["following"]["contact"];
                if contact["fresh"].is_number() {
                    contact["fresh"] = (config.settings().t_safety.0 / 2).into();
                }
            });
        }
        outputs
    }
}
