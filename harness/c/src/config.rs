//! Configuration and events of a robot: plain numbers, checked.

use core::ffi::c_char;

use crossguard_codec::{Identifiers, MessageIdentifiers};
use crossguard_protocol::{
    Availability, BrokenInequality, Config, Event, EventKind, FallbackPolicy, HelpRequest,
    ManeuverId, Millis, Place, RequestId, Settings, StationId, TaskSet, TaskType, Unavailability,
    UniqueNumber, Urgency,
};

use crate::abi::{
    CROSSGUARD_NAME_LEN, CROSSGUARD_TASKS, CrossguardConfig, CrossguardEvent,
    CrossguardMessageIdentifiers, CrossguardSettings,
};

const _: () = assert!(CROSSGUARD_TASKS == TaskType::COUNT);

#[derive(Debug)]
pub(crate) enum Refused {
    Fallback,
    Broken(BrokenInequality),
    Identifiers(crossguard_codec::IdentifierClash),
    /// The name is not UTF-8 that ends with NUL.
    Name,
}

impl core::fmt::Display for Refused {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Fallback => f.write_str("a fallback policy is none of CrossguardFallback"),
            Self::Broken(broken) => broken.fmt(f),
            Self::Identifiers(clash) => clash.fmt(f),
            Self::Name => f.write_str("the name is not UTF-8 that ends with NUL"),
        }
    }
}

impl From<&Settings> for CrossguardSettings {
    fn from(settings: &Settings) -> Self {
        let mut fallback = [0; CROSSGUARD_TASKS];
        for (code, policy) in fallback.iter_mut().zip(settings.fallback) {
            *code = policy.code();
        }
        Self {
            ram_period_ms: settings.ram_period.0,
            t_select_ms: settings.t_select.0,
            t_offer_ms: settings.t_offer.0,
            t_help_ms: settings.t_help.0,
            t_ack_ms: settings.t_ack.0,
            t_safety_ms: settings.t_safety.0,
            t_lease_ms: settings.t_lease.0,
            t_leave_ms: settings.t_leave.0,
            t_farewell_ms: settings.t_farewell.0,
            t_lock_ms: settings.t_lock.0,
            t_cross_ms: settings.t_cross.0,
            t_exec_ms: settings.t_exec.map(|time| time.0),
            drift_ppm: settings.drift_ppm,
            delay_max_ms: settings.delay_max.0,
            capabilities: settings.capabilities.0,
            guarding: settings.guarding.0,
            holding: settings.holding.0,
            fallback,
            n_ack: settings.n_ack,
            reserved: [0; 1],
        }
    }
}

impl CrossguardSettings {
    fn to_protocol(self) -> Result<Config, Refused> {
        let mut fallback = [FallbackPolicy::StopInPlace; CROSSGUARD_TASKS];
        for (to, code) in fallback.iter_mut().zip(self.fallback) {
            *to = FallbackPolicy::of_code(code).ok_or(Refused::Fallback)?;
        }
        Config::new(Settings {
            ram_period: Millis(self.ram_period_ms),
            t_select: Millis(self.t_select_ms),
            t_offer: Millis(self.t_offer_ms),
            t_help: Millis(self.t_help_ms),
            t_ack: Millis(self.t_ack_ms),
            n_ack: self.n_ack,
            t_safety: Millis(self.t_safety_ms),
            t_lease: Millis(self.t_lease_ms),
            t_leave: Millis(self.t_leave_ms),
            t_farewell: Millis(self.t_farewell_ms),
            t_lock: Millis(self.t_lock_ms),
            t_cross: Millis(self.t_cross_ms),
            t_exec: self.t_exec_ms.map(Millis),
            drift_ppm: self.drift_ppm,
            delay_max: Millis(self.delay_max_ms),
            capabilities: TaskSet(self.capabilities),
            guarding: TaskSet(self.guarding),
            holding: TaskSet(self.holding),
            fallback,
            ..Settings::default()
        })
        .map_err(Refused::Broken)
    }
}

impl From<MessageIdentifiers> for CrossguardMessageIdentifiers {
    fn from(identifiers: MessageIdentifiers) -> Self {
        Self {
            its_aid: identifiers.its_aid,
            btp_port: identifiers.btp_port,
            message_id: identifiers.message_id,
            protocol_version: identifiers.protocol_version,
        }
    }
}

