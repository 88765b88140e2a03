//! From the records of a robot to messages of ROS: status, corridor, events, diagnostics.

use std::time::Duration;

use crossguard_endpoint::cause::Layer;
use crossguard_protocol::{
    self as protocol, Availability, CorridorClosure, Duty, Leading, ManeuverId, Member, Notice,
    Output, Phase, Progress, Robot, Role, SessionId, State, StationId, TaskType, Unavailability,
};
use crossguard_robot::tally::{Tally, Way};
use crossguard_robot::trace::{Entry, Record};

use crate::msgs::{Corridor, Event, Follower, Session, Status, Task};
use crate::standard::{self, DiagnosticStatus, Header, KeyValue, Time};

/// The frame of places on the site.
pub const SITE_FRAME: &str = "site";

/// What is told of a robot.
#[derive(Debug)]
pub(crate) struct Reporter {
    station: StationId,
    tally: Tally,
    /// Until when the pedestrian may cross, by the leases that stand, in µs on the clock of the robot.
    go_ends_us: u64,
    /// Why the corridor was closed last, while that is news.
    closure: Option<CorridorClosure>,
    /// How much had been dropped when diagnostics were told last.
    dropped_before: u64,
}

impl Reporter {
    pub(crate) fn new(name: &str, station: StationId) -> Self {
        Self {
            station,
            tally: Tally {
                robot: name.to_owned(),
                ..Tally::default()
            },
            go_ends_us: 0,
            closure: None,
            dropped_before: 0,
        }
    }

    /// Takes a record in.
    pub(crate) fn take(&mut self, record: &Record) {
        self.tally.record(record);
        if let Entry::Started { station, .. } = &record.entry {
            self.station = *station;
        }
        let Entry::Step { outputs, state, .. } = &record.entry else {
            return;
        };
        if !matches!(state.phase(), Phase::Leading(_)) {
            self.closure = None;
        }
        for output in outputs.iter() {
            match output {
                Output::CorridorOpened(left) | Output::CorridorExtended(left) => {
                    self.go_ends_us = record.at_us + u64::from(left.0) * 1_000;
                    if let Output::CorridorOpened(_) = output {
                        self.closure = None;
                    }
                }
                Output::CorridorClosed(why) => self.closure = Some(*why),
                _ => {}
            }
        }
    }

    /// When it was as it is known, in µs on the clock of the robot.
    pub(crate) const fn known_us(&self) -> u64 {
        self.tally.at_us
    }

    /// How the robot is.
    pub(crate) fn status(&self, header: Header) -> Status {
        let Some(robot) = &self.tally.state else {
            return Status {
                header,
                robot: self.tally.robot.clone(),
                station: self.station.0,
                ..Status::default()
            };
        };
        let executes = match robot.phase() {
            Phase::Following(following) => following.executing().map(|it| it.task),
            _ => None,
        };
        let leading = leading(robot);
        let yields_to = leading.and_then(|it| it.yields_to);
        let duty = robot.duty();
        let followers = leading.into_iter().flat_map(|it| it.members.iter());
        Status {
            header,
            robot: self.tally.robot.clone(),
            station: robot.station().0,
            boot: robot.boot(),
            state: match robot.state() {
                State::Idle => Status::STATE_IDLE,
                State::HelpRequested => Status::STATE_HELP_REQUESTED,
                State::RoleEstablished => Status::STATE_ROLE_ESTABLISHED,
                State::ManeuverExecuting => Status::STATE_MANEUVER_EXECUTING,
            },
            role: match robot.role() {
                Role::None => Status::ROLE_NONE,
                Role::Requester => Status::ROLE_REQUESTER,
                Role::Helper => Status::ROLE_HELPER,
                Role::Leader => Status::ROLE_LEADER,
                Role::Follower => Status::ROLE_FOLLOWER,
            },
            availability: availability(robot.availability()),
            in_session: robot.session().is_some(),
            session: robot.session().map_or_else(Session::default, session),
            followers: followers.map(follower).collect(),
            executes: executes.map_or_else(Task::default, task),
            corridor: match leading.map(|it| it.corridor) {
                None | Some(protocol::Corridor::Clear) => Status::CORRIDOR_CLEAR,
                Some(protocol::Corridor::Open) => Status::CORRIDOR_OPEN,
                Some(protocol::Corridor::Clearing) => Status::CORRIDOR_CLEARING,
            },
            has_yielded: yields_to.is_some(),
            yields_to: yields_to.map_or(0, |station| station.0),
            duty: match duty {
                None => Status::DUTY_NONE,
                Some(Duty::FallingBack(_)) => Status::DUTY_FALLING_BACK,
                Some(Duty::Crossing(_)) => Status::DUTY_CROSSING,
            },
            duty_session: match duty {
                None => Session::default(),
                Some(Duty::FallingBack(maneuver)) => session(maneuver.id.session),
                Some(Duty::Crossing(led)) => session(led),
            },
            duty_request: match duty {
                Some(Duty::FallingBack(maneuver)) => maneuver.id.request.0,
                None | Some(Duty::Crossing(_)) => 0,
            },
        }
    }

