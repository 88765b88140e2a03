//! Crossguard-RAM: the robot awareness message. A robot broadcasts it to tell where it is, what it
//! is, how it is, and what part it has in a coordination session. No standard defines it; it is
//! Crossguard's, after Arockiasamy and Vinel, "Multi-Robot Coordination in V2X Environments" (ITSC
//! 2026). Encoding: canonical unaligned PER.
//!
//! Generated from `asn1/Crossguard-RAM.asn` by `tests/generated`; do not edit.

use super::notation::prelude::*;

asn1! {
    /// Robot awareness message.
    RAM ::= SEQUENCE {
        header ItsPduHeader,
        ram    RobotAwareness
    }
}

asn1! {
    /// Payload of a RAM.
    RobotAwareness ::= SEQUENCE {
        generation_delta_time GenerationDeltaTime,
        ram_parameters        RamParameters
    }
}

asn1! {
    /// Containers of a RAM. Sizes and values behind an extension marker of the dictionary are not
    /// used, and in the motion prediction path history and path prediction have at most 10 points
    /// each. Both hold for senders and receivers and keep a RAM well below what one packet can
    /// carry.
    RamParameters ::= SEQUENCE {
        basic_container                           BasicContainer,
        robot_high_frequency_container            RobotHighFrequencyContainer,
        robot_low_frequency_container             RobotLowFrequencyContainer OPTIONAL,
        robot_status_container                    RobotStatusContainer,
        robot_leader_follower_operation_container RobotLeaderFollowerOperationContainer OPTIONAL,
        vru_cluster_information_container         VruClusterInformationContainer OPTIONAL,
        vru_motion_prediction_container           VruMotionPredictionContainer OPTIONAL,
        ...
    }
}

asn1! {
    /// Quick part of the state: the motion, and the size, which changes with the posture. Heading
    /// is the direction of motion, orientation that of the body, where it differs.
    RobotHighFrequencyContainer ::= SEQUENCE {
        heading                   Wgs84Angle,
        speed                     Speed,
        drive_direction           DriveDirection,
        longitudinal_acceleration AccelerationComponent,
        robot_dimensions          RobotDimensions,
        curvature                 Curvature OPTIONAL,
        yaw_rate                  YawRate OPTIONAL,
        lateral_acceleration      AccelerationComponent OPTIONAL,
        vertical_acceleration     AccelerationComponent OPTIONAL,
        orientation               Wgs84Angle OPTIONAL,
        ...
    }
}

asn1! {
    /// Box around the robot and what it carries.
    RobotDimensions ::= SEQUENCE {
        length ObjectDimensionValue,
        width  ObjectDimensionValue,
        height ObjectDimensionValue
    }
}

asn1! {
    /// Positions that the robot came from, newest first, each relative to the one before it.
    RobotPathHistory ::= SEQUENCE (SIZE(0..23)) OF PathPoint
}

asn1! {
    /// Slow part of the state. `areaServed` is the road segment or intersection that the robot
    /// serves.
    RobotLowFrequencyContainer ::= SEQUENCE {
        capabilities    RobotCapabilities,
        supported_tasks TaskSet,
        path_history    RobotPathHistory,
        exterior_lights ExteriorLights OPTIONAL,
        signals_shown   SignalsShown OPTIONAL,
        area_served     MapReference OPTIONAL,
        ...
    }
}

asn1! {
    /// Abilities of the robot besides maneuvers. Bits without a name are zero and ignored.
    RobotCapabilities ::= BIT STRING (SIZE(8)) as u8
}

asn1! {
    /// Signals of the robot to the people around it, and their means.
    SignalsShown ::= SEQUENCE {
        to_vehicles    PublicSignal,
        to_pedestrians PublicSignal,
        means          SignalMeans,
        ...
    }
}

asn1! {
    /// A signal that people understand.
    PublicSignal ::= ENUMERATED { None, Stop, Go, Caution, ... }
}

asn1! {
    /// How a signal is shown. Bits without a name are zero and ignored.
    SignalMeans ::= BIT STRING (SIZE(8)) as u8
}

asn1! {
    /// Kind and condition of the robot. unavailability is present while the robot takes no part in
    /// coordination. `onDuty` is TRUE while the robot still has a duty on the road from a maneuver
    /// or session that ended early: until the road is clear it offers no help and takes no command.
    /// `helpStatus` goes with the operation container: `needHelp` with a requester, `offerHelp`
    /// with a helper, `roleConfirmed` with a leader or a follower, none with none of these.
    RobotStatusContainer ::= SEQUENCE {
        robot_category       RobotCategory,
        operational_job_role OperationalJobRole,
        task_progression     TaskProgression,
        battery_status       BatteryStatus,
        control_mode         ControlMode,
        help_status          HelpStatus,
        unavailability       UnavailabilityReason OPTIONAL,
        on_duty              bool,
        ...
    }
}

asn1! {
    /// Build of the robot.
    RobotCategory ::= ENUMERATED {
        Unknown, Humanoid, Quadruped, Wheeled, Tracked, Aerial, Other, ...
    }
}

asn1! {
    /// Job that the robot is there for.
    OperationalJobRole ::= ENUMERATED {
        None, TrafficGuard, Escort, Patrol, Delivery, Maintenance, Other, ...
    }
}

asn1! {
    /// Battery of the robot.
    BatteryStatus ::= SEQUENCE {
        state_of_charge StateOfCharge,
        charging        bool,
        ...
    }
}

asn1! {
    /// 1 % of the usable capacity.
    StateOfCharge ::= INTEGER (0..101) as u8
}

asn1! {
    /// Control over the robot.
    ControlMode ::= ENUMERATED { Autonomous, Teleoperated, EmergencyStop, Fault, Unavailable, ... }
}

