//! What is wrong with a body that is another process: one that is silent is an emergency stop of its robot.

use std::borrow::Cow;

use crossguard_endpoint::cause::Cause;
use crossguard_protocol::{Availability, Event, Unavailability};

use super::{Application, Stimulus};
use crate::body::Report;

/// How many troubles wait to be counted; a body that makes more of them at a time is counted for these.
const TROUBLES: usize = 64;

#[derive(Debug, Default)]
pub(super) struct Bodily {
    /// What its robot has to be unavailable for while the body is not there.
    missing: Option<Unavailability>,
    troubles: Vec<(Cause, Cow<'static, str>)>,
}

impl Application {
    /// Takes in what the body says besides how maneuvers go.
    pub(super) fn learn_of_body(&mut self, report: Report) {
        let (cause, what): (_, Cow<'static, str>) = match report {
            Report::InPosition(_) | Report::Completed(_) => return self.feel_maneuver(&report),
            Report::Failed(id) => return self.wish(Stimulus::Event(Event::ManeuverFailed(id))),
            // Nothing is wrong with a body that was not started yet, but its robot takes no part.
            Report::Absent => {
                self.bodily.missing = Some(Unavailability::LocalFault);
                return;
            }
            Report::Here => {
                // A stop ends by the word of a person.
                if self.bodily.missing.take() == Some(Unavailability::LocalFault) {
                    self.wish_available(Availability::Available);
                }
                return;
            }
            Report::Silent => {
                self.feel_maneuver(&report);
                self.bodily.missing = Some(Unavailability::EmergencyStop);
                let what = "nothing was heard of the body: emergency stop";
                (Cause::BodySilent, what.into())
            }
            Report::Fault(what) => {
                self.wish_available(Availability::Unavailable(Unavailability::LocalFault));
                (Cause::BodyFault, what.into())
            }
            Report::Garbled(why) => (Cause::BodyGarbled, why.into()),
            Report::Stranger(uid) => (
                Cause::BodyStranger,
                format!("user {uid} is not the robot's: refused").into(),
            ),
        };
        self.trouble(cause, what);
    }

    /// Something is to be counted.
    pub(super) fn trouble(&mut self, cause: Cause, what: impl Into<Cow<'static, str>>) {
        if self.bodily.troubles.len() < TROUBLES {
            self.bodily.troubles.push((cause, what.into()));
        }
    }

    /// While the body is not there its robot is unavailable, whatever anybody says.
    pub(super) fn watch_body(&mut self) {
        let Some(reason) = self.bodily.missing else {
            return;
        };
        let wanted = Availability::Unavailable(reason);
        if self.availability != wanted {
            self.wish_available(wanted);
        }
    }

    /// Before anything else that it wants.
    fn wish_available(&mut self, availability: Availability) {
        self.wishes
            .push_front(Stimulus::Event(Event::AvailabilityChanged(availability)));
    }

    /// The next thing that went wrong with the body, to be counted.
    pub(crate) fn next_trouble(&mut self) -> Option<(Cause, Cow<'static, str>)> {
        self.bodily.troubles.pop()
    }
}
