//! A run as a whole.

use std::collections::{BTreeMap, BTreeSet};

use crossguard_endpoint::counters::CauseName;
use crossguard_protocol::{Role, State, StationId};
use crossguard_robot::zone::Conduct;
use serde::Serialize;

use super::tracks::{Open, Track};
use super::{Metres, Playback};
use crate::timing::{Summary, Times};

/// How many spans of states of a robot there are at most: a screen has no more columns.
const COLUMNS: u64 = 1_500;

/// How many trials are listed.
const TRIALS_MAX: usize = 500;

/// How many corridors of a robot are listed.
const CORRIDORS_MAX: usize = 500;

/// A run as a whole.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Overview {
    /// When it began, in ms since 1970.
    pub began_ms: u64,
    /// How long it lasted, in µs.
    pub lasted: u64,
    /// How many records it has, and how many more there are that are left out.
    pub records: u64,
    /// See [`Overview::records`].
    pub left_out: u64,
    /// Why logs could not be read to their ends.
    pub troubles: Vec<String>,
    /// The robots.
    pub robots: Vec<RobotOverview>,
    /// The columns of the sequence chart: the robots, and stations without logs.
    pub lanes: Vec<String>,
    /// The causes of drops, in the order of those of a moment: layer and cause.
    pub causes: Vec<[String; 2]>,
    /// The sessions, each of which is one trial.
    pub trials: Vec<Trial>,
    /// The times of maneuvers, beside the paper's.
    pub times: Vec<Summary>,
    /// Notes on the times.
    pub notes_on_times: Vec<String>,
    /// The street.
    pub street: Street,
}

/// A robot.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct RobotOverview {
    /// Its name.
    pub name: String,
    /// The station ids that it had.
    pub stations: Vec<StationId>,
    /// Its boots.
    pub boots: Vec<u16>,
    /// Whether it stopped in order.
    pub has_stopped: bool,
    /// Its states over time.
    pub states: Vec<StateSpan>,
    /// When its corridor was open: from, to, and why it was closed.
    pub corridor: Vec<(u64, u64, String)>,
    /// When people waited at its zone.
    pub waiting: Vec<(u64, u64)>,
    /// When it had people on the road.
    pub crossing: Vec<(u64, u64)>,
}

/// A robot's state for a while.
#[derive(Debug, Serialize)]
pub struct StateSpan {
    /// From when, in µs.
    pub from: u64,
    /// Until when, in µs.
    pub to: u64,
    /// The state; of states too short to be seen, the one of the highest stage.
    pub state: State,
    /// Its activity in that state.
    pub text: String,
}

/// A session, from the first to the last time that a robot had a part in it.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Trial {
    /// Its id.
    pub session: String,
    /// Its leader, or the robot that asked.
    pub leader: String,
    /// The other robots with a part in it.
    pub team: Vec<String>,
    /// From when, in µs.
    pub from: u64,
    /// Until when, in µs.
    pub to: u64,
    /// For how long the corridor was open, in µs.
    pub open: u64,
    /// Why the corridor was closed last; empty where it was never open.
    pub closed: String,
}

/// The street, in metres.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Street {
    /// West, south, east and north end of what happened.
    pub extent: Option<[f64; 4]>,
    /// The edges of the carriageway.
    pub kerbs: Vec<[Metres; 2]>,
    /// The lanes: name, from, to, and width.
    pub lanes: Vec<(String, Metres, Metres, f64)>,
    /// Places of robots: name, place.
    pub places: Vec<(String, Metres)>,
    /// Where people wait, by zone.
    pub waiting: Vec<Vec<Metres>>,
    /// Where people cross, by zone.
    pub road: Vec<Vec<Metres>>,
}

impl Playback {
    /// The run as a whole; its logs have these names.
    #[must_use]
    pub fn overview(&self, logs: &[String]) -> Overview {
        let mut lanes: Vec<_> = self.robots.iter().map(|it| it.name.clone()).collect();
        let strangers = self.messages.strangers.iter();
        lanes.extend(strangers.map(|station| format!("station {station}")));
        lanes.extend(self.messages.has_others.then(|| "others".to_owned()));
        let causes = self.causes().into_iter();
        let times = Times::of(&self.timing, logs);
        let teams = times.teams.iter().map(|team| format!("{team}."));
        let clocks = times.clocks.iter().map(|clock| format!("{clock}."));
        Overview {
            began_ms: self.from_us / 1_000,
            lasted: self.since(self.to_us),
            records: self.records,
            left_out: self.left_out,
            troubles: self.troubles.clone(),
            robots: self.robots.iter().map(|it| self.robot(it)).collect(),
            lanes,
            causes: causes
                .map(|cause| [cause.layer.name().to_owned(), cause.reason.to_string()])
                .collect(),
            trials: self.trials(),
            notes_on_times: teams.chain(clocks).collect(),
            times: times.maneuvers,
            street: self.street(),
        }
    }

