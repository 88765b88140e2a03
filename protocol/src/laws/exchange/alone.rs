//! Two properties of an exchange that are about one robot alone.

use super::Exchange;
use super::observer::leads;
use crate::id::StationId;
use crate::input::{Input, Timer};
use crate::laws::part::record_of;
use crate::message::Rmcm;
use crate::output::Output;
use crate::state::{Identity, Member, Phase, Robot};

/// Whose doing an input is, where it is that of one other robot.
fn other(input: &Input) -> Option<StationId> {
    match input {
        Input::Ram { ram, .. } => Some(ram.station),
        Input::Rmcm(Rmcm::Answer(answer)) => Some(answer.from),
        Input::Rmcm(Rmcm::Command(command)) => Some(command.session.leader),
        Input::Expired(timer) => match timer {
            Timer::Lease(station)
            | Timer::Lost(station)
            | Timer::Execution(station)
            | Timer::Acknowledgement(station)
            | Timer::Offer(station) => Some(*station),
            Timer::Safety
            | Timer::Leave
            | Timer::Help
            | Timer::Selection
            | Timer::Reservation
            | Timer::IdentityLock
            | Timer::Farewell
            | Timer::Ram => None,
        },
        Input::Elapsed(_) | Input::Local(_) => None,
    }
}

fn record<'a>(exchange: &Exchange, robot: &'a Robot) -> Option<&'a Member> {
    match &robot.phase {
        Phase::Leading(leading) if leads(exchange, robot) => record_of(leading, exchange.follower),
        _ => None,
    }
}

/// I17: no act or silence of another robot changes the record of the follower while the session goes on.
///
/// # Panics
/// When it does not.
pub fn leaves_the_record(exchange: &Exchange, (before, input): (&Robot, &Input), after: &Robot) {
    if other(input).is_some_and(|other| other != exchange.follower) && leads(exchange, after) {
        let was = record(exchange, before);
        assert!(
            was.is_none() || was == record(exchange, after),
            "I17: another robot touches the record"
        );
    }
}

/// I18: a robot with a part in the session has told the rest of the endpoint to keep its station id.
///
/// # Panics
/// When it has not.
pub fn keeps_its_station<'a>(
    exchange: &Exchange,
    before: &Robot,
    outputs: impl IntoIterator<Item = &'a Output>,
    after: &Robot,
) {
    let mut is_locked = !matches!(before.identity, Identity::Unlocked);
    for output in outputs {
        match output {
            Output::LockIdentity => is_locked = true,
            Output::UnlockIdentity => is_locked = false,
            _ => {}
        }
    }
    let follows = matches!(&after.phase, Phase::Following(following)
        if following.session == exchange.session && after.station == exchange.follower);
    assert!(
        is_locked || !(follows || leads(exchange, after)),
        "I18: the station id is not locked"
    );
    assert!(
        after.station == before.station || !(leads(exchange, before) || leads(exchange, after)),
        "I18: the station id changes"
    );
}
