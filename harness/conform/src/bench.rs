//! The bench: the tester's two stations and the robot under test, and what was seen of them.

use crossguard_codec::geonet::{EgoPosition, Stack};
use crossguard_codec::si::generation_delta_time;
use crossguard_codec::{
    ExecutionStatus, Heard, Identifiers, Message as Pdu, Position, RobotState, Service, Target,
    TaskParameters, TaskProgression, ram_from, rmcm_from_answer, rmcm_from_commands,
};
use crossguard_protocol::{
    Command, Heartbeat, Input, OfferNumber, RequestId, Rmcm, Settings, StationId, TaskType,
};

use crate::case::Table;
use crate::exchange::{Exchange, Happening, Message, Player, RamSeen, Seen};
use crate::station::PlayedStation;
use crate::subject::{Gone, Local, NotTold, Packet, Subject, Telling};

/// The tester's assumptions on the robot under test.
#[derive(Clone, Debug)]
pub struct Terms {
    /// Its settings.
    pub settings: Settings,
    /// How much later than by the rule the robot may do something, in ms: its own delay, that of the link, and that
    /// of the machine.
    pub slack_ms: u64,
    /// How much earlier, in ms: what clocks and time stamps may differ.
    pub early_ms: u64,
    /// Identifiers that no standard has assigned.
    pub identifiers: Identifiers,
    /// The tester's stations, in the order of [`Player::ALL`].
    pub players: [StationId; 2],
}

impl Default for Terms {
    fn default() -> Self {
        Self {
            settings: Settings::default(),
            slack_ms: 500,
            early_ms: 30,
            identifiers: Identifiers::default(),
            players: [StationId(9_001), StationId(9_002)],
        }
    }
}

impl Terms {
    pub(crate) fn ms(&self, of: impl Fn(&Settings) -> crossguard_protocol::Millis) -> u64 {
        of(&self.settings).0.into()
    }

    /// How soon something that is due at once has to be seen, in ms: in the RAM after the next one.
    pub(crate) fn soon_ms(&self) -> u64 {
        2 * self.ms(|settings| settings.ram_period) + self.slack_ms
    }
}

/// How far apart one-off messages are that are sent three times, since a link may lose one, in ms.
pub(crate) const APART_MS: u64 = 60;

/// How far to the north of the robot an escort leads, in metres: farther than a robot comes in a case.
const FAR_M: f64 = 40.0;

/// Metres of a degree of latitude, nearly.
const METRES_PER_DEGREE: f64 = 111_200.0;

fn failed(error: impl std::fmt::Display) -> Gone {
    Gone::Link(error.to_string())
}

/// The tester at work.
#[derive(Debug)]
pub(crate) struct Bench<'a, S> {
    pub(crate) subject: &'a mut S,
    pub(crate) terms: Terms,
    pub(crate) stations: [PlayedStation; 2],
    pub(crate) exchange: Exchange,
    /// Where the robot under test says that it is.
    position: Position,
    /// The newest command that was sent, with its parameters: one that comes again has the same, wherever the robot is by then.
    sent: Option<(Command, TaskParameters)>,
    /// The newest heartbeat of the robot under test.
    newest: Option<Heartbeat>,
    /// Why an event could not be told to the robot.
    pub(crate) not_told: Option<NotTold>,
    /// The number of Ada's next command.
    pub(crate) next_request: RequestId,
    /// Ada's newest command.
    pub(crate) command: Option<Command>,
    /// The number of an offer that Ada could have made before the one that she made.
    pub(crate) older_offer: Option<OfferNumber>,
}

impl<'a, S: Subject> Bench<'a, S> {
    /// A bench at which nothing has happened.
    pub(crate) fn new(subject: &'a mut S, table: Table) -> Self {
        let Table {
            robot,
            terms,
            envelopes: [ada, bo],
            boot,
        } = table;
        let station = |id: StationId, envelope, distance_m| {
            let mut stack = Stack::of_robot(terms.identifiers, id);
            *stack.envelope_mut() = envelope;
            PlayedStation::new(id, stack, boot, distance_m)
        };
        let stations = [
            station(terms.players[0], ada, 8.0),
            station(terms.players[1], bo, 3.0),
        ];
        let exchange = Exchange {
            robot,
            players: terms.players,
            seen: Vec::new(),
            ended_ms: subject.now_ms(),
        };
        Self {
            subject,
            terms,
            stations,
            exchange,
            position: Position::at(49.01, 8.41),
            sent: None,
            newest: None,
            not_told: None,
            // Not at 0, so that there are older ones.
            next_request: RequestId(10),
            command: None,
            older_offer: None,
        }
    }

