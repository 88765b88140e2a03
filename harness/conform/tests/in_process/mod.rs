//! A robot under test in this process, in virtual time: the kit's own endpoint, around the transition function of the
//! kit or around a weakened one. Nothing of it is looked at but its packets.

use std::collections::VecDeque;

use crossguard_codec::geonet::Envelope;
use crossguard_codec::{
    Identifiers, Measurement, Position, PublicSignal, RobotState, SignalMeans, SignalsShown,
    SlowState, TaskParameters,
};
use crossguard_conform::Terms;
use crossguard_conform::case::Table;
use crossguard_conform::subject::{Gone, Local, NotTold, Packet, Subject, Telling};
use crossguard_endpoint::{Effect, Endpoint, Moment, Stimulus};
use crossguard_protocol::{
    Availability, Config, Event, HelpRequest, Maneuver, Output, Place, StateMachine, StationId,
    TaskSet, TaskType, Urgency,
};

/// How long the simulated body takes to a place, in ms. An escort ends when somebody says so.
const ON_THE_WAY_MS: u64 = 300;

const PACE_MPS: f64 = 1.2;

/// `TimestampIts` at the start.
const BEGAN_ITS: u64 = 700_000_000_000;

/// The simulated body, and the sign.
#[derive(Clone, Debug, Default)]
struct Body {
    maneuver: Option<Maneuver>,
    arrives_ms: Option<u64>,
    moves: bool,
    go_until_ms: u64,
}

/// A robot in this process. `F` boots its transition function, with this boot counter.
#[derive(Clone, Debug)]
pub(crate) struct InProcess<P, F> {
    boots: F,
    boot: u16,
    station: StationId,
    config: Config,
    endpoint: Endpoint<P>,
    now_ms: u64,
    sent: VecDeque<Packet>,
    body: Body,
}

/// The tester's side of cases with this robot, which is not late.
pub(crate) fn table(robot: StationId) -> Table {
    Table {
        robot,
        terms: Terms {
            slack_ms: 100,
            ..Terms::default()
        },
        envelopes: [Envelope::Off, Envelope::Off],
        boot: 1,
    }
}

impl<P: StateMachine, F: Fn(StationId, u16) -> P> InProcess<P, F> {
    /// A robot that has just booted for the first time.
    pub(crate) fn new(station: StationId, config: Config, boots: F) -> Self {
        let now_ms = 1_000;
        let protocol = boots(station, 1);
        let endpoint = Endpoint::new(protocol, config.clone(), Identifiers::default(), now_ms);
        Self {
            boots,
            boot: 1,
            station,
            config,
            endpoint,
            now_ms,
            sent: VecDeque::new(),
            body: Body::default(),
        }
    }

    fn state(&self) -> RobotState {
        let shows = |signal| SignalsShown {
            to_vehicles: PublicSignal::None,
            to_pedestrians: signal,
            means: SignalMeans::GESTURE,
        };
        let signal = if self.now_ms < self.body.go_until_ms {
            PublicSignal::Go
        } else {
            PublicSignal::Stop
        };
        RobotState {
            position: Position::at(49.01, 8.41),
            speed: Some(Measurement::from(if self.body.moves {
                PACE_MPS
            } else {
                0.0
            })),
            slow: Some(SlowState {
                signals: Some(shows(signal)),
                ..SlowState::default()
            }),
            ..RobotState::default()
        }
    }

    fn handle(&mut self, stimulus: Stimulus<'_>) {
        let moment = Moment::after(BEGAN_ITS, self.now_ms);
        let state = self.state();
        let effects = self.endpoint.handle(moment, &state, stimulus);
        for effect in effects {
            match effect {
                Effect::Transmit { packet, .. } => self.sent.push_back(Packet {
                    at_ms: self.now_ms,
                    octets: packet,
                }),
                Effect::Act(output, _) => self.act(output),
                _ => {}
            }
        }
    }

    fn act(&mut self, output: Output) {
        let now_ms = self.now_ms;
        match output {
            Output::StartManeuver(maneuver) => {
                let arrives = maneuver.task != TaskType::MOVE;
                self.body.maneuver = Some(maneuver);
                self.body.arrives_ms = arrives.then_some(now_ms + ON_THE_WAY_MS);
                self.body.moves = true;
            }
            Output::StopManeuver(..) | Output::FallBack(..) => {
                (self.body.maneuver, self.body.arrives_ms) = (None, None);
                self.body.moves = false;
            }
            Output::CorridorOpened(time) | Output::CorridorExtended(time) => {
                self.body.go_until_ms = now_ms + u64::from(time.0);
            }
            Output::CorridorClosed(_) => self.body.go_until_ms = 0,
            _ => {}
        }
    }

