//! The paper's text as it stands, and why it is not enough.
//!
//! This is a model of the text of *Multi-Robot Coordination in V2X Environments* (Arockiasamy,
//! Vinel; arXiv 2605.06662), not of the protocol that robots run. It must fail, and [`check`] shows where. Each
//! [`Hazard`] says whether the text states it, is silent, or can be read in two ways, and in which paragraph.
//!
//! ```text
//!   robot ──► world ──► model ──► stateright ──► counterexamples ──┬──► report
//!     └─► road ─┘         ▲                           ▲            └──► runs (studio, doc/paper-literal.md)
//!                       found: P0 to P14, W1 to W4, W7 texts
//! ```
//!
//! The model does what the text says, which `doc/paper.md` tells by paragraph. Where the text is silent or can be read in two
//! ways, the model does no more than the text says; `doc/paper-literal.md` lists these points.
//!
//! A [`Reading`] that says more in one of them is checked too, and the page tells what it changes.

mod beside;
mod chart;
mod found;
mod hazards;
mod model;
mod readings;
mod road;
mod robot;
mod shown;
mod texts;
mod world;

use std::time::Instant;

use stateright::{Checker, Model as _};

pub use beside::KitRun;
pub use hazards::{Hazard, HazardKind, Passage};
pub use readings::{OtherReading, Reading};
pub use shown::{PaperFrame, PaperRobotFrame, PaperRun, runs};
pub use texts::Text;

use crate::by_stateright::steps;
use crate::report::{CheckVerdict, CutOff, PropertyReport, ScenarioReport};
use crate::scenario::Size;
use model::{Cast, PaperAction, Question};
use robot::PaperTask;
use world::PaperWorld;

/// The name of the report.
pub const NAME: &str = "paper-literal";

/// Its subject, in one line.
pub const SUMMARY: &str =
    "the paper's text as it stands; it must fail, and shows why each rule is there";

/// The proof of concept: into the lead position, then along with the pedestrian.
const ESCORT: &[PaperTask] = &[PaperTask::InitialPos, PaperTask::Move];
/// The two-humanoid deployment: into the place, then block.
const BLOCK: &[PaperTask] = &[PaperTask::InitialPos, PaperTask::Block];

/// A humanoid and a robot dog: everything that two robots can do in one association.
const PAIR: Cast = Cast {
    names: &["ARI", "Go2"],
    detecting: 1,
    detections: 1,
    plan: BLOCK,
    commands: 2,
    crashes: 1,
    faults: true,
    delay: true,
};

/// The same two, with two requests and tasks of one maneuver.
const SHORT: Cast = Cast {
    detecting: 2,
    detections: 2,
    plan: &[PaperTask::Move],
    crashes: 0,
    ..PAIR
};

/// The same, with RAM that are current.
const CURRENT: Cast = Cast {
    delay: false,
    ..SHORT
};

/// A second humanoid comes along; up to the roles.
const TRIO: Cast = Cast {
    names: &["ARI", "Go2", "NAO"],
    plan: ESCORT,
    commands: 0,
    ..CURRENT
};

/// A person is escorted across.
const ESCORTED: Cast = Cast {
    plan: ESCORT,
    ..PAIR
};

/// Two robots see somebody, and none breaks down.
const ESCORTED_TWICE: Cast = Cast {
    detecting: 2,
    detections: 2,
    crashes: 0,
    ..ESCORTED
};

/// Two teams of two at one crossing, on a good day.
const TEAMS: Cast = Cast {
    names: &["ARI", "Go2", "NAO", "Spot"],
    plan: &[PaperTask::Block],
    faults: false,
    ..CURRENT
};

/// A run that brings a hazard about.
struct Counterexample {
    text: &'static Text,
    /// A robot or person waits for ever: after the last step nothing happens any more.
    is_without_end: bool,
    cast: Cast,
    steps: Vec<Transition>,
}

struct Transition {
    before: PaperWorld,
    action: PaperAction,
    after: PaperWorld,
}

