//! States that no step produces, each a small change away from one that a step did.

use std::boxed::Box;
use std::vec::Vec;

use super::*;
use crate::id::{Heartbeat, OfferNumber, SessionId, SessionNumber, StationId, UniqueNumber};
use crate::input::Decimetres;
use crate::message::{Ending, Rejection};
use crate::output::Maneuver;
use crate::state::{
    Contact, Duty, Job, Lease, Offer, Offering, Order, Outstanding, Refusal, StandingFarewell,
};
use crate::task::{TaskSet, TaskType, Unavailability};
use crate::team::{ARI, GO2, SPOT, Team, config};
use crate::time::{Countdown, Millis};

/// Any time that an armed timer of a valid state may have left.
const SOON: Countdown = Countdown::armed(Millis(1));

type Change = Box<dyn Fn(&mut Robot)>;

fn assert_validity(robot: &Robot, is_valid: bool, changes: Vec<(&str, Change)>) {
    assert!(robot.is_valid(&config()), "{robot:#?}");
    for (what, change) in changes {
        let mut other = robot.clone();
        change(&mut other);
        assert_ne!(other, *robot, "{what} changes nothing");
        assert_eq!(other.is_valid(&config()), is_valid, "{what}: {other:#?}");
    }
}

/// Asserts that `robot` is valid, and is not any more after each of these changes.
macro_rules! assert_each_breaks {
    ($robot:expr, $($what:literal: |$r:ident| $change:expr;)*) => {
        assert_validity(&$robot, false, std::vec![$(($what, Box::new(|$r: &mut Robot| $change))),*])
    };
}

/// Asserts that `robot` is valid, and still is after each of these changes.
macro_rules! assert_each_keeps {
    ($robot:expr, $($what:literal: |$r:ident| $change:expr;)*) => {
        assert_validity(&$robot, true, std::vec![$(($what, Box::new(|$r: &mut Robot| $change))),*])
    };
}

fn requesting(robot: &mut Robot) -> &mut Requesting {
    match &mut robot.phase {
        Phase::Requesting(requesting) => requesting,
        other => panic!("{other:?}"),
    }
}

fn offering(robot: &mut Robot) -> &mut Offering {
    match &mut robot.phase {
        Phase::Offering(offering) => offering,
        other => panic!("{other:?}"),
    }
}

fn leading(robot: &mut Robot) -> &mut Leading {
    match &mut robot.phase {
        Phase::Leading(leading) => leading,
        other => panic!("{other:?}"),
    }
}

fn following(robot: &mut Robot) -> &mut Following {
    match &mut robot.phase {
        Phase::Following(following) => following,
        other => panic!("{other:?}"),
    }
}

/// Changes the leader's record of GO2.
fn member(robot: &mut Robot, change: impl FnOnce(&mut Member)) {
    leading(robot).update_member(GO2, change).expect("a member");
}

fn outstanding(robot: &mut Robot, change: impl FnOnce(&mut Outstanding)) {
    member(robot, |member| {
        change(member.outstanding.as_mut().expect("a command"));
    });
}

fn order(robot: &mut Robot, change: impl FnOnce(&mut Order)) {
    member(robot, |member| {
        change(member.order.as_mut().expect("an order"));
    });
}

fn another_life(number: UniqueNumber) -> UniqueNumber {
    UniqueNumber {
        boot: number.boot + 1,
        ..number
    }
}

fn not_given_out(robot: &Robot) -> UniqueNumber {
    UniqueNumber {
        boot: robot.boot,
        count: robot.next_count,
    }
}

fn farewell(farewell: Farewell, left: Countdown) -> StandingFarewell {
    StandingFarewell { farewell, left }
}

fn left(session: SessionId) -> Farewell {
    Farewell::Left(session, OfferNumber(UniqueNumber { boot: 1, count: 0 }))
}

const fn ended(number: SessionNumber) -> Farewell {
    Farewell::Ended(number, Ending::Aborted)
}

const fn duty(leader: StationId) -> Duty {
    let number = SessionNumber(UniqueNumber { boot: 1, count: 0 });
    let session = SessionId { leader, number };
    let request = crate::RequestId(0);
    let id = crate::ManeuverId { session, request };
    let task = TaskType::MOVE;
    Duty::FallingBack(Maneuver { id, task })
}

fn session(leader: StationId, count: u16) -> SessionId {
    let number = SessionNumber(UniqueNumber { boot: 1, count });
    SessionId { leader, number }
}

