//! The theorem: one step of a robot keeps what holds of any exchange, whatever part it has in it, and breaks no property of it.
//!
//! Each harness has any settings, a robot in any valid state of a stage, any exchange, any history that agrees with both, and
//! any input of a kind that such a history allows. The robot may be the leader of the exchange, its follower or neither. The
//! state after the step is valid with the same settings; of time, as [`timers`] says.
//!
//! [`leader`] and [`follower`] have a harness for each stage and each kind of input by which something comes about. All other
//! pairs are ignored, which [`frame`] proves of whatever these two do not name: no pair is left out.

use crossguard_protocol::laws::Source;
use crossguard_protocol::laws::arbitrary::{self, AnyWord, Kind, Part};
use crossguard_protocol::laws::exchange::steps::Laws;
use crossguard_protocol::laws::exchange::{Exchange, History, messages, robots, steps};
use crossguard_protocol::laws::road::{go_is_a_lease, the_corridor_is_open_only_over_guards};
use crossguard_protocol::laws::steps::keeps_the_state_valid;
use crossguard_protocol::laws::taken::Taken;
use crossguard_protocol::laws::watch::Watch;
use crossguard_protocol::laws::{budgets, timers};
use crossguard_protocol::{
    Config, EventKind, Input, Millis, OutputKind, Phase, Robot, Role, StationId, Timer, TimerKind,
};

use super::stage;
use crate::{Symbolic, kani};

/// A robot, an exchange and a history that agree.
struct Watched {
    config: Config,
    exchange: Exchange,
    history: History,
    robot: Robot,
}

/// The effect of a step.
struct Kept {
    exchange: Exchange,
    was: History,
    now: History,
    before: Robot,
    after: Robot,
}

/// The settings of a step. To a proof they are any; at random they are most often the default ones, with which states are valid
/// more often.
fn config() -> Config {
    if cfg!(kani) {
        stage::any_config()
    } else {
        stage::config()
    }
}

/// How many offers or followers a robot in `stage` has, at least and at most. To a proof there are three, so that a rule that
/// looks at the first two alone is noticed.
const fn peers(stage: Role) -> (usize, usize) {
    let (least, most) = stage::peers(stage);
    (least, if cfg!(kani) && most > 0 { 3 } else { most })
}

fn any_valid(config: &Config, stage: Role) -> Robot {
    stage::any_valid(config, stage, peers(stage))
}

fn any_watched(stage: Role) -> Watched {
    let config = config();
    let robot = any_valid(&config, stage);
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
    let config = config();
    let timer = Timer::any_of(countdown, &mut Symbolic);
    let robot = arbitrary::robot(&mut Symbolic, &config, stage, peers(stage));
    let robot = timers::with_due(robot, timer);
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
    let fired = taken(robot, Input::Expired(timer), after);
    if laws != Laws::Heartbeats {
        timers::firing_keeps_the_state_consistent(&config, &fired);
    }
    Kept {
        exchange,
        was: history,
        now,
        before: fired.before,
        after: fired.after,
    }
}

impl Watched {
    fn step(self, kind: Kind, laws: Laws) -> Kept {
        let (exchange, was, before) = (self.exchange, self.history, self.robot);
        let input = arbitrary::input(&mut Symbolic, kind, true);
        kani::assume(steps::can_be_next(&exchange, &was, &before, &input));
        let (now, after) = steps::keeps(laws, &self.config, (&exchange, &was), &before, input);
        let step = taken(before, input, after);
        if laws != Laws::Heartbeats {
            keeps_the_state_valid(&self.config, &step);
            the_corridor_is_open_only_over_guards(&self.config, &step);
        }
        Kept {
            exchange,
            was,
            now,
            before: step.before,
            after: step.after,
        }
    }
}

/// The step, but for what it said: the history has seen that.
fn taken(before: Robot, input: Input, after: Robot) -> Taken {
    Taken {
        said: Watch::new(&before, &input),
        before,
        input,
        after,
    }
}

/// Countdowns run: the state stays consistent, whatever is due then, and what is left of each budget is less.
fn runs(stage: Role) {
    let config = config();
    let robot = any_valid(&config, stage);
    let elapsed = Millis(Symbolic.number(u32::MAX, 100));
    timers::running_keeps_the_state_consistent(&config, &robot, elapsed);
    budgets::time_uses_them_up(&robot, elapsed);
    let is_any_due = robot.next_due().is_some_and(|due| due <= elapsed);
    kani::cover!(is_any_due, "some are due");
    kani::cover!(!is_any_due, "none is due");
}

/// When no timer is due any more, the step settles: all that is left to do where the input is ignored.
fn settles(stage: Role, ignored: Kind) {
    let config = config();
    let robot = arbitrary::robot(&mut Symbolic, &config, stage, peers(stage));
    kani::assume(timers::is_consistent(&robot, &config) && robot.next_due() != Some(Millis::ZERO));
    timers::settling_needs_few_outputs(&config, &robot);
    let kept = of(config, robot).step(ignored, Laws::All);
    kani::cover!(kept.before != kept.after, "settles");
}

