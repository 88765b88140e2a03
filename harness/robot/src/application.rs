//! The application of a robot: what moves its body, and what it does when it leads.

mod bodily;
mod detection;
mod errand;
mod traits;
mod whereabouts;

use std::collections::VecDeque;

use crossguard_endpoint::{Act, Stimulus};
use crossguard_protocol::{
    Availability, Config, Corridor, Duty, Event, Maneuver, ManeuverId, Phase, Robot, TaskSet,
    Unavailability,
};

use self::bodily::Bodily;
use self::detection::Detection;
use self::errand::Errand;
pub use self::traits::Traits;
use crate::body::{Body, BodyAct, Fallback, Report};
use crate::plan::Plan;
use crate::sight::Outline;
use crate::sign::{Shown, Sign};
use crate::site::Site;
use crate::street::Road;

/// The longest list of wishes; more are not kept.
const WISHES: usize = 64;

/// The application of a robot: a body, a sign, and a plan for when it leads.
#[derive(Debug)]
pub struct Application {
    body: Box<dyn Body>,
    /// What people see while it leads.
    sign: Sign,
    /// What its robot's RAM say that it shows to people.
    shown: Shown,
    /// Whether its robot leads, so that people look at its sign.
    leads: bool,
    /// What it knows of the people on the road.
    road: Road,
    site: Site,
    detection: Detection,
    traits: Traits,
    availability: Availability,
    /// Whether its body is there, and what was wrong with it.
    bodily: Bodily,
    /// Whether it is unavailable because its battery was found to be low.
    was_low: bool,
    /// What its robot still has to do on the road.
    obligation: Option<Obligation>,
    /// What the body was told to do last, until that is over.
    maneuver: Option<Maneuver>,
    /// A guarding maneuver that the body has finished before the people that it guards are off the road.
    waits_for_people: Option<ManeuverId>,
    /// What it does when it leads; without one, somebody else tells it.
    plan: Option<Plan>,
    /// How its plan goes while it leads.
    errand: Option<Errand>,
    wishes: VecDeque<Stimulus<'static>>,
    rules: Rules,
    /// Whether its corridor is known to be clear.
    corridor: Corridor,
    at_s: f64,
}

/// What a robot waits for with the road: that it is clear.
#[derive(Clone, Copy, Debug)]
struct Obligation {
    about: About,
    /// Since when, in seconds.
    since_s: f64,
    /// Whether a person has said that the road is clear.
    is_said_clear: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum About {
    /// The duty of a session or maneuver that ended early.
    Duty(Duty),
    /// The corridor that was closed, in a session that goes on.
    Clearing,
}

/// What the protocol's settings say that the application goes by.
#[derive(Clone, Copy, Debug)]
struct Rules {
    guarding: TaskSet,
    holding: TaskSet,
    t_safety_s: f64,
}

impl Rules {
    fn of(config: &Config) -> Self {
        let settings = config.settings();
        Self {
            guarding: settings.guarding,
            holding: settings.holding,
            t_safety_s: f64::from(settings.t_safety.0) / 1e3,
        }
    }
}

impl Application {
    /// The application of a robot with this body, which knows nothing of the road.
    #[must_use]
    pub fn new(body: Box<dyn Body>, plan: Option<Plan>) -> Self {
        Self {
            body,
            sign: Sign::default(),
            shown: Shown::default(),
            leads: false,
            road: Road::default(),
            site: Site::default(),
            detection: Detection::default(),
            traits: Traits::default(),
            availability: Availability::Available,
            bodily: Bodily::default(),
            was_low: false,
            obligation: None,
            maneuver: None,
            waits_for_people: None,
            plan,
            errand: None,
            wishes: VecDeque::new(),
            rules: Rules::of(&Config::default()),
            corridor: Corridor::Clear,
            at_s: 0.0,
        }
    }

    /// The same, which knows this of the road.
    #[must_use]
    pub fn on(self, road: Road) -> Self {
        Self { road, ..self }
    }

    /// The same, whose places are on this site.
    #[must_use]
    pub fn at(self, site: Site) -> Self {
        Self { site, ..self }
    }

    /// What it knows of the road from now on.
    pub fn come_to(&mut self, road: Road) {
        self.road = road;
    }

    /// How many times as fast as real its body moves.
    pub(crate) fn time_scale(&self) -> f64 {
        self.body.time_scale()
    }

    /// The outline of its crossing zone, if it has one.
    #[must_use]
    pub fn zone(&self) -> Option<Outline> {
        match &self.road {
            Road::Watched(watched) => Some(Outline::of(watched.zone(), &self.site)),
            Road::Unknown | Road::Known(_) | Road::Own(_) => None,
        }
    }

    /// Its sign.
    #[must_use]
    pub const fn sign(&self) -> &Sign {
        &self.sign
    }

    /// Lets time pass until `now_s`, in seconds on any clock that never goes back.
    pub fn advance(&mut self, now_s: f64) {
        let report = self.body.advance((now_s - self.at_s).max(0.0));
        self.at_s = now_s;
        match report {
            Some(Report::InPosition(id)) => self.wish(Stimulus::Event(Event::InPosition(id))),
            Some(Report::Completed(id)) => self.waits_for_people = Some(id),
            Some(report) => self.learn_of_body(report),
            None => {}
        }
        self.watch_body();
        self.complete();
        if let Road::Own(street) = &self.road {
            let shown = micros(now_s);
            street.look(shown, self.sign.shows_go(shown));
        }
        self.watch_road();
        self.watch_battery();
        self.watch_zone();
        self.lead_on();
    }

