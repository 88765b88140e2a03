//! `crossguard check --workers` and `--hosts`, as their user runs them: threads, processes, and processes that die.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

use crossguard_model_check::scenario::Scenario;
use crossguard_testkit::command::*;
use tempfile::TempDir;

/// A file with this number of hosts that are free just now.
fn hosts(folder: &Path, number: u16) -> String {
    let first = free_ports(number);
    let lines = (first..first + number).map(|port| format!("127.0.0.1:{port}\n"));
    let file = folder.join("hosts.txt");
    fs::write(&file, lines.collect::<String>()).unwrap();
    file.to_str().unwrap().to_owned()
}

fn process(scenario: &str, hosts: &str, number: usize) -> Child {
    let number = number.to_string();
    let hosts = ["--hosts", hosts, "--process", &number, "--patience", "300"];
    begin(scenario, &hosts)
}

fn begin(scenario: &str, arguments: &[&str]) -> Child {
    let mut command = crossguard(&["check", scenario, "--json"]);
    command.args(arguments);
    command.stdin(Stdio::null()).stdout(Stdio::piped());
    command.stderr(Stdio::piped()).spawn().unwrap()
}

#[test]
fn large_scenarios_are_explored_by_workers() {
    let output = run_line("check --large --max-states 2000 --json");
    assert_code(&output, 3);
    let report = json(&output);
    let explored = report["scenarios"].as_array().unwrap();
    assert!(Scenario::large().eq(explored.iter().map(|it| it["name"].as_str().unwrap())));
    assert!(!explored.is_empty());
    for scenario in explored {
        assert_eq!(scenario["cutOff"], "state-limit");
        assert_eq!(scenario["engines"][0], "crossguard-workers");
    }
}

/// Waits until a process says on standard error that it is in mid-run.
fn wait_for(process: &mut Child, is_it: impl Fn(&str) -> bool) {
    let said = BufReader::new(process.stderr.take().unwrap());
    let line = said.lines().find(|line| is_it(line.as_ref().unwrap()));
    assert!(line.is_some(), "it ended before it said so");
}

fn has_level(line: &str) -> bool {
    line.contains("level")
}

#[test]
fn when_one_of_four_processes_is_killed_the_others_say_that_they_are_incomplete() {
    let folder = TempDir::new().unwrap();
    let hosts = hosts(folder.path(), 4);
    let mut processes: Vec<_> = (0..4)
        .map(|number| process("team-of-four", &hosts, number))
        .collect();
    // It is in mid-run once it tells of a level.
    let mut killed = processes.remove(2);
    wait_for(&mut killed, has_level);
    killed.kill().unwrap();
    let killed_at = Instant::now();
    killed.wait().unwrap();
    for process in processes {
        let output = process.wait_with_output().unwrap();
        assert_code(&output, 3);
        let told = stderr(&output);
        told.must_have(&["incomplete: a process or the connection to it was lost"]);
        assert!(!told.contains("panicked"), "{told}");
        assert!(output.stdout.is_empty(), "{}", stdout(&output));
    }
    // The run itself takes minutes.
    eprintln!("noticed within {:?}", killed_at.elapsed());
    assert!(killed_at.elapsed() < Duration::from_mins(1));
}

#[test]
fn a_process_that_is_held_up_does_not_hold_up_the_others_for_ever() {
    let folder = TempDir::new().unwrap();
    let hosts = hosts(folder.path(), 2);
    let [waits, mut held] = ["0", "1"].map(|number| {
        let hosts = ["--hosts", &hosts, "--process", number, "--timeout", "15"];
        begin("team-of-four", &hosts)
    });
    wait_for(&mut held, has_level);
    signal(&held, "-STOP");
    let output = waits.wait_with_output().unwrap();
    held.kill().unwrap();
    held.wait().unwrap();
    assert_code(&output, 3);
    // The system notices by itself where something that was sent is not acknowledged.
    let told = stderr(&output);
    let causes = [
        "incomplete: another process says nothing any more",
        "incomplete: a process or the connection to it was lost",
    ];
    assert!(causes.iter().any(|cause| told.contains(cause)), "{told}");
    assert!(output.stdout.is_empty(), "{}", stdout(&output));
}

#[test]
fn processes_that_check_something_else_are_refused() {
    let folder = TempDir::new().unwrap();
    let hosts = hosts(folder.path(), 2);
    let processes = [process("stable", &hosts, 0), process("wrap", &hosts, 1)];
    for process in processes {
        let output = process.wait_with_output().unwrap();
        let cause = "checks something else: all processes need the same scenario";
        assert_refused(&output, cause);
    }
}

#[test]
fn a_port_that_is_taken_is_refused_with_its_address() {
    let folder = TempDir::new().unwrap();
    let hosts = hosts(folder.path(), 2);
    let port = fs::read_to_string(&hosts).unwrap();
    let _taken = std::net::TcpListener::bind(port.lines().next().unwrap()).unwrap();
    let refused = run(&["check", "stable", "--hosts", &hosts, "--process", "0"]);
    assert_refused(&refused, "process 0 cannot listen at 127.0.0.1:");
}

#[test]
fn a_process_that_never_comes_leaves_the_check_incomplete() {
    let folder = TempDir::new().unwrap();
    let hosts = hosts(folder.path(), 2);
    let output = run_line(&format!(
        "check stable --hosts {hosts} --process 0 --patience 1"
    ));
    assert_code(&output, 3);
    stderr(&output).must_have(&["was not there within 1 s"]);
}
