//! Where the robots of a demonstration meet: all of it on the loopback interface.

use std::net::{Ipv4Addr, SocketAddr};

use crossguard_robot::transport::{Halves, Link, LinkError, Transport, WithFaults};

use super::Options;

/// Ports that a demonstration may begin at: the usual one is the first.
const PORTS: std::ops::RangeInclusive<u16> = 47_401..=65_500;

/// The links of a demonstration, one for each robot: open, before any robot says anything.
pub struct Links {
    /// Port of the first robot; the others have the next ones.
    pub first_port: u16,
    pub(super) halves: Vec<Halves>,
}

impl Links {
    /// Opens a link for each robot, from the first port of the options, or from the first that is free with those after it.
    ///
    /// # Errors
    ///
    /// When a port is in use, or none is free.
    pub fn open(options: &Options, robots: usize) -> Result<Self, LinkError> {
        from_a_free_port(options.port, robots, |first_port| {
            let halves = open(options, first_port, robots)?;
            Ok(Self { first_port, halves })
        })
    }
}

/// Opens so many ports in a row: from the port given, or from the first at which all are free.
fn from_a_free_port<T>(
    port: Option<u16>,
    robots: usize,
    open: impl Fn(u16) -> Result<T, LinkError>,
) -> Result<T, LinkError> {
    if let Some(port) = port {
        return open(port);
    }
    let is_taken = |it: &Result<T, _>| matches!(it, Err(LinkError::InUse { .. }));
    let mut tries = PORTS.step_by(robots.max(1)).map(&open);
    let free = tries.find(|it| !is_taken(it));
    free.unwrap_or_else(|| open(*PORTS.start()))
}

fn open(options: &Options, first: u16, robots: usize) -> Result<Vec<Halves>, LinkError> {
    let ports = || (first..).take(robots);
    let open = |(port, seed): (u16, u64)| -> Result<Halves, LinkError> {
        let peers = ports().filter(|peer| *peer != port);
        let peers = peers.map(|peer| SocketAddr::from((Ipv4Addr::LOCALHOST, peer)));
        let link = Link::loopback(port, peers.collect());
        let seed = options.seed.wrapping_add(seed);
        let halves = WithFaults::new(link, options.faults.clone(), seed).open()?;
        #[cfg(feature = "full")]
        let halves = match &options.capture {
            Some(capture) => capture.of_sent(halves),
            None => halves,
        };
        Ok(halves)
    };
    ports().zip(100..).map(open).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn point_9_a_demonstration_takes_other_ports_than_those_that_are_taken() {
        let open = |first| {
            let link = |port| Link::loopback(port, Vec::new());
            let both = [link(first).open()?, link(first + 1).open()?];
            Ok((first, both))
        };
        let (first, [one, _held]) = from_a_free_port(None, 2, open).unwrap();
        drop(one);
        let (next, _) = from_a_free_port(None, 2, open).unwrap();
        assert!(next > first && (next - first).is_multiple_of(2), "{next}");
        assert!(from_a_free_port(Some(next), 2, open).is_ok());
        assert!(from_a_free_port(Some(first), 2, open).is_err());
    }
}
