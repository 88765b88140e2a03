//! Why a station does not trust its own clock.

use std::fmt::{self, Display, Formatter};

/// Why the clock is not trusted.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Doubt {
    /// It is behind a time that has been, by so many µs.
    Behind(u64),
    /// It has leapt ahead by so many µs.
    Ahead(u64),
}

impl Display for Doubt {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Behind(us) => write!(f, "{} ms behind a time that has been", us / 1_000),
            Self::Ahead(us) => write!(f, "{} ms ahead at a leap", us / 1_000),
        }
    }
}
