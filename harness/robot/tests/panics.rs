//! Ends of a running robot. One whose thread panics is noticed: its body is halted, and its owner is told.

use std::net::UdpSocket;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::Receiver;
use std::time::{Duration, Instant};

use crossguard_codec::RobotState;
use crossguard_endpoint::Stimulus;
use crossguard_endpoint::cause::Cause;
use crossguard_endpoint::ras::clustering::PerceivedVru;
use crossguard_protocol::{
    self as protocol, Event, HelpRequest, Input, Phase, StationId, TaskSet, TaskType, Urgency,
};
use crossguard_robot::application::Application;
use crossguard_robot::body::{Body, BodyAct, Build, Fallback, NotTaken, Report, Simulated};
use crossguard_robot::journal::{RECORDS, WhenFull};
use crossguard_robot::perception::SensorFrame;
use crossguard_robot::runtime::{Order, Panicked, Running, Setup};
use crossguard_robot::site::{Place, Site};
use crossguard_robot::street::{Road, Street};
use crossguard_robot::trace::{Entry, Record};
use crossguard_robot::transport::{Link, Transport};

/// A body whose driver has a mistake in it, which shows when it is told to.
#[derive(Debug)]
struct Mistaken {
    body: Simulated,
    shows: Arc<AtomicBool>,
    is_halted: Arc<AtomicBool>,
}

impl Body for Mistaken {
    fn act(&mut self, act: BodyAct) -> Result<(), NotTaken> {
        self.body.act(act)
    }

    fn advance(&mut self, seconds: f64) -> Vec<Report> {
        assert!(!self.shows.load(Ordering::Relaxed), "the mistake");
        self.body.advance(seconds)
    }

    fn state(&self) -> RobotState {
        self.body.state()
    }

    fn place(&self) -> Place {
        self.body.place()
    }

    fn fallback(&self) -> Option<Fallback> {
        self.body.fallback()
    }

    fn release(&mut self) {
        self.body.release();
    }

    fn halt(&mut self) {
        self.is_halted.store(true, Ordering::Relaxed);
        self.body.halt();
    }
}

fn start(shows: &Arc<AtomicBool>, is_halted: &Arc<AtomicBool>) -> Running {
    let body = Mistaken {
        body: Simulated::new(Build::Quadruped, Site::default(), Place::default(), 1.0, 1),
        shows: Arc::clone(shows),
        is_halted: Arc::clone(is_halted),
    };
    let application = Application::new(Box::new(body), None);
    let link = Link::loopback(0, Vec::new()).open().unwrap();
    Setup::new("R1", StationId(1), application, link).start()
}

#[test]
fn a_robot_that_panics_halts_its_body_and_says_so() {
    let (shows, is_halted) = (Arc::default(), Arc::default());
    let robot = start(&shows, &is_halted);
    shows.store(true, Ordering::Relaxed);
    while !robot.has_stopped() {
        std::thread::sleep(Duration::from_millis(5));
    }
    assert!(is_halted.load(Ordering::Relaxed));
    // No robot is there to obey, and nobody has to wait.
    robot.order(Order::Stop);
    assert_eq!(robot.wait(), Err(Panicked));
}

/// Hazard: an operator says that everybody is across while the robot's own sensors have somebody on the road, and guards leave.
#[test]
fn a_task_is_not_completed_while_the_robots_sensors_have_somebody_on_the_road() {
    let body = Simulated::new(Build::Quadruped, Site::default(), Place::default(), 1.0, 1);
    let application = Application::new(Box::new(body), None);
    let application = application.on(Road::Watched(Street::default().zone()));
    let link = Link::loopback(0, Vec::new()).open().unwrap();
    let mut setup = Setup::new("R", StationId(1), application, link);
    let records = setup
        .journal
        .reader(RECORDS, WhenFull::Skip, Cause::OutputFull);
    let robot = setup.start();
    let frame = SensorFrame::of(&[PerceivedVru::pedestrian(1, [1.0, 3.0])]);
    // A source whose clock is ahead: its frame is young whenever the robot reads it.
    let taken = Instant::now() + Duration::from_mins(10);
    robot.order(Order::Looked(Arc::new(frame), taken));
    let completed = Event::TaskCompleted;
    robot.order(Order::Tell(Stimulus::Event(completed)));
    robot.order(Order::Stop);
    robot.wait().unwrap();
    let mut is_refused = false;
    for record in records {
        match &record.entry {
            Entry::Dropped { cause, .. } => is_refused |= *cause == Cause::SaidTooEarly.into(),
            Entry::Step { input, .. } => assert_ne!(*input, Input::Local(completed)),
            _ => {}
        }
    }
    assert!(is_refused);
}

