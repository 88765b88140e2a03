//! A sequence chart, line by line as things happen.
//!
//! Each robot has a column. A message is drawn where it was sent, in one line for all who hear it soon after; of the RAM
//! that repeat what is known only the first is drawn. The order is that of cause and effect: a message goes before what
//! its sender does next, and go before the people who see it. A line begins each of the paper's five stages
//! (section III-A): the rows below it belong to that.

mod gather;
mod lines;
mod words;

use std::collections::HashMap;
use std::fmt::Write as _;
use std::hash::{DefaultHasher, Hash, Hasher};

use crossguard_codec::{Heard, Identifiers, Service};
use crossguard_endpoint::cause::Layer;
use crossguard_model_check::names::Names;
use crossguard_protocol::{
    Coordination, Event, Heartbeat, Input, Output, Outputs, Ram, Rmcm, Robot, Role, State,
    StationId,
};

use crossguard_endpoint::station::listen::overhear;
use crossguard_robot::trace::{Entry, Record};

use crate::seconds;
use gather::{Arrow, ArrowHead, Gathering, Mark};
use lines::LEFT;
pub use words::text_of;
use words::{SHOWS_NOTHING, note_of_input, note_of_output, people, road_users, said_in, shown_in};

/// How far apart columns are, of two robots and of more.
const SPACING: usize = 50;
const SPACING_OF_MANY: usize = 45;

/// The paper's stages (section III-A), the first of which is number 1.
const STAGES: [&str; 5] = [
    "Initialization",
    "Help Establishment",
    "Role Assignment",
    "Maneuver Execution",
    "Termination",
];

/// Closer together, the text of an arrow cannot be read.
const SPACING_MIN: usize = 22;

/// A chart in the making.
#[derive(Debug, Default)]
pub struct Chart {
    /// How far apart columns are.
    spacing: usize,
    /// How long a line may be; 0 for any length.
    width: usize,
    lanes: Vec<Lane>,
    /// Names of stations, including those before a change of identity.
    names: Names,
    /// Whether robots get columns as they turn up in the records.
    grows: bool,
    /// The newest RAM that was drawn, without what changes with every RAM, by sender and receiver.
    drawn: HashMap<(usize, usize), Ram>,
    /// Which of the paper's stages it has come to, from 1; 0 before the first.
    stage: usize,
    gathering: Gathering,
    /// Acts of people who see a sign show go, before the record says so.
    on_go: Vec<(u64, Mark)>,
}

#[derive(Debug)]
struct Lane {
    name: String,
    station: StationId,
    state: State,
    role: Role,
    identifiers: Identifiers,
    /// Whether nothing is known of it but what others hear.
    is_stranger: bool,
    /// Until when its sign shows go, if it does.
    go_until_us: Option<u64>,
    /// Notes of its last step that come after a message which it is about to send, each with its time.
    held: Vec<(u64, Mark)>,
    /// The last note about the people that its sensors see.
    people: String,
    /// The last note about the road users that it hears.
    road_users: String,
    /// The last note about what it shows to people.
    shown: String,
}

impl Lane {
    fn new(name: String, station: StationId, identifiers: Identifiers) -> Self {
        Self {
            name,
            station,
            state: State::Idle,
            role: Role::None,
            identifiers,
            is_stranger: false,
            go_until_us: None,
            held: Vec::new(),
            people: String::new(),
            road_users: String::new(),
            shown: SHOWS_NOTHING.to_owned(),
        }
    }
}

/// By how much records of different robots may come out of order, in microseconds.
const DISORDER_US: u64 = 100_000;

impl Chart {
    /// A chart of robots with these names and station ids, from left to right.
    #[must_use]
    pub fn new(robots: &[(&str, StationId)], identifiers: Identifiers) -> Self {
        let lane =
            |&(name, station): &(&str, StationId)| Lane::new(name.to_owned(), station, identifiers);
        Self {
            spacing: if robots.len() > 2 {
                SPACING_OF_MANY
            } else {
                SPACING
            },
            lanes: robots.iter().map(lane).collect(),
            names: robots.iter().map(|(name, id)| (*id, *name)).collect(),
            ..Self::default()
        }
    }

    /// A chart of the robots that turn up in the records, and of the stations that they hear.
    #[must_use]
    pub fn growing() -> Self {
        Self {
            spacing: SPACING,
            grows: true,
            ..Self::default()
        }
    }

