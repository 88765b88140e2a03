//! Crossguard-RMCM: the robot maneuver coordination message. A leader commands maneuvers with it, a
//! follower acknowledges or rejects a command. No standard defines it; it is Crossguard's, after
//! Arockiasamy and Vinel, "Multi-Robot Coordination in V2X Environments" (ITSC 2026). Encoding:
//! canonical unaligned PER.
//!
//! Generated from `asn1/Crossguard-RMCM.asn` by `tests/generated`; do not edit.

use super::notation::prelude::*;

asn1! {
    /// Robot maneuver coordination message.
    RMCM ::= SEQUENCE {
        header ItsPduHeader,
        rmcm   RobotManeuverCoordination
    }
}

asn1! {
    /// Payload of an RMCM.
    RobotManeuverCoordination ::= SEQUENCE {
        generation_delta_time GenerationDeltaTime,
        rmcm_parameters       RmcmParameters
    }
}

asn1! {
    /// Containers of an RMCM.
    RmcmParameters ::= SEQUENCE {
        basic_container    BasicContainer,
        maneuver_container ManeuverContainer,
        ...
    }
}

asn1! {
    /// Part of the sender in the session.
    ManeuverContainer ::= CHOICE {
        LeaderManeuverContainer   LeaderManeuverContainer,
        FollowerManeuverContainer FollowerManeuverContainer,
        ...
    }
}

asn1! {
    /// Commands, each to another follower.
    ManeuverCommands ::= SEQUENCE (SIZE(1..16)) OF ManeuverCommand
}

asn1! {
    /// Commands of a leader, each to another follower. `mapReference` is the road segment or
    /// intersection at which the maneuvers take place. The session is the sender's own.
    LeaderManeuverContainer ::= SEQUENCE {
        session       CoordinationSession,
        map_reference MapReference OPTIONAL,
        commands      ManeuverCommands,
        ...
    }
}

asn1! {
    /// Command to one follower. `validityDuration` counts from the generation of the message.
    ManeuverCommand ::= SEQUENCE {
        request_id                 RequestId,
        target_follower_station_id StationId,
        task_type                  TaskType,
        target                     ManeuverTarget OPTIONAL,
        target_heading             Wgs84AngleValue OPTIONAL,
        constraints                ManeuverConstraints OPTIONAL,
        validity_duration          ManeuverDuration OPTIONAL,
        ...
    }
}

asn1! {
    /// Where the maneuver leads: a position, a position relative to the sender's reference
    /// position, or a lane.
    ManeuverTarget ::= CHOICE {
        Position     GeoPosition,
        Offset       DeltaReferencePosition,
        LanePosition LanePosition,
        ...
    }
}

asn1! {
    /// Limits for the follower while it executes the maneuver.
    ManeuverConstraints ::= SEQUENCE {
        maximum_speed               SpeedValue OPTIONAL,
        minimum_pedestrian_distance StandardLength9b OPTIONAL,
        ...
    }
}

asn1! {
    /// 1 ms, up to one day.
    ManeuverDuration ::= INTEGER (0..86_400_000) as u32
}

asn1! {
    /// A follower's answer to the command whose `requestID` equals `jobAdviceID`.
    FollowerManeuverContainer ::= SEQUENCE {
        session                      CoordinationSession,
        job_advice_id                RequestId,
        response                     ManeuverResponse,
        execution_status             TaskProgression,
        estimated_time_to_completion ManeuverDuration OPTIONAL,
        ...
    }
}

asn1! {
    /// Acknowledgement or rejection of a command.
    ManeuverResponse ::= CHOICE {
        Accepted Null,
        Rejected RejectionReason,
        ...
    }
}

asn1! {
    /// Why a command is rejected: the robot cannot do such a task, it is unavailable, or it has a
    /// duty on the road from a maneuver or session that ended early.
    RejectionReason ::= CHOICE {
        UnsupportedTask Null,
        Unavailable     UnavailabilityReason,
        OnDuty          Null,
        ...
    }
}
