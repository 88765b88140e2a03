//! `crossguard run` on a terminal of 80 and of 120 columns: what is typed stays readable while lines and the status line
//! come, and is edited as people expect it; and whatever is typed or shown, Ctrl-C and a signal stop the robot in order.

use std::fs::File;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use crossguard_testkit::command::*;
use nix::pty::{Winsize, openpty};
use nix::sys::termios::{LocalFlags, tcgetattr};
use vt100::Parser;

const PATIENCE: Duration = Duration::from_mins(1);
const ROWS: u16 = 30;

/// A robot on a terminal, as a person sees it.
struct Terminal {
    program: Killed,
    log: PathBuf,
    keys: File,
    seen: Arc<Mutex<Parser>>,
    /// Whether somebody reads what is shown.
    is_read: Arc<AtomicBool>,
    columns: u16,
}

impl Terminal {
    /// A robot that runs on a terminal of this width.
    fn of(config: &str, columns: u16) -> Self {
        let size = Winsize {
            ws_row: ROWS,
            ws_col: columns,
            ws_xpixel: 0,
            ws_ypixel: 0,
        };
        let pair = openpty(Some(&size), None).unwrap();
        let log = Path::new(config).with_extension("log");
        let program = crossguard(&["run", "--config", config]);
        let slave = || pair.slave.try_clone().unwrap();
        // In a session of its own, of which this is the terminal: so Ctrl-C reaches it.
        let child = Command::new("setsid")
            .arg("--ctty")
            .arg(program.get_program())
            .args(program.get_args())
            .arg("--log")
            .arg(&log)
            .env("TERM", "xterm-256color")
            .stdin(slave())
            .stdout(slave())
            .stderr(slave())
            .spawn()
            .unwrap();
        drop(pair.slave);
        let size = |number: u16| number.try_into().unwrap();
        let parser = Parser::new(size(ROWS), size(columns), 0);
        let seen = Arc::new(Mutex::new(parser));
        let mut output = File::from(pair.master.try_clone().unwrap());
        let screen = Arc::clone(&seen);
        let is_read = Arc::new(AtomicBool::new(true));
        let is_wanted = Arc::clone(&is_read);
        std::thread::spawn(move || {
            let mut buffer = [0; 4_096];
            // It ends with an error where the other side is gone.
            while let Ok(read @ 1..) = output.read(&mut buffer) {
                while !is_wanted.load(Ordering::Relaxed) {
                    std::thread::sleep(Duration::from_millis(10));
                }
                let mut screen = screen.lock().unwrap_or_else(PoisonError::into_inner);
                screen.process(&buffer[..read]);
            }
        });
        Self {
            program: Killed(child),
            log,
            keys: File::from(pair.master),
            seen,
            is_read,
            columns,
        }
    }

    fn press(&mut self, keys: &str) {
        self.keys.write_all(keys.as_bytes()).unwrap();
    }

    fn rows(&self) -> Vec<String> {
        let seen = self.seen.lock().unwrap_or_else(PoisonError::into_inner);
        let rows = seen.screen().rows(0, self.columns);
        rows.map(|row| row.trim_end().to_owned()).collect()
    }

    /// Waits until the screen is as it should be.
    fn wait(&self, what: &str, is: impl Fn(&[String]) -> bool) {
        let deadline = Instant::now() + PATIENCE;
        loop {
            let rows = self.rows();
            if is(&rows) {
                return;
            }
            let shown = rows.join("\n");
            assert!(Instant::now() < deadline, "not seen: {what}\n{shown}");
            std::thread::sleep(Duration::from_millis(10));
        }
    }

    /// Waits until the line that is typed is this, below a status line, and nothing is below it.
    fn wait_for_line(&self, line: &str) {
        self.wait(&format!("'{line}'"), |rows| typed(rows) == Some(line));
    }

    /// Waits until the robot has said this.
    fn wait_for(&self, said: &str) {
        self.wait(said, |rows| rows.iter().any(|row| row.contains(said)));
    }

    /// Waits until the robot has stopped, in order, by itself.
    fn wait_for_end(&mut self) {
        let status = wait_for(&mut self.program.0, PATIENCE);
        assert!(status.success(), "{status}: {}", self.rows().join("\n"));
        let log = std::fs::read_to_string(&self.log).unwrap();
        assert!(log.contains("\"stopped\""), "{log}");
        let given_back = tcgetattr(&self.keys).unwrap().local_flags;
        assert!(given_back.contains(LocalFlags::ICANON | LocalFlags::ECHO));
    }
}

/// The row of the line that is typed, if it is the last one and the status line is the one before it.
fn typed(rows: &[String]) -> Option<&str> {
    let last = rows.iter().rposition(|row| !row.is_empty())?;
    let status = rows.get(last.checked_sub(1)?)?;
    let is_whole = status.starts_with("ARI ") && rows[last].starts_with('>');
    is_whole.then_some(&rows[last])
}

