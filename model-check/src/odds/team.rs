//! A team on the grid of time: what may follow a state within a tick, and with which probability.

use std::sync::Arc;

use crossguard_protocol::{
    Event, HelpRequest, Output, Outputs, Place, StationId, TaskSet, TaskType, Urgency,
};
use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use super::setup::{FOLLOWERS_MAX, OddsSetup, WIDTHS};
use super::stage::{Marks, Milestone, Stage};
use super::weight::Chances;
use crate::canonical::{Ranks, Renamable, Renamings};
use crate::held::Held;
use crate::node::{Node, Rules};
use crate::robots::{Robots, TimedCause};

const ROBOTS_MAX: usize = FOLLOWERS_MAX as usize + 1;

/// The place of the leader among the robots. Followers come after it.
const LEADER: u8 = 0;

#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
struct Broadcast {
    /// For how many ticks.
    ticks: u8,
    from: u8,
    message: u16,
}

/// A state at a point of the grid, after everything that happens there.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(super) struct TeamState {
    /// Numbers of the robots' states.
    nodes: [u32; ROBOTS_MAX],
    /// Broadcasts under way, in the order in which they were sent.
    air: SmallVec<[Broadcast; 4]>,
    /// One bit for each follower whose link to the leader is in a burst of losses.
    bad: u8,
    pub(super) marks: Marks,
}

impl TeamState {
    /// The state that stands for all in which a stage is over and from which no other stage begins.
    fn over(marks: Marks) -> Self {
        Self {
            nodes: [0; ROBOTS_MAX],
            air: SmallVec::new(),
            bad: 0,
            marks,
        }
    }
}

/// Ways on from a state, with what happens on each.
pub(super) type Ways = Vec<(Chances, TeamState)>;

#[derive(Clone)]
struct TeamStep {
    after: u32,
    sends: SmallVec<[u16; 2]>,
    falls_back: bool,
}

pub(super) struct TeamModel {
    setup: OddsSetup,
    /// One bit for each follower whose link loses nothing.
    lossless: u8,
    robots: Robots,
    /// Each step of a robot is computed once.
    steps: FxHashMap<(u32, TimedCause), TeamStep>,
}

/// A state while a tick is worked out.
struct TickDraft {
    chances: Chances,
    state: TeamState,
    falls_back: bool,
}

impl TeamModel {
    pub(super) fn new(setup: OddsSetup, rules: Box<dyn Rules>) -> Self {
        let renamings = Arc::new(Renamings::new(Ranks::rank_keeping_distances));
        Self {
            setup,
            lossless: 0,
            robots: Robots::new(rules, &renamings),
            steps: FxHashMap::default(),
        }
    }

    pub(super) const fn setup(&self) -> &OddsSetup {
        &self.setup
    }

    /// From now on the links of all followers but the first lose nothing, or lose as that one does.
    pub(super) fn look_at_one_link(&mut self, is_one: bool) {
        self.lossless = if is_one { self.links() & !1 } else { 0 };
    }

    /// How far apart bounds may be. One link alone has so few states that they need not be as far apart as for all.
    pub(super) fn width(&self) -> f64 {
        if self.lossless == 0 {
            self.setup.width
        } else {
            self.setup.width.min(WIDTHS[0])
        }
    }

    /// One bit for each follower.
    fn links(&self) -> u8 {
        (1 << self.setup.followers) - 1
    }

    fn team_size(&self) -> u8 {
        self.setup.followers + 1
    }

    /// How many ticks a message takes.
    fn delay(&self) -> u8 {
        let grid = self.setup.grid();
        u8::try_from(grid.ticks(grid.delay)).unwrap_or(u8::MAX)
    }

    /// Station ids are places, counted from 1.
    fn station(place: u8) -> StationId {
        StationId(u32::from(place) + 1)
    }

    /// The states in which every run begins: all are idle, one has just detected a pedestrian, and the links are
    /// as they are on average.
    pub(super) fn start(&mut self) -> Ways {
        let mut nodes = [0; ROBOTS_MAX];
        for (place, node) in (0..self.team_size()).zip(&mut nodes) {
            *node = self
                .robots
                .nodes
                .number(Node::first_boot(Self::station(place)));
        }
        let state = TeamState {
            nodes,
            ..TeamState::over(Marks::default())
        };
        let mut draft = TickDraft::from(state);
        let request = HelpRequest {
            urgency: Urgency::Medium,
            followers: self.setup.followers,
            tasks: TaskSet::of(&[TaskType::MOVE]),
            place: Place(1),
        };
        let detected = Event::PedestrianDetected(request);
        self.take_in(&mut draft, LEADER, TimedCause::Event(detected));
        self.canonicalize(&mut draft.state);
        if self.setup.burst.is_none() {
            return vec![(draft.chances, draft.state)];
        }
        self.bad_links()
            .map(|bad| {
                let chances = Chances {
                    lost: count(bad),
                    arrived: count(self.links() & !self.lossless & !bad),
                    ..Chances::default()
                };
                (
                    chances,
                    TeamState {
                        bad,
                        ..draft.state.clone()
                    },
                )
            })
            .collect()
    }