    /// Whether the pedestrian may cross, at `now_us` on the clock of the robot, for how long at most. Of a
    /// robot of which nothing was heard for too long, nobody knows that.
    pub(crate) fn corridor(
        &self,
        header: Header,
        valid_for: Duration,
        now_us: u64,
        is_fresh: bool,
    ) -> Corridor {
        let left = Duration::from_micros(self.go_ends_us.saturating_sub(now_us));
        let is_fresh = is_fresh && !left.is_zero();
        let robot = self.tally.state.as_ref();
        let leading = robot.filter(|robot| leading(robot).is_some());
        let (reason, text) = match (self.tally.corridor_open(), is_fresh, self.closure) {
            (true, true, _) => (Corridor::REASON_NONE, String::new()),
            (true, false, _) => (
                Corridor::REASON_STALE,
                "nothing was heard of the robot for too long".to_owned(),
            ),
            (false, _, Some(why)) => (closed(why), why.to_string()),
            (false, _, None) if leading.is_some() => (
                Corridor::REASON_NOT_OPENED,
                "not opened in this session yet".to_owned(),
            ),
            (false, _, None) => (
                Corridor::REASON_NOT_LEADING,
                "the robot leads no session".to_owned(),
            ),
        };
        let (follower, leader) = match (reason, self.closure) {
            (Corridor::REASON_NOT_ENGAGED, Some(CorridorClosure::NotEngaged(station, _))) => {
                (station.0, 0)
            }
            (Corridor::REASON_YIELDED, Some(CorridorClosure::Yielded(station))) => (0, station.0),
            _ => (0, 0),
        };
        let open = reason == Corridor::REASON_NONE;
        let session_led = leading.and_then(Robot::session);
        Corridor {
            header,
            station: self.station.0,
            open,
            valid_for: duration(if open { valid_for.min(left) } else { valid_for }),
            reason,
            follower,
            leader,
            road_occupied: robot.is_some_and(is_road_occupied),
            in_session: session_led.is_some(),
            session: session_led.map_or_else(Session::default, session),
            text,
        }
    }

