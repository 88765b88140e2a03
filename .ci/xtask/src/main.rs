//! The developer commands of this repository: `cargo xtask --help`.
//!
//! Exit codes: 0 passed, 1 a check failed, 2 wrong arguments, 3 a file or program could not be used.

mod bless;
mod circles;
mod dependencies;
mod error;
mod lines;
mod names;
mod papers;
mod resolve;
mod sources;
mod steps;
mod tokens;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use error::Error;
use sources::Package;

/// Checks and tools for work on this repository.
///
/// Exit codes: 0 passed, 1 a check failed, 2 wrong arguments, 3 a file or program could not be used.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Lists the circles of imports between the files of a crate; a module and its children may
    /// import each other.
    Circles {
        /// Crates to look at; all of the workspace when none is named.
        packages: Vec<String>,
    },
    /// Lists types that are declared twice under one name in one crate.
    Names {
        /// Crates to look at; all of the workspace when none is named.
        packages: Vec<String>,
    },
    /// Lists hand-written files of more than 600 lines.
    Lines,
    /// Runs circles, names and lines on the whole workspace, as .ci/run does.
    Sources,
    /// Lists dependencies with a licence, a source, a second version or a known advisory that .ci/dependencies.toml does
    /// not allow. Nothing is asked over the network.
    Dependencies,
    /// Writes .ci/advisories.json, the advisories on packages of the lock files, anew.
    Advisories {
        /// A clone of `RustSec`'s advisory-db.
        database: PathBuf,
    },
    /// Writes what goes with a release: the bill of materials (`CycloneDX`) and the notices of others.
    Papers {
        /// The folder, which is made if need be.
        folder: PathBuf,
    },
    /// Writes every generated and golden file anew; look at the difference before you commit it.
    Bless {
        /// Only paths that contain this text.
        part: Option<String>,
    },
    /// Checks what fails most often, in less than two minutes after a build.
    Quick,
    /// Runs .ci/run, which checks everything.
    Full,
}

/// The folder of the workspace.
fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let root = here.ancestors().nth(2).expect("the crate is in .ci/xtask");
    root.to_owned()
}

fn main() -> ExitCode {
    match run(&Arguments::parse().command) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(3)
        }
    }
}

/// Whether the command found everything in order.
fn run(command: &Command) -> Result<bool, Error> {
    let root = root();
    match command {
        Command::Circles { packages } => {
            let packages = Package::of_workspace(&root, packages)?;
            Ok(passed("circles", &circles::circles(&root, &packages)))
        }
        Command::Names { packages } => {
            let packages = Package::of_workspace(&root, packages)?;
            Ok(passed("names", &names::duplicates(&root, &packages)))
        }
        Command::Lines => Ok(passed("lines", &lines::too_long(&root)?)),
        Command::Sources => sources_are_in_order(&root),
        Command::Dependencies => {
            let found = dependencies::findings(&root)?;
            Ok(passed("dependencies", &found))
        }
        Command::Advisories { database } => {
            let count = dependencies::advisories::look_up(&root, database)?;
            println!("{count} advisories; cargo xtask dependencies judges by them");
            Ok(true)
        }
        Command::Papers { folder } => papers::write(&root, folder).map(|()| true),
        Command::Bless { part } => bless::bless(&root, part.as_deref()),
        Command::Quick => steps::quick(&root),
        Command::Full => steps::full(&root),
    }
}

/// Circles, names and lines of the whole workspace.
fn sources_are_in_order(root: &Path) -> Result<bool, Error> {
    let packages = Package::of_workspace(root, &[])?;
    let checks = [
        passed("circles", &circles::circles(root, &packages)),
        passed("names", &names::duplicates(root, &packages)),
        passed("lines", &lines::too_long(root)?),
    ];
    Ok(checks.iter().all(|is_ok| *is_ok))
}

/// Prints what a check found; whether that is nothing.
fn passed(check: &str, found: &[String]) -> bool {
    for finding in found {
        println!("{finding}");
    }
    match found.len() {
        0 => println!("{check}: none"),
        count => println!("{check}: {count}"),
    }
    found.is_empty()
}
