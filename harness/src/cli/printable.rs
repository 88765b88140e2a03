//! Text from elsewhere, on a terminal: names in logs and certificates are other people's, and a terminal obeys
//! the control characters in what it shows.

use std::fmt::{self, Display, Formatter, Write as _};

/// Shows as what it holds, with control characters spelled out: `\u{1b}`. Ends of lines and tabs stay.
#[derive(Clone, Copy, Debug)]
pub(super) struct Printable<T>(pub(super) T);

impl<T: Display> Display for Printable<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(Escaping(f), "{}", self.0)
    }
}

/// JSON as a terminal may see it: the control characters that JSON need not escape are escaped.
pub(super) fn printable_json(json: &str) -> String {
    let mut text = String::with_capacity(json.len());
    for char in json.chars() {
        if is_obeyed(char) {
            let _ = write!(text, "\\u{:04x}", u32::from(char));
        } else {
            text.push(char);
        }
    }
    text
}

struct Escaping<'a, 'b>(&'a mut Formatter<'b>);

impl fmt::Write for Escaping<'_, '_> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        let mut rest = text;
        while let Some(at) = rest.find(is_obeyed) {
            let (plain, from) = rest.split_at(at);
            self.0.write_str(plain)?;
            let mut chars = from.chars();
            if let Some(char) = chars.next() {
                write!(self.0, "{}", char.escape_unicode())?;
            }
            rest = chars.as_str();
        }
        self.0.write_str(rest)
    }
}

/// Whether a terminal does something else than show it: control characters, and characters that turn the direction of
/// writing, so that a text reads as another one.
fn is_obeyed(char: char) -> bool {
    let turns = matches!(char, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    turns || (char.is_control() && !matches!(char, '\n' | '\t'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_that_a_terminal_obeys_gets_through() {
        let name = "a\u{1b}]0;title\u{7}b\rc\u{9b}2Jd\u{202e}e\u{7f}\n\tä";
        let shown = Printable(name).to_string();
        let expected = r"a\u{1b}]0;title\u{7}b\u{d}c\u{9b}2Jd\u{202e}e\u{7f}";
        assert_eq!(shown, format!("{expected}\n\tä"));
        assert_eq!(Printable(format_args!("{:>3}", 7)).to_string(), "  7");
    }

    #[test]
    fn json_stays_what_it_says() {
        let name = "a\u{1b}b\u{9b}c\u{7f}";
        let json = printable_json(&serde_json::to_string(name).unwrap());
        assert!(!json.chars().any(is_obeyed), "{json}");
        assert_eq!(serde_json::from_str::<String>(&json).unwrap(), name);
    }
}
