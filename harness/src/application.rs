//! The application of a robot: what moves its body, and what it does when it leads.

use std::collections::{BTreeMap, VecDeque};

use crossguard_codec::{RobotState, TaskParameters};
use crossguard_protocol::{Event, Notice, StationId, TaskType};

use crate::body::{Body, Pose};
use crate::endpoint::Act;
use crate::plan::{Leg, Plan};

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

/// How often a leg that failed is commanded again before the leader gives up.
const ATTEMPTS: u8 = 3;

/// How often a leader tries to open a corridor that did not open, in seconds.
const OPENING_PERIOD_S: f64 = 0.5;

/// The longest list of wishes; more are not kept.
const WISHES: usize = 64;

/// The application of a robot: a simulated body, and a plan for when it leads.
#[derive(Debug)]
pub struct Application {
    body: Body,
    /// What it does when it leads; without one, somebody else tells it.
    plan: Option<Plan>,
    /// How its plan goes while it leads.
    errand: Option<Errand>,
    wishes: VecDeque<Wish>,
    at_s: f64,
}

/// How a plan goes.
#[derive(Debug, Default)]
struct Errand {
    stage: usize,
    /// How far each follower is with its part of the stage.
    followers: BTreeMap<StationId, Part>,
    /// Since when the corridor is open, in seconds.
    open_since: Option<f64>,
    /// When the corridor was to be opened last.
    tried_s: f64,
    since_s: f64,
}

#[derive(Clone, Copy, PartialEq, Debug)]
enum Part {
    /// Commanded so often; not begun, or under way.
    Commanded(u8),
    /// Goes on until it is ended.
    Holds,
    /// Done, or nothing to do.
    Done,
}

impl Application {
    /// The application of a robot with this body.
    #[must_use]
    pub fn new(body: Body, plan: Option<Plan>) -> Self {
        Self {
            body,
            plan,
            errand: None,
            wishes: VecDeque::new(),
            at_s: 0.0,
        }
    }

    /// Lets time pass until `now_s`, in seconds on any clock that never goes back.
    pub fn advance(&mut self, now_s: f64) {
        let finished = self.body.advance((now_s - self.at_s).max(0.0));
        self.at_s = now_s;
        if let Some(id) = finished {
            self.wish(Wish::Tell(Event::ManeuverCompleted(id)));
        }
        self.lead_on();
    }

    /// What the sensors say.
    #[must_use]
    pub fn state(&self) -> RobotState {
        self.body.state()
    }

    /// The body.
    #[must_use]
    pub const fn body(&self) -> &Body {
        &self.body
    }

    /// The next thing that the application wants of its endpoint.
    pub fn next_wish(&mut self) -> Option<Wish> {
        self.wishes.pop_front()
    }

    fn wish(&mut self, wish: Wish) {
        if self.wishes.len() < WISHES {
            self.wishes.push_back(wish);
        }
    }

    /// Ends the motion of the body, whatever it is.
    pub fn stop(&mut self) {
        self.body.stop();
    }

