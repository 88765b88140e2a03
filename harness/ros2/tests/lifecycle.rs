//! The lifecycle of a node: what it refuses, and what a robot does on its way out.

mod support;

use std::path::Path;
use std::time::Duration;

use crossguard_ros2::entity::ADMIN_SPACE;
use crossguard_ros2::msgs::{Command, Corridor, Event, Person, Status};
use crossguard_ros2::node::Running;
use crossguard_ros2::qos::Qos;
use crossguard_ros2::standard::{
    Empty, GetAvailableStates, GetAvailableTransitions, TransitionEvent,
};
use support::{Observer, PATIENCE, free_endpoint, meeting, node, robot, two_free_ports};
use zenoh::Wait;

fn of(kind: u8) -> Command {
    Command {
        kind,
        ..Command::default()
    }
}

/// ARI as a node of this namespace, and where it can be met.
fn ari(folder: &Path, namespace: &str) -> (Running, String) {
    let ([port, peer], first) = (two_free_ports(), free_endpoint());
    let alone = robot(folder, "ARI", 1, port, peer);
    (node(meeting(&first, &[]), namespace, alone), first)
}

#[test]
fn what_is_not_possible_now_is_refused_and_said() {
    let folder = tempfile::tempdir().unwrap();
    let ([port, peer], first) = (two_free_ports(), free_endpoint());
    let alone = robot(folder.path(), "ARI", 1, port, peer);
    let config = alone.config.clone();
    let text = std::fs::read_to_string(&config).unwrap();
    std::fs::write(&config, "name = 3").unwrap();
    let running = node(meeting(&first, &[]), "/", alone);
    let observer = Observer::at(&meeting("tcp/127.0.0.1:0", &[&first]));
    let lifecycle = observer.lifecycle("");
    let events = observer.hear::<Event>("/crossguard/event");
    let transitions = observer.hear::<TransitionEvent>("/crossguard/transition_event");
    let commands = observer.commands("");
    assert_eq!(lifecycle.get(), "unconfigured");
    assert!(!lifecycle.set("activate"));
    assert!(!lifecycle.set("dance"));
    // A configuration that cannot be used.
    assert!(!lifecycle.set("configure"));
    assert_eq!(lifecycle.get(), "unconfigured");
    let failed = transitions.until("a failure", |it| it.transition.id == 11);
    assert_eq!(
        failed.last().unwrap().transition.label,
        "transition_failure"
    );
    std::fs::write(&config, text).unwrap();
    assert!(lifecycle.set("configure"));
    // No robot, no commands.
    commands.publish(&of(Command::LEAVE)).unwrap();
    let refused = events.until("a refusal", |it| it.kind == Event::COMMAND_REFUSED);
    assert!(refused[0].text.contains("inactive"), "{refused:?}");
    // Another process has the robot's boot counter.
    let boot = crossguard_robot::boot::take(&folder.path().join("ARI.boot")).unwrap();
    assert!(!lifecycle.set("activate"));
    assert_eq!(lifecycle.get(), "inactive");
    drop(boot);
    assert!(lifecycle.set("activate"));
    commands.publish(&of(99)).unwrap();
    let refused = events.until("a refusal", |it| it.kind == Event::COMMAND_REFUSED);
    assert!(refused.last().unwrap().text.contains("99"), "{refused:?}");
    // A command that has no effect now.
    commands.publish(&of(Command::OPEN_CORRIDOR)).unwrap();
    events.until("no effect", |it| it.kind == Event::COMMAND_IGNORED);
    let people = observer
        .node
        .publisher::<Person>("/crossguard/perceived", Qos::depth(10));
    let nobody = Person {
        kind: 9,
        ..Person::default()
    };
    people.unwrap().publish(&nobody).unwrap();
    assert!(lifecycle.set("deactivate"));
    assert!(lifecycle.set("cleanup"));
    assert!(lifecycle.set("shutdown"));
    assert!(!lifecycle.set("configure"));
    running.stop().unwrap();
}

