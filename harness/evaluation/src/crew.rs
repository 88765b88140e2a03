//! Robots that coordinate while they cluster: the protocol's transition function of each robot, and an application that
//! holds sessions.
//!
//! Every second robot asks for help again and again, at a place of its own, and any other may be its follower. The
//! leader commands `initialPos` and `block`, and ends the session after the time that was asked for. The robots'
//! messages go over the channel. A robot knows only what it hears there: offers, heartbeats, commands and answers may be
//! lost, as everything else.

use crossguard_protocol::{
    Config, Decimetres, Event, HelpRequest, Input, Notice, Output, Place, Ram, Rmcm, Robot,
    StationId, TaskSet, TaskType, Urgency,
};
use serde::{Deserialize, Serialize};

/// How robots hold sessions.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Sessions {
    /// How long a session is held from when its roles are established, in seconds.
    pub hold_s: f64,
    /// How long its leader waits until it asks again, in seconds.
    pub pause_s: f64,
}

impl Default for Sessions {
    fn default() -> Self {
        Self {
            hold_s: 30.0,
            pause_s: 30.0,
        }
    }
}

/// How long a body takes to where it guards, and to be off the road, in ms.
const MOTION_MS: u64 = 2_000;

#[derive(Clone, Copy, PartialEq, Debug)]
#[expect(clippy::large_enum_variant, reason = "a few at a time")]
pub(super) enum Said {
    Ram(Ram),
    Rmcm(Rmcm),
}

pub(super) struct Crew {
    robot: Robot,
    config: Config,
    sessions: Sessions,
    elapsed_to_ms: u64,
    /// When it asks for help; never if it only follows.
    asks_ms: Option<u64>,
    /// Events that its application is about to report, each with its time in ms.
    plans: Vec<(u64, Event)>,
    said: Vec<Said>,
}

impl Crew {
    /// The `number`th robot, from 0.
    pub(super) fn new(station: u32, number: u32, sessions: Sessions) -> Self {
        Self {
            robot: Robot::new(StationId(station), 1),
            config: Config::default(),
            sessions,
            elapsed_to_ms: 0,
            // One after the other, and each when all robots are switched on.
            asks_ms: number
                .is_multiple_of(2)
                .then(|| 6_000 + u64::from(number) * 500),
            plans: Vec::new(),
            said: Vec::new(),
        }
    }

    /// Its part in a session, as its RAM tells it.
    pub(super) fn ram(&self) -> Ram {
        self.robot.ram()
    }

    /// Whether the protocol says when RAM are sent.
    pub(super) const fn is_busy(&self) -> bool {
        self.robot.next_ram().is_some()
    }

    /// Time has passed until now; what is to be sent since the last time.
    pub(super) fn pass(&mut self, now_ms: u64) -> Vec<Said> {
        self.elapse(now_ms);
        let is_due = |plan: &(u64, Event)| plan.0 <= now_ms;
        let (due, later) = self.plans.drain(..).partition::<Vec<_>, _>(is_due);
        self.plans = later;
        for (_, event) in due {
            self.step(now_ms, Input::Local(event));
        }
        if self.asks_ms.is_some_and(|asks_ms| asks_ms <= now_ms) {
            let number = self.robot.ram().station.0;
            let request = HelpRequest {
                urgency: Urgency::Medium,
                followers: 1,
                tasks: TaskSet::of(&[TaskType::INITIAL_POS, TaskType::BLOCK]),
                place: Place(number),
            };
            self.step(now_ms, Input::Local(Event::PedestrianDetected(request)));
            self.asks_ms = Some(now_ms + ms(self.sessions.pause_s));
        }
        std::mem::take(&mut self.said)
    }

