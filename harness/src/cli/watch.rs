//! How a running robot is shown while it runs: a status line, and metrics.

use std::io::{IsTerminal, Write};
use std::net::{Ipv4Addr, SocketAddr};
use std::time::Duration;

use clap::ValueEnum;
use crossguard_endpoint::cause::Cause;
use crossguard_model_check::names::Names;
use crossguard_robot::runtime::Running;
use crossguard_robot::trace::Record;

use super::Failure;
use super::screen::Screen;
use crate::metrics::{self, Shared};

/// How often the status line is drawn, on a terminal and where lines stay.
const REDRAW: Duration = Duration::from_millis(200);
const REPEAT: Duration = Duration::from_secs(1);

/// How a running robot is shown.
#[derive(clap::Args)]
pub(super) struct WatchArguments {
    /// Whether a status line is shown on standard error; by default where that is a terminal, and nobody types on it.
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
    screen: Screen,
    /// Where metrics are served.
    pub(super) metrics: Option<SocketAddr>,
}

impl WatchArguments {
    /// Begins to show a robot on this link, in this mode of security. Nothing but its log may be on a standard output
    /// that is for programs.
    pub(super) fn begin(
        &self,
        link: String,
        security: &'static str,
        names: Names,
    ) -> Result<Watch, Failure> {
        let tally = Shared::default();
        tally.with(|tally| (tally.link, tally.security) = (link, security));
        let serve = |address| {
            metrics::serve(address, tally.clone())
                .map_err(|error| Failure::Input(format!("--metrics {address}: {error}")))
        };
        let metrics = self.metrics.map(serve).transpose()?;
        let is_terminal = std::io::stderr().is_terminal();
        let is_shown = match self.status {
            // It would be drawn over the line that is typed.
            When::Auto => is_terminal && !std::io::stdin().is_terminal(),
            When::Always => true,
            When::Never => false,
        };
        let screen = Screen::new(is_shown && is_terminal);
        if is_shown {
            let (tally, screen) = (tally.clone(), screen.clone());
            // A thread of its own: who holds standard error up holds up nothing else.
            std::thread::spawn(move || draw(&tally, &names, &screen));
        }
        Ok(Watch {
            tally,
            screen,
            metrics,
        })
    }
}

/// Draws the status line until the robot has stopped.
fn draw(tally: &Shared, names: &Names, screen: &Screen) {
    loop {
        std::thread::sleep(if screen.is_live() { REDRAW } else { REPEAT });
        let (text, has_stopped) = tally.with(|tally| (tally.line(), tally.has_stopped));
        if has_stopped {
            return screen.clear();
        }
        let text = names.tell(text);
        if screen.is_live() {
            screen.show(&text);
        } else {
            // Standard error may be gone; the robot goes on.
            let _ = writeln!(std::io::stderr(), "{text}");
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

    /// Its link, its security and its channel.
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

    /// Where it is shown.
    pub(super) fn screen(&self) -> Screen {
        self.screen.clone()
    }
}

impl Drop for Watch {
    /// Takes the status line away, but does not wait for a reader that holds standard output or error up: a
    /// line above the status line may be on its way to one who does not read.
    fn drop(&mut self) {
        self.screen.within(REDRAW, Screen::clear);
    }
}
