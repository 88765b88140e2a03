//! One-line texts for logs and sequence charts.

use core::fmt::{self, Display, Formatter, Write};

use crate::input::{Decimetres, Event, Input, Timer};
use crate::message::{
    Answer, Command, Coordination, Farewell, Progress, Ram, Report, Rmcm, Verdict,
};
use crate::output::{
    CorridorClosure, Disengagement, EndReason, GoneReason, Ignored, Maneuver, Notice, Output,
    ReleaseReason, StopReason,
};
use crate::state::{Duty, Robot};
use crate::task::{
    Availability, FallbackPolicy, HelpRequest, Place, TaskSet, Unavailability, Urgency,
};
use crate::time::Millis;

impl Display for Robot {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (state, role) = (self.state(), self.role());
        write!(f, "{state:?}, {role}, {}", self.availability())?;
        if let Some(session) = self.session() {
            write!(f, ", session {session}")?;
        }
        write!(f, "; says: {}", self.ram())
    }
}

/// Writes the name of an enum's variant as words: `LowBattery` as `low battery`.
struct Words<T>(T);

impl<T: fmt::Debug> Display for Words<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(
            WordSplitter {
                to: f,
                inside: false
            },
            "{:?}",
            self.0
        )
    }
}

struct WordSplitter<'a, 'b> {
    to: &'a mut Formatter<'b>,
    /// Whether the last character belongs to a word, so that a capital starts the next one.
    inside: bool,
}

impl Write for WordSplitter<'_, '_> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for c in text.chars() {
            if c.is_ascii_uppercase() && self.inside {
                self.to.write_char(' ')?;
            }
            self.to.write_char(c.to_ascii_lowercase())?;
            self.inside = c.is_alphanumeric();
        }
        Ok(())
    }
}

macro_rules! display_as_words {
    ($($type:ty),* $(,)?) => {$(
        impl Display for $type {
            fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
                Words(self).fmt(f)
            }
        }
    )*};
}

display_as_words!(
    crate::Ending,
    EndReason,
    FallbackPolicy,
    GoneReason,
    Progress,
    ReleaseReason,
    StopReason,
    Timer,
    Unavailability,
    Urgency,
    crate::Failure,
    crate::Rejection,
    crate::Role,
);

impl Display for CorridorClosure {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotEngaged(station, why) => write!(f, "station {station} is {why}"),
            other => Words(other).fmt(f),
        }
    }
}

impl Display for Ignored {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotEngaged(station, why) => write!(f, "station {station} is {why}"),
            Self::Unavailable(why) => write!(f, "unavailable, {why}"),
            other => Words(other).fmt(f),
        }
    }
}

impl Display for Disengagement {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NoLease => "out of contact",
            Self::CommandOutstanding => "yet to acknowledge a command",
            Self::NotExecuting => "not executing anything",
            Self::NotGuarding => "not guarding anybody",
            Self::NotInPosition => "not in position",
            Self::Completed => "done with its task",
            Self::Failed(why) => return write!(f, "unable to do its task: {why}"),
            Self::SafeIdle => "idle in safety",
        })
    }
}

impl Display for Availability {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Available => f.write_str("available"),
            Self::Unavailable(reason) => reason.fmt(f),
        }
    }
}

impl Display for Millis {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{} ms", self.0)
    }
}

impl Display for Decimetres {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match *self {
            Self::UNKNOWN => f.write_str("unknown distance"),
            Self(distance) => write!(f, "{}.{} m", distance / 10, distance % 10),
        }
    }
}

impl Display for TaskSet {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        for (i, task) in self.iter().enumerate() {
            if i > 0 {
                f.write_char('+')?;
            }
            task.fmt(f)?;
        }
        Ok(())
    }
}

impl Display for HelpRequest {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} x {}, {} urgency",
            self.followers, self.tasks, self.urgency
        )?;
        if self.place == Place::UNKNOWN {
            return Ok(());
        }
        write!(f, ", at {}", self.place)
    }
}

