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

/// What the words of a line are about.
pub(super) struct Scope<'a> {
    pub(super) site: &'a Site,
    /// What `detect` alone asks for.
    pub(super) planned: Option<HelpRequest>,
}

/// A command.
pub(super) struct Command {
    pub(super) name: &'static str,
    /// What follows its name, for people.
    pub(super) usage: &'static str,
    /// What it does, for people.
    pub(super) meaning: &'static str,
    pub(super) parse: fn(&[&str], &Scope<'_>) -> Result<Line, Misunderstood>,
}

impl Command {
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
            parse,
        }
    }

    const fn taking(self, usage: &'static str) -> Self {
        Self { usage, ..self }
    }
}

pub(super) const COMMANDS: &[Command] = &[
    Command::new(
        "detect",
        "a pedestrian needs help; what the plan asks for by default, or else 1 follower for initialPos and move",
        detect,
    )
    .taking("[FOLLOWERS] [low|medium|high|emergency] [TASK ...]"),
    Command::new(
        "order",
        "have a follower do a maneuver, in metres and m/s, at this road segment or intersection of the map; \
         map_place or crossing of the configuration by default",
        order,
    )
    .taking("STATION TASK [EAST NORTH [SPEED]] [segment|intersection [REGION:]NUMBER]"),
    Command::new(
        "show",
        "the signals to vehicles and to pedestrians that its RAM tells of: none, stop, go, caution; only an open corridor \
         shows go to pedestrians; the means are those of the configuration by default",
        show,
    )
    .taking("VEHICLES [PEDESTRIANS] [gesture] [display] [lights] [speech]"),
    Command::new(
        "in-position",
        "the body is at the place from which it guards",
        |words, _| nothing(words).map(|()| Line::Order(Order::InPosition)),
    ),
    Command::new(
        "out-of-position",
        "the body is not at that place any more",
        |words, _| nothing(words).map(|()| Line::Order(Order::OutOfPosition)),
    ),
    Command::new(
        "person-on-road",
        "this robot itself sees somebody on the road: it stays until 'clear', however the session ends",
        |words, _| event(words, Event::PersonOnRoad),
    ),
    Command::new(
        "done",
        "the maneuver that runs is finished, or the fallback that runs",
        |words, _| nothing(words).map(|()| Line::Order(Order::Finish { well: true })),
    ),
    Command::new("fail", "the maneuver that runs cannot be finished", |words, _| {
        nothing(words).map(|()| Line::Order(Order::Finish { well: false }))
    }),
    Command::new("open", "open the corridor", |words, _| {
        event(words, Event::OpenCorridor)
    }),
    Command::new("close", "close the corridor", |words, _| {
        event(words, Event::CloseCorridor)
    }),
    Command::new(
        "task-completed",
        "the pedestrian has crossed, and nobody is on the road",
        |words, _| event(words, Event::TaskCompleted),
    ),
    Command::new(
        "clear",
        "nobody is on the road any more: ends the duty of a robot that fell back or gave up, once its body has \
         finished its fallback",
        |words, _| nothing(words).map(|()| Line::Order(Order::Clear)),
    ),
    Command::new("tell", "an event of the protocol that comes with nothing, by its name in JSON", told)
        .taking("EVENT"),
    Command::new("leave", "leave the session", |words, _| {
        event(words, Event::LeaveRequested)
    }),
    Command::new(
        "unavailable",
        "low-battery, teleoperated, emergency-stop, local-fault, not-safe",
        |words, _| {
            let reason = unavailability(only(words, "unavailable", "a reason")?)?;
            let availability = Availability::Unavailable(reason);
            Ok(tell(Event::AvailabilityChanged(availability)))
        },
    )
    .taking("REASON"),
    Command::new("available", "take part again", |words, _| {
        event(words, Event::AvailabilityChanged(Availability::Available))
    }),
    Command::new(
        "battery",
        "how full the battery is; below the limit of its robot file a robot is unavailable",
        battery,
    )
    .taking("PERCENT [charging]"),
    Command::new(
        "job",
        "the job that its RAM says it is there for: none, traffic-guard, escort, patrol, delivery, maintenance, other",
        |words, _| Ok(Line::Order(Order::Job(job(only(words, "job", "a job")?)?))),
    )
    .taking("ROLE"),
    Command::new(
        "serve",
        "the road segment or intersection that its RAM says it serves, and that the commands of its plan name",
        serve,
    )
    .taking("segment|intersection [REGION:]NUMBER | none"),
    Command::new(
        "status",
        "what the robot is doing, what it heard, who is around, and how link, security and channel are",
        |words, _| nothing(words).map(|()| Line::Status),
    ),
    Command::new("wait", "before the next line", |words, _| {
        Ok(Line::Wait(seconds(only(words, "wait", "seconds")?)?))
    })
    .taking("SECONDS"),
    Command::new(
        "until",
        "wait for idle, help-requested, role-established or maneuver-executing",
        until,
    )
    .taking("STATE [SECONDS]"),
    Command::new("help", "this, or what a command is for", help)
        .taking("[COMMAND]"),
    Command::new("quit", "leave the session and stop", |words, _| {
        nothing(words).map(|()| Line::Quit)
    }),
];

/// The application tells its robot so.
fn tell(event: Event) -> Line {
    Line::Order(Order::Wish(Stimulus::Event(event)))
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
    Ok(Line::Order(Order::Wish(Stimulus::Order {
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
