//! What the tester can do: the words in which cases are written.

use std::fmt;

use crossguard_protocol::{
    Answer, Command, Confirmation, Coordination, Ending, Failure, Farewell, Followers, HelpRequest,
    Millis, OfferNumber, Place, Progress, Ram, Rejection, Report, RequestId, SessionId,
    SessionNumber, StationId, TaskSet, TaskType, Unavailability, UniqueNumber, Urgency, Verdict,
};

use crate::bench::Bench;
use crate::exchange::{Happening, Player, offer_of, session_of};
use crate::station::{Beating, Part};
use crate::subject::{Gone, Local, Subject};

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

impl fmt::Display for Play {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.words())
    }
}

/// What became of a play.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Performed {
    /// It was done.
    Yes,
    /// The robot's situation is not one for it.
    OutOfPlace,
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
            Span::Lost => ms(|s| s.t_lease) + lost_ms + soon_ms,
            Span::Repeats => ms(|s| s.t_ack) * (u64::from(terms.settings.n_ack) + 1) + soon_ms,
            Span::Farewell => ms(|s| s.t_farewell) + soon_ms,
        })
    }
}

/// A task that no robot offers.
const UNSUPPORTED: u8 = 9;

/// How long a robot that does things by itself is waited for, in ms.
const AWAITED_MS: u64 = 6_000;

/// How far apart one-off messages are that are sent three times, since a link may lose one, in ms.
const APART_MS: u64 = 60;

impl<S: Subject> Bench<S> {
    /// Does it, and listens to what comes of it.
    pub(crate) fn perform(&mut self, play: Play, is_last: bool) -> Result<Performed, Gone> {
        let begun = self.exchange.seen.len();
        self.note(Happening::Play(play.words()));
        let performed = self.begin(play)?;
        if performed == Performed::OutOfPlace {
            self.exchange.seen.truncate(begun);
            return Ok(performed);
        }
        let soon_ms = self.terms.soon_ms();
        if let Some(span_ms) = play.span_ms(&self.terms) {
            self.pass(span_ms)?;
        } else if is_last || play == Play::Restart {
            let more_ms = if self.generates {
                100
            } else {
                self.terms.ms(|s| s.t_ack) + 150
            };
            self.pass(soon_ms + more_ms)?;
        } else {
            let before = self.essence();
            let answers = self.exchange.answers().count() + self.exchange.commands().count();
            let has_changed = |bench: &Self| {
                let now = bench.exchange.answers().count() + bench.exchange.commands().count();
                bench.essence() != before || now > answers
            };
            if self.pass_until(soon_ms, has_changed)? {
                self.pass(self.terms.ms(|s| s.ram_period) + 50)?;
            }
        }
        Ok(performed)
    }

    /// What the robot says, but for what changes with every RAM.
    fn essence(&self) -> Option<String> {
        let said = self.said()?;
        let part = crate::words::part(&said.ram.coordination);
        let list = match said.ram.coordination {
            Coordination::Leader { followers, .. } => followers.iter().count(),
            _ => 0,
        };
        let (farewell, duty) = (said.ram.farewell, said.ram.on_duty);
        let session = session_of(&said.ram);
        let (sign, available) = (said.sign, said.availability);
        Some(format!(
            "{part} {session:?} {list} {farewell:?} {duty} {sign:?} {available:?}"
        ))
    }

    fn begin(&mut self, play: Play) -> Result<Performed, Gone> {
        if let Some(local) = play.local(self.terms.players[0]) {
            if !self.can_be_told(play) {
                return Ok(Performed::OutOfPlace);
            }
            let before = self.essence();
            if self.tell(local) {
                let has_changed = |bench: &Self| bench.essence() != before;
                self.pass_until(AWAITED_MS, has_changed)?;
            }
            return Ok(Performed::Yes);
        }
        let fits = match play {
            Play::Wait(_) => true,
            Play::Noise => return self.make_noise(),
            Play::OwnName => return self.speak_as_the_robot(),
            Play::Restart => {
                self.restart();
                true
            }
            Play::Beat(beating) => {
                let ada = self.station(Player::Ada);
                let fits = ada.part != Part::Nothing && ada.beating != beating;
                ada.beating = beating;
                fits
            }
            _ => match self.begin_as_requester(play)? {
                Some(fits) => fits,
                None => match self.begin_as_leader(play)? {
                    Some(fits) => fits,
                    None => self.begin_as_helper(play)?,
                },
            },
        };
        Ok(if fits {
            Performed::Yes
        } else {
            Performed::OutOfPlace
        })
    }

