//! What must hold of every state and step of the timed model.

use crossguard_protocol::{Contact, Lease, Phase, Robot, SessionId, StationId};
use serde::Serialize;

use super::model::TimedModel;
use super::state::TimedState;
use super::watch::{Measure, StopWatch};
use crate::node::Node;
use crate::road::Body;

/// A property of the timed model, under its id in the table of `doc/verification.md`.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize)]
#[allow(missing_docs, reason = "the ids are those of the table in `statement`")]
pub enum TimedProperty {
    I10,
    I11,
    I12,
    I16,
    I19,
    L1,
    L5,
    W1,
    W3,
    W5,
    W6,
    W8,
}

impl TimedProperty {
    /// All of them, in order.
    pub const ALL: [Self; 12] = [
        Self::I10,
        Self::I11,
        Self::I12,
        Self::I16,
        Self::I19,
        Self::L1,
        Self::L5,
        Self::W1,
        Self::W3,
        Self::W5,
        Self::W6,
        Self::W8,
    ];

    /// Those that say that something comes in time. A run in which it does not is not followed any
    /// further, for it might never come.
    /// W5 and W6 are not among them: a hang ends, and a follower that is gone is dropped at some time.
    pub(super) const IN_TIME: [Self; 5] = [Self::I11, Self::L1, Self::L5, Self::W3, Self::W8];

    /// The property's id.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::I10 => "I10",
            Self::I11 => "I11",
            Self::I12 => "I12",
            Self::I16 => "I16",
            Self::I19 => "I19",
            Self::L1 => "L1",
            Self::L5 => "L5",
            Self::W1 => "W1",
            Self::W3 => "W3",
            Self::W5 => "W5",
            Self::W6 => "W6",
            Self::W8 => "W8",
        }
    }

    /// The property of this id.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|property| property.name() == name)
    }

    /// The ids of all of them, in order.
    #[must_use]
    pub fn list() -> String {
        Self::ALL.map(Self::name).join(", ")
    }

    /// What the property speaks about: of every state, or that something comes in time.
    #[must_use]
    pub const fn kind(self) -> &'static str {
        match self {
            Self::I10 | Self::I11 | Self::I12 | Self::I16 | Self::I19 | Self::W1 => "S",
            Self::L1 | Self::L5 | Self::W3 | Self::W5 | Self::W6 | Self::W8 => "L",
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
            Self::I19 => {
                "a follower gives its leader up no sooner than T_safety on its own clock after the last news"
            }
            Self::L1 => "a request has roles or is given up within the bound",
            Self::L5 => "after the leader's crash a follower stops, and is idle, within the bounds",
            Self::W1 => "no follower falls back for lack of contact while the sign shows go",
            Self::W3 => {
                "after one of two leaders at a place hears the other, both signs show go no longer than the bound"
            }
            Self::W5 => "after a robot begins to hang the sign shows stop within the bound",
            Self::W6 => {
                "the leader's application is told of a guard that is gone within the bound, and of a fallback before it"
            }
            Self::W8 => {
                "within the bound a pedestrian who was noticed sees go, or the application is told why not"
            }
        }
    }

    /// When the property says anything at all; `None` for one that speaks about every state.
    #[must_use]
    pub const fn premise(self) -> Option<&'static str> {
        match self {
            Self::I10 => Some("a lease stands; and a follower falls back for lack of contact"),
            Self::I11 => Some("a follower fails while the corridor is open"),
            Self::I12 | Self::I16 => None,
            Self::I19 => Some("a follower gives its leader up"),
            Self::L1 => Some("a requester gets roles; and one gives up"),
            Self::L5 => Some("the leader crashes while a follower executes"),
            Self::W1 => Some("an executing follower falls back for lack of contact"),
            Self::W3 => Some("two leaders whose signs show go hear each other"),
            Self::W5 => Some("the leader hangs while the sign shows go; and a follower does"),
            Self::W6 => Some("a guard that the application counts on is gone; and one falls back"),
            Self::W8 => Some("a pedestrian sees go; and an application is told why not"),
        }
    }
}

/// The properties that a step has broken.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) struct Broken(u16);

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

/// Whether a follower that executed falls back for lack of contact in a step.
pub(super) fn falls_back(before: &Node, after: &Node) -> bool {
    let stops = before.actuation.running.is_some() && after.actuation.running.is_none();
    stops && has_lost_contact(after)
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
    node.robot.as_ref().is_some_and(is_out_of_contact)
}

