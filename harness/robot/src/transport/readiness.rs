//! Waits for a socket, to less than a millisecond.
//!
//! The time-out of a socket (`SO_RCVTIMEO`) is one of whole ticks of the kernel, and mostly of one too many: with 250 ticks a
//! second, a wait of 10 ms takes 12 to 16. `ppoll` goes by the kernel's fine timers.

use std::os::fd::AsFd;
use std::time::Duration;

use nix::errno::Errno;
use nix::poll::{PollFd, PollFlags, ppoll};
use nix::sys::time::TimeSpec;

/// Waits until the socket has something, or an error, for so long at most. Fails by `EINTR` when a signal came.
pub(super) fn wait_for(socket: &impl AsFd, at_most: Duration) -> Result<(), Errno> {
    if at_most.is_zero() {
        return Ok(());
    }
    let mut sockets = [PollFd::new(socket.as_fd(), PollFlags::POLLIN)];
    ppoll(&mut sockets, Some(TimeSpec::from(at_most)), None).map(drop)
}
