//! Hazard: a rule looks at the first guards of a corridor and not at all of them, and people step on a road that the last
//! guard has left. Each test breaks one guard of sixteen, each in turn.

use crossguard_protocol::*;

use crate::script::*;

/// A leader and as many guards as it can have.
fn stations() -> Vec<StationId> {
    let guards = u32::try_from(MAX_FOLLOWERS).unwrap();
    (1..=1 + guards).map(StationId).collect()
}

fn extends(output: &Output) -> bool {
    matches!(output, Output::CorridorExtended(_))
}

/// The guards, each with an open street of its own.
fn each_guard() -> impl Iterator<Item = (StationId, Street)> {
    let street = |guard| (guard, Street::open(&stations(), TaskType::BLOCK));
    stations().into_iter().skip(1).map(street)
}

#[test]
fn each_guard_that_leaves_its_position_closes_the_corridor() {
    for (guard, mut street) in each_guard() {
        let id = street.executes(guard).id;
        street.tell(guard, Event::OutOfPosition(id));
        let why = CorridorClosure::NotEngaged(guard, Disengagement::NotInPosition);
        assert!(street.has_put_out(ARI, Output::CorridorClosed(why)));
    }
}

#[test]
fn go_ends_with_the_lease_on_any_guard_that_is_heard_no_more() {
    for (guard, mut street) in each_guard() {
        street.cut(guard, ARI);
        street.pass(300);
        assert!(street.count(ARI, extends) > 0, "the others are heard");
        street.hang(ARI);
        street.pass(street.config.settings().t_lease.0 - 300);
        assert!(!street.shows_go(ARI), "{guard} may have fallen back");
    }
}

#[test]
fn each_guard_has_time_to_cross() {
    for (guard, mut street) in each_guard() {
        street.tell(ARI, Event::CloseCorridor);
        street.tell(ARI, Event::RoadClear);
        let settings = street.config.settings();
        // The command of this guard is older than those of the others, by more than a crossing leaves it.
        let t_exec = settings.t_exec[usize::from(TaskType::BLOCK.value())];
        street.pass(t_exec.0 - settings.t_cross.0);
        for &other in stations()[1..].iter().filter(|&&other| other != guard) {
            street.tell(ARI, order(other, TaskType::BLOCK));
            street.in_position(other);
        }
        let refused = street.tell(ARI, Event::OpenCorridor);
        assert_ignored(&refused, Ignored::NotEnoughTime);
        street.tell(ARI, order(guard, TaskType::BLOCK));
        street.in_position(guard);
        assert_eq!(street.tell(ARI, Event::OpenCorridor).ignored(), None);
    }
}

#[test]
fn no_guard_is_commanded_while_people_may_be_on_the_road() {
    for (guard, mut street) in each_guard() {
        let refused = street.tell(ARI, order(guard, TaskType::MOVE));
        assert_ignored(&refused, Ignored::RoadOccupied);
    }
}

#[test]
fn each_guard_that_fails_closes_the_corridor() {
    for (guard, mut street) in each_guard() {
        let id = street.executes(guard).id;
        street.tell(guard, Event::ManeuverFailed(id));
        assert_eq!(street.corridor(ARI), Corridor::Clearing, "{guard}");
    }
}
