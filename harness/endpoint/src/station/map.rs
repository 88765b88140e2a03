//! The local dynamic map: road users around, as heard lately.
//!
//! Each kind of road user has room of its own, so that a flood of one does not push out another; when
//! the room is full, the user that was heard of longest ago makes place. A user that is not heard of again is
//! forgotten.

use std::collections::BTreeMap;

use crossguard_codec::si::generation_delta_time;
use crossguard_codec::{Identity, Kind, RoadUser};

/// Longest time that an object of a CPM is old when that is made, in ms (`measurementDeltaTime`, TS 103 324).
pub const MEASURED_MS: u64 = 2_048;

/// How many of one kind are remembered.
pub const USERS_MAX: usize = 128;

/// For how long somebody is remembered without being heard of again, in ms: about twice the longest
/// time between two messages of the kind.
#[must_use]
pub const fn lifetime_ms(kind: Kind) -> u64 {
    match kind {
        Kind::Robot | Kind::Vehicle | Kind::Object => 2_000,
        // VAM come every 5 s at least (TS 103 300-3, T_GenVamMax).
        Kind::Vru => 10_000,
        Kind::RoadSideUnit => 5_000,
    }
}

/// A road user on the map.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Neighbour {
    /// Its newest report.
    pub user: RoadUser,
    /// Whether it may be a person as well as a vehicle, by the classes of a CPM.
    pub is_either: bool,
    /// When, on the robot's clock.
    pub heard_ms: u64,
}

/// The local dynamic map of one robot.
#[derive(Clone, Debug, Default)]
pub struct LocalDynamicMap {
    kinds: BTreeMap<Kind, BTreeMap<Identity, Neighbour>>,
}

impl LocalDynamicMap {
    /// Takes in what was told at `now_ms`, unless it is older than what is known, by 32.768 s at most. A robot whose RAM
    /// was heard is that robot, whatever else it sends: its CAM for other stations says less.
    pub fn observe(&mut self, user: RoadUser, now_ms: u64) {
        self.observe_unsure(user, false, now_ms);
    }

    /// The same of somebody who may be either, a person or a vehicle.
    pub fn observe_unsure(&mut self, user: RoadUser, is_either: bool, now_ms: u64) {
        let neighbour = Neighbour {
            user,
            is_either,
            heard_ms: now_ms,
        };
        let robots = self.kinds.get(&Kind::Robot);
        let is_robot = robots.is_some_and(|robots| robots.contains_key(&user.identity));
        if is_robot && user.kind != Kind::Robot {
            return;
        }
        // A user that is something else now, like a pedestrian who got into a car, is only that.
        for (kind, users) in &mut self.kinds {
            if *kind != user.kind {
                users.remove(&user.identity);
            }
        }
        let users = self.kinds.entry(user.kind).or_default();
        if let Some(known) = users.get_mut(&user.identity) {
            // Modulo 2^16 ms, as GenerationDeltaTime: the own wall clock, by which both were rebuilt, may have been put.
            let newer_ms = user.measured_its.wrapping_sub(known.user.measured_its);
            if generation_delta_time(newer_ms) < 0x8000 {
                // It is in some of a robot's RAM, twice a second at most.
                let signals = user.signals.or(known.user.signals);
                *known = neighbour;
                known.user.signals = signals;
            }
            return;
        }
        if users.len() >= USERS_MAX {
            let oldest = users.iter().min_by_key(|(_, known)| known.heard_ms);
            if let Some(identity) = oldest.map(|(identity, _)| *identity) {
                users.remove(&identity);
            }
        }
        users.insert(user.identity, neighbour);
    }

    /// Forgets who was not heard of for too long.
    pub fn forget(&mut self, now_ms: u64) {
        for (kind, users) in &mut self.kinds {
            let lifetime = lifetime_ms(*kind);
            users.retain(|_, known| now_ms.saturating_sub(known.heard_ms) < lifetime);
        }
    }

    /// Everybody on the map, by kind and identity.
    pub fn iter(&self) -> impl Iterator<Item = &Neighbour> {
        self.kinds.values().flat_map(BTreeMap::values)
    }

    /// Everybody of a kind.
    pub fn of_kind(&self, kind: Kind) -> impl Iterator<Item = &Neighbour> {
        self.kinds.get(&kind).into_iter().flat_map(BTreeMap::values)
    }

    /// The user of this identity.
    #[must_use]
    pub fn get(&self, identity: Identity) -> Option<&Neighbour> {
        self.kinds.values().find_map(|users| users.get(&identity))
    }
}

