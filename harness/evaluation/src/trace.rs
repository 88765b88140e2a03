//! How people and vehicles moved: recorded positions, and the motion between them.
//!
//! A trace file is gzip-compressed JSON, so that any script can read it:
//!
//! ```json
//! {"format": "crossguard-traces-1", "grid": {"nodes_per_side": 3, "segment_m": 100.0, …},
//!  "sample_ms": 500, "runs": [{"seed": 1, "vehicles": [[[x…], [y…]], …], "pedestrians": […]}]}
//! ```
//!
//! Each list of coordinates is in centimetres to the east and to the north of the grid's south-western
//! node, and is differenced twice: its first number is a coordinate, its second the first step, every
//! further one the change of the step.

use std::io::{Read, Write};

use crossguard_endpoint::ras::motion::{Motion, Point};
use flate2::Compression;
use flate2::read::GzDecoder;
use flate2::write::GzEncoder;
use serde::{Deserialize, Serialize};

use super::grid::Grid;
use super::net::Streets;

/// The format that a trace file names.
const FORMAT: &str = "crossguard-traces-1";
/// No file unpacks to more, in octets.
const UNPACKED_MAX: u64 = 1 << 30;
/// Least speed at which the heading is that of motion, in m/s; below it the last heading is kept.
const STANDING_MPS: f64 = 0.2;

/// Runs on the same streets.
#[derive(Clone, PartialEq, Debug)]
pub struct Traces {
    /// The streets.
    pub streets: Streets,
    /// Whether this program knows what moved everybody: it ran SUMO itself, or carries the file along. A file's
    /// statement about itself is no proof.
    pub is_proven: bool,
    /// Time between two samples, in ms.
    pub sample_ms: u64,
    /// The runs, each with its own seed.
    pub runs: Vec<Run>,
}

/// One run.
#[derive(Clone, PartialEq, Debug)]
pub struct Run {
    /// The seed of routes and traffic.
    pub seed: u64,
    /// The vehicles.
    pub vehicles: Vec<Track>,
    /// The people on foot.
    pub pedestrians: Vec<Track>,
}

