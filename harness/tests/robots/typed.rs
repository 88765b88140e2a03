//! Lines that a person types to a robot, and texts that the robot tells.

use std::net::TcpListener;

use crossguard_testkit::command::*;

use crate::street::{ARI, CROSS, GO2, Street};

#[test]
fn a_person_types_every_step_and_reads_what_happens() {
    let street = Street::new(&[]);
    // No robot leads by itself here.
    edit(&street.configs[ARI], &[("autopilot = true", "")]);
    let mut go2 = Killed(start(&street.configs[GO2]));
    let script = "{\"id\": 1, \"position_m\": [3, 1]}\n{\"id\": 2, \"position_m\": [300, 1]}\n\
                  wait 0.5\ndetect 1 high block # a child\nuntil role-established\nwait 0.4\n\
                  order 2 block\nuntil maneuver-executing\nopen\nwait 0.2\nstatus\nclose\n\
                  task-completed\nuntil idle\nwait 3\nquit\n";
    let run = ["run", "--config", &street.configs[ARI]];
    let output = run_with(&run, script.as_bytes());
    let text = stdout(&output);
    assert_code(&output, 0);
    text.must_have(&[
        "ARI is station 1, boot 1, on 127.0.0.1:",
        "a leader that does stops its followers within ",
        // The other one is too far away.
        "announces 1 person, cluster ",
        "announces nobody any more",
        "now RoleEstablished (leader)",
        "station 2 joined",
        "station 2 acknowledged command 0 of ARI's crossing 1",
        "ManeuverExecuting, leader, available, session ARI's crossing 1",
        "ARI's crossing 1 ended: task completed",
        "stopped",
    ]);
    // Nothing is told on standard error that was not asked for.
    assert_eq!(stderr(&output), "");
    quit(&mut go2.0);
}

#[test]
fn a_script_that_waits_in_vain_fails_and_a_mistake_is_refused_at_its_line() {
    let street = Street::new(&[]);
    let typed =
        |lines: &str| run_with(&["run", "--config", &street.configs[ARI]], lines.as_bytes());
    let output = typed("until role-established 0.3\n");
    assert_code(&output, 1);
    let text = stdout(&output);
    let expected = "RoleEstablished was not reached in time; the state is Idle";
    text.must_have(&[expected]);
    let unknown = "'fly': no command 'fly'; type 'help'";
    assert_refused(&typed("detect\nfly\n"), unknown);
    assert_refused(&typed("{\"id\": 1}\n"), "missing field `position_m`");
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = taken.local_addr().unwrap().to_string();
    let ari = &street.configs[ARI];
    let run = run_line(&format!("run --config {ari} --metrics {address}"));
    assert_refused(&run, &format!("--metrics {address}: "));
}

#[test]
fn two_processes_of_one_robot_are_refused() {
    let street = Street::new(&[]);
    let config = &street.configs[ARI];
    let mut first = Killed(start(config));
    street.until(ARI, "\"started\"");
    assert_refused(&run(&["run", "--config", config]), "is in use");
    // Also when the second one would listen elsewhere.
    street.link(ARI, "address = \"127.0.0.1:0\"\npeers = []");
    let second = run(&["run", "--config", config]);
    let cause = "is in use by another process: one robot, one process";
    assert_refused(&second, cause);
    quit(&mut first.0);
    let counter = std::fs::read_to_string(street.path("ARI.boot")).unwrap();
    assert_eq!(counter, "crossguard boot counter 1\n");
}

/// Hazard: a robot that was stopped by an emergency stop is sent commands all the same.
#[test]
fn after_an_emergency_stop_of_a_follower_nothing_more_is_commanded() {
    let mut street = Street::started(&[("speed = 40.0", "speed = 2.0")]);
    street.say(ARI, "wait 0.5\ndetect\n");
    street.until(ARI, "\"corridorOpened\"");
    street.say(GO2, "unavailable emergency-stop\n");
    street.until(ARI, "sessionEnded");
    street.end();
    let log = street.log(ARI);
    let (_, after) = log.split_once("maneuverFailed").expect("it fails");
    for output in ["corridorOpened", "sendRmcm", "commandManeuver"] {
        let is_there = after.contains(&format!("\"{output}\""));
        assert!(!is_there, "{output}: {after}");
    }
}

/// A stolen robot: its operator puts it on the revocation list, and a robot that runs does not hear it any more.
#[test]
fn a_stolen_robot_is_put_on_the_list_and_nobody_hears_it_any_more() {
    let mut street = Street::new(&[("name =", "revoked = \"pki/revoked.txt\"\nname =")]);
    let pki = street.path("pki");
    assert!(run(&["pki", "init", &pki]).status.success());
    let list = street.path("pki/revoked.txt");
    std::fs::write(&list, "# nobody yet\n").unwrap();
    // The stolen one does not take the list.
    edit(&street.configs[GO2], &[("revoked", "# revoked")]);
    let enforce = ["--security", "enforce", "--pki", &pki];
    street.start(&enforce);
    street.until(ARI, "\"heard\"");
    let revoked = json(&run(&["pki", "revoke", &pki, "--robot", "Go2", "--json"]));
    let text = std::fs::read_to_string(&list).unwrap();
    assert!(text.starts_with("# nobody yet\n"), "{text}");
    for ticket in revoked.as_array().unwrap() {
        assert!(text.contains(ticket["id"].as_str().unwrap()), "{text}");
    }
    street.until(ARI, r#""layer":"security","cause":"revoked""#);
    street.end();
    // The stolen robot itself, should it ever take the list, and a list that cannot be read.
    edit(&street.configs[GO2], &[("# revoked", "revoked")]);
    let go2 = [&["run", "--config", &street.configs[GO2]][..], &enforce].concat();
    assert_refused(&run(&go2), "'crossguard pki tickets' makes new ones");
    std::fs::write(&list, "Go2\n").unwrap();
    let cause = "revoked.txt:1: 'Go2' is no certificate: 16 hexadecimal digits are wanted";
    assert_refused(&run(&go2), cause);
}

#[test]
fn a_robot_whose_log_cannot_be_written_crosses_all_the_same_and_says_so() {
    let street = Street::new(&[]);
    let mut go2 = Killed(start(&street.configs[GO2]));
    let ari = &street.configs[ARI];
    let arguments = ["run", "--config", ari, "--log", "/dev/full"];
    let output = run_with(&arguments, format!("{CROSS}quit\n").as_bytes());
    let (said, error) = (stdout(&output), stderr(&output));
    assert!(
        said.contains("ARI's crossing 1 ended: task completed"),
        "{said}{error}"
    );
    error.must_have(&["/dev/full: No space left on device", "the robot goes on"]);
    said.must_have(&[
        "Its body is simulated",
        "dropped, log: full: a log has ended",
    ]);
    assert_eq!(output.status.code(), Some(3), "the log is incomplete");
    quit(&mut go2.0);
}
