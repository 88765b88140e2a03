//! The core of the codec: what reads and writes bits, and each container of RAM and RMCM.
//!
//! Every harness of a container is about the container as a message of its own, in a buffer of exactly
//! its maximum length.

pub mod bits;
pub mod cdd;
pub mod common;
pub mod ram;
pub mod rmcm;
pub mod whole;

#[cfg(all(kani, not(feature = "stand-in")))]
use crossguard_codec::core::{Faults, Read, Reader};
use crossguard_codec::core::{Uper, laws};

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

/// Any value comes back, and takes no more than the maximum length.
fn values<T: Uper, const N: usize>(class: fn(&T) -> bool) {
    let value = T::arbitrary(&mut Symbolic);
    laws::encode_then_decode_is_identity::<T, N>(&value);
    let is_one = class(&value);
    kani::cover!(is_one, "one class");
    kani::cover!(!is_one, "the other class");
}

/// Any octets up to the maximum length are refused, or the one encoding of a value.
fn octets<T: Uper, const N: usize>() {
    let octets: [u8; N] = any_octets::<T, N>();
    let length = usize::from(kani::any::<u8>()) % (N + 1);
    let is_accepted = laws::decode_then_encode_is_identity::<T, N>(&octets[..length]);
    kani::cover!(is_accepted, "accepted");
    kani::cover!(!is_accepted, "refused");
}

/// Any value is refused when octets are missing at its end.
fn cuts<T: Uper, const N: usize>() {
    let value = T::arbitrary(&mut Symbolic);
    let cut = usize::from(kani::any::<u8>()) % (N + 1);
    laws::truncated_is_an_error::<T, N>(&value, cut);
    kani::cover!(0 < cut && cut < N, "in the middle");
}

/// In the place of [`Reader::skip_additions`]: restricts a harness to octets without extension
/// additions.
#[cfg(all(kani, not(feature = "stand-in")))]
fn no_additions<'a, F: Faults>(reader: Reader<'a, F>) -> Reader<'a, F>
where
    'a: 'a,
{
    kani::assume(false);
    reader
}

/// In the place of [`Reader::skip_additions`]: proves that no encoding of a value leads there.
#[cfg(all(kani, not(feature = "stand-in")))]
fn never<'a, F: Faults>(_: Reader<'a, F>) -> Reader<'a, F>
where
    'a: 'a,
{
    panic!("an extension bit was written")
}

/// In the place of [`Reader::bits`]: any number of this many bits, whatever the octets are.
#[cfg(all(kani, not(feature = "stand-in")))]
fn any_bits<'a, F: Faults>(reader: Reader<'a, F>, count: u32) -> Read<'a, u32, F>
where
    'a: 'a,
{
    assert!(count <= 32);
    let number = kani::any();
    kani::assume(u64::from(number) >> count == 0);
    (number, reader.skip(count as usize))
}

/// In the place of [`Reader::skip_additions`]: skips any number of bits, or more than there are.
#[cfg(all(kani, not(feature = "stand-in")))]
fn any_skip<'a, F: Faults>(reader: Reader<'a, F>) -> Reader<'a, F>
where
    'a: 'a,
{
    reader.skip(usize::from(kani::any::<u16>()))
}

/// Declares the harnesses of containers, each with how often Kani unwinds its loops: all values, and what must be among
/// them; any octets up to the maximum length, without extension additions; all values, and every cut.
macro_rules! containers {
    (
        comes_back { $($back:ident($value:ty, $value_unwind:literal, $class:expr);)+ }
        is_canonical { $($canonical:ident($coded:ty, $coded_unwind:literal);)+ }
        $(cut_short_is_refused { $($cut:ident($whole:ty, $whole_unwind:literal);)+ })?
    ) => {
        $crate::harness::harnesses! {
            $(
                #[doc = concat!("All values of `", stringify!($value), "`.")]
                #[unwind($value_unwind)]
                #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::never)]
                fn $back() {
                    super::values::<$value, { crossguard_codec::core::max_octets::<$value>() }>($class);
                }
            )+
            $(
                #[doc = concat!("Any octets that are to be a `", stringify!($coded), "`.")]
                #[unwind($coded_unwind)]
                #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::no_additions)]
                fn $canonical() {
                    super::octets::<$coded, { crossguard_codec::core::max_octets::<$coded>() }>();
                }
            )+
            $($(
                #[doc = concat!("All values of `", stringify!($whole), "`, cut anywhere.")]
                #[unwind($whole_unwind)]
                #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::never)]
                fn $cut() {
                    super::cuts::<$whole, { crossguard_codec::core::max_octets::<$whole>() }>();
                }
            )+)?
        }
    };
}

use containers;
