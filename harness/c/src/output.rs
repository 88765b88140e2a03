//! Outputs of the protocol as plain data.

use crossguard_codec::{Target, TaskParameters};
use crossguard_protocol::words::Said;
use crossguard_protocol::{
    FallbackPolicy, Millis, NoticeKind, Output, OutputKind, SessionId, SessionNumber, StationId,
    TaskType, Unavailability, UniqueNumber,
};

use crate::abi::{
    CROSSGUARD_NO_LANE, CrossguardOutput, CrossguardOutputKind as Kind, CrossguardSession,
    CrossguardTaskParameters,
};
use crate::body::{known, or_nan};
use crate::place::PlainPlace;

/// Parameters that leave everything to the follower.
pub(crate) const OPEN: CrossguardTaskParameters = CrossguardTaskParameters {
    latitude_deg: f64::NAN,
    longitude_deg: f64::NAN,
    altitude_m: f64::NAN,
    heading_deg: f64::NAN,
    maximum_speed_mps: f64::NAN,
    pedestrian_distance_m: f64::NAN,
    validity_ms: 0,
    lane: CROSSGUARD_NO_LANE,
    is_offset: 0,
    map_kind: PlainPlace::NOWHERE.map_kind,
    has_map_region: PlainPlace::NOWHERE.has_map_region,
    map_region: PlainPlace::NOWHERE.map_region,
    map_id: PlainPlace::NOWHERE.map_id,
    reserved: [0; 4],
};

impl Default for CrossguardTaskParameters {
    fn default() -> Self {
        OPEN
    }
}

impl CrossguardOutput {
    pub(crate) fn of(kind: Kind) -> Self {
        Self {
            kind: kind as u8,
            ..Self::default()
        }
    }

    /// The plain form of `output`; `None` for one that becomes a packet. `parameters` are those of the command that
    /// the input may be.
    pub(crate) fn from_protocol(output: &Output, parameters: &TaskParameters) -> Option<Self> {
        let said = Said::by(output);
        let parameters = match said.kind {
            OutputKind::SendRam | OutputKind::SendRmcm => return None,
            OutputKind::StartManeuver => parameters.into(),
            _ => OPEN,
        };
        Some(Self {
            kind: said.kind.code(),
            notice: said.notice.map_or(0, NoticeKind::code),
            reason: said.reason.map_or(0, |reason| reason.code),
            unavailability: said.unavailability.map_or(0, Unavailability::code),
            policy: said.policy.map_or(0, FallbackPolicy::code),
            task: said.task.map_or(0, TaskType::value),
            request: said.request.map_or(0, |request| request.0),
            station: said.station.map_or(0, |station| station.0),
            session: said.session.map(Into::into).unwrap_or_default(),
            open_ms: said.open.map_or(0, |left| left.0),
            parameters,
            ..Self::default()
        })
    }
}

impl From<SessionId> for CrossguardSession {
    fn from(session: SessionId) -> Self {
        Self {
            leader: session.leader.0,
            number: session.number.0.to_u32(),
        }
    }
}

impl From<CrossguardSession> for SessionId {
    fn from(session: CrossguardSession) -> Self {
        Self {
            leader: StationId(session.leader),
            number: SessionNumber(UniqueNumber::from_u32(session.number)),
        }
    }
}

impl From<&TaskParameters> for CrossguardTaskParameters {
    fn from(parameters: &TaskParameters) -> Self {
        let PlainPlace {
            map_kind,
            has_map_region,
            map_region,
            map_id,
        } = PlainPlace::of(parameters.map_place);
        let mut plain = Self {
            map_kind,
            has_map_region,
            map_region,
            map_id,
            heading_deg: or_nan(parameters.heading),
            maximum_speed_mps: or_nan(parameters.maximum_speed),
            pedestrian_distance_m: or_nan(parameters.minimum_pedestrian_distance),
            validity_ms: parameters.validity.map_or(0, |validity| validity.0),
            ..OPEN
        };
        match parameters.target {
            None => {}
            Some(Target::Lane(lane)) => plain.lane = lane,
            Some(
                Target::Position {
                    latitude,
                    longitude,
                    altitude,
                }
                | Target::Offset {
                    latitude,
                    longitude,
                    altitude,
                },
            ) => {
                plain.latitude_deg = latitude;
                plain.longitude_deg = longitude;
                plain.altitude_m = or_nan(altitude);
                plain.is_offset = matches!(parameters.target, Some(Target::Offset { .. })).into();
            }
        }
        plain
    }
}

impl CrossguardTaskParameters {
    /// The parameters in the codec's form; `None` where a target or place of the map cannot be told from another.
    pub(crate) fn to_codec(self) -> Option<TaskParameters> {
        let place = known(self.latitude_deg).zip(known(self.longitude_deg));
        let altitude = known(self.altitude_m);
        let has_lane = self.lane != CROSSGUARD_NO_LANE;
        let target = match (place, has_lane, self.is_offset) {
            (None, false, 0 | 1) => None,
            (None, true, 0) if (-1..=14).contains(&self.lane) => Some(Target::Lane(self.lane)),
            (Some((latitude, longitude)), false, 0) => Some(Target::Position {
                latitude,
                longitude,
                altitude,
            }),
            (Some((latitude, longitude)), false, 1) => Some(Target::Offset {
                latitude,
                longitude,
                altitude,
            }),
            _ => return None,
        };
        let map_place = PlainPlace {
            map_kind: self.map_kind,
            has_map_region: self.has_map_region,
            map_region: self.map_region,
            map_id: self.map_id,
        };
        let map_place = map_place.to_codec().ok()?;
        Some(TaskParameters {
            target,
            heading: known(self.heading_deg),
            maximum_speed: known(self.maximum_speed_mps),
            minimum_pedestrian_distance: known(self.pedestrian_distance_m),
            validity: (self.validity_ms != 0).then_some(Millis(self.validity_ms)),
            map_place,
        })
    }
}
