//! Runs of some robots over a channel that delivers each message that was ever sent, at any time, as often as it likes.
//!
//! States are not renamed here, as the model does, so that what has happened to an exchange can be told along a run.

use std::collections::BTreeSet;

use crossguard_model_check::node::Rules;
use crossguard_model_check::scenario::Scenario;
use crossguard_protocol::laws::exchange::observer::lose_power;
use crossguard_protocol::laws::exchange::{Exchange, History, alone, leases, robots, steps};
use crossguard_protocol::*;
use proptest::prelude::RngExt;
use proptest::test_runner::{RngAlgorithm, TestRng};

/// A robot's step, or its reboot.
#[expect(clippy::large_enum_variant, reason = "nearly all are steps")]
#[derive(Clone)]
pub(crate) enum Entry {
    Step {
        before: Robot,
        input: Input,
        outputs: Outputs,
        after: Robot,
    },
    /// It lost power, and has booted anew.
    Reboot { before: Robot, after: Robot },
}

/// One run.
pub(crate) struct Run<'a> {
    scenario: &'a Scenario,
    rules: &'a dyn Rules,
    robots: Vec<Robot>,
    /// The last pseudonym that was given out.
    alias: u32,
    sent: Vec<(usize, Input)>,
    pub(crate) entries: Vec<Entry>,
}

impl<'a> Run<'a> {
    /// A run of 600 things that happen, drawn by a seed.
    pub(crate) fn drawn(scenario: &'a Scenario, rules: &'a dyn Rules, seed: u8) -> Self {
        let mut random = TestRng::from_seed(RngAlgorithm::ChaCha, &[seed; 32]);
        let mut run = Self::new(scenario, rules);
        for _ in 0..600 {
            run.go_on(&mut random);
        }
        run
    }

    fn new(scenario: &'a Scenario, rules: &'a dyn Rules) -> Self {
        let honest = scenario.robots.iter().filter(|robot| robot.lies.is_none());
        Self {
            scenario,
            rules,
            robots: honest.map(|robot| Robot::new(robot.station, 1)).collect(),
            alias: 1_000,
            sent: Vec::new(),
            entries: Vec::new(),
        }
    }

    /// One thing happens, whatever it is.
    fn go_on(&mut self, random: &mut TestRng) {
        let place = random.random_range(0..self.robots.len());
        let robot = self.robots[place].clone();
        match random.random_range(0..100) {
            0..60 => {
                let Some((sender, input)) = self.any_message(random) else {
                    return;
                };
                // Everybody hears it, or one does.
                let to = random.random_bool(0.5).then_some(place);
                for place in (0..self.robots.len()).filter(|it| *it != sender) {
                    if to.is_none_or(|to| to == place) {
                        self.step(place, input);
                    }
                }
            }
            60..80 => {
                let timers = robot.timers();
                // Most often the RAM is due: the others are longer.
                let due = timers.iter().map(|(timer, _)| *timer).filter(|timer| {
                    let is_ram = *timer == Timer::Ram;
                    random.random_bool(if is_ram { 0.9 } else { 0.15 })
                });
                if let Some(timer) = due.last() {
                    self.step(place, Input::Expired(timer));
                }
            }
            80 => self.step(place, Input::Elapsed(Millis(random.random_range(1..3_000)))),
            81 if random.random_bool(0.3) => self.reboot(place),
            _ => {
                if let Some(event) = self.any_event(&robot, place, random) {
                    self.step(place, Input::Local(event));
                }
            }
        }
    }

    /// Often one of the newest.
    fn any_message(&self, random: &mut TestRng) -> Option<(usize, Input)> {
        let rmcms = || {
            self.sent
                .iter()
                .filter(|(_, it)| matches!(it, Input::Rmcm(_)))
        };
        if random.random_bool(0.1) && rmcms().next().is_some() {
            return rmcms()
                .nth(random.random_range(0..rmcms().count()))
                .copied();
        }
        let newest = self.sent.len().checked_sub(1)?;
        let back = if random.random_bool(0.8) { 3 } else { newest };
        let index = newest - random.random_range(0..=back.min(newest));
        self.sent.get(index).copied()
    }

    fn any_event(&mut self, robot: &Robot, place: usize, random: &mut TestRng) -> Option<Event> {
        let (leading, following) = match robot.phase() {
            Phase::Leading(leading) => (Some(leading), None),
            Phase::Following(following) => (None, Some(following)),
            _ => (None, None),
        };
        Some(match random.random_range(0..40) {
            0..8 if leading.is_none() => {
                let at = self.scenario.robots.get(place)?;
                Event::PedestrianDetected(
                    self.scenario
                        .request_of(self.scenario.place_of(at.station)?),
                )
            }
            0..24 if leading.is_some() => {
                let members = &leading?.members;
                let at = random.random_range(0..members.len());
                let tasks: Vec<_> = self.scenario.request.tasks.iter().collect();
                Event::CommandManeuver {
                    follower: members.iter().nth(at)?.station,
                    task: *tasks.get(random.random_range(0..tasks.len()))?,
                }
            }
            0..24 => {
                let id = following?.executing()?.id;
                match random.random_range(0..9) {
                    0..5 => Event::InPosition(id),
                    5..7 => Event::ManeuverCompleted(id),
                    7 => Event::OutOfPosition(id),
                    _ => Event::ManeuverFailed(id),
                }
            }
            24..29 if leading.is_some() => Event::OpenCorridor,
            24..29 => Event::AllAnswered,
            29 => Event::PersonOnRoad,
            30 => Event::TaskCompleted,
            31 => Event::LeaveRequested,
            32 => Event::OpenCorridor,
            33 => Event::CloseCorridor,
            34..37 => Event::RoadClear,
            37 => Event::AvailabilityChanged(match robot.availability() {
                Availability::Available => Availability::Unavailable(Unavailability::LocalFault),
                Availability::Unavailable(_) => Availability::Available,
            }),
            38 => {
                self.alias += 1;
                Event::IdentityChanged(StationId(self.alias), None)
            }
            _ => Event::EpochRenewed(robot.boot() + 1),
        })
    }

