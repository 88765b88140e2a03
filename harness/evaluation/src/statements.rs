//! Whether a run meets what the paper states: each statement with the measured value, the paper's value and a verdict.
//!
//! A verdict is computed from the run that it is about. The paper gives a figure without its deviation, so a figure is
//! met where it is within two standard deviations of single runs around our mean, and at least within half a unit of
//! its last whole digit; our mean stands beside it. Words without a figure have a rule of ours, which stands beside
//! them as well.

use serde::Serialize;

use super::behaviour::Behaviour;
use super::grid::Grid;
use super::matrix::{Axes, CbrCell, ObsCell};
use super::messages::DATA_RATE_MBPS;
use super::paper::{PAPER, StatedRange};
use super::statistics::Estimate;
use text::{list, numbers, spread, words};

#[cfg(test)]
mod tests;
mod text;

/// Below this mean channel busy ratio it is low: no station is held back by the reactive congestion control of
/// TS 102 687 v1.2.1 (table A.1, state "relaxed").
pub const LOW_MCBR: f64 = 0.30;
/// By how much the ratio of the coverages at two radii may differ from that of the radii, as a share of it.
const PROPORTION_TOLERANCE: f64 = 0.2;
/// How far a figure may be from our mean, in standard deviations of single runs.
const DEVIATIONS: f64 = 2.0;
/// How far it may be at least, in percentage points.
const ROUNDING_PERCENT: f64 = 0.5;

/// A statement of the paper.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub enum Statement {
    /// The grid of streets.
    Grid,
    /// The number of vehicles.
    Vehicles,
    /// The numbers of pedestrians.
    Pedestrians,
    /// The sensing radii.
    Radii,
    /// Where a single robot is.
    CentralIntersection,
    /// Where nine robots are.
    EveryIntersection,
    /// The transmission power.
    Power,
    /// The carrier frequency.
    Frequency,
    /// The data rate: not the paper's, but assumed here.
    DataRate,
    /// Nobody is covered without robots.
    CoverageOfNone,
    /// The coverage of one robot at the larger radius.
    CoverageOfOne,
    /// The coverage of nine robots at the larger radius.
    CoverageOfNine,
    /// Coverage at the smaller radius is less in proportion.
    ProportionalDecrease,
    /// Several robots cover more than one.
    SeveralAreBetter,
    /// The mean channel busy ratio is comparatively low everywhere.
    LowLoad,
    /// Robots reduce it at every number of pedestrians.
    ConsistentReduction,
    /// The more pedestrians, the larger the reduction.
    GrowsWithDensity,
    /// The largest reduction.
    LargestReduction,
    /// At the smaller radius the reduction is smaller, and still there.
    SmallerRadius,
    /// Each further robot adds less than the first one.
    DiminishingGain,
}

/// What comes of a statement.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub enum Outcome {
    /// The run meets it.
    Met,
    /// It does not.
    NotMet,
    /// The run does not have what it is about.
    NotMeasured,
    /// The paper does not state it; it is assumed here.
    Assumed,
}

impl Outcome {
    /// In words.
    #[must_use]
    pub const fn words(self) -> &'static str {
        match self {
            Self::Met => "met",
            Self::NotMet => "not met",
            Self::NotMeasured => "not measured",
            Self::Assumed => "assumed",
        }
    }
}

/// A statement, what was measured, and what comes of it.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Comparison {
    /// Which statement.
    pub statement: Statement,
    /// What it is about.
    pub about: &'static str,
    /// The paper's value, in words.
    pub paper: String,
    /// The measured value, in words.
    pub measured: String,
    /// By what rule the two are compared.
    pub rule: &'static str,
    /// What comes of it.
    pub outcome: Outcome,
}

/// What a run is of.
#[derive(Clone, Copy, Debug)]
pub struct Setting<'a> {
    /// The streets.
    pub grid: &'a Grid,
    /// Vehicles.
    pub vehicles: usize,
    /// What was varied.
    pub axes: &'a Axes,
    /// How stations behave, where there are any.
    pub behaviour: Option<&'a Behaviour>,
}

