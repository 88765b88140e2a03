//! A device that hears robots, and what it sends.

use proptest::prelude::*;

use super::*;

const HEAD: u32 = 9;

fn walking(east_m: f64) -> Motion {
    Motion {
        position_m: [east_m, 0.0],
        speed_mps: 1.4,
        heading_deg: 90.0,
    }
}

fn standing() -> Motion {
    Motion::default()
}

fn device(rule: VamRule) -> VruStation {
    VruStation::new(rule, Understands::Ram, Suppression::Strict)
}

fn loose(rule: VamRule) -> VruStation {
    VruStation::new(rule, Understands::Ram, Suppression::Loose)
}

/// A device that knows cluster VAM alone.
fn unmodified(rule: VamRule) -> VruStation {
    VruStation::new(rule, Understands::ClusterVam, Suppression::Strict)
}

fn circle(radius_m: f64) -> Area {
    Area::Circle {
        center: [0.0, 0.0],
        radius_m,
    }
}

fn announcement(by: Understands, area: &Area) -> Announcement {
    Announcement {
        head: HEAD,
        by,
        cluster: Some(Announced {
            id: Some(7),
            area: area.clone(),
            cardinality: 3,
        }),
        velocity_mps: Some([0.0, 0.0]),
        ended: None,
    }
}

/// A robot's RAM with a cluster of this radius that stands around the origin.
fn ram(radius_m: f64) -> Announcement {
    announcement(Understands::Ram, &circle(radius_m))
}

fn over(announcement: &Announcement) -> Announcement {
    Announcement {
        cluster: None,
        ..announcement.clone()
    }
}

const fn leaves(reason: LeaveReason) -> Operation {
    Operation::Leave { id: 7, reason }
}

/// The head of the cluster that a device is in.
const fn head(station: &VruStation) -> Option<u32> {
    match &station.state {
        State::Passive(membership) => Some(membership.head),
        _ => None,
    }
}

/// When a device that hears nothing sends, in ms, over ten seconds in this motion.
fn sent(rule: VamRule, motion: impl Fn(u64) -> Motion, interval_min_ms: u64) -> Vec<u64> {
    let mut station = device(rule);
    let mut is_sent = |&now_ms: &u64| {
        station
            .poll(now_ms, &motion(now_ms), interval_min_ms)
            .is_some()
    };
    (0..10_000).step_by(100).filter(&mut is_sent).collect()
}

#[test]
fn a_device_sends_every_five_seconds_or_four_metres_or_at_its_rate() {
    assert_eq!(sent(VamRule::Etsi, |_| standing(), 0), [0, 5_000]);
    // 4 m at 1.4 m/s are 2857 ms.
    assert_eq!(sent(VamRule::Etsi, after, 0), [0, 2_900, 5_800, 8_700]);
    assert_eq!(sent(VamRule::Periodic(200), |_| standing(), 0).len(), 50);
    // Congestion control slows it down.
    assert_eq!(sent(VamRule::Periodic(100), |_| standing(), 400).len(), 25);
}

#[test]
fn the_low_frequency_container_goes_along_every_two_seconds() {
    let mut station = device(VamRule::Periodic(500));
    let mut vam = |now_ms| station.poll(now_ms, &standing(), 0);
    let times = (0..4_001).step_by(500);
    let with = times.filter(|&now_ms| vam(now_ms).is_some_and(|vam| vam.low_frequency));
    assert_eq!(with.collect::<Vec<_>>(), [0, 2_000, 4_000]);
}

#[test]
fn a_covered_device_is_silent_until_its_robot_is_lost() {
    let mut station = device(VamRule::Periodic(100));
    assert!(station.poll(0, &standing(), 0).is_some());
    station.hear(50, &standing(), &ram(5.0));
    for now_ms in (100..2_050).step_by(50) {
        assert_eq!(station.poll(now_ms, &standing(), 0), None);
    }
    let vam = station.poll(2_050, &standing(), 0).unwrap();
    assert_eq!(vam.operation, Some(leaves(LeaveReason::ClusterLeaderLost)));
    assert!(vam.low_frequency);
    let mut operation = |now_ms| station.poll(now_ms, &standing(), 0).unwrap().operation;
    assert!(operation(3_000).is_some());
    assert_eq!(operation(3_100), None);
}

