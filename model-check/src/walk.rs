//! A walk through a scenario, step by step: what each robot is doing after each step, and what may happen next.
//!
//! The steps are those of a [`Replay`](crate::replay::Replay), so a walk is kept and followed like a counterexample.
//! Nothing is stored between two walks: to go one step further, a caller walks again from the start.

mod ask;
mod by_itself;

use crossguard_protocol::{Availability, FallbackPolicy, Robot, Role, State, StationId};
use serde::{Deserialize, Serialize};

use crate::chart::{chart, chart_step, names, said};
use crate::model::{Model, ModelState};
use crate::names::Names;
use crate::network::Transmission;
use crate::node::Node;
use crate::properties::PropertyId;
use crate::replay::follow;
use crate::road::{Body, Pedestrian};
use crate::scenario::{Bounds, Scenario};
use crate::sequence::ChartStep;

pub use ask::{Refusal, ask};
pub use by_itself::{Chances, next_step};

/// A scenario on its way.
#[derive(Clone, Debug, Serialize)]
pub struct Walk {
    /// The scenario's name.
    pub scenario: String,
    /// The scenario's subject, in one line.
    pub summary: String,
    /// The robots' names, in the order of their places.
    pub robots: Vec<String>,
    /// Frames at the start, and after each step.
    pub frames: Vec<WalkFrame>,
    /// The steps that may follow; empty also where the last step broke a property of steps.
    pub possible: Vec<ChartStep>,
    /// Where the walk left the scenario, if it did. The frames end before that step.
    pub stray: Option<Stray>,
}

/// The scenario in one state.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct WalkFrame {
    /// The robots, in the order of their places.
    pub robots: Vec<RobotFrame>,
    /// The messages on air, in the order of sending.
    pub on_air: Vec<OnItsWay>,
    /// The messages that are delayed.
    pub delayed: Vec<OnItsWay>,
    /// The person at the crossing.
    pub person: PersonFrame,
    /// The ids of the properties whose premise the step, or the state after it, meets.
    pub met: Vec<&'static str>,
    /// The ids of the properties that the step or the state breaks.
    pub broken: Vec<&'static str>,
    /// How often what may still happen.
    pub left: Bounds,
}

/// One robot in one state.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
#[expect(
    clippy::struct_excessive_bools,
    reason = "facts that have nothing to do with each other"
)]
pub struct RobotFrame {
    /// Its station id. It changes with its pseudonym.
    pub station: StationId,
    /// The state of the paper's machine.
    pub state: &'static str,
    /// Its side in that state: `leader`, `follower`, `requester`, `helper`; empty where it has none.
    pub role: &'static str,
    /// Protocol state and body in full, in words.
    pub words: String,
    /// The timers that run.
    pub timers: Vec<String>,
    /// Activity of its body.
    pub body: BodyFrame,
    /// Whether its body guards who is on the road, or would: in its place, beside a person, or in a fallback that stays.
    pub guards: bool,
    /// Whether it guards by going with people: on its way, or back to the kerb.
    pub escorts: bool,
    /// Activity of its body with the maneuver, in words.
    pub body_words: String,
    /// Whether its sign shows go.
    pub shows_go: bool,
    /// Whether it has crashed and not booted again.
    pub is_down: bool,
    /// Whether it hangs.
    pub hangs: bool,
    /// Whether it takes part in coordination.
    pub is_available: bool,
    /// Whether its application has not yet said that the road is clear.
    pub on_duty: bool,
    /// Whether it follows and has lost contact with its leader.
    pub lost_contact: bool,
}

/// Activity of a body.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
#[allow(missing_docs, reason = "as in Body")]
pub enum BodyFrame {
    Parked,
    UnderWay,
    InPosition,
    FallingBack,
    Ended,
}

/// The person at the crossing.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub enum PersonFrame {
    /// Waits for a sign that shows go.
    Waiting,
    /// Is on the road, at the sign of the robot at this place.
    OnRoad(Option<usize>),
    /// Has crossed.
    Across,
}

/// A message on its way; robots by their places.
#[derive(Clone, Debug, Serialize)]
pub struct OnItsWay {
    /// The sender.
    pub from: u8,
    /// The receiver.
    pub to: u8,
    /// The message, in words.
    pub text: String,
}

/// Where a walk left its scenario.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Stray {
    /// The step, counted from 0.
    pub step: usize,
    /// The robot's outputs in this step now; `None` where the step cannot happen at all.
    pub puts_out: Option<Vec<String>>,
}

impl Walk {
    /// Follows `steps` through an untimed scenario, as far as that goes.
    #[must_use]
    pub fn along(scenario: Scenario, steps: &[ChartStep]) -> Self {
        // A model of its own: it notes which premises are met.
        let model = Model::new(scenario);
        let mut state = model.initial();
        let mut frames = vec![WalkFrame::of(&model, &state)];
        let mut show = |state: &ModelState| frames.push(WalkFrame::of(&model, state));
        let stray = follow(&model, steps, &mut state, &mut show);
        let stray = stray.map(|(step, puts_out)| Stray { step, puts_out });
        let scenario = model.scenario();
        Self {
            scenario: scenario.name.clone(),
            summary: scenario.summary.clone(),
            robots: names(scenario),
            possible: possible(&model, &state),
            frames,
            stray,
        }
    }
}

