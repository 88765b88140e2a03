//! The lifecycle of a managed node in ROS 2, as far as it is one of states and names.
//!
//! ```text
//!                configure             activate
//!  unconfigured ──────────► inactive ──────────► active
//!        │  ◄──────────      │   ▲  ◄──────────    │
//!        │    cleanup        │   │   deactivate    │
//!        └───────────────────┴─ shutdown ──────────┴──► finalized
//! ```
//!
//! Each arrow goes over a state of its own, in which nothing else can be asked for. Numbers and names are
//! those of `lifecycle_msgs` and `rcl_lifecycle`.

use crate::standard;

/// A state of the lifecycle.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[repr(u8)]
pub enum LifecycleState {
    /// It has no configuration.
    Unconfigured = 1,
    /// It has one, and the robot is not there.
    Inactive = 2,
    /// The robot is there.
    Active = 3,
    /// It is of no use any more.
    Finalized = 4,
    /// On the way from unconfigured to inactive.
    Configuring = 10,
    /// On the way from inactive to unconfigured.
    CleaningUp = 11,
    /// On the way to finalized.
    ShuttingDown = 12,
    /// On the way from inactive to active.
    Activating = 13,
    /// On the way from active to inactive.
    Deactivating = 14,
}

impl LifecycleState {
    /// All that a node can be in.
    pub const ALL: [Self; 9] = [
        Self::Unconfigured,
        Self::Inactive,
        Self::Active,
        Self::Finalized,
        Self::Configuring,
        Self::CleaningUp,
        Self::ShuttingDown,
        Self::Activating,
        Self::Deactivating,
    ];

    /// Its name.
    #[must_use]
    pub const fn label(self) -> &'static str {
        match self {
            Self::Unconfigured => "unconfigured",
            Self::Inactive => "inactive",
            Self::Active => "active",
            Self::Finalized => "finalized",
            Self::Configuring => "configuring",
            Self::CleaningUp => "cleaningup",
            Self::ShuttingDown => "shuttingdown",
            Self::Activating => "activating",
            Self::Deactivating => "deactivating",
        }
    }

    /// As a message has it.
    #[must_use]
    pub fn message(self) -> standard::State {
        standard::State {
            id: self as u8,
            label: self.label().to_owned(),
        }
    }
}

/// What can be asked for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Verb {
    /// To read the configuration.
    Configure,
    /// To forget it.
    CleanUp,
    /// To have the robot there.
    Activate,
    /// To have it leave.
    Deactivate,
    /// To end.
    ShutDown,
}

/// Where a verb leads from a state: its number, and over which state to which.
struct Way {
    verb: Verb,
    id: u8,
    from: LifecycleState,
    over: LifecycleState,
    to: LifecycleState,
}

const fn way(
    verb: Verb,
    id: u8,
    from: LifecycleState,
    over: LifecycleState,
    to: LifecycleState,
) -> Way {
    Way {
        verb,
        id,
        from,
        over,
        to,
    }
}

const WAYS: [Way; 7] = [
    way(
        Verb::Configure,
        1,
        LifecycleState::Unconfigured,
        LifecycleState::Configuring,
        LifecycleState::Inactive,
    ),
    way(
        Verb::CleanUp,
        2,
        LifecycleState::Inactive,
        LifecycleState::CleaningUp,
        LifecycleState::Unconfigured,
    ),
    way(
        Verb::Activate,
        3,
        LifecycleState::Inactive,
        LifecycleState::Activating,
        LifecycleState::Active,
    ),
    way(
        Verb::Deactivate,
        4,
        LifecycleState::Active,
        LifecycleState::Deactivating,
        LifecycleState::Inactive,
    ),
    way(
        Verb::ShutDown,
        5,
        LifecycleState::Unconfigured,
        LifecycleState::ShuttingDown,
        LifecycleState::Finalized,
    ),
    way(
        Verb::ShutDown,
        6,
        LifecycleState::Inactive,
        LifecycleState::ShuttingDown,
        LifecycleState::Finalized,
    ),
    way(
        Verb::ShutDown,
        7,
        LifecycleState::Active,
        LifecycleState::ShuttingDown,
        LifecycleState::Finalized,
    ),
];

impl Way {
    const fn label(&self) -> &'static str {
        match self.verb {
            Verb::Configure => "configure",
            Verb::CleanUp => "cleanup",
            Verb::Activate => "activate",
            Verb::Deactivate => "deactivate",
            Verb::ShutDown => "shutdown",
        }
    }

    fn transition(&self) -> standard::Transition {
        standard::Transition {
            id: self.id,
            label: self.label().to_owned(),
        }
    }

    /// That its work was done, or not.
    fn end(&self, well: bool) -> standard::Transition {
        // Ten numbers for the ends of each of the five.
        let ends = match self.verb {
            Verb::ShutDown => 5,
            _ => self.id,
        };
        let label = if well {
            "transition_success"
        } else {
            "transition_failure"
        };
        standard::Transition {
            id: ends * 10 + u8::from(!well),
            label: label.to_owned(),
        }
    }
}

/// Something is asked for that is not possible now.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("there is no transition '{asked}' from the state {}", state.label())]
pub struct NotNow {
    /// What was asked for.
    pub asked: String,
    /// In which state.
    pub state: LifecycleState,
}

