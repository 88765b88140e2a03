//! A call of Kani, and what it prints.

use std::io::{BufRead, BufReader, Read};
use std::process::{Command, Stdio};
use std::time::Duration;

use crate::Entry;

/// Harnesses for one call.
pub(crate) struct Batch {
    /// The command, `cargo-kani` or one that takes the same arguments.
    pub(crate) program: String,
    pub(crate) entries: Vec<Entry>,
    /// How long each may take.
    pub(crate) limit: Duration,
    /// Whether each access to memory is checked.
    pub(crate) memory: bool,
    /// Which of the jobs it is: each builds in a folder of its own.
    pub(crate) job: u8,
}

/// What came of a harness.
pub(crate) struct Outcome {
    pub(crate) name: String,
    pub(crate) seconds: f64,
    /// Why it counts as failed.
    pub(crate) failure: Option<String>,
}

/// The part of the output about one harness.
#[derive(Default)]
struct Section {
    name: String,
    text: String,
    is_verified: bool,
    /// Whether Kani has ended it at the limit.
    is_late: bool,
    /// Whether Kani has said how long it took.
    is_judged: bool,
    /// How many cover marks are satisfied, of how many.
    marks: (usize, usize),
}

impl Batch {
    /// Runs them; each outcome is given to `takes` as soon as it is known, until it takes no more.
    ///
    /// # Errors
    /// Kani cannot be run, or ends before it has judged all, and why.
    pub(crate) fn run(&self, takes: &mut dyn FnMut(Outcome) -> bool) -> Result<(), String> {
        let program = &self.program;
        let failed = |cause: &dyn std::fmt::Display| format!("{program}: {cause}");
        let mut command = Command::new(program);
        command.args(["-p", "crossguard-proofs", "--exact"]);
        // Marks say what must be reachable. To ask that of each assertion as well takes a third of the time.
        command.arg("--no-assertion-reach-checks");
        if !self.memory {
            // No code is unsafe. An index that is out of bounds panics, which Kani sees as it does every panic.
            command.arg("--no-memory-safety-checks");
        }
        command.args(["-Z", "unstable-options", "--harness-timeout"]);
        command.arg(format!("{}s", self.limit.as_secs()));
        command.args(["--target-dir", &format!("target/kani-{}", self.job)]);
        for entry in &self.entries {
            command.args(["--harness", &entry.name]);
        }
        command.stdin(Stdio::null());
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut kani = command.spawn().map_err(|cause| failed(&cause))?;
        let complaints = kani.stderr.take().map(|mut complaints| {
            std::thread::spawn(move || {
                let mut text = Vec::new();
                // What it says besides is for people; where it cannot be read, there is less of it.
                let _ = complaints.read_to_end(&mut text);
                String::from_utf8_lossy(&text).into_owned()
            })
        });
        let (mut judged, limit) = (0, self.limit.as_secs_f64());
        let mut section = Section::default();
        for line in kani
            .stdout
            .take()
            .into_iter()
            .flat_map(|out| BufReader::new(out).lines())
        {
            let line = line.map_err(|cause| failed(&cause))?;
            // Of one that is late, Kani says no time; then the next one begins, or there is none.
            let late = section
                .is_followed_by(&line)
                .then(|| section.outcome(limit, &self.entries));
            let done = section.take(&line);
            let done = done.map(|seconds| section.outcome(seconds, &self.entries));
            for outcome in late.into_iter().chain(done) {
                judged += 1;
                if !takes(outcome) {
                    let _ = kani.kill();
                    return kani.wait().map(|_| ()).map_err(|cause| failed(&cause));
                }
            }
        }
        let status = kani.wait().map_err(|cause| failed(&cause))?;
        let complaints = complaints.and_then(|it| it.join().ok()).unwrap_or_default();
        if section.is_open() && section.is_late {
            judged += 1;
            takes(section.outcome(limit, &self.entries));
        }
        if judged < self.entries.len() {
            return Err(failed(&format!("{status}\n{complaints}{}", section.text)));
        }
        Ok(())
    }
}

impl Section {
    /// Whether it has begun and has not ended.
    fn is_open(&self) -> bool {
        !self.name.is_empty() && !self.is_judged
    }

    /// Whether this line ends it without a verdict.
    fn is_followed_by(&self, line: &str) -> bool {
        self.is_open() && line.contains("Checking harness ")
    }

    /// Takes a line; how many seconds the harness took, when it is judged.
    fn take(&mut self, line: &str) -> Option<f64> {
        if let Some((_, name)) = line.split_once("Checking harness ") {
            *self = Self {
                name: name.trim_end_matches('.').to_owned(),
                ..Self::default()
            };
        }
        self.text.push_str(line);
        self.text.push('\n');
        self.is_verified |= line.contains("VERIFICATION:- SUCCESSFUL");
        self.is_late |= line.contains("CBMC timed out");
        self.marks = marks(line).unwrap_or(self.marks);
        let (_, time) = line.split_once("Verification Time: ")?;
        self.is_judged = true;
        time.trim_end_matches('s').parse().ok()
    }

    /// What Kani says at the end of a harness that fails, where it says that: in front of it is each of thousands of checks.
    fn summary(&self) -> &str {
        match self.text.find("SUMMARY:") {
            Some(begin) => &self.text[begin..],
            None => &self.text,
        }
    }

    fn outcome(&self, seconds: f64, entries: &[Entry]) -> Outcome {
        let wanted = entries.iter().find(|entry| entry.name == self.name);
        let wanted = wanted.map_or(0, |entry| entry.covers);
        let (satisfied, of) = self.marks;
        let failure = match (self.is_verified, self.is_late) {
            (true, _) if satisfied == of && of == wanted => None,
            (true, _) => Some(format!(
                "{satisfied} of {of} cover marks satisfied, {wanted} expected"
            )),
            (false, true) => Some("not verified within the limit".to_owned()),
            (false, false) => Some(format!("NOT verified\n{}", self.summary())),
        };
        Outcome {
            name: self.name.clone(),
            seconds,
            failure,
        }
    }
}

/// Cover marks, from `2 of 3 cover properties satisfied`.
fn marks(line: &str) -> Option<(usize, usize)> {
    let (counts, _) = line.split_once(" cover properties satisfied")?;
    let (satisfied, of) = counts.split_once(" of ")?;
    let satisfied = satisfied.split_whitespace().next_back()?.parse().ok()?;
    Some((satisfied, of.trim().parse().ok()?))
}
