//! `crossguard pki`.

mod shown;

use std::path::{Path, PathBuf};

use clap::ValueEnum;
use crossguard_codec::security::{Certificate, Duration, Permission, PrivateKey, Time64};
use crossguard_codec::{Identifiers, Part};
use crossguard_protocol::StationId;
use crossguard_robot::pki::{self, Holder, PkiError, Term};

use self::shown::Shown;
use super::ranges::{self, whole};
use super::{Failure, destinations, print_json};

#[derive(clap::Subcommand)]
#[command(after_help = AFTER_HELP)]
pub(super) enum Command {
    /// Make a whole PKI: a root, an authority, and pseudonyms for robots.
    Init {
        /// The folder, which is made if need be.
        folder: PathBuf,
        /// A robot, and the station id that its pseudonyms name, if they are to name one; give the option once for
        /// each.
        #[arg(long = "robot", value_name = "NAME[=STATION]", default_values = ["ARI", "Go2"], value_parser = holder)]
        robots: Vec<Named>,
        #[command(flatten)]
        pseudonyms: Pseudonyms,
        #[command(flatten)]
        output: Form,
    },
    /// Issue pseudonyms (authorization tickets) for a robot.
    Tickets {
        /// The folder with the authority.
        folder: PathBuf,
        /// The robot; what it needs is put into robots/NAME.
        #[arg(long, value_name = "NAME[=STATION]", value_parser = holder)]
        robot: Named,
        #[command(flatten)]
        pseudonyms: Pseudonyms,
        #[command(flatten)]
        output: Form,
    },
    /// Put certificates on the revocation list of a PKI, revoked.txt in its folder.
    ///
    /// A robot whose file has revoked = "…/revoked.txt" takes nothing any more that is signed with one of them, a
    /// second after the list has changed. Copy the list to each robot, by a rename in the end.
    #[command(group = clap::ArgGroup::new("which").required(true).multiple(true))]
    Revoke {
        /// The folder of the PKI.
        folder: PathBuf,
        /// A robot, with all its tickets; may be given several times.
        #[arg(long = "robot", value_name = "NAME", group = "which")]
        robots: Vec<String>,
        /// A file with a certificate of a ticket, an authority or a root; may be given several times.
        #[arg(long = "certificate", value_name = "FILE", group = "which")]
        certificates: Vec<PathBuf>,
        #[command(flatten)]
        output: Form,
    },
    /// Show certificates.
    Show {
        /// Certificates, or folders with them.
        #[arg(required = true)]
        paths: Vec<PathBuf>,
        #[command(flatten)]
        output: Form,
    },
}

const AFTER_HELP: &str = "The PKI is for tests: keys lie in files, and there is no enrolment.\n\nA robot goes by the station id that its pseudonym names, or by the first four octets of the \
pseudonym's digest: such an id changes with the pseudonym, and tells nobody which robot it is. Name ids where plans \
give roles to stations.\n\nExamples:\n  crossguard pki init pki\n  crossguard demo --security enforce --pki pki\n  \
crossguard pki tickets pki --robot guest --part help --hours 1\n  crossguard pki revoke pki --robot guest\n  \
crossguard pki show pki --json";

#[derive(clap::Args)]
pub(super) struct Form {
    /// Print the certificates as JSON, and nothing else.
    #[arg(long)]
    json: bool,
}

/// Number, validity and parts of pseudonyms.
#[derive(clap::Args)]
pub(super) struct Pseudonyms {
    /// How many.
    #[arg(long, default_value_t = 8, value_parser = whole::<u16>(1..=1_000))]
    count: u16,
    /// For how many hours they are valid. Each begins at another moment, up to a tenth of that time early. A ticket that
    /// got lost is of use to others for as long.
    #[arg(long, default_value_t = 24, value_parser = whole::<u16>(1..=65_535))]
    hours: u16,
    /// In how many hours they begin to be valid; negative for the past.
    #[arg(
        long,
        default_value_t = 0,
        value_parser = whole::<i32>(-87_600..=87_600),
        value_name = "HOURS"
    )]
    start_in: i32,
    /// The parts that the robot may take in sessions.
    #[arg(long = "part", value_enum, default_values = ["lead", "help"])]
    parts: Vec<PartName>,
}

#[derive(Clone, Copy, ValueEnum)]
enum PartName {
    /// Ask for help, lead and command.
    Lead,
    /// Offer help, follow and answer.
    Help,
}

/// A robot that gets pseudonyms.
#[derive(Clone)]
pub(super) struct Named {
    name: String,
    /// The station id that they name, if they name one.
    station: Option<StationId>,
}

