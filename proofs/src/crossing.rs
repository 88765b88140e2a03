//! The crossing machine: its beliefs are valid for ever, and less evidence gives no permission (P7), step by step.

use crossguard_crossing::occupancy::laws::{self as occupancy, Extent};
use crossguard_crossing::position::laws as position;
use crossguard_crossing::traffic::laws as traffic;

use crate::harness::harnesses;
use crate::{Symbolic, kani};

/// What keeps products small: 100 m/s, and 8 s.
const BOUNDS: traffic::Bounds = traffic::Bounds {
    speed_cmps: 10_000,
    time_ms: 8_191,
};

/// Parts and sources do not mix: the same is done for each.
const EXTENT: Extent = Extent {
    parts: 3,
    source: Some(0),
};

harnesses! {
    /// Any sensors, any road, any valid state of four sources that know of three parts, the first of which delivers; any change.
    #[unwind(66)]
    #[solver(cadical)]
    fn what_is_known_of_the_road_stays_valid() {
        let admitted = occupancy::stays_valid(&mut Symbolic, EXTENT);
        kani::cover!(admitted, "taken in");
    }

    /// As above, any two states of which one has no more evidence than the other.
    #[unwind(66)]
    #[solver(cadical)]
    fn with_less_evidence_no_road_is_clearer() {
        let is_clear = occupancy::less_is_no_clearer(&mut Symbolic, EXTENT);
        kani::cover!(is_clear, "clear");
    }

    /// As above, any change.
    #[unwind(66)]
    #[solver(cadical)]
    fn less_evidence_stays_less() {
        let counts = occupancy::less_stays_less(&mut Symbolic, EXTENT);
        kani::cover!(counts, "an empty frame counts");
    }

    /// As above, any frame that covers everything.
    #[unwind(66)]
    #[solver(cadical)]
    fn an_empty_frame_is_evidence() {
        let counts = occupancy::a_frame_is_evidence(&mut Symbolic, EXTENT);
        kani::cover!(counts, "it counts");
    }

    /// As above, at once or at any time later.
    #[unwind(66)]
    #[solver(cadical)]
    fn a_late_frame_is_less_evidence() {
        let counts = occupancy::late_is_less(&mut Symbolic, EXTENT);
        kani::cover!(counts, "it counts although it is late");
    }

    /// As above, anything but an empty frame.
    #[unwind(66)]
    #[solver(cadical)]
    fn nothing_but_an_empty_frame_is_evidence() {
        let is_frame = occupancy::the_rest_is_none(&mut Symbolic, EXTENT);
        kani::cover!(is_frame, "a frame");
    }

    /// As above, any frame.
    #[unwind(66)]
    #[solver(cadical)]
    fn a_frame_counts_once() {
        let counts = occupancy::twice_is_once(&mut Symbolic, EXTENT);
        kani::cover!(counts, "it counts");
    }

    /// Any rules, any valid presence, any position, any time.
    #[unwind(2)]
    #[solver(cadical)]
    fn presence_stays_valid() {
        let is_there = position::stays_valid(&mut Symbolic);
        kani::cover!(is_there, "there");
    }

    /// As above, any two of which one is no more than the other.
    #[unwind(2)]
    #[solver(cadical)]
    fn less_presence_stays_less() {
        let is_there = position::less_stays_less(&mut Symbolic);
        kani::cover!(is_there, "there");
    }

    /// As above, any two positions of which one is worse.
    #[unwind(2)]
    #[solver(cadical)]
    fn a_worse_position_is_less_presence() {
        let is_there = position::worse_is_less(&mut Symbolic);
        kani::cover!(is_there, "there by the better one");
    }

    /// Vehicles up to 100 m/s, reports and reactions up to 8 s.
    #[unwind(2)]
    #[solver(cadical)]
    fn a_worse_report_stops_no_vehicle() {
        let can_stop = traffic::worse_stops_no_vehicle(&mut Symbolic, BOUNDS);
        kani::cover!(can_stop, "it can stop");
    }
}
