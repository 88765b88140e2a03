//! Where the names of a crate are declared: its `use`s followed to their ends.

use std::collections::{HashMap, HashSet};

use syn::Item;

use crate::sources::{ModuleId, Target};
use crate::tokens::{self, Brings};

/// What a path of the crate names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Meaning {
    Module(ModuleId),
    /// An item of this module.
    Item(ModuleId),
}

enum Binding {
    Meaning(Meaning),
    Import(Vec<String>),
}

#[derive(Default)]
struct Scope {
    names: HashMap<String, Vec<Binding>>,
    globs: Vec<Vec<String>>,
}

/// The names of all modules of a library or program.
pub(crate) struct Names<'a> {
    target: &'a Target,
    scopes: Vec<Scope>,
}

/// The lookups under way, since `use`s may go in circles.
type UnderWay = HashSet<(ModuleId, String)>;

impl<'a> Names<'a> {
    pub(crate) fn of(target: &'a Target) -> Self {
        let mut scopes: Vec<Scope> = Vec::new();
        scopes.resize_with(target.modules.len(), Scope::default);
        for (id, module) in target.modules.iter().enumerate() {
            for (name, child) in &module.children {
                bind(&mut scopes[id], name, Meaning::Module(*child));
            }
            for item in &module.items {
                if let Item::Use(item) = item {
                    import(&mut scopes[id], item);
                } else if let Some(name) = declared(item) {
                    let is_exported = matches!(item, Item::Macro(_));
                    let scope = if is_exported { 0 } else { id };
                    bind(&mut scopes[scope], &name, Meaning::Item(id));
                    if scope != id {
                        bind(&mut scopes[id], &name, Meaning::Item(id));
                    }
                }
            }
        }
        Self { target, scopes }
    }

    /// What a path means in a module; nothing when it leads out of the crate.
    pub(crate) fn resolve(&self, module: ModuleId, path: &[String]) -> Vec<Meaning> {
        self.follow(module, path, &mut UnderWay::new())
    }

    fn follow(&self, module: ModuleId, path: &[String], under_way: &mut UnderWay) -> Vec<Meaning> {
        let Some((first, rest)) = path.split_first() else {
            return Vec::new();
        };
        let mut meanings = match first.as_str() {
            "crate" => vec![Meaning::Module(0)],
            "self" => vec![Meaning::Module(module)],
            "super" => self.parent(module),
            name => self.lookup(module, name, under_way),
        };
        for segment in rest {
            let next = meanings.iter().flat_map(|meaning| match *meaning {
                Meaning::Module(module) if segment == "super" => self.parent(module),
                Meaning::Module(module) => self.lookup(module, segment, under_way),
                // A variant, a method or an associated item.
                item @ Meaning::Item(_) => vec![item],
            });
            meanings = next.collect();
        }
        meanings
    }

    fn parent(&self, module: ModuleId) -> Vec<Meaning> {
        let parent = self.target.modules[module].parent;
        parent.map(Meaning::Module).into_iter().collect()
    }

    fn lookup(&self, module: ModuleId, name: &str, under_way: &mut UnderWay) -> Vec<Meaning> {
        if !under_way.insert((module, name.to_owned())) {
            return Vec::new();
        }
        let scope = &self.scopes[module];
        let mut found = Vec::new();
        if let Some(bindings) = scope.names.get(name) {
            for binding in bindings {
                match binding {
                    Binding::Meaning(meaning) => found.push(*meaning),
                    Binding::Import(path) => found.extend(self.follow(module, path, under_way)),
                }
            }
        } else {
            for glob in &scope.globs {
                for meaning in self.follow(module, glob, under_way) {
                    if let Meaning::Module(all) = meaning {
                        found.extend(self.lookup(all, name, under_way));
                    }
                }
            }
        }
        under_way.remove(&(module, name.to_owned()));
        found
    }
}

fn bind(scope: &mut Scope, name: &str, meaning: Meaning) {
    let bindings = scope.names.entry(name.to_owned()).or_default();
    bindings.push(Binding::Meaning(meaning));
}

fn import(scope: &mut Scope, item: &syn::ItemUse) {
    if item.leading_colon.is_some() {
        return;
    }
    for import in tokens::imports(&item.tree) {
        let path = import.path.segments;
        match import.brings {
            // `use serde;` beside a name of its own would otherwise lead to itself.
            Brings::Name(name) if path == [name.as_str()] => {}
            Brings::Name(name) => {
                let bindings = scope.names.entry(name).or_default();
                bindings.push(Binding::Import(path));
            }
            Brings::All => scope.globs.push(path),
            Brings::Traits => {}
        }
    }
}

/// The name that an item declares.
fn declared(item: &Item) -> Option<String> {
    let ident = match item {
        Item::Const(it) => &it.ident,
        Item::Enum(it) => &it.ident,
        Item::Fn(it) => &it.sig.ident,
        Item::Macro(it) => it.ident.as_ref()?,
        Item::Static(it) => &it.ident,
        Item::Struct(it) => &it.ident,
        Item::Trait(it) => &it.ident,
        Item::TraitAlias(it) => &it.ident,
        Item::Type(it) => &it.ident,
        Item::Union(it) => &it.ident,
        _ => return None,
    };
    Some(tokens::name(ident))
}
