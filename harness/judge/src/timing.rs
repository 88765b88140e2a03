//! The paper's timing: negotiation, execution, and both together.
//!
//! `T_TMCT = (t_rx - t_tx) + T_exec` (paper, section III-A, stage 5): `t_tx` is when the leader sends the command,
//! `t_rx` when the follower takes it in. So the negotiation is one way; how long the leader waits for the
//! acknowledgement is a time of its own here, the round trip. A command that is repeated counts from its first
//! transmission to its first reception. A `block` takes as long as it is held.
//!
//! Both times of the negotiation are taken from the clocks of two robots. Robots that share a log share a clock.
//! Between logs the difference is [estimated](Offset) from the messages that went both ways, taken off, and stated
//! with its bound. The round trip needs no other clock.

mod clocks;
mod team;

pub use clocks::{NoOffset, Offset};
pub use team::TeamSummary;

use std::collections::BTreeMap;
use std::fmt;

use crossguard_protocol::{
    Command, Event, Input, ManeuverId, Notice, Output, ReleaseReason, Rmcm, SessionId, StationId,
    StopReason, TaskType,
};
use serde::Serialize;

use clocks::Clocks;
use crossguard_robot::trace::{Entry, Record};
use team::Teams;

/// Gathers times from the records of a run.
#[derive(Debug, Default)]
pub struct Timing {
    /// By maneuver: what is known so far.
    maneuvers: BTreeMap<Key, ManeuverTimes>,
    clocks: Clocks,
    teams: Teams,
    /// How many times as fast as real each robot's body moves, by its name, where its log says so.
    speeds: BTreeMap<String, f64>,
}

/// A maneuver: its session, follower and request. A leader counts its requests for each follower by itself.
type Key = (SessionId, StationId, u8);

const fn id_of(command: &Command) -> ManeuverId {
    ManeuverId::of(command.session, command.request)
}

/// When what happened in one maneuver, in microseconds.
#[derive(Clone, Copy, Debug, Default)]
struct ManeuverTimes {
    task: Option<TaskType>,
    commanded: Option<u64>,
    received: Option<u64>,
    acknowledged: Option<u64>,
    started: Option<u64>,
    completed: Option<u64>,
    /// How many times as fast as real the follower's body moves.
    speed: Option<f64>,
}

/// The times of one kind of maneuver over several trials.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Summary {
    /// The kind of maneuver.
    pub task: String,
    /// How many were completed.
    pub trials: usize,
    /// Negotiation, in seconds: from the leader's first transmission of the command to the follower's first
    /// reception.
    pub t_neg_s: Statistic,
    /// From that transmission to the acknowledgement at the leader, in seconds by the leader's clock.
    pub round_trip_s: Statistic,
    /// Execution, in seconds of the robots' own time.
    pub t_exec_s: Statistic,
    /// Total maneuver coordination time, in seconds.
    pub t_tmct_s: Statistic,
    /// The paper's measurement, if it has one.
    pub paper: Option<Paper>,
}

/// Mean and standard deviation of a sample.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize)]
pub struct Statistic {
    /// The mean.
    pub mean: f64,
    /// The standard deviation of the sample; 0 for a single value.
    pub sd: f64,
}

/// The paper's figures for one kind of maneuver (section III-A): mean and standard deviation over its trials, with
/// robots on IEEE 802.11p.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Paper {
    /// How many trials.
    pub trials: usize,
    /// Negotiation, in seconds.
    pub t_neg_s: Statistic,
    /// Execution, in seconds; the paper gives no deviation.
    pub t_exec_s: f64,
    /// Total maneuver coordination time, in seconds.
    pub t_tmct_s: Statistic,
}

impl Paper {
    /// The paper's figures for `task`.
    #[must_use]
    pub const fn of(task: TaskType) -> Option<Self> {
        let (neg, exec, tmct, sd) = match task {
            TaskType::INITIAL_POS => (0.074, 0.50, 0.574, 0.015),
            TaskType::MOVE => (0.129, 21.60, 21.729, 0.102),
            _ => return None,
        };
        Some(Self {
            trials: 5,
            t_neg_s: Statistic { mean: neg, sd },
            t_exec_s: exec,
            t_tmct_s: Statistic { mean: tmct, sd },
        })
    }
}

