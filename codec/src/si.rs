//! Physical quantities in SI units, and the numbers that stand for them on the wire.
//!
//! Pure functions and tables of constants, without heap and without the standard library. They are
//! total: every `f64` has a number, NaN is *unavailable*, infinities saturate, nothing wraps. They
//! are monotone, and exact on what they produced: a number that was decoded encodes to itself.
//!
//! | table | for | below and above the range |
//! |---|---|---|
//! | [`Scale`] | a count of steps | saturates to the first and the last number |
//! | [`Element`] | a [`Scale`] with a number for *unavailable* | saturates, or is unavailable |
//! | [`Confidence`] | the half width of a 95 % interval | its number for *out of range* |
//! | [`Ladder`] | an ENUMERATED confidence | its number for *out of range* |
//!
//! The common data dictionary rounds up: the number *n* stands for what is larger than *n* - 1 steps
//! and not larger than *n* (TS 102 894-2 v2.4.1, at each data element). Positions and angles are
//! rounded to the nearest step. The first and the last number of an element are its *out of range*
//! where it has them; they decode to the value at which the range ends, to be read as *at least
//! that*.

mod angle;
#[cfg(feature = "laws")]
#[doc(hidden)]
pub mod laws;
mod tables;
mod time;

pub use angle::{angle, angle_degrees, longitude, longitude_degrees};
pub use tables::*;
pub use time::{
    LEAP_SECONDS_UNIX_MS, TIMESTAMP_ITS_MAX, generation_delta_time, rebuild_timestamp,
    timestamp_its, unix_ms,
};

/// To which step a quantity between two steps is rounded.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Rounding {
    /// The next smaller one.
    Down,
    /// The nearest one, and away from zero from the middle.
    Nearest,
    /// The next larger one.
    Up,
}

/// Numbers for a quantity beyond the first or the last step.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Beyond {
    /// The first or the last number.
    Saturates,
    /// The number for *unavailable*, since the element has none for *out of range*.
    IsUnavailable,
}

/// A count of steps of a quantity.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Scale<N> {
    /// How many steps one SI unit has.
    pub steps_per_unit: f64,
    /// The first number.
    pub min: N,
    /// The last number.
    pub max: N,
    /// How a quantity between two steps is rounded.
    pub rounding: Rounding,
}

/// A [`Scale`] and a number for *unavailable*.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Element<N> {
    /// The numbers that stand for quantities.
    pub scale: Scale<N>,
    /// The number for *unavailable*.
    pub unavailable: N,
    /// The number for a quantity outside of the scale.
    pub beyond: Beyond,
}

/// Half width of a 95 % interval, counted in steps from 1 and rounded up.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Confidence<N> {
    /// How many steps one SI unit has.
    pub steps_per_unit: f64,
    /// The last number that stands for a half width.
    pub max: N,
    /// The number for a larger half width.
    pub out_of_range: N,
    /// The number for *unavailable*.
    pub unavailable: N,
}

/// Half width of a 95 % interval by classes: class *n* is for widths up to the *n*-th limit, the
/// class behind the last limit is *out of range*, and the one after that is *unavailable*.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Ladder {
    /// The limits, in SI units, smallest first.
    pub limits: &'static [f64],
}

/// A millionth of a step: what a multiplication by the number of steps may be off.
const TOLERANCE: f64 = 1e-6;

impl Rounding {
    /// Rounds a number of steps between -2^53 and 2^53.
    ///
    /// Steps that are within a millionth of a whole number are that number, or else what was decoded
    /// could encode to the next one.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_precision_loss,
        reason = "see above"
    )]
    fn round(self, steps: f64) -> i64 {
        let shifted = match self {
            Self::Down => steps + TOLERANCE,
            Self::Nearest if steps < 0.0 => return -Self::Nearest.round(-steps),
            Self::Nearest => steps + 0.5,
            Self::Up => return -Self::Down.round(-steps),
        };
        let whole = shifted as i64;
        if whole as f64 > shifted {
            whole - 1
        } else {
            whole
        }
    }
}

impl<N: Copy> Scale<N> {
    /// The numbers from `min` to `max`, for so many steps per SI unit.
    const fn new(steps_per_unit: f64, min: N, max: N, rounding: Rounding) -> Self {
        Self {
            steps_per_unit,
            min,
            max,
            rounding,
        }
    }

    /// The element with this number for *unavailable*, which saturates.
    const fn with_unavailable(self, unavailable: N) -> Element<N> {
        Element {
            scale: self,
            unavailable,
            beyond: Beyond::Saturates,
        }
    }

