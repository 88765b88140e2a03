//! What the types of the core have and the modules do not say.

/// The messages that the core has: what they consist of is generated, and nothing else.
pub(crate) const MESSAGES: [&str; 2] = ["RAM", "RMCM"];

/// Types that a module writes out where it uses them, and that have a name in Rust: in each line a SEQUENCE, its component,
/// the name and its documentation. Components with the same name have the same type.
///
/// Rust has no types without names. The modules keep them without: the dictionary's have none, and
/// those of RAM and RMCM follow its style.
pub(crate) const NAMED: &str = "\
PolygonalShape polygon PolygonCorners Corners of a polygon.
RobotLowFrequencyContainer pathHistory RobotPathHistory Positions that the robot came from, newest first, each \
relative to the one before it.
RequesterRole followerCount RequestedFollowers How many followers are asked for.
CrossingReference regulator CrossingNumber Road regulator or intersection of a crossing.
CrossingReference intersection CrossingNumber Road regulator or intersection of a crossing.
LeaderRole followers ConfirmedFollowers The followers of a session.
LeaderManeuverContainer commands ManeuverCommands Commands, each to another follower.
";

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
