//! The steps of the induction.

use super::observer::{Observer, lose_power};
use super::{Exchange, HALF_SPACE, History, facts, is_given_out, leases, messages, robots};
use crate::config::Config;
use crate::id::{StationId, UniqueNumber};
use crate::input::{Event, Input, Timer};
use crate::message::{Ram, Rmcm};
use crate::output::Output;
use crate::robot::Step;
use crate::state::Robot;
use crate::time::Millis;

/// The invariant of each robot between any two steps.
#[must_use]
pub fn holds(exchange: &Exchange, history: &History, robot: &Robot) -> bool {
    facts::are_consistent(exchange, history)
        && robots::agrees(exchange, history, robot)
        && robots::agrees_on_heartbeats(exchange, history, robot)
}

/// True if this can be the next input of `robot`: what a message says is so, of a heartbeat that can be put in order, and a
/// new station id is that of nobody else, with numbers that it has not given out.
#[must_use]
pub fn can_be_next(exchange: &Exchange, history: &History, robot: &Robot, input: &Input) -> bool {
    match input {
        Input::Ram { ram, .. } => {
            messages::ram_is_true(exchange, history, ram)
                && messages::is_near(exchange, ram)
                && robots::can_report(exchange, robot, ram)
        }
        Input::Rmcm(rmcm) => messages::rmcm_is_true(exchange, history, *rmcm),
        Input::Local(Event::IdentityChanged(station, next)) => {
            let next = next.unwrap_or(robot.next_number());
            *station == robot.station || can_be_taken(exchange, history, *station, next)
        }
        Input::Elapsed(_) | Input::Expired(_) | Input::Local(_) => true,
    }
}

/// True if so little time passes at once that a leader's heartbeats, which it counts, can be put in order: less than a quarter
/// of their number space, 27 minutes with a RAM in 100 ms.
#[must_use]
pub fn can_pass(config: &Config, time: Millis) -> bool {
    time.0 / u32::from(HALF_SPACE / 2) < config.settings().ram_period.0
}

/// True if a robot can start to be `station` and give out `next` next.
#[must_use]
pub fn can_be_taken(
    exchange: &Exchange,
    history: &History,
    station: StationId,
    next: UniqueNumber,
) -> bool {
    let is_free = !history.requested || history.ended;
    let has_left = !history.joined || (history.left && !history.runs());
    let is_new = |number| is_given_out(number, next);
    (!exchange.is_led_by(station)
        || (is_free && (!history.requested || is_new(exchange.session.number.0))))
        && (station != exchange.follower
            || (has_left
                && (!history.joined || history.listed.is_some_and(|offer| is_new(offer.0)))))
}

/// Which part of what a step may do is judged: two proofs of half of it take less than one of all.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Laws {
    /// All of it.
    All,
    /// All but [`Heartbeats`](Self::Heartbeats).
    Facts,
    /// Heartbeats, leases and what an open corridor rests on.
    Heartbeats,
}

/// One step of a robot keeps what holds, and breaks no property of the exchange. Its outputs are judged in any case.
///
/// # Panics
/// When it does not.
#[must_use]
pub fn keeps(
    laws: Laws,
    config: &Config,
    (exchange, history): (&Exchange, &History),
    before: &Robot,
    input: Input,
) -> (History, Robot) {
    let mut after = before.clone();
    let mut observer = Observer::new(exchange, history, before, &input);
    after.step_into(config, input, &mut observer);
    if laws != Laws::Facts {
        leases::are_kept(config, before, &input, &after);
    }
    let now = judged(laws, (exchange, history), observer, before, &after);
    (now, after)
}

/// A due timer fires, with which all that elapsed time does is made: countdowns are read by nothing here.
///
/// # Panics
/// When that does not keep what holds.
#[must_use]
pub fn keeps_when_fired(
    laws: Laws,
    config: &Config,
    (exchange, history): (&Exchange, &History),
    before: &Robot,
    (timer, late): (Timer, Millis),
) -> (History, Robot) {
    let mut after = before.clone();
    let mut observer = Observer::new(exchange, history, before, &Input::Expired(timer));
    let step = &mut Step {
        config,
        out: &mut observer,
        renewed: false,
    };
    after.fire(step, timer, late);
    let now = judged(laws, (exchange, history), observer, before, &after);
    (now, after)
}

