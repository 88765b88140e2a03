//! One robot's records, one after the other.

use std::collections::VecDeque;

use crossguard_codec::{Heard, Identifiers, Position, Service, TaskParameters};
#[cfg(feature = "foreign")]
use crossguard_codec::{Unheard, its::ItsMessage};
use crossguard_endpoint::cause::Cause;
use crossguard_endpoint::counters::{CauseName, Counts};
use crossguard_endpoint::exchange::Accepted;
use crossguard_endpoint::station::listen::{message_of, overhear};
#[cfg(feature = "foreign")]
use crossguard_endpoint::station::service_of;
use crossguard_protocol::{
    Command, Config, Decimetres, Input, Output, Outputs, Phase, Rmcm, Robot, Settings, StationId,
    TaskType,
};
use crossguard_robot::trace::Reception;

use super::fault::Fault;
use super::targets::Targets;
use super::time::ToldTime;

/// A message that a step put out and that is to be sent.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Owed {
    Ram,
    Rmcm(Rmcm),
}

/// State of a robot up to a record.
#[derive(Debug)]
pub(super) struct Follow {
    pub(super) place: usize,
    pub(super) robot: Robot,
    /// The boot counter that it started with.
    boot: u16,
    /// Whether its numbers do not tell the boot counter.
    has_epoch: bool,
    pub(super) config: Config,
    pub(super) identifiers: Identifiers,
    pub(super) time: ToldTime,
    owed: VecDeque<Owed>,
    heard: VecDeque<Input>,
    counted: Counts,
    targets: Targets,
    /// Last question of the robot to a vehicle.
    asked: Option<Command>,
    accepted: Accepted,
    /// Parameters of the command to the robot in the message that it heard last.
    parameters: Option<TaskParameters>,
}

impl Follow {
    pub(super) fn started(
        place: usize,
        at_us: u64,
        station: StationId,
        (boot, epoch): (u16, Option<u16>),
        settings: Settings,
        identifiers: Identifiers,
    ) -> Result<Self, Fault> {
        let time = ToldTime::new(&settings, at_us);
        Ok(Self {
            place,
            robot: Robot::new(station, epoch.unwrap_or(boot)),
            boot,
            has_epoch: epoch.is_some(),
            config: Config::new(settings).map_err(Fault::Settings)?,
            identifiers,
            time,
            owed: VecDeque::new(),
            heard: VecDeque::new(),
            counted: Counts::default(),
            targets: Targets::default(),
            asked: None,
            accepted: Accepted::default(),
            parameters: None,
        })
    }

    pub(super) const fn may_reboot_with(&self, boot: u16) -> bool {
        boot > self.boot && (self.has_epoch || boot > self.robot.boot())
    }

    /// The robot takes a step. By how many µs it comes too late, if it does.
    pub(super) fn step(
        &mut self,
        input: Input,
        outputs: &Outputs,
        after: &Robot,
    ) -> Result<Option<u64>, Fault> {
        self.settle_sending()?;
        match input {
            Input::Ram { .. } | Input::Rmcm(_) => self.take_in(input)?,
            Input::Elapsed(_) | Input::Expired(_) | Input::Local(_) => self.settle_hearing()?,
        }
        let late = match input {
            Input::Elapsed(elapsed) => self.time.elapse(elapsed, self.robot.next_due())?,
            _ => self.time.take_in(),
        };
        let expected = self.robot.step(&self.config, input);
        let is_accepted = !expected
            .iter()
            .any(|output| matches!(output, Output::Ignored(_)));
        let told = input;
        let input = || input.to_string();
        if expected != *outputs {
            return Err(Fault::Outputs {
                input: input(),
                found: list(outputs),
                expected: list(&expected),
            });
        }
        if self.robot != *after {
            return Err(Fault::State { input: input() });
        }
        for output in outputs.iter() {
            match *output {
                Output::SendRam => self.owed.push_back(Owed::Ram),
                Output::SendRmcm(rmcm) => self.owed.push_back(Owed::Rmcm(rmcm)),
                Output::Ignored(reason) => {
                    self.counted.add(&Cause::from(reason).into(), 1);
                }
                _ => {}
            }
        }
        self.accepted.learn(&self.robot, &told, self.parameters);
        if is_accepted {
            self.targets.told(told)?;
        }
        Ok(late)
    }

