//! Lines that are typed or piped in.

use std::io::{IsTerminal, stdin};
use std::sync::mpsc::{Receiver, sync_channel};

use nix::unistd::{getpgrp, tcgetpgrp};

/// How many lines are kept until it is their turn; the others stay in the pipe.
pub(super) const TYPED: usize = 64;

/// Reads lines as they come, on a thread of its own that ends with the input. The robot goes on.
pub(super) fn lines() -> Receiver<String> {
    let (send, lines) = sync_channel(TYPED);
    if !is_in_background() {
        std::thread::spawn(move || {
            let read = crossguard_robot::lines::lines(stdin().lock());
            for line in read.map_while(Result::ok) {
                let line = String::from_utf8_lossy(&line).into_owned();
                if send.send(line).is_err() {
                    return;
                }
            }
        });
    }
    lines
}

/// Whether a shell began this process in the background: keys of the terminal are another process's. Reading them would
/// stop this process, and with it the robot.
fn is_in_background() -> bool {
    stdin().is_terminal() && tcgetpgrp(stdin()).is_ok_and(|group| group != getpgrp())
}
