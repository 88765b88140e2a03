//! A robot without input and output: its endpoint, its application, and how the two turn.
//!
//! ```text
//!                ┌────────────── Machine::handle ───────────────┐
//!   time ──────► │ body moves ─► endpoint ─► acts ─► wishes ─┐  │
//!   stimulus ──► │                  ▲                        │  │ ──► effects, in order
//!                │                  └────────────────────────┘  │
//!                └──────────────────────────────────────────────┘
//! ```
//!
//! [`runtime`](crate::runtime) drives it by a real clock and a socket, the simulator of `crossguard-judge` in
//! virtual time; both do what the effects say.

use crossguard_endpoint::cause::Cause;
use crossguard_endpoint::{Effect, Endpoint, Moment, Stimulus};
use crossguard_protocol::{Event, ManeuverId, Phase, Robot, StateMachine};

use crate::application::Application;

/// How many wishes of the application are fulfilled in one turn; the others wait for the next.
const WISHES_PER_TURN: usize = 32;

/// A robot's endpoint and application.
#[derive(Debug)]
pub struct Machine<P = Robot> {
    /// What it hears and says.
    pub endpoint: Endpoint<P>,
    /// What its body does.
    pub application: Application,
}

impl<P: StateMachine> Machine<P> {
    /// The robot with this endpoint and application.
    #[must_use]
    pub fn new(mut endpoint: Endpoint<P>, application: Application) -> Self {
        endpoint.serve(application.served());
        endpoint.needs(application.needs());
        Self {
            endpoint,
            application,
        }
    }

    /// Takes in what happened at `moment`, which is `now_s` seconds on the clock of the body. What
    /// concerns body and application is carried out; every effect is returned.
    pub fn handle(&mut self, moment: Moment, now_s: f64, stimulus: Stimulus<'_>) -> Vec<Effect> {
        self.application.advance(now_s);
        if let Stimulus::Event(event) = stimulus {
            self.application.say(event);
        }
        let mut effects = self.turn(moment, stimulus);
        for _ in 0..WISHES_PER_TURN {
            let Some(wish) = self.application.next_wish() else {
                break;
            };
            effects.extend(self.turn(moment, wish));
        }
        effects
    }

    fn turn(&mut self, moment: Moment, stimulus: Stimulus<'_>) -> Vec<Effect> {
        let is_heard = matches!(stimulus, Stimulus::Datagram { .. });
        if matches!(stimulus, Stimulus::Event(Event::PedestrianDetected(_))) {
            // They are told to wait before help is asked for (the paper, section III-A, stage 2).
            self.application.faces_people = true;
        }
        let state = self.application.state();
        let effects = self.endpoint.handle(moment, &state, stimulus);
        if is_heard {
            let (map, robot) = (self.endpoint.map(), self.endpoint.robot());
            self.application.listen(map, robot, moment);
        }
        for effect in &effects {
            self.application.act(effect);
        }
        let (robot, config) = (self.endpoint.robot(), self.endpoint.config());
        self.application.learn(robot, config);
        effects
    }

    /// A packet was dropped before it came to the endpoint.
    pub fn miss(&mut self, cause: Cause) {
        self.endpoint.count(cause);
        self.application.miss(cause);
    }

    /// The maneuver that the body executes as a follower, if one runs.
    #[must_use]
    pub fn executing(&self) -> Option<ManeuverId> {
        match self.endpoint.robot().phase() {
            Phase::Following(following) => Some(following.executing()?.id),
            _ => None,
        }
    }

    /// The event that the maneuver which runs is finished, well or not; the body stops. `None` when
    /// none runs; then a fallback that runs is finished.
    pub fn finish(&mut self, well: bool) -> Option<Event> {
        let Some(id) = self.executing() else {
            self.application.body.finish_fallback();
            return None;
        };
        self.application.stop();
        Some(if well {
            Event::ManeuverCompleted(id)
        } else {
            Event::ManeuverFailed(id)
        })
    }

    /// Whether the robot has no part in a session, says farewell to none, and has no duty on the road.
    #[must_use]
    pub fn is_at_rest(&self) -> bool {
        is_at_rest(self.endpoint.robot())
    }

    /// Whether the robot may be switched off: it has no part in a session, says farewell to none, and its
    /// body is on no way that its fallback takes. A robot that holds a place goes on holding it.
    #[must_use]
    pub fn may_stop(&self) -> bool {
        let robot = self.endpoint.robot();
        let is_under_way = self.application.body().walks_back();
        matches!(robot.phase(), Phase::Idle) && robot.farewell().is_none() && !is_under_way
    }
}

/// Whether a robot has no part in a session, says farewell to none, and has no duty on the road.
#[must_use]
pub fn is_at_rest(robot: &Robot) -> bool {
    let is_idle = matches!(robot.phase(), Phase::Idle);
    is_idle && robot.farewell().is_none() && robot.duty().is_none()
}
