//! Members, and the clusters that they belong to.

use proptest::prelude::*;

use super::*;

fn pedestrian(id: u32, east_m: f64, north_m: f64) -> PerceivedVru {
    PerceivedVru {
        velocity_mps: [1.0, 0.0],
        confidence: 0.9,
        ..PerceivedVru::pedestrian(id, [east_m, north_m])
    }
}

fn perceiving(perceived: &[PerceivedVru]) -> Clustering {
    let mut clustering = Clustering::new(Settings::default(), 1);
    see(&mut clustering, 0, perceived);
    clustering
}

/// The robot, which stands at the origin, perceives these.
fn see(clustering: &mut Clustering, now_ms: u64, perceived: &[PerceivedVru]) {
    clustering.perceive(now_ms, [0.0, 0.0], perceived);
}

#[test]
fn a_vehicle_is_in_no_cluster_and_a_wheelchair_user_has_the_profile_that_etsi_gives() {
    let of = |class, east_m| PerceivedVru {
        class,
        ..pedestrian(7, east_m, 4.0)
    };
    let vehicle = perceiving(&[of(VruClass::Vehicle, 3.0)]);
    assert!(vehicle.clusters().is_empty());
    let clusters = perceiving(&[of(VruClass::WheelchairUser, 3.0)]).clusters();
    assert_eq!(clusters[0].profiles, VruClass::Bicyclist.bit());
}

#[test]
fn one_person_is_a_cluster() {
    let clusters = perceiving(&[pedestrian(7, 3.0, 4.0)]).clusters();
    let [cluster] = &clusters[..] else {
        panic!("{clusters:?}")
    };
    let bit = VruClass::Pedestrian.bit();
    assert_eq!((cluster.cardinality, cluster.profiles), (1, bit));
    assert!(distance_m(cluster.velocity_mps, [1.0, 0.0]) < 1e-9);
}

#[test]
fn the_edge_has_hysteresis_in_distance_and_confidence() {
    let mut clustering = perceiving(&[pedestrian(1, 15.5, 0.0)]);
    assert_eq!(clustering.members(), 0);
    let by_distance = [
        (100, 14.9, 1),
        (200, 15.9, 1),
        (300, 16.1, 0),
        (400, 15.9, 0),
    ];
    for (now_ms, east_m, members) in by_distance {
        see(&mut clustering, now_ms, &[pedestrian(1, east_m, 0.0)]);
        assert_eq!(clustering.members(), members, "{east_m} m");
    }
    let mut unsure = pedestrian(2, 5.0, 0.0);
    let by_confidence = [(500, 0.4, 0), (600, 0.6, 1), (700, 0.3, 1), (800, 0.2, 0)];
    for (now_ms, confidence, members) in by_confidence {
        unsure.confidence = confidence;
        see(&mut clustering, now_ms, &[unsure]);
        assert_eq!(clustering.members(), members, "{confidence}");
    }
}

#[test]
fn who_is_hidden_for_a_moment_is_remembered() {
    let mut clustering = perceiving(&[pedestrian(1, 5.0, 0.0)]);
    see(&mut clustering, 999, &[]);
    assert_eq!(clustering.members(), 1);
    see(&mut clustering, 1_000, &[]);
    assert!(clustering.clusters().is_empty());
}

#[test]
fn an_id_stays_while_its_cluster_does_and_is_not_used_again_soon() {
    let mut clustering = perceiving(&[pedestrian(1, 5.0, 0.0)]);
    let id = clustering.clusters()[0].id;
    let both = [pedestrian(1, 6.0, 0.0), pedestrian(2, 2.0, 0.0)];
    see(&mut clustering, 100, &both);
    assert_eq!(clustering.clusters()[0].id, id);
    let far = [1, 2].map(|id| pedestrian(id, 20.0, 0.0));
    for round in 0..100 {
        let now_ms = 2_000 + round * 100;
        see(&mut clustering, now_ms, &far);
        see(&mut clustering, now_ms + 50, &[pedestrian(3, 1.0, 0.0)]);
        assert_ne!(clustering.clusters()[0].id, id);
        see(&mut clustering, now_ms + 60, &[pedestrian(3, 20.0, 0.0)]);
    }
}