#[test]
fn an_idle_robot() {
    let robot = Robot::new(ARI, 1);
    assert_each_breaks!(robot,
        "the RAM timer runs": |r| r.ram = SOON;
        "the RAM timer is longer than it is ever armed": |r| r.ram = Countdown::armed(Millis(1_000_000));
        "the identity is locked for nothing": |r| r.identity = Identity::Locked(SOON);
        "the lock expires for nothing": |r| r.identity = Identity::Expiring;
        "a farewell without a lock": |r| {
            r.ram = SOON;
            r.farewell = Some(farewell(left(session(GO2, 0)), SOON));
        };
    );
    assert_each_keeps!(robot,
        "it says farewell to its own session": |r| {
            (r.ram, r.identity) = (SOON, Identity::Locked(SOON));
            r.farewell = Some(farewell(ended(session(ARI, 0).number), SOON));
        };
        "it says farewell while its lock expires": |r| {
            (r.ram, r.identity) = (SOON, Identity::Expiring);
            r.farewell = Some(farewell(left(session(GO2, 0)), SOON));
        };
        "it is unavailable": |r| {
            r.availability = Availability::Unavailable(Unavailability::LowBattery);
        };
        "it has a duty": |r| r.duty = Some(duty(GO2));
    );
}

#[test]
fn a_farewell() {
    let mut robot = Robot::new(ARI, 1);
    (robot.ram, robot.identity) = (SOON, Identity::Locked(SOON));
    robot.farewell = Some(farewell(left(session(GO2, 0)), SOON));
    assert_each_breaks!(robot,
        "it has left its own session": |r| {
            r.farewell = Some(farewell(left(session(ARI, 0)), SOON));
        };
        "it stands without end": |r| {
            r.farewell = Some(farewell(left(session(GO2, 0)), Countdown::OFF));
        };
        "it was due": |r| {
            r.farewell = Some(farewell(left(session(GO2, 0)), Countdown::armed(Millis(0))));
        };
        "no RAM says it": |r| r.ram = Countdown::OFF;
        "the lock has no end": |r| r.identity = Identity::Locked(Countdown::OFF);
        "the identity is not locked": |r| r.identity = Identity::Unlocked;
    );
}

#[test]
fn a_requester() {
    let [robot, ..] = Team::that_offers().0;
    assert_each_breaks!(robot,
        "a number of another life": |r| {
            let number = &mut requesting(r).number.0;
            *number = another_life(*number);
        };
        "a number that was not given out": |r| {
            let number = not_given_out(r);
            requesting(r).number.0 = number;
        };
        "it is unavailable": |r| {
            r.availability = Availability::Unavailable(Unavailability::NotSafe);
        };
        "it asks for nobody": |r| requesting(r).request.followers = 0;
        "it asks for more than can follow": |r| requesting(r).request.followers = 17;
        "it asks for nothing": |r| requesting(r).request.tasks = TaskSet::EMPTY;
        "it asks without end": |r| requesting(r).help = Countdown::OFF;
        "it never selects": |r| requesting(r).selection = Countdown::OFF;
        "it has an offer of its own": |r| {
            let offers = &requesting(r).offers;
            requesting(r).offers = offers.iter().map(|o| Offer { station: ARI, ..*o }).take(1).collect();
        };
        "offers out of order": |r| {
            let mut offers: Vec<Offer> = requesting(r).offers.iter().copied().collect();
            offers.reverse();
            requesting(r).offers = offers.into_iter().collect();
        };
        "one offer twice": |r| {
            let first = *requesting(r).offers.iter().next().unwrap();
            requesting(r).offers = [first, first].into_iter().collect();
        };
        "two offers of one robot": |r| {
            let first = *requesting(r).offers.iter().next().unwrap();
            let farther = Offer { distance: Decimetres(first.distance.0 + 1), ..first };
            requesting(r).offers = [first, farther].into_iter().collect();
        };
        "the identity is not locked": |r| r.identity = Identity::Unlocked;
        "the lock has expired": |r| r.identity = Identity::Expiring;
        "no RAM": |r| r.ram = Countdown::OFF;
        "the RAM was due": |r| r.ram = Countdown::armed(Millis(0));
        "it says that its session is over": |r| {
            r.farewell = Some(farewell(ended(requesting(r).number), SOON));
        };
        "it asks while it has a duty": |r| r.duty = Some(duty(GO2));
        "an offer stands without end": |r| {
            let first = *requesting(r).offers.iter().next().unwrap();
            let endless = Offer { standing: Countdown::OFF, ..first };
            requesting(r).offers = [endless].into_iter().collect();
        };
        "an offer stands longer than it is counted on": |r| {
            let first = *requesting(r).offers.iter().next().unwrap();
            let standing = Countdown::armed(Millis(config().t_offer_lease().0 + 1));
            requesting(r).offers = [Offer { standing, ..first }].into_iter().collect();
        };
        "it asks for longer than T_help": |r| {
            requesting(r).help = Countdown::armed(Millis(config().settings().t_help.0 + 1));
        };
    );
    let [alone, ..] = Team::that_asks().0;
    assert_each_keeps!(alone,
        "it still says farewell to a former session": |r| {
            r.farewell = Some(farewell(left(session(GO2, 0)), SOON));
        };
        "it asks for as many as can follow": |r| requesting(r).request.followers = 4;
    );
    assert_each_keeps!(robot,
        "offers of several robots that differ": |r| {
            let offer = *requesting(r).offers.iter().next().unwrap();
            let other = |station, distance| Offer { station, distance: Decimetres(distance), ..offer };
            requesting(r).offers =
                [other(SPOT, 1), other(GO2, 2), other(StationId(9), 2)].into_iter().collect();
        };
    );
}

