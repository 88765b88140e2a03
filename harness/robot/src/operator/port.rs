//! The operator port: other programs tell a robot what a person would type, and hear what it does, by lines on a
//! socket. The lines are on the page `harness/doc/operator-port.md`.
//!
//! ```text
//!   journal ──► Desk ──► clients: acts, notices, state, map
//!   robot ◄─ orders ─┘ ◄── clients: events, commands, persons
//! ```
//!
//! It has a thread and a queue of records of its own. A client that does not read loses its connection, and one that
//! says nonsense is told so; the robot waits for neither.

mod lines;

use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::thread::JoinHandle;
use std::time::Duration;

use crossguard_endpoint::Stimulus;
use crossguard_endpoint::cause::{Cause, Layer};
use crossguard_endpoint::counters::CauseName;
use crossguard_protocol::{Availability, Event, HelpRequest, Input, Output, OutputKind, Robot};
use serde_json::{Map, Value};

use self::lines::{Fields, ToOperator, condition, said};
use super::{Line, Turns, parse};
use crate::perception::{self, Feed, OF_SOURCE, Observation, Taken, instant_of};
use crate::port::{Heard, Listening, Stream};
use crate::runtime::{Clock, Order, Orders};
use crate::site::Site;
use crate::trace::{Entry, Record};

/// The version that both sides say in `hello`.
pub const VERSION: u64 = 1;

/// How many clients there can be at a time.
const CLIENTS: usize = 8;

/// How often the state is told at least.
const BEAT_US: u64 = 100_000;

/// How long a client may take to say hello.
const GREETING_US: u64 = 5_000_000;

/// How long the thread waits for a record before it looks at the clients.
const TICK: Duration = Duration::from_millis(10);

/// How many lines are taken in at a time.
const LINES_AT_A_TIME: usize = 16;

/// How soon a person does not say again what only a person says.
const AGAIN_US: u64 = 3_000_000;

/// The place of `available` among the words that only a person says.
const AVAILABLE: usize = 2;

/// Facts of a robot besides its records, and the context of command words.
#[derive(Clone, Debug)]
pub struct Desk {
    /// Its name.
    pub robot: String,
    /// Its station id.
    pub station: u32,
    /// Its boot counter.
    pub boot: u16,
    /// Whether what comes over a ROS graph, which nobody signs, may reach it.
    pub trusts_ros_graph: bool,
    /// Where places are.
    pub site: Site,
    /// Request of `detect` alone.
    pub planned: Option<HelpRequest>,
    /// The feed that tells the robot of people as well: its sources are no program's at the port.
    pub feed: Option<Feed>,
}

impl Desk {
    /// Serves clients in a thread of its own, which ends with the robot whose `records` these are.
    #[must_use]
    pub fn serve(
        self,
        port: Listening,
        records: Receiver<Arc<Record>>,
        orders: Orders,
        clock: Clock,
    ) -> JoinHandle<()> {
        std::thread::spawn(move || {
            let mut counter = Counter::new(self, orders);
            counter.turns.last_us = clock.now_us();
            loop {
                let record = records.recv_timeout(TICK);
                let now_us = clock.now_us();
                counter.wake(now_us);
                match record {
                    Ok(record) => counter.record(&record, now_us),
                    Err(RecvTimeoutError::Timeout) => {}
                    Err(RecvTimeoutError::Disconnected) => return counter.close(),
                }
                for heard in port.heard.try_iter().take(LINES_AT_A_TIME) {
                    counter.hear(heard, now_us);
                }
                counter.elapse(now_us);
            }
        })
    }
}

/// Takes orders of a robot: the robot itself, or a test.
trait Obeys {
    fn order(&self, order: Order);
}

impl Obeys for Orders {
    fn order(&self, order: Order) {
        self.give(order);
    }
}

/// A client, from its connection on.
struct Client {
    stream: Stream,
    since_us: u64,
    /// How many lines it has said.
    lines: u64,
    has_greeted: bool,
}

/// The desk, open.
struct Counter<O> {
    desk: Desk,
    orders: O,
    clients: BTreeMap<u64, Client>,
    robot: Option<Robot>,
    /// State that was told last, and when.
    told: Option<(Fields, u64)>,
    /// Until when the pedestrian may cross, by the leases that stand.
    go_ends_us: u64,
    turns: Turns,
    /// When a person said each of these last.
    said_us: [Option<u64>; 3],
    /// The connection that said the newest frame of each sensor source, and when.
    sources: BTreeMap<u8, (u64, u64)>,
}

impl<O: Obeys> Counter<O> {
    fn new(desk: Desk, orders: O) -> Self {
        Self {
            desk,
            orders,
            clients: BTreeMap::new(),
            robot: None,
            told: None,
            go_ends_us: 0,
            turns: Turns::default(),
            said_us: [None; 3],
            sources: BTreeMap::new(),
        }
    }

