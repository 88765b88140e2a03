//! `crossguard run`: robots as processes of their own.

use std::time::Duration;

use crossguard_testkit::command::*;

const PATIENCE: Duration = Duration::from_mins(1);

/// The reasons for which sessions ended, from a robot's log.
fn ends(log: &str) -> Vec<String> {
    let mut ends = Vec::new();
    for record in records(log) {
        for output in record["outputs"].as_array().into_iter().flatten() {
            if let Some(end) = output["notify"].get("sessionEnded") {
                ends.push(end[1].to_string());
            }
        }
    }
    ends
}

#[test]
fn two_processes_do_the_crossing() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let ari = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let go2 = robot_file(folder.path(), "Go2", 2, port + 1, port);
    let mut dog = start(&go2);
    let mut humanoid = start(&ari);
    type_to(
        &mut humanoid,
        "wait 0.3\ndetect\nuntil maneuver-executing\nuntil idle\nquit\n",
    );
    assert_eq!(wait_for(&mut humanoid, PATIENCE).code(), Some(0));
    type_to(&mut dog, "quit\n");
    assert_eq!(wait_for(&mut dog, PATIENCE).code(), Some(0));
    assert_eq!(ends(&log_of(&ari)), ["\"taskCompleted\""]);
    for robot in [ari, go2] {
        crossguard_judge::validate::one(log_of(&robot).as_bytes()).unwrap();
    }
}

#[test]
fn a_person_types_every_step_and_reads_what_happens() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let ari = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let go2 = robot_file(folder.path(), "Go2", 2, port + 1, port);
    // Nobody leads by itself here.
    let text = std::fs::read_to_string(&ari)
        .unwrap()
        .replace("autopilot = true", "");
    std::fs::write(&ari, text).unwrap();
    let mut go2 = start(&go2);
    let script = "wait 0.3\ndetect 1 high block # a child\nuntil role-established\nwait 0.4\n\
                  order 2 block\nuntil maneuver-executing\nopen\nwait 0.2\nstatus\nclose\n\
                  task-completed\nuntil idle\nquit\n";
    let output = run_with(&["run", "--config", &ari], script.as_bytes());
    let text = stdout(&output);
    assert_eq!(output.status.code(), Some(0), "{text}{}", stderr(&output));
    for expected in [
        "ARI is station 1, boot 1, on 127.0.0.1:",
        "a leader that does stops its followers within ",
        "now RoleEstablished (leader)",
        "2 joined",
        "2 acknowledged 1#1.0/0",
        "ManeuverExecuting, leader, available, session 1#1.0",
        "1#1.0 ended: task completed",
        "stopped",
    ] {
        assert!(text.contains(expected), "'{expected}' is not in:\n{text}");
    }
    type_to(&mut go2, "quit\n");
    wait_for(&mut go2, PATIENCE);
}

#[test]
fn an_interrupted_leader_ends_its_session_in_order() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let ari = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let go2 = robot_file(folder.path(), "Go2", 2, port + 1, port);
    let slow = |path: &str| {
        let text = std::fs::read_to_string(path)
            .unwrap()
            .replace("speed = 40.0", "speed = 1.0");
        std::fs::write(path, text).unwrap();
    };
    slow(&go2);
    let (mut humanoid, mut dog) = (start(&ari), start(&go2));
    type_to(&mut humanoid, "wait 0.3\ndetect\n");
    type_to(&mut dog, "until maneuver-executing\nuntil idle 30\nquit\n");
    std::thread::sleep(Duration::from_millis(1_500));
    signal(&humanoid, "-INT");
    assert_eq!(wait_for(&mut humanoid, PATIENCE).code(), Some(0));
    assert_eq!(
        wait_for(&mut dog, PATIENCE).code(),
        Some(0),
        "released by name, not by silence"
    );
    assert_eq!(ends(&log_of(&ari)), ["\"leaveRequested\""]);
}

#[test]
fn a_killed_robot_boots_with_the_next_counter_and_never_reuses_a_session() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let ari = robot_file(folder.path(), "ARI", 1, port, port + 1);
    for boot in 1..=3 {
        let mut robot = start(&ari);
        type_to(&mut robot, "detect\n");
        std::thread::sleep(Duration::from_millis(400));
        signal(&robot, "-KILL");
        wait_for(&mut robot, PATIENCE);
        let log = log_of(&ari);
        let sessions = format!("\"number\":{{\"boot\":{boot},\"count\":0}}");
        assert!(log.contains(&sessions), "{log}");
    }
}

