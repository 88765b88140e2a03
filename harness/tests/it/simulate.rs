//! `crossguard simulate`, as its user runs it.

use std::process::{Command, Output};

use crossguard_testkit::command::{self, *};
use serde_json::Value;

/// Runs it with these words.
fn simulate(words: &str) -> Output {
    run_line(&format!("simulate {words}"))
}

fn json(words: &str) -> Value {
    let output = simulate(words);
    assert_code(&output, 0);
    command::json(&output)
}

/// The whole matrix of both presets, judged by an independent program.
#[test]
fn coverage_is_what_python_computes_from_the_same_traces() {
    let judge = |preset: &str, results: &[u8]| {
        let traces = ["20", "50", "100"]
            .map(|people| format!("evaluation/traces/{preset}-{people}.json.gz"));
        let traces = traces.each_ref().map(|it| &**it);
        judge(&[&["judges/coverage.py"], &traces[..]].concat(), results)
    };
    for preset in ["kerb", "plain"] {
        let results = simulate(&format!("obs --json --preset {preset}"));
        let Some((code, said)) = judge(preset, &results.stdout) else {
            return;
        };
        assert_eq!(code, Some(0), "{said}");
        assert!(said.starts_with("12 cells agree"), "{said}");
    }
    // Robots that are dispatched go where the judge sends them, by the people that they know of at that time.
    let dispatch =
        "--set robots_per_intersection=4 --set patrol_mps=1 --set dispatch_interval_s=20";
    let cells = "--pedestrians 20 --radius 15 --robots 1,9 --seeds 2";
    let fewer = "--set behaviour.v2x_share=0.3 --set behaviour.unseen_share=0.2";
    let mut sent = [dispatch, &format!("{dispatch} {fewer}")]
        .map(|others| stdout(&simulate(&format!("obs --json {cells} {others}"))));
    for results in &sent {
        let (code, said) = judge("kerb", results.as_bytes()).unwrap();
        assert_eq!((code, &said[..13]), (Some(0), "2 cells agree"), "{said}");
    }
    // A judge that finds everything right is none: robots that hear nobody go elsewhere.
    sent[0] = sent[0].replace("\"v2x_share\": 1.0", "\"v2x_share\": 0.0");
    let (code, said) = judge("kerb", sent[0].as_bytes()).unwrap();
    assert_eq!(code, Some(1), "{said}");
    let wrong = stdout(&simulate("obs --json --site center --pedestrians 20"));
    let wrong = wrong.replace("\"center\"", "\"south-west\"");
    let (code, said) = judge("kerb", wrong.as_bytes()).unwrap();
    assert_eq!(code, Some(1), "{said}");
}

/// Verdict of a judge in Python on results on its standard input; `None` where there is no Python.
fn judge(arguments: &[&str], results: &[u8]) -> Option<(Option<i32>, String)> {
    let mut python = Command::new("python3");
    python.current_dir(env!("CARGO_MANIFEST_DIR"));
    let Ok(said) = fed(python.args(arguments), results) else {
        skipped("there is no python3");
        return None;
    };
    Some((said.status.code(), stdout(&said) + &stderr(&said)))
}

/// Silent stations, and wrongly silent ones, judged by an independent program from the traces.
#[test]
fn silence_is_what_python_computes_from_the_same_traces() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).display().to_string();
    let (silences, results) = (file("silences.csv"), file("results.json"));
    let [fewer, more] = ["20", "50"].map(|it| format!("evaluation/traces/kerb-{it}.json.gz"));
    let arguments = ["judges/silence.py", &results, &silences, &fewer, &more];
    let judge = || judge(&arguments, &[]);
    let cells = "--pedestrians 20,50 --robots 0,9 --radius 15 --seeds 3";
    for others in [
        "--suppression strict",
        "--suppression loose",
        "--set behaviour.unseen_share=0.3",
    ] {
        let to = format!("--silences {silences}");
        let output = simulate(&format!("cbr --json {to} {cells} {others}"));
        assert_code(&output, 0);
        std::fs::write(&results, &output.stdout).unwrap();
        let Some((code, said)) = judge() else {
            return;
        };
        assert_eq!(code, Some(0), "{others:?}: {said}");
        assert!(said.starts_with("2 cells and 0 statements agree"), "{said}");
    }
    // A judge that finds everything right is none: the loose rule is not the strict one, and silence counts.
    let output = simulate(&format!("cbr --json --suppression loose {cells}"));
    std::fs::write(&results, &output.stdout).unwrap();
    let (code, said) = judge().unwrap();
    assert_eq!(code, Some(1), "{said}");
}

