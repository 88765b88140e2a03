//! Timers that a model holds at the time they are started with, since it ends before they do or counts them itself.

use crossguard_protocol::{Config, Millis, Phase, Renaming, Robot, Timer};

/// Holds the identity lock and `T_exec` of a robot; and `T_help`, where that is asked.
pub(crate) struct Held<'a> {
    pub(crate) config: &'a Config,
    pub(crate) robot: &'a Robot,
    pub(crate) holds_help: bool,
}

impl Renaming for Held<'_> {
    fn countdown(&mut self, timer: Timer, left: Millis) -> Millis {
        match (timer, self.robot.phase()) {
            (Timer::IdentityLock, _) => self.config.t_lock_session(),
            (Timer::Help, _) if self.holds_help => self.config.settings().t_help,
            (Timer::Execution(station), Phase::Leading(leading)) => {
                let order = leading.member(station).and_then(|member| member.order);
                order.map_or(left, |order| self.config.t_exec(order.task))
            }
            _ => left,
        }
    }
}