    /// The element with this number for *unavailable*, and for what is outside of the scale.
    const fn unavailable_beyond(self, unavailable: N) -> Element<N> {
        Element {
            beyond: Beyond::IsUnavailable,
            ..self.with_unavailable(unavailable)
        }
    }
}

impl<N: Copy + Into<i64> + TryFrom<i64>> Scale<N> {
    /// The number that stands for `quantity`; `None` for NaN. Saturates.
    pub fn encode(&self, quantity: f64) -> Option<N> {
        let steps = quantity * self.steps_per_unit;
        if steps.is_nan() {
            return None;
        }
        if steps >= float(self.max) {
            return Some(self.max);
        }
        if steps <= float(self.min) {
            return Some(self.min);
        }
        Some(self.saturate(self.rounding.round(steps)))
    }

    /// The number that stands for this many steps. Saturates.
    pub fn saturate(&self, steps: i64) -> N {
        if steps >= self.max.into() {
            return self.max;
        }
        // In range, so the conversion cannot fail.
        N::try_from(steps.max(self.min.into())).unwrap_or(self.min)
    }

    /// The quantity that `number` stands for.
    pub fn decode(&self, number: N) -> f64 {
        float(number) / self.steps_per_unit
    }

    /// True if `quantity` is one that a number stands for, without saturation.
    fn covers(&self, quantity: f64) -> bool {
        let steps = quantity * self.steps_per_unit;
        steps >= float(self.min) - 0.5 && steps <= float(self.max) + 0.5
    }
}

impl<N: Copy + Into<i64> + TryFrom<i64> + PartialEq> Element<N> {
    /// The number that stands for `quantity`; *unavailable* for `None` and NaN.
    pub fn encode(&self, quantity: Option<f64>) -> N {
        let covered = quantity
            .filter(|&quantity| self.beyond == Beyond::Saturates || self.scale.covers(quantity));
        covered
            .and_then(|quantity| self.scale.encode(quantity))
            .unwrap_or(self.unavailable)
    }

    /// The quantity that `number` stands for; `None` for *unavailable*.
    pub fn decode(&self, number: N) -> Option<f64> {
        (number != self.unavailable).then(|| self.scale.decode(number))
    }
}

impl<N: Copy + Into<i64> + TryFrom<i64> + PartialEq> Confidence<N> {
    /// The number that stands for `half_width`; *unavailable* for `None`, NaN and negative ones.
    pub fn encode(&self, half_width: Option<f64>) -> N {
        let Some(half_width) = half_width.filter(|&half_width| half_width >= 0.0) else {
            return self.unavailable;
        };
        let steps = half_width * self.steps_per_unit;
        if steps > float(self.max) + TOLERANCE {
            return self.out_of_range;
        }
        // In range, so the conversion cannot fail.
        N::try_from(Rounding::Up.round(steps).max(1)).unwrap_or(self.unavailable)
    }

    /// The half width that `number` stands for: `None` for *unavailable* and the unused 0, infinite
    /// for *out of range*.
    pub fn decode(&self, number: N) -> Option<f64> {
        if number == self.unavailable || number.into() == 0 {
            None
        } else if number == self.out_of_range {
            Some(f64::INFINITY)
        } else {
            Some(float(number) / self.steps_per_unit)
        }
    }
}

impl Ladder {
    /// The class of `half_width`; *unavailable* for `None`, NaN and negative ones.
    #[must_use]
    pub fn encode(&self, half_width: Option<f64>) -> usize {
        let Some(half_width) = half_width.filter(|&half_width| half_width >= 0.0) else {
            return self.unavailable();
        };
        let class = self.limits.iter().position(|&limit| half_width <= limit);
        class.unwrap_or(self.limits.len())
    }

    /// The limit of `class`: `None` for *unavailable*, infinite for *out of range*.
    #[must_use]
    pub fn decode(&self, class: usize) -> Option<f64> {
        if class == self.limits.len() {
            return Some(f64::INFINITY);
        }
        self.limits.get(class).copied()
    }

    /// The class for *unavailable*.
    #[must_use]
    pub const fn unavailable(&self) -> usize {
        self.limits.len() + 1
    }
}

/// Every number of these tables is far below 2^53.
#[expect(clippy::cast_precision_loss, reason = "see above")]
fn float(number: impl Into<i64>) -> f64 {
    number.into() as f64
}
