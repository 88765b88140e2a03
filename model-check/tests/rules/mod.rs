//! Weakened rules that more than one test puts in the protocol's place.
#![allow(unreachable_pub, reason = "shared by tests")]

use crossguard_model_check::node::Rules;
use crossguard_protocol::*;

/// Outputs of one kind never reach the robot.
pub struct Drops(pub fn(&Output) -> bool);

impl Rules for Drops {
    fn step(&self, robot: &mut Robot, config: &Config, input: Input) -> Outputs {
        let outputs = robot.step(config, input);
        outputs
            .iter()
            .copied()
            .filter(|output| !(self.0)(output))
            .collect()
    }
}

/// When one follower is gone, another one's lease goes too.
pub struct LosesTwoForOne;

impl Rules for LosesTwoForOne {
    fn step(&self, robot: &mut Robot, config: &Config, input: Input) -> Outputs {
        let outputs = robot.step(config, input);
        let one_is_gone = outputs
            .notices()
            .any(|notice| matches!(notice, Notice::FollowerGone(..)));
        if let (true, Phase::Leading(leading)) = (one_is_gone, robot.phase()) {
            let others: Vec<_> = leading.members.iter().map(|m| m.station).collect();
            for station in others {
                robot.step(config, Input::Expired(Timer::Lease(station)));
            }
        }
        outputs
    }
}

/// A follower has no timers.
pub struct FollowersWaitForEver;

impl Rules for FollowersWaitForEver {
    fn step(&self, robot: &mut Robot, config: &Config, input: Input) -> Outputs {
        if let (Phase::Following(_), Input::Expired(_)) = (robot.phase(), input) {
            return [Output::Ignored(Ignored::TimerNotArmed)]
                .into_iter()
                .collect();
        }
        robot.step(config, input)
    }
}
