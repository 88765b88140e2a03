//! The street: people, a vehicle, the guard's body, the sign and the sensor, and what may happen to them in a tick.

use std::fmt;

use crossguard_crossing::{Input, Point, Vehicle, Way};
use crossguard_protocol::{
    Event, HelpRequest, Millis, Place, StationId, TaskSet, TaskType, Urgency,
};
use stateright::Property;

use crate::exploration::Stop;

use super::people::{Cell, PEOPLE_MAX, Person, Seen, tell_frame};
use super::rules::{FOLLOWING, Rules};
use super::team::Team;
use super::truth::{AWAY_MAX, DETECT_MAX, END_MAX, Rule, STOP_M};
use super::{Street, Watch};

pub(super) const TICK: Millis = Millis(500);

/// For how many ticks after go has ended people who are late step on the road, and that time.
const LATE: u8 = 4;
pub(super) const LATE_TIME: Millis = Millis(TICK.0 * LATE as u32);

/// How far a vehicle comes in a tick, in metres: more than at 50 km/h.
const PER_TICK_M: u8 = 14;

/// How far away it comes into hearing, in metres; one that is asked comes from farther, so that it can answer in time.
const fn comes_m(street: &Street) -> u8 {
    if street.asks { 126 } else { 84 }
}

const VEHICLE: StationId = StationId(7);

#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
#[expect(clippy::struct_excessive_bools, reason = "each is a fact of its own")]
pub(super) struct Guard {
    /// It is 4 m off its place.
    pub(super) is_drifted: bool,
    /// It does not say any more where it is.
    pub(super) is_lost: bool,
    /// For how many ticks it has not guarded at its place, saturating.
    pub(super) away: u8,
    /// Whether it guards: it executes its maneuver, or holds a place.
    pub(super) is_guarding: bool,
    /// It has guarded, and does not any more; or a word of the leader has freed it.
    pub(super) has_left: bool,
    /// A vehicle has come within its way to stop for a tick, and nobody has been on the road.
    pub(super) ought_to_wait: bool,
    /// It stepped on the road all the same.
    pub(super) stepped_out: bool,
}

impl Guard {
    /// Whether its body is not where it goes by its maneuver, or does not know where that is.
    const fn is_off(self) -> bool {
        self.is_drifted || self.is_lost
    }
}

/// Messages between the leader and a follower that are lost.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) struct Cut {
    pub(super) follower: usize,
    pub(super) to_leader: bool,
    pub(super) to_follower: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub(super) struct Sign {
    /// For how many milliseconds yet it shows go.
    pub(super) left: u32,
    /// For how many ticks yet somebody who saw it may step on the road.
    late: u8,
    pub(super) has_begun: bool,
    /// Whether a vehicle was asked in this tick to stop.
    pub(super) asks: bool,
}

impl Sign {
    pub(super) const fn shows_go(self) -> bool {
        self.left > 0
    }

    pub(super) const fn lets_go(self) -> bool {
        self.shows_go() || self.late > 0
    }
}

/// Inputs of the leader at a tick.
pub(super) struct Sensed<'a> {
    /// How many ticks have passed since it ran last; none while it hangs.
    pub(super) passed: u8,
    pub(super) cut: Option<Cut>,
    /// Frames with their ages in ticks.
    frames: &'a [(u8, Seen)],
    vehicle: Option<Vehicle>,
    answer: Option<bool>,
    /// The frame of this tick, for a follower that sees.
    now: Option<Seen>,
    /// Event of the leader's application, if that may say anything.
    pub(super) word: Option<Event>,
}

