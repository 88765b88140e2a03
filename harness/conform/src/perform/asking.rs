//! The tester asks for help, or competes with the robot.

use crossguard_protocol::{
    Confirmation, Coordination, HelpRequest, OfferNumber, Place, SessionNumber, StationId, TaskSet,
    UniqueNumber, Urgency,
};

use crate::bench::Bench;
use crate::exchange::Player;
use crate::play::Play;
use crate::station::{Beating, Part, UNSUPPORTED};
use crate::subject::Subject;

impl<S: Subject> Bench<S> {
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
    pub(super) fn begin_as_requester(&mut self, play: Play) -> bool {
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
        match play {
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
            _ => false,
        }
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
