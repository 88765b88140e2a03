//! Three robots at each stage of a session, for tests that look inside.

use crate::config::Config;
use crate::id::StationId;
use crate::input::{Decimetres, Event, Input};
use crate::output::{Output, Outputs};
use crate::state::Robot;
use crate::task::{HelpRequest, Place, TaskSet, TaskType, Urgency};

pub(crate) const ARI: StationId = StationId(1);
pub(crate) const GO2: StationId = StationId(2);
pub(crate) const SPOT: StationId = StationId(3);
const FAR: Decimetres = Decimetres(40);

pub(crate) fn config() -> Config {
    Config::default()
}

fn request() -> HelpRequest {
    HelpRequest {
        urgency: Urgency::Medium,
        followers: 2,
        tasks: TaskSet::of(&[TaskType::MOVE]),
        place: Place(7),
    }
}

/// Robots that hear each other, in the order of their station ids.
pub(crate) struct Team(pub(crate) [Robot; 3]);

impl Team {
    /// Of three that have just booted, the first has detected a pedestrian.
    pub(crate) fn that_asks() -> Self {
        let mut team = Self([ARI, GO2, SPOT].map(|station| Robot::new(station, 1)));
        team.tell(0, Event::PedestrianDetected(request()));
        team
    }

    /// The others offer, and are heard.
    pub(crate) fn that_offers() -> Self {
        let mut team = Self::that_asks();
        team.says(0);
        team.says(1);
        team.says(2);
        team
    }

    /// The first leads, the others follow, and the leader knows.
    pub(crate) fn with_roles() -> Self {
        let mut team = Self::that_offers();
        let time = config().settings().t_select;
        team.0[0].step(&config(), Input::Elapsed(time));
        for speaker in [0, 1, 2] {
            team.says(speaker);
        }
        team
    }

    /// The first follower executes a command and has reported that; a second one waits for its
    /// acknowledgement.
    pub(crate) fn at_work() -> Self {
        let mut team = Self::with_roles();
        let order = Event::CommandManeuver {
            follower: GO2,
            task: TaskType::MOVE,
        };
        let outputs = team.tell(0, order);
        team.pass_on(&outputs, 1);
        team.says(1);
        team.tell(0, order);
        team
    }

    pub(crate) fn tell(&mut self, robot: usize, event: Event) -> Outputs {
        self.0[robot].step(&config(), Input::Local(event))
    }

    fn says(&mut self, speaker: usize) {
        let ram = self.0[speaker].ram();
        for hearer in (0..3).filter(|hearer| *hearer != speaker) {
            let distance = FAR;
            self.0[hearer].step(&config(), Input::Ram { ram, distance });
        }
    }

    fn pass_on(&mut self, outputs: &Outputs, to: usize) {
        for output in outputs.iter() {
            if let Output::SendRmcm(rmcm) = output {
                self.0[to].step(&config(), Input::Rmcm(*rmcm));
            }
        }
    }
}
