//! The tests of the workers, in one program.

mod broken;
mod counts;

use std::num::NonZeroUsize;

use crossguard_workers::Options;

/// Options for this number of workers.
fn workers(number: usize) -> Options {
    Options {
        workers: NonZeroUsize::new(number).unwrap(),
        ..Options::default()
    }
}
