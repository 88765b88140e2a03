//! Explore: counterexamples forth and back, a run without end, a search, and files that are not to be trusted.

use std::path::{Path, PathBuf};

use crossguard_model_check::replay::Replay;
use crossguard_model_check::scenario::Scenario;
use crossguard_model_check::sequence::{ChartPlace, ChartStep, Fate};
use crossguard_model_check::walk::Walk;
use serde_json::json;

use crate::browser::Browser;
use crate::page::{Studio, assert_accessible, assert_clean, assert_fits, browser, reached_by_tab};

const STEP: &str = "Number(document.getElementById('slider').value)";
const STATES: &str = "[...document.querySelectorAll('#robots .state')].map((it) => it.textContent)";

fn open(browser: &mut Browser, studio: &Studio) {
    browser.open(&format!("http://{}/explore/", studio.address()));
}

/// A request that is lost again and again, in a scenario of its own.
pub(crate) fn lost_for_ever(folder: &Path) -> PathBuf {
    let (_, pair) = Scenario::shipped_texts()
        .find(|(name, _)| *name == "pair")
        .unwrap();
    let (pair, _) = pair.split_once("[expected]").unwrap();
    let text = pair
        .replace("losses = 1\n", "")
        .replace("\"pair\"", "\"lossy\"");
    let scenario = Scenario::parse("lossy", &text).unwrap();
    let is_lost = |step: &ChartStep| {
        matches!(
            step.place,
            ChartPlace::Between {
                fate: Fate::Lost,
                ..
            }
        )
    };
    let wanted: [&dyn Fn(&ChartStep) -> bool; 4] = [
        &|step| step.action.starts_with("pedestrian detected"),
        &is_lost,
        &|step| step.action.contains("ram expires"),
        &is_lost,
    ];
    let mut steps: Vec<ChartStep> = Vec::new();
    for is_wanted in wanted {
        let walk = Walk::along(scenario.clone(), &steps);
        let step = walk.possible.iter().find(|step| is_wanted(step));
        let step = step.unwrap_or_else(|| panic!("{:?}", walk.possible));
        steps.push(step.clone());
    }
    let run = Replay {
        scenario: "lossy".to_owned(),
        text: Some(text),
        property: "L1".to_owned(),
        steps,
        repeats_after: Some(2),
    };
    write(&run, folder, "lost.json")
}

fn write(run: &Replay, folder: &Path, name: &str) -> PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, serde_json::to_string(run).unwrap()).unwrap();
    path
}

#[test]
fn a_counterexample_of_the_papers_wording_is_stepped_forth_and_back_by_keys() {
    let folder = tempfile::tempdir().unwrap();
    let studio = Studio::with(&[]);
    let test = "a_counterexample_of_the_papers_wording_is_stepped";
    let Some(mut browser) = browser(folder.path(), test) else {
        return;
    };
    open(&mut browser, &studio);
    let title = browser.evaluate("document.querySelector('#about b').textContent");
    assert!(title.as_str().unwrap().starts_with("P1: "), "{title}");
    let mut seen = vec![browser.evaluate(STATES)];
    assert_eq!(seen[0], json!(["Idle", "Idle"]));
    for step in 1..=9 {
        browser.press("ArrowRight", false);
        browser.wait_for(&format!("{STEP} === {step}"));
        let current = browser.evaluate("document.querySelector('.row.current .at').textContent");
        assert_eq!(current, json!(step.to_string()));
        seen.push(browser.evaluate(STATES));
    }
    // The leader counts on a guard that has fallen back.
    assert_eq!(
        seen[9],
        json!(["ManeuverExecuting (leader)", "RoleEstablished (follower)"])
    );
    for step in (0..9).rev() {
        browser.press("ArrowLeft", false);
        browser.wait_for(&format!("{STEP} === {step}"));
        assert_eq!(browser.evaluate(STATES), seen[step]);
    }
    browser.press("End", false);
    browser.wait_for(&format!("{STEP} === 9"));
    assert_fits(&mut browser);
    assert_accessible(&mut browser, folder.path(), test);
    assert_clean(&browser, &studio);
}

#[test]
fn a_run_without_end_from_a_file_is_a_loop_and_goes_round() {
    let folder = tempfile::tempdir().unwrap();
    let run = lost_for_ever(folder.path());
    let studio = Studio::with(&["--replay".as_ref(), run.as_os_str()]);
    assert!(studio.url.ends_with("/explore/"), "{}", studio.url);
    let Some(mut browser) = browser(folder.path(), "a_run_without_end_is_a_loop") else {
        return;
    };
    open(&mut browser, &studio);
    let turn = browser.evaluate("document.querySelector('.turn').textContent");
    assert!(
        turn.as_str()
            .unwrap()
            .contains("steps 3 to 4 again and again"),
        "{turn}"
    );
    let repeated = "document.querySelectorAll('.row.repeated').length";
    assert_eq!(browser.evaluate(repeated), json!(2));
    browser.wait_for(&format!("{STEP} === 4"));
    for step in [2, 3, 4, 2] {
        browser.press("ArrowRight", false);
        browser.wait_for(&format!("{STEP} === {step}"));
    }
    browser.press("ArrowLeft", false);
    // Which other ways there are from a step in the middle; one of them is gone.
    let arrives = "[...document.querySelectorAll('#possible button')].find((it) => it.textContent.includes('(arrives)'))";
    browser.wait_for(&format!("Boolean({arrives})"));
    browser.evaluate(&format!("{arrives}.click()"));
    browser.wait_for("document.querySelector('#about b').textContent.startsWith('Your way')");
    browser.wait_for(&format!("({STATES})[1] === 'HelpRequested (helper)'"));
    assert_clean(&browser, &studio);
}

