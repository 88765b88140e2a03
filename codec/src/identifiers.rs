//! Identifiers that no standard has assigned, and versions that no header tells, in one place.
//!
//! RAM and RMCM have no messageId, BTP port or ITS-AID of their own, and the common data dictionary
//! has no station type for robots. The defaults are experimental: message identifiers without a name
//! in TS 102 894-2 v2.4.1, ports that TS 103 248 v2.4.1 does not assign, ITS-AIDs from the testing
//! range of TS 102 965. All stations of a channel have to agree on them, and this one value
//! changes them.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::Service;

/// The identifiers of RAM and RMCM. JSON is in `camelCase`, configuration files are in `snake_case`; both are read.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct Identifiers {
    /// Identifiers of the robot awareness message.
    pub ram: MessageIdentifiers,
    /// Identifiers of the robot maneuver coordination message.
    pub rmcm: MessageIdentifiers,
    /// Station type of a robot in the basic container; 12, `lightVruVehicle`, by default: the
    /// nearest that receivers know.
    #[serde(alias = "robot_station_type")]
    pub robot_station_type: u8,
    /// The common data dictionary that VAM and CPM on the channel are built on.
    pub dictionary: Dictionary,
}

/// A version of the common data dictionary (TS 102 894-2). The header of a VAM or CPM is the same with
/// both, and what is behind it is not.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default, Serialize, Deserialize)]
pub enum Dictionary {
    /// v2.1.1: VAM of TS 103 300-3 v2.2.1, and CPM of TS 103 324 v2.1.1 as it was published.
    #[serde(rename = "2.1.1")]
    V2_1_1,
    /// v2.4.1, with the same bits as v2.2.1 and v2.3.1: VAM of TS 103 300-3 v2.3.1.
    #[default]
    #[serde(rename = "2.4.1")]
    V2_4_1,
}

/// The identifiers of one message.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct MessageIdentifiers {
    /// `protocolVersion` of the header: the version of the message's format; 1 by default.
    #[serde(alias = "protocol_version")]
    pub protocol_version: u8,
    /// `messageId` of the header, above 21; 240 for RAM and 241 for RMCM by default.
    #[serde(alias = "message_id")]
    pub message_id: u8,
    /// Destination port of BTP-B, above 2026; 2998 for RAM and 2999 for RMCM by default.
    #[serde(alias = "btp_port")]
    pub btp_port: u16,
    /// ITS-AID (PSID) that its certificates are for; 16480 for RAM and 16481 for RMCM by default.
    #[serde(alias = "its_aid")]
    pub its_aid: u32,
}

/// The largest messageId that TS 102 894-2 v2.4.1 assigns.
const ASSIGNED_MESSAGE_ID_MAX: u8 = 21;
/// The largest port that TS 103 248 v2.4.1 assigns.
const ASSIGNED_PORT_MAX: u16 = 2026;

impl Default for Identifiers {
    fn default() -> Self {
        Self {
            ram: MessageIdentifiers {
                protocol_version: 1,
                message_id: 240,
                btp_port: 2998,
                its_aid: 16_480,
            },
            rmcm: MessageIdentifiers {
                protocol_version: 1,
                message_id: 241,
                btp_port: 2999,
                its_aid: 16_481,
            },
            robot_station_type: 12,
            dictionary: Dictionary::default(),
        }
    }
}

/// Identifiers that cannot be told from others.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Error)]
pub enum IdentifierClash {
    /// Both messages have this messageId.
    #[error("RAM and RMCM have the same messageId {0}")]
    SameMessageId(u8),
    /// Both messages have this port.
    #[error("RAM and RMCM have the same BTP port {0}")]
    SamePort(u16),
    /// Two services have this ITS-AID.
    #[error("two services have the ITS-AID {0}; RAM and RMCM want one of their own each")]
    SameItsAid(u32),
    /// Another message of ETSI has this messageId.
    #[error(
        "messageId {0} is assigned to another message, use one above {ASSIGNED_MESSAGE_ID_MAX}"
    )]
    AssignedMessageId(u8),
    /// Another service of ETSI has this port.
    #[error("BTP port {0} is assigned to another service, use one above {ASSIGNED_PORT_MAX}")]
    AssignedPort(u16),
}

impl Identifiers {
    /// Checks that RAM and RMCM can be told from each other and from the messages of ETSI. Call it
    /// once for a configuration that was read.
    ///
    /// # Errors
    /// The first clash.
    pub fn check(&self) -> Result<(), IdentifierClash> {
        if self.ram.message_id == self.rmcm.message_id {
            return Err(IdentifierClash::SameMessageId(self.ram.message_id));
        }
        if self.ram.btp_port == self.rmcm.btp_port {
            return Err(IdentifierClash::SamePort(self.ram.btp_port));
        }
        for (at, service) in Service::ALL.into_iter().enumerate() {
            let its_aid = service.its_aid(self);
            if Service::ALL[..at]
                .iter()
                .any(|it| it.its_aid(self) == its_aid)
            {
                return Err(IdentifierClash::SameItsAid(its_aid));
            }
        }
        for message in [&self.ram, &self.rmcm] {
            if message.message_id <= ASSIGNED_MESSAGE_ID_MAX {
                return Err(IdentifierClash::AssignedMessageId(message.message_id));
            }
            if message.btp_port <= ASSIGNED_PORT_MAX {
                return Err(IdentifierClash::AssignedPort(message.btp_port));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_defaults_clash_with_nothing() {
        assert_eq!(Identifiers::default().check(), Ok(()));
    }

    #[test]
    fn identifiers_that_cannot_be_told_apart_are_refused() {
        let mut identifiers = Identifiers::default();
        identifiers.ram.message_id = identifiers.rmcm.message_id;
        assert_eq!(
            identifiers.check(),
            Err(IdentifierClash::SameMessageId(241))
        );
        identifiers.ram.message_id = 2; // CAM
        assert_eq!(
            identifiers.check(),
            Err(IdentifierClash::AssignedMessageId(2))
        );
        identifiers = Identifiers::default();
        identifiers.rmcm.btp_port = 2001; // CAM
        assert_eq!(
            identifiers.check(),
            Err(IdentifierClash::AssignedPort(2001))
        );
        identifiers.ram.btp_port = 2001;
        assert_eq!(identifiers.check(), Err(IdentifierClash::SamePort(2001)));
        // The ITS-AIDs of RAM by default, and of CAM.
        for its_aid in [16_480, 36] {
            identifiers = Identifiers::default();
            identifiers.rmcm.its_aid = its_aid;
            let clash = IdentifierClash::SameItsAid(its_aid);
            assert_eq!(identifiers.check(), Err(clash));
        }
    }

    #[test]
    fn a_configuration_names_only_what_it_changes() {
        let json = r#"{"robotStationType": 10}"#;
        let identifiers: Identifiers = serde_json::from_str(json).unwrap();
        assert_eq!(
            identifiers,
            Identifiers {
                robot_station_type: 10,
                ..Identifiers::default()
            }
        );
    }
}
