//! Where cases come from: everything that the tester can do is done in every situation that the kit's own robot can be
//! brought into, in virtual time, and the cases that meet a statement in a situation of its own are kept.
//!
//! ```text
//!   situation ──► each play ──► exchange ──► where are which statements met? ──► the fewest cases that meet all of them
//!       ▲             │
//!       └─ new ones ──┘
//! ```
//!
//! The transition function only says how situations are reached. What a robot must do there is said by the
//! [statements](crate::statements), which do not know it.

use std::collections::{BTreeSet, VecDeque};

use crossguard_protocol::{Config, StationId};

use crate::bench::Bench;
use crate::case::{Case, Table};
use crate::in_process::Reference;
use crate::perform::Performed;
use crate::play::{Play, Span};
use crate::statements::Statement;
use crate::station::Beating;

/// The robot that cases are generated with.
const ROBOT: StationId = StationId(1);

/// How many plays a case has at most.
const PLAYS_MAX: usize = 8;

/// How many situations are looked at.
const SITUATIONS_MAX: usize = 2_500;

/// A statement, met in a situation.
type Edge = (&'static str, String);

/// A way into a situation, and what was met on it.
#[derive(Clone)]
struct Candidate {
    plays: Vec<Play>,
    edges: BTreeSet<Edge>,
    ms: u64,
}

/// What was found in generating.
#[derive(Clone, Debug)]
pub struct Generated {
    /// The cases, in the order in which they are to be played.
    pub cases: Vec<Case>,
    /// How many situations were reached.
    pub situations: usize,
    /// How many statements in situations they meet.
    pub edges: usize,
    /// Statements that the kit's own robot broke: none, or the statement is wrong.
    pub broken: Vec<String>,
}

/// Generates the cases.
///
/// # Panics
/// Never: a robot in this process is never gone.
#[must_use]
pub fn generate() -> Generated {
    let subject = Reference::reference(ROBOT, Config::default());
    let table = Table::in_process(ROBOT);
    let terms = table.terms.clone();
    let mut bench = Bench::new(subject, table);
    bench.generates = true;
    bench.pass(1_100).expect("it is here");
    let statements = Statement::all();
    let mut broken = Vec::new();
    let mut candidates = Vec::new();
    let mut seen: BTreeSet<String> = [bench.key()].into_iter().collect();
    let mut todo: VecDeque<(Bench<Reference>, Vec<Play>)> = VecDeque::new();
    todo.push_back((bench, Vec::new()));
    while let Some((bench, plays)) = todo.pop_front() {
        for play in Play::all() {
            if !is_sensible(&plays, play) {
                continue;
            }
            let mut after = bench.clone();
            let performed = after.perform(play, true).expect("it is here");
            if performed == Performed::OutOfPlace || after.not_told.is_some() {
                continue;
            }
            let mut way = plays.clone();
            way.push(play);
            let mut edges = BTreeSet::new();
            for statement in &statements {
                for met in statement.judge(&after.exchange, &terms) {
                    if let Some(how) = met.broken {
                        let words: Vec<_> = way.iter().map(|play| play.words()).collect();
                        broken.push(format!("{}: {how}: {}", statement.name, words.join("; ")));
                    }
                    edges.insert((statement.name, met.situation));
                }
            }
            let begun = after.exchange.seen.first().map_or(0, |seen| seen.at_ms);
            candidates.push(Candidate {
                plays: way.clone(),
                edges,
                ms: after.exchange.ended_ms - begun,
            });
            if leads_on(play)
                && way.len() < PLAYS_MAX
                && seen.len() < SITUATIONS_MAX
                && seen.insert(after.key())
            {
                todo.push_back((after, way));
            }
        }
    }
    let cases = cover(candidates);
    Generated {
        edges: cases.iter().map(|(_, new)| new.len()).sum(),
        cases: cases.into_iter().map(|(case, _)| case).collect(),
        situations: seen.len(),
        broken,
    }
}

/// Whether there is a point in doing this after that: a timer is waited for once, and where it runs.
fn is_sensible(plays: &[Play], next: Play) -> bool {
    use Play as P;
    let last = plays.last().copied();
    let waits = plays.iter().any(|play| matches!(play, P::Wait(_)));
    match next {
        P::Wait(Span::Farewell) => {
            matches!(last, Some(P::EndCompleted | P::Leave | P::TaskCompleted))
        }
        P::Wait(Span::Help) => last == Some(P::Detect) && plays.len() == 1,
        P::Wait(Span::Repeats) => matches!(last, Some(P::OrderMove)) && !waits,
        P::Wait(_) => matches!(last, Some(P::Beat(beating)) if beating != Beating::Newer) && !waits,
        P::Beat(Beating::Newer) => plays.iter().any(|play| matches!(play, P::Beat(_))),
        P::Beat(_) => !waits && !plays.iter().any(|play| matches!(play, P::Beat(_))),
        P::Restart => !plays.is_empty() && !plays.contains(&P::Restart),
        P::BoSpeaks => plays.is_empty(),
        P::LowBattery | P::LocalFault => !plays.contains(&P::LowBattery),
        next => last != Some(next),
    }
}

/// Whether what comes after this is looked at: it leads into a situation that others build on.
const fn leads_on(play: Play) -> bool {
    use Play as P;
    matches!(
        play,
        P::Ask
            | P::Confirm
            | P::CommandMove
            | P::CommandBlock
            | P::CommandInitialPos
            | P::EndCompleted
            | P::EndAborted
            | P::Beat(_)
            | P::Wait(Span::Safety | Span::Offer)
            | P::BoSpeaks
            | P::Offer
            | P::BoOffers
            | P::Join
            | P::BoJoins
            | P::Ack
            | P::ReportExecuting
            | P::ReportInPosition
            | P::Restart
            | P::Detect
            | P::DetectTwo
            | P::OrderMove
            | P::OrderBlock
            | P::OrderInitialPos
            | P::Done
            | P::Fail
            | P::Open
            | P::Leave
            | P::TaskCompleted
            | P::LowBattery
    )
}

/// Few cases that meet every edge: first those in which nothing is told to the robot, since every robot can be tested
/// by them.
fn cover(mut candidates: Vec<Candidate>) -> Vec<(Case, BTreeSet<Edge>)> {
    let is_told = |candidate: &Candidate| {
        let mut plays = candidate.plays.iter();
        plays.any(|play| play.local(StationId(0)).is_some() || *play == Play::Restart)
    };
    candidates.sort_by(|a, b| (is_told(a), a.ms, &a.plays).cmp(&(is_told(b), b.ms, &b.plays)));
    let (told, untold): (Vec<_>, Vec<_>) = candidates.into_iter().partition(is_told);
    let mut met: BTreeSet<Edge> = BTreeSet::new();
    let mut cases = Vec::new();
    for mut candidates in [untold, told] {
        loop {
            let mut best: Option<(usize, f64)> = None;
            for (i, candidate) in candidates.iter_mut().enumerate() {
                candidate.edges.retain(|edge| !met.contains(edge));
                #[expect(clippy::cast_precision_loss, reason = "small numbers")]
                let worth = candidate.edges.len() as f64 / (candidate.ms as f64 + 500.0);
                if !candidate.edges.is_empty() && best.is_none_or(|(_, most)| worth > most) {
                    best = Some((i, worth));
                }
            }
            let Some((i, _)) = best else { break };
            let chosen = candidates.swap_remove(i);
            met.extend(chosen.edges.iter().cloned());
            let statements: BTreeSet<&str> = chosen.edges.iter().map(|(name, _)| *name).collect();
            let case = Case {
                plays: chosen.plays,
                statements: statements.into_iter().map(str::to_owned).collect(),
            };
            cases.push((case, chosen.edges));
        }
    }
    cases
}
