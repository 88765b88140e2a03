//! Whether go began before vehicles that could no longer stop (P3), as far as sights in logs tell.
//!
//! Only the geometry of a log is used: the places and velocities that a robot had, and the outline of its crossing. A vehicle
//! that is not known to stand comes on straight ahead. It is taken to have braked as hard as brakes allow since the log
//! had it like this, so that nobody is accused because a log is coarse.

use super::ground::{Metres, seconds};

/// A driver's time of reaction in seconds, and a comfortable deceleration in m/s².
const REACTION_S: f64 = 2.0;
const COMFORTABLE_MPS2: f64 = 3.0;

/// No brakes do more, in m/s².
const HARDEST_MPS2: f64 = 9.0;

/// A slower vehicle stands, in m/s.
const STANDING_MPS: f64 = 0.5;

/// Sights of a robot are at most so far apart, in µs of its own time: a new one is at most so old.
const SIGHT_US: u64 = 250_000;

/// A vehicle in the newest sight of a robot.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Vehicle {
    pub(super) at: Metres,
    pub(super) velocity: [f64; 2],
    /// Since when the log has it like this.
    pub(super) since_us: u64,
}

/// A vehicle that comes, and cannot stop.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Coming {
    pub(super) speed_mps: f64,
    pub(super) left_m: f64,
    pub(super) needs_m: f64,
}

impl Vehicle {
    /// Whether it could no longer stop comfortably in front of a crossing at this time, and its way there.
    pub(super) fn comes(&self, crossing: &[Metres], at_us: u64) -> Option<Coming> {
        let [east, north] = self.velocity;
        let speed = east.hypot(north);
        if speed <= STANDING_MPS {
            return None;
        }
        let way_m = way(self.at, [east / speed, north / speed], crossing)?;
        let passed_s = seconds(at_us.saturating_sub(self.since_us) + SIGHT_US);
        let passed_s = passed_s.min(speed / HARDEST_MPS2);
        let speed_mps = speed - HARDEST_MPS2 * passed_s;
        let left_m = way_m - passed_s * (speed + speed_mps) / 2.0;
        let needs_m = speed_mps * REACTION_S + speed_mps * speed_mps / (2.0 * COMFORTABLE_MPS2);
        let cannot_stop = speed_mps > STANDING_MPS && left_m < needs_m;
        cannot_stop.then_some(Coming {
            speed_mps,
            left_m: left_m.max(0.0),
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

#[cfg(test)]
mod tests {
    use super::*;

    const S: u64 = 1_000_000;

    #[test]
    fn a_vehicle_comes_that_needs_more_than_its_way() {
        // 8 m of a road, from 20 m to the east on.
        let crossing = [[20.0, -4.0], [28.0, -4.0], [28.0, 4.0], [20.0, 4.0]];
        for (from, velocity, passed_us, comes) in [
            // 10 m/s need 36.7 m.
            ([0.0, 0.0], [10.0, 0.0], 0, true),
            ([-20.0, 0.0], [10.0, 0.0], 0, false),
            // It goes away, passes aside, or stands.
            ([0.0, 0.0], [-10.0, 0.0], 0, false),
            ([0.0, 9.0], [10.0, 0.0], 0, false),
            ([0.0, 0.0], [0.4, 0.0], 0, false),
            // On the crossing there is no way left.
            ([24.0, 0.0], [1.0, 1.0], 0, false),
            ([24.0, 0.0], [6.0, 3.0], 0, true),
            // It may have stopped meanwhile.
            ([0.0, 0.0], [10.0, 0.0], S, false),
            ([0.0, 0.0], [30.0, 0.0], S, true),
        ] {
            let vehicle = Vehicle {
                at: from,
                velocity,
                since_us: 0,
            };
            let is_coming = vehicle.comes(&crossing, passed_us).is_some();
            assert_eq!(is_coming, comes, "{from:?} {velocity:?} {passed_us}");
        }
    }
}