/// What the paper states of coverage, beside what was measured.
#[must_use]
pub fn of_coverage(setting: Setting<'_>, cells: &[ObsCell]) -> Vec<Comparison> {
    let people = cells.iter().map(|cell| cell.pedestrians);
    let mut lines = setup(setting, people);
    let at = |robots, people, radius_m| {
        let is = |cell: &&ObsCell| {
            (cell.robots, cell.pedestrians) == (robots, people) && same(cell.radius_m, radius_m)
        };
        cells.iter().find(is).map(|cell| cell.obs_percent)
    };
    let [small_m, large_m] = PAPER.radii_m;
    let [zero, one, nine] = PAPER.robots;
    let densities = |robots, radius_m| over_densities(|people| at(robots, people, radius_m));
    lines.push(compare(
        (Statement::CoverageOfNone, "coverage without robots", "0 %"),
        densities(zero, large_m),
        |all| (list(all), all.iter().all(|it| it.mean.abs() < 1e-9)),
        "exactly",
    ));
    for (statement, about, robots, range) in [
        (
            Statement::CoverageOfOne,
            "coverage, 1 robot, 15 m, all densities",
            one,
            PAPER.coverage_of_one_percent,
        ),
        (
            Statement::CoverageOfNine,
            "coverage, 9 robots, 15 m, all densities",
            nine,
            PAPER.coverage_of_nine_percent,
        ),
    ] {
        lines.push(compare(
            (statement, about, &words(range)),
            densities(robots, large_m),
            |all| (list(all), all.iter().all(|it| is_of(*it, range))),
            FIGURE_RULE,
        ));
    }
    lines.push(proportional(&densities, small_m, large_m));
    let all: Option<Vec<(Estimate, Estimate)>> =
        PAPER
            .radii_m
            .into_iter()
            .try_fold(Vec::new(), |mut pairs, radius_m| {
                pairs.extend(
                    densities(one, radius_m)?
                        .into_iter()
                        .zip(densities(nine, radius_m)?),
                );
                Some(pairs)
            });
    lines.push(compare(
        (
            Statement::SeveralAreBetter,
            "several robots cover more than one",
            "always",
        ),
        all,
        |pairs| {
            let factors = pairs
                .iter()
                .map(|(one, nine)| nine.mean / one.mean.max(f64::MIN_POSITIVE));
            (
                spread(factors, "times as much"),
                pairs.iter().all(|(one, nine)| nine.mean > one.mean),
            )
        },
        "9 robots above 1 robot in every cell",
    ));
    lines
}

fn proportional(
    densities: &impl Fn(usize, f64) -> Option<Vec<Estimate>>,
    small_m: f64,
    large_m: f64,
) -> Comparison {
    let ratios = PAPER.robots[1..]
        .iter()
        .try_fold(Vec::new(), |mut ratios, &robots| {
            let (small, large) = (densities(robots, small_m)?, densities(robots, large_m)?);
            let pairs = small.into_iter().zip(large);
            ratios
                .extend(pairs.map(|(small, large)| small.mean / large.mean.max(f64::MIN_POSITIVE)));
            Some(ratios)
        });
    let wanted = small_m / large_m;
    compare(
        (
            Statement::ProportionalDecrease,
            "coverage at 10 m by that at 15 m, all cells",
            "proportional decrease (10 / 15 = 0.67)",
        ),
        ratios,
        |ratios| {
            let fits = |ratio: &f64| (ratio / wanted - 1.0).abs() <= PROPORTION_TOLERANCE;
            (spread(ratios.iter().copied(), ""), ratios.iter().all(fits))
        },
        "every ratio within a fifth of that of the radii",
    )
}

/// What the paper states of channel load, beside what was measured.
#[must_use]
pub fn of_load(setting: Setting<'_>, cells: &[CbrCell]) -> Vec<Comparison> {
    let people = cells.iter().map(|cell| cell.pedestrians);
    let mut lines = setup(setting, people);
    lines.extend(setting.behaviour.into_iter().flat_map(on_the_air));
    let [small_m, large_m] = PAPER.radii_m;
    let [_, one, nine] = PAPER.robots;
    let find = |robots, people, radius_m| {
        let is = |cell: &&CbrCell| {
            (cell.robots, cell.pedestrians) == (robots, people) && same(cell.radius_m, radius_m)
        };
        cells.iter().find(is)
    };
    let reductions = |robots, radius_m| {
        over_densities(|people| Some(find(robots, people, radius_m)?.reduction_percent))
    };
    let loads = PAPER
        .robots
        .into_iter()
        .try_fold(Vec::new(), |mut loads, robots| {
            for radius_m in PAPER.radii_m {
                loads.extend(over_densities(|people| {
                    find(robots, people, radius_m).map(|it| it.mcbr)
                })?);
            }
            Some(loads)
        });
    lines.push(compare(
        (
            Statement::LowLoad,
            "mean channel busy ratio, all cells",
            "comparatively low",
        ),
        loads,
        |loads| {
            let percent = loads.iter().map(|it| 100.0 * it.mean);
            (
                spread(percent, "%"),
                loads.iter().all(|it| it.mean < LOW_MCBR),
            )
        },
        "below 30 %, where congestion control (TS 102 687) holds nobody back",
    ));
    let everywhere = [one, nine]
        .into_iter()
        .try_fold(Vec::new(), |mut all, robots| {
            for radius_m in PAPER.radii_m {
                all.extend(reductions(robots, radius_m)?);
            }
            Some(all)
        });
    lines.push(compare(
        (
            Statement::ConsistentReduction,
            "reduction by robots, all cells",
            "consistent at all densities",
        ),
        everywhere,
        |all| {
            (
                spread(all.iter().map(|it| it.mean), "%"),
                all.iter().all(|it| it.mean > 0.0),
            )
        },
        "above 0 in every cell",
    ));
    lines.push(compare(
        (
            Statement::GrowsWithDensity,
            "reduction by 9 robots at 15 m with 20, 50, 100",
            "increasingly pronounced with density",
        ),
        reductions(nine, large_m),
        |all| (list(all), all.is_sorted_by(|a, b| a.mean < b.mean)),
        "each above the one before",
    ));
    let largest = find(nine, PAPER.pedestrians[2], large_m).map(|it| it.reduction_percent);
    let most = cells
        .iter()
        .map(|it| it.reduction_percent.mean)
        .fold(f64::MIN, f64::max);
    lines.push(compare(
        (
            Statement::LargestReduction,
            "largest reduction: 9 robots, 100 pedestrians, 15 m",
            &format!("up to {}", words(PAPER.reduction_most_percent)),
        ),
        largest,
        |it| {
            let is_largest = most <= it.mean;
            (
                list(&[*it]),
                is_largest && is_of(*it, PAPER.reduction_most_percent),
            )
        },
        "the largest of all cells, and the figure within two standard deviations of a run",
    ));
    lines.extend(by_radius_and_robots(&reductions, small_m, large_m));
    lines
}

