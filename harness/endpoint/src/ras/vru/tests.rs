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

fn circle(radius_m: f64) -> Area {
    Area::Circle {
        center: [0.0, 0.0],
        radius_m,
    }
}

fn announcement(by: Understands, area: &Area) -> Announcement<'_> {
    Announcement {
        head: HEAD,
        by,
        cluster: Some(AnnouncedCluster {
            id: Some(7),
            area,
            cardinality: 3,
            velocity_mps: (by == Understands::ClusterVam).then_some([0.0, 0.0]),
        }),
    }
}

/// When a device that hears nothing sends, in ms, over ten seconds in this motion.
fn sent(rule: VamRule, motion: impl Fn(u64) -> Motion) -> Vec<u64> {
    let mut station = VruStation::new(rule, Understands::Ram);
    let times = (0..10_000).step_by(100);
    times
        .filter(|&now_ms| station.poll(now_ms, &motion(now_ms), 0).is_some())
        .collect()
}

#[test]
fn who_stands_sends_every_five_seconds() {
    assert_eq!(sent(VamRule::Etsi, |_| standing()), [0, 5_000]);
}

#[test]
#[expect(clippy::cast_precision_loss, reason = "a few seconds")]
fn who_walks_sends_every_four_metres() {
    // 4 m at 1.4 m/s are 2857 ms.
    let times = sent(VamRule::Etsi, |now_ms| walking(now_ms as f64 * 1.4e-3));
    assert_eq!(times, [0, 2_900, 5_800, 8_700]);
}

#[test]
fn a_periodic_device_sends_at_its_rate_and_congestion_control_slows_it_down() {
    assert_eq!(sent(VamRule::Periodic(200), |_| standing()).len(), 50);
    let mut station = VruStation::new(VamRule::Periodic(100), Understands::Ram);
    let times = (0..10_000).step_by(100);
    let sent = times.filter(|&now_ms| station.poll(now_ms, &standing(), 400).is_some());
    assert_eq!(sent.count(), 25);
}

#[test]
fn the_low_frequency_container_goes_along_every_two_seconds() {
    let mut station = VruStation::new(VamRule::Periodic(500), Understands::Ram);
    let times = (0..4_001).step_by(500);
    let with: Vec<u64> = times
        .filter(|&now_ms| {
            station
                .poll(now_ms, &standing(), 0)
                .is_some_and(|vam| vam.low_frequency)
        })
        .collect();
    assert_eq!(with, [0, 2_000, 4_000]);
}

#[test]
fn a_covered_device_is_silent_until_its_robot_is_lost() {
    let mut station = VruStation::new(VamRule::Periodic(100), Understands::Ram);
    let area = circle(5.0);
    assert!(station.poll(0, &standing(), 0).is_some());
    let heard = station.hear(50, &standing(), &announcement(Understands::Ram, &area));
    assert_eq!(heard, Reaction::Suspends);
    for now_ms in (100..2_050).step_by(50) {
        assert_eq!(station.poll(now_ms, &standing(), 0), None);
    }
    let vam = station.poll(2_050, &standing(), 0).unwrap();
    assert_eq!(vam.trigger, VamTrigger::Leave);
    let reason = LeaveReason::ClusterLeaderLost;
    assert_eq!(vam.operation, Some(Operation::Leave { id: 7, reason }));
    assert!(vam.low_frequency);
    assert!(
        station
            .poll(3_000, &standing(), 0)
            .unwrap()
            .operation
            .is_some()
    );
    assert_eq!(station.poll(3_100, &standing(), 0).unwrap().operation, None);
}

#[test]
fn a_device_that_walks_out_resumes_three_metres_outside() {
    let mut station = VruStation::new(VamRule::Etsi, Understands::Ram);
    let area = circle(5.0);
    station.hear(0, &walking(4.0), &announcement(Understands::Ram, &area));
    assert_eq!(station.poll(100, &walking(7.9), 0), None);
    let outside = station.hear(150, &walking(7.9), &announcement(Understands::Ram, &area));
    assert_eq!(outside, Reaction::Outside);
    let vam = station.poll(200, &walking(8.1), 0).unwrap();
    let reason = LeaveReason::OutOfClusterBoundingBox;
    assert_eq!(vam.operation, Some(Operation::Leave { id: 7, reason }));
}

#[test]
fn a_robot_without_a_cluster_releases_its_devices_and_nobody_elses() {
    let mut station = VruStation::new(VamRule::Etsi, Understands::Ram);
    let area = circle(5.0);
    station.hear(0, &standing(), &announcement(Understands::Ram, &area));
    let none = |head| Announcement {
        head,
        by: Understands::Ram,
        cluster: None,
    };
    assert_eq!(
        station.hear(100, &standing(), &none(HEAD + 1)),
        Reaction::InAnother
    );
    assert!(station.is_passive());
    assert_eq!(
        station.hear(200, &standing(), &none(HEAD)),
        Reaction::Resumes
    );
    assert!(station.poll(200, &standing(), 0).is_some());
}

