//! What states, messages, inputs and outputs are called in logs and charts.

use crossguard_protocol::*;

const ARI: StationId = StationId(1);
const GO2: StationId = StationId(2);

const NUMBER: UniqueNumber = UniqueNumber { boot: 3, count: 4 };
const SESSION: SessionId = SessionId {
    leader: ARI,
    number: SessionNumber(NUMBER),
};
const MANEUVER: ManeuverId = ManeuverId {
    session: SESSION,
    request: RequestId(7),
};

fn request() -> HelpRequest {
    HelpRequest {
        urgency: Urgency::High,
        followers: 2,
        tasks: TaskSet::of(&[TaskType::INITIAL_POS, TaskType::MOVE]),
        place: Place(0x0005_0007),
    }
}

fn ram(coordination: Coordination, farewell: Option<Farewell>) -> Ram {
    Ram {
        station: ARI,
        coordination,
        farewell,
        on_duty: false,
    }
}

/// Asserts that each value reads so.
macro_rules! assert_reads {
    ($($value:expr => $text:literal),* $(,)?) => {
        $(assert_eq!($value.to_string(), $text);)*
    };
}

#[test]
fn numbers_and_quantities() {
    assert_reads!(
        NUMBER => "3.4",
        ARI => "1",
        SESSION => "1#3.4",
        RequestId(7) => "7",
        Heartbeat(9) => "9",
        MANEUVER => "1#3.4/7",
        Millis(250) => "250 ms",
        Decimetres(42) => "4.2 m",
        Decimetres::UNKNOWN => "unknown distance",
        request() => "2 x initialPos+move, high urgency, at 5:7",
        HelpRequest { place: Place::UNKNOWN, ..request() } => "2 x initialPos+move, high urgency",
        Place::UNKNOWN => "an unknown place",
        Availability::Available => "available",
        Availability::Unavailable(Unavailability::LowBattery) => "low battery",
    );
}

#[test]
fn messages() {
    let [session, number] = [SESSION, SESSION].map(|session| session);
    let number = number.number;
    let heartbeat = Heartbeat(9);
    let followers = [GO2, StationId(3)].map(|station| Confirmation {
        station,
        offer: OfferNumber(NUMBER),
    });
    let leader = |yields| Coordination::Leader {
        number,
        heartbeat,
        followers: followers.into_iter().collect(),
        urgency: Urgency::High,
        place: Place::UNKNOWN,
        yields,
    };
    let last = Report {
        request: RequestId(7),
        progress: Progress::SafeIdle,
    };
    let answer = |verdict| {
        Rmcm::Answer(Answer {
            from: GO2,
            session,
            request: RequestId(7),
            verdict,
        })
    };
    let (to, request_id, task) = (GO2, RequestId(7), TaskType::MOVE);
    assert_reads!(
        last => "request 7 safe idle",
        ram(Coordination::None, None) => "RAM none",
        ram(Coordination::None, Some(Farewell::Ended(number, Ending::Completed)))
            => "RAM none, ended 1#3.4, completed",
        ram(Coordination::None, Some(Farewell::Ended(number, Ending::Aborted)))
            => "RAM none, ended 1#3.4, aborted",
        ram(Coordination::None, Some(Farewell::Left(session, OfferNumber(NUMBER))))
            => "RAM none, left 1#3.4 by offer 3.4",
        Ram { on_duty: true, ..ram(Coordination::None, None) } => "RAM none, on duty",
        ram(Coordination::NeedHelp { number, heartbeat, request: request() }, None)
            => "RAM needHelp 1#3.4 (2 x initialPos+move, high urgency, at 5:7), heartbeat 9",
        ram(
            Coordination::OfferHelp {
                session,
                offer: OfferNumber(NUMBER),
                capabilities: TaskSet::of(&[TaskType::BLOCK]),
                echo: heartbeat,
                t_safety: Millis(2_000),
            },
            None,
        ) => "RAM offerHelp 1#3.4 (block), echo 9",
        ram(leader(false), None) => "RAM leader 1#3.4 of 2 3, heartbeat 9",
        ram(leader(true), None) => "RAM leader 1#3.4 of 2 3, heartbeat 9, yields the place",
        ram(Coordination::Follower { session, echo: heartbeat, last: None }, None)
            => "RAM follower 1#3.4, echo 9",
        ram(Coordination::Follower { session, echo: heartbeat, last: Some(last) }, None)
            => "RAM follower 1#3.4, echo 9, request 7 safe idle",
        Rmcm::Command(Command { session, to, request: request_id, task })
            => "RMCM command 1#3.4/7 move to 2",
        answer(Verdict::Accepted) => "RMCM ack 1#3.4/7",
        answer(Verdict::Rejected(Rejection::UnsupportedTask))
            => "RMCM reject 1#3.4/7: unsupported task",
    );
}

