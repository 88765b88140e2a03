//! People that a robot's sensors report, as lines of JSON: one line for each person and observation.
//!
//! ```json
//! {"at_s": 1.5, "id": 7, "position_m": [3.0, -1.5], "velocity_mps": [1.2, 0.0], "class": "pedestrian",
//!  "confidence": 0.9}
//! ```
//!
//! Places are metres to the east and to the north of the site's origin, as everywhere in the command.
//! `{"at_s": 2.0, "nobody": true}` says that the sensors work and have nobody; who was on the road is not off it by
//! that. `velocity_mps` is zero, `class` a pedestrian and `confidence` 1 where they are left out. `at_s` is when
//! the line is told, in seconds from the beginning; without it a line is told when it is read, so that a
//! sensor can write into a pipe. Somebody who is not told of again is forgotten after a second.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use crossguard_codec::core::cdd::VruClusterInformation;
use crossguard_endpoint::ras::clustering::{PerceivedVru, VruClass};
use serde::Deserialize;

use crate::lines::lines;
use crate::site::Place;

/// Lines that are read ahead at most.
const AHEAD: usize = 64;

/// One observation of one person.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Observation {
    /// Who, and where on the site; `None` where the sensors work and have nobody.
    pub vru: Option<PerceivedVru>,
    /// When it is told, in seconds from the beginning; `None` is at once.
    pub at_s: Option<f64>,
}

/// The sensors work, and have nobody.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct NobodyLine {
    at_s: Option<f64>,
    nobody: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ObservationLine {
    at_s: Option<f64>,
    id: u32,
    position_m: [f64; 2],
    #[serde(default)]
    velocity_mps: [f64; 2],
    #[serde(default = "pedestrian")]
    class: VruClass,
    #[serde(default = "sure")]
    confidence: f64,
}

const fn pedestrian() -> VruClass {
    VruClass::Pedestrian
}

const fn sure() -> f64 {
    1.0
}

/// Why a line is no observation.
#[derive(Debug, thiserror::Error)]
pub enum PerceptionError {
    /// It is no JSON of this shape.
    #[error(
        "{0}; a person is like {{\"id\": 7, \"position_m\": [3.0, -1.5], \"velocity_mps\": [1.2, 0.0], \
         \"class\": \"pedestrian\", \"confidence\": 0.9}}"
    )]
    Syntax(#[from] serde_json::Error),
    /// A number is not possible.
    #[error("{name} is {value}: {wanted} is wanted")]
    Impossible {
        /// Of what.
        name: &'static str,
        /// The number.
        value: f64,
        /// What would be.
        wanted: &'static str,
    },
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] std::io::Error),
}

/// Understands a line.
///
/// # Errors
/// Why it is no observation.
pub fn parse(line: &str) -> Result<Observation, PerceptionError> {
    let check_time = |at_s: Option<f64>| within("at_s", at_s.unwrap_or(0.0), 0.0, 1e6, "seconds");
    if let Ok(NobodyLine { at_s, nobody: true }) = serde_json::from_str(line) {
        check_time(at_s)?;
        return Ok(Observation { vru: None, at_s });
    }
    let text: ObservationLine = serde_json::from_str(line)?;
    check_time(text.at_s)?;
    let vru = PerceivedVru {
        id: text.id,
        position_m: text.position_m,
        velocity_mps: text.velocity_mps,
        class: text.class,
        confidence: text.confidence,
    };
    check(&vru)?;
    Ok(Observation {
        vru: Some(vru),
        at_s: text.at_s,
    })
}

/// Checks that there can be somebody like that.
///
/// # Errors
/// What is impossible.
pub fn check(vru: &PerceivedVru) -> Result<(), PerceptionError> {
    for metres in vru.position_m {
        within("position_m", metres, -1e5, 1e5, "metres on the site")?;
    }
    let [across, along] = vru.velocity_mps;
    within(
        "velocity_mps",
        across.hypot(along),
        0.0,
        163.8,
        "at most 163.8 m/s",
    )?;
    within("confidence", vru.confidence, 0.0, 1.0, "0 to 1")
}

