//! Tables as comma-separated values.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use serde::Serialize;
use serde_json::Value;

use super::Failure;

/// Writes rows to the file that was asked for, if one was. A nested field has both names for its column.
pub(super) fn write<R: Serialize>(path: Option<&Path>, rows: &[R]) -> Result<(), Failure> {
    let Some(path) = path else { return Ok(()) };
    let failed = |error: csv::Error| Failure::Input(format!("{}: {error}", path.display()));
    let mut flat: Vec<BTreeMap<String, String>> = Vec::new();
    for row in rows {
        let mut cells = BTreeMap::new();
        flatten(
            "",
            &serde_json::to_value(row).map_err(Failure::input)?,
            &mut cells,
        );
        flat.push(cells);
    }
    let columns: BTreeSet<&String> = flat.iter().flat_map(BTreeMap::keys).collect();
    let mut file = csv::Writer::from_path(path).map_err(failed)?;
    if !columns.is_empty() {
        file.write_record(&columns).map_err(failed)?;
    }
    for row in &flat {
        let cells = columns
            .iter()
            .map(|it| row.get(*it).map_or("", String::as_str));
        file.write_record(cells).map_err(failed)?;
    }
    file.flush().map_err(|error| failed(error.into()))
}

fn flatten(name: &str, value: &Value, cells: &mut BTreeMap<String, String>) {
    let below = |part: &str| match name {
        "" => part.to_owned(),
        name => format!("{name}_{part}"),
    };
    match value {
        Value::Object(parts) => parts
            .iter()
            .for_each(|(part, it)| flatten(&below(part), it, cells)),
        Value::Array(parts) => {
            let parts = parts.iter().enumerate();
            parts.for_each(|(part, it)| flatten(&below(&part.to_string()), it, cells));
        }
        Value::Null => {}
        Value::String(text) => drop(cells.insert(name.to_owned(), text.clone())),
        other => drop(cells.insert(name.to_owned(), other.to_string())),
    }
}
