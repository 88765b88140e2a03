//! `crossguard check --confinement`.

use comfy_table::Table;
use comfy_table::presets::NOTHING;
use crossguard_model_check::confinement::{Confinement, table};
use crossguard_model_check::properties::PropertyId;
use crossguard_protocol::Config;
use serde::Serialize;

use crate::cli::{Failure, print, print_json};

#[derive(Serialize)]
struct Told {
    lies: Vec<Confinement>,
    properties: Vec<Assumed>,
}

/// What a property assumes of senders.
#[derive(Serialize)]
struct Assumed {
    id: &'static str,
    authentication: String,
}

/// Prints the table of confinement, and who can break which property.
pub(super) fn tell(is_json: bool) -> Result<(), Failure> {
    let lies = table(&Config::default());
    let properties = PropertyId::ALL.into_iter().map(|id| Assumed {
        id: id.name(),
        authentication: id.authentication().to_string(),
    });
    if is_json {
        return print_json(&Told {
            lies: lies.to_vec(),
            properties: properties.collect(),
        });
    }
    let mut rows = Table::new();
    rows.load_style(NOTHING);
    for lie in lies {
        let at_most = lie
            .at_most
            .map(|ms| format!("{} ms = {}", ms.0, lie.formula));
        let at_most = at_most.unwrap_or_else(|| "no limit".to_owned());
        rows.add_row([&format!("{} {}", lie.part, lie.can), lie.from_to, &at_most]);
    }
    let mut assumed = Table::new();
    assumed.load_style(NOTHING);
    for property in properties {
        assumed.add_row([property.id, &property.authentication]);
    }
    for line in rows.lines() {
        print(line.trim_end())?;
    }
    print("")?;
    print("What each property assumes of senders:")?;
    for line in assumed.lines() {
        print(line.trim_end())?;
    }
    Ok(())
}
