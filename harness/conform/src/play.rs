//! What the tester can do: the words in which cases are written.

use std::fmt;

use crossguard_protocol::{Millis, StationId, TaskType, Unavailability};

use crate::station::Beating;
use crate::subject::Local;

/// How long the tester goes on with what it does: until this timer of the robot must have run out.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Span {
    /// `t_offer`.
    Offer,
    /// `t_help`.
    Help,
    /// `t_safety`.
    Safety,
    /// `t_safety` and `t_leave`.
    Leave,
    /// The lease, and the time within which a RAM says what the sign shows.
    Lease,
    /// The lease, and the time for which a follower is kept without one.
    Lost,
    /// `t_ack` after the last repetition of a command.
    Repeats,
    /// `t_farewell`.
    Farewell,
}

/// Something that the tester does.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[allow(missing_docs, reason = "the table of words says what each is")]
pub enum Play {
    Ask,
    AskForUnsupported,
    BoAsks,
    Confirm,
    ConfirmOtherOffer,
    ConfirmNobody,
    ConfirmElsewhere,
    BoConfirms,
    CommandMove,
    CommandBlock,
    CommandInitialPos,
    CommandUnsupported,
    CommandElsewhere,
    CommandToOther,
    Repeat,
    Older,
    Drop,
    EndCompleted,
    EndAborted,
    EndElsewhere,
    BareNone,
    Beat(Beating),
    Offer,
    OfferUnfit,
    OfferElsewhere,
    OfferOlder,
    BoSpeaks,
    BoOffers,
    Join,
    BoJoins,
    Ack,
    AckOther,
    AckElsewhere,
    BoAcks,
    Reject,
    ReportExecuting,
    ReportInPosition,
    ReportCompleted,
    ReportFailed,
    ReportOther,
    AdaLeaves,
    BoLeaves,
    BoClaims,
    BoIntrudes,
    BoAsksFirst,
    BoAsksFirstOnce,
    BoAsksLater,
    BoLeadsFirst,
    BoLeadsFirstOnce,
    BoLeadsLater,
    Noise,
    OwnName,
    Restart,
    Detect,
    DetectTwo,
    OrderMove,
    OrderBlock,
    OrderInitialPos,
    InPosition,
    Done,
    Fail,
    Clear,
    Open,
    Close,
    TaskCompleted,
    Leave,
    LowBattery,
    LocalFault,
    Available,
    Wait(Span),
}