fn by_radius_and_robots(
    reductions: &impl Fn(usize, f64) -> Option<Vec<Estimate>>,
    small_m: f64,
    large_m: f64,
) -> [Comparison; 2] {
    let [_, one, nine] = PAPER.robots;
    let by_radius = reductions(nine, small_m).zip(reductions(nine, large_m));
    let by_robots = reductions(one, large_m).zip(reductions(nine, large_m));
    let pairs = |of: Option<(Vec<Estimate>, Vec<Estimate>)>| -> Option<Vec<(Estimate, Estimate)>> {
        of.map(|(a, b)| a.into_iter().zip(b).collect())
    };
    [
        compare(
            (
                Statement::SmallerRadius,
                "reduction by 9 robots at 10 m with 20, 50, 100",
                "less than at 15 m, a clear benefit",
            ),
            pairs(by_radius),
            |pairs| {
                let small: Vec<Estimate> = pairs.iter().map(|(small, _)| *small).collect();
                let fits = |(small, large): &(Estimate, Estimate)| {
                    small.mean > 0.0 && small.mean < large.mean
                };
                (list(&small), pairs.iter().all(fits))
            },
            "above 0 and below that at 15 m",
        ),
        compare(
            (
                Statement::DiminishingGain,
                "reduction of 9 robots by that of 1, 15 m",
                "diminishing gain of each further robot",
            ),
            pairs(by_robots),
            |pairs| {
                let factors = || pairs.iter().map(|(one, nine)| nine.mean / one.mean);
                let fits = |factor: f64| factor > 1.0 && factor < 9.0;
                (spread(factors(), "times as much"), factors().all(fits))
            },
            "more than once and less than nine times that of one robot",
        ),
    ]
}

/// What the paper states of the streets and who is on them.
fn setup(setting: Setting<'_>, people: impl Iterator<Item = usize>) -> Vec<Comparison> {
    let Setting {
        grid,
        vehicles,
        axes,
        ..
    } = setting;
    let side = grid.nodes_per_side;
    let mut people: Vec<usize> = people.collect();
    people.sort_unstable();
    people.dedup();
    let has_people = |it: &usize| people.contains(it);
    let has_radius = |it: &f64| axes.radii_m.iter().any(|radius_m| same(*radius_m, *it));
    let of = |statement, about, paper: String, measured: String, is_met| Comparison {
        statement,
        about,
        paper,
        measured,
        rule: "the same",
        outcome: outcome(is_met),
    };
    let one = intersections(setting, 1);
    let nine = intersections(setting, 9);
    let has = |robots: usize| axes.robots.contains(&robots);
    let mut distinct = nine.clone();
    distinct.sort_unstable();
    distinct.dedup();
    let mut lines = vec![
        of(
            Statement::Grid,
            "grid of streets",
            format!("{0} x {0}, {1} m", PAPER.nodes_per_side, PAPER.segment_m),
            format!("{side} x {side}, {} m", grid.segment_m),
            side == PAPER.nodes_per_side && same(grid.segment_m, PAPER.segment_m),
        ),
        of(
            Statement::Vehicles,
            "vehicles",
            PAPER.vehicles.to_string(),
            vehicles.to_string(),
            vehicles == PAPER.vehicles,
        ),
        of(
            Statement::Pedestrians,
            "pedestrians",
            numbers(&PAPER.pedestrians),
            numbers(&people),
            PAPER.pedestrians.iter().all(has_people),
        ),
        of(
            Statement::Radii,
            "sensing radii in m",
            numbers(&PAPER.radii_m),
            numbers(&axes.radii_m),
            PAPER.radii_m.iter().all(has_radius),
        ),
    ];
    let [column, row] = PAPER.central_intersection;
    lines.push(compare(
        (
            Statement::CentralIntersection,
            "intersection of a single robot",
            &format!("({column}, {row}), central"),
        ),
        one.first().filter(|_| has(1)),
        |[column, row]| {
            (
                format!("({column}, {row})"),
                [*column, *row] == PAPER.central_intersection,
            )
        },
        "the same, counted from 1",
    ));
    lines.push(compare(
        (
            Statement::EveryIntersection,
            "intersections of 9 robots",
            "one at each of the 9",
        ),
        (has(9) && !nine.is_empty()).then_some(distinct.len()),
        |distinct| (format!("{distinct} different ones"), *distinct == 9),
        "the same",
    ));
    lines
}

