//! Robots as processes of the `crossguard` command, which cargo builds for the tests of its own crate.

use std::fs::File;
use std::io::{BufRead, Write};
use std::os::unix::net::UnixStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use serde_json::Value;

use crate::built;
pub use crate::ports::{free_ports, two_free_ports};

/// The `crossguard` command with these arguments.
pub fn crossguard(arguments: &[&str]) -> Command {
    let mut command = Command::new(built::programs().join("crossguard"));
    command.args(arguments);
    command
}

/// Runs the command to its end.
pub fn run(arguments: &[&str]) -> Output {
    crossguard(arguments).stdin(Stdio::null()).output().unwrap()
}

/// Runs the command to its end, with arguments that stand in a line, parted by white space.
pub fn run_line(line: &str) -> Output {
    run(&line.split_whitespace().collect::<Vec<_>>())
}

/// The same; it has to end well.
#[track_caller]
pub fn run_well(line: &str) -> Output {
    let output = run_line(line);
    assert_code(&output, 0);
    output
}

/// Runs the command with this on its standard input.
pub fn run_with(arguments: &[&str], input: &[u8]) -> Output {
    fed(&mut crossguard(arguments), input).unwrap()
}

/// Runs any command with this on its standard input.
///
/// # Errors
/// When it cannot be started.
pub fn fed(command: &mut Command, input: &[u8]) -> std::io::Result<Output> {
    let command = command.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = command.stderr(Stdio::piped()).spawn()?;
    // One that does not read it may have closed it.
    let _ = child.stdin.take().unwrap().write_all(input);
    child.wait_with_output()
}

pub fn stdout(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

pub fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Asserts that a command ended with this exit code; if not, tells all that it said.
#[track_caller]
pub fn assert_code(output: &Output, code: i32) {
    let said = stdout(output) + &stderr(output);
    assert_eq!(output.status.code(), Some(code), "{said}");
}

/// What a program has said or written.
pub trait Said {
    /// Asserts that each of these parts is in it.
    fn must_have(&self, parts: &[&str]);
}

impl Said for str {
    #[track_caller]
    fn must_have(&self, parts: &[&str]) {
        for part in parts {
            assert!(self.contains(part), "'{part}' is not in:\n{self}");
        }
    }
}

/// Asserts that the command refused its input with a readable cause.
#[track_caller]
pub fn assert_refused(output: &Output, cause: &str) {
    let message = stderr(output);
    assert_code(output, 2);
    message.must_have(&[cause]);
    assert!(!message.contains("panicked"), "{message}");
}

pub fn json(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|error| panic!("{error}\n{}\n{}", stdout(output), stderr(output)))
}

/// What a demo with these more arguments says as JSON, and what `attack` gives, which gets the first of its two ports and
/// goes on until it is told to stop. The demo has to end well.
pub fn demo_under_attack<T: Send>(
    more: &str,
    attack: impl FnOnce(u16, &AtomicBool) -> T + Send,
) -> (Value, T) {
    let port = two_free_ports();
    let demo = format!("demo --json --port {port} {more}");
    let done = AtomicBool::new(false);
    let (output, came) = std::thread::scope(|scope| {
        let attacker = scope.spawn(|| attack(port, &done));
        let output = run_line(&demo);
        done.store(true, Ordering::Relaxed);
        (output, attacker.join().unwrap())
    });
    assert_code(&output, 0);
    (json(&output), came)
}

