//! After: a run with a team of four and thirty people, by keys, at two widths, and a hostile log.

use serde_json::json;

use crate::logs::{crowd, write};
use crate::page::{Studio, assert_accessible, assert_clean, assert_fits, browser, reached_by_tab};

const TIME: &str = "Number(document.getElementById('slider').value)";

#[test]
fn a_team_with_thirty_people_is_shown_at_every_width_and_nothing_is_loaded_from_elsewhere() {
    let folder = tempfile::tempdir().unwrap();
    let log = write(&crowd(), folder.path(), "crowd.jsonl");
    let studio = Studio::of(&[&log]);
    let Some(mut browser) = browser(folder.path(), "a_team_with_thirty_people_is_shown") else {
        return;
    };
    browser.open(&studio.url);
    browser.evaluate("document.getElementById('slider').value = document.getElementById('slider').max / 2, document.getElementById('slider').dispatchEvent(new Event('input'))");
    browser.wait_for("document.querySelectorAll('#map .person').length === 30");
    let count = |selector: &str| format!("document.querySelectorAll('{selector}').length");
    assert_eq!(browser.evaluate(&count("#robots article")), json!(4));
    assert_eq!(browser.evaluate(&count("#map .body")), json!(4));
    assert!(browser.evaluate(&count("#messages .row")).as_u64().unwrap() > 10);
    let odd = "[...document.querySelectorAll('.timers .n')].map((it) => it.textContent).filter((it) => !/^[0-9.]+ m?s$/.test(it))";
    assert_eq!(browser.evaluate(odd), json!([]), "timers");
    let shown = "(() => { const list = document.querySelector('.rows').getBoundingClientRect(), row = document.querySelector('.row.current').getBoundingClientRect(); \
        return list.top <= row.top && row.bottom <= list.bottom; })()";
    browser.wait_for(shown);
    assert!(
        browser
            .evaluate(&count("#timeline rect.exec, #timeline rect.role"))
            .as_u64()
            .unwrap()
            > 1
    );
    assert_fits(&mut browser);
    assert_clean(&browser, &studio);
}

#[test]
fn a_run_is_stepped_and_played_by_keys_alone() {
    let folder = tempfile::tempdir().unwrap();
    let log = write(&crowd(), folder.path(), "crowd.jsonl");
    let studio = Studio::of(&[&log]);
    let Some(mut browser) = browser(folder.path(), "a_run_is_stepped_and_played_by_keys_alone")
    else {
        return;
    };
    browser.open(&studio.url);
    let current = "document.querySelector('.row.current')?.textContent ?? ''";
    let settled =
        |at: &str| format!("{TIME} === {at} && document.querySelector('.row.current') !== null");
    let mut seen = Vec::new();
    for _ in 0..5 {
        let before = browser.evaluate(TIME);
        browser.press("ArrowRight", false);
        browser.wait_for(&format!("{TIME} > {before}"));
        let at = browser.evaluate(TIME);
        let told = format!(
            "document.querySelector('.row.current .at')?.textContent === ({at} / 1e6).toFixed(3)"
        );
        browser.wait_for(&told);
        seen.push((at, browser.evaluate(current)));
    }
    for (at, row) in seen.iter().rev().skip(1) {
        browser.press("ArrowLeft", false);
        browser.wait_for(&settled(&at.to_string()));
        browser.wait_for(&format!("({current}) === {row}"));
    }
    browser.press("End", false);
    browser.wait_for(&format!(
        "{TIME} === Number(document.getElementById('slider').max)"
    ));
    browser.press("Home", false);
    browser.wait_for(&format!("{TIME} === 0"));
    // Nothing has the focus, so the key is the page's.
    browser.press(" ", false);
    browser.wait_for(&format!("{TIME} > 200000"));
    browser.press(" ", false);
    assert_eq!(
        browser.evaluate("document.getElementById('play').textContent"),
        json!("Play")
    );
    let reached = reached_by_tab(&mut browser, 18);
    for name in [
        "skip", "first", "previous", "play", "next", "last", "speed", "trial", "repeats", "slider",
        "rows",
    ] {
        assert!(reached.iter().any(|it| it == name), "{name}: {reached:?}");
    }
    assert_clean(&browser, &studio);
}

#[test]
fn axe_finds_nothing_serious() {
    let folder = tempfile::tempdir().unwrap();
    let log = write(&crowd(), folder.path(), "crowd.jsonl");
    let studio = Studio::of(&[&log]);
    let Some(mut browser) = browser(folder.path(), "axe_finds_nothing_serious") else {
        return;
    };
    browser.open(&studio.url);
    browser.press("End", false);
    assert_accessible(&mut browser, folder.path(), "axe_finds_nothing_serious");
}

#[test]
fn a_hostile_log_runs_no_script_and_shows_where_it_is_cut() {
    let folder = tempfile::tempdir().unwrap();
    let hostile = "<img src=x onerror='window.harmed=1'><script>window.harmed=1</script>";
    let mut records = crowd();
    let first = records[0].robot.clone();
    for record in &mut records {
        if record.robot == first {
            hostile.clone_into(&mut record.robot);
        }
    }
    let path = write(&records, folder.path(), "<b>hostile.jsonl");
    // Very many events, and a cut in the middle of a record with more behind it.
    let mut log = std::fs::read_to_string(&path).unwrap();
    let last = records.last().unwrap().at_us;
    let filler = format!("{hostile}{}", "x".repeat(300));
    for number in 0..1_000_000_u64 {
        let detail = if number % 25 == 0 { &filler } else { hostile };
        let dropped = json!({"atUs": last + number * 100, "robot": hostile, "entry": "dropped", "layer": "syntax",
            "cause": "malformed", "detail": detail, "octets": ""});
        log.push_str(&dropped.to_string());
        log.push('\n');
    }
    log.push_str("{\"atUs\": 1, \"robot\": \"cut\n{}\n");
    std::fs::write(&path, log).unwrap();
    let studio = Studio::of(&[&path]);
    let Some(mut browser) = browser(folder.path(), "a_hostile_log_runs_no_script") else {
        return;
    };
    browser.open(&studio.url);
    let trouble = browser.evaluate("document.getElementById('troubles').textContent");
    let cut = format!("line {}: is not a record", records.len() + 1_000_001);
    assert!(trouble.as_str().unwrap().contains(&cut), "{trouble}");
    assert_eq!(
        browser.evaluate("document.getElementById('chip').textContent"),
        json!("✗ Not valid")
    );
    for key in ["Home", "ArrowRight", "ArrowRight", "End", "ArrowLeft"] {
        browser.press(key, false);
    }
    browser.wait_for(&format!(
        "{TIME} > 1e6 && document.querySelectorAll('#messages .row').length > 50"
    ));
    let rows = browser.evaluate("document.querySelectorAll('*').length");
    assert!(rows.as_u64().unwrap() < 9_000, "{rows} elements");
    assert!(
        browser
            .evaluate("document.body.textContent")
            .as_str()
            .unwrap()
            .contains(hostile)
    );
    assert_eq!(
        browser.evaluate("window.harmed === undefined && document.images.length === 0"),
        json!(true)
    );
    browser.look(820, 900, "light");
    assert!(
        browser
            .evaluate("document.documentElement.scrollWidth")
            .as_u64()
            .unwrap()
            <= 820
    );
    assert_clean(&browser, &studio);
}
