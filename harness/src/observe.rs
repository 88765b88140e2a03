//! What a running robot does, as events of [`tracing`], for whoever has set up a subscriber.
//!
//! | level | what |
//! |---|---|
//! | error | the log has no room, the link has failed |
//! | warn | something was dropped, with its cause; the application is told that something went wrong |
//! | info | boots, states, maneuvers, the corridor |
//! | debug | what the transition function ignored, with its cause; what the fault layer dropped; messages |
//! | trace | every step |

use crossguard_protocol::{Input, Notice, Output, Outputs, State};
use tracing::{debug, info, trace, warn};

use crate::counters::Cause;
use crate::trace::Entry;

/// Tells of an entry of the log. `before` is the state before it.
pub fn entry(entry: &Entry, before: &mut State) {
    match entry {
        Entry::Started { station, boot, .. } => {
            info!(%station, boot, "started");
        }
        Entry::Step {
            input,
            outputs,
            state,
        } => {
            step(input, outputs);
            let after = state.state();
            if *before != after {
                info!(from = ?before, to = ?after, role = %state.role(), "state");
                *before = after;
            }
        }
        Entry::Sent {
            message,
            trigger,
            octets,
        } => debug!(
            message = message.name(),
            ?trigger,
            octets = octets.len(),
            "sent"
        ),
        Entry::Heard {
            message,
            from,
            octets,
        } => debug!(message = message.name(), %from, octets = octets.len(), "heard"),
        Entry::Dropped { cause, detail, .. } if cause.starts_with("simulated ") => {
            debug!(cause, detail, "dropped");
        }
        Entry::Dropped { cause, detail, .. } => warn!(cause, detail, "dropped"),
        Entry::Stopped { counters } => {
            info!("stopped");
            for (cause, count) in counters {
                debug!(cause, count, "came to nothing");
            }
        }
    }
}

fn step(input: &Input, outputs: &Outputs) {
    trace!(%input, outputs = outputs.len(), "step");
    for output in outputs.iter() {
        match output {
            Output::Ignored(reason) => {
                debug!(cause = Cause::Ignored(*reason).name(), %input, "ignored");
            }
            Output::StartManeuver(_)
            | Output::StopManeuver(..)
            | Output::FallBack(..)
            | Output::CorridorOpened
            | Output::CorridorClosed(_) => info!(%output, "output"),
            Output::Notify(
                Notice::FollowerGone(..)
                | Notice::LeaseExpired(_)
                | Notice::CommandRejected(..)
                | Notice::ManeuverFailed(..)
                | Notice::FollowerSafeIdle(..)
                | Notice::ContactLost(_),
            ) => warn!(%output, "notice"),
            Output::Notify(_) => debug!(%output, "notice"),
            Output::SendRam
            | Output::SendRmcm(_)
            | Output::LockIdentity
            | Output::UnlockIdentity => {}
        }
    }
}
