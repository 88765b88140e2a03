//! Maneuvers, what a leader asks for, and what a robot is able and willing to do.

use core::fmt;

use crate::MAX_FOLLOWERS;
use crate::words::words;

/// The kind of a maneuver, `taskType` of the paper (0..15 on the wire).
///
/// Some kinds have names, [`TaskType::NAMED`]; a robot may give meaning to the others in its
/// configuration.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "u8", into = "u8"))]
pub struct TaskType(u8);

macro_rules! named_tasks {
    ($(#[doc = $meaning:literal] $constant:ident = $value:literal, $name:literal;)*) => {
        impl TaskType {
            $(#[doc = $meaning] pub const $constant: Self = Self($value);)*

            /// Every task type that has a name: the type, its name, its meaning.
            pub const NAMED: &[(Self, &str, &str)] = &[$((Self($value), $name, $meaning)),*];
        }
    };
}

// The one list of named tasks. `cargo xtask bless tasks` writes them into ASN.1, C, C++, Python and ROS 2.
named_tasks! {
    /// Go to the place where the maneuver starts.
    INITIAL_POS = 0, "initialPos";
    /// Escort: move along with the pedestrian.
    MOVE = 1, "move";
    /// Hold back one direction of traffic.
    BLOCK = 2, "block";
}

impl TaskType {
    /// Number of task types that the wire can carry.
    pub const COUNT: usize = 16;

    /// The task type with this value, `None` above 15.
    #[must_use]
    pub const fn new(value: u8) -> Option<Self> {
        if (value as usize) < Self::COUNT {
            Some(Self(value))
        } else {
            None
        }
    }

    /// The value on the wire.
    #[must_use]
    pub const fn value(self) -> u8 {
        self.0
    }

    /// The paper's name, where it has one.
    #[must_use]
    pub const fn name(self) -> Option<&'static str> {
        let mut i = 0;
        while i < Self::NAMED.len() {
            let (task, name, _) = Self::NAMED[i];
            if task.0 == self.0 {
                return Some(name);
            }
            i += 1;
        }
        None
    }
}

/// The names of all task types, for messages about one that does not exist.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct TaskNames;

impl fmt::Display for TaskNames {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (_, name, _) in TaskType::NAMED {
            write!(f, "{name}, ")?;
        }
        let (first, last) = (TaskType::NAMED.len(), TaskType::COUNT - 1);
        write!(f, "or task{first} to task{last}")
    }
}

impl fmt::Display for TaskType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.name() {
            Some(name) => f.pad(name),
            None => write!(f, "task{}", self.0),
        }
    }
}

impl From<TaskType> for u8 {
    fn from(task: TaskType) -> Self {
        task.0
    }
}

/// A value that is no task type: it is above 15.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct NoSuchTask(pub u8);

impl fmt::Display for NoSuchTask {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "task type {} does not exist, the largest is {}",
            self.0,
            TaskType::COUNT - 1
        )
    }
}

impl core::error::Error for NoSuchTask {}

impl TryFrom<u8> for TaskType {
    type Error = NoSuchTask;

    fn try_from(value: u8) -> Result<Self, NoSuchTask> {
        Self::new(value).ok_or(NoSuchTask(value))
    }
}

/// A set of task types: bit *n* stands for task type *n*.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(transparent))]
pub struct TaskSet(pub u16);

impl TaskSet {
    /// No task at all.
    pub const EMPTY: Self = Self(0);

    /// The set of the given task types.
    #[must_use]
    pub const fn of(tasks: &[TaskType]) -> Self {
        let mut bits = 0;
        let mut i = 0;
        while i < tasks.len() {
            bits |= 1 << tasks[i].0;
            i += 1;
        }
        Self(bits)
    }

    /// True if `task` is in the set.
    #[must_use]
    pub const fn contains(self, task: TaskType) -> bool {
        self.0 >> task.0 & 1 == 1
    }

    /// The task types in both sets.
    #[must_use]
    pub const fn intersection(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// The task types of this set that are not in the other.
    #[must_use]
    pub const fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// True if the set is empty.
    #[must_use]
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// How many task types the set holds.
    #[must_use]
    pub const fn len(self) -> u32 {
        self.0.count_ones()
    }

    /// The task types of the set, in order.
    pub fn iter(self) -> impl Iterator<Item = TaskType> {
        (0..16)
            .map(TaskType)
            .filter(move |&task| self.contains(task))
    }
}

words! {
    /// How urgent a request for help is, lowest first.
    pub enum Urgency #[derive(PartialOrd, Ord)] {
        /// Nobody waits at the kerb yet.
        Low = 0;
        /// A pedestrian waits.
        Medium = 1;
        /// A pedestrian who needs more help than others waits.
        High = 2;
        /// A pedestrian is on the road.
        Emergency = 3;
    }
}

