//! Lines that are typed or piped in.

use std::io::{IsTerminal, stdin};
use std::sync::mpsc::{Receiver, sync_channel};

use crossguard_robot::operator::{self, Line};
use crossguard_robot::robot_file::RobotFile;
use nix::unistd::{getpgrp, tcgetpgrp};

use super::super::Failure;

/// How many lines are kept until it is their turn; the others stay in the pipe.
pub(super) const TYPED: usize = 64;

/// Reads lines as they come, on a thread of its own that ends with the input. The robot goes on.
pub(super) fn lines() -> Receiver<String> {
    let (send, lines) = sync_channel(TYPED);
    if !is_in_background() {
        std::thread::spawn(move || {
            let read = crossguard_robot::lines::lines(stdin().lock());
            for line in read.map_while(Result::ok) {
                let line = String::from_utf8_lossy(&line).into_owned();
                if send.send(line).is_err() {
                    return;
                }
            }
        });
    }
    lines
}

/// Whether a person types, and no script.
pub(super) fn is_by_person() -> bool {
    stdin().is_terminal()
}

/// Meaning of a line to this robot, or why it means nothing. A person is told why, and tries again. Lines that a person
/// types are held back by nothing: an emergency stop must not wait. Fails where a script has it wrong: it is wrong from
/// there on.
pub(super) fn understood(
    text: &str,
    robot: &RobotFile,
    by_person: bool,
) -> Result<Result<Line, String>, Failure> {
    let request = robot.plan().map(|plan| plan.request());
    match operator::parse(text, &robot.site, request) {
        Ok(Line::Wait(_) | Line::Until(..)) if by_person => Ok(Err(
            "'wait' and 'until' are for scripts that are piped in; a line that is typed is carried out at once"
                .to_owned(),
        )),
        Ok(line) => Ok(Ok(line)),
        Err(error) if by_person => Ok(Err(error.to_string())),
        Err(error) => Err(Failure::Input(format!("'{text}': {error}"))),
    }
}

/// The robot that a line is for, which is the one with the longest name that it begins with, in whatever case, and the rest
/// of the line; or all of the line, which is for all robots.
pub(super) fn addressed<'a>(
    line: &'a str,
    names: impl Iterator<Item = &'a str>,
) -> (Option<usize>, &'a str) {
    let line = line.trim_start();
    let rest = |name: &str| {
        let end = line.char_indices().nth(name.chars().count())?.0;
        let (begin, rest) = line.split_at(end);
        let fits = begin.to_lowercase() == name.to_lowercase();
        let is_apart = rest.starts_with(char::is_whitespace) && !rest.trim().is_empty();
        (fits && is_apart).then_some(rest)
    };
    let fitting = names.enumerate();
    let fitting = fitting.filter_map(|(nth, name)| Some((Some(nth), rest(name)?)));
    let longest = fitting.min_by_key(|(_, rest)| rest.len());
    longest.unwrap_or((None, line))
}

/// Whether a shell began this process in the background: keys of the terminal are another process's. Reading them would
/// stop this process, and with it the robot.
fn is_in_background() -> bool {
    stdin().is_terminal() && tcgetpgrp(stdin()).is_ok_and(|group| group != getpgrp())
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use crossguard_robot::robot_file::Besides;

    use super::*;

    const ROBOT: &str = "name = \"Go2\"\nstation = 2\nbuild = \"quadruped\"\nboot_file = \"r.boot\"\n\
        [link]\naddress = \"127.0.0.1:0\"\npeers = []\n";

    /// A line, and what a person and a script are answered: nothing where it is carried out.
    const LINES: [(&str, &str, &str); 6] = [
        ("unavailable emergency-stop", "", ""),
        ("quit # for today", "", ""),
        ("statsu", "no command 'statsu'; type 'help'", "ends"),
        ("unavailable", "'unavailable' wants a reason", "ends"),
        ("wait 15", "are for scripts that are piped in", ""),
        ("until idle 5", "are for scripts that are piped in", ""),
    ];

    /// Hazard: a typing mistake ends a guard, or an emergency stop waits behind a line that was typed before it.
    #[test]
    fn no_line_of_a_person_ends_the_robot_or_holds_the_next_one_back() {
        let file = RobotFile::parse(Path::new("r.toml"), ROBOT, Besides::default()).unwrap();
        for (line, to_person, to_script) in LINES {
            let told = understood(line, &file, true).expect("a person types on");
            let told = told.err().unwrap_or_default();
            let is_told = told.contains(to_person) && told.is_empty() == to_person.is_empty();
            assert!(is_told, "{line}: {told}");
            let ends = understood(line, &file, false).is_err();
            assert_eq!(ends, to_script == "ends", "{line}");
        }
    }

    #[test]
    fn a_line_is_for_the_robot_with_the_longest_name_that_it_begins_with_or_for_all() {
        let names = ["Go2", "Go2 at the kerb", "quit", "\u{130}da"];
        for (line, robot, command) in [
            ("Go2 status", Some(0), "status"),
            ("  go2  status", Some(0), "status"),
            ("GO2 AT THE KERB order 2 move", Some(1), "order 2 move"),
            ("go2 at status", Some(0), "at status"),
            ("Go22 status", None, "Go22 status"),
            ("\u{130}DA clear", Some(3), "clear"),
            ("quit", None, "quit"),
            ("Go2 ", None, "Go2"),
            ("", None, ""),
        ] {
            let (to, rest) = addressed(line, names.into_iter());
            assert_eq!((to, rest.trim()), (robot, command), "{line}");
        }
    }
}
