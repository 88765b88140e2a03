//! A stand-in for the crate `kani` where there is no Kani: random values, so that a harness is a
//! test.
//!
//! A run of a harness ends early where `assume` does not hold. Which of its `cover!` marks it
//! reached is recorded.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

/// Events in the runs of a harness.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Record {
    /// Runs in which every assumption held.
    pub complete: u64,
    /// The harness's cover marks that were evaluated, and whether one was satisfied.
    pub covers: BTreeMap<&'static str, bool>,
}

#[derive(Default)]
struct Run {
    random: u64,
    covers: BTreeMap<&'static str, bool>,
}

thread_local! {
    static RUN: RefCell<Run> = RefCell::default();
}

/// An assumption does not hold; nobody sees this, it ends the run.
struct Rejected;

/// Runs `harness` with random values, `runs` times, all of which follow from `seed`.
///
/// # Panics
/// Where the harness does: its law is broken.
pub fn run(harness: fn(), seed: u64, runs: u64) -> Record {
    RUN.set(Run {
        random: seed,
        ..Run::default()
    });
    let mut complete = 0;
    for _ in 0..runs {
        match catch_unwind(AssertUnwindSafe(harness)) {
            Ok(()) => complete += 1,
            Err(rejected) if rejected.is::<Rejected>() => {}
            Err(panic) => resume_unwind(panic),
        }
    }
    Record {
        complete,
        covers: RUN.take().covers,
    }
}

/// The next 64 random bits (`SplitMix64`).
fn random() -> u64 {
    RUN.with_borrow_mut(|run| {
        run.random = run.random.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = run.random;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    })
}

/// A random number of at most `max`: mostly `hint`, often one near it, sometimes any; any where
/// `hint` is above `max`.
#[expect(clippy::cast_possible_truncation, reason = "below 2^32 on purpose")]
pub(crate) fn number(max: u32, hint: u32) -> u32 {
    let bits = random();
    let near = (bits >> 8) as u32 % 4;
    match bits % 64 {
        0 => (random() % (u64::from(max) + 1)) as u32,
        _ if hint > max => (random() % (u64::from(max) + 1)) as u32,
        1..8 => hint.saturating_add(near).min(max),
        8..16 => hint.saturating_sub(near).min(max),
        _ => hint.min(max),
    }
}

/// A number from `low` to `high` made of any: often one of these two.
pub(crate) fn between(any: i64, low: i64, high: i64) -> i64 {
    match random() % 8 {
        0 => low,
        1 => high,
        _ => low.saturating_add_unsigned(any.cast_unsigned() % (high.abs_diff(low) + 1)),
    }
}

/// A type of which Kani has any value.
pub trait Arbitrary: Sized {
    /// Any value.
    fn any() -> Self;
}

macro_rules! arbitrary {
    ($($number:ty),*) => {$(
        impl Arbitrary for $number {
            #[expect(
                clippy::allow_attributes,
                reason = "not every type is cut off"
            )]
            #[allow(clippy::cast_possible_truncation, clippy::cast_possible_wrap, reason = "any bits do")]
            fn any() -> Self {
                // Small ones and those at the edges more often than chance has it.
                match random() % 8 {
                    0 => (random() % 4) as Self,
                    1 => Self::MAX.wrapping_sub((random() % 4) as Self),
                    _ => random() as Self,
                }
            }
        }
    )*};
}
arbitrary!(u8, u16, u32, u64, usize, i32, i64);

impl Arbitrary for bool {
    fn any() -> Self {
        random().is_multiple_of(2)
    }
}

impl Arbitrary for f64 {
    #[expect(clippy::cast_precision_loss, reason = "any value does")]
    fn any() -> Self {
        match random() % 8 {
            0 => [Self::NAN, Self::INFINITY, Self::NEG_INFINITY, -0.0][(random() % 4) as usize],
            1 => Self::from_bits(random()),
            // Where the ranges of the data elements are.
            2..4 => (random().cast_signed() >> 32) as Self / 1e4,
            4..6 => (random().cast_signed() >> 32) as Self / 1e6,
            _ => (random().cast_signed() >> 32) as Self / 1e8,
        }
    }
}

impl<T: Arbitrary, const N: usize> Arbitrary for [T; N] {
    fn any() -> Self {
        std::array::from_fn(|_| T::any())
    }
}

/// Any value.
pub(crate) fn any<T: Arbitrary>() -> T {
    T::any()
}

/// Ends the run unless `condition` holds.
pub(crate) fn assume(condition: bool) {
    if !condition {
        resume_unwind(Box::new(Rejected));
    }
}

/// Records that the mark `name` was evaluated, and whether `condition` holds.
pub(crate) fn record_cover(condition: bool, name: &'static str) {
    RUN.with_borrow_mut(|run| *run.covers.entry(name).or_default() |= condition);
}

/// Marks a class of outcomes that must be reachable.
macro_rules! cover {
    ($condition:expr, $name:literal) => {
        $crate::stand_in::record_cover($condition, $name)
    };
}
pub(crate) use cover;
