//! Laws of elapsed time.
//!
//! Up to [`MAX_TIMERS`] timers fire in one step, in a loop that is too long to be proved at once. So
//! the loop is proved by its invariant, which is `Robot::is_consistent`, and by what decreases
//! in it:
//!
//! 1. letting all countdowns run keeps a valid state consistent,
//! 2. firing one timer keeps a consistent state consistent and leaves fewer timers due, and
//! 3. settling makes a consistent state without due timers valid.
//!
//! So the loop ends, after at most [`MAX_TIMERS`] rounds, in a valid state. That the outputs of all
//! rounds together are few enough is shown by a bound that no round exceeds: [`outputs_to_come`].

use crate::config::Config;
use crate::input::{Input, Timer};
use crate::output::OutputKind;
use crate::robot::Step;
use crate::state::{Contact, Phase, Robot};
use crate::time::Millis;
use crate::{MAX_FOLLOWERS, MAX_OUTPUTS, MAX_TIMERS};

use super::taken::Taken;
use super::watch::Watch;

/// 1: all countdowns run, and what is left of them is less.
pub fn running_keeps_the_state_consistent(config: &Config, robot: &Robot, elapsed: Millis) {
    let mut after = robot.clone();
    after.advance(elapsed);
    assert!(after.is_consistent(config));
    assert!(after.due_timers() <= MAX_TIMERS);
    if let (Some(before), Some(left)) = (robot.next_ram(), after.next_ram()) {
        assert!(left == before.saturating_sub(elapsed));
    }
}

/// Fires `timer` in `robot`, a part of a step.
#[must_use]
pub fn fire(config: &Config, robot: &Robot, timer: Timer, late: Millis) -> Taken {
    let mut after = robot.clone();
    let input = Input::Expired(timer);
    let mut said = Watch::new(robot, &input);
    let step = &mut Step {
        config,
        out: &mut said,
        renewed: false,
    };
    after.fire(step, timer, late);
    Taken {
        before: robot.clone(),
        input,
        said,
        after,
    }
}

/// 2: the state stays consistent, and fewer timers are due.
pub fn firing_keeps_the_state_consistent(config: &Config, fired: &Taken) {
    assert!(fired.after.is_consistent(config));
    assert!(fired.after.due_timers() < fired.before.due_timers());
}

/// 2: the outputs of one round take nothing from those to come.
pub fn firing_keeps_within_the_outputs(fired: &Taken) {
    let said = fired.said.len() - usize::from(fired.said.has(OutputKind::SendRam));
    assert!(said + outputs_to_come(&fired.after) <= outputs_to_come(&fired.before));
}

/// How many outputs besides `SendRam` the rounds of a step can still have: one for each timer that is
/// due, one for each follower that is dropped because its echo is too old, and what the robot has to
/// tell when it loses its part in the session.
#[must_use]
pub fn outputs_to_come(robot: &Robot) -> usize {
    let parting = match robot.phase() {
        Phase::Idle => 0,
        Phase::Following(following) if matches!(following.contact, Contact::Fresh(_)) => 3,
        Phase::Leading(leading) => 2 + leading.members.len(),
        // It may become a leader in one of the rounds.
        Phase::Requesting(_) => 2 + MAX_FOLLOWERS,
        _ => 2,
    };
    robot.due_timers() + parting
}

/// All rounds, the RAM, and the two outputs with which a step settles. A follower has one timer of
/// its own, so what it has to tell besides does not add to that of a leader.
const _: () = assert!(MAX_TIMERS + MAX_FOLLOWERS + 2 + 1 + 2 <= MAX_OUTPUTS);

/// 3: at most two outputs. The state that it makes is that of any step, which is valid.
pub fn settling_needs_few_outputs(config: &Config, robot: &Robot) {
    let mut after = robot.clone();
    let mut said = Watch::new(robot, &Input::Elapsed(Millis::ZERO));
    after.settle(&mut Step {
        config,
        out: &mut said,
        renewed: false,
    });
    assert!(said.len() <= 2);
}

/// The state with `timer`, if it is armed, due: the premise of a round.
#[must_use]
pub fn with_due(mut robot: Robot, timer: Timer) -> Robot {
    robot.rename_countdowns(|other, left| if other == timer { Millis::ZERO } else { left });
    robot
}

/// True if `timer` is due.
#[must_use]
pub fn is_due(robot: &Robot, timer: Timer) -> bool {
    robot.time_left(timer) == Some(Millis::ZERO)
}

/// True if the state is one that can occur within a step.
#[must_use]
pub fn is_consistent(robot: &Robot, config: &Config) -> bool {
    robot.is_consistent(config)
}
