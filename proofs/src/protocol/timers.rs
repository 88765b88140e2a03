//! Elapsed time: one timer fires, a round of the loop that `crossguard_protocol::laws::timers` takes apart.
//!
//! Each harness starts from any state that can occur within a step: consistent, with any timers due,
//! and at most two offers or one or two followers. The theorem ([`exchange`](super::exchange)) proves that the state stays
//! consistent, that countdowns run, and that the step settles. A RAM may be later here than it assumes.

use crossguard_protocol::laws::Source;
use crossguard_protocol::laws::arbitrary::{self, AnyWord};
use crossguard_protocol::laws::lease::heartbeats_count_time_alone;
use crossguard_protocol::laws::steps;
use crossguard_protocol::laws::taken::Taken;
use crossguard_protocol::laws::timers::{self as laws, firing_keeps_the_state_consistent};
use crossguard_protocol::{Config, Millis, Role, Timer, TimerKind};

use super::stage;
use crate::harness::harnesses;
use crate::{Symbolic, kani};

fn any_firing(stage: Role, countdown: TimerKind, laws_of_it: fn(&Config, &Taken)) {
    let config = stage::config();
    let timer = Timer::any_of(countdown, &mut Symbolic);
    let robot = arbitrary::robot(&mut Symbolic, &config, stage, stage::peers(stage));
    let robot = laws::with_due(robot, timer);
    kani::assume(laws::is_due(&robot, timer) && laws::is_consistent(&robot, &config));
    let late = Millis(Symbolic.number(u32::MAX, 0));
    let fired = laws::fire(&config, &robot, timer, late);
    laws_of_it(&config, &fired);
    kani::cover!(true, "fires");
}

fn conduct(_: &Config, fired: &Taken) {
    laws::firing_keeps_within_the_outputs(fired);
    steps::tells_the_body(fired);
    steps::final_progress_stays(fired);
}

/// The laws of a leader, whose leases count from heartbeats.
fn leader(config: &Config, fired: &Taken) {
    conduct(config, fired);
    heartbeats_count_time_alone(fired);
}

/// The laws of a RAM, however late it is.
fn ram(config: &Config, fired: &Taken) {
    firing_keeps_the_state_consistent(config, fired);
    conduct(config, fired);
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
    idle_identity_lock(None, IdentityLock, conduct)
    idle_farewell(None, Farewell, conduct)
    idle_ram(None, Ram, ram)
    requesting_offer(Requester, Offer, conduct)
    requesting_help(Requester, Help, conduct)
    requesting_selection(Requester, Selection, conduct)
    requesting_identity_lock(Requester, IdentityLock, conduct)
    requesting_farewell(Requester, Farewell, conduct)
    requesting_ram(Requester, Ram, ram)
    offering_reservation(Helper, Reservation, conduct)
    offering_identity_lock(Helper, IdentityLock, conduct)
    offering_farewell(Helper, Farewell, conduct)
    offering_ram(Helper, Ram, ram)
    following_safety(Follower, Safety, conduct)
    following_leave(Follower, Leave, conduct)
    following_identity_lock(Follower, IdentityLock, conduct)
    following_farewell(Follower, Farewell, conduct)
    following_ram(Follower, Ram, ram)
    leading_lease(Leader, Lease, leader)
    leading_lost(Leader, Lost, leader)
    leading_execution(Leader, Execution, leader)
    leading_acknowledgement(Leader, Acknowledgement, leader)
    leading_identity_lock(Leader, IdentityLock, leader)
    leading_farewell(Leader, Farewell, leader)
    leading_ram(Leader, Ram, conduct)
    leading_ram_stays_consistent(Leader, Ram, firing_keeps_the_state_consistent)
}
