//! zenoh, for ROS 2 stacks and for robots that are not on one link.
//!
//! ```text
//!   robot ──► put crossguard/v2x/<its zenoh id> ──► others, or a router ──► crossguard/v2x/* ──► robot
//! ```
//!
//! Each robot is a zenoh session of its own, which publishes under its own zenoh id below a key that all
//! share, and subscribes to everybody's but its own; so several robots in one process hear each other, and
//! none itself. A packet goes out as it would over any other link: whole, once, and to everybody who
//! listens, with the highest priority, and dropped where a queue is full.
//!
//! Unless endpoints or interfaces are named, nothing leaves the machine: a peer listens on the loopback
//! interface, and looks for others there.
//!
//! zenoh runs in threads of its own. It panics when it is called from within a Tokio runtime of the
//! current-thread flavour; a program that has one opens and drops such links elsewhere.
//!
//! TCP and TLS deliver late what they could not deliver in time. Where packets get lost on the way, UDP
//! endpoints (`udp/…`) are closer to the radio that the protocol is made for. Either way a link to a robot
//! that is silent for two seconds is taken for dead.

#[cfg_attr(not(feature = "zenoh"), path = "zenoh/unbuilt.rs")]
mod session;

use std::fmt;
use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::Halves;
use super::error::{LinkError, ZenohError, interface_of};

/// The key below which robots publish, if no other is named.
const KEY: &str = "crossguard/v2x";

/// Where a router listens, if nothing else is named: on zenoh's port, on this machine.
const ROUTER_PORT: u16 = 7_447;

/// The protocols of endpoints.
const PROTOCOLS: [&str; 3] = ["tcp", "udp", "tls"];

/// What a robot is in its zenoh network.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ZenohMode {
    /// Connected to each of the others directly.
    Peer,
    /// Connected to a router, and through it to the others.
    Client,
    /// A router itself, through which others reach each other.
    Router,
}

/// A robot's part in a zenoh network.
#[derive(Clone, PartialEq, Eq, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Zenoh {
    /// What it is there.
    pub mode: ZenohMode,
    /// The endpoints that it connects to, like `tcp/192.0.2.1:7447`.
    #[serde(default)]
    pub connect: Vec<String>,
    /// Where it listens, like `tcp/0.0.0.0:7447`.
    #[serde(default)]
    pub listen: Vec<String>,
    /// The interface on which it looks for others by multicast.
    pub scout: Option<String>,
    /// The key below which robots publish.
    #[serde(default = "key")]
    pub key: String,
    /// A file with settings of zenoh, in its own format. What it leaves open is as zenoh has it.
    pub config: Option<PathBuf>,
}

fn key() -> String {
    KEY.to_owned()
}

impl Zenoh {
    /// A part with nothing named, so that nothing leaves the machine.
    #[must_use]
    pub fn new(mode: ZenohMode) -> Self {
        Self {
            mode,
            connect: Vec::new(),
            listen: Vec::new(),
            scout: None,
            key: key(),
            config: None,
        }
    }

    /// Where it listens, and where it looks for others.
    #[must_use]
    pub fn places(&self) -> String {
        let config = self.config.iter().map(|path| path.display().to_string());
        let places = [
            ("listening on", self.listens_on()),
            ("connecting to", self.connect.clone()),
            ("scouting on", self.scouts_on().into_iter().collect()),
            ("with", config.collect()),
        ];
        let named = places.iter().filter(|(_, places)| !places.is_empty());
        let texts = named.map(|(what, places)| format!("{what} {}", places.join(" and ")));
        texts.collect::<Vec<_>>().join(", ")
    }

    /// Enters the network.
    ///
    /// # Errors
    /// Why it cannot be entered.
    pub(super) fn open(&self) -> Result<Halves, LinkError> {
        self.check()?;
        session::open(self)
    }

    /// Whether all endpoints, the key and the interface are what they should be.
    fn check(&self) -> Result<(), LinkError> {
        for endpoint in self.connect.iter().chain(&self.listen) {
            let protocol = endpoint.split_once('/').map(|(protocol, _)| protocol);
            if !protocol.is_some_and(|protocol| PROTOCOLS.contains(&protocol)) {
                let (endpoint, known) = (endpoint.clone(), PROTOCOLS.join(", "));
                return Err(ZenohError::Endpoint { endpoint, known }.into());
            }
        }
        let is_chunk = |chunk: &str| !chunk.is_empty() && !chunk.contains(['*', '$', '#', '?']);
        if !self.key.split('/').all(is_chunk) {
            let key = self.key.clone();
            return Err(ZenohError::Key { key }.into());
        }
        match &self.scout {
            Some(interface) => interface_of(interface).map(drop),
            None => Ok(()),
        }
    }

