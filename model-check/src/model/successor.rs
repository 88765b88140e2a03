//! The effect of an action: the next state, and the step of the robot that takes one.

use crossguard_protocol::{Phase, SessionId, Timer};

use super::{Action, Delivery, Draft, Model, ModelState, RobotStep};
use crate::network::{Network, Transmission, concerns};
use crate::node::Node;
use crate::properties::StepView;
use crate::road::{Body, Pedestrian};
use crate::scenario::Bounds;
use crate::steps::{Cause, ComputedStep, judge_historic};

impl Model {
    /// The state after `action` in `state`, with the robot's step if one takes a step; `None` if the
    /// action changes nothing.
    #[must_use]
    pub fn successor(
        &self,
        state: &ModelState,
        action: Action,
    ) -> Option<(ModelState, Option<RobotStep<'_>>)> {
        let (next, step) = self.take(state, action)?;
        Some((self.interned(next), step))
    }

    /// The same, with one state for all successors that differ only by a permutation of the symmetric robots.
    #[must_use]
    pub fn successor_up_to_symmetry(
        &self,
        state: &ModelState,
        action: Action,
    ) -> Option<(ModelState, Option<RobotStep<'_>>)> {
        let (next, step) = self.take(state, action)?;
        Some((self.interned(self.representative_of(next)), step))
    }

    pub(super) fn take(
        &self,
        state: &ModelState,
        action: Action,
    ) -> Option<(Draft, Option<RobotStep<'_>>)> {
        if let Action::Deliver {
            transmission,
            how: Delivery::AnyTime,
        } = action
            && self.changes_nothing(state, transmission)
        {
            return None;
        }
        let mut next = Draft {
            state: state.clone(),
            network: self.network(state),
        };
        let step = match action {
            Action::Deliver { transmission, how } => {
                Some(self.deliver(state, &mut next, transmission, how)?)
            }
            Action::Lose(transmission) => {
                let is_on_air = next.network.next_on_air().is_some();
                let is_free = is_on_air && self.is_deaf(state, transmission.to.into());
                if let (Some(left), false) = (&mut next.state.left.losses, is_free) {
                    *left -= 1;
                }
                if is_on_air {
                    next.network.take_off_air(transmission);
                } else {
                    next.network.forget(transmission);
                }
                None
            }
            Action::Delay(transmission) => {
                next.network.take_off_air(transmission);
                next.network.delay(transmission);
                None
            }
            Action::Expire(i, timer) => {
                Some(self.robot_step(&mut next, i.into(), Cause::Timer(timer))?)
            }
            Action::Local(i, event) => {
                next.state.left.spend(event);
                let step = self.robot_step(&mut next, i.into(), Cause::Event(event))?;
                if step.step.is_ignored {
                    return None;
                }
                Some(step)
            }
            Action::Crash(i) => {
                next.state.left.crashes -= 1;
                self.crash(&mut next.state, i.into());
                self.forget_the_dead(&mut next);
                None
            }
            Action::Restart(i) => {
                next.state.left.restarts -= 1;
                let node = &mut next.state.nodes[usize::from(i)];
                *node = self.robots().nodes.number(self.node(*node).restarted());
                self.forget_the_dead(&mut next);
                None
            }
            Action::Hang(i) => {
                next.state.left.hangs -= 1;
                next.state.hung |= 1 << i;
                None
            }
            Action::Resume(i) => {
                next.state.hung &= !(1 << i);
                None
            }
            Action::Lie(transmission) => {
                let cause = Cause::Message(transmission.message);
                Some(self.robot_step(&mut next, transmission.to.into(), cause)?)
            }
            Action::StepOnRoad(i) => {
                let session = self.step_on_road(&mut next.state, i.into())?;
                self.set_pedestrian(&mut next.state, Pedestrian::OnRoad(session));
                None
            }
            Action::Across(_) => {
                let across = if self.0.scenario.cooperative {
                    Pedestrian::Across
                } else {
                    Pedestrian::Waiting
                };
                self.set_pedestrian(&mut next.state, across);
                None
            }
        };
        self.forget_bodies(&mut next.state);
        self.forget(&mut next);
        Some((self.ranked(next), step))
    }

