//! The vocabulary of the protocol scripts: robots on a street, what they are told, what they hear,
//! what they say, and time that passes.
//!
//! Every step also checks that the state stays valid, and that nothing was allocated.
#![allow(
    dead_code,
    unreachable_pub,
    clippy::wildcard_imports,
    reason = "each script uses the words it needs"
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

/// Help of `followers` robots for an escort.
pub fn escort(followers: u8) -> HelpRequest {
    let tasks = TaskSet::of(&[TaskType::INITIAL_POS, TaskType::MOVE]);
    HelpRequest {
        urgency: Urgency::Medium,
        followers,
        tasks,
    }
}

/// Robots, and a radio channel that loses what the script wants lost.
pub struct Street {
    pub config: Config,
    robots: BTreeMap<StationId, Robot>,
    /// Pairs of sender and receiver between which everything is lost.
    cut: BTreeSet<(StationId, StationId)>,
    /// What each robot has put out since the script last asked.
    heard: Vec<(StationId, Output)>,
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
            robots,
            cut: BTreeSet::new(),
            heard: Vec::new(),
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
        street.tell(
            ARI,
            Event::CommandManeuver {
                follower: GO2,
                task,
            },
        );
        assert_eq!(street[GO2].state(), State::ManeuverExecuting);
        assert_eq!(street[ARI].state(), State::ManeuverExecuting);
        street.forget();
        street
    }

    /// One input for one robot; whatever it sends is delivered at once.
    pub fn step(&mut self, who: StationId, input: Input) -> Outputs {
        let outputs = self.step_silently(who, input);
        self.deliver(who, &outputs);
        outputs
    }

    fn step_silently(&mut self, who: StationId, input: Input) -> Outputs {
        let robot = self.robots.get_mut(&who).expect("no such robot");
        let before = robot.clone();
        let mut outputs = Outputs::default();
        let allocated = allocation_counter::measure(|| outputs = robot.step(&self.config, input));
        assert_eq!(
            allocated.count_total, 0,
            "{input:?} allocates in {before:#?}"
        );
        assert!(
            robot.is_valid(&self.config),
            "{input:?}\nin {before:#?}\nleads to {robot:#?}"
        );
        if outputs.ignored().is_some() {
            assert_eq!(*robot, before, "{input:?} is ignored, but has an effect");
        }
        self.heard
            .extend(outputs.iter().map(|&output| (who, output)));
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
                if to != from && !self.cut.contains(&(from, to)) {
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

    /// `who` hears `rmcm`, perhaps one from long ago.
    pub fn hears_rmcm(&mut self, who: StationId, rmcm: Rmcm) -> Outputs {
        self.step(who, Input::Rmcm(rmcm))
    }

    /// Time passes for all robots alike, each told at the moment when a timer is due.
    pub fn pass(&mut self, millis: u32) {
        let mut left = millis;
        while left > 0 {
            let due = self
                .robots
                .values()
                .filter_map(Robot::next_due)
                .map(|due| due.0)
                .min();
            let slice = due.unwrap_or(left).min(left);
            // All clocks advance before anybody hears what the others said at that moment.
            let mut told = Vec::new();
            for who in self.stations() {
                told.push((who, self.step_silently(who, Input::Elapsed(Millis(slice)))));
            }
            for (who, outputs) in told {
                self.deliver(who, &outputs);
            }
            left -= slice;
        }
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

    /// Everything that `who` has put out since the script last asked, and forgets it.
    pub fn outputs_of(&mut self, who: StationId) -> Vec<Output> {
        let (of_who, others) = self.heard.drain(..).partition(|&(id, _)| id == who);
        self.heard = others;
        of_who.into_iter().map(|(_, output)| output).collect()
    }

    /// Forgets what was put out so far.
    pub fn forget(&mut self) {
        self.heard.clear();
    }

    /// Whether `who` has put this out since the script last asked or forgot.
    pub fn has_put_out(&self, who: StationId, output: Output) -> bool {
        self.heard.contains(&(who, output))
    }

    /// How often `who` has put out something of this kind.
    pub fn count(&self, who: StationId, of_kind: impl Fn(&Output) -> bool) -> usize {
        self.heard
            .iter()
            .filter(|(id, output)| *id == who && of_kind(output))
            .count()
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

    pub fn session_of(&self, who: StationId) -> SessionId {
        self[who].session().expect("no session")
    }

    /// The maneuver with this request number in the session of `who`.
    pub fn maneuver(&self, who: StationId, request: u8) -> ManeuverId {
        ManeuverId {
            session: self.session_of(who),
            request: RequestId(request),
        }
    }
}

impl std::ops::Index<StationId> for Street {
    type Output = Robot;

    fn index(&self, station: StationId) -> &Robot {
        &self.robots[&station]
    }
}

pub fn starts(output: &Output) -> bool {
    matches!(output, Output::StartManeuver(_))
}

pub fn sends_rmcm(output: &Output) -> bool {
    matches!(output, Output::SendRmcm(_))
}

pub fn sends_ram(output: &Output) -> bool {
    matches!(output, Output::SendRam)
}
