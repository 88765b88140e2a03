//! The runner with a stand-in for Kani, which says of each harness what a test wants.

use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};

use clap::Parser;
use tempfile::TempDir;

use crate::kani::Outcome;
use crate::kept::Kept;
use crate::sources::Sources;
use crate::{Arguments, Entry, choose, prove, record};

/// The harnesses that are run here.
const NAMED: &str = "protocol::numbers";

const LATE: &str = "CBMC failed\nCBMC timed out.\n";
const REFUTED: &str =
    "SUMMARY:\nFailed Checks: a law\nVERIFICATION:- FAILED\nVerification Time: 1.5s\n";

/// The workspace of a stand-in for Kani that verifies all of [`NAMED`], with sources and lists.
struct Fake {
    folder: TempDir,
    entries: Vec<Entry>,
}

impl Fake {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        for part in ["protocol/src", "codec/src", "proofs/src"] {
            let part = folder.path().join(part);
            fs::create_dir_all(&part).unwrap();
            fs::write(part.join("lib.rs"), "mod it;").unwrap();
        }
        let source = Path::new(env!("CARGO_MANIFEST_DIR"));
        let kani = source.join("examples/run/fake-kani");
        symlink(kani, folder.path().join("kani")).unwrap();
        let entries = choose(&Arguments::parse_from(["run", NAMED]));
        assert!(entries.len() > 2, "some are run");
        let fake = Self { folder, entries };
        for entry in &fake.entries {
            fake.says(entry, &verified(entry.covers, entry.covers));
        }
        let list = fake.entries.iter().map(|it| {
            format!(
                "[[harness]]\nname = \"{}\"\ntime = \"not measured\" # yet\n\n",
                it.name
            )
        });
        fs::write(fake.path("proofs/harnesses.toml"), list.collect::<String>()).unwrap();
        fake
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// What Kani says of this harness from now on.
    fn says(&self, entry: &Entry, text: &str) {
        let text = format!("Checking harness {}...\n{text}", entry.name);
        fs::write(self.path(&entry.name), text).unwrap();
    }

    /// Runs the harnesses with these arguments as well.
    fn run(&self, more: &[&str]) -> Result<bool, String> {
        self.run_of(NAMED, more)
    }

    /// Runs the harnesses of this name, with these arguments as well.
    fn run_of(&self, named: &str, more: &[&str]) -> Result<bool, String> {
        let (keep, kani) = (self.path("kept.jsonl"), self.path("kani"));
        let usual = [
            "run",
            named,
            "--jobs",
            "1",
            "--keep",
            keep.to_str().unwrap(),
        ];
        let arguments = Arguments::parse_from(usual.iter().chain(more));
        prove(&arguments, kani.to_str().unwrap(), self.folder.path())
    }

    /// The names that a run has kept as verified.
    fn kept(&self) -> Vec<String> {
        let text = fs::read_to_string(self.path("kept.jsonl")).unwrap();
        let names = self.entries.iter().map(|it| it.name.clone());
        names
            .filter(|name| text.contains(&format!("\"{name}\"")))
            .collect()
    }
}

fn verified(satisfied: usize, of: usize) -> String {
    let time = "Verification Time: 2.5s";
    format!(
        " ** {satisfied} of {of} cover properties satisfied\nVERIFICATION:- SUCCESSFUL\n{time}\n"
    )
}

#[test]
fn verified_harnesses_are_kept_and_not_run_again_unless_that_is_asked_for() {
    let fake = Fake::new();
    assert_eq!(fake.run(&[]), Ok(true));
    assert_eq!(fake.kept().len(), fake.entries.len());
    for entry in &fake.entries {
        fake.says(entry, REFUTED);
    }
    assert_eq!(fake.run(&[]), Ok(true), "nothing was run");
    assert_eq!(
        fake.run(&["--memory"]),
        Ok(false),
        "with other checks, nothing is known"
    );
    assert_eq!(fake.run(&["--again"]), Ok(false));
}

#[test]
fn what_is_refuted_late_or_without_a_mark_fails_and_is_not_kept() {
    let covers = |fake: &Fake| fake.entries[1].covers;
    let without_a_mark = |fake: &Fake| verified(covers(fake) - 1, covers(fake));
    let with_a_mark_too_many = |fake: &Fake| verified(covers(fake) + 1, covers(fake) + 1);
    let says: [&dyn Fn(&Fake) -> String; 4] = [
        &|_| REFUTED.to_owned(),
        &|_| LATE.to_owned(),
        &without_a_mark,
        &with_a_mark_too_many,
    ];
    for says in says {
        let fake = Fake::new();
        fake.says(&fake.entries[1], &says(&fake));
        assert_eq!(fake.run(&[]), Ok(false), "{}", says(&fake));
        assert_eq!(fake.kept().len(), fake.entries.len() - 1);
        assert!(!fake.kept().contains(&fake.entries[1].name));
        fake.says(&fake.entries[1], &verified(covers(&fake), covers(&fake)));
        assert_eq!(fake.run(&[]), Ok(true), "that one is run again");
    }
}