#[test]
fn who_is_in_the_zones_of_two_robots_is_announced_by_one() {
    let mut clustering = perceiving(&[pedestrian(1, 3.0, 0.0), pedestrian(2, -9.0, 0.0)]);
    let announced = |clustering: &Clustering| -> u32 {
        let clusters = clustering.clusters();
        clusters.iter().map(|it| u32::from(it.cardinality)).sum()
    };
    assert_eq!(announced(&clustering), 2);
    let area = Area::around(&[[3.0, 0.0]], 1.0).unwrap();
    clustering.leave_to(0, (4, Some(9)), area);
    assert_eq!((announced(&clustering), clustering.members()), (1, 2));
    clustering.take_back(100, 5);
    assert_eq!(announced(&clustering), 1);
    clustering.take_back(100, 4);
    assert_eq!(announced(&clustering), 2);
}

#[test]
fn people_are_taken_back_from_a_silent_robot_and_forgotten_without_a_sensor() {
    let mut clustering = perceiving(&[]);
    let area = Area::around(&[[3.0, 0.0]], 1.0).unwrap();
    clustering.leave_to(0, (4, None), area);
    see(&mut clustering, 1_500, &[pedestrian(1, 3.0, 0.0)]);
    assert_eq!(clustering.count(), 0);
    clustering.elapse(1_999);
    assert_eq!(clustering.count(), 0);
    clustering.elapse(2_000);
    assert_eq!(clustering.count(), 1);
    clustering.elapse(2_500);
    assert_eq!((clustering.count(), clustering.members()), (0, 0));
}

fn moving(id: u32, position_m: Point, velocity_mps: [f64; 2]) -> PerceivedVru {
    PerceivedVru {
        velocity_mps,
        ..pedestrian(id, position_m[0], position_m[1])
    }
}

/// The members of each cluster by number, the largest cluster first.
fn cardinalities(clustering: &Clustering) -> Vec<u8> {
    let clusters = clustering.clusters();
    let mut counts: Vec<u8> = clusters.iter().map(|it| it.cardinality).collect();
    counts.sort_unstable_by(|a, b| b.cmp(a));
    counts
}

#[test]
fn people_who_walk_north_are_not_merged_with_a_cyclist_who_goes_east() {
    let cyclist = PerceivedVru {
        class: VruClass::Bicyclist,
        ..moving(3, [1.0, 1.0], [5.0, 0.0])
    };
    let north = [0.0, 1.4];
    let people = [
        moving(1, [0.0, 0.0], north),
        moving(2, [2.0, 0.0], north),
        cyclist,
    ];
    let clusters = perceiving(&people).clusters();
    assert_eq!(clusters.len(), 2);
    for cluster in &clusters {
        // Some member moves as the cluster is said to.
        let is_of_one =
            |it: &PerceivedVru| distance_m(it.velocity_mps, cluster.velocity_mps) < 1e-9;
        assert!(people.iter().any(is_of_one), "{cluster:?}");
        let is_on_a_bicycle = cluster.profiles == VruClass::Bicyclist.bit();
        assert_eq!(cluster.cardinality, if is_on_a_bicycle { 1 } else { 2 });
    }
}

#[test]
fn three_people_in_a_row_are_not_a_rectangle_of_14_by_2_metres() {
    let people = [(1, -6.0), (2, 0.0), (3, 6.0)].map(|(id, at)| moving(id, [at, 0.0], [0.0, 0.0]));
    let clusters = perceiving(&people).clusters();
    assert_eq!(clusters.len(), 3);
    // Between them there is room for somebody who nobody has perceived.
    for between in [[-3.0, 0.0], [3.0, 0.0]] {
        assert!(!clusters.iter().any(|it| it.area.contains(between)));
    }
    // A queue is not one cluster because each stands close to the next.
    let queue: Vec<_> = (0..8_u8)
        .map(|i| moving(i.into(), [2.0 * f64::from(i) - 7.0, 0.0], [0.0, 0.0]))
        .collect();
    for cluster in perceiving(&queue).clusters() {
        assert!(cluster.area.size_m2() <= 5.0 * 2.0 + 1e-9, "{cluster:?}");
    }
}

