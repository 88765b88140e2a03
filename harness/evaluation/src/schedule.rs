//! Places of robots with times, as a researcher writes them down: a table of comma-separated values.
//!
//! ```csv
//! robot,time_s,x_m,y_m
//! north gate,0,92.1,107.9
//! rover,0,0,-8
//! rover,60,0,-8
//! rover,140,100,-8
//! ```
//!
//! A robot with one line stands there. One with more is at each place at its time, and moves straight and evenly in
//! between; before its first time it is at the first place, behind its last one at the last.

use std::io::Read;

use crossguard_endpoint::ras::motion::{Point, distance_m};
use serde::{Deserialize, Serialize};

use super::trace::Track;

/// Where a robot is at which times.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Schedule {
    /// Its name.
    pub robot: String,
    /// Times in seconds from the beginning of the run, and places in metres.
    at: Vec<(f64, Point)>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Row {
    robot: String,
    time_s: f64,
    x_m: f64,
    y_m: f64,
}

/// Why a file of places cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum ScheduleError {
    /// A line is not understood.
    #[error("{0}; lines like 'robot,time_s,x_m,y_m' and 'north gate,0,92.1,107.9' are wanted")]
    Table(#[from] csv::Error),
    /// A line does not fit to those before it.
    #[error("line {line}: {robot:?} {what}")]
    Line {
        /// Which, from 1 on.
        line: u64,
        /// Which robot.
        robot: String,
        /// The mistake.
        what: &'static str,
    },
    /// There is none.
    #[error(
        "there is no robot in it: a line for each place is wanted, like 'north gate,0,92.1,107.9'"
    )]
    Empty,
}

impl Schedule {
    /// The robots of a file, in the order of their first lines.
    ///
    /// # Errors
    /// Why it cannot be used.
    pub fn read(from: impl Read) -> Result<Vec<Self>, ScheduleError> {
        let mut robots: Vec<Self> = Vec::new();
        let mut table = csv::ReaderBuilder::new()
            .trim(csv::Trim::All)
            .from_reader(from);
        let headers = table.headers()?.clone();
        let mut record = csv::StringRecord::new();
        while table.read_record(&mut record)? {
            let row: Row = record.deserialize(Some(&headers))?;
            let (robot, place) = (row.robot, [row.x_m, row.y_m]);
            let line = record.position().map_or(0, csv::Position::line);
            let wrong = |what| ScheduleError::Line {
                line,
                robot: robot.clone(),
                what,
            };
            if !(row.time_s >= 0.0
                && [row.time_s, row.x_m, row.y_m]
                    .iter()
                    .all(|it| it.is_finite()))
            {
                return Err(wrong("needs finite numbers, and a time of 0 or more"));
            }
            match robots.iter_mut().find(|it| it.robot == robot) {
                Some(known) if known.at.last().is_some_and(|last| last.0 >= row.time_s) => {
                    return Err(wrong(
                        "was there later in a line before: sort its lines by time",
                    ));
                }
                Some(known) => known.at.push((row.time_s, place)),
                None => robots.push(Self {
                    robot,
                    at: vec![(row.time_s, place)],
                }),
            }
        }
        if robots.is_empty() {
            return Err(ScheduleError::Empty);
        }
        Ok(robots)
    }

    /// The robot with this number, from 0, which is at these places at these times.
    pub(super) fn new(number: usize, at: Vec<(f64, Point)>) -> Self {
        let robot = (number + 1).to_string();
        Self { robot, at }
    }

    /// From now on it walks to this place instead of where it was to be: east or west first, then north or south.
    pub(super) fn walk(&mut self, now_s: f64, to: Point, speed_mps: f64) {
        let from = self.place_at(now_s);
        self.at.retain(|(at_s, _)| *at_s < now_s);
        self.at.push((now_s, from));
        let (mut at_s, mut at) = (now_s, from);
        for place in [[to[0], from[1]], to] {
            at_s += distance_m(at, place) / speed_mps;
            at = place;
            if self.at.last().is_some_and(|last| last.0 < at_s) {
                self.at.push((at_s, at));
            }
        }
    }

    /// Whether it moves.
    #[must_use]
    pub fn moves(&self) -> bool {
        self.at
            .iter()
            .any(|(_, place)| distance_m(*place, self.at[0].1) > 0.0)
    }

    /// Where it is at a time in seconds from the beginning of the run.
    #[must_use]
    pub fn place_at(&self, time_s: f64) -> Point {
        let next = self.at.partition_point(|(at_s, _)| *at_s <= time_s);
        let before = self.at[next.saturating_sub(1)];
        let Some(after) = self.at.get(next).filter(|_| next > 0) else {
            return before.1;
        };
        let share = (time_s - before.0) / (after.0 - before.0);
        [0, 1].map(|axis| before.1[axis] + (after.1[axis] - before.1[axis]) * share)
    }

    /// Its way in a run of this length, with a sample every `sample_ms`.
    #[must_use]
    pub fn track(&self, duration_ms: u64, sample_ms: u64) -> Track {
        if !self.moves() {
            return Track::standing(self.at[0].1);
        }
        #[expect(clippy::cast_precision_loss, reason = "a few hours")]
        let place = |sample: u64| self.place_at((sample * sample_ms) as f64 / 1_000.0);
        let samples = 0..=duration_ms.div_ceil(sample_ms);
        Track::new(sample_ms, &samples.map(place).collect::<Vec<_>>())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = "robot,time_s,x_m,y_m\ngate, 5, 1, 2\nrover,10,0,0\nrover,20,0,100\n";

    #[test]
    fn a_robot_stands_or_moves_by_its_schedule() {
        let robots = Schedule::read(FILE.as_bytes()).unwrap();
        let [gate, rover] = &robots[..] else {
            panic!("{robots:?}")
        };
        let is_at = |track: &Track, sample, place| distance_m(track.place_at(sample), place) < 1e-9;
        assert!(is_at(&gate.track(30_000, 500), 7, [1.0, 2.0]));
        let track = rover.track(30_000, 500);
        for (sample, north_m) in [(0, 0.0), (20, 0.0), (30, 50.0), (40, 100.0), (60, 100.0)] {
            assert!(is_at(&track, sample, [0.0, north_m]), "{sample}");
        }
        assert!((track.motion(15_000_000).speed_mps - 10.0).abs() < 1e-9);
    }

    #[test]
    fn a_wrong_line_is_refused_with_its_number() {
        let refused = |line: &str| {
            let file = format!("{FILE}{line}\n");
            Schedule::read(file.as_bytes()).unwrap_err().to_string()
        };
        for (line, said) in [
            ("rover,20,0,0", "line 5: \"rover\" was there later"),
            ("rover,inf,0,0", "line 5: \"rover\" needs finite numbers"),
            ("rover,30,east,0", "line: 5"),
            ("rover,30", "line: 5"),
        ] {
            assert!(refused(line).contains(said), "{}", refused(line));
        }
        let empty = Schedule::read(&b"robot,time_s,x_m,y_m\n"[..]);
        assert!(matches!(empty, Err(ScheduleError::Empty)));
    }
}
