//! Play: a message that is lost by a click and sent again, taking back, running by itself, and files.

use std::path::Path;

use crossguard_testkit::command::*;
use serde_json::json;

use crate::browser::Browser;
use crate::page::{
    Studio, assert_accessible, assert_clean, assert_fits, browser, reached_by_tab, saved_into,
};

fn open(browser: &mut Browser, studio: &Studio) {
    browser.open(&format!("http://{}/play/", studio.address()));
}

/// Opens a file with this content by the page's own input.
pub(crate) fn open_file(content: &str) -> String {
    let content = json!(content);
    format!(
        "(() => {{ const files = new DataTransfer(); files.items.add(new File([{content}], 'run.json')); \
            const input = document.getElementById('file'); input.files = files.files; input.dispatchEvent(new Event('change')); }})()"
    )
}

/// Clicks the button that begins with this, in this part of the page.
fn click(browser: &mut Browser, part: &str, label: &str) {
    let button = format!(
        "[...document.querySelectorAll('#{part} button:enabled')].find((it) => it.textContent.startsWith({}))",
        json!(label)
    );
    browser.wait_for(&format!("Boolean({button})"));
    browser.evaluate(&format!("{button}.click()"));
}

fn taken(browser: &mut Browser, steps: usize) {
    browser.wait_for(&format!(
        "document.querySelectorAll('#steps .row').length === {steps}"
    ));
}

/// What `check --replay` says of the run that the page saves.
fn saved(browser: &mut Browser, folder: &Path) -> std::process::Output {
    let save = "document.getElementById('save').click()";
    let file = saved_into(browser, &folder.join("saved"), "json", save);
    run(&["check", "--replay", file.to_str().unwrap(), "--endpoints"])
}

#[test]
fn a_request_that_is_lost_by_a_click_is_sent_again_and_the_run_is_one_that_endpoints_take() {
    let folder = tempfile::tempdir().unwrap();
    let studio = Studio::with(&[]);
    let Some(mut browser) = browser(folder.path(), "a_request_that_is_lost_is_sent_again") else {
        return;
    };
    open(&mut browser, &studio);
    click(&mut browser, "robots", "Pedestrian detected");
    taken(&mut browser, 1);
    let request = browser.evaluate("document.querySelector('#air .what').textContent");
    assert!(
        request
            .as_str()
            .unwrap()
            .starts_with("robot 1 → robot 2: RAM"),
        "{request}"
    );
    click(&mut browser, "air", "Lose");
    taken(&mut browser, 2);
    assert_eq!(
        browser.evaluate("document.querySelectorAll('#air .what').length"),
        json!(0)
    );
    let lost = browser.evaluate("document.querySelectorAll('#steps .lost').length");
    assert_eq!(lost, json!(1));
    click(&mut browser, "robots", "Let timer ram run out");
    taken(&mut browser, 3);
    let again = browser.evaluate("document.querySelector('#air .what').textContent");
    assert!(
        again
            .as_str()
            .unwrap()
            .starts_with("robot 1 → robot 2: RAM"),
        "{again}"
    );
    click(&mut browser, "air", "Deliver");
    taken(&mut browser, 4);
    let state = "document.querySelectorAll('#robots .state')[1].textContent";
    assert_eq!(browser.evaluate(state), json!("HelpRequested (helper)"));
    // Back to before it was lost, and on again.
    for steps in [3, 2, 1] {
        browser.evaluate("document.getElementById('undo').click()");
        taken(&mut browser, steps);
    }
    assert_eq!(browser.evaluate(state), json!("Idle"));
    for steps in [2, 3, 4] {
        browser.evaluate("document.getElementById('redo').click()");
        taken(&mut browser, steps);
    }
    assert_eq!(browser.evaluate(state), json!("HelpRequested (helper)"));
    let output = saved(&mut browser, folder.path());
    assert!(output.status.success(), "{output:?}");
    let said = stdout(&output);
    assert!(said.contains("Endpoints took 4 of its 4 steps"), "{said}");
    assert!(
        said.contains("The run exists in pair-with-room, all 4 steps"),
        "{said}"
    );
    assert_clean(&browser, &studio);
}

