//! The state of a robot arrives in SI units, rounded to the steps of the wire and no further.

use crate::support::core::Random;
use crate::support::{samples, views};
use crossguard_codec::core::ram::RAM;
use crossguard_codec::{
    Identifiers, PastPosition, Position, RobotState, SlowState, decode, distance, encode, ram_from,
    state_of,
};
use crossguard_protocol::{Availability, Coordination, Decimetres, Ram, StationId};
use proptest::prelude::*;

const IDLE: Ram = Ram {
    station: StationId(7),
    coordination: Coordination::None,
    farewell: None,
    on_duty: false,
};

fn over_the_air(state: &RobotState) -> RobotState {
    let identifiers = Identifiers::default();
    let ram = ram_from(&identifiers, state, &IDLE, Availability::Available, 0, true).unwrap();
    let octets = encode(&identifiers, &ram).unwrap();
    state_of(&decode::<RAM>(&identifiers, &octets).unwrap().message)
}

fn close(a: Option<f64>, b: Option<f64>, tolerance: f64) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => (a - b).abs() <= tolerance,
        (a, b) => a.is_none() && b.is_none(),
    }
}

#[test]
fn a_state_arrives_as_it_is() {
    let sent = samples::state();
    let received = over_the_air(&sent);
    // Every quantity of the sample is a whole number of steps, so only its binary form differs.
    assert!(close(
        received.position.latitude,
        sent.position.latitude,
        1e-12
    ));
    assert!(close(
        received.position.longitude,
        sent.position.longitude,
        1e-12
    ));
    assert_eq!(received.position.ellipse, sent.position.ellipse);
    assert_eq!(received.heading, sent.heading);
    assert_eq!(received.speed, sent.speed);
    assert_eq!(received.yaw_rate, sent.yaw_rate);
    assert_eq!(received.dimensions, sent.dimensions);
    assert_eq!(received.battery, sent.battery);
    let (received, sent) = (received.slow.unwrap(), sent.slow.unwrap());
    assert_eq!(received.capabilities, sent.capabilities);
    assert_eq!(received.supported_tasks, sent.supported_tasks);
    assert_eq!(
        (received.lights, received.signals, received.area),
        (sent.lights, sent.signals, sent.area)
    );
    assert_eq!(received.path.len(), sent.path.len());
    for (received, sent) in received.path.iter().zip(&sent.path) {
        assert!(close(Some(received.latitude), Some(sent.latitude), 1e-12));
        assert!(close(Some(received.longitude), Some(sent.longitude), 1e-12));
        assert_eq!(received.duration, sent.duration);
    }
}

#[test]
fn a_state_of_which_nothing_is_known_is_unavailable_throughout() {
    assert_eq!(over_the_air(&RobotState::default()), RobotState::default());
}

#[test]
fn the_low_frequency_container_is_there_when_it_is_asked_for() {
    let identifiers = Identifiers::default();
    let state = samples::state();
    for is_asked_for in [false, true] {
        let available = Availability::Available;
        let ram = ram_from(&identifiers, &state, &IDLE, available, 0, is_asked_for).unwrap();
        assert_eq!(state_of(&ram).slow.is_some(), is_asked_for);
    }
}

#[test]
fn a_path_does_not_lose_its_way_however_long_it_is() {
    // Every step is 1.4 steps of the wire long, so deltas of rounded deltas would go astray.
    let past = |i: u32| PastPosition {
        latitude: 48.765_432_1 - 1.4e-7 * f64::from(i),
        longitude: 9.123_456_7 + 1.4e-7 * f64::from(i),
        altitude: Some(260.0 + 0.014 * f64::from(i)),
        duration: None,
    };
    let path: Vec<PastPosition> = (1..=23).map(past).collect();
    let slow = Some(SlowState {
        path: path.clone(),
        ..SlowState::default()
    });
    let received = over_the_air(&RobotState {
        slow,
        ..samples::state()
    })
    .slow
    .unwrap()
    .path;
    assert_eq!(received.len(), 23);
    for (received, sent) in received.iter().zip(&path) {
        assert!(close(Some(received.latitude), Some(sent.latitude), 0.51e-7));
        assert!(close(
            Some(received.longitude),
            Some(sent.longitude),
            0.51e-7
        ));
        assert!(close(received.altitude, sent.altitude, 0.011));
    }
}

#[test]
fn a_path_ends_where_it_jumps() {
    let mut slow = samples::slow_state();
    slow.path[1].latitude += 1.0;
    let received = over_the_air(&RobotState {
        slow: Some(slow),
        ..samples::state()
    });
    assert_eq!(received.slow.unwrap().path.len(), 1);
}

#[test]
fn a_path_has_at_most_23_points() {
    let mut slow = samples::slow_state();
    slow.path = vec![slow.path[0]; 40];
    let received = over_the_air(&RobotState {
        slow: Some(slow),
        ..samples::state()
    });
    assert_eq!(received.slow.unwrap().path.len(), 23);
}

#[test]
fn distances_are_those_between_the_positions_that_arrive() {
    let received = over_the_air(&samples::state());
    assert_eq!(
        distance(&received.position, &samples::position()),
        Decimetres(0)
    );
    assert_eq!(
        distance(&Position::default(), &received.position),
        Decimetres::UNKNOWN
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1_000))]

    #[test]
    fn a_state_that_is_passed_on_stays_as_it_is(seed: u64) {
        let state = views::state(&mut Random(seed));
        let received = over_the_air(&state);
        let passed_on = over_the_air(&received);
        prop_assert_eq!(over_the_air(&passed_on), passed_on.clone());
        // Measurements beyond the wire's range are told once as unavailable, and then not at all.
        prop_assert_eq!(passed_on.position, received.position);
        prop_assert_eq!(passed_on.heading, received.heading);
        prop_assert_eq!(passed_on.speed, received.speed);
        prop_assert_eq!(passed_on.dimensions, received.dimensions);
        prop_assert_eq!(passed_on.slow, received.slow);
    }

    #[test]
    fn what_is_in_range_arrives_within_a_step(seed: u64) {
        let state = views::state(&mut Random(seed));
        let received = over_the_air(&state);
        let (sent, received) = (state.position, received.position);
        if sent.latitude.is_some_and(|latitude| latitude.abs() <= 90.0) {
            prop_assert!(close(sent.latitude, received.latitude, 0.51e-7));
        }
        if sent.longitude.is_some_and(|longitude| longitude.abs() <= 180.0) {
            prop_assert!(close(sent.longitude, received.longitude, 0.51e-7));
        }
        if sent.altitude.is_some_and(|altitude| (-1_000.0..8_000.0).contains(&altitude)) {
            prop_assert!(close(sent.altitude, received.altitude, 0.010_001));
        }
    }
}
