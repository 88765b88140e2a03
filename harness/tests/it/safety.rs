//! The safety case: each claim on its page has all its parts, and what it rests on is there.

use std::collections::BTreeSet;
use std::path::Path;

const PAGE: &str = "harness/doc/safety-case.md";
const PARTS: [&str; 6] = [
    "Causes: ",
    "**Claim.** ",
    "**Argument.** ",
    "**Controls.** ",
    "**Evidence.**\n  - ",
    "**Residual risk.** ",
];
const WHO: [&str; 4] = ["outsider", "insider", "local", "supply"];

/// The text of a file of the repository, or of all files of a folder; nothing where there is none.
type Read<'a> = &'a dyn Fn(&str) -> String;

/// A hazard (H…) or a threat (T…).
struct Claim<'a> {
    id: &'a str,
    text: &'a str,
}

impl<'a> Claim<'a> {
    fn all(page: &'a str) -> Vec<Self> {
        let sections = page.split("\n### ").skip(1);
        let texts = sections.filter_map(|it| it.split("\n## ").next()?.split_once(": "));
        texts.map(|(id, text)| Self { id, text }).collect()
    }

    /// The rest of the line behind these words.
    fn line(&self, words: &str) -> &'a str {
        let rest = self.text.split_once(words).map_or("", |(_, rest)| rest);
        rest.lines().next().unwrap_or_default()
    }

    fn evidence(&self) -> impl Iterator<Item = (&'a str, &'a str)> {
        let lines = self.text.lines().filter_map(|it| it.strip_prefix("  - "));
        lines.map(|it| it.split_once(' ').unwrap_or((it, "")))
    }

    /// The rules that are controls, and the properties that are evidence.
    fn needs(&self) -> impl Iterator<Item = String> {
        let properties = self
            .evidence()
            .filter(|(kind, _)| kind.starts_with("propert"));
        let lists = properties.map(|(_, names)| names);
        lists.chain([self.line("**Controls.** ")]).flat_map(ids)
    }

    fn findings(&self, known: &Known, read: Read) -> Vec<String> {
        let absent = PARTS.iter().filter(|part| !self.text.contains(**part));
        let mut found: Vec<_> = absent.map(|part| format!("no {}", part.trim())).collect();
        let who = self.line("Who: ").split('.').next().unwrap_or_default();
        if self.id.starts_with('T') && !WHO.contains(&who) {
            found.push(format!("who is none of {WHO:?}"));
        }
        let assumed = ids(self.line("**Assumes** "));
        let unknown = self.needs().chain(assumed).filter(|id| !known.has(id));
        found.extend(unknown.map(|id| format!("no {id}")));
        found.extend(
            self.evidence()
                .filter_map(|(kind, what)| missing(kind, what, read)),
        );
        found
            .iter()
            .map(|why| format!("{}: {why}", self.id))
            .collect()
    }
}

/// Whatever looks like an id: a capital letter and a number.
fn ids(text: &str) -> Vec<String> {
    let words = text.split(|c: char| !c.is_alphanumeric());
    let is_id = |it: &&str| {
        let number = it.strip_prefix(|c: char| c.is_ascii_uppercase());
        number.is_some_and(|number| number.parse::<u8>().is_ok())
    };
    words.filter(is_id).map(str::to_owned).collect()
}

/// Why a piece of evidence is none. Links are checked with those of all other pages.
fn missing(kind: &str, what: &str, read: Read) -> Option<String> {
    let (name, rest) = what
        .strip_prefix('[')
        .and_then(|it| it.split_once("](../../"))
        .unwrap_or((what, ""));
    let (file, row) = rest.split_once(')').unwrap_or((rest, ""));
    let text = read(file);
    let is_there = match kind {
        "property" | "properties" | "page" | "scenario" => true,
        "law" => text.contains(&format!("pub fn {name}(")),
        "proof" => {
            text.contains(&format!("fn {name}("))
                && read("proofs/times.tsv").contains(&format!("::{name}\t"))
        }
        // A case of a program that CI runs.
        "script" => text.contains(&format!("def {name}(")),
        // A row of a table is named behind the test that goes through the table.
        "test" | "weakening" => {
            runs(name, &text) && row.split('"').nth(1).is_none_or(|row| text.contains(row))
        }
        _ => false,
    };
    (!is_there).then(|| format!("no {kind} {what}"))
}

