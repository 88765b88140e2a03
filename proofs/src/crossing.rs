//! The crossing machine: its beliefs are valid for ever, and less evidence gives no permission (P7), step by step.

use crossguard_crossing::occupancy::laws::{self as occupancy, Change};
use crossguard_crossing::position::laws as position;
use crossguard_crossing::traffic::laws as traffic;

use crate::harness::harnesses;
use crate::{Symbolic, kani};

/// Of how many parts both of two sources know something. Parts do not mix: the same is done for each.
const PARTS: usize = 3;

/// Declares harnesses of one law each, which says whether it came to what must be reachable.
macro_rules! laws {
    ($($(#[$($attribute:tt)*])* $name:ident: $law:expr => $mark:literal;)+) => {
        harnesses! { $(
            $(#[$($attribute)*])*
            fn $name() {
                let came: bool = $law;
                kani::cover!(came, $mark);
            }
        )+ }
    };
}

laws! {
    /// Any sensors, any valid state of a source with 32 parts, any time.
    #[unwind(34)]
    a_source_stays_valid_as_time_passes: occupancy::stays_valid(&mut Symbolic, Change::Elapsed) => "time passes";

    /// As above, any empty frame.
    #[unwind(34)]
    a_source_stays_valid_by_an_empty_frame: occupancy::stays_valid(&mut Symbolic, Change::Empty) => "taken in";

    /// As above, any frame with somebody on the road.
    #[unwind(34)]
    a_source_stays_valid_by_a_person: occupancy::stays_valid(&mut Symbolic, Change::Occupied) => "taken in";

    /// Any two valid states of which one has no more evidence than the other.
    #[unwind(34)]
    with_less_evidence_no_part_is_clearer: occupancy::less_is_no_clearer(&mut Symbolic) => "clear";

    /// As above, of three parts, any time.
    #[unwind(34)]
    less_evidence_stays_less_as_time_passes: occupancy::less_stays_less(&mut Symbolic, Change::Elapsed, PARTS) => "time passes";

    /// As above, any empty frame.
    #[unwind(34)]
    less_evidence_stays_less_by_an_empty_frame: occupancy::less_stays_less(&mut Symbolic, Change::Empty, PARTS) => "it counts";

    /// As above, any frame with somebody on the road.
    #[unwind(34)]
    less_evidence_stays_less_by_a_person: occupancy::less_stays_less(&mut Symbolic, Change::Occupied, PARTS) => "taken in";

    /// Any valid state, any empty frame that covers everything.
    #[unwind(34)]
    an_empty_frame_is_evidence: occupancy::a_frame_is_evidence(&mut Symbolic) => "it counts";

    /// As above, at once or at any time later.
    #[unwind(34)]
    a_late_frame_is_less_evidence: occupancy::late_is_less(&mut Symbolic) => "it counts although it is late";

    /// Any valid state, any empty frame.
    #[unwind(34)]
    a_frame_that_is_dropped_is_no_evidence: occupancy::the_rest_is_none(&mut Symbolic, Change::Empty) => "dropped";

    /// Any valid state, any frame with somebody on the road.
    #[unwind(34)]
    a_person_is_no_evidence: occupancy::the_rest_is_none(&mut Symbolic, Change::Occupied) => "taken in";

    /// Any valid state, any time.
    #[unwind(34)]
    time_is_no_evidence: occupancy::the_rest_is_none(&mut Symbolic, Change::Elapsed) => "time passes";

    /// Any valid state, any frame.
    #[unwind(34)]
    a_frame_counts_once: occupancy::twice_is_once(&mut Symbolic) => "it counts";

    /// Any rules, any valid presence, any position, any time.
    #[unwind(2)]
    presence_stays_valid: position::stays_valid(&mut Symbolic) => "there";

    /// As above, any two of which one is no more than the other.
    #[unwind(2)]
    less_presence_stays_less: position::less_stays_less(&mut Symbolic) => "there";

    /// As above, any two positions of which one is worse.
    #[unwind(2)]
    a_worse_position_is_less_presence: position::worse_is_less(&mut Symbolic) => "there by the better one";

    /// Any speed, distance, time and rules.
    #[random_only("products of two numbers that nothing binds: not within 100 s")]
    a_worse_report_stops_no_vehicle: traffic::worse_stops_no_vehicle(&mut Symbolic) => "it can stop";
}
