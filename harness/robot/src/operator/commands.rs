//! The commands that can be typed.

use std::time::Duration;

use crate::runtime::Order;
use crate::site::{Place, Site};
use crossguard_codec::{Battery, PublicSignal, SignalMeans, SignalsShown, TaskParameters};
use crossguard_endpoint::Stimulus;
use crossguard_protocol::{
    Availability, Event, HelpRequest, MAX_FOLLOWERS, StationId, TaskSet, TaskType, Urgency,
};

use super::port::order_of;
use super::words::{
    CHARGING, INTERSECTION, MAP_PLACE, NONE, SEGMENT, event_names, event_of, job, map_place, means,
    nothing, number, only, seconds, signal, state, surplus, task, unavailability, urgency, wrong,
};
use super::{Line, Misunderstood};

/// Context of the words of a line.
pub(super) struct Scope<'a> {
    pub(super) site: &'a Site,
    /// Request of `detect` alone.
    pub(super) planned: Option<HelpRequest>,
}

/// A command, with its words for people.
#[derive(serde::Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Command {
    /// Its name, the first word of a line.
    pub name: &'static str,
    /// The words after its name; empty where there are none.
    pub usage: &'static str,
    /// Its effect.
    pub meaning: &'static str,
    /// Its consequence for a person on the road; `None` for a command of the console alone.
    pub on_road: Option<&'static str>,
    #[serde(skip)]
    pub(super) parse: fn(&[&str], &Scope<'_>) -> Result<Line, Misunderstood>,
}

impl Command {
    /// The commands that [the port](super::port) takes from other programs.
    pub fn of_programs() -> impl Iterator<Item = &'static Self> {
        COMMANDS.iter().filter(|it| it.on_road.is_some())
    }

    pub(super) fn named(name: &str) -> Option<&'static Self> {
        COMMANDS.iter().find(|it| it.name == name)
    }

    const fn new(
        name: &'static str,
        meaning: &'static str,
        parse: fn(&[&str], &Scope<'_>) -> Result<Line, Misunderstood>,
    ) -> Self {
        Self {
            name,
            usage: "",
            meaning,
            on_road: None,
            parse,
        }
    }

    const fn taking(self, usage: &'static str) -> Self {
        Self { usage, ..self }
    }

    const fn on_road(self, consequence: &'static str) -> Self {
        Self {
            on_road: Some(consequence),
            ..self
        }
    }
}

