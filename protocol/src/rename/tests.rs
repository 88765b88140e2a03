//! Every name that a state or message holds is renamed, and nothing else.

use std::collections::BTreeSet;
use std::format;
use std::string::String;
use std::vec::Vec;

use super::*;
use crate::message::Ending;
use crate::output::Output;
use crate::state::StandingFarewell;
use crate::team::{ARI, GO2, SPOT, Team};
use crate::time::Countdown;

/// The names as they are, each of which is noted.
#[derive(Default)]
struct Noted(BTreeSet<String>);

impl Renaming for Noted {
    fn station(&mut self, station: StationId) -> StationId {
        self.0.insert(format!("station {station}"));
        station
    }

    fn heartbeat(&mut self, session: SessionId, heartbeat: Heartbeat) -> Heartbeat {
        self.0.insert(format!("heartbeat {session} {heartbeat}"));
        heartbeat
    }

    fn number(&mut self, owner: StationId, number: UniqueNumber) -> UniqueNumber {
        self.0.insert(format!("number {owner} {number}"));
        number
    }
}

/// Other names, with the stations the other way round; what they make of each name is noted.
#[derive(Default)]
struct Other(BTreeSet<String>);

const LEFT: Millis = Millis(7);

const fn other_station(station: StationId) -> StationId {
    StationId(100 - station.0)
}

const fn other_number(number: UniqueNumber) -> UniqueNumber {
    UniqueNumber {
        count: number.count + 10,
        ..number
    }
}

const fn other_session(session: SessionId) -> SessionId {
    SessionId {
        leader: other_station(session.leader),
        number: SessionNumber(other_number(session.number.0)),
    }
}

impl Renaming for Other {
    fn station(&mut self, station: StationId) -> StationId {
        let other = other_station(station);
        self.0.insert(format!("station {other}"));
        other
    }

    fn countdown(&mut self, _: Timer, _: Millis) -> Millis {
        LEFT
    }

    fn heartbeat(&mut self, session: SessionId, heartbeat: Heartbeat) -> Heartbeat {
        let other = Heartbeat(heartbeat.0 + 20);
        self.0
            .insert(format!("heartbeat {} {other}", other_session(session)));
        other
    }

    fn number(&mut self, owner: StationId, number: UniqueNumber) -> UniqueNumber {
        let (owner, other) = (other_station(owner), other_number(number));
        self.0.insert(format!("number {owner} {other}"));
        other
    }
}

/// No other names at all.
struct Same;

impl Renaming for Same {}

/// Robots at all stages.
fn robots() -> Vec<Robot> {
    let teams = [
        Team::that_asks(),
        Team::that_offers(),
        Team::with_roles(),
        Team::at_work(),
    ];
    let mut robots: Vec<Robot> = teams.into_iter().flat_map(|team| team.0).collect();
    let [mut leaving, ..] = Team::that_asks().0;
    let number = SessionNumber(UniqueNumber { boot: 1, count: 0 });
    let session = SessionId {
        leader: GO2,
        number,
    };
    let farewells = [
        Farewell::Left(session, OfferNumber(number.0)),
        Farewell::Ended(number, Ending::Aborted),
    ];
    for farewell in farewells {
        let left = Countdown::armed(Millis(3));
        leaving.farewell = Some(StandingFarewell { farewell, left });
        robots.push(leaving.clone());
    }
    let rival = Some(Rival {
        session,
        heartbeat: Heartbeat(5),
        fresh: true,
    });
    if let Phase::Requesting(requesting) = &mut leaving.phase {
        requesting.rival = rival;
        robots.push(leaving);
    }
    let [mut yielding, mut resting, _] = Team::with_roles().0;
    if let Phase::Leading(leading) = &mut yielding.phase {
        (leading.rival, leading.yields_to) = (rival, Some(SPOT));
        robots.push(yielding);
    }
    resting.duty = Some(Duty::Crossing(session));
    robots.push(resting.clone());
    let id = ManeuverId {
        session,
        request: crate::RequestId(4),
    };
    let task = crate::TaskType::MOVE;
    resting.duty = Some(Duty::FallingBack(Maneuver { id, task }));
    robots.push(resting);
    robots
}

/// Asserts that under other names a thing holds those, and nothing of its old ones.
macro_rules! assert_renamed {
    ($thing:expr) => {{
        let thing = $thing;
        assert_eq!(thing.renamed(&mut Same), *thing);
        let mut other = Other::default();
        let renamed = thing.renamed(&mut other);
        let (mut before, mut after) = (Noted::default(), Noted::default());
        assert_eq!(thing.renamed(&mut before), *thing);
        let _ = renamed.renamed(&mut after);
        assert_eq!(after.0, other.0, "{thing:?}\nbecomes {renamed:?}");
        assert!(before.0.is_disjoint(&after.0), "{renamed:?}");
        renamed
    }};
}

