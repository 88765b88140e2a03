//! The named tasks are the same in every language: those of `TaskType::NAMED`. `CROSSGUARD_BLESS=1`
//! writes them where they stand between `<named tasks>` and `</named tasks>`. The messages of ROS 2 have the words of
//! the protocol as well.

use std::fmt::Write as _;
use std::path::Path;

use crossguard_protocol::words::Words;
use crossguard_protocol::{
    Corridor, FallbackPolicy, Notice, Output, Progress, Role, State, TaskType, Unavailability,
};

/// A name of a task in the spelling of a language.
fn spelled(name: &str, word: impl Fn(usize, &str) -> String) -> String {
    let mut words: Vec<String> = vec![String::new()];
    for c in name.chars() {
        if c.is_uppercase() {
            words.push(String::new());
        }
        let last = words.last_mut().expect("there is a first");
        last.push(c.to_ascii_lowercase());
    }
    let words = words.iter().enumerate().map(|(i, it)| word(i, it));
    words.collect()
}

/// `INITIAL_POS`
fn upper(name: &str) -> String {
    lower(name).to_uppercase()
}

/// `initial_pos`
fn lower(name: &str) -> String {
    spelled(name, |i, word| match i {
        0 => word.to_owned(),
        _ => format!("_{word}"),
    })
}

/// `InitialPos`
fn camel(name: &str) -> String {
    spelled(name, |_, word| {
        let (first, rest) = word.split_at(1);
        first.to_uppercase() + rest
    })
}

/// Lines made of each named task's value, name and meaning.
fn of_each(line: impl Fn(u8, &str, &str) -> String) -> String {
    let named = TaskType::NAMED.iter();
    let lines = named.map(|(task, name, meaning)| line(task.value(), name, meaning.trim()));
    lines.collect()
}

/// Python declares the tasks without names too.
fn python(value: impl Fn(u8) -> String, with_meaning: bool) -> String {
    let mut lines = String::new();
    for number in 0..16 {
        let value = value(number);
        let mut named = TaskType::NAMED.iter();
        match named.find(|(task, ..)| task.value() == number) {
            Some((_, name, meaning)) => {
                writeln!(lines, "    {} = {value}", upper(name)).unwrap();
                if with_meaning {
                    writeln!(lines, "    \"\"\"{}\"\"\"", meaning.trim()).unwrap();
                }
            }
            None => writeln!(lines, "    TASK{number} = {value}").unwrap(),
        }
    }
    lines
}

/// A text with what stands from a mark to the next one replaced.
fn replaced(text: &str, begin: &str, end: &str, by: &str) -> String {
    let (head, rest) = text.split_once(begin).expect("the first mark");
    let (_, tail) = rest.split_once(end).expect("the second mark");
    [head, begin, by, end, tail].concat()
}

/// A text with the named tasks between the lines of their marks.
fn between_marks(text: &str, mark: &str, comment: &str, tasks: &str) -> String {
    let begin = format!("{comment} <{mark}>\n");
    let end = format!("{comment} </{mark}>\n");
    let indent = text.lines().find(|line| line.ends_with(begin.trim_end()));
    let indent = indent.expect("a mark").len() - begin.trim_end().len();
    replaced(
        text,
        &begin,
        &end,
        &(tasks.to_owned() + &" ".repeat(indent)),
    )
}

/// Asserts that a file has the named tasks, or writes them.
fn assert_named(file: &str, change: impl Fn(&str) -> String) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .join(file);
    let text = std::fs::read_to_string(&path).unwrap();
    let changed = change(&text);
    if std::env::var_os("CROSSGUARD_BLESS").is_some() {
        std::fs::write(&path, changed).unwrap();
    } else {
        assert!(text == changed, "{file}; run: cargo xtask bless tasks");
    }
}

#[test]
fn asn1_has_the_named_tasks() {
    let names = of_each(|value, name, _| format!(" {name}({value}),"));
    let names = names.trim_end_matches(',').to_owned() + " ";
    assert_named("codec/asn1/Crossguard-Common.asn", |text| {
        let text = replaced(text, "TaskType ::= INTEGER {", "}", &names);
        replaced(&text, "TaskSet ::= BIT STRING {", "}", &names)
    });
}

