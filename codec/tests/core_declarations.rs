//! The declarations in `src/core` are those of the `.asn` modules and never drift: same components and
//! alternatives in the same order, same ranges and sizes, same extension markers.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// Type assignments by name, in small letters without spaces and underscores.
type Assignments = BTreeMap<String, String>;

const MODULES: [(&str, &str); 5] = [
    ("cdd", "CDD"),
    ("common", "Common"),
    ("vam", "VAM"),
    ("ram", "RAM"),
    ("rmcm", "RMCM"),
];

fn read(path: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    let text = fs::read_to_string(path).expect("the file can be read");
    let is_comment = |line: &&str| line.trim_start().starts_with(['/', '-']);
    let lines: Vec<_> = text.lines().filter(|line| !is_comment(line)).collect();
    lines.join("\n")
}

/// Small letters; a hyphen stays where it is a sign.
fn plain(text: &str) -> String {
    let mut plain = String::new();
    for letter in text.chars() {
        let is_sign = letter == '-' && plain.ends_with('(');
        if is_sign || !(letter.is_whitespace() || letter == '_' || letter == '-') {
            plain.extend(letter.to_lowercase());
        }
    }
    plain
}

/// Removes what is between `open` and the next `close`, as often as `open` is there.
fn without(mut text: String, open: &str, close: &str) -> String {
    while let Some(start) = text.find(open) {
        let length = text[start..].find(close).expect("a closing mark");
        text.replace_range(start..start + length + close.len(), "");
    }
    text
}

/// Removes the names of numbers and bits: they are no part of the encoding.
fn without_names(body: &str) -> String {
    match body.split_once('{') {
        Some((kind, rest)) if matches!(kind.trim(), "INTEGER" | "BIT STRING") => {
            let (_, range) = rest.split_once('}').expect("a closing brace");
            format!("{kind}{range}")
        }
        _ => body.to_owned(),
    }
}

fn of_modules() -> Assignments {
    let mut assignments = Assignments::new();
    for (_, module) in MODULES {
        let text = read(&format!("asn1/Crossguard-{module}.asn"));
        let text = text.split(";\n").last().unwrap().replace("\nEND", "");
        for block in text.split("\n\n") {
            let Some((name, body)) = block.split_once("::=") else {
                continue;
            };
            let mut body = without(without_names(body), "(WITH COMPONENTS", "})");
            if body.contains("ENUMERATED") {
                body = without(body, "(", ")");
            }
            assignments.insert(plain(name), plain(&body));
        }
    }
    assignments
}

fn of_core() -> Assignments {
    let mut assignments = Assignments::new();
    for (module, _) in MODULES {
        let text = read(&format!("src/core/{module}.rs"));
        for block in text.split("asn1! {").skip(1) {
            let (block, _) = block.split_once("\n}").expect("the end of the declaration");
            let (name, body) = block.split_once("::=").expect("a type assignment");
            let body = body.trim();
            // What holds it in Rust, and what its message allows, is no part of the type.
            let is_list = body.contains("AT MOST");
            let body = match body.rsplit_once(if is_list { "AT MOST" } else { ") " }) {
                Some((list, _)) if is_list => list.to_owned(),
                Some((integer, _)) if !body.contains(" OF ") => format!("{integer})"),
                _ => body.to_owned(),
            };
            assignments.insert(plain(name), plain(&without_names(&body)));
        }
    }
    assignments
}

/// The declaration with the bodies of the types that only the core has in the place of their names.
fn inlined(body: &str, core: &Assignments, modules: &Assignments) -> String {
    let own = core.iter().filter(|(name, _)| !modules.contains_key(*name));
    own.fold(body.to_owned(), |body, (name, own)| body.replace(name, own))
}

/// Where the core says less than the modules, and why nothing is lost.
const DIFFERENCES: [(&str, &str); 4] = [
    // TS 102 894-2, VruClusterInformation: only the others bound a cluster.
    (
        "ellipticalellipticalshape,radialradialshape,radialshapesradialshapes",
        "3absent",
    ),
    ("chargingboolean", "chargingbool"),
    ("ondutyboolean", "ondutybool"),
    ("yieldsboolean", "yieldsbool"),
];

#[test]
fn the_core_declares_what_the_modules_declare() {
    let (core, modules) = (of_core(), of_modules());
    let mut count = 0;
    for (name, body) in &core {
        let Some(module) = modules.get(name) else {
            continue;
        };
        let expected = DIFFERENCES
            .iter()
            .fold(module.clone(), |body, (here, there)| {
                body.replace(here, there)
            });
        assert_eq!(inlined(body, &core, &modules), expected, "{name}");
        count += 1;
    }
    let own: Vec<_> = core
        .keys()
        .filter(|name| !modules.contains_key(*name))
        .collect();
    let lists = [
        "confirmedfollowers",
        "crossingnumber",
        "maneuvercommands",
        "polygoncorners",
        "requestedfollowers",
        "robotpathhistory",
    ];
    assert_eq!(own, lists);
    assert!(count > 100, "{count}");
}