    /// The same chart, whose lines are at most `width` characters long: columns are closer together, and texts
    /// that do not fit are cut. `None` where the robots' columns would be too narrow to be read.
    #[must_use]
    pub fn within(mut self, width: usize) -> Option<Self> {
        let room = width.saturating_sub(LEFT) / self.lanes.len().max(1);
        self.spacing = self.spacing.min(room);
        self.width = width;
        (self.spacing >= SPACING_MIN).then_some(self)
    }

    /// The same chart with a column for a station that keeps no log.
    #[must_use]
    pub fn with_stranger(mut self, name: &str, station: StationId) -> Self {
        self.names.set(station, name);
        self.lanes.push(Lane {
            is_stranger: true,
            ..Lane::new(name.to_owned(), station, Identifiers::default())
        });
        self
    }

    /// The same chart with sessions, commands and stations as logs have them.
    #[must_use]
    pub fn with_short_ids(mut self) -> Self {
        self.names = Names::short();
        self
    }

    fn fit(&self, line: String) -> String {
        if self.width == 0 || line.chars().count() <= self.width {
            return line;
        }
        line.chars().take(self.width - 1).chain(['…']).collect()
    }

    /// The line above the chart.
    #[must_use]
    pub fn header(&self) -> String {
        let mut line = format!("{:>8}", "t/s");
        for (i, lane) in self.lanes.iter().enumerate() {
            lines::pad(&mut line, LEFT + i * self.spacing);
            let _ = write!(line, "{} (station {})", lane.name, lane.station);
        }
        self.fit(line)
    }

    /// Adds something that happens to a robot and that it does not record itself.
    pub fn note(&mut self, at_us: u64, robot: &str, text: &str) -> Vec<String> {
        let note = self.note_at(robot, text);
        if let Some(note) = note {
            self.gathering.add(at_us, note);
        }
        let marks = self.due(at_us);
        self.drawn(marks)
    }

    /// Adds what somebody does who sees a sign show go. The record of it may be read later, and goes before.
    pub fn note_on_go(&mut self, at_us: u64, robot: &str, text: &str) -> Vec<String> {
        let note = self.note_at(robot, text);
        self.on_go.extend(note.map(|note| (at_us, note)));
        self.go_on(at_us);
        let marks = self.due(at_us);
        self.drawn(marks)
    }

    /// Marks that are complete at this time, with names.
    fn due(&mut self, at_us: u64) -> Vec<(u64, Mark)> {
        let due = self.gathering.due(at_us);
        self.all_named(due)
    }

    fn named(&self, mut mark: Mark) -> Mark {
        let (Mark::Note { text, .. } | Mark::Arrow(Arrow { text, .. })) = &mut mark;
        *text = self.names.tell(&*text);
        mark
    }

    fn all_named(&self, marks: Vec<(u64, Mark)>) -> Vec<(u64, Mark)> {
        let marks = marks.into_iter();
        marks
            .map(|(at_us, mark)| (at_us, self.named(mark)))
            .collect()
    }

    fn note_at(&self, robot: &str, text: &str) -> Option<Mark> {
        let (lane, text) = (self.lane_named(robot)?, text.to_owned());
        Some(Mark::Note { lane, text })
    }

    fn lane_named(&self, robot: &str) -> Option<usize> {
        self.lanes.iter().position(|lane| lane.name == robot)
    }

    /// Adds what people do who see go, if a record says that a sign shows it.
    fn go_on(&mut self, record_us: u64) {
        if self.lanes.iter().any(|lane| lane.go_until_us.is_some()) {
            for (at_us, note) in self.on_go.drain(..) {
                self.gathering.add(at_us.max(record_us), note);
            }
        }
    }

    fn drawn(&self, marks: Vec<(u64, Mark)>) -> Vec<String> {
        let line = |(at_us, mark)| {
            let seconds = seconds(at_us);
            self.fit(match mark {
                Mark::Note { lane, text } => {
                    lines::note(seconds, LEFT + lane * self.spacing, &text)
                }
                Mark::Arrow(Arrow { from, to, text, .. }) => {
                    lines::arrow(seconds, from, &to, self.spacing, &text)
                }
            })
        };
        marks.into_iter().map(line).collect()
    }

