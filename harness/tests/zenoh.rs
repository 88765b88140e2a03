//! Robots that meet over zenoh: as peers, through a router, on this machine. These tests take the feature
//! `zenoh`.

use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

use crossguard_robot::transport::{
    Arrival, Halves, Link, LinkError, Reopening, Source, Transport, WithFaults, Zenoh, ZenohError,
    ZenohMode, ZenohRouter,
};
use crossguard_testkit::command::*;

const PATIENCE: Duration = Duration::from_mins(1);

fn endpoint(port: u16) -> String {
    format!("tcp/127.0.0.1:{port}")
}

/// Peers, each connected to each other, whose keys these are.
fn peers(keys: &[&str]) -> Vec<Zenoh> {
    let first = free_ports(u16::try_from(keys.len()).unwrap());
    let peer = |(key, port): (&&str, u16)| Zenoh {
        key: (*key).to_owned(),
        listen: vec![endpoint(port)],
        connect: (first..port).map(endpoint).collect(),
        ..Zenoh::new(ZenohMode::Peer)
    };
    keys.iter().zip(first..).map(peer).collect()
}

/// A client of the router there.
fn client(port: u16) -> Zenoh {
    Zenoh {
        connect: vec![endpoint(port)],
        ..Zenoh::new(ZenohMode::Client)
    }
}

fn router(port: u16) -> ZenohRouter {
    ZenohRouter::open(&Zenoh {
        listen: vec![endpoint(port)],
        ..Zenoh::new(ZenohMode::Router)
    })
    .unwrap()
}

fn open(parts: &[Zenoh]) -> Vec<Halves> {
    let links = parts.iter().map(|part| Link::Zenoh(part.clone()));
    links.map(|link| link.open().unwrap()).collect()
}

/// The next datagram.
fn hear(halves: &mut Halves, patience: Duration) -> Option<(Source, Vec<u8>)> {
    match halves.receiver.receive(patience).unwrap()? {
        Arrival::Datagram { from, octets, .. } => Some((from, octets)),
        other => panic!("{other:?}"),
    }
}

/// Has `from` send until `to` hears it, and nothing that was under way is left. By which name.
fn meet(halves: &mut [Halves], from: usize, to: usize) -> Source {
    let deadline = Instant::now() + PATIENCE;
    let source = loop {
        assert!(Instant::now() < deadline, "{to} does not hear {from}");
        // While it is connected to nobody yet, it says so.
        let _ = halves[from].sender.send(b"anybody?");
        if let Some((source, _)) = hear(&mut halves[to], Duration::from_millis(50)) {
            break source;
        }
    };
    for halves in halves {
        while hear(halves, Duration::from_millis(100)).is_some() {}
    }
    source
}

#[test]
fn every_peer_hears_every_other_and_none_itself() {
    let mut halves = open(&peers(&["test/v2x"; 3]));
    let sources = [meet(&mut halves, 0, 1), meet(&mut halves, 0, 2)];
    assert_eq!(sources[0], sources[1], "a sender has one name");
    assert!(matches!(sources[0], Source::Zenoh(_)));
    assert_ne!(meet(&mut halves, 1, 0), sources[0]);
    halves[0].sender.send(b"hello").unwrap();
    for to in [1, 2] {
        let heard = hear(&mut halves[to], PATIENCE);
        assert_eq!(heard, Some((sources[0], b"hello".to_vec())));
    }
    for halves in &mut halves {
        assert_eq!(hear(halves, Duration::from_millis(100)), None);
    }
}

#[test]
fn robots_of_another_key_are_not_heard() {
    let mut halves = open(&peers(&["test/one", "test/one", "test/other"]));
    meet(&mut halves, 0, 1);
    halves[0].sender.send(b"hello").unwrap();
    assert!(hear(&mut halves[1], PATIENCE).is_some());
    assert_eq!(hear(&mut halves[2], Duration::from_millis(200)), None);
}

#[test]
fn clients_reach_each_other_only_through_the_router() {
    let port = free_ports(1);
    let routing = router(port);
    let mut halves = open(&[client(port), client(port)]);
    meet(&mut halves, 0, 1);
    meet(&mut halves, 1, 0);
    drop(routing);
    let deadline = Instant::now() + PATIENCE;
    let error = loop {
        assert!(Instant::now() < deadline, "nobody misses the router");
        match halves[0].sender.send(b"hello") {
            Ok(()) => std::thread::sleep(Duration::from_millis(10)),
            Err(error) => break error,
        }
    };
    assert!(error.is_passing(), "{error}");
    assert!(error.to_string().contains("connected to nobody"), "{error}");
    while hear(&mut halves[1], Duration::from_millis(100)).is_some() {}
    let _routing = router(port);
    meet(&mut halves, 0, 1);
}

