//! The station of a vulnerable road user (VRU): when it sends a VAM, when it leaves its announcement to
//! a robot, and when it takes it up again. TS 103 300-3 clauses 5.4 and 6; the parameters are those of
//! its tables 14 to 17.
//!
//! ```text
//!                       hears itself covered by a RAM
//!        ┌──────────┐ ─────────────────────────────────────────► ┌─────────┐
//!   ───► │standalone│ ── cluster VAM ──► joining ── after 3 s ──► │ passive │  sends nothing
//!        └──────────┘                    (join info)              └────┬────┘
//!             ▲       after 1 s                                        │ left, lost, disbanded,
//!             └────────────────────── leaving (leave info) ◄───────────┘ join failed
//! ```
//!
//! A device that [understands RAM](Understands::Ram) is passive as soon as it finds itself in a RAM: the robot
//! has seen it, so there is nothing to join. By the [strict](Suppression::Strict) rule it finds itself in a
//! cluster if it is inside of the bounding shape and moves as the cluster does; a robot's clusters are close and
//! of one [motion](MATCH), so it was perceived then. The shape moves with the cluster between
//! two announcements. A device that no longer finds itself there resumes at once. By the
//! [loose](Suppression::Loose) rule the bounding shape alone counts, and 3 m around it. An [unmodified](Understands::ClusterVam) one knows cluster
//! VAMs only, and joins by their rules; being inside of the bounding shape after it fell silent stands for
//! the confirmation, since a robot counts the people that it sees. All resume when their head says that the
//! cluster is over, and by the same timers.
//!
//! Where zones overlap, a device stays with the head that it is with. One that understands RAM goes over
//! to another head without a VAM in between, once it is outside of the one's shape and inside of the
//! other's; an unmodified one leaves and joins.
//!
//! Not here: redundancy mitigation, zero-risk areas, the trajectory interception trigger, clusters that
//! change their id or combine, and leading a cluster, which a robot does.

use crossguard_endpoint::ras::area::Area;
use crossguard_endpoint::ras::clustering::CONTINUITY_MS;
use crossguard_endpoint::ras::containers::Announced;
use crossguard_endpoint::ras::generation::Trigger;
use crossguard_endpoint::ras::motion::{Change, MATCH, Motion, STANDING_MPS, distance_m};
use serde::{Deserialize, Serialize};

/// Shortest interval between two VAM, in ms (`T_GenVamMin`).
pub const INTERVAL_MIN_MS: u64 = 100;
/// Longest interval between two VAM, in ms (`T_GenVamMax`).
pub const INTERVAL_MAX_MS: u64 = 5_000;
/// Shortest interval between two low-frequency containers, in ms (`T_GenVamLFMin`).
pub const LOW_FREQUENCY_INTERVAL_MS: u64 = 2_000;
/// How long joining is announced, in ms (`timeClusterJoinNotification`).
pub const JOIN_NOTIFICATION_MS: u64 = 3_000;
/// Until when the head has to confirm a join, in ms (`timeClusterJoinSuccess`).
pub const JOIN_SUCCESS_MS: u64 = 500;
/// How long leaving is announced, in ms (`timeClusterLeaveNotification`).
pub const LEAVE_NOTIFICATION_MS: u64 = 1_000;
/// Distance outside of the bounding shape from which a device is out of the cluster, in metres (`maxClusterDistance`,
/// 3..5).
pub const DISTANCE_MAX_M: f64 = 3.0;
/// Largest difference of velocity to the cluster, as a share of its own (`maxClusterVelocityDifference`).
pub const VELOCITY_DIFFERENCE_MAX: f64 = 0.05;
/// Members that a cluster has at most (`maxClusterSize`).
pub const SIZE_MAX: u8 = 20;

/// When a VAM is due.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum VamRule {
    /// By motion, and at the latest after 5 s (clause 6.2).
    Etsi,
    /// Every this many milliseconds, whatever happens.
    Periodic(u64),
}

/// Which announcements of a cluster a device understands.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Understands {
    /// RAM.
    Ram,
    /// Cluster VAM, as every ETSI device.
    #[serde(alias = "cluster-vam")]
    ClusterVam,
}

/// Whether a device falls silent by a RAM.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Suppression {
    /// Only if it was perceived itself: it is in the shape of a cluster and moves as that does.
    #[default]
    Strict,
    /// Wherever the shape of a cluster covers it, perceived or not.
    Loose,
}

