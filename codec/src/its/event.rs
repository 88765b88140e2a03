//! What happened on the road, as a DENM tells, in SI units.

use std::fmt;

use serde::Serialize;

use super::{Cause, ItsMessage};
use crate::asn1::denm::{DENM, Termination};
use crate::si;
use crate::state::Position;

/// An event on the road, as its newest message tells.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Event {
    /// The station that noticed it first, and with `number` names it.
    pub originator: u32,
    /// The originator's number for it.
    pub number: u16,
    /// What it is; not told of one that is over.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cause: Option<Cause>,
    /// Where it is.
    pub position: Position,
    /// When it was noticed, as `TimestampIts`.
    pub detected_its: u64,
    /// When this was said of it, as `TimestampIts`; what is said later counts.
    pub referenced_its: u64,
    /// For how many seconds from its detection on it is to be believed in.
    pub validity_s: u32,
    /// Whether it is over, and who says so.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub termination: Option<Termination>,
}

impl ItsMessage {
    /// What happened on the road, if this message is a DENM.
    #[must_use]
    pub fn event(&self) -> Option<Event> {
        match self {
            Self::Denm(denm) => Some(Event::from(&**denm)),
            _ => None,
        }
    }
}

impl From<&DENM> for Event {
    fn from(denm: &DENM) -> Self {
        let management = &denm.denm.management;
        let position = &management.event_position;
        let situation = denm.denm.situation.as_ref();
        Self {
            originator: management.action_id.originating_station_id.0,
            number: management.action_id.sequence_number.0,
            cause: situation.map(|situation| (&situation.event_type).into()),
            position: Position {
                latitude: si::LATITUDE.decode(position.latitude.0),
                longitude: si::longitude_degrees(position.longitude.0),
                ..Position::default()
            },
            detected_its: management.detection_time.0,
            referenced_its: management.reference_time.0,
            validity_s: management.validity_duration.0,
            termination: management.termination,
        }
    }
}

/// `collisionRisk, 48.765432 9.123457, event 1 of station 5, for 600 s`.
impl fmt::Display for Event {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.termination {
            Some(Termination::isCancellation) => f.write_str("cancelled: ")?,
            Some(Termination::isNegation) => f.write_str("negated: ")?,
            None => {}
        }
        if let Some(cause) = self.cause {
            write!(f, "{cause}, ")?;
        }
        if let (Some(latitude), Some(longitude)) = (self.position.latitude, self.position.longitude)
        {
            write!(f, "{latitude:.6} {longitude:.6}, ")?;
        }
        write!(f, "event {} of station {}", self.number, self.originator)?;
        match self.termination {
            Some(_) => Ok(()),
            None => write!(f, ", for {} s", self.validity_s),
        }
    }
}
