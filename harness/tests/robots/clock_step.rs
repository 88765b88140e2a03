//! A wall clock that is put forward or back by an hour while the robots cross. Timers do not notice; what is signed is
//! not believed while clocks differ, and is again when they agree.

use std::fs::File;
use std::os::unix::fs::FileExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;

use crossguard_testkit::command::*;

use crate::street::{ARI, GO2, Street};

const HOUR: i64 = 3_600;

/// A wall clock that only one process has.
pub(crate) struct WallClock {
    library: PathBuf,
    file: PathBuf,
}

impl WallClock {
    /// One that shows the true time, of a robot on the street.
    pub(crate) fn of(street: &Street, library: &Path) -> Self {
        let clock = Self {
            library: library.to_owned(),
            file: street.path("step").into(),
        };
        clock.set(0);
        clock
    }

    /// Puts the clock so far ahead of the true one; `i64::MIN` takes it away, and who looks at it panics.
    pub(crate) fn set(&self, ahead_s: i64) {
        let mut file = File::options();
        let file = file
            .write(true)
            .create(true)
            .truncate(false)
            .open(&self.file)
            .unwrap();
        file.write_all_at(&ahead_s.to_ne_bytes(), 0).unwrap();
    }

    fn rules(&self, mut command: Command) -> Command {
        command.env("LD_PRELOAD", &self.library);
        command.env("CLOCK_STEP_FILE", &self.file);
        command
    }

    /// ARI, with this clock and a log.
    pub(crate) fn ari(&self, street: &Street) -> Command {
        let log = File::create(street.path("ARI.log")).unwrap();
        let run = ["run", "--config", &street.configs[ARI], "--json"];
        let mut ari = self.rules(crossguard(&run));
        ari.stdin(Stdio::piped()).stdout(log).stderr(Stdio::null());
        ari
    }
}

/// Robots that cross, and ARI's clock. Certificates are of two hours ago, so that they are valid whatever it says.
fn crossing(library: &Path, is_signed: bool) -> (Street, WallClock) {
    let mut street = Street::new(&[("speed = 40.0", "speed = 5.0")]);
    let clock = WallClock::of(&street, library);
    let pki = street.path("pki");
    clock.set(-2 * HOUR);
    let mut init = clock.rules(crossguard(&["pki", "init", &pki]));
    assert!(init.output().unwrap().status.success());
    clock.set(0);
    let security = ["--security", "enforce", "--pki", &pki];
    let security = if is_signed { &security[..] } else { &[] };
    let ari = clock.ari(&street).args(security).spawn();
    street.robots = vec![
        Killed(ari.unwrap()),
        Killed(start_with(&street.configs[GO2], security)),
    ];
    street.say(ARI, "wait 0.5\ndetect\n");
    street.until(ARI, "\"corridorOpened\"");
    (street, clock)
}

/// ARI's clock is put so far ahead, and back.
fn step(ahead_s: i64, library: &Path) {
    let (mut street, clock) = crossing(library, true);
    clock.set(ahead_s);
    // Neither believes the other any more, so each comes to rest by itself, as when it hears nothing.
    street.until(ARI, "\"noFollowers\"");
    street.until(GO2, "\"contactLost\"");
    street.say(GO2, "until idle 20\nclear\n");
    // The leader asks nobody before the road is clear.
    std::thread::sleep(Duration::from_secs(3));
    clock.set(0);
    street.say(ARI, "until idle 20\nwait 1\ndetect\n");
    street.until(ARI, "\"taskCompleted\"");
    street.end();
    let by_go2 = if ahead_s > 0 {
        "from the future"
    } else {
        "too old"
    };
    let rejected = |cause: &str| format!("\"layer\":\"security\",\"cause\":\"{cause}\"");
    let logs = [ARI, GO2].map(|robot| street.log(robot));
    for (robot, expected) in [
        (GO2, &*rejected(by_go2)),
        (ARI, &rejected("time not trusted")),
        (ARI, "leaseExpired"),
        (GO2, "fallBack"),
        (GO2, "\"taskCompleted\""),
    ] {
        assert!(logs[robot].contains(expected), "{expected}");
    }
    // It says so, and says when it trusts its clock again.
    let clocks = logs[ARI].lines().filter(|line| line.contains("\"clock\""));
    let told = clocks.map(|line| line.contains("\"trusted\""));
    assert_eq!(told.collect::<Vec<_>>(), [true, false, true]);
}

#[test]
fn robots_whose_clocks_differ_come_to_rest_where_they_sign_and_cross_where_they_do_not() {
    let folder = tempfile::tempdir().unwrap();
    let Some(library) = shim(folder.path(), "tests/clock/step.c") else {
        return;
    };
    std::thread::scope(|scope| {
        for ahead_s in [HOUR, -HOUR] {
            let library = &library;
            scope.spawn(move || step(ahead_s, library));
        }
        let (mut street, clock) = crossing(&library, false);
        for ahead_s in [HOUR, -HOUR, 0] {
            clock.set(ahead_s);
            std::thread::sleep(Duration::from_millis(300));
        }
        street.until(GO2, "\"taskCompleted\"");
        street.end();
        assert!(!street.log(GO2).contains("fallBack"));
    });
}
