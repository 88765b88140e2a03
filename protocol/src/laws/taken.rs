//! One step, as the laws read it.

use crate::config::Config;
use crate::id::{OfferNumber, SessionId, StationId};
use crate::input::Input;
use crate::message::{Coordination, Rmcm};
use crate::output::{Ignored, Output, OutputKind, Sink};
use crate::state::Robot;

use super::watch::Watch;

/// One step: the state before, the input, and what came of it.
#[derive(Clone, Debug)]
pub struct Taken {
    /// The state before.
    pub before: Robot,
    /// The input.
    pub input: Input,
    /// The outputs.
    pub said: Watch,
    /// The state after.
    pub after: Robot,
}

impl Taken {
    /// Takes the step.
    #[must_use]
    pub fn new(config: &Config, before: Robot, input: Input) -> Self {
        let mut after = before.clone();
        let mut said = Watch::new(&before, &input);
        after.step_into(config, input, &mut said);
        Self {
            before,
            input,
            said,
            after,
        }
    }

    /// The step in which the input is ignored, for whatever cause.
    #[must_use]
    pub fn ignored(before: Robot, input: Input) -> Self {
        let mut said = Watch::new(&before, &input);
        said.push(Output::Ignored(Ignored::NothingNew));
        Self {
            after: before.clone(),
            before,
            input,
            said,
        }
    }

    /// The station that sent the message which is the input.
    pub(super) const fn sender(&self) -> Option<StationId> {
        Some(match &self.input {
            Input::Ram { ram, .. } => ram.station,
            Input::Rmcm(Rmcm::Command(command)) => command.session.leader,
            Input::Rmcm(Rmcm::Answer(answer)) => answer.from,
            _ => return None,
        })
    }

    /// True if the input was ignored.
    #[must_use]
    pub fn is_ignored(&self) -> bool {
        self.said.has(OutputKind::Ignored)
    }
}

/// True if the input is a RAM of the leader of `session` that lists this robot by `offer`.
pub(super) fn is_listed(step: &Taken, session: SessionId, offer: OfferNumber) -> bool {
    let Input::Ram { ram, .. } = step.input else {
        return false;
    };
    match ram.coordination {
        Coordination::Leader {
            number, followers, ..
        } => {
            let me = step.before.station();
            ram.station == session.leader
                && number == session.number
                && followers
                    .iter()
                    .any(|listed| listed.station == me && listed.offer == offer)
        }
        _ => false,
    }
}