    /// A turn begins. Where lines may have waited, the connections end, and with them the lines.
    fn wake(&mut self, now_us: u64) {
        if self.turns.begin(now_us) {
            for client in std::mem::take(&mut self.clients).into_values() {
                self.send_away(client.stream);
            }
        }
    }

    fn send_away(&self, mut stream: Stream) {
        let why = "the robot was held: what was said meanwhile is dropped".to_owned();
        // A program that does not hear it sees that the connection ends.
        let _ = stream.say(&ToOperator::Refused { line: 0, why });
        stream.close();
        self.count(Cause::OperatorHeld, "what a program said may have waited");
    }

    fn record(&mut self, record: &Record, now_us: u64) {
        let at_us = record.at_us;
        match &record.entry {
            Entry::Step {
                input,
                outputs,
                state,
            } => {
                for output in outputs.iter() {
                    self.output(at_us, input, output);
                }
                let was_available = self.robot.as_ref().is_none_or(is_available);
                if was_available && !is_available(state) {
                    self.said_us[AVAILABLE] = Some(at_us);
                }
                self.robot = Some((**state).clone());
                self.tell_state(now_us, false);
            }
            Entry::Around(around) => self.tell(&ToOperator::Map { at_us, around }),
            Entry::Dropped { cause, detail, .. }
                if cause.layer != Layer::Simulated && !cause.is_own_packet() =>
            {
                self.tell_dropped(at_us, cause, detail, 1);
            }
            Entry::Unrecorded { counters } => {
                for (cause, count) in counters.iter() {
                    self.tell_dropped(at_us, &cause, "", count);
                }
            }
            Entry::Hindered { why } => self.tell(&ToOperator::Hindered { at_us, why }),
            Entry::Stopped { .. } => self.tell(&ToOperator::Stopped { at_us }),
            _ => {}
        }
    }

    fn tell_dropped(&mut self, at_us: u64, cause: &CauseName, detail: &str, count: u64) {
        self.tell(&ToOperator::Dropped {
            at_us,
            layer: cause.layer,
            cause: &cause.reason,
            detail,
            count,
        });
    }

    fn output(&mut self, at_us: u64, input: &Input, output: &Output) {
        match output {
            Output::CorridorOpened(left) | Output::CorridorExtended(left) => {
                self.go_ends_us = at_us + u64::from(left.0) * 1_000;
            }
            _ => {}
        }
        let line = match (output.kind(), input) {
            (OutputKind::Ignored, Input::Local(event)) => {
                let event = event.kind().name();
                let said = said(output);
                ToOperator::Ignored { at_us, event, said }
            }
            (OutputKind::SendRam | OutputKind::SendRmcm | OutputKind::Ignored, _) => return,
            (OutputKind::Notify, _) => ToOperator::Notice {
                at_us,
                said: said(output),
            },
            (kind, _) => ToOperator::Act {
                at_us,
                output: kind.name(),
                said: said(output),
            },
        };
        self.tell(&line);
    }

    fn hear(&mut self, heard: Heard, now_us: u64) {
        match heard {
            Heard::Connected(_, mut stream) if self.clients.len() >= CLIENTS => {
                let why = format!("{CLIENTS} programs are connected already");
                // A program that does not hear it sees that the connection ends.
                let _ = stream.say(&ToOperator::Refused { line: 0, why });
                stream.close();
                self.count(Cause::OperatorsFull, "a program more than can be connected");
            }
            Heard::Connected(_, stream) if now_us < self.turns.waited_until_us => {
                self.send_away(stream);
            }
            Heard::Connected(number, mut stream) => {
                // A program that does not take it is gone when the next line is told.
                let _ = stream.say(&ToOperator::Hello {
                    crossguard: VERSION,
                    robot: &self.desk.robot,
                    station: self.desk.station,
                    boot: self.desk.boot,
                    trusts_ros_graph: self.desk.trusts_ros_graph,
                });
                self.clients.insert(
                    number,
                    Client {
                        stream,
                        since_us: now_us,
                        lines: 0,
                        has_greeted: false,
                    },
                );
            }
            Heard::Line(number, line) => self.hear_line(number, Ok(&line), now_us),
            Heard::Unread(number, why) => self.hear_line(number, Err(why), now_us),
            Heard::Stranger(_) => self.count(Cause::OperatorStranger, "refused"),
            Heard::Closed(number) => {
                if let Some(client) = self.clients.remove(&number) {
                    client.stream.close();
                }
            }
        }
    }