    /// Tells that a maneuver is completed. An escort that knows of its people is not done before they are.
    fn complete(&mut self) {
        let Some(id) = self.waits_for_people else {
            return;
        };
        let guards = |maneuver: Maneuver| self.rules.guarding.contains(maneuver.task);
        let has_people = match &self.road {
            Road::Known(street) => self.maneuver.is_some_and(guards) && !street.is_clear(),
            Road::Unknown | Road::Watched(_) | Road::Own(_) => false,
        };
        if !has_people {
            self.waits_for_people = None;
            self.wish(Stimulus::Event(Event::ManeuverCompleted(id)));
        }
    }

    /// Takes in what the protocol knows after a step.
    pub fn learn(&mut self, robot: &Robot, config: &Config) {
        self.rules = Rules::of(config);
        self.learn_availability(robot);
        self.detection.learn(self.at_s, robot);
        self.leads = matches!(robot.phase(), Phase::Leading(_));
        self.corridor = match robot.phase() {
            Phase::Leading(leading) => leading.corridor,
            _ => Corridor::Clear,
        };
        let about = match robot.duty() {
            Some(duty) => Some(About::Duty(duty)),
            None => (self.corridor == Corridor::Clearing).then_some(About::Clearing),
        };
        if self.obligation.map(|it| it.about) == about {
            return;
        }
        if self.obligation.is_some() && about.is_none() {
            self.body.release();
            if let Road::Watched(watched) = &mut self.road {
                watched.forget();
            }
        }
        self.obligation = about.map(|about| Obligation {
            about,
            since_s: self.at_s,
            is_said_clear: false,
        });
    }

    /// A person says that the road is clear. Whether there is something that waits for it.
    pub fn say_clear(&mut self) -> bool {
        let waits = self.obligation.as_mut();
        waits.map(|it| it.is_said_clear = true).is_some()
    }

    /// Says that the road is clear as soon as that is so: the body has finished its fallback, and nobody is
    /// on the road as far as the robot or a person knows.
    fn watch_road(&mut self) {
        let Some(obligation) = self.obligation else {
            return;
        };
        let is_free = match self.body.fallback() {
            None | Some(Fallback::Holding | Fallback::Finished) => true,
            Some(Fallback::UnderWay) => false,
        };
        let is_own = matches!(
            obligation.about,
            About::Clearing | About::Duty(Duty::Crossing(_))
        );
        let road_is_clear = match &self.road {
            // It knows nothing of the people that others let across.
            Road::Own(_) if !is_own => false,
            road => road.is_clear(self.at_s),
        };
        let is_clear = match obligation.about {
            _ if obligation.is_said_clear => true,
            // Nobody was let across by what it did.
            About::Duty(Duty::FallingBack(maneuver))
                if !self.rules.guarding.contains(maneuver.task) =>
            {
                true
            }
            // No sign that counts on this robot shows go for longer than its own `t_safety`.
            About::Duty(_) => {
                road_is_clear && self.at_s - obligation.since_s >= self.rules.t_safety_s
            }
            About::Clearing => road_is_clear,
        };
        if is_free && is_clear {
            self.wish(Stimulus::Event(Event::RoadClear));
        }
    }

    /// The body.
    #[must_use]
    pub fn body(&self) -> &dyn Body {
        &*self.body
    }

    /// The next thing that the application wants of its endpoint.
    pub fn next_wish(&mut self) -> Option<Stimulus<'static>> {
        self.wishes.pop_front()
    }

    fn wish(&mut self, wish: Stimulus<'static>) {
        if self.wishes.len() < WISHES {
            self.wishes.push_back(wish);
        }
    }

    /// Ends the motion of the body, whatever it is.
    pub fn stop(&mut self) {
        self.waits_for_people = None;
        self.body.halt();
    }

    /// The driver of the body says that its fallback is finished.
    pub fn finish_fallback(&mut self) {
        self.body.finish_fallback();
    }

    /// Carries the body back to where it began.
    pub fn reset(&mut self) {
        self.body.carry_to_safe_place();
    }

    /// Does what the endpoint says.
    pub fn act(&mut self, act: &Act) {
        match act {
            Act::Start(maneuver, parameters) => {
                (self.maneuver, self.waits_for_people) = (Some(*maneuver), None);
                self.act_by_body(BodyAct::Start(*maneuver, *parameters));
            }
            Act::Stop(maneuver, why) => {
                (self.maneuver, self.waits_for_people) = (None, None);
                self.act_by_body(BodyAct::Stop(*maneuver, *why));
            }
            Act::FallBack(maneuver, policy) => {
                (self.maneuver, self.waits_for_people) = (None, None);
                self.act_by_body(BodyAct::FallBack(*maneuver, *policy));
            }
            Act::Notice(notice) => self.notice(*notice),
            Act::OpenCorridor(time) | Act::ExtendCorridor(time) => {
                self.detection.open();
                self.sign.go(micros(self.at_s), *time);
            }
            Act::CloseCorridor(_) => self.sign.stop(),
            Act::Ignored(Event::PedestrianDetected(_), _) => self.detection.end(self.at_s),
            Act::LockIdentity(_) | Act::RenewEpoch | Act::Ignored(..) => {}
        }
    }

    /// Hands an act to the body. One that is not taken is a fault of the robot, which says so before anything
    /// else: a body that was not stopped may still move.
    fn act_by_body(&mut self, act: BodyAct) {
        let Err(error) = self.body.act(act) else {
            return;
        };
        tracing::error!(%error, ?act, "a fault of the body");
        let fault = Availability::Unavailable(Unavailability::LocalFault);
        self.wishes
            .push_front(Stimulus::Event(Event::AvailabilityChanged(fault)));
    }
}

/// Microseconds on the same clock.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clocks show centuries at most, and nothing below 0"
)]
fn micros(seconds: f64) -> u64 {
    (seconds * 1e6) as u64
}

#[cfg(test)]
mod tests;
