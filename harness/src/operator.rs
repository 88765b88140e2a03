//! What a person types to a running robot.

use std::borrow::Cow;
use std::time::Duration;

use crossguard_codec::{PublicSignal, SignalMeans, SignalsShown, TaskParameters};
use crossguard_protocol::{
    Availability, Event, HelpRequest, MAX_FOLLOWERS, State, StationId, TaskNames, TaskSet,
    TaskType, Unavailability, Urgency,
};

use crossguard_endpoint::ras::clustering::PerceivedVru;
use crossguard_robot::application::Wish;
use crossguard_robot::perception;
use crossguard_robot::runtime::Order;
use crossguard_robot::site::{Place, Site};

/// A line that was typed.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Line {
    /// Tell the robot this.
    Order(Tell),
    /// Wait so long before the next line.
    Wait(Duration),
    /// Wait until the robot is in this state, but no longer than this.
    Until(State, Duration),
    /// Print what the robot is doing.
    Status,
    /// Print what can be typed.
    Help,
    /// Leave the session in order and stop.
    Quit,
    /// Nothing but a comment.
    Blank,
}

/// What the robot is told.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Tell {
    /// A wish of its application.
    Wish(Wish),
    /// The body holds the place from which the maneuver that runs guards.
    InPosition,
    /// The maneuver that runs is finished, well or not; or the fallback that runs.
    Finish(bool),
    /// The road is clear.
    Clear,
    /// Its sensors have this person, at this place on the site.
    Perceived(PerceivedVru),
    /// It shows this to people.
    Show(SignalsShown),
}

impl From<Tell> for Order {
    fn from(tell: Tell) -> Self {
        match tell {
            Tell::Wish(wish) => Self::Wish(wish),
            Tell::InPosition => Self::InPosition,
            Tell::Finish(well) => Self::Finish { well },
            Tell::Clear => Self::Clear,
            Tell::Perceived(vru) => Self::Perceived(vru),
            Tell::Show(signals) => Self::Show(signals),
        }
    }
}

/// What can be typed.
pub const HELP: &str = "\
detect [FOLLOWERS] [low|medium|high|emergency] [TASK ...]
                       a pedestrian needs help; 1 follower for initialPos and move by default
order STATION TASK [EAST NORTH [SPEED]] [segment|intersection [REGION:]NUMBER]
                       have a follower do a maneuver, in metres and m/s, at this road segment or
                       intersection of the map; map_place or crossing of the configuration by default
show VEHICLES [PEDESTRIANS] [gesture] [display] [lights] [speech]
                       what the robot shows to whom, for its RAM: none, stop, go, caution; to pedestrians
                       go is for the corridor alone; the means are those of the configuration by default
in-position            the body is at the place from which it guards
done | fail            the maneuver that runs is finished, or cannot be; done also ends a fallback
open | close           open or close the corridor
task-completed         the pedestrian has crossed, and nobody is on the road
clear                  nobody is on the road any more: ends the duty of a robot that fell back or gave up,
                       once its body has finished its fallback
leave                  leave the session
unavailable REASON     low-battery, teleoperated, emergency-stop, local-fault, not-safe
available              take part again
status                 what the robot is doing
wait SECONDS           before the next line
until STATE [SECONDS]  wait for idle, help-requested, role-established or maneuver-executing
{\"id\": N, \"position_m\": [EAST, NORTH], \"velocity_mps\": [1, 0], \"class\": \"pedestrian\",
 \"confidence\": 0.9}    the sensors have this person now; only id and position_m are needed
help                   this
quit                   leave the session and stop
TASK is initialPos, move, block, or task3 to task15. What follows a # is a comment.";

/// Why a line means nothing.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Misunderstood {
    /// There is no such command.
    #[error("no command '{0}'; type 'help'")]
    Command(String),
    /// A word is missing.
    #[error("'{command}' wants {wanted}")]
    Missing {
        /// The command.
        command: &'static str,
        /// What it wants.
        wanted: &'static str,
    },
    /// A word means nothing here.
    #[error("'{word}' is not {wanted}")]
    Word {
        /// The word.
        word: String,
        /// What was wanted in its place.
        wanted: Cow<'static, str>,
    },
    /// It is no person.
    #[error("{0}")]
    Person(String),
    /// There are more words than the command takes.
    #[error("'{0}' is one word too many")]
    Surplus(String),
}

