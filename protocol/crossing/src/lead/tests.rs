//! How a plan goes: who is commanded what, how often, and when the leader gives up.

use std::vec::Vec;

use crossguard_protocol::{
    EndReason, GoneReason, ManeuverId, RequestId, SessionId, SessionNumber, TaskSet, TaskType,
    Unavailability, UniqueNumber,
};

use super::*;
use crate::ground::Point;
use crate::input::Outputs;
use crate::plan::{Stage, Who};

const FIRST: StationId = StationId(2);
const SECOND: StationId = StationId(3);
const PLACE: Point = Point::new(600, 500);

fn leg(task: TaskType, to: Point) -> Leg {
    Leg {
        task,
        to,
        speed_mmps: 1_000,
        heading_ddeg: None,
    }
}

fn plan(stages: impl IntoIterator<Item = Stage>) -> Plan {
    Plan {
        followers: 1,
        stages: stages.into_iter().collect(),
        roles: List::EMPTY,
        own_place: None,
        patience: Millis(60_000),
        kerbs: None,
    }
}

fn blocking() -> Plan {
    plan([Stage::everybody(leg(TaskType::BLOCK, PLACE))])
}

/// A leader and what it has said, in words.
struct Leader {
    setup: Setup,
    plan: Plan,
    lead: Lead,
    view: View,
    request: u8,
}

impl Leader {
    fn of(plan: Plan) -> Self {
        let view = View {
            corridor: Corridor::Clear,
            own: Presence::NOWHERE,
            hindrance: None,
            is_wanted: true,
            has_opened: false,
            has_crossed: false,
            everybody_is_across: false,
            nobody_is_lost: false,
            was_seen: false,
        };
        Self {
            setup: Setup::default(),
            lead: Lead::new(&plan, false),
            plan,
            view,
            request: 0,
        }
    }

    fn id(&self) -> ManeuverId {
        let number = SessionNumber(UniqueNumber { boot: 1, count: 0 });
        let leader = StationId(1);
        let session = SessionId { leader, number };
        let request = RequestId(self.request);
        ManeuverId { session, request }
    }

    fn hear(&mut self, notice: Notice) -> Vec<Output> {
        let mut out = Outputs::EMPTY;
        let (setup, view) = (&self.setup, self.view);
        self.lead.notice(setup, &self.plan, &view, notice, &mut out);
        out.iter().copied().collect()
    }

    fn joins(&mut self, station: StationId) -> Vec<Output> {
        self.hear(Notice::FollowerJoined(station))
    }

    fn is_at(&mut self, station: StationId, at: Point) {
        let pose = Some(Pose { at, error_cm: 0 });
        let (setup, plan) = (&self.setup, &self.plan);
        self.lead
            .follower_is_at(setup, plan, station, pose, Millis::ZERO);
    }

    fn reports_from(&mut self, station: StationId, at: Point) -> Vec<Output> {
        self.is_at(station, at);
        self.hear(Notice::ManeuverInPosition(station, self.id()))
    }

    fn pass(&mut self, ms: u32) -> Vec<Output> {
        let mut out = Outputs::EMPTY;
        self.lead.elapse(&self.setup, Millis(ms));
        let view = self.view;
        self.lead.lead_on(&self.setup, &self.plan, &view, &mut out);
        out.iter().copied().collect()
    }
}

fn words(outputs: &[Output]) -> Vec<&'static str> {
    let word = |output: &Output| match output {
        Output::Order(..) => "order",
        Output::Tell(Event::OpenCorridor) => "open",
        Output::Tell(Event::CloseCorridor) => "close",
        Output::Tell(Event::TaskCompleted) => "completed",
        Output::Tell(Event::LeaveRequested) => "give up",
        _ => "other",
    };
    outputs.iter().map(word).collect()
}

