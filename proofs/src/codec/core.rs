//! The core of the codec: what reads and writes bits, and each container of RAM and RMCM.

pub mod bits;
pub mod status;

use crossguard_codec::core::Uper;

#[cfg(not(all(kani, not(feature = "stand-in"))))]
use crate::stand_in::Arbitrary;
use crate::{Symbolic, kani};

impl crossguard_codec::core::Source for Symbolic {
    fn integer(&mut self, low: i64, high: i64) -> i64 {
        let number = kani::any();
        #[cfg(not(all(kani, not(feature = "stand-in"))))]
        let number = crate::stand_in::between(number, low, high);
        kani::assume(low <= number && number <= high);
        number
    }
}

/// Any octets; under the stand-in often those of a value, or nearly so.
#[cfg(all(kani, not(feature = "stand-in")))]
fn any_octets<T: Uper, const N: usize>() -> [u8; N] {
    kani::any()
}

/// Any octets; under the stand-in often those of a value, or nearly so.
#[cfg(not(all(kani, not(feature = "stand-in"))))]
fn any_octets<T: Uper, const N: usize>() -> [u8; N] {
    let mut octets = <[u8; N]>::any();
    if kani::any() {
        octets = [0; N];
        let _ = crossguard_codec::core::encode(&T::arbitrary(&mut Symbolic), &mut octets);
    }
    if kani::any() {
        octets[kani::any::<usize>() % N] ^= 1 << (kani::any::<u8>() % 8);
    }
    octets
}

/// Any value.
fn any_value<T: Uper>() -> T {
    T::arbitrary(&mut Symbolic)
}