/// A robot's configuration in a file, with what differs from robot to robot.
pub fn robot_file(folder: &Path, name: &str, station: u32, port: u16, peer: u16) -> String {
    let build = if station == 1 {
        "humanoid"
    } else {
        "quadruped"
    };
    let text = format!(
        "name = \"{name}\"\nstation = {station}\nbuild = \"{build}\"\n\
         boot_file = \"{name}.boot\"\nspeed = 40.0\nautopilot = true\n\n[link]\n\
         address = \"127.0.0.1:{port}\"\npeers = [\"127.0.0.1:{peer}\"]\n"
    );
    let path = folder.join(format!("{name}.toml"));
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

/// Starts a robot whose log goes to a file beside its configuration, see [`log_of`].
pub fn start(config: &str) -> Child {
    start_with(config, &[])
}

/// The same, with more arguments.
pub fn start_with(config: &str, arguments: &[&str]) -> Child {
    let log = File::create(Path::new(config).with_extension("log")).unwrap();
    crossguard(&["run", "--config", config, "--json"])
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(log)
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

/// The log of a robot that was started with [`start`].
pub fn log_of(config: &str) -> String {
    std::fs::read_to_string(Path::new(config).with_extension("log")).unwrap()
}

/// Types lines to a robot.
pub fn type_to(robot: &mut Child, lines: &str) {
    let input = robot.stdin.as_mut().unwrap();
    input.write_all(lines.as_bytes()).unwrap();
    input.flush().unwrap();
}

/// Waits until the process has ended, at most for so long.
pub fn wait_for(child: &mut Child, patience: Duration) -> std::process::ExitStatus {
    let deadline = Instant::now() + patience;
    loop {
        if let Some(status) = child.try_wait().unwrap() {
            return status;
        }
        if Instant::now() >= deadline {
            let _ = child.kill();
            panic!("still running after {patience:?}");
        }
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// Tells a robot to quit, which has to end well.
#[track_caller]
pub fn quit(robot: &mut Child) {
    type_to(robot, "quit\n");
    assert_eq!(wait_for(robot, Duration::from_mins(1)).code(), Some(0));
}

/// Waits until something is so, at most for two minutes.
pub fn wait_until(what: &str, mut is_so: impl FnMut() -> bool) {
    let deadline = Instant::now() + Duration::from_mins(2);
    while !is_so() {
        assert!(Instant::now() < deadline, "waited in vain: {what}");
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// Waits until a file has this text.
pub fn wait_until_in(file: impl AsRef<Path>, text: &str) {
    let file = file.as_ref();
    let has_it = || std::fs::read_to_string(file).is_ok_and(|it| it.contains(text));
    wait_until(&format!("'{text}' in {}", file.display()), has_it);
}

/// Connects to a port of a robot, as soon as it is there.
pub fn connect(socket: impl AsRef<Path>) -> UnixStream {
    let mut stream = None;
    wait_until("the port of a robot", || {
        stream = UnixStream::connect(&socket).ok();
        stream.is_some()
    });
    stream.unwrap()
}

/// A process that does not outlive its test.
pub struct Killed(pub Child);

impl Drop for Killed {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Sends a signal to a process.
pub fn signal(child: &Child, signal: &str) {
    let status = Command::new("kill")
        .args([signal, &child.id().to_string()])
        .status()
        .unwrap();
    assert!(status.success());
}

/// Says that the test that runs in this thread is skipped, not by eprintln!, which the test runner would capture.
pub fn skipped(why: &str) {
    let test = std::thread::current().name().unwrap_or_default().to_owned();
    let _ = writeln!(std::io::stderr(), "SKIPPED {test}: {why}");
}

/// Runs a script of the shell in namespaces of its own of these kinds; `None`, and a word about it, where this machine permits
/// none: with the arguments `tried` the script does no more than end well.
pub fn unshared(
    kinds: &[&str],
    script: &str,
    tried: &[&str],
    arguments: &[&str],
) -> Option<Output> {
    let run = |arguments: &[&str]| {
        Command::new("unshare")
            .args(["--user", "--map-root-user"])
            .args(kinds)
            .args(["sh", "-c", script, "script"])
            .args(arguments)
            .stdin(Stdio::null())
            .output()
            .unwrap()
    };
    let tried = run(tried);
    if tried.status.success() {
        return Some(run(arguments));
    }
    let (kinds, why) = (kinds.join(" "), stderr(&tried));
    skipped(&format!(
        "this machine permits no namespaces {kinds}: {}",
        why.trim()
    ));
    None
}

/// Reads on in the JSON lines of a port until one is like this.
pub fn read_until(from: &mut impl BufRead, is: impl Fn(&Value) -> bool) -> Value {
    loop {
        let mut line = String::new();
        assert!(from.read_line(&mut line).unwrap() > 0, "the port is closed");
        let line: Value = serde_json::from_str(&line).unwrap();
        if is(&line) {
            return line;
        }
    }
}

/// A library that takes the place of a part of the C library in one process; `None`, and a word about it, without a
/// C compiler.
pub fn shim(folder: &Path, source: &str) -> Option<PathBuf> {
    let library = folder.join("shim.so");
    let mut compiler = Command::new("cc");
    compiler.args(["-shared", "-fPIC", "-O1", "-o"]);
    match compiler.arg(&library).args([source, "-ldl"]).output() {
        Ok(output) => {
            assert_code(&output, 0);
            Some(library)
        }
        Err(error) => {
            skipped(&format!("there is no C compiler 'cc': {error}"));
            None
        }
    }
}

/// The records of a log.
pub fn records(log: &str) -> Vec<Value> {
    log.lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect()
}

/// Replaces texts in a robot's configuration.
pub fn edit(config: &str, changes: &[(&str, &str)]) {
    let mut text = std::fs::read_to_string(config).unwrap();
    for (from, to) in changes {
        assert!(text.contains(from), "'{from}' is not in:\n{text}");
        text = text.replace(from, to);
    }
    std::fs::write(config, text).unwrap();
}

/// What happened in a log, with the time by the machine's clock in ms: the outputs of steps, and their
/// inputs under the key `input`.
pub fn happenings(log: &str) -> Vec<(f64, Value)> {
    let records = records(log);
    let started = &records[0];
    let zero_ms = started["unixMs"].as_f64().unwrap() - started["atUs"].as_f64().unwrap() / 1e3;
    let mut happenings = Vec::new();
    for record in &records {
        let at_ms = zero_ms + record["atUs"].as_f64().unwrap() / 1e3;
        if let Some(input) = record.get("input") {
            happenings.push((at_ms, serde_json::json!({ "input": input })));
        }
        for output in record["outputs"].as_array().into_iter().flatten() {
            happenings.push((at_ms, output.clone()));
        }
    }
    happenings
}

/// When something happened first.
pub fn first(happenings: &[(f64, Value)], is: impl Fn(&Value) -> bool) -> Option<f64> {
    let found = happenings.iter().find(|(_, what)| is(what));
    found.map(|(at_ms, _)| *at_ms)
}
