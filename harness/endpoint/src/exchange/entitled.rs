//! Whether a message may say what it says, by the permissions of its certificate and the station id that goes with it.
//!
//! The station id of a robot follows from its ticket, and its address from its station id. So one ticket is one robot:
//! its holder cannot speak as another one, or as two, and what a session knows of a member is what the member's
//! own ticket has said. (Without a signature nobody vouches for anything, and nothing is checked.)

use crossguard_codec::geonet::{Address, Indication, Permits};
use crossguard_codec::{Heard, Identifiers, Part};
use crossguard_protocol::{Input, StationId};

use super::host::Host;
use crate::cause::Cause;

/// Why a message of a sender that may be relied on is dropped all the same.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub enum NotEntitled {
    /// The certificate goes by another station id.
    #[error("speaks as station {says}, with the certificate of station {is}")]
    Namesake {
        /// The station id in the message.
        says: StationId,
        /// The station id in the certificate.
        is: StationId,
    },
    /// The packet comes from the address of another station.
    #[error("station {0} has another address")]
    Address(StationId),
    /// The certificate does not permit this part in a session.
    #[error("the certificate does not permit to {}", .0.name())]
    Part(Part),
    /// The station has its part in the session under another certificate.
    #[error("station {0} has its part in the session under another certificate")]
    Unpinned(StationId),
}

impl From<NotEntitled> for Cause {
    fn from(why: NotEntitled) -> Self {
        Self::Rejected(match why {
            NotEntitled::Namesake { .. } => "station id of another certificate",
            NotEntitled::Address(_) => "address of another station",
            NotEntitled::Part(_) => "beyond service permissions",
            NotEntitled::Unpinned(_) => "another certificate than in the session",
        })
    }
}

/// Whether a message may say what it says, in the name of its sender.
pub(super) fn check_entitled<H: Host>(
    host: &mut H,
    identifiers: &Identifiers,
    indication: &Indication<'_>,
    heard: &Heard,
) -> Result<(), NotEntitled> {
    let permits = indication.permits;
    for input in heard.inputs.iter() {
        match input {
            Input::Ram { ram, .. } => check_parts(permits, Part::of_ram(ram))?,
            Input::Rmcm(rmcm) => check_parts(permits, [Part::of_rmcm(rmcm)])?,
            _ => {}
        }
    }
    let Some(is) = indication.vouched_for() else {
        return Ok(());
    };
    if heard.from != is {
        let says = heard.from;
        return Err(NotEntitled::Namesake { says, is });
    }
    let address = Address::of_station(is.0, identifiers.robot_station_type);
    // A vehicle that answers has another station type.
    if indication.source.address.link_layer != address.link_layer {
        return Err(NotEntitled::Address(is));
    }
    if let Some(signer) = indication.signer {
        host.vouched(is, (signer, address));
    }
    Ok(())
}

fn check_parts(permits: Permits, parts: impl IntoIterator<Item = Part>) -> Result<(), NotEntitled> {
    let mut parts = parts.into_iter();
    match parts.find(|part| !permits.allows(part.bit())) {
        Some(part) => Err(NotEntitled::Part(part)),
        None => Ok(()),
    }
}
