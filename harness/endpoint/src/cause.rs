//! Why something was dropped or ignored: the layer that it happened in, and the reason.

use core::fmt::{self, Display, Formatter};

use crossguard_codec::geonet::Discarded;
use crossguard_codec::{DecodeError, Service, Unheard, ViewError, named};
use crossguard_protocol::{Disengagement, Ignored, StationId};
use serde::{Deserialize, Serialize};

named! {
    /// Where on its way something was dropped or ignored, from the link inwards.
    #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
    #[serde(rename_all = "camelCase")]
    pub enum Layer {
        /// The faults that are simulated on purpose.
        Simulated = "simulated",
        /// The link: the operating system, or the network below it.
        Link = "link",
        /// The queue between the link and the robot.
        Inbox = "inbox",
        /// `GeoNetworking` and BTP.
        Packet = "packet",
        /// The security envelope, and the permissions of its certificate.
        Security = "security",
        /// The service that a message is of.
        Service = "service",
        /// The encoding of a message.
        Syntax = "syntax",
        /// The content of a message.
        Semantics = "semantics",
        /// The state machine.
        Protocol = "protocol",
        /// The robot's own sensors.
        Perception = "perception",
        /// The robot's own body, where that is another process.
        Body = "body",
        /// The programs at its operator port.
        Operator = "operator",
        /// Persistent data: boot counter, time, revocation list and tickets.
        Storage = "storage",
        /// The log.
        Log = "log",
        /// Readers of records that need not have all of them.
        Output = "output",
    }
}

