//! Circles of imports between the files of a crate.
//!
//! An arrow goes from a file to each file of the same crate that declares an item which it names: in
//! a `use`, in code, in the tokens of a macro, or in the text of an attribute. Re-exports are
//! followed to the declaration. Methods are not seen, since their types are not known here. A module
//! and its descendants may name each other.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use petgraph::algo::tarjan_scc;
use petgraph::graphmap::DiGraphMap;
use syn::visit::{self, Visit};
use syn::{Attribute, ImplItem, Item, ItemUse, Macro, Meta, Stmt};

use crate::resolve::{Meaning, Names};
use crate::sources::{ModuleId, Package, Target, attributes, is_test};
use crate::tokens::{self, Named};

/// The arrows between files, each with the first place that makes it.
type Arrows = BTreeMap<(PathBuf, PathBuf), (usize, String)>;

/// Every circle as a readable list, with paths from the root of the workspace.
pub(crate) fn circles(root: &Path, packages: &[Package]) -> Vec<String> {
    let targets = packages
        .iter()
        .flat_map(|package| package.targets.iter().map(|it| (&package.name, it)));
    let mut found = Vec::new();
    for (name, target) in targets {
        let arrows = arrows(target);
        for circle in strongly_connected(&arrows) {
            found.push(describe(root, name, &circle, &arrows));
        }
    }
    found
}

/// Files that can all be reached from each other.
fn strongly_connected(arrows: &Arrows) -> Vec<Vec<&PathBuf>> {
    let graph: DiGraphMap<&PathBuf, ()> = arrows.keys().map(|(from, to)| (from, to)).collect();
    let mut circles = tarjan_scc(&graph);
    circles.retain(|circle| circle.len() > 1);
    for circle in &mut circles {
        circle.sort();
    }
    circles.sort();
    circles
}

fn describe(root: &Path, package: &str, circle: &[&PathBuf], arrows: &Arrows) -> String {
    let short = |path: &PathBuf| {
        let short = path.strip_prefix(root).unwrap_or(path);
        short.display().to_string()
    };
    let mut text = format!("{package}: a circle of {} files", circle.len());
    for ((from, to), (line, path)) in arrows {
        if circle.contains(&from) && circle.contains(&to) {
            let (from, to) = (short(from), short(to));
            write!(text, "\n    {from}:{line} names {path} of {to}").expect("a string grows");
        }
    }
    text
}

/// The arrows of a library or program.
fn arrows(target: &Target) -> Arrows {
    let names = Names::of(target);
    let mut arrows = Arrows::new();
    for id in 0..target.modules.len() {
        let mut reader = Reader {
            target,
            names: &names,
            module: id,
            arrows: &mut arrows,
        };
        for item in &target.modules[id].items {
            reader.visit_item(item);
        }
    }
    arrows
}

/// Reads the items of a module.
struct Reader<'a> {
    target: &'a Target,
    names: &'a Names<'a>,
    module: ModuleId,
    arrows: &'a mut Arrows,
}

impl Reader<'_> {
    fn name(&mut self, named: &Named) {
        for meaning in self.names.resolve(self.module, &named.segments) {
            if let Meaning::Item(declaring) = meaning {
                self.arrow(declaring, named);
            }
        }
    }

    fn arrow(&mut self, declaring: ModuleId, named: &Named) {
        let modules = &self.target.modules;
        let (from, to) = (&modules[self.module].file, &modules[declaring].file);
        if from == to || self.is_family(declaring) {
            return;
        }
        let example = (named.at.line, named.segments.join("::"));
        let known = self.arrows.entry((from.clone(), to.clone()));
        known.or_insert(example);
    }

    /// Whether the file of one of the two modules holds an ancestor of the other.
    fn is_family(&self, other: ModuleId) -> bool {
        let (one, other) = (self.of_file(self.module), self.of_file(other));
        one.starts_with(other) || other.starts_with(one)
    }

    /// The path of the outermost module in the file of a module.
    fn of_file(&self, module: ModuleId) -> &[String] {
        let modules = &self.target.modules;
        let mut outermost = module;
        while let Some(parent) = modules[outermost].parent
            && modules[parent].file == modules[module].file
        {
            outermost = parent;
        }
        &modules[outermost].path
    }
}

