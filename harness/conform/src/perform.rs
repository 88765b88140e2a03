//! How the tester does what a case says.

mod asking;
mod helping;
mod leading;

use crossguard_protocol::{
    Coordination, Ending, Farewell, Progress, Ram, SessionNumber, UniqueNumber,
};

use crate::bench::{APART_MS, Bench};
use crate::exchange::{Happening, Player, RamSeen};
use crate::play::{Play, Side};
use crate::subject::{Gone, Subject};
use crate::words;

/// How long a robot that does things by itself is waited for, in ms.
const AWAITED_MS: u64 = 6_000;

impl<S: Subject> Bench<'_, S> {
    /// Does it, and listens to what comes of it. Returns `false` where the robot's situation is not one for it.
    pub(crate) fn perform(&mut self, play: Play, is_last: bool) -> Result<bool, Gone> {
        let begun = self.exchange.seen.len();
        self.note(Happening::Play(play.words()));
        if !self.begin(play)? {
            self.exchange.seen.truncate(begun);
            return Ok(false);
        }
        let soon_ms = self.terms.soon_ms();
        if let Some(span_ms) = play.span_ms(&self.terms) {
            self.pass(span_ms)?;
        } else if is_last || play == Play::Restart {
            self.pass(soon_ms + self.terms.ms(|s| s.t_ack) + 150)?;
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
        Ok(true)
    }

    /// The robot's newest RAM in words, without the parts that change with every RAM.
    fn essence(&self) -> Option<String> {
        let said = self.said()?;
        let part = words::part(&said.ram.coordination);
        let list = said.listed().len();
        let (farewell, duty) = (said.ram.farewell, said.ram.on_duty);
        let session = said.session();
        let (sign, available) = (said.sign, said.availability);
        Some(format!(
            "{part} {session:?} {list} {farewell:?} {duty} {sign:?} {available:?}"
        ))
    }

    fn begin(&mut self, play: Play) -> Result<bool, Gone> {
        if let Some(local) = play.local(self.terms.players[0]) {
            if !self.can_be_told(play) {
                return Ok(false);
            }
            let before = self.essence();
            if self.tell(local) {
                let has_changed = |bench: &Self| bench.essence() != before;
                self.pass_until(AWAITED_MS, has_changed)?;
            }
            return Ok(true);
        }
        Ok(match play {
            Play::Wait(_) => true,
            Play::Noise => {
                self.make_noise()?;
                true
            }
            Play::OwnName => self.speak_as_the_robot()?,
            Play::Restart => {
                self.restart();
                true
            }
            Play::Beat(beating) => {
                let ada = self.station(Player::Ada);
                let fits = ada.part.is_some() && ada.beating != beating;
                ada.beating = beating;
                fits
            }
            _ => match play.side() {
                Side::Asks => self.begin_as_requester(play),
                Side::Leads | Side::Commands => self.begin_as_leader(play)?,
                _ => self.begin_as_helper(play)?,
            },
        })
    }

    /// Whether such a thing can happen at the robot, by what it says of itself.
    fn can_be_told(&self, play: Play) -> bool {
        let Some(said) = self.said() else {
            return false;
        };
        let part = said.ram.coordination;
        let leads = said.leads();
        let executes = |progress: Progress| match part {
            Coordination::Follower {
                last: Some(report), ..
            } => report.progress == progress,
            _ => false,
        };
        let is_available = said.is_available();
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
            Play::TaskCompleted => leads || said.asks(),
            Play::Leave => part != Coordination::None,
            Play::LowBattery | Play::LocalFault => is_available,
            Play::Available => !is_available,
            _ => true,
        }
    }

    /// Octets that are no packet, a packet that is cut off, and one whose message is none.
    fn make_noise(&mut self) -> Result<(), Gone> {
        let packet = self.packet_of(&[0xFF; 40])?;
        self.send_noise("octets that are no packet", &[0x5A; 64])?;
        self.send_noise("a packet that is cut off", &packet[..packet.len() / 2])?;
        self.send_noise("a packet without a message", &packet)?;
        self.send_noise("an empty datagram", &[])
    }

    /// A RAM under the robot's own name, which ends and leads.
    fn speak_as_the_robot(&mut self) -> Result<bool, Gone> {
        let robot = self.exchange.robot;
        let Some(said) = self.said() else {
            return Ok(false);
        };
        let number = said.session().map_or(
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
            self.send(Player::Ada, RamSeen::of(ram).into())?;
            self.pass(APART_MS)?;
        }
        Ok(true)
    }
}