/// Result of stateright's full exploration of one cast.
struct Exploration {
    size: Size,
    transitions: usize,
    /// The ids of the broken properties, and of the premises that are met.
    found: Vec<&'static str>,
}

/// Explores the model of the paper's wording.
///
/// It always explores everything: the model is small.
#[must_use]
pub fn check() -> ScenarioReport {
    let start = Instant::now();
    let explored = [explore(PAIR), explore(CURRENT), explore(TRIO)];
    let found = counterexamples();
    let is_found = |id: &str| explored.iter().any(|it| it.found.contains(&id));
    let sum = |count: fn(&Exploration) -> usize| explored.iter().map(count).sum();
    // P0 and its premise, since the model is not one in which anything can happen, or nothing; and P10.
    #[rustfmt::skip]
    let holds = [
        (model::HOLDS, "S", "a follower starts only what its leader commanded it"),
        (model::PREMISE, "premise", "a crossing of two maneuvers goes well, and all robots are idle again"),
        (model::CLOSED, "L", "no leader waits for ever for a follower that is there and follows it"),
    ];
    let holds = holds.map(|(id, kind, statement)| {
        let verdict = if id == model::PREMISE {
            CheckVerdict::of_premise(is_found(id), None)
        } else {
            CheckVerdict::of_property(is_found(id), None)
        };
        PropertyReport::plain(id, kind, verdict, statement)
    });
    let must_fail = Hazard::ALL.map(|hazard| must_fail_report(hazard, &found));
    // Every cast is a beginning of this one.
    let robots = TEAMS.names.iter().map(|&name| name.to_owned()).collect();
    let size = Size {
        unique_states: sum(|it| it.size.unique_states),
        depth: explored.iter().map(|it| it.size.depth).max().unwrap_or(0),
    };
    // stateright stops when it has found all there is to be found.
    let is_broken = is_found(model::HOLDS) || is_found(model::CLOSED);
    let cut_off = is_broken.then_some(CutOff::FoundBroken);
    ScenarioReport {
        transitions: sum(|it| it.transitions),
        seconds: start.elapsed().as_secs_f64(),
        engines: vec![crate::report::STATERIGHT],
        properties: holds.into_iter().chain(must_fail).collect(),
        assumptions: assumptions(),
        ..ScenarioReport::of(NAME, SUMMARY, robots, size, cut_off)
    }
}

/// Whether the report is that of [`check`]; no scenario can have its properties.
#[must_use]
pub fn made(report: &ScenarioReport) -> bool {
    report.verdict(model::HOLDS).is_some()
}

/// Whether exactly the hazards are violated in a report of [`check`], as they must be.
#[must_use]
pub fn fails_as_it_must(report: &ScenarioReport) -> bool {
    let verdicts = [model::HOLDS, model::CLOSED, model::PREMISE].map(|id| report.verdict(id));
    let holds = Some(CheckVerdict::Holds);
    let fine = verdicts == [holds, holds, Some(CheckVerdict::Reachable)];
    let must_fail = Hazard::ALL.map(|hazard| hazard.text().id.as_str());
    report.exhaustive && fine && report.violated().eq(must_fail)
}

fn must_fail_report(hazard: Hazard, found: &[Counterexample]) -> PropertyReport {
    let text = hazard.text();
    let kind = if hazard.is_without_end() { "L" } else { "S" };
    let counterexample = found.iter().find(|found| found.text.id == text.id);
    let verdict = CheckVerdict::of_property(counterexample.is_some(), None);
    PropertyReport {
        counterexample: counterexample.map_or_else(Vec::new, Counterexample::chart),
        repeats_after: counterexample.and_then(Counterexample::repeats_after),
        ..PropertyReport::plain(&text.id, kind, verdict, &text.statement)
    }
}