    /// The state in which `stage` begins, for one in which the stage before it has been completed.
    pub(super) fn enter(&mut self, stage: Stage, before: &TeamState) -> TeamState {
        let mut draft = TickDraft::from(TeamState {
            marks: Marks::default(),
            ..before.clone()
        });
        if stage == Stage::Commanding {
            for place in 1..self.team_size() {
                let event = Event::CommandManeuver {
                    follower: Self::station(place),
                    task: TaskType::MOVE,
                };
                self.take_in(&mut draft, LEADER, TimedCause::Event(event));
            }
            self.canonicalize(&mut draft.state);
        }
        draft.state
    }

    pub(super) fn is_requesting(&self, state: &TeamState) -> bool {
        self.robots
            .nodes
            .value(state.nodes[usize::from(LEADER)])
            .is_requesting()
    }

    /// States that may follow within a tick, with the chances on the way to each.
    pub(super) fn ways(&mut self, stage: Stage, from: &TeamState) -> Ways {
        if from.marks.ends(stage) {
            return vec![(Chances::default(), from.clone())];
        }
        let delay = self.delay();
        let arriving: SmallVec<[Broadcast; 4]> = (from.air.iter().copied())
            .filter(|broadcast| broadcast.ticks + 1 == delay)
            .collect();
        let mut drafts = self.links_change(from);
        for draft in &mut drafts {
            for broadcast in &mut draft.state.air {
                broadcast.ticks += 1;
            }
            draft.state.air.retain(|broadcast| broadcast.ticks < delay);
            for place in 0..self.team_size() {
                self.take_in(draft, place, TimedCause::Elapsed(self.setup.grid().tick));
            }
        }
        for broadcast in arriving {
            for place in (0..self.team_size()).filter(|place| *place != broadcast.from) {
                drafts = self.arrives(drafts, broadcast, place);
            }
        }
        let finished = drafts.into_iter().map(|draft| self.finished(stage, draft));
        finished.collect()
    }

    fn bad_links(&self) -> impl Iterator<Item = u8> + use<> {
        let lossless = self.lossless;
        (0..=self.links()).filter(move |bad| bad & lossless == 0)
    }

    /// The links at the end of a tick, where losses come in bursts.
    fn links_change(&self, state: &TeamState) -> Vec<TickDraft> {
        if self.setup.burst.is_none() {
            return vec![TickDraft::from(state.clone())];
        }
        let was_bad = state.bad;
        let was_good = self.links() & !self.lossless & !was_bad;
        let drafts = self.bad_links().map(|bad| {
            let mut draft = TickDraft::from(state.clone());
            draft.state.bad = bad;
            draft.chances = Chances {
                worsened: count(was_good & bad),
                stayed_good: count(was_good & !bad),
                improved: count(was_bad & !bad),
                stayed_bad: count(was_bad & bad),
                ..Chances::default()
            };
            draft
        });
        drafts.collect()
    }

    /// A message arrives at the robot at `to`, or gets lost on the way to it. Where it changes nothing, nobody needs
    /// to ask which.
    fn arrives(&mut self, drafts: Vec<TickDraft>, broadcast: Broadcast, to: u8) -> Vec<TickDraft> {
        let mut after = Vec::with_capacity(2 * drafts.len());
        for mut lost in drafts {
            let cause = TimedCause::Message(broadcast.message);
            if !self.changes_anything(&lost, to, cause) {
                after.push(lost);
                continue;
            }
            // Followers have no link of their own to each other: what they say is lost where either is cut off.
            let links = link(broadcast.from) | link(to);
            if self.setup.burst.is_some() || links & !self.lossless == 0 {
                if lost.state.bad & links == 0 {
                    self.take_in(&mut lost, to, cause);
                }
                after.push(lost);
                continue;
            }
            let mut arrived = TickDraft {
                chances: lost.chances,
                state: lost.state.clone(),
                falls_back: lost.falls_back,
            };
            arrived.chances.arrived += 1;
            lost.chances.lost += 1;
            self.take_in(&mut arrived, to, cause);
            after.push(arrived);
            after.push(lost);
        }
        after
    }

