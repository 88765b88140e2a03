//! An interface that disappears in the middle of a crossing, and comes back: robots come to rest without
//! it, and cross over the new one without being started again. All in network namespaces of the test's
//! own; where the kernel does not permit them, the test is skipped, and says so by name.

use std::fs;
use std::io::Write;
use std::process::{Command, Output, Stdio};

use crossguard_testkit::command::*;

/// Two namespaces and the link between them, on which two robots cross, lose it, and get another.
const STREET: &str = r#"
set -e
unshare --net sleep 120 &
other=$!
trap 'kill $other' EXIT
until [ "$(readlink /proc/$other/ns/net)" != "$(readlink /proc/$$/ns/net)" ]; do sleep 0.01; done
inside="nsenter --target $other --net"
connect() {
    ip link add ari type veth peer name go2
    ip link set go2 netns $other
    ip addr add 10.0.0.1/24 dev ari
    ip link set ari up
    $inside ip addr add 10.0.0.2/24 dev go2
    $inside ip link set go2 up
}
connect
[ "$1" = try ] && exit 0
link=$4
{
    sleep 12
    printf 'clear\n'
    sleep 48
} | $inside "$1" run --config "$3" $link go2 --json > "$6" &
{
    printf 'wait 0.7\ndetect\nuntil maneuver-executing 20\n'
    sleep 2.5
    ip link del ari
    printf 'until idle 20\n'
    sleep 9
    connect
    # Both had to leave a road on which somebody may have been.
    printf 'clear\n'
    sleep 3
    printf 'detect\nuntil maneuver-executing 20\nuntil idle 30\nquit\n'
} | "$1" run --config "$2" $link ari --json > "$5"
"#;

/// A command that runs the script in namespaces of its own.
fn street(arguments: &[&str]) -> Output {
    Command::new("unshare")
        .args(["--user", "--map-root-user", "--net", "--pid", "--fork"])
        .args(["--kill-child", "--mount-proc", "sh", "-c", STREET, "street"])
        .args(arguments)
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

fn cross_twice_by(link: &str, test: &str) {
    let tried = street(&["try"]);
    if !tried.status.success() {
        // Not by eprintln!, which the test runner would capture.
        let _ = writeln!(
            std::io::stderr(),
            "SKIPPED {test}: this machine permits no network namespaces: {}",
            stderr(&tried).trim()
        );
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    // The addresses of these files are not used: the command line's link takes their place.
    let configs = [("ARI", 1, 47_400, 47_401), ("Go2", 2, 47_401, 47_400)];
    let [ari, go2] = configs.map(|(name, station, port, peer)| {
        let path = robot_file(folder.path(), name, station, port, peer);
        let config = fs::read_to_string(&path).unwrap();
        fs::write(&path, config.replace("speed = 40.0", "speed = 4.0")).unwrap();
        path
    });
    let logs = ["ari.jsonl", "go2.jsonl"].map(|log| folder.path().join(log).display().to_string());
    let program = env!("CARGO_BIN_EXE_crossguard");
    let output = street(&[program, &ari, &go2, link, &logs[0], &logs[1]]);
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(0), "{said}");
    let [of_ari, of_go2] = logs.each_ref().map(|log| fs::read_to_string(log).unwrap());
    // Without the link each comes to rest by its own timers, and counts what does not go out.
    for expected in ["\"not sent\"", "leaseExpired", "\"noFollowers\""] {
        assert!(of_ari.contains(expected), "{expected}");
    }
    for expected in ["fallBack", "\"contactLost\""] {
        assert!(of_go2.contains(expected), "{expected}");
    }
    // Over the new one they cross.
    assert!(of_ari.contains("\"taskCompleted\""));
    assert!(of_go2.contains("\"taskCompleted\""));
    let verdict = run(&["validate", &logs[0], &logs[1]]);
    assert_eq!(verdict.status.code(), Some(0), "{}", stdout(&verdict));
}

#[test]
fn robots_of_a_multicast_group_cross_again_when_their_interface_is_back() {
    cross_twice_by(
        "--multicast 239.118.50.1:47400 --interface",
        "robots_of_a_multicast_group_cross_again_when_their_interface_is_back",
    );
}

#[test]
fn robots_on_ethernet_cross_again_when_their_interface_is_back() {
    cross_twice_by(
        "--ethernet",
        "robots_on_ethernet_cross_again_when_their_interface_is_back",
    );
}

#[cfg(feature = "zenoh")]
#[test]
fn peers_that_scout_on_an_interface_cross_again_when_it_is_back() {
    cross_twice_by(
        "--zenoh peer --zenoh-scout",
        "peers_that_scout_on_an_interface_cross_again_when_it_is_back",
    );
}

#[cfg(feature = "zenoh")]
#[test]
fn peers_that_are_told_of_each_other_cross_again_when_their_interface_is_back() {
    cross_twice_by(
        "--zenoh peer --zenoh-listen tcp/0.0.0.0:7447 --zenoh-connect tcp/10.0.0.1:7447 \
         --zenoh-connect tcp/10.0.0.2:7447 --zenoh-scout",
        "peers_that_are_told_of_each_other_cross_again_when_their_interface_is_back",
    );
}
