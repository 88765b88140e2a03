//! Arbitrary states, valid or not.

use super::message::farewell;
use super::{
    Any, AnyWord, BOOT, HEARTBEAT, ME, PEER, REQUEST, Source, availability, choice,
    earlier_heartbeat, escort, heartbeat, help_request, likely, list, maneuver_id, number,
    offer_number, option, request_id, session, session_number, station, task, task_like, task_set,
};
use crate::config::Config;
use crate::id::{Heartbeat, OfferNumber, RequestId, SessionNumber, StationId};
use crate::input::Decimetres;
use crate::message::{Progress, ProgressKind, Rejection};
use crate::output::Maneuver;
use crate::state::{
    Contact, Corridor, Duty, Following, Identity, Job, Leading, Lease, Member, Offer, Offering,
    Order, Outstanding, Phase, Refusal, Requesting, Rival, Robot, Role, StandingFarewell,
};
use crate::task::{Availability, HelpRequest, TaskType};
use crate::time::{Countdown, Millis};

/// How many offers or followers a state has, at least and at most.
pub type Peers = (usize, usize);

/// Any state in this role that can be valid. `config` is for hints.
///
/// A robot in a session has its identity locked, and only one without a part or a follower can be
/// unavailable or have a duty: to say so at once, rather than by [`Robot::is_valid`] alone, saves a proof the rest.
pub fn valid_robot(source: &mut impl Source, config: &Config, role: Role, peers: Peers) -> Robot {
    let mut robot = robot(source, config, role, peers);
    if role != Role::None {
        let limit = config.t_lock_session();
        robot.identity = Identity::Locked(countdown(source, limit));
        robot.ram = countdown(source, config.settings().ram_period);
    }
    if !matches!(role, Role::None | Role::Follower) {
        robot.availability = Availability::Available;
        robot.duty = None;
    }
    robot
}

/// Any state in this role. `config` is for hints.
pub fn robot(source: &mut impl Source, config: &Config, role: Role, peers: Peers) -> Robot {
    let settings = config.settings();
    Robot {
        station: station(source, ME),
        boot: source.u16(BOOT),
        next_count: if source.likely(Some(true)) {
            source.u16(BOOT)
        } else {
            // From half of the numbers on a new epoch is asked for.
            source.u16(u16::MAX / 2)
        },
        availability: availability(source),
        identity: match choice(source, 3) {
            0 => Identity::Unlocked,
            1 => Identity::Locked(countdown(source, config.t_lock_session())),
            _ => Identity::Expiring,
        },
        duty: likely(source, Some(false), duty),
        ram: armed_if(source, None, settings.ram_period),
        farewell: option(source, |s| StandingFarewell {
            farewell: farewell(s, ME),
            left: countdown(s, settings.t_farewell),
        }),
        phase: phase(source, config, role, peers),
    }
}

/// Any countdown. Hints keep it within `limit`.
fn countdown(source: &mut impl Source, limit: Millis) -> Countdown {
    // Now and then little is left.
    let most = if source.likely(Some(true)) {
        limit.0
    } else {
        limit.0 / 4
    };
    let hint = source.number(most, most);
    let left = source.number(u32::MAX, hint);
    Countdown::from(Some(left).filter(|&left| left < u32::MAX))
}

/// Any countdown, often off, and more often where the hint says so.
fn armed_if(source: &mut impl Source, hint: Option<bool>, limit: Millis) -> Countdown {
    let armed = countdown(source, limit);
    if source.likely(hint) {
        armed
    } else {
        Countdown::OFF
    }
}

fn phase(source: &mut impl Source, config: &Config, role: Role, peers: Peers) -> Phase {
    let settings = config.settings();
    match role {
        Role::None => Phase::Idle,
        Role::Requester => Phase::Requesting(Requesting {
            number: SessionNumber(number(source)),
            request: help_request(source),
            heartbeat: heartbeat(source),
            rival: option(source, rival),
            offers: list(source, peers, |s, i| offer(s, config, PEER + i)),
            help: countdown(source, settings.t_help),
            selection: armed_if(source, None, settings.t_select),
        }),
        Role::Helper => Phase::Offering(Offering {
            session: session(source, PEER),
            number: OfferNumber(number(source)),
            capabilities: task_set(source),
            heard: earlier_heartbeat(source),
            t_safety: Millis(source.number(u32::MAX, settings.t_safety.0)),
            reservation: countdown(source, settings.t_offer),
        }),
        Role::Leader => Phase::Leading(leading(source, config, peers)),
        Role::Follower => Phase::Following(following(source, config)),
    }
}

fn duty(source: &mut impl Source) -> Duty {
    if source.flag() {
        Duty::Crossing(session(source, ME))
    } else {
        Duty::FallingBack(Maneuver {
            id: maneuver_id(source),
            task: escort(source),
        })
    }
}

