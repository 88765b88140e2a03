//! Messages and notes in the order of time. A broadcast is one row, with all who heard it.

use std::collections::{HashMap, HashSet};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::Arc;

use crossguard_model_check::names::Names;
use crossguard_protocol::StationId;
use serde::Serialize;

use crate::facts::{Direction, Message};

/// The longest text of a row, in characters.
const TEXT_MAX: usize = 200;

/// How many stations without logs get a column; the others share one.
const STRANGERS_MAX: usize = 8;

/// Text of a robot's RAM before it has a part in anything.
const NOTHING: &str = "none";

#[derive(Default)]
pub(super) struct Messages {
    rows: Vec<Row>,
    /// The rows that tell something new, by their places.
    news: Vec<usize>,
    texts: HashSet<Arc<str>>,
    /// The newest row of a message, by the hash of its octets.
    by_octets: HashMap<u64, usize>,
    /// Last text of the RAM of each robot.
    said: HashMap<u16, Arc<str>>,
    /// Last text of a station's RAM that a robot knew, by both.
    known: HashMap<(StationId, u16), Arc<str>>,
    /// Stations without logs, in the order in which they were heard.
    pub(super) strangers: Vec<StationId>,
    /// Whether there were more of them.
    pub(super) has_others: bool,
    pub(super) names: Names,
}

struct Row {
    at_us: u64,
    from: From,
    /// The message; `None` of a note.
    kind: Option<&'static str>,
    text: Arc<str>,
    why: Arc<str>,
    receptions: Vec<Reception>,
    is_news: bool,
    is_warning: bool,
    hash: u64,
}

#[derive(Clone, Copy)]
enum From {
    Robot(u16),
    Station(StationId),
    /// Its column, once all are known.
    Lane(usize),
}

struct Reception {
    robot: u16,
    at_us: u64,
    is_lost: bool,
}

impl Messages {
    pub(super) fn note(&mut self, robot: u16, at_us: u64, is_warning: bool, text: &str) {
        let (text, why) = (self.text(text), self.text(""));
        self.rows.push(Row {
            at_us,
            from: From::Robot(robot),
            kind: None,
            text,
            why,
            receptions: Vec::new(),
            is_news: true,
            is_warning,
            hash: 0,
        });
    }

    pub(super) fn message(&mut self, robot: u16, at_us: u64, message: &Message) {
        let mut hasher = DefaultHasher::new();
        message.octets.hash(&mut hasher);
        let hash = hasher.finish();
        let text = self.text(&message.text);
        let (is_lost, is_sent) = match message.direction {
            Direction::Sent => (false, true),
            Direction::Heard => (false, false),
            Direction::Lost => (true, false),
        };
        let known = self.by_octets.get(&hash).copied();
        let row = if let Some(row) = known.filter(|_| !is_sent) {
            row
        } else {
            let why = if is_sent { message.why.as_str() } else { "" };
            let row = Row {
                at_us,
                from: if is_sent {
                    From::Robot(robot)
                } else {
                    From::Station(message.from)
                },
                kind: Some(message.kind),
                text: Arc::clone(&text),
                why: self.text(why),
                receptions: Vec::new(),
                is_news: message.kind == "RMCM",
                is_warning: false,
                hash,
            };
            self.rows.push(row);
            self.by_octets.insert(hash, self.rows.len() - 1);
            self.rows.len() - 1
        };
        let is_ram = message.kind == "RAM";
        if is_sent {
            let said = self.said.insert(robot, Arc::clone(&text));
            let is_new = said.map_or(&*text != NOTHING, |said| said != text);
            self.rows[row].is_news |= is_ram && is_new;
            return;
        }
        self.rows[row].receptions.push(Reception {
            robot,
            at_us,
            is_lost,
        });
        if is_ram {
            let known = self.known.get(&(message.from, robot));
            let is_new = known.map_or(&*text != NOTHING, |known| *known != text);
            self.rows[row].is_news |= is_new;
            if is_new && !is_lost {
                self.known.insert((message.from, robot), text);
            }
        }
    }

    fn text(&mut self, text: &str) -> Arc<str> {
        let text: String = if text.chars().count() > TEXT_MAX {
            text.chars().take(TEXT_MAX - 1).chain(['…']).collect()
        } else {
            text.to_owned()
        };
        if let Some(known) = self.texts.get(text.as_str()) {
            return Arc::clone(known);
        }
        let text: Arc<str> = text.into();
        self.texts.insert(Arc::clone(&text));
        text
    }

