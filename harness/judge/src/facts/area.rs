//! Where followers are to be, from the commands of their leader.

use std::collections::BTreeMap;

use crossguard_codec::{Heard, Identifiers, Position, Target};
use crossguard_protocol::{Input, ManeuverId, Rmcm, StationId, TaskSet, TaskType};
use serde::Serialize;

use super::{Placed, shown};

/// A place that a follower goes to or holds, or the way that it escorts along.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Area {
    /// The maneuver.
    #[serde(serialize_with = "shown")]
    pub id: ManeuverId,
    /// Its task.
    #[serde(serialize_with = "shown")]
    pub task: TaskType,
    /// The station that carries it out.
    pub follower: StationId,
    /// Whether a pedestrian is guarded by it.
    pub guards: bool,
    /// Where the follower stood when it was commanded, in degrees of latitude and longitude, if known.
    pub from: Option<(f64, f64)>,
    /// Where it is to be, likewise.
    pub to: (f64, f64),
}

/// The areas of all sessions, by leader.
#[derive(Debug, Default)]
pub(super) struct Areas {
    places: BTreeMap<StationId, (f64, f64)>,
    guarding: BTreeMap<StationId, TaskSet>,
    by_leader: BTreeMap<StationId, Vec<Area>>,
}

impl Areas {
    /// Which tasks guard a pedestrian, by the configuration of a leader.
    pub(super) fn guarding(&mut self, leader: StationId, tasks: TaskSet) {
        self.guarding.insert(leader, tasks);
    }

    pub(super) fn place(&mut self, station: StationId, placed: &Placed) {
        self.places.insert(station, placed.degrees());
    }

    /// A session is over. Whether there was something in it.
    pub(super) fn leave(&mut self, leader: StationId) -> bool {
        self.by_leader.remove(&leader).is_some()
    }

    /// All areas of a leader that sends a message, if there is a new one in it.
    pub(super) fn command(
        &mut self,
        identifiers: &Identifiers,
        heard: &Heard,
        octets: &[u8],
    ) -> Option<Vec<Area>> {
        let leader = heard.from;
        let mut is_new = false;
        for input in heard.inputs.iter() {
            let &Input::Rmcm(Rmcm::Command(command)) = input else {
                continue;
            };
            let id = ManeuverId {
                session: command.session,
                request: command.request,
            };
            let areas = self.by_leader.entry(leader).or_default();
            if areas
                .iter()
                .any(|it| it.id == id && it.follower == command.to)
            {
                continue;
            }
            let Some(to) = self.target(identifiers, leader, command.to, octets) else {
                continue;
            };
            let area = Area {
                id,
                task: command.task,
                follower: command.to,
                guards: self
                    .guarding
                    .get(&leader)
                    .is_some_and(|tasks| tasks.contains(command.task)),
                from: self.places.get(&command.to).copied(),
                to,
            };
            let areas = self.by_leader.entry(leader).or_default();
            // A new command takes the place of the one before.
            areas.retain(|it| it.follower != command.to);
            areas.push(area);
            is_new = true;
        }
        is_new.then(|| self.by_leader.get(&leader).cloned().unwrap_or_default())
    }

    /// Where a command for `follower` leads, in degrees.
    fn target(
        &self,
        identifiers: &Identifiers,
        leader: StationId,
        follower: StationId,
        octets: &[u8],
    ) -> Option<(f64, f64)> {
        let heard = Heard::of(identifiers, follower, &Position::default(), octets).ok()?;
        match heard.parameters?.target? {
            Target::Position {
                latitude,
                longitude,
                ..
            } => Some((latitude, longitude)),
            Target::Offset {
                latitude,
                longitude,
                ..
            } => {
                let (north, east) = self.places.get(&leader)?;
                Some((north + latitude, east + longitude))
            }
            Target::Lane(_) => None,
        }
    }
}
