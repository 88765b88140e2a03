//! A wall clock that is put forward or back by an hour while the robots cross. Timers do not notice; what
//! is signed is not believed while clocks differ, and is again when they agree.

use std::fs::{self, File};
use std::io::Write;
use std::os::unix::fs::FileExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use crossguard_testkit::command::*;

/// Drops of packets by their time, in a log.
const FUTURE: &str = r#""layer":"security","cause":"from the future""#;
const OLD: &str = r#""layer":"security","cause":"too old""#;
const NOT_TRUSTED: &str = r#""layer":"security","cause":"time not trusted""#;

const PATIENCE: Duration = Duration::from_mins(1);

const HOUR: i64 = 3_600;

/// The C compiler's `clock_gettime` for one process; `None`, and a word about it, without a compiler.
fn shim(folder: &Path, test: &str) -> Option<PathBuf> {
    let source = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/clock/step.c");
    let library = folder.join("step.so");
    let compiled = Command::new("cc")
        .args(["-shared", "-fPIC", "-O1", "-o"])
        .arg(&library)
        .arg(source)
        .output();
    match compiled {
        Ok(output) if output.status.success() => Some(library),
        Ok(output) => panic!("{}", stderr(&output)),
        Err(error) => {
            // Not by eprintln!, which the test runner would capture.
            let _ = writeln!(
                std::io::stderr(),
                "SKIPPED {test}: there is no C compiler 'cc': {error}"
            );
            None
        }
    }
}

/// A wall clock that only one process has.
struct WallClock {
    library: PathBuf,
    file: PathBuf,
}

impl WallClock {
    fn new(folder: &Path, library: PathBuf) -> Self {
        let file = folder.join("step");
        fs::write(&file, 0_i64.to_ne_bytes()).unwrap();
        Self { library, file }
    }

    /// Puts the clock so far ahead of the true one.
    fn set(&self, ahead_s: i64) {
        let file = File::options().write(true).open(&self.file).unwrap();
        file.write_all_at(&ahead_s.to_ne_bytes(), 0).unwrap();
    }

    /// The command, with this clock.
    fn rules(&self, mut command: Command) -> Command {
        command
            .env("LD_PRELOAD", &self.library)
            .env("CLOCK_STEP_FILE", &self.file);
        command
    }
}

