//! Datagrams with the kernel's time stamps of their arrival (`SO_TIMESTAMPNS`), and with its count of datagrams for which the socket
//! had no room before them (`SO_RXQ_OVFL`).
//!
//! The stamps are of the wall clock, which may be put. So an age by a stamp counts only while the wall clock has
//! gone as the monotonic one since the socket was seen empty; what becomes of it is up to
//! [`Attention`](super::attention::Attention).

use std::io::IoSliceMut;
use std::os::fd::{AsFd, AsRawFd};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use nix::cmsg_space;
use nix::errno::Errno;
use nix::sys::socket::sockopt::{ReceiveTimestampns, RxqOvfl};
use nix::sys::socket::{ControlMessageOwned, MsgFlags, SockaddrStorage, recvmsg, setsockopt};
use nix::sys::time::TimeSpec;

/// By how much the two clocks may come apart between two looks at a socket.
const DRIFT_MAX: Duration = Duration::from_millis(5);

pub(super) struct Stamped {
    /// How many octets.
    pub(super) length: usize,
    /// Its sender.
    pub(super) from: Option<SockaddrStorage>,
    /// How long ago the kernel had it, if that is known.
    pub(super) age: Option<Duration>,
    /// How many the kernel has dropped since the one before.
    pub(super) dropped: u32,
}

/// Takes stamped datagrams off a socket.
#[derive(Debug)]
pub(super) struct Stamps {
    control: Vec<u8>,
    /// How many the kernel had dropped by the last one, modulo 2^32.
    dropped: u32,
    /// Both clocks at the last look.
    looked: (Instant, SystemTime),
    /// Whether they have gone alike since the socket was seen empty.
    is_steady: bool,
}

impl Stamps {
    /// Has the kernel stamp what arrives at this socket; Linux begins with that some milliseconds later, and until
    /// then stamps when a datagram is taken. A kernel that does not stamp, or count, is not worth a failure: then ages, or drops, are
    /// not known.
    pub(super) fn of(socket: &impl AsFd) -> Self {
        let _ = setsockopt(socket, ReceiveTimestampns, &true);
        let _ = setsockopt(socket, RxqOvfl, &1);
        Self {
            control: cmsg_space!(TimeSpec, u32),
            dropped: 0,
            looked: (Instant::now(), SystemTime::now()),
            is_steady: true,
        }
    }

    /// Receives a datagram. The rest of a longer one than the buffer is cut off. Fails where there is nothing, too.
    pub(super) fn receive(
        &mut self,
        socket: &impl AsRawFd,
        buffer: &mut [u8],
        flags: MsgFlags,
    ) -> Result<Stamped, Errno> {
        let mut into = [IoSliceMut::new(buffer)];
        let control = Some(&mut self.control[..]);
        let received = recvmsg::<SockaddrStorage>(socket.as_raw_fd(), &mut into, control, flags);
        let (mut stamp, mut in_all) = (None, self.dropped);
        let (length, from) = match received {
            Ok(message) => {
                for control in message.cmsgs().into_iter().flatten() {
                    match control {
                        ControlMessageOwned::ScmTimestampns(time) => {
                            stamp = Some(Duration::from(time));
                        }
                        ControlMessageOwned::RxqOvfl(count) => in_all = count,
                        _ => {}
                    }
                }
                (message.bytes, message.address)
            }
            Err(errno) => {
                self.look();
                self.is_steady |= errno == Errno::EAGAIN;
                return Err(errno);
            }
        };
        let wall = self.look();
        let age = stamp
            .and_then(|stamp| wall.duration_since(UNIX_EPOCH + stamp).ok())
            .filter(|_| self.is_steady);
        let before = std::mem::replace(&mut self.dropped, in_all);
        Ok(Stamped {
            length,
            from,
            age,
            dropped: in_all.wrapping_sub(before),
        })
    }

    /// Compares the clocks; the wall clock.
    fn look(&mut self) -> SystemTime {
        let now = (Instant::now(), SystemTime::now());
        let (then, then_wall) = std::mem::replace(&mut self.looked, now);
        self.is_steady &= is_alike(now.0.duration_since(then), then_wall, now.1);
        now.1
    }
}

/// Whether the wall clock went on by so much, more or less.
fn is_alike(passed: Duration, from: SystemTime, to: SystemTime) -> bool {
    let by_wall = to.duration_since(from).unwrap_or_default();
    by_wall.abs_diff(passed) <= DRIFT_MAX
}

#[cfg(test)]
mod tests {
    use std::net::UdpSocket;

    use super::*;

    #[test]
    fn the_age_of_a_datagram_is_how_long_it_lay_in_the_kernel() {
        let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
        let mut stamps = Stamps::of(&socket);
        // Until the kernel has begun to stamp.
        std::thread::sleep(Duration::from_millis(200));
        let address = socket.local_addr().unwrap();
        for wait_ms in [0, 150] {
            let before = Instant::now();
            socket.send_to(b"hello", address).unwrap();
            let after = Instant::now();
            std::thread::sleep(Duration::from_millis(wait_ms));
            let at_least = after.elapsed();
            let mut buffer = [0; 16];
            let stamped = stamps
                .receive(&socket, &mut buffer, MsgFlags::empty())
                .unwrap();
            let at_most = before.elapsed();
            assert_eq!(&buffer[..stamped.length], b"hello");
            let from = stamped.from.and_then(|it| it.as_sockaddr_in().copied());
            assert_eq!(from.map(|it| it.port()), Some(address.port()));
            let age = stamped.age.expect("a stamp");
            let is_right = age + DRIFT_MAX >= at_least && age <= at_most + DRIFT_MAX;
            assert!(is_right, "{age:?}, {at_least:?} to {at_most:?}");
        }
    }

    #[test]
    fn a_wall_clock_that_is_put_is_noticed() {
        let (passed, from) = (
            Duration::from_millis(100),
            UNIX_EPOCH + Duration::from_secs(1_000),
        );
        assert!(is_alike(passed, from, from + passed));
        assert!(is_alike(passed, from, from + passed + DRIFT_MAX));
        assert!(!is_alike(passed, from, from + passed + 2 * DRIFT_MAX));
        assert!(!is_alike(passed, from, from - passed));
    }
}
