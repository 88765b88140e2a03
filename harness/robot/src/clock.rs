//! Whether a robot trusts its clock, for its log and for who watches it.

use std::fmt::{self, Display, Formatter};

use crossguard_codec::security::{Doubt, TrustedTime};
use serde::{Deserialize, Serialize};

/// Whether a robot that verifies trusts its clock. If it does not, it accepts nothing that is signed.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(tag = "is", rename_all = "camelCase")]
pub enum ClockState {
    /// It does.
    Trusted,
    /// The clock is behind a time that has been.
    Behind {
        /// By so many ms.
        ms: u64,
    },
    /// The clock has leapt ahead.
    Ahead {
        /// By so many ms.
        ms: u64,
    },
}

impl ClockState {
    pub(crate) const fn of(time: &TrustedTime) -> Self {
        match time.doubt() {
            None => Self::Trusted,
            Some(Doubt::Behind(us)) => Self::Behind { ms: us / 1_000 },
            Some(Doubt::Ahead(us)) => Self::Ahead { ms: us / 1_000 },
        }
    }

    /// Whether it trusts its clock.
    #[must_use]
    pub const fn is_trusted(self) -> bool {
        matches!(self, Self::Trusted)
    }
}

impl Display for ClockState {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Trusted => write!(f, "the clock is trusted"),
            Self::Behind { ms } => write!(
                f,
                "time not trusted: the clock is {ms} ms behind a time that has been, and nothing signed is accepted until \
                 it is there. If it is right, and was wrong before, stop the robot and delete the file '.time' beside its \
                 boot counter"
            ),
            Self::Ahead { ms } => write!(
                f,
                "time not trusted: the clock has leapt {ms} ms ahead, and nothing signed is accepted until it is back or has \
                 gone on for a minute"
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::ClockState;

    /// In a log, other fields may stand beside it: those of older versions have a link to the line before.
    #[test]
    fn it_is_read_beside_other_fields_of_its_line() {
        for state in [ClockState::Trusted, ClockState::Behind { ms: 4_000 }] {
            let mut fields = serde_json::to_value(state).unwrap();
            fields["link"] = "8ab20a3e3fff82c4".into();
            assert_eq!(serde_json::from_value::<ClockState>(fields).unwrap(), state);
        }
    }
}
