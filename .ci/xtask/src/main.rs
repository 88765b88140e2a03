//! The developer commands of this repository: `cargo xtask --help`.
//!
//! Exit codes: 0 passed, 1 a check failed, 2 wrong arguments, 3 a program could not be started.

mod bless;
mod steps;

use std::path::Path;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use steps::NotStarted;

/// Checks and tools for work on this repository.
///
/// Exit codes: 0 passed, 1 a check failed, 2 wrong arguments, 3 a program could not be started.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Writes every generated and golden file anew; look at the difference before you commit it.
    Bless {
        /// Only paths that contain this text.
        #[arg(value_parser = bless::part)]
        part: Option<String>,
    },
    /// Checks what fails most often, in less than two minutes after a build.
    Quick,
    /// Runs .ci/run, which checks everything.
    Full,
    /// Makes what a release consists of, into target/dist: archives, a Debian package, a wheel, bills of material, checksums.
    Dist {
        /// Install and use each of them in a Debian without Rust and without network. Wants root.
        #[arg(long = "try")]
        is_tried: bool,
    },
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
fn run(command: &Command) -> Result<bool, NotStarted> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let root = here.ancestors().nth(2).expect("the crate is in .ci/xtask");
    match command {
        Command::Bless { part } => bless::bless(root, part.as_deref().unwrap_or_default()),
        Command::Quick => steps::quick(root),
        Command::Full => steps::full(root),
        Command::Dist { is_tried } => steps::dist(root, *is_tried),
    }
}
