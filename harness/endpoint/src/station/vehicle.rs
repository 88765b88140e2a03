//! A vehicle that a leader asks whether it will stop: the other side of [`Exchange::ask`](crate::exchange::Exchange::ask).

use crossguard_codec::si::generation_delta_time;
use crossguard_codec::{
    EncodeError, ExecutionStatus, Heard, Identifiers, Position, Target, TaskProgression, ViewError,
    encode, rmcm_from_answer,
};
use crossguard_protocol::{
    Answer, Command, Input, Rejection, Rmcm, StationId, TaskType, Unavailability, Verdict,
};

/// `StationType` of a passenger car (TS 102 894-2).
const PASSENGER_CAR: u8 = 5;

/// The identifiers that a passenger car encodes with.
#[must_use]
pub fn passenger_car() -> Identifiers {
    Identifiers {
        robot_station_type: PASSENGER_CAR,
        ..Identifiers::default()
    }
}

/// A leader's question to a vehicle.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Question {
    command: Command,
    /// Where its front is to stand, if the leader says that.
    pub line: Option<Target>,
}

/// An answer that cannot be made.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error(transparent)]
pub enum NoAnswer {
    /// It contradicts itself.
    Contradictory(#[from] ViewError),
    /// It cannot be encoded.
    Unencodable(#[from] EncodeError),
}

impl Question {
    /// The question to the vehicle `me` in what it heard, if that is one: a command to block.
    #[must_use]
    pub fn of(heard: &Heard, me: StationId) -> Option<Self> {
        heard.inputs.iter().find_map(|input| match input {
            Input::Rmcm(Rmcm::Command(command))
                if command.to == me && command.task == TaskType::BLOCK =>
            {
                let line = heard.parameters.and_then(|it| it.target);
                Some(Self {
                    command: *command,
                    line,
                })
            }
            _ => None,
        })
    }

    /// The octets of the RMCM by which the vehicle, at `position`, says that it will stop, or that it will not. `timestamp_its` is
    /// in ms since 2004.
    ///
    /// # Errors
    /// Why it cannot be made.
    pub fn answer(
        &self,
        identifiers: &Identifiers,
        position: &Position,
        promises: bool,
        timestamp_its: u64,
    ) -> Result<Vec<u8>, NoAnswer> {
        let (verdict, progression) = if promises {
            (Verdict::Accepted, TaskProgression::Executing)
        } else {
            let why = Rejection::Unavailable(Unavailability::NotSafe);
            (Verdict::Rejected(why), TaskProgression::Idle)
        };
        let answer = Answer {
            from: self.command.to,
            session: self.command.session,
            request: self.command.request,
            verdict,
        };
        let status = ExecutionStatus {
            progression,
            time_to_completion: None,
        };
        let time = generation_delta_time(timestamp_its);
        let rmcm = rmcm_from_answer(identifiers, position, &answer, status, time)?;
        Ok(encode(identifiers, &rmcm)?)
    }
}
