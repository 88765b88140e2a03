//! `[link]` in a robot file: multicast, packets behind an Ethernet header, signed, and addresses that others reach.

use crossguard_testkit::command::*;

use crate::street::{ARI, CROSS, GO2, Street, counted};

#[test]
fn two_robots_cross_by_multicast_behind_an_ethernet_header_and_signed() {
    let mut street = Street::new(&[]);
    let port = free_ports(1);
    // A group that nothing else uses, on the loopback interface.
    let group = format!(
        "multicast = \"239.118.50.17:{port}\"\ninterface = \"lo\"\nframing = \"ethernet\"\n"
    );
    for robot in [ARI, GO2] {
        street.link(robot, &group);
    }
    let pki = street.path("pki");
    assert!(run(&["pki", "init", &pki]).status.success());
    street.start(&["--security", "enforce", "--pki", &pki]);
    street.say(ARI, CROSS);
    street.until(GO2, "\"taskCompleted\"");
    for log in street.end() {
        // It hears itself, which it knows although it is signed.
        assert_ne!(counted(&log, "packet", "own packet"), 0);
    }
}

#[test]
fn a_robot_that_others_can_reach_says_so_unless_it_verifies() {
    let street = Street::new(&[]);
    let pki = street.path("pki");
    assert!(run(&["pki", "init", &pki]).status.success());
    let warned = |more: &[&str]| {
        let run = ["run", "--config", &street.configs[ARI]];
        let output = run_with(&[&run[..], more].concat(), b"quit\n");
        assert_code(&output, 0);
        stderr(&output)
    };
    assert_eq!(warned(&[]), "");
    let port = free_ports(1);
    let link = format!("address = \"0.0.0.0:{port}\"\npeers = [\"192.0.2.1:47411\"]\n");
    street.link(ARI, &link);
    let expected = format!("warning: packets on 0.0.0.0:{port} are neither signed nor verified");
    assert!(warned(&[]).contains(&expected));
    let own = format!("{pki}/robots/ARI");
    let enforces = warned(&["--security", "enforce", "--pki", &own]);
    assert!(!enforces.contains("warning"), "{enforces}");
}
