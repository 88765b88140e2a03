//! Insiders that lie, by their parts, and whether a scenario fits them; [`utterances`](crate::utterances) says what they do.

use crossguard_protocol::{Coordination, Farewell, Rmcm};
use serde::{Deserialize, Serialize};

use super::file::File;
use super::location::Wrong;
use crate::network::Message;

/// Part of a liar in a session.
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

pub(super) fn check(file: &File) -> Result<(), Wrong> {
    #[rustfmt::skip]
    let others = [
        ("monotone", file.channel.monotone, "an insider says again whatever it has said, so its own messages need no such channel"),
        ("symmetric", !file.symmetric.is_empty(), "it is not modelled who is who among robots to which a liar says different things"),
        ("timed", file.timed.is_some(), "the timed model has no insiders"),
        ("cooperative", file.cooperative, "nothing is assumed of an insider, so nothing comes of cooperation"),
    ];
    let mut liars = file.robots.iter().filter(|robot| robot.lies.is_some());
    if let Some(detects) = liars.clone().find(|robot| robot.detects) {
        let station = detects.station;
        let cause = format!(
            "robot {station} lies, so it detects nobody: it says what it likes without 'detects = true'"
        );
        return Err(Wrong::key("detects", cause));
    }
    if liars.clone().count() == file.robots.len() {
        return Err(Wrong::key("lies", "all robots lie: at least one must not"));
    }
    if liars.next().is_some()
        && let Some((key, _, why)) = others.into_iter().find(|(_, is_set, _)| *is_set)
    {
        let cause = format!("'{key}' and robots that lie exclude each other: {why}");
        return Err(Wrong::key(key, cause));
    }
    Ok(())
}
