//! The next step where nobody chooses: a crossing goes on by its plan, and now and then something else happens.

use crossguard_protocol::{Availability, Event, Member, Order, Phase, Progress, Timer};
use serde::Deserialize;

use crate::chart::{ACROSS, chart_step};
use crate::model::{Action, Delivery, Model, ModelState};
use crate::node::Node;
use crate::replay::follow;
use crate::scenario::Scenario;
use crate::sequence::ChartStep;

/// How often something happens that no crossing needs, in percent of the steps off air.
const ASIDE_PERCENT: u64 = 3;
/// How often time passes although somebody has something to do, in percent of the steps off air.
const WAITS_PERCENT: u64 = 12;

/// How likely it is what.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Chances {
    /// The same seed has the same steps.
    pub seed: u64,
    /// How many messages get lost, in percent.
    pub loss: u8,
    /// How many messages are delayed, in percent.
    pub delay: u8,
    /// Whether robots crash and hang.
    pub breakdowns: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Part {
    Plan,
    /// Time passes: robots repeat what they said, and what was late arrives.
    Time,
    /// Nothing: something fails, ends early, or changes.
    Aside,
    Breakdown,
}

/// The next step of a run by itself; `None` once somebody is across and all robots are idle, or where nothing may happen.
#[must_use]
pub fn next_step(scenario: Scenario, steps: &[ChartStep], chances: Chances) -> Option<ChartStep> {
    let model = Model::new(scenario);
    let mut state = model.initial();
    if follow(&model, steps, &mut state, &mut |_| ()).is_some() {
        return None;
    }
    // The step says which number of the seed's sequence it takes.
    let roll = |salt, below| draw(chances.seed, steps.len() as u64 * 4 + salt) % below;
    let mut actions = Vec::new();
    model.actions_in(&state, &mut actions);
    let made = |action: &Action| Some(chart_step(&model, &state, *action)?.1);
    if model.is_on_air(&state) {
        let is_lost = roll(0, 100) < chances.loss.into();
        let is_late = roll(1, 100) < chances.delay.into();
        let rank = |action: &Action| match action {
            Action::Lose(_) => u8::from(!is_lost) * 3,
            Action::Delay(_) => 1 + u8::from(!is_late) * 3,
            Action::Lie(_) => 5,
            _ => 2,
        };
        actions.sort_by_key(rank);
        return actions.iter().find_map(made);
    }
    let has_crossed = steps.iter().any(|step| step.action == ACROSS);
    let is_over = |node: &Node| node.is_idle() && !node.actuation.road_unsure;
    if has_crossed && model.nodes(&state).all(is_over) {
        return None;
    }
    let of = |part: Part| -> Vec<ChartStep> {
        let is_it = |action: &&Action| part_of(&model, &state, has_crossed, **action) == part;
        actions.iter().filter(is_it).filter_map(made).collect()
    };
    let percent = roll(2, 100);
    let order = if percent < ASIDE_PERCENT {
        [Part::Aside, Part::Plan, Part::Time]
    } else if percent < ASIDE_PERCENT + WAITS_PERCENT {
        [Part::Time, Part::Plan, Part::Aside]
    } else {
        [Part::Plan, Part::Time, Part::Aside]
    };
    let breaks_down = chances.breakdowns && percent == 99;
    let parts = breaks_down.then_some(Part::Breakdown).into_iter();
    let mut ways = parts.chain(order).map(of);
    let ways = ways.find(|ways| !ways.is_empty())?;
    let which = roll(3, ways.len() as u64);
    ways.into_iter().nth(usize::try_from(which).ok()?)
}

/// The part in a session of the robot at a place; `None` while it is down.
fn phase_of<'a>(model: &'a Model, state: &'a ModelState, place: u8) -> Option<&'a Phase> {
    model.nodes(state).nth(place.into())?.phase()
}

/// Part of an action in a crossing of one person.
fn part_of(model: &Model, state: &ModelState, has_crossed: bool, action: Action) -> Part {
    let has_offers = |place| match phase_of(model, state, place) {
        Some(Phase::Requesting(it)) => it.offers.iter().count() >= it.request.followers.into(),
        _ => false,
    };
    match action {
        Action::Across(_) => Part::Plan,
        Action::StepOnRoad(_) if !has_crossed => Part::Plan,
        Action::Expire(place, Timer::Selection) if has_offers(place) => Part::Plan,
        Action::Deliver {
            how: Delivery::AtOnce | Delivery::Late | Delivery::AnyTime,
            ..
        }
        | Action::Resume(_)
        | Action::Restart(_)
        | Action::Expire(
            _,
            Timer::Ram | Timer::Selection | Timer::Acknowledgement(_) | Timer::Farewell,
        ) => Part::Time,
        Action::Local(robot, event) => part_of_event(model, state, has_crossed, (robot, event)),
        Action::Crash(_) | Action::Hang(_) => Part::Breakdown,
        _ => Part::Aside,
    }
}

fn part_of_event(
    model: &Model,
    state: &ModelState,
    has_crossed: bool,
    (robot, event): (u8, Event),
) -> Part {
    let settings = model.scenario().config.settings();
    let is_next = match event {
        Event::PedestrianDetected(_) => !has_crossed && model.nodes(state).all(Node::is_idle),
        // One command for each follower; another where it came to nothing.
        Event::CommandManeuver { follower, .. } => {
            let Some(Phase::Leading(leading)) = phase_of(model, state, robot) else {
                return Part::Aside;
            };
            let mut members = leading.members.iter();
            let member = members.find(|member| member.station == follower);
            let is_busy = |order: &Order| order.progress.is_none_or(Progress::is_running);
            let is_free = |member: &Member| !member.order.as_ref().is_some_and(is_busy);
            !has_crossed && member.is_some_and(is_free)
        }
        // An escort goes on until its person is across.
        Event::ManeuverCompleted(id) => {
            let mut bodies = model.nodes(state).map(|node| node.actuation.body);
            let running = bodies.find_map(|body| body.running().filter(|it| it.id == id));
            has_crossed || running.is_some_and(|it| !settings.guarding.contains(it.task))
        }
        Event::InPosition(_) | Event::OpenCorridor => !has_crossed,
        Event::TaskCompleted | Event::CloseCorridor => has_crossed,
        Event::RoadClear => true,
        // A leader gives a team up that has become too small.
        Event::LeaveRequested => {
            return match phase_of(model, state, robot) {
                Some(Phase::Leading(it))
                    if it.members.iter().count() < it.request.followers.into() =>
                {
                    Part::Time
                }
                _ => Part::Aside,
            };
        }
        Event::AvailabilityChanged(Availability::Available) | Event::PersonOnRoad => {
            return Part::Time;
        }
        _ => false,
    };
    if is_next { Part::Plan } else { Part::Aside }
}

/// The number at a place of a seed's sequence (`SplitMix64`).
const fn draw(seed: u64, place: u64) -> u64 {
    let mut z = seed
        .wrapping_mul(0xd134_2543_de82_ef95)
        .wrapping_add(place.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
