//! A stolen robot: its operator puts it on the revocation list, and a robot that runs does not hear it any more.

use std::fs;
use std::time::Duration;

use crossguard_testkit::command::*;

const PATIENCE: Duration = Duration::from_mins(1);

/// Waits until the log of a robot has this.
fn wait_for_line(config: &str, what: &str) {
    let deadline = std::time::Instant::now() + PATIENCE;
    while !log_of(config).contains(what) {
        assert!(
            std::time::Instant::now() < deadline,
            "no {what} in {}",
            log_of(config)
        );
        std::thread::sleep(Duration::from_millis(20));
    }
}

#[test]
fn a_stolen_robot_is_put_on_the_list_and_nobody_hears_it_any_more() {
    let folder = tempfile::tempdir().unwrap();
    let pki = folder.path().join("pki");
    let (folder, pki) = (folder.path(), pki.to_str().unwrap());
    let init = run(&["pki", "init", pki]);
    assert_eq!(init.status.code(), Some(0), "{}", stderr(&init));
    let list = format!("{pki}/revoked.txt");
    fs::write(&list, "# nobody yet\n").unwrap();
    let port = two_free_ports();
    let ari = robot_file(folder, "ARI", 1, port, port + 1);
    let go2 = robot_file(folder, "Go2", 2, port + 1, port);
    let text = fs::read_to_string(&ari).unwrap();
    fs::write(&ari, format!("revoked = \"pki/revoked.txt\"\n{text}")).unwrap();

    let off = run(&["run", "--config", &ari]);
    assert_refused(
        &off,
        "'revoked' in the robot file is of no use without --security",
    );
    let enforce = ["--security", "enforce", "--pki", pki];
    let mut listens = start_with(&ari, &enforce);
    let mut speaks = start_with(&go2, &enforce);
    wait_for_line(&ari, "\"heard\"");
    let revoked = json(&run(&["pki", "revoke", pki, "--robot", "Go2", "--json"]));
    let tickets = revoked.as_array().unwrap();
    assert_eq!(tickets.len(), 8);
    let text = fs::read_to_string(&list).unwrap();
    assert!(text.starts_with("# nobody yet\n"), "{text}");
    for ticket in tickets {
        assert!(text.contains(ticket["id"].as_str().unwrap()), "{text}");
    }
    wait_for_line(&ari, r#""layer":"security","cause":"revoked""#);
    for robot in [&mut listens, &mut speaks] {
        type_to(robot, "quit\n");
        assert_eq!(wait_for(robot, PATIENCE).code(), Some(0));
    }

    // The stolen robot itself, should it ever take the list, and a list that cannot be read.
    let text = fs::read_to_string(&go2).unwrap();
    fs::write(&go2, format!("revoked = \"pki/revoked.txt\"\n{text}")).unwrap();
    let go2 = [&["run", "--config", &go2][..], &enforce].concat();
    assert_refused(&run(&go2), "'crossguard pki tickets' makes new ones");
    fs::write(&list, "Go2\n").unwrap();
    assert_refused(
        &run(&go2),
        "revoked.txt:1: 'Go2' is no certificate: 16 hexadecimal digits are wanted",
    );
    fs::remove_file(&list).unwrap();
    assert_refused(&run(&go2), "revoked.txt: No such file");
}
