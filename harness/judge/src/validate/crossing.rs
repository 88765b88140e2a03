//! P1 to P4 and P9 of the crossing, on logs that have people, vehicles and positions.
//!
//! | property | what logs show | judged when |
//! |---|---|---|
//! | P1 | While somebody is on the carriageway, no guard leaves because of an application's word. | a guard ends its maneuver or duty by a word of its own application (`ManeuverCompleted`, `RoadClear`) or by its leader's `TaskCompleted` |
//! | P2 | While go is shown, each guard that holds a place is within [`TOLERANCE_M`] of it, or left it a short time ago. | a guard sends a RAM, or go begins or goes on |
//! | P3 | Go does not begin while a vehicle could no longer stop. | go begins at a robot that has vehicles in sight |
//! | P4 | An escort that moves is no further than [`AHEAD_M`] ahead of a person in its sight on the carriageway. | an escort sends a RAM while it sees somebody on the carriageway |
//! | P9 | No robot steps on the road while a vehicle has been in its sight for a while that could no longer stop. | RAM of a robot that has vehicles in sight are beside the road first, and then on it, and nobody has been on it for a minute |
//!
//! Acts of people are worked out of their [places](super::ground) alone, never of what a robot made of them. Guards are
//! judged by what bodies are told (start, stop, fall back), positions by the robots' own RAM, to which the error that
//! they state is added. Clocks of several machines are taken as they are.
//!
//! A person who stepped on the road under go may be seen there a moment after the team was freed: that breaks P1 as
//! well. Go is taken to last a second of the robots' own time longer, and people are taken to have come from the nearest
//! edge of the road as fast as anybody walks.

use std::collections::{BTreeMap, HashMap};

use crossguard_codec::{Identifiers, Position, Service};
use crossguard_endpoint::station::listen::overhear;
use crossguard_protocol::{
    Config, Event, FallbackPolicy, Input, Maneuver, ManeuverId, Output, Outputs, ReleaseReason,
    Robot, SessionId, StationId, StopReason,
};
use crossguard_robot::sight::Sight;
use crossguard_robot::trace::Entry;

use super::fault::Fault;
use super::ground::{Ground, Metres, OnRoad, distance};
use super::targets;
use super::traffic::{AtKerb, Vehicle};
use crate::seconds;

/// How far a guard may be from its place, and an escort ahead of its person, besides the stated error of its
/// position.
const TOLERANCE_M: f64 = 2.0;
const AHEAD_M: f64 = 2.0;

/// A slower body stands.
const MOVES_MPS: f64 = 0.3;

/// An escort stops within so many seconds.
const STOPS_S: f64 = 1.0;

/// For how long after somebody was on the road robots may have them there, in µs.
const LINGERS_US: u64 = 60_000_000;

/// For how long after its last position a robot still is where it was, in µs.
const PLACED_US: u64 = 1_000_000;

/// Guards, signs and people of a run.
#[derive(Debug, Default)]
pub(super) struct Crossing {
    ground: Ground,
    guards: BTreeMap<String, Guard>,
    /// The newest place of each robot and its stated error, in metres, and when.
    places: BTreeMap<String, (u64, Metres, f64)>,
    /// Until when the sign of each leader shows go.
    go: BTreeMap<String, Go>,
    targets: HashMap<(ManeuverId, StationId), Metres>,
    at_kerb: BTreeMap<String, AtKerb>,
    /// Until when robots may have somebody on the road.
    occupied_until_us: u64,
    /// The guard that left last by an application's word, and until when a person who saw go may be seen to step on the
    /// road.
    freed: Option<(Left, u64)>,
    /// How often each property was judged.
    judged: BTreeMap<&'static str, usize>,
    has_guards: bool,
    may_be_away_ms: u64,
}

/// A guard that left by an application's word.
#[derive(Clone, Debug)]
struct Left {
    robot: String,
    word: String,
}

impl Left {
    fn while_on_road(&self, person: &OnRoad<'_>) -> Fault {
        Fault::GuardLeft {
            robot: self.robot.clone(),
            word: self.word.clone(),
            by: person.by.to_owned(),
            east: person.at[0],
            north: person.at[1],
        }
    }
}

/// A body that guards.
#[derive(Clone, Copy, Debug)]
struct Guard {
    maneuver: Maneuver,
    station: StationId,
    /// Whether it holds a place.
    holds: bool,
    /// When it was at its place last, or was sent there.
    there_us: u64,
}

#[derive(Clone, Copy, Debug)]
struct Go {
    session: SessionId,
    until_us: u64,
    /// For how long a guard may have left its place.
    may_be_away_us: u64,
}

