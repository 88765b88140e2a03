//! The words of the protocol in the languages of its bindings, written from [`TABLE`]: `cargo xtask bless languages`.
//!
//! What is written stands between marks of a file, like `<words>` and `</words>`. So do the named tasks.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;
use std::sync::Mutex;

use crossguard_protocol::TaskType;
use crossguard_protocol::words::{Field, REASONS, TABLE, Word, Words};

/// Holds a file against what it should be, or writes it. A package of this crate has no bindings.
fn assert_file(file: &str, change: impl Fn(&str) -> String) {
    // Some files have several parts, which tests write at the same time.
    static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());
    let _guard = ONE_AT_A_TIME.lock();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(file);
    if !path.is_file() {
        return;
    }
    let text = std::fs::read_to_string(&path).unwrap();
    let changed = change(&text);
    if std::env::var_os("CROSSGUARD_BLESS").is_some() {
        std::fs::write(&path, changed).unwrap();
    } else {
        assert!(text == changed, "{file}; run: cargo xtask bless languages");
    }
}

/// A text with what stands from one to the other replaced.
fn replaced(text: &str, begin: &str, end: &str, by: &str) -> String {
    let (head, rest) = text.split_once(begin).expect("what stands before it");
    let (_, tail) = rest.split_once(end).expect("what stands behind it");
    [head, begin, by, end, tail].concat()
}

/// Holds a file against what stands between its marks, which are comments of a line.
fn assert_words(file: &str, mark: &str, words: &str) {
    let (begin, end) = (format!("<{mark}>\n"), format!("</{mark}>\n"));
    assert_file(file, |text| {
        let (_, rest) = text.split_once(&begin).expect("the mark before it");
        let (inside, _) = rest.split_once(&end).expect("the mark behind it");
        let (_, comment) = inside.rsplit_once('\n').unwrap_or(("", inside));
        replaced(text, &begin, &end, &(words.to_owned() + comment))
    });
}

/// An enumeration by its name.
fn words(name: &str) -> &'static Words {
    let mut all = TABLE.iter();
    all.find(|words| words.name == name)
        .expect("it is in the table")
}

fn is_reason(name: &str) -> bool {
    REASONS.iter().any(|words| words.name == name)
}

/// `_` before each capital letter but the first, all in upper case.
fn upper(variant: &str) -> String {
    let parted = |(i, c): (usize, char)| {
        (i > 0 && c.is_uppercase())
            .then_some('_')
            .into_iter()
            .chain([c])
    };
    let all: String = variant.chars().enumerate().flat_map(parted).collect();
    all.to_uppercase()
}

/// The fields of a struct of C that tell a field of a word.
fn fields_of_c(field: &Field) -> &'static [&'static str] {
    match field.of {
        "HelpRequest" => &["urgency", "followers", "tasks", "place"],
        "StationId" => &["station"],
        "TaskType" => &["task", "parameters"],
        "SessionId" => &["session"],
        "ManeuverId" => &["session", "request"],
        "Maneuver" => &["session", "request", "task"],
        "Availability" => &["unavailability"],
        "Option<UniqueNumber>" => &["session.number"],
        "u16" => &["boot"],
        "Millis" => &["open_ms"],
        "Rmcm" => &["message"],
        "FallbackPolicy" => &["policy"],
        "Notice" => &["notice"],
        "GoneReason" | "Rejection" | "Failure" | "StopReason" | "ReleaseReason" => &["reason"],
        "EndReason" | "CorridorClosure" | "Ignored" => &["reason", "station"],
        other => panic!("C has no fields for {other}"),
    }
}

/// What a word means, with the fields that are set with it.
fn meaning_of_c(word: &Word) -> String {
    let fields = word.fields.iter().flat_map(fields_of_c);
    let fields: Vec<_> = fields.map(|it| format!("`{it}`")).collect();
    match &fields[..] {
        [] => word.meaning.to_owned(),
        fields => format!("{} With {}.", word.meaning, fields.join(", ")),
    }
}

/// An enumeration of C: its words by name, code and meaning, in the order of codes.
fn enumeration_of_c(name: &str, about: &str, words: &[(&str, u8, String)]) -> String {
    let derived = "#[derive(Clone, Copy, PartialEq, Eq, Debug)]\n#[repr(u8)]";
    let mut text = format!("\n/// {about}\n{derived}\npub enum Crossguard{name} {{\n");
    let by_code: BTreeMap<_, _> = words
        .iter()
        .map(|(name, code, meaning)| (code, (name, meaning)))
        .collect();
    assert_eq!(
        by_code.len(),
        words.len(),
        "one word for each code of {name}"
    );
    for (code, (name, meaning)) in by_code {
        writeln!(text, "    /// {meaning}\n    {name} = {code},").unwrap();
    }
    text + "}\n"
}

