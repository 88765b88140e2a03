//! What a node tells: when, and what it says of a robot that it does not know well enough.

use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use crossguard_protocol::{self as protocol, Availability, Unavailability};
use crossguard_robot::application::Wish;
use crossguard_robot::runtime::Order;

use super::{CORRIDOR_PERIOD, CORRIDOR_VALID_FOR, STATUS_PERIOD, Turn};
use crate::acts::{self, Taken};
use crate::graph::{RosError, now_ns};
use crate::msgs::{Corridor, Event, Status};
use crate::report::{OK, SITE_FRAME, WARN, duration, header, value};
use crate::robot::{Active, BodyKind};
use crate::standard::{DiagnosticArray, DiagnosticStatus, TransitionEvent};

impl Turn {
    /// Whether what is known of the robot is no older than this.
    pub(super) fn is_known_for(&self, at_most: Duration) -> bool {
        match (&self.active, &self.reporter) {
            (Some(active), Some(reporter)) => active.age(reporter.known_us()) <= at_most,
            _ => false,
        }
    }

    /// Whether the corridor is known. In a session a robot takes a step with every RAM.
    pub(super) fn is_fresh(&self) -> bool {
        let file = self.file.as_ref();
        let period_ms = file.map_or(0, |file| file.config.settings().ram_period.0);
        let three = Duration::from_millis(u64::from(period_ms) * 3);
        self.is_known_for(three.max(CORRIDOR_VALID_FOR))
    }

    pub(super) fn corridor(&self) -> Corridor {
        let header = header(now_ns(), "");
        match &self.reporter {
            Some(reporter) if self.active.is_some() => {
                let now_us = self.active.as_ref().map_or(u64::MAX, Active::now_us);
                reporter.corridor(header, CORRIDOR_VALID_FOR, now_us, self.is_fresh())
            }
            _ => Corridor {
                header,
                station: self.file.as_ref().map_or(0, |file| file.station.0),
                valid_for: duration(CORRIDOR_VALID_FOR),
                reason: Corridor::REASON_INACTIVE,
                text: format!("the node is {}", self.lifecycle.state().label()),
                ..Corridor::default()
            },
        }
    }

    pub(super) fn status(&self) -> Status {
        let header = header(now_ns(), "");
        match &self.reporter {
            Some(reporter) => reporter.status(header),
            None => Status {
                header,
                ..Status::default()
            },
        }
    }

    pub(super) fn tell_what_is_due(&mut self) {
        let now = Instant::now();
        if now >= self.corridor_due {
            self.tell_corridor();
        }
        if now >= self.status_due {
            self.tell_status();
            self.tell_diagnostics();
        }
    }

    pub(super) fn tell_corridor(&mut self) {
        let corridor = self.corridor();
        let told = self.told.corridor.publish(&corridor);
        self.corridor_before = corridor;
        self.corridor_due = Instant::now() + CORRIDOR_PERIOD;
        self.note(told);
    }

    pub(super) fn tell_status(&mut self) {
        let status = self.status();
        let told = self.told.status.publish(&status);
        self.status_before = status;
        self.status_due = Instant::now() + STATUS_PERIOD;
        self.note(told);
    }

    pub(super) fn tell_event(&mut self, event: Event) {
        let told = self.publish_event(event);
        self.note(told);
    }

    fn publish_event(&self, event: Event) -> Result<(), RosError> {
        self.told.event.publish(&Event {
            header: header(now_ns(), SITE_FRAME),
            ..event
        })
    }

    /// Publishes what the robot does and tells. What the body is to do and cannot be published is not done, and
    /// so a fault of a body that others move.
    pub(super) fn tell_acts(&mut self) {
        while let Some(act) = self.acts.as_ref().and_then(Taken::next) {
            let Some(file) = &self.file else { return };
            let Some(event) = acts::event(&act, &file.site) else {
                continue;
            };
            let told = self.publish_event(event);
            let is_external = self.robot.body == BodyKind::External;
            if told.is_err()
                && is_external
                && acts::is_of_body(&act)
                && let Some(active) = &self.active
            {
                let fault = Availability::Unavailable(Unavailability::LocalFault);
                let wish = Wish::Tell(protocol::Event::AvailabilityChanged(fault));
                active.order(Order::Wish(wish));
            }
            self.note(told);
        }
    }

    pub(super) fn tell_transition(&mut self, event: TransitionEvent) {
        tracing::info!(
            from = event.start_state.label,
            to = event.goal_state.label,
            "lifecycle"
        );
        let told = self.told.transition_event.publish(&TransitionEvent {
            timestamp: u64::try_from(now_ns()).unwrap_or_default(),
            ..event
        });
        self.note(told);
    }

    pub(super) fn tell_diagnostics(&mut self) {
        let name = self.node.name().full();
        // Outside of sessions, a RAM goes out each second.
        let is_fresh = self.is_known_for(STATUS_PERIOD * 3);
        let mut status = vec![self.diagnostic(&name)];
        if let (Some(reporter), true) = (&mut self.reporter, self.active.is_some()) {
            status.push(reporter.diagnostic(format!("{name}: robot"), is_fresh));
        }
        let told = self.told.diagnostics.publish(&DiagnosticArray {
            header: header(now_ns(), ""),
            status,
        });
        self.note(told);
    }

    /// How the node itself is.
    pub(super) fn diagnostic(&self, name: &str) -> DiagnosticStatus {
        let count = |(cause, count): (&&'static str, &u64)| ((*cause).to_owned(), *count);
        let full = (
            "ros: inbox full".to_owned(),
            self.door.full.load(Ordering::Relaxed),
        );
        let lost = (
            "ros: events full".to_owned(),
            self.acts.as_ref().map_or(0, Taken::lost),
        );
        let inbox = self
            .active
            .as_ref()
            .map(|active| ("inbox: full".to_owned(), active.inbox_full()));
        let counted: Vec<_> = self
            .causes
            .iter()
            .map(count)
            .chain([full, lost])
            .chain(inbox)
            .collect();
        let dropped: u64 = counted.iter().map(|(_, count)| count).sum();
        DiagnosticStatus {
            level: if dropped == 0 { OK } else { WARN },
            name: name.to_owned(),
            message: match dropped {
                0 => self.lifecycle.state().label().to_owned(),
                _ => format!("{}; {dropped} dropped", self.lifecycle.state().label()),
            },
            hardware_id: self
                .file
                .as_ref()
                .map_or_else(String::new, |file| file.name.clone()),
            values: counted.into_iter().map(value).collect(),
        }
    }

    pub(super) fn note(&mut self, told: Result<(), RosError>) {
        if let Err(error) = told {
            self.count("ros: not published", &error.to_string());
        }
    }
}
