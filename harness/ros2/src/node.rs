//! The node: a robot with a lifecycle, in one thread.
//!
//! ```text
//!   zenoh: ~/command, ~/perceived ──► ┌───────┐      ┌──► ~/status, ~/corridor, ~/event
//!   zenoh: ~/change_state, …      ──► │ inbox │ ──► Turn ─► /diagnostics, ~/transition_event
//!   robot: records                ──► └───────┘      └──► orders ──► robot (threads of its own)
//! ```
//!
//! The thread waits for the inbox, at most until something is to be told again. What comes over zenoh is
//! dropped, and counted, when there is no place; the robot's records wait, and are skipped by the
//! [`Journal`](crossguard_robot::journal) when too many do. The robot waits for none of this.

mod door;
mod tell;

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use crossguard_robot::robot_file::RobotFile;
use crossguard_robot::runtime::Order;
use crossguard_robot::trace::Record;
use door::{Delivery, Door, Ears, Told};

use crate::acts::{Acts, Taken};
use crate::command;
use crate::entity::NodeName;
use crate::graph::{Call, Graph, Meeting, Node, RosError};
use crate::lifecycle::{Lifecycle, LifecycleState, NotNow, Verb};
use crate::message::Service;
use crate::msgs::{Command, Corridor, Event, Person, Status};
use crate::report::{Reporter, of};
use crate::robot::{Active, BodyKind, NoRobot, Robot};
use crate::standard::{
    BatteryState, ChangeState, ChangeStateResponse, GetAvailableStatesResponse,
    GetAvailableTransitionsResponse, GetStateResponse, PoseStamped,
};

/// How often the corridor is told at least.
pub const CORRIDOR_PERIOD: Duration = Duration::from_millis(100);

/// How long a corridor may be shown after it was told.
pub const CORRIDOR_VALID_FOR: Duration = Duration::from_millis(300);

/// How often the status is told at least, and diagnostics are told.
pub const STATUS_PERIOD: Duration = Duration::from_secs(1);

/// How much may wait for the node.
const INBOX: usize = 256;

/// How a node is started.
#[derive(Clone, Debug)]
pub struct Options {
    /// Where it meets others.
    pub meeting: Meeting,
    /// Its name.
    pub name: NodeName,
    /// Its robot.
    pub robot: Robot,
    /// Whether it is configured and activated at once.
    pub autostart: bool,
}

