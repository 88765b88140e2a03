//! The paper's statements on channel load, beside the measured values.

use super::super::matrix::CbrCell;
use super::super::paper::PAPER;
use super::super::statistics::Estimate;
use super::setup::{on_the_air, setup};
use super::text::{list, spread, words};
use super::{Comparison, LOW_MCBR, Outcome, Setting, Statement, all_of, over_densities, same};

/// How much of the silence may be of devices that no robot perceives, in percent.
const WRONG_MAX_PERCENT: f64 = 5.0;

/// The cells of the paper with robots, at both radii: first the smaller, then the larger one.
type Pairs<'a> = Vec<[&'a CbrCell; 2]>;

/// The paper's statements on channel load, beside the measured values; nothing where the streets are no grid.
#[must_use]
pub fn of_load(setting: Setting<'_>, cells: &[CbrCell]) -> Vec<Comparison> {
    if setting.streets.grid().is_none() {
        return Vec::new();
    }
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
        over_densities(|people| Some(find(robots, people, radius_m)?.reduction_percent.clone()))
    };
    let loads = all_of(&PAPER.robots, |robots| {
        all_of(&PAPER.radii_m, |radius_m| {
            over_densities(|people| Some(find(robots, people, radius_m)?.mcbr.clone()))
        })
    });
    lines.push(
        Statement::LowLoad.judge(&"comparatively low", loads, |loads| {
            let percent = loads.iter().map(|it| 100.0 * it.mean);
            let low = loads.iter().map(|it| Outcome::below(it, LOW_MCBR));
            (spread(percent, "%"), Outcome::all(low))
        }),
    );
    let everywhere = all_of(&[one, nine], |robots| {
        all_of(&PAPER.radii_m, |radius_m| reductions(robots, radius_m))
    });
    let paper = "consistent at all densities";
    lines.push(
        Statement::ConsistentReduction.judge(&paper, everywhere, |all| {
            let there = all.iter().map(|it| Outcome::above(it, 0.0));
            (
                spread(all.iter().map(|it| it.mean), "%"),
                Outcome::all(there),
            )
        }),
    );
    let of_both = reductions(one, large_m).zip(reductions(nine, large_m));
    lines.push(by_density(of_both.clone()));
    lines.push(largest(cells, find(nine, PAPER.pedestrians[2], large_m)));
    let pairs = all_of(&[one, nine], |robots| {
        all_of(&PAPER.pedestrians, |people| {
            let small = find(robots, people, small_m)?;
            Some([[small, find(robots, people, large_m)?]])
        })
    });
    lines.extend(by_radius(pairs.as_ref()));
    lines.push(by_robots(of_both));
    lines.push(conservative(cells));
    lines
}

/// How the reductions of one robot and of nine grow with the number of people.
fn by_density(reductions: Option<(Vec<Estimate>, Vec<Estimate>)>) -> Comparison {
    let paper = "increasingly pronounced with density";
    Statement::GrowsWithDensity.judge(&paper, reductions, |(one, nine)| {
        let steps = one.windows(2).chain(nine.windows(2));
        let grows = steps.map(|pair| Outcome::above(&pair[1].less(1.0, &pair[0]), 0.0));
        let outcome = Outcome::all(grows);
        (format!("{}; {}", list(&one), list(&nine)), outcome)
    })
}

/// Whether the reduction where the paper has its largest is the largest, and as large.
fn largest(cells: &[CbrCell], there: Option<&CbrCell>) -> Comparison {
    let paper = format!("up to {}", words(PAPER.reduction_most_percent));
    Statement::LargestReduction.judge(&paper, there, |there| {
        let it = &there.reduction_percent;
        let others = cells.iter().filter(|other| *other != there);
        let more = others.map(|other| Outcome::above(&it.less(1.0, &other.reduction_percent), 0.0));
        let figure = Outcome::within(it, PAPER.reduction_most_percent);
        (
            list(std::slice::from_ref(it)),
            Outcome::all(more.chain([figure])),
        )
    })
}

/// Gain of the larger radius, and saving of the smaller one.
fn by_radius(pairs: Option<&Pairs<'_>>) -> [Comparison; 3] {
    let judge =
        |statement: Statement, paper, value: fn(&CbrCell) -> &Estimate, unit, least: f64| {
            statement.judge(paper, pairs, |pairs| {
                let of = |at: usize| spread(pairs.iter().map(|pair| value(pair[at]).mean), unit);
                let grows = pairs.iter().flat_map(|[small, large]| {
                    let (small, large) = (value(small), value(large));
                    let more = large.less(1.0, small);
                    [Outcome::above(small, least), Outcome::above(&more, 0.0)]
                });
                (format!("{}; {}", of(0), of(1)), Outcome::all(grows))
            })
        };
    [
        judge(
            Statement::SmallerRadius,
            &"less at 10 m, a clear benefit in all configurations",
            |it| &it.reduction_percent,
            "%",
            0.0,
        ),
        judge(
            Statement::LargerRadiusStandsForMore,
            &"a larger share at the larger radius",
            |it| &it.passive_percent,
            "%",
            f64::NEG_INFINITY,
        ),
        judge(
            Statement::SmallerRadiusSendsLess,
            &"less overhead at the smaller radius",
            |it| &it.messages_per_s[2],
            "",
            f64::NEG_INFINITY,
        ),
    ]
}

/// Gain of more robots.
fn by_robots(reductions: Option<(Vec<Estimate>, Vec<Estimate>)>) -> Comparison {
    let paper = "diminishing gain of each further robot";
    Statement::DiminishingGain.judge(&paper, reductions, |(one, nine)| {
        let pairs = one.iter().zip(&nine);
        let factors = pairs.clone().map(|(one, nine)| nine.mean / one.mean);
        let fit = pairs.flat_map(|(one, nine)| {
            let [once, nine_times] = [1.0, 9.0].map(|factor| nine.less(factor, one));
            [Outcome::above(&once, 0.0), Outcome::below(&nine_times, 0.0)]
        });
        (spread(factors, "times as much"), Outcome::all(fit))
    })
}

/// Whether the silence is of devices that a robot perceives (section II-D, clustering of people on foot).
fn conservative(cells: &[CbrCell]) -> Comparison {
    let silent = cells.iter().filter(|it| it.passive_percent.mean > 0.0);
    let silent: Vec<&CbrCell> = silent.collect();
    let paper = "suppression is conservative and local";
    let judged = (!silent.is_empty()).then_some(silent);
    Statement::ConservativeSilence.judge(&paper, judged, |silent| {
        let pairs = silent
            .iter()
            .map(|it| (&it.wrongly_silent_percent, &it.passive_percent));
        let shares = pairs
            .clone()
            .map(|(wrong, all)| 100.0 * wrong.mean / all.mean);
        let little = pairs
            .map(|(wrong, all)| Outcome::below(&wrong.less(WRONG_MAX_PERCENT / 100.0, all), 0.0));
        (spread(shares, "%"), Outcome::all(little))
    })
}