    fn hear_line(&mut self, number: u64, line: Result<&str, &str>, now_us: u64) {
        let Some(client) = self.clients.get_mut(&number) else {
            return;
        };
        client.lines += 1;
        let nth = client.lines;
        let mut cause = Cause::OperatorGarbled;
        let outcome = match line {
            Ok(line) if client.has_greeted => match self.understand(line) {
                Ok(Some(order)) if self.is_said_again(&order, now_us) => {
                    cause = Cause::OperatorRepeats;
                    Err("it was said just now, or a stop has just begun: look first, and say it again after 3 s".to_owned())
                }
                Ok(Some(Order::Looked(frame, _)))
                    if self.is_of_another(frame.source, number, now_us) =>
                {
                    cause = Cause::FrameDropped("source of another program");
                    Err(format!(
                        "another program says the frames of source {}: give each detector a 'source' of its own",
                        frame.source
                    ))
                }
                understood => {
                    understood.map(|order| order.into_iter().for_each(|it| self.orders.order(it)))
                }
            },
            Ok(line) => {
                let greeting = greeting(line);
                client.has_greeted = greeting.is_ok();
                greeting.map(|()| self.tell_state(now_us, true))
            }
            Err(why) => Err(why.to_owned()),
        };
        let Err(why) = outcome else { return };
        self.count(cause, "a line at the operator port");
        if may_be_frame(line) {
            self.orders.order(Order::LookedInVain(why.clone()));
        }
        let refused = ToOperator::Refused { line: nth, why };
        let Some(client) = self.clients.get_mut(&number) else {
            return;
        };
        let said = client.stream.say(&refused);
        if said.is_err() || !client.has_greeted {
            self.dismiss(number, said.err().as_ref().and_then(slowness));
        }
    }

    /// Whether a person just said this, who has to look before they say it again. Said on and on, it would take guards off
    /// the road, or end a stop, in the moment in which that begins. A stop of one operator is not ended at once by another.
    fn is_said_again(&mut self, order: &Order, now_us: u64) -> bool {
        let place = match order {
            Order::Clear => 0,
            Order::Tell(Stimulus::Event(Event::TaskCompleted)) => 1,
            Order::Tell(Stimulus::Event(Event::AvailabilityChanged(Availability::Available))) => {
                AVAILABLE
            }
            _ => return false,
        };
        let last_us = self.said_us[place].replace(now_us);
        last_us.is_some_and(|last_us| now_us.saturating_sub(last_us) < AGAIN_US)
    }

    /// Whether another connection, or the feed, says the frames of this source now. Frames of two detectors would count as those of
    /// one detector: the kit would drop those whose clock is behind, with their people.
    fn is_of_another(&mut self, source: u8, number: u64, now_us: u64) -> bool {
        let newest = self.sources.get(&source);
        let is_said = newest.is_some_and(|(of, at_us)| {
            let age = Duration::from_micros(now_us.saturating_sub(*at_us));
            *of != number && age < OF_SOURCE && self.clients.contains_key(of)
        });
        let is_taken = is_said || self.desk.feed.as_ref().is_some_and(|feed| feed.has(source));
        if !is_taken {
            self.sources.insert(source, (number, now_us));
        }
        is_taken
    }

    /// Order of a line to the robot, or why the line means nothing.
    fn understand(&self, line: &str) -> Result<Option<Order>, String> {
        let text = |error: serde_json::Error| error.to_string();
        let mut fields: Map<String, Value> = serde_json::from_str(line).map_err(text)?;
        let kind = fields.remove("type");
        match kind.as_ref().and_then(Value::as_str) {
            Some("event") => {
                let event = fields.remove("event").unwrap_or_default();
                order_of(serde_json::from_value(event).map_err(text)?).map(Some)
            }
            Some("command") => {
                let line = fields.get("line").and_then(Value::as_str);
                let line = line.ok_or("a command wants a 'line'")?;
                match parse(line, &self.desk.site, self.desk.planned) {
                    Ok(Line::Order(order)) => Ok(Some(order)),
                    Ok(Line::Quit) => Ok(Some(Order::Stop)),
                    Ok(Line::Blank) => Ok(None),
                    Ok(_) => Err(format!("'{line}' is for the console")),
                    Err(error) => Err(error.to_string()),
                }
            }
            Some("person") => match perceived(fields)? {
                Observation::Person(vru, None) => Ok(Some(Order::Perceived(vru))),
                _ => Err("a person without at_s is wanted".to_owned()),
            },
            Some("frame") => match perceived(fields)? {
                Observation::Frame(frame, Taken::Unix(unix_s)) => {
                    let taken = instant_of(unix_s)?;
                    Ok(Some(Order::Looked(Arc::new(frame), taken)))
                }
                _ => Err("a frame with unix_s is wanted".to_owned()),
            },
            Some("hello") => Ok(None),
            _ => Err("a 'type' is wanted: event, command, frame or person".to_owned()),
        }
    }

