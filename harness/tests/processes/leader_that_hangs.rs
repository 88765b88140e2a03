//! A leader whose process stops for 8 s renews nothing: what it showed ends by itself within `t_lease`,
//! before its follower falls back.

use std::time::{Duration, SystemTime, UNIX_EPOCH};

use crossguard_testkit::command::*;

const PATIENCE: Duration = Duration::from_mins(1);
const T_LEASE_MS: f64 = 1_900.0;

#[test]
fn the_sign_of_a_leader_that_hangs_ends_before_its_follower_falls_back() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let ari = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let go2 = robot_file(folder.path(), "Go2", 2, port + 1, port);
    for robot in [&ari, &go2] {
        edit(robot, &[("autopilot = true", "")]);
    }
    let (mut leader, mut follower) = (start(&ari), start(&go2));
    type_to(
        &mut leader,
        "wait 0.3\ndetect 1 block\nuntil role-established\nwait 0.5\norder 2 block\nwait 0.5\nopen\n",
    );
    std::thread::sleep(Duration::from_millis(2_500));
    let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap();
    let hangs_ms = now.as_secs_f64() * 1e3;
    signal(&leader, "-STOP");
    std::thread::sleep(Duration::from_secs(8));
    signal(&leader, "-CONT");
    type_to(
        &mut leader,
        "wait 1\nclear\nwait 0.5\nleave\nuntil idle 30\nquit\n",
    );
    assert_eq!(wait_for(&mut leader, PATIENCE).code(), Some(0));
    type_to(&mut follower, "until idle 30\nquit\n");
    assert_eq!(wait_for(&mut follower, PATIENCE).code(), Some(0));

    let leader = happenings(&log_of(&ari));
    // What people see ends when the last act before the hang says.
    let mut shows = leader.iter().filter_map(|(at_ms, it)| {
        let time = it.get("corridorOpened").or(it.get("corridorExtended"))?;
        Some((*at_ms, at_ms + time.as_f64()?))
    });
    let (_, ends_ms) = shows
        .rfind(|(at_ms, _)| *at_ms < hangs_ms + 100.0)
        .expect("the corridor was open");
    assert!(ends_ms > hangs_ms, "it was open when the leader hung");
    assert!(
        ends_ms <= hangs_ms + T_LEASE_MS + 50.0,
        "go for {} ms",
        ends_ms - hangs_ms
    );
    let go2_does = happenings(&log_of(&go2));
    let fell_back_ms = first(&go2_does, |it| it.get("fallBack").is_some());
    let fell_back_ms = fell_back_ms.expect("the follower falls back");
    assert!(
        ends_ms < fell_back_ms,
        "{} ms after",
        ends_ms - fell_back_ms
    );
    // When it goes on, the corridor is closed with nothing shown in between.
    let closed_ms = first(&leader, |it| it.get("corridorClosed").is_some()).unwrap();
    let late = leader.iter().find(|(at_ms, it)| {
        (hangs_ms + 100.0..closed_ms).contains(at_ms) && it.get("corridorExtended").is_some()
    });
    assert_eq!(late, None);
    // The report tells the end as people saw it.
    let (chart, log) = (
        folder.path().join("page.html").display().to_string(),
        std::path::Path::new(&ari)
            .with_extension("log")
            .display()
            .to_string(),
    );
    let output = run(&["report", &log, "--output", &chart]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let page = std::fs::read_to_string(&chart).unwrap();
    assert!(page.contains("the sign went to stop by itself"));
    assert!(page.contains("the sign ended by itself, since nothing renewed it"));
}
