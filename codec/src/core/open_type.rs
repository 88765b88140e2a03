//! Open types: an extension addition of a CHOICE that is known (X.691 clauses 11.2 and 23.8).

use super::Uper;
use super::reader::{Faults, Read, Reader};
use super::writer::Writer;

/// Octets of a value in an open type. All values of `T` have the same size, an integer's.
const fn octets<T: Uper>() -> u32 {
    let octets = T::MAX_BITS.div_ceil(8);
    assert!(0 < octets && octets < 0x80);
    octets
}

/// Bits of the alternative behind the extension bit: index, length, value.
pub(super) const fn addition_bits<T: Uper>() -> u32 {
    7 + 8 + 8 * octets::<T>()
}

/// Writes the alternative that is addition `index` of a CHOICE, with the extension bit.
pub(super) fn encode_addition<'a, T: Uper>(
    value: &T,
    index: usize,
    writer: Writer<'a>,
) -> Writer<'a> {
    debug_assert!(index < 64);
    let writer = writer.bits(1 << 7 | index as u32, 1 + 7);
    let writer = writer.bits(const { octets::<T>() }, 8);
    let start = writer.position();
    value.encode(writer).padding(start)
}

/// Reads the value in an open type.
pub(super) fn decode<T: Uper, F: Faults>(reader: Reader<'_, F>) -> Read<'_, T, F> {
    let (outer, reader) = reader.open();
    let mut value = T::LOWEST;
    let reader = value.read(reader);
    (value, reader.close(outer))
}