#[test]
fn robots_break_down_and_a_street_of_ones_own_is_played_by_keys_alone() {
    let folder = tempfile::tempdir().unwrap();
    let studio = Studio::with(&[]);
    let test = "a_street_of_ones_own_is_played_by_keys_alone";
    let Some(mut browser) = browser(folder.path(), test) else {
        return;
    };
    open(&mut browser, &studio);
    let reached = reached_by_tab(&mut browser, 24);
    for name in [
        "skip",
        "scenario",
        "loss",
        "delay",
        "seed",
        "breakdowns",
        "auto",
        "save",
        "file",
    ] {
        assert!(reached.iter().any(|it| it == name), "{name}: {reached:?}");
    }
    // Five robots of one's own: the form is sent with Enter.
    browser.evaluate("document.getElementById('own').open = true, document.getElementById('robots-wanted').value = '', document.getElementById('robots-wanted').focus()");
    browser.press("5", false);
    browser.press("Enter", false);
    browser.wait_for("document.querySelectorAll('#robots article').length === 5");
    browser.evaluate("[...document.querySelectorAll('#robots button')].find((it) => it.textContent.startsWith('Pedestrian')).focus()");
    browser.press("Enter", false);
    taken(&mut browser, 1);
    browser.evaluate("document.activeElement.blur()");
    for (key, steps) in [("l", 2), ("u", 1), ("r", 2), ("w", 3)] {
        browser.press(key, false);
        taken(&mut browser, steps);
    }
    browser.press("a", false);
    browser.wait_for(
        "document.querySelectorAll('#steps .row').length > 5 && document.getElementById('all') === null",
    );
    // Only the request that is delayed is still on its way, and may arrive more than once.
    let ways = browser
        .evaluate("[...document.querySelectorAll('#air button')].map((it) => it.textContent)");
    assert_eq!(ways, json!(["Deliver", "Deliver, and once more", "Lose"]));
    browser.press(" ", false);
    browser.wait_for("document.querySelectorAll('#steps .row').length > 12");
    browser.press(" ", false);
    browser.wait_for("document.getElementById('auto').getAttribute('aria-pressed') === 'false'");
    assert_fits(&mut browser);
    assert_accessible(&mut browser, folder.path(), test);
    assert_clean(&browser, &studio);
}

#[test]
fn a_robot_that_crashed_hears_nothing_and_boots_again() {
    let folder = tempfile::tempdir().unwrap();
    let studio = Studio::with(&[]);
    let Some(mut browser) = browser(folder.path(), "a_robot_that_crashed_hears_nothing") else {
        return;
    };
    open(&mut browser, &studio);
    let second = |what: &str| {
        format!(
            "[...document.querySelectorAll('#robots article')[1].querySelectorAll('button')].find((it) => it.textContent === '{what}')"
        )
    };
    browser.evaluate(&format!("{}.click()", second("Crashes")));
    taken(&mut browser, 1);
    let state = "document.querySelectorAll('#robots .state')[1].textContent";
    assert_eq!(browser.evaluate(state), json!("down"));
    click(&mut browser, "robots", "Pedestrian detected");
    taken(&mut browser, 2);
    let fates = browser.evaluate(
        "[...document.querySelectorAll('#air .buttons button')].map((it) => it.textContent)",
    );
    assert_eq!(fates, json!(["Lose", "Delay"]));
    click(&mut browser, "air", "Lose");
    taken(&mut browser, 3);
    browser.evaluate(&format!("{}.click()", second("Boots again")));
    taken(&mut browser, 4);
    assert_eq!(browser.evaluate(state), json!("Idle"));
    let output = saved(&mut browser, folder.path());
    assert!(output.status.success(), "{output:?}");
    assert_clean(&browser, &studio);
}

#[test]
fn a_file_that_is_no_scenario_or_no_run_leaves_the_play_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let studio = Studio::with(&[]);
    let Some(mut browser) = browser(folder.path(), "a_file_that_is_no_scenario") else {
        return;
    };
    open(&mut browser, &studio);
    click(&mut browser, "robots", "Pedestrian detected");
    taken(&mut browser, 1);
    let hostile = "<img src=x onerror='window.harmed=1'>";
    let scenario = format!("name = \\\"{hostile}\\\"\\nnonsense = 1\\n");
    let files = [
        ("{cut".to_owned(), "this is no JSON"),
        ("[]".to_owned(), "this is no run"),
        (
            format!(
                "{{\"scenario\": \"x\", \"property\": \"\", \"steps\": [], \"text\": \"{scenario}\"}}"
            ),
            "nonsense",
        ),
    ];
    for (content, cause) in files {
        browser.evaluate(&open_file(&content));
        browser.wait_for(&format!(
            "document.getElementById('troubles').textContent.includes('{cause}')"
        ));
        taken(&mut browser, 1);
    }
    browser.evaluate(&format!(
        "document.getElementById('text').value = {}, document.getElementById('begin').click()",
        json!(hostile)
    ));
    browser.wait_for("document.getElementById('troubles').textContent.includes('onerror')");
    click(&mut browser, "air", "Lose");
    taken(&mut browser, 2);
    assert_eq!(
        browser.evaluate("window.harmed === undefined && document.images.length === 0"),
        json!(true)
    );
}
