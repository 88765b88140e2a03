//! How a plan goes: who is commanded what, how often, and when the leader gives up.

use std::boxed::Box;
use std::string::String;
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

fn escorting() -> Plan {
    plan([Stage::everybody(leg(TaskType::MOVE, PLACE))])
}

/// A leader whose outputs are told in words.
struct Leader {
    lead: Lead,
    view: View<'static>,
    /// Its last output.
    said: Vec<Output>,
}

/// The command of which followers report.
const ID: ManeuverId = ManeuverId {
    session: SessionId {
        leader: StationId(1),
        number: SessionNumber(UniqueNumber { boot: 1, count: 0 }),
    },
    request: RequestId(0),
};

impl Leader {
    fn of(plan: Plan) -> Self {
        Self::under(Setup::default(), plan)
    }

    fn under(setup: Setup, plan: Plan) -> Self {
        let (setup, plan) = (&*Box::leak(Box::new(setup)), &*Box::leak(Box::new(plan)));
        let view = View {
            setup,
            plan,
            corridor: Corridor::Clear,
            own: Presence::NOWHERE,
            hindrance: None,
            stop_line: None,
            is_wanted: true,
            has_opened: false,
            has_crossed: false,
            everybody_is_across: false,
            nobody_is_lost: false,
            was_seen: false,
        };
        Self {
            lead: Lead::new(plan, false),
            view,
            said: Vec::new(),
        }
    }

    fn hear(&mut self, notice: Notice) -> String {
        let mut out = Outputs::EMPTY;
        self.lead.notice(&self.view, notice, &mut out);
        self.say(&out)
    }

    fn joins(&mut self, station: StationId) -> String {
        self.hear(Notice::FollowerJoined(station))
    }

    fn is_at(&mut self, station: StationId, at: Point) {
        let pose = Some(Pose { at, error_cm: 0 });
        let View { setup, plan, .. } = self.view;
        self.lead
            .follower_is_at(setup, plan, station, pose, Millis::ZERO);
    }

    fn reports_from(&mut self, station: StationId, at: Point) -> String {
        self.is_at(station, at);
        self.hear(Notice::ManeuverInPosition(station, ID))
    }

    fn completes_at(&mut self, station: StationId, at: Point) -> String {
        self.is_at(station, at);
        self.hear(Notice::ManeuverCompleted(station, ID))
    }

    fn pass(&mut self, ms: u32) -> String {
        let mut out = Outputs::EMPTY;
        self.lead.elapse(self.view.setup, Millis(ms));
        self.lead.lead_on(&self.view, &mut out);
        self.say(&out)
    }

    fn say(&mut self, out: &Outputs) -> String {
        self.said = out.iter().copied().collect();
        let word = |output: &Output| match output {
            Output::Order(..) => "order",
            Output::Hindered(_) => "hindered",
            Output::Tell(Event::OpenCorridor) => "open",
            Output::Tell(Event::CloseCorridor) => "close",
            Output::Tell(Event::TaskCompleted) => "completed",
            Output::Tell(Event::LeaveRequested) => "give up",
            _ => "other",
        };
        let words: Vec<_> = out.iter().map(word).collect();
        words.join(", ")
    }

    /// Its last order, if it has no other output.
    fn ordered(&self) -> Option<(StationId, Leg)> {
        match self.said[..] {
            [Output::Order(station, leg)] => Some((station, leg)),
            _ => None,
        }
    }
}

#[test]
fn a_follower_that_reports_from_elsewhere_is_commanded_again_and_in_the_end_given_up() {
    for (at, expected) in [
        (PLACE, "open"),
        (Point::new(600, 650), "open"),
        (Point::new(600, 701), "order"),
    ] {
        let mut leader = Leader::of(blocking());
        assert_eq!(leader.joins(FIRST), "order");
        assert_eq!(leader.reports_from(FIRST, at), expected, "{at:?}");
    }
    let mut leader = Leader::of(blocking());
    leader.joins(FIRST);
    let away = Point::new(600, 820);
    for expected in ["order", "order", "give up"] {
        assert_eq!(leader.reports_from(FIRST, away), expected);
    }
}

