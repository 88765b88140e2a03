//! Lemmas that are needed besides the steps.

use super::{
    EventKind, Kind, Part, Proved, Role, Source, StationId, Symbolic, Taken, TimerKind, any_valid,
    any_watched, arbitrary, config, follower, kani, leader, messages, steps,
};
use crossguard_protocol::Rmcm;
use crossguard_protocol::laws::steps::ignores_without_effect;

use crate::harness::cases;

/// Gives each kind of input to another macro, behind what that is to be told first.
macro_rules! each_kind {
    ($then:ident! $($first:tt)*) => {
        each_kind! { @$then [$($first)*]
            RamNone RamNeedHelp RamOfferHelp RamLeader RamFollower Command Answer;
            Safety Leave Lease Lost Execution Acknowledgement Help Offer Selection Reservation IdentityLock Farewell Ram;
            PedestrianDetected CommandManeuver InPosition ManeuverCompleted ManeuverFailed TaskCompleted RoadClear AllAnswered
            LeaveRequested AvailabilityChanged OpenCorridor CloseCorridor IdentityChanged EpochRenewed OutOfPosition PersonOnRoad
        }
    };
    (@$then:ident [$($first:tt)*] $($message:ident)+; $($timer:ident)+; $($event:ident)+) => {
        $then! { $($first)*
            $(Kind::$message,)+ $(Kind::Fires(TimerKind::$timer),)+ $(Kind::Local(EventKind::$event),)+
        }
    };
}

macro_rules! all {
    ($($kind:expr,)+) => {
        &[$($kind),+]
    };
}

/// All kinds of inputs. Time that passes is none: it lets timers fire, and the step settles.
pub const KINDS: &[Kind] = each_kind!(all!);

/// A number for each kind: a constant cannot compare them.
const fn number_of(kind: Kind) -> (u8, u8) {
    match kind {
        Kind::RamNone => (0, 0),
        Kind::RamNeedHelp => (0, 1),
        Kind::RamOfferHelp => (0, 2),
        Kind::RamLeader => (0, 3),
        Kind::RamFollower => (0, 4),
        Kind::Command => (0, 5),
        Kind::Answer => (0, 6),
        Kind::Elapsed => (0, 7),
        Kind::Expired => (0, 8),
        Kind::Fires(timer) => (1, timer as u8),
        Kind::Local(event) => (2, event as u8),
    }
}

const fn is_one_of(proved: &[Proved], stage: Role, kind: Kind) -> bool {
    let (group, number) = number_of(kind);
    let mut i = 0;
    while i < proved.len() {
        let (of_stage, of_kind, _) = proved[i];
        let (of_group, of_number) = number_of(of_kind);
        if of_stage as u8 == stage as u8 && of_group == group && of_number == number {
            return true;
        }
        i += 1;
    }
    false
}

/// True if a harness of a step proves this pair.
#[must_use]
pub const fn is_proved(stage: Role, kind: Kind) -> bool {
    is_one_of(leader::PROVED, stage, kind) || is_one_of(follower::PROVED, stage, kind)
}

/// Each input of a kind that no harness proves in this stage is ignored; so is a timer that the stage does not have.
macro_rules! ignores_all_else {
    ($stage:ident $($kind:expr,)+) => {{
        let config = config();
        let robot = any_valid(&config, Role::$stage);
        $(
            if const { !is_proved(Role::$stage, $kind) } {
                let input = arbitrary::input(&mut Symbolic, $kind, true);
                let step = Taken::new(&config, robot.clone(), input);
                assert!(step.is_ignored());
                ignores_without_effect(&step);
            }
        )+
        kani::cover!(true, "ignored");
    }};
}

/// Which of [`KINDS`] no harness of a step proves in this stage, as bits: a proof reads a constant then.
const fn ignored(stage: Role) -> u64 {
    let (mut ignored, mut i) = (0, 0);
    while i < KINDS.len() {
        ignored |= (!is_proved(stage, KINDS[i]) as u64) << i;
        i += 1;
    }
    ignored
}

/// An ignored input keeps what holds: a body tells facts even so.
fn keeps_what_it_ignores(stage: Role, ignored: u64) {
    let it = any_watched(stage);
    let number = Symbolic.number(u32::MAX, u32::MAX) as usize % KINDS.len();
    kani::assume(ignored >> number & 1 == 1);
    let input = arbitrary::input(&mut Symbolic, KINDS[number], true);
    kani::assume(steps::can_be_next(
        &it.exchange,
        &it.history,
        &it.robot,
        &input,
    ));
    let step = (&it.robot, &input);
    let now = steps::keeps_as_seen(&it.exchange, &it.history, step, &[], &it.robot);
    kani::cover!(
        Part::Follower.is_of(&it.exchange, &it.robot),
        "its follower"
    );
    kani::cover!(it.history == now, "no fact becomes known");
}