#[cfg(test)]
mod tests {
    use crossguard_codec::Position;
    use crossguard_codec::si::rebuild_timestamp;

    use super::*;

    fn user(identity: Identity, kind: Kind, measured_its: u64) -> RoadUser {
        RoadUser {
            identity,
            kind,
            station_type: None,
            position: Position::at(49.0, 8.4),
            speed: Some(1.0),
            heading: None,
            length: None,
            cardinality: 1,
            signals: None,
            measured_its,
        }
    }

    fn station(id: u32, kind: Kind) -> RoadUser {
        user(Identity::Station(id), kind, 0)
    }

    #[test]
    fn who_is_not_heard_again_is_forgotten() {
        let mut map = LocalDynamicMap::default();
        map.observe(station(1, Kind::Vehicle), 0);
        map.observe(station(2, Kind::Vru), 0);
        map.forget(1_999);
        assert_eq!(map.iter().count(), 2);
        map.forget(2_000);
        assert!(map.get(Identity::Station(1)).is_none());
        assert_eq!(map.of_kind(Kind::Vru).count(), 1);
        map.forget(10_000);
        assert_eq!(map.iter().count(), 0);
    }

    #[test]
    fn a_flood_of_one_kind_leaves_the_others() {
        let mut map = LocalDynamicMap::default();
        map.observe(station(1, Kind::Robot), 0);
        for id in 0..10_000 {
            map.observe(station(id + 2, Kind::Vehicle), id.into());
        }
        assert_eq!(map.of_kind(Kind::Vehicle).count(), USERS_MAX);
        assert!(map.get(Identity::Station(10_001)).is_some());
        assert!(map.get(Identity::Station(1)).is_some());
    }

    #[test]
    fn what_is_older_than_known_changes_nothing_whatever_the_own_wall_clock_shows() {
        const KNOWN_ITS: u64 = 694_694_401_000;
        const HOUR: i64 = 3_600_000;
        // How much newer it is, and by how much the own wall clock was put meanwhile, in ms.
        for (newer, put, is_taken) in [
            (0, 0, true),
            // Hazard: by a message that comes long after a newer one, a vehicle is far away and a guard at its place.
            (-1, 0, false),
            (-3_000, 0, false),
            (-10_000, 0, false),
            // Hazard: the clock is put back, and people are at their old places for 10 s.
            (50, -HOUR, true),
            (-3_000, -HOUR, false),
            (50, HOUR, true),
            (-3_000, HOUR, false),
        ] {
            let mut map = LocalDynamicMap::default();
            let identity = Identity::Object { by: 7, number: 1 };
            map.observe(user(identity, Kind::Vru, KNOWN_ITS), 0);
            let said = generation_delta_time(KNOWN_ITS.strict_add_signed(newer));
            let measured_its = rebuild_timestamp(KNOWN_ITS.strict_add_signed(put), said);
            map.observe(user(identity, Kind::Vru, measured_its), 50);
            let heard_ms = map.get(identity).unwrap().heard_ms;
            assert_eq!(heard_ms == 50, is_taken, "{newer} {put}");
        }
    }

    #[test]
    fn objects_without_numbers_are_as_many_as_a_report_has() {
        let mut map = LocalDynamicMap::default();
        for measured_its in [1_000, 1_100] {
            for place in [0, 1] {
                let identity = Identity::Unnumbered { by: 7, place };
                map.observe(user(identity, Kind::Vru, measured_its), measured_its);
            }
        }
        assert_eq!(map.of_kind(Kind::Vru).count(), 2);
        assert!(map.iter().all(|known| known.heard_ms == 1_100));
    }

    #[test]
    fn a_station_is_one_thing_at_a_time() {
        let mut map = LocalDynamicMap::default();
        map.observe(station(1, Kind::Vru), 0);
        map.observe(station(1, Kind::Vehicle), 1);
        assert_eq!(map.iter().count(), 1);
    }

    #[test]
    fn a_robot_stays_one_whatever_else_it_sends() {
        let mut map = LocalDynamicMap::default();
        map.observe(station(1, Kind::Vru), 0);
        map.observe(station(1, Kind::Robot), 1);
        map.observe(station(1, Kind::Vru), 2);
        map.observe(user(Identity::Station(1), Kind::Vehicle, 9), 3);
        let known = map.iter().map(|known| (known.user.kind, known.heard_ms));
        assert!(known.eq([(Kind::Robot, 1)]));
        // Its RAM ended, and its CAM goes on.
        map.forget(2_001);
        map.observe(station(1, Kind::Vru), 2_002);
        assert_eq!(map.of_kind(Kind::Vru).count(), 1);
    }
}
