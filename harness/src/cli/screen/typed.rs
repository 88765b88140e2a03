//! The line that a person types: what a key does to it, and what of it fits into a row.

use crossterm::event::{KeyCode, KeyEvent, KeyEventKind, KeyModifiers};
use tui_input::{Input, InputRequest};
use unicode_width::{UnicodeWidthChar, UnicodeWidthStr};

/// What stands before the line.
pub(in crate::cli) const PROMPT: &str = "> ";

/// How many lines the history has. It is in memory, and ends with the process.
const HISTORY: usize = 500;

/// The line, and the lines before it.
#[derive(Debug, Default)]
pub(in crate::cli) struct TypedLine {
    input: Input,
    history: Vec<String>,
    /// The line of the history that is looked at; past its end, the line is new.
    at: usize,
    /// The new line, while older ones are looked at.
    new: String,
}

/// What came of a key.
#[derive(PartialEq, Eq, Debug)]
pub(in crate::cli) enum Pressed {
    /// The line may look different now.
    Edited,
    /// The line is whole, and an empty one follows it.
    Line(String),
    /// Several words could stand here.
    Choices(Vec<String>),
    /// The rows above are not wanted any more.
    Clear,
    /// There is nothing more to be typed.
    End,
}

impl TypedLine {
    /// Takes a key. `complete` says of the text before the cursor at which byte its last word begins, and what that word
    /// can become.
    pub(in crate::cli) fn press(
        &mut self,
        key: KeyEvent,
        complete: impl FnOnce(&str) -> (usize, Vec<String>),
    ) -> Pressed {
        if key.kind == KeyEventKind::Release {
            return Pressed::Edited;
        }
        let is_control = key.modifiers.contains(KeyModifiers::CONTROL);
        match key.code {
            KeyCode::Enter => return self.enter(),
            KeyCode::Char('j' | 'm') if is_control => return self.enter(),
            KeyCode::Char('d') if is_control && self.input.value().is_empty() => {
                return Pressed::End;
            }
            KeyCode::Char('l') if is_control => return Pressed::Clear,
            KeyCode::Tab => return self.complete(complete),
            KeyCode::Up => self.look_at(self.at.saturating_sub(1)),
            KeyCode::Char('p') if is_control => self.look_at(self.at.saturating_sub(1)),
            KeyCode::Down => self.look_at(self.at + 1),
            KeyCode::Char('n') if is_control => self.look_at(self.at + 1),
            _ => {
                if let Some(request) = request(key) {
                    self.input.handle(request);
                }
            }
        }
        Pressed::Edited
    }

    fn enter(&mut self) -> Pressed {
        let line = self.input.value_and_reset();
        if !line.trim().is_empty() && self.history.last() != Some(&line) {
            if self.history.len() == HISTORY {
                self.history.remove(0);
            }
            self.history.push(line.clone());
        }
        self.at = self.history.len();
        self.new.clear();
        Pressed::Line(line)
    }

    /// Shows this line of the history, or the new one past its end.
    fn look_at(&mut self, at: usize) {
        let at = at.min(self.history.len());
        if at == self.at {
            return;
        }
        if self.at == self.history.len() {
            self.input.value().clone_into(&mut self.new);
        }
        self.at = at;
        let line = self.history.get(at).unwrap_or(&self.new);
        self.input = Input::new(line.clone());
    }

    fn complete(&mut self, complete: impl FnOnce(&str) -> (usize, Vec<String>)) -> Pressed {
        let before = self.before_cursor();
        let (start, mut words) = complete(before);
        let typed = before.len() - start;
        match &mut words[..] {
            [] => return Pressed::Edited,
            // It is whole: the next one can follow.
            [word] => word.push(' '),
            _ => {}
        }
        let more = shared_beginning(&words).get(typed..).unwrap_or_default();
        if more.is_empty() {
            return Pressed::Choices(words);
        }
        for char in more.chars() {
            self.input.handle(InputRequest::InsertChar(char));
        }
        Pressed::Edited
    }

