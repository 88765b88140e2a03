//! `crossguard fsm`.

use crossguard_model_check::transitions::mode_name;
use crossguard_model_check::{fsm, universe};

use super::{Failure, print, print_json};

#[derive(clap::Args)]
pub(super) struct Arguments {
    /// The form of the diagram.
    #[arg(long, value_enum, default_value_t = DiagramFormat::Mermaid)]
    format: DiagramFormat,
}

#[derive(Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum DiagramFormat {
    /// A stateDiagram-v2 of Mermaid.
    Mermaid,
    /// A digraph of Graphviz.
    Dot,
    /// The transitions as JSON.
    Json,
}

#[derive(serde::Serialize)]
struct Transition {
    from: String,
    to: String,
    on: Vec<String>,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let transitions = universe::explore(&universe::config()).transitions;
    match arguments.format {
        DiagramFormat::Mermaid => {
            print(fsm::diagram(&transitions, fsm::DiagramFormat::Mermaid).trim_end())
        }
        DiagramFormat::Dot => print(fsm::diagram(&transitions, fsm::DiagramFormat::Dot).trim_end()),
        DiagramFormat::Json => {
            let transitions = transitions.0.iter().map(|((from, to), labels)| Transition {
                from: mode_name(*from),
                to: mode_name(*to),
                on: labels.iter().cloned().collect(),
            });
            print_json(&transitions.collect::<Vec<_>>())
        }
    }
}
