//! One step from any valid state, which the harnesses of all stages have in common.

use crossguard_protocol::laws::Source;
use crossguard_protocol::laws::arbitrary::{self, Kind};
use crossguard_protocol::laws::taken::Taken;
use crossguard_protocol::{Config, EventKind, Robot, Role};

use crate::{Symbolic, kani};

/// Any configuration whose numbers are in range.
pub(super) fn any_config() -> Config {
    let config = arbitrary::config(&mut Symbolic);
    kani::assume(config.is_some());
    config.unwrap_or_default()
}

/// The configuration of a step. To a proof it is the default one: with any, it takes more than three times as long. At
/// random it is any, most often the default, with which states are valid more often.
pub(super) fn config() -> Config {
    if cfg!(kani) || Symbolic.likely(Some(true)) {
        return Config::default();
    }
    any_config()
}

/// How many offers or followers a robot in `stage` has, at least and at most. To a proof there are two: one that an input
/// or a timer is about, and another. At random there are up to four, so that a rule that looks at the first two alone is
/// noticed.
pub(super) const fn peers(stage: Role) -> (usize, usize) {
    const MOST: usize = if cfg!(kani) { 2 } else { 4 };
    match stage {
        Role::Requester => (0, MOST),
        Role::Leader => (1, MOST),
        Role::None | Role::Helper | Role::Follower => (0, 0),
    }
}

/// Any valid state in `stage`, with this many offers or followers.
pub(super) fn any_valid(config: &Config, stage: Role, peers: (usize, usize)) -> Robot {
    let robot = arbitrary::valid_robot(&mut Symbolic, config, stage, peers);
    kani::assume(robot.is_valid(config));
    robot
}

/// Events that the application of a leader tells its robot. A robot with another role ignores it.
pub(super) const OF_LEADERS: [Kind; 3] = [
    Kind::Local(EventKind::CommandManeuver),
    Kind::Local(EventKind::OpenCorridor),
    Kind::Local(EventKind::CloseCorridor),
];

/// Where a step begins.
#[derive(Clone, Copy)]
pub(super) struct From {
    /// The stage.
    pub(super) stage: Role,
    /// How many offers or followers there are, at least and at most.
    pub(super) peers: (usize, usize),
    /// True if a RAM that tells a part in a session may name another one as over. One that tells none
    /// always may.
    pub(super) farewells: bool,
}

impl From {
    /// From any valid state of the stage, without peers.
    pub(super) const fn stage(stage: Role) -> Self {
        Self {
            stage,
            peers: (0, 0),
            farewells: true,
        }
    }

    /// Any input of this kind in any such state: the laws of one step hold.
    pub(super) fn any_step(self, kind: Kind, laws: fn(&Config, &Taken)) -> Taken {
        let config = config();
        let robot = any_valid(&config, self.stage, self.peers);
        let farewells = self.farewells || kind == Kind::RamNone;
        let input = arbitrary::input(&mut Symbolic, kind, farewells);
        let step = Taken::new(&config, robot, input);
        laws(&config, &step);
        step
    }

    /// Any input of any of these kinds in any such state is ignored: the laws of one step hold, whatever the cause.
    pub(super) fn any_ignored(self, kinds: [&[Kind]; 2], laws: fn(&Config, &Taken)) -> Taken {
        let config = config();
        let robot = any_valid(&config, self.stage, self.peers);
        let [first, second] = kinds;
        let last = u32::try_from(first.len() + second.len() - 1).unwrap_or(0);
        let number = Symbolic.number(last, last) as usize;
        let kind = if number < first.len() {
            first[number]
        } else {
            second[number - first.len()]
        };
        let input = arbitrary::input(&mut Symbolic, kind, self.farewells);
        let step = Taken::ignored(robot, input);
        laws(&config, &step);
        step
    }
}

/// True if the robot has this role after the step.
pub(super) fn becomes(step: &Taken, role: Role) -> bool {
    step.after.role() == role
}

