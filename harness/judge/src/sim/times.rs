//! How long things take in a run, held against the longest times that the timers allow.

use crossguard_model_check::node::Node;
use crossguard_model_check::timed::Limits;
use crossguard_protocol::{Millis, Phase, RequestId, SessionId, SessionNumber, StationId};
use serde::Serialize;

use super::swarm::Swarm;

/// A table of measures: the property that bounds each, what is measured, and what must come to pass within the bound.
macro_rules! measures {
    ($($measure:ident $property:literal $name:literal: $statement:literal;)*) => {
        /// A time that is measured.
        #[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
        #[serde(rename_all = "camelCase")]
        pub enum Measure {
            $(#[doc = $name] $measure,)*
        }

        impl Measure {
            /// All of them.
            pub const ALL: [Self; [$($property),*].len()] = [$(Self::$measure),*];

            /// The property that bounds it.
            #[must_use]
            pub const fn property(self) -> &'static str {
                [$($property),*][self as usize]
            }

            /// Statement that the bound is kept.
            #[must_use]
            pub const fn statement(self) -> &'static str {
                [$($statement),*][self as usize]
            }

            /// Name of the time, for a person.
            #[must_use]
            pub const fn name(self) -> &'static str {
                [$($name),*][self as usize]
            }
        }
    };
}

measures! {
    Roles "L1" "request to roles or giving up":
        "a request has roles or is given up within the bound";
    Commands "L2" "command to acknowledgement or giving up":
        "a command is acknowledged or its follower is given up within the bound";
    Stopped "L5" "leader's crash to follower stopped":
        "after the leader's crash a follower stops within the bound";
    Left "L5" "leader's crash to follower idle":
        "after the leader's crash a follower is idle within the bound";
    CorridorClosed "I11" "follower's failure to corridor closed":
        "after a follower's own failure the corridor closes within the bound";
    GuardGone "W1" "guard gone when somebody steps on the road":
        "who steps on the road finds every required guard in place, or gone for less than the bound";
    Unguarded "W1" "follower's fallback to sign at stop":
        "no follower falls back for lack of contact while the sign shows go";
    TwoSigns "W3" "two leaders that hear each other to one sign at stop":
        "two leaders at one place that hear each other show go for no longer than the bound";
    SignAfterGuard "W5" "guard gone to sign at stop":
        "after a guard has failed, fallen back, hung or lost power the sign shows stop within the bound";
    SignAfterLeader "W5" "leader hung or without power to its sign at stop":
        "after a leader has hung or lost power its sign shows stop within the bound";
    Untold "W6" "guard gone to leader's application told":
        "a leader's application knows of a guard that is gone within the bound";
    Crossed "W7" "network healed to crossing completed":
        "once the network is healed and a team can exist, a crossing is completed within the bound";
    Served "W8" "somebody noticed to go or a reason":
        "who was noticed gets go, or the application gets a reason, within the bound";
}

/// The longest time that was observed, with what it is held against.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Longest {
    /// In milliseconds.
    pub ms: u32,
    /// The bound by the timers in the run in which it was observed, as the timed model has it: see
    /// [`Limits`]. It depends on the longest delay of the run's messages.
    pub bound_ms: u32,
}

/// The longest times that were observed, in the order of [`Measure::ALL`]; `None` where nothing was to be
/// measured.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Worst([Option<Longest>; Measure::ALL.len()]);

impl Serialize for Worst {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(Measure::ALL.map(|measure| (measure, self.of(measure))))
    }
}

impl Measure {
    /// The limit, where the timed model has one.
    const fn limit(self, limits: &Limits) -> Millis {
        match self {
            Self::Roles => limits.roles,
            Self::Commands => limits.commands,
            Self::Stopped => limits.stopped,
            Self::Left => limits.left,
            _ => limits.corridor_closed,
        }
    }
}

impl Worst {
    /// The longest time of a measure.
    #[must_use]
    pub const fn of(&self, measure: Measure) -> Option<Longest> {
        self.0[measure as usize]
    }

    pub(super) fn note(&mut self, measure: Measure, bound_ms: u32, us: u64) {
        let ms = u32::try_from(us.div_ceil(1_000)).unwrap_or(u32::MAX);
        self.note_longest(measure, Longest { ms, bound_ms });
    }

    pub(super) fn note_longest(&mut self, measure: Measure, observed: Longest) {
        let slot = &mut self.0[measure as usize];
        if slot.is_none_or(|known| known.ms < observed.ms) {
            *slot = Some(observed);
        }
    }

    /// Takes in what another run, or another judge of it, has observed.
    pub fn add(&mut self, other: Self) {
        for measure in Measure::ALL {
            if let Some(observed) = other.of(measure) {
                self.note_longest(measure, observed);
            }
        }
    }
}

/// The stop-watches of a run. Places are those of the robots.
#[derive(Debug)]
pub(super) struct Times {
    /// Of each robot, whose timers may differ.
    limits: Vec<Limits>,
    /// Endpoints are told of time within `delay_max`.
    is_in_time: bool,
    /// Messages take no longer than the ways say.
    delay_is_bounded: bool,
    worst: Worst,
    /// Whether each robot hangs: nothing in time is asked of one that does.
    hung: Vec<bool>,
    running: Vec<Stopwatch>,
}

#[derive(Clone, Copy, Debug)]
struct Stopwatch {
    /// The robot that it is about.
    place: usize,
    open: Open,
    since_us: u64,
}