fn within(
    name: &'static str,
    value: f64,
    least: f64,
    most: f64,
    wanted: &'static str,
) -> Result<(), PerceptionError> {
    if (least..=most).contains(&value) {
        Ok(())
    } else {
        Err(PerceptionError::Impossible {
            name,
            value,
            wanted,
        })
    }
}

/// Somebody on the site, as a robot that is at `place` sees it.
#[must_use]
pub fn seen_from(place: Place, vru: PerceivedVru) -> PerceivedVru {
    let [east, north] = vru.position_m;
    PerceivedVru {
        position_m: [east - place.east, north - place.north],
        ..vru
    }
}

/// The person of a line, or nobody; or why the line is no observation.
type Told = Result<Option<PerceivedVru>, String>;

/// A file, or a pipe, of observations that are told one after the other, each at its time.
#[derive(Clone, Debug)]
pub struct Feed {
    observations: Arc<Mutex<Receiver<Told>>>,
}

impl Feed {
    /// Opens a file; its times count from now on. A regular file is read at once, a pipe line by line.
    ///
    /// # Errors
    /// When it cannot be opened, or a line of a regular file is no observation: which, and why.
    pub fn open(path: &Path) -> Result<Self, String> {
        let name = path.display().to_string();
        let failed = |error: std::io::Error| format!("{name}: {error}");
        let file = File::open(path).map_err(failed)?;
        let is_file = file.metadata().map_err(failed)?.is_file();
        let lines = observations(name.clone(), BufReader::new(file));
        let (tell, observations) = sync_channel(AHEAD);
        let observations = Arc::new(Mutex::new(observations));
        // The thread ends with the file, or when nobody listens any more.
        if is_file {
            let all = lines.collect::<Result<Vec<_>, _>>()?;
            std::thread::spawn(move || tell_in_time(all.into_iter().map(Ok), &tell));
        } else {
            std::thread::spawn(move || tell_in_time(lines, &tell));
        }
        Ok(Self { observations })
    }

    /// The observations that are due by now.
    ///
    /// # Errors
    /// The first line of a pipe that is none, with its place.
    pub fn due(&self) -> Result<Vec<Option<PerceivedVru>>, String> {
        let observations = self.observations.lock();
        let observations = observations.unwrap_or_else(PoisonError::into_inner);
        observations.try_iter().take(AHEAD).collect()
    }
}

fn observations(
    name: String,
    file: impl BufRead + Send + 'static,
) -> impl Iterator<Item = Result<Observation, String>> + Send {
    let numbered = (1..).zip(lines(file));
    numbered.filter_map(move |(number, line)| {
        let observation = match line {
            Ok(text) if text.trim_ascii().is_empty() => return None,
            Ok(text) => parse(&String::from_utf8_lossy(&text)).map_err(|error| error.to_string()),
            Err(error) => Err(error.to_string()),
        };
        Some(observation.map_err(|error| format!("{name}:{number}: {error}")))
    })
}

fn tell_in_time(
    observations: impl Iterator<Item = Result<Observation, String>>,
    tell: &SyncSender<Told>,
) {
    let began = Instant::now();
    for observation in observations {
        let due_s = observation.as_ref().ok().and_then(|it| it.at_s);
        let due = began + Duration::from_secs_f64(due_s.unwrap_or(0.0));
        std::thread::sleep(due.saturating_duration_since(Instant::now()));
        let is_over = observation.is_err();
        if tell.send(observation.map(|it| it.vru)).is_err() || is_over {
            return;
        }
    }
}

/// What a robot's RAM announced last, to tell a person when that changes.
#[derive(Clone, Debug, Default)]
pub struct Announced(BTreeMap<u8, u8>);

