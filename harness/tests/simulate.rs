//! `crossguard simulate`, as its user runs it.

mod support;

use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

fn simulate(arguments: &[&str]) -> Output {
    support::run(&[&["simulate"], arguments].concat())
}

fn json(arguments: &[&str]) -> Value {
    let output = simulate(arguments);
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    serde_json::from_slice(&output.stdout).unwrap()
}

/// The error that a bad usage ends with.
fn refusal(arguments: &[&str]) -> String {
    let output = simulate(arguments);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    String::from_utf8(output.stderr).unwrap()
}

/// Coverage by a few lines of another language, from the same file.
const COVERAGE_IN_PYTHON: &str = r"
import gzip, json, sys
path, radius, robots = sys.argv[1], float(sys.argv[2]), json.loads(sys.argv[3])
def places(changes):
    at, step = changes[0], 0
    yield at / 100
    for change in changes[1:]:
        step += change
        at += step
        yield at / 100
ratios = []
for run in json.load(gzip.open(path))['runs']:
    people = [p for x, y in run['pedestrians'] for p in zip(places(x), places(y))]
    seen = sum(any((x - a) ** 2 + (y - b) ** 2 <= radius ** 2 for a, b in robots) for x, y in people)
    ratios.append(100 * seen / len(people))
print(sum(ratios) / len(ratios))
";

#[test]
fn coverage_is_what_python_computes_from_the_same_traces() {
    let traces = Path::new(env!("CARGO_MANIFEST_DIR")).join("traces/kerb-50.json.gz");
    let kerb: Vec<[f64; 2]> = [-7.9, 92.1, 192.1]
        .into_iter()
        .flat_map(|x| [-7.9, 92.1, 192.1].map(|y| [x, y]))
        .collect();
    let cells = json(&["obs", "--json", "--preset", "kerb", "--pedestrians", "50"]);
    for (robots, places) in [(1, vec![[92.1, 92.1]]), (9, kerb)] {
        for radius in ["10", "15"] {
            let python = Command::new("python3")
                .args(["-c", COVERAGE_IN_PYTHON])
                .arg(&traces)
                .args([radius, &serde_json::to_string(&places).unwrap()])
                .output();
            let Ok(python) = python else {
                println!(
                    "skipped coverage_is_what_python_computes_from_the_same_traces: no python3"
                );
                return;
            };
            assert!(
                python.status.success(),
                "{}",
                String::from_utf8_lossy(&python.stderr)
            );
            let expected: f64 = String::from_utf8(python.stdout)
                .unwrap()
                .trim()
                .parse()
                .unwrap();
            let is_cell = |cell: &&Value| {
                cell["robots"] == robots && cell["radius_m"].as_f64() == radius.parse().ok()
            };
            let cell = cells["cells"]
                .as_array()
                .unwrap()
                .iter()
                .find(is_cell)
                .unwrap();
            let found = cell["obs_percent"]["mean"].as_f64().unwrap();
            assert!(
                (found - expected).abs() < 0.1,
                "{robots} {radius}: {found} {expected}"
            );
        }
    }
}

#[test]
fn coverage_has_the_shape_that_scripts_read() {
    let report = json(&["obs", "--json", "--preset", "plain", "--seeds", "2"]);
    assert_eq!(report["preset"], "plain");
    assert_eq!(report["parameters"]["grid"]["lanes"], 1);
    let cells = report["cells"].as_array().unwrap();
    assert_eq!(cells.len(), 3 * 3 * 2);
    for cell in cells {
        let mean = cell["obs_percent"]["mean"].as_f64().unwrap();
        assert_eq!(mean == 0.0, cell["robots"] == 0, "{cell}");
        assert!(cell["obs_percent"]["sd"].is_f64() && cell["pedestrians"].is_u64());
    }
}

#[test]
fn channel_load_has_the_shape_that_scripts_read_and_is_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).display().to_string();
    let arguments = [
        "cbr",
        "--json",
        "--pedestrians",
        "20",
        "--radius",
        "15",
        "--seeds",
        "1",
    ];
    let outputs = ["--svg", &file("plots"), "--csv", &file("cells.csv")];
    let report = json(&[&arguments[..], &outputs[..]].concat());
    assert_eq!(report["preset"], "kerb");
    assert!(report["parameters"]["behaviour"]["radio"]["sense_dbm"].is_f64());
    let cells = report["cells"].as_array().unwrap();
    assert_eq!(cells.len(), 3);
    let number = |cell: &Value, name: &str| cell[name]["mean"].as_f64().unwrap();
    assert!(number(&cells[0], "reduction_percent").abs() < 1e-9);
    assert!(number(&cells[2], "mcbr") < number(&cells[1], "mcbr"));
    assert!(number(&cells[1], "mcbr") < number(&cells[0], "mcbr"));
    let table = std::fs::read_to_string(file("cells.csv")).unwrap();
    assert_eq!(table.lines().count(), 4);
    for name in ["plots/mcbr.svg", "plots/reduction.svg"] {
        let svg = std::fs::read_to_string(file(name)).unwrap();
        assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n"));
    }
    // The same seeds give the same figures.
    assert_eq!(json(&arguments)["cells"], report["cells"]);
}

#[test]
fn intersections_are_ranked_by_what_they_add() {
    let rankings = json(&[
        "--place",
        "greedy",
        "--json",
        "--pedestrians",
        "100",
        "--radius",
        "15",
    ]);
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

#[test]
fn bad_usage_says_what_to_do() {
    assert!(refusal(&["obs", "--pedestrians", "30"]).contains("--sumo"));
    assert!(refusal(&["obs", "--robots", "10"]).contains("intersections"));
    assert!(refusal(&["obs", "--radius", "500"]).contains("radius"));
    assert!(refusal(&["obs", "--traces", "nowhere.json.gz"]).contains("nowhere.json.gz"));
    assert!(refusal(&["cbr", "--vam", "often"]).contains("etsi"));
    assert!(refusal(&["cbr", "--v2x-share", "2"]).contains("--v2x-share"));
    assert!(refusal(&["record"]).contains("pip install eclipse-sumo"));
    assert!(refusal(&["obs", "--sumo", "nowhere"]).contains("pip install eclipse-sumo"));
}

/// The traces that come along are those that `record` makes, where the same SUMO is installed.
#[test]
fn traces_can_be_recorded_again() {
    let Some(folder) = std::env::var_os("SUMO_HOME").map(|home| Path::new(&home).join("bin"))
    else {
        println!("skipped traces_can_be_recorded_again: SUMO_HOME is not set");
        return;
    };
    let output = tempfile::tempdir().unwrap();
    let [sumo, output_folder] =
        [folder.as_path(), output.path()].map(|it| it.display().to_string());
    let recorded = simulate(&[
        "record",
        "--sumo",
        &sumo,
        "--pedestrians",
        "20",
        "--seeds",
        "2",
        "--output",
        &output_folder,
    ]);
    assert!(
        recorded.status.success(),
        "{}",
        String::from_utf8_lossy(&recorded.stderr)
    );
    let file = output.path().join("kerb-20.json.gz").display().to_string();
    let again = json(&["obs", "--json", "--seeds", "2", "--traces", &file]);
    let shipped = json(&["obs", "--json", "--seeds", "2", "--pedestrians", "20"]);
    if again["parameters"] == shipped["parameters"] {
        assert_eq!(again["cells"], shipped["cells"]);
    } else {
        println!("skipped the comparison of traces_can_be_recorded_again: another SUMO");
    }
}