asn1! {
    /// Stage of help between robots.
    HelpStatus ::= ENUMERATED { None, NeedHelp, OfferHelp, RoleConfirmed, ... }
}

asn1! {
    /// The sender's part in a session, and a session that it names as over.
    RobotLeaderFollowerOperationContainer ::= SEQUENCE {
        role     SessionRole OPTIONAL,
        farewell SessionFarewell OPTIONAL,
        ...
    }
}

asn1! {
    /// Part in a session. The session of a requester and of a leader is the sender's own.
    SessionRole ::= CHOICE {
        Requester RequesterRole,
        Helper    HelperRole,
        Leader    LeaderRole,
        Follower  FollowerRole,
        ...
    }
}

asn1! {
    /// How many followers are asked for.
    RequestedFollowers ::= INTEGER (1..16) as u8
}

asn1! {
    /// Has opened a session and asks for followers that can do these tasks. A request whose
    /// heartbeat does not grow does not stand any more.
    RequesterRole ::= SEQUENCE {
        session         CoordinationSession,
        heartbeat       Heartbeat,
        urgency         RequestUrgency,
        crossing        CrossingReference OPTIONAL,
        follower_count  RequestedFollowers,
        requested_tasks TaskSet,
        ...
    }
}

asn1! {
    /// How urgent a request is: nobody waits yet, a pedestrian waits, a pedestrian who needs more
    /// help than others waits, a pedestrian is on the road.
    RequestUrgency ::= ENUMERATED { Low, Medium, High, Emergency }
}

asn1! {
    /// Road regulator or intersection of a crossing.
    CrossingNumber ::= INTEGER (0..65_535) is u16
}

asn1! {
    /// Crossing of a request and its session, named like an `IntersectionReferenceID` of ISO/TS
    /// 19091: the authority that numbers intersections, and the intersection. Where it is absent
    /// the crossing is not known and may be any. 0:0 is never present.
    CrossingReference ::= SEQUENCE {
        regulator    CrossingNumber,
        intersection CrossingNumber
    }
}

asn1! {
    /// Offers to join the session of a requester, with the tasks that it can do of those asked for
    /// and the newest heartbeat of the request that it heard. `safetyTimeout` is the time without a
    /// heartbeat after which it falls back; a requester whose lease is too long for it does not
    /// take the offer.
    HelperRole ::= SEQUENCE {
        session        CoordinationSession,
        offer_number   OfferNumber,
        capabilities   TaskSet,
        heartbeat_echo Heartbeat,
        safety_timeout SafetyTimeout,
        ...
    }
}

asn1! {
    /// 1 ms, up to one day.
    SafetyTimeout ::= INTEGER (1..86_400_000) as u32
}

asn1! {
    /// The followers of a session.
    ConfirmedFollowers ::= SEQUENCE (SIZE(1..16)) OF ConfirmedFollower
}

asn1! {
    /// Leads a session. A robot that is not among the followers has no part in it. urgency and
    /// crossing are those of the request; yields is TRUE once it has given the crossing up to
    /// another leader and lets nobody cross any more.
    LeaderRole ::= SEQUENCE {
        session   CoordinationSession,
        heartbeat Heartbeat,
        urgency   RequestUrgency,
        crossing  CrossingReference OPTIONAL,
        yields    bool,
        followers ConfirmedFollowers,
        ...
    }
}

asn1! {
    /// Number that grows by one for every RAM period of a session, from its request on: a serial
    /// number modulo 65536.
    Heartbeat ::= INTEGER (0..65_535) is u16
}

asn1! {
    /// A follower, and its offer that the leader accepts.
    ConfirmedFollower ::= SEQUENCE {
        station_id   StationId,
        offer_number OfferNumber
    }
}

asn1! {
    /// Follows in a session: the newest heartbeat that it heard, the newest command that it
    /// accepted.
    FollowerRole ::= SEQUENCE {
        session        CoordinationSession,
        heartbeat_echo Heartbeat,
        last_command   CommandReport OPTIONAL,
        ...
    }
}

asn1! {
    /// How far a follower is with a command. The status container's `taskProgression` says the
    /// same.
    CommandReport ::= SEQUENCE {
        request_id RequestId,
        progress   CommandProgress
    }
}

asn1! {
    /// The maneuver runs while it is executing or `inPosition`: the robot is on the way, or it
    /// holds the place from which it guards. Every other progress is final for its command.
    CommandProgress ::= CHOICE {
        Executing  Null,
        InPosition Null,
        Completed  Null,
        Failed     FailureReason,
        SafeIdle   Null,
        ...
    }
}

asn1! {
    /// Why a maneuver ended without success: it could not be done, or the robot became unavailable.
    FailureReason ::= CHOICE {
        Maneuver    Null,
        Unavailable UnavailabilityReason,
        ...
    }
}

asn1! {
    /// Names a session as over: the sender's own has ended, or it has left that of another station.
    SessionFarewell ::= CHOICE {
        Ended EndedSession,
        Left  LeftSession,
        ...
    }
}

asn1! {
    /// The sender's own session of this number, and how it ended.
    EndedSession ::= SEQUENCE {
        session_number SessionNumber,
        ending         SessionEnding
    }
}

asn1! {
    /// completed: the crossing is completed and the road is clear, followers are free. aborted: any
    /// other end; people may be on the road, so followers fall back.
    SessionEnding ::= ENUMERATED { Completed, Aborted }
}

asn1! {
    /// Another station's session, in which the sender has no part any more by this offer or an
    /// earlier one. A later offer stands.
    LeftSession ::= SEQUENCE {
        session      CoordinationSession,
        offer_number OfferNumber
    }
}
