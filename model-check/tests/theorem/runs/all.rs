//! All runs of two robots up to so many steps.

use std::collections::HashSet;

use crossguard_model_check::scenario::Scenario;
use crossguard_protocol::laws::exchange::observer::lose_power;
use crossguard_protocol::laws::exchange::{Exchange, History, steps};
use crossguard_protocol::*;

use super::message;

/// What is not drawn by lot: two robots, all that they ever sent, and what has happened to the exchange.
#[derive(Clone, PartialEq, Eq, Hash)]
struct World {
    robots: [Robot; 2],
    sent: Vec<(usize, Input)>,
    history: History,
    /// How often somebody may still detect a pedestrian, command, disturb, lose power, or beat.
    left: [u8; 5],
}

/// Explores all runs of `depth` steps: each message may arrive at any time and again, each timer may expire, and the leader
/// may send one more heartbeat. The histories that were met.
///
/// # Panics
/// When a step of the induction does not hold.
pub(crate) fn explore(scenario: &Scenario, heartbeat: Heartbeat, depth: usize) -> HashSet<History> {
    let [leader, follower] = [0, 1].map(|place| scenario.robots[place].station);
    let number = UniqueNumber { boot: 1, count: 0 };
    let first = scenario.config.settings().first_request;
    let exchange = Exchange {
        session: SessionId {
            leader,
            number: SessionNumber(number),
        },
        follower,
        offer: OfferNumber(number),
        request: first,
        first,
        heartbeat,
    };
    let start = World {
        robots: [leader, follower].map(|station| Robot::new(station, 1)),
        sent: Vec::new(),
        history: History::default(),
        left: [1, 2, 1, 1, 1],
    };
    let mut seen = HashSet::from([start.clone()]);
    let mut last = vec![start];
    for _ in 0..depth {
        let mut next = Vec::new();
        for world in &last {
            for (place, input, left) in world.inputs(scenario) {
                let after = world.after(scenario, &exchange, (place, input), left);
                if seen.insert(after.clone()) {
                    next.push(after);
                }
            }
            next.extend(
                world
                    .reboots(&exchange)
                    .filter(|it| seen.insert(it.clone())),
            );
        }
        last = next;
    }
    println!("{} states within {depth} steps", seen.len());
    seen.into_iter().map(|world| world.history).collect()
}

impl World {
    fn inputs(&self, scenario: &Scenario) -> Vec<(usize, Input, [u8; 5])> {
        let mut inputs = Vec::new();
        for (sender, input) in &self.sent {
            inputs.push((1 - sender, *input, self.left));
        }
        for (place, robot) in self.robots.iter().enumerate() {
            for &(timer, _) in robot.timers().iter() {
                let mut left = self.left;
                if timer == Timer::Ram {
                    if !matches!(robot.phase(), Phase::Leading(_)) || left[4] == 0 {
                        continue;
                    }
                    left[4] -= 1;
                }
                inputs.push((place, Input::Expired(timer), left));
            }
            let mut event = |event, bound: Option<usize>| {
                let mut left = self.left;
                let can = bound.is_none_or(|bound| {
                    let can = left[bound] > 0;
                    left[bound] = left[bound].saturating_sub(1);
                    can
                });
                if can {
                    inputs.push((place, Input::Local(event), left));
                }
            };
            match robot.phase() {
                Phase::Idle => event(
                    Event::PedestrianDetected(scenario.request_of(place)),
                    Some(0),
                ),
                Phase::Requesting(_) => event(Event::AllAnswered, None),
                Phase::Leading(_) => {
                    let follower = self.robots[1 - place].station();
                    let task = TaskType::MOVE;
                    event(Event::CommandManeuver { follower, task }, Some(1));
                    event(Event::TaskCompleted, None);
                }
                Phase::Following(following) => {
                    if let Some(maneuver) = following.executing() {
                        event(Event::InPosition(maneuver.id), None);
                        event(Event::ManeuverCompleted(maneuver.id), None);
                    }
                    event(Event::LeaveRequested, Some(2));
                }
                Phase::Offering(_) => event(Event::LeaveRequested, Some(2)),
            }
        }
        inputs
    }

    fn after(
        &self,
        scenario: &Scenario,
        exchange: &Exchange,
        (place, input): (usize, Input),
        left: [u8; 5],
    ) -> Self {
        let mut world = self.clone();
        world.left = left;
        let before = &self.robots[place];
        for robot in &self.robots {
            assert!(steps::holds(exchange, &self.history, robot));
        }
        assert!(steps::can_be_next(exchange, &self.history, before, &input));
        let outputs = world.robots[place].step(&scenario.config, input);
        let after = &world.robots[place];
        let seen = (before, &input);
        world.history = steps::keeps_as_seen(exchange, &self.history, seen, outputs.iter(), after);
        for sent in outputs.iter().filter_map(|output| message(after, output)) {
            if !world.sent.contains(&(place, sent)) {
                world.sent.push((place, sent));
            }
        }
        world
    }

    fn reboots<'a>(&'a self, exchange: &'a Exchange) -> impl Iterator<Item = Self> + 'a {
        let can = self.left[3] > 0;
        (0..2).filter(move |_| can).map(move |place| {
            let mut world = self.clone();
            let before = &self.robots[place];
            world.left[3] -= 1;
            world.history = lose_power(exchange, &self.history, before);
            world.robots[place] = Robot::new(before.station(), before.boot() + 1);
            let now = (&world.history, &world.robots[place]);
            steps::judge(exchange, (&self.history, before), now);
            world
        })
    }
}
