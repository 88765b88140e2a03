//! What the paper states of channel load, beside what was measured.

use super::super::matrix::CbrCell;
use super::super::paper::PAPER;
use super::super::statistics::Estimate;
use super::setup::{on_the_air, setup};
use super::text::{list, spread, words};
use super::{Comparison, LOW_MCBR, Setting, Statement, compare, is_of, over_densities, same};

/// How much of the silence may be of devices that no robot perceives, in percent.
const WRONG_MAX_PERCENT: f64 = 5.0;

/// The cells of the paper with robots, at both radii: first the smaller, then the larger one.
type Pairs<'a> = Vec<[&'a CbrCell; 2]>;

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
    lines.push(by_density(
        reductions(one, large_m).zip(reductions(nine, large_m)),
    ));
    lines.push(largest(
        cells,
        find(nine, PAPER.pedestrians[2], large_m).map(|it| it.reduction_percent),
    ));
    let of_robots = |robots| {
        let pair = |people| {
            Some([
                find(robots, people, small_m)?,
                find(robots, people, large_m)?,
            ])
        };
        PAPER
            .pedestrians
            .into_iter()
            .map(pair)
            .collect::<Option<Pairs<'_>>>()
    };
    let pairs = of_robots(one)
        .zip(of_robots(nine))
        .map(|(one, nine)| [one, nine].concat());
    lines.extend(by_radius(pairs.as_ref()));
    lines.push(by_robots(
        reductions(one, large_m).zip(reductions(nine, large_m)),
    ));
    lines.push(conservative(cells));
    lines
}

/// How the reductions of one robot and of nine grow with the number of people.
fn by_density(reductions: Option<(Vec<Estimate>, Vec<Estimate>)>) -> Comparison {
    compare(
        (
            Statement::GrowsWithDensity,
            "reduction at 15 m with 20, 50, 100, by 1 and by 9 robots",
            "increasingly pronounced with density",
        ),
        reductions,
        |(one, nine)| {
            let grows = |all: &[Estimate]| all.is_sorted_by(|a, b| a.mean < b.mean);
            (
                format!("{}; {}", list(one), list(nine)),
                grows(one) && grows(nine),
            )
        },
        "each above the one before",
    )
}

/// Whether the reduction where the paper has its largest is the largest, and as large.
fn largest(cells: &[CbrCell], there: Option<Estimate>) -> Comparison {
    let means = cells.iter().map(|it| it.reduction_percent.mean);
    let most = means.fold(f64::MIN, f64::max);
    compare(
        (
            Statement::LargestReduction,
            "largest reduction: 9 robots, 100 pedestrians, 15 m",
            &format!("up to {}", words(PAPER.reduction_most_percent)),
        ),
        there,
        |it| {
            let is_largest = most <= it.mean;
            (
                list(&[*it]),
                is_largest && is_of(*it, PAPER.reduction_most_percent),
            )
        },
        "the largest of all cells, and the figure within two standard deviations of a run",
    )
}

/// What the larger radius brings, and the smaller one saves.
fn by_radius(pairs: Option<&Pairs<'_>>) -> [Comparison; 3] {
    let of = |pairs: &Pairs<'_>, at: usize, value: fn(&CbrCell) -> f64, unit: &str| {
        spread(pairs.iter().map(|pair| value(pair[at])), unit)
    };
    let reduction: fn(&CbrCell) -> f64 = |it| it.reduction_percent.mean;
    let silent: fn(&CbrCell) -> f64 = |it| it.passive_percent.mean;
    let ram_rate: fn(&CbrCell) -> f64 = |it| it.messages_per_s[2].mean;
    [
        compare(
            (
                Statement::SmallerRadius,
                "reduction at 10 m and at 15 m, all cells",
                "less at 10 m, a clear benefit in all configurations",
            ),
            pairs,
            |pairs| {
                let [small, large] = [0, 1].map(|at| of(pairs, at, reduction, "%"));
                let fits = |[small, large]: &[&CbrCell; 2]| {
                    reduction(small) > 0.0 && reduction(small) < reduction(large)
                };
                (format!("{small}; {large}"), pairs.iter().all(fits))
            },
            "at 10 m above 0 and below that at 15 m, in every cell",
        ),
        compare(
            (
                Statement::LargerRadiusStandsForMore,
                "silent devices at 10 m and at 15 m, all cells",
                "a larger share at the larger radius",
            ),
            pairs,
            |pairs| {
                let [small, large] = [0, 1].map(|at| of(pairs, at, silent, "%"));
                let fits = |[small, large]: &[&CbrCell; 2]| silent(small) < silent(large);
                (format!("{small}; {large}"), pairs.iter().all(fits))
            },
            "more at 15 m, in every cell",
        ),
        compare(
            (
                Statement::SmallerRadiusSendsLess,
                "RAM per second at 10 m and at 15 m, all cells",
                "less overhead at the smaller radius",
            ),
            pairs,
            |pairs| {
                let [small, large] = [0, 1].map(|at| of(pairs, at, ram_rate, ""));
                let fits = |[small, large]: &[&CbrCell; 2]| ram_rate(small) < ram_rate(large);
                (format!("{small}; {large}"), pairs.iter().all(fits))
            },
            "fewer at 10 m, in every cell",
        ),
    ]
}

/// What more robots bring.
fn by_robots(reductions: Option<(Vec<Estimate>, Vec<Estimate>)>) -> Comparison {
    compare(
        (
            Statement::DiminishingGain,
            "reduction of 9 robots by that of 1, 15 m",
            "diminishing gain of each further robot",
        ),
        reductions,
        |(one, nine)| {
            let pairs = one.iter().zip(nine);
            let factors: Vec<f64> = pairs.map(|(one, nine)| nine.mean / one.mean).collect();
            let fits = |factor: &f64| *factor > 1.0 && *factor < 9.0;
            (
                spread(factors.iter().copied(), "times as much"),
                factors.iter().all(fits),
            )
        },
        "more than once and less than nine times that of one robot",
    )
}

/// Whether the silence is of devices that a robot perceives (section II-D, clustering of people on foot).
fn conservative(cells: &[CbrCell]) -> Comparison {
    let silent = cells.iter().filter(|it| it.passive_percent.mean > 0.0);
    let shares: Vec<f64> = silent
        .map(|it| 100.0 * it.wrongly_silent_percent.mean / it.passive_percent.mean)
        .collect();
    compare(
        (
            Statement::ConservativeSilence,
            "share of the silence of devices that no robot perceives",
            "suppression is conservative and local",
        ),
        (!shares.is_empty()).then_some(shares),
        |shares| {
            (
                spread(shares.iter().copied(), "%"),
                shares.iter().all(|it| *it <= WRONG_MAX_PERCENT),
            )
        },
        "at most 5 %, in every cell",
    )
}