/// Whether a file has a test of this name that is not ignored, or a script.
fn runs(name: &str, file: &str) -> bool {
    if file.contains(&format!("\n== {name}\n")) {
        return true;
    }
    let Some((above, _)) = file.split_once(&format!("fn {name}(")) else {
        return false;
    };
    // Attributes and comments, up to the end of the item before.
    let above = above.lines().rev().map(str::trim);
    let above: Vec<_> = above
        .take_while(|it| !it.ends_with(['{', '}', ';']))
        .collect();
    above.contains(&"#[test]") && !above.iter().any(|it| it.starts_with("#[ignore"))
}

/// The ids that a claim may name.
struct Known {
    /// Rules and properties: each is needed by a claim.
    needed: BTreeSet<String>,
    guide: BTreeSet<String>,
    assumptions: BTreeSet<String>,
}

impl Known {
    fn read(page: &str, read: Read) -> Self {
        let scenarios = read("model-check/scenarios");
        let mut needed = first_cells(&read("model-check/doc/verification.md"), "ILWC");
        needed.retain(|id| scenarios.contains(&format!("\"{id}\"")));
        needed.extend(first_cells(&read("protocol/doc/protocol.md"), "R"));
        let guide = read("protocol/doc/integration.md").replace("\n| ", "\n| G");
        Self {
            needed,
            guide: first_cells(&guide, "G"),
            assumptions: first_cells(page, "A"),
        }
    }

    fn has(&self, id: &str) -> bool {
        let mut all = [&self.needed, &self.guide, &self.assumptions].into_iter();
        all.any(|it| it.contains(id))
    }
}

/// The ids with one of these letters that begin rows of tables.
fn first_cells(text: &str, letters: &str) -> BTreeSet<String> {
    let cells = text
        .lines()
        .filter_map(|it| it.strip_prefix("| ")?.split_once(" |"));
    let all = cells.flat_map(|(cell, _)| ids(cell));
    all.filter(|id| id.starts_with(|c| letters.contains(c)))
        .collect()
}

/// All that does not hold together.
fn findings(page: &str, read: Read) -> Vec<String> {
    let (claims, known) = (Claim::all(page), Known::read(page, read));
    let mut found: Vec<_> = claims
        .iter()
        .flat_map(|it| it.findings(&known, read))
        .collect();
    let mut once = BTreeSet::new();
    let again = claims.iter().filter(|it| !once.insert(it.id));
    found.extend(again.map(|it| format!("{}: twice", it.id)));
    let assumed: BTreeSet<_> = claims
        .iter()
        .flat_map(|it| ids(it.line("**Assumes** ")))
        .collect();
    let idle = known.assumptions.difference(&assumed);
    found.extend(idle.map(|id| format!("{id}: no claim needs it")));
    let needed: BTreeSet<_> = claims.iter().flat_map(Claim::needs).collect();
    for id in &known.needed {
        let is_beside = page.contains(&format!("\n- **{id}.** "));
        if needed.contains(id) == is_beside {
            found.push(format!(
                "{id}: either a claim needs it, or the end of the page says why none does"
            ));
        }
    }
    found
}

#[test]
fn every_claim_rests_on_what_is_there() {
    let read = |path: &str| {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path);
        let files = path.read_dir().into_iter().flatten().flatten();
        let files = files.map(|it| it.path()).chain([path.clone()]);
        files
            .filter_map(|it| std::fs::read_to_string(it).ok())
            .collect::<String>()
    };
    let page = read(PAGE);
    assert_eq!(findings(&page, &read), Vec::<String>::new());
    assert!(Claim::all(&page).len() >= 30);
}