/// Whether a robot follows and has lost contact with its leader.
fn is_out_of_contact(robot: &Robot) -> bool {
    matches!(robot.phase(), Phase::Following(following) if following.contact.is_lost())
}

/// The followers on which a leader's lease stands.
pub fn leases(robot: &Robot) -> impl Iterator<Item = (SessionId, StationId)> {
    let leading = match robot.phase() {
        Phase::Leading(leading) => robot.session().map(|session| (session, leading)),
        _ => None,
    };
    leading.into_iter().flat_map(|(session, leading)| {
        let stands = leading
            .members
            .iter()
            .filter(|member| matches!(member.lease, Lease::Stands(_)));
        stands.map(move |member| (session, member.station))
    })
}

/// Which properties the step from `before` to `after` breaks. `after` has the names of `before`.
pub(super) fn broken(model: &TimedModel, before: &TimedState, after: &TimedState) -> Broken {
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
        model.timed().clock.millis(ticks) > measure.bound(model.limits())
    };
    let shows_go = |place| after.shows_go(model.timed().teams.team_of(place));
    let is_unaware = |place, ticks| after.told.counts_on(place) && over(ticks, Measure::Unaware);
    match after.watch() {
        StopWatch::Off | StopWatch::Apart | StopWatch::Near => {}
        StopWatch::Request(ticks) => check(TimedProperty::L1, !over(ticks, Measure::Roles)),
        StopWatch::LeaderDown(ticks) => {
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
        StopWatch::FollowerFailed(place, ticks) => {
            let late = shows_go(place) && over(ticks, Measure::CorridorClosed);
            check(TimedProperty::I11, !late);
            check(TimedProperty::W6, !is_unaware(place, ticks));
        }
        StopWatch::Hung(place, ticks) => {
            let measure = Measure::of_hang(model.timed().teams.leads(place));
            check(
                TimedProperty::W5,
                !(shows_go(place) && over(ticks, measure)),
            );
            check(TimedProperty::W6, !is_unaware(place, ticks));
        }
        StopWatch::BothGo(ticks) => check(TimedProperty::W3, !over(ticks, Measure::BothGo)),
    }
    check(TimedProperty::W1, !after.is_unguarded());
    check(TimedProperty::W6, knows_of_fallbacks(model, after));
    let waits_on = |ticks| !over(ticks, Measure::Waiting);
    check(TimedProperty::W8, after.waiting.is_none_or(waits_on));
    broken
}

/// W6, of fallbacks: the application of a leader that does not hang counts on nobody whose body falls back.
fn knows_of_fallbacks(model: &TimedModel, state: &TimedState) -> bool {
    let leader_hangs = state
        .hung()
        .is_some_and(|place| model.timed().teams.leads(place));
    let falls_back = |node: &Node| matches!(node.actuation.body, Body::FallingBack(..));
    let mut robots = (0..).zip(model.nodes(state));
    leader_hangs || robots.all(|(place, node)| !(falls_back(node) && state.told.counts_on(place)))
}

/// I10, of the leaders of one state and the followers of another. Nothing but lack of contact and
/// crashes takes a follower out of a session in this model. A leader that hangs does nothing for a
/// lease that it still knows; what its sign does meanwhile is W1 and W5.
fn lease_theorem(model: &TimedModel, leaders: &TimedState, followers: &TimedState) -> bool {
    if leaders
        .hung()
        .is_some_and(|place| model.timed().teams.leads(place))
    {
        return true;
    }
    model
        .nodes(leaders)
        .filter_map(|node| node.robot.as_ref())
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
pub fn has_lease_on_lost<'a>(robots: &(impl Iterator<Item = &'a Robot> + Clone)) -> bool {
    robots.clone().flat_map(leases).any(|(session, station)| {
        robots.clone().any(|robot| {
            let is_meant = robot.station() == station && robot.session() == Some(session);
            is_meant && is_out_of_contact(robot)
        })
    })
}

/// A robot with a part in a session waits for a time, and not in vain for a message.
fn can_progress(node: &Node) -> bool {
    node.is_idle()
        || node
            .robot
            .as_ref()
            .is_none_or(|robot| robot.next_due().is_some())
}

