//! What other programs make of what the kit writes for them. `harness/judges/run` installs them and runs
//! this.

use std::fs::File;
use std::io::{BufRead, BufReader, BufWriter, Read, Write};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;

use crossguard_judge::sim::{Fuzz, run};
use crossguard_robot::trace::{self, Record};
use crossguard_testkit::command;
use crossguard_testkit::command::{robot_file, stderr, type_to, wait_for};

/// Runs a judge with something on its standard input, and shows what it says.
fn judge(script: &str, arguments: &[&Path], input: &str) {
    let python = std::env::var("CROSSGUARD_JUDGE_PYTHON")
        .expect("harness/judges/run says which Python has the judges");
    let script = PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("judges")
        .join(script);
    let mut command = Command::new(python);
    command
        .arg(script)
        .args(arguments)
        .stdin(Stdio::piped())
        .stderr(Stdio::piped());
    let mut child = command.spawn().expect("Python runs");
    child
        .stdin
        .take()
        .unwrap()
        .write_all(input.as_bytes())
        .unwrap();
    let output = child.wait_with_output().unwrap();
    eprintln!("{}", stderr(&output));
    assert!(output.status.success(), "the judge does not agree");
}

/// The log of a simulated street: robots that crash and boot again, radios that lose and repeat.
fn log_of(seed: u64, path: &Path) {
    let fuzz = Fuzz {
        first: seed,
        seeds: 1,
        robots: 6,
        faults: None,
        plan: None,
        liars: 0.0,
        threads: 1,
        failures_max: 1,
    };
    let mut file = BufWriter::new(File::create(path).unwrap());
    let mut watch = |record: Record| trace::write(&mut file, &record).unwrap();
    let outcome = run(&fuzz.swarm(seed), Some(&mut watch));
    assert_eq!(outcome.finding, None);
    file.flush().unwrap();
}

#[test]
#[ignore = "needs what harness/judges/run installs"]
fn an_independent_reader_finds_the_log_in_the_mcap_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    for seed in 1..=8 {
        let (log, file) = (path("log.jsonl"), path("log.mcap"));
        log_of(seed, &log);
        let text = |path: &Path| path.to_str().unwrap().to_owned();
        let output = command::run(&["export", &text(&log), "--mcap", &text(&file)]);
        assert!(output.status.success(), "{}", stderr(&output));
        judge("mcap_judge.py", &[&log, &file], "");
    }
    let log = path("demo.jsonl");
    let port = command::two_free_ports().to_string();
    // Somebody stands at the road, so that there are cluster VAM.
    let people = path("people.jsonl");
    let lines = (0..30).map(|tenth| {
        let at_s = f64::from(tenth) / 10.0;
        format!("{{\"at_s\": {at_s}, \"id\": 1, \"position_m\": [3.0, 2.0]}}\n")
    });
    std::fs::write(&people, lines.collect::<String>()).unwrap();
    let arguments = ["demo", "--speed", "10", "--loss", "0.1", "--quiet"];
    let mut demo = command::crossguard(&arguments);
    demo.args(["--cam", "--cluster-vam", "--port", &port, "--perceived"]);
    let demo = demo.arg(&people).arg("--log").arg(&log).output().unwrap();
    assert!(demo.status.success(), "{}", stderr(&demo));
    let file = path("demo.mcap");
    let export = command::crossguard(&["export", "--mcap"])
        .arg(&file)
        .arg(&log)
        .output()
        .unwrap();
    assert!(export.status.success(), "{}", stderr(&export));
    let log_text = std::fs::read_to_string(&log).unwrap();
    for heard in [
        "\"heard\",\"message\":\"CAM\"",
        "\"heard\",\"message\":\"VAM\"",
    ] {
        assert!(log_text.contains(heard), "{heard}");
    }
    judge("mcap_judge.py", &[&log, &file], "");
}

#[cfg(feature = "zenoh")]
#[test]
#[ignore = "needs what harness/judges/run installs"]
fn a_subscriber_to_zenoh_hears_packets_that_can_be_decoded() {
    let port = command::free_ports(1);
    let demo = ["demo", "--zenoh", "router", "--quiet", "--trials", "3"];
    let mut demo = command::crossguard(&demo)
        .args(["--port", &port.to_string()])
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let program = Path::new(env!("CARGO_BIN_EXE_crossguard"));
    let endpoint = format!("tcp/127.0.0.1:{port}");
    judge("zenoh_judge.py", &[program, Path::new(&endpoint)], "");
    assert!(wait_for(&mut demo, Duration::from_mins(2)).success());
}

#[test]
#[ignore = "needs what harness/judges/run installs"]
fn an_independent_decoder_of_cam_sees_the_robot() {
    let folder = tempfile::tempdir().unwrap();
    let port = command::two_free_ports();
    let robot = robot_file(folder.path(), "ARI", 7, port, port + 1);
    let pcap = folder.path().join("ari.pcap");
    let run = ["run", "--config", &robot, "--cam", "--pcap"];
    let arguments = [&run[..], &[pcap.to_str().unwrap()]].concat();
    let output = command::run_with(&arguments, b"wait 4.3\nquit\n");
    assert!(output.status.success(), "{}", stderr(&output));
    judge("cam_judge.py", &[&pcap, Path::new("7")], "");
}

#[test]
#[ignore = "needs what harness/judges/run installs"]
fn prometheus_reads_the_metrics_of_a_robot_that_leads() {
    let folder = tempfile::tempdir().unwrap();
    let port = command::two_free_ports();
    let ari = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let go2 = robot_file(folder.path(), "Go2", 2, port + 1, port);
    let mut dog = command::start(&go2);
    let mut command = command::crossguard(&["run", "--config", &ari, "--metrics", "0"]);
    let mut robot = command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut lines = BufReader::new(robot.stdout.take().unwrap())
        .lines()
        .map_while(Result::ok);
    let address = lines.find_map(|line| {
        let address = line.strip_prefix("Metrics are at http://")?;
        Some(address.strip_suffix("/metrics.")?.to_owned())
    });
    type_to(
        &mut robot,
        // Nobody follows yet, so the first one is ignored, and counted.
        "open\ndetect\nuntil maneuver-executing\nwait 2\nquit\n",
    );
    lines
        .find(|line| line.contains("now ManeuverExecuting"))
        .expect("it leads");
    let mut client = TcpStream::connect(address.expect("metrics are served")).unwrap();
    client
        .set_read_timeout(Some(Duration::from_secs(10)))
        .unwrap();
    client
        .write_all(b"GET /metrics HTTP/1.1\r\nHost: here\r\n\r\n")
        .unwrap();
    let mut answer = String::new();
    client.read_to_string(&mut answer).unwrap();
    let (head, body) = answer.split_once("\r\n\r\n").unwrap();
    assert!(head.starts_with("HTTP/1.1 200"), "{head}");
    // The output is read to its end.
    for _ in lines {}
    type_to(&mut dog, "quit\n");
    for child in [&mut robot, &mut dog] {
        assert!(wait_for(child, Duration::from_secs(30)).success());
    }
    judge("metrics_judge.py", &[], body);
}
