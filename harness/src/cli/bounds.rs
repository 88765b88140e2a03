//! `crossguard bounds`.

use std::path::PathBuf;

use comfy_table::presets::NOTHING;
use comfy_table::{CellAlignment, ContentArrangement, Table};
use crossguard_model_check::timed::{Bound, USUAL_DELAY, bounds};
use crossguard_protocol::Millis;
use serde::Serialize;

use super::ranges::whole;
use super::{Failure, print, print_json};

#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub(super) struct Arguments {
    /// A robot's configuration, as for 'crossguard run'; without it, the default settings.
    #[arg(long, value_name = "FILE")]
    config: Option<PathBuf>,
    /// The longest time that a message takes, in milliseconds.
    #[arg(long, value_name = "MS", default_value_t = USUAL_DELAY.0, value_parser = whole::<u32>(0..=60_000))]
    delay: u32,
    /// Print the bounds as JSON, and nothing else.
    #[arg(long)]
    json: bool,
}

const AFTER_HELP: &str = "\
Prints the longest time of each response: from a guard that fails to the sign at stop, from a leader that is silent to \
its follower stopped, and so on; of which property it is the bound, and how it follows from the settings. A body takes \
its own time to stop: add what you state for your robot. 'crossguard check' finds no longer time in any run of its \
timed scenarios, 'crossguard fuzz' in none of its streets.";

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Report {
    delay_ms: u32,
    bounds: Vec<Bound>,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let config = super::config_or_default(arguments.config.as_deref())?;
    let bounds = bounds(&config, Millis(arguments.delay));
    if arguments.json {
        return print_json(&Report {
            delay_ms: arguments.delay,
            bounds,
        });
    }
    print(table(&bounds))?;
    print(format_args!(
        "longest(t) = (t + delay_max) / (1 - drift), with delay_max = {} ms and drift = {} ppm; delay = {} ms.",
        config.settings().delay_max.0,
        config.settings().drift_ppm,
        arguments.delay,
    ))?;
    print("Where a body has to get to its place first, W8 takes that long besides.")
}

fn table(bounds: &[Bound]) -> Table {
    let mut table = Table::new();
    table
        .load_style(NOTHING)
        .set_content_arrangement(ContentArrangement::Dynamic)
        .set_header(["property", "longest time", "ms", "how it follows"]);
    for bound in bounds {
        table.add_row([
            bound.properties.clone(),
            bound.name.to_owned(),
            bound.ms.to_string(),
            bound.derivation.to_owned(),
        ]);
    }
    if let Some(column) = table.column_mut(2) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}
