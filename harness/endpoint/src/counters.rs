//! Every message that was dropped and every input that was ignored, counted under its cause.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt::{self, Display, Formatter};

use crossguard_codec::geonet::Discarded;
use serde::{Deserialize, Serialize};

use crate::cause::{Cause, Layer};

/// How often each cause occurred.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Counters(BTreeMap<Cause, u64>);

impl Counters {
    /// Counts one occurrence.
    pub fn count(&mut self, cause: Cause) {
        *self.0.entry(cause).or_default() += 1;
    }

    /// How often `cause` occurred.
    #[must_use]
    pub fn of(&self, cause: Cause) -> u64 {
        self.0.get(&cause).copied().unwrap_or_default()
    }

    /// The causes that occurred, each with how often.
    pub fn iter(&self) -> impl Iterator<Item = (Cause, u64)> {
        self.0.iter().map(|(cause, count)| (*cause, *count))
    }

    /// The same by name, for records.
    #[must_use]
    pub fn named(&self) -> Counts {
        let mut counts = Counts::default();
        for (cause, count) in self.iter() {
            counts.add(&cause.into(), count);
        }
        counts
    }
}

/// A cause by name, as records have it.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
pub struct CauseName {
    /// Where it was dropped or ignored.
    pub layer: Layer,
    /// Why.
    #[serde(rename = "cause")]
    pub reason: Cow<'static, str>,
}

impl From<Cause> for CauseName {
    fn from(cause: Cause) -> Self {
        let reason = match cause {
            Cause::Misframed(why)
            | Cause::Discarded(why)
            | Cause::Rejected(why)
            | Cause::Undecodable(why)
            | Cause::Contradictory(why) => Cow::Borrowed(why),
            _ => Cow::Owned(cause.reason().to_string()),
        };
        let layer = cause.layer();
        Self { layer, reason }
    }
}

impl CauseName {
    /// Whether it is a matter of course, which counters tell and lines for people do not: a multicast group, and
    /// a radio that listens to itself, give a robot its own packets.
    #[must_use]
    pub fn is_own_packet(&self) -> bool {
        *self == Self::from(Cause::Discarded(Discarded::OwnPacket.cause()))
    }
}

impl Display for CauseName {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.layer, self.reason)
    }
}

/// How often each cause occurred, by layer and reason: `{"packet": {"duplicate": 3}}`.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Counts(BTreeMap<Layer, BTreeMap<Cow<'static, str>, u64>>);

impl Counts {
    /// Adds `count` occurrences; how many there are then.
    pub fn add(&mut self, cause: &CauseName, count: u64) -> u64 {
        let counted = self.0.entry(cause.layer).or_default();
        let counted = match counted.get_mut(&cause.reason) {
            Some(counted) => counted,
            None => counted.entry(cause.reason.clone()).or_default(),
        };
        *counted += count;
        *counted
    }

    /// Says how often `cause` occurred in all.
    pub fn set(&mut self, cause: &CauseName, count: u64) {
        let counted = self.0.entry(cause.layer).or_default();
        counted.insert(cause.reason.clone(), count);
    }

    /// How often `cause` occurred.
    #[must_use]
    pub fn of(&self, cause: &CauseName) -> u64 {
        let counted = self.0.get(&cause.layer);
        let counted = counted.and_then(|counted| counted.get(&cause.reason));
        counted.copied().unwrap_or_default()
    }

    /// The causes that occurred, by layer and reason, each with how often.
    pub fn iter(&self) -> impl Iterator<Item = (CauseName, u64)> {
        self.0.iter().flat_map(|(&layer, counted)| {
            counted.iter().map(move |(reason, &count)| {
                let reason = reason.clone();
                (CauseName { layer, reason }, count)
            })
        })
    }

    /// How often something was dropped or ignored for any cause in these layers.
    #[must_use]
    pub fn total(&self, is_counted: impl Fn(Layer) -> bool) -> u64 {
        let counted = self.0.iter().filter(|(layer, _)| is_counted(**layer));
        counted.flat_map(|(_, counted)| counted.values()).sum()
    }

    /// Whether nothing was dropped or ignored.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use crossguard_protocol::Ignored;

    use super::*;

    #[test]
    fn counters_are_read_back_as_they_were_written() {
        let mut counters = Counters::default();
        counters.count(Cause::Discarded("duplicate"));
        counters.count(Cause::Discarded("duplicate"));
        counters.count(Ignored::NothingNew.into());
        let counts = counters.named();
        let json = serde_json::to_string(&counts).unwrap();
        assert_eq!(
            json,
            r#"{"packet":{"duplicate":2},"protocol":{"nothing new":1}}"#
        );
        assert_eq!(serde_json::from_str::<Counts>(&json).unwrap(), counts);
        assert_eq!(counts.total(|_| true), 3);
        assert_eq!(counts.of(&Cause::Discarded("duplicate").into()), 2);
    }
}
