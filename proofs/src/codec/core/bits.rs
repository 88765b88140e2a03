//! What reads and writes bits.

use crossguard_codec::core::laws;

use crate::harness::harnesses;
use crate::kani;

harnesses! {
    /// Any numbers of any three counts of bits up to 32.
    #[unwind(8)]
    #[solver(cadical)]
    fn bits_are_read_as_written() {
        let (before, number, after): ((u32, u32), (u32, u32), (u32, u32)) =
            ((kani::any(), kani::any()), (kani::any(), kani::any()), (kani::any(), kani::any()));
        laws::bits_are_read_as_written(before, number, after);
        kani::cover!(before.1 % 33 == 31 && number.1 % 33 == 32, "across a window");
        kani::cover!(before.1 % 33 + number.1 % 33 + after.1 % 33 == 0, "no bits");
    }
}
