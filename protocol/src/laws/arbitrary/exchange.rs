//! Arbitrary exchanges and histories: every history whose facts are consistent.

use super::{
    HEARTBEAT, ME, PEER, REQUEST, Source, likely, offer_number, session, station, task_like,
};
use crate::config::Config;
use crate::id::{Heartbeat, RequestId, SessionId, SessionNumber, StationId, UniqueNumber};
use crate::laws::exchange::{Exchange, Heard, History};
use crate::laws::part::{leading, record_of};
use crate::state::{Following, Member, Phase, Robot};

/// The part that a robot has in an exchange.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Part {
    /// Its station is the leader.
    Leader,
    /// Its station is the follower.
    Follower,
    /// Neither.
    Bystander,
}

impl Part {
    /// True if it is the part of `robot`.
    #[must_use]
    pub fn is_of(self, exchange: &Exchange, robot: &Robot) -> bool {
        match self {
            Self::Leader => exchange.session.leader == robot.station,
            Self::Follower => exchange.follower == robot.station,
            Self::Bystander => {
                exchange.session.leader != robot.station && exchange.follower != robot.station
            }
        }
    }
}

/// Any exchange in which the station of the robot has this part. Hints let it be about the robot's session.
pub fn exchange(source: &mut impl Source, part: Part, robot: &Robot, config: &Config) -> Exchange {
    let session = session_like(source, robot);
    let (session, follower) = match part {
        Part::Leader => {
            let leader = robot.station;
            (SessionId { leader, ..session }, station(source, PEER))
        }
        Part::Follower => (session, robot.station),
        Part::Bystander => (session, station(source, ME + 2)),
    };
    Exchange {
        session,
        follower,
        offer: offer_number(source),
        request: request_like(source, follower, robot),
        first: config.settings().first_request,
        heartbeat: heartbeat_like(source, follower, robot),
    }
}

/// Any session; hints let it be that of the robot.
fn session_like(source: &mut impl Source, robot: &Robot) -> SessionId {
    let Some(likely) = robot.session() else {
        return session(source, PEER);
    };
    let number = UniqueNumber {
        boot: source.u16(likely.number.0.boot),
        count: source.u16(likely.number.0.count),
    };
    SessionId {
        leader: station(source, likely.leader.0),
        number: SessionNumber(number),
    }
}

fn record(robot: &Robot, follower: StationId) -> Option<&Member> {
    record_of(leading(robot)?, follower)
}

/// Any request; hints let it be the newest one that the state knows of the follower.
fn request_like(source: &mut impl Source, follower: StationId, robot: &Robot) -> RequestId {
    let job = match &robot.phase {
        Phase::Following(following) => following.job.map(|job| job.request),
        _ => None,
    };
    let member = record(robot, follower);
    let outstanding = member.and_then(|member| member.outstanding.map(|it| it.request));
    let order = member.and_then(|member| member.order.map(|it| it.request));
    let likely = outstanding.or(order).or(job);
    RequestId(source.u8(likely.map_or(REQUEST, |likely| likely.0)))
}

/// Any heartbeat; hints let it be the newest one that the state knows of the follower.
fn heartbeat_like(source: &mut impl Source, follower: StationId, robot: &Robot) -> Heartbeat {
    let likely = match &robot.phase {
        Phase::Following(following) => Some(following.heard),
        _ => record(robot, follower).and_then(|member| member.echoed),
    };
    Heartbeat(source.u16(likely.map_or(HEARTBEAT, |heartbeat| heartbeat.0)))
}

/// Facts that a state makes likely.
#[derive(Default)]
struct Hints<'a> {
    is_open: bool,
    member: Option<&'a Member>,
    following: Option<&'a Following>,
}

impl<'a> Hints<'a> {
    fn of(exchange: &Exchange, robot: &'a Robot) -> Self {
        match &robot.phase {
            Phase::Requesting(_) => Self {
                is_open: true,
                ..Self::default()
            },
            Phase::Leading(_) => Self {
                is_open: true,
                member: record(robot, exchange.follower),
                following: None,
            },
            Phase::Following(following) => Self {
                is_open: true,
                member: None,
                following: Some(following),
            },
            Phase::Idle | Phase::Offering(_) => Self::default(),
        }
    }

    fn newest(&self) -> Option<RequestId> {
        let order = self.member.and_then(|member| member.order);
        let job = self.following.and_then(|following| following.job);
        order.map(|it| it.request).or(job.map(|it| it.request))
    }
}

/// Any history whose facts are consistent; hints let it agree with the state of the robot.
pub fn history(source: &mut impl Source, exchange: &Exchange, robot: &Robot) -> History {
    let hints = Hints::of(exchange, robot);
    let (member, following) = (hints.member, hints.following);
    let is_peer = hints.is_open && (member.is_some() || following.is_some());
    let requested = source.likely(None) || hints.is_open && source.likely(Some(true));
    let ended = requested && source.likely(Some(!hints.is_open));
    let is_listed = is_peer.then_some(true);
    let listed = (requested && source.likely(is_listed)).then(|| offer_number(source));
    let is_known = listed.is_some();
    let joined = is_known && source.likely(is_listed);
    let task = hints
        .member
        .and_then(|member| member.outstanding.map(|it| it.task))
        .or(member.and_then(|member| member.order.map(|it| it.task)))
        .or(following.and_then(|following| following.job.map(|it| it.task)));
    let is_commanded = task.is_some() || following.is_some();
    let commanded = likely(source, is_commanded.then_some(true), |source| {
        task_like(
            source,
            task.map_or(u32::MAX, |task| u32::from(task.value())),
        )
    })
    .filter(|_| is_known);
    let can_answer = joined && commanded.is_some();
    let accepted = can_answer && source.likely(Some(hints.newest().is_some()));
    let is_running = following
        .and_then(|following| following.job)
        .is_some_and(|job| job.progress.is_running());
    let over = accepted && source.likely(Some(!is_running));
    let beaten = requested && source.likely(Some(hints.is_open));
    let heard = likely(source, is_listed, |source| {
        if over && source.likely(Some(false)) {
            Heard::AfterTheEnd
        } else {
            Heard::BeforeTheEnd
        }
    });
    History {
        requested,
        ended,
        listed,
        dropped: requested && source.likely(Some(false)),
        beaten,
        commanded,
        offered: source.likely(Some(true)) || listed == Some(exchange.offer),
        joined,
        left: joined && source.likely(Some(!is_peer)),
        heard: heard.filter(|_| joined && beaten),
        accepted,
        refused: can_answer && !accepted && source.flag(),
        started: accepted,
        newer_started: joined && source.likely(Some(false)),
        in_position: source.flag(),
        completed: source.likely(Some(true)),
        fell_back: over && source.flag(),
        over,
    }
}