/// A net and what moved on it, as SUMO writes them; where somebody is and when is said on standard error, and no statement
/// about the paper's grid is judged.
#[test]
fn a_place_of_ones_own_is_measured_and_not_taken_for_the_papers() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path.display().to_string()
    };
    let net = file(
        "net.xml",
        r#"<net><location convBoundary="0,0,90,0"/><junction id="a" type="priority" x="0" y="0"/></net>"#,
    );
    // A person walks 1 m a second for a minute, from the intersection on.
    let steps = (0..=60)
        .map(|s| format!(r#"<timestep time="{s}"><person id="p" x="{s}" y="0"/></timestep>"#));
    let steps = steps.collect::<String>();
    let fcd = file("fcd.xml", &format!("<fcd-export>{steps}</fcd-export>"));
    let words = format!("obs --net {net} --fcd {fcd} --radius 15");
    let output = simulate(&format!("{words} --robots 1 --json"));
    assert_code(&output, 0);
    stderr(&output).must_have(&[
        "fcd.xml: 60s in steps of 1s, 1 people on foot (1 at once at most), 0 vehicles",
    ]);
    let percent = |report: &Value| report["cells"][0]["obs_percent"]["mean"].as_f64().unwrap();
    let report = command::json(&output);
    assert!((percent(&report) - 1_600.0 / 61.0).abs() < 1e-9, "{report}");
    assert_eq!(report["statements"], serde_json::json!([]));
    let agrees = |results: &[u8]| {
        let judged = judge(&["judges/coverage.py", &net, &fcd], results);
        judged.is_none_or(|(code, said)| code == Some(0) && said.starts_with("1 cells agree"))
    };
    assert!(agrees(&output.stdout));
    assert_eq!(report["parameters"]["net"]["intersections"], 1);
    // One that walks along sees all of it.
    let places = file("places.csv", "robot,time_s,x_m,y_m\nr,0,0,0\nr,60,60,0\n");
    let output = simulate(&format!("{words} --robots 1 --json --robots-at {places}"));
    let report = command::json(&output);
    assert!(agrees(&output.stdout));
    assert!((percent(&report) - 100.0).abs() < 1e-9, "{report}");
    let steps = steps.replace("x=\"60\"", "x=\"160\"");
    let far = file("far.xml", &format!("<fcd-export>{steps}</fcd-export>"));
    let output = simulate(&format!("obs --net {net} --fcd {far}"));
    assert_code(&output, 2);
    stderr(&output).must_have(&["1 of 1 people and vehicles are outside of the net"]);
}

fn outcome(report: &Value, statement: &str) -> String {
    let lines = report["statements"].as_array().unwrap().iter();
    let line = lines.clone().find(|it| it["statement"] == statement);
    line.unwrap()["outcome"].as_str().unwrap().to_owned()
}

/// Every statement of the paper stands in a line of its own, and its verdict follows the run.
#[test]
fn every_statement_of_the_paper_on_coverage_has_a_verdict() {
    let report = json("obs --json");
    assert_eq!(report["documented"], true);
    let statements = report["statements"].as_array().unwrap();
    assert_eq!(statements.len(), 16);
    for line in statements {
        // Ten seeds do not decide what the paper's figures are of.
        let is_figure = ["coverageOfOne", "coverageOfNine"].map(Value::from);
        let expected = if is_figure.contains(&line["statement"]) {
            "undecided"
        } else {
            "met"
        };
        assert_eq!(line["outcome"], expected, "{line}");
    }
    let plain = json("obs --json --preset plain");
    assert_eq!(plain["documented"], false);
    assert_eq!(outcome(&plain, "coverageOfNine"), "notMet");
    assert_eq!(outcome(&plain, "severalAreBetter"), "met");
    let few = simulate("obs --robots 9 --pedestrians 20");
    let text = stdout(&few);
    let line = text
        .lines()
        .find(|it| it.contains("coverage, 1 robot"))
        .unwrap();
    assert!(line.trim_start().starts_with("not measured"), "{line}");
}

#[test]
fn verdicts_on_channel_load_follow_the_run() {
    let of = |words: &str| json(&format!("cbr --json {words}"));
    let few = of("--seeds 3");
    assert_eq!(few["statements"].as_array().unwrap().len(), 25);
    // Ten seeds are documented.
    assert_eq!(few["documented"], false);
    for (statements, expected) in [
        (
            "power lowLoad consistentReduction largerRadiusStandsForMore",
            "met",
        ),
        // Three seeds leave these open.
        ("growsWithDensity largestReduction", "undecided"),
        // Artery is not used, and devices that fall silent by RAM are no devices of today.
        ("networkStack unchangedDevices", "notMet"),
    ] {
        for statement in statements.split(' ') {
            assert_eq!(outcome(&few, statement), expected, "{statement}");
        }
    }
    // Of each other run no more than its verdict needs.
    let loose = of("--seeds 3 --suppression loose --robots 9 --radius 15 --pedestrians 100");
    assert_eq!(outcome(&loose, "conservativeSilence"), "notMet");
    let unchanged = of("--seeds 1 --devices cluster-vam --robots 9 --radius 15 --pedestrians 20");
    assert_eq!(outcome(&unchanged, "unchangedDevices"), "met");
    assert_eq!(outcome(&few, "dataRate"), "assumed");
    assert_eq!(outcome(&of("--seeds 2 --signed"), "lowLoad"), "notMet");
    let seldom = of("--seeds 2 --vam etsi");
    assert_eq!(outcome(&seldom, "consistentReduction"), "notMet");
    assert_eq!(outcome(&seldom, "largestReduction"), "notMet");
}

/// Robots that hold sessions say more, and save less.
#[test]
fn robots_that_coordinate_load_the_channel_that_is_measured() {
    let of = |sessions: &str| {
        let cells = "--pedestrians 20 --robots 0,9 --radius 15 --seeds 1";
        let report = json(&format!("cbr --json {cells} {sessions}"));
        let cell = &report["cells"][1];
        let mean = |it: &Value| it["mean"].as_f64().unwrap();
        (
            mean(&cell["messages_per_s"][2]),
            mean(&cell["reduction_percent"]),
        )
    };
    let (few, saved) = of("");
    let (many, rest) = of("--set behaviour.sessions.hold_s=30");
    let is_more = many > 4.0 * few && rest < saved - 10.0;
    assert!(is_more, "{few} {saved} {many} {rest}");
}

/// A file has every parameter, a line of it goes before, and flags go before both.
#[test]
fn parameters_of_a_file_are_taken_and_flags_win() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("p.toml");
    let file = "seeds = 1\nrobots = [0]\nradii_m = [15]\npedestrians = [20]\n[behaviour]\nram_interval_ms = 200\n\
                [behaviour.radio]\ndata_rate_mbps = 12\npower_dbm = 20\n";
    std::fs::write(&path, file).unwrap();
    let cbr = format!("cbr --json --parameters {}", path.display());
    let of = |words: &str| json(&format!("{cbr} {words}"));
    let slow = json("cbr --json --seeds 1 --robots 0 --radius 15 --pedestrians 20");
    let load = |report: &Value| report["cells"][0]["mcbr"]["mean"].as_f64().unwrap();
    let fast = of("");
    let (fast_load, slow_load) = (load(&fast), load(&slow));
    assert!(fast_load < 0.65 * slow_load, "{fast_load} {slow_load}");
    let behaviour = &fast["parameters"]["behaviour"];
    assert_eq!(behaviour["radio"]["power_dbm"], 20.0);
    assert_eq!(behaviour["ram_interval_ms"], 200);
    let changed =
        of("--set behaviour.radio.data_rate_mbps=6 --set preset=kerb --ram rules --radius 10");
    assert_eq!(changed["cells"][0]["radius_m"], 10.0);
    let behaviour = &changed["parameters"]["behaviour"];
    assert_eq!(behaviour["ram_interval_ms"], Value::Null);
    assert_eq!(behaviour["radio"]["power_dbm"], 20.0);
    assert_eq!(behaviour["radio"]["data_rate_mbps"], 6.0);
    std::fs::write(&path, format!("{file}powr_dbm = 3\n")).unwrap();
    let output = simulate(&format!("obs --parameters {}", path.display()));
    assert_code(&output, 2);
    stderr(&output)
        .must_have(&["p.toml: line 10: unknown field `powr_dbm`, expected one of `power_dbm`"]);
}