impl WalkFrame {
    /// Premises count that were met since the last frame of the model.
    fn of(model: &Model, state: &ModelState) -> Self {
        let broken: Vec<_> = model.broken_by(state).collect();
        let met = model.newly_met();
        let (on_air, delayed) = model.on_their_way(state);
        let settings = model.scenario().config.settings();
        let on_road = model.history(state).pedestrian.on_road();
        let robot = |(place, node): (usize, &Node)| {
            let guarding = node.actuation.body.guards_still(settings);
            let guards = guarding.is_some_and(|it| on_road.is_none_or(|on| on == it.id.session));
            RobotFrame::of(model.names(), node, guards, state.hangs(place))
        };
        Self {
            robots: model.nodes(state).enumerate().map(robot).collect(),
            on_air: OnItsWay::all(model, &on_air),
            delayed: OnItsWay::all(model, &delayed),
            person: match model.history(state).pedestrian {
                Pedestrian::Waiting => PersonFrame::Waiting,
                Pedestrian::OnRoad(session) => {
                    PersonFrame::OnRoad(model.scenario().place_of(session.leader))
                }
                Pedestrian::Across => PersonFrame::Across,
            },
            met: met.into_iter().map(PropertyId::name).collect(),
            broken: broken.into_iter().map(PropertyId::name).collect(),
            left: state.left(),
        }
    }
}

impl RobotFrame {
    fn of(names: &Names, node: &Node, guards: bool, hangs: bool) -> Self {
        let robot = node.robot.as_ref();
        let state = robot.map_or(State::Idle, Robot::state);
        let role = robot.map(Robot::role).filter(|role| *role != Role::None);
        let timers = node.timers();
        Self {
            station: node.persisted.station,
            state: state.name(),
            role: role.map_or("", Role::name),
            words: names.tell(node),
            timers: timers.iter().map(|(timer, _)| names.tell(timer)).collect(),
            body: match node.actuation.body {
                Body::Parked => BodyFrame::Parked,
                Body::UnderWay(_) | Body::OutOfPosition(_) => BodyFrame::UnderWay,
                Body::InPosition(_) => BodyFrame::InPosition,
                Body::FallingBack(..) => BodyFrame::FallingBack,
                Body::Ended(..) => BodyFrame::Ended,
            },
            guards,
            escorts: guards
                && matches!(
                    node.actuation.body,
                    Body::UnderWay(_) | Body::FallingBack(_, FallbackPolicy::EscortToKerb)
                ),
            body_words: names.tell(node.actuation.body),
            shows_go: node.actuation.corridor_open,
            is_down: robot.is_none(),
            hangs,
            is_available: robot.is_none_or(|robot| robot.availability() == Availability::Available),
            on_duty: node.actuation.road_unsure,
            lost_contact: node.has_lost_contact(),
        }
    }
}

impl OnItsWay {
    fn all(model: &Model, transmissions: &[Transmission]) -> Vec<Self> {
        let of = |it: &Transmission| Self {
            from: it.from,
            to: it.to,
            text: said(model.names(), &model.message(it.message).input()),
        };
        transmissions.iter().map(of).collect()
    }
}

fn possible(model: &Model, state: &ModelState) -> Vec<ChartStep> {
    let mut actions = Vec::new();
    model.actions_in(state, &mut actions);
    let step = |action| Some(chart_step(model, state, action)?.1);
    actions.into_iter().filter_map(step).collect()
}

/// Goal of a search in a scenario.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub enum Goal {
    /// The robot at a place is in a state of the paper's machine.
    Robot {
        /// Its place in the scenario, from 0.
        place: usize,
        /// The state.
        state: State,
        /// The side in it, where that matters.
        role: Option<Role>,
    },
    /// A person is on the road.
    PersonOnRoad,
    /// A robot's sign shows go.
    ShowsGo,
    /// A body falls back.
    FallsBack,
}

/// Result of a search.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Search {
    /// A shortest way there; `None` where none was found.
    pub steps: Option<Vec<ChartStep>>,
    /// How many states were looked at.
    pub states: usize,
    /// Whether all states were looked at, so that a goal that was not found is not there.
    pub is_complete: bool,
}

/// Looks for the first state that meets a goal, in order of distance from the start, in at most this many states.
#[must_use]
pub fn search(scenario: Scenario, goal: Goal, states_max: usize) -> Search {
    let model = Model::new(scenario);
    let mut reachable = model.reachable();
    let mut search = Search {
        steps: None,
        states: 0,
        is_complete: true,
    };
    while let Some(state) = reachable.next() {
        if goal.is_met(&model, &state) {
            search.steps = Some(chart(&model, reachable.run()));
            break;
        }
        if reachable.found() >= states_max {
            search.is_complete = false;
            break;
        }
        search.states += 1;
    }
    search
}

impl Goal {
    fn is_met(self, model: &Model, found: &ModelState) -> bool {
        let nodes = model.nodes(found);
        let any = |is: fn(&Node) -> bool| nodes.clone().any(is);
        match self {
            Self::Robot { place, state, role } => {
                let node = nodes.clone().nth(place);
                let robot = node.and_then(|node| node.robot.as_ref());
                robot.is_some_and(|robot| {
                    robot.state() == state && role.is_none_or(|role| robot.role() == role)
                })
            }
            Self::PersonOnRoad => model.history(found).pedestrian.on_road().is_some(),
            Self::ShowsGo => any(|node| node.actuation.corridor_open),
            Self::FallsBack => any(|node| matches!(node.actuation.body, Body::FallingBack(..))),
        }
    }
}
