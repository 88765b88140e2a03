//! The crossing machine with real robots, people, a sensor, a body, a sign and a vehicle, explored to the end by stateright.
//!
//! ```text
//!   people ──► sensor: misses, ids, blindness ──► Crossing ◄──► Robot   leader
//!      ▲                                                          │ channel
//!    sign ◄───────────────────────────────────── Crossing ◄──► Robot   follower ──► body
//!      └───────────► truth: P1 to P3, P5, P6, P9 and P10, from people, bodies and the sign alone
//! ```
//!
//! Time passes in ticks of half a second. In each tick people and the vehicle move as they like, the sensor misses people
//! within the assumption `sees`, and at most one of the things happens that a [`Street`] allows. People step on the
//! carriageway under go, or soon after it where a [`Street`] says so, and are then on it for as long as they like, also
//! beside the crossing. A vehicle, changes of ids, hangs, blindness, drifts and the number of outages are bounded for a run, and
//! no run is as long as `T_lock` or `T_exec`; nothing else is bounded. In an outage messages between the leader and one guard are
//! lost, one way or both, for any time. In [`Watch::Guard`] the follower's machine is alone: the leader has none, and its application
//! says anything at any time, as often as the [`Street`] allows. `truth` judges, and shares nothing with the machine. P4, about
//! escorts, needs finer geometry and is not here.

mod people;
mod rules;
mod street;
mod team;
mod truth;

use std::time::Duration;

use crossguard_crossing::Setup;
use stateright::{Checker, Model as _};

use crate::by_stateright::{by_stateright, steps};
use crate::exploration::{CheckProgress, Options, Stop};
use crate::report::{CheckVerdict, CutOff, PropertyReport, STATERIGHT, ScenarioReport};
use crate::scenario::Size;
use crate::sequence::{ChartPlace, ChartStep};

use rules::Rules;
use street::World;
pub use truth::{Rule, RuleClaim};

/// In how many consecutive frames the machines assume that the sensor misses somebody at most, and it does.
pub const MISS_MAX: u8 = 1;

/// How many guards there are at most.
pub(crate) const GUARDS_MAX: usize = 2;

/// Crossing machines that see people.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Watch {
    /// The leader's. A person tells the follower that the road is clear.
    Leader,
    /// Both, by the same frames.
    Both,
    /// The follower's alone. The leader has no crossing machine: its application says anything at any time.
    Guard,
}

/// Bounds of a run: possible events, and how often each may happen.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Street {
    /// Crossing machines that see people.
    pub watch: Watch,
    /// How often an application that leads without a machine says anything.
    pub words: u8,
    /// How many guards there are, one or two. Each has a place of its own.
    pub guards: u8,
    /// How many people there are, at most two.
    pub people: u8,
    /// Whether people step on the road for up to 2 s after go has ended, too, also from where nobody waits.
    pub late: bool,
    /// In how many consecutive frames the sensor misses somebody at most.
    pub misses: u8,
    /// How often ids change, or are swapped.
    pub id_changes: u8,
    /// How many ticks the leader's process hangs in all.
    pub hang: u8,
    /// How many ticks the sensor delivers nothing in all.
    pub blind: u8,
    /// How often the guard drifts off its place, or does not know any more where it is.
    pub drifts: u8,
    /// How many outages there are: for any time, messages between the leader and one guard are lost, one way or both.
    pub outages: u8,
    /// Whether a vehicle comes along.
    pub vehicle: bool,
    /// Whether the leader asks it to stop. It answers as it likes, at any time or never, and does not stop.
    pub asks: bool,
}

impl Street {
    /// One person, and a sensor that misses as much as it may.
    pub const PERSON: Self = Self {
        watch: Watch::Leader,
        words: 0,
        guards: 1,
        people: 1,
        late: false,
        misses: MISS_MAX,
        id_changes: 0,
        hang: 0,
        blind: 0,
        drifts: 0,
        outages: 0,
        vehicle: false,
        asks: false,
    };
}

/// A street that can be checked by name.
#[derive(Clone, Copy, Debug)]
pub struct Shipped {
    /// Its name.
    pub name: &'static str,
    /// Its subject, in one line.
    pub summary: &'static str,
    /// Its bounds.
    pub street: Street,
    /// The rules whose premises are met in it.
    pub rules: &'static [Rule],
    /// How many states it has.
    pub states: usize,
}

