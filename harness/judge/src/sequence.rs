//! Records as sequence charts of the kind that the model checker draws: text and Mermaid.

use std::collections::BTreeMap;
use std::time::Duration;

use crossguard_codec::Identifiers;
use crossguard_model_check::sequence::{Chart as Drawing, ChartPlace, ChartStep, Fate};
use crossguard_protocol::StationId;
use crossguard_robot::trace::{Entry, Record};

use crate::chart::{Arrow, ArrowHead, Chart, Mark};

/// Makes chart steps of records, as they come.
#[derive(Debug)]
pub struct Sequence {
    chart: Chart,
    /// When the steps were that there have been, in µs.
    times: Vec<u64>,
    /// Of each robot that runs: when its newest record was made, in µs.
    running: BTreeMap<String, u64>,
}

impl Sequence {
    /// Of robots with these names and station ids, from left to right.
    #[must_use]
    pub fn new(robots: &[(&str, StationId)]) -> Self {
        Self::with(Chart::new(robots, Identifiers::default()))
    }

    /// Of the robots that turn up in the records, and of the stations that they hear.
    #[must_use]
    pub fn growing() -> Self {
        Self::with(Chart::growing())
    }

    const fn with(chart: Chart) -> Self {
        Self {
            chart,
            times: Vec::new(),
            running: BTreeMap::new(),
        }
    }

    /// The steps that a record adds by itself.
    pub fn steps(&mut self, record: &Record) -> Vec<ChartStep> {
        let marks = self.chart.marks(record);
        self.made_of(marks.into_iter().map(|mark| (record.at_us, mark)))
    }

    /// The steps that are complete when a record comes: a message to several is one of them.
    pub fn gathered(&mut self, record: &Record) -> Vec<ChartStep> {
        self.running.insert(record.robot.clone(), record.at_us);
        if matches!(record.entry, Entry::Stopped { .. }) {
            self.running.remove(&record.robot);
        }
        let marks = self.chart.gathered(record);
        self.made_of(marks.into_iter())
    }

    /// The steps that have not been complete so far.
    pub fn rest(&mut self) -> Vec<ChartStep> {
        let marks = self.chart.rest_gathered();
        self.made_of(marks.into_iter())
    }

    fn made_of(&mut self, marks: impl Iterator<Item = (u64, Mark)>) -> Vec<ChartStep> {
        let times = &mut self.times;
        let made = marks.map(|(at_us, mark)| {
            times.push(at_us);
            let (place, text) = match mark {
                Mark::Note { lane, text } => (ChartPlace::At(lane), text),
                Mark::Arrow(Arrow { from, to, text, .. }) => (among(from, &to), text),
            };
            step(at_us, place, &text)
        });
        made.collect()
    }

    /// Puts into all the steps where robots ended without having stopped in order.
    pub fn end(&self, steps: &mut Vec<ChartStep>) {
        let mut ends: Vec<_> = self.running.iter().collect();
        // From behind, so that places before stay what they are.
        ends.sort_by_key(|(_, newest)| std::cmp::Reverse(**newest));
        for (robot, &at_us) in ends {
            let lane = self.chart.names().position(|name| name == robot);
            let before = self.times.iter().rposition(|&time| time <= at_us);
            let place = before.map_or(0, |before| before + 1);
            let text = "! its records end here, and it did not stop in order";
            if let Some(lane) = lane {
                steps.insert(place, step(at_us, ChartPlace::At(lane), text));
            }
        }
    }

    /// Draws steps under a title.
    pub fn draw<T>(&self, title: &str, steps: &[ChartStep], draw: impl FnOnce(Drawing) -> T) -> T {
        let names: Vec<_> = self.chart.names().map(str::to_owned).collect();
        draw(Drawing {
            title,
            robots: &names,
            steps,
            repeats_after: None,
        })
    }
}

/// The place of a message.
fn among(from: usize, to: &[ArrowHead]) -> ChartPlace {
    let fate = |is_lost: bool| if is_lost { Fate::Lost } else { Fate::Arrives };
    if let [ArrowHead { lane, is_lost }] = *to {
        let fate = fate(is_lost);
        return ChartPlace::Between {
            from,
            to: lane,
            fate,
        };
    }
    let to = to.iter().map(|it| (it.lane, fate(it.is_lost)));
    ChartPlace::Among {
        from,
        to: to.collect(),
    }
}

fn step(at_us: u64, place: ChartPlace, text: &str) -> ChartStep {
    let seconds = Duration::from_micros(at_us).as_secs_f64();
    ChartStep {
        place,
        action: format!("{seconds:.3} s: {text}"),
        outputs: Vec::new(),
    }
}
