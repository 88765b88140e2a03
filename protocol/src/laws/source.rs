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

/// Random numbers that all follow from a seed (`SplitMix64`): mostly as hinted, often at an edge or small.
#[derive(Clone, Debug)]
pub struct Random(pub u64);

impl Random {
    fn next(&mut self) -> u32 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        u32::try_from((z ^ (z >> 31)) >> 32).unwrap_or_default()
    }
}

impl Source for Random {
    fn number(&mut self, max: u32, hint: u32) -> u32 {
        let (kind, value) = (self.next() % 16, self.next());
        let number = match kind {
            0 => value,
            1 => max,
            2 => 0,
            3 => value % 1_000,
            _ if hint <= max => hint,
            _ => value,
        };
        number.checked_rem(max.wrapping_add(1)).unwrap_or(number)
    }
}