impl Sensed<'_> {
    /// Calls `tell` with everything that the leader takes in, in order.
    pub(super) fn each(&self, mut tell: impl FnMut(Input<'_>)) {
        for (age, seen) in self.frames {
            tell_frame(*age, *seen, &mut tell);
        }
        if let Some(promises) = self.answer {
            tell(Input::Answered(VEHICLE, promises));
        }
        self.vehicle(tell);
    }

    /// Calls `tell` with the vehicle that is heard, if there is one.
    pub(super) fn vehicle(&self, mut tell: impl FnMut(Input<'_>)) {
        if let Some(vehicle) = self.vehicle {
            tell(Input::Vehicle(vehicle, Millis::ZERO));
        }
    }

    /// Calls `tell` with what the follower sees.
    pub(super) fn now(&self, mut tell: impl FnMut(Input<'_>)) {
        if let Some(seen) = self.now {
            tell_frame(0, seen, &mut tell);
        }
    }
}

#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(super) struct State {
    pub(super) team: Team,
    cut: Option<Cut>,
    pub(super) people: Vec<Person>,
    pub(super) guards: Vec<Guard>,
    pub(super) sign: Sign,
    /// How many metres a vehicle is before the crossing.
    pub(super) car: Option<u8>,
    /// Whether it has told the leader that it will stop, and has not taken that back.
    pub(super) promised: bool,
    /// Go began while it had been heard for a tick and had not.
    pub(super) began_unpromised: bool,
    /// Frames that wait for a leader that hangs, oldest first, with their ages in ticks.
    piled: Vec<(u8, Seen)>,
    /// For how many ticks the leader hangs already.
    hangs: u8,
    pub(super) left: Street,
    pub(super) is_free: bool,
    /// For how many ticks somebody has waited in front of an idle team.
    pub(super) undetected: u8,
    /// For how many ticks everybody has been off the road for good and the team is not free.
    pub(super) off_road: u8,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Tick {
    moves: [Option<Cell>; PEOPLE_MAX],
    missed: [bool; PEOPLE_MAX],
    fault: Fault,
    /// Answer of a vehicle that was asked, if it gives one.
    answer: Option<bool>,
    /// Event of the leader's application, if that may say anything.
    word: Option<Event>,
}

/// A fault, its end, or a vehicle that comes along; one at most in a tick.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Fault {
    None,
    ChangesIds,
    Blind,
    Hangs,
    Drifts(usize),
    IsLost(usize),
    CarComes,
    /// An outage begins.
    Cuts(Cut),
    /// It ends.
    Restores,
}

/// A street to explore.
#[derive(Clone, Debug)]
pub(super) struct World {
    pub(super) street: Street,
    pub(super) rules: Rules,
    /// While it is requested nothing happens any more, and the exploration ends.
    pub(super) drain: Stop,
}

impl World {
    fn moves(&self, state: &State) -> Vec<([Option<Cell>; PEOPLE_MAX], [bool; PEOPLE_MAX])> {
        let mut all = vec![([None; PEOPLE_MAX], [false; PEOPLE_MAX])];
        let goes = state.sign.lets_go();
        for (number, person) in state.people.iter().enumerate() {
            let mut more = Vec::new();
            for (moves, missed) in &all {
                for cell in person.at.moves(goes, state.is_free, self.street.late) {
                    // No person runs across in a second. One who did, and was missed, would be one who waits over there.
                    if *cell == Cell::Far && person.at.is_road() && person.on_road < 2 {
                        continue;
                    }
                    for is_missed in [false, true] {
                        if is_missed && (person.missed >= self.street.misses || *cell == Cell::Away)
                        {
                            continue;
                        }
                        let (mut moves, mut missed) = (*moves, *missed);
                        (moves[number], missed[number]) = (Some(*cell), is_missed);
                        more.push((moves, missed));
                    }
                }
            }
            all = more;
        }
        all
    }

    fn faults(state: &State) -> Vec<Fault> {
        let left = &state.left;
        let may_cut = left.outages > 0 && state.cut.is_none();
        // Once a leader without a machine hangs, it hangs for as long as it may.
        let is_silent = left.watch == Watch::Guard && state.hangs > 0 && left.hang > 0;
        let possible = [
            (Fault::None, !is_silent),
            (Fault::ChangesIds, left.id_changes > 0),
            (Fault::Blind, left.blind > 0),
            (Fault::Hangs, left.hang > 0),
            (Fault::CarComes, left.vehicle),
            (Fault::Restores, state.cut.is_some()),
        ];
        let of_guards = state
            .guards
            .iter()
            .enumerate()
            .flat_map(|(follower, guard)| {
                let may_drift = left.drifts > 0 && guard.is_guarding && !guard.is_off();
                let cut = |to_leader, to_follower| {
                    let cut = Cut {
                        follower,
                        to_leader,
                        to_follower,
                    };
                    (Fault::Cuts(cut), may_cut)
                };
                [
                    (Fault::Drifts(follower), may_drift),
                    (Fault::IsLost(follower), may_drift),
                    cut(true, false),
                    cut(false, true),
                    cut(true, true),
                ]
            });
        let possible = possible.into_iter().chain(of_guards);
        let possible = possible.filter(|(_, may)| *may);
        possible.map(|(fault, _)| fault).collect()
    }

    fn successor(&self, state: &State, tick: Tick) -> State {
        let mut next = state.clone();
        next.move_all(tick);
        next.sense(&self.rules, tick);
        next.judge(tick.fault);
        next
    }
}

impl State {
    fn move_all(&mut self, tick: Tick) {
        for (person, to) in self.people.iter_mut().zip(tick.moves) {
            person.at = to.unwrap_or(person.at);
            person.has_walked |= person.at.is_road();
            let since = (person.on_road + 1).min(2);
            person.on_road = if person.at.is_road() { since } else { 0 };
            // A guard that is on its own has to see anew who steps on the road again.
            person.was_seen_there &= person.at.is_road() || self.left.watch != Watch::Guard;
        }
        self.sign.late = if self.sign.shows_go() && self.left.late {
            LATE
        } else {
            self.sign.late.saturating_sub(1)
        };
        self.sign.left = self.sign.left.saturating_sub(TICK.0);
        let has_come = self.car.is_some_and(|metres| metres + PER_TICK_M <= STOP_M);
        self.car = self.car.and_then(|metres| metres.checked_sub(PER_TICK_M));
        self.car = self.car.filter(|metres| *metres > 0);
        self.promised &= self.car.is_some();
        let ought_to_wait = has_come && !self.people.iter().any(|it| it.has_walked);
        for (follower, guard) in self.guards.iter_mut().enumerate() {
            if self.team.begins(follower) {
                (guard.is_drifted, guard.is_lost) = (false, false);
            }
            guard.ought_to_wait = ought_to_wait;
            guard.stepped_out = self.team.walk(follower) && ought_to_wait;
        }
        let left = &mut self.left;
        left.words -= u8::from(tick.word.is_some());
        match tick.fault {
            Fault::None => {}
            Fault::ChangesIds => {
                left.id_changes -= 1;
                match &mut self.people[..] {
                    [first, second] => core::mem::swap(&mut first.id, &mut second.id),
                    people => people.iter_mut().for_each(|it| it.id += 1),
                }
            }
            Fault::Blind => left.blind -= 1,
            Fault::Hangs => left.hang -= 1,
            Fault::Drifts(follower) => {
                (left.drifts, self.guards[follower].is_drifted) = (left.drifts - 1, true);
            }
            Fault::IsLost(follower) => {
                (left.drifts, self.guards[follower].is_lost) = (left.drifts - 1, true);
            }
            Fault::CarComes => (left.vehicle, self.car) = (false, Some(comes_m(left))),
            Fault::Cuts(cut) => (left.outages, self.cut) = (left.outages - 1, Some(cut)),
            Fault::Restores => self.cut = None,
        }
    }

    fn sense(&mut self, rules: &Rules, tick: Tick) {
        let went = self.sign.shows_go();
        let mut seen = [None; PEOPLE_MAX];
        for (number, person) in self.people.iter_mut().enumerate() {
            let is_missed = tick.missed[number];
            // A frame that is not made misses nobody.
            if tick.fault != Fault::Blind {
                person.missed = if is_missed { person.missed + 1 } else { 0 };
            }
            if !is_missed && person.at != Cell::Away {
                seen[number] = Some((person.at, person.id));
                let is_taken_in = match (self.left.watch, tick.fault) {
                    (_, Fault::Blind) => false,
                    (Watch::Guard, _) => !self.guards.iter().any(|it| it.has_left),
                    (Watch::Leader | Watch::Both, fault) => fault != Fault::Hangs,
                };
                person.was_seen_there |= is_taken_in && person.at.is_road();
            }
        }
        for (age, _) in &mut self.piled {
            *age += 1;
        }
        if tick.fault != Fault::Blind {
            self.piled.push((0, seen));
        }
        let (passed, frames) = if tick.fault == Fault::Hangs {
            self.hangs += 1;
            (0, Vec::new())
        } else {
            let hung = core::mem::take(&mut self.hangs);
            (hung + 1, core::mem::take(&mut self.piled))
        };
        let answer = tick.answer.filter(|_| passed > 0);
        let had_promised = self.promised;
        self.promised = answer.unwrap_or(self.promised);
        self.sign.asks = false;
        let sensed = Sensed {
            passed,
            cut: self.cut,
            frames: &frames,
            vehicle: self.car.map(vehicle),
            answer,
            now: (tick.fault != Fault::Blind).then_some(seen),
            word: tick.word,
        };
        let is_road_empty = !self.people.iter().any(|it| it.at.is_road());
        self.team
            .tick(rules, &self.guards, &sensed, is_road_empty, &mut self.sign);
        self.sign.has_begun = self.sign.shows_go() && !went;
        let is_silent = self.is_heard() && !had_promised && !self.promised;
        self.began_unpromised = self.left.asks && self.sign.has_begun && is_silent;
    }

    /// Whether there is a vehicle that was heard a tick ago.
    pub(super) fn is_heard(&self) -> bool {
        self.car.is_some_and(|metres| metres < comes_m(&self.left))
    }

    fn judge(&mut self, fault: Fault) {
        for (follower, guard) in self.guards.iter_mut().enumerate() {
            guard.is_guarding = self.team.guards(follower);
            guard.has_left = self.team.has_left(follower);
            let is_there = guard.is_guarding && self.team.is_posted(follower) && !guard.is_off();
            guard.away = if is_there {
                0
            } else {
                (guard.away + 1).min(AWAY_MAX + 1)
            };
        }
        self.is_free = self.team.is_idle();
        // Where an application may say anything, nobody need be detected, and no session need end.
        let is_disturbed =
            self.hangs > 0 || fault == Fault::Blind || self.left.watch == Watch::Guard;
        let is_new = |it: &Person| it.at == Cell::Near && !it.has_walked;
        let waits = self.people.iter().any(is_new);
        self.undetected = if waits && self.is_free && !is_disturbed {
            (self.undetected + 1).min(DETECT_MAX + 1)
        } else {
            0
        };
        // A person at the other kerb that no frame had on the road waits there, as far as any robot can know.
        let is_off_road =
            |it: &Person| it.at == Cell::Away || it.at == Cell::Far && it.was_seen_there;
        let is_disturbed = is_disturbed || self.cut.is_some();
        let is_calm = self.people.iter().all(is_off_road) && !is_disturbed && self.car.is_none();
        self.off_road = if is_calm && !self.is_free {
            (self.off_road + 1).min(END_MAX + 1)
        } else {
            0
        };
        self.team.canonicalize();
    }
}

/// Events that the application of a leader without a machine may report, true or not.
const WORDS: [Option<Event>; 8] = [
    None,
    Some(Event::PedestrianDetected(HelpRequest {
        urgency: Urgency::Medium,
        followers: 1,
        tasks: TaskSet::of(&[TaskType::BLOCK]),
        place: Place::UNKNOWN,
    })),
    Some(Event::CommandManeuver {
        follower: FOLLOWING[0],
        task: TaskType::BLOCK,
    }),
    Some(Event::OpenCorridor),
    Some(Event::CloseCorridor),
    Some(Event::RoadClear),
    Some(Event::TaskCompleted),
    Some(Event::LeaveRequested),
];

fn vehicle(metres: u8) -> Vehicle {
    Vehicle {
        key: 7,
        station: Some(VEHICLE),
        at: Point::new(-300 - 100 * i32::from(metres), 200),
        front_cm: 0,
        length_cm: 1_200,
        error_cm: 0,
        velocity: Way {
            east_cm: 1_389,
            north_cm: 0,
        },
        goes_anywhere: false,
    }
}

impl stateright::Model for World {
    type State = State;
    type Action = Tick;

    fn init_states(&self) -> Vec<State> {
        let person = |number: u8| Person {
            at: Cell::Near,
            missed: 0,
            id: number,
            has_walked: false,
            was_seen_there: false,
            on_road: 0,
        };
        let guard = Guard {
            away: AWAY_MAX + 1,
            ..Guard::default()
        };
        vec![State {
            team: Team::new(self.street.guards.into()),
            cut: None,
            people: (0..self.street.people).map(person).collect(),
            guards: vec![guard; self.street.guards.into()],
            sign: Sign::default(),
            car: None,
            promised: false,
            began_unpromised: false,
            piled: Vec::new(),
            hangs: 0,
            left: self.street,
            is_free: true,
            undetected: 0,
            off_road: 0,
        }]
    }

    fn actions(&self, state: &State, ticks: &mut Vec<Tick>) {
        if self.drain.is_requested() {
            return;
        }
        let words = if state.left.words > 0 {
            &WORDS[..]
        } else {
            &[None]
        };
        let answers = if state.sign.asks && state.car.is_some() {
            &[None, Some(true), Some(false)][..]
        } else {
            &[None]
        };
        for (moves, missed) in self.moves(state) {
            for fault in Self::faults(state) {
                for &answer in answers {
                    ticks.extend(words.iter().map(|&word| Tick {
                        moves,
                        missed,
                        fault,
                        answer,
                        word,
                    }));
                }
            }
        }
    }

    fn next_state(&self, state: &State, tick: Tick) -> Option<State> {
        Some(self.successor(state, tick))
    }

    fn properties(&self) -> Vec<Property<Self>> {
        let mut properties = Rule::properties();
        // One that never comes about, so that the exploration goes to its end.
        properties.push(Property::sometimes("never", |_, _| false));
        properties
    }
}

impl fmt::Display for State {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for person in &self.people {
            let missed = if person.missed > 0 { ", missed" } else { "" };
            write!(f, "{:?} as {}{missed}; ", person.at, person.id)?;
        }
        let sign = if self.sign.shows_go() { "go" } else { "stop" };
        write!(f, "sign {sign}, {}", self.team)?;
        if let Some(metres) = self.car {
            write!(f, ", a vehicle {metres} m away")?;
            if self.promised {
                write!(f, " that says it will stop")?;
            }
        }
        if self.hangs > 0 {
            write!(f, ", the leader hangs")?;
        }
        for (guard, station) in self.guards.iter().zip(FOLLOWING) {
            let told = [
                (guard.is_guarding && guard.away > 0, "is off its place"),
                (guard.has_left, "has left"),
            ];
            for (_, what) in told.iter().filter(|(is, _)| *is) {
                write!(f, ", the guard {station} {what}")?;
            }
        }
        if let Some(cut) = self.cut {
            let station = FOLLOWING[cut.follower];
            let ways = match (cut.to_leader, cut.to_follower) {
                (true, true) => "from and to",
                (true, false) => "from",
                _ => "to",
            };
            write!(f, ", messages {ways} {station} are lost")?;
        }
        Ok(())
    }
}
