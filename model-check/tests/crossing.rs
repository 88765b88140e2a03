//! The crossing machine with real robots, explored to the end: the rules hold, each premise is met, and each rule has a
//! weakening that breaks it alone.

use std::time::Duration;

use crossguard_crossing::Setup;
use crossguard_model_check::check::{Options, Stop};
use crossguard_model_check::crossing::*;
use crossguard_model_check::report::CutOff;
use crossguard_protocol::{Millis, TaskSet};

#[test]
fn every_rule_holds_in_every_street_and_every_premise_is_met() {
    for street in SHIPPED {
        let report = street.check(&Options::default(), &mut |_| ());
        let name = street.name;
        assert!(report.exhaustive && !report.failed(), "{name}: {report:#?}");
    }
    let claimed = |rule: &Rule| SHIPPED.iter().any(|it| it.rules.contains(rule));
    assert!(Rule::ALL.iter().all(claimed));
}

const PERSON: Street = Street::PERSON;

/// A street, settings that are weaker, and the rule that these break alone.
type Weakening = (Street, fn(&mut Setup), Rule);

const DRIFTING: Street = Street {
    drifts: 1,
    ..PERSON
};
const GUARD: Street = Street {
    watch: Watch::Guard,
    words: 5,
    ..PERSON
};
const LATE: Street = Street {
    late: true,
    ..PERSON
};
const OUTAGE: Street = Street {
    outages: 1,
    ..PERSON
};
const TEAM: Street = Street {
    guards: 2,
    ..PERSON
};
const WITH_VEHICLE: Street = Street {
    vehicle: true,
    ..PERSON
};

const ASKED: Street = Street {
    asks: true,
    ..WITH_VEHICLE
};

/// One empty frame is enough, and nobody lingers.
fn trusts_one_frame(setup: &mut Setup) {
    setup.sensors.miss_max = 0;
    setup.sensors.linger = Millis(0);
}

/// Drivers need no time, and brakes are perfect.
fn trusts_drivers(setup: &mut Setup) {
    setup.traffic.reaction = Millis(0);
    setup.traffic.deceleration_cmps2 = 60_000;
}

/// No person is ever known to be across, and the leader has patience.
fn never_ends(setup: &mut Setup) {
    setup.sensors.linger = Millis(60_000);
    if let Some(plan) = &mut setup.plan {
        plan.patience = Millis(60_000);
    }
}

#[rustfmt::skip]
const WEAKENINGS: &[Weakening] = &[
    (PERSON, trusts_one_frame, Rule::P1),
    (GUARD, trusts_one_frame, Rule::P1),
    // Nobody steps on the road later than half a second after go.
    (LATE, |setup| setup.waiting.step_off = Millis(500), Rule::P1),
    // A guard that falls back takes its block for a maneuver beside which nobody crosses.
    (OUTAGE, |setup| if setup.plan.is_none() { setup.guarding = TaskSet::EMPTY }, Rule::P1),
    // A guard is in position wherever it is.
    (DRIFTING, |setup| setup.position.tolerance_cm = 10_000, Rule::P2),
    // It is for a minute after its last position.
    (DRIFTING, |setup| setup.position.lease = Millis(60_000), Rule::P2),
    // A leader with places for two guards asks for one, and lets people cross with one.
    (TEAM, |setup| {
        setup.request.followers = 1;
        if let Some(plan) = &mut setup.plan { plan.followers = 1 }
    }, Rule::P2),
    (WITH_VEHICLE, |setup| if setup.plan.is_some() { trusts_drivers(setup) }, Rule::P3),
    (WITH_VEHICLE, |setup| if setup.plan.is_none() { trusts_drivers(setup) }, Rule::P9),
    // Silence is a promise.
    (ASKED, |setup| setup.traffic.asks = Millis(0), Rule::P10),
    // People have to wait for long.
    (PERSON, |setup| setup.waiting.dwell = Millis(10_000), Rule::P5),
    (PERSON, never_ends, Rule::P6),
];

#[test]
fn each_weakening_breaks_its_rule_alone() {
    for &(street, weaken, rule) in WEAKENINGS {
        let found = explore(street, weaken, &Options::default(), &mut |_| ());
        let broken: Vec<_> = found.broken.iter().map(|(rule, _)| *rule).collect();
        assert_eq!((broken, found.cut_off), (vec![rule], None), "{rule:?}");
    }
    let is_broken = |rule: &Rule| WEAKENINGS.iter().any(|(.., broken)| broken == rule);
    assert!(Rule::ALL.iter().all(is_broken));
}

#[test]
fn a_street_that_is_cut_off_says_so() {
    let stop = Stop::default();
    stop.request();
    let with = |stop, states_max, time_max| Options {
        stop,
        states_max,
        time_max,
        ..Options::default()
    };
    let cases = [
        (with(stop, None, None), CutOff::Stopped),
        (with(Stop::default(), Some(100), None), CutOff::StateLimit),
        (
            with(Stop::default(), None, Some(Duration::ZERO)),
            CutOff::TimeLimit,
        ),
    ];
    for (options, cut_off) in cases {
        let street = Street { hang: 2, ..PERSON };
        let found = explore(street, |_| (), &options, &mut |_| ());
        assert_eq!(found.cut_off, Some(cut_off));
        assert!(found.size.unique_states < 400_000, "{:?}", found.size);
    }
}
