//! What a person types to a running robot.

use std::borrow::Cow;
use std::time::Duration;

use crossguard_codec::{
    Battery, JobRole, MapPlace, PublicSignal, SignalMeans, SignalsShown, TaskParameters,
};
use crossguard_protocol::{
    Availability, Event, HelpRequest, MAX_FOLLOWERS, State, StationId, TaskNames, TaskSet,
    TaskType, Unavailability, Urgency,
};

use crossguard_endpoint::ras::clustering::PerceivedVru;
use crossguard_robot::application::Wish;
use crossguard_robot::perception;
use crossguard_robot::robot_file::job_named;
use crossguard_robot::runtime::Order;
use crossguard_robot::site::{Place, Site};
use crossguard_robot::wall_clock::{ClockQuality, ERROR_MAX_MS};

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
    /// Its sensors have this person, at this place on the site; or they work, and have nobody.
    Perceived(Option<PerceivedVru>),
    /// Its battery is like this now.
    Battery(Battery),
    /// Its wall clock is like this.
    Clock(ClockQuality),
    /// It shows this to people.
    Show(SignalsShown),
    /// It is there for this job.
    Job(JobRole),
    /// It serves this road segment or intersection, or none of a map.
    Serve(Option<MapPlace>),
}

impl From<Tell> for Order {
    fn from(tell: Tell) -> Self {
        match tell {
            Tell::Wish(wish) => Self::Wish(wish),
            Tell::InPosition => Self::InPosition,
            Tell::Finish(well) => Self::Finish { well },
            Tell::Clear => Self::Clear,
            Tell::Perceived(vru) => Self::Perceived(vru),
            Tell::Battery(battery) => Self::Battery(battery),
            Tell::Clock(quality) => Self::Clock(quality),
            Tell::Show(signals) => Self::Show(signals),
            Tell::Job(job) => Self::Job(job),
            Tell::Serve(place) => Self::Serve(place),
        }
    }
}

/// What can be typed.
pub const HELP: &str = "\
detect [FOLLOWERS] [low|medium|high|emergency] [TASK ...]
                       a pedestrian needs help; what the plan asks for by default, or else 1 follower for
                       initialPos and move
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
battery PERCENT [charging]
                       how full the battery is; below the limit of its robot file a robot is unavailable
job ROLE               the job that its RAM says it is there for: none, traffic-guard, escort, patrol,
                       delivery, maintenance, other
serve segment|intersection [REGION:]NUMBER | none
                       the road segment or intersection that its RAM says it serves, and that the commands
                       of its plan name
clock MILLISECONDS | lost
                       how wrong the wall clock may be, as its receiver or NTP says; it holds for five minutes. While
                       it is known, packets older than their lifetime are dropped
status                 what the robot is doing, what it heard, who is around, and how link, security and clock are
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
    parse_with(text, site, None)
}

/// The same; `detect` alone is this request, that of the robot's plan.
///
/// # Errors
/// Why it means nothing.
pub fn parse_with(
    text: &str,
    site: &Site,
    planned: Option<HelpRequest>,
) -> Result<Line, Misunderstood> {
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
        ("detect", []) => {
            let request = planned.map_or_else(|| request(&[], site), Ok)?;
            tell(Event::PedestrianDetected(request))
        }
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
        ("battery", words) => battery(words),
        ("job", [name]) => job(name),
        ("job", []) => Err(Misunderstood::Missing {
            command: "job",
            wanted: "a job",
        }),
        ("serve", words) => serve(words),
        ("clock", words) => clock(words),
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
            | "leave" | "available" | "unavailable" | "wait" | "until" | "status" | "help" | "quit"
            | "job",
            [.., last],
        ) => Err(Misunderstood::Surplus((*last).to_owned())),
        (other, _) => Err(Misunderstood::Command(other.to_owned())),
    }
}

fn clock(words: &[&str]) -> Result<Line, Misunderstood> {
    let error_ms = match words {
        ["lost"] => None,
        [word] => {
            let error_ms = word
                .parse()
                .ok()
                .filter(|error_ms| *error_ms <= ERROR_MAX_MS);
            let wanted = || format!("'lost', or an error from 0 to {ERROR_MAX_MS} ms");
            Some(error_ms.ok_or_else(|| wrong(word, wanted()))?)
        }
        [] => {
            return Err(Misunderstood::Missing {
                command: "clock",
                wanted: "its error in ms, or 'lost'",
            });
        }
        [.., last] => return Err(Misunderstood::Surplus((*last).to_owned())),
    };
    Ok(Line::Order(Tell::Clock(ClockQuality { error_ms })))
}

fn battery(words: &[&str]) -> Result<Line, Misunderstood> {
    let (percent, charging) = match words {
        [percent] => (percent, false),
        [percent, "charging"] => (percent, true),
        [_, other] => return Err(wrong(other, "'charging'")),
        [] => {
            return Err(Misunderstood::Missing {
                command: "battery",
                wanted: "a charge in percent",
            });
        }
        [.., last] => return Err(Misunderstood::Surplus((*last).to_owned())),
    };
    let charge = number(percent).filter(|charge| (0.0..=100.0).contains(charge));
    let charge = charge.ok_or_else(|| wrong(percent, "a charge from 0 to 100 percent"))?;
    Ok(Line::Order(Tell::Battery(Battery {
        state_of_charge: Some(charge),
        charging,
    })))
}

fn job(name: &str) -> Result<Line, Misunderstood> {
    let job = job_named(name).ok_or_else(|| wrong(name, "a job; see 'help'"))?;
    Ok(Line::Order(Tell::Job(job)))
}

fn serve(words: &[&str]) -> Result<Line, Misunderstood> {
    let place = match words {
        ["none"] => None,
        [kind, reference] => Some(map_place(kind, reference)?),
        [] => {
            return Err(Misunderstood::Missing {
                command: "serve",
                wanted: "a road segment, an intersection, or none",
            });
        }
        [only] => return Err(wrong(only, MAP_PLACE)),
        [.., last] => return Err(Misunderstood::Surplus((*last).to_owned())),
    };
    Ok(Line::Order(Tell::Serve(place)))
}

/// What a place of the map is like.
const MAP_PLACE: &str =
    "a road segment or intersection, like 'segment 276:12' or 'intersection 4711'";

fn map_place(kind: &str, reference: &str) -> Result<MapPlace, Misunderstood> {
    let text = format!("{kind} {reference}");
    text.parse().map_err(|_| wrong(&text, MAP_PLACE))
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
                let wanted = format!("a number of followers from 1 to {MAX_FOLLOWERS}");
                return Err(wrong(word, wanted));
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
            (rest, Some(map_place(kind, reference)?))
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
mod tests;
