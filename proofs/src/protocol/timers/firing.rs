//! 2: one timer fires.

use crossguard_protocol::laws::arbitrary::{Countdown, Stage};
use crossguard_protocol::laws::{Source, steps, timers as laws};
use crossguard_protocol::{Config, Millis};

use super::any_within_a_step;
use crate::harness::harnesses;
use crate::{Symbolic, kani};

fn any_firing(stage: Stage, countdown: Countdown) {
    let config = Config::default();
    let timer = countdown.timer(&mut Symbolic);
    let robot = laws::with_due(any_within_a_step(&config, stage), timer);
    kani::assume(laws::is_due(&robot, timer) && laws::is_consistent(&robot, &config));
    let late = Millis(Symbolic.number(u32::MAX, 0));
    let fired = laws::fire(&config, &robot, timer, late);
    laws::firing_keeps_the_state_consistent(&config, &fired);
    laws::firing_keeps_within_the_outputs(&fired);
    steps::tells_the_body(&fired);
    steps::final_progress_stays(&fired);
    kani::cover!(true, "fires");
}

/// Declares one harness for each stage and each timer that it can have.
macro_rules! firing {
    ($($name:ident($stage:ident, $countdown:ident))+) => {
        harnesses! { $(
            #[doc = concat!("The timer *", stringify!($countdown), "* of stage *", stringify!($stage), "*.")]
            #[unwind(6)]
            #[solver(cadical)]
            fn $name() {
                any_firing(Stage::$stage, Countdown::$countdown);
            }
        )+ }
    };
}

firing! {
    idle_identity_lock(Idle, IdentityLock)
    idle_farewell(Idle, Farewell)
    idle_ram(Idle, Ram)
    requesting_help(Requesting, Help)
    requesting_selection(Requesting, Selection)
    requesting_identity_lock(Requesting, IdentityLock)
    requesting_farewell(Requesting, Farewell)
    requesting_ram(Requesting, Ram)
    offering_reservation(Offering, Reservation)
    offering_identity_lock(Offering, IdentityLock)
    offering_farewell(Offering, Farewell)
    offering_ram(Offering, Ram)
    following_safety(Following, Safety)
    following_leave(Following, Leave)
    following_identity_lock(Following, IdentityLock)
    following_farewell(Following, Farewell)
    following_ram(Following, Ram)
    leading_lease(Leading, Lease)
    leading_lost(Leading, Lost)
    leading_execution(Leading, Execution)
    leading_acknowledgement(Leading, Acknowledgement)
    leading_identity_lock(Leading, IdentityLock)
    leading_farewell(Leading, Farewell)
    leading_ram(Leading, Ram)
}
