//! A station that the tester plays: its part in a session, and the RAM that say so.

use crossguard_codec::geonet::Stack;
use crossguard_protocol::{
    Coordination, Farewell, Heartbeat, Ram, SessionId, SessionNumber, StationId, UniqueNumber,
};

/// A task that no robot offers.
pub(crate) const UNSUPPORTED: u8 = 9;

/// Course of a station's heartbeats, or of the heartbeats that it echoes.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub enum Beating {
    /// Each RAM has a newer one.
    #[default]
    Newer,
    /// Each RAM repeats the newest one.
    Same,
    /// Each RAM has one that was sent long before, as if it had been delayed.
    Older,
    /// There are no RAM.
    Mute,
}

/// A station that the tester plays.
#[derive(Clone, Debug)]
pub(crate) struct PlayedStation {
    pub(crate) id: StationId,
    pub(crate) stack: Stack,
    /// Its part in a session; heartbeats and echoes are those of the next RAM. `None` if it sends
    /// nothing, but for farewells.
    pub(crate) part: Option<Coordination>,
    pub(crate) beating: Beating,
    /// The newest heartbeat of its own.
    pub(crate) heartbeat: Heartbeat,
    /// The newest heartbeat that it echoes.
    pub(crate) echo: Heartbeat,
    pub(crate) farewell: Option<Farewell>,
    /// When its next RAM is due.
    pub(crate) due_ms: u64,
    /// How far it is from the robot under test, in metres to the north.
    pub(crate) distance_m: f64,
    next_count: u16,
    boot: u16,
}

impl PlayedStation {
    /// A station that has just booted. `boot` is larger than at any boot before.
    pub(crate) fn new(id: StationId, stack: Stack, boot: u16, distance_m: f64) -> Self {
        Self {
            id,
            stack,
            part: None,
            beating: Beating::default(),
            // Not at 0, so that there are older ones.
            heartbeat: Heartbeat(100),
            echo: Heartbeat(0),
            farewell: None,
            due_ms: 0,
            distance_m,
            next_count: 0,
            boot,
        }
    }

    /// A number that it has never given out.
    pub(crate) fn issue(&mut self) -> UniqueNumber {
        let count = self.next_count;
        self.next_count += 1;
        UniqueNumber {
            boot: self.boot,
            count,
        }
    }

    pub(crate) fn own_session(&self) -> Option<SessionId> {
        match self.part? {
            Coordination::NeedHelp { number, .. } | Coordination::Leader { number, .. } => {
                Some(SessionId::of(self.id, number))
            }
            _ => None,
        }
    }

    /// Whether it sends RAM now.
    pub(crate) fn speaks(&self) -> bool {
        let has_part = self.part.is_some() && self.beating != Beating::Mute;
        has_part || self.farewell.is_some()
    }

    /// The next RAM. `newest` is the newest heartbeat that it has heard of the robot under test.
    pub(crate) fn next_ram(&mut self, newest: Option<Heartbeat>) -> Ram {
        if self.beating == Beating::Newer {
            self.heartbeat = self.heartbeat.after(1);
            self.echo = newest.unwrap_or(self.echo);
        }
        let older = |heartbeat: Heartbeat| match self.beating {
            Beating::Older => Heartbeat(heartbeat.0.wrapping_sub(20)),
            _ => heartbeat,
        };
        let (heartbeat, echo) = (older(self.heartbeat), older(self.echo));
        let mut coordination = self.part.unwrap_or(Coordination::None);
        match &mut coordination {
            Coordination::None => {}
            Coordination::NeedHelp { heartbeat: it, .. }
            | Coordination::Leader { heartbeat: it, .. } => *it = heartbeat,
            Coordination::OfferHelp { echo: it, .. } | Coordination::Follower { echo: it, .. } => {
                *it = echo;
            }
        }
        Ram {
            station: self.id,
            coordination,
            farewell: self.farewell,
            on_duty: false,
        }
    }
}

/// Another number of the same station, one that it has not given out.
pub(crate) fn other_number(number: SessionNumber) -> SessionNumber {
    SessionNumber(UniqueNumber {
        count: number.0.count ^ 0x4000,
        ..number.0
    })
}