    /// The causes of drops of all robots.
    pub(super) fn causes(&self) -> Vec<&CauseName> {
        let causes: BTreeSet<_> = self.robots.iter().flat_map(|it| it.drops.keys()).collect();
        causes.into_iter().collect()
    }

    fn robot(&self, track: &Track) -> RobotOverview {
        let corridors = track.corridor.iter().take(CORRIDORS_MAX);
        let corridors = corridors.map(|open| {
            let (from, to) = self.open(open);
            (from, to, open.why.clone())
        });
        RobotOverview {
            name: track.name.clone(),
            stations: track.stations.clone(),
            boots: track.boots.clone(),
            has_stopped: track.is_running.last() == Some(&false),
            states: self.states(track),
            corridor: corridors.collect(),
            waiting: self.times_of(track, Conduct::Waiting),
            crossing: self.times_of(track, Conduct::OnRoad),
        }
    }

    fn open(&self, open: &Open) -> (u64, u64) {
        let to_us = open.to_us.unwrap_or(self.to_us);
        (self.since(open.from_us), self.since(to_us))
    }

    /// In which column of a screen a time is.
    fn column(&self, at: u64) -> u64 {
        let lasted = u128::from(self.since(self.to_us).max(1));
        u64::try_from(u128::from(at) * u128::from(COLUMNS) / lasted).unwrap_or(COLUMNS)
    }

    fn states(&self, track: &Track) -> Vec<StateSpan> {
        let mut spans: Vec<StateSpan> = Vec::new();
        for (at_us, view) in track.views.iter() {
            let at = self.since(*at_us);
            let text = match (view.executes, view.role) {
                (Some(task), _) => task.to_string(),
                (None, Role::None) => self.messages.names.tell(&view.duty),
                (None, role) => role.to_string(),
            };
            let is_narrow = |last: &StateSpan| self.column(last.from) == self.column(at);
            match spans.last_mut() {
                Some(last) if last.state == view.state && last.text == text => last.to = at,
                Some(last) if is_narrow(last) => {
                    last.to = at;
                    if stage(view.state) > stage(last.state) {
                        (last.state, last.text) = (view.state, text);
                    }
                }
                last => {
                    if let Some(last) = last {
                        last.to = at;
                    }
                    spans.push(StateSpan {
                        from: at,
                        to: at,
                        state: view.state,
                        text,
                    });
                }
            }
        }
        if let Some(last) = spans.last_mut() {
            last.to = self.since(self.to_us);
        }
        spans
    }

    /// The times in which a robot had somebody who does this.
    fn times_of(&self, track: &Track, conduct: Conduct) -> Vec<(u64, u64)> {
        let mut spans: Vec<(u64, u64)> = Vec::new();
        let mut since = None;
        let end = (self.to_us, false);
        let sights = track
            .sights
            .iter()
            .map(|(at_us, sight)| (*at_us, sight.count(conduct) > 0));
        for (at_us, is_there) in sights.chain([end]) {
            let at = self.since(at_us);
            match (since, is_there) {
                (None, true) => since = Some(at),
                (Some(from), false) => {
                    since = None;
                    match spans.last_mut() {
                        Some(last) if self.column(last.1) == self.column(from) => last.1 = at,
                        _ => spans.push((from, at)),
                    }
                }
                _ => {}
            }
        }
        spans
    }

    fn trials(&self) -> Vec<Trial> {
        let mut trials: BTreeMap<(u64, String), Trial> = BTreeMap::new();
        let mut begins: BTreeMap<String, u64> = BTreeMap::new();
        let parts: Vec<_> = self.robots.iter().flat_map(|it| self.parts(it)).collect();
        for (session, from, ..) in &parts {
            let begin = begins.entry(session.clone()).or_insert(*from);
            *begin = (*begin).min(*from);
        }
        for (session, from, to, track, leads) in parts {
            let begin = begins.get(&session).copied().unwrap_or(from);
            let is_full = trials.len() >= TRIALS_MAX;
            let key = (begin, session.clone());
            if is_full && !trials.contains_key(&key) {
                continue;
            }
            let trial = trials.entry(key).or_insert_with(|| Trial {
                session: self.messages.names.tell(session),
                leader: String::new(),
                team: Vec::new(),
                from,
                to,
                open: 0,
                closed: String::new(),
            });
            (trial.from, trial.to) = (trial.from.min(from), trial.to.max(to));
            if leads {
                trial.leader.clone_from(&track.name);
                for open in &track.corridor {
                    let (opened, closed) = self.open(open);
                    if opened >= from && opened <= to {
                        trial.open += closed.saturating_sub(opened);
                        trial.closed = self.messages.names.tell(&open.why);
                    }
                }
            } else if !trial.team.contains(&track.name) {
                trial.team.push(track.name.clone());
            }
        }
        trials.into_values().collect()
    }

