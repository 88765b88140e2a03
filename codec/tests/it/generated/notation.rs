//! How the notation of `asn1!` is written: names in Rust's spelling, comments, lines.

use std::iter;

/// Columns of a line.
pub(crate) const WIDTH: usize = 100;

/// `stationID` as `station_id`.
pub(crate) fn snake(name: &str) -> String {
    let mut snake = String::new();
    let mut before = '_';
    for letter in name.chars() {
        if letter.is_uppercase() && (before.is_lowercase() || before.is_ascii_digit()) {
            snake.push('_');
        }
        snake.extend(letter.to_lowercase());
        before = letter;
    }
    snake
}

/// `outOfRange` as `OUT_OF_RANGE`.
pub(crate) fn screaming(name: &str) -> String {
    snake(name).to_uppercase()
}

/// `alt-000-05` as `Alt000_05`.
pub(crate) fn pascal(name: &str) -> String {
    let mut pascal = String::new();
    for part in name.split('-') {
        let is_number = part.starts_with(|c: char| c.is_ascii_digit());
        if is_number && pascal.ends_with(|c: char| c.is_ascii_digit()) {
            pascal.push('_');
        }
        let (first, rest) = part.split_at(1);
        pascal += &first.to_uppercase();
        pascal += rest;
    }
    pascal
}

/// The name that serde makes of a value in Rust's spelling: `InPosition` as `inPosition`.
pub(crate) fn camel_of_pascal(name: &str) -> String {
    let (first, rest) = name.split_at(1);
    first.to_lowercase() + rest
}

/// Thousands apart from five digits on.
pub(crate) fn number(number: i64) -> String {
    let digits = number.unsigned_abs().to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && digits.len() > 4 && (digits.len() - index).is_multiple_of(3) {
            text.push('_');
        }
        text.push(digit);
    }
    if number < 0 { format!("-{text}") } else { text }
}

/// Items as lines, as many to a line as it can have, each but the last followed by a comma.
pub(crate) fn filled(items: &[String], indent: usize) -> String {
    let count = items.len();
    let comma = |index| if index + 1 < count { "," } else { "" };
    let items = items.iter().enumerate();
    let words: Vec<_> = items
        .map(|(i, item)| format!("{item}{}", comma(i)))
        .collect();
    wrapped(words.iter().map(String::as_str), &" ".repeat(indent))
}

/// Words as lines that begin with `prefix`.
pub(crate) fn wrapped<'a>(words: impl Iterator<Item = &'a str>, prefix: &str) -> String {
    let mut lines: Vec<String> = Vec::new();
    for word in words {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= WIDTH => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(format!("{prefix}{word}")),
        }
    }
    lines.join("\n")
}

/// A comment of a module as documentation in Rust.
pub(crate) fn doc(comment: &str, indent: &str, mark: &str) -> String {
    let before = iter::once("").chain(comment.split(' '));
    let words = before.zip(comment.split(' '));
    let words: Vec<_> = words.map(|(before, word)| code(before, word)).collect();
    wrapped(
        words.iter().map(String::as_str),
        &format!("{indent}{mark} "),
    ) + "\n"
}

/// Marks a word that is code, `stationId`, `alt-000-05` or a name of the dictionary, for rustdoc.
fn code(before: &str, word: &str) -> String {
    let is_mark = |c: char| !c.is_alphanumeric();
    let name = word.trim_matches(is_mark);
    let letters = || name.chars().zip(name.chars().skip(1));
    let is_camel = letters().any(|(a, b)| a.is_lowercase() && b.is_uppercase());
    let is_value = name.contains("-0") && name.starts_with(char::is_lowercase);
    if is_camel || is_value || before == "CDD" {
        word.replacen(name, &format!("`{name}`"), 1)
    } else {
        word.to_owned()
    }
}