impl Display for Report {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "request {} {}", self.request, self.progress)
    }
}

impl Display for Ram {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self.coordination {
            Coordination::None => f.write_str("RAM none")?,
            Coordination::NeedHelp {
                number,
                heartbeat,
                request,
            } => {
                let number = number.0;
                write!(
                    f,
                    "RAM needHelp {}#{number} ({request}), heartbeat {heartbeat}",
                    self.station
                )?;
            }
            Coordination::OfferHelp {
                session,
                capabilities,
                echo,
                ..
            } => {
                write!(f, "RAM offerHelp {session} ({capabilities}), echo {echo}")?;
            }
            Coordination::Leader {
                number,
                heartbeat,
                followers,
                yields,
                ..
            } => {
                write!(f, "RAM leader {}#{} of", self.station, number.0)?;
                for follower in followers.iter() {
                    write!(f, " {}", follower.station)?;
                }
                write!(f, ", heartbeat {heartbeat}")?;
                if yields {
                    f.write_str(", yields the place")?;
                }
            }
            Coordination::Follower {
                session,
                echo,
                last,
            } => {
                write!(f, "RAM follower {session}, echo {echo}")?;
                if let Some(report) = last {
                    write!(f, ", {report}")?;
                }
            }
        }
        match self.farewell {
            None => {}
            Some(Farewell::Ended(number, ending)) => {
                write!(f, ", ended {}#{}, {ending}", self.station, number.0)?;
            }
            Some(Farewell::Left(session, offer)) => {
                write!(f, ", left {session} by offer {}", offer.0)?;
            }
        }
        if self.on_duty {
            f.write_str(", on duty")?;
        }
        Ok(())
    }
}

impl Display for Rmcm {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Command(Command {
                session,
                to,
                request,
                task,
            }) => {
                write!(f, "RMCM command {session}/{request} {task} to {to}")
            }
            Self::Answer(Answer {
                session,
                request,
                verdict,
                ..
            }) => match verdict {
                Verdict::Accepted => write!(f, "RMCM ack {session}/{request}"),
                Verdict::Rejected(reason) => write!(f, "RMCM reject {session}/{request}: {reason}"),
            },
        }
    }
}

impl Display for Event {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::PedestrianDetected(request) => write!(f, "pedestrian detected ({request})"),
            Self::CommandManeuver { follower, task } => write!(f, "command {follower} {task}"),
            Self::InPosition(id) => write!(f, "maneuver {id} in position"),
            Self::ManeuverCompleted(id) => write!(f, "maneuver {id} completed"),
            Self::ManeuverFailed(id) => write!(f, "maneuver {id} failed"),
            Self::TaskCompleted => f.write_str("task completed"),
            Self::RoadClear => f.write_str("road clear"),
            Self::AllAnswered => f.write_str("all have answered"),
            Self::LeaveRequested => f.write_str("leave requested"),
            Self::AvailabilityChanged(availability) => write!(f, "now {availability}"),
            Self::OpenCorridor => f.write_str("open corridor"),
            Self::CloseCorridor => f.write_str("close corridor"),
            Self::IdentityChanged(station, None) => write!(f, "identity changed to {station}"),
            Self::IdentityChanged(station, Some(next)) => {
                write!(f, "identity changed to {station}, numbers from {next}")
            }
            Self::EpochRenewed(boot) => write!(f, "boot counter renewed to {boot}"),
        }
    }
}

impl Display for Input {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Ram { ram, .. } => write!(f, "{ram} from {}", ram.station),
            Self::Rmcm(rmcm) => rmcm.fmt(f),
            Self::Elapsed(elapsed) => write!(f, "{elapsed} elapsed"),
            Self::Expired(timer) => write!(f, "timer {timer} expired"),
            Self::Local(event) => event.fmt(f),
        }
    }
}

