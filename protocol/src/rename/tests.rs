//! Every name that a state or message holds is renamed, and nothing else. States and messages are arbitrary ones.

use std::collections::BTreeSet;
use std::format;
use std::string::String;
use std::vec::Vec;

use super::*;
use crate::config::Config;
use crate::help::all_distinct;
use crate::laws::Random;
use crate::laws::arbitrary;
use crate::state::Role;

/// Calls a test with random numbers, many times.
fn each_time(mut test: impl FnMut(&mut Random)) {
    let mut random = Random(0);
    (0..500).for_each(|_| test(&mut random));
}

/// Any robots with up to three offers or followers.
fn each_robot(mut test: impl FnMut(&Robot)) {
    each_time(|random| {
        for role in Role::ALL {
            test(&arbitrary::robot(random, &Config::default(), role, (0, 3)));
        }
    });
}

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

/// Other names; what they make of each name is noted.
#[derive(Default)]
struct Other(Noted);

const LEFT: Millis = Millis(7);

const fn other_station(station: StationId) -> StationId {
    StationId(station.0 ^ 0x5555_5555)
}

const fn other_heartbeat(heartbeat: Heartbeat) -> Heartbeat {
    heartbeat.after(20)
}

const fn other_number(number: UniqueNumber) -> UniqueNumber {
    let UniqueNumber { boot, count } = number;
    let count = count.wrapping_add(10);
    UniqueNumber { boot, count }
}

const fn other_session(session: SessionId) -> SessionId {
    let leader = other_station(session.leader);
    let number = SessionNumber(other_number(session.number.0));
    SessionId { leader, number }
}

impl Renaming for Other {
    fn station(&mut self, station: StationId) -> StationId {
        self.0.station(other_station(station))
    }

    fn countdown(&mut self, _: Timer, _: Millis) -> Millis {
        LEFT
    }

    fn heartbeat(&mut self, session: SessionId, heartbeat: Heartbeat) -> Heartbeat {
        let session = other_session(session);
        self.0.heartbeat(session, other_heartbeat(heartbeat))
    }

    fn number(&mut self, owner: StationId, number: UniqueNumber) -> UniqueNumber {
        self.0.number(other_station(owner), other_number(number))
    }
}

/// No other names at all.
struct Same;

impl Renaming for Same {}

/// Asserts that under other names a thing holds those, and nothing of its old ones.
macro_rules! assert_renamed {
    ($thing:expr) => {{
        let thing = $thing;
        let mut other = Other::default();
        let renamed = thing.renamed(&mut other);
        let (mut before, mut after) = (Noted::default(), Noted::default());
        let _ = thing.renamed(&mut before);
        let _ = renamed.renamed(&mut after);
        assert_eq!(after.0, other.0.0, "{thing:?}\nbecomes {renamed:?}");
        assert!(before.0.is_disjoint(&after.0), "{renamed:?}");
        renamed
    }};
}

#[test]
fn every_name_in_a_robot_becomes_the_other_one() {
    each_robot(|robot| {
        let renamed = assert_renamed!(robot);
        assert_eq!(renamed.station(), other_station(robot.station()));
        assert_eq!(renamed.next_number(), other_number(robot.next_number()));
        assert_eq!(renamed.session(), robot.session().map(other_session));
        assert_eq!(renamed.timers().len(), robot.timers().len());
        assert!(renamed.timers().iter().all(|(_, left)| *left == LEFT));
    });
}

#[test]
fn every_name_in_a_message_becomes_the_other_one() {
    each_time(|random| {
        for part in 0..5 {
            let ram = arbitrary::ram(random, part, true);
            assert_eq!(ram.renamed(&mut Same), ram);
            let renamed = assert_renamed!(&ram);
            assert_eq!(renamed.station, other_station(ram.station));
        }
        let command = arbitrary::command(random);
        assert_eq!(
            assert_renamed!(&Rmcm::Command(command)),
            Rmcm::Command(Command {
                session: other_session(command.session),
                to: other_station(command.to),
                ..command
            })
        );
        let answer = arbitrary::answer(random);
        assert_eq!(
            assert_renamed!(&Rmcm::Answer(answer)),
            Rmcm::Answer(Answer {
                session: other_session(answer.session),
                from: other_station(answer.from),
                ..answer
            })
        );
    });
}

#[test]
fn a_robot_stays_as_it_is_without_other_names() {
    each_robot(|robot| {
        let is_ranked = match robot.phase() {
            Phase::Requesting(requesting) => requesting.offers_are_ranked(),
            _ => true,
        };
        assert!(!is_ranked || robot.renamed(&mut Same) == *robot);
    });
}

/// Followers, each a station of its own, stand in the order of their station ids, and offers in that of selection.
#[test]
fn lists_stand_in_the_order_of_their_new_names() {
    each_robot(|robot| {
        let renamed = robot.renamed(&mut Other::default());
        assert_eq!(renamed.ram(), robot.ram().renamed(&mut Other::default()));
        match (robot.phase(), renamed.phase()) {
            (Phase::Leading(old), Phase::Leading(new))
                if all_distinct(&old.members, |it| it.station) =>
            {
                let record = |it: &Member| (it.station, it.offer.0, it.echoed);
                let other = |it: &Member| {
                    let echoed = it.echoed.map(other_heartbeat);
                    (other_station(it.station), other_number(it.offer.0), echoed)
                };
                let mut records: Vec<_> = old.members.iter().map(other).collect();
                records.sort_by_key(|(station, ..)| *station);
                assert!(new.members.iter().map(record).eq(records), "{renamed:?}");
            }
            (Phase::Requesting(old), Phase::Requesting(new)) => {
                assert_eq!(new.offers.len(), old.offers.len());
                assert!(new.offers.iter().map(rank).is_sorted(), "{renamed:?}");
            }
            _ => {}
        }
    });
}