/// A guard at an unknown place lets nobody cross.
#[test]
fn a_follower_whose_position_nobody_knows_opens_nothing() {
    let mut leader = Leader::of(blocking());
    leader.joins(FIRST);
    assert_eq!(leader.hear(Notice::ManeuverInPosition(FIRST, ID)), "");
    assert_eq!(leader.pass(5_000), "");
    leader.is_at(FIRST, PLACE);
    assert_eq!(leader.pass(500), "open");
    // At most each half second.
    assert_eq!(leader.pass(400), "");
    leader.is_at(FIRST, PLACE);
    assert_eq!(leader.pass(100), "open");
}

/// An escort on its way to the kerb when everybody is across; and then somebody else comes to the kerb behind it.
#[test]
fn a_leader_waits_for_its_escort_and_opens_for_nobody_else_meanwhile() {
    for is_wanted in [false, true] {
        let guarding = TaskSet::of(&[TaskType::MOVE]);
        let setup = Setup {
            guarding,
            ..Setup::default()
        };
        let mut leader = Leader::under(setup, escorting());
        leader.joins(FIRST);
        leader.is_at(FIRST, Point::new(600, 0));
        leader.view = View {
            is_wanted,
            has_opened: true,
            has_crossed: true,
            was_seen: true,
            ..leader.view
        };
        assert_eq!(leader.pass(500), "", "the road is not clear");
        leader.view.was_seen = false;
        leader.view.nobody_is_lost = true;
        leader.view.everybody_is_across = !is_wanted;
        for _ in 0..9 {
            leader.is_at(FIRST, Point::new(600, 100));
            assert_eq!(leader.pass(500), "", "the escort walks");
        }
        leader.is_at(FIRST, Point::new(600, 100));
        assert_eq!(leader.pass(500), "completed", "it stands");
    }
}

#[test]
fn a_rejected_command_is_repeated_half_a_second_later_and_never_to_who_will_not_do_it() {
    let stop = Unavailability::EmergencyStop;
    for why in [Rejection::Unavailable(stop), Rejection::UnsupportedTask] {
        let mut leader = Leader::of(blocking());
        leader.joins(FIRST);
        let rejected = |why| Notice::CommandRejected(FIRST, ID, why);
        assert_eq!(leader.hear(rejected(Rejection::OnDuty)), "");
        assert_eq!(leader.pass(499), "");
        assert_eq!(leader.pass(1), "order");
        assert_eq!(leader.hear(rejected(why)), "give up");
    }
}