impl From<CrossguardMessageIdentifiers> for MessageIdentifiers {
    fn from(identifiers: CrossguardMessageIdentifiers) -> Self {
        Self {
            its_aid: identifiers.its_aid,
            btp_port: identifiers.btp_port,
            message_id: identifiers.message_id,
            protocol_version: identifiers.protocol_version,
        }
    }
}

#[derive(Clone, Copy)]
pub(crate) struct Name {
    octets: [u8; CROSSGUARD_NAME_LEN],
    length: usize,
}

impl Name {
    fn new(name: &[c_char; CROSSGUARD_NAME_LEN]) -> Option<Self> {
        #[allow(
            clippy::cast_sign_loss,
            clippy::unnecessary_cast,
            reason = "a char is an octet"
        )]
        let octets = name.map(|octet| octet as u8);
        let length = octets.iter().position(|octet| *octet == 0)?;
        core::str::from_utf8(&octets[..length]).ok()?;
        Some(Self { octets, length })
    }

    pub(crate) fn as_str(&self) -> &str {
        core::str::from_utf8(&self.octets[..self.length]).unwrap_or_default()
    }
}

pub(crate) struct Checked {
    pub(crate) config: Config,
    pub(crate) identifiers: Identifiers,
    pub(crate) name: Name,
}

impl CrossguardConfig {
    /// The defaults, of a robot without station id, boot counter and name.
    pub(crate) fn standard() -> Self {
        let identifiers = Identifiers::default();
        Self {
            station_type: identifiers.robot_station_type,
            ram: identifiers.ram.into(),
            rmcm: identifiers.rmcm.into(),
            settings: Config::default().settings().into(),
            ..Self::default()
        }
    }

    pub(crate) fn check(&self) -> Result<Checked, Refused> {
        let identifiers = Identifiers {
            ram: self.ram.into(),
            rmcm: self.rmcm.into(),
            robot_station_type: self.station_type,
            ..Identifiers::default()
        };
        identifiers.check().map_err(Refused::Identifiers)?;
        Ok(Checked {
            config: self.settings.to_protocol()?,
            identifiers,
            name: Name::new(&self.name).ok_or(Refused::Name)?,
        })
    }
}

fn availability(code: u8) -> Option<Availability> {
    match code {
        0 => Some(Availability::Available),
        code => Unavailability::of_code(code).map(Availability::Unavailable),
    }
}

impl CrossguardEvent {
    /// The event; `None` where a code is none.
    pub(crate) fn to_protocol(self) -> Option<Event> {
        let id = ManeuverId {
            session: self.session.into(),
            request: RequestId(self.request),
        };
        Some(match EventKind::of_code(self.kind)? {
            EventKind::PedestrianDetected => Event::PedestrianDetected(HelpRequest {
                urgency: Urgency::of_code(self.urgency)?,
                followers: self.followers,
                tasks: TaskSet(self.tasks),
                place: Place(self.place),
            }),
            EventKind::CommandManeuver => Event::CommandManeuver {
                follower: StationId(self.station),
                task: TaskType::new(self.task)?,
            },
            EventKind::InPosition => Event::InPosition(id),
            EventKind::OutOfPosition => Event::OutOfPosition(id),
            EventKind::ManeuverCompleted => Event::ManeuverCompleted(id),
            EventKind::ManeuverFailed => Event::ManeuverFailed(id),
            EventKind::AvailabilityChanged => {
                Event::AvailabilityChanged(availability(self.unavailability)?)
            }
            EventKind::IdentityChanged => {
                let next = self.session.number;
                let next = (next > 0).then(|| UniqueNumber::from_u32(next));
                Event::IdentityChanged(StationId(self.station), next)
            }
            EventKind::EpochRenewed => Event::EpochRenewed(self.boot),
            kind => Event::bare(kind)?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_event_has_its_code() {
        for kind in EventKind::ALL {
            let plain = CrossguardEvent {
                kind: kind.code(),
                followers: 1,
                task: 1,
                tasks: 1,
                station: 2,
                boot: 1,
                ..CrossguardEvent::default()
            };
            assert_eq!(plain.to_protocol().map(|event| event.kind()), Some(kind));
        }
    }
}
