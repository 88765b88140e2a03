//! Names for people in the protocol's texts: of stations, sessions and commands.
//!
//! ```text
//!   station 2 completed 1#1.0/0   ──►   Go2 completed command 0 of ARI's crossing 1
//! ```
//!
//! Logs have the short forms: `1#37.0/2` is the command with requestID 2 of the session that the leader with station id 1
//! numbered 0 after it had booted for the 37th time. For people that is command 2 of ARI's crossing 37.1; of the first boot
//! crossing 1.

use std::collections::BTreeMap;
use std::fmt::Display;

use crossguard_protocol::StationId;

use crate::chart::names;
use crate::scenario::Scenario;

/// The names of stations, as far as they are known.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Names {
    of: BTreeMap<u32, String>,
    /// Whether texts stay as they are.
    are_short: bool,
}

impl Names {
    /// Leaves texts as logs have them.
    #[must_use]
    pub fn short() -> Self {
        Self {
            are_short: true,
            ..Self::default()
        }
    }

    /// The names of the robots of a scenario.
    #[must_use]
    pub fn of(scenario: &Scenario) -> Self {
        let stations = scenario.robots.iter().map(|robot| robot.station);
        stations.zip(names(scenario)).collect()
    }

    /// The station of this id has this name.
    pub fn set(&mut self, station: StationId, name: impl Into<String>) {
        self.of.insert(station.0, name.into());
    }

    /// A text of the protocol, with names.
    #[must_use]
    pub fn tell(&self, text: impl Display) -> String {
        let text = text.to_string();
        if self.are_short {
            return text;
        }
        let is_part = |c: char| c.is_ascii_alphanumeric() || "#./".contains(c);
        let mut told = String::with_capacity(text.len());
        for piece in text.split_inclusive(|c| !is_part(c)) {
            let word = piece.trim_end_matches(|c| !is_part(c) || c == '.');
            if let Some(name) = self.session_or_command(word) {
                told += &name;
            } else if let Some(before) = told.strip_suffix("station ").map(str::len)
                && let Some(name) = word.parse().ok().and_then(|id| self.of.get(&id))
            {
                told.truncate(before);
                told += name;
            } else {
                told += word;
            }
            told += &piece[word.len()..];
        }
        told
    }

    /// The name of a session, such as `1#1.0`, or of a command, such as `1#1.0/0`.
    fn session_or_command(&self, word: &str) -> Option<String> {
        let (leader, numbers) = word.split_once('#')?;
        let (session, command) = match numbers.split_once('/') {
            Some((session, command)) => (session, format!("command {command} of ")),
            None => (numbers, String::new()),
        };
        let (boot, count) = session.split_once('.')?;
        let (leader, boot): (u32, u16) = (leader.parse().ok()?, boot.parse().ok()?);
        let crossing = count.parse::<u32>().ok()? + 1;
        let since = if boot == 1 {
            String::new()
        } else {
            format!("{boot}.")
        };
        let name = match self.of.get(&leader) {
            Some(name) => name.clone(),
            None => format!("station {leader}"),
        };
        Some(format!("{command}{name}'s crossing {since}{crossing}"))
    }
}

impl<N: Into<String>> FromIterator<(StationId, N)> for Names {
    fn from_iter<T: IntoIterator<Item = (StationId, N)>>(all: T) -> Self {
        let mut names = Self::default();
        for (station, name) in all {
            names.set(station, name);
        }
        names
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stations_sessions_and_commands_have_names_and_other_numbers_stay() {
        let names: Names = [(StationId(1), "ARI"), (StationId(2), "Go2")]
            .into_iter()
            .collect();
        for (text, told) in [
            (
                "station 2 completed 1#1.0/0",
                "Go2 completed command 0 of ARI's crossing 1",
            ),
            (
                "RAM leader of station 2, station 3, 1#1.2",
                "RAM leader of Go2, station 3, ARI's crossing 3",
            ),
            (
                "joined 9#1.0, from station 1.",
                "joined station 9's crossing 1, from ARI.",
            ),
            (
                "people of 1#37.0 may be on the road",
                "people of ARI's crossing 37.1 may be on the road",
            ),
            (
                "── «station 1»: 2 RAM; 1/2 at 3.5 m, #4, station 12",
                "── «ARI»: 2 RAM; 1/2 at 3.5 m, #4, station 12",
            ),
        ] {
            assert_eq!(names.tell(text), told);
        }
        assert_eq!(Names::short().tell("1#1.0/0"), "1#1.0/0");
    }
}