impl Announced {
    /// Takes in what one more RAM announces; what is new in it, if anything is.
    pub fn note(&mut self, cluster: Option<&VruClusterInformation>) -> Option<String> {
        let Some(cluster) = cluster else {
            let were_any = !std::mem::take(&mut self.0).is_empty();
            return were_any.then(|| "announces nobody any more".to_owned());
        };
        let id = cluster.cluster_id.map_or(0, |id| id.0);
        let count = cluster.cluster_cardinality_size.0;
        if count == 0 {
            let was_told = self.0.remove(&id).is_some();
            let now = match self.0.len() {
                0 => "announces nobody any more".to_owned(),
                _ => format!("no longer announces cluster {id}"),
            };
            return was_told.then_some(now);
        }
        let people = if count == 1 { "person" } else { "people" };
        (self.0.insert(id, count) != Some(count))
            .then(|| format!("announces {count} {people}, cluster {id}"))
    }
}

#[cfg(test)]
mod tests {
    use crossguard_codec::core::cdd::{CardinalNumber1B, Identifier1B};

    use super::*;

    #[test]
    fn a_person_has_defaults_and_takes_what_is_said() {
        let short = parse(r#"{"id": 7, "position_m": [3, -1.5]}"#).unwrap();
        let vru = short.vru.unwrap();
        assert_eq!((vru.id, vru.position_m), (7, [3.0, -1.5]));
        assert_eq!(vru.class, VruClass::Pedestrian);
        assert!((vru.confidence - 1.0).abs() < 1e-12 && short.at_s.is_none());
        let full = r#"{"at_s": 1.5, "id": 7, "position_m": [3, 0], "velocity_mps": [1.2, 0],
                       "class": "bicyclist", "confidence": 0.4}"#;
        let full = parse(full).unwrap();
        let vru = full.vru.unwrap();
        assert_eq!((full.at_s, vru.class), (Some(1.5), VruClass::Bicyclist));
        let seen = seen_from(Place::new(1.0, 2.0), vru);
        assert_eq!(
            seen,
            PerceivedVru {
                position_m: [2.0, -2.0],
                ..vru
            }
        );
        let nobody = parse(r#"{"at_s": 2, "nobody": true}"#).unwrap();
        assert_eq!((nobody.vru, nobody.at_s), (None, Some(2.0)));
    }

    #[test]
    fn a_cluster_that_is_over_is_told_once() {
        let cluster = |id, count| VruClusterInformation {
            cluster_id: Some(Identifier1B(id)),
            cluster_bounding_box_shape: None,
            cluster_cardinality_size: CardinalNumber1B(count),
            cluster_profiles: None,
        };
        let mut announced = Announced::default();
        let mut note = |id, count| announced.note(Some(&cluster(id, count)));
        assert_eq!(note(7, 2).unwrap(), "announces 2 people, cluster 7");
        assert_eq!(note(8, 1).unwrap(), "announces 1 person, cluster 8");
        assert_eq!(note(7, 0).unwrap(), "no longer announces cluster 7");
        assert_eq!(note(7, 0), None);
        assert_eq!(note(8, 0).unwrap(), "announces nobody any more");
        assert_eq!(announced.note(None), None);
    }

    #[test]
    fn what_is_no_person_is_answered_with_what_would_be() {
        for (line, answer) in [
            ("{}", "missing field `id`"),
            (r#"{"id": 1, "place": 3}"#, "unknown field `place`"),
            (
                r#"{"id": 1, "position_m": [1, 2], "class": "car"}"#,
                "unknown variant `car`",
            ),
            (
                r#"{"id": 1, "position_m": [1, 2], "confidence": 1.5}"#,
                "confidence is 1.5: 0 to 1 is wanted",
            ),
            (
                r#"{"id": 1, "position_m": [1, 1e9]}"#,
                "position_m is 1000000000: metres on the site is wanted",
            ),
            (r#"{"nobody": false}"#, "unknown field `nobody`"),
            (r#"{"nobody": true, "at_s": -1}"#, "at_s is -1"),
            (
                r#"{"id": 1, "position_m": [1, 2], "at_s": -1}"#,
                "at_s is -1",
            ),
        ] {
            let error = parse(line).unwrap_err().to_string();
            assert!(error.contains(answer), "{line}: {error}");
        }
    }
}
