//! Time stamps: all values, in integers.

use crossguard_codec::si::{self, laws};

use crate::harness::harnesses;
use crate::kani;

harnesses! {
    /// All pairs of instants.
    #[unwind(6)]
    fn time_stamps_keep_their_instant() {
        let (earlier, later): (i64, i64) = (kani::any(), kani::any());
        laws::time_stamps_keep_their_instant(earlier, later);
        kani::cover!(si::timestamp_its(later) == si::TIMESTAMP_ITS_MAX, "after the end");
        kani::cover!(si::timestamp_its(earlier) == 0, "before the beginning");
    }

    /// All time stamps, those within leap seconds included.
    #[unwind(6)]
    fn instants_keep_their_time_stamp() {
        let stamp = kani::any();
        laws::instants_keep_their_time_stamp(stamp);
        kani::cover!(stamp > si::TIMESTAMP_ITS_MAX, "after the end");
    }

    /// All instants of reception of the time scale but its first minute, and all ages.
    #[unwind(2)]
    fn generation_times_are_rebuilt() {
        let (now, bits): (u64, u16) = (kani::any(), kani::any());
        let now = now % (si::TIMESTAMP_ITS_MAX + 1);
        let age = bits.cast_signed();
        laws::generation_times_are_rebuilt(now, age);
        kani::cover!(age < 0, "from the future");
        kani::cover!(now > 0x1_0000 && age > 0, "from the past");
    }
}
