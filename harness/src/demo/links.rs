//! Where the robots of a demonstration meet: all of it on the loopback interface.

use std::net::{Ipv4Addr, SocketAddr, UdpSocket};

use crossguard_robot::transport::{Framing, Halves, Link, LinkError, Transport, WithFaults};

use super::Options;

/// Ports that a demonstration may begin at: the usual one is the first.
const PORTS: std::ops::RangeInclusive<u16> = 47_401..=65_500;

/// The first of so many free ports in a row, from the usual one on; that one where there are none.
#[must_use]
pub fn free_ports(robots: usize) -> u16 {
    let is_free = |port| UdpSocket::bind((Ipv4Addr::LOCALHOST, port)).is_ok();
    let mut starts = PORTS.step_by(robots.max(1));
    let found = starts.find(|first| (*first..).take(robots).all(is_free));
    found.unwrap_or(*PORTS.start())
}

/// Opens a link for each robot.
pub(super) fn open(options: &Options, robots: usize) -> Result<Vec<Halves>, LinkError> {
    let address = |port| SocketAddr::from((Ipv4Addr::LOCALHOST, port));
    let addresses: Vec<_> = (options.port..).take(robots).map(address).collect();
    let open = |(&address, seed): (&SocketAddr, u64)| -> Result<Halves, LinkError> {
        let peers = addresses.iter().filter(|&&peer| peer != address);
        let link = Link::Peers {
            address,
            peers: peers.copied().collect(),
            framing: Framing::default(),
        };
        let seed = options.seed.wrapping_add(seed);
        let halves = WithFaults::new(link, options.faults.clone(), seed).open()?;
        Ok(match &options.capture {
            Some(capture) => capture.of_sent(halves),
            None => halves,
        })
    };
    addresses.iter().zip(100..).map(open).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn point_9_a_demonstration_takes_other_ports_than_those_that_are_taken() {
        let first = free_ports(2);
        let _taken = UdpSocket::bind((Ipv4Addr::LOCALHOST, first + 1)).unwrap();
        let next = free_ports(2);
        assert!(next > first && (next - first).is_multiple_of(2), "{next}");
    }
}
