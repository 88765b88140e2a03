//! Every verdict can go both ways.

use super::*;
use crate::grid::{Preset, Site};
use crate::matrix::{CbrCell, ObsCell};
use crate::stationing::Stationing;
use crate::vru::Understands;

fn streets() -> Streets {
    Streets::Grid(Preset::Kerb.grid())
}

fn axes(site: Site) -> Axes {
    Axes {
        robots: PAPER.robots.to_vec(),
        radii_m: PAPER.radii_m.to_vec(),
        stationing: Stationing::at(site),
        seeds: 10,
        threads: 1,
    }
}

/// All cells of the paper, by robots, people and radius.
fn cells<C>(cell: impl Fn(usize, usize, f64) -> C) -> Vec<C> {
    let mut cells = Vec::new();
    for robots in PAPER.robots {
        for pedestrians in PAPER.pedestrians {
            cells.extend(PAPER.radii_m.map(|it| cell(robots, pedestrians, it)));
        }
    }
    cells
}

/// The outcome of a statement about these coverages, by robots, people and radius.
fn coverage(statement: Statement, percent: impl Fn(usize, usize, f64) -> Estimate) -> Outcome {
    let (grid, axes) = (streets(), axes(Site::SouthWest));
    let cells = cells(|robots, pedestrians, radius_m| ObsCell {
        robots,
        pedestrians,
        radius_m,
        obs_percent: percent(robots, pedestrians, radius_m),
        covered_at_intersections_percent: exactly(93.0),
        at_intersections_percent: exactly(47.0),
        ..ObsCell::default()
    });
    outcome_of(statement, &of_coverage(setting(&grid, &axes), &cells))
}

const fn setting<'a>(streets: &'a Streets, axes: &'a Axes) -> Setting<'a> {
    Setting {
        streets,
        is_proven: true,
        vehicles: &[20],
        axes,
        behaviour: None,
    }
}

fn outcome_of(statement: Statement, lines: &[Comparison]) -> Outcome {
    let line = lines.iter().find(|it| it.statement == statement);
    line.unwrap().outcome
}

fn exactly(mean: f64) -> Estimate {
    Estimate::of([mean, mean])
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
        CoverageAtIntersections,
        ProportionalDecrease,
        SeveralAreBetter,
    ] {
        let outcome = coverage(statement, as_stated);
        assert_eq!(outcome, Outcome::Met, "{statement:?}");
    }
    let everywhere = |mean| move |_: usize, _: usize, _: f64| exactly(mean);
    for (statement, percent) in [
        (CoverageOfNone, 1.0),
        (CoverageOfOne, 6.6),
        (CoverageOfNine, 16.4),
        // As much at 10 m as at 15 m, and with one robot as with nine.
        (ProportionalDecrease, 5.5),
        (SeveralAreBetter, 5.5),
    ] {
        let outcome = coverage(statement, everywhere(percent));
        assert_eq!(outcome, Outcome::NotMet, "{statement:?}");
    }
    // Of one run nothing is known that needs a deviation.
    let once = |robots, people, radius_m| Estimate::of([as_stated(robots, people, radius_m).mean]);
    assert_eq!(coverage(CoverageOfNine, once), Outcome::Undecided);
}

#[test]
fn where_people_cross_walk_and_are_seen_is_judged_by_where_they_were() {
    use Statement::*;
    let (grid, axes) = (streets(), axes(Site::SouthWest));
    let cell = ObsCell {
        robots: 9,
        pedestrians: 20,
        radius_m: 15.0,
        obs_percent: exactly(17.5),
        covered_at_intersections_percent: exactly(93.0),
        at_intersections_percent: exactly(47.0),
        on_road_between_percent: exactly(0.0),
        travel_s: exactly(4_010.0),
        ..ObsCell::default()
    };
    let without = ObsCell {
        robots: 0,
        obs_percent: exactly(0.0),
        covered_at_intersections_percent: exactly(0.0),
        ..cell.clone()
    };
    let all = [Crossings, SameRoutes, CoverageAtIntersections];
    let of = |cells: &[ObsCell]| {
        let lines = of_coverage(setting(&grid, &axes), cells);
        all.map(|statement| outcome_of(statement, &lines))
    };
    assert_eq!(of(&[without.clone(), cell.clone()]), [Outcome::Met; 3]);
    assert_eq!(of(&[]), [Outcome::NotMeasured; 3]);
    let wrong = ObsCell {
        covered_at_intersections_percent: exactly(49.0),
        on_road_between_percent: exactly(0.1),
        travel_s: exactly(4_011.0),
        ..cell
    };
    assert_eq!(of(&[without, wrong]), [Outcome::NotMet; 3]);
}

