//! Frames of a robot's sensors, as lines of JSON: one line for each time at which a source looked.
//!
//! ```json
//! {"source": 0, "at_s": 1.5, "people": [{"id": 7, "position_m": [3.0, -1.5], "velocity_mps": [1.2, 0.0],
//!  "class": "pedestrian", "confidence": 0.9, "error_m": 0.2}]}
//! ```
//!
//! A frame has everybody in sight of its source, and says when the source looked: `at_s` in seconds from the beginning, or `unix_s`
//! in seconds since 1970. Its age counts from then, however long it waited in a pipe. `covers_m` is the polygon that the source
//! could see at that time; without it, the whole carriageway. A [part](crate::zone::Zone::covered) of the carriageway is covered if
//! all of it is in that polygon. Sources are numbered from 0 to 3; without a number it is source 0.
//! Vehicles are among the people, with `"class": "vehicle"`, and say their velocity. `velocity_mps` is unknown, `class` a pedestrian,
//! `confidence` 1 and `error_m` 0.2 where they are left out. Places are metres to the east and to the north of the site's
//! origin, as everywhere in the command.
//!
//! A line with one person, `{"at_s": 1.5, "id": 7, "position_m": [3.0, -1.5]}`, adds that person or vehicle and says nothing of others:
//! it does not say what was covered, so the road is never clear by such lines. A line that is neither is counted
//! and dropped, and the road is not clear by what came before it.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::os::unix::fs::FileTypeExt as _;
use std::path::Path;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant, SystemTime};

use crossguard_codec::core::cdd::VruClusterInformation;
use crossguard_crossing::Sighting;
use crossguard_endpoint::ras::area::Area;
use crossguard_endpoint::ras::clustering::{PerceivedVru, VruClass};
use serde::Deserialize;

use crate::lines::lines;
use crate::located::{Impossible, possible};
use crate::runtime::Order;
use crate::site::Place;
use crate::zone::{NoPolygon, polygon, sighting};

/// Lines that are read ahead at most.
const AHEAD: usize = 64;

/// Most people in a frame.
const PEOPLE_MAX: usize = 256;

/// Error of a place where a source does not say it, in metres.
const ERROR_M: f64 = 0.2;

/// A road user in a frame.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Perceived {
    /// The road user, with its place on the site.
    pub vru: PerceivedVru,
    /// Whether the source tracks them by a number.
    pub has_id: bool,
    /// Whether their velocity is known.
    pub has_velocity: bool,
    /// Error of the place, in metres.
    pub error_m: f64,
}

impl Perceived {
    /// The same for the crossing machine.
    #[must_use]
    pub fn sighting(&self) -> Sighting {
        let seen = sighting(&self.vru, self.error_m);
        Sighting {
            id: seen.id.filter(|_| self.has_id),
            velocity: seen.velocity.filter(|_| self.has_velocity),
            ..seen
        }
    }
}

impl From<PerceivedVru> for Perceived {
    fn from(vru: PerceivedVru) -> Self {
        Self {
            vru,
            has_id: true,
            has_velocity: true,
            error_m: ERROR_M,
        }
    }
}

/// Observation of a source at one time.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct SensorFrame {
    /// The source.
    pub source: u8,
    /// The area that it covers; `None` for the whole carriageway.
    pub covers: Option<Area>,
    /// Everybody it saw there.
    pub people: Vec<Perceived>,
}

impl SensorFrame {
    /// A frame of the first source that covers the whole carriageway, with these people.
    #[must_use]
    pub fn of(people: &[PerceivedVru]) -> Self {
        Self {
            people: people.iter().copied().map(Perceived::from).collect(),
            ..Self::default()
        }
    }
}

/// When something was observed.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Taken {
    /// Seconds from the beginning of the feed.
    At(f64),
    /// Seconds since 1970.
    Unix(f64),
}