#[expect(
    clippy::derivable_impls,
    reason = "the macro has no place for a default"
)]
impl Default for Urgency {
    fn default() -> Self {
        Self::Medium
    }
}

/// The help that a leader asks for when it has detected a pedestrian.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct HelpRequest {
    /// How urgent it is; the first key in the order of requests.
    pub urgency: Urgency,
    /// How many followers the task needs, 1..=[`MAX_FOLLOWERS`].
    pub followers: u8,
    /// The maneuvers that the followers will be asked for.
    pub tasks: TaskSet,
    /// The crossing that the help is for. Requests and leaders compete where they may be at one place.
    #[cfg_attr(feature = "serde", serde(default))]
    pub place: Place,
}

impl HelpRequest {
    /// True if the request can be met at all.
    pub(crate) const fn is_possible(self) -> bool {
        self.followers >= 1 && self.followers as usize <= MAX_FOLLOWERS && !self.tasks.is_empty()
    }
}

/// The crossing of a request and of its session, as `IntersectionReferenceID` of ISO/TS 19091 names it:
/// road regulator in the upper 16 bits, intersection in the lower.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(transparent))]
pub struct Place(pub u32);

impl Place {
    /// Not known. It may be any place, so it competes with all of them.
    pub const UNKNOWN: Self = Self(0);

    /// True if the two may be one place: they are equal, or one of them is unknown.
    #[must_use]
    pub const fn may_be(self, other: Self) -> bool {
        self.0 == other.0 || self.0 == Self::UNKNOWN.0 || other.0 == Self::UNKNOWN.0
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if *self == Self::UNKNOWN {
            return f.pad("an unknown place");
        }
        write!(f, "{}:{}", self.0 >> 16, self.0 & 0xffff)
    }
}

/// The readiness of a robot for coordination.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
pub enum Availability {
    /// It does.
    #[default]
    Available,
    /// It does not, for this reason.
    Unavailable(Unavailability),
}

words! {
    /// Why a robot takes no part in coordination.
    pub enum Unavailability #[derive(PartialOrd, Ord)] {
        /// The battery is below the robot's limit.
        LowBattery = 1;
        /// A person steers the robot.
        Teleoperated = 2;
        /// The emergency stop is engaged.
        EmergencyStop = 3;
        /// A fault of the robot.
        LocalFault = 4;
        /// The application holds it unsafe to act.
        NotSafe = 5;
    }
}

impl Unavailability {
    /// True if the robot can still carry out a fallback policy. A robot under emergency stop, with a
    /// fault, or steered by a person cannot: its body is not its own to command.
    #[must_use]
    pub const fn can_fall_back(self) -> bool {
        matches!(self, Self::LowBattery | Self::NotSafe)
    }
}

words! {
    /// A follower's act with a running maneuver at every end but a completed crossing: contact lost,
    /// session aborted, left, or not listed any more.
    pub enum FallbackPolicy {
        /// Stop where it stands.
        StopInPlace = 0;
        /// Leave the carriageway for the safe position that the application knows.
        GoToSafePosition = 1;
        /// Stay at the side of the escorted person to the nearer kerb, then stop.
        EscortToKerb = 2;
        /// Hold the position and the traffic until the carriageway is clear, then stop.
        HoldUntilClear = 3;
    }
}

#[cfg(test)]
mod tests {
    use std::string::ToString;

    use super::*;

    #[test]
    fn each_task_type_has_one_name() {
        assert_eq!(TaskType::MOVE.name(), Some("move"));
        let unnamed = TaskType::new(3).unwrap();
        assert_eq!(unnamed.name(), None);
        assert_eq!(unnamed.to_string(), "task3");
        assert_eq!(
            TaskNames.to_string(),
            "initialPos, move, block, or task3 to task15"
        );
    }

    #[test]
    fn a_set_holds_what_it_was_made_of() {
        let set = TaskSet::of(&[TaskType::MOVE, TaskType::BLOCK]);
        assert!(set.iter().eq([TaskType::MOVE, TaskType::BLOCK]));
        assert!(!set.contains(TaskType::INITIAL_POS));
        assert_eq!(set.len(), 2);
    }

    #[test]
    fn a_value_above_fifteen_is_no_task() {
        assert_eq!(TaskType::new(15).map(TaskType::value), Some(15));
        assert_eq!(TaskType::try_from(1).map(u8::from), Ok(1));
        let none = TaskType::try_from(16).unwrap_err();
        assert_eq!(
            none.to_string(),
            "task type 16 does not exist, the largest is 15"
        );
    }
}