    fn step(&mut self, place: usize, input: Input) {
        let before = self.robots[place].clone();
        let mut after = before.clone();
        let outputs = self.rules.step(&mut after, &self.scenario.config, input);
        for output in outputs.iter() {
            let Some(message) = message(&after, output) else {
                continue;
            };
            self.sent.push((place, message));
        }
        self.robots[place] = after.clone();
        self.entries.push(Entry::Step {
            before,
            input,
            outputs,
            after,
        });
    }

    fn reboot(&mut self, place: usize) {
        let before = self.robots[place].clone();
        let after = Robot::new(before.station(), before.boot() + 1);
        self.robots[place] = after.clone();
        self.entries.push(Entry::Reboot { before, after });
    }

    /// Every exchange that occurs in the run: each session, follower and request of it, with each offer that was made. Each
    /// has one of the heartbeats that the follower has echoed, in turn.
    pub(crate) fn exchanges(&self) -> Vec<Exchange> {
        let first = self.scenario.config.settings().first_request;
        let mut exchanges = Vec::new();
        let mut note = |exchange| {
            if !exchanges.contains(&exchange) {
                exchanges.push(exchange);
            }
        };
        for (_, input) in &self.sent {
            match *input {
                Input::Ram { ram, .. } => {
                    if let Coordination::OfferHelp { session, offer, .. } = ram.coordination {
                        note((session, ram.station, Some(offer), first));
                    }
                }
                Input::Rmcm(Rmcm::Command(command)) => {
                    note((command.session, command.to, None, command.request));
                }
                _ => {}
            }
        }
        let exchange = |(turn, &(session, follower, offer, request))| {
            let echoed = self.echoed(session, follower);
            Exchange {
                session,
                follower,
                offer: Option::unwrap_or(offer, OfferNumber(UniqueNumber { boot: 0, count: 0 })),
                request,
                first,
                heartbeat: Heartbeat(*echoed.iter().cycle().nth(turn).unwrap_or(&1)),
            }
        };
        exchanges.iter().enumerate().map(exchange).collect()
    }

    /// The heartbeats that a follower has echoed in a session.
    fn echoed(&self, watched: SessionId, follower: StationId) -> BTreeSet<u16> {
        let echo = |(_, input): &(usize, Input)| match *input {
            Input::Ram { ram, .. } => match ram.coordination {
                Coordination::Follower { session, echo, .. } => {
                    (ram.station == follower && session == watched).then_some(echo.0)
                }
                _ => None,
            },
            _ => None,
        };
        self.sent.iter().filter_map(echo).collect()
    }
}

/// The message of an output, as others hear it.
fn message(after: &Robot, output: &Output) -> Option<Input> {
    match *output {
        Output::SendRam => Some(Input::Ram {
            ram: after.ram(),
            distance: Decimetres(0),
        }),
        Output::SendRmcm(rmcm) => Some(Input::Rmcm(rmcm)),
        _ => None,
    }
}

/// Result of an exchange along a run.
pub(crate) struct Followed {
    pub(crate) history: History,
    /// After how many steps a corridor was open that rests on the watched heartbeat and request.
    pub(crate) corridors: usize,
}

/// Whether the leader of the exchange has an open corridor, over the watched request, on the strength of the watched heartbeat.
fn rests_on(exchange: &Exchange, robot: &Robot) -> bool {
    let Phase::Leading(leading) = robot.phase() else {
        return false;
    };
    let leader = robot.station();
    let number = leading.number;
    leading.corridor == Corridor::Open
        && SessionId { leader, number } == exchange.session
        && leading.members.iter().any(|member| {
            member.station == exchange.follower
                && member.echoed == Some(exchange.heartbeat)
                && member
                    .order
                    .is_some_and(|order| order.request == exchange.request)
        })
}

/// Follows an exchange along a run.
///
/// # Panics
/// When a step of the induction does not hold.
pub(crate) fn follow(config: &Config, exchange: &Exchange, entries: &[Entry]) -> Followed {
    let (mut history, mut corridors) = (History::default(), 0);
    for entry in entries {
        match entry {
            Entry::Step {
                before,
                input,
                outputs,
                after,
            } => {
                assert!(
                    steps::holds(exchange, &history, before),
                    "a step of another robot has made it untrue"
                );
                assert!(
                    steps::can_be_next(exchange, &history, before, input),
                    "a message does not stay true"
                );
                leases::are_kept(config, before, input, after);
                alone::leaves_the_record(exchange, (before, input), after);
                alone::keeps_its_station(exchange, before, outputs.iter(), after);
                let seen = (before, input);
                history = steps::keeps_as_seen(exchange, &history, seen, outputs.iter(), after);
                corridors += usize::from(rests_on(exchange, after));
            }
            Entry::Reboot { before, after } => {
                let now = lose_power(exchange, &history, before);
                steps::judge(exchange, (&history, before), (&now, after));
                history = now;
            }
        }
    }
    assert!(robots::agrees(
        exchange,
        &history,
        &Robot::new(StationId(9_999), 1)
    ));
    Followed { history, corridors }
}
