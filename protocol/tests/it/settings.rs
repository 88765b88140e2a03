//! Settings that satisfy every inequality are taken, and others are refused by the name of the first that they break.

use std::collections::BTreeSet;

use crossguard_protocol::*;

use crate::interpreter::words::set;

/// Changes of the default settings, at the edges of the inequalities. Behind `#` is why the edge is there.
const EDGES: &str = "\
-> taken
t_ack=0 -> timer-in-range
t_ack=1 -> taken
t_exec.7=86400001 -> timer-in-range
delay_max=86400001 -> timer-in-range
n_ack=0 -> repeats-in-range
n_ack=15 -> taken
n_ack=16 -> repeats-in-range
drift_ppm=100000 -> drift-in-range
drift_ppm=0 t_lease=1949 -> taken # t_lease + 50 < 2000 with perfect clocks
drift_ppm=0 t_lease=1950 -> lease-within-safety
t_lease=1946 -> taken # (t_lease + 50) * 1.001 < 2000 * 0.999
t_lease=1947 -> lease-within-safety
delay_max=97 -> lease-within-safety
drift_ppm=20000 -> lease-within-safety
t_lease=300 -> taken
t_lease=299 -> heartbeats-within-lease
t_select=2999 -> taken
t_select=3000 -> selection-within-offer
t_offer=351 -> taken # (3 * 100 + 50) * 1.001 < t_offer * 0.999
t_offer=350 -> heartbeats-within-offer
t_offer=10000 -> taken
t_offer=10001 -> offer-within-help
t_farewell=300 -> taken
t_farewell=299 -> farewell-repeated
t_lock=71001 -> taken
t_lock=71000 -> lock-outlasts-task
t_exec.9=86400000 -> taken # it cannot do that task
t_exec.1=86400000 -> lock-outlasts-task
capabilities= t_cross=1 t_lock=11001 -> taken # a session without a task
capabilities= t_cross=1 t_lock=11000 -> lock-outlasts-task
t_cross=60000 -> taken
t_cross=60001 -> crossing-within-limits
capabilities= t_cross=298999 -> taken
capabilities= t_cross=299000 -> crossing-within-limits
t_lock=3276799 -> taken
t_lock=3276800 -> heartbeats-in-number-space
guarding= -> named-tasks-guard
guarding=move -> named-tasks-guard
guarding=block -> named-tasks-guard
guarding=1+2+3+4+5+6+7+8+9+10+11+12+13+14+15 holding=0+1+2+3+4+5+6+7+8+9+10+11+12+13+14+15 -> taken
holding= -> block-holds";

#[test]
fn each_inequality_is_refused_by_its_name_and_at_its_edge() {
    let mut refused = BTreeSet::new();
    for row in EDGES.lines() {
        let edge = row.split(" # ").next().unwrap();
        let (changes, expected) = edge.split_once("-> ").expect("an outcome");
        let changes: Vec<_> = changes.split_whitespace().collect();
        let mut settings = Settings::default();
        set(&mut settings, &changes).unwrap();
        let broken = Config::new(settings).err().map(|broken| broken.0.name());
        assert_eq!(broken.unwrap_or("taken"), expected, "{row}");
        refused.extend(broken);
    }
    assert_eq!(refused.len(), Inequality::ALL.len(), "{refused:?}");
}

#[test]
fn a_broken_inequality_says_its_name_and_what_would_hold() {
    let settings = Settings {
        t_lease: Settings::default().t_safety,
        ..Settings::default()
    };
    assert_eq!(
        Config::new(settings).unwrap_err().to_string(),
        "the settings break 'lease-within-safety': (t_lease + delay_max) * (1 + drift) < t_safety * (1 - drift)"
    );
}
