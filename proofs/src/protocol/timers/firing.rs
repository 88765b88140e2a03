//! 2: one timer fires.

use crossguard_protocol::laws::Source;
use crossguard_protocol::laws::arbitrary::AnyWord;
use crossguard_protocol::laws::lease::heartbeats_count_time_alone;
use crossguard_protocol::laws::steps;
use crossguard_protocol::laws::taken::Taken;
use crossguard_protocol::laws::timers::{self as laws, firing_keeps_the_state_consistent};
use crossguard_protocol::{Config, Millis, Role, Timer, TimerKind};

use super::any_within_a_step;
use crate::harness::harnesses;
use crate::protocol::stage;
use crate::{Symbolic, kani};

fn any_firing(stage: Role, countdown: TimerKind, laws_of_it: fn(&Config, &Taken)) {
    let config = stage::config();
    let timer = Timer::any_of(countdown, &mut Symbolic);
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
            fn $name() {
                any_firing(Role::$stage, TimerKind::$countdown, $laws);
            }
        )+ }
    };
}

firing! {
    idle_identity_lock(None, IdentityLock, all)
    idle_farewell(None, Farewell, all)
    idle_ram(None, Ram, all)
    requesting_offer(Requester, Offer, all)
    requesting_help(Requester, Help, all)
    requesting_selection(Requester, Selection, all)
    requesting_identity_lock(Requester, IdentityLock, all)
    requesting_farewell(Requester, Farewell, all)
    requesting_ram(Requester, Ram, all)
    offering_reservation(Helper, Reservation, all)
    offering_identity_lock(Helper, IdentityLock, all)
    offering_farewell(Helper, Farewell, all)
    offering_ram(Helper, Ram, all)
    following_safety(Follower, Safety, all)
    following_leave(Follower, Leave, all)
    following_identity_lock(Follower, IdentityLock, all)
    following_farewell(Follower, Farewell, all)
    following_ram(Follower, Ram, all)
    leading_lease(Leader, Lease, leader)
    leading_lost(Leader, Lost, leader)
    leading_execution(Leader, Execution, leader)
    leading_acknowledgement(Leader, Acknowledgement, leader)
    leading_identity_lock(Leader, IdentityLock, leader)
    leading_farewell(Leader, Farewell, leader)
    leading_ram(Leader, Ram, conduct)
    leading_ram_stays_consistent(Leader, Ram, firing_keeps_the_state_consistent)
}
