//! The pages of the repository: what they link, name and tell to type is there.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use crossguard_model_check::scenario::Scenario;
use crossguard_robot::robot_file::RobotFile;
use crossguard_testkit::command::*;
use crossguard_testkit::markdown::{anchors, lines};
use indicatif::HumanCount;

fn repository() -> PathBuf {
    let harness = Path::new(env!("CARGO_MANIFEST_DIR"));
    harness.parent().expect("it is in a workspace").to_owned()
}

/// All files below a folder with this extension, but for what builds leave behind.
fn files(folder: &Path, extension: &str, found: &mut Vec<PathBuf>) {
    for entry in folder.read_dir().unwrap().flatten() {
        let (path, name) = (entry.path(), entry.file_name());
        let name = name.to_string_lossy();
        if name.starts_with('.') || ["target", "node_modules", "build"].contains(&&*name) {
            continue;
        }
        if entry.file_type().unwrap().is_dir() {
            files(&path, extension, found);
        } else if path.extension().is_some_and(|found| found == extension) {
            found.push(path);
        }
    }
}

/// The pages with their texts.
fn pages() -> BTreeMap<PathBuf, String> {
    let mut paths = Vec::new();
    files(&repository(), "md", &mut paths);
    assert!(paths.len() > 10, "{paths:?}");
    let read = |path: PathBuf| {
        let text = std::fs::read_to_string(&path).unwrap();
        (path, text)
    };
    paths.into_iter().map(read).collect()
}

/// What a page links, but for the web.
fn links(text: &str) -> Vec<String> {
    let prose: Vec<_> = lines(text, false).collect();
    let prose = prose.join("\n");
    let targets = prose.split("](").skip(1);
    let targets = targets.filter_map(|rest| Some(rest.split_once(')')?.0.to_owned()));
    targets
        .filter(|target| !target.contains("://") && !target.starts_with("mailto:"))
        .collect()
}

/// The page or other file that a link of this page leads to; of a folder, its README.
fn target(page: &Path, link: &str) -> PathBuf {
    let file = link.split('#').next().unwrap_or_default();
    if file.is_empty() {
        return page.to_owned();
    }
    let path = page.parent().unwrap().join(file);
    let path = path.canonicalize();
    let path = path.unwrap_or_else(|_| panic!("{}: no {link}", page.display()));
    match path.join("README.md") {
        readme if readme.is_file() => readme,
        _ => path,
    }
}

#[test]
fn every_link_leads_somewhere() {
    let pages = pages();
    for (page, text) in &pages {
        for link in links(text) {
            let target = target(page, &link);
            if let Some((_, anchor)) = link.split_once('#') {
                let there = anchors(&pages[&target]).contains(anchor);
                assert!(there, "{}: no anchor {link}", page.display());
            }
        }
    }
}

#[test]
fn every_page_can_be_found_from_the_readme() {
    let pages = pages();
    let mut open = vec![repository().join("README.md")];
    let mut found = BTreeSet::new();
    while let Some(page) = open.pop() {
        if let Some(text) = pages.get(&page)
            && found.insert(page.clone())
        {
            open.extend(links(text).iter().map(|link| target(&page, link)));
        }
    }
    let lost: Vec<_> = pages.keys().filter(|page| !found.contains(*page)).collect();
    assert!(lost.is_empty(), "no way leads to {lost:?}");
}

/// What stands between backticks in the prose of a page, in one line.
fn quoted(text: &str) -> Vec<String> {
    let prose: Vec<_> = lines(text, false).collect();
    let prose = prose.join(" ");
    let quoted = prose.split('`').skip(1).step_by(2);
    quoted
        .map(|words| words.split_whitespace().collect::<Vec<_>>().join(" "))
        .collect()
}

fn is_rust(name: &str) -> bool {
    Path::new(name).extension().is_some_and(|it| it == "rs")
}

