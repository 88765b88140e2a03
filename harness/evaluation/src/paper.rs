//! What the paper states in numbers of its two figures, and the figures with that marked.
//!
//! Only text is quoted; bars of the paper's figures are not read off.

use super::matrix::{CbrCell, ObsCell};
use super::plot::{BarChart, Series, Stated};
use super::statistics::Estimate;

/// Coverage at 15 m and 100 people, in percent: one robot, nine robots.
pub const COVERAGE_PERCENT: [(usize, [f64; 2], &str); 2] =
    [(1, [5.0, 6.0], "5 to 6 %"), (9, [17.0, 18.0], "17 to 18 %")];
/// Reduction of the mean channel busy ratio with nine robots at 15 m and 100 people, in percent:
/// about 16.
pub const REDUCTION_PERCENT: (usize, [f64; 2], &str) = (9, [15.5, 16.5], "about 16 %");
/// The cell that the text speaks of: people, radius.
const CELL: (usize, f64) = (100, 15.0);

/// Place of a cell in a figure: robots, people, radius.
type Key = (usize, usize, f64);

/// The figure of the observation coverage ratio, under these assumptions.
#[must_use]
pub fn coverage_figure(cells: &[ObsCell], assumptions: &str) -> BarChart {
    let bars: Vec<(Key, Estimate)> = cells
        .iter()
        .filter(|cell| cell.robots > 0)
        .map(|cell| {
            (
                (cell.robots, cell.pedestrians, cell.radius_m),
                cell.obs_percent,
            )
        })
        .collect();
    figure(
        ["Observation coverage ratio", assumptions],
        "coverage in %",
        &bars,
        &COVERAGE_PERCENT,
    )
}

/// The figure of the reduction of the mean channel busy ratio, under these assumptions.
#[must_use]
pub fn reduction_figure(cells: &[CbrCell], assumptions: &str) -> BarChart {
    let bars: Vec<(Key, Estimate)> = cells
        .iter()
        .filter(|cell| cell.robots > 0)
        .map(|cell| {
            (
                (cell.robots, cell.pedestrians, cell.radius_m),
                cell.reduction_percent,
            )
        })
        .collect();
    figure(
        ["Reduction of the mean channel busy ratio", assumptions],
        "reduction in %",
        &bars,
        &[REDUCTION_PERCENT],
    )
}

/// The figure of the mean channel busy ratio itself, also without robots, under these assumptions.
#[must_use]
pub fn load_figure(cells: &[CbrCell], assumptions: &str) -> BarChart {
    let percent = |it: Estimate| Estimate {
        mean: 100.0 * it.mean,
        sd: 100.0 * it.sd,
    };
    let bars: Vec<(Key, Estimate)> = cells
        .iter()
        .map(|cell| {
            (
                (cell.robots, cell.pedestrians, cell.radius_m),
                percent(cell.mcbr),
            )
        })
        .collect();
    figure(
        ["Mean channel busy ratio", assumptions],
        "mCBR in %",
        &bars,
        &[],
    )
}

/// Groups by the number of people, series by robots and radius.
fn figure(
    [title, assumptions]: [&str; 2],
    y_axis: &str,
    bars: &[(Key, Estimate)],
    stated: &[(usize, [f64; 2], &'static str)],
) -> BarChart {
    // Without robots there is one value, whatever the radius.
    let without = |key: &Key| if key.0 == 0 { (0, key.1, 0.0) } else { *key };
    let bars: Vec<(Key, Estimate)> = bars.iter().map(|(key, bar)| (without(key), *bar)).collect();
    let mut people: Vec<usize> = bars.iter().map(|(key, _)| key.1).collect();
    people.sort_unstable();
    people.dedup();
    let mut kinds: Vec<(usize, f64)> = bars.iter().map(|(key, _)| (key.0, key.2)).collect();
    kinds.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    kinds.dedup();
    let is = |key: &Key, kind: (usize, f64), people: usize| {
        key.0 == kind.0 && key.1 == people && key.2.total_cmp(&kind.1).is_eq()
    };
    let bar = |kind, people| {
        let found = bars.iter().find(|(key, _)| is(key, kind, people));
        found.map_or_else(Estimate::default, |(_, bar)| *bar)
    };
    let series = kinds.iter().map(|&kind| Series {
        name: series_name(kind),
        color: color(&kinds, kind),
        bars: people.iter().map(|&people| bar(kind, people)).collect(),
    });
    let stated = stated.iter().filter_map(|(robots, range, words)| {
        let is_kind = |kind: &(usize, f64)| kind.0 == *robots && kind.1.total_cmp(&CELL.1).is_eq();
        Some(Stated {
            group: people.iter().position(|it| *it == CELL.0)?,
            series: kinds.iter().position(is_kind)?,
            range: *range,
            words,
        })
    });
    BarChart {
        title: title.to_owned(),
        subtitle: format!("{assumptions}; bars are means, whiskers standard deviations over seeds"),
        x_axis: "pedestrians".to_owned(),
        y_axis: y_axis.to_owned(),
        groups: people.iter().map(ToString::to_string).collect(),
        series: series.collect(),
        stated: stated.collect(),
    }
}

fn series_name((robots, radius_m): (usize, f64)) -> String {
    match robots {
        0 => "no robot".to_owned(),
        1 => format!("1 robot, {radius_m} m"),
        _ => format!("{robots} robots, {radius_m} m"),
    }
}

/// A hue for every number of robots, darker for a larger radius. Blue and orange differ to everybody.
fn color(kinds: &[(usize, f64)], kind: (usize, f64)) -> &'static str {
    const HUES: [[&str; 3]; 4] = [
        ["#9ecae1", "#2171b5", "#08306b"],
        ["#fdae6b", "#d94801", "#7f2704"],
        ["#cbc9e2", "#756bb1", "#3f007d"],
        ["#a1d99b", "#238b45", "#00441b"],
    ];
    if kind.0 == 0 {
        return "#969696";
    }
    let mut numbers: Vec<usize> = kinds.iter().map(|it| it.0).filter(|it| *it > 0).collect();
    numbers.dedup();
    let hue = numbers.iter().position(|it| *it == kind.0).unwrap_or(0);
    let smaller = kinds.iter().filter(|it| it.0 == kind.0 && it.1 < kind.1);
    HUES[hue % HUES.len()][smaller.count() % 3]
}