#[test]
fn faults_and_reopening_lie_over_it_as_over_any_other() {
    let parts = peers(&["test/v2x"; 2]);
    let sender = Reopening(Link::Zenoh(parts[0].clone())).open().unwrap();
    let faults = "loss=1".parse().unwrap();
    let link = Reopening(Link::Zenoh(parts[1].clone()));
    let receiver = WithFaults::new(link, faults, 1).open().unwrap();
    let (mut sender, mut receiver) = (sender.sender, receiver.receiver);
    let deadline = Instant::now() + PATIENCE;
    loop {
        assert!(Instant::now() < deadline);
        sender.send(b"hello").unwrap();
        match receiver.receive(Duration::from_millis(50)).unwrap() {
            None => {}
            Some(Arrival::Lost { octets, .. }) => break assert_eq!(octets, b"hello"),
            Some(other) => panic!("{other:?}"),
        }
    }
}

#[test]
fn what_finds_no_place_is_counted() {
    let mut halves = open(&peers(&["test/v2x"; 2]));
    meet(&mut halves, 0, 1);
    // More than can wait; as often as it takes for a slow machine to have them all wait at once.
    for _ in 0..20 {
        for _ in 0..300 {
            halves[0].sender.send(b"hello").unwrap();
        }
        std::thread::sleep(Duration::from_millis(300));
        let (mut arrived, mut dropped) = (0, 0);
        while let Some(arrival) = halves[1]
            .receiver
            .receive(Duration::from_millis(200))
            .unwrap()
        {
            match arrival {
                Arrival::Overflow(datagrams) => dropped += datagrams,
                _ => arrived += 1,
            }
        }
        assert_eq!(arrived + dropped, 300);
        if dropped > 0 {
            return assert_eq!(arrived, 256);
        }
    }
    panic!("there was room for all of them");
}

#[test]
fn a_peer_by_another_name_is_heard_and_what_is_too_long_is_cut() {
    use zenoh::Wait;

    let part = &peers(&["test/v2x"])[0];
    let mut halves = open(std::slice::from_ref(part));
    let mut config = zenoh::Config::default();
    for (setting, value) in [
        ("connect/endpoints", format!("[\"{}\"]", part.listen[0])),
        ("listen/endpoints", "[]".to_owned()),
        ("scouting/multicast/enabled", "false".to_owned()),
    ] {
        config.insert_json5(setting, &value).unwrap();
    }
    let other = zenoh::open(config).wait().unwrap();
    let deadline = Instant::now() + PATIENCE;
    let (source, octets) = loop {
        assert!(Instant::now() < deadline);
        other.put("test/v2x/rsu-7", vec![7; 5_000]).wait().unwrap();
        if let Some(heard) = hear(&mut halves[0], Duration::from_millis(50)) {
            break heard;
        }
    };
    assert_eq!((source, octets), (Source::Unknown, vec![7; 2_048]));
    other.close().wait().unwrap();
}

#[test]
fn what_cannot_be_opened_says_why() {
    let open = |part: Zenoh| match Link::Zenoh(part).open() {
        Ok(_) => panic!("it is open"),
        Err(LinkError::Zenoh(error)) => error,
        Err(other) => panic!("{other}"),
    };
    let port = free_ports(1);
    let error = open(client(port));
    assert!(matches!(error, ZenohError::Unreachable { .. }), "{error}");
    let error = open(Zenoh::new(ZenohMode::Client));
    assert!(matches!(error, ZenohError::NoRouter), "{error}");
    let _taken = std::net::TcpListener::bind(("127.0.0.1", port)).unwrap();
    let listen = vec![endpoint(port)];
    let error = open(Zenoh {
        listen,
        ..Zenoh::new(ZenohMode::Peer)
    });
    assert!(matches!(error, ZenohError::Unavailable { .. }), "{error}");
    assert!(error.to_string().contains("in use"), "{error}");
    assert!(!error.to_string().contains(".rs:"), "{error}");
    let error = open(Zenoh {
        listen: vec!["tcp/nonsense".to_owned()],
        ..Zenoh::new(ZenohMode::Peer)
    });
    assert!(matches!(error, ZenohError::Unavailable { .. }), "{error}");
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("zenoh.json5");
    let of_file = |text: &str| {
        std::fs::write(&file, text).unwrap();
        Zenoh {
            config: Some(file.clone()),
            ..Zenoh::new(ZenohMode::Client)
        }
    };
    let error = open(of_file("{ mode: 'nobody' }"));
    assert!(matches!(error, ZenohError::Config { .. }), "{error}");
    let error = open(of_file("{}"));
    assert!(matches!(error, ZenohError::NoRouter), "{error}");
    let named = format!("{{ connect: {{ endpoints: ['{}'] }} }}", endpoint(port + 1));
    let error = open(of_file(&named));
    assert!(matches!(error, ZenohError::Unreachable { .. }), "{error}");
}

/// Two robots, each a process, do the crossing with these arguments for their links. Their logs.
fn cross(ari: &[&str], go2: &[&str]) -> [String; 2] {
    let folder = tempfile::tempdir().unwrap();
    // The addresses of these files are not used: the command line's link takes their place.
    let of_ari = robot_file(folder.path(), "ARI", 1, 47_400, 47_401);
    let of_go2 = robot_file(folder.path(), "Go2", 2, 47_401, 47_400);
    let mut dog = start_with(&of_go2, go2);
    std::thread::sleep(Duration::from_millis(200));
    let mut humanoid = start_with(&of_ari, ari);
    let_cross(&mut humanoid, &mut dog);
    let logs = [log_of(&of_ari), log_of(&of_go2)];
    assert!(logs[0].contains("\"taskCompleted\""));
    for log in &logs {
        crossguard_judge::validate::one(log.as_bytes()).unwrap();
    }
    logs
}