/// Matter that is open at a robot, and must not be for too long.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Open {
    /// Its request has no roles.
    Request(SessionNumber),
    /// A follower has not acknowledged its command.
    Command(SessionId, StationId, RequestId),
    /// It executes something for a leader that has crashed.
    Executing,
    /// It follows in the session of a leader that has crashed.
    Following(SessionId),
    /// It leads, and its corridor is open although a follower has failed.
    Corridor,
}

impl Open {
    const fn measure(self) -> Measure {
        match self {
            Self::Request(_) => Measure::Roles,
            Self::Command(..) => Measure::Commands,
            Self::Executing => Measure::Stopped,
            Self::Following(_) => Measure::Left,
            Self::Corridor => Measure::CorridorClosed,
        }
    }

    fn is_so(self, node: &Node) -> bool {
        match self {
            Self::Request(_) | Self::Command(..) => opened_by(node).contains(&self),
            Self::Executing => node.actuation.running().is_some(),
            Self::Following(session) => is_following(node, session),
            Self::Corridor => node.actuation.corridor_open,
        }
    }
}

impl Times {
    pub(super) fn new(swarm: &Swarm, limits: Vec<Limits>) -> Self {
        Self {
            worst: Worst::default(),
            hung: vec![false; limits.len()],
            limits,
            is_in_time: swarm.is_in_time(),
            delay_is_bounded: swarm.replays.is_empty(),
            running: Vec::new(),
        }
    }

    pub(super) const fn worst(&self) -> Worst {
        self.worst
    }

    fn start(&mut self, since_us: u64, place: usize, open: Open) {
        self.running.push(Stopwatch {
            place,
            open,
            since_us,
        });
    }

    /// A robot hangs: what it was to do in time is not asked of it.
    pub(super) fn hang(&mut self, place: usize) {
        self.hung[place] = true;
        self.running.retain(|running| running.place != place);
    }

    /// A robot that hung goes on.
    pub(super) fn go_on(&mut self, place: usize) {
        self.hung[place] = false;
    }

    /// A robot is about to crash.
    pub(super) fn crash<'a>(
        &mut self,
        now_us: u64,
        place: usize,
        nodes: impl Iterator<Item = &'a Node> + Clone,
    ) {
        self.fail(now_us, place, nodes.clone());
        // A robot that is down has nothing open and does nothing.
        self.hung[place] = false;
        self.running.retain(|running| running.place != place);
        let Some(session) = nodes.clone().nth(place).and_then(led_by) else {
            return;
        };
        if !self.is_in_time || !self.delay_is_bounded {
            return;
        }
        for (follower, node) in nodes.enumerate() {
            if is_following(node, session) && !self.hung[follower] {
                self.start(now_us, follower, Open::Following(session));
                if Open::Executing.is_so(node) {
                    self.start(now_us, follower, Open::Executing);
                }
            }
        }
    }

    /// A robot is about to fail in what it executes for its leader.
    pub(super) fn fail<'a>(
        &mut self,
        now_us: u64,
        place: usize,
        nodes: impl Iterator<Item = &'a Node> + Clone,
    ) {
        if !self.is_in_time {
            return;
        }
        let failing = nodes.clone().nth(place);
        let Some(maneuver) = failing.and_then(|node| node.actuation.running()) else {
            return;
        };
        let mut places = nodes.enumerate();
        let leader = places.find(|(_, node)| led_by(node) == Some(maneuver.session));
        if let Some((leader, node)) = leader
            && Open::Corridor.is_so(node)
            && !self.hung[leader]
        {
            self.start(now_us, leader, Open::Corridor);
        }
    }

    /// Looks at a robot after a step. Returns the time that was too long, if there is one.
    pub(super) fn look(&mut self, now_us: u64, place: usize, node: &Node) -> Option<Measure> {
        let (limits, worst) = (&self.limits[place], &mut self.worst);
        let mut late = None;
        self.running.retain(|running| {
            if running.place != place {
                return true;
            }
            let (measure, is_open) = (running.open.measure(), running.open.is_so(node));
            let (bound_ms, took_us) = (measure.limit(limits).0, now_us - running.since_us);
            if !is_open {
                worst.note(measure, bound_ms, took_us);
            }
            if took_us > u64::from(bound_ms) * 1_000 {
                late = late.or(Some(measure));
            }
            is_open
        });
        if self.is_in_time && !self.hung[place] {
            for open in opened_by(node) {
                let is_it = |running: &Stopwatch| running.place == place && running.open == open;
                if !self.running.iter().any(is_it) {
                    self.start(now_us, place, open);
                }
            }
        }
        late
    }
}

/// Matters that a robot has opened itself: a request without roles, and commands that are not acknowledged.
fn opened_by(node: &Node) -> Vec<Open> {
    match (node.phase(), node.session()) {
        (Some(Phase::Requesting(requesting)), _) => vec![Open::Request(requesting.number)],
        (Some(Phase::Leading(leading)), Some(session)) => {
            let members = leading.members.iter();
            let of = |station, request| Open::Command(session, station, request);
            members
                .filter_map(|member| Some(of(member.station, member.outstanding?.request)))
                .collect()
        }
        _ => Vec::new(),
    }
}

fn led_by(node: &Node) -> Option<SessionId> {
    node.leading().and(node.session())
}

fn is_following(node: &Node, session: SessionId) -> bool {
    node.following()
        .is_some_and(|following| following.session == session)
}
