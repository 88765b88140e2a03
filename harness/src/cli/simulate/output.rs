//! How results of `crossguard simulate` are printed and written.

use comfy_table::Table;
use comfy_table::presets::NOTHING;
use crossguard_evaluation::matrix::{CbrCell, ObsCell};
use crossguard_evaluation::statements::Comparison;
use crossguard_evaluation::statistics::Estimate;

use serde::Serialize;
use serde_json::Value;

use super::{Failure, print};

/// A row of a table for people.
pub(super) trait Row {
    /// Its columns, each with its head.
    fn columns(&self) -> Vec<(&'static str, String)>;
}

fn percent(it: &Estimate, factor: f64) -> String {
    format!("{:.2} ± {:.2} %", factor * it.mean, factor * it.sd)
}

/// Percent with two digits.
fn mean(it: &Estimate) -> String {
    format!("{:.2} %", it.mean)
}

impl Row for ObsCell {
    fn columns(&self) -> Vec<(&'static str, String)> {
        let at_intersections = self.covered_at_intersections_percent.mean;
        vec![
            ("robots", self.robots.to_string()),
            ("pedestrians", self.pedestrians.to_string()),
            ("radius", format!("{} m", self.radius_m)),
            ("coverage", percent(&self.obs_percent, 1.0)),
            ("of it at intersections", format!("{at_intersections:.1} %")),
        ]
    }
}

impl Row for CbrCell {
    fn columns(&self) -> Vec<(&'static str, String)> {
        let rates = self.messages_per_s.each_ref();
        let [vam, cam, ram] = rates.map(|it| format!("{:.1}", it.mean));
        let vam_share = self.vam_share_percent.mean;
        vec![
            ("robots", self.robots.to_string()),
            ("pedestrians", self.pedestrians.to_string()),
            ("radius", format!("{} m", self.radius_m)),
            ("mCBR", percent(&self.mcbr, 100.0)),
            ("reduction", percent(&self.reduction_percent, 1.0)),
            ("by the law", mean(&self.predicted_percent)),
            ("silent devices", mean(&self.passive_percent)),
            ("wrongly silent", mean(&self.wrongly_silent_percent)),
            ("VAM share", format!("{vam_share:.1} %")),
            ("VAM/s", vam),
            ("CAM/s", cam),
            ("RAM/s", ram),
            ("overlapped", mean(&self.overlapped_percent)),
        ]
    }
}

/// The cells as a table for people.
pub(super) fn table<C: Row>(cells: &[C]) -> Table {
    let mut table = Table::new();
    table.load_style(NOTHING);
    for cell in cells {
        let (heads, values): (Vec<_>, Vec<_>) = cell.columns().into_iter().unzip();
        table.set_header(heads);
        table.add_row(values);
    }
    table
}

/// A row for each seed of each cell, with the values of that seed alone.
pub(super) fn by_seed<C: Serialize>(cells: &[C]) -> Result<Vec<Value>, Failure> {
    let mut rows = Vec::new();
    for cell in cells {
        let cell = serde_json::to_value(cell).map_err(Failure::input)?;
        let seeds = cell["seeds"].as_array().map_or(0, Vec::len);
        rows.extend((0..seeds).map(|seed| at_seed(&cell, seed)));
    }
    Ok(rows)
}

fn at_seed(value: &Value, seed: usize) -> Value {
    match value {
        Value::Object(parts) if parts.contains_key("by_seed") => parts["by_seed"][seed].clone(),
        Value::Object(parts) => {
            let parts = parts.iter().map(|(name, part)| match &**name {
                "seeds" => ("seed".to_owned(), part[seed].clone()),
                _ => (name.clone(), at_seed(part, seed)),
            });
            parts.collect()
        }
        Value::Array(parts) => parts.iter().map(|part| at_seed(part, seed)).collect(),
        other => other.clone(),
    }
}

/// Prints the paper's statements beside the measurements, one line each.
pub(super) fn print_statements(
    is_documented: bool,
    statements: &[Comparison],
) -> Result<(), Failure> {
    if statements.is_empty() {
        return Ok(());
    }
    let setting = if is_documented {
        "at the documented setting"
    } else {
        "at another setting than the documented one"
    };
    print(format_args!("\nWhat the paper states, {setting}:"))?;
    let mut table = Table::new();
    table.load_style(NOTHING);
    table.set_header(["verdict", "about", "measured", "paper", "rule"]);
    for it in statements {
        let verdict = it.outcome.words();
        table.add_row([verdict, it.about, &it.measured, &it.paper, it.rule]);
    }
    print(table)
}

/// Prints the assumptions of the results, one line each.
pub(super) fn print_parameters(head: &str, parameters: &impl Serialize) -> Result<(), Failure> {
    let value = serde_json::to_value(parameters).map_err(Failure::input)?;
    print(head)?;
    print_value(2, &value)?;
    print("")
}

fn print_value(indent: usize, value: &Value) -> Result<(), Failure> {
    let Some(fields) = value.as_object() else {
        return Ok(());
    };
    for (name, value) in fields {
        let name = name.replace('_', " ");
        if value.is_object() && value.as_object().is_some_and(|it| it.len() > 1) {
            print(format_args!("{:indent$}{name}:", ""))?;
            print_value(indent + 2, value)?;
        } else {
            let is_rate = name.ends_with(" hz");
            let value = match value {
                Value::Null if is_rate => "by rules".to_owned(),
                value => value.to_string().replace('"', ""),
            };
            print(format_args!("{:indent$}{name}: {value}", ""))?;
        }
    }
    Ok(())
}