/// Understands a line. Places in it are on `site`.
///
/// # Errors
/// Why it means nothing.
pub fn parse(text: &str, site: &Site) -> Result<Line, Misunderstood> {
    if text.trim_start().starts_with('{') {
        return person(text);
    }
    let text = text.split('#').next().unwrap_or_default();
    let mut words = text.split_whitespace();
    let Some(command) = words.next() else {
        return Ok(Line::Blank);
    };
    let rest: Vec<&str> = words.collect();
    let tell = |event| Ok(Line::Order(Tell::Wish(Wish::Tell(event))));
    match (command, rest.as_slice()) {
        ("detect", words) => tell(Event::PedestrianDetected(request(words, site)?)),
        ("order", words) => order(words, site),
        ("show", words) => show(words),
        ("in-position", []) => Ok(Line::Order(Tell::InPosition)),
        ("clear", []) => Ok(Line::Order(Tell::Clear)),
        ("done", []) => Ok(Line::Order(Tell::Finish(true))),
        ("fail", []) => Ok(Line::Order(Tell::Finish(false))),
        ("open", []) => tell(Event::OpenCorridor),
        ("close", []) => tell(Event::CloseCorridor),
        ("task-completed", []) => tell(Event::TaskCompleted),
        ("leave", []) => tell(Event::LeaveRequested),
        ("available", []) => tell(Event::AvailabilityChanged(Availability::Available)),
        ("unavailable", [reason]) => {
            let reason = Availability::Unavailable(unavailability(reason)?);
            tell(Event::AvailabilityChanged(reason))
        }
        ("unavailable", []) => Err(Misunderstood::Missing {
            command: "unavailable",
            wanted: "a reason",
        }),
        ("wait", [time]) => Ok(Line::Wait(seconds(time)?)),
        ("wait", []) => Err(Misunderstood::Missing {
            command: "wait",
            wanted: "seconds",
        }),
        ("until", [name]) => Ok(Line::Until(state(name)?, Duration::from_mins(1))),
        ("until", [name, time]) => Ok(Line::Until(state(name)?, seconds(time)?)),
        ("until", []) => Err(Misunderstood::Missing {
            command: "until",
            wanted: "a state",
        }),
        ("status", []) => Ok(Line::Status),
        ("help", []) => Ok(Line::Help),
        ("quit", []) => Ok(Line::Quit),
        (
            "in-position" | "done" | "fail" | "clear" | "open" | "close" | "task-completed"
            | "leave" | "available" | "unavailable" | "wait" | "until" | "status" | "help" | "quit",
            [.., last],
        ) => Err(Misunderstood::Surplus((*last).to_owned())),
        (other, _) => Err(Misunderstood::Command(other.to_owned())),
    }
}

fn person(text: &str) -> Result<Line, Misunderstood> {
    match perception::parse(text) {
        Ok(observation) if observation.at_s.is_some() => Err(Misunderstood::Person(
            "at_s is for files of --perceived; here 'wait' does it".to_owned(),
        )),
        Ok(observation) => Ok(Line::Order(Tell::Perceived(observation.vru))),
        Err(error) => Err(Misunderstood::Person(error.to_string())),
    }
}

fn request(words: &[&str], site: &Site) -> Result<HelpRequest, Misunderstood> {
    let mut request = HelpRequest {
        urgency: Urgency::Medium,
        followers: 1,
        tasks: TaskSet::of(&[TaskType::INITIAL_POS, TaskType::MOVE]),
        place: site.crossing,
    };
    let mut tasks = Vec::new();
    for (i, word) in words.iter().enumerate() {
        if i == 0
            && let Ok(followers) = word.parse()
        {
            if followers == 0 || usize::from(followers) > MAX_FOLLOWERS {
                return Err(wrong(word, "a number of followers from 1 to 4"));
            }
            request.followers = followers;
        } else if let Some(urgency) = urgency(word) {
            request.urgency = urgency;
        } else {
            tasks.push(task(word)?);
        }
    }
    if !tasks.is_empty() {
        request.tasks = TaskSet::of(&tasks);
    }
    Ok(request)
}

fn order(words: &[&str], site: &Site) -> Result<Line, Misunderstood> {
    let [station, name, rest @ ..] = words else {
        return Err(Misunderstood::Missing {
            command: "order",
            wanted: "a station and a task",
        });
    };
    let follower = StationId(
        station
            .parse()
            .map_err(|_| wrong(station, "a station id"))?,
    );
    let (rest, map_place) = match rest {
        [rest @ .., kind @ ("segment" | "intersection"), reference] => {
            let text = format!("{kind} {reference}");
            let wanted =
                "a road segment or intersection, like 'segment 276:12' or 'intersection 4711'";
            let place = text.parse().map_err(|_| wrong(&text, wanted))?;
            (rest, Some(place))
        }
        rest => (rest, site.map_place),
    };
    let metres = |word: &str| number(word).ok_or_else(|| wrong(word, "a number of metres"));
    let (target, maximum_speed) = match rest {
        [] => (None, None),
        [east, north] => (Some(Place::new(metres(east)?, metres(north)?)), None),
        [east, north, speed] => {
            let target = Place::new(metres(east)?, metres(north)?);
            let speed = number(speed).filter(|speed| *speed > 0.0);
            (
                Some(target),
                Some(speed.ok_or_else(|| wrong(rest[2], "a speed in m/s"))?),
            )
        }
        [only] => return Err(wrong(only, "a place: two numbers of metres are")),
        [.., last] => return Err(Misunderstood::Surplus((*last).to_owned())),
    };
    let target = target.map(|place| site.target(place));
    let parameters = TaskParameters {
        target,
        maximum_speed,
        map_place,
        ..TaskParameters::default()
    };
    Ok(Line::Order(Tell::Wish(Wish::Order {
        follower,
        task: task(name)?,
        parameters,
    })))
}

