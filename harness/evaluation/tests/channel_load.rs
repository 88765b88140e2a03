//! The law of the channel load: where robots stand in for people's devices, the channel is less busy by
//! coverage times the share of VAM, less what RAM add.

use crossguard_endpoint::ras::clustering::Settings;
use crossguard_endpoint::ras::motion::Point;
use crossguard_evaluation::behaviour::Behaviour;
use crossguard_evaluation::coverage::coverage;
use crossguard_evaluation::matrix::{predicted_reduction, vam_share};
use crossguard_evaluation::messages::Sizes;
use crossguard_evaluation::radio::Radio;
use crossguard_evaluation::simulation::{Measured, simulate};
use crossguard_evaluation::trace::{Run, Track};
use crossguard_evaluation::vru::{Understands, VamRule};
use proptest::prelude::*;

const SECONDS: u64 = 40;

/// Track of a body that stands here.
fn standing(at: Point) -> Track {
    let samples = usize::try_from(SECONDS * 2 + 1).unwrap();
    Track::new(500, &vec![at; samples])
}

/// Track of a body that moves to and fro between two places.
fn moving(from: Point, to: Point, seconds: f64) -> Track {
    let place = |half: u64| {
        #[expect(clippy::cast_precision_loss, reason = "a minute")]
        let turns = half as f64 / 2.0 / seconds;
        let share = 1.0 - (turns.rem_euclid(2.0) - 1.0).abs();
        [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * share)
    };
    Track::new(500, &(0..=SECONDS * 2).map(place).collect::<Vec<_>>())
}

fn standing_all(places: &[Point]) -> Vec<Track> {
    places.iter().map(|&place| Track::standing(place)).collect()
}

fn measure(run: &Run, robots: &[Point], behaviour: &Behaviour) -> Measured {
    let sizes = Sizes::measure(5).unwrap();
    simulate(
        run,
        SECONDS * 1_000,
        &standing_all(robots),
        behaviour,
        &sizes,
    )
    .unwrap()
    .0
}

