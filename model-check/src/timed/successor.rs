//! The effect of what happens: a step of the model.

use crossguard_protocol::{Event, Millis, Outputs};
use smallvec::SmallVec;

use super::measure::{Longest, Measure};
use super::model::{TimedModel, TimedRobotStep};
use super::quiet::Quiet;
use super::section::{Looks, Rates};
use super::sign::Sign;
use super::state::{TimedAction, TimedState};
use super::teams::MAX_TEAMS;
use super::told::{Reason, Told};
use super::watch::StopWatch;
use crate::network::{Transmission, concerns};
use crate::properties::timed_view::{RobotSteps, falls_back};
use crate::robots::TimedCause;
use crate::scenario::MAX_ROBOTS;

impl TimedModel {
    /// The state after `action` in `state`; `None` if the action changes nothing. The stop-watches
    /// that it stops are noted in `longest`.
    pub(super) fn successor(
        &self,
        state: &TimedState,
        action: TimedAction,
        longest: &mut Longest,
    ) -> Option<TimedState> {
        let mut next = state.clone();
        next.broken = 0;
        let taken_in = self.taken_in(state, action);
        match action {
            TimedAction::Tick(fast) => self.tick(&mut next, fast),
            TimedAction::Deliver(flight) => next.channel.take(flight),
            TimedAction::Local(i, event) => {
                next.left.spend(event);
                if matches!(event, Event::ManeuverFailed(_)) {
                    next.watch = StopWatch::FollowerFailed(i, 0);
                }
            }
            TimedAction::Crash(i) => self.crash(&mut next, i),
            TimedAction::Hang(i) => {
                next.left.hangs -= 1;
                if self.timed.teams.leads(i) {
                    next.waiting = None;
                }
                next.watch = StopWatch::Hung(i, 0);
            }
            TimedAction::Meet => next.watch = StopWatch::Near,
            TimedAction::Look(_) | TimedAction::GoOn(_) => {}
        }
        let (mut is_ignored, mut reason) = (false, Reason::None);
        let mut robots = RobotSteps::NONE;
        for (i, cause) in taken_in {
            if matches!(cause, TimedCause::Elapsed(_)) {
                next.untold[usize::from(i)] = Millis::ZERO;
            }
            if let Some(taken) = self.robot_step(&mut next, i, cause, &mut robots) {
                is_ignored = taken.is_ignored;
                reason = reason.max(taken.telling.reason);
            } else {
                is_ignored = true;
            }
        }
        let changes_nothing = match action {
            // It might as well never have arrived.
            TimedAction::Deliver(_) => is_ignored && self.scenario.channel.loss,
            TimedAction::Local(..) => is_ignored,
            _ => false,
        };
        if changes_nothing {
            return None;
        }
        self.hear_of_each_other(&mut next, action);
        self.measure(state, &mut next, longest);
        Self::measure_waiting(&mut next, reason, longest);
        if matches!(action, TimedAction::GoOn(_)) {
            next.watch = StopWatch::Off;
        }
        next.broken = self.judge(state, &next, robots);
        self.canonicalize(&mut next);
        Some(next)
    }

    /// Inputs of robots when `action` happens, in this order. A robot takes in the time before
    /// anything else.
    fn taken_in(
        &self,
        state: &TimedState,
        action: TimedAction,
    ) -> SmallVec<[(u8, TimedCause); MAX_ROBOTS]> {
        let after_the_time = |i: u8, cause: Option<TimedCause>| {
            let untold = state.untold[usize::from(i)];
            let time = (untold > Millis::ZERO).then_some(TimedCause::Elapsed(untold));
            time.into_iter()
                .chain(cause)
                .map(|cause| (i, cause))
                .collect()
        };
        match action {
            TimedAction::Tick(fast) => {
                let told = |i: u8| {
                    let untold = state.untold[usize::from(i)];
                    let elapsed = untold.saturating_add(self.timed.clock.elapsed(fast, i));
                    // As long as nothing is due, it makes no difference when a robot is told.
                    let is_told = state.hung() != Some(i)
                        && (self.timed.looks == Looks::EachTick
                            || self.overdue(state, i, elapsed).is_none());
                    is_told.then_some((i, TimedCause::Elapsed(elapsed)))
                };
                (0..)
                    .take(self.scenario.robots.len())
                    .filter_map(told)
                    .collect()
            }
            TimedAction::Look(i) | TimedAction::GoOn(i) => after_the_time(i, None),
            TimedAction::Deliver(flight) => {
                let Transmission { to, message, .. } = flight.transmission;
                after_the_time(to, Some(TimedCause::Message(message)))
            }
            TimedAction::Local(i, event) => after_the_time(i, Some(TimedCause::Event(event))),
            TimedAction::Crash(_) | TimedAction::Hang(_) | TimedAction::Meet => SmallVec::new(),
        }
    }

