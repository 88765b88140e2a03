//! Laws of what one source knows of the carriageway: valid for ever, and less evidence clears no part of it (P7).
//!
//! Less evidence is an order, `has_no_more`, which every change keeps and which the clear parts follow. So what is true
//! of one step is true of runs of any length. The road is clear where the sources together have its parts clear.

#![expect(clippy::missing_panics_doc, reason = "laws assert")]

use crossguard_protocol::Millis;
use crossguard_protocol::laws::Source as Numbers;

use super::{PARTS, Source};
use crate::ground::Coverage;
use crate::input::FrameDrop;
use crate::laws::{is_newer, millis};
use crate::setup::Sensors;

/// Changes of a source.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Change {
    /// Time passes.
    Elapsed,
    /// A frame has nobody on the road.
    Empty,
    /// A frame has somebody on the road.
    Occupied,
}

/// A frame, as far as this goes.
#[derive(Clone, Copy, Debug)]
struct Look {
    age: Millis,
    covers: Coverage,
}

fn sensors(source: &mut impl Numbers) -> Sensors {
    Sensors {
        miss_max: source.u8(1),
        age_max: millis(source, 500),
        gap_max: millis(source, 500),
        ..Sensors::default()
    }
}

fn look(source: &mut impl Numbers) -> Look {
    Look {
        age: millis(source, 0),
        covers: Coverage(source.number(u32::MAX, 3)),
    }
}

/// One that is valid, if these numbers make one; with no more empty frames than `most`.
fn state(source: &mut impl Numbers, sensors: &Sensors, most: &[u8; PARTS]) -> Option<Source> {
    let mut state = Source {
        age: source.likely(Some(true)).then(|| millis(source, 200)),
        covers: Coverage(source.number(u32::MAX, 3)),
        owed: Coverage(source.number(u32::MAX, 0)),
        ..Source::default()
    };
    #[expect(
        clippy::needless_range_loop,
        reason = "iterators of slices take Kani long"
    )]
    for part in 0..PARTS {
        if most[part] > 0 {
            state.empty[part] = source.u8(2).min(most[part]);
        }
    }
    is_valid(&state, sensors).then_some(state)
}

/// Two that are valid, the first of which has no more evidence than the second; of so many parts, the others of which
/// nobody knows anything.
fn pair(source: &mut impl Numbers, sensors: &Sensors, parts: usize) -> Option<(Source, Source)> {
    let mut most = [0; PARTS];
    most[..parts.min(PARTS)].fill(u8::MAX);
    let more = state(source, sensors, &most)?;
    let less = state(source, sensors, &more.empty)?;
    has_no_more(&less, &more).then_some((less, more))
}

/// Makes it happen, as the machine does.
fn apply(
    state: &mut Source,
    sensors: &Sensors,
    change: Change,
    look: Look,
) -> Result<(), FrameDrop> {
    match change {
        Change::Elapsed => state.elapse(sensors, look.age),
        Change::Empty => {
            state.admit(sensors, look.age, look.covers)?;
            state.count(sensors);
        }
        Change::Occupied => {
            state.admit(sensors, look.age, look.covers)?;
            state.owe(Coverage::ALL);
        }
    }
    Ok(())
}

fn counts_nothing(state: &Source) -> bool {
    (0..PARTS).all(|part| state.empty[part] == 0)
}

/// Whether every state that comes about is like this: a source that never spoke counts for nothing, nor does one that
/// has been silent for longer than a gap may last.
fn is_valid(state: &Source, sensors: &Sensors) -> bool {
    match state.age {
        None => {
            let is_blank = state.covers == Coverage::NONE && state.owed == Coverage::NONE;
            is_blank && counts_nothing(state)
        }
        Some(age) => {
            let oldest = sensors.gap_max.saturating_add(sensors.age_max);
            let is_old = age > oldest.saturating_add(Millis(1));
            !is_old && (age <= sensors.gap_max || counts_nothing(state))
        }
    }
}

/// Whether `less` has no more for a clear road than `more`: nothing at all, or no newer frames, and as many empty ones of
/// each part at most.
fn has_no_more(less: &Source, more: &Source) -> bool {
    let is_newer = is_newer(less.age, more.age);
    let counts_no_more = (0..PARTS).all(|part| less.empty[part] <= more.empty[part]);
    counts_nothing(less) || (!is_newer && counts_no_more)
}

