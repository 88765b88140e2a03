//! The folder that `crossguard new` makes, and its robots on one terminal, beside what the page on running robots does.

use std::process::Stdio;

use crossguard_testkit::command::*;

#[test]
fn a_new_corner_is_not_overwritten_and_says_which_robot_is_gone() {
    let folder = tempfile::tempdir().unwrap();
    let corner = folder.path().join("corner").display().to_string();
    assert_code(&run(&["new", &corner]), 0);
    assert_refused(&run(&["new", &corner]), "File exists");
    let port = two_free_ports();
    let (first, second) = (port.to_string(), (port + 1).to_string());
    for config in ["ARI", "Go2"].map(|name| format!("{corner}/{name}.toml")) {
        edit(&config, &[("47411", &first), ("47412", &second)]);
    }
    let all = ["run", "--all", &corner];
    let mut robots = crossguard(&all);
    robots.stdin(Stdio::piped()).stdout(Stdio::null());
    let mut robots = Killed(robots.spawn().unwrap());
    for log in ["ARI", "Go2"].map(|name| format!("{corner}/{name}.jsonl")) {
        wait_until_in(log, "\"started\"");
    }
    // The same robots once more have no ports, and leave the first ones alone.
    let again = run(&all);
    assert_code(&again, 1);
    stderr(&again).must_have(&["ARI is gone: exit status: 2", "Go2 is gone: exit status: 2"]);
    quit(&mut robots.0);
    let none = run(&["run", "--all", folder.path().to_str().unwrap()]);
    assert_refused(
        &none,
        "no robot file is here; 'crossguard new' makes a folder with two",
    );
}
