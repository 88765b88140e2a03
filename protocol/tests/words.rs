//! What robots, messages, inputs and outputs are called in logs, charts and JSON: the page `words.md`.

use std::collections::BTreeMap;
use std::fmt::{Display, Write as _};

use crossguard_protocol::words::{REASONS, Said, TABLE, Words};
use crossguard_protocol::*;

const HEAD: &str = "\
# Words

The words of the protocol: what happens to a robot, what it does, and why. `cargo xtask bless words` writes this page
from the rows of `words!` in `src`; C, C++, Python and ROS 2 have the same words.

A code is what interfaces without names use. Those of reasons are one space of numbers: a code has one name, and a word
that only carries another reason has code 0. JSON spells a word without content as its name, and any other as an object
with its name and content: one thing is as it is, several are a list, unless the words name them.
";

/// Calls a macro with all enumerations of words.
macro_rules! for_each_enumeration {
    ($call:ident) => {
        $call! {
            Event Output Notice Ignored Timer State Role Corridor Urgency Ending Progress Unavailability FallbackPolicy
            StopReason ReleaseReason EndReason GoneReason CorridorClosure Disengagement Failure Rejection Inequality
        }
    };
}

#[test]
fn a_code_of_a_reason_has_one_name() {
    let mut names = BTreeMap::new();
    for word in REASONS.iter().flat_map(|words| words.words) {
        let is_reason = |name| REASONS.iter().any(|words| words.name == name);
        let carries_another = word.fields.iter().any(|field| is_reason(field.of));
        assert_eq!(word.code == 0, carries_another, "{word:?}");
        if word.code != 0 {
            assert_eq!(*names.entry(word.code).or_insert(word.name), word.name);
        }
    }
    let codes = u8::try_from(names.len()).unwrap();
    assert!(names.into_keys().eq(1..=codes), "no code is left out");
}

#[cfg(feature = "serde")]
#[test]
fn json_has_the_names_of_the_table() {
    macro_rules! check {
        ($($name:ident)+) => {$(for (word, sample) in $name::WORDS.words.iter().zip($name::SAMPLES) {
            let json = serde_json::to_value(sample).unwrap();
            let tag = json.as_object().and_then(|it| it.keys().next()).cloned();
            assert_eq!(tag.as_deref().or(json.as_str()), Some(word.name));
            assert_eq!(serde_json::to_value(sample.kind()).unwrap(), word.name);
            assert_eq!(serde_json::from_value::<$name>(json).unwrap(), *sample);
        })+};
    }
    for_each_enumeration!(check);
}

/// A table of one enumeration, and a text of each of its words.
fn table(page: &mut String, words: &Words, samples: &[&dyn Display]) {
    let Words { name, meaning, .. } = words;
    writeln!(page, "\n## {name}\n\n{meaning}\n").unwrap();
    writeln!(page, "| code | name | comes with | for example | meaning |").unwrap();
    writeln!(page, "|--:|---|---|---|---|").unwrap();
    for (word, sample) in words.words.iter().zip(samples) {
        let fields = word
            .fields
            .iter()
            .map(|it| format!("{}: `{}`", it.name, it.of));
        let fields = fields.collect::<Vec<_>>().join(", ");
        let (code, name, meaning) = (word.code, word.name, word.meaning);
        writeln!(
            page,
            "| {code} | `{name}` | {fields} | {sample} | {meaning} |"
        )
        .unwrap();
    }
}

