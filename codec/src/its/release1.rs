//! CAM with `protocolVersion` 1: EN 302 637-2 v1.3.2 on TS 102 894-2 v1.2.1.
//!
//! Its bits are those of version 2 but for three types: a `CurvatureValue` has 16 bits and the unit 1/30,000 per metre, which is
//! rewritten before rasn reads it. `CauseCode` and `ClosedLanes` stand in the last part, `specialVehicleContainer`, alone, which is
//! left out, and so are additions.

use crate::asn1::{self, cam::CAM};
use crate::error::{DecodeError, FieldPath};
use crate::message::Received;

/// Extension marker and presence bit of the special vehicle container, behind header and `generationDeltaTime`.
const CAM_ENDS: [usize; 2] = [64, 66];
/// `HighFrequencyContainer`: 00 where it is that of a vehicle.
const HIGH_FREQUENCY: usize = CAM_ENDS[0] + 3 + 9 + POSITION;
/// `curvatureValue`: behind heading, speed, direction, length, width and acceleration.
const CURVATURE: usize = HIGH_FREQUENCY + 2 + 7 + 19 + 21 + 2 + 13 + 6 + 16;
/// `ReferencePosition`.
const POSITION: usize = 31 + 32 + 36 + 24;
/// Reads a CAM of version 1.
pub(super) fn cam(octets: &[u8]) -> Result<Received<CAM>, DecodeError> {
    let mut bits = Bits::of(octets);
    let is_cut = bits.clear(&CAM_ENDS);
    if let Some([false, false]) = bits.0.get(HIGH_FREQUENCY..HIGH_FREQUENCY + 2)
        && let Some(curvature) = bits.0.get(CURVATURE..CURVATURE + 16)
    {
        let value = curvature
            .iter()
            .fold(0, |sum, bit| 2 * sum + i32::from(*bit))
            - 30_000;
        let per_10_km = match value {
            30_001 => 1_023,
            value => (value / 3).clamp(-1_023, 1_022),
        };
        let bit = |at: i32| (per_10_km + 1_023) >> (10 - at) & 1 == 1;
        bits.0.splice(CURVATURE..CURVATURE + 16, (0..11).map(bit));
    }
    read(&bits, is_cut)
}

/// The message in these bits of version 2, and of what `is_cut` off only the front.
fn read<T: rasn::Decode + PartialEq>(
    bits: &Bits,
    is_cut: bool,
) -> Result<Received<T>, DecodeError> {
    let (message, count) = asn1::decode_front(&bits.octets(false))?;
    // The last octet is filled up, and nothing of the message may be in what fills it.
    if asn1::decode_front(&bits.octets(true))
        .map(|it| it.0)
        .as_ref()
        != Ok(&message)
    {
        return Err(DecodeError::Foreign {
            field: FieldPath::default(),
            cause: "truncated",
            detail: "the message ends within its last field".to_owned(),
        });
    }
    // Padding moves by the bits that were put in and taken out.
    if !is_cut && count > 1 {
        return Err(DecodeError::TrailingOctets { count });
    }
    // Which encoding of version 1 is the canonical one is not judged.
    Ok(Received {
        message,
        extended: usize::from(is_cut),
        is_canonical: true,
    })
}

/// The bits of a message.
struct Bits(Vec<bool>);

impl Bits {
    fn of(octets: &[u8]) -> Self {
        let bits = octets
            .iter()
            .flat_map(|octet| (0..8).rev().map(move |at| octet >> at & 1 == 1));
        Self(bits.collect())
    }

    /// Clears these; whether any was set.
    fn clear(&mut self, these: &[usize]) -> bool {
        let mut was_set = false;
        for at in these {
            if let Some(bit) = self.0.get_mut(*at) {
                was_set |= std::mem::take(bit);
            }
        }
        was_set
    }

    /// In whole octets, the last one filled up.
    fn octets(&self, fill: bool) -> Vec<u8> {
        let octet = |bits: &[bool]| {
            let bits = bits.iter().chain(std::iter::repeat(&fill)).take(8);
            bits.fold(0, |octet, bit| octet << 1 | u8::from(*bit))
        };
        self.0.chunks(8).map(octet).collect()
    }
}