    /// Whether such a thing can happen at the robot, by what it says of itself.
    fn can_be_told(&self, play: Play) -> bool {
        let Some(said) = self.said() else {
            return false;
        };
        let part = said.ram.coordination;
        let leads = matches!(part, Coordination::Leader { .. });
        let follows = matches!(part, Coordination::Follower { .. });
        let executes = |progress: Progress| match part {
            Coordination::Follower {
                last: Some(report), ..
            } => report.progress == progress,
            _ => false,
        };
        let is_available = said.availability == crossguard_protocol::Availability::Available;
        match play {
            Play::Detect | Play::DetectTwo => part == Coordination::None,
            Play::OrderMove
            | Play::OrderBlock
            | Play::OrderInitialPos
            | Play::Open
            | Play::Close => leads,
            Play::InPosition => executes(Progress::Executing),
            Play::Done | Play::Fail => {
                executes(Progress::Executing) || executes(Progress::InPosition)
            }
            Play::Clear => said.ram.on_duty || leads,
            Play::TaskCompleted => leads || matches!(part, Coordination::NeedHelp { .. }),
            Play::Leave => part != Coordination::None,
            Play::LowBattery | Play::LocalFault => is_available && (follows || !leads || leads),
            Play::Available => !is_available,
            _ => true,
        }
    }

    fn asks(&mut self, player: Player, tasks: TaskSet, urgency: Urgency, place: Place) {
        let number = SessionNumber(self.station(player).issue());
        let request = HelpRequest {
            urgency,
            followers: 1,
            tasks,
            place,
        };
        let station = self.station(player);
        (station.part, station.farewell) = (Part::Asks { number, request }, None);
        station.beating = Beating::Newer;
        self.hurry(player);
    }

    /// The tester asks for help.
    fn begin_as_requester(&mut self, play: Play) -> Result<Option<bool>, Gone> {
        let tasks = TaskSet(0b111);
        let is_free = |bench: &mut Self, player| {
            matches!(
                bench.station(player).part,
                Part::Nothing | Part::SaysNothing
            )
        };
        let place = self.place_of_robot();
        let competes = self.said().is_some_and(|said| {
            matches!(
                said.ram.coordination,
                Coordination::NeedHelp { .. } | Coordination::Leader { .. }
            )
        });
        Ok(Some(match play {
            Play::Ask if is_free(self, Player::Ada) => {
                self.asks(Player::Ada, tasks, Urgency::Medium, Place::UNKNOWN);
                true
            }
            Play::AskForUnsupported if is_free(self, Player::Ada) => {
                self.asks(
                    Player::Ada,
                    TaskSet(1 << UNSUPPORTED),
                    Urgency::Medium,
                    Place::UNKNOWN,
                );
                true
            }
            Play::BoAsks if is_free(self, Player::Bo) => {
                self.asks(Player::Bo, tasks, Urgency::High, Place::UNKNOWN);
                true
            }
            Play::BoAsksFirst | Play::BoAsksFirstOnce if competes && is_free(self, Player::Bo) => {
                self.asks(Player::Bo, tasks, Urgency::Emergency, place);
                if play == Play::BoAsksFirstOnce {
                    self.station(Player::Bo).beating = Beating::Same;
                }
                true
            }
            Play::BoAsksLater if competes && is_free(self, Player::Bo) => {
                self.asks(Player::Bo, tasks, Urgency::Low, place);
                true
            }
            Play::BoLeadsFirst | Play::BoLeadsFirstOnce | Play::BoLeadsLater
                if competes && is_free(self, Player::Bo) =>
            {
                let number = SessionNumber(self.station(Player::Bo).issue());
                let somebody = Confirmation {
                    station: StationId(77),
                    offer: OfferNumber(UniqueNumber { boot: 1, count: 0 }),
                };
                let urgency = match play {
                    Play::BoLeadsLater => Urgency::Low,
                    _ => Urgency::Emergency,
                };
                let bo = self.station(Player::Bo);
                bo.part = Part::Leads {
                    number,
                    followers: [somebody].into_iter().collect(),
                    urgency,
                    place,
                };
                if play == Play::BoLeadsFirstOnce {
                    bo.beating = Beating::Same;
                }
                self.hurry(Player::Bo);
                true
            }
            Play::BoSpeaks if is_free(self, Player::Bo) => {
                self.station(Player::Bo).part = Part::SaysNothing;
                self.hurry(Player::Bo);
                true
            }
            Play::Ask
            | Play::AskForUnsupported
            | Play::BoAsks
            | Play::BoAsksFirst
            | Play::BoAsksFirstOnce
            | Play::BoAsksLater
            | Play::BoLeadsFirst
            | Play::BoLeadsFirstOnce
            | Play::BoLeadsLater
            | Play::BoSpeaks => false,
            _ => return Ok(None),
        }))
    }

