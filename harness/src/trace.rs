//! Logs: everything that an endpoint did, one JSON object per line, and whether it could have.
//!
//! A log holds every input of the transition function with what it put out and the state after it.
//! [`validate`] replays the inputs and compares; so a log proves that the robot did what the verified
//! transition function does, or shows the first step that it did not.

use std::collections::BTreeMap;
use std::io::{BufRead, Write};

use crossguard_protocol::{Config, Input, Outputs, Robot, Settings, StationId};
use serde::{Deserialize, Serialize};

use crate::endpoint::Effect;
use crate::ras::generation::Trigger;
use crate::wire::MessageKind;

/// One line of a log.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Record {
    /// Microseconds since the log's clock started.
    pub at_us: u64,
    /// The robot's name.
    pub robot: String,
    /// What it did.
    #[serde(flatten)]
    pub entry: Entry,
}

/// What a robot did.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(
    tag = "entry",
    rename_all = "camelCase",
    rename_all_fields = "camelCase"
)]
pub enum Entry {
    /// It booted.
    Started {
        /// Its station id.
        station: StationId,
        /// Its boot counter.
        boot: u16,
        /// Its configuration.
        settings: Box<Settings>,
        /// Milliseconds since 1970 (UTC), to line up logs of several robots.
        unix_ms: u64,
    },
    /// The transition function took a step.
    Step {
        /// What it took in.
        input: Input,
        /// What it put out.
        outputs: Box<Outputs>,
        /// The state after it.
        state: Box<Robot>,
    },
    /// A message went out.
    Sent {
        /// Which message.
        message: MessageKind,
        /// Why.
        trigger: Trigger,
        /// The message.
        #[serde(with = "hex::serde")]
        octets: Vec<u8>,
    },
    /// A message came in and was understood.
    Heard {
        /// Which message.
        message: MessageKind,
        /// Who sent it.
        from: StationId,
        /// The message.
        #[serde(with = "hex::serde")]
        octets: Vec<u8>,
    },
    /// Something came to nothing.
    Dropped {
        /// The cause that it is counted under.
        cause: String,
        /// What exactly.
        detail: String,
        /// The datagram, if there was one.
        #[serde(with = "hex::serde", default)]
        octets: Vec<u8>,
    },
    /// It stopped in order.
    Stopped {
        /// How often what came to nothing.
        counters: BTreeMap<String, u64>,
    },
}

/// What the log says of an effect. What the application is to do is in the outputs of its step.
#[must_use]
pub fn recorded(effect: Effect) -> Option<Entry> {
    Some(match effect {
        Effect::Stepped {
            input,
            outputs,
            state,
        } => Entry::Step {
            input,
            outputs,
            state,
        },
        Effect::Heard { kind, from, octets } => Entry::Heard {
            message: kind,
            from,
            octets,
        },
        Effect::Transmit {
            kind,
            trigger,
            octets,
            ..
        } => Entry::Sent {
            message: kind,
            trigger,
            octets,
        },
        Effect::Dropped {
            cause,
            detail,
            octets,
        } => Entry::Dropped {
            cause: cause.name(),
            detail,
            octets,
        },
        Effect::Act(_) => return None,
    })
}

/// Writes a record as a line.
///
/// # Errors
/// Those of the writer.
pub fn write(to: &mut impl Write, record: &Record) -> std::io::Result<()> {
    serde_json::to_writer(&mut *to, record)?;
    to.write_all(b"\n")
}

/// What a valid log holds.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize)]
pub struct Validated {
    /// How many robots.
    pub robots: usize,
    /// How many steps of the transition function.
    pub steps: usize,
}

/// Why a log is not valid. Lines are counted from 1.
#[derive(Debug, thiserror::Error)]
pub enum Invalid {
    /// The log cannot be read.
    #[error("line {line}: {cause}")]
    Unreadable {
        /// The line.
        line: usize,
        /// Why.
        cause: std::io::Error,
    },
    /// A line is no record.
    #[error("line {line}: not a record: {cause}")]
    NotARecord {
        /// The line.
        line: usize,
        /// Why.
        cause: serde_json::Error,
    },
    /// A robot runs with settings that break an inequality.
    #[error("line {line}: {robot} was started with settings that {cause}")]
    Settings {
        /// The line.
        line: usize,
        /// The robot.
        robot: String,
        /// The broken inequality.
        cause: crossguard_protocol::BrokenInequality,
    },
    /// A robot takes a step without having been started.
    #[error("line {line}: {robot} takes a step and was never started")]
    NotStarted {
        /// The line.
        line: usize,
        /// The robot.
        robot: String,
    },
    /// A step leads somewhere else.
    #[error(
        "line {line}: on '{input}', {robot} put out [{found}]; the protocol puts out [{expected}]"
    )]
    Outputs {
        /// The line.
        line: usize,
        /// The robot.
        robot: String,
        /// What it took in.
        input: String,
        /// What the log says that it put out.
        found: String,
        /// What the transition function puts out.
        expected: String,
    },
    /// A step leads into another state.
    #[error(
        "line {line}: on '{input}', {robot} went into a state that the protocol does not lead to"
    )]
    State {
        /// The line.
        line: usize,
        /// The robot.
        robot: String,
        /// What it took in.
        input: String,
    },
}

