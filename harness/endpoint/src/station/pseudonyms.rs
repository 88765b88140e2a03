//! Pseudonyms of one robot: when they change, and what is drawn anew with them.
//!
//! A pseudonym is a ticket with all that follows from it, station id and link address, and with all that this module
//! draws for it: the numbers of sessions and offers, the ids of clusters, and how long the robot is silent before it.
//! All draws follow from a secret that nobody else knows and from the station id, so that two pseudonyms do not
//! tell that they are one robot, and one that comes back gives out no number twice:
//!
//! ```text
//!  number on the air = boot counter + mask(secret, station id) │ count since this pseudonym was taken
//!                      └────────────── 16 bits ────────────────┘ └────────── 16 bits ───────────┘
//! ```
//!
//! Robots with the same period change at the same moments, at multiples of the period on the ITS clock: where each
//! changed at its own, the station that appears would be the one that has just vanished. A robot that has a part in a session or
//! a duty on the road then waits for the next such moment.

use std::collections::BTreeMap;

use crossguard_codec::geonet::{EgoPosition, Envelope};
use crossguard_codec::security::{keyed_digest, random_octets};
use crossguard_codec::{Identifiers, Service};
use crossguard_protocol::{Robot, StationId, UniqueNumber};

/// The share of its period for which a robot is silent at most: 10 s of 5 minutes.
const SILENCE_PER_PERIOD: u64 = 30;
/// For how long after such a moment a robot still changes, in ms: so often each looks at its clock at least.
const MOMENT_MS: u64 = 500;

/// Secret from which a robot draws for its pseudonyms. Nobody else knows it.
#[derive(Clone, Copy, Default)]
pub struct Secret([u8; 32]);

/// Kind of a draw for a pseudonym.
#[derive(Clone, Copy)]
enum Drawn {
    Epoch = 1,
    Silence = 2,
    Clusters = 3,
}

impl std::fmt::Debug for Secret {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Secret")
    }
}

impl Secret {
    /// A secret for as long as it is not dropped.
    #[must_use]
    pub fn random() -> Self {
        Self(random_octets())
    }

    /// Octets that nobody can guess, which the robot keeps: with others, a pseudonym that comes back after a restart
    /// might give out a number twice.
    #[must_use]
    pub const fn new(octets: [u8; 32]) -> Self {
        Self(octets)
    }

    fn draw(&self, what: Drawn, station: StationId) -> u64 {
        let mut octets = [what as u8; 5];
        octets[1..].copy_from_slice(&station.0.to_be_bytes());
        let drawn = keyed_digest(&self.0, &octets);
        let first = drawn.first_chunk().expect("it has 32 octets");
        u64::from_be_bytes(*first)
    }

    #[expect(clippy::cast_possible_truncation, reason = "16 bits are wanted")]
    fn mask(&self, station: StationId) -> u16 {
        self.draw(Drawn::Epoch, station) as u16
    }

    /// Stand-in for a boot counter in the numbers of this station. Different boot counters give different ones.
    #[must_use]
    pub fn epoch(&self, station: StationId, boot: u16) -> u16 {
        boot.wrapping_add(self.mask(station))
    }

    /// The boot counter of [`epoch`](Self::epoch).
    fn boot(&self, station: StationId, epoch: u16) -> u16 {
        epoch.wrapping_sub(self.mask(station))
    }

    /// Seed of the ids of clusters under this pseudonym.
    pub(crate) fn clusters(&self, station: StationId, boot: u16) -> u64 {
        self.draw(Drawn::Clusters, station) ^ u64::from(boot)
    }
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Taken {
    /// Its station id.
    pub(crate) station: StationId,
    /// Where its session and offer numbers begin.
    pub(crate) next: UniqueNumber,
    /// Seed of the ids of its clusters.
    pub(crate) clusters: u64,
}

#[derive(Clone, Debug, Default)]
pub(crate) struct Pseudonyms {
    secret: Secret,
    period_ms: Option<u64>,
    /// The moment of the last change, in periods since 2004; `None` before the clock was looked at.
    moment: Option<u64>,
    /// Until when nothing is said that nobody needs, on the robot's clock.
    silent_until_ms: u64,
    /// The numbers that come next under own station ids that may come back.
    numbers: BTreeMap<StationId, UniqueNumber>,
    /// Whether the robot is unavailable because no ticket lasts for a session, and nobody said anything of it since.
    pub(crate) have_ended: bool,
}

impl Pseudonyms {
    /// Pseudonyms that are changed after `period_ms`.
    pub(crate) const fn new(secret: Secret, period_ms: Option<u64>) -> Self {
        Self {
            secret,
            period_ms,
            moment: None,
            silent_until_ms: 0,
            numbers: BTreeMap::new(),
            have_ended: false,
        }
    }

    /// Takes another ticket if that is due, or if the ticket is over within `lock_ms`, as long as a session may take.
    /// The caller changes all that goes with it at once, and calls this only while the identity is not locked. A robot that stands on
    /// the road for its duty changes for the end of a ticket alone: a change without silence hides nothing.
    pub(crate) fn take(
        &mut self,
        envelope: &mut Envelope,
        identifiers: &Identifiers,
        ego: &EgoPosition,
        robot: &Robot,
        lock_ms: u64,
    ) -> Option<Taken> {
        let Envelope::Secured(secured) = envelope else {
            return None;
        };
        let is_due = robot.duty().is_none() && self.is_due(ego.timestamp_its);
        let period_ms = self.period_ms.filter(|_| is_due);
        // Until the next change at least, so that no ticket ends between two of them.
        let longer = period_ms.and_then(|period_ms| {
            secured.renew_pseudonym(ego, true, lock_ms.saturating_add(period_ms))
        });
        longer.or_else(|| secured.renew_pseudonym(ego, period_ms.is_some(), lock_ms))?;
        let before = robot.station();
        let boot = self.secret.boot(before, robot.boot());
        self.numbers.insert(before, robot.next_number());
        let station = secured.station_id(Service::Ram.its_aid(identifiers));
        Some(Taken {
            station,
            next: self.next(station, boot),
            clusters: self.secret.clusters(station, boot),
        })
    }

