//! Messages and events of one case, sent, heard and told, in order: all that a verdict may look at.

use std::ops::RangeBounds;

use crossguard_codec::{PublicSignal, Service};
use crossguard_protocol::{
    Answer, Availability, Command, Coordination, Farewell, Heartbeat, OfferNumber, Ram, Report,
    Rmcm, SessionId, SessionNumber, StationId,
};

use crate::subject::Local;
use crate::words;

/// One of the tester's two stations.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Player {
    /// The one that plays the counterpart.
    Ada,
    /// The other one: a rival, a stranger, a second follower.
    Bo,
}

impl Player {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Ada, Self::Bo];

    /// Its name in charts.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ada => "Ada",
            Self::Bo => "Bo",
        }
    }
}

/// A RAM, as far as rules are about it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct RamSeen {
    /// Its part on coordination.
    pub ram: Ram,
    /// Whether its sender takes part.
    pub availability: Availability,
    /// Its sender's sign to pedestrians, where it says one.
    pub sign: Option<PublicSignal>,
    /// How fast its sender moves, in m/s, where it says so.
    pub speed_mps: Option<f64>,
}

/// A body that moves faster than this is under way, in m/s.
const MOVES_MPS: f64 = 0.5;

impl RamSeen {
    /// A RAM of a station that takes part, and says nothing of a sign and of its speed.
    pub(crate) const fn of(ram: Ram) -> Self {
        Self {
            ram,
            availability: Availability::Available,
            sign: None,
            speed_mps: None,
        }
    }

    /// The session that it has a part in, its own included.
    pub(crate) const fn session(&self) -> Option<SessionId> {
        match self.ram.coordination {
            Coordination::None => None,
            Coordination::NeedHelp { number, .. } | Coordination::Leader { number, .. } => {
                Some(SessionId::of(self.ram.station, number))
            }
            Coordination::OfferHelp { session, .. } | Coordination::Follower { session, .. } => {
                Some(session)
            }
        }
    }

    /// The number of its own session, if it asks for help or leads.
    pub(crate) fn own_number(&self) -> Option<SessionNumber> {
        self.heartbeat().and(self.session()).map(|own| own.number)
    }

    /// The heartbeat of a requester or leader.
    pub(crate) const fn heartbeat(&self) -> Option<Heartbeat> {
        match self.ram.coordination {
            Coordination::NeedHelp { heartbeat, .. } | Coordination::Leader { heartbeat, .. } => {
                Some(heartbeat)
            }
            _ => None,
        }
    }

    pub(crate) const fn asks(&self) -> bool {
        matches!(self.ram.coordination, Coordination::NeedHelp { .. })
    }

    pub(crate) const fn leads(&self) -> bool {
        matches!(self.ram.coordination, Coordination::Leader { .. })
    }

    /// The followers that it lists as a leader, each with the offer that it confirms.
    pub(crate) fn listed(&self) -> Vec<(StationId, OfferNumber)> {
        match self.ram.coordination {
            Coordination::Leader { followers, .. } => {
                followers.iter().map(|it| (it.station, it.offer)).collect()
            }
            _ => Vec::new(),
        }
    }

    pub(crate) fn lists(&self, station: StationId) -> bool {
        self.listed().iter().any(|(listed, _)| *listed == station)
    }

    pub(crate) const fn offer(&self) -> Option<(SessionId, OfferNumber)> {
        match self.ram.coordination {
            Coordination::OfferHelp { session, offer, .. } => Some((session, offer)),
            _ => None,
        }
    }

    pub(crate) fn offers_to(&self, session: SessionId) -> bool {
        self.offer().is_some_and(|(to, _)| to == session)
    }

    /// The session that it follows in, and what it reports.
    pub(crate) const fn following(&self) -> Option<(SessionId, Option<Report>)> {
        match self.ram.coordination {
            Coordination::Follower { session, last, .. } => Some((session, last)),
            _ => None,
        }
    }

    pub(crate) fn follows(&self, session: SessionId) -> bool {
        self.following().is_some_and(|(now, _)| now == session)
    }

    /// The session that it follows in, while it executes a command or holds its place.
    pub(crate) fn executes(&self) -> Option<SessionId> {
        let (session, last) = self.following()?;
        last?.progress.is_running().then_some(session)
    }

