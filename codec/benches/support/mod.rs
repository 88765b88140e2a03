//! Times what stands in a table, row by row, as a machine that does other things as well lets it.

use std::env;
use std::hint::black_box;
use std::time::{Duration, Instant};

/// A row: what is timed, and a function that does it once and says how long it took.
pub type Row<'a> = (&'a str, Box<dyn FnMut() -> Duration + 'a>);

/// How often each row is timed.
const ROUNDS: usize = 400;

/// Whether there is something to measure: `cargo bench` passes `--bench`, and `cargo test --benches` does not.
pub fn is_wanted() -> bool {
    env::args().any(|argument| argument == "--bench")
}

/// How long `work` takes. What it returns is looked at where it lies: a copy of a message would be measured too.
pub fn time<R>(work: impl FnOnce() -> R) -> Duration {
    let start = Instant::now();
    black_box(&work());
    start.elapsed()
}

/// Prints the shortest time of each row in microseconds, divided by how often a row repeats its work, and returns them.
/// The rows are timed in turns, and nothing has interrupted the shortest of many.
pub fn print_shortest<const N: usize>(title: &str, repeats: u32, mut rows: [Row; N]) -> [f64; N] {
    let mut shortest = [Duration::MAX; N];
    for _ in 0..ROUNDS {
        for (shortest, (_, turn)) in shortest.iter_mut().zip(&mut rows) {
            *shortest = turn().min(*shortest);
        }
    }
    println!("\n{title}, in us, the shortest of {ROUNDS}:");
    let shortest = shortest.map(|time| time.as_secs_f64() * 1e6 / f64::from(repeats));
    for (us, (name, _)) in shortest.iter().zip(&rows) {
        println!("{us:>10.3}  {name}");
    }
    shortest
}
