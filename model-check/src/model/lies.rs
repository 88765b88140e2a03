//! Insiders that lie, as part of the model.
//!
//! An insider has no state. At any moment it says to any one robot any RAM or RMCM of its
//! [universe](crate::utterances) that is of its part, and whose sender is its own station; to say one thing to all is to say it
//! to each. That includes to repeat, to delay and to reorder what it has said, so of its messages nothing is kept. It knows all
//! numbers of the state, whether it could have heard of them or not. It gives out a number anew as long as others know of
//! at most one of its own; a bystander as long as they know of none, and that one speaks while nothing is on air.

use crossguard_protocol::{
    Heartbeat, OfferNumber, Phase, RequestId, Robot, SessionNumber, StationId, UniqueNumber,
};

use super::{Action, Model, ModelState};
use crate::canonical::GivenOut;
use crate::history::History;
use crate::network::{Transmission, concerns};
use crate::properties::StepView;
use crate::scenario::{LyingPart, Scenario};
use crate::steps::judge;
use crate::utterances::Utterances;

/// The boot counter of all numbers that an insider gives out anew.
const BOOT: u16 = 1;

/// A number from before that, and from before the boot of every robot.
const OLD: UniqueNumber = UniqueNumber { boot: 0, count: 0 };

/// How far the universe of an insider goes, so that it can be explored in seconds.
#[derive(Clone, Copy)]
struct Reach {
    /// How many numbers of its own are known to others at a time.
    numbers: usize,
    /// Whether it uses numbers from before its hearer's boot, and offers that are older than all.
    old: bool,
    /// Whether it speaks also while messages of others are on air.
    on_air: bool,
}

impl Reach {
    const fn of(part: LyingPart) -> Self {
        let (numbers, old, on_air) = match part {
            LyingPart::Helper | LyingPart::Leader => (2, true, true),
            LyingPart::Follower => (2, false, true),
            LyingPart::Bystander => (1, false, false),
        };
        Self {
            numbers,
            old,
            on_air,
        }
    }
}

impl Model {
    /// Everything that insiders may say in `state`.
    pub(super) fn lies(&self, state: &ModelState, is_on_air: bool, actions: &mut Vec<Action>) {
        let liars = self.0.scenario.liars();
        for (from, liar, part) in liars.filter(|(_, _, part)| !is_on_air || Reach::of(*part).on_air)
        {
            let given_out = self.given_out(state, liar);
            for to in 0..self.0.scenario.robots.len() {
                if self.is_deaf(state, to) {
                    continue;
                }
                let place = |i: usize| u8::try_from(i).expect("at most MAX_ROBOTS");
                let lies = self.effective(place(from), (liar, part), state.nodes[to], &given_out);
                actions.extend(lies.iter().map(|&message| {
                    Action::Lie(Transmission {
                        from: place(from),
                        to: place(to),
                        message,
                    })
                }));
            }
        }
    }

    /// The numbers that an insider has given out, as far as anybody knows of them.
    fn given_out(&self, state: &ModelState, liar: StationId) -> GivenOut {
        let (robots, network) = (self.robots(), self.network(state));
        let nodes = state.nodes[..self.0.scenario.robots.len()].iter();
        let of_nodes = nodes.map(|&node| robots.nodes.names(node));
        let of_messages = network.messages().map(|it| robots.message_names(it));
        let of_history = self.0.histories.names(state.history);
        let sets = of_nodes.chain(of_messages).chain([of_history]);
        robots.renamings.given_out_by(liar, sets)
    }

    fn effective(
        &self,
        from: u8,
        liar: (StationId, LyingPart),
        node: u32,
        given_out: &GivenOut,
    ) -> &[u16] {
        let key = (from, node, given_out.clone());
        let lies = || self.compute(liar, node, given_out).into();
        self.0.lies.get_or_compute(key, |_| lies())
    }

    /// The numbers of the messages that change something.
    fn compute(
        &self,
        (liar, part): (StationId, LyingPart),
        node: u32,
        given_out: &GivenOut,
    ) -> Vec<u16> {
        let (scenario, robots, hearer) = (self.scenario(), self.robots(), self.node(node));
        let Some(robot) = &hearer.robot else {
            return Vec::new();
        };
        let station = robot.station();
        let universe = utterances(scenario, (liar, Reach::of(part)), given_out, robot);
        let all = universe.all().into_iter();
        let heard = all.filter(|message| part.says(message) && concerns(message, station));
        let effective = heard.filter(|message| {
            let (input, config) = (message.input(), &scenario.config);
            let Some((after, outputs)) = hearer.step(&*robots.rules, config, input) else {
                return false;
            };
            let view = StepView {
                config,
                history: &History::default(),
                before: hearer,
                after: &after,
                input,
                outputs: &outputs,
            };
            // An ignored lie may meet a premise, and leads to no other state.
            let (premises, broken) = judge(&scenario.properties, &view, view.is_historic());
            self.note_premises(premises);
            broken != 0 || outputs.ignored().is_none() || after.untimed() != *hearer
        });
        effective.map(|it| robots.message_number(it)).collect()
    }

    /// Whether a step led to a leader with an insider that is to stay a stranger.
    pub(super) fn confirms_a_stranger(&self, node: u32) -> bool {
        let Some(leading) = self.node(node).leading() else {
            return false;
        };
        let strangers = self.0.scenario.liars();
        let mut strangers = strangers.filter(|(_, _, lies)| *lies == LyingPart::Helper);
        strangers.any(|(_, station, _)| leading.member(station).is_some())
    }
}

/// Messages that an insider that has given out these numbers may send to a robot.
fn utterances<'a>(
    scenario: &Scenario,
    (liar, reach): (StationId, Reach),
    given_out: &GivenOut,
    hearer: &'a Robot,
) -> Utterances<'a> {
    let (settings, old) = (scenario.config.settings(), reach.old.then_some(OLD));
    let known = given_out.iter().copied();
    let known = known.filter(|(number, _)| number.boot == BOOT);
    let counts = known.clone().map(|(number, _)| number.count + 1);
    let newest = UniqueNumber {
        boot: BOOT,
        count: counts.max().unwrap_or(0),
    };
    let may_open = known.clone().count() < reach.numbers;
    let numbers = known.chain(may_open.then_some((newest, 0)));
    let beats = |(number, beats)| (0..=beats).map(move |it| (SessionNumber(number), Heartbeat(it)));
    let newest_of_hearer = match hearer.phase() {
        Phase::Requesting(requesting) => requesting.heartbeat.0,
        Phase::Leading(leading) => leading.heartbeat.0,
        Phase::Idle | Phase::Offering(_) | Phase::Following(_) => 0,
    };
    let first = settings.first_request.0;
    let requests = 0..=scenario.bounds.commands;
    let offers = numbers.clone().map(|(number, _)| OfferNumber(number));
    Utterances {
        liar,
        hearer,
        request: scenario.request,
        t_safety: settings.t_safety,
        sessions: numbers.flat_map(beats).collect(),
        offers: old.map(OfferNumber).into_iter().chain(offers).collect(),
        old,
        echoes: (0..=newest_of_hearer + 1).map(Heartbeat).collect(),
        requests: requests
            .map(|it| RequestId(first.wrapping_add(it)))
            .collect(),
    }
}