    /// Takes in the next message that was heard, which has to be this input.
    fn take_in(&mut self, input: Input) -> Result<(), Fault> {
        self.leave_out_contradictions();
        let heard = self.heard.pop_front();
        if heard.map(without_distance) == Some(without_distance(input)) {
            return Ok(());
        }
        let heard = heard.map_or_else(|| "nothing".to_owned(), |heard| format!("'{heard}'"));
        Err(Fault::NotHeard {
            found: input.to_string(),
            heard,
        })
    }

    /// Commands that contradict the one that the robot took on are dropped, and no step takes them in.
    fn leave_out_contradictions(&mut self) {
        let (accepted, me, parameters) = (&self.accepted, &self.robot, self.parameters);
        let is_dropped = |input: &Input| accepted.is_contradicted(me, input, parameters);
        while self.heard.front().is_some_and(is_dropped) {
            self.heard.pop_front();
        }
    }

    fn settle_hearing(&mut self) -> Result<(), Fault> {
        self.leave_out_contradictions();
        match self.heard.front() {
            Some(heard) => Err(Fault::NotTakenIn(heard.to_string())),
            None => Ok(()),
        }
    }

    fn settle_sending(&self) -> Result<(), Fault> {
        match self.owed.front() {
            Some(Owed::Ram) => Err(Fault::NotSent("a RAM".to_owned())),
            Some(Owed::Rmcm(rmcm)) => Err(Fault::NotSent(Input::Rmcm(*rmcm).to_string())),
            None => Ok(()),
        }
    }

    /// A RAM says what the state is, an RMCM what a step has put out. A CAM and a cluster VAM say nothing of
    /// either.
    pub(super) fn sent(&mut self, kind: Service, octets: &[u8]) -> Result<(), Fault> {
        if !matches!(kind, Service::Ram | Service::Rmcm) {
            return match self.of_etsi(octets)? {
                (Some(found), _) if found == kind => Ok(()),
                _ => Err(Fault::OtherOctets(kind.name().to_owned())),
            };
        }
        let message = overhear(&self.identifiers, octets).map_err(Fault::NoMessage)?;
        if message.service != kind {
            return Err(Fault::OtherOctets(kind.name().to_owned()));
        }
        let Some(&found) = message.inputs.iter().next() else {
            return Err(Fault::OtherOctets(kind.name().to_owned()));
        };
        let ram = Input::Ram {
            ram: self.robot.ram(),
            distance: Decimetres(0),
        };
        if let Some(question) = self.question(found) {
            self.asked = Some(question);
            return Ok(());
        }
        if kind == Service::Rmcm {
            self.targets.sent(&self.identifiers, octets);
        }
        let expected = match (self.owed.pop_front(), found) {
            (Some(Owed::Rmcm(rmcm)), _) => Some(Input::Rmcm(rmcm)),
            (Some(Owed::Ram), _) => Some(ram),
            // Outside of a session the endpoint's own rules say when.
            (None, Input::Ram { .. }) if self.robot.next_ram().is_none() => Some(ram),
            (None, _) => None,
        };
        if expected.map(without_distance) == Some(without_distance(found)) {
            return Ok(());
        }
        let expected = expected.map_or_else(|| "nothing".to_owned(), |e| format!("'{e}'"));
        Err(Fault::SentOther {
            found: format!("'{found}'"),
            expected,
        })
    }

    /// The command by which a leader asks a vehicle to stop: no step puts it out, and it is to nobody who follows.
    fn question(&self, found: Input) -> Option<Command> {
        let (Input::Rmcm(Rmcm::Command(command)), Phase::Leading(leading)) =
            (found, self.robot.phase())
        else {
            return None;
        };
        let is_own = command.session.leader == self.robot.station()
            && command.session.number == leading.number;
        let follows = leading.members.iter().any(|it| it.station == command.to);
        let is_question = is_own && !follows && command.task == TaskType::BLOCK;
        (is_question && self.owed.is_empty()).then_some(command)
    }