fn is_left_so(stage: Role) {
    let it = any_watched(stage);
    let later = arbitrary::history(&mut Symbolic, &it.exchange, &it.robot);
    steps::others_leave_it_so(&it.exchange, &it.history, &it.robot, &later);
    kani::cover!(it.history != later, "more is known");
}

fn reboots(stage: Role) {
    let it = any_watched(stage);
    let boot = Symbolic.number(u16::MAX.into(), u32::from(it.robot.boot()) + 1);
    let boot = u16::try_from(boot).unwrap_or(u16::MAX);
    kani::assume(boot > it.robot.boot());
    steps::keeps_over_a_reboot(&it.exchange, &it.history, &it.robot, boot);
    kani::cover!(true, "boots");
}

fn stays_true(kind: u32) {
    let it = any_watched(Role::None);
    let later = arbitrary::history(&mut Symbolic, &it.exchange, &it.robot);
    let mut ram = arbitrary::ram(&mut Symbolic, kind, true);
    // Hints let it be of the follower or leader.
    if Symbolic.flag() {
        ram.station = StationId(Symbolic.number(u32::MAX, it.exchange.follower.0));
    }
    let rmcm = if Symbolic.flag() {
        Rmcm::Command(arbitrary::command(&mut Symbolic))
    } else {
        Rmcm::Answer(arbitrary::answer(&mut Symbolic))
    };
    let facts = (&it.history, &later);
    steps::messages_stay_true(&it.exchange, facts, &ram, rmcm);
    kani::cover!(
        messages::ram_is_true(&it.exchange, &it.history, &ram),
        "is so"
    );
}

/// Declares harnesses by what they have in common.
macro_rules! lemmas {
    ($($doc:literal { $($name:ident => $case:expr;)+ })+) => {
        cases! { 6; $($(#[doc = $doc] $name => $case;)+)+ }
    };
}

lemmas! {
    "Whatever has no harness of a step is ignored." {
        an_idle_robot_ignores_all_else => each_kind!(ignores_all_else! None);
        a_requester_ignores_all_else => each_kind!(ignores_all_else! Requester);
        a_helper_ignores_all_else => each_kind!(ignores_all_else! Helper);
        a_follower_ignores_all_else => each_kind!(ignores_all_else! Follower);
        a_leader_ignores_all_else => each_kind!(ignores_all_else! Leader);
    }

    "What is ignored keeps what holds." {
        an_idle_robot_keeps_what_it_ignores => keeps_what_it_ignores(Role::None, const { ignored(Role::None) });
        a_requester_keeps_what_it_ignores => keeps_what_it_ignores(Role::Requester, const { ignored(Role::Requester) });
        a_helper_keeps_what_it_ignores => keeps_what_it_ignores(Role::Helper, const { ignored(Role::Helper) });
        a_follower_keeps_what_it_ignores => keeps_what_it_ignores(Role::Follower, const { ignored(Role::Follower) });
        a_leader_keeps_what_it_ignores => keeps_what_it_ignores(Role::Leader, const { ignored(Role::Leader) });
    }

    "What others do leaves the robot as it is." {
        an_idle_robot_is_left_so => is_left_so(Role::None);
        a_requester_is_left_so => is_left_so(Role::Requester);
        a_helper_is_left_so => is_left_so(Role::Helper);
        a_follower_is_left_so => is_left_so(Role::Follower);
        a_leader_is_left_so => is_left_so(Role::Leader);
    }

    "The robot loses power and boots." {
        an_idle_robot_reboots => reboots(Role::None);
        a_requester_reboots => reboots(Role::Requester);
        a_helper_reboots => reboots(Role::Helper);
        a_follower_reboots => reboots(Role::Follower);
        a_leader_reboots => reboots(Role::Leader);
    }

    "A message stays true." {
        what_a_requester_says_stays_true => stays_true(1);
        what_a_helper_says_stays_true => stays_true(2);
        what_a_leader_says_stays_true => stays_true(3);
        what_a_follower_says_stays_true => stays_true(4);
    }
}
