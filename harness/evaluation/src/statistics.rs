//! Mean and standard deviation over seeds.

use serde::{Deserialize, Serialize};

/// Mean and standard deviation of a sample.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct Estimate {
    /// Arithmetic mean.
    pub mean: f64,
    /// Standard deviation of a single value, by the number of values less one; 0 for one value.
    pub sd: f64,
}

impl Estimate {
    /// The estimate from these values; zeros from none.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "a few dozen values")]
    pub fn of(values: impl IntoIterator<Item = f64>) -> Self {
        let values: Vec<f64> = values.into_iter().collect();
        let count = values.len() as f64;
        if values.is_empty() {
            return Self::default();
        }
        let mean = values.iter().sum::<f64>() / count;
        let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        Self {
            mean,
            sd: (squares / (count - 1.0).max(1.0)).sqrt(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_deviation_is_that_of_a_sample() {
        let estimate = Estimate::of([1.0, 2.0, 3.0]);
        assert!((estimate.mean - 2.0).abs() < 1e-12 && (estimate.sd - 1.0).abs() < 1e-12);
        assert_eq!(Estimate::of([]), Estimate::default());
        assert!(Estimate::of([5.0]).sd.abs() < 1e-12);
    }
}