#[test]
fn a_helper() {
    let [_, robot, _] = Team::that_offers().0;
    assert_each_breaks!(robot,
        "a number of another life": |r| {
            let number = &mut offering(r).number.0;
            *number = another_life(*number);
        };
        "a number that was not given out": |r| {
            let number = not_given_out(r);
            offering(r).number.0 = number;
        };
        "it is unavailable": |r| {
            r.availability = Availability::Unavailable(Unavailability::NotSafe);
        };
        "it offers to itself": |r| offering(r).session.leader = GO2;
        "it is reserved without end": |r| offering(r).reservation = Countdown::OFF;
        "it can do nothing": |r| offering(r).capabilities = TaskSet::EMPTY;
        "it offers while it has a duty": |r| r.duty = Some(duty(GO2));
        "it has given out another number since": |r| r.next_count += 1;
        "it says that it has left": |r| {
            r.farewell = Some(farewell(left(offering(r).session), SOON));
        };
    );
}

#[test]
fn a_leader() {
    let [robot, ..] = Team::with_roles().0;
    assert_each_breaks!(robot,
        "a number of another life": |r| {
            let number = &mut leading(r).number.0;
            *number = another_life(*number);
        };
        "a number that was not given out": |r| {
            let number = not_given_out(r);
            leading(r).number.0 = number;
        };
        "it is unavailable": |r| {
            r.availability = Availability::Unavailable(Unavailability::NotSafe);
        };
        "nobody follows": |r| leading(r).members = crate::List::EMPTY;
        "more follow than were asked for": |r| leading(r).request.followers = 1;
        "more were asked for than can follow": |r| leading(r).request.followers = 17;
        "one follows twice": |r| {
            let one = *leading(r).member(GO2).unwrap();
            leading(r).members = [one, one].into_iter().collect();
        };
        "it follows itself": |r| member(r, |m| m.station = ARI);
        "the corridor is open over robots that do nothing": |r| leading(r).corridor = Corridor::Open;
        "it yields with a clear road": |r| leading(r).yields_to = Some(SPOT);
        "it yields, and people may cross": |r| {
            (leading(r).yields_to, leading(r).corridor) = (Some(SPOT), Corridor::Open);
        };
        "it leads while it has a duty": |r| r.duty = Some(duty(GO2));
        "it keeps a follower without end": |r| member(r, |m| m.lease = Lease::Stands(Countdown::OFF));
        "so it does one without a lease": |r| member(r, |m| m.lease = Lease::Expired(Countdown::OFF));
        "a lease on one that has not joined": |r| member(r, |m| m.echoed = None);
        "it commanded one that has not joined": |r| {
            let heard = leading(r).heartbeat;
            member(r, |m| {
                assert_eq!(m.echoed, Some(heard), "the newest heartbeat was echoed");
                m.lease = Lease::Expired(SOON);
                m.echoed = None;
                m.next_request = m.next_request.next();
                m.outstanding = Some(Outstanding {
                    request: crate::RequestId(0),
                    task: TaskType::MOVE,
                    repeats: 0,
                    acknowledgement: SOON,
                });
            });
        };
        "it echoed what was not sent yet": |r| {
            let next = Heartbeat(leading(r).heartbeat.0 + 1);
            member(r, |m| m.echoed = Some(next));
        };
        "more commands than a session may have": |r| {
            member(r, |m| m.next_request = crate::RequestId(RequestId::MAX_PER_SESSION + 1));
        };
    );
    assert_each_keeps!(robot,
        "it yields while the road clears": |r| {
            (leading(r).yields_to, leading(r).corridor) = (Some(SPOT), Corridor::Clearing);
        };
        "one has not joined": |r| member(r, |m| (m.echoed, m.lease) = (None, Lease::Expired(SOON)));
        "as many commands as a session may have": |r| {
            member(r, |m| m.next_request = crate::RequestId(RequestId::MAX_PER_SESSION));
        };
    );
}