#[test]
fn a_follower_that_reports_from_elsewhere_is_commanded_again_and_in_the_end_given_up() {
    for (at, expected) in [
        (PLACE, "open"),
        (Point::new(600, 650), "open"),
        (Point::new(600, 701), "order"),
    ] {
        let mut leader = Leader::of(blocking());
        assert_eq!(words(&leader.joins(FIRST)), ["order"]);
        assert_eq!(words(&leader.reports_from(FIRST, at)), [expected], "{at:?}");
    }
    let mut leader = Leader::of(blocking());
    leader.joins(FIRST);
    let away = Point::new(600, 820);
    for expected in ["order", "order", "give up"] {
        assert_eq!(words(&leader.reports_from(FIRST, away)), [expected]);
    }
}

/// Nobody knows where it is, so nobody crosses.
#[test]
fn a_follower_whose_position_nobody_knows_opens_nothing() {
    let mut leader = Leader::of(blocking());
    leader.joins(FIRST);
    assert_eq!(
        words(&leader.hear(Notice::ManeuverInPosition(FIRST, leader.id()))),
        [""; 0]
    );
    assert_eq!(words(&leader.pass(5_000)), [""; 0]);
    leader.is_at(FIRST, PLACE);
    assert_eq!(words(&leader.pass(500)), ["open"]);
    // At most each half second.
    assert_eq!(words(&leader.pass(400)), [""; 0]);
    leader.is_at(FIRST, PLACE);
    assert_eq!(words(&leader.pass(100)), ["open"]);
}

/// An escort on its way to the kerb when everybody is across; and then somebody else comes to the kerb behind it.
#[test]
fn a_leader_waits_for_its_escort_and_opens_for_nobody_else_meanwhile() {
    for is_wanted in [false, true] {
        let mut leader = Leader::of(plan([Stage::everybody(leg(TaskType::MOVE, PLACE))]));
        leader.setup.guarding = TaskSet::of(&[TaskType::MOVE]);
        leader.joins(FIRST);
        leader.is_at(FIRST, Point::new(600, 0));
        leader.view.is_wanted = is_wanted;
        leader.view.has_opened = true;
        leader.view.has_crossed = true;
        leader.view.was_seen = true;
        assert_eq!(words(&leader.pass(500)), [""; 0], "the road is not clear");
        leader.view.was_seen = false;
        leader.view.nobody_is_lost = true;
        leader.view.everybody_is_across = !is_wanted;
        for _ in 0..9 {
            leader.is_at(FIRST, Point::new(600, 100));
            assert_eq!(words(&leader.pass(500)), [""; 0], "the escort walks");
        }
        leader.is_at(FIRST, Point::new(600, 100));
        assert_eq!(words(&leader.pass(500)), ["completed"], "it stands");
    }
}

#[test]
fn a_rejected_command_is_repeated_half_a_second_later_and_never_to_who_is_unavailable() {
    let mut leader = Leader::of(blocking());
    leader.joins(FIRST);
    let rejected =
        |leader: &mut Leader, why| leader.hear(Notice::CommandRejected(FIRST, leader.id(), why));
    assert_eq!(
        words(&rejected(&mut leader, Rejection::UnsupportedTask)),
        [""; 0]
    );
    assert_eq!(words(&leader.pass(499)), [""; 0]);
    assert_eq!(words(&leader.pass(1)), ["order"]);
    let stop = Unavailability::EmergencyStop;
    let out = rejected(&mut leader, Rejection::Unavailable(stop));
    assert_eq!(words(&out), ["give up"]);
}

#[test]
fn a_leg_that_fails_again_and_again_is_given_up_after_three_attempts() {
    let mut leader = Leader::of(blocking());
    let mut said = words(&leader.joins(FIRST));
    for _ in 0..5 {
        let failed = Notice::ManeuverFailed(FIRST, leader.id(), Failure::Maneuver);
        said.extend(words(&leader.hear(failed)));
        said.extend(words(&leader.pass(500)));
    }
    assert_eq!(said[..4], ["order", "order", "order", "give up"]);
    assert!(!said[4..].contains(&"order"));
    // A part that was begun well has all its attempts before it.
    let mut leader = Leader::of(blocking());
    leader.joins(FIRST);
    for _ in 0..5 {
        leader.reports_from(FIRST, PLACE);
        leader.pass(500);
        let safe_idle = Notice::FollowerSafeIdle(FIRST, leader.id());
        let mut said = words(&leader.hear(safe_idle));
        said.extend(words(&leader.pass(500)));
        assert!(
            said.contains(&"order") && !said.contains(&"give up"),
            "{said:?}"
        );
    }
}

