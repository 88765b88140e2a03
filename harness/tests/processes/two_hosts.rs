//! Two robots on two hosts send each other UDP unicast, signed: each in a network namespace of its own, with an address
//! of its own, that of the other one in its configuration. Where the kernel does not permit namespaces, the test is
//! skipped, and says so by name.

use std::io::Write;
use std::process::{Command, Output, Stdio};

use crossguard_testkit::command::*;

/// Two namespaces, the link between them, and a crossing.
const STREET: &str = r#"
set -e
unshare --net sleep 120 &
other=$!
trap 'kill $other' EXIT
until [ "$(readlink /proc/$other/ns/net)" != "$(readlink /proc/$$/ns/net)" ]; do sleep 0.01; done
inside="nsenter --target $other --net"
ip link add here type veth peer name there
ip link set there netns $other
ip addr add 10.9.0.1/24 dev here
ip link set here up
$inside ip addr add 10.9.0.2/24 dev there
$inside ip link set there up
[ "$1" = try ] && exit 0
cd "$2"
mkfifo typed
$inside "$1" run --config Go2.toml --security enforce --pki pki/robots/Go2 --json < typed > Go2.log 2> Go2.err &
follower=$!
exec 3> typed
printf 'wait 1.5\ndetect\nuntil maneuver-executing 30\nuntil idle 60\nwait 1.5\nquit\n' |
    "$1" run --config ARI.toml --security enforce --pki pki/robots/ARI --json > ARI.log 2> ARI.err
echo quit >&3
exec 3>&-
wait $follower
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

#[test]
fn two_robots_cross_by_unicast_from_host_to_host() {
    let tried = street(&["try"]);
    if !tried.status.success() {
        let test = "two_robots_cross_by_unicast_from_host_to_host";
        let why = stderr(&tried);
        // Not by eprintln!, which the test runner would capture.
        let _ = writeln!(std::io::stderr(), "SKIPPED {test}: {}", why.trim());
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    for (name, station, own, peer) in [("ARI", 1, 1, 2), ("Go2", 2, 2, 1)] {
        let config = robot_file(folder.path(), name, station, 4_711, 4_711);
        let of = |of: &str, host: u8| format!("{of}10.9.0.{host}");
        let changes = [
            ("peers = [\"127.0.0.1", &*of("peers = [\"", peer)),
            ("address = \"127.0.0.1", &*of("address = \"", own)),
        ];
        edit(&config, &changes);
    }
    let pki = path("pki");
    let made = run(&["pki", "init", &pki, "--robot", "ARI=1", "--robot", "Go2=2"]);
    assert!(made.status.success(), "{}", stderr(&made));
    let output = street(&[env!("CARGO_BIN_EXE_crossguard"), &path("")]);
    let read = |name: &str| std::fs::read_to_string(path(name)).unwrap_or_default();
    let said = (stderr(&output), read("ARI.err"), read("Go2.err"));
    assert_eq!(output.status.code(), Some(0), "{said:?}");
    for log in ["ARI.log", "Go2.log"] {
        assert!(read(log).contains("\"taskCompleted\""), "{log}: {said:?}");
    }
    for said in [said.1, said.2] {
        assert!(!said.contains("warning"), "{said}");
    }
    let verdict = run(&["validate", &path("ARI.log"), &path("Go2.log")]);
    assert_eq!(verdict.status.code(), Some(0), "{}", stdout(&verdict));
}
