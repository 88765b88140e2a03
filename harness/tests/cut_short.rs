//! Long commands that are told to stop, or whose disk is full: they end in order, with what they have.

use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use crossguard_testkit::command::*;

const PATIENCE: Duration = Duration::from_mins(2);

fn start_piped(arguments: &[&str]) -> Child {
    crossguard(arguments)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

/// What a command says that gets a signal after a while.
fn cut_short(arguments: &[&str], after: Duration, name: &str) -> Output {
    let child = start_piped(arguments);
    std::thread::sleep(after);
    signal(&child, name);
    let began = Instant::now();
    let output = child.wait_with_output().unwrap();
    assert!(
        began.elapsed() < PATIENCE,
        "{arguments:?} took {:?}",
        began.elapsed()
    );
    output
}

/// The command with its standard output on a disk that is full.
fn to_a_full_disk(arguments: &[&str]) -> Output {
    let full = std::fs::File::options()
        .write(true)
        .open("/dev/full")
        .unwrap();
    crossguard(arguments)
        .stdin(Stdio::null())
        .stdout(full)
        .output()
        .unwrap()
}

fn path(folder: &tempfile::TempDir, name: &str) -> String {
    folder.path().join(name).to_str().unwrap().to_owned()
}

/// A scenario of so many states that no check of it ends before it is told to stop.
const LONG: &str = "team-of-four";

#[test]
fn a_demo_that_is_told_to_stop_leaves_a_valid_log_and_the_table_so_far() {
    for (name, json) in [("-INT", false), ("-TERM", true)] {
        let folder = tempfile::tempdir().unwrap();
        let [log, page] = ["log.jsonl", "report.html"].map(|name| path(&folder, name));
        let port = two_free_ports().to_string();
        let mut arguments = vec![
            "demo", "--speed", "1", "--port", &port, "--log", &log, "--report", &page,
        ];
        arguments.extend(json.then_some("--json"));
        let output = cut_short(&arguments, Duration::from_secs(4), name);
        assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
        if json {
            let result = crossguard_testkit::command::json(&output);
            assert_eq!(
                (&result["stopped"], &result["crossings"]),
                (&true.into(), &0.into())
            );
            assert_eq!(result["trace_valid"], true);
        } else {
            let text = stdout(&output);
            assert!(text.contains("Stopped before it was done"), "{text}");
            assert!(text.contains("T_neg"), "{text}");
        }
        let log_text = std::fs::read_to_string(&log).unwrap();
        let stopped = records(&log_text)
            .iter()
            .filter(|it| it["entry"] == "stopped")
            .count();
        assert_eq!(stopped, 2, "each robot stopped in order");
        assert_eq!(run(&["validate", &log]).status.code(), Some(0));
        assert!(std::fs::read_to_string(&page).unwrap().contains("</html>"));
    }
}

#[test]
fn a_check_that_is_told_to_stop_reports_what_it_has() {
    let folder = tempfile::tempdir().unwrap();
    let junit = path(&folder, "junit.xml");
    let arguments = [
        "check",
        LONG,
        "pair",
        "--json",
        "--threads",
        "2",
        "--junit",
        &junit,
    ];
    for name in ["-INT", "-TERM"] {
        let output = cut_short(&arguments, Duration::from_secs(2), name);
        assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
        let report = json(&output);
        let scenarios = report["scenarios"].as_array().unwrap();
        assert_eq!(scenarios.len(), 1, "the second one was not begun");
        assert_eq!(scenarios[0]["exhaustive"], false);
        assert_eq!(scenarios[0]["cut_off"], "stopped");
        assert!(
            std::fs::read_to_string(&junit)
                .unwrap()
                .contains("</testsuites>")
        );
    }
}

#[test]
fn a_check_with_two_threads_ends_when_its_time_is_over() {
    let began = Instant::now();
    let output = run(&["check", LONG, "--timeout", "2", "--threads", "2", "--json"]);
    assert_eq!(output.status.code(), Some(3));
    assert_eq!(json(&output)["scenarios"][0]["cut_off"], "time-limit");
    assert!(
        began.elapsed() < Duration::from_mins(1),
        "{:?}",
        began.elapsed()
    );
}

#[test]
fn fuzzing_that_is_told_to_stop_says_how_far_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let out = path(&folder, "out");
    let arguments = [
        "fuzz",
        "--seeds",
        "1000000",
        "--threads",
        "1",
        "--json",
        "--out",
        &out,
    ];
    for name in ["-INT", "-TERM"] {
        let output = cut_short(&arguments, Duration::from_secs(3), name);
        assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
        let seeds = json(&output)["seeds"].as_u64().unwrap();
        assert!((1..1_000_000).contains(&seeds), "{seeds}");
    }
}