#[test]
fn a_script_that_waits_in_vain_fails() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let ari = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let output = run_with(&["run", "--config", &ari], b"until role-established 0.3\n");
    assert_eq!(output.status.code(), Some(1));
    let text = stdout(&output);
    assert!(
        text.contains("RoleEstablished was not reached in time; the state is Idle"),
        "{text}"
    );
}

#[test]
fn a_script_with_a_mistake_is_refused_at_the_line() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let ari = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let output = run_with(&["run", "--config", &ari], b"detect\nfly\n");
    assert_refused(&output, "'fly': no command 'fly'; type 'help'");
}

#[test]
fn a_configuration_that_makes_no_sense_is_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let path = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let good = std::fs::read_to_string(&path).unwrap();
    let refused = |text: String, cause: &str| {
        std::fs::write(&path, text).unwrap();
        assert_refused(&run(&["run", "--config", &path]), cause);
    };
    let with = |more: &str| format!("{good}{more}");
    refused(
        with("[protocol]\nt_lease = 1990\n"),
        "[protocol] the settings break 'lease-within-safety': \
         (t_lease + delay_max) * (1 + drift) < t_safety * (1 - drift)",
    );
    refused(with("[protocol]\nt_leese = 1\n"), "unknown field `t_leese`");
    refused(good.replace("name =", "nom ="), "unknown field `nom`");
    refused(
        good.replace("speed = 40.0", "speed = 0.0"),
        "a number from 1 to 100 is wanted",
    );
    let named = |more: &str| good.replace("autopilot", &format!("{more}\nautopilot"));
    refused(
        named("crossing = \"276\""),
        "crossing: '276' is no crossing",
    );
    refused(
        with("[zone]\nplace_m = [1.0, -1.5]\nradius_m = 2.0\n"),
        "[zone] has no 'road_m': with autopilot one is wanted",
    );
    refused(
        with("[zone]\npolygon_m = [[0, 0], [2, 2], [2, 0], [0, 2]]\n"),
        "[zone] polygon_m: its sides 1 and 3 cross",
    );
    let elsewhere = good.replace("127.0.0.1", "192.0.2.1");
    refused(elsewhere, "192.0.2.1");
    let to_nobody = good.replace("peers = [\"127.0.0.1", "peers = [\"0.0.0.0");
    refused(to_nobody, "[link] nothing can be sent to 0.0.0.0:");
    refused(
        good.replace("peers", "framing = \"vlan\"\npeers"),
        "unknown variant `vlan`",
    );
    refused(
        good.replace("peers", "multicast = \"239.1.1.1:4\"\npeers"),
        "[link] wants either",
    );
    refused(with("[identifiers]\nrobot_station_type = 300\n"), "300");
    assert!(
        !folder.path().join("ARI.boot").exists(),
        "nothing was persisted"
    );
    let missing = run(&["run", "--config", "no-such-file.toml"]);
    assert_refused(&missing, "no-such-file.toml: No such file or directory");
}

#[test]
fn a_corrupt_boot_counter_is_refused_with_the_way_out_and_kept() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let config = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let counter = folder.path().join("ARI.boot");
    std::fs::write(&counter, "seventeen").unwrap();
    let output = run(&["run", "--config", &config]);
    assert_refused(
        &output,
        "does not hold a boot counter: it begins with 'seventeen'",
    );
    assert!(stderr(&output).contains("with N larger than at any boot of this robot before"));
    assert_eq!(std::fs::read_to_string(&counter).unwrap(), "seventeen");
}

#[test]
fn two_processes_of_one_robot_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let config = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let mut first = start(&config);
    std::thread::sleep(Duration::from_millis(300));
    assert_refused(&run(&["run", "--config", &config]), "is in use");
    // Also when the second one would listen elsewhere.
    let elsewhere = two_free_ports();
    let text = std::fs::read_to_string(&config).unwrap();
    let moved = text.replace(&format!("1:{port}\""), &format!("1:{elsewhere}\""));
    std::fs::write(&config, moved).unwrap();
    let second = run(&["run", "--config", &config]);
    assert_refused(
        &second,
        "is in use by another process: one robot, one process",
    );
    type_to(&mut first, "quit\n");
    assert_eq!(wait_for(&mut first, PATIENCE).code(), Some(0));
    let counter = std::fs::read_to_string(folder.path().join("ARI.boot")).unwrap();
    assert_eq!(counter, "crossguard boot counter 1\n");
}

#[test]
fn the_shipped_configurations_do_the_crossing_together() {
    for robot in ["ari", "go2", "kerb"] {
        let path = format!("{}/examples/{robot}.toml", env!("CARGO_MANIFEST_DIR"));
        crossguard_robot::robot_file::RobotFile::read(path.as_ref()).unwrap();
    }
}
