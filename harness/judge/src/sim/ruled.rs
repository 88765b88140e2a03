//! A robot whose transition function may be another one than the kit's: to show what a rule is good for.

use crossguard_model_check::node::Rules;
use crossguard_protocol::{Config, Input, Outputs, Robot, StateMachine};

/// A robot under rules.
#[derive(Debug)]
pub struct Ruled {
    /// The robot.
    pub robot: Robot,
    /// Rules in place of a step of the protocol.
    pub rules: &'static dyn Rules,
}

impl StateMachine for Ruled {
    fn robot(&self) -> &Robot {
        &self.robot
    }

    fn step(&mut self, config: &Config, input: Input) -> Outputs {
        self.rules.step(&mut self.robot, config, input)
    }
}
