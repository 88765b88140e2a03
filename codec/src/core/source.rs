//! Where arbitrary values come from.

/// A supply of integers, of which [`Uper::arbitrary`](super::Uper::arbitrary) makes values.
///
/// A source that can give every integer within the bounds makes every value of a type. Under Kani it
/// is a symbolic one, in tests a random one or one that reads bytes:
///
/// ```
/// use crossguard_codec::core::Source;
///
/// struct Symbolic;
///
/// # #[cfg(kani)]
/// impl Source for Symbolic {
///     fn integer(&mut self, low: i64, high: i64) -> i64 {
///         let number = kani::any();
///         kani::assume(low <= number && number <= high);
///         number
///     }
/// }
/// ```
pub trait Source {
    /// Any integer from `low` to `high`, both included; `low` is not above `high`.
    fn integer(&mut self, low: i64, high: i64) -> i64;

    /// Any index or size from `low` to `high`.
    fn index(&mut self, low: usize, high: usize) -> usize {
        usize::try_from(self.integer(low as i64, high as i64)).unwrap_or(low)
    }

    /// Either.
    fn flip(&mut self) -> bool {
        self.integer(0, 1) == 1
    }
}
