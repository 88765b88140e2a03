//! What commands say, in the pages `tests/cmd/*.md`. `cargo xtask bless` writes what they say now.

use std::collections::BTreeSet;
use std::path::Path;

/// The files that the commands find.
fn files() -> BTreeSet<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cmd/refused.in");
    let names = folder.read_dir().unwrap().map(|it| it.unwrap().file_name());
    let names = names.filter(|it| Path::new(it).extension().is_none_or(|it| it != "lock"));
    names.map(|it| it.to_string_lossy().into_owned()).collect()
}

#[test]
fn commands_say_what_their_pages_show_and_leave_nothing_behind() {
    crossguard_harness::cli::command().debug_assert();
    let before = files();
    let cases = trycmd::TestCases::new();
    cases.case("tests/cmd/*.md").env("COLUMNS", "120");
    cases.run();
    assert_eq!(files(), before);
}
