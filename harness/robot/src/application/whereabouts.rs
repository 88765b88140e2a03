//! Where a follower says that it is, held against the place that it was sent to.
//!
//! Completion is inferred from the follower's RAM: position, motion and progression (paper, section III-A). The
//! protocol reads the progression, by session and request; whether the position fits is judged here, where
//! places are known. A follower that reports from elsewhere is commanded again, and in the end the leader gives up: nobody
//! crosses behind a guard that stands in the wrong place.

use crossguard_codec::Position;
use crossguard_protocol::StationId;

use super::Application;
use super::errand::Part;
use crate::plan::Leg;

/// How far from its place a follower may be, besides what its RAM says of its confidence, in metres: less than the width
/// of a lane.
const OUT_OF_PLACE_M: f64 = 2.0;

impl Application {
    /// Takes in where a follower says that it is. A position that is not known judges nobody.
    pub fn follower_is_at(&mut self, follower: StationId, position: &Position) {
        let Some((leg, errand)) = self.leg(follower).zip(self.errand.as_mut()) else {
            return;
        };
        let Some((latitude, longitude)) = position.latitude.zip(position.longitude) else {
            errand.elsewhere.remove(&follower);
            return;
        };
        let off_m = self.site.place(latitude, longitude).distance(leg.to);
        let confidence_m = position.ellipse.map_or(0.0, |ellipse| ellipse.semi_major);
        if off_m > OUT_OF_PLACE_M + confidence_m {
            tracing::warn!(%follower, off_m, "reports from elsewhere than where it was sent");
            errand.elsewhere.insert(follower);
        } else {
            errand.elsewhere.remove(&follower);
        }
    }

    /// Whether a follower said last that it is elsewhere than where it was sent.
    fn is_elsewhere(&self, follower: StationId) -> bool {
        let errand = self.errand.as_ref();
        errand.is_some_and(|errand| errand.elsewhere.contains(&follower))
    }

    /// A follower is in position, where it guards from a place.
    pub(super) fn is_in_position(&mut self, follower: StationId) {
        if self.is_elsewhere(follower) {
            return self.command(follower);
        }
        let holds = |leg: Leg| self.rules.holding.contains(leg.task);
        if self.leg(follower).is_some_and(holds) {
            self.set(follower, Part::Holds);
        }
        self.open_corridor();
    }

    /// A follower has completed its leg.
    pub(super) fn has_completed(&mut self, follower: StationId) {
        if self.is_elsewhere(follower) {
            return self.command(follower);
        }
        self.set(follower, Part::Done);
    }
}
