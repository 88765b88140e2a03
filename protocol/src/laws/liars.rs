//! Laws of confinement: what a station that lies can do by one message is bounded by its own part.
//!
//! The sender of a message is the station that it names, which holds where packets are signed: a ticket is one station. The sender
//! may say anything, in any state of the robot. With these laws of one step it is so in runs of any length:
//!
//! The page of the verification has times for these.
//!
//! | who lies | what it can do | what it cannot do |
//! |---|---|---|
//! | a stranger | ask for help or lead at the same place, and by that reserve an idle robot, go before a request or a session, or close its corridor | end a session while people are on the road; start, stop or replace a maneuver; take or give a role in another session; open or extend a corridor; speak for a member |
//! | a follower | say that it guards where it does not, and leave | speak for another follower; open a corridor |
//! | a leader | command the robots that joined it, as long as its heartbeats come | command any other robot; end a duty on the road, but by the same command again |

use crate::id::StationId;
use crate::output::OutputKind;
use crate::state::{Corridor, Leading, Phase};

use super::part::{following, leading, record_of, requesting};
use super::road::takes_up;
use super::taken::Taken;

/// All laws of this module.
pub fn all(step: &Taken) {
    let Some(liar) = step.sender() else { return };
    a_stranger_does_not_move_a_follower(step, liar);
    a_maneuver_is_started_by_its_leader(step, liar);
    a_role_comes_from_the_leader_that_has_the_offer(step, liar);
    no_message_opens_a_corridor(step);
    a_follower_speaks_for_itself_alone(step, liar);
    a_stranger_closes_a_corridor_by_going_before(step, liar);
    an_offer_is_made_by_its_station(step, liar);
    no_message_ends_a_duty(step);
}

/// W: a robot that follows another leader goes on as if nothing had been said.
pub fn a_stranger_does_not_move_a_follower(step: &Taken, liar: StationId) {
    let follows_another = following(&step.before).is_some_and(|it| it.session.leader != liar);
    if follows_another {
        assert!(step.after.phase() == step.before.phase());
        assert!(!step.said.has(OutputKind::StartManeuver));
        assert!(!step.said.has(OutputKind::StopManeuver));
        assert!(!step.said.has(OutputKind::FallBack));
    }
}

/// I3: a maneuver is started by the word of the leader that the robot follows.
pub fn a_maneuver_is_started_by_its_leader(step: &Taken, liar: StationId) {
    if step.said.has(OutputKind::StartManeuver) {
        assert!(following(&step.before).is_some_and(|it| it.session.leader == liar));
    }
}

/// I2: a robot that becomes a follower becomes one of the sender, which it has offered its help to.
pub fn a_role_comes_from_the_leader_that_has_the_offer(step: &Taken, liar: StationId) {
    if let (None, Some(follows)) = (following(&step.before), following(&step.after)) {
        assert!(matches!(step.before.phase(), Phase::Offering(_)));
        assert!(step.before.session() == Some(follows.session));
        assert!(follows.session.leader == liar);
    }
}

/// I11: only the leader's own application opens a corridor.
pub fn no_message_opens_a_corridor(step: &Taken) {
    assert!(!step.said.has(OutputKind::CorridorOpened));
}

/// I17: the words of one station change no other follower, and extend no corridor unless it is a follower.
pub fn a_follower_speaks_for_itself_alone(step: &Taken, liar: StationId) {
    let Some(before) = leading(&step.before) else {
        return;
    };
    let is_own_member = record_of(before, liar).is_some();
    match leading(&step.after) {
        Some(after) => {
            for member in before.members.iter() {
                assert!(member.station == liar || after.members.iter().any(|it| it == member));
            }
            for member in after.members.iter() {
                assert!(record_of(before, member.station).is_some());
            }
        }
        // It gives way to a session at the same place that goes before, while nobody is on the road.
        None => assert!(is_own_member || before.corridor == Corridor::Clear),
    }
    if step.said.has(OutputKind::CorridorExtended) {
        assert!(is_own_member);
    }
}

/// L6: a robot without a part in a session closes its corridor only as a leader at the same place that goes before.
pub fn a_stranger_closes_a_corridor_by_going_before(step: &Taken, liar: StationId) {
    let Some(before) = leading(&step.before) else {
        return;
    };
    let after = leading(&step.after);
    let is_open = |it: &Leading| it.corridor == Corridor::Open;
    if is_open(before) && record_of(before, liar).is_none() && !after.is_some_and(is_open) {
        assert!(after.is_some_and(|it| it.yields_to == Some(liar)));
    }
}

/// I2: an offer is that of its sender, and leaves the others as they are.
pub fn an_offer_is_made_by_its_station(step: &Taken, liar: StationId) {
    let (Some(before), Some(after)) = (requesting(&step.before), requesting(&step.after)) else {
        return;
    };
    for offer in before.offers.iter() {
        assert!(offer.station == liar || after.offers.iter().any(|it| it == offer));
    }
    for offer in after.offers.iter() {
        assert!(offer.station == liar || before.offers.iter().any(|it| it == offer));
    }
}

/// W4: a duty on the road ends by the robot's own application, whatever anybody says. It may become the task of its leader
/// again.
pub fn no_message_ends_a_duty(step: &Taken) {
    if let Some(duty) = step.before.duty() {
        let is_taken_up = step
            .said
            .started
            .is_some_and(|it| takes_up(duty, it.id.session, it.task));
        assert!(is_taken_up || step.after.duty() == Some(duty));
    }
}