/// Rare options come from a file, so that the others are seen at a glance.
#[test]
fn the_options_of_a_simulation_fit_on_a_screen() {
    let lines = stdout(&simulate("cbr -h")).lines().count();
    assert!(lines <= 50, "{lines}");
}

#[test]
fn channel_load_has_the_shape_that_scripts_read() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).display().to_string();
    let arguments = "cbr --json --pedestrians 20 --radius 15 --seeds 2";
    let report = json(&format!("{arguments} --csv {}", file("cells.csv")));
    assert_eq!(report["preset"], "kerb");
    assert!(report["parameters"]["behaviour"]["radio"]["sense_dbm"].is_f64());
    let cells = report["cells"].as_array().unwrap();
    assert_eq!(cells.len(), 3);
    let number = |cell: &Value, name: &str| cell[name]["mean"].as_f64().unwrap();
    assert!(number(&cells[0], "reduction_percent").abs() < 1e-9);
    assert!(number(&cells[2], "mcbr") < number(&cells[1], "mcbr"));
    assert!(number(&cells[1], "mcbr") < number(&cells[0], "mcbr"));
    let table = std::fs::read_to_string(file("cells.csv")).unwrap();
    // A row for each seed, with the values that the mean is of.
    let mut rows = table.lines().map(|row| row.split(',').collect::<Vec<_>>());
    let heads = rows.next().unwrap();
    let column = |name| heads.iter().position(|head| *head == name).unwrap();
    let (seed, load) = (column("seed"), column("mcbr"));
    let rows: Vec<(&str, f64)> = rows
        .map(|row| (row[seed], row[load].parse().unwrap()))
        .collect();
    assert_eq!(rows.len(), 6);
    for (cell, rows) in cells.iter().zip(rows.chunks(2)) {
        assert_eq!((rows[0].0, rows[1].0), ("1", "2"));
        assert_eq!(
            cell["mcbr"]["by_seed"],
            serde_json::json!([rows[0].1, rows[1].1])
        );
    }
    assert_eq!(report["paper"]["reduction_most_percent"]["most"], 16.3);
    // The same seeds give the same figures.
    assert_eq!(json(arguments)["cells"], report["cells"]);
}

