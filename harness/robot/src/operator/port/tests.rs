//! The desk by itself: sockets of one process, records by hand, and no clock.

use std::cell::RefCell;
use std::io::{BufRead, BufReader};
use std::os::unix::net::UnixStream;
use std::rc::Rc;
use std::time::{SystemTime, UNIX_EPOCH};

use crossguard_codec::Battery;
use crossguard_protocol::{
    Availability, Config, StationId, TaskSet, TaskType, Unavailability, Urgency,
};

use serde_json::json;

use super::super::HELD_US;
use super::*;
use crate::port::prepare;
use crate::table::rows;

#[derive(Clone, Default)]
struct Told(Rc<RefCell<Vec<Order>>>);

impl Obeys for Told {
    fn order(&self, order: Order) {
        self.0.borrow_mut().push(order);
    }
}

impl Told {
    fn take(&self) -> Vec<Order> {
        self.0.take()
    }
}

fn counter() -> (Counter<Told>, Told) {
    let told = Told::default();
    let desk = Desk {
        robot: "Go2".to_owned(),
        station: 2,
        boot: 7,
        trusts_ros_graph: true,
        site: Site::default(),
        planned: None,
        feed: None,
    };
    (Counter::new(desk, told.clone()), told)
}

/// A client's end of a connection of this number.
/// A desk, and a program that has said hello.
fn greeted() -> (Counter<Told>, Told, BufReader<UnixStream>) {
    let (mut counter, told) = counter();
    let mut lines = connect(&mut counter, 0);
    heard(&mut lines);
    say(&mut counter, 0, HELLO);
    (counter, told, lines)
}

fn connect(counter: &mut Counter<Told>, number: u64) -> BufReader<UnixStream> {
    let (ours, theirs) = UnixStream::pair().unwrap();
    let (stream, _) = prepare(ours).unwrap();
    // A line that does not come is a test that fails.
    theirs
        .set_read_timeout(Some(Duration::from_mins(1)))
        .unwrap();
    counter.hear(Heard::Connected(number, stream), 0);
    BufReader::new(theirs)
}

fn say(counter: &mut Counter<Told>, number: u64, line: &str) {
    counter.hear(Heard::Line(number, line.to_owned()), 0);
}

const HELLO: &str = r#"{"type": "hello", "crossguard": 1}"#;

fn heard(from: &mut impl BufRead) -> Value {
    let mut line = String::new();
    from.read_line(&mut line).unwrap();
    serde_json::from_str(&line).unwrap()
}

fn step(robot: &mut Robot, at_us: u64, event: Event) -> Record {
    let input = Input::Local(event);
    let outputs = Box::new(robot.step(&Config::default(), input));
    let state = Box::new(robot.clone());
    Record {
        at_us,
        robot: "Go2".to_owned(),
        entry: Entry::Step {
            input,
            outputs,
            state,
        },
    }
}

/// Asserts that a line has these fields.
#[track_caller]
fn has(line: &Value, fields: &Value) {
    for (name, value) in fields.as_object().unwrap() {
        assert_eq!(&line[name], value, "{line}");
    }
}

/// Asserts that the robot was to count this cause once, and was told nothing else.
#[track_caller]
fn is_counted(told: &Told, counted: Cause) {
    let orders = told.take();
    let is_it = matches!(orders[..], [Order::Count(cause, _)] if cause == counted);
    assert!(is_it, "{orders:?}");
}

fn help() -> HelpRequest {
    HelpRequest {
        urgency: Urgency::High,
        followers: 2,
        tasks: TaskSet::of(&[TaskType::INITIAL_POS, TaskType::MOVE]),
        place: crossguard_protocol::Place::UNKNOWN,
    }
}

