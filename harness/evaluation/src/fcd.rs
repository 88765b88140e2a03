//! How people and vehicles moved, by SUMO's floating car data (`sumo --fcd-output`).
//!
//! All people and vehicles are there from their first step to their last. One that is missing for a time, as a vehicle that
//! SUMO teleports, comes back as another station; [`Recording::gaps`] counts them.

use std::collections::HashMap;
use std::io::Read;

use crossguard_endpoint::ras::motion::Point;

use super::trace::{Run, Track};
use super::xml::{SumoFileError, elements};

/// A run as it was recorded.
#[derive(Clone, PartialEq, Debug)]
pub struct Recording {
    /// The run.
    pub run: Run,
    /// Time between two samples, in ms.
    pub sample_ms: u64,
    /// How often somebody was missing for a time and came back.
    pub gaps: usize,
}

impl std::fmt::Display for Recording {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (run, apart) = (&self.run, std::time::Duration::from_millis(self.sample_ms));
        let most = |tracks: &[Track]| {
            let steps = 0..=run.duration_ms() / self.sample_ms;
            let at = |step| move |it: &&Track| it.is_there(step * self.sample_ms * 1_000);
            steps
                .map(|step| tracks.iter().filter(at(step)).count())
                .max()
        };
        write!(
            f,
            "{:?} in steps of {apart:?}, {} people on foot ({} at once at most), {} vehicles ({} at once at most), \
             {} times somebody was missing and came back as another station",
            std::time::Duration::from_millis(run.duration_ms()),
            run.pedestrians.len(),
            most(&run.pedestrians).unwrap_or(0),
            run.vehicles.len(),
            most(&run.vehicles).unwrap_or(0),
            self.gaps
        )
    }
}

struct Present {
    begin: usize,
    places: Vec<Point>,
}

impl Present {
    const fn end(&self) -> usize {
        self.begin + self.places.len()
    }
}

/// Reads floating car data, the run of this seed.
///
/// # Errors
/// Why it cannot be used.
pub fn read(from: impl Read, seed: u64) -> Result<Recording, SumoFileError> {
    let mut times_ms: Vec<u64> = Vec::new();
    let mut present: HashMap<(bool, String), Present> = HashMap::new();
    let mut gone: Vec<((bool, String), Present)> = Vec::new();
    elements(from, "fcd-export", |element| {
        if element.is("timestep") {
            let time_s = element.number("time")?;
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "`as` saturates"
            )]
            times_ms.push((time_s * 1_000.0).round() as u64);
            return even(&times_ms);
        }
        let is_person = element.is("person");
        if !is_person && !element.is("vehicle") {
            return Ok(());
        }
        let Some(step) = times_ms.len().checked_sub(1) else {
            let why = "somebody is there before the first <timestep>: write it anew";
            return Err(SumoFileError::Misfit(why.to_owned()));
        };
        let place = [element.number("x")?, element.number("y")?];
        let id = element.value("id", "a name", |it| (!it.is_empty()).then(|| it.to_owned()))?;
        let key = (is_person, id);
        if present.get(&key).is_some_and(|it| it.end() < step) {
            gone.extend(present.remove_entry(&key));
        }
        let there = present.entry(key).or_insert_with(|| Present {
            begin: step,
            places: Vec::new(),
        });
        if there.end() > step {
            let why = format!("somebody is twice at {} ms: write it anew", times_ms[step]);
            return Err(SumoFileError::Misfit(why));
        }
        there.places.push(place);
        Ok(())
    })?;
    let [first, second, ..] = times_ms[..] else {
        let why = format!(
            "has {} steps, and two at least are wanted: let SUMO run longer",
            times_ms.len()
        );
        return Err(SumoFileError::Misfit(why));
    };
    let sample_ms = second - first;
    let gaps = gone.len();
    gone.extend(present);
    // By when they come, then 2 before 10: the same file always gives the same order.
    gone.sort_by(|((_, a), x), ((_, b), y)| (x.begin, a.len(), a).cmp(&(y.begin, b.len(), b)));
    let tracks = |wanted: bool| {
        let of = gone
            .iter()
            .filter(|((is_person, _), _)| *is_person == wanted);
        of.map(|(_, it)| Track::new(sample_ms, &it.places).from_sample(it.begin))
            .collect()
    };
    let run = Run {
        seed,
        vehicles: tracks(false),
        pedestrians: tracks(true),
    };
    if run.pedestrians.is_empty() {
        let why =
            "has nobody on foot: no <person> is in it; randomTrips.py --pedestrians makes some";
        return Err(SumoFileError::Misfit(why.to_owned()));
    }
    Ok(Recording {
        run,
        sample_ms,
        gaps,
    })
}

/// Whether the last step is as long after the one before as the second after the first, and not before it.
fn even(times_ms: &[u64]) -> Result<(), SumoFileError> {
    let ([first, second, ..], [.., before, last]) = (times_ms, times_ms) else {
        return Ok(());
    };
    let step_ms = second.saturating_sub(*first);
    if step_ms > 0 && before.checked_add(step_ms) == Some(*last) {
        Ok(())
    } else {
        Err(uneven(*before, *last, step_ms))
    }
}

fn uneven(before: u64, last: u64, step_ms: u64) -> SumoFileError {
    SumoFileError::Misfit(format!(
        "the step at {last} ms comes after the one at {before} ms, and steps are {step_ms} ms apart: record it \
         with one --device.fcd.period"
    ))
}
