//! Faults on purpose: what becomes of each datagram on one way from a sender to a receiver, the same
//! at every run with a seed.

use std::fmt;
use std::str::FromStr;

use crossguard_endpoint::cause::Loss;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::Serialize;

/// By how much a datagram that is to be overtaken is held back at most, in ms: longer than the
/// period of RAM in a session.
const HOLD_MAX_MS: u32 = 150;

/// Which faults one way has. The default is none at all.
///
/// As text it is a list like `loss=0.1,burst=0.4x8,duplication=0.1,reordering=0.1,delay=5..50`.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
pub struct Faults {
    /// Probability with which a datagram is lost, whatever becomes of others. 0..=1
    pub loss: f64,
    /// Loss in bursts.
    pub burst: Option<Burst>,
    /// Probability with which a datagram arrives twice. 0..=1
    pub duplication: f64,
    /// Probability with which a datagram is held back so that later ones overtake it. 0..=1
    pub reordering: f64,
    /// How long datagrams are under way.
    pub delay: Delay,
    /// When nothing gets through.
    pub outages: Vec<Outage>,
}

/// Loss by the Gilbert-Elliott model: the way is good or bad, and while it is bad everything is lost.
/// It may turn with each datagram.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Burst {
    /// The share of datagrams that are lost in the long run. 0..1
    pub loss: f64,
    /// How many datagrams are lost in a row on average; at least 1.
    pub length: f64,
}

/// How long a datagram is under way.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Delay {
    /// At least, in ms.
    pub min_ms: u32,
    /// At most, in ms.
    pub max_ms: u32,
    /// `None`: every delay between the two is as likely as any other. Otherwise the mean of an
    /// exponential distribution above the shortest, in ms, cut off at the longest.
    pub mean_ms: Option<f64>,
}

/// A time in which nothing gets through: a partition, where all ways between two groups have it.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Outage {
    /// From then on, in ms since the channel began.
    pub from_ms: u64,
    /// Until then.
    pub until_ms: u64,
}

/// Fate of a datagram.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Fate {
    /// It is lost.
    Lost(Loss),
    /// It arrives.
    Arrives {
        /// After so long.
        after_us: u64,
        /// And once more, after so long.
        again_after_us: Option<u64>,
    },
}

/// One way from a sender to a receiver.
#[derive(Clone, Debug)]
pub struct Channel {
    faults: Faults,
    draws: ChaCha8Rng,
    is_bad: bool,
}

impl Channel {
    /// A way with these faults, drawn from this seed.
    #[must_use]
    pub fn new(faults: Faults, seed: u64) -> Self {
        Self {
            faults,
            draws: ChaCha8Rng::seed_from_u64(seed),
            is_bad: false,
        }
    }

    /// The way without faults from now on. Datagrams take as long as before, and this long at most.
    pub fn heal(&mut self, max_ms: u32) {
        let mut delay = self.faults.delay;
        delay.max_ms = delay.max_ms.min(max_ms);
        delay.min_ms = delay.min_ms.min(max_ms);
        self.faults = Faults {
            delay,
            ..Faults::default()
        };
    }

    /// Fate of a datagram that is sent `now_us` microseconds after the channel began.
    pub fn fate(&mut self, now_us: u64) -> Fate {
        // Everything is drawn for every datagram, so that one fault more does not change the others.
        let in_burst = self.turn();
        let random = self.draws.random_bool(clamped(self.faults.loss));
        let again = self.draws.random_bool(clamped(self.faults.duplication));
        let (first, second) = (self.delay_us(), self.delay_us());
        let is_out = |o: &Outage| (o.from_ms..o.until_ms).contains(&(now_us / 1_000));
        if self.faults.outages.iter().any(is_out) {
            Fate::Lost(Loss::Outage)
        } else if in_burst {
            Fate::Lost(Loss::Burst)
        } else if random {
            Fate::Lost(Loss::Random)
        } else {
            Fate::Arrives {
                after_us: first,
                again_after_us: again.then_some(second),
            }
        }
    }

    /// Whether the way is bad for the next datagram.
    fn turn(&mut self) -> bool {
        let Some(Burst { loss, length }) = self.faults.burst else {
            return false;
        };
        let to_good = 1.0 / length.max(1.0);
        // In the long run the way is bad for a share of p / (p + q) of the datagrams.
        let to_bad = to_good * loss / (1.0 - loss).max(f64::MIN_POSITIVE);
        let turns = if self.is_bad { to_good } else { to_bad };
        self.is_bad ^= self.draws.random_bool(clamped(turns));
        self.is_bad
    }