#[test]
fn the_files_that_pages_name_exist() {
    let tops = ["codec/", "harness/", "model-check/", "proofs/", "protocol/"];
    let mut named = 0;
    for (page, text) in pages() {
        let folder = page.parent().unwrap();
        let is_name = |name: &String| {
            let plain = |c: char| c.is_ascii_alphanumeric() || "/._-".contains(c);
            let is_path = tops.iter().any(|top| name.starts_with(top));
            name.chars().all(plain) && (is_path || name.contains('/') && is_rust(name))
        };
        for name in quoted(&text).into_iter().filter(is_name) {
            named += 1;
            // From the root, from the page, or from the crate that it is about.
            let mut from = [repository(), folder.to_owned(), folder.join("..")].into_iter();
            let exists = from.any(|from| from.join(&name).exists());
            assert!(exists, "{}: no {name}", page.display());
        }
    }
    assert!(named > 50, "{named}");
}

#[test]
fn the_tests_that_pages_name_exist() {
    let mut sources = Vec::new();
    files(&repository(), "rs", &mut sources);
    let read = |path: &PathBuf| std::fs::read_to_string(path).unwrap();
    let sources: String = sources.iter().map(read).collect();
    let is_name = |name: &String| {
        let plain = |c: char| c.is_ascii_lowercase() || c == '_';
        name.matches('_').count() >= 4 && name.chars().all(plain)
    };
    let mut named = 0;
    for (page, text) in pages() {
        for name in quoted(&text).into_iter().filter(is_name) {
            named += 1;
            assert!(sources.contains(&name), "{}: no {name}", page.display());
        }
    }
    assert!(named > 20, "{named}");
}

/// The words of a command, as far as a shell would give them to one program; nothing where a part is
/// left out.
fn words(command: &str) -> Option<Vec<String>> {
    let mut words = vec![String::new()];
    let mut quote = None;
    for c in command.chars() {
        match (quote, c) {
            (_, '…') => return None,
            (None, '\'' | '"') => quote = Some(c),
            (Some(open), close) if open == close => quote = None,
            (None, '#' | '|' | '>' | '&' | ';') => break,
            (None, ' ') => words.push(String::new()),
            _ => words.last_mut().unwrap().push(c),
        }
    }
    words.retain(|word| !word.is_empty());
    Some(words)
}

/// The arguments of every `crossguard` command on a page.
fn commands(text: &str) -> Vec<Vec<String>> {
    let code: Vec<_> = lines(text, true).map(str::trim).collect();
    let code = code.join("\n").replace("\\\n", " ");
    let prose = quoted(text);
    let commands = code.lines().chain(prose.iter().map(String::as_str));
    let arguments = commands.filter_map(|line| {
        let starts = [
            "cargo run --release -- ",
            "cargo run --release --features zenoh -- ",
            "target/release/crossguard ",
            "crossguard ",
        ];
        starts.iter().find_map(|start| line.strip_prefix(start))
    });
    arguments.filter_map(words).collect()
}

/// The command line takes them apart; what they do is the concern of other tests.
#[test]
fn the_commands_that_pages_tell_to_type_can_be_typed() {
    let mut typed = 0;
    for (page, text) in pages() {
        for mut command in commands(&text) {
            typed += 1;
            command.push("--help".to_owned());
            let arguments: Vec<_> = command.iter().map(String::as_str).collect();
            let output = run(&arguments);
            let (page, said) = (page.display(), stderr(&output));
            assert_eq!(output.status.code(), Some(0), "{page}, {command:?}: {said}");
        }
    }
    assert!(typed > 40, "{typed}");
}

/// What `cargo test -p` on a page asks for: the package, and the file and the test in it, if it names them.
fn asked_tests(text: &str) -> Vec<Vec<String>> {
    let code: Vec<_> = lines(text, true).map(str::to_owned).collect();
    let all = code.into_iter().chain(quoted(text));
    let asked = all.filter_map(|line| words(line.trim().strip_prefix("cargo test -p ")?));
    asked.collect()
}

/// The folder of a package of this repository.
fn package(name: &str) -> PathBuf {
    let mut manifests = Vec::new();
    files(&repository(), "toml", &mut manifests);
    let line = format!("name = \"{name}\"\n");
    let is_it = |path: &&PathBuf| {
        path.ends_with("Cargo.toml") && std::fs::read_to_string(path).unwrap().contains(&line)
    };
    let manifest = manifests.iter().find(is_it);
    let manifest = manifest.unwrap_or_else(|| panic!("no package {name}"));
    manifest.parent().unwrap().to_owned()
}

