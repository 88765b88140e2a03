//! Laws of what is known of the carriageway: valid for ever, and less evidence clears no road (P7).
//!
//! Less evidence is an order, [`has_no_more`], which every input keeps and which a clear road follows. So what is true of
//! one step is true of runs of any length.

#![expect(clippy::missing_panics_doc, reason = "laws assert")]

use crossguard_protocol::Millis;
use crossguard_protocol::laws::Source as Numbers;

use super::{Occupancy, PARTS, Source};
use crate::ground::{Coverage, Ground, Point, Shape};
use crate::input::{Frame, FrameDrop};
use crate::setup::Setup;

/// How much of it is arbitrary.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    /// Of how many parts of the carriageway something is known.
    pub parts: usize,
    /// The source that delivers; any, if none is said.
    pub source: Option<u8>,
}

impl Extent {
    /// All of it.
    pub const ALL: Self = Self {
        parts: PARTS,
        source: None,
    };

    fn source(self, source: &mut impl Numbers) -> u8 {
        self.source.unwrap_or_else(|| source.u8(0))
    }
}

/// What happens to it.
#[derive(Clone, Copy, Debug)]
enum Change {
    Elapsed(Millis),
    /// A frame, with somebody on the road or without.
    Frame(Frame<'static>, bool),
    /// As a frame that was made before a sign went to stop, or something that is no frame.
    Doubt(u8),
    Occupied,
    Settled,
}

fn millis(source: &mut impl Numbers, hint: u32) -> Millis {
    Millis(source.number(u32::MAX, hint))
}

/// Any sensors, on a road that is known or not, of any parts.
fn setup(source: &mut impl Numbers) -> Setup {
    let corners = [(0, 0), (400, 0), (400, 400)].map(|(east, north)| Point::new(east, north));
    let mut setup = Setup {
        ground: Ground {
            road: Shape::new(&corners).filter(|_| source.likely(Some(true))),
            parts: Coverage(source.number(u32::MAX, 3)),
            ..Ground::default()
        },
        ..Setup::default()
    };
    setup.sensors.miss_max = source.u8(1);
    setup.sensors.age_max = millis(source, 500);
    setup.sensors.gap_max = millis(source, 500);
    setup.sensors.linger = millis(source, 1_000);
    setup
}

/// One that is valid in the end: any, or one with less evidence than `more`.
fn state(
    source: &mut impl Numbers,
    extent: Extent,
    setup: &Setup,
    more: Option<&Occupancy>,
) -> Option<Occupancy> {
    let mut state = Occupancy {
        seen: millis(source, 0),
        ..Occupancy::default()
    };
    for (number, one) in state.sources.iter_mut().enumerate() {
        one.age = source.likely(Some(true)).then(|| millis(source, 200));
        one.covers = Coverage(source.number(u32::MAX, 3));
        one.owed = Coverage(source.number(u32::MAX, 0));
        let known = more.map(|more| more.sources[number]);
        for (part, empty) in one.empty.iter_mut().enumerate().take(extent.parts) {
            let most = known.map_or(u8::MAX, |it| it.empty[part]);
            *empty = source.u8(2).min(most);
        }
    }
    let has_no_more = more.is_none_or(|more| has_no_more(&state, more));
    (has_no_more && is_valid(&state, setup)).then_some(state)
}

fn change(source: &mut impl Numbers, extent: Extent) -> Change {
    match source.number(4, 1) {
        0 => Change::Elapsed(millis(source, 100)),
        1 => Change::Frame(frame(source, extent, Coverage::NONE), source.flag()),
        2 => Change::Doubt(extent.source(source)),
        3 => Change::Occupied,
        _ => Change::Settled,
    }
}

/// A frame that covers these parts at least.
fn frame(source: &mut impl Numbers, extent: Extent, covers: Coverage) -> Frame<'static> {
    Frame {
        source: extent.source(source),
        age: millis(source, 0),
        covers: covers.union(Coverage(source.number(u32::MAX, 3))),
        sightings: &[],
    }
}

/// Makes it happen, as the machine does.
fn apply(state: &mut Occupancy, setup: &Setup, change: Change) -> Result<(), FrameDrop> {
    match change {
        Change::Elapsed(time) => state.elapse(setup, time),
        Change::Frame(frame, is_occupied) => {
            state.admit(setup, &frame)?;
            if is_occupied {
                state.owe(setup, &frame);
            } else {
                state.count(setup, &frame);
            }
        }
        Change::Doubt(source) => state.doubt(source),
        Change::Occupied => state.occupy(setup),
        Change::Settled => {
            state.settle(setup);
        }
    }
    Ok(())
}

/// Whether every state that comes about is like this: a source that never spoke counts for nothing, nor does one that
/// has been silent for longer than a gap may last, and nothing outlasts its limit.
fn is_valid(state: &Occupancy, setup: &Setup) -> bool {
    let sensors = &setup.sensors;
    let oldest = sensors.gap_max.saturating_add(sensors.age_max);
    let is_valid = |it: &Source| {
        let counts = it.empty != [0; PARTS];
        match it.age {
            None => !counts && it.covers == Coverage::NONE && it.owed == Coverage::NONE,
            Some(age) => {
                age <= oldest.saturating_add(Millis(1)) && (age <= sensors.gap_max || !counts)
            }
        }
    };
    state.seen <= sensors.linger && state.sources.iter().all(is_valid)
}

