//! What is needed besides the steps.

use super::{
    EventKind, Kind, Laws, Part, Role, Source, StationId, Symbolic, any_step, any_valid,
    any_watched, arbitrary, kani, messages, robots, steps,
};
use crossguard_protocol::{
    Event, FallbackPolicy, Input, Maneuver, ManeuverId, Output, Rmcm, StopReason,
};

use crate::harness::cases;

fn others_leave_it_so(part: Part, stage: Role) {
    let it = any_watched(part, stage);
    let later = arbitrary::history(&mut Symbolic, &it.exchange, &it.robot);
    steps::others_leave_it_so(&it.exchange, &it.history, &it.robot, &later);
    kani::cover!(it.history != later, "more is known");
}

fn bystands(stage: Role) {
    let it = any_watched(Part::Bystander, stage);
    let followers = usize::from(stage == Role::Leader);
    let after = any_valid(&it.config, stage, (followers, followers));
    kani::assume(after.station() == it.robot.station());
    let id = any_maneuver();
    let input = Input::Local(match choice(3) {
        0 => Event::InPosition(id),
        1 => Event::ManeuverCompleted(id),
        _ => Event::ManeuverFailed(id),
    });
    let maneuver = Maneuver {
        id: any_maneuver(),
        task: arbitrary::command(&mut Symbolic).task,
    };
    let output = match choice(6) {
        0 => Output::SendRam,
        1 => {
            let mut command = arbitrary::command(&mut Symbolic);
            command.session.leader = after.station();
            Output::SendRmcm(Rmcm::Command(command))
        }
        2 => {
            let mut answer = arbitrary::answer(&mut Symbolic);
            answer.from = after.station();
            Output::SendRmcm(Rmcm::Answer(answer))
        }
        3 => Output::StartManeuver(maneuver),
        4 => Output::StopManeuver(maneuver, StopReason::Superseded),
        _ => Output::FallBack(maneuver, FallbackPolicy::StopInPlace),
    };
    let step = (&it.robot, &input);
    steps::a_bystander_makes_nothing_known(&it.exchange, &it.history, step, &output, &after);
    kani::cover!(it.history.requested, "while a session is open");
}

/// One of so many alternatives.
fn choice(of: u32) -> u32 {
    Symbolic.number(of - 1, of)
}

/// One of a list.
fn one_of<T: Copy>(all: &[T]) -> T {
    let count = u32::try_from(all.len()).expect("lists are short");
    all[choice(count) as usize]
}

fn any_maneuver() -> ManeuverId {
    let command = arbitrary::command(&mut Symbolic);
    ManeuverId::of(command.session, command.request)
}

fn stays_true(kind: u32) {
    let it = any_watched(Part::Bystander, Role::None);
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

fn reboots(part: Part, stage: Role) {
    let it = any_watched(part, stage);
    let boot = Symbolic.number(u16::MAX.into(), u32::from(it.robot.boot()) + 1);
    let boot = u16::try_from(boot).unwrap_or(u16::MAX);
    kani::assume(boot > it.robot.boot());
    steps::keeps_over_a_reboot(&it.exchange, &it.history, &it.robot, boot);
    kani::cover!(true, "boots");
}

cases! { 6;
    /// What others do leaves a requesting leader as it is.
    a_requester_is_left_so => others_leave_it_so(Part::Leader, Role::Requester);

    /// What others do leaves a leader as it is.
    a_leader_is_left_so => others_leave_it_so(Part::Leader, Role::Leader);

    /// What others do leaves a follower as it is.
    a_follower_is_left_so => others_leave_it_so(Part::Follower, Role::Follower);

    /// A request stays true.
    what_a_requester_says_stays_true => stays_true(1);

    /// An offer stays true.
    what_a_helper_says_stays_true => stays_true(2);

    /// A list of followers stays true.
    what_a_leader_says_stays_true => stays_true(3);

    /// A report and an answer stay true.
    what_a_follower_says_stays_true => stays_true(4);

    /// A robot that leads or follows elsewhere makes nothing known.
    a_bystander_leads => bystands(Role::Leader);

    /// A robot that follows elsewhere makes nothing known.
    a_bystander_follows => bystands(Role::Follower);

    /// A robot that asks for help makes nothing known.
    a_bystander_asks => bystands(Role::Requester);

    /// A helper of another session makes nothing known.
    a_bystander_helps => bystands(Role::Helper);

    /// A robot without a part makes nothing known.
    a_bystander_idles => bystands(Role::None);

    /// A leader loses power and boots.
    a_leader_reboots => reboots(Part::Leader, Role::Leader);

    /// A follower loses power and boots.
    a_follower_reboots => reboots(Part::Follower, Role::Follower);

    /// A robot takes another station id, which may be that of the leader or the follower.
    a_station_is_taken => {
        let kind = Kind::Local(EventKind::IdentityChanged);
        let kept = any_step(Part::Bystander, Role::None, kind, Laws::All);
        let leads = Part::Leader.is_of(&kept.exchange, &kept.after);
        let follows = Part::Follower.is_of(&kept.exchange, &kept.after);
        kani::cover!(leads, "the leader's");
        kani::cover!(follows, "the follower's");
    };

    /// Any robot, with any part or none, any input.
    #[random_only("all stages, parts and kinds of input at once")]
    any_robot_keeps_it => {
        let part = one_of(&[Part::Leader, Part::Follower, Part::Bystander]);
        let stage = one_of(&Role::ALL);
        let kinds = [
            Kind::RamNone,
            Kind::RamNeedHelp,
            Kind::RamOfferHelp,
            Kind::RamLeader,
            Kind::RamFollower,
            Kind::Command,
            Kind::Answer,
            Kind::Elapsed,
            Kind::Expired,
        ];
        let kind = match choice(2) {
            0 => one_of(&kinds),
            _ => Kind::Local(one_of(&EventKind::ALL)),
        };
        let kept = any_step(part, stage, kind, Laws::All);
        kani::cover!(kept.changed(), "a fact becomes known");
        kani::cover!(robots::agrees(&kept.exchange, &kept.was, &kept.after) && kept.before != kept.after, "none does");
    };
}
