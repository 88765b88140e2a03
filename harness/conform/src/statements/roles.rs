//! Confirmations: which robot follows which.

use crossguard_protocol::{Coordination, OfferNumber, SessionId};

use super::{Met, Trace, first_of_each, met_when};
use crate::exchange::RamSeen;

statements! {
    "follows-the-leader-that-listed-it" "R2" follows_only_confirmed:
        "A robot follows only after a leader has listed the offer that it made to that session.";
    "takes-the-role" "R2" takes_the_role of first_lists:
        "A robot whose standing offer is listed follows.";
    "not-listed-is-released" "R2" not_listed_is_released of first_lists:
        "A helper or follower that its leader does not list, or lists for another offer, has no part any more.";
    "declines-what-does-not-stand" "R2" declines_what_lapsed of first_lists:
        "A robot that is listed for an offer that has lapsed names the session as left.";
}

/// The offer that the robot made to a session, the newest by `until_ms`.
fn offer_to(trace: &Trace, session: SessionId, until_ms: u64) -> Option<OfferNumber> {
    let rams = trace.rams().rev().filter(|(at, _)| *at <= until_ms);
    let mut offers = rams.filter_map(|(_, state)| state.offer());
    offers
        .find(|(to, _)| *to == session)
        .map(|(_, offer)| offer)
}

/// A RAM in which a station of the tester leads a session: when, which, and the offer of the robot that it lists.
type Listing = (u64, SessionId, Option<OfferNumber>);

fn lists(trace: &Trace) -> impl Iterator<Item = Listing> {
    trace.played_rams().filter_map(|(at, played)| {
        let Coordination::Leader { followers, .. } = played.ram.coordination else {
            return None;
        };
        let mut followers = followers.iter();
        let listed = followers.find(|it| it.station == trace.robot);
        Some((at, played.session()?, listed.map(|it| it.offer)))
    })
}

/// The first RAM of each kind in a row.
fn first_lists(trace: &Trace) -> Vec<Listing> {
    let mut all: Vec<Listing> = Vec::new();
    for (at, session, listed) in lists(trace) {
        let last = all.iter().rev().find(|(_, known, _)| *known == session);
        if last.is_none_or(|(_, _, known)| *known != listed) {
            all.push((at, session, listed));
        }
    }
    all
}

fn follows_only_confirmed(trace: &Trace) -> Vec<Met> {
    let followed = trace
        .rams()
        .filter_map(|(at, state)| Some((at, state.following()?.0)));
    let follows = |(at, session): (u64, SessionId)| {
        let own = offer_to(trace, session, at);
        let is_confirmed = lists(trace).any(|(then, to, listed)| {
            then <= at && to == session && listed.is_some() && listed == own
        });
        let broken = (!is_confirmed)
            .then(|| format!("it follows in {session} without a confirmation of its offer"));
        met_when(at, "follows", broken)
    };
    let must_not = |(at, session, listed): Listing| {
        let own = offer_to(trace, session, at);
        let is_wrong = listed.is_some() && listed != own || own.is_none();
        if !is_wrong || trace.state_at(at).is_some_and(|it| it.follows(session)) {
            return None;
        }
        let how = |_| format!("it follows in {session}");
        let broken = trace.never(at, |state| state.follows(session), how)?;
        let how = match (listed, own) {
            (None, _) => "not listed",
            (Some(_), None) => "listed in a session to which it did not offer",
            (Some(_), Some(_)) => "listed for another offer",
        };
        let situation = format!("{}, {how}", trace.situation_at(at));
        Some(met_when(at, situation, broken))
    };
    let first = first_of_each(followed, |(_, session)| *session);
    let wrong = first_lists(trace).into_iter().filter_map(must_not);
    first.map(follows).chain(wrong).collect()
}

fn takes_the_role(trace: &Trace, (at, session, listed): Listing) -> Option<Met> {
    // The robot's newest RAM says that the offer stands.
    if trace.state_at(at)?.offer() != Some((session, listed?)) {
        return None;
    }
    trace.ram_soon(at, "no RAM that follows", |state| state.follows(session))
}

fn not_listed_is_released(trace: &Trace, (at, session, listed): Listing) -> Option<Met> {
    let is_released = |state: &RamSeen| state.session() != Some(session);
    let own = offer_to(trace, session, at)?;
    if is_released(trace.state_at(at)?) || listed == Some(own) {
        return None;
    }
    trace.ram_soon(at, "no RAM without a part in the session", is_released)
}

fn declines_what_lapsed(trace: &Trace, (at, session, listed): Listing) -> Option<Met> {
    let was_made = offer_to(trace, session, at) == Some(listed?);
    if !was_made || trace.state_at(at)?.session().is_some() {
        return None;
    }
    let what = "no RAM that names the session as left";
    trace.ram_soon(at, what, |state| state.names_as_left(session))
}