#[test]
fn c_has_the_named_tasks() {
    let tasks = of_each(|value, name, meaning| {
        format!("    /// {meaning}\n    {} = {value},\n", camel(name))
    });
    assert_named("harness/c/src/codes.rs", |text| {
        between_marks(text, "named tasks", "//", &tasks)
    });
    let tasks =
        of_each(|_, name, _| format!("  {} = CROSSGUARD_TASK_{},\n", lower(name), upper(name)));
    assert_named("harness/c/include/crossguard.hpp", |text| {
        between_marks(text, "named tasks", "//", &tasks)
    });
}

#[test]
fn python_has_the_named_tasks() {
    assert_named("harness/python/python/crossguard/types.py", |text| {
        let types = python(|number| number.to_string(), true);
        let bits = python(|number| format!("1 << {number}"), false);
        let text = between_marks(text, "named tasks", "#", &types);
        between_marks(&text, "task bits", "#", &bits)
    });
}

/// Constants of a message: a word is itself, in the spelling of who says it.
fn constants(
    prefix: &str,
    words: &Words,
    but: &[&str],
    spelling: impl Fn(&str) -> String,
) -> String {
    let told = words.words.iter().filter(|it| !but.contains(&it.variant));
    let line = |it: &crossguard_protocol::words::Word| {
        let (first, rest) = it.variant.split_at(1);
        let name = upper(&(first.to_lowercase() + rest));
        let (meaning, word) = (it.meaning, spelling(it.name));
        format!("# {meaning}\nstring {prefix}{name}=\"{word}\"\n")
    };
    told.map(line).collect()
}

#[test]
fn ros_2_has_the_words() {
    let as_it_is = |name: &str| name.to_owned();
    let kebab = |name: &str| lower(name).replace('_', "-");
    let assert_words = |file: &str, parts: &[(&str, String)]| {
        assert_named(&format!("harness/ros2/{file}"), |text| {
            let part = |text: String, (mark, words): &(&str, String)| {
                between_marks(&text, mark, "#", words)
            };
            parts.iter().fold(text.to_owned(), part)
        });
    };
    let tasks = of_each(|_, name, meaning| {
        let constant = upper(name);
        format!("# {meaning}\nstring {constant}=\"{name}\"\n")
    });
    let policies = constants("", &FallbackPolicy::WORDS, &[], kebab);
    assert_words(
        "crossguard_msgs/action/Maneuver.action",
        &[("named tasks", tasks), ("policies", policies)],
    );
    // What is told by the lines of others, or by nobody.
    let untold = ["SendRam", "SendRmcm", "Notify"];
    let events = constants("", &Output::WORDS, &untold, as_it_is)
        + &constants("", &Notice::WORDS, &[], as_it_is);
    assert_words("crossguard_msgs/msg/Event.msg", &[("words", events)]);
    let progress = constants("", &Progress::WORDS, &[], as_it_is);
    assert_words("crossguard_msgs/msg/Follower.msg", &[("words", progress)]);
    let words = constants("STATE_", &State::WORDS, &[], as_it_is)
        + &constants("ROLE_", &Role::WORDS, &[], as_it_is)
        + &constants("CORRIDOR_", &Corridor::WORDS, &[], as_it_is);
    let why = constants("", &Unavailability::WORDS, &[], as_it_is);
    assert_words(
        "crossguard_msgs/msg/Status.msg",
        &[("words", words), ("unavailability", why)],
    );
    let tasks = of_each(|value, name, _| format!("    {value}: \"{name}\",\n"));
    assert_words(
        "crossguard_ros/crossguard_ros/node.py",
        &[("named tasks", tasks)],
    );
}

#[test]
fn names_are_spelled_as_each_language_does() {
    assert_eq!(upper("initialPos"), "INITIAL_POS");
    assert_eq!(lower("initialPos"), "initial_pos");
    assert_eq!(camel("initialPos"), "InitialPos");
}