impl Crossing {
    /// A robot made a record at this time since 1970.
    pub(super) fn take(
        &mut self,
        robot: &str,
        at_us: u64,
        entry: &Entry,
        (config, identifiers): (&Config, &Identifiers),
    ) -> Result<(), Fault> {
        self.ground.lives(robot, at_us);
        match entry {
            Entry::Stopped { .. } => self.forget(robot),
            Entry::Zone(outline) => self.ground.outline(robot, outline),
            Entry::People(sight) => {
                self.ground.see(robot, at_us, sight);
                self.see_vehicles(robot, at_us, sight);
                self.freed_too_early(at_us)?;
            }
            Entry::Step {
                input,
                outputs,
                state,
            } => {
                self.begins(robot, at_us, outputs)?;
                self.show(robot, at_us, outputs, state, config);
                self.guard(robot, at_us, *input, outputs, state, config)?;
                if outputs.iter().any(|it| go_for(it).is_some()) {
                    self.guards_are_there(at_us)?;
                }
            }
            Entry::Sent {
                message, octets, ..
            } => {
                self.targets(identifiers, octets, *message);
                if *message == Service::Ram {
                    self.is_at(robot, at_us, identifiers, octets)?;
                    self.guards_are_there(at_us)?;
                }
            }
            Entry::Heard {
                message, octets, ..
            } => self.targets(identifiers, octets, *message),
            _ => {}
        }
        Ok(())
    }

    /// A robot starts, which moves so many times as fast as real.
    pub(super) fn start(&mut self, robot: &str, speed: f64) {
        self.ground.move_at(speed);
        self.forget(robot);
    }

    /// A robot is down.
    pub(super) fn forget(&mut self, robot: &str) {
        self.ground.forget(robot);
        self.at_kerb.remove(robot);
        self.guards.remove(robot);
    }

    /// Keeps where commands lead.
    fn targets(&mut self, identifiers: &Identifiers, octets: &[u8], message: Service) {
        if message != Service::Rmcm {
            return;
        }
        for (command, place) in targets::commands(identifiers, octets) {
            let degrees = place.and_then(|it: Position| it.latitude.zip(it.longitude));
            if let Some(degrees) = degrees {
                let place = self.ground.metres(degrees);
                let id = ManeuverId {
                    session: command.session,
                    request: command.request,
                };
                self.targets.insert((id, command.to), place);
            }
        }
    }

    fn see_vehicles(&mut self, robot: &str, at_us: u64, sight: &Sight) {
        let mut vehicles = Vec::new();
        for seen in &sight.vehicles {
            if let Some(velocity) = seen.velocity {
                let at = self.ground.metres(seen.place);
                vehicles.push(Vehicle { at, velocity });
            }
        }
        let crossing = self.ground.crossing(robot).unwrap_or_default();
        let at_kerb = self.at_kerb.entry(robot.to_owned()).or_default();
        at_kerb.see(at_us, vehicles, crossing);
        if self.ground.on_road(at_us).next().is_some() {
            self.occupied_until_us = at_us + LINGERS_US;
        }
    }

    /// A robot is somewhere, with this error (P9).
    fn steps(&mut self, robot: &str, at_us: u64, here: Metres, error_m: f64) -> Result<(), Fault> {
        let Some(off_m) = self.ground.off_road_m(robot, here) else {
            return Ok(());
        };
        let at_kerb = self.at_kerb.entry(robot.to_owned()).or_default();
        let (steps, before) = at_kerb.is_at(at_us, off_m, error_m);
        if !steps || at_us < self.occupied_until_us {
            return Ok(());
        }
        *self.judged.entry("P9").or_default() += 1;
        before.map_or(Ok(()), |coming| {
            Err(Fault::StepsBeforeVehicle(robot.to_owned(), coming))
        })
    }

    /// Whether go begins in front of a vehicle that could no longer stop (P3).
    fn begins(&mut self, robot: &str, at_us: u64, outputs: &Outputs) -> Result<(), Fault> {
        let shows = self.go.get(robot).is_some_and(|go| at_us < go.until_us);
        let begins = !shows && outputs.iter().any(|it| go_for(it).is_some());
        let vehicles = self
            .at_kerb
            .get(robot)
            .map(|it| &it.vehicles)
            .filter(|it| begins && !it.is_empty());
        let (Some(vehicles), Some(crossing)) = (vehicles, self.ground.crossing(robot)) else {
            return Ok(());
        };
        *self.judged.entry("P3").or_default() += 1;
        let coming = vehicles.iter().find_map(|it| it.comes(crossing));
        coming.map_or(Ok(()), |coming| {
            Err(Fault::GoBeforeVehicle(robot.to_owned(), coming))
        })
    }

