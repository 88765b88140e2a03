//! The tester helps and follows the robot.

use crossguard_protocol::{
    Answer, Coordination, Failure, Farewell, Heartbeat, Millis, OfferNumber, Progress, Rejection,
    Report, RequestId, Rmcm, SessionId, SessionNumber, StationId, TaskSet, UniqueNumber, Verdict,
};

use crate::bench::{APART_MS, Bench};
use crate::exchange::{Player, RamSeen};
use crate::play::Play;
use crate::station::other_number;
use crate::subject::{Gone, Subject};

/// An offer of a robot that can do all that is asked for.
const fn offering(
    session: SessionId,
    offer: OfferNumber,
    echo: Heartbeat,
    t_safety: Millis,
) -> Coordination {
    Coordination::OfferHelp {
        session,
        offer,
        capabilities: TaskSet(0b111),
        echo,
        t_safety,
    }
}

impl<S: Subject> Bench<'_, S> {
    pub(super) fn begin_as_helper(&mut self, play: Play) -> Result<bool, Gone> {
        let Some(said) = self.said().copied() else {
            return Ok(false);
        };
        let robot = self.exchange.robot;
        let session = said.session().filter(|session| session.leader == robot);
        let asks = said.asks();
        let listed = |player: StationId| {
            let mut listed = said.listed().into_iter();
            let found = listed.find(|(station, _)| *station == player);
            found.map(|(_, offer)| offer)
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
                ram.coordination = offering(session, offer, station.echo, t_safety);
                self.send(Player::Ada, RamSeen::of(ram).into())?;
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
                let Some(offer) = listed(id) else {
                    return Ok(false);
                };
                let station = self.station(player);
                station.part = None;
                station.farewell = Some(Farewell::Left(session, offer));
                self.hurry(player);
            }
            (Play::BoIntrudes, Some(session)) if listed(bo).is_none() => {
                self.follow(Player::Bo, session, None);
            }
            (Play::BoClaims, _) => {
                // The newest session of the robot that is over, or one that it never opened.
                let sessions: Vec<SessionId> = self
                    .exchange
                    .rams()
                    .filter_map(|(_, it)| it.session())
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
        station.part = Some(offering(session, offer, station.echo, t_safety));
        self.hurry(player);
    }

    fn follow(&mut self, player: Player, session: SessionId, last: Option<Report>) {
        let station = self.station(player);
        // A station that takes part says no farewell.
        station.farewell = None;
        station.part = Some(Coordination::Follower {
            session,
            echo: station.echo,
            last,
        });
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
        let mut answer = Answer {
            from: ada,
            session,
            request: command.request,
            verdict: Verdict::Accepted,
        };
        let other = |by: i8| RequestId(command.request.0.wrapping_add_signed(by));
        let (mut player, mut requests) = (Player::Ada, vec![command.request; 3]);
        match play {
            Play::Ack => {}
            Play::Reject => answer.verdict = Verdict::Rejected(Rejection::UnsupportedTask),
            Play::AckOther => requests = [-1, 1, -1, 1].map(other).to_vec(),
            Play::AckElsewhere => answer.session.number = other_number(session.number),
            Play::BoAcks => (player, answer.from) = (Player::Bo, bo),
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
        }
        for request in requests {
            self.send(player, Rmcm::Answer(Answer { request, ..answer }).into())?;
            self.pass(APART_MS)?;
        }
        Ok(true)
    }
}
