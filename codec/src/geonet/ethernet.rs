//! Packets in Ethernet frames (TS 102 636-4-2): for raw sockets, and for files that Wireshark reads.

/// The ethertype of `GeoNetworking`.
pub const ETHERTYPE: u16 = 0x8947;
/// Octets in front of the packet: destination, source, ethertype.
pub const HEADER_LEN: usize = 14;

/// The header of a frame to everybody.
#[must_use]
pub fn header(source: [u8; 6]) -> [u8; HEADER_LEN] {
    let mut header = [0xFF; HEADER_LEN];
    header[6..12].copy_from_slice(&source);
    header[12..].copy_from_slice(&ETHERTYPE.to_be_bytes());
    header
}

/// The packet in a frame, and the frame's source; `None` when it carries something else.
///
/// A frame of less than 60 octets is padded on its way; no packet with a message is as short as that.
#[must_use]
pub fn packet(frame: &[u8]) -> Option<([u8; 6], &[u8])> {
    let (header, packet) = frame.split_first_chunk::<HEADER_LEN>()?;
    let source = header[6..12].try_into().ok()?;
    (header[12..] == ETHERTYPE.to_be_bytes()).then_some((source, packet))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geonet::Address;

    #[test]
    fn a_packet_comes_back_from_its_frame() {
        let source = Address::of_station(7, 5).link_layer;
        let frame = [&header(source)[..], b"packet"].concat();
        assert_eq!(frame[..6], [0xFF; 6]);
        assert_eq!(packet(&frame), Some((source, &b"packet"[..])));
        let mut other = frame;
        other[12] = 0x08;
        assert_eq!(packet(&other), None);
        assert_eq!(packet(&other[..13]), None);
    }
}
