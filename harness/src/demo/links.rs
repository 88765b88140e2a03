//! Where the robots of a demonstration meet: all of it on the loopback interface.

use std::net::{Ipv4Addr, SocketAddr};

use crossguard_robot::transport::{
    Framing, Halves, Link, LinkError, Transport, WithFaults, Zenoh, ZenohMode, ZenohRouter,
};
use serde::Serialize;

use super::Options;

/// How robots meet over zenoh.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Meeting {
    /// Each is connected to each other.
    Peer,
    /// Each is connected to a router only, which runs beside them.
    Router,
}

/// The links of all robots, open.
pub(super) struct Links {
    /// One for each robot.
    pub(super) halves: Vec<Halves>,
    /// What they meet through, which goes on until it is dropped.
    pub(super) router: Option<ZenohRouter>,
}

/// Opens a link for each robot.
pub(super) fn open(options: &Options, robots: usize) -> Result<Links, LinkError> {
    let address = |port| SocketAddr::from((Ipv4Addr::LOCALHOST, port));
    let addresses: Vec<_> = (options.port..).take(robots).map(address).collect();
    let router = match options.zenoh {
        Some(Meeting::Router) => Some(ZenohRouter::open(&Zenoh {
            listen: endpoints(&addresses[..1]),
            ..Zenoh::new(ZenohMode::Router)
        })?),
        _ => None,
    };
    let open = |(nth, seed): (usize, u64)| -> Result<Halves, LinkError> {
        let link = link(options.zenoh, &addresses, nth);
        let seed = options.seed.wrapping_add(seed);
        let halves = WithFaults::new(link, options.faults.clone(), seed).open()?;
        Ok(match &options.capture {
            Some(capture) => capture.of_sent(halves),
            None => halves,
        })
    };
    let halves = (0..robots).zip(100..).map(open);
    Ok(Links {
        halves: halves.collect::<Result<_, _>>()?,
        router,
    })
}

/// The link of the robot whose address is the `nth`.
fn link(zenoh: Option<Meeting>, addresses: &[SocketAddr], nth: usize) -> Link {
    let address = addresses[nth];
    match zenoh {
        None => {
            let peers = addresses.iter().filter(|&&peer| peer != address);
            Link::Peers {
                address,
                peers: peers.copied().collect(),
                framing: Framing::default(),
            }
        }
        // Those before it listen already.
        Some(Meeting::Peer) => Link::Zenoh(Zenoh {
            listen: endpoints(&[address]),
            connect: endpoints(&addresses[..nth]),
            ..Zenoh::new(ZenohMode::Peer)
        }),
        Some(Meeting::Router) => Link::Zenoh(Zenoh {
            connect: endpoints(&addresses[..1]),
            ..Zenoh::new(ZenohMode::Client)
        }),
    }
}

fn endpoints(addresses: &[SocketAddr]) -> Vec<String> {
    let endpoint = |address| format!("tcp/{address}");
    addresses.iter().map(endpoint).collect()
}
