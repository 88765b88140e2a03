//! The theorem: one step of a robot keeps what holds of any exchange, whatever part it has in it, and breaks no property of it.
//!
//! Each harness has a robot in any valid state of a stage, any exchange in which it has a part, any history that agrees
//! with both, and any input of a kind that such a history allows.

use crossguard_protocol::laws::Source;
use crossguard_protocol::laws::arbitrary::{self, Happening, Kind, Part, Stage, TimerKind};
use crossguard_protocol::laws::exchange::{Exchange, History, messages, robots, steps};
use crossguard_protocol::laws::timers;
use crossguard_protocol::{Config, Millis, Phase, Robot, StationId};

use super::stage::{self, any_valid};
use super::timers::any_within_a_step;
use crate::harness::harnesses;
use crate::{Symbolic, kani};

/// A robot, an exchange and a history that agree.
struct Watched {
    config: Config,
    exchange: Exchange,
    history: History,
    robot: Robot,
}

/// What a step did.
struct Kept {
    exchange: Exchange,
    was: History,
    now: History,
    before: Robot,
    after: Robot,
}

fn any_watched(part: Part, stage: Stage) -> Watched {
    let config = stage::config();
    let peers = match stage {
        Stage::Requesting => (0, 2),
        Stage::Leading => (1, 2),
        Stage::Idle | Stage::Offering | Stage::Following => (0, 0),
    };
    let robot = any_valid(&config, stage, peers);
    of(part, config, robot)
}

fn of(part: Part, config: Config, robot: Robot) -> Watched {
    let exchange = arbitrary::exchange(&mut Symbolic, part, &robot, &config);
    kani::assume(part.is_of(&exchange, &robot));
    kani::assume(exchange.session.leader != exchange.follower);
    let history = arbitrary::history(&mut Symbolic, &exchange, &robot);
    kani::assume(robots::are_near(&exchange, &robot));
    kani::assume(steps::holds(&exchange, &history, &robot));
    Watched {
        config,
        exchange,
        history,
        robot,
    }
}

fn any_step(part: Part, stage: Stage, kind: Kind) -> Kept {
    let Watched {
        config,
        exchange,
        history,
        robot,
    } = any_watched(part, stage);
    let input = arbitrary::input(&mut Symbolic, kind, kind == Kind::RamNone);
    kani::assume(steps::can_be_next(&exchange, &history, &robot, &input));
    let (now, after) = steps::keeps(&config, &exchange, &history, &robot, input);
    Kept {
        exchange,
        was: history,
        now,
        before: robot,
        after,
    }
}

/// A due timer, in any state that can occur within a step.
fn any_firing(part: Part, stage: Stage, countdown: TimerKind) -> Kept {
    let config = stage::config();
    let timer = countdown.timer(&mut Symbolic);
    let robot = timers::with_due(any_within_a_step(&config, stage), timer);
    kani::assume(timers::is_due(&robot, timer) && timers::is_consistent(&robot, &config));
    let Watched {
        config,
        exchange,
        history,
        robot,
    } = of(part, config, robot);
    let late = Millis(Symbolic.number(u32::MAX, 0));
    let (now, after) = steps::keeps_when_fired(&config, &exchange, &history, &robot, (timer, late));
    Kept {
        exchange,
        was: history,
        now,
        before: robot,
        after,
    }
}

impl Kept {
    fn changed(&self) -> bool {
        self.was != self.now
    }
}

