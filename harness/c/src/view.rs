//! State of a robot, as plain numbers.

use crossguard_protocol::{
    Availability, Duty, Identity, Lease, Maneuver, Member, Order, Phase, Robot,
};

use crate::abi::{
    CROSSGUARD_NONE_MS, CrossguardDuty, CrossguardFollower, CrossguardProgress, CrossguardView,
};

impl CrossguardView {
    pub(crate) fn of(robot: &Robot) -> Self {
        let mut view = Self {
            station: robot.station().0,
            next_due_ms: robot.next_due().map_or(CROSSGUARD_NONE_MS, |due| due.0),
            next_ram_ms: robot.next_ram().map_or(CROSSGUARD_NONE_MS, |due| due.0),
            session: robot.session().map(Into::into).unwrap_or_default(),
            boot: robot.boot(),
            state: robot.state().code(),
            role: robot.role().code(),
            unavailability: unavailability(robot.availability()),
            is_locked: (robot.identity() != Identity::Unlocked).into(),
            has_session: robot.session().is_some().into(),
            ..Self::default()
        };
        match robot.phase() {
            Phase::Leading(leading) => {
                view.corridor = leading.corridor.code();
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
                    view.progress = job.progress.kind().code();
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

/// The code of why a robot is unavailable; 0 where it is not.
pub(crate) fn unavailability(availability: Availability) -> u8 {
    match availability {
        Availability::Available => 0,
        Availability::Unavailable(why) => why.code(),
    }
}

fn follower(member: &Member) -> CrossguardFollower {
    let of_order = |order: Order| match order.progress {
        None => CrossguardProgress::Acknowledged as u8,
        Some(reported) => reported.kind().code(),
    };
    CrossguardFollower {
        station: member.station.0,
        has_joined: member.has_joined().into(),
        has_lease: matches!(member.lease, Lease::Stands(_)).into(),
        is_outstanding: member.outstanding.is_some().into(),
        progress: member.order.map_or(0, of_order),
        request: member.order.map_or(0, |order| order.request.0),
        task: member.order.map_or(0, |order| order.task.value()),
        reserved: [0; 2],
    }
}
