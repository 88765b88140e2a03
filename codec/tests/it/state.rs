//! The state of a robot arrives in SI units, rounded to the steps of the wire and no further. The laws of `si` and of the
//! mapping (`view_laws.rs`) say that of every quantity, and that a state which is passed on stays as it is.

use crate::support::samples;
use crossguard_codec::core::ram::RAM;
use crossguard_codec::{
    Identifiers, PastPosition, RobotState, SlowState, decode, encode, ram_from, state_of,
};
use crossguard_protocol::{Availability, Coordination, Ram, StationId};

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
    // Every quantity of the sample is a whole number of steps, so only the binary form of degrees differs.
    let mut sent = samples::state();
    let received = over_the_air(&sent);
    let same = |sent: &mut f64, received: f64| {
        assert!((*sent - received).abs() <= 1e-12);
        *sent = received;
    };
    let (to, from) = (&mut sent.position, received.position);
    same(to.latitude.as_mut().unwrap(), from.latitude.unwrap());
    same(to.longitude.as_mut().unwrap(), from.longitude.unwrap());
    let paths = sent.slow.iter_mut().zip(&received.slow);
    for (to, from) in paths.flat_map(|(to, from)| to.path.iter_mut().zip(&from.path)) {
        same(&mut to.latitude, from.latitude);
        same(&mut to.longitude, from.longitude);
    }
    assert_eq!(received, sent);
}

#[test]
fn a_state_of_which_nothing_is_known_is_unavailable_throughout() {
    assert_eq!(over_the_air(&RobotState::default()), RobotState::default());
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