#[test]
fn a_leader_with_commands() {
    let [robot, ..] = Team::at_work().0;
    let n_ack = config().settings().n_ack;
    let t_exec = config().t_exec(TaskType::MOVE);
    assert_each_breaks!(robot,
        "one repeat too many": |r| {
            outstanding(r, |o| o.repeats = config().settings().n_ack + 1);
        };
        "it waits for an answer without end": |r| {
            outstanding(r, |o| o.acknowledgement = Countdown::OFF);
        };
        "an older command is outstanding": |r| outstanding(r, |o| o.request = crate::RequestId(0));
        "a command that was not given is outstanding": |r| {
            outstanding(r, |o| o.request = o.request.next());
        };
        "there was a command since": |r| member(r, |m| m.next_request = m.next_request.next());
        "what is outstanding is acknowledged": |r| {
            order(r, |o| o.request = crate::RequestId(1));
        };
        "what was not given is acknowledged": |r| {
            member(r, |m| m.outstanding = None);
            order(r, |o| o.request = crate::RequestId(2));
        };
        "it waits for the end without limit": |r| order(r, |o| o.execution = Countdown::OFF);
        "it waits longer than the task may take": |r| {
            let t_exec = config().t_exec(TaskType::MOVE);
            order(r, |o| o.execution = Countdown::armed(Millis(t_exec.0 + 1)));
        };
        "it waits for the end of what is over": |r| {
            order(r, |o| o.progress = Some(Progress::Completed));
        };
        "orders for one that has not joined": |r| member(r, |m| {
            (m.echoed, m.lease, m.outstanding) = (None, Lease::Expired(SOON), None);
        });
    );
    assert_validity(
        &robot,
        true,
        std::vec![
            (
                "the last repeat",
                Box::new(move |r: &mut Robot| outstanding(r, |o| o.repeats = n_ack)) as Change,
            ),
            (
                "nothing is outstanding",
                Box::new(|r: &mut Robot| member(r, |m| m.outstanding = None)),
            ),
            (
                "what is over has no limit",
                Box::new(|r: &mut Robot| {
                    order(r, |o| {
                        (o.progress, o.execution) = (Some(Progress::Completed), Countdown::OFF);
                    });
                }),
            ),
            (
                "all the time of the task is left",
                Box::new(move |r: &mut Robot| {
                    order(r, |o| {
                        (o.task, o.execution) = (TaskType::MOVE, SOON);
                        assert!(SOON.is_within(t_exec));
                    });
                }),
            ),
        ],
    );
}

#[test]
fn a_follower() {
    let [_, robot, _] = Team::at_work().0;
    assert_each_breaks!(robot,
        "an offer of another life": |r| {
            let number = &mut following(r).offer.0;
            *number = another_life(*number);
        };
        "an offer that was not made": |r| {
            let number = not_given_out(r);
            following(r).offer = OfferNumber(number);
        };
        "it leads itself": |r| following(r).session.leader = GO2;
        "it executes while it has a duty": |r| r.duty = Some(duty(ARI));
        "it executes while unavailable": |r| {
            r.availability = Availability::Unavailable(Unavailability::NotSafe);
        };
        "it trusts in its leader without end": |r| following(r).contact = Contact::Fresh(Countdown::OFF);
        "it stays without end": |r| {
            following(r).job = None;
            following(r).contact = Contact::Lost(Countdown::OFF);
        };
        "it executes after contact was lost": |r| following(r).contact = Contact::Lost(SOON);
        "it reports what the leader alone can know": |r| {
            let job = following(r).job.as_mut().unwrap();
            job.progress = Progress::Failed(Failure::ExecutionLimit);
        };
        "what it refused is as old as what it accepted": |r| {
            let request = following(r).job.unwrap().request;
            following(r).refused = Some(Refusal { request, reason: Rejection::UnsupportedTask });
        };
        "it says that it has left": |r| {
            r.farewell = Some(farewell(left(following(r).session), SOON));
        };
    );
    assert_each_keeps!(robot,
        "it is idle and unavailable": |r| {
            following(r).job = None;
            r.availability = Availability::Unavailable(Unavailability::NotSafe);
        };
        "it is done": |r| {
            let job = following(r).job.unwrap();
            following(r).job = Some(Job { progress: Progress::Completed, ..job });
            following(r).contact = Contact::Lost(SOON);
        };
        "it is in position": |r| {
            let job = following(r).job.unwrap();
            following(r).job = Some(Job { progress: Progress::InPosition, ..job });
        };
        "it has a duty and executes nothing": |r| {
            following(r).job = None;
            r.duty = Some(duty(ARI));
        };
        "it refused something newer": |r| {
            let request = following(r).job.unwrap().request.next();
            following(r).refused = Some(Refusal { request, reason: Rejection::UnsupportedTask });
        };
        "it refused and accepted nothing": |r| {
            let request = following(r).job.unwrap().request;
            following(r).job = None;
            following(r).refused = Some(Refusal { request, reason: Rejection::UnsupportedTask });
        };
    );
}
