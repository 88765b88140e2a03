//! Packets in pcap files, as the field's tools read them: each in an Ethernet frame of ethertype 0x8947,
//! which Wireshark takes apart down to BTP. Files of others are read in pcapng and behind other link layers as well. A thread writes them, so that no robot waits for a disk.

mod link;
mod reader;

pub use reader::{Captured, NoCapture, read};

use std::fs::File;
use std::io;
use std::os::unix::fs::OpenOptionsExt as _;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver as Queue, SyncSender, sync_channel};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use crossguard_codec::geonet::ethernet;
use crossguard_endpoint::station::listen::link_layer_of;
use nix::errno::Errno;
use nix::fcntl::{FcntlArg, OFlag, fcntl};
use pcap_file::PcapError;
use pcap_file::pcap::{PcapPacket, PcapWriter};

use crate::transport::{Arrival, Halves, NotSent, Receiver, Sender};

/// How many packets may wait to be written.
const WAITING: usize = 4_096;

/// How long the end waits for what is still to be written.
const PATIENCE: Duration = Duration::from_secs(2);

/// A file that packets are written to as they come and go. Clones write to the same file.
#[derive(Clone, Debug)]
pub struct Capture {
    items: SyncSender<Item>,
    /// How many packets found no place in the queue.
    lost: Arc<AtomicU64>,
}

/// Item for the thread that writes.
#[derive(Debug)]
enum Item {
    /// This frame was on the link, so long after 1970.
    Frame(Duration, Vec<u8>),
    /// Tell how it went up to here.
    Finish(SyncSender<Result<(), PcapError>>),
}

/// Why not all packets are in a file.
#[derive(Debug, thiserror::Error)]
pub enum Incomplete {
    /// The file could not be written to; nothing was after that.
    #[error(transparent)]
    Failed(#[from] PcapError),
    /// The disk was too slow.
    #[error("there was no time for {0} of them")]
    TooSlow(u64),
    /// The disk does not answer.
    #[error("the disk does not answer")]
    Stuck,
}

/// Creates a file, or opens a FIFO that is read: nobody waits for its reader.
fn create(path: &Path) -> io::Result<File> {
    let mut options = File::options();
    let options = options.write(true).create(true).truncate(true);
    let opened = options.custom_flags(OFlag::O_NONBLOCK.bits()).open(path);
    let file = opened.map_err(|error| match error.raw_os_error() {
        Some(errno) if errno == Errno::ENXIO as i32 => io::Error::new(
            error.kind(),
            "nobody reads this FIFO: start its reader first",
        ),
        _ => error,
    })?;
    fcntl(&file, FcntlArg::F_SETFL(OFlag::empty()))?;
    Ok(file)
}

impl Capture {
    /// Creates the file.
    ///
    /// # Errors
    /// When it cannot be created or written to.
    pub fn create(path: &Path) -> Result<Self, PcapError> {
        // Without a buffer, so that nothing is missing when the process is killed.
        let writer = PcapWriter::new(create(path).map_err(PcapError::IoError)?)?;
        let (items, queue) = sync_channel(WAITING);
        std::thread::spawn(move || write(writer, &queue));
        Ok(Self {
            items,
            lost: Arc::default(),
        })
    }

    /// Writes a packet that is on the link now. It waits for nobody; what finds no place is counted.
    pub fn record(&self, packet: &[u8]) {
        let now = SystemTime::now().duration_since(UNIX_EPOCH);
        let item = frame(now.unwrap_or(Duration::ZERO), packet);
        if self.items.try_send(item).is_err() {
            self.lost.fetch_add(1, Ordering::Relaxed);
        }
    }

    /// Writes a packet that was on the link so long after 1970, and waits until there is a place for
    /// it, where there is time.
    pub fn record_at(&self, at: Duration, packet: &[u8]) {
        if self.items.send(frame(at, packet)).is_err() {
            self.lost.fetch_add(1, Ordering::Relaxed);
        }
    }