    fn delay_us(&mut self) -> u64 {
        let Delay {
            min_ms,
            max_ms,
            mean_ms,
        } = self.faults.delay;
        let (min, max) = (f64::from(min_ms), f64::from(max_ms.max(min_ms)));
        let uniform = self.draws.random::<f64>();
        let ms = match mean_ms {
            None => min + uniform * (max - min),
            Some(mean) => (min - mean * (1.0 - uniform).ln()).min(max),
        };
        let is_held = self.draws.random_bool(clamped(self.faults.reordering));
        let held = self.draws.random_range(0..=HOLD_MAX_MS);
        let ms = ms + if is_held { f64::from(held) } else { 0.0 };
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "in range"
        )]
        let us = (ms * 1_000.0) as u64;
        us
    }
}

impl Faults {
    /// Independent loss alone, with this probability, 0 to 1.
    #[must_use]
    pub fn loss(loss: f64) -> Self {
        Self {
            loss,
            ..Self::default()
        }
    }

    /// The longest time that a datagram is under way, in ms.
    #[must_use]
    pub fn delay_max_ms(&self) -> u32 {
        let held = if self.reordering > 0.0 {
            HOLD_MAX_MS
        } else {
            0
        };
        self.delay.max_ms.max(self.delay.min_ms) + held
    }

    /// Whether nothing ever goes wrong or takes time.
    #[must_use]
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }
}

fn clamped(probability: f64) -> f64 {
    probability.clamp(0.0, 1.0)
}

/// Why a text is no list of faults.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum FaultsError {
    /// There is no such fault.
    #[error(
        "no fault '{0}'; there are loss=P, burst=PxLENGTH, duplication=P, reordering=P, \
         delay=MIN..MAX or delay=MIN..MAX~MEAN (the mean above MIN), and outage=FROM..UNTIL, in ms"
    )]
    Unknown(String),
    /// The value means nothing.
    #[error("'{fault}={value}': {wanted} is wanted")]
    Value {
        /// The fault.
        fault: &'static str,
        /// The value there.
        value: String,
        /// The value that was wanted.
        wanted: &'static str,
    },
}

impl FromStr for Faults {
    type Err = FaultsError;

    fn from_str(text: &str) -> Result<Self, FaultsError> {
        let mut faults = Self::default();
        for part in text.split(',').filter(|part| !part.is_empty()) {
            let (name, value) = part.split_once('=').unwrap_or((part, ""));
            match name {
                "loss" => faults.loss = probability("loss", value)?,
                "burst" => faults.burst = Some(burst(value)?),
                "duplication" => faults.duplication = probability("duplication", value)?,
                "reordering" => faults.reordering = probability("reordering", value)?,
                "delay" => faults.delay = delay(value)?,
                "outage" => faults.outages.push(outage(value)?),
                other => return Err(FaultsError::Unknown(other.to_owned())),
            }
        }
        Ok(faults)
    }
}

fn wrong(fault: &'static str, value: &str, wanted: &'static str) -> FaultsError {
    let value = value.to_owned();
    FaultsError::Value {
        fault,
        value,
        wanted,
    }
}

fn probability(fault: &'static str, value: &str) -> Result<f64, FaultsError> {
    let number = value.parse().ok().filter(|p| (0.0..=1.0).contains(p));
    number.ok_or_else(|| wrong(fault, value, "a probability from 0 to 1"))
}

fn burst(value: &str) -> Result<Burst, FaultsError> {
    let wanted = "a share below 1 and a mean length from 1, like 0.4x8,";
    let parse = || {
        let (loss, length) = value.split_once('x')?;
        let (loss, length): (f64, f64) = (loss.parse().ok()?, length.parse().ok()?);
        ((0.0..1.0).contains(&loss) && (1.0..=1e6).contains(&length))
            .then_some(Burst { loss, length })
    };
    parse().ok_or_else(|| wrong("burst", value, wanted))
}

fn delay(value: &str) -> Result<Delay, FaultsError> {
    let parse = || {
        let (range, mean) = match value.split_once('~') {
            Some((range, mean)) => (range, Some(mean.parse::<f64>().ok()?)),
            None => (value, None),
        };
        let (min, max) = range.split_once("..")?;
        let (min_ms, max_ms): (u32, u32) = (min.parse().ok()?, max.parse().ok()?);
        let is_sound = min_ms <= max_ms && max_ms <= 60_000 && mean.is_none_or(|mean| mean > 0.0);
        is_sound.then_some(Delay {
            min_ms,
            max_ms,
            mean_ms: mean,
        })
    };
    let wanted = "a range in ms up to a minute, like 5..50 or 5..200~20,";
    parse().ok_or_else(|| wrong("delay", value, wanted))
}

fn outage(value: &str) -> Result<Outage, FaultsError> {
    let parse = || {
        let (from, until) = value.split_once("..")?;
        let (from_ms, until_ms) = (from.parse().ok()?, until.parse().ok()?);
        (from_ms < until_ms).then_some(Outage { from_ms, until_ms })
    };
    parse().ok_or_else(|| wrong("outage", value, "a time in ms, like 2000..5000,"))
}

