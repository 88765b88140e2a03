//! Commands to a running robot, by a person who types and by programs at the [port]. The parser and the help go by one table, `COMMANDS`.

mod commands;
pub mod port;
mod words;

use std::borrow::Cow;
use std::time::Duration;

use crossguard_protocol::{HelpRequest, State};

use crate::perception::{self, Observation};
use crate::runtime::Order;
use crate::site::Site;

pub use commands::Command;
use commands::{COMMANDS, Scope};
pub(crate) use words::means;

/// A line that was typed.
#[derive(Clone, PartialEq, Debug)]
pub enum Line {
    /// Tell the robot this.
    Order(Order),
    /// Wait so long before the next line.
    Wait(Duration),
    /// Wait until the robot is in this state, but no longer than this.
    Until(State, Duration),
    /// Print what the robot is doing.
    Status,
    /// Print what can be typed: all of it, or this command.
    Help(Option<&'static str>),
    /// Leave the session in order and stop.
    Quit,
    /// Nothing but a comment.
    Blank,
}

/// Why a line means nothing.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Misunderstood {
    /// There is no such command.
    #[error("no command '{0}'; type 'help'")]
    Command(String),
    /// A word is missing.
    #[error("'{command}' wants {wanted}")]
    Missing {
        /// The command.
        command: &'static str,
        /// The words that it wants.
        wanted: &'static str,
    },
    /// A word means nothing here.
    #[error("'{word}' is not {wanted}")]
    Word {
        /// The word.
        word: String,
        /// The word that was wanted in its place.
        wanted: Cow<'static, str>,
    },
    /// It is no person.
    #[error("{0}")]
    Person(String),
    /// There are more words than the command takes.
    #[error("'{0}' is one word too many")]
    Surplus(String),
}

/// After how long without a turn lines may have waited for too long: what a person saw of the road may not be so any more. A
/// message of a station is fresh for as long.
const HELD_US: u64 = 2_000_000;

/// For how long after that a line that is heard may have waited, too.
const WAITED_US: u64 = 100_000;

/// Turns of a loop that hears lines.
#[derive(Debug, Default)]
pub struct Turns {
    /// When the last turn was, and until when lines may be ones that waited.
    last_us: u64,
    waited_until_us: u64,
}

impl Turns {
    /// A turn begins. Whether lines that are heard in it may have waited while the process was held: nobody knows how old they are.
    pub fn begin(&mut self, now_us: u64) -> bool {
        let held_us = now_us.saturating_sub(std::mem::replace(&mut self.last_us, now_us));
        if held_us >= HELD_US {
            self.waited_until_us = now_us + WAITED_US;
        }
        now_us < self.waited_until_us
    }
}

/// Understands a line. Places in it are on `site`; `detect` alone is the request that is `planned`.
///
/// # Errors
/// Why it means nothing.
pub fn parse(text: &str, site: &Site, planned: Option<HelpRequest>) -> Result<Line, Misunderstood> {
    if text.trim_start().starts_with('{') {
        return person(text);
    }
    let text = text.split('#').next().unwrap_or_default();
    let mut words = text.split_whitespace();
    let Some(name) = words.next() else {
        return Ok(Line::Blank);
    };
    let command = Command::named(name);
    let command = command.ok_or_else(|| Misunderstood::Command(name.to_owned()))?;
    let rest: Vec<&str> = words.collect();
    (command.parse)(&rest, &Scope { site, planned })
}

fn person(text: &str) -> Result<Line, Misunderstood> {
    match perception::parse(text) {
        Ok(Observation::Person(vru, None)) => Ok(Line::Order(Order::Perceived(vru))),
        Ok(_) => Err(Misunderstood::Person(
            "frames and at_s are for files of --perceived; here 'wait' does it".to_owned(),
        )),
        Err(error) => Err(Misunderstood::Person(error.to_string())),
    }
}

/// Where the meaning of a command begins in the help, and how wide the help is, in columns.
const MEANING: usize = 23;
const WIDTH: usize = 80;

/// Help for all commands, or for the command of this name.
#[must_use]
pub fn help(command: Option<&str>) -> String {
    let mut lines = Vec::new();
    for it in COMMANDS {
        if command.is_none_or(|name| name == it.name) {
            let usage = format!("{} {}", it.name, it.usage);
            let mut first = usage.trim_end().to_owned();
            if first.len() >= MEANING {
                lines.push(std::mem::take(&mut first));
            }
            for meaning in wrapped(it.meaning, WIDTH - MEANING) {
                lines.push(format!("{first:MEANING$}{meaning}"));
                first.clear();
            }
        }
    }
    if command.is_none() {
        lines.push(
            "{\"id\": N, \"position_m\": [EAST, NORTH], \"velocity_mps\": [1, 0],\n \
             \"class\": \"pedestrian\", \"confidence\": 0.9}"
                .to_owned(),
        );
        let person = "the sensors have this person now; only id and position_m are needed";
        for meaning in wrapped(person, WIDTH - MEANING) {
            lines.push(format!("{:MEANING$}{meaning}", ""));
        }
        lines.extend(wrapped(
            "TASK is initialPos, move, block, or task3 to task15. What follows a # is a comment.",
            WIDTH,
        ));
    }
    lines.join("\n")
}

/// A text in lines of at most so many characters.
fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.is_empty() => word.clone_into(line),
            Some(line) if line.len() + 1 + word.len() <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests;
