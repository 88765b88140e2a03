//! What the types of the core have and the modules do not say.

/// The messages that the core has: what they consist of is generated, and nothing else.
pub(crate) const MESSAGES: [&str; 2] = ["RAM", "RMCM"];

/// A type that a module writes out where it is used, and that has a name in Rust.
pub(crate) struct Named {
    /// The SEQUENCE and its component.
    pub(crate) component: (&'static str, &'static str),
    /// Its name in Rust. Components with the same name have the same type.
    pub(crate) name: &'static str,
    /// Its documentation.
    pub(crate) doc: &'static str,
}

const fn named(
    sequence: &'static str,
    component: &'static str,
    name: &'static str,
    doc: &'static str,
) -> Named {
    Named {
        component: (sequence, component),
        name,
        doc,
    }
}

/// Rust has no types without names. The modules keep them without: the dictionary's have none, and
/// those of RAM and RMCM follow its style.
pub(crate) const NAMED: [Named; 7] = [
    named(
        "PolygonalShape",
        "polygon",
        "PolygonCorners",
        "Corners of a polygon.",
    ),
    named(
        "RobotLowFrequencyContainer",
        "pathHistory",
        "RobotPathHistory",
        "Positions that the robot came from, newest first, each relative to the one before it.",
    ),
    named(
        "RequesterRole",
        "followerCount",
        "RequestedFollowers",
        "How many followers are asked for.",
    ),
    named(
        "CrossingReference",
        "regulator",
        "CrossingNumber",
        "Road regulator or intersection of a crossing.",
    ),
    named(
        "CrossingReference",
        "intersection",
        "CrossingNumber",
        "Road regulator or intersection of a crossing.",
    ),
    named(
        "LeaderRole",
        "followers",
        "ConfirmedFollowers",
        "The followers of a session.",
    ),
    named(
        "LeaderManeuverContainer",
        "commands",
        "ManeuverCommands",
        "Commands, each to another follower.",
    ),
];

/// A list that is shorter in a RAM than its type allows.
pub(crate) struct Limit {
    /// The type.
    pub(crate) list: &'static str,
    /// The name of the limit in Rust.
    pub(crate) name: &'static str,
    /// The limit.
    pub(crate) items: usize,
    /// Documentation of the limit.
    pub(crate) doc: &'static str,
}

/// The comment of `RamParameters` has these limits, which keep a RAM well below what one packet can
/// carry. The types are those of the VAM, which has no such limits.
pub(crate) const LIMITS: [Limit; 2] = [
    Limit {
        list: "PathHistory",
        name: "PATH_HISTORY_MAX",
        items: 10,
        doc: "How many points the path history in the motion prediction of a RAM has at most.",
    },
    Limit {
        list: "PathPredicted",
        name: "PATH_PREDICTION_MAX",
        items: 10,
        doc: "How many points the path prediction of a RAM has at most.",
    },
];
