//! What was sent, heard and told in one case, in order: all that a verdict may look at.

use crossguard_codec::PublicSignal;
use crossguard_protocol::{
    Answer, Availability, Command, Coordination, OfferNumber, Ram, Report, SessionId,
    SessionNumber, StationId,
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
    /// What it says of coordination.
    pub ram: Ram,
    /// Whether its sender takes part.
    pub availability: Availability,
    /// What its sender shows to pedestrians, where it says so.
    pub sign: Option<PublicSignal>,
    /// How fast its sender moves, in m/s, where it says so.
    pub speed_mps: Option<f64>,
}

/// What a message says.
#[derive(Clone, Copy, PartialEq, Debug)]
#[allow(clippy::large_enum_variant, reason = "most of them are RAM")]
pub enum Message {
    /// A RAM.
    Ram(RamSeen),
    /// A command.
    Command(Command),
    /// An answer to a command.
    Answer(Answer),
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
    /// What happened, in order.
    pub seen: Vec<Seen>,
    /// Until when the tester listened.
    pub ended_ms: u64,
}

/// A RAM of the robot under test, and when it arrived.
pub(crate) type Said<'a> = (u64, &'a RamSeen);

impl Exchange {
    /// The RAM of the robot under test, in order.
    pub(crate) fn rams(&self) -> impl DoubleEndedIterator<Item = Said<'_>> {
        self.seen.iter().filter_map(|seen| match &seen.what {
            Happening::Said(Message::Ram(ram)) => Some((seen.at_ms, ram)),
            _ => None,
        })
    }

    /// The RAM of the tester's stations, in order.
    pub(crate) fn played_rams(&self) -> impl DoubleEndedIterator<Item = (u64, Player, &RamSeen)> {
        self.seen.iter().filter_map(|seen| match &seen.what {
            Happening::Played(player, Message::Ram(ram)) => Some((seen.at_ms, *player, ram)),
            _ => None,
        })
    }

    /// The commands of the robot under test.
    pub(crate) fn commands(&self) -> impl DoubleEndedIterator<Item = (u64, Command)> {
        self.seen.iter().filter_map(|seen| match seen.what {
            Happening::Said(Message::Command(command)) => Some((seen.at_ms, command)),
            _ => None,
        })
    }

    /// The commands of the tester's stations.
    pub(crate) fn played_commands(&self) -> impl DoubleEndedIterator<Item = (u64, Command)> {
        self.seen.iter().filter_map(|seen| match seen.what {
            Happening::Played(_, Message::Command(command)) => Some((seen.at_ms, command)),
            _ => None,
        })
    }

    /// The answers of the robot under test.
    pub(crate) fn answers(&self) -> impl DoubleEndedIterator<Item = (u64, Answer)> {
        self.seen.iter().filter_map(|seen| match seen.what {
            Happening::Said(Message::Answer(answer)) => Some((seen.at_ms, answer)),
            _ => None,
        })
    }

    /// The answers of the tester's stations.
    pub(crate) fn played_answers(&self) -> impl DoubleEndedIterator<Item = (u64, Answer)> {
        self.seen.iter().filter_map(|seen| match seen.what {
            Happening::Played(_, Message::Answer(answer)) => Some((seen.at_ms, answer)),
            _ => None,
        })
    }

    /// What was told to the robot.
    pub(crate) fn told(&self) -> impl DoubleEndedIterator<Item = (u64, Local)> {
        self.seen.iter().filter_map(|seen| match seen.what {
            Happening::Told(local) => Some((seen.at_ms, local)),
            _ => None,
        })
    }

    /// When it was started anew.
    pub(crate) fn restarts(&self) -> impl DoubleEndedIterator<Item = u64> {
        self.seen.iter().filter_map(|seen| match seen.what {
            Happening::Restarted => Some(seen.at_ms),
            _ => None,
        })
    }

    /// The newest RAM of the robot that had arrived by this time.
    pub(crate) fn state_at(&self, at_ms: u64) -> Option<Said<'_>> {
        self.rams().rfind(|(at, _)| *at <= at_ms)
    }

    /// The robot's situation by this time, in a few words.
    pub(crate) fn situation_at(&self, at_ms: u64) -> String {
        let Some((_, seen)) = self.state_at(at_ms) else {
            return "unheard".to_owned();
        };
        let mut text = words::part(&seen.ram.coordination).to_owned();
        if seen.ram.on_duty {
            text.push_str(", on duty");
        }
        if seen.availability != Availability::Available {
            text.push_str(", unavailable");
        }
        text
    }

    /// When the tester, or somebody at the robot's side, next does something else after this time.
    pub(crate) fn next_play(&self, after_ms: u64) -> Option<u64> {
        let mut plays = self.seen.iter().filter(|seen| {
            matches!(
                seen.what,
                Happening::Play(_) | Happening::Told(_) | Happening::Restarted
            )
        });
        plays
            .find(|seen| seen.at_ms > after_ms)
            .map(|seen| seen.at_ms)
    }

    /// Until when what the tester did at `at_ms` may be judged: nothing else was done, and the tester listened.
    pub(crate) fn undisturbed_until(&self, at_ms: u64) -> u64 {
        self.next_play(at_ms).unwrap_or(self.ended_ms)
    }
}

/// The session that a RAM has a part in, its own included.
pub(crate) fn session_of(ram: &Ram) -> Option<SessionId> {
    let own = |number: SessionNumber| SessionId {
        leader: ram.station,
        number,
    };
    match ram.coordination {
        Coordination::None => None,
        Coordination::NeedHelp { number, .. } | Coordination::Leader { number, .. } => {
            Some(own(number))
        }
        Coordination::OfferHelp { session, .. } | Coordination::Follower { session, .. } => {
            Some(session)
        }
    }
}

/// The offer that a RAM makes.
pub(crate) const fn offer_of(ram: &Ram) -> Option<(SessionId, OfferNumber)> {
    match ram.coordination {
        Coordination::OfferHelp { session, offer, .. } => Some((session, offer)),
        _ => None,
    }
}

/// The session that a RAM follows in, and what it reports.
pub(crate) const fn following(ram: &Ram) -> Option<(SessionId, Option<Report>)> {
    match ram.coordination {
        Coordination::Follower { session, last, .. } => Some((session, last)),
        _ => None,
    }
}
