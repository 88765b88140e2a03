//! Settings that reach a target, and what stands in the way of others.

use std::cmp::Ordering;
use std::fmt;
use std::str::FromStr;
use std::time::Duration;

use crossguard_model_check::check::Stop;
use crossguard_model_check::odds::{
    ChainError, Enclosure, FlowCut, LossOdds, Milestone, OddsModel, Stage,
};
use crossguard_protocol::{BrokenInequality, Config, Inequality, Settings};
use serde::Serialize;

use super::output::shown;
use super::settings::Knob;
use super::{Arguments, Failure, print, print_json, progress};

/// What is to be reached.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Target {
    /// What is asked about; `None` for the crossing as a whole.
    milestone: Option<Milestone>,
    is_at_least: bool,
    probability: f64,
    within: Option<Duration>,
}

const WANTED: &str = "a target like 'complete>=0.999 within 2s' or 'interrupted<=0.001' is wanted, of complete, received, \
    acknowledged, open, interrupted, fell-back or crossing";

impl FromStr for Target {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wanted = || WANTED.to_owned();
        let (is_at_least, (name, rest)) = match (text.split_once(">="), text.split_once("<=")) {
            (Some(parts), None) => (true, parts),
            (None, Some(parts)) => (false, parts),
            _ => return Err(wanted()),
        };
        let (probability, within) = match rest.split_once("within") {
            Some((probability, time)) => {
                let time = humantime::parse_duration(time.trim()).map_err(|_| wanted())?;
                (probability, Some(time))
            }
            None => (rest, None),
        };
        let probability = probability.trim().parse().map_err(|_| wanted())?;
        if !(0.0..=1.0).contains(&probability) {
            return Err("the probability of a target is from 0 to 1".to_owned());
        }
        let milestone = match name.trim() {
            "crossing" if within.is_some() => {
                return Err("a crossing as a whole has no 'within'".to_owned());
            }
            "crossing" => None,
            "complete" => Some(Milestone::Team),
            name => Some(
                Milestone::ALL
                    .into_iter()
                    .find(|it| it.name() == name)
                    .ok_or_else(wanted)?,
            ),
        };
        Ok(Self {
            milestone,
            is_at_least,
            probability,
            within,
        })
    }
}

impl fmt::Display for Target {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = self.milestone.map_or("crossing", Milestone::name);
        let sign = if self.is_at_least { ">=" } else { "<=" };
        write!(f, "{name}{sign}{}", self.probability)?;
        match self.within {
            Some(time) => write!(f, " within {}", humantime::format_duration(time)),
            None => Ok(()),
        }
    }
}

impl Target {
    /// The stage up to which has to be worked out.
    fn stage(&self) -> Stage {
        self.milestone.map_or(Stage::Holding, Milestone::stage)
    }

    fn value(&self, odds: &LossOdds) -> Enclosure {
        let Some(milestone) = self.milestone else {
            return odds.crossing;
        };
        match (odds.milestone(milestone), self.within) {
            (Some(it), Some(time)) => {
                it.within(u64::try_from(time.as_millis()).unwrap_or(u64::MAX))
            }
            (Some(it), None) => it.probability,
            // The stage never begins.
            (None, _) => Enclosure {
                lower: 0.0,
                upper: 1.0,
            },
        }
    }

    /// Whether it is reached for certain: by the bound that is worse.
    fn is_reached(&self, value: Enclosure) -> bool {
        if self.is_at_least {
            value.lower >= self.probability
        } else {
            value.upper <= self.probability
        }
    }

    /// Which of two values is closer to what is wanted.
    fn better(&self, a: Enclosure, b: Enclosure) -> Ordering {
        let order = a.middle().total_cmp(&b.middle());
        if self.is_at_least {
            order
        } else {
            order.reverse()
        }
    }

    /// The values that are tried, the most frugal ones first: few messages, a follower that stops soon, few and rare
    /// repetitions.
    fn tried(&self) -> [&'static [u32]; 4] {
        const AS_SET: &[u32] = &[];
        match self.milestone.map(Milestone::stage) {
            Some(Stage::Gathering) => [&[500, 300, 200, 150, 100, 50], AS_SET, AS_SET, AS_SET],
            Some(Stage::Commanding) => [
                &[200, 100],
                &[1_000, 600, 400, 300, 200],
                &[1, 2, 3, 5, 8, 15],
                AS_SET,
            ],
            Some(Stage::Holding) => [
                &[500, 300, 200, 100, 50],
                AS_SET,
                AS_SET,
                &[1_000, 1_500, 2_000, 2_500, 3_000, 4_000],
            ],
            None => [&[200, 100], &[600, 300], &[3, 5, 8], &[2_000, 3_000]],
        }
    }
}