impl Display for Maneuver {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.task, self.id)
    }
}

impl Display for Notice {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::RolesEstablished(session) => write!(f, "roles established in {session}"),
            Self::FollowerJoined(station) => write!(f, "{station} joined"),
            Self::FollowerGone(station, why) => write!(f, "{station} gone: {why}"),
            Self::LeaseGranted(station) => write!(f, "lease on {station} granted"),
            Self::LeaseExpired(station) => write!(f, "lease on {station} expired"),
            Self::CommandAcknowledged(station, id) => write!(f, "{station} acknowledged {id}"),
            Self::CommandRejected(station, id, why) => write!(f, "{station} rejected {id}: {why}"),
            Self::ManeuverReported(station, id) => write!(f, "{station} executes {id}"),
            Self::ManeuverInPosition(station, id) => write!(f, "{station} in position for {id}"),
            Self::ManeuverCompleted(station, id) => write!(f, "{station} completed {id}"),
            Self::ManeuverFailed(station, id, why) => write!(f, "{station} failed {id}: {why}"),
            Self::FollowerSafeIdle(station, id) => write!(f, "{station} fell back from {id}"),
            Self::OfferLapsed(station) => write!(f, "the offer of {station} has lapsed"),
            Self::Yielded(station) => write!(f, "place yielded to {station}"),
            Self::SessionEnded(session, why) => write!(f, "{session} ended: {why}"),
            Self::Offering(session) => write!(f, "offering to {session}"),
            Self::Joined(session) => write!(f, "joined {session}"),
            Self::Released(session, why) => write!(f, "released from {session}: {why}"),
            Self::ContactLost(session) => write!(f, "contact lost in {session}"),
            Self::ContactRegained(session) => write!(f, "contact regained in {session}"),
        }
    }
}

impl Display for Output {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::SendRam => f.write_str("send RAM"),
            Self::SendRmcm(rmcm) => write!(f, "send {rmcm}"),
            Self::StartManeuver(maneuver) => write!(f, "start {maneuver}"),
            Self::StopManeuver(maneuver, why) => write!(f, "stop {maneuver}: {why}"),
            Self::FallBack(maneuver, policy) => write!(f, "fall back from {maneuver}: {policy}"),
            Self::CorridorOpened(left) => write!(f, "corridor opened for {left}"),
            Self::CorridorExtended(left) => write!(f, "corridor open for another {left}"),
            Self::CorridorClosed(why) => write!(f, "corridor closed: {why}"),
            Self::LockIdentity => f.write_str("lock identity"),
            Self::UnlockIdentity => f.write_str("unlock identity"),
            Self::RenewEpoch => f.write_str("renew the boot counter"),
            Self::Notify(notice) => notice.fmt(f),
            Self::Ignored(reason) => write!(f, "ignored: {reason}"),
        }
    }
}

impl Display for Duty {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::FallingBack(maneuver) => write!(f, "falls back from {maneuver}"),
            Self::Crossing(session) => write!(f, "people of {session} may be on the road"),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::string::ToString;

    use crate::{
        CorridorClosure, Disengagement, Ignored, Rejection, StationId, TaskSet, TaskType,
        Unavailability,
    };

    #[test]
    fn reasons_read_as_words() {
        assert_eq!(Ignored::OldHeartbeat.to_string(), "old heartbeat");
        assert_eq!(
            Rejection::Unavailable(Unavailability::LowBattery).to_string(),
            "unavailable(low battery)"
        );
        assert_eq!(
            CorridorClosure::NotEngaged(StationId(2), Disengagement::NoLease).to_string(),
            "station 2 is out of contact"
        );
    }

    #[test]
    fn tasks_read_by_their_names() {
        let other = TaskType::new(9).unwrap();
        assert_eq!(
            TaskSet::of(&[TaskType::MOVE, other]).to_string(),
            "move+task9"
        );
    }
}
