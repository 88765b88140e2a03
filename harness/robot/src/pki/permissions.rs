//! Permissions in the tickets of robots.

use crossguard_codec::security::{Permission, Ssp};
use crossguard_codec::{Identifiers, Part, Service};
use crossguard_protocol::StationId;

/// The ITS-AIDs of all services that the kit knows.
#[must_use]
pub fn its_aids(identifiers: &Identifiers) -> Vec<u32> {
    let its_aids = Service::ALL.map(|service| service.its_aid(identifiers));
    its_aids.to_vec()
}

/// Service specific permissions for CAM (EN 302 637-2): version 1, and none of the containers and
/// causes that only some vehicles may use.
const CAM_PERMISSIONS: [u8; 3] = [1, 0, 0];

/// Service specific permissions for VAM: version 1 alone.
const VAM_PERMISSIONS: [u8; 1] = [1];

/// The permissions of a robot that takes these parts in sessions: for RAM and RMCM, and for the CAM and
/// cluster VAM by which it speaks to stations that know neither. It goes by the station id that is `named`, or else
/// by one that follows from the ticket.
#[must_use]
pub fn robot_permissions(
    identifiers: &Identifiers,
    parts: &[Part],
    named: Option<StationId>,
) -> Vec<Permission> {
    let parts = match named {
        None => Part::bitmap(parts).to_vec(),
        Some(station) => Part::bitmap_naming(parts, station).to_vec(),
    };
    let services: [(Service, &[u8]); 4] = [
        (Service::Ram, &parts),
        (Service::Rmcm, &parts),
        (Service::Cam, &CAM_PERMISSIONS),
        (Service::Vam, &VAM_PERMISSIONS),
    ];
    services
        .map(|(service, bits)| Permission {
            its_aid: service.its_aid(identifiers),
            ssp: Ssp::Bitmap(bits.to_vec()),
        })
        .to_vec()
}
