//! The paper's text taken word for word, and why it is not enough.
//!
//! This is a model of the wording of *Multi-Robot Coordination in V2X Environments* (Arockiasamy,
//! Vinel; arXiv 2605.06662), not of the protocol that robots run: four states, `helpStatus` in RAM
//! without a session, `requestID` and `jobAdviceID` in RMCM, completion read from RAM, fallback to
//! Idle on a safety timeout, release by a RAM with `none`. It must fail, and [`check`] shows where.
//!
//! ```text
//!   robot ──► world ──► model ──► stateright ──► counterexamples ──┬──► report
//!     └─► road ─┘         ▲                           ▲            ├──► page (doc/paper-literal.md)
//!                       found: P0 to P12, W1 to W4, W7 texts       └──► story (stories/*.json)
//! ```
//!
//! With the road around it, bodies, a sign and a pedestrian, the same model shows what the wording means for
//! a person: the road properties that it breaks.
//!
//! Where the text leaves something open, the model takes the most literal reading:
//!
//! - an `offerHelp` names nobody, and a requester takes the first that it hears;
//! - a leader's RAM names its follower, a follower takes commands of the leader that named it, and
//!   each RMCM addressed to it is acknowledged and executed;
//! - an RMCM is sent once; nothing is said of repetition;
//! - an acknowledgement is for the outstanding command if the `jobAdviceID` is its `requestID`, and a
//!   leader counts `requestID`s from 0 in each task;
//! - the safety timeout of a follower is held off by RMCM, takes it to Idle, and stops its maneuver;
//! - a leader in `ManeuverExecuting` that hears `completed` from its follower takes its command as
//!   completed; nothing else in a follower's RAM changes a leader;
//! - on the road, a leader invites the pedestrian as long as it is in `ManeuverExecuting`, and a follower guards
//!   by what it executes, either at the pedestrian's side or from a place that it has to reach first;
//! - only a robot in Idle answers a `needHelp`; no time limit is given for any state.

mod found;
mod hazards;
mod model;
mod page;
mod road;
mod robot;
mod story;
mod texts;
mod world;

use std::time::Instant;

use stateright::{Checker, Model as _};

pub use hazards::Hazard;
pub use page::page;
pub use story::{Happening, Link, Party, Story, StoryMessage, StoryStep, stories};
pub use texts::Text;

use crate::cost::Meter;
use crate::report::{CheckVerdict, CutOff, PropertyReport, ScenarioReport};
use crate::transitions::Transitions;
use model::{Cast, PaperAction, Question};
use road::{Inquiry, Task};
use world::PaperWorld;

/// The name of the report.
pub const NAME: &str = "paper-literal";

/// What it is about, in one line.
pub const SUMMARY: &str =
    "the paper's text word for word; it must fail, and shows why each rule is there";

/// A humanoid and a robot dog: everything that two robots can do.
const PAIR: Cast = Cast {
    names: &["ARI", "Go2"],
    detecting: 2,
    detections: 2,
    commands: 2,
    crashes: 1,
    delay: true,
};

/// A second humanoid comes along; up to the roles.
const TRIO: Cast = Cast {
    names: &["ARI", "Go2", "NAO"],
    detecting: 2,
    detections: 2,
    commands: 0,
    crashes: 0,
    delay: false,
};

/// What it takes to let somebody cross, and everything that can happen meanwhile.
const CROSSING: Cast = Cast {
    commands: 1,
    ..PAIR
};

/// The same three, with a command each: two leaders of one helper.
const RIVALS: Cast = Cast {
    commands: 2,
    ..TRIO
};

/// A run that brings a hazard about, or breaks a property of the road.
struct Counterexample {
    text: Text,
    /// Somebody waits for ever: after the last step nothing happens any more.
    is_without_end: bool,
    cast: Cast,
    /// Each action with the world before and after it.
    steps: Vec<Transition>,
}

struct Transition {
    before: PaperWorld,
    action: PaperAction,
    after: PaperWorld,
}

