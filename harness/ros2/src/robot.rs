//! The robot of an active node: its endpoint, link, body and log.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::Receiver;
use std::thread::JoinHandle;
use std::time::Duration;

use crossguard_codec::security::Unsigned;
use crossguard_endpoint::cause::Cause;
use crossguard_endpoint::station::{Mode, Security};
use crossguard_robot::body::Body;
use crossguard_robot::boot::{self, BootError};
use crossguard_robot::journal::{self, Journal, RECORDS, WhenFull};
use crossguard_robot::pki::{self, PkiError};
use crossguard_robot::robot_file::{Besides, RobotFile, RobotFileError};
use crossguard_robot::runtime::{Clock, Order, Running};
use crossguard_robot::trace::{LogFile, LogLimits, Record};
use crossguard_robot::transport::{LinkError, Reopening, Transport};

use crate::acts::Acts;

/// After how many milliseconds a pseudonym changes, outside of sessions.
const PSEUDONYM_PERIOD_MS: u64 = 300_000;

/// Where a robot's configuration is, and where its log goes.
#[derive(Clone, Debug)]
pub struct Robot {
    /// The configuration, as `crossguard run` takes it.
    pub config: PathBuf,
    /// The site, instead of that of the configuration.
    pub site: Option<PathBuf>,
    /// What it does when it leads, instead of the configured plan: a file, or the name of one that comes with the kit.
    pub plan: Option<PathBuf>,
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
    /// As `crossguard run` has it: another process at the port of the table `[body]`, if the configuration has one,
    /// and simulated otherwise.
    #[default]
    Configured,
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
    /// Two are to move the body.
    #[error(
        "--body external and the table [body] of {}: one of them is wanted; without --body the body connects at the \
         port of that table", .0.display()
    )]
    TwoBodies(PathBuf),
    /// The port of its body cannot be opened.
    #[error("[body] {address}: {cause}")]
    BodyPort {
        /// Where the body would connect.
        address: String,
        /// Why.
        cause: std::io::Error,
    },
    /// Its body is moved by a graph that it does not trust.
    #[error(
        "--security enforce takes nothing from the ROS graph, and --body external is moved by it: write \
         'trust_ros_graph = true' into {} if every node that can publish on ~/command and ~/pose may move this robot",
        .0.display()
    )]
    UntrustedBody(PathBuf),
    /// A revocation list without anything that is signed.
    #[error(
        "'revoked' in {} is of no use without --security sign or --security enforce", .0.display()
    )]
    NothingToRevoke(PathBuf),
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
    log: Option<JoinHandle<()>>,
}

impl Robot {
    /// Its configuration, with the site and the plan that are said beside it, as `crossguard run` reads them.
    pub(crate) fn file(&self) -> Result<RobotFile, NoRobot> {
        let besides = Besides {
            site_file: self.site.as_deref(),
            plan_file: self.plan.as_deref(),
        };
        let file = RobotFile::read_with(&self.config, besides)?;
        let path = || self.config.clone();
        match (self.body, &file.body_port) {
            (BodyKind::External, Some(_)) => Err(NoRobot::TwoBodies(path())),
            (BodyKind::External, _) if !self.trusts_graph(&file) => {
                Err(NoRobot::UntrustedBody(path()))
            }
            _ if self.security == Mode::Off && file.revoked.is_some() => {
                Err(NoRobot::NothingToRevoke(path()))
            }
            _ => Ok(file),
        }
    }

    /// Whether what comes over ROS topics, which nobody signs, reaches the robot: not where all packets have to be
    /// signed, unless its file says so.
    pub(crate) fn trusts_graph(&self, file: &RobotFile) -> bool {
        self.security != Mode::Enforce || file.trust_ros_graph
    }
}

impl Active {
    /// Has the robot of `file` be there, whose acts go to `acts`. Its records come out of the queue,
    /// which ends with it.
    pub(crate) fn start(
        robot: &Robot,
        file: &RobotFile,
        acts: &Acts,
    ) -> Result<(Self, Receiver<Arc<Record>>), NoRobot> {
        let link = Reopening(file.link.clone()).open()?;
        let security = security(robot, file)?;
        let mut journal = Journal::new();
        let records = journal.reader(RECORDS, WhenFull::Skip, Cause::OutputFull);
        let log = match &robot.log {
            None => None,
            Some(path) => {
                let records = journal.reader(RECORDS, WhenFull::End, Cause::LogFull);
                Some(write_log(path, records)?)
            }
        };
        let body: Box<dyn Body> = match robot.body {
            BodyKind::Configured => file.body_or_port(robot.seed).map_err(|cause| {
                let port = file.body_port.as_ref();
                let address = port.map_or_else(String::new, |port| port.address.to_string());
                NoRobot::BodyPort { address, cause }
            })?,
            BodyKind::External => Box::new(file.external_body(acts.driver())),
        };
        // The counter is taken last, when nothing else can go wrong, and before anything is sent.
        let mut boot = boot::take(&file.boot_file)?;
        if security.signs() {
            boot = boot.remembering()?;
        }
        let mut setup = file.setup(boot, body, security, link, journal);
        let listener = acts.listener(robot.body == BodyKind::Configured);
        setup.application = setup.application.heard_by(listener);
        let clock = setup.clock;
        let mut running = setup.start();
        if let Some(list) = &file.revoked {
            running.keep_revoked(list.clone());
        }
        let active = Self {
            running,
            clock,
            log,
        };
        Ok((active, records))
    }

    /// Tells the robot something.
    pub(crate) fn order(&self, order: Order) {
        self.running.order(order);
    }

    /// The time on the robot's clock, in µs.
    pub(crate) fn now_us(&self) -> u64 {
        self.clock.now_us()
    }

    /// How long ago it was this many µs on the robot's clock.
    pub(crate) fn age(&self, at_us: u64) -> Duration {
        Duration::from_micros(self.now_us().saturating_sub(at_us))
    }

    /// How many datagrams found no place.
    pub(crate) fn inbox_full(&self) -> u64 {
        self.running.inbox_full()
    }

    /// Waits until the robot, which has stopped, has put everything away.
    pub(crate) fn put_away(self) {
        // A panic has been logged.
        let _ = self.running.wait();
        if let Some(log) = self.log {
            // A panic has been printed by its thread; there is nothing to add.
            let _ = log.join();
        }
    }
}

fn security(robot: &Robot, file: &RobotFile) -> Result<Security, NoRobot> {
    if robot.security == Mode::Off {
        return Ok(Security::default());
    }
    let folder = robot.pki.as_deref().ok_or(NoRobot::NoPki)?;
    let credentials = pki::credentials_but(folder, &file.name, file.revoked.as_deref())?.shuffled();
    let period = Some(PSEUDONYM_PERIOD_MS);
    Ok(Security::new(
        robot.security,
        credentials,
        period,
        pki::now(),
    )?)
}

/// Writes records to a file, in a thread that ends with them.
fn write_log(path: &Path, records: Receiver<Arc<Record>>) -> Result<JoinHandle<()>, NoRobot> {
    let file = LogFile::create(path, LogLimits::default()).map_err(|cause| NoRobot::Log {
        path: path.to_owned(),
        cause,
    })?;
    let path = path.to_owned();
    Ok(std::thread::spawn(move || {
        let mut file = file;
        let write = |to: &mut LogFile, record: &Arc<Record>| to.write(record);
        if let Err(error) = journal::write_out(&records, &mut file, write, LogFile::flush) {
            tracing::error!(path = %path.display(), %error, "the log ends");
        }
    }))
}