    /// The lines that are complete when a record comes: those of up to then, but for the last moments.
    pub fn lines(&mut self, record: &Record) -> Vec<String> {
        let at_us = record.at_us;
        let lane = self.lane_named(&record.robot);
        let held = lane.map(|lane| std::mem::take(&mut self.lanes[lane].held));
        let held = held.unwrap_or_default().into_iter().map(|(_, mark)| mark);
        let sent = self.sent(record);
        let ended = self.signs_that_ended(record);
        let (now, after) = self.marks_of(record);
        // The outputs of a step after a message come after that message.
        let (before, behind) = match record.entry {
            Entry::Sent { .. } => (now, held.collect()),
            _ => (held.collect(), now),
        };
        for mark in sent.into_iter().chain(ended).chain(before).chain(behind) {
            self.gathering.add(at_us, mark);
        }
        if let Some(lane) = lane {
            self.lanes[lane].held = after.into_iter().map(|mark| (at_us, mark)).collect();
        }
        self.go_on(at_us);
        let marks = self.due(at_us);
        self.drawn(marks)
    }

    /// The lines that have not been complete so far.
    pub fn rest(&mut self) -> Vec<String> {
        let held = self.lanes.iter_mut().flat_map(|lane| lane.held.drain(..));
        for (at_us, mark) in held.chain(self.on_go.drain(..)) {
            self.gathering.add(at_us, mark);
        }
        let rest = self.gathering.rest();
        let marks = self.all_named(rest);
        self.drawn(marks)
    }

    /// The notes that a record adds at its robot, by itself.
    #[cfg(feature = "full")]
    pub(crate) fn notes(&mut self, record: &Record) -> Vec<String> {
        let ended = self.signs_that_ended(record);
        let (now, after) = self.marks_of(record);
        let own = self.lane_named(&record.robot);
        let notes = ended.into_iter().chain(now).chain(after);
        let notes = notes.filter_map(|mark| match mark {
            Mark::Note { lane, text } if Some(lane) == own => Some(self.names.tell(&text)),
            Mark::Note { .. } | Mark::Arrow(_) => None,
        });
        notes.collect()
    }

    /// A message on its way: it is drawn where it was sent if it is heard soon.
    fn sent(&self, record: &Record) -> Option<Mark> {
        let Entry::Sent { octets, .. } = &record.entry else {
            return None;
        };
        let from = self.lane_named(&record.robot)?;
        let heard = overhear(&self.lanes[from].identifiers, octets).ok()?;
        Some(arrow(from, Vec::new(), &heard))
    }

    /// The signs that went to stop by themselves before a record: nothing has renewed them.
    fn signs_that_ended(&mut self, record: &Record) -> Vec<Mark> {
        let mut marks = Vec::new();
        for (i, lane) in self.lanes.iter_mut().enumerate() {
            let slack_us = if lane.name == record.robot {
                0
            } else {
                DISORDER_US
            };
            let ended = lane
                .go_until_us
                .filter(|go| go.saturating_add(slack_us) < record.at_us);
            if let Some(at_us) = ended {
                lane.go_until_us = None;
                let at_s = seconds(at_us);
                marks.push(Mark::Note {
                    lane: i,
                    text: format!("! the sign went to stop by itself at {at_s:.3}"),
                });
            }
        }
        marks
    }

    /// Keeps until when a sign shows go.
    fn keep_sign(&mut self, lane: usize, at_us: u64, outputs: &Outputs) {
        for output in outputs.iter() {
            match output {
                Output::CorridorOpened(time) | Output::CorridorExtended(time) => {
                    let time_us = u64::from(time.0) * 1_000;
                    self.lanes[lane].go_until_us = Some(at_us.saturating_add(time_us));
                }
                Output::CorridorClosed(_) => self.lanes[lane].go_until_us = None,
                _ => {}
            }
        }
    }