/// Content of a line.
#[derive(Clone, PartialEq, Debug)]
pub enum Observation {
    /// A source looked at this time.
    Frame(SensorFrame, Taken),
    /// One person, told at this time; `None` is at once.
    Person(PerceivedVru, Option<f64>),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FrameLine {
    #[serde(default)]
    source: u8,
    at_s: Option<f64>,
    unix_s: Option<f64>,
    covers_m: Option<Vec<[f64; 2]>>,
    people: Vec<PersonInFrame>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PersonInFrame {
    id: Option<u32>,
    position_m: [f64; 2],
    velocity_mps: Option<[f64; 2]>,
    #[serde(default = "pedestrian")]
    class: VruClass,
    #[serde(default = "sure")]
    confidence: f64,
    #[serde(default = "usual_error")]
    error_m: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PersonLine {
    at_s: Option<f64>,
    id: u32,
    position_m: [f64; 2],
    velocity_mps: Option<[f64; 2]>,
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

const fn usual_error() -> f64 {
    ERROR_M
}

/// Why a line is no observation.
#[derive(Debug, thiserror::Error)]
pub enum PerceptionError {
    /// It is no JSON of this shape.
    #[error(
        "{0}; a frame is like {{\"at_s\": 1.5, \"people\": [{{\"id\": 7, \"position_m\": [3.0, -1.5], \
         \"velocity_mps\": [1.2, 0.0], \"class\": \"pedestrian\", \"confidence\": 0.9}}]}}"
    )]
    Syntax(#[from] serde_json::Error),
    /// It does not say when the source looked, or says it twice.
    #[error(
        "a frame wants either 'at_s', in seconds from the beginning, or 'unix_s', in seconds since 1970"
    )]
    Undated,
    /// A vehicle does not say how fast it is: whether it can stop is not known then.
    #[error(
        "a vehicle wants 'velocity_mps', in m/s to the east and to the north; one that stands has [0.0, 0.0]"
    )]
    Unhurried,
    /// There are too many people.
    #[error("{0} people: at most {PEOPLE_MAX} are possible")]
    Many(usize),
    /// The covered area is no polygon.
    #[error(transparent)]
    Covers(#[from] NoPolygon),
    /// A number is not possible.
    #[error(transparent)]
    Impossible(#[from] Impossible),
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] std::io::Error),
}

/// Understands a line.
///
/// # Errors
/// Why it is no observation.
pub fn parse(line: &str) -> Result<Observation, PerceptionError> {
    let value: serde_json::Value = serde_json::from_str(line)?;
    if value.get("id").is_none() || value.get("people").is_some() {
        return frame(serde_json::from_value(value)?);
    }
    let text: PersonLine = serde_json::from_value(value)?;
    possible("at_s", text.at_s.unwrap_or(0.0), 0.0..=1e6, "seconds")?;
    let vru = PerceivedVru {
        id: text.id,
        position_m: text.position_m,
        velocity_mps: text.velocity_mps.unwrap_or_default(),
        class: text.class,
        confidence: text.confidence,
    };
    check(&vru)?;
    // Of one person alone a velocity that is not said cannot be told from standing.
    let rides = matches!(vru.class, VruClass::Vehicle | VruClass::Motorcyclist);
    if rides && text.velocity_mps.is_none() {
        return Err(PerceptionError::Unhurried);
    }
    Ok(Observation::Person(vru, text.at_s))
}

fn frame(line: FrameLine) -> Result<Observation, PerceptionError> {
    let taken = match (line.at_s, line.unix_s) {
        (Some(at_s), None) => Taken::At(possible("at_s", at_s, 0.0..=1e6, "seconds")?),
        (None, Some(unix_s)) => Taken::Unix(possible(
            "unix_s",
            unix_s,
            0.0..=1e11,
            "seconds since 1970",
        )?),
        _ => return Err(PerceptionError::Undated),
    };
    if line.people.len() > PEOPLE_MAX {
        return Err(PerceptionError::Many(line.people.len()));
    }
    let covers = line.covers_m.map(|corners| {
        for metres in corners.iter().flatten() {
            possible("covers_m", *metres, -1e5..=1e5, "metres on the site")?;
        }
        Ok::<_, PerceptionError>(polygon("covers_m", corners)?)
    });
    let people = (0..).zip(line.people).map(|(number, it)| {
        let vru = PerceivedVru {
            id: it.id.unwrap_or(number),
            position_m: it.position_m,
            velocity_mps: it.velocity_mps.unwrap_or_default(),
            class: it.class,
            confidence: it.confidence,
        };
        check(&vru)?;
        if it.class == VruClass::Vehicle && it.velocity_mps.is_none() {
            return Err(PerceptionError::Unhurried);
        }
        Ok::<_, PerceptionError>(Perceived {
            vru,
            has_id: it.id.is_some(),
            has_velocity: it.velocity_mps.is_some(),
            error_m: possible("error_m", it.error_m, 0.0..=100.0, "0 to 100 m")?,
        })
    });
    let frame = SensorFrame {
        source: line.source,
        covers: covers.transpose()?,
        people: people.collect::<Result<_, _>>()?,
    };
    Ok(Observation::Frame(frame, taken))
}

