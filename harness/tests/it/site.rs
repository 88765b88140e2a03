//! The studio's page of a site file: which changes it writes, and which it refuses.

use std::fs;
use std::os::unix::fs::PermissionsExt as _;
use std::path::Path;
use std::process::Command;

use crossguard_testkit::command::*;
use serde_json::{Value, json};

use crate::studio::{Studio, is_refused, parts};

/// Points, the code of the answer, and what is said of them. Nothing of it is written.
const REFUSED: &str = r#"
{"place near-kerb": [1.0, 1.0]} | 200 | site.toml:36: place 'near-kerb' is on lane 'near': only places to guard may be on one
{"kerb 2 to": [5.0, 3.0]} | 200 | site.toml:11: the two kerbs meet, or will within 10 m beside the crossing
{"lane 1 (near) to": [-20, 1.75]} | 200 | lane 'near' is shorter than a metre
{"place near-kerb": [1.0, 1e30]} | 200 | [1, 1e30] is no place: metres east and north of the origin, at most 1000, are wanted
{"place near-kerb": [-4.0, -0.5], "place near-lane": [-4.0, 0.4]} | 200 | are 0.90 m apart in this stage: at least 1 m is wanted
{"place nowhere": [1.0, 1.0]} | 200 | site.toml: it has no 'place nowhere' that can be moved
{"place near-kerb": [1.0]} | 400 | it is no question
{"place near-kerb": [1.0, NaN]} | 400 | it is no question
{"place near-kerb": ["100 cm", 1.0]} | 400 | it is no question
{"place near-kerb": {"east_cm": 100, "north_cm": 100}} | 400 | it is no question"#;

const MOVED: &str = r#"{"place far-kerb": [1.5, 8.0], "place near-kerb": [-0.5, -1.2], "kerb 1 from": [-3.5, 0.0]}"#;

/// The same in the text.
const WRITTEN: [[&str; 2]; 3] = [
    ["  1, # east", "  1.5, # east"],
    [
        "near-kerb = { at_m = [1.0, -1.0]",
        "near-kerb = { at_m = [-0.5, -1.2]",
    ],
    ["[[[-3.0, 0.0]", "[[[-3.5, 0.0]"],
];

/// Unfit contents of the file, and the error for each.
const UNFIT: [(&[u8], &str); 4] = [
    (b"# \xff", "is no text in UTF-8"),
    (&[b'#'; 1 + (1 << 20)], "longer than"),
    (b"[origin", "site.toml:1: "),
    (b"FIFO", "is a FIFO, not a file"),
];

fn ask(studio: &Studio, head: &str, question: &str) -> (String, String) {
    let length = question.len();
    let rest = format!("Content-Type: {head}\r\nContent-Length: {length}\r\n");
    let own = &*studio.address;
    parts(&studio.send("POST /site/api/moved", own, &rest, question.as_bytes()))
}

/// The text as a city may have it: lines of Windows, comments within a point.
fn odd(site: &str) -> String {
    let point = "\"far-kerb\" = { at_m = [ # from the survey\n  1, # east\n  8.0,\n]";
    let text = site.replace("far-kerb = { at_m = [1.0, 8.0]", point);
    text.replace('\n', "\r\n")
}

/// Has something be in the place of the site file.
fn write(site: &Path, octets: &[u8], mode: u32) {
    let _ = fs::remove_file(site);
    if octets == b"FIFO" {
        let status = Command::new("mkfifo").arg(site).status().unwrap();
        assert!(status.success());
        return;
    }
    fs::write(site, octets).unwrap();
    fs::set_permissions(site, fs::Permissions::from_mode(mode)).unwrap();
}

#[test]
fn a_site_is_written_when_it_fits_and_is_the_one_that_was_read() {
    const TYPED: &str = "application/json";
    let folder = tempfile::tempdir().unwrap();
    let corner = folder.path().join("corner");
    assert_code(&run(&["new", corner.to_str().unwrap()]), 0);
    let [link, site, plan] =
        ["site.toml", "of-the-city.toml", "plan.toml"].map(|it| corner.join(it));
    let text = odd(&fs::read_to_string(&link).unwrap());
    let there = || fs::read_to_string(&site).unwrap();
    write(&site, text.as_bytes(), 0o600);
    fs::remove_file(&link).unwrap();
    std::os::unix::fs::symlink("of-the-city.toml", &link).unwrap();
    let studio = Studio::of(&[Path::new("--site"), &link, Path::new("--plan"), &plan]);
    let open = || parts(&studio.ask("GET /site/api/opening", &studio.address, ""));
    let opening: Value = serde_json::from_str(&open().1).unwrap();
    let points = opening["points"].as_array().unwrap();
    let far_kerb = json!(["place far-kerb", [1.0, 8.0]]);
    assert!(
        points.len() == 17 && points.contains(&far_kerb),
        "{opening}"
    );
    let version = &opening["version"];
    let question = |moved: &str, save: bool| {
        format!("{{\"version\": {version}, \"moved\": {moved}, \"save\": {save}}}")
    };

    for row in REFUSED.trim().lines() {
        let [moved, code, said] = row.split(" | ").collect::<Vec<_>>().try_into().unwrap();
        let answer = ask(&studio, TYPED, &question(moved, true));
        is_refused(&answer, code, said);
        let fits = answer.1.contains("\"fits\":false");
        assert!(code == "400" || fits, "{answer:?}");
    }
    let evil = "application/json\r\nOrigin: http://evil.example";
    for (head, cause) in [
        ("text/plain", "application/json is wanted"),
        (evil, "another origin"),
    ] {
        is_refused(&ask(&studio, head, &question(MOVED, true)), "403", cause);
    }
    let (_, said) = ask(&studio, TYPED, &question(MOVED, false));
    said.must_have(&[
        "\"fits\":true",
        "plan plan: 2 roles, 2 stages; it fits",
        "\"saved\":null",
    ]);
    assert_eq!(there(), text);

    let (_, said) = ask(&studio, TYPED, &question(MOVED, true));
    said.must_have(&["\"fits\":true", "\"saved\":\""]);
    let wanted = WRITTEN.iter().fold(text.clone(), |text, [from, to]| {
        assert_eq!(text.matches(from).count(), 1, "{from}");
        text.replace(from, to)
    });
    assert_eq!(there(), wanted);
    assert!(link.is_symlink());
    let mode = fs::metadata(&site).unwrap().permissions().mode();
    assert_eq!(mode & 0o777, 0o600);
    // The page that has shown the file before writes nothing over it.
    let answer = ask(&studio, TYPED, &question("{}", true));
    is_refused(&answer, "400", "has changed since");
    assert_eq!(there(), wanted);
    write(&site, text.as_bytes(), 0o400);
    let answer = ask(&studio, TYPED, &question(MOVED, true));
    is_refused(&answer, "400", "is read-only");
    let reached = ["--address", "0.0.0.0", "--site"].map(Path::new);
    let reached = Studio::of(&[&reached[..], &[&link]].concat());
    let answer = ask(&reached, TYPED, &question(MOVED, true));
    is_refused(&answer, "400", "without --address");
    for (unfit, cause) in UNFIT {
        write(&site, unfit, 0o600);
        is_refused(&open(), "400", cause);
        let answer = ask(&studio, TYPED, &question("{}", true));
        is_refused(&answer, "400", cause);
    }
}