/// The laws of a harness: its own, or those of all in its stage.
macro_rules! laws_of {
    ($all:expr) => {
        $all
    };
    ($all:expr, $own:expr) => {
        $own
    };
}

/// Marks what must be able to come of a step.
macro_rules! marks {
    ({ $($mark:literal: $came:expr),+ $(,)? }) => {
        // No branch in a mark: each branch of it would be a mark of its own to Kani.
        $(
            let came: bool = $came;
            $crate::kani::cover!(came, $mark);
        )+
    };
}

/// Declares the harnesses of a stage: the laws of one step from any valid state of it, with any input of
/// one kind (to a proof each is a case of its own), and what must be able to come of it. Harnesses with the same marks stand
/// in front, as lists.
macro_rules! steps {
    ($from:expr, $laws:expr;
        $(@each |$any:ident| $same:tt {
            $($each:ident($of:expr $(, $law:expr)?);)+
        })*
        $(
            $(#[doc = $doc:literal])*
            $(#[random_only($reason:literal)])?
            $name:ident($kind:expr) |$step:ident| $marks:tt
        )*
    ) => {
        $crate::harness::harnesses! {
            $($(
                #[doc = concat!("Any input of `", stringify!($of), "`.")]
                #[unwind(6)]
                fn $each() {
                    let laws = $crate::protocol::stage::laws_of!($laws $(, $law)?);
                    let $any = &$from.any_step($of, laws);
                    $crate::protocol::stage::marks!($same);
                }
            )+)*
            $(
                $(#[doc = $doc])*
                #[unwind(6)]
                $(#[random_only($reason)])?
                fn $name() {
                    let $step = &$from.any_step($kind, $laws);
                    $crate::protocol::stage::marks!($marks);
                }
            )*
        }
    };
}

/// Declares the harnesses of a stage with those of [`OF_LEADERS`] among the ones that have the same marks. Where the role
/// ignores these, the law that stands behind those of the stage is what it proves of them.
macro_rules! steps_with_those_of_leaders {
    ($from:expr, $laws:expr $(, $law:expr)?;
        @each |$any:ident| { $($mark:tt)+ } { $($each:tt)* }
        $($rest:tt)*
    ) => {
        $crate::protocol::stage::steps! { $from, $laws;
            @each |$any| { $($mark)+ } {
                commands($crate::protocol::stage::OF_LEADERS[0] $(, $law)?);
                opens_the_corridor($crate::protocol::stage::OF_LEADERS[1] $(, $law)?);
                closes_the_corridor($crate::protocol::stage::OF_LEADERS[2] $(, $law)?);
                $($each)*
            }
            $($rest)*
        }
    };
}

/// Declares the harnesses of a leader with those of [`OF_LEADERS`], and what must be able to come of these.
macro_rules! steps_of_leaders {
    ($from:expr, $laws:expr; $($rest:tt)*) => {
        $crate::protocol::stage::steps! { $from, $laws;
            $($rest)*

            /// The application commands a maneuver.
            commands($crate::protocol::stage::OF_LEADERS[0]) |step| {
                "commands": step.said.commanded,
                "renews the session": step.said.ended == Some(crossguard_protocol::EndReason::Renewed),
                "ignored": step.is_ignored(),
            }

            /// The application opens the corridor.
            opens_the_corridor($crate::protocol::stage::OF_LEADERS[1]) |step| {
                "opens": step.said.has(crossguard_protocol::OutputKind::CorridorOpened),
                "ignored": step.is_ignored(),
            }

            /// The application closes the corridor.
            closes_the_corridor($crate::protocol::stage::OF_LEADERS[2]) |step| {
                "closes": step.said.has(crossguard_protocol::OutputKind::CorridorClosed),
                "ignored": step.is_ignored(),
            }
        }
    };
}

pub(super) use {laws_of, marks, steps, steps_of_leaders, steps_with_those_of_leaders};
