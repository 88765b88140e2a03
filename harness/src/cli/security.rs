//! Security of commands that run robots.

use std::path::{Path, PathBuf};

#[cfg(feature = "full")]
use crossguard_codec::Identifiers;
use crossguard_codec::security::{Time64, Unsigned};
use crossguard_endpoint::station::{Credentials, Mode, Security};
use crossguard_robot::pki;
use crossguard_robot::transport::Link;

use super::ranges::whole;
use super::{Failure, choices, complain};

/// How many pseudonyms a robot of a demonstration has.
#[cfg(feature = "full")]
const PSEUDONYMS: usize = 4;

#[derive(clap::Args)]
pub(super) struct SecurityArguments {
    /// Whether packets are signed (TS 103 097) and those of others verified.
    #[arg(long, value_parser = choices::security(), default_value = "off")]
    security: Mode,
    /// The folder with certificates and keys, of the robot or of the PKI (see 'crossguard pki').
    #[arg(long, value_name = "FOLDER")]
    pki: Option<PathBuf>,
    /// After how many seconds a pseudonym changes, outside of sessions; 0 for never.
    #[arg(long, value_name = "SECONDS", default_value_t = 300, value_parser = whole::<u32>(0..=u32::MAX.into()))]
    pseudonym_period: u32,
}

impl SecurityArguments {
    pub(super) const fn mode(&self) -> Mode {
        self.security
    }

    /// Says on standard error that anybody can forge what a robot without security hears on this link.
    pub(super) fn warn_if_unsigned(&self, link: &Link) {
        if self.security == Mode::Off && link.leaves_machine() {
            complain(format_args!(
                "warning: packets on {link} are neither signed nor verified: anybody in reach can command \
                 this robot; --security enforce takes signed packets only"
            ));
        }
    }

    pub(super) fn signs(&self) -> bool {
        self.security != Mode::Off
    }

    pub(super) const fn is_throw_away(&self) -> bool {
        self.pki.is_none()
    }

    /// The security of a robot of this name, whose certificates are in a folder, and which does not trust what is on
    /// a revocation list.
    pub(super) fn of_robot(&self, name: &str, revoked: Option<&Path>) -> Result<Security, Failure> {
        match (self.security, &self.pki) {
            (Mode::Off, _) if revoked.is_some() => Err(Failure::Input(
                "'revoked' in the robot file is of no use without --security sign or --security enforce"
                    .to_owned(),
            )),
            (Mode::Off, Some(_)) => Err(Failure::Input(
                "--pki is of no use without --security sign or --security enforce".to_owned(),
            )),
            (Mode::Off, None) => Ok(Security::default()),
            (_, None) => Err(Failure::Input(
                "--security wants the certificates and keys of the robot: --pki FOLDER; 'crossguard \
                 pki init FOLDER' makes some"
                    .to_owned(),
            )),
            (_, Some(folder)) => {
                let credentials = pki::credentials_but(folder, name, revoked);
                self.with(credentials.map_err(Failure::input)?.shuffled())
            }
        }
    }

    /// The security of several robots; without a folder they get a PKI that nobody else knows.
    pub(super) fn of_robots(&self, names: &[&str]) -> Result<Vec<Security>, Failure> {
        if let (Mode::Sign | Mode::Enforce, Some(folder)) = (self.security, &self.pki) {
            check(folder, names)?;
        }
        if self.security == Mode::Off || self.pki.is_some() {
            return names.iter().map(|name| self.of_robot(name, None)).collect();
        }
        #[cfg(not(feature = "full"))]
        return Err(super::small::build_all());
        #[cfg(feature = "full")]
        self.of_throw_away(names.len())
    }

    /// The security of so many robots in a PKI that nobody else knows.
    #[cfg(feature = "full")]
    fn of_throw_away(&self, robots: usize) -> Result<Vec<Security>, Failure> {
        let (identifiers, now) = (Identifiers::default(), pki::now());
        let pki = pki::Pki::for_a_day(&identifiers, now).map_err(Failure::input)?;
        let of_one = |_| {
            let credentials = pki.credentials(&identifiers, (PSEUDONYMS, None), now);
            self.with(credentials.map_err(Failure::input)?)
        };
        (0..robots).map(of_one).collect()
    }

    fn with(&self, credentials: Credentials) -> Result<Security, Failure> {
        let period_ms = u64::from(self.pseudonym_period) * 1_000;
        let period_ms = (period_ms > 0).then_some(period_ms);
        let now: Time64 = pki::now();
        let security = Security::new(self.security, credentials, period_ms, now);
        security.map_err(|error| match error {
            Unsigned::NoValidTicket => Failure::Input(format!(
                "{error}: if the clock of this machine is right, 'crossguard pki tickets' makes new ones"
            )),
            error => Failure::input(error),
        })
    }
}

/// Whether a folder has something for each of these robots; if not, how it gets it.
fn check(folder: &Path, names: &[&str]) -> Result<(), Failure> {
    let shown = folder.display();
    if !folder.exists() {
        let robots = names.iter().map(|name| format!(" --robot {name}"));
        let robots = robots.collect::<String>();
        return Err(Failure::Input(format!(
            "{shown} is not there; make it with: crossguard pki init {shown}{robots}"
        )));
    }
    let is_missing = |name: &&&str| !pki::robot_folder(folder, name).is_dir();
    let missing: Vec<_> = names.iter().filter(is_missing).copied().collect();
    if missing.is_empty() || !folder.join("robots").is_dir() {
        return Ok(());
    }
    let commands = missing
        .iter()
        .map(|name| format!("\n  crossguard pki tickets {shown} --robot {name}"));
    let commands = commands.collect::<String>();
    Err(Failure::Input(format!(
        "the PKI in {shown} has nothing for {}, who take part; give them something with:{commands}",
        missing.join(", ")
    )))
}