#[test]
fn c_has_the_words() {
    let of = |name: &str| -> Vec<_> {
        let words = words(name).words.iter();
        words
            .map(|word| (word.variant, word.code, meaning_of_c(word)))
            .collect()
    };
    let other = |variant, code, meaning: &str| (variant, code, meaning.to_owned());
    let mut text = String::new();
    let mut write = |name, about, more: Vec<_>, words: Vec<_>| {
        text += &enumeration_of_c(name, about, &[more, words].concat());
    };
    for (name, c) in [
        ("State", "State"),
        ("Role", "Role"),
        ("Urgency", "Urgency"),
        ("FallbackPolicy", "Fallback"),
        ("Corridor", "Corridor"),
        ("Event", "EventKind"),
    ] {
        write(c, words(name).meaning, Vec::new(), of(name));
    }
    let takes_part = other("None", 0, "It takes part.");
    write(
        "Unavailability",
        words("Unavailability").meaning,
        vec![takes_part],
        of("Unavailability"),
    );
    let none = other("None", 0, "There is none, or it was not acknowledged.");
    let acknowledged = other(
        "Acknowledged",
        1,
        "It is acknowledged, and nothing is reported yet.",
    );
    let mut progress = of("Progress");
    for (_, _, meaning) in &mut progress {
        // A view has no room for why.
        *meaning = meaning.replace(" With `reason`.", "");
    }
    write(
        "Progress",
        "How far a command is.",
        vec![none, acknowledged],
        progress,
    );
    let none = other("None", 0, "None.");
    write("Notice", words("Notice").meaning, vec![none], of("Notice"));
    // Messages are sent as packets, whatever message it is.
    let send =
        "Send a packet: `message`, and where packet and message are among the packets of the turn.";
    let mut outputs = of("Output");
    outputs.retain(|(variant, ..)| !variant.starts_with("Send"));
    for (variant, ..) in &mut outputs {
        if *variant == "Notify" {
            *variant = "Notice";
        }
    }
    write(
        "OutputKind",
        "What the robot is to do.",
        vec![other("Send", 0, send)],
        outputs,
    );
    // One word may stand in several enumerations; what it means in the first of them is said.
    let mut reasons = BTreeMap::new();
    for word in REASONS
        .iter()
        .flat_map(|words| words.words)
        .filter(|word| word.code != 0)
    {
        let variant = if word.variant == "Maneuver" {
            "ManeuverFailed"
        } else {
            word.variant
        };
        reasons
            .entry(word.code)
            .or_insert((variant, word.code, word.meaning.to_owned()));
    }
    let about =
        "Why something is as it is. With `Unavailable`, the output's `unavailability` says more.";
    let none = other("None", 0, "None is given.");
    write("Reason", about, vec![none], reasons.into_values().collect());
    assert_words("harness/c/src/codes/generated.rs", "words", &text);
    let plain = words("Event").words.iter();
    let plain = plain.filter(|word| word.fields.is_empty()).map(|word| {
        let (upper, meaning) = (upper(word.variant), word.meaning);
        let event = format!("{{ return Event{{CROSSGUARD_EVENT_KIND_{upper}}}; }}");
        let name = upper.to_lowercase();
        format!("  /// {meaning}\n  static Event {name}() noexcept {event}\n")
    });
    let plain: String = plain.collect();
    assert_words("harness/c/include/crossguard.hpp", "plain events", &plain);
}

/// Lines of at most 110 characters, behind this indentation.
fn wrapped(text: &str, indent: &str) -> String {
    let (mut lines, mut length) = (indent.to_owned(), indent.len());
    for word in text.split_whitespace() {
        let is_first = length == indent.len();
        if !is_first && length + 1 + word.chars().count() > 110 {
            lines = lines + "\n" + indent;
            length = indent.len();
        } else if !is_first {
            lines.push(' ');
            length += 1;
        }
        lines += word;
        length += word.chars().count();
    }
    lines + "\n"
}

/// A field of a class of Python: its name, and its type with its default.
fn field_of_python(field: &Field) -> (String, String) {
    let of = match field.of {
        "StationId" | "u16" => "int".to_owned(),
        "Millis" => return ("open_ms".to_owned(), "int".to_owned()),
        "Option<UniqueNumber>" => "UniqueNumber | None = None".to_owned(),
        "HelpRequest" => "HelpRequest = HelpRequest()".to_owned(),
        "Rmcm" => "messages.Rmcm".to_owned(),
        name if is_reason(name) => format!("reasons.{name}"),
        name => name.to_owned(),
    };
    (field.name.to_owned(), of)
}