/// Why a node does not start.
#[derive(Debug, thiserror::Error)]
pub enum NotStarted {
    /// The ROS graph cannot be joined.
    #[error(transparent)]
    Ros(#[from] RosError),
    /// There is no robot, and it was to be there at once.
    #[error(transparent)]
    Robot(#[from] NoRobot),
}

/// A node that runs.
#[derive(Debug)]
pub struct Running {
    inbox: SyncSender<Delivery>,
    stop: Arc<AtomicBool>,
    thread: JoinHandle<Result<(), RosError>>,
}

impl Running {
    /// Ends the node in order: a robot that is there leaves its session first.
    ///
    /// # Errors
    /// Those of closing the session.
    ///
    /// # Panics
    /// When the node has panicked.
    pub fn stop(self) -> Result<(), RosError> {
        self.stop.store(true, Ordering::Relaxed);
        // It looks by itself, soon; this is sooner.
        let _ = self.inbox.try_send(Delivery::Look);
        self.thread.join().expect("the node does not panic")
    }

    /// Whether it has ended.
    #[must_use]
    pub fn has_ended(&self) -> bool {
        self.thread.is_finished()
    }
}

/// Starts a node.
///
/// # Errors
/// When it cannot join the graph, or its robot is to be there at once and cannot.
pub fn start(options: &Options) -> Result<Running, NotStarted> {
    let graph = Graph::open(&options.meeting)?;
    let (inbox, deliveries) = sync_channel(INBOX);
    let stop = Arc::new(AtomicBool::new(false));
    let mut turn = Turn::new(graph, options, inbox.clone(), Arc::clone(&stop))?;
    turn.tell_corridor();
    turn.tell_status();
    if options.autostart {
        turn.carry_out(Verb::Configure)?;
        turn.carry_out(Verb::Activate)?;
    }
    let thread = std::thread::spawn(move || turn.run(&deliveries));
    Ok(Running {
        inbox,
        stop,
        thread,
    })
}

/// The thread of a node.
struct Turn {
    graph: Graph,
    node: Node,
    told: Told,
    _ears: Ears,
    door: Door,
    stop: Arc<AtomicBool>,
    robot: Robot,
    lifecycle: Lifecycle,
    /// The configuration, once there is one.
    file: Option<RobotFile>,
    active: Option<Active>,
    reporter: Option<Reporter>,
    /// What the robot does and tells.
    acts: Option<Taken>,
    /// Where the body was said to be.
    pose_before: Option<PoseStamped>,
    /// Who asked for the transition that is under way.
    waiting: Option<Call<ChangeState>>,
    /// What was dropped here, by cause.
    causes: BTreeMap<&'static str, u64>,
    status_due: Instant,
    corridor_due: Instant,
    status_before: Status,
    corridor_before: Corridor,
}

impl Turn {
    fn new(
        graph: Graph,
        options: &Options,
        inbox: SyncSender<Delivery>,
        stop: Arc<AtomicBool>,
    ) -> Result<Self, RosError> {
        let node = graph.node(options.name.clone())?;
        let door = Door {
            inbox,
            full: Arc::default(),
        };
        let now = Instant::now();
        Ok(Self {
            told: Told::new(&node)?,
            _ears: door.open(&node)?,
            graph,
            node,
            door,
            stop,
            robot: options.robot.clone(),
            lifecycle: Lifecycle::default(),
            file: None,
            active: None,
            reporter: None,
            acts: None,
            pose_before: None,
            waiting: None,
            causes: BTreeMap::new(),
            status_due: now,
            corridor_due: now,
            status_before: Status::default(),
            corridor_before: Corridor::default(),
        })
    }

    fn run(mut self, deliveries: &Receiver<Delivery>) -> Result<(), RosError> {
        loop {
            let due = self.corridor_due.min(self.status_due);
            let patience = due.saturating_duration_since(Instant::now());
            let delivery = deliveries.recv_timeout(patience);
            // A body is told before anything else is looked at.
            self.tell_acts();
            match delivery {
                Ok(delivery) => self.take(delivery),
                Err(RecvTimeoutError::Timeout) => {}
                // The door is this thread's own.
                Err(RecvTimeoutError::Disconnected) => break,
            }
            if self.stop.load(Ordering::Relaxed) && self.shut_down() {
                break;
            }
            self.tell_what_is_due();
        }
        self.tell_corridor();
        self.tell_status();
        // Tokens are taken back before the session ends.
        let Self {
            graph,
            node,
            told,
            _ears: ears,
            ..
        } = self;
        drop((ears, told, node));
        graph.close()
    }

    /// Has the node end. Whether it has.
    fn shut_down(&mut self) -> bool {
        if self.lifecycle.state() == LifecycleState::Finalized {
            return true;
        }
        // A transition that is under way comes first.
        if self.active.is_none() || self.lifecycle.state() == LifecycleState::Active {
            // From a state in which it is possible.
            let _ = self.carry_out(Verb::ShutDown);
        }
        self.lifecycle.state() == LifecycleState::Finalized
    }

    fn take(&mut self, delivery: Delivery) {
        match delivery {
            Delivery::Command(message) => self.command(&message),
            Delivery::Person(message) => self.person(&message),
            Delivery::Pose(message) => self.pose(message),
            Delivery::Battery(message) => self.battery(&message),
            Delivery::ChangeState(call) => self.change_state(call),
            Delivery::GetState(call) => {
                let current_state = self.lifecycle.state().message();
                answer(call, &GetStateResponse { current_state });
            }
            Delivery::GetStates(call) => {
                let available_states = LifecycleState::ALL.map(LifecycleState::message).to_vec();
                answer(call, &GetAvailableStatesResponse { available_states });
            }
            Delivery::GetTransitions(call) => answer(
                call,
                &GetAvailableTransitionsResponse {
                    available_transitions: self.lifecycle.ways(false),
                },
            ),
            Delivery::GetGraph(call) => answer(
                call,
                &GetAvailableTransitionsResponse {
                    available_transitions: self.lifecycle.ways(true),
                },
            ),
            Delivery::Unreadable(cause, detail) => self.count(cause, &detail),
            Delivery::Record(record) => self.record(&record),
            Delivery::Ended => self.ended(),
            Delivery::Look => {}
        }
    }

    fn count(&mut self, cause: &'static str, detail: &str) {
        tracing::warn!(cause, detail, "dropped");
        *self.causes.entry(cause).or_default() += 1;
    }

    fn refuse(&mut self, refused: &command::Refused) {
        let text = refused.to_string();
        self.count(refused.cause(), &text);
        self.tell_event(Event {
            text,
            ..of(Event::COMMAND_REFUSED)
        });
    }

    /// The robot, if it is there and not about to leave, and trusts whatever can speak on the graph.
    fn commanded(&self) -> Result<(&Active, &RobotFile), command::Refused> {
        let state = self.lifecycle.state();
        match (&self.active, &self.file) {
            (Some(_), Some(file)) if !self.robot.trusts_graph(file) => {
                Err(command::Refused::Untrusted)
            }
            (Some(active), Some(file)) if state == LifecycleState::Active => Ok((active, file)),
            _ => Err(command::Refused::NotActive(state.label())),
        }
    }

    fn command(&mut self, message: &Command) {
        let done = self.commanded().and_then(|(active, file)| {
            active.order(command::order(message, &file.site, self.robot.body)?);
            Ok(())
        });
        if let Err(refused) = done {
            self.refuse(&refused);
        }
    }

    fn person(&mut self, message: &Person) {
        let done = self.commanded().and_then(|(active, _)| {
            active.order(command::person(message)?);
            Ok(())
        });
        if let Err(refused) = done {
            self.count(refused.cause(), &refused.to_string());
        }
    }

    fn pose(&mut self, message: PoseStamped) {
        let before = self.pose_before.take();
        let done = self.commanded().and_then(|(active, _)| {
            if self.robot.body == BodyKind::Configured {
                return Err(command::Refused::NotExternal);
            }
            active.order(Order::Moved(command::pose(&message, before.as_ref())?));
            Ok(())
        });
        match done {
            Ok(()) => self.pose_before = Some(message),
            Err(refused) => self.count(refused.cause(), &refused.to_string()),
        }
    }

    fn battery(&mut self, message: &BatteryState) {
        let done = self.commanded().and_then(|(active, _)| {
            active.order(command::battery(message)?);
            Ok(())
        });
        if let Err(refused) = done {
            self.count(refused.cause(), &refused.to_string());
        }
    }

    fn change_state(&mut self, call: Call<ChangeState>) {
        let verb = match self.lifecycle.asked(&call.request.transition) {
            Ok(verb) => verb,
            Err(refused) => return self.refuse_change(call, &refused),
        };
        match self.carry_out(verb) {
            Ok(()) if is_under_way(self.lifecycle.state()) => self.waiting = Some(call),
            Ok(()) => answer(call, &ChangeStateResponse { success: true }),
            Err(error) => {
                self.count("ros: transition failed", &error.to_string());
                answer(call, &ChangeStateResponse { success: false });
            }
        }
    }

    fn refuse_change(&mut self, call: Call<ChangeState>, refused: &NotNow) {
        self.count("ros: no such transition now", &refused.to_string());
        answer(call, &ChangeStateResponse { success: false });
    }

    /// Sets out on a transition, and goes to its end if that takes no time.
    fn carry_out(&mut self, verb: Verb) -> Result<(), NoRobot> {
        match self.lifecycle.begin(verb) {
            Ok(event) => self.tell_transition(event),
            Err(not_now) => {
                self.count("ros: no such transition now", &not_now.to_string());
                return Ok(());
            }
        }
        let done = match verb {
            Verb::Configure => self.configure(),
            Verb::Activate => self.activate(),
            Verb::CleanUp => {
                (self.file, self.reporter) = (None, None);
                Ok(())
            }
            Verb::Deactivate | Verb::ShutDown => match &self.active {
                // It leaves its session in order, and says when it has.
                Some(active) => {
                    active.order(Order::Stop);
                    return Ok(());
                }
                None => Ok(()),
            },
        };
        self.arrive(done.is_ok());
        done
    }

    fn arrive(&mut self, well: bool) {
        if let Some(event) = self.lifecycle.end(well) {
            self.tell_transition(event);
        }
        self.tell_corridor();
        self.tell_status();
    }

    fn configure(&mut self) -> Result<(), NoRobot> {
        let file = self.robot.file()?;
        self.reporter = Some(Self::reporter(&file));
        self.file = Some(file);
        Ok(())
    }

    fn reporter(file: &RobotFile) -> Reporter {
        Reporter::new(&file.name, file.station)
    }

    fn activate(&mut self) -> Result<(), NoRobot> {
        let Some(file) = &self.file else {
            return Ok(());
        };
        let wake = self.door.clone();
        let (acts, taken) = Acts::new(Arc::new(move || wake.wake()));
        let (active, records) = Active::start(&self.robot, file, &acts)?;
        self.acts = Some(taken);
        self.reporter = Some(Self::reporter(file));
        let inbox = self.door.inbox.clone();
        // It ends with the robot's records, or with the node.
        std::thread::spawn(move || {
            for record in records {
                if inbox.send(Delivery::Record(record)).is_err() {
                    return;
                }
            }
            let _ = inbox.send(Delivery::Ended);
        });
        self.active = Some(active);
        Ok(())
    }

    fn record(&mut self, record: &Record) {
        let Some(reporter) = &mut self.reporter else {
            return;
        };
        reporter.take(record);
        if self.corridor().open != self.corridor_before.open {
            self.tell_corridor();
        }
        let status = self.status();
        let before = Status {
            header: status.header.clone(),
            ..self.status_before.clone()
        };
        if status != before {
            self.tell_status();
        }
    }

    /// The robot has stopped: because it was told to, or of its own accord.
    fn ended(&mut self) {
        self.tell_acts();
        self.acts = None;
        if let Some(active) = self.active.take() {
            active.put_away();
        }
        if let Some(file) = &self.file {
            self.reporter = Some(Self::reporter(file));
        }
        if self.lifecycle.state() == LifecycleState::Active {
            self.count("ros: the robot ended by itself", "");
            if let Ok(event) = self.lifecycle.begin(Verb::Deactivate) {
                self.tell_transition(event);
            }
        }
        self.arrive(true);
        if let Some(call) = self.waiting.take() {
            answer(call, &ChangeStateResponse { success: true });
        }
    }
}

const fn is_under_way(state: LifecycleState) -> bool {
    matches!(
        state,
        LifecycleState::Deactivating | LifecycleState::ShuttingDown
    )
}

fn answer<S: Service>(call: Call<S>, response: &S::Response) {
    // Who asked may be gone, and then there is nobody to tell.
    if let Err(error) = call.answer(response) {
        tracing::warn!(%error, "not answered");
    }
}
