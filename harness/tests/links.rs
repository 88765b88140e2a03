//! `[link]` in a robot file: addresses off loopback, multicast, and packets behind an Ethernet header.

use std::net::UdpSocket;
use std::process::Stdio;
use std::time::Duration;

use crossguard_testkit::command::*;

/// A group that nothing else uses, on the loopback interface.
fn multicast(port: u16) -> String {
    format!("multicast = \"239.118.50.17:{port}\"\ninterface = \"lo\"\n")
}

/// The configuration of a robot with this link instead of its own.
fn with_link(config: String, link: &str) -> String {
    let text = std::fs::read_to_string(&config).unwrap();
    let (robot, _) = text.split_once("[link]").unwrap();
    std::fs::write(&config, format!("{robot}[link]\n{link}")).unwrap();
    config
}

/// What a robot says that runs for a while, on standard output and standard error.
fn said(config: &str, arguments: &[&str], typed: &[u8]) -> (String, String) {
    let arguments = [&["run", "--config", config], arguments].concat();
    let output = run_with(&arguments, typed);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    (stdout(&output), stderr(&output))
}

#[test]
fn two_robots_cross_by_multicast_with_and_without_an_ethernet_header() {
    for framing in ["geonetworking", "ethernet"] {
        let folder = tempfile::tempdir().unwrap();
        let port = two_free_ports();
        let link = multicast(port) + &format!("framing = \"{framing}\"\n");
        let [ari, go2] = [("ARI", 1), ("Go2", 2)].map(|(name, station)| {
            with_link(robot_file(folder.path(), name, station, port, port), &link)
        });
        let mut follower = start(&go2);
        let typed = "wait 0.5\ndetect\nuntil maneuver-executing 20\nuntil idle 20\nquit\n";
        let (lines, _) = said(&ari, &[], typed.as_bytes());
        assert!(lines.contains("corridor opened"), "{lines}");
        // It hears itself, which is counted, and told once in the end.
        let own: Vec<_> = lines
            .lines()
            .filter(|it| it.contains("own packet"))
            .collect();
        assert!(
            matches!(own[..], [once] if once.ends_with(" of packet: own packet")),
            "{lines}"
        );
        type_to(&mut follower, "quit\n");
        assert!(wait_for(&mut follower, Duration::from_secs(20)).success());
        assert!(log_of(&go2).contains("\"taskCompleted\""), "{framing}");
    }
}

#[test]
fn datagrams_without_the_ethernet_header_that_the_link_has_are_counted_by_cause() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let link = format!("address = \"127.0.0.1:{port}\"\npeers = []\nframing = \"ethernet\"\n");
    let config = with_link(robot_file(folder.path(), "ARI", 1, port, port), &link);
    let mut robot = start(&config);
    let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
    std::thread::sleep(Duration::from_millis(500));
    for datagram in [&[0x11; 60][..], &[0x11; 60], &[0x11; 5]] {
        socket.send_to(datagram, ("127.0.0.1", port)).unwrap();
    }
    std::thread::sleep(Duration::from_millis(300));
    type_to(&mut robot, "quit\n");
    assert!(wait_for(&mut robot, Duration::from_secs(20)).success());
    let log = log_of(&config);
    let last = records(&log).pop().unwrap();
    let link = &last["counters"]["link"];
    assert_eq!(link["another ethertype"], 2, "{last}");
    assert_eq!(link["no Ethernet header"], 1, "{last}");
}

#[test]
fn a_robot_that_others_can_reach_says_so_unless_it_verifies() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let on_loopback = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let (_, warned) = said(&on_loopback, &[], b"quit\n");
    assert_eq!(warned, "");
    let config = with_link(
        on_loopback,
        &format!("address = \"0.0.0.0:{port}\"\npeers = [\"192.0.2.1:47411\"]\n"),
    );
    let (_, warned) = said(&config, &[], b"quit\n");
    let expected = format!("warning: packets on 0.0.0.0:{port} are neither signed nor verified");
    assert!(warned.contains(&expected), "{warned}");
    let pki = folder.path().join("pki").display().to_string();
    assert!(run(&["pki", "init", &pki]).status.success());
    let own = format!("{pki}/robots/ARI");
    let (_, warned) = said(
        &config,
        &["--security", "enforce", "--pki", &own],
        b"quit\n",
    );
    assert!(!warned.contains("warning"), "{warned}");
}

#[test]
fn own_packets_are_known_although_they_are_signed() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let config = with_link(
        robot_file(folder.path(), "ARI", 1, port, port),
        &multicast(port),
    );
    let pki = folder.path().join("pki").display().to_string();
    assert!(run(&["pki", "init", &pki]).status.success());
    let own = format!("{pki}/robots/ARI");
    let mut robot = crossguard(&["run", "--config", &config, "--security", "enforce", "--pki"])
        .arg(own)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_secs(3));
    type_to(&mut robot, "quit\n");
    let lines = stdout(&robot.wait_with_output().unwrap());
    assert!(lines.contains(" of packet: own packet"), "{lines}");
    assert!(!lines.contains("security:"), "{lines}");
}
