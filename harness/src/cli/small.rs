//! Commands that a small build does not have: it builds the rest, where cargo started it.

use std::env::{args_os, var_os};
use std::os::unix::process::CommandExt;
use std::path::Path;
use std::process::Command;

use crossguard_protocol::Config;
use crossguard_robot::site_file::SiteFile;

use super::{Failure, complain};

/// No page is written here: a user who asks for one gets [all of the command](build_all).
#[expect(clippy::unnecessary_wraps, reason = "as in a full build")]
pub(super) fn write_page(_: &Path, _: &SiteFile, _: &[u8], _: bool) -> Result<(), Failure> {
    Ok(())
}

/// Robot files are read by all of the command.
pub(super) fn read_config(_: &Path) -> Result<Config, Failure> {
    Err(build_all())
}

/// Starts the same command with all that it has, and returns only when that is impossible.
pub(super) fn build_all() -> Failure {
    let (Some(cargo), Some(folder)) = (var_os("CARGO"), var_os("CARGO_MANIFEST_DIR")) else {
        return Failure::input(
            "this is a small build, which has the demonstration and the checker alone; build all of it by: \
             cargo build --release --features full",
        );
    };
    complain(
        "this needs a full build, --features full: cargo makes it now, in about five minutes, unless it is there",
    );
    let mut all = Command::new(cargo);
    all.args(["run", "--features", "full"]);
    if !cfg!(debug_assertions) {
        all.arg("--release");
    }
    let manifest = Path::new(&folder).join("Cargo.toml");
    all.arg("--manifest-path").arg(manifest).arg("--");
    Failure::input(all.args(args_os().skip(1)).exec())
}