fn holder(text: &str) -> Result<Named, String> {
    let Some((name, station)) = text.split_once('=') else {
        let name = text.to_owned();
        return Ok(Named {
            name,
            station: None,
        });
    };
    Ok(Named {
        name: name.to_owned(),
        station: Some(ranges::station(station)?),
    })
}

pub(super) fn run(command: &Command) -> Result<(), Failure> {
    let (files, is_json) = match command {
        Command::Init {
            folder,
            robots,
            pseudonyms,
            output,
        } => (init(folder, robots, pseudonyms)?, output.json),
        Command::Tickets {
            folder,
            robot,
            pseudonyms,
            output,
        } => (tickets(folder, robot, pseudonyms)?, output.json),
        Command::Revoke {
            folder,
            robots,
            certificates,
            output,
        } => (revoke(folder, robots, certificates)?, output.json),
        Command::Show { paths, output } => {
            let mut files = Vec::new();
            for path in paths {
                find(path, &mut files).map_err(Failure::input)?;
            }
            (files, output.json)
        }
    };
    let now = pki::now();
    let shown: Vec<_> = files
        .iter()
        .map(|(path, certificate)| Shown::of(path, certificate, now))
        .collect();
    if is_json {
        return print_json(&shown);
    }
    shown.iter().try_for_each(Shown::print)
}

/// A certificate and its file.
type File = (PathBuf, Certificate);

fn init(folder: &Path, robots: &[Named], pseudonyms: &Pseudonyms) -> Result<Vec<File>, Failure> {
    for robot in robots {
        check_name(&robot.name)?;
    }
    destinations::folder(folder)?;
    let taken = [
        "root.cert",
        "root.key",
        "authority.cert",
        "authority.key",
        "authority-encryption.key",
        "robots",
    ];
    if let Some(taken) = taken
        .map(|it| folder.join(it))
        .iter()
        .find(|it| it.exists())
    {
        return Err(Failure::input(PkiError::Exists(taken.clone())));
    }
    // All is made in a folder of its own, which takes its place only when nothing can go wrong any more: what
    // is half made would be in the way of the next try.
    let was_there = folder.exists();
    let unfinished = folder.join(UNFINISHED);
    let _ = std::fs::remove_dir_all(&unfinished);
    let made = init_in(&unfinished, robots, pseudonyms, folder)
        .and_then(|files| take_place(&unfinished, folder).map(|()| files));
    let _ = std::fs::remove_dir_all(&unfinished);
    if made.is_err() && !was_there {
        // It stays if somebody has put something into it.
        let _ = std::fs::remove_dir(folder);
    }
    made
}

/// Where a PKI is made, inside of its folder.
const UNFINISHED: &str = ".unfinished";

/// Makes a PKI in a folder; the names of its files are those in the folder that they will be in.
fn init_in(
    folder: &Path,
    robots: &[Named],
    pseudonyms: &Pseudonyms,
    in_the_end: &Path,
) -> Result<Vec<File>, Failure> {
    // Above pseudonyms that begin in the past are certificates that begin as early.
    let early = Pseudonyms::from(pseudonyms.start_in.min(0));
    let early_us = pki::early_us(Duration::hours(pseudonyms.hours));
    let early = Time64(early.0.saturating_sub(early_us));
    let term = |years| Term {
        from: early,
        duration: Duration::years(years),
    };
    let its_aids = pki::its_aids(&Identifiers::default());
    let root = pki::new_root(PrivateKey::generate(), "test root", term(10), &its_aids);
    let root = root.map_err(Failure::input)?;
    let below = within(term(3), &root.certificate);
    let encryption = PrivateKey::generate();
    let keys = (PrivateKey::generate(), encryption.public_key());
    let authority = pki::new_authority(keys, &root, "test authority", below, &its_aids);
    let authority = authority.map_err(Failure::input)?;
    pki::write_key(&encryption, folder, "authority-encryption").map_err(Failure::input)?;
    let mut files = vec![
        write(&root, folder, "root")?,
        write(&authority, folder, "authority")?,
    ];
    for robot in robots {
        files.extend(tickets(folder, robot, pseudonyms)?);
    }
    for (path, _) in &mut files {
        if let Ok(inside) = path.strip_prefix(folder) {
            *path = in_the_end.join(inside);
        }
    }
    Ok(files)
}

/// Moves everything out of a folder into the one that it is in.
fn take_place(unfinished: &Path, folder: &Path) -> Result<(), Failure> {
    let moved = std::fs::read_dir(unfinished).and_then(|mut entries| {
        entries.try_for_each(|entry| {
            let entry = entry?;
            std::fs::rename(entry.path(), folder.join(entry.file_name()))
        })
    });
    let moved = moved.and_then(|()| pki::sync_folder(folder));
    moved.map_err(Failure::at(folder))
}

