//! Measured values and those of the paper in words.

use super::super::paper::StatedRange;
use super::super::statistics::Estimate;
use super::same;

pub(super) fn words(range: StatedRange) -> String {
    if same(range.least, range.most) {
        format!("{} %", range.least)
    } else {
        format!("{} to {} %", range.least, range.most)
    }
}

pub(super) fn list(all: &[Estimate]) -> String {
    let all = all.iter().map(|it| {
        let [least, most] = it.ci95;
        format!("{:.1} ({least:.1} to {most:.1})", it.mean)
    });
    format!("{} %", all.collect::<Vec<_>>().join(", "))
}

pub(super) fn numbers<T: ToString>(all: &[T]) -> String {
    let all = all.iter().map(ToString::to_string);
    all.collect::<Vec<_>>().join(", ")
}

/// From the least to the most of these.
pub(super) fn spread(all: impl Iterator<Item = f64>, unit: &str) -> String {
    let (least, most) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), it| {
        (least.min(it), most.max(it))
    });
    format!("{least:.2} to {most:.2} {unit}")
        .trim_end()
        .to_owned()
}
