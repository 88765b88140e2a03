//! The newest command that a robot took on: another one under its requestID is no repetition.

use crossguard_codec::TaskParameters;
use crossguard_protocol::{Command, Input, Phase, Rmcm, Robot};

/// The newest command that a robot took on, with its parameters.
#[derive(Clone, Copy, Debug, Default)]
pub struct Accepted(Option<(Command, Option<TaskParameters>)>);

impl Accepted {
    /// Whether `me` hears a command with the requestID of the one that it took on, which says something else: it is no repetition, and
    /// the leader must not hear that it was accepted. How long a command is valid may run down in repetitions.
    #[must_use]
    pub fn is_contradicted(
        &self,
        me: &Robot,
        input: &Input,
        parameters: Option<TaskParameters>,
    ) -> bool {
        let timeless = |with: Option<TaskParameters>| {
            with.map(|with| TaskParameters {
                validity: None,
                ..with
            })
        };
        let (Input::Rmcm(Rmcm::Command(command)), Some((known, with))) = (input, self.0) else {
            return false;
        };
        (known.session, known.request) == (command.session, command.request)
            && command.to == me.station()
            && (known.task != command.task || timeless(with) != timeless(parameters))
    }

    /// Remembers a command that `me` has just taken on by this input, with its parameters.
    pub fn learn(&mut self, me: &Robot, input: &Input, parameters: Option<TaskParameters>) {
        if let (Input::Rmcm(Rmcm::Command(command)), Phase::Following(following)) =
            (input, me.phase())
            && command.to == me.station()
            && following.session == command.session
            && following
                .job
                .is_some_and(|job| job.request == command.request)
        {
            self.0 = Some((*command, parameters));
        }
    }
}