pub(super) const COMMANDS: &[Command] = &[
    Command::new(
        "detect",
        "a pedestrian needs help; what the plan asks for by default, or else 1 follower for initialPos and move",
        detect,
    )
    .taking("[FOLLOWERS] [low|medium|high|emergency] [TASK ...]")
    .on_road("the sign shows go only once every guard is engaged"),
    Command::new(
        "order",
        "have a follower do a maneuver, in metres and m/s, at this road segment or intersection of the map; \
         map_place or crossing of the configuration by default",
        order,
    )
    .taking("STATION TASK [EAST NORTH [SPEED]] [segment|intersection [REGION:]NUMBER]")
    .on_road("a leader orders no guard away while somebody may be on the road"),
    Command::new(
        "show",
        "the signals to vehicles and to pedestrians that its RAM tells of: none, stop, go, caution; only an open corridor \
         shows go to pedestrians; the means are those of the configuration by default",
        show,
    )
    .taking("VEHICLES [PEDESTRIANS] [gesture] [display] [lights] [speech]")
    .on_road("a RAM that shows go to vehicles while a person is on the road invites them to drive at the person"),
    Command::new(
        "in-position",
        "the body is at the place from which it guards",
        |words, _| nothing(words).map(|()| Line::Order(Order::InPosition)),
    )
    .on_road("the leader lets people on the road by it: say it only when the body is there"),
    Command::new(
        "out-of-position",
        "the body is not at that place any more",
        |words, _| nothing(words).map(|()| Line::Order(Order::OutOfPosition)),
    )
    .on_road("the corridor closes; a person who is on the road crosses without this guard in its place"),
    Command::new(
        "person-on-road",
        "somebody is on the road: this robot stays until 'clear', whatever its sensors say and however the session ends",
        |words, _| event(words, Event::PersonOnRoad),
    )
    .on_road("this robot guards the person until 'clear'"),
    Command::new(
        "done",
        "the maneuver that runs is finished, or the fallback that runs",
        |words, _| nothing(words).map(|()| Line::Order(Order::Finish { well: true })),
    )
    .on_road("a guard that has finished guards nobody, and its leader closes the corridor"),
    Command::new("fail", "the maneuver that runs cannot be finished", |words, _| {
        nothing(words).map(|()| Line::Order(Order::Finish { well: false }))
    })
    .on_road("a guard that has failed guards nobody, and its leader closes the corridor"),
    Command::new("open", "open the corridor", |words, _| {
        event(words, Event::OpenCorridor)
    })
    .on_road("the sign shows go while every guard is engaged: people step on the road"),
    Command::new(
        "close",
        "close the corridor: it stays closed until 'open', or the end of the session",
        |words, _| event(words, Event::CloseCorridor),
    )
    .on_road("the sign shows stop; the guards stay for people who are on the road"),
    Command::new(
        "task-completed",
        "the pedestrian has crossed, and nobody is on the road",
        |words, _| event(words, Event::TaskCompleted),
    )
    .on_road("it takes the guards off the road: say it only when you see nobody on the road"),
    Command::new(
        "clear",
        "nobody is on the road any more: ends the duty of a robot that fell back or gave up, once its body has \
         finished its fallback",
        |words, _| nothing(words).map(|()| Line::Order(Order::Clear)),
    )
    .on_road("the robot counts the road as clear, ends its duty and may leave: say it only when you see nobody on the road"),
    Command::new("tell", "an event of the protocol that comes with nothing, by its name in JSON", told)
        .taking("EVENT")
    .on_road("that of the event; roadClear and taskCompleted take guards off the road"),
    Command::new("leave", "leave the session", |words, _| {
        event(words, Event::LeaveRequested)
    })
    .on_road("the corridor closes; guards hold or bring the person to the kerb, and are on duty until 'clear'"),
    Command::new(
        "unavailable",
        "take part in nothing, because of: low-battery, teleoperated, emergency-stop, local-fault, not-safe",
        |words, _| {
            let reason = unavailability(only(words, "unavailable", "a reason")?)?;
            let availability = Availability::Unavailable(reason);
            Ok(tell(Event::AvailabilityChanged(availability)))
        },
    )
    .taking("REASON")
    .on_road("the corridor closes. After emergency-stop, teleoperated or local-fault a guard stands still where it is and guards \
         nobody; after the others it holds or brings the person to the kerb, and is on duty until 'clear'"),
    Command::new("available", "take part again", |words, _| {
        event(words, Event::AvailabilityChanged(Availability::Available))
    })
    .on_road("nothing changes; the robot may be asked to guard again"),
    Command::new(
        "battery",
        "how full the battery is; below the limit of its robot file a robot is unavailable",
        battery,
    )
    .taking("PERCENT [charging]")
    .on_road("below the limit of its robot file the robot is unavailable: the corridor closes, and a guard holds or brings the \
         person to the kerb"),
    Command::new(
        "job",
        "the job that its RAM says it is there for: none, traffic-guard, escort, patrol, delivery, maintenance, other",
        |words, _| Ok(Line::Order(Order::Job(job(only(words, "job", "a job")?)?))),
    )
    .taking("ROLE")
    .on_road("nothing changes"),
    Command::new(
        "serve",
        "the road segment or intersection that its RAM says it serves, and that the commands of its plan name",
        serve,
    )
    .taking("segment|intersection [REGION:]NUMBER | none")
    .on_road("nothing changes"),
    Command::new(
        "status",
        "what the robot is doing, what it heard, who is around, and how link, security and channel are",
        |words, _| nothing(words).map(|()| Line::Status),
    ),
    Command::new("wait", "in a script: before the next line", |words, _| {
        Ok(Line::Wait(seconds(only(words, "wait", "seconds")?)?))
    })
    .taking("SECONDS"),
    Command::new(
        "until",
        "in a script: wait for idle, help-requested, role-established or maneuver-executing",
        until,
    )
    .taking("STATE [SECONDS]"),
    Command::new("help", "this, or what a command is for", help)
        .taking("[COMMAND]"),
    Command::new("quit", "leave the session and stop", |words, _| {
        nothing(words).map(|()| Line::Quit)
    })
    .on_road("the corridor closes; a guard ends its fallback first. Then the program ends, forgets its duty and guards nobody"),
];