#[test]
fn by_the_loose_rule_a_device_that_walks_out_resumes_three_metres_outside() {
    let mut station = loose(VamRule::Etsi);
    station.hear(0, &walking(4.0), &ram(5.0));
    assert_eq!(station.poll(100, &walking(7.9), 0), None);
    station.hear(150, &walking(7.9), &ram(5.0));
    let vam = station.poll(200, &walking(8.1), 0).unwrap();
    assert_eq!(
        vam.operation,
        Some(leaves(LeaveReason::OutOfClusterBoundingBox))
    );
}

#[test]
fn a_robot_without_a_cluster_releases_its_devices_and_nobody_elses() {
    let mut station = device(VamRule::Etsi);
    station.hear(0, &standing(), &ram(5.0));
    let none = |head| Announcement {
        head,
        velocity_mps: None,
        ..over(&ram(5.0))
    };
    station.hear(100, &standing(), &none(HEAD + 1));
    assert!(station.is_passive());
    station.hear(200, &standing(), &none(HEAD));
    assert!(station.poll(200, &standing(), 0).is_some());
}

#[test]
fn a_device_goes_over_to_the_next_robot_without_a_vam() {
    let mut station = loose(VamRule::Periodic(100));
    let near = |east_m: f64| Area::around(&[[east_m, 0.0]], 5.0).unwrap();
    let (first, second) = (near(0.0), near(6.0));
    let other = |area| Announcement {
        head: HEAD + 1,
        ..announcement(Understands::Ram, area)
    };
    station.hear(0, &walking(3.0), &announcement(Understands::Ram, &first));
    station.hear(100, &walking(3.0), &other(&second));
    assert_eq!(head(&station), Some(HEAD));
    station.hear(1_500, &walking(5.5), &other(&second));
    assert_eq!(head(&station), Some(HEAD + 1));
    for now_ms in (1_600..3_400).step_by(100) {
        assert_eq!(station.poll(now_ms, &walking(6.0), 0), None);
    }
    // The first one does not concern it any more.
    station.hear(3_400, &walking(6.0), &over(&ram(5.0)));
    assert!(station.is_passive());
}

#[test]
fn who_leaves_says_whether_its_head_was_silent_or_did_not_count_it() {
    let left = |heard_again: bool| {
        let mut station = loose(VamRule::Periodic(100));
        let elsewhere = Area::around(&[[30.0, 0.0]], 2.0).unwrap();
        station.hear(0, &standing(), &ram(5.0));
        if heard_again {
            let elsewhere = announcement(Understands::Ram, &elsewhere);
            station.hear(1_000, &standing(), &elsewhere);
        }
        assert_eq!(station.poll(1_900, &standing(), 0), None);
        station.poll(2_000, &standing(), 0).unwrap().operation
    };
    assert_eq!(left(false), Some(leaves(LeaveReason::ClusterLeaderLost)));
    assert_eq!(
        left(true),
        Some(leaves(LeaveReason::OutOfClusterBoundingBox))
    );
}

#[test]
fn an_unmodified_device_is_not_in_another_cluster_of_its_head() {
    let mut station = unmodified(VamRule::Etsi);
    let mut vam = announcement(Understands::ClusterVam, &circle(5.0));
    assert!(station.poll(0, &standing(), 0).is_some());
    station.hear(0, &standing(), &vam);
    vam.cluster.as_mut().unwrap().id = Some(8);
    station.hear(100, &standing(), &vam);
    let due = station.poll(100, &standing(), 0).unwrap();
    let (id, at_ms) = (7, 3_000);
    assert_eq!(due.operation, Some(Operation::Join { id, at_ms }));
}

