//! The paper's statements on coverage, beside the measured values.

use super::super::grid::{Grid, INTERSECTION_M};
use super::super::matrix::ObsCell;
use super::super::paper::PAPER;
use super::super::statistics::Estimate;
use super::setup::setup;
use super::text::{list, spread, words};
use super::{Comparison, Outcome, Setting, Statement, all_of, over_densities, same};

/// By how much the ratio of the coverages at two radii may differ from that of the radii, as a share of it.
const PROPORTION_TOLERANCE: f64 = 0.2;

/// The paper's statements on coverage, beside the measured values; nothing where the streets are no grid.
#[must_use]
pub fn of_coverage(setting: Setting<'_>, cells: &[ObsCell]) -> Vec<Comparison> {
    let Some(grid) = setting.streets.grid() else {
        return Vec::new();
    };
    let people = cells.iter().map(|cell| cell.pedestrians);
    let mut lines = setup(setting, people);
    lines.extend([crossings(grid, cells), same_routes(cells)]);
    let at = |robots, people, radius_m| {
        let is = |cell: &&ObsCell| {
            (cell.robots, cell.pedestrians) == (robots, people) && same(cell.radius_m, radius_m)
        };
        cells.iter().find(is).map(|cell| cell.obs_percent.clone())
    };
    let [small_m, large_m] = PAPER.radii_m;
    let [zero, one, nine] = PAPER.robots;
    let densities = |robots, radius_m| over_densities(|people| at(robots, people, radius_m));
    lines.push(
        Statement::CoverageOfNone.judge(&"0 %", densities(zero, large_m), |all| {
            (
                list(&all),
                Outcome::of(all.iter().all(|it| it.mean.abs() < 1e-9)),
            )
        }),
    );
    let (of_one, of_nine) = (
        PAPER.coverage_of_one_percent,
        PAPER.coverage_of_nine_percent,
    );
    for (statement, robots, range) in [
        (Statement::CoverageOfOne, one, of_one),
        (Statement::CoverageOfNine, nine, of_nine),
    ] {
        lines.push(
            statement.judge(&words(range), densities(robots, large_m), |all| {
                (
                    list(&all),
                    Outcome::all(all.iter().map(|it| Outcome::within(it, range))),
                )
            }),
        );
    }
    lines.push(at_intersections(cells));
    let ratios = all_of(&PAPER.robots[1..], |robots| {
        let (small, large) = (densities(robots, small_m)?, densities(robots, large_m)?);
        let pairs = small.into_iter().zip(large);
        Some(pairs)
    });
    let wanted = small_m / large_m;
    lines.push(Statement::ProportionalDecrease.judge(
        &"proportional decrease (10 / 15 = 0.67)",
        ratios,
        |pairs| {
            let ratios = pairs
                .iter()
                .map(|(small, large)| small.mean / large.mean.max(f64::MIN_POSITIVE));
            let bounds = [1.0 - PROPORTION_TOLERANCE, 1.0 + PROPORTION_TOLERANCE];
            let fit = pairs.iter().flat_map(|(small, large)| {
                let [least, most] = bounds.map(|bound| small.less(bound * wanted, large));
                [Outcome::above(&least, 0.0), Outcome::below(&most, 0.0)]
            });
            (spread(ratios, ""), Outcome::all(fit))
        },
    ));
    let pairs = all_of(&PAPER.radii_m, |radius_m| {
        Some(
            densities(one, radius_m)?
                .into_iter()
                .zip(densities(nine, radius_m)?),
        )
    });
    lines.push(
        Statement::SeveralAreBetter.judge(&"always", pairs, |pairs| {
            let factors = pairs
                .iter()
                .map(|(one, nine)| nine.mean / one.mean.max(f64::MIN_POSITIVE));
            let more = pairs.iter().map(|(one, nine)| nine.less(1.0, one));
            let outcome = Outcome::all(more.map(|it| Outcome::above(&it, 0.0)));
            (spread(factors, "times as much"), outcome)
        }),
    );
    lines
}

/// Where people cross, by where they were.
fn crossings(grid: &Grid, cells: &[ObsCell]) -> Comparison {
    let shares = cells.iter().map(|it| it.on_road_between_percent.mean);
    let most = (!cells.is_empty()).then_some(shares.fold(0.0, f64::max));
    Statement::Crossings.judge(&"on both sides of the roads", most, |most| {
        let wide_m = grid.sidewalk_m;
        let text = format!("{wide_m} m wide, {most:.2} % of the time on a road elsewhere");
        (text, Outcome::of(wide_m > 0.0 && most.abs() < 1e-9))
    })
}

/// Whether people go the same ways whatever the number of robots.
fn same_routes(cells: &[ObsCell]) -> Comparison {
    let mut people: Vec<usize> = cells.iter().map(|it| it.pedestrians).collect();
    people.sort_unstable();
    people.dedup();
    let travels = |people: usize| {
        let of = move |it: &&ObsCell| it.pedestrians == people;
        cells.iter().filter(of).map(|it| it.travel_s.clone())
    };
    let first: Vec<Estimate> = people.iter().filter_map(|it| travels(*it).next()).collect();
    let paper = "the same routes for all numbers of robots";
    Statement::SameRoutes.judge(&paper, (!first.is_empty()).then_some(first), |first| {
        let words = first.iter().map(|it| format!("{:.1}", it.mean));
        let words = words.collect::<Vec<_>>().join(", ");
        let is_same = |(people, one): (&usize, &Estimate)| travels(*people).all(|it| it == *one);
        let all_same = people.iter().zip(&first).all(is_same);
        (format!("{words} s"), Outcome::of(all_same))
    })
}

/// Where robots see people.
fn at_intersections(cells: &[ObsCell]) -> Comparison {
    const { assert!(INTERSECTION_M == 20.0, "the rule says it") };
    let seen = cells.iter().filter(|it| it.obs_percent.mean > 0.0);
    let seen: Vec<&ObsCell> = seen.collect();
    let paper = "predominantly at intersections";
    let judged = (!seen.is_empty()).then_some(seen);
    Statement::CoverageAtIntersections.judge(&paper, judged, |seen| {
        let shares = seen.iter().map(|it| &it.covered_at_intersections_percent);
        let all = seen.iter().map(|it| it.at_intersections_percent.mean);
        let means = shares.clone().map(|it| it.mean);
        let (covered, all) = (spread(means, "%"), spread(all, "%"));
        let text = format!("{covered} (of all time {all})");
        (
            text,
            Outcome::all(shares.map(|it| Outcome::above(it, 50.0))),
        )
    })
}
