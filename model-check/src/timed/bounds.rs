//! The response times of a robot with its own settings, as a table for people: what ends within which time,
//! which property says so, and how the time follows from the timers.
//!
//! The times are those of [`Limits`]: the timed model holds its figures against them.

use crossguard_protocol::{Config, Millis};
use serde::Serialize;

use super::limits::Limits;
use super::measure::{MEASURES, MeasureClaim};
use crate::properties::PropertyId;

/// The longest time that a message is taken to need where nothing else is said.
pub const USUAL_DELAY: Millis = Millis(50);

/// The longest time that something takes.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Bound {
    /// The properties that it is the bound of.
    pub properties: String,
    /// From what to what.
    pub name: &'static str,
    /// In milliseconds of true time.
    pub ms: u32,
    /// How it follows from the settings, where `longest(t) = (t + delay_max) / (1 - drift)` and `delay` is the
    /// longest time that a message takes.
    pub derivation: &'static str,
}

/// The bounds of robots with these settings, where a message takes at most `delay`.
#[must_use]
pub fn bounds(config: &Config, delay: Millis) -> Vec<Bound> {
    let limits = Limits::new(config, delay);
    let commands = Bound {
        properties: PropertyId::L2.to_string(),
        name: "from a command to its acknowledgement or to the follower given up",
        ms: limits.commands.0,
        derivation: "(n_ack + 1) * longest(t_ack)",
    };
    let bound = |claim: &MeasureClaim| Bound {
        properties: claim.ids(),
        name: claim.name,
        ms: (claim.bound)(&limits).0,
        derivation: claim.derivation,
    };
    let mut bounds: Vec<_> = MEASURES.iter().map(bound).collect();
    bounds.insert(1, commands);
    bounds
}

#[cfg(test)]
mod tests {
    use super::*;
    use crossguard_protocol::Settings;
    use std::collections::BTreeMap;

    /// Reads `a * b + c(d)` over the names of settings: an oracle that knows the derivations' words only.
    fn evaluate(derivation: &str, settings: &Settings, t_lost: u32, delay: u32) -> u32 {
        let names = BTreeMap::from([
            ("t_help", settings.t_help.0),
            ("t_safety", settings.t_safety.0),
            ("t_leave", settings.t_leave.0),
            ("t_lease", settings.t_lease.0),
            ("t_ack", settings.t_ack.0),
            ("t_lost", t_lost),
            ("2 * ram_period", 2 * settings.ram_period.0),
        ]);
        let derivation = derivation.split(':').next().unwrap();
        derivation
            .split(" + ")
            .collect::<Vec<_>>()
            .join("+")
            // The only sum inside of a product.
            .replace("(n_ack+1) * ", "repeated ")
            .split('+')
            .map(|term| {
                let (times, term) = term
                    .strip_prefix("repeated ")
                    .map_or((1, term), |term| (u32::from(settings.n_ack) + 1, term));
                let inner = term
                    .strip_prefix("longest(")
                    .and_then(|t| t.strip_suffix(')'));
                let value = match (inner, term) {
                    (Some(name), _) => {
                        let shown = f64::from(names[name] + settings.delay_max.0);
                        let slow = 1.0 - f64::from(settings.drift_ppm) / 1e6;
                        (shown / slow).ceil()
                    }
                    (None, "delay") => f64::from(delay),
                    (None, "0") => 0.0,
                    (None, other) => panic!("{other} is in no derivation"),
                };
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "times in whole milliseconds"
                )]
                let value = value as u32;
                times * value
            })
            .sum()
    }

    #[test]
    fn each_derivation_gives_its_bound() {
        let slow = Settings {
            ram_period: Millis(150),
            t_ack: Millis(333),
            n_ack: 5,
            t_safety: Millis(4_321),
            t_lease: Millis(3_210),
            t_help: Millis(12_345),
            t_leave: Millis(6_789),
            drift_ppm: 2_500,
            delay_max: Millis(73),
            ..Settings::default()
        };
        for settings in [Settings::default(), slow] {
            let config = Config::new(settings).unwrap();
            let t_lost = config.t_lost().0;
            let bounds = bounds(&config, Millis(41));
            assert_eq!(bounds.len(), MEASURES.len() + 1);
            for bound in bounds {
                let by_words = evaluate(bound.derivation, config.settings(), t_lost, 41);
                assert_eq!(bound.ms, by_words, "{}", bound.name);
            }
        }
    }
}