    /// Follows the sign through a step.
    fn show(&mut self, robot: &str, at_us: u64, outputs: &Outputs, state: &Robot, config: &Config) {
        for output in outputs.iter() {
            if let (Some(time_us), Some(session)) = (go_for(output), state.session()) {
                let may_be_away_us = u64::from(config.settings().t_lease.0) * 1_000 + PLACED_US;
                self.may_be_away_ms = self.may_be_away_ms.max(may_be_away_us / 1_000);
                self.go.insert(
                    robot.to_owned(),
                    Go {
                        session,
                        until_us: at_us + time_us,
                        may_be_away_us,
                    },
                );
            }
            if let (Output::CorridorClosed(_), Some(go)) = (output, self.go.get_mut(robot)) {
                go.until_us = go.until_us.min(at_us);
            }
        }
    }

    /// Follows a body that guards, or begins to, through a step (P1).
    fn guard(
        &mut self,
        robot: &str,
        at_us: u64,
        input: Input,
        outputs: &Outputs,
        state: &Robot,
        config: &Config,
    ) -> Result<(), Fault> {
        let settings = config.settings();
        let before = self.guards.remove(robot);
        let (mut guards, mut word) = (before, None);
        let is_taken = outputs.ignored().is_none();
        match input {
            Input::Local(event @ Event::ManeuverCompleted(_)) if is_taken => {
                (guards, word) = (None, Some(event.to_string()));
            }
            Input::Local(Event::ManeuverFailed(_)) => guards = None,
            Input::Local(event @ Event::RoadClear) if is_taken && state.duty().is_none() => {
                (guards, word) = (None, Some(event.to_string()));
            }
            _ => {}
        }
        for output in outputs.iter() {
            match *output {
                Output::StartManeuver(maneuver) => {
                    guards = settings.guarding.contains(maneuver.task).then_some(Guard {
                        maneuver,
                        station: state.station(),
                        holds: settings.holding.contains(maneuver.task),
                        there_us: at_us,
                    });
                }
                Output::StopManeuver(_, why) => {
                    guards = None;
                    if before.is_some() && why == StopReason::Released(ReleaseReason::TaskCompleted)
                    {
                        word = Some("task completed".to_owned());
                    }
                }
                Output::FallBack(_, policy) => {
                    let stays = matches!(
                        policy,
                        FallbackPolicy::HoldUntilClear | FallbackPolicy::EscortToKerb
                    );
                    guards = guards.filter(|_| stays);
                }
                _ => {}
            }
        }
        if let Some(guard) = guards {
            self.has_guards = true;
            self.guards.insert(robot.to_owned(), guard);
        }
        let (Some(_), None, Some(word)) = (before, guards, word) else {
            return Ok(());
        };
        if self.ground.has_sights {
            *self.judged.entry("P1").or_default() += 1;
        }
        let left = Left {
            robot: robot.to_owned(),
            word,
        };
        if let Some(person) = self.ground.on_road(at_us).next() {
            return Err(left.while_on_road(&person));
        }
        let go_us = self.go.values().map(|go| go.until_us.min(at_us)).max();
        if let Some(go_us) = go_us {
            self.freed = Some((left, go_us + self.ground.stays_us()));
        }
        Ok(())
    }

    /// Fails where a person on the road saw go, and the guards have left since (P1).
    fn freed_too_early(&self, at_us: u64) -> Result<(), Fault> {
        let Some((left, until_us)) = &self.freed else {
            return Ok(());
        };
        let mut on_road = self.ground.on_road(at_us);
        let person = on_road.find(|person| person.since_us <= *until_us);
        person.map_or(Ok(()), |person| Err(left.while_on_road(&person)))
    }

    /// Guards that hold a place are there while go is shown (P2).
    fn guards_are_there(&mut self, at_us: u64) -> Result<(), Fault> {
        for (robot, guard) in &self.guards {
            let shows = |go: &&Go| go.session == guard.maneuver.id.session && at_us < go.until_us;
            let Some(go) = self.go.values().find(shows) else {
                continue;
            };
            let has_place =
                self.places.contains_key(robot) && guard.target(&self.targets).is_some();
            if !guard.holds || !has_place {
                continue;
            }
            *self.judged.entry("P2").or_default() += 1;
            let away_us = at_us.saturating_sub(guard.there_us);
            if away_us > go.may_be_away_us {
                return Err(Fault::GuardAway {
                    robot: robot.clone(),
                    away_ms: away_us / 1_000,
                    may_ms: go.may_be_away_us / 1_000,
                });
            }
        }
        Ok(())
    }

