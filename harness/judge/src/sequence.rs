//! Records as sequence charts of the kind that the model checker draws: text, Mermaid, SVG.

use std::collections::BTreeMap;
use std::time::Duration;

use crossguard_codec::Identifiers;
use crossguard_model_check::sequence::{Chart as Drawing, ChartPlace, ChartStep, Fate};
use crossguard_protocol::StationId;
use crossguard_robot::trace::{Entry, Record};

use crate::chart::{Chart, Mark};

/// Makes chart steps of records, as they come.
#[derive(Debug)]
pub struct Sequence {
    chart: Chart,
    /// How many steps there have been.
    steps: usize,
    /// Of each robot that runs: when its newest record was made, in µs, and how many steps there were by then.
    running: BTreeMap<String, (u64, usize)>,
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
            steps: 0,
            running: BTreeMap::new(),
        }
    }

    /// The steps that a record adds.
    pub fn steps(&mut self, record: &Record) -> Vec<ChartStep> {
        let step = |mark| {
            let (place, text) = match mark {
                Mark::Note { lane, text } => (ChartPlace::At(lane), text),
                Mark::Arrow {
                    from,
                    to,
                    text,
                    is_lost,
                } => {
                    let fate = if is_lost { Fate::Lost } else { Fate::Arrives };
                    (ChartPlace::Between { from, to, fate }, text)
                }
            };
            self::step(record.at_us, place, &text)
        };
        let steps: Vec<_> = self.chart.marks(record).into_iter().map(step).collect();
        self.steps += steps.len();
        let newest = (record.at_us, self.steps);
        self.running.insert(record.robot.clone(), newest);
        if matches!(record.entry, Entry::Stopped { .. }) {
            self.running.remove(&record.robot);
        }
        steps
    }

    /// Puts into all the steps where robots ended without having stopped in order.
    pub fn end(&self, steps: &mut Vec<ChartStep>) {
        let mut ends: Vec<_> = self.running.iter().collect();
        // From behind, so that places before stay what they are.
        ends.sort_by_key(|(_, newest)| std::cmp::Reverse(**newest));
        for (robot, (at_us, place)) in ends {
            let lane = self.chart.names().position(|name| name == robot);
            let text = "! its records end here, and it did not stop in order";
            if let Some(lane) = lane {
                steps.insert(*place, step(*at_us, ChartPlace::At(lane), text));
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

fn step(at_us: u64, place: ChartPlace, text: &str) -> ChartStep {
    let seconds = Duration::from_micros(at_us).as_secs_f64();
    ChartStep {
        place,
        action: format!("{seconds:.3} s: {text}"),
        outputs: Vec::new(),
    }
}
