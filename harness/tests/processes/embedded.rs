//! A robot in C (`harness/c/examples/robot.c`) and robots of `crossguard run`, as processes of their own, lead and follow each
//! other through a crossing.

use std::fs::File;
use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::process::{Child, Command};
use std::time::Duration;

use crossguard_judge::validate::{self, Log, Validated};
use crossguard_testkit::c::{Language, compile};
use crossguard_testkit::command::*;

const PATIENCE: Duration = Duration::from_mins(1);

/// A robot in another language, in its own folder and process.
struct Embedded {
    child: Child,
    folder: PathBuf,
}

impl Embedded {
    fn start(
        program: &Path,
        folder: &Path,
        role: &str,
        station: u32,
        port: u16,
        peer: u16,
    ) -> Self {
        let child = Command::new(program)
            .args([role, &station.to_string()])
            .args([port, peer].map(|it| it.to_string()))
            .arg(folder.join("embedded.boot"))
            .arg(folder.join("embedded.log"))
            .stdout(File::create(folder.join("embedded.out")).unwrap())
            .stderr(File::create(folder.join("embedded.err")).unwrap())
            .spawn()
            .unwrap();
        let folder = folder.to_owned();
        Self { child, folder }
    }

    fn said(&self, file: &str) -> String {
        std::fs::read_to_string(self.folder.join(file)).unwrap()
    }

    /// Waits until it has ended by itself, the crossing being completed.
    fn finish(&mut self) -> String {
        let status = wait_for(&mut self.child, PATIENCE);
        let (said, errors) = (self.said("embedded.out"), self.said("embedded.err"));
        assert_eq!(status.code(), Some(0), "{said}{errors}");
        assert!(said.ends_with("crossing completed\n"), "{said}");
        // Findings of a sanitizer stand here.
        assert_eq!(errors, "");
        self.said("embedded.log")
    }
}

fn validated(logs: &[(&str, &str)]) -> Validated {
    let log = |&(name, lines): &(&str, &str)| Log::new(name, Cursor::new(lines.to_owned()));
    let outcome = validate::all(logs.iter().map(log).collect());
    outcome.unwrap_or_else(|invalid| panic!("{invalid}"))
}

/// The log of a robot in another language is whole, and so are all of them together.
fn assert_valid(embedded: &str, rust: &str) {
    let alone = validated(&[("embedded", embedded)]);
    assert!(alone.steps > 50 && alone.sent > 10, "{alone:?}");
    assert_eq!((alone.missing, alone.cut_off.len()), (0, 0), "{alone:?}");
    let together = validated(&[("embedded", embedded), ("rust", rust)]);
    let heard = (together.robots, together.from_strangers);
    assert_eq!(heard, (2, 0), "{together:?}");
    for property in ["I2", "I3", "I6", "I8", "I11"] {
        let is_judged = together.properties.iter().any(|id| id == property);
        assert!(is_judged, "{together:?}");
    }
}

fn leads(program: &Path) {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let go2 = robot_file(folder.path(), "Go2", 2, port + 1, port);
    let mut dog = start(&go2);
    let mut leader = Embedded::start(program, folder.path(), "leader", 1, port, port + 1);
    let log = leader.finish();
    assert!(leader.said("embedded.out").contains("corridor open\n"));
    quit(&mut dog);
    assert_valid(&log, &log_of(&go2));
}

fn follows(program: &Path) {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let ari = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let mut follower = Embedded::start(program, folder.path(), "follower", 2, port + 1, port);
    let mut humanoid = start(&ari);
    let script = "wait 0.3\ndetect\nuntil maneuver-executing\nuntil idle\nquit\n";
    type_to(&mut humanoid, script);
    assert_eq!(wait_for(&mut humanoid, PATIENCE).code(), Some(0));
    let log = follower.finish();
    // Where the leader wants it to go came over as well.
    log.must_have(&["\"startManeuver\""]);
    assert_valid(&log, &log_of(&ari));
    // The command line tool says the same.
    let path = folder.path().join("embedded.log");
    run_well(&format!("validate {}", path.display()));
}

#[test]
fn a_robot_in_c_leads_and_follows() {
    if let Some(program) = compile("crossing", Language::C, "examples/robot.c") {
        leads(&program);
        follows(&program);
    }
}
