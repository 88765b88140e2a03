//! Plays of the tester: the words in which cases are written.

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

/// A table of what the tester does: each with who does it, and the words for it, which say what it means.
macro_rules! plays {
    ($(
        $play:ident $($side:ident $(($local:expr))? $words:literal)?
        $(($of:ty) { $($value:path => $said:literal,)* })?;
    )*) => {
        /// Something that the tester does.
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
        #[allow(missing_docs, reason = "the table of words says what each is")]
        pub enum Play {
            $($play $(($of))?,)*
        }

        /// Each play, who does it, and the words for it.
        const ALL: &[(Play, Side, &str)] = &[
            $(
                $((Play::$play, Side::$side $(($local))?, $words),)?
                $($((Play::$play($value), Side::Other, $said),)*)?
            )*
        ];
    };
}

plays! {
    Ask Asks "Ada asks for help";
    AskForUnsupported Asks "Ada asks for a task that nobody can do";
    BoAsks Asks "Bo asks for help";
    Confirm Leads "Ada leads and lists the robot's offer";
    ConfirmOtherOffer Leads "Ada leads and lists an offer that the robot did not make";
    ConfirmNobody Leads "Ada leads and lists Bo alone";
    ConfirmElsewhere Leads "Ada leads another session and lists the robot's offer in it";
    BoConfirms Leads "Bo leads and lists the robot's offer to Ada";
    CommandMove Commands "Ada commands a move";
    CommandBlock Commands "Ada commands a block";
    CommandInitialPos Commands "Ada commands initialPos";
    CommandUnsupported Commands "Ada commands a task that the robot did not offer";
    CommandElsewhere Commands "Ada commands in another session";
    CommandToOther Commands "Ada commands Bo";
    Repeat Commands "Ada repeats her newest command";
    Older Commands "Ada's command of long before arrives";
    Drop Leads "Ada lists the robot no more";
    EndCompleted Leads "Ada ends the session as completed";
    EndAborted Leads "Ada ends the session as aborted";
    EndElsewhere Leads "Ada names another session as ended";
    BareNone Leads "Ada says none, and ends nothing";
    Beat(Beating) {
        Beating::Newer => "Ada beats again",
        Beating::Same => "Ada's heartbeat stands still",
        Beating::Older => "Ada's heartbeats of long before arrive",
        Beating::Mute => "Ada falls silent",
    };
    Offer Helps "Ada offers";
    OfferUnfit Helps "Ada offers with a t_safety of 1 ms";
    OfferElsewhere Helps "Ada offers for a session that does not exist";
    OfferOlder Helps "Ada's older offer arrives after the newer one";
    BoSpeaks Asks "Bo is there and has no part";
    BoOffers Helps "Bo offers and is nearer";
    Join Helps "Ada follows";
    BoJoins Helps "Bo follows";
    Ack Helps "Ada acknowledges";
    AckOther Helps "Ada acknowledges commands that are not outstanding";
    AckElsewhere Helps "Ada acknowledges in another session";
    BoAcks Helps "Bo acknowledges Ada's command";
    Reject Helps "Ada rejects";
    ReportExecuting Helps "Ada reports that she executes";
    ReportInPosition Helps "Ada reports that she is in position";
    ReportCompleted Helps "Ada reports that she has completed";
    ReportFailed Helps "Ada reports that she has failed";
    ReportOther Helps "Ada reports another command as completed";
    AdaLeaves Helps "Ada leaves";
    BoLeaves Helps "Bo leaves";
    BoClaims Helps "Bo follows the robot in a session that is over";
    BoIntrudes Helps "Bo follows the robot in its session, unasked";
    BoAsksFirst Asks "Bo asks for the same place and goes before";
    BoAsksFirstOnce Asks "Bo asks for the same place and goes before, without a heartbeat";
    BoAsksLater Asks "Bo asks for the same place and goes behind";
    BoLeadsFirst Asks "Bo leads at the same place and goes before";
    BoLeadsFirstOnce Asks "Bo leads at the same place and goes before, without a heartbeat";
    BoLeadsLater Asks "Bo leads at the same place and goes behind";
    Noise Other "packets arrive that mean nothing";
    OwnName Other "somebody speaks under the robot's name";
    Restart Other "the robot loses power and starts again";
    Detect Happens(|_| Local::Detect(1)) "the robot detects a pedestrian and needs one follower";
    DetectTwo Happens(|_| Local::Detect(2)) "the robot detects a pedestrian and needs two followers";
    OrderMove Happens(|ada| Local::Order(ada, TaskType::MOVE)) "the robot orders Ada to move";
    OrderBlock Happens(|ada| Local::Order(ada, TaskType::BLOCK)) "the robot orders Ada to block";
    OrderInitialPos Happens(|ada| Local::Order(ada, TaskType::INITIAL_POS)) "the robot orders Ada to initialPos";
    InPosition Happens(|_| Local::InPosition) "the robot is in position";
    Done Happens(|_| Local::Done) "the robot has done it";
    Fail Happens(|_| Local::Fail) "the robot cannot do it";
    Clear Happens(|_| Local::Clear) "the robot sees a clear road";
    Open Happens(|_| Local::Open) "the robot lets people cross";
    Close Happens(|_| Local::Close) "the robot holds people back";
    TaskCompleted Happens(|_| Local::TaskCompleted) "the robot's pedestrian is across";
    Leave Happens(|_| Local::Leave) "the robot wants to leave";
    LowBattery Happens(|_| Local::Unavailable(Unavailability::LowBattery)) "the robot's battery is low";
    LocalFault Happens(|_| Local::Unavailable(Unavailability::LocalFault)) "the robot has a fault";
    Available Happens(|_| Local::Available) "the robot is available again";
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

/// The side that brings a play about.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Side {
    /// The tester asks for help, or competes with the robot.
    Asks,
    /// The tester leads the robot.
    Leads,
    /// The tester commands a follower.
    Commands,
    /// The tester helps and follows the robot.
    Helps,
    /// An event at the robot's side, where Ada has this station id.
    Happens(fn(StationId) -> Local),
    /// The tester does what needs no part in a session.
    Other,
}

impl Play {
    /// The play of these words.
    #[must_use]
    pub fn of_words(words: &str) -> Option<Self> {
        let known = ALL.iter().find(|(.., known)| *known == words);
        known.map(|(play, ..)| *play)
    }

    /// The words for it.
    #[must_use]
    pub fn words(self) -> &'static str {
        let known = ALL.iter().find(|(play, ..)| *play == self);
        known.map_or("", |(.., words)| words)
    }

    pub(crate) fn side(self) -> Side {
        let known = ALL.iter().find(|(play, ..)| *play == self);
        known.map_or(Side::Other, |(_, side, _)| *side)
    }

    /// The event that has to be told to the robot for it.
    #[must_use]
    pub fn local(self, ada: StationId) -> Option<Local> {
        match self.side() {
            Side::Happens(local) => Some(local(ada)),
            _ => None,
        }
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
