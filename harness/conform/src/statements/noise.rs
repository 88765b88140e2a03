//! Meaningless packets change nothing.

use super::{Met, Trace, met_when};
use crate::exchange::Happening;

statements! {
    "noise-changes-nothing" "R26" noise_changes_nothing:
        "Packets that mean nothing change no part, and the robot goes on.";
    "the-own-name-means-nothing" "R26" own_name_changes_nothing:
        "A message under the robot's own station id changes no part.";
    "nobody-is-answered-in-a-flood" "R26" no_flood:
        "A robot in a session sends RAM by its period and by what changes, and not for each message that it hears.";
}

fn noise_changes_nothing(trace: &Trace) -> Vec<Met> {
    let noise = trace.seen.iter();
    let noise = noise.filter(|seen| matches!(seen.what, Happening::Noise(_)));
    noise
        .filter_map(|it| Some(trace.met(it.at_ms, trace.part_unchanged(it.at_ms)?)))
        .take(1)
        .collect()
}

fn own_name_changes_nothing(trace: &Trace) -> Vec<Met> {
    let mut spoken = trace.played_rams();
    let spoken = spoken.find(|(_, played)| played.ram.station == trace.robot);
    let met = spoken.and_then(|(at, _)| Some(trace.met(at, trace.part_unchanged(at)?)));
    met.into_iter().collect()
}

/// More RAM than this in a second are a flood, where nothing changes: ten are sent by the period.
const RAMS_MAX: usize = 16;

fn no_flood(trace: &Trace) -> Vec<Met> {
    let period_ms = trace.ms(|settings| settings.ram_period).max(1);
    let window_ms = 10 * period_ms;
    let same = trace.rams().filter_map(|(at, state)| {
        let part = crate::words::part(&state.ram.coordination);
        let (session, duty) = (state.session()?, state.ram.on_duty);
        Some((
            at,
            format!("{part} {session} {duty} {:?}", state.ram.farewell),
        ))
    });
    let same: Vec<(u64, String)> = same.collect();
    let mut all: Vec<Met> = Vec::new();
    for (i, (at, part)) in same.iter().enumerate() {
        let window = *at..at + window_ms;
        let in_window = same[i..].iter().take_while(|(then, _)| *then < window.end);
        let alike = in_window.filter(|(_, other)| other == part).count();
        let heard = trace.played_rams();
        let heard = heard.filter(|(then, _)| window.contains(then)).count();
        if trace.ended_ms < window.end || heard < 5 {
            continue;
        }
        let broken =
            (alike > RAMS_MAX).then(|| format!("it sends {alike} RAM alike in {window_ms} ms"));
        let situation = trace.situation_at(*at);
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
