"""What a robot says of itself in its RAM, and where and how a maneuver is to be done.

Units stand behind the names: degrees, metres, metres per second. What is `None` is not known, or left
to the follower.
"""

from __future__ import annotations

import enum
from dataclasses import dataclass
from typing import ClassVar, TypeAlias

from ._wire import Positional, Variant
from .types import TaskSet


@dataclass(frozen=True, slots=True)
class Measurement:
    """A quantity and the half width of its 95 % interval, in the same unit."""

    value: float
    confidence: float | None = None


@dataclass(frozen=True, slots=True)
class ConfidenceEllipse:
    """The ellipse that holds a position with a confidence of 95 %."""

    semi_major_m: float
    semi_minor_m: float
    orientation_deg: float
    """Direction of the larger axis, clockwise from north."""


@dataclass(frozen=True, slots=True)
class Position:
    """A position on the WGS84 ellipsoid, with its confidence."""

    latitude_deg: float | None = None
    """North positive, -90..90."""
    longitude_deg: float | None = None
    """East positive, -180..180."""
    altitude_m: float | None = None
    """Above the ellipsoid."""
    ellipse: ConfidenceEllipse | None = None
    """Horizontal confidence."""
    altitude_confidence_m: float | None = None
    """Half width of the altitude's 95 % interval."""


@dataclass(frozen=True, slots=True)
class Dimensions:
    """The box around a robot and what it carries."""

    length_m: float | None = None
    width_m: float | None = None
    height_m: float | None = None


@dataclass(frozen=True, slots=True)
class Battery:
    """The battery of a robot."""

    state_of_charge_percent: float | None = None
    """Of the usable capacity, 0..100."""
    charging: bool = False


class DriveDirection(enum.Enum):
    """Whether a robot moves forward or backward."""

    FORWARD = "forward"
    BACKWARD = "backward"
    UNAVAILABLE = "unavailable"


class RobotCategory(enum.Enum):
    """Build of a robot."""

    UNKNOWN = "unknown"
    HUMANOID = "humanoid"
    QUADRUPED = "quadruped"
    WHEELED = "wheeled"
    TRACKED = "tracked"
    AERIAL = "aerial"
    OTHER = "other"


class JobRole(enum.Enum):
    """Job that a robot is there for."""

    NONE = "none"
    TRAFFIC_GUARD = "trafficGuard"
    ESCORT = "escort"
    PATROL = "patrol"
    DELIVERY = "delivery"
    MAINTENANCE = "maintenance"
    OTHER = "other"


class TaskProgression(enum.Enum):
    """How far a robot is with its task."""

    IDLE = "idle"
    EXECUTING = "executing"
    IN_POSITION = "inPosition"
    COMPLETED = "completed"
    FAILED = "failed"
    SAFE_IDLE = "safeIdle"


class ControlMode(enum.Enum):
    """Who or what steers a robot."""

    AUTONOMOUS = "autonomous"
    TELEOPERATED = "teleoperated"
    EMERGENCY_STOP = "emergencyStop"
    FAULT = "fault"
    UNAVAILABLE = "unavailable"


class PublicSignal(enum.Enum):
    """A signal that people understand."""

    NONE = "none"
    STOP = "stop"
    GO = "go"
    CAUTION = "caution"


class Capabilities(enum.IntFlag):
    """What a robot can do besides maneuvers."""

    NONE = 0
    PEDESTRIAN_DETECTION = 1 << 0
    LEADING = 1 << 1
    FOLLOWING = 1 << 2
    GESTURES = 1 << 3
    DISPLAY = 1 << 4
    SPEECH = 1 << 5


class Lights(enum.IntFlag):
    """Lights that are on."""

    NONE = 0
    LOW_BEAM = 1 << 0
    HIGH_BEAM = 1 << 1
    LEFT_TURN_SIGNAL = 1 << 2
    RIGHT_TURN_SIGNAL = 1 << 3
    DAYTIME_RUNNING = 1 << 4
    REVERSE = 1 << 5
    FOG = 1 << 6
    PARKING = 1 << 7


class SignalMeans(enum.IntFlag):
    """How a signal is shown."""

    NONE = 0
    GESTURE = 1 << 0
    DISPLAY = 1 << 1
    LIGHTS = 1 << 2
    SPEECH = 1 << 3


@dataclass(frozen=True, slots=True)
class SignalsShown:
    """What a robot shows to people."""

    to_vehicles: PublicSignal
    to_pedestrians: PublicSignal
    means: SignalMeans