/// Each play, the words for it, and what it means.
const WORDS: &[(Play, &str)] = &[
    (Play::Ask, "Ada asks for help"),
    (
        Play::AskForUnsupported,
        "Ada asks for a task that nobody can do",
    ),
    (Play::BoAsks, "Bo asks for help"),
    (Play::Confirm, "Ada leads and lists the robot's offer"),
    (
        Play::ConfirmOtherOffer,
        "Ada leads and lists an offer that the robot did not make",
    ),
    (Play::ConfirmNobody, "Ada leads and lists Bo alone"),
    (
        Play::ConfirmElsewhere,
        "Ada leads another session and lists the robot's offer in it",
    ),
    (
        Play::BoConfirms,
        "Bo leads and lists the robot's offer to Ada",
    ),
    (Play::CommandMove, "Ada commands a move"),
    (Play::CommandBlock, "Ada commands a block"),
    (Play::CommandInitialPos, "Ada commands initialPos"),
    (
        Play::CommandUnsupported,
        "Ada commands a task that the robot did not offer",
    ),
    (Play::CommandElsewhere, "Ada commands in another session"),
    (Play::CommandToOther, "Ada commands Bo"),
    (Play::Repeat, "Ada repeats her newest command"),
    (Play::Older, "Ada's command of long before arrives"),
    (Play::Drop, "Ada lists the robot no more"),
    (Play::EndCompleted, "Ada ends the session as completed"),
    (Play::EndAborted, "Ada ends the session as aborted"),
    (Play::EndElsewhere, "Ada names another session as ended"),
    (Play::BareNone, "Ada says none, and ends nothing"),
    (Play::Beat(Beating::Newer), "Ada beats again"),
    (Play::Beat(Beating::Same), "Ada's heartbeat stands still"),
    (
        Play::Beat(Beating::Older),
        "Ada's heartbeats of long before arrive",
    ),
    (Play::Beat(Beating::Mute), "Ada falls silent"),
    (Play::Offer, "Ada offers"),
    (Play::OfferUnfit, "Ada offers with a t_safety of 1 ms"),
    (
        Play::OfferElsewhere,
        "Ada offers for a session that does not exist",
    ),
    (
        Play::OfferOlder,
        "Ada's older offer arrives after the newer one",
    ),
    (Play::BoSpeaks, "Bo is there and has no part"),
    (Play::BoOffers, "Bo offers and is nearer"),
    (Play::Join, "Ada follows"),
    (Play::BoJoins, "Bo follows"),
    (Play::Ack, "Ada acknowledges"),
    (
        Play::AckOther,
        "Ada acknowledges commands that are not outstanding",
    ),
    (Play::AckElsewhere, "Ada acknowledges in another session"),
    (Play::BoAcks, "Bo acknowledges Ada's command"),
    (Play::Reject, "Ada rejects"),
    (Play::ReportExecuting, "Ada reports that she executes"),
    (
        Play::ReportInPosition,
        "Ada reports that she is in position",
    ),
    (Play::ReportCompleted, "Ada reports that she has completed"),
    (Play::ReportFailed, "Ada reports that she has failed"),
    (
        Play::ReportOther,
        "Ada reports another command as completed",
    ),
    (Play::AdaLeaves, "Ada leaves"),
    (Play::BoLeaves, "Bo leaves"),
    (
        Play::BoClaims,
        "Bo follows the robot in a session that is over",
    ),
    (
        Play::BoIntrudes,
        "Bo follows the robot in its session, unasked",
    ),
    (
        Play::BoAsksFirst,
        "Bo asks for the same place and goes before",
    ),
    (
        Play::BoAsksFirstOnce,
        "Bo asks for the same place and goes before, without a heartbeat",
    ),
    (
        Play::BoAsksLater,
        "Bo asks for the same place and goes behind",
    ),
    (
        Play::BoLeadsFirst,
        "Bo leads at the same place and goes before",
    ),
    (
        Play::BoLeadsFirstOnce,
        "Bo leads at the same place and goes before, without a heartbeat",
    ),
    (
        Play::BoLeadsLater,
        "Bo leads at the same place and goes behind",
    ),
    (Play::Noise, "packets arrive that mean nothing"),
    (Play::OwnName, "somebody speaks under the robot's name"),
    (Play::Restart, "the robot loses power and starts again"),
    (
        Play::Detect,
        "the robot detects a pedestrian and needs one follower",
    ),
    (
        Play::DetectTwo,
        "the robot detects a pedestrian and needs two followers",
    ),
    (Play::OrderMove, "the robot orders Ada to move"),
    (Play::OrderBlock, "the robot orders Ada to block"),
    (Play::OrderInitialPos, "the robot orders Ada to initialPos"),
    (Play::InPosition, "the robot is in position"),
    (Play::Done, "the robot has done it"),
    (Play::Fail, "the robot cannot do it"),
    (Play::Clear, "the robot sees a clear road"),
    (Play::Open, "the robot lets people cross"),
    (Play::Close, "the robot holds people back"),
    (Play::TaskCompleted, "the robot's pedestrian is across"),
    (Play::Leave, "the robot wants to leave"),
    (Play::LowBattery, "the robot's battery is low"),
    (Play::LocalFault, "the robot has a fault"),
    (Play::Available, "the robot is available again"),
    (Play::Wait(Span::Offer), "t_offer passes"),
    (Play::Wait(Span::Help), "t_help passes"),
    (Play::Wait(Span::Safety), "t_safety passes"),
    (Play::Wait(Span::Leave), "t_safety and t_leave pass"),
    (Play::Wait(Span::Lease), "the lease passes"),
    (Play::Wait(Span::Lost), "the lease and t_lost pass"),
    (Play::Wait(Span::Repeats), "the repetitions pass"),
    (Play::Wait(Span::Farewell), "t_farewell passes"),
];

/// The part in which the tester does something.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Side {
    /// It asks for help, or competes with the robot.
    Asks,
    /// It leads the robot.
    Leads,
    /// It helps and follows the robot.
    Helps,
}

