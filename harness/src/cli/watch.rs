//! How a running robot is shown while it runs: a status line, and metrics.

use std::io::{IsTerminal, Write};
use std::net::{Ipv4Addr, SocketAddr};
use std::sync::mpsc::sync_channel;
use std::time::Duration;

use clap::ValueEnum;
use crossguard_endpoint::cause::Cause;
use crossguard_harness::metrics::{self, Shared};
use crossguard_robot::runtime::Running;
use crossguard_robot::trace::Record;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::Failure;

/// How often the status line is drawn, on a terminal and where lines stay.
const REDRAW: Duration = Duration::from_millis(200);
const REPEAT: Duration = Duration::from_secs(1);

/// How a running robot is shown.
#[derive(clap::Args)]
pub(super) struct WatchArguments {
    /// Whether a status line is shown on standard error; by default where that is a terminal.
    #[arg(long, value_enum, value_name = "WHEN", default_value = "auto")]
    status: When,
    /// Serve metrics for Prometheus at this address, or at this port of 127.0.0.1.
    #[arg(long, value_name = "[ADDRESS:]PORT", value_parser = address)]
    metrics: Option<SocketAddr>,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum When {
    Auto,
    Always,
    Never,
}

fn address(text: &str) -> Result<SocketAddr, String> {
    if let Ok(port) = text.parse::<u16>() {
        return Ok((Ipv4Addr::LOCALHOST, port).into());
    }
    text.parse().map_err(|_| {
        "a port from 0 to 65535, or an address and a port like 127.0.0.1:9100, is wanted".to_owned()
    })
}

/// What is shown of a running robot.
pub(super) struct Watch {
    tally: Shared,
    /// Hidden where there is no live line.
    bar: ProgressBar,
    /// Where metrics are served.
    pub(super) metrics: Option<SocketAddr>,
}

impl WatchArguments {
    /// Begins to show a robot on this link, in this mode of security. Nothing but its log may be on a standard output
    /// that is for programs.
    pub(super) fn begin(&self, link: String, security: &'static str) -> Result<Watch, Failure> {
        let tally = Shared::default();
        tally.with(|tally| (tally.link, tally.security) = (link, security));
        let metrics = match self.metrics {
            None => None,
            Some(address) => {
                let served = metrics::serve(address, tally.clone());
                Some(
                    served
                        .map_err(|error| Failure::Input(format!("--metrics {address}: {error}")))?,
                )
            }
        };
        let is_terminal = std::io::stderr().is_terminal();
        let is_shown = match self.status {
            When::Auto => is_terminal,
            When::Always => true,
            When::Never => false,
        };
        let bar = if is_shown && is_terminal {
            live_line()
        } else {
            ProgressBar::hidden()
        };
        if is_shown {
            let (tally, bar) = (tally.clone(), bar.clone());
            // A thread of its own: who holds standard error up holds up nothing else.
            std::thread::spawn(move || draw(&tally, &bar));
        }
        Ok(Watch {
            tally,
            bar,
            metrics,
        })
    }
}

fn live_line() -> ProgressBar {
    let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
    let style = ProgressStyle::with_template("{wide_msg}");
    bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

/// Draws the status line until the robot has stopped.
fn draw(tally: &Shared, bar: &ProgressBar) {
    loop {
        std::thread::sleep(if bar.is_hidden() { REPEAT } else { REDRAW });
        let (text, has_stopped) = tally.with(|tally| (tally.line(), tally.has_stopped));
        if has_stopped {
            return bar.finish_and_clear();
        }
        if bar.is_hidden() {
            // Standard error may be gone; the robot goes on.
            let _ = writeln!(std::io::stderr(), "{text}");
        } else {
            bar.set_message(text);
        }
    }
}

impl Watch {
    /// Takes in what the robot did.
    pub(super) fn record(&self, record: &Record) {
        self.tally.with(|tally| tally.record(record));
    }

    /// What was heard of other stations, and who is around.
    pub(super) fn surroundings(&self) -> String {
        self.tally.with(|tally| tally.surroundings())
    }

    /// Its link, its security, its clock and its channel.
    pub(super) fn equipment(&self) -> String {
        self.tally.with(|tally| tally.equipment())
    }

    /// Takes in what no record tells.
    pub(super) fn look(&self, running: &Running) {
        let inbox_full = running.inbox_full();
        if inbox_full > 0 {
            let cause = Cause::InboxFull.into();
            self.tally
                .with(|tally| tally.causes.set(&cause, inbox_full));
        }
    }

    /// The status line, above which other lines stand.
    pub(super) fn bar(&self) -> ProgressBar {
        self.bar.clone()
    }
}

impl Drop for Watch {
    /// Takes the status line away, but does not wait for a reader that holds standard output or error up: a
    /// line above the status line may be on its way to one who does not read.
    fn drop(&mut self) {
        let (tell, is_done) = sync_channel(1);
        let bar = self.bar.clone();
        std::thread::spawn(move || {
            bar.finish_and_clear();
            // Nobody may wait any more.
            let _ = tell.send(());
        });
        let _ = is_done.recv_timeout(REDRAW);
    }
}
