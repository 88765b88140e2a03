//! The identity lock: station id, certificate and link address stay the same from joining a session
//! until its farewell is over (property I18).

use crate::output::{EndReason, Output, ReleaseReason, Sink};
use crate::robot::Step;
use crate::state::{Identity, Phase, Robot};
use crate::time::Countdown;

impl Robot {
    /// Locks and unlocks as the robot gets bound and free.
    pub(crate) fn settle_identity(&mut self, step: &mut Step<'_, impl Sink>) {
        match (self.identity, self.is_bound()) {
            // R23: from the request or offer on.
            (Identity::Unlocked, true) => {
                self.identity = Identity::Locked(Countdown::armed(step.config.t_lock_session()));
                step.out.push(Output::LockIdentity);
            }
            (Identity::Locked(_) | Identity::Expiring, false) => {
                self.identity = Identity::Unlocked;
                step.out.push(Output::UnlockIdentity);
            }
            (Identity::Unlocked, false) | (Identity::Locked(_) | Identity::Expiring, true) => {}
        }
    }

    /// The lock has lasted as long as it may: whatever the robot has a part in ends in order.
    pub(crate) fn identity_lock_expired(&mut self, step: &mut Step<'_, impl Sink>) {
        // R23: at the latest by the limit.
        match self.phase {
            // A farewell is all that is left, and it has had its time.
            Phase::Idle => self.farewell = None,
            Phase::Requesting(_) | Phase::Leading(_) => {
                self.end_session(step, EndReason::IdentityLockLimit);
            }
            Phase::Offering(_) | Phase::Following(_) => {
                self.leave(step, ReleaseReason::IdentityLockLimit);
            }
        }
        self.identity = Identity::Expiring;
    }
}