#[test]
fn every_name_in_a_robot_becomes_the_other_one() {
    for robot in robots() {
        let renamed = assert_renamed!(&robot);
        assert_eq!(renamed.station(), other_station(robot.station()));
        assert_eq!(renamed.next_number(), other_number(robot.next_number()));
        assert_eq!(renamed.session(), robot.session().map(other_session));
        assert_eq!(
            renamed.timers().iter().count(),
            robot.timers().iter().count()
        );
        assert!(renamed.timers().iter().all(|(_, left)| *left == LEFT));
        let at_once = robot.timers().iter().all(|(_, left)| *left == LEFT);
        assert!(!at_once || robot.timers().iter().next().is_none());
    }
}

#[test]
fn every_name_in_a_ram_becomes_the_other_one() {
    let mut said = BTreeSet::new();
    for ram in robots().iter().map(Robot::ram) {
        let renamed = assert_renamed!(&ram);
        assert_eq!(renamed.station, other_station(ram.station));
        said.insert(format!("{:?}", core::mem::discriminant(&ram.coordination)));
    }
    assert_eq!(said.len(), 5, "each kind of RAM");
}

#[test]
fn every_name_in_an_rmcm_becomes_the_other_one() {
    let mut team = Team::with_roles();
    let order = crate::Event::CommandManeuver {
        follower: GO2,
        task: crate::TaskType::MOVE,
    };
    let commands = team.tell(0, order);
    let config = crate::team::config();
    let mut sent = 0;
    for output in commands.iter() {
        let Output::SendRmcm(command) = output else {
            continue;
        };
        let renamed = assert_renamed!(command);
        let (Rmcm::Command(old), Rmcm::Command(new)) = (command, renamed) else {
            panic!("{command:?}");
        };
        assert_eq!(
            (new.session, new.to),
            (other_session(old.session), other_station(GO2))
        );
        let answers = team.0[1].step(&config, crate::Input::Rmcm(*command));
        for answer in answers.iter() {
            let Output::SendRmcm(Rmcm::Answer(old)) = answer else {
                continue;
            };
            let Rmcm::Answer(new) = assert_renamed!(&Rmcm::Answer(*old)) else {
                panic!("{old:?}");
            };
            assert_eq!(
                (new.session, new.from),
                (other_session(old.session), other_station(GO2))
            );
            sent += 1;
        }
    }
    assert_eq!(sent, 1);
}

#[test]
fn whom_a_leader_confirmed_stand_in_the_order_of_their_new_names() {
    let [leader, ..] = Team::with_roles().0;
    let stations = |robot: &Robot| -> Vec<StationId> {
        match robot.phase() {
            Phase::Leading(leading) => leading.members.iter().map(|m| m.station).collect(),
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(stations(&leader), [GO2, SPOT]);
    let renamed = leader.renamed(&mut Other::default());
    assert_eq!(stations(&renamed), [SPOT, GO2].map(other_station));
    assert_eq!(renamed.station(), other_station(ARI));
    let (Phase::Leading(old), Phase::Leading(new)) = (leader.phase(), renamed.phase()) else {
        panic!("{renamed:?}");
    };
    for member in old.members.iter() {
        let other = new.member(other_station(member.station)).unwrap();
        assert_eq!(other.offer.0, other_number(member.offer.0));
        let echoed = member.echoed.expect("it has joined");
        assert_eq!(other.echoed, Some(Heartbeat(echoed.0 + 20)));
    }
    let Coordination::Leader { followers, .. } = renamed.ram().coordination else {
        panic!("{renamed:?}");
    };
    assert!(
        followers
            .iter()
            .map(|f| f.station)
            .eq([SPOT, GO2].map(other_station))
    );
}

#[test]
fn offers_stand_in_the_order_of_selection_under_their_new_names() {
    let [requester, ..] = Team::that_offers().0;
    let stations = |robot: &Robot| -> Vec<StationId> {
        match robot.phase() {
            Phase::Requesting(requesting) => requesting.offers.iter().map(|o| o.station).collect(),
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(stations(&requester), [GO2, SPOT]);
    let renamed = requester.renamed(&mut Other::default());
    assert_eq!(stations(&renamed), [SPOT, GO2].map(other_station));
}
