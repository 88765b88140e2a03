//! Objects of CPM without a class, and vehicles that may be people: some are robots, and any other one may be a person.
//!
//! Robots say where they are. Each explains one object of a station at most: the nearest, within reach. So a person beside a guard
//! counts while the station has both. An inexact or an old place explains nothing. An object without a number is never explained: it
//! may be another one each time.

use std::collections::{BTreeMap, BTreeSet};

use crossguard_codec::{Identity, Kind};
use crossguard_crossing::{Input, Pose};
use crossguard_endpoint::station::{LocalDynamicMap, Neighbour};

use super::Application;
use super::senses::{age, reporter};

impl Application {
    /// Takes in the objects without a class and the vehicles that may be people, no faster than people walk, that were heard of now.
    pub(super) fn hear_objects(&mut self, map: &LocalDynamicMap, now_ms: u64) {
        let unsure = map.of_kind(Kind::Vehicle).filter(|it| it.is_either);
        let objects = map.of_kind(Kind::Object).chain(unsure);
        let objects = objects.filter(|it| !self.is_fast(it));
        let placed = objects.filter_map(|it| Some((*it, self.pose(&it.user.position)?)));
        let objects: Vec<_> = placed.collect();
        let is_news = |(known, _): &&(Neighbour, Pose)| known.heard_ms == now_ms;
        if !objects.iter().any(|it| is_news(&it)) {
            return;
        }
        let robots = self.robots(map, now_ms, &objects);
        for (known, pose) in objects.iter().filter(is_news) {
            if !robots.contains(&known.user.identity) {
                self.step(Input::Object(pose.at));
            }
        }
    }

    /// The objects that are robots, this one among them.
    fn robots(
        &self,
        map: &LocalDynamicMap,
        now_ms: u64,
        objects: &[(Neighbour, Pose)],
    ) -> BTreeSet<Identity> {
        let rules = self.setup.position;
        let is_exact = |it: &Pose| it.error_cm <= rules.tolerance_cm;
        let young = map.of_kind(Kind::Robot);
        let young = young.filter(|it| age(it, now_ms) < rules.lease);
        let own = self.body.state().position;
        let positions = young.map(|it| it.user.position).chain([own]);
        let poses = positions.filter_map(|it| self.pose(&it));
        let mut robots = BTreeSet::new();
        for robot in poses.filter(is_exact) {
            let mut nearest = BTreeMap::new();
            for (known, pose) in objects {
                let identity = known.user.identity;
                let found = (pose.at.distance_cm(robot.at), identity, is_exact(pose));
                let least = nearest.entry(reporter(identity)).or_insert(found);
                *least = found.min(*least);
            }
            let is_robot = |(cm, identity, is_exact): &(u32, Identity, bool)| {
                let is_numbered = matches!(identity, Identity::Object { .. });
                is_numbered && *is_exact && *cm <= rules.tolerance_cm.into()
            };
            let found = nearest.into_values().filter(is_robot);
            robots.extend(found.map(|(_, identity, _)| identity));
        }
        robots
    }
}
