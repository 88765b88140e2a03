use crossguard_codec::{MapPlace, PublicSignal, SignalMeans, SignalsShown};
use crossguard_protocol::{Event, TaskNames, TaskSet, TaskType, Urgency};

use super::*;
use crate::application::Wish;
use crate::site::Place;

fn parsed(text: &str) -> Result<Line, String> {
    parse(text, &Site::default()).map_err(|error| error.to_string())
}

fn told(text: &str) -> Event {
    match parsed(text) {
        Ok(Line::Order(Order::Wish(Wish::Tell(event)))) => event,
        other => panic!("{text}: {other:?}"),
    }
}

#[test]
fn a_detection_has_defaults_and_takes_what_is_said() {
    let Event::PedestrianDetected(plain) = told("detect") else {
        panic!()
    };
    assert_eq!((plain.followers, plain.urgency), (1, Urgency::Medium));
    let Event::PedestrianDetected(full) = told("detect 2 high block # at school") else {
        panic!()
    };
    assert_eq!((full.followers, full.urgency), (2, Urgency::High));
    assert_eq!(full.tasks, TaskSet::of(&[TaskType::BLOCK]));
}

#[test]
fn an_order_may_lead_somewhere_at_some_speed() {
    let Ok(Line::Order(Order::Wish(Wish::Order {
        follower,
        task,
        parameters,
    }))) = parsed("order 2 move 1 8 0.4")
    else {
        panic!("not an order")
    };
    assert_eq!((follower, task), (StationId(2), TaskType::MOVE));
    assert_eq!(parameters.maximum_speed, Some(0.4));
    assert_eq!(
        parameters.target,
        Some(Site::default().target(Place::new(1.0, 8.0)))
    );
}

#[test]
fn an_order_may_name_a_place_of_the_map() {
    let place_of = |text| match parsed(text) {
        Ok(Line::Order(Order::Wish(Wish::Order { parameters, .. }))) => parameters.map_place,
        other => panic!("{text}: {other:?}"),
    };
    let segment = MapPlace::RoadSegment {
        region: Some(276),
        id: 12,
    };
    let intersection = MapPlace::Intersection {
        region: None,
        id: 4_711,
    };
    assert_eq!(place_of("order 2 move segment 276:12"), Some(segment));
    assert_eq!(
        place_of("order 2 move 1 8 0.4 intersection 4711"),
        Some(intersection)
    );
    assert_eq!(place_of("order 2 move 1 8"), None);
    let refused = parsed("order 2 move segment 70000").unwrap_err();
    assert!(
        refused.contains("'segment 70000' is not a road segment"),
        "{refused}"
    );
}

#[test]
fn what_is_shown_to_whom_and_how_can_be_said() {
    let shown = |text| match parsed(text) {
        Ok(Line::Order(Order::Show(signals))) => signals,
        other => panic!("{text}: {other:?}"),
    };
    let expected = |to_vehicles, to_pedestrians, means| SignalsShown {
        to_vehicles,
        to_pedestrians,
        means,
    };
    let (none, stop) = (PublicSignal::None, PublicSignal::Stop);
    let by_voice = SignalMeans::GESTURE.union(SignalMeans::SPEECH);
    assert_eq!(shown("show stop"), expected(stop, none, SignalMeans(0)));
    assert_eq!(
        shown("show none stop"),
        expected(none, stop, SignalMeans(0))
    );
    assert_eq!(
        shown("show stop gesture speech"),
        expected(stop, none, by_voice)
    );
    let caution = shown("show go caution display");
    assert_eq!(
        caution,
        expected(
            PublicSignal::Go,
            PublicSignal::Caution,
            SignalMeans::DISPLAY
        )
    );
}

#[test]
fn what_means_nothing_is_answered_with_what_would() {
    for (text, answer) in [
        ("fly", "no command 'fly'; type 'help'"),
        ("unavailable", "'unavailable' wants a reason"),
        (
            "unavailable bored",
            "'bored' is not a reason to be unavailable; see 'help'",
        ),
        (
            "detect 17",
            "'17' is not a number of followers from 1 to 16",
        ),
        (
            "detect soon",
            format!("'soon' is not a task: {TaskNames}").as_str(),
        ),
        ("order 2", "'order' wants a station and a task"),
        ("order two move", "'two' is not a station id"),
        (
            "order 2 move 1",
            "'1' is not a place: two numbers of metres are",
        ),
        ("order 2 move 1 8 -1", "'-1' is not a speed in m/s"),
        ("battery", "'battery' wants a charge in percent"),
        ("battery 120", "'120' is not a charge from 0 to 100 percent"),
        ("clock", "'clock' wants its error in ms, or 'lost'"),
        (
            "clock 10001",
            "'10001' is not 'lost', or an error from 0 to 10000 ms",
        ),
        ("battery 20 full", "'full' is not 'charging'"),
        ("job", "'job' wants a job"),
        ("job king", "'king' is not a job; see 'help'"),
        ("job patrol 2", "'2' is one word too many"),
        (
            "serve",
            "'serve' wants a road segment, an intersection, or none",
        ),
        (
            "serve bridge 3",
            "'bridge 3' is not a road segment or intersection, like 'segment 276:12' or 'intersection 4711'",
        ),
        ("show", "'show' wants what is shown to vehicles"),
        ("show hello", "'hello' is not none, stop, go or caution"),
        (
            "show stop go",
            "'go' is not for pedestrians here; 'open' opens the corridor",
        ),
        (
            "show stop stop whistle",
            "'whistle' is not gesture, display, lights or speech",
        ),
        ("wait long", "'long' is not a number of seconds up to a day"),
        ("wait inf", "'inf' is not a number of seconds up to a day"),
        ("until done", "'done' is not a state; see 'help'"),
        ("quit now", "'now' is one word too many"),
        (
            r#"{"id": 1, "position_m": [1, 2], "at_s": 3}"#,
            "at_s is for files of --perceived; here 'wait' does it",
        ),
    ] {
        assert_eq!(parsed(text), Err(answer.to_owned()), "{text}");
    }
}

