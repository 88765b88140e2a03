//! The judges: each is a command that exits with 0 as long as nothing of the specification is broken.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

use wait_timeout::ChildExt;

use crate::Failure;

/// How often a judge at work is looked at.
const LOOK: Duration = Duration::from_millis(500);

/// A judge that gets no processor time for so long is given up. Other work may keep the machine busy, so
/// this is generous; what ends a mutant that never ends is [`Judge::seconds_max`].
const PATIENCE: Duration = Duration::from_mins(20);

/// A mutant that multiplies the states must not take the memory of the machine, in KiB.
const MEMORY_MAX: u64 = 7 << 20;

/// A command, and how it is called in verdicts.
pub(crate) struct Judge {
    pub(crate) name: String,
    pub(crate) program: PathBuf,
    pub(crate) arguments: Vec<String>,
    /// Processor time that it may take, in seconds.
    pub(crate) seconds_max: u64,
}

/// What a judge says of a mutant.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Opinion {
    /// Nothing of the specification is broken.
    Passes,
    /// A property is violated, a premise is unreachable, or something panics.
    Broken,
    /// It did not end within its processor time or memory.
    Endless,
}

/// All judges, in the order in which they are asked.
pub(crate) struct Judges {
    /// The first are asked about every mutant, each other about what all before it let pass.
    pub(crate) stages: Vec<Vec<Judge>>,
}

/// What came of a mutant.
pub(crate) enum Outcome<'a> {
    CaughtBy(&'a str),
    /// No judge found anything broken, but this one did not come to an end.
    TimedOut(&'a str),
    Survived,
}

/// Asks judges about a mutant until one of them finds something broken.
pub(crate) fn ask<'a>(judges: &'a [Judge], number: usize, folder: &Path) -> Outcome<'a> {
    let mut outcome = Outcome::Survived;
    for judge in judges {
        match judge.opinion(number, folder) {
            Opinion::Passes => {}
            Opinion::Broken => return Outcome::CaughtBy(&judge.name),
            Opinion::Endless => outcome = Outcome::TimedOut(&judge.name),
        }
    }
    outcome
}

impl Judges {
    /// Asks the judges about the unchanged protocol, which must pass, and prints their times.
    pub(crate) fn measure(&self, stages: usize, folder: &Path) -> Result<(), Failure> {
        for judge in self.stages.iter().take(stages).flatten() {
            let start = Instant::now();
            if judge.opinion(0, folder) != Opinion::Passes {
                return Err(Failure::Unfit(judge.name.clone()));
            }
            let (seconds, max) = (start.elapsed().as_secs_f64(), judge.seconds_max);
            println!("{:20} {seconds:6.1} s, at most {max} s", judge.name);
        }
        Ok(())
    }
}

impl Judge {
    fn opinion(&self, number: usize, folder: &Path) -> Opinion {
        let errors = folder.join(format!("{number}.err"));
        let Ok(mut child) = self.start(number, folder, &errors) else {
            return Opinion::Endless;
        };
        let opinion = wait(&mut child, &errors);
        let _ = std::fs::remove_file(&errors);
        opinion
    }

    fn start(&self, number: usize, folder: &Path, errors: &Path) -> std::io::Result<Child> {
        // The shell sets the limits and becomes the judge.
        let limits = format!(
            "ulimit -t {}; ulimit -v {MEMORY_MAX}; ulimit -c 0; exec \"$0\" \"$@\"",
            self.seconds_max
        );
        Command::new("sh")
            .args(["-c", &limits])
            .arg(&self.program)
            .args(&self.arguments)
            .current_dir(folder)
            .env("MUTANT", number.to_string())
            .env("RUST_BACKTRACE", "0")
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(File::create(errors)?)
            .spawn()
    }
}

/// Waits for the end. A thread of a judge that panics may leave the others waiting for ever, so a
/// panic counts as soon as it is told.
fn wait(child: &mut Child, errors: &Path) -> Opinion {
    let start = Instant::now();
    let mut opinion = Opinion::Endless;
    while start.elapsed() < PATIENCE {
        match child.wait_timeout(LOOK) {
            Ok(Some(status)) => return judgement(status, errors),
            Ok(None) if has_panicked(errors) => {
                opinion = Opinion::Broken;
                break;
            }
            Ok(None) => {}
            Err(_) => break,
        }
    }
    let _ = child.kill();
    let _ = child.wait();
    opinion
}

/// `check` and `fuzz` exit with 0 where all is well, with 1 where the specification is broken, with 2 where
/// a scenario cannot be used at all, with 3 where they did not finish; 101 is a panic, or a failed test.
fn judgement(status: ExitStatus, errors: &Path) -> Opinion {
    match status.code() {
        Some(0) => Opinion::Passes,
        Some(3) => Opinion::Endless,
        Some(_) => Opinion::Broken,
        // A signal: out of processor time or memory, or a stack without end.
        None if has_panicked(errors) => Opinion::Broken,
        None => Opinion::Endless,
    }
}

fn has_panicked(errors: &Path) -> bool {
    std::fs::read_to_string(errors).is_ok_and(|text| text.contains("panicked at"))
}