#[test]
fn an_unmodified_device_joins_by_the_rules_of_etsi() {
    let mut station = unmodified(VamRule::Periodic(500));
    // It does not understand the first, and does not move as the second; the third is full.
    let vam = announcement(Understands::ClusterVam, &circle(5.0));
    let mut full = vam.clone();
    full.cluster.as_mut().unwrap().cardinality = SIZE_MAX;
    station.hear(0, &standing(), &ram(5.0));
    station.hear(0, &walking(0.0), &vam);
    station.hear(0, &standing(), &full);
    assert_eq!(station.state, State::Standalone);
    station.hear(0, &standing(), &vam);
    let mut joins = 0;
    for now_ms in (0..3_000).step_by(100) {
        if now_ms % 500 == 0 {
            station.hear(now_ms, &standing(), &vam);
        }
        if let Some(due) = station.poll(now_ms, &standing(), 0) {
            let (id, at_ms) = (7, 3_000);
            assert_eq!(due.operation, Some(Operation::Join { id, at_ms }));
            joins += 1;
        }
    }
    assert_eq!(joins, 6);
    assert_eq!(station.poll(3_000, &standing(), 0), None);
    station.hear(3_400, &standing(), &vam);
    assert_eq!(station.poll(3_600, &standing(), 0), None);
}

#[test]
fn an_unmodified_device_that_is_not_confirmed_gives_up() {
    let mut station = unmodified(VamRule::Etsi);
    let vam = announcement(Understands::ClusterVam, &circle(5.0));
    station.hear(0, &standing(), &vam);
    station.hear(1_900, &standing(), &vam);
    station.poll(3_000, &standing(), 0);
    assert!(station.is_passive());
    let due = station.poll(3_500, &standing(), 0).unwrap();
    assert_eq!(due.operation, Some(leaves(LeaveReason::FailedJoin)));
}

/// A cluster that walks to the east at 1.4 m/s, around where somebody was at `now_ms` who began at the origin.
fn walking_cluster(area: &Area) -> Announcement {
    let mut announced = announcement(Understands::Ram, area);
    announced.velocity_mps = Some([1.4, 0.0]);
    announced
}

#[expect(clippy::cast_precision_loss, reason = "a few seconds")]
fn after(now_ms: u64) -> Motion {
    walking(now_ms as f64 * 1.4e-3)
}

#[test]
fn by_the_strict_rule_a_device_walks_on_silently_with_its_cluster() {
    let mut station = device(VamRule::Periodic(100));
    station.hear(0, &after(0), &walking_cluster(&circle(1.0)));
    // It is 2.7 m from where it was announced; the shape went along.
    for now_ms in (100..2_000).step_by(100) {
        assert_eq!(station.poll(now_ms, &after(now_ms), 0), None, "{now_ms}");
    }
    assert!(station.poll(2_000, &after(2_000), 0).is_some());
}

#[test]
fn who_moves_otherwise_than_a_cluster_that_covers_it_was_not_perceived() {
    let cluster = walking_cluster(&circle(5.0));
    let is_silent = |motion: &Motion, announced: &Announcement| {
        let mut station = device(VamRule::Etsi);
        station.hear(0, motion, announced);
        station.is_passive()
    };
    let north = Motion {
        heading_deg: 0.0,
        ..walking(0.0)
    };
    let cycling = Motion {
        speed_mps: 5.0,
        ..walking(0.0)
    };
    for motion in [standing(), north, cycling] {
        assert!(!is_silent(&motion, &cluster), "{motion:?}");
    }
    assert!(is_silent(&walking(0.0), &cluster));
    // Nor does it know that when the cluster does not say how it moves.
    let mut unknown = cluster;
    unknown.velocity_mps = None;
    assert!(!is_silent(&walking(0.0), &unknown));
}

#[test]
fn who_leaves_a_cluster_resumes_at_once_and_says_why() {
    let left = |motion: Motion| {
        let mut station = device(VamRule::Etsi);
        station.hear(0, &after(0), &walking_cluster(&circle(1.0)));
        station.poll(100, &motion, 0).unwrap().operation
    };
    let walks_out = left(walking(1.3));
    assert_eq!(
        walks_out,
        Some(leaves(LeaveReason::OutOfClusterBoundingBox))
    );
    let turned = Motion {
        heading_deg: 45.0,
        ..after(100)
    };
    assert_eq!(
        left(turned),
        Some(leaves(LeaveReason::OutOfClusterSpeedRange))
    );
}

#[test]
fn who_is_no_longer_in_its_own_cluster_resumes_when_it_hears_that() {
    let mut station = device(VamRule::Etsi);
    station.hear(0, &standing(), &ram(1.0));
    let own = announcement(Understands::Ram, &Area::around(&[[9.0, 0.0]], 1.0).unwrap());
    let mut other = own.clone();
    other.cluster.as_mut().unwrap().id = Some(8);
    // Another cluster of the same robot says nothing of this one.
    station.hear(500, &standing(), &other);
    assert_eq!(station.poll(600, &standing(), 0), None);
    station.hear(700, &standing(), &own);
    assert!(station.poll(700, &standing(), 0).is_some());
}

