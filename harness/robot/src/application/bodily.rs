//! Faults of a body that is another process: a silent body is an emergency stop of its robot.

use std::borrow::Cow;
use std::collections::VecDeque;

use crossguard_endpoint::cause::Cause;
use crossguard_protocol::{Availability, Event, Unavailability};

use super::{Application, Stimulus};
use crate::body::Report;

/// A cause, what it was about, and how often it happened.
pub(crate) type Trouble = (Cause, Cow<'static, str>, u64);

#[derive(Debug, Default)]
pub(super) struct Bodily {
    /// Reason why its robot is unavailable while the body is not there.
    missing: Option<Unavailability>,
    /// The availability that the endpoint is to be told.
    untold: Option<Availability>,
    /// Troubles that wait to be counted, and how often each happened.
    troubles: VecDeque<Trouble>,
}

impl Application {
    /// Takes in what the body says besides how maneuvers go.
    pub(super) fn learn_of_body(&mut self, report: Report) {
        let (cause, what, count) = match report {
            Report::InPosition(_) | Report::Completed(_) => return self.feel_maneuver(&report),
            Report::Failed(id) => return self.wish(Stimulus::Event(Event::ManeuverFailed(id))),
            // Nothing is wrong with a body that was not started yet, but its robot takes no part.
            Report::Absent => {
                self.bodily.missing = Some(Unavailability::LocalFault);
                return;
            }
            Report::Here => {
                // A stop ends by the word of a person, also one that was told before the body came.
                let was_absent = self.bodily.missing == Some(Unavailability::LocalFault);
                if was_absent && !self.is_held_besides() {
                    self.wish_available(Availability::Available);
                }
                self.bodily.missing = None;
                return;
            }
            Report::Silent(ref why) => {
                self.feel_maneuver(&report);
                self.bodily.missing = Some(Unavailability::EmergencyStop);
                (Cause::BodySilent, format!("{why}: emergency stop"), 1)
            }
            Report::Fault(what) => {
                self.wish_available(Availability::Unavailable(Unavailability::LocalFault));
                (Cause::BodyFault, what, 1)
            }
            Report::Dropped(cause, what, count) => (cause, what, count),
        };
        self.trouble(cause, what, count);
    }

    /// Notes a trouble to be counted. A repeated trouble has one entry.
    pub(super) fn trouble(&mut self, cause: Cause, what: impl Into<Cow<'static, str>>, count: u64) {
        let (troubles, what) = (&mut self.bodily.troubles, what.into());
        match troubles.iter_mut().find(|it| it.0 == cause && it.1 == what) {
            Some((.., counted)) => *counted += count,
            None => troubles.push_back((cause, what, count)),
        }
    }

    /// While the body is not there its robot is unavailable, whatever anybody says.
    pub(super) fn watch_body(&mut self) {
        let Some(reason) = self.bodily.missing else {
            return;
        };
        let wanted = Availability::Unavailable(reason);
        if self.availability != wanted && !self.is_held_besides() {
            self.wish_available(wanted);
        }
    }

    /// Whether its robot takes no part for another reason than that its body was not started yet.
    fn is_held_besides(&self) -> bool {
        let absent = Unavailability::LocalFault;
        self.bodily.missing == Some(absent)
            && ![Availability::Available, Availability::Unavailable(absent)]
                .contains(&self.availability)
    }

    /// Before anything else that it wants. 'Cannot take part' outlasts 'can': both may come about in one turn.
    pub(super) fn wish_available(&mut self, availability: Availability) {
        let cannot = |it: Availability| it != Availability::Available;
        if cannot(availability) || !self.bodily.untold.is_some_and(cannot) {
            self.bodily.untold = Some(availability);
        }
    }

    /// The availability that its endpoint has not been told.
    pub(super) fn next_availability(&mut self) -> Option<Stimulus<'static>> {
        let availability = self.bodily.untold.take()?;
        let changed = Event::AvailabilityChanged(availability);
        Some(Stimulus::Event(changed))
    }

    /// The next thing that went wrong with the body, to be counted.
    pub(crate) fn next_trouble(&mut self) -> Option<Trouble> {
        self.bodily.troubles.pop_front()
    }
}
