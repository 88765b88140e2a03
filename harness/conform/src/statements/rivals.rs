//! Two requesters, or two leaders, at one place.

use crossguard_protocol::{Coordination, Farewell, Heartbeat, Place, SessionId, Urgency};

use super::lead::sent;
use super::{Met, due, met_when, news};
use crate::bench::Terms;
use crate::exchange::{Exchange, Happening, Message, RamSeen, session_of};

statements! {
    "who-goes-before-is-given-way" "R6" gives_way:
        "A requester or leader gives way to one at the same place that goes before, once it has heard it beat.";
    "who-does-not-beat-is-not-given-way" "R6" insists_against_silence:
        "A rival whose heartbeat does not grow may be a late message, and is not given way.";
    "who-goes-behind-is-not-given-way" "R6" insists_against_later:
        "A requester or leader does not give way to a rival of the same kind that goes behind.";
}

/// What somebody claims: how urgent, where, and whether by leading already.
#[derive(Clone, Copy)]
struct Claim {
    session: SessionId,
    urgency: Urgency,
    place: Place,
    leads: bool,
    heartbeat: Heartbeat,
}

fn claim_of(state: &RamSeen) -> Option<Claim> {
    let session = session_of(&state.ram)?;
    let (urgency, place, leads, heartbeat) = match state.ram.coordination {
        Coordination::NeedHelp {
            request, heartbeat, ..
        } => (request.urgency, request.place, false, heartbeat),
        Coordination::Leader {
            urgency,
            place,
            yields: false,
            heartbeat,
            ..
        } => (urgency, place, true, heartbeat),
        _ => return None,
    };
    Some(Claim {
        session,
        urgency,
        place,
        leads,
        heartbeat,
    })
}

impl Claim {
    fn is_at_the_place_of(self, other: Self) -> bool {
        self.place == other.place || self.place == Place::UNKNOWN || other.place == Place::UNKNOWN
    }

    /// A rival of the same kind goes before by its urgency, and then by the lower station id. A requester gives way
    /// to everybody who leads already.
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

fn rivalries(exchange: &Exchange) -> Vec<Rivalry> {
    let mut all: Vec<Rivalry> = Vec::new();
    for (at, _, played) in exchange.played_rams() {
        let Some(rival) = claim_of(played) else {
            continue;
        };
        let own = exchange.state_at(at).and_then(|(_, state)| claim_of(state));
        let Some(own) = own.filter(|own| own.session.leader == exchange.robot) else {
            continue;
        };
        let is_known = |it: &Rivalry| it.rival.session == rival.session;
        let is_robot = played.ram.station == exchange.robot;
        if all.iter().any(is_known) || is_robot || !rival.is_at_the_place_of(own) {
            continue;
        }
        let claims = exchange.played_rams().filter_map(|(at, _, played)| {
            let claim = claim_of(played)?;
            (claim.session == rival.session).then_some((at, claim.heartbeat))
        });
        all.push(Rivalry {
            own,
            rival,
            beats: news(claims).map(|(at, _)| at).collect(),
            first_ms: at,
        });
    }
    all
}

fn words(it: &Rivalry) -> String {
    let kind = |claim: Claim| if claim.leads { "leading" } else { "asking" };
    format!("{}, a rival is {}", kind(it.own), kind(it.rival))
}

/// Whether a RAM gives way: it yields, or names the own session as ended.
fn gives_up(state: &RamSeen, own: SessionId) -> bool {
    let yields = matches!(
        state.ram.coordination,
        Coordination::Leader { yields: true, .. }
    );
    yields
        || matches!(state.ram.farewell, Some(Farewell::Ended(number, _)) if number == own.number)
        || session_of(&state.ram) != Some(own)
}

fn gives_way(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let period_ms = terms.ms(|settings| settings.ram_period);
    let judge = |it: Rivalry| {
        if it.rival.goes_before(it.own) != Some(true) {
            return None;
        }
        // The first counts once, the second may come before the robot's next period.
        let heard_ms = it.beats.get(1).copied()?;
        let limit_ms = 2 * period_ms + terms.soon_ms();
        let found = due(
            exchange,
            heard_ms,
            limit_ms,
            "no RAM that gives way",
            |seen| matches!(&seen.what, Happening::Said(Message::Ram(state)) if gives_up(state, it.own.session)),
        )?;
        Some(met_when(heard_ms, words(&it), found.broken))
    };
    rivalries(exchange).into_iter().filter_map(judge).collect()
}

/// Whether the robot insists on its session although a rival is there.
fn insists(exchange: &Exchange, terms: &Terms, it: &Rivalry) -> Option<Met> {
    let until_ms = exchange.undisturbed_until(it.first_ms);
    if until_ms < it.first_ms + terms.soon_ms() {
        return None;
    }
    let mut after = exchange
        .rams()
        .filter(|(at, _)| (it.first_ms..until_ms).contains(at));
    let gives_up = after.find(|(_, state)| gives_up(state, it.own.session));
    // A leader whose only follower acknowledges nothing ends its session for that.
    if gives_up.is_some() && sent(exchange).iter().any(|it| it.answered.is_none()) {
        return None;
    }
    let broken = gives_up.map(|(at, _)| format!("it gives way {} ms later", at - it.first_ms));
    Some(met_when(it.first_ms, words(it), broken))
}

fn insists_against_silence(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let rivalries = rivalries(exchange).into_iter();
    let silent =
        rivalries.filter(|it| it.beats.len() == 1 && it.rival.goes_before(it.own) == Some(true));
    silent
        .filter_map(|it| insists(exchange, terms, &it))
        .collect()
}

fn insists_against_later(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let rivalries = rivalries(exchange).into_iter();
    let later = rivalries.filter(|it| it.rival.goes_before(it.own) == Some(false));
    later
        .filter_map(|it| insists(exchange, terms, &it))
        .collect()
}
