//! Whether people are guarded for as long as a plan has them on the road.

use crossguard_protocol::{Millis, Settings, TaskSet};
use toml::Spanned;

use super::Role;
use super::tables::PlanTables;
use crate::located::Misfit;
use crate::plan::Leg;
use crate::site::Place;
use crate::site_file::SiteFile;

/// The maneuvers that take a person on the road: they guard, and hold no place.
const fn escorts(settings: &Settings) -> TaskSet {
    settings.guarding.without(settings.holding)
}

fn seconds(time: Millis) -> f64 {
    f64::from(time.0) / 1_000.0
}

/// Fault in the part of a role in the stage with this number, at its line.
fn at(tables: &PlanTables, stage: usize, role: &str, what: String) -> Misfit {
    Misfit::at_any(tables.stages[stage].get_ref().get(role), what)
}

/// The legs of followers that have roles, in order: the number of the stage, that of the follower, and its leg.
fn legs(stages: &[Vec<(usize, Leg)>]) -> impl Iterator<Item = (usize, usize, &Leg)> {
    let stages = stages.iter().enumerate();
    stages.flat_map(|(number, stage)| stage.iter().map(move |(it, leg)| (number, *it, leg)))
}

/// Looks that people are escorted in the last stage alone, in which the corridor is open, and that a robot that guards from a
/// place is sent there in a stage before.
pub(super) fn guards_first(
    tables: &PlanTables,
    followers: &[&Role],
    stages: &[Vec<(usize, Leg)>],
    settings: &Settings,
) -> Result<(), Misfit> {
    let escorts = escorts(settings);
    let Some((first, ..)) = legs(stages).find(|(_, _, leg)| escorts.contains(leg.task)) else {
        return Ok(());
    };
    let mut sent = vec![false; followers.len()];
    let guards = legs(stages).filter(|(_, _, leg)| settings.holding.contains(leg.task));
    for (number, follower, _) in guards {
        if number >= first && !sent[follower] {
            let name = &followers[follower].name;
            let what = format!(
                "role '{name}' is sent to guard in stage {}, and a person is escorted from stage {} on: \
                 guards are wanted in a stage before",
                number + 1,
                first + 1
            );
            return Err(at(tables, number, name, what));
        }
        sent[follower] = true;
    }
    if first + 1 < stages.len() {
        let what = format!(
            "a person is escorted in stage {}, and the corridor is open in the last stage alone: escort them in that",
            first + 1
        );
        return Err(Misfit::whole(what));
    }
    Ok(())
}

/// Looks that each way can be walked at its speed in the time of its task, and an escort's in that of a crossing, and that an
/// escort's leads over the road. Where a follower is before its first part is known where the plan says it.
pub(super) fn ways_in_time(
    tables: &PlanTables,
    site: &SiteFile,
    followers: &[&Role],
    stages: &[Vec<(usize, Leg)>],
    settings: &Settings,
) -> Result<(), Misfit> {
    let escorts = escorts(settings);
    let mut places: Vec<_> = followers.iter().map(|role| role.waits).collect();
    for (number, follower, leg) in legs(stages) {
        let Some(from) = places[follower].replace(leg.to) else {
            continue;
        };
        let parts = site
            .carriageway()
            .is_none_or(|road| road.parts([from, leg.to]));
        if escorts.contains(leg.task) && !parts {
            let name = &followers[follower].name;
            let what = format!(
                "role '{name}' escorts people from one place to another that is not over the road: it stays on one side"
            );
            return Err(at(tables, number, name, what));
        }
        let way_m = from.distance(leg.to);
        if let Some((way_s, limit, most_s)) = leg.too_long(way_m, settings) {
            let name = &followers[follower].name;
            let what = format!(
                "role '{name}' goes {way_m:.1} m at {} m/s, which takes {way_s:.1} s: {limit} is {most_s} s",
                leg.speed_mps
            );
            return Err(at(tables, number, name, what));
        }
    }
    Ok(())
}

/// Looks that an escort that may go in either direction is sent to one of the two places and goes to the other one: only these
/// change sides for people over there.
pub(super) fn escorts_either_way(
    tables: &PlanTables,
    followers: &[&Role],
    stages: &[Vec<(usize, Leg)>],
    kerbs: [Place; 2],
    settings: &Settings,
) -> Result<(), Misfit> {
    let mut places: Vec<_> = followers.iter().map(|role| role.waits).collect();
    for (number, follower, leg) in legs(stages) {
        let from = places[follower].replace(leg.to);
        let is_way = kerbs.contains(&leg.to) && from.is_none_or(|from| kerbs.contains(&from));
        if escorts(settings).contains(leg.task) && !is_way {
            let name = &followers[follower].name;
            let what = format!(
                "role '{name}' escorts people, and not from one place of 'either_way' to the other: it would stay on its side \
                 when people come from over there"
            );
            return Err(at(tables, number, name, what));
        }
    }
    Ok(())
}

/// Looks that people cross within `t_cross`: those of a simulation, and slow walkers on the site.
pub(super) fn crossing_in_time(
    site: &SiteFile,
    said: Option<&Spanned<f64>>,
    crossing_s: f64,
    settings: &Settings,
) -> Result<(), Misfit> {
    let t_cross_s = seconds(settings.t_cross);
    if crossing_s > t_cross_s {
        let what = format!("a pedestrian crosses in {crossing_s} s: t_cross is {t_cross_s} s");
        return Err(Misfit::at_any(said, what));
    }
    match site.walk_s() {
        Some(walk_s) if walk_s > t_cross_s => Err(Misfit::whole(format!(
            "a slow walker crosses on site '{}' in {walk_s:.1} s: t_cross is {t_cross_s} s",
            site.name
        ))),
        _ => Ok(()),
    }
}
