//! The source of symbolic values.

use crossguard_protocol::laws::Source;

/// Every number at once under Kani, a random one under the stand-in.
#[derive(Clone, Copy, Debug)]
pub struct Symbolic;

impl Source for Symbolic {
    #[cfg(all(kani, not(feature = "stand-in")))]
    fn number(&mut self, max: u32, _: u32) -> u32 {
        let number = ::kani::any();
        ::kani::assume(number <= max);
        number
    }

    #[cfg(not(all(kani, not(feature = "stand-in"))))]
    fn number(&mut self, max: u32, hint: u32) -> u32 {
        crate::stand_in::number(max, hint)
    }
}
