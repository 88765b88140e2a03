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

/// A table of what the tester does, each with the words for it, which say what it means.
macro_rules! plays {
    ($($play:ident $($words:literal)? $(($of:ty) { $($value:path => $said:literal,)* })?;)*) => {
        /// Something that the tester does.
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
        #[allow(missing_docs, reason = "the table of words says what each is")]
        pub enum Play {
            $($play $(($of))?,)*
        }

        /// Each play, and the words for it.
        const WORDS: &[(Play, &str)] = &[
            $($((Play::$play, $words),)? $($((Play::$play($value), $said),)*)?)*
        ];
    };
}

plays! {
    Ask "Ada asks for help";
    AskForUnsupported "Ada asks for a task that nobody can do";
    BoAsks "Bo asks for help";
    Confirm "Ada leads and lists the robot's offer";
    ConfirmOtherOffer "Ada leads and lists an offer that the robot did not make";
    ConfirmNobody "Ada leads and lists Bo alone";
    ConfirmElsewhere "Ada leads another session and lists the robot's offer in it";
    BoConfirms "Bo leads and lists the robot's offer to Ada";
    CommandMove "Ada commands a move";
    CommandBlock "Ada commands a block";
    CommandInitialPos "Ada commands initialPos";
    CommandUnsupported "Ada commands a task that the robot did not offer";
    CommandElsewhere "Ada commands in another session";
    CommandToOther "Ada commands Bo";
    Repeat "Ada repeats her newest command";
    Older "Ada's command of long before arrives";
    Drop "Ada lists the robot no more";
    EndCompleted "Ada ends the session as completed";
    EndAborted "Ada ends the session as aborted";
    EndElsewhere "Ada names another session as ended";
    BareNone "Ada says none, and ends nothing";
    Beat(Beating) {
        Beating::Newer => "Ada beats again",
        Beating::Same => "Ada's heartbeat stands still",
        Beating::Older => "Ada's heartbeats of long before arrive",
        Beating::Mute => "Ada falls silent",
    };
    Offer "Ada offers";
    OfferUnfit "Ada offers with a t_safety of 1 ms";
    OfferElsewhere "Ada offers for a session that does not exist";
    OfferOlder "Ada's older offer arrives after the newer one";
    BoSpeaks "Bo is there and has no part";
    BoOffers "Bo offers and is nearer";
    Join "Ada follows";
    BoJoins "Bo follows";
    Ack "Ada acknowledges";
    AckOther "Ada acknowledges commands that are not outstanding";
    AckElsewhere "Ada acknowledges in another session";
    BoAcks "Bo acknowledges Ada's command";
    Reject "Ada rejects";
    ReportExecuting "Ada reports that she executes";
    ReportInPosition "Ada reports that she is in position";
    ReportCompleted "Ada reports that she has completed";
    ReportFailed "Ada reports that she has failed";
    ReportOther "Ada reports another command as completed";
    AdaLeaves "Ada leaves";
    BoLeaves "Bo leaves";
    BoClaims "Bo follows the robot in a session that is over";
    BoIntrudes "Bo follows the robot in its session, unasked";
    BoAsksFirst "Bo asks for the same place and goes before";
    BoAsksFirstOnce "Bo asks for the same place and goes before, without a heartbeat";
    BoAsksLater "Bo asks for the same place and goes behind";
    BoLeadsFirst "Bo leads at the same place and goes before";
    BoLeadsFirstOnce "Bo leads at the same place and goes before, without a heartbeat";
    BoLeadsLater "Bo leads at the same place and goes behind";
    Noise "packets arrive that mean nothing";
    OwnName "somebody speaks under the robot's name";
    Restart "the robot loses power and starts again";
    Detect "the robot detects a pedestrian and needs one follower";
    DetectTwo "the robot detects a pedestrian and needs two followers";
    OrderMove "the robot orders Ada to move";
    OrderBlock "the robot orders Ada to block";
    OrderInitialPos "the robot orders Ada to initialPos";
    InPosition "the robot is in position";
    Done "the robot has done it";
    Fail "the robot cannot do it";
    Clear "the robot sees a clear road";
    Open "the robot lets people cross";
    Close "the robot holds people back";
    TaskCompleted "the robot's pedestrian is across";
    Leave "the robot wants to leave";
    LowBattery "the robot's battery is low";
    LocalFault "the robot has a fault";
    Available "the robot is available again";
    Wait(Span) {
        Span::Offer => "t_offer passes",
        Span::Help => "t_help passes",
        Span::Safety => "t_safety passes",
        Span::Leave => "t_safety and t_leave pass",
        Span::Lease => "the lease passes",
        Span::Lost => "the lease and t_lost pass",
        Span::Repeats => "the repetitions pass",
        Span::Farewell => "t_farewell passes",
    };
}

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
