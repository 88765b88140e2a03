//! Verdicts: what came of each mutant, in a file that a run which was stopped goes on with.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::Write;
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use serde::{Deserialize, Serialize};

use crate::explained::Explained;
use crate::judge::{self, Judge, Judges, Outcome};
use crate::points::{Mutant, Sources};
use crate::{Failure, Run};

/// What came of a mutant.
#[derive(Clone, Serialize, Deserialize)]
struct Verdict {
    /// File, function and change; no line, so that a verdict outlives changes elsewhere.
    mutant: String,
    /// The judge that noticed it; `None` for a survivor.
    caught_by: Option<String>,
    /// The judge that did not come to an end, where none noticed anything else.
    #[serde(default)]
    timeout: Option<String>,
    /// How many stages of judges were asked, if it was not caught.
    stages: usize,
}

impl Verdict {
    fn of(mutant: &Mutant, outcome: &Outcome, stages: usize) -> Self {
        let (caught_by, timeout) = match outcome {
            Outcome::CaughtBy(judge) => (Some((*judge).to_owned()), None),
            Outcome::TimedOut(judge) => (None, Some((*judge).to_owned())),
            Outcome::Survived => (None, None),
        };
        Self {
            mutant: mutant.key(),
            caught_by,
            timeout,
            stages,
        }
    }

    fn words(&self) -> String {
        match (&self.caught_by, &self.timeout) {
            (Some(judge), _) => judge.clone(),
            (None, Some(judge)) => format!("timeout {judge}"),
            (None, None) => format!("SURVIVED {}", self.stages),
        }
    }
}

/// The verdicts of earlier runs; the last one counts.
fn known(path: &Path) -> BTreeMap<String, Verdict> {
    let text = std::fs::read_to_string(path).unwrap_or_default();
    let verdicts = text
        .lines()
        .filter_map(|line| serde_json::from_str::<Verdict>(line).ok());
    let mut known = BTreeMap::<String, Verdict>::new();
    for mut verdict in verdicts {
        let before = known.get(&verdict.mutant);
        if verdict.stages > 1 && verdict.timeout.is_none() {
            verdict.timeout = before.and_then(|before| before.timeout.clone());
        }
        known.insert(verdict.mutant.clone(), verdict);
    }
    known
}

/// Judges the mutants that have no verdict yet, stage by stage: what one lets pass is for the next.
pub(crate) fn run(
    judges: &Judges,
    sources: &Sources,
    options: &Run,
    folder: &Path,
) -> Result<(), Failure> {
    let path = folder.join("verdicts.jsonl");
    if options.again {
        let _ = std::fs::remove_file(&path);
    }
    let before = known(&path);
    let is_meant = |mutant: &&Mutant| {
        let text = mutant.to_string();
        let survived = before
            .get(&mutant.key())
            .is_some_and(|v| v.caught_by.is_none());
        options.only.as_ref().is_none_or(|only| text.contains(only))
            && (survived || !options.survivors)
    };
    let mut todo: Vec<&Mutant> = sources.mutants().iter().filter(is_meant).collect();
    for (stage, judges) in judges.stages.iter().enumerate().take(options.stages) {
        let is_new = |mutant: &&Mutant| {
            let verdict = before.get(&mutant.key());
            options.survivors || verdict.is_none_or(|v| v.caught_by.is_none() && v.stages <= stage)
        };
        let now: Vec<&Mutant> = todo.iter().copied().filter(is_new).collect();
        judge_all(judges, &now, stage + 1, options, folder)?;
        let after = known(&path);
        todo.retain(|mutant| {
            after
                .get(&mutant.key())
                .is_some_and(|v| v.caught_by.is_none())
        });
    }
    Ok(())
}

fn judge_all(
    judges: &[Judge],
    todo: &[&Mutant],
    stages: usize,
    options: &Run,
    folder: &Path,
) -> Result<(), Failure> {
    let path = folder.join("verdicts.jsonl");
    let mut open = File::options();
    let file = open.create(true).append(true).open(&path);
    let file = Mutex::new(file.map_err(Failure::file(&path))?);
    let (next, done, start) = (AtomicUsize::new(0), AtomicUsize::new(0), Instant::now());
    std::thread::scope(|scope| {
        for _ in 0..options.jobs.max(1) {
            scope.spawn(|| {
                while let Some(mutant) = todo.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let outcome = judge::ask(judges, mutant.number, folder);
                    let verdict = Verdict::of(mutant, &outcome, stages);
                    if let (Ok(line), Ok(mut file)) = (serde_json::to_string(&verdict), file.lock())
                    {
                        let _ = writeln!(file, "{line}");
                    }
                    let done = done.fetch_add(1, Ordering::Relaxed) + 1;
                    let progress = Progress {
                        done,
                        of: todo.len(),
                        start,
                    };
                    println!("{} {:18} {mutant}", progress.words(), verdict.words());
                }
            });
        }
    });
    Ok(())
}

struct Progress {
    done: usize,
    of: usize,
    start: Instant,
}

impl Progress {
    /// How many are done, and in how many minutes the rest is.
    #[expect(clippy::cast_precision_loss, reason = "an estimate")]
    fn words(&self) -> String {
        let Self { done, of, start } = self;
        let each = start.elapsed().as_secs_f64() / *done as f64;
        let minutes = each * (of - done) as f64 / 60.0;
        format!("{done:4} of {of}, {minutes:4.0} min to go:")
    }
}

/// Prints the survivors, each with its explanation, and how many each judge caught. An error where one is
/// not explained, or an explanation is of no survivor.
pub(crate) fn survivors(
    sources: &Sources,
    explained: &Explained,
    folder: &Path,
) -> Result<(), Failure> {
    let known = known(&folder.join("verdicts.jsonl"));
    let mut by = BTreeMap::<String, usize>::new();
    let (mut survived, mut unexplained, mut unjudged) = (0, 0, 0);
    for mutant in sources.mutants() {
        let Some(verdict) = known.get(&mutant.key()) else {
            unjudged += 1;
            continue;
        };
        if let Some(judge) = &verdict.caught_by {
            *by.entry(judge.clone()).or_default() += 1;
            continue;
        }
        survived += 1;
        let why = explained.of(mutant);
        unexplained += usize::from(why.is_none());
        let text = why.unwrap_or_else(|| "NOT EXPLAINED".to_owned());
        println!("{}: {mutant}\n     {text}", verdict.words());
    }
    let caught: usize = by.values().sum();
    println!("{caught} caught, {survived} survived, {unjudged} not judged");
    for (judge, count) in by {
        println!("  {count:4} first by {judge}");
    }
    let stale = explained.of_nothing(sources);
    for text in &stale {
        println!("explained, and no mutant: {text}");
    }
    match unexplained + unjudged + stale.len() {
        0 => Ok(()),
        _ => Err(Failure::Unexplained),
    }
}
