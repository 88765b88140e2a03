//! What a claim rests on, and whether it is still there.

use std::str::FromStr;

use crossguard_model_check::scenario::Scenario;
use crossguard_testkit::markdown::anchors;

use super::repository::Repository;

pub(crate) const VERIFICATION: &str = "model-check/doc/verification.md";
pub(crate) const HARNESSES: &str = "proofs/harnesses.toml";
const WEAKENINGS: [&str; 2] = [
    "model-check/tests/weakenings.rs",
    "model-check/tests/timed_weakenings.rs",
];

/// A piece of evidence, as it is written: its kind, a colon, and its name.
pub(crate) enum Evidence {
    Property(String),
    Scenario(String),
    Weakening(String),
    Law {
        file: String,
        name: String,
    },
    Proof(String),
    Test {
        file: String,
        name: String,
    },
    Page {
        file: String,
        anchor: Option<String>,
    },
}

impl FromStr for Evidence {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (kind, name) = text.split_once(':').ok_or("no kind")?;
        let named = name.to_owned();
        let in_file = || {
            let (file, name) = name.split_once("::").ok_or("no name behind the file")?;
            Ok::<_, String>((file.to_owned(), name.to_owned()))
        };
        Ok(match kind {
            "property" => Self::Property(named),
            "scenario" => Self::Scenario(named),
            "weakening" => Self::Weakening(named),
            "proof" => Self::Proof(named),
            "law" => {
                let (file, name) = in_file()?;
                let file = format!("protocol/src/laws/{file}.rs");
                Self::Law { file, name }
            }
            "test" => {
                let (file, name) = in_file()?;
                Self::Test { file, name }
            }
            "page" => match name.split_once('#') {
                Some((file, anchor)) => Self::Page {
                    file: file.to_owned(),
                    anchor: Some(anchor.to_owned()),
                },
                None => Self::Page {
                    file: named,
                    anchor: None,
                },
            },
            _ => return Err("no kind of evidence".to_owned()),
        })
    }
}

/// The file of a scenario that comes with the kit.
pub(crate) fn scenario_file(name: &str) -> String {
    format!("model-check/scenarios/{name}.toml")
}

impl Evidence {
    /// Why it is no evidence any more.
    pub(crate) fn missing(&self, repository: &Repository) -> Option<String> {
        match self {
            Self::Property(id) => property_missing(id, repository),
            Self::Scenario(name) => {
                let is_shipped = Scenario::shipped().any(|it| it == *name);
                (!is_shipped || !repository.has(&scenario_file(name)))
                    .then(|| format!("no scenario {name}"))
            }
            Self::Weakening(name) => {
                let whys = WEAKENINGS.map(|file| test_missing(file, name, repository));
                let is_there = whys.iter().any(Option::is_none);
                (!is_there).then(|| format!("no weakening {name}"))
            }
            Self::Law { file, name } => {
                let text = repository.text(file).unwrap_or_default();
                (!text.contains(&format!("pub fn {name}("))).then(|| format!("no law {name}"))
            }
            Self::Proof(name) => proof_time(name, repository).err(),
            Self::Test { file, name } => test_missing(file, name, repository),
            Self::Page { file, anchor } => {
                let Some(text) = repository.text(file) else {
                    return Some(format!("no page {file}"));
                };
                let anchor = anchor.as_ref()?;
                let is_there = anchors(&text).contains(anchor);
                (!is_there).then(|| format!("no heading #{anchor} on {file}"))
            }
        }
    }

    /// A repository that lacks it.
    pub(crate) fn taken_out_of(&self, repository: &Repository) -> Repository {
        let renamed = |file: &str, name: &str| {
            let from = format!("fn {name}(");
            repository.replaced(file, &from, &from.replace("fn ", "fn gone_"))
        };
        match self {
            Self::Property(id) => {
                repository.replaced(VERIFICATION, &format!("\n| {id} |"), "\n| – |")
            }
            Self::Scenario(name) => repository.without(&scenario_file(name)),
            Self::Weakening(name) => {
                let [one, other] = WEAKENINGS;
                let from = format!("fn {name}(");
                renamed(one, name).replaced(other, &from, "fn gone(")
            }
            Self::Law { file, name } | Self::Test { file, name } => renamed(file, name),
            Self::Proof(name) => repository.replaced(HARNESSES, &format!("\"{name}\""), "\"gone\""),
            Self::Page { file, anchor: None } => repository.without(file),
            // A heading that is said in other words.
            Self::Page { file, .. } => repository.replaced(file, "# ", "# Another "),
        }
    }
}

/// A property has a row on the page, a file, and a scenario that claims it.
fn property_missing(id: &str, repository: &Repository) -> Option<String> {
    let page = repository.text(VERIFICATION).unwrap_or_default();
    if !page.contains(&format!("\n| {id} | ")) {
        return Some(format!("no property {id} on {VERIFICATION}"));
    }
    let is_claimed = Scenario::shipped().any(|name| {
        let text = repository.text(&scenario_file(name)).unwrap_or_default();
        text.contains(&format!("\"{id}\""))
    });
    (!is_claimed).then(|| format!("no scenario claims {id}"))
}

/// How long Kani took for a proof.
pub(crate) fn proof_time(name: &str, repository: &Repository) -> Result<String, String> {
    let text = repository.text(HARNESSES).unwrap_or_default();
    let table: toml::Table = text
        .parse()
        .map_err(|error| format!("{HARNESSES}: {error}"))?;
    let harnesses = table.get("harness").and_then(toml::Value::as_array);
    let mut harnesses = harnesses.into_iter().flatten();
    let harness = harnesses.find(|it| it.get("name").and_then(toml::Value::as_str) == Some(name));
    let time = harness.and_then(|it| it.get("time")?.as_str());
    match time {
        Some("not measured") | None => Err(format!("Kani has not proved {name} as it is now")),
        Some(time) => Ok(time.to_owned()),
    }
}

/// A test that runs by itself: of this name, in this file, and not ignored.
fn test_missing(file: &str, name: &str, repository: &Repository) -> Option<String> {
    let Some(text) = repository.text(file) else {
        return Some(format!("no file {file}"));
    };
    let lines: Vec<_> = text.lines().map(str::trim).collect();
    let declared = format!("fn {name}(");
    let Some(at) = lines.iter().position(|line| line.starts_with(&declared)) else {
        return Some(format!("no test {name} in {file}"));
    };
    // What stands above: attributes and comments, up to the end of the item before.
    let above = lines[..at].iter().rev();
    let above: Vec<_> = above
        .take_while(|line| !line.is_empty() && !["}", "{"].iter().any(|end| line.ends_with(end)))
        .collect();
    if !above.iter().any(|line| **line == "#[test]") {
        return Some(format!("{name} is no test in {file}"));
    }
    let is_ignored = above.iter().any(|line| line.starts_with("#[ignore"));
    is_ignored.then(|| format!("{name} is ignored in {file}"))
}