    fn before_cursor(&self) -> &str {
        let value = self.input.value();
        let cursor = value.char_indices().nth(self.input.cursor());
        &value[..cursor.map_or(value.len(), |(at, _)| at)]
    }

    /// The row of the line, prompt and all, in so many columns, and the column of the cursor. Of a longer line it is the
    /// part around the cursor.
    pub(in crate::cli) fn row(&self, columns: usize) -> (String, usize) {
        // The last column stays free for the cursor.
        let free = columns.saturating_sub(PROMPT.len() + 1);
        let scroll = self.input.visual_scroll(free);
        let mut skipped = 0;
        let visible = self.input.value().chars().skip_while(|char| {
            let is_left_of_it = skipped < scroll;
            skipped += char.width().unwrap_or(0);
            is_left_of_it
        });
        let row = format!("{PROMPT}{}", fitting(visible, free));
        let cursor = self.input.visual_cursor().saturating_sub(scroll);
        (row, PROMPT.width() + cursor)
    }
}

/// As much of a text as so many columns hold.
pub(in crate::cli) fn fitting(text: impl Iterator<Item = char>, columns: usize) -> String {
    let mut free = columns;
    let fits = |char: &char| {
        let width = char.width().unwrap_or(0);
        let fits = width <= free;
        free = free.saturating_sub(width);
        fits
    };
    text.take_while(fits).collect()
}

/// With what all of them begin.
fn shared_beginning(words: &[String]) -> &str {
    let Some((first, rest)) = words.split_first() else {
        return "";
    };
    let shared = |word: &String| {
        let pairs = first.char_indices().zip(word.chars());
        let differs = pairs
            .skip_while(|((_, one), other)| one == other)
            .map(|((at, _), _)| at);
        differs.min().unwrap_or(first.len().min(word.len()))
    };
    &first[..rest.iter().map(shared).min().unwrap_or(first.len())]
}

