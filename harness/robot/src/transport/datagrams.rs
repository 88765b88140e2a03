//! Datagrams off a socket, UDP or raw, each with the moment of its arrival.

use std::net::SocketAddr;
use std::os::fd::{AsFd, AsRawFd};
use std::time::{Duration, Instant};

use nix::errno::Errno;
use nix::sys::socket::{MsgFlags, SockaddrStorage};

use super::attention::Attention;
use super::readiness::wait_for;
use super::stamps::{Stamped, Stamps};
use super::{DATAGRAM_MAX, Source};

/// Takes datagrams off a socket.
#[derive(Debug)]
pub(super) struct Datagrams<S> {
    socket: S,
    buffer: Box<[u8; DATAGRAM_MAX]>,
    attention: Attention,
    stamps: Stamps,
}

impl<S: AsFd + AsRawFd> Datagrams<S> {
    pub(super) fn of(socket: S) -> Self {
        Self {
            stamps: Stamps::of(&socket),
            socket,
            buffer: Box::new([0; DATAGRAM_MAX]),
            attention: Attention::new(Instant::now()),
        }
    }

    /// Waits for the next one, for so long at most: its sender, its content, and when it arrived. Fails by what the
    /// operating system says and will not go away by itself.
    pub(super) fn next(
        &mut self,
        at_most: Duration,
    ) -> std::io::Result<Option<(Source, &[u8], Instant)>> {
        let may_wait = self.attention.may_wait(at_most);
        let called = Instant::now();
        let (socket, flags) = (&self.socket, MsgFlags::MSG_DONTWAIT);
        let ready = wait_for(socket, may_wait);
        let received = ready.and_then(|()| self.stamps.receive(socket, &mut *self.buffer, flags));
        let now = Instant::now();
        match received {
            Ok(Stamped { length, from, age }) => {
                let at = self.attention.took(may_wait, now, age);
                let from = from.as_ref().map_or(Source::Unknown, source_of);
                Ok(Some((from, &self.buffer[..length], at)))
            }
            // A UDP peer that is gone answers with ICMP, which shows up as a refused connection.
            Err(Errno::EINTR | Errno::ECONNREFUSED | Errno::ECONNRESET) => Ok(None),
            Err(Errno::EAGAIN | Errno::ETIMEDOUT) => {
                self.attention.saw_empty(called, may_wait, now);
                Ok(None)
            }
            Err(errno) => Err(errno.into()),
        }
    }
}

fn source_of(address: &SockaddrStorage) -> Source {
    let v4 = address
        .as_sockaddr_in()
        .map(|it| SocketAddr::V4((*it).into()));
    let v6 = || {
        address
            .as_sockaddr_in6()
            .map(|it| SocketAddr::V6((*it).into()))
    };
    v4.or_else(v6).map_or(Source::Unknown, Source::Address)
}
