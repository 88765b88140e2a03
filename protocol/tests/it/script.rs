//! The vocabulary of the protocol scripts: robots on a street, what they are told, what they hear,
//! what they say, and time that passes.
//!
//! Every step also checks that the state stays valid, and that nothing was allocated.
#![allow(
    dead_code,
    unreachable_pub,
    clippy::wildcard_imports,
    reason = "a benchmark uses the words it needs"
)]

use std::collections::{BTreeMap, BTreeSet};

use crossguard_protocol::*;

pub const ARI: StationId = StationId(1);
pub const GO2: StationId = StationId(2);
pub const SPOT: StationId = StationId(3);
pub const NAO: StationId = StationId(4);
pub const PEPPER: StationId = StationId(5);

/// Distance of every robot to every other, unless a script says otherwise.
pub const NEAR: Decimetres = Decimetres(40);

/// The crossing of every request, unless a script says otherwise.
pub const CROSSING: Place = Place(7);

/// The first offer that a robot makes after its first boot.
pub const FIRST_OFFER: OfferNumber = OfferNumber(UniqueNumber { boot: 1, count: 0 });

/// Help of `followers` robots for an escort.
pub fn escort(followers: u8) -> HelpRequest {
    let tasks = TaskSet::of(&[TaskType::INITIAL_POS, TaskType::MOVE]);
    HelpRequest {
        urgency: Urgency::Medium,
        followers,
        tasks,
        place: CROSSING,
    }
}

/// A RAM that says nothing but this.
pub fn ram(station: StationId, coordination: Coordination) -> Ram {
    Ram {
        station,
        coordination,
        farewell: None,
        on_duty: false,
    }
}

/// A RAM that names a session as over, and nothing else.
pub fn farewell(station: StationId, farewell: Farewell) -> Ram {
    Ram {
        farewell: Some(farewell),
        ..ram(station, Coordination::None)
    }
}

/// A RAM of `station` that asks for help in its session of this count.
pub fn need_help(station: StationId, count: u16, heartbeat: u16, request: HelpRequest) -> Ram {
    let coordination = Coordination::NeedHelp {
        number: SessionNumber(UniqueNumber { boot: 1, count }),
        heartbeat: Heartbeat(heartbeat),
        request,
    };
    ram(station, coordination)
}

/// A RAM of a follower without a report.
pub fn follower(station: StationId, session: SessionId, echo: u16) -> Ram {
    let coordination = Coordination::Follower {
        session,
        echo: Heartbeat(echo),
        last: None,
    };
    ram(station, coordination)
}

/// The command of a leader to do `task`.
pub fn order(follower: StationId, task: TaskType) -> Event {
    Event::CommandManeuver { follower, task }
}

/// What came of one input.
pub struct Step {
    /// Milliseconds since the beginning.
    pub now: u32,
    pub who: StationId,
    /// The RAM after it.
    pub ram: Ram,
    pub outputs: Vec<Output>,
}

/// Robots, and a radio channel that loses what the script wants lost.
pub struct Street {
    pub config: Config,
    /// Robots with settings of their own.
    configs: BTreeMap<StationId, Config>,
    robots: BTreeMap<StationId, Robot>,
    /// Pairs of sender and receiver between which everything is lost.
    cut: BTreeSet<(StationId, StationId)>,
    /// Milliseconds since the beginning.
    now: u32,
    /// Robots that hang, and since when.
    hung: BTreeMap<StationId, u32>,
    /// The steps that put something out, since somebody last asked or forgot.
    pub trace: Vec<Step>,
    /// The RMCM that each robot sent last.
    rmcm: BTreeMap<StationId, Rmcm>,
    /// What the signs show: until when *go*. A sign ends by itself, whatever its robot does.
    go_until: BTreeMap<StationId, u32>,
}

impl Street {
    pub fn new(stations: &[StationId]) -> Self {
        Self::with_settings(stations, Settings::default())
    }

    pub fn with_settings(stations: &[StationId], settings: Settings) -> Self {
        let config = Config::new(settings).unwrap();
        let robots = stations.iter().map(|&id| (id, Robot::new(id, 1))).collect();
        Self {
            config,
            configs: BTreeMap::new(),
            robots,
            cut: BTreeSet::new(),
            now: 0,
            hung: BTreeMap::new(),
            trace: Vec::new(),
            rmcm: BTreeMap::new(),
            go_until: BTreeMap::new(),
        }
    }

    /// A street on which the first robot leads all others, and all have taken their roles.
    pub fn with_roles(stations: &[StationId]) -> Self {
        Self::with_roles_and_settings(stations, Settings::default())
    }

    pub fn with_roles_and_settings(stations: &[StationId], settings: Settings) -> Self {
        let mut street = Self::with_settings(stations, settings);
        street.establish_roles(stations[0], u8::try_from(stations.len() - 1).unwrap());
        street
    }

