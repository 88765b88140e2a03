//! What must hold of every state and step of the timed model.

use crossguard_protocol::{Contact, Lease, Phase, SessionId, StationId};
use serde::Serialize;

use super::model::{Model, State};
use super::watch::{Measure, Watch};
use crate::node::Node;

/// A property of the timed model, under its id in the table of `doc/verification.md`.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize)]
#[allow(missing_docs, reason = "the ids are those of the table in `statement`")]
pub enum TimedProperty {
    I10,
    I11,
    I12,
    I16,
    L1,
    L5,
}

impl TimedProperty {
    /// All of them, in order.
    pub const ALL: [Self; 6] = [
        Self::I10,
        Self::I11,
        Self::I12,
        Self::I16,
        Self::L1,
        Self::L5,
    ];

    /// Those that say that something comes in time. A run in which it does not is not followed any
    /// further, for it might never come.
    pub(super) const IN_TIME: [Self; 3] = [Self::I11, Self::L1, Self::L5];

    /// The property's id.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::I10 => "I10",
            Self::I11 => "I11",
            Self::I12 => "I12",
            Self::I16 => "I16",
            Self::L1 => "L1",
            Self::L5 => "L5",
        }
    }

    /// The property of this id.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|property| property.name() == name)
    }

    /// What the property speaks about: of every state, or that something comes in time.
    #[must_use]
    pub const fn kind(self) -> &'static str {
        match self {
            Self::I10 | Self::I11 | Self::I12 | Self::I16 => "S",
            Self::L1 | Self::L5 => "L",
        }
    }

    /// What the property says.
    #[must_use]
    pub const fn statement(self) -> &'static str {
        match self {
            Self::I10 => {
                "while the lease on a follower stands, it has not fallen back for lack of contact"
            }
            Self::I11 => "after a follower's own failure the corridor closes within the bound",
            Self::I12 => "time can always pass, and never stands still for ever",
            Self::I16 => "no timer has more time left than it was started with, and none stays due",
            Self::L1 => "a request has roles or is given up within the bound",
            Self::L5 => "after the leader's crash a follower stops, and is idle, within the bounds",
        }
    }

    /// When the property says anything at all; `None` for one that speaks about every state.
    #[must_use]
    pub const fn premise(self) -> Option<&'static str> {
        match self {
            Self::I10 => Some("a lease stands; and a follower falls back for lack of contact"),
            Self::I11 => Some("a follower fails while the corridor is open"),
            Self::I12 | Self::I16 => None,
            Self::L1 => Some("a requester gets roles; and one gives up"),
            Self::L5 => Some("the leader crashes while a follower executes"),
        }
    }
}

/// The properties that a step has broken.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) struct Broken(u8);

impl Broken {
    pub(super) const NOTHING: Self = Self(0);
    pub(super) const INVALID: Self = Self::of(TimedProperty::I16);

    pub(super) const fn of(property: TimedProperty) -> Self {
        Self(1 << property as u8)
    }

    pub(super) const fn add(&mut self, other: Self) {
        self.0 |= other.0;
    }

    pub(super) const fn has(self, property: TimedProperty) -> bool {
        self.0 & Self::of(property).0 != 0
    }
}

pub(super) fn is_requesting(node: &Node) -> bool {
    node.robot
        .as_ref()
        .is_some_and(|robot| matches!(robot.phase(), Phase::Requesting(_)))
}

pub(super) fn is_following(node: &Node) -> bool {
    node.robot
        .as_ref()
        .is_some_and(|robot| matches!(robot.phase(), Phase::Following(_)))
}

/// Whether a robot follows in `session` without having lost contact.
fn has_contact(node: &Node, session: SessionId) -> bool {
    let Some(robot) = &node.robot else {
        return false;
    };
    matches!(robot.phase(), Phase::Following(following)
        if following.session == session && matches!(following.contact, Contact::Fresh(_)))
}

fn has_lost_contact(node: &Node) -> bool {
    let Some(robot) = &node.robot else {
        return false;
    };
    matches!(robot.phase(), Phase::Following(following) if following.contact.is_lost())
}

/// The followers on whom a leader's lease stands.
fn leases(node: &Node) -> impl Iterator<Item = (SessionId, StationId)> {
    let leading = node.robot.as_ref().and_then(|robot| match robot.phase() {
        Phase::Leading(leading) => Some((robot.session()?, leading)),
        _ => None,
    });
    leading.into_iter().flat_map(|(session, leading)| {
        let stands = leading
            .members
            .iter()
            .filter(|member| matches!(member.lease, Lease::Stands(_)));
        stands.map(move |member| (session, member.station))
    })
}

