//! Frames on the serial line: a kind, the length as two octets with the higher first, and so many octets.

use crate::board::Board;

/// The longest frame that is taken in: any packet fits.
pub(crate) const FRAME_MAX: usize = 2_048;

/// A packet, in both directions.
pub(crate) const PACKET: u8 = b'P';
/// What the robot is to be, from outside.
pub(crate) const MISSION: u8 = b'M';
/// Lines of the log, to the outside.
pub(crate) const LOG: u8 = b'L';
/// A word for people, to the outside.
pub(crate) const SAYS: u8 = b'S';
/// The crossing is over, to the outside.
pub(crate) const END: u8 = b'E';

/// Frames as they come.
pub(crate) struct Frames {
    octets: [u8; 3 + FRAME_MAX],
    length: usize,
}

impl Frames {
    /// The next frame that is whole, if there is one: its kind and its octets.
    pub(crate) fn next(&mut self, board: &mut Board) -> Option<(u8, &[u8])> {
        loop {
            let octet = board.get()?;
            self.octets[self.length] = octet;
            self.length += 1;
            let [kind, high, low, ..] = self.octets;
            let wanted = usize::from(u16::from_be_bytes([high, low]));
            if self.length >= 3 && wanted > FRAME_MAX {
                self.length = 0;
            } else if self.length >= 3 && self.length == 3 + wanted {
                self.length = 0;
                return Some((kind, &self.octets[3..3 + wanted]));
            }
        }
    }
}

/// Sends a frame; what is longer than its length field goes in several.
pub(crate) fn send(board: &mut Board, kind: u8, octets: &[u8]) {
    for part in octets.chunks(usize::from(u16::MAX)) {
        let length = u16::try_from(part.len()).unwrap_or(u16::MAX);
        let [high, low] = length.to_be_bytes();
        for octet in [kind, high, low].iter().chain(part) {
            board.put(*octet);
        }
    }
}
