//! Reads the words of a command: robots, events, messages that a script makes up.

use std::fmt::Display;

use crossguard_protocol::*;

use super::HELP;
use crate::script::*;

/// The robots with names; a number stands for any other station.
pub(super) const NAMES: [&str; 5] = ["ARI", "GO2", "SPOT", "NAO", "PEPPER"];

/// Why a command cannot be run.
pub(crate) type Wrong = String;

pub(super) fn wrong(word: &str, allowed: &str) -> Wrong {
    format!("{word}: expected {allowed}")
}

/// The two parts of a word of this form.
fn pair<'a>(word: &'a str, at: char, form: &str) -> Result<(&'a str, &'a str), Wrong> {
    word.split_once(at).ok_or_else(|| wrong(word, form))
}

/// The value that reads like this.
pub(super) fn named<T: Copy + Display>(all: &[T], text: &str) -> Result<T, Wrong> {
    let of_text = all.iter().find(|it| it.to_string() == text).copied();
    let texts = || all.iter().map(T::to_string).collect::<Vec<_>>().join(", ");
    of_text.ok_or_else(|| wrong(text, &texts()))
}

pub(super) fn number<T: std::str::FromStr>(word: &str) -> Result<T, Wrong> {
    let digits = word.replace('_', "");
    digits.parse().map_err(|_| wrong(word, "a number"))
}

pub(super) fn station(word: &str) -> Result<StationId, Wrong> {
    match NAMES.iter().position(|name| *name == word) {
        Some(i) => Ok(StationId(u32::try_from(i + 1).unwrap())),
        None => number(word).map(StationId),
    }
}

pub(super) fn stations(words: &[&str]) -> Result<Vec<StationId>, Wrong> {
    words.iter().map(|word| station(word)).collect()
}

pub(super) fn task(word: &str) -> Result<TaskType, Wrong> {
    let known = (0..16).filter_map(TaskType::new);
    let mut named = known.filter(|task| task.to_string() == word);
    named
        .next()
        .or_else(|| word.parse().ok().and_then(TaskType::new))
        .ok_or_else(|| wrong(word, "a task"))
}

pub(super) fn tasks(word: &str) -> Result<TaskSet, Wrong> {
    let all: Result<Vec<_>, _> = word
        .split('+')
        .filter(|it| !it.is_empty())
        .map(task)
        .collect();
    all.map(|all| TaskSet::of(&all))
}

/// `BOOT.COUNT`.
pub(super) fn unique(word: &str) -> Result<UniqueNumber, Wrong> {
    let (boot, count) = pair(word, '.', "BOOT.COUNT")?;
    Ok(UniqueNumber {
        boot: number(boot)?,
        count: number(count)?,
    })
}

/// `LEADER#BOOT.COUNT`.
pub(super) fn session(word: &str) -> Result<SessionId, Wrong> {
    let (leader, count) = pair(word, '#', "LEADER#BOOT.COUNT")?;
    Ok(SessionId::of(
        station(leader)?,
        SessionNumber(unique(count)?),
    ))
}

/// Values of settings, `KEY=VALUE`.
pub(crate) fn set(settings: &mut Settings, values: &[&str]) -> Result<(), Wrong> {
    for value in values {
        let (key, value) = pair(value, '=', "KEY=VALUE")?;
        let millis = || number(value).map(Millis);
        if let Some(of) = key.strip_prefix("t_exec.") {
            settings.t_exec[usize::from(task(of)?.value())] = millis()?;
            continue;
        }
        match key {
            "t_select" => settings.t_select = millis()?,
            "t_offer" => settings.t_offer = millis()?,
            "t_ack" => settings.t_ack = millis()?,
            "t_farewell" => settings.t_farewell = millis()?,
            "delay_max" => settings.delay_max = millis()?,
            "n_ack" => settings.n_ack = number(value)?,
            "drift_ppm" => settings.drift_ppm = number(value)?,
            "guarding" => settings.guarding = tasks(value)?,
            "t_lock" => settings.t_lock = millis()?,
            "t_safety" => settings.t_safety = millis()?,
            "t_lease" => settings.t_lease = millis()?,
            "t_cross" => settings.t_cross = millis()?,
            "t_exec" => settings.t_exec = [millis()?; TaskType::COUNT],
            "capabilities" => settings.capabilities = tasks(value)?,
            "holding" => settings.holding = tasks(value)?,
            "first_request" => settings.first_request = RequestId(number(value)?),
            "first_heartbeat" => settings.first_heartbeat = Heartbeat(number(value)?),
            _ => return Err(wrong(key, "a setting that scripts change")),
        }
    }
    Ok(())
}

