//! Arbitrary messages.

use super::{
    Any, ME, PEER, Source, escort, heartbeat, help_request, list, number, offer_number, option,
    place, request_id, session, session_number, station, task_set,
};
use crate::MAX_FOLLOWERS;
use crate::config::Settings;
use crate::id::SessionNumber;
use crate::message::{
    Answer, Command, Confirmation, Coordination, Ending, Farewell, Progress, Ram, Rejection,
    Report, Verdict,
};
use crate::task::Urgency;
use crate::time::Millis;

/// A RAM whose part in a session is of this kind: 0 none, 1 `needHelp`, 2 `offerHelp`, 3 leader, 4
/// follower. With `farewells` it may name a session as over.
pub fn ram(source: &mut impl Source, kind: u32, farewells: bool) -> Ram {
    let station = station(source, PEER);
    Ram {
        station,
        coordination: coordination(source, kind),
        farewell: if farewells {
            option(source, |s| farewell(s, PEER))
        } else {
            None
        },
        on_duty: source.likely(Some(false)),
    }
}

fn coordination(source: &mut impl Source, kind: u32) -> Coordination {
    match kind {
        0 => Coordination::None,
        1 => Coordination::NeedHelp {
            number: session_number(source),
            heartbeat: heartbeat(source),
            request: help_request(source),
        },
        2 => Coordination::OfferHelp {
            session: session(source, ME),
            offer: offer_number(source),
            capabilities: task_set(source),
            echo: heartbeat(source),
            t_safety: {
                // Now and then one that a lease does not fit.
                let fits = source.likely(Some(true));
                let t_safety = if fits {
                    Settings::default().t_safety
                } else {
                    Settings::default().t_lease
                };
                Millis(source.number(u32::MAX, t_safety.0))
            },
        },
        3 => Coordination::Leader {
            number: session_number(source),
            heartbeat: heartbeat(source),
            followers: list(source, (0, MAX_FOLLOWERS), |s, i| Confirmation {
                station: station(s, ME + i),
                offer: offer_number(s),
            }),
            urgency: Urgency::any(source),
            place: place(source),
            yields: source.likely(Some(false)),
        },
        _ => Coordination::Follower {
            session: session(source, ME),
            echo: heartbeat(source),
            last: option(source, |s| Report {
                request: request_id(s),
                progress: Progress::any(s),
            }),
        },
    }
}

/// A farewell; hints let a message name the session of `leader`.
pub(super) fn farewell(source: &mut impl Source, leader: u32) -> Farewell {
    if source.flag() {
        let session = session(source, if leader == PEER { ME } else { PEER });
        Farewell::Left(session, offer_number(source))
    } else {
        let ending = Ending::any(source);
        Farewell::Ended(SessionNumber(number(source)), ending)
    }
}

/// A command.
pub fn command(source: &mut impl Source) -> Command {
    Command {
        session: session(source, PEER),
        to: station(source, ME),
        request: request_id(source),
        task: escort(source),
    }
}

/// An answer.
pub fn answer(source: &mut impl Source) -> Answer {
    Answer {
        from: station(source, PEER),
        session: session(source, ME),
        request: request_id(source),
        verdict: if source.flag() {
            Verdict::Rejected(Rejection::any(source))
        } else {
            Verdict::Accepted
        },
    }
}
