//! Who may still answer a request for help.
//!
//! A requester gathers offers for `t_select`. It need not wait that long when every robot that it has heard
//! lately has answered: with an offer to this session, or by having a part in another one.

use std::collections::BTreeMap;

use crossguard_protocol::{Coordination, Phase, Ram, Robot, SessionId, StationId};

/// For how long a robot that was heard is taken to be nearby, in ms: in a request every robot nearby is heard
/// at least once a second.
const NEARBY_MS: u64 = 1_000;

/// The longest list; with more robots around, the requester waits.
const ROBOTS_MAX: usize = 64;

/// What the newest RAM of each robot nearby says of its part.
#[derive(Clone, Debug, Default)]
pub(super) struct Answers {
    robots: BTreeMap<StationId, Answer>,
}

#[derive(Clone, Copy, Debug)]
struct Answer {
    heard_ms: u64,
    /// The session that it has a part in.
    session: Option<SessionId>,
    on_duty: bool,
}

impl Answers {
    /// A RAM was heard at `now_ms`.
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
            // Who asks for help itself may withdraw, and help then.
            Coordination::None | Coordination::NeedHelp { .. } => None,
            Coordination::Leader { number, .. } => Some(own(number)),
            Coordination::OfferHelp { session, .. } | Coordination::Follower { session, .. } => {
                Some(session)
            }
        };
        let answer = Answer {
            heard_ms: now_ms,
            session,
            on_duty: ram.on_duty,
        };
        self.robots.insert(ram.station, answer);
    }

    /// Whether `robot` asks for help, has enough offers, and no other offer can come.
    pub(super) fn are_all_in(&self, now_ms: u64, robot: &Robot) -> bool {
        let Phase::Requesting(requesting) = robot.phase() else {
            return false;
        };
        let is_nearby = |answer: &&Answer| now_ms.saturating_sub(answer.heard_ms) <= NEARBY_MS;
        let mut nearby = self.robots.values().filter(is_nearby);
        requesting.offers.len() >= usize::from(requesting.request.followers)
            && self.robots.len() < ROBOTS_MAX
            && nearby.all(|answer| answer.session.is_some() || answer.on_duty)
    }
}
