//! Groups of members that are close to each other and move alike.
//!
//! Every pair in a group is close and alike, not only neighbours: a queue of people does not become one long
//! group, and a turn along a row of them does not either. A group of before stays together longer than
//! strangers come together, so that it does not change with every breath of a sensor. Every member moves as the
//! mean of its group does, because that is the motion which is announced.

use std::collections::BTreeSet;

use super::super::motion::{Likeness, Point, distance_m};
use super::{PerceivedVru, Settings};

/// How close and alike two members have to be.
#[derive(Clone, Copy)]
struct Togetherness {
    spread_m: f64,
    likeness: Likeness,
}

impl Togetherness {
    fn to_join(settings: &Settings) -> Self {
        Self {
            spread_m: settings.spread_m,
            likeness: Likeness {
                speed_mps: settings.speed_difference_mps / 2.0,
                heading_deg: settings.heading_difference_deg / 2.0,
            },
        }
    }

    fn to_stay(settings: &Settings) -> Self {
        Self {
            spread_m: settings.spread_m + settings.hysteresis_m,
            likeness: Likeness {
                speed_mps: settings.speed_difference_mps,
                heading_deg: settings.heading_difference_deg,
            },
        }
    }

    fn hold(&self, a: &PerceivedVru, b: &PerceivedVru) -> bool {
        distance_m(a.position_m, b.position_m) <= self.spread_m
            && self.likeness.holds(a.velocity_mps, b.velocity_mps)
    }

    fn hold_in(&self, group: &[&PerceivedVru], vru: &PerceivedVru) -> bool {
        group.iter().all(|member| self.hold(member, vru))
    }
}

/// Divides `people` into groups. Members of a group in `before` stay together if they are still close and alike.
pub(super) fn groups(
    people: &[&PerceivedVru],
    before: &[(u8, BTreeSet<u32>)],
    settings: &Settings,
) -> Vec<BTreeSet<u32>> {
    let (join, stay) = (
        Togetherness::to_join(settings),
        Togetherness::to_stay(settings),
    );
    let size_max = settings.size_max.clamp(1, usize::from(u8::MAX));
    let (mut groups, mut alone) = stayed(people, before, stay);
    // By place and not by id: what a sensor tracks people by has no influence.
    alone.sort_by(|a, b| by_place(a.position_m, b.position_m));
    for vru in alone {
        let near_m = |group: &[&PerceivedVru]| {
            let distances = group
                .iter()
                .map(|it| distance_m(it.position_m, vru.position_m));
            distances.fold(f64::INFINITY, f64::min)
        };
        let fits = groups.iter_mut().filter(|group| join.hold_in(group, vru));
        match fits.min_by(|a, b| near_m(a).total_cmp(&near_m(b))) {
            Some(group) => group.push(vru),
            None => groups.push(vec![vru]),
        }
    }
    unite(&mut groups, join, size_max);
    let mut parts = Vec::new();
    for group in groups {
        split(group, size_max, &mut parts);
    }
    let apart = parts
        .into_iter()
        .flat_map(|part| of_one_motion(part, stay.likeness));
    apart
        .map(|part| part.iter().map(|vru| vru.id).collect())
        .collect()
}

/// The group, and apart from it each member that does not move as the mean of the group does. Members that are alike
/// by pairs can differ so, if the slowest of them has no direction that counts and the mean has one.
fn of_one_motion(mut group: Vec<&PerceivedVru>, likeness: Likeness) -> Vec<Vec<&PerceivedVru>> {
    let mut parts = Vec::new();
    loop {
        let mean_mps = mean(&group, |vru| vru.velocity_mps);
        let others =
            (0..group.len()).filter(|&at| !likeness.holds(group[at].velocity_mps, mean_mps));
        let from_mean = |at: usize| distance_m(group[at].velocity_mps, mean_mps);
        match others.max_by(|&a, &b| from_mean(a).total_cmp(&from_mean(b))) {
            Some(at) => parts.push(vec![group.remove(at)]),
            None => break,
        }
    }
    parts.push(group);
    parts
}

/// Remainder of the groups of before, and people in none.
fn stayed<'a>(
    people: &[&'a PerceivedVru],
    before: &[(u8, BTreeSet<u32>)],
    stay: Togetherness,
) -> (Vec<Vec<&'a PerceivedVru>>, Vec<&'a PerceivedVru>) {
    let is_in = |vru: &PerceivedVru, group: &BTreeSet<u32>| group.contains(&vru.id);
    let is_new = |vru: &&&PerceivedVru| !before.iter().any(|(_, group)| is_in(vru, group));
    let mut alone: Vec<_> = people.iter().filter(is_new).copied().collect();
    let mut groups = Vec::new();
    for (_, group) in before {
        let members = people.iter().filter(|vru| is_in(vru, group)).copied();
        let mut members: Vec<_> = members.collect();
        let middle = mean(&members, |vru| vru.position_m);
        let from_middle = |vru: &PerceivedVru| distance_m(middle, vru.position_m);
        // The member in the middle of a group has the most in common with the others.
        members.sort_by(|a, b| from_middle(a).total_cmp(&from_middle(b)));
        let mut core: Vec<&PerceivedVru> = Vec::new();
        for vru in members {
            if stay.hold_in(&core, vru) {
                core.push(vru);
            } else {
                alone.push(vru);
            }
        }
        if !core.is_empty() {
            groups.push(core);
        }
    }
    (groups, alone)
}

/// Makes one group of two that are close and alike together, as long as there are such.
fn unite(groups: &mut Vec<Vec<&PerceivedVru>>, join: Togetherness, size_max: usize) {
    let mut first = 0;
    while first < groups.len() {
        let fits = |other: &[&PerceivedVru]| {
            groups[first].len() + other.len() <= size_max
                && other.iter().all(|vru| join.hold_in(&groups[first], vru))
        };
        match (first + 1..groups.len()).find(|&other| fits(&groups[other])) {
            Some(other) => {
                let other = groups.remove(other);
                groups[first].extend(other);
            }
            None => first += 1,
        }
    }
}

/// The mean of what `of` tells of each member, for each axis.
pub(super) fn mean(members: &[&PerceivedVru], of: fn(&PerceivedVru) -> [f64; 2]) -> [f64; 2] {
    #[expect(clippy::cast_precision_loss, reason = "a few dozen")]
    let count = members.len().max(1) as f64;
    [0, 1].map(|axis| members.iter().map(|vru| of(vru)[axis]).sum::<f64>() / count)
}

fn by_place(a: Point, b: Point) -> std::cmp::Ordering {
    a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]))
}

/// Splits along the longer side, in halves of equal size, until every part is small enough.
fn split<'a>(
    mut members: Vec<&'a PerceivedVru>,
    size_max: usize,
    parts: &mut Vec<Vec<&'a PerceivedVru>>,
) {
    // Halving needs as many rounds as the number has bits, so this is no deep recursion.
    if members.len() > size_max {
        let extent = |axis: usize| {
            let of = |vru: &&PerceivedVru| vru.position_m[axis];
            let most = members.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
            let least = members.iter().map(of).fold(f64::INFINITY, f64::min);
            most - least
        };
        let axis = usize::from(extent(1) > extent(0));
        members.sort_by(|a, b| a.position_m[axis].total_cmp(&b.position_m[axis]));
        let rest = members.split_off(members.len() / 2);
        split(members, size_max, parts);
        split(rest, size_max, parts);
    } else if !members.is_empty() {
        parts.push(members);
    }
}
