//! The largest encodings of RAM and RMCM, derived from the constraints of their types.
//!
//! Every constant is the number of bits of the type of that name in its longest encoding: extension
//! and presence bits, every OPTIONAL component present, every list full, of a CHOICE the longest
//! alternative. `tests/size.rs` builds these values and encodes them.

use crate::rules::{PATH_HISTORY_MAX, PATH_PREDICTION_MAX};

/// The largest message that a packet carries, in octets: the `GeoNetworking` payload of 1398 octets
/// (`itsGnMaxSduSize`, EN 302 636-4-1) less the 4 octets of the BTP header.
///
/// Longer input is refused before it is read. Messages of this crate stay far below, so that there
/// is room for the security envelope, and for extension additions of newer senders.
pub const MESSAGE_LEN_MAX: usize = 1_398 - 4;

/// The largest RAM that this crate encodes, in octets.
pub const RAM_LEN_MAX: usize = RAM.div_ceil(8);

/// The largest RMCM that this crate encodes, in octets.
pub const RMCM_LEN_MAX: usize = RMCM.div_ceil(8);

const _: () = assert!(RAM_LEN_MAX < MESSAGE_LEN_MAX && RMCM_LEN_MAX < MESSAGE_LEN_MAX);

/// Bits of an integer from `min` to `max`, of a list length, or of an index.
const fn range(min: i64, max: i64) -> usize {
    match max - min {
        0 => 0,
        largest => largest.ilog2() as usize + 1,
    }
}

const fn longest(alternatives: &[usize]) -> usize {
    let (mut longest, mut i) = (0, 0);
    while i < alternatives.len() {
        if alternatives[i] > longest {
            longest = alternatives[i];
        }
        i += 1;
    }
    longest
}

/// An extension bit, or the presence bit of an OPTIONAL component.
const BIT: usize = 1;

// Crossguard-CDD.

const STATION_ID: usize = range(0, 4_294_967_295);
const ITS_PDU_HEADER: usize = range(0, 255) + range(0, 255) + STATION_ID;
const GENERATION_DELTA_TIME: usize = range(0, 65_535);
const LATITUDE: usize = range(-900_000_000, 900_000_001);
const LONGITUDE: usize = range(-1_800_000_000, 1_800_000_001);
const SEMI_AXIS_LENGTH: usize = range(0, 4_095);
const ANGLE_VALUE: usize = range(0, 3_601);
const CONFIDENCE: usize = range(1, 127);
const ALTITUDE_VALUE: usize = range(-100_000, 800_001);
const ALTITUDE_CONFIDENCE: usize = range(0, 15);
const ELLIPSE: usize = 2 * SEMI_AXIS_LENGTH + ANGLE_VALUE;
const REFERENCE_POSITION: usize =
    LATITUDE + LONGITUDE + ELLIPSE + ALTITUDE_VALUE + ALTITUDE_CONFIDENCE;
const BASIC_CONTAINER: usize = BIT + range(0, 255) + REFERENCE_POSITION;
const WGS84_ANGLE: usize = ANGLE_VALUE + CONFIDENCE;
const SPEED_VALUE: usize = range(0, 16_383);
const SPEED: usize = SPEED_VALUE + CONFIDENCE;
const ACCELERATION_COMPONENT: usize = range(-160, 161) + range(0, 102);
const CURVATURE: usize = range(-1_023, 1_023) + range(0, 7);
const YAW_RATE: usize = range(-32_766, 32_767) + range(0, 8);
const DELTA_POSITION: usize = 2 * range(-131_071, 131_072);
const DELTA_ALTITUDE: usize = range(-12_700, 12_800);
const PATH_POINT: usize = BIT + DELTA_POSITION + DELTA_ALTITUDE + PATH_DELTA_TIME;
const PATH_DELTA_TIME: usize = BIT + range(1, 65_535);
const TENTH_OF_SECOND: usize = range(0, 127);
const LENGTH_9B: usize = range(0, 511);
const LENGTH_12B: usize = range(0, 4_095);
const MAP_REFERENCE: usize = range(0, 1) + BIT + 2 * range(0, 65_535);
const LANE_POSITION: usize = range(-1, 14);

// Crossguard-VAM, as a RAM uses it.

/// `deltaTimeMidRange`, an extension addition: index, length and three octets.
const PATH_DELTA_TIME_CHOICE: usize = BIT + 7 + 8 + range(0, 86_400).next_multiple_of(8);
const PATH_POINT_PREDICTED: usize = BIT
    + 6 * BIT
    + DELTA_POSITION
    + ELLIPSE
    + DELTA_ALTITUDE
    + ALTITUDE_CONFIDENCE
    + PATH_DELTA_TIME_CHOICE
    + 2 * LENGTH_9B;
const SAFE_DISTANCE: usize = BIT + 2 * BIT + STATION_ID + 1 + TENTH_OF_SECOND;
const TRAJECTORY_INTERCEPTION: usize = BIT + 2 * BIT + STATION_ID + range(0, 63) + range(0, 3);
const MOTION_PREDICTION_CONTAINER: usize = BIT
    + 7 * BIT
    + (range(0, 40) + PATH_HISTORY_MAX * PATH_POINT)
    + (BIT + range(1, 16) + PATH_PREDICTION_MAX * PATH_POINT_PREDICTED)
    + (BIT + range(1, 8) + 8 * SAFE_DISTANCE)
    + (BIT + range(1, 8) + 8 * TRAJECTORY_INTERCEPTION)
    + (BIT + 1 + TENTH_OF_SECOND)
    + (BIT + 1 + TENTH_OF_SECOND)
    + (BIT + range(0, 63) + TENTH_OF_SECOND);
