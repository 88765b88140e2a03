//! The paper's timing: negotiation, execution, and both together.
//!
//! `T_TMCT = (t_rx - t_tx) + T_exec` (paper, section on the proof of concept): from the leader's
//! command going out to its acknowledgement coming in, plus the time that the follower takes. A `block`
//! takes as long as it is held.

use std::collections::BTreeMap;

use crossguard_protocol::{
    Event, Input, ManeuverId, Notice, Output, ReleaseReason, Rmcm, StationId, StopReason, TaskType,
};
use serde::Serialize;

use crossguard_robot::trace::{Entry, Record};

/// Gathers times from the records of a run.
#[derive(Debug, Default)]
pub struct Timing {
    /// By maneuver: what is known so far.
    maneuvers: BTreeMap<Key, ManeuverTimes>,
}

/// A maneuver in an order that has no meaning but is one. A leader counts its requests for each follower
/// by itself, so it takes the follower as well.
type Key = (u32, u32, u32, u8);

fn key(follower: StationId, id: ManeuverId) -> Key {
    let session = id.session;
    let number = session.number.0.to_u32();
    (session.leader.0, number, follower.0, id.request.0)
}

/// When what happened in one maneuver, in microseconds.
#[derive(Clone, Copy, Debug, Default)]
struct ManeuverTimes {
    task: Option<TaskType>,
    commanded: Option<u64>,
    acknowledged: Option<u64>,
    started: Option<u64>,
    completed: Option<u64>,
}

/// The times of one kind of maneuver over several trials.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Summary {
    /// The kind of maneuver.
    pub task: String,
    /// How many were completed.
    pub trials: usize,
    /// Negotiation, in seconds.
    pub t_neg_s: Statistic,
    /// Execution, in seconds of the robots' own time.
    pub t_exec_s: Statistic,
    /// Total maneuver coordination time, in seconds.
    pub t_tmct_s: Statistic,
    /// What the paper measured.
    pub paper: Paper,
}

/// Mean and standard deviation of a sample.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize)]
pub struct Statistic {
    /// The mean.
    pub mean: f64,
    /// The standard deviation of the sample; 0 for a single value.
    pub sd: f64,
}

/// The paper's figures for one kind of maneuver, as far as they are known here.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize)]
pub struct Paper {
    /// Negotiation over IEEE 802.11p, in seconds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub t_neg_s: Option<Statistic>,
    /// Execution, in seconds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub t_exec_s: Option<f64>,
}

impl Paper {
    /// The paper's figures for `task`.
    #[must_use]
    pub fn of(task: TaskType) -> Self {
        let statistic = |mean, sd| Some(Statistic { mean, sd });
        match task {
            TaskType::INITIAL_POS => Self {
                t_neg_s: statistic(0.074, 0.015),
                t_exec_s: None,
            },
            TaskType::MOVE => Self {
                t_neg_s: statistic(0.129, 0.102),
                t_exec_s: Some(21.6),
            },
            _ => Self::default(),
        }
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
    /// Takes note of a record.
    pub fn record(&mut self, record: &Record) {
        let Entry::Step {
            input,
            outputs,
            state,
        } = &record.entry
        else {
            return;
        };
        let (at, own) = (Some(record.at_us), state.station());
        if let Input::Local(Event::ManeuverCompleted(id)) = input
            && outputs.ignored().is_none()
        {
            self.times(own, *id).completed = at;
        }
        for output in outputs.iter() {
            match *output {
                Output::SendRmcm(Rmcm::Command(command)) => {
                    let id = ManeuverId {
                        session: command.session,
                        request: command.request,
                    };
                    let times = self.times(command.to, id);
                    times.task = Some(command.task);
                    // A repeated command began with its first transmission.
                    times.commanded = times.commanded.or(at);
                }
                Output::Notify(Notice::CommandAcknowledged(follower, id)) => {
                    self.times(follower, id).acknowledged = at;
                }
                Output::StartManeuver(maneuver) => self.times(own, maneuver.id).started = at,
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
        self.maneuvers.entry(key(follower, id)).or_default()
    }

    /// The times by kind of maneuver, of completed ones. The robots' own time passes
    /// `time_scale` times as fast as ours.
    #[must_use]
    pub fn summaries(&self, time_scale: f64) -> Vec<Summary> {
        let mut samples: BTreeMap<TaskType, Vec<(f64, f64)>> = BTreeMap::new();
        for times in self.maneuvers.values() {
            if let Some((task, negotiation, execution)) = times.complete() {
                samples
                    .entry(task)
                    .or_default()
                    .push((negotiation, execution * time_scale));
            }
        }
        samples
            .into_iter()
            .map(|(task, samples)| summarize(task, &samples))
            .collect()
    }
}

impl ManeuverTimes {
    fn complete(self) -> Option<(TaskType, f64, f64)> {
        #[expect(clippy::cast_precision_loss, reason = "a run takes minutes")]
        let seconds = |from: u64, to: u64| to.saturating_sub(from) as f64 / 1e6;
        let negotiation = seconds(self.commanded?, self.acknowledged?);
        let execution = seconds(self.started?, self.completed?);
        Some((self.task?, negotiation, execution))
    }
}

fn summarize(task: TaskType, samples: &[(f64, f64)]) -> Summary {
    let statistic = |value: fn(&(f64, f64)) -> f64| {
        Statistic::of(&samples.iter().map(value).collect::<Vec<_>>())
    };
    Summary {
        task: task.to_string(),
        trials: samples.len(),
        t_neg_s: statistic(|(negotiation, _)| *negotiation),
        t_exec_s: statistic(|(_, execution)| *execution),
        t_tmct_s: statistic(|(negotiation, execution)| negotiation + execution),
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