/// Column and row, from 1, of the intersection that each of these robots is nearest to at the beginning; none if
/// there is no room for as many.
fn intersections(setting: Setting<'_>, robots: usize) -> Vec<[usize; 2]> {
    let Setting { grid, axes, .. } = setting;
    if axes.stationing.check(grid, robots).is_err() {
        return Vec::new();
    }
    let robots = axes.stationing.robots(grid, robots, 0, 100);
    let nearest = |metres: f64| {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a few intersections"
        )]
        let number = (metres / grid.segment_m).round().max(0.0) as usize;
        number + 1
    };
    robots
        .iter()
        .map(|robot| robot.place_at(0).map(nearest))
        .collect()
}

fn on_the_air(behaviour: &Behaviour) -> [Comparison; 3] {
    let radio = &behaviour.radio;
    let power_mw = 10_f64.powf(radio.power_dbm / 10.0);
    // Free space: the wavelength is that whose first metre loses this much.
    let frequency_ghz =
        0.299_792_458 / (4.0 * std::f64::consts::PI) * 10_f64.powf(radio.loss_at_1_m_db / 20.0);
    let is_near = |value: f64, stated: f64| (value / stated - 1.0).abs() < 0.01;
    let of = |statement, about, paper: String, measured: String, rule, outcome| Comparison {
        statement,
        about,
        paper,
        measured,
        rule,
        outcome,
    };
    [
        of(
            Statement::Power,
            "transmission power",
            format!("{} mW", PAPER.power_mw),
            format!("{power_mw:.1} mW"),
            "within 1 %",
            outcome(is_near(power_mw, PAPER.power_mw)),
        ),
        of(
            Statement::Frequency,
            "carrier frequency, by the path loss at 1 m",
            format!("{} GHz", PAPER.frequency_ghz),
            format!("{frequency_ghz:.2} GHz"),
            "within 1 %",
            outcome(is_near(frequency_ghz, PAPER.frequency_ghz)),
        ),
        of(
            Statement::DataRate,
            "data rate",
            "not stated".to_owned(),
            format!("{DATA_RATE_MBPS} Mbit/s"),
            "the default of the 10 MHz channel",
            Outcome::Assumed,
        ),
    ]
}

const FIGURE_RULE: &str = "the range within two standard deviations of a run, at every density";

/// Whether our mean agrees with what the paper states.
fn is_of(measured: Estimate, range: StatedRange) -> bool {
    let tolerance = (DEVIATIONS * measured.sd).max(ROUNDING_PERCENT);
    measured.mean + tolerance >= range.least && measured.mean - tolerance <= range.most
}

/// A comparison by what was measured, if it was.
fn compare<T>(
    (statement, about, paper): (Statement, &'static str, &str),
    measured: Option<T>,
    judge: impl Fn(&T) -> (String, bool),
    rule: &'static str,
) -> Comparison {
    let (measured, outcome) = match measured.map(|measured| judge(&measured)) {
        Some((words, is_met)) => (words, outcome(is_met)),
        None => ("-".to_owned(), Outcome::NotMeasured),
    };
    Comparison {
        statement,
        about,
        paper: paper.to_owned(),
        measured,
        rule,
        outcome,
    }
}

const fn outcome(is_met: bool) -> Outcome {
    if is_met {
        Outcome::Met
    } else {
        Outcome::NotMet
    }
}

/// An estimate for each of the paper's densities, if there is one for all.
fn over_densities(at: impl Fn(usize) -> Option<Estimate>) -> Option<Vec<Estimate>> {
    PAPER.pedestrians.into_iter().map(at).collect()
}

fn same(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-9
}