/// Checks that there can be somebody like that.
///
/// # Errors
/// The value that is impossible.
pub fn check(vru: &PerceivedVru) -> Result<(), PerceptionError> {
    for metres in vru.position_m {
        possible("position_m", metres, -1e5..=1e5, "metres on the site")?;
    }
    let [across, along] = vru.velocity_mps;
    let speed_mps = across.hypot(along);
    possible("velocity_mps", speed_mps, 0.0..=163.8, "at most 163.8 m/s")?;
    possible("confidence", vru.confidence, 0.0..=1.0, "0 to 1")?;
    Ok(())
}

/// A road user on the site, as a robot at `place` sees it.
#[must_use]
pub fn seen_from(place: Place, vru: PerceivedVru) -> PerceivedVru {
    let [east, north] = vru.position_m;
    PerceivedVru {
        position_m: [east - place.east, north - place.north],
        ..vru
    }
}

/// For how long a source's newest frame tells of people, in ms.
const NEWEST_MS: u64 = 1_000;

/// Everybody in the newest frames of all sources: the robot's RAM tell of them.
#[derive(Clone, Debug, Default)]
pub struct Newest(BTreeMap<u8, (u64, Vec<PerceivedVru>)>);

impl Newest {
    /// Takes in a frame that was made at `taken_ms`, on any clock. Everybody then: every source has numbers of its own.
    pub fn look(&mut self, frame: &SensorFrame, taken_ms: u64) -> Vec<PerceivedVru> {
        let own = |id: u32| id ^ (u32::from(frame.source) << 24);
        let people = frame.people.iter().map(|it| PerceivedVru {
            id: own(it.vru.id),
            ..it.vru
        });
        let is_old = self
            .0
            .get(&frame.source)
            .is_some_and(|(known_ms, _)| *known_ms > taken_ms);
        if !is_old {
            self.0.insert(frame.source, (taken_ms, people.collect()));
        }
        let newest_ms = self.0.values().map(|(at_ms, _)| *at_ms).max();
        let newest_ms = newest_ms.unwrap_or(taken_ms);
        self.0
            .retain(|_, (at_ms, _)| newest_ms - *at_ms < NEWEST_MS);
        let everybody = self.0.values().flat_map(|(_, people)| people);
        let mut taken = BTreeSet::new();
        let people = everybody.map(|vru| {
            // A number that several have is that of the first: the others are announced, too.
            let mut numbers = (0..=u32::MAX).map(|step| vru.id.wrapping_sub(step));
            let id = numbers.find(|id| taken.insert(*id)).unwrap_or(vru.id);
            PerceivedVru { id, ..*vru }
        });
        people.collect()
    }
}

/// For how long a frame of a sensor source by one program keeps the number of that source from others.
pub(crate) const OF_SOURCE: Duration = Duration::from_secs(2);

/// A file, or a pipe, of observations that are told one after the other, each at its time.
#[derive(Clone, Debug)]
pub struct Feed {
    told: Arc<Mutex<Receiver<Order>>>,
    /// When it told the newest frame of each source.
    sources: Arc<Mutex<BTreeMap<u8, Instant>>>,
}

impl Feed {
    /// Opens a file; its times count from now on. A regular file is read at once, a pipe line by line. The robot does
    /// not wait for the writer of a FIFO: times count from when it comes.
    ///
    /// # Errors
    /// When it cannot be opened, or a line of a regular file is no observation: which, and why.
    pub fn open(path: &Path) -> Result<Self, String> {
        let kind = std::fs::metadata(path).map_err(|error| format!("{}: {error}", path.display()));
        let kind = kind?.file_type();
        let (tell, told) = sync_channel(AHEAD);
        let told = Arc::new(Mutex::new(told));
        // Each thread ends with the file, or when nobody listens any more.
        if kind.is_fifo() {
            let path = path.to_owned();
            std::thread::spawn(move || match observed(&path) {
                Ok(lines) => tell_in_time(lines, &tell, true),
                Err(why) => tell_in_time(std::iter::once(Err(why)), &tell, true),
            });
        } else if kind.is_file() {
            let all = observed(path)?.collect::<Result<Vec<_>, _>>()?;
            std::thread::spawn(move || tell_in_time(all.into_iter().map(Ok), &tell, false));
        } else {
            let lines = observed(path)?;
            std::thread::spawn(move || tell_in_time(lines, &tell, true));
        }
        let sources = Arc::default();
        Ok(Self { told, sources })
    }

