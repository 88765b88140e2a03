//! A blocker that has lost its leader holds the road until somebody says that it is clear. Until then it
//! helps nobody else, however long its session has been over.

use std::time::Duration;

use crossguard_testkit::command::*;

const PATIENCE: Duration = Duration::from_mins(1);

#[test]
fn a_blocker_that_holds_helps_nobody_before_the_road_is_clear() {
    let folder = tempfile::tempdir().unwrap();
    let port = free_ports(3);
    let names = [("ARI", 1), ("Go2", 2), ("ARI-2", 3)];
    let files = names.map(|(name, station)| {
        let peer = |nth: u16| format!("\"127.0.0.1:{}\"", port + nth);
        let own = u16::try_from(station).unwrap() - 1;
        let file = robot_file(folder.path(), name, station, port + own, 9);
        let others: Vec<_> = (0..3).filter(|nth| *nth != own).map(peer).collect();
        edit(
            &file,
            &[
                ("autopilot = true", ""),
                ("\"127.0.0.1:9\"", &others.join(", ")),
            ],
        );
        file
    });
    let [mut first_leader, mut blocker, mut second] = files.each_ref().map(|file| start(file));
    // The second leader takes no part before it is told to.
    type_to(&mut second, "unavailable teleoperated\n");
    type_to(
        &mut first_leader,
        "wait 0.4\ndetect 1 block\nuntil role-established\nwait 0.5\norder 2 block\nwait 0.5\nopen\n",
    );
    std::thread::sleep(Duration::from_millis(2_500));
    signal(&first_leader, "-KILL");
    wait_for(&mut first_leader, PATIENCE);
    // It falls back after `t_safety` and leaves after `t_leave`: 5 s later its session has long been over.
    std::thread::sleep(Duration::from_secs(12));
    type_to(
        &mut second,
        "available\ndetect 1 block\nwait 3\nleave\nuntil idle\n",
    );
    std::thread::sleep(Duration::from_secs(5));
    type_to(&mut blocker, "clear\n");
    type_to(
        &mut second,
        "detect 1 block\nuntil role-established\nwait 0.5\norder 2 block\nuntil maneuver-executing\n\
         task-completed\nuntil idle\nquit\n",
    );
    assert_eq!(wait_for(&mut second, PATIENCE).code(), Some(0));
    type_to(&mut blocker, "until idle\nquit\n");
    assert_eq!(wait_for(&mut blocker, PATIENCE).code(), Some(0));

    let does = happenings(&log_of(&files[1]));
    let left_ms = first(&does, |it| {
        it["notify"]["released"][1] == serde_json::json!("contactLost")
    });
    let clear_ms = first(&does, |it| {
        it["input"]["local"] == serde_json::json!("roadClear")
    });
    let (left_ms, clear_ms) = (left_ms.expect("it leaves"), clear_ms.expect("it is told"));
    assert!(clear_ms - left_ms > 5_000.0, "{} ms", clear_ms - left_ms);
    let refused_ms = first(&does, |it| *it == serde_json::json!({"ignored": "onDuty"}));
    let refused_ms = refused_ms.expect("the second leader asks it");
    assert!((left_ms..clear_ms).contains(&refused_ms));
    let offers: Vec<_> = does
        .iter()
        .filter(|(_, it)| it["notify"].get("offering").is_some())
        .map(|(at_ms, _)| *at_ms)
        .collect();
    assert_eq!(offers.len(), 2, "one before the duty, one after it");
    assert!(offers[1] > clear_ms);
}