/// A state that is valid stays valid. Whether a frame was taken in.
pub fn stays_valid(source: &mut impl Numbers, change: Change) -> bool {
    let sensors = sensors(source);
    assert!(is_valid(&Source::default(), &sensors));
    let Some(mut state) = state(source, &sensors, &[u8::MAX; PARTS]) else {
        return false;
    };
    let is_taken_in = apply(&mut state, &sensors, change, look(source)).is_ok();
    assert!(is_valid(&state, &sensors));
    is_taken_in
}

/// With less evidence a part is clear only where it is clear with more. Whether the first of them is.
pub fn less_is_no_clearer(source: &mut impl Numbers) -> bool {
    let sensors = sensors(source);
    let Some((less, more)) = pair(source, &sensors, PARTS) else {
        return false;
    };
    let part = usize::from(source.u8(0)) % PARTS;
    let is_clear = |it: &Source| it.is_fresh(&sensors) && it.empty[part] > sensors.miss_max;
    assert!(!is_clear(&less) || is_clear(&more));
    is_clear(&less)
}

/// Whatever comes, less evidence stays less, unless the one that has more drops what comes because it is out of order:
/// that would be evidence for the other one alone. Whether it was not dropped.
pub fn less_stays_less(source: &mut impl Numbers, change: Change, parts: usize) -> bool {
    let sensors = sensors(source);
    let Some((mut less, mut more)) = pair(source, &sensors, parts) else {
        return false;
    };
    let look = look(source);
    let outcome = apply(&mut more, &sensors, change, look);
    if outcome == Err(FrameDrop::OutOfOrder) {
        return false;
    }
    let _ = apply(&mut less, &sensors, change, look);
    assert!(has_no_more(&less, &more));
    outcome.is_ok()
}

/// Without an empty frame that covers everything there is less evidence than with it. Whether it counted.
pub fn a_frame_is_evidence(source: &mut impl Numbers) -> bool {
    let sensors = sensors(source);
    let Some(without) = state(source, &sensors, &[u8::MAX; PARTS]) else {
        return false;
    };
    let mut with = without;
    let look = Look {
        covers: Coverage::ALL,
        ..look(source)
    };
    if apply(&mut with, &sensors, Change::Empty, look).is_err() {
        return false;
    }
    assert!(has_no_more(&without, &with));
    true
}

/// An empty frame that comes late is no more evidence than one that comes at once. Whether it counted.
pub fn late_is_less(source: &mut impl Numbers) -> bool {
    let sensors = sensors(source);
    let Some(mut late) = state(source, &sensors, &[u8::MAX; PARTS]) else {
        return false;
    };
    let (mut soon, by) = (late, millis(source, 100));
    let look = Look {
        covers: Coverage::ALL,
        ..look(source)
    };
    if apply(&mut soon, &sensors, Change::Empty, look) == Err(FrameDrop::OutOfOrder) {
        return false;
    }
    soon.elapse(&sensors, by);
    late.elapse(&sensors, by);
    let age = look.age.saturating_add(by);
    let counted = apply(&mut late, &sensors, Change::Empty, Look { age, ..look });
    assert!(has_no_more(&late, &soon));
    counted.is_ok()
}

/// A person on the road, an empty frame that is stale or out of order, and time are no evidence. Whether it was
/// an empty frame, or one with somebody that counted.
pub fn the_rest_is_none(source: &mut impl Numbers, change: Change) -> bool {
    let sensors = sensors(source);
    let Some(before) = state(source, &sensors, &[u8::MAX; PARTS]) else {
        return false;
    };
    let mut after = before;
    let is_taken_in = apply(&mut after, &sensors, change, look(source)).is_ok();
    if is_taken_in && change == Change::Empty {
        return false;
    }
    assert!(has_no_more(&after, &before));
    is_taken_in || change == Change::Empty
}

/// A frame that comes twice changes nothing the second time. Whether it counted.
pub fn twice_is_once(source: &mut impl Numbers) -> bool {
    let sensors = sensors(source);
    let Some(mut once) = state(source, &sensors, &[u8::MAX; PARTS]) else {
        return false;
    };
    let look = look(source);
    let outcome = apply(&mut once, &sensors, Change::Empty, look);
    let mut twice = once;
    assert!(apply(&mut twice, &sensors, Change::Empty, look).is_err());
    let is_same = twice.age == once.age && twice.covers == once.covers && twice.owed == once.owed;
    assert!(is_same && (0..PARTS).all(|part| twice.empty[part] == once.empty[part]));
    outcome.is_ok()
}
