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

/// Whether the run still exists, and still breaks its property.
fn tell(model: &Model, name: &str, replay: &Replay) -> Result<(), Failure> {
    if replay.property.is_empty() {
        return tell_of_walk(model, name, replay);
    }
    match replay.follow(model) {
        Followed::StoppedAt(step) => print(format_args!(
            "The run of {} in {name} does not exist any more: this cannot happen now:\n  {}",
            replay.property,
            line(model, replay, step)
        )),
        Followed::OtherwiseAt(step, outputs) => print(format_args!(
            "The run of {} in {name} does not exist any more: after\n  {}\nthe robot now puts out: {}",
            replay.property,
            line(model, replay, step),
            outputs.join(", ")
        )),
        followed @ Followed::ToTheEnd(_) if replay.is_broken(&followed) => {
            print(format_args!(
                "The run of {} in {name} still exists as it was.",
                replay.property
            ))?;
            Err(Failure::Wrong)
        }
        Followed::ToTheEnd(_) => print(format_args!(
            "The run of {} in {name} exists, and does not break it any more.",
            replay.property
        )),
    }
}

/// The same for a run that was to break nothing in particular.
fn tell_of_walk(model: &Model, name: &str, replay: &Replay) -> Result<(), Failure> {
    match replay.follow(model) {
        Followed::StoppedAt(step) => {
            print(format_args!(
                "The run does not exist in {name}: this cannot happen:\n  {}",
                line(model, replay, step)
            ))?;
            Err(Failure::Wrong)
        }
        Followed::OtherwiseAt(step, outputs) => {
            print(format_args!(
                "The run does not exist in {name}: after\n  {}\nthe robot puts out: {}",
                line(model, replay, step),
                outputs.join(", ")
            ))?;
            Err(Failure::Wrong)
        }
        Followed::ToTheEnd(broken) if broken.is_empty() => print(format_args!(
            "The run exists in {name}, all {} steps of it; its end breaks nothing.",
            replay.steps.len()
        )),
        Followed::ToTheEnd(broken) => {
            let broken: Vec<_> = broken.iter().map(ToString::to_string).collect();
            print(format_args!(
                "The run exists in {name}, all {} steps of it; its end breaks {}.",
                replay.steps.len(),
                broken.join(", ")
            ))?;
            Err(Failure::Wrong)
        }
    }
}

fn line(model: &Model, replay: &Replay, step: usize) -> String {
    let robots = names(model.scenario());
    format!("{}. {}", step + 1, replay.steps[step].line(&robots))
}
