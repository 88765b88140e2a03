//! Writes the man pages and completions of the command, from its one definition: `pages FOLDER`. The folder is laid out like
//! `/usr/local`. `.ci/dist` packs it.

use std::fs::create_dir_all;
use std::path::PathBuf;

use clap::Parser;
use clap_complete::Shell;

#[derive(Parser)]
struct Arguments {
    folder: PathBuf,
}

fn main() -> std::io::Result<()> {
    let share = Arguments::parse().folder.join("share");
    let mut command = crossguard_harness::cli::command();
    let man = share.join("man/man1");
    create_dir_all(&man)?;
    clap_mangen::generate_to(command.clone(), man)?;
    for (shell, place) in [
        (Shell::Bash, "bash-completion/completions"),
        (Shell::Fish, "fish/vendor_completions.d"),
        (Shell::Zsh, "zsh/site-functions"),
    ] {
        let place = share.join(place);
        create_dir_all(&place)?;
        clap_complete::generate_to(shell, &mut command, "crossguard", place)?;
    }
    Ok(())
}
