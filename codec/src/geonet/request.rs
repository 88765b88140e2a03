//! How a message is to be sent.

use super::{Area, Lifetime, TrafficClass};

/// How a message is to be sent.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Request {
    /// BTP-B destination port.
    pub port: u16,
    /// BTP-B destination port info.
    pub port_info: u16,
    /// The ITS-AID that permits it.
    pub its_aid: u32,
    /// Its traffic class.
    pub traffic_class: TrafficClass,
    /// How long the packet may live.
    pub lifetime: Lifetime,
    /// Its destination.
    pub destination: Destination,
}

/// Destination of a message.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Destination {
    /// Everybody who hears it: single-hop broadcast.
    Neighbours,
    /// Everybody in an area: geo-broadcast.
    Area {
        /// The area.
        area: Area,
        /// Over how many hops, at least 1; `itsGnDefaultHopLimit` is 10.
        hop_limit: u8,
    },
}