fn show(words: &[&str]) -> Result<Line, Misunderstood> {
    let [vehicles, rest @ ..] = words else {
        return Err(Misunderstood::Missing {
            command: "show",
            wanted: "what is shown to vehicles",
        });
    };
    let to_vehicles =
        signal(vehicles).ok_or_else(|| wrong(vehicles, "none, stop, go or caution"))?;
    let (to_pedestrians, rest) = match rest {
        ["go", ..] => {
            return Err(wrong(
                "go",
                "for pedestrians here; 'open' opens the corridor",
            ));
        }
        [word, others @ ..] => signal(word).map_or((PublicSignal::None, rest), |it| (it, others)),
        [] => (PublicSignal::None, rest),
    };
    let means = rest
        .iter()
        .try_fold(SignalMeans::default(), |means, word| {
            let one =
                means_of(word).ok_or_else(|| wrong(word, "gesture, display, lights or speech"))?;
            Ok(means.union(one))
        })?;
    Ok(Line::Order(Tell::Show(SignalsShown {
        to_vehicles,
        to_pedestrians,
        means,
    })))
}

fn signal(name: &str) -> Option<PublicSignal> {
    use PublicSignal::{Caution, Go, None, Stop};
    [None, Stop, Go, Caution]
        .into_iter()
        .find(|signal| signal.to_string() == name)
}

fn means_of(name: &str) -> Option<SignalMeans> {
    match name {
        "gesture" => Some(SignalMeans::GESTURE),
        "display" => Some(SignalMeans::DISPLAY),
        "lights" => Some(SignalMeans::LIGHTS),
        "speech" => Some(SignalMeans::SPEECH),
        _ => None,
    }
}

fn wrong(word: &str, wanted: impl Into<Cow<'static, str>>) -> Misunderstood {
    Misunderstood::Word {
        word: word.to_owned(),
        wanted: wanted.into(),
    }
}

fn number(word: &str) -> Option<f64> {
    word.parse().ok().filter(|number: &f64| number.is_finite())
}

fn seconds(word: &str) -> Result<Duration, Misunderstood> {
    let seconds = number(word).filter(|seconds| (0.0..=86_400.0).contains(seconds));
    seconds
        .map(Duration::from_secs_f64)
        .ok_or_else(|| wrong(word, "a number of seconds up to a day"))
}

fn task(name: &str) -> Result<TaskType, Misunderstood> {
    let task = TaskSet(u16::MAX)
        .iter()
        .find(|task| task.to_string() == name);
    task.ok_or_else(|| wrong(name, format!("a task: {TaskNames}")))
}

fn urgency(name: &str) -> Option<Urgency> {
    let all = [
        Urgency::Low,
        Urgency::Medium,
        Urgency::High,
        Urgency::Emergency,
    ];
    all.into_iter().find(|urgency| urgency.to_string() == name)
}

fn unavailability(name: &str) -> Result<Unavailability, Misunderstood> {
    let all = [
        Unavailability::LowBattery,
        Unavailability::Teleoperated,
        Unavailability::EmergencyStop,
        Unavailability::LocalFault,
        Unavailability::NotSafe,
    ];
    let reason = all
        .into_iter()
        .find(|reason| reason.to_string().replace(' ', "-") == name);
    reason.ok_or_else(|| wrong(name, "a reason to be unavailable; see 'help'"))
}

fn state(name: &str) -> Result<State, Misunderstood> {
    match name {
        "idle" => Ok(State::Idle),
        "help-requested" => Ok(State::HelpRequested),
        "role-established" => Ok(State::RoleEstablished),
        "maneuver-executing" => Ok(State::ManeuverExecuting),
        _ => Err(wrong(name, "a state; see 'help'")),
    }
}

#[cfg(test)]
mod tests {
    use crossguard_codec::MapPlace;

    use super::*;

    fn parsed(text: &str) -> Result<Line, String> {
        parse(text, &Site::default()).map_err(|error| error.to_string())
    }

    fn told(text: &str) -> Event {
        match parsed(text) {
            Ok(Line::Order(Tell::Wish(Wish::Tell(event)))) => event,
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
        let Ok(Line::Order(Tell::Wish(Wish::Order {
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
            Ok(Line::Order(Tell::Wish(Wish::Order { parameters, .. }))) => parameters.map_place,
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
            Ok(Line::Order(Tell::Show(signals))) => signals,
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
            ("detect 5", "'5' is not a number of followers from 1 to 4"),
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
        let Ok(Line::Order(Tell::Perceived(vru))) = line else {
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
            "status",
            "wait 1",
            "until idle 3",
            "help",
            "quit",
        ] {
            assert!(parsed(text).is_ok(), "{text}");
            assert!(HELP.contains(text.split(' ').next().unwrap()), "{text}");
        }
    }
}