/// The class of a word.
fn class_of_python(word: &Word, more: &str) -> String {
    let is_positional = !word.fields.is_empty() && !word.names_fields;
    let base = if is_positional {
        "Positional"
    } else {
        "Variant"
    };
    let meaning = wrapped(&format!("\"\"\"{}\"\"\"", word.meaning), "    ");
    let mut text = format!(
        "\n\n@dataclass(frozen=True, slots=True)\nclass {}({base}):\n{meaning}",
        word.variant
    );
    for (i, field) in word.fields.iter().enumerate() {
        let (name, of) = field_of_python(field);
        let blank = if i == 0 { "\n" } else { "" };
        writeln!(text, "{blank}    {name}: {of}").unwrap();
    }
    text + more
}

/// A union of classes.
fn union_of_python(words: &Words) -> String {
    let Words { name, meaning, .. } = words;
    let arms: Vec<_> = words.words.iter().map(|word| word.variant).collect();
    let in_a_line = arms.join(" | ");
    let line = match in_a_line.len() {
        length if format!("{name}: TypeAlias = ").len() + length <= 110 => {
            format!("{name}: TypeAlias = {in_a_line}\n")
        }
        ..=106 => format!("{name}: TypeAlias = (\n    {in_a_line}\n)\n"),
        _ => format!("{name}: TypeAlias = (\n    {}\n)\n", arms.join("\n    | ")),
    };
    format!(
        "\n\n{line}{}",
        wrapped(&format!("\"\"\"{meaning}\"\"\""), "")
    )
}

/// An enumeration without fields.
fn enumeration_of_python(words: &Words) -> String {
    let Words { name, meaning, .. } = words;
    let meaning = wrapped(&format!("\"\"\"{meaning}\"\"\""), "    ");
    let mut text = format!("\n\nclass {name}(enum.Enum):\n{meaning}\n");
    for word in words.words {
        let meaning = wrapped(&format!("\"\"\"{}\"\"\"", word.meaning), "    ");
        write!(
            text,
            "    {} = \"{}\"\n{meaning}",
            upper(word.variant),
            word.name
        )
        .unwrap();
    }
    text
}

#[test]
fn python_has_the_words() {
    let folder = "harness/python/python/crossguard";
    let assert_python = |file: &str, text: String| {
        assert_words(&format!("{folder}/{file}.py"), "words", &(text + "\n\n"));
    };
    let classes = |name: &str| -> String {
        let words = words(name).words.iter();
        words.map(|word| class_of_python(word, "")).collect()
    };
    for (file, name) in [
        ("events", "Event"),
        ("notices", "Notice"),
        ("timers", "Timer"),
    ] {
        assert_python(file, classes(name) + &union_of_python(words(name)));
    }
    let outputs = words("Output").words.iter().map(|word| match word.variant {
        // An endpoint says it with the command that it heard.
        "StartManeuver" => class_of_python(
            word,
            "    parameters: TaskParameters = TaskParameters()\n    \"\"\"Where and how, by the command that an \
            endpoint heard; the state machine itself knows nothing of it.\"\"\"\n",
        ),
        _ => class_of_python(word, ""),
    });
    let acts = words("Output").words.iter().map(|word| word.variant);
    let acts: Vec<_> = acts.filter(|it| !it.starts_with("Send")).collect();
    let acts = format!("\n\nAct: TypeAlias = (\n    {}\n)\n", acts.join("\n    | "));
    let about = "\"\"\"An output that is no message.\"\"\"\n";
    let unions = union_of_python(words("Output")) + &acts + about;
    assert_python("outputs", outputs.collect::<String>() + &unions);
    let types = ["State", "Role", "Urgency", "FallbackPolicy"];
    assert_python(
        "types",
        types
            .map(|name| enumeration_of_python(words(name)))
            .concat(),
    );

    // A reason that can be given in several places is one class.
    let (mut text, mut unions) = (
        enumeration_of_python(words("Unavailability")),
        String::new(),
    );
    let mut known = BTreeMap::new();
    for words in REASONS {
        if words.words.iter().all(|word| word.fields.is_empty()) {
            text += &enumeration_of_python(words);
            continue;
        }
        for word in words.words {
            let fields = *known.entry(word.variant).or_insert_with(|| {
                text += &class_of_python(word, "").replace("reasons.", "");
                word.fields
            });
            assert_eq!(fields, word.fields, "{} is one class", word.variant);
        }
        unions += &union_of_python(words);
    }
    assert_python("reasons", text + &unions);
}

/// `initialPos` as `InitialPos`.
fn camel(name: &str) -> String {
    let (first, rest) = name.split_at(1);
    first.to_uppercase() + rest
}

