//! `crossguard validate`.

use std::path::PathBuf;

use crossguard_judge::timing::{Times, Timing};
use crossguard_judge::validate::{self, Fault, Invalid, Validated};
use crossguard_judge::verdict::sentences;
use crossguard_robot::trace::{Merged, Timed};
use serde::Serialize;

use super::{Failure, open_logs, print, print_json};

#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub(super) struct Arguments {
    /// The logs: of one robot or of several, from one machine or from several.
    #[arg(required = true, value_name = "LOG")]
    logs: Vec<PathBuf>,
    /// Print the results as JSON, and nothing else.
    #[arg(long)]
    json: bool,
}

const AFTER_HELP: &str = "\
Replays every step through the transition function, matches every reception with its transmission, \
judges every step by the properties that the model checker verifies, and holds the time that each \
robot was told against the clock of its log. The first record that does \
not fit is named with its line and the reason. Of a station whose log is not among those given, \
nothing is known; what was heard from it is counted. I10 is judged among robots that share a log, and so a \
clock. P1 (nobody on the road when a guard leaves by an application's word), P2 (guards at their places under go) and P4 \
(escorts beside their people) are judged where the logs have people, the outline of a road and positions. How long messages \
were under way is in no log. \
With --json it has the paper's times as well: negotiation one way (T_neg), execution (T_exec), both together (T_TMCT), \
and the round trip from command to acknowledgement. Clocks of logs may be apart: the difference is estimated from the \
messages that went both ways, taken off T_neg, and given with what it can be wrong by.";

/// The results as JSON.
#[derive(Serialize)]
struct ValidateReport {
    valid: bool,
    #[serde(flatten)]
    validated: Option<Validated>,
    /// The paper's times.
    #[serde(skip_serializing_if = "Option::is_none")]
    times: Option<Times>,
    #[serde(skip_serializing_if = "Option::is_none")]
    log: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    line: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<String>,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let result = validate::all(open_logs(&arguments.logs)?);
    if let Err(invalid) = &result
        && matches!(*invalid.fault, Fault::Unreadable(_))
    {
        // A log that cannot be read at all is bad input, and not a robot that went wrong.
        return result.map(|_| ()).map_err(Failure::input);
    }
    if arguments.json {
        let times = result.is_ok().then(|| times(&arguments.logs));
        print_json(&report(&result, times.transpose()?))?;
    } else {
        tell(&result)?;
    }
    verdict(&result)
}

/// How a command ends that has validated logs.
pub(super) fn verdict(result: &Result<Validated, Invalid>) -> Result<(), Failure> {
    match result {
        Err(_) => Err(Failure::Wrong),
        Ok(validated) if validated.missing > 0 => Err(Failure::Incomplete),
        Ok(_) => Ok(()),
    }
}

fn report(result: &Result<Validated, Invalid>, times: Option<Times>) -> ValidateReport {
    let invalid = result.as_ref().err();
    ValidateReport {
        valid: result.is_ok(),
        validated: result.as_ref().ok().cloned(),
        times,
        log: invalid.map(|invalid| invalid.log.clone()),
        line: invalid.map(|invalid| invalid.line),
        error: invalid.map(ToString::to_string),
    }
}

/// The paper's times, from logs that have been validated.
fn times(paths: &[PathBuf]) -> Result<Times, Failure> {
    let mut logs = Merged::new(open_logs(paths)?).map_err(Failure::input)?;
    let mut timing = Timing::default();
    while let Some(Timed { log, at_us, record }) = logs.take().map_err(Failure::input)? {
        timing.record(log, at_us, &record);
    }
    Ok(Times::of(&timing, &super::report::names(paths)))
}

fn tell(result: &Result<Validated, Invalid>) -> Result<(), Failure> {
    let validated = match result {
        Ok(validated) => validated,
        Err(invalid) => return print(format_args!("Not valid. {invalid}.")),
    };
    print(format_args!(
        "Valid: {} records of {} robots. Properties put to the test and kept: {}.",
        validated.records,
        validated.robots,
        validated.properties.join(", ")
    ))?;
    sentences(validated).iter().try_for_each(print)
}
