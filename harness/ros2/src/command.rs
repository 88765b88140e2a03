//! What a message of the application tells the robot.

use crossguard_codec::{
    Battery, JobRole, MapPlace, NoMapPlace, PublicSignal, SignalMeans, SignalsShown, TaskParameters,
};
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
    /// No place of a map.
    #[error("map_place is '{0}': {1}")]
    MapPlace(String, NoMapPlace),
    /// There is no such job.
    #[error("job_role {0}: 0 to 6 are possible")]
    Job(u8),
    /// There is no such signal.
    #[error("signal {0}: 0 to 3 are possible")]
    Signal(u8),
    /// Only an open corridor shows it.
    #[error("go is not shown to pedestrians by command; OPEN_CORRIDOR opens the corridor")]
    Go,
    /// There are no such means.
    #[error("signal_means {0}: a sum of 1, 2, 4 and 8 is wanted")]
    Means(u8),
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
    /// The body is moved by no other node.
    #[error("the body is simulated or at its port; --body external takes poses")]
    NotExternal,
    /// The robot takes signed packets only, and nobody signs what a ROS graph says.
    #[error(
        "the robot takes nothing from the ROS graph with --security enforce; 'trust_ros_graph = true' in its robot \
         file lets every node command it"
    )]
    Untrusted,
    /// There is no robot to tell it.
    #[error("the node is {0}; it takes commands when it is active")]
    NotActive(&'static str),
}

impl Refused {
    /// The cause that it is counted under.
    #[must_use]
    pub const fn cause(&self) -> &'static str {
        match self {
            Self::Untrusted => "ros: graph not trusted",
            Self::NotActive(_) => "ros: not active",
            Self::Frame(_) | Self::Orientation | Self::NotExternal => "ros: impossible pose",
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
        // Of a body that is simulated or at its port, the robot itself knows when it has finished its fallback.
        Command::ROAD_CLEAR if body == BodyKind::Configured => return Ok(Order::Clear),
        Command::ROAD_CLEAR => Event::RoadClear,
        Command::DONE => Event::ManeuverCompleted(maneuver(command)),
        Command::FAIL => Event::ManeuverFailed(maneuver(command)),
        Command::OPEN_CORRIDOR => Event::OpenCorridor,
        Command::CLOSE_CORRIDOR => Event::CloseCorridor,
        Command::TASK_COMPLETED => Event::TaskCompleted,
        Command::LEAVE => Event::LeaveRequested,
        Command::SET_AVAILABILITY => Event::AvailabilityChanged(availability(command)?),
        Command::SHOW => return Ok(Order::Show(signals(command)?)),
        Command::JOB => return Ok(Order::Job(job_role(command.job_role)?)),
        Command::SERVE => return Ok(Order::Serve(map_place(command)?)),
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
        map_place: map_place(command)?.or(site.map_place),
        target: target.map(|place| site.target(place)),
        maximum_speed: (speed > 0.0).then_some(speed),
        ..TaskParameters::default()
    })
}

/// The road segment or intersection that the command names, if it does.
fn map_place(command: &Command) -> Result<Option<MapPlace>, Refused> {
    let text = command.map_place.as_str();
    let place = (!text.is_empty()).then(|| text.parse()).transpose();
    place.map_err(|error| Refused::MapPlace(text.to_owned(), error))
}

fn job_role(code: u8) -> Result<JobRole, Refused> {
    Ok(match code {
        Command::ROLE_NONE => JobRole::None,
        Command::ROLE_TRAFFIC_GUARD => JobRole::TrafficGuard,
        Command::ROLE_ESCORT => JobRole::Escort,
        Command::ROLE_PATROL => JobRole::Patrol,
        Command::ROLE_DELIVERY => JobRole::Delivery,
        Command::ROLE_MAINTENANCE => JobRole::Maintenance,
        Command::ROLE_OTHER => JobRole::Other,
        other => return Err(Refused::Job(other)),
    })
}

/// What the robot shows from now on.
fn signals(command: &Command) -> Result<SignalsShown, Refused> {
    let signal = |code| {
        Ok(match code {
            Command::SIGNAL_NONE => PublicSignal::None,
            Command::SIGNAL_STOP => PublicSignal::Stop,
            Command::SIGNAL_GO => PublicSignal::Go,
            Command::SIGNAL_CAUTION => PublicSignal::Caution,
            other => return Err(Refused::Signal(other)),
        })
    };
    let signals = SignalsShown {
        to_vehicles: signal(command.to_vehicles)?,
        to_pedestrians: signal(command.to_pedestrians)?,
        means: SignalMeans(command.signal_means),
    };
    let all = [
        Command::MEANS_GESTURE,
        Command::MEANS_DISPLAY,
        Command::MEANS_LIGHTS,
    ];
    let all = all
        .into_iter()
        .fold(Command::MEANS_SPEECH, |all, one| all | one);
    match signals {
        SignalsShown { means, .. } if means.0 & !all != 0 => Err(Refused::Means(means.0)),
        SignalsShown {
            to_pedestrians: PublicSignal::Go,
            ..
        } => Err(Refused::Go),
        signals => Ok(signals),
    }
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
mod tests;
