//! What is typed. On a terminal a line is edited, with history and completion; elsewhere lines are read as they come.
//!
//! Nothing here decides when a robot stops. Ctrl-C stays the signal that the kernel sends, also while a line is edited, so
//! that it arrives whatever this thread is busy with. The end of the input, Ctrl-D, ends the typing, not the robot.

use std::io::{ErrorKind, IsTerminal, stdin, stdout};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::time::Duration;

use crossguard_robot::operator;
use crossguard_robot::tally::Tally;
use crossterm::event::{Event, read as read_key};

use super::super::screen::{Pressed, Screen};
use super::super::terminal;
use super::TYPED;
use crate::metrics::Shared;

/// How long the end of the program waits for what is still to be shown.
const PATIENCE: Duration = Duration::from_millis(500);

/// The person at the keyboard, or a script.
pub(super) struct Typist {
    screen: Screen,
    is_editing: bool,
}

impl Typist {
    /// Lets lines be typed, on a thread of its own that ends with the input. A line is edited where a person types on
    /// `screen`, and `is_for_people`. `heard` knows the stations that can be named.
    pub(super) fn start(
        screen: &Screen,
        is_for_people: bool,
        heard: Shared,
    ) -> (Self, Receiver<String>) {
        let (send, lines) = sync_channel(TYPED);
        let is_for_others = terminal::is_of_others();
        let is_editing = is_for_people && !is_for_others && takes_keys();
        if is_editing {
            screen.begin_editing();
        }
        let typist = Self {
            screen: screen.clone(),
            is_editing,
        };
        let screen = screen.clone();
        let attend = move || {
            let mut is_over = is_for_others;
            if is_editing {
                // A person who wants to close a corridor can, even if the editor has a fault.
                let edited = catch_unwind(AssertUnwindSafe(|| edit(&screen, &heard, &send)));
                screen.end_editing();
                terminal::restore();
                is_over = edited.unwrap_or(false);
            }
            if !is_over {
                read_lines(&send);
            }
        };
        std::thread::spawn(attend);
        (typist, lines)
    }
}

impl Drop for Typist {
    /// Gives the terminal back, with nothing but what was said on it. Somebody who does not read what is shown holds
    /// nothing up.
    fn drop(&mut self) {
        if !self.is_editing {
            return;
        }
        self.screen.within(PATIENCE, Screen::end_editing);
        terminal::restore();
    }
}

/// Whether keys come one by one from now on: there is a terminal that rows can be drawn on.
fn takes_keys() -> bool {
    let is_terminal = stdin().is_terminal() && stdout().is_terminal();
    let is_dumb = std::env::var_os("TERM").is_none_or(|name| name == "dumb");
    is_terminal && !is_dumb && terminal::take_keys().is_ok()
}

/// Reads lines as they come.
fn read_lines(send: &SyncSender<String>) {
    for line in crossguard_robot::lines::lines(stdin().lock()).map_while(Result::ok) {
        let line = String::from_utf8_lossy(&line).into_owned();
        if send.send(line).is_err() {
            return;
        }
    }
}

/// Has lines edited. Whether nobody wants to type any more; otherwise the terminal cannot be edited on.
fn edit(screen: &Screen, heard: &Shared, send: &SyncSender<String>) -> bool {
    let complete = |before: &str| {
        let stations = |tally: &mut Tally| tally.heard_us.keys().copied().collect();
        let stations: Vec<_> = heard.with(stations);
        operator::complete(before, &stations)
    };
    loop {
        match read_key() {
            Ok(Event::Key(key)) => match screen.press(key, complete) {
                Some(Pressed::Line(line)) => {
                    if send.send(line).is_err() {
                        return true;
                    }
                }
                Some(Pressed::End) | None => return true,
                Some(Pressed::Edited | Pressed::Choices(_) | Pressed::Clear) => {}
            },
            Ok(Event::Resize(..)) => screen.resized(),
            Ok(_) => {}
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(_) => return false,
        }
    }
}