    /// The session of a helper or follower, and the heartbeat that it echoes.
    pub(crate) const fn echo(&self) -> Option<(SessionId, Heartbeat)> {
        match self.ram.coordination {
            Coordination::OfferHelp { session, echo, .. }
            | Coordination::Follower { session, echo, .. } => Some((session, echo)),
            _ => None,
        }
    }

    pub(crate) fn is_available(&self) -> bool {
        self.availability == Availability::Available
    }

    /// Whether its sender takes part, and has no part and no duty.
    pub(crate) fn is_free(&self) -> bool {
        self.ram.coordination == Coordination::None && !self.ram.on_duty && self.is_available()
    }

    pub(crate) fn names_as_ended(&self, number: SessionNumber) -> bool {
        matches!(self.ram.farewell, Some(Farewell::Ended(ended, _)) if ended == number)
    }

    pub(crate) fn names_as_left(&self, session: SessionId) -> bool {
        matches!(self.ram.farewell, Some(Farewell::Left(left, _)) if left == session)
    }

    pub(crate) fn shows_go(&self) -> bool {
        self.sign == Some(PublicSignal::Go)
    }

    pub(crate) fn moves(&self) -> bool {
        self.speed_mps.is_some_and(|speed| speed > MOVES_MPS)
    }

    /// Whether its body stands; not so where it does not say its speed.
    pub(crate) fn stands(&self) -> bool {
        let speed = self.speed_mps;
        speed.is_some_and(|speed| speed.abs() <= MOVES_MPS)
    }
}

/// Content of a message.
#[derive(Clone, Copy, PartialEq, Debug)]
#[allow(clippy::large_enum_variant, reason = "most of them are RAM")]
pub enum Message {
    /// A RAM.
    Ram(RamSeen),
    /// A command, or an answer to one.
    Rmcm(Rmcm),
}

impl From<RamSeen> for Message {
    fn from(ram: RamSeen) -> Self {
        Self::Ram(ram)
    }
}

impl From<Rmcm> for Message {
    fn from(rmcm: Rmcm) -> Self {
        Self::Rmcm(rmcm)
    }
}

impl Message {
    pub(crate) const fn service(&self) -> Service {
        match self {
            Self::Ram(_) => Service::Ram,
            Self::Rmcm(_) => Service::Rmcm,
        }
    }

    pub(crate) const fn ram(&self) -> Option<&RamSeen> {
        match self {
            Self::Ram(ram) => Some(ram),
            Self::Rmcm(_) => None,
        }
    }

    pub(crate) const fn command(&self) -> Option<Command> {
        match self {
            Self::Rmcm(Rmcm::Command(command)) => Some(*command),
            _ => None,
        }
    }

    pub(crate) const fn answer(&self) -> Option<Answer> {
        match self {
            Self::Rmcm(Rmcm::Answer(answer)) => Some(*answer),
            _ => None,
        }
    }
}