    /// Lets time pass: tells the state again, and sends those away who never said hello.
    fn elapse(&mut self, now_us: u64) {
        if self
            .told
            .as_ref()
            .is_some_and(|(_, at_us)| now_us.saturating_sub(*at_us) >= BEAT_US)
        {
            self.tell_state(now_us, true);
        }
        let is_mute =
            |it: &Client| !it.has_greeted && now_us.saturating_sub(it.since_us) >= GREETING_US;
        let mute: Vec<_> = self.clients.iter().filter(|(_, it)| is_mute(it)).collect();
        let mute: Vec<_> = mute.into_iter().map(|(number, _)| *number).collect();
        for number in mute {
            self.dismiss(number, Some(Cause::OperatorGarbled));
        }
    }

    /// Tells how the robot is, if that is news or wanted `anyway`.
    fn tell_state(&mut self, now_us: u64, anyway: bool) {
        let Some(robot) = &self.robot else { return };
        let now = condition(robot);
        let is_news = self.told.as_ref().is_none_or(|it| it.0 != now);
        if !is_news && !anyway {
            return;
        }
        let left_ms = self.go_ends_us.saturating_sub(now_us) / 1_000;
        let open_ms = (now["corridor"] == "open" && left_ms > 0).then_some(left_ms);
        self.tell(&ToOperator::State {
            at_us: now_us,
            open_ms,
            now: &now,
        });
        self.told = Some((now, now_us));
    }

    /// Tells everybody who has said hello.
    fn tell(&mut self, line: &ToOperator<'_>) {
        let mut lost = Vec::new();
        for (number, client) in &mut self.clients {
            if client.has_greeted
                && let Err(error) = client.stream.say(line)
            {
                lost.push((*number, slowness(&error)));
            }
        }
        for (number, cause) in lost {
            self.dismiss(number, cause);
        }
    }

    fn dismiss(&mut self, number: u64, cause: Option<Cause>) {
        if let Some(client) = self.clients.remove(&number) {
            client.stream.close();
            if let Some(cause) = cause {
                self.count(cause, "a program at the operator port is sent away");
            }
        }
    }

    /// Has the robot count what went wrong here.
    fn count(&self, cause: Cause, detail: &'static str) {
        self.orders.order(Order::Count(cause, detail));
    }

    fn close(self) {
        for client in self.clients.values() {
            client.stream.close();
        }
    }
}

fn is_available(robot: &Robot) -> bool {
    robot.availability() == Availability::Available
}

/// Whether a line that means nothing may have been of a sensor source, so that somebody may have been in it.
fn may_be_frame(line: Result<&str, &str>) -> bool {
    let line = line.map(serde_json::from_str::<Value>);
    let Ok(Ok(line)) = line else { return true };
    !matches!(line["type"].as_str(), Some("event" | "command" | "hello"))
}

/// What a client did wrong that does not take a line: nothing, if it has gone away.
fn slowness(error: &std::io::Error) -> Option<Cause> {
    (error.kind() == ErrorKind::WouldBlock).then_some(Cause::OperatorSlow)
}

/// Whether a first line is what it has to be.
fn greeting(line: &str) -> Result<(), String> {
    let hello: Value = serde_json::from_str(line).map_err(|error| error.to_string())?;
    match (hello["type"].as_str(), hello["crossguard"].as_u64()) {
        (Some("hello"), Some(VERSION)) => Ok(()),
        (Some("hello"), Some(version)) => {
            Err(format!("version {version}: {VERSION} is spoken here"))
        }
        _ => Err("the first line has to be {\"type\": \"hello\", \"crossguard\": 1}".to_owned()),
    }
}

/// Observation of people in the other fields of a line.
fn perceived(fields: Map<String, Value>) -> Result<Observation, String> {
    perception::parse(&Value::Object(fields).to_string()).map_err(|error| error.to_string())
}

/// Order of an event to a robot. Some events are for the kit alone.
pub(super) fn order_of(event: Event) -> Result<Order, String> {
    Ok(match event {
        Event::RoadClear => Order::Clear,
        Event::CommandManeuver { follower, task } => Order::Tell(Stimulus::Command {
            follower,
            task,
            parameters: crossguard_codec::TaskParameters::default(),
        }),
        Event::AllAnswered | Event::IdentityChanged(..) | Event::EpochRenewed(_) => {
            return Err(format!("'{}' is for the kit alone", event.kind().name()));
        }
        event => Order::Tell(Stimulus::Event(event)),
    })
}

#[cfg(test)]
mod tests;