/// Which properties the step from `before` to `after` breaks. `after` has the names of `before`.
pub(super) fn broken(model: &Model, before: &State, after: &State) -> Broken {
    let mut broken = Broken::NOTHING;
    let mut check = |property, holds: bool| {
        if !holds {
            broken.add(Broken::of(property));
        }
    };
    // A robot may act on what it was told last until it is told of the tick: so the leader's lease
    // before the tick is held against the follower after it.
    check(
        TimedProperty::I10,
        lease_theorem(model, before, after) && lease_theorem(model, after, after),
    );
    check(TimedProperty::I12, model.nodes(after).all(can_progress));
    let over = |ticks: u8, measure: Measure| {
        let timed = model.timed();
        timed.clock.millis(ticks) > measure.bound(&model.scenario().config, timed.delay)
    };
    match after.watch() {
        Watch::Off => {}
        Watch::Request(ticks) => check(TimedProperty::L1, !over(ticks, Measure::Roles)),
        Watch::LeaderDown(ticks) => {
            let running = model
                .nodes(after)
                .any(|node| node.actuation.running.is_some());
            check(
                TimedProperty::L5,
                !(running && over(ticks, Measure::Stopped)),
            );
            let following = model.nodes(after).any(is_following);
            check(
                TimedProperty::L5,
                !(following && over(ticks, Measure::Left)),
            );
        }
        Watch::FollowerFailed(ticks) => {
            let open = model.nodes(after).any(|node| node.actuation.corridor_open);
            check(
                TimedProperty::I11,
                !(open && over(ticks, Measure::CorridorClosed)),
            );
        }
    }
    broken
}

/// I10, of the leaders of one state and the followers of another. Nothing but lack of contact and
/// crashes takes a follower out of a session in this model.
fn lease_theorem(model: &Model, leaders: &State, followers: &State) -> bool {
    model
        .nodes(leaders)
        .flat_map(leases)
        .all(|(session, station)| {
            let follower = model
                .nodes(followers)
                .find(|node| node.persisted.station == station);
            follower.is_none_or(|node| node.robot.is_none() || has_contact(node, session))
        })
}

/// I10 the other way round, of robots that leave sessions for all kinds of reasons: whether a leader's
/// lease stands on a follower that has lost contact in that very session.
pub(crate) fn has_lease_on_lost<'a>(nodes: &(impl Iterator<Item = &'a Node> + Clone)) -> bool {
    nodes.clone().flat_map(leases).any(|(session, station)| {
        nodes.clone().any(|node| {
            node.persisted.station == station && has_lost_contact(node) && is_in(node, session)
        })
    })
}

fn is_in(node: &Node, session: SessionId) -> bool {
    let robot = node.robot.as_ref();
    robot.is_some_and(|robot| robot.session() == Some(session))
}

/// Whoever has a part in a session waits for a time, and not in vain for a message.
fn can_progress(node: &Node) -> bool {
    node.is_idle()
        || node
            .robot
            .as_ref()
            .is_none_or(|robot| robot.next_due().is_some())
}

/// Whether nothing more is to be learned from a run.
pub(super) fn is_over(model: &Model, state: &State) -> bool {
    if TimedProperty::IN_TIME
        .iter()
        .any(|&late| state.broken.has(late))
    {
        return true;
    }
    let leader = model.node(state, model.timed().leader);
    match state.watch() {
        Watch::LeaderDown(_) => !model.nodes(state).any(is_following),
        // Nothing from before the failure is under way any more that could open the corridor again.
        Watch::FollowerFailed(ticks) => {
            !leader.actuation.corridor_open && ticks > model.timed().delay_ticks
        }
        Watch::Off | Watch::Request(_) => leader.is_idle(),
    }
}

/// What of the premises of the properties was met; some have two parts.
#[expect(clippy::struct_excessive_bools, reason = "each is an independent fact")]
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(super) struct Premises {
    lease_stands: bool,
    fell_back: bool,
    corridor_failure: bool,
    roles: bool,
    gave_up: bool,
    crash: bool,
}

impl Premises {
    /// Adds what `state` meets.
    pub(super) fn note(&mut self, model: &Model, state: &State) {
        let leader = model.node(state, model.timed().leader);
        self.lease_stands |= leases(leader).next().is_some();
        self.fell_back |= leader.robot.is_some() && model.nodes(state).any(has_lost_contact);
        match state.watch() {
            Watch::FollowerFailed(0) => self.corridor_failure |= leader.actuation.corridor_open,
            Watch::LeaderDown(0) => {
                self.crash |= model
                    .nodes(state)
                    .any(|node| node.actuation.running.is_some());
            }
            _ => {}
        }
    }

    /// Adds what a step meets.
    pub(super) fn note_step(&mut self, model: &Model, before: &State, after: &State) {
        if let (Watch::Request(_), Watch::Off) = (before.watch(), after.watch()) {
            let gave_up = model.node(after, model.timed().leader).is_idle();
            self.gave_up |= gave_up;
            self.roles |= !gave_up;
        }
    }

    /// Whether the premise of a property was met.
    pub(super) const fn met(self, property: TimedProperty) -> bool {
        match property {
            TimedProperty::I10 => self.lease_stands && self.fell_back,
            TimedProperty::I11 => self.corridor_failure,
            TimedProperty::I12 | TimedProperty::I16 => true,
            TimedProperty::L1 => self.roles && self.gave_up,
            TimedProperty::L5 => self.crash,
        }
    }
}
