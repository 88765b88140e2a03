//! Finds `GeoNetworking` packets in the frames of a capture, by its link type (tcpdump's list of LINKTYPE values).

use crossguard_codec::geonet::ethernet::{self, ETHERTYPE};
use pcap_file::DataLink;

/// Ethertypes of tags in front of the ethertype proper (IEEE 802.1Q, 802.1ad).
const TAGS: [u16; 2] = [0x8100, 0x88a8];
const IPV4: u16 = 0x0800;
const IPV6: u16 = 0x86dd;
const UDP: u8 = 17;
/// LLC and SNAP in front of an ethertype (RFC 1042).
const SNAP: [u8; 6] = [0xaa, 0xaa, 3, 0, 0, 0];

/// Finds the packet in a frame.
type Find = fn(&[u8]) -> Option<&[u8]>;

/// How the frames of a link are taken apart; `None` where the kit cannot do that.
pub(super) fn reader_of(link: DataLink) -> Option<Find> {
    Some(match link {
        DataLink::ETHERNET => |frame| behind_ethertype(without_check_sequence(frame).get(12..)?),
        DataLink::IEEE802_11 => |frame| in_802_11(without_check_sequence(frame)),
        DataLink::IEEE802_11_RADIOTAP => |frame| {
            let length = u16::from_le_bytes(*frame.get(2..)?.first_chunk()?);
            in_802_11(without_check_sequence(frame.get(length.into()..)?))
        },
        DataLink::LINUX_SLL => |frame| behind_ethertype(frame.get(14..)?),
        DataLink::LINUX_SLL2 => |frame| {
            let (ethertype, _) = frame.split_first_chunk()?;
            of_ethertype(u16::from_be_bytes(*ethertype), frame.get(20..)?)
        },
        DataLink::RAW | DataLink::IPV4 | DataLink::IPV6 => in_ip,
        _ => return None,
    })
}

/// The frame without its check sequence, where the capture has it: the CRC-32 of all octets before.
fn without_check_sequence(frame: &[u8]) -> &[u8] {
    match frame.split_last_chunk::<4>() {
        Some((checked, sequence)) if crc32fast::hash(checked).to_le_bytes() == *sequence => checked,
        _ => frame,
    }
}

/// In a data frame that is not encrypted (IEEE 802.11, 9.2 and 9.3.2.1).
fn in_802_11(frame: &[u8]) -> Option<&[u8]> {
    let control = u16::from_le_bytes(*frame.first_chunk()?);
    let has = |bit: u16| control & bit != 0;
    let (is_data, is_null, is_encrypted) = (control & 0x0c == 0x08, has(0x40), has(0x4000));
    if !is_data || is_null || is_encrypted {
        return None;
    }
    let (is_relayed, has_quality) = (control & 0x0300 == 0x0300, has(0x80));
    let high_throughput = has_quality && has(0x8000);
    let length = 24
        + 6 * usize::from(is_relayed)
        + 2 * usize::from(has_quality)
        + 4 * usize::from(high_throughput);
    let body = frame.get(length..)?;
    // The ethertype stands behind SNAP (EN 302 663), or alone (IEEE 802.11, OCB since 2016).
    behind_ethertype(body.strip_prefix(&SNAP).unwrap_or(body))
}

fn behind_ethertype(octets: &[u8]) -> Option<&[u8]> {
    let (ethertype, rest) = octets.split_first_chunk()?;
    of_ethertype(u16::from_be_bytes(*ethertype), rest)
}

fn of_ethertype(ethertype: u16, rest: &[u8]) -> Option<&[u8]> {
    match ethertype {
        ETHERTYPE => Some(rest),
        IPV4 | IPV6 => in_ip(rest),
        tag if TAGS.contains(&tag) => behind_ethertype(rest.get(2..)?),
        _ => None,
    }
}