    /// Whether a message answers the newest question to a vehicle. The protocol has no part in that.
    fn answers_question(&self, heard: &Input) -> bool {
        let (Input::Rmcm(Rmcm::Answer(answer)), Some(asked)) = (heard, self.asked) else {
            return false;
        };
        answer.from == asked.to
            && answer.session == asked.session
            && answer.request == asked.request
    }

    pub(super) fn heard(
        &mut self,
        kind: Service,
        from: StationId,
        reception: Option<Reception>,
        octets: &[u8],
    ) -> Result<(), Fault> {
        if let Some(reception) = reception {
            self.time.receive(reception)?;
        }
        self.settle_hearing()?;
        self.settle_sending()?;
        let other = || Fault::OtherOctets(format!("{} of station {from}", kind.name()));
        if !matches!(kind, Service::Ram | Service::Rmcm) {
            let is_it = self.of_etsi(octets)? == (Some(kind), from);
            return is_it.then_some(()).ok_or_else(other);
        }
        let (me, nowhere) = (self.robot.station(), Position::default());
        let message = Heard::of(&self.identifiers, me, &nowhere, message_of(octets));
        let message = message.map_err(Fault::NoMessage)?;
        if (message.service, message.from) != (kind, from) {
            return Err(other());
        }
        self.parameters = message.parameters;
        let heard = message.inputs.iter().copied();
        self.heard = heard.filter(|it| !self.answers_question(it)).collect();
        Ok(())
    }

    /// The service and the sender of a message that the protocol has no part in.
    #[cfg(feature = "foreign")]
    fn of_etsi(&self, octets: &[u8]) -> Result<(Option<Service>, StationId), Fault> {
        let message = ItsMessage::decode(&self.identifiers, octets);
        let message = message.map_err(Unheard::from).map_err(Fault::NoMessage)?;
        let from = StationId(message.message.header().station_id.0);
        Ok((service_of(&message.message), from))
    }

    /// Messages of robots are all that is known here.
    #[cfg(not(feature = "foreign"))]
    fn of_etsi(&self, octets: &[u8]) -> Result<(Option<Service>, StationId), Fault> {
        let message = overhear(&self.identifiers, octets).map_err(Fault::NoMessage)?;
        Ok((Some(message.service), message.from))
    }

    pub(super) fn dropped(&mut self, cause: &CauseName) {
        if *cause == Cause::NotSent.into() {
            // A message that could not be made was not sent; one that the link did not take was.
            self.owed.pop_front();
        }
        self.counted.add(cause, 1);
    }

    /// So many were dropped without records of their own.
    pub(super) fn unrecorded(&mut self, counters: &Counts) {
        for (cause, count) in counters.iter() {
            self.counted.add(&cause, count);
        }
    }

    /// The robot has stopped. How many records are missing by its own account.
    pub(super) fn stopped(&mut self, counters: &Counts) -> Result<u64, Fault> {
        self.settle_hearing()?;
        self.settle_sending()?;
        let missing = counters.of(&Cause::LogFull.into());
        // Drops of these causes have no records of their own.
        let silent = [
            Cause::LogFull,
            Cause::OutputFull,
            Cause::InboxFull,
            Cause::NotCanonical,
        ];
        let silent = silent.map(CauseName::from);
        let causes = counters.iter().chain(self.counted.iter());
        let causes = causes.map(|(cause, _)| cause);
        for cause in causes.filter(|cause| !silent.contains(cause)) {
            let (counted, logged) = (counters.of(&cause), self.counted.of(&cause));
            if counted != logged && missing == 0 {
                return Err(Fault::Counter {
                    cause,
                    counted,
                    logged,
                });
            }
        }
        Ok(missing)
    }
}

/// How far away the sender was is not in the message.
fn without_distance(input: Input) -> Input {
    match input {
        Input::Ram { ram, .. } => Input::Ram {
            ram,
            distance: Decimetres(0),
        },
        other => other,
    }
}

fn list(outputs: &Outputs) -> String {
    let outputs = outputs.iter().map(ToString::to_string);
    outputs.collect::<Vec<_>>().join("; ")
}
