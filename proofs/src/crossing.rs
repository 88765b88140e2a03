//! The crossing machine: its beliefs are valid for ever, and less evidence gives no permission (P7), step by step.

use crossguard_crossing::occupancy::laws::{self as occupancy, Change};
use crossguard_crossing::position::laws as position;
use crossguard_crossing::traffic::laws as traffic;

use crate::harness::harnesses;
use crate::{Symbolic, kani};

/// Of how many parts both of two sources know something. Parts do not mix: the same is done for each.
const PARTS: usize = 3;

harnesses! {
    /// Any sensors, any valid state of a source with 32 parts, any time.
    #[unwind(34)]
    fn a_source_stays_valid_as_time_passes() {
        let passes = occupancy::stays_valid(&mut Symbolic, Change::Elapsed);
        kani::cover!(passes, "time passes");
    }

    /// As above, any empty frame.
    #[unwind(34)]
    fn a_source_stays_valid_by_an_empty_frame() {
        let is_taken_in = occupancy::stays_valid(&mut Symbolic, Change::Empty);
        kani::cover!(is_taken_in, "taken in");
    }

    /// As above, any frame with somebody on the road.
    #[unwind(34)]
    fn a_source_stays_valid_by_a_person() {
        let is_taken_in = occupancy::stays_valid(&mut Symbolic, Change::Occupied);
        kani::cover!(is_taken_in, "taken in");
    }

    /// Any two valid states of which one has no more evidence than the other.
    #[unwind(34)]
    fn with_less_evidence_no_part_is_clearer() {
        let is_clear = occupancy::less_is_no_clearer(&mut Symbolic);
        kani::cover!(is_clear, "clear");
    }

    /// As above, of three parts, any time.
    #[unwind(34)]
    fn less_evidence_stays_less_as_time_passes() {
        let passes = occupancy::less_stays_less(&mut Symbolic, Change::Elapsed, PARTS);
        kani::cover!(passes, "time passes");
    }

    /// As above, any empty frame.
    #[unwind(34)]
    fn less_evidence_stays_less_by_an_empty_frame() {
        let counts = occupancy::less_stays_less(&mut Symbolic, Change::Empty, PARTS);
        kani::cover!(counts, "it counts");
    }

    /// As above, any frame with somebody on the road.
    #[unwind(34)]
    fn less_evidence_stays_less_by_a_person() {
        let counts = occupancy::less_stays_less(&mut Symbolic, Change::Occupied, PARTS);
        kani::cover!(counts, "taken in");
    }

    /// Any valid state, any empty frame that covers everything.
    #[unwind(34)]
    fn an_empty_frame_is_evidence() {
        let counts = occupancy::a_frame_is_evidence(&mut Symbolic);
        kani::cover!(counts, "it counts");
    }

    /// As above, at once or at any time later.
    #[unwind(34)]
    fn a_late_frame_is_less_evidence() {
        let counts = occupancy::late_is_less(&mut Symbolic);
        kani::cover!(counts, "it counts although it is late");
    }

    /// Any valid state, any empty frame.
    #[unwind(34)]
    fn a_frame_that_is_dropped_is_no_evidence() {
        let is_dropped = occupancy::the_rest_is_none(&mut Symbolic, Change::Empty);
        kani::cover!(is_dropped, "dropped");
    }

    /// Any valid state, any frame with somebody on the road.
    #[unwind(34)]
    fn a_person_is_no_evidence() {
        let is_taken_in = occupancy::the_rest_is_none(&mut Symbolic, Change::Occupied);
        kani::cover!(is_taken_in, "taken in");
    }

    /// Any valid state, any time.
    #[unwind(34)]
    fn time_is_no_evidence() {
        let passes = occupancy::the_rest_is_none(&mut Symbolic, Change::Elapsed);
        kani::cover!(passes, "time passes");
    }

    /// Any valid state, any frame.
    #[unwind(34)]
    fn a_frame_counts_once() {
        let counts = occupancy::twice_is_once(&mut Symbolic);
        kani::cover!(counts, "it counts");
    }

    /// Any rules, any valid presence, any position, any time.
    #[unwind(2)]
    fn presence_stays_valid() {
        let is_there = position::stays_valid(&mut Symbolic);
        kani::cover!(is_there, "there");
    }

    /// As above, any two of which one is no more than the other.
    #[unwind(2)]
    fn less_presence_stays_less() {
        let is_there = position::less_stays_less(&mut Symbolic);
        kani::cover!(is_there, "there");
    }

    /// As above, any two positions of which one is worse.
    #[unwind(2)]
    fn a_worse_position_is_less_presence() {
        let is_there = position::worse_is_less(&mut Symbolic);
        kani::cover!(is_there, "there by the better one");
    }

    /// Any speed, distance, time and rules.
    #[random_only("products of two numbers that nothing binds: not within 100 s")]
    fn a_worse_report_stops_no_vehicle() {
        let can_stop = traffic::worse_stops_no_vehicle(&mut Symbolic);
        kani::cover!(can_stop, "it can stop");
    }
}
