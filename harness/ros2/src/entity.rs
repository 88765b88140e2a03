//! Names in the ROS graph, and what they are in key expressions of zenoh.
//!
//! | | key expression |
//! |---|---|
//! | data of a topic, requests of a service | `<domain>/<name>/<type>/<hash>` |
//! | that a node is there | `@ros2_lv/<domain>/<zid>/<node>/<node>/NN/<enclave>/<namespace>/<name>` |
//! | that something of a node is there | `@ros2_lv/<domain>/<zid>/<node>/<id>/<kind>/<enclave>/<namespace>/<name>/<topic>/<type>/<hash>/<qos>` |
//!
//! The latter two are liveliness tokens, which zenoh takes back when the session is gone. The whole ROS
//! graph (`ros2 node list`, `topic info`, whether a service is there) is made of them. Kinds are `MP`
//! publisher, `MS` subscription, `SS` service and `SC` client; `%` stands for every slash within a part.

use crate::attachment::Gid;
use crate::qos::Qos;

/// The first part of all tokens.
pub const ADMIN_SPACE: &str = "@ros2_lv";

/// Where a node is in the graph.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct NodeName {
    /// `/`, or like `/ari`.
    pub namespace: String,
    /// Without slashes.
    pub name: String,
}

/// Why something has no place in the graph.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum NameError {
    /// It is no name.
    #[error(
        "'{0}' is not a name in ROS: letters, digits and underscores, no digit first, with slashes only \
         in namespaces and topics"
    )]
    Name(String),
    /// It is longer than 255 characters.
    #[error("'{0}' is longer than 255 characters")]
    Long(String),
}

fn is_token(part: &str) -> bool {
    let goes_on_well = |it: char| it.is_ascii_alphanumeric() || it == '_';
    !part.is_empty()
        && !part.starts_with(|it: char| it.is_ascii_digit())
        && part.chars().all(goes_on_well)
}

impl NodeName {
    /// The node `name` in `namespace`, which may begin with a slash or not.
    ///
    /// # Errors
    /// When one of them is no name.
    pub fn new(namespace: &str, name: &str) -> Result<Self, NameError> {
        let inner = namespace.trim_matches('/');
        if !inner.is_empty() && !inner.split('/').all(is_token) {
            return Err(NameError::Name(namespace.to_owned()));
        }
        if !is_token(name) {
            return Err(NameError::Name(name.to_owned()));
        }
        let node = Self {
            namespace: format!("/{inner}"),
            name: name.to_owned(),
        };
        if node.full().len() > 255 {
            return Err(NameError::Long(node.full()));
        }
        Ok(node)
    }

    /// Its full name, like `/ari/crossguard`.
    #[must_use]
    pub fn full(&self) -> String {
        match self.namespace.as_str() {
            "/" => format!("/{}", self.name),
            namespace => format!("{namespace}/{}", self.name),
        }
    }

    /// A topic or service from this node: absolute (`/diagnostics`), its own (`~/status`) or of its
    /// namespace.
    ///
    /// # Errors
    /// When it is no name.
    pub fn resolve(&self, topic: &str) -> Result<String, NameError> {
        let full = match (topic.strip_prefix("~/"), topic.starts_with('/')) {
            (Some(own), _) => format!("{}/{own}", self.full()),
            (None, true) => topic.to_owned(),
            (None, false) => format!("{}/{topic}", self.namespace.trim_end_matches('/')),
        };
        if !full[1..].split('/').all(is_token) {
            return Err(NameError::Name(topic.to_owned()));
        }
        if full.len() > 255 {
            return Err(NameError::Long(full));
        }
        Ok(full)
    }
}

/// The name of a type on the wire: `std_msgs/msg/String` is `std_msgs::msg::dds_::String_`.
#[must_use]
pub fn dds_name(name: &str) -> String {
    match name.rsplit_once('/') {
        Some((package, name)) => format!("{}::dds_::{name}_", package.replace('/', "::")),
        None => format!("{name}_"),
    }
}

/// What something in the graph is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Kind {
    /// It publishes on a topic.
    Publisher,
    /// It listens to a topic.
    Subscription,
    /// It answers requests.
    Service,
    /// It asks.
    Client,
}

impl Kind {
    const fn letters(self) -> &'static str {
        match self {
            Self::Publisher => "MP",
            Self::Subscription => "MS",
            Self::Service => "SS",
            Self::Client => "SC",
        }
    }
}

