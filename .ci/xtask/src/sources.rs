//! The modules of the workspace's crates, as the compiler finds them, without tests.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use cargo_metadata::MetadataCommand;
use syn::{Attribute, Item, Meta};

use crate::error::Error;
use crate::tokens;

/// A crate of the workspace: its library and its programs.
pub(crate) struct Package {
    pub(crate) name: String,
    pub(crate) targets: Vec<Target>,
}

/// A library or a program: a tree of modules. The first module is the root.
pub(crate) struct Target {
    pub(crate) modules: Vec<Module>,
}

pub(crate) type ModuleId = usize;

pub(crate) struct Module {
    /// From the root, which has none.
    pub(crate) path: Vec<String>,
    pub(crate) file: PathBuf,
    pub(crate) parent: Option<ModuleId>,
    pub(crate) children: BTreeMap<String, ModuleId>,
    /// Its items but for tests and modules.
    pub(crate) items: Vec<Item>,
}

impl Package {
    /// Reads the named crates of the workspace; all of them when none is named.
    pub(crate) fn of_workspace(root: &Path, names: &[String]) -> Result<Vec<Self>, Error> {
        let mut command = MetadataCommand::new();
        let metadata = command.current_dir(root).no_deps().exec()?;
        let is_there = |name: &&String| !metadata.packages.iter().any(|it| it.name == **name);
        if let Some(name) = names.iter().find(is_there) {
            return Err(Error::NoPackage(name.clone()));
        }
        let is_wanted = |name: &str| names.is_empty() || names.iter().any(|wanted| wanted == name);
        let packages = metadata.packages.iter();
        let packages = packages.filter(|package| is_wanted(&package.name));
        packages.map(Self::read).collect()
    }

    /// Reads the targets below `src`.
    fn read(package: &cargo_metadata::Package) -> Result<Self, Error> {
        let source = package.manifest_path.with_file_name("src");
        let paths = package.targets.iter().map(|target| &target.src_path);
        let paths = paths.filter(|path| path.starts_with(&source));
        let targets = paths.map(|path| Target::read(path.as_std_path()));
        Ok(Self {
            name: package.name.to_string(),
            targets: targets.collect::<Result<_, _>>()?,
        })
    }
}

impl Target {
    /// Reads the file of the root and all files of its modules.
    pub(crate) fn read(root: &Path) -> Result<Self, Error> {
        let mut target = Self {
            modules: Vec::new(),
        };
        let folder = root.parent().unwrap_or(root);
        let items = parse(root)?;
        target.add(&[], root, folder, None, items)?;
        Ok(target)
    }

    /// Adds a module whose children are in the folder, and its children.
    fn add(
        &mut self,
        path: &[String],
        file: &Path,
        folder: &Path,
        parent: Option<ModuleId>,
        items: Vec<Item>,
    ) -> Result<ModuleId, Error> {
        let id = self.modules.len();
        self.modules.push(Module {
            path: path.to_vec(),
            file: file.to_owned(),
            parent,
            children: BTreeMap::new(),
            items: Vec::new(),
        });
        for item in items {
            if is_test(attributes(&item)) {
                continue;
            }
            let Item::Mod(child) = item else {
                self.modules[id].items.push(item);
                continue;
            };
            let name = tokens::name(&child.ident);
            let path = [path, std::slice::from_ref(&name)].concat();
            let inside = folder.join(&name);
            let child = if let Some((_, items)) = child.content {
                self.add(&path, file, &inside, Some(id), items)?
            } else {
                let file = file_of(&name, file, folder)?;
                let items = parse(&file)?;
                self.add(&path, &file, &inside, Some(id), items)?
            };
            self.modules[id].children.insert(name, child);
        }
        Ok(id)
    }
}

/// The file of a module that is declared without a body.
fn file_of(name: &str, parent: &Path, folder: &Path) -> Result<PathBuf, Error> {
    let plain = folder.join(format!("{name}.rs"));
    let nested = folder.join(name).join("mod.rs");
    [plain, nested]
        .into_iter()
        .find(|path| path.is_file())
        .ok_or_else(|| Error::NoModule {
            path: parent.to_owned(),
            module: name.to_owned(),
        })
}

fn parse(path: &Path) -> Result<Vec<Item>, Error> {
    let text = fs::read_to_string(path).map_err(|cause| Error::Io {
        path: path.to_owned(),
        cause,
    })?;
    let file = syn::parse_file(&text).map_err(|cause| Error::Syntax {
        path: path.to_owned(),
        cause,
    })?;
    Ok(if is_test(&file.attrs) {
        Vec::new()
    } else {
        file.items
    })
}

/// Whether an item is compiled for tests alone: `cfg(test)`, or `cfg(all(test, …))`.
pub(crate) fn is_test(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        if attribute.path().is_ident("test") {
            return true;
        }
        attribute.path().is_ident("cfg")
            && attribute
                .parse_args::<Meta>()
                .is_ok_and(|meta| needs_test(&meta))
    })
}

fn needs_test(meta: &Meta) -> bool {
    use syn::Token;
    use syn::punctuated::Punctuated;
    match meta {
        Meta::Path(path) => path.is_ident("test"),
        Meta::List(list) if list.path.is_ident("all") => list
            .parse_args_with(Punctuated::<Meta, Token![,]>::parse_terminated)
            .is_ok_and(|all| all.iter().any(needs_test)),
        _ => false,
    }
}

/// The attributes of an item.
pub(crate) fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(it) => &it.attrs,
        Item::Enum(it) => &it.attrs,
        Item::ExternCrate(it) => &it.attrs,
        Item::Fn(it) => &it.attrs,
        Item::ForeignMod(it) => &it.attrs,
        Item::Impl(it) => &it.attrs,
        Item::Macro(it) => &it.attrs,
        Item::Mod(it) => &it.attrs,
        Item::Static(it) => &it.attrs,
        Item::Struct(it) => &it.attrs,
        Item::Trait(it) => &it.attrs,
        Item::TraitAlias(it) => &it.attrs,
        Item::Type(it) => &it.attrs,
        Item::Union(it) => &it.attrs,
        Item::Use(it) => &it.attrs,
        _ => &[],
    }
}