const CARTESIAN_POSITION: usize = BIT + 3 * range(-32_768, 32_767);
/// A polygon of 16 corners; the other shapes of a cluster are smaller.
const SHAPE: usize = BIT
    + range(0, 5)
    + (2 * BIT + CARTESIAN_POSITION)
    + (BIT + range(3, 16) + 16 * CARTESIAN_POSITION)
    + LENGTH_12B;
const CLUSTER_INFORMATION_CONTAINER: usize =
    BIT + (BIT + 3 * BIT + range(0, 255) + SHAPE + range(0, 255) + 4);

// Crossguard-Common.

const UNAVAILABILITY_REASON: usize = BIT + range(0, 4);
const TASK_PROGRESSION: usize = BIT + range(0, 4);
const TASK_SET: usize = 16;
const NUMBER: usize = range(0, 4_294_967_295);
const SESSION: usize = STATION_ID + NUMBER;
const REQUEST_ID: usize = range(0, 255);

// Crossguard-RAM.

const HIGH_FREQUENCY_CONTAINER: usize = BIT
    + 5 * BIT
    + WGS84_ANGLE
    + SPEED
    + range(0, 2)
    + ACCELERATION_COMPONENT
    + 3 * range(1, 256)
    + CURVATURE
    + YAW_RATE
    + 2 * ACCELERATION_COMPONENT
    + WGS84_ANGLE;
const SIGNALS_SHOWN: usize = BIT + 2 * (BIT + range(0, 3)) + 8;
const LOW_FREQUENCY_CONTAINER: usize =
    BIT + 2 * BIT + 8 + TASK_SET + (range(0, 23) + 23 * PATH_POINT) + 8 + SIGNALS_SHOWN;
const STATUS_CONTAINER: usize = BIT
    + BIT
    + (BIT + range(0, 6))
    + (BIT + range(0, 6))
    + TASK_PROGRESSION
    + (BIT + range(0, 101) + 1)
    + (BIT + range(0, 4))
    + (BIT + range(0, 3))
    + UNAVAILABILITY_REASON;
const REQUESTER: usize = BIT + SESSION + range(0, 3) + range(1, 4) + TASK_SET;
const HELPER: usize = BIT + SESSION + NUMBER + TASK_SET;
const LEADER: usize = BIT + SESSION + range(0, 65_535) + (range(1, 4) + 4 * (STATION_ID + NUMBER));
const FAILURE_REASON: usize = BIT + range(0, 1) + UNAVAILABILITY_REASON;
const COMMAND_REPORT: usize = REQUEST_ID + (BIT + range(0, 3) + FAILURE_REASON);
const FOLLOWER: usize = BIT + BIT + SESSION + range(0, 65_535) + COMMAND_REPORT;
const SESSION_ROLE: usize = BIT + range(0, 3) + longest(&[REQUESTER, HELPER, LEADER, FOLLOWER]);
const SESSION_FAREWELL: usize = BIT + range(0, 1) + longest(&[NUMBER, SESSION]);
const OPERATION_CONTAINER: usize = BIT + 2 * BIT + SESSION_ROLE + SESSION_FAREWELL;
const RAM: usize = ITS_PDU_HEADER
    + GENERATION_DELTA_TIME
    + (BIT + 4 * BIT)
    + BASIC_CONTAINER
    + HIGH_FREQUENCY_CONTAINER
    + LOW_FREQUENCY_CONTAINER
    + STATUS_CONTAINER
    + OPERATION_CONTAINER
    + CLUSTER_INFORMATION_CONTAINER
    + MOTION_PREDICTION_CONTAINER;

// Crossguard-RMCM.

const MANEUVER_DURATION: usize = range(0, 86_400_000);
const MANEUVER_TARGET: usize = BIT
    + range(0, 2)
    + longest(&[
        BIT + LATITUDE + LONGITUDE + ALTITUDE_VALUE,
        DELTA_POSITION + DELTA_ALTITUDE,
        LANE_POSITION,
    ]);
const MANEUVER_CONSTRAINTS: usize = BIT + 2 * BIT + SPEED_VALUE + LENGTH_9B;
const MANEUVER_COMMAND: usize = BIT
    + 4 * BIT
    + REQUEST_ID
    + STATION_ID
    + range(0, 15)
    + MANEUVER_TARGET
    + ANGLE_VALUE
    + MANEUVER_CONSTRAINTS
    + MANEUVER_DURATION;
const LEADER_MANEUVER_CONTAINER: usize =
    BIT + BIT + SESSION + MAP_REFERENCE + (range(1, 4) + 4 * MANEUVER_COMMAND);
const REJECTION_REASON: usize = BIT + range(0, 1) + UNAVAILABILITY_REASON;
const FOLLOWER_MANEUVER_CONTAINER: usize = BIT
    + BIT
    + SESSION
    + REQUEST_ID
    + (BIT + range(0, 1) + REJECTION_REASON)
    + TASK_PROGRESSION
    + MANEUVER_DURATION;
const MANEUVER_CONTAINER: usize =
    BIT + range(0, 1) + longest(&[LEADER_MANEUVER_CONTAINER, FOLLOWER_MANEUVER_CONTAINER]);
const RMCM: usize =
    ITS_PDU_HEADER + GENERATION_DELTA_TIME + BIT + BASIC_CONTAINER + MANEUVER_CONTAINER;
