//! What a running robot does, as events of [`tracing`], for a subscriber.
//!
//! | level | what |
//! |---|---|
//! | error | the log has no room, the link has failed |
//! | warn | something was dropped, with its cause; the application is told that something went wrong |
//! | info | boots, states, maneuvers, the corridor |
//! | debug | what the transition function ignored, with its cause; what the fault layer dropped; messages |
//! | trace | every step |

use std::ffi::OsString;
use std::io::IsTerminal;

use crossguard_endpoint::cause::{Cause, Layer};
use crossguard_endpoint::counters::CauseName;
use crossguard_protocol::{Input, Notice, Output, Outputs, State};
use tracing::{debug, info, trace, warn};
use tracing_appender::non_blocking::WorkerGuard;
use tracing_subscriber::Layer as _;
use tracing_subscriber::filter::Targets;
use tracing_subscriber::layer::SubscriberExt as _;
use tracing_subscriber::util::SubscriberInitExt as _;

use crate::trace::Entry;

/// Has what these crates observe written to standard error, by a thread of its own: a robot does not wait
/// for its reader, and lines that are not read in time are lost. What is left is written when the guard
/// is dropped.
///
/// `verbose` is how often `-v` was given: `info`, `debug`, and from three on `trace`. Without it nothing is
/// written, unless the environment variable `RUST_LOG` says what. It sets up the subscriber of the process;
/// where there is one already, that one stays.
pub fn to_standard_error(verbose: u8, crates: &[&str]) -> WorkerGuard {
    let level = match verbose {
        0 => "off",
        1 => "info",
        2 => "debug",
        _ => "trace",
    };
    let wanted = std::env::var("RUST_LOG").ok().filter(|_| verbose == 0);
    let filter = wanted.unwrap_or_else(|| {
        let levels: Vec<String> = crates
            .iter()
            .map(|name| format!("{name}={level}"))
            .collect();
        levels.join(",")
    });
    let filter: Targets = filter.parse().unwrap_or_else(|error| {
        eprintln!("RUST_LOG: {error}; wanted are crates and levels: crossguard_robot=debug");
        Targets::new()
    });
    let (stderr, guard) = tracing_appender::non_blocking(std::io::stderr());
    let lines = tracing_subscriber::fmt::layer()
        .with_writer(stderr)
        .with_target(false)
        .with_ansi(is_colored(
            std::io::stderr().is_terminal(),
            std::env::var_os("NO_COLOR"),
        ))
        .with_filter(filter);
    // It can only fail when there is a subscriber already.
    let _ = tracing_subscriber::registry().with(lines).try_init();
    guard
}

/// Whether lines have colours: on a terminal, unless the environment variable `NO_COLOR` holds something (see
/// no-color.org).
fn is_colored(is_terminal: bool, no_color: Option<OsString>) -> bool {
    is_terminal && no_color.is_none_or(|it| it.is_empty())
}

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
            ..
        } => debug!(message = message.name(), %from, octets = octets.len(), "heard"),
        Entry::Dropped { cause, detail, .. } => {
            let CauseName { layer, reason } = cause;
            if *layer == Layer::Simulated || cause.is_own_packet() {
                debug!(%layer, cause = %reason, detail, "dropped");
            } else {
                warn!(%layer, cause = %reason, detail, "dropped");
            }
        }
        Entry::Unrecorded { counters } => {
            for (CauseName { layer, reason }, count) in counters.iter() {
                warn!(%layer, cause = %reason, count, "dropped, and not recorded one by one");
            }
        }
        Entry::Zone(_) => {}
        Entry::Clock(clock) if clock.is_trusted() => info!("{clock}"),
        Entry::Clock(clock) => warn!("{clock}"),
        Entry::Channel(channel) => debug!(
            busy_ratio = ?channel.busy_ratio,
            power_dbm = ?channel.power_dbm,
            interval_ms = channel.interval_ms,
            "channel"
        ),
        Entry::People(sight) => debug!(
            people = sight.people.len(),
            waiting = sight.waiting(),
            on_road = sight.on_road(),
            "perceived"
        ),
        Entry::Around(around) => debug!(%around, "map"),
        Entry::Stopped { counters } => {
            info!("stopped");
            for (CauseName { layer, reason }, count) in counters.iter() {
                debug!(%layer, cause = %reason, count, "dropped or ignored");
            }
        }
    }
}

fn step(input: &Input, outputs: &Outputs) {
    trace!(%input, outputs = outputs.len(), "step");
    for output in outputs.iter() {
        match output {
            Output::Ignored(reason) => {
                debug!(cause = %Cause::from(*reason).reason(), %input, "ignored");
            }
            Output::StartManeuver(_)
            | Output::StopManeuver(..)
            | Output::FallBack(..)
            | Output::CorridorOpened(_)
            | Output::CorridorClosed(_)
            | Output::RenewEpoch => info!(%output, "output"),
            Output::Notify(
                Notice::FollowerGone(..)
                | Notice::LeaseExpired(_)
                | Notice::CommandRejected(..)
                | Notice::ManeuverFailed(..)
                | Notice::FollowerSafeIdle(..)
                | Notice::OfferLapsed(_)
                | Notice::Yielded(_)
                | Notice::ContactLost(_),
            ) => warn!(%output, "notice"),
            Output::Notify(_) => debug!(%output, "notice"),
            Output::CorridorExtended(_)
            | Output::SendRam
            | Output::SendRmcm(_)
            | Output::LockIdentity
            | Output::UnlockIdentity => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_have_colours_on_a_terminal_unless_no_color_holds_something() {
        assert!(is_colored(true, None));
        assert!(is_colored(true, Some(OsString::new())));
        assert!(!is_colored(true, Some("1".into())));
        assert!(!is_colored(false, None));
    }
}
