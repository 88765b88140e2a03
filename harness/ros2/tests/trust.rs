//! Hazard: somebody on the ROS graph commands a robot that takes nothing from strangers by radio.

mod support;

use std::fs;
use std::path::Path;

use crossguard_codec::{Identifiers, Part};
use crossguard_endpoint::station::Mode;
use crossguard_robot::pki::{self, Pki, Term};
use crossguard_ros2::msgs::{Command, Event, Person, Status};
use crossguard_ros2::qos::Qos;
use crossguard_ros2::robot::{BodyKind, Robot};
use crossguard_ros2::standard::DiagnosticArray;
use support::{Observer, free_endpoint, meeting, node, robot, two_free_ports};

/// A robot that signs, and takes signed packets only; what its file says besides.
fn enforcing(folder: &Path, besides: &str) -> Robot {
    let [port, peer] = two_free_ports();
    let robot = robot(folder, "ARI", 1, port, peer);
    let text = fs::read_to_string(&robot.config).unwrap();
    fs::write(&robot.config, format!("{besides}{text}")).unwrap();
    let (ids, now) = (Identifiers::default(), pki::now());
    let pki = Pki::for_a_day(&ids, now).unwrap();
    let own = folder.join("own");
    let term = Term {
        from: now,
        duration: crossguard_codec::security::Duration::hours(1),
    };
    let permissions = pki::robot_permissions(&ids, &[Part::Lead, Part::Help], None);
    let ticket = pki::new_ticket(&pki.authority, term, None, permissions).unwrap();
    pki::write_ticket(&ticket, &own).unwrap();
    pki::write_certificate(&pki.root.certificate, &own, "root").unwrap();
    pki::write_certificate(&pki.authority.certificate, &own, "authority").unwrap();
    Robot {
        security: Mode::Enforce,
        pki: Some(own),
        ..robot
    }
}

fn detect() -> Command {
    Command {
        kind: Command::DETECT,
        followers: 1,
        ..Command::default()
    }
}

#[test]
fn a_robot_that_takes_signed_packets_only_takes_nothing_from_the_graph() {
    let folder = tempfile::tempdir().unwrap();
    let first = free_endpoint();
    let running = node(meeting(&first, &[]), "/ari", enforcing(folder.path(), ""));
    let observer = Observer::at(&meeting("tcp/127.0.0.1:0", &[&first]));
    let lifecycle = observer.lifecycle("/ari");
    let events = observer.hear::<Event>("/ari/crossguard/event");
    let status = observer.hear::<Status>("/ari/crossguard/status");
    let diagnostics = observer.hear::<DiagnosticArray>("/diagnostics");
    assert!(lifecycle.set("configure") && lifecycle.set("activate"));
    observer.commands("/ari").publish(&detect()).unwrap();
    let refused = events.until("a refusal", |it| it.kind == Event::COMMAND_REFUSED);
    let text = &refused.last().unwrap().text;
    assert!(text.contains("trust_ros_graph"), "{text}");
    // People that the graph reports are not believed either: two are counted.
    let people = observer
        .node
        .publisher::<Person>("/ari/crossguard/perceived", Qos::depth(10));
    people.unwrap().publish(&Person::default()).unwrap();
    diagnostics.until("both in the diagnostics", |it| {
        let values = it.status.iter().flat_map(|it| &it.values);
        values
            .into_iter()
            .any(|it| it.key.contains("graph not trusted") && it.value == "2")
    });
    let all = status.so_far();
    assert!(
        all.iter()
            .all(|it| it.state != Status::STATE_HELP_REQUESTED),
        "{all:?}"
    );
    running.stop().unwrap();
}

#[test]
fn a_graph_that_the_robots_file_trusts_commands_it_and_a_body_of_others_needs_that() {
    let folder = tempfile::tempdir().unwrap();
    let first = free_endpoint();
    let trusting = enforcing(folder.path(), "trust_ros_graph = true\n");
    let running = node(meeting(&first, &[]), "/ari", trusting);
    let observer = Observer::at(&meeting("tcp/127.0.0.1:0", &[&first]));
    let lifecycle = observer.lifecycle("/ari");
    let status = observer.hear::<Status>("/ari/crossguard/status");
    assert!(lifecycle.set("configure") && lifecycle.set("activate"));
    observer.commands("/ari").publish(&detect()).unwrap();
    status.until("a request", |it| it.state == Status::STATE_HELP_REQUESTED);
    running.stop().unwrap();

    let other = tempfile::tempdir().unwrap();
    let first = free_endpoint();
    let moved = Robot {
        body: BodyKind::External,
        ..enforcing(other.path(), "")
    };
    let running = node(meeting(&first, &[]), "/ari", moved);
    let observer = Observer::at(&meeting("tcp/127.0.0.1:0", &[&first]));
    assert!(
        !observer.lifecycle("/ari").set("configure"),
        "nobody could move it"
    );
    running.stop().unwrap();
}