/// Where someone was at every sample, with speed and heading there.
#[derive(Clone, PartialEq, Debug)]
pub struct Track {
    sample_ms: u64,
    /// Number of the run's sample at which it begins.
    begin: usize,
    samples: Vec<Motion>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    format: String,
    grid: Grid,
    sample_ms: u64,
    runs: Vec<FileRun>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct FileRun {
    seed: u64,
    vehicles: Vec<[Vec<i32>; 2]>,
    pedestrians: Vec<[Vec<i32>; 2]>,
}

/// Why a trace file cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum TraceError {
    /// It cannot be read or unpacked.
    #[error("cannot be read as a gzip file: {0}")]
    Unreadable(#[from] std::io::Error),
    /// It is not the JSON of a trace file.
    #[error("is not a trace file: {0}")]
    NotTraces(#[from] serde_json::Error),
    /// It is of another format.
    #[error("is of the format {0:?}, not {FORMAT:?}")]
    Format(String),
    /// Its numbers contradict each other.
    #[error("contradicts itself: {0}")]
    Contradictory(&'static str),
    /// A person or vehicle was not on its grid, or not all the time.
    #[error("{0}; give what moved on a net of its own with --net and --fcd")]
    Misfit(String),
}

impl Traces {
    /// How many people are on foot in a run, the mean over runs.
    #[must_use]
    pub fn pedestrians(&self) -> usize {
        let all: usize = self.runs.iter().map(|run| run.pedestrians.len()).sum();
        let runs = self.runs.len().max(1);
        (all + runs / 2) / runs
    }

    /// Reads a trace file.
    ///
    /// # Errors
    /// Why it cannot be used.
    pub fn read(from: impl Read) -> Result<Self, TraceError> {
        let mut text = Vec::new();
        GzDecoder::new(from)
            .take(UNPACKED_MAX)
            .read_to_end(&mut text)?;
        let file: File = serde_json::from_slice(&text)?;
        if file.format != FORMAT {
            return Err(TraceError::Format(file.format));
        }
        file.grid.check().map_err(TraceError::Contradictory)?;
        if file.sample_ms == 0 {
            return Err(TraceError::Contradictory("no time between samples"));
        }
        let sample_ms = file.sample_ms;
        let runs: Result<Vec<Run>, TraceError> = file
            .runs
            .into_iter()
            .map(|run| run.unpack(sample_ms))
            .collect();
        let runs = runs?;
        let people = runs.first().map_or(0, |run| run.pedestrians.len());
        if people == 0 || runs.iter().any(|run| run.pedestrians.len() != people) {
            return Err(TraceError::Contradictory(
                "runs need the same number of people, and some",
            ));
        }
        runs.iter().try_for_each(|run| run.check(&file.grid))?;
        Ok(Self {
            streets: Streets::Grid(file.grid),
            is_proven: false,
            sample_ms,
            runs,
        })
    }

    /// Writes a trace file.
    ///
    /// # Errors
    /// When it cannot be written, or is not of a grid.
    pub fn write(&self, to: impl Write) -> std::io::Result<()> {
        let grid = self.streets.grid();
        let grid = grid.ok_or_else(|| std::io::Error::other("a trace file is of a grid"))?;
        let file = File {
            format: FORMAT.to_owned(),
            grid: grid.clone(),
            sample_ms: self.sample_ms,
            runs: self.runs.iter().map(FileRun::pack).collect(),
        };
        let mut packed = GzEncoder::new(to, Compression::best());
        serde_json::to_writer(&mut packed, &file)?;
        packed.finish()?.flush()
    }
}

impl Run {
    /// How long it is, in ms: until the last one is gone.
    #[must_use]
    pub fn duration_ms(&self) -> u64 {
        self.tracks().map(Track::end_ms).max().unwrap_or(0)
    }

    /// Whether everybody is there from its beginning until then.
    #[must_use]
    pub fn is_whole(&self, until_ms: u64) -> bool {
        self.tracks()
            .all(|it| (it.begin_ms(), it.end_ms()) == (0, until_ms))
    }

    fn tracks(&self) -> impl Iterator<Item = &Track> + Clone {
        self.pedestrians.iter().chain(&self.vehicles)
    }

    /// Whether everybody is on the streets of this grid, all the time.
    fn check(&self, grid: &Grid) -> Result<(), TraceError> {
        let seed = self.seed;
        let until_ms = self.duration_ms();
        if let Some(short) = self.tracks().find(|it| it.end_ms() != until_ms) {
            return Err(TraceError::Misfit(format!(
                "run {seed} lasts {until_ms} ms, and somebody is there for {} ms only",
                short.end_ms()
            )));
        }
        let places = || {
            self.tracks()
                .flat_map(Track::samples)
                .map(|it| it.position_m)
        };
        let outside = places().filter(|it| !grid.has(*it));
        if let Some([east, north]) = outside.clone().next() {
            return Err(TraceError::Misfit(format!(
                "{} of {} places of run {seed} are off the streets of the grid, like ({east}, {north}) m",
                outside.count(),
                places().count()
            )));
        }
        Ok(())
    }
}

impl FileRun {
    fn pack(run: &Run) -> Self {
        let pack = |tracks: &[Track]| tracks.iter().map(Track::pack).collect();
        Self {
            seed: run.seed,
            vehicles: pack(&run.vehicles),
            pedestrians: pack(&run.pedestrians),
        }
    }

    fn unpack(self, sample_ms: u64) -> Result<Run, TraceError> {
        let unpack = |tracks: Vec<[Vec<i32>; 2]>| -> Result<Vec<Track>, TraceError> {
            tracks
                .iter()
                .map(|track| Track::unpack(sample_ms, track))
                .collect()
        };
        Ok(Run {
            seed: self.seed,
            vehicles: unpack(self.vehicles)?,
            pedestrians: unpack(self.pedestrians)?,
        })
    }
}

impl Track {
    /// The track through these places, one every `sample_ms`. Speed and heading at a sample are those
    /// between its two neighbours.
    #[must_use]
    pub fn new(sample_ms: u64, places: &[Point]) -> Self {
        let last = places.len().saturating_sub(1);
        let mut heading_deg = 0.0;
        let samples = (0..places.len()).map(|index| {
            let (from, to) = (index.saturating_sub(1), (index + 1).min(last));
            #[expect(clippy::cast_precision_loss, reason = "a few seconds")]
            let seconds = ((to - from).max(1) as u64 * sample_ms) as f64 / 1_000.0;
            let [east, north] =
                [0, 1].map(|axis| (places[to][axis] - places[from][axis]) / seconds);
            let speed_mps = east.hypot(north);
            if speed_mps >= STANDING_MPS {
                heading_deg = east.atan2(north).to_degrees().rem_euclid(360.0);
            }
            Motion {
                position_m: places[index],
                speed_mps,
                heading_deg,
            }
        });
        Self {
            sample_ms,
            begin: 0,
            samples: samples.collect(),
        }
    }

    /// The same track, which begins at this sample of the run.
    #[must_use]
    pub fn from_sample(self, begin: usize) -> Self {
        Self { begin, ..self }
    }

    /// The track of someone who stands at a place.
    #[must_use]
    pub fn standing(place: Point) -> Self {
        Self::new(1_000, &[place, place])
    }

    /// The place at a sample of the run; before its beginning it is at its beginning, behind its end at its end.
    #[must_use]
    pub fn place_at(&self, sample: usize) -> Point {
        let sample = sample.saturating_sub(self.begin);
        let there = self.samples.get(sample).or(self.samples.last());
        there.map_or([0.0, 0.0], |motion| motion.position_m)
    }

    /// When it begins, in ms from the beginning of the run.
    #[must_use]
    pub const fn begin_ms(&self) -> u64 {
        self.begin as u64 * self.sample_ms
    }

    /// When it ends, in ms from the beginning of the run.
    #[must_use]
    pub fn end_ms(&self) -> u64 {
        self.begin_ms() + (self.samples.len() as u64).saturating_sub(1) * self.sample_ms
    }

    /// Whether somebody on this track is there, so many microseconds from the beginning of the run.
    #[must_use]
    pub fn is_there(&self, time_us: u64) -> bool {
        (self.begin_ms() * 1_000..=self.end_ms() * 1_000).contains(&time_us)
    }

    /// Number of the run's sample at which it begins.
    #[must_use]
    pub const fn first_sample(&self) -> usize {
        self.begin
    }

    /// The motion at every sample, from its first one on.
    #[must_use]
    pub fn samples(&self) -> &[Motion] {
        &self.samples
    }

    /// The motion at `time_us` microseconds from the beginning of the run: between two samples everything changes
    /// evenly. Behind its end it stands at its end.
    #[must_use]
    pub fn motion(&self, time_us: u64) -> Motion {
        let time_us = time_us.saturating_sub(self.begin_ms() * 1_000);
        let sample_us = self.sample_ms * 1_000;
        let index = usize::try_from(time_us / sample_us).unwrap_or(usize::MAX);
        let Some([before, after]) = self.samples.get(index..index.saturating_add(2)) else {
            return self.samples.last().copied().unwrap_or_default();
        };
        #[expect(clippy::cast_precision_loss, reason = "less than a sample")]
        let share = (time_us % sample_us) as f64 / sample_us as f64;
        let between = |a: f64, b: f64| a + (b - a) * share;
        let turn = (after.heading_deg - before.heading_deg + 180.0).rem_euclid(360.0) - 180.0;
        Motion {
            position_m: [0, 1].map(|axis| between(before.position_m[axis], after.position_m[axis])),
            speed_mps: between(before.speed_mps, after.speed_mps),
            heading_deg: (before.heading_deg + turn * share).rem_euclid(360.0),
        }
    }

    fn pack(&self) -> [Vec<i32>; 2] {
        [0, 1].map(|axis| {
            #[expect(
                clippy::cast_possible_truncation,
                reason = "`as` saturates at 21,000 km"
            )]
            let places = self
                .samples
                .iter()
                .map(|it| (it.position_m[axis] * 100.0).round() as i32);
            let (mut place, mut step) = (0_i32, 0_i32);
            let differences = places.enumerate().map(|(index, now)| {
                let moved = now.wrapping_sub(place);
                let change = moved.wrapping_sub(step);
                place = now;
                step = if index == 0 { 0 } else { moved };
                change
            });
            differences.collect()
        })
    }

    fn unpack(sample_ms: u64, [east, north]: &[Vec<i32>; 2]) -> Result<Self, TraceError> {
        if east.len() != north.len() || east.len() < 2 {
            return Err(TraceError::Contradictory(
                "a track needs as many x as y, and two of them",
            ));
        }
        let (mut place, mut step) = ([0_i32; 2], [0_i32; 2]);
        let mut places = Vec::with_capacity(east.len());
        for (index, changes) in east.iter().zip(north).enumerate() {
            for (axis, change) in [*changes.0, *changes.1].into_iter().enumerate() {
                let moved = step[axis].wrapping_add(change);
                place[axis] = place[axis].wrapping_add(moved);
                step[axis] = if index == 0 { 0 } else { moved };
            }
            places.push(place.map(|centimetres| f64::from(centimetres) / 100.0));
        }
        Ok(Self::new(sample_ms, &places))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::grid::Preset;
    use super::*;

    #[test]
    fn motion_between_samples_is_even() {
        let track = Track::new(
            500,
            &[[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 1.0], [1.0, 1.0]],
        );
        assert_eq!(track.end_ms(), 2_000);
        let there = track.motion(250_000);
        assert!((there.position_m[1] - 0.5).abs() < 1e-9);
        // From north at the first sample to north-east at the second.
        assert!((there.heading_deg - 22.5).abs() < 1e-9);
        let end = track.motion(9_000_000);
        assert!(end.speed_mps.abs() < 1e-9 && (end.heading_deg - 90.0).abs() < 1e-9);
    }

    #[test]
    fn what_is_no_trace_file_is_refused_with_a_reason() {
        assert!(matches!(
            Traces::read(&b"{}"[..]),
            Err(TraceError::Unreadable(_))
        ));
        let pack = |text: &str| {
            let mut packed = GzEncoder::new(Vec::new(), Compression::fast());
            packed.write_all(text.as_bytes()).unwrap();
            packed.finish().unwrap()
        };
        let read = |text: &str| Traces::read(&pack(text)[..]);
        assert!(matches!(read("[]"), Err(TraceError::NotTraces(_))));
        let grid = serde_json::to_string(&Preset::Kerb.grid()).unwrap();
        let file = |format: &str, runs: &str| {
            read(&format!(
                r#"{{"format":"{format}","grid":{grid},"sample_ms":500,"runs":[{runs}]}}"#
            ))
        };
        assert!(matches!(file("other", ""), Err(TraceError::Format(_))));
        assert!(matches!(
            file(FORMAT, ""),
            Err(TraceError::Contradictory(_))
        ));
        let uneven = r#"{"seed":1,"vehicles":[],"pedestrians":[[[1,2],[1]]]}"#;
        assert!(matches!(
            file(FORMAT, uneven),
            Err(TraceError::Contradictory(_))
        ));
    }

    proptest! {
        /// A written file is read again, to the centimetre.
        #[test]
        fn tracks_are_packed_without_loss(
            places in proptest::collection::vec((0_i32..20_000, -500_i32..500), 2..50)
        ) {
            let places: Vec<Point> = places.iter()
                .map(|&(x, y)| [f64::from(x) / 100.0, f64::from(y) / 100.0]).collect();
            let track = Track::new(500, &places);
            let run = Run { seed: 4, vehicles: vec![track.clone()], pedestrians: vec![track] };
            let traces = Traces {
                streets: Streets::Grid(Preset::Plain.grid()),
                is_proven: false,
                sample_ms: 500,
                runs: vec![run],
            };
            let mut packed = Vec::new();
            traces.write(&mut packed).unwrap();
            prop_assert_eq!(Traces::read(&packed[..]).unwrap(), traces);
        }
    }
}