/// The outputs as plain records.
fn records(page: &mut String) {
    fn or_nothing<T: Display>(value: Option<T>) -> String {
        value.map_or_else(String::new, |value| value.to_string())
    }
    writeln!(page, "\n## Outputs as plain records\n").unwrap();
    writeln!(page, "| output | kind | notice | reason | unavailability | policy | task | request | station | session | open |").unwrap();
    writeln!(page, "|---|---|---|---|---|---|---|--:|--:|---|---|").unwrap();
    let notices = Notice::SAMPLES.iter().map(|it| Output::Notify(*it));
    let closures = CorridorClosure::SAMPLES.iter();
    let closures = closures.map(|it| Output::CorridorClosed(*it));
    let failed = Failure::Unavailable(Unavailability::LowBattery);
    let failed = CorridorClosure::NotEngaged(StationId(9), Disengagement::Failed(failed));
    let outputs = Output::SAMPLES
        .iter()
        .copied()
        .chain(notices)
        .chain(closures);
    for output in outputs.chain([Output::CorridorClosed(failed)]) {
        let it = Said::by(&output);
        let cells = [
            output.to_string(),
            it.kind.name().to_owned(),
            or_nothing(it.notice.map(NoticeKind::name)),
            or_nothing(it.reason.map(|word| word.name)),
            or_nothing(it.unavailability.map(Unavailability::name)),
            or_nothing(it.policy.map(FallbackPolicy::name)),
            or_nothing(it.task),
            or_nothing(it.request),
            or_nothing(it.station),
            or_nothing(it.session),
            or_nothing(it.open),
        ];
        writeln!(page, "| {} |", cells.join(" | ")).unwrap();
    }
}

/// What a robot of the story hears or is told next.
enum Next {
    /// The RAM of the other one.
    Ram,
    /// The newest RMCM.
    Rmcm,
    Tell(Event),
    Fires(Timer),
}

/// Two robots, a pedestrian and a follower that loses its leader: every input, output and state as text.
fn story() -> String {
    use Next::{Fires, Ram, Rmcm, Tell};
    let Event::PedestrianDetected(request) = Event::SAMPLES[0] else {
        panic!("the first event is a pedestrian");
    };
    let request = HelpRequest {
        followers: 1,
        ..request
    };
    let (follower, task) = (StationId(2), TaskType::MOVE);
    let steps = [
        (0, Tell(Event::PedestrianDetected(request))),
        (1, Ram),
        (0, Ram),
        (0, Tell(Event::AllAnswered)),
        (1, Ram),
        (0, Ram),
        (0, Tell(Event::CommandManeuver { follower, task })),
        (1, Rmcm),
        (0, Rmcm),
        (0, Ram),
        (0, Tell(Event::OpenCorridor)),
        (1, Fires(Timer::Safety)),
        (0, Ram),
        (1, Tell(Event::LeaveRequested)),
        (0, Tell(Event::LeaveRequested)),
        (1, Ram),
    ];
    let mut robots = [1, 2].map(|station| Robot::new(StationId(station), 3));
    let (mut text, mut rmcm) = (String::new(), Input::Elapsed(Millis(5)));
    for (who, next) in steps {
        let input = match next {
            Ram => Input::Ram {
                ram: robots[1 - who].ram(),
                distance: Decimetres(42),
            },
            Rmcm => rmcm,
            Tell(event) => Input::Local(event),
            Fires(timer) => Input::Expired(timer),
        };
        if let Input::Ram { ram, .. } = input {
            assert_eq!(format!("{input:#}"), format!("{ram:#}"), "as in a chart");
        }
        writeln!(text, "{}: {input}", who + 1).unwrap();
        for output in robots[who].step(&Config::default(), input).iter() {
            writeln!(text, "   {output}").unwrap();
            if let Output::SendRmcm(sent) = output {
                rmcm = Input::Rmcm(*sent);
            }
        }
        writeln!(text, "   = {}", robots[who]).unwrap();
    }
    text
}

#[test]
fn the_page_has_all_words_and_their_texts() {
    let mut page = HEAD.to_owned();
    let mut tables = 0;
    macro_rules! write_all {
        ($($name:ident)+) => {$(
            let samples: Vec<_> = $name::SAMPLES.iter().map(|it| it as &dyn Display).collect();
            table(&mut page, &$name::WORDS, &samples);
            tables += 1;
        )+};
    }
    for_each_enumeration!(write_all);
    assert_eq!(tables, TABLE.len());
    records(&mut page);
    let head = "\n## A story\n\nOutputs are indented; behind `=` is the robot afterwards.\n";
    write!(page, "{head}\n```text\n{}```\n", story()).unwrap();
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/words.md");
    if std::env::var_os("CROSSGUARD_BLESS").is_some() {
        std::fs::write(path, page).unwrap();
    } else {
        let committed = std::fs::read_to_string(path).unwrap();
        assert!(committed == page, "words.md; run: cargo xtask bless words");
    }
}
