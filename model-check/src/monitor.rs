//! The properties of robots that run: the rules of [`properties`](crate::properties), judged step by
//! step on what a simulation does or a log records.
//!
//! A rule that the model checker tries on every state of a scenario is tried here on the states that
//! one run passes through. A property of every run in the model, whatever the order of independent
//! events, must hold of this one.
//!
//! Liveness is left out, because it can be judged only when a run is over. See
//! [`Limits`](crate::timed::Limits) for the times by which it must.

use crossguard_protocol::{Config, Input, Maneuver, Outputs, Robot, SessionId, StationId, Timer};

use crate::history::History;
use crate::node::Node;
use crate::properties::i10_lease::has_lease_on_lost;
use crate::properties::{PropertyId, StateRule, StepView, Surroundings, View};
use crate::road::Pedestrian;
use crate::steps::judge;

/// Judges one run. Robots are named by their places, from 0.
#[derive(Debug)]
pub struct Monitor {
    seats: Seats,
    history: History,
    /// Whether steps come in the order of true time.
    is_timed: bool,
    has_strangers: bool,
    premises: u64,
    /// The sessions at whose signs those on the road have stepped on it, one entry for each person.
    on_road: Vec<SessionId>,
}

#[derive(Debug, Default)]
struct Seats {
    seats: Vec<Seat>,
    liars: Vec<StationId>,
}

#[derive(Debug)]
struct Seat {
    node: Node,
    config: Config,
    is_hung: bool,
}

impl Surroundings for Seats {
    fn config(&self, place: usize) -> &Config {
        &self.seats[place].config
    }

    fn can_progress(&self) -> bool {
        let mut timers = self.seats.iter().map(|seat| seat.node.timers());
        timers.any(|timers| timers.iter().any(|(timer, _)| *timer != Timer::Ram))
    }

    fn place_of(&self, station: StationId) -> Option<usize> {
        let named = |seat: &Seat| seat.node.persisted.station == station;
        self.seats.iter().position(named)
    }

    /// While a run goes on this is not known.
    fn restarts_are_over(&self) -> bool {
        false
    }

    fn lies(&self, station: StationId) -> bool {
        self.liars.contains(&station)
    }
}

impl Monitor {
    /// Over a run that has not begun. Whether it is `timed`: whether steps come in the order of
    /// true time, so that states of two robots can be compared at one moment.
    #[must_use]
    pub fn new(timed: bool) -> Self {
        Self {
            seats: Seats::default(),
            history: History::default(),
            is_timed: timed,
            has_strangers: false,
            premises: 0,
            on_road: Vec::new(),
        }
    }

    /// One more robot, which has not booted. Its place.
    pub fn add(&mut self, station: StationId) -> usize {
        let (node, config) = (Node::down(station), Config::default());
        self.seats.seats.push(Seat {
            node,
            config,
            is_hung: false,
        });
        self.seats.seats.len() - 1
    }

    /// A robot boots. Its body is where it was.
    ///
    /// # Panics
    /// When there is no such robot.
    pub fn boot(&mut self, place: usize, robot: &Robot, config: &Config) {
        self.crash(place);
        let mut node = Node::booted(robot.clone());
        node.actuation.body = self.seats.seats[place].node.actuation.body;
        self.seats.seats[place] = Seat {
            node,
            config: config.clone(),
            is_hung: false,
        };
    }

    /// A robot's process hangs, or goes on. One that hangs does nothing by what it still knows, so its leases
    /// are not held against its followers.
    ///
    /// # Panics
    /// When there is no such robot.
    pub fn hang(&mut self, place: usize, is_hung: bool) {
        self.seats.seats[place].is_hung = is_hung;
    }

    /// From now on robots hear others whose steps are not recorded here: a rule that compares two robots is not
    /// judged any more.
    pub const fn has_strangers(&mut self) {
        self.has_strangers = true;
    }

    /// The station of this id is an insider, which may say anything in its own name. Rules that compare two robots are
    /// not judged any more, for it has no robot; nor is what such an insider can break.
    pub fn lies(&mut self, station: StationId) {
        self.seats.liars.push(station);
    }

