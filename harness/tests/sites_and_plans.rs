//! Sites and plans as files, the same for `run`, `demo` and `site`.

use std::path::Path;
use std::time::Duration;

use crossguard_testkit::command::*;

const PATIENCE: Duration = Duration::from_mins(1);

/// The lines of a log that a robot put this out in.
fn put_out(log: &str, name: &str) -> usize {
    log.lines()
        .filter(|line| line.contains(&format!("\"{name}\"")))
        .count()
}

/// Robots in processes of their own, the first of which leads by this plan until the task is completed. Their logs.
fn cross(plan: &str, others: &[(&str, u32, &str, [f64; 2])]) -> Vec<String> {
    let folder = tempfile::tempdir().unwrap();
    let count = u16::try_from(others.len()).unwrap() + 1;
    let port = free_ports(count);
    let file = |name: &str, station: u32, build: &str, [east, north]: [f64; 2], own: u16| {
        let peers = (0..count).filter(|nth| *nth != own);
        let peers: Vec<_> = peers
            .map(|nth| format!("\"127.0.0.1:{}\"", port + nth))
            .collect();
        let (own, peers) = (port + own, peers.join(", "));
        let text = format!(
            "name = \"{name}\"\nstation = {station}\nbuild = \"{build}\"\nboot_file = \"{name}.boot\"\n\
             speed = 20.0\nplace = [{east:.1}, {north:.1}]\n\n[link]\naddress = \"127.0.0.1:{own}\"\n\
             peers = [{peers}]\n"
        );
        let path = folder.path().join(format!("{name}.toml"));
        std::fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let ari = file("ARI", 1, "humanoid", [-4.0, -0.8], 0);
    let others = others
        .iter()
        .zip(1..)
        .map(|((name, station, build, place), own)| file(name, *station, build, *place, own));
    let others: Vec<_> = others.collect();
    let mut helpers: Vec<_> = others.iter().map(|config| start(config)).collect();
    let mut leader = start_with(&ari, &["--plan", plan]);
    type_to(
        &mut leader,
        "wait 0.5\ndetect\nuntil maneuver-executing\nuntil idle 50\nquit\n",
    );
    assert_eq!(wait_for(&mut leader, PATIENCE).code(), Some(0));
    for helper in &mut helpers {
        type_to(helper, "quit\n");
        assert_eq!(wait_for(helper, PATIENCE).code(), Some(0));
    }
    let logs: Vec<_> = std::iter::once(&ari)
        .chain(&others)
        .map(|config| log_of(config))
        .collect();
    for log in &logs {
        crossguard_judge::validate::one(log.as_bytes()).unwrap();
    }
    logs
}

const SECOND: (&str, u32, &str, [f64; 2]) = ("ARI-2", 3, "humanoid", [6.0, 8.2]);
const DOG: (&str, u32, &str, [f64; 2]) = ("Go2", 2, "quadruped", [1.0, -1.1]);

#[test]
fn two_processes_block_both_directions_by_the_plan_of_the_demonstration() {
    let logs = cross("bilateral", &[SECOND]);
    assert_eq!(put_out(&logs[0], "corridorOpened"), 1);
    assert!(logs[0].contains("taskCompleted"), "{}", logs[0]);
}

#[test]
fn three_processes_do_the_crossing_of_the_trio() {
    let logs = cross("trio", &[SECOND, DOG]);
    assert_eq!(put_out(&logs[0], "corridorOpened"), 1);
    assert!(logs[0].contains("taskCompleted"), "{}", logs[0]);
    for (log, starts) in [(&logs[1], 2), (&logs[2], 2)] {
        assert_eq!(put_out(log, "startManeuver"), starts);
    }
}

#[test]
fn a_plan_and_a_site_of_ones_own_are_checked_drawn_and_demonstrated() {
    let folder = tempfile::tempdir().unwrap();
    let plans = Path::new(env!("CARGO_MANIFEST_DIR")).join("robot/plans");
    let [site, plan, picture] = ["site.toml", "two.toml", "two.svg"].map(|name| {
        let path = folder.path().join(name);
        path.to_str().unwrap().to_owned()
    });
    let street = std::fs::read_to_string(plans.join("street.toml")).unwrap();
    std::fs::write(&site, street.replace("49.0101", "48.5")).unwrap();
    let text = std::fs::read_to_string(plans.join("bilateral.toml")).unwrap();
    std::fs::write(&plan, &text).unwrap();
    let files = ["--site", &site, "--plan", &plan];
    let checked = run(&[&["site", "check"], &files[..]].concat());
    assert_eq!(checked.status.code(), Some(0), "{}", stderr(&checked));
    assert!(stdout(&checked).contains("plan two: 2 roles, 2 stages; it fits"));
    let drawn = run(&[&["site", "draw", "--svg", &picture], &files[..]].concat());
    assert_eq!(drawn.status.code(), Some(0), "{}", stderr(&drawn));
    let svg = std::fs::read_to_string(&picture).unwrap();
    for (class, count) in [
        ("lane", 2),
        ("kerb", 2),
        ("place", 9),
        ("way", 2),
        ("target", 3),
    ] {
        let found = svg.matches(&format!("class=\"{class}\"")).count();
        assert_eq!(found, count, "{class}: {svg}");
    }
    let told = run(&[&["site", "draw"], &files[..]].concat());
    assert!(
        stdout(&told).contains("blocker                 6.00    5.00  2 block"),
        "{}",
        stdout(&told)
    );
    let port = free_ports(2).to_string();
    let demo = ["demo", "--speed", "20", "--json", "--port", &port];
    let shown = run(&[&demo[..], &files[..]].concat());
    assert_eq!(shown.status.code(), Some(0), "{}", stderr(&shown));
    assert_eq!(json(&shown)["scenario"], "two");

    std::fs::write(&plan, text.replace("waits = \"far-pavement\"", "")).unwrap();
    assert_refused(
        &run(&[&demo[..], &files[..]].concat()),
        "role 'blocker' wants 'waits'",
    );
    std::fs::write(&plan, text.replace("\"far-lane\"", "\"near-lane\"")).unwrap();
    let cause = "two.toml:22: roles 'blocker' and 'leader' are 0.00 m apart in this stage";
    assert_refused(&run(&[&["site", "check"], &files[..]].concat()), cause);
    let ari = robot_file(folder.path(), "ARI", 1, 47_000, 47_001);
    let refused = run(&[&["run", "--config", &ari], &files[..]].concat());
    assert_refused(&refused, cause);
}

/// Hazard: who was stopped by an emergency stop is sent commands all the same.
#[test]
fn after_an_emergency_stop_of_a_follower_nothing_more_is_commanded() {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let ari = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let go2 = robot_file(folder.path(), "Go2", 2, port + 1, port);
    edit(&go2, &[("speed = 40.0", "speed = 2.0")]);
    let (mut dog, mut leader) = (start(&go2), start(&ari));
    type_to(
        &mut leader,
        "wait 0.5\ndetect\nuntil maneuver-executing\nuntil idle 50\nquit\n",
    );
    type_to(
        &mut dog,
        "until maneuver-executing\nwait 3\nunavailable emergency-stop\n",
    );
    assert_eq!(wait_for(&mut leader, PATIENCE).code(), Some(0));
    type_to(&mut dog, "quit\n");
    assert_eq!(wait_for(&mut dog, PATIENCE).code(), Some(0));
    let log = log_of(&ari);
    let stopped = log.find("maneuverFailed").expect("it fails");
    assert!(put_out(&log[..stopped], "corridorOpened") > 0, "{log}");
    assert_eq!(put_out(&log[stopped..], "sendRmcm"), 0, "{log}");
    assert_eq!(put_out(&log[stopped..], "commandManeuver"), 0, "{log}");
    assert!(log[stopped..].contains("sessionEnded"), "{log}");
}
