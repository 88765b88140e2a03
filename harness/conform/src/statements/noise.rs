//! What means nothing changes nothing.

use super::{Met, met, met_when, part_unchanged};
use crate::bench::Terms;
use crate::exchange::{Exchange, Happening, Message, session_of};

statements! {
    "noise-changes-nothing" "R26" noise_changes_nothing:
        "Packets that mean nothing change no part, and the robot goes on.";
    "the-own-name-means-nothing" "R26" own_name_changes_nothing:
        "A message under the robot's own station id changes no part.";
    "nobody-is-answered-in-a-flood" "R26" no_flood:
        "A robot in a session sends RAM by its period and by what changes, and not for each message that it hears.";
}

fn noise_changes_nothing(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let noise = exchange.seen.iter().filter_map(|seen| match seen.what {
        Happening::Noise(name) => Some((seen.at_ms, name)),
        _ => None,
    });
    let mut all: Vec<Met> = Vec::new();
    for (at, _) in noise {
        if all.is_empty()
            && let Some(outcome) = part_unchanged(exchange, terms, at)
        {
            all.push(met(exchange, at, outcome));
        }
    }
    all
}

fn own_name_changes_nothing(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let mut spoken = exchange
        .played_rams()
        .filter(|(_, _, played)| played.ram.station == exchange.robot);
    let Some((at, ..)) = spoken.next() else {
        return Vec::new();
    };
    let outcome = part_unchanged(exchange, terms, at);
    outcome
        .map(|outcome| met(exchange, at, outcome))
        .into_iter()
        .collect()
}

/// More RAM than this in a second are a flood, where nothing changes: ten are sent by the period.
const RAMS_MAX: usize = 16;

fn no_flood(exchange: &Exchange, terms: &Terms) -> Vec<Met> {
    let period_ms = terms.ms(|settings| settings.ram_period).max(1);
    let window_ms = 10 * period_ms;
    let same: Vec<(u64, String)> = exchange
        .seen
        .iter()
        .filter_map(|seen| match &seen.what {
            Happening::Said(Message::Ram(state)) => {
                let part = crate::words::part(&state.ram.coordination);
                let (session, duty) = (session_of(&state.ram)?, state.ram.on_duty);
                Some((
                    seen.at_ms,
                    format!("{part} {session} {duty} {:?}", state.ram.farewell),
                ))
            }
            _ => None,
        })
        .collect();
    let mut all: Vec<Met> = Vec::new();
    for (i, (at, part)) in same.iter().enumerate() {
        let in_window = same[i..]
            .iter()
            .take_while(|(then, _)| *then < at + window_ms);
        let alike = in_window.filter(|(_, other)| other == part).count();
        let heard = exchange
            .played_rams()
            .filter(|(then, ..)| (*at..at + window_ms).contains(then))
            .count();
        if exchange.ended_ms < at + window_ms || heard < 5 {
            continue;
        }
        let broken =
            (alike > RAMS_MAX).then(|| format!("it sends {alike} RAM alike in {window_ms} ms"));
        let situation = exchange.situation_at(*at);
        let is_known = all.iter().any(|met| met.situation == situation);
        if broken.is_some() || !is_known {
            all.push(met_when(*at, situation, broken));
        }
        if all.last().is_some_and(|met| met.broken.is_some()) {
            break;
        }
    }
    all
}
