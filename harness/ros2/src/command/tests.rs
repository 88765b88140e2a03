use crossguard_codec::MapPlace;

use super::*;

fn told(command: &Command) -> Result<Event, String> {
    match order(command, &Site::default(), BodyKind::External) {
        Ok(Order::Wish(Wish::Tell(event))) => Ok(event),
        Ok(other) => panic!("{other:?}"),
        Err(error) => Err(error.to_string()),
    }
}

fn of(kind: u8) -> Command {
    Command {
        kind,
        ..Command::default()
    }
}

#[test]
fn a_battery_says_how_full_it_is_if_it_knows() {
    let told = |percentage: f32, power_supply_status: u8| {
        let message = BatteryState {
            percentage,
            power_supply_status,
            ..BatteryState::default()
        };
        match battery(&message) {
            Ok(Order::Battery(battery)) => Ok((battery.state_of_charge, battery.charging)),
            Ok(other) => panic!("{other:?}"),
            Err(error) => Err(error.to_string()),
        }
    };
    assert_eq!(told(0.5, BatteryState::CHARGING), Ok((Some(50.0), true)));
    assert_eq!(told(f32::NAN, 2), Ok((None, false)));
    assert!(told(55.0, 2).unwrap_err().contains("0 to 1"));
}

#[test]
fn a_detection_says_how_many_how_urgent_and_what_for() {
    let detect = Command {
        followers: 2,
        urgency: Command::URGENCY_HIGH,
        tasks: vec![Task {
            r#type: Task::BLOCK,
        }],
        ..of(Command::DETECT)
    };
    let Ok(Event::PedestrianDetected(request)) = told(&detect) else {
        panic!()
    };
    assert_eq!((request.followers, request.urgency), (2, Urgency::High));
    assert_eq!(request.tasks, TaskSet::of(&[TaskType::BLOCK]));
    let plain = Command {
        followers: 1,
        ..of(Command::DETECT)
    };
    let Ok(Event::PedestrianDetected(request)) = told(&plain) else {
        panic!()
    };
    let tasks = TaskSet::of(&[TaskType::INITIAL_POS, TaskType::MOVE]);
    assert_eq!(request.tasks, tasks);
}

#[test]
fn the_end_of_a_maneuver_names_it() {
    let session = Session {
        leader: 1,
        boot: 2,
        count: 3,
    };
    let done = Command {
        session,
        request: 4,
        ..of(Command::DONE)
    };
    let id = ManeuverId {
        session: session_id(session),
        request: RequestId(4),
    };
    assert_eq!(told(&done), Ok(Event::ManeuverCompleted(id)));
    let fail = Command {
        kind: Command::FAIL,
        ..done
    };
    assert_eq!(told(&fail), Ok(Event::ManeuverFailed(id)));
    let there = Command {
        kind: Command::IN_POSITION,
        ..fail
    };
    assert_eq!(told(&there), Ok(Event::InPosition(id)));
}

#[test]
fn who_moves_a_body_says_that_it_has_finished_and_the_road_is_clear() {
    let clear = of(Command::ROAD_CLEAR);
    assert_eq!(told(&clear), Ok(Event::RoadClear));
    let simulated = order(&clear, &Site::default(), BodyKind::Configured);
    assert!(matches!(simulated, Ok(Order::Clear)));
}

#[test]
fn a_detection_is_at_the_crossing_of_the_site_unless_it_names_another() {
    let site = Site {
        crossing: protocol::Place(7),
        ..Site::default()
    };
    for (place, expected) in [(0, 7), (9, 9)] {
        let detect = Command {
            followers: 1,
            place,
            ..of(Command::DETECT)
        };
        let ordered = order(&detect, &site, BodyKind::Configured);
        let Ok(Order::Wish(Wish::Tell(Event::PedestrianDetected(request)))) = ordered else {
            panic!("{ordered:?}")
        };
        assert_eq!(request.place, protocol::Place(expected));
    }
}

