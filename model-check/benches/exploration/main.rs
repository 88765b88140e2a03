//! How fast states are explored, and what one takes in memory: the kit's model, the same model in
//! stateright, and the pair in SPIN, side by side.
//!
//! ```console
//! cargo bench -p crossguard-model-check
//! ```
//!
//! Each exploration runs in a process of its own. States per second are those of processor time, of all threads
//! together, so that what else the machine does counts little; seconds are those of the clock. Bytes are the peak
//! resident memory of that process (`VmHWM`) less what it had before it began to explore, divided by the distinct
//! states: the set of visited states, the frontier, tables of interned values, and the allocator's waste, all of it.
//! SPIN's bytes are what `pan` reports, less its hash table's fixed part.

mod cost;

use std::num::NonZeroUsize;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

use crossguard_model_check::check::{Options, check};
use crossguard_model_check::model::Model;
use crossguard_model_check::scenario::Scenario;
use stateright::{Checker, Model as _};

use cost::{Meter, Of, processor_time};

/// How many times as fast as SPIN explores its pair `check` explores the trio, by the second and core (issue 20).
const TIMES_SPIN_MIN: f64 = 2.0;

/// How much memory a state may take with its graph, and where only safety is asked (issue 20).
const BYTES_PER_STATE_MAX: [f64; 2] = [50.0, 16.0];

const NOTES: &str = "\
Comparable: all rows but SPIN's are one transition function, `Robot::step`, and all are
distinct states per second of processor time.
Not comparable:
- `check` keeps all states and all transitions, and judges states, steps and runs. With `--safety` it keeps
  states alone, and judges states and steps. With its second opinion it explores once more with stateright,
  and counts every state once.
- `trio` has so few states that tables of values that all states share are a good part of their bytes;
  `team-of-four` says what a state takes.
- SPIN's model is of `pair`, in its own words, with its properties, compiled by gcc -O2.";

/// Cost of one exploration.
struct Measured {
    states: f64,
    /// By the clock.
    elapsed: f64,
    /// Of processor time, of all threads.
    seconds: f64,
    /// Memory at the peak, less that from before.
    bytes_per_state: f64,
}

impl Measured {
    fn rate(&self) -> f64 {
        self.states / self.seconds
    }
}

fn main() {
    let arguments: Vec<_> = std::env::args().collect();
    // `cargo bench` passes `--bench`; with `cargo test --benches` there is nothing to measure.
    if let [_, exploration, name, scenario, threads] = &arguments[..]
        && exploration == "--explore"
    {
        let threads = threads.parse().expect("a number of threads");
        explore(name, scenario, threads);
        return;
    }
    if !arguments.iter().any(|argument| argument == "--bench") {
        return;
    }
    println!(
        "{:<44} {:>10} {:>8} {:>15} {:>12}",
        "", "states", "seconds", "states/s/core", "bytes/state"
    );
    let check = row(
        "trio, `check`, 1 thread",
        in_own_process("check", "trio", 1),
    );
    row(
        "trio, `check`, 2 threads",
        in_own_process("check", "trio", 2),
    );
    row(
        "trio, `check --safety`",
        in_own_process("safety", "trio", 1),
    );
    let second = in_own_process("second-opinion", "trio", 1);
    row("trio, `check --second-opinion`", second);
    let model = in_own_process("model", "trio", 1);
    row("trio, the kit's model in stateright", model);
    let team = in_own_process("check", "team-of-four", 2);
    let team = row("team-of-four, `check`, 2 threads", team);
    let safety = in_own_process("safety", "team-of-four", 2);
    let safety = row("team-of-four, `check --safety`, 2 threads", safety);
    let spin = spin().map(|measured| row("pair, the Promela model in SPIN", measured));
    println!("\n{NOTES}\n");
    match spin {
        Ok(spin) => required(
            "states/s/core of `check`, as a multiple of SPIN's",
            check.rate() / spin.rate(),
            |times| times >= TIMES_SPIN_MIN,
        ),
        Err(missing) => println!("SPIN: SKIPPED, {missing} is not installed"),
    }
    let [whole, states] = BYTES_PER_STATE_MAX;
    required("bytes/state of `check`", team.bytes_per_state, |bytes| {
        bytes <= whole
    });
    required(
        "bytes/state of `check --safety`",
        safety.bytes_per_state,
        |bytes| bytes <= states,
    );
}