#[test]
fn who_turns_off_leaves_the_cluster_and_the_others_stay() {
    let east = [1.4, 0.0];
    let mut clustering = perceiving(&[moving(1, [0.0, 0.0], east), moving(2, [1.0, 0.0], east)]);
    let id = clustering.clusters()[0].id;
    let turned_off = moving(2, [1.1, 0.0], [0.0, 1.4]);
    see(
        &mut clustering,
        100,
        &[moving(1, [0.1, 0.0], east), turned_off],
    );
    assert_eq!(cardinalities(&clustering), [1, 1]);
    assert!(clustering.clusters().iter().any(|it| it.id == id));
    assert_eq!(clustering.take_ended(), []);
}

/// Both are alike, since one of them is so slow that their directions do not count. The mean is faster, and it is
/// 21 degrees off the other.
#[test]
fn who_does_not_move_as_the_mean_leaves_the_cluster() {
    let way = |id, (east_m, speed_mps, heading_deg): (f64, f64, f64)| {
        let (sine, cosine) = heading_deg.to_radians().sin_cos();
        moving(id, [east_m, 0.0], [speed_mps * sine, speed_mps * cosine])
    };
    let of = |a, b| [way(1, (0.0, 0.425, a)), way(2, (0.8, 0.293, b))];
    let mut clustering = perceiving(&of(130.0, 97.0));
    assert_eq!(cardinalities(&clustering), [2]);
    let [a, b] = of(140.0, 87.0);
    assert!(MATCH.holds(a.velocity_mps, b.velocity_mps));
    see(&mut clustering, 100, &[a, b]);
    assert_eq!(cardinalities(&clustering), [1, 1]);
}

#[test]
fn two_who_meet_and_two_who_part_do_not_change_back_and_forth() {
    let mut clustering = perceiving(&[]);
    let mut apart = |now_ms, distance_m: f64| {
        let people = [(1, 0.0), (2, distance_m)];
        let people = people.map(|(id, east_m)| moving(id, [east_m, 0.0], [0.0, 0.0]));
        see(&mut clustering, now_ms, &people);
        clustering.count()
    };
    let counts = [4.0, 3.1, 3.0, 3.9, 3.1, 4.1, 3.1].map(|it| apart(0, it));
    assert_eq!(counts, [2, 2, 1, 1, 1, 2, 2]);
}

#[test]
fn a_cluster_that_is_over_is_told_with_its_reason() {
    let at = |id, east_m: f64| moving(id, [east_m, 0.0], [0.0, 0.0]);
    let mut clustering = perceiving(&[at(1, 0.0), at(2, 9.0)]);
    let id_at = |clustering: &Clustering, place| {
        let mut clusters = clustering.clusters().into_iter();
        clusters.find(|it| it.area.contains(place)).unwrap().id
    };
    let [first, second] = [0.0, 9.0].map(|east_m| id_at(&clustering, [east_m, 0.0]));
    // They come together: one of the two ids is over, though its member is there.
    see(&mut clustering, 100, &[at(1, 0.0), at(2, 2.0)]);
    let ended = clustering.take_ended();
    let [Ended { id, reason }] = ended[..] else {
        panic!("{ended:?}")
    };
    assert!([first, second].contains(&id));
    assert_eq!(reason, BreakupReason::NotProvided);
    see(&mut clustering, 200, &[at(1, 30.0), at(2, 30.0)]);
    let reason = BreakupReason::ClusteringPurposeCompleted;
    let id = if id == first { second } else { first };
    assert_eq!(clustering.take_ended(), [Ended { id, reason }]);
    assert_eq!(clustering.take_ended(), []);
}