    /// Marks of a record, and those of them that come after the message that the robot is about to send.
    fn marks_of(&mut self, record: &Record) -> (Vec<Mark>, Vec<Mark>) {
        let mut after = Vec::new();
        if let Entry::Started {
            station,
            identifiers,
            ..
        } = &record.entry
        {
            self.seat(&record.robot, *station, *identifiers);
        }
        let Some(lane) = self.lane_named(&record.robot) else {
            return (Vec::new(), after);
        };
        let note = |text| Mark::Note { lane, text };
        let now = match &record.entry {
            Entry::Step {
                input,
                outputs,
                state,
            } => {
                if let Input::Local(Event::IdentityChanged(station, _)) = input {
                    self.names.set(*station, &record.robot);
                    self.lanes[lane].station = *station;
                }
                self.keep_sign(lane, record.at_us, outputs);
                let mut now = self.stages_begun(lane, outputs, state);
                now.extend(note_of_input(input).map(note));
                let mut to = &mut now;
                for output in outputs.iter() {
                    if matches!(output, Output::SendRmcm(_)) {
                        to = &mut after;
                    }
                    to.extend(note_of_output(output).map(note));
                }
                let state_after = state.state();
                if self.lanes[lane].state != state_after {
                    self.lanes[lane].state = state_after;
                    to.push(note(format!("[{state_after:?}] {}", state.role())));
                }
                now
            }
            Entry::Heard { octets, .. } => self.arrow(lane, octets, false),
            Entry::Dropped { cause, octets, .. } if cause.layer == Layer::Simulated => {
                self.arrow(lane, octets, true)
            }
            Entry::Dropped { cause, detail, .. } => {
                vec![note(format!("! dropped, {cause}: {detail}"))]
            }
            Entry::Unrecorded { counters } => counters
                .iter()
                .map(|(cause, count)| note(format!("! dropped, {cause}: {count} more")))
                .collect(),
            Entry::Hindered { why } => vec![note(format!("! {why}"))],
            Entry::Sent { octets, .. } => match overhear(&self.lanes[lane].identifiers, octets) {
                Ok(heard) => {
                    let shown = self.shows(lane, &heard).into_iter();
                    shown
                        .chain(self.arrows_to_strangers(lane, &heard))
                        .collect()
                }
                Err(_) => Vec::new(),
            },
            Entry::People(sight) => {
                let text = changed(&mut self.lanes[lane].people, people(sight));
                text.map(note).into_iter().collect()
            }
            Entry::Around(around) => {
                let text = changed(&mut self.lanes[lane].road_users, road_users(around));
                text.map(note).into_iter().collect()
            }
            Entry::Started { .. }
            | Entry::Zone(_)
            | Entry::Channel(_)
            | Entry::Clock(_)
            | Entry::Stopped { .. } => Vec::new(),
        };
        (now, after)
    }

    /// Gives a robot that starts its column, that of the station that others heard before, or a new
    /// one.
    fn seat(&mut self, robot: &str, station: StationId, identifiers: Identifiers) {
        let heard = |lane: &Lane| lane.is_stranger && lane.station == station;
        self.names.set(station, robot);
        let seat = self.lane_named(robot);
        let seat = seat.or_else(|| self.lanes.iter().position(heard));
        let lane = Lane::new(robot.to_owned(), station, identifiers);
        match seat {
            Some(seat) => self.lanes[seat] = lane,
            None if self.grows => self.lanes.push(lane),
            None => {}
        }
    }

    /// The column of a station that was heard, if it has one or gets one.
    fn lane_of(&mut self, station: StationId) -> Option<usize> {
        let known = self.lanes.iter().position(|lane| lane.station == station);
        if known.is_none() && self.grows {
            let name = format!("station {station}");
            self.lanes.push(Lane {
                is_stranger: true,
                ..Lane::new(name, station, Identifiers::default())
            });
            return Some(self.lanes.len() - 1);
        }
        known
    }

    /// Messages of a robot to stations without records, which cannot say whether they arrive.
    fn arrows_to_strangers(&mut self, from: usize, heard: &Heard) -> Vec<Mark> {
        let mut marks = Vec::new();
        for to in 0..self.lanes.len() {
            let lane = &self.lanes[to];
            let is_meant = |input: &Input| addressee(input).is_none_or(|it| it == lane.station);
            if lane.is_stranger && heard.inputs.iter().any(is_meant) {
                marks.extend(self.message(from, to, heard, false));
            }
        }
        marks
    }

    fn arrow(&mut self, to: usize, octets: &[u8], is_lost: bool) -> Vec<Mark> {
        let Ok(heard) = overhear(&self.lanes[to].identifiers, octets) else {
            return Vec::new();
        };
        // Everybody hears a command, and one is meant.
        let own = self.lanes[to].station;
        let is_meant = |input: &Input| addressee(input).is_none_or(|station| station == own);
        if !heard.inputs.iter().any(is_meant) {
            return Vec::new();
        }
        let from = self.lane_of(heard.from).filter(|from| *from != to);
        let arrow = from.and_then(|from| self.message(from, to, &heard, is_lost));
        let stranger = from.filter(|from| self.lanes[*from].is_stranger && !is_lost);
        let shown = stranger.and_then(|from| self.shows(from, &heard));
        arrow.into_iter().chain(shown).collect()
    }

