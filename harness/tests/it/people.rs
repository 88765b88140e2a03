//! People without a radio: a robot is told of them, and announces them.

use crossguard_testkit::command::*;

#[test]
fn people_who_are_typed_are_announced_and_forgotten() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let robot = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let script = "wait 0.3\n{\"id\": 1, \"position_m\": [3, 1]}\n\
                  {\"id\": 2, \"position_m\": [300, 1]}\nwait 3.0\nquit\n";
    let output = run_with(&["run", "--config", &robot], script.as_bytes());
    let text = stdout(&output);
    assert_code(&output, 0);
    text.must_have(&["announces 1 person, cluster ", "announces nobody any more"]);
}
