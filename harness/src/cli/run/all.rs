//! `crossguard run --all`: each robot of a folder as a process of its own, on one terminal.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::Ordering;

use crossguard_robot::files;
use crossguard_robot::robot_file::{Besides, RobotFile};

use super::super::interrupts::interrupts;
use super::super::{Failure, complain};
use super::{TICK, typed};

/// A robot, and its process while it runs.
struct OfFolder {
    name: String,
    process: Child,
    has_ended: bool,
}

/// The robot files of a folder. A file with a `station` is one.
fn robot_files(folder: &Path) -> Result<Vec<(PathBuf, RobotFile)>, Failure> {
    let entries = std::fs::read_dir(folder).map_err(Failure::at(folder))?;
    let mut paths: Vec<_> = entries.filter_map(|it| Some(it.ok()?.path())).collect();
    paths.retain(|path| path.extension().is_some_and(|it| it == "toml"));
    paths.sort();
    let mut robots = Vec::new();
    for path in paths {
        let text = files::text(&path, files::TEXT_MAX).map_err(Failure::at(&path))?;
        let table: toml::Table = text.parse().map_err(Failure::at(&path))?;
        if table.contains_key("station") {
            let file =
                RobotFile::parse(&path, &text, Besides::default()).map_err(Failure::input)?;
            robots.push((path, file));
        }
    }
    if robots.is_empty() {
        return Err(Failure::Input(format!(
            "{}: no robot file is here; 'crossguard new' makes a folder with two",
            folder.display()
        )));
    }
    Ok(robots)
}

/// Starts a robot, with its log beside its file and the names of all. One with a crossing zone sees the people of `people.jsonl`, if there are some.
fn start(path: &Path, file: &RobotFile, named: &[String]) -> Result<OfFolder, Failure> {
    let mut command = Command::new(std::env::current_exe()?);
    command.arg("run").arg("--config").arg(path);
    command
        .args(named)
        .args(["--status", "never", "--log"])
        .arg(path.with_extension("jsonl"));
    let people = path.with_file_name("people.jsonl");
    if file.zone.is_some() && people.exists() {
        command.arg("--perceived").arg(people);
    }
    let process = command.stdin(Stdio::piped()).spawn();
    Ok(OfFolder {
        name: file.name.clone(),
        process: process.map_err(Failure::at(path))?,
        has_ended: false,
    })
}

impl OfFolder {
    /// Types a line. A robot that has ended does not hear it.
    fn tell(&mut self, line: &str) {
        if let Some(keys) = &mut self.process.stdin {
            let _ = writeln!(keys, "{line}");
        }
    }

    /// Whether it ended since it was looked at last, and otherwise than in order.
    fn fails(&mut self) -> Result<bool, Failure> {
        let Some(status) = self.process.try_wait()?.filter(|_| !self.has_ended) else {
            return Ok(false);
        };
        self.has_ended = true;
        if !status.success() {
            complain(format_args!("{} is gone: {status}", self.name));
        }
        Ok(!status.success())
    }
}

/// Runs the robots until all have ended. The others go on when one is gone, as they would on the street.
pub(super) fn run(folder: &Path) -> Result<(), Failure> {
    let interrupted = interrupts();
    let files = robot_files(folder)?;
    let named = |file: &RobotFile| format!("--named={}={}", file.station, file.name);
    let named: Vec<_> = files.iter().map(|(_, file)| named(file)).collect();
    let started = files.iter().map(|(path, file)| start(path, file, &named));
    let mut robots = started.collect::<Result<Vec<_>, _>>()?;
    let (lines, mut is_ending, mut failed) = (typed::lines(), false, false);
    while robots.iter().any(|robot| !robot.has_ended) {
        if let Ok(line) = lines.try_recv() {
            // For one of them, or for all.
            let (name, command) = line.split_once(' ').unwrap_or_default();
            match robots.iter_mut().find(|robot| robot.name == name) {
                Some(robot) => robot.tell(command),
                None => robots.iter_mut().for_each(|robot| robot.tell(&line)),
            }
        }
        if interrupted.load(Ordering::Relaxed) && !std::mem::replace(&mut is_ending, true) {
            for robot in &mut robots {
                robot.tell("quit");
            }
        }
        for robot in &mut robots {
            failed |= robot.fails()?;
        }
        std::thread::sleep(TICK);
    }
    if failed { Err(Failure::Wrong) } else { Ok(()) }
}
