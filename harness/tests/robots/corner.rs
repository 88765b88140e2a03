//! The folder that `crossguard new` makes, and its robots on one terminal.

use std::process::Stdio;

use crossguard_testkit::command::*;

/// The people of the folder come to the kerb, and the corridor opens; nobody types.
#[test]
fn a_new_corner_fits_runs_as_it_is_and_says_which_robot_is_gone() {
    let folder = tempfile::tempdir().unwrap();
    let corner = folder.path().join("corner").display().to_string();
    assert_code(&run(&["new", &corner]), 0);
    assert_refused(&run(&["new", &corner]), "File exists");
    let [site, plan, ari, go2] =
        ["site", "plan", "ARI", "Go2"].map(|name| format!("{corner}/{name}.toml"));
    let fits = run(&["site", "check", "--site", &site, "--plan", &plan]);
    assert!(stdout(&fits).starts_with("site corner: "), "{fits:?}");
    let port = two_free_ports();
    let (first, second) = (port.to_string(), (port + 1).to_string());
    for config in [&ari, &go2] {
        edit(config, &[("47411", &first), ("47412", &second)]);
    }
    let all = ["run", "--all", &corner];
    let mut robots = crossguard(&all);
    let told = folder.path().join("told");
    let lines = std::fs::File::create(&told).unwrap();
    robots.stdin(Stdio::piped()).stdout(lines);
    let mut robots = Killed(robots.spawn().unwrap());
    wait_until_in(format!("{corner}/ARI.jsonl"), "corridorOpened");
    // The same robots once more have no ports, and leave the first ones alone.
    let again = run(&all);
    assert_code(&again, 1);
    stderr(&again).must_have(&["ARI is gone: exit status: 2", "Go2 is gone: exit status: 2"]);
    quit(&mut robots.0);
    // Go2 has no plan that names others.
    let told = std::fs::read_to_string(told).unwrap();
    told.must_have(&["Go2: joined ARI's crossing 1"]);
    let logs = run(&[
        "validate",
        &format!("{corner}/ARI.jsonl"),
        &format!("{corner}/Go2.jsonl"),
    ]);
    assert_code(&logs, 0);
    let none = run(&["run", "--all", folder.path().to_str().unwrap()]);
    assert_refused(
        &none,
        "no robot file is here; 'crossguard new' makes a folder with two",
    );
}
