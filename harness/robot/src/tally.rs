//! How a running robot is, at a glance: for a person who asks, and for metrics.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::time::{Duration, Instant};

use crossguard_codec::Service;
use crossguard_endpoint::cause::{Cause, Layer};
use crossguard_endpoint::counters::Counts;
use crossguard_protocol::{Corridor, Output, Outputs, Phase, Robot, StationId};

use crate::around::Around;
use crate::channel::ChannelState;
use crate::clock::ClockState;
use crate::sight::Sight;
use crate::trace::{Entry, Record};

/// The newest known of a robot, and how often what happened, from its records as they come.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// Its name.
    pub robot: String,
    /// Its state; `None` before it has booted.
    pub state: Option<Robot>,
    /// Messages by direction and kind.
    pub messages: BTreeMap<(Way, Service), u64>,
    /// Steps of the transition function.
    pub steps: u64,
    /// Dropped and ignored inputs, by cause.
    pub causes: Counts,
    /// The stations that were heard; no more than [`STATIONS`].
    pub heard: BTreeSet<StationId>,
    /// The people that its sensors have.
    pub sight: Sight,
    /// Road users on its map.
    pub around: Around,
    /// The radio channel, where the link measures it.
    pub channel: Option<ChannelState>,
    /// The boot counter that it started with, where its numbers do not tell it.
    pub boot: Option<u16>,
    /// Whether it trusts its clock, if it verifies what it hears.
    pub clock: Option<ClockState>,
    /// Where its link is, and whether packets are signed and verified; empty, if nobody has said so.
    pub link: String,
    /// The mode of security, likewise.
    pub security: &'static str,
    /// Until when its sign shows go. It ends although the robot hangs and nothing more is recorded.
    pub go_until: Option<Instant>,
}

/// The way of a message.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Way {
    /// It was sent.
    Sent,
    /// It was heard.
    Heard,
}

impl Way {
    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Sent => "sent",
            Self::Heard => "heard",
        }
    }
}

/// How many stations that were heard are counted.
pub const STATIONS: usize = 256;

impl Tally {
    /// Takes a record in.
    pub fn record(&mut self, record: &Record) {
        match &record.entry {
            Entry::Started {
                station,
                boot,
                epoch,
                ..
            } => {
                self.robot.clone_from(&record.robot);
                self.around = Around::default();
                self.state = Some(Robot::new(*station, epoch.unwrap_or(*boot)));
                self.boot = epoch.map(|_| *boot);
                self.clock = None;
                self.go_until = None;
            }
            Entry::Step { outputs, state, .. } => {
                self.steps += 1;
                if let Some(reason) = outputs.ignored() {
                    self.causes.add(&Cause::from(reason).into(), 1);
                }
                self.state = Some((**state).clone());
                self.sign(outputs);
            }
            Entry::Sent { message, .. } => self.message(Way::Sent, *message),
            Entry::Heard { message, from, .. } => {
                self.message(Way::Heard, *message);
                if self.heard.len() < STATIONS {
                    self.heard.insert(*from);
                }
            }
            Entry::Dropped { cause, .. } => {
                self.causes.add(cause, 1);
            }
            Entry::Unrecorded { counters } => {
                for (cause, count) in counters.iter() {
                    self.causes.add(&cause, count);
                }
            }
            Entry::Zone(_) | Entry::Hindered { .. } => {}
            Entry::Channel(channel) => self.channel = Some(*channel),
            Entry::Clock(clock) => self.clock = Some(*clock),
            Entry::People(sight) => self.sight.clone_from(sight),
            Entry::Around(around) => self.around.clone_from(around),
            Entry::Stopped { counters } => self.causes.clone_from(counters),
        }
    }

    fn sign(&mut self, outputs: &Outputs) {
        for output in outputs.iter() {
            match output {
                Output::CorridorOpened(time) | Output::CorridorExtended(time) => {
                    let time = Duration::from_millis(time.0.into());
                    self.go_until = Instant::now().checked_add(time);
                }
                Output::CorridorClosed(_) => self.go_until = None,
                _ => {}
            }
        }
    }

    fn message(&mut self, way: Way, kind: Service) {
        *self.messages.entry((way, kind)).or_default() += 1;
    }

    /// How many messages of each service went which way, in words: `3 CAM, 12 RAM`.
    #[must_use]
    pub fn services(&self, way: Way) -> String {
        let those = self.messages.iter().filter(|((it, _), _)| *it == way);
        let counted = those.map(|((_, kind), count)| format!("{count} {}", kind.name()));
        let counted: Vec<_> = counted.collect();
        if counted.is_empty() {
            return "nothing".to_owned();
        }
        counted.join(", ")
    }

    /// Other stations that were heard and road users around, for a person who asks.
    #[must_use]
    pub fn surroundings(&self) -> String {
        let mut text = format!(
            "sent {}; heard {} of {} stations; around: {}",
            self.services(Way::Sent),
            self.services(Way::Heard),
            self.heard.len(),
            self.around
        );
        let _ = write!(
            text,
            "; sees {} people, {} waiting, {} on the road",
            self.sight.people.len(),
            self.sight.waiting(),
            self.sight.on_road()
        );
        if let Some(clock) = self.untrusted_clock() {
            let _ = write!(text, "; {clock}");
        }
        text
    }

    /// Why it does not trust its clock, if it does not.
    #[must_use]
    pub fn untrusted_clock(&self) -> Option<ClockState> {
        self.clock.filter(|clock| !clock.is_trusted())
    }

    /// Its link, its security and its channel, for a person who asks.
    #[must_use]
    pub fn equipment(&self) -> String {
        let mut text = format!("link {}; security {}", self.link, self.security);
        let rejected = self.causes.total(|layer| layer == Layer::Security);
        let _ = write!(text, ", {rejected} rejected");
        let _ = match self.channel {
            None => write!(text, "; channel: nobody measures it"),
            Some(channel) => write!(text, "; {channel}"),
        };
        text
    }

    /// Whether the pedestrian may cross: the sign shows go now, whether the robot still runs or not.
    #[must_use]
    pub fn corridor_open(&self) -> bool {
        self.go_until.is_some_and(|until| Instant::now() < until)
    }

    /// Whether it has a duty on the road, or leads and waits for the road to be clear.
    #[must_use]
    pub fn is_on_duty(&self) -> bool {
        self.state.as_ref().is_some_and(|state| {
            let is_clearing = matches!(
                state.phase(),
                Phase::Leading(leading) if leading.corridor == Corridor::Clearing
            );
            is_clearing || state.duty().is_some()
        })
    }

    /// How many followers it leads.
    #[must_use]
    pub fn followers(&self) -> usize {
        match self.state.as_ref().map(Robot::phase) {
            Some(Phase::Leading(leading)) => leading.members.len(),
            _ => 0,
        }
    }
}