/// What a robot's own application tells it. A maneuver without a number is the one that the robot executes.
pub(super) fn event(street: &Street, who: StationId, words: &[&str]) -> Result<Event, Wrong> {
    let maneuver = |words: &[&str]| match *words {
        [] => match street[who].phase() {
            Phase::Following(own) => own
                .executing()
                .map(|it| it.id)
                .ok_or_else(|| "it executes nothing".into()),
            _ => Err(Wrong::from("it follows nobody")),
        },
        [request] => Ok(street.maneuver(who, number(request)?)),
        [request, "of", of] => Ok(ManeuverId::of(session(of)?, RequestId(number(request)?))),
        _ => Err(wrong(
            &words.join(" "),
            "nothing, REQUEST or REQUEST of SESSION",
        )),
    };
    Ok(match *words {
        ["detects", followers, ref more @ ..] => {
            let mut request = escort(number(followers)?);
            request_of(&mut request, more)?;
            Event::PedestrianDetected(request)
        }
        ["orders", follower, of] => order(station(follower)?, task(of)?),
        ["in", "position", ref id @ ..] => Event::InPosition(maneuver(id)?),
        ["out", "of", "position", ref id @ ..] => Event::OutOfPosition(maneuver(id)?),
        ["completes", ref id @ ..] => Event::ManeuverCompleted(maneuver(id)?),
        ["fails", ref id @ ..] => Event::ManeuverFailed(maneuver(id)?),
        ["opens"] => Event::OpenCorridor,
        ["closes"] => Event::CloseCorridor,
        ["road", "clear"] => Event::RoadClear,
        ["task", "completed"] => Event::TaskCompleted,
        ["leaves"] => Event::LeaveRequested,
        ["all", "answered"] => Event::AllAnswered,
        ["sees", "a", "person"] => Event::PersonOnRoad,
        ["available"] => Event::AvailabilityChanged(Availability::Available),
        ["unavailable", ref why @ ..] => Event::AvailabilityChanged(Availability::Unavailable(
            named(Unavailability::SAMPLES, &why.join(" "))?,
        )),
        ["identity", new] => Event::IdentityChanged(StationId(number(new)?), None),
        ["identity", new, from] => {
            Event::IdentityChanged(StationId(number(new)?), Some(unique(from)?))
        }
        ["epoch", boot] => Event::EpochRenewed(number(boot)?),
        _ => return Err(wrong(&words.join(" "), HELP)),
    })
}

/// Parts of a request for help, `KEY=VALUE`.
pub(super) fn request_of(request: &mut HelpRequest, values: &[&str]) -> Result<(), Wrong> {
    for value in values {
        match pair(value, '=', "KEY=VALUE")? {
            ("place", "unknown") => request.place = Place::UNKNOWN,
            ("place", place) => request.place = Place(number(place)?),
            ("tasks", of) => request.tasks = tasks(of)?,
            ("urgency", urgency) => request.urgency = named(Urgency::SAMPLES, urgency)?,
            (key, _) => return Err(wrong(key, "place, tasks or urgency")),
        }
    }
    Ok(())
}

/// The values of a message, `KEY=VALUE`, each of which has a default.
struct Values<'a>(&'a [&'a str]);

impl<'a> Values<'a> {
    fn get(&self, key: &str) -> Option<&'a str> {
        let mut values = self.0.iter().filter_map(|it| it.split_once('='));
        values.find(|(it, _)| *it == key).map(|(_, value)| value)
    }

    fn read<T>(
        &self,
        key: &str,
        default: T,
        read: impl Fn(&str) -> Result<T, Wrong>,
    ) -> Result<T, Wrong> {
        self.get(key).map_or(Ok(default), read)
    }

    fn checked(words: &'a [&'a str], keys: &[&str]) -> Result<Self, Wrong> {
        let common = ["ended", "left", "distance"];
        for word in words {
            let key = word.split('=').next().unwrap_or_default();
            if !keys.contains(&key) && !common.contains(&key) {
                return Err(wrong(key, &keys.join(", ")));
            }
        }
        Ok(Self(words))
    }
}

