//! Two robots as processes on the loopback interface: ARI, which asks for help, and Go2.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use crossguard_judge::validate;
use crossguard_robot::trace;
use crossguard_testkit::command::*;
use serde_json::Value;
use tempfile::TempDir;

pub(crate) const PATIENCE: Duration = Duration::from_mins(1);

pub(crate) const ARI: usize = 0;
pub(crate) const GO2: usize = 1;

/// By how much the times of two logs may differ on a busy machine.
pub(crate) const CLOCKS_MS: f64 = 20.0;

/// Lines for ARI for a crossing by its autopilot.
pub(crate) const CROSS: &str = "wait 0.5\ndetect\nuntil maneuver-executing 30\nuntil idle 30\n";

pub(crate) struct Street {
    pub(crate) folder: TempDir,
    pub(crate) configs: [String; 2],
    pub(crate) robots: Vec<Killed>,
    /// Logs of robots before they were booted again.
    before: Vec<(usize, PathBuf)>,
}

impl Street {
    /// Their files, with these changes in both.
    pub(crate) fn new(changes: &[(&str, &str)]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let port = two_free_ports();
        let configs = [("ARI", 1, port, port + 1), ("Go2", 2, port + 1, port)];
        let configs = configs.map(|(name, station, port, peer)| {
            let config = robot_file(folder.path(), name, station, port, peer);
            edit(&config, changes);
            config
        });
        Self {
            folder,
            configs,
            robots: Vec::new(),
            before: Vec::new(),
        }
    }

    /// Both run, with these changes in their files.
    pub(crate) fn started(changes: &[(&str, &str)]) -> Self {
        let mut street = Self::new(changes);
        street.start(&[]);
        street
    }

    /// Gives a robot this link instead of its own.
    pub(crate) fn link(&self, robot: usize, link: &str) {
        let text = fs::read_to_string(&self.configs[robot]).unwrap();
        let (before, _) = text.split_once("[link]").unwrap();
        let text = format!("{before}[link]\n{link}\n");
        fs::write(&self.configs[robot], text).unwrap();
    }

    /// Starts both, with these arguments.
    pub(crate) fn start(&mut self, arguments: &[&str]) {
        let starts = self.configs.iter().map(|it| start_with(it, arguments));
        self.robots = starts.map(Killed).collect();
    }

    pub(crate) fn path(&self, name: &str) -> String {
        self.folder.path().join(name).display().to_string()
    }

    pub(crate) fn say(&mut self, robot: usize, lines: &str) {
        type_to(&mut self.robots[robot].0, lines);
    }

    pub(crate) fn signal(&self, robot: usize, name: &str) {
        signal(&self.robots[robot].0, name);
    }

    pub(crate) fn log(&self, robot: usize) -> String {
        log_of(&self.configs[robot])
    }

    /// Waits until the log of a robot has this.
    pub(crate) fn until(&self, robot: usize, what: &str) {
        let deadline = Instant::now() + PATIENCE;
        while !self.log(robot).contains(what) {
            let log = self.log(robot);
            assert!(Instant::now() < deadline, "no '{what}' in:\n{log}");
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// Boots a robot again that was killed.
    pub(crate) fn boot(&mut self, robot: usize) {
        let _ = self.robots[robot].0.wait();
        let config = &self.configs[robot];
        let before = self.folder.path().join("before.log");
        fs::rename(Path::new(config).with_extension("log"), &before).unwrap();
        self.before.push((robot, before));
        self.robots[robot] = Killed(start(config));
    }

    /// The log of a robot before it was booted again, or the only one.
    pub(crate) fn first_log(&self, robot: usize) -> String {
        let before = self.before.iter().find(|(it, _)| *it == robot);
        let Some((_, log)) = before else {
            return self.log(robot);
        };
        // It may have been killed in the middle of a line.
        let text = fs::read_to_string(log).unwrap();
        text.rsplit_once('\n').unwrap().0.to_owned()
    }

    /// Ends the robots in order.
    pub(crate) fn quit(&mut self) {
        for robot in &mut self.robots {
            // One that was told to stop hears nothing any more.
            let input = robot.0.stdin.as_mut().unwrap();
            let _ = input.write_all(b"until idle 30\nquit\n");
        }
        for robot in &mut self.robots {
            assert_eq!(wait_for(&mut robot.0, PATIENCE).code(), Some(0));
        }
    }

    /// Ends the robots in order. Their logs, which are valid together.
    pub(crate) fn end(&mut self) -> [Vec<Value>; 2] {
        self.quit();
        let logs = (self.configs.iter()).map(|it| Path::new(it).with_extension("log"));
        assert_valid(logs.chain(self.before.iter().map(|(_, log)| log.clone())));
        [ARI, GO2].map(|robot| records(&self.log(robot)))
    }
}

/// When the sign of the first session ended, at the latest, as people saw it.
pub(crate) fn sign_ended_ms(leader: &[(f64, Value)]) -> f64 {
    let mut ends_ms = f64::NAN;
    for (at_ms, it) in leader {
        if let Some(lasts) = it.get("corridorOpened").or(it.get("corridorExtended")) {
            ends_ms = at_ms + lasts.as_f64().unwrap();
        } else if it.get("corridorClosed").is_some() {
            return ends_ms.min(*at_ms);
        }
    }
    ends_ms
}

/// How often a robot counted a cause of a layer, by its last record.
pub(crate) fn counted(log: &[Value], layer: &str, cause: &str) -> u64 {
    let count = &log.last().unwrap()["counters"][layer][cause];
    count.as_u64().unwrap_or_default()
}

/// Asserts that logs are of something that could have happened.
pub(crate) fn assert_valid(logs: impl Iterator<Item = PathBuf>) {
    let logs: Vec<_> = logs.map(|it| trace::open(&it).unwrap()).collect();
    let validated = validate::all(logs);
    assert!(validated.is_ok(), "{}", validated.unwrap_err());
}

/// Runs each row of a table in a thread of its own: they wait more than they compute.
pub(crate) fn side_by_side<T: Sync>(rows: &[T], run: impl Fn(&T) + Sync) {
    std::thread::scope(|scope| {
        for row in rows {
            scope.spawn(|| run(row));
        }
    });
}
