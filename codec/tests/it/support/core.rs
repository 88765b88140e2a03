//! What the tests of the core share: a random source of values.

use crossguard_codec::core::{Source, Uper, encode};

/// A random source that often gives the lowest and the highest number.
pub struct Random(pub u64);

impl Random {
    /// The next number of the `SplitMix64` generator.
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut mixed = self.0;
        mixed = (mixed ^ mixed >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ mixed >> 31
    }

    pub fn octets(&mut self, length: usize) -> Vec<u8> {
        (0..length).map(|_| self.next().to_be_bytes()[0]).collect()
    }
}

impl Source for Random {
    fn integer(&mut self, low: i64, high: i64) -> i64 {
        match self.next() % 8 {
            0 => low,
            1 => high,
            _ => {
                let values = high.abs_diff(low) + 1;
                low.checked_add_unsigned(self.next() % values).unwrap()
            }
        }
    }
}

/// The encoding of a value of the core.
pub fn octets_of<T: Uper>(value: &T) -> Vec<u8> {
    let mut buffer = [0; 1_024];
    let length = encode(value, &mut buffer).unwrap();
    buffer[..length].to_vec()
}

/// Flips up to three bits, and cuts the end or makes it longer, each with some probability.
pub fn mutate(mut octets: Vec<u8>, random: &mut Random) -> Vec<u8> {
    for _ in 0..random.index(0, 3) {
        let bit = random.index(0, octets.len() * 8 - 1);
        octets[bit / 8] ^= 0x80 >> (bit % 8);
    }
    match random.index(0, 4) {
        0 => octets.truncate(random.index(0, octets.len())),
        1 => octets.resize(octets.len() + random.index(1, 3), 0),
        _ => {}
    }
    octets
}
