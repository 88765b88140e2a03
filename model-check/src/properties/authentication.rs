//! A property's assumptions on senders: insiders that could break it by a lie.

use std::fmt;

use serde::Serialize;

/// Where an insider that lies stands towards the robots that a property is about. An insider has a certificate, and
/// speaks in its own name alone.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Insider {
    /// A follower that its leader has confirmed.
    Follower,
    /// The leader of its followers.
    Leader,
    /// Neither: a helper that is not confirmed, or a bystander, which may ask for help and lead a team of its own.
    Stranger,
}

impl Insider {
    /// In a sentence.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Follower => "a follower",
            Self::Leader => "a leader",
            Self::Stranger => "a stranger",
        }
    }
}

/// A property's assumptions on senders. Where there are any, each message is of the station that it names, and these insiders do
/// not lie about themselves.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Authentication(Option<&'static [Insider]>);

impl Authentication {
    /// It holds whatever anybody says in any name.
    pub(super) const NONE: Self = Self(None);

    /// Each message is of the station that it names, and stations may lie about themselves.
    pub(super) const NAMES: Self = Self(Some(&[]));

    /// Each message is of the station that it names, and these do not lie about themselves.
    pub(super) const fn truth_of(liars: &'static [Insider]) -> Self {
        Self(Some(liars))
    }

    /// The insiders that can break the property by what they say in their own name.
    #[must_use]
    pub fn liars(self) -> &'static [Insider] {
        self.0.unwrap_or_default()
    }
}

impl fmt::Display for Authentication {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(liars) = self.0 else {
            return f.write_str("none: whatever anybody says in any name");
        };
        f.write_str("each message is of the station that it names")?;
        if liars.is_empty() {
            return f.write_str("; stations may lie about themselves");
        }
        for (i, liar) in liars.iter().enumerate() {
            let before = if i == 0 { "; no lie of " } else { ", of " };
            write!(f, "{before}{}", liar.name())?;
        }
        Ok(())
    }
}