    /// Whether everything was recorded.
    ///
    /// # Errors
    /// Why not.
    pub fn finish(self) -> Result<(), Incomplete> {
        let (tell, result) = sync_channel(1);
        let finish = self.items.try_send(Item::Finish(tell));
        let result = finish
            .ok()
            .and_then(|()| result.recv_timeout(PATIENCE).ok());
        result.ok_or(Incomplete::Stuck)??;
        match self.lost.load(Ordering::Relaxed) {
            0 => Ok(()),
            lost => Err(Incomplete::TooSlow(lost)),
        }
    }

    /// `halves`, and what goes out over them is recorded.
    #[must_use]
    pub fn of_sent(&self, halves: Halves) -> Halves {
        let capture = self.clone();
        Halves {
            sender: Box::new(RecordingSender {
                inner: halves.sender,
                capture,
            }),
            receiver: halves.receiver,
        }
    }

    /// `halves`, and what goes out and comes in over them is recorded.
    #[must_use]
    pub fn of_all(&self, halves: Halves) -> Halves {
        let Halves { sender, receiver } = self.of_sent(halves);
        let capture = self.clone();
        let inner = receiver;
        Halves {
            sender,
            receiver: Box::new(RecordingReceiver { inner, capture }),
        }
    }
}

fn frame(at: Duration, packet: &[u8]) -> Item {
    let header = ethernet::header(link_layer_of(packet));
    Item::Frame(at, [&header[..], packet].concat())
}

/// Writes frames until nobody is left who has some, or until something goes wrong.
fn write(mut writer: PcapWriter<File>, queue: &Queue<Item>) {
    let mut result = Ok(());
    for item in queue {
        match item {
            Item::Frame(at, frame) if result.is_ok() => {
                let length = u32::try_from(frame.len()).unwrap_or(u32::MAX);
                let written = writer.write_packet(&PcapPacket::new(at, length, &frame));
                result = written.map(drop);
            }
            Item::Frame(..) => {}
            Item::Finish(tell) => {
                // The asking thread may have given up.
                let _ = tell.send(std::mem::replace(&mut result, Ok(())));
            }
        }
    }
}

struct RecordingSender {
    inner: Box<dyn Sender>,
    capture: Capture,
}

impl Sender for RecordingSender {
    fn send(&mut self, octets: &[u8]) -> Result<(), NotSent> {
        self.capture.record(octets);
        self.inner.send(octets)
    }
}

struct RecordingReceiver {
    inner: Box<dyn Receiver>,
    capture: Capture,
}

impl Receiver for RecordingReceiver {
    fn receive(&mut self, at_most: Duration) -> std::io::Result<Option<Arrival>> {
        let arrival = self.inner.receive(at_most)?;
        if let Some(Arrival::Datagram { octets, .. }) = &arrival {
            self.capture.record(octets);
        }
        Ok(arrival)
    }
}

#[cfg(test)]
mod tests {
    use nix::sys::stat::Mode;
    use nix::unistd::mkfifo;

    use super::*;

    /// Hazard: a robot that waits for the reader of its capture does not start, and nobody is told why.
    #[test]
    fn nobody_waits_for_the_reader_of_a_fifo() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("some.pcap");
        mkfifo(&path, Mode::S_IRWXU).unwrap();
        let refused = create(&path).unwrap_err().to_string();
        assert!(refused.contains("nobody reads this FIFO"), "{refused}");
        let nonblocking = OFlag::O_NONBLOCK.bits();
        let _reader = File::options()
            .read(true)
            .custom_flags(nonblocking)
            .open(&path)
            .unwrap();
        let capture = Capture::create(&path).unwrap();
        for packet in [&[0x11; 60][..], &[1, 2, 3]] {
            capture.record(packet);
        }
        capture.finish().unwrap();
    }
}
