//! `crossguard fsm`.

use crossguard_model_check::transitions::mode_name;
use crossguard_model_check::{fsm, universe};

use super::{Failure, print, print_json};

#[derive(clap::Args)]
pub(super) struct Arguments {
    /// Print the transitions as JSON, and no diagram.
    #[arg(long)]
    json: bool,
}

#[derive(serde::Serialize)]
struct Transition {
    from: String,
    to: String,
    on: Vec<String>,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let transitions = universe::explore(&universe::config()).transitions;
    if !arguments.json {
        return print(fsm::diagram(&transitions).trim_end());
    }
    let transitions = transitions.0.iter().map(|((from, to), labels)| Transition {
        from: mode_name(*from),
        to: mode_name(*to),
        on: labels.iter().cloned().collect(),
    });
    print_json(&transitions.collect::<Vec<_>>())
}
