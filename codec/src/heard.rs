//! Content of a message for the robot that hears it: everything that its mapping has, at once.

use crossguard_protocol::{Availability, Input, List, MAX_FOLLOWERS, Rmcm, StationId};

use crate::core::cdd::VruClusterInformation;
use crate::distance::distance;
use crate::error::{DecodeError, ViewError};
use crate::identifiers::Identifiers;
use crate::message::{Message, Received};
use crate::service::Service;
use crate::state::{Position, RobotState};
use crate::view::{
    MapPlace, TaskParameters, availability_of, map_place_of, state_of, task_parameters_of,
    view_of_ram, views_of_rmcm,
};

/// Content of a received message.
#[derive(Clone, Debug)]
pub struct Heard {
    /// The service that it is of: robot awareness, or maneuver coordination.
    pub service: Service,
    /// The station that sent it.
    pub from: StationId,
    /// Inputs of the transition function, in order.
    pub inputs: List<Input, MAX_FOLLOWERS>,
    /// `generationDeltaTime`: when the message was made, in ms modulo 65,536 of `TimestampIts`.
    pub generation_delta_time: u16,
    /// Parameters of the command to the robot that hears it, if there is one.
    pub parameters: Option<TaskParameters>,
    /// The place of the map that the commands name, for all followers.
    pub map_place: Option<MapPlace>,
    /// The sender's state, from a RAM.
    pub state: Option<RobotState>,
    /// The sender's availability, from a RAM.
    pub availability: Option<Availability>,
    /// The people around the sender, from a RAM.
    pub cluster: Option<VruClusterInformation>,
}

/// Why octets say nothing.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Unheard {
    /// They are not a message.
    #[error(transparent)]
    Undecodable(#[from] DecodeError),
    /// The message contradicts itself.
    #[error(transparent)]
    Contradictory(#[from] ViewError),
}

impl Heard {
    /// Content of the message `octets` for the robot `me` at this `position`.
    ///
    /// # Errors
    /// Why it says nothing.
    pub fn of(
        identifiers: &Identifiers,
        me: StationId,
        position: &Position,
        octets: &[u8],
    ) -> Result<Self, Unheard> {
        let Received { message, .. } = Message::decode(identifiers, octets)?;
        Ok(match message {
            Message::Ram(ram) => {
                let (view, state) = (view_of_ram(&ram)?, state_of(&ram));
                let input = Input::Ram {
                    ram: view,
                    distance: distance(position, &state.position),
                };
                let cluster = ram.ram.ram_parameters.vru_cluster_information_container;
                Self {
                    service: Service::Ram,
                    from: view.station,
                    inputs: [input].into_iter().collect(),
                    generation_delta_time: ram.ram.generation_delta_time.0,
                    parameters: None,
                    map_place: None,
                    state: Some(state),
                    availability: Some(availability_of(&ram)),
                    cluster: cluster.map(|container| container.vru_cluster_information),
                }
            }
            Message::Rmcm(rmcm) => {
                let views = views_of_rmcm(&rmcm)?;
                let sender = |view: &Rmcm| match view {
                    Rmcm::Command(command) => command.session.leader,
                    Rmcm::Answer(answer) => answer.from,
                };
                Self {
                    service: Service::Rmcm,
                    from: views.iter().next().map_or(StationId(0), sender),
                    inputs: views.iter().copied().map(Input::Rmcm).collect(),
                    generation_delta_time: rmcm.rmcm.generation_delta_time.0,
                    parameters: task_parameters_of(&rmcm, me),
                    map_place: map_place_of(&rmcm),
                    state: None,
                    availability: None,
                    cluster: None,
                }
            }
        })
    }
}
