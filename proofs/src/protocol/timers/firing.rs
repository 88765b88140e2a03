//! 2: one timer fires.

use crossguard_protocol::laws::Source;
use crossguard_protocol::laws::arbitrary::{Stage, TimerKind};
use crossguard_protocol::laws::lease::heartbeats_count_time_alone;
use crossguard_protocol::laws::steps;
use crossguard_protocol::laws::taken::Taken;
use crossguard_protocol::laws::timers::{self as laws, firing_keeps_the_state_consistent};
use crossguard_protocol::{Config, Millis};

use super::any_within_a_step;
use crate::harness::harnesses;
use crate::protocol::stage;
use crate::{Symbolic, kani};

fn any_firing(stage: Stage, countdown: TimerKind, laws_of_it: fn(&Config, &Taken)) {
    let config = stage::config();
    let timer = countdown.timer(&mut Symbolic);
    let robot = laws::with_due(any_within_a_step(&config, stage), timer);
    kani::assume(laws::is_due(&robot, timer) && laws::is_consistent(&robot, &config));
    let late = Millis(Symbolic.number(u32::MAX, 0));
    let fired = laws::fire(&config, &robot, timer, late);
    laws_of_it(&config, &fired);
    kani::cover!(true, "fires");
}

fn all(config: &Config, fired: &Taken) {
    firing_keeps_the_state_consistent(config, fired);
    conduct(config, fired);
}

/// All laws but that the state stays consistent: where both together are much to prove, they are proved apart.
fn conduct(_: &Config, fired: &Taken) {
    laws::firing_keeps_within_the_outputs(fired);
    steps::tells_the_body(fired);
    steps::final_progress_stays(fired);
}

/// All laws of a leader, whose leases count from heartbeats.
fn leader(config: &Config, fired: &Taken) {
    all(config, fired);
    heartbeats_count_time_alone(fired);
}

/// Declares one harness for each stage and each timer that it can have.
macro_rules! firing {
    ($($name:ident($stage:ident, $countdown:ident, $laws:ident))+) => {
        harnesses! { $(
            #[doc = concat!("The timer *", stringify!($countdown), "* of stage *", stringify!($stage), "*.")]
            #[unwind(6)]
            #[solver(cadical)]
            fn $name() {
                any_firing(Stage::$stage, TimerKind::$countdown, $laws);
            }
        )+ }
    };
}

firing! {
    idle_identity_lock(Idle, IdentityLock, all)
    idle_farewell(Idle, Farewell, all)
    idle_ram(Idle, Ram, all)
    requesting_offer(Requesting, Offer, all)
    requesting_help(Requesting, Help, all)
    requesting_selection(Requesting, Selection, all)
    requesting_identity_lock(Requesting, IdentityLock, all)
    requesting_farewell(Requesting, Farewell, all)
    requesting_ram(Requesting, Ram, all)
    offering_reservation(Offering, Reservation, all)
    offering_identity_lock(Offering, IdentityLock, all)
    offering_farewell(Offering, Farewell, all)
    offering_ram(Offering, Ram, all)
    following_safety(Following, Safety, all)
    following_leave(Following, Leave, all)
    following_identity_lock(Following, IdentityLock, all)
    following_farewell(Following, Farewell, all)
    following_ram(Following, Ram, all)
    leading_lease(Leading, Lease, leader)
    leading_lost(Leading, Lost, leader)
    leading_execution(Leading, Execution, leader)
    leading_acknowledgement(Leading, Acknowledgement, leader)
    leading_identity_lock(Leading, IdentityLock, leader)
    leading_farewell(Leading, Farewell, leader)
    leading_ram(Leading, Ram, conduct)
    leading_ram_stays_consistent(Leading, Ram, firing_keeps_the_state_consistent)
}
