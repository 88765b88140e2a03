//! Robots on two hosts: each in a network namespace of its own, with a link between them that may go and come back.
//!
//! Nothing of it touches the machine's own network. Where the kernel does not permit namespaces, the tests are skipped,
//! and say so by name.

use std::fs;

use crossguard_testkit::command::*;

use crate::street::{ARI, GO2, Street, assert_valid};

/// Two namespaces and the link between them. Go2 is told what is typed into a pipe, ARI what the last argument prints.
const HOSTS: &str = r#"
set -e
unshare --net sleep 600 &
other=$!
trap 'kill $other' EXIT
until [ "$(readlink /proc/$other/ns/net)" != "$(readlink /proc/$$/ns/net)" ]; do sleep 0.01; done
inside="nsenter --target $other --net"
connect() {
    ip link add ari type veth peer name go2
    ip link set go2 netns $other
    ip addr add 10.9.0.1/24 dev ari
    ip link set ari up
    $inside ip addr add 10.9.0.2/24 dev go2
    $inside ip link set go2 up
}
connect
[ "$1" = try ] && exit 0
program=$1
cd "$2"
mkfifo typed
$inside $program run --config Go2.toml $3 --json --log Go2.jsonl < typed > /dev/null &
follower=$!
exec 3> typed
eval "$5" | $program run --config ARI.toml $4 --json --log ARI.jsonl --pcap ari.pcap > /dev/null
echo quit >&3
exec 3>&-
wait $follower
"#;

const ONCE: &str = "printf 'wait 1\ndetect\nuntil maneuver-executing 20\nuntil idle 30\nquit\n'";

/// The interface is gone in the middle of a crossing, and comes back. Both had to leave a road on which somebody may have
/// been.
const TWICE: &str = r"
await() {
    turn=0
    until grep -qs $1 $2; do
        [ $((turn += 1)) -le 1200 ] || { echo quit; exit; }
        sleep 0.05
    done
}
printf 'wait 0.7\ndetect\nuntil maneuver-executing 20\n'
await corridorOpened ARI.jsonl
sleep 0.3
ip link del ari
await contactLost Go2.jsonl
await noFollowers ARI.jsonl
connect
printf 'until idle 20\nclear\n' | tee /dev/fd/3
sleep 3
printf 'detect\nuntil maneuver-executing 20\nuntil idle 30\nquit\n'
";

/// The logs of ARI and Go2 after a crossing with these options of ARI, and the same of Go2 by its interface; what is typed
/// to ARI; and lines of robot files instead of their links.
fn cross(options: &str, typed: &str, links: Option<[&str; 2]>) -> Option<[String; 2]> {
    let street = Street::new(&[("speed = 40.0", "speed = 4.0")]);
    for (robot, link) in links.into_iter().flatten().enumerate() {
        street.link(robot, link);
    }
    let pki = street.path("pki");
    let made = run(&["pki", "init", &pki, "--robot", "ARI=1", "--robot", "Go2=2"]);
    assert_code(&made, 0);
    let of = |name: &str, robot: &str| options.replace("NAME", name).replace("ROBOT", robot);
    let folder = street.path("");
    let program = env!("CARGO_BIN_EXE_crossguard");
    let (go2, ari) = (of("go2", "Go2"), of("ari", "ARI"));
    let kinds = ["--net", "--pid", "--fork", "--kill-child", "--mount-proc"];
    let arguments = [program, &folder, &go2, &ari, typed];
    let output = unshared(&kinds, HOSTS, &["try"], &arguments)?;
    assert_code(&output, 0);
    let said = stderr(&output);
    assert!(links.is_none() || !said.contains("warning"), "{said}");
    let logs = ["ARI.jsonl", "Go2.jsonl"].map(|log| street.path(log));
    assert_valid(logs.iter().map(Into::into));
    let seen = stdout(&run(&["sniff", &street.path("ari.pcap")]));
    seen.must_have(&["needHelp, 1#", "offerHelp, 1#"]);
    let logs = logs.map(|log| fs::read_to_string(log).unwrap());
    assert!(logs[ARI].contains("\"taskCompleted\"") && logs[GO2].contains("\"taskCompleted\""));
    Some(logs)
}

#[test]
fn robots_of_a_multicast_group_cross_again_when_their_interface_is_back() {
    let options = "--multicast 239.118.50.1:47400 --interface NAME";
    let Some([of_ari, of_go2]) = cross(options, TWICE, None) else {
        return;
    };
    // Without the link each comes to rest by its own timers, and counts what does not go out.
    of_ari.must_have(&["\"not sent\"", "leaseExpired", "\"noFollowers\""]);
    of_go2.must_have(&["fallBack", "\"contactLost\""]);
}

#[test]
fn robots_on_ethernet_cross() {
    cross("--ethernet NAME", ONCE, None);
}

#[test]
fn robots_cross_by_signed_unicast_from_host_to_host() {
    let links = [(1, 2), (2, 1)].map(|(own, peer)| {
        format!("address = \"10.9.0.{own}:4711\"\npeers = [\"10.9.0.{peer}:4711\"]")
    });
    let options = "--security enforce --pki pki/robots/ROBOT";
    cross(options, ONCE, Some(links.each_ref().map(|it| &**it)));
}