/// The same from not before an issuer is valid on.
fn within(term: Term, issuer: &Certificate) -> Term {
    let earliest = issuer.content().validity.from().0 + pki::EARLY_S * 1_000_000;
    Term {
        from: Time64(term.from.0.max(earliest)),
        ..term
    }
}

fn write(holder: &Holder, folder: &Path, name: &str) -> Result<File, Failure> {
    holder.write(folder, name).map_err(Failure::input)?;
    let path = folder.join(format!("{name}.cert"));
    Ok((path, holder.certificate.clone()))
}

/// Whether a robot's folder can have its name.
fn check_name(robot: &str) -> Result<(), Failure> {
    let is_name = !robot.is_empty()
        && robot
            .chars()
            .all(|c| c.is_alphanumeric() || "-_".contains(c));
    if !is_name {
        return Err(Failure::Input(format!(
            "'{robot}' cannot be the name of a robot's folder: letters, digits, - and _ can"
        )));
    }
    Ok(())
}

fn tickets(folder: &Path, robot: &Named, wanted: &Pseudonyms) -> Result<Vec<File>, Failure> {
    check_name(&robot.name)?;
    let authority = Holder::read(folder, "authority").map_err(Failure::input)?;
    let above = pki::read_certificate(&folder.join("root.cert")).map_err(Failure::input)?;
    let term = Term::hours(Pseudonyms::from(wanted.start_in), wanted.hours);
    let robot_folder = pki::robot_folder(folder, &robot.name);
    let mut files = Vec::new();
    // All are made before any is written.
    let ticket = |_| {
        let permissions = wanted.permissions(robot.station);
        pki::drawn_ticket(&PrivateKey::generate(), &authority, term, &permissions)
    };
    let made: Result<Vec<_>, _> = (0..wanted.count).map(ticket).collect();
    let made = made.map_err(|error| {
        Failure::Input(format!(
            "{error}. The authority must be valid for all of the time that pseudonyms are: choose --start-in and \
             --hours within it ('crossguard pki show FOLDER' tells it)"
        ))
    })?;
    for ticket in made {
        let id = ticket.certificate.id();
        pki::write_ticket(&ticket, &robot_folder).map_err(Failure::input)?;
        let path = robot_folder.join("tickets").join(format!("{id}.cert"));
        files.push((path, ticket.certificate));
    }
    for (certificate, name) in [(&above, "root"), (&authority.certificate, "authority")] {
        pki::write_certificate(certificate, &robot_folder, name).map_err(Failure::input)?;
    }
    Ok(files)
}

/// Puts tickets of robots, and other certificates, on the list of a PKI.
fn revoke(
    folder: &Path,
    robots: &[String],
    certificates: &[PathBuf],
) -> Result<Vec<File>, Failure> {
    let mut files = Vec::new();
    for robot in robots {
        check_name(robot)?;
        let tickets = pki::robot_folder(folder, robot).join("tickets");
        find(&tickets, &mut files).map_err(Failure::input)?;
    }
    for certificate in certificates {
        find(certificate, &mut files).map_err(Failure::input)?;
    }
    let ids: Vec<_> = files.iter().map(|(_, it)| it.id()).collect();
    pki::add_revoked(&folder.join(pki::REVOKED_LIST), &ids).map_err(Failure::input)?;
    Ok(files)
}

impl Pseudonyms {
    /// When it is in so many hours.
    fn from(hours: i32) -> Time64 {
        let offset_us = i64::from(hours) * 3_600_000_000;
        Time64(pki::now().0.saturating_add_signed(offset_us))
    }

    fn permissions(&self, named: Option<StationId>) -> Vec<Permission> {
        let part = |part: &PartName| match part {
            PartName::Lead => Part::Lead,
            PartName::Help => Part::Help,
        };
        let parts: Vec<_> = self.parts.iter().map(part).collect();
        pki::robot_permissions(&Identifiers::default(), &parts, named)
    }
}

/// The certificates in a file, or in a folder and all that is in it.
fn find(path: &Path, files: &mut Vec<File>) -> Result<(), PkiError> {
    if !path.is_dir() {
        files.push((path.to_owned(), pki::read_certificate(path)?));
        return Ok(());
    }
    for certificate in pki::certificates_in(path)? {
        find(&certificate, files)?;
    }
    for folder in pki::folders_in(path)? {
        find(&folder, files)?;
    }
    Ok(())
}
