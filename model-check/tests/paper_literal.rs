//! The paper's text as it stands fails as it must, each hazard is of one of three kinds and has its paragraph and run, and the page says what
//! the checker finds.
//!
//! `CROSSGUARD_BLESS=1` writes it anew.

use std::sync::LazyLock;

use crossguard_model_check::paper::{
    Hazard, HazardKind, PaperRun, Reading, Text, check, fails_as_it_must, is_found_in, runs,
};
use crossguard_model_check::properties::PropertyId;
use crossguard_model_check::report::{CheckVerdict, PropertyReport, ScenarioReport};
use crossguard_model_check::scenario::Scenario;
use crossguard_model_check::sequence::Chart;
use crossguard_model_check::walk::{BodyFrame, PersonFrame, Walk};

static REPORT: LazyLock<ScenarioReport> = LazyLock::new(check);
static RUNS: LazyLock<Vec<PaperRun>> = LazyLock::new(runs);

#[test]
fn it_fails_as_it_must() {
    let report = &*REPORT;
    let violated: Vec<_> = report.violated().collect();
    assert!(fails_as_it_must(report), "{violated:?}");
    assert_eq!(violated.len(), 18);
    assert!(report.exhaustive);
    assert_eq!((report.unique_states, report.depth), (288_655, 31));
}

#[test]
fn a_report_that_says_anything_else_is_not_the_failure_it_must_be() {
    let report = &*REPORT;
    for i in 0..report.properties.len() {
        let mut other = report.clone();
        let verdict = &mut other.properties[i].verdict;
        *verdict = match verdict {
            CheckVerdict::Violated => CheckVerdict::Holds,
            CheckVerdict::Reachable => CheckVerdict::Unreachable,
            _ => CheckVerdict::Violated,
        };
        assert!(!fails_as_it_must(&other), "{}", other.properties[i].id);
    }
}

#[test]
fn each_counterexample_is_the_shortest() {
    let is_violated = |p: &&PropertyReport| p.verdict == CheckVerdict::Violated;
    let violated = REPORT.properties.iter().filter(is_violated);
    let steps: Vec<_> = violated.map(|p| p.counterexample.len()).collect();
    // P1 to P9, P11 to P14, then W1 to W4 and W7.
    let hazards = [9, 14, 9, 8, 2, 8, 5, 2, 3, 14, 8, 7, 10];
    let on_road = [13, 13, 16, 10, 2];
    assert!(steps.iter().eq(hazards.iter().chain(&on_road)), "{steps:?}");
}

#[test]
fn each_hazard_is_stated_silent_or_ambiguous_and_has_its_paragraph_and_its_run() {
    let page = std::fs::read_to_string(PAGE).unwrap();
    for text in RUNS.iter().map(|run| run.text) {
        let kind = text.kind;
        let passage = &text.passage;
        let sections = ["II-D", "III-A"];
        assert!(sections.contains(&&*passage.section), "{}", text.id);
        let paragraphs = ["stage ", "RAM, ", "RMCM, ", "the paragraph on "];
        let is_paragraph = paragraphs
            .iter()
            .any(|it| passage.paragraph.starts_with(it));
        assert!(is_paragraph, "{}: {}", text.id, passage.paragraph);
        let words = passage.words.split(' ').count();
        assert!((2..=6).contains(&words), "{}: {words} words", text.id);
        let title = format!("# {}: {}\n\n**{kind:?}**: section", text.id, text.title);
        assert!(page.contains(&title), "no section {title}");
        let run = REPORT.properties.iter().find(|it| it.id == text.id);
        assert!(
            run.is_some_and(|it| !it.counterexample.is_empty()),
            "{}",
            text.id
        );
    }
    let sections = page.matches("\n```mermaid\n").count();
    assert_eq!(
        sections,
        Hazard::ALL.len() + 1,
        "a run for each hazard, two for W1, and no more"
    );
}

/// The properties that the kit's own protocol is checked for in a scenario.
fn claimed_in(name: &str) -> Vec<PropertyId> {
    let scenario = Scenario::load(name).unwrap();
    let timed = scenario.timed.map(|timed| timed.properties);
    timed
        .into_iter()
        .flatten()
        .chain(scenario.properties)
        .collect()
}