    /// The parts that a robot had in sessions: session, from, to, the robot, and whether it led.
    fn parts<'a>(&self, track: &'a Track) -> Vec<(String, u64, u64, &'a Track, bool)> {
        let mut parts: Vec<(String, u64, u64, &Track, bool)> = Vec::new();
        let mut running = None;
        for (at_us, view) in track.views.iter() {
            let at = self.since(*at_us);
            let session = view.session.map(|session| session.to_string());
            if running.is_some()
                && let Some(last) = parts.last_mut()
            {
                last.2 = at;
            }
            if session != running
                && let Some(session) = &session
            {
                let leads = view
                    .session
                    .is_some_and(|it| track.stations.contains(&it.leader));
                parts.push((session.clone(), at, at, track, leads));
            }
            running = session;
        }
        if running.is_some()
            && let Some(last) = parts.last_mut()
        {
            last.2 = self.since(self.to_us);
        }
        parts
    }

    fn street(&self) -> Street {
        let mut points: Vec<Metres> = Vec::new();
        let (mut waiting, mut road) = (Vec::new(), Vec::new());
        for track in &self.robots {
            let places = track.places.iter().map(|(_, placed)| placed.degrees());
            points.extend(places.map(|place| self.metres(place)));
            let areas = track.areas.iter().flat_map(|(_, areas)| areas);
            points.extend(areas.map(|area| self.metres(area.to)));
            if let Some(zone) = track.zone.last() {
                let outline = |corners: &[(f64, f64)]| -> Vec<Metres> {
                    corners.iter().map(|at| self.metres(*at)).collect()
                };
                waiting.push(outline(&zone.waiting));
                road.push(outline(&zone.road));
            }
        }
        points.extend(waiting.iter().chain(&road).flatten());
        let place = |place: crossguard_robot::site::Place| [place.east, place.north];
        let (mut kerbs, mut lanes, mut places) = (Vec::new(), Vec::new(), Vec::new());
        if let Some(street) = &self.street {
            kerbs.extend(street.kerbs.iter().flatten().map(|kerb| kerb.map(place)));
            points.extend(kerbs.iter().flatten());
            lanes.extend(street.lanes.iter().map(|lane| {
                let (from, to) = (place(lane.from), place(lane.to));
                (lane.name.clone(), from, to, lane.width_m)
            }));
            let spots = street.places.iter();
            places.extend(spots.map(|(name, spot)| (name.clone(), place(spot.place))));
        }
        Street {
            extent: extent(&points),
            kerbs,
            lanes,
            places,
            waiting,
            road,
        }
    }
}

fn extent(points: &[Metres]) -> Option<[f64; 4]> {
    let &[east, north] = points.first()?;
    let around = |[west, south, east, north]: [f64; 4], [x, y]: &Metres| {
        [west.min(*x), south.min(*y), east.max(*x), north.max(*y)]
    };
    Some(points.iter().fold([east, north, east, north], around))
}

/// The stage of a state, so that of two the one that tells more is shown.
const fn stage(state: State) -> u8 {
    match state {
        State::Idle => 0,
        State::HelpRequested => 1,
        State::RoleEstablished => 2,
        State::ManeuverExecuting => 3,
    }
}

#[cfg(test)]
mod tests {
    use crossguard_robot::sight::{RoadUser, Seen, Sight};
    use crossguard_robot::trace::{Entry, Record, Timed};

    use super::*;
    use crate::playback::Recent;

    #[test]
    fn people_who_wait_and_who_are_on_the_road_have_times_of_their_own() {
        let mut recent = Recent::default();
        for (at_us, conducts) in [
            (1_000_000, &[Conduct::Waiting][..]),
            (2_000_000, &[Conduct::Waiting, Conduct::OnRoad]),
            (3_000_000, &[Conduct::OnRoad]),
            (5_000_000, &[Conduct::Across]),
        ] {
            let seen = |conduct: &Conduct| Seen {
                place: (49.0, 8.4),
                class: RoadUser::Pedestrian,
                conduct: *conduct,
            };
            let people = conducts.iter().map(seen).collect();
            let record = Record {
                at_us,
                robot: "ARI".to_owned(),
                entry: Entry::People(Sight {
                    people,
                    vehicles: Vec::new(),
                }),
            };
            recent.take(Timed {
                log: 0,
                at_us,
                record,
            });
        }
        let overview = recent.playback(None, 6_000_000).overview(&[]);
        let robot = &overview.robots[0];
        assert_eq!(robot.waiting, [(0, 2_000_000)]);
        assert_eq!(robot.crossing, [(1_000_000, 4_000_000)]);
    }
}