#[test]
fn a_leg_that_fails_again_and_again_is_given_up_after_three_attempts() {
    let mut leader = Leader::of(blocking());
    let mut said = Vec::from([leader.joins(FIRST)]);
    for _ in 0..5 {
        let failed = Notice::ManeuverFailed(FIRST, ID, Failure::Maneuver);
        said.push(leader.hear(failed));
        said.push(leader.pass(500));
    }
    said.retain(|it| !it.is_empty());
    assert_eq!(said[..4], ["order", "order", "order", "give up"]);
    assert!(!said[4..].iter().any(|it| it == "order"));
    // A part that was begun well has all its attempts before it.
    let mut leader = Leader::of(blocking());
    leader.joins(FIRST);
    for _ in 0..5 {
        leader.reports_from(FIRST, PLACE);
        leader.pass(500);
        let said = leader.hear(Notice::FollowerSafeIdle(FIRST, ID)) + &leader.pass(500);
        assert!(
            said.contains("order") && !said.contains("give up"),
            "{said}"
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
            leader.joins(station);
            let (to, leg) = leader.ordered().expect("an order");
            assert_eq!(to, station);
            let is_apart = |it: &Point| it.distance_cm(leg.to) >= 149;
            assert!(places.iter().all(is_apart), "{places:?}");
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
    for (station, task) in [(FIRST, TaskType::INITIAL_POS), (SECOND, TaskType::BLOCK)] {
        leader.joins(station);
        assert_eq!(leader.ordered().map(|(_, leg)| leg.task), Some(task));
    }
    assert_eq!(leader.joins(StationId(4)), "");
    let gone = |station| Notice::FollowerGone(station, GoneReason::Left);
    assert_eq!(leader.hear(gone(StationId(4))), "", "nobody misses it");
    assert_eq!(leader.hear(gone(StationId(9))), "", "it never came");
    assert_eq!(leader.hear(gone(FIRST)), "give up");
}

#[test]
fn a_stage_begins_when_everybody_has_done_their_part_of_the_one_before() {
    let ahead = Stage::everybody(leg(TaskType::INITIAL_POS, Point::default()));
    let block = Stage::everybody(leg(TaskType::BLOCK, PLACE));
    let mut leader = Leader::of(Plan {
        followers: 2,
        ..plan([ahead, block])
    });
    let start = |leader: &mut Leader, station| {
        leader.joins(station);
        leader.ordered().expect("an order").1.to
    };
    let first = start(&mut leader, FIRST);
    let said = leader.completes_at(FIRST, first);
    assert_eq!(said, "", "the other has not come yet");
    let second = start(&mut leader, SECOND);
    assert_eq!(leader.completes_at(SECOND, second), "order, order");
    assert_eq!(leader.lead.stage(), 1);
    leader.reports_from(FIRST, PLACE);
    assert_eq!(leader.pass(1_000), "", "one guard is not there");
}

/// Hazard: a follower says that it has taken its place beside the person who waits, from anywhere. Its escort begins, and go is shown.
#[test]
fn a_follower_has_completed_what_its_own_position_confirms() {
    type Said = fn(&mut Leader);
    let cases: [(&str, Said, u8); 5] = [
        ("there", |it| it.is_at(FIRST, PLACE), 1),
        ("silent about it", |_| (), 0),
        ("elsewhere", |it| it.is_at(FIRST, Point::new(600, 701)), 0),
        (
            "there a second ago",
            |it| {
                it.is_at(FIRST, PLACE);
                it.pass(1_000);
            },
            0,
        ),
        (
            "known to 3 m",
            |it| {
                let pose = Pose {
                    at: PLACE,
                    error_cm: 300,
                };
                let View { setup, plan, .. } = it.view;
                let lead = &mut it.lead;
                lead.follower_is_at(setup, plan, FIRST, Some(pose), Millis::ZERO);
            },
            0,
        ),
    ];
    for (name, says, stage) in cases {
        let mut leader = Leader::of(plan([
            Stage::everybody(leg(TaskType::INITIAL_POS, PLACE)),
            Stage::everybody(leg(TaskType::MOVE, Point::new(600, 1_500))),
        ]));
        leader.joins(FIRST);
        says(&mut leader);
        assert_eq!(leader.hear(Notice::ManeuverCompleted(FIRST, ID)), "order");
        assert_eq!(leader.lead.stage(), stage, "{name}");
    }
}

/// Hazard: a guard is pushed off its place, or falls back, while an escort has the only part of the last stage. It comes back, and
/// people wait for go until the leader gives up.
#[test]
fn a_guard_of_an_earlier_stage_is_commanded_back_and_counts_when_it_is_back() {
    let stage = |role, task, to| Stage {
        parts: core::iter::once((Who::Role(role), leg(task, to))).collect(),
    };
    let over_there = Point::new(100, 800);
    let in_last_stage = || {
        let mut leader = Leader::of(Plan {
            followers: 2,
            roles: [None, None].into_iter().collect(),
            ..plan([
                stage(0, TaskType::BLOCK, PLACE),
                stage(1, TaskType::MOVE, over_there),
            ])
        });
        assert_eq!(leader.joins(FIRST), "order");
        assert_eq!(leader.joins(SECOND), "");
        assert_eq!(leader.reports_from(FIRST, PLACE), "order");
        let goes = Notice::ManeuverReported(SECOND, ID);
        assert_eq!(leader.hear(goes), "open");
        leader
    };
    let leaves = Notice::ManeuverReported(FIRST, ID);
    let block = leg(TaskType::BLOCK, PLACE);
    let mut leader = in_last_stage();
    assert_eq!(leader.hear(leaves), "");
    assert_eq!(leader.reports_from(FIRST, PLACE), "open");
    let mut leader = in_last_stage();
    leader.pass(500);
    leader.hear(leaves);
    leader.is_at(FIRST, Point::new(600, 820));
    leader.pass(100);
    assert_eq!(leader.ordered(), Some((FIRST, block)));
    let mut leader = in_last_stage();
    leader.pass(500);
    leader.hear(Notice::FollowerSafeIdle(FIRST, ID));
    assert_eq!(leader.ordered(), Some((FIRST, block)));
    assert_eq!(leader.reports_from(FIRST, PLACE), "open");
}

/// The escort is across, and nobody came along.
#[test]
fn an_escort_is_commanded_anew_at_the_opening_period_and_not_without_end() {
    let mut leader = Leader::of(escorting());
    let mut said = leader.joins(FIRST);
    let mut orders = 0;
    for _ in 0..1_000 {
        if said.contains("order") {
            orders += 1;
            leader.hear(Notice::ManeuverReported(FIRST, ID));
            leader.completes_at(FIRST, PLACE);
        }
        said = leader.pass(10);
    }
    assert!((15..=21).contains(&orders), "{orders} orders in 10 s");
    // The session lets nobody on the road any more, and ends once nobody is lost.
    leader.view.has_opened = true;
    leader.pass(10_000);
    leader.completes_at(FIRST, PLACE);
    assert_eq!(leader.pass(500), "");
    leader.view.nobody_is_lost = true;
    assert_eq!(leader.pass(10), "completed");
}

#[test]
fn an_escort_waits_until_nothing_hinders() {
    let mut leader = Leader::of(escorting());
    leader.view.hindrance = Some(Hindrance::NoSight);
    assert_eq!(leader.joins(FIRST), "");
    assert_eq!(leader.pass(5_000), "hindered");
    leader.view.hindrance = None;
    assert_eq!(leader.pass(100), "order");
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
        assert_eq!(leader.pass(19_900), "");
        assert_eq!(leader.pass(100), "close");
        leader.view.corridor = Corridor::Clearing;
        leader.pass(500);
        leader.view.corridor = Corridor::Clear;
        leader.is_at(FIRST, PLACE);
        let said = leader.pass(500);
        assert_eq!(
            said, "",
            "somebody may be on the road, and nobody is let on it"
        );
        leader.view.nobody_is_lost = true;
        assert_eq!(leader.pass(500), "completed");
    }
}

#[test]
fn what_a_leader_does_by_the_clock() {
    type Case = (&'static str, Corridor, bool, bool, u32);
    let cases: [Case; 8] = [
        ("open", Corridor::Clear, true, false, 500),
        ("", Corridor::Clear, false, false, 500),
        ("completed", Corridor::Clear, false, true, 500),
        ("give up", Corridor::Clear, true, false, 60_000),
        ("", Corridor::Open, true, false, 60_000),
        ("close", Corridor::Open, false, false, 500),
        ("", Corridor::Clearing, false, true, 500),
        ("", Corridor::Clearing, false, false, 60_000),
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
        let said = leader.pass(100);
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
    for notice in [
        Notice::SessionEnded(ID.session, EndReason::TaskCompleted),
        Notice::Yielded(SECOND),
    ] {
        let goes_on = leader.lead.notice(&leader.view, notice, &mut out);
        assert!(!goes_on);
    }
}
