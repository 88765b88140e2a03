//! Where a leader has sent its followers: no two bodies to one place.
//!
//! A follower stays where its newest accepted command of a session has led it. In the next stage two followers are commanded one
//! after the other: the place of one that has been commanded away is no target any more.

use std::collections::BTreeMap;

use crossguard_codec::view::{task_parameters_of, views_of_rmcm};
use crossguard_codec::{Identifiers, Message, Position, Target, distance};
use crossguard_endpoint::station::listen::message_of;
use crossguard_protocol::{
    Answer, Command, Input, List, RequestId, Rmcm, SessionId, StationId, Verdict,
};
use crossguard_robot::plan_file::APART_M;

use super::fault::Fault;

/// By how much two places may be nearer than [`APART_M`], in metres: positions go over the air in steps of 0.1
/// microdegree, and distances are rounded to decimetres.
const ROUNDING_M: f64 = 0.1;

/// The targets of one leader's commands.
#[derive(Debug, Default)]
pub(super) struct Targets {
    /// Of its newest command to each follower.
    commanded: BTreeMap<(SessionId, StationId), (RequestId, Option<Position>)>,
    /// Of the newest command that each follower has accepted.
    accepted: BTreeMap<(SessionId, StationId), (RequestId, Position)>,
}

impl Targets {
    /// The leader has sent an RMCM.
    pub(super) fn sent(&mut self, identifiers: &Identifiers, octets: &[u8]) {
        for (command, place) in commands(identifiers, octets) {
            let follower = (command.session, command.to);
            self.commanded.insert(follower, (command.request, place));
        }
    }

    /// The leader is told something: a follower that accepts a command goes to its target, and one that rejects it stays.
    pub(super) fn told(&mut self, input: Input) -> Result<(), Fault> {
        let Input::Rmcm(Rmcm::Answer(Answer {
            from,
            session,
            request,
            verdict,
        })) = input
        else {
            return Ok(());
        };
        let follower = (session, from);
        let newest = self.commanded.get(&follower).copied();
        let Some((_, place)) = newest.filter(|(commanded, _)| *commanded == request) else {
            return Ok(());
        };
        if verdict != Verdict::Accepted {
            if let Some((accepted, at)) = self.accepted.get(&follower) {
                self.commanded.insert(follower, (*accepted, Some(*at)));
            }
            return Ok(());
        }
        let Some(place) = place else {
            self.accepted.remove(&follower);
            return Ok(());
        };
        self.accepted.insert(follower, (request, place));
        let others = self.accepted.iter().filter(|(other, (accepted, _))| {
            let (of, station) = **other;
            let stays = |(commanded, _): &(RequestId, Option<Position>)| commanded == accepted;
            of == session && station != from && self.commanded.get(*other).is_some_and(stays)
        });
        for ((_, other), (_, at)) in others {
            let metres = f64::from(distance(&place, at).0) / 10.0;
            if metres < APART_M - ROUNDING_M {
                return Err(Fault::SamePlace {
                    follower: from,
                    other: *other,
                    metres,
                });
            }
        }
        Ok(())
    }
}

/// The commands in an RMCM, and where they lead.
pub(super) fn commands(
    identifiers: &Identifiers,
    octets: &[u8],
) -> Vec<(Command, Option<Position>)> {
    let received = Message::decode(identifiers, message_of(octets));
    let Ok(Message::Rmcm(rmcm)) = received.map(|received| received.message) else {
        return Vec::new();
    };
    let views = views_of_rmcm(&rmcm);
    let commands = views.iter().flat_map(List::iter).filter_map(|view| {
        let Rmcm::Command(command) = *view else {
            return None;
        };
        let parameters = task_parameters_of(&rmcm, command.to);
        let place = parameters.and_then(|parameters| position_of(parameters.target?));
        Some((command, place))
    });
    commands.collect()
}

/// A position on earth. Where an offset or a lane leads is not in the message.
fn position_of(target: Target) -> Option<Position> {
    match target {
        Target::Position {
            latitude,
            longitude,
            ..
        } => Some(Position::at(latitude, longitude)),
        Target::Offset { .. } | Target::Lane(_) => None,
    }
}

#[cfg(test)]
mod tests {
    use crossguard_codec::{TaskParameters, encode, rmcm_from_commands};
    use crossguard_protocol::{Rejection, SessionNumber, TaskType, UniqueNumber};

    use super::*;

    const SESSION: SessionId = SessionId {
        leader: StationId(9),
        number: SessionNumber(UniqueNumber { boot: 1, count: 0 }),
    };

    /// A leader that sends followers to block, at this latitude each.
    #[derive(Default)]
    struct Leader(Targets);

    impl Leader {
        fn commands(&mut self, request: u8, to: u32, latitude: f64) {
            let ids = Identifiers::default();
            let command = Command {
                session: SESSION,
                to: StationId(to),
                request: RequestId(request),
                task: TaskType::BLOCK,
            };
            let parameters = TaskParameters {
                target: Some(Target::Position {
                    latitude,
                    longitude: 8.4,
                    altitude: None,
                }),
                ..TaskParameters::default()
            };
            let position = Position::at(49.0, 8.4);
            let rmcm = rmcm_from_commands(&ids, &position, &[(command, parameters)], 0).unwrap();
            self.0.sent(&ids, &encode(&ids, &rmcm).unwrap());
        }

        fn hears(&mut self, request: u8, from: u32, verdict: Verdict) -> Result<(), Fault> {
            self.0.told(Input::Rmcm(Rmcm::Answer(Answer {
                from: StationId(from),
                session: SESSION,
                request: RequestId(request),
                verdict,
            })))
        }
    }

    /// Followers 1 and 2 at their places, and both commanded on: 1 to where 2 stands, which it accepts first.
    fn both_commanded_on() -> Leader {
        let mut leader = Leader::default();
        for (to, latitude) in [(1, 49.0), (2, 49.0001)] {
            leader.commands(1, to, latitude);
            leader.hears(1, to, Verdict::Accepted).unwrap();
        }
        leader.commands(2, 1, 49.0001);
        leader.commands(2, 2, 49.0002);
        leader.hears(2, 1, Verdict::Accepted).unwrap();
        leader
    }

    #[test]
    fn the_place_of_one_that_goes_on_as_well_is_free() {
        let mut leader = both_commanded_on();
        leader.hears(2, 2, Verdict::Accepted).unwrap();
    }

    #[test]
    fn one_that_rejects_the_next_command_keeps_its_place() {
        let mut leader = both_commanded_on();
        let rejected = Verdict::Rejected(Rejection::UnsupportedTask);
        leader.hears(2, 2, rejected).unwrap();
        leader.commands(3, 1, 49.0001);
        let fault = leader.hears(3, 1, Verdict::Accepted);
        assert!(matches!(fault, Err(Fault::SamePlace { .. })), "{fault:?}");
    }
}