impl fmt::Display for Play {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.words())
    }
}

impl Play {
    /// Every play.
    pub(crate) fn all() -> impl Iterator<Item = Self> {
        WORDS.iter().map(|(play, _)| *play)
    }

    /// The play of these words.
    #[must_use]
    pub fn of_words(words: &str) -> Option<Self> {
        WORDS
            .iter()
            .find(|(_, known)| *known == words)
            .map(|(play, _)| *play)
    }

    /// The words for it.
    #[must_use]
    pub fn words(self) -> &'static str {
        let known = WORDS.iter().find(|(play, _)| *play == self);
        known.map_or("", |(_, words)| words)
    }

    /// The part in which the tester does it.
    pub(crate) const fn side(self) -> Side {
        match self {
            Self::Ask
            | Self::AskForUnsupported
            | Self::BoAsks
            | Self::BoAsksFirst
            | Self::BoAsksFirstOnce
            | Self::BoAsksLater
            | Self::BoLeadsFirst
            | Self::BoLeadsFirstOnce
            | Self::BoLeadsLater
            | Self::BoSpeaks => Side::Asks,
            Self::Confirm
            | Self::ConfirmOtherOffer
            | Self::ConfirmNobody
            | Self::ConfirmElsewhere
            | Self::BoConfirms
            | Self::Drop
            | Self::EndCompleted
            | Self::EndAborted
            | Self::EndElsewhere
            | Self::BareNone => Side::Leads,
            _ if self.commands() => Side::Leads,
            _ => Side::Helps,
        }
    }

    /// Whether it is a command to a follower.
    pub(crate) const fn commands(self) -> bool {
        matches!(
            self,
            Self::CommandMove
                | Self::CommandBlock
                | Self::CommandInitialPos
                | Self::CommandUnsupported
                | Self::CommandElsewhere
                | Self::CommandToOther
                | Self::Repeat
                | Self::Older
        )
    }

    /// What has to be told to the robot for it.
    #[must_use]
    pub fn local(self, ada: StationId) -> Option<Local> {
        Some(match self {
            Self::Detect => Local::Detect(1),
            Self::DetectTwo => Local::Detect(2),
            Self::OrderMove => Local::Order(ada, TaskType::MOVE),
            Self::OrderBlock => Local::Order(ada, TaskType::BLOCK),
            Self::OrderInitialPos => Local::Order(ada, TaskType::INITIAL_POS),
            Self::InPosition => Local::InPosition,
            Self::Done => Local::Done,
            Self::Fail => Local::Fail,
            Self::Clear => Local::Clear,
            Self::Open => Local::Open,
            Self::Close => Local::Close,
            Self::TaskCompleted => Local::TaskCompleted,
            Self::Leave => Local::Leave,
            Self::LowBattery => Local::Unavailable(Unavailability::LowBattery),
            Self::LocalFault => Local::Unavailable(Unavailability::LocalFault),
            Self::Available => Local::Available,
            _ => return None,
        })
    }

    /// How long it takes at least, in ms, where the tester waits for a timer.
    pub(crate) fn span_ms(self, terms: &crate::bench::Terms) -> Option<u64> {
        let Self::Wait(span) = self else { return None };
        let soon_ms = terms.soon_ms();
        let ms = |of: fn(&crossguard_protocol::Settings) -> Millis| terms.ms(of);
        let lost_ms = ms(|s| s.t_safety) + ms(|s| s.t_leave);
        Some(match span {
            Span::Offer => ms(|s| s.t_offer) + soon_ms,
            Span::Help => ms(|s| s.t_help) + soon_ms,
            Span::Safety => ms(|s| s.t_safety) + soon_ms,
            Span::Leave => lost_ms + soon_ms,
            Span::Lease => ms(|s| s.t_lease) + 600 + soon_ms,
            Span::Lost => ms(|s| s.t_lease) + lost_ms + 2 * soon_ms,
            Span::Repeats => ms(|s| s.t_ack) * (u64::from(terms.settings.n_ack) + 1) + soon_ms,
            Span::Farewell => ms(|s| s.t_farewell) + soon_ms,
        })
    }
}