    /// Whether stations whose steps are not recorded leave a property open; whether a rule of it compares two robots.
    fn is_open(&self, id: PropertyId, is_of_two: bool) -> bool {
        let has_liars = !self.seats.liars.is_empty();
        let can_be_broken = !id.authentication().liars().is_empty();
        (is_of_two && (self.has_strangers || has_liars)) || (has_liars && can_be_broken)
    }

    /// A robot loses its volatile state; nothing if it was down.
    ///
    /// # Panics
    /// When there is no such robot.
    pub fn crash(&mut self, place: usize) {
        let Seat { node, is_hung, .. } = &mut self.seats.seats[place];
        if let Some(robot) = &node.robot {
            self.history.record_crash(robot);
        }
        *node = node.crashed();
        *is_hung = false;
    }

    /// A robot takes a step, and is in the state `after` then. The first property that this breaks.
    ///
    /// # Panics
    /// When there is no such robot.
    pub fn step(
        &mut self,
        place: usize,
        input: Input,
        outputs: &Outputs,
        after: &Robot,
    ) -> Option<PropertyId> {
        let seat = &mut self.seats.seats[place];
        let next = seat.node.observed(input, outputs, after.clone());
        let before = std::mem::replace(&mut seat.node, next);
        // Of all on the road, those concern the step that its body guards.
        let guarded = before.actuation.body.maneuver().map(|id| id.session);
        let guarded = guarded.filter(|session| self.on_road.contains(session));
        self.history.pedestrian = guarded.map_or(Pedestrian::Waiting, Pedestrian::OnRoad);
        let view = StepView {
            config: &seat.config,
            history: &self.history,
            before: &before,
            after: &seat.node,
            input,
            outputs,
        };
        let (premises, broken) = judge(&PropertyId::ALL, &view, false);
        self.premises |= premises;
        if view.is_historic()
            && let (Some(from), Some(to)) = (&before.robot, &seat.node.robot)
        {
            self.history.record_step(from, to, input, outputs);
        }
        let is_judged = |id: &PropertyId| {
            let is_of_two = id.step_rule().is_some_and(|rule| rule.of_two);
            broken & id.bit() != 0 && !self.is_open(*id, is_of_two)
        };
        let first = PropertyId::ALL.into_iter().find(is_judged);
        let first = first.or_else(|| self.judge_state());
        let late = || {
            let seats = self.seats.seats.iter().filter(|seat| !seat.is_hung);
            self.is_timed && has_lease_on_lost(&seats.filter_map(|seat| seat.node.robot.as_ref()))
        };
        first.or_else(|| late().then_some(PropertyId::I10))
    }

    /// A pedestrian steps on the road at the sign of a session, whose crossing requires this number of guards. The
    /// property that this breaks.
    pub fn step_on_road(&mut self, session: SessionId, required: usize) -> Option<PropertyId> {
        let nodes: Vec<&Node> = self.seats.seats.iter().map(|seat| &seat.node).collect();
        let view = View {
            nodes: &nodes,
            history: &self.history,
            world: &self.seats,
        };
        let mut broken = None;
        for id in PropertyId::ALL {
            if let Some(holds) = id.keeps_guards(&view, session, required) {
                self.premises |= id.bit();
                if !holds && !self.has_strangers && !self.is_open(id, false) {
                    broken = broken.or(Some(id));
                }
            }
        }
        self.on_road.push(session);
        broken
    }

    /// A person who stepped on the road at the sign of this session is across.
    pub fn is_across(&mut self, session: SessionId) {
        if let Some(at) = self.on_road.iter().position(|it| *it == session) {
            self.on_road.swap_remove(at);
        }
    }

    /// The maneuver by which a robot's body guards people now, if it is up.
    ///
    /// # Panics
    /// When there is no such robot.
    #[must_use]
    pub fn guards(&self, place: usize) -> Option<Maneuver> {
        let seat = &self.seats.seats[place];
        seat.node.actuation.body.guards(seat.config.settings())
    }

