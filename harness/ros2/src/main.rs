//! `crossguard-ros2`: a robot as a node of ROS 2.
//!
//! Exit codes: 0 it was told to end and did, 2 bad usage or input, 3 it could not end in order.

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::mpsc::sync_channel;

use clap::Parser;
use crossguard_endpoint::station::Mode;
use crossguard_robot::observe::to_standard_error;
use crossguard_ros2::entity::NodeName;
use crossguard_ros2::graph::Meeting;
use crossguard_ros2::node::{self, NotStarted, Options};
use crossguard_ros2::robot::{BodyKind, Robot};

/// A Crossguard robot as a lifecycle node of ROS 2, for systems whose RMW is that of zenoh.
#[derive(Parser)]
#[command(name = "crossguard-ros2", version, max_term_width = 100, after_help = AFTER_HELP)]
struct Arguments {
    /// The robot's configuration, as 'crossguard run' takes it; read when the node is configured.
    #[arg(long, value_name = "FILE")]
    config: PathBuf,
    /// The site, instead of that of the configuration; see 'crossguard site'.
    #[arg(long, value_name = "FILE")]
    site: Option<PathBuf>,
    /// What the robot does when it leads, instead of the configured plan: a file, or the name of one that comes with
    /// the kit, like bilateral or trio.
    #[arg(long, value_name = "FILE|NAME")]
    plan: Option<PathBuf>,
    /// The ROS domain.
    #[arg(long, env = "ROS_DOMAIN_ID", default_value_t = 0)]
    domain: u32,
    /// The node's namespace, one for each robot.
    #[arg(long, default_value = "/")]
    namespace: String,
    /// The node's name.
    #[arg(long, default_value = "crossguard")]
    name: String,
    /// A zenoh router or peer to connect to; may be given several times.
    #[arg(long, value_name = "ENDPOINT", default_value = "tcp/localhost:7447")]
    zenoh_connect: Vec<String>,
    /// Connect to nobody, and wait for peers only.
    #[arg(long, conflicts_with = "zenoh_connect")]
    no_connect: bool,
    /// Where to wait for peers; may be given several times.
    #[arg(long, value_name = "ENDPOINT", default_value = "tcp/localhost:0")]
    zenoh_listen: Vec<String>,
    /// Configure and activate the node at once.
    #[arg(long)]
    autostart: bool,
    /// Whether packets to other robots are signed (TS 103 097) and theirs verified.
    #[arg(long, value_name = "off|sign|enforce", default_value_t = Mode::Off)]
    security: Mode,
    /// The folder with certificates and keys, of the robot or of the PKI (see 'crossguard pki').
    #[arg(long, value_name = "FOLDER")]
    pki: Option<PathBuf>,
    /// Write the robot's log to this file, one JSON object per line; every activation begins it anew.
    #[arg(long, value_name = "FILE")]
    log: Option<PathBuf>,
    /// Who moves the body: as 'crossguard run' has it, a process at the port of the table [body] or else nobody, it is
    /// simulated; or other nodes, by ~/event, ~/pose and ~/command.
    #[arg(long, value_enum, default_value_t = BodyKind::Configured)]
    body: BodyKind,
    /// Seed of the gait of the simulated body.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    #[arg(short, long, action = clap::ArgAction::Count, help = VERBOSE)]
    verbose: u8,
}

const VERBOSE: &str =
    "Tell on standard error what happens: -v for a little, -vv and -vvv for more; or by RUST_LOG";

const AFTER_HELP: &str = "\
Topics ~/status, ~/corridor, ~/event, ~/transition_event and /diagnostics; ~/command,
~/perceived, ~/pose and ~/battery are listened to. Without --autostart, the lifecycle is up to you:
  ros2 lifecycle set /NAMESPACE/crossguard configure
  ros2 lifecycle set /NAMESPACE/crossguard activate
Messages are in the package crossguard_msgs, which comes along. Ctrl-C or SIGTERM makes the robot leave
its session in order and the node end.

Exit codes: 0 it was told to end and did, 2 bad usage or input, 3 it could not end in order.";

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let targets = ["crossguard_robot", "crossguard_ros2"];
    let _written = to_standard_error(arguments.verbose, &targets);
    let (stop, stopped) = sync_channel(1);
    let interrupted = move || {
        // A second Ctrl-C should still end a process that does not stop by itself.
        if stop.try_send(()).is_err() {
            std::process::exit(130);
        }
    };
    // It can only fail when there is a handler already, and there is none.
    let _ = ctrlc::set_handler(interrupted);
    let running =
        match options(arguments).and_then(|it| node::start(&it).map_err(|it| it.to_string())) {
            Ok(running) => running,
            Err(error) => {
                complain(&error);
                return ExitCode::from(2);
            }
        };
    println!("The node is there. Ctrl-C ends it.");
    // The sender lives as long as the process.
    let _ = stopped.recv();
    match running.stop() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            complain(&NotStarted::from(error).to_string());
            ExitCode::from(3)
        }
    }
}

fn options(arguments: Arguments) -> Result<Options, String> {
    let name = NodeName::new(&arguments.namespace, &arguments.name);
    if arguments.security != Mode::Off && arguments.pki.is_none() {
        return Err(
            "--security wants the certificates and keys of the robot: --pki FOLDER; 'crossguard pki \
             init FOLDER' makes some"
                .to_owned(),
        );
    }
    Ok(Options {
        meeting: Meeting {
            domain: arguments.domain,
            connect: if arguments.no_connect {
                Vec::new()
            } else {
                arguments.zenoh_connect
            },
            listen: arguments.zenoh_listen,
        },
        name: name.map_err(|error| error.to_string())?,
        robot: Robot {
            config: arguments.config,
            site: arguments.site,
            plan: arguments.plan,
            log: arguments.log,
            security: arguments.security,
            pki: arguments.pki,
            body: arguments.body,
            seed: arguments.seed,
        },
        autostart: arguments.autostart,
    })
}

/// If standard error is gone, there is nobody to tell.
fn complain(what: &str) {
    let _ = writeln!(std::io::stderr(), "crossguard-ros2: {what}");
}
