//! The steps of single robots, each computed once.
//!
//! A robot's step depends on its own state and input alone, and few such pairs occur over a whole
//! exploration. So each pair is put through the transition function once, judged once, and looked up
//! from then on.

use std::sync::Arc;

use crossguard_protocol::{Event, Input, Outputs, Timer};
use smallvec::SmallVec;

use crate::canonical::Renamings;
use crate::history::History;
use crate::memo::Memo;
use crate::node::Rules;
use crate::properties::{PropertyId, StepView};
use crate::robots::Robots;
use crate::scenario::Scenario;

/// Input of a robot, by number where it is a message.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Cause {
    Message(u16),
    Timer(Timer),
    Event(Event),
}

/// The effect of a robot's step, whatever has happened elsewhere.
pub(crate) struct ComputedStep {
    pub(crate) input: Input,
    /// Its outputs. Many steps have the same ones.
    pub(crate) outputs: Arc<Outputs>,
    /// The node after the step, without durations.
    pub(crate) after: u32,
    pub(crate) sends: SmallVec<[u16; 2]>,
    /// The timers that it armed, whether or not they had been armed before.
    pub(crate) restarted: SmallVec<[Timer; 4]>,
    /// Whether it changed nothing.
    pub(crate) is_ignored: bool,
    /// Whether what it means depends on the history, or changes it.
    pub(crate) is_historic: bool,
    /// Whether it changes no part of a state, whatever the rest of the state is.
    pub(crate) changes_nothing: bool,
    /// One bit for each step property whose premise it meets, as far as it depends on no history.
    pub(crate) premises: u64,
    /// One bit for each step property that it breaks, as far as it depends on no history.
    pub(crate) broken: u64,
}

/// All robots, messages and steps that have occurred.
pub(crate) struct Steps {
    pub(crate) robots: Robots,
    outputs: Memo<Outputs, Arc<Outputs>>,
    computed: Memo<(u32, Cause), ComputedStep>,
}

impl Steps {
    pub(crate) fn new(rules: Box<dyn Rules>, renamings: &Arc<Renamings>) -> Self {
        Self {
            robots: Robots::new(rules, renamings),
            outputs: Memo::default(),
            computed: Memo::default(),
        }
    }

    /// The step that a node takes; `None` when the robot is down.
    pub(crate) fn step(
        &self,
        scenario: &Scenario,
        node: u32,
        cause: Cause,
    ) -> Option<&ComputedStep> {
        if let Some(known) = self.computed.get(&(node, cause)) {
            return Some(known);
        }
        let step = self.compute(scenario, node, cause)?;
        Some(self.computed.keep((node, cause), step))
    }

    fn compute(&self, scenario: &Scenario, node: u32, cause: Cause) -> Option<ComputedStep> {
        let config = &scenario.config;
        let input = match cause {
            Cause::Message(number) => self.robots.message(number).input(),
            Cause::Timer(timer) => Input::Expired(timer),
            Cause::Event(event) => Input::Local(event),
        };
        let before = self.robots.nodes.value(node);
        let (after, outputs) = self.robots.step(config, node, input)?;
        let history = History::default();
        let view = StepView {
            config,
            history: &history,
            before,
            after: &after,
            input,
            outputs: &outputs,
        };
        let is_historic = view.is_historic();
        let (premises, broken) = judge(&scenario.properties, &view, is_historic);
        let sends = self.robots.sends(&after, &outputs);
        let restarted = after.restarted_timers();
        let after = self.robots.nodes.number(after.untimed());
        Some(ComputedStep {
            input,
            outputs: self.shared(&outputs),
            changes_nothing: after == node && sends.is_empty() && !is_historic && broken == 0,
            sends,
            restarted,
            is_ignored: outputs.ignored().is_some(),
            is_historic,
            premises,
            broken,
            after,
        })
    }

    fn shared(&self, outputs: &Outputs) -> Arc<Outputs> {
        let shared = self.outputs.get_or_compute(*outputs, |it| Arc::new(*it));
        Arc::clone(shared)
    }
}

/// Which step rules the step meets the premise of, and which of these it breaks. Rules that look at
/// the history are left to [`judge_historic`] where the step is historic; otherwise they say nothing.
pub(crate) fn judge(properties: &[PropertyId], view: &StepView, is_historic: bool) -> (u64, u64) {
    let (mut premises, mut broken) = (0, 0);
    for &property in properties {
        let Some(rule) = property.step_rule() else {
            continue;
        };
        if is_historic && rule.looks_back {
            continue;
        }
        if (rule.premise)(view) {
            premises |= property.bit();
            if !(rule.holds)(view) {
                broken |= property.bit();
            }
        }
    }
    (premises, broken)
}

/// The same for the rules that look at the history, in a step that is historic.
pub(crate) fn judge_historic(properties: &[PropertyId], view: &StepView) -> (u64, u64) {
    let looking_back: SmallVec<[PropertyId; 8]> = properties
        .iter()
        .copied()
        .filter(|property| property.step_rule().is_some_and(|rule| rule.looks_back))
        .collect();
    judge(&looking_back, view, false)
}