/// Whether nothing more is to be learned from a run.
pub(super) fn is_over(model: &TimedModel, state: &TimedState) -> bool {
    if TimedProperty::IN_TIME
        .iter()
        .any(|&late| state.broken.has(late))
    {
        return true;
    }
    let timed = model.timed();
    let leader = model.node(state, timed.teams.leaders()[0]);
    match state.watch() {
        StopWatch::LeaderDown(_) => !model.nodes(state).any(is_following),
        // Nothing from before the failure is under way any more that could open the corridor again.
        StopWatch::FollowerFailed(place, ticks) => {
            let is_told = !state.told.counts_on(place) || !timed.claims(TimedProperty::W6);
            is_told && !state.shows_go(timed.teams.team_of(place)) && ticks > timed.delay_ticks
        }
        StopWatch::Hung(..) | StopWatch::Apart | StopWatch::Near | StopWatch::BothGo(_) => false,
        // One of two leaders has yielded.
        StopWatch::Off if timed.teams.are_two() => true,
        StopWatch::Off | StopWatch::Request(_) => leader.is_idle() && state.waiting.is_none(),
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
    guard_fell_back: bool,
    leader_hung: bool,
    follower_hung: bool,
    both_go: bool,
    guard_gone: bool,
    gives_up: bool,
    sees_go: bool,
    is_told_why: bool,
}

impl Premises {
    /// Adds what `state` meets.
    pub(super) fn note(&mut self, model: &TimedModel, state: &TimedState) {
        let teams = &model.timed().teams;
        let leader = model.node(state, teams.leaders()[0]);
        self.lease_stands |= leader.robot.iter().flat_map(leases).next().is_some();
        self.fell_back |= leader.robot.is_some() && model.nodes(state).any(has_lost_contact);
        match state.watch() {
            StopWatch::FollowerFailed(place, 0) => {
                self.corridor_failure |= state.shows_go(teams.team_of(place));
                self.guard_gone |= state.told.counts_on(place);
            }
            StopWatch::Hung(place, 0) if state.shows_go(teams.team_of(place)) => {
                let leads = teams.leads(place);
                self.leader_hung |= leads;
                self.follower_hung |= !leads;
                self.guard_gone |= state.told.counts_on(place);
            }
            StopWatch::BothGo(0) => self.both_go = true,
            StopWatch::LeaderDown(0) => {
                self.crash |= model
                    .nodes(state)
                    .any(|node| node.actuation.running.is_some());
            }
            _ => {}
        }
    }

    /// Adds what a step meets.
    pub(super) fn note_step(
        &mut self,
        model: &TimedModel,
        before: &TimedState,
        after: &TimedState,
    ) {
        if let (StopWatch::Request(_), StopWatch::Off) = (before.watch(), after.watch()) {
            let leader = model.timed().teams.leaders()[0];
            let gave_up = model.node(after, leader).is_idle();
            self.gave_up |= gave_up;
            self.roles |= !gave_up;
        }
        let mut robots = model.nodes(before).zip(model.nodes(after));
        self.guard_fell_back |= robots.any(|(before, after)| falls_back(before, after));
        self.gives_up |= model
            .nodes(before)
            .zip(model.nodes(after))
            .any(|(before, after)| !has_lost_contact(before) && has_lost_contact(after));
        if before.waiting.is_some() && after.waiting.is_none() {
            self.sees_go |= after.shows_go(0);
            self.is_told_why |= !after.shows_go(0);
        }
    }

    /// Whether the premise of a property was met.
    pub(super) const fn met(self, property: TimedProperty) -> bool {
        match property {
            TimedProperty::I10 => self.lease_stands && self.fell_back,
            TimedProperty::I11 => self.corridor_failure,
            TimedProperty::I12 | TimedProperty::I16 => true,
            TimedProperty::I19 => self.gives_up,
            TimedProperty::L1 => self.roles && self.gave_up,
            TimedProperty::L5 => self.crash,
            TimedProperty::W1 => self.guard_fell_back,
            TimedProperty::W3 => self.both_go,
            TimedProperty::W5 => self.leader_hung && self.follower_hung,
            TimedProperty::W6 => self.guard_gone && self.guard_fell_back,
            TimedProperty::W8 => self.sees_go && self.is_told_why,
        }
    }
}