/// Two dogs were sent to one point.
#[test]
fn followers_with_the_same_part_are_sent_to_places_apart() {
    for kerbs in [None, Some([Point::new(0, -50), Point::new(0, 750)])] {
        let mut leader = Leader::of(Plan {
            followers: 5,
            kerbs,
            ..blocking()
        });
        let mut places: Vec<Point> = Vec::new();
        for station in (2..7).map(StationId) {
            let out = leader.joins(station);
            let [Output::Order(to, leg)] = out[..] else {
                panic!("{out:?}")
            };
            assert_eq!(to, station);
            assert!(
                places.iter().all(|it| it.distance_cm(leg.to) >= 149),
                "{places:?}"
            );
            places.push(leg.to);
        }
    }
}

#[test]
fn roles_go_to_who_they_are_for_and_a_spare_follower_has_none() {
    let part = |role, task, to| (Who::Role(role), leg(task, to));
    let parts = [
        part(0, TaskType::BLOCK, PLACE),
        part(1, TaskType::INITIAL_POS, Point::default()),
    ];
    let stage = Stage {
        parts: parts.into_iter().collect(),
    };
    let mut leader = Leader::of(Plan {
        followers: 2,
        roles: [Some(SECOND), None].into_iter().collect(),
        ..plan([stage])
    });
    let task = |out: &[Output]| match out {
        [Output::Order(_, leg)] => Some(leg.task),
        _ => None,
    };
    assert_eq!(task(&leader.joins(FIRST)), Some(TaskType::INITIAL_POS));
    assert_eq!(task(&leader.joins(SECOND)), Some(TaskType::BLOCK));
    assert_eq!(leader.joins(StationId(4)), []);
    let gone = |station| Notice::FollowerGone(station, GoneReason::Left);
    assert_eq!(
        words(&leader.hear(gone(StationId(4)))),
        [""; 0],
        "nobody misses it"
    );
    assert_eq!(
        words(&leader.hear(gone(StationId(9)))),
        [""; 0],
        "it never came"
    );
    assert_eq!(words(&leader.hear(gone(FIRST))), ["give up"]);
}

#[test]
fn a_stage_begins_when_everybody_has_done_their_part_of_the_one_before() {
    let ahead = Stage::everybody(leg(TaskType::INITIAL_POS, Point::default()));
    let block = Stage::everybody(leg(TaskType::BLOCK, PLACE));
    let mut leader = Leader::of(Plan {
        followers: 2,
        ..plan([ahead, block])
    });
    leader.joins(FIRST);
    let done = |leader: &mut Leader, station| {
        words(&leader.hear(Notice::ManeuverCompleted(station, leader.id())))
    };
    assert_eq!(
        done(&mut leader, FIRST),
        [""; 0],
        "the other has not come yet"
    );
    leader.joins(SECOND);
    assert_eq!(done(&mut leader, SECOND), ["order", "order"]);
    assert_eq!(leader.lead.stage(), 1);
    leader.reports_from(FIRST, PLACE);
    assert_eq!(
        words(&leader.pass(1_000)),
        [""; 0],
        "one guard is not there"
    );
}

