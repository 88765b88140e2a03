//! What the tests of the node share: robots, nodes, and somebody who knows them by ROS messages only.
#![allow(dead_code, unreachable_pub, reason = "each test uses what it needs")]

use std::path::Path;
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use crossguard_endpoint::station::Mode;
use crossguard_ros2::entity::NodeName;
use crossguard_ros2::graph::{Client, Graph, Meeting, Node, Publisher, Subscription};
use crossguard_ros2::message::Message;
use crossguard_ros2::msgs::Command;
use crossguard_ros2::node::{Options, Running, start};
use crossguard_ros2::qos::Qos;
use crossguard_ros2::robot::{BodyKind, Robot};
use crossguard_ros2::standard::{ChangeState, ChangeStateRequest, Empty, GetState, Transition};
use crossguard_testkit::command::{free_ports, robot_file};

pub const PATIENCE: Duration = Duration::from_secs(30);

/// Two ports on 127.0.0.1 that are free.
pub fn two_free_ports() -> [u16; 2] {
    let first = free_ports(2);
    [first, first + 1]
}

/// An endpoint of zenoh on 127.0.0.1 that is free.
pub fn free_endpoint() -> String {
    format!("tcp/127.0.0.1:{}", free_ports(1))
}

/// A robot, with its configuration in a file. The first leads by itself once somebody is detected.
pub fn robot(folder: &Path, name: &str, station: u32, port: u16, peer: u16) -> Robot {
    let config = robot_file(folder, name, station, port, peer).into();
    Robot {
        config,
        log: Some(folder.join(format!("{name}.jsonl"))),
        security: Mode::Off,
        pki: None,
        site: None,
        plan: None,
        body: BodyKind::Configured,
        seed: 1,
    }
}

/// A node that listens at `listen`, and connects to `connect`.
pub fn meeting(listen: &str, connect: &[&str]) -> Meeting {
    Meeting {
        domain: 7,
        connect: connect.iter().map(|it| (*it).to_owned()).collect(),
        listen: vec![listen.to_owned()],
    }
}

/// Starts the node of a robot in a namespace.
pub fn node(meeting: Meeting, namespace: &str, robot: Robot) -> Running {
    let options = Options {
        meeting,
        name: NodeName::new(namespace, "crossguard").unwrap(),
        robot,
        autostart: false,
    };
    start(&options).unwrap()
}

/// Somebody in the graph.
pub struct Observer {
    pub node: Node,
    pub graph: Graph,
}

impl Observer {
    pub fn at(meeting: &Meeting) -> Self {
        let graph = Graph::open(meeting).unwrap();
        let node = graph.node(NodeName::new("/", "observer").unwrap()).unwrap();
        Self { node, graph }
    }

    /// What comes on a topic from now on.
    pub fn hear<M: Message + Send + 'static>(&self, topic: &str) -> Heard<M> {
        let (come, messages) = channel();
        let subscription = self
            .node
            .subscription(topic, Qos::depth(10), move |message: Result<M, _>| {
                // The test may be over.
                let _ = come.send(message.expect("it is a message of its type"));
            })
            .unwrap();
        Heard {
            messages,
            _subscription: subscription,
        }
    }

    pub fn commands(&self, namespace: &str) -> Publisher<Command> {
        let topic = format!("{namespace}/crossguard/command");
        self.node.publisher(&topic, Qos::depth(10)).unwrap()
    }

    pub fn lifecycle(&self, namespace: &str) -> Lifecycle {
        let service = |name: &str| format!("{namespace}/crossguard/{name}");
        Lifecycle {
            change: self.node.client(&service("change_state")).unwrap(),
            get: self.node.client(&service("get_state")).unwrap(),
        }
    }
}

/// What comes on a topic.
pub struct Heard<M> {
    messages: Receiver<M>,
    _subscription: Subscription,
}

impl<M> Heard<M> {
    /// All up to the first that is `wanted`, which must come in time.
    pub fn until(&self, what: &str, wanted: impl Fn(&M) -> bool) -> Vec<M> {
        let deadline = Instant::now() + PATIENCE;
        let mut all = Vec::new();
        loop {
            let left = deadline.saturating_duration_since(Instant::now());
            let message = self.messages.recv_timeout(left);
            let message = message.unwrap_or_else(|_| panic!("waited in vain for: {what}"));
            let is_wanted = wanted(&message);
            all.push(message);
            if is_wanted {
                return all;
            }
        }
    }

    /// What has come by now.
    pub fn so_far(&self) -> Vec<M> {
        self.messages.try_iter().collect()
    }
}

/// The lifecycle of a node, by its services.
pub struct Lifecycle {
    change: Client<ChangeState>,
    get: Client<GetState>,
}

impl Lifecycle {
    /// Asks for a transition by its name. Whether it was carried out.
    pub fn set(&self, label: &str) -> bool {
        let transition = Transition {
            id: 0,
            label: label.to_owned(),
        };
        let request = ChangeStateRequest { transition };
        self.change.call(&request, PATIENCE).unwrap().success
    }

    /// The state that it says it is in; it need not be there yet.
    pub fn get(&self) -> String {
        let deadline = Instant::now() + PATIENCE;
        loop {
            match self.get.call(&Empty::default(), Duration::from_secs(2)) {
                Ok(answer) => return answer.current_state.label,
                Err(error) => assert!(Instant::now() < deadline, "{error}"),
            }
            std::thread::sleep(Duration::from_millis(20));
        }
    }
}

/// Whether the robot told others that it was there, by the RAM in its log; the site's origin is at this latitude.
pub fn was_at(log: &str, latitude: f64, [east, north]: [f64; 2]) -> bool {
    use crossguard_judge::facts::{Fact, Observer};
    use crossguard_robot::site::{Place, Site};
    let site = Site {
        latitude,
        ..Site::default()
    };
    let mut observer = Observer::default();
    let records = log.lines().map(|line| serde_json::from_str(line).unwrap());
    let facts = records.flat_map(|record| observer.take(&record));
    let places = facts.filter_map(|fact| match fact {
        Fact::Place(placed) => Some(site.place(placed.latitude, placed.longitude)),
        _ => None,
    });
    places
        .into_iter()
        .any(|it| it.distance(Place::new(east, north)) < 0.1)
}