    /// What a robot is to be told by now.
    #[must_use]
    pub fn due(&self) -> Vec<Order> {
        let told = self.told.lock().unwrap_or_else(PoisonError::into_inner);
        let due: Vec<_> = told.try_iter().take(AHEAD).collect();
        let now = Instant::now();
        let frames = due.iter().filter_map(|order| match order {
            Order::Looked(frame, _) => Some((frame.source, now)),
            _ => None,
        });
        self.sources().extend(frames);
        due
    }

    /// Whether it tells frames of this source now.
    #[must_use]
    pub fn has(&self, source: u8) -> bool {
        let newest = self.sources().get(&source).copied();
        newest.is_some_and(|at| at.elapsed() < OF_SOURCE)
    }

    fn sources(&self) -> MutexGuard<'_, BTreeMap<u8, Instant>> {
        let sources = self.sources.lock();
        sources.unwrap_or_else(PoisonError::into_inner)
    }
}

/// U+FEFF in UTF-8.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// The lines of a file, once it is open.
fn observed(
    path: &Path,
) -> Result<impl Iterator<Item = Result<Observation, String>> + Send + use<>, String> {
    let name = path.display().to_string();
    let file = File::open(path).map_err(|error| format!("{name}: {error}"))?;
    Ok(observations(name, BufReader::new(file)))
}

fn observations(
    name: String,
    file: impl BufRead + Send + 'static,
) -> impl Iterator<Item = Result<Observation, String>> + Send {
    let numbered = (1..).zip(lines(file));
    numbered.filter_map(move |(number, line)| {
        // Editors of some systems begin a file with a mark of its byte order.
        let line = line.map(|text| match text.strip_prefix(BYTE_ORDER_MARK) {
            Some(rest) if number == 1 => rest.to_vec(),
            _ => text,
        });
        let observation = match line {
            Ok(text) if text.trim_ascii().is_empty() => return None,
            Ok(text) => parse(&String::from_utf8_lossy(&text)).map_err(|error| error.to_string()),
            Err(error) => Err(error.to_string()),
        };
        Some(observation.map_err(|error| format!("{name}:{number}: {error}")))
    })
}

/// How far in the future a frame may be, for the resolution of clocks.
const FUTURE: Duration = Duration::from_millis(10);

fn tell_in_time(
    observations: impl Iterator<Item = Result<Observation, String>>,
    tell: &SyncSender<Order>,
    is_live: bool,
) {
    let began = Instant::now();
    // A live feed cannot know what is to come: to wait for it would make each of its frames young.
    let wait = |at_s: f64| {
        let due = began + Duration::from_secs_f64(at_s);
        let ahead = due.saturating_duration_since(Instant::now());
        if is_live && ahead > FUTURE {
            return Err(format!(
                "at_s is {at_s}: that is {:.3} s in the future; a program counts from when it opens the pipe, or says unix_s, and a \
                 recording is a regular file",
                ahead.as_secs_f64()
            ));
        }
        std::thread::sleep(ahead);
        Ok(due)
    };
    for observation in observations {
        let told = observation.and_then(|it| match it {
            Observation::Frame(frame, taken) => {
                let taken = match taken {
                    Taken::At(at_s) => wait(at_s),
                    Taken::Unix(unix_s) => instant_of(unix_s),
                };
                Ok(Order::Looked(Arc::new(frame), taken?))
            }
            Observation::Person(vru, at_s) => {
                wait(at_s.unwrap_or(0.0))?;
                Ok(Order::Perceived(vru))
            }
        });
        let told = told.unwrap_or_else(Order::LookedInVain);
        if tell.send(told).is_err() {
            return;
        }
    }
}