#[test]
fn a_cluster_that_is_over_releases_its_own_devices_at_once() {
    for by in [Understands::Ram, Understands::ClusterVam] {
        let mut station = VruStation::new(VamRule::Etsi, by, Suppression::Strict);
        let there = announcement(by, &circle(5.0));
        let over = |id| Announcement {
            ended: Some(id),
            ..over(&there)
        };
        for now_ms in (0..=3_400).step_by(100) {
            station.poll(now_ms, &standing(), 0);
            station.hear(now_ms, &standing(), &there);
        }
        assert!(station.is_passive(), "{by:?}");
        station.hear(3_500, &standing(), &over(8));
        assert!(station.is_passive());
        station.hear(3_600, &standing(), &over(7));
        // By its rule, it would send 5 s after the last VAM.
        let vam = station.poll(3_600, &standing(), 0).unwrap();
        assert_eq!(
            vam.operation,
            Some(leaves(LeaveReason::ClusterDisbandedByLeader))
        );
    }
}

proptest! {
    /// Whatever is announced, by the loose rule: a device is silent only while it was covered within the last
    /// 2 s; and it sends within 5 s otherwise.
    #[test]
    fn silence_has_a_reason(
        steps in proptest::collection::vec((0_u8..4, -12.0..12.0_f64, 1.0..6.0_f64), 1..300)
    ) {
        let mut station = loose(VamRule::Etsi);
        let (mut covered_ms, mut last_ms, mut now_ms) = (None, 0_u64, 0_u64);
        let mut east_m = 0.0;
        for (what, to_m, radius_m) in steps {
            now_ms += 100;
            east_m += (to_m - east_m) * 0.1;
            if what == 0 {
                station.hear(now_ms, &walking(east_m), &ram(radius_m));
                if circle(radius_m).contains([east_m, 0.0]) {
                    covered_ms = Some(now_ms);
                    prop_assert!(station.is_passive());
                }
            }
            if station.poll(now_ms, &walking(east_m), 0).is_some() {
                last_ms = now_ms;
            }
            if station.is_passive() {
                prop_assert!(covered_ms.is_some_and(|covered| now_ms - covered < CONTINUITY_MS));
                last_ms = now_ms;
            }
            prop_assert!(now_ms - last_ms <= INTERVAL_MAX_MS);
        }
    }

    /// Whatever is announced, by the strict rule: a device is silent only inside of the shape that it heard of
    /// last as its own, moved with the cluster, and in the motion of that cluster.
    #[test]
    fn strict_silence_is_a_match_of_place_and_motion(
        steps in proptest::collection::vec((0_u8..4, -3.0..3.0_f64, 0.5..3.0_f64, 0.0..360.0_f64), 1..200)
    ) {
        let mut station = device(VamRule::Etsi);
        let mut matched: Option<(u64, f64)> = None;
        let mut now_ms = 0_u64;
        for (what, offset_m, radius_m, heading_deg) in steps {
            now_ms += 100;
            let steady = after(now_ms);
            let motion = match what {
                0 => Motion { heading_deg, ..steady },
                _ => Motion { position_m: [steady.position_m[0] + offset_m, 0.0], ..steady },
            };
            if what == 1 {
                let center = steady.position_m;
                let area = Area::Circle { center, radius_m };
                station.hear(now_ms, &motion, &walking_cluster(&area));
                if station.is_passive() {
                    matched = Some((now_ms, radius_m));
                }
            }
            station.poll(now_ms, &motion, 0);
            if station.is_passive() {
                let (since_ms, radius_m) = matched.unwrap();
                prop_assert!(now_ms - since_ms < CONTINUITY_MS);
                let off_m = (motion.position_m[0] - steady.position_m[0]).abs();
                prop_assert!(off_m <= radius_m + 1e-6, "{off_m}");
                prop_assert!((motion.heading_deg - 90.0).abs() <= 20.0 + 1e-6, "{motion:?}");
            }
        }
    }
}
