//! Robots that may still answer a request for help.
//!
//! A requester gathers offers for `t_select`. It need not wait that long when every robot that it has heard
//! lately has answered: with an offer to this session, or by having a part in another one.
//!
//! By the same list it waits for `t_select` where somebody leads already: it withdraws once it has heard that leader twice. And a
//! leader that does not yield is found, which may not hear this robot.

use std::collections::BTreeMap;

use crossguard_protocol::{Coordination, Phase, Place, Ram, Robot, SessionId, StationId};

/// For how long a robot that was heard is taken to be nearby, in ms: in a request every robot nearby is heard
/// at least once a second.
const NEARBY_MS: u64 = 1_000;

/// The longest list; with more robots around, the requester waits.
const ROBOTS_MAX: usize = 64;

/// How many RAM of a leader say that it does not yield: it may send two before it has heard two of this robot.
const INSISTS: u8 = 3;

/// Part of each robot nearby, from its newest RAM.
#[derive(Clone, Debug, Default)]
pub(super) struct Answers {
    robots: BTreeMap<StationId, Answer>,
}

#[derive(Clone, Copy, Debug)]
struct Answer {
    heard_ms: u64,
    session: Option<SessionId>,
    on_duty: bool,
    /// Where it leads, and has not yielded.
    leads_at: Option<Place>,
    /// How many of its RAM did not count, because this robot leads at the same place and goes before.
    insists: u8,
}

impl Answers {
    pub(super) fn hear(&mut self, now_ms: u64, ram: &Ram) {
        self.robots
            .retain(|_, answer| now_ms.saturating_sub(answer.heard_ms) <= NEARBY_MS);
        if self.robots.len() >= ROBOTS_MAX && !self.robots.contains_key(&ram.station) {
            return;
        }
        let own = |number| SessionId {
            leader: ram.station,
            number,
        };
        let session = match ram.coordination {
            // A robot that asks for help itself may withdraw, and help then.
            Coordination::None | Coordination::NeedHelp { .. } => None,
            Coordination::Leader { number, .. } => Some(own(number)),
            Coordination::OfferHelp { session, .. } | Coordination::Follower { session, .. } => {
                Some(session)
            }
        };
        let leads_at = match ram.coordination {
            Coordination::Leader {
                place,
                yields: false,
                ..
            } => Some(place),
            _ => None,
        };
        let known = self.robots.get(&ram.station);
        let known = known.filter(|known| known.session == session);
        let answer = Answer {
            heard_ms: now_ms,
            session,
            on_duty: ram.on_duty,
            leads_at,
            insists: known.map_or(0, |known| known.insists),
        };
        self.robots.insert(ram.station, answer);
    }

    /// A RAM of another leader did not count, because this robot leads at the same place and goes before. Whether the other one
    /// should have yielded by now, once for each of its sessions: it does so at the second RAM of this robot that it hears.
    pub(super) fn insists(&mut self, leader: StationId) -> bool {
        let Some(answer) = self.robots.get_mut(&leader) else {
            return false;
        };
        answer.insists = answer.insists.saturating_add(1);
        answer.insists == INSISTS
    }

    /// Whether `robot` asks for help, has enough offers, and no other offer can come, nor a leader at its place.
    pub(super) fn are_all_in(&self, now_ms: u64, robot: &Robot) -> bool {
        let Phase::Requesting(requesting) = robot.phase() else {
            return false;
        };
        let is_nearby = |answer: &&Answer| now_ms.saturating_sub(answer.heard_ms) <= NEARBY_MS;
        let leads_there = |answer: &Answer| {
            let place = answer.leads_at;
            place.is_some_and(|place| place.may_be(requesting.request.place))
        };
        let has_answered = |answer: &Answer| answer.session.is_some() || answer.on_duty;
        let mut nearby = self.robots.values().filter(is_nearby);
        requesting.offers.len() >= usize::from(requesting.request.followers)
            && self.robots.len() < ROBOTS_MAX
            && nearby.all(|answer| has_answered(answer) && !leads_there(answer))
    }
}
