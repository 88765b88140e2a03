//! What robots say and are, as scripts tell it.

use std::fmt::Write as _;

use crossguard_protocol::*;

use super::words::NAMES;
use crate::script::*;

/// One output.
pub(super) fn said(step: &Step, output: &Output) -> String {
    let who = name(step.who);
    match output {
        Output::SendRam => format!("{who}: {}", step.ram),
        output => format!("{who}: {output}"),
    }
}

/// The state of a robot: one line, and one for its part in a session.
pub(super) fn show(street: &Street, who: StationId) -> String {
    let robot = &street[who];
    let mut out = format!("  {}: {robot}\n", name(who));
    let mut more = Vec::new();
    if let Some(duty) = robot.duty() {
        more.push(format!("duty: {duty}"));
    }
    if street.shows_go(who) {
        more.push("its sign shows go".to_owned());
    }
    match robot.phase() {
        // In a session it is always locked.
        Phase::Idle => {
            let identity = match robot.identity() {
                Identity::Unlocked => "unlocked",
                Identity::Locked(_) => "locked",
                Identity::Expiring => "expiring",
            };
            let next = robot.next_number();
            more.push(format!("identity {identity}, next number {next}"));
        }
        Phase::Requesting(own) => {
            for offer in own.offers.iter() {
                more.push(format!(
                    "offer {} of {} for {}",
                    offer.number.0, offer.station, offer.capabilities
                ));
            }
        }
        Phase::Offering(own) => {
            more.push(format!("offer {} for {}", own.number.0, own.capabilities));
        }
        Phase::Leading(own) => {
            more.push(format!("corridor {}", own.corridor));
            more.extend(own.yields_to.map(|it| format!("yields to {it}")));
            more.extend(own.members.iter().map(member));
        }
        Phase::Following(own) => {
            more.push(match own.contact {
                Contact::Fresh(left) => format!("contact for {}", left_of(left)),
                Contact::Lost(left) => format!("contact lost, leaves in {}", left_of(left)),
            });
            more.extend(
                own.job
                    .map(|it| format!("{} {}: {}", it.request, it.task, it.progress)),
            );
            more.extend(
                own.refused
                    .map(|it| format!("refused {}: {}", it.request, it.reason)),
            );
        }
    }
    for more in more {
        let _ = writeln!(out, "    {more}");
    }
    out
}

pub(super) fn left_of(countdown: Countdown) -> String {
    countdown
        .left()
        .map_or_else(|| "ever".to_owned(), |left| left.to_string())
}

pub(super) fn member(of: &Member) -> String {
    let mut out = of.station.to_string();
    let echoed = of
        .echoed
        .map_or_else(|| "nothing".to_owned(), |it| it.to_string());
    let _ = write!(
        out,
        " has echoed {echoed}, next request {}",
        of.next_request
    );
    let _ = match of.lease {
        Lease::Stands(left) => write!(out, "; lease for {}", left_of(left)),
        Lease::Expired(left) => write!(out, "; no lease, kept for {}", left_of(left)),
    };
    if let Some(it) = of.outstanding {
        let left = left_of(it.acknowledgement);
        let _ = write!(
            out,
            "; outstanding {} {}, repeated {} times, again in {left}",
            it.request, it.task, it.repeats
        );
    }
    if let Some(it) = of.order {
        let progress = it
            .progress
            .map_or_else(|| "not reported".to_owned(), |it| it.to_string());
        let _ = write!(out, "; {} {}: {progress}", it.request, it.task);
        if let Some(left) = it.execution.left() {
            let _ = write!(out, ", for {left}");
        }
    }
    out
}

pub(super) fn name(station: StationId) -> String {
    let known = usize::try_from(station.0)
        .ok()
        .and_then(|i| i.checked_sub(1));
    known
        .and_then(|i| NAMES.get(i))
        .map_or_else(|| station.to_string(), |name| (*name).to_owned())
}