#[test]
fn the_tests_that_pages_tell_to_run_exist() {
    let mut asked = 0;
    for (page, text) in pages() {
        for words in asked_tests(&text) {
            asked += 1;
            let folder = package(&words[0]);
            let Some(at) = words.iter().position(|word| word == "--test") else {
                continue;
            };
            let file = folder.join("tests").join(&words[at + 1]);
            let (file, parts) = (file.with_extension("rs"), file.join("main.rs"));
            let file = if file.is_file() { file } else { parts };
            let read = std::fs::read_to_string(&file);
            let (page, name) = (page.display(), file.display());
            let test = read.unwrap_or_else(|_| panic!("{page}: no {name}"));
            if let Some(filter) = words.get(at + 2).filter(|word| !word.starts_with('-')) {
                assert!(test.contains(filter), "{page}: no {filter} in {name}");
            }
        }
    }
    assert!(asked > 20, "{asked}");
}

/// The paragraphs of the paper, in its order, as its page names them.
const PARAGRAPHS: &str = "\
Abstract / I.1 / I.2 / I.3 / I.4 / I.5 / I.6 / I.7 / I.8 / II.1 / II-A.1 / II-A.2 / II-A.3 / II-A.4 / II-B.1 / R1 / \
R2 / R3 / R4 / R5 / R6 / R7 / II-C.1 / CAM / VAM / CPM / MCM / II-C.2 / II-D.1 / II-D.2 / RAM.1 / RAM.2 / RAM.3 / \
RAM.4 / coordination.1 / coordination.2 / coordination.3 / clustering.1 / clustering.2 / clustering.3 / RMCM.1 / \
RMCM.2 / III.1 / III.2 / III-A.1 / III-A.2 / III-A.3 / III-A.4 / stage 1 / stage 2 / stage 3 / stage 4.1 / \
stage 4.2 / stage 5 / timing / reliability / extending.1 / extending.2 / III-B.1 / setup.1 / setup.2 / setup.3 / \
case 1.1 / case 1, metric / case 1, results.1 / case 1, results.2 / case 2.1 / case 2, load / case 2, metric / \
case 2, results / case 2, trade-off / IV.1 / IV.2 / IV.3 / IV.4";

/// Each has a row with what it says, a place in the repository, a command, and what differs.
#[test]
fn the_papers_page_goes_through_every_paragraph() {
    let (path, page) = read("model-check/doc/paper.md");
    let rows = page.lines().filter(|line| line.starts_with("| "));
    let rows = rows.map(|row| row.trim_matches('|').split(" | ").map(str::trim));
    let rows: Vec<Vec<_>> = rows.map(Iterator::collect).collect();
    let rows: Vec<_> = rows.iter().filter(|row| row[0] != "paragraph").collect();
    let named: Vec<_> = rows.iter().map(|row| row[0]).collect();
    assert_eq!(named.join(" / "), PARAGRAPHS);
    // Paragraphs that only lead on to others.
    let leads_on = ["I.8", "II-A.4", "II-B.1", "III.2"];
    for row in rows {
        let [paragraph, says, here, see, differs] = row[..] else {
            panic!("another number of columns: {row:?}");
        };
        assert!(!says.is_empty() && !differs.is_empty(), "{paragraph}");
        let is_path = |name: &String| path.ancestors().any(|from| from.join(name).exists());
        let is_command = |name: &String| {
            ["cargo ", "crossguard "]
                .iter()
                .any(|start| name.starts_with(start))
        };
        let (places, commands) = (quoted(here), quoted(see));
        let is_told = places.iter().any(is_path) && commands.iter().any(is_command);
        // What is in the module of the row before has its command.
        let refers = here.starts_with("the same") || here.starts_with("all four");
        let is_only_led = leads_on.contains(&paragraph) && see == "–";
        let has_command = commands.iter().any(is_command);
        assert!(
            is_told || refers && has_command || is_only_led,
            "{paragraph}"
        );
    }
}

/// The Rust in the README is that of a page which is compiled.
#[test]
fn the_readmes_example_is_the_one_of_the_state_machines_crate() {
    let text = |path: &str| std::fs::read_to_string(repository().join(path)).unwrap();
    let readme = text("README.md");
    let (_, code) = readme.split_once("```rust\n").expect("a block of Rust");
    let (code, rest) = code.split_once("```").expect("it ends");
    assert!(text("protocol/README.md").contains(code));
    assert!(!rest.contains("```rust"), "a second one is not compiled");
}

