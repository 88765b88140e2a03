//! Judges the steps of the timed model by the rules of the properties.

use smallvec::SmallVec;

use super::model::TimedModel;
use super::sign::Sign;
use super::state::TimedState;
use super::watch::StopWatch;
use crate::node::Node;
use crate::properties::PropertyId;
use crate::properties::timed_view::{RobotSteps, TimedStepView, TimedView};
use crate::scenario::MAX_ROBOTS;

impl TimedModel {
    pub(super) fn look<T>(&self, state: &TimedState, look: impl FnOnce(&TimedView) -> T) -> T {
        let nodes: SmallVec<[&Node; MAX_ROBOTS]> = self.nodes(state).collect();
        look(&TimedView {
            nodes: &nodes,
            timed: &self.timed,
            limits: &self.limits,
            watch: state.watch,
            shows_go: state.signs.map(Sign::shows_go),
            is_unguarded: state.is_unguarded(),
            told: state.told,
            waiting: state.waiting,
        })
    }

    pub(super) fn look_at_step<T>(
        &self,
        before: &TimedState,
        after: &TimedState,
        robots: RobotSteps,
        look: impl FnOnce(&TimedStepView) -> T,
    ) -> T {
        self.look(before, |before| {
            self.look(after, |after| {
                look(&TimedStepView {
                    before,
                    after,
                    robots,
                })
            })
        })
    }

    /// Which properties the step from `before` to `after` breaks, one bit each. `after` has the names of `before`.
    pub(super) fn judge(&self, before: &TimedState, after: &TimedState, robots: RobotSteps) -> u64 {
        self.look_at_step(before, after, robots, |step| {
            let claimed = PropertyId::ALL.into_iter();
            let claimed = claimed.filter_map(|id| Some((id, id.timed_rule()?)));
            let broken = claimed.filter(|(_, rule)| !(rule.holds)(step));
            broken.fold(0, |broken, (id, _)| broken | id.bit())
        })
    }

    /// Whether nothing more is to be learned from a run.
    pub(super) fn is_over(&self, state: &TimedState) -> bool {
        // An event that is late might never come.
        let ends_run = |id: PropertyId| id.timed_rule().is_some_and(|rule| rule.ends_run);
        let mut broken = PropertyId::ALL.into_iter();
        if state.broken != 0 && broken.any(|id| state.broken & id.bit() != 0 && ends_run(id)) {
            return true;
        }
        let timed = &self.timed;
        let leader = self.node(state, timed.teams.leaders()[0]);
        match state.watch {
            StopWatch::LeaderDown(_) => self.nodes(state).all(|it| it.following().is_none()),
            // Nothing from before the failure is under way any more that could open the corridor again.
            StopWatch::FollowerFailed(place, ticks) => {
                let is_told = !state.told.counts_on(place) || !timed.claims(PropertyId::W6);
                is_told && !state.shows_go(timed.teams.team_of(place)) && ticks > timed.delay_ticks
            }
            StopWatch::Hung(..) | StopWatch::Apart | StopWatch::Near | StopWatch::BothGo(_) => {
                false
            }
            // One of two leaders has yielded.
            StopWatch::Off if timed.teams.are_two() => true,
            StopWatch::Off | StopWatch::Request(_) => leader.is_idle() && state.waiting.is_none(),
        }
    }
}
