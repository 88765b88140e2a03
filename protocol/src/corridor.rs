//! The corridor: whether the leader's application may let the pedestrian cross (property I11).

use crate::config::Config;
use crate::message::Progress;
use crate::output::{CorridorClosure, Disengagement, Ignored, Output, Sink};
use crate::robot::{Effect, Step};
use crate::state::{Leading, Member, Phase, Robot};

impl Robot {
    pub(crate) fn open_corridor(&mut self, step: &mut Step<'_, impl Sink>) -> Effect {
        let Phase::Leading(leading) = &mut self.phase else {
            return Err(Ignored::NotLeading);
        };
        if leading.corridor_open {
            return Err(Ignored::CorridorOpen);
        }
        if let Some(obstacle) = leading.corridor_obstacle(step.config) {
            return Err(match obstacle {
                CorridorClosure::NotEngaged(station, why) => Ignored::NotEngaged(station, why),
                _ => Ignored::FollowerMissing,
            });
        }
        leading.corridor_open = true;
        step.out.push(Output::CorridorOpened);
        Ok(())
    }

    pub(crate) fn close_corridor(&mut self, step: &mut Step<'_, impl Sink>) -> Effect {
        let Phase::Leading(leading) = &mut self.phase else {
            return Err(Ignored::NotLeading);
        };
        if !leading.corridor_open {
            return Err(Ignored::CorridorClosed);
        }
        leading.corridor_open = false;
        step.out
            .push(Output::CorridorClosed(CorridorClosure::Application));
        Ok(())
    }

    /// Closes the corridor in the very step in which a follower stops to hold it.
    pub(crate) fn settle_corridor(&mut self, step: &mut Step<'_, impl Sink>) {
        let Phase::Leading(leading) = &mut self.phase else {
            return;
        };
        if !leading.corridor_open {
            return;
        }
        if let Some(obstacle) = leading.corridor_obstacle(step.config) {
            leading.corridor_open = false;
            step.out.push(Output::CorridorClosed(obstacle));
        }
    }
}

impl Leading {
    /// The first thing that stands in the way of an open corridor.
    #[must_use]
    pub fn corridor_obstacle(&self, config: &Config) -> Option<CorridorClosure> {
        if self.members.len() < usize::from(self.request.followers) {
            return Some(CorridorClosure::FollowerMissing);
        }
        self.members.iter().find_map(|member| {
            let why = member.disengagement(config)?;
            Some(CorridorClosure::NotEngaged(member.station, why))
        })
    }
}

impl Member {
    /// Why the follower does not hold the corridor; `None` when it is engaged: its command is
    /// acknowledged, guards a pedestrian, is reported to run, and the lease stands.
    #[must_use]
    pub fn disengagement(&self, config: &Config) -> Option<Disengagement> {
        if self.outstanding.is_some() {
            return Some(Disengagement::CommandOutstanding);
        }
        let Some(order) = self.order else {
            return Some(Disengagement::NotExecuting);
        };
        match order.progress {
            None => return Some(Disengagement::NotExecuting),
            Some(Progress::Completed) => return Some(Disengagement::Completed),
            Some(Progress::Failed(failure)) => return Some(Disengagement::Failed(failure)),
            Some(Progress::SafeIdle) => return Some(Disengagement::SafeIdle),
            Some(Progress::Executing) => {}
        }
        if !config.settings().guarding.contains(order.task) {
            return Some(Disengagement::NotGuarding);
        }
        if !self.lease.stands() {
            return Some(Disengagement::NoLease);
        }
        None
    }
}
