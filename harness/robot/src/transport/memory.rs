//! Robots in one process, joined by queues: a radio channel on which everybody hears everybody.

use std::io::{Error, ErrorKind};
use std::sync::mpsc::{RecvTimeoutError, SyncSender, TrySendError, sync_channel};
use std::sync::{Arc, Mutex, mpsc};
use std::time::{Duration, Instant};

use super::{Arrival, Halves, LinkError, NotSent, Receiver, Sender, Source, Transport};

/// How many datagrams may wait for one robot; more are not taken, and its sender is told.
const QUEUE: usize = 256;

/// From which port, what, and when.
type Datagram = (usize, Vec<u8>, Instant);

/// The radio channel of one process. Clones are the same channel.
#[derive(Clone, Debug)]
pub struct Air(Arc<Vec<Seat>>);

#[derive(Debug)]
struct Seat {
    queue: SyncSender<Datagram>,
    /// Taken when the port is opened.
    receiver: Mutex<Option<mpsc::Receiver<Datagram>>>,
}

/// One robot's access to an [`Air`].
#[derive(Clone, Debug)]
pub struct Port {
    air: Air,
    number: usize,
}

impl Air {
    /// A channel for this many robots.
    #[must_use]
    pub fn new(ports: usize) -> Self {
        let seat = || {
            let (queue, receiver) = sync_channel(QUEUE);
            Seat {
                queue,
                receiver: Mutex::new(Some(receiver)),
            }
        };
        Self(Arc::new((0..ports).map(|_| seat()).collect()))
    }

    /// The access with this number, from 0.
    ///
    /// # Panics
    /// When there are fewer.
    #[must_use]
    pub fn port(&self, number: usize) -> Port {
        assert!(number < self.0.len(), "{number} of {} ports", self.0.len());
        Port {
            air: self.clone(),
            number,
        }
    }
}

impl Transport for Port {
    fn open(&self) -> Result<Halves, LinkError> {
        let receiver = self.air.0[self.number].receiver.lock();
        // Nothing that holds the lock can panic.
        let receiver = receiver
            .unwrap_or_else(std::sync::PoisonError::into_inner)
            .take();
        let receiver = receiver.ok_or(LinkError::PortInUse(self.number))?;
        Ok(Halves {
            sender: Box::new(self.clone()),
            receiver: Box::new(MemoryReceiver(receiver)),
        })
    }
}

impl Sender for Port {
    fn send(&mut self, octets: &[u8]) -> Result<(), NotSent> {
        let others = self.air.0.iter().enumerate();
        let others = others.filter(|(number, _)| *number != self.number);
        let failures = others.filter_map(|(_, seat)| {
            let datagram = (self.number, octets.to_vec(), Instant::now());
            match seat.queue.try_send(datagram) {
                Err(TrySendError::Full(_)) => {
                    let full = "the receiver's queue is full";
                    Some(Error::new(ErrorKind::WouldBlock, full))
                }
                // A closed queue is like the air over a robot that is switched off.
                Ok(()) | Err(TrySendError::Disconnected(_)) => None,
            }
        });
        NotSent::check(self.air.0.len() - 1, failures)
    }
}

struct MemoryReceiver(mpsc::Receiver<Datagram>);

impl Receiver for MemoryReceiver {
    fn receive(&mut self, at_most: Duration) -> std::io::Result<Option<Arrival>> {
        match self.0.recv_timeout(at_most) {
            Ok((port, octets, at)) => Ok(Some(Arrival::Datagram {
                from: Source::Port(port),
                octets,
                at,
            })),
            Err(RecvTimeoutError::Timeout) => Ok(None),
            Err(RecvTimeoutError::Disconnected) => Err(ErrorKind::NotConnected.into()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_datagram_reaches_everybody_but_its_sender() {
        let air = Air::new(3);
        let mut ports: Vec<_> = (0..3).map(|n| air.port(n).open().unwrap()).collect();
        ports[0].sender.send(b"hello").unwrap();
        let mut heard = |port: usize| ports[port].receiver.receive(Duration::from_millis(1));
        assert_eq!(heard(0).unwrap(), None);
        for port in [1, 2] {
            let Some(Arrival::Datagram { from, octets, .. }) = heard(port).unwrap() else {
                panic!("port {port} heard nothing");
            };
            assert_eq!((from, &octets[..]), (Source::Port(0), &b"hello"[..]));
        }
    }

    #[test]
    fn a_datagram_that_waits_in_the_queue_has_arrived_when_it_was_sent() {
        let air = Air::new(2);
        let (mut sender, mut receiver) = (
            air.port(0).open().unwrap().sender,
            air.port(1).open().unwrap().receiver,
        );
        sender.send(b"hello").unwrap();
        let sent = Instant::now();
        std::thread::sleep(Duration::from_millis(20));
        let heard = receiver.receive(Duration::from_millis(1)).unwrap();
        assert!(matches!(heard, Some(Arrival::Datagram { at, .. }) if at <= sent));
    }

    #[test]
    fn a_full_queue_takes_no_more_and_says_so() {
        let air = Air::new(2);
        let mut sender = air.port(0).open().unwrap().sender;
        for _ in 0..QUEUE {
            sender.send(&[1]).unwrap();
        }
        let error = sender.send(&[1]).unwrap_err();
        assert_eq!((error.failed, error.receivers), (1, 1));
        assert!(matches!(air.port(0).open(), Err(LinkError::PortInUse(0))));
    }
}