/// A robot on a terminal, with another one that helps it across a road, in some seconds.
fn with_helper(columns: u16, test: impl FnOnce(&mut Terminal)) {
    let folder = tempfile::tempdir().unwrap();
    let port = two_free_ports();
    let ari = robot_file(folder.path(), "ARI", 1, port, port + 1);
    let go2 = robot_file(folder.path(), "Go2", 2, port + 1, port);
    for config in [&ari, &go2] {
        edit(config, &[("speed = 40.0", "speed = 4.0")]);
    }
    let mut helper = Killed(start(&go2));
    let mut terminal = Terminal::of(&ari, columns);
    terminal.wait_for_line(">");
    test(&mut terminal);
    type_to(&mut helper.0, "quit\n");
    assert!(wait_for(&mut helper.0, PATIENCE).success());
}

/// What is typed stands on the screen letter after letter, and still does after others have said something.
fn typed_during_a_crossing(columns: u16) {
    with_helper(columns, |terminal| {
        terminal.press("detect\r");
        let mut line = "> ".to_owned();
        for (part, said) in [
            ("unt", "2 acknowledged"),
            ("il id", "2 completed"),
            ("le", "corridor opened"),
            (" 20 ", "corridor closed"),
            ("# no", "ended: task completed"),
        ] {
            for letter in part.chars() {
                terminal.press(&letter.to_string());
                line.push(letter);
                terminal.wait_for_line(line.trim_end());
            }
            terminal.wait_for(said);
            terminal.wait_for_line(line.trim_end());
        }
        // Keys that come at once are all taken.
        terminal.press("\x15status\rhelp quit\rde");
        terminal.wait_for_line("> de");
        terminal.wait_for("> status");
        terminal.wait_for("> help quit");

        // History and completion.
        terminal.press("\x15\x1b[A");
        terminal.wait_for_line("> help quit");
        terminal.press("\x15det\t");
        terminal.wait_for_line("> detect");
        terminal.press("now");
        terminal.wait_for_line("> detect now");
        terminal.press("\x15help\r");
        terminal.wait("help", |rows| {
            rows.iter().any(|row| row.starts_with("quit "))
        });
        terminal.wait_for_line(">");

        // Of a line that is longer than a row its end is seen, and it goes away whole.
        terminal.press(&"x".repeat(usize::from(columns) + 20));
        let seen = format!("> {}", "x".repeat(usize::from(columns) - 3));
        terminal.wait_for_line(&seen);
        terminal.press("\x15");
        terminal.wait_for_line(">");
        assert!(!terminal.rows().join("").contains("xxx"));

        terminal.press("\x03");
        terminal.wait_for_end();
    });
}

#[test]
fn what_is_typed_stays_readable_at_80_columns() {
    typed_during_a_crossing(80);
}

#[test]
fn what_is_typed_stays_readable_at_120_columns() {
    typed_during_a_crossing(120);
}

#[test]
fn ctrl_c_stops_a_leader_whatever_was_typed() {
    with_helper(80, |terminal| {
        terminal.press("detect\r");
        terminal.wait_for("corridor opened");
        terminal.press("abort it \x03");
        terminal.wait_for_end();
        terminal.wait_for("corridor closed");
    });
}

#[test]
fn a_signal_stops_a_leader_while_a_line_is_edited() {
    with_helper(80, |terminal| {
        terminal.press("detect\r");
        terminal.wait_for("corridor opened");
        terminal.press("abo");
        terminal.wait_for_line("> abo");
        signal(&terminal.program.0, "-INT");
        terminal.wait_for_end();
        terminal.wait_for("corridor closed");
    });
}

#[test]
fn the_end_of_typing_is_not_the_end_of_the_robot() {
    with_helper(80, |terminal| {
        terminal.press("detect\r");
        terminal.wait_for("corridor opened");
        terminal.press("\x04");
        terminal.wait("no line to type", |rows| typed(rows).is_none());
        // It goes on leading until the person is across.
        terminal.wait_for("ended: task completed");
        assert!(terminal.program.0.try_wait().unwrap().is_none());
        terminal.press("\x03");
        terminal.wait_for_end();
    });
}

#[test]
fn a_terminal_that_shows_nothing_any_more_holds_up_no_stop() {
    with_helper(80, |terminal| {
        terminal.press("detect\r");
        terminal.wait_for("corridor opened");
        terminal.is_read.store(false, Ordering::Relaxed);
        // More than the kernel keeps for a reader.
        terminal.press("help\rhelp\rhelp\rhelp\rhelp\rhelp\r");
        terminal.press("\x03");
        terminal.wait_for_end();
    });
}
