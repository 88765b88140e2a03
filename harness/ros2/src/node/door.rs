//! What a node publishes, listens to and answers, and how it comes into its inbox.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::SyncSender;

use crossguard_robot::trace::Record;

use super::{CORRIDOR_VALID_FOR, STATUS_PERIOD};
use crate::graph::{Call, Node, Publisher, RosError, Server, Subscription};
use crate::message::{Message, Service};
use crate::msgs::{Command, Corridor, Event, Person, Status};
use crate::qos::Qos;
use crate::standard::{
    BatteryState, ChangeState, DiagnosticArray, GetAvailableStates, GetAvailableTransitions,
    GetState, PoseStamped, TransitionEvent,
};

/// What comes in.
pub(super) enum Delivery {
    Command(Command),
    Person(Person),
    Pose(PoseStamped),
    Battery(BatteryState),
    ChangeState(Call<ChangeState>),
    GetState(Call<GetState>),
    GetStates(Call<GetAvailableStates>),
    GetTransitions(Call<GetAvailableTransitions>),
    GetGraph(Call<GetAvailableTransitions>),
    /// Something that says nothing.
    Unreadable(&'static str, String),
    Record(Arc<Record>),
    /// The robot has stopped.
    Ended,
    /// There is something to look at.
    Look,
}

/// What a node publishes.
pub(super) struct Told {
    pub(super) status: Publisher<Status>,
    pub(super) corridor: Publisher<Corridor>,
    pub(super) event: Publisher<Event>,
    pub(super) diagnostics: Publisher<DiagnosticArray>,
    pub(super) transition_event: Publisher<TransitionEvent>,
}

impl Told {
    pub(super) fn new(node: &Node) -> Result<Self, RosError> {
        let status = Qos::depth(1).every(STATUS_PERIOD * 2);
        let corridor = Qos::depth(1).every(CORRIDOR_VALID_FOR);
        Ok(Self {
            status: node.publisher("~/status", status)?,
            corridor: node.publisher("~/corridor", corridor)?,
            event: node.publisher("~/event", Qos::depth(100))?,
            diagnostics: node.publisher("/diagnostics", Qos::depth(10))?,
            transition_event: node.publisher("~/transition_event", Qos::depth(10))?,
        })
    }
}

/// What a node listens to and answers; kept for as long as it does.
pub(super) struct Ears {
    _subscriptions: [Subscription; 4],
    _servers: [Server; 5],
}

/// Puts into the inbox what comes over zenoh.
#[derive(Clone)]
pub(super) struct Door {
    pub(super) inbox: SyncSender<Delivery>,
    pub(super) full: Arc<AtomicU64>,
}

impl Door {
    fn put(&self, delivery: Delivery) {
        if self.inbox.try_send(delivery).is_err() {
            self.full.fetch_add(1, Ordering::Relaxed);
        }
    }

    /// Has the node look. One whose inbox is full looks anyway.
    pub(super) fn wake(&self) {
        let _ = self.inbox.try_send(Delivery::Look);
    }

    fn topic<M: Message + 'static>(
        &self,
        node: &Node,
        topic: &str,
        wrap: fn(M) -> Delivery,
    ) -> Result<Subscription, RosError> {
        let door = self.clone();
        node.subscription(topic, Qos::depth(10), move |came| {
            door.put(match came {
                Ok(message) => wrap(message),
                Err(error) => Delivery::Unreadable(error.cause(), error.to_string()),
            });
        })
    }

    fn service<S: Service + 'static>(
        &self,
        node: &Node,
        service: &str,
        wrap: fn(Call<S>) -> Delivery,
    ) -> Result<Server, RosError> {
        let door = self.clone();
        node.server(service, move |came| {
            door.put(match came {
                Ok(call) => wrap(call),
                Err(error) => Delivery::Unreadable(error.cause(), error.to_string()),
            });
        })
    }

    pub(super) fn open(&self, node: &Node) -> Result<Ears, RosError> {
        let commands = self.topic(node, "~/command", Delivery::Command)?;
        let people = self.topic(node, "~/perceived", Delivery::Person)?;
        let poses = self.topic(node, "~/pose", Delivery::Pose)?;
        let batteries = self.topic(node, "~/battery", Delivery::Battery)?;
        Ok(Ears {
            _subscriptions: [commands, people, poses, batteries],
            _servers: [
                self.service(node, "~/change_state", Delivery::ChangeState)?,
                self.service(node, "~/get_state", Delivery::GetState)?,
                self.service(node, "~/get_available_states", Delivery::GetStates)?,
                self.service(
                    node,
                    "~/get_available_transitions",
                    Delivery::GetTransitions,
                )?,
                self.service(node, "~/get_transition_graph", Delivery::GetGraph)?,
            ],
        })
    }
}