    fn tell_event(&mut self, event: Event) {
        self.handle(Stimulus::Event(event));
    }

    fn arrive(&mut self) {
        let is_there = self.body.arrives_ms.is_some_and(|at| at <= self.now_ms);
        let (true, Some(maneuver)) = (is_there, self.body.maneuver) else {
            return;
        };
        self.body.arrives_ms = None;
        self.body.moves = false;
        self.tell_event(if maneuver.task == TaskType::BLOCK {
            Event::InPosition(maneuver.id)
        } else {
            Event::ManeuverCompleted(maneuver.id)
        });
    }
}

impl<P: StateMachine, F: Fn(StationId, u16) -> P> Subject for InProcess<P, F> {
    fn now_ms(&self) -> u64 {
        self.now_ms
    }

    fn timestamp_its(&self) -> u64 {
        BEGAN_ITS + self.now_ms
    }

    fn listen(&mut self, until_ms: u64) -> Result<Option<Packet>, Gone> {
        loop {
            if let Some(packet) = self.sent.pop_front() {
                return Ok(Some(packet));
            }
            if self.now_ms >= until_ms {
                return Ok(None);
            }
            let wakes_ms = self.endpoint.next_wakeup_ms();
            let wakes_ms = self.body.arrives_ms.map_or(wakes_ms, |at| wakes_ms.min(at));
            self.now_ms = wakes_ms.clamp(self.now_ms + 1, until_ms.max(self.now_ms + 1));
            self.handle(Stimulus::Time);
            self.arrive();
        }
    }

    fn send(&mut self, packet: &[u8]) -> Result<(), Gone> {
        // The robot reacts later than the tester sent.
        self.now_ms += 1;
        let arrived_ms = self.now_ms;
        self.handle(Stimulus::Datagram { packet, arrived_ms });
        Ok(())
    }

    fn tell(&mut self, local: Local) -> Result<Telling, NotTold> {
        self.now_ms += 1;
        let maneuver = self.body.maneuver.map(|maneuver| maneuver.id);
        let event = match (local, maneuver) {
            (Local::Detect(followers), _) => Event::PedestrianDetected(HelpRequest {
                urgency: Urgency::Medium,
                followers,
                tasks: TaskSet(0b111),
                place: Place(7),
            }),
            (Local::Order(follower, task), _) => {
                let parameters = TaskParameters::default();
                self.handle(Stimulus::Command {
                    follower,
                    task,
                    parameters,
                });
                return Ok(Telling::Told);
            }
            (Local::InPosition, Some(id)) => Event::InPosition(id),
            (Local::Done, Some(id)) => Event::ManeuverCompleted(id),
            (Local::Fail, Some(id)) => Event::ManeuverFailed(id),
            (Local::InPosition | Local::Done | Local::Fail, None) => {
                return Err(NotTold::Failed {
                    what: local.to_string(),
                    why: "it does nothing".to_owned(),
                });
            }
            (Local::Clear, _) => Event::RoadClear,
            (Local::Open, _) => Event::OpenCorridor,
            (Local::Close, _) => Event::CloseCorridor,
            (Local::TaskCompleted, _) => Event::TaskCompleted,
            (Local::Leave, _) => Event::LeaveRequested,
            (Local::Unavailable(why), _) => {
                Event::AvailabilityChanged(Availability::Unavailable(why))
            }
            (Local::Available, _) => Event::AvailabilityChanged(Availability::Available),
        };
        if matches!(local, Local::InPosition | Local::Done | Local::Fail) {
            self.body.moves = false;
            self.body.arrives_ms = None;
        }
        self.tell_event(event);
        Ok(Telling::Told)
    }

    fn restart(&mut self) -> Result<(), NotTold> {
        self.boot += 1;
        let protocol = (self.boots)(self.station, self.boot);
        let identifiers = Identifiers::default();
        self.endpoint = Endpoint::new(protocol, self.config.clone(), identifiers, self.now_ms);
        self.sent.clear();
        self.body = Body::default();
        Ok(())
    }
}
