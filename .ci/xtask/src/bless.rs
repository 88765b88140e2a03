//! Files that are generated or golden, and what writes them.
//!
//! A test compares each with what it should be. With `CROSSGUARD_BLESS=1` in its environment, the
//! test writes the file instead.

use std::path::Path;

use crate::steps::{NotStarted, Step, run};

/// A file, a folder, or a part of a file, and the command that writes it.
struct Generated {
    path: &'static str,
    by: &'static str,
}

/// Sources first: what follows from other files comes after them.
const GENERATED: [Generated; 14] = [
    Generated {
        path: "protocol/src: words and named tasks, in other languages",
        by: "cargo test -p crossguard-protocol --test languages",
    },
    Generated {
        path: "protocol/words.md",
        by: "cargo test -p crossguard-protocol --test words",
    },
    Generated {
        path: "protocol/tests/scripts/",
        by: "cargo test -p crossguard-protocol --test it interpreter",
    },
    Generated {
        path: "codec/src/asn1/generated.rs",
        by: "cargo test -p crossguard-codec --test it generated",
    },
    Generated {
        path: "codec/tests/golden/messages.json",
        by: "cargo test -p crossguard-codec --test it golden_messages",
    },
    Generated {
        path: "codec/tests/golden/security.json",
        by: "cargo test -p crossguard-codec --features security --test it security::vectors",
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
        path: "model-check/doc/paper-literal.md",
        by: "cargo test -p crossguard-model-check --test it paper_literal::",
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
        path: "protocol/doc/protocol.md: the index of rules",
        by: "cargo test -p crossguard-harness --test it pages::the_index_of_rules",
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

/// A text that the path of a generated file contains.
pub(crate) fn part(text: &str) -> Result<String, String> {
    let paths = GENERATED.map(|it| it.path);
    if paths.iter().any(|it| it.contains(text)) {
        return Ok(text.to_owned());
    }
    let paths = paths.join("\n    ");
    Err(format!(
        "no generated file is named so; there are:\n    {paths}"
    ))
}

/// Writes the files whose names contain the text.
pub(crate) fn bless(root: &Path, part: &str) -> Result<bool, NotStarted> {
    let mut done = Vec::new();
    let mut is_ok = true;
    for generated in GENERATED.iter().filter(|it| it.path.contains(part)) {
        if !done.contains(&generated.by) {
            let step = Step::new(generated.path, generated.by).with("CROSSGUARD_BLESS", "1");
            let step = step.with("TRYCMD", "overwrite");
            is_ok &= run(root, &step)?;
            done.push(generated.by);
        }
    }
    Ok(is_ok)
}