/// What stateright found in one cast, of everything that can happen.
struct Exploration {
    unique_states: usize,
    transitions: usize,
    depth: usize,
    is_p0_broken: bool,
    is_crossing_found: bool,
}

/// Explores the model of the paper's wording.
///
/// It always explores everything: the model is small.
#[must_use]
pub fn check() -> ScenarioReport {
    let (start, meter) = (Instant::now(), Meter::start());
    let explored = [
        explore(PAIR, None),
        explore(TRIO, None),
        explore(CROSSING, Some(Task::Move)),
        explore(CROSSING, Some(Task::Block)),
    ];
    let (found, on_road) = (counterexamples(), broken_on_road());
    let is_p0_broken = explored.iter().any(|e| e.is_p0_broken);
    let sum = |count: fn(&Exploration) -> usize| explored.iter().map(count).sum();
    let is_crossing_found = explored.iter().any(|e| e.is_crossing_found);
    let mut properties = what_holds(is_p0_broken, is_crossing_found);
    properties.extend(Hazard::ALL.map(|hazard| {
        let kind = if hazard.is_without_end() { "L" } else { "S" };
        must_fail_report(hazard.text(), kind, &found)
    }));
    properties.extend(road::RoadProperty::ALL.map(|property| {
        let kind = if property.is_without_end() { "L" } else { "S" };
        must_fail_report(property.text(), kind, &on_road)
    }));
    ScenarioReport {
        name: NAME.to_owned(),
        summary: SUMMARY.to_owned(),
        robots: TRIO.names.iter().map(|&name| name.to_owned()).collect(),
        unique_states: sum(|e| e.unique_states),
        transitions: sum(|e| e.transitions),
        depth: explored.iter().map(|e| e.depth).max().unwrap_or(0),
        seconds: start.elapsed().as_secs_f64(),
        cost: meter.read(sum(|e| e.unique_states)),
        exhaustive: !is_p0_broken,
        // stateright stops when it has found all there is to be found.
        cut_off: is_p0_broken.then_some(CutOff::FoundBroken),
        size_as_expected: None,
        properties,
        figures: Vec::new(),
        assumptions: assumptions(),
        // It is another state diagram.
        transitions_taken: Transitions::default(),
    }
}

/// Whether the report is that of [`check`]; no scenario can have its properties.
#[must_use]
pub fn made(report: &ScenarioReport) -> bool {
    report.verdict(model::HOLDS).is_some()
}

/// Whether exactly P1 to P12 and the properties of the road are violated in a report of [`check`], as they
/// must be.
#[must_use]
pub fn fails_as_it_must(report: &ScenarioReport) -> bool {
    let fine = [model::HOLDS, model::PREMISE].map(|id| report.verdict(id))
        == [Some(CheckVerdict::Holds), Some(CheckVerdict::Reachable)];
    let hazards = Hazard::ALL.map(|hazard| hazard.text().id);
    let on_road = road::RoadProperty::ALL.map(|property| property.text().id);
    let must_fail = hazards.into_iter().chain(on_road);
    report.exhaustive && fine && report.violated().eq(must_fail)
}

/// P0 and its premise: the model is not one in which anything can happen, or nothing.
fn what_holds(is_p0_broken: bool, is_crossing_found: bool) -> Vec<PropertyReport> {
    let report = |id: &str, kind: &str, verdict, statement: &str| PropertyReport {
        id: id.to_owned(),
        kind: kind.to_owned(),
        verdict,
        statement: statement.to_owned(),
        counterexample: Vec::new(),
        repeats_after: None,
    };
    vec![
        report(
            model::HOLDS,
            "S",
            CheckVerdict::of_property(is_p0_broken, None),
            "a follower starts only what its leader commanded it",
        ),
        report(
            model::PREMISE,
            "premise",
            CheckVerdict::of_premise(is_crossing_found, None),
            "a crossing of two maneuvers goes well, and all robots are idle again",
        ),
    ]
}

