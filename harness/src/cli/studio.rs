//! `crossguard studio`.

use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crossguard_model_check::replay::Replay;
use crossguard_model_check::scenario::Scenario;
use crossguard_robot::files;
use crossguard_robot::port::PortAddress;
use crossguard_robot::site_file::SiteFile;

use super::interrupts::interrupts_that;
use super::{Failure, complain, open_logs, print, report};
use crate::studio::{self, Edited, Followed, GivenRun, Studied, Studio};

/// The longest run that is read, in octets.
const RUN_MAX: u64 = 1 << 26;

#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub(super) struct Arguments {
    /// The logs of a run that is looked at: of one robot or of several, from one machine or from several.
    #[arg(value_name = "LOG")]
    logs: Vec<PathBuf>,
    /// The site, for kerbs and lanes on the map: a file, which the page Site may change, or `street` for the street of the
    /// demonstrations.
    #[arg(long, value_name = "FILE|street")]
    site: Option<PathBuf>,
    /// The plan that the site has to fit before the page Site saves it: a file, or the name of one that comes with the kit.
    #[arg(long, value_name = "FILE|NAME", requires = "site")]
    plan: Option<PathBuf>,
    /// Follow the logs while robots write them, on the page Live; a log may come later.
    #[arg(long, requires = "logs")]
    follow: bool,
    /// Command a robot that is followed by its operator port, as its robot file and `run` name it; the page asks first.
    #[arg(long, value_name = "unix:FILE", requires = "follow", value_parser = operator_port)]
    operator: Vec<PortAddress>,
    /// A run through a scenario, as `check --charts` and pages of the studio write it, for the page Explore.
    #[arg(long, value_name = "FILE")]
    replay: Vec<PathBuf>,
    /// The port of the page; 0 for any that is free.
    #[arg(long, value_name = "N", default_value_t = 3100)]
    port: u16,
    /// The address of the page. Anybody who reaches it can read the logs: leave it as it is unless you trust the network.
    #[arg(long, default_value_t = Ipv4Addr::LOCALHOST.into(), value_parser = address)]
    address: IpAddr,
    /// Do not open a browser.
    #[arg(long)]
    no_browser: bool,
    /// Write Play and Explore into a folder for any file server, and serve nothing: `.ci/dist` puts the model beside them.
    #[arg(long, value_name = "FOLDER", hide = true)]
    publish: Option<PathBuf>,
}

const AFTER_HELP: &str = "\
Examples:
  crossguard demo --log crossing.jsonl && crossguard studio crossing.jsonl --site street
  crossguard studio ari.jsonl go2.jsonl --no-browser --port 0
  crossguard studio --follow crossing.jsonl --site street    while `crossguard demo --log crossing.jsonl` runs
  crossguard studio --follow go2.jsonl --operator unix:go2-operator.sock    commands Go2 from the page
  crossguard check my.toml --charts found; crossguard studio --replay found/my-I2.json
  crossguard studio --site corner/site.toml --plan corner/plan.toml    changes the street of `crossguard new corner`

Without files, the pages Play and Explore are there: the protocol to play with, and scenarios step by step. The page After \
opens logs that are dropped on it, too.

The page needs no network. It is served until Ctrl-C ends it. Logs that are not valid are shown, too: the verdict stands \
at its place in time. A log that cannot be read to its end is shown as far as it goes.
Exit codes: 0 it was ended, 2 bad usage, a log that is missing or holds no record, or a port that is in use.";

fn address(text: &str) -> Result<IpAddr, String> {
    let wanted = "an address of this machine like 127.0.0.1 is wanted";
    text.parse().map_err(|_| wanted.to_owned())
}

