use crossguard_protocol::{
    Config, Decimetres, Event as Local, HelpRequest, Input, Millis, Outputs, Settings, TaskSet,
    Urgency,
};

use crossguard_endpoint::Act;
use crossguard_robot::site::Site;

use super::*;
use crate::acts;

/// A leader and its follower, who hear each other.
struct Team {
    config: Config,
    robots: [Robot; 2],
    told: Vec<(Input, Outputs, Robot)>,
}

impl Team {
    /// One robot takes something in; the other hears what it says to that.
    fn step(&mut self, who: usize, input: Input) {
        let outputs = self.robots[who].step(&self.config, input);
        if who == 0 {
            self.told.push((input, outputs, self.robots[0].clone()));
        }
        for output in outputs.iter() {
            match output {
                Output::SendRam => {
                    let ram = self.robots[who].ram();
                    let distance = Decimetres(10);
                    self.step(1 - who, Input::Ram { ram, distance });
                }
                Output::SendRmcm(rmcm) => self.step(1 - who, Input::Rmcm(*rmcm)),
                _ => {}
            }
        }
    }

    fn let_pass(&mut self, periods: usize) {
        for _ in 0..periods {
            for who in 0..2 {
                self.step(who, Input::Elapsed(Millis(100)));
            }
        }
    }
}

/// The records of a leader from detection to an open corridor.
fn opening() -> Vec<Record> {
    let mut team = Team {
        config: Config::new(Settings::default()).unwrap(),
        robots: [1, 2].map(|station| Robot::new(StationId(station), 1)),
        told: Vec::new(),
    };
    let request = HelpRequest {
        urgency: Urgency::Medium,
        followers: 1,
        tasks: TaskSet::of(&[TaskType::MOVE]),
        place: protocol::Place::UNKNOWN,
    };
    team.step(0, Input::Local(Local::PedestrianDetected(request)));
    team.let_pass(10);
    let command = Local::CommandManeuver {
        follower: StationId(2),
        task: TaskType::MOVE,
    };
    team.step(0, Input::Local(command));
    team.let_pass(5);
    team.step(0, Input::Local(Local::OpenCorridor));
    let of_step = |(number, (input, outputs, state)): (usize, (Input, Outputs, Robot))| Record {
        at_us: number as u64,
        robot: "ARI".to_owned(),
        entry: Entry::Step {
            input,
            outputs: Box::new(outputs),
            state: Box::new(state),
        },
    };
    team.told.into_iter().enumerate().map(of_step).collect()
}

fn reporter() -> Reporter {
    Reporter::new("ARI", StationId(1))
}

#[test]
fn a_corridor_is_open_while_the_robot_says_so_and_is_heard_of() {
    let mut reporter = reporter();
    let at = |reporter: &Reporter, now_us, is_fresh| {
        let valid_for = Duration::from_millis(300);
        reporter.corridor(Header::default(), valid_for, now_us, is_fresh)
    };
    let corridor = |reporter: &Reporter, is_fresh| {
        let told = at(reporter, reporter.known_us(), is_fresh);
        (told.open, told.reason)
    };
    let first = corridor(&reporter, true);
    assert_eq!(first, (false, Corridor::REASON_NOT_LEADING));
    let mut reasons = Vec::new();
    for record in opening() {
        reporter.take(&record);
        reasons.push(corridor(&reporter, true).1);
    }
    reasons.dedup();
    let expected = [
        Corridor::REASON_NOT_LEADING,
        Corridor::REASON_NOT_OPENED,
        Corridor::REASON_NONE,
    ];
    assert_eq!(reasons, expected);
    assert_eq!(corridor(&reporter, true), (true, Corridor::REASON_NONE));
    // No longer than the leases stand, whatever else comes.
    let ends_us = reporter.go_ends_us;
    let told = at(&reporter, ends_us - 100_000, true);
    assert!(told.open && told.road_occupied);
    assert_eq!(told.valid_for.nanosec, 100_000_000);
    let told = at(&reporter, ends_us, true);
    assert!(!told.open && told.road_occupied);
    assert_eq!(told.reason, Corridor::REASON_STALE);
    // It still says so, but nobody knows how long ago.
    assert_eq!(corridor(&reporter, false), (false, Corridor::REASON_STALE));
    assert_eq!(reporter.diagnostic(String::new(), false).level, STALE);
}

#[test]
fn the_news_of_a_leader_are_events_with_the_follower_and_the_session() {
    let mut reporter = reporter();
    let mut events = Vec::new();
    for record in opening() {
        reporter.take(&record);
        if let Entry::Step { outputs, .. } = &record.entry {
            let told = outputs.notices().map(Act::Notice);
            events.extend(told.filter_map(|act| acts::event(&act, &Site::default())));
        }
    }
    let of_kind = |kind| events.iter().find(|it| it.kind == kind).unwrap();
    assert_eq!(of_kind(Event::FOLLOWER_JOINED).station, 2);
    let session = of_kind(Event::ROLES_ESTABLISHED).session;
    let told = of_kind(Event::MANEUVER_REPORTED);
    assert_eq!((told.station, told.session), (2, session));
    assert!(!told.text.is_empty());
    let status = reporter.status(Header::default());
    assert_eq!(
        (status.role, status.session),
        (Status::ROLE_LEADER, session)
    );
    let [follower] = status.followers.as_slice() else {
        panic!("{status:?}")
    };
    assert_eq!(follower.progress, Follower::PROGRESS_EXECUTING);
    assert!(follower.has_lease && follower.has_joined);
    assert_eq!(status.corridor, Status::CORRIDOR_OPEN);
}
