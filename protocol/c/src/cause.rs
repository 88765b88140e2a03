//! What was dropped or ignored, counted under a named cause. The names are those of the `crossguard` command.

use core::fmt::{self, Display, Formatter, Write};

use crossguard_codec::geonet::Discarded;
use crossguard_codec::{Service, Unheard};
use crossguard_protocol::{Disengagement, Ignored, StationId};

/// Why something was dropped or ignored.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Cause {
    /// A packet is not one for this station.
    Discarded(&'static str),
    /// A packet cannot be relied on.
    Rejected(&'static str),
    /// A message that this station has no use for.
    NoUse(Service),
    /// It waited for longer than `delay_max` before it was given.
    WaitedTooLong,
    /// Octets are not a message.
    Undecodable(&'static str),
    /// A message contradicts itself.
    Contradictory(&'static str),
    /// The transition function ignored an input.
    Ignored(Ignored),
    /// A message could not be made.
    NotSent,
    /// A log line did not fit.
    LogFull,
}

impl Cause {
    /// The cause of an ignored input, without which robot it was about.
    pub(crate) fn ignored(why: Ignored) -> Self {
        Self::Ignored(match why {
            Ignored::NotEngaged(..) => {
                Ignored::NotEngaged(StationId(0), Disengagement::NotExecuting)
            }
            why => why,
        })
    }
}

impl From<Discarded> for Cause {
    fn from(discarded: Discarded) -> Self {
        match discarded {
            Discarded::Envelope(_) | Discarded::WrongPermission { .. } => {
                Self::Rejected(discarded.cause())
            }
            _ => Self::Discarded(discarded.cause()),
        }
    }
}

impl From<&Unheard> for Cause {
    fn from(unheard: &Unheard) -> Self {
        match unheard {
            Unheard::Undecodable(error) => Self::Undecodable(error.cause()),
            Unheard::Contradictory(error) => Self::Contradictory(error.cause()),
        }
    }
}

impl Display for Cause {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Discarded(why) => write!(f, "packet: {why}"),
            Self::Rejected(why) => write!(f, "security: {why}"),
            Self::NoUse(service) => write!(f, "no use for: {}", service.name()),
            Self::WaitedTooLong => f.write_str("waited too long"),
            Self::Undecodable(why) => write!(f, "undecodable: {why}"),
            Self::Contradictory(why) => write!(f, "contradictory: {why}"),
            Self::Ignored(Ignored::NotEngaged(..)) => f.write_str("ignored: not engaged"),
            Self::Ignored(why) => write!(f, "ignored: {why}"),
            Self::NotSent => f.write_str("not sent"),
            Self::LogFull => f.write_str("log full"),
        }
    }
}

/// More causes than there are.
const CAUSES: usize = 96;

/// How often each cause occurred.
#[derive(Clone)]
pub(crate) struct Counters([Option<(Cause, u64)>; CAUSES]);

impl Counters {
    pub(crate) const NONE: Self = Self([None; CAUSES]);

    pub(crate) fn count(&mut self, cause: Cause) {
        for slot in &mut self.0 {
            match slot {
                Some((counted, count)) if *counted == cause => {
                    *count = count.saturating_add(1);
                    return;
                }
                Some(_) => {}
                None => {
                    *slot = Some((cause, 1));
                    return;
                }
            }
        }
    }

    /// The causes that occurred, in the order in which each first did.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (Cause, u64)> + Clone {
        self.0.iter().map_while(|counted| *counted)
    }
}

/// Text that ends where its buffer does.
pub(crate) struct Text<const N: usize> {
    octets: [u8; N],
    length: usize,
}

impl<const N: usize> Text<N> {
    /// What `value` displays as.
    pub(crate) fn of(value: &impl Display) -> Self {
        let mut text = Self {
            octets: [0; N],
            length: 0,
        };
        // It is cut, which is not an error.
        let _ = write!(text, "{value}");
        text
    }

    pub(crate) fn as_str(&self) -> &str {
        core::str::from_utf8(&self.octets[..self.length]).unwrap_or_default()
    }
}

impl<const N: usize> Write for Text<N> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for character in text.chars() {
            let end = self.length + character.len_utf8();
            let room = self.octets.get_mut(self.length..end).ok_or(fmt::Error)?;
            character.encode_utf8(room);
            self.length = end;
        }
        Ok(())
    }
}
