//! Live: a demonstration while it goes on, robots that fall silent, and logs that are cut, replaced or not to be trusted.

use std::fs::OpenOptions;
use std::io::Write;
use std::path::Path;
use std::process::Stdio;

use crossguard_testkit::command::*;
use serde_json::json;

use crate::logs::{crowd, write};
use crate::page::{Studio, assert_accessible, assert_clean, assert_fits, browser, reached_by_tab};

const CHIP: &str = "document.getElementById('chip').textContent";

fn follow(log: &Path) -> Studio {
    let studio = Studio::with(&[
        "--follow".as_ref(),
        "--site".as_ref(),
        "street".as_ref(),
        log.as_os_str(),
    ]);
    assert!(studio.url.ends_with("/live/"), "{}", studio.url);
    studio
}

#[test]
fn a_demonstration_is_followed_and_robots_that_hang_are_said_to_be_silent() {
    let folder = tempfile::tempdir().unwrap();
    let log = folder.path().join("crossing.jsonl");
    // The log comes later than the page.
    let studio = follow(&log);
    let test = "a_demonstration_is_followed";
    let Some(mut browser) = browser(folder.path(), test) else {
        return;
    };
    browser.open(&studio.url);
    browser.wait_for(&format!("({CHIP}) === 'Waiting for a record'"));
    let mut command = crossguard(&["demo", "--log", log.to_str().unwrap()]);
    let demo = command.stdout(Stdio::null()).stderr(Stdio::null());
    let demo = Killed(demo.spawn().unwrap());
    browser.wait_for(&format!("({CHIP}) === '● Live'"));
    browser.wait_for(
        "[...document.querySelectorAll('#robots .state')].some((it) => it.textContent !== 'idle')",
    );
    browser.wait_for("document.querySelectorAll('#map .body').length === 2");
    browser.wait_for("document.querySelectorAll('#messages .row').length > 4");

    // Both hang: what is shown is said to be old, and so is what each of them was to do.
    signal(&demo.0, "-STOP");
    browser.wait_for(&format!("({CHIP}) === '✗ 2 of 2 silent'"));
    let said = browser.evaluate("document.getElementById('troubles').textContent");
    assert!(
        said.as_str().unwrap().contains("has written nothing for"),
        "{said}"
    );
    assert_eq!(
        browser.evaluate("document.querySelectorAll('.robot.stale').length"),
        json!(2)
    );
    assert_eq!(
        browser.evaluate("document.querySelectorAll('#map .lease').length"),
        json!(0)
    );
    assert_fits(&mut browser);
    assert_accessible(&mut browser, folder.path(), test);

    signal(&demo.0, "-CONT");
    browser.wait_for(&format!("({CHIP}) === '● Live'"));
    browser.wait_for("document.querySelectorAll('.robot.stale').length === 0");
    assert_clean(&browser, &studio);
}

#[test]
fn a_page_whose_studio_is_gone_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let log = write(&crowd(), folder.path(), "crowd.jsonl");
    let studio = follow(&log);
    let Some(mut browser) = browser(folder.path(), "a_page_whose_studio_is_gone") else {
        return;
    };
    browser.open(&studio.url);
    browser.wait_for("document.querySelectorAll('#robots article').length === 4");
    // It hangs, and then it is gone.
    signal(&studio.child, "-STOP");
    browser.wait_for(&format!("({CHIP}) === '✗ Not live'"));
    let said = browser.evaluate("document.getElementById('troubles').textContent");
    assert!(
        said.as_str().unwrap().contains("Everything below is old"),
        "{said}"
    );
    signal(&studio.child, "-CONT");
    browser.wait_for(&format!("({CHIP}) !== '✗ Not live'"));
    drop(studio);
    browser.wait_for(&format!("({CHIP}) === '✗ Not live'"));
}

#[test]
fn a_log_that_is_cut_replaced_or_hostile_is_followed_as_far_as_it_goes() {
    let folder = tempfile::tempdir().unwrap();
    let hostile = "<img src=x onerror='window.harmed=1'>";
    let mut records = crowd();
    let first = records[0].robot.clone();
    for record in &mut records {
        if record.robot == first {
            hostile.clone_into(&mut record.robot);
        }
    }
    let whole = write(&records, folder.path(), "whole.jsonl");
    let text = std::fs::read_to_string(whole).unwrap();
    let path = folder.path().join("growing.jsonl");
    let (cut, rest) = text.split_at(text.len() / 2 + 7);
    std::fs::write(&path, cut).unwrap();
    let studio = follow(&path);
    let Some(mut browser) = browser(folder.path(), "a_log_that_is_cut_is_followed") else {
        return;
    };
    browser.open(&studio.url);
    let robots = "document.querySelectorAll('#robots article').length";
    browser.wait_for(&format!("{robots} === 4"));
    let troubles = "document.getElementById('troubles').textContent";
    // The rest of the line comes.
    let mut file = OpenOptions::new().append(true).open(&path).unwrap();
    file.write_all(rest.as_bytes()).unwrap();
    browser.wait_for(&format!(
        "({CHIP}) === '● Live' || ({CHIP}) === '■ All have stopped'"
    ));
    assert_eq!(
        browser.evaluate(&format!("({troubles}).includes('growing.jsonl')")),
        json!(false)
    );
    assert_eq!(
        browser.evaluate("window.harmed === undefined && document.images.length === 0"),
        json!(true)
    );
    let text_of_page = browser.evaluate("document.getElementById('robots').textContent");
    assert!(text_of_page.as_str().unwrap().contains(hostile));
    file.write_all(b"nonsense\n").unwrap();
    browser.wait_for(&format!("({troubles}).includes('is not a record')"));
    std::fs::write(&path, &text).unwrap();
    browser.wait_for("document.getElementById('logs').textContent.includes('began anew 1 time')");
    std::fs::remove_file(&path).unwrap();
    browser.wait_for(&format!("({troubles}).includes('No such file')"));
    browser.press(" ", false);
    browser.wait_for(&format!("({CHIP}) === '‖ Held'"));
    let reached = reached_by_tab(&mut browser, 9);
    for name in ["skip", "hold", "rows"] {
        assert!(reached.iter().any(|it| it == name), "{name}: {reached:?}");
    }
    assert_clean(&browser, &studio);
}
