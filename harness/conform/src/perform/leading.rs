//! The tester leads the robot.

use crossguard_protocol::{
    Command, Confirmation, Ending, Farewell, Followers, OfferNumber, Place, RequestId, SessionId,
    SessionNumber, TaskType, UniqueNumber, Urgency,
};

use crate::bench::{APART_MS, Bench};
use crate::exchange::{Player, offer_of};
use crate::play::Play;
use crate::station::{Beating, Part, UNSUPPORTED, other_number};
use crate::subject::{Gone, Subject};

impl<S: Subject> Bench<S> {
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
    pub(super) fn begin_as_leader(&mut self, play: Play) -> Result<bool, Gone> {
        let (robot, bo) = (self.exchange.robot, self.terms.players[1]);
        let session = self.station(Player::Ada).own_session();
        let offered = self.said().and_then(|said| offer_of(&said.ram));
        let offered = offered.filter(|(to, _)| Some(*to) == session);
        let leads = matches!(self.station(Player::Ada).part, Part::Leads { .. });
        let nobody = Confirmation {
            station: bo,
            offer: OfferNumber(UniqueNumber { boot: 1, count: 0 }),
        };
        Ok(match (play, session, offered) {
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
            (_, Some(session), _) if play.commands() && leads => self.command(play, session)?,
            _ => false,
        })
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
}