    /// Brings all rows into the order of time and gives each its column: robots first, then strangers.
    pub(super) fn finish(&mut self, robots: &HashMap<StationId, u16>, count: usize) {
        self.join_early(robots);
        self.rows.sort_by_key(|row| row.at_us);
        for row in &mut self.rows {
            let lane = match row.from {
                From::Robot(robot) => usize::from(robot),
                From::Lane(lane) => lane,
                From::Station(station) => match robots.get(&station) {
                    Some(robot) => usize::from(*robot),
                    None => count + stranger(&mut self.strangers, &mut self.has_others, station),
                },
            };
            row.from = From::Lane(lane);
        }
        let places = self.rows.iter().enumerate();
        let news = places.filter(|(_, row)| row.is_news);
        self.news = news.map(|(place, _)| place).collect();
        (self.texts, self.by_octets) = (HashSet::new(), HashMap::new());
    }

    /// Joins receptions that stand before their transmissions, since clocks of logs are apart.
    fn join_early(&mut self, robots: &HashMap<StationId, u16>) {
        for place in 0..self.rows.len() {
            let row = &self.rows[place];
            let is_of_robot = matches!(row.from, From::Station(it) if robots.contains_key(&it));
            let sent = self.by_octets.get(&row.hash).copied();
            if let Some(sent) = sent.filter(|sent| is_of_robot && *sent != place) {
                let receptions = std::mem::take(&mut self.rows[place].receptions);
                self.rows[sent].receptions.extend(receptions);
                self.rows[sent].is_news |= self.rows[place].is_news;
            }
        }
        self.rows
            .retain(|row| !matches!(row.from, From::Station(_)) || !row.receptions.is_empty());
    }

    /// The rows next to a time, `before` of them up to it and `after` of them later, in a stretch of time. Their times
    /// are since `base_us`.
    pub(super) fn around(
        &self,
        at_us: u64,
        base_us: u64,
        (from_us, to_us): (u64, u64),
        [before, after]: [usize; 2],
        with_repeats: bool,
    ) -> Rows {
        let count = if with_repeats {
            self.rows.len()
        } else {
            self.news.len()
        };
        let row = |place: usize| {
            let place = if with_repeats {
                place
            } else {
                self.news[place]
            };
            &self.rows[place]
        };
        let (first, end) = (
            partition(count, |place| row(place).at_us < from_us),
            partition(count, |place| row(place).at_us <= to_us),
        );
        let now = partition(count, |place| row(place).at_us <= at_us).clamp(first, end.max(first));
        let earlier = partition(count, |place| row(place).at_us < at_us);
        let shown = now.saturating_sub(before).max(first)..now.saturating_add(after).min(end);
        let time = |place: usize| row(place).at_us.saturating_sub(base_us);
        Rows {
            count: end.saturating_sub(first),
            past: now - first,
            shown_from: shown.start - first,
            previous: (earlier > first).then(|| time(earlier - 1)),
            next: (now < end).then(|| time(now)),
            rows: shown
                .map(|place| row(place).shown(base_us, &self.names))
                .collect(),
        }
    }
}

fn stranger(strangers: &mut Vec<StationId>, has_others: &mut bool, station: StationId) -> usize {
    if let Some(place) = strangers.iter().position(|it| *it == station) {
        return place;
    }
    if strangers.len() < STRANGERS_MAX {
        strangers.push(station);
        return strangers.len() - 1;
    }
    *has_others = true;
    STRANGERS_MAX
}

