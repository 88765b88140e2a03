//! The ground truth and what may happen to it in a tick.

use std::fmt;

use crossguard_crossing::{Point, RoadUser, Sighting, Vehicle, Way};
use stateright::Property;

use super::Scenario;
use super::team::{Sensed, Team};
use super::truth::{DETECT_MAX, END_MAX, Premise, Rule};

/// How many people there are at most.
pub(super) const PEOPLE_MAX: usize = 2;

/// Where somebody is.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Cell {
    Near,
    Lane,
    Beside,
    Far,
    Away,
}

impl Cell {
    pub(super) const fn is_road(self) -> bool {
        matches!(self, Self::Lane | Self::Beside)
    }

    /// Where it is: cells that can be reached in a tick are less than 4 m apart.
    pub(super) const fn place(self, person: usize) -> Point {
        let east = if person == 0 { 100 } else { 0 };
        match self {
            Self::Near => Point::new(east, -30),
            Self::Lane => Point::new(east, 350),
            Self::Beside => Point::new(450 + east, 350),
            Self::Far => Point::new(east, 730),
            Self::Away => Point::new(east, -4_000),
        }
    }

    /// Where somebody may be a tick later.
    const fn moves(self, goes: bool) -> &'static [Self] {
        match self {
            Self::Near if goes => &[Self::Near, Self::Lane, Self::Away],
            Self::Near => &[Self::Near, Self::Away],
            Self::Lane => &[Self::Lane, Self::Near, Self::Far, Self::Beside],
            Self::Beside => &[Self::Beside, Self::Lane],
            Self::Far => &[Self::Far],
            Self::Away => &[Self::Away],
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) struct Person {
    pub(super) at: Cell,
    /// In how many frames the sensor has missed them in a row.
    pub(super) missed: u8,
    id: u32,
}

/// The guard's body.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub(super) struct Guard {
    /// It is 4 m off its place.
    pub(super) is_drifted: bool,
    /// It does not say any more where it is.
    pub(super) is_lost: bool,
    /// For how many ticks it has been off its place, saturating.
    pub(super) adrift: u8,
    /// It has guarded, and does not any more.
    pub(super) has_left: bool,
}

/// The leader's sign.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub(super) struct Sign {
    /// For how many milliseconds yet it shows go.
    pub(super) left: u32,
    /// Whether go began in this tick.
    pub(super) has_begun: bool,
}

impl Sign {
    pub(super) const fn shows_go(self) -> bool {
        self.left > 0
    }
}

/// Who was where, and was seen as whom, at one time.
pub(super) type Seen = [Option<(Cell, u32)>; PEOPLE_MAX];

/// One state.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(super) struct State {
    pub(super) team: Team,
    pub(super) people: Vec<Person>,
    pub(super) guard: Guard,
    pub(super) sign: Sign,
    /// How many metres a vehicle is before the crossing.
    pub(super) car: Option<u8>,
    /// Frames that wait for a leader that hangs, oldest first, with their ages in ticks.
    piled: Vec<(u8, Seen)>,
    /// For how many ticks the leader hangs already.
    hangs: u8,
    id_changes: u8,
    hang: u8,
    blind: u8,
    drifts: u8,
    has_car: bool,
    /// For how many ticks somebody has waited in front of an idle leader.
    pub(super) undetected: u8,
    /// For how many ticks everybody has been off the road for good and the session stands.
    pub(super) off_road: u8,
    /// Whether the session is over and everybody idle.
    pub(super) is_over: bool,
}

