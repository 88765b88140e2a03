//! The application of a robot: what moves its body, and what it does when it leads.

use std::collections::{BTreeMap, VecDeque};

use crossguard_codec::{RobotState, TaskParameters};
use crossguard_protocol::{Event, HelpRequest, Notice, StationId, TaskSet, TaskType, Urgency};

use crate::body::Body;
use crate::endpoint::Act;
use crate::site::{Place, Site};

/// What an application wants of its endpoint.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Wish {
    /// To tell this event.
    Tell(Event),
    /// To have a follower do something.
    Order {
        /// The follower.
        follower: StationId,
        /// The maneuver.
        task: TaskType,
        /// Where and how.
        parameters: TaskParameters,
    },
}

/// One step of a leader's plan.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Leg {
    /// The maneuver.
    pub task: TaskType,
    /// Where it leads.
    pub to: Place,
    /// How fast, in m/s.
    pub speed_mps: f64,
}

/// What a leader has its followers do: each goes through the legs, one after the other.
#[derive(Clone, PartialEq, Debug)]
pub struct Plan {
    /// Where it happens.
    pub site: Site,
    /// The legs.
    pub legs: Vec<Leg>,
}

impl Plan {
    /// The paper's crossing: the dog takes its place at the kerb, then escorts the pedestrian over
    /// the road. The escort is as long as the paper's, 21.6 s.
    #[must_use]
    pub fn crossing(site: Site) -> Self {
        let kerb = Place::new(1.0, -1.0);
        let other_side = Place::new(1.0, 8.0);
        Self {
            site,
            legs: vec![
                Leg {
                    task: TaskType::INITIAL_POS,
                    to: kerb,
                    speed_mps: 1.4,
                },
                Leg {
                    task: TaskType::MOVE,
                    to: other_side,
                    speed_mps: 0.424,
                },
            ],
        }
    }

    /// What a leader with this plan asks for.
    #[must_use]
    pub fn request(&self, followers: u8) -> HelpRequest {
        let tasks: Vec<_> = self.legs.iter().map(|leg| leg.task).collect();
        HelpRequest {
            urgency: Urgency::Medium,
            followers,
            tasks: TaskSet::of(&tasks),
        }
    }
}

/// How often a leg that failed is commanded again before the leader gives up.
const ATTEMPTS: u8 = 3;

/// The application of a robot: a simulated body, and a plan for when it leads.
#[derive(Debug)]
pub struct Application {
    body: Body,
    /// What it does when it leads; without one, somebody else tells it.
    plan: Option<Plan>,
    /// How far each follower is.
    progress: BTreeMap<StationId, Progress>,
    wishes: VecDeque<Wish>,
    at_s: f64,
}

#[derive(Clone, Copy, Debug, Default)]
struct Progress {
    leg: usize,
    attempts: u8,
}

impl Application {
    /// The application of a robot with this body.
    #[must_use]
    pub fn new(body: Body, plan: Option<Plan>) -> Self {
        let (progress, wishes) = (BTreeMap::new(), VecDeque::new());
        Self {
            body,
            plan,
            progress,
            wishes,
            at_s: 0.0,
        }
    }

    /// Lets time pass until `now_s`, in seconds on any clock that never goes back.
    pub fn advance(&mut self, now_s: f64) {
        let finished = self.body.advance((now_s - self.at_s).max(0.0));
        self.at_s = now_s;
        if let Some(id) = finished {
            self.wishes
                .push_back(Wish::Tell(Event::ManeuverCompleted(id)));
        }
    }

    /// What the sensors say.
    #[must_use]
    pub fn state(&self) -> RobotState {
        self.body.state()
    }

    /// The next thing that the application wants of its endpoint.
    pub fn next_wish(&mut self) -> Option<Wish> {
        self.wishes.pop_front()
    }

    /// Ends the motion of the body, whatever it is.
    pub fn stop(&mut self) {
        self.body.stop();
    }

    /// Carries the body back to where it began.
    pub fn reset(&mut self) {
        self.body.carry_to_safe_place();
    }

    /// Does what the endpoint says.
    pub fn act(&mut self, act: &Act) {
        match act {
            Act::Start(maneuver, parameters) => self.body.start(*maneuver, *parameters),
            Act::Stop(..) => self.body.stop(),
            Act::FallBack(_, policy) => self.body.fall_back(*policy),
            Act::Notice(notice) => self.notice(*notice),
            Act::OpenCorridor | Act::CloseCorridor(_) | Act::LockIdentity(_) | Act::Ignored(..) => {
            }
        }
    }

    /// Follows the plan when it leads.
    fn notice(&mut self, notice: Notice) {
        if self.plan.is_none() {
            return;
        }
        match notice {
            Notice::RolesEstablished(_) => self.progress.clear(),
            Notice::FollowerJoined(follower) => {
                self.progress.insert(follower, Progress::default());
                self.command(follower);
            }
            Notice::ManeuverReported(..) => self.wishes.push_back(Wish::Tell(Event::OpenCorridor)),
            Notice::ManeuverCompleted(follower, _) => {
                let progress = self.progress.entry(follower).or_default();
                *progress = Progress {
                    leg: progress.leg + 1,
                    attempts: 0,
                };
                self.command(follower);
            }
            Notice::ManeuverFailed(follower, ..)
            | Notice::FollowerSafeIdle(follower, _)
            | Notice::CommandRejected(follower, ..) => self.command(follower),
            Notice::FollowerGone(follower, _) => {
                self.progress.remove(&follower);
            }
            _ => {}
        }
    }

    /// Commands the follower's next leg, or ends the task when all are through.
    fn command(&mut self, follower: StationId) {
        let Some(plan) = &self.plan else { return };
        let Some(progress) = self.progress.get_mut(&follower) else {
            return;
        };
        match plan.legs.get(progress.leg) {
            Some(leg) if progress.attempts < ATTEMPTS => {
                progress.attempts += 1;
                let parameters = TaskParameters {
                    target: Some(plan.site.target(leg.to)),
                    maximum_speed: Some(leg.speed_mps),
                    ..TaskParameters::default()
                };
                self.wishes.push_back(Wish::Order {
                    follower,
                    task: leg.task,
                    parameters,
                });
            }
            Some(_) => self.wishes.push_back(Wish::Tell(Event::LeaveRequested)),
            None => {
                let legs = plan.legs.len();
                if self.progress.values().all(|progress| progress.leg >= legs) {
                    self.wishes.push_back(Wish::Tell(Event::TaskCompleted));
                }
            }
        }
    }
}