/// The first of `count` places at which this no longer holds.
fn partition(count: usize, holds: impl Fn(usize) -> bool) -> usize {
    let (mut low, mut high) = (0, count);
    while low < high {
        let middle = low + (high - low) / 2;
        if holds(middle) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    low
}

impl Row {
    fn shown(&self, base_us: u64, names: &Names) -> MessageRow {
        let receivers = |is_lost: bool| {
            let of_fate = self
                .receptions
                .iter()
                .filter(move |it| it.is_lost == is_lost);
            of_fate.map(|it| usize::from(it.robot)).collect()
        };
        let times = self.receptions.iter().filter(|it| !it.is_lost);
        MessageRow {
            at: self.at_us.saturating_sub(base_us),
            from: match self.from {
                From::Lane(lane) => lane,
                From::Robot(robot) => robot.into(),
                From::Station(_) => 0,
            },
            kind: self.kind,
            text: names.tell(&self.text),
            why: names.tell(&self.why),
            heard: receivers(false),
            lost: receivers(true),
            took_us: times
                .map(|it| it.at_us.saturating_sub(self.at_us))
                .max()
                .unwrap_or(0),
            is_warning: self.is_warning,
        }
    }
}

/// The messages and notes next to a time.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Rows {
    /// How many there are in the stretch of time.
    pub count: usize,
    /// How many of them are not later than the time.
    pub past: usize,
    /// How many come before the ones here.
    pub shown_from: usize,
    /// The time of the one before the time.
    pub previous: Option<u64>,
    /// The time of the one after the time.
    pub next: Option<u64>,
    /// The rows next to the time.
    pub rows: Vec<MessageRow>,
}

/// A message with all who heard it, or a note.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct MessageRow {
    /// When, in µs since the first record.
    pub at: u64,
    /// The column of who sent it, or of whose note it is.
    pub from: usize,
    /// The message; `None` of a note.
    pub kind: Option<&'static str>,
    /// Its text.
    pub text: String,
    /// Why it was sent.
    pub why: String,
    /// The columns of robots that heard it.
    pub heard: Vec<usize>,
    /// The columns of robots that it did not reach because the fault layer kept it.
    pub lost: Vec<usize>,
    /// The longest time from sending to hearing, in µs by the clocks of the logs.
    pub took_us: u64,
    /// Whether something went wrong.
    pub is_warning: bool,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(direction: Direction, kind: &'static str, text: &str, octets: &[u8]) -> Message {
        Message {
            direction,
            kind,
            from: StationId(1),
            text: text.to_owned(),
            why: String::new(),
            octets: octets.to_vec(),
        }
    }

    #[test]
    fn a_broadcast_is_one_row_and_repeats_are_folded() {
        let mut messages = Messages::default();
        let ram = |direction, text, octet| message(direction, "RAM", text, &[octet]);
        messages.message(0, 10, &ram(Direction::Sent, "leader", 1));
        messages.message(1, 11, &ram(Direction::Heard, "leader", 1));
        messages.message(2, 12, &ram(Direction::Lost, "leader", 1));
        // Repeats, of which the first is news to the one that lost the one before.
        messages.message(0, 20, &ram(Direction::Sent, "leader", 2));
        messages.message(2, 21, &ram(Direction::Heard, "leader", 2));
        messages.message(0, 30, &ram(Direction::Sent, "leader", 3));
        messages.message(1, 31, &ram(Direction::Heard, "leader", 3));
        messages.finish(&HashMap::from([(StationId(1), 0)]), 3);
        let all = messages.around(30, 10, (10, 40), [9, 9], true);
        assert_eq!(
            (all.count, all.past, all.previous, all.next),
            (3, 3, Some(10), None)
        );
        let folded = messages.around(15, 10, (10, 40), [9, 9], false);
        assert_eq!((folded.count, folded.past, folded.next), (2, 1, Some(10)));
        let fates: Vec<_> = folded
            .rows
            .iter()
            .map(|row| (&row.heard[..], &row.lost[..]))
            .collect();
        assert_eq!(fates, [(&[1][..], &[2][..]), (&[2], &[])]);
    }

    #[test]
    fn a_reception_before_its_transmission_joins_it_and_a_stranger_gets_a_column() {
        let mut messages = Messages::default();
        messages.message(1, 5, &message(Direction::Heard, "RMCM", "command", &[7]));
        messages.message(0, 9, &message(Direction::Sent, "RMCM", "command", &[7]));
        let stranger = Message {
            from: StationId(99),
            ..message(Direction::Heard, "RMCM", "command", &[8])
        };
        messages.message(1, 12, &stranger);
        messages.finish(&HashMap::from([(StationId(1), 0)]), 2);
        let rows = messages.around(12, 0, (0, 20), [9, 9], false).rows;
        let shown: Vec<_> = rows
            .iter()
            .map(|row| (row.at, row.from, &row.heard[..]))
            .collect();
        assert_eq!(shown, [(9, 0, &[1][..]), (12, 2, &[1])]);
    }
}