/// A robot at this port that hears the one at the other, and whether it offers its help.
fn at_port(station: u32, [own, other]: [u16; 2]) -> (Running, Receiver<Arc<Record>>) {
    let body = Simulated::new(Build::Quadruped, Site::default(), Place::default(), 1.0, 1);
    let application = Application::new(Box::new(body), None);
    let peer = ([127, 0, 0, 1], other).into();
    let link = Link::loopback(own, vec![peer]).open().unwrap();
    let mut setup = Setup::new("R", StationId(station), application, link);
    let records = setup
        .journal
        .reader(RECORDS, WhenFull::Skip, Cause::OutputFull);
    (setup.start(), records)
}

/// Hazard: a robot that is told to stop is asked for help while it says farewell, and helps. Its operator, or the machine,
/// loses patience, and ends it in the middle of a crossing.
#[test]
fn a_robot_that_is_told_to_stop_helps_nobody_any_more() {
    let [one, two] = [(); 2].map(|()| UdpSocket::bind("127.0.0.1:0").unwrap());
    let ports = [&one, &two].map(|it| it.local_addr().unwrap().port());
    drop((one, two));
    let (requester, _) = at_port(1, ports);
    let (helper, records) = at_port(2, [ports[1], ports[0]]);
    // One helper is too few, so it asks until the test is over.
    let request = HelpRequest {
        urgency: Urgency::Medium,
        followers: 2,
        tasks: TaskSet::of(&[TaskType::BLOCK]),
        place: protocol::Place::UNKNOWN,
    };
    let asks = Event::PedestrianDetected(request);
    requester.order(Order::Tell(Stimulus::Event(asks)));
    let offers = |record: Arc<Record>| match &record.entry {
        Entry::Step { state, .. } => matches!(state.phase(), Phase::Offering(_)),
        _ => false,
    };
    while !offers(records.recv_timeout(Duration::from_secs(30)).unwrap()) {}
    let told = Instant::now();
    helper.stop().unwrap();
    let took = told.elapsed();
    requester.stop().unwrap();
    assert!(took < Duration::from_secs(5), "{took:?}");
}

/// Hazard: the disk is full, the robot goes on without a log, and no program at its operator port hears of it.
#[test]
fn the_end_of_a_log_is_told_once_to_the_readers_that_are_left() {
    for reads in [false, true] {
        let body = Simulated::new(Build::Quadruped, Site::default(), Place::default(), 1.0, 1);
        let application = Application::new(Box::new(body), None);
        let link = Link::loopback(0, Vec::new()).open().unwrap();
        let mut setup = Setup::new("R1", StationId(1), application, link);
        // It has gone, or reads nothing.
        let log = setup.journal.reader(1, WhenFull::End, Cause::LogFull);
        let _log = Some(log).filter(|_| reads);
        let records = setup
            .journal
            .reader(RECORDS, WhenFull::Skip, Cause::OutputFull);
        let robot = setup.start();
        robot.order(Order::Tell(Stimulus::Event(Event::LeaveRequested)));
        robot.stop().unwrap();
        let told = |record: &Arc<Record>| matches!(&record.entry, Entry::Dropped { cause, .. } if *cause == Cause::LogFull.into());
        let told = records.iter().filter(told).count();
        assert_eq!(told, 1, "{reads}");
    }
}

#[test]
fn a_robot_that_stops_in_order_has_not_panicked() {
    let (shows, is_halted) = (Arc::default(), Arc::default());
    assert_eq!(start(&shows, &is_halted).stop(), Ok(()));
    assert!(!is_halted.load(Ordering::Relaxed));
}