#[test]
fn the_state_diagram_of_the_protocols_page_is_the_one_that_the_code_makes() {
    let diagram = stdout(&run(&["fsm"]));
    let (path, page) = read("protocol/doc/protocol.md");
    let (head, rest) = page.split_once("```mermaid\n").expect("a diagram");
    let (_, tail) = rest.split_once("```").expect("it ends");
    assert_is(&path, &format!("{head}```mermaid\n{diagram}```{tail}"));
}

fn read(page: &str) -> (PathBuf, String) {
    let path = repository().join(page);
    let text = std::fs::read_to_string(&path).unwrap();
    (path, text)
}

/// Asserts that a page has this text; with `CROSSGUARD_BLESS=1`, writes it.
fn assert_is(path: &Path, text: &str) {
    if std::env::var_os("CROSSGUARD_BLESS").is_some() {
        std::fs::write(path, text).unwrap();
    }
    let is_current = std::fs::read_to_string(path).unwrap() == text;
    let page = path.strip_prefix(repository()).unwrap().display();
    assert!(is_current, "{page}; run: cargo xtask bless {page}");
}

/// The README is read in one go.
#[test]
fn the_readme_has_at_most_150_lines() {
    let lines = include_str!("../../README.md").lines().count();
    assert!(lines <= 150, "{lines}");
}

/// The crates of this repository that a crate needs, by the last word of their names.
fn needed(manifest: &Path) -> (String, BTreeSet<String>) {
    let text = std::fs::read_to_string(manifest).unwrap();
    let manifest: toml::Table = text.parse().unwrap();
    let short = |name: &str| name.strip_prefix("crossguard-").map(str::to_owned);
    let package = manifest["package"]["name"].as_str().and_then(short);
    let needs = manifest.get("dependencies").and_then(|it| it.as_table());
    let needs = needs.into_iter().flat_map(toml::Table::keys);
    (
        package.unwrap(),
        needs.filter_map(|name| short(name)).collect(),
    )
}

/// Everything that can be reached by one arrow or more.
fn reached(arrows: &BTreeMap<String, BTreeSet<String>>, from: &str) -> BTreeSet<String> {
    let (mut open, mut found) = (vec![from.to_owned()], BTreeSet::new());
    while let Some(name) = open.pop() {
        for next in arrows.get(&name).into_iter().flatten() {
            if found.insert(next.clone()) {
                open.push(next.clone());
            }
        }
    }
    found
}

/// An arrow that leads where others lead together is left out; all others are drawn, and no more.
#[test]
fn the_readmes_picture_of_the_crates_is_that_of_the_manifests() {
    let mut manifests = Vec::new();
    files(&repository(), "toml", &mut manifests);
    let is_member = |path: &&PathBuf| {
        let text = std::fs::read_to_string(path).unwrap();
        path.ends_with("Cargo.toml") && text.contains("[package]") && !text.contains("[workspace]")
    };
    let crates: BTreeMap<_, _> = manifests
        .iter()
        .filter(is_member)
        .map(|it| needed(it))
        .collect();
    let readme = include_str!("../../README.md");
    let (_, picture) = readme.split_once("flowchart TD\n").expect("a picture");
    let (picture, _) = picture.split_once("```").expect("it ends");
    let mut drawn: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for line in picture.lines() {
        let name = |side: &str| side.split('[').next().unwrap().trim().to_owned();
        let (from, to) = line.split_once("-->").expect("an arrow");
        let is_new = drawn.entry(name(from)).or_default().insert(name(to));
        assert!(is_new, "drawn twice: {line}");
    }
    for (name, needs) in &crates {
        if ["mutants", "testkit"].contains(&name.as_str()) {
            continue; // tools for the others, which no crate needs
        }
        assert_eq!(reached(&drawn, name), reached(&crates, name), "{name}");
        for arrow in drawn.get(name).into_iter().flatten() {
            assert!(needs.contains(arrow), "{name} does not need {arrow}");
        }
    }
}