#[test]
fn each_line_is_an_order_or_is_refused_and_counted() {
    let (mut counter, told) = counter();
    let mut lines = connect(&mut counter, 0);
    let hello = json!({"type": "hello", "crossguard": 1, "robot": "Go2", "station": 2, "boot": 7, "trustsRosGraph": true});
    assert_eq!(heard(&mut lines), hello);
    say(&mut counter, 0, HELLO);
    let tell = |event| Some(Order::Tell(Stimulus::Event(event)));
    let stopped = Availability::Unavailable(Unavailability::EmergencyStop);
    let orders = [
        (
            r#"{"type": "event", "event": "openCorridor"}"#,
            tell(Event::OpenCorridor),
        ),
        (
            r#"{"type": "event", "event": {"pedestrianDetected": {"urgency": "high", "followers": 2, "tasks": 3}}}"#,
            tell(Event::PedestrianDetected(help())),
        ),
        (
            r#"{"type": "event", "event": {"availabilityChanged": {"unavailable": "emergencyStop"}}}"#,
            tell(Event::AvailabilityChanged(stopped)),
        ),
        (
            r#"{"type": "event", "event": "roadClear"}"#,
            Some(Order::Clear),
        ),
        (
            r#"{"type": "event", "event": {"commandManeuver": {"follower": 5, "task": 1}}}"#,
            Some(Order::Tell(Stimulus::Command {
                follower: StationId(5),
                task: TaskType::MOVE,
                parameters: crossguard_codec::TaskParameters::default(),
            })),
        ),
        (
            r#"{"type": "command", "line": "leave"}"#,
            tell(Event::LeaveRequested),
        ),
        (
            r#"{"type": "command", "line": "battery 40 charging"}"#,
            Some(Order::Battery(Battery {
                state_of_charge: Some(40.0),
                charging: true,
            })),
        ),
        (r#"{"type": "command", "line": "quit"}"#, Some(Order::Stop)),
        (HELLO, None),
        (r#"{"type": "command", "line": " "}"#, None),
    ];
    let first_refused = orders.len() + 2;
    for (line, expected) in orders {
        say(&mut counter, 0, line);
        assert_eq!(told.take(), Vec::from_iter(expected), "{line}");
    }
    for (nth, [line, why, doubts]) in (first_refused..).zip(rows(REFUSED)) {
        match line.as_str() {
            "" => counter.hear(Heard::Unread(0, "a line has more"), 0),
            line => say(&mut counter, 0, line),
        }
        let refused = heard(&mut lines);
        has(&refused, &json!({"type": "refused", "line": nth}));
        let answer = refused["why"].as_str().unwrap();
        assert!(answer.starts_with(&why), "{line}: {answer}");
        let mut orders = told.take();
        let in_vain = orders.pop_if(|it| matches!(it, Order::LookedInVain(why) if why == answer));
        assert_eq!(in_vain.is_some(), doubts == "yes", "{line}");
        let is_it = matches!(orders[..], [Order::Count(Cause::OperatorGarbled, _)]);
        assert!(is_it, "{line}: {orders:?}");
    }
}

#[test]
fn the_port_takes_the_commands_that_say_what_they_mean_for_somebody_on_the_road() {
    let (counter, _) = counter();
    for command in super::super::COMMANDS {
        let words = match command.name {
            "wait" => "wait 1",
            "until" => "until idle",
            name => name,
        };
        let line = json!({"type": "command", "line": words}).to_string();
        let why = counter.understand(&line).err().unwrap_or_default();
        let is_of_console = why.ends_with("is for the console");
        assert_eq!(is_of_console, command.on_road.is_none(), "{words}: {why}");
    }
}

/// A line that is refused, why, and whether the robot may have missed somebody by it. Hazard: a sensor has somebody on the road
/// at a place that is no number, the frame is refused, and those before and after it clear the road.
const REFUSED: &str = r#"
{"type": "frame", "people": []}                           | a frame wants either 'at_s'        | yes
{"type": "frame", "unix_s": 1, "people": [{"position_m": [NaN, 0.0]}]} | expected value        | yes
{"type": "frame", "unix_s": 99999999999, "people": []}    | unix_s is 99999999999: that is in the future | yes
{"type": "command", "line": "wait 5"}                     | 'wait 5' is for the console        | no
{"type": "command", "line": "dance"}                      | no command 'dance'                 | no
{"type": "command"}                                       | a command wants a 'line'           | no
{"type": "event", "event": "allAnswered"}                 | 'allAnswered' is for the kit alone | no
{"type": "person", "id": 7, "position_m": [1e9, 0]}       | position_m is                      | yes
{"type": "dance"}                                         | a 'type' is wanted                 | yes
no json                                                   | expected ident                     | yes
                                                          | a line has more                    | yes
"#;

#[test]
fn what_the_robot_does_is_told_with_its_state_at_every_change_and_as_a_beat() {
    let (mut counter, _, mut lines) = greeted();
    let mut robot = Robot::new(StationId(2), 7);
    counter.record(&step(&mut robot, 5, Event::OpenCorridor), 5);
    let ignored = json!({"type": "ignored", "event": "openCorridor", "reason": "notLeading"});
    has(&heard(&mut lines), &ignored);
    assert_eq!(heard(&mut lines)["state"], "Idle");
    counter.record(&step(&mut robot, 9, Event::PedestrianDetected(help())), 9);
    has(
        &heard(&mut lines),
        &json!({"type": "act", "output": "lockIdentity"}),
    );
    let state = heard(&mut lines);
    has(
        &state,
        &json!({"state": "HelpRequested", "role": "requester", "corridor": "clear"}),
    );
    assert!(state.get("openMs").is_none() && state["session"]["leader"] == 2);
    // A detector that never says anything keeps go away, and programs hear why.
    let why = "no sight".to_owned();
    let entry = Entry::Hindered { why };
    let robot = "Go2".to_owned();
    let at_us = 9;
    counter.record(
        &Record {
            at_us,
            robot,
            entry,
        },
        9,
    );
    has(
        &heard(&mut lines),
        &json!({"type": "hindered", "why": "no sight"}),
    );
    // Nothing more is told before it is time.
    counter.elapse(BEAT_US);
    counter.elapse(BEAT_US + 9);
    assert_eq!(heard(&mut lines)["atUs"], BEAT_US + 9);
}

#[test]
fn a_client_that_does_not_read_says_no_hello_or_is_one_too_many_loses_its_connection_alone() {
    let (mut counter, told) = counter();
    let mut robot = Robot::new(StationId(2), 7);
    let mut reads = connect(&mut counter, 0);
    let mut mute = connect(&mut counter, 1);
    let _sleeps = connect(&mut counter, 2);
    let mut other_version = connect(&mut counter, 3);
    say(&mut counter, 0, HELLO);
    say(&mut counter, 2, HELLO);
    say(&mut counter, 3, r#"{"type": "hello", "crossguard": 2}"#);
    heard(&mut other_version);
    let why = json!({"why": "version 2: 1 is spoken here"});
    has(&heard(&mut other_version), &why);
    assert_eq!(other_version.read_line(&mut String::new()).unwrap(), 0);
    is_counted(&told, Cause::OperatorGarbled);
    counter.elapse(GREETING_US);
    heard(&mut mute);
    assert_eq!(mute.read_line(&mut String::new()).unwrap(), 0);
    is_counted(&told, Cause::OperatorGarbled);
    // Lines that nobody reads fill the socket.
    let mut at_us = 0;
    while counter.clients.len() > 1 {
        at_us += 1;
        assert!(at_us < 100_000, "it never fills");
        counter.record(&step(&mut robot, at_us, Event::OpenCorridor), at_us);
        while heard(&mut reads)["type"] != "ignored" {}
    }
    is_counted(&told, Cause::OperatorSlow);
    let more = (10..18).map(|number| connect(&mut counter, number));
    let mut more: Vec<_> = more.collect();
    assert_eq!(heard(&mut more.pop().unwrap())["type"], "refused");
    is_counted(&told, Cause::OperatorsFull);
    // One that has gone away is not slow, also when a line to it comes first.
    drop(reads);
    counter.record(&step(&mut robot, at_us + 1, Event::OpenCorridor), at_us + 1);
    assert!(told.take().is_empty() && !counter.clients.contains_key(&0));
    // One that goes away makes room, and the robot is told nothing.
    counter.hear(Heard::Closed(10), 0);
    assert_eq!(heard(&mut connect(&mut counter, 18))["type"], "hello");
    assert!(told.take().is_empty());
}

/// Hazard: a person says that the road is clear, the robot hangs, somebody steps on the road, and the robot goes on.
#[test]
fn what_was_said_while_the_robot_was_held_is_dropped_and_counted() {
    for (held_us, is_dropped) in [(HELD_US - 1, false), (HELD_US, true)] {
        let (mut counter, told, mut lines) = greeted();
        counter.wake(held_us);
        let mut later = connect(&mut counter, 1);
        for number in [0, 1] {
            say(&mut counter, number, HELLO);
            say(
                &mut counter,
                number,
                r#"{"type": "command", "line": "clear"}"#,
            );
        }
        if !is_dropped {
            assert!(told.take().contains(&Order::Clear));
            continue;
        }
        for lines in [&mut lines, &mut later] {
            has(&heard(lines), &json!({"type": "refused", "line": 0}));
            assert_eq!(lines.read_line(&mut String::new()).unwrap(), 0);
        }
        let orders = told.take();
        let is_held = |it: &Order| matches!(it, Order::Count(Cause::OperatorHeld, _));
        assert!(
            orders.len() == 2 && orders.iter().all(is_held),
            "{orders:?}"
        );
    }
}

/// Hazard: one operator stops a robot, and a supervisor that sees an unavailable robot says `available` at once.
#[test]
fn a_stop_is_not_ended_at_once_by_another_program() {
    let (mut counter, told, _lines) = greeted();
    let mut robot = Robot::new(StationId(2), 7);
    let stopped = Availability::Unavailable(Unavailability::EmergencyStop);
    let stop = step(&mut robot, 9_000_000, Event::AvailabilityChanged(stopped));
    counter.record(&stop, 9_000_000);
    let available = json!({"type": "command", "line": "available"}).to_string();
    for (at_us, is_taken) in [(9_100_000, false), (12_000_000, false), (15_000_000, true)] {
        counter.hear(Heard::Line(0, available.clone()), at_us);
        let is_event = |it: &Order| matches!(it, Order::Tell(_));
        assert_eq!(told.take().iter().any(is_event), is_taken, "{at_us}");
    }
}

/// Hazard: two detectors number themselves 0. Frames of the one whose clock is behind are dropped, and the person that it alone
/// has is nobody.
#[test]
fn a_source_is_of_one_program_at_a_time() {
    let (mut counter, told, _lines) = greeted();
    let mut second = connect(&mut counter, 1);
    heard(&mut second);
    say(&mut counter, 1, HELLO);
    let now_s = SystemTime::now().duration_since(UNIX_EPOCH).unwrap();
    let frame = |source| {
        let now_s = now_s.as_secs_f64();
        json!({"type": "frame", "source": source, "unix_s": now_s, "people": []}).to_string()
    };
    let late_us = 2_300_000;
    for (number, source, at_us, is_refused) in [
        (0, 0, 0, false),
        (1, 0, 100_000, true),
        (1, 1, 200_000, false),
        (0, 0, 300_000, false),
        (1, 0, late_us - 1, true),
        // The first one hangs.
        (1, 0, late_us, false),
        (0, 0, late_us, true),
        // The second one is started again.
        (2, 0, late_us, false),
    ] {
        if number == 2 {
            counter.hear(Heard::Closed(1), at_us);
            connect(&mut counter, 2);
            say(&mut counter, 2, HELLO);
        }
        counter.hear(Heard::Line(number, frame(source)), at_us);
        let orders = told.take();
        let found = match orders[..] {
            [Order::Looked(..)] => false,
            [
                Order::Count(Cause::FrameDropped(_), _),
                Order::LookedInVain(_),
            ] => true,
            _ => panic!("{orders:?}"),
        };
        assert_eq!(found, is_refused, "{number} {source} {at_us}");
    }
    let why =
        "another program says the frames of source 0: give each detector a 'source' of its own";
    let refused = json!({"type": "refused", "line": 2, "why": why});
    has(&heard(&mut second), &refused);
}

/// Hazard: a detector at the port has the number of the one that writes to the pipe of `--perceived`: frames of both count as those of
/// one.
#[test]
fn a_source_of_the_feed_is_of_no_program_at_the_port() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("people.jsonl");
    std::fs::write(&path, r#"{"at_s": 0, "source": 1, "people": []}"#).unwrap();
    let feed = Feed::open(&path).unwrap();
    let (mut counter, told, _lines) = greeted();
    counter.desk.feed = Some(feed.clone());
    let mut is_taken = |source| {
        let now_s = SystemTime::now().duration_since(UNIX_EPOCH).unwrap();
        let now_s = now_s.as_secs_f64();
        let frame = json!({"type": "frame", "source": source, "unix_s": now_s, "people": []});
        say(&mut counter, 0, &frame.to_string());
        matches!(told.take()[..], [Order::Looked(..)])
    };
    assert_eq!([0, 1].map(&mut is_taken), [true, true]);
    while feed.due().is_empty() {
        std::thread::sleep(Duration::from_millis(1));
    }
    assert_eq!([0, 1].map(is_taken), [true, false]);
}

/// Hazard: `ros2 topic pub` without `--once`, or a button that sticks, says on and on that the road is clear. The next guard whose
/// leader dies leaves its person in the moment in which it falls back.
#[test]
fn what_only_a_person_says_is_not_taken_on_and_on() {
    let (mut counter, told, mut lines) = greeted();
    for word in ["clear", "tell taskCompleted", "available"] {
        let line = json!({"type": "command", "line": word}).to_string();
        let mut taken = Vec::new();
        // Once a second for a minute, and once again after a pause.
        for at_us in (0..60).chain([62, 65]).map(|s| s * 1_000_000) {
            counter.hear(Heard::Line(0, line.clone()), at_us);
            let counts = |it: &Order| matches!(it, Order::Count(Cause::OperatorRepeats, _));
            let orders = told.take();
            if !orders.iter().any(counts) {
                taken.push(at_us / 1_000_000);
            }
        }
        assert_eq!(taken, [0, 62, 65], "{word}");
        has(&heard(&mut lines), &json!({"type": "refused"}));
    }
}
