//! Tells the story of a story file to endpoints that run the real protocol: real octets, virtual
//! time, a radio that loses and holds back what the story says.
//!
//! At every moment it is checked that what the paper's wording lets happen does not happen.

use std::collections::{BTreeMap, BTreeSet, HashSet, VecDeque};

use crossguard_codec::{Identifiers, RobotState, Service, TaskParameters};
use crossguard_endpoint::cause::Cause;
use crossguard_endpoint::station::listen::overhear;
use crossguard_endpoint::{Act, Effect, Endpoint, Moment, Stimulus};
use crossguard_judge::validate::{self, Validated};
use crossguard_model_check::paper::{Happening, Link, Story, StoryMessage, StoryStep};
use crossguard_protocol::{
    Config, Corridor, Event, HelpRequest, Ignored, Input, Leading, Maneuver, ManeuverId, Phase,
    Place, Progress, Rmcm, Robot, StationId, TaskSet, TaskType, Urgency,
};
use crossguard_robot::trace::{self, Entry, Record};

/// How far time moves at once; less than the endpoint may be late.
const TICK_MS: u64 = 20;
/// How long a step takes: long enough to select a helper, short enough that nothing else runs out.
const STEP_MS: u64 = 400;

/// A robot of the story.
struct Actor {
    name: String,
    /// `None` once it has broken down.
    endpoint: Option<Endpoint>,
    newest_ram: Vec<u8>,
    /// What its body does.
    running: Option<Maneuver>,
    started: Vec<ManeuverId>,
    finished: HashSet<ManeuverId>,
    /// When its body finished, or broke down.
    ended_ms: Option<u64>,
    acts: Vec<Act>,
}

/// The robots on a street, and the radio between them.
pub struct Street {
    config: Config,
    now_ms: u64,
    actors: BTreeMap<u32, Actor>,
    silent: BTreeSet<Link>,
    held: BTreeSet<StoryMessage>,
    /// Octets of the messages that are held.
    kept: BTreeMap<StoryMessage, Vec<Vec<u8>>>,
    records: Vec<Record>,
}

impl Street {
    /// The robots of the story, some time after they booted.
    pub fn new(story: &Story) -> Self {
        let mut street = Self {
            config: Config::default(),
            now_ms: 0,
            actors: BTreeMap::new(),
            silent: BTreeSet::new(),
            held: BTreeSet::new(),
            kept: BTreeMap::new(),
            records: Vec::new(),
        };
        for party in &story.robots {
            street.boot(party.station, &party.name);
        }
        street.pass(STEP_MS);
        street
    }

    fn boot(&mut self, station: u32, name: &str) {
        let robot = Robot::new(StationId(station), 1);
        let endpoint = Endpoint::new(robot, self.config.clone(), Identifiers::default(), 0);
        self.actors.insert(
            station,
            Actor {
                name: name.to_owned(),
                endpoint: Some(endpoint),
                newest_ram: Vec::new(),
                running: None,
                started: Vec::new(),
                finished: HashSet::new(),
                ended_ms: None,
                acts: Vec::new(),
            },
        );
        let settings = Box::new(self.config.settings().clone());
        self.record(
            station,
            Entry::Started {
                station: StationId(station),
                boot: 1,
                epoch: None,
                settings,
                identifiers: Identifiers::default(),
                unix_ms: 0,
                speed: None,
            },
        );
    }

    /// One step of the story, and the time that it takes.
    pub fn take(&mut self, step: &StoryStep) {
        if let Happening::SafetyTimeout(_) = step.what {
            // The radio is still as it was when the timer was armed.
            self.pass(u64::from(self.config.settings().t_safety.0));
        }
        self.silent = step.silent.iter().copied().collect();
        self.held = step.held.iter().copied().collect();
        self.happen(step.what);
        self.pass(STEP_MS);
    }

    fn happen(&mut self, what: Happening) {
        match what {
            Happening::Detect(station) => self.tell(station, Event::PedestrianDetected(escort())),
            Happening::Hear(link) => {
                let ram = self.actors[&link.from].newest_ram.clone();
                self.deliver(link.to, &ram);
            }
            Happening::Delay(link) => {
                let ram = self.actors[&link.from].newest_ram.clone();
                self.kept.insert(StoryMessage::Ram(link), vec![ram]);
            }
            // The protocol knows no reissue: what is commanded anew is a new command.
            Happening::Command(link) | Happening::Reissue(link) => self.order(link),
            Happening::Arrive(message) | Happening::ArriveAgain(message) => {
                let kept = self.kept.remove(&message).unwrap_or_default();
                assert!(
                    !kept.is_empty(),
                    "the story has nothing to deliver: {message:?}"
                );
                for octets in &kept {
                    self.deliver(receiver(message), octets);
                }
                if let Happening::ArriveAgain(_) = what {
                    self.kept.insert(message, kept);
                }
            }
            Happening::Lose(message) => {
                let lost = self.kept.remove(&message);
                assert!(lost.is_some(), "the story has nothing to lose: {message:?}");
            }
            Happening::Finish(station) => {
                let now_ms = self.now_ms;
                let actor = self.actor(station);
                let maneuver = actor.running.take().expect("it has something to finish");
                actor.ended_ms = Some(now_ms);
                actor.finished.insert(maneuver.id);
                self.tell(station, Event::ManeuverCompleted(maneuver.id));
            }
            Happening::CompleteTask(station) => self.tell(station, Event::TaskCompleted),
            Happening::AskForLeave(station) => self.tell(station, Event::LeaveRequested),
            // In the protocol a follower that leaves asks nobody.
            Happening::SafetyTimeout(_) | Happening::GrantLeave(_) => {}
            Happening::Crash(station) => {
                let now_ms = self.now_ms;
                let actor = self.actor(station);
                actor.endpoint = None;
                actor.running = None;
                actor.ended_ms = Some(now_ms);
            }
        }
    }