    /// What was dropped or ignored, by cause, with what else says how the robot is.
    pub(crate) fn diagnostic(&mut self, name: String, is_fresh: bool) -> DiagnosticStatus {
        let causes = &self.tally.causes;
        let dropped = causes.total(|layer| layer != Layer::Protocol);
        let news = dropped - self.dropped_before.min(dropped);
        self.dropped_before = dropped;
        let (level, message) = match (is_fresh, news) {
            (false, _) => (
                STALE,
                "nothing was heard of the robot for too long".to_owned(),
            ),
            (true, _) if self.tally.untrusted_clock().is_some() => (
                WARN,
                self.tally
                    .untrusted_clock()
                    .map_or_else(String::new, |it| it.to_string()),
            ),
            (true, 0) => (OK, self.tally.line()),
            (true, _) => (WARN, format!("{news} dropped since the last report")),
        };
        let sent = ("messages sent".to_owned(), self.tally.messages(Way::Sent));
        let heard = ("messages heard".to_owned(), self.tally.messages(Way::Heard));
        let causes = causes
            .iter()
            .map(|(cause, count)| (cause.to_string(), count));
        DiagnosticStatus {
            level,
            name,
            message,
            hardware_id: self.tally.robot.clone(),
            values: [sent, heard].into_iter().chain(causes).map(value).collect(),
        }
    }
}

/// Levels of `diagnostic_msgs/msg/DiagnosticStatus`.
pub(crate) const OK: u8 = 0;
pub(crate) const WARN: u8 = 1;
pub(crate) const STALE: u8 = 3;

/// A number of a diagnostic.
pub(crate) fn value((key, number): (String, u64)) -> KeyValue {
    KeyValue {
        key,
        value: number.to_string(),
    }
}

/// A header of this moment, by nanoseconds since 1970.
pub(crate) fn header(now_ns: i64, frame: &str) -> Header {
    let (seconds, nanoseconds) = (
        now_ns.div_euclid(1_000_000_000),
        now_ns.rem_euclid(1_000_000_000),
    );
    Header {
        stamp: Time {
            // Until 2038, as in all of ROS 2.
            sec: i32::try_from(seconds).unwrap_or(i32::MAX),
            nanosec: u32::try_from(nanoseconds).unwrap_or_default(),
        },
        frame_id: frame.to_owned(),
    }
}

pub(crate) fn duration(time: Duration) -> standard::Duration {
    standard::Duration {
        sec: i32::try_from(time.as_secs()).unwrap_or(i32::MAX),
        nanosec: time.subsec_nanos(),
    }
}

const fn leading(robot: &Robot) -> Option<&Leading> {
    match robot.phase() {
        Phase::Leading(leading) => Some(leading),
        _ => None,
    }
}

/// Whether people may be on the road by what this robot showed.
fn is_road_occupied(robot: &Robot) -> bool {
    let shown = leading(robot).is_some_and(|it| it.corridor != protocol::Corridor::Clear);
    shown || matches!(robot.duty(), Some(Duty::Crossing(_)))
}

const fn session(session: SessionId) -> Session {
    Session {
        leader: session.leader.0,
        boot: session.number.0.boot,
        count: session.number.0.count,
    }
}

const fn task(task: TaskType) -> Task {
    Task {
        r#type: task.value(),
    }
}

fn follower(member: &Member) -> Follower {
    Follower {
        station: member.station.0,
        has_joined: member.has_joined(),
        task: member.order.map_or_else(Task::default, |it| task(it.task)),
        progress: match member.order.and_then(|it| it.progress) {
            None => Follower::PROGRESS_NONE,
            Some(Progress::Executing) => Follower::PROGRESS_EXECUTING,
            Some(Progress::InPosition) => Follower::PROGRESS_IN_POSITION,
            Some(Progress::Completed) => Follower::PROGRESS_COMPLETED,
            Some(Progress::Failed(_)) => Follower::PROGRESS_FAILED,
            Some(Progress::SafeIdle) => Follower::PROGRESS_SAFE_IDLE,
        },
        has_lease: member.lease.stands(),
    }
}

const fn availability(availability: Availability) -> u8 {
    match availability {
        Availability::Available => Status::AVAILABLE,
        Availability::Unavailable(Unavailability::LowBattery) => Status::LOW_BATTERY,
        Availability::Unavailable(Unavailability::Teleoperated) => Status::TELEOPERATED,
        Availability::Unavailable(Unavailability::EmergencyStop) => Status::EMERGENCY_STOP,
        Availability::Unavailable(Unavailability::LocalFault) => Status::LOCAL_FAULT,
        Availability::Unavailable(Unavailability::NotSafe) => Status::NOT_SAFE,
    }
}

