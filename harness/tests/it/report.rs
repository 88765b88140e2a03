//! The page about a run: its content. The page in a browser without a network is tested in `tests/studio/pages.py`.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Output;

use crossguard_judge::sim::Swarm;
use crossguard_testkit::command::*;
use serde_json::Value;

use crate::sim;

/// A file with the log of simulated robots.
fn log_of(seed: u64, folder: &Path) -> PathBuf {
    let path = folder.join(format!("seed-{seed}.jsonl"));
    std::fs::write(&path, sim::log_of(seed, 5)).unwrap();
    path
}

fn report(logs: &[&Path], page: &Path) -> Output {
    let mut command = crossguard(&["report", "--output"]);
    command.arg(page).args(logs).output().unwrap()
}

/// Data of the run in a page.
fn inside(page: &Path) -> Value {
    let page = std::fs::read_to_string(page).unwrap();
    let (_, data) = page.split_once("id=\"saved\">").unwrap();
    serde_json::from_str(data.split_once("</script>").unwrap().0).unwrap()
}

#[test]
fn the_page_has_every_robot_and_message_and_the_road_of_the_site() {
    let folder = tempfile::tempdir().unwrap();
    let (log, page) = (log_of(3, folder.path()), folder.path().join("page.html"));
    let output = report(&[&log, Path::new("--site"), Path::new("street")], &page);
    assert_code(&output, 0);
    stdout(&output).must_have(&["page.html: valid\n"]);
    let run = inside(&page);
    let overview = &run["opening"]["overview"];
    let names = overview["robots"].as_array().unwrap().iter();
    let names: Vec<_> = names.map(|it| &it["name"]).collect();
    let robots = Swarm::draw(3, 5, None).robots.into_iter();
    let robots: Vec<_> = robots.map(|it| Value::from(it.name)).collect();
    let are_there = robots.len() > 1 && robots.iter().all(|it| names.contains(&it));
    assert!(are_there, "{names:?}");
    assert_eq!(overview["street"]["kerbs"].as_array().unwrap().len(), 2);
    let rows = run["run"]["rows"].as_array().unwrap();
    let heard_by_several = |row: &&Value| row["heard"].as_array().unwrap().len() > 1;
    assert!(rows.len() > 20 && rows.iter().filter(heard_by_several).count() > 2);
    let moments = run["run"]["moments"].as_array().unwrap();
    assert_eq!(moments.last().unwrap()["at"], overview["lasted"]);
    let nowhere = [&log, Path::new("--site"), Path::new("nowhere.toml")];
    assert_refused(&report(&nowhere, &page), "nowhere.toml");
}

#[test]
fn a_page_is_written_of_a_log_that_is_not_valid_and_says_why() {
    let folder = tempfile::tempdir().unwrap();
    let (log, page) = (log_of(3, folder.path()), folder.path().join("page.html"));
    let text = std::fs::read_to_string(&log).unwrap();
    let mut lines: Vec<_> = text.lines().collect();
    let octets = |line: &str| Some(line.split_once(r#""octets":""#)?.1.to_owned());
    let of = |line: &str, entry: &str| octets(line).filter(|_| line.contains(entry));
    let heard: BTreeSet<_> = lines
        .iter()
        .filter_map(|line| of(line, r#""entry":"heard""#))
        .collect();
    // One that somebody heard: nobody misses another.
    let is_missed =
        |line: &&str| of(line, r#""entry":"sent""#).is_some_and(|it| heard.contains(&it));
    let sent = lines.iter().position(is_missed).unwrap();
    lines.remove(sent);
    std::fs::write(&log, lines.join("\n") + "\n").unwrap();
    let output = report(&[&log], &page);
    assert_code(&output, 1);
    let verdict = inside(&page)["opening"]["verdict"].clone();
    assert_eq!(verdict["kind"], "invalid");
    let verdict = verdict.to_string();
    verdict.must_have(&["not among those it had sent"]);
    std::fs::write(&log, "nonsense\n").unwrap();
    let nowhere = folder.path().join("nowhere.html");
    assert_refused(&report(&[&log], &nowhere), "line 1: is not a record");
    assert!(!nowhere.exists());
    let none = folder.path().join("none");
    assert_refused(&report(&[&none], &nowhere), "none: No such file");
}
