//! The theorem: one step of a robot keeps what holds of any exchange, whatever part it has in it, and breaks no property of it.
//!
//! Each harness has a robot in any valid state of a stage, any exchange in which it has a part, any history that agrees
//! with both, and any input of a kind that such a history allows.

use crossguard_protocol::laws::Source;
use crossguard_protocol::laws::arbitrary::{self, AnyWord, Kind, Part};
use crossguard_protocol::laws::exchange::steps::Laws;
use crossguard_protocol::laws::exchange::{Exchange, History, messages, robots, steps};
use crossguard_protocol::laws::timers;
use crossguard_protocol::{
    Config, EventKind, Input, Millis, Phase, Robot, Role, StationId, Timer, TimerKind,
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

fn any_watched(part: Part, stage: Role) -> Watched {
    let config = stage::config();
    let robot = any_valid(&config, stage, stage::peers(stage));
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

fn any_step(part: Part, stage: Role, kind: Kind, laws: Laws) -> Kept {
    let Watched {
        config,
        exchange,
        history,
        robot,
    } = any_watched(part, stage);
    let input = arbitrary::input(&mut Symbolic, kind, kind == Kind::RamNone);
    kani::assume(steps::can_be_next(&exchange, &history, &robot, &input));
    if let Input::Elapsed(time) = input {
        kani::assume(steps::can_pass(&config, time));
    }
    let (now, after) = steps::keeps(laws, &config, (&exchange, &history), &robot, input);
    Kept {
        exchange,
        was: history,
        now,
        before: robot,
        after,
    }
}

/// A due timer, in any state that can occur within a step.
fn any_firing(part: Part, stage: Role, countdown: TimerKind, laws: Laws) -> Kept {
    let config = stage::config();
    let timer = Timer::any_of(countdown, &mut Symbolic);
    let robot = timers::with_due(any_within_a_step(&config, stage), timer);
    kani::assume(timers::is_due(&robot, timer) && timers::is_consistent(&robot, &config));
    let Watched {
        config,
        exchange,
        history,
        robot,
    } = of(part, config, robot);
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

impl Kept {
    fn changed(&self) -> bool {
        self.was != self.now
    }
}

/// Declares harnesses of one part: stage, kind of input, which laws if not all, and what must be able to come of it.
macro_rules! steps {
    ($part:ident; $(
        $(#[doc = $doc:literal])*
        $name:ident($stage:ident, $kind:expr $(, $laws:ident)?) |$kept:ident| $marks:tt
    )+) => {
        harnesses! { $(
            $(#[doc = $doc])*
            #[unwind(6)]
            fn $name() {
                let laws = stage::laws_of!(Laws::All $(, Laws::$laws)?);
                let $kept = &match $kind {
                    Kind::Fires(timer) => any_firing(Part::$part, Role::$stage, timer, laws),
                    kind => any_step(Part::$part, Role::$stage, kind, laws),
                };
                stage::marks!($marks);
            }
        )+ }
    };
}

pub mod follower;
pub mod frame;
pub mod leader;
