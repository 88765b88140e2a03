//! Runs that the paper's wording allows, for people who step through them.

use serde::Serialize;

use super::beside::KitRun;
use super::road::Road;
use super::robot::{HelpStatus, RobotIndex};
use super::texts::Text;
use super::world::PaperWorld;
use super::{Counterexample, counterexamples};
use crate::sequence::ChartStep;
use crate::walk::{BodyFrame, PersonFrame};

/// A run that brings a hazard about.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct PaperRun {
    /// Texts on its hazard.
    #[serde(flatten)]
    pub text: &'static Text,
    /// The robots' names.
    pub robots: Vec<&'static str>,
    /// Its steps, in order.
    pub steps: Vec<ChartStep>,
    /// How many steps come before the steps that are repeated for ever, where the run is without end.
    pub repeats_after: Option<usize>,
    /// Frames at the start, and after each step.
    pub frames: Vec<PaperFrame>,
    /// The kit in the same story; `None` where no run of it is kept.
    pub beside: Option<KitRun>,
}

/// Robots and person in one state.
#[derive(Clone, Debug, Serialize)]
pub struct PaperFrame {
    /// The robots, in the order of their places.
    pub robots: Vec<PaperRobotFrame>,
    /// The person at the crossing; `None` where the run asks nothing about the road.
    pub person: Option<PersonFrame>,
}

/// One robot in one state.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct PaperRobotFrame {
    /// The state of the paper's machine.
    pub state: String,
    /// Its side in that state; empty where it has none.
    pub role: &'static str,
    /// Content of its RAM, in words.
    pub words: String,
    /// Activity of its body; parked where the run asks nothing about the road.
    pub body: BodyFrame,
    /// The same, in words.
    pub body_words: &'static str,
    /// Whether its body guards who is on the road, or would: an escort only while its leader stops the traffic.
    pub guards: bool,
    /// Whether people go at its word. The paper has no sign, so nothing shows stop.
    pub shows_go: bool,
    /// Whether it has broken down.
    pub is_down: bool,
}

/// The shortest run of each hazard that the paper's wording lets happen.
#[must_use]
pub fn runs() -> Vec<PaperRun> {
    counterexamples().iter().map(PaperRun::of).collect()
}

impl PaperRun {
    fn of(found: &Counterexample) -> Self {
        let first = found.steps.first().map(|step| PaperFrame::of(&step.before));
        let later = found.steps.iter().map(|step| PaperFrame::of(&step.after));
        Self {
            text: found.text,
            robots: found.cast.names.to_vec(),
            steps: found.chart(),
            repeats_after: found.repeats_after(),
            frames: first.into_iter().chain(later).collect(),
            beside: KitRun::beside(found),
        }
    }
}

impl PaperFrame {
    fn of(world: &PaperWorld) -> Self {
        let places = 0..world.robots.len();
        Self {
            robots: places.map(|it| PaperRobotFrame::of(world, it)).collect(),
            person: world.road.as_ref().map(Road::person),
        }
    }
}

impl PaperRobotFrame {
    fn of(world: &PaperWorld, place: RobotIndex) -> Self {
        let road = world.road.as_ref();
        let body = road.map_or(BodyFrame::Parked, |road| road.body(place));
        let guards = road.is_some_and(|road| road.guards(place, &world.robots));
        let robot = world.robot(place);
        Self {
            state: robot.map_or_else(String::new, |robot| format!("{:?}", robot.state)),
            role: robot.map_or("", |robot| match robot.status {
                HelpStatus::None => "",
                HelpStatus::NeedHelp => "requester",
                HelpStatus::OfferHelp { .. } => "helper",
                HelpStatus::Leader { .. } => "leader",
                HelpStatus::Follower { .. } => "follower",
            }),
            words: robot.map_or_else(|| "down".to_owned(), |robot| robot.ram().to_string()),
            body,
            body_words: match body {
                BodyFrame::Parked => "is parked",
                BodyFrame::UnderWay => "is under way",
                BodyFrame::InPosition if guards => "guards",
                BodyFrame::InPosition => "goes with the pedestrian, and nobody stops the traffic",
                BodyFrame::FallingBack => "goes to its safe idle position",
                BodyFrame::Ended => "has ended its maneuver",
            },
            guards,
            shows_go: road.is_some_and(|it| it.told_to_go(world.inviting()).contains(&place)),
            is_down: robot.is_none(),
        }
    }
}
