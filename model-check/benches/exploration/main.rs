//! How fast states are explored, and what one takes in memory: the kit's model, the same protocol in
//! stateright's `ActorModel`, and the pair in SPIN, side by side.
//!
//! ```console
//! cargo bench -p crossguard-model-check
//! ```
//!
//! Each exploration runs in a process of its own, on one thread. Seconds are those of processor time, so
//! that what else the machine does counts little. Bytes are the peak resident memory of
//! that process (`VmHWM`) less what it had before it began to explore, divided by the distinct states:
//! the set of visited states, the frontier, tables of interned values, and the allocator's waste, all
//! of it. SPIN's bytes are what `pan` reports, less its hash table's fixed part.

mod actors;

use std::num::NonZeroUsize;
use std::path::Path;
use std::process::Command;

use crossguard_model_check::check::{Options, check};
use crossguard_model_check::cost::{Meter, Of, processor_time};
use crossguard_model_check::count_states;
use crossguard_model_check::model::Model;
use crossguard_model_check::scenario::Scenario;
use stateright::{Checker, Model as _};

/// How much more must be explored in a second, on one core (issue 3).
const STATES_PER_SECOND_MIN: f64 = 200_000.0;

/// How much memory a state may take (issue 3).
const BYTES_PER_STATE_MAX: f64 = 120.0;

const NOTES: &str = "\
Comparable: the first four rows are one transition function, `Robot::step`, on one scenario, and all are
distinct states per second of processor time.
Not comparable:
- The kit's exploration keeps all states and all transitions, and judges single steps; what is to hold of
  states is judged by the other one, stateright's. `check` does both, and counts every state once.
- ActorModel knows no renaming, so heartbeats and offers grow without end, and no radio on which a message
  arrives at once: every message in flight may wait. Its state space is infinite; it is cut off after as
  many states as `trio` has. It checks two properties, without history; the kit's model checks all.
- SPIN's model is of `pair`, in its own words, with its properties, compiled by gcc -O2.";

/// What one exploration took.
struct Measured {
    states: f64,
    seconds: f64,
    /// Memory at the peak, less that from before.
    bytes_per_state: f64,
}

fn main() {
    let arguments: Vec<_> = std::env::args().collect();
    // `cargo bench` passes `--bench`; with `cargo test --benches` there is nothing to measure.
    if let [_, exploration, name] = &arguments[..]
        && exploration == "--explore"
    {
        explore(name);
        return;
    }
    if !arguments.iter().any(|argument| argument == "--bench") {
        return;
    }
    println!(
        "{:<44} {:>10} {:>8} {:>11} {:>12}",
        "", "states", "seconds", "states/s", "bytes/state"
    );
    row("trio, the kit's exploration", in_own_process("graph"));
    row(
        "trio, the kit's model in stateright",
        in_own_process("model"),
    );
    let check = row("trio, `check`: both, and liveness", in_own_process("check"));
    row("trio in stateright's ActorModel", in_own_process("actors"));
    match spin() {
        Ok(measured) => {
            row("pair, the Promela model in SPIN", measured);
        }
        Err(missing) => println!(
            "{:<44} SKIPPED: {missing} is not installed",
            "pair, the Promela model in SPIN"
        ),
    }
    println!("\n{NOTES}");
    let (rate, bytes) = check;
    println!(
        "\nrequired of `check`: {STATES_PER_SECOND_MIN} states/s, {}; {BYTES_PER_STATE_MAX} bytes/state, {}",
        met(rate >= STATES_PER_SECOND_MIN),
        met(bytes <= BYTES_PER_STATE_MAX),
    );
}

fn met(is_met: bool) -> &'static str {
    if is_met { "met" } else { "MISSED" }
}

/// Prints one row; states per second and bytes per state.
fn row(
    what: &str,
    Measured {
        states,
        seconds,
        bytes_per_state: bytes,
    }: Measured,
) -> (f64, f64) {
    let rate = states / seconds;
    println!("{what:<44} {states:>10} {seconds:>8.2} {rate:>11.0} {bytes:>12.0}");
    (rate, bytes)
}

fn explore(name: &str) {
    let scenario = Scenario::load("trio").expect("a shipped scenario");
    let limit = scenario.expected.expect("its size is known").unique_states;
    let meter = Meter::start();
    let states = match name {
        "graph" => count_states(&Model::new(scenario)),
        "model" => Model::new(scenario)
            .checker()
            .threads(1)
            .spawn_bfs()
            .join()
            .unique_state_count(),
        "check" => {
            let options = Options {
                threads: NonZeroUsize::MIN,
                ..Options::default()
            };
            check(&Model::new(scenario), &options, &mut |_| ()).unique_states
        }
        "actors" => actors::explore(&scenario, limit),
        other => panic!("no exploration {other}"),
    };
    let cost = meter.read(states);
    let (seconds, bytes) = cost
        .processor_seconds
        .zip(cost.bytes_per_state)
        .expect("Linux");
    println!("{states} {seconds} {bytes}");
}

fn in_own_process(name: &str) -> Measured {
    let program = std::env::current_exe().expect("the benchmark has a path");
    let output = Command::new(program)
        .args(["--explore", name])
        .output()
        .expect("it starts again");
    assert!(
        output.status.success(),
        "{name}: {}",
        String::from_utf8_lossy(&output.stderr)
    );
    let printed = String::from_utf8(output.stdout).expect("three numbers");
    let numbers: Vec<f64> = printed
        .split_whitespace()
        .map(|n| n.parse().expect("a number"))
        .collect();
    let [states, seconds, bytes_per_state] = numbers[..] else {
        panic!("{name} printed {printed}");
    };
    Measured {
        states,
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
    let start = spent();
    let printed = run(Command::new("./pan").args(["-m40000", "-n", "-c0"]));
    let seconds = spent().saturating_sub(start).as_secs_f64();
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
        seconds,
        bytes_per_state: figure("actual memory usage for states") * 1024.0 * 1024.0 / states,
    })
}
