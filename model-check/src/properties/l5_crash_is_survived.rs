//! L5: if the leader crashes for good, every follower stops and is `Idle`.
//!
//! Within which time is what the timed view finds.

use super::prelude::*;

property! {
    "L5", Authentication::NAMES;
    untimed L "a permanent crash of a leader leads to its followers being stopped and idle",
        Some("a robot follows one that has crashed for good"),
        Rule::Live(LivenessRule {
            to: Some(|view, LivenessSubject { robot, .. }| {
                view.node(robot).is_idle() && view.node(robot).actuation.running().is_none()
            }),
            ..LivenessRule::ends(LivenessSubjects::Robots, has_lost_its_leader)
        }),
        "FollowersWaitForEver";
    timed L "after the leader's crash a follower stops, and is idle, within the bounds",
        Some("the leader crashes while a follower executes"),
        Rule::Timed(TimedRule { holds: is_survived_in_time, premise: &[TimedPremise::State(crashes_while_executed)], ends_run: true }),
        "follows_too_long";
}

fn has_lost_its_leader(view: &View, LivenessSubject { robot, .. }: LivenessSubject) -> bool {
    view.node(robot).following().is_some_and(|following| {
        let leader = view.world.place_of(following.session.leader);
        leader.is_some_and(|leader| view.node(leader).robot.is_none())
            && view.world.restarts_are_over()
    })
}

fn is_survived_in_time(step: &TimedStepView) -> bool {
    let after = step.after;
    let StopWatch::LeaderDown(ticks) = after.watch else {
        return true;
    };
    let limits = after.limits;
    let runs = after.nodes().any(|node| node.actuation.running().is_some());
    let follows = after.nodes().any(|node| node.following().is_some());
    let goes_on = runs && after.is_over(ticks, limits.stopped);
    let stays = follows && after.is_over(ticks, limits.left);
    !goes_on && !stays
}

fn crashes_while_executed(view: &TimedView) -> bool {
    let runs = |node: &Node| node.actuation.running().is_some();
    view.watch == StopWatch::LeaderDown(0) && view.nodes().any(runs)
}