/// The escort is across, and nobody came along.
#[test]
fn an_escort_is_commanded_anew_at_the_opening_period_and_not_without_end() {
    let mut leader = Leader::of(plan([Stage::everybody(leg(TaskType::MOVE, PLACE))]));
    let mut orders = words(&leader.joins(FIRST)).len();
    let mut count = orders;
    for _ in 0..1_000 {
        if count > 0 {
            leader.hear(Notice::ManeuverReported(FIRST, leader.id()));
            leader.hear(Notice::ManeuverCompleted(FIRST, leader.id()));
        }
        let out = leader.pass(10);
        let ordered = out.iter().filter(|it| matches!(it, Output::Order(..)));
        count = ordered.count();
        orders += count;
    }
    assert!((15..=21).contains(&orders), "{orders} orders in 10 s");
}

#[test]
fn an_escort_waits_until_nothing_hinders() {
    let mut leader = Leader::of(plan([Stage::everybody(leg(TaskType::MOVE, PLACE))]));
    leader.view.hindrance = Some(Hindrance::NoSight);
    assert_eq!(leader.joins(FIRST), []);
    assert_eq!(leader.pass(5_000), []);
    leader.view.hindrance = None;
    assert_eq!(words(&leader.pass(100)), ["order"]);
}

/// Hazard: go is shown, and vehicles and guards wait, for as long as people come, or somebody stands at the kerb who does not
/// mean to cross.
#[test]
fn twenty_seconds_after_the_first_go_the_team_lets_nobody_on_the_road_and_ends_once_that_is_clear()
{
    for was_seen in [true, false] {
        let mut leader = Leader::of(blocking());
        leader.joins(FIRST);
        leader.reports_from(FIRST, PLACE);
        leader.pass(30_000);
        (leader.view.corridor, leader.view.has_opened) = (Corridor::Open, true);
        leader.view.was_seen = was_seen;
        assert_eq!(words(&leader.pass(19_900)), [""; 0]);
        assert_eq!(words(&leader.pass(100)), ["close"]);
        leader.view.corridor = Corridor::Clearing;
        leader.pass(500);
        leader.view.corridor = Corridor::Clear;
        leader.is_at(FIRST, PLACE);
        let said = words(&leader.pass(500));
        assert_eq!(
            said, [""; 0],
            "somebody may be on the road, and nobody is let on it"
        );
        leader.view.nobody_is_lost = true;
        assert_eq!(words(&leader.pass(500)), ["completed"]);
    }
}

#[test]
fn what_a_leader_does_by_the_clock() {
    type Case = (&'static [&'static str], Corridor, bool, bool, u32);
    let cases: [Case; 8] = [
        (&["open"], Corridor::Clear, true, false, 500),
        (&[], Corridor::Clear, false, false, 500),
        (&["completed"], Corridor::Clear, false, true, 500),
        (&["give up"], Corridor::Clear, true, false, 60_000),
        (&[], Corridor::Open, true, false, 60_000),
        (&["close"], Corridor::Open, false, false, 500),
        (&[], Corridor::Clearing, false, true, 500),
        (&[], Corridor::Clearing, false, false, 60_000),
    ];
    for (expected, corridor, is_wanted, everybody_is_across, ms) in cases {
        let mut leader = Leader::of(blocking());
        leader.joins(FIRST);
        leader.reports_from(FIRST, PLACE);
        leader.view = View {
            corridor,
            is_wanted,
            everybody_is_across,
            ..leader.view
        };
        leader.pass(ms - 100);
        leader.lead.tried = Millis::ZERO;
        leader.is_at(FIRST, PLACE);
        let said = words(&leader.pass(100));
        assert_eq!(
            said, expected,
            "{corridor:?}, {is_wanted}, {everybody_is_across}, {ms} ms"
        );
    }
}

#[test]
fn a_plan_is_over_with_its_session() {
    let mut leader = Leader::of(blocking());
    leader.joins(FIRST);
    let mut out = Outputs::EMPTY;
    let number = leader.id().session;
    for notice in [
        Notice::SessionEnded(number, EndReason::TaskCompleted),
        Notice::Yielded(SECOND),
    ] {
        let view = leader.view;
        let goes_on = leader
            .lead
            .notice(&leader.setup, &leader.plan, &view, notice, &mut out);
        assert!(!goes_on);
    }
}