/// Says whether what is required is met.
fn required(what: &str, found: f64, is_met: impl FnOnce(f64) -> bool) {
    let met = if is_met(found) { "met" } else { "MISSED" };
    println!("required: {what}: {found:.1}, {met}");
}

/// Prints one row.
fn row(what: &str, measured: Measured) -> Measured {
    let Measured {
        states,
        elapsed,
        bytes_per_state: bytes,
        ..
    } = measured;
    let rate = measured.rate();
    println!("{what:<44} {states:>10} {elapsed:>8.2} {rate:>15.0} {bytes:>12.1}");
    measured
}

fn explore(name: &str, scenario: &str, threads: NonZeroUsize) {
    let start = Instant::now();
    let scenario = Scenario::load(scenario).expect("a shipped scenario");
    let meter = Meter::start();
    let states = match name {
        "model" => Model::new(scenario)
            .checker()
            .threads(1)
            .spawn_bfs()
            .join()
            .unique_state_count(),
        "check" | "safety" | "second-opinion" => {
            let options = Options {
                threads,
                second_opinion: name == "second-opinion",
                safety_only: name == "safety",
                ..Options::default()
            };
            check(&Model::new(scenario), &options, &mut |_| ()).unique_states
        }
        other => panic!("no exploration {other}"),
    };
    let (seconds, bytes) = meter.read(states).expect("Linux");
    let elapsed = start.elapsed().as_secs_f64();
    println!("{states} {elapsed} {seconds} {bytes}");
}

fn in_own_process(name: &str, scenario: &str, threads: usize) -> Measured {
    let program = std::env::current_exe().expect("the benchmark has a path");
    let output = Command::new(program)
        .args(["--explore", name, scenario, &threads.to_string()])
        .output()
        .expect("it starts again");
    assert!(
        output.status.success(),
        "{name}: {}",
        String::from_utf8_lossy(&output.stderr)
    );
    let printed = String::from_utf8(output.stdout).expect("four numbers");
    let numbers: Vec<f64> = printed
        .split_whitespace()
        .map(|n| n.parse().expect("a number"))
        .collect();
    let [states, elapsed, seconds, bytes_per_state] = numbers[..] else {
        panic!("{name} printed {printed}");
    };
    Measured {
        states,
        elapsed,
        seconds,
        bytes_per_state,
    }
}

/// Compiles and runs the Promela model; the program that is missing, if one is.
fn spin() -> Result<Measured, &'static str> {
    for program in ["spin", "gcc"] {
        Command::new(program)
            .arg("--help")
            .output()
            .map_err(|_| program)?;
    }
    let folder = std::env::temp_dir().join(format!("crossguard-spin-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a temporary folder");
    let model = Path::new(env!("CARGO_MANIFEST_DIR")).join("spin/pair.pml");
    let run = |command: &mut Command| {
        let output = command.current_dir(&folder).output().expect("it starts");
        assert!(
            output.status.success(),
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
        String::from_utf8(output.stdout).expect("text")
    };
    run(Command::new("spin").arg("-a").arg(model));
    run(Command::new("gcc").args(["-O2", "-w", "-DSAFETY", "-DNOREDUCE", "-o", "pan", "pan.c"]));
    let spent = || processor_time(Of::Children).expect("Linux");
    let (clock, start) = (Instant::now(), spent());
    let printed = run(Command::new("./pan").args(["-m40000", "-n", "-c0"]));
    let seconds = spent().saturating_sub(start).as_secs_f64();
    let elapsed = clock.elapsed().as_secs_f64();
    std::fs::remove_dir_all(&folder).expect("the folder is ours");
    let figure = |what: &str| -> f64 {
        let line = printed
            .lines()
            .find(|line| line.contains(what))
            .expect("a line of pan's report");
        line.split_whitespace()
            .next()
            .and_then(|n| n.parse().ok())
            .expect("it begins with a number")
    };
    let states = figure("states, stored");
    Ok(Measured {
        states,
        elapsed,
        seconds,
        bytes_per_state: figure("actual memory usage for states") * 1024.0 * 1024.0 / states,
    })
}