#[test]
fn one_that_is_late_at_the_end_is_judged() {
    let fake = Fake::new();
    for entry in &fake.entries {
        fake.says(entry, LATE);
    }
    assert_eq!(fake.run(&[]), Ok(false));
    assert!(fake.kept().is_empty());
}

#[test]
fn a_kani_that_ends_early_or_is_not_there_is_an_error_with_its_words() {
    let fake = Fake::new();
    fs::remove_file(fake.path(&fake.entries[0].name)).unwrap();
    let error = fake.run(&[]).unwrap_err();
    assert!(error.contains("No such file"), "{error}");
    fs::remove_file(fake.path("kani")).unwrap();
    let error = fake.run(&["--again"]).unwrap_err();
    assert!(error.contains("kani"), "{error}");
}

#[test]
fn times_are_recorded_with_the_sources_once_all_are_verified() {
    let fake = Fake::new();
    let list = || fs::read_to_string(fake.path("proofs/harnesses.toml")).unwrap();
    let before = list();
    assert_eq!(fake.run(&[]), Ok(true));
    assert_eq!(list(), before, "only --record writes");
    fake.says(&fake.entries[1], REFUTED);
    assert_eq!(fake.run(&["--again", "--record"]), Ok(false));
    assert_eq!(list(), before, "one is refuted");

    let fake = Fake::new();
    let list = || fs::read_to_string(fake.path("proofs/harnesses.toml")).unwrap();
    let error = fake
        .run_of(&fake.entries[1].name, &["--record"])
        .unwrap_err();
    let missing = format!("{} harnesses are not verified", fake.entries.len() - 1);
    assert!(error.contains(&missing), "{error}");
    assert_eq!(list(), before);
    assert_eq!(fake.run(&["--record"]), Ok(true));
    assert_eq!(
        list(),
        before.replace("not measured", "2.5 s"),
        "comments stay"
    );
}

#[test]
fn a_changed_source_is_named() {
    let fake = Fake::new();
    assert_eq!(fake.run(&["--record"]), Ok(true));
    let sources = || Sources::of(fake.folder.path()).unwrap();
    let status = || record::status(&fake.path("proofs"), &sources()).unwrap();
    let (is_same, said) = status();
    assert!(
        is_same && said.contains("on the sources as they are"),
        "{said}"
    );
    let then = sources();
    let source = fake.path("codec/src/lib.rs");
    fs::write(&source, "mod other;").unwrap();
    let now = sources();
    assert_eq!(now.changed_since(&then), ["codec/src"]);
    fs::rename(&source, fake.path("codec/src/other.rs")).unwrap();
    assert_eq!(sources().changed_since(&now), ["codec/src"], "names count");
    let (is_same, said) = status();
    assert!(
        !is_same && said.contains("has changed: codec/src."),
        "{said}"
    );
    fs::remove_dir_all(fake.path("protocol/src")).unwrap();
    let error = Sources::of(fake.folder.path()).unwrap_err();
    assert!(error.contains("protocol/src"), "{error}");
}

#[test]
fn nothing_is_kept_of_sources_that_change_while_harnesses_run() {
    let fake = Fake::new();
    let keep = fake.path("kept.jsonl");
    let mut kept = Kept::open(&keep, fake.folder.path(), false).unwrap();
    let outcome = || Outcome {
        name: fake.entries[0].name.clone(),
        seconds: 1.0,
        failure: None,
    };
    fs::write(fake.path("protocol/src/lib.rs"), "mod other;").unwrap();
    let error = kept.keep(&outcome()).unwrap_err();
    assert!(error.contains("protocol/src has changed"), "{error}");
    assert!(fake.kept().is_empty() && kept.seconds(&outcome().name).is_none());
    fs::write(fake.path("protocol/src/lib.rs"), "mod it;").unwrap();
    assert_eq!(kept.keep(&outcome()), Ok(()), "it is as it was");
    assert_eq!(fake.kept().len(), 1);
}

#[test]
fn what_is_committed_says_when_all_were_verified() {
    let root = Path::new(crate::ROOT);
    let sources = Sources::of(root).unwrap();
    let (_, said) = record::status(&root.join(crate::FOLDER), &sources).unwrap();
    assert!(
        said.starts_with("Kani verified all harnesses on 20"),
        "{said}"
    );
}
