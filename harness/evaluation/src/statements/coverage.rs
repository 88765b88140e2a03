//! What the paper states of coverage, beside what was measured.

use super::super::grid::INTERSECTION_M;
use super::super::matrix::ObsCell;
use super::super::paper::PAPER;
use super::super::statistics::Estimate;
use super::setup::setup;
use super::text::{list, spread, words};
use super::{Comparison, FIGURE_RULE, Setting, Statement, compare, is_of, over_densities, same};

/// By how much the ratio of the coverages at two radii may differ from that of the radii, as a share of it.
const PROPORTION_TOLERANCE: f64 = 0.2;

/// What the paper states of coverage, beside what was measured.
#[must_use]
pub fn of_coverage(setting: Setting<'_>, cells: &[ObsCell]) -> Vec<Comparison> {
    let people = cells.iter().map(|cell| cell.pedestrians);
    let mut lines = setup(setting, people);
    lines.extend([crossings(setting, cells), same_routes(cells)]);
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
    lines.push(at_intersections(cells));
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

/// Where people cross, by where they were.
fn crossings(setting: Setting<'_>, cells: &[ObsCell]) -> Comparison {
    let shares = cells.iter().map(|it| it.on_road_between_percent.mean);
    let most = shares.fold(0.0, f64::max);
    compare(
        (
            Statement::Crossings,
            "sidewalks, and crossings near intersections only",
            "on both sides of the roads",
        ),
        (!cells.is_empty()).then_some(most),
        |most| {
            let wide_m = setting.grid.sidewalk_m;
            let text = format!("{wide_m} m wide, {most:.2} % of the time on a road elsewhere");
            (text, wide_m > 0.0 && most.abs() < 1e-9)
        },
        "nobody is on a road farther than 20 m from an intersection",
    )
}

/// Whether people go the same ways whatever the number of robots.
fn same_routes(cells: &[ObsCell]) -> Comparison {
    let mut people: Vec<usize> = cells.iter().map(|it| it.pedestrians).collect();
    people.sort_unstable();
    people.dedup();
    let travels = |people: usize| {
        let of = move |it: &&ObsCell| it.pedestrians == people;
        cells.iter().filter(of).map(|it| it.travel_s)
    };
    let first: Vec<Estimate> = people.iter().filter_map(|it| travels(*it).next()).collect();
    compare(
        (
            Statement::SameRoutes,
            "time that all people travel together, by density",
            "the same routes for all numbers of robots",
        ),
        (!first.is_empty()).then_some(first),
        |first| {
            let words = first.iter().map(|it| format!("{:.1}", it.mean));
            let is_same = |(people, one): (&usize, &Estimate)| {
                travels(*people).all(|it| same(it.mean, one.mean) && same(it.sd, one.sd))
            };
            (
                format!("{} s", words.collect::<Vec<_>>().join(", ")),
                people.iter().zip(first).all(is_same),
            )
        },
        "the same in every cell of a density",
    )
}

/// Where robots see people.
fn at_intersections(cells: &[ObsCell]) -> Comparison {
    const { assert!(INTERSECTION_M == 20.0, "the rule says it") };
    let seen: Vec<&ObsCell> = cells
        .iter()
        .filter(|it| it.obs_percent.mean > 0.0)
        .collect();
    compare(
        (
            Statement::CoverageAtIntersections,
            "share of the covered time at intersections, all cells",
            "predominantly at intersections",
        ),
        (!seen.is_empty()).then_some(seen),
        |seen| {
            let shares = || {
                seen.iter()
                    .map(|it| it.covered_at_intersections_percent.mean)
            };
            let all = seen.iter().map(|it| it.at_intersections_percent.mean);
            let text = format!(
                "{} (of all time {})",
                spread(shares(), "%"),
                spread(all, "%")
            );
            (text, shares().all(|it| it > 50.0))
        },
        "more than half of it within 20 m of an intersection's middle",
    )
}
