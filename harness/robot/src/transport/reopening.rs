//! A transport that comes back: one that stops sending is opened again until it sends.
//!
//! An interface that disappears takes a group's membership and raw sockets with it, also when another
//! of the same name takes its place. The sender notices, because robots send several times a second;
//! it opens the transport anew and hands the receiving half over to the thread that receives. A failure that
//! is [passing](NotSent::is_passing) is left alone.

use std::sync::mpsc::{Receiver as Coming, SyncSender, sync_channel};
use std::time::{Duration, Instant};

use super::{Arrival, Halves, LinkError, NotSent, Receiver, Sender, Transport};

/// How long after an attempt the next one is made.
const PERIOD: Duration = Duration::from_secs(1);

/// A transport that is opened again when it fails.
#[derive(Clone, Debug)]
pub struct Reopening<T>(
    /// The transport to open.
    pub T,
);

impl<T: Transport + Clone + Send + 'static> Transport for Reopening<T> {
    fn open(&self) -> Result<Halves, LinkError> {
        let Halves { sender, receiver } = self.0.open()?;
        let (hand_over, coming) = sync_channel(1);
        let sender = ReopeningSender {
            transport: self.0.clone(),
            sender,
            hand_over,
            tried: None,
        };
        Ok(Halves::of(sender, ReopeningReceiver { receiver, coming }))
    }
}

struct ReopeningSender<T> {
    transport: T,
    sender: Box<dyn Sender>,
    hand_over: SyncSender<Box<dyn Receiver>>,
    /// When it was opened again last.
    tried: Option<Instant>,
}

impl<T: Transport + Send> Sender for ReopeningSender<T> {
    fn send(&mut self, octets: &[u8]) -> Result<(), NotSent> {
        let Err(failure) = self.sender.send(octets) else {
            return Ok(());
        };
        let is_too_early = self.tried.is_some_and(|tried| tried.elapsed() < PERIOD);
        if failure.is_passing() || is_too_early {
            return Err(failure);
        }
        self.tried = Some(Instant::now());
        let Ok(Halves { sender, receiver }) = self.transport.open() else {
            return Err(failure);
        };
        // The old transport ends in the receiving thread, which drops the other half.
        self.sender = sender;
        // One that has not been taken yet is as good as this one was a moment ago.
        let _ = self.hand_over.try_send(receiver);
        self.sender.send(octets)
    }
}

struct ReopeningReceiver {
    receiver: Box<dyn Receiver>,
    coming: Coming<Box<dyn Receiver>>,
}

impl Receiver for ReopeningReceiver {
    fn receive(&mut self, at_most: Duration) -> std::io::Result<Option<Arrival>> {
        if let Ok(receiver) = self.coming.try_recv() {
            self.receiver = receiver;
        }
        self.receiver.receive(at_most)
    }
}

#[cfg(test)]
mod tests {
    use std::io::{Error, ErrorKind};
    use std::sync::Arc;
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::super::Link;
    use super::*;

    /// A transport that never sends, and counts how often it is opened.
    #[derive(Clone)]
    struct Failing(ErrorKind, Arc<AtomicUsize>);

    impl Transport for Failing {
        fn open(&self) -> Result<Halves, LinkError> {
            self.1.fetch_add(1, Ordering::Relaxed);
            let halves = Link::loopback(0, Vec::new()).open()?;
            let sender = Box::new(self.clone());
            Ok(Halves { sender, ..halves })
        }
    }

    impl Sender for Failing {
        fn send(&mut self, _: &[u8]) -> Result<(), NotSent> {
            Err(NotSent::to_one(Error::from(self.0)))
        }
    }

    #[test]
    fn what_fails_is_opened_again_and_what_passes_by_itself_is_not() {
        for (kind, expected) in [
            (ErrorKind::NetworkUnreachable, 2),
            (ErrorKind::NotConnected, 1),
            (ErrorKind::WouldBlock, 1),
        ] {
            let failing = Failing(kind, Arc::default());
            let mut sender = Reopening(failing.clone()).open().unwrap().sender;
            assert_eq!(sender.send(b"hello").unwrap_err().cause.kind(), kind);
            assert_eq!(failing.1.load(Ordering::Relaxed), expected, "{kind:?}");
        }
    }
}
