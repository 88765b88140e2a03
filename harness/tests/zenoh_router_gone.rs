//! A zenoh router that dies in the middle of a crossing, and comes back: robots come to rest without it, and
//! cross through the new one without being started again.

use std::fs;
use std::io::{BufRead, BufReader};
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

use crossguard_testkit::command::*;

const PATIENCE: Duration = Duration::from_mins(1);

/// A router, as soon as it routes.
fn router(endpoint: &str) -> Child {
    let mut router = crossguard(&["router", "--listen", endpoint])
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut said = String::new();
    let mut lines = BufReader::new(router.stdout.as_mut().unwrap());
    lines.read_line(&mut said).unwrap();
    assert!(said.contains(endpoint), "{said}");
    router
}

/// Waits until a robot's log has this, behind what it had before, and gives how long it is then.
fn until(config: &str, expected: &str, from: usize) -> usize {
    let deadline = Instant::now() + PATIENCE;
    loop {
        let log = log_of(config);
        if log[from..].contains(expected) {
            return log.len();
        }
        assert!(Instant::now() < deadline, "no {expected} in:\n{log}");
        std::thread::sleep(Duration::from_millis(20));
    }
}

#[test]
fn robots_cross_again_when_the_router_is_back() {
    let folder = tempfile::tempdir().unwrap();
    let endpoint = format!("tcp/127.0.0.1:{}", free_ports(1));
    // The addresses of these files are not used: the command line's link takes their place.
    let robots = [("ARI", 1, 47_400, 47_401), ("Go2", 2, 47_401, 47_400)];
    let [ari, go2] = robots.map(|(name, station, port, peer)| {
        let path = robot_file(folder.path(), name, station, port, peer);
        let config = fs::read_to_string(&path).unwrap();
        fs::write(&path, config.replace("speed = 40.0", "speed = 4.0")).unwrap();
        path
    });
    let mut routing = router(&endpoint);
    let link = ["--zenoh", "client", "--zenoh-connect", &endpoint];
    let mut dog = start_with(&go2, &link);
    let mut humanoid = start_with(&ari, &link);
    type_to(&mut humanoid, "wait 1\ndetect\n");
    until(&go2, "\"startManeuver\"", 0);
    until(&ari, "\"corridorOpened\"", 0);

    // It dies without a word, while the dog is on the road.
    routing.kill().unwrap();
    routing.wait().unwrap();
    let of_ari = until(&ari, "\"noFollowers\"", 0);
    let of_go2 = until(&go2, "\"contactLost\"", 0);
    for (log, expected) in [
        (
            log_of(&ari),
            ["\"not sent\"", "connected to nobody", "leaseExpired"],
        ),
        (
            log_of(&go2),
            ["\"not sent\"", "connected to nobody", "fallBack"],
        ),
    ] {
        for expected in expected {
            assert!(log.contains(expected), "{expected}");
        }
    }

    let mut routing = router(&endpoint);
    // The dog helps again once its road is clear.
    type_to(&mut dog, "until idle 30\nclear\n");
    until(&go2, "\"roadClear\"", of_go2);
    type_to(
        &mut humanoid,
        "wait 3\ndetect\nuntil maneuver-executing 20\nuntil idle 30\nquit\n",
    );
    assert_eq!(wait_for(&mut humanoid, PATIENCE).code(), Some(0));
    type_to(&mut dog, "quit\n");
    assert_eq!(wait_for(&mut dog, PATIENCE).code(), Some(0));
    assert!(log_of(&ari)[of_ari..].contains("\"taskCompleted\""));
    assert!(log_of(&go2)[of_go2..].contains("\"taskCompleted\""));
    let logs = [&ari, &go2].map(|config| config.replace(".toml", ".log"));
    let verdict = run(&["validate", &logs[0], &logs[1]]);
    assert_eq!(verdict.status.code(), Some(0), "{}", stdout(&verdict));
    signal(&routing, "-TERM");
    assert_eq!(wait_for(&mut routing, PATIENCE).code(), Some(0));
}
