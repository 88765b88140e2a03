//! People on the road, as far as logs tell of them: no log shows anybody. So whenever a sign begins to show go,
//! somebody is taken to step on the road, and to be there until an application of that session says that its
//! maneuver or task is done, or that the road is clear. Between the two, W1, W2 and W4 are judged as they are
//! in the model checker.

use std::collections::BTreeSet;

use crossguard_model_check::monitor::Monitor;
use crossguard_model_check::properties::PropertyId;
use crossguard_protocol::{Duty, Event, Input, Output, Outputs, Phase, Robot, SessionId};

/// Where people may be.
#[derive(Default)]
pub(super) struct Crossings(BTreeSet<SessionId>);

impl Crossings {
    /// A robot in the state `before` is about to be told `input`.
    pub(super) fn told(&mut self, before: &Robot, input: Input, monitor: &mut Monitor) {
        let Input::Local(event) = input else { return };
        let session = match event {
            Event::ManeuverCompleted(id) => Some(id.session),
            Event::TaskCompleted => before.session(),
            Event::RoadClear => match before.duty() {
                Some(Duty::Crossing(session)) => Some(session),
                Some(Duty::FallingBack(maneuver)) => Some(maneuver.id.session),
                None => before.session(),
            },
            _ => None,
        };
        if let Some(session) = session
            && self.0.remove(&session)
        {
            monitor.is_across(session);
        }
    }

    /// Takes in outputs that lead to the state `after`. Returns the property that a step on the road breaks now.
    pub(super) fn shown(
        &mut self,
        outputs: &Outputs,
        after: &Robot,
        monitor: &mut Monitor,
    ) -> Option<PropertyId> {
        let (session, Phase::Leading(leading)) = (after.session()?, after.phase()) else {
            return None;
        };
        if !outputs.iter().any(is_go) || !self.0.insert(session) {
            return None;
        }
        monitor.step_on_road(session, usize::from(leading.request.followers))
    }
}

fn is_go(output: &Output) -> bool {
    matches!(output, Output::CorridorOpened(_))
}

#[cfg(test)]
mod tests {
    use crossguard_robot::trace::Entry;

    use super::super::tests::{records, text};
    use super::*;

    /// Outputs of the first leader to show go, and its state then.
    fn first_go() -> (Outputs, Robot) {
        let gos = (1..100)
            .flat_map(records)
            .find_map(|record| match record.entry {
                Entry::Step { outputs, state, .. } => {
                    outputs.iter().any(is_go).then_some((*outputs, *state))
                }
                _ => None,
            });
        gos.expect("no leader of a hundred runs shows go")
    }

    #[test]
    fn somebody_steps_on_the_road_once_for_each_crossing_that_begins() {
        let (outputs, leader) = first_go();
        let nobody_guards = Some(PropertyId::W1);
        let (mut road, mut monitor) = (Crossings::default(), Monitor::new(false));
        assert_eq!(road.shown(&outputs, &leader, &mut monitor), nobody_guards);
        // The sign shows go anew while they are still on the road.
        assert_eq!(road.shown(&outputs, &leader, &mut monitor), None);
        road.told(&leader, Input::Local(Event::OpenCorridor), &mut monitor);
        assert_eq!(road.shown(&outputs, &leader, &mut monitor), None);
        for is_clear in [Event::TaskCompleted, Event::RoadClear] {
            road.told(&leader, Input::Local(is_clear), &mut monitor);
            assert_eq!(road.shown(&outputs, &leader, &mut monitor), nobody_guards);
        }
    }

    #[test]
    fn a_sign_that_does_not_begin_to_show_go_sends_nobody() {
        let (_, leader) = first_go();
        let (mut road, mut monitor) = (Crossings::default(), Monitor::new(false));
        assert_eq!(road.shown(&Outputs::default(), &leader, &mut monitor), None);
    }

    #[test]
    fn logs_of_crossings_put_the_properties_of_the_road_to_the_test() {
        let mut met = BTreeSet::new();
        for seed in 1..=40 {
            let log = text(&records(seed));
            met.extend(crate::validate::one(&*log).unwrap().properties);
        }
        for id in ["W1", "W2", "W4"] {
            assert!(met.contains(id), "{id} is not among {met:?}");
        }
    }
}
