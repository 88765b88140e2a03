//! Every verdict can go both ways.

use super::*;
use crate::grid::{Preset, Site};
use crate::stationing::Stationing;

fn axes(site: Site) -> Axes {
    Axes {
        robots: PAPER.robots.to_vec(),
        radii_m: PAPER.radii_m.to_vec(),
        stationing: Stationing::at(site),
        seeds: 10,
        threads: 1,
    }
}

/// The outcome of a statement about these coverages, by robots, people and radius.
fn coverage(statement: Statement, percent: impl Fn(usize, usize, f64) -> Estimate) -> Outcome {
    let (grid, axes) = (Preset::Kerb.grid(), axes(Site::SouthWest));
    let mut cells = Vec::new();
    for robots in PAPER.robots {
        for pedestrians in PAPER.pedestrians {
            cells.extend(PAPER.radii_m.map(|radius_m| ObsCell {
                robots,
                pedestrians,
                radius_m,
                obs_percent: percent(robots, pedestrians, radius_m),
            }));
        }
    }
    outcome_of(statement, &of_coverage(setting(&grid, &axes), &cells))
}

const fn setting<'a>(grid: &'a Grid, axes: &'a Axes) -> Setting<'a> {
    Setting {
        grid,
        vehicles: 20,
        axes,
        behaviour: None,
    }
}

fn outcome_of(statement: Statement, lines: &[Comparison]) -> Outcome {
    let line = lines.iter().find(|it| it.statement == statement);
    line.unwrap().outcome
}

fn exactly(mean: f64) -> Estimate {
    Estimate { mean, sd: 0.0 }
}

/// As the paper has it.
fn as_stated(robots: usize, _: usize, radius_m: f64) -> Estimate {
    exactly(radius_m / 15.0 * [0.0, 5.5, 17.5][usize::from(robots > 0) + usize::from(robots > 1)])
}

#[test]
fn every_statement_on_coverage_can_be_met_and_missed() {
    use Statement::*;
    for statement in [
        CoverageOfNone,
        CoverageOfOne,
        CoverageOfNine,
        ProportionalDecrease,
        SeveralAreBetter,
    ] {
        assert_eq!(
            coverage(statement, as_stated),
            Outcome::Met,
            "{statement:?}"
        );
    }
    let everywhere = |mean| move |_: usize, _: usize, _: f64| exactly(mean);
    assert_eq!(coverage(CoverageOfNone, everywhere(1.0)), Outcome::NotMet);
    assert_eq!(coverage(CoverageOfOne, everywhere(6.6)), Outcome::NotMet);
    assert_eq!(coverage(CoverageOfNine, everywhere(16.4)), Outcome::NotMet);
    // As much at 10 m as at 15 m, and with one robot as with nine.
    assert_eq!(
        coverage(ProportionalDecrease, everywhere(5.5)),
        Outcome::NotMet
    );
    assert_eq!(coverage(SeveralAreBetter, everywhere(5.5)), Outcome::NotMet);
}

#[test]
fn a_band_holds_at_every_density_and_a_wide_deviation_is_allowed_for() {
    let with_20 = |percent: Estimate| {
        move |robots, people, radius_m| match (robots, people) {
            (1, 20) => percent,
            _ => as_stated(robots, people, radius_m),
        }
    };
    let of = |mean, sd| coverage(Statement::CoverageOfOne, with_20(Estimate { mean, sd }));
    assert_eq!(of(4.0, 0.1), Outcome::NotMet);
    assert_eq!(of(4.0, 0.6), Outcome::Met);
    assert_eq!(of(4.5, 0.0), Outcome::Met);
}

fn load(percent: impl Fn(usize, usize, f64) -> [f64; 2]) -> Vec<Comparison> {
    let (grid, axes) = (Preset::Kerb.grid(), axes(Site::SouthWest));
    let behaviour = Behaviour::default();
    let mut cells = Vec::new();
    for robots in PAPER.robots {
        for pedestrians in PAPER.pedestrians {
            cells.extend(PAPER.radii_m.map(|radius_m| {
                let [mcbr, reduction] = percent(robots, pedestrians, radius_m);
                CbrCell {
                    robots,
                    pedestrians,
                    radius_m,
                    mcbr: exactly(mcbr / 100.0),
                    reduction_percent: exactly(reduction),
                    ..CbrCell::default()
                }
            }));
        }
    }
    let setting = Setting {
        behaviour: Some(&behaviour),
        ..setting(&grid, &axes)
    };
    of_load(setting, &cells)
}

#[test]
#[expect(clippy::cast_precision_loss, reason = "a hundred")]
fn every_statement_on_channel_load_can_be_met_and_missed() {
    use Statement::*;
    let as_stated = |robots: usize, people: usize, radius_m: f64| {
        let share = people as f64 / 100.0 * radius_m / 15.0;
        [
            20.0 * share,
            [0.0, 6.0, 16.3][usize::from(robots > 0) + usize::from(robots > 1)] * share,
        ]
    };
    let met = load(as_stated);
    assert_eq!(met.len(), 15);
    for line in &met {
        let expected = match line.statement {
            DataRate => Outcome::Assumed,
            _ => Outcome::Met,
        };
        assert_eq!(line.outcome, expected, "{line:?}");
    }
    let high = load(|_, _, _| [30.0, 16.3]);
    let missed = [LowLoad, GrowsWithDensity, SmallerRadius, DiminishingGain];
    for statement in missed {
        assert_eq!(
            outcome_of(statement, &high),
            Outcome::NotMet,
            "{statement:?}"
        );
    }
    let none = load(|_, _, _| [1.0, 0.0]);
    for statement in [ConsistentReduction, LargestReduction] {
        assert_eq!(
            outcome_of(statement, &none),
            Outcome::NotMet,
            "{statement:?}"
        );
    }
    let [too_little, too_much] = [0.9, 1.1].map(|factor| {
        load(move |robots, people, radius_m| {
            as_stated(robots, people, radius_m).map(|it| it * factor)
        })
    });
    for lines in [too_little, too_much] {
        assert_eq!(outcome_of(LargestReduction, &lines), Outcome::NotMet);
    }
}

#[test]
fn a_run_of_other_cells_says_what_it_does_not_measure() {
    let (grid, mut axes) = (Preset::Kerb.grid(), axes(Site::NorthEast));
    axes.robots = vec![9];
    axes.radii_m = vec![15.0];
    let cell = ObsCell {
        robots: 9,
        pedestrians: 20,
        radius_m: 15.0,
        obs_percent: exactly(17.5),
    };
    let lines = of_coverage(setting(&grid, &axes), &[cell]);
    let of = |statement| outcome_of(statement, &lines);
    assert_eq!(of(Statement::CoverageOfNine), Outcome::NotMeasured);
    assert_eq!(of(Statement::CentralIntersection), Outcome::NotMeasured);
    assert_eq!(of(Statement::EveryIntersection), Outcome::Met);
    assert_eq!(of(Statement::Pedestrians), Outcome::NotMet);
    assert_eq!(of(Statement::Grid), Outcome::Met);
}