/// A choice of settings, by the value of each knob, and what came of it.
#[derive(Clone, Debug, Serialize)]
struct Candidate {
    ram_period_ms: u32,
    t_ack_ms: u32,
    n_ack: u32,
    t_safety_ms: u32,
    t_lease_ms: u32,
    /// The probability; `None` where an inequality refuses the settings.
    probability: Option<Enclosure>,
    reaches: bool,
    /// The inequality that refuses the settings.
    refused_by: Option<Inequality>,
}

impl Candidate {
    fn new(settings: &Settings) -> Self {
        let of = |knob: Knob| knob.value(settings);
        Self {
            ram_period_ms: of(Knob::RamPeriod),
            t_ack_ms: of(Knob::AckTimeout),
            n_ack: of(Knob::AckRepeats),
            t_safety_ms: of(Knob::Safety),
            t_lease_ms: settings.t_lease.0,
            probability: None,
            reaches: false,
            refused_by: None,
        }
    }

    const fn values(&self) -> [u32; 4] {
        [
            self.ram_period_ms,
            self.t_ack_ms,
            self.n_ack,
            self.t_safety_ms,
        ]
    }

    /// The one knob at which another choice has another value.
    fn differs_in(&self, other: &Self) -> Option<(Knob, u32)> {
        let pairs = Knob::ALL
            .into_iter()
            .zip(self.values().into_iter().zip(other.values()));
        let mut different = pairs.filter(|(_, (a, b))| a != b);
        let (knob, (_, value)) = different.next()?;
        different.next().is_none().then_some((knob, value))
    }

    fn words(&self) -> String {
        let words = Knob::ALL.into_iter().zip(self.values());
        let words: Vec<_> = words
            .map(|(knob, value)| format!("{}={value}", knob.name()))
            .collect();
        format!("{} t_lease={}", words.join(" "), self.t_lease_ms)
    }

    fn outcome(&self) -> String {
        match (self.refused_by, self.probability) {
            (Some(inequality), _) => format!("'{}' refuses it: {inequality}", inequality.name()),
            (None, Some(value)) => {
                let verdict = if self.reaches {
                    "reaches it"
                } else {
                    "does not reach it"
                };
                format!("{verdict}: {}", shown(value))
            }
            (None, None) => "was not worked out".to_owned(),
        }
    }
}

#[derive(Serialize)]
struct TargetReport<'a> {
    target: String,
    loss: f64,
    followers: u8,
    /// The first of the settings, in the order from frugal ones on, that reach the target.
    found: Option<&'a Candidate>,
    /// The settings that come closest to the target.
    closest: Option<&'a Candidate>,
    /// What comes of settings that differ from these in one value: what limits them.
    neighbours: Vec<&'a Candidate>,
    candidates: &'a [Candidate],
    complete: bool,
}

