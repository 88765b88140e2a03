//! Actions that are possible in a state.

use crossguard_protocol::{
    Availability, Event, Member, Phase, Robot, StationId, Timer, Unavailability,
};
use smallvec::SmallVec;

use super::{Action, Delivery, Model, ModelState};
use crate::network::{Message, Transmission};
use crate::node::Node;
use crate::road::{Body, Pedestrian};
use crate::scenario::{MAX_ROBOTS, PSEUDONYM_STEP};

impl Model {
    /// The messages on air of which any may be the next whose fate is decided.
    pub(super) fn next_on_air(&self, state: &ModelState) -> SmallVec<[Transmission; MAX_ROBOTS]> {
        let network = self.network(state);
        if self.0.symmetry.is_trivial() {
            network.next_on_air().into_iter().collect()
        } else {
            network.first_broadcast().collect()
        }
    }

    /// Everything that may happen in `state`. An application's event may turn out to be ignored.
    pub fn actions_in(&self, state: &ModelState, actions: &mut Vec<Action>) {
        if state.broken != 0 {
            return;
        }
        let on_air = self.next_on_air(state);
        self.lies(state, !on_air.is_empty(), actions);
        if on_air.is_empty() {
            self.actions_off_air(state, actions);
        }
        for transmission in on_air {
            self.fates(state, transmission, actions);
        }
    }

    /// Whether the fate of some message is to be decided before anything else.
    pub(crate) fn is_on_air(&self, state: &ModelState) -> bool {
        self.network(state).next_on_air().is_some()
    }

    /// Everything that may happen in `state` once nothing is on air any more.
    pub(crate) fn actions_off_air(&self, state: &ModelState, actions: &mut Vec<Action>) {
        for transmission in self.network(state).delayed() {
            for how in [Delivery::Late, Delivery::LateAndAgain] {
                actions.push(Action::Deliver { transmission, how });
            }
            if state.left.losses != Some(0) {
                actions.push(Action::Lose(transmission));
            }
        }
        for transmission in self.0.sets.transmissions(self.network(state).sent) {
            let how = Delivery::AnyTime;
            actions.push(Action::Deliver { transmission, how });
        }
        for (i, node) in (0..).zip(self.nodes(state)) {
            match &node.robot {
                Some(_) if state.hangs(i.into()) => {
                    actions.push(Action::Resume(i));
                    if state.left.crashes > 0 {
                        actions.push(Action::Crash(i));
                    }
                }
                Some(robot) => {
                    for (timer, _) in robot.timers().iter() {
                        if !self.0.scenario.cooperative || !guards_against_silence(*timer) {
                            actions.push(Action::Expire(i, *timer));
                        }
                    }
                    self.local_events(state, i, node, robot, actions);
                    if state.left.crashes > 0 {
                        actions.push(Action::Crash(i));
                    }
                    if state.left.hangs > 0 {
                        actions.push(Action::Hang(i));
                    }
                }
                None if self.0.scenario.robots[usize::from(i)].lies.is_some() => {}
                None if state.left.restarts > 0 => actions.push(Action::Restart(i)),
                None => {}
            }
        }
        self.pedestrian_actions(state, actions);
    }

    fn pedestrian_actions(&self, state: &ModelState, actions: &mut Vec<Action>) {
        match self.history(state).pedestrian {
            Pedestrian::Waiting => {
                let signs = (0..).zip(self.nodes(state));
                let shows_go = signs.filter(|(_, node)| node.actuation.corridor_open);
                actions.extend(shows_go.map(|(i, _)| Action::StepOnRoad(i)));
            }
            Pedestrian::OnRoad(session) => {
                let place = self.0.scenario.place_of(session.leader).unwrap_or_default();
                actions.push(Action::Across(
                    u8::try_from(place).expect("at most MAX_ROBOTS"),
                ));
            }
            Pedestrian::Across => {}
        }
    }

    /// Possible fates of a message on air.
    fn fates(&self, state: &ModelState, transmission: Transmission, actions: &mut Vec<Action>) {
        let channel = self.0.scenario.channel;
        if self.is_deaf(state, transmission.to.into()) {
            actions.push(Action::Lose(transmission));
        } else {
            actions.push(Action::Deliver {
                transmission,
                how: Delivery::AtOnce,
            });
            let is_rmcm = matches!(self.message(transmission.message), Message::Rmcm(_));
            if self.0.scenario.cooperative && is_rmcm {
                return;
            }
            if channel.loss && state.left.losses != Some(0) {
                actions.push(Action::Lose(transmission));
            }
        }
        if self
            .network(state)
            .can_delay(transmission, usize::from(channel.delayed))
        {
            actions.push(Action::Delay(transmission));
        }
    }

