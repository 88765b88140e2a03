//! Quality of service, as far as `rmw_zenoh` has it.
//!
//! It is part of a token, and of no effect otherwise but for reliability and durability: in zenoh every
//! publisher matches every subscription, and deadlines are told to nobody who does not keep them. All that
//! this crate publishes is reliable and volatile, with a history of the last few; a publication that finds
//! a full queue is dropped and not waited for.

use std::fmt::Write as _;
use std::time::Duration;

/// The depth that is left out of a token.
const DEFAULT_DEPTH: u32 = 42;

/// Reliable, volatile, the last few.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Qos {
    /// How many are kept.
    pub depth: u32,
    /// How long there is at most between two messages; `None` for any time.
    pub deadline: Option<Duration>,
}

impl Qos {
    /// The last `depth` messages.
    #[must_use]
    pub const fn depth(depth: u32) -> Self {
        Self {
            depth,
            deadline: None,
        }
    }

    /// The same, with a message at least so often.
    #[must_use]
    pub const fn every(self, deadline: Duration) -> Self {
        Self {
            deadline: Some(deadline),
            ..self
        }
    }

    /// `<reliability>:<durability>:<history>,<depth>:<deadline>:<lifespan>:<liveliness>`, with durations in
    /// seconds and nanoseconds, and nothing where the default is meant.
    #[must_use]
    pub fn encoded(&self) -> String {
        let mut encoded = "::,".to_owned();
        // Writing to a string does not fail.
        if self.depth != DEFAULT_DEPTH {
            let _ = write!(encoded, "{}", self.depth);
        }
        encoded.push(':');
        match self.deadline {
            None => encoded.push(','),
            Some(time) => {
                let _ = write!(encoded, "{},{}", time.as_secs(), time.subsec_nanos());
            }
        }
        encoded + ":,:,,"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_the_default_is_left_out() {
        assert_eq!(Qos::depth(42).encoded(), "::,:,:,:,,");
        assert_eq!(Qos::depth(1).encoded(), "::,1:,:,:,,");
        let often = Qos::depth(1).every(Duration::from_millis(300));
        assert_eq!(often.encoded(), "::,1:0,300000000:,:,,");
    }
}
