//! Two requesters, or two leaders, at one place.

use crossguard_protocol::{Coordination, Heartbeat, Place, SessionId, Urgency};

use super::lead::sent;
use super::{Met, Trace, first_of_each, met_when, news};
use crate::exchange::RamSeen;

statements! {
    "who-goes-before-is-given-way" "R6" gives_way:
        "A requester or leader gives way at the second message of those before it at the same place.";
    "who-does-not-beat-is-not-given-way" "R6" insists_against_silence:
        "A rival that is heard alone, and whose heartbeat does not grow, may be a late message, and is not given way.";
    "who-goes-behind-is-not-given-way" "R6" insists_against_later:
        "A requester or leader does not give way to a rival of the same kind that goes behind.";
}

/// Claim of a rival: how urgent, where, and whether by leading already.
#[derive(Clone, Copy)]
struct Claim {
    session: SessionId,
    urgency: Urgency,
    place: Place,
    leads: bool,
    heartbeat: Heartbeat,
}

fn claim_of(state: &RamSeen) -> Option<Claim> {
    let (urgency, place) = match state.ram.coordination {
        Coordination::NeedHelp { request, .. } => (request.urgency, request.place),
        Coordination::Leader {
            urgency,
            place,
            yields: false,
            ..
        } => (urgency, place),
        _ => return None,
    };
    Some(Claim {
        session: state.session()?,
        urgency,
        place,
        leads: state.leads(),
        heartbeat: state.heartbeat()?,
    })
}

impl Claim {
    fn is_at_the_place_of(self, other: Self) -> bool {
        self.place == other.place || self.place == Place::UNKNOWN || other.place == Place::UNKNOWN
    }

    /// A rival of the same kind goes before by its urgency, and then by the lower station id. A requester gives way
    /// to everybody who leads already. `None` where neither gives way for that.
    fn goes_before(self, own: Self) -> Option<bool> {
        match (self.leads, own.leads) {
            (true, false) => Some(true),
            // A leader that hears a request: the request gives way by itself, unless it is more urgent.
            (false, true) => None,
            _ => Some(
                self.urgency > own.urgency
                    || (self.urgency == own.urgency && self.session.leader < own.session.leader),
            ),
        }
    }
}

/// A rival's claims against that of the robot when it was heard first.
struct Rivalry {
    own: Claim,
    rival: Claim,
    /// When the heartbeats were played that were newer than all before.
    beats: Vec<u64>,
    first_ms: u64,
}

fn rivalries(trace: &Trace) -> impl Iterator<Item = Rivalry> {
    let heard = trace.played_rams().filter_map(move |(at, played)| {
        let (rival, own) = (claim_of(played)?, claim_of(trace.state_at(at)?)?);
        let is_between_them =
            own.session.leader == trace.robot && played.ram.station != trace.robot;
        (is_between_them && rival.is_at_the_place_of(own)).then_some((at, rival, own))
    });
    let first = first_of_each(heard, |(_, rival, _)| rival.session);
    first.map(move |(at, rival, own)| {
        let claims = trace.played_rams().filter_map(|(at, played)| {
            let claim = claim_of(played)?;
            (claim.session == rival.session).then_some((at, claim.heartbeat))
        });
        Rivalry {
            own,
            rival,
            beats: news(claims).map(|(at, _)| at).collect(),
            first_ms: at,
        }
    })
}

impl Rivalry {
    fn words(&self) -> String {
        let kind = |claim: Claim| if claim.leads { "leading" } else { "asking" };
        format!("{}, a rival is {}", kind(self.own), kind(self.rival))
    }

    /// Whether a RAM gives way: it yields, or names the own session as ended.
    fn gives_up(&self, state: &RamSeen) -> bool {
        let own = self.own.session;
        let yields = matches!(
            state.ram.coordination,
            Coordination::Leader { yields: true, .. }
        );
        yields || state.names_as_ended(own.number) || state.session() != Some(own)
    }
}

fn gives_way(trace: &Trace) -> Vec<Met> {
    let limit_ms = 2 * trace.ms(|settings| settings.ram_period) + trace.soon_ms();
    let judge = |it: Rivalry| {
        // The first counts once, the second may come before the robot's next period.
        let heard_ms = it.beats.get(1).copied()?;
        let what = "no RAM that gives way";
        let met = trace.ram_due(heard_ms, limit_ms, what, |state| it.gives_up(state))?;
        Some(Met {
            situation: it.words(),
            ..met
        })
    };
    let lost = rivalries(trace).filter(|it| it.rival.goes_before(it.own) == Some(true));
    lost.filter_map(judge).collect()
}

/// Whether the robot insists on its session although a rival is there.
fn insists(trace: &Trace, it: &Rivalry) -> Option<Met> {
    let how = |later_ms| format!("it gives way {later_ms} ms later");
    let broken = trace.never(it.first_ms, |state| it.gives_up(state), how)?;
    // A leader whose only follower acknowledges nothing ends its session for that.
    if broken.is_some() && sent(trace).iter().any(|it| it.answered.is_none()) {
        return None;
    }
    Some(met_when(it.first_ms, it.words(), broken))
}

fn insists_against_silence(trace: &Trace) -> Vec<Met> {
    let before = rivalries(trace).filter(|it| it.rival.goes_before(it.own) == Some(true));
    // Two rivals are never both late.
    match &before.collect::<Vec<_>>()[..] {
        [it] if it.beats.len() == 1 => insists(trace, it).into_iter().collect(),
        _ => Vec::new(),
    }
}

fn insists_against_later(trace: &Trace) -> Vec<Met> {
    let later = rivalries(trace).filter(|it| it.rival.goes_before(it.own) == Some(false));
    later.filter_map(|it| insists(trace, &it)).collect()
}
