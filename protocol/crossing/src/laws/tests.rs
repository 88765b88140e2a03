//! The laws with random values.

use crossguard_protocol::laws::Random;
use proptest::prelude::*;

use super::*;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1_500))]

    #[test]
    fn it_is_total(seed: u64) {
        total(&mut Random(seed));
    }

    #[test]
    fn a_repeated_observation_changes_nothing(seed: u64) {
        repeated(&mut Random(seed));
    }

    #[test]
    fn less_support_clears_no_road(seed: u64) {
        less_support(&mut Random(seed));
    }

    #[test]
    fn late_support_clears_no_road(seed: u64) {
        late_support(&mut Random(seed));
    }

    #[test]
    fn more_against_clears_no_road(seed: u64) {
        more_against(&mut Random(seed));
    }

    #[test]
    fn one_more_vehicle_opens_nothing(seed: u64) {
        one_more_vehicle(&mut Random(seed));
    }

    #[test]
    fn a_robot_that_starts_on_the_road_stays_there_first(seed: u64) {
        starts_on_the_road(&mut Random(seed));
    }
}

/// The laws of beliefs, that Kani proves: where it does not run, many random values look for what breaks them.
#[test]
fn less_evidence_of_a_belief_gives_no_permission() {
    use crate::occupancy::laws::{self as occupancy, Change};
    use crate::{position::laws as position, traffic::laws as traffic};
    for seed in 0..200_000 {
        let source = &mut Random(seed);
        for change in [Change::Elapsed, Change::Empty, Change::Occupied] {
            occupancy::stays_valid(source, change);
            occupancy::less_stays_less(source, change, 2);
            occupancy::the_rest_is_none(source, change);
        }
        occupancy::less_is_no_clearer(source);
        occupancy::a_frame_is_evidence(source);
        occupancy::late_is_less(source);
        occupancy::twice_is_once(source);
        position::stays_valid(source);
        position::less_stays_less(source);
        position::worse_is_less(source);
        traffic::worse_stops_no_vehicle(source);
    }
}

/// The laws are about something: random machines have clear roads, and would show go.
#[test]
fn the_premises_are_reached() {
    let (mut clear, mut go, mut leaves) = (0, 0, 0);
    for seed in 0..2_000 {
        let source = &mut Random(seed);
        let setup = setup(source);
        let mut machine = machine(source, &setup);
        clear += u32::from(is_clear(&machine, &setup));
        machine.step(&setup, Input::CorridorOpen(Millis(1_900)));
        go += u32::from(machine.shows_go() > Millis::ZERO);
        leaves += u32::from(starts_on_the_road(&mut Random(seed)));
    }
    let reached = [clear, go, leaves];
    assert!(
        reached.iter().all(|it| *it > 20),
        "clear, go, leaves: {reached:?} of 2000"
    );
}
