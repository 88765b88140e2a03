//! An offer of a robot that cannot do what every follower of the plan is to do.

use crossguard_codec::Identifiers;
use crossguard_codec::geonet::Stack;
use crossguard_endpoint::Stimulus;
use crossguard_endpoint::cause::Cause;
use crossguard_protocol::{
    Coordination, Event, Heartbeat, HelpRequest, Millis, OfferNumber, Place, Role, SessionId,
    SessionNumber, StationId, TaskSet, TaskType, UniqueNumber, Urgency,
};

use crate::support::{endpoint, handle, hear, ram};

/// Hazard: a person waits as long as the robots that are free refuse a command of the plan, and the leader ends its session for it.
#[test]
fn an_offer_counts_if_it_has_what_every_follower_is_to_do() {
    let (me, helper) = (StationId(1), StationId(2));
    let asked = TaskSet::of(&[TaskType::INITIAL_POS, TaskType::MOVE]);
    let first = TaskSet::of(&[TaskType::INITIAL_POS]);
    let other = TaskSet::of(&[TaskType::BLOCK]);
    for (needs, capabilities, counts) in [
        (TaskSet::EMPTY, first, true),
        (first, first, true),
        (asked, first, false),
        (asked, asked, true),
        // A task that was not asked for is in no offer.
        (other, first, true),
    ] {
        let mut robot = endpoint(me);
        robot.needs(needs);
        let request = HelpRequest {
            urgency: Urgency::Medium,
            followers: 1,
            tasks: asked,
            place: Place::UNKNOWN,
        };
        handle(
            &mut robot,
            0,
            Stimulus::Event(Event::PedestrianDetected(request)),
        );
        let number = UniqueNumber { boot: 1, count: 0 };
        let offer = Coordination::OfferHelp {
            session: SessionId::of(me, SessionNumber(number)),
            offer: OfferNumber(number),
            capabilities,
            echo: Heartbeat(0),
            t_safety: Millis(2000),
        };
        let mut stack = Stack::of_robot(Identifiers::default(), helper);
        hear(&mut robot, 10, &ram(&mut stack, helper, offer));
        let leads = robot.robot().role() == Role::Leader;
        assert_eq!(leads, counts, "{needs} {capabilities}");
        let dropped = u64::from(!counts);
        assert_eq!(
            robot.counters().of(Cause::Unfit),
            dropped,
            "{needs} {capabilities}"
        );
    }
}
