//! What a robot is doing, as plain numbers.

use crossguard_protocol::{
    Availability, Corridor, Duty, Identity, Lease, Maneuver, Member, Order, Phase, Progress, Robot,
    Role, State,
};

use crate::abi::{
    CROSSGUARD_NONE_MS, CrossguardCorridor, CrossguardDuty, CrossguardFollower, CrossguardProgress,
    CrossguardRole, CrossguardState, CrossguardView,
};
use crate::why::unavailability;

impl CrossguardView {
    /// What `robot` is doing.
    pub(crate) fn of(robot: &Robot) -> Self {
        let mut view = Self {
            station: robot.station().0,
            next_due_ms: robot.next_due().map_or(CROSSGUARD_NONE_MS, |due| due.0),
            next_ram_ms: robot.next_ram().map_or(CROSSGUARD_NONE_MS, |due| due.0),
            session: robot.session().map(Into::into).unwrap_or_default(),
            boot: robot.boot(),
            state: state(robot.state()),
            role: role(robot.role()),
            unavailability: unavailability(match robot.availability() {
                Availability::Available => None,
                Availability::Unavailable(why) => Some(why),
            }),
            is_locked: (robot.identity() != Identity::Unlocked).into(),
            has_session: robot.session().is_some().into(),
            ..Self::default()
        };
        match robot.phase() {
            Phase::Leading(leading) => {
                view.corridor = corridor(leading.corridor);
                view.has_yielded = leading.yields_to.is_some().into();
                view.yields_to = leading.yields_to.map_or(0, |station| station.0);
                for (slot, member) in view.followers.iter_mut().zip(leading.members.iter()) {
                    *slot = follower(member);
                    view.followers_length += 1;
                }
            }
            Phase::Following(following) => {
                view.is_contact_lost = following.contact.is_lost().into();
                if let Some(job) = following.job {
                    view.progress = progress(job.progress) as u8;
                    view.request = job.request.0;
                    view.task = job.task.value();
                }
            }
            Phase::Idle | Phase::Requesting(_) | Phase::Offering(_) => {}
        }
        match robot.duty() {
            None => {}
            Some(Duty::FallingBack(Maneuver { id, task })) => {
                view.duty = CrossguardDuty::FallingBack as u8;
                view.duty_session = id.session.into();
                view.duty_request = id.request.0;
                view.duty_task = task.value();
            }
            Some(Duty::Crossing(session)) => {
                view.duty = CrossguardDuty::Crossing as u8;
                view.duty_session = session.into();
            }
        }
        view
    }
}

const fn state(state: State) -> u8 {
    let code = match state {
        State::Idle => CrossguardState::Idle,
        State::HelpRequested => CrossguardState::HelpRequested,
        State::RoleEstablished => CrossguardState::RoleEstablished,
        State::ManeuverExecuting => CrossguardState::ManeuverExecuting,
    };
    code as u8
}

const fn role(role: Role) -> u8 {
    let code = match role {
        Role::None => CrossguardRole::None,
        Role::Requester => CrossguardRole::Requester,
        Role::Helper => CrossguardRole::Helper,
        Role::Leader => CrossguardRole::Leader,
        Role::Follower => CrossguardRole::Follower,
    };
    code as u8
}

const fn corridor(corridor: Corridor) -> u8 {
    let code = match corridor {
        Corridor::Clear => CrossguardCorridor::Clear,
        Corridor::Open => CrossguardCorridor::Open,
        Corridor::Clearing => CrossguardCorridor::Clearing,
    };
    code as u8
}

const fn progress(progress: Progress) -> CrossguardProgress {
    match progress {
        Progress::Executing => CrossguardProgress::Executing,
        Progress::InPosition => CrossguardProgress::InPosition,
        Progress::Completed => CrossguardProgress::Completed,
        Progress::Failed(_) => CrossguardProgress::Failed,
        Progress::SafeIdle => CrossguardProgress::SafeIdle,
    }
}

fn follower(member: &Member) -> CrossguardFollower {
    let of_order = |order: Order| match order.progress {
        None => CrossguardProgress::Acknowledged,
        Some(reported) => progress(reported),
    };
    CrossguardFollower {
        station: member.station.0,
        has_joined: member.has_joined().into(),
        has_lease: matches!(member.lease, Lease::Stands(_)).into(),
        is_outstanding: member.outstanding.is_some().into(),
        progress: member.order.map_or(CrossguardProgress::None, of_order) as u8,
        request: member.order.map_or(0, |order| order.request.0),
        task: member.order.map_or(0, |order| order.task.value()),
        reserved: [0; 2],
    }
}
