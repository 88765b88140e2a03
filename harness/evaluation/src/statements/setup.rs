//! What the paper states of the set-up: streets, people, robots and the channel.

use super::super::behaviour::Behaviour;
use super::super::messages::{DATA_RATE_MBPS, SYMBOL_US};
use super::super::paper::PAPER;
use super::super::vru::Understands;
use super::text::numbers;
use super::{Comparison, Outcome, Setting, Statement, compare, outcome, same};

/// Samples of a symbol of IEEE 802.11 (clause 17), its guard interval included; their rate is the channel's width.
const SAMPLES_PER_SYMBOL: u64 = 80;

/// What the paper states of the streets and who is on them.
pub(super) fn setup(setting: Setting<'_>, people: impl Iterator<Item = usize>) -> Vec<Comparison> {
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
            Statement::Mobility,
            "people and vehicles are moved by",
            "SUMO".to_owned(),
            grid.mobility.clone(),
            grid.mobility.contains("SUMO"),
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
    let patrol_mps = axes.stationing.patrol_mps;
    lines.push(of(
        Statement::StaticRobots,
        "robots",
        "stand".to_owned(),
        patrol_mps.map_or("stand".to_owned(), |speed| format!("walk at {speed} m/s")),
        patrol_mps.is_none(),
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

pub(super) fn on_the_air(behaviour: &Behaviour) -> [Comparison; 8] {
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
    let share = behaviour.v2x_share;
    let contention = if radio.ideal {
        "no contention".to_owned()
    } else {
        format!(
            "EDCA: AIFSN {}, window {}",
            radio.aifsn, radio.contention_window
        )
    };
    let width_mhz = SAMPLES_PER_SYMBOL / SYMBOL_US;
    [
        of(
            Statement::NetworkStack,
            "the network is simulated by",
            "Artery".to_owned(),
            "a model of this kit".to_owned(),
            "the same",
            Outcome::NotMet,
        ),
        of(
            Statement::Equipped,
            "people with a device",
            "all".to_owned(),
            format!("{:.0} %", 100.0 * share),
            "the same",
            outcome(same(share, 1.0)),
        ),
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
            Statement::Bandwidth,
            "width of the channel",
            format!("{} MHz", PAPER.channel_mhz),
            format!("{width_mhz} MHz"),
            "80 samples a symbol (IEEE 802.11, clause 17), of 8 us here",
            outcome(width_mhz == PAPER.channel_mhz),
        ),
        of(
            Statement::Access,
            "access to the channel",
            "IEEE 802.11p, EDCA".to_owned(),
            contention,
            "stations contend for the channel",
            outcome(!radio.ideal),
        ),
        of(
            Statement::DataRate,
            "data rate",
            "not stated".to_owned(),
            format!("{DATA_RATE_MBPS} Mbit/s"),
            "the default of the 10 MHz channel",
            Outcome::Assumed,
        ),
        of(
            Statement::UnchangedDevices,
            "devices",
            "no change is required".to_owned(),
            match behaviour.understands {
                Understands::Ram => "understand RAM",
                Understands::ClusterVam => "understand VAM",
            }
            .to_owned(),
            "devices understand nothing but ETSI's messages",
            outcome(behaviour.understands == Understands::ClusterVam),
        ),
    ]
}
