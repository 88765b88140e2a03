//! `crossguard check --replay`.

use std::path::Path;

use crossguard_model_check::check::names;
use crossguard_model_check::model::Model;
use crossguard_model_check::replay::{Followed, Replay};
use crossguard_model_check::scenario::Scenario;
use crossguard_model_check::subject::Subject;
use crossguard_robot::files;

use super::super::{Failure, print};
use super::untimed;

/// The longest run that is read, in octets.
const REPLAY_MAX: u64 = 1 << 26;

/// The run in `file`.
fn read(file: &Path) -> Result<Replay, Failure> {
    let text = files::text(file, REPLAY_MAX).map_err(Failure::at(file))?;
    serde_json::from_str(&text).map_err(Failure::at(file))
}

/// The run in `file`, with the text of its scenario where that is another file.
pub(in crate::cli) fn read_whole(file: &Path) -> Result<Replay, Failure> {
    let mut replay = read(file)?;
    if replay.text.is_none() && Scenario::load(&replay.scenario).is_err() {
        let text = files::text(Path::new(&replay.scenario), files::TEXT_MAX);
        let text = text.map_err(|cause| format!("its scenario: {}: {cause}", replay.scenario));
        replay.text = Some(text.map_err(Failure::at(file))?);
    }
    Ok(replay)
}

/// Follows the run in `file`.
pub(super) fn run(scenarios: &[String], file: &Path) -> Result<(), Failure> {
    let (name, replay, scenario) = match scenarios {
        [] => {
            let replay = read_whole(file)?;
            let scenario = replay.load_scenario().map_err(Failure::input)?;
            (replay.scenario.clone(), replay, scenario)
        }
        [name] => match super::subject(name)? {
            Subject::Scenario(scenario) => (name.clone(), read(file)?, *scenario),
            Subject::PaperLiteral | Subject::Street(_) => {
                let cause = format!("'{name}' is no scenario whose runs can be followed");
                return Err(Failure::Input(cause));
            }
        },
        _ => return Err(Failure::input("--replay wants one scenario")),
    };
    let model = Model::new(untimed(scenario)?);
    tell(&model, &name, &replay)
}

/// Whether the run still exists, and still breaks its property, or nothing in particular.
fn tell(model: &Model, name: &str, replay: &Replay) -> Result<(), Failure> {
    let property = &replay.property;
    let is_walk = property.is_empty();
    let gone = if is_walk {
        format!("The run does not exist in {name}")
    } else {
        format!("The run of {property} in {name} does not exist any more")
    };
    let now = if is_walk { "" } else { " now" };
    // A run that was to break nothing in particular has to be there.
    let mut is_wrong = is_walk;
    let followed = replay.follow(model);
    let told = match &followed {
        Followed::StoppedAt(step) => {
            let line = line(model, replay, *step);
            format!("{gone}: this cannot happen{now}:\n  {line}")
        }
        Followed::OtherwiseAt(step, outputs) => {
            let (line, outputs) = (line(model, replay, *step), outputs.join(", "));
            format!("{gone}: after\n  {line}\nthe robot{now} puts out: {outputs}")
        }
        Followed::ToTheEnd(broken) if is_walk => {
            is_wrong = !broken.is_empty();
            let broken: Vec<_> = broken.iter().map(ToString::to_string).collect();
            let broken = match &broken[..] {
                [] => "nothing".to_owned(),
                broken => broken.join(", "),
            };
            let steps = replay.steps.len();
            format!("The run exists in {name}, all {steps} steps of it; its end breaks {broken}.")
        }
        Followed::ToTheEnd(_) => {
            is_wrong = replay.is_broken(&followed);
            if is_wrong {
                format!("The run of {property} in {name} still exists as it was.")
            } else {
                format!("The run of {property} in {name} exists, and does not break it any more.")
            }
        }
    };
    print(told)?;
    if is_wrong {
        Err(Failure::Wrong)
    } else {
        Ok(())
    }
}

fn line(model: &Model, replay: &Replay, step: usize) -> String {
    let robots = names(model.scenario());
    format!("{}. {}", step + 1, replay.steps[step].line(&robots))
}
