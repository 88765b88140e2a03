//! The paper's statements on the set-up: streets, people, robots and the channel.

use super::super::behaviour::Behaviour;
use super::super::messages::SYMBOL_US;
use super::super::paper::PAPER;
use super::super::schedule::Schedule;
use super::super::vru::Understands;
use super::text::numbers;
use super::{Comparison, Outcome, Setting, Statement, same};

/// Samples of a symbol of IEEE 802.11 (clause 17), its guard interval included; their rate is the channel's width.
const SAMPLES_PER_SYMBOL: u64 = 80;

/// The paper's statements on the streets, and on vehicles, people and robots there.
pub(super) fn setup(setting: Setting<'_>, people: impl Iterator<Item = usize>) -> Vec<Comparison> {
    let Setting {
        streets,
        is_proven,
        vehicles,
        axes,
        ..
    } = setting;
    let Some(grid) = streets.grid() else {
        return Vec::new();
    };
    let side = grid.nodes_per_side;
    let mut people: Vec<usize> = people.collect();
    people.sort_unstable();
    people.dedup();
    let has_people = |it: &usize| people.contains(it);
    let has_radius = |it: &f64| axes.radii_m.iter().any(|radius_m| same(*radius_m, *it));
    let one = intersections(setting, 1);
    let nine = intersections(setting, 9);
    let has = |robots: usize| axes.robots.contains(&robots);
    let mut distinct = nine.clone();
    distinct.sort_unstable();
    distinct.dedup();
    let place = |[column, row]: [usize; 2]| format!("({column}, {row})");
    let central = place(PAPER.central_intersection);
    let stationing = &axes.stationing;
    let by_file = stationing.robots_at.iter().flatten();
    let robots = match stationing.patrol_mps {
        Some(speed) => format!("walk at {speed} m/s"),
        None if by_file.clone().any(Schedule::moves) => "move by a file".to_owned(),
        None => "stand".to_owned(),
    };
    vec![
        Statement::Grid.compare(
            &format_args!("{0} x {0}, {1} m", PAPER.nodes_per_side, PAPER.segment_m),
            &format_args!("{side} x {side}, {} m", grid.segment_m),
            side == PAPER.nodes_per_side && same(grid.segment_m, PAPER.segment_m),
        ),
        Statement::Mobility.judge(&"SUMO", is_proven.then_some(()), |()| {
            (grid.mobility.clone(), Outcome::Met)
        }),
        Statement::Vehicles.compare(
            &PAPER.vehicles,
            &numbers(vehicles),
            vehicles == [PAPER.vehicles],
        ),
        Statement::Pedestrians.compare(
            &numbers(&PAPER.pedestrians),
            &numbers(&people),
            PAPER.pedestrians.iter().all(has_people),
        ),
        Statement::Radii.compare(
            &numbers(&PAPER.radii_m),
            &numbers(&axes.radii_m),
            PAPER.radii_m.iter().all(has_radius),
        ),
        Statement::CentralIntersection.judge(
            &format_args!("{central}, central"),
            one.first().filter(|_| has(1)),
            |at| (place(*at), Outcome::of(*at == PAPER.central_intersection)),
        ),
        Statement::EveryIntersection.judge(
            &"one at each of the 9",
            (has(9) && !nine.is_empty()).then_some(distinct.len()),
            |distinct| {
                (
                    format!("{distinct} different ones"),
                    Outcome::of(distinct == 9),
                )
            },
        ),
        Statement::StaticRobots.compare(&"stand", &robots, robots == "stand"),
    ]
}

/// Column and row, from 1, of the intersection that each of these robots is nearest to at the beginning; none if
/// there is no room for as many.
fn intersections(setting: Setting<'_>, robots: usize) -> Vec<[usize; 2]> {
    let Setting { streets, axes, .. } = setting;
    let Some(grid) = streets.grid() else {
        return Vec::new();
    };
    if axes.stationing.check(streets, robots).is_err() {
        return Vec::new();
    }
    let robots = axes.stationing.schedules(streets, robots, 0);
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
        .map(|robot| robot.place_at(0.0).map(nearest))
        .collect()
}

pub(super) fn on_the_air(behaviour: &Behaviour) -> [Comparison; 8] {
    let radio = &behaviour.radio;
    let power_mw = 10_f64.powf(radio.power_dbm / 10.0);
    // Free space: the wavelength is that whose first metre loses this much.
    let frequency_ghz =
        0.299_792_458 / (4.0 * std::f64::consts::PI) * 10_f64.powf(radio.loss_at_1_m_db / 20.0);
    let is_near = |value: f64, stated: f64| (value / stated - 1.0).abs() < 0.01;
    let share = behaviour.v2x_share;
    let contention = if radio.ideal {
        "no contention".to_owned()
    } else {
        let (aifsn, window) = (radio.aifsn, radio.contention_window);
        format!("EDCA: AIFSN {aifsn}, window {window}")
    };
    let width_mhz = SAMPLES_PER_SYMBOL / SYMBOL_US;
    let (understood, is_unchanged) = match behaviour.understands {
        Understands::Ram => ("understand RAM", false),
        Understands::ClusterVam => ("understand VAM", true),
    };
    [
        Statement::NetworkStack.compare(&"Artery", &"a model of this kit", false),
        Statement::Equipped.compare(
            &"all",
            &format_args!("{:.0} %", 100.0 * share),
            same(share, 1.0),
        ),
        Statement::Power.compare(
            &format_args!("{} mW", PAPER.power_mw),
            &format_args!("{power_mw:.1} mW"),
            is_near(power_mw, PAPER.power_mw),
        ),
        Statement::Frequency.compare(
            &format_args!("{} GHz", PAPER.frequency_ghz),
            &format_args!("{frequency_ghz:.2} GHz"),
            is_near(frequency_ghz, PAPER.frequency_ghz),
        ),
        Statement::Bandwidth.compare(
            &format_args!("{} MHz", PAPER.channel_mhz),
            &format_args!("{width_mhz} MHz"),
            width_mhz == PAPER.channel_mhz,
        ),
        Statement::Access.compare(&"IEEE 802.11p, EDCA", &contention, !radio.ideal),
        Statement::DataRate.with(
            &"not stated",
            &format_args!("{} Mbit/s", radio.data_rate_mbps),
            Outcome::Assumed,
        ),
        Statement::UnchangedDevices.compare(&"no change is required", &understood, is_unchanged),
    ]
}
