//! Two nodes help a pedestrian across; all that is told and seen are messages of ROS.

mod support;

use std::path::Path;

use crossguard_codec::{Identifiers, PublicSignal, SignalMeans, SignalsShown};
use crossguard_endpoint::station::listen::overhear;
use crossguard_robot::trace::{Entry, Record};
use crossguard_ros2::msgs::{Command, Corridor, Event, Status, Task};
use crossguard_ros2::robot::Robot;
use crossguard_ros2::standard::DiagnosticArray;
use crossguard_testkit::command::edit;
use support::{Observer, free_endpoint, meeting, node, robot, two_free_ports};

#[test]
fn a_crossing_is_commanded_and_observed_by_messages_alone() {
    let folder = tempfile::tempdir().unwrap();
    let (first, [leader, follower]) = (free_endpoint(), robots(folder.path()));
    let log = follower.log.clone().unwrap();
    let leading = node(meeting(&first, &[]), "/ari", leader);
    let following = node(meeting("tcp/127.0.0.1:0", &[&first]), "/go2", follower);
    let observer = Observer::at(&meeting("tcp/127.0.0.1:0", &[&first]));
    let corridor = observer.hear::<Corridor>("/ari/crossguard/corridor");
    let status = observer.hear::<Status>("/ari/crossguard/status");
    let news = observer.hear::<Event>("/ari/crossguard/event");
    let duties = observer.hear::<Event>("/go2/crossguard/event");
    let diagnostics = observer.hear::<DiagnosticArray>("/diagnostics");
    let commands = observer.commands("/ari");
    let lifecycles = ["/ari", "/go2"].map(|namespace| observer.lifecycle(namespace));
    for lifecycle in &lifecycles {
        assert_eq!(lifecycle.get(), "unconfigured");
        assert!(lifecycle.set("configure"));
        assert!(lifecycle.set("activate"));
        assert_eq!(lifecycle.get(), "active");
    }
    status.until("idle", |it| it.state == Status::STATE_IDLE);

    commands.publish(&show()).unwrap();
    let detect = Command {
        kind: Command::DETECT,
        followers: 1,
        urgency: Command::URGENCY_MEDIUM,
        ..Command::default()
    };
    commands.publish(&detect).unwrap();
    let leads = status.until("a follower", |it| !it.followers.is_empty());
    let leads = leads.last().unwrap();
    assert_eq!((leads.role, leads.station), (Status::ROLE_LEADER, 1));
    assert_eq!(leads.followers[0].station, 2);
    let before = corridor.until("an open corridor", |it| it.open);
    let open = before.last().unwrap();
    assert_eq!(
        (open.reason, open.in_session),
        (Corridor::REASON_NONE, true)
    );
    assert_eq!(open.valid_for.nanosec, 300_000_000);
    let (_, closed) = before.split_last().unwrap();
    assert!(closed.iter().all(|it| it.reason != Corridor::REASON_NONE));
    // The follower has brought the pedestrian across, and holds nothing open any more.
    let after = corridor.until("a closed corridor", |it| !it.open);
    let closed = after.last().unwrap();
    assert_eq!(
        (closed.reason, closed.follower),
        (Corridor::REASON_NOT_ENGAGED, 2)
    );
    status.until("idle again", |it| it.state == Status::STATE_IDLE);

    let told = news.until("the end", |it| it.kind == Event::SESSION_ENDED);
    let kinds: Vec<u8> = told.iter().map(|it| it.kind).collect();
    let expected = [
        Event::ROLES_ESTABLISHED,
        Event::FOLLOWER_JOINED,
        Event::COMMAND_ACKNOWLEDGED,
        Event::MANEUVER_COMPLETED,
        Event::COMMAND_ACKNOWLEDGED,
        Event::MANEUVER_COMPLETED,
        Event::SESSION_ENDED,
    ];
    let mut rest = kinds.iter();
    for kind in expected {
        assert!(rest.any(|it| *it == kind), "{kind} is missing in {kinds:?}");
    }
    let done = duties.until("its release", |it| it.kind == Event::RELEASED);
    let begun: Vec<_> = done
        .iter()
        .filter(|it| it.kind == Event::START_MANEUVER)
        .collect();
    let tasks: Vec<u8> = begun.iter().map(|it| it.task.r#type).collect();
    assert_eq!(tasks, [Task::INITIAL_POS, Task::MOVE]);
    for start in begun {
        assert!(start.has_target && start.maximum_speed > 0.0, "{start:?}");
        assert_eq!((start.session.leader, start.station), (1, 1));
        assert_eq!(start.map_place, "intersection 276:4711");
    }

    let counted = diagnostics.until("counters", |it| {
        it.status
            .iter()
            .any(|it| it.name == "/ari/crossguard: robot")
    });
    let robot = counted.last().unwrap().status.last().unwrap();
    assert!(
        robot
            .values
            .iter()
            .any(|it| it.key == "messages sent" && it.value != "0")
    );

    for lifecycle in &lifecycles {
        assert!(lifecycle.set("shutdown"));
        assert_eq!(lifecycle.get(), "finalized");
    }
    let gone = corridor.until("no robot", |it| it.reason == Corridor::REASON_INACTIVE);
    assert!(gone.iter().all(|it| !it.open));
    leading.stop().unwrap();
    following.stop().unwrap();
    check_signals(&log);
}

/// A leader that names its crossing, and a follower.
fn robots(folder: &Path) -> [Robot; 2] {
    let [ari, go2] = two_free_ports();
    let leader = robot(folder, "ARI", 1, ari, go2);
    let config = leader.config.to_str().unwrap();
    edit(
        config,
        &[("autopilot", "crossing = \"276:4711\"\nautopilot")],
    );
    [leader, robot(folder, "Go2", 2, go2, ari)]
}

fn show() -> Command {
    Command {
        kind: Command::SHOW,
        to_vehicles: Command::SIGNAL_STOP,
        signal_means: Command::MEANS_GESTURE,
        ..Command::default()
    }
}

/// The follower has heard what the leader shows to vehicles, and its sign.
fn check_signals(log: &Path) {
    let shown = signals_heard(log);
    let of_leader = |it: &SignalsShown| {
        (it.to_vehicles, it.means) == (PublicSignal::Stop, SignalMeans::GESTURE)
    };
    assert!(
        !shown.is_empty() && shown.iter().all(of_leader),
        "{shown:?}"
    );
    // Stop, or go for as long as the corridor is open.
    let has_sign = |it: &SignalsShown| it.to_pedestrians != PublicSignal::None;
    assert!(shown.iter().any(has_sign), "{shown:?}");
}

/// What other robots show to people, by the RAM in a robot's log.
fn signals_heard(log: &Path) -> Vec<SignalsShown> {
    let text = std::fs::read_to_string(log).unwrap();
    let records = text.lines().map(|line| serde_json::from_str(line).unwrap());
    let signals = records.filter_map(|record: Record| match record.entry {
        Entry::Heard { octets, .. } => {
            let heard = overhear(&Identifiers::default(), &octets).unwrap();
            heard.state?.slow?.signals
        }
        _ => None,
    });
    signals.collect()
}