    /// The place of the robot's own request or session.
    fn place_of_robot(&self) -> Place {
        match self.said().map(|said| said.ram.coordination) {
            Some(Coordination::NeedHelp { request, .. }) => request.place,
            Some(Coordination::Leader { place, .. }) => place,
            _ => Place::UNKNOWN,
        }
    }

    fn lead(&mut self, player: Player, number: SessionNumber, list: Confirmation) {
        let station = self.station(player);
        station.farewell = None;
        station.part = Part::Leads {
            number,
            followers: [list].into_iter().collect::<Followers>(),
            urgency: Urgency::Medium,
            place: Place::UNKNOWN,
        };
        self.hurry(player);
    }

    /// The tester leads the robot.
    fn begin_as_leader(&mut self, play: Play) -> Result<Option<bool>, Gone> {
        let (robot, bo) = (self.exchange.robot, self.terms.players[1]);
        let session = self.station(Player::Ada).own_session();
        let offered = self.said().and_then(|said| offer_of(&said.ram));
        let offered = offered.filter(|(to, _)| Some(*to) == session);
        let leads = matches!(self.station(Player::Ada).part, Part::Leads { .. });
        let nobody = Confirmation {
            station: bo,
            offer: OfferNumber(UniqueNumber { boot: 1, count: 0 }),
        };
        let fits = match (play, session, offered) {
            (Play::Confirm, Some(session), Some((_, offer))) => {
                let station = robot;
                self.lead(Player::Ada, session.number, Confirmation { station, offer });
                true
            }
            (Play::ConfirmOtherOffer, Some(session), Some((_, offer))) => {
                let other = UniqueNumber {
                    count: offer.0.count + 1,
                    ..offer.0
                };
                let list = Confirmation {
                    station: robot,
                    offer: OfferNumber(other),
                };
                self.lead(Player::Ada, session.number, list);
                true
            }
            (Play::ConfirmNobody, Some(session), Some(_)) => {
                self.lead(Player::Ada, session.number, nobody);
                true
            }
            (Play::ConfirmElsewhere, Some(_), Some((_, offer))) => {
                let number = SessionNumber(self.station(Player::Ada).issue());
                let station = robot;
                self.lead(Player::Ada, number, Confirmation { station, offer });
                true
            }
            (Play::BoConfirms, Some(_), Some((_, offer))) => {
                let number = SessionNumber(self.station(Player::Bo).issue());
                let station = robot;
                self.lead(Player::Bo, number, Confirmation { station, offer });
                true
            }
            (Play::Drop, Some(session), _) if leads => {
                self.lead(Player::Ada, session.number, nobody);
                true
            }
            (Play::EndCompleted | Play::EndAborted, Some(session), _) => {
                let how = if play == Play::EndCompleted {
                    Ending::Completed
                } else {
                    Ending::Aborted
                };
                let ada = self.station(Player::Ada);
                (ada.part, ada.beating) = (Part::Nothing, Beating::Newer);
                ada.farewell = Some(Farewell::Ended(session.number, how));
                self.hurry(Player::Ada);
                true
            }
            (Play::EndElsewhere, Some(session), _) => {
                let other = other_number(session.number);
                let ada = self.station(Player::Ada);
                ada.farewell = Some(Farewell::Ended(other, Ending::Completed));
                self.hurry(Player::Ada);
                true
            }
            (Play::BareNone, Some(_), _) => {
                self.station(Player::Ada).part = Part::SaysNothing;
                self.hurry(Player::Ada);
                true
            }
            (
                Play::CommandMove
                | Play::CommandBlock
                | Play::CommandInitialPos
                | Play::CommandUnsupported
                | Play::CommandElsewhere
                | Play::CommandToOther
                | Play::Repeat
                | Play::Older,
                Some(session),
                _,
            ) if leads => self.command(play, session)?,
            (
                Play::Confirm
                | Play::ConfirmOtherOffer
                | Play::ConfirmNobody
                | Play::ConfirmElsewhere
                | Play::BoConfirms
                | Play::Drop
                | Play::EndCompleted
                | Play::EndAborted
                | Play::EndElsewhere
                | Play::BareNone
                | Play::CommandMove
                | Play::CommandBlock
                | Play::CommandInitialPos
                | Play::CommandUnsupported
                | Play::CommandElsewhere
                | Play::CommandToOther
                | Play::Repeat
                | Play::Older,
                ..,
            ) => false,
            _ => return Ok(None),
        };
        Ok(Some(fits))
    }