#[test]
fn a_robot_that_is_deactivated_leaves_its_request_and_says_that_the_corridor_is_closed() {
    let folder = tempfile::tempdir().unwrap();
    let (running, first) = ari(folder.path(), "/ari");
    let observer = Observer::at(&meeting("tcp/127.0.0.1:0", &[&first]));
    let lifecycle = observer.lifecycle("/ari");
    let status = observer.hear::<Status>("/ari/crossguard/status");
    let corridor = observer.hear::<Corridor>("/ari/crossguard/corridor");
    let events = observer.hear::<Event>("/ari/crossguard/event");
    corridor.until("no robot", |it| it.reason == Corridor::REASON_INACTIVE);
    assert_eq!(lifecycle.get(), "unconfigured");
    assert!(lifecycle.set("configure") && lifecycle.set("activate"));
    let detect = Command {
        followers: 1,
        ..of(Command::DETECT)
    };
    observer.commands("/ari").publish(&detect).unwrap();
    status.until("a request", |it| it.state == Status::STATE_HELP_REQUESTED);
    assert!(lifecycle.set("deactivate"));
    events.until("the end", |it| it.kind == Event::SESSION_ENDED);
    status.until("no robot", |it| it.state == Status::STATE_INACTIVE);
    corridor.until("no robot", |it| it.reason == Corridor::REASON_INACTIVE);
    // The next life has the next boot counter.
    assert!(lifecycle.set("activate"));
    let again = status.until("a robot", |it| it.state == Status::STATE_IDLE);
    assert_eq!(again.last().unwrap().boot, 2);
    running.stop().unwrap();
}

#[test]
fn the_graph_has_the_node_with_all_its_parts_until_it_ends() {
    let folder = tempfile::tempdir().unwrap();
    let (running, first) = ari(folder.path(), "/ari");
    let mut config = zenoh::Config::default();
    config
        .insert_json5("connect/endpoints", &format!("[{first:?}]"))
        .unwrap();
    config
        .insert_json5("scouting/multicast/enabled", "false")
        .unwrap();
    let session = zenoh::open(config).wait().unwrap();
    let tokens = || {
        let (come, tokens) = std::sync::mpsc::channel();
        session
            .liveliness()
            .get(format!("{ADMIN_SPACE}/7/**"))
            .timeout(Duration::from_secs(2))
            .callback(move |reply| {
                if let Ok(sample) = reply.result() {
                    let _ = come.send(sample.key_expr().to_string());
                }
            })
            .wait()
            .unwrap();
        let mut tokens: Vec<String> = tokens.into_iter().collect();
        tokens.sort();
        tokens
    };
    let found = tokens();
    let parts = |token: &String| token.split('/').map(str::to_owned).collect::<Vec<_>>();
    let nodes = found.iter().map(parts).filter(|it| it[5] == "NN").count();
    assert_eq!(nodes, 1, "{found:#?}");
    let names = |kind: &str| {
        let of_kind = found.iter().map(parts).filter(|it| it[5] == kind);
        let mut names: Vec<_> = of_kind.map(|it| it[9].replace('%', "/")).collect();
        names.sort();
        names
    };
    let own = |names: &[&str]| {
        names
            .iter()
            .map(|it| format!("/ari/crossguard/{it}"))
            .collect()
    };
    let mut published: Vec<String> = own(&["corridor", "event", "status", "transition_event"]);
    published.push("/diagnostics".to_owned());
    assert_eq!(names("MP"), published);
    assert_eq!(
        names("MS"),
        own(&["battery", "command", "perceived", "pose"]) as Vec<String>
    );
    let services = [
        "change_state",
        "get_available_states",
        "get_available_transitions",
        "get_state",
        "get_transition_graph",
    ];
    assert_eq!(names("SS"), own(&services) as Vec<String>);
    let corridor = found.iter().find(|it| it.contains("%corridor/")).unwrap();
    assert!(
        corridor.ends_with("/::,1:0,300000000:,:,,")
            && corridor.contains("/%/%ari/crossguard/%ari%crossguard%corridor/crossguard_msgs::msg::dds_::Corridor_/RIHS01_"),
        "{corridor}"
    );
    running.stop().unwrap();
    assert_eq!(tokens(), [] as [String; 0]);
}

#[test]
fn states_and_transitions_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let (running, first) = ari(folder.path(), "/");
    let observer = Observer::at(&meeting("tcp/127.0.0.1:0", &[&first]));
    assert_eq!(observer.lifecycle("").get(), "unconfigured");
    let states = observer
        .node
        .client::<GetAvailableStates>("/crossguard/get_available_states")
        .unwrap();
    let states = states.call(&Empty::default(), PATIENCE).unwrap();
    assert_eq!(states.available_states.len(), 9);
    let ways = |service: &str| {
        let client = observer
            .node
            .client::<GetAvailableTransitions>(service)
            .unwrap();
        let ways = client.call(&Empty::default(), PATIENCE).unwrap();
        let ways = ways.available_transitions.into_iter();
        ways.map(|it| it.transition.label).collect::<Vec<_>>()
    };
    let now = ways("/crossguard/get_available_transitions");
    assert_eq!(now, ["configure", "shutdown"]);
    assert_eq!(ways("/crossguard/get_transition_graph").len(), 7);
    running.stop().unwrap();
}
