//! The table `[link]` of a robot file: by what it reaches the others.

use std::net::{SocketAddr, SocketAddrV4};

use serde::Deserialize;

use super::Impossibility;
use crate::attachment::Sends;
use crate::transport::{Framing, Link};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LinkTable {
    address: Option<SocketAddr>,
    #[serde(default)]
    peers: Vec<SocketAddr>,
    multicast: Option<SocketAddrV4>,
    interface: Option<String>,
    ethernet: Option<String>,
    framing: Option<Framing>,
    unit: Option<SocketAddr>,
    sends: Option<Sends>,
}

impl LinkTable {
    pub(super) fn check(self) -> Result<Link, Impossibility> {
        let framing = self.framing.unwrap_or_default();
        // A peer is none that no datagram can be sent to.
        let to = self.peers.iter().chain(&self.unit);
        let is_nobody = |to: &&SocketAddr| to.ip().is_unspecified() || to.port() == 0;
        if let Some(nobody) = to.into_iter().find(is_nobody) {
            return Err(Impossibility::Peer(*nobody));
        }
        let is_own = |to: &&SocketAddr| {
            self.address.is_some_and(|own| {
                let is_this = own.ip() == to.ip();
                let is_here = own.ip().is_unspecified() && to.ip().is_loopback();
                own.port() == to.port() && (is_this || is_here)
            })
        };
        if let Some(own) = self.peers.iter().chain(&self.unit).find(is_own) {
            return Err(Impossibility::OwnAddress(*own));
        }
        let what = (self.address, self.multicast, self.ethernet);
        let more = (self.unit, self.interface, self.peers.is_empty());
        let link = match (what, more) {
            ((Some(address), None, None), (None, None, _)) => Link::Peers {
                address,
                peers: self.peers,
                framing,
            },
            ((None, Some(group), None), (None, Some(interface), true)) => Link::Multicast {
                group,
                interface,
                framing,
            },
            ((None, None, Some(interface)), (None, None, true)) if self.framing.is_none() => {
                Link::Ethernet { interface }
            }
            ((address, None, None), (Some(unit), None, true)) if self.framing.is_none() => {
                return Ok(Link::Unit {
                    unit,
                    address,
                    sends: self.sends.unwrap_or_default(),
                });
            }
            _ => return Err(Impossibility::Link),
        };
        // Only a unit may be given something else than packets.
        self.sends.map_or(Ok(link), |_| Err(Impossibility::Link))
    }
}
