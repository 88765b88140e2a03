//! Reader and writer of bits.

use crossguard_codec::core::{Reader, Whether, laws};

use crate::harness::harnesses;
use crate::kani;

harnesses! {
    /// Any number of up to 32 bits at any bit of an octet, between up to 7 and up to 8 bits.
    #[unwind(5)]
    fn bits_are_read_as_written() {
        let before = (kani::any(), kani::any::<u32>() % 8);
        let number: (u32, u32) = (kani::any(), kani::any());
        let after = (kani::any(), kani::any::<u32>() % 9);
        laws::bits_are_read_as_written(before, number, after);
        kani::cover!(before.1 == 7 && number.1 % 33 == 32, "across a window");
        kani::cover!(before.1 + number.1 % 33 == 0, "no bits");
    }

    /// Any count of bits up to 32, at any position of up to nine octets, and behind them.
    #[unwind(2)]
    fn reading_stops_at_the_end() {
        let octets: [u8; 9] = kani::any();
        let length = usize::from(kani::any::<u8>()) % 10;
        let position = usize::from(kani::any::<u8>()) % 80;
        let count = kani::any::<u32>() % 33;
        laws::reading_stops_at_the_end(&octets[..length], position, count);
        kani::cover!(position + count as usize == length * 8, "up to the end");
        kani::cover!(position + count as usize > length * 8, "behind the end");
    }

    /// Any octets, up to twelve bits in front, any count of bits up to 32.
    #[unwind(10)]
    fn what_is_ahead_decides() {
        let octets: [u8; 9] = kani::any();
        let before = usize::from(kani::any::<u8>()) % 13;
        let is_there = laws::what_is_ahead_decides(&octets, before, kani::any());
        kani::cover!(is_there && before == 12, "in the second octet");
    }

    /// All bounds of at most 32 bits, and all bits.
    #[unwind(2)]
    fn integers_keep_their_bounds() {
        let min = i64::from(kani::any::<i32>());
        let largest = kani::any::<u32>() >> (kani::any::<u32>() % 32);
        let max = min + i64::from(largest);
        laws::integers_keep_their_bounds(min, max, kani::any());
        kani::cover!(largest > 255, "many");
        kani::cover!(largest < 255, "few");
    }

    /// Up to six octets.
    #[unwind(5)]
    fn skipping_additions_is_total() {
        let mut octets: [u8; 6] = kani::any();
        let length = usize::from(kani::any::<u8>()) % 7;
        if kani::any() {
            octets[..3].copy_from_slice(&[1, 1, 0]);
        }
        laws::skipping_additions_is_total(&octets[..length]);
        let is_skipped = !Reader::<Whether>::new(&octets[..length]).skip_additions().has_failed();
        kani::cover!(is_skipped, "skipped");
        kani::cover!(!is_skipped, "refused");
    }
}