#[test]
fn the_first_state_where_something_is_so_is_found_and_its_properties_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let studio = Studio::with(&[]);
    let test = "the_first_state_where_something_is_so_is_found";
    let Some(mut browser) = browser(folder.path(), test) else {
        return;
    };
    open(&mut browser, &studio);
    let choose = |name: &str, value: &str| {
        format!(
            "(() => {{ const it = document.getElementById('{name}'); it.value = '{value}'; it.dispatchEvent(new Event('change')); }})()"
        )
    };
    for (name, value) in [("scenario", "crossing"), ("who", "event"), ("goal", "0")] {
        browser.evaluate(&choose(name, value));
    }
    browser.evaluate("document.getElementById('search').requestSubmit()");
    browser.wait_for("document.getElementById('found').textContent.startsWith('After ')");
    browser.wait_for("document.getElementById('person').textContent === 'Somebody is on the road, at the sign of robot 1.'");
    let touched = browser.evaluate("document.getElementById('touched').textContent");
    assert!(
        touched
            .as_str()
            .unwrap()
            .contains("W1 when a pedestrian steps on the road"),
        "{touched}"
    );
    assert_eq!(
        browser.evaluate("document.querySelectorAll('.walker.on_road').length"),
        json!(1)
    );
    assert_fits(&mut browser);
    assert_accessible(&mut browser, folder.path(), test);
    // What never happens is said to never happen.
    for (name, value) in [("who", "1"), ("goal", "1")] {
        browser.evaluate(&choose(name, value));
    }
    browser.evaluate("document.getElementById('search').requestSubmit()");
    browser.wait_for("document.getElementById('found').textContent.startsWith('Never: all ')");
    let reached = reached_by_tab(&mut browser, 20);
    for name in [
        "run", "file", "save", "scenario", "who", "goal", "next", "slider",
    ] {
        assert!(reached.iter().any(|it| it == name), "{name}: {reached:?}");
    }
    assert_clean(&browser, &studio);
}

#[test]
fn a_hostile_run_is_shown_as_text_and_the_page_stays_usable() {
    let folder = tempfile::tempdir().unwrap();
    let hostile = "<img src=x onerror='window.harmed=1'><script>window.harmed=1</script>";
    let path = lost_for_ever(folder.path());
    let mut run: Replay = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    run.steps[1].action = hostile.to_owned();
    run.steps[2].outputs = vec![hostile.to_owned()];
    run.property = hostile.to_owned();
    let path = write(&run, folder.path(), "<b>hostile.json");
    let studio = Studio::with(&["--replay".as_ref(), path.as_os_str()]);
    let Some(mut browser) = browser(folder.path(), "a_hostile_run_is_shown_as_text") else {
        return;
    };
    open(&mut browser, &studio);
    let trouble = browser.evaluate("document.getElementById('troubles').textContent");
    assert!(trouble.as_str().unwrap().contains("Step 2"), "{trouble}");
    assert!(
        trouble.as_str().unwrap().contains("cannot happen"),
        "{trouble}"
    );
    let text = browser.evaluate("document.body.textContent");
    assert!(text.as_str().unwrap().contains(hostile));
    browser.press("Home", false);
    browser.press("ArrowRight", false);
    browser.wait_for(&format!("({STATES})[0] === 'HelpRequested (requester)'"));
    // Files that are no run, opened in the page.
    for (content, cause) in [
        ("{\"scenario\": 1}", "this is no run"),
        ("{cut", "this is no JSON"),
    ] {
        browser.evaluate(&crate::play::open_file(content));
        let said = format!("document.getElementById('troubles').textContent.includes('{cause}')");
        browser.wait_for(&said);
    }
    // A page reads no file of this machine.
    browser.evaluate(&crate::play::open_file(
        "{\"scenario\": \"/etc/hostname\", \"property\": \"\", \"steps\": []}",
    ));
    browser.wait_for(
        "document.getElementById('troubles').textContent.includes('does not come with the kit')",
    );
    assert_eq!(
        browser.evaluate("window.harmed === undefined && document.images.length === 0"),
        json!(true)
    );
    let (errors, _) = browser.told();
    // The refusal is an answer with code 400, which browsers log.
    assert!(
        errors
            .iter()
            .all(|error| error.contains("400 (Bad Request)")),
        "{errors:#?}"
    );
}