    fn command(&mut self, play: Play, session: SessionId) -> Result<bool, Gone> {
        let task = match play {
            Play::CommandBlock => TaskType::BLOCK,
            Play::CommandInitialPos => TaskType::INITIAL_POS,
            Play::CommandUnsupported => TaskType::new(UNSUPPORTED).unwrap_or(TaskType::MOVE),
            _ => TaskType::MOVE,
        };
        let to = self.exchange.robot;
        let next = Command {
            session,
            to,
            request: self.next_request,
            task,
        };
        let command = match play {
            Play::CommandElsewhere => Command {
                session: SessionId {
                    number: other_number(session.number),
                    ..session
                },
                ..next
            },
            Play::CommandToOther => Command {
                to: self.terms.players[1],
                ..next
            },
            Play::Repeat | Play::Older => {
                let Some(newest) = self.command.filter(|command| command.session == session) else {
                    return Ok(false);
                };
                let request = match play {
                    Play::Older => RequestId(newest.request.0.wrapping_sub(5)),
                    _ => newest.request,
                };
                Command { request, ..newest }
            }
            _ => {
                self.next_request = self.next_request.next();
                self.command = Some(next);
                next
            }
        };
        let is_new = command == next && self.command == Some(next);
        let answers = |bench: &Self| {
            let mut answers = bench.exchange.answers();
            answers.any(|(_, it)| it.session == command.session && it.request == command.request)
        };
        for _ in 0..4 {
            self.send_command(Player::Ada, command)?;
            let apart_ms = if is_new { 3 * APART_MS } else { APART_MS };
            if self.pass_until(apart_ms, |bench| is_new && answers(bench))? {
                break;
            }
        }
        Ok(true)
    }