/// The shipped streets.
pub const SHIPPED: [Shipped; 15] = {
    const PERSON: Street = Street::PERSON;
    const MET: &[Rule] = &[Rule::P1, Rule::P5, Rule::P6];
    const ALONE: &[Rule] = &[Rule::P1];
    const UNMISSED: &[Rule] = &[Rule::P1, Rule::P6];
    const DRIFT: &[Rule] = &[Rule::P1, Rule::P2, Rule::P5, Rule::P6];
    const VEHICLE: &[Rule] = &[Rule::P1, Rule::P3, Rule::P5, Rule::P6, Rule::P9];
    const ASKED: &[Rule] = &[Rule::P1, Rule::P3, Rule::P5, Rule::P6, Rule::P9, Rule::P10];
    const fn of(
        name: &'static str,
        summary: &'static str,
        street: Street,
        rules: &'static [Rule],
        states: usize,
    ) -> Shipped {
        Shipped {
            name,
            summary,
            street,
            rules,
            states,
        }
    }
    #[rustfmt::skip]
    let shipped = [
        of("street-person", "a sensor misses a person who crosses in every other frame, or less often",
            PERSON, MET, 30_184),
        of("street-late", "the same, and the person may step on the road up to 2 s after go has ended, and where nobody waits",
            Street { late: true, ..PERSON }, MET, 413_536),
        of("street-ids", "the same, and the tracker's ids change",
            Street { id_changes: 1, ..PERSON }, MET, 666_508),
        of("street-hang", "the same with ids that stay, and the leader hangs for up to 1 s",
            Street { hang: 2, ..PERSON }, MET, 1_178_707),
        of("street-blind", "the same, and the sensor delivers nothing for up to 1 s",
            Street { blind: 2, ..PERSON }, MET, 423_469),
        of("street-drift", "the same, and the guard leaves its place, or does not know it any more",
            Street { drifts: 1, ..PERSON }, DRIFT, 294_137),
        of("street-outage", "the same, and messages to one robot or to both are lost, once, for any time",
            Street { outages: 1, ..PERSON }, MET, 1_534_511),
        of("street-team", "two guards, one of which leaves its place, or does not know it any more",
            Street { guards: 2, drifts: 1, ..PERSON }, DRIFT, 520_609),
        of("street-split", "the same with guards that stay; messages of one of them, or to it, are lost, once, for any time",
            Street { guards: 2, outages: 1, misses: 0, ..PERSON }, UNMISSED, 706_327),
        of("street-vehicle", "one guard, and a vehicle comes at 50 km/h",
            Street { vehicle: true, ..PERSON }, VEHICLE, 421_288),
        of("street-asked", "the same, and the leader asks it to stop: it says that it will, that it will not, or nothing",
            Street { vehicle: true, asks: true, ..PERSON }, ASKED, 510_584),
        of("street-pair", "two people cross together or one after the other, and the sensor misses nobody",
            Street { people: 2, misses: 0, ..PERSON }, UNMISSED, 2_238_738),
        of("street-sight", "one person, and both robots take in the frames of the sensor",
            Street { watch: Watch::Both, ..PERSON }, MET, 137_753),
        of("street-guard", "the machine of a guard that sees; what leads says anything, at any time",
            Street { watch: Watch::Guard, words: 5, ..PERSON }, ALONE, 712_028),
        of("street-silence", "the same, and what leads falls silent for 2.5 s",
            Street { watch: Watch::Guard, words: 3, hang: 5, ..PERSON }, ALONE, 1_227_910),
    ];
    shipped
};

impl Shipped {
    /// The street of this name, if there is one.
    #[must_use]
    pub fn of(name: &str) -> Option<Self> {
        SHIPPED.into_iter().find(|it| it.name == name)
    }

    /// Explores it. `watch` receives the progress now and then.
    #[must_use]
    pub fn check(&self, options: &Options, watch: &mut dyn FnMut(CheckProgress)) -> ScenarioReport {
        let found = explore(self.street, |_| (), options, &mut |reached| {
            watch(CheckProgress {
                expected: Some(self.states),
                ..reached
            });
        });
        let properties = self.rules.iter().flat_map(|rule| {
            let claim = rule.claim();
            let run = found.broken.iter().find(|(broken, _)| broken == rule);
            let steps = run.iter().flat_map(|(_, run)| run.iter());
            let verdict = CheckVerdict::of_property(run.is_some(), found.cut_off);
            let is_met = CheckVerdict::of_premise(found.met.contains(rule), found.cut_off);
            [
                PropertyReport {
                    counterexample: steps.map(|state| in_words(state)).collect(),
                    ..PropertyReport::plain(claim.id, "S", verdict, claim.statement)
                },
                PropertyReport::plain(claim.premise_id, "premise", is_met, claim.premise),
            ]
        });
        let followers = (0..self.street.guards).map(|_| "follower");
        let robots = core::iter::once("leader").chain(followers);
        let robots = robots.map(str::to_owned).collect();
        let is_whole = found.cut_off.is_none();
        ScenarioReport {
            transitions: found.transitions,
            seconds: found.time.as_secs_f64(),
            engines: vec![STATERIGHT],
            size_as_expected: is_whole.then_some(found.size.unique_states == self.states),
            properties: properties.collect(),
            assumptions: ASSUMPTIONS
                .into_iter()
                .chain([self.street.delivery(), self.street.watch.assumption()])
                .map(str::to_owned)
                .collect(),
            ..ScenarioReport::of(self.name, self.summary, robots, found.size, found.cut_off)
        }
    }
}