    /// The radio is clear from now on, what was held arrives, and time passes.
    pub fn clear_up(&mut self, ms: u64) {
        self.silent.clear();
        self.held.clear();
        for (message, kept) in std::mem::take(&mut self.kept) {
            for octets in kept {
                self.deliver(receiver(message), &octets);
            }
        }
        self.pass(ms);
    }

    /// Time passes; leaders open the corridor whenever they may.
    fn pass(&mut self, ms: u64) {
        let until = self.now_ms + ms;
        while self.now_ms < until {
            self.now_ms += TICK_MS;
            let stations: Vec<u32> = self.actors.keys().copied().collect();
            for &station in &stations {
                self.handle(station, Stimulus::Time);
            }
            for &station in &stations {
                let wants = self
                    .leading(station)
                    .is_some_and(|l| l.corridor != Corridor::Open);
                if wants && self.now_ms.is_multiple_of(5 * TICK_MS) {
                    self.tell(station, Event::OpenCorridor);
                }
            }
            self.check();
        }
    }

    fn tell(&mut self, station: u32, event: Event) {
        self.handle(station, Stimulus::Event(event));
    }

    fn order(&mut self, link: Link) {
        let order = Stimulus::Order {
            follower: StationId(link.to),
            task: TaskType::MOVE,
            parameters: TaskParameters::default(),
        };
        self.handle(link.from, order);
    }

    fn deliver(&mut self, to: u32, octets: &[u8]) {
        self.handle(to, self.arriving(octets));
    }

    /// A packet that arrives now, whatever it was held back on its way.
    const fn arriving<'a>(&self, packet: &'a [u8]) -> Stimulus<'a> {
        Stimulus::Datagram {
            packet,
            arrived_ms: self.now_ms,
        }
    }

    /// Tells a robot something, and carries on until the radio is quiet.
    fn handle(&mut self, station: u32, stimulus: Stimulus<'_>) {
        let mut on_air = VecDeque::new();
        self.handle_one(station, stimulus, &mut on_air);
        while let Some((from, kind, octets)) = on_air.pop_front() {
            let others: Vec<_> = self.actors.keys().copied().filter(|s| *s != from).collect();
            for to in others {
                if self.passes(Link { from, to }, kind, &octets) {
                    self.handle_one(to, self.arriving(&octets), &mut on_air);
                }
            }
        }
    }

    fn handle_one(
        &mut self,
        station: u32,
        stimulus: Stimulus<'_>,
        on_air: &mut VecDeque<(u32, Service, Vec<u8>)>,
    ) {
        let moment = Moment {
            now_ms: self.now_ms,
            timestamp_its: self.now_ms,
        };
        let actor = self.actor(station);
        let Some(endpoint) = &mut actor.endpoint else {
            return;
        };
        for effect in endpoint.handle(moment, &RobotState::default(), stimulus) {
            if let Some(entry) = trace::recorded(effect.clone()) {
                self.record(station, entry);
            }
            match effect {
                Effect::Transmit { kind, packet, .. } => {
                    if kind == Service::Ram {
                        self.actor(station).newest_ram.clone_from(&packet);
                    }
                    on_air.push_back((station, kind, packet));
                }
                Effect::Act(act) => self.actor(station).carry_out(act),
                Effect::Stepped { .. } | Effect::Heard { .. } => {}
                Effect::Dropped { detail, .. } => panic!("{station}: {detail}"),
            }
        }
    }

    /// Whether the radio carries a message; what it holds back is kept.
    fn passes(&mut self, link: Link, kind: Service, octets: &[u8]) -> bool {
        if kind == Service::Ram {
            return !self.silent.contains(&link);
        }
        let heard = overhear(&Identifiers::default(), octets).unwrap();
        let is_command = matches!(
            heard.inputs.iter().next(),
            Some(Input::Rmcm(Rmcm::Command(_)))
        );
        let message = if is_command {
            StoryMessage::Command(link)
        } else {
            StoryMessage::Answer(link)
        };
        let is_held = self.held.contains(&message);
        if is_held {
            self.kept.entry(message).or_default().push(octets.to_vec());
        }
        !is_held
    }

    fn record(&mut self, station: u32, entry: Entry) {
        let robot = self.actors[&station].name.clone();
        let at_us = self.now_ms * 1_000;
        self.records.push(Record {
            at_us,
            robot,
            entry,
        });
    }

    /// Replays everything that was recorded through the transition function.
    pub fn validate(&self) -> Validated {
        let mut log = Vec::new();
        for record in &self.records {
            trace::write(&mut log, record).unwrap();
        }
        validate::one(&*log).unwrap()
    }
}

