//! Leaders of three and four followers, and requesters with as many offers: the laws of one step with random values.
//!
//! Proofs of one stage have two of them at most, those of the theorem three. A rule that looks at the first two alone is
//! noticed here: each input comes from any of them or is about it, and a mark says in how many steps one after the second
//! decided.

use std::collections::BTreeMap;

use crossguard_protocol::laws::arbitrary::{self, Kind};
use crossguard_protocol::laws::steps;
use crossguard_protocol::laws::taken::Taken;
use crossguard_protocol::laws::{Random, Source};
use crossguard_protocol::{
    Config, Corridor, Event, EventKind, Input, Leading, Lease, Millis, NoticeKind, OutputKind,
    Phase, Rmcm, Role, TimerKind,
};

/// How many steps are tried.
const STEPS: u64 = 3_000_000;

/// In how many steps each mark is reached, at least.
const REACHED: u32 = 5;

const OF_LEADERS: [Kind; 6] = [
    Kind::RamFollower,
    Kind::RamNone,
    Kind::Answer,
    Kind::Elapsed,
    Kind::Local(EventKind::CommandManeuver),
    Kind::Local(EventKind::OpenCorridor),
];

const OF_REQUESTERS: [Kind; 2] = [
    Kind::Local(EventKind::AllAnswered),
    Kind::Fires(TimerKind::Selection),
];

/// Random numbers, as hinted more often than not: a state of many parts is seldom valid otherwise.
struct Hinted(Random);

impl Source for Hinted {
    fn number(&mut self, max: u32, hint: u32) -> u32 {
        let is_hinted = hint <= max && self.0.number(31, 32) > 0;
        if is_hinted {
            hint
        } else {
            self.0.number(max, hint)
        }
    }
}

/// An input of this kind which this follower sends, or which is about it.
fn of_follower(source: &mut Hinted, kind: Kind, leading: &Leading, nth: usize) -> Input {
    let mut input = arbitrary::input(source, kind, true);
    let Some(member) = leading.members.iter().nth(nth) else {
        return input;
    };
    match &mut input {
        Input::Ram { ram, .. } => ram.station = member.station,
        Input::Rmcm(Rmcm::Answer(answer)) => answer.from = member.station,
        Input::Local(Event::CommandManeuver { follower, .. }) => *follower = member.station,
        Input::Elapsed(time) => *time = Millis(time.0 % 2_000),
        _ => {}
    }
    input
}

/// What a step of a leader shows of a follower after the second.
fn mark(step: &Taken, leading: &Leading, nth: usize) -> Option<&'static str> {
    let said = |output| step.said.has(output);
    let tells = |notice| step.said.tells(notice);
    let leases = leading.members.iter().filter_map(|it| match it.lease {
        Lease::Stands(left) => left.left(),
        Lease::Expired(_) => None,
    });
    let leases: Vec<_> = leases.collect();
    let ends_first = leases.iter().skip(2).min() < leases.iter().take(2).min();
    let is_open = leading.corridor != Corridor::Clear;
    Some(match step.input {
        Input::Local(Event::OpenCorridor) if said(OutputKind::CorridorOpened) && ends_first => {
            "go lasts as long as its lease"
        }
        _ if nth < 2 => return None,
        Input::Ram { .. } if said(OutputKind::CorridorExtended) => "extends go",
        Input::Ram { .. } if tells(NoticeKind::LeaseGranted) => "is granted a lease",
        Input::Ram { .. } if tells(NoticeKind::FollowerGone) && is_open => "leaves people",
        Input::Rmcm(_) if tells(NoticeKind::CommandAcknowledged) => "acknowledges",
        Input::Local(_) if is_open && step.is_ignored() => "is not commanded off the road",
        Input::Local(_) if step.said.commanded => "is commanded",
        _ => return None,
    })
}

#[test]
fn the_laws_hold_for_each_of_three_and_four_followers() {
    let config = Config::default();
    let mut marks = BTreeMap::<_, u32>::new();
    for seed in 0..STEPS {
        let source = &mut Hinted(Random(seed));
        let is_leader = !source.number(7, 7).is_multiple_of(8);
        let role = if is_leader {
            Role::Leader
        } else {
            Role::Requester
        };
        let robot = arbitrary::valid_robot(source, &config, role, (3, 4));
        if !robot.is_valid(&config) {
            continue;
        }
        let draw = u32::try_from(seed % 24).unwrap_or(0) as usize;
        let (leading, nth, input) = match robot.phase() {
            Phase::Leading(leading) => {
                let nth = draw % leading.members.len();
                let kind = OF_LEADERS[draw / 4];
                (
                    Some(leading.clone()),
                    nth,
                    of_follower(source, kind, leading, nth),
                )
            }
            _ => (
                None,
                0,
                arbitrary::input(source, OF_REQUESTERS[draw % 2], true),
            ),
        };
        let step = Taken::new(&config, robot, input);
        steps::keeps_the_state_valid(&config, &step);
        steps::all(&config, &step);
        let mark = match &leading {
            Some(leading) => mark(&step, leading, nth),
            None => (step.after.role() == Role::Leader).then_some("three offers are confirmed"),
        };
        if let Some(mark) = mark {
            *marks.entry(mark).or_default() += 1;
        }
    }
    println!("{marks:#?}");
    assert!(
        marks.len() == 8 && marks.values().all(|it| *it >= REACHED),
        "{marks:#?}"
    );
}
