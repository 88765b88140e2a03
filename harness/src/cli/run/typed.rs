//! Lines that are typed or piped in.

use std::io::{IsTerminal, stdin};
use std::sync::mpsc::{Receiver, sync_channel};

use crossguard_endpoint::Stimulus;
use crossguard_protocol::{Availability, Event};
use crossguard_robot::operator::{self, Line, Turns};
use crossguard_robot::robot_file::RobotFile;
use crossguard_robot::runtime::{Clock, Order};
use nix::unistd::{getpgrp, tcgetpgrp};

use super::super::Failure;

/// How many lines are kept until it is their turn; the others stay in the pipe.
pub(super) const TYPED: usize = 64;

/// Lines as they come, and their origin.
pub(super) struct Typed {
    lines: Receiver<String>,
    /// Whether a person types, and no script.
    by_person: bool,
    clock: Clock,
    turns: Turns,
    may_have_waited: bool,
}

/// Reads lines on a thread of its own that ends with the input. The robot goes on.
pub(super) fn lines() -> Typed {
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
    Typed {
        lines,
        by_person: stdin().is_terminal(),
        clock: Clock::start(),
        turns: Turns::default(),
        may_have_waited: false,
    }
}

impl Typed {
    /// The next line, if one has come.
    pub(super) fn next(&mut self) -> Option<String> {
        self.may_have_waited = self.turns.begin(self.clock.now_us());
        self.lines.try_recv().ok()
    }

    /// Meaning of this line to this robot, or why it means nothing. A person is told why, and tries again. Lines that a person
    /// types are held back by nothing: an emergency stop must not wait. Fails where a script has it wrong: it is wrong from
    /// there on.
    pub(super) fn understood(
        &self,
        text: &str,
        robot: &RobotFile,
    ) -> Result<Result<Line, String>, Failure> {
        let request = robot.plan().map(|plan| plan.request());
        match operator::parse(text, &robot.site, request) {
            Ok(line) if self.by_person && self.may_have_waited && !stops(&line) => Ok(Err(format!(
                "'{text}' is dropped: the robot was held. Look first, and say it again"
            ))),
            Ok(Line::Wait(_) | Line::Until(..)) if self.by_person => Ok(Err(
                "'wait' and 'until' are for scripts that are piped in; a line that is typed is carried out at once"
                    .to_owned(),
            )),
            Ok(line) => Ok(Ok(line)),
            Err(error) if self.by_person => Ok(Err(error.to_string())),
            Err(error) => Err(Failure::Input(format!("'{text}': {error}"))),
        }
    }
}

/// Whether a line stops the robot: one that comes late makes nothing less safe.
fn stops(line: &Line) -> bool {
    use Availability::Unavailable;
    use Event::AvailabilityChanged;
    matches!(
        line,
        Line::Order(Order::Tell(Stimulus::Event(AvailabilityChanged(
            Unavailable(_)
        ))))
    )
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

    fn robot() -> RobotFile {
        RobotFile::parse(Path::new("r.toml"), ROBOT, Besides::default()).unwrap()
    }

    /// The next line, of a person or a script, after the process was held or not.
    fn line(text: &str, by_person: bool, is_held: bool) -> Result<Result<Line, String>, Failure> {
        let (send, lines) = sync_channel(TYPED);
        let mut turns = Turns::default();
        if is_held {
            turns.begin(u64::from(u32::MAX));
        }
        let mut typed = Typed {
            lines,
            by_person,
            turns,
            clock: Clock::start(),
            may_have_waited: false,
        };
        send.send(text.to_owned()).unwrap();
        let text = typed.next().unwrap();
        typed.understood(&text, &robot())
    }

    /// Hazard: a typing mistake ends a guard, or an emergency stop waits behind a line that was typed before it.
    #[test]
    fn no_line_of_a_person_ends_the_robot_or_holds_the_next_one_back() {
        for (text, to_person, to_script) in LINES {
            let told = line(text, true, false).expect("a person types on");
            let told = told.err().unwrap_or_default();
            let is_told = told.contains(to_person) && told.is_empty() == to_person.is_empty();
            assert!(is_told, "{text}: {told}");
            let ends = line(text, false, false).is_err();
            assert_eq!(ends, to_script == "ends", "{text}");
        }
    }

    /// Hazard: a person types that the road is clear, the process hangs, somebody steps on the road, and the process goes on.
    #[test]
    fn a_line_that_was_typed_while_the_process_was_held_is_dropped_unless_it_stops_the_robot() {
        for (text, by_person, is_dropped) in [
            ("clear", true, true),
            ("available", true, true),
            ("unavailable emergency-stop", true, false),
            ("clear", false, false),
        ] {
            assert!(matches!(line(text, by_person, false), Ok(Ok(_))), "{text}");
            let is_told = matches!(line(text, by_person, true), Ok(Err(_)));
            assert_eq!(is_told, is_dropped, "{text}");
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