    /// The first number under a station id that none was given out under, in this boot.
    fn next(&self, station: StationId, boot: u16) -> UniqueNumber {
        let first = UniqueNumber {
            boot: self.secret.epoch(station, boot),
            count: 0,
        };
        let known = self.numbers.get(&station);
        known
            .filter(|known| known.boot == first.boot)
            .copied()
            .unwrap_or(first)
    }

    fn is_due(&mut self, timestamp_its: u64) -> bool {
        let Some(period_ms) = self.period_ms else {
            return false;
        };
        let moment = timestamp_its / period_ms;
        let before = *self.moment.get_or_insert(moment);
        if moment <= before {
            return false;
        }
        self.moment = Some(moment);
        timestamp_its % period_ms < MOMENT_MS
    }

    /// Says nothing that nobody needs for a while, under the pseudonym that was taken at `now_ms`.
    pub(crate) fn fall_silent(&mut self, station: StationId, now_ms: u64) {
        let most_ms = self.period_ms.unwrap_or_default() / SILENCE_PER_PERIOD;
        let drawn = self.secret.draw(Drawn::Silence, station);
        self.silent_until_ms = now_ms + drawn.checked_rem(most_ms).unwrap_or(0);
    }

    pub(crate) const fn break_silence(&mut self) {
        self.silent_until_ms = 0;
    }

    /// Whether nothing is to be said at `now_ms` that nobody needs.
    pub(crate) const fn is_silent(&self, now_ms: u64) -> bool {
        now_ms < self.silent_until_ms
    }

    /// Stand-in for a boot counter that has been persisted, in the numbers of this station.
    pub(crate) fn epoch(&self, station: StationId, boot: u16) -> u16 {
        self.secret.epoch(station, boot)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    const SECRET: Secret = Secret::new([7; 32]);
    const A: StationId = StationId(0x1234_5678);
    const B: StationId = StationId(0x9abc_def0);

    #[test]
    fn no_two_boots_of_a_station_have_one_epoch() {
        let epochs: BTreeSet<_> = (0..=u16::MAX).map(|boot| SECRET.epoch(A, boot)).collect();
        assert_eq!(epochs.len(), 1 << 16);
        for boot in [0, 1, 70, u16::MAX] {
            assert_eq!(SECRET.boot(A, SECRET.epoch(A, boot)), boot);
        }
    }

    #[test]
    fn epochs_of_two_pseudonyms_have_nothing_to_do_with_each_other() {
        let mut differences = BTreeSet::new();
        for number in 0..1_000 {
            let [a, b] = [number, number + 1].map(|it| SECRET.epoch(StationId(it), 1));
            differences.insert(a.wrapping_sub(b));
        }
        assert!(differences.len() > 980, "{}", differences.len());
        let other = Secret::new([8; 32]);
        assert_ne!(SECRET.epoch(A, 1), other.epoch(A, 1));
    }

    #[test]
    fn a_pseudonym_that_comes_back_counts_on() {
        let mut pseudonyms = Pseudonyms::new(SECRET, Some(1_000));
        let first = pseudonyms.next(A, 3);
        assert_eq!(first.count, 0);
        let after = UniqueNumber { count: 5, ..first };
        pseudonyms.numbers.insert(A, after);
        assert_eq!(pseudonyms.next(A, 3), after);
        assert_eq!(pseudonyms.next(B, 3).count, 0);
        // In another boot, its numbers are all new.
        let renewed = pseudonyms.next(A, 4);
        assert_eq!(renewed.count, 0);
        assert_ne!(renewed.boot, first.boot);
    }

    #[test]
    fn robots_change_at_the_same_moments_and_not_in_between() {
        let mut early = Pseudonyms::new(SECRET, Some(10_000));
        let mut late = Pseudonyms::new(SECRET, Some(10_000));
        assert!(!early.is_due(40_100));
        assert!(!late.is_due(46_000));
        assert!(!early.is_due(49_999));
        assert!(early.is_due(50_000) && late.is_due(50_090));
        assert!(!early.is_due(50_100));
        // A robot that was in a session then waits for the next moment.
        assert!(!early.is_due(60_500));
        assert!(!early.is_due(60_600));
        assert!(early.is_due(70_499));
        // A clock that went back changes nothing.
        assert!(!early.is_due(60_000));
    }

    #[test]
    fn silence_ends_by_itself_or_when_somebody_needs_the_robot() {
        let mut pseudonyms = Pseudonyms::new(SECRET, Some(300_000));
        let lengths: BTreeSet<_> = (0..100)
            .map(|station| {
                pseudonyms.fall_silent(StationId(station), 1_000);
                pseudonyms.silent_until_ms - 1_000
            })
            .collect();
        assert!(lengths.len() > 90);
        assert!(lengths.iter().all(|length| *length < 10_000));
        let end_ms = pseudonyms.silent_until_ms;
        assert!(pseudonyms.is_silent(end_ms - 1) && !pseudonyms.is_silent(end_ms));
        pseudonyms.break_silence();
        assert!(!pseudonyms.is_silent(1_000));
        let mut never = Pseudonyms::new(SECRET, None);
        never.fall_silent(A, 1_000);
        assert!(!never.is_silent(1_000));
    }
}
