//! Numbers: what a plot reads is what its file has, by pointer and by keys, and what is saved is the same.

use std::path::{Path, PathBuf};

use crossguard_testkit::command::*;
use serde_json::{Value, json};

use crate::browser::Browser;
use crate::page::{Studio, assert_accessible, assert_clean, assert_fits, browser, saved_into};

/// A file of a command's JSON.
fn results(folder: &Path, name: &str, arguments: &[&str]) -> PathBuf {
    let output = run(arguments);
    assert!(output.status.success(), "{output:?}");
    let path = folder.join(name);
    std::fs::write(&path, &output.stdout).unwrap();
    path
}

fn json_of(path: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

#[test]
fn curves_are_read_by_pointer_and_keys_and_saved_as_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let odds = ["odds", "--json", "--loss", "0.1,0.3"];
    let odds = results(folder.path(), "odds.json", &odds);
    let obs = ["simulate", "obs", "--json", "--seeds", "2"];
    let obs = results(folder.path(), "obs.json", &obs);
    let cbr = ["simulate", "cbr", "--json", "--seeds", "1"];
    let cbr = results(folder.path(), "cbr.json", &cbr);
    let mut arguments = Vec::new();
    for path in [&odds, &obs, &cbr] {
        arguments.extend(["--numbers".as_ref(), path.as_os_str()]);
    }
    let studio = Studio::with(&arguments);
    assert!(studio.url.ends_with("/numbers/"), "{}", studio.url);
    let test = "curves_are_read_by_pointer_and_keys";
    let Some(mut browser) = browser(folder.path(), test) else {
        return;
    };
    browser.open(&studio.url);
    let figures = browser.evaluate("document.querySelectorAll('figure').length");
    assert_eq!(figures, json!(5 + 1 + 3));

    // The first curve of the first figure, by keys: the team is there, at a loss of 10 %, then of 30 %.
    browser.evaluate("document.querySelector('.plot').focus()");
    let losses = json_of(&odds)["odds"][0]["losses"].clone();
    let reading = "document.querySelector('.reading').textContent";
    for (place, percent) in [(0, "10"), (1, "30")] {
        browser.press("ArrowRight", false);
        let lower = losses[place]["milestones"][0]["probability"]["lower"]
            .as_f64()
            .unwrap();
        let read = browser.evaluate(reading);
        let read = read.as_str().unwrap();
        assert!(
            read.contains(&format!("at loss rate in % {percent}")),
            "{read}"
        );
        let value: f64 = read
            .split("probability ")
            .nth(1)
            .unwrap()
            .split(' ')
            .next()
            .unwrap()
            .parse()
            .unwrap();
        assert!((value - lower).abs() < 1e-6, "{read}: {lower}");
    }
    // By pointer: the last point of the coverage of the first kind.
    let cells = json_of(&obs)["cells"].clone();
    let cells = cells.as_array().unwrap();
    let of_kind = |cell: &&Value| {
        cell["pedestrians"] == cells[0]["pedestrians"] && cell["radius_m"] == cells[0]["radius_m"]
    };
    let mean = cells.iter().rfind(of_kind).unwrap()["obs_percent"]["mean"]
        .as_f64()
        .unwrap();
    browser.evaluate(
        "(() => { const figure = document.querySelectorAll('section')[1].querySelector('figure'); \
            const mark = [...figure.querySelectorAll('.plot .fill.robot-1')].at(-1).getBoundingClientRect(); \
            const at = { clientX: mark.x + mark.width / 2, clientY: mark.y + mark.height / 2, bubbles: true }; \
            figure.querySelector('.plot').dispatchEvent(new PointerEvent('pointermove', at)); })()",
    );
    let read = browser
        .evaluate("document.querySelectorAll('section')[1].querySelector('.reading').textContent");
    let read = read.as_str().unwrap();
    let value: f64 = read
        .split("people seen in % ")
        .nth(1)
        .unwrap()
        .split(' ')
        .next()
        .unwrap()
        .parse()
        .unwrap();
    assert!((value - mean).abs() < 1e-4, "{read}: {mean}");

    assert_fits(&mut browser);
    assert_accessible(&mut browser, folder.path(), test);
    assert_saved(&mut browser, folder.path(), cells, mean);
    assert_clean(&browser, &studio);
}

/// The figure of coverage is saved with the numbers of its cells.
fn assert_saved(browser: &mut Browser, folder: &Path, cells: &[Value], mean: f64) {
    let click = |label: &str| {
        format!(
            "[...document.querySelectorAll('section')[1].querySelectorAll('button')].find((it) => it.textContent === '{label}').click()"
        )
    };
    let csv = saved_into(browser, &folder.join("csv"), "csv", &click("Save as CSV"));
    let csv = std::fs::read_to_string(csv).unwrap();
    assert_eq!(csv.lines().count(), cells.len() + 1, "{csv}");
    assert!(csv.contains(&format!(",{mean},")), "{csv}");
    let svg = saved_into(browser, &folder.join("svg"), "svg", &click("Save as SVG"));
    let svg = std::fs::read_to_string(svg).unwrap();
    assert!(
        svg.starts_with("<svg") && svg.contains("Observation coverage (OBS)"),
        "{svg}"
    );
    assert!(svg.contains("20 people, 10 m"), "{svg}");
}

#[test]
fn a_hostile_file_of_results_is_text_and_one_that_is_none_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let hostile = "<img src=x onerror='window.harmed=1'>";
    let file = json!({"preset": hostile, "cells": [{"robots": 0, "pedestrians": 20, "radius_m": 10.0, "obs_percent": {"mean": 1e12, "sd": 0.0}},
        {"robots": 4_000_000_000_u32, "pedestrians": 20, "radius_m": 10.0, "obs_percent": {"mean": -1e12, "sd": 0.0}}],
        "statements": [{"about": hostile, "paper": hostile, "measured": "", "rule": "", "outcome": hostile}]});
    let path = folder.path().join("<b>hostile.json");
    std::fs::write(&path, file.to_string()).unwrap();
    let none = folder.path().join("none.json");
    std::fs::write(&none, "{\"cells\": 3}").unwrap();
    let output = run(&[
        "studio",
        "--no-browser",
        "--port",
        "0",
        "--numbers",
        none.to_str().unwrap(),
    ]);
    assert_refused(&output, "crossguard odds --json");
    let studio = Studio::with(&["--numbers".as_ref(), path.as_os_str()]);
    let Some(mut browser) = browser(folder.path(), "a_hostile_file_of_results_is_text") else {
        return;
    };
    browser.open(&studio.url);
    let text = browser.evaluate("document.body.textContent");
    assert!(text.as_str().unwrap().contains(hostile));
    assert_eq!(
        browser.evaluate("window.harmed === undefined && document.images.length === 0"),
        json!(true)
    );
    assert_clean(&browser, &studio);
}
