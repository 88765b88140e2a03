//! Runs that the paper's wording allows, for people who step through them.

use serde::Serialize;

use super::robot::{HelpStatus, PaperRobot};
use super::texts::Text;
use super::world::PaperWorld;
use super::{Counterexample, counterexamples};
use crate::sequence::ChartStep;

/// A run that brings a hazard about.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct PaperRun {
    /// What there is to say about it.
    #[serde(flatten)]
    pub text: Text,
    /// The robots' names.
    pub robots: Vec<&'static str>,
    /// What happens, in order.
    pub steps: Vec<ChartStep>,
    /// How many steps come before the steps that are repeated for ever, where the run is without end.
    pub repeats_after: Option<usize>,
    /// What each robot is doing at the start, and after each step.
    pub frames: Vec<Vec<PaperRobotFrame>>,
}

/// One robot in one state.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct PaperRobotFrame {
    /// The state of the paper's machine.
    pub state: String,
    /// Its side in that state; empty where it has none.
    pub role: &'static str,
    /// What its RAM says.
    pub words: String,
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
        let first = found.steps.first().map(|step| frame(&step.before));
        let later = found.steps.iter().map(|step| frame(&step.after));
        Self {
            text: found.text,
            robots: found.cast.names.to_vec(),
            steps: found.chart(),
            repeats_after: found.repeats_after(),
            frames: first.into_iter().chain(later).collect(),
        }
    }
}

fn frame(world: &PaperWorld) -> Vec<PaperRobotFrame> {
    let robots = world.robots.iter();
    robots
        .map(|robot| PaperRobotFrame::of(robot.as_ref()))
        .collect()
}

impl PaperRobotFrame {
    fn of(robot: Option<&PaperRobot>) -> Self {
        let Some(robot) = robot else {
            return Self {
                state: String::new(),
                role: "",
                words: "down".to_owned(),
                is_down: true,
            };
        };
        Self {
            state: format!("{:?}", robot.state),
            role: match robot.status {
                HelpStatus::None => "",
                HelpStatus::NeedHelp => "requester",
                HelpStatus::OfferHelp { .. } => "helper",
                HelpStatus::Leader { .. } => "leader",
                HelpStatus::Follower { .. } => "follower",
            },
            words: robot.ram().to_string(),
            is_down: false,
        }
    }
}
