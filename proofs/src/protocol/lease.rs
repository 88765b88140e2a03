//! The arithmetic of leases.

use crossguard_protocol::laws::lease::{self as laws, Clocks};
use crossguard_protocol::{Config, Heartbeat, Millis, Role, Settings};

use super::stage::any_valid;
use crate::harness::harnesses;
use crate::kani;

/// The longest time of the harnesses, in milliseconds: a bound that keeps products small. Beyond it the sweep
/// in `tests/lease.rs` goes.
const LONGEST: u32 = 8_191;

/// The longest passage of time, in milliseconds: a bound that keeps the number of periods in it small.
const PASSAGE: u32 = 1_023;

fn any_time() -> u32 {
    u32::from(kani::any::<u16>()) & LONGEST
}

harnesses! {
    /// All timers and clocks up to 8 s, with the default drift.
    #[unwind(24)]
    fn the_lease_ends_before_safety() {
        let settings = Settings {
            t_lease: Millis(any_time()),
            delay_max: Millis(any_time()),
            t_safety: Millis(any_time()),
            ..Settings::default()
        };
        let clocks = Clocks { real: any_time(), leader: any_time(), follower: any_time() };
        kani::assume(clocks.are_within(settings.drift_ppm));
        let stands = laws::the_lease_ends_before_safety(&settings, clocks);
        kani::cover!(stands, "the lease stands");
        kani::cover!(clocks.follower > clocks.leader, "the follower's clock is ahead");
        kani::cover!(clocks.leader > settings.t_lease.0, "the lease has ended");
    }

    /// All timers and clocks up to 8 s, with the default drift.
    #[unwind(24)]
    fn an_offer_lapses_before_its_reservation() {
        let settings = Settings {
            t_offer: Millis(any_time()),
            delay_max: Millis(any_time()),
            ..Settings::default()
        };
        let clocks = Clocks { real: any_time(), leader: any_time(), follower: any_time() };
        kani::assume(clocks.are_within(settings.drift_ppm));
        let counts = laws::an_offer_lapses_before_its_reservation(&settings, clocks);
        kani::cover!(counts, "the offer is counted on");
        kani::cover!(!counts, "it is not");
    }

    /// All leaders with the default configuration, all heartbeats, up to a second at once.
    #[unwind(6)]
    fn heartbeats_age_as_time_passes() {
        let config = Config::default();
        let robot = any_valid(&config, Role::Leader, (1, 1));
        let (heartbeat, elapsed) = (Heartbeat(kani::any()), Millis(any_time() & PASSAGE));
        laws::heartbeats_age_as_time_passes(&config, &robot, heartbeat, elapsed);
        kani::cover!(robot.next_ram().is_some_and(|left| left < elapsed), "late");
        kani::cover!(robot.next_ram().is_some_and(|left| left > elapsed), "not yet");
        kani::cover!(elapsed.0 == PASSAGE, "the longest time");
    }

    /// All leaders with the default configuration, up to a second at once.
    #[unwind(6)]
    fn time_leaves_leases_covered() {
        let config = Config::default();
        let robot = any_valid(&config, Role::Leader, (1, 1));
        let elapsed = Millis(any_time() & PASSAGE);
        let stand = laws::time_leaves_leases_covered(&config, &robot, elapsed);
        kani::cover!(stand, "a lease stands before and after");
        kani::cover!(robot.next_ram().is_some_and(|left| left < elapsed), "late");
    }
}