/// Lines made of each named task's value, name and meaning.
fn of_each_task(line: impl Fn(u8, &str, &str) -> String) -> String {
    let named = TaskType::NAMED.iter();
    let lines = named.map(|(task, name, meaning)| line(task.value(), name, meaning.trim()));
    lines.collect()
}

#[test]
fn asn1_has_the_named_tasks() {
    let names = of_each_task(|value, name, _| format!(" {name}({value}),"));
    let names = names.trim_end_matches(',').to_owned() + " ";
    assert_file("codec/asn1/Crossguard-Common.asn", |text| {
        let text = replaced(text, "TaskType ::= INTEGER {", "}", &names);
        replaced(&text, "TaskSet ::= BIT STRING {", "}", &names)
    });
}

#[test]
fn c_has_the_named_tasks() {
    let c = |value, name: &str, meaning: &str| {
        format!("    /// {meaning}\n    {} = {value},\n", camel(name))
    };
    assert_words("harness/c/src/codes.rs", "named tasks", &of_each_task(c));
    let cpp = |_, name: &str, _: &str| {
        let upper = upper(name);
        format!("  {} = CROSSGUARD_TASK_{upper},\n", upper.to_lowercase())
    };
    assert_words(
        "harness/c/include/crossguard.hpp",
        "named tasks",
        &of_each_task(cpp),
    );
}

/// Constants of a message of ROS 2: a word is itself, in the spelling of who says it.
fn constants(prefix: &str, of: &str, but: &[&str], spelling: impl Fn(&str) -> String) -> String {
    let told = words(of)
        .words
        .iter()
        .filter(|word| !but.contains(&word.variant));
    let line = |word: &Word| {
        let (name, said, meaning) = (upper(word.variant), spelling(word.name), word.meaning);
        format!("# {meaning}\nstring {prefix}{name}=\"{said}\"\n")
    };
    told.map(line).collect()
}

#[test]
fn ros_2_has_the_words() {
    let as_it_is = |name: &str| name.to_owned();
    let kebab = |name: &str| upper(name).to_lowercase().replace('_', "-");
    let all = |of: &str| constants("", of, &[], as_it_is);
    let assert_part = |file: &str, mark: &str, words: &str| {
        assert_words(&format!("harness/ros2/{file}"), mark, words);
    };

    let action = "crossguard_msgs/action/Maneuver.action";
    let tasks = of_each_task(|_, name, meaning| {
        format!("# {meaning}\nstring {}=\"{name}\"\n", upper(name))
    });
    assert_part(action, "named tasks", &tasks);
    assert_part(
        action,
        "policies",
        &constants("", "FallbackPolicy", &[], kebab),
    );
    // What is told by the lines of others, or by nobody.
    let untold = ["SendRam", "SendRmcm", "Notify"];
    let events = constants("", "Output", &untold, as_it_is) + &all("Notice");
    assert_part("crossguard_msgs/msg/Event.msg", "words", &events);
    assert_part(
        "crossguard_msgs/msg/Follower.msg",
        "words",
        &all("Progress"),
    );
    let parts = [
        ("STATE_", "State"),
        ("ROLE_", "Role"),
        ("CORRIDOR_", "Corridor"),
    ];
    let parts = parts.map(|(prefix, of)| constants(prefix, of, &[], as_it_is));
    assert_part("crossguard_msgs/msg/Status.msg", "words", &parts.concat());
    assert_part(
        "crossguard_msgs/msg/Status.msg",
        "unavailability",
        &all("Unavailability"),
    );
    let tasks = of_each_task(|value, name, _| format!("    {value}: \"{name}\",\n"));
    assert_part(
        "crossguard_ros/crossguard_ros/node.py",
        "named tasks",
        &tasks,
    );
}

/// Python declares the tasks without names too.
fn tasks_of_python(value: impl Fn(u8) -> String, with_meaning: bool) -> String {
    let mut lines = String::new();
    for number in 0..16 {
        let value = value(number);
        let mut named = TaskType::NAMED.iter();
        let named = named.find(|(task, ..)| task.value() == number);
        let name = named.map_or_else(|| format!("TASK{number}"), |(_, name, _)| upper(name));
        writeln!(lines, "    {name} = {value}").unwrap();
        if let Some((_, _, meaning)) = named.filter(|_| with_meaning) {
            writeln!(lines, "    \"\"\"{}\"\"\"", meaning.trim()).unwrap();
        }
    }
    lines
}

#[test]
fn python_has_the_named_tasks() {
    let file = "harness/python/python/crossguard/types.py";
    assert_words(
        file,
        "named tasks",
        &tasks_of_python(|number| number.to_string(), true),
    );
    assert_words(
        file,
        "task bits",
        &tasks_of_python(|number| format!("1 << {number}"), false),
    );
}
