//! What the paper states of its simulation, as values in one place, and its two figures with that marked.
//!
//! Only text is quoted; bars of the paper's figures are not read off. [`statements`](super::statements) compares
//! these with a run.

use serde::Serialize;

use super::matrix::{CbrCell, ObsCell};
use super::plot::{BarChart, Series, Stated};
use super::statistics::Estimate;

/// A range that the paper states.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct StatedRange {
    /// Its lower end.
    pub least: f64,
    /// Its upper end; the lower one for a single number.
    pub most: f64,
}

/// What the paper states of its simulation (section III-B).
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct PaperSimulation {
    /// Intersections along a side of the grid.
    pub nodes_per_side: u32,
    /// Length of a road segment in metres.
    pub segment_m: f64,
    /// Vehicles.
    pub vehicles: usize,
    /// Numbers of pedestrians.
    pub pedestrians: [usize; 3],
    /// Numbers of robots.
    pub robots: [usize; 3],
    /// Sensing radii in metres.
    pub radii_m: [f64; 2],
    /// Column and row, from 1, of the intersection at which a single robot is.
    pub central_intersection: [usize; 2],
    /// Transmission power in milliwatts.
    pub power_mw: f64,
    /// Carrier frequency in gigahertz.
    pub frequency_ghz: f64,
    /// Width of the channel in megahertz.
    pub channel_mhz: u64,
    /// Coverage of one robot at the larger radius, in percent, whatever the number of pedestrians.
    pub coverage_of_one_percent: StatedRange,
    /// The same of nine robots.
    pub coverage_of_nine_percent: StatedRange,
    /// Largest reduction of the mean channel busy ratio, in percent: by nine robots at the larger radius with 100
    /// pedestrians.
    pub reduction_most_percent: StatedRange,
}

/// What the paper states.
pub const PAPER: PaperSimulation = PaperSimulation {
    nodes_per_side: 3,
    segment_m: 100.0,
    vehicles: 20,
    pedestrians: [20, 50, 100],
    robots: [0, 1, 9],
    radii_m: [10.0, 15.0],
    central_intersection: [2, 2],
    power_mw: 200.0,
    frequency_ghz: 5.9,
    channel_mhz: 10,
    coverage_of_one_percent: StatedRange {
        least: 5.0,
        most: 6.0,
    },
    coverage_of_nine_percent: StatedRange {
        least: 17.0,
        most: 18.0,
    },
    reduction_most_percent: StatedRange {
        least: 16.3,
        most: 16.3,
    },
};

/// A statement that is marked in a figure: robots, people (`None` for every number of them), range, words.
type Mark = (usize, Option<usize>, StatedRange, &'static str);

const COVERAGE: [Mark; 2] = [
    (1, None, PAPER.coverage_of_one_percent, "5 to 6 %"),
    (9, None, PAPER.coverage_of_nine_percent, "17 to 18 %"),
];
const REDUCTION: [Mark; 1] = [(9, Some(100), PAPER.reduction_most_percent, "up to 16.3 %")];

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
        &COVERAGE,
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
        &REDUCTION,
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
    stated: &[Mark],
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
    let radius_m = PAPER.radii_m[1];
    let stated = stated.iter().flat_map(|(robots, of, range, words)| {
        let is_kind =
            |kind: &(usize, f64)| kind.0 == *robots && kind.1.total_cmp(&radius_m).is_eq();
        let series = kinds.iter().position(is_kind);
        let groups = people.iter().enumerate();
        let groups = groups.filter(move |(_, people)| of.is_none_or(|of| of == **people));
        groups.filter_map(move |(group, _)| {
            Some(Stated {
                group,
                series: series?,
                range: [range.least, range.most],
                words,
            })
        })
    });
    BarChart {
        title: title.to_owned(),
        subtitle: format!("{assumptions}; means and deviations over seeds"),
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
