//! Settings that are varied, one by one or all together.

use std::str::FromStr;

use crossguard_protocol::{BrokenInequality, Config, Inequality, Millis, Settings};

/// A setting that can be varied.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Knob {
    RamPeriod,
    AckTimeout,
    AckRepeats,
    Safety,
}

impl Knob {
    pub(super) const ALL: [Self; 4] = [
        Self::RamPeriod,
        Self::AckTimeout,
        Self::AckRepeats,
        Self::Safety,
    ];

    /// The name of the setting.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::RamPeriod => "ram_period",
            Self::AckTimeout => "t_ack",
            Self::AckRepeats => "n_ack",
            Self::Safety => "t_safety",
        }
    }

    /// Sets it. The lease becomes the longest, to 50 ms, that a new `t_safety` allows.
    pub(super) fn set(self, settings: &mut Settings, value: u32) {
        match self {
            Self::RamPeriod => settings.ram_period = Millis(value),
            Self::AckTimeout => settings.t_ack = Millis(value),
            // What does not fit is as far out of range as this.
            Self::AckRepeats => settings.n_ack = u8::try_from(value).unwrap_or(u8::MAX),
            Self::Safety if settings.t_safety.0 == value => {}
            Self::Safety => {
                settings.t_safety = Millis(value);
                settings.t_lease = longest_lease(settings);
            }
        }
    }
}

/// The longest lease, to 50 ms, that `t_safety` allows.
fn longest_lease(settings: &Settings) -> Millis {
    let mut leases = (1..=settings.t_safety.0 / 50).rev().map(|n| Millis(n * 50));
    let fits = |lease: &Millis| {
        let with = Settings {
            t_lease: *lease,
            ..settings.clone()
        };
        !matches!(
            Config::new(with),
            Err(BrokenInequality(Inequality::LeaseWithinSafety))
        )
    };
    leases.find(fits).unwrap_or(Millis(1))
}

/// One setting and the values that it is to have.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Varied {
    knob: Knob,
    values: Vec<u32>,
}

impl Varied {
    /// The settings with each of the values; or what is wrong with one that the other settings do not allow.
    pub(super) fn configs(&self, config: &Config) -> Result<Vec<Config>, String> {
        let with = |&value: &u32| {
            let mut settings = config.settings().clone();
            self.knob.set(&mut settings, value);
            let name = self.knob.name();
            Config::new(settings).map_err(|broken| format!("{name}={value}: {broken}"))
        };
        self.values.iter().map(with).collect()
    }
}

impl FromStr for Varied {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wanted = || {
            let names = Knob::ALL.map(Knob::name).join(", ");
            format!("one of {names} with whole numbers is wanted, like ram_period=50,100,200")
        };
        let (name, values) = text.split_once('=').ok_or_else(wanted)?;
        let knob = Knob::ALL
            .into_iter()
            .find(|knob| knob.name() == name.trim());
        let values: Result<Vec<u32>, _> = values
            .split(',')
            .map(|value| value.trim().parse())
            .collect();
        match (knob, values) {
            (Some(knob), Ok(values)) if values.len() <= 50 => Ok(Self { knob, values }),
            _ => Err(wanted()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lease_goes_with_t_safety() {
        let mut settings = Settings::default();
        Knob::Safety.set(&mut settings, 3_000);
        assert_eq!(settings.t_lease, Millis(2_900));
        let varied: Varied = "t_safety=1000,2000".parse().unwrap();
        let configs = varied.configs(&Config::default()).unwrap();
        let leases = configs.iter().map(|it| it.settings().t_lease.0);
        assert!(leases.eq([900, 1_900]));
    }

    #[test]
    fn a_value_that_breaks_an_inequality_is_refused_by_its_name() {
        let varied: Varied = "ram_period=700".parse().unwrap();
        let error = varied.configs(&Config::default()).unwrap_err();
        assert!(
            error.starts_with("ram_period=700: ") && error.contains("heartbeats-within-lease"),
            "{error}"
        );
        for bad in ";ram_period;ram_period=;t_help=1;n_ack=1.5;n_ack=1,".split(';') {
            assert!(bad.parse::<Varied>().is_err(), "{bad}");
        }
    }
}
