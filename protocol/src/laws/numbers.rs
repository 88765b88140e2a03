//! Laws of serial numbers: the order of [`RequestId`] and [`Heartbeat`] (RFC 1982).

use crate::id::{Heartbeat, RequestId, UniqueNumber};

/// Of two different numbers exactly one is newer, unless they are half the number space apart: then
/// none is. No number is newer than itself.
pub fn requests_are_in_one_order(a: RequestId, b: RequestId) {
    let distance = a.distance_from(b);
    let in_no_order = distance == 0 || distance == 1 << 7;
    assert_eq!(a.is_newer_than(b) || b.is_newer_than(a), !in_no_order);
    assert!(!(a.is_newer_than(b) && b.is_newer_than(a)));
}

/// Where three numbers lie within less than half the number space, newer than newer is newer.
pub fn requests_of_a_session_are_transitive(
    first: RequestId,
    a: RequestId,
    b: RequestId,
    c: RequestId,
) {
    let within = |n: RequestId| n.distance_from(first) <= RequestId::MAX_PER_SESSION;
    if !(within(a) && within(b) && within(c)) {
        return;
    }
    // In a session the serial order is the order in which the numbers were given out.
    assert_eq!(
        a.is_newer_than(b),
        a.distance_from(first) > b.distance_from(first)
    );
    if a.is_newer_than(b) && b.is_newer_than(c) {
        assert!(a.is_newer_than(c));
    }
}

/// The next number is newer than the one before it, by one step.
pub fn the_next_request_is_newer(a: RequestId) {
    assert!(a.next().is_newer_than(a));
    assert_eq!(a.next().distance_from(a), 1);
}

/// As [`requests_are_in_one_order`], with 16 bits.
pub fn heartbeats_are_in_one_order(a: Heartbeat, b: Heartbeat) {
    let distance = u32::from(a.distance_from(b));
    let in_no_order = distance == 0 || distance == Heartbeat::HALF_SPACE;
    assert_eq!(a.is_newer_than(b) || b.is_newer_than(a), !in_no_order);
    assert!(!(a.is_newer_than(b) && b.is_newer_than(a)));
}

/// As [`requests_of_a_session_are_transitive`], with 16 bits.
pub fn heartbeats_of_a_session_are_transitive(
    first: Heartbeat,
    a: Heartbeat,
    b: Heartbeat,
    c: Heartbeat,
) {
    let within = |n: Heartbeat| u32::from(n.distance_from(first)) < Heartbeat::HALF_SPACE;
    if !(within(a) && within(b) && within(c)) {
        return;
    }
    assert_eq!(
        a.is_newer_than(b),
        a.distance_from(first) > b.distance_from(first)
    );
    if a.is_newer_than(b) && b.is_newer_than(c) {
        assert!(a.is_newer_than(c));
    }
}

/// A heartbeat some periods later is at that distance, and newer if that is less than half the space.
pub fn later_heartbeats_are_newer(a: Heartbeat, periods: u16) {
    let later = a.after(periods);
    assert_eq!(later.distance_from(a), periods);
    let newer = periods > 0 && u32::from(periods) < Heartbeat::HALF_SPACE;
    assert_eq!(later.is_newer_than(a), newer);
    assert_eq!(later.can_follow(a), newer || periods == 0);
}

/// A number is the same after its way over the wire, and the order of the numbers of one boot is
/// theirs on the wire.
pub fn unique_numbers_survive_the_wire(a: UniqueNumber, b: UniqueNumber) {
    assert_eq!(UniqueNumber::from_u32(a.to_u32()), a);
    assert_eq!(a == b, a.to_u32() == b.to_u32());
    assert_eq!(a < b, a.to_u32() < b.to_u32());
}