/// Whether `less` has no more for a clear road than `more`: of each source nothing at all, or not newer frames, and as many
/// empty ones at most.
fn has_no_more(less: &Occupancy, more: &Occupancy) -> bool {
    let mut sources = less.sources.iter().zip(&more.sources);
    sources.all(|(less, more)| {
        let is_newer = match (less.age, more.age) {
            (Some(less), Some(more)) => less < more,
            (less, more) => more.is_none() && less.is_some(),
        };
        let mut parts = less.empty.iter().zip(&more.empty);
        less.empty == [0; PARTS] || (!is_newer && parts.all(|(less, more)| less <= more))
    })
}

/// A state that is valid stays valid.
pub fn stays_valid(source: &mut impl Numbers, extent: Extent) -> bool {
    let setup = setup(source);
    assert!(is_valid(&Occupancy::default(), &setup));
    let Some(mut state) = state(source, extent, &setup, None) else {
        return false;
    };
    let admitted = apply(&mut state, &setup, change(source, extent)).is_ok();
    assert!(is_valid(&state, &setup));
    admitted
}

/// With less evidence the road is clear only where it is clear with more. Whether it is clear with more.
pub fn less_is_no_clearer(source: &mut impl Numbers, extent: Extent) -> bool {
    let setup = setup(source);
    let Some(more) = state(source, extent, &setup, None) else {
        return false;
    };
    let Some(less) = state(source, extent, &setup, Some(&more)) else {
        return false;
    };
    assert!(!less.is_clear(&setup) || more.is_clear(&setup));
    less.is_clear(&setup)
}

/// Whatever comes, less evidence stays less, unless the one that has more drops what comes because it is out of order:
/// that would be evidence for the other one alone. Whether a frame counted.
pub fn less_stays_less(source: &mut impl Numbers, extent: Extent) -> bool {
    let setup = setup(source);
    let Some(mut more) = state(source, extent, &setup, None) else {
        return false;
    };
    let Some(mut less) = state(source, extent, &setup, Some(&more)) else {
        return false;
    };
    let change = change(source, extent);
    let outcome = apply(&mut more, &setup, change);
    if outcome == Err(FrameDrop::OutOfOrder) {
        return false;
    }
    let _ = apply(&mut less, &setup, change);
    assert!(has_no_more(&less, &more));
    outcome.is_ok() && matches!(change, Change::Frame(_, false))
}

/// Without an empty frame that covers everything there is less evidence than with it. Whether it counted.
pub fn a_frame_is_evidence(source: &mut impl Numbers, extent: Extent) -> bool {
    let setup = setup(source);
    let Some(without) = state(source, extent, &setup, None) else {
        return false;
    };
    let mut with = without.clone();
    let frame = frame(source, extent, Coverage::ALL);
    if apply(&mut with, &setup, Change::Frame(frame, false)).is_err() {
        return false;
    }
    assert!(has_no_more(&without, &with));
    true
}

/// An empty frame that comes late is no more evidence than one that comes at once. Whether it counted.
pub fn late_is_less(source: &mut impl Numbers, extent: Extent) -> bool {
    let setup = setup(source);
    let Some(mut late) = state(source, extent, &setup, None) else {
        return false;
    };
    let mut soon = late.clone();
    let (frame, by) = (frame(source, extent, Coverage::ALL), millis(source, 100));
    if apply(&mut soon, &setup, Change::Frame(frame, false)) == Err(FrameDrop::OutOfOrder) {
        return false;
    }
    soon.elapse(&setup, by);
    late.elapse(&setup, by);
    let age = frame.age.saturating_add(by);
    let counted = apply(
        &mut late,
        &setup,
        Change::Frame(Frame { age, ..frame }, false),
    );
    assert!(has_no_more(&late, &soon));
    counted.is_ok()
}

/// Somebody on the road, what is no frame, a frame that is stale or out of order, and time are no evidence. Whether it was a
/// frame.
pub fn the_rest_is_none(source: &mut impl Numbers, extent: Extent) -> bool {
    let setup = setup(source);
    let Some(before) = state(source, extent, &setup, None) else {
        return false;
    };
    let (mut after, change) = (before.clone(), change(source, extent));
    let outcome = apply(&mut after, &setup, change);
    if outcome.is_ok() && matches!(change, Change::Frame(_, false)) {
        return false;
    }
    assert!(has_no_more(&after, &before));
    matches!(change, Change::Frame(..))
}

/// A frame that comes twice changes nothing the second time. Whether it counted.
pub fn twice_is_once(source: &mut impl Numbers, extent: Extent) -> bool {
    let setup = setup(source);
    let Some(mut once) = state(source, extent, &setup, None) else {
        return false;
    };
    let change = Change::Frame(frame(source, extent, Coverage::NONE), false);
    let outcome = apply(&mut once, &setup, change);
    let mut twice = once.clone();
    assert!(apply(&mut twice, &setup, change).is_err());
    assert_eq!(once, twice);
    outcome.is_ok()
}
