//! Messages of one robot: from what the protocol and the application say to octets, and back.

use crossguard_codec::core::cdd::VruClusterInformation;
use crossguard_codec::{
    EncodeError, ExecutionStatus, Identifiers, Message, RobotState, TaskParameters,
    availability_of, distance, encode, ram_from, rmcm_from_answer, rmcm_from_commands, state_of,
    task_parameters_of, view_of_ram, views_of_rmcm,
};
use crossguard_protocol::{Answer, Availability, Command, Input, Ram, Rmcm, StationId};

use crate::counters::Cause;
use crate::ras::clustering::Cluster;
use crate::ras::containers;
use crate::ras::motion::Plane;
use crate::station::message_of;

/// Which message octets are: that of which service.
pub use crossguard_codec::Service as MessageKind;

/// What a received message says.
#[derive(Clone, Debug)]
pub struct Heard {
    /// Which message it is.
    pub kind: MessageKind,
    /// The station that sent it.
    pub from: StationId,
    /// What the transition function takes in, in order.
    pub inputs: Vec<Input>,
    /// Parameters of the command to this robot, if there is one.
    pub parameters: Option<TaskParameters>,
    /// The sender's state, from a RAM.
    pub state: Option<RobotState>,
    /// The sender's availability, from a RAM.
    pub availability: Option<Availability>,
    /// The people around the sender, from a RAM.
    pub cluster: Option<VruClusterInformation>,
}

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
        match Message::decode(&self.identifiers, octets)?.message {
            Message::Ram(ram) => {
                let view = view_of_ram(&ram)?;
                let sender = state_of(&ram);
                let distance = distance(&state.position, &sender.position);
                let cluster = ram.ram.ram_parameters.vru_cluster_information_container;
                Ok(Heard {
                    kind: MessageKind::Ram,
                    from: view.station,
                    inputs: vec![Input::Ram {
                        ram: view,
                        distance,
                    }],
                    parameters: None,
                    availability: Some(availability_of(&ram)),
                    cluster: cluster.map(|it| it.vru_cluster_information),
                    state: Some(sender),
                })
            }
            Message::Rmcm(rmcm) => {
                let views = views_of_rmcm(&rmcm)?;
                let from = views.iter().next().map_or(StationId(0), |view| match view {
                    Rmcm::Command(command) => command.session.leader,
                    Rmcm::Answer(answer) => answer.from,
                });
                Ok(Heard {
                    kind: MessageKind::Rmcm,
                    from,
                    inputs: views.iter().copied().map(Input::Rmcm).collect(),
                    parameters: task_parameters_of(&rmcm, me),
                    state: None,
                    availability: None,
                    cluster: None,
                })
            }
        }
    }
}

/// Why octets say nothing.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Unheard {
    /// They are not a message.
    #[error(transparent)]
    Undecodable(#[from] crossguard_codec::DecodeError),
    /// The message contradicts itself.
    #[error(transparent)]
    Contradictory(#[from] crossguard_codec::ViewError),
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

/// What `octets`, a message or a packet with one, say to whoever listens in: for charts and tools.
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