/// [`keeps`] of a step that somebody else has taken.
///
/// # Panics
/// When it does not.
pub fn keeps_as_seen<'a>(
    exchange: &Exchange,
    history: &History,
    (before, input): (&Robot, &Input),
    outputs: impl IntoIterator<Item = &'a Output>,
    after: &Robot,
) -> History {
    let mut observer = Observer::new(exchange, history, before, input);
    for output in outputs {
        observer.see(output);
    }
    judged(Laws::All, (exchange, history), observer, before, after)
}

fn judged(
    laws: Laws,
    (exchange, history): (&Exchange, &History),
    observer: Observer,
    before: &Robot,
    after: &Robot,
) -> History {
    let now = observer.end(after);
    if laws != Laws::Heartbeats {
        judge_facts(exchange, (history, before), (&now, after));
    }
    if laws != Laws::Facts {
        judge_heartbeats(exchange, (&now, after));
    }
    now
}

/// Limits of a step.
///
/// # Panics
/// When it did something else.
pub fn judge(
    exchange: &Exchange,
    (history, before): (&History, &Robot),
    (now, after): (&History, &Robot),
) {
    judge_facts(exchange, (history, before), (now, after));
    judge_heartbeats(exchange, (now, after));
}

fn judge_facts(
    exchange: &Exchange,
    (history, before): (&History, &Robot),
    (now, after): (&History, &Robot),
) {
    assert!(facts::only_grow(history, now), "a fact is forgotten");
    assert!(
        facts::are_only_of(exchange, before.station, history, now),
        "a fact of another robot"
    );
    assert!(
        facts::are_consistent(exchange, now),
        "I2, I3, I6, I10: facts disagree"
    );
    assert!(
        robots::agrees(exchange, now, after),
        "state and facts disagree"
    );
}

fn judge_heartbeats(exchange: &Exchange, (now, after): (&History, &Robot)) {
    if robots::are_near(exchange, after) {
        assert!(
            robots::agrees_on_heartbeats(exchange, now, after),
            "I10: state and facts disagree on heartbeats"
        );
        leases::a_corridor_rests_on_the_follower(exchange, now, after);
    }
}

/// A robot that starts anew keeps what holds, with a boot counter that is larger than all before.
///
/// # Panics
/// When it does not.
pub fn keeps_over_a_reboot(exchange: &Exchange, history: &History, before: &Robot, boot: u16) {
    let now = lose_power(exchange, history, before);
    let after = Robot::new(before.station, boot);
    judge(exchange, (history, before), (&now, &after));
}

/// Steps of other robots leave this one as it is: of their facts more become known, and what holds still does.
///
/// # Panics
/// When it does not.
pub fn others_leave_it_so(exchange: &Exchange, history: &History, robot: &Robot, later: &History) {
    let now = facts::with_others(exchange, robot.station, history, later);
    if facts::only_grow(history, &now) {
        assert!(robots::agrees(exchange, &now, robot));
        assert!(robots::agrees_on_heartbeats(exchange, &now, robot));
    }
}

/// A robot that is neither leader nor follower makes nothing known, whatever it is told, says and becomes, as long as it keeps
/// its station and names itself in what it says; the theorem says so of the exchanges in which it leads or follows.
///
/// # Panics
/// When it does.
pub fn a_bystander_makes_nothing_known(
    exchange: &Exchange,
    history: &History,
    (before, input): (&Robot, &Input),
    output: &Output,
    after: &Robot,
) {
    let mut observer = Observer::new(exchange, history, before, input);
    observer.see(output);
    assert!(observer.end(after) == *history);
    assert!(robots::agrees(exchange, history, after));
    assert!(robots::agrees_on_heartbeats(exchange, history, after));
}

/// The implications of a message still hold when it arrives.
///
/// # Panics
/// When it is not.
pub fn messages_stay_true(
    exchange: &Exchange,
    (before, after): (&History, &History),
    ram: &Ram,
    rmcm: Rmcm,
) {
    if !facts::only_grow(before, after) {
        return;
    }
    assert!(
        !messages::ram_is_true(exchange, before, ram)
            || messages::ram_is_true(exchange, after, ram)
    );
    assert!(
        !messages::rmcm_is_true(exchange, before, rmcm)
            || messages::rmcm_is_true(exchange, after, rmcm)
    );
}