#[test]
fn intersections_are_ranked_by_what_they_add() {
    let rankings = json("--json --pedestrians 100 --radius 15");
    let ranking = rankings[0]["ranking"].as_array().unwrap();
    assert_eq!(ranking.len(), 9);
    // The middle of the grid is where most people pass.
    assert_eq!(ranking[0]["node_m"], serde_json::json!([100.0, 100.0]));
    let gains: Vec<f64> = ranking
        .iter()
        .map(|it| it["gained_percent"].as_f64().unwrap())
        .collect();
    assert!(gains.is_sorted_by(|a, b| a >= b));
}

/// Robots that overlap and robots that walk: nobody is counted twice, and more is seen.
#[test]
fn several_robots_at_an_intersection_and_robots_on_patrol_are_measured() {
    let percent = |arguments: &str| {
        let report = json(&format!(
            "obs --json --pedestrians 20 --radius 15 {arguments}"
        ));
        let cell = report["cells"].as_array().unwrap().last().unwrap().clone();
        (
            report["parameters"].clone(),
            cell["obs_percent"]["mean"].as_f64().unwrap(),
        )
    };
    let (_, alone) = percent("--robots 9");
    let (parameters, two) = percent("--robots 18 --set robots_per_intersection=2");
    assert_eq!(parameters["robots_per_intersection"], 2);
    assert!(two > 1.5 * alone && two < 3.0 * alone, "{alone} {two}");
    let (_, four) = percent("--robots 36 --set robots_per_intersection=4");
    // Four zones overlap, so four robots see less than twice as many as two.
    assert!(four > two && four < 1.7 * two, "{two} {four}");
    let (parameters, walking) = percent("--robots 9 --set patrol_mps=1");
    assert_eq!(parameters["patrol_mps"], 1.0);
    assert!(walking > alone && walking < four, "{alone} {walking}");

    let arguments = "cbr --json --pedestrians 20 --radius 15 --seeds 1";
    let more = "--robots 0,18 --set robots_per_intersection=2 --set patrol_mps=1";
    let report = json(&format!("{arguments} {more}"));
    let cell = &report["cells"][1];
    let mean = |it: &Value| it["mean"].as_f64().unwrap();
    assert!(mean(&cell["passive_percent"]) > 15.0, "{cell}");
    // A robot that walks tells more often than once a second.
    assert!(mean(&cell["messages_per_s"][2]) > 18.0, "{cell}");
}

