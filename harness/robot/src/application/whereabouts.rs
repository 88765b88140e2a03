//! Where a follower says that it is and how fast it moves, held against the place that it was sent to.
//!
//! Completion is inferred from the follower's RAM: position, motion and progression (paper, section III-A). The
//! protocol reads the progression, by session and request; whether position and motion fit is judged here, where
//! places are known. A follower that reports from elsewhere, or while it still moves, is commanded again, and in the end
//! the leader gives up: nobody crosses behind a guard that stands in the wrong place, or that runs past the right one.

use crossguard_codec::Position;
use crossguard_protocol::StationId;

use super::Application;
use super::errand::{Amiss, Part};
use crate::plan::Leg;

/// How far from its place a follower may be, besides what its RAM says of its confidence, in metres: less than the width
/// of a lane.
const OUT_OF_PLACE_M: f64 = 2.0;

/// How fast a follower that has arrived may still be by its RAM, in m/s: slower than anybody walks.
const MOVES_MPS: f64 = 0.5;

impl Application {
    /// Takes in where a follower says that it is, and how fast it moves, in m/s. What is not known judges nobody.
    pub fn follower_is_at(
        &mut self,
        follower: StationId,
        position: &Position,
        speed_mps: Option<f64>,
    ) {
        let Some((leg, errand)) = self.leg(follower).zip(self.errand.as_mut()) else {
            return;
        };
        let place = position.latitude.zip(position.longitude);
        let place = place.map(|(latitude, longitude)| self.site.place(latitude, longitude));
        let off_m = place.map_or(0.0, |place| place.distance(leg.to));
        let confidence_m = position.ellipse.map_or(0.0, |ellipse| ellipse.semi_major);
        let misfit = if off_m > OUT_OF_PLACE_M + confidence_m {
            tracing::warn!(%follower, off_m, "reports from elsewhere than where it was sent");
            Some(Amiss::Elsewhere)
        } else if let Some(speed_mps) = speed_mps.filter(|speed_mps| *speed_mps > MOVES_MPS) {
            tracing::warn!(%follower, speed_mps, "reports that it has arrived, and moves");
            Some(Amiss::Moving)
        } else {
            None
        };
        match misfit {
            Some(misfit) => errand.misfits.insert(follower, misfit),
            None => errand.misfits.remove(&follower),
        };
    }

    /// Commands a follower again whose last report is not believed; whether that is so.
    fn is_not_believed(&mut self, follower: StationId) -> bool {
        let errand = self.errand.as_ref();
        match errand.and_then(|errand| errand.misfits.get(&follower)) {
            None => return false,
            Some(Amiss::Elsewhere) => self.command(follower),
            // By then it may have come to a stand.
            Some(Amiss::Moving) => self.command_again(follower),
        }
        true
    }

    /// A follower is in position, where it guards from a place.
    pub(super) fn is_in_position(&mut self, follower: StationId) {
        if self.is_not_believed(follower) {
            return;
        }
        let holds = |leg: Leg| self.rules.holding.contains(leg.task);
        if self.leg(follower).is_some_and(holds) {
            self.set(follower, Part::Holds);
        }
        self.open_corridor();
    }

    /// A follower has completed its leg.
    pub(super) fn has_completed(&mut self, follower: StationId) {
        if !self.is_not_believed(follower) {
            self.set(follower, Part::Done);
        }
    }
}