/// The announcement of one head's cluster, as a device hears it.
#[derive(Clone, PartialEq, Debug)]
pub struct Announcement {
    /// Station id of the head.
    pub head: u32,
    /// By which message.
    pub by: Understands,
    /// The cluster; `None` for a head that has none any more, or that says that one is over.
    pub cluster: Option<Announced>,
    /// The velocity of the cluster in m/s, to the east and to the north, if it says one.
    pub velocity_mps: Option<[f64; 2]>,
    /// The id of a cluster that is over.
    pub ended: Option<u8>,
}

/// Why a device left a cluster (TS 102 894-2 `ClusterLeaveReason`).
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum LeaveReason {
    /// Nothing was heard of its head.
    ClusterLeaderLost = 1,
    /// Its head has no cluster any more.
    ClusterDisbandedByLeader = 2,
    /// It went out of the bounding shape.
    OutOfClusterBoundingBox = 3,
    /// It moves otherwise than the cluster.
    OutOfClusterSpeedRange = 4,
    /// It no longer met the conditions while it joined.
    CancelledJoin = 6,
    /// The head did not confirm.
    FailedJoin = 7,
}

/// Cluster operation in the device's VAM.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Operation {
    /// It joins a cluster.
    Join {
        /// Which.
        id: u8,
        /// When it falls silent, in ms on the device's clock.
        at_ms: u64,
    },
    /// It left a cluster.
    Leave {
        /// Which.
        id: u8,
        /// Why.
        reason: LeaveReason,
    },
}

/// A VAM that is due.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct DueVam {
    /// Whether it has the low-frequency container.
    pub low_frequency: bool,
    /// Its cluster operation.
    pub operation: Option<Operation>,
}

/// Whether a device announces itself.
#[derive(Clone, PartialEq, Debug)]
enum State {
    /// It sends VAM (`VRU-ACTIVE-STANDALONE`).
    Standalone,
    /// It sends VAM that announce that it joins.
    Joining(Membership),
    Passive(Membership),
    /// It sends VAM that say that it left.
    Leaving {
        /// The id of the cluster that it left, if it had one.
        id: Option<u8>,
        reason: LeaveReason,
        /// Since when, in ms.
        since_ms: u64,
    },
}

#[derive(Clone, PartialEq, Debug)]
struct Membership {
    /// Station id of its head.
    head: u32,
    /// Its id, if it says one.
    id: Option<u8>,
    /// Since when it is in this state, in ms.
    since_ms: u64,
    /// When the device heard the last time that it is covered, in ms.
    covered_ms: u64,
    /// When it heard its head the last time, in ms.
    heard_ms: u64,
    /// Bounding shape of the cluster then.
    area: Area,
    /// The velocity of the cluster then, if it said one.
    velocity_mps: Option<[f64; 2]>,
}

/// The station of a VRU.
#[derive(Clone, Debug)]
pub struct VruStation {
    rule: VamRule,
    understands: Understands,
    suppression: Suppression,
    state: State,
    /// The last VAM: when, and what it said of the motion.
    said: Option<(u64, Motion)>,
    last_low_frequency_ms: Option<u64>,
    /// Whether it is to say at once that it joins or has left.
    is_pending: bool,
}

impl VruStation {
    /// A device that has just been switched on.
    #[must_use]
    pub const fn new(rule: VamRule, understands: Understands, suppression: Suppression) -> Self {
        Self {
            rule,
            understands,
            suppression,
            state: State::Standalone,
            said: None,
            last_low_frequency_ms: None,
            is_pending: false,
        }
    }

    /// Whether it leaves its announcement to a robot.
    #[must_use]
    pub const fn is_passive(&self) -> bool {
        matches!(self.state, State::Passive(_))
    }

    /// Takes in an announcement, at `now_ms`, in this motion. One by a message that the device does not understand changes nothing.
    pub fn hear(&mut self, now_ms: u64, motion: &Motion, heard: &Announcement) {
        if heard.by != self.understands {
            return;
        }
        let by = self.fit();
        let (State::Joining(membership) | State::Passive(membership)) = &mut self.state else {
            self.consider(now_ms, motion, heard);
            return;
        };
        if membership.head != heard.head {
            let fits = |cluster: &Announced| {
                by.misfit(motion, &cluster.area, heard.velocity_mps)
                    .is_none()
            };
            let fits_there = heard.cluster.as_ref().is_some_and(fits);
            if by == Fit::Etsi || !fits_there || membership.fits(by, now_ms, motion) {
                return;
            }
            // From one robot's zone into the next.
            membership.head = heard.head;
        }
        membership.heard_ms = now_ms;
        let id = membership.id;
        let Some(cluster) = &heard.cluster else {
            if heard.ended.is_none_or(|ended| id == Some(ended)) {
                self.leave(now_ms, id, LeaveReason::ClusterDisbandedByLeader);
            }
            return;
        };
        if by == Fit::Etsi && id != cluster.id {
            return;
        }
        match by.misfit(motion, &cluster.area, heard.velocity_mps) {
            // Its own cluster is elsewhere now.
            Some(reason) if by == Fit::Strict && id == cluster.id => {
                self.leave(now_ms, id, reason);
            }
            Some(_) => {}
            None => {
                membership.id = cluster.id;
                membership.covered_ms = now_ms;
                membership.area = cluster.area.clone();
                membership.velocity_mps = heard.velocity_mps;
            }
        }
    }

