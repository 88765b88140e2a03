//! Where arbitrary values come from.

/// A hint that is none.
const NO_HINT: u32 = u32::MAX;

/// A source of numbers, from which values of all types are built.
///
/// Under Kani it gives *every* number, and a law that is called with what is built from it is proved.
/// Under proptest it gives random numbers.
pub trait Source {
    /// A number of at most `max`, any of them.
    ///
    /// `hint` is one that makes a whole more interesting, for instance the number of the robot's own
    /// session where a message names one. A random source gives it more often than chance has it. A
    /// hint above `max` is none.
    fn number(&mut self, max: u32, hint: u32) -> u32;

    /// Either.
    fn flag(&mut self) -> bool {
        self.number(1, NO_HINT) == 1
    }

    /// Either, and what `hint` says is more interesting.
    fn likely(&mut self, hint: Option<bool>) -> bool {
        self.number(1, hint.map_or(NO_HINT, u32::from)) == 1
    }

    /// Any number of 16 bits.
    #[expect(clippy::cast_possible_truncation, reason = "at most u16::MAX")]
    fn u16(&mut self, hint: u16) -> u16 {
        self.number(u16::MAX.into(), hint.into()) as u16
    }

    /// Any number of 8 bits.
    #[expect(clippy::cast_possible_truncation, reason = "at most u8::MAX")]
    fn u8(&mut self, hint: u8) -> u8 {
        self.number(u8::MAX.into(), hint.into()) as u8
    }
}
