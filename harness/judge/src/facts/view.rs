//! A robot's part in a session, as far as people and plots want to know it.

use crossguard_protocol::{
    Corridor, Phase, Place, Robot, Role, SessionId, State, StationId, TaskType,
};
use serde::Serialize;

use super::shown_if_any;

/// A robot's part in a session.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct View {
    /// Its station id.
    pub station: StationId,
    /// Its boot counter.
    pub boot: u16,
    /// Its state in the paper's model.
    pub state: State,
    /// Its role.
    pub role: Role,
    /// The session that it has a part in.
    #[serde(serialize_with = "shown_if_any")]
    pub session: Option<SessionId>,
    /// The followers of a leader.
    pub followers: Vec<FollowerView>,
    /// The task that a follower executes.
    #[serde(serialize_with = "shown_if_any")]
    pub executes: Option<TaskType>,
    /// Whether the pedestrian may cross, as far as this robot says.
    pub corridor_open: bool,
    /// The crossing that a requester or leader asks help for, empty where it is not known.
    pub place: String,
    /// Its duty on the road, empty where it has none.
    pub duty: String,
    /// Whether it is available, and if not, why.
    pub availability: String,
}

/// A follower, as its leader knows it.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct FollowerView {
    /// The follower.
    pub station: StationId,
    /// The task of its newest acknowledged command.
    #[serde(serialize_with = "shown_if_any")]
    pub task: Option<TaskType>,
    /// How far it is with it; empty before its first report.
    pub progress: String,
    /// Whether the lease on it stands.
    pub has_lease: bool,
}

impl View {
    /// The view of `robot`.
    #[must_use]
    pub fn of(robot: &Robot) -> Self {
        let leading = match robot.phase() {
            Phase::Leading(leading) => Some(leading),
            _ => None,
        };
        let followers = leading
            .into_iter()
            .flat_map(|leading| leading.members.iter());
        let followers = followers.map(|member| FollowerView {
            station: member.station,
            task: member.order.map(|order| order.task),
            progress: member
                .order
                .and_then(|order| order.progress)
                .map_or_else(String::new, |progress| progress.to_string()),
            has_lease: member.lease.stands(),
        });
        let executes = match robot.phase() {
            Phase::Following(following) => following.executing().map(|maneuver| maneuver.task),
            _ => None,
        };
        Self {
            station: robot.station(),
            boot: robot.boot(),
            state: robot.state(),
            role: robot.role(),
            session: robot.session(),
            followers: followers.collect(),
            executes,
            corridor_open: leading.is_some_and(|leading| leading.corridor == Corridor::Open),
            place: place_of(robot),
            duty: match leading {
                Some(leading) if leading.corridor == Corridor::Clearing => {
                    "waits for the road to be clear".to_owned()
                }
                _ => robot
                    .duty()
                    .map_or_else(String::new, |duty| format!("on duty: {duty}")),
            },
            availability: robot.availability().to_string(),
        }
    }
}

/// The crossing that a robot asks help for.
fn place_of(robot: &Robot) -> String {
    let place = match robot.phase() {
        Phase::Requesting(requesting) => requesting.request.place,
        Phase::Leading(leading) => leading.request.place,
        _ => Place::UNKNOWN,
    };
    if place == Place::UNKNOWN {
        return String::new();
    }
    place.to_string()
}