    const fn fit(&self) -> Fit {
        match (self.understands, self.suppression) {
            (Understands::ClusterVam, _) => Fit::Etsi,
            (Understands::Ram, Suppression::Strict) => Fit::Strict,
            (Understands::Ram, Suppression::Loose) => Fit::Loose,
        }
    }

    /// The device, which is in no cluster, enters this one if it covers it.
    fn consider(&mut self, now_ms: u64, motion: &Motion, heard: &Announcement) {
        let Some(cluster) = &heard.cluster else {
            return;
        };
        let by = self.fit();
        let by_vam = by == Fit::Etsi;
        let near_m = if by_vam { DISTANCE_MAX_M } else { 0.0 };
        let is_near = cluster.area.distance_m(motion.position_m) <= near_m;
        let is_full = by_vam && cluster.cardinality >= SIZE_MAX;
        if !is_near || !by.is_of_velocity(motion, heard.velocity_mps) || is_full {
            return;
        }
        let membership = Membership {
            head: heard.head,
            id: cluster.id,
            since_ms: now_ms,
            covered_ms: now_ms,
            heard_ms: now_ms,
            area: cluster.area.clone(),
            velocity_mps: heard.velocity_mps,
        };
        self.is_pending = by_vam;
        self.state = if by_vam {
            State::Joining(membership)
        } else {
            State::Passive(membership)
        };
    }

    /// The VAM that is due at `now_ms`, if one is; it counts as sent. To be asked every 100 ms at least
    /// (`T_CheckVamGen`). `congestion_ms` is the shortest interval that congestion control allows.
    pub fn poll(&mut self, now_ms: u64, motion: &Motion, congestion_ms: u64) -> Option<DueVam> {
        self.pass(now_ms, motion);
        if self.is_passive() {
            return None;
        }
        let elapsed = self.said.map(|(last_ms, _)| now_ms.saturating_sub(last_ms));
        if elapsed.is_some_and(|it| it < congestion_ms.max(INTERVAL_MIN_MS)) {
            return None;
        }
        let is_pending = std::mem::take(&mut self.is_pending);
        if !is_pending && !self.is_due_by_rule(elapsed, motion) {
            return None;
        }
        let operation = self.operation();
        let low_frequency = operation.is_some()
            || self
                .last_low_frequency_ms
                .is_none_or(|last| now_ms.saturating_sub(last) >= LOW_FREQUENCY_INTERVAL_MS);
        self.said = Some((now_ms, *motion));
        if low_frequency {
            self.last_low_frequency_ms = Some(now_ms);
        }
        Some(DueVam {
            low_frequency,
            operation,
        })
    }

    fn is_due_by_rule(&self, elapsed: Option<u64>, motion: &Motion) -> bool {
        let (Some(elapsed), Some((_, before))) = (elapsed, &self.said) else {
            return true;
        };
        match self.rule {
            VamRule::Periodic(interval_ms) => elapsed >= interval_ms,
            VamRule::Etsi => {
                let trigger = Trigger::of_motion(&Change::of_motion(before, motion));
                trigger.is_some() || elapsed >= INTERVAL_MAX_MS
            }
        }
    }

    /// Applies time and motion to the membership.
    fn pass(&mut self, now_ms: u64, motion: &Motion) {
        let since = |then_ms: u64| now_ms.saturating_sub(then_ms);
        let by = self.fit();
        match &self.state {
            State::Standalone => {}
            State::Leaving { since_ms, .. } => {
                if since(*since_ms) >= LEAVE_NOTIFICATION_MS {
                    self.state = State::Standalone;
                }
            }
            State::Joining(membership) => {
                if membership.broken(by, now_ms, motion).is_some() {
                    let id = membership.id;
                    self.leave(now_ms, id, LeaveReason::CancelledJoin);
                } else if since(membership.since_ms) >= JOIN_NOTIFICATION_MS {
                    let membership = Membership {
                        since_ms: now_ms,
                        ..membership.clone()
                    };
                    self.state = State::Passive(membership);
                }
            }
            State::Passive(membership) => {
                let unconfirmed = by == Fit::Etsi && membership.covered_ms < membership.since_ms;
                if unconfirmed && since(membership.since_ms) >= JOIN_SUCCESS_MS {
                    let id = membership.id;
                    self.leave(now_ms, id, LeaveReason::FailedJoin);
                } else if let Some(reason) = membership.broken(by, now_ms, motion) {
                    let id = membership.id;
                    self.leave(now_ms, id, reason);
                }
            }
        }
    }