#[test]
fn a_set_up_that_is_not_the_papers_is_not_met() {
    use Statement::*;
    let mut axes = axes(Site::SouthWest);
    axes.stationing.patrol_mps = Some(1.0);
    let grid = Streets::Grid(crate::grid::Grid {
        nodes_per_side: 4,
        mobility: "Eclipse SUMO, as a file says".to_owned(),
        ..Preset::Kerb.grid()
    });
    let mut behaviour = Behaviour {
        v2x_share: 0.9,
        understands: Understands::ClusterVam,
        ..Behaviour::default()
    };
    behaviour.radio.ideal = true;
    behaviour.radio.power_dbm = 20.0;
    let setting = Setting {
        behaviour: Some(&behaviour),
        vehicles: &[21],
        is_proven: false,
        ..setting(&grid, &axes)
    };
    let lines = of_load(setting, &[]);
    let of = |statement| outcome_of(statement, &lines);
    let not_met = [
        Statement::Grid,
        Vehicles,
        NetworkStack,
        StaticRobots,
        Equipped,
        Power,
        Access,
    ];
    for statement in not_met {
        assert_eq!(of(statement), Outcome::NotMet, "{statement:?}");
    }
    assert_eq!(of(UnchangedDevices), Outcome::Met);
    // A file's statement about itself proves nothing.
    assert_eq!(of(Mobility), Outcome::NotMeasured);
    assert_eq!(of(ConservativeSilence), Outcome::NotMeasured);
}

#[test]
fn a_band_holds_at_every_density_and_more_seeds_decide() {
    let with_20 = |percent: Estimate| {
        move |robots, people, radius_m| match (robots, people) {
            (1, 20) => percent.clone(),
            _ => as_stated(robots, people, radius_m),
        }
    };
    // Half of the seeds are so far above the mean, half below.
    let of = |mean: f64, off: f64, seeds: i32| {
        let values = (0..seeds).map(|seed| mean + off * f64::from(2 * (seed % 2) - 1));
        coverage(Statement::CoverageOfOne, with_20(Estimate::of(values)))
    };
    assert_eq!(of(4.5, 0.0, 2), Outcome::Met);
    assert_eq!(of(4.0, 0.1, 10), Outcome::NotMet);
    // A wide deviation decides nothing, and more seeds do: it is in the range, or beside it.
    assert_eq!(of(4.7, 1.0, 10), Outcome::Undecided);
    assert_eq!(of(4.7, 1.0, 1_000), Outcome::Met);
    assert_eq!(of(4.3, 1.0, 10), Outcome::Undecided);
    assert_eq!(of(4.3, 1.0, 1_000), Outcome::NotMet);
}

/// Load, reduction, silent devices, how much of their silence is wrong, and RAM per second.
type Load = [f64; 5];

fn load(percent: impl Fn(usize, usize, f64) -> Load) -> Vec<Comparison> {
    let (grid, axes) = (streets(), axes(Site::SouthWest));
    let behaviour = Behaviour::default();
    let cells = cells(|robots, pedestrians, radius_m| {
        let [mcbr, reduction, silent, wrong, ram] = percent(robots, pedestrians, radius_m);
        CbrCell {
            robots,
            pedestrians,
            radius_m,
            mcbr: exactly(mcbr / 100.0),
            reduction_percent: exactly(reduction),
            passive_percent: exactly(silent),
            wrongly_silent_percent: exactly(silent * wrong / 100.0),
            messages_per_s: [exactly(0.0), exactly(0.0), exactly(ram)],
            ..CbrCell::default()
        }
    });
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
        let scale = |most: [f64; 3]| most[usize::from(robots > 0) + usize::from(robots > 1)];
        [
            20.0 * share,
            scale([0.0, 6.0, 16.3]) * share,
            scale([0.0, 5.0, 18.0]) * share,
            1.0,
            scale([0.0, 1.5, 16.0]) * share,
        ]
    };
    let met = load(as_stated);
    assert_eq!(met.len(), 25);
    for line in &met {
        let expected = match line.statement {
            DataRate => Outcome::Assumed,
            NetworkStack | UnchangedDevices => Outcome::NotMet,
            _ => Outcome::Met,
        };
        assert_eq!(line.outcome, expected, "{line:?}");
    }
    let high = load(|_, _, _| [30.0, 16.3, 18.0, 6.0, 16.0]);
    let missed = [
        LowLoad,
        GrowsWithDensity,
        SmallerRadius,
        DiminishingGain,
        LargerRadiusStandsForMore,
        SmallerRadiusSendsLess,
        ConservativeSilence,
    ];
    let none = load(|_, _, _| [1.0, 0.0, 0.0, 0.0, 0.0]);
    let missed = missed.map(|statement| (statement, &high));
    let without = [ConsistentReduction, LargestReduction].map(|it| (it, &none));
    for (statement, lines) in missed.into_iter().chain(without) {
        let outcome = outcome_of(statement, lines);
        assert_eq!(outcome, Outcome::NotMet, "{statement:?}");
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
    let (grid, mut axes) = (streets(), axes(Site::NorthEast));
    axes.robots = vec![9];
    axes.radii_m = vec![15.0];
    let cell = ObsCell {
        robots: 9,
        pedestrians: 20,
        radius_m: 15.0,
        obs_percent: exactly(17.5),
        ..ObsCell::default()
    };
    let lines = of_coverage(setting(&grid, &axes), &[cell]);
    let of = |statement| outcome_of(statement, &lines);
    assert_eq!(of(Statement::CoverageOfNine), Outcome::NotMeasured);
    assert_eq!(of(Statement::CentralIntersection), Outcome::NotMeasured);
    assert_eq!(of(Statement::EveryIntersection), Outcome::Met);
    assert_eq!(of(Statement::Pedestrians), Outcome::NotMet);
    assert_eq!(of(Statement::Grid), Outcome::Met);
}