    /// A tick passes: messages grow older, every clock runs on, and with the leader's its sign's.
    fn tick(&self, next: &mut TimedState, fast: u8) {
        next.watch.tick();
        next.channel.tick(self.timed.delay_ticks);
        for (&leader, sign) in self.timed.teams.leaders().iter().zip(&mut next.signs) {
            sign.elapse(self.timed.clock.elapsed(fast, leader));
        }
        let since = next.unguarded.iter_mut().chain([&mut next.waiting]);
        for ticks in since.flatten() {
            *ticks = ticks.saturating_add(1);
        }
        if self.timed.rates == Rates::Constant && self.timed.clock.drifts() {
            next.rates = Some(fast);
        }
        for i in (0..).take(self.scenario.robots.len()) {
            let untold = &mut next.untold[usize::from(i)];
            *untold = untold.saturating_add(self.timed.clock.elapsed(fast, i));
        }
    }

    fn crash(&self, next: &mut TimedState, i: u8) {
        next.left.crashes -= 1;
        if self.timed.teams.leads(i) {
            next.watch = StopWatch::LeaderDown(0);
            next.signs[self.timed.teams.team_of(i)] = Sign::Stop;
            next.told = Told::NOTHING;
            next.waiting = None;
        } else {
            next.watch = StopWatch::FollowerFailed(i, 0);
        }
        next.quiet[usize::from(i)] = None;
        next.untold[usize::from(i)] = Millis::ZERO;
        next.nodes[usize::from(i)] = self.robots.nodes.number(self.node(next, i).crashed());
        next.channel.forget_receiver(i);
    }

    fn measure(&self, before: &TimedState, next: &mut TimedState, longest: &mut Longest) {
        let robots = || self.nodes(before).zip(self.nodes(next));
        let stops = |place| {
            let team = self.timed.teams.team_of(place);
            before.shows_go(team) && !next.shows_go(team)
        };
        let is_told = |place| before.told.counts_on(place) && !next.told.counts_on(place);
        match next.watch {
            StopWatch::Off | StopWatch::Apart | StopWatch::Near => {}
            StopWatch::Request(ticks) => {
                if !self
                    .node(next, self.timed.teams.leaders()[0])
                    .is_requesting()
                {
                    longest.note(Measure::Roles, ticks);
                    next.watch = StopWatch::Off;
                }
            }
            StopWatch::LeaderDown(ticks) => {
                if robots().any(|(b, n)| {
                    b.actuation.running().is_some() && n.actuation.running().is_none()
                }) {
                    longest.note(Measure::Stopped, ticks);
                }
                if robots().any(|(b, n)| b.following().is_some() && n.following().is_none()) {
                    longest.note(Measure::Left, ticks);
                }
            }
            StopWatch::FollowerFailed(place, ticks) => {
                if stops(place) {
                    longest.note(Measure::CorridorClosed, ticks);
                }
                if is_told(place) {
                    longest.note(Measure::Unaware, ticks);
                }
            }
            StopWatch::Hung(place, ticks) => {
                let leads = self.timed.teams.leads(place);
                if stops(place) {
                    longest.note(Measure::of_hang(leads), ticks);
                }
                if is_told(place) {
                    longest.note(Measure::Unaware, ticks);
                }
            }
            StopWatch::BothGo(ticks) => {
                if !next.both_go() {
                    longest.note(Measure::BothGo, ticks);
                    next.watch = StopWatch::Off;
                }
            }
        }
        self.measure_unguarded(before, next, longest);
    }

