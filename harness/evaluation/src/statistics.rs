//! Mean, standard deviation and confidence interval over seeds.

use serde::Serialize;

/// Estimate of a mean from a sample of runs.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
pub struct Estimate {
    /// Arithmetic mean.
    pub mean: f64,
    /// Standard deviation of a single value, by the number of values less one; 0 for one value.
    pub sd: f64,
    /// Ends of the 95 % confidence interval of the mean, by Student's t; without bounds for one value.
    pub ci95: [f64; 2],
    /// The values, seed by seed.
    pub by_seed: Vec<f64>,
}

/// 97.5 % quantile of Student's t for 1 to 10 degrees of freedom.
const T: [f64; 10] = [
    12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228,
];
/// The same of the normal distribution.
const Z: f64 = 1.959_964;

/// 97.5 % quantile of Student's t, within 0.1 %: from 11 degrees of freedom on by the expansion of Cornish and Fisher.
fn quantile(freedom: usize) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "a few dozen values")]
    let by_expansion = || {
        let of = freedom as f64;
        let cubic = (Z.powi(3) + Z) / (4.0 * of);
        let quintic = (5.0 * Z.powi(5) + 16.0 * Z.powi(3) + 3.0 * Z) / (96.0 * of * of);
        Z + cubic + quintic
    };
    match freedom {
        0 => f64::INFINITY,
        _ => T.get(freedom - 1).copied().unwrap_or_else(by_expansion),
    }
}

impl Estimate {
    /// The estimate from these values; zeros from none.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "a few dozen values")]
    pub fn of(values: impl IntoIterator<Item = f64>) -> Self {
        let by_seed: Vec<f64> = values.into_iter().collect();
        let Some(freedom) = by_seed.len().checked_sub(1) else {
            return Self::default();
        };
        let count = by_seed.len() as f64;
        let mean = by_seed.iter().sum::<f64>() / count;
        let squares: f64 = by_seed.iter().map(|value| (value - mean).powi(2)).sum();
        let sd = (squares / (count - 1.0).max(1.0)).sqrt();
        let half = match freedom {
            0 => f64::INFINITY,
            _ => quantile(freedom) * sd / count.sqrt(),
        };
        Self {
            mean,
            sd,
            ci95: [mean - half, mean + half],
            by_seed,
        }
    }

    /// This less `factor` times another of the same seeds.
    #[must_use]
    pub fn less(&self, factor: f64, other: &Self) -> Self {
        let pairs = self.by_seed.iter().zip(&other.by_seed);
        Self::of(pairs.map(|(own, other)| own - factor * other))
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

    #[test]
    fn the_interval_is_that_of_student_and_narrows_with_more_seeds() {
        // 4.303 / sqrt(3)
        let [least, most] = Estimate::of([1.0, 2.0, 3.0]).ci95;
        assert!((least - 2.0 + 2.484).abs() < 1e-3 && (most - 2.0 - 2.484).abs() < 1e-3);
        assert!(Estimate::of([5.0]).ci95.iter().all(|it| it.is_infinite()));
        // By the tables: 2.201, 2.086 and 1.984.
        for (freedom, t) in [(11, 2.201), (20, 2.086), (100, 1.984)] {
            assert!((quantile(freedom) / t - 1.0).abs() < 1e-3, "{freedom}");
        }
        let width = |count| {
            let [least, most] = Estimate::of((0..count).map(|it| f64::from(it % 2))).ci95;
            most - least
        };
        assert!(width(40) < 0.5 * width(10));
    }

    #[test]
    fn a_difference_is_taken_seed_by_seed() {
        let (a, b) = (Estimate::of([3.0, 5.0, 9.0]), Estimate::of([1.0, 2.0, 4.0]));
        assert_eq!(a.less(2.0, &b), Estimate::of([1.0, 1.0, 1.0]));
    }
}
