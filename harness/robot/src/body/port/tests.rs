//! The port by itself: a socket on one side, the trait of bodies on the other.

use std::io::{BufRead, BufReader, Write};
use std::os::unix::net::UnixStream;
use std::sync::mpsc::{SyncSender, sync_channel};

use crossguard_codec::geonet::EgoPosition;
use crossguard_codec::{
    DriveDirection, Heard as Message, Identifiers, Position, TaskParameters, encode, ram_from,
};
use crossguard_protocol::{Availability, RequestId, Robot, StationId, StopReason, TaskType};

use super::*;
use crate::table::{maneuver, rows};

const HELLO: &str = r#"{"type": "hello", "crossguard": 3}"#;

/// A port that was without a body until one said this; its folder lasts as long as the test.
fn open(hello: &str) -> (Ported, UnixStream, tempfile::TempDir) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("body.sock");
    let port = BodyPort {
        address: PortAddress(path.clone()),
        silence: Duration::from_millis(500),
    };
    let holding = TaskSet::of(&[TaskType::BLOCK]);
    let (build, site) = (Build::Quadruped, Site::default());
    let mut body = Ported::open("Go2", build, site, Place::default(), port, holding).unwrap();
    let mut other = UnixStream::connect(path).unwrap();
    assert_eq!(report(&mut body), Some(Report::Absent));
    writeln!(other, "{hello}").unwrap();
    (body, other, folder)
}

/// Next report of the body, within a minute. No time passes by its clock.
fn report(body: &mut Ported) -> Option<Report> {
    (0..60_000).find_map(|_| {
        std::thread::sleep(Duration::from_millis(1));
        body.advance(0.0).pop()
    })
}

/// Report of the body within a second of its clock, while nothing comes from it.
fn report_of_silence(body: &mut Ported) -> Option<Report> {
    (0..10).find_map(|_| body.advance(0.1).pop())
}

/// Report of a body that is lost.
fn silent(why: &str) -> Report {
    Report::Silent(format!("the body {why}"))
}

fn heard(from: &mut impl BufRead) -> serde_json::Value {
    let mut line = String::new();
    from.read_line(&mut line).unwrap();
    serde_json::from_str(&line).unwrap()
}

