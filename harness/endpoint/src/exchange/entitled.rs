//! Whether a message may say what it says, by the permissions of its certificate and the name of its sender.

use core::fmt::{self, Display, Formatter};

use crossguard_codec::geonet::{Indication, Permits};
use crossguard_codec::{Heard, Part};
use crossguard_protocol::{Input, StationId};

use super::host::{Host, Moment};
use crate::cause::Cause;

/// Why a message of a sender that may be relied on is dropped all the same.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum NotEntitled {
    /// Another certificate goes by this station id.
    Namesake(StationId),
    /// The certificate does not permit this part in a session.
    Part(Part),
}

impl Display for NotEntitled {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Namesake(station) => write!(f, "station {station} goes by another certificate"),
            Self::Part(part) => write!(f, "the certificate does not permit to {}", part.name()),
        }
    }
}

impl From<NotEntitled> for Cause {
    fn from(why: NotEntitled) -> Self {
        Self::Rejected(match why {
            NotEntitled::Namesake(_) => "station id of another certificate",
            NotEntitled::Part(_) => "beyond service permissions",
        })
    }
}

/// Whether a message may say what it says, in the name of its sender.
pub(super) fn check_entitled<H: Host>(
    host: &mut H,
    moment: Moment,
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
    match indication.signer {
        Some(signer) if !host.admits(moment, heard.from, signer) => {
            Err(NotEntitled::Namesake(heard.from))
        }
        _ => Ok(()),
    }
}

fn check_parts(permits: Permits, parts: impl IntoIterator<Item = Part>) -> Result<(), NotEntitled> {
    let mut parts = parts.into_iter();
    match parts.find(|part| !permits.allows(part.bit())) {
        Some(part) => Err(NotEntitled::Part(part)),
        None => Ok(()),
    }
}
