//! The lease theorem for leases of any length that a configuration takes, with the clocks at their worst.

use crossguard_protocol::laws::lease::{Clocks, the_lease_ends_before_safety};
use crossguard_protocol::{Millis, Settings};

const MILLION: u64 = 1_000_000;

/// The law where it is hardest to keep: `t_safety` is the shortest that the configuration takes with this
/// lease, the leader's clock is as late and the follower's as early as they may be, and the lease ends now.
///
/// Where the law holds there, it holds for every longer `t_safety` and for every other clock of the follower,
/// since those only make its conclusion easier.
fn worst(lease_ends: u32, delay_max: u32, drift_ppm: u32) {
    let (ahead, behind) = (
        MILLION + u64::from(drift_ppm),
        MILLION - u64::from(drift_ppm),
    );
    let millis = |value: u64| u32::try_from(value).expect("shorter than seven weeks");
    let lease_ends_ms = u64::from(lease_ends);
    let settings = Settings {
        t_lease: Millis(lease_ends - delay_max),
        delay_max: Millis(delay_max),
        t_safety: Millis(millis(lease_ends_ms * ahead / behind + 1)),
        drift_ppm,
        ..Settings::default()
    };
    let real = lease_ends_ms * MILLION / behind;
    let clocks = Clocks {
        real: millis(real),
        leader: millis((real * behind).div_ceil(MILLION)),
        follower: millis(real * ahead / MILLION),
    };
    assert!(
        the_lease_ends_before_safety(&settings, clocks),
        "{settings:?} {clocks:?}"
    );
}

fn all_leases(up_to_ms: u32, step: usize) {
    for drift_ppm in [0, 1, 100, 1_000, 33_333, 99_999] {
        for delay_max in [0, 50, 999] {
            for lease_ends in (delay_max + 1..=up_to_ms).step_by(step) {
                worst(lease_ends, delay_max, drift_ppm);
            }
        }
    }
}

#[test]
fn leases_up_to_a_minute_end_before_safety() {
    all_leases(60_000, 1);
}

#[test]
fn leases_of_any_length_end_before_safety() {
    all_leases(70_000_000, 4_099);
}

#[test]
#[ignore = "a billion leases; run in release"]
fn every_lease_ends_before_safety() {
    all_leases(70_000_000, 1);
}
