//! Records as sequence charts of the kind that the model checker draws: text, Mermaid, SVG.

use std::time::Duration;

use crossguard_codec::Identifiers;
use crossguard_model_check::sequence::{Chart as Drawing, ChartStep, Fate, Place};
use crossguard_protocol::StationId;

use crate::chart::{Chart, Mark};
use crate::trace::Record;

/// Makes chart steps of records, as they come.
#[derive(Debug)]
pub struct Sequence {
    chart: Chart,
}

impl Sequence {
    /// Of robots with these names and station ids, from left to right.
    #[must_use]
    pub fn new(robots: &[(&str, StationId)]) -> Self {
        Self {
            chart: Chart::new(robots, Identifiers::default()),
        }
    }

    /// Of the robots that turn up in the records, and of the stations that they hear.
    #[must_use]
    pub fn of_whoever_comes() -> Self {
        Self {
            chart: Chart::of_whoever_comes(),
        }
    }

    /// The steps that a record adds.
    pub fn steps(&mut self, record: &Record) -> Vec<ChartStep> {
        let seconds = Duration::from_micros(record.at_us).as_secs_f64();
        let step = |mark| {
            let (place, text) = match mark {
                Mark::Note { lane, text } => (Place::At(lane), text),
                Mark::Arrow {
                    from,
                    to,
                    text,
                    is_lost,
                } => {
                    let fate = if is_lost { Fate::Lost } else { Fate::Arrives };
                    (Place::Between { from, to, fate }, text)
                }
            };
            ChartStep {
                place,
                action: format!("{seconds:.3} s: {text}"),
                outputs: Vec::new(),
            }
        };
        self.chart.marks(record).into_iter().map(step).collect()
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
