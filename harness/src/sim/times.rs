//! How long things take in a run, held against the longest times that the timers allow.

use crossguard_model_check::node::Node;
use crossguard_model_check::timed::Limits;
use crossguard_protocol::{Millis, Phase, SessionId, SessionNumber};
use serde::Serialize;

/// What is measured.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// From a request to roles or to giving up (L1).
    Roles,
    /// From the leader's crash to a follower stopped (L5).
    Stopped,
    /// From the leader's crash to a follower idle (L5).
    Left,
    /// From a follower's own failure to the corridor closed (I11).
    CorridorClosed,
}

/// The longest time that was observed, with what it is held against.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
pub struct Longest {
    /// In milliseconds.
    pub ms: u32,
    /// What the timers allow in the run in which it was observed, as the timed model has it: see
    /// [`Limits`]. It depends on the longest delay of the run's messages.
    pub bound_ms: u32,
}

/// The longest times that were observed; `None` where nothing was to be measured.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize)]
pub struct Worst {
    /// Of [`Measure::Roles`].
    pub roles: Option<Longest>,
    /// Of [`Measure::Stopped`].
    pub stopped: Option<Longest>,
    /// Of [`Measure::Left`].
    pub left: Option<Longest>,
    /// Of [`Measure::CorridorClosed`].
    pub corridor_closed: Option<Longest>,
}

impl Measure {
    /// The property that bounds it.
    #[must_use]
    pub const fn property(self) -> &'static str {
        match self {
            Self::Roles => "L1",
            Self::Stopped | Self::Left => "L5",
            Self::CorridorClosed => "I11",
        }
    }

    /// What must come to pass within the bound.
    #[must_use]
    pub const fn statement(self) -> &'static str {
        match self {
            Self::Roles => "a request has roles or is given up within the bound",
            Self::Stopped => "after the leader's crash a follower stops within the bound",
            Self::Left => "after the leader's crash a follower is idle within the bound",
            Self::CorridorClosed => {
                "after a follower's own failure the corridor closes within the bound"
            }
        }
    }

    const fn limit(self, limits: &Limits) -> Millis {
        match self {
            Self::Roles => limits.roles,
            Self::Stopped => limits.stopped,
            Self::Left => limits.left,
            Self::CorridorClosed => limits.corridor_closed,
        }
    }
}

impl Worst {
    fn slot(&mut self, measure: Measure) -> &mut Option<Longest> {
        match measure {
            Measure::Roles => &mut self.roles,
            Measure::Stopped => &mut self.stopped,
            Measure::Left => &mut self.left,
            Measure::CorridorClosed => &mut self.corridor_closed,
        }
    }

    fn note(&mut self, measure: Measure, limits: &Limits, us: u64) {
        let ms = u32::try_from(us.div_ceil(1_000)).unwrap_or(u32::MAX);
        let bound_ms = measure.limit(limits).0;
        self.note_longest(measure, Longest { ms, bound_ms });
    }

    fn note_longest(&mut self, measure: Measure, observed: Longest) {
        let slot = self.slot(measure);
        if slot.is_none_or(|known| known.ms < observed.ms) {
            *slot = Some(observed);
        }
    }

    /// Takes in what another run has observed.
    pub fn add(&mut self, mut other: Self) {
        for measure in [
            Measure::Roles,
            Measure::Stopped,
            Measure::Left,
            Measure::CorridorClosed,
        ] {
            if let Some(observed) = *other.slot(measure) {
                self.note_longest(measure, observed);
            }
        }
    }
}

/// The stop-watches of a run. Places are those of the robots.
#[derive(Debug)]
pub(super) struct Times {
    limits: Limits,
    worst: Worst,
    requests: Vec<Option<(SessionNumber, u64)>>,
    running: Vec<Running>,
}

#[derive(Clone, Copy, Debug)]
struct Running {
    measure: Measure,
    /// Whom it is about: the follower of a crashed leader, or the leader of a failed follower.
    place: usize,
    session: SessionId,
    since_us: u64,
}