#[test]
fn a_simulation_that_is_told_to_stop_leaves_out_what_is_not_whole() {
    let folder = tempfile::tempdir().unwrap();
    let csv = path(&folder, "cbr.csv");
    let arguments = ["simulate", "cbr", "--threads", "1", "--json", "--csv", &csv];
    for name in ["-INT", "-TERM"] {
        let output = cut_short(&arguments, Duration::from_secs(1), name);
        assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
        assert_eq!(json(&output)["cells"].as_array().unwrap().len(), 0);
        let said = stderr(&output);
        assert!(
            said.contains("cells with fewer seeds than asked for are left out"),
            "{said}"
        );
        let rows = std::fs::read_to_string(&csv).unwrap().lines().count();
        assert_eq!(rows, 1, "the names of the columns");
    }
}

#[test]
fn a_second_interrupt_ends_a_command_at_once() {
    let child = start_piped(&["check", LONG, "--threads", "1"]);
    std::thread::sleep(Duration::from_secs(1));
    // Both come before the command can end because of the first.
    for name in ["-STOP", "-INT", "-TERM", "-CONT"] {
        signal(&child, name);
    }
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130), "{}", stderr(&output));
}

#[test]
fn an_explorer_and_a_listener_end_well_when_they_are_told_to() {
    for arguments in [
        &["explore", "pair", "--address", "127.0.0.1:0"][..],
        &["sniff", "--address", "127.0.0.1:0"],
    ] {
        for name in ["-INT", "-TERM"] {
            let output = cut_short(arguments, Duration::from_secs(1), name);
            let said = stderr(&output);
            assert_eq!(output.status.code(), Some(0), "{arguments:?}: {said}");
        }
    }
}

#[test]
fn a_conformance_test_that_is_told_to_stop_reports_the_cases_so_far() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["-INT", "-TERM"] {
        let port = two_free_ports();
        let config = robot_file(folder.path(), "Go2", 2, port, port + 1);
        let robot = format!(
            "'{}' run --config '{config}'",
            env!("CARGO_BIN_EXE_crossguard")
        );
        let junit = path(&folder, "junit.xml");
        let arguments = ["conform", "--config", &config, "--start", &robot, "--typed"];
        let arguments = [&arguments[..], &["--json", "--junit", &junit]].concat();
        let output = cut_short(&arguments, Duration::from_secs(5), name);
        assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
        let report = json(&output);
        let count = |key: &str| report[key].as_u64().unwrap();
        assert!(count("played") < count("cases"), "{report}");
        let suites = std::fs::read_to_string(&junit).unwrap();
        assert!(suites.contains("</testsuites>"), "{suites}");
    }
}