/// A node in the graph.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct NodeEntity {
    /// `ROS_DOMAIN_ID`.
    pub domain: u32,
    /// The id of its zenoh session.
    pub zid: String,
    /// Its number in the session.
    pub id: u64,
    /// Its name.
    pub name: NodeName,
}

impl NodeEntity {
    fn token_up_to_name(&self, id: u64, kind: &str) -> String {
        format!(
            "{ADMIN_SPACE}/{}/{}/{}/{id}/{kind}/%/{}/{}",
            self.domain,
            self.zid,
            self.id,
            mangled(&self.name.namespace),
            self.name.name
        )
    }

    /// The token that says that it is there.
    #[must_use]
    pub fn token(&self) -> String {
        self.token_up_to_name(self.id, "NN")
    }
}

/// Something of a node in the graph.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Entity {
    /// The node.
    pub node: NodeEntity,
    /// Its number in the session.
    pub id: u64,
    /// What it is.
    pub kind: Kind,
    /// Its full name, like `/ari/crossguard/status`.
    pub topic: String,
    /// The name of its type, like `std_msgs/msg/String`.
    pub type_name: String,
    /// The hash of its type.
    pub type_hash: String,
    /// Its quality of service.
    pub qos: Qos,
}

impl Entity {
    /// Where its data are.
    #[must_use]
    pub fn key(&self) -> String {
        let topic = self.topic.trim_matches('/');
        let (domain, hash) = (self.node.domain, &self.type_hash);
        format!("{domain}/{topic}/{}/{hash}", dds_name(&self.type_name))
    }

    /// The token that says that it is there.
    #[must_use]
    pub fn token(&self) -> String {
        format!(
            "{}/{}/{}/{}/{}",
            self.node.token_up_to_name(self.id, self.kind.letters()),
            mangled(&self.topic),
            dds_name(&self.type_name),
            self.type_hash,
            self.qos.encoded()
        )
    }

    /// By what it is known in attachments, and in the graph: XXH3 of its token, 128 bits, low ones first.
    #[must_use]
    pub fn gid(&self) -> Gid {
        xxhash_rust::xxh3::xxh3_128(self.token().as_bytes()).to_le_bytes()
    }
}

fn mangled(name: &str) -> String {
    name.replace('/', "%")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn node(namespace: &str) -> NodeEntity {
        NodeEntity {
            domain: 7,
            zid: "a1b2".to_owned(),
            id: 0,
            name: NodeName::new(namespace, "talker").unwrap(),
        }
    }

    #[test]
    fn tokens_and_keys_have_the_form_of_rmw_zenoh() {
        assert_eq!(node("/").token(), "@ros2_lv/7/a1b2/0/0/NN/%/%/talker");
        let entity = Entity {
            node: node("/ns"),
            id: 3,
            kind: Kind::Publisher,
            topic: "/ns/chatter".to_owned(),
            type_name: "std_msgs/msg/String".to_owned(),
            type_hash: "RIHS01_df".to_owned(),
            qos: Qos::depth(10),
        };
        assert_eq!(
            entity.token(),
            "@ros2_lv/7/a1b2/0/3/MP/%/%ns/talker/%ns%chatter/std_msgs::msg::dds_::String_/RIHS01_df/\
             ::,10:,:,:,,"
        );
        assert_eq!(
            entity.key(),
            "7/ns/chatter/std_msgs::msg::dds_::String_/RIHS01_df"
        );
        let octets = entity.gid();
        let hash = xxhash_rust::xxh3::xxh3_128(entity.token().as_bytes());
        assert_eq!(u128::from_le_bytes(octets), hash);
    }

    #[test]
    fn names_are_resolved_from_the_node() {
        let node = NodeName::new("ari/", "crossguard").unwrap();
        for (name, full) in [
            ("~/status", "/ari/crossguard/status"),
            ("/diagnostics", "/diagnostics"),
            ("people", "/ari/people"),
        ] {
            assert_eq!(node.resolve(name).as_deref(), Ok(full));
        }
        let root = NodeName::new("", "crossguard").unwrap();
        assert_eq!(
            root.resolve("~/status").as_deref(),
            Ok("/crossguard/status")
        );
        assert_eq!(root.resolve("people").as_deref(), Ok("/people"));
        for bad in ["/", "", "a//b", "/a b", "~", "/1a", "/a/*"] {
            assert!(root.resolve(bad).is_err(), "{bad}");
        }
        assert!(NodeName::new("/", "a/b").is_err());
        assert!(NodeName::new("/a//b", "c").is_err());
        assert!(NodeName::new("/", &"x".repeat(300)).is_err());
    }
}
