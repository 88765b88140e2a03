//! Two nodes help a pedestrian across; all that is told and seen are messages of ROS.

mod support;

use crossguard_ros2::msgs::{Command, Corridor, Event, Status, Task};
use crossguard_ros2::standard::DiagnosticArray;
use support::{Observer, free_endpoint, meeting, node, robot, two_free_ports};

#[test]
fn a_crossing_is_commanded_and_observed_by_messages_alone() {
    let folder = tempfile::tempdir().unwrap();
    let ([ari, go2], first) = (two_free_ports(), free_endpoint());
    let leader = robot(folder.path(), "ARI", 1, ari, go2);
    let follower = robot(folder.path(), "Go2", 2, go2, ari);
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
}