/// Replays a log through the transition function.
///
/// # Errors
/// The first line that is not what the transition function does.
pub fn validate(log: impl BufRead) -> Result<Validated, Invalid> {
    let mut replay = Replay::default();
    for (i, text) in log.lines().enumerate() {
        let line = i + 1;
        let text = text.map_err(|cause| Invalid::Unreadable { line, cause })?;
        let record: Record =
            serde_json::from_str(&text).map_err(|cause| Invalid::NotARecord { line, cause })?;
        replay.take(line, record)?;
    }
    Ok(Validated {
        robots: replay.robots.len(),
        steps: replay.steps,
    })
}

#[derive(Default)]
struct Replay {
    robots: BTreeMap<String, (Robot, Config)>,
    steps: usize,
}

impl Replay {
    fn take(&mut self, line: usize, Record { robot, entry, .. }: Record) -> Result<(), Invalid> {
        match entry {
            Entry::Started {
                station,
                boot,
                settings,
                ..
            } => {
                let config = Config::new(*settings).map_err(|cause| Invalid::Settings {
                    line,
                    robot: robot.clone(),
                    cause,
                })?;
                self.robots
                    .insert(robot, (Robot::new(station, boot), config));
                Ok(())
            }
            Entry::Step {
                input,
                outputs,
                state,
            } => self.step(line, robot, input, &outputs, &state),
            Entry::Sent { .. }
            | Entry::Heard { .. }
            | Entry::Dropped { .. }
            | Entry::Stopped { .. } => Ok(()),
        }
    }

    fn step(
        &mut self,
        line: usize,
        robot: String,
        input: Input,
        outputs: &Outputs,
        after: &Robot,
    ) -> Result<(), Invalid> {
        let Some((state, config)) = self.robots.get_mut(&robot) else {
            return Err(Invalid::NotStarted { line, robot });
        };
        let expected = state.step(config, input);
        let input = input.to_string();
        if expected != *outputs {
            let (found, expected) = (list(outputs), list(&expected));
            return Err(Invalid::Outputs {
                line,
                robot,
                input,
                found,
                expected,
            });
        }
        if state != after {
            return Err(Invalid::State { line, robot, input });
        }
        self.steps += 1;
        Ok(())
    }
}

fn list(outputs: &Outputs) -> String {
    outputs
        .iter()
        .map(ToString::to_string)
        .collect::<Vec<_>>()
        .join("; ")
}

#[cfg(test)]
mod tests {
    use crossguard_protocol::{Event, Millis};

    use super::*;

    fn log() -> Vec<Record> {
        let (config, station, boot) = (Config::default(), StationId(1), 3);
        let mut robot = Robot::new(station, boot);
        let settings = Box::new(config.settings().clone());
        let mut entries = vec![Entry::Started {
            station,
            boot,
            settings,
            unix_ms: 0,
        }];
        let tasks = config.settings().capabilities;
        let request = crossguard_protocol::HelpRequest {
            urgency: crossguard_protocol::Urgency::Low,
            followers: 1,
            tasks,
        };
        for input in [
            Input::Local(Event::PedestrianDetected(request)),
            Input::Elapsed(Millis(100)),
            Input::Local(Event::LeaveRequested),
        ] {
            let outputs = Box::new(robot.step(&config, input));
            entries.push(Entry::Step {
                input,
                outputs,
                state: Box::new(robot.clone()),
            });
        }
        let record = |entry| Record {
            at_us: 0,
            robot: "ARI".to_owned(),
            entry,
        };
        entries.into_iter().map(record).collect()
    }

    fn text(records: &[Record]) -> Vec<u8> {
        let mut text = Vec::new();
        for record in records {
            write(&mut text, record).unwrap();
        }
        text
    }

    #[test]
    fn a_log_of_what_the_protocol_did_is_valid() {
        let validated = validate(&*text(&log())).unwrap();
        assert_eq!(
            validated,
            Validated {
                robots: 1,
                steps: 3
            }
        );
    }

    #[test]
    fn an_altered_step_is_found_at_its_line() {
        let mut records = log();
        if let Entry::Step { input, .. } = &mut records[2].entry {
            *input = Input::Elapsed(Millis(99));
        }
        let error = validate(&*text(&records)).unwrap_err();
        assert!(
            error
                .to_string()
                .starts_with("line 3: on '99 ms elapsed', ARI put out [send RAM]")
        );
    }

    #[test]
    fn an_altered_state_is_found_at_its_line() {
        let mut records = log();
        let other = Box::new(Robot::new(StationId(1), 4));
        if let Entry::Step { state, .. } = &mut records[3].entry {
            *state = other;
        }
        assert!(matches!(
            validate(&*text(&records)),
            Err(Invalid::State { line: 4, .. })
        ));
    }

    #[test]
    fn what_is_not_a_log_is_told_apart() {
        assert!(matches!(
            validate(&b"{}\n"[..]),
            Err(Invalid::NotARecord { line: 1, .. })
        ));
        let headless = text(&log()[1..]);
        assert!(matches!(
            validate(&*headless),
            Err(Invalid::NotStarted { line: 1, .. })
        ));
    }
}
