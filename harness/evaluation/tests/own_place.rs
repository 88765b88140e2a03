//! A place of one's own: the general engine has the figures of the paper's grid, and a net's people come and go.

use std::fmt::Write as _;

use crossguard_evaluation::behaviour::Behaviour;
use crossguard_evaluation::fcd;
use crossguard_evaluation::grid::Preset;
use crossguard_evaluation::matrix::{Axes, cbr, obs};
use crossguard_evaluation::messages::Sizes;
use crossguard_evaluation::net::{Net, Streets};
use crossguard_evaluation::schedule::Schedule;
use crossguard_evaluation::shipped;
use crossguard_evaluation::simulation::simulate;
use crossguard_evaluation::stationing::Stationing;
use crossguard_evaluation::trace::{Run, Traces, Track};

/// A run as SUMO writes it.
fn written(run: &Run, sample_ms: u64) -> String {
    let mut text =
        String::from("<?xml version=\"1.0\"?>\n<!-- <timestep time=\"7\"/> -->\n<fcd-export>\n");
    let steps = run.duration_ms() / sample_ms;
    for step in 0..=steps {
        let time_ms = step * sample_ms + 30_000;
        let _ = writeln!(
            text,
            "<timestep time=\"{}.{:02}\">",
            time_ms / 1_000,
            time_ms % 1_000 / 10
        );
        let kinds = [("person", &run.pedestrians), ("vehicle", &run.vehicles)];
        for (name, tracks) in kinds {
            for (number, track) in tracks.iter().enumerate() {
                if track.is_there(step * sample_ms * 1_000) {
                    let [x, y] = track.place_at(usize::try_from(step).unwrap());
                    let _ = writeln!(
                        text,
                        "<{name} id=\"{number}\" x=\"{x:.2}\" y=\"{y:.2}\" angle=\"90\"/>"
                    );
                }
            }
        }
        text.push_str("</timestep>\n");
    }
    text + "</fcd-export>\n"
}

/// The net of the paper's grid, which netgenerate names and SUMO reads.
fn net() -> Net {
    let mut text = String::from("<net><location convBoundary=\"0.00,0.00,200.00,200.00\"/>");
    for [x, y] in Preset::Kerb.grid().nodes() {
        let _ = write!(
            text,
            "<junction id=\"j\" type=\"unregulated\" x=\"{x}\" y=\"{y}\"/>"
        );
    }
    Net::read((text + "<junction id=\":j\" type=\"internal\" x=\"1\" y=\"1\"/></net>").as_bytes())
        .unwrap()
}

#[test]
fn a_net_and_floating_car_data_give_the_figures_of_the_grid() {
    let mut grid = shipped::traces(Preset::Kerb, 20).unwrap().unwrap();
    grid.runs.truncate(2);
    let read = |run: &Run| {
        let text = written(run, grid.sample_ms);
        let recording = fcd::read(text.as_bytes(), run.seed).unwrap();
        assert_eq!((recording.sample_ms, recording.gaps), (500, 0));
        recording.run
    };
    let own = Traces {
        streets: Streets::Net(net()),
        is_proven: false,
        sample_ms: grid.sample_ms,
        runs: grid.runs.iter().map(read).collect(),
    };
    assert_eq!(own.runs, grid.runs);
    let mut places = String::from("robot,time_s,x_m,y_m\n");
    for (number, node) in Preset::Kerb.grid().nodes().iter().enumerate() {
        let [x, y] = Preset::Kerb.grid().robot_at(*node, Preset::Kerb.site());
        let _ = writeln!(places, "{number},0,{x},{y}");
    }
    let at_corners = Axes {
        robots: vec![0, 1, 9],
        radii_m: vec![15.0],
        stationing: Stationing::at(Preset::Kerb.site()),
        seeds: 10,
        threads: 2,
    };
    let by_file = Axes {
        stationing: Stationing {
            robots_at: Some(Schedule::read(places.as_bytes()).unwrap()),
            ..at_corners.stationing.clone()
        },
        ..at_corners.clone()
    };
    let coverage = |traces: &Traces, axes: &Axes| {
        let cells = obs(
            std::slice::from_ref(traces),
            axes,
            &Behaviour::default(),
            || true,
        );
        cells
            .into_iter()
            .map(|it| it.obs_percent)
            .collect::<Vec<_>>()
    };
    assert_eq!(coverage(&own, &by_file), coverage(&grid, &at_corners));
    let (behaviour, sizes) = (Behaviour::default(), Sizes::measure(5).unwrap());
    let load = |traces: &Traces, axes: &Axes| {
        cbr(
            std::slice::from_ref(traces),
            axes,
            &behaviour,
            &sizes,
            |_, _| true,
        )
        .unwrap()
    };
    assert_eq!(load(&own, &by_file), load(&grid, &at_corners));
}

