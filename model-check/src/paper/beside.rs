//! The kit beside a run of the paper's wording: the same story through a scenario of the kit, up to the same disturbance.

use serde::Serialize;

use super::Counterexample;
use super::robot::PaperTask;
use crate::chart::{chart_step, names};
use crate::model::Model;
use crate::scenario::Scenario;
use crate::sequence::ChartStep;

/// A run of the kit that goes along with a run of the paper's wording.
#[derive(Clone, Debug, Serialize)]
pub struct KitRun {
    /// The scenario that it goes through.
    pub scenario: &'static str,
    /// Its steps, in order.
    pub steps: Vec<ChartStep>,
    /// How many of these steps are taken at the start, and after each step of the paper's run.
    pub taken: Vec<usize>,
}

/// Steps of the kit during each step of the paper's run, a line for each, as beginnings of lines of the kit's chart.
const REQUEST: &str = "\
robot 1: pedestrian detected
robot 1 -> robot 2: RAM
robot 2 -> robot 1: RAM | robot 1: timer selection
robot 1 -> robot 2: RAM | robot 2 -> robot 1: RAM
";

/// An escort needs no `initialPos` first. The sign says when somebody may go.
const ESCORT: &str = "\n\n\n\n
robot 1: command robot 2: move
robot 1 -> robot 2: RMCM | robot 2 -> robot 1: RMCM | robot 2 -> robot 1: RAM | robot 1: open corridor
";

/// The sign shows go no more, so nobody steps on the road.
const LEADER_LOSES_POWER: &str = "robot 1: crashes\n\n";

const ESCORT_TIMES_OUT: &str = "robot 1: at its sign\nrobot 2: timer safety\n";

/// The command comes after the timeout, and its acknowledgement opens nothing.
const GUARD_IS_ON_ITS_WAY: &str = "\
robot 1: command robot 2: initialPos
robot 1 -> robot 2: RMCM
robot 2 -> robot 1: RMCM | robot 2 -> robot 1: RAM
robot 2: completed command 0
robot 2 -> robot 1: RAM

robot 2: timer safety
robot 1: command robot 2: block | robot 1 -> robot 2: RMCM
robot 2 -> robot 1: RMCM | robot 2 -> robot 1: RAM

";

impl KitRun {
    /// The kit in the story of a run in which a person is on the road without a guard. `None` where there is no such story, or
    /// the protocol goes another way.
    pub(super) fn beside(found: &Counterexample) -> Option<Self> {
        let is_escorted = found.cast.plan.contains(&PaperTask::Move);
        let (scenario, story) = match (&*found.text.id, is_escorted) {
            ("W1", true) => ("leader-crash", [REQUEST, ESCORT, LEADER_LOSES_POWER]),
            ("W1", false) => ("blocker", [REQUEST, GUARD_IS_ON_ITS_WAY, ""]),
            ("W2", _) => ("pair", [REQUEST, ESCORT, ESCORT_TIMES_OUT]),
            _ => return None,
        };
        let model = Model::new(Scenario::load(scenario).ok()?);
        let robots = names(model.scenario());
        let mut state = model.initial();
        let (mut steps, mut taken) = (Vec::new(), vec![0]);
        for line in story.concat().lines() {
            for begins in line.split(" | ").filter(|it| !it.is_empty()) {
                let mut actions = Vec::new();
                model.actions_in(&state, &mut actions);
                let step = |action| chart_step(&model, &state, action);
                let mut possible = actions.into_iter().filter_map(step);
                let is_meant = |step: &ChartStep| step.line(&robots).starts_with(begins);
                let (next, step) = possible.find(|(_, step)| is_meant(step))?;
                state = next;
                steps.push(step);
            }
            taken.push(steps.len());
        }
        Some(Self {
            scenario,
            steps,
            taken,
        })
    }
}
