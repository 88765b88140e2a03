//! Actions that are possible in a state: which messages may arrive, which endpoints look, which robots fail, and
//! whether time may pass.

use crossguard_protocol::{Corridor, Event, Member, Millis, Phase};

use super::channel::Flight;
use super::model::TimedModel;
use super::section::Looks;
use super::state::{TimedAction, TimedState};
use super::watch::StopWatch;

impl TimedModel {
    /// Everything that may happen in `state`.
    pub fn actions_in(&self, state: &TimedState, actions: &mut Vec<TimedAction>) {
        if self.is_over(state) {
            return;
        }
        for &leader in self.timed.teams.leaders() {
            if let Some(event) = self.leader_event(state, leader) {
                actions.push(TimedAction::Local(leader, event));
                return;
            }
        }
        if self.may_tick(state) {
            let in_time = |fast: &u8| self.all_are_told_in_time(state, *fast);
            actions.extend(self.corners(state).filter(in_time).map(TimedAction::Tick));
        }
        if state.watch == StopWatch::Apart && state.both_go() {
            actions.push(TimedAction::Meet);
        }
        let hears = |flight: &Flight| state.hung() != Some(flight.transmission.to);
        actions.extend(
            state
                .channel
                .flights()
                .filter(hears)
                .map(TimedAction::Deliver),
        );
        for i in (0..).take(self.scenario.robots.len()) {
            let is_hung = state.hung() == Some(i);
            if state.untold[usize::from(i)] > Millis::ZERO {
                actions.push(if is_hung {
                    TimedAction::GoOn(i)
                } else {
                    TimedAction::Look(i)
                });
            }
        }
        if state.watch == StopWatch::Off {
            self.failures(state, actions);
        }
    }

    /// Whether nothing has to happen before the next tick.
    fn may_tick(&self, state: &TimedState) -> bool {
        let must_arrive = |flight: Flight| {
            flight.ticks == self.timed.delay_ticks && state.hung() != Some(flight.transmission.to)
        };
        let channel = self.scenario.channel.loss || !state.channel.flights().any(must_arrive);
        let hangs_on = |place: u8| state.untold[usize::from(place)] < self.timed.hang;
        channel && state.hung().is_none_or(hangs_on)
    }

    /// Whether no robot with a due timer takes in the time too late, on its own clock, if a tick with these fast
    /// clocks passes before.
    fn all_are_told_in_time(&self, state: &TimedState, fast: u8) -> bool {
        let Looks::Within(late_max) = self.timed.looks else {
            return true;
        };
        let mut places = (0..).take(self.scenario.robots.len());
        places.all(|i| {
            let overdue = self.overdue(state, i, state.untold[usize::from(i)]);
            let is_late = |overdue: Millis| {
                overdue.saturating_add(self.timed.clock.elapsed(fast, i)) > late_max
            };
            state.hung() == Some(i) || !overdue.is_some_and(is_late)
        })
    }

    /// For how long a timer of the robot has been due when the robot has yet to take in `untold`; `None` when none is.
    pub(super) fn overdue(&self, state: &TimedState, i: u8, untold: Millis) -> Option<Millis> {
        let due = self.node(state, i).robot.as_ref()?.next_due()?;
        (due <= untold).then(|| untold.saturating_sub(due))
    }

    /// The choices of clocks that may be fast in the next tick.
    fn corners(&self, state: &TimedState) -> std::ops::Range<u8> {
        match state.rates {
            Some(rates) => rates..rates + 1,
            None if self.timed.clock.drifts() => 0..1 << self.scenario.robots.len(),
            None => 0..1,
        }
    }

    /// Event that the application of the leader reports at once: it commands a follower as soon as that has
    /// joined, and opens the corridor as soon as it may.
    fn leader_event(&self, state: &TimedState, leader: u8) -> Option<Event> {
        let robot = self.node(state, leader).robot.as_ref()?;
        let Phase::Leading(leading) = robot.phase() else {
            return None;
        };
        if state.left.commands > 0 {
            let free = |member: &&Member| {
                member.has_joined() && member.outstanding.is_none() && member.order.is_none()
            };
            if let (Some(member), Some(task)) = (
                leading.members.iter().find(free),
                self.scenario.request.tasks.iter().next(),
            ) {
                return Some(Event::CommandManeuver {
                    follower: member.station,
                    task,
                });
            }
        }
        let may_open = self.scenario.corridor
            && leading.corridor != Corridor::Open
            && leading.corridor_obstacle(&self.scenario.config).is_none();
        may_open.then_some(Event::OpenCorridor)
    }

    /// One robot fails: the leader crashes or hangs, or a follower does or fails its maneuver while
    /// it executes.
    fn failures(&self, state: &TimedState, actions: &mut Vec<TimedAction>) {
        for (i, node) in (0..).zip(self.nodes(state)) {
            let (leads, running) = (self.timed.teams.leads(i), node.actuation.running());
            if state.left.crashes > 0 && node.robot.is_some() && (leads || running.is_some()) {
                actions.push(TimedAction::Crash(i));
            }
            if state.left.hangs > 0 && node.robot.is_some() && (leads || running.is_some()) {
                actions.push(TimedAction::Hang(i));
            }
            if state.left.disturbances > 0
                && let Some(maneuver) = running
            {
                actions.push(TimedAction::Local(i, Event::ManeuverFailed(maneuver)));
            }
        }
    }
}