/// Assumptions of the verdicts on every street.
const ASSUMPTIONS: [&str; 5] = [
    "sees: the sensor, which covers the whole road, misses nobody in more than 1 frame in a row; nobody walks faster than 9 m/s, or crosses within a second",
    "people step on the road under go, in street-late also within 2 s after it, and stay on it for as long as they like",
    "time passes in ticks of 0.5 s, and at most one fault happens in a tick",
    "positions of bodies and vehicles are true",
    "no run is as long as T_lock or T_exec",
];

impl Street {
    /// A verdict's assumption on messages.
    const fn delivery(&self) -> &'static str {
        if self.outages > 0 {
            "messages arrive at once, and are lost in outages, between the leader and one guard, one way or both"
        } else if self.hang > 0 {
            "messages arrive at once, and are lost while the leader hangs"
        } else {
            "messages arrive at once"
        }
    }
}

impl Watch {
    /// A verdict's assumption on sensors.
    const fn assumption(self) -> &'static str {
        match self {
            Self::Leader => {
                "followers have no sensors: a person tells them that the road is clear, when it is and nobody may step on it, once their leader is idle"
            }
            Self::Both => "both robots take in the same frames at the same time",
            Self::Guard => {
                "P1 counts a person once the guard has seen them on the road while it guarded; a person who steps on the road unseen, while the leader ends the session, is not counted"
            }
        }
    }
}

/// A state of a run, in a chart.
fn in_words(state: &str) -> ChartStep {
    ChartStep {
        place: ChartPlace::At(0),
        action: state.to_owned(),
        outputs: Vec::new(),
    }
}

/// Result of an exploration.
#[derive(Clone, Debug)]
pub struct Found {
    /// Its states, and how far they are.
    pub size: Size,
    /// Steps between them.
    pub transitions: usize,
    /// Why not every state was explored, where that is so.
    pub cut_off: Option<CutOff>,
    /// The rules that are broken, each with a shortest run, as states in words.
    pub broken: Vec<(Rule, Vec<String>)>,
    /// The rules whose premises were met.
    pub met: Vec<Rule>,
    /// How long it took.
    pub time: Duration,
}

/// Explores a street until nothing is left, or a limit is reached. `change` changes the settings of both machines.
#[must_use]
pub fn explore(
    street: Street,
    change: fn(&mut Setup),
    options: &Options,
    watch: &mut dyn FnMut(CheckProgress),
) -> Found {
    let limits = options.limits();
    let drain = Stop::default();
    let world = World {
        street,
        rules: Rules::new(street, change),
        drain: drain.clone(),
    };
    let builder = world.checker().threads(options.threads.get());
    let (checker, cut_off) = by_stateright(builder, &drain, |states, depth| {
        watch(CheckProgress {
            checked: states,
            explored: states,
            depth,
            ..CheckProgress::default()
        });
        let is_full = limits.states_reached(states);
        let is_full = is_full.then_some(CutOff::StateLimit);
        is_full.or(limits.time_reached())
    });
    let run = |rule: &Rule| {
        let path = checker.discovery(rule.claim().id)?;
        let states = path.into_states().into_iter();
        Some((*rule, states.map(|state| state.to_string()).collect()))
    };
    let is_met = |rule: &Rule| checker.discovery(rule.claim().premise_id).is_some();
    Found {
        size: Size {
            unique_states: checker.unique_state_count(),
            depth: steps(&checker),
        },
        // stateright counts the initial state.
        transitions: checker.state_count() - 1,
        cut_off,
        broken: Rule::ALL.iter().filter_map(run).collect(),
        met: Rule::ALL.iter().copied().filter(is_met).collect(),
        time: limits.elapsed(),
    }
}