#[test]
fn a_file_on_a_full_disk_is_named_by_each_command_that_writes_one() {
    let folder = tempfile::tempdir().unwrap();
    let log = path(&folder, "log.jsonl");
    let port = two_free_ports().to_string();
    let demo = run(&[
        "demo", "--speed", "50", "--port", &port, "--log", &log, "--quiet",
    ]);
    assert_eq!(demo.status.code(), Some(0), "{}", stderr(&demo));
    for arguments in [
        &["check", "crossing", "--junit", "/dev/full"][..],
        &[
            "fuzz",
            "--seeds",
            "1",
            "--robots",
            "2",
            "--junit",
            "/dev/full",
        ],
        &["report", &log, "--output", "/dev/full"],
        &["export", &log, "--mcap", "/dev/full"],
        &["sniff", "--address", "127.0.0.1:0", "--pcap", "/dev/full"],
    ] {
        let output = run(arguments);
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
        let expected = "/dev/full: No space left on device";
        assert!(said.contains(expected), "{arguments:?}: {said}");
    }
}

#[test]
fn a_demo_on_a_full_disk_crosses_all_the_same_and_says_what_is_lost() {
    let port = two_free_ports().to_string();
    let demo = |more: &[&str]| run(&[&["demo", "--speed", "50", "--port", &port], more].concat());
    for (option, code) in [("--log", 3), ("--report", 2), ("--mcap", 2)] {
        let output = demo(&[option, "/dev/full"]);
        let (text, said) = (stdout(&output), stderr(&output));
        assert!(
            text.contains("1 of 1 crossings completed"),
            "{option}: {text}"
        );
        assert!(said.contains("No space left on device"), "{option}: {said}");
        assert_eq!(output.status.code(), Some(code), "{option}: {said}");
    }
    // A capture begins with a header, so this is known before the robots start.
    assert_refused(&demo(&["--pcap", "/dev/full"]), "No space left on device");
}

#[test]
fn a_simulation_whose_files_cannot_be_written_prints_its_figures_all_the_same() {
    for kind in ["obs", "cbr"] {
        let small = [
            "--pedestrians",
            "20",
            "--robots",
            "0",
            "--radius",
            "10",
            "--seeds",
            "1",
        ];
        let arguments = [&["simulate", kind, "--csv", "/dev/full"], &small[..]].concat();
        let output = run(&arguments);
        let (text, said) = (stdout(&output), stderr(&output));
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(
            said.contains("/dev/full: No space left on device"),
            "{said}"
        );
        assert!(text.contains("pedestrians"), "{text}");
    }
}

#[test]
fn a_full_standard_output_is_named() {
    let port = two_free_ports().to_string();
    for arguments in [
        &["demo", "--speed", "50", "--port", &port][..],
        &["check", "paper-literal"],
        &["fuzz", "--seeds", "1", "--robots", "2"],
        &["simulate", "obs", "--pedestrians", "20", "--seeds", "1"],
        &["bounds"],
        &["odds", "--loss", "0"],
        &["conform", "--list"],
    ] {
        let output = to_a_full_disk(arguments);
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
        assert!(
            said.contains("standard output: No space left on device"),
            "{said}"
        );
    }
}

#[test]
fn a_rate_that_is_not_possible_is_said_and_the_one_taken_is_printed() {
    let small = [
        "--pedestrians",
        "20",
        "--robots",
        "0",
        "--radius",
        "10",
        "--seeds",
        "1",
        "--json",
    ];
    let vam = |hz: &str| run(&[&["simulate", "cbr", "--vam", hz][..], &small].concat());
    let odd = vam("7");
    let said = stderr(&odd);
    assert!(said.contains("--vam 7 is not possible"), "{said}");
    assert!(
        said.contains("Taken is 5 per second, one every 200 ms"),
        "{said}"
    );
    assert_eq!(json(&odd)["parameters"]["true_rates"]["vam_hz"], 5.0);
    let even = vam("5");
    assert!(!stderr(&even).contains("not possible"), "{}", stderr(&even));
    assert_eq!(json(&odd)["cells"], json(&even)["cells"]);
}

