//! Whether the carriageway is empty: decided by frames, and by nothing else.
//!
//! The road is clear when, after the last sign went to stop and the time in which people who saw it step off the kerb, each of its parts was covered by more than `miss_max`
//! consecutive frames without anybody on the carriageway, and is covered now. Whatever speaks against that starts the count
//! anew: somebody on the road, also as another station reports them, a frame that comes too late, a gap between two
//! frames, a line that is no frame. Silence counts nothing.

#[cfg(any(test, feature = "laws"))]
pub mod laws;

use crossguard_protocol::Millis;

use crate::ground::Coverage;
use crate::input::{Frame, FrameDrop};
use crate::setup::{Sensors, Setup};

/// Capacity for sources of one robot.
pub const SOURCES: usize = 4;

/// Capacity of a [`Coverage`] for parts.
const PARTS: usize = 32;

/// The beliefs about one source.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
struct Source {
    /// Time since its newest frame was made; `None` before the first.
    age: Option<Millis>,
    /// The parts that its newest frame covers.
    covers: Coverage,
    /// In how many consecutive frames each part was covered and nobody on the road, saturating.
    empty: [u8; PARTS],
    /// The parts that it covered when it had somebody on the road, until they are empty again.
    owed: Coverage,
}

/// The beliefs about the carriageway.
#[derive(Clone, PartialEq, Eq, Hash, Debug, Default)]
pub struct Occupancy {
    sources: [Source; SOURCES],
    /// For how long yet somebody counts as on the road, or has just left it.
    seen: Millis,
}

impl Source {
    fn is_fresh(&self, sensors: &Sensors) -> bool {
        self.age.is_some_and(|age| age <= sensors.gap_max)
    }

    /// The parts that are known to be empty.
    fn clear(&self, sensors: &Sensors) -> Coverage {
        let parts = self.empty.iter().enumerate();
        let clear = parts.filter(|(_, empty)| **empty > sensors.miss_max);
        clear.fold(Coverage::NONE, |all, (part, _)| {
            all.union(Coverage(1 << part))
        })
    }

    const fn start_anew(&mut self) {
        self.empty = [0; PARTS];
    }

    fn elapse(&mut self, sensors: &Sensors, time: Millis) {
        // An age beyond any limit stays there.
        let oldest = sensors.gap_max.saturating_add(sensors.age_max);
        let oldest = oldest.saturating_add(Millis(1));
        self.age = self.age.map(|age| age.saturating_add(time).min(oldest));
        if !self.is_fresh(sensors) {
            self.start_anew();
        }
    }

    /// Whether a frame of such an age counts; that it came is noted.
    fn admit(&mut self, sensors: &Sensors, age: Millis, covers: Coverage) -> Result<(), FrameDrop> {
        if age > sensors.age_max {
            self.start_anew();
            return Err(FrameDrop::Stale);
        }
        if let Some(newest) = self.age.filter(|newest| age >= *newest) {
            // One that was on its way while others overtook it: those were not consecutive.
            if age > newest {
                self.start_anew();
            }
            return Err(FrameDrop::OutOfOrder);
        }
        // After a gap nothing counts any more: that ended as time passed.
        (self.age, self.covers) = (Some(age), covers);
        Ok(())
    }

    /// Counts the frame that was admitted last and had nobody on the road, unless it is as old as silence.
    fn count(&mut self, sensors: &Sensors) {
        if !self.is_fresh(sensors) {
            return self.start_anew();
        }
        for part in 0..PARTS {
            let is_covered = self.covers.has(Coverage(1 << part));
            self.empty[part] = if is_covered {
                self.empty[part].saturating_add(1)
            } else {
                0
            };
        }
    }

    /// The frame that was admitted last had somebody on the road.
    fn owe(&mut self, parts: Coverage) {
        let covered = if self.covers == Coverage::NONE {
            parts
        } else {
            self.covers
        };
        self.owed = self.owed.union(covered);
        self.start_anew();
    }
}

impl Occupancy {
    /// Lets time pass.
    pub(crate) fn elapse(&mut self, setup: &Setup, time: Millis) {
        self.seen = self.seen.saturating_sub(time);
        for source in &mut self.sources {
            source.elapse(&setup.sensors, time);
        }
    }