/// One that was heard before what a message may say of it.
fn rival(source: &mut impl Source) -> Rival {
    Rival {
        session: session(source, PEER),
        heartbeat: earlier_heartbeat(source),
    }
}

fn offer(source: &mut impl Source, config: &Config, hint: u32) -> Offer {
    Offer {
        station: station(source, hint),
        number: offer_number(source),
        capabilities: task_set(source),
        distance: Decimetres(source.u16(u16::try_from(hint).unwrap_or(0))),
        echo: earlier_heartbeat(source),
        standing: countdown(source, config.t_offer_lease()),
    }
}

fn leading(source: &mut impl Source, config: &Config, peers: Peers) -> Leading {
    // Hints: that all followers are engaged, so that the corridor can be open.
    let engaged = source.flag();
    let members = list(source, peers, |s, i| member(s, config, PEER + i, engaged));
    let followers = u8::try_from(members.len()).unwrap_or(1);
    Leading {
        number: session_number(source),
        request: HelpRequest {
            followers: source.u8(followers),
            ..help_request(source)
        },
        heartbeat: heartbeat(source),
        members,
        corridor: match source.number(2, if engaged { 1 } else { u32::MAX }) {
            0 => Corridor::Clear,
            1 => Corridor::Open,
            _ => Corridor::Clearing,
        },
        rival: option(source, rival),
        yields_to: likely(source, Some(false), |s| station(s, PEER)),
    }
}

fn member(source: &mut impl Source, config: &Config, hint: u32, engaged: bool) -> Member {
    let settings = config.settings();
    let station: StationId = station(source, hint);
    let echoed = likely(source, engaged.then_some(true), echo);
    // A follower that has not joined has no lease and no command.
    let unless_joined = echoed.is_none().then_some(false);
    let if_engaged = unless_joined.or(engaged.then_some(true));
    let unless_engaged = unless_joined.or(engaged.then_some(false));
    // The number space is used up now and then.
    let used = if source.likely(Some(false)) {
        RequestId::MAX_PER_SESSION
    } else {
        1
    };
    let outstanding = likely(source, unless_engaged, |s| Outstanding {
        request: request_id(s),
        task: task(s),
        repeats: s.u8(settings.n_ack.saturating_sub(1)),
        acknowledgement: countdown(s, settings.t_ack),
    });
    // The outstanding command is newer.
    let accepted = REQUEST - u8::from(outstanding.is_some());
    Member {
        station,
        offer: offer_number(source),
        echoed,
        lease: if source.likely(if_engaged) {
            Lease::Stands(countdown(source, settings.t_lease))
        } else {
            Lease::Expired(countdown(source, config.t_lost()))
        },
        next_request: RequestId(source.u8(REQUEST + used)),
        outstanding,
        order: likely(source, if_engaged, |s| order(s, config, engaged, accepted)),
    }
}

/// The newest heartbeat or an earlier one; now and then one that is almost too old to be put in order.
fn echo(source: &mut impl Source) -> Heartbeat {
    if source.likely(Some(true)) {
        heartbeat(source)
    } else {
        Heartbeat(source.u16(HEARTBEAT.wrapping_sub(i16::MAX.unsigned_abs())))
    }
}

fn order(source: &mut impl Source, config: &Config, engaged: bool, hint: u8) -> Order {
    let request = RequestId(source.u8(hint));
    // Hints: it goes with people, or holds its place.
    let guards = if source.flag() {
        (ProgressKind::Executing, TaskType::MOVE)
    } else {
        (ProgressKind::InPosition, TaskType::BLOCK)
    };
    let (hint, task) = if engaged {
        (guards.0 as u32, u32::from(guards.1.value()))
    } else {
        (u32::MAX, u32::MAX)
    };
    let task = task_like(source, task);
    let progress = option(source, |s| Progress::any_like(s, hint));
    let is_running = progress.is_none_or(Progress::is_running);
    Order {
        request,
        task,
        progress,
        execution: armed_if(source, Some(is_running), config.t_exec(task)),
    }
}

fn following(source: &mut impl Source, config: &Config) -> Following {
    let settings = config.settings();
    Following {
        session: session(source, PEER),
        offer: offer_number(source),
        heard: heartbeat(source),
        contact: if source.flag() {
            Contact::Lost(countdown(source, settings.t_leave))
        } else {
            Contact::Fresh(countdown(source, settings.t_safety))
        },
        job: option(source, |s| Job {
            request: request_id(s),
            task: task(s),
            progress: Progress::any(s),
        }),
        refused: option(source, |s| Refusal {
            request: request_id(s).next(),
            reason: Rejection::any(s),
        }),
        sees_people: source.flag(),
    }
}
