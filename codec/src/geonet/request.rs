//! How a message is to be sent: by single-hop broadcast, to everybody who hears it.

use super::{Lifetime, TrafficClass};

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
}
