//! The independent model of the pair in Promela (`model-check/spin`), checked with SPIN: the same
//! verdicts as the kit's model, and the same rules needed for them.
//!
//! It takes `spin` and `gcc`. Where one of them is missing, the tests are skipped, and say so by name.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use crossguard_model_check::check::{Options, check};
use crossguard_model_check::model::Model;
use crossguard_model_check::properties::PropertyId::{self, *};
use crossguard_model_check::report::Verdict;
use crossguard_model_check::scenario::Scenario;

/// Distinct states of the Promela model; a change of it is to be looked at, like that of a scenario.
const STATES: usize = 632_596;

/// What the Promela model speaks about. It has no totality (I13), as it has no inputs but those that its
/// channel carries, and no liveness under fairness.
const EXPRESSED: [PropertyId; 14] = [I1, I2, I3, I4, I5, I6, I7, I8, I9, I11, I12, I14, I16, L7];

fn is_installed(program: &str) -> bool {
    Command::new(program).arg("--help").output().is_ok()
}

/// Whether SPIN can run; if not, says so.
fn can_run(test: &str) -> bool {
    let missing = ["spin", "gcc"]
        .into_iter()
        .find(|program| !is_installed(program));
    if let Some(program) = missing {
        // Not by eprintln!, which the test runner would capture.
        let _ = writeln!(
            std::io::stderr(),
            "SKIPPED {test}: {program} is not installed"
        );
    }
    missing.is_none()
}

/// One run of SPIN's verifier, in a folder of its own.
struct Verification {
    folder: PathBuf,
    macros: Vec<String>,
}

impl Verification {
    /// Of the Promela model with the bounds of a scenario.
    fn of(name: &str, scenario: &Scenario) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("spin-{name}"));
        let bounds = &scenario.bounds;
        let n_ack = scenario.config.settings().n_ack;
        let macros = vec![
            format!("-DDETECTIONS={}", bounds.detections),
            format!("-DCOMMANDS={}", bounds.commands),
            format!("-DDISTURBANCES={}", bounds.disturbances),
            format!("-DN_ACK={n_ack}"),
        ];
        Self { folder, macros }
    }

    /// The same without one rule of the protocol, until these properties are violated.
    fn without(mut self, rule: &str, until: &[PropertyId]) -> Self {
        let bits = until.iter().fold(0_u32, |bits, &id| bits | 1 << number(id));
        self.macros.push(format!("-D{rule}"));
        self.macros.push(format!("-DUNTIL_VIOLATED={bits}"));
        self
    }

    /// What the verifier prints.
    fn run(&self, optimize: &str) -> String {
        let _ = std::fs::remove_dir_all(&self.folder);
        std::fs::create_dir_all(&self.folder).unwrap();
        let model = Path::new(env!("CARGO_MANIFEST_DIR")).join("spin/pair.pml");
        let mut spin = Command::new("spin");
        self.call(spin.arg("-a").args(&self.macros).arg(model));
        let gcc = [
            optimize,
            "-w",
            "-DSAFETY",
            "-DNOREDUCE",
            "-o",
            "pan",
            "pan.c",
        ];
        self.call(Command::new("gcc").args(gcc));
        let printed = self.call(Command::new("./pan").args(["-m20000", "-n", "-c0"]));
        std::fs::remove_dir_all(&self.folder).unwrap();
        printed
    }

    fn call(&self, command: &mut Command) -> String {
        let output = command.current_dir(&self.folder).output().unwrap();
        let printed = String::from_utf8(output.stdout).unwrap();
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{command:?}: {printed}{errors}");
        printed
    }
}

/// The number that `properties.pml` gives to a property.
fn number(id: PropertyId) -> u32 {
    match id {
        L7 => 20,
        _ => id.to_string()[1..].parse().unwrap(),
    }
}

fn says(printed: &str, what: &str, id: PropertyId) -> bool {
    printed.lines().any(|line| line == format!("{what} {id}"))
}

