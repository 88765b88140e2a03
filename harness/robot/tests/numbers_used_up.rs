//! A robot that gives out half of the numbers of its boot counter persists the next one while it runs, and
//! goes on with that. Where the counter cannot be written it says so, and tries again.

use std::fs;
use std::time::{Duration, Instant};

use crossguard_endpoint::Stimulus;
use crossguard_endpoint::cause::Cause;
use crossguard_protocol::{Event, Input, StationId};
use crossguard_robot::application::Application;
use crossguard_robot::body::{Build, Simulated};
use crossguard_robot::boot;
use crossguard_robot::journal::{Journal, WhenFull};
use crossguard_robot::plan::Plan;
use crossguard_robot::runtime::{Order, Setup};
use crossguard_robot::site::{Place, Site};
use crossguard_robot::trace::Entry;
use crossguard_robot::transport::{Link, Transport};

/// The robot takes 32,768 requests, and a record of each step.
const PATIENCE: Duration = Duration::from_mins(15);

#[test]
fn the_next_boot_counter_is_persisted_and_used_before_numbers_run_out() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("robot.boot");
    let boot = boot::take(&path).unwrap();
    // Something else is where the counter is kept.
    let kept = fs::read(&path).unwrap();
    fs::remove_file(&path).unwrap();
    fs::create_dir(&path).unwrap();

    let mut journal = Journal::new();
    let records = journal.reader(4_096, WhenFull::Skip, Cause::OutputFull);
    let body = Simulated::new(Build::Quadruped, Site::default(), Place::default(), 1.0, 1);
    let application = Application::new(Box::new(body), None);
    let link = Link::loopback(0, Vec::new()).open().unwrap();
    let robot = Setup {
        boot,
        journal,
        ..Setup::new("R1", StationId(1), application, link)
    }
    .start();
    let request = Plan::crossing(Site::default()).request();
    let asks = Order::Tell(Stimulus::Event(Event::PedestrianDetected(request)));
    let leaves = Order::Tell(Stimulus::Event(Event::LeaveRequested));
    let (mut complained, mut renewed) = (0, None);
    let deadline = Instant::now() + PATIENCE;
    while renewed.is_none() && Instant::now() < deadline {
        robot.order(asks.clone());
        robot.order(leaves.clone());
        for record in records.try_iter() {
            match &record.entry {
                Entry::Dropped { cause, .. } if *cause == Cause::EpochNotRenewed.into() => {
                    complained += 1;
                    if complained == 1 {
                        fs::remove_dir(&path).unwrap();
                        fs::write(&path, &kept).unwrap();
                    }
                }
                Entry::Step {
                    input: Input::Local(Event::EpochRenewed(boot)),
                    state,
                    ..
                } => renewed = Some((*boot, state.boot())),
                _ => {}
            }
        }
    }
    robot.stop().unwrap();
    assert!(
        complained > 0,
        "a counter that cannot be written is complained about"
    );
    assert_eq!(renewed, Some((2, 2)));
    assert_eq!(boot::take(&path).unwrap().counter, 3);
}