/// A moment of wall clock time, in seconds since 1970, on the clock of this machine.
///
/// # Errors
/// When it is in the future, or too long ago for that clock.
pub fn instant_of(unix_s: f64) -> Result<Instant, String> {
    let (now, unix_now) = (Instant::now(), SystemTime::now());
    let taken = SystemTime::UNIX_EPOCH + Duration::from_secs_f64(unix_s);
    match unix_now.duration_since(taken) {
        Ok(age) => now
            .checked_sub(age)
            .ok_or_else(|| format!("unix_s is {unix_s}: that is too long ago")),
        Err(ahead) if ahead.duration() <= FUTURE => Ok(now + ahead.duration()),
        Err(_) => Err(format!(
            "unix_s is {unix_s}: that is in the future of the clock"
        )),
    }
}

/// Last announcement in a robot's RAM, to tell a person when it changes.
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
    use crossguard_endpoint::ras::clustering::{Clustering, Settings};

    use super::*;
    use crate::table::rows;

    #[test]
    fn a_frame_has_defaults_and_takes_what_is_said() {
        let short = parse(r#"{"at_s": 2, "people": [{"position_m": [3, -1.5]}]}"#).unwrap();
        let Observation::Frame(frame, taken) = short else {
            panic!("no frame")
        };
        let it = frame.people[0];
        assert_eq!((frame.source, taken), (0, Taken::At(2.0)));
        assert_eq!(frame.covers, None);
        assert_eq!((it.has_id, it.has_velocity), (false, false));
        assert_eq!(it.vru.class, VruClass::Pedestrian);
        assert_eq!(it.sighting().id, None);
        assert_eq!(it.sighting().error_cm, 20);
        let full = r#"{"source": 2, "unix_s": 1.5, "covers_m": [[0, 0], [1, 0], [1, 1]], "people": [{"id": 7,
            "position_m": [3, 0], "velocity_mps": [1.2, 0], "class": "bicyclist", "confidence": 0.4, "error_m": 1}]}"#;
        let Observation::Frame(frame, taken) = parse(full).unwrap() else {
            panic!("no frame")
        };
        assert_eq!((frame.source, taken), (2, Taken::Unix(1.5)));
        let seen = frame.people[0].sighting();
        assert_eq!(
            (seen.id, seen.error_cm, seen.confidence),
            (Some(7), 100, 40)
        );
        assert!(matches!(frame.covers, Some(Area::Polygon(corners)) if corners.len() == 3));
    }

    #[test]
    fn point_9_a_byte_order_mark_is_left_out_at_the_beginning_alone() {
        let line = r#"{"at_s": 1, "people": []}"#;
        let file = format!("\u{feff}{line}\n\u{feff}{line}\n");
        let read = observations("people".to_owned(), std::io::Cursor::new(file));
        let read: Vec<_> = read.map(|it| it.is_ok()).collect();
        assert_eq!(read, [true, false]);
    }

    /// Hazard: a robot hangs at its start, and nobody knows why.
    #[test]
    fn a_fifo_is_told_of_when_its_writer_comes_and_nobody_waits_for_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("people");
        nix::unistd::mkfifo(&path, nix::sys::stat::Mode::S_IRWXU).unwrap();
        let (tell, opened) = sync_channel(1);
        let at = path.clone();
        std::thread::spawn(move || tell.send(Feed::open(&at)));
        let feed = opened.recv_timeout(Duration::from_secs(30)).unwrap();
        let feed = feed.unwrap();
        assert_eq!(feed.due(), []);
        // A program that counts from before it opened the pipe: its frames are older than they say.
        let ahead = r#"{"at_s": 3600, "people": []}"#;
        let person = r#"{"at_s": 3600, "id": 7, "position_m": [3, 0]}"#;
        std::fs::write(&path, format!("null\n{ahead}\n{person}\n")).unwrap();
        let told = feed.told.lock().unwrap();
        for cause in ["people:1: ", "s in the future", "s in the future"] {
            let told = told.recv_timeout(Duration::from_secs(30)).unwrap();
            assert!(
                matches!(&told, Order::LookedInVain(why) if why.contains(cause)),
                "{told:?}"
            );
        }
    }

    #[test]
    fn a_line_with_one_person_adds_that_person() {
        let line = r#"{"at_s": 1.5, "id": 7, "position_m": [3, 0], "velocity_mps": [1.2, 0],
                       "class": "bicyclist", "confidence": 0.4}"#;
        let Observation::Person(vru, at_s) = parse(line).unwrap() else {
            panic!("no person")
        };
        assert_eq!((at_s, vru.class), (Some(1.5), VruClass::Bicyclist));
        let seen = seen_from(Place::new(1.0, 2.0), vru);
        assert_eq!(
            seen,
            PerceivedVru {
                position_m: [2.0, -2.0],
                ..vru
            }
        );
    }

    #[test]
    fn a_frame_counts_from_when_it_was_made() {
        let unix_s = |ago: Duration| {
            let at = SystemTime::now() - ago;
            let since = at.duration_since(SystemTime::UNIX_EPOCH).unwrap();
            since.as_secs_f64()
        };
        let taken = instant_of(unix_s(Duration::from_secs(3))).unwrap();
        assert!(taken.elapsed() >= Duration::from_millis(2_900));
        let future = unix_s(Duration::ZERO) + 60.0;
        assert!(instant_of(future).unwrap_err().contains("in the future"));
    }

    /// Hazard: two people of one number, or one without a number beside another, are one in RAM: nobody is told of the second.
    #[test]
    fn everybody_in_the_newest_frames_has_a_number_of_their_own() {
        let people = |line: &str| -> Vec<[f64; 2]> {
            let Observation::Frame(frame, _) = parse(line).unwrap() else {
                panic!("no frame")
            };
            let seen = Newest::default().look(&frame, 0);
            let mut clustering = Clustering::new(Settings::default(), 1);
            clustering.perceive(0, [0.0, 0.0], &seen);
            assert_eq!(clustering.members(), frame.people.len(), "{line}");
            seen.iter().map(|it| it.position_m).collect()
        };
        for ids in [
            ["\"id\": 7, ", "\"id\": 7, "],
            ["", "\"id\": 0, "],
            ["\"id\": 1, ", ""],
            ["", ""],
        ] {
            let [one, two] = ids;
            let line = format!(
                r#"{{"at_s": 1, "people": [{{{one}"position_m": [1, 0]}}, {{{two}"position_m": [2, 0]}}]}}"#
            );
            assert_eq!(people(&line), [[1.0, 0.0], [2.0, 0.0]]);
        }
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

    /// A line that is no observation, and what is said of it. `MANY` stands for one person more than there can be.
    const MISUNDERSTOOD: &str = r#"
{}                                                               | missing field `people`
{"people": []}                                                   | a frame wants either 'at_s'
{"people": [], "at_s": 1, "unix_s": 1}                           | a frame wants either 'at_s'
{"people": [MANY], "at_s": 1}                                    | 257 people: at most 256 are possible
{"people": [], "at_s": -1}                                       | at_s is -1
{"people": [], "at_s": 1, "covers_m": []}                        | covers_m has 0 corners: 3 to 64 are possible
{"people": [], "at_s": 1, "covers_m": [[0, 0], [9, 9]]}          | covers_m has 2 corners
{"people": [], "at_s": 1, "covers_m": [[0, 0], [9, 9], [9, 0], [0, 9]]} | covers_m: its sides 1 and 3 cross
{"people": [], "at_s": 1, "covers_m": [[0, 0], [9, 9], [1, 1]]}  | covers_m: its corners enclose nothing
{"people": [], "at_s": 1, "source": -1}                          | invalid value
{"people": [{"position_m": [1, 2], "error_m": -1}], "at_s": 1}   | error_m is -1
{"people": [{"position_m": [1, 2], "class": "vehicle"}], "at_s": 1} | a vehicle wants 'velocity_mps'
{"id": 1, "position_m": [1, 2], "class": "vehicle"}              | a vehicle wants 'velocity_mps'
{"id": 1, "position_m": [1, 2], "class": "motorcyclist"}         | a vehicle wants 'velocity_mps'
{"id": 1, "place": 3}                                            | unknown field `place`
{"id": 1, "position_m": [1, 2], "class": "car"}                  | unknown variant `car`
{"id": 1, "position_m": [1, 2], "confidence": 1.5}               | confidence is 1.5: 0 to 1 is wanted
{"id": 1, "position_m": [1, 1e9]}                                | position_m is 1000000000: metres on the site is wanted
{"id": 1, "position_m": [1, 2], "at_s": -1}                      | at_s is -1
"#;

    #[test]
    fn what_is_no_observation_is_answered_with_what_would_be() {
        let many = vec![r#"{"position_m": [1, 2]}"#; PEOPLE_MAX + 1].join(", ");
        for [line, answer] in rows(MISUNDERSTOOD) {
            let error = parse(&line.replace("MANY", &many)).unwrap_err();
            assert!(error.to_string().contains(&answer), "{line}: {error}");
        }
    }
}