    /// Ends a tick: the application acts, and the milestones reached are marked.
    fn finished(&mut self, stage: Stage, mut draft: TickDraft) -> (Chances, TeamState) {
        match stage {
            // Helpers are as many as are asked for: once all have offered, no other offer can come.
            Stage::Gathering => {
                self.take_in(&mut draft, LEADER, TimedCause::Event(Event::AllAnswered));
            }
            Stage::Commanding => {
                let marks = self.marks(stage, &draft);
                if marks.has(Milestone::Acknowledged) && !marks.has_failed() {
                    self.take_in(&mut draft, LEADER, TimedCause::Event(Event::OpenCorridor));
                }
            }
            Stage::Holding => {}
        }
        let marks = self.marks(stage, &draft);
        let TickDraft {
            chances, mut state, ..
        } = draft;
        state.marks = marks;
        if marks.has_failed() || (marks.ends(stage) && stage == Stage::Holding) {
            return (chances, TeamState::over(marks));
        }
        self.canonicalize(&mut state);
        (chances, state)
    }

    fn marks(&self, stage: Stage, draft: &TickDraft) -> Marks {
        let numbers = &draft.state.nodes[..usize::from(self.team_size())];
        let nodes: SmallVec<[&Node; ROBOTS_MAX]> = numbers
            .iter()
            .map(|&node| self.robots.nodes.value(node))
            .collect();
        stage.marked(draft.state.marks, &nodes, draft.falls_back)
    }

    fn changes_anything(&mut self, draft: &TickDraft, place: u8, cause: TimedCause) -> bool {
        let before = draft.state.nodes[usize::from(place)];
        let step = self.step(before, cause);
        step.after != before || !step.sends.is_empty()
    }

    fn take_in(&mut self, draft: &mut TickDraft, place: u8, cause: TimedCause) {
        let node = &mut draft.state.nodes[usize::from(place)];
        let step = self.step(*node, cause);
        *node = step.after;
        draft.falls_back |= step.falls_back;
        let sent = step.sends.iter().map(|&message| Broadcast {
            ticks: 0,
            from: place,
            message,
        });
        draft.state.air.extend(sent);
    }

    fn step(&mut self, node: u32, cause: TimedCause) -> TeamStep {
        if let Some(known) = self.steps.get(&(node, cause)) {
            return known.clone();
        }
        let input = self.robots.input(cause);
        let stepped = self.robots.step(&self.setup.config, node, input);
        let step = match stepped {
            Some((after, outputs)) => self.stepped(&after, &outputs),
            // No robot is ever down here.
            None => TeamStep {
                after: node,
                sends: SmallVec::new(),
                falls_back: false,
            },
        };
        self.steps.insert((node, cause), step.clone());
        step
    }

    fn stepped(&self, after: &Node, outputs: &Outputs) -> TeamStep {
        let robot = after.robot.as_ref();
        let falls_back = outputs
            .iter()
            .any(|output| matches!(output, Output::FallBack(..)));
        let held = robot.map(|robot| {
            after.renamed(&mut Held {
                config: &self.setup.config,
                robot,
                holds_help: true,
            })
        });
        TeamStep {
            after: self
                .robots
                .nodes
                .number(held.unwrap_or_else(|| after.clone())),
            sends: self.robots.sends(after, outputs),
            falls_back,
        }
    }

    /// The state that stands for all that differ in names alone.
    fn canonicalize(&self, state: &mut TeamState) {
        let nodes = &mut state.nodes[..usize::from(self.team_size())];
        let messages = state.air.iter().map(|broadcast| broadcast.message);
        let sets = self.robots.name_sets(nodes, messages);
        let Some(renaming) = self.robots.renamings.of(sets) else {
            return;
        };
        self.robots.rename_nodes(nodes, renaming);
        for broadcast in &mut state.air {
            broadcast.message = self.robots.message_renamed(broadcast.message, renaming);
        }
    }
}

impl From<TeamState> for TickDraft {
    fn from(state: TeamState) -> Self {
        Self {
            chances: Chances::default(),
            state,
            falls_back: false,
        }
    }
}

/// The bit of the link of a robot to the leader; the leader has none.
const fn link(place: u8) -> u8 {
    1 << place >> 1
}

fn count(links: u8) -> u8 {
    u8::try_from(links.count_ones()).unwrap_or(u8::MAX)
}