/// [`start`] with more arguments, and perhaps with another wall clock.
fn start_with(config: &str, more: &[&str], clock: Option<&WallClock>) -> Child {
    let log = File::create(Path::new(config).with_extension("log")).unwrap();
    let mut command = crossguard(&["run", "--config", config, "--json"]);
    command.args(more);
    if let Some(clock) = clock {
        command = clock.rules(command);
    }
    command
        .stdin(Stdio::piped())
        .stdout(log)
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

/// Robots that take about 6 s for a crossing.
fn robots(folder: &Path) -> [String; 2] {
    let port = two_free_ports();
    let configs = [("ARI", 1, port, port + 1), ("Go2", 2, port + 1, port)];
    configs.map(|(name, station, port, peer)| {
        let path = robot_file(folder, name, station, port, peer);
        let text = fs::read_to_string(&path).unwrap();
        fs::write(&path, text.replace("speed = 40.0", "speed = 5.0")).unwrap();
        path
    })
}

fn quit(robots: [Child; 2]) {
    for mut robot in robots {
        type_to(&mut robot, "until idle 30\nquit\n");
        assert_eq!(wait_for(&mut robot, PATIENCE).code(), Some(0));
    }
}

fn assert_valid(configs: &[String; 2]) {
    let logs = configs.each_ref().map(|config| {
        let log = Path::new(config).with_extension("log");
        log.display().to_string()
    });
    let output = run(&["validate", &logs[0], &logs[1]]);
    assert_eq!(output.status.code(), Some(0), "{}", stdout(&output));
}

#[test]
fn without_security_a_crossing_goes_on_whatever_the_wall_clock_says() {
    let test = "without_security_a_crossing_goes_on_whatever_the_wall_clock_says";
    let folder = tempfile::tempdir().unwrap();
    let Some(library) = shim(folder.path(), test) else {
        return;
    };
    let clock = WallClock::new(folder.path(), library);
    let configs = robots(folder.path());
    let mut robots = [
        start_with(&configs[0], &[], Some(&clock)),
        start(&configs[1]),
    ];
    type_to(
        &mut robots[0],
        "wait 0.3\ndetect\nuntil maneuver-executing 20\n",
    );
    std::thread::sleep(Duration::from_millis(1_500));
    for ahead_s in [HOUR, -HOUR, 0] {
        clock.set(ahead_s);
        std::thread::sleep(Duration::from_secs(1));
    }
    quit(robots);
    assert!(log_of(&configs[0]).contains("\"taskCompleted\""));
    assert!(!log_of(&configs[1]).contains("fallBack"));
    assert_valid(&configs);
}

/// ARI's clock is put so far ahead in the middle of a crossing with signed packets, and back.
fn step_with_security(ahead_s: i64, library: &Path) {
    let folder = tempfile::tempdir().unwrap();
    let clock = WallClock::new(folder.path(), library.to_owned());
    let configs = robots(folder.path());
    let pki = folder.path().join("pki");
    let pki = pki.to_str().unwrap();
    // Made two hours ago, so that certificates are valid whatever the clock says here.
    clock.set(-2 * HOUR);
    let init = clock
        .rules(crossguard(&["pki", "init", pki]))
        .output()
        .unwrap();
    assert_eq!(init.status.code(), Some(0), "{}", stderr(&init));
    clock.set(0);
    let security = ["--security", "enforce", "--pki", pki];
    let mut robots = [
        start_with(&configs[0], &security, Some(&clock)),
        start_with(&configs[1], &security, None),
    ];
    type_to(
        &mut robots[0],
        "wait 0.5\ndetect\nuntil maneuver-executing 20\n",
    );
    std::thread::sleep(Duration::from_millis(2_500));
    clock.set(ahead_s);
    // Neither believes the other any more, so each comes to rest by itself, as when it hears nothing.
    type_to(&mut robots[0], "until idle 20\nwait 1\n");
    type_to(&mut robots[1], "until idle 20\nclear\n");
    std::thread::sleep(Duration::from_millis(9_500));
    clock.set(0);
    type_to(&mut robots[0], "detect\nuntil maneuver-executing 20\n");
    quit(robots);
    let [ari, go2] = configs.each_ref().map(|config| log_of(config));
    let by_go2 = if ahead_s > 0 { FUTURE } else { OLD };
    assert!(go2.contains(by_go2), "{by_go2}");
    assert!(ari.contains(NOT_TRUSTED));
    // It says so, and says when it trusts its clock again.
    let clocks: Vec<_> = ari
        .lines()
        .filter(|line| line.contains("\"clock\""))
        .collect();
    let told = clocks.iter().map(|line| line.contains("\"trusted\""));
    assert_eq!(told.collect::<Vec<_>>(), [true, false, true], "{clocks:?}");
    for expected in ["leaseExpired", "\"noFollowers\"", "\"taskCompleted\""] {
        assert!(ari.contains(expected), "{expected}");
    }
    for expected in ["fallBack", "\"contactLost\"", "\"taskCompleted\""] {
        assert!(go2.contains(expected), "{expected}");
    }
    assert_valid(&configs);
}

#[test]
fn with_security_robots_whose_clocks_differ_come_to_rest_and_cross_when_they_agree() {
    let test = "with_security_robots_whose_clocks_differ_come_to_rest_and_cross_when_they_agree";
    let folder = tempfile::tempdir().unwrap();
    let Some(library) = shim(folder.path(), test) else {
        return;
    };
    std::thread::scope(|scope| {
        for ahead_s in [HOUR, -HOUR] {
            let library = &library;
            scope.spawn(move || step_with_security(ahead_s, library));
        }
    });
}

/// A robot remembers what time it was, over a restart with a clock that was put back meanwhile.
#[test]
fn a_robot_that_is_started_with_an_older_clock_does_not_trust_it_and_says_so() {
    let test = "a_robot_that_is_started_with_an_older_clock_does_not_trust_it_and_says_so";
    let folder = tempfile::tempdir().unwrap();
    let Some(library) = shim(folder.path(), test) else {
        return;
    };
    let clock = WallClock::new(folder.path(), library);
    let [config, _] = robots(folder.path());
    let pki = folder.path().join("pki");
    let pki = pki.to_str().unwrap();
    clock.set(-2 * HOUR);
    let init = clock.rules(crossguard(&["pki", "init", pki])).output();
    assert_eq!(init.unwrap().status.code(), Some(0));
    let run_once = |ahead_s: i64| {
        clock.set(ahead_s);
        let arguments = [
            "run",
            "--config",
            &config,
            "--security",
            "enforce",
            "--pki",
            pki,
        ];
        let mut robot = clock
            .rules(crossguard(&arguments))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        type_to(&mut robot, "wait 0.3\nstatus\nquit\n");
        stdout(&robot.wait_with_output().unwrap())
    };
    let said = run_once(0);
    assert!(!said.contains("time not trusted"), "{said}");
    let said = run_once(-HOUR);
    let told = said.matches("time not trusted: the clock is 3").count();
    assert!(told >= 2, "at once, and in the status: {said}");
    assert!(said.contains(".time"), "it says what to do: {said}");
    let said = run_once(10);
    assert!(!said.contains("time not trusted"), "{said}");
}
