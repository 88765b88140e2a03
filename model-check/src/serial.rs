//! Serial numbers in the order of RFC 1982, for what judges: written once more, and not asked of the protocol.

use crossguard_protocol::{Heartbeat, RequestId};

/// Whether a heartbeat, of 16 bits, is newer than one that is known.
pub(crate) const fn beat_is_newer(beat: Heartbeat, known: Heartbeat) -> bool {
    matches!(beat.0.wrapping_sub(known.0), 1..0x8000)
}

/// Whether a request, of 8 bits, is newer than one that is known.
pub(crate) const fn request_is_newer(request: RequestId, known: RequestId) -> bool {
    matches!(request.0.wrapping_sub(known.0), 1..0x80)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn newer_is_less_than_half_the_numbers_ahead() {
        for known in [0, 1, 0x7fff, 0x8000, u16::MAX] {
            let is_newer = |by| beat_is_newer(Heartbeat(known.wrapping_add(by)), Heartbeat(known));
            assert_eq!(
                [0, 1, 0x7fff, 0x8000, 0x8001, u16::MAX].map(is_newer),
                [false, true, true, false, false, false]
            );
        }
        for known in [0, 1, 0x7f, 0x80, u8::MAX] {
            let is_newer =
                |by| request_is_newer(RequestId(known.wrapping_add(by)), RequestId(known));
            assert_eq!(
                [0, 1, 0x7f, 0x80, 0x81, u8::MAX].map(is_newer),
                [false, true, true, false, false, false]
            );
        }
    }
}
