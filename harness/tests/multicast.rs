//! `crossguard run --multicast` and `--ethernet`: two robots, each in a network namespace of its own, on
//! one link.
//!
//! Nothing of it touches the machine's own network. Where the kernel does not permit it, the test is
//! skipped, and says so by name.

use std::io::Write;
use std::process::{Command, Stdio};

use crossguard_testkit::command::*;

/// Makes the second namespace and the link between the two, runs both robots, and ends with the
/// status of the first. It runs as the first process of a user and network namespace.
const STREET: &str = r#"
set -e
ip link add ari type veth peer name go2
unshare --net sleep 120 &
other=$!
trap 'kill $other' EXIT
until [ "$(readlink /proc/$other/ns/net)" != "$(readlink /proc/$$/ns/net)" ]; do sleep 0.01; done
ip link set go2 netns $other
inside="nsenter --target $other --net"
ip addr add 10.0.0.1/24 dev ari
ip link set ari up
$inside ip addr add 10.0.0.2/24 dev go2
$inside ip link set go2 up
[ "$1" = try ] && exit 0
link=$5
sleep 60 | $inside "$1" run --config "$3" $link go2 --json > "$4" &
printf 'wait 0.5\ndetect\nuntil maneuver-executing 20\nuntil idle 20\nquit\n' |
    "$1" run --config "$2" $link ari --json --pcap "$6"
"#;

/// A command that runs the script in namespaces of its own.
fn street(arguments: &[&str]) -> Command {
    let mut command = Command::new("unshare");
    command
        .args(["--user", "--map-root-user", "--net", "--pid", "--fork"])
        .args(["--kill-child", "--mount-proc", "sh", "-c", STREET, "street"])
        .args(arguments)
        .stdin(Stdio::null());
    command
}

/// Two robots on a link of two namespaces do the crossing over a link with these options; the packets
/// of one of them go to a file, which `sniff` reads.
fn the_crossing_by(link: &str, test: &str) {
    match street(&["try"]).output() {
        Ok(output) if output.status.success() => {}
        other => {
            let cause = match other {
                Ok(output) => stderr(&output),
                Err(error) => error.to_string(),
            };
            // Not by eprintln!, which the test runner would capture.
            let _ = writeln!(
                std::io::stderr(),
                "SKIPPED {test}: this machine permits no network namespaces: {}",
                cause.trim()
            );
            return;
        }
    }
    let folder = tempfile::tempdir().unwrap();
    // The addresses of these files are not used: the command line's link takes their place.
    let ari = robot_file(folder.path(), "ARI", 1, 47_400, 47_401);
    let go2 = robot_file(folder.path(), "Go2", 2, 47_401, 47_400);
    let go2_log = folder.path().join("go2.log");
    let pcap = folder.path().join("ari.pcap");
    let program = env!("CARGO_BIN_EXE_crossguard");
    let (go2_log_name, pcap) = (go2_log.to_str().unwrap(), pcap.to_str().unwrap());
    let output = street(&[program, &ari, &go2, go2_log_name, link, pcap])
        .output()
        .unwrap();
    let log = stdout(&output);
    assert_eq!(output.status.code(), Some(0), "{log}{}", stderr(&output));
    crossguard_judge::validate::one(log.as_bytes()).unwrap();
    for expected in ["\"taskCompleted\"", "\"station\":2"] {
        assert!(log.contains(expected), "{expected} is not in:\n{log}");
    }
    assert!(
        std::fs::read_to_string(go2_log)
            .unwrap()
            .contains("\"startManeuver\""),
        "the other robot was never commanded"
    );
    let seen = stdout(&run(&["sniff", pcap]));
    for expected in ["needHelp 1#", "offerHelp 1#", "ack"] {
        assert!(seen.contains(expected), "{expected} is not in:\n{seen}");
    }
}

#[test]
fn two_robots_in_two_network_namespaces_do_the_crossing_by_multicast() {
    the_crossing_by(
        "--multicast 239.118.50.1:47400 --interface",
        "two_robots_in_two_network_namespaces_do_the_crossing_by_multicast",
    );
}

#[test]
fn two_robots_in_two_network_namespaces_do_the_crossing_in_ethernet_frames() {
    the_crossing_by(
        "--ethernet",
        "two_robots_in_two_network_namespaces_do_the_crossing_in_ethernet_frames",
    );
}

#[cfg(feature = "zenoh")]
#[test]
fn two_robots_in_two_network_namespaces_find_each_other_by_the_scouting_of_zenoh() {
    the_crossing_by(
        "--zenoh peer --zenoh-scout",
        "two_robots_in_two_network_namespaces_find_each_other_by_the_scouting_of_zenoh",
    );
}
