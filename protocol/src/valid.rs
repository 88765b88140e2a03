//! The invariant of all reachable states.
//!
//! [`Robot::is_valid`] holds in the initial state and is kept by every input (property I13): it is
//! inductive, so it holds after runs of any length. The local parts of other properties are among
//! its clauses. `model-check` checks it on every step of every scenario and for one robot against
//! every possible message; the crate's `laws` state that it is inductive.
//!
//! ```text
//!  valid ──► parts of a step, each keeps `is_consistent` ──► settle ──► valid
//! ```

use crate::config::Config;
use crate::help::all_distinct;
use crate::id::RequestId;
use crate::message::{Failure, Farewell, Progress};
use crate::state::{Corridor, Following, Identity, Leading, Member, Phase, Requesting, Robot};
use crate::task::Availability;
use crate::time::Millis;

impl Robot {
    /// True if the state is one that [`Robot::step`] can produce under `config`.
    #[must_use]
    pub fn is_valid(&self, config: &Config) -> bool {
        self.is_consistent(config)
            // I16: no timer is left due.
            && self.due_timers() == 0
            // The RAM timer runs exactly while there is something to tell of a session.
            && self.ram.is_armed() == self.is_bound()
            // I18: the identity is locked while the robot is bound.
            && (self.identity != Identity::Unlocked) == self.is_bound()
            // I11: the corridor is open only while every required follower is engaged.
            && match &self.phase {
                Phase::Leading(leading) => {
                    leading.corridor != Corridor::Open
                        || leading.corridor_obstacle(config).is_none()
                }
                _ => true,
            }
    }

    /// The part of [`is_valid`](Self::is_valid) that holds between the parts of a step too: all but the clauses about
    /// due timers and about matters that settle at its end.
    pub(crate) fn is_consistent(&self, config: &Config) -> bool {
        // I16: every timer is within its limit.
        self.timers_within_limits(config)
            && self.farewell.is_none_or(|standing| {
                // Its own session the robot ends; it does not leave it.
                let is_own = matches!(
                    standing.farewell,
                    Farewell::Left(session, _) if session.leader == self.station
                );
                standing.left.is_armed() && !is_own
            })
            && match self.identity {
                Identity::Unlocked => true,
                Identity::Locked(left) => left.is_armed(),
                Identity::Expiring => matches!(self.phase, Phase::Idle),
            }
            // W4: a robot with a duty on the road executes nothing and takes no new part.
            && (self.duty.is_none()
                || match &self.phase {
                    Phase::Idle => true,
                    Phase::Following(following) => following.executing().is_none(),
                    Phase::Requesting(_) | Phase::Offering(_) | Phase::Leading(_) => false,
                })
            // The RAM never names the session as over that it takes part in.
            && (self.session().is_none() || self.farewell_session() != self.session())
            && self.phase_is_valid(config)
    }

    /// I14 and I1 hold by the shape of [`Phase`]: one part in one session at a time, and no maneuver
    /// without being a follower.
    fn phase_is_valid(&self, config: &Config) -> bool {
        match &self.phase {
            Phase::Idle => true,
            Phase::Requesting(requesting) => {
                self.has_issued(requesting.number.0)
                    && self.availability == Availability::Available
                    && requesting.is_valid()
                    && requesting
                        .offers
                        .iter()
                        .all(|offer| offer.station != self.station)
            }
            Phase::Offering(offering) => {
                self.has_issued(offering.number.0)
                    // It is the last one given out, unless its epoch is over.
                    && (offering.number.0.boot != self.boot
                        || offering.number.0.count.checked_add(1) == Some(self.next_count))
                    && self.availability == Availability::Available
                    && offering.session.leader != self.station
                    && offering.reservation.is_armed()
                    && !offering.capabilities.is_empty()
                    // A RAM can tell it.
                    && Millis(1) <= offering.t_safety
                    && offering.t_safety <= Millis::MAX_TIMER
            }
            Phase::Leading(leading) => {
                self.has_issued(leading.number.0)
                    && self.availability == Availability::Available
                    && leading.is_valid(config)
                    && leading
                        .members
                        .iter()
                        .all(|member| member.station != self.station)
            }
            Phase::Following(following) => {
                self.has_issued(following.offer.0)
                    && following.session.leader != self.station
                    && following.is_valid(self.availability)
            }
        }
    }
}

impl Requesting {
    fn is_valid(&self) -> bool {
        self.request.is_possible()
            && self.help.is_armed()
            && (self.selection.is_armed() || self.offers.is_empty())
            && self.offers.iter().all(|offer| offer.standing.is_armed())
            && self.offers_are_ranked()
    }
}

impl Leading {
    fn is_valid(&self, config: &Config) -> bool {
        let at_most = usize::from(self.request.followers);
        // It is asked for again when the session is renewed.
        self.request.is_possible()
            && self.members.is_dense()
            && (1..=at_most).contains(&self.members.len())
            // W3: one that has yielded ends as soon as its road is clear.
            && (self.yields_to.is_none() || self.corridor == Corridor::Clearing)
            // I18: no two followers with the same station id.
            && all_distinct(&self.members, |member| member.station)
            && self.members.iter().all(|member| member.is_valid(config, self))
    }
}

impl Member {
    fn is_valid(&self, config: &Config, leading: &Leading) -> bool {
        let first = config.settings().first_request;
        let count = self.next_request.distance_from(first);
        let issued = |request: RequestId| request.distance_from(first) < count;
        count <= RequestId::MAX_PER_SESSION
            && self.lease.countdown().is_armed()
            // It echoed what this leader sent, and not so long ago that the order is in doubt.
            && self.echoed.is_none_or(|echoed| leading.heartbeat.can_follow(echoed))
            // Commands are given only to followers that have taken their role, and so is the lease.
            && (self.has_joined()
                || (self.outstanding.is_none() && self.order.is_none() && !self.lease.stands()))
            && self.outstanding.is_none_or(|outstanding| {
                issued(outstanding.request)
                    && outstanding.acknowledgement.is_armed()
                    // I16: no more repeats than allowed.
                    && outstanding.repeats <= config.settings().n_ack
                    // One command is outstanding, and it is the newest.
                    && outstanding.request.next() == self.next_request
                    && self.order.is_none_or(|o| outstanding.request.is_newer_than(o.request))
            })
            && self.order.is_none_or(|order| {
                issued(order.request)
                    && order.execution.is_armed() == order.is_running()
                    && order.execution.is_within(config.t_exec(order.task))
            })
    }
}

impl Following {
    fn is_valid(&self, availability: Availability) -> bool {
        // An unavailable robot executes nothing.
        (availability == Availability::Available || self.executing().is_none())
            && self.contact.countdown().is_armed()
            // The execution limit is the leader's, and no RAM can report it.
            && self.job.is_none_or(|job| {
                job.progress != Progress::Failed(Failure::ExecutionLimit)
            })
            // I9: once contact is lost, nothing runs until a newer command comes.
            && (!self.contact.is_lost() || self.executing().is_none())
            // I5: a refused command is newer than the accepted one.
            && match (self.refused, self.job) {
                (Some(refused), Some(job)) => refused.request.is_newer_than(job.request),
                _ => true,
            }
    }
}