const fn closed(why: CorridorClosure) -> u8 {
    match why {
        CorridorClosure::NotEngaged(..) => Corridor::REASON_NOT_ENGAGED,
        CorridorClosure::FollowerMissing => Corridor::REASON_FOLLOWER_MISSING,
        CorridorClosure::SessionEnded => Corridor::REASON_SESSION_ENDED,
        CorridorClosure::Yielded(_) => Corridor::REASON_YIELDED,
        CorridorClosure::Application => Corridor::REASON_APPLICATION,
    }
}

pub(crate) fn of(kind: u8) -> Event {
    Event {
        kind,
        ..Event::default()
    }
}

fn in_session(kind: u8, id: SessionId) -> Event {
    Event {
        in_session: true,
        session: session(id),
        ..of(kind)
    }
}

fn with(kind: u8, station: StationId) -> Event {
    Event {
        station: station.0,
        ..of(kind)
    }
}

/// About a command to this robot.
pub(crate) fn about(kind: u8, id: ManeuverId, of_kind: TaskType) -> Event {
    Event {
        station: id.session.leader.0,
        request: id.request.0,
        task: task(of_kind),
        ..in_session(kind, id.session)
    }
}

/// About a command to a follower.
fn to_follower(kind: u8, station: StationId, id: ManeuverId) -> Event {
    Event {
        station: station.0,
        request: id.request.0,
        ..in_session(kind, id.session)
    }
}

pub(crate) fn news(notice: Notice) -> Event {
    match notice {
        Notice::RolesEstablished(session) => in_session(Event::ROLES_ESTABLISHED, session),
        Notice::FollowerJoined(follower) => with(Event::FOLLOWER_JOINED, follower),
        Notice::FollowerGone(follower, _) => with(Event::FOLLOWER_GONE, follower),
        Notice::LeaseGranted(follower) => with(Event::LEASE_GRANTED, follower),
        Notice::LeaseExpired(follower) => with(Event::LEASE_EXPIRED, follower),
        Notice::CommandAcknowledged(follower, id) => {
            to_follower(Event::COMMAND_ACKNOWLEDGED, follower, id)
        }
        Notice::CommandRejected(follower, id, _) => {
            to_follower(Event::COMMAND_REJECTED, follower, id)
        }
        Notice::ManeuverReported(follower, id) => {
            to_follower(Event::MANEUVER_REPORTED, follower, id)
        }
        Notice::ManeuverInPosition(follower, id) => {
            to_follower(Event::MANEUVER_IN_POSITION, follower, id)
        }
        Notice::ManeuverCompleted(follower, id) => {
            to_follower(Event::MANEUVER_COMPLETED, follower, id)
        }
        Notice::ManeuverFailed(follower, id, _) => {
            to_follower(Event::MANEUVER_FAILED, follower, id)
        }
        Notice::FollowerSafeIdle(follower, id) => {
            to_follower(Event::FOLLOWER_SAFE_IDLE, follower, id)
        }
        Notice::OfferLapsed(helper) => with(Event::OFFER_LAPSED, helper),
        Notice::Yielded(leader) => with(Event::YIELDED, leader),
        Notice::SessionEnded(session, _) => in_session(Event::SESSION_ENDED, session),
        Notice::Offering(session) => in_session(Event::OFFERING, session),
        Notice::Joined(session) => in_session(Event::JOINED, session),
        Notice::Released(session, _) => in_session(Event::RELEASED, session),
        Notice::ContactLost(session) => in_session(Event::CONTACT_LOST, session),
        Notice::ContactRegained(session) => in_session(Event::CONTACT_REGAINED, session),
    }
}

#[cfg(test)]
mod tests;
