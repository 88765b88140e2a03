//! Messages of one robot: from what the protocol and the application say to octets, and back.

use crossguard_codec::{
    EncodeError, ExecutionStatus, Identifiers, RobotState, TaskParameters, encode, ram_from,
    rmcm_from_answer, rmcm_from_commands,
};
use crossguard_protocol::{Answer, Availability, Command, Ram, StationId};

use crate::counters::Cause;
use crate::ras::clustering::Cluster;
use crate::ras::containers;
use crate::ras::motion::Plane;
use crate::station::message_of;

/// What a received message says, or why it says nothing.
pub use crossguard_codec::{Heard, Unheard};

/// Which message octets are: that of which service.
pub use crossguard_codec::Service as MessageKind;

/// Encodes and decodes for one robot.
#[derive(Clone, Debug, Default)]
pub struct Wire {
    /// What no standard has assigned.
    pub identifiers: Identifiers,
}

impl Wire {
    /// The octets of a RAM, which announces a cluster, if there is one.
    ///
    /// # Errors
    /// When the view or state is one that no message can carry.
    pub fn ram(
        &self,
        state: &RobotState,
        view: &Ram,
        availability: Availability,
        generation_delta_time: u16,
        with_low_frequency: bool,
        cluster: Option<(&Cluster, &Plane)>,
    ) -> Result<Vec<u8>, Unsendable> {
        let ids = &self.identifiers;
        let mut ram = ram_from(
            ids,
            state,
            view,
            availability,
            generation_delta_time,
            with_low_frequency,
        )?;
        if let Some((cluster, plane)) = cluster {
            containers::write(&mut ram, plane, Some(cluster));
        }
        Ok(encode(ids, &ram)?)
    }

    /// The octets of a leader's command.
    ///
    /// # Errors
    /// When the parameters cannot be expressed.
    pub fn command(
        &self,
        state: &RobotState,
        command: Command,
        parameters: TaskParameters,
        generation_delta_time: u16,
    ) -> Result<Vec<u8>, Unsendable> {
        let ids = &self.identifiers;
        let commands = [(command, parameters)];
        let rmcm =
            rmcm_from_commands(ids, &state.position, None, &commands, generation_delta_time)?;
        Ok(encode(ids, &rmcm)?)
    }

    /// The octets of a follower's answer.
    ///
    /// # Errors
    /// When the answer contradicts itself.
    pub fn answer(
        &self,
        state: &RobotState,
        answer: Answer,
        generation_delta_time: u16,
    ) -> Result<Vec<u8>, Unsendable> {
        let ids = &self.identifiers;
        let status = ExecutionStatus {
            progression: state.task_progression,
            time_to_completion: None,
        };
        let rmcm = rmcm_from_answer(ids, &state.position, &answer, status, generation_delta_time)?;
        Ok(encode(ids, &rmcm)?)
    }

    /// What `octets` say to the robot `me` in this `state`.
    ///
    /// # Errors
    /// Why they say nothing.
    pub fn hear(&self, me: StationId, state: &RobotState, octets: &[u8]) -> Result<Heard, Unheard> {
        Heard::of(&self.identifiers, me, &state.position, octets)
    }
}

impl From<&Unheard> for Cause {
    fn from(unheard: &Unheard) -> Self {
        match unheard {
            Unheard::Undecodable(error) => error.into(),
            Unheard::Contradictory(error) => error.into(),
        }
    }
}

/// Why a message cannot be sent.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Unsendable {
    /// It contradicts itself.
    #[error(transparent)]
    Contradictory(#[from] crossguard_codec::ViewError),
    /// It cannot be encoded.
    #[error(transparent)]
    NotEncodable(#[from] EncodeError),
}

/// What `octets`, a message or a packet with one, say to a listener: for charts and tools.
///
/// # Errors
/// Why they say nothing.
pub fn overhear(identifiers: &Identifiers, octets: &[u8]) -> Result<Heard, Unheard> {
    let wire = Wire {
        identifiers: *identifiers,
    };
    let message = message_of(octets);
    wire.hear(StationId(u32::MAX), &RobotState::default(), message)
}