#[test]
fn a_pki_is_made_whole_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let pki = path(&folder, "pki");
    // The authority is not valid for so long.
    let late = run(&["pki", "init", &pki, "--start-in", "87600"]);
    assert_refused(&late, "choose --start-in and --hours within it");
    assert!(
        !folder.path().join("pki").exists(),
        "nothing is left behind"
    );
    // What a try that was killed has left behind is in nobody's way.
    std::fs::create_dir_all(folder.path().join("pki/.unfinished/robots")).unwrap();
    let early = run(&["pki", "init", &pki, "--start-in", "-5", "--json"]);
    assert_eq!(early.status.code(), Some(0), "{}", stderr(&early));
    let shown = json(&early);
    assert!(
        shown
            .as_array()
            .unwrap()
            .iter()
            .all(|it| it["is_valid_now"] == true)
    );
    assert!(!folder.path().join("pki/.unfinished").exists());
    let file = shown[0]["file"].as_str().unwrap();
    assert!(std::path::Path::new(file).is_file(), "{file}");
    let port = two_free_ports().to_string();
    let demo = [
        "demo",
        "--speed",
        "50",
        "--port",
        &port,
        "--security",
        "enforce",
        "--pki",
        &pki,
        "--quiet",
    ];
    let demo = run(&demo);
    assert_eq!(
        demo.status.code(),
        Some(0),
        "{}{}",
        stdout(&demo),
        stderr(&demo)
    );
}

#[test]
fn report_and_timing_take_the_speed_of_bodies_from_the_log() {
    let folder = tempfile::tempdir().unwrap();
    let log = path(&folder, "log.jsonl");
    let port = two_free_ports().to_string();
    let demo = run(&[
        "demo", "--speed", "50", "--port", &port, "--log", &log, "--json",
    ]);
    let of_demo = json(&demo)["maneuvers"].clone();
    let timing = |log: &str, more: &[&str]| {
        let output = run(&[&["timing", log, "--json"], more].concat());
        json(&output)["maneuvers"].clone()
    };
    assert_eq!(timing(&log, &[]), of_demo);
    // Logs of before do not say it, and are not linked: the option does.
    let text = std::fs::read_to_string(&log).unwrap();
    let old = path(&folder, "old.jsonl");
    assert!(
        text.contains(",\"speed\":50.0"),
        "{}",
        text.lines().next().unwrap()
    );
    let unlinked = text
        .lines()
        .map(|line| line.split(",\"link\":").next().unwrap());
    let unlinked = unlinked.flat_map(|line| [line, "}\n"]).collect::<String>();
    std::fs::write(&old, unlinked.replace(",\"speed\":50.0", "")).unwrap();
    assert_eq!(timing(&old, &["--speed", "50"]), of_demo);
    let unscaled = timing(&old, &[])[0]["t_exec_s"]["mean"].as_f64().unwrap();
    let scaled = of_demo[0]["t_exec_s"]["mean"].as_f64().unwrap();
    assert!(
        (unscaled * 50.0 - scaled).abs() < 1e-6,
        "{unscaled} {scaled}"
    );
    let page = path(&folder, "page.html");
    assert_eq!(
        run(&["report", &log, "--output", &page]).status.code(),
        Some(0)
    );
    let page = std::fs::read_to_string(&page).unwrap();
    assert!(page.contains("which passes 50 times as fast"));
}

#[test]
fn a_chart_is_no_wider_than_its_terminal() {
    let port = two_free_ports().to_string();
    let demo = |columns: &str| {
        let demo = ["demo", "--speed", "50", "--port", &port];
        let mut command: Command = crossguard(&demo);
        stdout(
            &command
                .env("COLUMNS", columns)
                .stdin(Stdio::null())
                .output()
                .unwrap(),
        )
    };
    let text = demo("80");
    let chart: Vec<_> = text
        .lines()
        .skip_while(|line| !line.contains("t/s"))
        .collect();
    let chart: Vec<_> = chart.iter().take_while(|line| !line.is_empty()).collect();
    assert!(chart.len() > 20, "{text}");
    assert!(
        chart.iter().all(|line| line.chars().count() <= 80),
        "{text}"
    );
    assert!(text.contains("RAM"), "{text}");
    let text = demo("40");
    assert!(text.contains("wider than the screen"), "{text}");
}