    /// A robot says where it is.
    fn is_at(
        &mut self,
        robot: &str,
        at_us: u64,
        identifiers: &Identifiers,
        octets: &[u8],
    ) -> Result<(), Fault> {
        let state = overhear(identifiers, octets)
            .ok()
            .and_then(|heard| heard.state);
        let position = state.map(|state| state.position).unwrap_or_default();
        let Some(degrees) = position.latitude.zip(position.longitude) else {
            return Ok(());
        };
        let here = self.ground.metres(degrees);
        let error = position.ellipse.map_or(0.0, |ellipse| ellipse.semi_major);
        self.steps(robot, at_us, here, error)?;
        let before = self.places.insert(robot.to_owned(), (at_us, here, error));
        let Some(guard) = self.guards.get_mut(robot) else {
            return Ok(());
        };
        if guard.holds {
            let target = guard.target(&self.targets);
            if target.is_some_and(|target| distance(here, target) <= TOLERANCE_M + error) {
                guard.there_us = at_us;
            }
            return Ok(());
        }
        match before {
            Some(before) => self.escorts(robot, before, (at_us, here, error)),
            None => Ok(()),
        }
    }

    /// An escort has moved from one place to another (P4).
    fn escorts(
        &mut self,
        robot: &str,
        (before_us, before, _): (u64, Metres, f64),
        (at_us, here, error): (u64, Metres, f64),
    ) -> Result<(), Fault> {
        let (way, passed_s) = (
            distance(before, here),
            seconds(at_us.saturating_sub(before_us)),
        );
        // An escort without sensors cannot know.
        let people = self.ground.on_road(at_us).filter(|it| it.by == robot);
        let nearest = people.min_by(|a, b| distance(a.at, here).total_cmp(&distance(b.at, here)));
        let Some(person) = nearest.filter(|_| way > MOVES_MPS * passed_s && passed_s > 0.0) else {
            return Ok(());
        };
        *self.judged.entry("P4").or_default() += 1;
        let along =
            |axis: usize| (here[axis] - person.at[axis]) * (here[axis] - before[axis]) / way;
        let (ahead_m, may_m) = (
            along(0) + along(1),
            AHEAD_M + error + way / passed_s * STOPS_S,
        );
        if ahead_m <= may_m {
            return Ok(());
        }
        Err(Fault::EscortAhead {
            robot: robot.to_owned(),
            ahead_m,
            may_m,
        })
    }

    /// Judged and unjudged properties, a sentence for each.
    pub(super) fn verdict(&self) -> Vec<String> {
        let people = match (self.ground.has_sights, self.ground.has_road()) {
            (false, _) => Some("no sight in the log"),
            (true, false) => Some("no outline of a road in the log"),
            (true, true) => None,
        };
        let guards = (!self.has_guards).then_some("nobody guarded");
        let rows = [
            (
                "P1",
                people.or(guards),
                "no guard left by an application's word",
                "nobody on the road when a guard left by an application's word".to_owned(),
            ),
            (
                "P2",
                guards,
                "no position of a guard at a place while go was shown",
                format!(
                    "under go, each guard within {TOLERANCE_M} m and its error of its place, or away for less than {} ms",
                    self.may_be_away_ms
                ),
            ),
            (
                "P3",
                None,
                "go never began with a vehicle in sight",
                "go began with vehicles in sight, and each could stop".to_owned(),
            ),
            (
                "P4",
                people.or(guards),
                "no escort moved while it saw somebody on the road",
                format!(
                    "no escort further ahead than {AHEAD_M} m, its error and {STOPS_S} s of its way"
                ),
            ),
            (
                "P9",
                None,
                "no robot with vehicles in sight stepped on an empty road",
                "a robot stepped on the road, and no vehicle in its sight came that could not stop"
                    .to_owned(),
            ),
        ];
        let verdict = |(id, why, never, kept): (&str, Option<&str>, _, _)| {
            let times = self.judged.get(id).copied().unwrap_or_default();
            match why.or((times == 0).then_some(never)) {
                Some(why) => format!("{id} not judged: {why}"),
                None => format!("{id} kept {times} times: {kept}"),
            }
        };
        rows.map(verdict).into()
    }
}

impl Guard {
    fn target(&self, targets: &HashMap<(ManeuverId, StationId), Metres>) -> Option<Metres> {
        targets.get(&(self.maneuver.id, self.station)).copied()
    }
}

/// For how many µs an output shows go.
fn go_for(output: &Output) -> Option<u64> {
    match output {
        Output::CorridorOpened(time) | Output::CorridorExtended(time) => {
            Some(u64::from(time.0) * 1_000)
        }
        _ => None,
    }
}
