//! The pages of the repository: what they link and tell to type is there.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::error::ErrorKind;
use crossguard_model_check::scenario::Scenario;
use crossguard_testkit::command::*;
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

/// The lines of a page outside of blocks of code, or those inside.
fn lines(text: &str, code: bool) -> impl Iterator<Item = &str> {
    let mut inside = false;
    text.lines().filter(move |line| {
        let is_fence = line.trim_start().starts_with("```");
        inside ^= is_fence;
        !is_fence && inside == code
    })
}

/// The anchors of a page: the ones that GitHub gives its headings.
fn anchors(text: &str) -> BTreeSet<String> {
    let headings = lines(text, false).filter(|line| line.starts_with('#'));
    let slug = |heading: &str| {
        let words = heading.trim_start_matches('#').trim().to_lowercase();
        let kept = words.chars().filter_map(|c| match c {
            ' ' => Some('-'),
            c if c.is_alphanumeric() || c == '-' || c == '_' => Some(c),
            _ => None,
        });
        kept.collect()
    };
    headings.map(slug).collect()
}

/// Links of a page, but for the web.
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

/// Texts between backticks in the prose of a page, each in one line.
fn quoted(text: &str) -> Vec<String> {
    let prose: Vec<_> = lines(text, false).collect();
    let prose = prose.join(" ");
    let quoted = prose.split('`').skip(1).step_by(2);
    quoted
        .map(|words| words.split_whitespace().collect::<Vec<_>>().join(" "))
        .collect()
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
            (None, '#' | '|' | '<' | '>' | '&' | ';') => break,
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
            let words = ["crossguard".to_owned()].into_iter().chain(command);
            let parsed = crossguard_harness::cli::command().try_get_matches_from(words);
            let said = parsed.expect_err("it asks for help");
            let is_help = said.kind() == ErrorKind::DisplayHelp;
            assert!(is_help, "{}: {said}", page.display());
        }
    }
    assert!(typed > 40, "{typed}");
}