/// A RAM that a script makes: `none FROM`, `needHelp FROM`, `offer FROM SESSION`, `follower FROM SESSION`, `leader SESSION`,
/// with values.
pub(super) fn made_ram(words: &[&str]) -> Result<Input, Wrong> {
    let (from, values, coordination) = match *words {
        ["none", from, ref more @ ..] => (
            station(from)?,
            Values::checked(more, &[])?,
            Coordination::None,
        ),
        ["needHelp", from, ref more @ ..] => {
            let keys = ["number", "heartbeat", "followers", "urgency"];
            let values = Values::checked(more, &keys)?;
            let mut request = escort(values.read("followers", 1, number)?);
            if let Some(urgency) = values.get("urgency") {
                request_of(&mut request, &[&format!("urgency={urgency}")])?;
            }
            let coordination = Coordination::NeedHelp {
                number: SessionNumber(values.read(
                    "number",
                    UniqueNumber { boot: 1, count: 0 },
                    unique,
                )?),
                heartbeat: Heartbeat(values.read("heartbeat", 0, number)?),
                request,
            };
            (station(from)?, values, coordination)
        }
        ["offer", from, of, ref more @ ..] => {
            let values = Values::checked(more, &["number", "tasks", "echo"])?;
            let both = TaskSet::of(&[TaskType::INITIAL_POS, TaskType::MOVE]);
            let coordination = Coordination::OfferHelp {
                session: session(of)?,
                offer: OfferNumber(values.read("number", FIRST_OFFER.0, unique)?),
                capabilities: values.read("tasks", both, tasks)?,
                echo: Heartbeat(values.read("echo", 0, number)?),
                t_safety: Settings::default().t_safety,
            };
            (station(from)?, values, coordination)
        }
        ["follower", from, of, ref more @ ..] => {
            let values = Values::checked(more, &["echo", "report"])?;
            let coordination = Coordination::Follower {
                session: session(of)?,
                echo: Heartbeat(values.read("echo", 0, number)?),
                last: values.read("report", None, |it| report(it).map(Some))?,
            };
            (station(from)?, values, coordination)
        }
        ["leader", of, ref more @ ..] => {
            let values = Values::checked(more, &["heartbeat", "followers"])?;
            let of = session(of)?;
            let coordination = Coordination::Leader {
                number: of.number,
                heartbeat: Heartbeat(values.read("heartbeat", 0, number)?),
                followers: values.read("followers", Followers::EMPTY, followers)?,
                urgency: Urgency::Medium,
                place: CROSSING,
                yields: false,
            };
            (of.leader, values, coordination)
        }
        _ => {
            return Err(wrong(
                &words.join(" "),
                "none, needHelp, offer, follower or leader",
            ));
        }
    };
    let ended = |it: &str| {
        let (count, ending) = pair(it, ':', "BOOT.COUNT:ENDING")?;
        let ending = named(Ending::SAMPLES, ending)?;
        Ok(Some(Farewell::Ended(SessionNumber(unique(count)?), ending)))
    };
    let left = |it: &str| {
        let (of, offer) = pair(it, ':', "SESSION:BOOT.COUNT")?;
        Ok(Some(Farewell::Left(
            session(of)?,
            OfferNumber(unique(offer)?),
        )))
    };
    let ram = Ram {
        farewell: values
            .read("ended", None, ended)?
            .or(values.read("left", None, left)?),
        ..ram(from, coordination)
    };
    let distance = values.read("distance", NEAR, |it| number(it).map(Decimetres))?;
    Ok(Input::Ram { ram, distance })
}

/// `REQUEST:PROGRESS`.
pub(super) fn report(word: &str) -> Result<Report, Wrong> {
    let (request, progress) = pair(word, ':', "REQUEST:PROGRESS")?;
    Ok(Report {
        request: RequestId(number(request)?),
        progress: named(Progress::SAMPLES, &progress.replace('-', " "))?,
    })
}

/// `STATION:OFFER,...`.
pub(super) fn followers(word: &str) -> Result<Followers, Wrong> {
    let one = |word: &str| {
        let (who, offer) = pair(word, ':', "STATION:BOOT.COUNT")?;
        Ok(Confirmation {
            station: station(who)?,
            offer: OfferNumber(unique(offer)?),
        })
    };
    word.split(',').map(one).collect()
}

/// An RMCM that a script makes: `command SESSION REQUEST TASK TO`, `ack SESSION REQUEST FROM`, `reject SESSION REQUEST FROM`.
pub(super) fn made_rmcm(words: &[&str]) -> Result<Rmcm, Wrong> {
    let answer = |of: &str, request: &str, from: &str, verdict| {
        Ok(Rmcm::Answer(Answer {
            from: station(from)?,
            session: session(of)?,
            request: RequestId(number(request)?),
            verdict,
        }))
    };
    match *words {
        ["command", of, request, what, to] => Ok(Rmcm::Command(Command {
            session: session(of)?,
            to: station(to)?,
            request: RequestId(number(request)?),
            task: task(what)?,
        })),
        ["ack", of, request, from] => answer(of, request, from, Verdict::Accepted),
        ["reject", of, request, from] => answer(
            of,
            request,
            from,
            Verdict::Rejected(Rejection::UnsupportedTask),
        ),
        _ => Err(wrong(&words.join(" "), "command, ack or reject")),
    }
}