    /// `leader` asks for `followers` robots and gets them.
    pub fn establish_roles(&mut self, leader: StationId, followers: u8) {
        self.tell(leader, Event::PedestrianDetected(escort(followers)));
        self.pass(self.config.settings().t_select.0);
        assert_eq!(
            self[leader].role(),
            Role::Leader,
            "the roles should be established"
        );
        self.pass(self.config.settings().ram_period.0);
        self.forget();
    }

    /// A street on which `GO2` executes `task` for `ARI`, acknowledged and reported.
    pub fn executing(task: TaskType) -> Self {
        let mut street = Self::with_roles(&[ARI, GO2]);
        street.tell(ARI, order(GO2, task));
        assert_eq!(street[GO2].state(), State::ManeuverExecuting);
        assert_eq!(street[ARI].state(), State::ManeuverExecuting);
        street.forget();
        street
    }

    /// A street on which the others guard with `task` for the first, at their places, and its corridor is open.
    pub fn open(stations: &[StationId], task: TaskType) -> Self {
        let mut street = Self::with_roles(stations);
        for &guard in &stations[1..] {
            street.tell(stations[0], order(guard, task));
            street.in_position(guard);
        }
        let outputs = street.tell(stations[0], Event::OpenCorridor);
        assert_eq!(outputs.ignored(), None);
        street.forget();
        street
    }

    /// The body of `who` is at the place from which it guards, and its leader counts on it: that takes an echo of a newer
    /// heartbeat.
    pub fn in_position(&mut self, who: StationId) {
        let running = self.executes(who);
        let outputs = self.tell(who, Event::InPosition(running.id));
        assert_eq!(outputs.ignored(), None);
        self.pass(2 * self.config.settings().ram_period.0);
    }

    /// `who` has settings of its own from now on.
    pub fn set(&mut self, who: StationId, settings: Settings) {
        self.configs.insert(who, Config::new(settings).unwrap());
    }

    /// One input for one robot; whatever it sends is delivered at once.
    pub fn step(&mut self, who: StationId, input: Input) -> Outputs {
        let outputs = self.step_silently(who, input);
        self.deliver(who, &outputs);
        outputs
    }

    fn step_silently(&mut self, who: StationId, input: Input) -> Outputs {
        let config = self.configs.get(&who).unwrap_or(&self.config);
        let robot = self.robots.get_mut(&who).expect("no such robot");
        let before = robot.clone();
        let mut outputs = Outputs::default();
        let allocated = allocation_counter::measure(|| {
            outputs = StateMachine::step(robot, config, input);
        });
        assert_eq!(
            allocated.count_total, 0,
            "{input:?} allocates in {before:#?}"
        );
        assert!(
            robot.is_valid(config),
            "{input:?}\nin {before:#?}\nleads to {robot:#?}"
        );
        if outputs.ignored().is_some() {
            assert_eq!(*robot, before, "{input:?} is ignored, but has an effect");
        }
        // What others read says the same in two ways.
        let timers = robot.timers();
        let ram = timers.iter().find(|(timer, _)| *timer == Timer::Ram);
        assert_eq!(robot.next_due(), timers.iter().map(|it| it.1).min());
        assert_eq!(robot.next_ram(), ram.map(|it| it.1));
        assert_eq!(robot.boot(), robot.next_number().boot);
        let notices = outputs.iter().filter(|it| matches!(it, Output::Notify(_)));
        assert_eq!(outputs.notices().count(), notices.count());
        for &output in outputs.iter() {
            match output {
                Output::CorridorOpened(left) | Output::CorridorExtended(left) => {
                    self.go_until.insert(who, self.now + left.0);
                }
                Output::CorridorClosed(_) => {
                    self.go_until.remove(&who);
                }
                Output::SendRmcm(rmcm) => {
                    self.rmcm.insert(who, rmcm);
                }
                _ => {}
            }
        }
        if !outputs.is_empty() {
            self.trace.push(Step {
                now: self.now,
                who,
                ram: self[who].ram(),
                outputs: outputs.iter().copied().collect(),
            });
        }
        outputs
    }

    fn deliver(&mut self, from: StationId, outputs: &Outputs) {
        let ram = self[from].ram();
        for output in outputs.iter() {
            let input = match *output {
                Output::SendRam => Input::Ram {
                    ram,
                    distance: NEAR,
                },
                Output::SendRmcm(rmcm) => Input::Rmcm(rmcm),
                _ => continue,
            };
            for to in self.stations() {
                let is_lost = self.cut.contains(&(from, to)) || self.hung.contains_key(&to);
                if to != from && !is_lost {
                    self.step(to, input);
                }
            }
        }
    }

    fn stations(&self) -> Vec<StationId> {
        self.robots.keys().copied().collect()
    }

    /// An event of the robot's own application.
    pub fn tell(&mut self, who: StationId, event: Event) -> Outputs {
        self.step(who, Input::Local(event))
    }

    /// `who` hears `ram`, perhaps one from long ago.
    pub fn hears_ram(&mut self, who: StationId, ram: Ram) -> Outputs {
        self.step(
            who,
            Input::Ram {
                ram,
                distance: NEAR,
            },
        )
    }