    /// Signal to people in a RAM, as a note of its sender, where it is new.
    fn shows(&mut self, lane: usize, heard: &Heard) -> Option<Mark> {
        let text = shown_in(heard)?;
        let text = changed(&mut self.lanes[lane].shown, text)?;
        Some(Mark::Note { lane, text })
    }

    /// The line that begins another of the paper's stages, if a step does. The first to ask begins stage 2, and stage 1
    /// too if no step came before; the end of a team's leader begins stage 5.
    fn stages_begun(&mut self, lane: usize, outputs: &Outputs, robot: &Robot) -> Vec<Mark> {
        let led = std::mem::replace(&mut self.lanes[lane].role, robot.role()) == Role::Leader;
        let nobody = self.lanes.iter().all(|lane| lane.role == Role::None);
        let is_command = |output: &Output| matches!(output, Output::SendRmcm(Rmcm::Command(_)));
        let stage = match (self.stage, robot.state()) {
            (0, State::Idle) => 1,
            (0 | 1 | 5, State::HelpRequested) => 2,
            (2, State::RoleEstablished) => 3,
            (3, State::ManeuverExecuting) => 4,
            (3, _) if outputs.iter().any(is_command) => 4,
            (2..=4, State::Idle) if led || nobody => 5,
            (stage, _) => stage,
        };
        let begun = match std::mem::replace(&mut self.stage, stage) {
            before if before == stage => return Vec::new(),
            0 => 1..=stage,
            _ => stage..=stage,
        };
        let begun = (1..).zip(STAGES).filter(|(stage, _)| begun.contains(stage));
        let text = begun.map(|(stage, name)| format!("── Stage {stage}: {name} ──"));
        text.map(|text| Mark::Note { lane: 0, text }).collect()
    }

    /// A message from column to column, unless it repeats what was drawn.
    fn message(&mut self, from: usize, to: usize, heard: &Heard, is_lost: bool) -> Option<Mark> {
        if heard.service == Service::Ram && !self.is_news(from, to, heard, is_lost) {
            return None;
        }
        Some(arrow(from, vec![ArrowHead { lane: to, is_lost }], heard))
    }

    /// Whether a RAM says something that was not drawn before.
    fn is_news(&mut self, from: usize, to: usize, heard: &Heard, is_lost: bool) -> bool {
        let Some(Input::Ram { ram, .. }) = heard.inputs.iter().next() else {
            return false;
        };
        let essence = essence(*ram);
        let is_empty =
            matches!(essence.coordination, Coordination::None) && essence.farewell.is_none();
        let is_news = match self.drawn.get(&(from, to)) {
            Some(known) => *known != essence,
            None => !is_empty,
        };
        if is_news && !is_lost {
            self.drawn.insert((from, to), essence);
        }
        is_news
    }
}

/// A note, unless it says the same as the last one; the last one becomes this note.
fn changed(known: &mut String, text: String) -> Option<String> {
    if *known == text {
        return None;
    }
    known.clone_from(&text);
    Some(text)
}

fn arrow(from: usize, to: Vec<ArrowHead>, heard: &Heard) -> Mark {
    let text = said_in(heard);
    // A lost message is recorded as a packet, and a heard one without its headers.
    let mut packet = DefaultHasher::new();
    (heard.from, heard.generation_delta_time, &text).hash(&mut packet);
    Mark::Arrow(Arrow {
        packet: packet.finish(),
        from,
        to,
        text,
    })
}

/// A RAM without what changes from one to the next.
fn essence(mut ram: Ram) -> Ram {
    match &mut ram.coordination {
        Coordination::Leader { heartbeat, .. } | Coordination::NeedHelp { heartbeat, .. } => {
            *heartbeat = Heartbeat(0);
        }
        Coordination::OfferHelp { echo, .. } | Coordination::Follower { echo, .. } => {
            *echo = Heartbeat(0);
        }
        Coordination::None => {}
    }
    ram
}

/// The receiver of an RMCM; `None` for what everybody may hear.
const fn addressee(input: &Input) -> Option<StationId> {
    match input {
        Input::Rmcm(Rmcm::Command(command)) => Some(command.to),
        Input::Rmcm(Rmcm::Answer(answer)) => Some(answer.session.leader),
        _ => None,
    }
}

#[cfg(all(test, feature = "full"))]
mod tests {
    use super::*;
    use crate::sim::{Swarm, run_recorded};