#[test]
fn who_comes_and_goes_is_on_the_air_only_meanwhile() {
    let here = |samples: usize| Track::new(500, &vec![[0.0, 3.0]; samples]);
    // One all the time, one from 10 s to 20 s, and one who comes back.
    let text = {
        let run = Run {
            seed: 1,
            vehicles: Vec::new(),
            pedestrians: vec![here(81), here(21).from_sample(20)],
        };
        written(&run, 500)
    };
    let one_missing = text.replacen(
        "<person id=\"0\" x=\"0.00\" y=\"3.00\" angle=\"90\"/>",
        "",
        5,
    );
    let recording = fcd::read(one_missing.as_bytes(), 1).unwrap();
    assert_eq!(recording.run.pedestrians[0].begin_ms(), 2_500);
    let recording = fcd::read(text.as_bytes(), 1).unwrap();
    let said = recording.to_string();
    assert!(
        said.contains("40s in steps of 500ms, 2 people on foot (2 at once at most), 0 vehicles"),
        "{said}"
    );
    let run = &recording.run;
    assert_eq!(
        (run.pedestrians[1].begin_ms(), run.pedestrians[1].end_ms()),
        (10_000, 20_000)
    );
    let sizes = Sizes::measure(5).unwrap();
    let behaviour = Behaviour::default();
    let (measured, _) = simulate(run, run.duration_ms(), &[], &behaviour, &sizes).unwrap();
    // 10 VAM a second, of two in 10 of the 35 seconds that count.
    assert!(
        (measured.vam_rate - 10.0 * 45.0 / 35.0).abs() < 0.1,
        "{measured:?}"
    );
    // A robot stands in for who is there, and nobody is wrongly silent.
    let robots = [Track::standing([0.0, 0.0])];
    let (measured, silences) =
        simulate(run, run.duration_ms(), &robots, &behaviour, &sizes).unwrap();
    let second = silences.iter().filter(|it| it.person == 1);
    let second = second.map(|it| (it.from_ms, it.to_ms)).collect::<Vec<_>>();
    assert!(
        second
            .iter()
            .all(|(from_ms, to_ms)| *from_ms >= 10_000 && *to_ms <= 20_100),
        "{second:?}"
    );
    assert!(!second.is_empty() && measured.passive > 0.8, "{measured:?}");
}

/// Nothing is cut or taken without a word: each is told with its numbers and what to do.
#[test]
fn a_file_that_does_not_fit_is_refused_with_its_numbers() {
    let person = |x: f64| format!("<person id=\"p\" x=\"{x}\" y=\"0\"/>");
    let step = |time: f64| {
        format!(
            "<timestep time=\"{time}\">{}</timestep>",
            person(5.0 * time)
        )
    };
    let refused = |text: &str| fcd::read(text.as_bytes(), 1).unwrap_err().to_string();
    let whole = format!(
        "<fcd-export>{}{}{}</fcd-export>",
        step(0.0),
        step(1.0),
        step(2.0)
    );
    let run = fcd::read(whole.as_bytes(), 1).unwrap().run;
    assert_eq!(run.duration_ms(), 2_000);
    for (text, said) in [
        (
            whole.replace("</fcd-export>", ""),
            "without </fcd-export>: write it anew",
        ),
        (
            whole.replace("time=\"2\"", "time=\"2.5\""),
            "at 2500 ms comes after the one at 1000 ms, and steps are 1000 ms",
        ),
        (whole.replace("y=\"0\"", ""), "<person> at octet"),
        (whole.replace("person", "vehicle"), "has nobody on foot"),
        (
            whole.replace("fcd-export", "net"),
            "is a <net> of SUMO, and a <fcd-export> is wanted",
        ),
        (
            format!("<fcd-export>{}</fcd-export>", step(0.0)),
            "has 1 steps, and two at least",
        ),
        ("{}".to_owned(), "without </fcd-export>"),
    ] {
        assert!(refused(&text).contains(said), "{}", refused(&text));
    }
    let far = fcd::read(whole.replace("x=\"10\"", "x=\"251\"").as_bytes(), 1)
        .unwrap()
        .run;
    let said = net().check(&far).unwrap_err().to_string();
    assert!(
        said.starts_with("1 of 1 people and vehicles are outside")
            && said.contains("to (251.00, 0.00)"),
        "{said}"
    );
    net().check(&run).unwrap();
}

/// A trace of a real net whose header says that it is a grid is none of the grid.
#[test]
fn a_trace_file_whose_people_leave_the_grid_is_refused() {
    let mut traces = shipped::traces(Preset::Kerb, 20).unwrap().unwrap();
    traces.runs.truncate(1);
    let refused = |traces: &Traces| {
        let mut packed = Vec::new();
        traces.write(&mut packed).unwrap();
        Traces::read(&packed[..]).unwrap_err().to_string()
    };
    let mut off = traces.clone();
    off.runs[0].pedestrians[3] = Track::new(500, &vec![[50.0, 50.0]; 401]);
    let said = refused(&off);
    assert!(
        said.starts_with("401 of 16040 places of run 1 are off the streets")
            && said.contains("--fcd"),
        "{said}"
    );
    traces.runs[0].pedestrians[3] = Track::new(500, &vec![[50.0, 100.0]; 301]);
    let said = refused(&traces);
    assert!(
        said.starts_with("run 1 lasts 200000 ms, and somebody is there for 150000 ms only"),
        "{said}"
    );
}
