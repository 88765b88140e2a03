//! Why a command could not do its work.

use std::io;
use std::path::PathBuf;

#[derive(Debug, thiserror::Error)]
pub(crate) enum Error {
    #[error("cargo metadata: {0}")]
    Metadata(#[from] cargo_metadata::Error),
    #[error("no crate '{0}' in the workspace; `cargo metadata` lists them")]
    NoPackage(String),
    #[error("{}: {cause}", path.display())]
    Io { path: PathBuf, cause: io::Error },
    #[error("{}:{}: {cause}", path.display(), cause.span().start().line)]
    Syntax { path: PathBuf, cause: syn::Error },
    #[error("{}: no file of module '{module}'", path.display())]
    NoModule { path: PathBuf, module: String },
    #[error("{}: {cause}", path.display())]
    Content { path: PathBuf, cause: String },
    #[error("no generated file is named so; there are:\n    {0}")]
    NotGenerated(String),
    #[error("could not start {program}: {cause}")]
    Start { program: String, cause: io::Error },
}
