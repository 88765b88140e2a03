//! The tables of `codec/doc/departures.md` against the vectors and tests that they name.

use std::path::Path;

use super::listed::vectors;

/// All sources below a folder, in one text.
fn sources(folder: &Path) -> String {
    let entries = folder
        .read_dir()
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let text = |path: std::path::PathBuf| {
        if path.is_dir() {
            sources(&path)
        } else {
            std::fs::read_to_string(path).unwrap_or_default()
        }
    };
    entries.map(text).collect()
}

#[test]
fn each_row_is_answered_as_its_vector_or_test_shows() {
    let codec = Path::new(env!("CARGO_MANIFEST_DIR"));
    let code = sources(&codec.join("src")) + &sources(&codec.join("tests"));
    let vectors = vectors().all;
    let mut wrong = Vec::new();
    let mut shown_by_vectors = 0;
    for line in include_str!("../../../doc/departures.md").lines() {
        let cells: Vec<_> = line.split('|').map(str::trim).collect();
        let ["", _, _, answer, _, shown, ""] = cells[..] else {
            continue;
        };
        if ["answer", "---"].contains(&answer) {
            continue;
        }
        if let Some(test) = shown.strip_prefix('`') {
            let test = format!("#[test]\nfn {}()", test.trim_end_matches('`'));
            let is_there = code.replace("    ", "").contains(&test);
            wrong.extend((!is_there).then(|| format!("{line}: no such test")));
            continue;
        }
        let Some(vector) = vectors.iter().find(|vector| vector.name == shown) else {
            wrong.push(format!("{line}: no such vector"));
            continue;
        };
        shown_by_vectors += 1;
        let refused = vector.heard.last().and_then(|heard| heard.refused);
        let expected = refused.map_or_else(|| "taken".to_owned(), |cause| format!("`{cause}`"));
        wrong.extend((answer != expected).then(|| format!("{line}: it is {expected}")));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(shown_by_vectors > 70, "{shown_by_vectors}");
}