    fn leave(&mut self, now_ms: u64, id: Option<u8>, reason: LeaveReason) {
        self.state = State::Leaving {
            id,
            reason,
            since_ms: now_ms,
        };
        self.is_pending = true;
    }

    fn operation(&self) -> Option<Operation> {
        match &self.state {
            State::Joining(membership) => Some(Operation::Join {
                id: membership.id?,
                at_ms: membership.since_ms + JOIN_NOTIFICATION_MS,
            }),
            State::Leaving { id, reason, .. } => Some(Operation::Leave {
                id: (*id)?,
                reason: *reason,
            }),
            State::Standalone | State::Passive(_) => None,
        }
    }
}

/// Rule by which a device takes itself for a member.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Fit {
    Strict,
    Loose,
    /// By the rules of ETSI for a cluster VAM.
    Etsi,
}

impl Fit {
    /// Why a device in this motion is none of a cluster in this area, if it is none.
    fn misfit(
        self,
        motion: &Motion,
        area: &Area,
        velocity_mps: Option<[f64; 2]>,
    ) -> Option<LeaveReason> {
        if !area.contains(motion.position_m) {
            Some(LeaveReason::OutOfClusterBoundingBox)
        } else if self == Self::Strict && !self.is_of_velocity(motion, velocity_mps) {
            Some(LeaveReason::OutOfClusterSpeedRange)
        } else {
            None
        }
    }

    /// Whether a device moves as a cluster does. By the strict rule nobody moves as a cluster of unknown
    /// velocity, by that of ETSI everybody does.
    fn is_of_velocity(self, motion: &Motion, cluster: Option<[f64; 2]>) -> bool {
        let own = motion.velocity_mps();
        match self {
            Self::Strict => cluster.is_some_and(|cluster| MATCH.holds(own, cluster)),
            Self::Loose => true,
            Self::Etsi => cluster.is_none_or(|cluster| is_within_five_percent(own, cluster)),
        }
    }
}

impl Membership {
    /// Whether the device is still where its cluster is.
    fn fits(&self, by: Fit, now_ms: u64, motion: &Motion) -> bool {
        let area = self.area_at(by, now_ms);
        by.misfit(motion, &area, self.velocity_mps).is_none()
    }

    /// Bounding shape of the cluster now, as far as the device knows: by the strict rule the shape moves with it.
    fn area_at(&self, by: Fit, now_ms: u64) -> Area {
        let area = self.area.clone();
        match (by, self.velocity_mps) {
            (Fit::Strict, Some(velocity_mps)) => {
                #[expect(clippy::cast_precision_loss, reason = "two seconds")]
                let seconds = now_ms.saturating_sub(self.covered_ms) as f64 / 1_000.0;
                area.moved(velocity_mps.map(|mps| mps * seconds))
            }
            _ => area,
        }
    }

    /// Why the device cannot stay, if it cannot.
    fn broken(&self, by: Fit, now_ms: u64, motion: &Motion) -> Option<LeaveReason> {
        let is_over = |since_ms| now_ms.saturating_sub(since_ms) >= CONTINUITY_MS;
        let beyond_m = self.area_at(by, now_ms).distance_m(motion.position_m);
        let beyond_max_m = if by == Fit::Strict {
            0.0
        } else {
            DISTANCE_MAX_M
        };
        if is_over(self.heard_ms) {
            Some(LeaveReason::ClusterLeaderLost)
        } else if is_over(self.covered_ms) || beyond_m > beyond_max_m {
            Some(LeaveReason::OutOfClusterBoundingBox)
        } else if !by.is_of_velocity(motion, self.velocity_mps) {
            Some(LeaveReason::OutOfClusterSpeedRange)
        } else {
            None
        }
    }
}

/// Whether two velocities are the same by ETSI. Two stations that both stand have the same: ETSI says nothing
/// of it, and 5 % of nothing is nothing.
fn is_within_five_percent(own: [f64; 2], cluster: [f64; 2]) -> bool {
    let cluster_mps = cluster[0].hypot(cluster[1]);
    distance_m(own, cluster) <= VELOCITY_DIFFERENCE_MAX * cluster_mps
        || (cluster_mps < STANDING_MPS && own[0].hypot(own[1]) < STANDING_MPS)
}

#[cfg(test)]
mod tests;