fn assumptions() -> Vec<String> {
    let mut assumptions = vec![
        "P1 to P9, P11 to P14, W1 to W4 and W7 must be violated: each is why the protocol has a rule that the paper's text lacks"
            .to_owned(),
        "P10 holds: the text closes it, if the leader's application reissues what it may".to_owned(),
        "where the text is silent or ambiguous, the model does no more than it says".to_owned(),
        "on the road: a pedestrian goes with an escort that moves, or while a leader executes a `block`".to_owned(),
        "untimed: the safety timeout of a follower may run out at any moment".to_owned(),
    ];
    let casts = [
        ("", PAIR),
        ("", SHORT),
        ("", CURRENT),
        ("", TRIO),
        ("on the road, ", ESCORTED),
        ("on the road, ", TEAMS),
    ];
    for (place, cast) in casts {
        let plan: Vec<_> = cast.plan.iter().map(PaperTask::to_string).collect();
        assumptions.push(format!(
            "{place}{}, {}: at most {} detections, {} commands, {} breakdowns; {} RAM delayed at a time",
            cast.names.join(", "),
            plan.join(" and "),
            cast.detections,
            cast.commands,
            cast.crashes,
            u8::from(cast.delay),
        ));
    }
    assumptions
}

fn explore(cast: Cast) -> Exploration {
    let question = Question {
        cast,
        reading: Reading::Literal,
        about: None,
    };
    let checker = question.checker().spawn_bfs().join();
    Exploration {
        size: Size {
            unique_states: checker.unique_state_count(),
            depth: steps(&checker),
        },
        // stateright counts the initial state.
        transitions: checker.state_count() - 1,
        found: checker.discoveries().into_keys().collect(),
    }
}

/// The shortest counterexample of each hazard that can be brought about, in order; of W1 by either kind of guard.
fn counterexamples() -> Vec<Counterexample> {
    let in_casts = |hazard| {
        let casts = casts(hazard).iter();
        casts.filter_map(move |cast| find(hazard, *cast, Reading::Literal))
    };
    Hazard::ALL.into_iter().flat_map(in_casts).collect()
}

const fn casts(hazard: Hazard) -> &'static [Cast] {
    use Hazard::{P3, P4, P5, P6, P7, P11, W1, W2, W3, W4, W7};
    match hazard {
        P3 | P4 | P5 | P6 => &[SHORT],
        P7 => &[TRIO],
        P11 => &[CURRENT],
        W1 => &[ESCORTED, PAIR],
        W2 => &[ESCORTED],
        W3 => &[TEAMS],
        W4 | W7 => &[ESCORTED_TWICE],
        _ => &[PAIR],
    }
}

/// The shortest run that brings a hazard about in a reading.
fn find(hazard: Hazard, cast: Cast, reading: Reading) -> Option<Counterexample> {
    let text = hazard.text_beside(cast.plan.contains(&PaperTask::Move));
    let question = Question {
        cast,
        reading,
        about: Some(hazard),
    };
    Some(Counterexample {
        text,
        is_without_end: hazard.is_without_end(),
        cast,
        steps: shortest(question, &text.id)?,
    })
}

/// Whether the checker finds a hazard in a reading of the text.
#[must_use]
pub fn is_found_in(hazard: Hazard, reading: Reading) -> bool {
    let mut casts = casts(hazard).iter();
    casts.any(|cast| find(hazard, *cast, reading).is_some())
}

/// The shortest run that breaks what is asked for.
fn shortest(question: Question, name: &'static str) -> Option<Vec<Transition>> {
    // One thread: of equally short counterexamples it always finds the same.
    let checker = question.checker().threads(1).spawn_bfs().join();
    let path = checker.discovery(name)?.into_vec();
    let transition = |pair: &[(PaperWorld, Option<PaperAction>)]| {
        Some(Transition {
            before: pair[0].0.clone(),
            action: pair[0].1?,
            after: pair[1].0.clone(),
        })
    };
    Some(path.windows(2).filter_map(transition).collect())
}

impl Counterexample {
    /// Where somebody waits for ever: after the last step nothing happens any more.
    fn repeats_after(&self) -> Option<usize> {
        self.is_without_end.then_some(self.steps.len())
    }
}