impl<'ast> Visit<'ast> for Reader<'_> {
    fn visit_item(&mut self, item: &'ast Item) {
        if !is_test(attributes(item)) {
            visit::visit_item(self, item);
        }
    }

    fn visit_impl_item(&mut self, item: &'ast ImplItem) {
        let attributes: &[Attribute] = match item {
            ImplItem::Const(it) => &it.attrs,
            ImplItem::Fn(it) => &it.attrs,
            ImplItem::Type(it) => &it.attrs,
            ImplItem::Macro(it) => &it.attrs,
            _ => &[],
        };
        if !is_test(attributes) {
            visit::visit_impl_item(self, item);
        }
    }

    fn visit_stmt(&mut self, statement: &'ast Stmt) {
        if !matches!(statement, Stmt::Local(it) if is_test(&it.attrs)) {
            visit::visit_stmt(self, statement);
        }
    }

    fn visit_item_use(&mut self, item: &'ast ItemUse) {
        if item.leading_colon.is_none() {
            for import in tokens::imports(&item.tree) {
                self.name(&import.path);
            }
        }
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        if let Some(named) = tokens::path(path) {
            self.name(&named);
        }
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, it: &'ast Macro) {
        for named in tokens::in_tokens(&it.tokens) {
            self.name(&named);
        }
        visit::visit_macro(self, it);
    }

    fn visit_attribute(&mut self, attribute: &'ast Attribute) {
        if let Meta::List(list) = &attribute.meta {
            for named in tokens::in_strings(&list.tokens) {
                self.name(&named);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use tempfile::TempDir;

    use super::*;

    /// The circles of a library with these files, each as `one two`.
    fn circles_of(files: &[(&str, &str)]) -> Vec<String> {
        let folder = TempDir::new().unwrap();
        for (name, text) in files {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        let target = Target::read(&folder.path().join("lib.rs")).unwrap();
        let arrows = arrows(&target);
        let circles = strongly_connected(&arrows);
        let short = |path: &PathBuf| {
            let short = path.strip_prefix(folder.path()).unwrap();
            short.with_extension("").display().to_string()
        };
        let names = circles
            .iter()
            .map(|circle| circle.iter().map(|path| short(path)).collect::<Vec<_>>());
        names.map(|names| names.join(" ")).collect()
    }

    const ROOT: (&str, &str) = ("lib.rs", "mod one; mod two; pub use one::One;");

    #[test]
    fn two_files_that_use_each_other_are_a_circle() {
        let files = [
            ROOT,
            ("one.rs", "use crate::two::Two; pub struct One(Two);"),
            ("two.rs", "use super::one::One; pub struct Two(One);"),
        ];
        assert_eq!(circles_of(&files), ["one two"]);
    }

    #[test]
    fn re_exports_are_followed_to_the_declaration() {
        let files = [
            ROOT,
            ("one.rs", "pub struct One(crate::two::Two);"),
            ("two.rs", "pub struct Two(crate::One);"),
        ];
        assert_eq!(circles_of(&files), ["one two"]);
        let files = [
            ROOT,
            ("one.rs", "pub struct One(crate::two::Two);"),
            ("two.rs", "use crate::*; pub struct Two(One);"),
        ];
        assert_eq!(circles_of(&files), ["one two"]);
        let files = [
            ROOT,
            ("one.rs", "use crate::two; pub struct One(two::Alias);"),
            ("two.rs", "mod deep; pub use deep::Two as Alias;"),
            ("two/deep.rs", "use crate::One; pub struct Two(One);"),
        ];
        assert_eq!(circles_of(&files), ["one two/deep"]);
    }

    #[test]
    fn macros_and_attributes_name_items_too() {
        let files = [
            ROOT,
            (
                "one.rs",
                "pub fn One() { println!(\"{}\", crate::two::TWO); }",
            ),
            (
                "two.rs",
                "#[serde(with = \"crate::One\")] pub const TWO: u8 = 2;",
            ),
        ];
        assert_eq!(circles_of(&files), ["one two"]);
    }

    #[test]
    fn a_module_and_its_descendants_may_name_each_other() {
        let files = [
            ("lib.rs", "mod one; pub struct Root(one::One);"),
            ("one.rs", "mod inner; pub struct One(inner::Inner);"),
            ("one/inner.rs", "mod deep; pub struct Inner(super::One);"),
            (
                "one/inner/deep.rs",
                "pub struct Deep(crate::one::One, crate::Root);",
            ),
        ];
        assert!(circles_of(&files).is_empty());
    }

    #[test]
    fn tests_do_not_count() {
        let files = [
            ROOT,
            ("one.rs", "pub struct One(crate::two::Two);"),
            (
                "two.rs",
                "pub struct Two; #[cfg(test)] mod tests { use crate::One; }
                 impl Two { #[cfg(all(test, unix))] fn one() -> crate::One { crate::One() } }",
            ),
        ];
        assert!(circles_of(&files).is_empty());
    }
}
