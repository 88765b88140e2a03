//! One-line texts for logs and sequence charts, of what is no enumeration of [words](crate::words).

use core::fmt::{self, Display, Formatter, Write};

use crate::id::{SessionId, UniqueNumber};
use crate::input::Input;
use crate::message::{Answer, Command, Coordination, Farewell, Ram, Report, Rmcm, Verdict};
use crate::output::Maneuver;
use crate::state::{Duty, Robot};
use crate::task::{Availability, HelpRequest, Place, TaskSet};
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
        write!(f, "command {} {}", self.request, self.progress)
    }
}

/// With `{:#}` without what goes along with every RAM: heartbeat, echo, what is asked for and offered.
impl Display for Ram {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let own = |number| SessionId::of(self.station, number);
        let is_whole = !f.alternate();
        let (session, beat) = match self.coordination {
            Coordination::None => {
                f.write_str("RAM none")?;
                (None, None)
            }
            Coordination::NeedHelp {
                number,
                heartbeat,
                request,
            } => {
                f.write_str("RAM needHelp")?;
                if is_whole {
                    write!(f, " ({request})")?;
                }
                (Some(own(number)), Some(("heartbeat", heartbeat)))
            }
            Coordination::OfferHelp {
                session,
                capabilities,
                echo,
                ..
            } => {
                f.write_str("RAM offerHelp")?;
                if is_whole {
                    write!(f, " ({capabilities})")?;
                }
                (Some(session), Some(("echo", echo)))
            }
            Coordination::Leader {
                number,
                heartbeat,
                followers,
                yields,
                ..
            } => {
                f.write_str("RAM leader of")?;
                for (i, follower) in followers.iter().enumerate() {
                    let comma = if i > 0 { "," } else { "" };
                    write!(f, "{comma} station {}", follower.station)?;
                }
                if yields {
                    f.write_str(", yields the place")?;
                }
                (Some(own(number)), Some(("heartbeat", heartbeat)))
            }
            Coordination::Follower {
                session,
                echo,
                last,
            } => {
                f.write_str("RAM follower")?;
                if let Some(report) = last {
                    write!(f, ", {report}")?;
                }
                (Some(session), Some(("echo", echo)))
            }
        };
        if let Some(session) = session {
            write!(f, ", {session}")?;
        }
        if let Some((name, beat)) = beat.filter(|_| is_whole) {
            write!(f, ", {name} {beat}")?;
        }
        match self.farewell {
            None => {}
            Some(Farewell::Ended(number, ending)) => {
                write!(f, ", ended {}, {ending}", own(number))?;
            }
            Some(Farewell::Left(session, offer)) => {
                write!(f, ", left {session}")?;
                if is_whole {
                    write!(f, " by offer {}", offer.0)?;
                }
            }
        }
        if self.on_duty {
            f.write_str(", on duty")?;
        }
        Ok(())
    }
}

/// With `{:#}` without the receiver.
impl Display for Rmcm {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Command(Command {
                session,
                to,
                request,
                task,
            }) => {
                write!(f, "RMCM command {request}: {task}")?;
                if !f.alternate() {
                    write!(f, " to station {to}")?;
                }
                write!(f, ", {session}")
            }
            Self::Answer(Answer {
                session,
                request,
                verdict,
                ..
            }) => match verdict {
                Verdict::Accepted => write!(f, "RMCM ack {request}, {session}"),
                Verdict::Rejected(reason) => {
                    write!(f, "RMCM reject {request}, {session}: {reason}")
                }
            },
        }
    }
}

/// The number from which a robot with a new pseudonym counts, where one is given.
pub(crate) struct NumbersFrom(pub(crate) Option<UniqueNumber>);

impl Display for NumbersFrom {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self.0 {
            None => Ok(()),
            Some(next) => write!(f, ", numbers from {next}"),
        }
    }
}

/// With `{:#}` as in a chart, where sender and receiver are seen.
impl Display for Input {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Ram { ram, .. } if f.alternate() => ram.fmt(f),
            Self::Ram { ram, .. } => write!(f, "{ram}, from station {}", ram.station),
            Self::Rmcm(rmcm) => rmcm.fmt(f),
            Self::Elapsed(elapsed) => write!(f, "{elapsed} elapsed"),
            Self::Expired(timer) => write!(f, "timer {timer} expired"),
            Self::Local(event) => event.fmt(f),
        }
    }
}

impl Display for Maneuver {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{}, {}", self.task, self.id)
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
