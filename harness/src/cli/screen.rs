//! The screen of a person who watches a robot: lines that stay, and a status line below them.

use std::io::{Write, stdout};
use std::sync::mpsc::sync_channel;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::printable::Printable;

/// The screen.
#[derive(Clone)]
pub(super) struct Screen {
    /// Whether a status line is drawn over and over.
    is_live: bool,
    /// Draws it.
    bar: ProgressBar,
}

impl Screen {
    /// A screen, with a status line or without.
    pub(super) fn new(is_live: bool) -> Self {
        let target = if is_live {
            ProgressDrawTarget::stderr()
        } else {
            ProgressDrawTarget::hidden()
        };
        let style = ProgressStyle::with_template("{wide_msg}");
        let style = style.unwrap_or_else(|_| ProgressStyle::default_bar());
        let bar = ProgressBar::with_draw_target(None, target).with_style(style);
        Self { is_live, bar }
    }

    pub(super) fn is_live(&self) -> bool {
        self.is_live
    }

    /// Shows this as status line.
    pub(super) fn show(&self, status: &str) {
        // Ends of lines stay printable, and a row has none.
        let status = Printable(status).to_string().replace('\n', " ");
        self.bar.set_message(status);
    }

    /// Takes the status line away.
    pub(super) fn clear(&self) {
        self.bar.finish_and_clear();
    }

    /// Prints a line, above the status line.
    ///
    /// # Errors
    /// Standard output cannot be written to.
    pub(super) fn say(&self, line: &str) -> std::io::Result<()> {
        let line = format!("{}\n", Printable(line));
        let print = || stdout().write_all(line.as_bytes());
        self.bar.suspend(print)
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
}
