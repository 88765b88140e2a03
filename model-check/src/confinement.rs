//! What an insider that lies can do to others at most, and for how long: the confinement table.
//!
//! That it can do no more is what the properties say which assume no truth of it; the scenarios whose names begin
//! with `lying-` explore that. The times follow from the settings. `model-check/tests/confinement.rs` lets robots meet each
//! lie, and measures.

use std::fmt;

use crossguard_protocol::{Config, Coordination, Farewell, Millis, Rmcm, TaskType};
use serde::{Deserialize, Serialize};

use crate::network::Message;
use crate::timed::longest;

/// Who lies, by its part in a session.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LyingPart {
    /// A follower that its leader has confirmed.
    Follower,
    /// A robot that offers its help.
    Helper,
    /// A station that has no part in the session that it disturbs.
    Bystander,
    /// A leader.
    Leader,
}

impl LyingPart {
    /// Whether an insider in this part says such a thing. A bystander says everything but that it helps.
    #[must_use]
    pub const fn says(self, message: &Message) -> bool {
        let is_to_leader = match message {
            Message::Rmcm(Rmcm::Command(_)) => false,
            Message::Rmcm(Rmcm::Answer(_)) => true,
            Message::Ram(ram) => match ram.coordination {
                Coordination::NeedHelp { .. } | Coordination::Leader { .. } => false,
                Coordination::OfferHelp { .. } => {
                    return matches!(self, Self::Follower | Self::Helper);
                }
                Coordination::Follower { .. } => true,
                Coordination::None => !matches!(ram.farewell, Some(Farewell::Ended(..))),
            },
        };
        match self {
            Self::Follower | Self::Helper => is_to_leader,
            Self::Leader => !is_to_leader,
            Self::Bystander => true,
        }
    }
}

impl fmt::Display for LyingPart {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Follower => "a follower",
            Self::Helper => "a helper",
            Self::Bystander => "a bystander",
            Self::Leader => "a leader",
        })
    }
}

/// One thing that an insider can do by lying.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Harm {
    /// A follower says that it guards where it does not, and goes on saying so.
    SaysThatItGuards,
    /// A follower says that it guards, and is silent from then on.
    GuardsAndIsSilent,
    /// A helper offers and takes back, so that no roles come about.
    OffersAndTakesBack,
    /// A helper is confirmed, and does not join.
    DoesNotJoin,
    /// A bystander asks for help, and so reserves a robot.
    Reserves,
    /// A bystander asked for help, and is silent from then on.
    ReservesAndIsSilent,
    /// A bystander leads at the same place.
    LeadsThere,
    /// A bystander leads with ever new sessions at a place where two others lead.
    KeepsApart,
    /// A leader keeps robots that joined it.
    Keeps,
    /// A leader is silent from then on: its followers stop or hold.
    LeadsAndIsSilent,
    /// A leader is silent from then on: its followers are free.
    LeadsAndIsGone,
}

/// A row of the table.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Confinement {
    /// Which.
    pub harm: Harm,
    /// Who lies.
    pub part: LyingPart,
    /// What it can do.
    pub can: &'static str,
    /// From when to when the time counts.
    pub from_to: &'static str,
    /// How the time follows from the settings, where there is a limit.
    pub formula: &'static str,
    /// The longest time, in milliseconds of true time; `None` where it goes on for as long as the insider does.
    pub at_most: Option<Millis>,
}

const fn row(
    harm: Harm,
    part: LyingPart,
    can: &'static str,
    from_to: &'static str,
    formula: &'static str,
    at_most: Option<Millis>,
) -> Confinement {
    Confinement {
        harm,
        part,
        can,
        from_to,
        formula,
        at_most,
    }
}

/// The table of robots with these settings.
#[must_use]
pub fn table(config: &Config) -> [Confinement; 11] {
    use Harm as H;
    use LyingPart as P;
    let settings = config.settings();
    let timer = |timer: Millis| Some(longest(timer, settings));
    let exec = settings.t_exec[usize::from(TaskType::BLOCK.value())];
    let stopped = longest(settings.t_safety, settings);
    [
        row(
            H::SaysThatItGuards,
            P::Follower,
            "says that it guards where it does not",
            "from its acknowledgement of a command to the sign at stop",
            "longest(t_exec)",
            timer(exec),
        ),
        row(
            H::GuardsAndIsSilent,
            P::Follower,
            "says that it guards, and is silent",
            "from its last RAM to the sign at stop",
            "longest(t_lease)",
            timer(settings.t_lease),
        ),
        row(
            H::OffersAndTakesBack,
            P::Helper,
            "offers and takes back, so that a request gets no roles",
            "from the request to its end",
            "longest(t_help)",
            timer(settings.t_help),
        ),
        row(
            H::DoesNotJoin,
            P::Helper,
            "offers, is confirmed, and does not join",
            "from the roles to its place given up",
            "longest(t_safety + t_leave)",
            timer(config.t_lost()),
        ),
        row(
            H::Reserves,
            P::Bystander,
            "asks for help, and so reserves an idle robot",
            "from the offer to the robot free",
            "longest(t_lock - t_farewell)",
            timer(config.t_lock_session()),
        ),
        row(
            H::ReservesAndIsSilent,
            P::Bystander,
            "asked for help, and is silent",
            "from its last RAM to the robot free",
            "longest(t_offer)",
            timer(settings.t_offer),
        ),
        row(
            H::LeadsThere,
            P::Bystander,
            "leads at the same place, and goes before a request or a session there",
            "for as long as it goes on, once for each session",
            "",
            None,
        ),
        row(
            H::KeepsApart,
            P::Bystander,
            "leads in ever new sessions, so that neither of two leaders at one place yields to the other",
            "for as long as it goes on",
            "",
            None,
        ),
        row(
            H::Keeps,
            P::Leader,
            "commands the robots that joined it, and keeps them",
            "from the join to the robot free",
            "longest(t_lock - t_farewell)",
            timer(config.t_lock_session()),
        ),
        row(
            H::LeadsAndIsSilent,
            P::Leader,
            "commanded, and is silent",
            "from its last RAM to the maneuver ended",
            "longest(t_safety)",
            Some(stopped),
        ),
        row(
            H::LeadsAndIsGone,
            P::Leader,
            "led, and is silent",
            "from its last RAM to the robot free",
            "longest(t_safety) + longest(t_leave)",
            Some(stopped.saturating_add(longest(settings.t_leave, settings))),
        ),
    ]
}