    /// A message was heard from so far away.
    pub(super) fn hear(&mut self, now_ms: u64, said: &Said, distance_m: f64) {
        self.elapse(now_ms);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "`as` saturates at what is unknown"
        )]
        let distance = Decimetres((10.0 * distance_m) as u16);
        let input = match *said {
            Said::Ram(ram) => Input::Ram { ram, distance },
            Said::Rmcm(rmcm) => Input::Rmcm(rmcm),
        };
        self.step(now_ms, input);
    }

    fn elapse(&mut self, now_ms: u64) {
        let passed_ms = now_ms.saturating_sub(self.elapsed_to_ms);
        self.elapsed_to_ms = now_ms.max(self.elapsed_to_ms);
        if let Ok(passed_ms @ 1..) = u32::try_from(passed_ms) {
            self.step(
                now_ms,
                Input::Elapsed(crossguard_protocol::Millis(passed_ms)),
            );
        }
    }

    fn step(&mut self, now_ms: u64, input: Input) {
        let (hold_ms, pause_ms) = (ms(self.sessions.hold_s), ms(self.sessions.pause_s));
        let outputs = self.robot.step(&self.config, input);
        for output in outputs.iter() {
            let mut plan = |after_ms: u64, event| self.plans.push((now_ms + after_ms, event));
            match *output {
                Output::SendRam => self.said.push(Said::Ram(self.robot.ram())),
                Output::SendRmcm(rmcm) => self.said.push(Said::Rmcm(rmcm)),
                Output::StartManeuver(maneuver) if maneuver.task == TaskType::BLOCK => {
                    plan(MOTION_MS, Event::InPosition(maneuver.id));
                }
                Output::StartManeuver(maneuver) => {
                    plan(MOTION_MS, Event::ManeuverCompleted(maneuver.id));
                }
                Output::StopManeuver(..) | Output::FallBack(..) => {
                    plan(MOTION_MS, Event::RoadClear);
                }
                Output::Notify(Notice::FollowerJoined(follower)) => {
                    for (after_ms, task) in
                        [(0, TaskType::INITIAL_POS), (2 * MOTION_MS, TaskType::BLOCK)]
                    {
                        plan(after_ms, Event::CommandManeuver { follower, task });
                    }
                }
                Output::Notify(Notice::RolesEstablished(_)) => {
                    plan(hold_ms, Event::TaskCompleted);
                    self.asks_ms = Some(now_ms + hold_ms + pause_ms);
                }
                _ => {}
            }
        }
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "seconds, checked by the command"
)]
fn ms(seconds: f64) -> u64 {
    (1_000.0 * seconds) as u64
}

#[cfg(test)]
mod tests {
    use crossguard_protocol::State;

    use super::*;

    /// Of a minute of two robots: their RAM, commands, and the share of the time in which both are in a session.
    fn minute(hear: bool) -> (u32, u32, f64) {
        let sessions = Sessions {
            hold_s: 10.0,
            pause_s: 5.0,
        };
        let mut robots = [0, 1].map(|number| Crew::new(1_000 + number, number, sessions));
        let (mut rams, mut commands, mut held) = (0, 0, 0);
        for now_ms in (0..60_000).step_by(100) {
            for from in [0, 1] {
                for said in robots[from].pass(now_ms) {
                    match said {
                        Said::Ram(_) => rams += 1,
                        Said::Rmcm(Rmcm::Command(_)) => commands += 1,
                        Said::Rmcm(Rmcm::Answer(_)) => {}
                    }
                    if hear {
                        robots[1 - from].hear(now_ms + 2, &said, 80.0);
                    }
                }
            }
            let has_role = |it: &Crew| {
                let state = it.robot.state();
                matches!(state, State::RoleEstablished | State::ManeuverExecuting)
            };
            held += u32::from(robots.iter().all(has_role));
        }
        (rams, commands, f64::from(held) / 600.0)
    }

    #[test]
    fn robots_hold_sessions_by_what_they_hear_of_each_other() {
        let (rams, commands, held) = minute(true);
        assert!(
            commands >= 6 && (0.4..0.8).contains(&held),
            "{commands} {held}"
        );
        // Ten a second of each, while a session is held.
        assert!(f64::from(rams) > 0.9 * 2.0 * 600.0 * held, "{rams} {held}");
        let (_, commands, held) = minute(false);
        assert!(commands == 0 && held < 1e-9, "{commands} {held}");
    }
}
