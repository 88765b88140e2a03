//! `crossguard check --replay`.

use std::path::Path;

use crossguard_judge::drive::{Driven, drive};
use crossguard_model_check::check::names;
use crossguard_model_check::model::Model;
use crossguard_model_check::replay::{Followed, Replay};
use crossguard_model_check::scenario::Scenario;

use super::super::{Failure, print};
use super::untimed;

/// Follows the run in `file`; through real endpoints too, where they are asked for.
pub(super) fn run(scenarios: &[String], file: &Path, endpoints: bool) -> Result<(), Failure> {
    let cannot =
        |cause: &dyn std::fmt::Display| Failure::input(format!("{}: {cause}", file.display()));
    let text = std::fs::read_to_string(file).map_err(|cause| cannot(&cause))?;
    let replay: Replay = serde_json::from_str(&text).map_err(|cause| cannot(&cause))?;
    let name = match scenarios {
        [] => &replay.scenario,
        [name] => name,
        _ => return Err(Failure::input("--replay wants one scenario")),
    };
    let scenario = Scenario::load(name).map_err(Failure::input)?;
    let model = Model::new(untimed(scenario)?);
    if endpoints {
        through_endpoints(&model, &replay)?;
    }
    tell(&model, name, &replay)
}

/// Whether the run still exists, and still breaks its property.
fn tell(model: &Model, name: &str, replay: &Replay) -> Result<(), Failure> {
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

fn line(model: &Model, replay: &Replay, step: usize) -> String {
    let robots = names(model.scenario());
    format!("{}. {}", step + 1, replay.steps[step].line(&robots))
}

fn through_endpoints(model: &Model, replay: &Replay) -> Result<(), Failure> {
    let Driven {
        steps,
        datagrams,
        disagreement,
        ..
    } = drive(model, replay);
    print(format_args!(
        "Endpoints took {steps} of its {} steps and sent {datagrams} datagrams; after each step their \
         robots were as in the model.",
        replay.steps.len()
    ))?;
    let Some(disagreement) = disagreement else {
        return Ok(());
    };
    print(format_args!(
        "But after\n  {}\n{disagreement}",
        line(model, replay, steps)
    ))?;
    Err(Failure::Wrong)
}