    /// The tester helps and follows the robot.
    fn begin_as_helper(&mut self, play: Play) -> Result<bool, Gone> {
        let Some(said) = self.said().copied() else {
            return Ok(false);
        };
        let robot = self.exchange.robot;
        let session = session_of(&said.ram).filter(|session| session.leader == robot);
        let asks = matches!(said.ram.coordination, Coordination::NeedHelp { .. });
        let listed = |player: StationId| match said.ram.coordination {
            Coordination::Leader { followers, .. } => {
                followers.iter().find(|it| it.station == player).copied()
            }
            _ => None,
        };
        let t_safety = self.terms.settings.t_safety;
        let [ada, bo] = self.terms.players;
        match (play, session) {
            (Play::Offer | Play::OfferUnfit | Play::OfferElsewhere, Some(session)) if asks => {
                self.older_offer = Some(OfferNumber(self.station(Player::Ada).issue()));
                let number = match play {
                    Play::OfferElsewhere => other_number(session.number),
                    _ => session.number,
                };
                let t_safety = match play {
                    Play::OfferUnfit => Millis(1),
                    _ => t_safety,
                };
                self.offer(Player::Ada, SessionId { number, ..session }, t_safety);
            }
            (Play::BoOffers, Some(session)) if asks => self.offer(Player::Bo, session, t_safety),
            (Play::OfferOlder, Some(session)) if asks => {
                let Some(offer) = self.older_offer else {
                    return Ok(false);
                };
                let station = self.station(Player::Ada);
                let mut ram = station.next_ram(None);
                ram.coordination = Coordination::OfferHelp {
                    session,
                    offer,
                    capabilities: TaskSet(0b111),
                    echo: station.echo,
                    t_safety,
                };
                self.send_ram(Player::Ada, ram)?;
            }
            (Play::Join, Some(session)) if listed(ada).is_some() => {
                self.follow(Player::Ada, session, None);
            }
            (Play::BoJoins, Some(session)) if listed(bo).is_some() => {
                self.follow(Player::Bo, session, None);
            }
            (Play::AdaLeaves | Play::BoLeaves, Some(session)) => {
                let player = if play == Play::AdaLeaves {
                    Player::Ada
                } else {
                    Player::Bo
                };
                let id = self.station(player).id;
                let Some(confirmed) = listed(id) else {
                    return Ok(false);
                };
                let station = self.station(player);
                station.part = Part::Nothing;
                station.farewell = Some(Farewell::Left(session, confirmed.offer));
                self.hurry(player);
            }
            (Play::BoClaims, _) => {
                // The newest session of the robot that is over, or one that it never opened.
                let sessions: Vec<SessionId> = self
                    .exchange
                    .rams()
                    .filter_map(|(_, it)| session_of(&it.ram))
                    .collect();
                let is_over = |it: &&SessionId| it.leader == robot && Some(**it) != session;
                let over = sessions.iter().rfind(is_over).copied();
                let over = over.unwrap_or(SessionId {
                    leader: robot,
                    number: SessionNumber(UniqueNumber { boot: 0, count: 7 }),
                });
                self.follow(Player::Bo, over, None);
            }
            _ => return self.answer_or_report(play, session),
        }
        Ok(true)
    }

    fn offer(&mut self, player: Player, session: SessionId, t_safety: Millis) {
        let offer = OfferNumber(self.station(player).issue());
        let station = self.station(player);
        station.farewell = None;
        station.part = Part::Offers {
            session,
            offer,
            t_safety,
        };
        self.hurry(player);
    }

    fn follow(&mut self, player: Player, session: SessionId, last: Option<Report>) {
        let station = self.station(player);
        // Who takes part says no farewell.
        (station.part, station.farewell) = (Part::Follows { session, last }, None);
        self.hurry(player);
    }

    fn answer_or_report(&mut self, play: Play, session: Option<SessionId>) -> Result<bool, Gone> {
        let [ada, bo] = self.terms.players;
        let newest = self.exchange.commands().rfind(|(_, it)| it.to == ada);
        let (Some((_, command)), Some(session)) = (newest, session) else {
            return Ok(false);
        };
        if command.session != session {
            return Ok(false);
        }
        let accepted = Answer {
            from: ada,
            session,
            request: command.request,
            verdict: Verdict::Accepted,
        };
        let other = |by: i16| RequestId((i16::from(command.request.0) + by).rem_euclid(256) as u8);
        let (player, answers) = match play {
            Play::Ack => (Player::Ada, vec![accepted; 3]),
            Play::Reject => {
                let verdict = Verdict::Rejected(Rejection::UnsupportedTask);
                (
                    Player::Ada,
                    vec![
                        Answer {
                            verdict,
                            ..accepted
                        };
                        3
                    ],
                )
            }
            Play::AckOther => {
                let of = |by| Answer {
                    request: other(by),
                    ..accepted
                };
                (Player::Ada, vec![of(-1), of(1), of(-1), of(1)])
            }
            Play::AckElsewhere => {
                let session = SessionId {
                    number: other_number(session.number),
                    ..session
                };
                (
                    Player::Ada,
                    vec![
                        Answer {
                            session,
                            ..accepted
                        };
                        3
                    ],
                )
            }
            Play::BoAcks => (
                Player::Bo,
                vec![
                    Answer {
                        from: bo,
                        ..accepted
                    };
                    3
                ],
            ),
            _ => {
                let (request, progress) = match play {
                    Play::ReportExecuting => (command.request, Progress::Executing),
                    Play::ReportInPosition => (command.request, Progress::InPosition),
                    Play::ReportCompleted => (command.request, Progress::Completed),
                    Play::ReportFailed => (command.request, Progress::Failed(Failure::Maneuver)),
                    Play::ReportOther => (other(-1), Progress::Completed),
                    _ => return Ok(false),
                };
                self.follow(Player::Ada, session, Some(Report { request, progress }));
                return Ok(true);
            }
        };
        for answer in answers {
            self.send_answer(player, answer)?;
            self.pass(APART_MS)?;
        }
        Ok(true)
    }