impl Statistic {
    /// Mean and deviation of `values`.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "samples are small")]
    pub fn of(values: &[f64]) -> Self {
        if values.is_empty() {
            return Self::default();
        }
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        let sd = if values.len() > 1 {
            (squares / (values.len() - 1) as f64).sqrt()
        } else {
            0.0
        };
        Self { mean, sd }
    }
}

impl Timing {
    /// Takes note of a record of a log, at a time on the log's clock in µs.
    pub fn record(&mut self, log: usize, at_us: u64, record: &Record) {
        self.clocks.record(log, at_us, record);
        if let Entry::Started {
            speed: Some(speed), ..
        } = record.entry
        {
            self.speeds.insert(record.robot.clone(), speed);
        }
        let Entry::Step {
            input,
            outputs,
            state,
        } = &record.entry
        else {
            return;
        };
        let (at, own) = (Some(at_us), state.station());
        self.teams.step(at_us, state);
        if let Input::Local(Event::ManeuverCompleted(id)) = input
            && outputs.ignored().is_none()
        {
            self.times(own, *id).completed = at;
        }
        if let Input::Rmcm(Rmcm::Command(command)) = input
            && command.to == own
        {
            let times = self.times(own, id_of(command));
            times.received = times.received.or(at);
        }
        for output in outputs.iter() {
            match *output {
                Output::SendRmcm(Rmcm::Command(command)) => {
                    let times = self.times(command.to, id_of(&command));
                    times.task = Some(command.task);
                    // A repeated command began with its first transmission.
                    times.commanded = times.commanded.or(at);
                }
                Output::Notify(Notice::CommandAcknowledged(follower, id)) => {
                    self.times(follower, id).acknowledged = at;
                }
                Output::StartManeuver(maneuver) => {
                    let speed = self.speeds.get(&record.robot).copied();
                    let times = self.times(own, maneuver.id);
                    (times.started, times.speed) = (at, speed);
                }
                Output::StopManeuver(
                    maneuver,
                    StopReason::Released(ReleaseReason::TaskCompleted),
                ) if maneuver.task == TaskType::BLOCK => {
                    self.times(own, maneuver.id).completed = at;
                }
                _ => {}
            }
        }
    }

    fn times(&mut self, follower: StationId, id: ManeuverId) -> &mut ManeuverTimes {
        let key = (id.session, follower, id.request.0);
        self.maneuvers.entry(key).or_default()
    }

    /// The times by kind of maneuver, of completed ones between robots whose clocks can be compared. The robots'
    /// own time passes as fast as the log says of each robot.
    #[must_use]
    pub fn summaries(&self) -> Vec<Summary> {
        let mut samples: BTreeMap<TaskType, Vec<Sample>> = BTreeMap::new();
        for (&key, times) in &self.maneuvers {
            let offset = self.logs(key).map(|logs| self.clocks.offset(logs));
            if let Some(Ok(offset)) = offset
                && let Some((task, sample)) = times.complete(offset, times.speed.unwrap_or(1.0))
            {
                samples.entry(task).or_default().push(sample);
            }
        }
        samples
            .into_iter()
            .map(|(task, samples)| summarize(task, &samples))
            .collect()
    }

    /// The times by size of the team, smallest first.
    #[must_use]
    pub fn teams(&self) -> Vec<TeamSummary> {
        let answered = self.maneuvers.iter().filter_map(|(&(session, ..), times)| {
            let asked = (times.commanded?, times.acknowledged);
            Some((session, times.task?, asked))
        });
        self.teams.summaries(answered)
    }

    /// By the logs of leader and follower of completed maneuvers, where these are two: by how much the clock of
    /// the follower's is ahead.
    #[must_use]
    pub fn offsets(&self) -> BTreeMap<(usize, usize), Result<Offset, NoOffset>> {
        let completed = self.maneuvers.iter().filter(|(_, it)| it.is_complete());
        let logs = completed.filter_map(|(&key, _)| self.logs(key));
        logs.filter(|(leader, follower)| leader != follower)
            .map(|logs| (logs, self.clocks.offset(logs)))
            .collect()
    }

    /// The logs of the leader and the follower of a maneuver.
    fn logs(&self, (session, follower, _): Key) -> Option<(usize, usize)> {
        self.clocks.logs((session.leader, follower))
    }
}

