//! View of rules without time: a state, a robot's step, and the robots that a liveness property is about.

use crossguard_protocol::{
    Config, Event, Following, Input, Leading, Maneuver, ManeuverId, Notice, Output, Outputs,
    Progress, Rmcm, Robot, SessionId, StationId,
};

use crate::history::{History, told_end, told_on_its_way};
use crate::node::Node;

/// The robots that a liveness property speaks about, one at a time.
#[derive(Clone, Copy, Debug)]
pub(crate) enum LivenessSubjects {
    Robots,
    /// Each two robots, either way round.
    Pairs,
}

/// One of them, by their places in the scenario; `other` means nothing where only one is meant.
#[derive(Clone, Copy)]
pub(crate) struct LivenessSubject {
    pub(crate) robot: usize,
    pub(crate) other: usize,
}

impl LivenessSubjects {
    pub(crate) fn among(self, robots: usize) -> Vec<LivenessSubject> {
        let pairs = (0..robots).flat_map(|robot| (0..robots).map(move |other| (robot, other)));
        pairs
            .filter(|(robot, other)| match self {
                Self::Robots => robot == other,
                Self::Pairs => robot != other,
            })
            .map(|(robot, other)| LivenessSubject { robot, other })
            .collect()
    }
}

#[derive(Clone, Copy)]
pub(crate) struct View<'a> {
    /// The robots, in the order of their places.
    pub(crate) nodes: &'a [&'a Node],
    pub(crate) history: &'a History,
    pub(crate) world: &'a dyn Surroundings,
}

/// Environment of the robots of a state.
pub(crate) trait Surroundings {
    fn config(&self, place: usize) -> &Config;

    /// Whether some message or timer changes the state, without any application's help.
    fn can_progress(&self) -> bool;

    /// Place of the robot that has this station id, or had it before it changed its pseudonym.
    fn place_of(&self, station: StationId) -> Option<usize>;

    /// Whether no robot that is down boots again.
    fn restarts_are_over(&self) -> bool;

    /// Whether the station of this id is an insider that lies.
    fn lies(&self, station: StationId) -> bool;
}

impl<'a> View<'a> {
    pub(crate) fn nodes(&self) -> impl Iterator<Item = &'a Node> + Clone + use<'a> {
        self.nodes.iter().copied()
    }

    pub(crate) fn configured(
        &self,
    ) -> impl Iterator<Item = (&'a Node, &'a Config)> + Clone + use<'a> {
        let world = self.world;
        let places = self.nodes.iter().enumerate();
        places.map(move |(place, node)| (*node, world.config(place)))
    }

    pub(crate) fn node(&self, place: usize) -> &'a Node {
        self.nodes[place]
    }

    /// The robots that are up.
    pub(crate) fn robots(&self) -> impl Iterator<Item = &'a Robot> + Clone + use<'a> {
        self.nodes().filter_map(|node| node.robot.as_ref())
    }

    pub(crate) fn leaders(
        &self,
    ) -> impl Iterator<Item = (SessionId, &'a Leading)> + Clone + use<'a> {
        self.nodes()
            .filter_map(|node| Some((node.session()?, node.leading()?)))
    }

    pub(crate) fn followers(
        &self,
    ) -> impl Iterator<Item = (&'a Robot, &'a Following)> + Clone + use<'a> {
        self.nodes()
            .filter_map(|node| Some((node.robot.as_ref()?, node.following()?)))
    }

    /// The acknowledged command of each follower that has one, with its progress, as the leader knows it.
    pub(crate) fn orders(
        &self,
    ) -> impl Iterator<Item = (StationId, ManeuverId, Option<Progress>)> + use<'a> {
        self.leaders().flat_map(|(session, leading)| {
            leading.members.iter().filter_map(move |member| {
                let order = member.order?;
                let id = ManeuverId::of(session, order.request);
                Some((member.station, id, order.progress))
            })
        })
    }

    pub(crate) fn history(&self) -> &'a History {
        self.history
    }
}

#[derive(Clone, Copy)]
pub(crate) struct StepView<'a> {
    pub(crate) config: &'a Config,
    /// The history before the step.
    pub(crate) history: &'a History,
    pub(crate) before: &'a Node,
    pub(crate) after: &'a Node,
    pub(crate) input: Input,
    pub(crate) outputs: &'a Outputs,
}

impl<'a> StepView<'a> {
    pub(crate) fn started(&self) -> Option<Maneuver> {
        self.outputs.iter().find_map(|output| match output {
            Output::StartManeuver(maneuver) => Some(*maneuver),
            _ => None,
        })
    }

    /// The station that said what the robot took in.
    pub(crate) const fn sender(&self) -> Option<StationId> {
        match self.input {
            Input::Ram { ram, .. } => Some(ram.station),
            Input::Rmcm(Rmcm::Command(command)) => Some(command.session.leader),
            Input::Rmcm(Rmcm::Answer(answer)) => Some(answer.from),
            Input::Expired(_) | Input::Elapsed(_) | Input::Local(_) => None,
        }
    }

    /// Whether the step is one that the history records, or that a rule may look back from.
    pub(crate) fn is_historic(&self) -> bool {
        let reports = matches!(
            self.input,
            Input::Local(
                Event::ManeuverCompleted(_) | Event::InPosition(_) | Event::OutOfPosition(_)
            )
        );
        let on_its_way = |robot| told_on_its_way(robot, self.input).is_some();
        reports
            || self.after.robot.as_ref().is_some_and(on_its_way)
            || told_end(self.before.persisted.station, self.input).is_some()
            || self.outputs.iter().any(|output| {
                matches!(
                    output,
                    Output::SendRmcm(_)
                        | Output::StartManeuver(_)
                        | Output::StopManeuver(..)
                        | Output::FallBack(..)
                        | Output::Notify(Notice::RolesEstablished(_) | Notice::FollowerGone(..))
                )
            })
    }

    pub(crate) fn history_after(&self) -> History {
        let mut history = self.history.clone();
        if let (Some(before), Some(after)) = (&self.before.robot, &self.after.robot) {
            history.record_step(before, after, self.input, self.outputs);
        }
        history
    }

    pub(crate) fn notices(&self) -> impl Iterator<Item = Notice> + use<'_, 'a> {
        self.outputs.notices()
    }
}

/// Whether one robot leads and another follows.
pub(crate) fn is_team(view: &View) -> bool {
    view.leaders().next().is_some() && view.followers().next().is_some()
}