#[test]
fn an_order_may_lead_somewhere_at_some_speed() {
    let command = Command {
        follower: 2,
        task: Task { r#type: Task::MOVE },
        has_target: true,
        target: Point {
            x: 1.0,
            y: 8.0,
            z: 0.0,
        },
        maximum_speed: 0.4,
        ..of(Command::ORDER)
    };
    let site = Site::default();
    let Ok(Order::Wish(Wish::Order {
        follower,
        task,
        parameters,
    })) = order(&command, &site, BodyKind::Configured)
    else {
        panic!()
    };
    assert_eq!((follower, task), (StationId(2), TaskType::MOVE));
    assert_eq!(parameters.target, Some(site.target(Place::new(1.0, 8.0))));
    assert_eq!(parameters.maximum_speed, Some(0.4));
}

#[test]
fn an_order_names_the_place_of_the_map_that_it_says_or_that_of_the_site() {
    let of_site = MapPlace::Intersection {
        region: Some(276),
        id: 4_711,
    };
    let site = Site {
        map_place: Some(of_site),
        ..Site::default()
    };
    let segment = MapPlace::RoadSegment {
        region: None,
        id: 12,
    };
    for (text, expected) in [("", of_site), ("segment 12", segment)] {
        let command = Command {
            task: Task { r#type: Task::MOVE },
            map_place: text.to_owned(),
            ..of(Command::ORDER)
        };
        let ordered = order(&command, &site, BodyKind::Configured);
        let Ok(Order::Wish(Wish::Order { parameters, .. })) = ordered else {
            panic!("{ordered:?}")
        };
        assert_eq!(parameters.map_place, Some(expected));
    }
}

#[test]
fn a_robot_can_be_told_what_it_shows() {
    let show = Command {
        to_vehicles: Command::SIGNAL_STOP,
        to_pedestrians: Command::SIGNAL_CAUTION,
        signal_means: Command::MEANS_GESTURE | Command::MEANS_SPEECH,
        ..of(Command::SHOW)
    };
    let ordered = order(&show, &Site::default(), BodyKind::Configured);
    let Ok(Order::Show(signals)) = ordered else {
        panic!("{ordered:?}")
    };
    let expected = SignalsShown {
        to_vehicles: PublicSignal::Stop,
        to_pedestrians: PublicSignal::Caution,
        means: SignalMeans::GESTURE.union(SignalMeans::SPEECH),
    };
    assert_eq!(signals, expected);
}

#[test]
fn a_robot_can_be_told_its_job_and_what_it_serves() {
    let said = |command: &Command| order(command, &Site::default(), BodyKind::Configured);
    let job = |job_role| {
        said(&Command {
            job_role,
            ..of(Command::JOB)
        })
    };
    assert!(matches!(
        job(Command::ROLE_PATROL),
        Ok(Order::Job(JobRole::Patrol))
    ));
    assert_eq!(
        job(7).unwrap_err().to_string(),
        "job_role 7: 0 to 6 are possible"
    );
    let serve = |text: &str| {
        said(&Command {
            map_place: text.to_owned(),
            ..of(Command::SERVE)
        })
    };
    let segment = MapPlace::RoadSegment {
        region: Some(276),
        id: 12,
    };
    let served = serve("segment 276:12");
    assert!(
        matches!(served, Ok(Order::Serve(Some(place))) if place == segment),
        "{served:?}"
    );
    assert!(matches!(serve(""), Ok(Order::Serve(None))));
    assert!(matches!(serve("road 3"), Err(Refused::MapPlace(..))));
}

fn facing(degrees: f64, place: [f64; 2], at_s: i32) -> PoseStamped {
    let half = degrees.to_radians() / 2.0;
    let mut pose = PoseStamped::default();
    pose.header.stamp.sec = at_s;
    pose.pose.position.x = place[0];
    pose.pose.position.y = place[1];
    (pose.pose.orientation.z, pose.pose.orientation.w) = half.sin_cos();
    pose
}

#[test]
fn a_pose_says_where_the_body_is_where_it_faces_and_how_fast_it_came() {
    for (degrees, heading) in [(0.0, 90.0), (90.0, 0.0), (180.0, 270.0), (-90.0, 180.0)] {
        let told = pose(&facing(degrees, [1.0, 2.0], 5), None).unwrap();
        assert!((told.heading_deg - heading).abs() < 1e-9, "{told:?}");
        assert_eq!((told.place, told.speed_mps), (Place::new(1.0, 2.0), 0.0));
    }
    let (first, next) = (facing(0.0, [0.0, 0.0], 5), facing(0.0, [0.6, 0.8], 6));
    let speed = |to, from| pose(to, Some(from)).unwrap().speed_mps;
    assert!((speed(&next, &first) - 1.0).abs() < 1e-9);
    // What came later was before it.
    assert!(speed(&first, &next) < 1e-9);
    let mut other = first.clone();
    other.header.frame_id = "map".to_owned();
    assert!(matches!(pose(&other, None), Err(Refused::Frame(_))));
    let nowhere = facing(0.0, [f64::NAN, 0.0], 5);
    assert!(matches!(pose(&nowhere, None), Err(Refused::Target { .. })));
    for orientation in [f64::NAN, 0.0] {
        let mut twisted = first.clone();
        twisted.pose.orientation.w = orientation;
        assert!(matches!(pose(&twisted, None), Err(Refused::Orientation)));
    }
}

#[test]
fn what_is_impossible_is_refused_with_what_would_be_possible() {
    let order_of = Command {
        task: Task { r#type: 1 },
        has_target: true,
        ..of(Command::ORDER)
    };
    for (command, answer) in [
        (of(0), "kind 0 is no command"),
        (of(Command::DETECT), "0 followers: 1 to 16 are possible"),
        (
            Command {
                followers: 1,
                urgency: 4,
                ..of(Command::DETECT)
            },
            "urgency 4: 0 to 3 are possible",
        ),
        (
            of(Command::ORDER),
            "task type 255 does not exist, the largest is 15",
        ),
        (
            Command {
                target: Point {
                    x: f64::NAN,
                    y: 0.0,
                    z: 0.0,
                },
                ..order_of.clone()
            },
            "(NaN, 0) is no place: metres on the site are wanted",
        ),
        (
            Command {
                maximum_speed: -1.0,
                ..order_of
            },
            "-1 is no speed: m/s, or 0 for the follower's own limit, are wanted",
        ),
        (
            Command {
                to_pedestrians: Command::SIGNAL_GO,
                ..of(Command::SHOW)
            },
            "go is not shown to pedestrians by command; OPEN_CORRIDOR opens the corridor",
        ),
        (
            Command {
                to_vehicles: 4,
                ..of(Command::SHOW)
            },
            "signal 4: 0 to 3 are possible",
        ),
        (
            Command {
                signal_means: 16,
                ..of(Command::SHOW)
            },
            "signal_means 16: a sum of 1, 2, 4 and 8 is wanted",
        ),
        (
            Command {
                availability: 6,
                ..of(Command::SET_AVAILABILITY)
            },
            "availability 6: 0 to 5 are possible",
        ),
    ] {
        assert_eq!(told(&command), Err(answer.to_owned()));
    }
    let ghost = Person {
        confidence: f32::NAN,
        ..Person::default()
    };
    assert!(person(&ghost).is_err());
    assert!(person(&Person { kind: 9, ..ghost }).is_err());
    assert!(person(&Person::default()).is_ok());
}
