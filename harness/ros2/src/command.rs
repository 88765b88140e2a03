//! What a message of the application tells the robot.

use crossguard_codec::{Battery, TaskParameters};
use crossguard_endpoint::ras::clustering::{PerceivedVru, VruClass};
use crossguard_protocol::{
    self as protocol, Availability, Event, HelpRequest, MAX_FOLLOWERS, ManeuverId, NoSuchTask,
    RequestId, SessionId, SessionNumber, StationId, TaskSet, TaskType, Unavailability,
    UniqueNumber, Urgency,
};
use crossguard_robot::application::Wish;
use crossguard_robot::body::Pose;
use crossguard_robot::perception::{self, PerceptionError};
use crossguard_robot::runtime::Order;
use crossguard_robot::site::{Place, Site};

use crate::msgs::{Command, Person, Session, Status, Task};
use crate::report::SITE_FRAME;
use crate::robot::BodyKind;
use crate::standard::{BatteryState, Point, PoseStamped, Quaternion, Time};

/// Why a message tells nothing.
#[derive(Debug, thiserror::Error)]
pub enum Refused {
    /// There is no such command.
    #[error("kind {0} is no command")]
    Kind(u8),
    /// This many followers cannot be had.
    #[error("{0} followers: 1 to {MAX_FOLLOWERS} are possible")]
    Followers(u8),
    /// There is no such urgency.
    #[error("urgency {0}: 0 to 3 are possible")]
    Urgency(u8),
    /// There is no such task.
    #[error("{0}")]
    Task(NoSuchTask),
    /// There is no such reason.
    #[error("availability {0}: 0 to 5 are possible")]
    Availability(u8),
    /// No place on the site.
    #[error("({x}, {y}) is no place: metres on the site are wanted")]
    Target {
        /// To the east.
        x: f64,
        /// To the north.
        y: f64,
    },
    /// No speed.
    #[error("{0} is no speed: m/s, or 0 for the follower's own limit, are wanted")]
    Speed(f64),
    /// There is no such kind of people.
    #[error("kind {0} of people: 0 to 5 are possible")]
    People(u8),
    /// Nobody can be like that.
    #[error(transparent)]
    Person(#[from] PerceptionError),
    /// A pose in a frame that is not known here.
    #[error("a pose in the frame '{0}': '{SITE_FRAME}' is wanted")]
    Frame(String),
    /// An orientation that is none.
    #[error("the orientation of the pose is no quaternion")]
    Orientation,
    /// No battery is as full as that.
    #[error("percentage {0} of the battery: 0 to 1, or NaN where it is not known, are wanted")]
    Battery(f32),
    /// The body is a simulated one.
    #[error("the body is simulated; --body external takes poses")]
    Simulated,
    /// There is no robot to tell it.
    #[error("the node is {0}; it takes commands when it is active")]
    NotActive(&'static str),
}

impl Refused {
    /// The cause that it is counted under.
    #[must_use]
    pub const fn cause(&self) -> &'static str {
        match self {
            Self::NotActive(_) => "ros: not active",
            Self::Frame(_) | Self::Orientation | Self::Simulated => "ros: impossible pose",
            Self::Battery(_) => "ros: impossible battery",
            Self::People(_) | Self::Person(_) => "ros: impossible person",
            _ => "ros: impossible command",
        }
    }
}

/// What a command orders a robot with such a body. Places in it are on `site`.
///
/// # Errors
/// Why it orders nothing.
pub fn order(command: &Command, site: &Site, body: BodyKind) -> Result<Order, Refused> {
    let event = match command.kind {
        Command::DETECT => Event::PedestrianDetected(request(command, site)?),
        Command::ORDER => {
            return Ok(Order::Wish(Wish::Order {
                follower: StationId(command.follower),
                task: task(command.task)?,
                parameters: parameters(command, site)?,
            }));
        }
        Command::IN_POSITION => Event::InPosition(maneuver(command)),
        // Of a simulated body the robot itself knows when it has finished its fallback.
        Command::ROAD_CLEAR if body == BodyKind::Simulated => return Ok(Order::Clear),
        Command::ROAD_CLEAR => Event::RoadClear,
        Command::DONE => Event::ManeuverCompleted(maneuver(command)),
        Command::FAIL => Event::ManeuverFailed(maneuver(command)),
        Command::OPEN_CORRIDOR => Event::OpenCorridor,
        Command::CLOSE_CORRIDOR => Event::CloseCorridor,
        Command::TASK_COMPLETED => Event::TaskCompleted,
        Command::LEAVE => Event::LeaveRequested,
        Command::SET_AVAILABILITY => Event::AvailabilityChanged(availability(command)?),
        other => return Err(Refused::Kind(other)),
    };
    Ok(Order::Wish(Wish::Tell(event)))
}

fn request(command: &Command, site: &Site) -> Result<HelpRequest, Refused> {
    let followers = command.followers;
    if !(1..=MAX_FOLLOWERS).contains(&usize::from(followers)) {
        return Err(Refused::Followers(followers));
    }
    let urgency = match command.urgency {
        Command::URGENCY_LOW => Urgency::Low,
        Command::URGENCY_MEDIUM => Urgency::Medium,
        Command::URGENCY_HIGH => Urgency::High,
        Command::URGENCY_EMERGENCY => Urgency::Emergency,
        other => return Err(Refused::Urgency(other)),
    };
    let tasks: Vec<_> = command
        .tasks
        .iter()
        .copied()
        .map(task)
        .collect::<Result<_, _>>()?;
    let tasks = match tasks.as_slice() {
        [] => TaskSet::of(&[TaskType::INITIAL_POS, TaskType::MOVE]),
        tasks => TaskSet::of(tasks),
    };
    Ok(HelpRequest {
        urgency,
        followers,
        tasks,
        place: match protocol::Place(command.place) {
            protocol::Place::UNKNOWN => site.crossing,
            place => place,
        },
    })
}

fn task(task: Task) -> Result<TaskType, Refused> {
    TaskType::try_from(task.r#type).map_err(Refused::Task)
}

fn parameters(command: &Command, site: &Site) -> Result<TaskParameters, Refused> {
    let target = command.has_target.then(|| place(command.target));
    let target = target.transpose()?;
    let speed = command.maximum_speed;
    if !speed.is_finite() || speed < 0.0 {
        return Err(Refused::Speed(speed));
    }
    Ok(TaskParameters {
        target: target.map(|place| site.target(place)),
        maximum_speed: (speed > 0.0).then_some(speed),
        ..TaskParameters::default()
    })
}

/// The speed that a pose may have, in m/s: as much as a RAM can tell.
const SPEED_MAX_MPS: f64 = 163.8;

/// For how long a pose tells how fast the next one was reached, in seconds.
const POSE_PERIOD_MAX_S: f64 = 2.0;

/// Where a message says that the body is, and how fast it came there from the one before.
///
/// # Errors
/// Why it can be nowhere like that.
pub fn pose(message: &PoseStamped, before: Option<&PoseStamped>) -> Result<Pose, Refused> {
    let frame = &message.header.frame_id;
    if !frame.is_empty() && frame != SITE_FRAME {
        return Err(Refused::Frame(frame.clone()));
    }
    let place = place(message.pose.position)?;
    let Quaternion { x, y, z, w } = message.pose.orientation;
    let (sine, cosine) = (2.0 * (w * z + x * y), w * w + x * x - y * y - z * z);
    // None has a norm of 0, and NaN is smaller than nothing.
    if !(sine.hypot(cosine) > 0.0 && sine.is_finite() && cosine.is_finite()) {
        return Err(Refused::Orientation);
    }
    let speed = before.and_then(|before| {
        let seconds = seconds(message.header.stamp) - seconds(before.header.stamp);
        let way = self::place(before.pose.position).ok()?.distance(place);
        (seconds > 0.0 && seconds <= POSE_PERIOD_MAX_S).then(|| way / seconds)
    });
    Ok(Pose {
        place,
        heading_deg: (90.0 - sine.atan2(cosine).to_degrees()).rem_euclid(360.0),
        speed_mps: speed.unwrap_or(0.0).min(SPEED_MAX_MPS),
    })
}

fn seconds(time: Time) -> f64 {
    f64::from(time.sec) + f64::from(time.nanosec) * 1e-9
}

fn place(point: Point) -> Result<Place, Refused> {
    let Point { x, y, .. } = point;
    // As far away as sensors report a person.
    let is_place = |metres: f64| (-1e5..=1e5).contains(&metres);
    if is_place(x) && is_place(y) {
        Ok(Place::new(x, y))
    } else {
        Err(Refused::Target { x, y })
    }
}

fn maneuver(command: &Command) -> ManeuverId {
    ManeuverId {
        session: session_id(command.session),
        request: RequestId(command.request),
    }
}

/// The session that a message names.
#[must_use]
pub const fn session_id(session: Session) -> SessionId {
    SessionId {
        leader: StationId(session.leader),
        number: SessionNumber(UniqueNumber {
            boot: session.boot,
            count: session.count,
        }),
    }
}

fn availability(command: &Command) -> Result<Availability, Refused> {
    Ok(Availability::Unavailable(match command.availability {
        Status::AVAILABLE => return Ok(Availability::Available),
        Status::LOW_BATTERY => Unavailability::LowBattery,
        Status::TELEOPERATED => Unavailability::Teleoperated,
        Status::EMERGENCY_STOP => Unavailability::EmergencyStop,
        Status::LOCAL_FAULT => Unavailability::LocalFault,
        Status::NOT_SAFE => Unavailability::NotSafe,
        other => return Err(Refused::Availability(other)),
    }))
}

/// How full a message says that the battery is.
///
/// # Errors
/// Why no battery is like that.
pub fn battery(message: &BatteryState) -> Result<Order, Refused> {
    let share = message.percentage;
    if !share.is_nan() && !(0.0..=1.0).contains(&share) {
        return Err(Refused::Battery(share));
    }
    let percent = (!share.is_nan()).then(|| f64::from(share) * 100.0);
    Ok(Order::Battery(Battery {
        state_of_charge: percent,
        charging: message.power_supply_status == BatteryState::CHARGING,
    }))
}

/// The person that a message reports.
///
/// # Errors
/// Why there cannot be anybody like that.
pub fn person(person: &Person) -> Result<Order, Refused> {
    let class = match person.kind {
        Person::PEDESTRIAN => VruClass::Pedestrian,
        Person::BICYCLIST => VruClass::Bicyclist,
        Person::MOTORCYCLIST => VruClass::Motorcyclist,
        Person::ANIMAL => VruClass::Animal,
        Person::WHEELCHAIR_USER => VruClass::WheelchairUser,
        Person::VEHICLE => VruClass::Vehicle,
        other => return Err(Refused::People(other)),
    };
    let vru = PerceivedVru {
        id: person.id,
        position_m: [person.position.x, person.position.y],
        velocity_mps: [person.velocity.x, person.velocity.y],
        class,
        confidence: person.confidence.into(),
    };
    perception::check(&vru)?;
    Ok(Order::Perceived(Some(vru)))
}

#[cfg(test)]
mod tests {
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
        let simulated = order(&clear, &Site::default(), BodyKind::Simulated);
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
            let ordered = order(&detect, &site, BodyKind::Simulated);
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
        })) = order(&command, &site, BodyKind::Simulated)
        else {
            panic!()
        };
        assert_eq!((follower, task), (StationId(2), TaskType::MOVE));
        assert_eq!(parameters.target, Some(site.target(Place::new(1.0, 8.0))));
        assert_eq!(parameters.maximum_speed, Some(0.4));
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
}