/// The folder of SUMO's programs, which `judges/run` installs.
fn sumo() -> Option<String> {
    let sumo = std::env::var("SUMO_BIN").ok();
    if sumo.is_none() {
        skipped("SUMO_BIN is not set");
    }
    sumo
}

/// The traces that come along are the ones that `record` makes.
#[test]
fn sumo_records_the_traces_that_come_along() {
    let Some(sumo) = sumo() else {
        return;
    };
    let output = tempfile::tempdir().unwrap();
    let folder = output.path().display().to_string();
    for preset in ["kerb", "plain"] {
        let recorded = simulate(&format!(
            "record --sumo {sumo} --preset {preset} --output {folder} --pedestrians 20 --seeds 2"
        ));
        assert_code(&recorded, 0);
        let file = format!("{folder}/{preset}-20.json.gz");
        let seeds = format!("obs --json --seeds 2 --preset {preset}");
        let again = json(&format!("{seeds} --traces {file}"));
        let shipped = json(&format!("{seeds} --pedestrians 20"));
        let mobility = |report: &Value| report["parameters"]["grid"]["mobility"].clone();
        if mobility(&again) == mobility(&shipped) {
            assert_eq!(again["cells"], shipped["cells"]);
        } else {
            skipped(&format!("no comparison: {}", mobility(&again)));
        }
    }
}

/// Fresh mobility is of other seeds, and of any size.
#[test]
fn sumo_makes_fresh_mobility_on_a_larger_grid() {
    let Some(sumo) = sumo() else {
        return;
    };
    let size = "--set grid.nodes_per_side=4 --pedestrians 30 --set vehicles=10 --set duration_s=20";
    let others = "--robots 0,16 --radius 15 --seeds 2";
    let report = json(&format!("cbr --json --sumo {sumo} {size} {others}"));
    assert_eq!(report["parameters"]["grid"]["nodes_per_side"], 4);
    assert_eq!(report["parameters"]["duration_s"], 20);
    let reduction = &report["cells"][1]["reduction_percent"];
    assert!(reduction["mean"].as_f64().unwrap() > 0.0, "{report}");
}
