//! `crossguard new`: a folder with a corner to begin with, made of the kit's own examples.

use std::fs;
use std::path::{Path, PathBuf};

use crossguard_robot::plan_file;
use crossguard_robot::site_file::STREET;

use super::{Failure, print};

#[derive(clap::Args)]
pub(super) struct Arguments {
    /// The folder, which is made. Its last part is the name of the site.
    name: PathBuf,
}

const SITE: &str = "\
# The corner, in metres east and north of an origin that all robots here share. Change origin, kerbs, lanes and places to
# yours, and look whether the plan still fits: crossguard site check --site site.toml --plan plan.toml
# Or move them on the street in a browser: crossguard studio --site site.toml --plan plan.toml
";
const PLAN: &str = "\
# Who does what here. Change robot and station of each role to those of your robot files, and the stages to what your
# robots can do; 'to' and 'stands' are places of site.toml.
";
const LEADER: &str = "\
# The robot that leads. Change name, station, build and place to yours, the address of [link] to this robot's, and its
# peers to those of all others. Sensors take the place of people.jsonl, a line for each frame (crossguard run --help).
# Each robot runs on its own machine: crossguard run --config ARI.toml --perceived people.jsonl
";
const FOLLOWER: &str = "\
# A robot that helps. Change the same as in ARI.toml, and nothing else.
";

/// The files: name, what to change in them, and the example that they are copies of.
const FILES: [(&str, &str, &str); 5] = [
    ("site.toml", SITE, STREET),
    ("plan.toml", PLAN, plan_file::SHIPPED[0].1),
    ("ARI.toml", LEADER, include_str!("../../examples/kerb.toml")),
    (
        "Go2.toml",
        FOLLOWER,
        include_str!("../../examples/go2.toml"),
    ),
    (
        "people.jsonl",
        "",
        include_str!("../../examples/people.jsonl"),
    ),
];

/// Texts of the examples, and their replacements.
const CHANGES: [(&str, &str); 4] = [
    (
        "[link]\n",
        "[operator] # programs command it there, and the studio's page Live\nlisten = \"unix:NAME-operator.sock\"\n\n[link]\n",
    ),
    ("autopilot = true\n", "plan_file = \"plan.toml\"\n"),
    (
        "speed = 3.0\n",
        "speed = 3.0 # its simulated body is so much faster than a real one; see [body] for yours\nsite_file = \"site.toml\"\n",
    ),
    ("any = true # in a demonstration it is this one\n", ""),
];

/// An example without its first comment, which says how to start it where it is.
fn adapted(file: &str, example: &str, name: &str) -> String {
    let lines = example.split_inclusive('\n');
    let text: String = lines.skip_while(|line| line.starts_with('#')).collect();
    let text = CHANGES
        .iter()
        .fold(text, |text, (from, to)| text.replace(from, to));
    let robot = file.trim_end_matches(".toml");
    text.replace("unix:NAME", &format!("unix:{robot}"))
        .replace("name = \"street\"", &format!("name = {name:?}"))
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let folder = &arguments.name;
    let name = folder.file_name().unwrap_or_default().to_string_lossy();
    fs::create_dir(folder).map_err(Failure::at(folder))?;
    for (file, what_to_change, example) in FILES {
        let path = folder.join(file);
        let text = what_to_change.to_owned() + &adapted(file, example, &name);
        fs::write(&path, text).map_err(Failure::at(&path))?;
    }
    print(next(folder))
}

fn next(folder: &Path) -> String {
    let at = folder.display();
    format!(
        "{at} has a site, a plan, two robots with simulated bodies, people who come to the kerb, and a car. They run as they are:\n\
         \x20 crossguard run --all {at}\n\
         Then change the files, each of which begins with what to change, and look whether they fit:\n\
         \x20 crossguard site check --site {at}/site.toml --plan {at}/plan.toml\n\
         Or move kerbs, lanes and places on the street in a browser, which checks the same and saves:\n\
         \x20 crossguard studio --site {at}/site.toml --plan {at}/plan.toml"
    )
}
