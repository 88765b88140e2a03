//! Outputs of `crossguard run`, from threads of their own: a reader that does not read does not hold the robot up.

use std::io::{Stdout, Write};
use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::Receiver;

use crossguard_endpoint::cause::Cause;
use crossguard_robot::journal::{Journal, RECORDS, WhenFull};
use crossguard_robot::robot_file::RobotFile;
use crossguard_robot::street::Road;
use crossguard_robot::trace::{self, LogFile, LogLimits, Record};

use super::super::Failure;
use super::super::printable::Printable;
use super::super::writing::{Lines, Writing, complain};

/// Name of standard output.
const STDOUT: &str = "standard output";

/// Where a robot's records go.
pub(super) struct Outputs {
    pub(super) journal: Journal,
    /// Records for the console, which need not have all.
    pub(super) records: Receiver<Arc<Record>>,
    /// Where the console says something to people; nowhere, when standard output is the log.
    pub(super) lines: Option<Lines>,
    pub(super) writings: Writings,
}

impl Outputs {
    /// Opens a log file, if there is to be one, and standard output.
    pub(super) fn open(log: Option<&Path>, is_json: bool) -> Result<Self, Failure> {
        let mut journal = Journal::new();
        let records = journal.reader(RECORDS, WhenFull::Skip, Cause::OutputFull);
        let mut of_log = || journal.reader(RECORDS, WhenFull::End, Cause::LogFull);
        let mut writings = Vec::new();
        if let Some(path) = log {
            writings.push(to_file(path, of_log())?);
        }
        let mut lines = None;
        if is_json {
            writings.push(to_stdout(of_log()));
        } else {
            let (for_people, writing) = Lines::start(STDOUT, say);
            lines = Some(for_people);
            writings.push(writing);
        }
        Ok(Self {
            journal,
            records,
            lines,
            writings: Writings(writings),
        })
    }
}

/// The threads that write.
pub(super) struct Writings(Vec<Writing>);

impl Writings {
    /// Waits until all is written, but not for a reader who does not read. `missing` records did not
    /// get into a log, by the robot's account.
    pub(super) fn finish(self, missing: u64) -> Result<(), Failure> {
        let finished: Vec<_> = self.0.into_iter().map(Writing::finish).collect();
        if missing > 0 {
            complain(format_args!(
                "a log ends before the robot did: its reader was too slow for {missing} records"
            ));
            return Err(Failure::Incomplete);
        }
        finished.into_iter().collect()
    }
}

/// Prints a line for people.
fn say(line: &str) -> std::io::Result<()> {
    writeln!(std::io::stdout(), "{}", Printable(line))
}

/// Writes records to a file.
fn to_file(path: &Path, records: Receiver<Arc<Record>>) -> Result<Writing, Failure> {
    let name = path.display().to_string();
    let file = LogFile::create(path, LogLimits::default());
    let file = file.map_err(|error| Failure::Input(format!("{name}: {error}")))?;
    let write = |to: &mut LogFile, record: &Arc<Record>| to.write(record);
    Ok(Writing::start(name, records, file, write, LogFile::flush))
}

/// Writes records to standard output.
fn to_stdout(records: Receiver<Arc<Record>>) -> Writing {
    let write = |to: &mut Stdout, record: &Arc<Record>| trace::write(to, record);
    Writing::start(
        STDOUT.to_owned(),
        records,
        std::io::stdout(),
        write,
        Stdout::flush,
    )
}

/// Says on standard error that a robot does not know where its carriageway is, or not by its sensors who is on it.
pub(super) fn warn_of_no_road(file: &RobotFile, is_perceiving: bool) {
    let name = &file.name;
    match file.road() {
        Road::Unknown => complain(format_args!(
            "warning: the site of {name} has no kerbs_m, so it does not know where the carriageway is: it steps on it in front of \
             vehicles, and does not leave it by itself; say kerbs_m in the site file, or road_m in [zone]"
        )),
        Road::Own(_) if is_perceiving || file.body_port.is_some() => complain(format_args!(
            "warning: {name} leads and has no [zone], so the people who cross are those of a simulation, whatever its sensors \
             have: its guards leave the road when these are across; say [zone] where people are real"
        )),
        Road::Heard(_) if is_perceiving => complain(format_args!(
            "warning: {name} has no [zone], so the people that its sensors have count as people whom others report: it ends its task \
             at its leader's word, and its sensors never clear the road; say [zone] with road_m"
        )),
        _ => {}
    }
}
