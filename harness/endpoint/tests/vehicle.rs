//! A vehicle that is asked to stop, and what counts as its answer.

use crossguard_codec::geonet::{EgoPosition, Stack};
use crossguard_codec::{Heard, Identifiers, Position, Service, TaskParameters};
use crossguard_endpoint::station::vehicle::Question;
use crossguard_endpoint::{Effect, Endpoint, Stimulus};
use crossguard_protocol::StationId;

use crate::same_request::team_with_a_command;
use crate::support::{endpoint, handle, hear, sent};

const VEHICLE: StationId = StationId(7);

/// Answer to `question` of a station `from` of this type, in octets.
fn answer(question: Question, from: StationId, station_type: u8, promises: bool) -> Vec<u8> {
    let ids = Identifiers {
        robot_station_type: station_type,
        ..Identifiers::default()
    };
    let message = question
        .answer(&ids, &Position::default(), promises, 0)
        .unwrap();
    let mut stack = Stack::of_robot(ids, from);
    stack
        .packet(&EgoPosition::default(), Service::Rmcm, &message)
        .unwrap()
}

fn ask(leader: &mut Endpoint, now_ms: u64, vehicle: StationId) -> Option<Question> {
    let parameters = TaskParameters::default();
    let effects = handle(
        leader,
        now_ms,
        Stimulus::Ask {
            vehicle,
            parameters,
        },
    );
    let sent = sent(&effects, Some(Service::Rmcm));
    let (_, message) = sent.first()?;
    let read = |me| {
        let ids = Identifiers::default();
        let heard = Heard::of(&ids, me, &Position::default(), message);
        Question::of(&heard.unwrap(), me)
    };
    assert_eq!(read(StationId(9)), None);
    read(vehicle)
}

#[test]
fn the_answer_to_the_newest_question_counts_and_no_other() {
    let ([mut leader, mut follower], command, now_ms) = team_with_a_command();
    let said = |leader: &mut Endpoint, packet: &[u8]| {
        let effects = hear(leader, now_ms, packet);
        let steps = effects
            .iter()
            .filter(|it| matches!(it, Effect::Stepped { .. }))
            .count();
        let answers = effects.iter().find_map(|effect| match effect {
            Effect::VehicleAnswered(station, promises) => Some((*station, *promises)),
            _ => None,
        });
        (answers, steps)
    };
    let first = ask(&mut leader, now_ms, VEHICLE).unwrap();
    let promise = |question, from| answer(question, from, 5, true);
    assert_eq!(
        said(&mut leader, &promise(first, VEHICLE)),
        (Some((VEHICLE, true)), 0)
    );
    let second = ask(&mut leader, now_ms, VEHICLE).unwrap();
    assert_eq!(
        said(&mut leader, &promise(first, VEHICLE)).0,
        None,
        "an older question"
    );
    let refusal = answer(second, VEHICLE, 5, false);
    assert_eq!(said(&mut leader, &refusal).0, Some((VEHICLE, false)));
    // A question to another vehicle takes its place.
    let other = ask(&mut leader, now_ms, StationId(8)).unwrap();
    assert_eq!(
        said(&mut leader, &promise(second, VEHICLE)).0,
        None,
        "another vehicle"
    );
    assert_eq!(
        said(&mut leader, &promise(other, StationId(8))).0,
        Some((StationId(8), true))
    );
    // The follower of the session is no vehicle, and who does not lead asks nobody.
    assert_eq!(command.to, follower.robot().station());
    assert_eq!(ask(&mut follower, now_ms, VEHICLE), None);
    assert_eq!(ask(&mut endpoint(StationId(3)), now_ms, VEHICLE), None);
}
