//! Mutants of the protocol, judged by the specification alone: by model checking, by the bodies of the
//! proofs and by the fuzzer, without unit and script tests. A mutant that survives is a hole in the
//! specification, or changes nothing that anybody can see.
//!
//! ```text
//!   protocol/src ──► points: every place that can be changed ──► schema: a copy of the workspace in
//!                                                                 which all changes are built in once
//!        report ◄── verdict ◄── judge: runs check, proofs and fuzz with MUTANT=n ◄── build ◄──┘
//! ```
//!
//! All mutants are compiled in one build; the environment variable `MUTANT` switches one of them on. So a
//! mutant costs seconds and not a build.

mod build;
mod explained;
mod harnesses;
mod judge;
mod points;
mod schema;
mod verdict;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Changes the protocol in one place at a time and asks what of the specification notices.
#[derive(Parser)]
#[command(name = "crossguard-mutants")]
struct Arguments {
    /// The root of the workspace.
    #[arg(long, default_value = ".")]
    root: PathBuf,
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Lists the mutants: number, place, change.
    List,
    /// Builds the copy with all mutants, and judges each. A run that was stopped goes on where it was.
    Run(Run),
    /// Prints the survivors of the last run with their explanations; fails where one has none.
    Survivors,
    /// Builds the copy with all mutants, and nothing else.
    Build,
    /// Tells which harnesses of the proofs notice a mutant with random values, for each whose text contains one of these.
    Harnesses {
        /// Parts of texts as `list` prints them.
        #[arg(required = true)]
        only: Vec<String>,
    },
}

#[derive(clap::Args)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is a flag of the command"
)]
struct Run {
    /// Judge only mutants whose text contains this.
    #[arg(long)]
    only: Option<String>,
    /// Forget earlier verdicts.
    #[arg(long)]
    again: bool,
    /// Judge the survivors of earlier runs again, and nothing else.
    #[arg(long)]
    survivors: bool,
    /// Ask the judges of this many stages only: those of each take longer than those before.
    #[arg(long, default_value_t = usize::MAX)]
    stages: usize,
    /// Use what was built last, which must be of the same sources.
    #[arg(long)]
    built: bool,
    /// Do not ask the judges about the unchanged protocol first.
    #[arg(long)]
    unmeasured: bool,
    /// How many mutants to judge at a time.
    #[arg(long, default_value_t = 2)]
    jobs: usize,
}

/// Why nothing was judged.
#[derive(Debug, thiserror::Error)]
enum Failure {
    #[error("{}: {cause}", path.display())]
    File {
        path: PathBuf,
        cause: std::io::Error,
    },
    #[error("{}: {cause}", path.display())]
    Syntax { path: PathBuf, cause: syn::Error },
    #[error("'{command}' failed: {text}")]
    Command { command: String, text: String },
    #[error("'{0}' fails with no mutant switched on: the protocol must pass its judges first")]
    Unfit(String),
    #[error("{}: {cause}", path.display())]
    Explanations {
        path: PathBuf,
        cause: Box<toml::de::Error>,
    },
    #[error("no mutant has '{0}' in its text: `crossguard-mutants list` prints all")]
    NoMutant(String),
    #[error("not every survivor is explained: see model-check/mutants/survivors.toml")]
    Unexplained,
}

impl Failure {
    fn file(path: impl Into<PathBuf>) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.into();
        |cause| Self::File { path, cause }
    }
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("crossguard-mutants: {failure}");
            ExitCode::from(2)
        }
    }
}

fn run(arguments: &Arguments) -> Result<(), Failure> {
    let root = &arguments.root;
    let root = root.canonicalize().map_err(Failure::file(root))?;
    let sources = points::Sources::read(&root)?;
    let folder = schema::folder(&root);
    match &arguments.command {
        Command::List => {
            for mutant in sources.mutants() {
                println!("{mutant}");
            }
            Ok(())
        }
        Command::Build => build::build(&schema::write(&root, &sources)?, &folder),
        Command::Run(options) => {
            if !options.built {
                build::build(&schema::write(&root, &sources)?, &folder)?;
            }
            let judges = build::judges(&folder);
            if !options.unmeasured {
                judges.measure(options.stages, &folder)?;
            }
            verdict::run(&judges, &sources, options, &folder)
        }
        Command::Harnesses { only } => {
            build::build_proofs(&schema::write(&root, &sources)?, &folder)?;
            harnesses::tell(&sources, only, &build::proofs(&folder))
        }
        Command::Survivors => {
            let explained = explained::Explained::read(&root)?;
            verdict::survivors(&sources, &explained, &folder)
        }
    }
}