fn assert_exhaustive(printed: &str) {
    assert!(printed.contains("Full statespace search"), "{printed}");
    for limit in [
        "max search depth too small",
        "Search not completed",
        "out of memory",
    ] {
        assert!(!printed.contains(limit), "{printed}");
    }
}

#[test]
fn spin_and_the_kit_come_to_the_same_verdicts_about_the_pair() {
    if !can_run("spin_and_the_kit_come_to_the_same_verdicts_about_the_pair") {
        return;
    }
    let mut scenario = Scenario::load("pair").unwrap();
    let printed = Verification::of("pair", &scenario).run("-O2");
    assert_exhaustive(&printed);
    assert!(printed.contains("errors: 0"), "{printed}");
    assert!(
        printed.contains(&format!("{STATES} states, stored")),
        "{printed}"
    );

    scenario.properties.retain(|id| EXPRESSED.contains(id));
    assert_eq!(scenario.properties, EXPRESSED);
    let report = check(&Model::new(scenario), &Options::default(), &mut |_| ());
    for id in EXPRESSED {
        let holds = report.verdict(&id.to_string()) == Some(Verdict::Holds);
        assert_eq!(!says(&printed, "violated", id), holds, "{id}: {printed}");
        if let Some(verdict) = report.verdict(&format!("{id}-premise")) {
            let reachable = verdict == Verdict::Reachable;
            assert_eq!(says(&printed, "premise", id), reachable, "{id}: {printed}");
        }
    }
}

/// Asserts that without `rule` SPIN finds these properties violated, those that the kit's model finds
/// violated without the same rule (`tests/weakenings.rs`).
fn assert_needed(rule: &str, scenario: &Scenario, properties: &[PropertyId]) {
    let printed = Verification::of(rule, scenario)
        .without(rule, properties)
        .run("-O0");
    for &id in properties {
        assert!(
            says(&printed, "violated", id),
            "{rule}: {id} should break: {printed}"
        );
    }
}

#[test]
fn in_spin_too_each_rule_is_needed_for_the_property_that_it_keeps() {
    if !can_run("in_spin_too_each_rule_is_needed_for_the_property_that_it_keeps") {
        return;
    }
    let pair = Scenario::load("pair").unwrap();
    let rules: [(&str, &[PropertyId]); 10] = [
        ("NO_OFFER_NUMBERS", &[I2, I4]),
        ("NO_CONFIRMATION", &[I2]),
        ("NO_MEMORY_OF_REPEATED", &[I4, I9]),
        ("NO_ORDER_OF_REQUESTS", &[I5]),
        ("ANY_ACKNOWLEDGEMENT", &[I6, I7]),
        ("ANY_PROGRESS", &[I8]),
        ("CORRIDOR_STAYS_OPEN", &[I11]),
        ("RELEASED_GOES_ON", &[I14]),
        ("NO_FOLLOWER_TIMERS", &[I12, L7]),
        ("ONE_REPEAT_MORE", &[I16]),
    ];
    for (rule, properties) in rules {
        assert_needed(rule, &pair, properties);
    }
}

#[test]
fn in_spin_too_a_command_of_an_earlier_session_must_not_be_executed() {
    if !can_run("in_spin_too_a_command_of_an_earlier_session_must_not_be_executed") {
        return;
    }
    // A second session takes a second pedestrian.
    let text = include_str!("../scenarios/pair.toml")
        .replace("detections = 1", "detections = 2")
        .replace("commands = 2", "commands = 1");
    let two_sessions = Scenario::parse("two sessions", &text).unwrap();
    let printed = Verification::of("two-sessions", &two_sessions).run("-O2");
    assert_exhaustive(&printed);
    assert!(printed.contains("errors: 0"), "{printed}");
    assert_needed("ANY_SESSION", &two_sessions, &[I3]);
}
