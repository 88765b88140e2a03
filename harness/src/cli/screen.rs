//! The screen of a person who watches a robot: lines that stay, a status line below them, and below that the line that
//! the person types, if it is edited here.
//!
//! ```text
//!   12.480 ARI: now ManeuverExecuting (leader)
//! ARI ManeuverExecuting, leader in 1#1.0, 2 move acknowledged, corridor open
//! > clo█
//! ```
//!
//! Each of the two is one row, whatever the width of the terminal, so that they are taken away whole before a line that
//! stays is printed in their place.

mod typed;

use std::io::{Write, stdout};
use std::sync::mpsc::sync_channel;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use crossterm::cursor::{MoveTo, MoveToColumn, MoveToPreviousLine};
use crossterm::event::KeyEvent;
use crossterm::queue;
use crossterm::terminal::{Clear, ClearType};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::printable::Printable;
pub(super) use typed::Pressed;
use typed::{PROMPT, TypedLine, fitting};

/// The screen.
#[derive(Clone)]
pub(super) struct Screen(Arc<Inner>);

struct Inner {
    /// Whether a status line is drawn over and over.
    is_live: bool,
    /// Draws it where no line is edited.
    bar: ProgressBar,
    status: Mutex<String>,
    /// The rows at the bottom, while a line is edited.
    rows: Mutex<Option<Rows>>,
}

/// The status line and the line that is typed, on standard output.
#[derive(Default)]
struct Rows {
    typed: TypedLine,
    /// How many rows are there now.
    drawn: u16,
}

impl Screen {
    /// A screen, with a status line or without.
    pub(super) fn new(is_live: bool) -> Self {
        let bar = ProgressBar::with_draw_target(None, target(is_live));
        let style = ProgressStyle::with_template("{wide_msg}");
        let style = style.unwrap_or_else(|_| ProgressStyle::default_bar());
        Self(Arc::new(Inner {
            is_live,
            bar: bar.with_style(style),
            status: Mutex::default(),
            rows: Mutex::new(None),
        }))
    }

    pub(super) fn is_live(&self) -> bool {
        self.0.is_live
    }

    /// Shows this as status line.
    pub(super) fn show(&self, status: &str) {
        if !self.0.is_live {
            return;
        }
        // Ends of lines stay printable, and a row has none.
        let status = Printable(status).to_string().replace('\n', " ");
        let mut shown = locked(&self.0.status);
        if *shown == status {
            return;
        }
        shown.clone_from(&status);
        drop(shown);
        match &mut *locked(&self.0.rows) {
            // The terminal may be gone; the robot goes on.
            Some(rows) => drop(rows.redraw(&status, "")),
            None => self.0.bar.set_message(status),
        }
    }

    /// Takes the status line away.
    pub(super) fn clear(&self) {
        locked(&self.0.status).clear();
        match &mut *locked(&self.0.rows) {
            Some(rows) => drop(rows.redraw("", "")),
            None => self.0.bar.finish_and_clear(),
        }
    }

    /// Prints a line, above the status line.
    ///
    /// # Errors
    /// Standard output cannot be written to.
    pub(super) fn say(&self, line: &str) -> std::io::Result<()> {
        let line = format!("{}\n", Printable(line));
        if let Some(rows) = &mut *locked(&self.0.rows) {
            return rows.redraw(&self.status(), &line);
        }
        let print = || stdout().write_all(line.as_bytes());
        self.0.bar.suspend(print)
    }

    /// From now on a line is edited, and standard output is drawn on by this alone.
    pub(super) fn begin_editing(&self) {
        self.0.bar.set_draw_target(ProgressDrawTarget::hidden());
        let mut rows = Rows::default();
        // The thread that reads keys notices where the terminal is gone.
        let _ = rows.redraw(&self.status(), "");
        *locked(&self.0.rows) = Some(rows);
    }

    /// No line is edited any more.
    pub(super) fn end_editing(&self) {
        if let Some(mut rows) = locked(&self.0.rows).take() {
            let _ = rows.erase().and_then(|()| stdout().flush());
        }
        self.0.bar.set_draw_target(target(self.0.is_live));
        self.0.bar.set_message(self.status());
    }

    /// Takes a key for the line that is edited; nothing if none is.
    pub(super) fn press(
        &self,
        key: KeyEvent,
        complete: impl FnOnce(&str) -> (usize, Vec<String>),
    ) -> Option<Pressed> {
        let mut rows = locked(&self.0.rows);
        let rows = rows.as_mut()?;
        let pressed = rows.typed.press(key, complete);
        let above = match &pressed {
            Pressed::Edited | Pressed::End => String::new(),
            Pressed::Line(line) => format!("{PROMPT}{}\n", Printable(line)),
            Pressed::Choices(words) => format!("{}\n", Printable(words.join("  "))),
            Pressed::Clear => {
                let _ = queue!(stdout(), Clear(ClearType::All), MoveTo(0, 0));
                rows.drawn = 0;
                String::new()
            }
        };
        let _ = rows.redraw(&self.status(), &above);
        Some(pressed)
    }

    /// The terminal has another width now.
    pub(super) fn resized(&self) {
        if let Some(rows) = &mut *locked(&self.0.rows) {
            let _ = rows.redraw(&self.status(), "");
        }
    }

    /// Changes it, but waits no longer than this: who does not read what is shown holds nothing else up.
    pub(super) fn within(&self, patience: Duration, change: fn(&Self)) {
        let (tell, is_done) = sync_channel(1);
        let screen = self.clone();
        std::thread::spawn(move || {
            change(&screen);
            // Nobody may wait any more.
            let _ = tell.send(());
        });
        let _ = is_done.recv_timeout(patience);
    }

    fn status(&self) -> String {
        locked(&self.0.status).clone()
    }
}

impl Rows {
    /// Draws the rows anew below the lines of `above`.
    fn redraw(&mut self, status: &str, above: &str) -> std::io::Result<()> {
        let columns = terminal_size::terminal_size().map_or(80, |(width, _)| usize::from(width.0));
        let (line, cursor) = self.typed.row(columns);
        self.erase()?;
        let mut out = stdout().lock();
        out.write_all(above.as_bytes())?;
        if !status.is_empty() {
            writeln!(
                out,
                "{}",
                fitting(status.chars(), columns.saturating_sub(1))
            )?;
        }
        out.write_all(line.as_bytes())?;
        queue!(out, MoveToColumn(u16::try_from(cursor).unwrap_or(u16::MAX)))?;
        self.drawn = 1 + u16::from(!status.is_empty());
        out.flush()
    }

    /// Takes the rows away.
    fn erase(&mut self) -> std::io::Result<()> {
        let mut out = stdout().lock();
        match std::mem::take(&mut self.drawn) {
            0 => return Ok(()),
            1 => queue!(out, MoveToColumn(0))?,
            drawn => queue!(out, MoveToPreviousLine(drawn - 1))?,
        }
        queue!(out, Clear(ClearType::FromCursorDown))
    }
}

fn target(is_live: bool) -> ProgressDrawTarget {
    if is_live {
        ProgressDrawTarget::stderr()
    } else {
        ProgressDrawTarget::hidden()
    }
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