    /// Octets that are no packet, a packet that is cut off, and one whose message is none.
    fn make_noise(&mut self) -> Result<Performed, Gone> {
        let packet = self.packet_of(&[0xFF; 40])?;
        self.send_noise("octets that are no packet", &[0x5A; 64])?;
        self.send_noise("a packet that is cut off", &packet[..packet.len() / 2])?;
        self.send_noise("a packet without a message", &packet)?;
        self.send_noise("an empty datagram", &[])?;
        Ok(Performed::Yes)
    }

    /// A RAM under the robot's own name, which ends and leads.
    fn speak_as_the_robot(&mut self) -> Result<Performed, Gone> {
        let robot = self.exchange.robot;
        let Some(said) = self.said() else {
            return Ok(Performed::OutOfPlace);
        };
        let number = session_of(&said.ram).map_or(
            SessionNumber(UniqueNumber { boot: 1, count: 0 }),
            |session| session.number,
        );
        let ram = Ram {
            station: robot,
            coordination: Coordination::None,
            farewell: Some(Farewell::Ended(number, Ending::Completed)),
            on_duty: false,
        };
        for _ in 0..3 {
            self.send_ram(Player::Ada, ram)?;
            self.pass(APART_MS)?;
        }
        Ok(Performed::Yes)
    }
}

/// Another number of the same station, one that it has not given out.
fn other_number(number: SessionNumber) -> SessionNumber {
    SessionNumber(UniqueNumber {
        count: number.0.count ^ 0x4000,
        ..number.0
    })
}

impl<S: Subject> Bench<S> {
    /// What tells this situation from others: what the robot says, what the tester's stations do, and what is
    /// outstanding between them.
    pub(crate) fn key(&self) -> String {
        let mut key = self.essence().unwrap_or_default();
        // Names of sessions differ, and make no difference.
        key.retain(|c| !c.is_ascii_digit());
        for station in &self.stations {
            let part = match station.part {
                Part::Nothing => "nothing",
                Part::SaysNothing => "says nothing",
                Part::Asks { .. } => "asks",
                Part::Leads { .. } => "leads",
                Part::Offers { .. } => "offers",
                Part::Follows { last: None, .. } => "follows",
                Part::Follows {
                    last: Some(last), ..
                } => crate::words::progress(last.progress),
            };
            let beating = if station.speaks() {
                station.beating
            } else {
                Beating::Mute
            };
            key.push_str(&format!(" | {part} {beating:?}"));
        }
        let newest = self.exchange.commands().next_back();
        let outstanding = newest.map(|(_, command)| {
            let mut answers = self.exchange.played_answers();
            let is_answered = answers.any(|(_, it)| it.request == command.request);
            format!("{} {is_answered}", command.task)
        });
        let ordered = self.command.map(|command| command.task);
        let count = newest.map_or(0, |(_, command)| command.request.0.min(1));
        key.push_str(&format!(" | {outstanding:?} {count} {ordered:?}"));
        key
    }
}