    /// Time passes for all robots alike, each told at the moment when a timer is due.
    pub fn pass(&mut self, millis: u32) {
        let mut left = millis;
        while left > 0 {
            let awake: Vec<_> = self
                .stations()
                .into_iter()
                .filter(|who| !self.hung.contains_key(who))
                .collect();
            let due = awake
                .iter()
                .filter_map(|&who| self[who].next_due())
                .map(|due| due.0)
                .min();
            let slice = due.unwrap_or(left).min(left);
            self.now += slice;
            // All clocks advance before anybody hears what the others said at that moment.
            let mut told = Vec::new();
            for who in awake {
                told.push((who, self.step_silently(who, Input::Elapsed(Millis(slice)))));
            }
            for (who, outputs) in told {
                self.deliver(who, &outputs);
            }
            left -= slice;
        }
    }

    /// `who` hangs: it is told of no time and hears nothing.
    pub fn hang(&mut self, who: StationId) {
        self.hung.insert(who, self.now);
    }

    /// `who` goes on, and is told at once how much time has passed.
    pub fn go_on(&mut self, who: StationId) -> Outputs {
        let since = self.hung.remove(&who).expect("it hangs");
        self.step(who, Input::Elapsed(Millis(self.now - since)))
    }

    /// Whether the sign of `who` shows *go*, by what it was told last.
    pub fn shows_go(&self, who: StationId) -> bool {
        self.go_until
            .get(&who)
            .is_some_and(|until| self.now < *until)
    }

    /// The signs that have ended by themselves since somebody asked, and when.
    pub fn ended_signs(&mut self) -> Vec<(StationId, u32)> {
        let now = self.now;
        let ended = self.go_until.iter().filter(|(_, until)| **until <= now);
        let ended: Vec<_> = ended.map(|(who, until)| (*who, *until)).collect();
        self.go_until.retain(|_, until| *until > now);
        ended
    }

    /// From now on `to` hears nothing of `from`.
    pub fn cut(&mut self, from: StationId, to: StationId) {
        self.cut.insert((from, to));
    }

    /// From now on the two hear nothing of each other.
    pub fn part(&mut self, a: StationId, b: StationId) {
        self.cut(a, b);
        self.cut(b, a);
    }

    /// From now on everybody hears everybody.
    pub fn heal(&mut self) {
        self.cut.clear();
    }

    /// The robot loses its volatile state and boots again.
    pub fn reboot(&mut self, who: StationId) {
        let boot = self[who].boot() + 1;
        self.robots.insert(who, Robot::new(who, boot));
    }

    /// The robot is gone for good.
    pub fn remove(&mut self, who: StationId) {
        self.robots.remove(&who);
    }

    /// Forgets what was put out so far.
    pub fn forget(&mut self) {
        self.trace.clear();
    }

    /// Whether `who` has put this out since the script last asked or forgot.
    pub fn has_put_out(&self, who: StationId, output: Output) -> bool {
        self.count(who, |it| *it == output) > 0
    }

    /// The RMCM that `who` sent last.
    pub fn last_rmcm(&self, who: StationId) -> Option<Rmcm> {
        self.rmcm.get(&who).copied()
    }

    /// How often `who` has put out something of this kind.
    pub fn count(&self, who: StationId, of_kind: impl Fn(&Output) -> bool) -> usize {
        let of_who = self.trace.iter().filter(|step| step.who == who);
        let outputs = of_who.flat_map(|step| &step.outputs);
        outputs.filter(|output| of_kind(output)).count()
    }

    pub fn leading(&self, who: StationId) -> &Leading {
        let Phase::Leading(leading) = self[who].phase() else {
            panic!("{who} leads nobody")
        };
        leading
    }

    pub fn following(&self, who: StationId) -> &Following {
        let Phase::Following(following) = self[who].phase() else {
            panic!("{who} follows nobody")
        };
        following
    }

    /// The maneuver that it executes.
    pub fn executes(&self, who: StationId) -> Maneuver {
        self.following(who).executing().expect("a maneuver")
    }

    /// What the corridor of `who` is.
    pub fn corridor(&self, who: StationId) -> Corridor {
        self.leading(who).corridor
    }

    /// The number of the offer that the RAM of `who` makes.
    pub fn offer_of(&self, who: StationId) -> OfferNumber {
        let Phase::Offering(offering) = self[who].phase() else {
            panic!("{who} offers nothing")
        };
        offering.number
    }

    pub fn session_of(&self, who: StationId) -> SessionId {
        self[who].session().expect("no session")
    }

    /// The maneuver with this request number in the session of `who`.
    pub fn maneuver(&self, who: StationId, request: u8) -> ManeuverId {
        ManeuverId::of(self.session_of(who), RequestId(request))
    }
}

impl std::ops::Index<StationId> for Street {
    type Output = Robot;

    fn index(&self, station: StationId) -> &Robot {
        &self.robots[&station]
    }
}

/// The input was ignored, for this reason.
#[track_caller]
pub fn assert_ignored(outputs: &Outputs, why: Ignored) {
    assert_eq!(outputs.ignored(), Some(why));
}