    pub(crate) fn station(&mut self, player: Player) -> &mut PlayedStation {
        &mut self.stations[player as usize]
    }

    /// The newest RAM of the robot under test.
    pub(crate) fn said(&self) -> Option<&RamSeen> {
        self.exchange.rams().next_back().map(|(_, ram)| ram)
    }

    pub(crate) fn note(&mut self, what: Happening) {
        let at_ms = self.subject.now_ms();
        self.exchange.seen.push(Seen {
            at_ms,
            what,
            octets: Vec::new(),
        });
    }

    pub(crate) fn pass(&mut self, ms: u64) -> Result<(), Gone> {
        self.pass_until(ms, |_| false).map(drop)
    }

    /// Plays on until it is `enough`, but no longer than this; whether it was.
    pub(crate) fn pass_until(
        &mut self,
        at_most_ms: u64,
        enough: impl Fn(&Self) -> bool,
    ) -> Result<bool, Gone> {
        let until_ms = self.subject.now_ms() + at_most_ms;
        loop {
            self.speak()?;
            let now_ms = self.subject.now_ms();
            self.exchange.ended_ms = now_ms;
            if enough(self) {
                return Ok(true);
            }
            if now_ms >= until_ms {
                return Ok(false);
            }
            let speaking = self.stations.iter().filter(|station| station.speaks());
            let due_ms = speaking.map(|station| station.due_ms).min();
            let wake_ms = due_ms.map_or(until_ms, |due_ms| due_ms.clamp(now_ms + 1, until_ms));
            if let Some(packet) = self.subject.listen(wake_ms)? {
                self.hear(&packet);
            }
        }
    }

    /// Sends the RAM that are due.
    fn speak(&mut self) -> Result<(), Gone> {
        for player in Player::ALL {
            let now_ms = self.subject.now_ms();
            let newest = self.newest;
            let period_ms = self.terms.ms(|settings| settings.ram_period);
            let station = self.station(player);
            if station.speaks() && station.due_ms <= now_ms {
                station.due_ms = now_ms + period_ms;
                let ram = station.next_ram(newest);
                self.send(player, RamSeen::of(ram).into())?;
            }
        }
        Ok(())
    }

    /// Has the next RAM of a station go out at once.
    pub(crate) fn hurry(&mut self, player: Player) {
        self.station(player).due_ms = 0;
    }

    /// Has a station say something.
    pub(crate) fn send(&mut self, player: Player, message: Message) -> Result<(), Gone> {
        let (state, its) = (self.state_of(player), self.subject.timestamp_its());
        if let Message::Rmcm(Rmcm::Command(command)) = message
            && self.sent.is_none_or(|(sent, _)| sent != command)
        {
            self.sent = Some((command, self.parameters(command.task)));
        }
        let (ids, position) = (self.terms.identifiers, &state.position);
        let time = generation_delta_time(its);
        let pdu = match &message {
            Message::Ram(RamSeen {
                ram, availability, ..
            }) => ram_from(&ids, &state, ram, *availability, time, true).map(Pdu::Ram),
            Message::Rmcm(Rmcm::Command(command)) => {
                let parameters = self.sent.map(|(_, parameters)| parameters);
                let commands = [(*command, parameters.unwrap_or_default())];
                rmcm_from_commands(&ids, position, &commands, time).map(Pdu::Rmcm)
            }
            Message::Rmcm(Rmcm::Answer(answer)) => {
                let status = ExecutionStatus {
                    progression: TaskProgression::Executing,
                    time_to_completion: None,
                };
                rmcm_from_answer(&ids, position, answer, status, time).map(Pdu::Rmcm)
            }
        };
        let octets = pdu.map_err(failed)?.encode(&ids).map_err(failed)?;
        let ego = EgoPosition::of(&state, its);
        let service = message.service();
        let packet = self.station(player).stack.packet(&ego, service, &octets);
        let packet = packet.map_err(failed)?;
        let at_ms = self.subject.now_ms();
        self.exchange.seen.push(Seen {
            at_ms,
            what: Happening::Played(player, message),
            octets,
        });
        self.subject.send(&packet)
    }

