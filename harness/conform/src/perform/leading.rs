//! The tester leads the robot.

use crossguard_protocol::{
    Command, Confirmation, Coordination, Ending, Farewell, OfferNumber, Place, RequestId, Rmcm,
    SessionId, SessionNumber, TaskType, UniqueNumber, Urgency,
};

use crate::bench::{APART_MS, Bench};
use crate::exchange::{Player, RamSeen};
use crate::play::{Play, Side};
use crate::station::{Beating, UNSUPPORTED, other_number};
use crate::subject::{Gone, Subject};

impl<S: Subject> Bench<'_, S> {
    fn lead(&mut self, player: Player, number: SessionNumber, list: Confirmation) {
        let station = self.station(player);
        station.farewell = None;
        station.part = Some(Coordination::Leader {
            number,
            heartbeat: station.heartbeat,
            followers: [list].into_iter().collect(),
            urgency: Urgency::Medium,
            place: Place::UNKNOWN,
            yields: false,
        });
        self.hurry(player);
    }

    fn lead_elsewhere(&mut self, player: Player, list: Confirmation) {
        let number = SessionNumber(self.station(player).issue());
        self.lead(player, number, list);
    }

    pub(super) fn begin_as_leader(&mut self, play: Play) -> Result<bool, Gone> {
        let (station, bo) = (self.exchange.robot, self.terms.players[1]);
        let Some(session) = self.station(Player::Ada).own_session() else {
            return Ok(false);
        };
        let offered = self.said().and_then(RamSeen::offer);
        let offered = offered.filter(|(to, _)| *to == session);
        let offered = offered.map(|(_, offer)| Confirmation { station, offer });
        let part = self.station(Player::Ada).part;
        let leads = matches!(part, Some(Coordination::Leader { .. }));
        let nobody = Confirmation {
            station: bo,
            offer: OfferNumber(UniqueNumber { boot: 1, count: 0 }),
        };
        match (play, offered) {
            (Play::Confirm, Some(list)) => self.lead(Player::Ada, session.number, list),
            (Play::ConfirmOtherOffer, Some(mut list)) => {
                list.offer.0.count += 1;
                self.lead(Player::Ada, session.number, list);
            }
            (Play::ConfirmNobody, Some(_)) => self.lead(Player::Ada, session.number, nobody),
            (Play::ConfirmElsewhere, Some(list)) => self.lead_elsewhere(Player::Ada, list),
            (Play::BoConfirms, Some(list)) => self.lead_elsewhere(Player::Bo, list),
            (Play::Drop, _) if leads => self.lead(Player::Ada, session.number, nobody),
            (Play::EndCompleted | Play::EndAborted, _) => {
                let how = if play == Play::EndCompleted {
                    Ending::Completed
                } else {
                    Ending::Aborted
                };
                let ada = self.station(Player::Ada);
                (ada.part, ada.beating) = (None, Beating::Newer);
                ada.farewell = Some(Farewell::Ended(session.number, how));
                self.hurry(Player::Ada);
            }
            (Play::EndElsewhere, _) => {
                let other = other_number(session.number);
                let farewell = Farewell::Ended(other, Ending::Completed);
                self.station(Player::Ada).farewell = Some(farewell);
                self.hurry(Player::Ada);
            }
            (Play::BareNone, _) => {
                self.station(Player::Ada).part = Some(Coordination::None);
                self.hurry(Player::Ada);
            }
            _ if leads && matches!(play.side(), Side::Commands) => {
                return self.command(play, session);
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn command(&mut self, play: Play, session: SessionId) -> Result<bool, Gone> {
        let task = match play {
            Play::CommandBlock => TaskType::BLOCK,
            Play::CommandInitialPos => TaskType::INITIAL_POS,
            Play::CommandUnsupported => TaskType::new(UNSUPPORTED).unwrap_or(TaskType::MOVE),
            _ => TaskType::MOVE,
        };
        let next = Command {
            session,
            to: self.exchange.robot,
            request: self.next_request,
            task,
        };
        let mut command = next;
        match play {
            Play::CommandElsewhere => command.session.number = other_number(session.number),
            Play::CommandToOther => command.to = self.terms.players[1],
            Play::Repeat | Play::Older => {
                let Some(newest) = self.command.filter(|command| command.session == session) else {
                    return Ok(false);
                };
                command = newest;
                if play == Play::Older {
                    command.request = RequestId(newest.request.0.wrapping_sub(5));
                }
            }
            _ => {
                self.next_request = self.next_request.next();
                self.command = Some(next);
            }
        }
        let is_new = command == next && self.command == Some(next);
        let answers = |bench: &Self| {
            let mut answers = bench.exchange.answers();
            answers.any(|(_, it)| it.session == command.session && it.request == command.request)
        };
        for _ in 0..4 {
            self.send(Player::Ada, Rmcm::Command(command).into())?;
            let apart_ms = if is_new { 3 * APART_MS } else { APART_MS };
            if self.pass_until(apart_ms, |bench| is_new && answers(bench))? {
                break;
            }
        }
        Ok(true)
    }
}