/// Declares harnesses of one part: stage, kind of input, and what must be able to come of it.
macro_rules! steps {
    ($part:ident; $(
        $(#[doc = $doc:literal])*
        $name:ident($stage:ident, $kind:expr) |$kept:ident| { $($mark:literal: $came:expr),+ $(,)? }
    )+) => {
        harnesses! { $(
            $(#[doc = $doc])*
            #[unwind(6)]
            #[solver(cadical)]
            fn $name() {
                let $kept = &match $kind {
                    Kind::Fires(timer) => any_firing(Part::$part, Stage::$stage, timer),
                    kind => any_step(Part::$part, Stage::$stage, kind),
                };
                $(
                    let came: bool = $came;
                    kani::cover!(came, $mark);
                )+
            }
        )+ }
    };
}

/// A robot that is the leader of the exchange.
pub mod leader {
    use super::{
        Happening, Kind, Part, Phase, Stage, TimerKind, any_firing, any_step, harnesses, kani,
    };

    steps! { Leader;
        /// It opens a session, which may be the watched one.
        detects_a_pedestrian(Idle, Kind::Local(Happening::PedestrianDetected)) |kept| {
            "opens it": !kept.was.requested && kept.now.requested,
            "opens another": kept.was.ended && kept.before != kept.after,
        }

        /// It is offered help.
        hears_an_offer(Requesting, Kind::RamOfferHelp) |kept| {
            "takes it": kept.was.offered && kept.before != kept.after,
            "does not": !kept.was.offered && kept.before == kept.after,
        }

        /// A helper takes its offer back.
        hears_a_farewell_of_a_helper(Requesting, Kind::RamNone) |kept| {
            "forgets it": kept.before != kept.after,
        }

        /// It chooses its followers.
        selects(Requesting, Kind::Local(Happening::AllAnswered)) |kept| {
            "lists it": kept.was.listed.is_none() && kept.now.listed.is_some(),
            "lists others": matches!(kept.after.phase(), Phase::Leading(_)) && kept.now.listed.is_none(),
        }

        /// A follower answers.
        hears_an_answer(Leading, Kind::Answer) |kept| {
            "counts it": kept.was.accepted && kept.before != kept.after,
            "is refused": kept.was.refused && kept.before != kept.after,
            "does not": kept.before == kept.after,
        }

        /// A follower reports.
        hears_a_follower(Leading, Kind::RamFollower) |kept| {
            "counts it as joined": kept.was.joined && kept.before != kept.after,
            "is of another": !kept.was.joined && kept.before != kept.after,
        }

        /// A follower leaves.
        hears_a_farewell(Leading, Kind::RamNone) |kept| {
            "drops it": !kept.was.dropped && kept.now.dropped,
            "drops another": kept.before != kept.after && !kept.now.dropped,
        }

        /// It commands.
        commands(Leading, Kind::Local(Happening::CommandManeuver)) |kept| {
            "commands it": kept.was.commanded.is_none() && kept.now.commanded.is_some(),
            "commands something else": !kept.changed() && kept.before != kept.after,
        }

        /// It repeats a command or drops the follower.
        repeats_a_command(Leading, Kind::Fires(TimerKind::Acknowledgement)) |kept| {
            "repeats": !kept.now.dropped && kept.before != kept.after,
            "drops it": !kept.was.dropped && kept.now.dropped,
        }

        /// It loses a follower.
        loses_a_follower(Leading, Kind::Fires(TimerKind::Lost)) |kept| {
            "drops it": !kept.was.dropped && kept.now.dropped,
            "drops another": kept.before != kept.after && !kept.now.dropped,
        }

        /// A command takes too long.
        gives_a_command_up(Leading, Kind::Fires(TimerKind::Execution)) |kept| {
            "gives it up": kept.was.accepted,
        }

        /// It has had time to choose.
        has_chosen(Requesting, Kind::Fires(TimerKind::Selection)) |kept| {
            "lists it": kept.was.listed.is_none() && kept.now.listed.is_some(),
        }

        /// Nobody helps.
        finds_no_help(Requesting, Kind::Fires(TimerKind::Help)) |kept| {
            "ends it": !kept.was.ended && kept.now.ended,
        }

        /// A lease ends.
        ends_a_lease(Leading, Kind::Fires(TimerKind::Lease)) |kept| {
            "of a follower": kept.was.joined && kept.before != kept.after,
        }

        /// The identity cannot be locked any longer.
        must_unlock(Leading, Kind::Fires(TimerKind::IdentityLock)) |kept| {
            "ends it": !kept.was.ended && kept.now.ended,
        }

        /// It completes the task.
        completes_the_task(Leading, Kind::Local(Happening::TaskCompleted)) |kept| {
            "ends it": !kept.was.ended && kept.now.ended,
            "ends another": kept.was.ended,
        }
    }
}

/// A robot that is the follower of the exchange.
pub mod follower {
    use super::{
        Happening, Kind, Part, Phase, Stage, TimerKind, any_firing, any_step, harnesses, kani,
    };

    steps! { Follower;
        /// It is asked for help.
        hears_a_request(Idle, Kind::RamNeedHelp) |kept| {
            "makes the offer": !kept.was.offered && kept.now.offered,
            "makes another": !kept.now.offered && kept.before != kept.after,
        }

        /// It hears which helpers follow.
        is_chosen(Offering, Kind::RamLeader) |kept| {
            "joins": !kept.was.joined && kept.now.joined,
            "joins another session": !kept.now.joined && matches!(kept.after.phase(), Phase::Following(_)),
            "is not listed": matches!(kept.after.phase(), Phase::Idle),
        }

        /// The session ends before it is chosen.
        takes_its_offer_back(Offering, Kind::RamNone) |kept| {
            "takes it back": kept.before != kept.after,
        }

        /// It hears its leader.
        hears_a_leader(Following, Kind::RamLeader) |kept| {
            "leaves": !kept.was.left && kept.now.left,
            "stays": kept.was.joined && !kept.now.left && kept.before != kept.after,
        }

        /// It is commanded.
        hears_a_command(Following, Kind::Command) |kept| {
            "starts it": !kept.was.started && kept.now.started,
            "refuses it": !kept.was.refused && kept.now.refused,
            "starts a newer one": !kept.was.newer_started && kept.now.newer_started,
            "stops it for another": !kept.was.over && kept.now.over,
            "answers again": kept.was.accepted && kept.before == kept.after,
        }

        /// Its body holds its place.
        reaches_its_position(Following, Kind::Local(Happening::InPosition)) |kept| {
            "reaches it": !kept.was.in_position && kept.now.in_position,
            "another": !kept.changed() && kept.before != kept.after,
        }

        /// Its body has done what was commanded.
        completes_a_maneuver(Following, Kind::Local(Happening::ManeuverCompleted)) |kept| {
            "completes it": !kept.was.completed && kept.now.completed && kept.now.over,
            "another": !kept.changed() && kept.before != kept.after,
        }

        /// Its body fails.
        fails_a_maneuver(Following, Kind::Local(Happening::ManeuverFailed)) |kept| {
            "fails at it": !kept.was.over && kept.now.over,
        }

        /// It does not hear its leader any more.
        falls_back(Following, Kind::Fires(TimerKind::Safety)) |kept| {
            "falls back": !kept.was.fell_back && kept.now.fell_back,
            "executes nothing": !kept.changed(),
        }

        /// It leaves a leader that is silent.
        leaves_the_silent(Following, Kind::Fires(TimerKind::Leave)) |kept| {
            "leaves": !kept.was.left && kept.now.left,
        }

        /// Its offer is over.
        is_not_chosen(Offering, Kind::Fires(TimerKind::Reservation)) |kept| {
            "gives it up": kept.was.offered && kept.before != kept.after,
        }

        /// The identity cannot be locked any longer.
        must_unlock(Following, Kind::Fires(TimerKind::IdentityLock)) |kept| {
            "leaves": !kept.was.left && kept.now.left,
            "falls back": !kept.was.fell_back && kept.now.fell_back,
        }

        /// It is told that the session ended.
        is_released(Following, Kind::RamNone) |kept| {
            "leaves": !kept.was.left && kept.now.left,
            "stops": !kept.was.over && kept.now.over && !kept.now.fell_back,
            "falls back": !kept.was.fell_back && kept.now.fell_back,
        }

        /// It is to leave.
        leaves(Following, Kind::Local(Happening::LeaveRequested)) |kept| {
            "leaves": !kept.was.left && kept.now.left,
            "falls back": !kept.was.fell_back && kept.now.fell_back,
        }

        /// It becomes available or unavailable.
        changes_its_availability(Following, Kind::Local(Happening::AvailabilityChanged)) |kept| {
            "stops": !kept.was.over && kept.now.over,
            "leaves": !kept.was.left && kept.now.left,
        }
    }
}

/// What is needed besides the steps.
pub mod frame {
    use super::{
        Happening, Kind, Part, Source, Stage, StationId, Symbolic, any_step, any_valid,
        any_watched, arbitrary, harnesses, kani, messages, robots, steps,
    };
    use crossguard_protocol::{
        Event, FallbackPolicy, Input, Maneuver, ManeuverId, Output, Rmcm, StopReason,
    };

    fn others_leave_it_so(part: Part, stage: Stage) {
        let it = any_watched(part, stage);
        let later = arbitrary::history(&mut Symbolic, &it.exchange, &it.robot);
        steps::others_leave_it_so(&it.exchange, &it.history, &it.robot, &later);
        kani::cover!(it.history != later, "more is known");
    }

    fn bystands(stage: Stage) {
        let it = any_watched(Part::Bystander, stage);
        let followers = usize::from(stage == Stage::Leading);
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

    fn any_maneuver() -> ManeuverId {
        let command = arbitrary::command(&mut Symbolic);
        ManeuverId {
            session: command.session,
            request: command.request,
        }
    }

    fn stays_true(kind: u32) {
        let it = any_watched(Part::Bystander, Stage::Idle);
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

    fn reboots(part: Part, stage: Stage) {
        let it = any_watched(part, stage);
        let boot = Symbolic.number(u16::MAX.into(), u32::from(it.robot.boot()) + 1);
        let boot = u16::try_from(boot).unwrap_or(u16::MAX);
        kani::assume(boot > it.robot.boot());
        steps::keeps_over_a_reboot(&it.exchange, &it.history, &it.robot, boot);
        kani::cover!(true, "boots");
    }

    harnesses! {
        /// What others do leaves a requesting leader as it is.
        #[unwind(6)]
        #[solver(cadical)]
        fn a_requester_is_left_so() {
            others_leave_it_so(Part::Leader, Stage::Requesting);
        }

        /// What others do leaves a leader as it is.
        #[unwind(6)]
        #[solver(cadical)]
        fn a_leader_is_left_so() {
            others_leave_it_so(Part::Leader, Stage::Leading);
        }

        /// What others do leaves a follower as it is.
        #[unwind(6)]
        #[solver(cadical)]
        fn a_follower_is_left_so() {
            others_leave_it_so(Part::Follower, Stage::Following);
        }

        /// A request stays true.
        #[unwind(6)]
        #[solver(cadical)]
        fn what_a_requester_says_stays_true() {
            stays_true(1);
        }

        /// An offer stays true.
        #[unwind(6)]
        #[solver(cadical)]
        fn what_a_helper_says_stays_true() {
            stays_true(2);
        }

        /// A list of followers stays true.
        #[unwind(6)]
        #[solver(cadical)]
        fn what_a_leader_says_stays_true() {
            stays_true(3);
        }

        /// A report and an answer stay true.
        #[unwind(6)]
        #[solver(cadical)]
        fn what_a_follower_says_stays_true() {
            stays_true(4);
        }

        /// A robot that leads or follows elsewhere makes nothing known.
        #[unwind(6)]
        #[solver(cadical)]
        fn a_bystander_leads() {
            bystands(Stage::Leading);
        }

        /// A robot that follows elsewhere makes nothing known.
        #[unwind(6)]
        #[solver(cadical)]
        fn a_bystander_follows() {
            bystands(Stage::Following);
        }

        /// A robot that asks for help makes nothing known.
        #[unwind(6)]
        #[solver(cadical)]
        fn a_bystander_asks() {
            bystands(Stage::Requesting);
        }

        /// A helper of another session makes nothing known.
        #[unwind(6)]
        #[solver(cadical)]
        fn a_bystander_helps() {
            bystands(Stage::Offering);
        }

        /// A robot without a part makes nothing known.
        #[unwind(6)]
        #[solver(cadical)]
        fn a_bystander_idles() {
            bystands(Stage::Idle);
        }

        /// A leader loses power and boots.
        #[unwind(6)]
        #[solver(cadical)]
        fn a_leader_reboots() {
            reboots(Part::Leader, Stage::Leading);
        }

        /// A follower loses power and boots.
        #[unwind(6)]
        #[solver(cadical)]
        fn a_follower_reboots() {
            reboots(Part::Follower, Stage::Following);
        }

        /// A robot takes another station id, which may be that of the leader or the follower.
        #[unwind(6)]
        #[solver(cadical)]
        fn a_station_is_taken() {
            let kind = Kind::Local(Happening::IdentityChanged);
            let kept = any_step(Part::Bystander, Stage::Idle, kind);
            let leads = Part::Leader.is_of(&kept.exchange, &kept.after);
            let follows = Part::Follower.is_of(&kept.exchange, &kept.after);
            kani::cover!(leads, "the leader's");
            kani::cover!(follows, "the follower's");
        }

        /// Any robot, with any part or none, any input.
        #[random_only("all stages, parts and kinds of input at once")]
        fn any_robot_keeps_it() {
            let part = [Part::Leader, Part::Follower, Part::Bystander][choice(3) as usize];
            let stage = Stage::ALL[choice(5) as usize];
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
                0 => kinds[choice(9) as usize],
                _ => Kind::EVENTS[choice(14) as usize],
            };
            let kept = any_step(part, stage, kind);
            kani::cover!(kept.changed(), "a fact becomes known");
            kani::cover!(robots::agrees(&kept.exchange, &kept.was, &kept.after) && kept.before != kept.after, "none does");
        }
    }
}
