//! The settings of the terminal. While a line is edited, its keys come one by one; whatever way the process ends, the
//! person gets the terminal back as it was.

use std::io::{IsTerminal, stdin};
use std::sync::{Mutex, PoisonError};

use nix::sys::termios::{InputFlags, LocalFlags, SetArg, Termios, tcgetattr, tcsetattr};
use nix::unistd::{getpgrp, tcgetpgrp};

/// As the process found them.
static FOUND: Mutex<Option<Termios>> = Mutex::new(None);

/// Whether standard input is a terminal whose keys are another process's: a shell began this one in the background.
/// To read them all the same stops the process.
pub(super) fn is_of_others() -> bool {
    stdin().is_terminal() && tcgetpgrp(stdin()).is_ok_and(|group| group != getpgrp())
}

/// Lets keys come one by one, without showing them. Ctrl-C stays the signal that the kernel sends, so that it arrives
/// whatever this process is busy with.
///
/// # Errors
/// The terminal does not let itself be set.
pub(super) fn take_keys() -> nix::Result<()> {
    let found = tcgetattr(stdin())?;
    let mut wanted = found.clone();
    let lines = LocalFlags::ICANON | LocalFlags::ECHO | LocalFlags::IEXTEN;
    wanted.local_flags.remove(lines);
    // Ctrl-S would hold up what is to be seen.
    wanted.input_flags.remove(InputFlags::IXON);
    *FOUND.lock().unwrap_or_else(PoisonError::into_inner) = Some(found);
    tcsetattr(stdin(), SetArg::TCSANOW, &wanted)
}

/// Sets the terminal as it was, if it was changed. It does not wait for what is still to be shown.
pub(super) fn restore() {
    let mut found = FOUND.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(found) = found.take() {
        // A terminal that is gone needs nothing.
        let _ = tcsetattr(stdin(), SetArg::TCSANOW, &found);
    }
}
