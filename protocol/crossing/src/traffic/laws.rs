//! Laws of vehicles that come: less evidence stops nobody (P7).

#![expect(clippy::missing_panics_doc, reason = "laws assert")]

use crossguard_protocol::laws::Source;

use super::Motion;
use crate::laws::millis;
use crate::setup::TrafficRules;

/// A vehicle that can stop comfortably by an old or an inexact report of it can by a newer or a more exact one that says the
/// same, and from farther away; and one that comes soon by the better report does by the worse one. Whether it can stop by the
/// worse one.
pub fn worse_stops_no_vehicle(source: &mut impl Source) -> bool {
    let rules = TrafficRules {
        reaction: millis(source, 2_000),
        deceleration_cmps2: source.u16(300),
        ..TrafficRules::default()
    };
    let better = Motion {
        left_cm: source.number(u32::MAX, 6_500),
        error_cm: source.u16(10),
        speed_cmps: source.number(u32::MAX, 1_389),
        is_in_line: source.flag(),
    };
    let worse = Motion {
        left_cm: better.left_cm.saturating_sub(source.number(u32::MAX, 50)),
        error_cm: better.error_cm.saturating_add(source.u16(10)),
        ..better
    };
    let (soon, by) = (millis(source, 100), millis(source, 100));
    let can_stop = worse.can_stop(&rules, soon.saturating_add(by));
    assert!(!can_stop || better.can_stop(&rules, soon));
    let within = millis(source, 10_000);
    assert!(
        !better.comes_within(within, soon) || worse.comes_within(within, soon.saturating_add(by))
    );
    can_stop
}