/// Something that happened.
#[derive(Clone, PartialEq, Debug)]
#[allow(clippy::large_enum_variant, reason = "most of them are messages")]
pub enum Happening {
    /// The tester begins the next thing that it does.
    Play(&'static str),
    /// The robot under test said this.
    Said(Message),
    /// A station of the tester said this.
    Played(Player, Message),
    /// A packet that means nothing was sent to the robot.
    Noise(&'static str),
    /// This was told to the robot, by somebody at its side.
    Told(Local),
    /// The robot lost power and was started again.
    Restarted,
}

/// Something that happened, and when.
#[derive(Clone, PartialEq, Debug)]
pub struct Seen {
    /// When, in ms on the tester's clock. A message of the robot counts from its arrival.
    pub at_ms: u64,
    /// What.
    pub what: Happening,
    /// The message, for the chart.
    pub octets: Vec<u8>,
}

/// All of one case.
#[derive(Clone, Debug)]
pub struct Exchange {
    /// The robot under test.
    pub robot: StationId,
    /// The tester's stations, in the order of [`Player::ALL`].
    pub players: [StationId; 2],
    /// The messages and events, in order.
    pub seen: Vec<Seen>,
    /// Until when the tester listened.
    pub ended_ms: u64,
}

impl Exchange {
    /// The messages of the robot under test, in order.
    pub(crate) fn said(&self) -> impl DoubleEndedIterator<Item = (u64, &Message)> {
        self.seen.iter().filter_map(|seen| match &seen.what {
            Happening::Said(message) => Some((seen.at_ms, message)),
            _ => None,
        })
    }

    /// The messages of the tester's stations, in order.
    fn played(&self) -> impl DoubleEndedIterator<Item = (u64, &Message)> {
        self.seen.iter().filter_map(|seen| match &seen.what {
            Happening::Played(_, message) => Some((seen.at_ms, message)),
            _ => None,
        })
    }

    /// The RAM of the robot under test, in order.
    pub(crate) fn rams(&self) -> impl DoubleEndedIterator<Item = (u64, &RamSeen)> {
        self.said().filter_map(|(at, it)| Some((at, it.ram()?)))
    }

    /// The RAM of the tester's stations, in order.
    pub(crate) fn played_rams(&self) -> impl DoubleEndedIterator<Item = (u64, &RamSeen)> {
        self.played().filter_map(|(at, it)| Some((at, it.ram()?)))
    }

    pub(crate) fn commands(&self) -> impl DoubleEndedIterator<Item = (u64, Command)> {
        self.said().filter_map(|(at, it)| Some((at, it.command()?)))
    }

    pub(crate) fn played_commands(&self) -> impl DoubleEndedIterator<Item = (u64, Command)> {
        self.played()
            .filter_map(|(at, it)| Some((at, it.command()?)))
    }

    pub(crate) fn answers(&self) -> impl DoubleEndedIterator<Item = (u64, Answer)> {
        self.said().filter_map(|(at, it)| Some((at, it.answer()?)))
    }

    pub(crate) fn played_answers(&self) -> impl DoubleEndedIterator<Item = (u64, Answer)> {
        self.played()
            .filter_map(|(at, it)| Some((at, it.answer()?)))
    }

    /// Events that were told to the robot.
    pub(crate) fn told(&self) -> impl DoubleEndedIterator<Item = (u64, Local)> {
        self.seen.iter().filter_map(|seen| match seen.what {
            Happening::Told(local) => Some((seen.at_ms, local)),
            _ => None,
        })
    }

    /// When it was started anew.
    pub(crate) fn restarts(&self) -> impl DoubleEndedIterator<Item = u64> {
        let restarts = self.seen.iter();
        restarts.filter_map(|seen| (seen.what == Happening::Restarted).then_some(seen.at_ms))
    }

    /// Whether the robot was told something or started anew at one of these times.
    pub(crate) fn is_disturbed(&self, during: impl RangeBounds<u64>) -> bool {
        let told = self.told().map(|(at, _)| at);
        told.chain(self.restarts()).any(|at| during.contains(&at))
    }

    /// The newest RAM of the robot that had arrived by this time.
    pub(crate) fn state_at(&self, at_ms: u64) -> Option<&RamSeen> {
        Some(self.rams().rfind(|(at, _)| *at <= at_ms)?.1)
    }

    /// The robot's situation by this time, in a few words.
    pub(crate) fn situation_at(&self, at_ms: u64) -> String {
        let Some(seen) = self.state_at(at_ms) else {
            return "unheard".to_owned();
        };
        let mut text = words::part(&seen.ram.coordination).to_owned();
        if seen.ram.on_duty {
            text.push_str(", on duty");
        }
        if !seen.is_available() {
            text.push_str(", unavailable");
        }
        text
    }

    /// Until when what the tester did at `at_ms` may be judged: neither the tester nor anybody at the robot's side did
    /// anything else, and the tester listened.
    pub(crate) fn undisturbed_until(&self, at_ms: u64) -> u64 {
        let mut plays = self.seen.iter().filter(|seen| {
            matches!(
                seen.what,
                Happening::Play(_) | Happening::Told(_) | Happening::Restarted
            )
        });
        let next = plays.find(|seen| seen.at_ms > at_ms);
        next.map_or(self.ended_ms, |seen| seen.at_ms)
    }
}
