use crossguard_codec::{MapPlace, PublicSignal, SignalMeans, SignalsShown, TaskParameters};
use crossguard_endpoint::Stimulus;
use crossguard_protocol::{Event, StationId, TaskNames, TaskSet, TaskType, Urgency};

use super::*;
use crate::site::Place;
use crate::table::rows;

fn parsed(text: &str) -> Result<Line, String> {
    parse(text, &Site::default(), None).map_err(|error| error.to_string())
}

#[test]
fn each_command_is_an_order() {
    let site = Site::default();
    let detect = |followers, urgency, tasks: &[TaskType]| {
        Order::Tell(Stimulus::Event(Event::PedestrianDetected(HelpRequest {
            urgency,
            followers,
            tasks: TaskSet::of(tasks),
            place: site.crossing,
        })))
    };
    let order = |parameters| {
        Order::Tell(Stimulus::Command {
            follower: StationId(2),
            task: TaskType::MOVE,
            parameters,
        })
    };
    let there = TaskParameters {
        target: Some(site.target(Place::new(1.0, 8.0))),
        maximum_speed: Some(0.4),
        ..TaskParameters::default()
    };
    let (region, id) = (Some(276), 12);
    let segment = Some(MapPlace::RoadSegment { region, id });
    let (region, id) = (None, 4_711);
    let intersection = Some(MapPlace::Intersection { region, id });
    let at = |map_place, parameters| {
        order(TaskParameters {
            map_place,
            ..parameters
        })
    };
    let show = |to_vehicles, to_pedestrians, means| {
        Order::Show(SignalsShown {
            to_vehicles,
            to_pedestrians,
            means,
        })
    };
    let (none, stop, go) = (PublicSignal::None, PublicSignal::Stop, PublicSignal::Go);
    let by_voice = SignalMeans::GESTURE.union(SignalMeans::SPEECH);
    let plain = [TaskType::INITIAL_POS, TaskType::MOVE];
    for (text, expected) in [
        ("detect", detect(1, Urgency::Medium, &plain)),
        (
            "detect 2 high block # at school",
            detect(2, Urgency::High, &[TaskType::BLOCK]),
        ),
        ("order 2 move", order(TaskParameters::default())),
        ("order 2 move 1 8 0.4", order(there)),
        (
            "order 2 move segment 276:12",
            at(segment, TaskParameters::default()),
        ),
        (
            "order 2 move 1 8 0.4 intersection 4711",
            at(intersection, there),
        ),
        ("show stop", show(stop, none, SignalMeans(0))),
        ("show none stop", show(none, stop, SignalMeans(0))),
        ("show stop gesture speech", show(stop, none, by_voice)),
        (
            "show go caution display",
            show(go, PublicSignal::Caution, SignalMeans::DISPLAY),
        ),
        ("serve none", Order::Serve(None)),
        ("serve intersection 4711", Order::Serve(intersection)),
        ("done", Order::Finish { well: true }),
        ("fail", Order::Finish { well: false }),
        ("clear", Order::Clear),
    ] {
        assert_eq!(parsed(text), Ok(Line::Order(expected)), "{text}");
    }
    for text in ["", "   ", "# nothing", "  # nothing"] {
        assert_eq!(parsed(text), Ok(Line::Blank));
    }
}

/// A line that means nothing, and what is said of it.
const MISUNDERSTOOD: &str = r#"
fly                 | no command 'fly'; type 'help'
unavailable         | 'unavailable' wants a reason
unavailable bored   | 'bored' is not a reason to be unavailable; see 'help'
detect 17           | '17' is not a number of followers from 1 to 16
detect soon         | 'soon' is not a task: TASKS
order 2             | 'order' wants a station and a task
order two move      | 'two' is not a station id
order 2 move 1      | '1' is not a place: two numbers of metres are
order 2 move 1 8 -1 | '-1' is not a speed in m/s
battery             | 'battery' wants a charge in percent
battery 120         | '120' is not a charge from 0 to 100 percent
battery 20 full     | 'full' is not 'charging'
job                 | 'job' wants a job
job king            | 'king' is not a job; see 'help'
job patrol 2        | '2' is one word too many
serve               | 'serve' wants a road segment, an intersection, or none
serve bridge 3      | 'bridge 3' is not a road segment or intersection, like 'segment 276:12' or 'intersection 4711'
show                | 'show' wants what is shown to vehicles
show hello          | 'hello' is not none, stop, go or caution
show stop go        | 'go' is not for pedestrians here; 'open' opens the corridor
show stop stop whistle | 'whistle' is not gesture, display, lights or speech
wait long           | 'long' is not a number of seconds up to a day
wait inf            | 'inf' is not a number of seconds up to a day
until done          | 'done' is not a state; see 'help'
quit now            | 'now' is one word too many
help fly            | no command 'fly'; type 'help'
order 2 move segment 70000 | 'segment 70000' is not a road segment or intersection, like 'segment 276:12' or 'intersection 4711'
{"id": 1, "position_m": [1, 2], "at_s": 3} | frames and at_s are for files of --perceived; here 'wait' does it
"#;

#[test]
fn what_means_nothing_is_answered_with_what_would() {
    for [text, answer] in rows(MISUNDERSTOOD) {
        let answer = answer.replace("TASKS", &TaskNames.to_string());
        assert_eq!(parsed(&text), Err(answer), "{text}");
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
}