/// Why something was dropped or ignored. It displays as its layer and its reason.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Cause {
    /// The fault injector dropped a datagram.
    Simulated(Loss),
    /// A packet was not sent: the message cannot be encoded, or the operating system did not take the packet.
    NotSent,
    /// The operating system delivers no datagrams any more.
    LinkFailed,
    /// A datagram arrived while its socket had no room, and the operating system dropped it.
    SocketFull,
    /// A datagram is not framed as the link's datagrams are.
    Misframed(&'static str),
    /// A datagram waited for longer than `delay_max` between its arrival and its input to the robot.
    WaitedTooLong,
    /// A datagram arrived while the inbox was full.
    InboxFull,
    /// The clock that the robot is told of shows less than it did. Time stands still for the robot until it has caught up.
    ClockWentBack,
    /// A packet is not one for this station.
    Discarded(&'static str),
    /// A packet cannot be relied on.
    Rejected(&'static str),
    /// A message that this station has no use for.
    NoUse(Service),
    /// A datagram is not a message.
    Undecodable(&'static str),
    /// A message of another station is not encoded canonically: it is read all the same, and counted.
    NotCanonical,
    /// A message contradicts itself.
    Contradictory(&'static str),
    /// The transition function ignored an input.
    Ignored(Ignored),
    /// Another leader at the place of this one goes behind, and does not yield. It is told once for each of its sessions.
    NotYielding,
    /// The application had more for the state machine at once than waits for it.
    WishesFull,
    /// Another robot asks for help, or leads, at a crossing that is not this robot's.
    OtherCrossing,
    /// A robot offers help that cannot do what every follower of the plan is to do.
    Unfit,
    /// The robot perceived people and does not know its own position.
    Unplaced,
    /// A sensor source delivered no usable frame, for this reason.
    FrameDropped(&'static str),
    /// The body fell silent, or its connection ended: an emergency stop.
    BodySilent,
    /// The body has a fault.
    BodyFault,
    /// The body said something that is no line of the port, or of a maneuver that does not run; or it said no hello.
    BodyGarbled,
    /// A body wanted to connect while another one is connected.
    BodiesFull,
    /// Another user wanted to connect to the body port.
    BodyStranger,
    /// A program said something that is no line of the operator port, or never said hello.
    OperatorGarbled,
    /// A program did not read what the operator port told it.
    OperatorSlow,
    /// More programs wanted to connect to the operator port than can.
    OperatorsFull,
    /// Another user wanted to connect to the operator port.
    OperatorStranger,
    /// The robot was held, and what programs said at the operator port may have waited: their connections ended.
    OperatorHeld,
    /// A program said again at once what a person says of the road or of the robot: it is taken for a stuck button.
    OperatorRepeats,
    /// A person said that the road is clear while another robot's sign may show go: it is to be said again.
    SaidTooEarly,
    /// The next boot counter could not be persisted; the robot keeps the one that it has.
    EpochNotRenewed,
    /// The time could not be persisted; a robot that loses power now may trust a clock that was put back.
    TimeNotKept,
    /// The revocation list cannot be read any more; the robot keeps the one that it has.
    RevokedUnread,
    /// No ticket of the robot lasts for a session: it is unavailable until one does.
    TicketsEnd,
    /// The log's reader was too slow, or the log has no room: the record is not in the log.
    LogFull,
    /// A reader of records that need not have all of them was too slow.
    OutputFull,
}

impl Cause {
    /// Where it was dropped or ignored.
    #[must_use]
    pub const fn layer(self) -> Layer {
        match self {
            Self::Simulated(_) => Layer::Simulated,
            Self::NotSent | Self::LinkFailed | Self::SocketFull | Self::Misframed(_) => Layer::Link,
            Self::WaitedTooLong | Self::InboxFull => Layer::Inbox,
            Self::Discarded(_) => Layer::Packet,
            Self::Rejected(_) => Layer::Security,
            Self::NoUse(_) => Layer::Service,
            Self::Undecodable(_) | Self::NotCanonical => Layer::Syntax,
            Self::Contradictory(_) => Layer::Semantics,
            Self::Ignored(_)
            | Self::NotYielding
            | Self::WishesFull
            | Self::OtherCrossing
            | Self::Unfit
            | Self::ClockWentBack => Layer::Protocol,
            Self::Unplaced | Self::FrameDropped(_) => Layer::Perception,
            Self::BodySilent
            | Self::BodyFault
            | Self::BodyGarbled
            | Self::BodiesFull
            | Self::BodyStranger => Layer::Body,
            Self::OperatorGarbled
            | Self::OperatorSlow
            | Self::OperatorsFull
            | Self::OperatorStranger
            | Self::OperatorHeld
            | Self::OperatorRepeats
            | Self::SaidTooEarly => Layer::Operator,
            Self::EpochNotRenewed | Self::TimeNotKept | Self::RevokedUnread | Self::TicketsEnd => {
                Layer::Storage
            }
            Self::LogFull => Layer::Log,
            Self::OutputFull => Layer::Output,
        }
    }

    /// Why, without the layer.
    #[must_use]
    pub const fn reason(self) -> Reason {
        Reason(self)
    }
}

/// The reason of a [`Cause`], which it displays as: a name, without the station that it was about.
#[derive(Clone, Copy, Debug)]
pub struct Reason(Cause);

impl Display for Reason {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self.0 {
            Cause::Simulated(loss) => loss.name(),
            Cause::NotSent => "not sent",
            Cause::LinkFailed => "failed",
            Cause::SocketFull | Cause::InboxFull | Cause::LogFull | Cause::OutputFull => "full",
            Cause::WaitedTooLong => "waited too long",
            Cause::ClockWentBack => "clock went back",
            Cause::Misframed(why)
            | Cause::Discarded(why)
            | Cause::Rejected(why)
            | Cause::Undecodable(why)
            | Cause::Contradictory(why)
            | Cause::FrameDropped(why) => why,
            Cause::NotCanonical => "not canonical, but read",
            Cause::NoUse(service) => return write!(f, "no use for {}", service.name()),
            Cause::Ignored(Ignored::NotEngaged(..)) => "not engaged",
            Cause::Ignored(why) => return why.fmt(f),
            Cause::NotYielding => "another leader does not yield",
            Cause::WishesFull => "too many wishes of the application",
            Cause::OtherCrossing => "another crossing",
            Cause::Unfit => "offer without a task of the plan",
            Cause::Unplaced => "own position unknown",
            Cause::BodySilent => "silent",
            Cause::BodyFault => "fault",
            Cause::BodyGarbled | Cause::OperatorGarbled => "not understood",
            Cause::OperatorSlow => "too slow",
            Cause::BodiesFull | Cause::OperatorsFull => "too many",
            Cause::BodyStranger | Cause::OperatorStranger => "another user",
            Cause::OperatorHeld => "held",
            Cause::OperatorRepeats => "said again",
            Cause::SaidTooEarly => "said too early",
            Cause::EpochNotRenewed => "boot counter not renewed",
            Cause::TimeNotKept => "time not kept",
            Cause::RevokedUnread => "revocation list not read",
            Cause::TicketsEnd => "tickets end",
        })
    }
}

impl Display for Cause {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.layer(), self.reason())
    }
}

named! {
    /// How the fault injector dropped a datagram.
    #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
    pub enum Loss {
        /// By itself.
        Random = "loss",
        /// In a burst.
        Burst = "burst loss",
        /// In an outage.
        Outage = "outage",
        /// Too many datagrams were under way already.
        Overflow = "overflow",
    }
}

impl From<Ignored> for Cause {
    /// One cause for all stations and states: those are in the log.
    fn from(why: Ignored) -> Self {
        Self::Ignored(match why {
            Ignored::NotEngaged(..) => {
                Ignored::NotEngaged(StationId(0), Disengagement::NotExecuting)
            }
            why => why,
        })
    }
}

impl From<Discarded> for Cause {
    fn from(discarded: Discarded) -> Self {
        match discarded {
            Discarded::Envelope(_) | Discarded::WrongPermission { .. } => {
                Self::Rejected(discarded.cause())
            }
            _ => Self::Discarded(discarded.cause()),
        }
    }
}

impl From<&DecodeError> for Cause {
    fn from(error: &DecodeError) -> Self {
        Self::Undecodable(error.cause())
    }
}

impl From<&ViewError> for Cause {
    fn from(error: &ViewError) -> Self {
        Self::Contradictory(error.cause())
    }
}

impl From<&Unheard> for Cause {
    fn from(unheard: &Unheard) -> Self {
        match unheard {
            Unheard::Undecodable(error) => error.into(),
            Unheard::Contradictory(error) => error.into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_are_listed_in_their_order_with_their_serialized_names() {
        assert!(Layer::ALL.is_sorted());
        for layer in Layer::ALL {
            assert_eq!(serde_json::to_value(layer).unwrap(), layer.name());
        }
    }

    #[test]
    fn a_cause_is_named_without_the_station_that_it_was_about() {
        let [one, other] = [7, 8]
            .map(StationId)
            .map(|station| Cause::from(Ignored::NotEngaged(station, Disengagement::Completed)));
        assert_eq!(one, other);
        assert_eq!(one.to_string(), "protocol: not engaged");
        assert_eq!(
            Cause::NoUse(Service::Denm).to_string(),
            "service: no use for DENM"
        );
    }
}