#[test]
fn a_device_goes_over_to_the_next_robot_without_a_vam() {
    let mut station = VruStation::new(VamRule::Periodic(100), Understands::Ram);
    let near = |east_m: f64| Area::around(&[[east_m, 0.0]], 5.0).unwrap();
    let (first, second) = (near(0.0), near(6.0));
    let other = |area| Announcement {
        head: HEAD + 1,
        ..announcement(Understands::Ram, area)
    };
    station.hear(0, &walking(3.0), &announcement(Understands::Ram, &first));
    let in_both = station.hear(100, &walking(3.0), &other(&second));
    assert_eq!(in_both, Reaction::InAnother);
    let in_one = station.hear(1_500, &walking(5.5), &other(&second));
    assert_eq!(in_one, Reaction::GoesOn);
    for now_ms in (1_600..3_400).step_by(100) {
        assert_eq!(station.poll(now_ms, &walking(6.0), 0), None);
    }
    // The first one does not concern it any more.
    let gone = Announcement {
        cluster: None,
        ..announcement(Understands::Ram, &first)
    };
    assert_eq!(
        station.hear(3_400, &walking(6.0), &gone),
        Reaction::InAnother
    );
    assert!(station.is_passive());
}

#[test]
fn who_leaves_says_whether_its_head_was_silent_or_did_not_count_it() {
    let left = |heard_again: bool| {
        let mut station = VruStation::new(VamRule::Periodic(100), Understands::Ram);
        let (area, elsewhere) = (circle(5.0), Area::around(&[[30.0, 0.0]], 2.0).unwrap());
        station.hear(0, &standing(), &announcement(Understands::Ram, &area));
        if heard_again {
            let outside = station.hear(
                1_000,
                &standing(),
                &announcement(Understands::Ram, &elsewhere),
            );
            assert_eq!(outside, Reaction::Outside);
        }
        assert_eq!(station.poll(1_900, &standing(), 0), None);
        station.poll(2_000, &standing(), 0).unwrap().operation
    };
    let id = 7;
    let reason = LeaveReason::ClusterLeaderLost;
    assert_eq!(left(false), Some(Operation::Leave { id, reason }));
    let reason = LeaveReason::OutOfClusterBoundingBox;
    assert_eq!(left(true), Some(Operation::Leave { id, reason }));
}

#[test]
fn an_unmodified_device_is_not_in_another_cluster_of_its_head() {
    let mut station = VruStation::new(VamRule::Etsi, Understands::ClusterVam);
    let area = circle(5.0);
    let vam = announcement(Understands::ClusterVam, &area);
    assert_eq!(station.hear(0, &standing(), &vam), Reaction::Joins);
    let mut split_off = vam.clone();
    split_off.cluster.as_mut().unwrap().id = Some(8);
    assert_eq!(
        station.hear(100, &standing(), &split_off),
        Reaction::InAnother
    );
}

#[test]
fn an_unmodified_device_joins_by_the_rules_of_etsi() {
    let mut station = VruStation::new(VamRule::Periodic(500), Understands::ClusterVam);
    let area = circle(5.0);
    let ram = station.hear(0, &standing(), &announcement(Understands::Ram, &area));
    assert_eq!(ram, Reaction::NotUnderstood);
    let vam = announcement(Understands::ClusterVam, &area);
    let walks = station.hear(0, &walking(0.0), &vam);
    assert_eq!(walks, Reaction::VelocityDiffers);
    assert_eq!(station.hear(0, &standing(), &vam), Reaction::Joins);
    let mut joins = 0;
    for now_ms in (0..3_000).step_by(100) {
        if now_ms % 500 == 0 {
            assert_eq!(station.hear(now_ms, &standing(), &vam), Reaction::GoesOn);
        }
        if let Some(due) = station.poll(now_ms, &standing(), 0) {
            assert_eq!(
                due.operation,
                Some(Operation::Join {
                    id: 7,
                    at_ms: 3_000
                })
            );
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
    let mut station = VruStation::new(VamRule::Etsi, Understands::ClusterVam);
    let area = circle(5.0);
    let vam = announcement(Understands::ClusterVam, &area);
    station.hear(0, &standing(), &vam);
    station.hear(1_900, &standing(), &vam);
    station.poll(3_000, &standing(), 0);
    assert!(station.is_passive());
    let due = station.poll(3_500, &standing(), 0).unwrap();
    let reason = LeaveReason::FailedJoin;
    assert_eq!(due.operation, Some(Operation::Leave { id: 7, reason }));
}

proptest! {
    /// Whatever is announced: a device is silent only while it was covered within the last 2 s and
    /// is not further than 3 m from where it was covered; and it sends within 5 s otherwise.
    #[test]
    fn silence_has_a_reason(
        steps in proptest::collection::vec((0_u8..4, -12.0..12.0_f64, 1.0..6.0_f64), 1..300)
    ) {
        let mut station = VruStation::new(VamRule::Etsi, Understands::Ram);
        let (mut covered_ms, mut last_ms, mut now_ms) = (None, 0_u64, 0_u64);
        let mut east_m = 0.0;
        for (what, to_m, radius_m) in steps {
            now_ms += 100;
            east_m += (to_m - east_m) * 0.1;
            let area = circle(radius_m);
            if what == 0 {
                let reaction = station.hear(now_ms, &walking(east_m), &announcement(Understands::Ram, &area));
                if area.contains([east_m, 0.0]) {
                    covered_ms = Some(now_ms);
                    prop_assert!(matches!(reaction, Reaction::Suspends | Reaction::GoesOn));
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
}