fn must_fail_report(text: Text, kind: &str, found: &[Counterexample]) -> PropertyReport {
    let counterexample = found.iter().find(|found| found.text.id == text.id);
    PropertyReport {
        id: text.id.to_owned(),
        kind: kind.to_owned(),
        verdict: CheckVerdict::of_property(counterexample.is_some(), None),
        statement: text.statement.to_owned(),
        counterexample: counterexample.map_or_else(Vec::new, Counterexample::chart),
        repeats_after: counterexample.and_then(Counterexample::repeats_after),
    }
}

fn assumptions() -> Vec<String> {
    let mut assumptions = vec![
        "P1 to P12, W1 to W4 and W7 must be violated: each is why the protocol has a rule that the paper's text lacks"
            .to_owned(),
        "the paper's text as the kit's design retells it; what that leaves open is read literally"
            .to_owned(),
        "on the road: a leader invites the pedestrian as long as it is in ManeuverExecuting".to_owned(),
        "untimed: the safety timeout of a follower may run out at any moment".to_owned(),
    ];
    let casts = [
        ("", PAIR),
        ("", TRIO),
        ("on the road, ", CROSSING),
        ("on the road, ", RIVALS),
    ];
    for (place, cast) in casts {
        assumptions.push(format!(
            "{place}{}: at most {} detections, {} commands, {} breakdowns; {} RAM delayed at a time",
            cast.names.join(", "),
            cast.detections,
            cast.commands,
            cast.crashes,
            u8::from(cast.delay),
        ));
    }
    assumptions
}

fn explore(cast: Cast, guards: Option<Task>) -> Exploration {
    let road = guards.map(|task| Inquiry {
        task,
        property: None,
    });
    let question = Question {
        cast,
        hazard: None,
        road,
    };
    let checker = question.checker().spawn_bfs().join();
    Exploration {
        unique_states: checker.unique_state_count(),
        // What stateright counts has the initial state in it.
        transitions: checker.state_count() - 1,
        depth: checker.max_depth(),
        is_p0_broken: checker.discovery(model::HOLDS).is_some(),
        is_crossing_found: checker.discovery(model::PREMISE).is_some(),
    }
}

/// The shortest counterexample of each hazard that can be brought about, in order.
fn counterexamples() -> Vec<Counterexample> {
    Hazard::ALL.into_iter().filter_map(find).collect()
}

fn find(hazard: Hazard) -> Option<Counterexample> {
    let cast = match hazard {
        Hazard::P7 => TRIO,
        _ => PAIR,
    };
    let question = Question {
        cast,
        hazard: Some(hazard),
        road: None,
    };
    let text = hazard.text();
    Some(Counterexample {
        text,
        is_without_end: hazard.is_without_end(),
        cast,
        steps: shortest(question, text.id)?,
    })
}

/// The shortest run that breaks each property of the road, in order; W1 by either kind of guard.
fn broken_on_road() -> Vec<Counterexample> {
    use road::RoadProperty::{W1, W2, W3, W4, W7};
    let inquiries = [
        (W1, Task::Block),
        (W1, Task::Move),
        (W2, Task::Move),
        (W3, Task::Move),
        (W4, Task::Move),
        (W7, Task::Move),
    ];
    let found = inquiries.map(|(property, task)| find_on_road(property, task));
    found.into_iter().flatten().collect()
}

fn find_on_road(property: road::RoadProperty, task: Task) -> Option<Counterexample> {
    let cast = match property {
        road::RoadProperty::W3 => RIVALS,
        _ => CROSSING,
    };
    let question = Question {
        cast,
        hazard: None,
        road: Some(Inquiry {
            task,
            property: Some(property),
        }),
    };
    Some(Counterexample {
        text: texts::on_road(property, task),
        is_without_end: property.is_without_end(),
        cast,
        steps: shortest(question, model::ON_ROAD)?,
    })
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
    /// Where it is that somebody waits for ever: after the last step nothing happens any more.
    fn repeats_after(&self) -> Option<usize> {
        self.is_without_end.then_some(self.steps.len())
    }
}
