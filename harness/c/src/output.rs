//! Outputs of the protocol as plain data.

use crossguard_codec::{Target, TaskParameters};
use crossguard_protocol::{
    FallbackPolicy, Maneuver, ManeuverId, Millis, Notice, Output, SessionId, SessionNumber,
    StationId, UniqueNumber,
};

use crate::abi::{
    CROSSGUARD_NO_LANE, CrossguardFallback, CrossguardNotice as Code, CrossguardOutput,
    CrossguardOutputKind as Kind, CrossguardSession, CrossguardTaskParameters,
};
use crate::body::{known, or_nan};
use crate::place::PlainPlace;
use crate::why::{Why, unavailability};

/// An output with nothing in it.
const NOTHING: CrossguardOutput = CrossguardOutput {
    kind: 0,
    notice: 0,
    reason: 0,
    unavailability: 0,
    policy: 0,
    task: 0,
    request: 0,
    message: 0,
    station: 0,
    session: CrossguardSession {
        leader: 0,
        number: 0,
    },
    packet_offset: 0,
    packet_length: 0,
    message_offset: 0,
    message_length: 0,
    port: 0,
    traffic_class: 0,
    open_ms: 0,
    reserved: [0; 4],
    parameters: OPEN,
};

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

impl CrossguardOutput {
    /// An output of this kind.
    pub(crate) const fn of(kind: Kind) -> Self {
        Self {
            kind: kind as u8,
            ..NOTHING
        }
    }

    fn because(self, why: impl Into<Why>) -> Self {
        let why = why.into();
        Self {
            reason: why.reason as u8,
            station: why.station.map_or(self.station, |station| station.0),
            unavailability: unavailability(why.unavailability),
            ..self
        }
    }

    fn in_session(self, session: SessionId) -> Self {
        Self {
            session: session.into(),
            ..self
        }
    }

    fn about(self, id: ManeuverId) -> Self {
        Self {
            request: id.request.0,
            ..self.in_session(id.session)
        }
    }

    fn maneuver(self, maneuver: Maneuver) -> Self {
        Self {
            task: maneuver.task.value(),
            ..self.about(maneuver.id)
        }
    }

    fn news(notice: Code) -> Self {
        Self {
            notice: notice as u8,
            ..Self::of(Kind::Notice)
        }
    }

    const fn open_for(self, left: Millis) -> Self {
        Self {
            open_ms: left.0,
            ..self
        }
    }

    fn at(self, station: StationId) -> Self {
        Self {
            station: station.0,
            ..self
        }
    }

    /// What `output` says; `None` for what becomes a packet. `parameters` are those of the command that
    /// the input may be.
    pub(crate) fn from_protocol(output: &Output, parameters: &TaskParameters) -> Option<Self> {
        Some(match *output {
            Output::SendRam | Output::SendRmcm(_) => return None,
            Output::StartManeuver(maneuver) => Self {
                parameters: parameters.into(),
                ..Self::of(Kind::StartManeuver).maneuver(maneuver)
            },
            Output::StopManeuver(maneuver, why) => {
                Self::of(Kind::StopManeuver).maneuver(maneuver).because(why)
            }
            Output::FallBack(maneuver, policy) => Self {
                policy: policy_code(policy),
                ..Self::of(Kind::FallBack).maneuver(maneuver)
            },
            Output::CorridorOpened(left) => Self::of(Kind::CorridorOpened).open_for(left),
            Output::CorridorExtended(left) => Self::of(Kind::CorridorExtended).open_for(left),
            Output::CorridorClosed(why) => Self::of(Kind::CorridorClosed).because(why),
            Output::LockIdentity => Self::of(Kind::LockIdentity),
            Output::UnlockIdentity => Self::of(Kind::UnlockIdentity),
            Output::RenewEpoch => Self::of(Kind::RenewEpoch),
            Output::Notify(notice) => Self::notice(notice),
            Output::Ignored(why) => Self::of(Kind::Ignored).because(why),
        })
    }

    fn notice(notice: Notice) -> Self {
        let news = Self::news;
        match notice {
            Notice::RolesEstablished(session) => news(Code::RolesEstablished).in_session(session),
            Notice::FollowerJoined(station) => news(Code::FollowerJoined).at(station),
            Notice::FollowerGone(station, why) => news(Code::FollowerGone).at(station).because(why),
            Notice::LeaseGranted(station) => news(Code::LeaseGranted).at(station),
            Notice::LeaseExpired(station) => news(Code::LeaseExpired).at(station),
            Notice::CommandAcknowledged(station, id) => {
                news(Code::CommandAcknowledged).at(station).about(id)
            }
            Notice::CommandRejected(station, id, why) => {
                let rejected = news(Code::CommandRejected).at(station).about(id);
                rejected.because(why)
            }
            Notice::ManeuverReported(station, id) => {
                news(Code::ManeuverReported).at(station).about(id)
            }
            Notice::ManeuverInPosition(station, id) => {
                news(Code::ManeuverInPosition).at(station).about(id)
            }
            Notice::ManeuverCompleted(station, id) => {
                news(Code::ManeuverCompleted).at(station).about(id)
            }
            Notice::ManeuverFailed(station, id, why) => {
                let failed = news(Code::ManeuverFailed).at(station).about(id);
                failed.because(why)
            }
            Notice::FollowerSafeIdle(station, id) => {
                news(Code::FollowerSafeIdle).at(station).about(id)
            }
            Notice::OfferLapsed(station) => news(Code::OfferLapsed).at(station),
            Notice::Yielded(station) => news(Code::Yielded).at(station),
            Notice::SessionEnded(session, why) => {
                news(Code::SessionEnded).in_session(session).because(why)
            }
            Notice::Offering(session) => news(Code::Offering).in_session(session),
            Notice::Joined(session) => news(Code::Joined).in_session(session),
            Notice::Released(session, why) => news(Code::Released).in_session(session).because(why),
            Notice::ContactLost(session) => news(Code::ContactLost).in_session(session),
            Notice::ContactRegained(session) => news(Code::ContactRegained).in_session(session),
        }
    }
}

/// The code of a fallback policy.
pub(crate) const fn policy_code(policy: FallbackPolicy) -> u8 {
    let code = match policy {
        FallbackPolicy::StopInPlace => CrossguardFallback::StopInPlace,
        FallbackPolicy::GoToSafePosition => CrossguardFallback::GoToSafePosition,
        FallbackPolicy::EscortToKerb => CrossguardFallback::EscortToKerb,
        FallbackPolicy::HoldUntilClear => CrossguardFallback::HoldUntilClear,
    };
    code as u8
}

/// The fallback policy of a code.
pub(crate) const fn policy(code: u8) -> Option<FallbackPolicy> {
    Some(match code {
        0 => FallbackPolicy::StopInPlace,
        1 => FallbackPolicy::GoToSafePosition,
        2 => FallbackPolicy::EscortToKerb,
        3 => FallbackPolicy::HoldUntilClear,
        _ => return None,
    })
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
    /// What they say; `None` where a target or place of the map cannot be told from another.
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