#[test]
fn each_hazard_names_a_property_of_the_kit_that_closes_it() {
    let claimed: Vec<_> = Scenario::shipped().flat_map(claimed_in).collect();
    for text in RUNS.iter().map(|run| run.text) {
        let (_, ids) = text.closed_by.rsplit_once('(').expect("properties");
        let ids: Vec<_> = ids.trim_end_matches(").").split(", ").collect();
        assert!(!ids.is_empty());
        for id in ids {
            let id: PropertyId = id.parse().unwrap_or_else(|()| panic!("{}: {id}", text.id));
            assert!(
                claimed.contains(&id),
                "{}: no scenario claims {id}",
                text.id
            );
        }
    }
}

#[test]
fn other_readings_do_to_hazards_what_the_page_says() {
    for hazard in Hazard::ALL {
        let text = hazard.text();
        assert!(is_found_in(hazard, Reading::Literal), "{}", text.id);
        let is_ambiguous = text.kind == HazardKind::Ambiguous;
        assert!(!is_ambiguous || text.other_reading.is_some(), "{}", text.id);
        if let Some(other) = &text.other_reading {
            assert_eq!(
                is_found_in(hazard, other.reading),
                other.remains,
                "{}",
                text.id
            );
        }
    }
}

/// A lost command is no hazard of the text: its follower says that it waits, and the leader may reissue.
#[test]
fn a_lost_command_is_not_waited_for_for_ever() {
    let report = &*REPORT;
    assert_eq!(report.verdict("P10"), Some(CheckVerdict::Holds));
}

const ON_ROAD: PersonFrame = PersonFrame::OnRoad(Some(0));

/// Hazard: the pictures of the paper's wording do not show who is left alone.
#[test]
fn a_street_of_the_paper_shows_a_person_whom_nobody_guards() {
    let mut found = Vec::new();
    for run in &*RUNS {
        assert_eq!(run.frames.len(), run.steps.len() + 1);
        let [first, .., last] = &run.frames[..] else {
            panic!("{}: no frames", run.text.id)
        };
        let is_on_road = run.text.id.starts_with('W');
        let waits = is_on_road.then_some(PersonFrame::Waiting);
        assert_eq!(first.person, waits, "{}", run.text.id);
        if last.person == Some(ON_ROAD) && !last.robots.iter().any(|it| it.guards) {
            let robots = last.robots.iter();
            found.push((&*run.text.id, robots.map(|it| it.body).collect::<Vec<_>>()));
        }
    }
    let expected = [
        ("W1", BodyFrame::InPosition),
        ("W1", BodyFrame::UnderWay),
        ("W2", BodyFrame::FallingBack),
    ];
    let expected = expected.map(|(id, body)| (id, vec![BodyFrame::Parked, body]));
    assert_eq!(found, expected);
    // The word to go was given once, and its leader is gone.
    let mut runs = RUNS.iter();
    let gone = &runs.find(|it| it.text.id == "W1").unwrap().frames[13].robots[0];
    assert!(gone.is_down && gone.shows_go);
}

/// Hazard: the protocol goes another way than the story beside the paper's, or leaves the person alone as well.
#[test]
fn the_kit_guards_everybody_in_the_stories_in_which_the_paper_leaves_somebody_alone() {
    let mut ends = Vec::new();
    for run in &*RUNS {
        let is_alone = run.frames.last().unwrap().person == Some(ON_ROAD);
        assert_eq!(run.beside.is_some(), is_alone, "{}", run.text.id);
        let Some(kit) = &run.beside else { continue };
        assert_eq!(kit.taken.len(), run.frames.len());
        assert_eq!(kit.taken.last(), Some(&kit.steps.len()));
        let walk = Walk::along(Scenario::load(kit.scenario).unwrap(), &kit.steps);
        assert_eq!(walk.stray, None);
        for frame in &walk.frames {
            assert!(frame.broken.is_empty(), "{:?}", frame.broken);
            let guards = frame.robots.iter().any(|it| it.guards);
            assert!(guards || frame.person == PersonFrame::Waiting);
        }
        let last = walk.frames.last().unwrap();
        let goes = last.robots.iter().any(|it| it.shows_go);
        ends.push((&*run.text.id, last.person, last.robots[1].body, goes));
    }
    let expected = [
        ("W1", PersonFrame::Waiting, BodyFrame::UnderWay, false),
        ("W1", PersonFrame::Waiting, BodyFrame::UnderWay, false),
        ("W2", ON_ROAD, BodyFrame::FallingBack, true),
    ];
    assert_eq!(ends, expected);
}