pub(super) fn search(
    arguments: &Arguments,
    target: &Target,
    config: &Config,
    stop: &Stop,
) -> Result<(), Failure> {
    let loss = arguments.loss.largest();
    let mut candidates = Vec::new();
    let all = choices(target, config.settings());
    let bar = progress(arguments.json);
    bar.set_length(all.len() as u64);
    for settings in &all {
        bar.set_message(format!(
            "{} at a loss of {loss}",
            Candidate::new(settings).words()
        ));
        match weigh(arguments, target, settings, loss, stop) {
            Ok(candidate) => candidates.push(candidate),
            Err(Weighing::Stopped) => break,
            Err(Weighing::Failed(failure)) => return Err(failure),
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    let complete = candidates.len() == all.len();
    let found = candidates.iter().find(|it| it.reaches);
    let closest = candidates
        .iter()
        .filter_map(|it| Some((it, it.probability?)))
        // Of equally good ones the first, which is the most frugal one.
        .rev()
        .max_by(|(_, a), (_, b)| target.better(*a, *b))
        .map(|(it, _)| it);
    let chosen = found.or(closest);
    let neighbours = chosen.map_or(Vec::new(), |chosen| {
        candidates
            .iter()
            .filter(|it| chosen.differs_in(it).is_some())
            .collect()
    });
    let report = TargetReport {
        target: target.to_string(),
        loss,
        followers: arguments.followers,
        found,
        closest,
        neighbours,
        candidates: &candidates,
        complete,
    };
    if arguments.json {
        print_json(&report)?;
    } else {
        tell(&report)?;
    }
    match (found, complete) {
        (Some(_), _) => Ok(()),
        (None, true) => Err(Failure::Wrong),
        (None, false) => Err(Failure::Incomplete),
    }
}

fn tell(report: &TargetReport<'_>) -> Result<(), Failure> {
    let tried = report.candidates.len();
    let (target, loss) = (&report.target, report.loss);
    let chosen = match (report.found, report.closest) {
        (Some(found), _) => {
            print(format_args!(
                "{target} at a loss of {loss} is reached with {}",
                found.words()
            ))?;
            print(format_args!("  {}", found.outcome()))?;
            found
        }
        (None, Some(closest)) => {
            print(format_args!(
                "{target} at a loss of {loss} is reached with none of {tried} settings."
            ))?;
            print(format_args!("Closest is {}", closest.words()))?;
            print(format_args!("  {}", closest.outcome()))?;
            closest
        }
        (None, None) => {
            print(format_args!("None of {tried} settings was worked out."))?;
            return refusals(report);
        }
    };
    print("With one other value:")?;
    for neighbour in &report.neighbours {
        if let Some((knob, value)) = chosen.differs_in(neighbour) {
            print(format_args!(
                "  {}={value} {}",
                knob.name(),
                neighbour.outcome()
            ))?;
        }
    }
    refusals(report)
}

/// The inequalities that refused settings.
fn refusals(report: &TargetReport<'_>) -> Result<(), Failure> {
    let tried = report.candidates.len();
    for inequality in Inequality::ALL {
        let mut refused = report
            .candidates
            .iter()
            .filter(|it| it.refused_by == Some(inequality));
        let count = refused.clone().count();
        if let Some(first) = refused.next() {
            let (name, words) = (inequality.name(), first.words());
            print(format_args!(
                "'{name}' refuses {count} of {tried} settings, like {words}"
            ))?;
        }
    }
    if !report.complete {
        print("Stopped before all settings were tried.")?;
    }
    Ok(())
}

/// The settings that are tried: the values of the target, and the ones that are set.
fn choices(target: &Target, settings: &Settings) -> Vec<Settings> {
    let mut choices = vec![settings.clone()];
    for (knob, values) in Knob::ALL.into_iter().zip(target.tried()) {
        let own = knob.value(settings);
        let mut values = values.to_vec();
        if !values.contains(&own) {
            values.push(own);
        }
        let with = |choice: &Settings, value: u32| {
            let mut choice = choice.clone();
            knob.set(&mut choice, value);
            choice
        };
        choices = (values.iter())
            .flat_map(|&value| {
                choices
                    .iter()
                    .map(move |choice| with(choice, value))
                    .collect::<Vec<_>>()
            })
            .collect();
    }
    choices
}

/// Why settings were not weighed.
enum Weighing {
    Stopped,
    Failed(Failure),
}

fn weigh(
    arguments: &Arguments,
    target: &Target,
    settings: &Settings,
    loss: f64,
    stop: &Stop,
) -> Result<Candidate, Weighing> {
    let mut candidate = Candidate::new(settings);
    let config = match Config::new(settings.clone()) {
        Ok(config) => config,
        Err(BrokenInequality(inequality)) => {
            candidate.refused_by = Some(inequality);
            return Ok(candidate);
        }
    };
    let setup = arguments.setup(&config).map_err(Weighing::Failed)?;
    let solved = OddsModel::new(setup).odds(&[loss], target.stage(), stop, &mut |_| ());
    let team = solved.map_err(|error| match error {
        ChainError::Cut(FlowCut::Stopped) => Weighing::Stopped,
        error => Weighing::Failed(Failure::input(error)),
    })?;
    if let [odds] = &team.losses[..] {
        let value = target.value(odds);
        candidate.probability = Some(value);
        candidate.reaches = target.is_reached(value);
    }
    Ok(candidate)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn targets_are_read_and_say_what_they_are() {
        let read = |text: &str| text.parse::<Target>().map(|it| it.to_string());
        assert_eq!(
            read("complete>=0.999 within 2s"),
            Ok("team>=0.999 within 2s".to_owned())
        );
        assert_eq!(read("fell-back <= 0.1"), Ok("fell-back<=0.1".to_owned()));
        assert_eq!(read("crossing>=0.9"), Ok("crossing>=0.9".to_owned()));
        for bad in [
            "",
            "complete",
            "complete>0.9",
            "complete>=1.5",
            "complete>=x",
            "complete>=0.9 within soon",
            "nothing>=0.9",
            "crossing>=0.9 within 2s",
        ] {
            assert!(read(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn choices_have_each_value_with_each_other_one() {
        let target: Target = "interrupted<=0.1".parse().unwrap();
        let choices = choices(&target, &Settings::default());
        assert_eq!(choices.len(), 5 * 6);
        assert!(choices.contains(&Settings::default()));
    }
}