fn on_an_ideal_channel(vam: VamRule, ram_interval_ms: u64) -> Behaviour {
    Behaviour {
        vam,
        ram_interval_ms: Some(ram_interval_ms),
        radio: Radio {
            ideal: true,
            ..Radio::default()
        },
        ..Behaviour::default()
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    /// With what devices really do, the law is exact but for the few VAM by which they come and go; with
    /// coverage in its place, when nobody crosses the edge. RAM come often enough that each cluster of a row of
    /// people is announced again in time.
    #[test]
    fn the_reduction_is_coverage_times_the_share_of_vam_less_that_of_ram(
        near in 0_u8..12, far in 1_u8..12, walkers in 0_u8..4, vehicles in 0_u8..6,
        vam_ms in prop_oneof![Just(100_u64), Just(200), Just(500)],
        ram_ms in prop_oneof![Just(100_u64), Just(200), Just(300)],
        seed in 0_u64..1_000,
    ) {
        let row = |count: u8, y: f64| (0..count).map(move |i| [f64::from(i) - 5.0, y]);
        let stands = row(near, 3.0).chain(row(far, 60.0)).map(standing);
        let walks = row(walkers, -4.0).map(|at| moving(at, [at[0], -40.0], 27.0));
        let drive = (0..vehicles).map(|i| moving([f64::from(i) * 9.0, 90.0], [0.0, -90.0], 15.0));
        let run = Run { seed, vehicles: drive.collect(), pedestrians: stands.chain(walks).collect() };
        let behaviour = on_an_ideal_channel(VamRule::Periodic(vam_ms), ram_ms);
        let robots = [[0.0, 0.0]];
        let (before, after) = (measure(&run, &[], &behaviour), measure(&run, &robots, &behaviour));
        let reduction = 1.0 - after.mcbr / before.mcbr;
        let by_silence = predicted_reduction(&before, &after, after.passive);
        prop_assert!((reduction - by_silence).abs() < 0.02, "{reduction} {by_silence} {before:?} {after:?}");
        let covered = coverage(&run, &standing_all(&robots), Settings::default().radius_m);
        if walkers == 0 {
            let by_coverage = predicted_reduction(&before, &after, covered);
            prop_assert!((reduction - by_coverage).abs() < 0.02, "{reduction} {by_coverage}");
        }
        prop_assert!((0.0..=1.0).contains(&vam_share(&before)));
    }
}

fn crowd() -> Run {
    let row = |y: f64| (0..10).map(move |i| standing([f64::from(i) - 5.0, y]));
    Run {
        seed: 5,
        vehicles: Vec::new(),
        pedestrians: row(3.0).chain(row(60.0)).collect(),
    }
}

/// A law that would hold of anything says nothing: each of its terms is needed.
#[test]
fn the_law_does_not_hold_without_one_of_its_terms() {
    let drive = (0..6_u8).map(|i| moving([f64::from(i) * 9.0, 90.0], [0.0, -90.0], 15.0));
    let run = Run {
        vehicles: drive.collect(),
        ..crowd()
    };
    let behaviour = on_an_ideal_channel(VamRule::Periodic(200), 100);
    let (before, after) = (
        measure(&run, &[], &behaviour),
        measure(&run, &[[0.0, 0.0]], &behaviour),
    );
    let reduction = 1.0 - after.mcbr / before.mcbr;
    let is_off = |law: f64| (reduction - law).abs() > 0.02;
    let (quiet, share) = (after.passive, vam_share(&before));
    let law = predicted_reduction(&before, &after, quiet);
    let of_ram = quiet * share - law;
    assert!(!is_off(law), "{reduction} {law}");
    assert!(is_off(quiet * share) && is_off(share - of_ram) && is_off(quiet - of_ram));
}

#[test]
fn what_robots_say_can_cost_more_than_devices_save() {
    // Devices that stand send one VAM in 5 s by ETSI's rule; a robot sends ten RAM a second.
    let behaviour = on_an_ideal_channel(VamRule::Etsi, 100);
    let (run, robots) = (crowd(), [[0.0, 0.0]]);
    let before = measure(&run, &[], &behaviour);
    let after = measure(&run, &robots, &behaviour);
    assert!(after.passive > 0.45, "{after:?}");
    assert!(after.mcbr > before.mcbr, "{before:?} {after:?}");
}

#[test]
fn contention_delays_but_hardly_loses_anything_at_a_low_load() {
    let behaviour = Behaviour {
        vam: VamRule::Periodic(100),
        ..Behaviour::default()
    };
    let measured = measure(&crowd(), &[], &behaviour);
    assert!((measured.vam_rate - 200.0).abs() < 2.0, "{measured:?}");
    assert!(
        measured.overlapped < 0.02 && measured.replaced_rate < 0.1,
        "{measured:?}"
    );
    // The channel is busy for as long as frames are in the air, less what overlaps.
    assert!(
        (measured.mcbr - measured.vam_load).abs() < 0.02 * measured.vam_load,
        "{measured:?}"
    );
}

#[test]
fn unmodified_devices_join_by_the_cluster_vam_of_a_robot() {
    let behaviour = Behaviour {
        understands: Understands::ClusterVam,
        ..Behaviour::default()
    };
    let measured = measure(&crowd(), &[[0.0, 0.0]], &behaviour);
    // The row is several clusters: a device near two of them may first try to join the other one.
    assert!(measured.passive > 0.3, "{measured:?}");
    let deaf = Behaviour {
        cluster_vam_interval_ms: 5_000,
        ..behaviour
    };
    // A head that is silent for longer than `timeClusterContinuity` is lost.
    assert!(measure(&crowd(), &[[0.0, 0.0]], &deaf).passive < 0.1);
}

#[test]
fn congestion_control_slows_a_full_channel_down() {
    let crowded = Run {
        pedestrians: (0_u8..120)
            .map(|i| standing([f64::from(i % 12), f64::from(i / 12)]))
            .collect(),
        ..crowd()
    };
    let signed = Behaviour {
        signed: true,
        ..Behaviour::default()
    };
    let free = measure(&crowded, &[], &signed);
    let held_back = Behaviour {
        dcc: true,
        ..signed
    };
    let held_back = measure(&crowded, &[], &held_back);
    assert!(
        free.mcbr > 0.4 && held_back.mcbr < 0.35,
        "{free:?} {held_back:?}"
    );
}