    /// Others say where the body is.
    pub fn moved(&mut self, pose: Pose) {
        self.body.moved(pose);
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
            Act::OpenCorridor => self.corridor(Some(self.at_s)),
            Act::CloseCorridor(_) => self.corridor(None),
            Act::LockIdentity(_) | Act::Ignored(..) => {}
        }
    }

    fn corridor(&mut self, open_since: Option<f64>) {
        if let Some(errand) = &mut self.errand {
            errand.open_since = open_since;
        }
    }

    /// Follows the plan when it leads.
    fn notice(&mut self, notice: Notice) {
        if let (Notice::RolesEstablished(_), Some(plan)) = (notice, &self.plan) {
            if let Some(place) = plan.own_place {
                self.body.walk_to(place);
            }
            self.errand = Some(Errand {
                since_s: self.at_s,
                ..Errand::default()
            });
        }
        if self.errand.is_none() {
            return;
        }
        match notice {
            Notice::FollowerJoined(follower) => self.begin_part(follower),
            Notice::ManeuverReported(follower, _) => self.report(follower),
            Notice::ManeuverCompleted(follower, _) => self.set(follower, Part::Done),
            Notice::ManeuverFailed(follower, ..)
            | Notice::FollowerSafeIdle(follower, _)
            | Notice::CommandRejected(follower, ..) => self.command(follower),
            Notice::FollowerGone(follower, _) => self.miss(follower),
            Notice::SessionEnded(..) => self.errand = None,
            _ => {}
        }
        self.finish_stage();
    }

    /// The follower's leg of this stage.
    fn leg(&self, follower: StationId) -> Option<Leg> {
        let (plan, errand) = (self.plan.as_ref()?, self.errand.as_ref()?);
        plan.stages.get(errand.stage)?.leg(follower)
    }

    fn set(&mut self, follower: StationId, part: Part) {
        if let Some(errand) = &mut self.errand {
            errand.followers.insert(follower, part);
        }
    }

    fn begin_part(&mut self, follower: StationId) {
        self.set(follower, Part::Commanded(0));
        self.command(follower);
    }

    fn report(&mut self, follower: StationId) {
        let is_block = self
            .leg(follower)
            .is_some_and(|leg| leg.task == TaskType::BLOCK);
        if is_block {
            self.set(follower, Part::Holds);
        }
        self.open_corridor();
    }

    fn open_corridor(&mut self) {
        if let Some(errand) = &mut self.errand {
            errand.tried_s = self.at_s;
            self.wish(Wish::Tell(Event::OpenCorridor));
        }
    }

    /// A follower is gone, and with it a part of the plan that nobody else does.
    fn miss(&mut self, follower: StationId) {
        if let Some(errand) = &mut self.errand {
            errand.followers.remove(&follower);
            if !errand.followers.is_empty() {
                self.wish(Wish::Tell(Event::LeaveRequested));
            }
        }
    }

    /// Commands the follower's leg, again if it failed; in the end the leader gives up.
    fn command(&mut self, follower: StationId) {
        let Some(leg) = self.leg(follower) else {
            return self.set(follower, Part::Done);
        };
        let (Some(plan), Some(errand)) = (&self.plan, &mut self.errand) else {
            return;
        };
        let attempts = match errand.followers.get(&follower) {
            Some(Part::Commanded(attempts)) => *attempts,
            // A part that was begun well has all its attempts before it.
            Some(Part::Holds | Part::Done) => 0,
            None => return,
        };
        if attempts >= ATTEMPTS {
            return self.wish(Wish::Tell(Event::LeaveRequested));
        }
        errand
            .followers
            .insert(follower, Part::Commanded(attempts + 1));
        let parameters = TaskParameters {
            target: Some(plan.site.target(leg.to)),
            maximum_speed: Some(leg.speed_mps),
            ..TaskParameters::default()
        };
        self.wish(Wish::Order {
            follower,
            task: leg.task,
            parameters,
        });
    }

    /// Goes on to the next stage when every follower has done its part or holds it.
    fn finish_stage(&mut self) {
        let (Some(plan), Some(errand)) = (&self.plan, &mut self.errand) else {
            return;
        };
        let is_ready = |part: &Part| !matches!(part, Part::Commanded(_));
        let everybody = errand.followers.len() >= usize::from(plan.followers);
        if !everybody || !errand.followers.values().all(is_ready) {
            return;
        }
        if errand.stage + 1 < plan.stages.len() {
            errand.stage += 1;
            let followers: Vec<_> = errand.followers.keys().copied().collect();
            for follower in followers {
                // Whoever holds goes on holding unless the stage has something else for it.
                if self.leg(follower).is_some() {
                    self.begin_part(follower);
                }
            }
        } else if !errand.followers.values().any(|part| *part == Part::Holds)
            || plan.is_escort(errand.stage)
        {
            self.wish(Wish::Tell(Event::TaskCompleted));
        }
    }

    /// What a leader does by the clock: it opens the corridor when it did not open before, ends the
    /// task when the pedestrian has had the time to cross, and gives up in the end.
    fn lead_on(&mut self) {
        let (Some(plan), Some(errand)) = (&self.plan, &self.errand) else {
            return;
        };
        let in_own_time = |seconds: f64| seconds * self.body.time_scale();
        let is_last = errand.stage + 1 >= plan.stages.len();
        match errand.open_since {
            _ if self.at_s - errand.since_s > plan.patience_s => {
                self.errand = None;
                self.wish(Wish::Tell(Event::LeaveRequested));
            }
            Some(since)
                if is_last
                    && !plan.is_escort(errand.stage)
                    && in_own_time(self.at_s - since) >= plan.crossing_s =>
            {
                self.wish(Wish::Tell(Event::TaskCompleted));
            }
            None if is_last && self.at_s - errand.tried_s >= OPENING_PERIOD_S => {
                self.open_corridor();
            }
            _ => {}
        }
    }
}
