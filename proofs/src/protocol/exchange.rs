//! The theorem: one step of a robot keeps what holds of any exchange, whatever part it has in it, and breaks no property of it.
//!
//! Each harness has a robot in any valid state of a stage, any exchange, any history that agrees with both, and any input
//! of a kind that such a history allows. The robot may be the leader of the exchange, its follower or neither.
//!
//! [`leader`] and [`follower`] have a harness for each stage and each kind of input by which something comes about. All other
//! pairs are ignored, which [`frame`] proves of whatever these two do not name: no pair is left out.

use crossguard_protocol::laws::Source;
use crossguard_protocol::laws::arbitrary::{self, AnyWord, Kind, Part};
use crossguard_protocol::laws::exchange::steps::Laws;
use crossguard_protocol::laws::exchange::{Exchange, History, messages, robots, steps};
use crossguard_protocol::laws::timers;
use crossguard_protocol::{
    Config, EventKind, Millis, Phase, Robot, Role, StationId, Timer, TimerKind,
};

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

fn any_watched(stage: Role) -> Watched {
    let config = stage::config();
    let robot = any_valid(&config, stage, stage::peers(stage));
    of(config, robot)
}

/// The robot in any exchange. At random it has most often the part that goes with its stage.
fn of(config: Config, robot: Robot) -> Watched {
    let likely = match robot.role() {
        Role::Requester | Role::Leader => 0,
        Role::Helper | Role::Follower => 1,
        Role::None => 3,
    };
    let part = match Symbolic.number(2, likely) {
        0 => Part::Leader,
        1 => Part::Follower,
        _ => Part::Bystander,
    };
    let exchange = arbitrary::exchange(&mut Symbolic, part, &robot, &config);
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

fn any_step(stage: Role, kind: Kind, laws: Laws) -> Kept {
    if let Kind::Fires(timer) = kind {
        any_firing(stage, timer, laws)
    } else {
        any_watched(stage).step(kind, laws)
    }
}

/// A due timer, in any state that can occur within a step.
fn any_firing(stage: Role, countdown: TimerKind, laws: Laws) -> Kept {
    let config = stage::config();
    let timer = Timer::any_of(countdown, &mut Symbolic);
    let robot = timers::with_due(any_within_a_step(&config, stage), timer);
    kani::assume(timers::is_due(&robot, timer) && timers::is_consistent(&robot, &config));
    let Watched {
        config,
        exchange,
        history,
        robot,
    } = of(config, robot);
    let late = Millis(Symbolic.number(u32::MAX, 0));
    kani::assume(countdown != TimerKind::Ram || steps::can_pass(&config, late));
    let watched = (&exchange, &history);
    let (now, after) = steps::keeps_when_fired(laws, &config, watched, &robot, (timer, late));
    Kept {
        exchange,
        was: history,
        now,
        before: robot,
        after,
    }
}

impl Watched {
    fn step(self, kind: Kind, laws: Laws) -> Kept {
        let (exchange, was, before) = (self.exchange, self.history, self.robot);
        let input = arbitrary::input(&mut Symbolic, kind, true);
        kani::assume(steps::can_be_next(&exchange, &was, &before, &input));
        let (now, after) = steps::keeps(laws, &self.config, (&exchange, &was), &before, input);
        Kept {
            exchange,
            was,
            now,
            before,
            after,
        }
    }
}

impl Kept {
    fn changed(&self) -> bool {
        self.was != self.now
    }

    fn is(&self, part: Part) -> bool {
        part.is_of(&self.exchange, &self.before)
    }
}

/// The pair of stage and kind that a harness proves.
#[derive(Clone, Copy, Debug)]
pub struct Proved {
    /// The stage.
    pub stage: Role,
    /// The kind of input.
    pub kind: Kind,
    /// Which laws.
    pub laws: Laws,
    /// The harness.
    pub name: &'static str,
}

/// Declares harnesses: stage, kind of input, which laws if not all, and what must be able to come of it. Those of which any
/// part must be able to take the step stand in front, as a list.
macro_rules! steps {
    (
        @each { $($each:ident($from:ident, $any:expr $(, $of:ident)?);)+ }
        $(
            $(#[doc = $doc:literal])*
            $name:ident($stage:ident, $kind:expr $(, $laws:ident)?) |$kept:ident| $marks:tt
        )+
    ) => {
        harnesses! {
            $(
                #[doc = concat!("Stage *", stringify!($from), "*, any input of `", stringify!($any), "`.")]
                #[unwind(6)]
                fn $each() {
                    let kept = &any_step(Role::$from, $any, stage::laws_of!(Laws::All $(, Laws::$of)?));
                    stage::marks!({
                        "its leader": kept.is(Part::Leader),
                        "its follower": kept.is(Part::Follower),
                        "neither": kept.is(Part::Bystander),
                    });
                }
            )+
            $(
                $(#[doc = $doc])*
                #[unwind(6)]
                fn $name() {
                    let $kept = &any_step(Role::$stage, $kind, stage::laws_of!(Laws::All $(, Laws::$laws)?));
                    stage::marks!($marks);
                }
            )+
        }

        /// The pair of each harness of this module.
        pub const PROVED: &[super::Proved] = &[
            $(super::Proved {
                stage: Role::$from,
                kind: $any,
                laws: stage::laws_of!(Laws::All $(, Laws::$of)?),
                name: stringify!($each),
            },)+
            $(super::Proved {
                stage: Role::$stage,
                kind: $kind,
                laws: stage::laws_of!(Laws::All $(, Laws::$laws)?),
                name: stringify!($name),
            },)+
        ];
    };
}

pub mod follower;
pub mod frame;
pub mod leader;
