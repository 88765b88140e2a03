//! Whether go began before vehicles that could no longer stop (P3), or a robot stepped on the road before one (P9), as far as
//! sights in logs tell.
//!
//! Only the geometry of a log is used: the places and velocities that a robot had when go began, and the outline of its
//! crossing. A robot logs its newest sight when its sign begins to show go, so the log is as new as the decision. A vehicle
//! comes on straight ahead; its error and the age of its report, which a robot has to add, are left out.

use std::fmt::{self, Display, Formatter};

use super::ground::Metres;

/// A driver's time of reaction in seconds, and a comfortable deceleration in m/s².
const REACTION_S: f64 = 2.0;
const COMFORTABLE_MPS2: f64 = 3.0;

/// A slower vehicle stands, in m/s.
const STANDING_MPS: f64 = 0.5;

/// A vehicle in the newest sight of a robot.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Vehicle {
    pub(super) at: Metres,
    pub(super) velocity: [f64; 2],
}

/// A vehicle that comes, and cannot stop.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Coming {
    /// How fast it is.
    pub speed_mps: f64,
    /// How far it is from the crossing, in metres.
    pub left_m: f64,
    /// How far it goes until it stands, in metres.
    pub needs_m: f64,
}

impl Display for Coming {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self {
            speed_mps,
            left_m,
            needs_m,
        } = self;
        write!(
            f,
            "a vehicle comes at {speed_mps:.1} m/s, {left_m:.1} m from the crossing; it needs {needs_m:.1} m to stop"
        )
    }
}

impl Vehicle {
    /// Its speed and its way to a crossing, if it could no longer stop comfortably in front of it.
    pub(super) fn comes(&self, crossing: &[Metres]) -> Option<Coming> {
        let [east, north] = self.velocity;
        let speed_mps = east.hypot(north);
        if speed_mps <= STANDING_MPS {
            return None;
        }
        let left_m = way(self.at, [east / speed_mps, north / speed_mps], crossing)?;
        let needs_m = speed_mps * REACTION_S + speed_mps * speed_mps / (2.0 * COMFORTABLE_MPS2);
        (left_m < needs_m).then_some(Coming {
            speed_mps,
            left_m,
            needs_m,
        })
    }
}

/// How far it is from a place straight ahead to a polygon; nothing if it is not met.
fn way(from: Metres, ahead: [f64; 2], corners: &[Metres]) -> Option<f64> {
    if super::ground::contains(corners, from) {
        return Some(0.0);
    }
    let ends = corners.iter().cycle().skip(1);
    let crossed = corners.iter().zip(ends).filter_map(|(a, b)| {
        let (edge, to) = ([b[0] - a[0], b[1] - a[1]], [a[0] - from[0], a[1] - from[1]]);
        let cross = |u: [f64; 2], v: [f64; 2]| u[0] * v[1] - u[1] * v[0];
        let turn = cross(ahead, edge);
        let (along, on_edge) = (cross(to, edge) / turn, cross(to, ahead) / turn);
        (turn != 0.0 && along >= 0.0 && (0.0..=1.0).contains(&on_edge)).then_some(along)
    });
    crossed.min_by(f64::total_cmp)
}

/// For how long such a vehicle has been in sight when a body ought to stand at the kerb, in µs.
const STANDS_WITHIN_US: u64 = 1_500_000;

/// How far from the kerb a body is on the road, and beside it with room to stop, in metres, besides the stated error of its position.
const KERB_M: f64 = 0.3;
const STOPS_M: f64 = 1.0;

/// A robot at the kerb, and the vehicles in its sight.
#[derive(Clone, Debug, Default)]
pub(super) struct AtKerb {
    pub(super) vehicles: Vec<Vehicle>,
    /// Since when a vehicle is among them that cannot stop, and that vehicle as it was last.
    coming: Option<(u64, Coming)>,
    /// Whether it was beside the road last.
    is_beside: bool,
}

impl AtKerb {
    /// It has these vehicles in sight now.
    pub(super) fn see(&mut self, at_us: u64, vehicles: Vec<Vehicle>, crossing: &[Metres]) {
        let since_us = self.coming.map_or(at_us, |(since_us, _)| since_us);
        let coming = vehicles.iter().find_map(|it| it.comes(crossing));
        self.coming = coming.map(|coming| (since_us, coming));
        self.vehicles = vehicles;
    }

    /// It is so far off the road, or inside of it where that is negative. Whether it stepped on it with vehicles in sight, and the one
    /// before which it ought not to have done so.
    pub(super) fn is_at(&mut self, at_us: u64, off_m: f64, error_m: f64) -> (bool, Option<Coming>) {
        let was_beside = self.is_beside;
        let is_on_road = off_m < -(KERB_M + error_m);
        self.is_beside = off_m > STOPS_M + error_m || was_beside && !is_on_road;
        let coming = self
            .coming
            .filter(|(since_us, _)| at_us - since_us > STANDS_WITHIN_US);
        let steps = was_beside && is_on_road && !self.vehicles.is_empty();
        (steps, coming.map(|(_, coming)| coming).filter(|_| steps))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vehicle_comes_that_needs_more_than_its_way() {
        // 8 m of a road, from 20 m to the east on.
        let crossing = [[20.0, -4.0], [28.0, -4.0], [28.0, 4.0], [20.0, 4.0]];
        for (at, velocity, comes) in [
            // 10 m/s need 36.7 m.
            ([-16.0, 0.0], [10.0, 0.0], true),
            ([-17.0, 0.0], [10.0, 0.0], false),
            // It goes away, passes aside, or stands.
            ([0.0, 0.0], [-10.0, 0.0], false),
            ([0.0, 9.0], [10.0, 0.0], false),
            ([0.0, 0.0], [0.4, 0.0], false),
            // On the crossing there is no way left.
            ([24.0, 0.0], [1.0, 1.0], true),
        ] {
            let is_coming = Vehicle { at, velocity }.comes(&crossing).is_some();
            assert_eq!(is_coming, comes, "{at:?} {velocity:?}");
        }
    }
}