/// *Go* is shown over guards alone, for no longer than the lease on any of them.
fn shows_go(kind: Kind, shows: OutputKind) {
    let config = config();
    let robot = any_valid(&config, Role::Leader);
    let input = arbitrary::input(&mut Symbolic, kind, true);
    let step = Taken::new(&config, robot, input);
    the_corridor_is_open_only_over_guards(&config, &step);
    go_is_a_lease(&step);
    kani::cover!(step.said.has(shows), "shows go");
}

impl Kept {
    fn changed(&self) -> bool {
        self.was != self.now
    }

    fn is(&self, part: Part) -> bool {
        part.is_of(&self.exchange, &self.before)
    }
}

/// The claim of a harness: any input of this kind in this stage keeps these laws.
pub type Proved = (Role, Kind, Laws);

/// The age of a heartbeat, with any time in the place of its periods: a proof that multiplies by any `ram_period` takes six times
/// as long. As many periods have the same time, and more have no shorter one.
///
/// Protocol and law write the age differently: `n * p + (p - min(p, r))`, as far as 32 bits go, and `(n + 1) * p - min(p, r)`. Here
/// one function stands for both. No lease is as long as 32 bits go.
#[cfg(all(kani, not(feature = "stand-in")))]
pub mod any_age {
    use core::sync::atomic::{AtomicU32, Ordering::Relaxed};

    use crossguard_protocol::{Config, Heartbeat, Millis};

    const NONE: u32 = u32::MAX;

    /// The numbers of periods that were asked for, and their times. One that finds no place here has any time.
    static TIMES: [[AtomicU32; 2]; 4] = [const { [AtomicU32::new(NONE), AtomicU32::new(0)] }; 4];

    fn time_of(periods: u32) -> Millis {
        let any: u32 = kani::any();
        let mut i = 0;
        while i < TIMES.len() {
            let [of, time] = &TIMES[i];
            let (known, ms) = (of.load(Relaxed), time.load(Relaxed));
            if known == periods {
                return Millis(ms);
            }
            if known == NONE {
                of.store(periods, Relaxed);
                time.store(any, Relaxed);
                break;
            }
            kani::assume(if periods < known {
                any <= ms
            } else {
                any >= ms
            });
            i += 1;
        }
        Millis(any)
    }

    /// How long a requester counts on an offer, once it was asked for: a harness has one configuration.
    static LEASE: AtomicU32 = AtomicU32::new(NONE);

    /// In place of a quotient: any time that is not above `t_offer`.
    pub fn t_offer_lease(config: &Config) -> Millis {
        let any: u32 = kani::any();
        kani::assume(any <= config.settings().t_offer.0);
        if LEASE.load(Relaxed) == NONE {
            LEASE.store(any, Relaxed);
        }
        Millis(LEASE.load(Relaxed))
    }

    /// In place of the protocol's.
    pub fn age_of(config: &Config, newest: Heartbeat, heard: Heartbeat, next: Millis) -> Millis {
        let in_this_period = config.settings().ram_period.saturating_sub(next);
        time_of(newest.distance_from(heard).into()).saturating_add(in_this_period)
    }

    /// In place of the law's.
    pub fn age_ms(config: &Config, newest: Heartbeat, heard: Heartbeat, next: Millis) -> u64 {
        age_of(config, newest, heard, next).0.into()
    }
}

/// Declares harnesses of a step with any settings.
macro_rules! with_any_age {
    ($($(#[doc = $doc:expr])* fn $name:ident() $body:block)+) => {
        $crate::harness::harnesses! { $(
            $(#[doc = $doc])*
            #[unwind(6)]
            #[stub(crossguard_protocol::roles::age_of, crate::protocol::exchange::any_age::age_of)]
            #[stub(crossguard_protocol::laws::arithmetic::age_ms, crate::protocol::exchange::any_age::age_ms)]
            #[stub(crossguard_protocol::Config::t_offer_lease, crate::protocol::exchange::any_age::t_offer_lease)]
            fn $name() $body
        )+ }
    };
}

/// Declares harnesses: stage, kind of input, which laws if not all, and what must be able to come of it. Those of which any
/// part must be able to take the step stand in front, as a list; behind it, what is no step by an input.
macro_rules! steps {
    (
        @each { $($each:ident($from:ident, $any:expr $(, $of:ident)?);)+ }
        @others { $($other:ident => $case:expr;)+ }
        $(
            $(#[doc = $doc:literal])*
            $name:ident($stage:ident, $kind:expr $(, $laws:ident)?) |$kept:ident| $marks:tt
        )+
    ) => {
        with_any_age! {
            $(
                #[doc = concat!("Stage *", stringify!($from), "*, any input of `", stringify!($any), "`.")]
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
                fn $name() {
                    let $kept = &any_step(Role::$stage, $kind, stage::laws_of!(Laws::All $(, Laws::$laws)?));
                    stage::marks!($marks);
                }
            )+
            $(
                #[doc = concat!("`", stringify!($case), "`.")]
                fn $other() {
                    $case;
                }
            )+
        }

        /// The claims of the harnesses of this module.
        pub const PROVED: &[super::Proved] = &[
            $((Role::$from, $any, stage::laws_of!(Laws::All $(, Laws::$of)?)),)+
            $((Role::$stage, $kind, stage::laws_of!(Laws::All $(, Laws::$laws)?)),)+
        ];
    };
}

pub mod follower;
pub mod frame;
pub mod leader;