    /// Sends octets that are no packet, or a packet with these in place of a message.
    pub(crate) fn send_noise(&mut self, name: &'static str, octets: &[u8]) -> Result<(), Gone> {
        self.note(Happening::Noise(name));
        self.subject.send(octets)
    }

    /// A packet of Ada's with these octets as its message.
    pub(crate) fn packet_of(&mut self, message: &[u8]) -> Result<Vec<u8>, Gone> {
        let time = self.subject.timestamp_its();
        let ego = EgoPosition::of(&self.state_of(Player::Ada), time);
        let stack = &mut self.station(Player::Ada).stack;
        let packet = stack.packet(&ego, Service::Ram, message);
        packet.map_err(failed)
    }

    /// Tells the robot something; whether it is to be waited for. The cause is kept where it cannot be told.
    pub(crate) fn tell(&mut self, local: Local) -> bool {
        // It may act on it before this comes back.
        let at_ms = self.subject.now_ms();
        match self.subject.tell(local) {
            Ok(Telling::Told) => self.exchange.seen.push(Seen {
                at_ms,
                what: Happening::Told(local),
                octets: Vec::new(),
            }),
            Ok(Telling::Awaited) => return true,
            Err(why) => self.not_told = Some(why),
        }
        false
    }

    /// Cuts the robot's power.
    pub(crate) fn restart(&mut self) {
        match self.subject.restart() {
            Ok(()) => self.note(Happening::Restarted),
            Err(why) => self.not_told = Some(why),
        }
    }

    fn hear(&mut self, packet: &Packet) {
        let ids = self.terms.identifiers;
        let time = self.subject.timestamp_its();
        let ego = EgoPosition::of(&self.state_of(Player::Ada), time);
        let stack = &mut self.station(Player::Ada).stack;
        let Ok(indication) = stack.receive(&ego, &packet.octets) else {
            return;
        };
        let octets = indication.message.to_vec();
        let nobody = StationId(u32::MAX);
        let Ok(heard) = Heard::of(&ids, nobody, &Position::default(), &octets) else {
            return;
        };
        if heard.from != self.exchange.robot {
            return;
        }
        let state = heard.state.as_ref();
        for input in heard.inputs.iter() {
            let message = match *input {
                Input::Ram { ram, .. } => {
                    let seen = RamSeen {
                        ram,
                        availability: heard.availability.unwrap_or_default(),
                        sign: state
                            .and_then(|state| state.slow.as_ref()?.signals)
                            .map(|signals| signals.to_pedestrians),
                        speed_mps: state.and_then(|state| Some(state.speed?.value)),
                    };
                    self.newest = seen.heartbeat();
                    Message::Ram(seen)
                }
                Input::Rmcm(rmcm) => Message::Rmcm(rmcm),
                Input::Elapsed(_) | Input::Expired(_) | Input::Local(_) => continue,
            };
            self.exchange.seen.push(Seen {
                at_ms: packet.at_ms,
                what: Happening::Said(message),
                octets: octets.clone(),
            });
        }
        if let Some(state) = heard.state
            && state.position.latitude.is_some()
        {
            self.position = state.position;
        }
    }

    /// Where a station of the tester is.
    fn state_of(&self, player: Player) -> RobotState {
        RobotState {
            position: self.north_of(self.stations[player as usize].distance_m),
            ..RobotState::default()
        }
    }

    fn north_of(&self, metres: f64) -> Position {
        let latitude = self.position.latitude.unwrap_or_default();
        let longitude = self.position.longitude.unwrap_or_default();
        Position::at(latitude + metres / METRES_PER_DEGREE, longitude)
    }

    /// An escort leads away from the robot; anything else is to be done where it is.
    fn parameters(&self, task: TaskType) -> TaskParameters {
        let metres = if task == TaskType::MOVE { FAR_M } else { 0.0 };
        let place = self.north_of(metres);
        TaskParameters {
            target: place
                .latitude
                .zip(place.longitude)
                .map(|(latitude, longitude)| Target::Position {
                    latitude,
                    longitude,
                    altitude: None,
                }),
            maximum_speed: Some(1.0),
            ..TaskParameters::default()
        }
    }
}