/// Has two running robots do the crossing, and end.
fn let_cross(humanoid: &mut Child, dog: &mut Child) {
    type_to(
        humanoid,
        "wait 1\ndetect\nuntil maneuver-executing 20\nuntil idle 20\nquit\n",
    );
    assert_ended_well(humanoid);
    type_to(dog, "quit\n");
    assert_ended_well(dog);
}

fn assert_ended_well(robot: &mut Child) {
    let status = wait_for(robot, PATIENCE);
    let mut said = String::new();
    let _ = std::io::Read::read_to_string(robot.stderr.as_mut().unwrap(), &mut said);
    assert_eq!(status.code(), Some(0), "{said}");
}

#[test]
fn two_processes_that_name_nothing_find_each_other_on_this_machine() {
    // A key of its own, since everybody on this machine might be found.
    let key = format!("test/{}", std::process::id());
    let arguments = ["--zenoh", "peer", "--zenoh-key", &key];
    cross(&arguments, &arguments);
}

#[test]
fn two_processes_cross_as_peers_and_their_packets_are_recorded() {
    let folder = tempfile::tempdir().unwrap();
    let pcap = folder.path().join("ari.pcap");
    let pcap = pcap.to_str().unwrap();
    let there = endpoint(free_ports(1));
    cross(
        &["--zenoh", "peer", "--zenoh-connect", &there, "--pcap", pcap],
        &["--zenoh", "peer", "--zenoh-listen", &there],
    );
    let seen = stdout(&run(&["sniff", pcap]));
    for expected in ["needHelp 1#", "offerHelp 1#", "ack"] {
        assert!(seen.contains(expected), "{expected} is not in:\n{seen}");
    }
}

#[test]
fn a_robot_may_be_the_router_itself() {
    let there = endpoint(free_ports(1));
    cross(
        &["--zenoh", "client", "--zenoh-connect", &there],
        &["--zenoh", "router", "--zenoh-listen", &there],
    );
}

#[test]
fn a_robot_file_names_the_network_as_well() {
    let folder = tempfile::tempdir().unwrap();
    let there = endpoint(free_ports(1));
    let with_link = |name: &str, station, link: &str| {
        let path = robot_file(folder.path(), name, station, 47_400, 47_401);
        let text = std::fs::read_to_string(&path).unwrap();
        let (text, _) = text.split_once("[link]").unwrap();
        std::fs::write(&path, format!("{text}[link.zenoh]\n{link}\n")).unwrap();
        path
    };
    let listen = format!("mode = \"peer\"\nlisten = [\"{there}\"]");
    let mut dog = start(&with_link("Go2", 2, &listen));
    std::thread::sleep(Duration::from_millis(200));
    let connect = format!("mode = \"peer\"\nconnect = [\"{there}\"]");
    let mut humanoid = start(&with_link("ARI", 1, &connect));
    let_cross(&mut humanoid, &mut dog);
    let both = with_link("Both", 3, "mode = \"peer\"\n[link]\nethernet = \"lo\"");
    assert_refused(&run(&["run", "--config", &both]), "[link] wants either");
}

#[test]
fn the_demo_meets_over_zenoh_with_loss_and_signatures_while_somebody_listens() {
    for (how, more) in [
        ("peer", ["--loss", "0.2"]),
        ("router", ["--security", "enforce"]),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let log = folder.path().join("demo.jsonl");
        let port = free_ports(4).to_string();
        let there = format!("tcp/127.0.0.1:{port}");
        let mut demo = crossguard(&["demo", "--json", "--speed", "10", "--scenario", "trio"]);
        demo.args(["--zenoh", how, "--port", &port, "--log"])
            .arg(&log)
            .args(more);
        let demo = demo.stdout(Stdio::piped()).spawn().unwrap();
        std::thread::sleep(Duration::from_millis(500));
        let mode = if how == "peer" { "peer" } else { "client" };
        let sniff = ["sniff", "--json", "--count", "5", "--seconds", "20"];
        let sniffed = crossguard(&sniff)
            .args(["--zenoh", mode, "--zenoh-connect", &there])
            .output()
            .unwrap();
        let demo = demo.wait_with_output().unwrap();
        assert_eq!(demo.status.code(), Some(0), "{}", stdout(&demo));
        assert_eq!(json(&demo)["crossings"], 1);
        assert_eq!(stdout(&sniffed).lines().count(), 5, "{}", stderr(&sniffed));
        assert!(stdout(&sniffed).contains("\"kind\":\"RAM\""));
        let verdict = run(&["validate", log.to_str().unwrap()]);
        assert_eq!(verdict.status.code(), Some(0), "{}", stdout(&verdict));
    }
}