impl Times {
    pub(super) fn new(limits: Limits, robots: usize) -> Self {
        Self {
            limits,
            worst: Worst::default(),
            requests: vec![None; robots],
            running: Vec::new(),
        }
    }

    pub(super) const fn worst(&self) -> Worst {
        self.worst
    }

    /// A robot is about to crash.
    pub(super) fn crash<'a>(
        &mut self,
        now_us: u64,
        place: usize,
        nodes: impl Iterator<Item = &'a Node> + Clone,
    ) {
        self.fail(now_us, place, nodes.clone());
        self.requests[place] = None;
        // A robot that is down has nothing open and does nothing.
        self.running.retain(|running| running.place != place);
        let Some(session) = nodes.clone().nth(place).and_then(led_by) else {
            return;
        };
        for (follower, node) in nodes.enumerate() {
            if is_following(node, session) {
                let running = |measure| Running {
                    measure,
                    place: follower,
                    session,
                    since_us: now_us,
                };
                self.running.push(running(Measure::Left));
                if node.actuation.running.is_some() {
                    self.running.push(running(Measure::Stopped));
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
        let Some(maneuver) = nodes
            .clone()
            .nth(place)
            .and_then(|node| node.actuation.running)
        else {
            return;
        };
        let session = maneuver.session;
        let mut places = nodes.enumerate();
        let leader = places.find(|(_, node)| led_by(node) == Some(session));
        if let Some((leader, _)) = leader.filter(|(_, node)| node.actuation.corridor_open) {
            self.running.push(Running {
                measure: Measure::CorridorClosed,
                place: leader,
                session,
                since_us: now_us,
            });
        }
    }

    /// Looks at a robot after a step. What took too long, if anything did.
    pub(super) fn look(&mut self, now_us: u64, place: usize, node: &Node) -> Option<Measure> {
        let mut late = self.look_at_request(now_us, place, node);
        let (limits, worst) = (&self.limits, &mut self.worst);
        self.running.retain(|running| {
            if running.place != place {
                return true;
            }
            let is_over = match running.measure {
                Measure::Stopped => node.actuation.running.is_none(),
                Measure::Left => !is_following(node, running.session),
                Measure::CorridorClosed => !node.actuation.corridor_open,
                Measure::Roles => true,
            };
            let took_us = now_us - running.since_us;
            if is_over {
                worst.note(running.measure, limits, took_us);
            }
            if took_us > u64::from(running.measure.limit(limits).0) * 1_000 {
                late = late.or(Some(running.measure));
                return false;
            }
            !is_over
        });
        late
    }

    fn look_at_request(&mut self, now_us: u64, place: usize, node: &Node) -> Option<Measure> {
        let asks_for = node.robot.as_ref().and_then(|robot| match robot.phase() {
            Phase::Requesting(requesting) => Some(requesting.number),
            _ => None,
        });
        let request = &mut self.requests[place];
        let since = request.map_or(now_us, |(_, since)| since);
        let took_us = now_us - since;
        match (asks_for, *request) {
            (Some(number), Some((known, _))) if number == known => {}
            (Some(number), None) => *request = Some((number, now_us)),
            (asks_for, Some(_)) => {
                self.worst.note(Measure::Roles, &self.limits, took_us);
                *request = asks_for.map(|number| (number, now_us));
            }
            (None, None) => {}
        }
        let is_late = took_us > u64::from(self.limits.roles.0) * 1_000;
        is_late.then_some(Measure::Roles)
    }
}

fn led_by(node: &Node) -> Option<SessionId> {
    let robot = node.robot.as_ref()?;
    matches!(robot.phase(), Phase::Leading(_)).then(|| robot.session())?
}

fn is_following(node: &Node, session: SessionId) -> bool {
    let robot = node.robot.as_ref();
    robot.is_some_and(|robot| {
        matches!(robot.phase(), Phase::Following(following) if following.session == session)
    })
}