impl fmt::Display for Faults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut parts = Vec::new();
        let chances = [
            ("loss", self.loss),
            ("duplication", self.duplication),
            ("reordering", self.reordering),
        ];
        let present = chances.iter().filter(|(_, p)| *p > 0.0);
        parts.extend(present.map(|(name, p)| format!("{name}={p}")));
        if let Some(Burst { loss, length }) = self.burst {
            parts.push(format!("burst={loss}x{length}"));
        }
        if self.delay != Delay::default() {
            let mean = self.delay.mean_ms.map(|mean| format!("~{mean}"));
            let (min, max) = (self.delay.min_ms, self.delay.max_ms);
            parts.push(format!("delay={min}..{max}{}", mean.unwrap_or_default()));
        }
        let outages = self.outages.iter();
        parts.extend(outages.map(|o| format!("outage={}..{}", o.from_ms, o.until_ms)));
        f.write_str(&parts.join(","))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fates(faults: &str, seed: u64) -> Vec<Fate> {
        let mut channel = Channel::new(faults.parse().unwrap(), seed);
        (0..10_000).map(|ms| channel.fate(ms * 1_000)).collect()
    }

    fn lost(fates: &[Fate]) -> usize {
        let is_lost = |fate: &&Fate| matches!(fate, Fate::Lost(_));
        fates.iter().filter(is_lost).count()
    }

    #[test]
    fn about_as_many_are_lost_as_should_be_and_the_same_ones_at_every_run() {
        assert_eq!(lost(&fates("", 1)), 0);
        assert_eq!(lost(&fates("loss=1", 1)), 10_000);
        let third = fates("loss=0.3", 1);
        assert!((2_800..3_200).contains(&lost(&third)), "{}", lost(&third));
        assert_eq!(third, fates("loss=0.3", 1));
        assert_ne!(third, fates("loss=0.3", 2));
    }

    #[test]
    fn bursts_lose_their_share_in_runs_of_their_length() {
        let fates = fates("burst=0.4x8", 3);
        let share = lost(&fates);
        assert!((3_500..4_500).contains(&share), "{share}");
        let is_lost = |fate: &Fate| *fate == Fate::Lost(Loss::Burst);
        let begins = |pair: &&[Fate]| !is_lost(&pair[0]) && is_lost(&pair[1]);
        let runs = fates.windows(2).filter(begins).count();
        let mean = share / runs;
        assert!((6..=10).contains(&mean), "{mean}");
    }

    #[test]
    fn delays_are_within_their_range_and_held_back_ones_are_overtaken() {
        let after = |fate: &Fate| match fate {
            Fate::Arrives { after_us, .. } => *after_us,
            Fate::Lost(_) => panic!("nothing is lost here"),
        };
        let uniform: Vec<_> = fates("delay=5..50", 1).iter().map(after).collect();
        assert!(uniform.iter().all(|us| (5_000..=50_000).contains(us)));
        let exponential: Vec<_> = fates("delay=5..200~20", 1).iter().map(after).collect();
        let mean = exponential.iter().sum::<u64>() / 10_000;
        assert!((24_000..26_000).contains(&mean), "{mean}");
        let held: Vec<_> = fates("reordering=0.1", 1).iter().map(after).collect();
        let overtaken = (0..9_999)
            .filter(|&i| held[i] > 1_000 + held[i + 1])
            .count();
        assert!((700..1_100).contains(&overtaken), "{overtaken}");
    }

    #[test]
    fn an_outage_lets_nothing_through_and_is_over_at_its_end() {
        let fates = fates("outage=100..200", 1);
        assert!(
            fates[100..200]
                .iter()
                .all(|f| *f == Fate::Lost(Loss::Outage))
        );
        assert_eq!(lost(&fates), 100);
    }

    #[test]
    fn about_as_many_arrive_twice_as_should() {
        let twice = |fate: &&Fate| {
            matches!(
                fate,
                Fate::Arrives {
                    again_after_us: Some(_),
                    ..
                }
            )
        };
        let twice = fates("duplication=0.2", 1).iter().filter(twice).count();
        assert!((1_850..2_150).contains(&twice), "{twice}");
    }

    #[test]
    fn what_is_written_is_read_again_and_mistakes_are_named() {
        let text =
            "loss=0.1,duplication=0.2,reordering=0.3,burst=0.4x8,delay=5..200~20,outage=1..9";
        let faults: Faults = text.parse().unwrap();
        assert_eq!(faults.to_string(), text);
        assert!("".parse::<Faults>().unwrap().is_none());
        for (text, cause) in [
            ("los=1", "no fault 'los'; there are loss=P"),
            ("loss=2", "'loss=2': a probability from 0 to 1 is wanted"),
            ("burst=1x8", "'burst=1x8': a share below 1"),
            ("delay=9..5", "'delay=9..5': a range in ms"),
            ("outage=5", "'outage=5': a time in ms"),
        ] {
            let error = text.parse::<Faults>().unwrap_err().to_string();
            assert!(error.starts_with(cause), "{error}");
        }
    }
}
