//! Judgement of the kit's outputs by other programs. `harness/judges/run` installs them and runs
//! this.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::process::Command;

use crossguard_harness::metrics;
use crossguard_judge::sim::{Fuzz, run};
use crossguard_robot::tally::Tally;
use crossguard_robot::trace::{self, Record};
use crossguard_testkit::command;
use crossguard_testkit::command::{robot_file, stderr};

/// Runs a judge with something on its standard input, and shows what it says.
fn judge(script: &str, arguments: &[&Path], input: &str) {
    let python = std::env::var("CROSSGUARD_JUDGE_PYTHON")
        .expect("harness/judges/run says which Python has the judges");
    let script = PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("judges")
        .join(script);
    let mut command = Command::new(python);
    let output = command::fed(command.arg(script).args(arguments), input.as_bytes());
    let output = output.expect("Python runs");
    eprintln!("{}{}", command::stdout(&output), stderr(&output));
    assert!(output.status.success(), "the judge does not agree");
}

/// The log of a simulated street: robots that crash and boot again, radios that lose and repeat.
fn log_of(seed: u64, path: &Path) {
    let mut file = BufWriter::new(File::create(path).unwrap());
    let mut watch = |record: Record| trace::write(&mut file, &record).unwrap();
    let outcome = run(&Fuzz::default().swarm(seed), Some(&mut watch));
    assert_eq!(outcome.finding, None);
    file.flush().unwrap();
}

/// The log of a demonstration with a person at the road, so that there are cluster VAM.
fn demo(folder: &Path) -> PathBuf {
    let (people, log) = (folder.join("people.jsonl"), folder.join("demo.jsonl"));
    let lines = (0..30).map(|tenth| {
        let at_s = f64::from(tenth) / 10.0;
        format!("{{\"at_s\": {at_s}, \"id\": 1, \"position_m\": [3.0, 2.0]}}\n")
    });
    std::fs::write(&people, lines.collect::<String>()).unwrap();
    let port = command::two_free_ports().to_string();
    let mut demo = command::crossguard(&["demo", "--speed", "10", "--loss", "0.1", "--quiet"]);
    demo.args(["--cam", "--cluster-vam", "--port", &port, "--perceived"]);
    let demo = demo.arg(&people).arg("--log").arg(&log).output().unwrap();
    assert!(demo.status.success(), "{}", stderr(&demo));
    log
}

#[test]
#[ignore = "needs what harness/judges/run installs"]
fn an_independent_reader_finds_the_log_in_the_mcap_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let crossing = demo(folder.path());
    let text = std::fs::read_to_string(&crossing).unwrap();
    for kind in ["CAM", "VAM"] {
        let heard = format!("\"heard\",\"message\":\"{kind}\"");
        assert!(text.contains(&heard), "{heard}");
    }
    for seed in 0..=8 {
        let (mut log, file) = (path("log.jsonl"), path("log.mcap"));
        match seed {
            0 => log = crossing.clone(),
            seed => log_of(seed, &log),
        }
        let text = |path: &Path| path.to_str().unwrap().to_owned();
        let facts = path("facts.jsonl");
        let output = command::run(&["export", &text(&log), "--facts", &text(&facts)]);
        assert!(output.status.success(), "{}", stderr(&output));
        judge("../judge/foxglove.py", &[&facts, &file], "");
        judge("mcap_judge.py", &[&log, &file], "");
    }
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
    let log = trace::open(&demo(folder.path())).unwrap();
    let (mut log, mut tally) = (trace::Records::new(log), Tally::default());
    while !tally.corridor_open() {
        let record = log.take().unwrap().expect("it leads before its log ends");
        if record.robot == "ARI" {
            tally.record(&record);
        }
    }
    "127.0.0.1:1".clone_into(&mut tally.link);
    judge("metrics_judge.py", &[], &metrics::text(&tally));
}