    /// Whether a frame counts; that it came is noted.
    pub(crate) fn admit(&mut self, setup: &Setup, frame: &Frame<'_>) -> Result<(), FrameDrop> {
        let source = self.sources.get_mut(usize::from(frame.source));
        let source = source.ok_or(FrameDrop::NoSuchSource)?;
        source.admit(&setup.sensors, frame.age, frame.covers)
    }

    /// Counts a frame that was admitted and had nobody on the road, unless it is as old as silence.
    pub(crate) fn count(&mut self, setup: &Setup, frame: &Frame<'_>) {
        if let Some(source) = self.sources.get_mut(usize::from(frame.source)) {
            source.count(&setup.sensors);
        }
    }

    /// A frame that was admitted has somebody on the road.
    pub(crate) fn owe(&mut self, setup: &Setup, frame: &Frame<'_>) {
        if let Some(source) = self.sources.get_mut(usize::from(frame.source)) {
            source.owe(setup.ground.parts);
        }
    }

    /// Whether its own sensors have had nobody on the road for more than `miss_max` frames; what they covered before
    /// is forgotten then.
    pub(crate) fn settle(&mut self, setup: &Setup) -> bool {
        let is_empty = self.sees_nobody(setup);
        if is_empty {
            for source in &mut self.sources {
                source.owed = Coverage::NONE;
            }
        }
        is_empty
    }

    /// A source delivered something that is no frame.
    pub(crate) fn doubt(&mut self, source: u8) {
        if let Some(source) = self.sources.get_mut(usize::from(source)) {
            source.start_anew();
        }
    }

    /// A person is on the road, and counts as there for so long.
    pub(crate) fn occupy(&mut self, linger: Millis) {
        self.start_anew();
        self.seen = self.seen.max(linger);
    }

    /// Starts the count anew.
    pub(crate) fn start_anew(&mut self) {
        for source in &mut self.sources {
            source.start_anew();
        }
    }

    /// Whether any source has ever delivered a frame.
    #[must_use]
    pub fn has_sources(&self) -> bool {
        self.sources.iter().any(|source| source.age.is_some())
    }

    /// Whether the sources cover the whole carriageway now.
    #[must_use]
    pub fn is_covered(&self, setup: &Setup) -> bool {
        let fresh = self.sources.iter().filter(|it| it.is_fresh(&setup.sensors));
        covers_all(setup, fresh.map(|source| source.covers))
    }

    /// Whether the sources cover the whole carriageway now, and each that ever looked still does: one that fails may have been the
    /// one that saw vehicles come.
    #[must_use]
    pub fn is_watched(&self, setup: &Setup) -> bool {
        let mut known = self.sources.iter().filter(|it| it.age.is_some());
        self.is_covered(setup) && known.all(|it| it.is_fresh(&setup.sensors))
    }

    /// Whether the carriageway is known to be empty now.
    #[must_use]
    pub fn is_clear(&self, setup: &Setup) -> bool {
        let sensors = &setup.sensors;
        let fresh = self.sources.iter().filter(|it| it.is_fresh(sensors));
        setup.ground.road.is_some() && covers_all(setup, fresh.map(|it| it.clear(sensors)))
    }

    /// Whether the robot's own sensors all work and have had nobody on the road for more than `miss_max` frames, in what
    /// they cover, and in what they covered when they saw somebody last.
    #[must_use]
    pub fn sees_nobody(&self, setup: &Setup) -> bool {
        let sensors = &setup.sensors;
        let known = || self.sources.iter().filter(|source| source.age.is_some());
        let looked = |it: &Source| it.covers.union(it.owed);
        // A source that looks nowhere sees nobody come and go.
        known().any(|it| looked(it) != Coverage::NONE)
            && known().all(|it| it.is_fresh(sensors) && it.clear(sensors).has(looked(it)))
    }

    /// Whether the robot's own sensors had somebody on the road, and have not had nobody there since.
    #[must_use]
    pub fn owes(&self) -> bool {
        self.sources
            .iter()
            .any(|source| source.owed != Coverage::NONE)
    }

    /// Whether somebody was seen or reported on the road within the last `linger`.
    #[must_use]
    pub fn was_seen(&self) -> bool {
        self.seen > Millis::ZERO
    }
}

fn covers_all(setup: &Setup, parts: impl Iterator<Item = Coverage>) -> bool {
    let covered = parts.fold(Coverage::NONE, Coverage::union);
    setup.ground.parts != Coverage::NONE && covered.has(setup.ground.parts)
}
