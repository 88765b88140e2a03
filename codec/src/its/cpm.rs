//! CPM with its containers taken apart.

use serde::{Deserialize, Serialize};

use super::put;
use crate::asn1::cdd211::PerceivedObjectContainer211;
use crate::asn1::cpm::{
    CollectivePerceptionMessage, CpmContainerData, CpmContainerId, CpmPayload, ManagementContainer,
    OriginatingRsuContainer, OriginatingVehicleContainer, PerceivedObjectContainer,
    PerceptionRegionContainer, SensorInformationContainer, WrappedCpmContainer,
    WrappedCpmContainers,
};
use crate::asn1::{self, cdd};
use crate::error::{DecodeError, EncodeError};
use crate::identifiers::{Dictionary, Identifiers};
use crate::message::Received;
use crate::message::sealed::Sealed;

/// A collective perception message.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct CPM {
    /// Its header.
    pub header: cdd::ItsPduHeader,
    /// Where and when its sender perceived.
    pub management_container: ManagementContainer,
    /// Containers, 1 to 8: objects that it perceived, and its sensors.
    pub cpm_containers: Vec<CpmContainer>,
}

/// A container of a CPM.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum CpmContainer {
    /// The sender is a vehicle.
    OriginatingVehicleContainer(OriginatingVehicleContainer),
    /// The sender is a road-side unit.
    OriginatingRsuContainer(OriginatingRsuContainer),
    /// The sensors.
    SensorInformationContainer(SensorInformationContainer),
    /// Regions that they see, and how well.
    PerceptionRegionContainer(PerceptionRegionContainer),
    /// Objects that they see.
    PerceivedObjectContainer(PerceivedObjectContainer),
    /// Objects that they see, on the dictionary v2.1.1.
    PerceivedObjectContainer211(PerceivedObjectContainer211),
    /// A container that no standard had defined when this was written.
    Unknown {
        /// Its number, 6 to 16.
        id: CpmContainerId,
        /// Its octets.
        data: CpmContainerData,
    },
}

impl CPM {
    /// The dictionary that its perceived objects are built on, if it has any.
    #[must_use]
    pub fn dictionary(&self) -> Option<Dictionary> {
        self.cpm_containers
            .iter()
            .find_map(|container| match container {
                CpmContainer::PerceivedObjectContainer(_) => Some(Dictionary::V2_4_1),
                CpmContainer::PerceivedObjectContainer211(_) => Some(Dictionary::V2_1_1),
                _ => None,
            })
    }
}

impl CpmContainer {
    fn wrap(&self) -> Result<WrappedCpmContainer, EncodeError> {
        let (id, octets) = match self {
            Self::OriginatingVehicleContainer(container) => (1, asn1::encode(container)?),
            Self::OriginatingRsuContainer(container) => (2, asn1::encode(container)?),
            Self::SensorInformationContainer(container) => (3, asn1::encode(container)?),
            Self::PerceptionRegionContainer(container) => (4, asn1::encode(container)?),
            Self::PerceivedObjectContainer(container) => (5, asn1::encode(container)?),
            Self::PerceivedObjectContainer211(container) => (5, asn1::encode(container)?),
            Self::Unknown { id, data } => (id.0, data.0.to_vec()),
        };
        let data = CpmContainerData(octets.into());
        Ok(WrappedCpmContainer::new(CpmContainerId(id), data))
    }

    /// The container, and whether its encoding was canonical.
    fn unwrap(
        dictionary: Dictionary,
        wrapped: WrappedCpmContainer,
    ) -> Result<(Self, bool), DecodeError> {
        fn of<C: rasn::Decode + rasn::Encode>(
            octets: &[u8],
            wrap: impl FnOnce(C) -> CpmContainer,
        ) -> Result<(CpmContainer, bool), DecodeError> {
            let decoded = asn1::decode(octets)?;
            Ok((wrap(decoded.value), decoded.is_canonical))
        }
        let octets = &wrapped.container_data.0;
        match (wrapped.container_id.0, dictionary) {
            (1, _) => of(octets, Self::OriginatingVehicleContainer),
            (2, _) => of(octets, Self::OriginatingRsuContainer),
            (3, _) => of(octets, Self::SensorInformationContainer),
            (4, _) => of(octets, Self::PerceptionRegionContainer),
            (5, Dictionary::V2_4_1) => of(octets, Self::PerceivedObjectContainer),
            (5, Dictionary::V2_1_1) => of(octets, Self::PerceivedObjectContainer211),
            _ => {
                let (id, data) = (wrapped.container_id, wrapped.container_data);
                Ok((Self::Unknown { id, data }, true))
            }
        }
    }
}

impl Sealed for CPM {
    fn write(&self, buffer: &mut [u8]) -> Result<usize, EncodeError> {
        let containers: Result<Vec<_>, _> =
            self.cpm_containers.iter().map(CpmContainer::wrap).collect();
        let payload = CpmPayload::new(
            self.management_container.clone(),
            WrappedCpmContainers(containers?),
        );
        let message = CollectivePerceptionMessage::new(self.header.clone(), payload);
        put(&asn1::encode(&message)?, buffer)
    }

    fn read(identifiers: &Identifiers, octets: &[u8]) -> Result<Received<Self>, DecodeError> {
        let decoded = asn1::decode::<CollectivePerceptionMessage>(octets)?;
        let mut is_canonical = decoded.is_canonical;
        let CollectivePerceptionMessage { header, payload } = decoded.value;
        let mut cpm_containers = Vec::with_capacity(payload.cpm_containers.0.len());
        for wrapped in payload.cpm_containers.0 {
            let (container, is_so) = CpmContainer::unwrap(identifiers.dictionary, wrapped)?;
            is_canonical &= is_so;
            cpm_containers.push(container);
        }
        let message = Self {
            header,
            management_container: payload.management_container,
            cpm_containers,
        };
        Ok(Received {
            message,
            extended: 0,
            is_canonical,
        })
    }
}