/// The times of one maneuver, in seconds.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Sample {
    negotiation: f64,
    round_trip: f64,
    execution: f64,
}

impl ManeuverTimes {
    fn is_complete(&self) -> bool {
        self.complete(Offset::default(), 1.0).is_some()
    }

    fn complete(&self, offset: Offset, time_scale: f64) -> Option<(TaskType, Sample)> {
        #[expect(clippy::cast_precision_loss, reason = "clocks are not so far apart")]
        let ahead = offset.offset_us as f64 / 1e6;
        let sample = Sample {
            negotiation: seconds(self.commanded?, self.received?) - ahead,
            round_trip: seconds(self.commanded?, self.acknowledged?),
            execution: seconds(self.started?, self.completed?) * time_scale,
        };
        Some((self.task?, sample))
    }
}

/// The times of a run, for programs.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Times {
    /// By kind of maneuver.
    pub maneuvers: Vec<Summary>,
    /// By size of the team.
    pub teams: Vec<TeamSummary>,
    /// How far the clocks of logs are apart between which a maneuver was completed.
    pub clocks: Vec<ClockDifference>,
}

/// How far the clocks of a leader's and a follower's log are apart.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct ClockDifference {
    /// The leader's log.
    pub leader: String,
    /// The follower's log.
    pub follower: String,
    /// By how much the follower's clock is ahead, if that is known.
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub ahead: Option<Offset>,
    /// Why it is not known; the maneuvers of these logs are left out then.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
}

impl Times {
    /// Times of logs with these names.
    #[must_use]
    pub fn of(timing: &Timing, logs: &[String]) -> Self {
        let name = |log: usize| logs.get(log).map_or("?", String::as_str).to_owned();
        let clock = |((leader, follower), offset): ((usize, usize), Result<Offset, NoOffset>)| {
            ClockDifference {
                leader: name(leader),
                follower: name(follower),
                ahead: offset.ok(),
                error: offset.err().map(|why| why.to_string()),
            }
        };
        Self {
            maneuvers: timing.summaries(),
            teams: timing.teams(),
            clocks: timing.offsets().into_iter().map(clock).collect(),
        }
    }
}

impl fmt::Display for ClockDifference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (leader, follower) = (&self.leader, &self.follower);
        let Some(offset) = self.ahead else {
            let why = self.error.as_deref().unwrap_or_default();
            return write!(
                f,
                "Maneuvers of {leader} and {follower} are left out: {why}"
            );
        };
        write!(
            f,
            "The clock of {follower} is {} ms ± {} ms ahead of that of {leader}, by {} messages there and {} back; \
             T_neg is without it, and as uncertain",
            milliseconds(offset.offset_us),
            milliseconds(offset.bound_us),
            offset.there,
            offset.back,
        )
    }
}

#[expect(clippy::cast_precision_loss, reason = "for people to read")]
fn milliseconds(us: i64) -> String {
    format!("{:.3}", us as f64 / 1e3)
}

/// From one time to another, in seconds; negative where the other is the earlier.
#[expect(clippy::cast_precision_loss, reason = "a run takes minutes")]
fn seconds(from_us: u64, to_us: u64) -> f64 {
    (to_us as f64 - from_us as f64) / 1e6
}

fn summarize(task: TaskType, samples: &[Sample]) -> Summary {
    let statistic =
        |value: fn(&Sample) -> f64| Statistic::of(&samples.iter().map(value).collect::<Vec<_>>());
    Summary {
        task: task.to_string(),
        trials: samples.len(),
        t_neg_s: statistic(|it| it.negotiation),
        round_trip_s: statistic(|it| it.round_trip),
        t_exec_s: statistic(|it| it.execution),
        t_tmct_s: statistic(|it| it.negotiation + it.execution),
        paper: Paper::of(task),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mean_and_deviation_are_those_of_a_sample() {
        let statistic = Statistic::of(&[1.0, 2.0, 3.0, 4.0]);
        assert!((statistic.mean - 2.5).abs() < 1e-12);
        assert!((statistic.sd - (5.0_f64 / 3.0).sqrt()).abs() < 1e-12);
        assert_eq!(Statistic::of(&[7.0]), Statistic { mean: 7.0, sd: 0.0 });
        assert_eq!(Statistic::of(&[]), Statistic::default());
    }
}