    fn deliver(
        &self,
        state: &ModelState,
        next: &mut Draft,
        transmission: Transmission,
        how: Delivery,
    ) -> Option<RobotStep<'_>> {
        match how {
            Delivery::AtOnce => next.network.take_off_air(transmission),
            Delivery::Late => next.network.forget(transmission),
            Delivery::LateAndAgain | Delivery::AnyTime => {}
        }
        let cause = Cause::Message(transmission.message);
        let step = self.robot_step(next, transmission.to.into(), cause)?;
        let has_effect = match how {
            Delivery::AtOnce | Delivery::Late => true,
            Delivery::LateAndAgain => !step.step.is_ignored,
            Delivery::AnyTime => !next.is(state, &self.network(state)),
        };
        has_effect.then_some(step)
    }

    /// Whether a robot that hears this message stays as it is and sends nothing. On a monotone channel most are heard
    /// again and again.
    fn changes_nothing(&self, state: &ModelState, heard: Transmission) -> bool {
        let node = state.nodes[usize::from(heard.to)];
        let step = self.step(node, Cause::Message(heard.message));
        step.is_some_and(|step| {
            if step.changes_nothing && !state.hangs(heard.to.into()) {
                self.note_premises(step.premises);
            }
            step.changes_nothing
        })
    }

    /// The session at whose sign a pedestrian steps on the road. Judges whether the guards are in place.
    fn step_on_road(&self, next: &mut ModelState, i: usize) -> Option<SessionId> {
        let session = self.node(next.nodes[i]).session()?;
        let required = usize::from(self.0.scenario.request.followers);
        for &property in &self.0.scenario.properties {
            let keeps_guards =
                self.look(next, |view| property.keeps_guards(view, session, required));
            if let Some(holds) = keeps_guards {
                self.note_premises(property.bit());
                if !holds {
                    next.broken |= property.bit();
                }
            }
        }
        Some(session)
    }

    fn set_pedestrian(&self, next: &mut ModelState, pedestrian: Pedestrian) {
        let mut history = self.history(next).clone();
        history.pedestrian = pedestrian;
        next.history = self.0.histories.number(history);
    }

    /// Forgets what a body has done last once no robot leads that session any more.
    fn forget_bodies(&self, next: &mut ModelState) {
        for i in 0..self.0.scenario.robots.len() {
            let node = self.node(next.nodes[i]);
            let Body::Ended(id, _) = node.actuation.body else {
                continue;
            };
            let leads = |node: &Node| {
                node.session() == Some(id.session) && node.persisted.station == id.session.leader
            };
            if !self.nodes(next).any(leads) {
                let mut forgetful = node.clone();
                forgetful.actuation.body = Body::Parked;
                next.nodes[i] = self.robots().nodes.number(forgetful);
            }
        }
    }

    fn crash(&self, next: &mut ModelState, i: usize) {
        let node = self.node(next.nodes[i]);
        if let Some(robot) = &node.robot {
            let mut history = self.history(next).clone();
            history.record_crash(robot);
            next.history = self.0.histories.number(history);
        }
        next.nodes[i] = self.robots().nodes.number(node.crashed());
        next.hung &= !(1 << i);
    }

    /// Drops from a monotone channel what robots would hear that are down for good.
    fn forget_the_dead(&self, next: &mut Draft) {
        let scenario = &self.0.scenario;
        if !scenario.channel.monotone || next.state.left.restarts > 0 {
            return;
        }
        for (i, &node) in next.state.nodes[..scenario.robots.len()].iter().enumerate() {
            if self.node(node).robot.is_none() {
                let sets = &self.0.sets;
                next.network.sent = sets.without(next.network.sent, i, self.robots());
            }
        }
    }

    fn robot_step(&self, next: &mut Draft, i: usize, cause: Cause) -> Option<RobotStep<'_>> {
        let (scenario, before) = (self.scenario(), next.state.nodes[i]);
        if next.state.hangs(i) {
            return None;
        }
        let step = self.step(before, cause)?;
        self.spend_growth(&mut next.state.left, before, cause, step)?;
        if self.confirms_a_stranger(step.after) {
            return None;
        }
        let (mut premises, mut broken) = (step.premises, step.broken);
        if step.is_historic {
            let view = StepView {
                config: &scenario.config,
                history: self.0.histories.value(next.state.history),
                before: self.node(before),
                after: self.node(step.after),
                input: step.input,
                outputs: &step.outputs,
            };
            let historic = judge_historic(&scenario.properties, &view);
            premises |= historic.0;
            broken |= historic.1;
            next.state.history = self.0.histories.number(view.history_after());
        }
        next.state.broken |= broken;
        self.note_premises(premises);
        self.transmit(next, i, step);
        next.state.nodes[i] = step.after;
        Some(RobotStep { robot: i, step })
    }

    /// Takes what makes a monotone channel grow without end off what may still happen: a RAM timer that
    /// changes its robot counts a heartbeat, and a robot that a message makes offer numbers an offer.
    /// `None` where there is nothing left.
    fn spend_growth(
        &self,
        left: &mut Bounds,
        before: u32,
        cause: Cause,
        step: &ComputedStep,
    ) -> Option<()> {
        let offer = |node| match self.node(node).phase() {
            Some(Phase::Offering(offering)) => Some(offering.session),
            _ => None,
        };
        let bound = match cause {
            Cause::Timer(Timer::Ram) if step.after != before => &mut left.heartbeats,
            Cause::Message(_) if offer(step.after).is_some_and(|it| offer(before) != Some(it)) => {
                &mut left.offers
            }
            _ => return Some(()),
        };
        if let Some(left) = bound {
            *left = left.checked_sub(1)?;
        }
        Some(())
    }

    fn transmit(&self, next: &mut Draft, from: usize, step: &ComputedStep) {
        let scenario = &self.0.scenario;
        for &number in &step.sends {
            let message = self.message(number);
            // An insider that lies needs to hear nothing: it may say all that it could have heard of.
            let hears = |&to: &usize| to != from && scenario.robots[to].lies.is_none();
            for to in (0..scenario.robots.len()).filter(hears) {
                let receiver = self.node(next.state.nodes[to]);
                if !concerns(message, receiver.persisted.station) || !self.may_hear(next, to) {
                    continue;
                }
                let place = |i: usize| u8::try_from(i).expect("at most MAX_ROBOTS");
                let transmission = Transmission {
                    from: place(from),
                    to: place(to),
                    message: number,
                };
                if scenario.channel.monotone {
                    let (sets, sent) = (&self.0.sets, next.network.sent);
                    next.network.sent = sets.with(sent, transmission, self.robots());
                } else {
                    next.network.send(transmission);
                }
            }
        }
    }

    /// Whether the robot at this place can ever hear what is sent now.
    fn may_hear(&self, next: &Draft, place: usize) -> bool {
        let channel = self.0.scenario.channel;
        let keeps = channel.monotone || channel.delayed > 0;
        match self.node(next.state.nodes[place]).robot {
            None => keeps && next.state.left.restarts > 0,
            Some(_) => keeps || !next.state.hangs(place),
        }
    }
}

impl Draft {
    /// Whether nothing has changed.
    fn is(&self, state: &ModelState, network: &Network) -> bool {
        self.state == *state && self.network == *network
    }
}
