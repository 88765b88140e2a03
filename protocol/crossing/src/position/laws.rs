//! Laws of being at a place: valid for ever, and less evidence is no presence (P7).

#![expect(clippy::missing_panics_doc, reason = "laws assert")]

use crossguard_protocol::Millis;
use crossguard_protocol::laws::Source;

use super::{Off, Presence};
use crate::laws::{is_newer, millis};
use crate::setup::PositionRules;

/// A position, as far as its presence goes: how far off, and how old.
type Look = (Option<Off>, Millis);

fn rules(source: &mut impl Source) -> PositionRules {
    PositionRules {
        tolerance_cm: source.u16(200),
        lease: millis(source, 1_000),
        ahead_cm: source.u16(200),
    }
}

fn off(source: &mut impl Source) -> Off {
    Off {
        cm: source.number(u32::MAX, 150),
        error_cm: source.u16(10),
    }
}

fn look(source: &mut impl Source) -> Look {
    let off = source.likely(Some(true)).then(|| off(source));
    (off, millis(source, 100))
}

/// One that is valid, if these numbers make one.
fn presence(source: &mut impl Source, rules: PositionRules) -> Option<Presence> {
    let presence = Presence {
        left: millis(source, 800),
        newest: source.likely(Some(true)).then(|| millis(source, 200)),
        is_elsewhere: source.flag(),
    };
    is_valid(presence, rules).then_some(presence)
}

/// Whether it is what comes about: presence ends when the position that it rests on is as old as a lease.
fn is_valid(presence: Presence, rules: PositionRules) -> bool {
    let Presence { left, newest, .. } = presence;
    let rests =
        newest.is_some_and(|age| age < rules.lease && left == rules.lease.saturating_sub(age));
    let ages = newest.is_none_or(|age| age <= rules.lease.saturating_add(Millis(1)));
    ages && (left == Millis::ZERO || (rests && !presence.is_elsewhere))
}

/// Whether `less` is there for no longer than `more`, by positions that are no newer.
fn has_no_more(less: Presence, more: Presence) -> bool {
    let is_newer = is_newer(less.newest, more.newest);
    less.left == Millis::ZERO || (!is_newer && less.left <= more.left)
}

/// A state that is valid stays valid, also as time passes. Whether the body is there.
pub fn stays_valid(source: &mut impl Source) -> bool {
    let rules = rules(source);
    assert!(is_valid(Presence::NOWHERE, rules));
    let Some(mut presence) = presence(source, rules) else {
        return false;
    };
    if source.flag() {
        let (off, age) = look(source);
        presence.take(rules, off, age);
    } else {
        presence.elapse(rules, millis(source, 100));
    }
    assert!(is_valid(presence, rules));
    assert!(!presence.is_there() || presence.is_fresh(rules));
    presence.is_there()
}

/// Whatever comes in order, less presence stays less. Whether there is some.
pub fn less_stays_less(source: &mut impl Source) -> bool {
    let rules = rules(source);
    let (Some(mut less), Some(mut more)) = (presence(source, rules), presence(source, rules))
    else {
        return false;
    };
    if !has_no_more(less, more) {
        return false;
    }
    if source.flag() {
        let time = millis(source, 100);
        less.elapse(rules, time);
        more.elapse(rules, time);
    } else {
        let (off, age) = look(source);
        let is_late = more.newest.is_some_and(|newest| age > newest);
        if off.is_some() && is_late {
            return false;
        }
        less.take(rules, off, age);
        more.take(rules, off, age);
    }
    assert!(has_no_more(less, more));
    less.is_there()
}

/// A position that is less exact, farther off or older than another, or none, is no more presence. Whether the body is there
/// by the better one.
pub fn worse_is_less(source: &mut impl Source) -> bool {
    let rules = rules(source);
    let Some(before) = presence(source, rules) else {
        return false;
    };
    let (good, soon) = (off(source), millis(source, 100));
    if before.newest.is_some_and(|newest| soon > newest) {
        return false;
    }
    let worse = Off {
        cm: good.cm.saturating_add(source.number(u32::MAX, 10)),
        error_cm: good.error_cm.saturating_add(source.u16(10)),
    };
    let worse = source.likely(Some(true)).then_some(worse);
    let (mut less, mut more, by) = (before, before, millis(source, 100));
    more.take(rules, Some(good), soon);
    more.elapse(rules, by);
    less.elapse(rules, by);
    less.take(rules, worse, soon.saturating_add(by));
    if worse.is_some() && soon.saturating_add(by) >= rules.lease {
        // It comes too late to say anything.
        let mut unaware = before;
        unaware.elapse(rules, by);
        assert_eq!(less, unaware);
    } else {
        assert!(has_no_more(less, more));
    }
    more.is_there()
}