#[test]
fn a_person_whom_the_sensors_have_is_a_line_of_json() {
    let line = parsed(r#" {"id": 7, "position_m": [3.0, -1.5]} "#);
    let Ok(Line::Order(Order::Perceived(Some(vru)))) = line else {
        panic!("{line:?}")
    };
    assert_eq!((vru.id, vru.position_m), (7, [3.0, -1.5]));
    assert!(parsed("{}").unwrap_err().contains("a person is like"));
}

#[test]
fn comments_and_blank_lines_are_passed_over() {
    for text in ["", "   ", "# nothing", "  # nothing"] {
        assert_eq!(parsed(text), Ok(Line::Blank));
    }
}

#[test]
fn everything_that_the_help_names_is_understood() {
    for text in [
        "detect 1 low move",
        "order 1 block segment 12",
        "show stop caution lights",
        "in-position",
        "clear",
        "done",
        "fail",
        "open",
        "close",
        "task-completed",
        "leave",
        "unavailable low-battery",
        "available",
        "battery 64 charging",
        "job escort",
        "serve intersection 276:4711",
        "serve none",
        "clock 5",
        "clock lost",
        "status",
        "wait 1",
        "until idle 3",
        "help",
        "quit",
    ] {
        assert!(parsed(text).is_ok(), "{text}");
    }
}

#[test]
fn the_help_has_every_command_in_80_columns() {
    let all = help(None);
    for command in COMMANDS {
        let beginning = format!("{} {}", command.name, command.usage);
        let lines = || {
            all.lines()
                .filter(|line| line.starts_with(beginning.trim_end()))
        };
        assert!(lines().count() > 0, "{}", command.name);
        let Ok(Line::Help(Some(name))) = parsed(&format!("help {}", command.name)) else {
            panic!("no help for {}", command.name)
        };
        assert!(all.contains(&help(Some(name))) && !help(Some(name)).is_empty());
    }
    assert!(all.lines().all(|line| line.len() <= WIDTH), "{all}");
    assert_eq!(
        parsed("help fly"),
        Err("no command 'fly'; type 'help'".into())
    );
}

/// What the last word of this text can become.
fn completed(text: &str) -> String {
    complete(text, &[StationId(2), StationId(31)]).1.join(" ")
}

#[test]
fn words_are_completed_by_what_can_stand_there() {
    for (text, words) in [
        ("o", "order open"),
        ("  det", "detect"),
        ("order ", "2 31"),
        ("order 2 b", "block"),
        ("order 2 block i", "intersection"),
        ("order 2 block 1 8 0.4 s", "segment"),
        ("detect 2 h", "high"),
        ("detect high in", "initialPos"),
        ("show stop g", "gesture"),
        ("show g", "go"),
        ("show stop none s", "speech"),
        ("unavailable l", "low-battery local-fault"),
        ("until r", "role-established"),
        ("job t", "traffic-guard"),
        ("battery 60 ", "charging"),
        ("serve n", "none"),
        ("help unt", "until"),
        ("open ", ""),
        ("job escort ", ""),
        ("fly h", ""),
        ("# o", ""),
        ("{\"id", ""),
    ] {
        assert_eq!(completed(text), words, "{text}");
    }
    assert_eq!(complete("order 2 b", &[]).0, 8, "where the word begins");
    assert_eq!(
        complete("ä\u{3000}o", &[]).0,
        5,
        "also between characters of several bytes"
    );
}

/// A name that completion offers and the parser does not know would be in two lists.
#[test]
fn whatever_completion_offers_is_understood() {
    let mut offers = 0;
    for command in COMMANDS {
        let mut lines = vec![command.name.to_owned()];
        for _ in 0..3 {
            lines = lines
                .iter()
                .flat_map(|line| {
                    let (_, words) = complete(&format!("{line} "), &[StationId(2)]);
                    words.into_iter().map(move |word| format!("{line} {word}"))
                })
                .take(500)
                .collect();
            for line in &lines {
                offers += 1;
                let last = line.rsplit(' ').next().unwrap();
                let is_refused = match parse(line, &Site::default()) {
                    Err(Misunderstood::Word { word, .. } | Misunderstood::Surplus(word)) => {
                        word == last
                    }
                    Err(Misunderstood::Command(_)) => true,
                    _ => false,
                };
                // It begins what needs a number after it.
                let begins = [words::SEGMENT, words::INTERSECTION].contains(&last);
                assert!(!is_refused || begins, "{line}");
            }
        }
    }
    assert!(offers > 500);
}
