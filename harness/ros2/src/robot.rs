//! The robot of an active node: its endpoint, link, body and log.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError};
use std::thread::JoinHandle;
use std::time::Duration;

use crossguard_codec::security::Unsigned;
use crossguard_harness::application::Application;
use crossguard_harness::body::Body;
use crossguard_harness::boot::{self, Boot, BootError};
use crossguard_harness::counters::Cause;
use crossguard_harness::journal::{Journal, WhenFull};
use crossguard_harness::pki::{self, PkiError};
use crossguard_harness::plan::Plan;
use crossguard_harness::robot_file::{RobotFile, RobotFileError};
use crossguard_harness::runtime::{Clock, Order, Running, Setup};
use crossguard_harness::station::{Mode, Security};
use crossguard_harness::trace::{self, Record};
use crossguard_harness::transport::{LinkError, Reopening, Transport};
use crossguard_harness::wire::Wire;

/// How many records wait for each of their readers: about ten seconds of a busy robot.
const RECORDS: usize = 4_096;

/// After how many milliseconds a pseudonym changes, outside of sessions.
const PSEUDONYM_PERIOD_MS: u64 = 300_000;

/// Where a robot's configuration is, and where its log goes.
#[derive(Clone, Debug)]
pub struct Robot {
    /// The configuration, as `crossguard run` takes it.
    pub config: PathBuf,
    /// Where the log goes, if anywhere: one JSON object per line. Every activation begins it anew.
    pub log: Option<PathBuf>,
    /// Whether packets are signed, and those of others verified.
    pub security: Mode,
    /// The folder of the PKI or the robot's own, for packets that are signed.
    pub pki: Option<PathBuf>,
    /// Who moves its body.
    pub body: BodyKind,
    /// Seed of the gait of the simulated body.
    pub seed: u64,
}

/// Who moves a body.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, clap::ValueEnum)]
pub enum BodyKind {
    /// It is simulated here: it walks where maneuvers lead and finishes them.
    #[default]
    Simulated,
    /// Others move it, by what `~/event` says, and tell where it is on `~/pose` and when a maneuver ends on
    /// `~/command`.
    External,
}

/// Why there is no robot.
#[derive(Debug, thiserror::Error)]
pub enum NoRobot {
    /// Its configuration cannot be used.
    #[error(transparent)]
    Configuration(#[from] RobotFileError),
    /// There is no boot counter.
    #[error(transparent)]
    Boot(#[from] BootError),
    /// The link cannot be opened.
    #[error(transparent)]
    Link(#[from] LinkError),
    /// The log cannot be written.
    #[error("{}: {cause}", path.display())]
    Log {
        /// The file.
        path: PathBuf,
        /// Why.
        cause: std::io::Error,
    },
    /// It has no certificates and keys.
    #[error(transparent)]
    Pki(#[from] PkiError),
    /// The certificates are wanted, and not said where.
    #[error("signing wants the certificates and keys of the robot: say in which folder")]
    NoPki,
    /// Its certificates are of no use.
    #[error(transparent)]
    Security(#[from] Unsigned),
}

/// A robot that is there.
pub(crate) struct Active {
    running: Running,
    clock: Clock,
    /// Held so that no other process takes the same counter.
    _boot: Boot,
    log: Option<JoinHandle<()>>,
}

impl Active {
    /// Has the robot of `file` be there. Its records come out of the queue, which ends with it.
    pub(crate) fn start(
        robot: &Robot,
        file: &RobotFile,
    ) -> Result<(Self, Receiver<Arc<Record>>), NoRobot> {
        let link = Reopening(file.link.clone()).open()?;
        let security = security(robot, &file.name)?;
        let mut journal = Journal::new();
        let records = journal.reader(RECORDS, WhenFull::Skip, Cause::OutputFull);
        let log = match &robot.log {
            None => None,
            Some(path) => {
                let records = journal.reader(RECORDS, WhenFull::End, Cause::LogFull);
                Some(write_log(path, records)?)
            }
        };
        // The counter is taken last, when nothing else can go wrong, and before anything is sent.
        let boot = boot::take(&file.boot_file)?;
        let body = Body::new(file.build, file.site, file.place, file.speed, robot.seed);
        let body = match robot.body {
            BodyKind::Simulated => body,
            BodyKind::External => body.moved_by_others(),
        };
        let plan = file.autopilot.then(|| Plan::crossing(file.site));
        let clock = Clock::start();
        let running = Setup {
            name: file.name.clone(),
            station: file.station,
            boot: boot.counter,
            config: file.config.clone(),
            wire: Wire {
                identifiers: file.identifiers,
            },
            security,
            awareness: file.awareness,
            application: Application::new(body, plan),
            link,
            journal,
            clock,
        }
        .start();
        let active = Self {
            running,
            clock,
            _boot: boot,
            log,
        };
        Ok((active, records))
    }

    /// Tells the robot something.
    pub(crate) fn order(&self, order: Order) {
        self.running.order(order);
    }

    /// How long ago it was so many µs on the robot's clock.
    pub(crate) fn age(&self, at_us: u64) -> Duration {
        Duration::from_micros(self.clock.now_us().saturating_sub(at_us))
    }

    /// How many datagrams found no place.
    pub(crate) fn inbox_full(&self) -> u64 {
        self.running.inbox_full()
    }

    /// Waits until the robot, which has stopped, has put everything away.
    pub(crate) fn put_away(self) {
        self.running.wait();
        if let Some(log) = self.log {
            // A panic has been printed by its thread; there is nothing to add.
            let _ = log.join();
        }
    }
}

fn security(robot: &Robot, name: &str) -> Result<Security, NoRobot> {
    if robot.security == Mode::Off {
        return Ok(Security::default());
    }
    let folder = robot.pki.as_deref().ok_or(NoRobot::NoPki)?;
    let credentials = pki::credentials_of(folder, name)?;
    let period = Some(PSEUDONYM_PERIOD_MS);
    Ok(Security::new(
        robot.security,
        credentials,
        period,
        pki::now(),
    )?)
}

/// Writes records to a file, in a thread that ends with them. What is written is not kept back while
/// nothing comes.
fn write_log(path: &Path, records: Receiver<Arc<Record>>) -> Result<JoinHandle<()>, NoRobot> {
    let file = File::create(path).map_err(|cause| NoRobot::Log {
        path: path.to_owned(),
        cause,
    })?;
    let path = path.to_owned();
    Ok(std::thread::spawn(move || {
        if let Err(error) = write_all(&records, &mut BufWriter::new(file)) {
            tracing::error!(path = %path.display(), %error, "the log ends");
        }
    }))
}

fn write_all(records: &Receiver<Arc<Record>>, to: &mut impl Write) -> std::io::Result<()> {
    loop {
        let next = match records.try_recv() {
            Ok(record) => record,
            Err(TryRecvError::Disconnected) => return to.flush(),
            Err(TryRecvError::Empty) => {
                to.flush()?;
                match records.recv() {
                    Ok(record) => record,
                    Err(_) => return Ok(()),
                }
            }
        };
        trace::write(to, &next)?;
    }
}