    /// For how long the sign of a team shows go although a follower of it fell back for lack of contact.
    fn measure_unguarded(&self, before: &TimedState, next: &mut TimedState, longest: &mut Longest) {
        let mut fallen = [false; MAX_TEAMS];
        for (place, (before, next)) in (0..).zip(self.nodes(before).zip(self.nodes(next))) {
            fallen[self.timed.teams.team_of(place)] |= falls_back(before, next);
        }
        for (team, fallen) in fallen.into_iter().enumerate() {
            if fallen {
                next.unguarded[team].get_or_insert(0);
            }
            if let Some(ticks) = next.unguarded[team]
                && !next.shows_go(team)
            {
                longest.note(Measure::Unguarded, ticks);
                next.unguarded[team] = None;
            }
        }
    }

    /// Whether the pedestrian still waits, and for how long it has.
    fn measure_waiting(next: &mut TimedState, reason: Reason, longest: &mut Longest) {
        let Some(ticks) = next.waiting else {
            return;
        };
        let sees_go = next.shows_go(0);
        if sees_go || reason != Reason::None {
            longest.note(Measure::Waiting, ticks);
            next.waiting = (!sees_go && reason == Reason::Lease).then_some(0);
        }
    }

    /// Starts the stop-watch of two leaders once a message of one reaches the other.
    fn hear_of_each_other(&self, next: &mut TimedState, action: TimedAction) {
        if let (StopWatch::Near, TimedAction::Deliver(flight)) = (next.watch, action) {
            let Transmission { from, to, .. } = flight.transmission;
            let teams = &self.timed.teams;
            if teams.leads(from) && teams.leads(to) {
                next.watch = StopWatch::BothGo(0);
            }
        }
    }

    pub(super) fn robot_step(
        &self,
        next: &mut TimedState,
        i: u8,
        cause: TimedCause,
        robots: &mut RobotSteps,
    ) -> Option<&TimedRobotStep> {
        let place = usize::from(i);
        let step = self.step(next.nodes[place], cause)?;
        next.nodes[place] = step.after;
        if let Some(sign) = step.sign {
            next.signs[self.timed.teams.team_of(i)] = sign;
        }
        next.told = step.telling.after(next.told);
        let elapsed = match cause {
            TimedCause::Elapsed(elapsed) => elapsed,
            TimedCause::Message(_) | TimedCause::Event(_) => Millis::ZERO,
        };
        let (quiet, keeps) = Quiet::after(next.quiet[place], elapsed, step.contact);
        next.quiet[place] = quiet;
        robots.keep_contact &= keeps;
        robots.are_valid &= step.is_valid;
        self.send(next, i, &step.sends);
        Some(step)
    }

    fn send(&self, next: &mut TimedState, from: u8, messages: &[u16]) {
        let team = |place| self.timed.teams.team_of(place);
        let is_near = |to: &u8| next.watch != StopWatch::Apart || team(*to) == team(from);
        let others = (0..)
            .take(self.scenario.robots.len())
            .filter(|&to| to != from);
        let others: SmallVec<[u8; MAX_ROBOTS]> = others.filter(is_near).collect();
        for &message in messages {
            for &to in &others {
                let receiver = self.node(next, to);
                if receiver.robot.is_some()
                    && concerns(self.message(message), receiver.persisted.station)
                {
                    next.channel.send(Transmission { from, to, message });
                }
            }
        }
    }

    /// Inputs and outputs of robots when `action` happens in `state`, for a chart.
    pub(super) fn outputs(
        &self,
        state: &TimedState,
        action: TimedAction,
    ) -> Vec<(u8, TimedCause, Outputs)> {
        let mut at = state.clone();
        let mut put_out = Vec::new();
        for (i, cause) in self.taken_in(state, action) {
            if let Some((_, outputs)) = self.compute(at.nodes[usize::from(i)], cause) {
                put_out.push((i, cause, outputs));
            }
            let _ = self.robot_step(&mut at, i, cause, &mut RobotSteps::NONE.clone());
        }
        put_out
    }
}