/// What a key asks of the line, as shells have it.
fn request(key: KeyEvent) -> Option<InputRequest> {
    use InputRequest::{
        DeleteFromStart, DeleteNextChar, DeleteNextWord, DeletePrevChar, DeletePrevWord,
        DeleteTillEnd, GoToEnd, GoToNextChar, GoToNextWord, GoToPrevChar, GoToPrevWord, GoToStart,
        InsertChar, Yank,
    };
    let is_control = key.modifiers.contains(KeyModifiers::CONTROL);
    let is_alt = key.modifiers.contains(KeyModifiers::ALT);
    Some(match key.code {
        KeyCode::Left | KeyCode::Char('b') if is_control && key.code == KeyCode::Left || is_alt => {
            GoToPrevWord
        }
        KeyCode::Right | KeyCode::Char('f')
            if is_control && key.code == KeyCode::Right || is_alt =>
        {
            GoToNextWord
        }
        KeyCode::Left => GoToPrevChar,
        KeyCode::Right => GoToNextChar,
        KeyCode::Home => GoToStart,
        KeyCode::End => GoToEnd,
        KeyCode::Backspace if is_alt || is_control => DeletePrevWord,
        KeyCode::Backspace => DeletePrevChar,
        KeyCode::Delete => DeleteNextChar,
        KeyCode::Char('d') if is_alt => DeleteNextWord,
        KeyCode::Char('a') if is_control => GoToStart,
        KeyCode::Char('b') if is_control => GoToPrevChar,
        KeyCode::Char('d') if is_control => DeleteNextChar,
        KeyCode::Char('e') if is_control => GoToEnd,
        KeyCode::Char('f') if is_control => GoToNextChar,
        KeyCode::Char('h') if is_control => DeletePrevChar,
        KeyCode::Char('k') if is_control => DeleteTillEnd,
        KeyCode::Char('u') if is_control => DeleteFromStart,
        KeyCode::Char('w') if is_control => DeletePrevWord,
        KeyCode::Char('y') if is_control => Yank,
        KeyCode::Char(char) if !is_control && !is_alt => InsertChar(char),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn nothing(_: &str) -> (usize, Vec<String>) {
        (0, Vec::new())
    }

    fn key(code: KeyCode) -> KeyEvent {
        KeyEvent::new(code, KeyModifiers::NONE)
    }

    fn control(char: char) -> KeyEvent {
        KeyEvent::new(KeyCode::Char(char), KeyModifiers::CONTROL)
    }

    fn write(line: &mut TypedLine, text: &str) {
        for char in text.chars() {
            assert_eq!(
                line.press(key(KeyCode::Char(char)), nothing),
                Pressed::Edited
            );
        }
    }

    #[test]
    fn older_lines_are_looked_at_without_losing_the_new_one() {
        let mut line = TypedLine::default();
        for text in ["detect", "status", "status", " "] {
            write(&mut line, text);
            let pressed = line.press(key(KeyCode::Enter), nothing);
            assert_eq!(pressed, Pressed::Line(text.to_owned()));
        }
        write(&mut line, "qu");
        let shown: Vec<_> = [KeyCode::Up, KeyCode::Up, KeyCode::Up]
            .into_iter()
            .chain([KeyCode::Down, KeyCode::Down, KeyCode::Down])
            .map(|code| {
                line.press(key(code), nothing);
                line.row(80).0
            })
            .collect();
        assert_eq!(
            shown,
            [
                "> status", "> detect", "> detect", "> status", "> qu", "> qu"
            ]
        );
    }

    #[test]
    fn a_word_is_completed_as_far_as_all_choices_agree() {
        let mut line = TypedLine::default();
        let words = |words: &[&str]| {
            let words = words
                .iter()
                .map(|&word| word.to_owned())
                .collect::<Vec<_>>();
            move |before: &str| (before.rfind(' ').map_or(0, |at| at + 1), words)
        };
        write(&mut line, "a de");
        let tab = key(KeyCode::Tab);
        assert_eq!(
            line.press(tab, words(&["detach", "detect"])),
            Pressed::Edited
        );
        assert_eq!(line.row(80).0, "> a det");
        let both = Pressed::Choices(vec!["detach".to_owned(), "detect".to_owned()]);
        assert_eq!(line.press(tab, words(&["detach", "detect"])), both);
        assert_eq!(line.press(tab, words(&["detect"])), Pressed::Edited);
        assert_eq!(line.row(80), ("> a detect ".to_owned(), 11));
        assert_eq!(line.press(tab, words(&[])), Pressed::Edited);
        assert_eq!(line.row(80).0, "> a detect ");
    }

    #[test]
    fn of_a_long_line_the_part_around_the_cursor_is_seen() {
        let mut line = TypedLine::default();
        write(&mut line, "0123456789abcdefghij");
        assert_eq!(line.row(13), ("> abcdefghij".to_owned(), 12));
        line.press(control('a'), nothing);
        assert_eq!(line.row(13), ("> 0123456789".to_owned(), 2));
        line.press(control('k'), nothing);
        assert_eq!(line.row(13), ("> ".to_owned(), 2));
        assert_eq!(line.press(control('d'), nothing), Pressed::End);
        // Wide characters take two columns, and a terminal without columns none.
        write(&mut line, "停停停停停停");
        assert_eq!(line.row(9), ("> 停停停".to_owned(), 8));
        assert_eq!(line.row(0).0, "> ");
    }

    #[test]
    fn the_end_of_input_is_no_key_in_the_middle_of_a_line() {
        let mut line = TypedLine::default();
        write(&mut line, "ab");
        line.press(key(KeyCode::Home), nothing);
        assert_eq!(line.press(control('d'), nothing), Pressed::Edited);
        assert_eq!(line.row(80).0, "> b");
        assert_eq!(line.press(control('l'), nothing), Pressed::Clear);
    }
}
