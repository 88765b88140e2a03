//! Weakened rules that more than one test puts in the protocol's place.

use crossguard_model_check::node::Rules;
use crossguard_protocol::{
    Command, Config, Confirmation, Coordination, Corridor, CorridorClosure, Disengagement, Ending,
    Event, FallbackPolicy, Farewell, Ignored, Input, Maneuver, ManeuverId, Millis, Notice, Order,
    Output, Outputs, Phase, Progress, Ram, Report, Rmcm, Robot, Role, SessionId, Settings, Timer,
};
use serde_json::Value;

/// Declares weakenings: what each does in place of a step of the protocol.
#[macro_export]
macro_rules! weakenings {
    ($($(#[$doc:meta])* $vis:vis $name:ident($robot:pat_param, $config:pat_param, $input:pat_param) $body:block)*) => {$(
        $(#[$doc])*
        $vis struct $name;

        impl Rules for $name {
            fn step(&self, $robot: &mut Robot, $config: &Config, $input: Input) -> Outputs $body
        }
    )*};
}

/// Outputs of one kind never reach the robot.
pub struct Drops(pub fn(&Output) -> bool);

impl Rules for Drops {
    fn step(&self, robot: &mut Robot, config: &Config, input: Input) -> Outputs {
        let outputs = robot.step(config, input);
        outputs
            .iter()
            .copied()
            .filter(|output| !(self.0)(output))
            .collect()
    }
}

/// The corridor is not closed.
pub const NEVER_CLOSES_THE_CORRIDOR: Drops =
    Drops(|output| matches!(output, Output::CorridorClosed(_)));

/// A released robot is not stopped.
pub const NEVER_STOPS: Drops = Drops(|output| matches!(output, Output::StopManeuver(..)));

/// The identity is not locked.
pub const NEVER_LOCKS_ITS_IDENTITY: Drops = Drops(|output| matches!(output, Output::LockIdentity));

/// A leader's application is not told of a lost guard.
pub const TELLS_OF_NO_LOST_GUARD: Drops = Drops(|output| {
    let is_lost =
        |notice: Notice| matches!(notice, Notice::LeaseExpired(_) | Notice::FollowerGone(..));
    matches!(output, Output::Notify(notice) if is_lost(*notice))
});

/// An application is not told that its session has ended, and why.
pub const TELLS_OF_NO_END: Drops =
    Drops(|output| matches!(output, Output::Notify(Notice::SessionEnded(..))));

weakenings! {
    /// When one follower is gone, another one's lease goes too.
    pub LosesTwoForOne(robot, config, input) {
        let outputs = robot.step(config, input);
        let one_is_gone = outputs
            .notices()
            .any(|notice| matches!(notice, Notice::FollowerGone(..)));
        if let (true, Phase::Leading(leading)) = (one_is_gone, robot.phase()) {
            let others: Vec<_> = leading.members.iter().map(|m| m.station).collect();
            for station in others {
                robot.step(config, Input::Expired(Timer::Lease(station)));
            }
        }
        outputs
    }

    /// A follower has no timers.
    pub FollowersWaitForEver(robot, config, input) {
        let is_time = matches!(input, Input::Expired(_) | Input::Elapsed(_));
        if is_time && matches!(robot.phase(), Phase::Following(_)) {
            return only(Output::Ignored(Ignored::TimerNotArmed));
        }
        robot.step(config, input)
    }

    /// Whatever leader lists the robot, for whatever offer, has confirmed it.
    pub ConfirmsByStationAlone(robot, config, mut input) {
        let mine = match robot.phase() {
            Phase::Offering(offering) => Some(offering.number),
            Phase::Following(following) => Some(following.offer),
            _ => None,
        };
        if let (Some(mine), Input::Ram { ram, .. }) = (mine, &mut input)
            && let Coordination::Leader { followers, .. } = &mut ram.coordination
        {
            let offer = |c: &Confirmation| {
                if c.station == robot.station() {
                    mine
                } else {
                    c.offer
                }
            };
            *followers = followers
                .iter()
                .map(|c| Confirmation {
                    offer: offer(c),
                    ..*c
                })
                .collect();
        }
        robot.step(config, input)
    }

    /// A request for help counts as a confirmation.
    pub NeedsNoConfirmation(robot, config, mut input) {
        if let (Phase::Offering(offering), Input::Ram { ram, .. }) = (robot.phase(), &mut input)
            && let Coordination::NeedHelp {
                number,
                heartbeat,
                request,
            } = ram.coordination
        {
            let me = Confirmation {
                station: robot.station(),
                offer: offering.number,
            };
            ram.coordination = Coordination::Leader {
                number,
                heartbeat,
                followers: [me].into_iter().collect(),
                urgency: request.urgency,
                place: request.place,
                yields: false,
            };
        }
        robot.step(config, input)
    }

    /// The session that a command names is not looked at.
    pub ObeysCommandsOfAnySession(robot, config, mut input) {
        if let (Phase::Following(following), Input::Rmcm(Rmcm::Command(command))) =
            (robot.phase(), &mut input)
        {
            command.session = following.session;
        }
        robot.step(config, input)
    }

    /// A repeated command is started like a new one.
    pub StartsRepeatedCommands(robot, config, input) {
        let job = match robot.phase() {
            Phase::Following(following) => following.job,
            _ => None,
        };
        let outputs = robot.step(config, input);
        match (input, job) {
            (Input::Rmcm(Rmcm::Command(command)), Some(job))
                if job.request == command.request && outputs.ignored().is_none() =>
            {
                outputs.iter().copied().chain([start_of(&command)]).collect()
            }
            _ => outputs,
        }
    }

    /// An older command is started like a new one.
    pub StartsOlderCommands(robot, config, input) {
        match (robot.phase(), input) {
            (Phase::Following(following), Input::Rmcm(Rmcm::Command(command)))
                if command.session == following.session
                    && following
                        .job
                        .is_some_and(|job| job.request.is_newer_than(command.request)) =>
            {
                only(start_of(&command))
            }
            _ => robot.step(config, input),
        }
    }

    /// Any acknowledgement is taken for that of the outstanding command.
    pub TakesAnyAcknowledgement(robot, config, mut input) {
        if let (Phase::Leading(leading), Input::Rmcm(Rmcm::Answer(answer))) =
            (robot.phase(), &mut input)
            && let Some(outstanding) = leading.member(answer.from).and_then(|m| m.outstanding)
        {
            answer.request = outstanding.request;
        }
        robot.step(config, input)
    }

    /// Progress in a RAM is taken for that of the newest command, as in the paper.
    pub TakesAnyProgress(robot, config, mut input) {
        if let (Phase::Leading(leading), Input::Ram { ram, .. }) = (robot.phase(), &mut input)
            && let Coordination::Follower {
                last: Some(report), ..
            } = &mut ram.coordination
            && let Some(order) = leading.member(ram.station).and_then(|member| member.order)
        {
            report.request = order.request;
        }
        robot.step(config, input)
    }

    /// A follower that changes its pseudonym takes that of its leader.
    pub TakesItsLeadersPseudonym(robot, config, input) {
        if let (Phase::Following(following), Input::Local(Event::IdentityChanged(..))) =
            (robot.phase(), input)
        {
            let leader = serde_json::to_value(following.session.leader).unwrap();
            with_state(robot, |state| state["station"] = leader);
            return Outputs::default();
        }
        robot.step(config, input)
    }

    /// A leader does not read the progress in its followers' RAM.
    pub ReadsNoProgress(robot, config, mut input) {
        if let Input::Ram { ram, .. } = &mut input
            && let Coordination::Follower { last, .. } = &mut ram.coordination
        {
            *last = None;
        }
        robot.step(config, input)
    }

    /// A command is repeated once more than it may be.
    pub RepeatsOnceTooOften(robot, config, input) {
        let patient = Settings {
            n_ack: config.settings().n_ack + 1,
            ..config.settings().clone()
        };
        robot.step(&Config::new(patient).unwrap(), input)
    }

    /// A requester asks for one follower fewer than its pedestrian needs.
    pub AsksForFewer(robot, config, mut input) {
        if let Input::Local(Event::PedestrianDetected(request)) = &mut input {
            request.followers -= 1;
        }
        robot.step(config, input)
    }

    /// Every fallback is to stop where the robot is.
    pub StopsInPlace(robot, config, input) {
        let outputs = robot.step(config, input);
        let stop = |output: &Output| match *output {
            Output::FallBack(maneuver, _) => {
                Output::FallBack(maneuver, FallbackPolicy::StopInPlace)
            }
            output => output,
        };
        outputs.iter().map(stop).collect()
    }

    /// A requester does not listen to others, and does not give up.
    pub InsistsOnItsRequest(robot, config, input) {
        let is_deaf = match input {
            Input::Ram { ram, .. } => matches!(ram.coordination, Coordination::NeedHelp { .. }),
            Input::Expired(Timer::Help | Timer::IdentityLock) => true,
            _ => false,
        };
        if is_deaf && matches!(robot.phase(), Phase::Requesting(_)) {
            return only(Output::Ignored(Ignored::LowerPrecedence));
        }
        robot.step(config, input)
    }

    /// A robot in a session sends a RAM for each that it hears.
    pub AnswersEveryRam(robot, config, input) {
        let outputs = robot.step(config, input);
        let is_led = matches!(robot.phase(), Phase::Leading(_) | Phase::Following(_));
        if !is_led || !matches!(input, Input::Ram { .. }) {
            return outputs;
        }
        let effects = outputs.iter().copied();
        let effects =
            effects.filter(|output| !matches!(output, Output::Ignored(_) | Output::SendRam));
        effects.chain([Output::SendRam]).collect()
    }

    /// A leader does not listen to other leaders.
    pub HearsNoLeader(robot, config, input) {
        if let (Phase::Leading(_), Input::Ram { ram, .. }) = (robot.phase(), input)
            && matches!(ram.coordination, Coordination::Leader { .. })
        {
            return only(Output::Ignored(Ignored::LowerPrecedence));
        }
        robot.step(config, input)
    }

    /// A leader notes the newest of other leaders alone.
    pub HidesOneLeaderByAnother(robot, config, input) {
        if let (Phase::Leading(leading), Input::Ram { ram, .. }) = (robot.phase(), input)
            && let (Some(rival), Coordination::Leader { number, .. }) = (leading.rival, ram.coordination)
            && rival.session != SessionId::of(ram.station, number)
            && leading.yields_to.is_none()
        {
            with_state(robot, |state| state["phase"]["leading"]["rival"] = Value::Null);
        }
        robot.step(config, input)
    }

    /// A robot has forgotten its duty as soon as somebody asks for help.
    pub ForgetsItsDuty(robot, config, input) {
        if let (Phase::Idle, Some(_), Input::Ram { ram, .. }) = (robot.phase(), robot.duty(), input)
            && matches!(ram.coordination, Coordination::NeedHelp { .. })
        {
            let forgets = |state: &mut Value| state["duty"] = Value::Null;
            let obeys = |_: &Robot, outputs: &Outputs| outputs.ignored().is_none();
            return step_if(robot, config, input, forgets, obeys);
        }
        robot.step(config, input)
    }

    /// A follower on duty obeys any command of its leader.
    pub ObeysOnDuty(robot, config, input) {
        if robot.duty().is_some() && matches!(input, Input::Rmcm(Rmcm::Command(_))) {
            let forgets = |state: &mut Value| state["duty"] = Value::Null;
            let starts = |_: &Robot, outputs: &Outputs| {
                outputs.iter().any(|it| matches!(it, Output::StartManeuver(_)))
            };
            return step_if(robot, config, input, forgets, starts);
        }
        robot.step(config, input)
    }

    /// A leader does not read that a follower has left its place.
    pub ReadsNoLoss(robot, config, mut input) {
        let known = Some(Progress::InPosition);
        if let Input::Ram { ram, .. } = &mut input
            && let Some((order, report)) = order_and_report(robot, ram)
            && (order.progress, report.progress) == (known, Progress::Executing)
        {
            report.progress = Progress::InPosition;
        }
        robot.step(config, input)
    }

    /// A leader takes the position of a late RAM for one that was taken again.
    pub BelievesOldPositions(robot, config, input) {
        let outputs = robot.step(config, input);
        if let Input::Ram { mut ram, .. } = input
            && let Some((order, report)) = order_and_report(robot, &mut ram)
            && order.progress == Some(Progress::Executing)
            && report.progress == Progress::InPosition
        {
            let station = serde_json::to_value(ram.station).unwrap();
            with_state(robot, |state| {
                let members = state["phase"]["leading"]["members"].as_array_mut();
                for member in members.unwrap() {
                    if member["station"] == station {
                        member["order"]["progress"] =
                            serde_json::to_value(Progress::InPosition).unwrap();
                    }
                }
            });
            // What was ignored is not any more.
            let is_ignored = |output: &&Output| matches!(output, Output::Ignored(_));
            return outputs.iter().filter(|it| !is_ignored(it)).copied().collect();
        }
        outputs
    }

    /// A follower that sees somebody stops all the same when its leader says that the crossing is completed.
    pub TrustsItsLeaderAlone(robot, config, input) {
        if let (Phase::Following(following), Input::Ram { ram, .. }) = (robot.phase(), input)
            && following.sees_people
            && matches!(ram.farewell, Some(Farewell::Ended(_, Ending::Completed)))
        {
            let sees_nobody =
                |state: &mut Value| state["phase"]["following"]["seesPeople"] = false.into();
            let leaves = |robot: &Robot, _: &Outputs| robot.role() != Role::Follower;
            return step_if(robot, config, input, sees_nobody, leaves);
        }
        robot.step(config, input)
    }

    /// A follower starts before it acknowledges (rule R7, property I6).
    pub StartsBeforeItAcknowledges(robot, config, input) {
        let outputs = robot.step(config, input);
        let is_start = |output: &&Output| matches!(output, Output::StartManeuver(_));
        let starts = outputs.iter().filter(is_start);
        let others = outputs.iter().filter(|output| !is_start(output));
        starts.chain(others).copied().collect()
    }

    /// What one follower says of itself counts for all followers of the session.
    pub CountsOneForAll(robot, config, input) {
        let members: Vec<_> = match robot.phase() {
            Phase::Leading(leading) => leading.members.iter().map(|it| it.station).collect(),
            _ => Vec::new(),
        };
        let mut outputs: Vec<_> = robot.step(config, input).iter().copied().collect();
        if let Input::Ram { mut ram, distance } = input
            && matches!(ram.coordination, Coordination::Follower { .. })
            && members.contains(&ram.station)
        {
            let sender = ram.station;
            for other in members.into_iter().filter(|other| *other != sender) {
                ram.station = other;
                let more = robot.step(config, Input::Ram { ram, distance });
                if more.ignored().is_none() {
                    outputs.retain(|output| !matches!(output, Output::Ignored(_)));
                    outputs.extend(more.iter().copied());
                }
            }
        }
        outputs.into_iter().collect()
    }

    /// Any robot that says that it follows in the session is a follower there, with the record of the first.
    pub AdmitsWhoSaysThatItFollows(robot, config, input) {
        if let (Some(own), Phase::Leading(leading), Input::Ram { ram, .. }) =
            (robot.session(), robot.phase(), input)
            && let Coordination::Follower { session, .. } = ram.coordination
            && session == own
            && leading.member(ram.station).is_none()
        {
            with_state(robot, |state| {
                let members = &mut state["phase"]["leading"]["members"];
                let mut member = members[0].clone();
                member["station"] = serde_json::to_value(ram.station).unwrap();
                members.as_array_mut().unwrap().push(member);
            });
        }
        robot.step(config, input)
    }
}

/// The command that a leader counts on, and what a RAM of its follower reports of it.
fn order_and_report<'a>(robot: &Robot, ram: &'a mut Ram) -> Option<(Order, &'a mut Report)> {
    let Phase::Leading(leading) = robot.phase() else {
        return None;
    };
    let order = leading.member(ram.station)?.order?;
    match &mut ram.coordination {
        Coordination::Follower {
            last: Some(report), ..
        } if report.request == order.request => Some((order, report)),
        _ => None,
    }
}

/// What a robot puts out that starts the maneuver of a command.
fn start_of(command: &Command) -> Output {
    let (id, task) = (
        ManeuverId::of(command.session, command.request),
        command.task,
    );
    Output::StartManeuver(Maneuver { id, task })
}

/// No output but this one.
pub fn only(output: Output) -> Outputs {
    [output].into_iter().collect()
}

/// A step of the robot with its state changed, if `is` so after it, and otherwise of the robot as it is.
fn step_if(
    robot: &mut Robot,
    config: &Config,
    input: Input,
    change: impl FnOnce(&mut Value),
    is: impl FnOnce(&Robot, &Outputs) -> bool,
) -> Outputs {
    let mut changed = robot.clone();
    with_state(&mut changed, change);
    let outputs = changed.step(config, input);
    if !is(&changed, &outputs) {
        return robot.step(config, input);
    }
    *robot = changed;
    outputs
}

/// The robot with one value of its state replaced, as it stands in a log.
pub fn with_state(robot: &mut Robot, change: impl FnOnce(&mut Value)) {
    let mut state = serde_json::to_value(&*robot).unwrap();
    change(&mut state);
    *robot = serde_json::from_value(state.clone()).unwrap();
    let is_read = serde_json::to_value(&*robot).unwrap() == state;
    assert!(is_read, "there is no such field in {state}");
}

/// Each check that stands before an open corridor, alone. Removed from the protocol, three of them went unnoticed once.
pub const CHECKS_OF_AN_OPEN_CORRIDOR: [fn(CorridorClosure) -> bool; 7] = {
    use CorridorClosure::{FollowerMissing, NotEngaged};
    use Disengagement as D;
    [
        |why| why == FollowerMissing,
        |why| matches!(why, NotEngaged(_, D::NoLease)),
        |why| matches!(why, NotEngaged(_, D::CommandOutstanding)),
        |why| matches!(why, NotEngaged(_, D::NotExecuting)),
        |why| matches!(why, NotEngaged(_, D::NotGuarding)),
        |why| matches!(why, NotEngaged(_, D::NotInPosition)),
        |why| {
            matches!(
                why,
                NotEngaged(_, D::Completed | D::Failed(_) | D::SafeIdle)
            )
        },
    ]
};

/// A leader overlooks some of what stands in the way of an open corridor.
pub struct Overlooks(pub fn(CorridorClosure) -> bool);

impl Rules for Overlooks {
    fn step(&self, robot: &mut Robot, config: &Config, input: Input) -> Outputs {
        let outputs = robot.step(config, input);
        let is_overlooked = |why: Ignored| match why {
            Ignored::NotEngaged(station, why) => {
                (self.0)(CorridorClosure::NotEngaged(station, why))
            }
            Ignored::FollowerMissing => (self.0)(CorridorClosure::FollowerMissing),
            _ => false,
        };
        let is_open =
            |output: &Output| matches!(output, Output::CorridorClosed(why) if (self.0)(*why));
        let opens = outputs.ignored().is_some_and(is_overlooked);
        if !opens && !outputs.iter().any(is_open) {
            return outputs;
        }
        if !matches!(robot.phase(), Phase::Leading(_)) {
            return outputs;
        }
        with_state(robot, |state| {
            state["phase"]["leading"]["corridor"] = serde_json::to_value(Corridor::Open).unwrap();
        });
        if opens {
            return only(Output::CorridorOpened(Millis(1)));
        }
        let kept = outputs.iter().copied().filter(|output| !is_open(output));
        kept.collect()
    }
}