/// The application tells its robot so.
fn tell(event: Event) -> Line {
    Line::Order(Order::Tell(Stimulus::Event(event)))
}

/// The same, by a command without words.
fn event(words: &[&str], event: Event) -> Result<Line, Misunderstood> {
    nothing(words)?;
    Ok(tell(event))
}

fn told(words: &[&str], _: &Scope<'_>) -> Result<Line, Misunderstood> {
    let name = only(words, "tell", "an event")?;
    let event = event_of(name)
        .ok_or_else(|| wrong(name, format!("one of {}", event_names().join(", "))))?;
    order_of(event)
        .map(Line::Order)
        .map_err(|why| wrong(name, why))
}

fn detect(words: &[&str], scope: &Scope<'_>) -> Result<Line, Misunderstood> {
    let planned = scope.planned.filter(|_| words.is_empty());
    let request = planned.map_or_else(|| request(words, scope.site), Ok)?;
    Ok(tell(Event::PedestrianDetected(request)))
}

fn until(words: &[&str], _: &Scope<'_>) -> Result<Line, Misunderstood> {
    match words {
        [name, time] => Ok(Line::Until(state(name)?, seconds(time)?)),
        words => {
            let name = only(words, "until", "a state")?;
            Ok(Line::Until(state(name)?, Duration::from_mins(1)))
        }
    }
}

fn help(words: &[&str], _: &Scope<'_>) -> Result<Line, Misunderstood> {
    let [name] = words else {
        return nothing(words).map(|()| Line::Help(None));
    };
    let command = Command::named(name);
    let command = command.ok_or_else(|| Misunderstood::Command((*name).to_owned()))?;
    Ok(Line::Help(Some(command.name)))
}

fn battery(words: &[&str], _: &Scope<'_>) -> Result<Line, Misunderstood> {
    let (percent, charging) = match words {
        [percent] => (percent, false),
        [percent, CHARGING] => (percent, true),
        [_, other] => return Err(wrong(other, "'charging'")),
        [] => {
            return Err(Misunderstood::Missing {
                command: "battery",
                wanted: "a charge in percent",
            });
        }
        [.., last] => return Err(surplus(last)),
    };
    let charge = number(percent).filter(|charge| (0.0..=100.0).contains(charge));
    let charge = charge.ok_or_else(|| wrong(percent, "a charge from 0 to 100 percent"))?;
    Ok(Line::Order(Order::Battery(Battery {
        state_of_charge: Some(charge),
        charging,
    })))
}

fn serve(words: &[&str], _: &Scope<'_>) -> Result<Line, Misunderstood> {
    let place = match words {
        [NONE] => None,
        [kind, reference] => Some(map_place(kind, reference)?),
        [] => {
            return Err(Misunderstood::Missing {
                command: "serve",
                wanted: "a road segment, an intersection, or none",
            });
        }
        [only] => return Err(wrong(only, MAP_PLACE)),
        [.., last] => return Err(surplus(last)),
    };
    Ok(Line::Order(Order::Serve(place)))
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

fn order(words: &[&str], scope: &Scope<'_>) -> Result<Line, Misunderstood> {
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
        [rest @ .., kind @ (SEGMENT | INTERSECTION), reference] => {
            (rest, Some(map_place(kind, reference)?))
        }
        rest => (rest, scope.site.map_place),
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
        [.., last] => return Err(surplus(last)),
    };
    let target = target.map(|place| scope.site.target(place));
    let parameters = TaskParameters {
        target,
        maximum_speed,
        map_place,
        ..TaskParameters::default()
    };
    Ok(Line::Order(Order::Tell(Stimulus::Command {
        follower,
        task: task(name)?,
        parameters,
    })))
}

fn show(words: &[&str], _: &Scope<'_>) -> Result<Line, Misunderstood> {
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
    let means = rest.iter().try_fold(SignalMeans::default(), |all, word| {
        Ok(all.union(means(word)?))
    })?;
    Ok(Line::Order(Order::Show(SignalsShown {
        to_vehicles,
        to_pedestrians,
        means,
    })))
}