    /// The interface on which it looks for others: the one named, or loopback for a peer that would find
    /// nobody otherwise.
    fn scouts_on(&self) -> Option<String> {
        let is_alone = self.connect.is_empty() && self.listen.is_empty() && self.config.is_none();
        let is_lost = self.mode == ZenohMode::Peer && is_alone;
        let loopback = || {
            let interfaces = if_addrs::get_if_addrs().unwrap_or_default();
            let mut loopback = interfaces
                .into_iter()
                .filter(if_addrs::Interface::is_loopback);
            Some(loopback.find(|it| it.ip().is_ipv4())?.name)
        };
        self.scout
            .clone()
            .or_else(|| loopback().filter(|_| is_lost))
    }

    /// Where it listens: where it is told to, or where those can reach it who find it by scouting.
    fn listens_on(&self) -> Vec<String> {
        let port = match self.mode {
            _ if !self.listen.is_empty() || self.config.is_some() => return self.listen.clone(),
            ZenohMode::Client => return Vec::new(),
            ZenohMode::Peer => 0,
            ZenohMode::Router => ROUTER_PORT,
        };
        let interface = self.scouts_on().and_then(|name| interface_of(&name).ok());
        let address = interface.map_or(std::net::Ipv4Addr::LOCALHOST, |(_, address)| address);
        vec![format!("tcp/{address}:{port}")]
    }
}

impl fmt::Display for Zenoh {
    /// What it is, and where.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mode = match self.mode {
            ZenohMode::Peer => "peer",
            ZenohMode::Client => "client",
            ZenohMode::Router => "router",
        };
        write!(f, "zenoh key {} as a {mode}, {}", self.key, self.places())
    }
}

/// A router that is nothing else: those meet through it who have no way to each other. It routes until it
/// is dropped.
#[derive(Debug)]
pub struct ZenohRouter {
    _session: session::Session,
}

impl ZenohRouter {
    /// Starts to route.
    ///
    /// # Errors
    /// Why it cannot.
    pub fn open(part: &Zenoh) -> Result<Self, LinkError> {
        part.check()?;
        let (session, _) = session::enter(part)?;
        Ok(Self { _session: session })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn peer() -> Zenoh {
        Zenoh::new(ZenohMode::Peer)
    }

    fn why(part: &Zenoh) -> String {
        part.check().unwrap_err().to_string()
    }

    #[test]
    fn unless_something_is_named_nothing_leaves_the_machine() {
        assert_eq!(peer().listens_on(), ["tcp/127.0.0.1:0"]);
        assert_eq!(peer().scouts_on().as_deref(), Some("lo"));
        let router = Zenoh::new(ZenohMode::Router);
        assert_eq!(router.listens_on(), ["tcp/127.0.0.1:7447"]);
        assert_eq!(router.scouts_on(), None);
        let connected = Zenoh {
            connect: vec!["tcp/192.0.2.1:7447".to_owned()],
            ..peer()
        };
        assert_eq!(connected.listens_on(), ["tcp/127.0.0.1:0"]);
        assert_eq!(connected.scouts_on(), None);
        let client = Zenoh::new(ZenohMode::Client);
        assert_eq!((client.listens_on(), client.scouts_on()), (vec![], None));
    }

    #[test]
    fn what_is_named_wrongly_is_said_to_be() {
        let endpoint = |text: &str| Zenoh {
            listen: vec![text.to_owned()],
            ..peer()
        };
        assert!(endpoint("udp/127.0.0.1:7447").check().is_ok());
        for wrong in ["127.0.0.1:7447", "quic/127.0.0.1:7447", "tcp:127.0.0.1"] {
            assert!(why(&endpoint(wrong)).contains(wrong), "{wrong}");
        }
        for wrong in ["", "/a", "a//b", "a/*", "a/$*", "a?b"] {
            let key = wrong.to_owned();
            assert!(why(&Zenoh { key, ..peer() }).contains("no key"), "{wrong}");
        }
        let scout = Some("no-such-interface".to_owned());
        assert!(why(&Zenoh { scout, ..peer() }).contains("there are: "));
    }

    #[cfg(not(feature = "zenoh"))]
    #[test]
    fn a_program_without_zenoh_says_how_to_get_one_with_it() {
        let error = peer().open().err().unwrap().to_string();
        assert!(error.contains("--features zenoh"), "{error}");
        let error = ZenohRouter::open(&peer()).unwrap_err().to_string();
        assert!(error.contains("--features zenoh"), "{error}");
    }
}
