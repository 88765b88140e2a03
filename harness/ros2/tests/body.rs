//! A body that is not simulated: the node that moves it knows by messages what to do, and says what it did.

mod support;

use std::time::Duration;

use crossguard_ros2::graph::{Publisher, now_ns};
use crossguard_ros2::msgs::{Command, Event, Status};
use crossguard_ros2::qos::Qos;
use crossguard_ros2::robot::BodyKind;
use crossguard_ros2::standard::PoseStamped;
use support::{Observer, free_endpoint, meeting, node, robot, two_free_ports, was_at};

fn end_of(start: &Event) -> Command {
    Command {
        kind: Command::DONE,
        session: start.session,
        request: start.request,
        ..Command::default()
    }
}

fn be_at(poses: &Publisher<PoseStamped>, place: [f64; 2]) {
    let mut pose = PoseStamped::default();
    pose.header.stamp.sec = i32::try_from(now_ns() / 1_000_000_000).unwrap();
    (pose.pose.position.x, pose.pose.position.y) = (place[0], place[1]);
    pose.pose.orientation.w = 1.0;
    poses.publish(&pose).unwrap();
}

#[test]
fn a_follower_with_a_body_of_its_own_helps_a_pedestrian_across() {
    let folder = tempfile::tempdir().unwrap();
    let ([ari, go2], first) = (two_free_ports(), free_endpoint());
    let leader = robot(folder.path(), "ARI", 1, ari, go2);
    let mut follower = robot(folder.path(), "Go2", 2, go2, ari);
    follower.body = BodyKind::External;
    let log = follower.log.clone().unwrap();
    let leading = node(meeting(&first, &[]), "/ari", leader);
    let following = node(meeting("tcp/127.0.0.1:0", &[&first]), "/go2", follower);
    let observer = Observer::at(&meeting("tcp/127.0.0.1:0", &[&first]));
    let status = observer.hear::<Status>("/go2/crossguard/status");
    let duties = observer.hear::<Event>("/go2/crossguard/event");
    let news = observer.hear::<Event>("/ari/crossguard/event");
    let [to_leader, to_follower] = ["/ari", "/go2"].map(|it| observer.commands(it));
    let poses = observer
        .node
        .publisher("/go2/crossguard/pose", Qos::depth(1))
        .unwrap();
    for namespace in ["/ari", "/go2"] {
        let lifecycle = observer.lifecycle(namespace);
        assert_eq!(lifecycle.get(), "unconfigured");
        assert!(lifecycle.set("configure") && lifecycle.set("activate"));
    }
    status.until("idle", |it| it.state == Status::STATE_IDLE);
    be_at(&poses, [3.0, 4.0]);
    let detect = Command {
        kind: Command::DETECT,
        followers: 1,
        ..Command::default()
    };
    to_leader.publish(&detect).unwrap();

    let mut last = None;
    for _ in 0..2 {
        let told = duties.until("a maneuver", |it| it.kind == Event::START_MANEUVER);
        let start = told.last().unwrap().clone();
        assert!(start.has_target);
        // Nobody but the one who moves the body finishes it, and not by the end of another one.
        std::thread::sleep(Duration::from_millis(300));
        assert!(
            !news
                .so_far()
                .iter()
                .any(|it| { it.kind == Event::MANEUVER_COMPLETED && it.request == start.request })
        );
        if let Some(before) = last {
            to_follower.publish(&end_of(&before)).unwrap();
            duties.until("no effect", |it| it.kind == Event::COMMAND_IGNORED);
        }
        be_at(&poses, [start.target.x, start.target.y]);
        to_follower.publish(&end_of(&start)).unwrap();
        last = Some(start);
    }
    duties.until("its release", |it| it.kind == Event::RELEASED);
    leading.stop().unwrap();
    following.stop().unwrap();
    let (text, place) = (std::fs::read_to_string(log).unwrap(), last.unwrap().target);
    assert!(was_at(&text, 49.0101, [3.0, 4.0]) && was_at(&text, 49.0101, [place.x, place.y]));
}
