//! Where cargo puts what it builds: the test that runs is in `deps` of that folder.

use std::path::PathBuf;

/// The folder of the programs that cargo has built with this test, as in `target/debug`.
pub(crate) fn programs() -> PathBuf {
    let mut folder = libraries();
    assert!(folder.pop(), "the test is in a folder of its own");
    folder
}

/// The folder of this test and of the libraries that it needs, as in `target/debug/deps`.
pub(crate) fn libraries() -> PathBuf {
    let mut folder = std::env::current_exe().expect("the test is a file");
    assert!(folder.pop(), "the test is in a folder");
    folder
}
