//! The tester asks for help, or competes with the robot.

use crossguard_protocol::{
    Confirmation, Coordination, HelpRequest, OfferNumber, Place, SessionNumber, StationId, TaskSet,
    UniqueNumber, Urgency,
};

use crate::bench::Bench;
use crate::exchange::Player;
use crate::play::Play;
use crate::station::{Beating, UNSUPPORTED};
use crate::subject::Subject;

impl<S: Subject> Bench<'_, S> {
    fn asks(&mut self, player: Player, tasks: TaskSet, urgency: Urgency, place: Place) {
        let number = SessionNumber(self.station(player).issue());
        let request = HelpRequest {
            urgency,
            followers: 1,
            tasks,
            place,
        };
        let station = self.station(player);
        station.part = Some(Coordination::NeedHelp {
            number,
            heartbeat: station.heartbeat,
            request,
        });
        (station.farewell, station.beating) = (None, Beating::Newer);
    }

    /// Bo leads somebody who is not there.
    fn leads_nobody(&mut self, urgency: Urgency, place: Place) {
        let number = SessionNumber(self.station(Player::Bo).issue());
        let somebody = Confirmation {
            station: StationId(77),
            offer: OfferNumber(UniqueNumber { boot: 1, count: 0 }),
        };
        let bo = self.station(Player::Bo);
        bo.part = Some(Coordination::Leader {
            number,
            heartbeat: bo.heartbeat,
            followers: [somebody].into_iter().collect(),
            urgency,
            place,
            yields: false,
        });
    }

    pub(super) fn begin_as_requester(&mut self, play: Play) -> bool {
        let player = match play {
            Play::Ask | Play::AskForUnsupported => Player::Ada,
            _ => Player::Bo,
        };
        let competes = self.said().is_some_and(|said| said.asks() || said.leads());
        let part = self.station(player).part;
        let is_free = part.is_none_or(|part| part == Coordination::None);
        if !is_free {
            return false;
        }
        let (tasks, nowhere, here) = (TaskSet(0b111), Place::UNKNOWN, self.place_of_robot());
        let unsupported = TaskSet(1 << UNSUPPORTED);
        match play {
            Play::Ask => self.asks(player, tasks, Urgency::Medium, nowhere),
            Play::AskForUnsupported => self.asks(player, unsupported, Urgency::Medium, nowhere),
            Play::BoAsks => self.asks(player, tasks, Urgency::High, nowhere),
            Play::BoSpeaks => self.station(player).part = Some(Coordination::None),
            _ if !competes => return false,
            Play::BoAsksFirst | Play::BoAsksFirstOnce => {
                self.asks(player, tasks, Urgency::Emergency, here);
            }
            Play::BoAsksLater => self.asks(player, tasks, Urgency::Low, here),
            Play::BoLeadsFirst | Play::BoLeadsFirstOnce => {
                self.leads_nobody(Urgency::Emergency, here);
            }
            Play::BoLeadsLater => self.leads_nobody(Urgency::Low, here),
            _ => return false,
        }
        if matches!(play, Play::BoAsksFirstOnce | Play::BoLeadsFirstOnce) {
            self.station(player).beating = Beating::Same;
        }
        self.hurry(player);
        true
    }

    /// The place of the robot's own request or session.
    fn place_of_robot(&self) -> Place {
        match self.said().map(|said| said.ram.coordination) {
            Some(Coordination::NeedHelp { request, .. }) => request.place,
            Some(Coordination::Leader { place, .. }) => place,
            _ => Place::UNKNOWN,
        }
    }
}