#[test]
fn the_state_diagram_of_the_protocols_page_is_the_one_that_the_code_makes() {
    let diagram = stdout(&run_line("fsm"));
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

/// The README's number of explored states is that of the scenario files.
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

/// The functions of the protocol that keep each rule: a mark such as `// R7: ...` stands at the line.
fn kept() -> BTreeMap<String, Vec<String>> {
    let mut sources = Vec::new();
    files(&repository().join("protocol/src"), "rs", &mut sources);
    sources.retain(|path| !path.iter().any(|part| part == "laws"));
    sources.sort();
    let mut kept = BTreeMap::<String, Vec<String>>::new();
    for path in sources {
        let file = path.file_stem().unwrap().to_string_lossy();
        let text = std::fs::read_to_string(&path).unwrap();
        let mut function = "";
        for line in text.lines() {
            if let Some((_, rest)) = line.split_once("fn ") {
                let ends = |c: char| !c.is_alphanumeric() && c != '_';
                function = rest.split(ends).next().unwrap_or(function);
            }
            let Some(comment) = line.trim_start().strip_prefix("// ") else {
                continue;
            };
            let is_rule = |word: &&str| {
                let number = word.strip_prefix('R');
                number.is_some_and(|it| it.parse::<u8>().is_ok())
            };
            for rule in comment
                .split(|c: char| !c.is_alphanumeric())
                .filter(is_rule)
            {
                let functions = kept.entry(rule.to_owned()).or_default();
                let here = format!("`{file}::{function}`");
                if !functions.contains(&here) {
                    functions.push(here);
                }
            }
        }
    }
    kept
}

/// The index of rules has the functions in which their marks stand, everything else that it names is there, and every
/// property is of some rule.
#[test]
fn the_index_of_rules_names_what_there_is() {
    let text = |path: String| std::fs::read_to_string(repository().join(path)).unwrap();
    let (path, page) = read("protocol/doc/protocol.md");
    let missed = ["weakenings", "timed_weakenings"].map(|file| {
        let path = format!("model-check/tests/{file}.rs");
        text(path)
    });
    let kept = kept();
    let (mut rules, mut named, mut indexed) = (0, BTreeSet::new(), String::new());
    for row in page.lines() {
        if !row.starts_with("| R") {
            indexed.push_str(row);
            indexed.push('\n');
            continue;
        }
        let cells: Vec<_> = row.trim_matches('|').split(" | ").map(str::trim).collect();
        let [id, rule, _, properties, weakening, law, script] = cells[..] else {
            panic!("another number of columns: {row}");
        };
        rules += 1;
        assert_eq!(id, format!("R{rules}"));
        let functions = kept.get(id).unwrap_or_else(|| panic!("no mark // {id}"));
        let cells = [
            id,
            rule,
            &functions.join(" "),
            properties,
            weakening,
            law,
            script,
        ];
        let _ = writeln!(indexed, "| {} |", cells.join(" | "));
        for name in quoted(weakening) {
            let is_there = missed.iter().any(|it| it.contains(&format!("fn {name}(")));
            assert!(is_there, "no weakening {name}");
        }
        for name in quoted(law) {
            let (file, function) = name.split_once("::").expect("a file and a law");
            let path = format!("protocol/src/laws/{file}.rs");
            let is_there = text(path.clone()).contains(&format!("fn {function}("));
            assert!(is_there, "no {function} in {path}");
        }
        let [script] = &quoted(script)[..] else {
            panic!("one script: {row}");
        };
        assert!(text(format!("protocol/tests/scripts/{script}")).contains("\n== "));
        named.extend(properties.split(", ").map(str::to_owned));
    }
    assert_eq!(kept.len(), rules, "a mark of no rule: {:?}", kept.keys());
    assert_is(&path, &indexed);
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

/// Whether `cargo test` finds the test that a page tells to run: the package, its target, and a function, module or file
/// of that name.
fn is_test(command: &str) -> bool {
    let words: Vec<_> = command.split_whitespace().skip(2).collect();
    let (package, target, name) = match words[..] {
        ["-p", package, "--test", target] => (package, target, None),
        ["-p", package, "--test", target, name] => (package, target, Some(name)),
        ["-p", package, "--lib", name] => (package, "", Some(name)),
        _ => return false,
    };
    let named = |name: &str| format!("name = \"{name}\"");
    let mut manifests = Vec::new();
    files(&repository(), "toml", &mut manifests);
    manifests.retain(|path| path.ends_with("Cargo.toml"));
    let texts = manifests
        .iter()
        .map(|path| std::fs::read_to_string(path).unwrap());
    let mut both = manifests.iter().zip(texts);
    let Some((manifest, text)) = both.find(|(_, text)| text.contains(&named(package))) else {
        return false;
    };
    let folder = manifest.parent().unwrap();
    let code = folder.join(if target.is_empty() { "src" } else { "tests" });
    let has_target = target.is_empty()
        || text.contains(&named(target))
        || code.join(format!("{target}.rs")).is_file()
        || code.join(target).join("main.rs").is_file();
    let mut sources = Vec::new();
    files(&code, "rs", &mut sources);
    let has = |name: &str| {
        sources.iter().any(|path| {
            path.file_stem().is_some_and(|it| it == name)
                || std::fs::read_to_string(path)
                    .unwrap()
                    .contains(&format!("fn {name}("))
        })
    };
    has_target && name.is_none_or(has)
}

/// A row of the page on the paper has a verdict, what it names is there, and what is not met says why. The line of counts
/// is the sum of the rows.
#[test]
fn the_page_on_the_paper_names_what_there_is_and_counts_its_verdicts() {
    let (_, page) = read("model-check/doc/paper.md");
    let scripts = repository().join("protocol/tests/scripts");
    let mut counts = BTreeMap::from(["met", "partly", "not", "input"].map(|it| (it, 0)));
    let rows = page.lines().filter_map(|line| line.strip_prefix("| "));
    for row in rows.filter(|row| !row.starts_with("paragraph |")) {
        let cells: Vec<_> = row.trim_end_matches(" |").split(" | ").collect();
        let [_, _, verdict, here, see, differs] = cells[..] else {
            panic!("another number of columns: {row}");
        };
        let count = counts.get_mut(verdict);
        *count.unwrap_or_else(|| panic!("no verdict {verdict}: {row}")) += 1;
        assert!(verdict == "met" || differs != "nothing", "no reason: {row}");
        let (here, see) = (quoted(here), quoted(see));
        let is_shown = !here.is_empty() && !see.is_empty();
        assert!(verdict == "not" || is_shown, "nothing to see: {row}");
        for path in here {
            assert!(repository().join(&path).exists(), "no {path}: {row}");
        }
        for seen in see {
            let is_there = seen.starts_with("crossguard ")
                || seen.starts_with("cargo test ") && is_test(&seen)
                || scripts.join(&seen).is_file();
            assert!(is_there, "no {seen}: {row}");
        }
    }
    let [met, partly, not, input] = ["met", "partly", "not", "input"].map(|it| counts[it]);
    let sum = met + partly + not + input;
    let line =
        format!("**{sum} statements: {met} met, {partly} partly, {not} not, {input} inputs.**");
    assert!(page.contains(&line), "the line of counts is: {line}");
}