fn operator_port(text: &str) -> Result<PortAddress, String> {
    PortAddress::parse(text, Path::new("")).map_err(|error| error.to_string())
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    if let Some(folder) = &arguments.publish {
        let written = studio::publish(folder, Studio::default());
        return written.map_err(|error| Failure::Input(format!("{}: {error}", folder.display())));
    }
    let has_logs = !arguments.logs.is_empty();
    let is_run = has_logs && !arguments.follow;
    let street = super::site::named(arguments.site.as_deref())?;
    let study = || {
        let (logs, street) = (&arguments.logs, street.clone());
        report::study(|| open_logs(logs), report::names(logs), street)
    };
    let run = is_run.then(study).transpose()?;
    let live = || followed(arguments, street.clone());
    let live = arguments.follow.then(live).transpose()?;
    // Another machine may look, and changes nothing.
    let is_own = arguments.address.is_loopback();
    let study =
        is_own.then(|| Box::new(move |logs: &[(String, &[u8])]| opened(logs, street.clone())) as _);
    if !is_own && !arguments.operator.is_empty() {
        let cause =
            "--operator: others than this machine would command the robot; leave --address out";
        return Err(Failure::input(cause.to_owned()));
    }
    let file = arguments
        .site
        .as_ref()
        .filter(|it| is_own && it.as_os_str() != "street");
    let site = file.map(|file| {
        let plan = arguments.plan.clone();
        let check = Box::new(move |site: &SiteFile| super::site::said(site, plan.as_deref()));
        Edited {
            file: file.clone(),
            check,
        }
    });
    let is_edited = site.is_some();
    let wanted = SocketAddr::new(arguments.address, arguments.port);
    let given = arguments.replay.iter().map(|path| given(path));
    let given = given.collect::<Result<_, _>>()?;
    let shown = Studio {
        run,
        study,
        live,
        given,
        site,
    };
    let served = studio::serve(wanted, shown).map_err(|error| {
        Failure::Input(format!(
            "{wanted}: {error}; --port N takes another port, --port 0 any that is free"
        ))
    })?;
    // The page of what was given first in this list is opened.
    let given_to = [
        (arguments.follow, "live/"),
        (is_run, "after/"),
        (!arguments.replay.is_empty(), "explore/"),
        (is_edited, "site/"),
    ];
    let first = given_to.into_iter().find(|(is_given, _)| *is_given);
    let first = first.map_or("", |(_, page)| page);
    let page = format!("http://{served}/{first}");
    // Nothing is lost with it.
    let _ = interrupts_that(|| std::process::exit(0));
    print(format_args!("Open {page} in a browser; Ctrl-C ends it."))?;
    if !arguments.no_browser
        && let Err(error) = Command::new("xdg-open")
            .arg(page)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
    {
        complain(format_args!("no browser was opened: {error}"));
    }
    loop {
        std::thread::park();
    }
}

/// Reads logs that somebody opens on the page.
fn opened(logs: &[(String, &[u8])], street: Option<SiteFile>) -> Result<Studied, String> {
    report::study_octets(logs, street).map_err(|failure| match failure {
        Failure::Input(cause) => cause,
        _ => "the logs cannot be read".to_owned(),
    })
}

/// Reads a run, with the text of its scenario where that is another file: pages read no files.
fn given(path: &Path) -> Result<GivenRun, Failure> {
    let text = files::text(path, RUN_MAX).map_err(Failure::at(path))?;
    let mut run: Replay = serde_json::from_str(&text).map_err(Failure::at(path))?;
    if run.text.is_none() && Scenario::load(&run.scenario).is_err() {
        let text = files::text(Path::new(&run.scenario), files::TEXT_MAX);
        let text = text.map_err(|cause| format!("its scenario: {}: {cause}", run.scenario));
        run.text = Some(text.map_err(Failure::at(path))?);
    }
    let file = path.display().to_string();
    Ok(GivenRun { file, run })
}

/// The logs that are followed. They need not be there yet; their folders do.
fn followed(arguments: &Arguments, street: Option<SiteFile>) -> Result<Followed, Failure> {
    for path in &arguments.logs {
        let folder = path.parent().filter(|folder| *folder != Path::new(""));
        if folder.is_some_and(|folder| !folder.is_dir()) {
            return Err(Failure::input(format!(
                "{}: there is no such folder",
                path.display()
            )));
        }
    }
    Ok(Followed {
        logs: arguments.logs.clone(),
        street,
        operators: arguments.operator.clone(),
    })
}
