//! Files that are generated or golden, and what writes them.
//!
//! A test compares each with what it should be. With `CROSSGUARD_BLESS=1` in its environment, the
//! test writes the file instead.

use std::path::Path;

use crate::error::Error;
use crate::steps::{Step, run};

/// A file, a folder, or a part of a file, and the command that writes it.
struct Generated {
    path: &'static str,
    by: &'static str,
}

/// Sources first: what follows from other files comes after them.
const GENERATED: [Generated; 13] = [
    Generated {
        path: "protocol/src/task.rs: the named tasks, in other languages",
        by: "cargo test -p crossguard-testkit --test named_tasks",
    },
    Generated {
        path: "codec/src/asn1/generated.rs",
        by: "cargo test -p crossguard-codec --test generated",
    },
    Generated {
        path: "codec/tests/golden/messages.json",
        by: "cargo test -p crossguard-codec --test golden_messages",
    },
    Generated {
        path: "codec/tests/golden/security.json",
        by: "cargo test -p crossguard-codec --features security --test security vectors",
    },
    Generated {
        path: "codec/wireshark/crossguard.lua: the types",
        by: "codec/judges/run",
    },
    Generated {
        path: "harness/c/include/crossguard.h",
        by: "cargo test -p crossguard-c --test header",
    },
    Generated {
        path: "harness/ros2/dds/crossguard_msgs.idl",
        by: "cargo test -p crossguard-ros2 --test dds_idl",
    },
    Generated {
        path: "model-check/doc/paper-literal.md",
        by: "cargo test -p crossguard-model-check --test paper_literal",
    },
    Generated {
        path: "model-check/stories/",
        by: "cargo test -p crossguard-model-check --test paper_literal",
    },
    Generated {
        path: "harness/conform/src/cases.txt",
        by: "cargo test -p crossguard-conform --test generated",
    },
    Generated {
        path: "protocol/doc/protocol.md: the state diagram",
        by: "cargo test -p crossguard-harness --test it pages::the_state_diagram",
    },
    Generated {
        path: "harness/tests/cmd/",
        by: "cargo test -p crossguard-harness --test it cmd::",
    },
    Generated {
        path: "README.md: the sum of states",
        by: "cargo test -p crossguard-harness --test it pages::the_readmes_sum_of_states",
    },
];

/// Whether no part of the file is written by hand.
pub(crate) fn is_generated(file: &Path) -> bool {
    let mut whole = GENERATED.iter().filter(|it| !it.path.contains(": "));
    whole.any(|it| file.to_string_lossy().starts_with(it.path))
}

/// Writes the files whose names contain the text; all of them without one.
pub(crate) fn bless(root: &Path, part: Option<&str>) -> Result<bool, Error> {
    let is_wanted = |it: &&Generated| part.is_none_or(|part| it.path.contains(part));
    let mut done = Vec::new();
    let mut is_ok = true;
    for generated in GENERATED.iter().filter(is_wanted) {
        if !done.contains(&generated.by) {
            let step = Step::new(generated.path, generated.by).with("CROSSGUARD_BLESS", "1");
            let step = step.with("TRYCMD", "overwrite");
            is_ok &= run(root, &step)?;
            done.push(generated.by);
        }
    }
    if done.is_empty() {
        let paths = GENERATED.map(|it| it.path);
        return Err(Error::NotGenerated(paths.join("\n    ")));
    }
    Ok(is_ok)
}
