//! The stages of a crossing, and what a state of each means.

use crossguard_protocol::{Corridor, Member, Phase, Progress};
use serde::Serialize;

use crate::node::Node;

/// A stage of a crossing. The states in which one ends are those in which the next begins, each with its
/// probability.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Stage {
    /// From the pedestrian that is detected to the full team. The request stands for ever in its states; `t_help` is
    /// kept by counting ticks.
    Gathering,
    /// The leader commands `move` to all, and opens the corridor as soon as it may.
    Commanding,
    /// The corridor is open, and all followers move.
    Holding,
}

/// An event that has happened by the time of a state.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Milestone {
    /// Every follower that was asked for has taken its role, and the leader knows.
    Team,
    /// The command has reached every follower.
    Received,
    /// Every follower has acknowledged its command, and the leader knows.
    Acknowledged,
    /// The corridor is open.
    Open,
    /// The corridor has closed before the maneuver was over.
    Interrupted,
    /// A follower has fallen back.
    FellBack,
}

impl Milestone {
    /// All milestones, in the order of a crossing.
    pub const ALL: [Self; 6] = [
        Self::Team,
        Self::Received,
        Self::Acknowledged,
        Self::Open,
        Self::Interrupted,
        Self::FellBack,
    ];

    /// The stage in which it can be reached.
    #[must_use]
    pub const fn stage(self) -> Stage {
        match self {
            Self::Team => Stage::Gathering,
            Self::Received | Self::Acknowledged | Self::Open => Stage::Commanding,
            Self::Interrupted | Self::FellBack => Stage::Holding,
        }
    }

    const fn bit(self) -> u8 {
        1 << self as u8
    }
}

/// The milestones that are reached, and whether the stage has ended without its last one.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub(super) struct Marks(u8);

impl Marks {
    const FAILED: u8 = 1 << 7;

    pub(super) const fn has(self, milestone: Milestone) -> bool {
        self.0 & milestone.bit() != 0
    }

    #[must_use]
    const fn with(self, milestone: Milestone, is_reached: bool) -> Self {
        if is_reached {
            Self(self.0 | milestone.bit())
        } else {
            self
        }
    }

    /// The stage ended without its last milestone.
    pub(super) const fn has_failed(self) -> bool {
        self.0 & Self::FAILED != 0
    }

    #[must_use]
    pub(super) const fn failed(self) -> Self {
        Self(self.0 | Self::FAILED)
    }

    pub(super) const fn ends(self, stage: Stage) -> bool {
        self.has_failed() || self.has(stage.last())
    }
}

impl Stage {
    /// All stages, in their order.
    pub const ALL: [Self; 3] = [Self::Gathering, Self::Commanding, Self::Holding];

    /// Its name, as in files and in JSON.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Gathering => "gathering",
            Self::Commanding => "commanding",
            Self::Holding => "holding",
        }
    }

    /// The milestone with which it is over.
    #[must_use]
    pub const fn last(self) -> Milestone {
        match self {
            Self::Gathering => Milestone::Team,
            Self::Commanding => Milestone::Open,
            Self::Holding => Milestone::FellBack,
        }
    }

    /// The milestones that can be reached in it.
    pub fn milestones(self) -> impl Iterator<Item = Milestone> {
        Milestone::ALL
            .into_iter()
            .filter(move |milestone| milestone.stage() == self)
    }

    /// The marks after a tick in which `fell_back` tells whether any body fell back, of a team whose leader is the
    /// first of `nodes`.
    pub(super) fn marked(self, before: Marks, nodes: &[&Node], fell_back: bool) -> Marks {
        match self {
            Self::Gathering => gathered(before, nodes),
            Self::Commanding => commanded(before, nodes, fell_back),
            Self::Holding => {
                let is_open = nodes[0].actuation.corridor_open;
                before
                    .with(Milestone::Interrupted, !is_open)
                    .with(Milestone::FellBack, fell_back)
            }
        }
    }
}

fn gathered(before: Marks, nodes: &[&Node]) -> Marks {
    match nodes[0].phase() {
        Some(Phase::Requesting(_)) => before,
        Some(Phase::Leading(leading)) if leading.members.len() == nodes.len() - 1 => {
            let all_joined = leading.members.iter().all(Member::has_joined);
            before.with(Milestone::Team, all_joined)
        }
        _ => before.failed(),
    }
}

fn commanded(before: Marks, nodes: &[&Node], fell_back: bool) -> Marks {
    let has_job = |node: &&Node| node.following().is_some_and(|it| it.job.is_some());
    let marks = before.with(Milestone::Received, nodes[1..].iter().all(has_job));
    let Some(leading) = nodes[0].leading() else {
        return marks.failed();
    };
    let runs = |progress: Option<Progress>| progress.is_none_or(Progress::is_running);
    let goes_on = leading.members.len() == nodes.len() - 1
        && leading
            .members
            .iter()
            .all(|member| member.order.is_none_or(|order| runs(order.progress)));
    let acknowledged = |member: &Member| member.outstanding.is_none() && member.order.is_some();
    let marks = marks
        .with(
            Milestone::Acknowledged,
            goes_on && leading.members.iter().all(acknowledged),
        )
        .with(Milestone::Open, leading.corridor == Corridor::Open);
    // The application does not command a second time.
    if goes_on && !fell_back {
        marks
    } else {
        marks.failed()
    }
}
