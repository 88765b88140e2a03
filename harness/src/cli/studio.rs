//! `crossguard studio`.

use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::path::PathBuf;

use crossguard_harness::studio::{self, Studied};
use crossguard_judge::playback::{Playback, written_us};
use crossguard_judge::validate::{self, Invalid, Validated};
use crossguard_robot::site_file::SiteFile;
use crossguard_robot::trace::Merged;

use super::interrupts::interrupts_that;
use super::{Failure, complain, open_logs, print};

#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub(super) struct Arguments {
    /// The logs: of one robot or of several, from one machine or from several.
    #[arg(required = true, value_name = "LOG")]
    logs: Vec<PathBuf>,
    /// The site, for kerbs and lanes on the map: a file, or `street` for the street of the demonstrations.
    #[arg(long, value_name = "FILE|street")]
    site: Option<PathBuf>,
    /// The port of the page; 0 for any that is free.
    #[arg(long, value_name = "N", default_value_t = 3100)]
    port: u16,
    /// The address of the page. Whoever reaches it can read the logs: leave it as it is unless you trust the network.
    #[arg(long, default_value_t = Ipv4Addr::LOCALHOST.into(), value_parser = address)]
    address: IpAddr,
    /// Do not open a browser.
    #[arg(long)]
    no_browser: bool,
}

const AFTER_HELP: &str = "\
Examples:
  crossguard demo --log crossing.jsonl && crossguard studio crossing.jsonl --site street
  crossguard studio ari.jsonl go2.jsonl --no-browser --port 0

The page needs no network. It is served until Ctrl-C ends it. Logs that are not valid are shown, too: the verdict stands \
at its place in time. A log that cannot be read to its end is shown as far as it goes.
Exit codes: 0 it was ended, 2 bad usage, a log that is missing or holds no record, or a port that is in use.";

fn address(text: &str) -> Result<IpAddr, String> {
    let wanted = "an address of this machine like 127.0.0.1 is wanted";
    text.parse().map_err(|_| wanted.to_owned())
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let run = study(arguments)?;
    let wanted = SocketAddr::new(arguments.address, arguments.port);
    let served = studio::serve(wanted, run).map_err(|error| {
        Failure::Input(format!(
            "{wanted}: {error}; --port N takes another port, --port 0 any that is free"
        ))
    })?;
    // Nothing is lost with it.
    let _ = interrupts_that(|| std::process::exit(0));
    print(format_args!(
        "Open http://{served}/ in a browser; Ctrl-C ends it."
    ))?;
    if !arguments.no_browser
        && let Err(error) = open::that_detached(format!("http://{served}/"))
    {
        complain(format_args!("no browser was opened: {error}"));
    }
    loop {
        std::thread::park();
    }
}

/// Reads the logs and judges them, both at once.
fn study(arguments: &Arguments) -> Result<Studied, Failure> {
    let street = match &arguments.site {
        None => None,
        Some(path) if path.as_os_str() == "street" => Some(SiteFile::street()),
        Some(path) => Some(SiteFile::read(path).map_err(Failure::input)?),
    };
    let logs = Merged::new(open_logs(&arguments.logs)?).map_err(Failure::input)?;
    let judge = || open_logs(&arguments.logs).map(validate::all);
    let (playback, validated) = std::thread::scope(|scope| {
        let judged = scope.spawn(judge);
        let playback = Playback::of(logs, street);
        (playback, judged.join())
    });
    let validated =
        validated.unwrap_or_else(|_| Err(Failure::input("the logs cannot be judged")))?;
    let names = arguments.logs.iter();
    let names: Vec<_> = names.map(|path| path.display().to_string()).collect();
    let invalid_us = when(arguments, &names, &validated);
    Ok(Studied {
        playback,
        logs: names,
        validated,
        invalid_us,
    })
}

/// When the record that does not fit was written.
fn when(
    arguments: &Arguments,
    names: &[String],
    validated: &Result<Validated, Invalid>,
) -> Option<u64> {
    let invalid = validated.as_ref().err()?;
    let place = names.iter().position(|name| *name == invalid.log)?;
    let log = crossguard_robot::trace::open(&arguments.logs[place]).ok()?;
    written_us(log, invalid.line)
}