/// What happens in a tick.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Tick {
    moves: [Option<Cell>; PEOPLE_MAX],
    /// Who is missed.
    missed: [bool; PEOPLE_MAX],
    changes_ids: bool,
    is_blind: bool,
    hangs: bool,
    drift: Drift,
    car: Car,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Drift {
    None,
    Drifts,
    IsLost,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Car {
    Goes,
    Comes,
}

/// A scenario to explore.
#[derive(Clone, Copy, Debug)]
pub(super) struct Street(Scenario);

impl Street {
    pub(super) const fn new(scenario: Scenario) -> Self {
        Self(scenario)
    }

    fn moves(&self, state: &State) -> Vec<([Option<Cell>; PEOPLE_MAX], [bool; PEOPLE_MAX])> {
        let mut all = vec![([None; PEOPLE_MAX], [false; PEOPLE_MAX])];
        for (number, person) in state.people.iter().enumerate() {
            let mut more = Vec::new();
            for (moves, missed) in &all {
                for cell in person.at.moves(state.sign.shows_go()) {
                    for is_missed in [false, true] {
                        if is_missed && (person.missed >= self.0.misses || *cell == Cell::Away) {
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

    fn successor(&self, state: &State, tick: Tick) -> State {
        let mut next = state.clone();
        next.move_all(tick);
        next.sense(&self.0, tick);
        next.judge();
        next
    }
}

impl State {
    /// People, the car and the guard move, and the sign goes on.
    fn move_all(&mut self, tick: Tick) {
        for (person, to) in self.people.iter_mut().zip(tick.moves) {
            person.at = to.unwrap_or(person.at);
        }
        self.sign.left = self.sign.left.saturating_sub(super::team::TICK.0);
        if tick.changes_ids {
            self.id_changes += 1;
            match &mut self.people[..] {
                [first, second] => core::mem::swap(&mut first.id, &mut second.id),
                people => people.iter_mut().for_each(|it| it.id += 1),
            }
        }
        match (tick.car, self.car) {
            (Car::Comes, _) => (self.has_car, self.car) = (true, Some(84)),
            (Car::Goes, Some(metres)) => self.car = metres.checked_sub(14).filter(|it| *it > 0),
            (Car::Goes, None) => {}
        }
        match tick.drift {
            Drift::None => {}
            Drift::Drifts => self.guard.is_drifted = true,
            Drift::IsLost => self.guard.is_lost = true,
        }
        self.drifts += u8::from(tick.drift != Drift::None);
        if self.team.begins() {
            self.guard = Guard::default();
        }
        self.team.walk();
    }

    /// The sensor looks, and the robots do what they do.
    fn sense(&mut self, scenario: &Scenario, tick: Tick) {
        let went = self.sign.shows_go();
        let mut seen = [None; PEOPLE_MAX];
        for (number, person) in self.people.iter_mut().enumerate() {
            let is_missed = tick.missed[number];
            person.missed = if is_missed { person.missed + 1 } else { 0 };
            if !is_missed && person.at != Cell::Away {
                seen[number] = Some((person.at, person.id));
            }
        }
        for (age, _) in &mut self.piled {
            *age += 1;
        }
        self.blind += u8::from(tick.is_blind);
        if !tick.is_blind {
            self.piled.push((0, seen));
        }
        let passed = if tick.hangs {
            self.hang += 1;
            self.hangs += 1;
            0
        } else {
            core::mem::take(&mut self.hangs) + 1
        };
        let frames = if tick.hangs {
            Vec::new()
        } else {
            core::mem::take(&mut self.piled)
        };
        let sensed = Sensed {
            passed,
            frames: &frames,
            vehicle: self.car.map(vehicle),
        };
        self.team
            .tick(scenario, self.guard, &sensed, &mut self.sign);
        self.sign.has_begun = self.sign.shows_go() && !went;
    }

    /// What is kept of the past to judge by.
    fn judge(&mut self) {
        let guards = self.team.guards();
        self.guard.has_left = self.team.has_guarded() && !guards;
        let is_off = self.guard.is_drifted || self.guard.is_lost;
        self.guard.adrift = if is_off && guards {
            (self.guard.adrift + 1).min(3)
        } else {
            0
        };
        let waits = self.people.iter().any(|it| it.at == Cell::Near);
        let is_idle = self.team.is_idle();
        let is_disturbed = self.hangs > 0 || self.team.has_called();
        self.undetected = if waits && is_idle && !is_disturbed {
            (self.undetected + 1).min(DETECT_MAX + 1)
        } else {
            0
        };
        let is_off_road = |it: &Person| matches!(it.at, Cell::Far | Cell::Away);
        let is_calm = self.people.iter().all(is_off_road) && self.hangs == 0 && self.car.is_none();
        self.off_road = if is_calm && !is_idle {
            (self.off_road + 1).min(END_MAX + 1)
        } else {
            0
        };
        self.is_over = self.team.has_called() && is_idle;
        self.team.canonicalize();
    }
}

fn vehicle(metres: u8) -> Vehicle {
    Vehicle {
        key: 7,
        at: Point::new(-300 - 100 * i32::from(metres), 200),
        error_cm: 0,
        velocity: Way {
            east_cm: 1_389,
            north_cm: 0,
        },
    }
}

/// Somebody as a frame has them.
pub(super) fn sighting(person: usize, (cell, id): (Cell, u32)) -> Sighting {
    Sighting {
        id: Some(id),
        at: cell.place(person),
        error_cm: 0,
        velocity: None,
        what: RoadUser::Pedestrian,
        confidence: 90,
    }
}

impl stateright::Model for Street {
    type State = State;
    type Action = Tick;

    fn init_states(&self) -> Vec<State> {
        let person = |number: usize| Person {
            at: Cell::Near,
            missed: 0,
            id: u32::try_from(number).unwrap_or_default(),
        };
        vec![State {
            team: Team::new(),
            people: (0..self.0.people.min(PEOPLE_MAX)).map(person).collect(),
            guard: Guard::default(),
            sign: Sign::default(),
            car: None,
            piled: Vec::new(),
            hangs: 0,
            id_changes: 0,
            hang: 0,
            blind: 0,
            drifts: 0,
            has_car: false,
            undetected: 0,
            off_road: 0,
            is_over: false,
        }]
    }

    fn actions(&self, state: &State, ticks: &mut Vec<Tick>) {
        if state.is_over {
            return;
        }
        let may = |is: bool| if is { &[false, true][..] } else { &[false] };
        let scenario = &self.0;
        let may_drift = state.drifts < scenario.drifts && state.team.guards();
        let drifts: &[Drift] = if may_drift {
            &[Drift::None, Drift::Drifts, Drift::IsLost]
        } else {
            &[Drift::None]
        };
        let cars: &[Car] = if scenario.vehicle && !state.has_car {
            &[Car::Goes, Car::Comes]
        } else {
            &[Car::Goes]
        };
        for (moves, missed) in self.moves(state) {
            for &changes_ids in may(state.id_changes < scenario.id_changes) {
                for &is_blind in may(state.blind < scenario.blind) {
                    for &hangs in may(state.hang < scenario.hang) {
                        for &drift in drifts {
                            ticks.extend(cars.iter().map(|&car| Tick {
                                moves,
                                missed,
                                changes_ids,
                                is_blind,
                                hangs,
                                drift,
                                car,
                            }));
                        }
                    }
                }
            }
        }
    }

    fn next_state(&self, state: &State, tick: Tick) -> Option<State> {
        Some(self.successor(state, tick))
    }

    fn properties(&self) -> Vec<Property<Self>> {
        let rules = [
            Property::always(Rule::P1.name(), |_: &Self, state| Rule::P1.holds(state)),
            Property::always(Rule::P2.name(), |_: &Self, state| Rule::P2.holds(state)),
            Property::always(Rule::P3.name(), |_: &Self, state| Rule::P3.holds(state)),
            Property::always(Rule::P5.name(), |_: &Self, state| Rule::P5.holds(state)),
            Property::always(Rule::P6.name(), |_: &Self, state| Rule::P6.holds(state)),
        ];
        let mut properties = Vec::from(rules);
        macro_rules! premises {
            ($($premise:ident)*) => {$(
                properties.push(Property::sometimes(
                    Premise::$premise.name(),
                    |_: &Self, state| Premise::$premise.is_reached(state),
                ));
            )*};
        }
        premises!(Crosses Stopped Beside Missed Adrift Car Done);
        // One that never comes about, so that the exploration goes to its end.
        properties.push(Property::sometimes("never", |_, _| false));
        properties
    }
}

impl fmt::Display for State {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for person in &self.people {
            write!(
                f,
                "{:?}(missed {}, id {}) ",
                person.at, person.missed, person.id
            )?;
        }
        let sign = if self.sign.shows_go() { "go" } else { "stop" };
        write!(
            f,
            "sign {sign}, {:?}, car {:?}, hangs {}, ",
            self.guard, self.car, self.hangs
        )?;
        write!(f, "{}", self.team)
    }
}
