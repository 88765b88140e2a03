//! The services of a station: which port, permission and kind of packet each message has.
//!
//! Ports are those of TS 103 248 v2.4.1, ITS-AIDs those of TS 102 965 v2.4.1. What is not assigned
//! comes from [`Identifiers`].

use serde::{Deserialize, Serialize};

use crate::geonet::{Lifetime, Request, TrafficClass};
use crate::identifiers::Identifiers;
use crate::named;

named! {
    /// A service that sends and receives messages.
    #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
    #[serde(rename_all = "UPPERCASE")]
    pub enum Service {
        /// Robot awareness.
        Ram = "RAM",
        /// Robot maneuver coordination.
        Rmcm = "RMCM",
        /// Cooperative awareness of vehicles.
        Cam = "CAM",
        /// Decentralized environmental notification.
        Denm = "DENM",
        /// Awareness of vulnerable road users.
        Vam = "VAM",
        /// Collective perception.
        Cpm = "CPM",
    }
}

impl Service {
    /// Messages that the kit names and does not decode, by their BTP-B ports (TS 103 248, table 2).
    pub const FOREIGN: [(u16, &str); 8] = [
        (2_002, "DENM"),
        (2_003, "MAPEM"),
        (2_004, "SPATEM"),
        (2_005, "SAEM"),
        (2_006, "IVIM"),
        (2_007, "SREM"),
        (2_008, "SSEM"),
        (2_013, "RTCMEM"),
    ];

    /// Its BTP-B port.
    #[must_use]
    pub const fn port(self, identifiers: &Identifiers) -> u16 {
        match self {
            Self::Ram => identifiers.ram.btp_port,
            Self::Rmcm => identifiers.rmcm.btp_port,
            Self::Cam => 2_001,
            Self::Denm => 2_002,
            Self::Vam => 2_018,
            Self::Cpm => 2_009,
        }
    }

    /// The ITS-AID (PSID) that permits to send its messages.
    #[must_use]
    pub const fn its_aid(self, identifiers: &Identifiers) -> u32 {
        match self {
            Self::Ram => identifiers.ram.its_aid,
            Self::Rmcm => identifiers.rmcm.its_aid,
            Self::Cam => 36,
            Self::Denm => 37,
            Self::Vam => 638,
            Self::Cpm => 639,
        }
    }

    /// The service at a port.
    #[must_use]
    pub fn at_port(identifiers: &Identifiers, port: u16) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|service| service.port(identifiers) == port)
    }

    /// The message of another service at a port: one of [`Self::FOREIGN`].
    #[must_use]
    pub fn foreign_at_port(port: u16) -> Option<&'static str> {
        let found = Self::FOREIGN.into_iter().find(|(known, _)| *known == port);
        found.map(|(_, name)| name)
    }

    /// How its messages are sent: to everybody in reach, with a lifetime of a second and the DCC
    /// profile of CAM; commands and answers go before them.
    #[must_use]
    pub const fn request(self, identifiers: &Identifiers) -> Request {
        let profile = match self {
            Self::Rmcm | Self::Denm => 1,
            Self::Ram | Self::Cam | Self::Vam | Self::Cpm => 2,
        };
        Request {
            port: self.port(identifiers),
            port_info: 0,
            its_aid: self.its_aid(identifiers),
            traffic_class: TrafficClass::of_profile(profile),
            lifetime: Lifetime::of_milliseconds(1_000),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_port_leads_to_its_service() {
        let identifiers = Identifiers::default();
        for service in Service::ALL {
            let port = service.port(&identifiers);
            assert_eq!(Service::at_port(&identifiers, port), Some(service));
        }
        assert_eq!(Service::at_port(&identifiers, 2_003), None);
    }
}
