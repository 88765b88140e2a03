//! A blocker that is told to stop the traffic 25 m away has accepted that at once, and is there later. The
//! corridor opens only then, as two processes log it.

use std::time::Duration;

use crossguard_testkit::command::*;

const PATIENCE: Duration = Duration::from_mins(1);

#[test]
fn the_corridor_opens_when_the_blocker_has_arrived_and_not_before() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let ari = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let go2 = robot_file(folder.path(), "Go2", 2, port + 1, port);
    edit(&ari, &[("autopilot = true", "")]);
    edit(
        &go2,
        &[
            ("autopilot = true", "place = [-19.0, 5.0]"),
            ("speed = 40.0", "speed = 10.0"),
        ],
    );
    let (mut leader, mut blocker) = (start(&ari), start(&go2));
    let open = "open\nwait 0.2\n".repeat(25);
    let script = format!(
        "wait 0.3\ndetect 1 block\nuntil role-established\nwait 0.5\norder 2 block 6 5 1.4\nwait 0.2\n\
         {open}close\nclear\ntask-completed\nuntil idle\nquit\n"
    );
    type_to(&mut leader, &script);
    assert_eq!(wait_for(&mut leader, PATIENCE).code(), Some(0));
    type_to(&mut blocker, "until idle\nquit\n");
    assert_eq!(wait_for(&mut blocker, PATIENCE).code(), Some(0));

    let (leader, blocker) = (happenings(&log_of(&ari)), happenings(&log_of(&go2)));
    let refused = serde_json::json!({"ignored": {"notEngaged": [2, "notInPosition"]}});
    assert!(
        first(&leader, |it| *it == refused).is_some(),
        "it was asked for too early"
    );
    let started_ms = first(&blocker, |it| it.get("startManeuver").is_some()).unwrap();
    let arrived_ms = first(&blocker, |it| {
        it["input"]["local"].get("inPosition").is_some()
    });
    let arrived_ms = arrived_ms.expect("the blocker arrives");
    // 25 m at 1.4 m/s, ten times as fast as real.
    assert!(
        arrived_ms - started_ms > 1_600.0,
        "{} ms",
        arrived_ms - started_ms
    );
    let opened_ms = first(&leader, |it| it.get("corridorOpened").is_some());
    let opened_ms = opened_ms.expect("the corridor opens");
    assert!(
        opened_ms >= arrived_ms - 5.0,
        "{} ms before",
        arrived_ms - opened_ms
    );
    for robot in [ari, go2] {
        crossguard_judge::validate::one(log_of(&robot).as_bytes()).unwrap();
    }
}