    #[test]
    fn a_chart_fits_a_terminal_or_there_is_none() {
        let robots = [("ARI", StationId(1)), ("Go2", StationId(2))];
        let chart = || Chart::new(&robots, Identifiers::default());
        let mut narrow = chart().within(80).unwrap();
        assert_eq!(narrow.note(0, "Go2", &"long ".repeat(40)), [""; 0]);
        let notes = narrow.rest();
        for line in notes.iter().chain([&narrow.header()]) {
            assert!(line.chars().count() <= 80, "{line}");
        }
        assert!(notes[0].ends_with('…'));
        let wide = chart().within(usize::MAX).unwrap();
        assert_eq!(wide.header(), chart().header());
        assert!(chart().within(50).is_none());
    }

    fn crossing() -> Vec<Record> {
        run_recorded(&Swarm::quiet(2)).1
    }

    /// Whether a robot acknowledges a command and starts it in the step of a record.
    fn acknowledges_and_starts(record: &Record) -> bool {
        let starts = |output: &Output| matches!(output, Output::StartManeuver(_));
        matches!(&record.entry, Entry::Step { outputs, .. } if outputs.iter().any(starts))
    }

    /// Facts and steps that are told record by record have the notes of a step with that step.
    #[test]
    fn a_record_by_itself_has_all_of_its_notes() {
        let records = crossing();
        let mut chart = Chart::growing();
        let mut seen = 0;
        for record in &records {
            let notes = chart.notes(record);
            if acknowledges_and_starts(record) {
                seen += 1;
                let is_start = |note: &String| note.starts_with("> start");
                assert!(notes.iter().any(is_start), "{notes:?}");
            }
        }
        assert!(seen > 0);
    }

    /// A robot may be told of people before any robot has made a step.
    #[test]
    fn each_stage_of_the_paper_begins_once_whichever_step_is_the_first() {
        let mut records = crossing();
        let is_before = |record: &Record| matches!(&record.entry, Entry::Step { state, .. } if state.state() == State::Idle);
        let stages = |records: &[Record]| {
            let mut chart = Chart::growing();
            let mut lines: Vec<_> = records.iter().flat_map(|it| chart.lines(it)).collect();
            lines.extend(chart.rest());
            lines.retain(|line| line.contains("── Stage "));
            lines.truncate(STAGES.len());
            lines
        };
        let with_steps_before = stages(&records);
        let mut has_begun = false;
        records.retain(|record| {
            has_begun |= matches!(record.entry, Entry::Step { .. }) && !is_before(record);
            has_begun || !is_before(record)
        });
        for stages in [with_steps_before, stages(&records)] {
            assert_eq!(stages.len(), STAGES.len(), "{stages:#?}");
            for (number, line) in (1..).zip(&stages) {
                assert!(
                    line.contains(&format!("── Stage {number}: ")),
                    "{stages:#?}"
                );
            }
        }
    }

    #[test]
    fn a_log_that_ends_loses_no_note() {
        let records = crossing();
        let last = records.iter().position(acknowledges_and_starts).unwrap();
        let mut chart = Chart::growing();
        let mut lines: Vec<_> = records[..=last]
            .iter()
            .flat_map(|record| chart.lines(record))
            .collect();
        let robot = &records[last].robot;
        lines.extend(chart.note_on_go(records[last].at_us, robot, "~ steps on the road"));
        lines.extend(chart.rest());
        for note in ["> start", "~ steps on the road"] {
            let is_there = lines.iter().any(|line| line.contains(note));
            assert!(is_there, "{note}: {lines:#?}");
        }
    }

    #[test]
    fn causes_stand_before_what_they_lead_to() {
        let records = crossing();
        let (mut chart, mut lines) = (Chart::growing(), Vec::new());
        let opens = |output: &Output| matches!(output, Output::CorridorOpened(_));
        for record in &records {
            if matches!(&record.entry, Entry::Step { outputs, .. } if outputs.iter().any(opens)) {
                // The pedestrian looks at the sign before the record of it is read.
                let text = "~ steps on the road";
                lines.extend(chart.note_on_go(record.at_us, &record.robot, text));
            }
            lines.extend(chart.lines(record));
        }
        lines.extend(chart.rest());
        let place = |what: &str| lines.iter().position(|line| line.contains(what));
        for pair in [
            ["RMCM command", "RMCM ack"],
            ["RMCM ack", "> start"],
            ["> corridor opened", "~ steps on the road"],
        ] {
            let places = pair.map(|what| place(what).expect(what));
            assert!(places[0] < places[1], "{pair:?}: {lines:#?}");
        }
    }
}
