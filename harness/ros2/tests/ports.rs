//! Bodies and plans by the ports of `crossguard run`: the body port of the robot file, `--site` and `--plan`.

mod support;

use std::path::Path;
use std::process::{Child, Command as Process, Stdio};
use std::time::{Duration, Instant};

use crossguard_ros2::entity::NodeName;
use crossguard_ros2::msgs::{Command, Corridor, Event, Status, Task};
use crossguard_ros2::node::{Options, start};
use crossguard_ros2::robot::{BodyKind, Robot};
use crossguard_testkit::command::{edit, free_ports};
use support::{Observer, PATIENCE, free_endpoint, meeting, node, robot, two_free_ports, was_at};

/// A process that is killed with its test.
struct Killed(Child);

impl Drop for Killed {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// The example body, ten times as fast as it would walk, at a port that is open soon.
fn body(port: u16, [east, north]: [f64; 2]) -> Killed {
    let deadline = Instant::now() + PATIENCE;
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/body.py");
    loop {
        let mut child = Process::new("python3")
            .arg(&source)
            .arg(format!("127.0.0.1:{port}"))
            .args([east, north, 10.0].map(|it| it.to_string()))
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        // It ends at once while nobody listens.
        let mut looks = 0..30;
        while looks.next().is_some() && child.try_wait().unwrap().is_none() {
            std::thread::sleep(Duration::from_millis(10));
        }
        if child.try_wait().unwrap().is_none() {
            return Killed(child);
        }
        assert!(Instant::now() < deadline, "nobody listens at {port}");
    }
}

/// A leader by a plan that comes with the kit, on a site of its own, and a guard whose body connects at this port.
fn robots(folder: &Path, port: u16) -> [Robot; 2] {
    let street = Path::new(env!("CARGO_MANIFEST_DIR")).join("../robot/plans/street.toml");
    let street = std::fs::read_to_string(street).unwrap();
    let site = folder.join("south.toml");
    std::fs::write(&site, street.replace("49.0101", "48.5")).unwrap();
    let [first, second] = two_free_ports();
    let mut leader = robot(folder, "ARI", 1, first, second);
    leader.plan = Some("bilateral".into());
    let mut guard = robot(folder, "ARI-2", 3, second, first);
    let file = |robot: &Robot| robot.config.to_str().unwrap().to_owned();
    edit(
        &file(&leader),
        &[("autopilot = true", "place = [-4.0, -0.8]")],
    );
    let table = format!("[body]\nlisten = \"127.0.0.1:{port}\"\n\n[link]");
    let changes = [
        ("quadruped", "humanoid"),
        ("autopilot = true\n", ""),
        ("[link]", &table),
    ];
    edit(&file(&guard), &changes);
    for robot in [&mut leader, &mut guard] {
        robot.site = Some(site.clone());
    }
    [leader, guard]
}

#[test]
fn a_body_at_its_port_guards_by_a_plan_of_the_kit_and_its_silence_stops_the_robot() {
    let folder = tempfile::tempdir().unwrap();
    let (first, port) = (free_endpoint(), free_ports(1));
    let [leader, guard] = robots(folder.path(), port);
    let log = guard.log.clone().unwrap();
    let leading = node(meeting(&first, &[]), "/ari", leader);
    let guarding = node(meeting("tcp/127.0.0.1:0", &[&first]), "/guard", guard);
    let observer = Observer::at(&meeting("tcp/127.0.0.1:0", &[&first]));
    let corridor = observer.hear::<Corridor>("/ari/crossguard/corridor");
    let status = observer.hear::<Status>("/guard/crossguard/status");
    let duties = observer.hear::<Event>("/guard/crossguard/event");
    let news = observer.hear::<Event>("/ari/crossguard/event");
    let commands = observer.commands("/ari");
    let lifecycle = observer.lifecycle("/guard");
    for lifecycle in [&observer.lifecycle("/ari"), &lifecycle] {
        assert_eq!(lifecycle.get(), "unconfigured");
        assert!(lifecycle.set("configure") && lifecycle.set("activate"));
    }
    status.until("nobody at the port", |it| {
        it.availability == Status::LOCAL_FAULT
    });
    let walking = body(port, [6.0, 8.2]);
    status.until("its body", |it| {
        it.state == Status::STATE_IDLE && it.availability == Status::AVAILABLE
    });
    let detect = Command {
        kind: Command::DETECT,
        followers: 1,
        ..Command::default()
    };
    commands.publish(&detect).unwrap();
    duties.until("the maneuver of a guard", |it| {
        it.kind == Event::START_MANEUVER && it.task.r#type == Task::BLOCK
    });
    corridor.until("an open corridor", |it| it.open);
    let ended = news.until("the end", |it| it.kind == Event::SESSION_ENDED);
    let text = &ended.last().unwrap().text;
    assert!(text.contains("task completed"), "{text}");
    status.until("idle again", |it| it.state == Status::STATE_IDLE);

    drop(walking);
    status.until("an emergency stop", |it| {
        it.availability == Status::EMERGENCY_STOP
    });
    // The port is closed with the robot, and opened again with it.
    assert!(lifecycle.set("deactivate"));
    // The next activation begins the log anew.
    let text = std::fs::read_to_string(log).unwrap();
    assert!(was_at(&text, 48.5, [6.0, 8.2]) && was_at(&text, 48.5, [6.0, 5.0]));
    assert!(lifecycle.set("activate"));
    let _walking = body(port, [6.0, 8.2]);
    status.until("another body", |it| {
        it.state == Status::STATE_IDLE && it.availability == Status::AVAILABLE
    });
    leading.stop().unwrap();
    guarding.stop().unwrap();
}

#[test]
fn a_plan_that_is_not_there_and_two_who_move_the_body_are_refused_in_words() {
    let folder = tempfile::tempdir().unwrap();
    let [leader, guard] = robots(folder.path(), free_ports(1));
    let lost = Robot {
        plan: Some(folder.path().join("lost.toml")),
        ..leader
    };
    let twice = Robot {
        body: BodyKind::External,
        ..guard
    };
    for (robot, cause) in [(lost, "lost.toml"), (twice, "[body]")] {
        let options = Options {
            meeting: meeting("tcp/127.0.0.1:0", &[]),
            name: NodeName::new("/", "crossguard").unwrap(),
            robot,
            autostart: true,
        };
        let error = start(&options).err().unwrap().to_string();
        assert!(error.contains(cause), "{error}");
    }
}

#[test]
fn a_robot_whose_body_port_is_taken_is_not_activated_and_takes_no_boot_counter() {
    let folder = tempfile::tempdir().unwrap();
    let (first, port) = (free_endpoint(), free_ports(1));
    let [_, guard] = robots(folder.path(), port);
    let running = node(meeting(&first, &[]), "/guard", guard);
    let observer = Observer::at(&meeting("tcp/127.0.0.1:0", &[&first]));
    let lifecycle = observer.lifecycle("/guard");
    assert_eq!(lifecycle.get(), "unconfigured");
    assert!(lifecycle.set("configure"));
    let taken = std::net::TcpListener::bind(("127.0.0.1", port)).unwrap();
    assert!(!lifecycle.set("activate"));
    assert_eq!(lifecycle.get(), "inactive");
    assert!(!folder.path().join("ARI-2.boot").exists());
    drop(taken);
    assert!(lifecycle.set("activate"));
    assert!(folder.path().join("ARI-2.boot").exists());
    running.stop().unwrap();
}
