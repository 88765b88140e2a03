//! `crossguard run --all`: each robot of a folder as a process of its own, on one terminal.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::Ordering;

use crossguard_robot::files;
use crossguard_robot::robot_file::{Besides, RobotFile};

use super::super::Failure;
use super::super::interrupts::interrupts;
use super::super::writing::complain;
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
    let wrong = |why: &str| Err(Failure::Input(format!("{}: {why}", folder.display())));
    if robots.is_empty() {
        return wrong("no robot file is here; 'crossguard new' makes a folder with two");
    }
    for (nth, (path, file)) in robots.iter().enumerate() {
        let name = |file: &RobotFile| file.name.to_lowercase();
        for (other_path, other) in &robots[..nth] {
            let same = if other.station == file.station {
                format!("station {}", file.station)
            } else if name(other) == name(file) {
                format!("the name {}", file.name)
            } else {
                continue;
            };
            let (one, two) = (other_path.display(), path.display());
            return wrong(&format!(
                "{one} and {two} both have {same}; give each robot its own"
            ));
        }
    }
    Ok(robots)
}

/// The people of the folder, if there are some.
fn people(folder: &Path) -> Result<Option<PathBuf>, Failure> {
    let people = folder.join("people.jsonl");
    if people.symlink_metadata().is_err() {
        return Ok(None);
    }
    // A link may lead nowhere.
    people.metadata().map_err(Failure::at(&people))?;
    Ok(Some(people))
}

/// Starts a robot, with its log beside its file and the names of all. One with a crossing zone sees the people.
fn start(
    path: &Path,
    file: &RobotFile,
    named: &[String],
    people: Option<&Path>,
) -> Result<OfFolder, Failure> {
    let mut command = Command::new(std::env::current_exe()?);
    command.arg("run").arg("--config").arg(path);
    let log = path.with_extension("jsonl");
    command.args(named).arg("--log").arg(log);
    if let Some(people) = people.filter(|_| file.zone.is_some()) {
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
    let people = people(folder)?;
    let started = files
        .iter()
        .map(|(path, file)| start(path, file, &named, people.as_deref()));
    let mut robots = started.collect::<Result<Vec<_>, _>>()?;
    let (mut lines, mut is_ending, mut failed) = (typed::lines(), false, false);
    let mut script = Ok(());
    while robots.iter().any(|robot| !robot.has_ended) {
        if let Some(line) = lines.next() {
            let robot_names = files.iter().map(|(_, file)| &*file.name);
            let (to, command) = typed::addressed(&line, robot_names);
            // A line with a meaning has one for all robots. A robot is told nothing else: it takes its pipe for a script.
            match lines.understood(command, &files[to.unwrap_or(0)].1) {
                Ok(Ok(_)) => {
                    let told = robots.iter_mut().enumerate();
                    let told = told.filter(|(nth, _)| to.is_none_or(|to| to == *nth));
                    told.for_each(|(_, robot)| robot.tell(command));
                }
                Ok(Err(mistake)) => complain(mistake),
                Err(wrong) => script = Err(wrong),
            }
        }
        let ends = interrupted.load(Ordering::Relaxed) || script.is_err();
        if ends && !std::mem::replace(&mut is_ending, true) {
            for robot in &mut robots {
                robot.tell("quit");
            }
        }
        for robot in &mut robots {
            failed |= robot.fails()?;
        }
        std::thread::sleep(TICK);
    }
    if failed {
        script = script.and(Err(Failure::Wrong));
    }
    script
}

#[cfg(test)]
mod tests {
    use std::fs::write;
    use std::os::unix::fs::symlink;

    use super::*;

    /// Two robots by name and station, and what is said of them.
    const ROBOTS: [([(&str, u32); 2], &str); 3] = [
        ([("ARI", 1), ("Go2", 1)], "both have station 1"),
        ([("go2", 1), ("Go2", 2)], "both have the name Go2"),
        ([("ARI", 1), ("Go2", 2)], ""),
    ];

    #[test]
    fn files_that_contradict_each_other_are_refused_before_a_robot_starts() {
        for (robots, cause) in ROBOTS {
            let folder = tempfile::tempdir().unwrap();
            for (nth, (name, station)) in robots.iter().enumerate() {
                let text = format!(
                    "name = \"{name}\"\nstation = {station}\nbuild = \"quadruped\"\nboot_file = \"{nth}.boot\"\n\
                     [link]\naddress = \"127.0.0.1:0\"\npeers = []\n"
                );
                write(folder.path().join(format!("{nth}.toml")), text).unwrap();
            }
            match robot_files(folder.path()) {
                Ok(files) => assert_eq!((files.len(), cause), (2, "")),
                Err(Failure::Input(said)) => {
                    assert!(said.contains(cause) && !cause.is_empty(), "{said}");
                }
                Err(other) => panic!("{other:?}"),
            }
        }
    }

    #[test]
    fn people_that_a_link_has_lost_are_not_taken_for_nobody() {
        let folder = tempfile::tempdir().unwrap();
        assert_eq!(people(folder.path()).unwrap(), None);
        let file = folder.path().join("people.jsonl");
        symlink("gone", &file).unwrap();
        assert!(matches!(people(folder.path()), Err(Failure::Input(_))));
        write(folder.path().join("gone"), "").unwrap();
        assert_eq!(people(folder.path()).unwrap(), Some(file));
    }
}