    /// Whether the robot at this place is down or hangs.
    pub(super) fn is_deaf(&self, state: &ModelState, place: usize) -> bool {
        self.node(state.nodes[place]).robot.is_none() || state.hangs(place)
    }

    /// Whether each robot that guards the pedestrian on the road has seen them itself.
    fn is_seen_by_all_guards(&self, state: &ModelState) -> bool {
        let Some(session) = self.history(state).pedestrian.on_road() else {
            return false;
        };
        let settings = self.0.scenario.config.settings();
        let guards = |node: &&Node| {
            let body = node.actuation.body;
            body.guards(settings)
                .is_some_and(|maneuver| maneuver.id.session == session)
        };
        let mut guarding = self.nodes(state).filter(guards).peekable();
        guarding.peek().is_some() && guarding.all(sees_people)
    }

    /// Every event that the application of a robot could come up with.
    fn local_events(
        &self,
        state: &ModelState,
        i: u8,
        node: &Node,
        robot: &Robot,
        actions: &mut Vec<Action>,
    ) {
        let mut push = |event| actions.push(Action::Local(i, event));
        let (scenario, left) = (&self.0.scenario, &state.left);
        let pedestrian = self.history(state).pedestrian;
        let is_road_free = pedestrian.on_road().is_none();
        // Applications that cooperate in a crossing wait for its end.
        let waits = scenario.cooperative && scenario.corridor && pedestrian != Pedestrian::Across;
        if let Some(maneuver) = node.actuation.body.running() {
            let settings = scenario.config.settings();
            let guards = settings.guarding.contains(maneuver.task);
            if settings.holding.contains(maneuver.task) {
                match node.actuation.body {
                    Body::UnderWay(_) | Body::OutOfPosition(_) => {
                        push(Event::InPosition(maneuver.id));
                    }
                    _ if left.drifts > 0 => push(Event::OutOfPosition(maneuver.id)),
                    _ => {}
                }
            }
            if !guards || (is_road_free && !waits) {
                push(Event::ManeuverCompleted(maneuver.id));
            }
            if left.disturbances > 0 {
                push(Event::ManeuverFailed(maneuver.id));
            }
        }
        let has_duty =
            node.actuation.road_unsure || matches!(node.actuation.body, Body::FallingBack(..));
        if (has_duty || sees_people(node)) && is_road_free {
            push(Event::RoadClear);
        }
        if left.sightings > 0 && !is_road_free && node.following().is_some() {
            push(Event::PersonOnRoad);
        }
        let is_seen = pedestrian != Pedestrian::Across;
        if left.detections > 0 && is_seen && scenario.robots[usize::from(i)].detects {
            push(Event::PedestrianDetected(scenario.request_of(i.into())));
        }
        if left.disturbances > 0 {
            let reason = Unavailability::LocalFault;
            push(Event::AvailabilityChanged(Availability::Unavailable(
                reason,
            )));
        }
        if robot.availability() != Availability::Available {
            push(Event::AvailabilityChanged(Availability::Available));
        }
        if left.disturbances > 0 {
            let alias = StationId(robot.station().0 + PSEUDONYM_STEP);
            push(Event::IdentityChanged(alias, None));
        }
        match robot.phase() {
            Phase::Idle => {}
            Phase::Leading(leading) => {
                if left.disturbances > 0 {
                    push(Event::LeaveRequested);
                }
                let is_completed = leading.members.iter().any(Member::has_completed);
                let may_end = !scenario.cooperative || scenario.corridor || is_completed;
                let is_told_done = is_road_free || self.is_seen_by_all_guards(state);
                if may_end && is_told_done && !waits {
                    push(Event::TaskCompleted);
                }
                if left.commands > 0 {
                    for member in leading.members.iter() {
                        for task in scenario.request.tasks.iter() {
                            push(Event::CommandManeuver {
                                follower: member.station,
                                task,
                            });
                        }
                    }
                }
                if scenario.corridor {
                    push(Event::OpenCorridor);
                    if !scenario.cooperative {
                        push(Event::CloseCorridor);
                    }
                }
            }
            Phase::Requesting(_) | Phase::Offering(_) | Phase::Following(_) => {
                if node.is_requesting() && is_road_free && !scenario.cooperative {
                    push(Event::TaskCompleted);
                }
                if left.disturbances > 0 {
                    push(Event::LeaveRequested);
                }
            }
        }
    }
}

/// Whether the robot has been told that somebody is on the road, as a follower.
fn sees_people(node: &Node) -> bool {
    node.following()
        .is_some_and(|following| following.sees_people)
}

/// Whether a timer does not run out when messages arrive and every application does its part. The
/// others pace the robot's own work.
const fn guards_against_silence(timer: Timer) -> bool {
    !matches!(timer, Timer::Ram | Timer::Selection | Timer::Farewell)
}