#[test]
fn inputs() {
    let (follower, task) = (GO2, TaskType::MOVE);
    let tells = Input::Local;
    let distance = Decimetres(42);
    assert_reads!(
        tells(Event::PedestrianDetected(request()))
            => "pedestrian detected (2 x initialPos+move, high urgency, at 5:7)",
        tells(Event::InPosition(MANEUVER)) => "maneuver 1#3.4/7 in position",
        tells(Event::RoadClear) => "road clear",
        tells(Event::AllAnswered) => "all have answered",
        tells(Event::EpochRenewed(4)) => "boot counter renewed to 4",
        tells(Event::CommandManeuver { follower, task }) => "command 2 move",
        tells(Event::ManeuverCompleted(MANEUVER)) => "maneuver 1#3.4/7 completed",
        tells(Event::ManeuverFailed(MANEUVER)) => "maneuver 1#3.4/7 failed",
        tells(Event::TaskCompleted) => "task completed",
        tells(Event::LeaveRequested) => "leave requested",
        tells(Event::AvailabilityChanged(Availability::Available)) => "now available",
        tells(Event::OpenCorridor) => "open corridor",
        tells(Event::CloseCorridor) => "close corridor",
        tells(Event::IdentityChanged(GO2, None)) => "identity changed to 2",
        tells(Event::IdentityChanged(GO2, Some(UniqueNumber { boot: 7, count: 0 }))) =>
            "identity changed to 2, numbers from 7.0",
        Input::Ram { ram: ram(Coordination::None, None), distance } => "RAM none from 1",
        Input::Elapsed(Millis(5)) => "5 ms elapsed",
        Input::Expired(Timer::Selection) => "timer selection expired",
    );
}

#[test]
fn outputs() {
    let maneuver = Maneuver {
        id: MANEUVER,
        task: TaskType::MOVE,
    };
    let engaged = CorridorClosure::NotEngaged(GO2, Disengagement::Failed(Failure::ExecutionLimit));
    assert_reads!(
        maneuver => "move 1#3.4/7",
        Output::SendRam => "send RAM",
        Output::StartManeuver(maneuver) => "start move 1#3.4/7",
        Output::FallBack(maneuver, FallbackPolicy::GoToSafePosition)
            => "fall back from move 1#3.4/7: go to safe position",
        Output::CorridorOpened(Millis(1_900)) => "corridor opened for 1900 ms",
        Output::CorridorExtended(Millis(1_800)) => "corridor open for another 1800 ms",
        Output::RenewEpoch => "renew the boot counter",
        Output::CorridorClosed(engaged)
            => "corridor closed: station 2 is unable to do its task: execution limit",
        Output::LockIdentity => "lock identity",
        Output::UnlockIdentity => "unlock identity",
        Output::Notify(Notice::Joined(SESSION)) => "joined 1#3.4",
        Output::Ignored(Ignored::Unavailable(Unavailability::NotSafe))
            => "ignored: unavailable, not safe",
        Notice::CommandAcknowledged(GO2, MANEUVER) => "2 acknowledged 1#3.4/7",
        Notice::ManeuverInPosition(GO2, MANEUVER) => "2 in position for 1#3.4/7",
        Notice::OfferLapsed(GO2) => "the offer of 2 has lapsed",
        Notice::Yielded(GO2) => "place yielded to 2",
        Notice::FollowerSafeIdle(GO2, MANEUVER) => "2 fell back from 1#3.4/7",
    );
}

#[test]
fn a_robot_tells_its_state_and_what_it_says() {
    let mut robot = Robot::new(ARI, 3);
    assert_eq!(robot.to_string(), "Idle, none, available; says: RAM none");
    let detected = Event::PedestrianDetected(request());
    robot.step(&Config::default(), Input::Local(detected));
    assert_eq!(
        robot.to_string(),
        "HelpRequested, requester, available, session 1#3.0; says: RAM needHelp 1#3.0 \
         (2 x initialPos+move, high urgency, at 5:7), heartbeat 0"
    );
}