proptest! {
    /// Everywhere in the shape of a cluster somebody who is perceived is near, and every member moves as the
    /// cluster is said to. So who is inside and moves so is a match of a perceived person.
    #[test]
    fn a_cluster_is_close_and_of_one_motion(
        walkers in proptest::collection::vec(
            ((-9.0..9.0_f64, -9.0..9.0_f64), (0.0..2.0_f64, 0.0..360.0_f64)), 1..30),
        moved in proptest::collection::vec((-1.0..1.0_f64, -20.0..20.0_f64), 30),
    ) {
        let person = |id: u32, place: (f64, f64), (speed, heading): (f64, f64)| {
            let (sine, cosine) = heading.to_radians().sin_cos();
            moving(id, [place.0, place.1], [speed * sine, speed * cosine])
        };
        let mut people: Vec<PerceivedVru> =
            (0..).zip(&walkers).map(|(id, &(place, way))| person(id, place, way)).collect();
        let mut clustering = perceiving(&people);
        // Once as they come together, once after they moved on.
        for now_ms in [0, 100] {
            for cluster in clustering.clusters() {
                let members: Vec<&PerceivedVru> = people.iter()
                    .filter(|it| cluster.area.contains(it.position_m)
                        && MATCH.holds(it.velocity_mps, cluster.velocity_mps))
                    .collect();
                prop_assert!(members.len() >= usize::from(cluster.cardinality), "{cluster:?} {members:?}");
                for east in -40..=40 {
                    for north in -40..=40 {
                        let place = [f64::from(east) * 0.25, f64::from(north) * 0.25];
                        if cluster.area.contains(place) {
                            let near_m = members.iter().map(|it| distance_m(it.position_m, place));
                            prop_assert!(near_m.fold(f64::INFINITY, f64::min) <= 4.0, "{cluster:?} {place:?}");
                        }
                    }
                }
            }
            for (id, ((vru, &(place, way)), by)) in people.iter_mut().zip(&walkers).zip(&moved).enumerate() {
                let id = u32::try_from(id).unwrap();
                *vru = person(id, (place.0 + by.0, place.1 - by.0), (way.0, way.1 + by.1));
            }
            see(&mut clustering, now_ms + 100, &people);
        }
    }

    /// Every member is in one cluster's area, no cluster is larger than allowed, and together they
    /// count everybody once.
    #[test]
    fn clusters_divide_the_members(
        places in proptest::collection::vec((-20.0..20.0_f64, -20.0..20.0_f64), 0..90)
    ) {
        let perceived: Vec<PerceivedVru> = (0..).zip(&places)
            .map(|(id, &(x, y))| pedestrian(id, x, y)).collect();
        let clustering = perceiving(&perceived);
        let clusters = clustering.clusters();
        let near: Vec<_> = perceived.iter().filter(|vru| distance_m([0.0, 0.0], vru.position_m) <= 15.0).collect();
        let counted: usize = clusters.iter().map(|it| usize::from(it.cardinality)).sum();
        prop_assert_eq!(counted, near.len());
        prop_assert!(clusters.iter().all(|it| (1..=20).contains(&it.cardinality)));
        for vru in near {
            prop_assert!(clusters.iter().any(|it| it.area.contains(vru.position_m)));
        }
        let ids: BTreeSet<u8> = clusters.iter().map(|it| it.id).collect();
        prop_assert_eq!(ids.len(), clusters.len());
    }

    /// The numbers by which people are tracked have no influence on what is announced.
    #[test]
    fn nothing_persistent_gets_out(
        places in proptest::collection::vec((-12.0..12.0_f64, -9.0..9.0_f64), 1..50), offset in 1_u32..1_000_000
    ) {
        let announced = |offset: u32| {
            let perceived: Vec<PerceivedVru> = (offset..).zip(&places)
                .map(|(id, &(x, y))| pedestrian(id, x, y)).collect();
            perceiving(&perceived).clusters()
        };
        prop_assert_eq!(announced(0), announced(offset));
    }
}