@dataclass(frozen=True, slots=True)
class PastPosition:
    """A position that a robot came from."""

    latitude_deg: float
    longitude_deg: float
    altitude_m: float | None = None
    duration_s: float | None = None
    """From there to the newer position before it in the list."""


@dataclass(frozen=True, slots=True)
class RoadSegment(Variant):
    """A road segment of a map."""

    region: int | None
    """The region in which its number is unique."""
    id: int


@dataclass(frozen=True, slots=True)
class Intersection(Variant):
    """An intersection of a map."""

    region: int | None
    """The region in which its number is unique."""
    id: int


MapPlace: TypeAlias = RoadSegment | Intersection
"""Where on a map a maneuver takes place, or what a robot is there for."""


@dataclass(frozen=True, slots=True)
class SlowState:
    """What changes slowly; it is in a RAM twice a second."""

    capabilities: Capabilities = Capabilities.NONE
    """What the robot can do besides maneuvers."""
    supported_tasks: TaskSet = TaskSet.NONE
    """The maneuvers that it can do; an endpoint puts in those of its configuration."""
    path: tuple[PastPosition, ...] = ()
    """Where it came from, newest first; 23 points at most are sent."""
    lights: Lights | None = None
    """`None` for a robot without lights."""
    signals: SignalsShown | None = None
    """`None` for a robot that cannot show anything."""
    area: MapPlace | None = None
    """The road segment or intersection that it is there for."""


@dataclass(frozen=True, slots=True)
class RobotState:
    """The body of a robot, as its RAM tells of it."""

    position: Position = Position()
    heading_deg: Measurement | None = None
    """Direction of motion, clockwise from north."""
    speed_mps: Measurement | None = None
    """Over ground, not negative."""
    drive_direction: DriveDirection = DriveDirection.UNAVAILABLE
    longitudinal_acceleration_mps2: Measurement | None = None
    """Speeding up positive."""
    lateral_acceleration_mps2: Measurement | None = None
    """To the left positive."""
    vertical_acceleration_mps2: Measurement | None = None
    """Upwards positive."""
    curvature_per_m: Measurement | None = None
    """To the left positive."""
    yaw_rate_dps: Measurement | None = None
    """Degrees per second, to the left positive."""
    orientation_deg: Measurement | None = None
    """Direction of the body, clockwise from north, where it is not that of the motion."""
    dimensions: Dimensions = Dimensions()
    category: RobotCategory = RobotCategory.UNKNOWN
    job_role: JobRole = JobRole.NONE
    task_progression: TaskProgression = TaskProgression.IDLE
    """An endpoint puts in what the protocol knows."""
    battery: Battery = Battery()
    control_mode: ControlMode = ControlMode.AUTONOMOUS
    """An endpoint puts in why the robot is unavailable, if it is."""
    slow: SlowState | None = SlowState()


@dataclass(frozen=True, slots=True)
class ToPosition(Variant):
    """To a position."""

    _name: ClassVar[str] = "position"
    latitude_deg: float
    longitude_deg: float
    altitude_m: float | None = None


@dataclass(frozen=True, slots=True)
class Offset(Variant):
    """To a position relative to the leader's, at most 0.0131071 degrees away."""

    latitude_deg: float
    longitude_deg: float
    altitude_m: float | None = None


@dataclass(frozen=True, slots=True)
class Lane(Positional):
    """To a lane: -1 off the road, 0 the inner hard shoulder, 1..13 the lanes from the inside of the road
    to its outside, 14 the outer hard shoulder."""

    lane: int


Target: TypeAlias = ToPosition | Offset | Lane
"""Where a maneuver leads."""


@dataclass(frozen=True, slots=True)
class TaskParameters:
    """Where and how a maneuver is to be done. What is `None` is left to the follower."""

    target: Target | None = None
    heading_deg: float | None = None
    """Which way to face at the target, clockwise from north; for a block, the direction of the traffic
    that is held back."""
    maximum_speed_mps: float | None = None
    """One above 163.81 m/s limits nothing."""
    minimum_pedestrian_distance_m: float | None = None
    """51.1 m at most."""
    validity_ms: int | None = None
    """How long the command may be executed, from the generation of the message; one day at most."""
    map_place: MapPlace | None = None
    """The road segment or intersection where the maneuver takes place; the protocol decides nothing by it."""