impl Actor {
    fn carry_out(&mut self, act: Act) {
        match act {
            Act::Start(maneuver, _) => {
                self.running = Some(maneuver);
                self.started.push(maneuver.id);
            }
            Act::Stop(..) | Act::FallBack(..) => self.running = None,
            // The corridor is asked for again and again.
            Act::Ignored(Event::OpenCorridor, _) => return,
            _ => {}
        }
        self.acts.push(act);
    }
}

fn receiver(message: StoryMessage) -> u32 {
    match message {
        StoryMessage::Ram(link) | StoryMessage::Command(link) | StoryMessage::Answer(link) => {
            link.to
        }
    }
}

fn escort() -> HelpRequest {
    HelpRequest {
        urgency: Urgency::Medium,
        followers: 1,
        tasks: TaskSet::of(&[TaskType::MOVE]),
        place: Place::UNKNOWN,
    }
}

// What the tests look at.

impl Street {
    fn actor(&mut self, station: u32) -> &mut Actor {
        self.actors.get_mut(&station).expect("no such robot")
    }

    /// A robot that has not broken down.
    pub fn robot(&self, station: u32) -> &Robot {
        let endpoint = self.actors[&station].endpoint.as_ref();
        endpoint.expect("it has broken down").robot()
    }

    /// What a robot knows as a leader.
    pub fn leading(&self, station: u32) -> Option<&Leading> {
        match self.actors[&station].endpoint.as_ref()?.robot().phase() {
            Phase::Leading(leading) => Some(leading),
            _ => None,
        }
    }

    /// The requestID of what a robot's body does.
    pub fn runs(&self, station: u32) -> Option<u8> {
        let maneuver = self.actors[&station].running?;
        Some(maneuver.id.request.0)
    }

    /// What a robot's body was told to start.
    pub fn started(&self, station: u32) -> &[ManeuverId] {
        &self.actors[&station].started
    }

    /// Whether a robot was told to do this, or told of it.
    pub fn did(&self, station: u32, is: impl Fn(&Act) -> bool) -> bool {
        self.actors[&station].acts.iter().any(is)
    }

    /// How often a robot ignored something for this reason.
    pub fn ignored(&self, station: u32, why: Ignored) -> u64 {
        let endpoint = self.actors[&station].endpoint.as_ref();
        endpoint.map_or(0, |e| e.counters().of(Cause::from(why)))
    }

    /// How many robots lead.
    pub fn leaders(&self) -> usize {
        let lead = |station: &&u32| self.leading(**station).is_some();
        self.actors.keys().filter(lead).count()
    }

    /// A body that stops of its own accord, for a test of the tests.
    pub fn stop_silently(&mut self, station: u32) {
        self.actor(station).running = None;
        self.pass(STEP_MS);
    }

    /// Asserts that none of the hazards is there.
    fn check(&self) {
        let mut led = BTreeSet::new();
        for &leader in self.actors.keys() {
            let Some(leading) = self.leading(leader) else {
                continue;
            };
            let session = self.robot(leader).session().expect("it leads one");
            for member in leading.members.iter() {
                let station = member.station.0;
                assert!(led.insert(station), "{station} has two leaders");
                let actor = &self.actors[&station];
                if let Some(order) = member.order {
                    let request = order.request;
                    let id = ManeuverId { session, request };
                    let is_completed = order.progress == Some(Progress::Completed);
                    assert!(actor.started.contains(&id), "{id} was never accepted");
                    assert!(
                        !is_completed || actor.finished.contains(&id),
                        "{id} was never finished"
                    );
                }
                let guards = actor.running.is_some() || self.has_just_ended(actor);
                assert!(
                    leading.corridor != Corridor::Open || guards,
                    "nobody guards the corridor"
                );
            }
        }
        for actor in self.actors.values() {
            let distinct: HashSet<_> = actor.started.iter().collect();
            assert_eq!(
                distinct.len(),
                actor.started.len(),
                "{} starts twice",
                actor.name
            );
        }
    }

    /// A leader that no RAM reaches may take as long as its lease to learn that a maneuver is over.
    fn has_just_ended(&self, actor: &Actor) -> bool {
        let lease_ms = u64::from(self.config.settings().t_lease.0) + TICK_MS;
        actor
            .ended_ms
            .is_some_and(|ended_ms| self.now_ms <= ended_ms + lease_ms)
    }
}
