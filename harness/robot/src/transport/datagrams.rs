//! Datagrams off a socket, UDP or raw, each with the moment of its arrival.

use std::net::SocketAddr;
use std::os::fd::{AsFd, AsRawFd};
use std::time::{Duration, Instant};

use nix::errno::Errno;
use nix::poll::{PollFd, PollFlags, ppoll};
use nix::sys::socket::{MsgFlags, SockaddrStorage};
use nix::sys::time::TimeSpec;

use super::attention::Attention;
use super::stamps::{Stamped, Stamps};
use super::{DATAGRAM_MAX, Source};

/// Takes datagrams off a socket.
#[derive(Debug)]
pub(super) struct Datagrams<S> {
    socket: S,
    buffer: Box<[u8; DATAGRAM_MAX]>,
    attention: Attention,
    stamps: Stamps,
    /// A datagram that waits in the buffer until it is told that others before it were dropped.
    held: Option<(Source, usize, Instant)>,
}

/// Something that came off a socket.
#[derive(Debug)]
pub(super) enum Taken<'a> {
    /// A datagram: its sender, its content, and when it arrived.
    Datagram(Source, &'a [u8], Instant),
    /// The socket had no room for so many that arrived before the next one. The kernel tells of them with a datagram that arrived
    /// after them.
    Overflow(u32),
}

impl<S: AsFd + AsRawFd> Datagrams<S> {
    pub(super) fn of(socket: S) -> Self {
        Self {
            stamps: Stamps::of(&socket),
            socket,
            buffer: Box::new([0; DATAGRAM_MAX]),
            attention: Attention::new(Instant::now()),
            held: None,
        }
    }

    /// Waits for the next one, for so long at most. Fails by what the operating system says and will not go away by itself.
    pub(super) fn next(&mut self, at_most: Duration) -> std::io::Result<Option<Taken<'_>>> {
        if let Some((from, length, at)) = self.held.take() {
            return Ok(Some(Taken::Datagram(from, &self.buffer[..length], at)));
        }
        let may_wait = self.attention.may_wait(at_most);
        let called = Instant::now();
        let (socket, flags) = (&self.socket, MsgFlags::MSG_DONTWAIT);
        let ready = wait_for(socket, may_wait);
        let received = ready.and_then(|()| self.stamps.receive(socket, &mut *self.buffer, flags));
        let now = Instant::now();
        match received {
            Ok(Stamped {
                length,
                from,
                age,
                dropped,
            }) => {
                let at = self.attention.took(may_wait, now, age);
                let from = from.as_ref().map_or(Source::Unknown, source_of);
                if dropped > 0 {
                    self.held = Some((from, length, at));
                    return Ok(Some(Taken::Overflow(dropped)));
                }
                Ok(Some(Taken::Datagram(from, &self.buffer[..length], at)))
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

/// Waits until the socket has something, or an error, for so long at most. Fails by `EINTR` when a signal came.
///
/// The time-out of a socket (`SO_RCVTIMEO`) is one of whole ticks of the kernel, and mostly of one too many: with 250
/// ticks a second, a wait of 10 ms takes 12 to 16. `ppoll` goes by the kernel's fine timers.
fn wait_for(socket: &impl AsFd, at_most: Duration) -> Result<(), Errno> {
    if at_most.is_zero() {
        return Ok(());
    }
    let mut sockets = [PollFd::new(socket.as_fd(), PollFlags::POLLIN)];
    ppoll(&mut sockets, Some(TimeSpec::from(at_most)), None).map(drop)
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

#[cfg(test)]
mod tests {
    use std::net::UdpSocket;

    use socket2::SockRef;

    use super::*;

    /// Hazard: a vehicle's packet finds no room in the socket, nobody counts it, and go begins in front of that vehicle.
    #[test]
    fn datagrams_for_which_the_socket_has_no_room_are_counted_before_the_next_one() {
        let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
        let address = socket.local_addr().unwrap();
        SockRef::from(&socket).set_recv_buffer_size(4_096).unwrap();
        let other = UdpSocket::bind("127.0.0.1:0").unwrap();
        let mut datagrams = Datagrams::of(socket);
        let (mut taken, mut dropped, mut told) = (0, 0, 0);
        for round in 0..2 {
            for _ in 0..100 {
                other.send_to(&[round; 1_000], address).unwrap();
            }
            // One that comes when there is room again.
            let mut is_sent = false;
            loop {
                match datagrams.next(Duration::from_millis(100)).unwrap() {
                    Some(Taken::Datagram(_, [9], _)) => break,
                    Some(Taken::Datagram(_, octets, _)) => {
                        assert_eq!(octets, [round; 1_000]);
                        taken += 1;
                    }
                    Some(Taken::Overflow(count)) => {
                        dropped += count;
                        told += 1;
                    }
                    None if is_sent => panic!("it did not come"),
                    None => {
                        other.send_to(&[9], address).unwrap();
                        is_sent = true;
                    }
                }
            }
        }
        assert_eq!((taken + dropped, told), (200, 2), "{taken} were taken");
    }
}