    fn judge_state(&mut self) -> Option<PropertyId> {
        let nodes: Vec<&Node> = self.seats.seats.iter().map(|seat| &seat.node).collect();
        let view = View {
            nodes: &nodes,
            history: &self.history,
            world: &self.seats,
        };
        let mut premises = self.premises;
        let broken = PropertyId::ALL.into_iter().find(|id| {
            let is_judged = |rule: &StateRule| !self.is_open(*id, rule.of_two);
            let rule = id.state_rule().filter(is_judged);
            rule.is_some_and(|rule| {
                if premises & id.bit() == 0 && (rule.premise)(&view) {
                    premises |= id.bit();
                }
                !(rule.holds)(&view)
            })
        });
        self.premises = premises;
        broken
    }

    /// The state of a robot and of its body.
    ///
    /// # Panics
    /// When there is no such robot.
    #[must_use]
    pub fn node(&self, place: usize) -> &Node {
        &self.seats.seats[place].node
    }

    /// The properties whose premise the run has met so far.
    pub fn premises_met(&self) -> impl Iterator<Item = PropertyId> {
        let met = self.premises;
        let ids = PropertyId::ALL.into_iter();
        ids.filter(move |id| met & id.bit() != 0)
    }
}

#[cfg(test)]
mod tests {
    use crossguard_protocol::{Event, HelpRequest, Output, Place, TaskSet, TaskType, Urgency};

    use super::*;

    fn request() -> Input {
        Input::Local(Event::PedestrianDetected(HelpRequest {
            urgency: Urgency::Low,
            followers: 1,
            tasks: TaskSet::of(&[TaskType::MOVE]),
            place: Place::default(),
        }))
    }

    #[test]
    fn a_step_of_the_protocol_breaks_nothing_and_one_that_forgets_an_output_does() {
        let config = Config::default();
        let mut robot = Robot::new(StationId(1), 1);
        let mut monitor = Monitor::new(true);
        let place = monitor.add(StationId(1));
        monitor.boot(place, &robot, &config);
        let outputs = robot.step(&config, request());
        assert_eq!(monitor.step(place, request(), &outputs, &robot), None);
        monitor.boot(place, &Robot::new(StationId(1), 1), &config);
        let is_lock = |output: &&Output| matches!(output, Output::LockIdentity);
        let forgetful: Outputs = outputs.iter().filter(|o| !is_lock(o)).copied().collect();
        let broken = monitor.step(place, request(), &forgetful, &robot);
        assert_eq!(broken, Some(PropertyId::I18));
    }

    #[test]
    fn a_role_from_before_a_crash_is_noticed() {
        let config = Config::default();
        let mut robot = Robot::new(StationId(2), 1);
        let mut requester = Robot::new(StationId(1), 1);
        requester.step(&config, request());
        let mut monitor = Monitor::new(false);
        let place = monitor.add(StationId(2));
        monitor.boot(place, &robot, &config);
        let session = requester.session().unwrap();
        follow(&mut robot, &mut requester, &config);
        assert!(
            matches!(robot.session(), Some(SessionId { .. }) if robot.session() == Some(session))
        );
        // It follows without a confirmation.
        let idle = Input::Elapsed(crossguard_protocol::Millis(1));
        let broken = monitor.step(place, idle, &Outputs::default(), &robot);
        assert_eq!(broken, Some(PropertyId::I2));
    }

    /// Takes `robot` to a role in the session of `requester`.
    fn follow(robot: &mut Robot, requester: &mut Robot, config: &Config) {
        let distance = crossguard_protocol::Decimetres(1);
        let hear = |robot: &mut Robot, from: &Robot| {
            let ram = from.ram();
            robot.step(config, Input::Ram { ram, distance });
        };
        hear(robot, requester);
        hear(requester, robot);
        requester.step(
            config,
            Input::Expired(crossguard_protocol::Timer::Selection),
        );
        hear(robot, requester);
    }
}