/// In a UDP datagram in a whole IP packet, as robots send by `[link]`: with an Ethernet header in front or without.
fn in_ip(packet: &[u8]) -> Option<&[u8]> {
    let segment = match packet.first()? >> 4 {
        4 => {
            let is_fragment = u16::from_be_bytes(*packet.get(6..)?.first_chunk()?) & 0x3fff != 0;
            let is_udp = packet.get(9) == Some(&UDP) && !is_fragment;
            packet
                .get(usize::from(packet[0] & 0xf) * 4..)
                .filter(|_| is_udp)
        }
        6 => packet.get(40..).filter(|_| packet[6] == UDP),
        _ => None,
    }?;
    let length = u16::from_be_bytes(*segment.get(4..)?.first_chunk()?);
    let datagram = segment.get(8..length.into())?;
    // Other programs send datagrams as well: this is the first octet of a basic header.
    let is_packet = |octets: &&[u8]| octets.first().is_some_and(|it| matches!(it, 0x10..=0x12));
    let packet = ethernet::packet(datagram).map_or(datagram, |(_, packet)| packet);
    Some(packet).filter(is_packet)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A basic header of version 1, and what may follow.
    const PACKET: &[u8] = &[0x11, 0, 5, 1, 0x20, 0x50, 7];

    fn with_ethertype(ethertype: u16) -> Vec<u8> {
        [&ethertype.to_be_bytes()[..], PACKET].concat()
    }

    fn udp(payload: &[u8]) -> Vec<u8> {
        let length = u16::try_from(8 + payload.len()).unwrap().to_be_bytes();
        [&[0xb9, 0x28, 0xb9, 0x28], &length[..], &[0, 0], payload].concat()
    }

    fn ipv4(protocol: u8, fragment: u8, payload: &[u8]) -> Vec<u8> {
        let mut header = [0; 24];
        header[0] = 0x46;
        (header[7], header[9]) = (fragment, protocol);
        [&header[..], &udp(payload)].concat()
    }

    fn ipv6(payload: &[u8]) -> Vec<u8> {
        let mut header = [0; 40];
        (header[0], header[6]) = (0x60, UDP);
        [&header[..], &udp(payload)].concat()
    }

    fn data(control: u16, more: usize, body: &[u8]) -> Vec<u8> {
        let header = [&control.to_le_bytes()[..], &vec![0; 22 + more]].concat();
        [&header[..], body].concat()
    }

    fn radiotap(frame: &[u8]) -> Vec<u8> {
        [&[0, 0, 9, 0, 2, 0, 0, 0, 0x10], frame].concat()
    }

    #[test]
    fn packets_are_found_behind_every_link_layer_that_is_read() {
        let addresses = [2; 12];
        let plain = with_ethertype(ETHERTYPE);
        let ethernet = [&addresses[..], &plain].concat();
        let snap = [&SNAP[..], &plain].concat();
        // The CRC-32 of `ethernet` and of a frame of 802.11, by Python's zlib.
        let ethernet_checked = [&ethernet[..], &[0x20, 0xd1, 0x2d, 0x90]].concat();
        let data_checked = [&data(0x0088, 2, &snap)[..], &[0x61, 0xc8, 0x81, 0x3d]].concat();
        let tagged = |tags: &[u8]| [&addresses[..], tags, &plain].concat();
        let cooked = |protocol: &[u8]| [&[0; 14][..], protocol].concat();
        let in_cooked = [&IPV4.to_be_bytes()[..], &ipv4(UDP, 0, PACKET)].concat();
        let version_2 = [&ETHERTYPE.to_be_bytes()[..], &[0; 18], PACKET].concat();
        let (ip, air) = (DataLink::RAW, DataLink::IEEE802_11);
        let air_checked = DataLink::IEEE802_11_RADIOTAP;
        let two_tags = [0x88, 0xa8, 0, 5, 0x81, 0, 0, 6];
        let found: &[(&str, DataLink, Vec<u8>)] = &[
            ("Ethernet", DataLink::ETHERNET, ethernet.clone()),
            ("its check sequence", DataLink::ETHERNET, ethernet_checked),
            ("802.1Q", DataLink::ETHERNET, tagged(&[0x81, 0, 0, 5])),
            ("802.1ad", DataLink::ETHERNET, tagged(&two_tags)),
            ("802.11, QoS", air, data(0x0088, 2, &snap)),
            ("802.11 without QoS", air, data(0x0008, 0, &snap)),
            ("802.11, relayed", air, data(0x0388, 8, &snap)),
            ("802.11, high throughput", air, data(0x8088, 6, &snap)),
            ("802.11, ethertype alone", air, data(0x0088, 2, &plain)),
            ("radiotap", air_checked, radiotap(&data_checked)),
            ("Linux cooked", DataLink::LINUX_SLL, cooked(&plain)),
            ("Linux cooked, version 2", DataLink::LINUX_SLL2, version_2),
            ("raw IPv4", ip, ipv4(UDP, 0, PACKET)),
            ("raw IPv6", ip, ipv6(PACKET)),
            ("IPv4", DataLink::IPV4, ipv4(UDP, 0, &ethernet)),
            ("IPv6", DataLink::IPV6, ipv6(PACKET)),
            (
                "UDP in Linux cooked",
                DataLink::LINUX_SLL,
                cooked(&in_cooked),
            ),
        ];
        for (name, link, frame) in found {
            let read = reader_of(*link).expect(name);
            assert_eq!(read(frame), Some(PACKET), "{name}");
            for length in 0..frame.len() {
                // Nothing panics.
                let _ = read(&frame[..length]);
            }
        }
    }

    #[test]
    fn frames_without_a_packet_have_none() {
        let snap = [&SNAP[..], &with_ethertype(ETHERTYPE)].concat();
        let arp = [&[2; 12][..], &with_ethertype(0x0806)].concat();
        let (ip, air) = (DataLink::RAW, DataLink::IEEE802_11);
        let none: &[(&str, DataLink, Vec<u8>)] = &[
            ("ARP", DataLink::ETHERNET, arp),
            ("a beacon", air, data(0x0080, 0, &snap)),
            ("an encrypted frame", air, data(0x4088, 2, &snap)),
            ("a frame without data", air, data(0x00c8, 2, &snap)),
            ("TCP", ip, ipv4(6, 0, PACKET)),
            ("a fragment", ip, ipv4(UDP, 1, PACKET)),
            ("another program's datagram", ip, ipv4(UDP, 0, b"GET /")),
        ];
        for (name, link, frame) in none {
            assert_eq!(reader_of(*link).expect(name)(frame), None, "{name}");
        }
        assert!(reader_of(DataLink::USB_LINUX).is_none());
    }
}