/// Where a node is in its lifecycle.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Lifecycle {
    state: LifecycleState,
    /// The way that it is on: its index.
    under_way: Option<usize>,
}

impl Default for Lifecycle {
    fn default() -> Self {
        Self {
            state: LifecycleState::Unconfigured,
            under_way: None,
        }
    }
}

impl Lifecycle {
    /// Where it is.
    #[must_use]
    pub const fn state(&self) -> LifecycleState {
        self.state
    }

    /// What a transition asks for now: by its name, or by its number where it has no name.
    ///
    /// # Errors
    /// When it is not possible from here.
    pub fn asked(&self, transition: &standard::Transition) -> Result<Verb, NotNow> {
        let is_meant = |way: &&Way| match transition.label.as_str() {
            "" => way.id == transition.id,
            label => way.label() == label,
        };
        let mut ways = WAYS.iter().filter(|way| way.from == self.state);
        let way = ways.find(is_meant).ok_or_else(|| NotNow {
            asked: match transition.label.as_str() {
                "" => transition.id.to_string(),
                label => label.to_owned(),
            },
            state: self.state,
        })?;
        Ok(way.verb)
    }

    /// Sets out. What happened, but for when.
    ///
    /// # Errors
    /// When there is no such way from here.
    pub fn begin(&mut self, verb: Verb) -> Result<standard::TransitionEvent, NotNow> {
        let from = self.state;
        let index = WAYS
            .iter()
            .position(|way| way.from == from && way.verb == verb)
            .ok_or_else(|| NotNow {
                asked: format!("{verb:?}").to_lowercase(),
                state: from,
            })?;
        let way = &WAYS[index];
        self.state = way.over;
        self.under_way = Some(index);
        Ok(event(way.transition(), from, way.over))
    }

    /// Arrives, or goes back where the work could not be done. What happened, if it was under way.
    pub fn end(&mut self, well: bool) -> Option<standard::TransitionEvent> {
        let way = &WAYS[self.under_way.take()?];
        let from = self.state;
        self.state = if well { way.to } else { way.from };
        Some(event(way.end(well), from, self.state))
    }

    /// The ways from here, and with `everywhere` from all states.
    #[must_use]
    pub fn ways(&self, everywhere: bool) -> Vec<standard::TransitionDescription> {
        let ways = WAYS
            .iter()
            .filter(|way| everywhere || way.from == self.state);
        let described = ways.map(|way| standard::TransitionDescription {
            transition: way.transition(),
            start_state: way.from.message(),
            goal_state: way.over.message(),
        });
        described.collect()
    }
}

fn event(
    transition: standard::Transition,
    from: LifecycleState,
    to: LifecycleState,
) -> standard::TransitionEvent {
    standard::TransitionEvent {
        timestamp: 0,
        transition,
        start_state: from.message(),
        goal_state: to.message(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn named(label: &str, id: u8) -> standard::Transition {
        standard::Transition {
            id,
            label: label.to_owned(),
        }
    }

    #[test]
    fn a_node_goes_up_and_down_and_ends() {
        let mut node = Lifecycle::default();
        for (verb, over, to) in [
            (
                Verb::Configure,
                LifecycleState::Configuring,
                LifecycleState::Inactive,
            ),
            (
                Verb::Activate,
                LifecycleState::Activating,
                LifecycleState::Active,
            ),
            (
                Verb::Deactivate,
                LifecycleState::Deactivating,
                LifecycleState::Inactive,
            ),
            (
                Verb::CleanUp,
                LifecycleState::CleaningUp,
                LifecycleState::Unconfigured,
            ),
            (
                Verb::ShutDown,
                LifecycleState::ShuttingDown,
                LifecycleState::Finalized,
            ),
        ] {
            node.begin(verb).unwrap();
            assert_eq!(node.state(), over);
            // Nothing else can be asked for on the way.
            assert!(node.asked(&named("shutdown", 0)).is_err());
            node.end(true).unwrap();
            assert_eq!(node.state(), to);
        }
        assert_eq!(node.ways(false), []);
        assert_eq!(node.ways(true).len(), 7);
    }

    #[test]
    fn what_is_asked_is_known_by_name_or_number_and_only_where_it_is_possible() {
        let mut node = Lifecycle::default();
        assert_eq!(node.asked(&named("", 1)), Ok(Verb::Configure));
        assert_eq!(node.asked(&named("shutdown", 0)), Ok(Verb::ShutDown));
        assert_eq!(node.asked(&named("", 5)), Ok(Verb::ShutDown));
        // That of another state.
        assert!(node.asked(&named("", 7)).is_err());
        let error = node.asked(&named("activate", 3)).unwrap_err();
        assert_eq!(
            error.to_string(),
            "there is no transition 'activate' from the state unconfigured"
        );
        assert!(node.begin(Verb::Activate).is_err());
        assert_eq!(node.end(true), None);
    }

    #[test]
    fn work_that_could_not_be_done_leads_back() {
        let mut node = Lifecycle::default();
        let began = node.begin(Verb::Configure).unwrap();
        assert_eq!((began.transition.id, began.goal_state.id), (1, 10));
        let ended = node.end(false).unwrap();
        assert_eq!((ended.transition.id, ended.goal_state.id), (11, 1));
        assert_eq!(ended.transition.label, "transition_failure");
        assert_eq!(node.state(), LifecycleState::Unconfigured);
    }
}
