//! A whole robot, without input and output: the harness's endpoint and its log.

use crossguard_codec::si::timestamp_its;
use crossguard_codec::{RobotState, Service, TaskParameters};
use crossguard_endpoint::counters::CauseName;
use crossguard_endpoint::ras::generation::Trigger;
use crossguard_endpoint::{Effect, Moment, Stimulus};
use crossguard_protocol::{
    Config, CorridorClosure, Event, FallbackPolicy, Ignored, Maneuver, Millis, Notice, Output,
    StationId, StopReason,
};
use crossguard_robot::trace::{self, Entry, Reception, Record, recorded};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use serde::Serialize;

use crate::json::{from_json, to_json};
use crate::robot::Robot;
use crate::settings::{config, identifiers};

/// An effect for the application: `outputs.Effect` of the package.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
enum Told<'a> {
    Send {
        service: Service,
        trigger: Trigger,
        #[serde(with = "hex::serde")]
        packet: &'a [u8],
        #[serde(with = "hex::serde")]
        message: &'a [u8],
    },
    StartManeuver(&'a Maneuver, &'a TaskParameters),
    StopManeuver(&'a Maneuver, &'a StopReason),
    FallBack(&'a Maneuver, &'a FallbackPolicy),
    CorridorOpened(&'a Millis),
    CorridorExtended(&'a Millis),
    CorridorClosed(&'a CorridorClosure),
    LockIdentity,
    UnlockIdentity,
    RenewEpoch,
    Notify(&'a Notice),
    Ignored(&'a Ignored),
    Heard {
        service: Service,
        station: StationId,
        #[serde(with = "hex::serde")]
        message: &'a [u8],
    },
    Dropped {
        #[serde(flatten)]
        cause: CauseName,
        detail: &'a str,
    },
}

impl<'a> Told<'a> {
    /// The effect as the application receives it; `None` for one that is for the log alone.
    fn of(effect: &'a Effect) -> Option<Self> {
        Some(match effect {
            // An application in Python asks no vehicle.
            Effect::Stepped { .. } | Effect::VehicleAnswered(..) => return None,
            Effect::Heard {
                kind, from, octets, ..
            } => Self::Heard {
                service: *kind,
                station: *from,
                message: octets,
            },
            Effect::Transmit {
                kind,
                trigger,
                octets,
                packet,
            } => Self::Send {
                service: *kind,
                trigger: *trigger,
                packet,
                message: octets,
            },
            Effect::Dropped { cause, detail, .. } => Self::Dropped {
                cause: (*cause).into(),
                detail,
            },
            Effect::Ignored(_, why) => Self::Ignored(why),
            Effect::Act(output, parameters) => match output {
                Output::StartManeuver(maneuver) => Self::StartManeuver(maneuver, parameters),
                Output::StopManeuver(maneuver, why) => Self::StopManeuver(maneuver, why),
                Output::FallBack(maneuver, policy) => Self::FallBack(maneuver, policy),
                Output::CorridorOpened(time) => Self::CorridorOpened(time),
                Output::CorridorExtended(time) => Self::CorridorExtended(time),
                Output::CorridorClosed(why) => Self::CorridorClosed(why),
                Output::LockIdentity => Self::LockIdentity,
                Output::UnlockIdentity => Self::UnlockIdentity,
                Output::RenewEpoch => Self::RenewEpoch,
                Output::Notify(notice) => Self::Notify(notice),
                Output::SendRam | Output::SendRmcm(_) | Output::Ignored(_) => return None,
            },
        })
    }
}

/// A robot's endpoint, its body, and the lines of its log that nobody has taken.
#[pyclass(module = "crossguard._crossguard")]
pub(crate) struct Endpoint {
    name: String,
    inner: crossguard_endpoint::Endpoint,
    config: Config,
    body: RobotState,
    began_ms: u64,
    now_ms: u64,
    log: Vec<u8>,
}

#[pymethods]
impl Endpoint {
    #[new]
    fn new(
        name: String,
        station: u32,
        boot: u16,
        settings: &str,
        identifiers: &str,
        now_ms: u64,
        unix_ms: u64,
    ) -> PyResult<Self> {
        let config = config(settings)?;
        let identifiers = self::identifiers(identifiers)?;
        let station = StationId(station);
        let robot = crossguard_protocol::Robot::new(station, boot);
        let mut endpoint = Self {
            name,
            inner: crossguard_endpoint::Endpoint::new(robot, config.clone(), identifiers, now_ms),
            config,
            body: RobotState::default(),
            began_ms: now_ms,
            now_ms,
            log: Vec::new(),
        };
        let settings = Box::new(endpoint.config.settings().clone());
        endpoint.write(Entry::Started {
            station,
            boot,
            epoch: None,
            settings,
            identifiers,
            unix_ms,
            speed: None,
        })?;
        Ok(endpoint)
    }

    fn set_body(&mut self, body: &str) -> PyResult<()> {
        self.body = from_json("body", body)?;
        Ok(())
    }

    fn receive(
        &mut self,
        packet: &[u8],
        arrived_ms: u64,
        now_ms: u64,
        unix_ms: u64,
    ) -> PyResult<String> {
        let datagram = Stimulus::Datagram { packet, arrived_ms };
        self.handle(now_ms, unix_ms, datagram)
    }

    fn tell(
        &mut self,
        event: &str,
        parameters: Option<&str>,
        now_ms: u64,
        unix_ms: u64,
    ) -> PyResult<String> {
        let event: Event = from_json("event", event)?;
        let parameters: TaskParameters = match parameters {
            Some(parameters) => from_json("parameters", parameters)?,
            None => TaskParameters::default(),
        };
        let stimulus = match event {
            Event::CommandManeuver { follower, task } => Stimulus::Command {
                follower,
                task,
                parameters,
            },
            event => Stimulus::Event(event),
        };
        self.handle(now_ms, unix_ms, stimulus)
    }

    fn elapse(&mut self, now_ms: u64, unix_ms: u64) -> PyResult<String> {
        self.handle(now_ms, unix_ms, Stimulus::Time)
    }

    fn stop(&mut self, now_ms: u64) -> PyResult<()> {
        self.advance(now_ms)?;
        let counters = self.inner.counters().named();
        self.write(Entry::Stopped { counters })
    }

    fn take_log(&mut self) -> PyResult<String> {
        let lines = std::mem::take(&mut self.log);
        String::from_utf8(lines).map_err(|error| PyValueError::new_err(error.to_string()))
    }

    fn robot(&self) -> Robot {
        Robot::of(self.inner.robot(), &self.config)
    }

    fn counters(&self) -> PyResult<String> {
        to_json(&self.inner.counters().named())
    }

    #[getter]
    fn name(&self) -> &str {
        &self.name
    }

    #[getter]
    fn next_wakeup_ms(&self) -> u64 {
        self.inner.next_wakeup_ms()
    }
}

impl Endpoint {
    fn handle(&mut self, now_ms: u64, unix_ms: u64, stimulus: Stimulus<'_>) -> PyResult<String> {
        self.advance(now_ms)?;
        let moment = Moment {
            now_ms,
            timestamp_its: timestamp_its(i64::try_from(unix_ms).unwrap_or(i64::MAX)),
        };
        let effects = self.inner.handle(moment, &self.body, stimulus);
        let told: Vec<_> = effects.iter().filter_map(Told::of).collect();
        let told = to_json(&told)?;
        for mut entry in effects.into_iter().filter_map(recorded) {
            if let Entry::Heard { reception, .. } = &mut entry {
                // The log's clock shows 0 where the endpoint began.
                let began_us = self.began_ms.saturating_mul(1_000);
                *reception = reception.map(|shown| Reception {
                    arrived_us: shown.arrived_us.saturating_sub(began_us),
                    told_us: shown.told_us.saturating_sub(began_us),
                });
            }
            self.write(entry)?;
        }
        Ok(told)
    }

    /// Lets the clock go on.
    fn advance(&mut self, now_ms: u64) -> PyResult<()> {
        if now_ms < self.now_ms {
            let error = format!("the clock went back from {} ms to {now_ms} ms", self.now_ms);
            return Err(PyValueError::new_err(error));
        }
        self.now_ms = now_ms;
        Ok(())
    }

    fn write(&mut self, entry: Entry) -> PyResult<()> {
        let record = Record {
            at_us: (self.now_ms - self.began_ms).saturating_mul(1_000),
            robot: self.name.clone(),
            entry,
        };
        Ok(trace::write(&mut self.log, &record)?)
    }
}