/// What the README says has been explored is what the scenario files pin.
#[test]
fn the_readmes_sum_of_states_is_that_of_the_scenarios() {
    let sizes = Scenario::shipped().map(|name| {
        let scenario = Scenario::load(name).unwrap();
        scenario.expected.expect("it is pinned").unique_states
    });
    let sizes: Vec<_> = sizes.collect();
    let states = HumanCount(sizes.iter().sum::<usize>() as u64);
    let (path, readme) = read("README.md");
    let (head, rest) = readme.split_once(" scenarios with ").expect("the sum");
    let head = head.trim_end_matches(|c: char| c.is_ascii_digit());
    let (_, tail) = rest.split_once(" states").expect("it ends");
    let count = sizes.len();
    let new = format!("{head}{count} scenarios with {states} states{tail}");
    assert_is(&path, &new);
}

/// Everything that the index of rules names is there, and every property is of some rule.
#[test]
fn the_index_of_rules_names_what_there_is() {
    let text = |path: String| std::fs::read_to_string(repository().join(path)).unwrap();
    let has = |path: String, name: &str| {
        let is_there = text(path.clone()).contains(&format!("fn {name}("));
        assert!(is_there, "no {name} in {path}");
    };
    let page = text("protocol/doc/protocol.md".to_owned());
    let missed = ["weakenings", "timed_weakenings"].map(|file| {
        let path = format!("model-check/tests/{file}.rs");
        text(path)
    });
    let (mut rules, mut named) = (0, BTreeSet::new());
    for row in page.lines().filter(|line| line.starts_with("| R")) {
        let cells: Vec<_> = row.trim_matches('|').split(" | ").map(str::trim).collect();
        let [id, _, functions, properties, weakening, law, script] = cells[..] else {
            panic!("another number of columns: {row}");
        };
        rules += 1;
        assert_eq!(id, format!("R{rules}"));
        for name in quoted(functions) {
            let (file, function) = name.split_once("::").expect("a file and a function");
            has(format!("protocol/src/{file}.rs"), function);
        }
        for name in quoted(weakening) {
            let is_there = missed.iter().any(|it| it.contains(&format!("fn {name}(")));
            assert!(is_there, "no weakening {name}");
        }
        for name in quoted(law) {
            let (file, function) = name.split_once("::").expect("a file and a law");
            has(format!("protocol/src/laws/{file}.rs"), function);
        }
        let [script] = &quoted(script)[..] else {
            panic!("one script: {row}");
        };
        assert!(text(format!("protocol/tests/{script}")).contains("#[test]"));
        named.extend(properties.split(", ").map(str::to_owned));
    }
    let verified = text("model-check/doc/verification.md".to_owned());
    let is_property = |id: &&str| {
        let number = id.get(1..).and_then(|number| number.parse::<u8>().ok());
        id.starts_with(['I', 'L', 'W']) && number.is_some()
    };
    let rows = verified.lines().filter_map(|line| line.strip_prefix("| "));
    let ids = rows.filter_map(|row| row.split(" | ").next());
    let all: BTreeSet<_> = ids.filter(is_property).map(str::to_owned).collect();
    assert!(all.len() > 30, "{all:?}");
    assert_eq!(
        named, all,
        "a property of no rule, or one that there is not"
    );
}

/// The identifiers that the page for ITS engineers shows can be a robot's, and others are refused.
#[test]
fn the_identifiers_on_the_its_page_can_be_configured() {
    let page = std::fs::read_to_string(repository().join("codec/doc/its-engineer.md")).unwrap();
    let (_, table) = page.split_once("```toml\n").expect("a table");
    let (table, _) = table.split_once("```").expect("it ends");
    let go2 = include_str!("../examples/go2.toml");
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("go2.toml");
    let read = |table: &str| {
        std::fs::write(&file, format!("{go2}\n{table}")).unwrap();
        RobotFile::read(&file)
    };
    assert_eq!(read(table).unwrap().identifiers.ram.message_id, 250);
    assert!(read(&table.replace("250", "16")).is_err());
}

/// Whatever a signed packet can be refused for is in the table that says where it is checked.
#[test]
fn each_cause_of_a_rejection_is_on_the_page_of_security() {
    let (_, source) = read("codec/src/security/rejected.rs");
    let (_, page) = read("codec/doc/security.md");
    let named = source.lines().filter_map(|line| line.split_once("=> \""));
    let causes = named.filter_map(|(_, rest)| rest.strip_suffix("\","));
    let missing: Vec<_> = causes
        .filter(|cause| *cause != "not secured" && !page.contains(&format!("`{cause}`")))
        .collect();
    assert_eq!(missing, Vec::<&str>::new());
}