#[test]
fn acts_go_out_as_lines_and_what_the_body_says_comes_in() {
    let (mut body, mut other, _folder) =
        open(r#"{"type": "hello", "crossguard": 3, "name": "later"}"#);
    let start = BodyAct::Start(
        maneuver(TaskType::BLOCK),
        TaskParameters {
            target: Some(Site::default().target(Place::new(6.0, 5.0))),
            heading: Some(90.0),
            ..TaskParameters::default()
        },
    );
    assert_eq!(report(&mut body), Some(Report::Here));
    assert_eq!(body.act(start), Ok(()));
    let mut lines = BufReader::new(other.try_clone().unwrap());
    assert_eq!(heard(&mut lines)["type"], "hello");
    let line = std::iter::repeat_with(|| heard(&mut lines)).find(|line| line["type"] != "beat");
    let line = line.unwrap();
    let said = ["type", "task", "id", "report"].map(|name| &line[name]);
    assert_eq!(said, ["start", "block", "1#1.0/0", "in-position"]);
    let off_m = line["to"]["eastM"].as_f64().unwrap() - 6.0;
    assert!(off_m.abs() < 1e-6 && line["headingDeg"] == 90.0, "{line}");
    let said = "{\"type\": \"pose\", \"eastM\": 6.1, \"northM\": 5}\n{\"type\": \"in-position\", \"id\": \"1#1.0/0\"}";
    writeln!(other, "{said}").unwrap();
    let there = Report::InPosition(maneuver(TaskType::BLOCK).id);
    assert_eq!(report(&mut body), Some(there));
}

#[test]
fn a_body_that_says_nothing_is_silent_once_and_the_end_of_its_connection_is_silence() {
    let (mut body, _other, folder) = open(HELLO);
    assert_eq!(report(&mut body), Some(Report::Here));
    // It hangs.
    let hangs = Report::Silent("nothing was heard of the body".to_owned());
    assert_eq!(report_of_silence(&mut body), Some(hangs));
    assert_eq!(report_of_silence(&mut body), None);
    let stop = BodyAct::Stop(maneuver(TaskType::MOVE), StopReason::Superseded);
    assert_eq!(body.act(stop), Ok(()), "it was told that it is silent");
    let start = BodyAct::Start(maneuver(TaskType::MOVE), TaskParameters::default());
    assert!(body.act(start).is_err());
    let mut again = UnixStream::connect(folder.path().join("body.sock")).unwrap();
    writeln!(again, "{HELLO}").unwrap();
    assert_eq!(report(&mut body), Some(Report::Here));
    drop(again);
    assert_eq!(report(&mut body), Some(silent("closed its connection")));
}

#[test]
fn a_body_is_told_to_wait_and_to_go_on_in_its_maneuver() {
    let (mut body, mut other, _folder) = open(HELLO);
    assert_eq!(report(&mut body), Some(Report::Here));
    let escort = maneuver(TaskType::MOVE);
    let start = BodyAct::Start(escort, TaskParameters::default());
    for act in [start, BodyAct::Wait, BodyAct::GoOn] {
        assert_eq!(body.act(act), Ok(()));
    }
    let mut lines = BufReader::new(other.try_clone().unwrap());
    let said = std::iter::repeat_with(|| heard(&mut lines)["type"].clone());
    let said: Vec<_> = said.filter(|it| it != "beat").take(4).collect();
    assert_eq!(said, ["hello", "start", "wait", "go-on"]);
    writeln!(other, "{{\"type\": \"completed\", \"id\": \"1#1.0/0\"}}").unwrap();
    assert_eq!(report(&mut body), Some(Report::Completed(escort.id)));
    assert!(matches!(
        report_of_silence(&mut body),
        Some(Report::Silent(_))
    ));
    assert_eq!(body.act(BodyAct::Wait), Ok(()), "it stands by itself");
    assert!(body.act(BodyAct::GoOn).is_err());
}

/// Hazard: a robot hangs and goes on while its escort is on the way. The body has stood still meanwhile, and the person crosses alone
/// under go, since the maneuver seems to run.
/// Hazard: the robot is told to stop, and ends while its body brings a person to the kerb. The body hears nothing any more, and
/// stands still in the middle of the road.
#[test]
fn a_body_that_falls_back_is_on_its_way_until_it_says_that_it_is_not_or_is_lost() {
    for end in ["fallen-back", "closed", "holds"] {
        let (mut body, mut other, _folder) = open(HELLO);
        assert_eq!(report(&mut body), Some(Report::Here));
        let policy = match end {
            "holds" => FallbackPolicy::HoldUntilClear,
            _ => FallbackPolicy::EscortToKerb,
        };
        let escort = maneuver(TaskType::MOVE);
        body.act(BodyAct::FallBack(escort, policy)).unwrap();
        assert_eq!(body.walks_back(), end != "holds");
        match end {
            "fallen-back" => writeln!(other, "{}", fallen_back(escort)).unwrap(),
            _ => drop(other),
        }
        let ended = (0..60_000).find(|_| {
            std::thread::sleep(Duration::from_millis(1));
            body.advance(0.0);
            !body.walks_back()
        });
        assert!(ended.is_some(), "{end}");
    }
}

/// Hazard: a body is lost as it falls back, or before, and connects again. It stands on the lane, and its robot takes it to be on its
/// way: nobody's word ends the duty, and the robot does not end when it is told to stop.
#[test]
fn a_body_that_was_lost_stands_still_and_is_on_no_way_when_it_connects_again() {
    let escort = maneuver(TaskType::MOVE);
    let fall_back = BodyAct::FallBack(escort, FallbackPolicy::EscortToKerb);
    for falls_back_first in [true, false] {
        let (mut body, other, folder) = open(HELLO);
        assert_eq!(report(&mut body), Some(Report::Here));
        if falls_back_first {
            body.act(fall_back).unwrap();
        }
        drop(other);
        assert_eq!(report(&mut body), Some(silent("closed its connection")));
        if !falls_back_first {
            assert_eq!(body.act(fall_back), Ok(()));
        }
        let mut again = UnixStream::connect(folder.path().join("body.sock")).unwrap();
        writeln!(again, "{HELLO}").unwrap();
        assert_eq!(report(&mut body), Some(Report::Here));
        assert_eq!((body.fallback(), body.walks_back()), (None, false));
        let mut lines = BufReader::new(again);
        let said = std::iter::repeat_with(|| heard(&mut lines)["type"].clone());
        let said: Vec<_> = said.filter(|it| it != "beat").take(2).collect();
        assert_eq!(said, ["hello", "halt"]);
    }
}

/// The word of a body that its fallback from a maneuver is finished.
fn fallen_back(from: Maneuver) -> String {
    format!(r#"{{"type": "fallen-back", "id": "{}"}}"#, from.id)
}

/// Hazard: a body says late that an earlier fallback is finished, and the robot ends, or counts the road as clear, while the body
/// still brings its person to the kerb.
#[test]
fn the_end_of_an_earlier_fallback_is_none_of_this_one() {
    let (mut body, tell, _other) = open_by_hand();
    let earlier = maneuver(TaskType::MOVE);
    let id = ManeuverId::of(earlier.id.session, RequestId(1));
    let escort = Maneuver { id, ..earlier };
    for it in [earlier, escort] {
        let start = BodyAct::Start(it, TaskParameters::default());
        body.act(start).unwrap();
        body.act(BodyAct::FallBack(it, FallbackPolicy::EscortToKerb))
            .unwrap();
    }
    for (said, walks_back) in [(earlier, true), (escort, false)] {
        tell.send(Heard::Line(0, fallen_back(said))).unwrap();
        let dropped = body.advance(0.0).len();
        assert_eq!((body.walks_back(), dropped == 1), (walks_back, walks_back));
    }
}

#[test]
fn a_body_that_was_told_nothing_for_so_long_is_lost_although_it_says_that_it_is_there() {
    for (held_s, lost) in [
        (0.4, None),
        (0.6, Some(silent("was told nothing, so it stands still"))),
    ] {
        let (mut body, tell, _other) = open_by_hand();
        assert_eq!(body.advance(0.1), []);
        tell.send(Heard::Line(0, r#"{"type": "beat"}"#.to_owned()))
            .unwrap();
        assert_eq!(body.advance(held_s).into_iter().next(), lost, "{held_s}");
    }
}

/// A body that is there, and what the port hears of it from now on, by hand.
fn open_by_hand() -> (Ported, SyncSender<Heard>, UnixStream) {
    let (mut body, other, _) = open(HELLO);
    assert_eq!(report(&mut body), Some(Report::Here));
    let (tell, heard) = sync_channel(1 << 14);
    body.listening.heard = heard;
    (body, tell, other)
}

/// Hazard: a body that also says what the kit does not know dies on the road, and is missed seconds later.
#[test]
fn what_is_said_besides_is_counted_and_delays_no_end() {
    let closed = silent("closed its connection");
    let too_much = silent("says more than is taken in");
    for (lines, silent, silent_at) in [
        (5, &closed, 600),
        (250, &closed, 600),
        (270, &too_much, 101),
    ] {
        let (mut body, tell, _other) = open_by_hand();
        let escort = maneuver(TaskType::MOVE);
        body.act(BodyAct::Start(escort, TaskParameters::default()))
            .unwrap();
        let say = |line: &str| tell.send(Heard::Line(0, line.to_owned())).unwrap();
        let (mut dropped, mut others) = (0, Vec::new());
        for turn in 0..700_i32 {
            if turn < 600 {
                (0..lines).for_each(|_| say(r#"{"type": "imu", "x": 1}"#));
                say(r#"{"type": "beat"}"#);
            } else if turn == 600 {
                say(r#"{"type": "completed", "id": "1#1.0/0"}"#);
                say(r#"{"type": "fault", "text": "hot"}"#);
                tell.send(Heard::Closed(0)).unwrap();
            }
            for report in body.advance(0.005) {
                match report {
                    Report::Dropped(Cause::BodyGarbled, _, count) => dropped += count,
                    report => others.push((turn, report)),
                }
            }
        }
        let (turn, last) = others.pop().unwrap();
        assert_eq!(&last, silent);
        assert!(turn.abs_diff(silent_at) <= 1, "{turn}");
        if silent == &closed {
            let before = [
                Report::Completed(escort.id),
                Report::Fault("hot".to_owned()),
            ];
            assert_eq!(others, before.map(|it| (turn, it)));
            assert_eq!(dropped, 600 * lines);
        } else {
            // Later lines are dropped, too: two lines in the end, and beats.
            let beats = 600 * 271 + 2 - dropped;
            assert!((1..=100).contains(&beats), "{beats} beats were taken in");
        }
    }
}

/// Hazard: a text of the body looks like a line of the kit on the console, and fills the log.
#[test]
fn what_does_not_count_is_counted_and_texts_of_a_body_stay_in_a_line() {
    let (mut body, tell, _other) = open_by_hand();
    let (ours, mut theirs) = UnixStream::pair().unwrap();
    let (stream, _) = crate::port::prepare(ours).unwrap();
    let fault = format!(
        r#"{{"type": "fault", "text": "hot\n 12.000 ARI: now Idle\u001b[2J{}"}}"#,
        "!".repeat(1_000)
    );
    let too_long = "a line has more than 65,536 octets";
    for heard in [
        Heard::Connected(1, stream),
        Heard::Line(0, fault),
        Heard::Unread(0, too_long),
        Heard::Line(0, HELLO.to_owned()),
    ] {
        tell.send(heard).unwrap();
    }
    let dropped = |cause, what: &str, count| Report::Dropped(cause, what.to_owned(), count);
    let text = r"hot\u{a} 12.000 ARI: now Idle\u{1b}[2J";
    let expected = [
        dropped(
            Cause::BodiesFull,
            "another body wanted to connect: refused",
            1,
        ),
        Report::Fault(format!("{text}{}", "!".repeat(TEXT_CHARS - 29))),
        dropped(Cause::BodyGarbled, too_long, 2),
        Report::Silent(too_long.to_owned()),
    ];
    assert_eq!(body.advance(0.0), expected);
    let mut refused = String::new();
    std::io::Read::read_to_string(&mut theirs, &mut refused).unwrap();
    assert!(refused.contains("another body is connected"), "{refused}");
    // One that connects and says no hello.
    let (ours, _mute) = UnixStream::pair().unwrap();
    let (stream, _) = crate::port::prepare(ours).unwrap();
    tell.send(Heard::Connected(2, stream)).unwrap();
    assert_eq!(body.advance(0.0), []);
    let mute = dropped(
        Cause::BodyGarbled,
        "no hello: nothing was heard of the body",
        1,
    );
    assert_eq!(report_of_silence(&mut body), Some(mute));
}

#[test]
fn a_body_of_the_version_without_wait_or_id_of_a_fallback_is_refused() {
    for version in 1..3 {
        let hello = format!(r#"{{"type": "hello", "crossguard": {version}}}"#);
        let (mut body, other, _folder) = open(&hello);
        is_garbled(&mut body);
        let mut lines = BufReader::new(other);
        assert_eq!(heard(&mut lines)["type"], "hello");
        let refused = heard(&mut lines);
        let why = refused["why"].as_str().unwrap();
        let expected = format!("version {version}: 3 is spoken");
        assert!(why.starts_with(&expected), "{why}");
    }
}

/// Hazard: the sockets of two robots are mixed up in a launch file. One robot is where the other one was sent, and says that it
/// is in position there.
#[test]
fn the_body_of_another_robot_is_refused() {
    for (robot, is_refused) in [("Go2", false), ("ARI", true)] {
        let hello = format!(r#"{{"type": "hello", "crossguard": 3, "robot": "{robot}"}}"#);
        let (mut body, other, _folder) = open(&hello);
        if !is_refused {
            assert_eq!(report(&mut body), Some(Report::Here));
            continue;
        }
        is_garbled(&mut body);
        let mut lines = BufReader::new(other);
        assert_eq!(heard(&mut lines)["type"], "hello");
        let why = heard(&mut lines)["why"].as_str().unwrap().to_owned();
        assert!(why.starts_with("this is the body port of Go2"), "{why}");
    }
}

#[track_caller]
fn is_garbled(body: &mut Ported) {
    let said = report(body);
    let is_it = matches!(said, Some(Report::Dropped(Cause::BodyGarbled, ..)));
    assert!(is_it, "{said:?}");
}

/// A pose so far to the east, with more fields.
fn pose(east: i32, more: &str) -> String {
    format!(r#"{{"type": "pose", "eastM": {east}, "northM": 0{more}}}"#)
}

/// State of this robot, as its RAM reports it.
fn ram_of(state: &RobotState) -> RobotState {
    let ids = Identifiers::default();
    let view = Robot::new(StationId(7), 1).ram();
    let ram = ram_from(&ids, state, &view, Availability::Available, 0, false).unwrap();
    let octets = encode(&ids, &ram).unwrap();
    let heard = Message::of(&ids, StationId(8), &Position::default(), &octets).unwrap();
    heard.state.unwrap()
}

/// A pose as a body says it, and what RAM says, half axis, speed and heading, and the packet, `isAccurate`.
const POSES: &str = r#"
                                                          | none | none | none | false
"errorM": 0.05                                            | 0.05 | none | none | true
"errorM": 0.2, "speedMps": 0, "headingDeg": 0             | 0.2  | 0    | 0    | true
"errorM": 3.5, "speedMps": 0.5, "headingDeg": -90         | 3.5  | 0.5  | 270  | true
"errorM": 40.5                                            | 40.5 | none | none | false
"speedMps": -0.5, "headingDeg": 90                        | none | none | 90   | false
"#;

#[test]
fn point_5_what_a_body_does_not_know_of_its_pose_is_unavailable() {
    let (mut body, mut other, _folder) = open(HELLO);
    assert_eq!(report(&mut body), Some(Report::Here));
    for ([more, error, speed, heading, is_accurate], at) in rows(POSES).zip(1..) {
        let comma = if more.is_empty() { "" } else { ", " };
        writeln!(other, "{}", pose(at, &format!("{comma}{more}"))).unwrap();
        while body.place() != Place::new(f64::from(at), 0.0) {
            std::thread::sleep(Duration::from_millis(1));
            assert_eq!(body.advance(0.0).pop(), None, "{more}");
        }
        let sent = ram_of(&body.state());
        let number = |value: Option<f64>| value.map_or("none".to_owned(), |it| it.to_string());
        let found = [
            number(sent.position.ellipse.map(|it| it.semi_major)),
            number(sent.speed.map(|it| it.value)),
            number(sent.heading.map(|it| it.value)),
            EgoPosition::of(&sent, 0).is_accurate.to_string(),
        ];
        assert_eq!(found, [error, speed, heading, is_accurate], "{more}");
        // A body that faces somewhere may walk backwards.
        assert_eq!(sent.drive_direction, DriveDirection::Unavailable);
    }
    for wrong in [
        "\"errorM\": 0",
        "\"errorM\": -1",
        "\"errorM\": 1001",
        "\"speedMps\": 1e999",
    ] {
        writeln!(other, "{}", pose(0, &format!(", {wrong}"))).unwrap();
        is_garbled(&mut body);
    }
}
