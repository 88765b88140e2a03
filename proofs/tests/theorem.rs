//! The theorem's table: which harness proves which kind of input in which stage. And what no harness has: time that passes as
//! a whole.
//!
//! A pair that is not in the table is always ignored. Harnesses prove this of every such pair
//! (`protocol::exchange::frame`), and fail where the table lacks one.

use crossguard_proofs::Symbolic;
use crossguard_proofs::protocol::exchange::frame::{KINDS, is_proved};
use crossguard_proofs::protocol::exchange::{Proved, follower, leader};
use crossguard_protocol::laws::arbitrary::{self, Kind, Part};
use crossguard_protocol::laws::exchange::steps::{self, Laws};
use crossguard_protocol::laws::exchange::{Exchange, History, robots};
use crossguard_protocol::laws::taken::Taken;
use crossguard_protocol::{Config, EventKind, Input, Robot, Role, SessionId, StationId, TimerKind};

const README: &str = include_str!("../README.md");

/// The laws of each harness of this pair.
fn laws_of(stage: Role, kind: Kind) -> Vec<Laws> {
    let all = leader::PROVED.iter().chain(follower::PROVED);
    let of_pair = |&&(of_stage, of_kind, _): &&Proved| (of_stage, of_kind) == (stage, kind);
    all.filter(of_pair).map(|&(_, _, laws)| laws).collect()
}

/// The valid ones among so many random states of this stage.
fn states(stage: Role, tries: u32) -> impl Iterator<Item = Robot> {
    let peers = match stage {
        Role::Requester => (0, 4),
        Role::Leader => (1, 4),
        Role::None | Role::Helper | Role::Follower => (0, 0),
    };
    let config = Config::default();
    (0..tries)
        .map(move |_| arbitrary::valid_robot(&mut Symbolic, &config, stage, peers))
        .filter(|robot| robot.is_valid(&Config::default()))
}

/// Whether some step of this kind is not ignored.
fn acts(stage: Role, kind: Kind) -> bool {
    states(stage, 1_000_000).any(|robot| {
        let input = arbitrary::input(&mut Symbolic, kind, true);
        !Taken::new(&Config::default(), robot, input).is_ignored()
    })
}

#[test]
fn each_pair_of_the_table_is_proved_by_all_laws_and_can_act() {
    for stage in Role::ALL {
        for &kind in KINDS {
            let laws = laws_of(stage, kind);
            let is_whole = matches!(laws[..], [Laws::All] | [Laws::Facts, Laws::Heartbeats]);
            assert_eq!(is_whole, !laws.is_empty(), "{stage:?} {kind:?}: {laws:?}");
            assert_eq!(is_whole, is_proved(stage, kind), "{stage:?} {kind:?}");
            assert!(
                !is_whole || acts(stage, kind),
                "{stage:?} {kind:?} is always ignored"
            );
        }
    }
}

#[test]
fn the_table_has_every_kind_of_input_once_and_the_page_its_numbers() {
    // Five kinds of RAM, two of RMCM.
    assert_eq!(KINDS.len(), 7 + TimerKind::ALL.len() + EventKind::ALL.len());
    assert!((1..KINDS.len()).all(|i| !KINDS[..i].contains(&KINDS[i])));
    for stage in Role::ALL {
        let act = KINDS.iter().filter(|kind| is_proved(stage, **kind)).count();
        let harnesses: usize = KINDS.iter().map(|kind| laws_of(stage, *kind).len()).sum();
        let row = format!(
            "| {stage:?} | {act} | {harnesses} | {} |",
            KINDS.len() - act
        );
        assert!(README.contains(&row), "the page lacks {row}");
    }
}

/// So validity after a step, which the theorem's harnesses ask for, rests on nothing that messages say.
#[test]
fn an_exchange_of_strangers_allows_any_input() {
    let config = Config::default();
    // Random values hardly draw these two.
    let [leader, follower] = [0xFEED_0001, 0xFEED_0002].map(StationId);
    for stage in Role::ALL {
        for robot in states(stage, 2_000) {
            let exchange = arbitrary::exchange(&mut Symbolic, Part::Bystander, &robot, &config);
            let exchange = Exchange {
                session: SessionId {
                    leader,
                    ..exchange.session
                },
                follower,
                ..exchange
            };
            let unknown = History::default();
            assert!(robots::are_near(&exchange, &robot));
            assert!(steps::holds(&exchange, &unknown, &robot));
            for &kind in KINDS {
                let input = arbitrary::input(&mut Symbolic, kind, true);
                let is_allowed = steps::can_be_next(&exchange, &unknown, &robot, &input);
                assert!(is_allowed, "{stage:?} {input:?}");
            }
        }
    }
}

/// All timers that are due fire in one step. Harnesses prove each by itself.
#[test]
fn time_that_passes_keeps_what_holds() {
    let config = Config::default();
    for stage in Role::ALL {
        let mut kept = 0;
        for (i, robot) in states(stage, 200_000).enumerate() {
            let part = [Part::Leader, Part::Follower, Part::Bystander][i % 3];
            let exchange = arbitrary::exchange(&mut Symbolic, part, &robot, &config);
            let history = arbitrary::history(&mut Symbolic, &exchange, &robot);
            let input = arbitrary::input(&mut Symbolic, Kind::Elapsed, false);
            let can_pass = matches!(input, Input::Elapsed(time) if steps::can_pass(&config, time));
            if can_pass
                && exchange.session.leader != exchange.follower
                && robots::are_near(&exchange, &robot)
                && steps::holds(&exchange, &history, &robot)
            {
                let watched = (&exchange, &history);
                let (now, after) = steps::keeps(Laws::All, &config, watched, &robot, input);
                kept += u32::from(now != history || after.role() != robot.role());
            }
        }
        assert!(
            kept > 0 || stage == Role::None,
            "{stage:?}: nothing comes about"
        );
    }
}
