//! The README's list of the functions on the way of a RAM is true: each is in its file, and one before it calls
//! it.

use std::fs;
use std::path::Path;

/// Function and file of each row.
fn rows() -> Vec<(String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let readme = fs::read_to_string(root.join("README.md")).unwrap();
    let rows = readme.lines().filter(|line| line.starts_with("| `"));
    let cells = |row: &str| {
        let function = row.split('`').nth(1).unwrap().to_owned();
        let file = row.split_once("](").unwrap().1.split_once(')').unwrap().0;
        (function, fs::read_to_string(root.join(file)).unwrap())
    };
    rows.map(cells).collect()
}

/// The text of a function: of the first of its name in an `impl` of its type, if it has one.
fn body<'a>(file: &'a str, function: &str) -> &'a str {
    let (of_type, name) = match function.split_once("::") {
        Some((of_type, name)) => (Some(of_type), name),
        None => (None, function),
    };
    let start = of_type.map_or(0, |of_type| {
        let is_impl = |line: &str| line.starts_with("impl") && line.contains(of_type);
        let mut offset = 0;
        let found = file.split_inclusive('\n').find(|line| {
            offset += line.len();
            is_impl(line)
        });
        assert!(found.is_some(), "no impl of {of_type}");
        offset
    });
    let rest = &file[start..];
    let at = [format!("fn {name}("), format!("fn {name}<")].map(|it| rest.find(&it));
    let at = at.into_iter().flatten().min();
    let rest = &rest[at.unwrap_or_else(|| panic!("no function {function}"))..];
    let indent = if of_type.is_some() {
        "\n    }\n"
    } else {
        "\n}\n"
    };
    &rest[..rest.find(indent).expect("the end of the function")]
}

#[test]
fn every_function_on_the_way_exists_and_is_called_by_one_before_it() {
    let rows = rows();
    assert_eq!(rows.len(), 19, "a row is not read");
    let mut before = String::new();
    for (i, (function, file)) in rows.iter().enumerate() {
        let body = body(file, function);
        let name = function.rsplit("::").next().unwrap();
        if i > 0 && i + 1 < rows.len() {
            let is_called = [".", "::", " "]
                .iter()
                .any(|dot| before.contains(&format!("{dot}{name}(")));
            assert!(is_called, "nothing before it calls {function}");
        }
        before.push_str(body);
    }
}
