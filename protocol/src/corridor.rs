//! The corridor: whether the leader's application may let the pedestrian cross (property I11).

use crate::config::Config;
use crate::message::Progress;
use crate::output::{CorridorClosure, Disengagement, Ignored, Output, Sink};
use crate::robot::{Effect, Step};
use crate::state::{Corridor, Identity, Leading, Member, Phase, Robot};
use crate::time::Millis;

impl Robot {
    pub(crate) fn open_corridor(&mut self, step: &mut Step<'_, impl Sink>) -> Effect {
        let Phase::Leading(leading) = &mut self.phase else {
            return Err(Ignored::NotLeading);
        };
        if leading.corridor == Corridor::Open {
            return Err(Ignored::CorridorOpen);
        }
        if leading.yields_to.is_some() {
            return Err(Ignored::Yielding);
        }
        if let Some(obstacle) = leading.corridor_obstacle(step.config) {
            return Err(match obstacle {
                CorridorClosure::NotEngaged(station, why) => Ignored::NotEngaged(station, why),
                _ => Ignored::FollowerMissing,
            });
        }
        let t_cross = step.config.settings().t_cross;
        let lock_left = match self.identity {
            Identity::Locked(left) => left.left(),
            Identity::Unlocked | Identity::Expiring => None,
        };
        // R16: with time enough to cross.
        if lock_left.is_none_or(|left| left < t_cross) || !leading.runs_for(t_cross) {
            return Err(Ignored::NotEnoughTime);
        }
        leading.corridor = Corridor::Open;
        step.out
            .push(Output::CorridorOpened(leading.shortest_lease()));
        Ok(())
    }

    pub(crate) fn close_corridor(&mut self, step: &mut Step<'_, impl Sink>) -> Effect {
        let Phase::Leading(leading) = &mut self.phase else {
            return Err(Ignored::NotLeading);
        };
        if leading.corridor != Corridor::Open {
            return Err(Ignored::CorridorClosed);
        }
        leading.shut(step, CorridorClosure::Application);
        Ok(())
    }

    /// Closes the corridor in the very step in which a follower stops to hold it, and extends it in the
    /// step in which a lease is renewed.
    pub(crate) fn settle_corridor(&mut self, step: &mut Step<'_, impl Sink>) {
        let Phase::Leading(leading) = &mut self.phase else {
            return;
        };
        if leading.corridor != Corridor::Open {
            return;
        }
        if let Some(obstacle) = leading.corridor_obstacle(step.config) {
            // R16: closed in the step in which a guard is no more.
            leading.shut(step, obstacle);
        } else if step.renewed {
            step.out
                .push(Output::CorridorExtended(leading.shortest_lease()));
        }
    }
}

impl Leading {
    /// Closes an open corridor. People may still be on the road.
    pub(crate) fn shut(&mut self, step: &mut Step<'_, impl Sink>, why: CorridorClosure) {
        if self.corridor == Corridor::Open {
            self.corridor = Corridor::Clearing;
            step.out.push(Output::CorridorClosed(why));
        }
    }

    /// How long the corridor may be shown open: until the first lease ends. A leader that hangs renews
    /// nothing, so its corridor ends before any follower can have fallen back.
    fn shortest_lease(&self) -> Millis {
        let left = |member: &Member| member.lease.countdown().left();
        // R17: no sign outlives the lease on any guard.
        let shortest = self.members.iter().filter_map(left).min();
        shortest.unwrap_or(Millis::ZERO)
    }

    /// True if every follower's command may run for this long yet.
    fn runs_for(&self, time: Millis) -> bool {
        let left = |member: &Member| member.order.and_then(|order| order.execution.left());
        self.members
            .iter()
            .all(|member| left(member).is_some_and(|left| left >= time))
    }

    /// The first thing that stands in the way of an open corridor.
    #[must_use]
    pub fn corridor_obstacle(&self, config: &Config) -> Option<CorridorClosure> {
        // R16: every guard that was asked for, each engaged.
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
    /// acknowledged, guards a pedestrian, is reported to run and, where it guards from a place, to be
    /// there, and the lease stands.
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
            Some(Progress::Executing | Progress::InPosition) => {}
        }
        if !config.settings().guarding.contains(order.task) {
            return Some(Disengagement::NotGuarding);
        }
        let holds = config.settings().holding.contains(order.task);
        if holds && order.progress != Some(Progress::InPosition) {
            return Some(Disengagement::NotInPosition);
        }
        if !self.lease.stands() {
            return Some(Disengagement::NoLease);
        }
        None
    }
}
