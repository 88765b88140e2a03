//! How long a team takes to come about, and its commands to be acknowledged by all, by its size.

use std::collections::BTreeMap;
use std::fmt;

use crossguard_protocol::{Phase, Robot, SessionId, TaskType};
use serde::Serialize;

use super::{Statistic, seconds};

/// When the teams of a run came about, by the clocks of their leaders.
#[derive(Debug, Default)]
pub(super) struct Teams(BTreeMap<SessionId, Formation>);

/// How a team came about, in microseconds.
#[derive(Clone, Copy, Debug)]
struct Formation {
    requested_us: u64,
    /// When it was there, and how many followers it had.
    formed: Option<(u64, usize)>,
}

/// The times of teams of one size. All are by the leader's clock.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct TeamSummary {
    /// How many followers the teams had.
    pub followers: usize,
    /// How many such teams there were.
    pub teams: usize,
    /// From the request for help until the leader had chosen its followers, in seconds.
    pub formed_s: Statistic,
    /// From the first command of a kind until all of that kind were acknowledged, in seconds.
    pub all_acknowledged_s: Statistic,
}

impl fmt::Display for TeamSummary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let plural = |count: usize| if count == 1 { "" } else { "s" };
        write!(
            f,
            "{} team{} with {} follower{}: chosen {:.3} ± {:.3} s after the request; the commands of a stage were all \
             acknowledged within {:.4} ± {:.4} s",
            self.teams,
            plural(self.teams),
            self.followers,
            plural(self.followers),
            self.formed_s.mean,
            self.formed_s.sd,
            self.all_acknowledged_s.mean,
            self.all_acknowledged_s.sd,
        )
    }
}

impl Teams {
    /// Takes note of a robot's state after a step.
    pub(super) fn step(&mut self, at_us: u64, robot: &Robot) {
        let Some(session) = robot.session() else {
            return;
        };
        match robot.phase() {
            Phase::Requesting(_) => {
                self.0.entry(session).or_insert(Formation {
                    requested_us: at_us,
                    formed: None,
                });
            }
            Phase::Leading(leading) => {
                if let Some(team) = self.0.get_mut(&session) {
                    let first = (at_us, leading.members.len());
                    team.formed = team.formed.or(Some(first));
                }
            }
            _ => {}
        }
    }

    /// The times by size; with the maneuvers of all sessions, when each was commanded and acknowledged.
    pub(super) fn summaries(
        &self,
        maneuvers: impl Iterator<Item = (SessionId, TaskType, (u64, Option<u64>))>,
    ) -> Vec<TeamSummary> {
        let mut stages: BTreeMap<(SessionId, TaskType), (u64, Option<u64>)> = BTreeMap::new();
        for (session, task, (commanded, acknowledged)) in maneuvers {
            let stage = stages
                .entry((session, task))
                .or_insert((commanded, Some(0)));
            stage.0 = stage.0.min(commanded);
            // One that nobody acknowledged leaves the stage without an end.
            stage.1 = stage.1.zip(acknowledged).map(|(last, at)| last.max(at));
        }
        let mut by_size: BTreeMap<usize, (Vec<f64>, Vec<f64>)> = BTreeMap::new();
        for (session, team) in &self.0 {
            let Some((formed_us, followers)) = team.formed else {
                continue;
            };
            let (formed, answered) = by_size.entry(followers).or_default();
            formed.push(seconds(team.requested_us, formed_us));
            let of_team = stages.iter().filter(|((of, _), _)| of == session);
            answered.extend(of_team.filter_map(|(_, &(from, to))| Some(seconds(from, to?))));
        }
        let summary = |(followers, (formed, answered)): (usize, (Vec<f64>, Vec<f64>))| {
            let (formed_s, all_acknowledged_s) = (Statistic::of(&formed), Statistic::of(&answered));
            TeamSummary {
                followers,
                teams: formed.len(),
                formed_s,
                all_acknowledged_s,
            }
        };
        by_size.into_iter().map(summary).collect()
    }
}
