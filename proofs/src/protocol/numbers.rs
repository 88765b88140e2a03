//! Serial numbers and numbers on the wire: all values.

use crossguard_protocol::laws::numbers as laws;
use crossguard_protocol::{Heartbeat, RequestId, UniqueNumber};

use crate::harness::harnesses;
use crate::kani;

harnesses! {
    /// All pairs of request numbers.
    #[unwind(1)]
    fn requests_are_in_one_order() {
        let (a, b) = (RequestId(kani::any()), RequestId(kani::any()));
        laws::requests_are_in_one_order(a, b);
        laws::the_next_request_is_newer(a);
        kani::cover!(a.is_newer_than(b), "newer");
        kani::cover!(a.distance_from(b) == 128, "half the space apart");
    }

    /// All triples of request numbers of one session.
    #[unwind(6)]
    fn requests_of_a_session_are_transitive() {
        let [first, a, b, c] = kani::any::<[u8; 4]>().map(RequestId);
        laws::requests_of_a_session_are_transitive(first, a, b, c);
        kani::cover!(a.is_newer_than(b) && b.is_newer_than(c) && a.is_newer_than(c), "a chain");
        kani::cover!(a.is_newer_than(b) && b.is_newer_than(c) && c.is_newer_than(a), "a circle");
    }

    /// All pairs of heartbeats, and all distances.
    #[unwind(1)]
    fn heartbeats_are_in_one_order() {
        let (a, b) = (Heartbeat(kani::any()), Heartbeat(kani::any()));
        laws::heartbeats_are_in_one_order(a, b);
        laws::later_heartbeats_are_newer(a, b.0);
        kani::cover!(a.is_newer_than(b), "newer");
        kani::cover!(a.0 < b.0 && a.is_newer_than(b), "newer beyond the wrap");
        kani::cover!(u32::from(a.distance_from(b)) == Heartbeat::HALF_SPACE, "half the space apart");
        kani::cover!(u32::from(b.0) == Heartbeat::HALF_SPACE, "half the space later");
    }

    /// All triples of heartbeats of one session.
    #[unwind(6)]
    fn heartbeats_of_a_session_are_transitive() {
        let [first, a, b, c] = kani::any::<[u16; 4]>().map(Heartbeat);
        laws::heartbeats_of_a_session_are_transitive(first, a, b, c);
        kani::cover!(a.is_newer_than(b) && b.is_newer_than(c) && a.is_newer_than(c), "a chain");
    }

    /// All pairs of unique numbers.
    #[unwind(1)]
    fn unique_numbers_survive_the_wire() {
        let [boot, count, other_boot, other_count] = kani::any::<[u16; 4]>();
        let a = UniqueNumber { boot, count };
        let b = UniqueNumber { boot: other_boot, count: other_count };
        laws::unique_numbers_survive_the_wire(a, b);
        kani::cover!(a < b, "smaller");
    }
}
