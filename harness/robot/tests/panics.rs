//! A robot whose thread panics is noticed: its body is halted, and who waits for it is told.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use crossguard_codec::RobotState;
use crossguard_protocol::StationId;
use crossguard_robot::application::Application;
use crossguard_robot::body::{Body, BodyAct, Build, Fallback, NotTaken, Report, Simulated};
use crossguard_robot::runtime::{Order, Panicked, Running, Setup};
use crossguard_robot::site::{Place, Site};
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

    fn stands_at(&self, place: Place) -> bool {
        self.body.stands_at(place)
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

#[test]
fn a_robot_that_stops_in_order_has_not_panicked() {
    let (shows, is_halted) = (Arc::default(), Arc::default());
    assert_eq!(start(&shows, &is_halted).stop(), Ok(()));
    assert!(!is_halted.load(Ordering::Relaxed));
}