/// The studio reads these keys and kinds.
#[test]
fn a_run_is_written_flat_with_its_text() {
    let run = &serde_json::to_value(&*RUNS).unwrap()[0];
    let keys: Vec<_> = run.as_object().unwrap().keys().collect();
    let expected = "beside closedBy explanation frames id kind paragraph person repeatsAfter robots section statement steps title";
    assert_eq!(keys, expected.split(' ').collect::<Vec<_>>());
    assert_eq!(
        (&run["kind"], &run["section"]),
        (&"Silent".into(), &"III-A".into())
    );
}

const PAGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/doc/paper-literal.md");

/// The page with what the checker finds in place of what it has: the table, and the sections before P10 and from W1 on.
fn with_what_is_found(page: &str) -> String {
    let [before, rest] = parts(page, "| hazard |");
    let [_, rest] = parts(rest, "\n## P10:");
    let [between, _] = parts(rest, "\n### W1:");
    let row = |run: &PaperRun| {
        let Text {
            id,
            title,
            kind,
            passage,
            ..
        } = run.text;
        let (section, paragraph) = (&passage.section, &passage.paragraph);
        format!("| {id}: {title} | {kind:?} | {section} | {paragraph} |\n")
    };
    let rows: String = RUNS.iter().map(row).collect();
    let (on_road, others): (Vec<_>, Vec<_>) =
        RUNS.iter().partition(|it| it.text.id.starts_with('W'));
    let section = |heading, runs: Vec<&PaperRun>, how| {
        runs.into_iter()
            .map(|run| section(heading, run, how))
            .collect::<String>()
    };
    let (others, on_road) = (
        section("##", others, "Closed by"),
        section("###", on_road, "Kept by"),
    );
    let head = "| hazard | kind | section | paragraph |\n|---|---|---|---|\n";
    format!("{before}{head}{rows}{others}{between}{on_road}")
}

/// The page before a text, and the page from the text on.
fn parts<'a>(page: &'a str, text: &str) -> [&'a str; 2] {
    page.split_at(page.find(text).expect(text)).into()
}

fn section(heading: &str, run: &PaperRun, how_the_kit_answers: &str) -> String {
    let Text {
        id,
        title,
        kind,
        passage,
        explanation,
        person,
        statement,
        closed_by,
        other_reading,
    } = run.text;
    let (section, paragraph, words) = (&passage.section, &passage.paragraph, &passage.words);
    let other = other_reading.as_ref().map_or_else(String::new, |other| {
        let found = if other.remains {
            "it is found there too"
        } else {
            "it is not found there"
        };
        format!(
            "In another reading: {}. By the checker, {found}.\n\n",
            other.says
        )
    });
    let robots: Vec<_> = run.robots.iter().map(ToString::to_string).collect();
    let (steps, repeats_after) = (&*run.steps, run.repeats_after);
    let chart = Chart {
        title,
        robots: &robots,
        steps,
        repeats_after,
    };
    format!(
        "\n{heading} {id}: {title}\n\n**{kind:?}**: section {section}, {paragraph} (\"{words}\").\n\n{explanation}\n\n\
         For a person: {person}\n\n{other}Broken property: {statement}.\n\n```mermaid\n{}```\n\n\
         {how_the_kit_answers}: {closed_by}\n",
        chart.mermaid()
    )
}

#[test]
fn the_page_shows_what_the_checker_finds() {
    let page = std::fs::read_to_string(PAGE).unwrap();
    let found = with_what_is_found(&page);
    if std::env::var_os("CROSSGUARD_BLESS").is_some() {
        std::fs::write(PAGE, &found).unwrap();
        return;
    }
    assert!(
        page == found,
        "the page is not what the checker finds; run: cargo xtask bless paper-literal"
    );
}
