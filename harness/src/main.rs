//! The `crossguard` command.

use git_version::git_version;

/// The version and the commit; without git, as in a package, the version alone. It stands here and not in the library, so
/// that a new commit compiles this file alone.
const VERSION: &str = git_version!(
    args = ["--always", "--exclude=*", "--dirty"],
    prefix = concat!(env!("CARGO_PKG_VERSION"), " ("),
    suffix = ")",
    fallback = env!("CARGO_PKG_VERSION")
);

fn main() -> std::process::ExitCode {
    crossguard_harness::cli::main(VERSION)
}
