//! Where the robots of a demonstration meet: all of it on the loopback interface.

use std::net::{Ipv4Addr, SocketAddr};

use crossguard_robot::transport::{Framing, Halves, Link, LinkError, Transport, WithFaults};

use super::Options;

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
